//! Rays against all triangles of a scene: [`Accel`].
//!
//! Three rooms, each of which knows only those before it, but `trace` not `build`:
//! - `tree`: the data, a bounding volume hierarchy with eight children per node;
//! - `build`: from meshes to that tree, with obvhs;
//! - `trace`: rays through that tree, one at a time or in beams.

mod build;
mod trace;
mod tree;

pub use crate::interaction::Hit;
pub use crate::simd::{InstructionSet, InstructionSetError};
pub use tree::Aabb;

use crate::geometry::Ray;
use crate::shape::{Instance, TriangleMesh};
use crate::simd::Kernel;
use trace::{AnyHit, Batch, ClosestHit, InForest, Stack, Start, World};
use tree::{Bvh, Forest, MAX_TRIANGLES};

/// The triangles of a scene in a bounding volume hierarchy (BVH), which answers what rays hit.
///
/// Rays are asked about one at a time ([`intersect1`](Self::intersect1), [`occluded1`](Self::occluded1)) or as a slice
/// ([`intersect`](Self::intersect), [`occluded`](Self::occluded)). Slices are faster where neighbouring rays are similar,
/// as a camera's are. Both give the same hits to the bit, and those are what a loop over all triangles with
/// [`ShearedRay::intersect`](crate::shape::ShearedRay::intersect) gives.
///
/// ```
/// use lobe::TriangleMesh;
/// use lobe::accel::{Accel, Hit};
/// use lobe::geometry::Ray;
/// use lobe::glam::Vec3;
///
/// // One triangle in the plane z = 2.
/// let mesh = TriangleMesh {
///     positions: vec![Vec3::new(0.0, 0.0, 2.0), Vec3::new(1.0, 0.0, 2.0), Vec3::new(0.0, 1.0, 2.0)],
///     indices: vec![[0, 1, 2]],
///     ..TriangleMesh::default()
/// };
/// let accel = Accel::build(&[mesh]);
///
/// // One ray.
/// let ray = Ray::new(Vec3::new(0.25, 0.5, 0.0), Vec3::Z);
/// let hit = accel.intersect1(&ray);
/// assert!(hit.is_hit());
/// assert_eq!((hit.t, hit.shape, hit.triangle), (2.0, 0, 0));
/// assert_eq!(hit.b, [0.25, 0.25, 0.5]);
///
/// // A batch of a thousand rays, half of which miss.
/// let rays: Vec<Ray> =
///     (0..1000).map(|i| Ray::new(Vec3::new(i as f32 / 500.0, 0.0, 0.0), Vec3::Z)).collect();
/// let mut hits = vec![Hit::MISS; rays.len()];
/// accel.intersect(&rays, &mut hits);
/// assert_eq!(hits.iter().filter(|hit| hit.is_hit()).count(), 501);
/// ```
#[doc(alias = "bvh")]
#[doc(alias = "bounding volume hierarchy")]
#[doc(alias = "acceleration structure")]
#[derive(Clone, Debug)]
pub struct Accel {
    /// Over all meshes without instances.
    bvh: Bvh,
    /// Over those with instances, if there are any.
    forest: Option<Box<Forest>>,
    instruction_set: InstructionSet,
}

impl Accel {
    /// Maximum number of triangles.
    pub const MAX_TRIANGLES: usize = MAX_TRIANGLES;
    /// Maximum number of instances.
    pub const MAX_INSTANCES: usize = 500_000;

    /// Builds the tree over all triangles of all meshes, for the fastest instruction set, on as many threads as the
    /// system offers. The tree does not depend on their number. Triangles without area are left out: no ray can hit
    /// them. The meshes must have passed [`TriangleMesh::check`].
    ///
    /// # Panics
    /// If there are more than [`Accel::MAX_TRIANGLES`].
    pub fn build(meshes: &[TriangleMesh]) -> Self {
        Self::build_for(InstructionSet::fastest(), meshes)
    }

    /// As [`Accel::build`], for an instruction set of choice. Leaves hold as many triangles as it tests at once, so the tree
    /// may differ from one to another.
    ///
    /// # Panics
    /// If there are more than [`Accel::MAX_TRIANGLES`].
    pub fn build_for(instruction_set: InstructionSet, meshes: &[TriangleMesh]) -> Self {
        Self::build_with_instances(instruction_set, meshes, &[])
    }

    /// As [`Accel::build_for`], with instances of meshes. A mesh that has any is kept once, in a tree of its own, and each instance costs no more
    /// than its place. Hits on instances are those on the mesh with its [transform](TriangleMesh::transform), to the bit; their shape counts on from the last mesh.
    ///
    /// # Panics
    /// If there are more triangles than [`Accel::MAX_TRIANGLES`], not counting instances, or more instances than [`Accel::MAX_INSTANCES`], or one refers to a mesh that there is not.
    pub fn build_with_instances(
        instruction_set: InstructionSet,
        meshes: &[TriangleMesh],
        instances: &[Instance],
    ) -> Self {
        let count: usize = meshes.iter().map(|mesh| mesh.indices.len()).sum();
        assert!(count <= Self::MAX_TRIANGLES, "{count} triangles are more than a tree can hold");
        let (max, found) = (Self::MAX_INSTANCES, instances.len());
        assert!(found <= max, "{found} instances are more than a tree can hold");
        let (nothing, leaf_lanes) = (TriangleMesh::default(), instruction_set.leaf_lanes());
        let mut in_place: Vec<&TriangleMesh> = meshes.iter().collect();
        instances.iter().for_each(|instance| in_place[instance.mesh as usize] = &nothing);
        let bvh = build::build(&in_place, build::available_threads(), leaf_lanes);
        let forest = (!instances.is_empty())
            .then(|| Box::new(build::build_forest(meshes, instances, leaf_lanes)));
        Self { bvh, forest, instruction_set }
    }

    /// The box around all triangles.
    pub fn bounds(&self) -> Aabb {
        self.forest.iter().fold(self.bvh.bounds, |bounds, forest| bounds.union(forest.bounds))
    }

    /// Number of triangles that can be hit, those of instances not counted.
    pub fn triangle_count(&self) -> usize {
        self.trees().map(|tree| tree.leaves.triangle_count()).sum()
    }

    /// Number of nodes of all trees.
    pub fn node_count(&self) -> usize {
        let above = self.forest.as_ref().map_or(0, |forest| forest.nodes.len());
        self.trees().map(|tree| tree.nodes.len()).sum::<usize>() + above
    }

    /// Most nodes on the way from the root to a leaf.
    pub fn depth(&self) -> usize {
        let below = |forest: &Forest| forest.trees.iter().map(|tree| tree.depth).max().unwrap_or(0);
        let of_forest = self.forest.as_ref().map_or(0, |forest| forest.depth + below(forest));
        self.bvh.depth.max(of_forest)
    }

    /// Bytes of the trees, with their copies of the triangles.
    pub fn memory(&self) -> usize {
        self.bvh.memory() + self.forest.as_ref().map_or(0, |forest| forest.memory())
    }

    fn trees(&self) -> impl Iterator<Item = &Bvh> {
        std::iter::once(&self.bvh).chain(self.forest.iter().flat_map(|forest| &forest.trees))
    }

    /// The instruction set that rays are traced with.
    pub fn instruction_set(&self) -> InstructionSet {
        self.instruction_set
    }

    /// Traces rays through the same tree with another instruction set, which may be slower than
    /// [building](Accel::build_for) the tree for it.
    #[must_use]
    pub fn with_instruction_set(self, instruction_set: InstructionSet) -> Self {
        Self { instruction_set, ..self }
    }

    /// The closest hit of each ray.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    pub fn intersect(&self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len());
        self.run(&self.bvh, Batch { answers: hits }, rays);
        if let Some(forest) = &self.forest {
            self.run(&**forest, InForest { answers: hits }, rays);
        }
    }

    /// Whether each ray hits anything.
    ///
    /// # Panics
    /// If `occluded` is not as long as `rays`.
    pub fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        assert_eq!(rays.len(), occluded.len());
        self.run(&self.bvh, Batch { answers: occluded }, rays);
        if let Some(forest) = &self.forest {
            self.run(&**forest, InForest { answers: occluded }, rays);
        }
    }

    /// The closest hit of one ray. Of triangles at the same distance, the first counts. Many single rays are faster by a
    /// [`Tracer`].
    pub fn intersect1(&self, ray: &Ray) -> Hit {
        Stack::with(|stack| self.closest_hit(ray, stack))
    }

    /// Whether one ray hits anything.
    pub fn occluded1(&self, ray: &Ray) -> bool {
        Stack::with(|stack| self.any_hit(ray, stack))
    }

    /// Traces single rays without looking up memory of the thread for each.
    pub fn tracer(&self) -> Tracer<'_> {
        Tracer { accel: self, stack: Stack::boxed() }
    }

    #[inline(always)]
    fn closest_hit(&self, ray: &Ray, stack: &mut Stack) -> Hit {
        let mut hit = Hit::MISS;
        let kernel = ClosestHit { space: World, start: Start::ROOT, hit: &mut hit };
        self.instruction_set.run(&self.bvh, stack, ray, kernel);
        self.bvh.tell_shape(&mut hit);
        if let Some(forest) = &self.forest {
            let answers = std::slice::from_mut(&mut hit);
            let rays = std::slice::from_ref(ray);
            self.instruction_set.run(&**forest, stack, rays, InForest { answers });
        }
        hit
    }

    #[inline(always)]
    fn any_hit(&self, ray: &Ray, stack: &mut Stack) -> bool {
        let kernel = AnyHit(World, Start::ROOT);
        let mut occluded = self.instruction_set.run(&self.bvh, stack, ray, kernel);
        if let Some(forest) = &self.forest {
            let answers = std::slice::from_mut(&mut occluded);
            let rays = std::slice::from_ref(ray);
            self.instruction_set.run(&**forest, stack, rays, InForest { answers });
        }
        occluded
    }

    #[inline(always)]
    fn run<K: Kernel<Scratch = Stack>>(
        &self,
        data: &K::Data,
        kernel: K,
        input: &K::Input,
    ) -> K::Output {
        Stack::with(|stack| self.instruction_set.run(data, stack, input, kernel))
    }
}

/// Traces single rays, as [`Accel::intersect1`] and [`Accel::occluded1`] do, with scratch memory of its own. One for each thread.
pub struct Tracer<'a> {
    accel: &'a Accel,
    stack: Box<Stack>,
}

impl Tracer<'_> {
    /// The closest hit of one ray. Of triangles at the same distance, the first counts.
    #[inline]
    pub fn intersect1(&mut self, ray: &Ray) -> Hit {
        self.accel.closest_hit(ray, &mut self.stack)
    }

    /// Whether one ray hits anything.
    #[inline]
    pub fn occluded1(&mut self, ray: &Ray) -> bool {
        self.accel.any_hit(ray, &mut self.stack)
    }
}
