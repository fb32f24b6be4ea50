//! [`Method`]: a way to render a scene.

use std::time::Instant;

use super::super::{CompareError, Errors};
use super::{Reference, Run};
use crate::image::Image;
use crate::render::{RenderError, RenderOptions, Rendered, render_as};
use crate::scene::{IntegratorSettings, SamplerSettings, Scene};

/// A way to render a scene, to be compared with others.
pub struct Method<'a> {
    name: String,
    build: f64,
    render: Box<Render<'a>>,
}

/// From samples per pixel and seed to a picture.
type Render<'a> = dyn Fn(u32, u64) -> Result<Rendered, RenderError> + 'a;

/// Why there is no run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No picture came about.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The picture cannot be compared: it is not finite, or has another size than the reference.
    #[error(transparent)]
    Compare(#[from] CompareError),
}

impl<'a> Method<'a> {
    /// A method of the caller's: `render` gets the samples per pixel and the seed, and each seed has to give another,
    /// independent picture. `build` is what was done before, in seconds.
    pub fn new(
        name: impl Into<String>,
        build: f64,
        render: impl Fn(u32, u64) -> Result<Rendered, RenderError> + 'a,
    ) -> Self {
        Self { name: name.into(), build, render: Box::new(render) }
    }

    /// The scene, sampled and lit by these settings in place of its own.
    pub fn of_settings(
        scene: &'a Scene,
        name: impl Into<String>,
        sampler: SamplerSettings,
        integrator: IntegratorSettings,
        options: RenderOptions<'a>,
    ) -> Self {
        Self::new(name, scene.build_seconds(), move |spp, seed| {
            let sampler = SamplerSettings { spp, seed, ..sampler };
            render_as(scene, &sampler, &integrator, &options)
        })
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A picture, and the seconds before its rendering and of it.
    ///
    /// # Errors
    /// Those of the rendering.
    pub fn render(&self, spp: u32, seed: u64) -> Result<(Image, [f64; 2]), RenderError> {
        let start = Instant::now();
        let rendered = (self.render)(spp, seed)?;
        let all = start.elapsed().as_secs_f64();
        let set_up = self.build + (all - rendered.seconds).max(0.0);
        Ok((Image::from(&rendered.picture), [set_up, rendered.seconds]))
    }

    /// A picture, with its time and errors.
    ///
    /// # Errors
    /// If there is no picture, or it cannot be compared with the reference.
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
