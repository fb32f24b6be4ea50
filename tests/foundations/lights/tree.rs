//! Selection among many lights: probabilities against sums, formulas and counts.

use std::f32::consts::PI;
use std::sync::Arc;

use lobe::glam::Vec3;
use lobe::light::{
    AreaLight, BoundingSphere, Light, LightBounds, LightChoice, LightSample, LightSampler,
    PointLight, SkyLight, SpotLight,
};
use lobe::{Spectrum, TriangleMesh};

use super::{L, rectangle};
use crate::common::{Rng, stats};

/// The largest sample value.
const LAST: f32 = 1.0 - f32::EPSILON / 2.0;

/// A light that says this about itself.
struct Told {
    bounds: Option<LightBounds>,
    power: Option<f32>,
}

impl Light for Told {
    fn is_delta(&self) -> bool {
        true
    }
    fn sample_li(&self, _p: Vec3, _u: lobe::glam::Vec2) -> Option<LightSample> {
        None
    }
    fn power(&self, _scene: &BoundingSphere) -> Option<Spectrum> {
        self.power.map(Spectrum::splat)
    }
    fn bounds(&self) -> Option<LightBounds> {
        self.bounds
    }
}

/// A lamp of 0.1 by 0.1 or so at a place, facing anywhere.
fn small_lamp(rng: &mut Rng, at: Vec3) -> AreaLight {
    let x = rng.direction();
    let mesh = rectangle(at, x * 0.1, x.cross(rng.direction()).normalize_or(Vec3::X) * 0.1);
    AreaLight::new(&mesh, L * rng.f32(), rng.below(2) == 0).unwrap()
}

/// Lights of all kinds, near each other or not, some without power, some without a place.
fn lights(rng: &mut Rng, count: usize) -> Vec<Arc<dyn Light>> {
    let scale = [1.0, 1e-3, 1e4, 0.0][rng.below(4)];
    let light = |rng: &mut Rng| -> Arc<dyn Light> {
        let at = rng.direction() * rng.f32() * scale;
        let power = [None, Some(0.0), Some(rng.f32()), Some(10_f32.powf(rng.within(-20.0, 20.0)))];
        match rng.below(6) {
            0 => Arc::new(PointLight::new(at, Spectrum::splat(rng.f32()))),
            1 => {
                let cone = rng.within(1e-3, 180.0);
                let start = cone * rng.f32();
                Arc::new(SpotLight::new(at, rng.direction(), L, cone, start).unwrap())
            }
            2 => Arc::new(small_lamp(rng, at)),
            3 => {
                // Its normals are all around.
                let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|p| at + p * 0.3);
                let indices = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
                let positions = corners.to_vec();
                let mesh = TriangleMesh { positions, indices, ..Default::default() };
                Arc::new(AreaLight::new(&mesh, L, false).unwrap())
            }
            4 => {
                let size = rng.direction().abs() * 10_f32.powf(rng.within(-6.0, 2.0));
                let bounds = LightBounds::new(at, at + size);
                let angle = f64::from(rng.within(-0.5, 4.0));
                let bounds = bounds.with_emission(rng.direction(), angle, rng.f64() * 2.0);
                let bounds = if rng.below(2) == 0 { bounds.with_two_sides() } else { bounds };
                Arc::new(Told { bounds: Some(bounds), power: power[rng.below(4)] })
            }
            _ => {
                // Bounds that are none.
                let bad = [Vec3::NAN, Vec3::INFINITY, at - 1.0][rng.below(3)];
                let bounds = [None, Some(LightBounds::new(at, bad))][rng.below(2)];
                Arc::new(Told { bounds, power: power[rng.below(4)] })
            }
        }
    };
    let mut lights: Vec<_> = (0..count).map(|_| light(rng)).collect();
    if rng.below(2) == 0 {
        lights.insert(rng.below(count), Arc::new(SkyLight::new(L)));
    }
    lights
}

fn sampler(lights: &[Arc<dyn Light>]) -> LightSampler {
    let scene = BoundingSphere { center: Vec3::ZERO, radius: 2.0 };
    LightSampler::new(lights, (0..lights.len()).collect(), LightChoice::One, &scene)
}

/// Any point: among the lights, on one of them, or far away.
fn receiver(rng: &mut Rng, lights: &[Arc<dyn Light>]) -> Vec3 {
    match rng.below(4) {
        0 => rng.direction() * rng.f32(),
        1 => rng.point(12.0),
        2 => Vec3::ZERO,
        _ => {
            let sample = lights[rng.below(lights.len())].sample_li(Vec3::ONE, rng.square());
            sample.and_then(|sample| sample.from).unwrap_or(Vec3::X)
        }
    }
}

/// Each light has at least a tenth of what it has by power alone, all of them together have 1, and the selected one's
/// probability is the one that is asked for.
/// Seen to fail with the share of the tree left out of what `pick` tells, and with nodes without any weight taken as they are.
#[test]
fn probabilities_sum_to_one() {
    for trial in 0..400 {
        let rng = &mut Rng::new(350, trial);
        let most = [10, 300][rng.below(2)];
        let count = 5 + rng.below(most);
        let lights = lights(rng, count);
        let sampler = sampler(&lights);
        for _ in 0..10 {
            let p = receiver(rng, &lights);
            let probabilities = (0..lights.len()).map(|light| sampler.probability(light, p));
            let least = 0.0099 / lights.len() as f32;
            assert!(probabilities.clone().all(|q| q >= least), "trial {trial}, {p}");
            let sum: f64 = probabilities.map(f64::from).sum();
            assert!((sum - 1.0).abs() < 1e-5, "trial {trial}, {p}: {sum}");
            for u in [0.0, rng.f32(), rng.f32(), LAST] {
                let (light, picked) = sampler.pick(0, p, u);
                let told = sampler.probability(light, p);
                assert!((picked / told - 1.0).abs() < 1e-5, "trial {trial}, {p}: {picked}, {told}");
            }
        }
    }
}

/// Lights are selected as often as their probabilities say.
/// Seen to fail with a sample value that is not stretched from node to node.
#[test]
fn lights_are_drawn_as_often_as_told() {
    let (trials, samples) = (40, 200_000);
    for trial in 0..trials {
        let rng = &mut Rng::new(351, trial);
        let count = 5 + rng.below(200);
        let lights = lights(rng, count);
        let sampler = sampler(&lights);
        let p = receiver(rng, &lights);
        let mut drawn = vec![0; lights.len()];
        for _ in 0..samples {
            drawn[sampler.pick(0, p, rng.f32()).0] += 1;
        }
        let expected: Vec<f64> = (0..lights.len())
            .map(|light| f64::from(sampler.probability(light, p)) * f64::from(samples))
            .collect();
        stats::assert_fits(&drawn, &expected, trials as usize, &format!("trial {trial}, {p}"));
    }
}

/// Eight lights hang on one node, and one has no place: their probabilities are in proportion to power over squared distance, times the cosine at a
/// lamp and the falloff of a spot's border.
/// Seen to fail with the distance in place of its square, one side for two, and the last tenth not made smaller.
#[test]
fn near_and_facing_lights_are_preferred() {
    for trial in 0..200 {
        let rng = &mut Rng::new(352, trial);
        let mut lights = Vec::<Arc<dyn Light>>::new();
        let (mut powers, mut arriving) = (Vec::new(), Vec::new());
        let p = rng.direction() * 3.0 * rng.f32();
        for _ in 0..8 {
            let (at, power) = (rng.direction() * rng.within(0.1, 1.0), rng.within(0.1, 1.0));
            let to_p = p - at;
            let intensity = match rng.below(2) {
                0 => {
                    let i = power / (4.0 * PI);
                    lights.push(Arc::new(PointLight::new(at, Spectrum::splat(i / 3.0))));
                    i
                }
                _ => {
                    let (n, two_sided) = (rng.direction(), rng.below(2) == 0);
                    let bounds = LightBounds::new(at, at).with_normals(n * 2.0, 0.0);
                    let bounds = if two_sided { bounds.with_two_sides() } else { bounds };
                    let told = Some(power / 3.0);
                    lights.push(Arc::new(Told { bounds: Some(bounds), power: told }));
                    let cos = n.dot(to_p.normalize());
                    let (cos, sides) = if two_sided { (cos.abs(), 2.0) } else { (cos, 1.0) };
                    cos.max(0.0) * power / (PI * sides)
                }
            };
            powers.push(power);
            arriving.push(intensity / to_p.length_squared());
        }
        powers.push(0.7);
        lights.push(Arc::new(Told { bounds: None, power: Some(0.7 / 3.0) }));
        let sampler = sampler(&lights);
        let sum = |values: &[f32]| values.iter().sum::<f32>();
        let by_power = |light: usize| 0.9 * powers[light] / sum(&powers) + 0.1 / 9.0;
        let with_place: f32 = (0..8).map(by_power).sum();
        for light in 0..9 {
            let expected = match arriving.get(light) {
                Some(light_here) => {
                    let by_tree = light_here / sum(&arriving);
                    0.9 * with_place * by_tree + 0.1 * by_power(light)
                }
                None => by_power(light),
            };
            let told = sampler.probability(light, p);
            assert!((told / expected - 1.0).abs() < 1e-3, "trial {trial}: {told}, {expected}");
        }
    }
}

/// Where light arrives from a light, the tree gives it more than the tenth that is left by power: bounds hold what they are
/// bounds of.
/// Seen to fail without the angle of the sphere, with the axis of a union turned away, with the smaller of two angles of emission,
/// the last of the angles of normals, two sides lost in a union, and with spots whose border is too sharp for a cosine in f32.
#[test]
fn no_light_that_shines_is_taken_for_dark() {
    let mut lit = 0;
    for trial in 0..2000 {
        let rng = &mut Rng::new(353, trial);
        let light = |rng: &mut Rng| -> Arc<dyn Light> {
            let at = rng.direction() * rng.f32();
            match rng.below(3) {
                0 => {
                    let cone = rng.within(1.0, 180.0);
                    let start = cone * [rng.f32(), 1.0][rng.below(2)];
                    Arc::new(SpotLight::new(at, rng.direction(), L, cone, start).unwrap())
                }
                1 => Arc::new(small_lamp(rng, at)),
                _ => {
                    // A bent sheet, with normals up to some angle apart.
                    let (x, y, bend) = (rng.direction(), rng.direction(), rng.direction());
                    let far = at + x + y + bend * rng.f32();
                    let positions = vec![at, at + x, at + y, far, far + rng.direction()];
                    let indices = vec![[0, 1, 2], [2, 1, 3], [2, 3, 4]];
                    let mesh = TriangleMesh { positions, indices, ..Default::default() };
                    let two_sided = rng.below(2) == 0;
                    let light = AreaLight::new(&mesh, L, two_sided);
                    light.map_or_else(|| Arc::new(small_lamp(rng, at)) as _, |l| Arc::new(l) as _)
                }
            }
        };
        let lights: Vec<Arc<dyn Light>> = (0..5 + rng.below(40)).map(|_| light(rng)).collect();
        let sampler = sampler(&lights);
        let scene = BoundingSphere::default();
        let power =
            |light: &Arc<dyn Light>| light.power(&scene).unwrap().to_array().iter().sum::<f32>();
        let all: f32 = lights.iter().map(power).sum();
        let p = rng.direction() * 2.0 * rng.f32();
        for (index, light) in lights.iter().enumerate() {
            let shines = (0..20).any(|_| light.sample_li(p, rng.square()).is_some());
            if !shines {
                continue;
            }
            lit += 1;
            let left = 0.1 * (0.9 * power(light) / all + 0.1 / lights.len() as f32);
            let told = sampler.probability(index, p);
            assert!(told > left * (1.0 + 1e-5), "trial {trial}, light {index}: {told}, {left}");
        }
    }
    assert!(lit > 10_000, "only {lit} lights shine");
}

/// Probabilities do not depend on the unit of length.
/// Seen to fail with half the diagonal for a squared distance, as PBRT has it.
#[test]
fn any_unit_of_length_will_do() {
    for trial in 0..50 {
        let rng = &mut Rng::new(354, trial);
        let places: Vec<_> =
            (0..40).map(|_| (rng.direction(), rng.f32(), rng.direction())).collect();
        let p = rng.direction() * 2.0 * rng.f32();
        let of_unit = |unit: f32| {
            let light = |&(at, size, n): &(Vec3, f32, Vec3)| -> Arc<dyn Light> {
                let bounds = LightBounds::new(at * unit, (at + size) * unit).with_normals(n, 0.3);
                Arc::new(Told { bounds: Some(bounds), power: None })
            };
            let sampler = sampler(&places.iter().map(light).collect::<Vec<_>>());
            (0..40).map(|light| sampler.probability(light, p * unit)).collect::<Vec<_>>()
        };
        assert_eq!(of_unit(1.0), of_unit(2_f32.powi(-20)), "trial {trial}");
        assert_eq!(of_unit(1.0), of_unit(2_f32.powi(20)), "trial {trial}");
    }
}
