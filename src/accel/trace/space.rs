//! [`Space`]: where the triangles of a tree stand.

use glam::Vec3A;

use super::slabs::{Slabs, padding};
use crate::accel::tree::{Bvh, Leaf, Place};
use crate::geometry::Ray;
use crate::simd::{Eight, Vector};

/// Where a ray meets the triangles of a tree: in place, or moved. The ray is always one of the world, and its t counts there.
pub trait Space: Copy {
    /// The ray against the boxes of nodes.
    fn slabs<B: Eight>(self, ray: &Ray, bvh: &Bvh) -> Slabs<B>;
    /// Coordinates of all vertices of a leaf along three axes.
    fn vertices<V: Vector>(self, leaf: Leaf, axes: [usize; 3]) -> [V; 3];
    /// Three corners in the order in which they are counter-clockwise from outside.
    fn order<T>(self, corners: [T; 3]) -> [T; 3];
    /// One coordinate of three vertices.
    fn coordinates(self, leaf: Leaf, corners: [usize; 3], axis: usize) -> [f32; 3];
}

/// The tree is built where its triangles stand.
#[derive(Clone, Copy)]
pub struct World;

impl Space for World {
    #[inline(always)]
    fn slabs<B: Eight>(self, ray: &Ray, bvh: &Bvh) -> Slabs<B> {
        Slabs::new(ray, bvh.largest_coordinate)
    }

    #[inline(always)]
    fn vertices<V: Vector>(self, leaf: Leaf, axes: [usize; 3]) -> [V; 3] {
        [leaf.vertices(axes[0]), leaf.vertices(axes[1]), leaf.vertices(axes[2])]
    }

    #[inline(always)]
    fn order<T>(self, corners: [T; 3]) -> [T; 3] {
        corners
    }

    #[inline(always)]
    fn coordinates(self, leaf: Leaf, corners: [usize; 3], axis: usize) -> [f32; 3] {
        leaf.coordinates(corners, axis)
    }
}

/// The triangles stand at another place than the tree. The ray is moved to the tree for the boxes, with more padding; the vertices
/// of leaves are moved to the ray, by the formula of [`TriangleMesh::transform`](crate::shape::TriangleMesh::transform), and tested in the
/// world. So hits are those of the transformed mesh to the bit, and no edge opens.
#[derive(Clone, Copy)]
pub struct Elsewhere<'a>(pub &'a Place);

impl Space for Elsewhere<'_> {
    #[inline(always)]
    fn slabs<B: Eight>(self, ray: &Ray, bvh: &Bvh) -> Slabs<B> {
        let Place { inverse, translation, spread, reach, .. } = self.0;
        let local = Ray { o: *inverse * (ray.o - *translation), d: *inverse * ray.d, ..*ray };
        // In units of half an epsilon, for numbers of the world up to |o| + `reach`, of which an error grows by up to `spread` on the way
        // to the tree: the moved origin is off by up to 5 (difference, inverse, product, two sums), the moved direction by 4, a moved
        // vertex by 4, a sheared one by 6. 19 in all, here 24.
        let world = reach + ray.o.abs().max_element();
        let moved = Vec3A::from(*spread) * (12.0 * f32::EPSILON * world);
        Slabs::padded(
            &local,
            bvh.largest_coordinate,
            moved + padding(&local, bvh.largest_coordinate),
        )
    }

    #[inline(always)]
    fn vertices<V: Vector>(self, leaf: Leaf, axes: [usize; 3]) -> [V; 3] {
        let [x, y, z] = [leaf.vertices::<V>(0), leaf.vertices::<V>(1), leaf.vertices::<V>(2)];
        let [a, b, c] = [axes[0] % 3, axes[1] % 3, axes[2] % 3].map(|axis| &self.0.rows[axis]);
        [moved(a, x, y, z), moved(b, x, y, z), moved(c, x, y, z)]
    }

    #[inline(always)]
    fn order<T>(self, [a, b, c]: [T; 3]) -> [T; 3] {
        if self.0.is_mirrored { [a, c, b] } else { [a, b, c] }
    }

    #[inline(always)]
    fn coordinates(self, leaf: Leaf, corners: [usize; 3], axis: usize) -> [f32; 3] {
        let [x, y, z] = [0, 1, 2].map(|axis| leaf.coordinates(corners, axis));
        let [a, b, c, d] = self.0.rows[axis % 3];
        [0, 1, 2].map(|i| x[i] * a + y[i] * b + z[i] * c + d)
    }
}

/// One coordinate of vertices that are moved.
#[inline(always)]
fn moved<V: Vector>(&[a, b, c, d]: &[f32; 4], x: V, y: V, z: V) -> V {
    x * V::splat(a) + y * V::splat(b) + z * V::splat(c) + V::splat(d)
}
