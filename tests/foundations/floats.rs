//! Bounds on rounding hold the truth.

use lobe::geometry::BoundedPoint;
use lobe::geometry::float::{ONE_MINUS_EPSILON, UNIT_ROUNDOFF, gamma};
use lobe::glam::{DVec3, Vec3};

use crate::common::Rng;
use crate::common::meshes::single;

/// n rounded products and quotients in a row stay within γₙ of the exact value. Caught: a unit roundoff
/// of 2⁻²⁵.
#[test]
fn gamma_bounds_products() {
    for trial in 0..300_000 {
        let mut rng = Rng::new(700, trial);
        let n = 1 + rng.below(40) as u32;
        let (mut value, mut truth) = (1.0_f32, 1.0_f64);
        for _ in 0..n {
            let factor = rng.within(0.5, 2.0);
            if rng.sign() > 0.0 {
                value *= factor;
                truth *= f64::from(factor);
            } else {
                value /= factor;
                truth /= f64::from(factor);
            }
        }
        let error = (f64::from(value) / truth - 1.0).abs();
        assert!(error <= f64::from(gamma(n)), "trial {trial}: {n} operations, error {error}");
    }
}

/// Caught: γ with u = 2⁻²³ or 2⁻²⁵.
#[test]
fn gamma_is_its_formula() {
    let u = 0.5_f64.powi(24);
    assert_eq!(f64::from(UNIT_ROUNDOFF), u);
    assert_eq!(f64::from(ONE_MINUS_EPSILON), 1.0 - u);
    assert_eq!(ONE_MINUS_EPSILON.next_up(), 1.0);
    for n in 1..1000 {
        let truth = f64::from(n) * u / (1.0 - f64::from(n) * u);
        assert!((f64::from(gamma(n)) / truth - 1.0).abs() <= u, "{n}");
        // The first operation of n may be off by u, whose bound is above u.
        assert!(f64::from(gamma(n)) > f64::from(n) * u * (1.0 - u), "{n}");
    }
}

/// A ray's origin is the float next to the point that was moved by its error, away from it: through zero of either sign and
/// over powers of two. Caught: a step that stays at zero, or leads towards the surface below zero.
#[test]
fn origins_are_the_next_floats() {
    for trial in 0..100_000 {
        let mut rng = Rng::new(701, trial);
        let mut number = || match rng.below(4) {
            0 => rng.coordinate(30.0).log2().round().exp2(),
            _ => rng.coordinate(30.0),
        };
        let (x, error) = (number(), number().abs());
        // Every third ends at zero.
        let x = if trial % 3 == 0 { error.copysign(x) } else { x };
        if !x.is_finite() || !error.is_finite() || error == 0.0 {
            continue;
        }
        let point = BoundedPoint { p: Vec3::splat(x), error: Vec3::splat(error) };
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            let along = |v: Vec3| v.dot(axis);
            let above = along(point.ray_origin(axis, axis));
            let below = along(point.ray_origin(axis, -axis));
            assert_eq!(above, (x + error).next_up(), "trial {trial}: {x} and {error}");
            assert_eq!(below, (x - error).next_down(), "trial {trial}: {x} and {error}");
            // Across the normal nothing moves.
            let aside = point.ray_origin(axis, axis) - above * axis;
            assert_eq!(aside, point.p - x * axis, "trial {trial}");
        }
    }
}

/// The normals of triangles up to a million times as long as they are wide, anywhere and of any size, to
/// 1e-5. Caught: a cross product in f32, whose rounding error is all that is left of it for slivers.
#[test]
fn normals_of_slivers_keep_their_digits() {
    for trial in 0..300_000 {
        let mut rng = Rng::new(704, trial);
        let (size, width) = (rng.coordinate(8.0), 10.0_f32.powf(-6.0 * rng.f32()));
        let at = rng.direction() * 10.0_f32.powf(2.0 * rng.f32() - 1.0);
        let along = rng.direction();
        let corners = [Vec3::ZERO, along, along * rng.f32() + width * rng.direction()];
        let mut corners = corners.map(|p| size * (at + p));
        corners.rotate_left(rng.below(3));
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        let Some(truth) = (b - a).cross(c - a).try_normalize() else { continue };
        let n = single(corners).geometric_normal(0);
        let error = (n.as_dvec3() - truth).length();
        assert!(error < 1e-5, "trial {trial}: {corners:?} has {n}, expected {truth}");
    }
}

/// A point of a triangle as a ray test finds it, and the truth.
///
/// The model: edge functions e are given and exact, weights are e over their sum as floats compute it,
/// the truth is the point of the exact quotients. Two times in three, each weight is moved to an end of
/// what one more rounding might have made of it.
fn point_of_triangle(rng: &mut Rng) -> (BoundedPoint, DVec3, [Vec3; 3]) {
    let corners = [(); 3].map(|()| rng.point(8.0));
    let e = [(); 3].map(|()| if rng.f32() < 0.2 { rng.f32() * 1e-6 } else { rng.f32() });
    let sum = e[0] + e[1] + e[2];
    let b = e.map(|e| match rng.below(3) {
        0 => (e / sum).next_up(),
        1 => (e / sum).next_down().max(0.0),
        _ => e / sum,
    });
    let [e0, e1, e2] = e.map(f64::from);
    let [p0, p1, p2] = corners.map(|p| p.as_dvec3());
    let truth = (e0 * p0 + e1 * p1 + e2 * p2) / (e0 + e1 + e2);
    (BoundedPoint::on_triangle(corners, b), truth, corners)
}

/// 1e6 trials with coordinates 10^U(-8, 8). Caught: γ₂ in place of γ₇; the error relative to the
/// point itself, which cancels.
#[test]
fn points_of_triangles_hold_the_truth() {
    for trial in 0..1_000_000 {
        let mut rng = Rng::new(702, trial);
        let (point, truth, corners) = point_of_triangle(&mut rng);
        let error = (point.p.as_dvec3() - truth).abs();
        let bound = point.error.as_dvec3();
        assert!(
            error.cmple(bound).all(),
            "trial {trial}: {corners:?}: off by {error}, bound {bound}"
        );
    }
}

/// A ray's origin lies outside of the error box, on the side that the ray leaves to: the whole box is on
/// the other side of the plane through the origin across the normal. Caught: the origin without the last
/// step to the next float; the offset along the ray; the side of the normal for all rays.
#[test]
fn rays_begin_outside_of_the_error() {
    for trial in 0..1_000_000 {
        let mut rng = Rng::new(703, trial);
        let (point, _, _) = point_of_triangle(&mut rng);
        let n = if rng.f32() < 0.2 {
            [Vec3::X, Vec3::NEG_Y, Vec3::Z][rng.below(3)]
        } else {
            rng.direction()
        };
        let w = rng.direction();
        let origin = point.ray_origin(n, w).as_dvec3();
        let side = f64::from(w.dot(n).signum());
        let n64 = n.as_dvec3();
        let clearance =
            side * n64.dot(origin - point.p.as_dvec3()) - n64.abs().dot(point.error.as_dvec3());
        assert!(
            clearance >= 0.0,
            "trial {trial}: {point:?}, n {n}, w {w}: origin {origin} is {clearance} inside"
        );
        // And not further than need be: no axis moves by more than the error and a few floats.
        let moved = (origin - point.p.as_dvec3()).abs().max_element();
        let need = 2.0 * point.error.as_dvec3().length() + 3e-7 * point.p.as_dvec3().length();
        assert!(moved <= need + 1e-44, "trial {trial}: moved by {moved}");
    }
}
