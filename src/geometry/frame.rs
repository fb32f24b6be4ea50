//! [`Frame`]: an orthonormal basis around a normal, for shading coordinates.

use glam::Vec3;

use super::vector::unit;

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
        let sign = 1.0_f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
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
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }

    /// Takes a direction from shading to world coordinates.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}
