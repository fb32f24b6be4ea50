//! Fresnel's equations against their textbook form in f64.

use lobe::Spectrum;
use lobe::bxdf::fresnel::{Fresnel, conductor, dielectric};

use crate::common::Rng;

/// Relative indices, with and without total reflection.
pub const ETAS: [f32; 11] = [
    1.0,
    1.0 + f32::EPSILON,
    1.0 - 1e-6,
    1.0 + 1e-6,
    1.5,
    1.0 / 1.5,
    1.33,
    1.0 / 1.33,
    2.4,
    1.0 / 2.4,
    10.0,
];

/// (|r_s|² + |r_p|²) / 2 for η + ik, from complex arithmetic: r_s = (c - t) / (c + t), r_p = (n² c - t) / (n² c + t) with
/// t = √(n² - sin²).
fn textbook(cos: f64, eta: f64, k: f64) -> f64 {
    let n2 = [eta * eta - k * k, 2.0 * eta * k];
    // sin² is 1 - cos², of which nothing is left near the surface.
    let [x, y] = [(eta - 1.0) * (eta + 1.0) - k * k + cos * cos, n2[1]];
    let modulus = x.hypot(y);
    // The principal root.
    let t = match x >= 0.0 {
        true => {
            let a = ((modulus + x) / 2.0).sqrt();
            [a, if a > 0.0 { y / (2.0 * a) } else { 0.0 }]
        }
        false => {
            let b = ((modulus - x) / 2.0).sqrt();
            [y / (2.0 * b), b]
        }
    };
    let square = |z: [f64; 2]| z[0] * z[0] + z[1] * z[1];
    let ratio =
        |p: [f64; 2]| square([p[0] - t[0], p[1] - t[1]]) / square([p[0] + t[0], p[1] + t[1]]);
    (ratio([cos, 0.0]) + ratio([n2[0] * cos, n2[1] * cos])) / 2.0
}

/// A cosine: any, close to grazing, close to the normal, or close to the critical angle if there is one.
fn cosine(rng: &mut Rng, eta: f32) -> f32 {
    let critical = (1.0 - f64::from(eta).powi(2)).max(0.0).sqrt() as f32;
    match rng.below(4) {
        0 => rng.f32().max(1e-7),
        1 => rng.f32().max(1e-3) * 1e-4,
        2 => 1.0 - rng.f32() * 1e-4,
        _ => (critical * (1.0 + rng.within(-1e-6, 1e-6))).clamp(1e-7, 1.0),
    }
}

/// The value in f32 is that of an angle at most four units in the last place away, to 1e-5 of itself: at the critical angle the
/// reflectance falls as a root. Seen to fail with `1 - η²` for `(η - 1)(η + 1)`, with `g - c` subtracted, with the ratio of the amplitudes
/// inverted, and with total reflection at `η = 1`.
#[test]
fn dielectrics_are_the_textbook_s() {
    for trial in 0..400_000 {
        let mut rng = Rng::new(520, trial);
        let eta = ETAS[rng.below(ETAS.len())];
        let cos = cosine(&mut rng, eta);
        let found = f64::from(dielectric(cos, eta));
        let near = |ulps: i32| {
            let cos = f32::from_bits((cos.to_bits() as i32 + ulps) as u32).min(1.0);
            textbook(cos.into(), eta.into(), 0.0)
        };
        let all = (-4..=4).map(near);
        let (low, high) = (all.clone().fold(1.0, f64::min), all.fold(0.0, f64::max));
        let what =
            format!("trial {trial}, cos {cos:e}, eta {eta}: {found:e}, not {low:e} to {high:e}");
        assert!(found >= low * (1.0 - 1e-5) && found <= high * (1.0 + 1e-5), "{what}");
        assert_eq!(dielectric(-cos, eta).to_bits(), dielectric(cos, eta).to_bits(), "{what}");
    }
}

/// Seen to fail with the squares of a and b taken from the difference of modulus and real part, and with `sin²` for `cos²`.
#[test]
fn metals_are_the_textbook_s() {
    // Silver, gold, iron, lithium-like, a dielectric and almost nothing.
    const INDICES: [[f32; 2]; 6] =
        [[0.05, 4.0], [0.2, 3.0], [2.9, 3.1], [0.2, 2.8], [1.5, 0.0], [1.0, 1e-3]];
    for trial in 0..200_000 {
        let mut rng = Rng::new(521, trial);
        let [eta, k] = INDICES[rng.below(INDICES.len())];
        let cos = cosine(&mut rng, 1.0);
        let band = |x: f32| Spectrum::new(x, 0.0, 1.0);
        let [found, ..] = conductor(cos, band(eta), band(k)).to_array();
        let expected = textbook(cos.into(), eta.into(), k.into());
        let error = (f64::from(found) - expected).abs() / (expected + 1e-9);
        assert!(error < 1e-5, "trial {trial}, cos {cos:e}, {eta} + {k}i: {found:e}, {expected:e}");
    }
}

/// At Brewster's angle only the part across the plane of incidence is left; beyond the critical angle all is reflected, to the last
/// float below it; along the surface too, but for equal indices.
#[test]
fn special_angles() {
    for eta in [1.5_f32, 1.0 / 1.5, 2.4] {
        let tan = f64::from(eta);
        let brewster = (1.0 / (1.0 + tan * tan)).sqrt();
        let across = ((1.0 - tan * tan) / (1.0 + tan * tan)).powi(2);
        let found = f64::from(dielectric(brewster as f32, eta));
        assert!((found - across / 2.0).abs() < 1e-6, "{eta}: {found}, {across}");
    }
    let eta = 1.0 / 1.5_f32;
    let critical = (1.0 - f64::from(eta).powi(2)).sqrt();
    let mut cos = critical as f32 - 1e-5;
    while f64::from(cos) < critical + 1e-5 {
        let reflected = dielectric(cos, eta);
        let is_total = f64::from(cos) < critical * (1.0 - 1e-7);
        assert!(if is_total { reflected == 1.0 } else { reflected <= 1.0 }, "{cos}: {reflected}");
        cos = cos.next_up();
    }
    assert!(dielectric(critical as f32 + 1e-6, eta) < 1.0);
    for eta in ETAS {
        let expected = if eta == 1.0 { 0.0 } else { 1.0 };
        assert_eq!(dielectric(0.0, eta), expected, "{eta}");
    }
}

/// From below, a boundary has the inverse index, and both sides reflect the same at angles that refraction joins.
#[test]
fn both_sides_reflect_alike() {
    for trial in 0..100_000 {
        let mut rng = Rng::new(522, trial);
        let eta = [1.5, 1.33, 2.4, 1.0 + 1e-6][rng.below(4)];
        let cos = rng.f32().max(1e-3);
        let cos_t = (1.0 - (1.0 - f64::from(cos).powi(2)) / f64::from(eta).powi(2)).sqrt() as f32;
        let fresnel = Fresnel::Dielectric { eta };
        let [above, below] =
            [cos, -cos_t].map(|cos| f64::from(fresnel.evaluate(cos).to_array()[0]));
        // Near the critical angle the cosine below is rounded.
        let bound = 1e-5 + 4e-7 / f64::from(cos * cos);
        assert!(
            (above / below - 1.0).abs() < bound,
            "trial {trial}, {cos}, {eta}: {above}, {below}"
        );
    }
}
