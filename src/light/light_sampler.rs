//! [`LightSampler`]: which of the scene's lights are sampled at a hit.

use std::sync::Arc;

use glam::Vec3;

use super::tree::{Leaf, LightTree};
use super::{BoundingSphere, Light};
use crate::geometry::float::ONE_MINUS_EPSILON;
use crate::sampling::Discrete;

/// How many lights are sampled at each hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightChoice {
    /// All of them.
    All,
    /// One, selected by power, or by what arrives from each if there are many.
    One,
}

/// Selects lights at a hit: all lights that are sampled, or one of them.
///
/// With up to four lights that have [`bounds`](Light::bounds) the probability is the same everywhere and grows with power (PBRT 3rd
/// edition, section 14.3; Shirley, Wang and Zimmerman 1996): nine tenths are proportional to power, and one tenth is uniform. So lights
/// of zero or unknown power are selected too, and noise stays bounded where a weak light is the only one that contributes.
///
/// With more, a tree selects among them by what may arrive at the point: power over squared distance, and the cosine on the
/// light's side (PBRT 4th edition, section 12.6.3). It has nine tenths of the probability that they would have together, and the
/// last tenth is left as it was. So bounds that are wrong lose no light. Lights without bounds keep their probability.
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
/// let expected = 0.9 * 0.75 + 0.1 / 2.0;
/// assert!((sampler.probability(1, Vec3::Y) - expected).abs() < 1e-6);
/// assert_eq!(sampler.pick(0, Vec3::Y, 0.99), (1, sampler.probability(1, Vec3::Y)));
/// ```
#[derive(Clone, Debug)]
pub struct LightSampler {
    /// Indices of the lights that are sampled.
    sampled: Vec<usize>,
    /// Selects an element of `sampled`; `None` if all of them are sampled at each hit.
    by_power: Option<Discrete>,
    /// Per light of the scene: probability that a hit samples it, without what the tree adds.
    probability: Vec<f32>,
    by_place: Option<ByPlace>,
}

/// Selection of those lights that have bounds.
#[derive(Clone, Debug)]
struct ByPlace {
    tree: LightTree,
    /// The probability that a light is selected by the tree.
    share: f32,
    /// Indices of the tree's lights.
    lights: Vec<usize>,
    /// Per light of the scene: its place in `lights`, or `NONE`.
    places: Vec<u32>,
}

const NONE: u32 = u32::MAX;

/// The most lights with bounds that are selected by power alone.
const FEW: usize = 4;

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
            return Self { sampled, by_power: None, probability, by_place: None };
        }
        let powers = known(sampled.iter().map(|&light| power(&*lights[light], scene)).collect());
        let mut shares = shares(&powers);
        let by_place = ByPlace::new(lights, &sampled, &powers, &mut shares);
        let by_power = Discrete::new(shares);
        let rest = by_place.as_ref().map_or(1.0, |by_place| 1.0 - by_place.share);
        for (index, &light) in sampled.iter().enumerate() {
            let share = by_power.as_ref().map_or(1.0, |shares| shares.probability(index));
            probability[light] = rest * share;
        }
        Self { sampled, by_power, probability, by_place }
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

    /// Index of the light to sample for light sample `slot` of a hit at `p`, with `u` in `[0, 1)`, and its
    /// [`probability`](Self::probability) up to rounding.
    #[inline]
    pub fn pick(&self, slot: usize, p: Vec3, u: f32) -> (usize, f32) {
        let Some(by_power) = &self.by_power else {
            let light = self.sampled[slot];
            return (light, self.probability[light]);
        };
        let Some(ByPlace { tree, share, lights, .. }) = &self.by_place else {
            let light = self.sampled[by_power.sample(u).0];
            return (light, self.probability[light]);
        };
        if u < *share {
            let (place, of_tree) = tree.pick(p, (u / share).min(ONE_MINUS_EPSILON));
            let light = lights[place];
            return (light, self.probability[light] + share * of_tree);
        }
        let rest = ((u - share) / (1.0 - share)).min(ONE_MINUS_EPSILON);
        let light = self.sampled[by_power.sample(rest).0];
        (light, self.probability(light, p))
    }

    /// Probability that a hit at `p` samples the light with this index: 0 if it is never sampled. The same for all `p` if the
    /// light is at an infinite distance.
    #[inline]
    pub fn probability(&self, light: usize, p: Vec3) -> f32 {
        let by_tree = |by_place: &ByPlace| by_place.probability(light, p);
        self.probability[light] + self.by_place.as_ref().map_or(0.0, by_tree)
    }

    /// Whether the light with this index is ever sampled.
    #[inline]
    pub fn is_sampled(&self, light: usize) -> bool {
        self.probability[light] > 0.0
    }
}

impl ByPlace {
    /// A tree of the sampled lights that have bounds, if there are more than [`FEW`]. Their shares become those of the lights
    /// that no tree selects.
    fn new(
        lights: &[Arc<dyn Light>],
        sampled: &[usize],
        powers: &[f64],
        shares: &mut [f64],
    ) -> Option<Self> {
        let mut leaves = Vec::new();
        let mut of_tree = Vec::new();
        for (index, (&light, &power)) in sampled.iter().zip(powers).enumerate() {
            let bounds = lights[light].bounds().filter(|bounds| bounds.is_valid());
            if let Some(bounds) = bounds.filter(|_| !lights[light].is_infinite()) {
                leaves.push(Leaf { bounds, power });
                of_tree.push(index);
            }
        }
        if leaves.len() <= FEW {
            return None;
        }
        let mut places = vec![NONE; lights.len()];
        let mut share = 0.0;
        for (place, &index) in of_tree.iter().enumerate() {
            places[sampled[index]] = place as u32;
            share += 0.9 * shares[index];
            shares[index] *= 0.1;
        }
        let lights = of_tree.iter().map(|&index| sampled[index]).collect();
        Some(Self { tree: LightTree::new(&leaves), share: share as f32, lights, places })
    }

    #[inline]
    fn probability(&self, light: usize, p: Vec3) -> f32 {
        match self.places[light] {
            NONE => 0.0,
            place => self.share * self.tree.probability(place as usize, p),
        }
    }
}

/// Power summed over the bands; `None` if it is unknown or NaN.
fn power(light: &dyn Light, scene: &BoundingSphere) -> Option<f64> {
    let power = light.power(scene)?.to_array().map(f64::from).iter().sum::<f64>();
    // Clamped to the largest f32, so that sums stay finite.
    (!power.is_nan()).then(|| power.clamp(0.0, f32::MAX.into()))
}

/// Unknown powers count as the mean of the known ones.
fn known(powers: Vec<Option<f64>>) -> Vec<f64> {
    let known: Vec<f64> = powers.iter().copied().flatten().collect();
    let mean = match known.iter().sum::<f64>() / known.len() as f64 {
        mean if mean > 0.0 => mean,
        _ => 1.0,
    };
    powers.into_iter().map(|power| power.unwrap_or(mean)).collect()
}

/// Selection probability of each light by power alone.
fn shares(powers: &[f64]) -> Vec<f64> {
    let (sum, count) = (powers.iter().sum::<f64>(), powers.len() as f64);
    let by_power = |power: f64| if sum > 0.0 { 0.9 * power / sum } else { 0.9 / count };
    powers.iter().map(|&power| by_power(power) + 0.1 / count).collect()
}
