//! Shading frames are orthonormal, for any normal and tangent.

use lobe::geometry::Frame;
use lobe::glam::{DMat3, DVec3, Vec3};

use crate::common::Rng;

/// Fails unless s, t, n are unit vectors at right angles, right-handed, to 1e-6.
fn assert_orthonormal(frame: &Frame, what: &str) {
    let [s, t, n] = [frame.s, frame.t, frame.n].map(|v| v.as_dvec3());
    let matrix = DMat3::from_cols(s, t, n);
    let product = matrix.transpose() * matrix;
    let error =
        (product - DMat3::IDENTITY).to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    assert!(error < 1e-6, "{what}: {frame:?} is off by {error}");
    assert!((matrix.determinant() - 1.0).abs() < 2e-6, "{what}: {frame:?} is left-handed");
}

/// Normals at which other constructions fail: the axes, and those around -z where Frisvad's form
/// divides by almost zero, among them the two that Duff et al. 2017 name.
fn normals() -> impl Iterator<Item = Vec3> {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|n| [n, -n]);
    let zeros =
        [Vec3::new(1.0, 0.0, -0.0), Vec3::new(0.0, -1.0, -0.0), Vec3::new(-0.0, -0.0, -1.0)];
    let almost_down = f32::EPSILON - 1.0;
    let duff = [
        Vec3::new(0.000_385_273_16, 0.000_384_600_16, almost_down),
        Vec3::new(-0.000_198_135_81, -0.000_089_468_39, almost_down),
    ];
    let around = (0..200_000).map(|trial| {
        let mut rng = Rng::new(600, trial);
        let tilt = rng.direction_f64() * 10.0_f64.powf(-8.0 * rng.f64());
        (DVec3::NEG_Z * f64::from(rng.sign()) + tilt).normalize().as_vec3()
    });
    axes.chain(zeros).chain(duff).chain(around)
}

/// Caught: Frisvad's construction, which has no `sign`.
#[test]
fn any_normal_has_a_frame() {
    let random = (0..1_000_000).map(|trial| Rng::new(601, trial).direction());
    for n in normals().chain(random) {
        let frame = Frame::from_normal(n);
        assert_orthonormal(&frame, &format!("normal {n}"));
        assert_eq!(frame.n, n);
    }
}

/// Tangents of any length, also such that are almost or quite parallel to the normal, zero, or not
/// finite. Caught: a single projection, whose rounding error is all that is left of a tangent close to
/// the normal and points anywhere; the square of a tangent's length, which leaves the range of f32.
#[test]
fn any_tangent_makes_a_frame() {
    for trial in 0..300_000 {
        let mut rng = Rng::new(602, trial);
        let n = rng.direction();
        let off = match rng.below(4) {
            0 => 0.0,
            1 => 1.0,
            _ => 10.0_f32.powf(-9.0 * rng.f32()),
        };
        let across = rng.direction();
        let tangent = (n * rng.sign() + off * across) * 10.0_f32.powf(60.0 * rng.f32() - 30.0);
        let frame = Frame::from_normal_and_tangent(n, tangent);
        assert_orthonormal(&frame, &format!("trial {trial}, normal {n}, tangent {tangent}"));

        // A tangent well off the normal is followed.
        let (t64, n64) = (tangent.as_dvec3().normalize(), n.as_dvec3());
        let projected = t64 - t64.dot(n64) * n64;
        if projected.length() > 1e-2 {
            let error = (frame.s.as_dvec3() - projected.normalize()).length();
            assert!(
                error < 1e-4,
                "trial {trial}: s is {}, expected {}",
                frame.s,
                projected.normalize()
            );
        }
    }
    for n in [Vec3::X, Vec3::NEG_Z, Vec3::splat(1.0 / 3.0_f32.sqrt())] {
        for tangent in [
            Vec3::ZERO,
            n,
            -n,
            1e30 * n,
            Vec3::NAN,
            Vec3::INFINITY,
            Vec3::new(f32::NAN, 1.0, 0.0),
            Vec3::MAX,
            Vec3::splat(1e-45),
        ] {
            let frame = Frame::from_normal_and_tangent(n, tangent);
            assert_orthonormal(&frame, &format!("normal {n}, tangent {tangent}"));
        }
    }
}

/// To local coordinates and back. Caught: the transpose on one way only.
#[test]
fn directions_come_back() {
    for trial in 0..200_000 {
        let mut rng = Rng::new(603, trial);
        let n = rng.direction();
        let frame = Frame::from_normal_and_tangent(n, rng.direction());
        let w = rng.direction();
        let back = frame.to_world(frame.to_local(w));
        assert!(back.distance(w) < 1e-6, "trial {trial}: {w} comes back as {back}");
        assert!((frame.to_local(w).z - w.dot(n)).abs() < 1e-6, "trial {trial}");
        assert!(frame.to_local(frame.s).distance(Vec3::X) < 1e-6, "trial {trial}");
        assert!(frame.to_local(frame.t).distance(Vec3::Y) < 1e-6, "trial {trial}");
    }
}
