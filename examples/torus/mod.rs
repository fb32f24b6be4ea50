//! A mesh that needs no file.

use std::f32::consts::TAU;

use lobe::TriangleMesh;
use lobe::glam::Vec3;

/// A torus about the y axis and the origin: the radius of its centre line, the radius of its tube, and the number of
/// vertices around each.
pub fn torus(radius: f32, tube: f32, n: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let vertex = |i: u32, j: u32| (i % n) * n + j % n;
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let [phi, theta] = [i, j].map(|k| TAU * k as f32 / n as f32);
        let out = Vec3::new(phi.cos(), 0.0, phi.sin());
        let normal = theta.cos() * out + theta.sin() * Vec3::Y;
        mesh.positions.push(radius * out + tube * normal);
        mesh.normals.push(normal);
        let [a, b, c, d] =
            [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)].map(|(i, j)| vertex(i, j));
        mesh.indices.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}
