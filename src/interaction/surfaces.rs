//! [`Surfaces`]: the meshes of a scene, and their instances.

use glam::Vec3;

use crate::shape::{Instance, PlacedMesh, TriangleMesh};

/// All that hits are on: the shape of a hit is a mesh, or behind all meshes an instance of one.
pub(crate) struct Surfaces {
    meshes: Vec<TriangleMesh>,
    /// Of each mesh.
    last_vertices: Vec<LastVertex>,
    instances: Vec<Instance>,
}

impl Surfaces {
    pub fn new(meshes: Vec<TriangleMesh>, instances: Vec<Instance>) -> Self {
        Self { last_vertices: meshes.iter().map(LastVertex::of).collect(), meshes, instances }
    }

    pub fn meshes(&self) -> &[TriangleMesh] {
        &self.meshes
    }

    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    #[inline(always)]
    pub fn has_instances(&self) -> bool {
        !self.instances.is_empty()
    }

    #[inline(always)]
    pub fn is_instance(&self, shape: u32) -> bool {
        shape as usize >= self.meshes.len()
    }

    /// The index of a shape's mesh.
    #[inline(always)]
    pub fn mesh_index(&self, shape: u32) -> usize {
        let shape = shape as usize;
        match shape.checked_sub(self.meshes.len()) {
            None => shape,
            Some(instance) => self.instances[instance].mesh as usize,
        }
    }

    /// A shape's mesh, where it does not stand if it is an instance.
    #[inline(always)]
    pub(super) fn mesh(&self, shape: u32) -> (&TriangleMesh, &LastVertex) {
        let mesh = self.mesh_index(shape);
        (&self.meshes[mesh], &self.last_vertices[mesh])
    }

    /// A shape's mesh, where it stands.
    #[inline]
    pub fn placed(&self, shape: u32) -> PlacedMesh<'_> {
        let instance = (shape as usize).checked_sub(self.meshes.len()).map(|i| &self.instances[i]);
        let mesh = &self.meshes[self.mesh_index(shape)];
        PlacedMesh::new(mesh, instance.map(|instance| &instance.placement))
    }
}

/// Position and normal of a mesh's last vertex, followed by a number without a meaning.
#[derive(Clone, Copy)]
pub(super) struct LastVertex {
    pub position: [f32; 4],
    pub normal: [f32; 4],
}

impl LastVertex {
    /// The last vertex of a mesh.
    pub fn of(mesh: &TriangleMesh) -> Self {
        let last = |vectors: &[Vec3]| vectors.last().unwrap_or(&Vec3::ZERO).extend(0.0).to_array();
        Self { position: last(&mesh.positions), normal: last(&mesh.normals) }
    }
}
