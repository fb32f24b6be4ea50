//! The chapter's estimator against its formula: on the floor, the colour of each pixel is
//! 3 cos θ Kd / π², with the cosine to the light, times the Blinn-Phong factor when asked for.

mod scenes;

use std::f64::consts::PI;

use lobe::glam::{DVec3, UVec2, Vec3};
use lobe::integrator::ChapterIntegrator;
use lobe::render::{Sampling, render_with};
use lobe::{
    MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, Scene, Spectrum, TriangleMesh,
};
use scenes::{Middle, chapter_camera, floor, view};

const LIGHT: DVec3 = DVec3::new(10.0, 10.0, -10.0);
const KD: [f64; 3] = [0.2, 0.3, 0.9];
const RESOLUTION: UVec2 = UVec2::new(100, 80);

/// The picture of one mesh with the floor's colour, one ray through the middle of each pixel.
fn picture(
    mesh: TriangleMesh,
    camera: PerspectiveSettings,
    light: DVec3,
    highlight: bool,
) -> Vec<Spectrum> {
    let scene = Scene::builder()
        .material("blue", MatteMaterial::new(KD.map(|k| k as f32)))
        .shape("floor", mesh, "blue")
        .light(PointLight::new(light.as_vec3(), Spectrum::splat(900.0)))
        .build()
        .unwrap();
    let integrator = ChapterIntegrator { highlight };
    let (view, sampling) = (view(&camera, RESOLUTION), Sampling::new(&Middle, 1));
    let rendered = render_with(&scene, &view, &integrator, sampling, &RenderOptions::default());
    rendered.unwrap().picture.color
}

/// Where the ray through the middle of a pixel hits the plane y = -2, by the definition of PBRT's
/// camera in f64: x to the right of the image is up × view, and 90 degrees span the shorter side.
fn on_floor(camera: &PerspectiveSettings, column: u32, row: u32) -> Option<(DVec3, DVec3)> {
    let [eye, look_at, up] = [camera.eye, camera.look_at, camera.up].map(DVec3::from);
    let view = (look_at - eye).normalize();
    let right = up.cross(view).normalize();
    let up = view.cross(right);
    let shorter = f64::from(RESOLUTION.min_element()) / 2.0;
    let x = (f64::from(column) + 0.5 - f64::from(RESOLUTION.x) / 2.0) / shorter;
    let y = (f64::from(RESOLUTION.y) / 2.0 - f64::from(row) - 0.5) / shorter;
    let d = (view + right * x + up * y).normalize();
    let t = (-2.0 - eye.y) / d.y;
    let p = eye + t * d;
    (t > 0.0 && p.x.abs() < 6.0 && p.z.abs() < 6.0).then_some((p, d))
}

/// Compares every pixel with the formula times `factor(d, wi)`, to a relative error of `tolerance`, and
/// makes sure that the floor is in the picture.
fn compare(
    color: &[Spectrum],
    camera: &PerspectiveSettings,
    light: DVec3,
    tolerance: f64,
    factor: impl Fn(DVec3, DVec3) -> f64,
) {
    let mut seen = 0;
    for (place, found) in color.iter().enumerate() {
        let (column, row) = (place as u32 % RESOLUTION.x, place as u32 / RESOLUTION.x);
        let expected = on_floor(camera, column, row).map_or([0.0; 3], |(p, d)| {
            seen += 1;
            let wi = (light - p).normalize();
            KD.map(|k| 3.0 * wi.y.abs() * k / (PI * PI) * factor(d, wi))
        });
        for (found, expected) in found.to_array().iter().zip(expected) {
            let error = (f64::from(*found) - expected).abs();
            assert!(
                error <= tolerance * expected,
                "pixel ({column}, {row}): {found}, not {expected}"
            );
        }
    }
    assert!(seen > 2000, "only {seen} pixels show the floor");
}

/// f32 keeps about six digits through a dozen operations.
const TOLERANCE: f64 = 3e-6;

/// Seen to fail with BRIGHTNESS 3.1 and with the camera's right and left exchanged.
#[test]
fn floor_is_three_cos_kd_over_pi_squared() {
    let camera = chapter_camera();
    let color = picture(floor(-2.0, 6.0), camera, LIGHT, false);
    compare(&color, &camera, LIGHT, TOLERANCE, |_, _| 1.0);
}

/// The other side of the floor, with the light there too, follows the same formula. Seen to fail when
/// `cosine_hemisphere::pdf` gets the signed cosine.
#[test]
fn floor_has_two_sides() {
    let light = DVec3::new(10.0, -14.0, -10.0);
    let camera = PerspectiveSettings { eye: Vec3::new(-3.0, -5.5, -3.0), ..chapter_camera() };
    let color = picture(floor(-2.0, 6.0), camera, light, false);
    compare(&color, &camera, light, TOLERANCE, |_, _| 1.0);
}

/// The winding of the floor decides where its normal points, and must not matter: the viewer and the
/// light are on one side. Seen to fail when the highlight takes the normal as it is.
#[test]
fn floor_may_be_wound_either_way() {
    let mut turned = floor(-2.0, 6.0);
    turned.indices.iter_mut().for_each(|t| t.swap(0, 1));
    let camera = chapter_camera();
    let color = picture(turned.clone(), camera, LIGHT, false);
    compare(&color, &camera, LIGHT, TOLERANCE, |_, _| 1.0);
    let color = picture(turned, camera, LIGHT, true);
    compare(&color, &camera, LIGHT, 32.0 * TOLERANCE, blinn_phong);
}

/// From below, viewer and light are on different sides of the floor, and it reflects nothing. Seen to
/// fail when `Bsdf::side` and the default pdf take everything for reflection.
#[test]
fn floor_is_black_from_the_side_away_from_the_light() {
    let below = PerspectiveSettings { eye: Vec3::new(0.0, -5.0, -1.0), ..chapter_camera() };
    assert!(on_floor(&below, 50, 40).is_some(), "the camera does not see the floor");
    let color = picture(floor(-2.0, 6.0), below, LIGHT, false);
    assert!(color.iter().all(|c| c.is_black()));
}

/// Section 6.2, on a surface with the normal +y.
fn blinn_phong(d: DVec3, wi: DVec3) -> f64 {
    let specular = (wi - d).normalize().y.max(0.0).powi(32);
    1.5 * (0.2 + 0.2 * wi.y.max(0.0) + 0.7 * specular)
}

/// The 32nd power multiplies a relative error by 32. Seen to fail with the exponent 31.
#[test]
fn highlight_is_the_blinn_phong_factor() {
    let camera = chapter_camera();
    let color = picture(floor(-2.0, 6.0), camera, LIGHT, true);
    compare(&color, &camera, LIGHT, 32.0 * TOLERANCE, blinn_phong);
}

/// What lobes get wrong is counted here too. Caught: the count left out.
#[test]
fn invalid_reflectances_are_counted() {
    let scene = Scene::builder()
        .material("broken", MatteMaterial::new([f32::INFINITY; 3]))
        .shape("floor", floor(-2.0, 6.0), "broken")
        .light(PointLight::new(LIGHT.as_vec3(), Spectrum::WHITE))
        .build()
        .unwrap();
    let (view, sampling) = (view(&chapter_camera(), RESOLUTION), Sampling::new(&Middle, 1));
    let options = RenderOptions::default();
    let integrator = ChapterIntegrator::default();
    let rendered = render_with(&scene, &view, &integrator, sampling, &options).unwrap();
    assert!(rendered.counters.rejected > 1000);
    assert!(rendered.picture.color.iter().all(|color| color.is_black()));
}
