//! [`Accel`] and how it is built.

use std::time::Duration;

use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::node::Bvh2Node;

use super::Aabb;
use super::bundle::bundle;
use super::leaf::LeafTriangle;
use crate::shape::TriangleMesh;

/// The triangles of a scene in a tree of boxes.
///
/// obvhs builds the binary tree (PLOC, then reinsertion). Its nodes are laid out anew, two children
/// to a node of 64 bytes, and the corners of the triangles are copied into the order of the leaves.
#[derive(Debug)]
pub struct Accel {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<LeafTriangle>,
    pub(super) bounds: Aabb,
    /// The longest way from the root to a leaf, in nodes: how much a walk may have to remember.
    pub(super) depth: usize,
}

/// Both children of an inner node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) min: [Vec3; 2],
    pub(super) max: [Vec3; 2],
    pub(super) children: [Child; 2],
}

/// What a child is: `count` triangles from `first` on, or the node `first` when `count` is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Child {
    pub(super) first: u32,
    pub(super) count: u32,
}

impl Accel {
    /// Builds the tree over all triangles of all meshes. Triangles without area are left out: no ray
    /// can hit them. The meshes must have passed [`TriangleMesh::check`].
    pub fn build(meshes: &[TriangleMesh]) -> Self {
        let mut triangles = collect(meshes);
        let corners = triangles.iter().flat_map(|t| t.corners);
        let bounds = corners.fold(Aabb::EMPTY, Aabb::including);
        if triangles.is_empty() {
            return Self { nodes: Vec::new(), leaves: Vec::new(), bounds, depth: 0 };
        }
        let bundles = bundle(&mut triangles);
        let tree = build_bvh2(&bundles, BvhBuildParams::medium_build(), &mut Duration::default());
        let mut leaves = Vec::with_capacity(triangles.len());
        // Where the bundles begin that the tree refers to by number.
        let mut starts = Vec::with_capacity(bundles.len() + 1);
        for &number in &tree.primitive_indices {
            starts.push(leaves.len() as u32);
            leaves.extend_from_slice(&triangles[bundles[number as usize].range()]);
        }
        starts.push(leaves.len() as u32);
        let (nodes, depth) = lay_out(&tree, &starts);
        Self { nodes, leaves, bounds, depth }
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// How many triangles can be hit.
    pub fn triangle_count(&self) -> usize {
        self.leaves.len()
    }

    /// How many nodes the tree has.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The longest way from the root to a leaf, in nodes.
    pub fn depth(&self) -> usize {
        self.depth
    }

    /// What the tree takes, with its copy of the triangles, in bytes.
    pub fn memory(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.leaves[..])
    }
}

/// All triangles that have an area.
fn collect(meshes: &[TriangleMesh]) -> Vec<LeafTriangle> {
    let mut triangles = Vec::with_capacity(meshes.iter().map(|m| m.indices.len()).sum());
    for (shape, mesh) in meshes.iter().enumerate() {
        for triangle in 0..mesh.indices.len() {
            if mesh.geometric_normal(triangle) != Vec3::ZERO {
                let corners = mesh.corners(triangle);
                triangles.push(LeafTriangle {
                    corners,
                    shape: shape as u32,
                    triangle: triangle as u32,
                });
            }
        }
    }
    triangles
}

/// The tree's inner nodes, each with the boxes of both children, parents first; and the depth. `starts`
/// says where the primitives of leaves begin among the triangles.
fn lay_out(tree: &Bvh2, starts: &[u32]) -> (Vec<Node>, usize) {
    let child = |node: &Bvh2Node| {
        if !node.is_leaf() {
            return Child { first: node.first_index, count: 0 };
        }
        let [first, end] = [node.first_index, node.first_index + node.prim_count];
        let [first, end] = [starts[first as usize], starts[end as usize]];
        Child { first, count: end - first }
    };
    if tree.nodes[0].is_leaf() {
        // One leaf: a node that holds it twice would report hits twice, so the second child is empty.
        let (only, none) = (&tree.nodes[0], Aabb::EMPTY);
        let node = Node {
            min: [only.aabb().min.into(), none.min],
            max: [only.aabb().max.into(), none.max],
            children: [child(only), Child { first: 0, count: 1 }],
        };
        return (vec![node], 1);
    }
    let mut nodes = Vec::with_capacity(tree.nodes.len() / 2 + 1);
    let mut depth = 0;
    // Each entry: where the pair of children stands in the tree, who refers to it, and how deep it is.
    let mut open = vec![(tree.nodes[0].first_index, None::<(usize, usize)>, 1)];
    while let Some((pair, parent, level)) = open.pop() {
        depth = depth.max(level);
        let place = nodes.len();
        if let Some((node, side)) = parent {
            let node: &mut Node = &mut nodes[node];
            node.children[side].first = place as u32;
        }
        let children = [0, 1].map(|side| &tree.nodes[pair as usize + side]);
        nodes.push(Node {
            min: children.map(|c| c.aabb().min.into()),
            max: children.map(|c| c.aabb().max.into()),
            children: children.map(child),
        });
        for side in [1, 0] {
            if !children[side].is_leaf() {
                open.push((children[side].first_index, Some((place, side)), level + 1));
            }
        }
    }
    (nodes, depth)
}
