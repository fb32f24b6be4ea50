//! [`merge`]: from three indices per corner, as in OBJ, to one, as in [`TriangleMesh`].

use glam::{DVec3, Vec3};

use super::attributes::Attributes;
use super::faces::{Faces, NONE};
use super::report::{ObjMaterials, ObjMesh, ObjReport};
use crate::shape::mesh::TriangleMesh;

/// Indices of a corner's texture coordinate and normal, or [`NONE`].
type UvNormal = [u32; 2];

/// Gives each corner a single index, and fills in the report.
///
/// Vertex i of the file remains vertex i of the mesh, with the texture coordinate and normal of the
/// first corner that refers to it. For corners with others, copies of the vertex are appended, in
/// the order of (vertex, texture coordinate, normal). `None` if there are more vertices than a
/// `u32` can index.
pub(super) fn merge(faces: Faces, attributes: Attributes) -> Option<ObjMesh> {
    let mut positions = attributes.positions;
    let mut indices = faces.vertices;
    let degenerate = |t: &&[u32; 3]| is_degenerate(t.map(|v| positions[v as usize]));
    let degenerate_triangles = indices.iter().filter(degenerate).count();

    let mut used = vec![false; positions.len()];
    let mut uv_normals = vec![[NONE; 2]; positions.len()];
    let mut others: Vec<(u32, UvNormal, usize)> = Vec::new();
    for (i, triangle) in indices.iter().enumerate() {
        let textures = faces.textures.get(i).unwrap_or(&[NONE; 3]);
        let normals = faces.normals.get(i).unwrap_or(&[NONE; 3]);
        for (k, &v) in triangle.iter().enumerate() {
            let uv_normal = [textures[k], normals[k]];
            let first = &mut uv_normals[v as usize];
            if !used[v as usize] {
                used[v as usize] = true;
                *first = uv_normal;
            } else if *first != uv_normal {
                others.push((v, uv_normal, 3 * i + k));
            }
        }
    }

    // Sorting groups the corners that share a copy. Unlike hashing, no input makes it slow.
    others.sort_unstable();
    for corners in others.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (v, uv_normal, _) = corners[0];
        let index = u32::try_from(positions.len()).ok()?;
        positions.push(positions[v as usize]);
        uv_normals.push(uv_normal);
        for &(_, _, corner) in corners {
            indices[corner / 3][corner % 3] = index;
        }
    }

    let uvs = match faces.textures.is_empty() {
        true => Vec::new(),
        false => uv_normals.iter().map(|&[uv, _]| get(&attributes.textures, uv)).collect(),
    };
    let mut normals = match faces.normals.is_empty() {
        true => Vec::new(),
        false => uv_normals.iter().map(|&[_, n]| get(&attributes.normals, n)).collect(),
    };
    if normals.iter().all(|&n| n == Vec3::ZERO) {
        normals = Vec::new();
    }
    let unused_vertices = used.iter().filter(|&&used| !used).count();
    let short_faces = faces.short;
    let report =
        ObjReport { degenerate_triangles, unused_vertices, short_faces, ..ObjReport::default() };
    let mesh = TriangleMesh { positions, normals, uvs, indices };
    Some(ObjMesh { mesh, materials: ObjMaterials::default(), report })
}

/// The value at `index`; zero for [`NONE`].
fn get<T: Copy + Default>(values: &[T], index: u32) -> T {
    if index == NONE { T::default() } else { values[index as usize] }
}

/// Whether a triangle has no area: corners that coincide or are collinear.
fn is_degenerate(corners: [Vec3; 3]) -> bool {
    // f64 represents differences and products of ordinary f32 coordinates exactly.
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    (b - a).cross(c - a) == DVec3::ZERO
}
