//! Integrators: they estimate the radiance that arrives along camera rays.
//!
//! Each algorithm reads from top to bottom in its own file: [`ChapterIntegrator`], [`DirectIntegrator`],
//! [`PathIntegrator`]. They process samples in waves, stage by stage; `wave/` has the stages that they share.
//!
//! ```
//! use lobe::integrator::DirectIntegrator;
//! use lobe::light::SkyLight;
//! use lobe::render::SamplerSettings;
//! use lobe::scene::{FilmSettings, Scene, View};
//! use lobe::{PerspectiveSettings, RenderOptions, RenderSettings, Spectrum, render};
//!
//! let sky = Spectrum::new(0.2, 0.4, 0.8);
//! let scene = Scene::builder().light(SkyLight::new(sky)).build()?;
//! let view = View::perspective(&PerspectiveSettings::default(), FilmSettings::new(8, 8))?;
//! let settings = RenderSettings::new(SamplerSettings::default(), DirectIntegrator::default());
//! let rendered = render(&scene, &view, &settings, &RenderOptions::default())?;
//! // In an empty scene every pixel shows the sky.
//! assert_eq!(rendered.picture.color[0], sky);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod albedo;
mod chapter;
mod direct;
mod path;
mod traits;
mod wave;

pub use albedo::AlbedoIntegrator;
pub use chapter::ChapterIntegrator;
pub use direct::DirectIntegrator;
pub use path::PathIntegrator;
pub use traits::{Estimator, Integrator, Read};
pub use wave::{Counters, ShadowRays, Wave, dimension};

use crate::params::Kind;

/// All kinds of integrators of scene files.
pub static INTEGRATORS: &[Kind<Read>] = &[path::KIND, direct::KIND, chapter::KIND];
