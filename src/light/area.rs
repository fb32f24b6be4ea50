//! [`AreaLight`]: emission from the triangles of a mesh.

use std::f32::consts::PI;

use glam::{DVec3, Vec2, Vec3};

use super::block::{Incident, WideLight, sample_wide};
use super::rectangle::Rectangle;
use super::sample::end_of_shadow_ray;
use super::{BoundingSphere, Light, LightBounds, LightHit, LightSample, LightSamples, Receivers};
use crate::geometry::{BoundedPoint, Xyz, unit_wide};
use crate::sampling::{Discrete, uniform_triangle};
use crate::shape::{TriangleMesh, triangle_normal};
use crate::simd::{Float, LaneMask};
use crate::spectrum::{Bands, Spectrum};

/// A mesh that emits the same radiance in all directions, from its outer side or from both sides (PBRT 3rd
/// edition, sections 12.5 and 14.2.2).
///
/// The outer side is that of [`SurfaceInteraction`](crate::interaction::SurfaceInteraction): where the
/// corners run counter-clockwise, unless vertex normals point to the other side.
///
/// Points are sampled uniformly by area. If the mesh is one flat rectangle, they are sampled uniformly by
/// solid angle instead, down to 1e-6 sr.
#[doc(alias = "diffuse area light")]
#[doc(alias = "emission")]
#[doc(alias = "emitter")]
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// Triangles of non-zero area, with their vertex normals.
    mesh: TriangleMesh,
    /// Selects a triangle in proportion to its area.
    triangles: Discrete,
    /// Total area, in squared scene units.
    area: f64,
    rectangle: Option<Rectangle>,
    radiance: Spectrum,
    two_sided: bool,
}

impl AreaLight {
    /// A light with the shape of `mesh`, in world space, that emits `radiance`, in W / (m² sr). The mesh must
    /// have passed [`TriangleMesh::check`]. `None` if it has no area. Triangles without area are ignored.
    pub fn new(mesh: &TriangleMesh, radiance: Spectrum, two_sided: bool) -> Option<Self> {
        // Emission needs neither texture coordinates nor triangles without area.
        let has_area = |t: &usize| mesh.geometric_normal(*t) != Vec3::ZERO;
        let indices = (0..mesh.indices.len()).filter(has_area).map(|t| mesh.indices[t]).collect();
        let mesh = TriangleMesh {
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            uvs: Vec::new(),
            indices,
        };
        let areas = || (0..mesh.indices.len()).map(|t| triangle_area(mesh.corners(t)));
        let triangles = Discrete::new(areas())?;
        let area = areas().sum();
        let rectangle = find_rectangle(&mesh, two_sided);
        Some(Self { mesh, triangles, area, rectangle, radiance, two_sided })
    }

    /// A point sampled uniformly by area, and the unit outward normal there.
    #[inline]
    fn sample_area(&self, u: Vec2) -> (BoundedPoint, Vec3) {
        let (triangle, _, rest) = self.triangles.sample(u.x);
        let b = uniform_triangle::sample(Vec2::new(rest, u.y));
        let b = [b.x, b.y, (1.0 - b.x - b.y).max(0.0)];
        let corners = self.mesh.corners(triangle);
        let n = triangle_normal(corners);
        let inward = self.mesh.shading_normal(triangle, b).is_some_and(|ns| n.dot(ns) < 0.0);
        (BoundedPoint::on_triangle(corners, b), if inward { -n } else { n })
    }

    fn on_rectangle(&self) -> Option<OnRectangle<'_>> {
        let Self { radiance, two_sided, .. } = *self;
        self.rectangle.as_ref().map(|rectangle| OnRectangle { rectangle, radiance, two_sided })
    }

    /// [`sample_li`](Light::sample_li) where f32 is not precise enough, or if the light is no rectangle: in f64 by solid
    /// angle, or else by area.
    fn sample_precisely(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let on_rectangle = self.rectangle.as_ref().and_then(|rectangle| {
            let (point, pdf, outside) = rectangle.sample(p, u)?;
            Some((point, rectangle.normal(), pdf, outside))
        });
        let (point, n, pdf) = match on_rectangle {
            Some((.., false)) if !self.two_sided => return None,
            Some((point, n, pdf, _)) => (point, n, pdf),
            None => {
                let (point, n) = self.sample_area(u);
                let to_light = point.p - p;
                let distance = to_light.length();
                let cos_theta = -n.dot(to_light) / distance;
                if !self.shines(cos_theta) {
                    return None;
                }
                (point, n, self.pdf_by_area(distance, cos_theta))
            }
        };
        LightSample::from_surface(p, point, n, self.radiance, pdf)
    }

    /// Density over solid angle of a point sampled by area, d² / (cos θ A); infinite at cos θ = 0. `cos_theta`
    /// is the cosine between the outward normal and the direction to the receiver.
    #[inline]
    fn pdf_by_area(&self, distance: f32, cos_theta: f32) -> f32 {
        let distance = f64::from(distance);
        (distance * distance / (f64::from(cos_theta.abs()) * self.area)) as f32
    }

    /// Whether light is emitted towards directions whose cosine with the outward normal is `cos_theta`.
    #[inline]
    fn shines(&self, cos_theta: f32) -> bool {
        cos_theta > 0.0 || (self.two_sided && cos_theta < 0.0)
    }
}

impl Light for AreaLight {
    fn is_delta(&self) -> bool {
        false
    }

    #[inline]
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        if let Some(rectangle) = self.on_rectangle() {
            let (incident, imprecise) = rectangle.incident(p.into(), u.to_array());
            if !imprecise {
                return incident.into_sample();
            }
        }
        self.sample_precisely(p, u)
    }

    #[inline]
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        let pdf = match self.rectangle.as_ref().and_then(|rectangle| rectangle.pdf(hit.origin)) {
            Some((pdf, outside)) if outside || self.two_sided => pdf,
            Some(_) => 0.0,
            None => {
                let cos_theta = -hit.n.dot(hit.wi);
                let shines = self.shines(cos_theta);
                if shines { self.pdf_by_area(hit.distance, cos_theta) } else { 0.0 }
            }
        };
        if pdf < f32::INFINITY { pdf } else { 0.0 }
    }

    /// The light's radiance, if the ray arrives on a side that emits.
    #[inline]
    fn le(&self, hit: &LightHit) -> Spectrum {
        if self.shines(-hit.n.dot(hit.wi)) { self.radiance } else { Spectrum::BLACK }
    }

    /// π A L, twice that for both sides.
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        Some(self.radiance * (sides * PI * self.area as f32))
    }

    fn bounds(&self) -> Option<LightBounds> {
        let corners = || (0..self.mesh.indices.len()).flat_map(|t| self.mesh.corners(t));
        let (min, max) = corners()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
        let bounds = LightBounds::new(min, max);
        let bounds = match normals(&self.mesh) {
            Some((axis, angle)) => bounds.with_normals(axis, angle),
            None => bounds,
        };
        Some(if self.two_sided { bounds.with_two_sides() } else { bounds })
    }

    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        let precisely = |i: usize, samples: &mut LightSamples| {
            samples.set(i, self.sample_precisely(receivers.p(i), receivers.u(i)));
        };
        match self.on_rectangle() {
            Some(rectangle) => {
                sample_wide(&rectangle, receivers, samples).for_each(|i| precisely(i, samples))
            }
            None => (0..receivers.len()).for_each(|i| precisely(i, samples)),
        }
    }
}

/// An area light that is a rectangle.
struct OnRectangle<'a> {
    rectangle: &'a Rectangle,
    radiance: Spectrum,
    two_sided: bool,
}

impl WideLight for OnRectangle<'_> {
    #[inline(always)]
    fn incident<F: Float>(&self, p: Xyz<F>, u: [F; 2]) -> (Incident<F>, F::Mask) {
        let (sample, is_precise) = self.rectangle.sample_wide(p, u);
        let to_light = sample.point.p - p;
        let (wi, is_unit) = unit_wide(to_light);
        let n = Xyz::splat(self.rectangle.normal());
        let shines = sample.outside | F::Mask::splat(self.two_sided);
        let incident = Incident {
            li: Bands::splat(self.radiance),
            wi,
            pdf: F::select(shines, sample.pdf, F::splat(0.0)),
            from: Some(end_of_shadow_ray(to_light, sample.point, n)),
        };
        (incident, !(is_precise & is_unit))
    }
}

fn triangle_area(corners: [Vec3; 3]) -> f64 {
    let [p0, p1, p2] = corners.map(Vec3::as_dvec3);
    (p1 - p0).cross(p2 - p0).length() / 2.0
}

/// The rectangle that the mesh forms, if it is one and has one outer side.
fn find_rectangle(mesh: &TriangleMesh, two_sided: bool) -> Option<Rectangle> {
    let [_, _] = mesh.indices[..] else { return None };
    let [first, second] = [outward(mesh, 0)?, outward(mesh, 1)?];
    if !two_sided && first.dot(second) < 0.0 {
        return None;
    }
    Rectangle::new([mesh.corners(0), mesh.corners(1)], first)
}

/// The mean direction of all outward normals, and the largest angle from it; `None` where both sides of a triangle are the outer
/// one, or if there is no mean.
fn normals(mesh: &TriangleMesh) -> Option<(Vec3, f64)> {
    let of_triangles = || (0..mesh.indices.len()).map(|t| outward(mesh, t));
    let sum = of_triangles().try_fold(DVec3::ZERO, |sum, n| Some(sum + n?.as_dvec3()))?;
    let axis = sum.try_normalize()?.as_vec3();
    // As 2 asin of half the distance, since the cosine of a small angle is 1.
    let angle = |n: Vec3| 2.0 * (f64::from((n - axis).length()) / 2.0).min(1.0).asin();
    Some((axis, of_triangles().flatten().map(angle).fold(0.0, f64::max)))
}

/// Unit outward normal of a triangle, if its vertex normals agree on the outer side.
fn outward(mesh: &TriangleMesh, triangle: usize) -> Option<Vec3> {
    let n = mesh.geometric_normal(triangle);
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let sides = corners.map(|b| mesh.shading_normal(triangle, b).map_or(1.0, |ns| n.dot(ns)));
    if sides.iter().all(|side| *side >= 0.0) {
        Some(n)
    } else {
        sides.iter().all(|side| *side < 0.0).then_some(-n)
    }
}
