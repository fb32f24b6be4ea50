//! `lobe render`: renders a scene file or a model to PNG and EXR.

mod arguments;
mod job;
mod summary;

use std::error::Error;
use std::io::Write;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Instant;

use lobe::render::{Progress, Saving};
use lobe::{RenderOptions, render};

use crate::interrupt;
use crate::progress::Bar;
use crate::summary::Summary;
pub use arguments::Arguments;
use job::Job;

pub fn run(arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    // Before the scene is loaded: whatever the moment, the exit code is the same.
    let interrupted = interrupt::listen()?;
    let job = Job::prepare(arguments)?;
    let stored = job.stored()?;
    if stored.is_none()
        && let Some(path) = job.complete_part()
    {
        if !arguments.quiet {
            let mut summary = Summary::default();
            summary.add("complete", format!("{} has all samples of the part", path.display()));
            summary.print()?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let window = job.loaded.view.film().window();
    let bar = (!arguments.quiet).then(|| Bar::new(window.area() as u64));
    let progress = |progress: Progress| bar.iter().for_each(|bar| bar.update(progress));
    let save = Saving { every: arguments.save_every, on_checkpoint: &|at| job.save(at) };
    let options = RenderOptions {
        threads: arguments.threads.given(),
        layers: job.layers,
        spp: arguments.spp,
        time: arguments.time,
        part: arguments.shard,
        progress: Some(&progress),
        cancel: Some(&interrupted),
        save: arguments.resume.then_some(save),
        resume: stored.as_deref(),
        ..RenderOptions::default()
    };
    let rendered = render(&job.loaded.scene, &job.loaded.view, &job.loaded.settings, &options);
    bar.iter().for_each(Bar::clear);
    let rendered = rendered?;
    let was_interrupted = !rendered.complete && interrupted.load(Ordering::Relaxed);
    if job.is_empty(&rendered) {
        let what = "before any part of the picture was done: no picture is written";
        if was_interrupted {
            return Ok(end_early(&format!("interrupted {what}"), &job));
        }
        return Err(format!("time was over {what}; allow more with --time").into());
    }
    let start = Instant::now();
    job.finish(&rendered, !was_interrupted)?;
    if !arguments.quiet {
        let mut summary = job.summary(&rendered);
        summary.add("write", format!("{:.3} s", start.elapsed().as_secs_f64()));
        summary.print()?;
    }
    if !was_interrupted {
        return Ok(ExitCode::SUCCESS);
    }
    let samples = rendered.samples_per_pixel;
    let when = match samples {
        0 => "in the first pass".to_owned(),
        _ => format!("after {samples} samples per pixel"),
    };
    let what = format!("interrupted {when}; what there is was written");
    Ok(end_early(&what, &job))
}

/// Says what was interrupted, and whether it goes on.
fn end_early(what: &str, job: &Job) -> ExitCode {
    let go_on = job.going_on();
    // If stderr is closed, the exit code still tells.
    let _ = writeln!(std::io::stderr(), "{what}; {go_on}");
    interrupt::exit_code()
}
