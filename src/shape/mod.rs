//! Shapes: triangle meshes, the ray-triangle test, and reading them from Wavefront OBJ.

mod check;
mod mesh;
mod obj;
mod triangle;

pub use check::MeshError;
pub use mesh::TriangleMesh;
pub use obj::{ObjAttribute, ObjError, ObjMesh, ObjProblem, ObjReport, parse_obj, read_obj};
pub(crate) use triangle::{FAR, triangle_normals};
pub use triangle::{ShearedRay, TriangleHit, triangle_normal};
