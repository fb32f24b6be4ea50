//! A reflection model of one's own: a Phong lobe over a diffuse base, on the dragon.
//!
//! `cargo run --release --example custom_bxdf [FILE.png]`

use std::f32::consts::{PI, TAU};
use std::path::Path;

use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags, BxdfSample, LambertianReflection, TransportMode};
use lobe::film::{Display, Metadata, write_png};
use lobe::geometry::{Frame, reflect};
use lobe::glam::{Affine3A, Vec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::material::Material;
use lobe::scene::{IntegratorSettings, SamplerKind, SamplerSettings};
use lobe::shape::read_obj;
use lobe::{CameraSettings, PointLight, RenderOptions, Scene, Spectrum, render};

/// Light spread around the mirror direction r: f = R (n + 2)/(2π) (r · wi)ⁿ, the modified Phong model of
/// Lafortune and Willems 1994, which is reciprocal and keeps energy.
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
    fn sample_f(&self, wo: Vec3, u: Vec2) -> Option<BxdfSample> {
        let cos_alpha = (1.0 - u.x).powf(1.0 / (self.exponent + 1.0));
        let around = (1.0 - cos_alpha * cos_alpha).sqrt() * Vec2::from_angle(TAU * u.y);
        let wi = Frame::from_normal(reflect(wo, Vec3::Z)).to_world(around.extend(cos_alpha));
        let pdf = self.pdf(wo, wi);
        // A part of the lobe may lie below the surface: no sample.
        (pdf > 0.0).then(|| BxdfSample { f: self.f(wo, wi), wi, pdf, flags: self.flags() })
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let above = wo.z * wi.z > 0.0;
        if above {
            (self.exponent + 1.0) / TAU * Self::cos_alpha(wo, wi).powf(self.exponent)
        } else {
            0.0
        }
    }
}

/// A diffuse base with a [`PhongLobe`] on top.
struct Lacquer {
    base: Spectrum,
    gloss: PhongLobe,
}

impl Material for Lacquer {
    fn compute_scattering<'a>(
        &self,
        si: &mut SurfaceInteraction,
        arena: &'a Arena,
        _mode: TransportMode,
        _allow_multiple_lobes: bool,
    ) -> Bsdf<'a> {
        let mut bsdf = Bsdf::new(si.isotropic_frame(), si.n(), 1.0);
        bsdf.add(LambertianReflection::new(self.base));
        bsdf.add(arena.lobe(self.gloss));
        bsdf
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).unwrap_or("custom_bxdf.png".into());
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut dragon = read_obj(&assets.join("dragon.obj"))?.mesh;
    dragon.transform(&Affine3A::from_translation(Vec3::new(0.0, -1.45, 0.0)));

    let gloss = PhongLobe { r: Spectrum::splat(0.4), exponent: 60.0 };
    let scene = Scene::builder()
        .camera(CameraSettings {
            eye: Vec3::new(-3.0, 1.5, -3.0),
            look_at: Vec3::ZERO,
            fov: 65.0,
            ..CameraSettings::default()
        })
        .integrator(IntegratorSettings::direct())
        .sampler(SamplerSettings { kind: SamplerKind::STRATIFIED, spp: 16, ..Default::default() })
        .material("lacquer", Lacquer { base: Spectrum::new(0.05, 0.3, 0.2), gloss })
        .shape("dragon", dragon, "lacquer")
        .light(PointLight::new(Vec3::new(-4.0, 8.0, -10.0), Spectrum::splat(150.0 * PI)))
        .build()?;
    let rendered = render(&scene, &RenderOptions::default())?;
    write_png(Path::new(&file), &rendered.picture, Display::Srgb, &Metadata::default())?;
    println!("wrote {file} in {:.2} s", rendered.seconds);
    Ok(())
}
