//! [`Integrator`] and [`Estimator`], the traits of integrators.

use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use super::wave::Wave;
use crate::params::{Fault, Table};
use crate::sampling::Sampler;
use crate::scene::Scene;

/// Function that reads a kind of integrator from a scene file.
pub type Read = fn(&Table) -> Result<Arc<dyn Integrator>, Fault>;

/// An algorithm that estimates the radiance along camera rays. It holds settings only, and serves any scene.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::integrator::{Estimator, Integrator, Wave};
/// use lobe::sampling::Sampler;
/// use lobe::scene::Scene;
///
/// /// Shows the distance to the surface.
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
    /// Prepares the integrator for a scene: computes once what depends on the scene's lights and surfaces.
    fn prepare<'a>(&'a self, scene: &'a Scene) -> Box<dyn Estimator + 'a>;

    /// Name and settings, in one line for people. Integrators with equal descriptions are taken to be equal.
    fn describe(&self) -> String {
        "custom".to_owned()
    }

    /// Wraps the integrator for settings, without a second `Arc` around one that is shared.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Integrator>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// Its description.
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

/// An integrator prepared for one scene. It processes many camera rays together, a [`Wave`], so that rays can be
/// traced in batches.
pub trait Estimator: Send + Sync {
    /// Adds to `wave.radiance` the radiance along each camera ray, whose hit is in `wave.hits`. Sample values
    /// come from `sampler` for the samples `wave.ids`, in dimensions from
    /// [`dimension::FIRST_LIGHT`](super::dimension::FIRST_LIGHT) on.
    fn shade(&self, sampler: &dyn Sampler, wave: &mut Wave);

    /// Maximum number of shadow rays per sample that are buffered at the same time. Buffers are allocated for
    /// it.
    fn shadow_rays(&self) -> usize {
        1
    }
}
