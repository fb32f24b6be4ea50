//! [`BinaryTrees`]: the trees that obvhs builds.

use obvhs::Boundable;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

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
        let (distance, precision) = (PlocSearchDistance::Medium, SortPrecision::U64);
        self.ploc.build_with_bvh(&mut self.tree, distance, primitives, numbers, precision, 3);
        self.reinsertion.run(&mut self.tree, 0.05, None);
        &self.tree
    }
}
