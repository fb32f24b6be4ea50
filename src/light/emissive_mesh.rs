//! [`EmissiveMesh`]: the surface of a lamp, and points on it that receivers sample.

use glam::{DVec3, Vec2, Vec3};

use super::block::{Incident, WideLight};
use super::rectangle::Rectangle;
use super::sample::end_of_shadow_ray;
use super::{LightBounds, LightHit, LightSample};
use crate::geometry::{BoundedPoint, Xyz, unit_wide};
use crate::sampling::{Discrete, uniform_triangle};
use crate::shape::{TriangleMesh, triangle_normal};
use crate::simd::{Float, LaneMask};
use crate::spectrum::{Bands, Spectrum};

/// A mesh that emits from its outer side or from both sides. What it emits is the light's affair.
#[derive(Clone, Debug)]
pub(super) struct EmissiveMesh {
    /// With vertex normals. Triangles without area are never sampled.
    mesh: TriangleMesh,
    /// Selects a triangle.
    triangles: Discrete,
    areas: Areas,
    rectangle: Option<Rectangle>,
    two_sided: bool,
}

/// The area of each triangle over the probability that it is selected, in squared scene units.
#[derive(Clone, Debug, Default)]
pub(super) struct Areas {
    /// Of all triangles, if they are selected by area: the total area.
    pub all: f64,
    /// Of each triangle; empty if they are selected by area. Infinite for those that never are.
    pub each: Box<[f64]>,
}

/// A triangle and barycentrics.
pub(super) type Place = (usize, [f32; 3]);

impl EmissiveMesh {
    /// Triangles are selected by `triangles`, and points on them uniformly by area; all of a flat rectangle uniformly by solid angle.
    pub(super) fn new(
        mesh: TriangleMesh,
        triangles: Discrete,
        areas: Areas,
        two_sided: bool,
    ) -> Self {
        let rectangle = find_rectangle(&mesh, two_sided);
        Self { mesh, triangles, areas, rectangle, two_sided }
    }

    #[inline]
    pub(super) fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Number of sides that emit.
    pub(super) fn sides(&self) -> f32 {
        if self.two_sided { 2.0 } else { 1.0 }
    }

    #[inline]
    pub(super) fn areas(&self) -> &Areas {
        &self.areas
    }

    /// A point sampled uniformly on a triangle that is selected at random: triangle and barycentrics, the point, and the unit
    /// outward normal there.
    #[inline]
    fn sample_area(&self, u: Vec2) -> (Place, BoundedPoint, Vec3) {
        let (triangle, _, rest) = self.triangles.sample(u.x);
        let b = uniform_triangle::sample(Vec2::new(rest, u.y));
        let b = [b.x, b.y, (1.0 - b.x - b.y).max(0.0)];
        let corners = self.mesh.corners(triangle);
        let n = triangle_normal(corners);
        let inward = self.mesh.shading_normal(triangle, b).is_some_and(|ns| n.dot(ns) < 0.0);
        let point = BoundedPoint::on_triangle(corners, b);
        ((triangle, b), point, if inward { -n } else { n })
    }

    /// The rectangle that the mesh forms, as a light of this radiance, which is sampled for several receivers at a time.
    #[inline]
    pub(super) fn on_rectangle(&self, radiance: Spectrum) -> Option<OnRectangle<'_>> {
        let two_sided = self.two_sided;
        self.rectangle.as_ref().map(|rectangle| OnRectangle { rectangle, radiance, two_sided })
    }

    /// Light of radiance `li` from a point that shines on `p`, sampled in f64 by solid angle if the mesh is a rectangle that is not too
    /// small, or else by area; and the point's place, unless it was sampled on the rectangle.
    // One copy for all kinds of lights, into which all that it calls is inlined.
    #[inline(never)]
    pub(super) fn sample(
        &self,
        p: Vec3,
        u: Vec2,
        li: Spectrum,
    ) -> Option<(LightSample, Option<Place>)> {
        let on_rectangle = self.rectangle.as_ref().and_then(|rectangle| {
            let (point, pdf, outside) = rectangle.sample(p, u)?;
            Some((point, rectangle.normal(), pdf, outside))
        });
        let (point, n, pdf, place) = match on_rectangle {
            Some((.., false)) if !self.two_sided => return None,
            Some((point, n, pdf, _)) => (point, n, pdf, None),
            None => {
                let (place, point, n) = self.sample_area(u);
                let to_light = point.p - p;
                let distance = to_light.length();
                let cos_theta = -n.dot(to_light) / distance;
                if !self.shines(cos_theta) {
                    return None;
                }
                let area = *self.areas.each.get(place.0).unwrap_or(&self.areas.all);
                (point, n, pdf_by_area(distance, cos_theta, area), Some(place))
            }
        };
        Some((LightSample::from_surface(p, point, n, li, pdf)?, place))
    }

    /// Density over solid angle with which [`sample`](Self::sample) at the hit's origin finds the hit. `area` is one of [`Areas`].
    #[inline]
    pub(super) fn pdf(&self, hit: &LightHit, area: f64) -> f32 {
        let pdf = match self.rectangle.as_ref().and_then(|rectangle| rectangle.pdf(hit.origin)) {
            Some((pdf, outside)) if outside || self.two_sided => pdf,
            Some(_) => 0.0,
            None => {
                let cos_theta = -hit.n.dot(hit.wi);
                let shines = self.shines(cos_theta);
                if shines { pdf_by_area(hit.distance, cos_theta, area) } else { 0.0 }
            }
        };
        if pdf < f32::INFINITY { pdf } else { 0.0 }
    }

    /// Whether light is emitted towards directions whose cosine with the outward normal is `cos_theta`.
    #[inline]
    pub(super) fn shines(&self, cos_theta: f32) -> bool {
        cos_theta > 0.0 || (self.two_sided && cos_theta < 0.0)
    }

    /// Bounds of the triangles that have an area.
    pub(super) fn bounds(&self) -> LightBounds {
        let corners = || with_area(&self.mesh).flat_map(|t| self.mesh.corners(t));
        let (min, max) = corners()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
        let bounds = LightBounds::new(min, max);
        let bounds = match normals(&self.mesh) {
            Some((axis, angle)) => bounds.with_normals(axis, angle),
            None => bounds,
        };
        if self.two_sided { bounds.with_two_sides() } else { bounds }
    }
}

/// A light that is a rectangle.
pub(super) struct OnRectangle<'a> {
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

/// Density over solid angle of a point sampled by area, d² / (cos θ A); infinite at cos θ = 0. `cos_theta`
/// is the cosine between the outward normal and the direction to the receiver.
#[inline]
fn pdf_by_area(distance: f32, cos_theta: f32, area: f64) -> f32 {
    let distance = f64::from(distance);
    (distance * distance / (f64::from(cos_theta.abs()) * area)) as f32
}

/// Indices of the triangles that have an area.
pub(super) fn with_area(mesh: &TriangleMesh) -> impl Iterator<Item = usize> {
    (0..mesh.indices.len()).filter(|&t| mesh.geometric_normal(t) != Vec3::ZERO)
}

/// In squared scene units.
pub(super) fn triangle_area(corners: [Vec3; 3]) -> f64 {
    let [p0, p1, p2] = corners.map(Vec3::as_dvec3);
    (p1 - p0).cross(p2 - p0).length() / 2.0
}

/// The rectangle that the mesh forms, if it is one and has one outer side.
fn find_rectangle(mesh: &TriangleMesh, two_sided: bool) -> Option<Rectangle> {
    let mut triangles = with_area(mesh);
    let (a, b) = (triangles.next()?, triangles.next()?);
    if triangles.next().is_some() {
        return None;
    }
    let [first, second] = [outward(mesh, a)?, outward(mesh, b)?];
    if !two_sided && first.dot(second) < 0.0 {
        return None;
    }
    Rectangle::new([mesh.corners(a), mesh.corners(b)], first)
}

/// The mean direction of all outward normals, and the largest angle from it; `None` where both sides of a triangle are the outer
/// one, or if there is no mean.
fn normals(mesh: &TriangleMesh) -> Option<(Vec3, f64)> {
    let of_triangles = || with_area(mesh).map(|t| outward(mesh, t));
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
