//! [`Triangle`]: what a tree is built over.

use glam::{Vec3, Vec3A};

/// A triangle, with its id: its index among all triangles of all meshes.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    pub corners: [Vec3; 3],
    pub id: u32,
}

impl Triangle {
    /// Its bounding box, as obvhs has them.
    pub fn bounds(&self) -> obvhs::aabb::Aabb {
        let [a, b, c] = self.corners.map(Vec3A::from);
        obvhs::aabb::Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
    }
}
