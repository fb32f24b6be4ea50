//! The top level: the nodes above all treelets.

use std::ops::Range;

use obvhs::Boundable;

use super::binary_tree::BinaryTreeBuilder;
use super::collapse::{Collapse, TOO_MANY};
use super::layout::{Contents, Root, lay_out, smallest_first};
use super::partition::MAX_PARTS;
use crate::accel::tree::{Aabb, Node};
use crate::simd::{ARITY, LANES};

/// Most levels of nodes above the treelets, with the root.
pub const TOP_LEVELS: usize = 8;
const _: () = assert!(MAX_PARTS * ARITY <= ARITY.pow(TOP_LEVELS as u32 - 1));

/// Builds a tree over the roots of the treelets: fills in the root, which is the first of `nodes`, and appends the nodes
/// between. Returns the depth of the whole tree.
pub fn build_top_level(roots: &[Root], nodes: &mut Vec<Node>) -> usize {
    let mut trees = BinaryTreeBuilder::default();
    let mut collapse = Collapse::default();
    // Each root counts as more than fits into a leaf, so that none are merged into one.
    let choices = collapse.choose(trees.build(roots), LANES, |_| TOO_MANY);
    let mut children = lay_out(&choices, &mut TopContents(roots), 0.0, TOP_LEVELS - 1, nodes);
    smallest_first(&mut children, |child| &child.bounds);
    for (slot, child) in children.iter().enumerate() {
        nodes[0].set(slot, &child.bounds, child.bits);
    }
    1 + children.iter().map(|child| child.depth).max().unwrap_or(0)
}

/// The items of the top level are roots of treelets, one to a "leaf".
struct TopContents<'a>(&'a [Root]);

impl Contents for TopContents<'_> {
    const GUARANTEED: usize = 1;

    fn count(&self) -> usize {
        self.0.len()
    }

    fn items(&self, primitive: u32) -> Range<u32> {
        primitive..primitive + 1
    }

    fn bounds(&self, item: u32) -> Aabb {
        self.0[item as usize].bounds
    }

    fn leaf(&mut self, items: &[u32]) -> Option<(u32, usize)> {
        let [item] = *items else { return None };
        let root = self.0[item as usize];
        Some((root.bits, root.depth))
    }
}

impl Boundable for Root {
    fn aabb(&self) -> obvhs::aabb::Aabb {
        obvhs::aabb::Aabb { min: self.bounds.min.into(), max: self.bounds.max.into() }
    }
}
