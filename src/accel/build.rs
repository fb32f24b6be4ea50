//! [`Accel`] and how it is built.

use std::num::NonZeroUsize;

use super::Aabb;
use super::layout::Root;
use super::node::{Child, MOST_TRIANGLES, Node};
use super::parallel;
use super::part::{Part, Workshop};
use super::path::Path;
use super::sort::{Sorted, sort};
use super::source::Source;
use super::stack::MOST_DEEP;
use super::top::top;
use super::triangles::Triangles;
use crate::shape::TriangleMesh;

/// The triangles of a scene in a tree of boxes.
///
/// A large scene is cut into parts. Over each, and in the end over what stands for the parts, obvhs builds a
/// binary tree (PLOC, then reinsertion). The trees are collapsed to nodes of sixteen children and
/// leaves of up to sixteen triangles, or as many as the fastest [`Path`] tests at once.
#[derive(Clone, Debug)]
pub struct Accel {
    pub(super) nodes: Vec<Node>,
    pub(super) triangles: Triangles,
    /// The number of the first triangle of each mesh.
    pub(super) shapes: Vec<u32>,
    pub(super) bounds: Aabb,
    pub(super) largest_coordinate: f32,
    /// The mean area of a face of the boxes of leaves.
    pub(super) grain: f32,
    /// The longest way from the root to a leaf, in nodes: how much a walk may have to remember.
    pub(super) depth: usize,
    pub(super) path: Path,
}

impl Accel {
    /// The most triangles that a tree can be built over: one leaf is there for slots without a child.
    pub const MOST_TRIANGLES: usize = MOST_TRIANGLES - 1;

    /// Builds the tree over all triangles of all meshes, on as many threads as the system offers; the tree
    /// is the same for any number of them. Triangles without area are left out: no ray can hit them. The
    /// meshes must have passed [`TriangleMesh::check`].
    ///
    /// # Panics
    /// If there are more than [`Accel::MOST_TRIANGLES`].
    pub fn build(meshes: &[TriangleMesh]) -> Self {
        let count: usize = meshes.iter().map(|mesh| mesh.indices.len()).sum();
        assert!(count <= Self::MOST_TRIANGLES, "{count} triangles are more than a tree can hold");
        Self::build_on(parallel::available(), meshes)
    }

    fn build_on(threads: NonZeroUsize, meshes: &[TriangleMesh]) -> Self {
        // Sort the triangles into parts.
        let source = Source::new(meshes);
        let Sorted { numbers, counts, price } = sort(&source, threads);
        // Build each part.
        let path = Path::available().pop().unwrap_or(Path::Portable);
        let mut rest = &numbers[..];
        let tasks = counts.into_iter().map(|count| rest.split_off(..count).expect("all numbers"));
        let parts =
            parallel::map(threads, tasks.collect(), Workshop::default, |workshop, numbers| {
                Part::new(workshop, &source, numbers, price, path.most_in_leaf())
            });
        // Put them below one root.
        let (nodes, triangles, depth) = join(&parts);
        let bounds = nodes.first().map_or(Aabb::EMPTY, Node::bounds);
        Self {
            grain: grain(&nodes),
            nodes,
            triangles,
            shapes: source.firsts,
            bounds,
            largest_coordinate: bounds.largest_coordinate(),
            depth,
            path,
        }
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// How many triangles can be hit.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
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
        size_of_val(&self.nodes[..]) + self.triangles.memory()
    }

    /// The instructions that rays are traced with.
    pub fn path(&self) -> Path {
        self.path
    }

    /// Chooses the instructions that rays are traced with: by default the fastest of those
    /// [available](Path::available), which it takes if `path` is not one of them.
    #[must_use]
    pub fn with_path(mut self, path: Path) -> Self {
        let available = Path::available();
        self.path = if available.contains(&path) { path } else { available[available.len() - 1] };
        self
    }
}

/// The nodes of all parts and of the tree above them, the root first, their triangles, and how deep that is.
fn join(parts: &[Part]) -> (Vec<Node>, Triangles, usize) {
    let mut triangles = Triangles::new();
    if parts.is_empty() {
        return (Vec::new(), triangles, 0);
    }
    let pieces: usize = parts.iter().map(|part| part.roots.len()).sum();
    let count: usize = parts.iter().map(|part| part.nodes.len()).sum();
    // The root, those of the parts, and a guess at those between.
    let mut nodes = Vec::with_capacity(1 + count + pieces / 2);
    nodes.push(Node::EMPTY);
    let mut roots = Vec::with_capacity(pieces);
    triangles.reserve(parts.iter().map(|part| &part.triangles));
    for part in parts {
        let (first, leaves) = (nodes.len(), triangles.append(&part.triangles));
        let moved = |bits| Child::moved(bits, first, leaves);
        nodes.extend(
            part.nodes
                .iter()
                .map(|node| Node { planes: node.planes, children: node.children.map(moved) }),
        );
        roots.extend(part.roots.iter().map(|root| Root { bits: moved(root.bits), ..*root }));
    }
    triangles.finish();
    let depth = top(&roots, &mut nodes);
    debug_assert!(depth <= MOST_DEEP);
    (nodes, triangles, depth)
}

/// The mean area of a face of the boxes of leaves; 0 without any.
fn grain(nodes: &[Node]) -> f32 {
    let areas = nodes.iter().flat_map(Node::leaf_areas);
    let (sum, count) =
        areas.fold((0.0, 0.0), |(sum, count), area| (sum + f64::from(area), count + 1.0_f64));
    (sum / (3.0 * count.max(1.0))) as f32
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use glam::Vec3;

    use super::Accel;
    use crate::shape::TriangleMesh;

    /// A landscape of many parts, large triangles below it, and many in one place.
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

    /// The tree does not depend on how many threads build it. Caught: something that is left in the memory
    /// of one thread and finds its way into the next part.
    #[test]
    fn the_number_of_threads_does_not_matter() {
        let meshes = scene();
        let tree = |threads: usize| {
            let threads = NonZeroUsize::new(threads).expect("at least one");
            let accel = Accel::build_on(threads, &meshes);
            assert_eq!(accel.triangle_count(), meshes.iter().map(|mesh| mesh.indices.len()).sum());
            let nodes: Vec<_> = accel.nodes.iter().map(|n| (n.planes, n.children)).collect();
            // As text, in which NaN is equal to NaN.
            (nodes, format!("{:?}", accel.triangles), accel.depth)
        };
        let alone = tree(1);
        for threads in [2, 3, 8] {
            assert!(tree(threads) == alone, "{threads} threads");
        }
    }
}
