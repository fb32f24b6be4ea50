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
//! The angles are added as products of complex numbers, in f64. Relative error of the uniform
//! density: 2e-4 for solid angles from 2π down to 1 sr, 1e-5 below 1 sr, 3e-7 below 0.1 sr.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::geometry::float::ONE_MINUS_EPSILON;

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
    seen: Seen,
}

impl SphericalRectangle {
    /// The rectangle with the corner `corner` and from there the perpendicular edges `edge_x` and
    /// `edge_y`, seen from the reference point `origin`, which may be anywhere. `None` if the solid
    /// angle is zero, as it is from within the rectangle's plane, or if a number is not finite.
    pub fn new(origin: Vec3, corner: Vec3, edge_x: Vec3, edge_y: Vec3) -> Option<Self> {
        let (corner, x, y) = (corner.as_dvec3(), edge_x.as_dvec3(), edge_y.as_dvec3());
        let axes = [x.normalize_or_zero(), y.normalize_or_zero()];
        let offset = corner - origin.as_dvec3();
        let start = DVec2::new(offset.dot(axes[0]), offset.dot(axes[1]));
        let size = DVec2::new(x.length(), y.length());
        let seen = Seen::new(start, start + size, offset.dot(axes[0].cross(axes[1])));
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
        let moved = self.seen.sample(u) - self.seen.start;
        (self.corner + moved.x * self.axes[0] + moved.y * self.axes[1]).as_vec3()
    }

    /// The inverse of [`sample`](Self::sample): the u whose image is `p`, up to rounding, which
    /// matters for a small rectangle far from zero.
    pub fn inverse(&self, p: Vec3) -> Vec2 {
        let moved = p.as_dvec3() - self.corner;
        let place = self.seen.start + DVec2::from(self.axes.map(|axis| moved.dot(axis)));
        self.seen.inverse(place).as_vec2().clamp(Vec2::ZERO, Vec2::splat(ONE_MINUS_EPSILON))
    }
}

/// A rectangle in the plane at distance z, with edges parallel to the x and y axes, from `start` to
/// `end`. The reference point is the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) start: DVec2,
    end: DVec2,
    /// Distance of the plane.
    z: f64,
    /// The complex number with argument E(x₀), of any magnitude.
    left: DVec2,
    pub(crate) solid_angle: f64,
}

impl Seen {
    /// The solid angle is 0 if z = 0, where the reference point is in the plane, and if a number is
    /// NaN.
    #[inline]
    pub(crate) fn new(start: DVec2, end: DVec2, z: f64) -> Self {
        let z = z.abs();
        let left = strip(start.x, start.y, end.y, z);
        let right = strip(end.x, start.y, end.y, z);
        let angle = left.perp_dot(right).atan2(left.dot(right));
        // A negative angle stands for more than half a turn, if the foot of the perpendicular is in
        // the rectangle: only then are all four terms of the sum positive.
        let above = start.cmple(DVec2::ZERO).all() && end.cmpge(DVec2::ZERO).all();
        let angle = if above && angle < 0.0 { angle + std::f64::consts::TAU } else { angle };
        let solid_angle = if z > 0.0 { angle.max(0.0) } else { 0.0 };
        Self { start, end, z, left, solid_angle }
    }

    /// The point between `start` and `end` that u is mapped to.
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> DVec2 {
        let (y0, y1, z2) = (self.start.y, self.end.y, self.z * self.z);
        // E(x), which is E(x₀) rotated by u₀ Ω.
        let e = self.left.normalize();
        let e = DVec2::from_angle(f64::from(u.x) * self.solid_angle).rotate(e);
        // Cosine and sine of the half angle, both times an arbitrary factor.
        let [c, s] =
            if e.x > 0.0 { [1.0 + e.x, e.y] } else { [e.y.abs(), (1.0 - e.x).copysign(e.y)] };
        // Solves E = asin(s₁ k) - asin(s₀ k) for x. Here s and t are the sine and cosine of the
        // angle between the direction to y and the z axis, and k is the sine of the same angle for
        // x. The two arcsines are angles of a triangle with the sides s₁ and s₀, whose
        // circumscribed circle has the diameter 1 / k. √(1 - k²) is factored to avoid cancellation.
        let (r0, r1) = ((y0 * y0 + z2).sqrt(), (y1 * y1 + z2).sqrt());
        let span = across(y0, y1, r0, r1, z2) / (r0 * r1);
        let (sum, cosines) = (y0 / r0 + y1 / r1, self.z / r0 + self.z / r1);
        let outer = (span * c - cosines * s) * (span * c + cosines * s);
        let inner = (cosines * c - sum * s) * (cosines * c + sum * s);
        let x = 2.0 * self.z * s * c * cosines / (outer.max(0.0) * inner.max(0.0)).sqrt();
        // Rounding can lead beyond the edges. For tiny solid angles x may be all rounding error.
        let x = x.max(self.start.x).min(self.end.x);
        // Along the line of this x, the sine of the angle of y is uniformly distributed.
        let depth2 = x * x + z2;
        let h0 = y0 / (depth2 + y0 * y0).sqrt();
        let h1 = y1 / (depth2 + y1 * y1).sqrt();
        let h = h0 + f64::from(u.y) * (h1 - h0);
        let y = h * (depth2 / ((1.0 - h) * (1.0 + h)).max(0.0)).sqrt();
        DVec2::new(x, y.max(y0).min(y1))
    }

    /// The inverse of [`Seen::sample`].
    fn inverse(&self, p: DVec2) -> DVec2 {
        let part = Self::new(self.start, DVec2::new(p.x, self.end.y), self.z).solid_angle;
        let h = |y: f64| y / DVec3::new(p.x, y, self.z).length();
        let (h0, h1) = (h(self.start.y), h(self.end.y));
        DVec2::new(part / self.solid_angle, (h(p.y) - h0) / (h1 - h0))
    }
}

/// The complex number with argument E(x) = atan(x y₁ / (z r₁)) - atan(x y₀ / (z r₀)).
#[inline]
fn strip(x: f64, y0: f64, y1: f64, z: f64) -> DVec2 {
    let distance2 = x * x + z * z;
    let (r0, r1) = ((distance2 + y0 * y0).sqrt(), (distance2 + y1 * y1).sqrt());
    DVec2::new(z * z * r0 * r1 + x * x * y0 * y1, x * z * across(y0, y1, r0, r1, distance2))
}

/// y₁ r₀ - y₀ r₁ for r² = y² + `distance2`, without cancellation for y₀ close to y₁.
#[inline]
fn across(y0: f64, y1: f64, r0: f64, r1: f64, distance2: f64) -> f64 {
    if y0 * y1 > 0.0 {
        distance2 * (y1 - y0) * (y1 + y0) / (y1 * r0 + y0 * r1)
    } else {
        y1 * r0 - y0 * r1
    }
}
