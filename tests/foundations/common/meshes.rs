//! Meshes for rays.

use std::collections::HashMap;

use lobe::TriangleMesh;
use lobe::glam::{DVec3, Vec3};
use lobe::shape::triangle_normal;

use super::Rng;

/// A closed surface around the origin whose radius is between 0.7 and 1.3: an octahedron whose faces
/// are cut into four `levels` times, with every vertex moved in or out. 8 · 4^levels triangles.
pub fn lumpy(levels: u32, seed: u64) -> TriangleMesh {
    let mut points: Vec<DVec3> =
        vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let mut indices: Vec<[u32; 3]> = vec![
        [0, 1, 2],
        [1, 3, 2],
        [3, 4, 2],
        [4, 0, 2],
        [1, 0, 5],
        [3, 1, 5],
        [4, 3, 5],
        [0, 4, 5],
    ];
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut finer = Vec::with_capacity(4 * indices.len());
        for [a, b, c] in indices {
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    points.push((points[a as usize] + points[b as usize]).normalize());
                    points.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        indices = finer;
    }
    // Bumps no steeper than the triangles are long.
    let amplitude = 0.3 / f64::from(1 << levels.saturating_sub(1));
    let lump = |i: usize, p: DVec3| {
        let waves = 0.1 * (5.0 * p.x + 1.0).sin() * (7.0 * p.y).cos() + 0.1 * (6.0 * p.z).sin();
        p * (1.0 + waves + amplitude * (Rng::new(seed, i as u64).f64() - 0.5).clamp(-0.3, 0.3))
    };
    let positions = points.into_iter().enumerate().map(|(i, p)| lump(i, p).as_vec3()).collect();
    TriangleMesh { positions, indices, ..TriangleMesh::default() }
}

/// The mesh, larger by `scale` and then moved.
pub fn placed(mut mesh: TriangleMesh, scale: f32, offset: Vec3) -> TriangleMesh {
    mesh.positions.iter_mut().for_each(|p| *p = *p * scale + offset);
    mesh
}

/// A mesh of this one triangle.
pub fn single(corners: [Vec3; 3]) -> TriangleMesh {
    TriangleMesh {
        positions: corners.to_vec(),
        indices: vec![[0, 1, 2]],
        ..TriangleMesh::default()
    }
}

/// Triangles that share nothing.
pub fn soup(triangles: &[[Vec3; 3]]) -> TriangleMesh {
    TriangleMesh {
        positions: triangles.concat(),
        indices: (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..TriangleMesh::default()
    }
}

/// A plane at y = 1 of `side` x `side` squares of two triangles, around the y axis; neighbours share
/// their corners.
pub fn grid(side: u32) -> TriangleMesh {
    let half = side as f32 / 2.0;
    let corner = |i: u32| Vec3::new((i % (side + 1)) as f32, 0.0, (i / (side + 1)) as f32);
    let positions =
        (0..(side + 1) * (side + 1)).map(|i| corner(i) + Vec3::new(-half, 1.0, -half)).collect();
    let indices = (0..side * side)
        .flat_map(|cell| {
            let a = cell % side + cell / side * (side + 1);
            let (b, c, d) = (a + 1, a + side + 1, a + side + 2);
            [[a, b, d], [a, d, c]]
        })
        .collect();
    TriangleMesh { positions, indices, ..TriangleMesh::default() }
}

/// Triangles of very different sizes, `count` with an area, dealt to several shapes. With `coordinates` of 1
/// they are shaped at random; with more, their coordinates are 10^U(-coordinates, coordinates), and most are
/// needles. Every tenth is one that was there before, with its corners as they were or turned round. Among
/// the shapes is an empty one, and in each stands a triangle without area.
pub fn mixture(count: usize, coordinates: f64, rng: &mut Rng) -> Vec<TriangleMesh> {
    let mut all: Vec<[Vec3; 3]> = Vec::with_capacity(count);
    while all.len() < count {
        let triangle = if rng.below(10) == 0 && !all.is_empty() {
            let mut again = all[rng.below(all.len())];
            again.rotate_left(rng.below(3));
            again
        } else if coordinates > 1.0 {
            [(); 3].map(|()| rng.point(coordinates))
        } else {
            let (at, size) = (rng.point(coordinates), rng.coordinate(coordinates).abs());
            [(); 3].map(|()| at + size * rng.direction())
        };
        if triangle_normal(triangle) != Vec3::ZERO {
            all.push(triangle);
        }
    }
    let mut shapes = vec![vec![[all[0][0]; 3]]; 1 + rng.below(4)];
    for triangle in all {
        let shape = rng.below(shapes.len());
        shapes[shape].push(triangle);
    }
    let mut meshes: Vec<TriangleMesh> = shapes.iter().map(|shape| soup(shape)).collect();
    meshes.insert(rng.below(meshes.len() + 1), TriangleMesh::default());
    meshes
}
