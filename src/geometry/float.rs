//! Rounding of f32: constants and error bounds.

/// Unit roundoff u = 2⁻²⁴: the largest relative error of one correctly rounded operation.
pub const UNIT_ROUNDOFF: f32 = 0.5 * f32::EPSILON;

/// The largest float below 1, 1 - 2⁻²⁴. It is the largest value of a sample in `[0, 1)`.
pub const ONE_MINUS_EPSILON: f32 = 1.0 - UNIT_ROUNDOFF;

/// The largest magnitude of a coordinate of vertices and cameras, in scene units.
///
/// The ray-triangle test multiplies three lengths, and far beyond this limit the product overflows
/// f32. For lengths below about 1e-12 it underflows to zero.
pub const MAX_COORDINATE: f32 = 1e12;

/// [`MAX_COORDINATE`] as the decimal that it was rounded from, for ranges of keys.
pub const MAX_COORDINATE_F64: f64 = 1e12;
const _: () = assert!(MAX_COORDINATE_F64 as f32 == MAX_COORDINATE);

/// The bound γₙ = n u / (1 - n u) on the relative error that `n` rounded operations in a row
/// accumulate, with u = [`UNIT_ROUNDOFF`].
///
/// Valid while n u < 1; meant for small `n` (Higham, *Accuracy and Stability of Numerical
/// Algorithms*, section 3.1; PBRT 3rd edition, section 3.9.1).
#[inline]
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT_ROUNDOFF;
    nu / (1.0 - nu)
}
