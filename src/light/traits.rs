//! [`Light`], the trait of light sources.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::block::{Emitted, EscapedRays, LightSamples, Receivers};
use super::bounds::LightBounds;
use super::sample::{LightHit, LightSample};
use crate::params::{Fault, Table};
use crate::spectrum::Spectrum;

/// Function that reads a kind of light from a scene file.
pub type Read = fn(&Table) -> Result<Arc<dyn Light>, Fault>;

/// Bounding sphere of the scene. The power of lights at an infinite distance depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundingSphere {
    /// Its centre.
    pub center: Vec3,
    /// Its radius; 0 for a scene without triangles.
    pub radius: f32,
}

/// A light source (PBRT 3rd edition, section 12.2).
///
/// A delta light (a point or a single direction) implements [`sample_li`](Light::sample_li) and
/// [`power`](Light::power). A light that surrounds the scene, or is the surface of a shape, can also be hit by
/// rays: it implements [`le`](Light::le) and [`pdf_li`](Light::pdf_li) too, so that both ways to find it can be
/// weighted by multiple importance sampling.
///
/// ```
/// use lobe::Spectrum;
/// use lobe::glam::{Vec2, Vec3};
/// use lobe::light::{Light, LightSample};
///
/// /// A lamp that shines only downwards, with the intensity I cos θ.
/// struct Downlight {
///     position: Vec3,
///     intensity: f32,
/// }
///
/// impl Light for Downlight {
///     fn is_delta(&self) -> bool {
///         true
///     }
///
///     fn sample_li(&self, p: Vec3, _u: Vec2) -> Option<LightSample> {
///         let (wi, distance) = (self.position - p).normalize_and_length();
///         let li = Spectrum::splat(self.intensity * wi.y / (distance * distance));
///         (wi.y > 0.0).then_some(LightSample::from_point(li, wi, 1.0, self.position))
///     }
/// }
///
/// let lamp = Downlight { position: Vec3::new(0.0, 3.0, 0.0), intensity: 18.0 };
/// let below = lamp.sample_li(Vec3::ZERO, Vec2::ZERO).unwrap();
/// assert_eq!(below.li, Spectrum::splat(18.0 / 9.0));
/// assert!(lamp.sample_li(Vec3::new(0.0, 4.0, 0.0), Vec2::ZERO).is_none());
/// ```
#[doc(alias = "lamp")]
#[doc(alias = "emitter")]
pub trait Light: Send + Sync {
    /// Whether this is a delta light: a point or a single direction, which no ray can hit by chance.
    fn is_delta(&self) -> bool;

    /// Whether rays that leave the scene reach this light.
    fn is_infinite(&self) -> bool {
        false
    }

    /// Whether sampling directions from this light reduces noise, compared with rays sampled from the BSDF
    /// alone. False for a constant sky: all of its directions contribute the same radiance.
    fn is_worth_sampling(&self) -> bool {
        true
    }

    /// Samples light towards the point `p` in world space, with `u` in `[0, 1)²`. `None` if there is none.
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample>;

    /// Density over solid angle with which `sample_li` at `hit.origin` returns `hit.wi`; 0 if it cannot. By default
    /// NaN, since a delta light is never hit: a light that rays hit and that lacks this method gives samples that are
    /// not finite, which are left out and counted, and does not count twice in silence.
    fn pdf_li(&self, _hit: &LightHit) -> f32 {
        f32::NAN
    }

    /// Radiance emitted against the ray, in W / (m² sr). A delta light is invisible.
    fn le(&self, _hit: &LightHit) -> Spectrum {
        Spectrum::BLACK
    }

    /// Total emitted power in W; for a light at an infinite distance, the power that passes through `scene`.
    /// Where one of several lights is selected per hit, the probability grows with it. An unknown power
    /// (`None`) counts as the mean power of the others. A light of zero power is selected too, but rarely.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        None
    }

    /// Where the light is and which way it shines, so that hits far away or behind it select it less often where there are many
    /// lights. `None` for a light that is at an infinite distance or unknown, which is selected by power alone.
    fn bounds(&self) -> Option<LightBounds> {
        None
    }

    /// Sets [`sample_li`](Light::sample_li) of each of a block of points where it is not `None`. The provided method is compiled for
    /// each light, so that a block costs one call through a pointer. A light that is faster for several points at a time overrides
    /// this, with bit-identical results.
    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        for i in 0..receivers.len() {
            samples.set(i, self.sample_li(receivers.p(i), receivers.u(i)));
        }
    }

    /// Sets [`le`](Light::le) and [`pdf_li`](Light::pdf_li) of each of a block of rays that leave the scene. A light that is faster
    /// for several rays at a time overrides this, with bit-identical results.
    fn escaped_block(&self, rays: &EscapedRays, emitted: &mut Emitted) {
        for i in 0..rays.len() {
            let hit = rays.get(i);
            let pdf = if rays.needs_pdf() { self.pdf_li(&hit) } else { 1.0 };
            emitted.set(i, self.le(&hit), pdf);
        }
    }

    /// Wraps the light for a scene, without a second `Arc` around one that is shared.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Light>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// A shared light is a light.
macro_rules! shared {
    ($(<$($l:ident)?> $light:ty),*) => {$(
        impl$(<$l: Light + 'static>)? Light for Arc<$light> {
            fn is_delta(&self) -> bool {
                (**self).is_delta()
            }

            fn is_infinite(&self) -> bool {
                (**self).is_infinite()
            }

            fn is_worth_sampling(&self) -> bool {
                (**self).is_worth_sampling()
            }

            fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
                (**self).sample_li(p, u)
            }

            fn pdf_li(&self, hit: &LightHit) -> f32 {
                (**self).pdf_li(hit)
            }

            fn le(&self, hit: &LightHit) -> Spectrum {
                (**self).le(hit)
            }

            fn power(&self, scene: &BoundingSphere) -> Option<Spectrum> {
                (**self).power(scene)
            }

            fn bounds(&self) -> Option<LightBounds> {
                (**self).bounds()
            }

            fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
                (**self).sample_li_block(receivers, samples);
            }

            fn escaped_block(&self, rays: &EscapedRays, emitted: &mut Emitted) {
                (**self).escaped_block(rays, emitted);
            }

            fn into_arc(self) -> Arc<dyn Light> {
                self
            }
        }
    )*};
}

shared!(<> dyn Light, <L> L);
