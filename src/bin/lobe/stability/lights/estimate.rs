//! Estimates of the irradiance by each method, and their errors.

use lobe::glam::{Vec2, Vec3};
use lobe::light::{AreaLight, Light};
use lobe::{Spectrum, TriangleMesh};

use super::super::rng::Rng;
use super::super::tally::worse;
use super::super::usual_rectangle::{UsualRectangle, UsualTriangle};
use super::irradiance::irradiance;
use super::setting::{CORNER, Setting};

/// Samples per estimate.
pub const SAMPLES: u32 = 64;

/// Relative root mean square error of each method over `runs` estimates.
pub fn errors(setting: &Setting, rng: &mut Rng, runs: u32) -> [f64; 4] {
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
                cosine(n, (rectangle.sample(u) - p).normalize()) * rectangle.s,
                by_triangle(&triangles, n, u),
                light.sample_li(p, u).map_or(0.0, |sample| {
                    sample.li.to_array()[0] * cosine(n, sample.wi) / sample.pdf
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

/// cos θ, clamped to zero; NaN stays NaN.
fn cosine(n: Vec3, w: Vec3) -> f32 {
    let cosine = n.dot(w);
    if cosine < 0.0 { 0.0 } else { cosine }
}

/// cos θ over the density of a point sampled uniformly over the area.
fn by_area(setting: &Setting, u: Vec2) -> f32 {
    let Setting { edges: [ex, ey], p, n } = *setting;
    let across = ex.cross(ey);
    let area = across.length();
    let to_light = CORNER + u.x * ex + u.y * ey - p;
    let distance2 = to_light.length_squared();
    let wi = to_light / distance2.sqrt();
    let cos_light = cosine(-wi, across / area);
    cosine(n, wi) * cos_light * area / distance2
}

/// cos θ over the density of a direction towards one of two triangles, chosen by their solid angles.
fn by_triangle([first, second]: &[UsualTriangle; 2], n: Vec3, u: Vec2) -> f32 {
    let all = first.area + second.area;
    let split = first.area / all;
    let wi = if u.x < split {
        first.sample(Vec2::new(u.x / split, u.y))
    } else {
        second.sample(Vec2::new((u.x - split) / (1.0 - split), u.y))
    };
    cosine(n, wi) * all
}
