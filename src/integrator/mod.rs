//! Integrators: how much light arrives along camera rays.
//!
//! Each algorithm stands in its own file from top to bottom: [`ChapterIntegrator`], [`DirectIntegrator`],
//! [`PathIntegrator`]. They work on waves of samples, stage by stage; the stages that they share are in `wave/`.

mod chapter;
mod direct;
mod path;
mod traits;
mod wave;

pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use path::PathIntegrator;
pub use traits::{Estimator, Integrator, Read};
pub use wave::{Counters, ShadowRays, Wave, dimension};

use crate::params::Kind;

/// All kinds of integrators.
pub static INTEGRATORS: &[Kind<Read>] = &[path::KIND, direct::KIND, chapter::KIND];
