//! [`Xyz`]: vectors of formulas that are generic over how many numbers there are at a time.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::{DVec3, Vec3};

use crate::simd::Float;

/// The coordinates of one vector, or of one in each lane.
#[derive(Clone, Copy)]
pub struct Xyz<F> {
    pub x: F,
    pub y: F,
    pub z: F,
}

impl<F: Float> Xyz<F> {
    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(v: Vec3) -> Self {
        Self { x: F::splat(v.x), y: F::splat(v.y), z: F::splat(v.z) }
    }

    /// The same vector in every lane, rounded if the lanes are f32.
    #[inline(always)]
    pub fn constant(v: DVec3) -> Self {
        Self { x: F::constant(v.x), y: F::constant(v.y), z: F::constant(v.z) }
    }

    /// Per lane: `yes` where the mask is set, otherwise `no`.
    #[inline(always)]
    pub fn select(mask: F::Mask, yes: Self, no: Self) -> Self {
        Self {
            x: F::select(mask, yes.x, no.x),
            y: F::select(mask, yes.y, no.y),
            z: F::select(mask, yes.z, no.z),
        }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> F {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    #[inline(always)]
    pub fn length_squared(self) -> F {
        self.dot(self)
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { x: self.x.abs(), y: self.y.abs(), z: self.z.abs() }
    }

    /// Whether all coordinates are zero, of either sign.
    #[inline(always)]
    pub fn is_zero(self) -> F::Mask {
        let zero = F::splat(0.0);
        self.x.eq(zero) & self.y.eq(zero) & self.z.eq(zero)
    }

    /// Multiplied by the reciprocal of its length; lanes of zero length become NaN.
    #[inline(always)]
    pub fn normalized(self) -> Self {
        self * (F::splat(1.0) / self.length_squared().sqrt())
    }
}

impl<F: Float> Add for Xyz<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<F: Float> Sub for Xyz<F> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<F: Float> Mul<F> for Xyz<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: F) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl<F: Float> Div<F> for Xyz<F> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: F) -> Self {
        Self { x: self.x / divisor, y: self.y / divisor, z: self.z / divisor }
    }
}

impl<F: Float> Neg for Xyz<F> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl From<Vec3> for Xyz<f32> {
    #[inline(always)]
    fn from(v: Vec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Xyz<f32>> for Vec3 {
    #[inline(always)]
    fn from(v: Xyz<f32>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl<F> From<[F; 3]> for Xyz<F> {
    #[inline(always)]
    fn from([x, y, z]: [F; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<F> From<Xyz<F>> for [F; 3] {
    #[inline(always)]
    fn from(Xyz { x, y, z }: Xyz<F>) -> Self {
        [x, y, z]
    }
}
