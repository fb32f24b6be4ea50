//! [`LightSampler`]: which of the scene's lights a surface asks.

use std::sync::Arc;

use super::{BoundingSphere, Light};
use crate::sampling::Discrete;

/// Which lights are asked at a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightChoice {
    /// Each of them.
    All,
    /// One, drawn by power.
    One,
}

/// The choice of lights at a hit: all of those that are sampled, or one of them, the likelier the more power
/// it has (PBRT 3rd edition, section 14.3; Shirley, Wang and Zimmerman 1996).
///
/// Nine tenths of the probability follow power, and one tenth is shared alike. So each light that is sampled
/// is drawn at all, one that gives no power or does not know it too; and where a weak light is the only one
/// that shines, it is not all noise.
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
    /// The numbers of the lights that are sampled.
    sampled: Vec<usize>,
    /// How one of these is drawn; `None` if all are asked.
    by_power: Option<Discrete>,
    /// By light: how likely a hit asks it.
    probability: Vec<f32>,
}

impl LightSampler {
    /// A choice among those of `lights` whose numbers are in `sampled`, in a scene with these bounds.
    ///
    /// # Panics
    /// If a number is not that of a light.
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
        for (place, &light) in sampled.iter().enumerate() {
            probability[light] = by_power.as_ref().map_or(1.0, |shares| shares.probability(place));
        }
        Self { sampled, by_power, probability }
    }

    /// The numbers of all lights that are sampled.
    pub fn sampled(&self) -> &[usize] {
        &self.sampled
    }

    /// How many lights a hit asks.
    #[inline]
    pub fn slots(&self) -> usize {
        if self.draws() { 1 } else { self.sampled.len() }
    }

    /// Whether one light is drawn, so that [`pick`](Self::pick) looks at `u`.
    #[inline]
    pub fn draws(&self) -> bool {
        self.by_power.is_some()
    }

    /// The number of the light that a hit asks in this slot; `u` in `[0, 1)`.
    #[inline]
    pub fn pick(&self, slot: usize, u: f32) -> usize {
        let place = self.by_power.as_ref().map_or(slot, |by_power| by_power.sample(u).0);
        self.sampled[place]
    }

    /// How likely a hit asks the light with this number: 0 for one that is not sampled.
    #[inline]
    pub fn probability(&self, light: usize) -> f32 {
        self.probability[light]
    }
}

/// The sum over the bands; `None` if it is not known, or not a number.
fn power(light: &dyn Light, scene: &BoundingSphere) -> Option<f64> {
    let power = light.power(scene)?.to_array().map(f64::from).iter().sum::<f64>();
    // What is beyond all floats is as bright as can be told.
    (!power.is_nan()).then(|| power.clamp(0.0, f32::MAX.into()))
}

/// How likely each light is drawn. What is not known counts as the mean of what is.
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
