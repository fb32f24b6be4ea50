//! Rays of every kind, aimed at the triangles of a scene.

use lobe::TriangleMesh;
use lobe::geometry::Ray;
use lobe::glam::Vec3;
use lobe::interaction::SurfaceInteraction;

use crate::common::Rng;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// From a random point to one inside of a triangle, to a corner, or to the middle of an edge.
    Camera,
    /// From a random point to another.
    Random,
    /// From the surface to a point, with the origin offset beyond the error bounds, as for shadow rays.
    ToPoint,
    /// From the surface to a direction, likewise.
    Leaving,
    /// From the surface, or a corner, without an offset.
    OnSurface,
    /// Along an axis, with zeros of both signs.
    Axis,
    /// Across an axis.
    AcrossAxis,
    /// Within the plane of a face of the triangle's box.
    BoxFace,
    /// Within the triangle's plane, up to rounding.
    TrianglePlane,
    /// Along an edge, through both of its corners.
    AlongEdge,
    /// From 1e3 to 1e7 sizes away.
    Far,
}

impl Kind {
    pub const ALL: [Self; 11] = [
        Self::Camera,
        Self::Random,
        Self::ToPoint,
        Self::Leaving,
        Self::OnSurface,
        Self::Axis,
        Self::AcrossAxis,
        Self::BoxFace,
        Self::TrianglePlane,
        Self::AlongEdge,
        Self::Far,
    ];
}

/// `count` rays of this kind; the number of each is its trial. The range of t varies, one end in three, and so
/// does the length of the direction.
pub fn many(kind: Kind, meshes: &[TriangleMesh], test: u64, count: usize) -> Vec<Ray> {
    let lengths = [1.0, 1.0, 1e18, 1e-18];
    let aimed = |trial: u64| {
        let mut rng = Rng::new(32 * test + kind as u64, trial);
        let (ray, target) = plain(kind, meshes, &mut rng);
        varied(ray, target, lengths[rng.below(4)], &mut rng)
    };
    (0..count as u64).map(aimed).collect()
}

/// Some triangle with an area.
fn pick<'a>(meshes: &'a [TriangleMesh], rng: &mut Rng) -> (&'a TriangleMesh, usize) {
    loop {
        let mesh = &meshes[rng.below(meshes.len())];
        if !mesh.indices.is_empty() {
            let triangle = rng.below(mesh.indices.len());
            if mesh.geometric_normal(triangle) != Vec3::ZERO {
                return (mesh, triangle);
            }
        }
    }
}

/// A ray of infinite length (except for [`Kind::ToPoint`]), and the point that it was aimed at.
fn plain(kind: Kind, meshes: &[TriangleMesh], rng: &mut Rng) -> (Ray, Vec3) {
    let (mesh, triangle) = pick(meshes, rng);
    let corners = mesh.corners(triangle);
    let first = rng.below(3);
    let [p, q, r] = [0, 1, 2].map(|corner| corners[(first + corner) % 3]);
    let b = rng.barycentric();
    let inside = b[0] * corners[0] + b[1] * corners[1] + b[2] * corners[2];
    let target = [inside, p, 0.5 * (p + q)][rng.below(3)];
    // Lengths of the triangle, and of the scene around it.
    let own = (q - p).length().max((r - p).length());
    let size = if rng.below(2) == 0 { own } else { own.max(target.length()) };
    let away = size * rng.coordinate(1.0).abs() * rng.direction();
    let axis = rng.below(3);
    let zero = 0.0 * rng.sign();
    let si = || SurfaceInteraction::on_triangle(mesh, triangle, b, Vec3::Z);
    let ray = match kind {
        Kind::Camera => Ray::new(target + away, -away),
        Kind::Random => Ray::new(target + away, rng.direction()),
        Kind::ToPoint => si().spawn_ray_to(inside + away),
        Kind::Leaving => si().spawn_ray(rng.direction()),
        Kind::OnSurface => Ray::new(target, rng.direction()),
        Kind::Axis => {
            let mut d = Vec3::new(zero, 0.0 * rng.sign(), 0.0 * rng.sign());
            d[axis] = rng.sign();
            Ray::new(target - d * away.length(), d)
        }
        Kind::AcrossAxis => {
            let mut d = -away;
            d[axis] = zero;
            Ray::new(target - d, d)
        }
        Kind::BoxFace => {
            let face = if rng.below(2) == 0 { p.min(q).min(r) } else { p.max(q).max(r) };
            let mut o = target + away;
            o[axis] = face[axis];
            let mut d = target - o;
            d[axis] = zero;
            Ray::new(o, d)
        }
        Kind::TrianglePlane => {
            let along =
                |rng: &mut Rng| rng.coordinate(1.0) * (q - p) + rng.coordinate(1.0) * (r - p);
            let d = along(rng);
            Ray::new(target - d * rng.f32() * 2.0, d)
        }
        Kind::AlongEdge => Ray::new(p - (q - p) * (rng.f32() * 2.0), q - p),
        Kind::Far => {
            let far = own.max(size * rng.f32()) * 10.0_f32.powf(rng.within(3.0, 7.0));
            let o = target + far * rng.direction();
            Ray::new(o, target - o)
        }
    };
    (ray, target)
}

/// The same ray with its direction scaled to this length, unless that is 1, and with another range. The ends of the
/// range are equally likely before and beyond the target, and the range may be empty.
fn varied(mut ray: Ray, target: Vec3, new_length: f32, rng: &mut Rng) -> Ray {
    let length = ray.d.length();
    if new_length != 1.0 && length > 0.0 {
        ray.d = ray.d / length * new_length;
        ray.t_max *= length / new_length;
    }
    let distance = (target - ray.o).length() / ray.d.length();
    if rng.below(3) == 0 {
        ray.t_min = rng.f32() * 2.0 * distance;
    }
    if rng.below(3) == 0 {
        ray.t_max = rng.f32() * 2.0 * distance;
    }
    ray
}

/// Invalid rays: zeros of both signs, infinities and NaN in all components, some next to a 1.
pub fn none() -> Vec<Ray> {
    let bad = [0.0, -0.0, 1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let mut rays = Vec::new();
    for x in bad {
        for y in bad {
            for z in bad {
                let v = Vec3::new(x, y, z);
                rays.extend([Ray::new(v, Vec3::Z), Ray::new(Vec3::ZERO, v), Ray::new(v, v)]);
                // The same in a single component of a ray that hits something.
                rays.push(Ray {
                    t_min: x,
                    t_max: y,
                    ..Ray::new(Vec3::ZERO, Vec3::new(0.1, 0.2, z))
                });
                rays.push(Ray { t_min: x, ..Ray::new(Vec3::new(2.0, y, 0.0), Vec3::NEG_X) });
            }
        }
    }
    rays
}
