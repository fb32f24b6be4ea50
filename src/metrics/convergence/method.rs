//! [`Method`]: a way to render a scene, to be compared with others.

use super::super::{CompareError, Errors};
use super::{Reference, Run};
use crate::clock::Stopwatch;
use crate::image::Image;
use crate::render::{RenderError, RenderOptions, Rendered, render};
use crate::render::{RenderSettings, SamplerSettings};
use crate::scene::{Scene, View};

/// A way to render a scene: a name and a function from samples per pixel and seed to a picture.
pub struct Method<'a> {
    name: String,
    build: f64,
    render: Box<Render<'a>>,
}

/// Arguments: samples per pixel and seed.
type Render<'a> = dyn Fn(u32, u64) -> Result<Rendered, RenderError> + 'a;

/// Why a run failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The rendering failed.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The picture lacks samples.
    #[error("the render was cancelled")]
    Cancelled,
    /// The picture cannot be compared with the reference: it has another size, or values that are not finite.
    #[error(transparent)]
    Compare(#[from] CompareError),
}

impl<'a> Method<'a> {
    /// A method that calls `render` with samples per pixel and seed. Different seeds have to give independent pictures.
    /// `build` is the time that was spent before, in seconds, such as for the tree.
    pub fn new(
        name: impl Into<String>,
        build: f64,
        render: impl Fn(u32, u64) -> Result<Rendered, RenderError> + 'a,
    ) -> Self {
        Self { name: name.into(), build, render: Box::new(render) }
    }

    /// Renders a view of the scene with these settings, but for the number of samples and the seed.
    pub fn of_settings(
        scene: &'a Scene,
        view: &'a View,
        name: impl Into<String>,
        settings: RenderSettings,
        options: RenderOptions<'a>,
    ) -> Self {
        Self::new(name, scene.build_seconds(), move |spp, seed| {
            let sampler = SamplerSettings { spp, seed, ..settings.sampler };
            render(scene, view, &RenderSettings { sampler, ..settings.clone() }, &options)
        })
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Renders a picture; returns it with the seconds of set-up and of rendering.
    ///
    /// # Errors
    /// Those of the rendering, or if it was cancelled.
    pub fn render(&self, spp: u32, seed: u64) -> Result<(Image, [f64; 2]), RunError> {
        let start = Stopwatch::start();
        let rendered = (self.render)(spp, seed)?;
        if !rendered.complete {
            return Err(RunError::Cancelled);
        }
        let all = start.seconds();
        let set_up = self.build + (all - rendered.seconds).max(0.0);
        Ok((Image::from(&rendered.picture), [set_up, rendered.seconds]))
    }

    /// Renders a picture and compares it with the reference.
    ///
    /// # Errors
    /// If the rendering fails, or the picture cannot be compared with the reference.
    pub fn run(
        &self,
        spp: u32,
        seed: u64,
        reference: &Reference,
    ) -> Result<(Run, Image), RunError> {
        let (image, times) = self.render(spp, seed)?;
        let errors = Errors::between(&image, reference.image())?;
        Ok((Run::new(&self.name, spp, seed, times, &errors), image))
    }
}
