//! Hits on flat Lambertian surfaces are shaded four at a time. They give the same bits as hits that are shaded one by one.

mod scenes;

use lobe::bxdf::{Arena, Bsdf};
use lobe::glam::{UVec2, Vec3};
use lobe::integrator::{DirectIntegrator, PathIntegrator};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{DistantLight, LightStrategy, SkyLight};
use lobe::material::Material;
use lobe::scene::{Emission, SceneBuilder};
use lobe::{MatteMaterial, PointLight, RenderOptions, Spectrum, TriangleMesh, render};
use scenes::{any, ball_over_floor, chapter_view, independent};

/// A matte surface that does not declare its constant lobe, so that its hits are shaded one by one.
struct Disguised(MatteMaterial);

impl Material for Disguised {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        self.0.compute_scattering(si, arena)
    }
}

fn scene() -> SceneBuilder {
    ball_over_floor()
        .light(PointLight::new(Vec3::new(10.0, 10.0, -10.0), Spectrum::splat(900.0)))
        .light(PointLight::new(Vec3::new(-5.0, 3.0, 1.0), Spectrum::new(0.0, 20.0, 40.0)))
}

/// The same with lights that rays can hit.
fn lit_scene() -> SceneBuilder {
    let lamp = TriangleMesh::parallelogram(Vec3::new(1.2, 1.5, -1.0), Vec3::X * 2.0, Vec3::Z * 1.5);
    let emission = Emission { radiance: Spectrum::new(4.0, 4.0, 2.0), two_sided: true };
    let sun = DistantLight::new(Vec3::new(-0.6, 0.8, 0.0), Spectrum::splat(0.5)).unwrap();
    scene()
        .glowing_shape("lamp", lamp, "red", emission)
        .light(SkyLight::new(Spectrum::new(0.1, 0.2, 0.3)))
        .light(sun)
}

/// Seen to fail with the terms of the lanes' dot product added in another order, and without the sample value that
/// selects a light at hits that need no other value.
#[test]
fn shading_four_hits_at_once_changes_no_bit() {
    let path = |max_depth, strategy| any(PathIntegrator { max_depth, roulette: true, strategy });
    let [auto, mis] = [LightStrategy::Auto, LightStrategy::Mis];
    let [light, bsdf] = [LightStrategy::Light, LightStrategy::Bsdf];
    let direct = |strategy| any(DirectIntegrator { strategy });
    for integrator in [
        direct(auto),
        direct(mis),
        path(1, auto),
        path(7, auto),
        path(7, mis),
        path(7, light),
        path(7, bsdf),
    ] {
        for scene in [scene, lit_scene] {
            let colors = |builder: SceneBuilder| {
                let (scene, view) = (builder.build().unwrap(), chapter_view(UVec2::new(61, 43)));
                let settings = independent(64, integrator.clone());
                render(&scene, &view, &settings, &RenderOptions::default()).unwrap().picture.color
            };
            let red = || Disguised(MatteMaterial::new([0.8, 0.1, 0.2]));
            let blue = || Disguised(MatteMaterial::new([0.2, 0.3, 0.9]));
            let flat = colors(scene());
            assert!(flat.iter().any(|color| !color.is_black()));
            let mixed = colors(scene().material("red", red()));
            assert!(flat == mixed, "{integrator:?}: one of two materials disguised");
            let both = scene().material("red", red()).material("blue", blue());
            assert!(flat == colors(both), "{integrator:?}: both materials disguised");
        }
    }
}
