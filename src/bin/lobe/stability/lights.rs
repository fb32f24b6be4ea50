//! Irradiance from a rectangular lamp, by samples of it.

use std::f64::consts::PI;

use lobe::glam::{DVec3, Vec2, Vec3};
use lobe::light::{AreaLight, Light};
use lobe::{Spectrum, TriangleMesh};

use super::Sweep;
use super::rng::Rng;
use super::tally::{half_decades, measured, trials, worse};
use super::usual_rectangle::{UsualRectangle, UsualTriangle};

/// Samples of an estimate.
const SAMPLES: u32 = 64;
/// Edges and corner of the lamp: whole numbers at right angles, so that it is exact in f32 at any size. Its outside is along (-2, 2, -1).
const EDGES: [Vec3; 2] = [Vec3::new(1.0, 2.0, 2.0), Vec3::new(2.0, 1.0, -2.0)];
const CORNER: Vec3 = Vec3::new(2.0, -1.0, 3.0);

/// A lamp of radiance 1 and the point that it shines on.
struct Setting {
    edges: [Vec3; 2],
    p: Vec3,
    n: Vec3,
}

/// What ours had, and half as much again.
const BY_DISTANCE: [f64; 15] = [
    1.1e-1, 1.2e-1, 1.1e-1, 1.0e-1, 7.5e-2, 4.1e-2, 1.2e-2, 1.9e-3, 1.6e-4, 2.1e-5, 1.7e-6, 1.8e-7,
    6.5e-8, 1.2e-7, 1.1e-7,
];
/// The same.
const BY_SIZE: [f64; 21] = [
    1.5e-7, 3.1e-7, 6.6e-7, 1.3e-6, 2.4e-6, 4.9e-6, 9.9e-6, 2.2e-5, 4.0e-5, 7.7e-5, 1.8e-4, 8.3e-5,
    1.6e-4, 3.6e-4, 6.1e-4, 1.3e-3, 2.6e-3, 5.0e-3, 1.1e-2, 2.0e-2, 3.8e-2,
];
/// The same.
const BY_HEIGHT: [f64; 13] = [
    5.2e-2, 5.2e-2, 5.2e-2, 5.6e-2, 5.3e-2, 5.4e-2, 5.5e-2, 5.7e-2, 5.7e-2, 7.5e-2, 9.7e-2, 1.1e-1,
    1.2e-1,
];

/// A lamp seen from close by and from far away.
pub fn by_distance(effort: f64) -> Sweep {
    let mut sweep = sweep(half_decades(-3, 4), effort, |distance| {
        let p = CORNER.as_dvec3() + lamp_point(0.4, 0.7, 1.0) + 3.0 * distance * outward();
        Setting { edges: EDGES, p: p.as_vec3(), n: -outward().as_vec3() }
    });
    sweep.name = "lights-distance";
    sweep.bounds = BY_DISTANCE.to_vec();
    sweep.title = "Error of a lamp's light, by its distance";
    sweep.parameter = "distance of the lamp (its size)";
    sweep.about = format!("A point in front of a square lamp that faces it. {}", sweep.about);
    sweep
}

/// Small lamps.
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
    sweep.title = "Error of a lamp's light, by its size";
    sweep.parameter = "size of the lamp (of a lamp 3 units wide, at 2.7 units)";
    sweep.about = format!(
        "A point that sees a square lamp of shrinking size aslant. It is no rectangle by solid angle to ours any more below 1e-6 sr, where points are drawn by area; uniform points over the \
         area do not fail here. {}",
        sweep.about
    );
    sweep
}

/// Lamps seen along their plane.
pub fn by_height(effort: f64) -> Sweep {
    let mut sweep = sweep(half_decades(-6, 0), effort, |height| {
        // Beside the middle of an edge, a hundredth of the lamp's size away, facing the lamp.
        let p = CORNER.as_dvec3() + lamp_point(-0.01, 0.5, 1.0) + 3.0 * height * outward();
        let n = (EDGES[0].as_dvec3() / 3.0).as_vec3();
        Setting { edges: EDGES, p: p.as_vec3(), n }
    });
    sweep.name = "lights-grazing";
    sweep.bounds = BY_HEIGHT.to_vec();
    sweep.title = "Error of a lamp's light, by the height above its plane";
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

/// A point of the lamp's plane, from its corner, for a lamp of this size.
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
            "Irradiance by {SAMPLES} random samples, root mean square error over {runs} runs; a run that ends in NaN counts as infinite. \
             Truth is Lambert's formula for polygons in f64, or a quadrature of 64 points where the lamp is far. Usual: uniform over the \
             area (PBRT, section 14.2.2), uniform over the solid angle as Ureña, Fajardo and King 2013 print it, and over two \
             spherical triangles (Arvo 1995, with the angle excess), in f32."
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

/// The error of each method.
fn errors(setting: &Setting, rng: &mut Rng, runs: u32) -> [f64; 4] {
    let Setting { edges: [ex, ey], p, n } = *setting;
    let mesh = TriangleMesh::parallelogram(CORNER, ex, ey);
    let Some(light) = AreaLight::new(&mesh, Spectrum::WHITE, false) else {
        return [f64::INFINITY; 4];
    };
    let truth = irradiance(setting);
    let rectangle = UsualRectangle::new(p, CORNER, ex, ey);
    let triangles = [0, 1].map(|t| UsualTriangle::new(p, mesh.corners(t)));
    let mut squares = [0.0; 4];
    for _ in 0..runs {
        let mut sums = [0.0; 4];
        for _ in 0..SAMPLES {
            let u =
                Vec2::new((rng.bits() >> 40) as f32, (rng.bits() >> 40) as f32) / (1 << 24) as f32;
            let all = [
                by_area(setting, u),
                n.dot((rectangle.sample(u) - p).normalize()).max(0.0) * rectangle.s,
                by_triangle(&triangles, n, u),
                light.sample_li(p, u).map_or(0.0, |sample| {
                    sample.li.to_array()[0] * n.dot(sample.wi).max(0.0) / sample.pdf
                }),
            ];
            for (sum, one) in sums.iter_mut().zip(all) {
                *sum += f64::from(one);
            }
        }
        for (square, sum) in squares.iter_mut().zip(sums) {
            *square = worse(0.0, *square + (sum / f64::from(SAMPLES) / truth - 1.0).powi(2));
        }
    }
    squares.map(|square| (square / f64::from(runs)).sqrt())
}

/// cos θ over the density, of a point drawn by area.
fn by_area(setting: &Setting, u: Vec2) -> f32 {
    let Setting { edges: [ex, ey], p, n } = *setting;
    let across = ex.cross(ey);
    let area = across.length();
    let to_light = CORNER + u.x * ex + u.y * ey - p;
    let distance2 = to_light.length_squared();
    let wi = to_light / distance2.sqrt();
    let cos_light = (-wi.dot(across / area)).max(0.0);
    n.dot(wi).max(0.0) * cos_light * area / distance2
}

/// The same of a direction towards one of two triangles, which are chosen by their solid angles.
fn by_triangle([first, second]: &[UsualTriangle; 2], n: Vec3, u: Vec2) -> f32 {
    let all = first.area + second.area;
    let split = first.area / all;
    let wi = if u.x < split {
        first.sample(Vec2::new(u.x / split, u.y))
    } else {
        second.sample(Vec2::new((u.x - split) / (1.0 - split), u.y))
    };
    n.dot(wi).max(0.0) * all
}

/// The irradiance at the point.
fn irradiance(setting: &Setting) -> f64 {
    let [ex, ey] = setting.edges.map(Vec3::as_dvec3);
    let from = CORNER.as_dvec3() - setting.p.as_dvec3();
    let n = setting.n.as_dvec3();
    if from.length() > 10.0 * ex.length() {
        quadrature(from, ex, ey, n)
    } else {
        lambert(from, ex, ey, n)
    }
}

/// Lambert 1760: E = ½ Σ γ n · Γ over the edges, where γ is the angle of an edge and Γ the unit normal of its plane through the point
/// (Arvo 1994, "The Irradiance Jacobian for Partially Occluded Polyhedral Sources").
fn lambert(from: DVec3, ex: DVec3, ey: DVec3, n: DVec3) -> f64 {
    let corners = [from, from + ex, from + ex + ey, from + ey];
    let edge = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        let across = a.cross(b);
        let sine = across.length();
        sine.atan2(a.dot(b)) * n.dot(across) / sine
    };
    (0..4).map(edge).sum::<f64>().abs() / 2.0
}

/// ∫ cos θ cos θ' / d² over the lamp, by Gauss and Legendre's rule of 8 × 8 points: for lamps ten sizes away the error is below 1e-15.
fn quadrature(from: DVec3, ex: DVec3, ey: DVec3, n: DVec3) -> f64 {
    let across = ex.cross(ey);
    let rule = gauss_legendre();
    let mut sum = 0.0;
    for (u, wu) in rule {
        for (v, wv) in rule {
            let d = from + u * ex + v * ey;
            sum += wu * wv * n.dot(d) * across.dot(d).abs() / d.length_squared().powi(2);
        }
    }
    sum
}

/// Nodes in [0, 1] and weights of 8 points: the zeros of Legendre's polynomial, by Newton's method.
fn gauss_legendre() -> [(f64, f64); 8] {
    let mut rule = [(0.0, 0.0); 8];
    for (i, node) in rule.iter_mut().enumerate() {
        let mut x = (PI * (i as f64 + 0.75) / 8.5).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut p0, mut p1) = (1.0, x);
            for k in 2..=8 {
                let k = f64::from(k);
                (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
            }
            slope = 8.0 * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        *node = (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope));
    }
    rule
}
