//! Convergence of rendering methods: error against time and against samples.
//!
//! A measurement has these steps, which `lobe chart` takes in this order:
//!
//! 1. Render a [`Reference`] as the mean of independent parts, whose differences give its own error.
//! 2. For each [`Method`], number of samples and seed, render a picture and keep a [`Run`]: its times and its errors
//!    against the reference.
//! 3. Average a method's pictures with the most samples in a [`RunningMean`], and estimate the [`Bias`] from it.
//! 4. Summarise the runs of a method in a [`Curve`] (medians, quartiles, slopes), and find the [`pareto_front`] of all
//!    curves.
//! 5. Draw charts of the whole [`Study`].
//!
//! Errors are square roots of relMSE, the mean of (a - b)² / (b² + 0.01): an error of 0.05 is 5 % of a bright pixel. The
//! reference's own error is part of every measured one and is subtracted. A result is claimed only where it is larger
//! than the reference's own error.

mod bias;
mod curve;
mod method;
mod pareto;
mod reference;
mod run;
mod running_mean;
mod study;

pub use bias::Bias;
pub use curve::{Curve, CurvePoint};
pub use method::{Method, RunError};
pub use pareto::pareto_front;
pub use reference::{Distrust, Reference};
pub use run::{ParseRunError, Run};
pub use running_mean::RunningMean;
pub use study::{Other, Study};
