//! [`Light`], the trait of light sources.

use std::sync::Arc;

use glam::{BVec4A, Vec2, Vec3, Vec4};

use crate::geometry::float::gamma;
use crate::geometry::four::{Vec3x4, four};
use crate::geometry::{BoundedPoint, unit};
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
        let to_light = point.p - p;
        let wi = unit(to_light).filter(|_| pdf > 0.0 && pdf < f32::INFINITY)?;
        // A shadow ray from `p` misses the point by the rounding of its direction and distance.
        let error = point.error + gamma(8) * to_light.abs();
        let from = BoundedPoint { p: point.p, error }.ray_origin(n, -to_light);
        Some(Self { li, wi, pdf, from: Some(from) })
    }
}

/// Four of [`LightSample`]. Where `exists` is false the other fields are meaningless.
#[doc(hidden)]
#[derive(Clone, Copy)]
pub struct LightSamplesX4 {
    pub(crate) exists: BVec4A,
    pub(crate) li: [Spectrum; 4],
    pub(crate) wi: Vec3x4,
    pub(crate) pdf: Vec4,
    /// End point of the shadow ray, if `is_near`.
    pub(crate) from: Vec3x4,
    pub(crate) is_near: BVec4A,
}

impl LightSamplesX4 {
    /// Four missing samples.
    pub(crate) const NONE: Self = Self {
        exists: BVec4A::FALSE,
        li: [Spectrum::BLACK; 4],
        wi: Vec3x4::splat(Vec3::Z),
        pdf: Vec4::ONE,
        from: Vec3x4::ZERO,
        is_near: BVec4A::FALSE,
    };
}

/// Samples four points one after the other: `sample(i, p)` for the i-th.
pub(crate) fn one_by_one(
    points: Vec3x4,
    mut sample: impl FnMut(usize, Vec3) -> Option<LightSample>,
) -> LightSamplesX4 {
    let p = points.rows(Vec4::ZERO);
    let samples: [_; 4] = std::array::from_fn(|i| sample(i, p[i].truncate()));
    let nothing = LightSample { li: Spectrum::BLACK, wi: Vec3::Z, pdf: 1.0, from: None };
    let (mut exists, mut is_near) = ([false; 4], [false; 4]);
    let (mut li, mut pdf) = ([Spectrum::BLACK; 4], [1.0; 4]);
    let (mut wi, mut from) = ([Vec3::Z; 4], [Vec3::ZERO; 4]);
    for (i, sample) in samples.into_iter().enumerate() {
        exists[i] = sample.is_some();
        let sample = sample.unwrap_or(nothing);
        (li[i], wi[i], pdf[i]) = (sample.li, sample.wi, sample.pdf);
        is_near[i] = sample.from.is_some();
        from[i] = sample.from.unwrap_or_default();
    }
    LightSamplesX4 {
        exists: BVec4A::from_array(exists),
        li,
        wi: Vec3x4::new(four(|i| &wi[i])),
        pdf: Vec4::from_array(pdf),
        from: Vec3x4::new(four(|i| &from[i])),
        is_near: BVec4A::from_array(is_near),
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

    /// [`sample_li`](Light::sample_li) for four points at a time. The slices have equal lengths. A kind that
    /// is faster for four points overrides this, with bit-identical results.
    #[doc(hidden)]
    fn sample_li_x4(&self, points: &[Vec3x4], u: &[[Vec2; 4]], samples: &mut [LightSamplesX4]) {
        for ((&p, u), samples) in points.iter().zip(u).zip(samples) {
            *samples = one_by_one(p, |i, p| self.sample_li(p, u[i]));
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

            fn sample_li_x4(&self, points: &[Vec3x4], u: &[[Vec2; 4]], samples: &mut [LightSamplesX4]) {
                (**self).sample_li_x4(points, u, samples);
            }

            fn into_arc(self) -> Arc<dyn Light> {
                self
            }
        }
    )*};
}

shared!(<> dyn Light, <L> L);

#[cfg(test)]
mod tests {
    use super::super::rectangle::Rectangle;
    use super::super::{AreaLight, PointLight, SkyLight};
    use super::*;
    use crate::shape::TriangleMesh;

    /// Pseudorandom numbers in `[0, 1)`, of 24 bits.
    fn random_numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    /// Points around lights of all kinds, on both sides of a lamp, some of them where f32 is not accurate enough. Seen to
    /// fail with the sides exchanged, with a density that is not the scalar one's, and with the first block's samples for
    /// the second.
    #[test]
    fn four_samples_are_those_of_one_to_the_bit() {
        let lamp = TriangleMesh::parallelogram(Vec3::new(0.3, 1.0, 0.1), Vec3::X, 2.0 * Vec3::Z);
        let mut bent = lamp.clone();
        bent.positions[2].y += 0.5;
        let l = Spectrum::new(3.0, 2.0, 1.0);
        let corners = [lamp.corners(0), lamp.corners(1)];
        let rectangle = Rectangle::new(corners, lamp.geometric_normal(0)).unwrap();
        let area = |mesh, two_sided| AreaLight::new(mesh, l, two_sided).unwrap();
        let position = Vec3::new(0.5, 1.0, -0.5);
        let lights: [&dyn Light; 6] = [
            &PointLight::new(position, l),
            &SkyLight::new(l),
            &area(&lamp, false),
            &area(&lamp, true),
            &area(&bent, false),
            &area(&bent, true),
        ];
        let mut next = random_numbers();
        let (mut compared, mut missing, mut declined) = (0, 0, 0);
        for trial in 0..10_000 {
            let scale = 10.0_f32.powf(3.0 * next() - 1.5);
            let mut around = || scale * (2.0 * next() - 1.0);
            let mut p =
                [(); 2].map(|()| [(); 4].map(|()| Vec3::new(around(), 1.0 + around(), around())));
            // At the point light itself there is no sample.
            p[1][2] = position;
            let u = [(); 2].map(|()| [(); 4].map(|()| Vec2::new(next(), next())));
            let points = p.map(|p| Vec3x4::new(four(|i| &p[i])));
            for (index, light) in lights.iter().enumerate() {
                let mut samples = [LightSamplesX4::NONE; 2];
                light.sample_li_x4(&points, &u, &mut samples);
                for (block, samples) in samples.into_iter().enumerate() {
                    let (p, u) = (p[block], u[block]);
                    // Samples that a kind draws one by one are compared too, but not counted.
                    let at_once = match index {
                        0 | 1 => true,
                        2 | 3 => rectangle.sample_x4(points[block], u, l, true).is_some(),
                        _ => false,
                    };
                    declined += usize::from((index == 2 || index == 3) && !at_once);
                    let [wi, from] = [samples.wi, samples.from].map(|v| v.rows(samples.pdf));
                    for i in 0..4 {
                        let found = samples.exists.test(i).then(|| LightSample {
                            li: samples.li[i],
                            wi: wi[i].truncate(),
                            pdf: wi[i].w,
                            from: samples.is_near.test(i).then(|| from[i].truncate()),
                        });
                        let expected = light.sample_li(p[i], u[i]);
                        assert_eq!(found, expected, "trial {trial}, light {index} from {}", p[i]);
                        compared += usize::from(at_once);
                        missing += usize::from(at_once && found.is_none());
                    }
                }
            }
        }
        assert!(compared > 150_000 && missing > 3_000 && declined > 30_000);
    }
}
