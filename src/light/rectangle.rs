//! [`Rectangle`]: two triangles that form a rectangle, sampled by solid angle.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::geometry::float::gamma;
use crate::geometry::{Bounded, BoundedPoint, Xyz};
use crate::sampling::{MIN_SOLID_ANGLE, Seen};
use crate::simd::Float;

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
        let (seen, _, outside) = self.seen_from_unit(p.into());
        if seen.is_precise_in_f32() {
            return Some((1.0 / seen.solid_angle, outside));
        }
        let (seen, outside) = self.seen_from(p)?;
        Some(((1.0 / seen.solid_angle) as f32, outside))
    }

    /// A point sampled uniformly by the solid angle that the rectangle subtends at `p`, its density, and
    /// whether `p` is on the outer side; `None` as for [`pdf`](Self::pdf). In f64.
    pub(super) fn sample(&self, p: Vec3, u: Vec2) -> Option<(BoundedPoint, f32, bool)> {
        let (seen, outside) = self.seen_from(p)?;
        let [x, y] = seen.sample(u.as_dvec2().to_array());
        let [x0, y0] = seen.start;
        let point = self.corner + (x - x0) * self.axes[0] + (y - y0) * self.axes[1];
        let point = BoundedPoint { p: point.as_vec3(), error: self.error };
        Some((point, (1.0 / seen.solid_angle) as f32, outside))
    }

    /// [`sample`](Self::sample) in each lane, and where f32 is precise enough for it.
    #[inline(always)]
    pub(super) fn sample_wide<F: Float>(&self, p: Xyz<F>, u: [F; 2]) -> (OnRectangle<F>, F::Mask) {
        let (seen, distance, outside) = self.seen_from_unit(p);
        let ([x, y], [x0, y0]) = (seen.sample(u), seen.start);
        let p = Xyz::constant(self.corner)
            + Xyz::constant(self.axes[0]) * ((x - x0) * distance)
            + Xyz::constant(self.axes[1]) * ((y - y0) * distance);
        let point = Bounded { p, error: Xyz::splat(self.error) };
        let pdf = F::splat(1.0) / seen.solid_angle;
        (OnRectangle { point, pdf, outside }, seen.is_precise_in_f32())
    }

    /// The rectangle in coordinates relative to `p`, in f64, and whether `p` is on the outer side.
    #[inline]
    fn seen_from(&self, p: Vec3) -> Option<(Seen<f64>, bool)> {
        let p = p.as_dvec3();
        let ([start, end], z) = self.relative_to(Xyz { x: p.x, y: p.y, z: p.z });
        let seen = Seen::new(start, end, z.abs());
        (seen.solid_angle > MIN_SOLID_ANGLE).then_some((seen, z < 0.0))
    }

    /// The rectangle in coordinates relative to `p`, in units of the distance of its plane; this distance, and whether `p`
    /// is on the outer side.
    #[inline(always)]
    fn seen_from_unit<F: Float>(&self, p: Xyz<F>) -> (Seen<F>, F, F::Mask) {
        let ([[x0, y0], _], z) = self.relative_to(p);
        let distance = z.abs();
        let (x0, y0) = (x0 / distance, y0 / distance);
        let end =
            [x0 + F::constant(self.size.x) / distance, y0 + F::constant(self.size.y) / distance];
        (Seen::new([x0, y0], end, F::splat(1.0)), distance, z.lt(F::splat(0.0)))
    }

    /// The corner where x and y are least and the opposite one, along the edges, and the height along the normal: all seen
    /// from `p`.
    #[inline(always)]
    fn relative_to<F: Float>(&self, p: Xyz<F>) -> ([[F; 2]; 2], F) {
        let offset = Xyz::constant(self.corner) - p;
        let x = offset.dot(Xyz::constant(self.axes[0]));
        let y = offset.dot(Xyz::constant(self.axes[1]));
        let end = [x + F::constant(self.size.x), y + F::constant(self.size.y)];
        ([[x, y], end], offset.dot(Xyz::constant(self.normal)))
    }
}

/// A point that was sampled in each lane.
pub(super) struct OnRectangle<F: Float> {
    pub point: Bounded<F>,
    pub pdf: F,
    /// Whether the receiver is on the outer side.
    pub outside: F::Mask,
}
