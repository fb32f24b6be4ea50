//! [`Light`], the trait of light sources.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::block::{Emitted, EscapedRays, LightSamples, Receivers, end_of_shadow_ray};
use crate::geometry::{BoundedPoint, Xyz, unit};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Table};
use crate::spectrum::Spectrum;

/// Function that reads a kind of light from a scene file.
pub type Read = fn(&Table) -> Result<Arc<dyn Light>, Fault>;

/// Light that may arrive at a point from one direction: it does unless something blocks it. Made by
/// [`distant`](Self::distant), [`from_point`](Self::from_point) or [`from_surface`](Self::from_surface).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LightSample {
    /// Incident radiance in W / (m² sr); for a delta light, the irradiance on a surface perpendicular to
    /// `wi`, in W / m².
    pub li: Spectrum,
    /// Unit direction from the point towards the light.
    pub wi: Vec3,
    /// Density over solid angle with which `wi` was sampled, above 0; 1 for a delta light.
    pub pdf: f32,
    /// End point of the shadow ray, outside the light's own surface. `None` for light from an infinite distance.
    pub from: Option<Vec3>,
}

impl LightSample {
    /// Light from an infinite distance.
    #[inline]
    pub fn distant(li: Spectrum, wi: Vec3, pdf: f32) -> Self {
        Self { li, wi, pdf, from: None }
    }

    /// Light from a point that no surface of the scene contains.
    #[inline]
    pub fn from_point(li: Spectrum, wi: Vec3, pdf: f32, from: Vec3) -> Self {
        Self { li, wi, pdf, from: Some(from) }
    }

    /// Light that reaches `p` from a point on a surface of the scene with normal `n`. The end point of the shadow ray is
    /// offset from the surface by the bound on its rounding error, so that the surface does not block the ray.
    /// `None` if `pdf` is 0 or infinite, or if both points are one.
    ///
    /// ```
    /// use lobe::Spectrum;
    /// use lobe::geometry::BoundedPoint;
    /// use lobe::glam::Vec3;
    /// use lobe::light::LightSample;
    ///
    /// let corners = [Vec3::new(-1.0, 2.0, -1.0), Vec3::new(1.0, 2.0, -1.0), Vec3::new(0.0, 2.0, 1.0)];
    /// let point = BoundedPoint::on_triangle(corners, [0.3, 0.3, 0.4]);
    /// let sample =
    ///     LightSample::from_surface(Vec3::ZERO, point, Vec3::NEG_Y, Spectrum::WHITE, 0.5).unwrap();
    /// let below = sample.from.unwrap().y;
    /// assert!(below < 2.0 && below > 1.9999);
    /// ```
    #[inline]
    pub fn from_surface(
        p: Vec3,
        point: BoundedPoint,
        n: Vec3,
        li: Spectrum,
        pdf: f32,
    ) -> Option<Self> {
        let to_light = Xyz::from(point.p) - p.into();
        let wi = unit(to_light.into()).filter(|_| pdf > 0.0 && pdf < f32::INFINITY)?;
        let from = end_of_shadow_ray(to_light, point.into(), n.into()).into();
        Some(Self { li, wi, pdf, from: Some(from) })
    }
}

/// Where a ray reaches a light that is not a delta light.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct LightHit<'a> {
    /// The surface point that the ray leaves, before the offset against self-intersection.
    pub origin: Vec3,
    /// Unit direction of the ray.
    pub wi: Vec3,
    /// Distance from `origin` to the light, in scene units; infinite for a light that surrounds the scene.
    pub distance: f32,
    /// Unit geometric normal of the light's surface, on its outer side; zero for a light that surrounds the
    /// scene.
    pub n: Vec3,
    /// The point on the light's surface, with shape, triangle, barycentrics and texture coordinates; `None` for
    /// a light that surrounds the scene, or if it is not known.
    pub surface: Option<&'a SurfaceInteraction<'a>>,
}

impl<'a> LightHit<'a> {
    /// A ray from `origin` to a point on a light's surface.
    #[inline]
    pub fn on_surface(origin: Vec3, surface: &'a SurfaceInteraction<'a>) -> Self {
        let (wi, distance) = (-surface.wo(), (surface.p() - origin).length());
        Self { origin, wi, distance, n: surface.n(), surface: Some(surface) }
    }

    /// A ray from `origin` along the unit direction `wi` to a surface with the normal `n`, without its
    /// [`surface`](Self::surface).
    pub fn new(origin: Vec3, wi: Vec3, distance: f32, n: Vec3) -> Self {
        Self { origin, wi, distance, n, surface: None }
    }

    /// A ray from `origin` that leaves the scene along the unit direction `wi`.
    #[inline]
    pub fn outside(origin: Vec3, wi: Vec3) -> Self {
        Self { origin, wi, distance: f32::INFINITY, n: Vec3::ZERO, surface: None }
    }
}

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

    /// [`sample_li`](Light::sample_li) for a block of points. A kind that is faster for several at a time overrides this,
    /// with bit-identical results.
    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        for i in 0..receivers.len() {
            samples.set(i, self.sample_li(receivers.p(i), receivers.u(i)));
        }
    }

    /// [`le`](Light::le) and [`pdf_li`](Light::pdf_li) for a block of rays that leave the scene. A kind that is faster for
    /// several at a time overrides this, with bit-identical results.
    fn escaped_block(&self, rays: &EscapedRays, emitted: &mut Emitted) {
        for i in 0..rays.len() {
            let hit = rays.get(i);
            emitted.set(i, self.le(&hit), self.pdf_li(&hit));
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
