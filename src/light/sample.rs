//! [`LightSample`]: light that may arrive at a point; [`LightHit`]: where a ray reaches a light.

use glam::Vec3;

use crate::geometry::float::gamma;
use crate::geometry::{Bounded, BoundedPoint, Xyz, unit};
use crate::interaction::SurfaceInteraction;
use crate::simd::Float;
use crate::spectrum::Spectrum;

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

/// The end of a shadow ray towards a point on a surface with the normal `n`: offset from it by the bound on its rounding
/// error.
#[inline(always)]
pub(super) fn end_of_shadow_ray<F: Float>(
    to_light: Xyz<F>,
    point: Bounded<F>,
    n: Xyz<F>,
) -> Xyz<F> {
    // The ray misses the point by the rounding of its direction and distance.
    let error = point.error + to_light.abs() * F::splat(gamma(8));
    Bounded { p: point.p, error }.ray_origin(n, -to_light)
}
