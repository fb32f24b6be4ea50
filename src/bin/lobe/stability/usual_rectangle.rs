//! Common methods to sample a rectangle by its solid angle, in f32.

use std::f32::consts::{PI, TAU};

use lobe::glam::{Vec2, Vec3};

/// A spherical rectangle, after the listings in the appendix of Ureña, Fajardo and King 2013, "An Area-Preserving
/// Parametrization for Spherical Rectangles".
pub struct UsualRectangle {
    o: Vec3,
    axes: [Vec3; 3],
    z0: f32,
    x: [f32; 2],
    y: [f32; 2],
    b0: f32,
    b1: f32,
    k: f32,
    /// The solid angle.
    pub s: f32,
}

impl UsualRectangle {
    /// The rectangle with the corner `corner` and the edges `ex` and `ey`, seen from `o`.
    pub fn new(o: Vec3, corner: Vec3, ex: Vec3, ey: Vec3) -> Self {
        let (exl, eyl) = (ex.length(), ey.length());
        let (x, y) = (ex / exl, ey / eyl);
        let mut z = x.cross(y);
        let d = corner - o;
        let mut z0 = d.dot(z);
        if z0 > 0.0 {
            z = -z;
            z0 = -z0;
        }
        let (x0, y0) = (d.dot(x), d.dot(y));
        let (x1, y1) = (x0 + exl, y0 + eyl);
        let [v00, v01, v10, v11] =
            [(x0, y0), (x0, y1), (x1, y0), (x1, y1)].map(|(x, y)| Vec3::new(x, y, z0));
        let normal = |a: Vec3, b: Vec3| {
            let n = a.cross(b);
            n / n.length()
        };
        let (n0, n1, n2, n3) =
            (normal(v00, v10), normal(v10, v11), normal(v11, v01), normal(v01, v00));
        let angle = |a: Vec3, b: Vec3| (-a.dot(b)).acos();
        let (g0, g1, g2, g3) = (angle(n0, n1), angle(n1, n2), angle(n2, n3), angle(n3, n0));
        let k = TAU - g2 - g3;
        let (b0, b1) = (n0.z, n2.z);
        Self { o, axes: [x, y, z], z0, x: [x0, x1], y: [y0, y1], b0, b1, k, s: g0 + g1 - k }
    }

    /// A point of the rectangle.
    pub fn sample(&self, u: Vec2) -> Vec3 {
        const EPSILON: f32 = 1e-6;
        let ([x0, x1], [y0, y1], z0) = (self.x, self.y, self.z0);
        // 1. compute cu
        let au = u.x * self.s + self.k;
        let fu = (au.cos() * self.b0 - self.b1) / au.sin();
        let cu = 1.0 / (fu * fu + self.b0 * self.b0).sqrt() * if fu > 0.0 { 1.0 } else { -1.0 };
        let cu = cu.clamp(-1.0, 1.0);
        // 2. compute xu
        let xu = clamp(-(cu * z0) / (1.0 - cu * cu).sqrt(), x0, x1);
        // 3. compute yv
        let d = (xu * xu + z0 * z0).sqrt();
        let (h0, h1) = (y0 / (d * d + y0 * y0).sqrt(), y1 / (d * d + y1 * y1).sqrt());
        let hv = h0 + u.y * (h1 - h0);
        let hv2 = hv * hv;
        let yv = if hv2 < 1.0 - EPSILON { hv * d / (1.0 - hv2).sqrt() } else { y1 };
        // 4. transform to world coordinates
        self.o + xu * self.axes[0] + yv * self.axes[1] + z0 * self.axes[2]
    }
}

/// `clamp` as in C: NaN stays NaN.
fn clamp(x: f32, low: f32, high: f32) -> f32 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

/// A spherical triangle: solid angle by Girard's theorem (the excess of its angles over π), samples after Arvo 1995,
/// "Stratified Sampling of Spherical Triangles".
pub struct UsualTriangle {
    corners: [Vec3; 3],
    alpha: f32,
    cos_c: f32,
    /// The solid angle.
    pub area: f32,
}

impl UsualTriangle {
    /// The triangle as seen from `o`.
    pub fn new(o: Vec3, corners: [Vec3; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| {
            let d = corner - o;
            d / d.length()
        });
        // The angles between the planes of its sides.
        let normal = |p: Vec3, q: Vec3| {
            let n = p.cross(q);
            n / n.length()
        };
        let (ab, bc, ca) = (normal(a, b), normal(b, c), normal(c, a));
        let angle = |p: Vec3, q: Vec3| (-p.dot(q)).clamp(-1.0, 1.0).acos();
        let (alpha, beta, gamma) = (angle(ab, ca), angle(ab, bc), angle(bc, ca));
        Self { corners: [a, b, c], alpha, cos_c: a.dot(b), area: alpha + beta + gamma - PI }
    }

    /// A unit direction.
    pub fn sample(&self, u: Vec2) -> Vec3 {
        let [a, b, c] = self.corners;
        let area = u.x * self.area;
        let (s, t) = (area - self.alpha).sin_cos();
        let (sin_alpha, cos_alpha) = self.alpha.sin_cos();
        let (v, w) = (t - cos_alpha, s + sin_alpha * self.cos_c);
        let q = ((w * t - v * s) * cos_alpha - w) / ((w * s + v * t) * sin_alpha);
        let q = q.clamp(-1.0, 1.0);
        let across = |x: Vec3, y: Vec3| {
            let d = x - x.dot(y) * y;
            d / d.length()
        };
        let c_hat = q * a + (1.0 - q * q).max(0.0).sqrt() * across(c, a);
        let z = 1.0 - u.y * (1.0 - c_hat.dot(b));
        z * b + (1.0 - z * z).max(0.0).sqrt() * across(c_hat, b)
    }
}
