//! Smooth curves with a radius: the bones that every part of the dragon grows on.
//!
//! A curve is a natural cubic spline through its keys, (x, y, z, radius) each, with chord-length
//! knots. It is C2, so the distance field around it has continuous normals and curvature.

use glam::{DVec3, DVec4, Vec4Swizzles};

/// One cubic piece, as a polynomial in t in \[0, 1\].
pub struct Span {
    coefficients: [DVec4; 4],
}

impl Span {
    /// Position and radius at t.
    pub fn at(&self, t: f64) -> DVec4 {
        let [c0, c1, c2, c3] = self.coefficients;
        c0 + t * (c1 + t * (c2 + t * c3))
    }

    /// Derivative by t of position and radius.
    pub fn derivative(&self, t: f64) -> DVec4 {
        let [_, c1, c2, c3] = self.coefficients;
        c1 + t * (2.0 * c2 + t * 3.0 * c3)
    }

    /// Parameter of the point of this span that is closest to `p`: from the foot of `p` on the
    /// chord, Newton's method on the derivative of the squared distance, kept within \[0, 1\].
    /// Meant for spans that turn by less than a right angle.
    pub fn closest(&self, p: DVec3) -> f64 {
        let start = self.coefficients[0].xyz();
        let chord = self.at(1.0).xyz() - start;
        let mut t = ((p - start).dot(chord) / chord.length_squared()).clamp(0.0, 1.0);
        let [_, _, c2, c3] = self.coefficients.map(|c| c.xyz());
        for _ in 0..6 {
            let offset = self.at(t).xyz() - p;
            let first = self.derivative(t).xyz();
            let second = 2.0 * c2 + 6.0 * t * c3;
            // Where the curvature term makes the minimum a maximum, fall back to Gauss-Newton.
            let slope = offset.dot(first);
            let full = first.length_squared() + offset.dot(second);
            let bend = full.max(0.3 * first.length_squared());
            let next = (t - slope / bend).clamp(0.0, 1.0);
            let moved = (next - t).abs();
            t = next;
            if moved < 1e-9 {
                break;
            }
        }
        t
    }

    /// How much longer the surface is than the curve at `offset` from the point at t: below 1
    /// within a bend, above 1 outside it.
    pub fn stretch(&self, t: f64, offset: DVec3) -> f64 {
        let [_, _, c2, c3] = self.coefficients.map(|c| c.xyz());
        let second = 2.0 * c2 + 6.0 * t * c3;
        1.0 - second.dot(offset) / self.derivative(t).xyz().length_squared()
    }
}

/// The spline through `keys`, one span between each two. At least two keys, no two neighbours at
/// the same place.
pub fn interpolate(keys: &[DVec4]) -> Vec<Span> {
    let chord: Vec<f64> = keys.windows(2).map(|k| k[0].xyz().distance(k[1].xyz())).collect();
    let bends = second_derivatives(keys, &chord);
    (0..chord.len())
        .map(|i| {
            let h2 = chord[i] * chord[i];
            let (m0, m1) = (bends[i], bends[i + 1]);
            let rise = keys[i + 1] - keys[i];
            Span {
                coefficients: [
                    keys[i],
                    rise - h2 * (2.0 * m0 + m1) / 6.0,
                    h2 * m0 / 2.0,
                    h2 * (m1 - m0) / 6.0,
                ],
            }
        })
        .collect()
}

/// Second derivatives at the keys of the natural spline: a tridiagonal system, solved by Thomas's
/// algorithm.
fn second_derivatives(keys: &[DVec4], chord: &[f64]) -> Vec<DVec4> {
    let n = keys.len();
    let mut upper = vec![0.0; n];
    let mut m = vec![DVec4::ZERO; n];
    for i in 1..n - 1 {
        let (h0, h1) = (chord[i - 1], chord[i]);
        let right = 6.0 * ((keys[i + 1] - keys[i]) / h1 - (keys[i] - keys[i - 1]) / h0);
        let pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
        upper[i] = h1 / pivot;
        m[i] = (right - h0 * m[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        m[i] = m[i] - upper[i] * m[i + 1];
    }
    m
}
