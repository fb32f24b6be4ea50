//! Signed distance functions of the pieces, and how two fields are joined.
//!
//! Round cone, ellipsoid and the polynomial smooth minimum are those of Quilez, "Distance
//! functions" and "Smooth minimum".

use glam::{DMat3, DVec3};

/// A piece with a distance function. Negative inside.
pub enum Shape {
    /// Span `span` of tube `tube` of the sculpture.
    Tube { tube: usize, span: usize },
    /// The hull of two balls.
    Cone { a: DVec3, b: DVec3, ra: f64, rb: f64 },
    /// An ellipsoid; the columns of `frame` are its unit axes.
    Ellipsoid { centre: DVec3, frame: DMat3, radii: DVec3 },
    /// Everything beyond the plane at `offset` along the unit vector `normal`.
    Beyond { normal: DVec3, offset: f64 },
}

/// Distance to the hull of the balls (a, ra) and (b, rb).
pub fn round_cone(p: DVec3, a: DVec3, b: DVec3, ra: f64, rb: f64) -> f64 {
    let axis = b - a;
    let l2 = axis.length_squared();
    let dr = ra - rb;
    let a2 = l2 - dr * dr;
    let from_a = p - a;
    let y = from_a.dot(axis);
    let z = y - l2;
    let x2 = (from_a * l2 - axis * y).length_squared();
    let (y2, z2) = (y * y * l2, z * z * l2);
    let k = dr.signum() * dr * dr * x2;
    if z.signum() * a2 * z2 > k {
        (x2 + z2).sqrt() / l2 - rb
    } else if y.signum() * a2 * y2 < k {
        (x2 + y2).sqrt() / l2 - ra
    } else {
        ((x2 * a2 / l2).sqrt() + y * dr) / l2 - ra
    }
}

/// Estimated distance to an ellipsoid, exact to first order at its surface.
pub fn ellipsoid(p: DVec3, centre: DVec3, frame: &DMat3, radii: DVec3) -> f64 {
    let q = frame.transpose() * (p - centre);
    let k0 = (q / radii).length();
    let k1 = (q / (radii * radii)).length();
    if k1 < 1e-12 { -radii.min_element() } else { k0 * (k0 - 1.0) / k1 }
}

/// The minimum of `a` and `b`, with the crease between them filled over a width of `k`. Equal to
/// the minimum, to the bit, where they differ by `k` or more.
pub fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = k - (a - b).abs();
    if h <= 0.0 { a.min(b) } else { a.min(b) - h * h / (4.0 * k) }
}

/// The maximum, likewise.
pub fn smooth_max(a: f64, b: f64, k: f64) -> f64 {
    -smooth_min(-a, -b, k)
}
