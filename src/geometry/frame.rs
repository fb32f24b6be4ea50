//! [`Frame`]: the shading coordinate system.

use glam::Vec3;

use super::unit;

/// A right-handed orthonormal basis whose third axis is a normal: shading coordinates.
///
/// The matrix with rows s, t, n takes world directions to shading coordinates. It is orthogonal, so
/// its transpose takes them back (PBRT 3rd edition, section 9.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// First tangent: the x axis.
    pub s: Vec3,
    /// Second tangent, n × s: the y axis.
    pub t: Vec3,
    /// Normal: the z axis.
    pub n: Vec3,
}

impl Frame {
    /// A frame around the unit vector `n`, with tangents that point anywhere.
    ///
    /// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3. Unlike Frisvad's
    /// form it stays orthonormal close to n = -z.
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

    /// A frame around the unit vector `n` whose x axis lies in the plane of `n` and `tangent`, on the
    /// side of `tangent`. A tangent that is zero, not finite or parallel to `n` leaves the choice to
    /// [`Frame::from_normal`].
    #[inline]
    pub fn from_normal_and_tangent(n: Vec3, tangent: Vec3) -> Self {
        let across = |v: Vec3| v - n * n.dot(v);
        // What is left of a tangent close to the normal has the rounding error of the whole, which
        // does not lie across the normal: what is too little counts as parallel, and the rest is
        // projected once more.
        let projected = unit(tangent).map(across).filter(|s| s.length_squared() > 1e-12);
        match projected.and_then(unit).map(across).and_then(unit) {
            Some(s) => Self { s, t: n.cross(s), n },
            None => Self::from_normal(n),
        }
    }

    /// Whether the axes have unit length and stand across each other, to 1e-3.
    pub fn is_orthonormal(&self) -> bool {
        let Self { s, t, n } = *self;
        let lengths = [s, t, n].iter().all(|v| (v.length_squared() - 1.0).abs() < 1e-3);
        lengths && [s.dot(t), t.dot(n), n.dot(s)].iter().all(|cos| cos.abs() < 1e-3)
    }

    /// A world direction in shading coordinates.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }

    /// A direction in shading coordinates back in the world.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}
