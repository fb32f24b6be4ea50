//! Results are finite or `None` for any input.

use lobe::TriangleMesh;
use lobe::glam::{Vec2, Vec3};
use lobe::light::{AreaLight, Light, LightHit};

use super::{L, rectangle};
use crate::common::meshes::{grid, lumpy, placed, single};

const EDGE: [f32; 4] = [0.0, 1.0 / (1 << 24) as f32, 0.5, 1.0 - 1.0 / (1 << 24) as f32];

fn meshes() -> [TriangleMesh; 4] {
    [
        rectangle(Vec3::ZERO, Vec3::X, Vec3::Y),
        rectangle(Vec3::ZERO, Vec3::new(1.0, 2.0, 2.0), Vec3::new(2.0, 1.0, -2.0)),
        single([Vec3::ZERO, Vec3::X, Vec3::new(0.0, 1.0, 0.5)]),
        lumpy(2, 7),
    ]
}

/// From the light itself, its plane, its corners, behind it, within it, and from far away.
#[test]
fn all_samples_are_finite() {
    for exponent in [-6, -3, 0, 3, 6] {
        let scale = 10.0_f32.powi(exponent);
        for (which, mesh) in meshes().into_iter().enumerate() {
            let mesh = placed(mesh, scale, Vec3::ZERO);
            let corners = mesh.corners(0);
            let [a, b, c] = corners;
            let n = mesh.geometric_normal(0);
            let middle = (a + b + c) / 3.0;
            let around =
                [middle, a, b, (a + b) / 2.0, a + 3.0 * (b - a), -b, Vec3::ZERO, 1e6 * middle];
            let lifts = [0.0, 1e-30, 1e-6, 1.0, -1e-30, -1e-6, -1.0, 1e5].map(|h| h * scale * n);
            for two_sided in [false, true] {
                let light = AreaLight::new(&mesh, L, two_sided).unwrap();
                for p in around.iter().flat_map(|p| lifts.map(|lift| *p + lift)) {
                    for u in EDGE.into_iter().flat_map(|x| EDGE.map(|y| Vec2::new(x, y))) {
                        let what = format!("mesh {which} at scale {scale}, p = {p}, u = {u}");
                        let Some(sample) = light.sample_li(p, u) else { continue };
                        assert!(sample.pdf > 0.0 && sample.pdf.is_finite(), "{what}: {sample:?}");
                        let length = sample.wi.as_dvec3().length();
                        assert!((length - 1.0).abs() < 2e-7, "{what}: {sample:?}");
                        assert!(sample.from.unwrap().is_finite(), "{what}: {sample:?}");
                        for distance in [0.0, scale, 1e12, f32::INFINITY] {
                            for n in [n, -n, Vec3::ZERO, sample.wi.any_orthonormal_vector()] {
                                let hit = LightHit::new(p, sample.wi, distance, n);
                                let pdf = light.pdf_li(&hit);
                                assert!(
                                    pdf >= 0.0 && pdf.is_finite(),
                                    "{what}: {pdf}, {distance}, {n}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
}

/// No light arrives in the light's plane, behind it, or at the point itself; close above it all of it does.
#[test]
fn there_is_no_light_where_none_can_be() {
    let mesh = rectangle(Vec3::ZERO, Vec3::X, Vec3::Y);
    let one = AreaLight::new(&mesh, L, false).unwrap();
    let both = AreaLight::new(&mesh, L, true).unwrap();
    let u = Vec2::splat(0.4);
    for p in [Vec3::ZERO, Vec3::X, Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.5, 0.5, 0.0), Vec3::NEG_X]
    {
        assert_eq!(one.sample_li(p, u), None, "{p}");
        assert_eq!(both.sample_li(p, u), None, "{p}");
    }
    assert_eq!(one.sample_li(Vec3::new(0.5, 0.5, -1.0), u), None);
    let whole = 1.0 / std::f32::consts::TAU;
    for z in [1e-30, -1e-30] {
        assert_eq!(both.sample_li(Vec3::new(0.3, 0.4, z), u).unwrap().pdf, whole);
    }
}

/// A mesh without area makes no light.
#[test]
fn lights_without_area_are_refused() {
    let flat = single([Vec3::ZERO, Vec3::X, 2.0 * Vec3::X]);
    assert!(AreaLight::new(&flat, L, false).is_none());
    assert!(AreaLight::new(&TriangleMesh::default(), L, false).is_none());
}

/// 100,352 triangles.
#[test]
fn large_meshes_are_lights_too() {
    let light = AreaLight::new(&grid(224), L, true).unwrap();
    for x in EDGE {
        let sample = light.sample_li(Vec3::ZERO, Vec2::new(x, 0.5)).unwrap();
        assert!(sample.pdf.is_finite() && sample.wi.y > 0.0, "{sample:?}");
    }
}
