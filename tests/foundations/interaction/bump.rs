//! Bump mapping against the normal of the surface that it imitates.

use std::sync::Arc;

use lobe::TriangleMesh;
use lobe::glam::{DVec3, Vec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::material::bump;
use lobe::texture::Texture;

use crate::common::Rng;

/// d(u, v) = height sin(frequency (u - at)) in f64.
#[derive(Clone, Copy)]
struct Waves {
    height: f64,
    frequency: f64,
    at: f64,
}

impl Waves {
    fn slope(&self, u: f64) -> f64 {
        self.height * self.frequency * (self.frequency * (u - self.at)).cos()
    }
}

impl Texture<f32> for Waves {
    fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
        (self.height * (self.frequency * (f64::from(si.uv().x) - self.at)).sin()) as f32
    }
}

/// A square in the plane z = 0, `size` wide, with u along x from `u` by `du` and v along y likewise.
fn plane(size: f32, u: f32, du: f32) -> TriangleMesh {
    let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    TriangleMesh {
        positions: corners.map(|c| (size * c).extend(0.0)).to_vec(),
        uvs: corners.map(|c| Vec2::new(u + du * c.x, c.y)).to_vec(),
        indices: vec![[0, 1, 2], [0, 2, 3]],
        ..TriangleMesh::default()
    }
}

/// A plane with waves has the normal of z = d(x). At any size; with texture coordinates far from 0, as on a
/// floor of many tiles; mirrored. Caught: the displacement's slope not divided by the step; the sign of the
/// normal taken from the cross product, which a mirrored plane turns round; a step in proportion to u,
/// which at u = 100 is a wavelength.
#[test]
fn waves_tilt_a_plane() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(920, trial);
        let size = 10.0_f32.powi(rng.below(13) as i32 - 6);
        let u = [0.0, 0.5, 10.0, 100.0, 500.0, -100.0][rng.below(6)];
        let du = rng.sign();
        let mesh = plane(size, u, du);
        let waves = Waves { height: f64::from(size) * 0.1, frequency: 5.0, at: u.into() };
        let mut si =
            SurfaceInteraction::on_triangle(&mesh, rng.below(2), rng.barycentric(), Vec3::Z);
        bump(&waves, &mut si);
        // u = du x / size.
        let slope = waves.slope(si.uv().x.into()) * f64::from(du) / f64::from(size);
        let truth = DVec3::new(-slope, 0.0, 1.0).normalize();
        let error = (si.shading_n().as_dvec3() - truth).length();
        // The step grows from u = 64 on, and with it the error of a forward difference.
        let tolerance = if u.abs() > 64.0 { 1e-2 } else { 1e-3 };
        assert!(error < tolerance, "trial {trial}, u {u}: {}, expected {truth}", si.shading_n());
        assert_eq!(si.n(), Vec3::Z, "trial {trial}");
        assert!((si.shading_n().length() - 1.0).abs() < 1e-6, "trial {trial}");
        let tilt = si.shading().dpdu.as_dvec3().normalize().dot(si.shading_n().as_dvec3());
        assert!(tilt.abs() < 1e-5, "trial {trial}: ∂p/∂u leaves the surface by {tilt}");
    }
}

/// So far from 0 that a fixed step would be lost to rounding, a slope is still found: a ramp at u = 10⁵.
/// Caught: a step that does not grow with u.
#[test]
fn a_ramp_tilts_a_plane_far_from_zero() {
    for u in [1e5, -1e5] {
        let mesh = plane(1.0, u, 1.0);
        let ramp = |si: &SurfaceInteraction| (0.1 * (f64::from(si.uv().x) - f64::from(u))) as f32;
        let mut si = SurfaceInteraction::on_triangle(&mesh, 0, [0.25, 0.25, 0.5], Vec3::Z);
        bump(&ramp, &mut si);
        let truth = Vec3::new(-0.1, 0.0, 1.0).normalize();
        assert!((si.shading_n() - truth).length() < 1e-3, "u {u}: {}", si.shading_n());
    }
}

/// With vertex normals the displaced surface is p + d n, whose derivatives take in those of n. Caught:
/// d ∂n/∂u left out; the geometric normal displaced along.
#[test]
fn waves_tilt_a_smooth_surface() {
    for trial in 0..20_000 {
        let mut rng = Rng::new(921, trial);
        let mut mesh = plane(1.0, 0.0, rng.sign());
        mesh.normals = (0..4).map(|_| (Vec3::Z + 0.4 * rng.direction()).normalize()).collect();
        let waves = Waves { height: 0.2, frequency: 3.0, at: -0.2 };
        let mut si =
            SurfaceInteraction::on_triangle(&mesh, rng.below(2), rng.barycentric(), Vec3::Z);
        let before = si.shading();
        let [n, dpdu, dpdv, dndu, dndv] =
            [before.n, before.dpdu, before.dpdv, before.dndu, before.dndv].map(|v| v.as_dvec3());
        let d = f64::from(waves.evaluate(&si));
        let u = f64::from(si.uv().x);
        let displaced = (dpdu + waves.slope(u) * n + d * dndu).cross(dpdv + d * dndv).normalize();
        let truth = displaced * displaced.dot(n).signum();
        bump(&waves, &mut si);
        let error = (si.shading_n().as_dvec3() - truth).length();
        assert!(error < 1e-3, "trial {trial}: {}, expected {truth}", si.shading_n());
    }
}

/// A flat mesh that is displaced by a constant stays as it is, whatever the height. Caught: the displacement
/// itself for its slope.
#[test]
fn a_constant_displacement_changes_nothing_on_a_plane() {
    for height in [0.0, 1e-6, 1.0, -1e6] {
        let mesh = plane(2.0, 0.0, 1.0);
        let mut si = SurfaceInteraction::on_triangle(&mesh, 0, [0.2, 0.3, 0.5], Vec3::Z);
        let before = si.shading();
        bump(&height, &mut si);
        assert_eq!(si.shading(), before, "height {height}");
        assert_eq!(si.shading_n(), Vec3::Z, "height {height}");
    }
}

/// The same waves in the world, by u and by -u, give the same normal. Caught: the normal's side taken from
/// the cross product.
#[test]
fn mirrored_texture_coordinates_give_the_same_normal() {
    for trial in 0..5000 {
        let mut rng = Rng::new(922, trial);
        let (triangle, b) = (rng.below(2), rng.barycentric());
        let normal = |du: f32, phase: f64| {
            let mesh = plane(1.0, 0.0, du);
            let waves = Waves { height: 0.1, frequency: 3.0 * f64::from(du), at: phase };
            let mut si = SurfaceInteraction::on_triangle(&mesh, triangle, b, Vec3::Z);
            bump(&waves, &mut si);
            si.shading_n()
        };
        let (there, mirrored) = (normal(1.0, 0.3), normal(-1.0, -0.3));
        assert!(there.distance(mirrored) < 1e-3, "trial {trial}: {there} and {mirrored}");
    }
}

/// A displacement may depend on the normal, which moves along: with d = c n.x, ∂d/∂u is c ∂n.x/∂u. Caught: the
/// normal at the shifted point computed from ∂p/∂u × ∂p/∂v, which on a small mesh is nothing beside ∂n/∂u.
#[test]
fn a_displacement_may_ask_for_the_normal() {
    struct OfNormal(f32);
    impl Texture<f32> for OfNormal {
        fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
            self.0 * si.shading_n().x
        }
    }
    for size in [1e-4, 1.0, 1e4] {
        let mut mesh = plane(size, 0.0, 1.0);
        let tilted = Vec3::new(0.3, 0.0, 1.0).normalize();
        mesh.normals = vec![Vec3::Z, tilted, tilted, Vec3::Z];
        // In the middle, so that n changes across the direction in which it is normalised.
        let mut si = SurfaceInteraction::on_triangle(&mesh, 0, [0.5, 0.0, 0.5], Vec3::Z);
        let before = si.shading();
        let [n, dpdu, dpdv, dndu] =
            [before.n, before.dpdu, before.dpdv, before.dndu].map(|v| v.as_dvec3());
        let c = 0.1 * f64::from(size);
        // n is normalised where it is looked at: only what changes across it counts.
        let slope = c * (dndu - n * n.dot(dndu)).x;
        let displaced = dpdu + slope * n + c * n.x * dndu;
        let truth = displaced.cross(dpdv).normalize();
        bump(&Arc::new(OfNormal(c as f32)), &mut si);
        let error = (si.shading_n().as_dvec3() - truth).length();
        assert!(error < 1e-3, "size {size}: {}, expected {truth}", si.shading_n());
    }
}

/// A displacement that is not finite leaves the frame unchanged. Caught: a normal of NaN set.
#[test]
fn an_invalid_displacement_changes_nothing() {
    let mesh = plane(1.0, 0.0, 1.0);
    for bad in [f32::NAN, f32::INFINITY] {
        let mut si = SurfaceInteraction::on_triangle(&mesh, 0, [0.2, 0.3, 0.5], Vec3::Z);
        let before = si.shading();
        bump(&bad, &mut si);
        assert_eq!(si.shading(), before, "{bad}");
    }
}
