//! [`Treelet`]: the tree over one part of the triangles.

use std::ops::Range;

use arrayvec::ArrayVec;

use super::binary_tree::BinaryTreeBuilder;
use super::collapse::Collapse;
use super::duplicates::{Primitive, group_duplicates};
use super::layout::{Contents, Root, lay_out};
use super::primitives::Primitives;
use super::top_level::TOP_LEVELS;
use crate::accel::tree::{Aabb, Leaves, MAX_DEPTH, MAX_TRIANGLES, Node, Triangle};
use crate::simd::{ARITY, LANES};

/// Most levels of nodes in a treelet. If all leaves are equally deep, three levels fewer have room for all triangles
/// that a tree can have. So at least three levels are left to the heuristic.
const TREELET_LEVELS: usize = MAX_DEPTH - TOP_LEVELS;
const _: () =
    assert!(ARITY.ilog2() as usize * (TREELET_LEVELS - 3) >= MAX_TRIANGLES.ilog2() as usize);

/// The tree over one part of the triangles, in its final layout.
pub struct Treelet {
    /// What the top level is built over: the treelet as one child or several.
    pub roots: ArrayVec<Root, ARITY>,
    /// Indices in it count from 0.
    pub nodes: Vec<Node>,
    pub leaves: Leaves,
}

/// What one thread builds its treelets in.
#[derive(Default)]
pub struct Scratch {
    triangles: Vec<Triangle>,
    primitives: Vec<Primitive>,
    trees: BinaryTreeBuilder,
    collapse: Collapse,
}

impl Treelet {
    /// Builds the tree over the triangles of ascending ids, at least one. Leaves hold at most `max_in_leaf` triangles,
    /// unless those coincide. It becomes as many children of the top level as cost least, where each child costs
    /// `child_cost`.
    pub fn build(
        scratch: &mut Scratch,
        all: &Primitives,
        ids: &[u32],
        child_cost: f32,
        max_in_leaf: usize,
    ) -> Self {
        let Scratch { triangles, primitives, trees, collapse } = scratch;
        triangles.clear();
        triangles.extend(all.triangles(ids.iter().copied()));
        group_duplicates(triangles, primitives);
        let tree = trees.build(primitives);
        let choices = collapse.choose(tree, max_in_leaf, |primitive| {
            primitives[primitive as usize].triangles().len()
        });
        let mut nodes = Vec::with_capacity(triangles.len() / 64 + 1);
        let mut contents = TreeletContents { triangles, primitives, leaves: Leaves::new() };
        let roots = lay_out(&choices, &mut contents, child_cost, TREELET_LEVELS, &mut nodes);
        Self { roots, nodes, leaves: contents.leaves }
    }
}

/// The items of a treelet are triangles.
struct TreeletContents<'a> {
    triangles: &'a [Triangle],
    primitives: &'a [Primitive],
    leaves: Leaves,
}

impl Contents for TreeletContents<'_> {
    /// If no two triangles share a vertex.
    const GUARANTEED: usize = LANES / 3;

    fn count(&self) -> usize {
        self.triangles.len()
    }

    fn items(&self, primitive: u32) -> Range<u32> {
        self.primitives[primitive as usize].triangles()
    }

    fn bounds(&self, item: u32) -> Aabb {
        self.triangles[item as usize].corners.into_iter().fold(Aabb::EMPTY, Aabb::including)
    }

    fn leaf(&mut self, items: &[u32]) -> Option<(u32, usize)> {
        let triangles = items.iter().map(|&item| &self.triangles[item as usize]);
        Some((self.leaves.push(triangles)?, 0))
    }
}
