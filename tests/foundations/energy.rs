//! Energy: reflectances against closed forms, quadrature and Monte Carlo, and the white furnace.

use std::f64::consts::{FRAC_PI_2, PI};

use lobe::Spectrum;
use lobe::bxdf::fresnel::Fresnel;
use lobe::bxdf::{
    BoundaryLosses, Bsdf, BxDF, BxdfFlags, CoatedDiffuse, EnergyPreservingOrenNayar,
    FresnelMicrofacet, LambertianReflection, Lobe, Losses, MicrofacetReflection, OrenNayar,
    Roughnesses, ScaledBxDF,
};
use lobe::geometry::Frame;
use lobe::glam::{Vec2, Vec3};

use crate::common::lobes::{Plain, Stretched};
use crate::common::sphere::gauss;
use crate::common::stats::{assert_mean, mean};
use crate::common::{Rng, parallel};

const COSINES: [f32; 7] = [1.0, 0.9, 0.7, 0.3, 0.05, 1e-4, -0.6];
const ROUGHNESSES: [f32; 5] = [0.0, 1e-6, 0.1, 0.5, 1.0];
const SIGMAS: [f32; 6] = [0.01, 5.0, 11.0, 20.0, 45.0, 90.0];

fn view(cos: f32) -> Vec3 {
    Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
}

fn first(spectrum: Spectrum) -> f64 {
    spectrum.to_array()[0].into()
}

/// ∫ f |cos θi| over the hemisphere of `wo`, which lies above y = 0 and for which f is even in φ. The
/// range of θ is cut at that of `wo` and φ at a right angle, where Oren-Nayar's model has its edges.
fn reflectance(lobe: &dyn BxDF, wo: Vec3) -> f64 {
    const PIECES: usize = 12;
    let side = f64::from(wo.z.signum());
    let theta_o = f64::from(wo.x).atan2(f64::from(wo.z.abs()));
    let mut sum = 0.0;
    for [low, high] in [[0.0, theta_o], [theta_o, FRAC_PI_2]] {
        for [from, to] in [[0.0, FRAC_PI_2], [FRAC_PI_2, PI]] {
            for (i, j) in (0..PIECES).flat_map(|i| (0..PIECES).map(move |j| (i, j))) {
                let cut = |a: f64, b: f64, i: usize| a + (b - a) * i as f64 / PIECES as f64;
                for (theta, theta_weight) in gauss([cut(low, high, i), cut(low, high, i + 1)]) {
                    for (phi, phi_weight) in gauss([cut(from, to, j), cut(from, to, j + 1)]) {
                        let (sin, cos) = theta.sin_cos();
                        let wi = Vec3::new(
                            (sin * phi.cos()) as f32,
                            (sin * phi.sin()) as f32,
                            (side * cos) as f32,
                        );
                        sum += 2.0 * theta_weight * phi_weight * first(lobe.f(wo, wi)) * sin * cos;
                    }
                }
            }
        }
    }
    sum
}

/// The crate's lobes in one band, at an albedo that tells R from R².
fn lobes() -> Vec<(String, Box<dyn BxDF>)> {
    let r = Spectrum::splat(0.8);
    let mut lobes: Vec<(String, Box<dyn BxDF>)> = vec![
        ("Lambertian".into(), Box::new(LambertianReflection::new(r))),
        ("scaled".into(), Box::new(ScaledBxDF::new(OrenNayar::new(r, 20.0), Spectrum::splat(0.5)))),
    ];
    lobes.extend(SIGMAS.map(|sigma| -> (String, Box<dyn BxDF>) {
        (format!("Oren-Nayar {sigma}"), Box::new(OrenNayar::new(r, sigma)))
    }));
    lobes.extend(ROUGHNESSES.map(|roughness| -> (String, Box<dyn BxDF>) {
        (format!("EON {roughness}"), Box::new(EnergyPreservingOrenNayar::new(r, roughness)))
    }));
    lobes
}

/// Caught: half of `within`, and `beyond` over 2, in Oren-Nayar's closed form; the scale left out of
/// `ScaledBxDF::rho_hd`.
#[test]
fn directional_reflectance_is_the_integral_of_f() {
    for (name, lobe) in lobes() {
        for cos in COSINES {
            let (closed, integral) =
                (first(lobe.rho_hd(view(cos), &[], &[])), reflectance(&*lobe, view(cos)));
            assert!(
                (closed - integral).abs() < 2e-6,
                "{name}, cos {cos}: {closed}, integral {integral}"
            );
        }
    }
}

/// ρ_hh = 2 ∫ ρ_hd cos θ sin θ dθ. Caught: 64/45 taken for 32/45.
#[test]
fn hemispherical_reflectance_is_the_mean_of_the_directional() {
    for (name, lobe) in lobes() {
        let mut integral = 0.0;
        for piece in 0..24 {
            let at = |i: usize| FRAC_PI_2 * i as f64 / 24.0;
            for (theta, weight) in gauss([at(piece), at(piece + 1)]) {
                let wo = Vec3::new(theta.sin() as f32, 0.0, theta.cos() as f32);
                integral +=
                    2.0 * weight * theta.sin() * theta.cos() * first(lobe.rho_hd(wo, &[], &[]));
            }
        }
        let closed = first(lobe.rho_hh(&[], &[], &[]));
        assert!((closed - integral).abs() < 2e-6, "{name}: {closed}, integral {integral}");
    }
}

/// Points for one batch of a Monte Carlo estimate.
fn points(test: u64, batch: u64) -> Vec<Vec2> {
    let mut rng = Rng::new(test, batch);
    (0..4096).map(|_| rng.square()).collect()
}

/// Sample values for as many events.
fn choices(test: u64, batch: u64) -> Vec<f32> {
    let mut rng = Rng::new(1000 + test, batch);
    (0..4096).map(|_| rng.f32()).collect()
}

/// The trait's Monte Carlo estimates have the closed forms for their mean: 64 batches of 4096 points. Caught:
/// the cosine left out of the throughput; the weight of wo without its cosine; the sum in f32,
/// which the constant estimate of Lambert's law shows.
#[test]
fn monte_carlo_agrees_with_closed_forms() {
    /// A lobe with nothing but its f, and the lobe.
    type Pair = (String, Box<dyn BxDF>, Box<dyn BxDF>);
    let r = Spectrum::splat(0.8);
    let mut pairs: Vec<Pair> = vec![(
        "Lambertian".into(),
        Box::new(Plain(LambertianReflection::new(r))),
        Box::new(LambertianReflection::new(r)),
    )];
    pairs.extend(SIGMAS.map(|sigma| -> Pair {
        let lobe = OrenNayar::new(r, sigma);
        (format!("Oren-Nayar {sigma}"), Box::new(Plain(lobe)), Box::new(lobe))
    }));
    let runs = pairs.len() * (COSINES.len() + 1);
    for (name, plain, closed) in pairs {
        // Rounding alone moves a constant estimate.
        let floor = |error: f64| error.max(1e-6);
        for cos in COSINES {
            let batch = |b| first(plain.rho_hd(view(cos), &choices(400, b), &points(400, b)));
            let batches = (0..64).map(batch);
            let (mean, error) = mean(batches);
            let expected = first(closed.rho_hd(view(cos), &[], &[]));
            assert_mean(mean, floor(error), expected, runs, &format!("{name}, cos {cos}"));
        }
        let batch = |b| first(plain.rho_hh(&points(401, b), &choices(401, b), &points(402, b)));
        let batches = (0..64).map(batch);
        let (mean, error) = mean(batches);
        assert_mean(mean, floor(error), first(closed.rho_hh(&[], &[], &[])), runs, &name);
    }
}

/// A lobe whose own sampling has f cos θ / pdf = R for every sample, so that any number of points
/// gives R; and no points at all give black, not 0 / 0. Caught: a division by the count of samples
/// that the lobe gave, and by an empty slice's length.
#[test]
fn monte_carlo_counts_its_points() {
    let lobe = Stretched { r: 0.7, m: Vec3::new(0.2, 0.6, 1.0) };
    let inside = |u: &[Vec2]| u.iter().filter(|u| u.min_element() > 0.0).count() as f64;
    for count in [1, 2, 100] {
        let u = &points(403, 0)[..count];
        let rho = first(lobe.rho_hd(view(0.5), &choices(403, 0)[..count], u));
        assert!((rho - 0.7 * inside(u) / count as f64).abs() < 1e-5, "{count}: {rho}");
    }
    // One of these two has no direction: it lies on the border of the square.
    let rho = first(lobe.rho_hd(view(0.5), &[0.3; 2], &[Vec2::new(0.0, 0.3), Vec2::splat(0.3)]));
    assert!((rho - 0.35).abs() < 1e-5, "{rho}");
    assert!(lobe.rho_hd(view(0.5), &choices(403, 0), &[]).is_black());
    assert!(lobe.rho_hd(view(0.5), &[], &points(403, 0)).is_black());
    assert!(lobe.rho_hh(&[], &choices(403, 0), &points(403, 0)).is_black());
    let (short, long) = (&points(404, 0)[..7], points(405, 0));
    let (few, many) = (&choices(404, 0)[..7], choices(404, 0));
    let cut = lobe.rho_hh(short, few, &long[..7]);
    assert!(!cut.is_black());
    for (u1, uc, u2) in [(short, &many[..], &long[..]), (&long, few, &long), (&long, &many, short)]
    {
        let shortest = lobe.rho_hh(&u1[..7], &uc[..7], &u2[..7]);
        assert_eq!(lobe.rho_hh(u1, uc, u2), shortest);
    }
    assert_eq!(lobe.rho_hd(view(0.5), few, &long), lobe.rho_hd(view(0.5), few, &long[..7]));
    assert_eq!(lobe.rho_hd(view(0.5), &many, short), lobe.rho_hd(view(0.5), few, short));
}

/// A white furnace: what a white body gives back of uniform light. Lambert's law loses nothing.
/// Oren-Nayar's model leaves out light that goes between grooves and loses up to 44 %, but close to the
/// horizon its qualitative form gives back **more** than comes in, up to 1.5 % at sigma 11 degrees: an
/// error of the model, not of this code. 1 - ρ_hd, by sigma (rows) and cos θ (columns):
#[rustfmt::skip]
const FURNACE_LOSS: [[f64; 5]; 6] = [
    // 1.0       0.7       0.3      0.05      1e-4
    [ 0.0000,   0.0000,   0.0000,   0.0000,   0.0000],
    [ 0.0113,   0.0041,  -0.0023,  -0.0057,  -0.0063],
    [ 0.0502,   0.0235,  -0.0003,  -0.0130,  -0.0151],
    [ 0.1348,   0.0818,   0.0348,   0.0097,   0.0054],
    [ 0.3257,   0.2453,   0.1739,   0.1359,   0.1294],
    [ 0.4410,   0.3521,   0.2732,   0.2311,   0.2239],
];

/// Caught: B's 0.45 taken for 0.5, which the comparisons of the model with itself do not see. EON loses nothing; caught: the second
/// lobe left out, and its share of one reflection for that of many.
#[test]
fn white_furnace() {
    for (sigma, losses) in SIGMAS.into_iter().zip(FURNACE_LOSS) {
        let white = OrenNayar::new(Spectrum::WHITE, sigma);
        for (cos, loss) in [1.0, 0.7, 0.3, 0.05, 1e-4].into_iter().zip(losses) {
            let found = 1.0 - reflectance(&white, view(cos));
            assert!(
                (found - loss).abs() < 1e-4,
                "sigma {sigma}, cos {cos}: {found}, expected {loss}"
            );
        }
    }
    let white = LambertianReflection::new(Spectrum::WHITE);
    for cos in COSINES {
        assert!((reflectance(&white, view(cos)) - 1.0).abs() < 1e-6, "cos {cos}");
    }
    for roughness in ROUGHNESSES.into_iter().chain((0..100).map(|i| i as f32 / 99.0)) {
        let white = EnergyPreservingOrenNayar::new(Spectrum::WHITE, roughness);
        for cos in COSINES {
            let found = reflectance(&white, view(cos));
            assert!((found - 1.0).abs() < 2e-6, "EON {roughness}, cos {cos}: {found}");
        }
    }
}

/// What EON returns by several reflections is dimmed as often: r² Ē / (1 - r (1 - Ē)) of what a white surface returns (Portsmouth, Kutz and
/// Hill 2025). Seen to fail with r for all of it.
#[test]
fn several_reflections_dim_light_as_often() {
    // The albedo of a single reflection: A (1 + roughness G / π).
    let roughness = 0.9;
    let single = |cos: f64| {
        let (theta, sin) = (cos.acos(), (1.0 - cos * cos).sqrt());
        let g = sin * (theta - sin * cos) + 2.0 / 3.0 * (sin / cos * (1.0 - sin.powi(3)) - sin);
        (1.0 + roughness * g / PI) / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness)
    };
    let panels = [[0.0, 0.1], [0.1, 0.4], [0.4, 1.0]].into_iter().flat_map(gauss);
    let mean: f64 = panels.map(|(cos, weight)| 2.0 * weight * cos * single(cos)).sum();
    for (r, cos) in [(0.8, 0.9), (0.8, 0.2), (0.3, 0.5)] {
        let dimmed = r * r * mean / (1.0 - r * (1.0 - mean));
        let expected = r * single(cos) + dimmed * (1.0 - single(cos));
        let lobe = EnergyPreservingOrenNayar::new(Spectrum::splat(r as f32), roughness as f32);
        let found = reflectance(&lobe, view(cos as f32));
        assert!((found - expected).abs() < 1e-3, "r {r}, cos {cos}: {found}, expected {expected}");
    }
}

/// No model reflects more than it receives, with the exception above: ρ_hd stays below 1.0152 R, and below
/// R from sigma 20 degrees on. Caught: B's 0.45 taken for 0.5.
#[test]
fn reflectance_is_bounded() {
    for tenths in 0..=900 {
        let sigma = tenths as f32 / 10.0;
        let lobe = OrenNayar::new(Spectrum::new(1.0, 0.5, 0.0), sigma);
        for step in 1..=200 {
            let cos = (step as f32 / 200.0).powi(2);
            let [r, g, b] = lobe.rho_hd(view(cos), &[], &[]).to_array();
            let bound = if sigma < 20.0 { 1.0152 } else { 1.0 };
            assert!((0.0..=bound).contains(&r), "sigma {sigma}, cos {cos}: {r}");
            assert!((g - 0.5 * r).abs() < 1e-6 && b == 0.0, "sigma {sigma}, cos {cos}");
        }
    }
}

/// A sum of lobes reflects the sum of what they reflect, by quadrature, by its own `rho_hd` and by the
/// mean of f cos θ / pdf over its samples. Caught: `rho_hd` of the first lobe alone.
#[test]
fn sums_of_lobes_add_up() {
    let n = Vec3::new(0.48, 0.6, 0.64);
    let gloss = Stretched { r: 0.3, m: Vec3::new(0.3, 0.3, 1.0) };
    let rough = OrenNayar::new(Spectrum::splat(0.4), 40.0);
    let mut bsdf = Bsdf::new(Frame::from_normal(n), n);
    bsdf.add(LambertianReflection::new(Spectrum::splat(0.2)));
    bsdf.add(rough);
    bsdf.add(Lobe::Custom(&gloss));
    let all = BxdfFlags::all();
    for cos in [1.0, 0.7, 0.3, 0.05] {
        let wo = bsdf.frame().to_world(view(cos));
        let expected = 0.5 + reflectance(&rough, view(cos));
        let (own, own_error) =
            mean((0..16).map(|b| first(bsdf.rho_hd(wo, &choices(406, b), &points(406, b), all))));
        assert_mean(own, own_error.max(1e-6), expected, 8, &format!("rho_hd, cos {cos}"));
        let mut rng = Rng::new(407, 0);
        let samples = (0..200_000).map(|_| {
            let sample = bsdf.sample_f(wo, rng.f32(), rng.square(), all);
            sample.map_or(0.0, |s| first(s.f) * f64::from(s.wi.dot(n).abs() / s.pdf))
        });
        let (sampled, error) = mean(samples);
        assert_mean(sampled, error, expected, 8, &format!("samples, cos {cos}"));
    }
}

/// The fraction of light that a lobe returns, with η² taken out, by its own samples at even sample values: those of the direction are
/// multiples of the plastic number's powers (Roberts 2018), each with all choices of an event.
fn returned(lobe: &dyn BxDF, wo: Vec3) -> f64 {
    const DIRECTIONS: u32 = 1 << 13;
    const CHOICES: u32 = 32;
    let mut sum = 0.0;
    for i in 0..DIRECTIONS {
        let at = |step: f64| (0.5 + step * f64::from(i)).fract();
        let u = Vec2::new(at(0.754_877_666_246_692_8) as f32, at(0.569_840_290_998_053_2) as f32);
        for choice in 0..CHOICES {
            let uc = (f64::from(choice) + at(0.618_033_988_749_894_9)) / f64::from(CHOICES);
            if let Some(s) = lobe.sample_f(wo, uc as f32, u.min(Vec2::splat(1.0 - f32::EPSILON))) {
                sum += first(s.f) * f64::from(s.wi.z.abs() / s.pdf * s.eta * s.eta);
            }
        }
    }
    sum / f64::from(DIRECTIONS * CHOICES)
}

/// The direction turned around the normal, by an angle in radians.
fn turned(w: Vec3, by: f32) -> Vec3 {
    let (sin, cos) = by.sin_cos();
    Vec3::new(cos * w.x - sin * w.y, sin * w.x + cos * w.y, w.z)
}

/// Fails unless white lobes together return all light of these views, within a bound.
fn assert_white(lobes: &[&dyn BxDF], views: &[Vec3], bound: f64, what: &str) {
    for &wo in views {
        let found: f64 = lobes.iter().map(|lobe| returned(*lobe, wo)).sum();
        assert!((found - 1.0).abs() < bound, "{what}, wo {wo}: {found}");
    }
}

/// A white metal, a boundary and a coat with these losses return all light of these views.
fn assert_materials_are_white(
    alpha: [f32; 2],
    losses: Roughnesses,
    etas: &[f32],
    views: &[Vec3],
    bounds: [f64; 3],
) {
    let white = Spectrum::WHITE;
    let [metal, glass, coat] = bounds;
    let mirrors = Losses::of_mirrors(losses);
    let facets = MicrofacetReflection::new(alpha, Fresnel::NoOp).and_multiple(&mirrors, white);
    assert_white(&[&facets], views, metal, &format!("metal {alpha:?}"));
    for &eta in etas {
        let boundary = BoundaryLosses::new(eta, losses);
        let lobe = FresnelMicrofacet::new(white, white, alpha, &boundary);
        assert_white(&[&lobe], views, glass, &format!("glass {eta} {alpha:?}"));
        if eta > 1.0 {
            let entering = Losses::of_coat(eta, losses);
            let top = MicrofacetReflection::new(alpha, Fresnel::Dielectric { eta });
            let base = CoatedDiffuse::new(white, alpha, &entering);
            assert_white(&[&top, &base], views, coat, &format!("coat {eta} {alpha:?}"));
        }
    }
}

/// White furnaces of isotropic glossy lobes with what several facets return: 1 within 1e-3 at every angle and roughness.
/// Caught: a wrong mean roughness; all light refracted that is not reflected; interpolation the wrong way.
#[test]
fn rough_surfaces_lose_nothing() {
    let views = [1.0, 0.6, 0.1, 0.003, -0.7, -0.2, -0.01].map(view);
    let alphas = [0.0, 1e-4, 0.02, 0.2, 0.6, 1.0];
    parallel(alphas.len(), |i| {
        let alpha = [alphas[i]; 2];
        let constant = Roughnesses::Constant(alpha);
        assert_materials_are_white(alpha, constant, &[1.5, 1.05, 0.75], &views, [1e-3; 3]);
    });
}

/// The same where roughness differs by axis, along both axes and between them: within 1.2e-3 up to a ratio of eight, and 2.5e-3 beyond.
#[test]
fn brushed_surfaces_lose_nothing() {
    let views: Vec<_> = [0.0, 0.8, 1.4]
        .into_iter()
        .flat_map(|turn| [1.0, 0.6, 0.1, -0.8, -0.5, -0.05].map(|cos| turned(view(cos), turn)))
        .collect();
    let surfaces = [
        ([0.3, 0.1], 1.2e-3),
        ([0.12, 1.0], 1.2e-3),
        ([0.2, 0.02], 2.5e-3),
        ([1.0, 0.01], 2.5e-3),
        ([0.0, 0.5], 2.5e-3),
    ];
    parallel(surfaces.len(), |i| {
        let (alpha, bound) = surfaces[i];
        let etas: &[f32] = if i % 2 == 0 { &[1.5] } else { &[1.2, 1.0 / 1.5] };
        let constant = Roughnesses::Constant(alpha);
        assert_materials_are_white(alpha, constant, etas, &views, [bound; 3]);
    });
}

/// Neighbouring numbers are one roughness: their losses are not 0/0.
#[test]
fn almost_isotropic_surfaces_lose_nothing() {
    for ulps in 1..40 {
        let alpha = [0.1, f32::from_bits(0.1_f32.to_bits() + ulps * ulps)];
        let losses = Losses::of_mirrors(Roughnesses::Constant(alpha));
        let lobe = MicrofacetReflection::new(alpha, Fresnel::NoOp);
        let f = lobe.and_multiple(&losses, Spectrum::WHITE).f(view(0.3), view(0.5));
        assert!(f.is_valid() && !f.is_black(), "{alpha:?}: {f:?}");
    }
}

/// Losses of any roughness are those of the mean of both axes: exact if they are the same, else within what `Roughnesses` says.
#[test]
fn losses_of_any_roughness() {
    let views: Vec<_> = [0.0, 0.8, 1.57]
        .into_iter()
        .flat_map(|turn| [1.0, 0.6, 0.1, -0.7, -0.2].map(|cos| turned(view(cos), turn)))
        .collect();
    let surfaces = [
        ([0.35, 0.35], [1e-3; 3]),
        ([1.0, 0.25], [0.1, 0.2, 0.2]),
        ([0.02, 1.0], [0.2, 0.26, 0.53]),
    ];
    parallel(surfaces.len(), |i| {
        let (alpha, bounds) = surfaces[i];
        assert_materials_are_white(alpha, Roughnesses::Any, &[1.5], &views, bounds);
    });
}
