//! [`Rectangle`]: two triangles that are one.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::geometry::BoundedPoint;
use crate::geometry::float::gamma;
use crate::sampling::{LEAST_SOLID_ANGLE, Seen};

/// By how much of its shorter edge a corner may be out of place.
const MOST_SKEW: f64 = 1e-4;

/// A rectangle, prepared for points that see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    corner: DVec3,
    axes: [DVec3; 2],
    normal: DVec3,
    size: DVec2,
    /// Bounds on the error of its points, by axis.
    error: Vec3,
}

impl Rectangle {
    /// The rectangle that two triangles with the outward normal `outward` make up, if they do: they share
    /// their longest side, the other two of each are at right angles, and all four corners are where they
    /// have to be, up to the rounding of their coordinates. Corners are compared by place.
    pub(super) fn new(triangles: [[Vec3; 3]; 2], outward: Vec3) -> Option<Self> {
        let [first, second] = triangles;
        // The corner that each has for itself, and the two that both have.
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
        let slack = rounding.min(MOST_SKEW * size.min_element());
        let skew = edge_x.dot(edge_y).abs() / size.max_element();
        if shift.abs().max_element() > slack || skew > 2.0 * slack {
            return None;
        }

        let x = edge_x.normalize();
        let normal = x.cross(edge_y).normalize();
        let normal = if normal.dot(outward.as_dvec3()) < 0.0 { -normal } else { normal };
        let y = (edge_y - x * x.dot(edge_y)).normalize();
        let error = gamma(8) * largest + 2.0 * Vec3::splat(slack as f32).min(gamma(8) * largest);
        Some(Self { corner, axes: [x, y], normal, size, error })
    }

    /// The rectangle as `p` sees it; `None` where light points are better drawn by area: under a solid
    /// angle that is small, or zero. The second is whether `p` is on the outer side.
    #[inline]
    pub(super) fn seen_from(&self, p: Vec3) -> Option<(Seen, bool)> {
        let offset = self.corner - p.as_dvec3();
        let start = DVec2::new(offset.dot(self.axes[0]), offset.dot(self.axes[1]));
        let z = offset.dot(self.normal);
        let seen = Seen::new(start, start + self.size, z);
        (seen.solid_angle > LEAST_SOLID_ANGLE).then_some((seen, z < 0.0))
    }

    /// A point of the rectangle, and its unit outward normal.
    #[inline]
    pub(super) fn sample(&self, seen: &Seen, u: Vec2) -> (BoundedPoint, Vec3) {
        let moved = seen.sample(u) - seen.start;
        let p = self.corner + moved.x * self.axes[0] + moved.y * self.axes[1];
        (BoundedPoint { p: p.as_vec3(), error: self.error }, self.normal.as_vec3())
    }
}
