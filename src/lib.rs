#![allow(dead_code, unused_imports)]
pub use glam;
#[path="/work/main/src/simd/mod.rs"] pub mod simd;
#[path="/work/main/src/geometry/mod.rs"] pub mod geometry;
#[path="/work/main/src/accel/mod.rs"] pub mod accel;
pub mod interaction { #[path="/work/main/src/interaction/hit.rs"] mod hit; pub use hit::Hit; }
pub mod shape {
#[path="/work/main/src/shape/instance.rs"] mod instance;
#[path="/work/main/src/shape/mesh.rs"] mod mesh;
#[path="/work/main/src/shape/check.rs"] mod check;
#[path="/work/main/src/shape/placement.rs"] mod placement;
#[path="/work/main/src/shape/triangle.rs"] mod triangle;
#[path="/work/main/src/shape/watertight.rs"] mod watertight;
pub use instance::Instance; pub use mesh::TriangleMesh; pub(crate) use placement::Placement; pub(crate) use mesh::shading_normal_wide;
pub use check::MeshError;
pub use triangle::{TriangleHit, triangle_normal};
pub(crate) use triangle::triangle_normal_wide;
pub use watertight::ShearedRay;
pub(crate) use watertight::{Crossing, Edges, Reach, T_TOLERANCE, longest_axis};
pub struct ObjMesh { pub mesh: TriangleMesh }
pub fn read_obj(p: &std::path::Path) -> Result<ObjMesh, Box<dyn std::error::Error>> {
  let s = std::fs::read_to_string(p)?; let mut m = TriangleMesh::default();
  for l in s.lines() { let mut w = l.split_whitespace(); match w.next() {
    Some("v") => { let mut f = || w.next().unwrap().parse::<f32>().unwrap(); m.positions.push(glam::Vec3::new(f(), f(), f())); }
    Some("f") => { let v: Vec<u32> = w.map(|t| t.split('/').next().unwrap().parse::<u32>().unwrap()-1).collect(); for k in 2..v.len() { m.indices.push([v[0], v[k-1], v[k]]); } }
    _ => {} } }
  Ok(ObjMesh { mesh: m }) }
}
pub use shape::TriangleMesh;
