//! Evens out a mesh on the field's surface: each vertex slides towards the middle of its
//! neighbours, then Newton steps along the field's gradient bring it back onto the surface. No
//! step is longer than 0.4 of the lattice's, and only positions change, so the mesh stays the
//! manifold that it is.

use glam::DVec3;

use crate::field::Field;
use crate::mesh::Mesh;
use crate::parallel;

/// Slides every vertex `rounds` times; `h` is the edge of the lattice's cubes.
pub fn relax(mesh: &mut Mesh, field: &Field, h: f64, rounds: usize, threads: usize) {
    let (start, runs) = mesh.fans();
    let end = |e: u32| mesh.triangles[e as usize / 3][(e as usize % 3 + 1) % 3];
    for _ in 0..rounds {
        let old = &mesh.positions;
        let mut new = vec![DVec3::ZERO; old.len()];
        parallel::fill(&mut new, threads, |v| {
            let ring = &runs[start[v] as usize..start[v + 1] as usize];
            let sum: DVec3 = ring.iter().map(|&e| old[end(e) as usize]).sum();
            let pull = sum / ring.len() as f64 - old[v];
            let (value, gradient) = field.slope(old[v], 0.1 * h);
            let steepness = gradient.length_squared().max(0.1);
            let slide = pull - gradient * (pull.dot(gradient) / steepness);
            let rise = gradient * (value / steepness);
            old[v] + (0.6 * slide - rise).clamp_length_max(0.4 * h)
        });
        mesh.positions = new;
    }
}
