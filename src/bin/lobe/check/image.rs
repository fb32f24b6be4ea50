//! The picture of a check: three estimates of the albedo as red, green and blue.

use std::error::Error;

use lobe::image::{Metadata, Picture};
use lobe::integrator::AlbedoIntegrator;
use lobe::render::{Progress, SamplerSettings};
use lobe::scene_file::LoadedScene;
use lobe::{RenderOptions, RenderSettings};

use super::arguments::Arguments;
use crate::output::Output;
use crate::progress::Bar;

/// Renders the picture and writes it to the outputs; `None` if there are none.
pub fn render(
    loaded: &LoadedScene,
    outputs: &[Output],
    arguments: &Arguments,
) -> Result<Option<Picture>, Box<dyn Error>> {
    let Some(scene) = arguments.scene.as_ref().filter(|_| !outputs.is_empty()) else {
        return Ok(None);
    };
    let Arguments { seed, spp, .. } = *arguments;
    let film = loaded.view.film();
    Picture::check_resolution(film.resolution)?;
    let bar = Bar::new(film.window().area() as u64);
    let progress = |progress: Progress| bar.update(progress);
    let options = RenderOptions {
        threads: arguments.threads.given(),
        progress: Some(&progress),
        ..RenderOptions::default()
    };
    let sampler = SamplerSettings { seed, spp, ..loaded.settings.sampler };
    let settings = RenderSettings::new(sampler, AlbedoIntegrator);
    let rendered = lobe::render(&loaded.scene, &loaded.view, &settings, &options);
    bar.clear();
    let rendered = rendered?;
    let metadata = Metadata {
        scene: scene.path.display().to_string(),
        seed,
        samples_per_pixel: rendered.samples_per_pixel,
        seconds: rendered.seconds,
        part: None,
    };
    Output::write_or_keep(outputs, &rendered.picture, film.display, &metadata)?;
    Ok(Some(rendered.picture))
}
