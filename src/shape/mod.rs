//! Shapes: triangle meshes, the ray-triangle test, and reading them from Wavefront OBJ.

mod check;
mod mesh;
mod obj;
mod rectangle;
mod triangle;

pub use check::MeshError;
pub use mesh::TriangleMesh;
pub use obj::{ObjAttribute, ObjError, ObjMesh, ObjProblem, ObjReport, parse_obj, read_obj};
pub(crate) use triangle::FAR;
pub use triangle::{ShearedRay, TriangleHit, triangle_normal};

use crate::params::{Fault, Kind, Table};

/// How a kind of shape is read. Settings come first and files last: what is returned reads the mesh itself.
pub type Read = fn(&Table) -> Result<Load, Fault>;

/// Makes the mesh of a shape, for example from its file.
pub type Load = Box<dyn FnOnce() -> Result<ObjMesh, Fault>>;

/// All kinds of shapes.
pub static SHAPES: &[Kind<Read>] = &[obj::KIND, rectangle::KIND];
