//! The upper levels of the tree, above the parts.

use std::ops::Range;

use arrayvec::ArrayVec;
use obvhs::Boundable;

use super::Aabb;
use super::binary::BinaryTrees;
use super::collapse::{Collapse, TOO_MANY};
use super::lanes::LANES;
use super::layout::{Contents, Root, lay_out, slots};
use super::node::Node;
use super::sort::MOST_PARTS;

/// The levels of nodes above the parts, with the root.
pub const TOP_LEVELS: usize = 6;
const _: () = assert!(MOST_PARTS * LANES <= LANES.pow(TOP_LEVELS as u32 - 1));

/// Builds a tree over what stands for the parts: fills in the root, which is the first of `nodes`, and adds
/// the nodes between. How deep the whole tree is.
pub fn top(pieces: &[Root], nodes: &mut Vec<Node>) -> usize {
    let mut trees = BinaryTrees::default();
    let mut collapse = Collapse::default();
    // A leaf has room for one only.
    let choices = collapse.decide(trees.build(pieces), LANES, |_| TOO_MANY);
    let roots = lay_out(&choices, &mut Pieces(pieces), 0.0, TOP_LEVELS - 1, nodes);
    let boxes: ArrayVec<Aabb, LANES> = roots.iter().map(|root| root.bounds).collect();
    for (root, slot) in roots.iter().zip(slots(&boxes)) {
        nodes[0].set(slot, &root.bounds, root.bits);
    }
    1 + roots.iter().map(|root| root.depth).max().unwrap_or(0)
}

struct Pieces<'a>(&'a [Root]);

impl Contents for Pieces<'_> {
    const MOST: usize = 1;

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
