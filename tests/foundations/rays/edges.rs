//! The triangle test by itself, at the edges.

use lobe::geometry::Ray;
use lobe::glam::{Vec2, Vec3};
use lobe::shape::ShearedRay;

use crate::common::Rng;

/// The test decides exactly on which side of an edge a ray passes, however close: along the z axis, where the shear
/// rounds nothing, against the sign of the edge function in f64, which holds it. Caught: an edge function of
/// 0 without its second look in f64, which hits beside the triangle. Caught as well: a ray along an edge
/// taken to be outside of the triangle; and, in triangles whose areas are below the least float, an edge function that
/// underflows to 0.
#[test]
fn edges_are_told_exactly() {
    for (number, exponent) in [0.0, -65.0, -80.0].into_iter().enumerate() {
        told_exactly(811 + number as u64, f32::exp2(exponent));
    }
}

fn told_exactly(test: u64, size: f32) {
    let ray = ShearedRay::new(&Ray::new(Vec3::ZERO, Vec3::Z));
    let mut close = 0;
    for trial in 0..100_000 {
        let mut rng = Rng::new(test, trial);
        // An edge past the axis within a few units of the last place, and a corner well off it.
        let p = rng.direction().truncate();
        let q = -p * rng.within(0.5, 2.0);
        let nudge = |x: f32, rng: &mut Rng| (0..rng.below(4)).fold(x, |x, _| x.next_up());
        let q = Vec2::new(nudge(q.x, &mut rng), nudge(q.y, &mut rng));
        let r = p.perp() * rng.sign();
        let [p, q, r] = [p, q, r].map(|corner| corner * size);
        let corners = [p, q, r].map(|c| c.extend(1.0));
        let edge = |a: Vec2, b: Vec2| a.as_dvec2().perp_dot(b.as_dvec2());
        let e = [edge(p, q), edge(q, r), edge(r, p)];
        let hit = e.iter().all(|&e| e >= 0.0) || e.iter().all(|&e| e <= 0.0);
        let found = ray.intersect(&corners, 0.0, f32::INFINITY).is_some();
        assert_eq!(found, hit, "size {size:e}, trial {trial}: {corners:?}, edge functions {e:?}");
        close += u32::from(p.x * q.y - p.y * q.x == 0.0 && e[0] != 0.0);
    }
    assert!(close > 1000, "only {close} edges needed more than f32");
}
