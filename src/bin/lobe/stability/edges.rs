//! Watertightness: rays aimed at edges and vertices of a closed mesh must not pass through it.

use std::collections::BTreeMap;

use lobe::TriangleMesh;
use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::{DVec3, Vec3};

use super::rng::Rng;
use super::sweep::Sweep;
use super::tally::{half_decades, measured, trials};
use super::usual_triangle::moeller_trumbore;

/// Squares along each edge of the cube that is deformed to the mesh.
const SIDE: i32 = 6;
/// Radius of a ball inside the mesh, whose vertices are at radii from 0.9 to 1.1.
const INNER: f64 = 0.6;
/// The tolerance printed by Möller and Trumbore.
const EPSILON: f32 = 1e-6;

/// Meshes from tiny to huge.
pub fn by_scale(effort: f64) -> Sweep {
    let parameters = half_decades(-6, 6);
    Sweep {
        name: "edges-scale",
        title: "Rays that pass through shared edges, by the mesh's scale",
        parameter: "radius of the mesh (scene units)",
        bounds: vec![0.0; parameters.len()],
        ..sweep(parameters, effort, |scale| Placement { scale, distance: 3.0, offset: 0.0 })
    }
}

/// Ray origins near and far.
pub fn by_distance(effort: f64) -> Sweep {
    let parameters: Vec<f64> = half_decades(0, 6).split_off(1);
    Sweep {
        name: "edges-distance",
        title: "Rays that pass through shared edges, by the distance of their origins",
        parameter: "distance of the ray's origin (radii of the mesh)",
        bounds: vec![0.0; parameters.len()],
        ..sweep(parameters, effort, |distance| Placement { scale: 1.0, distance, offset: 0.0 })
    }
}

/// Meshes far from the world's origin.
pub fn by_offset(effort: f64) -> Sweep {
    let parameters = half_decades(0, 6);
    Sweep {
        name: "edges-offset",
        title: "Rays through shared edges, by the mesh's distance from the world's origin",
        parameter: "distance of the mesh from the world's origin (radii of the mesh)",
        bounds: vec![0.0; parameters.len()],
        ..sweep(parameters, effort, |offset| Placement { scale: 1.0, distance: 3.0, offset })
    }
}

/// Size and position of the mesh and of the ray origins.
struct Placement {
    scale: f64,
    /// Distance of the ray origins from the mesh's centre, in multiples of `scale`.
    distance: f64,
    /// Distance of the mesh from the world's origin, in multiples of `scale`.
    offset: f64,
}

fn sweep(parameters: Vec<f64>, effort: f64, placement: impl Fn(f64) -> Placement + Sync) -> Sweep {
    let rays = trials(20_000, effort, 400);
    let named = [
        ("Möller-Trumbore", false),
        ("Möller-Trumbore, tolerance 1e-6", false),
        ("watertight test in the tree (ours)", true),
    ];
    let methods = measured(&parameters, named, |seed, parameter| {
        leaks(&placement(parameter), &mut Rng::new(seed as u64), rays)
            .map(|leaks| f64::from(leaks) / f64::from(rays))
    });
    Sweep {
        name: "",
        title: "",
        about: format!(
            "Rays from outside of a closed, bumpy mesh of {} triangles, aimed at vertices and points of shared \
             edges. A ray fails if it hits nothing before its closest approach to the mesh's centre. Truth: only rays count \
             that, in f64 from the f32 ray, go through a ball inside the mesh. {rays} \
             rays for each point. The common test is Möller and Trumbore's of 1997, over all triangles, without a \
             tolerance on the determinant and with the printed one.",
            12 * SIDE * SIDE
        ),
        parameter: "",
        log_parameter: true,
        measure: "share of rays that pass through",
        methods,
        fails_from: 1e-3,
        bounds: Vec::new(),
        parameters,
    }
}

/// Number of rays, of `rays`, that miss the surface, by method.
fn leaks(placement: &Placement, rng: &mut Rng, rays: u32) -> [u32; 3] {
    let center = placement.scale * placement.offset * rng.direction();
    let mesh = bumpy(rng, |v| (center + placement.scale * v).as_vec3());
    let corners: Vec<[Vec3; 3]> = (0..mesh.indices.len()).map(|t| mesh.corners(t)).collect();
    let accel = Accel::build(std::slice::from_ref(&mesh));
    let mut leaks = [0; 3];
    for _ in 0..rays {
        let (ray, middle) = loop {
            if let Some(aimed) = aim(placement, center, &corners, rng) {
                break aimed;
            }
        };
        let found = |t: f32| f64::from(t) < middle;
        let any = |epsilon: f32| {
            let mut hits = corners.iter().filter_map(|c| moeller_trumbore(&ray, c, epsilon));
            hits.any(found)
        };
        let all = [any(0.0), any(EPSILON), found(accel.intersect1(&ray).t)];
        for (leaks, found) in leaks.iter_mut().zip(all) {
            *leaks += u32::from(!found);
        }
    }
    leaks
}

/// A ray at a random edge or vertex, and the t of its closest approach to the centre; `None` unless it has to hit the
/// surface before that.
fn aim(
    placement: &Placement,
    center: DVec3,
    corners: &[[Vec3; 3]],
    rng: &mut Rng,
) -> Option<(Ray, f64)> {
    let Placement { scale, distance, .. } = *placement;
    let side = rng.direction();
    let o = (center + scale * distance * side).as_vec3();
    let [a, b, _] = corners[(rng.bits() % corners.len() as u64) as usize].map(Vec3::as_dvec3);
    // A quarter of the rays are aimed at vertices.
    let share = if rng.bits() >> 62 == 0 { 0.0 } else { rng.unit() };
    let target = a + share * (b - a);
    if (target - center).dot(side) <= 0.0 {
        return None;
    }
    let d = (target.as_vec3() - o).try_normalize()?;
    let (exact_d, from) = (d.as_dvec3(), center - o.as_dvec3());
    let middle = from.dot(exact_d) / exact_d.length_squared();
    let passes_by = (from - middle * exact_d).length();
    (middle > 0.0 && passes_by < INNER * scale).then_some((Ray::new(o, d), middle))
}

/// A tessellated cube, projected to a sphere and made bumpy; `vertex_at` places its vertices in the world.
fn bumpy(rng: &mut Rng, vertex_at: impl Fn(DVec3) -> Vec3) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let mut known = BTreeMap::new();
    for side in 0..6 {
        let (axis, sign) = (side / 2, if side % 2 == 0 { 1 } else { -1 });
        let mut vertex = |i: i32, j: i32| {
            // Neighbouring sides share the vertices of their common edge.
            let mut lattice = [0; 3];
            lattice[axis] = sign * SIDE;
            lattice[(axis + 1) % 3] = 2 * i - SIDE;
            lattice[(axis + 2) % 3] = sign * (2 * j - SIDE);
            *known.entry(lattice).or_insert_with(|| {
                let v = DVec3::from(lattice.map(f64::from)).normalize();
                mesh.positions.push(vertex_at(v * (0.9 + 0.2 * rng.unit())));
                mesh.positions.len() as u32 - 1
            })
        };
        for (i, j) in (0..SIDE * SIDE).map(|square| (square % SIDE, square / SIDE)) {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(i, j));
            mesh.indices.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}
