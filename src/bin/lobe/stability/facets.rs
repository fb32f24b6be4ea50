//! Facets of rough surfaces: roughness down to smooth, angles down to the horizon, and sampling.

use std::f32::consts::{FRAC_1_PI, PI, TAU};

use lobe::bxdf::fresnel::{Fresnel, dielectric};
use lobe::bxdf::{BxDF, Ggx, MicrofacetReflection};
use lobe::glam::{DVec3, Vec2, Vec3};

use super::rng::Rng;
use super::sweep::Sweep;
use super::tally::{half_decades, measured, relative_error, trials, worse};

const ETA: f32 = 1.5;

/// What a rough boundary reflects, as its roughness goes to 0.
pub fn toward_smooth(effort: f64) -> Sweep {
    let parameters: Vec<f64> = (0..=12).map(|k| 10.0_f64.powf(-9.0 + 0.5 * f64::from(k))).collect();
    let count = trials(2000, effort, 200);
    let named = [("GGX by its cosine", false), ("MicrofacetReflection (ours)", true)];
    let methods = measured(&parameters, named, |seed, alpha| {
        let mut rng = Rng::new(seed as u64);
        let lobe = MicrofacetReflection::new([alpha as f32; 2], Fresnel::Dielectric { eta: ETA });
        let mut means = [0.0; 2];
        for _ in 0..count {
            let wo = direction(&mut rng, 0.05);
            let u = Vec2::new(rng.unit() as f32, rng.unit() as f32).min(Vec2::splat(0.999_999_9));
            let truth = f64::from(dielectric(wo.z, ETA));
            let ours =
                lobe.sample_f(wo, 0.5, u).map_or(0.0, |s| s.f.to_array()[0] * s.wi.z / s.pdf);
            let usual = usual_weight(wo, alpha as f32, u);
            for (mean, weight) in means.iter_mut().zip([usual, ours]) {
                *mean += f64::from(weight) / truth / f64::from(count);
            }
        }
        means.map(|mean| relative_error(mean, 1.0))
    });
    Sweep {
        name: "facets-smooth",
        title: "Error of what a boundary reflects, as its roughness goes to 0",
        about: format!(
            "{count} directions for each roughness, with cosines from 0.05 up, and a sample of each; the relative error of the mean weight \
             against Fresnel's equations for a smooth boundary of index {ETA}, which it has to approach. The common method is GGX by the cosine of \
             the half vector, α² / (π (cos² (α² - 1) + 1)²), with visible normals (Heitz 2018); its 0/0 counts as infinite. Ours is specular below \
             a roughness of 1e-4, without a step."
        ),
        parameter: "roughness alpha",
        log_parameter: true,
        measure: "relative error of the mean weight of samples",
        methods,
        fails_from: 0.5,
        // From 1e-4 on, samples differ.
        bounds: parameters.iter().map(|&alpha| if alpha < 1e-4 { 1e-6 } else { 0.01 }).collect(),
        parameters,
    }
}

/// D near the pole.
pub fn pole(effort: f64) -> Sweep {
    let parameters = half_decades(-4, 0);
    let count = trials(20_000, effort, 1000);
    let named = [("GGX by its cosine", false), ("Ggx::d (ours)", true)];
    let methods = measured(&parameters, named, |seed, alpha| {
        let mut rng = Rng::new(seed as u64);
        let ggx = Ggx::new([alpha as f32; 2]);
        let mut errors = [0.0; 2];
        for _ in 0..count {
            // Slopes from nothing to ten times the roughness.
            let slope = 10.0 * alpha * rng.unit() * rng.unit();
            let phi = f64::from(TAU) * rng.unit();
            let m = DVec3::new(slope * phi.cos(), slope * phi.sin(), 1.0).normalize().as_vec3();
            let truth = d(f64::from(alpha as f32), m);
            for (error, found) in errors.iter_mut().zip([usual_d(m.z, alpha as f32), ggx.d(m)]) {
                *error = worse(*error, relative_error(found.into(), truth));
            }
        }
        errors
    });
    Sweep {
        name: "facets-pole",
        title: "Error of the distribution GGX near its peak, by roughness",
        about: format!(
            "{count} normals for each roughness, with slopes up to ten times it; the largest relative error of D. The common form is \
             α² / (π (cos² (α² - 1) + 1)²), in which the cosine of the normal has no digits left for its angle. Truth is D of the same f32 normal \
             in f64."
        ),
        parameter: "roughness alpha",
        log_parameter: true,
        measure: "largest relative error of D",
        methods,
        fails_from: 0.1,
        bounds: vec![2e-6; parameters.len()],
        parameters,
    }
}

/// G over both cosines, as a reflection needs it, near the horizon.
pub fn horizon(effort: f64) -> Sweep {
    let parameters: Vec<f64> = (0..=15).map(|k| 10.0_f64.powi(-2 * k)).rev().collect();
    let count = trials(10_000, effort, 1000);
    let named = [("Smith's G by the tangent", false), ("Ggx::g (ours)", true)];
    let methods = measured(&parameters, named, |seed, cos| {
        let mut rng = Rng::new(seed as u64);
        let mut errors = [0.0; 2];
        for _ in 0..count {
            let alpha = 10.0_f64.powf(-3.0 * rng.unit()) as f32;
            let grazing = |cos: f64, rng: &mut Rng| {
                let (phi, cos) =
                    (f64::from(TAU) * rng.unit(), (cos * (0.5 + 0.5 * rng.unit())) as f32);
                let sin = (1.0 - f64::from(cos).powi(2)).sqrt();
                Vec3::new((sin * phi.cos()) as f32, (sin * phi.sin()) as f32, cos)
            };
            let [wo, wi] = [grazing(cos, &mut rng), direction(&mut rng, 0.1)];
            let truth =
                1.0 / (1.0 + lambda(alpha.into(), wo) + lambda(alpha.into(), wi)) / f64::from(wo.z);
            let usual_lambda = |w: Vec3| {
                let tan2 = (1.0 - w.z * w.z) / (w.z * w.z);
                0.5 * ((1.0 + alpha * alpha * tan2).sqrt() - 1.0)
            };
            let usual = 1.0 / (1.0 + usual_lambda(wo) + usual_lambda(wi)) / wo.z;
            let ours = Ggx::new([alpha; 2]).g(wo, wi) / wo.z;
            for (error, found) in errors.iter_mut().zip([usual, ours]) {
                *error = worse(*error, relative_error(found.into(), truth));
            }
        }
        errors
    });
    Sweep {
        name: "facets-horizon",
        title: "Error of masking and shadowing near the horizon",
        about: format!(
            "{count} pairs of directions for each parameter, one of them with a cosine of half to once the parameter, for roughness from \
             1e-3 to 1; the largest relative error of G / cos θ, which stays finite. The common method computes Smith's Λ by tan² θ. \
             Truth is G of the same f32 directions in f64."
        ),
        parameter: "cosine to the normal",
        log_parameter: true,
        measure: "largest relative error of G / cos θ",
        methods,
        fails_from: 0.1,
        bounds: vec![2e-6; parameters.len()],
        parameters,
    }
}

/// Samples that leave below the surface.
pub fn visible_normals(effort: f64) -> Sweep {
    let parameters = half_decades(-4, 0);
    let count = trials(40_000, effort, 4000);
    let named = [("visible normals", false), ("MicrofacetReflection (ours)", true)];
    let methods = measured(&parameters, named, |seed, cos| {
        let mut rng = Rng::new(seed as u64);
        let (ggx, lobe) = (Ggx::new([1.0; 2]), MicrofacetReflection::new([1.0; 2], Fresnel::NoOp));
        let mut wasted = [0_u32; 2];
        let wo = Vec3::new((1.0 - cos * cos).sqrt() as f32, 0.0, cos as f32);
        for _ in 0..count {
            let u = Vec2::new(rng.unit() as f32, rng.unit() as f32).min(Vec2::splat(0.999_999_9));
            let m = ggx.sample(wo, u);
            wasted[0] += u32::from(2.0 * wo.dot(m) * m.z - wo.z <= 0.0);
            wasted[1] += u32::from(lobe.sample_f(wo, 0.5, u).is_none());
        }
        wasted.map(|wasted| f64::from(wasted) / f64::from(count))
    });
    Sweep {
        name: "facets-samples",
        title: "Samples of a rough surface that leave below it, by the angle of view",
        about: format!(
            "{count} samples of reflection for each angle, at roughness 1; the share that goes below the surface and is lost. The common method \
             draws all visible normals (Heitz 2018; Dupuy and Benyoub 2023); ours bounds the spherical cap of directions (Tokuyoshi and Eto 2024)."
        ),
        parameter: "cosine of the angle of view",
        log_parameter: true,
        measure: "share of samples that are lost",
        methods,
        fails_from: 0.05,
        bounds: vec![0.02; parameters.len()],
        parameters,
    }
}

/// A direction above the surface with at least this cosine.
fn direction(rng: &mut Rng, least: f64) -> Vec3 {
    loop {
        let w = rng.direction();
        if w.z.abs() >= least {
            return DVec3::new(w.x, w.y, w.z.abs()).as_vec3();
        }
    }
}

fn usual_d(cos: f32, alpha: f32) -> f32 {
    let alpha2 = alpha * alpha;
    let below = cos * cos * (alpha2 - 1.0) + 1.0;
    alpha2 * FRAC_1_PI / (below * below)
}

/// F D G cos θi / (4 cos θo cos θi) over the density of visible normals, D and all, with normals by Heitz 2018.
fn usual_weight(wo: Vec3, alpha: f32, u: Vec2) -> f32 {
    let vh = Vec3::new(alpha * wo.x, alpha * wo.y, wo.z).normalize();
    let length2 = vh.x * vh.x + vh.y * vh.y;
    let t1 = if length2 > 0.0 { Vec3::new(-vh.y, vh.x, 0.0) / length2.sqrt() } else { Vec3::X };
    let t2 = vh.cross(t1);
    let (r, phi) = (u.x.sqrt(), 2.0 * PI * u.y);
    let (a, b) = (r * phi.cos(), r * phi.sin());
    let s = 0.5 * (1.0 + vh.z);
    let b = (1.0 - s) * (1.0 - a * a).sqrt() + s * b;
    let nh = a * t1 + b * t2 + (1.0 - a * a - b * b).max(0.0).sqrt() * vh;
    let m = Vec3::new(alpha * nh.x, alpha * nh.y, nh.z.max(0.0)).normalize();
    let wi = 2.0 * wo.dot(m) * m - wo;
    if wi.z <= 0.0 {
        return 0.0;
    }
    let h = (wo + wi).normalize();
    let lambda =
        |w: Vec3| 0.5 * ((1.0 + alpha * alpha * (1.0 - w.z * w.z) / (w.z * w.z)).sqrt() - 1.0);
    let (g1, g) = (1.0 / (1.0 + lambda(wo)), 1.0 / (1.0 + lambda(wo) + lambda(wi)));
    let d = usual_d(h.z, alpha);
    let f = dielectric(wo.dot(h), ETA) * d * g / (4.0 * wo.z * wi.z);
    let pdf = g1 * d * wo.dot(h) / wo.z / (4.0 * wo.dot(h));
    f * wi.z / pdf
}

fn d(alpha: f64, m: Vec3) -> f64 {
    let m = m.as_dvec3().normalize();
    let (x, y) = (m.x / alpha, m.y / alpha);
    1.0 / (std::f64::consts::PI * alpha * alpha * (x * x + y * y + m.z * m.z).powi(2))
}

fn lambda(alpha: f64, w: Vec3) -> f64 {
    let w = w.as_dvec3();
    0.5 * ((1.0 + alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z)).sqrt() - 1.0)
}
