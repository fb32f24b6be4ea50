//! Direct light against closed forms: a matte plane under a point light has the radiance
//! L = R/π · I · cos θ / d² in every pixel.

mod scenes;

use std::f64::consts::PI;

use lobe::glam::{DVec3, UVec2, Vec3};
use lobe::integrator::DirectIntegrator;
use lobe::light::{LightStrategy, SkyLight};
use lobe::render::{Sampling, render_with};
use lobe::scene::Emission;
use lobe::{
    MatteMaterial, PerspectiveSettings, PointLight, RenderOptions, Scene, Spectrum, TriangleMesh,
    render,
};
use scenes::{Middle, ball_over_floor, chapter_view, floor, independent, view};

const R: [f64; 3] = [0.6, 0.3, 0.9];
const I: f64 = 50.0;
const SIZE: u32 = 65;

/// The radiance at the middle of each pixel of a plane y = 0 of half width 4, seen from above from
/// (0, 3, 0) with a light at (1, 2, 0.5). Everything is scaled by `scale` and then moved by `shift`.
fn plane(scale: f32, shift: Vec3, blocker: Option<TriangleMesh>) -> Vec<Spectrum> {
    let place = |p: Vec3| p * scale + shift;
    let camera = PerspectiveSettings {
        eye: place(Vec3::new(0.0, 3.0, 0.0)),
        look_at: place(Vec3::ZERO),
        up: Vec3::Z,
        ..PerspectiveSettings::default()
    };
    let moved = |mut mesh: TriangleMesh| {
        mesh.positions.iter_mut().for_each(|p| *p = place(*p));
        mesh
    };
    let intensity = I as f32 * scale * scale;
    let mut builder = Scene::builder()
        .material("plane", MatteMaterial::new(R.map(|r| r as f32)))
        .shape("plane", moved(floor(0.0, 4.0)), "plane")
        .light(PointLight::new(place(Vec3::new(1.0, 2.0, 0.5)), Spectrum::splat(intensity)));
    if let Some(mesh) = blocker {
        builder = builder.shape("blocker", moved(mesh), "plane");
    }
    let scene = builder.build().unwrap();
    render_with(
        &scene,
        &view(&camera, UVec2::splat(SIZE)),
        &DirectIntegrator::default(),
        Sampling::new(&Middle, 1),
        &RenderOptions::default(),
    )
    .unwrap()
    .picture
    .color
}

/// The point of the plane in the middle of a pixel. From above with up = +z, the image's right is
/// +z × -y = +x.
fn point(column: u32, row: u32) -> DVec3 {
    let half = f64::from(SIZE) / 2.0;
    let along = |pixel: u32| 3.0 * (f64::from(pixel) + 0.5 - half) / half;
    DVec3::new(along(column), 0.0, -along(row))
}

/// L = R/π · I · cos θ / d².
fn radiance(p: DVec3) -> [f64; 3] {
    let to_light = DVec3::new(1.0, 2.0, 0.5) - p;
    let cos_theta = to_light.y / to_light.length();
    R.map(|r| r / PI * I * cos_theta / to_light.length_squared())
}

/// The largest relative difference from the closed form.
fn largest_error(color: &[Spectrum]) -> f64 {
    let mut largest: f64 = 0.0;
    for (place, found) in color.iter().enumerate() {
        let expected = radiance(point(place as u32 % SIZE, place as u32 / SIZE));
        for (found, expected) in found.to_array().iter().zip(expected) {
            largest = largest.max((f64::from(*found) / expected - 1.0).abs());
        }
    }
    largest
}

/// Seen to fail with 1/d in place of 1/d², and with the cosine left out.
#[test]
fn plane_under_a_point_light_is_the_closed_form() {
    let error = largest_error(&plane(1.0, Vec3::ZERO, None));
    assert!(error < 3e-6, "relative error {error}");
}

/// The same at other scales: nothing in the crate depends on the unit of length. Seen to fail with 1e-4
/// added to the squared distance.
#[test]
fn plane_under_a_point_light_keeps_its_look_at_any_scale() {
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        let error = largest_error(&plane(scale, Vec3::ZERO, None));
        assert!(error < 3e-6, "scale {scale}: relative error {error}");
    }
}

/// Far from the origin, coordinates have fewer digits. At 10⁴ floats are 2⁻¹⁰ apart, which may be the error of
/// a distance of about 1, and the closed form falls with its square.
#[test]
fn plane_under_a_point_light_keeps_its_look_far_from_the_origin() {
    let error = largest_error(&plane(1.0, Vec3::new(1e4, -1e4, 1e4), None));
    assert!(error < 8.0 / 1024.0, "relative error {error}");
}

/// A strip between light and plane casts a shadow with straight edges. Inside it the plane is exactly
/// black, outside it follows the closed form, at any scale. Seen to fail with shadow rays that end halfway,
/// and with ray origins moved by 1e-4.
#[test]
fn shadow_is_where_the_blocker_says() {
    let (left, right, height) = (-0.4, 0.0, 1.0);
    let corner = |x: f64, z| Vec3::new(x as f32, height as f32, z);
    let strip = TriangleMesh {
        positions: vec![
            corner(left, -9.0),
            corner(right, -9.0),
            corner(left, 9.0),
            corner(right, 9.0),
        ],
        indices: vec![[0, 2, 1], [1, 2, 3]],
        ..TriangleMesh::default()
    };
    for scale in [1e-6, 1.0, 1e6] {
        let color = plane(scale, Vec3::ZERO, Some(strip.clone()));
        // Seen from the camera at (0, 3) and from the light at (1, 2), the strip covers these x of the plane.
        let behind = |x: f64| x * 3.0 / (3.0 - height);
        let below = |x: f64| 1.0 + (x - 1.0) * 2.0 / (2.0 - height);
        let (mut lit, mut dark) = (0, 0);
        for (place, found) in color.iter().enumerate() {
            let p = point(place as u32 % SIZE, place as u32 / SIZE);
            if p.x > behind(left) - 1e-4 && p.x < behind(right) + 1e-4 {
                continue;
            }
            if p.x > below(left) && p.x < below(right) {
                dark += 1;
                assert!(found.is_black(), "scale {scale}: lit at {p}");
            } else {
                lit += 1;
                let error = (f64::from(found.to_array()[0]) / radiance(p)[0] - 1.0).abs();
                assert!(error < 3e-6, "scale {scale}: relative error {error} at {p}");
            }
        }
        assert!(lit > 2000 && dark > 500, "{lit} lit and {dark} dark pixels");
    }
}

/// Light adds up: two lights together give the sum of both alone. Seen to fail with the second light
/// left out.
#[test]
fn two_lights_add_up() {
    let lights = [Vec3::new(10.0, 10.0, -10.0), Vec3::new(-8.0, 6.0, -2.0)];
    let with = |lights: &[Vec3]| {
        let mut builder = ball_over_floor();
        for &position in lights {
            builder = builder.light(PointLight::new(position, Spectrum::splat(300.0)));
        }
        let view = chapter_view(UVec2::new(40, 30));
        let settings = independent(64, DirectIntegrator::default());
        render(&builder.build().unwrap(), &view, &settings, &RenderOptions::default()).unwrap()
    };
    let (first, second, both) = (with(&lights[..1]), with(&lights[1..]), with(&lights));
    assert_eq!(both.non_finite, 0);
    assert_eq!(both.counters.rejected, 0);
    for (place, found) in both.picture.color.iter().enumerate() {
        let sum = first.picture.color[place] + second.picture.color[place];
        let difference = (*found - sum).to_array().map(f32::abs);
        assert!(
            difference.iter().all(|d| *d < 1e-5),
            "pixel {place}: {found:?} instead of {sum:?}"
        );
    }
}

/// A ray that cannot contribute is not traced: with strategy `light`, a matte surface sends none to lamps and sky. Caught:
/// last rays that are traced for nothing.
#[test]
fn light_sampling_alone_traces_no_scattered_rays() {
    let emission = Emission { radiance: Spectrum::WHITE, two_sided: true };
    let scene = ball_over_floor()
        .lamp("lamp", floor(3.0, 1.0), emission)
        .light(SkyLight::new(Spectrum::WHITE))
        .build()
        .unwrap();
    let scattered = |strategy| {
        let settings = independent(4, DirectIntegrator { strategy });
        let view = chapter_view(UVec2::splat(16));
        let counters =
            render(&scene, &view, &settings, &RenderOptions::default()).unwrap().counters;
        assert!(counters.shadow_rays > 0);
        counters.scattered_rays
    };
    assert!(scattered(LightStrategy::Mis) > 0);
    assert_eq!(scattered(LightStrategy::Light), 0);
}
