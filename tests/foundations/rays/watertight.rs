//! Closed meshes let no ray through.

use std::collections::BTreeMap;

use lobe::TriangleMesh;
use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::{Vec2, Vec3};
use lobe::shape::ShearedRay;

use crate::common::Rng;
use crate::common::meshes::{lumpy, placed};

/// Sizes and places, as scale and offset: far from the origin the vertices sit on a coarse grid.
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

/// 1e6 rays from inside, half of them aimed exactly at vertices and the middles of edges. Caught: edge
/// functions told apart by `<=`, so that a ray along an edge is outside of both neighbours.
#[test]
fn nothing_leaks_from_inside() {
    let mesh = lumpy(5, 1);
    let (edges, _) = topology(&mesh);
    let edges: Vec<_> = edges.into_keys().collect();
    for (place, (scale, offset)) in placements().into_iter().enumerate() {
        let mesh = placed(mesh.clone(), scale, offset);
        let accel = Accel::build(std::slice::from_ref(&mesh));
        for trial in 0..200_000 {
            let mut rng = Rng::new(800 + place as u64, trial);
            let o = offset + 0.5 * scale * rng.f32() * rng.direction();
            let d = match rng.below(4) {
                0 => mesh.positions[rng.below(mesh.positions.len())] - o,
                1 => {
                    let (a, b) = edges[rng.below(edges.len())];
                    0.5 * (mesh.positions[a as usize] + mesh.positions[b as usize]) - o
                }
                _ => rng.direction(),
            };
            let ray = Ray::new(o, d);
            assert!(accel.intersect1(&ray).is_hit(), "place {place}, trial {trial}: {ray:?}");
            assert!(accel.occluded1(&ray), "place {place}, trial {trial}: {ray:?}");
        }
    }
}

/// Rays from the axes' crossing along the axes and their diagonals, at the vertices of the octahedron
/// that lie exactly there, with zeros of both signs. Caught: as above; -0 taken for forwards.
#[test]
fn nothing_leaks_along_axes() {
    for levels in 0..6 {
        let mut mesh = lumpy(levels, 2);
        // The first six vertices lie on the axes.
        mesh.positions[..6]
            .iter_mut()
            .for_each(|p| *p = p.signum() * p.abs().max_element() * p.abs().ceil());
        let accel = Accel::build(&[mesh]);
        for x in [-1.0, -0.0, 0.0, 1.0] {
            for y in [-1.0, -0.0, 0.0, 1.0] {
                for z in [-1.0, -0.0, 0.0, 1.0] {
                    let d = Vec3::new(x, y, z);
                    let hit =
                        d == Vec3::ZERO || accel.intersect1(&Ray::new(Vec3::ZERO, d)).is_hit();
                    assert!(hit, "{levels} levels, direction {d:?}");
                }
            }
        }
    }
}

/// Cameras 1, 17 and 170 radii away, aimed at vertices and edges that they must hit: those around which
/// all triangles face the camera or all face away, so that they lie well inside of the outline. Caught: a
/// bound on the error of t in the wrong units.
#[test]
fn nothing_leaks_seen_from_outside() {
    let mesh = lumpy(5, 3);
    let (edges, around) = topology(&mesh);
    let mut targets: Vec<(Vec3, Vec<usize>)> = mesh.positions.iter().copied().zip(around).collect();
    targets.extend(edges.into_iter().map(|((a, b), triangles)| {
        (0.5 * (mesh.positions[a as usize] + mesh.positions[b as usize]), triangles)
    }));
    let normals: Vec<Vec3> = (0..mesh.indices.len()).map(|t| mesh.geometric_normal(t)).collect();
    for (place, (scale, offset)) in placements().into_iter().enumerate() {
        let placed_mesh = placed(mesh.clone(), scale, offset);
        let accel = Accel::build(&[placed_mesh]);
        for (number, distance) in [1.0, 17.0, 170.0].into_iter().enumerate() {
            let mut aimed = 0;
            for trial in 0..5 {
                let mut rng = Rng::new(810, trial + 10 * number as u64 + 100 * place as u64);
                let camera = (1.3 + distance) * rng.direction();
                for (target, triangles) in &targets {
                    let along = (target - camera).normalize();
                    let facing = |t: &usize| normals[*t].dot(along);
                    // Steep enough for the target's rounding not to reach the outline.
                    if !(triangles.iter().all(|t| facing(t) > 0.2)
                        || triangles.iter().all(|t| facing(t) < -0.2))
                    {
                        continue;
                    }
                    aimed += 1;
                    let o = camera * scale + offset;
                    let ray = Ray::new(o, target * scale + offset - o);
                    assert!(
                        accel.intersect1(&ray).is_hit(),
                        "place {place}, {distance} radii, trial {trial}: {ray:?}"
                    );
                }
            }
            assert!(aimed > 50_000, "only {aimed} targets");
        }
    }
}

/// Which side of an edge a ray passes is told exactly, however close: along the z axis, where the shear
/// rounds nothing, against the sign of the edge function in f64, which holds it. Caught: an edge function of
/// 0 without its second look in f64, which hits beside the triangle.
#[test]
fn edges_are_told_exactly() {
    let ray = ShearedRay::new(&Ray::new(Vec3::ZERO, Vec3::Z));
    let mut close = 0;
    for trial in 0..200_000 {
        let mut rng = Rng::new(811, trial);
        // An edge past the axis within a few units of the last place, and a corner well off it.
        let p = rng.direction().truncate();
        let q = -p * rng.within(0.5, 2.0);
        let nudge = |x: f32, rng: &mut Rng| (0..rng.below(4)).fold(x, |x, _| x.next_up());
        let q = Vec2::new(nudge(q.x, &mut rng), nudge(q.y, &mut rng));
        let r = p.perp() * rng.sign();
        let corners = [p, q, r].map(|c| c.extend(1.0));
        let edge = |a: Vec2, b: Vec2| a.as_dvec2().perp_dot(b.as_dvec2());
        let e = [edge(p, q), edge(q, r), edge(r, p)];
        let hit = e.iter().all(|&e| e >= 0.0) || e.iter().all(|&e| e <= 0.0);
        let found = ray.intersect(&corners, 0.0, f32::INFINITY).is_some();
        assert_eq!(found, hit, "trial {trial}: {corners:?}, edge functions {e:?}");
        close += u32::from(p.x * q.y - p.y * q.x == 0.0 && e[0] != 0.0);
    }
    assert!(close > 1000, "only {close} edges needed more than f32");
}
