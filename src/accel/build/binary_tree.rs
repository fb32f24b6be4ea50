//! [`BinaryTreeBuilder`]: binary trees, built by obvhs.

use obvhs::Boundable;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// Reinsertion looks for a better place for at least so many nodes. In small trees, such as the top level, those
/// are all.
const MIN_REINSERTED: f32 = 512.0;
/// Share of the nodes of large trees that reinsertion looks at.
const REINSERTED_RATIO: f32 = 0.05;
/// How many of those it moves per pass, as ratios.
const RATIO_SEQUENCE: [f32; 4] = [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0];

/// Builds one tree after another in the same memory.
#[derive(Default)]
pub struct BinaryTreeBuilder {
    ploc: PlocBuilder,
    reinsertion: ReinsertionOptimizer,
    tree: Bvh2,
}

impl BinaryTreeBuilder {
    /// The tree over at least one primitive, with one primitive in each leaf.
    pub fn build<T: Boundable>(&mut self, primitives: &[T]) -> &Bvh2 {
        let mut indices = std::mem::take(&mut self.tree.primitive_indices);
        indices.clear();
        indices.extend(0..primitives.len() as u32);
        let ratio = (MIN_REINSERTED / primitives.len() as f32).clamp(REINSERTED_RATIO, 1.0);
        // The first passes over a large tree pair the nearest neighbours only: there are many of them, and
        // little to choose.
        let is_small = ratio == 1.0;
        let quick_passes = if is_small { 0 } else { 2 };
        let distance = if is_small { PlocSearchDistance::Medium } else { PlocSearchDistance::Low };
        let (ploc, tree, precision) = (&mut self.ploc, &mut self.tree, SortPrecision::U64);
        ploc.build_with_bvh(tree, distance, primitives, indices, precision, quick_passes);
        self.reinsertion.run(tree, ratio, Some(RATIO_SEQUENCE.to_vec()));
        tree
    }
}
