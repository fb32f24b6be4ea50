//! Fresnel's equations: indices near 1, and the critical angle.

use lobe::bxdf::fresnel::dielectric;

use super::rng::Rng;
use super::sweep::Sweep;
use super::tally::{half_decades, measured, relative_error, trials, worse};

/// The reflected fraction where two media hardly differ.
pub fn near_one(effort: f64) -> Sweep {
    let parameters = half_decades(-6, -1);
    let count = trials(20_000, effort, 1000);
    let named = [("PBRT", false), ("fresnel::dielectric (ours)", true)];
    let methods = measured(&parameters, named, |seed, step| {
        let mut rng = Rng::new(seed as u64);
        let mut errors = [0.0; 2];
        for _ in 0..count {
            let eta = (1.0 + if rng.unit() < 0.5 { step } else { -step }) as f32;
            let cos = 10.0_f64.powf(-3.0 * rng.unit()) as f32;
            let truth = truth(cos.into(), eta.into());
            if truth < 1.0 {
                for (error, f) in errors.iter_mut().zip([usual(cos, eta), dielectric(cos, eta)]) {
                    *error = worse(*error, relative_error(f.into(), truth));
                }
            }
        }
        errors
    });
    Sweep {
        name: "fresnel-index",
        title: "Error of the reflected fraction where indices of refraction hardly differ",
        about: format!(
            "{count} boundaries for each parameter, with the index 1 plus or minus it, and angles down to 1e-3 to the surface, where such a \
             boundary reflects most; the largest relative error of the reflected fraction. The common method is that of PBRT 3rd edition, section \
             8.2.1, which subtracts two cosines. Truth is Fresnel's equations in f64 for the same f32 numbers."
        ),
        parameter: "difference of the index from 1",
        log_parameter: true,
        measure: "largest relative error of the reflected fraction",
        methods,
        fails_from: 0.1,
        bounds: vec![2e-5; parameters.len()],
        parameters,
    }
}

/// The transmitted fraction near total internal reflection.
pub fn critical_angle(effort: f64) -> Sweep {
    let parameters = half_decades(-7, -1);
    let count = trials(20_000, effort, 1000);
    let named = [("PBRT", false), ("fresnel::dielectric (ours)", true)];
    let methods = measured(&parameters, named, |seed, above| {
        let mut rng = Rng::new(seed as u64);
        let mut errors = [0.0; 2];
        for _ in 0..count {
            let eta = (1.0 / (1.02 + 1.5 * rng.unit())) as f32;
            let critical = (1.0 - f64::from(eta) * f64::from(eta)).sqrt();
            let cos = (critical * (1.0 + above * (1.0 + rng.unit()))) as f32;
            let truth = 1.0 - truth(cos.into(), eta.into());
            for (error, f) in errors.iter_mut().zip([usual(cos, eta), dielectric(cos, eta)]) {
                *error = worse(*error, (f64::from(1.0 - f) - truth).abs());
            }
        }
        errors
    });
    Sweep {
        name: "fresnel-critical",
        title: "Error of the transmitted fraction near the critical angle",
        about: format!(
            "{count} boundaries seen from within for each parameter, with indices from 1/1.02 to 1/2.52 and cosines that exceed the \
             critical one by a fraction of once or twice the parameter; the largest absolute error of what is transmitted, which grows as the root \
             of that distance. The common method is that of PBRT 3rd edition, section 8.2.1, by the sine of the refracted angle. Truth is Fresnel's \
             equations in f64 for the same f32 numbers."
        ),
        parameter: "distance to the critical cosine, as a fraction of it",
        log_parameter: true,
        measure: "largest error of the transmitted fraction",
        methods,
        fails_from: 5e-4,
        bounds: parameters.iter().map(|&above| 1e-6 / above.sqrt() + 2e-6).collect(),
        parameters,
    }
}

/// PBRT 3rd edition, `FrDielectric`.
fn usual(cos: f32, eta: f32) -> f32 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let sin_t = sin / eta;
    if sin_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin_t * sin_t).max(0.0).sqrt();
    let along = (eta * cos - cos_t) / (eta * cos + cos_t);
    let across = (cos - eta * cos_t) / (cos + eta * cos_t);
    0.5 * (along * along + across * across)
}

fn truth(cos: f64, eta: f64) -> f64 {
    let g2 = (eta - 1.0) * (eta + 1.0) + cos * cos;
    if g2 <= 0.0 {
        return 1.0;
    }
    let cos_t = g2.sqrt() / eta;
    // (η - 1) (η + 1) over a sum, for differences of cosines.
    let across = -(eta - 1.0) * (eta + 1.0) / (cos + eta * cos_t).powi(2);
    let sin2 = (1.0 - cos) * (1.0 + cos);
    // r∥ = r⊥ (cos θ cos θt - sin θ sin θt) / (cos θ cos θt + sin θ sin θt).
    let ratio = (cos * cos_t - sin2 / eta) / (cos * cos_t + sin2 / eta);
    0.5 * across * across * (1.0 + ratio * ratio)
}
