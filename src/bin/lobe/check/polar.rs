//! A polar plot of a material's lobes in the plane of incidence, as SVG.

use std::f32::consts::TAU;
use std::fmt::Write;

use lobe::Spectrum;
use lobe::bxdf::{Bsdf, BxdfFlags};
use lobe::glam::{Vec2, Vec3};

/// Angles between wo and the normal, in degrees: the last from the inner side.
const VIEWS: [f32; 4] = [0.0, 40.0, 75.0, 140.0];

const WIDTH: f32 = 600.0;
const HEIGHT: f32 = 440.0;
const CENTRE: Vec2 = Vec2::new(390.0, 232.0);
const RADIUS: f32 = 190.0;

/// Values on the rings.
const RINGS: [f32; 4] = [1.0, 0.1, 0.01, 0.001];

/// The unit vector at this angle from the normal towards +x.
fn at(angle: f32) -> Vec3 {
    Vec3::new(angle.sin(), 0.0, angle.cos())
}

/// The point of the plot in a direction, at this share of the largest value.
fn place(w: Vec3, share: f32) -> Vec2 {
    CENTRE + RADIUS * share.clamp(0.0, 1.0).cbrt() * Vec2::new(w.x, -w.z)
}

/// Mean of f |cos θ| over the bands, relative to its maximum, for each of [`VIEWS`]. Specular events are lines, as long as the
/// fraction of light that they carry. Styles are those of the page's charts.
pub fn svg(bsdf: &Bsdf) -> String {
    let mut svg = format!(
        "<svg class=\"lobe\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\">\n<title>Lobes in the plane of incidence</title>\n\
         <rect class=\"page\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>\n\
         <text class=\"strong\" x=\"12\" y=\"20\">Lobes in the plane of incidence</text>\n"
    );
    for ring in RINGS {
        let radius = RADIUS * ring.cbrt();
        let top = CENTRE.y - radius;
        let _ = writeln!(
            svg,
            "<circle class=\"grid\" cx=\"{}\" cy=\"{}\" r=\"{radius:.1}\"/><text class=\"note\" x=\"{}\" y=\"{:.1}\">{ring}</text>",
            CENTRE.x,
            CENTRE.y,
            CENTRE.x + 3.0,
            top - 2.0
        );
    }
    path(&mut svg, "mark", &[place(Vec3::NEG_X, 1.0), place(Vec3::X, 1.0)]);
    for (style, degrees) in VIEWS.into_iter().enumerate() {
        view(&mut svg, bsdf, style, degrees);
    }
    svg.push_str("</svg>\n");
    svg
}

/// The curve of one wo, which is drawn as a short line.
fn view(svg: &mut String, bsdf: &Bsdf, style: usize, degrees: f32) {
    const POINTS: usize = 1440;
    let (wo, all) = (at(-degrees.to_radians()), BxdfFlags::all());
    let world = |w: Vec3| bsdf.frame().to_world(w);
    let directions: Vec<Vec3> = (0..=POINTS).map(|i| at(TAU * i as f32 / POINTS as f32)).collect();
    let value = |&wi: &Vec3| mean(bsdf.f(world(wo), world(wi), all)) * wi.z.abs();
    let values: Vec<f32> = directions.iter().map(value).collect();
    let most = values.iter().copied().fold(0.0, f32::max);
    let mut points: Vec<Vec2> = Vec::new();
    for (&wi, value) in directions.iter().zip(values) {
        let point = place(wi, if most > 0.0 { value / most } else { 0.0 });
        // Steps that nobody sees are left out.
        if points.last().is_none_or(|last| last.distance(point) > 0.4) {
            points.push(point);
        }
    }
    let class = format!("line l{style}");
    path(svg, &class, &points);
    for (wi, share) in specular(bsdf, world(wo)) {
        path(svg, &class, &[CENTRE, place(bsdf.frame().to_local(wi), share)]);
    }
    let outside = |radius: f32| CENTRE + radius * Vec2::new(wo.x, -wo.z);
    path(svg, &class, &[outside(RADIUS + 4.0), outside(RADIUS + 14.0)]);
    let (x, y) = (12.0, 42.0 + 18.0 * style as f32);
    path(svg, &class, &[Vec2::new(x, y), Vec2::new(x + 20.0, y)]);
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\">wo at {degrees}°: up to {most:.3} / sr</text>",
        x + 26.0,
        y + 4.0
    );
}

/// Directions of specular events and the fractions of light in them.
fn specular(bsdf: &Bsdf, wo: Vec3) -> Vec<(Vec3, f32)> {
    const TRIALS: u32 = 64;
    let mut found: Vec<(Vec3, f32)> = Vec::new();
    for i in 0..TRIALS {
        let uc = (i as f32 + 0.5) / TRIALS as f32;
        let sample = bsdf.sample_f(wo, uc, Vec2::splat(0.5), BxdfFlags::all());
        let Some(sample) = sample.filter(|sample| sample.is_specular()) else { continue };
        if found.iter().all(|(wi, _)| wi.distance(sample.wi) > 1e-3) {
            let share = mean(sample.f) * bsdf.abs_cos_theta(sample.wi);
            found.push((sample.wi, share * sample.eta * sample.eta));
        }
    }
    found
}

fn path(svg: &mut String, class: &str, points: &[Vec2]) {
    let points: Vec<_> = points.iter().map(|p| format!("{:.1} {:.1}", p.x, p.y)).collect();
    if points.len() > 1 {
        let _ = writeln!(svg, "<path class=\"{class}\" d=\"M{}\"/>", points.join("L"));
    }
}

fn mean(f: Spectrum) -> f32 {
    let [r, g, b] = f.to_array();
    (r + g + b) / 3.0
}
