//! `lobe render`: renders a scene file to PNG and EXR.

mod summary;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use clap::Args;
use clap::value_parser;
use lobe::image::{Metadata, PartMetadata};
use lobe::render::{Checkpoint, Part, Progress, Rendered, Saving};
use lobe::scene_file::LoadedScene;
use lobe::{RenderOptions, render};

use crate::arguments::{ThreadsArgument, part, seconds};
use crate::interrupt;
use crate::output::{Format, Output};
use crate::progress::Bar;
use crate::scene::{IsaArgument, SceneArguments};
use crate::state::State;

const EXAMPLES: &str = r#"Examples:
  lobe render chapter8.toml                             writes chapter8.png and chapter8.exr here
  lobe render chapter8.toml -o a.png --spp 256          writes only a.png, with less noise
  lobe render dragon-sky.toml --time 10                 the best picture in ten seconds
  lobe render dragon-sky.toml --spp 65536 --resume      goes on where it was ended, by whatever
  lobe render dragon-sky.toml --shard 3/8               one of eight parts, for lobe merge
  lobe render chapter8.toml --set film.resolution=[100,100] --set camera.fov=40
  lobe render chapter8.toml --set 'shape.dragon.obj="other.obj"'    strings need their quotes

A PNG is for viewing. An EXR contains linear radiance, its variance, the number of samples, and
normal, depth and albedo of the first hits; only with one is the error of the picture printed.

Ctrl-C ends a render: what there is of the picture is written, and the exit code is 130. Ctrl-C
again ends it at once.

With --resume, a file NAME.state beside the picture has all that the render needs to go on. It
is replaced, and so is the picture, every --save-every. The same command goes on from it, with
any number of threads, and gives the same picture as if it had never stopped. The file is
removed when the render is complete."#;

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

    /// Time limit, with what a resumed render took before. Renders in passes, each as long as all before it together,
    /// while the next one is expected to end in time. Sobol samples ("sobol") are best for this, since they are well distributed after every pass
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,

    /// Seed of the samples, in place of the scene's
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Goes on with the render that NAME.state holds, if there is one, and keeps that file while rendering
    #[arg(long)]
    resume: bool,

    /// With --resume: how often the state and the picture so far are written
    #[arg(long, value_name = "TIME", value_parser = seconds, default_value = "60s", requires = "resume")]
    save_every: Duration,

    /// Renders part K of N of the samples, for lobe merge [default output: NAME-K-of-N.exr]
    #[arg(long, value_name = "K/N", value_parser = part, conflicts_with = "time")]
    shard: Option<Part>,

    #[command(flatten)]
    threads: ThreadsArgument,

    /// Leaves out normal, depth and albedo from the EXR, which saves a tenth of the time
    #[arg(long)]
    no_layers: bool,

    /// Prints nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

impl Arguments {
    fn outputs(&self) -> Result<Vec<Output>, Box<dyn Error>> {
        let endings = match self.shard {
            Some(Part { index, count }) => vec![format!("-{}-of-{count}.exr", index + 1)],
            None => vec![".png".to_owned(), ".exr".to_owned()],
        };
        let outputs = Output::all(&self.output, &self.scene.path, &endings)?;
        if self.shard.is_some() && outputs.iter().all(|output| output.format != Format::Exr) {
            return Err(
                "parts are merged from EXR files: give an output whose name ends in .exr".into()
            );
        }
        Ok(outputs)
    }

    /// What decides about the picture: the scene, and the arguments that change which samples are taken or what is kept.
    fn identity(&self, loaded: &LoadedScene, layers: bool) -> String {
        let mut lines = loaded.identity();
        lines.retain(|line| {
            !["sampler.seed = ", "sampler.spp = "].iter().any(|key| line.starts_with(key))
        });
        lines.push(format!("seed = {}", loaded.settings.sampler.seed));
        lines.push(format!(
            "samples per pixel = {}",
            self.spp.unwrap_or(loaded.settings.sampler.spp)
        ));
        lines.push(format!("layers = {layers}"));
        lines.join("\n")
    }

    /// A state is of one part, too.
    fn identity_of_state(&self, identity: &str) -> String {
        match self.shard {
            Some(Part { index, count }) => format!("{identity}\nshard = {}/{count}", index + 1),
            None => identity.to_owned(),
        }
    }

    /// What merging needs to know about a part. One that lacks samples is none.
    fn part(&self, all_samples: u32, rendered: &Rendered, identity: &str) -> Option<PartMetadata> {
        let part = self.shard.filter(|_| rendered.complete)?;
        Some(PartMetadata {
            samples: part.samples(all_samples),
            all_samples,
            non_finite: rendered.non_finite,
            identity: identity.to_owned(),
        })
    }
}

pub fn run(arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let outputs = arguments.outputs()?;
    let mut loaded = arguments.scene.load_for(&arguments.isa)?;
    let files = [loaded.files(), vec![arguments.scene.path.clone()]].concat();
    Output::check_own(&outputs, &files)?;
    let sampler = &mut loaded.settings.sampler;
    sampler.seed = arguments.seed.unwrap_or(sampler.seed);
    let layers = !arguments.no_layers && outputs.iter().any(|o| o.format == Format::Exr);
    let spp = arguments.spp.unwrap_or(loaded.settings.sampler.spp);
    if let Some(part) = arguments.shard
        && part.samples(spp).is_empty()
    {
        let (number, count) = (part.index + 1, part.count);
        let what =
            format!("part {number} of {count} has none of the {spp} samples: use fewer parts");
        return Err(what.into());
    }
    let identity = match arguments.resume || arguments.shard.is_some() {
        true => arguments.identity(&loaded, layers),
        false => String::new(),
    };
    let state = match arguments.resume {
        true => Some(State::beside(&outputs[0].path, arguments.identity_of_state(&identity))?),
        false => None,
    };
    let stored = state.as_ref().map(State::load).transpose()?.flatten();

    let LoadedScene { scene, view, settings, .. } = &loaded;
    let metadata = |rendered: &Rendered| Metadata {
        scene: arguments.scene.path.display().to_string(),
        seed: settings.sampler.seed,
        samples_per_pixel: rendered.samples_per_pixel,
        seconds: rendered.seconds,
        part: arguments.part(spp, rendered, &identity),
    };
    // The last failure to save: it does not end the render.
    let unsaved = Mutex::new(None);
    let save = |checkpoint: &Checkpoint| {
        let saved = state.as_ref().map_or(Ok(()), |state| state.save(checkpoint));
        let rendered = checkpoint.rendered();
        let written = saved.map_err(Into::into).and_then(|()| {
            Output::write_all(
                &outputs,
                &rendered.picture,
                view.film().display,
                &metadata(&rendered),
            )
        });
        if let Ok(mut unsaved) = unsaved.lock() {
            *unsaved = written.err().map(|error| error.to_string());
        }
    };
    let bar = (!arguments.quiet).then(|| Bar::new(view.film().window().area() as u64));
    let progress = |progress: Progress| bar.iter().for_each(|bar| bar.update(progress));
    let interrupted = interrupt::listen()?;
    let options = RenderOptions {
        threads: arguments.threads.given(),
        layers,
        spp: arguments.spp,
        time: arguments.time,
        part: arguments.shard,
        progress: Some(&progress),
        cancel: Some(&interrupted),
        save: state
            .is_some()
            .then_some(Saving { every: arguments.save_every.as_secs_f64(), to: &save }),
        resume: stored.as_deref(),
        ..RenderOptions::default()
    };
    let rendered = render(scene, view, settings, &options);
    bar.iter().for_each(Bar::clear);
    let rendered = rendered?;
    let was_interrupted = !rendered.complete && interrupted.load(Ordering::Relaxed);
    if rendered.empty_pixels == view.film().window().area() as u64 && !rendered.complete {
        let why = if was_interrupted { "interrupted" } else { "time was over" };
        return Err(
            format!("{why} before any part of the picture was done: nothing is written").into()
        );
    }
    let start = Instant::now();
    let metadata = metadata(&rendered);
    Output::write_or_keep(&outputs, &rendered.picture, view.film().display, &metadata)?;
    if rendered.complete {
        state.iter().for_each(State::remove);
    }
    if !arguments.quiet {
        let mut summary = summary::of(&loaded, &rendered, &metadata, &outputs);
        summary.add("write", format!("{:.3} s", start.elapsed().as_secs_f64()));
        if let Some(error) = unsaved.into_inner().unwrap_or_default() {
            summary.add("warning", format!("not saved while rendering: {error}"));
        }
        summary.print()?;
    }
    if !was_interrupted {
        return Ok(ExitCode::SUCCESS);
    }
    let go_on = match state {
        Some(_) => "the same command goes on",
        None => "with --resume, it could go on",
    };
    let samples = rendered.samples_per_pixel;
    eprintln!("interrupted after {samples} samples per pixel; what there is was written; {go_on}");
    Ok(interrupt::exit_code())
}
