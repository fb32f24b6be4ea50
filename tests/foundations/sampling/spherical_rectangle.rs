//! The spherical rectangle: uniform over the solid angle, from anywhere, at any size.

use lobe::glam::{DVec3, Vec2, Vec3};
use lobe::sampling::SphericalRectangle;

use crate::common::Rng;
use crate::common::stats::assert_fits;

const LAST: f32 = 1.0 - 1.0 / (1 << 24) as f32;
const EDGE: [f32; 4] = [0.0, 1.0 / (1 << 24) as f32, 0.5, LAST];

/// Two edges at exactly right angles, and the unit normal.
const X: Vec3 = Vec3::new(1.0, 2.0, 2.0);
const Y: Vec3 = Vec3::new(2.0, 1.0, -2.0);
const N: DVec3 = DVec3::new(-2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0);

/// A rectangle around which everything is exact to rounding in f32.
struct Case {
    origin: Vec3,
    corner: Vec3,
    edges: [Vec3; 2],
}

impl Case {
    /// A rectangle of edges 10^U(-3, 3), seen from the zero, at a place as far away as 10^U(-3, 3).
    fn random(rng: &mut Rng) -> Self {
        let [s, t, d] = [(); 3].map(|()| rng.coordinate(3.0).abs());
        let edges = [s * X, t * Y];
        let corner = -rng.f32() * edges[0] - rng.f32() * edges[1] + d * rng.direction();
        Self { origin: Vec3::ZERO, corner, edges }
    }

    fn seen(&self) -> Option<SphericalRectangle> {
        SphericalRectangle::new(self.origin, self.corner, self.edges[0], self.edges[1])
    }

    /// The solid angle of the part with these shares of the edges: a small one as two triangles, where the
    /// angles at the corners would cancel; a large one by these, where what stands below the line of the
    /// triangles' formula would (by 1.3e-5 of 4.8 sr for a strip close to its plane).
    ///
    /// Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle", with what stands above the
    /// line found without a loss of digits.
    fn solid_angle(&self, [a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
        let [x, y] = self.edges.map(Vec3::as_dvec3);
        let corner = self.corner.as_dvec3() - self.origin.as_dvec3();
        let at = |s: f64, t: f64| corner + s * x + t * y;
        let volume = (corner.dot(N) * x.length() * y.length() * (b - a) * (d - c)).abs();
        let triangle = |p: DVec3, q: DVec3, r: DVec3| {
            let [lp, lq, lr] = [p, q, r].map(DVec3::length);
            2.0 * volume.atan2(lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq)
        };
        let two = triangle(at(a, c), at(b, c), at(b, d)) + triangle(at(a, c), at(b, d), at(a, d));
        if two < 1e-6 {
            return two;
        }
        let z = corner.dot(N).abs();
        let below = |s: f64, t: f64| {
            let place = at(s, t);
            let (x, y) = (place.dot(x.normalize()), place.dot(y.normalize()));
            (x * y).atan2(z * (x * x + y * y + z * z).sqrt())
        };
        below(b, d) - below(a, d) - below(b, c) + below(a, c)
    }
}

/// Over many decades of size and distance, from 1e-6 to 2π sr.
#[test]
fn solid_angle_is_that_of_two_triangles() {
    let (mut small, mut large) = (0, 0);
    for trial in 0..200_000 {
        let case = Case::random(&mut Rng::new(910, trial));
        let truth = case.solid_angle([0.0, 1.0], [0.0, 1.0]);
        let found = case.seen().map_or(0.0, |seen| f64::from(seen.solid_angle()));
        let error = (found - truth).abs();
        // The height itself is a difference, with the rounding of f64 in it.
        let corner = case.corner.as_dvec3();
        let rounding = 1e-14 * corner.length() / corner.dot(N).abs();
        assert!(
            error <= 1e-7 * truth + 1e-14 + rounding,
            "trial {trial}: {found}, expected {truth}"
        );
        if let Some(seen) = case.seen() {
            let one = f64::from(seen.pdf()) * truth;
            assert!(truth < 1e-6 || (one - 1.0).abs() < 2e-7 + rounding, "trial {trial}: {one}");
        }
        small += usize::from(truth < 1e-3);
        large += usize::from(truth > 6.0);
    }
    assert!(small > 10_000 && large > 1_000, "{small} small and {large} large");
}

/// The first coordinate is the share of the solid angle before the point, and the inverse leads back,
/// wherever the rectangle is sampled by lights: from 1e-6 sr on.
#[test]
fn points_are_at_their_share_of_the_solid_angle() {
    let mut worst = [0.0_f64; 8];
    for trial in 0..30_000 {
        let case = Case::random(&mut Rng::new(911, trial));
        let truth = case.solid_angle([0.0, 1.0], [0.0, 1.0]);
        // Closer to the plane, the solid angles that stand for the truth are noise.
        let corner = case.corner.as_dvec3();
        let fine = truth > 1e-6 && corner.dot(N).abs() > 1e-8 * corner.length();
        let Some(seen) = case.seen().filter(|_| fine) else { continue };
        let mut rng = Rng::new(912, trial);
        let random = [rng.square(), rng.square()];
        let edge = EDGE.into_iter().flat_map(|x| EDGE.map(|y| Vec2::new(x, y)));
        for u in edge.chain(random) {
            let p = seen.sample(u);
            let moved = p.as_dvec3() - case.corner.as_dvec3();
            let [s, _] =
                case.edges.map(|e| moved.dot(e.as_dvec3()) / e.as_dvec3().length_squared());
            let share = case.solid_angle([0.0, s.clamp(0.0, 1.0)], [0.0, 1.0]) / truth;
            let error = (share - f64::from(u.x)).abs();
            // How far off a point is that is rounded to f32: not the warp's fault.
            let ulp = f64::from(f32::EPSILON * p.abs().max_element()) * 2.0;
            let step = ulp / case.edges[0].as_dvec3().length();
            let after = case.solid_angle([0.0, (s + step).min(1.0)], [0.0, 1.0]) / truth;
            let before = case.solid_angle([0.0, (s - step).max(0.0)], [0.0, 1.0]) / truth;
            let rounding = (after - share).max(share - before);
            assert!(error <= 1e-3 + rounding, "trial {trial}, u = {u}: {share}, {truth} sr");
            let decade = (-truth.log10()).ceil().clamp(0.0, 7.0) as usize;
            worst[decade] = worst[decade].max(error - rounding);
            let back = (seen.inverse(p) - u).abs();
            // The line through the point has its own share of rounding in y.
            let fine = rounding < 1e-4 && ulp < 1e-4 * case.edges[1].as_dvec3().length();
            assert!(!fine || back.x <= 2e-3, "trial {trial}, u = {u}: {back}");
        }
    }
    println!("worst error of u by decade of the solid angle, from 1 sr down: {worst:?}");
}

/// The inverse to 1e-3, both coordinates, for rectangles at distances that are not extreme.
#[test]
fn inverse_leads_back() {
    let values: Vec<f32> = EDGE.into_iter().chain((1..20).map(|i| i as f32 / 20.0)).collect();
    for trial in 0..200 {
        let mut rng = Rng::new(913, trial);
        let edges = [rng.within(0.1, 2.0) * X, rng.within(0.1, 2.0) * Y];
        let corner = rng.within(0.3, 5.0) * rng.direction();
        let case = Case { origin: Vec3::ZERO, corner, edges };
        let seen = case.seen().unwrap();
        if seen.solid_angle() < 1e-3 {
            continue;
        }
        for &x in &values {
            for &y in &values {
                let u = Vec2::new(x, y);
                let back = seen.inverse(seen.sample(u));
                let error = (back - u).abs().max_element();
                assert!(error <= 1e-3, "trial {trial}: u = {u}, inverse {back}");
            }
        }
    }
}

/// 1e6 samples over 256 cells of the rectangle against the solid angles of the cells, from far away,
/// from the side, from a corner, from close above and through the middle.
#[test]
fn samples_have_their_density() {
    let n = N.as_vec3();
    let origins = [
        50.0 * n + 3.0 * X,
        0.5 * n - 2.0 * X - Y,
        n + 0.5 * X + 0.5 * Y,
        1e-2 * n + 0.3 * X + 0.9 * Y,
        -0.1 * n,
        1e-3 * n + 3.0 * X - 2.0 * Y,
    ];
    for (run, origin) in origins.into_iter().enumerate() {
        let case = Case { origin, corner: Vec3::ZERO, edges: [X, Y] };
        let seen = case.seen().unwrap();
        let mut observed = vec![0; 256];
        let mut rng = Rng::new(914, run as u64);
        for _ in 0..1_000_000 {
            let p = seen.sample(rng.square()).as_dvec3();
            let cell = [X, Y].map(|e| ((p.dot(e.as_dvec3()) / 9.0 * 16.0) as usize).min(15));
            observed[16 * cell[1] + cell[0]] += 1;
        }
        let part = |i: usize| [i as f64 / 16.0, (i + 1) as f64 / 16.0];
        let expected: Vec<f64> = (0..256)
            .map(|c| case.solid_angle(part(c % 16), part(c / 16)) * f64::from(seen.pdf()) * 1e6)
            .collect();
        let total = expected.iter().sum::<f64>() / 1e6;
        assert!((total - 1.0).abs() < 1e-6, "run {run}: the pdf integrates to {total}");
        assert_fits(&observed, &expected, 6, &format!("run {run}"));
    }
}

/// Anything goes in, and what comes out is a point of the rectangle.
#[test]
fn extremes_have_points_too() {
    for exponent in [-18, -9, -6, 0, 6, 9, 12] {
        let scale = 10.0_f32.powi(exponent);
        let n = N.as_vec3();
        let heights = [0.0, 1e-30, 1e-12, 1e-6, 1.0, 1e6];
        for height in heights.into_iter().flat_map(|h| [h, -h]) {
            for [s, t] in [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [1.0, 1.0], [2.0, 0.0], [-1.0, 3.0]]
            {
                let origin = scale * (s * X + t * Y + height * n);
                let edges = [scale * X, scale * Y];
                let case = Case { origin, corner: Vec3::ZERO, edges };
                let Some(seen) = case.seen() else { continue };
                let solid_angle = seen.solid_angle();
                assert!(
                    (0.0..=1.000_01 * std::f32::consts::TAU).contains(&solid_angle),
                    "{solid_angle} from {origin}"
                );
                for u in EDGE.into_iter().flat_map(|x| EDGE.map(|y| Vec2::new(x, y))) {
                    let p = seen.sample(u) / scale;
                    let on = [X, Y].map(|e| p.dot(e) / 9.0);
                    let inside = on.iter().all(|share| (-1e-6..=1.000_001).contains(share));
                    assert!(inside, "u = {u} from {origin}: {p}");
                    let back = seen.inverse(seen.sample(u));
                    assert!(back.is_finite(), "u = {u} from {origin}: {back}");
                }
            }
        }
    }
    let none = |corner, x| SphericalRectangle::new(Vec3::ZERO, corner, x, Vec3::Y).is_none();
    assert!(none(Vec3::X, Vec3::X), "in its plane");
    assert!(none(Vec3::Z, Vec3::ZERO), "without area");
    assert!(none(Vec3::NAN, Vec3::X), "not a number");
    // From close above, all of the hemisphere.
    let low =
        SphericalRectangle::new(1e-20 * Vec3::Z, -Vec3::X - Vec3::Y, 2.0 * Vec3::X, 2.0 * Vec3::Y);
    assert_eq!(low.unwrap().solid_angle(), std::f32::consts::TAU);
}
