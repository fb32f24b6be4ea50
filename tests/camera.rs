//! Cameras and views: where rays go, the handedness of world space, and that errors of custom cameras are reported.

mod scenes;

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use lobe::accel::InstructionSet;
use lobe::camera::{
    Camera, CameraError, CameraSamples, EquirectangularCamera, EquirectangularSettings, Handedness,
    OrthographicCamera, OrthographicSettings, PerspectiveCamera, PerspectiveSettings,
};
use lobe::film::{FilterError, TentFilter};
use lobe::geometry::Ray;
use lobe::glam::{DMat3, DVec3, UVec2, Vec2, Vec3};
use lobe::image::Window;
use lobe::integrator::{ChapterIntegrator, DirectIntegrator, Integrator, PathIntegrator};
use lobe::light::SkyLight;
use lobe::render::{Rendered, Sampling, render_with};
use lobe::sampling::SampleId;
use lobe::scene::{Emission, SceneBuilder, ViewError};
use lobe::{FilmSettings, PointLight, RenderOptions, Scene, Spectrum, TriangleMesh, View, render};
use scenes::{Middle, any, ball_over_floor, chapter_camera, floor, independent};

const RESOLUTION: UVec2 = UVec2::new(31, 20);

/// The ray through a point of the image in pixels, by a camera without a lens.
fn through(camera: &dyn Camera, x: f32, y: f32) -> Ray {
    let p = Vec2::new(x, y);
    camera.generate_ray(p.as_uvec2(), p - p.floor(), Vec2::ZERO)
}

fn orthographic(settings: OrthographicSettings) -> OrthographicCamera {
    OrthographicCamera::new(&settings, RESOLUTION).unwrap()
}

fn equirectangular(settings: EquirectangularSettings, resolution: UVec2) -> EquirectangularCamera {
    EquirectangularCamera::new(&settings, resolution).unwrap()
}

/// Rotated cameras of all kinds, with and without lenses.
fn cameras() -> [Arc<dyn Camera>; 5] {
    let (eye, look_at, up) = (Vec3::new(1.0, 2.0, -3.0), Vec3::new(0.2, -1.0, 4.0), Vec3::Y);
    let perspective = PerspectiveSettings { eye, look_at, up, fov: 40.0, ..Default::default() };
    let orthographic = OrthographicSettings { eye, look_at, up, ..Default::default() };
    let [lens_radius, focal_distance] = [0.3, 5.0];
    let with_lens = PerspectiveSettings { lens_radius, focal_distance, ..perspective };
    let flat_lens = OrthographicSettings { lens_radius, focal_distance, ..orthographic };
    let around = EquirectangularSettings { eye, look_at, up, ..Default::default() };
    [
        Arc::new(PerspectiveCamera::new(&perspective, RESOLUTION).unwrap()),
        Arc::new(PerspectiveCamera::new(&with_lens, RESOLUTION).unwrap()),
        Arc::new(OrthographicCamera::new(&orthographic, RESOLUTION).unwrap()),
        Arc::new(OrthographicCamera::new(&flat_lens, RESOLUTION).unwrap()),
        Arc::new(EquirectangularCamera::new(&around, RESOLUTION).unwrap()),
    ]
}

/// `generate_rays` gives the bits of `generate_ray`, for any number of rays and all instruction sets. Seen to fail with the
/// pixel of the first sample taken for all, and with the last rays of a block left out.
#[test]
fn blocks_of_rays_are_single_rays_to_the_bit() {
    for camera in cameras() {
        let what = camera.describe();
        for count in 0..40_u32 {
            let u = |step: f32| move |i: u32| (0.5 + step * i as f32).fract();
            let (x, y) = (u(0.754_877_7), u(0.569_840_3));
            // Beyond the pixel, as with a wide filter.
            let offsets: Vec<_> = (0..count).map(|i| 4.0 * Vec2::new(x(i), y(i)) - 1.5).collect();
            let lens: Vec<_> = (0..count).map(|i| Vec2::new(y(i), x(i))).collect();
            let pixel = UVec2::new(count % RESOLUTION.x, count % RESOLUTION.y);
            // Some of two pixels.
            let pixel = |i: u32| UVec2::new((pixel.x + i / 11) % RESOLUTION.x, pixel.y);
            let ids: Vec<_> =
                (0..count).map(|i| SampleId { pixel: pixel(i), set: 0, index: i }).collect();
            for set in InstructionSet::available() {
                let mut rays = vec![Ray::new(Vec3::NAN, Vec3::NAN); count as usize];
                camera.generate_rays(&CameraSamples::new(set, &ids, &offsets, &lens), &mut rays);
                for (i, ray) in rays.iter().enumerate() {
                    let single = camera.generate_ray(ids[i].pixel, offsets[i], lens[i]);
                    assert_eq!(*ray, single, "{what}, {set}: ray {i} of {count}");
                    assert!((single.d.length() - 1.0).abs() < 1e-6, "{what}: {single:?}");
                }
            }
        }
    }
}

/// A lens changes rays, and nothing else does.
#[test]
fn only_a_lens_uses_its_sample() {
    for camera in cameras() {
        let ray = |lens| camera.generate_ray(UVec2::ONE, Vec2::splat(0.5), lens);
        let same = ray(Vec2::splat(0.1)) == ray(Vec2::splat(0.8));
        assert_eq!(same, !camera.has_lens(), "{}", camera.describe());
    }
}

/// A lens far out of focus blurs an edge: the half of it that lies before a lamp sees the lamp, for each kind of camera
/// with a lens. Seen to fail with the samples of the lens left at zero.
#[test]
fn a_lens_is_sampled() {
    let lamp =
        TriangleMesh::parallelogram(Vec3::new(-9.0, -9.0, 2.0), Vec3::X * 9.0, Vec3::Y * 18.0);
    let emission = Emission { radiance: Spectrum::WHITE, two_sided: true };
    let scene = Scene::builder().lamp("left", lamp, emission).build().unwrap();
    let [lens_radius, focal_distance] = [0.5, 1e9];
    let perspective =
        PerspectiveSettings { fov: 1e-3, lens_radius, focal_distance, ..Default::default() };
    let flat =
        OrthographicSettings { extent: 1e-3, lens_radius, focal_distance, ..Default::default() };
    let cameras: [Arc<dyn Camera>; 2] = [
        Arc::new(PerspectiveCamera::new(&perspective, UVec2::ONE).unwrap()),
        Arc::new(OrthographicCamera::new(&flat, UVec2::ONE).unwrap()),
    ];
    for camera in cameras {
        let what = camera.describe();
        let view = View::new(camera, FilmSettings::new(1, 1)).unwrap();
        let settings = independent(4096, PathIntegrator::default());
        let rendered = render(&scene, &view, &settings, &RenderOptions::default()).unwrap();
        let [share, ..] = rendered.picture.color[0].to_array();
        // Five standard errors of a fair coin.
        assert!((share - 0.5).abs() < 5.0 * 0.5 / 64.0, "{what}: {share}");
    }
}

/// PBRT 3rd edition, section 6.2.1: parallel rays from a plane that the shorter side spans with `extent` units. Seen
/// to fail with the extent across the longer side, and with y upwards.
#[test]
fn orthographic_rays_are_parallel() {
    let eye = Vec3::new(5.0, 1.0, -2.0);
    let settings = OrthographicSettings { eye, look_at: eye + 7.0 * Vec3::Z, ..Default::default() };
    let camera = orthographic(OrthographicSettings { extent: 10.0, ..settings });
    for (x, y, right, up) in
        [(15.5, 10.0, 0.0, 0.0), (0.0, 0.0, -7.75, 5.0), (30.5, 19.5, 7.5, -4.75)]
    {
        let ray = through(&camera, x, y);
        assert_eq!(ray.d, Vec3::Z);
        assert_eq!(ray.o, eye + Vec3::new(right, up, 0.0), "at {x}, {y}");
    }
}

/// All rays of a film point meet in the plane in focus, straight ahead. Seen to fail with the lens point multiplied by
/// the distance in place of divided.
#[test]
fn orthographic_lens_focuses_at_its_distance() {
    let lens = OrthographicSettings { lens_radius: 0.5, focal_distance: 4.0, ..Default::default() };
    let camera = orthographic(lens);
    let sharp = orthographic(OrthographicSettings::default());
    for (x, y) in [(3.2, 7.5), (30.9, 0.1)] {
        let focus = through(&sharp, x, y).o + 4.0 * Vec3::Z;
        for lens in [Vec2::ZERO, Vec2::new(0.9, 0.2), Vec2::new(0.4, 0.99)] {
            let ray =
                camera.generate_ray(Vec2::new(x, y).as_uvec2(), Vec2::new(x, y).fract(), lens);
            assert!((ray.o - through(&sharp, x, y).o).length() <= 0.5 + 1e-6);
            let there = ray.o + ray.d * (4.0 / ray.d.z);
            assert!((there - focus).length() < 1e-6, "{there} instead of {focus}");
        }
    }
}

/// The same in perspective: where the ray of a pinhole meets the plane in focus. Seen to fail with the lens point multiplied
/// by the distance in place of divided.
#[test]
fn perspective_lens_focuses_at_its_distance() {
    let lens = PerspectiveSettings { lens_radius: 0.5, focal_distance: 4.0, ..Default::default() };
    let [camera, sharp] = [lens, PerspectiveSettings::default()]
        .map(|settings| PerspectiveCamera::new(&settings, RESOLUTION).unwrap());
    for (x, y) in [(3.2, 7.5), (30.9, 0.1)] {
        let p = Vec2::new(x, y);
        let focus = through(&sharp, x, y).d / through(&sharp, x, y).d.z * 4.0;
        for lens in [Vec2::ZERO, Vec2::new(0.9, 0.2), Vec2::new(0.4, 0.99)] {
            let ray = camera.generate_ray(p.as_uvec2(), p.fract(), lens);
            assert!(ray.o.z == 0.0 && ray.o.length() <= 0.5 + 1e-6, "{}", ray.o);
            let there = ray.o + ray.d * (4.0 / ray.d.z);
            assert!((there - focus).length() < 1e-5, "{there} instead of {focus}");
        }
    }
}

/// look_at in the middle, poles at the edges, backwards at the seam, right at three quarters. Seen to fail with the
/// azimuth from the left edge on, with left and right exchanged, and with θ from below.
#[test]
fn equirectangular_looks_where_it_says() {
    let eye = Vec3::new(1.0, -2.0, 3.0);
    let around = EquirectangularSettings { eye, look_at: eye + Vec3::X, ..Default::default() };
    // Left-handed: with x ahead and y up, -z is to the right.
    let camera = equirectangular(around, UVec2::new(64, 32));
    for (x, y, d) in [
        (32.0, 16.0, Vec3::X),
        (48.0, 16.0, Vec3::NEG_Z),
        (16.0, 16.0, Vec3::Z),
        (0.0, 16.0, Vec3::NEG_X),
        (64.0, 16.0, Vec3::NEG_X),
        (32.0, 0.0, Vec3::Y),
        (7.0, 0.0, Vec3::Y),
        (32.0, 32.0, Vec3::NEG_Y),
        (50.0, 32.0, Vec3::NEG_Y),
        (32.0, 8.0, Vec3::new(1.0, 1.0, 0.0).normalize()),
        // Beyond the pole, where a wide filter reaches, the other side comes down.
        (32.0, -8.0, Vec3::new(-1.0, 1.0, 0.0).normalize()),
    ] {
        let ray = camera.generate_ray(UVec2::ZERO, Vec2::new(x, y), Vec2::ZERO);
        assert_eq!(ray.o, eye);
        assert!((ray.d - d).length() < 1e-6, "at {x}, {y}: {} instead of {d}", ray.d);
    }
}

/// The two edges of the image are one meridian.
#[test]
fn equirectangular_has_no_seam() {
    let camera = equirectangular(EquirectangularSettings::default(), UVec2::new(64, 32));
    for row in 0..32 {
        let at = |x| camera.generate_ray(UVec2::new(0, row), Vec2::new(x, 0.3), Vec2::ZERO).d;
        for x in [-3.0, 0.0, 1e-6, 0.7] {
            assert!((at(x) - at(x + 64.0)).length() < 2e-6, "row {row}, {x}");
        }
    }
}

/// Pixel centres, each with the solid angle sin θ Δθ Δφ of its row, cover the sphere evenly: 4π in all, and in caps about
/// any axis what a cap has. Seen to fail with θ linear in cos θ.
#[test]
fn equirectangular_covers_the_sphere() {
    let look_at = Vec3::new(0.3, 0.4, -0.7);
    let (w, h) = (512, 256);
    let around = EquirectangularSettings { look_at, ..Default::default() };
    let camera = equirectangular(around, UVec2::new(w, h));
    let mut directions = Vec::new();
    let (mut total, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    for (row, column) in (0..h).flat_map(|row| (0..w).map(move |column| (row, column))) {
        let theta = (f64::from(row) + 0.5) * PI / f64::from(h);
        let weight = theta.sin() * PI / f64::from(h) * TAU / f64::from(w);
        let d = camera.generate_ray(UVec2::new(column, row), Vec2::splat(0.5), Vec2::ZERO).d;
        let d = d.as_dvec3();
        total += weight;
        first += weight * d;
        second += DMat3::from_cols(d * d.x, d * d.y, d * d.z) * weight;
        directions.push((d, weight));
    }
    assert!((total / (4.0 * PI) - 1.0).abs() < 1e-4, "{total}");
    assert!(first.length() < 1e-4, "{first}");
    let even = DMat3::IDENTITY * (4.0 * PI / 3.0);
    assert!((second - even).to_cols_array().iter().all(|x| x.abs() < 1e-3), "{second}");
    for axis in [DVec3::Y, DVec3::NEG_X, DVec3::new(0.6, -0.64, 0.48)] {
        for cos in [0.9, 0.3, -0.5] {
            let cap: f64 = directions.iter().filter(|(d, _)| d.dot(axis) > cos).map(|d| d.1).sum();
            let expected = TAU * (1.0 - cos);
            assert!((cap / expected - 1.0).abs() < 0.01, "{axis}, {cos}: {cap}, not {expected}");
        }
    }
}

/// Ball, floor and a lamp at a side, in a world whose z axis is mirrored or not.
fn world(mirrored: bool) -> SceneBuilder {
    let place = |p: Vec3| if mirrored { p * Vec3::new(1.0, 1.0, -1.0) } else { p };
    let placed = |mut mesh: TriangleMesh| {
        mesh.positions.iter_mut().for_each(|p| *p = place(*p));
        if mirrored {
            mesh.indices.iter_mut().for_each(|t| t.swap(0, 1));
        }
        mesh
    };
    let mut bar =
        TriangleMesh::parallelogram(Vec3::new(0.8, 0.5, -1.5), Vec3::X, Vec3::new(0.0, 1.0, 0.2));
    bar = placed(bar);
    Scene::builder()
        .material("red", lobe::MatteMaterial::new([0.8, 0.1, 0.2]))
        .shape("ball", placed(scenes::lumpy_ball(24)), "red")
        .shape("floor", placed(floor(-2.0, 6.0)), "red")
        .shape("bar", bar, "red")
        .light(PointLight::new(place(Vec3::new(10.0, 10.0, -10.0)), Spectrum::splat(900.0)))
}

/// One sample in the middle of each pixel.
fn picture(scene: &Scene, camera: impl Camera + 'static) -> Vec<Spectrum> {
    let view = View::new(camera, FilmSettings::new(RESOLUTION.x, RESOLUTION.y)).unwrap();
    let integrator = DirectIntegrator::default();
    let sampling = Sampling::new(&Middle, 1);
    let rendered = render_with(scene, &view, &integrator, sampling, &RenderOptions::default());
    rendered.unwrap().picture.color
}

/// The same camera settings of each kind.
fn cameras_at(eye: Vec3, look_at: Vec3, handedness: Handedness) -> [Arc<dyn Camera>; 3] {
    let up = Vec3::Y;
    let perspective =
        PerspectiveSettings { eye, look_at, up, handedness, ..PerspectiveSettings::default() };
    let extent = 5.0;
    let flat = OrthographicSettings { eye, look_at, up, handedness, extent, ..Default::default() };
    let around = EquirectangularSettings { eye, look_at, up, handedness };
    [
        Arc::new(PerspectiveCamera::new(&perspective, RESOLUTION).unwrap()),
        Arc::new(orthographic(flat)),
        Arc::new(equirectangular(around, RESOLUTION)),
    ]
}

/// A right-handed world, which is a left-handed one with z mirrored, looks right through a right-handed camera: the
/// same picture as that of the left-handed world. Seen to fail with up flipped along with right.
#[test]
fn a_mirrored_world_looks_the_same_in_the_other_hand() {
    let (left, right) = (world(false).build().unwrap(), world(true).build().unwrap());
    let eye = chapter_camera().eye;
    let of_left = cameras_at(eye, Vec3::ZERO, Handedness::Left);
    let of_right = cameras_at(eye * Vec3::new(1.0, 1.0, -1.0), Vec3::ZERO, Handedness::Right);
    for (a, b) in of_left.into_iter().zip(of_right) {
        let what = b.describe();
        assert!(what.ends_with(", right-handed"), "{what}");
        let (a, b) = (picture(&left, a), picture(&right, b));
        assert!(a.iter().any(|color| !color.is_black()), "{what}");
        for (place, (a, b)) in a.iter().zip(&b).enumerate() {
            for (a, b) in a.to_array().iter().zip(b.to_array()) {
                assert!((a - b).abs() <= 1e-5 * a.abs(), "{what}, pixel {place}: {a}, {b}");
            }
        }
    }
}

/// In one world, the cameras of the two kinds give pictures that are mirrored, to the bit: text that can be read in one
/// cannot in the other. Seen to fail with handedness left out.
#[test]
fn the_other_hand_mirrors_the_picture() {
    let scene = world(false).build().unwrap();
    let eye = chapter_camera().eye;
    let [left, right] =
        [Handedness::Left, Handedness::Right].map(|hand| cameras_at(eye, Vec3::ZERO, hand));
    for (left, right) in left.into_iter().zip(right) {
        let what = left.describe();
        let (left, right) = (picture(&scene, left), picture(&scene, right));
        assert!(left != right, "{what}: the picture is symmetric");
        let width = RESOLUTION.x as usize;
        for (row, other) in left.chunks(width).zip(right.chunks(width)) {
            assert!(row.iter().eq(other.iter().rev()), "{what}");
        }
    }
}

/// One scene rendered in two views gives the same as two scenes.
#[test]
fn one_scene_renders_many_views() {
    let render = |scene: &Scene, view: &View| {
        let settings = independent(4, DirectIntegrator::default());
        render(scene, view, &settings, &RenderOptions::default()).unwrap().picture
    };
    let views = cameras()
        .map(|camera| View::new(camera, FilmSettings::new(RESOLUTION.x, RESOLUTION.y)).unwrap());
    let scene = world(false).build().unwrap();
    for view in &views {
        assert_eq!(render(&scene, view), render(&world(false).build().unwrap(), view));
    }
}

/// A camera that makes some rays of another one invalid.
struct Spoiled<F>(PerspectiveCamera, F);

impl<F: Fn(UVec2, &mut Ray) + Send + Sync> Camera for Spoiled<F> {
    fn resolution(&self) -> UVec2 {
        self.0.resolution()
    }
    fn has_lens(&self) -> bool {
        false
    }
    fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens: Vec2) -> Ray {
        let mut ray = self.0.generate_ray(pixel, offset, lens);
        (self.1)(pixel, &mut ray);
        ray
    }
}

fn spoiled(
    integrator: impl Integrator + 'static,
    spoil: impl Fn(UVec2, &mut Ray) + Send + Sync + 'static,
) -> Rendered {
    let camera = PerspectiveCamera::new(&chapter_camera(), UVec2::splat(16)).unwrap();
    let view = View::new(Spoiled(camera, spoil), FilmSettings::new(16, 16)).unwrap();
    let scene = ball_over_floor().light(SkyLight::new(Spectrum::WHITE)).build().unwrap();
    let options = RenderOptions { layers: true, ..RenderOptions::default() };
    render(&scene, &view, &independent(4, integrator), &options).unwrap()
}

/// Rays that cannot be traced are counted, and their samples are in no pixel. Seen to fail with each condition left
/// out, and with refused rays taken for misses, which see the sky.
#[test]
fn rays_that_are_none_are_refused_and_counted() {
    let spoils: [fn(&mut Ray); 9] = [
        |ray| ray.d = Vec3::NAN,
        |ray| ray.d.y = f32::INFINITY,
        |ray| ray.d = Vec3::ZERO,
        |ray| ray.o.x = f32::NAN,
        |ray| ray.o.z = f32::NEG_INFINITY,
        |ray| ray.o.y = 2e12,
        |ray| ray.t_max = f32::NAN,
        |ray| ray.t_min = f32::NAN,
        |ray| *ray = Ray::new(Vec3::NAN, Vec3::NAN),
    ];
    let chapter = ChapterIntegrator { highlight: true };
    for integrator in [any(PathIntegrator::new(2)), any(DirectIntegrator::default()), any(chapter)]
    {
        let sound = spoiled(integrator.clone(), |_, _| {});
        assert_eq!((sound.counters.refused_camera_rays, sound.non_finite), (0, 0));
        for (number, spoil) in spoils.into_iter().enumerate() {
            let what = format!("{integrator:?}, spoil {number}");
            let rendered = spoiled(integrator.clone(), move |pixel, ray| {
                if pixel.x % 2 == 1 {
                    spoil(ray);
                }
            });
            let refused = 4 * 16 * 8;
            assert_eq!(rendered.counters.refused_camera_rays, refused, "{what}");
            assert_eq!(rendered.non_finite, refused, "{what}");
            assert_eq!(rendered.counters.camera_rays, 2 * refused, "{what}");
            let samples = rendered.picture.layers.unwrap().samples;
            for (place, color) in rendered.picture.color.iter().enumerate() {
                let is_refused = place % 2 == 1;
                assert_eq!(samples[place], if is_refused { 0 } else { 4 }, "{what}");
                let expected =
                    if is_refused { Spectrum::BLACK } else { sound.picture.color[place] };
                assert_eq!(*color, expected, "{what}, pixel {place}");
            }
        }
    }
}

/// Ray directions of any length give the same as unit directions, including depth and range. Seen to fail without
/// the normalization, and with t_max left as it was.
#[test]
fn directions_need_no_unit_length() {
    let integrator = PathIntegrator::new(2);
    // Beyond the ball, before the far end of the floor.
    let clipped = |ray: &mut Ray| (ray.t_min, ray.t_max) = (2.9, 6.0);
    let sound = spoiled(integrator, move |_, ray| clipped(ray)).picture;
    let depth = sound.layers.unwrap().depth;
    assert!(depth.contains(&0.0) && depth.iter().any(|depth| *depth > 2.9));
    for scale in [1e-20_f32, 1e-3, 1.1, 2e5, 1e30] {
        let rendered = spoiled(integrator, move |_, ray| {
            clipped(ray);
            ray.d *= scale;
            ray.t_min /= scale;
            ray.t_max /= scale;
        });
        assert_eq!(rendered.counters.refused_camera_rays, 0);
        let found = rendered.picture.layers.unwrap().depth;
        for (place, (found, depth)) in found.iter().zip(&depth).enumerate() {
            let error = (found - depth).abs();
            assert!(error <= 1e-5 * depth, "scale {scale}, pixel {place}: {found}, not {depth}");
        }
    }
}

/// Errors of views, with their messages.
#[test]
fn views_that_cannot_be() {
    let camera = || PerspectiveCamera::new(&chapter_camera(), UVec2::new(8, 6)).unwrap();
    let film = || FilmSettings::new(8, 6);
    let error = |film| View::new(camera(), film).err().unwrap();
    let other = error(FilmSettings::new(8, 7));
    assert_eq!(
        other.to_string(),
        "the camera is for an image of 8 x 6 pixels, but the film has 8 x 7"
    );
    assert_eq!(error(FilmSettings::new(0, 6)), ViewError::Camera(CameraError::Resolution(0, 6)));
    let window = Window { min: UVec2::new(3, 3), max: UVec2::new(9, 4) };
    assert_eq!(
        error(FilmSettings { crop: Some(window), ..film() }).to_string(),
        "the film's crop [3, 3, 9, 4] is empty or reaches beyond its resolution of 8 x 6"
    );
    let film_without_width = film().with_filter(TentFilter { radius: 0.0 });
    assert_eq!(error(film_without_width), ViewError::Filter(FilterError::Radius(0.0)));
    assert!(View::new(camera(), film()).is_ok());
}

/// Errors of the camera kinds. Seen to fail with the extent, the longer side, up or an infinite focal distance unchecked.
#[test]
fn cameras_that_cannot_be() {
    let flat = OrthographicSettings::default();
    let error = |settings| OrthographicCamera::new(&settings, RESOLUTION).err().unwrap();
    let extent = |extent| error(OrthographicSettings { extent, ..flat });
    for wrong in [0.0, -1.0, f32::NAN, f32::INFINITY, 1.1e12] {
        let message =
            format!("the camera's extent is {wrong}: it has to be above 0 and at most 1e12");
        assert_eq!(extent(wrong).to_string(), message);
    }
    let of = |extent, resolution| {
        OrthographicCamera::new(&OrthographicSettings { extent, ..flat }, resolution)
    };
    assert!(of(1e12, UVec2::splat(7)).is_ok());
    assert!(of(2.5e11, UVec2::new(1, 4)).is_ok());
    assert_eq!(
        of(5e11, UVec2::new(1, 4)).err().unwrap().to_string(),
        "the camera's extent is 500000000000, which makes the longer side of the image 2e12: \
         that can be at most 1e12"
    );
    for wrong in [-1.0, f32::NAN, f32::INFINITY, 1.1e12] {
        assert_eq!(
            error(OrthographicSettings { lens_radius: wrong, ..flat }).to_string(),
            format!("the camera's lens_radius is {wrong}: it has to be from 0 to 1e12")
        );
    }
    for wrong in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(
            error(OrthographicSettings { focal_distance: wrong, ..flat }).to_string(),
            format!("the camera's focal_distance is {wrong}: it has to be finite and above 0")
        );
    }
    assert_eq!(
        OrthographicCamera::new(&flat, UVec2::new(0, 4)).err(),
        Some(CameraError::Resolution(0, 4))
    );
    let around = EquirectangularSettings::default();
    for (settings, expected) in [
        (EquirectangularSettings { eye: Vec3::Z, ..around }, CameraError::NoDirection),
        (EquirectangularSettings { up: Vec3::Z, ..around }, CameraError::NoUp),
        (
            EquirectangularSettings { look_at: Vec3::X * 2e12, ..around },
            CameraError::OutOfRange("look_at", Vec3::X * 2e12),
        ),
    ] {
        assert_eq!(EquirectangularCamera::new(&settings, RESOLUTION).err(), Some(expected));
    }
    for (settings, message) in [
        (
            EquirectangularSettings { eye: Vec3::new(0.0, f32::NAN, 1.0), ..around },
            "the camera's eye is [0, NaN, 1]: each coordinate has to be from -1e12 to 1e12",
        ),
        (
            EquirectangularSettings { up: Vec3::new(0.0, f32::INFINITY, 1.0), ..around },
            "the camera's up is [0, inf, 1]: it has to be finite",
        ),
    ] {
        let error = EquirectangularCamera::new(&settings, RESOLUTION).err().unwrap();
        assert_eq!(error.to_string(), message);
    }
    for fov in [0.0, 180.0, f32::NAN, f32::INFINITY] {
        let perspective = PerspectiveSettings { fov, ..PerspectiveSettings::default() };
        assert_eq!(
            PerspectiveCamera::new(&perspective, RESOLUTION).err().unwrap().to_string(),
            format!("the camera's fov is {fov} degrees: it has to be above 0 and below 180")
        );
    }
}
