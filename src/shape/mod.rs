//! Shapes: triangle meshes, the watertight ray-triangle test, and the reader of Wavefront OBJ
//! files.
//!
//! ```
//! use lobe::geometry::Ray;
//! use lobe::glam::Vec3;
//! use lobe::shape::{ShearedRay, parse_obj};
//!
//! let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
//! let mesh = parse_obj("triangle.obj", text.as_bytes())?.mesh;
//!
//! let ray = Ray::new(Vec3::new(0.25, 0.5, 2.0), -Vec3::Z);
//! let hit = ShearedRay::new(&ray).intersect(&mesh.corners(0), ray.t_min, ray.t_max).unwrap();
//! assert_eq!((hit.t, hit.b), (2.0, [0.25, 0.25, 0.5]));
//! # Ok::<(), lobe::shape::ObjError>(())
//! ```

mod check;
mod instance;
mod kind;
mod mesh;
mod mtl;
mod obj;
mod placed_mesh;
mod placement;
mod rectangle;
mod triangle;
mod watertight;

pub use check::MeshError;
pub use instance::Instance;
pub use kind::{Load, Read};
pub use mesh::TriangleMesh;
pub(crate) use mesh::shading_normal_wide;
pub use mtl::{MtlError, MtlLibrary, MtlMap, MtlMaterial, MtlNote, parse_mtl, read_mtl};
pub use obj::{
    ObjAttribute, ObjError, ObjMaterials, ObjMesh, ObjProblem, ObjReport, SkippedLines, parse_obj,
    read_obj,
};
pub(crate) use placed_mesh::PlacedMesh;
pub(crate) use placement::Placement;
pub(crate) use triangle::triangle_normal_wide;
pub use triangle::{TriangleHit, triangle_normal};
pub use watertight::ShearedRay;
pub(crate) use watertight::{Crossing, Edges, Reach, T_TOLERANCE, longest_axis};

use crate::params::Kind;

/// All kinds of shapes.
pub static SHAPES: &[Kind<Read>] = &[obj::KIND, rectangle::KIND];
