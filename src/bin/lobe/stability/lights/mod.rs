//! Irradiance from a rectangular light, estimated by sampling it.

mod estimate;
mod irradiance;
mod setting;

use lobe::glam::DVec3;

use super::rng::Rng;
use super::sweep::Sweep;
use super::tally::{half_decades, measured, trials};
use estimate::{SAMPLES, errors};
use setting::{CORNER, EDGES, Setting};

/// Stored bounds: 1.5 times the errors measured for ours.
const BY_DISTANCE: [f64; 15] = [
    1.1e-1, 1.2e-1, 1.1e-1, 1.0e-1, 7.5e-2, 4.1e-2, 1.2e-2, 1.9e-3, 1.6e-4, 2.1e-5, 1.7e-6, 1.8e-7,
    6.5e-8, 1.2e-7, 1.1e-7,
];
/// Stored bounds, as above.
const BY_SIZE: [f64; 21] = [
    1.5e-7, 3.1e-7, 6.6e-7, 1.3e-6, 2.4e-6, 4.9e-6, 9.9e-6, 2.2e-5, 4.0e-5, 7.7e-5, 1.8e-4, 8.3e-5,
    1.6e-4, 3.6e-4, 6.1e-4, 1.3e-3, 2.6e-3, 5.0e-3, 1.1e-2, 2.0e-2, 3.8e-2,
];
/// Stored bounds, as above.
const BY_HEIGHT: [f64; 13] = [
    5.2e-2, 5.2e-2, 5.2e-2, 5.6e-2, 5.3e-2, 5.4e-2, 5.5e-2, 5.7e-2, 5.7e-2, 7.5e-2, 9.7e-2, 1.1e-1,
    1.2e-1,
];

/// A light seen from near and far.
pub fn by_distance(effort: f64) -> Sweep {
    let mut sweep = sweep(half_decades(-3, 4), effort, |distance| {
        let p = CORNER.as_dvec3() + lamp_point(0.4, 0.7, 1.0) + 3.0 * distance * outward();
        Setting { edges: EDGES, p: p.as_vec3(), n: -outward().as_vec3() }
    });
    sweep.name = "lights-distance";
    sweep.bounds = BY_DISTANCE.to_vec();
    sweep.title = "Error of a lamp's irradiance, by its distance";
    sweep.parameter = "distance of the lamp (its size)";
    sweep.about = format!("A point in front of a square lamp that faces it. {}", sweep.about);
    sweep
}

/// Small lights.
pub fn by_size(effort: f64) -> Sweep {
    let parameters: Vec<f64> = (-20..=0).map(|k| 2.0_f64.powi(k)).collect();
    let mut sweep = sweep(parameters, effort, |size| {
        let aside = lamp_point(0.7, -0.5, 1.0);
        let p = CORNER.as_dvec3() + lamp_point(0.5, 0.5, size) + 2.0 * outward() + aside;
        Setting {
            edges: EDGES.map(|edge| edge * size as f32),
            p: p.as_vec3(),
            n: -outward().as_vec3(),
        }
    });
    sweep.name = "lights-size";
    sweep.bounds = BY_SIZE.to_vec();
    sweep.title = "Error of a lamp's irradiance, by its size";
    sweep.parameter = "width of the lamp (3 units, at a distance of 3.3 units)";
    sweep.about = format!(
        "A point that sees a square lamp of shrinking size at an angle. Below 1e-6 sr ours samples points by area, which \
         does not fail here. {}",
        sweep.about
    );
    sweep
}

/// Lights seen at grazing angles.
pub fn by_height(effort: f64) -> Sweep {
    let mut sweep = sweep(half_decades(-6, 0), effort, |height| {
        // Beside the middle of an edge, a hundredth of the lamp's size away, facing the lamp.
        let p = CORNER.as_dvec3() + lamp_point(-0.01, 0.5, 1.0) + 3.0 * height * outward();
        let n = (EDGES[0].as_dvec3() / 3.0).as_vec3();
        Setting { edges: EDGES, p: p.as_vec3(), n }
    });
    sweep.name = "lights-grazing";
    sweep.bounds = BY_HEIGHT.to_vec();
    sweep.title = "Error of a lamp's irradiance, by the height above its plane";
    sweep.parameter = "height above the lamp's plane (its size)";
    sweep.about = format!(
        "A point beside a square lamp, a hundredth of its size from the middle of an edge, that faces it. {}",
        sweep.about
    );
    sweep
}

/// The unit outward normal.
fn outward() -> DVec3 {
    DVec3::new(-2.0, 2.0, -1.0) / 3.0
}

/// A point in the light's plane, relative to its corner, for a light of this size.
fn lamp_point(u: f64, v: f64, size: f64) -> DVec3 {
    size * (u * EDGES[0].as_dvec3() + v * EDGES[1].as_dvec3())
}

fn sweep(parameters: Vec<f64>, effort: f64, setting: impl Fn(f64) -> Setting + Sync) -> Sweep {
    let runs = trials(2000, effort, 100);
    let named = [
        ("uniform over the area", false),
        ("Ureña et al., f32", false),
        ("triangles after Arvo, f32", false),
        ("AreaLight (ours)", true),
    ];
    let methods = measured(&parameters, named, |seed, parameter| {
        errors(&setting(parameter), &mut Rng::new(seed as u64), runs)
    });
    Sweep {
        name: "",
        title: "",
        about: format!(
            "Irradiance by {SAMPLES} random samples, root mean square error over {runs} runs; a run that ends in \
             NaN counts as infinite. Truth is Lambert's formula for polygons in f64, or a quadrature of 64 points \
             where the lamp is far. Usual: uniform over the area (PBRT, section 14.2.2), uniform over the solid \
             angle as Ureña, Fajardo and King 2013 print it, and over two spherical triangles (Arvo 1995, with the \
             angle excess), in f32."
        ),
        parameter: "",
        log_parameter: true,
        measure: "relative root mean square error of the irradiance",
        methods,
        fails_from: 0.2,
        bounds: Vec::new(),
        parameters,
    }
}
