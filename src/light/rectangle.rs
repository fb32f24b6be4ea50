//! [`Rectangle`]: two triangles that form a rectangle, sampled by solid angle.

use glam::{BVec4A, DVec2, DVec3, Vec2, Vec3, Vec4};

use super::LightSamplesX4;
use crate::geometry::BoundedPoint;
use crate::geometry::float::gamma;
use crate::geometry::four::{BoundedPointx4, Vec3x4};
use crate::sampling::{MIN_SOLID_ANGLE, Seen, SeenX4};
use crate::spectrum::Spectrum;

/// Largest displacement of a corner from an exact rectangle, relative to the shorter edge.
const MAX_SKEW: f64 = 1e-4;

/// A rectangle, prepared for sampling from any point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    corner: DVec3,
    axes: [DVec3; 2],
    normal: DVec3,
    size: DVec2,
    /// Bounds on the absolute error of points sampled on it, per axis.
    error: Vec3,
}

impl Rectangle {
    /// The rectangle that two triangles with the outward normal `outward` form. They have to share their
    /// longest side, the other two sides of each have to be perpendicular, and all four corners have to
    /// match up to the rounding of their coordinates. Corners are compared by position.
    pub(super) fn new(triangles: [[Vec3; 3]; 2], outward: Vec3) -> Option<Self> {
        let [first, second] = triangles;
        // The corner that only one triangle has, and the two shared corners.
        let mut own = second.into_iter().filter(|p| !first.contains(p));
        let opposite = own.next().filter(|_| own.next().is_none())?;
        let alone = first.iter().position(|p| !second.contains(p))?;
        let [corner, a, b] = [0, 1, 2].map(|i| first[(alone + i) % 3]);
        if !(second.contains(&a) && second.contains(&b)) {
            return None;
        }
        let largest =
            [corner, a, b, opposite].map(Vec3::abs).into_iter().fold(Vec3::ZERO, Vec3::max);

        let [corner, a, b, opposite] = [corner, a, b, opposite].map(|p| p.as_dvec3());
        let (edge_x, edge_y) = (a - corner, b - corner);
        let size = DVec2::new(edge_x.length(), edge_y.length());
        let shift = opposite - (corner + edge_x + edge_y);
        let rounding = f64::from(gamma(8) * largest.max_element());
        let slack = rounding.min(MAX_SKEW * size.min_element());
        let skew = edge_x.dot(edge_y).abs() / size.max_element();
        if shift.abs().max_element() > slack || skew > 2.0 * slack {
            return None;
        }

        let x = edge_x.normalize();
        let normal = x.cross(edge_y).normalize();
        let normal = if normal.dot(outward.as_dvec3()) < 0.0 { -normal } else { normal };
        let y = (edge_y - x * x.dot(edge_y)).normalize();
        // Points in f32 take up to ten roundings of coordinates: axes, products, sums. And the triangle test
        // computes a ray's distance from those of the corners, which may be farther away by `reach`.
        let reach = Vec3::splat(gamma(8) * (size.x + size.y) as f32);
        let error =
            gamma(16) * largest + reach + 2.0 * Vec3::splat(slack as f32).min(gamma(8) * largest);
        Some(Self { corner, axes: [x, y], normal, size, error })
    }

    /// The unit outward normal.
    #[inline]
    pub(super) fn normal(&self) -> Vec3 {
        self.normal.as_vec3()
    }

    /// Density of the points that [`sample`](Self::sample) draws, and whether `p` is on the outer side; `None` if
    /// the solid angle is too small, and points should be sampled by area.
    #[inline]
    pub(super) fn pdf(&self, p: Vec3) -> Option<(f32, bool)> {
        let (seen, outside) = self.seen_from_x4(Vec3x4::splat(p));
        if seen.sound.test(0) {
            return Some((1.0 / seen.solid_angle.x, outside.test(0)));
        }
        let (seen, outside) = self.seen_from(p)?;
        Some(((1.0 / seen.solid_angle) as f32, outside))
    }

    /// A point sampled uniformly by the solid angle that the rectangle subtends at `p`, its density, and
    /// whether `p` is on the outer side.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, u: Vec2) -> Option<(BoundedPoint, f32, bool)> {
        let (seen, outside) = self.seen_from_x4(Vec3x4::splat(p));
        if seen.sound.test(0) {
            let point = self.points_x4(&seen, [u; 4]).first();
            let point = BoundedPoint { p: point, error: self.error };
            return Some((point, 1.0 / seen.solid_angle.x, outside.test(0)));
        }
        let (seen, outside) = self.seen_from(p)?;
        let moved = seen.sample(u) - seen.start;
        let point = self.corner + moved.x * self.axes[0] + moved.y * self.axes[1];
        let point = BoundedPoint { p: point.as_vec3(), error: self.error };
        Some((point, (1.0 / seen.solid_angle) as f32, outside))
    }

    /// One sampled point for each of four receivers.
    #[inline(always)]
    fn points_x4(&self, seen: &SeenX4, u: [Vec2; 4]) -> Vec3x4 {
        let [x, y] = seen.sample(u);
        let [axis_x, axis_y] = self.axes.map(|axis| Vec3x4::splat(axis.as_vec3()));
        Vec3x4::splat(self.corner.as_vec3()) + axis_x * x + axis_y * y
    }

    /// The rectangle in coordinates relative to `p`, in f64, and whether `p` is on the outer side.
    #[inline]
    fn seen_from(&self, p: Vec3) -> Option<(Seen, bool)> {
        let offset = self.corner - p.as_dvec3();
        let start = DVec2::new(offset.dot(self.axes[0]), offset.dot(self.axes[1]));
        let z = offset.dot(self.normal);
        let seen = Seen::new(start, start + self.size, z);
        (seen.solid_angle > MIN_SOLID_ANGLE).then_some((seen, z < 0.0))
    }

    #[inline(always)]
    fn seen_from_x4(&self, p: Vec3x4) -> (SeenX4, BVec4A) {
        let offset = Vec3x4::splat(self.corner.as_vec3()) - p;
        let along = |axis: DVec3| offset.dot(Vec3x4::splat(axis.as_vec3()));
        let z = along(self.normal);
        let start = [along(self.axes[0]), along(self.axes[1])];
        (SeenX4::new(start, self.size.as_vec2(), z.abs()), z.cmplt(Vec4::ZERO))
    }

    /// Light samples for four points. Only points on the outer side receive light, unless `two_sided`. `None` if
    /// f32 is not accurate enough for one of them.
    #[inline(always)]
    pub(super) fn sample_x4(
        &self,
        p: Vec3x4,
        u: [Vec2; 4],
        radiance: Spectrum,
        two_sided: bool,
    ) -> Option<LightSamplesX4> {
        let (seen, outside) = self.seen_from_x4(p);
        if !seen.sound.all() {
            return None;
        }
        let points = self.points_x4(&seen, u);
        let to_light = points - p;
        // The range of lengths in which `unit` needs no rescaling.
        let length2 = to_light.length_squared();
        let fine = length2.cmpgt(Vec4::splat(1e-30)) & length2.cmplt(Vec4::splat(1e30));
        if !fine.all() {
            return None;
        }
        let error = Vec3x4::splat(self.error) + to_light.abs() * Vec4::splat(gamma(8));
        let point = BoundedPointx4 { p: points, error };
        Some(LightSamplesX4 {
            exists: if two_sided { BVec4A::TRUE } else { outside },
            li: [radiance; 4],
            wi: to_light.divided_by(length2.sqrt()),
            pdf: Vec4::ONE / seen.solid_angle,
            from: point.ray_origins(Vec3x4::splat(self.normal()), -to_light),
            is_near: BVec4A::TRUE,
        })
    }
}
