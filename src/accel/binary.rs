//! [`BinaryTrees`]: the trees that obvhs builds.

use obvhs::Boundable;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// So many nodes at least are looked at for a better place. In small trees, such as the uppermost levels of
/// a large one, those are all.
const REINSERTED: f32 = 512.0;
/// Of large trees, this share.
const RATIO: f32 = 0.05;
/// How many at a time, of those, as a sequence of ratios.
const SEQUENCE: [f32; 4] = [1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0];

/// Builds one tree after another in the same memory.
#[derive(Default)]
pub struct BinaryTrees {
    ploc: PlocBuilder,
    reinsertion: ReinsertionOptimizer,
    tree: Bvh2,
}

impl BinaryTrees {
    /// The tree over at least one primitive, each of whose leaves has one.
    pub fn build<T: Boundable>(&mut self, primitives: &[T]) -> &Bvh2 {
        let mut numbers = std::mem::take(&mut self.tree.primitive_indices);
        numbers.clear();
        numbers.extend(0..primitives.len() as u32);
        let ratio = (REINSERTED / primitives.len() as f32).clamp(RATIO, 1.0);
        // The first passes over a large tree pair the nearest neighbours only: there are many of them, and
        // little to choose.
        let is_small = ratio == 1.0;
        let quick_passes = if is_small { 0 } else { 2 };
        let distance = if is_small { PlocSearchDistance::Medium } else { PlocSearchDistance::Low };
        let (ploc, tree, precision) = (&mut self.ploc, &mut self.tree, SortPrecision::U64);
        ploc.build_with_bvh(tree, distance, primitives, numbers, precision, quick_passes);
        self.reinsertion.run(tree, ratio, Some(SEQUENCE.to_vec()));
        tree
    }
}
