//! Holes in surfaces: rays pass them, of all kinds, and lamps have none.

mod scenes;

use lobe::glam::{UVec2, Vec3};
use lobe::integrator::{DirectIntegrator, PathIntegrator};
use lobe::interaction::SurfaceInteraction;
use lobe::light::SkyLight;
use lobe::material::{DetailedMaterial, MixMaterial};
use lobe::scene::{Emission, SceneBuilder};
use lobe::{MatteMaterial, PointLight, RenderOptions, Scene, Spectrum, TriangleMesh, render};
use scenes::{ball_over_floor, chapter_view, floor_of, from_above, independent};

/// Strips side by side between the camera and the chapter's ball, some of them left out.
fn strips(keep: impl Fn(u32) -> bool) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for strip in (0..24).filter(|&strip| keep(strip)) {
        let corner = Vec3::new(-3.0 + 0.15 * strip as f32, -1.0, -1.0);
        let quad = TriangleMesh::parallelogram(corner, Vec3::X * 0.15, Vec3::Y * 3.0);
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(quad.positions);
        mesh.indices.extend(quad.indices.iter().map(|triangle| triangle.map(|i| first + i)));
    }
    mesh
}

/// A screen whose every other strip is a hole is one of the other strips, to the bit: for camera rays, for paths, for shadow rays to points and
/// to lamps, and for the layers. Seen to fail with shadow rays that holes stop, with only one hole passed, and with rays that start again
/// behind the hole.
#[test]
fn holes_are_not_there() {
    let lamp = TriangleMesh::parallelogram(Vec3::new(-3.0, 3.0, -3.0), Vec3::X, Vec3::Z);
    let emission = Emission { radiance: Spectrum::splat(20.0), two_sided: true };
    let scene = |mesh: TriangleMesh, opacity: fn(&SurfaceInteraction) -> f32| {
        let matte = MatteMaterial::new([0.8, 0.5, 0.3]);
        let paper = DetailedMaterial::new(matte).with_opacity(opacity);
        // A second screen just behind the first.
        let mut behind = mesh.clone();
        behind.positions.iter_mut().for_each(|p| p.z += 1e-3);
        ball_over_floor()
            .material("red", MatteMaterial::new([0.8, 0.1, 0.1]))
            .material("blue", MatteMaterial::new([0.1, 0.1, 0.8]))
            .material("paper", paper)
            .shape("screen", mesh, "paper")
            .shape("second", behind, "paper")
            .lamp("lamp", lamp.clone(), emission)
            .light(PointLight::new(Vec3::new(2.0, 6.0, -4.0), Spectrum::splat(50.0)))
            .light(SkyLight::new(Spectrum::splat(0.1)))
    };
    let every_other = |si: &SurfaceInteraction| (si.place().unwrap().triangle / 2 % 2) as f32;
    let settings = independent(16, PathIntegrator::new(4));
    let options = RenderOptions { layers: true, ..RenderOptions::default() };
    let view = chapter_view(UVec2::new(48, 32));
    let of = |scene: SceneBuilder| {
        let rendered = render(&scene.build().unwrap(), &view, &settings, &options).unwrap();
        (rendered.picture.color, rendered.picture.layers)
    };
    let holes = of(scene(strips(|_| true), every_other));
    let cut = of(scene(strips(|strip| strip % 2 == 1), |_| 1.0));
    let whole = of(scene(strips(|_| true), |_| 1.0));
    assert!(holes == cut);
    assert!(holes.0 != whole.0);
}

/// A screen of opacity 1/4 lets through 3/4 of the rays that see the sky, and of the light of a lamp that is a point: within five standard
/// errors. Seen to fail with the opacity of what passes, and with one decision for all rays through a pixel.
#[test]
fn thin_screens_let_a_part_of_the_rays_pass() {
    let screen =
        TriangleMesh::parallelogram(Vec3::new(-9.0, -1.0, -9.0), Vec3::X * 18.0, Vec3::Z * 18.0);
    let black = || {
        let matte = MatteMaterial::new([0.0; 3]);
        DetailedMaterial::new(matte).with_opacity(0.25)
    };
    let (count, share) = (16.0 * 16.0 * 64.0, 0.75_f64);
    let settings = independent(64, DirectIntegrator::default());
    let mean = |scene: SceneBuilder| {
        let scene = scene.build().unwrap();
        let rendered = render(&scene, &from_above(), &settings, &RenderOptions::default()).unwrap();
        let sum: f64 =
            rendered.picture.color.iter().map(|color| f64::from(color.to_array()[0])).sum();
        sum / 256.0
    };
    let sky = Scene::builder().material("black", black()).shape("screen", screen.clone(), "black");
    let seen = mean(sky.light(SkyLight::new(Spectrum::WHITE)));
    let error = (share * (1.0 - share) / count).sqrt();
    assert!((seen - share).abs() < 5.0 * error, "{seen}");
    // Light from above the camera falls through the screen, and is seen through it.
    let light = || PointLight::new(Vec3::Y * 3.0, Spectrum::splat(10.0));
    let lit = |scene: SceneBuilder| mean(scene.light(light()));
    let floor_alone = || floor_of(MatteMaterial::new([0.5; 3]));
    let open = lit(floor_alone());
    let below = floor_alone().material("black", black()).shape("screen", screen, "black");
    let through = lit(below) / open;
    let share = share * share;
    let error = (share * (1.0 - share) / count).sqrt();
    // The floor is not equally bright, which adds less than a tenth.
    assert!((through - share).abs() < 5.5 * error, "{through}");
}

/// Under a sky of 1 a part of a mixture that stops rays shows its reflectance, and the rest 1: also under details, with holes of their own or
/// without. Within five standard errors.
///
/// Caught: mixtures without holes, and with lobes by the amount alone.
#[test]
fn mixtures_have_the_holes_of_their_parts() {
    let screen =
        TriangleMesh::parallelogram(Vec3::new(-9.0, -1.0, -9.0), Vec3::X * 18.0, Vec3::Z * 18.0);
    let mixture = || {
        let thin = DetailedMaterial::new(MatteMaterial::new([0.8; 3])).with_opacity(0.25);
        MixMaterial::new(thin, MatteMaterial::new([0.3; 3]), |_: &SurfaceInteraction| 0.6)
    };
    let settings = independent(64, DirectIntegrator::default());
    let seen = |material: DetailedMaterial| {
        let scene = Scene::builder().material("m", material).shape("screen", screen.clone(), "m");
        let scene = scene.light(SkyLight::new(Spectrum::WHITE)).build().unwrap();
        let rendered = render(&scene, &from_above(), &settings, &RenderOptions::default()).unwrap();
        let color = rendered.picture.color.iter().map(|color| f64::from(color.to_array()[0]));
        color.sum::<f64>() / 256.0
    };
    let expected = 0.4 * (0.75 + 0.25 * 0.8) + 0.6 * 0.3;
    // Values are between 0 and 1.
    let error = 0.5 / (256.0_f64 * 64.0).sqrt();
    let found = seen(DetailedMaterial::new(mixture()));
    assert!((found - expected).abs() < 5.0 * error, "{found}, expected {expected}");
    let found = seen(DetailedMaterial::new(mixture()).with_opacity(0.5));
    assert!((found - 0.5 - 0.5 * expected).abs() < 5.0 * error, "{found}");
}

/// Lamps have no holes: their light is sampled everywhere on them. Seen to fail with holes in lamps.
#[test]
fn lamps_have_no_holes() {
    let of = |opacity: f32| {
        let matte = MatteMaterial::new([0.5; 3]);
        let paper = DetailedMaterial::new(matte).with_opacity(opacity);
        let lamp = TriangleMesh::parallelogram(Vec3::new(-0.5, -1.0, -0.5), Vec3::X, Vec3::Z);
        let emission = Emission { radiance: Spectrum::WHITE, two_sided: true };
        let scene = floor_of(MatteMaterial::new([0.5; 3]))
            .material("paper", paper)
            .glowing_shape("lamp", lamp, "paper", emission);
        let settings = independent(4, DirectIntegrator::default());
        let scene = scene.build().unwrap();
        render(&scene, &from_above(), &settings, &RenderOptions::default()).unwrap().picture.color
    };
    assert!(of(0.0) == of(1.0));
}
