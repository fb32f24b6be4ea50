//! Many lights: the tree selects among them without bias.

use lobe::glam::{UVec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::light::{LightStrategy, SkyLight, SpotLight};
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::SceneBuilder;
use lobe::{PointLight, RenderSettings, Spectrum, TriangleMesh};

use crate::scenes::hall::{Placeless, hall, hall_view, lamp};
use crate::scenes::{any, ball};
use crate::statistics::{assert_alike, bands, picture};

/// The hall with panels of all orientations, glowing balls, points, spots and some sky, whose places are kept from the choice if
/// `placeless`. Lamps are large, so that the strategy `bsdf` finds them often enough for a normal distribution.
fn lit(placeless: bool) -> SceneBuilder {
    let mut builder = hall().light(SkyLight::new(Spectrum::splat(0.2)));
    for i in 0..36 {
        let at = |i: i32| (i as f32 - 2.5) * 6.0;
        let place = Vec3::new(at(i % 6), 3.2, at(i / 6));
        let glow = Spectrum::new(1.0, 0.8, 0.5) * (1.0 + (i % 5) as f32);
        let name = format!("lamp {i}");
        match i % 4 {
            0 => {
                let (x, z) = (Vec3::new(2.0, 0.5, 0.0), Vec3::new(0.3, -0.4, 2.0));
                let mesh = TriangleMesh::parallelogram(place, x, z);
                builder = lamp(builder, name, mesh, glow, placeless);
            }
            1 => {
                let mut mesh = ball(4);
                mesh.positions.iter_mut().for_each(|p| *p = *p * 0.7 + place);
                builder = lamp(builder, name, mesh, glow, placeless);
            }
            2 => {
                let light = PointLight::new(place, glow * 3.0);
                builder = match placeless {
                    true => builder.light(Placeless(light)),
                    false => builder.light(light),
                };
            }
            _ => {
                let down = Vec3::new(0.3, -1.0, 0.2);
                let light = SpotLight::new(place, down, glow * 6.0, 60.0, 20.0).unwrap();
                builder = match placeless {
                    true => builder.light(Placeless(light)),
                    false => builder.light(light),
                };
            }
        }
    }
    builder
}

fn estimate(placeless: bool, strategy: LightStrategy, seed: u64) -> Vec<(f64, f64)> {
    let sampler =
        SamplerSettings { kind: SamplerKind::INDEPENDENT, spp: 2048, seed, replicates: 64 };
    let integrator = any(PathIntegrator { max_depth: 3, roulette: false, strategy });
    let settings = RenderSettings::new(sampler, integrator);
    bands(&picture(lit(placeless), &hall_view(UVec2::new(24, 16)), &settings))
}

/// By the tree with each strategy, and by power alone. Seen to fail with a probability that belongs to another vertex of its block, and
/// with 1/37 for each light that one vertex alone selects.
#[test]
fn many_lights_have_one_value() {
    let reference = estimate(true, LightStrategy::Mis, 0);
    let strategies = [LightStrategy::Mis, LightStrategy::Light, LightStrategy::Bsdf];
    for (seed, strategy) in (1..).zip(strategies) {
        assert_alike(&reference, &estimate(false, strategy, seed), &format!("{strategy:?}"));
    }
}

/// Direct light of nine large panels, which surfaces find as often as lights do, so that weights matter. Seen to fail
/// with the probabilities at the origin, and with half of them.
#[test]
fn large_lamps_have_one_value() {
    let estimate = |strategy, seed| {
        let mut builder = hall();
        for i in 0..9 {
            let at = |i: i32| (i as f32 - 1.0) * 12.0 - 4.0;
            let corner = Vec3::new(at(i % 3), 3.0, at(i / 3));
            let mesh = TriangleMesh::parallelogram(corner, Vec3::X * 8.0, Vec3::Z * 8.0);
            let glow = Spectrum::splat(1.0 + (i % 4) as f32);
            builder = lamp(builder, format!("lamp {i}"), mesh, glow, false);
        }
        let sampler =
            SamplerSettings { kind: SamplerKind::INDEPENDENT, spp: 4096, seed, replicates: 64 };
        let integrator = PathIntegrator { max_depth: 1, roulette: false, strategy };
        let settings = RenderSettings::new(sampler, integrator);
        bands(&picture(builder, &hall_view(UVec2::new(24, 16)), &settings))
    };
    let reference = estimate(LightStrategy::Bsdf, 0);
    for (seed, strategy) in [(1, LightStrategy::Mis), (2, LightStrategy::Light)] {
        assert_alike(&reference, &estimate(strategy, seed), &format!("{strategy:?}"));
    }
}
