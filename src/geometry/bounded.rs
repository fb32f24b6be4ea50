//! [`BoundedPoint`]: a point on a surface with bounds on its rounding error.

use glam::Vec3;

use super::float::gamma;
use super::xyz::Xyz;
use crate::simd::{Bits, Float};

/// A computed point with a conservative bound on its absolute error per axis: the exact point lies
/// in the box `p ± error`.
///
/// With it, a ray can start just outside the surface without an epsilon that depends on the scale
/// of the scene (PBRT 3rd edition, sections 3.9.4 and 3.9.5).
///
/// ```
/// use lobe::geometry::BoundedPoint;
/// use lobe::glam::{Vec3, vec3};
///
/// let corners = [vec3(0.0, 0.0, 5.0), vec3(1.0, 0.0, 5.0), vec3(0.0, 1.0, 5.0)];
/// let hit = BoundedPoint::on_triangle(corners, [0.25, 0.25, 0.5]);
/// assert_eq!(hit.p, vec3(0.25, 0.5, 5.0));
///
/// // A ray that leaves upwards starts above the plane z = 5, but by less than 1e-5.
/// let o = hit.ray_origin(Vec3::Z, Vec3::Z);
/// assert!(o.z > 5.0 && o.z < 5.00001);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedPoint {
    /// The computed point, in scene units.
    pub p: Vec3,
    /// Bound on the absolute error along each axis, in scene units, never negative.
    pub error: Vec3,
}

impl BoundedPoint {
    /// The point of a triangle with barycentric weights `b`, which sum to 1.
    ///
    /// Each coordinate is a sum of three products. With weights that are rounded themselves, its
    /// error is at most γ₇ times the sum of the products' magnitudes (PBRT 3rd edition, section
    /// 3.9.4; γ is [`gamma`]).
    #[inline]
    pub fn on_triangle(corners: [Vec3; 3], b: [f32; 3]) -> Self {
        let [p0, p1, p2] = corners;
        Bounded::<f32>::on_triangle([p0.into(), p1.into(), p2.into()], b).into()
    }

    /// The origin of a ray that leaves along `w` from a surface with unit normal `n`.
    ///
    /// The point is offset along the normal, to the side that `w` points to, by the smallest
    /// distance that clears the error box (PBRT 3rd edition, section 3.9.5).
    #[inline]
    pub fn ray_origin(&self, n: Vec3, w: Vec3) -> Vec3 {
        Bounded::from(*self).ray_origin(n.into(), w.into()).into()
    }
}

/// A [`BoundedPoint`], or one in each lane.
#[derive(Clone, Copy)]
pub struct Bounded<F> {
    pub p: Xyz<F>,
    pub error: Xyz<F>,
}

impl From<BoundedPoint> for Bounded<f32> {
    #[inline(always)]
    fn from(BoundedPoint { p, error }: BoundedPoint) -> Self {
        Self { p: p.into(), error: error.into() }
    }
}

impl From<Bounded<f32>> for BoundedPoint {
    #[inline(always)]
    fn from(Bounded { p, error }: Bounded<f32>) -> Self {
        Self { p: p.into(), error: error.into() }
    }
}

impl<F: Float> Bounded<F> {
    /// As [`BoundedPoint::on_triangle`].
    #[inline(always)]
    pub fn on_triangle([p0, p1, p2]: [Xyz<F>; 3], [b0, b1, b2]: [F; 3]) -> Self {
        let (w0, w1, w2) = (p0 * b0, p1 * b1, p2 * b2);
        Self { p: w0 + w1 + w2, error: (w0.abs() + w1.abs() + w2.abs()) * F::splat(gamma(7)) }
    }

    /// As [`BoundedPoint::ray_origin`].
    #[inline(always)]
    pub fn ray_origin(self, n: Xyz<F>, w: Xyz<F>) -> Xyz<F> {
        let distance = n.abs().dot(self.error);
        let offset = n * F::select(w.dot(n).lt(F::splat(0.0)), -distance, distance);
        let moved = self.p + offset;
        // The sum may have been rounded towards the surface: step to the next float away from it.
        Xyz {
            x: round_away(moved.x, offset.x),
            y: round_away(moved.y, offset.y),
            z: round_away(moved.z, offset.z),
        }
    }
}

/// The float next to `value`, which is finite, in the direction of the sign of `offset`; `value`
/// itself for an offset of zero.
#[inline(always)]
fn round_away<F: Float>(value: F, offset: F) -> F {
    let zero = F::splat(0.0);
    let one = F::Bits::splat(1);
    let (bits, towards) = (value.to_bits(), offset.to_bits());
    // If the signs agree the step leads away from zero, which adds one to the bits of a float;
    // otherwise it subtracts one.
    let step = (bits.is_negative() ^ towards.is_negative()) | one;
    let tiny = F::from_bits(one).copysign(offset);
    let next = F::select(value.eq(zero), tiny, F::from_bits(bits.wrapping_add(step)));
    F::select(offset.eq(zero), value, next)
}
