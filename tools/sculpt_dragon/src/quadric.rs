//! Error quadrics: the sum of squared distances to planes, as a function of position.
//!
//! Garland & Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997,
//! section 4; planes are weighted by area, as in Garland's thesis (1999), section 3.4.

use glam::{DMat3, DVec3};

/// x^T A x + 2 b^T x + c, with A symmetric.
#[derive(Clone, Copy, Default)]
pub struct Quadric {
    /// A's xx, yy, zz.
    diagonal: DVec3,
    /// A's yz, zx, xy.
    mixed: DVec3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// `weight` times the squared distance to the plane through `p` with unit normal `n`.
    pub fn plane(p: DVec3, n: DVec3, weight: f64) -> Quadric {
        let d = -n.dot(p);
        Quadric {
            diagonal: weight * n * n,
            mixed: weight * DVec3::new(n.y * n.z, n.z * n.x, n.x * n.y),
            b: weight * d * n,
            c: weight * d * d,
        }
    }

    /// `weight` times the squared distance to the point `p`.
    pub fn point(p: DVec3, weight: f64) -> Quadric {
        Quadric {
            diagonal: DVec3::splat(weight),
            mixed: DVec3::ZERO,
            b: -weight * p,
            c: weight * p.length_squared(),
        }
    }

    /// The sum of two errors.
    pub fn plus(&self, other: &Quadric) -> Quadric {
        Quadric {
            diagonal: self.diagonal + other.diagonal,
            mixed: self.mixed + other.mixed,
            b: self.b + other.b,
            c: self.c + other.c,
        }
    }

    fn matrix(&self) -> DMat3 {
        let (d, m) = (self.diagonal, self.mixed);
        DMat3::from_cols(
            DVec3::new(d.x, m.z, m.y),
            DVec3::new(m.z, d.y, m.x),
            DVec3::new(m.y, m.x, d.z),
        )
    }

    /// The error at `p`, not below 0.
    pub fn error(&self, p: DVec3) -> f64 {
        (p.dot(self.matrix() * p) + 2.0 * self.b.dot(p) + self.c).max(0.0)
    }

    /// Where the error is least, unless the planes are too nearly parallel to say.
    pub fn minimum(&self) -> Option<DVec3> {
        let a = self.matrix();
        let size = (self.diagonal.x + self.diagonal.y + self.diagonal.z) / 3.0;
        let determinant = a.determinant();
        (determinant > 1e-9 * size * size * size).then(|| a.inverse() * -self.b)
    }
}
