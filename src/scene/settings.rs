//! Settings of film, sampler and integrator: plain values.

use glam::UVec2;

use crate::film::{Display, Window};

/// The film's size and look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSettings {
    /// Columns and rows of the image.
    pub resolution: UVec2,
    /// The part of it to render; all of it if there is none.
    pub crop: Option<Window>,
    /// The curve from radiance to the codes of a PNG.
    pub display: Display,
}

impl FilmSettings {
    /// The pixels to render.
    pub fn window(&self) -> Window {
        self.crop.unwrap_or(Window::full(self.resolution))
    }
}

impl Default for FilmSettings {
    /// 500 × 500 pixels, as in the chapter, shown by the sRGB curve.
    fn default() -> Self {
        Self { resolution: UVec2::splat(500), crop: None, display: Display::Srgb }
    }
}

/// Which sampler.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplerKind {
    /// [`IndependentSampler`](crate::sampling::IndependentSampler).
    #[default]
    Independent,
    /// [`StratifiedSampler`](crate::sampling::StratifiedSampler).
    Stratified,
}

/// Which samples are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerSettings {
    /// Which sampler.
    pub kind: SamplerKind,
    /// Samples in each pixel, at least 1.
    pub spp: u32,
    /// Each seed gives another set of samples.
    pub seed: u64,
}

impl Default for SamplerSettings {
    /// 64 independent samples.
    fn default() -> Self {
        Self { kind: SamplerKind::Independent, spp: 64, seed: 0 }
    }
}

/// How light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorSettings {
    /// The chapter's estimator: see [`ChapterIntegrator`](crate::integrator::ChapterIntegrator).
    Chapter {
        /// Whether to multiply by the Blinn-Phong factor of section 6.2.
        highlight: bool,
    },
    /// Direct light: see [`DirectIntegrator`](crate::integrator::DirectIntegrator).
    Direct,
}

impl Default for IntegratorSettings {
    /// The chapter's picture without highlight.
    fn default() -> Self {
        Self::Chapter { highlight: false }
    }
}
