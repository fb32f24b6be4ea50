//! [`Bvh`]: the tree as a whole.

use super::aabb::Aabb;
use super::leaf::Leaf;
use super::leaves::Leaves;
use super::node::{Child, Node};
use crate::interaction::Hit;

/// Most nodes on the way from the root to a leaf. Building keeps to it, so that traversal stacks have a fixed size.
pub const MAX_DEPTH: usize = 24;

/// A tree over the triangles of some meshes.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// The root first; none if there are no triangles.
    pub nodes: Vec<Node>,
    pub leaves: Leaves,
    /// For each mesh the id of its first triangle.
    pub first_ids: Vec<u32>,
    /// The box around all triangles.
    pub bounds: Aabb,
    /// The largest absolute coordinate of `bounds`.
    pub largest_coordinate: f32,
    /// The mean area of a face of the leaves' boxes, in square scene units. Compared with the cross-section of a beam
    /// of rays, it tells how many of them come to a leaf.
    pub mean_leaf_area: f32,
    /// Most nodes on the way from the root to a leaf, at most [`MAX_DEPTH`].
    pub depth: usize,
}

impl Bvh {
    /// A tree from its parts.
    pub fn new(nodes: Vec<Node>, leaves: Leaves, first_ids: Vec<u32>, depth: usize) -> Self {
        debug_assert!(depth <= MAX_DEPTH);
        let bounds = nodes.first().map_or(Aabb::EMPTY, Node::bounds);
        let mean_leaf_area = mean_leaf_area(&nodes);
        let largest_coordinate = bounds.largest_coordinate();
        Self { nodes, leaves, first_ids, bounds, largest_coordinate, mean_leaf_area, depth }
    }

    /// Bytes of nodes and leaves.
    pub fn memory(&self) -> usize {
        size_of_val(&self.nodes[..]) + self.leaves.memory()
    }

    /// The leaf that a node refers to by these bits.
    #[inline(always)]
    pub fn leaf(&self, child: u32) -> Leaf<'_> {
        let (index, vertices) = Child::unpack_leaf(child);
        self.leaves.get(index, vertices)
    }

    /// Replaces the id of the triangle that was hit, if there is one, by its mesh and its index in that mesh.
    #[inline]
    pub fn tell_shape(&self, hit: &mut Hit) {
        if hit.triangle == u32::MAX {
            return;
        }
        let shape = match &self.first_ids[..] {
            [_] => 0,
            first_ids => first_ids.partition_point(|&first| first <= hit.triangle) - 1,
        };
        hit.shape = shape as u32;
        hit.triangle -= self.first_ids[shape];
    }
}

/// The mean area of a face of the leaves' boxes; 0 without leaves.
fn mean_leaf_area(nodes: &[Node]) -> f32 {
    let areas = nodes.iter().flat_map(Node::leaf_half_areas);
    let (sum, count) =
        areas.fold((0.0, 0.0), |(sum, count), area| (sum + f64::from(area), count + 1.0_f64));
    (sum / (3.0 * count.max(1.0))) as f32
}
