//! Structures of arrays with four lanes: vectors, frames, bounded points and rays, four at a time.
//!
//! Each lane does the operations of the scalar type, in the same order, so both give the same bits.

use std::hint::black_box;
use std::ops::{Add, Mul, Neg, Sub};

use glam::{BVec4A, Mat4, Vec3, Vec4};

use super::float::gamma;
use super::ray::Ray;

/// The array `[f(0), f(1), f(2), f(3)]`. Unlike `std::array::from_fn` and `map`, it is always
/// inlined.
#[inline(always)]
pub fn four<T>(mut f: impl FnMut(usize) -> T) -> [T; 4] {
    [f(0), f(1), f(2), f(3)]
}

/// The array `[f(0), f(1), f(2)]`, always inlined.
#[inline(always)]
pub fn three<T>(mut f: impl FnMut(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}

/// Four vectors as a structure of arrays: one register of four lanes per coordinate. Each operation
/// gives the bits of its namesake on [`Vec3`].
#[derive(Clone, Copy)]
pub struct Vec3x4 {
    pub x: Vec4,
    pub y: Vec4,
    pub z: Vec4,
}

impl Vec3x4 {
    /// The zero vector in every lane.
    pub const ZERO: Self = Self::splat(Vec3::ZERO);

    /// The same vector in every lane.
    #[inline(always)]
    pub const fn splat(v: Vec3) -> Self {
        Self { x: Vec4::splat(v.x), y: Vec4::splat(v.y), z: Vec4::splat(v.z) }
    }

    /// Gathers four vectors into lanes.
    #[inline(always)]
    pub fn new([a, b, c, d]: [&Vec3; 4]) -> Self {
        Self {
            x: Vec4::new(a.x, b.x, c.x, d.x),
            y: Vec4::new(a.y, b.y, c.y, d.y),
            z: Vec4::new(a.z, b.z, c.z, d.z),
        }
    }

    /// The vector of lane 0.
    #[inline(always)]
    pub fn first(self) -> Vec3 {
        Vec3::new(self.x.x, self.y.x, self.z.x)
    }

    /// The transpose: lane i's (x, y, z), followed by element i of `w`.
    #[inline(always)]
    pub fn rows(self, w: Vec4) -> [Vec4; 4] {
        let Mat4 { x_axis, y_axis, z_axis, w_axis } =
            Mat4::from_cols(self.x, self.y, self.z, w).transpose();
        // `black_box` keeps the rows whole; otherwise the optimiser splits them and stores each
        // number by itself.
        black_box([x_axis, y_axis, z_axis, w_axis])
    }

    /// Per lane: `if_true` where the mask is set, otherwise `if_false`.
    #[inline(always)]
    pub fn select(mask: BVec4A, if_true: Self, if_false: Self) -> Self {
        Self {
            x: Vec4::select(mask, if_true.x, if_false.x),
            y: Vec4::select(mask, if_true.y, if_false.y),
            z: Vec4::select(mask, if_true.z, if_false.z),
        }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Vec4 {
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
    pub fn length_squared(self) -> Vec4 {
        self.dot(self)
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { x: self.x.abs(), y: self.y.abs(), z: self.z.abs() }
    }

    #[inline(always)]
    pub fn divided_by(self, divisor: Vec4) -> Self {
        Self { x: self.x / divisor, y: self.y / divisor, z: self.z / divisor }
    }
}

impl Add for Vec3x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Vec3x4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Mul<Vec4> for Vec3x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Vec4) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl Neg for Vec3x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

/// Four lanes of [`Frame`](super::Frame).
#[derive(Clone, Copy)]
pub struct Framex4 {
    s: Vec3x4,
    t: Vec3x4,
    n: Vec3x4,
}

impl Framex4 {
    /// Four lanes of [`Frame::from_normal`](super::Frame::from_normal).
    #[inline(always)]
    pub fn from_normals(n: Vec3x4) -> Self {
        let sign = Vec4::ONE.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: Vec3x4 { x: 1.0 + sign * n.x * n.x * a, y: sign * b, z: -sign * n.x },
            t: Vec3x4 { x: b, y: sign + n.y * n.y * a, z: -n.y },
            n,
        }
    }

    /// Four lanes of [`Frame::to_world`](super::Frame::to_world).
    #[inline(always)]
    pub fn to_world(self, v: Vec3x4) -> Vec3x4 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

/// Four lanes of [`BoundedPoint`](super::BoundedPoint).
#[derive(Clone, Copy)]
pub struct BoundedPointx4 {
    pub p: Vec3x4,
    pub error: Vec3x4,
}

impl BoundedPointx4 {
    /// Four lanes of [`BoundedPoint::on_triangle`](super::BoundedPoint::on_triangle).
    #[inline(always)]
    pub fn on_triangles(corners: [Vec3x4; 3], b: [Vec4; 3]) -> Self {
        let [p0, p1, p2] = corners;
        let (w0, w1, w2) = (p0 * b[0], p1 * b[1], p2 * b[2]);
        let error = (w0.abs() + w1.abs() + w2.abs()) * Vec4::splat(gamma(7));
        Self { p: w0 + w1 + w2, error }
    }

    /// Four lanes of [`BoundedPoint::ray_origin`](super::BoundedPoint::ray_origin).
    #[inline(always)]
    pub fn ray_origins(&self, n: Vec3x4, w: Vec3x4) -> Vec3x4 {
        let distance = n.abs().dot(self.error);
        let offset = n * Vec4::select(w.dot(n).cmplt(Vec4::ZERO), -distance, distance);
        let moved = self.p + offset;
        Vec3x4 {
            x: round_away(moved.x, offset.x),
            y: round_away(moved.y, offset.y),
            z: round_away(moved.z, offset.z),
        }
    }
}

/// Per lane, the float next to `values` in the direction of the sign of `offsets`; unchanged for an
/// offset of zero. The values must be finite.
#[inline(always)]
fn round_away(values: Vec4, offsets: Vec4) -> Vec4 {
    let (values, offsets) = (values.to_array(), offsets.to_array());
    Vec4::from_array(four(|i| {
        let (value, offset) = (values[i].to_bits() as i32, offsets[i].to_bits() as i32);
        // The sign bits as 0 or -1. If they agree the step leads away from zero, which adds one to
        // the bits of a float; otherwise it subtracts one.
        let step = ((value >> 31) ^ (offset >> 31)) | 1;
        let tiny = (offset & i32::MIN) | 1;
        let next = if value & i32::MAX == 0 { tiny } else { value.wrapping_add(step) };
        f32::from_bits(if offset & i32::MAX == 0 { value } else { next } as u32)
    }))
}

/// Four rays from `o` along `d`, from t = 0 to `t_max`.
#[inline(always)]
pub fn rays_x4(o: Vec3x4, d: Vec3x4, t_max: Vec4) -> [Ray; 4] {
    let (o, d) = (o.rows(Vec4::ZERO), d.rows(t_max));
    four(|i| Ray { o: o[i].truncate(), t_min: o[i].w, d: d[i].truncate(), t_max: d[i].w })
}
