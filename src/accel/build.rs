//! [`Accel`] and how it is built.

use glam::Vec3;

use super::Aabb;
use super::lanes::LANES;
use super::node::{Child, MOST_TRIANGLES, Node};
use super::parallel;
use super::part::{Part, Plan, slots};
use super::path::Path;
use super::split::{partition, split};
use super::triangles::{Triangle, Triangles};
use crate::shape::TriangleMesh;

/// The triangles of a scene in a tree of boxes.
///
/// obvhs builds binary trees (PLOC, then reinsertion). They are collapsed to nodes of sixteen children and
/// leaves of up to sixteen triangles, which rays are tested against sixteen at a time.
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
    /// The most triangles that a tree can be built over.
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
        let mut triangles = collect(meshes);
        let count = partition(&mut triangles, |triangle| triangle.number != FLAT);
        let mut shapes = Vec::with_capacity(meshes.len());
        let mut next = 0;
        for mesh in meshes {
            shapes.push(next);
            next += mesh.indices.len() as u32;
        }
        let mut accel = Self {
            nodes: Vec::new(),
            triangles: Triangles::with_capacity(0),
            shapes,
            bounds: Aabb::EMPTY,
            largest_coordinate: 0.0,
            grain: 0.0,
            depth: 0,
            path: Path::available().pop().unwrap_or(Path::Portable),
        };
        if count > 0 {
            accel.join(parts(&mut triangles[..count]));
        }
        accel.triangles.finish();
        accel.bounds = accel.nodes.first().map_or(Aabb::EMPTY, Node::bounds);
        accel.largest_coordinate = accel.bounds.largest_coordinate();
        accel.grain = grain(&accel.nodes);
        accel
    }

    /// Puts a root above the parts.
    fn join(&mut self, parts: Vec<Part>) {
        let boxes: Vec<Aabb> =
            parts.iter().flat_map(|p| &p.roots).map(|&(bounds, _)| bounds).collect();
        let mut slots = slots(&boxes).into_iter();
        self.nodes.reserve_exact(1 + parts.iter().map(|part| part.nodes.len()).sum::<usize>());
        self.nodes.push(Node::EMPTY);
        self.triangles = Triangles::with_capacity(parts.iter().map(|p| p.triangles.len()).sum());
        for part in parts {
            let first = self.nodes.len();
            let moved = self.triangles.append(&part.triangles);
            for ((bounds, root), slot) in part.roots.into_iter().zip(&mut slots) {
                self.nodes[0].set(slot, &bounds, Child::moved(root, first, moved));
            }
            self.nodes.extend(part.nodes.into_iter().map(|mut node| {
                node.children = node.children.map(|child| Child::moved(child, first, moved));
                node
            }));
            self.depth = self.depth.max(part.depth);
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

/// The trees of all parts of the triangles.
fn parts(triangles: &mut [Triangle]) -> Vec<Part> {
    let plans = parallel::map(split(triangles), Plan::new);
    // Each part has a child of the root. The others go one by one to where they save most.
    let mut counts = vec![1; plans.len()];
    for _ in plans.len()..LANES {
        let gains = plans.iter().zip(&counts).map(|(plan, &k)| plan.gain(k));
        let best = gains.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
        best.into_iter().for_each(|(i, _)| counts[i] += 1);
    }
    let plans = plans.into_iter().zip(counts).collect();
    parallel::map(plans, |(plan, k)| Plan::lay_out(plan, k))
}

/// The number of a triangle without area.
const FLAT: u32 = u32::MAX;

/// All triangles.
fn collect(meshes: &[TriangleMesh]) -> Vec<Triangle> {
    const AT_ONCE: usize = 1 << 14;
    let count = meshes.iter().map(|mesh| mesh.indices.len()).sum();
    let mut triangles = vec![Triangle { corners: [Vec3::ZERO; 3], number: 0 }; count];
    let (mut rest, mut number) = (&mut triangles[..], 0);
    let mut tasks = Vec::new();
    for mesh in meshes {
        let (of_mesh, others) = rest.split_at_mut(mesh.indices.len());
        for (i, chunk) in of_mesh.chunks_mut(AT_ONCE).enumerate() {
            tasks.push((mesh, AT_ONCE * i, number, chunk));
        }
        number += mesh.indices.len() as u32;
        rest = others;
    }
    parallel::map(tasks, |(mesh, first, number, chunk)| {
        for (i, triangle) in (first..).zip(chunk) {
            triangle.corners = mesh.corners(i);
            let is_flat = mesh.geometric_normal(i) == Vec3::ZERO;
            triangle.number = if is_flat { FLAT } else { number + i as u32 };
        }
    });
    triangles
}

/// The mean area of a face of the boxes of leaves; 0 without any.
fn grain(nodes: &[Node]) -> f32 {
    let areas = nodes.iter().flat_map(Node::leaf_areas);
    let (sum, count) =
        areas.fold((0.0, 0.0), |(sum, count), area| (sum + f64::from(area), count + 1.0_f64));
    (sum / (3.0 * count.max(1.0))) as f32
}
