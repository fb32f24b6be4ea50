//! A custom material of two lobes: a Phong lobe over a diffuse base, on a torus.
//!
//! `cargo run --release --example custom_material [FILE.png]`

mod torus;

use std::f32::consts::{PI, TAU};
use std::path::Path;

use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags, BxdfSample, LambertianReflection};
use lobe::geometry::{Frame, reflect};
use lobe::glam::{Vec2, Vec3};
use lobe::image::{Display, Metadata, write_png};
use lobe::interaction::SurfaceInteraction;
use lobe::material::Material;
use lobe::texture::{Texture, TextureHandle};
use lobe::{
    FilmSettings, PerspectiveSettings, PointLight, RenderOptions, RenderSettings, Scene, Spectrum,
    View, render,
};

/// Light spread around the mirror direction r: f = R (n + 2)/(2π) (r · wi)ⁿ, the modified Phong model of
/// Lafortune and Willems 1994, which is reciprocal and conserves energy.
#[derive(Clone, Copy)]
struct PhongLobe {
    r: Spectrum,
    exponent: f32,
}

impl PhongLobe {
    /// The cosine between `wi` and the mirror direction of `wo`.
    fn cos_alpha(wo: Vec3, wi: Vec3) -> f32 {
        reflect(wo, Vec3::Z).dot(wi).max(0.0)
    }
}

impl BxDF for PhongLobe {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::GLOSSY
    }

    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.r * ((self.exponent + 2.0) / TAU * Self::cos_alpha(wo, wi).powf(self.exponent))
    }

    // cos α has the cumulative distribution 1 - cosⁿ⁺¹ α around the mirror direction.
    fn sample_f(&self, wo: Vec3, _uc: f32, u: Vec2) -> Option<BxdfSample> {
        let cos_alpha = (1.0 - u.x).powf(1.0 / (self.exponent + 1.0));
        let around = (1.0 - cos_alpha * cos_alpha).sqrt() * Vec2::from_angle(TAU * u.y);
        let wi = Frame::from_normal(reflect(wo, Vec3::Z)).to_world(around.extend(cos_alpha));
        let pdf = self.pdf(wo, wi);
        // Directions below the surface give no sample.
        (pdf > 0.0).then(|| BxdfSample::glossy(self.f(wo, wi), wi, pdf))
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match wo.z * wi.z > 0.0 {
            true => (self.exponent + 1.0) / TAU * Self::cos_alpha(wo, wi).powf(self.exponent),
            false => 0.0,
        }
    }

    // The lobe is selected in proportion to it.
    fn albedo_estimate(&self, _wo: Vec3) -> f32 {
        self.r.max_component()
    }
}

/// A diffuse base with a [`PhongLobe`] on top.
struct Lacquer {
    base: TextureHandle<Spectrum>,
    gloss: PhongLobe,
}

impl Material for Lacquer {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(LambertianReflection::new(self.base.evaluate(si)));
        bsdf.add(&self.gloss as &dyn BxDF);
        bsdf
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).unwrap_or("custom_material.png".into());
    let gloss = PhongLobe { r: Spectrum::splat(0.4), exponent: 60.0 };
    let bands = |si: &SurfaceInteraction| match (8.0 * si.p().y).rem_euclid(2.0) < 1.0 {
        true => Spectrum::new(0.05, 0.3, 0.2),
        false => Spectrum::new(0.3, 0.05, 0.1),
    };
    let scene = Scene::builder()
        .material("lacquer", Lacquer { base: bands.into_handle(), gloss })
        .shape("torus", torus::torus(1.2, 0.5, 128), "lacquer")
        .light(PointLight::new(Vec3::new(-4.0, 8.0, -10.0), Spectrum::splat(150.0 * PI)))
        .build()?;
    let camera = PerspectiveSettings {
        eye: Vec3::new(-3.0, 2.5, -3.0),
        look_at: Vec3::ZERO,
        fov: 65.0,
        ..PerspectiveSettings::default()
    };
    let view = View::perspective(&camera, FilmSettings::default())?;
    let rendered = render(&scene, &view, &RenderSettings::default(), &RenderOptions::default())?;
    write_png(Path::new(&file), &rendered.picture, Display::Srgb, &Metadata::default())?;
    println!("wrote {file} in {:.2} s", rendered.seconds);
    Ok(())
}
