//! `lobe check`: whether the materials of a scene keep the contracts of lobes.

mod breaks;
mod help;
mod image;
mod materials;
mod page;
mod parallel;
mod plots;
mod polar;
mod table;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{ArgGroup, Args, value_parser};
use lobe::check::Options;
use lobe::image::{check_writable, write_file};
use lobe::params::Shown;

use crate::arguments::ThreadsArgument;
use crate::output::{Output, check_own};
use crate::scene::SceneArguments;
use crate::summary::print;
use materials::Checked;

/// Checks that materials keep the contracts of lobes: samples, values, densities, energy, reciprocity
#[derive(Args)]
#[command(after_help = help::text())]
#[command(group(ArgGroup::new("what").required(true).args(["path", "breaks"])))]
pub struct Arguments {
    #[command(flatten)]
    scene: Option<SceneArguments>,

    /// The name of a material of the scene file [default: all]
    #[arg(value_name = "MATERIAL")]
    material: Option<String>,

    /// Samples from each of eight directions
    #[arg(long, value_name = "N", default_value_t = Options::default().samples, value_parser = value_parser!(u32).range(1024..=1 << 28))]
    samples: u32,

    /// Seed of the samples
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,

    /// The materials promise to return all light, within 1e-3
    #[arg(long)]
    white: bool,

    /// Writes a page with the verdicts, the albedo over the angle and the shape of the lobes
    #[arg(long, value_name = "FILE.html")]
    page: Option<PathBuf>,

    /// Writes a picture of the scene with three estimates of the albedo as red, green and blue, .png or .exr: a tint is a bug
    #[arg(long, value_name = "FILE")]
    image: Option<PathBuf>,

    /// With --image: samples per pixel
    #[arg(long, value_name = "N", default_value_t = 64, requires = "image", value_parser = value_parser!(u32).range(1..1 << 24))]
    spp: u32,

    /// Checks the check: lobes that are wrong on purpose, in place of a scene. Exits with code 1 if a fault is not named
    #[arg(long = "break", conflicts_with_all = ["material", "set", "white", "page", "image"])]
    breaks: bool,

    #[command(flatten)]
    threads: ThreadsArgument,
}

/// What a lobe that promises to return all light may lose.
const WHITE: f64 = 1e-3;

pub fn run(arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let Arguments { samples, seed, .. } = *arguments;
    let threads = arguments.threads.count();
    let options = Options { samples, seed, ..Options::default() };
    let Some(scene) = &arguments.scene else {
        return breaks::run(&Options { white: Some(WHITE), ..options }, threads);
    };
    let page = arguments.page.as_deref();
    if let Some(path) = page {
        if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("html")) {
            let shown = Shown::path(path);
            return Err(format!("cannot write `{shown}`: its name has to end in .html").into());
        }
        check_writable(path)?;
    }
    let image = match &arguments.image {
        Some(path) => Output::all(std::slice::from_ref(path), &scene.path, &[])?,
        None => Vec::new(),
    };
    let loaded = scene.load()?;
    let paths: Vec<_> = page.into_iter().chain(image.iter().map(|output| &*output.path)).collect();
    check_own(&paths, &[loaded.files(), vec![scene.path.clone()]].concat())?;
    let materials = materials::select(&loaded, arguments.material.as_deref())?;

    let options = Options { white: arguments.white.then_some(WHITE), ..options };
    let checked = materials::check(materials, &options, threads);
    let mut text = table::text(&checked);
    let picture = image::render(&loaded, &image, arguments)?;
    if let Some(path) = page {
        let html = page::html(&scene.path, &checked, &options, picture.as_ref(), threads)?;
        write_file(path, html.as_bytes())?;
    }
    for path in paths {
        text += &format!("wrote  {}\n", Shown::path(path));
    }
    print(&text)?;
    let is_ok = checked.iter().all(Checked::is_ok);
    Ok(if is_ok { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
