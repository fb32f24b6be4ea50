//! `lobe render`: renders a scene file to PNG and EXR.

use std::error::Error;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use clap::value_parser;
use lobe::image::Metadata;
use lobe::render::Progress;
use lobe::scene_file::LoadedScene;
use lobe::{RenderOptions, render};

use crate::arguments::{ThreadsArgument, seconds};
use crate::output::{Format, Output};
use crate::progress::Bar;
use crate::scene::{IsaArgument, SceneArguments};
use crate::summary::Summary;

const EXAMPLES: &str = r#"Examples:
  lobe render chapter8.toml                             writes chapter8.png and chapter8.exr here
  lobe render chapter8.toml -o a.png --spp 256          writes only a.png, with less noise
  lobe render dragon-sky.toml --time 10                 the best picture in ten seconds
  lobe render chapter8.toml --set film.resolution=[100,100] --set camera.fov=40
  lobe render chapter8.toml --set 'shape.dragon.obj="other.obj"'    strings need their quotes

A PNG is for viewing. An EXR contains linear radiance, its variance, the number of samples, and
normal, depth and albedo of the first hits; only with one is the error of the picture printed."#;

/// Renders a scene file to PNG and EXR
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,

    #[command(flatten)]
    isa: IsaArgument,

    /// A file to write, .png or .exr; may be repeated [default: both, named after the scene]
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,

    /// Samples per pixel, in place of the scene's; with --time, their maximum
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..))]
    spp: Option<u32>,

    /// Time limit. Renders in passes, each as long as all before it together, while the next one is expected to
    /// end in time. Sobol samples ("sobol") are best for this, since they are well distributed after every pass
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,

    /// Seed of the samples, in place of the scene's
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    #[command(flatten)]
    threads: ThreadsArgument,

    /// Leaves out normal, depth and albedo from the EXR, which saves a tenth of the time
    #[arg(long)]
    no_layers: bool,

    /// Prints nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

pub fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let outputs = Output::all(&arguments.output, &arguments.scene.path)?;
    let LoadedScene { scene, view, mut settings, report } =
        arguments.scene.load_for(&arguments.isa)?;
    settings.sampler.seed = arguments.seed.unwrap_or(settings.sampler.seed);

    let bar = (!arguments.quiet).then(|| Bar::new(view.film().window().area() as u64));
    let progress = |progress: Progress| bar.iter().for_each(|bar| bar.update(progress));
    let options = RenderOptions {
        threads: arguments.threads.given(),
        layers: !arguments.no_layers && outputs.iter().any(|o| o.format == Format::Exr),
        spp: arguments.spp,
        time: arguments.time,
        progress: Some(&progress),
        ..RenderOptions::default()
    };
    let rendered = render(&scene, &view, &settings, &options);
    bar.iter().for_each(Bar::clear);
    let rendered = rendered?;

    let start = Instant::now();
    let metadata = Metadata {
        scene: arguments.scene.path.display().to_string(),
        seed: settings.sampler.seed,
        samples_per_pixel: rendered.samples_per_pixel,
        seconds: rendered.seconds,
    };
    for output in &outputs {
        output.write(&rendered.picture, view.film().display, &metadata)?;
    }
    if !arguments.quiet {
        let write_seconds = start.elapsed().as_secs_f64();
        let mut summary = Summary::default();
        summary.add("scene", &metadata.scene);
        summary.add_film(view.film());
        summary.add("samples", format!("{} per pixel", rendered.samples_per_pixel));
        summary.add_meshes(&scene);
        summary.add("threads", rendered.threads);
        summary.add("isa", scene.accel().instruction_set());
        summary.add("load", format!("{:.3} s", report.seconds));
        summary.add("build", format!("{:.3} s", scene.build_seconds()));
        summary.add("render", format!("{:.3} s", rendered.seconds));
        summary.add("write", format!("{write_seconds:.3} s"));
        let rays = rendered.counters.rays();
        summary.add("rays", rays);
        summary.add("speed", format!("{:.2} Mrays/s", rays as f64 / rendered.seconds / 1e6));
        match rendered.picture.standard_error() {
            Some(error) => {
                summary.add("error", format!("{error:.2e} standard error of a pixel, in radiance"));
            }
            // Each layer costs time, so there is no error without an EXR.
            None if options.layers => {
                summary
                    .add("error", "unknown: the samples are a single set; see sampler.replicates");
            }
            None => {}
        }
        summary.add("non-finite", format!("{} samples", rendered.non_finite));
        if rendered.counters.rejected > 0 {
            summary.add("rejected", format!("{} lobe values", rendered.counters.rejected));
        }
        if rendered.counters.refused_camera_rays > 0 {
            summary
                .add("refused", format!("{} camera rays", rendered.counters.refused_camera_rays));
        }
        for output in &outputs {
            summary.add("wrote", output.path.display());
        }
        summary.print()?;
    }
    Ok(())
}
