//! The shading normal and its frame.

use lobe::bxdf::Bsdf;
use lobe::glam::Vec3;
use lobe::interaction::{Shading, SurfaceInteraction};

use super::random_triangle;
use crate::common::Rng;

/// Vertex normals are interpolated; the geometric normal turns to their side, and the tangents lie across
/// the shading normal. Caught: no normalisation; no turning; tangents of the geometric plane.
#[test]
fn vertex_normals_shade() {
    for trial in 0..50_000 {
        let mut rng = Rng::new(910, trial);
        let mut mesh = random_triangle(&mut rng);
        let (side, n) = (rng.sign(), mesh.geometric_normal(0));
        mesh.normals = (0..3).map(|_| side * (n + 0.6 * rng.direction()).normalize()).collect();
        let b = rng.barycentric();
        let si = SurfaceInteraction::on_triangle(&mesh, 0, b, rng.direction());
        let mix: Vec3 = mesh.normals.iter().zip(b).map(|(n, b)| *n * b).sum();
        assert!(si.shading_n().distance(mix.normalize()) < 1e-6, "trial {trial}");
        assert_eq!(si.n(), side * n, "trial {trial}");
        let Shading { n, dpdu, dpdv, .. } = si.shading();
        assert_eq!(n, si.shading_n(), "trial {trial}");
        for (tangent, of_surface) in [(dpdu, si.dpdu()), (dpdv, si.dpdv())] {
            let cos = n.dot(tangent / of_surface.length());
            assert!(cos.abs() < 1e-6, "trial {trial}: {tangent} is off the plane by {cos}");
            let expected =
                of_surface.as_dvec3() - n.as_dvec3() * n.as_dvec3().dot(of_surface.as_dvec3());
            let error = (tangent.as_dvec3() - expected).length();
            assert!(
                error < 1e-6 * f64::from(of_surface.length()),
                "trial {trial}: {tangent}, expected {expected}"
            );
        }
        let frame = *Bsdf::along_u(&si).frame();
        assert_eq!(frame.n, n, "trial {trial}");
        assert!(
            frame.s.distance((dpdu / dpdu.abs().max_element()).normalize()) < 1e-4,
            "trial {trial}"
        );
        assert_eq!(Bsdf::isotropic(&si).frame().n, n, "trial {trial}");
    }
}

/// A hit that is moved for a texture keeps its place and all derivatives, those of the shading normal too.
/// Caught: the place lost; derivatives of the geometric normal, which are 0, in place of the others.
#[test]
fn moved_hits_keep_what_a_texture_may_ask() {
    for trial in 0..1000 {
        let mut rng = Rng::new(911, trial);
        let mut mesh = random_triangle(&mut rng);
        let n = mesh.geometric_normal(0);
        mesh.normals = (0..3).map(|_| (n + 0.6 * rng.direction()).normalize()).collect();
        let si = SurfaceInteraction::on_triangle(&mesh, 0, rng.barycentric(), rng.direction());
        let (p, uv, n) = (rng.direction(), rng.square(), rng.direction());
        let moved = si.moved_to(p, uv, n);
        assert_eq!((moved.p(), moved.uv(), moved.n(), moved.wo()), (p, uv, n, si.wo()));
        assert_eq!((moved.place(), moved.partials()), (si.place(), si.partials()), "trial {trial}");
        assert_eq!(moved.shading(), Shading { n, ..si.shading() }, "trial {trial}");
        assert_ne!(moved.shading().dndu, Vec3::ZERO, "trial {trial}");
    }
}

/// Without normals, with a corner that has none, and where they cancel, the geometric normal shades.
/// Caught: normals of zero interpolated with the others; a sum of zero normalised.
#[test]
fn missing_normals() {
    let mut rng = Rng::new(911, 0);
    for trial in 0..1000 {
        let mut mesh = random_triangle(&mut rng);
        let n = mesh.geometric_normal(0);
        let tilted = (n + 0.5 * rng.direction()).normalize();
        let sets = [
            vec![],
            vec![tilted, tilted, Vec3::ZERO],
            vec![Vec3::ZERO; 3],
            vec![tilted, -tilted, Vec3::ZERO],
        ];
        for normals in sets {
            mesh.normals = normals;
            let si = SurfaceInteraction::on_triangle(&mesh, 0, [0.4, 0.4, 0.2], n);
            assert_eq!((si.n(), si.shading_n(), si.shading().n), (n, n, n), "trial {trial}");
            assert_eq!(si.shading().dndu, Vec3::ZERO, "trial {trial}");
        }
        // Two that cancel exactly at this point.
        mesh.normals = vec![tilted, -tilted, tilted];
        let si = SurfaceInteraction::on_triangle(&mesh, 0, [0.5, 0.5, 0.0], n);
        assert_eq!((si.n(), si.shading_n()), (n, n), "trial {trial}");
    }
}

/// The shading set by bump mapping is what all methods return, with a unit normal on the geometric one's side. Caught: the shading normal
/// left as it was; a normal of NaN set; no normalisation; no turning.
#[test]
fn shading_can_be_replaced() {
    let mut rng = Rng::new(912, 0);
    let mesh = random_triangle(&mut rng);
    let mut si = SurfaceInteraction::on_triangle(&mesh, 0, [0.3, 0.3, 0.4], Vec3::Z);
    let (n, dpdu) = (si.n(), si.dpdu());
    let other =
        Shading { n: Vec3::Y, dpdu: Vec3::X, dpdv: Vec3::Z, dndu: Vec3::X, dndv: Vec3::ZERO };
    si.set_shading(other);
    assert_eq!((si.shading(), si.shading_n()), (other, Vec3::Y));
    assert_eq!((Bsdf::isotropic(&si).frame().n, Bsdf::along_u(&si).frame().s), (Vec3::Y, Vec3::X));
    for same in [2.0 * Vec3::Y, Vec3::NEG_Y, Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        si.set_shading(Shading { n: same, ..other });
        assert_eq!((si.shading(), si.shading_n()), (other, Vec3::Y), "{same}");
    }
    assert_eq!((si.n(), si.dpdu()), (n, dpdu), "the surface itself stays");
    assert_eq!((si.clone().shading(), si.clone().shading_n()), (other, Vec3::Y));
}
