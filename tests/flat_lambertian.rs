//! Hits on flat Lambertian surfaces are shaded four at a time. They give the same bits as hits that are shaded one by one.

mod scenes;

use lobe::bxdf::{Arena, Bsdf};
use lobe::camera::Camera;
use lobe::geometry::Ray;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::{DirectIntegrator, PathIntegrator};
use lobe::interaction::SurfaceInteraction;
use lobe::light::{DistantLight, LightStrategy, SkyLight};
use lobe::material::Material;
use lobe::scene::{Emission, SceneBuilder};
use lobe::{
    FilmSettings, MatteMaterial, PointLight, RenderOptions, Scene, Spectrum, TriangleMesh, View,
    render,
};
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

/// A camera with one ray for each pixel of a row.
struct Row(Vec<Ray>);

impl Camera for Row {
    fn resolution(&self) -> UVec2 {
        UVec2::new(self.0.len() as u32, 1)
    }
    fn has_lens(&self) -> bool {
        false
    }
    fn generate_ray(&self, pixel: UVec2, _offset: Vec2, _lens: Vec2) -> Ray {
        self.0[pixel.x as usize]
    }
}

/// Rays in the plane of a triangle, but for rounding: some hit it, and have a cosine of exactly 0. A surface is black from
/// there, as `Bsdf` says. Seen to fail with these taken to see the lower side.
#[test]
fn a_surface_is_black_along_itself() {
    let corners = [[0.3, -0.2, 0.1], [1.1, 0.4, -0.3], [0.2, 0.9, 0.7]].map(Vec3::from);
    let mesh = TriangleMesh {
        positions: corners.to_vec(),
        indices: vec![[0, 1, 2]],
        ..TriangleMesh::default()
    };
    let scene = |builder: SceneBuilder| {
        let sky = SkyLight::new(Spectrum::WHITE);
        builder.shape("one", mesh.clone(), "white").light(sky).build().unwrap()
    };
    let white = || MatteMaterial::new([1.0; 3]);
    let flat = scene(Scene::builder().material("white", white()));
    let disguised = scene(Scene::builder().material("white", Disguised(white())));
    let n = mesh.geometric_normal(0);
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let along = |i: u32| {
        let angle = i as f32 * 1e-3;
        let u = (corners[1] - corners[0]).normalize();
        let d = angle.cos() * u + angle.sin() * n.cross(u);
        Ray::new(middle - d * 20.0, d)
    };
    let is_along = |ray: &Ray| ray.d.dot(n) == 0.0 && flat.accel().intersect1(ray).is_hit();
    let rays: Vec<Ray> = (0..6283).map(along).filter(is_along).collect();
    assert!(rays.len() >= 8, "only {} rays", rays.len());
    let film = FilmSettings::new(rays.len() as u32, 1);
    let view = View::new(Row(rays), film).unwrap();
    for strategy in [LightStrategy::Light, LightStrategy::Bsdf, LightStrategy::Mis] {
        let settings = independent(64, DirectIntegrator { strategy });
        for scene in [&flat, &disguised] {
            let rendered = render(scene, &view, &settings, &RenderOptions::default()).unwrap();
            assert!(rendered.picture.color.iter().all(|color| color.is_black()), "{strategy:?}");
        }
    }
}
