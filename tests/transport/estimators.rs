//! All integrators, samplers and strategies that are unbiased agree.

use lobe::glam::{UVec2, Vec3};
use lobe::integrator::{DirectIntegrator, Integrator, PathIntegrator};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{DistantLight, LightStrategy, SkyLight};
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::{Emission, SceneBuilder};
use lobe::{MatteMaterial, PointLight, RenderSettings, Spectrum, TriangleMesh};

use crate::scenes::{any, ball, ball_over_floor, chapter_view};
use crate::statistics::{assert_alike, bands, picture};

const SAMPLERS: [SamplerKind; 4] = [
    SamplerKind::INDEPENDENT,
    SamplerKind::STRATIFIED,
    SamplerKind::SOBOL,
    SamplerKind::BLUE_NOISE,
];
const STRATEGIES: [LightStrategy; 4] =
    [LightStrategy::Auto, LightStrategy::Mis, LightStrategy::Light, LightStrategy::Bsdf];

/// All kinds of lights at once: a point, a distant one, the sky, a rectangle and a glowing ball. None is so small or
/// so weak that a strategy would find it only once in a hundred samples: the means would be far from normal.
fn scene() -> SceneBuilder {
    let lamp = TriangleMesh::parallelogram(Vec3::new(1.2, 1.5, -1.0), Vec3::X * 2.0, Vec3::Z * 1.5);
    let mut moon = ball(6);
    moon.positions.iter_mut().for_each(|p| *p = *p * 0.6 + Vec3::new(-1.6, -0.8, -1.2));
    moon.normals = ball(6).positions;
    let glow = |l: f32, two_sided| Emission { radiance: Spectrum::new(l, l, 0.5 * l), two_sided };
    ball_over_floor()
        // Rough, and with vertex normals.
        .material("red", MatteMaterial::new([0.8, 0.1, 0.2]).with_sigma(20.0))
        .lamp("lamp", lamp, glow(4.0, true))
        .glowing_shape("moon", moon, "red", glow(5.0, false))
        .light(SkyLight::new(Spectrum::new(0.1, 0.2, 0.3)))
        .light(DistantLight::new(Vec3::new(-0.6, 0.8, 0.0), Spectrum::splat(0.5)).unwrap())
        .light(PointLight::new(Vec3::new(3.0, 3.0, -3.0), Spectrum::splat(8.0)))
}

/// Its place in the registry.
fn index(kind: SamplerKind) -> u64 {
    SamplerKind::all().position(|other| other == kind).unwrap() as u64
}

fn estimate(integrator: impl Integrator + 'static, kind: SamplerKind) -> Vec<(f64, f64)> {
    // The reference has another seed: equal samples would hide errors that both share.
    let seed = 100 * index(kind);
    let sampler = SamplerSettings { kind, spp: 2048, seed, replicates: 64 };
    bands(&picture(
        scene(),
        &chapter_view(UVec2::splat(24)),
        &RenderSettings::new(sampler, integrator),
    ))
}

/// Direct light, by both integrators. Seen to fail with the power heuristic's arguments exchanged.
#[test]
fn direct_light_has_one_value() {
    let direct = |strategy| any(DirectIntegrator { strategy });
    let path = |strategy| any(PathIntegrator { max_depth: 1, roulette: false, strategy });
    let reference = estimate(direct(LightStrategy::Mis), SamplerKind::INDEPENDENT);
    for strategy in STRATEGIES {
        for integrator in [direct(strategy), path(strategy)] {
            let other = estimate(integrator.clone(), SamplerKind::SOBOL);
            assert_alike(&reference, &other, &format!("{integrator:?}"));
        }
    }
}

/// Light of several reflections. Seen to fail with the power heuristic's arguments exchanged at rough surfaces.
#[test]
fn paths_have_one_value() {
    let path = |roulette, strategy| PathIntegrator { max_depth: 5, roulette, strategy };
    let reference = estimate(path(false, LightStrategy::Mis), SamplerKind::INDEPENDENT);
    for strategy in STRATEGIES {
        for roulette in [false, true] {
            let integrator = path(roulette, strategy);
            let other = estimate(integrator, SamplerKind::STRATIFIED);
            assert_alike(&reference, &other, &format!("{integrator:?}"));
        }
    }
}

/// All samplers, with the strategy [`LightStrategy::Auto`].
#[test]
fn all_samplers_give_one_value() {
    let auto = PathIntegrator::new(4);
    let reference = estimate(auto, SamplerKind::INDEPENDENT);
    for kind in &SAMPLERS[1..] {
        assert_alike(&reference, &estimate(auto, *kind), &format!("{kind:?}"));
    }
}

/// Shading normals far from the geometric ones, those of a ball on an octahedron, tilted towards the sky as well. Seen to
/// fail with a Bsdf that reflects light from below the shading normal's horizon, which
/// light sampling finds and no lobe samples.
#[test]
fn leaning_normals_have_one_value() {
    let octahedron = || TriangleMesh { normals: ball(2).positions, ..ball(2) };
    let under = |strategy, kind| {
        let mut leaning = octahedron();
        leaning.positions.iter_mut().for_each(|p| *p = *p * 1.5 + Vec3::Y);
        leaning.normals.iter_mut().for_each(|n| *n = (*n + 0.8 * Vec3::Y).normalize());
        let sampler = SamplerSettings { kind, spp: 2048, seed: index(kind), replicates: 64 };
        let integrator = PathIntegrator { max_depth: 3, roulette: false, strategy };
        let scene = ball_over_floor()
            .material("red", MatteMaterial::new([0.8, 0.5, 0.2]))
            .shape("leaning", leaning, "red")
            .light(SkyLight::new(Spectrum::splat(1.0)));
        let settings = RenderSettings::new(sampler, integrator);
        bands(&picture(scene, &chapter_view(UVec2::splat(24)), &settings))
    };
    let reference = under(LightStrategy::Light, SamplerKind::INDEPENDENT);
    for strategy in [LightStrategy::Mis, LightStrategy::Bsdf] {
        assert_alike(&reference, &under(strategy, SamplerKind::SOBOL), &format!("{strategy:?}"));
    }
}

/// Lamps of textures: a glowing ball and a bent panel with dark parts, and a rectangle, beside a constant one, with each strategy.
/// Caught: the density of all triangles together in the weights, and a sampled texture that takes its shape for the first.
#[test]
fn textured_lamps_have_one_value() {
    let mut panel =
        TriangleMesh::parallelogram(Vec3::new(1.2, 1.5, -1.0), Vec3::X * 2.0, Vec3::Z * 1.5);
    let window = TriangleMesh { ..panel.clone() };
    panel.positions.iter_mut().for_each(|p| *p -= Vec3::new(3.5, -0.3, 0.5));
    panel.positions[2].y += 0.6;
    let mut moon = ball(6);
    moon.positions.iter_mut().for_each(|p| *p = *p * 0.6 + Vec3::new(-1.6, -0.8, -1.2));
    moon.normals = ball(6).positions;
    let by_place = |si: &SurfaceInteraction| {
        let dark = si.place().is_some_and(|place| place.triangle % 3 != 0 || place.shape == 0);
        Spectrum::new(14.0, 10.0, 6.0) * f32::from(u8::from(!dark))
    };
    let by_uv = |si: &SurfaceInteraction| {
        let stripe = (8.0 * si.uv().x).floor() as u32 % 2;
        Spectrum::new(6.0, 4.0 * si.uv().y, 2.0) * stripe as f32
    };
    let estimate = |strategy, kind| {
        let sampler = SamplerSettings { kind, spp: 2048, seed: index(kind), replicates: 64 };
        let integrator = PathIntegrator { max_depth: 3, roulette: false, strategy };
        let scene = ball_over_floor()
            .glowing_shape(
                "moon",
                moon.clone(),
                "red",
                Emission { radiance: by_place, two_sided: false },
            )
            .lamp("panel", panel.clone(), Emission { radiance: by_uv, two_sided: true })
            .lamp("window", window.clone(), Emission { radiance: by_uv, two_sided: false });
        let settings = RenderSettings::new(sampler, integrator);
        bands(&picture(scene, &chapter_view(UVec2::splat(24)), &settings))
    };
    let reference = estimate(LightStrategy::Bsdf, SamplerKind::INDEPENDENT);
    for strategy in [LightStrategy::Mis, LightStrategy::Light, LightStrategy::Auto] {
        let other = estimate(strategy, SamplerKind::SOBOL);
        assert_alike(&reference, &other, &format!("{strategy:?}"));
    }
}
