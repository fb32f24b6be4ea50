//! [`Part`]: the tree over some of the triangles.

use std::ops::Range;

use arrayvec::ArrayVec;

use super::Aabb;
use super::binary::BinaryTrees;
use super::bundle::{Bundle, bundle};
use super::collapse::Collapse;
use super::lanes::LANES;
use super::layout::{Contents, Root, lay_out};
use super::node::{MOST_TRIANGLES, Node};
use super::source::Source;
use super::stack::MOST_DEEP;
use super::top::TOP_LEVELS;
use super::triangles::{Triangle, Triangles};

/// The levels of nodes that a part may have. All triangles that can be numbered fit into fewer, if all leaves
/// are equally deep: at least three levels are left to the heuristic.
const PART_LEVELS: usize = MOST_DEEP - TOP_LEVELS;
const _: () = assert!(OfPart::MOST * LANES.pow(PART_LEVELS as u32 - 3) >= MOST_TRIANGLES);

/// The tree over some of the triangles, which are in their place already.
pub struct Part {
    /// What stands for it in the tree above.
    pub roots: ArrayVec<Root, LANES>,
    /// Numbered from 0.
    pub nodes: Vec<Node>,
    /// What its leaves hold.
    pub triangles: Triangles,
}

/// What one thread builds its parts with.
#[derive(Default)]
pub struct Workshop {
    triangles: Vec<Triangle>,
    bundles: Vec<Bundle>,
    trees: BinaryTrees,
    collapse: Collapse,
}

impl Part {
    /// Builds the tree over at least one triangle, given by ascending numbers, and puts the triangles where
    /// they are to be. It becomes one child of the tree above or several, for each of which that pays a
    /// price. Leaves hold at most so many triangles, unless they are in one place.
    pub fn new(
        workshop: &mut Workshop,
        source: &Source,
        numbers: &[u32],
        price: f32,
        most_in_leaf: usize,
    ) -> Self {
        let Workshop { triangles, bundles, trees, collapse } = workshop;
        triangles.clear();
        triangles.extend(source.triangles(numbers.iter().copied()));
        bundle(triangles, bundles);
        let tree = trees.build(bundles);
        let choices = collapse
            .decide(tree, most_in_leaf, |primitive| bundles[primitive as usize].range().len());
        let mut nodes = Vec::with_capacity(triangles.len() / 64 + 1);
        let mut contents = OfPart { triangles, bundles, leaves: Triangles::new() };
        let roots = lay_out(&choices, &mut contents, price, PART_LEVELS, &mut nodes);
        Self { roots, nodes, triangles: contents.leaves }
    }
}

/// The triangles of a part.
struct OfPart<'a> {
    triangles: &'a [Triangle],
    bundles: &'a [Bundle],
    leaves: Triangles,
}

impl Contents for OfPart<'_> {
    /// If no two share a vertex.
    const MOST: usize = LANES / 3;

    fn count(&self) -> usize {
        self.triangles.len()
    }

    fn items(&self, primitive: u32) -> Range<u32> {
        self.bundles[primitive as usize].range()
    }

    fn bounds(&self, item: u32) -> Aabb {
        self.triangles[item as usize].corners.into_iter().fold(Aabb::EMPTY, Aabb::including)
    }

    fn leaf(&mut self, items: &[u32]) -> Option<(u32, usize)> {
        let triangles = items.iter().map(|&item| &self.triangles[item as usize]);
        Some((self.leaves.push(triangles)?, 0))
    }
}
