//! The point light.

use std::f64::consts::PI;

use lobe::PointLight;
use lobe::glam::{Vec2, Vec3};
use lobe::light::{BoundingSphere, Light};

use super::L;

const P: Vec3 = Vec3::new(1.0, -2.0, 0.5);

/// Seen to fail with distance 0 let through.
#[test]
fn there_is_no_sample_at_the_light_itself() {
    let light = PointLight::new(P, L);
    let beside = P + Vec3::new(0.0, 0.0, 2.0);
    assert_eq!(light.sample_li(P, Vec2::ZERO), None);
    assert_eq!(light.sample_li(beside, Vec2::ZERO).unwrap().li, L / 4.0);
}

/// Power is intensity over the whole sphere, 4π I. Seen to fail with 2π.
#[test]
fn power_is_that_of_the_whole_sphere() {
    let power = PointLight::new(P, L).power(&BoundingSphere::default()).unwrap();
    for (power, i) in power.to_array().into_iter().zip(L.to_array()) {
        let truth = 4.0 * PI * f64::from(i);
        assert!((f64::from(power) / truth - 1.0).abs() < 1e-6, "{power} instead of {truth}");
    }
}
