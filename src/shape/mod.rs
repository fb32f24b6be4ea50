//! Shapes: triangle meshes, the ray-triangle test, and reading them from Wavefront OBJ.

mod check;
mod mesh;
mod triangle;

pub use check::MeshError;
pub use mesh::TriangleMesh;
pub use triangle::{ShearedRay, TriangleHit, triangle_normal};
