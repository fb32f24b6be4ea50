//! Every warp is a triple: what `sample` draws has the density `pdf`, and `inverse` leads back.

use std::f64::consts::{PI, TAU};

use lobe::glam::{Vec2, Vec3};
use lobe::sampling::{
    concentric_disk, cosine_hemisphere, uniform_cone, uniform_disk, uniform_hemisphere,
    uniform_sphere, uniform_triangle,
};

use super::domains::{cone_cells, disk_cells, sphere_cells, triangle_cells};
use crate::common::Rng;
use crate::common::stats::assert_fits;

/// Half angles from that of a star's disk seen across the galaxy up to the whole sphere.
const CONE_HEIGHTS: [f32; 9] = [1e-12, 1e-8, 1e-5, 1e-3, 0.1, 0.5, 1.0, 1.5, 2.0];

const SAMPLES: u64 = 1_000_000;
/// All chi-square tests in this file together are one family.
const RUNS: usize = 6 + CONE_HEIGHTS.len();

/// A grid of u that includes the smallest and the largest values that samplers give.
fn grid() -> impl Iterator<Item = Vec2> {
    let edge = [0.0, 2.0_f32.powi(-24), 1e-4, 0.25, 0.5, 0.75, 1.0 - 2.0_f32.powi(-24)];
    let values: Vec<f32> = edge.into_iter().chain((1..41).map(|i| i as f32 / 41.0)).collect();
    values
        .clone()
        .into_iter()
        .flat_map(move |x| values.clone().into_iter().map(move |y| Vec2::new(x, y)))
}

/// Fails unless `there` leads to where `back` leads from. Where `collapses`, the warp takes a whole
/// edge of the square to one point, whose second coordinate is lost.
fn assert_inverse(name: &str, u: Vec2, back: Vec2, collapses: bool) {
    let difference = (back - u).abs();
    assert!(difference.x <= 1e-3, "{name}: u = {u}, inverse {back}");
    assert!(collapses || difference.y <= 1e-3, "{name}: u = {u}, inverse {back}");
    assert!(back.min_element() >= -1e-6 && back.max_element() <= 1.0 + 1e-6, "{name}: {back}");
}

/// Caught: an inverse of the cone by 1 - z alone, which is 0 for small cones; an angle in (-1/2, 1/2]
/// instead of [0, 1).
///
/// No warp here needs a comparison modulo a full turn: the largest u below 1 comes back as itself.
#[test]
fn inverse_leads_back() {
    for u in grid() {
        assert_inverse(
            "cosine hemisphere",
            u,
            cosine_hemisphere::inverse(cosine_hemisphere::sample(u)),
            false,
        );
        assert_inverse(
            "uniform hemisphere",
            u,
            uniform_hemisphere::inverse(uniform_hemisphere::sample(u)),
            false,
        );
        // u.x = 0 is the pole, where there is no angle.
        let pole = u.x == 0.0;
        assert_inverse(
            "uniform sphere",
            u,
            uniform_sphere::inverse(uniform_sphere::sample(u)),
            pole,
        );
        assert_inverse("uniform disk", u, uniform_disk::inverse(uniform_disk::sample(u)), pole);
        assert_inverse(
            "concentric disk",
            u,
            concentric_disk::inverse(concentric_disk::sample(u)),
            false,
        );
        assert_inverse(
            "triangle",
            u,
            uniform_triangle::inverse(uniform_triangle::sample(u)),
            false,
        );
        for h in CONE_HEIGHTS {
            let back = uniform_cone::inverse(uniform_cone::sample(u, h), h);
            assert_inverse(&format!("cone of height {h}"), u, back, pole);
        }
    }
}

/// Caught: √(1 - z²) replaced by √(1 - z), and the cone's 2 - h u by 2.
#[test]
fn points_lie_in_the_domain() {
    let random = (0..100_000).map(|trial| Rng::new(10, trial).square());
    for u in grid().chain(random) {
        let unit = |name: &str, w: Vec3| {
            let length = w.as_dvec3().length();
            assert!((length - 1.0).abs() < 4e-7, "{name}: u = {u}, {w} has length {length}");
        };
        let hemisphere = uniform_hemisphere::sample(u);
        unit("uniform hemisphere", hemisphere);
        assert!(hemisphere.z >= 0.0, "u = {u}");
        let cosine = cosine_hemisphere::sample(u);
        unit("cosine hemisphere", cosine);
        // Only the border of the square may give a direction along the surface: its pdf is 0.
        assert!(cosine.z > 0.0 || u.min_element() == 0.0, "u = {u}: {cosine}");
        unit("uniform sphere", uniform_sphere::sample(u));
        for h in CONE_HEIGHTS {
            let w = uniform_cone::sample(u, h);
            unit("cone", w);
            let sin2 = w.truncate().as_dvec2().length_squared();
            let below_top =
                if w.z > 0.0 { sin2 / (1.0 + f64::from(w.z)) } else { 1.0 - f64::from(w.z) };
            assert!(below_top <= f64::from(h) * (1.0 + 1e-6), "cone {h}: u = {u}, {w}");
        }
        for p in [uniform_disk::sample(u), concentric_disk::sample(u)] {
            assert!(p.as_dvec2().length() <= 1.0 + 2e-7, "u = {u}: {p}");
        }
        let b = uniform_triangle::sample(u);
        assert!(b.min_element() >= 0.0 && b.x + b.y <= 1.0, "u = {u}: {b}");
    }
}

/// Counts samples by cell and compares with the density.
fn assert_density(
    name: &str,
    test: u64,
    cells: usize,
    expected: impl Fn(usize) -> f64,
    cell: impl Fn(Vec2) -> usize,
) {
    let mut observed = vec![0; cells];
    let mut rng = Rng::new(test, 0);
    for _ in 0..SAMPLES {
        observed[cell(rng.square())] += 1;
    }
    let expected: Vec<f64> = (0..cells).map(|c| expected(c) * SAMPLES as f64).collect();
    let total: f64 = expected.iter().sum();
    assert!(
        (total / SAMPLES as f64 - 1.0).abs() < 1e-5,
        "{name}: the pdf integrates to {}",
        total / SAMPLES as f64
    );
    assert_fits(&observed, &expected, RUNS, name);
}

/// Caught: the concentric disk's angle without the quarter turn; the uniform disk with u₀ for √u₀.
#[test]
fn disks_have_their_density() {
    let cells = disk_cells();
    let area = PI / cells.count() as f64;
    let expected = |pdf: f32| move |_| f64::from(pdf) * area;
    assert_density("uniform disk", 11, cells.count(), expected(uniform_disk::pdf()), |u| {
        cells.of(uniform_disk::sample(u))
    });
    assert_density("concentric disk", 12, cells.count(), expected(concentric_disk::pdf()), |u| {
        cells.of(concentric_disk::sample(u))
    });
}

/// Caught: the cosine hemisphere's pdf without 1/π (integral), and with the uniform disk's radius
/// squared (density).
#[test]
fn spheres_have_their_density() {
    let cells = sphere_cells();
    assert_density(
        "uniform sphere",
        13,
        cells.count(),
        |c| cells.integrate(c, |_| f64::from(uniform_sphere::pdf())),
        |u| cells.of(uniform_sphere::sample(u)),
    );
    let above = |w: Vec3| if w.z > 0.0 { f64::from(uniform_hemisphere::pdf()) } else { 0.0 };
    assert_density(
        "uniform hemisphere",
        14,
        cells.count(),
        |c| cells.integrate(c, above),
        |u| cells.of(uniform_hemisphere::sample(u)),
    );
    let cosine = |w: Vec3| f64::from(cosine_hemisphere::pdf(w.z));
    assert_density(
        "cosine hemisphere",
        15,
        cells.count(),
        |c| cells.integrate(c, cosine),
        |u| cells.of(cosine_hemisphere::sample(u)),
    );
}

/// Caught: 1 - cos θmax for the height, which gives a pdf of infinity for the smallest cones.
#[test]
fn cones_have_their_density() {
    for (run, h) in CONE_HEIGHTS.into_iter().enumerate() {
        let cells = cone_cells(h);
        let solid_angle = TAU * f64::from(h) / cells.count() as f64;
        let expected = |_| f64::from(uniform_cone::pdf(h)) * solid_angle;
        assert_density(
            &format!("cone of height {h}"),
            20 + run as u64,
            cells.count(),
            expected,
            |u| cells.of(uniform_cone::sample(u, h)),
        );
    }
}

/// Grazing directions keep their digits: cos θ against f64. The larger of |2u - 1| is the radius on the
/// disk. Caught: √(1 - x² - y²), with which cosines below 1e-3 are noise.
#[test]
fn cosine_hemisphere_keeps_its_digits() {
    for trial in 0..100_000 {
        let mut rng = Rng::new(17, trial);
        let border = 2.0_f32.powi(-24) * (1.0 + rng.f32() * (1 << 10) as f32).floor();
        let u = Vec2::new(border, rng.f32());
        let square = 2.0 * u.as_dvec2() - 1.0;
        let r = square.abs().max_element();
        let truth = ((1.0 - r) * (1.0 + r)).sqrt();
        let z = f64::from(cosine_hemisphere::sample(u).z);
        assert!((z - truth).abs() <= 1e-6 * truth, "trial {trial}, u = {u}: {z}, expected {truth}");
    }
}

/// `height` against f64, for angles whose cosine is 1 in f32. Caught: 1 - √(1 - sin²).
#[test]
fn cone_height_keeps_its_digits() {
    for exponent in -60..=0 {
        let sin2 = 2.0_f32.powi(exponent);
        let truth = f64::from(sin2) / (1.0 + (1.0 - f64::from(sin2)).sqrt());
        let h = f64::from(uniform_cone::height(sin2));
        assert!((h / truth - 1.0).abs() < 3e-7, "sin² = {sin2}: {h}, expected {truth}");
    }
    assert_eq!(uniform_cone::height(0.0), 0.0);
    assert_eq!(uniform_cone::height(1.0), 1.0);
}

/// Caught: the shear of one half of the square left out.
#[test]
fn triangle_has_its_density() {
    let cells = triangle_cells();
    // Density over the triangle of the weights themselves, whose area is 1/2.
    let expected = |_| f64::from(uniform_triangle::pdf(0.5)) * 0.5 / cells.count() as f64;
    assert_density("triangle", 16, cells.count(), expected, |u| {
        cells.of(uniform_triangle::sample(u))
    });
}
