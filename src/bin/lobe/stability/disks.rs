//! Maps from the unit square to the unit disk: polar and concentric.

use std::f32::consts::TAU;

use lobe::glam::{DVec2, Vec2};
use lobe::sampling::concentric_disk;

use super::rng::Rng;
use super::sweep::Sweep;
use super::tally::{measured, relative_error, trials, worse};

/// Distortion of the maps: the stretch of small cells, by radius.
pub fn stretch(effort: f64) -> Sweep {
    let mut parameters: Vec<f64> =
        (0..=20).map(|k| 10.0_f64.powf(-3.0 + 0.15 * f64::from(k))).collect();
    parameters[20] = 0.995;
    let around = trials(4000, effort, 400);
    let named = [("polar", false), ("concentric_disk (ours)", true)];
    let methods = measured(&parameters, named, |seed, radius| {
        let mut rng = Rng::new(seed as u64);
        let mut worst = [1.0; 2];
        for _ in 0..around {
            // Points that each map takes to this radius.
            let ring = DVec2::new(radius * radius, rng.unit());
            // Not on the square's diagonals, where the derivative is discontinuous.
            let along = 0.98 * radius * (2.0 * rng.unit() - 1.0);
            let sign = if rng.bits() >> 63 == 0 { radius } else { -radius };
            let square = if rng.bits() >> 63 == 0 {
                DVec2::new(sign, along)
            } else {
                DVec2::new(along, sign)
            };
            let square = 0.5 * square + 0.5;
            let all = [cell_stretch(ring, polar), cell_stretch(square, concentric_disk::sample)];
            for (worst, stretch) in worst.iter_mut().zip(all) {
                *worst = worse(*worst, stretch);
            }
        }
        worst
    });
    Sweep {
        name: "disks-stretch",
        title: "How long and thin cells of the square become on the disk, by radius",
        about: format!(
            "A cell's stretch is its longest over its shortest extent, by the singular values of the map's \
             derivative, from differences of f32 results over cells of 2^-8 of the radius; the largest of {around} \
             cells at each radius. Thin cells undo stratification. The square's diagonals, where the \
             derivative jumps, are left out. The common map is polar, r = √u, φ = 2πv; ours is that of Shirley and Chiu 1997."
        ),
        parameter: "radius",
        log_parameter: true,
        measure: "longest over shortest extent of a cell",
        methods,
        fails_from: 10.0,
        bounds: vec![2.5; parameters.len()],
        parameters,
    }
}

/// Probability of a small disk around the centre.
pub fn centre(_effort: f64) -> Sweep {
    let parameters: Vec<f64> =
        (0..=16).map(|k| 10.0_f64.powf(-6.0 + 0.375 * f64::from(k))).collect();
    let named = [("polar", false), ("concentric_disk (ours)", true)];
    let methods = measured(&parameters, named, |_, radius| {
        // r grows with u.x in the polar map, and with the larger coordinate's distance from the centre in the concentric one.
        let rings = first_beyond(1 << 24, radius, |k| polar(Vec2::new(k, 0.0)));
        let squares =
            first_beyond(1 << 23, radius, |k| concentric_disk::sample(Vec2::new(0.5 + k, 0.5)));
        let side = 2.0 * f64::from(squares) - 1.0;
        let chances = [f64::from(rings) / 2.0_f64.powi(24), (side / 2.0_f64.powi(24)).powi(2)];
        chances.map(|chance| relative_error(chance, radius * radius))
    });
    Sweep {
        name: "disks-centre",
        title: "Error of the probability of a small disk around the centre, by its radius",
        about: "Random numbers of 24 bits, all of them counted. The probability of points within a radius ρ should be \
                ρ². The polar map r = √u, φ = 2πv has no points between 0 and a radius of 2^-12, and maps all that fall \
                into this hole to one point. Truth is ρ² in f64."
            .to_owned(),
        parameter: "radius of the small disk",
        log_parameter: true,
        measure: "relative error of its probability",
        methods,
        fails_from: 0.5,
        // Half of the float spacing 2⁻²³ at its border.
        bounds: parameters.iter().map(|&radius| 1.5e-7 / radius + 3e-7).collect(),
        parameters,
    }
}

/// Area of the disk on one side of a line, estimated with stratified samples.
pub fn half_planes(effort: f64) -> Sweep {
    let parameters: Vec<f64> = (1..=8).map(|k| 4.0_f64.powi(k)).collect();
    let runs = trials(1500, effort, 150);
    let named = [
        ("random", false),
        ("polar, stratified", false),
        ("concentric_disk, stratified (ours)", true),
    ];
    let methods = measured(&parameters, named, |seed, n| {
        let mut rng = Rng::new(seed as u64);
        let side = n.sqrt().round() as u32;
        let runs = runs.min((30_000_000.0 / n) as u32);
        let mut squares = [0.0; 3];
        for _ in 0..runs {
            let normal = rng.direction().truncate().normalize_or(DVec2::X);
            // Up to 0.95, close to the border, where little is cut off.
            let at = 1.9 * rng.unit() - 0.95;
            let is_in = |p: Vec2| u32::from(p.as_dvec2().dot(normal) < at);
            let mut counts = [0; 3];
            for cell in 0..side * side {
                let jitter = DVec2::new(rng.unit(), rng.unit());
                let corner = DVec2::new(f64::from(cell % side), f64::from(cell / side));
                let u =
                    ((corner + jitter) / f64::from(side)).as_vec2().min(Vec2::splat(0.999_999_9));
                let [random, concentric] = [jitter.as_vec2(), u].map(concentric_disk::sample);
                for (count, p) in counts.iter_mut().zip([random, polar(u), concentric]) {
                    *count += is_in(p);
                }
            }
            let share = 0.5 + (at.asin() + at * (1.0 - at * at).sqrt()) / std::f64::consts::PI;
            for (square, count) in squares.iter_mut().zip(counts) {
                *square += (f64::from(count) / n - share).powi(2);
            }
        }
        squares.map(|square| (square / f64::from(runs)).sqrt())
    });
    Sweep {
        name: "disks-edge",
        title: "Error of a lens cut by an edge, by the number of samples",
        about: format!(
            "The share of the disk on one side of a random line, by jittered samples on a square grid; root mean \
             square error over up to {runs} lines, truth in closed form. At no parameter does only the common map \
             fail: the errors of both fall as n^(-3/4), and ours is smaller by a sixth to a quarter."
        ),
        parameter: "samples",
        log_parameter: true,
        measure: "root mean square error of the share",
        methods,
        fails_from: 0.1,
        // 9/8 of the errors measured for ours; the polar map exceeds most of them.
        bounds: vec![1.64e-1, 5.7e-2, 1.97e-2, 7.1e-3, 2.47e-3, 8.8e-4, 3.09e-4, 1.08e-4],
        parameters,
    }
}

/// The common map in polar coordinates (PBRT 3rd edition, section 13.6.2).
fn polar(u: Vec2) -> Vec2 {
    let (sin, cos) = (TAU * u.y).sin_cos();
    u.x.sqrt() * Vec2::new(cos, sin)
}

/// The ratio of the singular values of a map's derivative, over a cell of 2⁻⁸ of the radius.
fn cell_stretch(u: DVec2, map: impl Fn(Vec2) -> Vec2) -> f64 {
    // Representable in f32, and on one side of the square's diagonals.
    let grid = |x: f64| (x * 2.0_f64.powi(24)).round() / 2.0_f64.powi(24);
    let from_middle = (u - 0.5).abs().max_element().min(u.x).max(1e-6);
    let step = grid(from_middle / 256.0).max(2.0_f64.powi(-22));
    let u = DVec2::new(grid(u.x), grid(u.y)).clamp(DVec2::ZERO, DVec2::splat(1.0 - 2.0 * step));
    let p = |x: f64, y: f64| map(DVec2::new(x, y).as_vec2()).as_dvec2();
    let at = p(u.x, u.y);
    let (du, dv) = ((p(u.x + step, u.y) - at) / step, (p(u.x, u.y + step) - at) / step);
    // Of a 2 × 2 matrix: s₁² + s₂² is the sum of all squares, s₁ s₂ the determinant.
    let (squares, area) = (du.length_squared() + dv.length_squared(), du.perp_dot(dv).abs());
    let (sum, difference) = ((squares + 2.0 * area).sqrt(), (squares - 2.0 * area).max(0.0).sqrt());
    (sum + difference) / (sum - difference)
}

/// Index of the first multiple of 2⁻²⁴, up to `count`, that a map takes to at least this radius. Binary search.
fn first_beyond(count: u32, radius: f64, map: impl Fn(f32) -> Vec2) -> u32 {
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = (low + high) / 2;
        let p = map(middle as f32 / (1 << 24) as f32);
        if p.as_dvec2().length() < radius {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}
