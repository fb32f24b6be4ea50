//! The contract of lights.

use std::sync::Arc;

use glam::{BVec4A, Vec2, Vec3, Vec4};

use crate::geometry::four::{Vec3x4, four};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Table};
use crate::spectrum::Spectrum;

/// How a kind of light is read.
pub type Read = fn(&Table) -> Result<Arc<dyn Light>, Fault>;

/// Light that may arrive at a point, from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Radiance in W / (m² sr); for a light without extent the irradiance that it gives a surface
    /// across the direction, in W / m².
    pub li: Spectrum,
    /// Unit direction from the point towards the light.
    pub wi: Vec3,
    /// Density over solid angle with which `wi` was drawn, above 0; 1 for a light without extent.
    pub pdf: f32,
    /// Where it comes from: it arrives if nothing stands between. A point of a surface is moved off that
    /// surface as far as its rounding errors ask for. `None` for light from infinitely far away.
    pub from: Option<Vec3>,
}

/// Four of [`LightSample`], of which some may be missing: their numbers mean nothing.
#[doc(hidden)]
#[derive(Clone, Copy)]
pub struct LightSamplesX4 {
    pub(crate) exists: BVec4A,
    pub(crate) li: [Spectrum; 4],
    pub(crate) wi: Vec3x4,
    pub(crate) pdf: Vec4,
    /// Where it comes from, if `is_near`.
    pub(crate) from: Vec3x4,
    pub(crate) is_near: BVec4A,
}

impl LightSamplesX4 {
    /// No light.
    pub(crate) const NONE: Self = Self {
        exists: BVec4A::FALSE,
        li: [Spectrum::BLACK; 4],
        wi: Vec3x4::splat(Vec3::Z),
        pdf: Vec4::ONE,
        from: Vec3x4::ZERO,
        is_near: BVec4A::FALSE,
    };
}

/// Samples that are drawn point by point: the i-th by `sample(i, p)`.
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

/// What a ray meets of a light that has an extent.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct LightHit<'a> {
    /// The surface's point that the ray leaves, before its origin is moved off the surface.
    pub origin: Vec3,
    /// Its unit direction.
    pub wi: Vec3,
    /// How far away the light is, in scene units; infinite for a light that surrounds the scene.
    pub distance: f32,
    /// The unit geometric normal of the light's surface, pointing outside; zero for a light that surrounds
    /// the scene.
    pub n: Vec3,
    /// The point of the light's surface, which tells shape, triangle, barycentrics and texture coordinates;
    /// `None` for a light that surrounds the scene, or if that is not known.
    pub surface: Option<&'a SurfaceInteraction<'a>>,
}

impl<'a> LightHit<'a> {
    /// A ray from `origin` that ends at a light's surface.
    #[inline]
    pub fn on_surface(origin: Vec3, surface: &'a SurfaceInteraction<'a>) -> Self {
        let (wi, distance) = (-surface.wo(), (surface.p() - origin).length());
        Self { origin, wi, distance, n: surface.n(), surface: Some(surface) }
    }

    /// A ray from `origin` along the unit direction `wi` that ends at a surface with the normal `n`, of which
    /// no more is known.
    pub fn new(origin: Vec3, wi: Vec3, distance: f32, n: Vec3) -> Self {
        Self { origin, wi, distance, n, surface: None }
    }

    /// A ray from `origin` that leaves the scene along the unit direction `wi`.
    #[inline]
    pub fn outside(origin: Vec3, wi: Vec3) -> Self {
        Self { origin, wi, distance: f32::INFINITY, n: Vec3::ZERO, surface: None }
    }
}

/// A ball around the scene, which lights from infinity shine on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundingSphere {
    /// Its centre.
    pub center: Vec3,
    /// Its radius; 0 for a scene without triangles.
    pub radius: f32,
}

/// A source of light (PBRT 3rd edition, section 12.2).
///
/// A light without extent, a delta light, only has [`sample_li`](Light::sample_li) and its power. One that
/// surrounds the scene, or is a shape's surface, can also be met by rays, and tells what they see and how likely its
/// own samples are to go the same way, so that both can be weighed against each other.
pub trait Light: Send + Sync {
    /// Whether the light has no extent, so that it takes no sample and no ray can hit it.
    fn is_delta(&self) -> bool;

    /// Whether rays that leave the scene end at this light.
    fn is_infinite(&self) -> bool {
        false
    }

    /// Whether directions should be drawn from this light at all, where rays that follow the surface's own
    /// reflection can meet it too. A constant sky says no: a surface does not care which part of it it sees.
    fn is_worth_sampling(&self) -> bool {
        true
    }

    /// Light towards the point `p` in world space, for u in `[0, 1)²`. `None` when there is none.
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample>;

    /// Density over solid angle with which `sample_li` of the ray's origin gives its direction; 0 when it
    /// cannot. A delta light has none.
    fn pdf_li(&self, _hit: &LightHit) -> f32 {
        0.0
    }

    /// Radiance that the ray sees, in W / (m² sr). A delta light cannot be seen.
    fn le(&self, _hit: &LightHit) -> Spectrum {
        Spectrum::BLACK
    }

    /// Total power in W; of a light from infinity, what it sends through `scene`. The more, the more often it
    /// is asked where one of several lights is. `None` if it is not known: the light is then asked as often
    /// as a light of mean power is. A light that gives no power is asked all the same, if less often.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        None
    }

    /// What [`sample_li`](Light::sample_li) gives for each of some points, four at a time. The slices are of
    /// equal length. A kind that answers for four points at once overrides this, to the same bits.
    #[doc(hidden)]
    fn sample_li_x4(&self, points: &[Vec3x4], u: &[[Vec2; 4]], samples: &mut [LightSamplesX4]) {
        for ((&p, u), samples) in points.iter().zip(u).zip(samples) {
            *samples = one_by_one(p, |i, p| self.sample_li(p, u[i]));
        }
    }

    /// The light as a scene holds it.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Light>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// A light that is held elsewhere too.
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

    /// Numbers in `[0, 1)`, of 24 bits.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    /// Points around lights of all kinds, on both sides of a lamp, some of them so that f32 is not enough. Seen to fail
    /// with the sides exchanged, with a density that is not the scalar one's, and with the first block's samples for
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
        let lights: [&dyn Light; 6] = [
            &PointLight::new(Vec3::new(0.5, 1.0, -0.5), l),
            &SkyLight::new(l),
            &area(&lamp, false),
            &area(&lamp, true),
            &area(&bent, false),
            &area(&bent, true),
        ];
        let mut next = numbers();
        let (mut compared, mut missing, mut declined) = (0, 0, 0);
        for trial in 0..10_000 {
            let scale = 10.0_f32.powf(3.0 * next() - 1.5);
            let mut around = || scale * (2.0 * next() - 1.0);
            let p =
                [(); 2].map(|()| [(); 4].map(|()| Vec3::new(around(), 1.0 + around(), around())));
            let u = [(); 2].map(|()| [(); 4].map(|()| Vec2::new(next(), next())));
            let points = p.map(|p| Vec3x4::new(four(|i| &p[i])));
            for (number, light) in lights.iter().enumerate() {
                let mut samples = [LightSamplesX4::NONE; 2];
                light.sample_li_x4(&points, &u, &mut samples);
                for (block, samples) in samples.into_iter().enumerate() {
                    let (p, u) = (p[block], u[block]);
                    // What a kind samples one by one is compared too, but does not count.
                    let at_once = match number {
                        0 | 1 => true,
                        2 | 3 => rectangle.sample_x4(points[block], u, l, true).is_some(),
                        _ => false,
                    };
                    declined += usize::from((number == 2 || number == 3) && !at_once);
                    let [wi, from] = [samples.wi, samples.from].map(|v| v.rows(samples.pdf));
                    for i in 0..4 {
                        let found = samples.exists.test(i).then(|| LightSample {
                            li: samples.li[i],
                            wi: wi[i].truncate(),
                            pdf: wi[i].w,
                            from: samples.is_near.test(i).then(|| from[i].truncate()),
                        });
                        let expected = light.sample_li(p[i], u[i]);
                        assert_eq!(found, expected, "trial {trial}, light {number} from {}", p[i]);
                        compared += usize::from(at_once);
                        missing += usize::from(at_once && found.is_none());
                    }
                }
            }
        }
        assert!(compared > 150_000 && missing > 3_000 && declined > 30_000);
    }
}
