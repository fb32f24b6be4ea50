//! Images with a closed form for every pixel.

use std::f64::consts::PI;
use std::sync::Arc;

use lobe::film::{BlackmanHarrisFilter, BoxFilter, Filter, GaussianFilter, TentFilter};
use lobe::glam::{DVec2, DVec3, UVec2, Vec3};
use lobe::image::Picture;
use lobe::integrator::{DirectIntegrator, Integrator, PathIntegrator};
use lobe::light::{DistantLight, LightStrategy, SkyLight};
use lobe::render::SamplerSettings;
use lobe::sampling::SamplerKind;
use lobe::scene::Emission;
use lobe::{
    FilmSettings, MatteMaterial, PerspectiveSettings, RenderSettings, Scene, Spectrum,
    TriangleMesh, View,
};

use crate::scenes::{Parabola, ball, floor, view};
use crate::statistics::{assert_mean, bands, picture};

const STRATEGIES: [LightStrategy; 4] =
    [LightStrategy::Auto, LightStrategy::Mis, LightStrategy::Light, LightStrategy::Bsdf];

fn independent(spp: u32, integrator: impl Integrator + 'static) -> RenderSettings {
    let kind = SamplerKind::INDEPENDENT;
    let sampler = SamplerSettings { kind, spp, seed: 3, ..SamplerSettings::default() };
    RenderSettings::new(sampler, integrator)
}

fn path(max_depth: u32, roulette: bool, strategy: LightStrategy) -> PathIntegrator {
    PathIntegrator { max_depth, roulette, strategy }
}

/// Looks down on the plane y = 0 from above: image right is +x, image up is +z.
fn from_above(height: f32, fov: f32) -> PerspectiveSettings {
    PerspectiveSettings {
        eye: Vec3::Y * height,
        look_at: Vec3::ZERO,
        up: Vec3::Z,
        fov,
        ..PerspectiveSettings::default()
    }
}

/// A plane under a distant light has L = R/π E cos θ in every pixel. Seen to fail without the
/// cosine.
#[test]
fn a_plane_under_a_distant_light() {
    let towards = Vec3::new(0.48, 0.6, 0.64);
    let picture = picture(
        Scene::builder()
            .material("plane", MatteMaterial::new([0.5, 0.25, 1.0]))
            .shape("plane", floor(0.0, 10.0), "plane")
            // Behind the plane, and in front of it, outside the view and away from the light.
            .shape("below", floor(-1.0, 10.0), "plane")
            .light(DistantLight::new(towards, Spectrum::splat(3.0)).unwrap()),
        &view(&from_above(2.0, 60.0), UVec2::splat(16)),
        &independent(4, DirectIntegrator::default()),
    );
    for (place, pixel) in picture.color.iter().enumerate() {
        for (band, r) in pixel.to_array().into_iter().zip([0.5, 0.25, 1.0]) {
            let expected = r / PI * 3.0 * 0.6;
            assert!((f64::from(band) / expected - 1.0).abs() < 1e-5, "{place}: {band}, {expected}");
        }
    }
}

/// A convex white body under a sky of radiance 1 is as bright as the sky, so it is invisible. Seen to
/// fail with the sky's pdf twice too large, and with paths that see the sky after `max_depth` reflections left out.
#[test]
fn a_white_body_is_invisible_under_the_sky() {
    for strategy in STRATEGIES {
        for max_depth in [1, 4] {
            let camera =
                PerspectiveSettings { eye: Vec3::Z * -3.0, ..PerspectiveSettings::default() };
            let picture = picture(
                Scene::builder()
                    .material("white", MatteMaterial::new([1.0, 1.0, 1.0]))
                    .shape("body", ball(16), "white")
                    .light(SkyLight::new(Spectrum::WHITE)),
                &view(&camera, UVec2::splat(32)),
                &independent(1024, path(max_depth, true, strategy)),
            );
            let what = format!("{strategy:?}, depth {max_depth}");
            assert_mean(&picture, 1.0, &what);
            if matches!(strategy, LightStrategy::Auto | LightStrategy::Bsdf) {
                for (place, (band, _)) in bands(&picture).into_iter().enumerate() {
                    assert!((band - 1.0).abs() < 2e-6, "{what}: {band} in band {place}");
                }
            }
        }
    }
}

/// Inside of a closed surface that emits E and reflects the share a, every point sees
/// E (1 + a + a² + ...) = E/(1 - a), cut off after the last reflection. A million samples and more. Seen to fail with
/// light of surfaces left out after the second reflection, with the area light's pdf off by 2, and with roulette that
/// does not make up for the paths it ends.
#[test]
fn a_furnace_adds_up_all_reflections() {
    let (e, a) = (0.5, 0.6);
    let all = STRATEGIES.map(|strategy| (strategy, 6, true));
    let auto = [(0, false), (1, false), (6, false), (60, true)];
    let auto = auto.map(|(depth, roulette)| (LightStrategy::Auto, depth, roulette));
    for (strategy, max_depth, roulette) in all.into_iter().chain(auto) {
        let emission = Emission { radiance: Spectrum::splat(e as f32), two_sided: true };
        let eye = Vec3::new(0.1, 0.2, -0.3);
        let camera = PerspectiveSettings { eye, ..PerspectiveSettings::default() };
        let picture = picture(
            Scene::builder().material("grey", MatteMaterial::new([a as f32; 3])).glowing_shape(
                "furnace",
                ball(12),
                "grey",
                emission,
            ),
            &view(&camera, UVec2::splat(32)),
            &independent(1024, path(max_depth, roulette, strategy)),
        );
        let reflections = i32::try_from(max_depth).unwrap() + 1;
        let expected = e * (1.0 - f64::powi(a, reflections)) / (1.0 - a);
        let what = format!("{strategy:?}, depth {max_depth}, roulette {roulette}");
        assert_mean(&picture, expected, &what);
    }
}

/// A lamp that fills the left half of the image, seen through each filter: a pixel's value is the fraction of its
/// filter to the left of the middle, here by the sum of a million values. Seen to fail with the filter left out.
#[test]
fn a_filter_blurs_an_edge() {
    let filters: [Arc<dyn Filter>; 5] = [
        Arc::new(BoxFilter),
        Arc::new(TentFilter::default()),
        Arc::new(GaussianFilter::default()),
        Arc::new(BlackmanHarrisFilter::default()),
        Arc::new(Parabola),
    ];
    for filter in filters {
        let half =
            TriangleMesh::parallelogram(Vec3::new(-9.0, -9.0, 1.0), Vec3::X * 9.0, Vec3::Y * 18.0);
        let emission = Emission { radiance: Spectrum::WHITE, two_sided: true };
        let camera = PerspectiveSettings { fov: 40.0, ..PerspectiveSettings::default() };
        let film = FilmSettings::new(8, 8).with_filter(filter.clone());
        let picture = picture(
            Scene::builder().lamp("half", half, emission),
            &View::perspective(&camera, film).unwrap(),
            &independent(1 << 14, path(0, false, LightStrategy::Auto)),
        );
        let steps = 1 << 20;
        let places = || (0..steps).map(|i| (f64::from(i) + 0.5) / f64::from(steps) * 6.0 - 3.0);
        let value = |x: f64| f64::from(filter.evaluate(DVec2::new(x, 0.0).as_vec2()));
        let all: f64 = places().map(value).sum();
        for (place, (band, variance)) in bands(&picture).into_iter().enumerate() {
            let middle = (place / 3 % 8) as f64 + 0.5;
            let left: f64 = places().filter(|x| middle + x < 4.0).map(value).sum();
            let off = (band - left / all).abs();
            assert!(
                off <= 5.0 * variance.sqrt() + 1e-5,
                "{filter:?}, pixel at {middle}: {band}, {}",
                left / all
            );
        }
    }
}

/// The irradiance that a polygon of radiance 1 gives a point with normal n, if all of it is above the horizon:
/// half the sum over its edges of the angle each fills times the cosine between n and the normal of
/// the plane through point and edge (Lambert 1760).
fn lambert(p: DVec3, n: DVec3, polygon: &[DVec3]) -> f64 {
    let edge = |i: usize| {
        let [a, b] = [polygon[i], polygon[(i + 1) % polygon.len()]].map(|v| (v - p).normalize());
        a.angle_between(b) * a.cross(b).normalize().dot(n)
    };
    ((0..polygon.len()).map(edge).sum::<f64>() / 2.0).abs()
}

fn under(lamp: TriangleMesh, strategy: LightStrategy, kind: SamplerKind) -> Picture {
    let emission = Emission { radiance: Spectrum::splat(5.0), two_sided: false };
    let scene = Scene::builder()
        .material("plane", MatteMaterial::new([0.8, 0.4, 0.2]))
        .shape("plane", floor(0.0, 10.0), "plane")
        .lamp("lamp", lamp, emission);
    let sampler = SamplerSettings { kind, spp: 16_384, seed: 11, replicates: 64 };
    let settings = RenderSettings::new(sampler, DirectIntegrator { strategy });
    picture(scene, &view(&from_above(0.9, 90.0), UVec2::splat(8)), &settings)
}

/// A diffuse plane under a polygon has R/π times Lambert's irradiance: a rectangle, which is sampled by solid angle,
/// and a triangle. A million samples each; the truth is a mean over 16 × 16 points of a pixel. Seen to
/// fail with a rectangle's pdf a tenth too large.
#[test]
fn a_plane_under_a_polygon() {
    let corners = [[-0.8, 1.0, 0.3], [0.7, 1.0, 0.3], [0.7, 1.0, 1.5], [-0.8, 1.0, 1.5]];
    let corners = corners.map(|c: [f32; 3]| Vec3::from(c));
    let mesh = |indices: Vec<[u32; 3]>| TriangleMesh {
        positions: corners.to_vec(),
        indices,
        ..TriangleMesh::default()
    };
    for (name, mesh, polygon) in [
        ("rectangle", mesh(vec![[0, 1, 2], [0, 2, 3]]), &corners[..]),
        ("triangle", mesh(vec![[0, 1, 2]]), &corners[..3]),
    ] {
        let polygon: Vec<DVec3> = polygon.iter().map(|c| c.as_dvec3()).collect();
        for (strategy, kind) in [
            (LightStrategy::Light, SamplerKind::INDEPENDENT),
            (LightStrategy::Bsdf, SamplerKind::INDEPENDENT),
            (LightStrategy::Mis, SamplerKind::SOBOL),
            (LightStrategy::Auto, SamplerKind::STRATIFIED),
        ] {
            let picture = under(mesh.clone(), strategy, kind);
            for (place, (band, variance)) in bands(&picture).into_iter().enumerate() {
                let (pixel, r) = (place / 3, [0.8, 0.4, 0.2][place % 3]);
                let pixel = UVec2::new(pixel as u32 % 8, pixel as u32 / 8).as_dvec2();
                let grid = (0..256).map(|i| {
                    let place =
                        pixel + DVec2::new((i % 16) as f64 + 0.5, (i / 16) as f64 + 0.5) / 16.0;
                    let along = (place / 4.0 - 1.0) * 0.9;
                    lambert(DVec3::new(along.x, 0.0, -along.y), DVec3::Y, &polygon)
                });
                let expected = 5.0 * r / PI * grid.sum::<f64>() / 256.0;
                let off = (band - expected).abs() / (variance.sqrt() + 2e-6 * expected);
                assert!(
                    off < 5.0,
                    "{name}, {strategy:?}, pixel {pixel}: {band}, expected {expected}"
                );
            }
        }
    }
}
