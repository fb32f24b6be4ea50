//! Error against time and samples: what to measure of methods, and what to make of it.
//!
//! The steps, which the command `lobe chart` takes one after the other:
//!
//! 1. A [`Reference`] from independent parts, which tell its own error.
//! 2. For each [`Method`], number of samples and seed a [`Run`]: time and errors against the reference.
//! 3. The mean of a method's pictures at the largest number of samples, a [`RunningMean`], and with it the method's
//!    [`Bias`].
//! 4. From the runs of a method its [`Curve`]: medians, quartiles, slopes; from all curves the [`front`].
//! 5. All of it is a [`Study`], which draws the charts.
//!
//! Errors are roots of relMSE, mean of (a - b)² / (b² + 0.01), so that 0.05 is 5 % of a bright pixel. The error of
//! the reference adds to every measured one and is taken off again: what is left is claimed only where
//! it is larger than the reference's own.

mod bias;
mod curve;
mod method;
mod reference;
mod run;
mod running_mean;
mod study;

pub use bias::Bias;
pub use curve::{Curve, CurvePoint, front};
pub use method::{Method, RunError};
pub use reference::{Distrust, Reference};
pub use run::{ParseRunError, Run};
pub use running_mean::RunningMean;
pub use study::{Other, Study};
