//! `lobe chart`: error against time and samples, for all methods that can render a scene.

mod cost;
mod folder;
mod measure;
mod methods;
mod page;
mod plan;
mod report;
mod results;
mod runs;
mod stability;

use std::error::Error;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{ArgGroup, Args, value_parser};
use lobe::glam::UVec2;
use lobe::image::{Encoding, Image, ImageFile};
use lobe::metrics::convergence::{Method, Other};
use lobe::metrics::{CompareError, Errors};
use lobe::params::Shown;
use lobe::{RenderOptions, Spectrum};

use crate::arguments::{ThreadsArgument, seconds};
use crate::images::MemoryArgument;
use crate::scene::SceneArguments;
use measure::Bench;
use results::Results;

const EXAMPLES: &str = r#"Examples:
  lobe chart dragon-sky.toml                            five minutes, then dragon-sky-chart/index.html
  lobe chart dragon-sky.toml --time 60 --set film.resolution=[128,128]
  lobe chart scene.toml --methods list.toml             your own methods, see below
  lobe chart --stability                                where methods fail numerically, in about 20 s
  lobe chart scene.toml --add "Mitsuba, 64 spp=other.exr,5.6"

A list of methods is a TOML file. Each method has a name and a list of settings as for --set:
  [methods]
  "sobol, one set" = ['sampler.type="sobol"', 'sampler.replicates=1']
  "light sampling only" = ['sampler.type="sobol"', 'integrator.strategy="light"']

Errors are the square root of relMSE, the mean of (a - b)² / (b² + 0.01), against a reference with other seeds. The
reference's own error is subtracted and drawn as a floor. A chart that is stopped by Ctrl-C or killed loses no more
than the picture that it was rendering: the same command resumes it. A finished chart is only drawn again, after a short
trial of each method; --fresh starts again. One chart at a time writes to a folder."#;

/// Arguments without effect on `--stability`, which they conflict with.
const OF_SCENES: [&str; 10] = [
    "set",
    "methods",
    "time",
    "budgets",
    "seeds",
    "reference",
    "add",
    "max_image_mb",
    "fresh",
    "threads",
];

/// Charts error against time and samples for each method to render a scene: SVG, CSV and an HTML page
#[derive(Args)]
#[command(after_help = EXAMPLES)]
#[command(group(ArgGroup::new("what").required(true).args(["path", "stability"])))]
pub struct Arguments {
    #[command(flatten)]
    scene: Option<SceneArguments>,

    /// Charts numerical failures in place of a scene: ray origins, edges, lights, sums and so on, each with
    /// the common method beside ours. Exits with code 1 if ours exceeds a stored bound
    #[arg(long, conflicts_with_all = OF_SCENES)]
    stability: bool,

    /// With --stability: factor on the number of trials
    // Not `requires`: clap lets that pass where the required argument conflicts with one that is present.
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor, conflicts_with = "path")]
    effort: f64,

    /// The folder to write to: a new or empty one, or that of an earlier chart [default: NAME-chart for NAME.toml, or stability-chart]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// A list of methods [default: each sampler, and Sobol points with each other strategy and roulette]
    #[arg(long, value_name = "FILE")]
    methods: Option<PathBuf>,

    /// Approximate total time, which determines the largest number of samples
    #[arg(long, value_name = "SECONDS", default_value = "300", value_parser = seconds)]
    time: Duration,

    /// Numbers of samples per pixel, in place of the powers of two that fit into --time
    #[arg(long, value_name = "N,...", conflicts_with = "time", value_delimiter = ',', value_parser = value_parser!(u32).range(1..1 << 24))]
    budgets: Vec<u32>,

    /// Number of pictures with different seeds, for each method and number of samples
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = value_parser!(u32).range(2..=64))]
    seeds: u32,

    /// Samples per pixel of the reference [default: 32 times the largest number of the methods]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(8..1 << 27))]
    reference: Option<u32>,

    /// A picture by another program, EXR or PFM, and its render time in seconds; may be repeated
    #[arg(long, value_name = "LABEL=IMAGE,SECONDS", value_parser = added)]
    add: Vec<Added>,

    #[command(flatten)]
    memory: MemoryArgument,

    /// Starts again: removes earlier results from the folder, and no other files
    #[arg(long)]
    fresh: bool,

    #[command(flatten)]
    threads: ThreadsArgument,

    /// Prints nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

/// A picture of another program: the argument of --add.
#[derive(Clone)]
struct Added {
    label: String,
    path: PathBuf,
    seconds: f64,
}

fn factor(text: &str) -> Result<f64, String> {
    let factor = text.parse().ok().filter(|f: &f64| f.is_finite() && *f > 0.0);
    factor.ok_or("expected a number above 0".into())
}

fn added(text: &str) -> Result<Added, String> {
    let parts = || {
        let (label, rest) = text.split_once('=')?;
        let (path, time) = rest.rsplit_once(',')?;
        let is_empty = label.is_empty() || path.is_empty();
        (!is_empty).then_some((label.into(), path.into(), seconds(time).ok()?.as_secs_f64()))
    };
    let (label, path, seconds) =
        parts().ok_or("expected LABEL=IMAGE,SECONDS such as Mitsuba=other.exr,5.6")?;
    Ok(Added { label, path, seconds })
}

/// Reads the pictures of --add, of which none is decoded unless its size and encoding are the film's.
fn decode_added(
    arguments: &Arguments,
    files: Vec<ImageFile>,
    size: UVec2,
) -> Result<Vec<Image>, Box<dyn Error>> {
    let told = |path: &Path, error: CompareError| format!("`{}`: {error}", Shown::path(path));
    for (Added { path, .. }, file) in arguments.add.iter().zip(&files) {
        if file.size() != size {
            return Err(told(path, CompareError::Size(file.size(), size)).into());
        }
        if file.encoding() != Encoding::Linear {
            return Err(told(path, CompareError::Encoding).into());
        }
    }
    let mut images = Vec::new();
    for (Added { path, .. }, file) in arguments.add.iter().zip(files) {
        let image = arguments.memory.decode(file)?;
        let dark = vec![Spectrum::BLACK; size.x as usize * size.y as usize];
        let like = Image {
            size,
            pixels: dark,
            variance: None,
            degrees_of_freedom: None,
            encoding: Encoding::Linear,
        };
        Errors::between(&image, &like).map_err(|error| told(path, error))?;
        images.push(image);
    }
    Ok(images)
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let Arguments { scene, output, seeds, fresh, .. } = arguments;
    let Some(file) = scene else {
        let folder = output.as_deref().unwrap_or("stability-chart".as_ref());
        return stability::run(folder, arguments.effort, arguments.quiet);
    };
    let folder = output.clone().unwrap_or_else(|| {
        let mut name: OsString = file.path.file_stem().unwrap_or("scene".as_ref()).to_owned();
        name.push("-chart");
        name.into()
    });
    // Check all arguments before anything takes time.
    let named = match &arguments.methods {
        Some(path) => methods::read(path, file)?,
        None => methods::usual(file)?,
    };
    let files: Vec<ImageFile> = arguments
        .add
        .iter()
        .map(|added| arguments.memory.open(&added.path))
        .collect::<Result<_, _>>()?;
    let loaded = file.load()?;
    let size = loaded.view.film().window().size();
    let images = decode_added(arguments, files, size)?;
    let results = Results::open(&folder, size)?;

    let options = RenderOptions { threads: arguments.threads.given(), ..RenderOptions::default() };
    let method = |(name, settings): &methods::Named| {
        Method::of_settings(&loaded.scene, &loaded.view, name, settings.clone(), options)
    };
    let mut bench = Bench {
        scene: file,
        loaded: &loaded,
        methods: named.iter().map(method).collect(),
        settings: named.iter().map(|(_, settings)| settings.clone()).collect(),
        notes: Vec::new(),
        options,
        threads: arguments.threads.count(),
        results,
        is_quiet: arguments.quiet,
    };
    let mut budgets = arguments.budgets.clone();
    budgets.sort_unstable();
    budgets.dedup();
    let limits = measure::Limits {
        budgets,
        seconds: arguments.time.as_secs_f64(),
        seeds: *seeds,
        reference: arguments.reference,
        fresh: *fresh,
    };
    let measured = bench.measure(&limits)?;
    let mut others = Vec::new();
    for (Added { label, seconds, path }, image) in arguments.add.iter().zip(&images) {
        let errors = Errors::between(image, measured.reference.image())
            .map_err(|error| format!("`{}`: {error}", Shown::path(path)))?;
        let (label, seconds) = (label.clone(), *seconds);
        others.push(Other { label, seconds, rel_mse: errors.rel_mse });
    }
    let name = file.path.file_stem().unwrap_or("scene".as_ref()).to_string_lossy();
    report::write(&bench, measured, others, &name)
}
