//! Hits carry shape, triangle and barycentrics, so that emission, reflectance and textures may vary with them.

use std::f32::consts::FRAC_1_PI;

use lobe::bxdf::{Arena, Bsdf, LambertianReflection};
use lobe::geometry::Ray;
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::interaction::SurfaceInteraction;
use lobe::light::{Light, LightHit, LightSample, LightStrategy, SkyLight};
use lobe::material::Material;
use lobe::{PerspectiveSettings, RenderOptions, Scene, Spectrum, TriangleMesh, render};

use crate::scenes::{independent, view};

/// Four triangles in the plane z = 1, each a quarter of the picture's width: a fan.
fn strips() -> TriangleMesh {
    let column = |i: u32| -1.0 + 0.5 * i as f32;
    let mut mesh = TriangleMesh::default();
    for i in 0..4 {
        let first = mesh.positions.len() as u32;
        let [x0, x1] = [column(i), column(i + 1)];
        // Much taller than the picture, so that it fills its column.
        mesh.positions.extend([
            Vec3::new(x0, -1.0, 1.0),
            Vec3::new(x0, 9.0, 1.0),
            Vec3::new(x1, -1.0, 1.0),
            Vec3::new(x1, 9.0, 1.0),
        ]);
        mesh.uvs.extend([
            Vec2::new(x0, 0.0),
            Vec2::new(x0, 1.0),
            Vec2::new(x1, 0.0),
            Vec2::new(x1, 1.0),
        ]);
        mesh.indices.extend([[first, first + 1, first + 2], [first + 1, first + 3, first + 2]]);
    }
    mesh
}

/// The value that belongs to a triangle of a shape.
fn value(shape: u32, triangle: u32) -> f32 {
    0.1 * (1 + triangle / 2) as f32 + 0.05 * shape as f32
}

/// Emits by triangle, and is found by BSDF sampling only.
struct ByTriangle;

impl Light for ByTriangle {
    fn is_delta(&self) -> bool {
        false
    }
    fn sample_li(&self, _p: Vec3, _u: Vec2) -> Option<LightSample> {
        None
    }
    fn pdf_li(&self, _hit: &LightHit) -> f32 {
        0.0
    }
    fn le(&self, hit: &LightHit) -> Spectrum {
        let surface = hit.surface.expect("a hit on a surface");
        let place = surface.place().expect("a hit on a mesh");
        let at = place.b.iter().sum::<f32>();
        assert!(
            (at - 1.0).abs() < 1e-5
                && (hit.distance - (surface.p() - hit.origin).length()).abs() < 1e-5
        );
        Spectrum::new(value(place.shape, place.triangle), surface.uv().x + 2.0, 0.0)
    }
}

/// Reflects by triangle.
struct Painted;

impl Material for Painted {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let place = si.place().expect("a hit on a mesh");
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(LambertianReflection::new(Spectrum::splat(value(place.shape, place.triangle))));
        bsdf
    }
}

fn far_away() -> TriangleMesh {
    TriangleMesh::parallelogram(Vec3::new(0.0, 0.0, -90.0), Vec3::X, Vec3::Y)
}

/// The chapter's camera space: from the origin along +z, image right is +x.
fn pixels(scene: Scene, strategy: LightStrategy) -> Vec<[f32; 3]> {
    let integrator = PathIntegrator { max_depth: 1, roulette: false, strategy };
    let camera = PerspectiveSettings::default();
    let view = view(&camera, UVec2::splat(8));
    let rendered =
        render(&scene, &view, &independent(64, integrator), &RenderOptions::default()).unwrap();
    rendered.picture.color.iter().map(|color| color.to_array()).collect()
}

/// The light of a shape gets shape, triangle, barycentrics and texture coordinates of the hit.
/// Caught: the index of the shape left at 0; the triangle's index that of the tree.
#[test]
fn lights_get_the_point_that_was_hit() {
    for strategy in [LightStrategy::Auto, LightStrategy::Mis, LightStrategy::Bsdf] {
        let scene = Scene::builder()
            .material("white", lobe::MatteMaterial::new([0.5; 3]))
            .shape("far", far_away(), "white")
            .shape_with_light("strips", strips(), None, ByTriangle)
            .build()
            .unwrap();
        for (i, pixel) in pixels(scene, strategy).into_iter().enumerate() {
            let column = i as u32 % 8 / 2;
            let red = value(1, 2 * column);
            assert!((pixel[0] - red).abs() < 1e-5, "pixel {i}: {pixel:?}, {red}");
            // u is x, and the mean over a pixel lies within its quarter.
            let x = -1.0 + (i % 8) as f32 / 4.0;
            assert!((x..x + 0.25).contains(&(pixel[1] - 2.0)), "pixel {i}: {pixel:?}, {x}");
        }
    }
}

/// A material can vary by triangle.
/// Caught: as above.
#[test]
fn materials_can_differ_by_face() {
    let scene = Scene::builder()
        .material("painted", Painted)
        .shape("far", far_away(), "painted")
        .shape("strips", strips(), "painted")
        .light(SkyLight::new(Spectrum::WHITE))
        .build()
        .unwrap();
    let arena = Arena::new();
    for column in 0..4 {
        let ray =
            Ray::new(Vec3::ZERO, Vec3::new(-0.75 + 0.5 * column as f32, 0.1, 1.0).normalize());
        let hit = scene.accel().intersect1(&ray);
        let mut si = scene.interaction(&ray, &hit);
        let bsdf = scene.bsdf(&hit, &mut si, &arena);
        let f = bsdf.f(si.wo(), si.wo(), lobe::bxdf::BxdfFlags::all()).to_array()[0];
        let expected = value(1, 2 * column) * FRAC_1_PI;
        assert!((f - expected).abs() < 1e-6, "column {column}: {f}, expected {expected}");
    }
}
