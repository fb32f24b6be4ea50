//! Bounds on what rounding does to 32-bit floats.

/// Unit roundoff: the largest relative error of one correctly rounded operation, 2⁻²⁴.
pub const UNIT_ROUNDOFF: f32 = 0.5 * f32::EPSILON;

/// The largest float below 1, and the largest value that a uniform sample takes.
pub const ONE_MINUS_EPSILON: f32 = 1.0 - UNIT_ROUNDOFF;

/// The largest coordinate that vertices and cameras may have. The ray-triangle test multiplies three
/// lengths, and far beyond this their product leaves the range of f32. Below about 1e-12 it vanishes.
pub const LARGEST_COORDINATE: f32 = 1e12;

/// Bound γₙ = n u / (1 - n u) on the relative error of `n` rounded operations in a row.
///
/// Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.1; PBRT 3rd edition, section 3.9.1.
/// It is meant for small `n`: the bound holds while n u < 1.
#[inline]
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT_ROUNDOFF;
    nu / (1.0 - nu)
}
