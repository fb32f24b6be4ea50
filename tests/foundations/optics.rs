//! Mirrors, boundaries and trigonometry against closed forms in f64.

use lobe::geometry::trig::{
    abs_cos_theta, cos_d_phi, cos_phi, cos_theta, cos2_phi, cos2_theta, same_hemisphere, sin_phi,
    sin_theta, sin2_phi, sin2_theta, tan_theta, tan2_theta,
};
use lobe::geometry::{reflect, refract};
use lobe::glam::{DVec3, Vec3};

use crate::common::Rng;

/// Relative indices of refraction, with and without a total reflection.
const ETAS: [f32; 9] =
    [1.0, 1.0 - 1e-6, 1.0 + 1e-6, 1.5, 1.0 / 1.5, 1.33, 1.0 / 1.33, 2.4, 1.0 / 2.4];

/// wr = -wo + 2 (wo · n) n, for any side. Caught: the factor 2 left out; the sign turned round.
#[test]
fn mirrors_reflect() {
    for trial in 0..100_000 {
        let mut rng = Rng::new(500, trial);
        let (wo, n) = (rng.direction(), rng.direction());
        let (wo64, n64) = (wo.as_dvec3(), n.as_dvec3());
        let truth = 2.0 * wo64.dot(n64) * n64 - wo64;
        let wr = reflect(wo, n);
        assert!((wr.as_dvec3() - truth).length() < 1e-6, "trial {trial}: {wr}, expected {truth}");
        assert!((wr.dot(n) - wo.dot(n)).abs() < 1e-6, "trial {trial}");
        assert!(reflect(wo, -n).distance(wr) < 1e-6, "trial {trial}");
    }
}

/// Snell's law, eta sin θi = sin θt, in the plane of wi and n, to 1e-5. Close to the critical angle
/// the cosine is the root of a small difference, so that its error is bounded as error · cosine.
/// Caught: eta for 1/eta; the cosine's sign; sin² taken as 1 - cos², which moves directions close to the
/// normal by 1e-4.
#[test]
fn boundaries_refract() {
    for trial in 0..200_000 {
        let mut rng = Rng::new(501, trial);
        let eta = ETAS[rng.below(ETAS.len())];
        let n = if rng.f32() < 0.5 { Vec3::Z } else { rng.direction() };
        // Half of the directions are within 1e-4 of the normal or of the surface.
        let theta = std::f64::consts::FRAC_PI_2
            * match rng.below(4) {
                0 => rng.f64() * 1e-4,
                1 => 1.0 - rng.f64() * 1e-4,
                _ => rng.f64(),
            };
        let n64 = n.as_dvec3().normalize();
        let across = n64.cross(rng.direction_f64()).normalize();
        let wi = (theta.sin() * across + theta.cos() * n64).as_vec3();

        let eta64 = f64::from(eta);
        let in_plane = wi.as_dvec3() - wi.as_dvec3().dot(n64) * n64;
        let sin2 = eta64 * eta64 * in_plane.length_squared();
        let what = format!("trial {trial}, eta {eta}, {wi}, n {n}");
        // Whether the exact critical angle is passed is decided by rounding.
        if (sin2 - 1.0).abs() < 2e-6 {
            continue;
        }
        let Some(wt) = refract(wi, n, eta) else {
            assert!(sin2 > 1.0, "{what}: no direction, but sin² θt = {sin2}");
            continue;
        };
        assert!(sin2 < 1.0, "{what}: {wt}, but sin² θt = {sin2}");
        let cos = (1.0 - sin2).sqrt();
        let truth: DVec3 = -eta64 * in_plane - cos * n64;
        let error = (wt.as_dvec3() - truth).length();
        assert!(error < 1e-6 + (1e-6 / cos).min(2e-3), "{what}: {wt}, expected {truth}");
        assert!(cos < 0.11 || error < 1e-5, "{what}: {wt}, expected {truth}");
        // The plane of incidence and the length are kept.
        let off_plane = wt.as_dvec3().dot(n64.cross(across));
        assert!(off_plane.abs() < 1e-6, "{what}: {off_plane} off the plane of incidence");
        if n == Vec3::Z {
            // Along an axis nothing is lost: the part across is right to its last digits.
            let exact = -eta64 * wi.truncate().as_dvec2();
            let error = (wt.truncate().as_dvec2() - exact).length();
            assert!(error <= 2e-7 * exact.length(), "{what}: {wt}, expected {exact}");
        }
        // And back through the other side.
        if cos > 0.11 && theta.cos() > 0.11 {
            let back = refract(wt, -n, 1.0 / eta).map(|w| w.distance(wi));
            assert!(back.is_some_and(|d| d < 1e-5), "{what}: comes back {back:?} beside");
        }
    }
}

/// At Brewster's angle, tan θ = n2 / n1, the reflected and the refracted ray are at right angles; at
/// the critical angle, sin θ = n2 / n1, refraction ends. Both directions through the boundary. Caught: eta²
/// for eta.
#[test]
fn brewster_and_critical_angle() {
    for index in [1.0 + 1e-3, 1.33, 1.5, 2.4, 4.0_f64] {
        for eta in [index, 1.0 / index] {
            let brewster = (1.0 / eta).atan();
            let wi = Vec3::new(brewster.sin() as f32, 0.0, brewster.cos() as f32);
            let wt = refract(wi, Vec3::Z, eta as f32).unwrap();
            let cos = reflect(wi, Vec3::Z).dot(wt);
            assert!(cos.abs() < 1e-5, "eta {eta}: {cos}");
        }
        let critical = (1.0 / index).asin();
        let at = |theta: f64| {
            refract(Vec3::new(theta.sin() as f32, 0.0, theta.cos() as f32), Vec3::Z, index as f32)
        };
        assert!(at(critical - 1e-5).is_some(), "index {index}");
        assert!(at(critical + 1e-5).is_none(), "index {index}");
    }
}

/// At the very critical angle, where refracted light would run along the surface, all of it is reflected: a sine of 1/2 at
/// index 2, and a direction along the surface at index 1, both exact in floats. Caught: a direction without cosine
/// returned there.
#[test]
fn the_critical_angle_itself_reflects() {
    for (wi, eta) in [(Vec3::new(0.5, 0.0, 0.75_f32.sqrt()), 2.0), (Vec3::X, 1.0)] {
        assert_eq!(refract(wi, Vec3::Z, eta), None, "{wi}, eta {eta}");
    }
}

/// Against f64, from the pole to the horizon, with angles down to 1e-30. Caught: sin² as 1 - cos², which
/// is 0 below an angle of 2e-4; sin θ as the root of an underflowing square; the clamp of cos Δφ
/// left out.
#[test]
fn trigonometry() {
    for trial in 0..200_000 {
        let mut rng = Rng::new(502, trial);
        let tiny = 10.0_f64.powf(-30.0 * rng.f64());
        let (sin, phi) = (tiny.min(1.0), rng.f64() * std::f64::consts::TAU);
        let mut w =
            DVec3::new(sin * phi.cos(), sin * phi.sin(), (1.0 - sin * sin).sqrt()).as_vec3();
        if rng.f32() < 0.3 {
            // Tiny angles to the horizon instead.
            w = Vec3::new(w.z, w.x, w.y);
        }
        w *= rng.sign();
        let (x, y, z) = (f64::from(w.x), f64::from(w.y), f64::from(w.z));
        let sin = x.hypot(y);
        let what = |name: &str| format!("trial {trial}: {name} of {w}");
        let relative = |name: &str, found: f32, truth: f64| {
            assert!(
                (f64::from(found) - truth).abs() <= 1e-6 * truth.abs(),
                "{}: {found}, expected {truth}",
                what(name)
            );
        };
        relative("cos", cos_theta(w), z);
        relative("cos²", cos2_theta(w), f64::from(w.z * w.z));
        relative("|cos|", abs_cos_theta(w), z.abs());
        relative("sin", sin_theta(w), sin);
        if sin > 1e-18 {
            relative("sin²", sin2_theta(w), sin * sin);
        }
        if (sin / z).abs() < 1e18 && sin > 1e-18 && z.abs() > 1e-18 {
            relative("tan", tan_theta(w), sin / z);
            relative("tan²", tan2_theta(w), (sin / z).powi(2));
        }
        for (name, found, truth) in [
            ("cos φ", cos_phi(w), x / sin),
            ("sin φ", sin_phi(w), y / sin),
            ("cos² φ", cos2_phi(w), (x / sin).powi(2)),
            ("sin² φ", sin2_phi(w), (y / sin).powi(2)),
        ] {
            assert!(found.abs() <= 1.0, "{}: {found}", what(name));
            assert!(
                (f64::from(found) - truth).abs() <= 1e-6,
                "{}: {found}, expected {truth}",
                what(name)
            );
        }

        let v = rng.direction();
        let (vx, vy) = (f64::from(v.x), f64::from(v.y));
        let truth = (x * vx + y * vy) / (sin * vx.hypot(vy));
        let found = cos_d_phi(w, v);
        // The cosine's own rounding is relative to 1.
        assert!(
            (f64::from(found) - truth).abs() <= 2e-6,
            "{}: {found}, expected {truth}",
            what("cos Δφ")
        );
        // Directions of the same azimuth: the quotient of equal numbers is rounded.
        let along = Vec3::new(0.3 * w.x, 0.3 * w.y, w.z);
        assert!(cos_d_phi(w, along) <= 1.0 && cos_d_phi(w, -along) >= -1.0, "{}", what("cos Δφ"));
        assert_eq!(same_hemisphere(w, v), z * f64::from(v.z) > 0.0, "{}", what("side"));
    }
}

/// At the pole φ is 0, and a direction along the surface is on neither side. Caught: the product of
/// two tiny cosines for the comparison of signs.
#[test]
fn trigonometry_at_its_edges() {
    assert_eq!((cos_phi(Vec3::Z), sin_phi(Vec3::Z)), (1.0, 0.0));
    assert_eq!(cos_d_phi(Vec3::Z, Vec3::X), 1.0);
    assert_eq!(tan_theta(Vec3::X), f32::INFINITY);
    assert_eq!(tan2_theta(Vec3::X), f32::INFINITY);
    let grazing = |z: f32| Vec3::new(1.0, 0.0, z);
    assert!(same_hemisphere(grazing(1e-30), grazing(1e-30)));
    assert!(same_hemisphere(grazing(-1e-30), grazing(-1e-30)));
    assert!(!same_hemisphere(grazing(1e-30), grazing(-1e-30)));
    for along in [0.0, -0.0] {
        assert!(!same_hemisphere(grazing(along), grazing(1.0)));
        assert!(!same_hemisphere(grazing(along), grazing(along)));
    }
}
