//! Selection of lights: by power, and none is left out.

use std::sync::Arc;

use lobe::Spectrum;
use lobe::glam::{Vec2, Vec3};
use lobe::light::{BoundingSphere, Light, LightChoice, LightSample, LightSampler, PointLight};

use crate::common::Rng;

/// A custom light with this power.
struct Told(Option<f32>);

impl Light for Told {
    fn is_delta(&self) -> bool {
        true
    }
    fn sample_li(&self, _p: Vec3, _u: Vec2) -> Option<LightSample> {
        None
    }
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        self.0.map(Spectrum::splat)
    }
}

fn sampler(told: &[Option<f32>], choice: LightChoice) -> LightSampler {
    let lights: Vec<Arc<dyn Light>> =
        told.iter().map(|&power| -> Arc<dyn Light> { Arc::new(Told(power)) }).collect();
    let all = (0..lights.len()).collect();
    LightSampler::new(&lights, all, choice, &BoundingSphere::default())
}

/// Nine tenths by power, one tenth uniform; unknown powers count as the mean of the known ones, and invalid ones as
/// zero. Lights are selected as often as the probability says.
/// Caught: lights without power left out; the unknown taken for dark; NaN let into the sum.
#[test]
fn every_light_is_drawn() {
    let huge = f32::MAX;
    let cases: [(&[Option<f32>], &[f32]); 7] = [
        (&[Some(1.0), Some(3.0)], &[0.25, 0.75]),
        (&[Some(1.0), Some(3.0), None], &[1.0 / 6.0, 0.5, 1.0 / 3.0]),
        (&[Some(1.0), Some(0.0)], &[1.0, 0.0]),
        (&[Some(1.0), Some(-2.0), Some(f32::NAN)], &[2.0 / 3.0, 0.0, 1.0 / 3.0]),
        (&[None, None], &[0.5, 0.5]),
        (&[Some(0.0), Some(0.0), None], &[0.0, 0.0, 1.0]),
        (
            &[Some(huge), Some(huge), Some(f32::INFINITY), Some(1.0)],
            &[1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0],
        ),
    ];
    for (case, (told, by_power)) in cases.into_iter().enumerate() {
        let sampler = sampler(told, LightChoice::One);
        let count = told.len() as f32;
        assert!(sampler.draws() && sampler.slots() == 1, "case {case}");
        let mut drawn = vec![0_u32; told.len()];
        let trials = 40_000;
        for i in 0..trials {
            drawn[sampler.pick(0, Vec3::ZERO, (i as f32 + 0.5) / trials as f32).0] += 1;
        }
        for (light, share) in by_power.iter().enumerate() {
            let expected = 0.9 * share + 0.1 / count;
            let told = sampler.probability(light, Vec3::ZERO);
            assert!((told - expected).abs() < 1e-5, "case {case}, light {light}: {told}");
            let seen = drawn[light] as f32 / trials as f32;
            assert!((seen - expected).abs() < 2e-4, "case {case}, light {light}: {seen}");
        }
    }
}

/// If all lights are sampled, each has a slot, and a single light is never selected at random.
/// Caught: the probability of the choice left in.
#[test]
fn all_lights_are_sampled_without_a_choice() {
    for (told, choice) in
        [(&[Some(1.0), Some(0.0), None][..], LightChoice::All), (&[Some(0.0)], LightChoice::One)]
    {
        let sampler = sampler(told, choice);
        assert!(!sampler.draws());
        assert_eq!(sampler.slots(), told.len());
        for light in 0..told.len() {
            assert_eq!(sampler.pick(light, Vec3::ZERO, 0.7), (light, 1.0));
            assert_eq!(sampler.probability(light, Vec3::ZERO), 1.0);
        }
    }
}

/// Lights that are not sampled have probability 0, and the others keep their indices.
/// Caught: places among the sampled taken for numbers.
#[test]
fn indices_are_those_of_the_scene() {
    let lights: Vec<Arc<dyn Light>> = (0..4)
        .map(|i| -> Arc<dyn Light> {
            Arc::new(PointLight::new(Vec3::ZERO, Spectrum::splat(i as f32)))
        })
        .collect();
    let sampler =
        LightSampler::new(&lights, vec![1, 3], LightChoice::One, &BoundingSphere::default());
    assert_eq!([0, 2].map(|light| sampler.probability(light, Vec3::ZERO)), [0.0; 2]);
    assert!((sampler.probability(3, Vec3::ZERO) - (0.9 * 0.75 + 0.05)).abs() < 1e-6);
    let mut rng = Rng::new(340, 0);
    for _ in 0..1000 {
        assert!([1, 3].contains(&sampler.pick(0, Vec3::ZERO, rng.f32()).0));
    }
}
