//! Plain hits, which are shaded four at a time, give the same bits as hits that are shaded one by one.

mod scenes;

use lobe::bxdf::{Arena, Bsdf, TransportMode};
use lobe::glam::{UVec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::material::Material;
use lobe::scene::{IntegratorSettings, LightStrategy, SceneBuilder};
use lobe::{MatteMaterial, PointLight, RenderOptions, Spectrum, render};
use scenes::ball_over_floor;

/// A matte surface that the scene cannot know for one.
struct Disguised(MatteMaterial);

impl Material for Disguised {
    fn compute_scattering<'a>(
        &self,
        si: &mut SurfaceInteraction,
        arena: &'a Arena,
        mode: TransportMode,
        allow_multiple_lobes: bool,
    ) -> Bsdf<'a> {
        self.0.compute_scattering(si, arena, mode, allow_multiple_lobes)
    }
}

fn scene(integrator: IntegratorSettings) -> SceneBuilder {
    ball_over_floor(UVec2::new(61, 43))
        .integrator(integrator)
        .light(PointLight::new(Vec3::new(10.0, 10.0, -10.0), Spectrum::splat(900.0)))
        .light(PointLight::new(Vec3::new(-5.0, 3.0, 1.0), Spectrum::new(0.0, 20.0, 40.0)))
}

/// Seen to fail with the sum of the lanes' dot product in another order, and when the choice of a light was not drawn
/// where nothing else is.
#[test]
fn shading_four_hits_at_once_changes_no_bit() {
    let path =
        |max_depth, strategy| IntegratorSettings::Path { max_depth, roulette: true, strategy };
    let [auto, mis] = [LightStrategy::Auto, LightStrategy::Mis];
    for integrator in [IntegratorSettings::direct(), path(1, auto), path(7, auto), path(7, mis)] {
        let colors = |builder: SceneBuilder| {
            render(&builder.build().unwrap(), &RenderOptions::default()).unwrap().picture.color
        };
        let red = || Disguised(MatteMaterial::new([0.8, 0.1, 0.2]));
        let blue = || Disguised(MatteMaterial::new([0.2, 0.3, 0.9]));
        let plain = colors(scene(integrator));
        assert!(plain.iter().any(|color| !color.is_black()));
        let mixed = colors(scene(integrator).material("red", red()));
        assert!(plain == mixed, "{integrator:?}: one of two materials disguised");
        let disguised = colors(scene(integrator).material("red", red()).material("blue", blue()));
        assert!(plain == disguised, "{integrator:?}: both materials disguised");
    }
}
