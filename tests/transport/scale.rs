//! The scale and the position of a scene do not matter.

use lobe::glam::{UVec2, Vec3};
use lobe::image::Picture;
use lobe::integrator::PathIntegrator;
use lobe::light::SkyLight;
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::Emission;
use lobe::{MatteMaterial, PointLight, RenderSettings, Scene, Spectrum, TriangleMesh};

use crate::scenes::{chapter_camera, floor, lumpy_ball, view};
use crate::statistics::{assert_alike, bands, picture};

/// Ball, floor and lights, each coordinate p mapped to scale · p + shift. Vertices lie on a grid of 2⁻⁹, so that
/// a shift by 1e4 rounds none of them: any difference comes from the renderer.
fn rendered(scale: f32, shift: f32, seed: u64) -> Picture {
    let place = |p: Vec3| p * scale + Vec3::splat(shift);
    let placed = |mut mesh: TriangleMesh| {
        mesh.positions.iter_mut().for_each(|p| *p = place((*p * 512.0).round() / 512.0));
        mesh
    };
    let lamp =
        TriangleMesh::parallelogram(Vec3::new(-1.0, 2.0, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0);
    let mut camera = chapter_camera();
    (camera.eye, camera.look_at) = (place(camera.eye), place(camera.look_at));
    let sampler = SamplerSettings { kind: SamplerKind::SOBOL, spp: 1024, seed, replicates: 64 };
    let scene = Scene::builder()
        .material("red", MatteMaterial::new([0.8, 0.1, 0.2]))
        .material("blue", MatteMaterial::new([0.2, 0.3, 0.9]))
        .shape("ball", placed(lumpy_ball(24)), "red")
        .shape("floor", placed(floor(-2.0, 6.0)), "blue")
        .lamp("lamp", placed(lamp), Emission { radiance: Spectrum::splat(6.0), two_sided: false })
        .light(SkyLight::new(Spectrum::splat(0.3)))
        .light(PointLight::new(
            place(Vec3::new(3.0, 4.0, -3.0)),
            Spectrum::splat(20.0 * scale * scale),
        ));
    let settings = RenderSettings::new(sampler, PathIntegrator::new(4));
    picture(scene, &view(&camera, UVec2::splat(24)), &settings)
}

/// Seen to fail with ray origins moved by 1e-3 more.
#[test]
fn scale_and_shift_change_nothing_but_noise() {
    let reference = bands(&rendered(1.0, 0.0, 1));
    for (seed, (scale, shift)) in
        (2..).zip([(1e-3, 0.0), (1e3, 0.0), (1.0, 1e4), (1e3, 1e4), (1024.0, -3e6)])
    {
        let other = bands(&rendered(scale, shift, seed));
        assert_alike(&reference, &other, &format!("scale {scale}, shift {shift}"));
    }
}
