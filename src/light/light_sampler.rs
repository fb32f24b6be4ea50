//! [`LightSampler`]: which of the scene's lights are sampled at a hit.

use std::sync::Arc;

use super::{BoundingSphere, Light};
use crate::sampling::Discrete;

/// How many lights are sampled at each hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightChoice {
    /// All of them.
    All,
    /// One, selected by power.
    One,
}

/// Selects lights at a hit: all lights that are sampled, or one of them with a probability that grows with
/// its power (PBRT 3rd edition, section 14.3; Shirley, Wang and Zimmerman 1996).
///
/// Nine tenths of the probability are proportional to power, and one tenth is uniform. So lights of zero or
/// unknown power are selected too, and noise stays bounded where a weak light is the only one that
/// contributes.
///
/// ```
/// use std::sync::Arc;
///
/// use lobe::Spectrum;
/// use lobe::glam::Vec3;
/// use lobe::light::{BoundingSphere, Light, LightChoice, LightSampler, PointLight};
///
/// let lights = [1.0, 3.0].map(|i| -> Arc<dyn Light> {
///     Arc::new(PointLight::new(Vec3::ZERO, Spectrum::splat(i)))
/// });
/// let scene = BoundingSphere::default();
/// let sampler = LightSampler::new(&lights, vec![0, 1], LightChoice::One, &scene);
/// assert!((sampler.probability(1) - (0.9 * 0.75 + 0.1 / 2.0)).abs() < 1e-6);
/// assert_eq!(sampler.pick(0, 0.99), 1);
/// ```
#[derive(Clone, Debug)]
pub struct LightSampler {
    /// Indices of the lights that are sampled.
    sampled: Vec<usize>,
    /// Selects an element of `sampled`; `None` if all of them are sampled at each hit.
    by_power: Option<Discrete>,
    /// Per light of the scene: probability that a hit samples it.
    probability: Vec<f32>,
}

impl LightSampler {
    /// Selects among those of `lights` whose indices are in `sampled`, in a scene with these bounds.
    ///
    /// # Panics
    /// If an index in `sampled` is out of range.
    pub fn new(
        lights: &[Arc<dyn Light>],
        sampled: Vec<usize>,
        choice: LightChoice,
        scene: &BoundingSphere,
    ) -> Self {
        let mut probability = vec![0.0; lights.len()];
        if choice == LightChoice::All || sampled.len() < 2 {
            for &light in &sampled {
                probability[light] = 1.0;
            }
            return Self { sampled, by_power: None, probability };
        }
        let powers = sampled.iter().map(|&light| power(&*lights[light], scene)).collect();
        let by_power = Discrete::new(shares(powers));
        for (index, &light) in sampled.iter().enumerate() {
            probability[light] = by_power.as_ref().map_or(1.0, |shares| shares.probability(index));
        }
        Self { sampled, by_power, probability }
    }

    /// Indices of all lights that are sampled.
    pub fn sampled(&self) -> &[usize] {
        &self.sampled
    }

    /// Number of lights that each hit samples.
    #[inline]
    pub fn slots(&self) -> usize {
        if self.draws() { 1 } else { self.sampled.len() }
    }

    /// Whether one light is selected at random, so that [`pick`](Self::pick) uses `u`.
    #[inline]
    pub fn draws(&self) -> bool {
        self.by_power.is_some()
    }

    /// Index of the light to sample for light sample `slot` of a hit, with `u` in `[0, 1)`.
    #[inline]
    pub fn pick(&self, slot: usize, u: f32) -> usize {
        let index = self.by_power.as_ref().map_or(slot, |by_power| by_power.sample(u).0);
        self.sampled[index]
    }

    /// Probability that a hit samples the light with this index: 0 if it is never sampled.
    #[inline]
    pub fn probability(&self, light: usize) -> f32 {
        self.probability[light]
    }
}

/// Power summed over the bands; `None` if it is unknown or NaN.
fn power(light: &dyn Light, scene: &BoundingSphere) -> Option<f64> {
    let power = light.power(scene)?.to_array().map(f64::from).iter().sum::<f64>();
    // Clamped to the largest f32, so that sums stay finite.
    (!power.is_nan()).then(|| power.clamp(0.0, f32::MAX.into()))
}

/// Selection probability of each light. Unknown powers count as the mean of the known ones.
fn shares(powers: Vec<Option<f64>>) -> Vec<f64> {
    let known: Vec<f64> = powers.iter().copied().flatten().collect();
    let mean = match known.iter().sum::<f64>() / known.len() as f64 {
        mean if mean > 0.0 => mean,
        _ => 1.0,
    };
    let powers: Vec<f64> = powers.into_iter().map(|power| power.unwrap_or(mean)).collect();
    let (sum, count) = (powers.iter().sum::<f64>(), powers.len() as f64);
    let by_power = |power: f64| if sum > 0.0 { 0.9 * power / sum } else { 0.9 / count };
    powers.iter().map(|&power| by_power(power) + 0.1 / count).collect()
}
