//! [`TexturedAreaLight`]: emission from the triangles of a mesh by a texture.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::block::{WideLight, sample_wide};
use super::emissive_mesh::{Areas, EmissiveMesh, Place, triangle_area, with_area};
use super::{BoundingSphere, Light, LightBounds, LightHit, LightSample, LightSamples, Receivers};
use crate::interaction::{SurfaceInteraction, SurfacePlace};
use crate::sampling::{Discrete, uniform_triangle};
use crate::shape::{PlacedMesh, TriangleMesh};
use crate::simd::ROW;
use crate::spectrum::Spectrum;
use crate::texture::{Texture, TextureHandle};

/// Part of the probability that is left to triangles by their area, whatever their estimated power.
const BY_AREA: f64 = 0.1;

/// Points per triangle at which the texture is looked up to estimate its power.
const POINTS: f64 = 16.0;

/// Such points in addition, shared among the triangles by area.
const SHARED_POINTS: f64 = 65_536.0;

/// The most of these for one triangle, which tell its power within a few thousandths: each instance of a lamp is asked anew.
const MOST_SHARED: f64 = 4096.0;

/// A mesh whose radiance is a texture: the same in all directions, from its outer side or from both sides, as of
/// [`AreaLight`](super::AreaLight).
///
/// The texture is looked up at single points, those that rays hit and those that are sampled. It is not filtered, since neither has a
/// footprint. Points that are black give no samples. Bands below 0 are taken as 0. Values that are not finite make samples that are left out and counted.
///
/// # How points are sampled
/// Nine tenths of the probability select a triangle by its power, area times mean luminance, and one tenth by its area, so that a
/// wrong estimate of the power costs noise and loses no light. On the triangle, points are sampled uniformly. The power is estimated
/// when the light is made, from 16 points on each triangle and 65,536 more that are shared among the triangles by area, up to 4096 for each. So a texture that is
/// bright in few places is sampled the better the smaller the triangles are.
///
/// If the mesh is one flat rectangle, points are sampled uniformly by solid angle, down to 1e-6 sr, whatever the texture; PBRT 4 and
/// Mitsuba 3 sample it uniformly, too.
///
/// ```
/// use lobe::glam::Vec3;
/// use lobe::interaction::SurfaceInteraction;
/// use lobe::light::{Light, TexturedAreaLight};
/// use lobe::{Spectrum, TriangleMesh};
///
/// // A window of 1 m² whose upper half is bright.
/// let window = TriangleMesh::parallelogram(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let radiance = |si: &SurfaceInteraction| Spectrum::splat(if si.uv().y > 0.5 { 8.0 } else { 2.0 });
/// let light = TexturedAreaLight::new(&window, radiance, false).unwrap();
/// let power = light.power(&Default::default()).unwrap().luminance();
/// assert!((power / (std::f32::consts::PI * 5.0) - 1.0).abs() < 5e-3);
/// ```
#[doc(alias = "emission")]
#[doc(alias = "emitter")]
#[derive(Clone)]
pub struct TexturedAreaLight {
    /// All triangles of the shape, so that hits tell them by index.
    mesh: EmissiveMesh,
    /// The first triangles that have an area: those of a rectangle.
    pair: [usize; 2],
    radiance: TextureHandle<Spectrum>,
    /// Estimated integral of the radiance over the area.
    integral: Spectrum,
    /// Index of the shape, which textures may ask for.
    shape: u32,
}

impl TexturedAreaLight {
    /// A light with the shape of `mesh`, in world space, that emits `radiance`, in W / (m² sr). The mesh must have passed
    /// [`TriangleMesh::check`]. `None` if it has no area. Textures see it as the scene's shape 0.
    pub fn new(
        mesh: &TriangleMesh,
        radiance: impl Texture<Spectrum> + 'static,
        two_sided: bool,
    ) -> Option<Self> {
        Self::on_shape(0, mesh, radiance.into_handle(), two_sided)
    }

    /// The same for a mesh that is the scene's shape of this index.
    pub(crate) fn on_shape(
        shape: u32,
        mesh: &TriangleMesh,
        radiance: TextureHandle<Spectrum>,
        two_sided: bool,
    ) -> Option<Self> {
        let mut lit = with_area(mesh);
        let first = lit.next()?;
        let pair = [first, lit.next().unwrap_or(first)];
        let mut areas = vec![0.0; mesh.indices.len()];
        with_area(mesh).for_each(|t| areas[t] = triangle_area(mesh.corners(t)));
        let total: f64 = areas.iter().sum();
        let (mut integral, mut powers) = (Spectrum::BLACK, vec![0.0; areas.len()]);
        for t in with_area(mesh) {
            let points = POINTS + (SHARED_POINTS * areas[t] / total).min(MOST_SHARED);
            let n = mesh.geometric_normal(t);
            let mean = mean_over_triangle(points as u32, |b| {
                radiance_at(&radiance, mesh, SurfacePlace { shape, triangle: t as u32, b }, n)
            });
            integral += mean * areas[t] as f32;
            powers[t] = areas[t] * f64::from(mean.luminance());
        }
        let sum: f64 = powers.iter().sum();
        let is_lit = sum > 0.0 && sum < f64::INFINITY;
        let weights = areas.iter().zip(&powers).map(|(area, power)| {
            let by_area = area / total;
            if is_lit { BY_AREA * by_area + (1.0 - BY_AREA) * power / sum } else { by_area }
        });
        let triangles = Discrete::new(weights)?;
        for (t, area) in areas.iter_mut().enumerate() {
            let probability = f64::from(triangles.probability(t));
            *area = if probability > 0.0 { *area / probability } else { f64::INFINITY };
        }
        let areas = Areas { all: total, each: areas.into() };
        let mesh = EmissiveMesh::new(mesh.clone(), triangles, areas, two_sided);
        Some(Self { mesh, pair, radiance, integral, shape })
    }

    /// The radiance at a point of a triangle, towards the unit direction `wo`.
    #[inline]
    fn radiance(&self, (triangle, b): Place, wo: Vec3) -> Spectrum {
        let place = SurfacePlace { shape: self.shape, triangle: triangle as u32, b };
        radiance_at(&self.radiance, self.mesh.mesh(), place, wo)
    }

    /// [`sample_li`](Light::sample_li) where f32 is not precise enough, or if the light is no rectangle.
    fn sample_precisely(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let (sample, place) = self.mesh.sample(p, u, Spectrum::BLACK)?;
        self.lit(sample, place)
    }

    /// A sample with its radiance; `None` where that is black, which saves a shadow ray. `place` is `None` on the rectangle.
    #[inline]
    fn lit(&self, sample: LightSample, place: Option<Place>) -> Option<LightSample> {
        // The end of the shadow ray is the point, moved along the normal.
        let place = place.unwrap_or_else(|| self.on_pair(sample.from.unwrap_or_default()));
        let li = self.radiance(place, -sample.wi);
        (!li.is_black()).then_some(LightSample { li, ..sample })
    }

    /// Triangle and barycentrics of a point on the rectangle.
    fn on_pair(&self, p: Vec3) -> Place {
        let [first, second] = self.pair.map(|t| (t, barycentrics(self.mesh.mesh().corners(t), p)));
        let least = |b: [f64; 3]| b[0].min(b[1]).min(b[2]);
        let (triangle, b) = if least(first.1) >= least(second.1) { first } else { second };
        // Rounding may leave the triangle.
        let b = b.map(|b| b.max(0.0));
        let sum: f64 = b.iter().sum();
        (triangle, b.map(|b| (b / sum) as f32))
    }
}

impl Light for TexturedAreaLight {
    fn is_delta(&self) -> bool {
        false
    }

    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        if let Some(rectangle) = self.mesh.on_rectangle(Spectrum::BLACK) {
            let (incident, imprecise) = rectangle.incident(p.into(), u.to_array());
            if !imprecise {
                return incident.into_sample().and_then(|sample| self.lit(sample, None));
            }
        }
        self.sample_precisely(p, u)
    }

    /// NaN without [`LightHit::surface`]: the density depends on the triangle.
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        let place = hit.surface.and_then(SurfaceInteraction::place);
        let area = place.and_then(|place| self.mesh.areas().each.get(place.triangle as usize));
        area.map_or(f32::NAN, |area| self.mesh.pdf(hit, *area))
    }

    /// The texture's value at the hit, if the ray arrives on a side that emits. NaN without [`LightHit::surface`].
    fn le(&self, hit: &LightHit) -> Spectrum {
        if !self.mesh.shines(-hit.n.dot(hit.wi)) {
            return Spectrum::BLACK;
        }
        hit.surface.map_or(Spectrum::splat(f32::NAN), |si| emitted(self.radiance.evaluate(si)))
    }

    /// π times the estimated integral of the radiance over the area, twice that for both sides.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        Some(self.integral * (self.mesh.sides() * PI))
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(self.mesh.bounds())
    }

    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        let mut imprecise = [true; ROW];
        if let Some(rectangle) = self.mesh.on_rectangle(Spectrum::BLACK) {
            imprecise = [false; ROW];
            sample_wide(&rectangle, receivers, samples).for_each(|i| imprecise[i] = true);
        }
        for (i, is_imprecise) in imprecise.into_iter().enumerate().take(receivers.len()) {
            let sample = match is_imprecise {
                true => self.sample_precisely(receivers.p(i), receivers.u(i)),
                false => samples.get(i).and_then(|sample| self.lit(sample, None)),
            };
            samples.set(i, sample);
        }
    }
}

/// What a texture's value emits: bands below 0 are 0, and NaN stays.
#[inline]
fn emitted(value: Spectrum) -> Spectrum {
    Spectrum::from(value.to_array().map(|band| if band < 0.0 { 0.0 } else { band }))
}

/// The radiance at a point of a mesh towards the unit direction `wo`.
fn radiance_at(
    radiance: &TextureHandle<Spectrum>,
    mesh: &TriangleMesh,
    place: SurfacePlace,
    wo: Vec3,
) -> Spectrum {
    emitted(radiance.evaluate(&SurfaceInteraction::on_shape(
        PlacedMesh::new(mesh, None),
        place,
        wo,
    )))
}

/// The mean over a triangle, by barycentrics, from the points of a Hammersley set. Values that are not finite count as black.
fn mean_over_triangle(points: u32, radiance: impl Fn([f32; 3]) -> Spectrum) -> Spectrum {
    let mut sum = [0.0_f64; 3];
    for i in 0..points {
        let x = (f64::from(i) + 0.5) / f64::from(points);
        let y = f64::from(i.reverse_bits()) / 2.0_f64.powi(32);
        let b = uniform_triangle::sample(Vec2::new(x as f32, y as f32));
        let value = radiance([b.x, b.y, (1.0 - b.x - b.y).max(0.0)]);
        if value.is_finite() {
            sum.iter_mut().zip(value.to_array()).for_each(|(sum, band)| *sum += f64::from(band));
        }
    }
    sum.map(|band| (band / f64::from(points)) as f32).into()
}

/// Barycentric coordinates of the point of a triangle's plane that is nearest to `p`.
fn barycentrics(corners: [Vec3; 3], p: Vec3) -> [f64; 3] {
    let [p0, p1, p2] = corners.map(Vec3::as_dvec3);
    let (e1, e2, to_p) = (p1 - p0, p2 - p0, p.as_dvec3() - p0);
    let n = e1.cross(e2);
    let [b1, b2] = [to_p.cross(e2), e1.cross(to_p)].map(|v| v.dot(n) / n.length_squared());
    [1.0 - b1 - b2, b1, b2]
}
