//! A rectangle, uniformly over the solid angle under which it is seen.
//!
//! Ureña, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical Rectangles". With the
//! origin at the eye, the x and y axes along the rectangle's edges and z its distance, the corner (x, y)
//! of a rectangle that begins below the eye covers the solid angle atan(x y / (z r)), r² = x² + y² + z².
//! So E(x), that of (x, y₁) minus that of (x, y₀), grows from the left edge to the right one by the solid
//! angle Ω of all, and the first coordinate is found from E(x) = E(x₀) + u₀ Ω. The paper's angles of the
//! spherical polygon are these up to quarter turns, which cost it the digits of small ones.
//!
//! The angles are added as products of complex numbers, in f64. What comes out is uniform to 2e-4 of Ω from
//! half of all directions down to 1 sr, to 1e-5 below that and to 3e-7 below 0.1 sr.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::geometry::float::ONE_MINUS_EPSILON;

/// Below this solid angle in sr, lights draw points by area.
pub(crate) const LEAST_SOLID_ANGLE: f64 = 1e-6;

/// A rectangle as it is seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    corner: DVec3,
    axes: [DVec3; 2],
    seen: Seen,
}

impl SphericalRectangle {
    /// The rectangle with the corner `corner` and, from there, the edges `edge_x` and `edge_y`, at right
    /// angles to each other, seen from `origin`, which may be anywhere. `None` when the solid angle
    /// is zero, as it is from the rectangle's own plane, or a number is not finite.
    pub fn new(origin: Vec3, corner: Vec3, edge_x: Vec3, edge_y: Vec3) -> Option<Self> {
        let (corner, x, y) = (corner.as_dvec3(), edge_x.as_dvec3(), edge_y.as_dvec3());
        let axes = [x.normalize_or_zero(), y.normalize_or_zero()];
        let offset = corner - origin.as_dvec3();
        let start = DVec2::new(offset.dot(axes[0]), offset.dot(axes[1]));
        let size = DVec2::new(x.length(), y.length());
        let seen = Seen::new(start, start + size, offset.dot(axes[0].cross(axes[1])));
        (seen.solid_angle > 0.0).then_some(Self { corner, axes, seen })
    }

    /// The solid angle in sr, above 0 and up to 2π.
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        self.seen.solid_angle as f32
    }

    /// Density over solid angle, the same everywhere on the rectangle.
    #[inline]
    pub fn pdf(&self) -> f32 {
        (1.0 / self.seen.solid_angle) as f32
    }

    /// A point of the rectangle.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let moved = self.seen.sample(u) - self.seen.start;
        (self.corner + moved.x * self.axes[0] + moved.y * self.axes[1]).as_vec3()
    }

    /// The u that [`sample`](Self::sample) takes to `p`, up to what rounding does to a small rectangle
    /// far from zero.
    pub fn inverse(&self, p: Vec3) -> Vec2 {
        let moved = p.as_dvec3() - self.corner;
        let place = self.seen.start + DVec2::from(self.axes.map(|axis| moved.dot(axis)));
        self.seen.inverse(place).as_vec2().clamp(Vec2::ZERO, Vec2::splat(ONE_MINUS_EPSILON))
    }
}

/// A rectangle parallel to the axes x and y, from `start` to `end`, seen from the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) start: DVec2,
    end: DVec2,
    /// Distance of its plane.
    z: f64,
    /// The complex number whose argument is E(x₀), of any length.
    left: DVec2,
    pub(crate) solid_angle: f64,
}

impl Seen {
    /// The solid angle is 0 from within the plane, z = 0, or where something is not a number.
    #[inline]
    pub(crate) fn new(start: DVec2, end: DVec2, z: f64) -> Self {
        let z = z.abs();
        let left = strip(start.x, start.y, end.y, z);
        let right = strip(end.x, start.y, end.y, z);
        let angle = left.perp_dot(right).atan2(left.dot(right));
        // More than a half turn: only the sum of four positive angles goes that far.
        let above = start.cmple(DVec2::ZERO).all() && end.cmpge(DVec2::ZERO).all();
        let angle = if above && angle < 0.0 { angle + std::f64::consts::TAU } else { angle };
        let solid_angle = if z > 0.0 { angle.max(0.0) } else { 0.0 };
        Self { start, end, z, left, solid_angle }
    }

    /// A point between `start` and `end`.
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> DVec2 {
        let (y0, y1, z2) = (self.start.y, self.end.y, self.z * self.z);
        // E(x), a turn of E(x₀).
        let e = self.left.normalize();
        let e = DVec2::from_angle(f64::from(u.x) * self.solid_angle).rotate(e);
        // The half angle's cosine and sine, of any common length.
        let [c, s] =
            if e.x > 0.0 { [1.0 + e.x, e.y] } else { [e.y.abs(), (1.0 - e.x).copysign(e.y)] };
        // x from E = asin(s₁ k) - asin(s₀ k), where s is the sine of the angle of y against the z axis, t its
        // cosine, and k the sine of that of x: two angles of a triangle with the sides s₁ and s₀, whose
        // circumscribed circle has the diameter 1 / k. √(1 - k²) factored, so that no digits are lost.
        let (r0, r1) = ((y0 * y0 + z2).sqrt(), (y1 * y1 + z2).sqrt());
        let span = across(y0, y1, r0, r1, z2) / (r0 * r1);
        let (sum, cosines) = (y0 / r0 + y1 / r1, self.z / r0 + self.z / r1);
        let outer = (span * c - cosines * s) * (span * c + cosines * s);
        let inner = (cosines * c - sum * s) * (cosines * c + sum * s);
        let x = 2.0 * self.z * s * c * cosines / (outer.max(0.0) * inner.max(0.0)).sqrt();
        // Beyond the edges by rounding, or all of it noise.
        let x = x.max(self.start.x).min(self.end.x);
        // On the line of this x, the sine of the angle of y is uniform.
        let depth2 = x * x + z2;
        let h0 = y0 / (depth2 + y0 * y0).sqrt();
        let h1 = y1 / (depth2 + y1 * y1).sqrt();
        let h = h0 + f64::from(u.y) * (h1 - h0);
        let y = h * (depth2 / ((1.0 - h) * (1.0 + h)).max(0.0)).sqrt();
        DVec2::new(x, y.max(y0).min(y1))
    }

    /// The u that [`Seen::sample`] takes to `p`.
    fn inverse(&self, p: DVec2) -> DVec2 {
        let part = Self::new(self.start, DVec2::new(p.x, self.end.y), self.z).solid_angle;
        let h = |y: f64| y / DVec3::new(p.x, y, self.z).length();
        let (h0, h1) = (h(self.start.y), h(self.end.y));
        DVec2::new(part / self.solid_angle, (h(p.y) - h0) / (h1 - h0))
    }
}

/// The complex number with the argument E(x) = atan(x y₁ / (z r₁)) - atan(x y₀ / (z r₀)).
#[inline]
fn strip(x: f64, y0: f64, y1: f64, z: f64) -> DVec2 {
    let distance2 = x * x + z * z;
    let (r0, r1) = ((distance2 + y0 * y0).sqrt(), (distance2 + y1 * y1).sqrt());
    DVec2::new(z * z * r0 * r1 + x * x * y0 * y1, x * z * across(y0, y1, r0, r1, distance2))
}

/// y₁ r₀ - y₀ r₁ for r² = y² + `distance2`, without the loss of digits where y₀ is close to y₁.
#[inline]
fn across(y0: f64, y1: f64, r0: f64, r1: f64, distance2: f64) -> f64 {
    if y0 * y1 > 0.0 {
        distance2 * (y1 - y0) * (y1 + y0) / (y1 * r0 + y0 * r1)
    } else {
        y1 * r0 - y0 * r1
    }
}
