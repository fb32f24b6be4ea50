//! The unit square, with a density that is bilinear between values at its corners.
//!
//! `corners[j][i]` is the value at (i, j), up to a common factor. The marginal density of y is linear from the sum of one
//! row to that of the other, and the conditional density of x is linear between the values at y on both sides. Both are
//! inverted in closed form. In f64, since the points of a square may be a small part of a large domain.

use glam::DVec2;

/// A point.
#[inline]
pub fn sample(u: DVec2, corners: [[f64; 2]; 2]) -> DVec2 {
    let y = sample_linear(u.y, rows(corners));
    DVec2::new(sample_linear(u.x, at(y, corners)), y)
}

/// Density over area; 0 if no corner is positive.
#[inline]
pub fn pdf(p: DVec2, corners: [[f64; 2]; 2]) -> f64 {
    let [top, bottom] = rows(corners);
    let sum = top + bottom;
    if sum > 0.0 { 4.0 * lerp(p.x, at(p.y, corners)) / sum } else { 0.0 }
}

/// The inverse of [`sample`]: the u whose image is `p`.
#[inline]
pub fn inverse(p: DVec2, corners: [[f64; 2]; 2]) -> DVec2 {
    let along = inverse_linear(p.x, at(p.y, corners));
    DVec2::new(along, inverse_linear(p.y, rows(corners)))
}

/// The sums of the values at y = 0 and at y = 1.
#[inline]
fn rows(corners: [[f64; 2]; 2]) -> [f64; 2] {
    corners.map(|[left, right]| left + right)
}

/// The values at y on both sides.
#[inline]
fn at(y: f64, [top, bottom]: [[f64; 2]; 2]) -> [f64; 2] {
    [lerp(y, [top[0], bottom[0]]), lerp(y, [top[1], bottom[1]])]
}

#[inline]
fn lerp(x: f64, [a, b]: [f64; 2]) -> f64 {
    (1.0 - x) * a + x * b
}

/// A number in `[0, 1]` with a density that is linear from a to b: x (a (2 - x) + b x) / (a + b) = u, solved without
/// cancellation.
#[inline]
fn sample_linear(u: f64, [a, b]: [f64; 2]) -> f64 {
    let divisor = a + lerp(u, [a * a, b * b]).sqrt();
    // Along a side without density, which no sample is on.
    if divisor > 0.0 { (u * (a + b) / divisor).min(1.0) } else { u }
}

#[inline]
fn inverse_linear(x: f64, [a, b]: [f64; 2]) -> f64 {
    if a + b > 0.0 { x * (a * (2.0 - x) + b * x) / (a + b) } else { x }
}
