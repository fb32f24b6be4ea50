//! [`build`]: all steps from meshes to a tree.

use std::num::NonZeroUsize;

use super::layout::Root;
use super::parallel;
use super::partition::{Partition, partition};
use super::primitives::Primitives;
use super::top_level::build_top_level;
use super::treelet::{Scratch, Treelet};
use crate::accel::tree::{Bvh, Child, Leaves, Node};
use crate::shape::TriangleMesh;

/// The tree over the triangles of all meshes, built by so many threads. It does not depend on how many they are.
/// Leaves hold at most `max_in_leaf` triangles, unless those coincide.
pub fn build(meshes: &[&TriangleMesh], threads: NonZeroUsize, max_in_leaf: usize) -> Bvh {
    let primitives = Primitives::new(meshes);
    let Partition { ids, counts, child_cost } = partition(&primitives, threads);
    let mut rest = &ids[..];
    let parts = counts.into_iter().map(|count| rest.split_off(..count).expect("counts add up"));
    let treelets = parallel::map(threads, parts.collect(), Scratch::default, |scratch, ids| {
        Treelet::build(scratch, &primitives, ids, child_cost, max_in_leaf)
    });
    let (nodes, leaves, depth) = join(&treelets);
    Bvh::new(nodes, leaves, primitives.first_ids, depth)
}

/// Nodes and leaves of all treelets and of the tree above them, the root first, and the depth of the whole.
fn join(treelets: &[Treelet]) -> (Vec<Node>, Leaves, usize) {
    let mut leaves = Leaves::new();
    if treelets.is_empty() {
        return (Vec::new(), leaves, 0);
    }
    let root_count: usize = treelets.iter().map(|treelet| treelet.roots.len()).sum();
    let node_count: usize = treelets.iter().map(|treelet| treelet.nodes.len()).sum();
    // The root, those of the treelets, and a guess at those between.
    let mut nodes = Vec::with_capacity(1 + node_count + root_count / 2);
    nodes.push(Node::EMPTY);
    let mut roots = Vec::with_capacity(root_count);
    leaves.reserve(treelets.iter().map(|treelet| &treelet.leaves));
    for treelet in treelets {
        let (first_node, first_leaf) = (nodes.len(), leaves.append(&treelet.leaves));
        let offset = |bits| Child::offset(bits, first_node, first_leaf);
        nodes.extend(
            treelet
                .nodes
                .iter()
                .map(|node| Node { planes: node.planes, children: node.children.map(offset) }),
        );
        roots.extend(treelet.roots.iter().map(|root| Root { bits: offset(root.bits), ..*root }));
    }
    leaves.finish();
    let depth = build_top_level(&roots, &mut nodes);
    (nodes, leaves, depth)
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use glam::Vec3;

    use super::build;
    use crate::shape::TriangleMesh;

    /// A landscape of many parts, large triangles below it, and many that coincide.
    fn scene() -> [TriangleMesh; 2] {
        const SIDE: u32 = 200;
        let mut land = TriangleMesh::default();
        for i in 0..SIDE * SIDE {
            let (x, y) = ((i % SIDE) as f32, (i / SIDE) as f32);
            land.positions.push(Vec3::new(x, y, 9.0 * (x * 0.1).sin() * (y * 0.07).cos()));
            if i % SIDE + 1 < SIDE && i / SIDE + 1 < SIDE {
                land.indices.extend([[i, i + 1, i + SIDE], [i + 1, i + SIDE + 1, i + SIDE]]);
            }
        }
        let mut floor = TriangleMesh::default();
        floor.positions.extend([Vec3::ZERO, 200.0 * Vec3::X, 200.0 * Vec3::Y, Vec3::ONE]);
        floor.indices.extend([[0, 1, 2]; 40]);
        floor.indices.push([0, 1, 3]);
        [land, floor]
    }

    /// The tree does not depend on how many threads build it. Caught: state left in a thread's scratch memory that
    /// finds its way into the next treelet.
    #[test]
    fn the_number_of_threads_does_not_matter() {
        let meshes = scene();
        let tree = |threads: usize| {
            let threads = NonZeroUsize::new(threads).expect("at least one");
            let bvh = build(&meshes.each_ref(), threads, 16);
            let triangles: usize = meshes.iter().map(|mesh| mesh.indices.len()).sum();
            assert_eq!(bvh.leaves.triangle_count(), triangles);
            let nodes: Vec<_> = bvh.nodes.iter().map(|n| (n.planes, n.children)).collect();
            // As text, in which NaN is equal to NaN.
            (nodes, format!("{:?}", bvh.leaves), bvh.depth)
        };
        let alone = tree(1);
        for threads in [2, 3, 8] {
            assert!(tree(threads) == alone, "{threads} threads");
        }
    }
}
