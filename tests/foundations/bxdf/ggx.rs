//! The distribution GGX: its integrals, its triple of sample, density and inverse, and its values in f32 against f64.

use std::f64::consts::PI;

use lobe::bxdf::Ggx;
use lobe::glam::{DVec3, Vec2, Vec3};

use super::{VIEWS, view};
use crate::common::Rng;
use crate::common::sphere::gauss;

const ALPHAS: [[f32; 2]; 5] = [[1e-4, 1e-4], [0.01, 0.01], [0.3, 0.3], [1.0, 1.0], [0.1, 0.6]];

/// Above the surface.
fn views() -> impl Iterator<Item = Vec3> {
    VIEWS.into_iter().filter(|cos| *cos > 0.0).map(view)
}

/// Values on a grid that includes 0 and the largest number below 1.
fn grid() -> impl Iterator<Item = Vec2> {
    let steps = || (0..=16).map(|i| (i as f32 / 16.0).min(1.0 - f32::EPSILON / 2.0));
    steps().flat_map(move |x| steps().map(move |y| Vec2::new(x, y)))
}

/// Along the edges of the square, where normals are along the
/// surface, f32 does not tell sample values apart.
/// Caught: a wrong sine of the cap.
#[test]
fn normals_have_an_inverse() {
    for alpha in ALPHAS {
        let ggx = Ggx::new(alpha);
        for (wo, u) in views().flat_map(|wo| grid().map(move |u| (wo, u))) {
            let m = ggx.sample(wo, u);
            assert!((m.length() - 1.0).abs() < 1e-5 && m.z >= 0.0, "{alpha:?}, {wo}, {u}: {m}");
            if u.y == 0.0 || u.y > 0.99 {
                continue;
            }
            let back = ggx.inverse(wo, m);
            let turn = (back.x - u.x + 0.5).rem_euclid(1.0) - 0.5;
            let error = Vec2::new(turn, back.y - u.y).abs().max_element();
            assert!(error < 1e-3, "{alpha:?}, {wo}, {u}: {back}");
        }
    }
}

/// The formulas of Walter et al. 2007 and Heitz 2014, in f64.
fn truth([ax, ay]: [f32; 2], m: DVec3) -> f64 {
    let (ax, ay) = (f64::from(ax), f64::from(ay));
    let slope = (m.x / (ax * m.z)).powi(2) + (m.y / (ay * m.z)).powi(2);
    1.0 / (PI * ax * ay * m.z.powi(4) * (1.0 + slope).powi(2))
}

fn lambda([ax, ay]: [f32; 2], w: DVec3) -> f64 {
    let across = (f64::from(ax) * w.x).powi(2) + (f64::from(ay) * w.y).powi(2);
    ((1.0 + across / (w.z * w.z)).sqrt() - 1.0) / 2.0
}

/// D, G1 and G near the pole and along the surface, for any roughness.
/// Caught: the cosine of one direction taken for both in G.
#[test]
fn values_are_those_of_f64() {
    for alpha in ALPHAS {
        let ggx = Ggx::new(alpha);
        for trial in 0..20_000 {
            let mut rng = Rng::new(500, trial);
            // Angles to the pole or to the horizon from 1e-6 up.
            let mut any = || {
                let angle = 10.0_f32.powf(-6.0 * rng.f32());
                let (small, large) = (angle.sin(), angle.cos());
                let (sin, cos) = if rng.f32() < 0.5 { (small, large) } else { (large, small) };
                let (y, x) = (rng.f32() * std::f32::consts::TAU).sin_cos();
                Vec3::new(sin * x, sin * y, cos)
            };
            let (m, w) = (any(), any());
            let close = |found: f32, expected: f64, what: &str| {
                let error = (f64::from(found) / expected - 1.0).abs();
                assert!(
                    error < 2e-6,
                    "{what}, {alpha:?}, trial {trial}, m {m}, w {w}: {found}, expected {expected}"
                );
            };
            let [md, wd] = [m, w].map(|v| v.as_dvec3());
            // D is that of the direction, whose length is rounded.
            close(ggx.d(m), truth(alpha, md.normalize()), "D");
            close(ggx.g1(w), 1.0 / (1.0 + lambda(alpha, wd)), "G1");
            close(ggx.g(m, w), 1.0 / (1.0 + lambda(alpha, md) + lambda(alpha, wd)), "G");
        }
    }
}

/// ∫ D(m) cos θm dm = 1: the facets cover the surface; ∫ D_wo(m) dm = 1: those that are seen from wo cover what is seen of it.
/// Caught: z for z² in D; the density of visible normals without cos θo.
#[test]
fn facets_cover_the_surface() {
    for alpha in ALPHAS.into_iter().skip(2) {
        let ggx = Ggx::new(alpha);
        let integral = |f: &dyn Fn(Vec3) -> f64| {
            let mut sum = 0.0;
            let cuts = |range: f64| {
                (0..48).map(move |i| [range * f64::from(i) / 48.0, range * f64::from(i + 1) / 48.0])
            };
            for (theta, theta_weight) in cuts(PI / 2.0).flat_map(gauss) {
                for (phi, phi_weight) in cuts(2.0 * PI).flat_map(gauss) {
                    let m =
                        DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
                    sum += theta_weight * phi_weight * theta.sin() * f(m.as_vec3());
                }
            }
            sum
        };
        let area = integral(&|m| f64::from(ggx.d(m) * m.z));
        assert!((area - 1.0).abs() < 1e-5, "{alpha:?}: {area}");
        for wo in views() {
            let seen = integral(&|m| f64::from(ggx.pdf(wo, m)));
            assert!((seen - 1.0).abs() < 1e-3, "{alpha:?}, {wo}: {seen}");
        }
    }
}
