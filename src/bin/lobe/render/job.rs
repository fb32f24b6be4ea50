//! [`Job`]: a render that was asked for, with its outputs and its state on disk.

use std::error::Error;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use lobe::image::{Image, ImageFile, Metadata, PartMetadata, Picture};
use lobe::render::{Checkpoint, Part, Rendered};
use lobe::scene_file::LoadedScene;

use super::arguments::Arguments;
use super::summary;
use crate::output::{Format, Output};
use crate::state::State;
use crate::summary::Summary;

/// A render whose scene is loaded and whose outputs are known to be writable.
pub struct Job<'a> {
    arguments: &'a Arguments,
    pub loaded: LoadedScene,
    outputs: Vec<Output>,
    /// Whether an output has room for layers.
    pub layers: bool,
    /// Samples of a pixel in all parts together.
    spp: u32,
    /// What decides about the picture; for states and parts alone.
    identity: String,
    state: Option<State>,
    /// The last failure to save, which does not end the render.
    unsaved: Mutex<Option<String>>,
}

impl<'a> Job<'a> {
    /// Loads the scene, and checks all that can be checked before anything is rendered.
    pub fn prepare(arguments: &'a Arguments) -> Result<Self, Box<dyn Error>> {
        let outputs = outputs(arguments)?;
        let mut loaded = arguments.scene.load_for(&arguments.isa)?;
        let files = [loaded.files(), vec![arguments.scene.path.clone()]].concat();
        Output::check_own(&outputs, &files)?;
        let resolution = loaded.view.film().resolution;
        Picture::check_resolution(resolution).map_err(|error| {
            format!("{error}, but film.resolution is {} x {}", resolution.x, resolution.y)
        })?;
        let sampler = &mut loaded.settings.sampler;
        sampler.seed = arguments.seed.unwrap_or(sampler.seed);
        let spp = arguments.spp.unwrap_or(sampler.spp);
        if let Some(part) = arguments.shard
            && part.samples(spp).is_empty()
        {
            let (number, count) = (part.index + 1, part.count);
            let what = format!("part {number} of {count} has none of the {spp} samples");
            return Err(format!("{what}: use fewer parts").into());
        }
        let layers = !arguments.no_layers && outputs.iter().any(|o| o.format == Format::Exr);
        let identity = match arguments.resume || arguments.shard.is_some() {
            true => identity(&loaded, arguments.samples(spp), layers),
            false => String::new(),
        };
        // A state is of one part, too.
        let of_state = match arguments.shard {
            Some(Part { index, count }) => format!("{identity}\nshard = {}/{count}", index + 1),
            None => identity.clone(),
        };
        let state = arguments.resume.then(|| State::beside(&outputs[0].path, of_state));
        let (state, unsaved) = (state.transpose()?, Mutex::default());
        Ok(Self { arguments, loaded, outputs, layers, spp, identity, state, unsaved })
    }

    /// The bytes of the checkpoint on disk, if there is one.
    pub fn stored(&self) -> Result<Option<Vec<u8>>, Box<dyn Error>> {
        self.state.as_ref().map_or(Ok(None), State::load)
    }

    fn metadata(&self, rendered: &Rendered) -> Metadata {
        // A part that lacks samples is none.
        let part = self.arguments.shard.filter(|_| rendered.complete);
        let part = part.map(|part| PartMetadata {
            samples: part.samples(self.spp),
            all_samples: self.spp,
            non_finite: rendered.non_finite,
            identity: self.identity.clone(),
        });
        Metadata {
            scene: self.arguments.scene.path.display().to_string(),
            seed: self.loaded.settings.sampler.seed,
            samples_per_pixel: rendered.samples_per_pixel,
            seconds: rendered.seconds,
            part,
        }
    }

    /// Replaces the state and the pictures so far.
    pub fn save(&self, checkpoint: &Checkpoint) {
        let saved = self.state.as_ref().map_or(Ok(()), |state| state.save(checkpoint));
        let written = saved.map_err(Into::into).and_then(|()| {
            let rendered = checkpoint.rendered();
            if self.is_empty(&rendered) {
                return Ok(());
            }
            let display = self.loaded.view.film().display;
            Output::write_all(&self.outputs, &rendered.picture, display, &self.metadata(&rendered))
        });
        let mut unsaved = self.unsaved.lock().unwrap_or_else(PoisonError::into_inner);
        *unsaved = written.err().map(|error| error.to_string());
    }

    /// Whether there is nothing in the picture that could be worth more than what the outputs hold.
    pub fn is_empty(&self, rendered: &Rendered) -> bool {
        let pixels = self.loaded.view.film().window().area() as u64;
        !rendered.complete && rendered.empty_pixels == pixels
    }

    /// Whether the same command goes on from what is on disk, in words.
    pub fn going_on(&self) -> String {
        match (&self.state, self.unsaved()) {
            (None, _) => "it cannot go on: --resume keeps what that needs".to_owned(),
            (Some(_), Some(error)) => format!("it cannot go on: {error}"),
            (Some(_), None) => "the same command goes on".to_owned(),
        }
    }

    /// The file with all samples of this part, if there is one already: for commands that are repeated.
    pub fn complete_part(&self) -> Option<&Path> {
        let part = self.arguments.shard.filter(|_| self.arguments.resume)?;
        let is_it = |output: &&Output| {
            let file = ImageFile::open(&output.path, Image::DEFAULT_LIMIT).ok();
            let found = file.and_then(|file| file.part().ok()?.part);
            found.is_some_and(|found| {
                found.samples == part.samples(self.spp) && found.identity == self.identity
            })
        };
        let mut exr = self.outputs.iter().filter(|output| output.format == Format::Exr);
        exr.find(is_it).map(|output| &*output.path)
    }

    fn unsaved(&self) -> Option<String> {
        self.unsaved.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Writes the pictures. The state of a render that was not interrupted goes.
    pub fn finish(&self, rendered: &Rendered, is_over: bool) -> Result<(), Box<dyn Error>> {
        let display = self.loaded.view.film().display;
        let metadata = self.metadata(rendered);
        Output::write_or_keep(&self.outputs, &rendered.picture, display, &metadata)?;
        if is_over {
            self.state.iter().for_each(State::remove);
        }
        Ok(())
    }

    pub fn summary(&self, rendered: &Rendered) -> Summary {
        let mut summary = summary::of(&self.loaded, rendered, &self.arguments.scene.path);
        if let Some(error) = self.unsaved() {
            summary.add("warning", format!("not saved while rendering: {error}"));
        }
        self.outputs.iter().for_each(|output| summary.add("wrote", output.path.display()));
        summary
    }
}

fn outputs(arguments: &Arguments) -> Result<Vec<Output>, Box<dyn Error>> {
    let endings = match arguments.shard {
        Some(Part { index, count }) => vec![format!("-{}-of-{count}.exr", index + 1)],
        None => vec![".png".to_owned(), ".exr".to_owned()],
    };
    let outputs = Output::all(&arguments.output, &arguments.scene.path, &endings)?;
    if arguments.shard.is_some() && outputs.iter().all(|output| output.format != Format::Exr) {
        let what = "parts are merged from EXR files: give an output whose name ends in .exr";
        return Err(what.into());
    }
    Ok(outputs)
}

/// The scene, and the arguments that change which samples are taken or what is kept.
fn identity(loaded: &LoadedScene, samples: String, layers: bool) -> String {
    let mut lines = loaded.identity();
    let is_replaced =
        |line: &str| ["sampler.seed = ", "sampler.spp = "].iter().any(|key| line.starts_with(key));
    lines.retain(|line| !is_replaced(line));
    lines.push(format!("seed = {}", loaded.settings.sampler.seed));
    lines.push(format!("samples per pixel = {samples}"));
    lines.push(format!("layers of an EXR file = {layers}"));
    lines.join("\n")
}
