//! Evaluates a material for directions from standard input: to plot lobes, or to compare them with another program's.
//!
//! `cargo run --release --example evaluate_material -- SCENE.toml MATERIAL [--sample]`\
//! `cargo run --release --example evaluate_material -- --facets AX AY ETA_R ETA_G ETA_B K_R K_G K_B [--sample]`
//!
//! MATERIAL is a name in the scene file. `--facets` is a rough metal without multiple scattering, which scene files do not have: GGX roughness along x and
//! along y, index of refraction and absorption per band.
//!
//! Directions are unit vectors in shading coordinates: z is the normal, x is along ∂p/∂u. For each line of input there is a line of output:
//!
//! - `wo.x wo.y wo.z wi.x wi.y wi.z` gives `f.r f.g f.b pdf`, without the cosine and without specular lobes;
//! - with `--sample`, `wo.x wo.y wo.z uc u v` gives `wi.x wi.y wi.z f.r f.g f.b pdf eta specular`, where `specular` is 1 for a specular event,
//!   whose pdf is its probability, and else 0; or nine zeros if these values give no direction.
//!
//! Textures have their values at u = v = 1/3.

use std::error::Error;
use std::io::{BufRead, BufWriter, Write, stdin, stdout};
use std::path::Path;

use lobe::accel::Hit;
use lobe::bxdf::fresnel::Fresnel;
use lobe::bxdf::{Arena, Bsdf, BxdfFlags, MicrofacetReflection};
use lobe::check::with_lobes;
use lobe::geometry::Ray;
use lobe::glam::{Vec2, Vec3};
use lobe::interaction::SurfaceInteraction;
use lobe::material::Material;
use lobe::scene_file::parse_scene;

/// A rough metal that loses the light that meets a second facet.
struct Facets {
    alpha: [f32; 2],
    fresnel: Fresnel,
}

impl Material for Facets {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::along_u(si);
        bsdf.add(MicrofacetReflection::new(self.alpha, self.fresnel));
        bsdf
    }
}

/// Added to the scene file, so that the material has a surface.
const SURFACE: &str = "evaluate-material";

/// Calls `evaluate` with the lobes of a material of a scene file.
fn of_scene(file: &str, material: &str, evaluate: impl FnOnce(&Bsdf) -> Answer) -> Answer {
    let mut text = std::fs::read_to_string(file)?;
    text += &format!(
        "\n[shape.{SURFACE}]\ntype = \"rectangle\"\nmaterial = {material:?}\ncorner = [0, 0, 0]\nedges = [[1, 0, 0], [0, 1, 0]]\n"
    );
    let scene = parse_scene(Path::new(file), &text, &[])?.scene;
    let shape = scene.shapes().position(|(name, _)| name == SURFACE).ok_or("no surface")?;
    let third = 1.0 / 3.0;
    // uv are (0, 0), (1, 0) and (1, 1) at the corners of triangle 0.
    let hit = Hit { t: 1.0, b: [1.0 - third, 0.0, third], shape: shape as u32, triangle: 0 };
    let ray = Ray::new(Vec3::new(third, third, 1.0), Vec3::NEG_Z);
    let arena = Arena::new();
    let mut si = scene.interaction(&ray, &hit);
    evaluate(&scene.bsdf(&hit, &mut si, &arena))
}

type Answer = Result<(), Box<dyn Error>>;

/// Answers each line of standard input.
fn answer(bsdf: &Bsdf, samples: bool) -> Answer {
    let mut out = BufWriter::new(stdout().lock());
    for (number, line) in stdin().lock().lines().enumerate() {
        let line = line?;
        let words: Vec<f32> = numbers(line.split_whitespace())
            .map_err(|error| format!("line {}: {error}", number + 1))?;
        let &[x, y, z, a, b, c] = &words[..] else {
            return Err(format!("line {}: expected six numbers", number + 1).into());
        };
        let wo = bsdf.frame().to_world(Vec3::new(x, y, z));
        let values = if samples {
            sample(bsdf, wo, a, Vec2::new(b, c))
        } else {
            pair(bsdf, wo, Vec3::new(a, b, c))
        };
        let words: Vec<_> = values.iter().map(f32::to_string).collect();
        writeln!(out, "{}", words.join(" "))?;
    }
    out.flush()?;
    match bsdf.rejected() {
        0 => Ok(()),
        count => Err(format!("{count} values were not finite or negative").into()),
    }
}

fn pair(bsdf: &Bsdf, wo: Vec3, wi: Vec3) -> Vec<f32> {
    let (f, pdf) = bsdf.f_and_pdf(wo, bsdf.frame().to_world(wi), BxdfFlags::all());
    [&f.to_array()[..], &[pdf]].concat()
}

fn sample(bsdf: &Bsdf, wo: Vec3, uc: f32, u: Vec2) -> Vec<f32> {
    let Some(sample) = bsdf.sample_f(wo, uc, u, BxdfFlags::all()) else { return vec![0.0; 9] };
    let wi = bsdf.frame().to_local(sample.wi).to_array();
    let specular = f32::from(u8::from(sample.is_specular()));
    [&wi[..], &sample.f.to_array(), &[sample.pdf, sample.eta, specular]].concat()
}

fn numbers<'a>(words: impl Iterator<Item = &'a str>) -> Result<Vec<f32>, String> {
    words.map(|word| word.parse().map_err(|_| format!("`{word}` is not a number"))).collect()
}

fn main() -> Answer {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let samples = arguments.iter().position(|argument| argument == "--sample");
    if let Some(at) = samples {
        arguments.remove(at);
    }
    let evaluate = |bsdf: &Bsdf| answer(bsdf, samples.is_some());
    match &arguments[..] {
        [flag, rest @ ..] if flag == "--facets" => {
            let &[ax, ay, er, eg, eb, kr, kg, kb] = &numbers(rest.iter().map(String::as_str))?[..]
            else {
                return Err("--facets needs eight numbers".into());
            };
            let fresnel = Fresnel::Conductor { eta: [er, eg, eb], k: [kr, kg, kb] };
            with_lobes(&Facets { alpha: [ax, ay], fresnel }, evaluate)
        }
        [file, material] => of_scene(file, material, evaluate),
        _ => Err("expected SCENE.toml MATERIAL, or --facets with eight numbers".into()),
    }
}
