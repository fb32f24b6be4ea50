//! A rectangle, uniform over the solid angle that it subtends at a reference point.
//!
//! Ureña, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles". The
//! reference point is the origin, the x and y axes are parallel to the edges, and z is the distance
//! of the rectangle's plane. The rectangle between (0, 0) and (x, y) subtends the solid angle
//! atan(x y / (z r)), with r² = x² + y² + z². Let E(x) be that value for (x, y₁) minus that for (x,
//! y₀). From the left edge to the right one E grows by the solid angle Ω of the whole rectangle, so
//! the first coordinate is the solution of E(x) = E(x₀) + u₀ Ω. The paper instead uses the angles
//! of the spherical polygon. They are the same up to quarter turns, which cost small angles their
//! precision.
//!
//! The angles are added as products of complex numbers. Relative error of the uniform density in
//! f64: 2e-4 for solid angles from 2π down to 1 sr, 1e-5 below 1 sr, 3e-7 below 0.1 sr.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::simd::Float;

/// Solid angle in sr below which lights sample rectangles by area.
pub(crate) const MIN_SOLID_ANGLE: f64 = 1e-6;

/// A rectangle as it is seen from a reference point. Its warp is uniform over solid angle.
///
/// ```
/// use lobe::glam::{Vec3, vec2, vec3};
/// use lobe::sampling::SphericalRectangle;
///
/// // A face of the cube around the origin: a sixth of the sphere.
/// let corner = vec3(-1.0, -1.0, 1.0);
/// let face = SphericalRectangle::new(Vec3::ZERO, corner, 2.0 * Vec3::X, 2.0 * Vec3::Y).unwrap();
/// assert!((face.solid_angle() - 2.0 / 3.0 * std::f32::consts::PI).abs() < 1e-6);
///
/// let p = face.sample(vec2(0.5, 0.25));
/// assert!(p.z == 1.0 && p.x.abs() < 1e-6 && p.y < 0.0);
/// assert!(face.inverse(p).abs_diff_eq(vec2(0.5, 0.25), 1e-6));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    corner: DVec3,
    axes: [DVec3; 2],
    seen: Seen<f64>,
}

impl SphericalRectangle {
    /// The rectangle with the corner `corner` and from there the perpendicular edges `edge_x` and
    /// `edge_y`, seen from the reference point `origin`, which may be anywhere. `None` if the solid
    /// angle is zero, as it is from within the rectangle's plane, or if a number is not finite.
    pub fn new(origin: Vec3, corner: Vec3, edge_x: Vec3, edge_y: Vec3) -> Option<Self> {
        let (corner, x, y) = (corner.as_dvec3(), edge_x.as_dvec3(), edge_y.as_dvec3());
        let axes = [x.normalize_or_zero(), y.normalize_or_zero()];
        let offset = corner - origin.as_dvec3();
        let start = axes.map(|axis| offset.dot(axis));
        let end = [start[0] + x.length(), start[1] + y.length()];
        let seen = Seen::new(start, end, offset.dot(axes[0].cross(axes[1])).abs());
        (seen.solid_angle > 0.0).then_some(Self { corner, axes, seen })
    }

    /// The solid angle that the rectangle subtends, in sr: above 0, at most 2π.
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        self.seen.solid_angle as f32
    }

    /// Density over solid angle in 1/sr, constant over the rectangle.
    #[inline]
    pub fn pdf(&self) -> f32 {
        (1.0 / self.seen.solid_angle) as f32
    }

    /// The point of the rectangle that u in `[0, 1)²` is mapped to.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let [x, y] = self.seen.sample(u.as_dvec2().to_array());
        let [x0, y0] = self.seen.start;
        (self.corner + (x - x0) * self.axes[0] + (y - y0) * self.axes[1]).as_vec3()
    }

    /// The inverse of [`sample`](Self::sample): the u whose image is `p`, up to rounding, which
    /// matters for a small rectangle far from zero.
    pub fn inverse(&self, p: Vec3) -> Vec2 {
        let moved = p.as_dvec3() - self.corner;
        let place =
            DVec2::from(self.seen.start) + DVec2::from(self.axes.map(|axis| moved.dot(axis)));
        self.seen.inverse(place).as_vec2().clamp(Vec2::ZERO, Vec2::splat(ONE_MINUS_EPSILON))
    }
}

/// A rectangle in the plane at distance z, with edges parallel to the x and y axes, from `start` to
/// `end`. The reference point is the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen<F> {
    pub(crate) start: [F; 2],
    end: [F; 2],
    /// Distance of the plane.
    z: F,
    /// The complex number with argument E(x₀), of any magnitude.
    left: [F; 2],
    pub(crate) solid_angle: F,
}

/// Least solid angle in sr for which f32 is precise enough: above it the relative error of the
/// solid angle is at most 1e-5.
const LEAST_IN_F32: f32 = 0.05;
/// Greatest extent of a rectangle to the side, in units of the distance of its plane, for which f32
/// is precise enough: near the horizon precision is lost. Within it, a rectangle subtends at most
/// 5.6 sr.
const FARTHEST_IN_F32: f32 = 8.0;

impl<F: Float> Seen<F> {
    /// The rectangle from `start` to `end` at the distance `z`, which is not negative. The solid angle
    /// is 0 if z = 0, where the reference point is in the plane, and if a number is NaN.
    ///
    /// In f32, lengths should be in units of z, since products of four exceed its range.
    #[inline(always)]
    pub(crate) fn new(start: [F; 2], end: [F; 2], z: F) -> Self {
        let zero = F::splat(0.0);
        let ([x0, y0], [x1, y1]) = (start, end);
        let (left, right) = (strip(x0, y0, y1, z), strip(x1, y0, y1, z));
        let cross = left[0] * right[1] - left[1] * right[0];
        let angle = cross.atan2(left[0] * right[0] + left[1] * right[1]);
        // A negative angle stands for more than half a turn, if the foot of the perpendicular is in
        // the rectangle: only then are all four terms of the sum positive.
        let above = x0.le(zero) & y0.le(zero) & x1.ge(zero) & y1.ge(zero);
        let more = angle + F::constant(std::f64::consts::TAU);
        let angle = F::select(above & angle.lt(zero), more, angle);
        let solid_angle = F::select(z.gt(zero) & angle.gt(zero), angle, zero);
        Self { start, end, z, left, solid_angle }
    }

    /// Where f32 is precise enough, if z is 1. The values of other lanes must not be used.
    #[inline(always)]
    pub(crate) fn is_precise_in_f32(&self) -> F::Mask {
        let ([x0, y0], [x1, y1]) = (self.start, self.end);
        let extent = x0.abs().max(x1.abs()).max(y0.abs()).max(y1.abs());
        self.solid_angle.gt(F::splat(LEAST_IN_F32)) & extent.le(F::splat(FARTHEST_IN_F32))
    }

    /// The point between `start` and `end` that u is mapped to.
    #[inline(always)]
    pub(crate) fn sample(&self, [u0, u1]: [F; 2]) -> [F; 2] {
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        let ([x0, y0], [x1, y1], z2) = (self.start, self.end, self.z * self.z);
        // E(x), which is E(x₀) rotated by u₀ Ω.
        let [a, b] = self.left;
        let length = (a * a + b * b).sqrt();
        let [cos, sin] = (u0 * self.solid_angle / F::constant(std::f64::consts::TAU)).unit_circle();
        let e = [(cos * a - sin * b) / length, (cos * b + sin * a) / length];
        // Cosine and sine of the half angle, both times an arbitrary factor.
        let right = e[0].gt(zero);
        let c = F::select(right, one + e[0], e[1].abs());
        let s = F::select(right, e[1], (one - e[0]).copysign(e[1]));
        // Solves E = asin(s₁ k) - asin(s₀ k) for x. Here s and t are the sine and cosine of the
        // angle between the direction to y and the z axis, and k is the sine of the same angle for
        // x. The two arcsines are angles of a triangle with the sides s₁ and s₀, whose
        // circumscribed circle has the diameter 1 / k. √(1 - k²) is factored to avoid cancellation.
        let (r0, r1) = ((y0 * y0 + z2).sqrt(), (y1 * y1 + z2).sqrt());
        let span = across(y0, y1, r0, r1, z2) / (r0 * r1);
        let (sum, cosines) = (y0 / r0 + y1 / r1, self.z / r0 + self.z / r1);
        let outer = (span * c - cosines * s) * (span * c + cosines * s);
        let inner = (cosines * c - sum * s) * (cosines * c + sum * s);
        let root = (outer.max(zero) * inner.max(zero)).sqrt();
        let x = F::splat(2.0) * self.z * s * c * cosines / root;
        // Rounding can lead beyond the edges. For tiny solid angles x may be all rounding error.
        let x = x.max(x0).min(x1);
        // Along the line of this x, the sine of the angle of y is uniformly distributed.
        let depth2 = x * x + z2;
        let h0 = y0 / (depth2 + y0 * y0).sqrt();
        let h1 = y1 / (depth2 + y1 * y1).sqrt();
        let h = h0 + u1 * (h1 - h0);
        let y = h * (depth2 / ((one - h) * (one + h)).max(zero)).sqrt();
        [x, y.max(y0).min(y1)]
    }
}

impl Seen<f64> {
    /// The inverse of [`Seen::sample`].
    fn inverse(&self, p: DVec2) -> DVec2 {
        let [_, y0] = self.start;
        let [_, y1] = self.end;
        let part = Self::new(self.start, [p.x, y1], self.z).solid_angle;
        let h = |y: f64| y / DVec3::new(p.x, y, self.z).length();
        DVec2::new(part / self.solid_angle, (h(p.y) - h(y0)) / (h(y1) - h(y0)))
    }
}

/// The complex number with argument E(x) = atan(x y₁ / (z r₁)) - atan(x y₀ / (z r₀)).
#[inline(always)]
fn strip<F: Float>(x: F, y0: F, y1: F, z: F) -> [F; 2] {
    let distance2 = x * x + z * z;
    let (r0, r1) = ((distance2 + y0 * y0).sqrt(), (distance2 + y1 * y1).sqrt());
    [z * z * r0 * r1 + x * x * y0 * y1, x * z * across(y0, y1, r0, r1, distance2)]
}

/// y₁ r₀ - y₀ r₁ for r² = y² + `distance2`, without cancellation for y₀ close to y₁.
#[inline(always)]
fn across<F: Float>(y0: F, y1: F, r0: F, r1: F, distance2: F) -> F {
    let (a, b) = (y1 * r0, y0 * r1);
    let beside = distance2 * (y1 - y0) * (y1 + y0) / (a + b);
    F::select((y0 * y1).gt(F::splat(0.0)), beside, a - b)
}
