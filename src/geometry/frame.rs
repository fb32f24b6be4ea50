//! [`Frame`]: an orthonormal basis around a normal, for shading coordinates.

use glam::Vec3;

use super::vector::unit;
use super::xyz::Xyz;
use crate::simd::Float;

/// A right-handed orthonormal basis (s, t, n), which defines the shading coordinate system: its z
/// axis is the normal n.
///
/// The matrix with rows s, t, n takes world directions to shading coordinates. It is orthogonal, so
/// its transpose is its inverse (PBRT 3rd edition, section 9.1).
///
/// ```
/// use lobe::geometry::Frame;
/// use lobe::glam::Vec3;
///
/// let n = Vec3::new(0.6, 0.0, 0.8);
/// let frame = Frame::from_normal(n);
/// assert!(frame.is_orthonormal());
/// // In shading coordinates the normal is the z axis.
/// assert!(frame.to_local(n).abs_diff_eq(Vec3::Z, 1e-6));
/// assert!(frame.to_world(Vec3::Z).abs_diff_eq(n, 1e-6));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// First tangent: the x axis of shading coordinates.
    pub s: Vec3,
    /// Second tangent, n × s: the y axis.
    pub t: Vec3,
    /// Normal: the z axis.
    pub n: Vec3,
}

impl Frame {
    /// A frame around the unit vector `n`, with arbitrary tangents.
    ///
    /// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3. Unlike Frisvad's
    /// method, it stays orthonormal near n = -z.
    #[inline]
    pub fn from_normal(n: Vec3) -> Self {
        let [s, t] = tangents(n.into());
        Self { s: s.into(), t: t.into(), n }
    }

    /// A frame around the unit vector `n` whose x axis is `tangent` projected onto the plane across
    /// `n`.
    ///
    /// A tangent that is zero, not finite or parallel to `n` is ignored: the tangents are then
    /// those of [`Frame::from_normal`].
    #[inline]
    pub fn from_normal_and_tangent(n: Vec3, tangent: Vec3) -> Self {
        let across = |v: Vec3| v - n * n.dot(v);
        // For a tangent close to the normal, the projection has the rounding error of the whole
        // vector, so it is not quite perpendicular. A very short one counts as parallel; any other
        // is normalised and projected a second time.
        let projected = unit(tangent).map(across).filter(|s| s.length_squared() > 1e-12);
        match projected.and_then(unit).map(across).and_then(unit) {
            Some(s) => Self { s, t: n.cross(s), n },
            None => Self::from_normal(n),
        }
    }

    /// Whether the axes have unit length and are mutually perpendicular, within 1e-3.
    pub fn is_orthonormal(&self) -> bool {
        let Self { s, t, n } = *self;
        let lengths = [s, t, n].iter().all(|v| (v.length_squared() - 1.0).abs() < 1e-3);
        lengths && [s.dot(t), t.dot(n), n.dot(s)].iter().all(|cos| cos.abs() < 1e-3)
    }

    /// Takes a direction from world to shading coordinates.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        self.axes().to_local(v.into()).into()
    }

    /// Takes a direction from shading to world coordinates.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.axes().to_world(v.into()).into()
    }

    #[inline]
    fn axes(&self) -> Axes<f32> {
        Axes { s: self.s.into(), t: self.t.into(), n: self.n.into() }
    }
}

/// The axes of a [`Frame`], or of one in each lane.
#[derive(Clone, Copy)]
pub struct Axes<F> {
    pub s: Xyz<F>,
    pub t: Xyz<F>,
    pub n: Xyz<F>,
}

impl<F: Float> Axes<F> {
    /// As [`Frame::from_normal`].
    #[inline(always)]
    pub fn from_normal(n: Xyz<F>) -> Self {
        let [s, t] = tangents(n);
        Self { s, t, n }
    }

    /// As [`Frame::to_local`].
    #[inline(always)]
    pub fn to_local(self, v: Xyz<F>) -> Xyz<F> {
        Xyz { x: v.dot(self.s), y: v.dot(self.t), z: v.dot(self.n) }
    }

    /// As [`Frame::to_world`].
    #[inline(always)]
    pub fn to_world(self, v: Xyz<F>) -> Xyz<F> {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

/// The tangents of [`Frame::from_normal`].
#[inline(always)]
fn tangents<F: Float>(n: Xyz<F>) -> [Xyz<F>; 2] {
    let one = F::splat(1.0);
    let sign = one.copysign(n.z);
    let a = -one / (sign + n.z);
    let b = n.x * n.y * a;
    [
        Xyz { x: one + sign * n.x * n.x * a, y: sign * b, z: -sign * n.x },
        Xyz { x: b, y: sign + n.y * n.y * a, z: -n.y },
    ]
}
