//! The contracts of integrators.

use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use super::wave::Wave;
use crate::params::{Fault, Table};
use crate::sampling::Sampler;
use crate::scene::Scene;

/// How a kind of integrator is read.
pub type Read = fn(&Table) -> Result<Arc<dyn Integrator>, Fault>;

/// A way to compute how much light arrives along camera rays: plain settings, for any scene.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::integrator::{Estimator, Integrator, Wave};
/// use lobe::sampling::Sampler;
/// use lobe::scene::Scene;
///
/// /// Shows how far away things are.
/// struct Depth;
///
/// impl Integrator for Depth {
///     fn prepare<'a>(&'a self, _: &'a Scene) -> Box<dyn Estimator + 'a> {
///         Box::new(Depth)
///     }
/// }
///
/// impl Estimator for Depth {
///     fn shade(&self, _: &dyn Sampler, wave: &mut Wave) {
///         for (radiance, hit) in wave.radiance.iter_mut().zip(&wave.hits) {
///             if hit.is_hit() {
///                 *radiance = Spectrum::splat(hit.t);
///             }
///         }
///     }
/// }
/// ```
pub trait Integrator: Send + Sync {
    /// Makes the integrator ready for a scene: what follows from the scene's lights and surfaces is found
    /// once, before there are samples.
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a>;

    /// What it is, with its settings, in one line for people. Two integrators with the same line count as one.
    fn describe(&self) -> String {
        "of another crate".to_owned()
    }

    /// The integrator as settings hold it.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Integrator>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// As it describes itself.
impl Debug for dyn Integrator + '_ {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str(&self.describe())
    }
}

impl Integrator for Arc<dyn Integrator> {
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a> {
        (**self).prepare(scene)
    }

    fn describe(&self) -> String {
        (**self).describe()
    }

    fn into_arc(self) -> Arc<dyn Integrator> {
        self
    }
}

/// An integrator that was made ready for one scene. It works on many camera rays at once, a [`Wave`], so that
/// rays can be traced in batches.
pub trait Estimator: Send + Sync {
    /// Adds to `wave.radiance` what arrives along each camera ray, whose hits are known already.
    /// Samples come from `sampler` by the number in `wave.ids`, in dimensions from
    /// [`dimension::FIRST_LIGHT`](super::dimension::FIRST_LIGHT) on.
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave);

    /// The most rays towards lights that a sample has waiting at a time, so that room can be made for them
    /// beforehand.
    fn shadow_rays(&self) -> usize {
        1
    }
}
