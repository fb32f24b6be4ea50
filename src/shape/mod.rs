//! Shapes: triangle meshes, the ray-triangle test, and reading them from Wavefront OBJ.

mod mesh;

pub use mesh::TriangleMesh;
