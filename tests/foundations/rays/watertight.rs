//! Closed meshes let no ray through.

use std::collections::BTreeMap;

use lobe::TriangleMesh;
use lobe::accel::{Accel, Hit};
use lobe::geometry::Ray;
use lobe::glam::Vec3;

use super::answers::{assert_batch, cut, orders};
use crate::common::Rng;
use crate::common::meshes::{lumpy, placed};

/// Scales and offsets: far from the origin the vertices are on a coarse grid.
fn placements() -> [(f32, Vec3); 5] {
    let far = Vec3::new(300.0, -1000.0, 20.0);
    [(1.0, Vec3::ZERO), (1e-6, Vec3::ZERO), (1e6, Vec3::ZERO), (1.0, far), (1e-3, far / 300.0)]
}

/// Every edge once, and for every vertex the triangles around it.
type Around = Vec<Vec<usize>>;
fn topology(mesh: &TriangleMesh) -> (BTreeMap<(u32, u32), Vec<usize>>, Around) {
    let (mut edges, mut around) = (BTreeMap::new(), vec![Vec::new(); mesh.positions.len()]);
    for (triangle, [a, b, c]) in mesh.indices.iter().copied().enumerate() {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            edges.entry((a.min(b), a.max(b))).or_insert_with(Vec::new).push(triangle);
        }
        [a, b, c].iter().for_each(|&v| around[v as usize].push(triangle));
    }
    assert!(edges.values().all(|triangles| triangles.len() == 2), "the mesh is closed");
    (edges, around)
}

/// Fails unless every ray hits: alone, for closest and any hit, and in batches of all
/// lengths, with the same hit as alone. `turn` selects whether the batches are unordered, coherent or mixed.
/// The index of a ray is its trial.
fn assert_closed(accel: &Accel, rays: &[Ray], turn: u64, what: &str) {
    let hits: Vec<Hit> = rays.iter().map(|ray| accel.intersect1(ray)).collect();
    for (trial, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
        assert!(hit.is_hit(), "{what}, trial {trial}: {ray:?} leaks");
        assert!(accel.occluded1(ray), "{what}, trial {trial}: {ray:?} leaks, asked for any hit");
    }
    let orders = orders(rays, &mut Rng::new(805, turn));
    for batch in cut(&orders[turn as usize % orders.len()]) {
        assert_batch(accel, rays, batch, &hits, what);
    }
}

/// Half of the rays are aimed exactly at vertices and the middles of edges. In half of the blocks of 1024 all
/// rays begin at one point, as a camera's do.
fn inside(mesh: &TriangleMesh, test: u64, count: u64) {
    const BLOCK: u64 = 1024;
    let (edges, _) = topology(mesh);
    let edges: Vec<_> = edges.into_keys().collect();
    for (place, (scale, offset)) in placements().into_iter().enumerate() {
        let mesh = placed(mesh.clone(), scale, offset);
        let accel = Accel::build(std::slice::from_ref(&mesh));
        let seed = test + place as u64;
        let ray = |trial: u64| {
            let mut rng = Rng::new(seed, trial);
            let origin = |rng: &mut Rng| offset + 0.5 * scale * rng.f32() * rng.direction();
            let mut o = origin(&mut rng);
            if trial / BLOCK % 2 == 1 {
                o = origin(&mut Rng::new(seed, trial / BLOCK * BLOCK));
            }
            let d = match rng.below(4) {
                0 => mesh.positions[rng.below(mesh.positions.len())] - o,
                1 => {
                    let (a, b) = edges[rng.below(edges.len())];
                    0.5 * (mesh.positions[a as usize] + mesh.positions[b as usize]) - o
                }
                _ => rng.direction(),
            };
            Ray::new(o, d)
        };
        for block in 0..count.div_ceil(8 * BLOCK) {
            // Eight thousand rays are sorted at a time.
            let trials = block * 8 * BLOCK..count.min((block + 1) * 8 * BLOCK);
            let rays: Vec<Ray> = trials.clone().map(ray).collect();
            let what = format!("place {place}, counted from trial {}", trials.start);
            assert_closed(&accel, &rays, block, &what);
        }
    }
}

/// 1e6 rays from inside. Caught: a ray along an edge taken to be outside of both neighbours; boxes neither
/// padded nor their far side moved by the rounding of the slabs; eight rays walked in the octant of the
/// first; a batch's rest left out; a bound on the error of t in the wrong units.
#[test]
fn nothing_leaks_from_inside() {
    inside(&lumpy(5, 1), 800, 200_000);
}

/// 1e6 rays from inside in each place, of a coarse and of a fine mesh.
#[test]
#[ignore = "takes half a minute"]
fn nothing_leaks_from_inside_in_full() {
    inside(&lumpy(2, 1), 850, 1_000_000);
    inside(&lumpy(7, 1), 860, 1_000_000);
}

/// Rays from the axes' crossing along the axes and their diagonals, at the vertices of the octahedron that
/// lie exactly there, with zeros of both signs. Caught: a ray along an edge taken to be outside; -0 taken for
/// forwards.
#[test]
fn nothing_leaks_along_axes() {
    for levels in 0..6 {
        let mut mesh = lumpy(levels, 2);
        // The first six vertices lie on the axes.
        mesh.positions[..6]
            .iter_mut()
            .for_each(|p| *p = p.signum() * p.abs().max_element() * p.abs().ceil());
        let accel = Accel::build(&[mesh]);
        let signs = [-1.0, -0.0, 0.0, 1.0];
        let directions = signs.map(|x| signs.map(|y| signs.map(|z| Vec3::new(x, y, z))));
        let rays: Vec<Ray> = directions
            .into_iter()
            .flatten()
            .flatten()
            .filter(|d| *d != Vec3::ZERO)
            .map(|d| Ray::new(Vec3::ZERO, d))
            .collect();
        for turn in 0..3 {
            assert_closed(&accel, &rays, turn, &format!("{levels} levels"));
        }
    }
}

/// Cameras 1, 17, 170 and 17,000 radii away, aimed at vertices and edges that they must hit: those around which
/// all triangles face the camera or all face away, so that they lie well inside of the outline.
fn outside(mesh: &TriangleMesh, test: u64, cameras: u64) {
    let (edges, around) = topology(mesh);
    let mut targets: Vec<(Vec3, Vec<usize>)> = mesh.positions.iter().copied().zip(around).collect();
    targets.extend(edges.into_iter().map(|((a, b), triangles)| {
        (0.5 * (mesh.positions[a as usize] + mesh.positions[b as usize]), triangles)
    }));
    let normals: Vec<Vec3> = (0..mesh.indices.len()).map(|t| mesh.geometric_normal(t)).collect();
    for (place, (scale, offset)) in placements().into_iter().enumerate() {
        let accel = Accel::build(&[placed(mesh.clone(), scale, offset)]);
        for (number, distance) in [1.0, 17.0, 170.0, 17e3].into_iter().enumerate() {
            for trial in 0..cameras {
                let mut rng = Rng::new(test + 4 * place as u64 + number as u64, trial);
                let camera = (1.3 + distance) * rng.direction();
                let must_be_hit = |(target, triangles): &&(Vec3, Vec<usize>)| {
                    let along = (target - camera).normalize();
                    let facing = |t: &usize| normals[*t].dot(along);
                    // Steep enough for the target's rounding not to reach the outline.
                    triangles.iter().all(|t| facing(t) > 0.2)
                        || triangles.iter().all(|t| facing(t) < -0.2)
                };
                let o = camera * scale + offset;
                let rays: Vec<Ray> = targets
                    .iter()
                    .filter(must_be_hit)
                    .map(|(target, _)| Ray::new(o, *target * scale + offset - o))
                    .collect();
                assert!(5 * rays.len() > targets.len(), "only {} targets", rays.len());
                let what = format!("place {place}, {distance} radii, camera {trial}");
                assert_closed(&accel, &rays, trial, &what);
            }
        }
    }
}

/// Caught: a bound on the error of t in the wrong units, or kept far from the triangles, where it outgrows t; eight rays
/// walked in the octant of the first; a batch's rest left out.
#[test]
fn nothing_leaks_seen_from_outside() {
    outside(&lumpy(5, 3), 8100, 3);
}

/// As above, from more cameras and at meshes from coarse to fine.
#[test]
#[ignore = "takes half a minute"]
fn nothing_leaks_seen_from_outside_in_full() {
    outside(&lumpy(2, 3), 8200, 100);
    outside(&lumpy(4, 3), 8300, 20);
    outside(&lumpy(7, 3), 8400, 1);
}
