//! The common warps and the crate's, and checks of their results.

use std::f32::consts::PI;
use std::f64::consts::TAU;

use lobe::film::{Filter, GaussianFilter};
use lobe::glam::{DVec2, Vec2, Vec3};
use lobe::sampling::{
    Discrete, SphericalRectangle, concentric_disk, cosine_hemisphere, uniform_cone,
    uniform_triangle,
};

use super::super::usual_rectangle::UsualRectangle;

/// Whether the result of a warp is valid for u.
pub type Sound<'a> = &'a dyn Fn(Vec2) -> bool;

/// Share of failures among eight warps at an extreme value.
pub type Share<'a> = &'a dyn Fn([Sound; 8], f32) -> f64;

/// The share of common warps that fail.
pub fn usual_share(share: Share, extreme: f32) -> f64 {
    let sums: Vec<f32> = weights()
        .scan(0.0, |sum, weight| {
            *sum += (weight / weights().sum::<f64>()) as f32;
            Some(*sum)
        })
        .collect();
    let [corner, ex, ey] = RECTANGLE;
    let rectangle = UsualRectangle::new(Vec3::ZERO, corner, ex, ey);
    share(
        [
            &|u| are_weights(Vec2::new(1.0 - u.x.sqrt(), u.y * u.x.sqrt())),
            &|u| {
                let Vec2 { x, y } = u.x.sqrt() * Vec2::from_angle(2.0 * PI * u.y);
                has_density(Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()))
            },
            &|u| {
                let cos_max = (f64::from(SUN)).cos() as f32;
                let cos = 1.0 - u.x * (1.0 - cos_max);
                is_in_cone((1.0 - cos * cos).max(0.0).sqrt() * Vec2::from_angle(2.0 * PI * u.y), u)
            },
            &|u| {
                let Vec2 { x: a, y: b } = 2.0 * u - 1.0;
                let (r, share) = if a.abs() > b.abs() { (a, b / a) } else { (b, 2.0 - a / b) };
                (r * Vec2::from_angle(0.25 * PI * share)).is_finite()
            },
            &|u| has_weight(sums.iter().take_while(|&&sum| sum < u.x).count()),
            &|u| ((u.x * CELLS as f32) as usize) < CELLS,
            &|u| is_inside(rectangle.sample(u)),
            &|u| {
                let radius = 0.5 * (-2.0 * u.x.ln()).sqrt();
                (radius * Vec2::from_angle(2.0 * PI * u.y)).is_finite()
            },
        ],
        extreme,
    )
}

/// The share of the crate's warps that fail.
pub fn our_share(share: Share, extreme: f32) -> f64 {
    let [corner, ex, ey] = RECTANGLE;
    let rectangle = SphericalRectangle::new(Vec3::ZERO, corner, ex, ey);
    let by_weight = Discrete::new(weights());
    let cells = Discrete::new([1.0; CELLS]);
    let filter = GaussianFilter::default().prepare();
    share(
        [
            &|u| are_weights(uniform_triangle::sample(u)),
            &|u| has_density(cosine_hemisphere::sample(u)),
            &|u| {
                let height = uniform_cone::height((f64::from(SUN).sin().powi(2)) as f32);
                is_in_cone(uniform_cone::sample(u, height).truncate(), u)
            },
            &|u| concentric_disk::sample(u).is_finite(),
            &|u| by_weight.as_ref().is_some_and(|choice| has_weight(choice.sample(u.x).0)),
            &|u| cells.as_ref().is_some_and(|choice| choice.sample(u.x).0 < CELLS),
            &|u| rectangle.as_ref().is_some_and(|rectangle| is_inside(rectangle.sample(u))),
            &|u| filter.as_ref().is_ok_and(|filter| filter.sample(u).is_finite()),
        ],
        extreme,
    )
}

/// The sun's angular radius.
const SUN: f32 = 0.004_65;
/// Cells of a table.
const CELLS: usize = 16;
/// Number of weights; the first and the last are zero.
const WEIGHTS: usize = 5002;
/// Corner and edges, seen from the origin.
const RECTANGLE: [Vec3; 3] = [Vec3::new(-0.5, -0.25, 1.0), Vec3::X, Vec3::Y];

fn weights() -> impl Iterator<Item = f64> {
    (0..WEIGHTS).map(|i| if has_weight(i) { 1.0 } else { 0.0 })
}

fn has_weight(index: usize) -> bool {
    (1..WEIGHTS - 1).contains(&index)
}

fn are_weights(b: Vec2) -> bool {
    b.x >= 0.0 && b.y >= 0.0 && 1.0 - b.x - b.y >= 0.0
}

fn has_density(w: Vec3) -> bool {
    (w.length() - 1.0).abs() < 1e-4 && w.z / PI > 0.0
}

/// Whether the direction with these x and y is the one for u within the sun's disk: 1 - cos θ grows with u.x.
fn is_in_cone(across: Vec2, u: Vec2) -> bool {
    let height = 2.0 * (0.5 * f64::from(SUN)).sin().powi(2);
    let below = f64::from(u.x) * height;
    let (sin, cos) = (TAU * f64::from(u.y)).sin_cos();
    let truth = DVec2::new(cos, sin) * (below * (2.0 - below)).sqrt();
    (across.as_dvec2() - truth).length() < 0.01 * f64::from(SUN)
}

fn is_inside(point: Vec3) -> bool {
    let [corner, ..] = RECTANGLE;
    let moved = point - corner;
    let edges = -1e-5..=1.0 + 1e-5;
    edges.contains(&moved.x) && edges.contains(&moved.y) && moved.z.abs() < 1e-5
}
