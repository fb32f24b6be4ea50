//! A custom reflection model: smooth glass, in a white furnace.
//!
//! Under a sky of radiance 1 a body that absorbs nothing is invisible: every pixel is 1.
//!
//! `cargo run --release --example custom_bxdf`

mod torus;

use lobe::bxdf::{Arena, Bsdf, BxDF, BxdfFlags, BxdfSample};
use lobe::check::{Options, check};
use lobe::geometry::{reflect, refract};
use lobe::glam::{Vec2, Vec3};
use lobe::integrator::PathIntegrator;
use lobe::interaction::SurfaceInteraction;
use lobe::light::SkyLight;
use lobe::material::Material;
use lobe::render::SamplerSettings;
use lobe::{
    FilmSettings, PerspectiveSettings, RenderOptions, RenderSettings, Scene, Spectrum, View, render,
};

/// A smooth boundary of dielectrics: reflects by Fresnel's equations, and refracts the rest.
struct Glass {
    /// Index of refraction inside, over that outside.
    eta: f32,
}

impl BxDF for Glass {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::TRANSMISSION | BxdfFlags::SPECULAR
    }

    // A delta lobe is black for all directions that it did not sample itself.
    fn f(&self, _wo: Vec3, _wi: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    fn pdf(&self, _wo: Vec3, _wi: Vec3) -> f32 {
        0.0
    }

    fn sample_f(&self, wo: Vec3, uc: f32, _u: Vec2) -> Option<BxdfSample> {
        let n = Vec3::Z * wo.z.signum();
        // The index on the other side, over that on the side of wo.
        let eta = if wo.z > 0.0 { self.eta } else { 1.0 / self.eta };
        let refracted = refract(wo, n, 1.0 / eta);
        let reflectance = refracted.map_or(1.0, |wi| {
            let [cos_o, cos_i] = [wo.z.abs(), wi.z.abs()];
            let parallel = (eta * cos_o - cos_i) / (eta * cos_o + cos_i);
            let across = (cos_o - eta * cos_i) / (cos_o + eta * cos_i);
            (parallel * parallel + across * across) / 2.0
        });
        match refracted.filter(|_| uc >= reflectance) {
            None => {
                let f = Spectrum::splat(reflectance / wo.z.abs());
                Some(BxdfSample::specular(f, reflect(wo, n), reflectance))
            }
            Some(wi) => {
                let transmittance = 1.0 - reflectance;
                // Refraction changes the solid angle, and radiance by 1/η².
                let f = Spectrum::splat(transmittance / (eta * eta * wi.z.abs()));
                Some(BxdfSample::specular(f, wi, transmittance).transmitted(eta))
            }
        }
    }
}

/// The lobe needs no arena: the material holds it.
impl Material for Glass {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(self as &dyn BxDF);
        bsdf
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Whether the lobe keeps its contracts, and loses no light.
    let promises = Options { white: Some(1e-3), ..Options::default() };
    print!("check: {}", check(&Glass { eta: 1.5 }, &promises));
    let scene = Scene::builder()
        .material("glass", Glass { eta: 1.5 })
        .shape("torus", torus::torus(1.2, 0.5, 64), "glass")
        .light(SkyLight::new(Spectrum::WHITE))
        .build()?;
    let camera = PerspectiveSettings {
        eye: Vec3::new(0.0, 2.0, -2.0),
        look_at: Vec3::ZERO,
        ..PerspectiveSettings::default()
    };
    let view = View::perspective(&camera, FilmSettings::new(64, 64))?;
    let settings = RenderSettings::new(SamplerSettings::default(), PathIntegrator::new(1024));
    let rendered = render(&scene, &view, &settings, &RenderOptions::default())?;
    let pixels = &rendered.picture.color;
    let mean = pixels.iter().map(|pixel| pixel.to_array()[0]).sum::<f32>() / pixels.len() as f32;
    println!("{mean:.4} in place of 1, {} lobe values rejected", rendered.counters.rejected);
    Ok(())
}
