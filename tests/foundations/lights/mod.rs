//! Lights with an extent: their methods agree with each other and with closed forms of irradiance.

mod choice;
mod consistency;
mod environment;
mod extremes;
mod irradiance;
mod point;
mod shadow;
mod spot;
mod surroundings;
mod textured;
mod tree;

use lobe::accel::Accel;
use lobe::geometry::Ray;
use lobe::glam::{DVec3, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::light::LightHit;
use lobe::{Spectrum, TriangleMesh};

const L: Spectrum = Spectrum::new(3.0, 2.0, 1.0);

/// Two triangles with four corners, seen counter-clockwise from `x` × `y`.
fn rectangle(corner: Vec3, x: Vec3, y: Vec3) -> TriangleMesh {
    TriangleMesh {
        positions: vec![corner, corner + x, corner + x + y, corner + y],
        indices: vec![[0, 1, 2], [0, 2, 3]],
        ..TriangleMesh::default()
    }
}

/// Where a ray from `origin` along `wi` hits the mesh.
fn trace(accel: &Accel, mesh: &TriangleMesh, origin: Vec3, wi: Vec3) -> Option<LightHit<'static>> {
    let hit = accel.intersect1(&Ray::new(origin, wi));
    hit.is_hit().then(|| {
        let si = SurfaceInteraction::on_triangle(mesh, hit.triangle as usize, hit.b, -wi);
        LightHit::new(origin, wi, hit.t, si.n())
    })
}

/// Irradiance at `p` with unit normal `n` from a polygon of radiance 1 that is above the horizon: Lambert's
/// formula of 1760, half the sum of the angles of the edges times the cosines of their planes. Positive from
/// where the corners run counter-clockwise.
fn lambert(p: Vec3, n: DVec3, corners: &[Vec3]) -> f64 {
    let towards: Vec<DVec3> = corners.iter().map(|c| c.as_dvec3() - p.as_dvec3()).collect();
    let edges = towards.iter().zip(towards.iter().cycle().skip(1));
    let sum = edges.map(|(a, b)| {
        let across = a.cross(*b);
        across.length().atan2(a.dot(*b)) * across.normalize_or_zero().dot(n)
    });
    -0.5 * sum.sum::<f64>()
}
