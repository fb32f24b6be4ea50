//! [`merge`]: from the three indices of a corner in OBJ to the one of [`TriangleMesh`].

use glam::{DVec3, Vec3};

use super::faces::{Faces, NONE};
use super::numbers::Numbers;
use super::{ObjMesh, ObjReport};
use crate::shape::TriangleMesh;

/// Texture coordinate and normal of a corner, or [`NONE`].
type Look = [u32; 2];

/// Gives each corner one index, and counts what the report tells.
///
/// Vertex i of the file stays vertex i of the mesh, with the look of the first corner that refers to
/// it. Copies of vertices for corners with other looks follow, in the order of (vertex, look).
/// `None` if a `u32` can't number them all.
pub(super) fn merge(faces: Faces, numbers: Numbers) -> Option<ObjMesh> {
    let mut positions = numbers.positions;
    let mut indices = faces.vertices;
    let degenerate = |t: &&[u32; 3]| is_degenerate(t.map(|v| positions[v as usize]));
    let degenerate_triangles = indices.iter().filter(degenerate).count();

    let mut used = vec![false; positions.len()];
    let mut looks = vec![[NONE; 2]; positions.len()];
    let mut others: Vec<(u32, Look, usize)> = Vec::new();
    for (i, triangle) in indices.iter().enumerate() {
        let textures = faces.textures.get(i).unwrap_or(&[NONE; 3]);
        let normals = faces.normals.get(i).unwrap_or(&[NONE; 3]);
        for (k, &v) in triangle.iter().enumerate() {
            let look = [textures[k], normals[k]];
            let first = &mut looks[v as usize];
            if !used[v as usize] {
                used[v as usize] = true;
                *first = look;
            } else if *first != look {
                others.push((v, look, 3 * i + k));
            }
        }
    }

    // Sorting brings the corners together that share a copy, with no hash that input could defeat.
    others.sort_unstable();
    for corners in others.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (v, look, _) = corners[0];
        let index = u32::try_from(positions.len()).ok()?;
        positions.push(positions[v as usize]);
        looks.push(look);
        for &(_, _, corner) in corners {
            indices[corner / 3][corner % 3] = index;
        }
    }

    let uvs = match faces.textures.is_empty() {
        true => Vec::new(),
        false => looks.iter().map(|look| get(&numbers.textures, look[0])).collect(),
    };
    let mut normals = match faces.normals.is_empty() {
        true => Vec::new(),
        false => looks.iter().map(|look| get(&numbers.normals, look[1])).collect(),
    };
    if normals.iter().all(|&n| n == Vec3::ZERO) {
        normals = Vec::new();
    }
    let unused_vertices = used.iter().filter(|&&used| !used).count();
    let report = ObjReport { degenerate_triangles, unused_vertices };
    Some(ObjMesh { mesh: TriangleMesh { positions, normals, uvs, indices }, report })
}

/// The value that a corner names, or zero if it names none.
fn get<T: Copy + Default>(values: &[T], index: u32) -> T {
    if index == NONE { T::default() } else { values[index as usize] }
}

/// Whether a triangle has no area: corners that coincide, or that lie on one line.
fn is_degenerate(corners: [Vec3; 3]) -> bool {
    // In f64 neither the differences nor the products of ordinary f32 coordinates are rounded.
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    (b - a).cross(c - a) == DVec3::ZERO
}
