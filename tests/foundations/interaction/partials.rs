//! Derivatives of position and normal by the texture coordinates.

use lobe::geometry::BoundedPoint;
use lobe::glam::{DVec2, DVec3, Vec2, Vec3};
use lobe::interaction::{Partials, SurfaceInteraction};

use super::{random_triangle, textured};
use crate::common::Rng;
use crate::common::meshes::single;

const B: [f32; 3] = [0.2, 0.3, 0.5];

/// The derivatives of a linear function with these values at the corners, by Cramer's rule in f64.
fn solve(values: [Vec3; 3], uvs: [Vec2; 3]) -> [DVec3; 2] {
    let [v0, v1, v2] = values.map(|v| v.as_dvec3());
    let [t0, t1, t2] = uvs.map(|t| t.as_dvec2());
    let (e, f): (DVec2, DVec2) = (t1 - t0, t2 - t0);
    let determinant = e.perp_dot(f);
    [
        ((v1 - v0) * f.y - (v2 - v0) * e.y) / determinant,
        ((v2 - v0) * e.x - (v1 - v0) * f.x) / determinant,
    ]
}

fn assert_close(found: Vec3, truth: DVec3, tolerance: f64, what: &str) {
    let error = (found.as_dvec3() - truth).length();
    assert!(error <= tolerance, "{what}: {found}, expected {truth}, off by {error}");
}

/// ∂p/∂u and ∂p/∂v of triangles of all sizes against f64, and as differences of the points that the
/// interaction itself gives. Caught: u and v swapped; the determinant's sign; lengths whose cross product
/// leaves the range of f32 taken for degenerate.
#[test]
fn position_changes_with_texture_coordinates() {
    for trial in 0..50_000 {
        let mut rng = Rng::new(900, trial);
        let mesh = random_triangle(&mut rng);
        let (corners, uvs) = (mesh.corners(0), mesh.corner_uvs(0));
        let si = SurfaceInteraction::on_triangle(&mesh, 0, rng.barycentric(), Vec3::Z);
        let [dpdu, dpdv] = solve(corners, uvs);
        // Corners up to ten sizes away lose as much when they are subtracted.
        let tolerance = 3e-5 * dpdu.length().max(dpdv.length());
        assert_close(si.dpdu(), dpdu, tolerance, &format!("trial {trial}: dpdu"));
        assert_close(si.dpdv(), dpdv, tolerance, &format!("trial {trial}: dpdv"));
        assert_eq!((si.dndu(), si.dndv()), (Vec3::ZERO, Vec3::ZERO), "trial {trial}");

        let other = SurfaceInteraction::on_triangle(&mesh, 0, rng.barycentric(), Vec3::Z);
        let duv = other.uv().as_dvec2() - si.uv().as_dvec2();
        let moved = dpdu * duv.x + dpdv * duv.y;
        let size = corners.iter().map(|p| p.length()).fold(0.0, f32::max);
        assert_close(
            other.p() - si.p(),
            moved,
            1e-5 * f64::from(size),
            &format!("trial {trial}: p"),
        );
    }
}

/// ∂n/∂u and ∂n/∂v of the shading normal likewise; before it is normalised it is linear. Caught: positions
/// in place of normals.
#[test]
fn normal_changes_with_texture_coordinates() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(901, trial);
        let mut mesh = random_triangle(&mut rng);
        let n = mesh.geometric_normal(0);
        mesh.normals = (0..3).map(|_| (n + 0.5 * rng.direction()).normalize()).collect();
        let shading = SurfaceInteraction::on_triangle(&mesh, 0, B, Vec3::Z).shading();
        let normals = [mesh.normals[0], mesh.normals[1], mesh.normals[2]];
        let [dndu, dndv] = solve(normals, mesh.corner_uvs(0));
        let tolerance = 1e-5 * dndu.length().max(dndv.length());
        assert_close(shading.dndu, dndu, tolerance, &format!("trial {trial}: dndu"));
        assert_close(shading.dndv, dndv, tolerance, &format!("trial {trial}: dndv"));
    }
}

/// Without texture coordinates those of the corners are (0,0), (1,0), (1,1). Caught: (0,1) for the last.
#[test]
fn missing_texture_coordinates() {
    let corners = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(2.0, 2.5, 3.0), Vec3::new(1.0, 4.0, 5.0)];
    let mesh = single(corners);
    let si = SurfaceInteraction::on_triangle(&mesh, 0, B, Vec3::Z);
    assert_eq!(si.uv(), Vec2::new(0.3 + 0.5, 0.5));
    assert!(si.dpdu().distance(corners[1] - corners[0]) < 1e-6);
    assert!(si.dpdv().distance(corners[2] - corners[1]) < 1e-6);
}

/// Texture coordinates that do not span a plane: tangents that do, and no change of the normal.
/// Caught: the checks of the determinant and of the quotients both left out; either is enough here.
#[test]
fn degenerate_texture_coordinates() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(902, trial);
        let mut mesh = random_triangle(&mut rng);
        let (at, along) = (rng.square() * 10.0, rng.square() - Vec2::splat(0.5));
        mesh.uvs = match rng.below(3) {
            0 => vec![at; 3],
            1 => vec![Vec2::ZERO; 3],
            // On a line, to within rounding.
            _ => (0..3).map(|_| at + along * rng.f32()).collect(),
        };
        let on_line = mesh.uvs[0] != mesh.uvs[1];
        mesh.normals = vec![mesh.geometric_normal(0); 3];
        let si = SurfaceInteraction::on_triangle(&mesh, 0, B, Vec3::Z);
        let Partials { dpdu, dpdv, .. } = si.partials();
        assert!(dpdu.is_finite() && dpdv.is_finite(), "trial {trial}");
        for (u, v) in [(dpdu, dpdv), (si.shading().dpdu, si.shading().dpdv)] {
            let n = u.as_dvec3().normalize().cross(v.as_dvec3().normalize());
            assert!(n.length() > 0.0, "trial {trial}: {u} and {v} span no plane");
            // Coordinates on a line to within rounding may be taken at their word.
            assert!(on_line || n.normalize().dot(si.n().as_dvec3()).abs() > 0.999, "trial {trial}");
        }
        let shading = si.shading();
        assert!(shading.dndu.is_finite() && shading.dndv.is_finite(), "trial {trial}");
        assert!(on_line || shading.dndu == Vec3::ZERO, "trial {trial}");
        assert!(lobe::bxdf::Bsdf::along_u(&si).frame().s.is_finite(), "trial {trial}");
    }
}

/// Texture coordinates that are collinear up to rounding, so that the rounding of the determinant decides. If they are not
/// taken for degenerate, the derivative points the right way and has the right length to a factor. Caught: a
/// check for a determinant of exactly 0, and none.
#[test]
fn almost_degenerate_texture_coordinates() {
    let mut solved = 0;
    for trial in 0..100_000 {
        let mut rng = Rng::new(903, trial);
        let t = rng.square();
        let nudge = |x: f32, rng: &mut Rng| (0..rng.below(12)).fold(x, |x, _| x.next_up());
        let other = Vec2::new(nudge(t.x, &mut rng), nudge(t.y, &mut rng));
        let mesh = textured([Vec3::X, Vec3::Y, Vec3::ZERO], [t, other, Vec2::ZERO]);
        let [dpdu, dpdv] = solve(mesh.corners(0), mesh.corner_uvs(0));
        let si = SurfaceInteraction::on_triangle(&mesh, 0, B, Vec3::Z);
        // The tangents of the fallback have unit length, those of such coordinates are very long.
        if si.dpdu().length() < 2.0 || !dpdu.is_finite() {
            continue;
        }
        solved += 1;
        let right = |found: Vec3, truth: DVec3| {
            let along = found.as_dvec3().dot(truth) / truth.length_squared();
            (0.4..2.5).contains(&along)
        };
        let right = right(si.dpdu(), dpdu) && right(si.dpdv(), dpdv);
        assert!(right, "trial {trial}, {other} after {t}: {}, expected {dpdu}", si.dpdu());
    }
    assert!(solved > 10_000, "only {solved} were not degenerate");
}

/// A hit made without a mesh returns what it was given, and its normal is ∂p/∂u × ∂p/∂v at any
/// size. Caught: a cross product whose square leaves the range of f32.
#[test]
fn other_surfaces() {
    for exponent in -25..=25 {
        let scale = 10.0_f32.powi(exponent);
        let partials = Partials {
            dpdu: scale * Vec3::X,
            dpdv: scale * Vec3::new(1.0, 0.0, -2.0),
            dndu: Vec3::Y,
            dndv: Vec3::Z,
        };
        let point = BoundedPoint { p: Vec3::ONE, error: Vec3::splat(1e-3) };
        let si = SurfaceInteraction::new(point, Vec2::new(0.1, 0.2), Vec3::X, partials);
        assert!(si.n().distance(Vec3::Y) < 1e-6, "10^{exponent}: {}", si.n());
        assert_eq!(
            (si.p(), si.p_error(), si.uv(), si.wo()),
            (point.p, point.error, Vec2::new(0.1, 0.2), Vec3::X)
        );
        assert_eq!(si.partials(), partials);
        assert_eq!((si.shading().dndu, si.shading().dndv), (Vec3::Y, Vec3::Z));
        assert!(si.shading().dpdu.distance(partials.dpdu) <= 1e-6 * scale, "10^{exponent}");
    }
    let nothing = SurfaceInteraction::new(
        BoundedPoint { p: Vec3::ONE, error: Vec3::ZERO },
        Vec2::ZERO,
        Vec3::X,
        Partials::default(),
    );
    assert_eq!(nothing.n(), Vec3::X);
    assert!(nothing.shading().dpdu.is_finite());
}

/// The hit reads the right triangle of its mesh. Caught: triangle 0 always.
#[test]
fn the_right_triangle() {
    let mut mesh = textured([Vec3::ZERO, Vec3::X, Vec3::Y], [Vec2::ZERO, Vec2::X, Vec2::Y]);
    mesh.positions.extend([Vec3::Z, 3.0 * Vec3::Z + Vec3::X, Vec3::NEG_Y]);
    mesh.uvs.extend([Vec2::ONE, Vec2::new(3.0, 1.0), Vec2::new(1.0, 2.0)]);
    mesh.indices.push([3, 4, 5]);
    let si = SurfaceInteraction::on_triangle(&mesh, 1, B, Vec3::Z);
    assert!(si.p().distance(0.2 * Vec3::Z + 0.3 * mesh.positions[4] - 0.5 * Vec3::Y) < 1e-6);
    assert!(si.uv().distance(Vec2::new(0.2 + 0.9 + 0.5, 0.5 + 1.0)) < 1e-6);
    assert!(si.dpdu().distance(Vec3::new(0.5, 0.0, 1.0)) < 1e-6);
}
