//! Settings of film, sampler and integrator, as plain values.

use glam::UVec2;

use crate::film::{Display, Filter, Window};
use crate::spectrum::Spectrum;

/// The size of the image, the part of it that is rendered, its filter, and how it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSettings {
    /// Columns and rows of the image.
    pub resolution: UVec2,
    /// The part of it to render, within the image and not empty; `None` for all of it.
    pub crop: Option<Window>,
    /// The curve from radiance to the codes of a PNG.
    pub display: Display,
    /// The reconstruction filter.
    pub filter: Filter,
}

impl FilmSettings {
    /// An image of `width` × `height` pixels, and otherwise the default.
    pub fn new(width: u32, height: u32) -> Self {
        Self { resolution: UVec2::new(width, height), ..Self::default() }
    }

    /// The pixels to render.
    pub fn window(&self) -> Window {
        self.crop.unwrap_or(Window::full(self.resolution))
    }
}

impl Default for FilmSettings {
    /// 500 × 500 pixels with a box filter, shown by the sRGB curve.
    fn default() -> Self {
        Self {
            resolution: UVec2::splat(500),
            crop: None,
            display: Display::Srgb,
            filter: Filter::Box,
        }
    }
}

/// How a view of a scene is sampled and lit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderSettings {
    /// Which samples are taken.
    pub sampler: SamplerSettings,
    /// How light is computed.
    pub integrator: IntegratorSettings,
}

/// Why settings cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// There is nothing to average.
    #[error("the sampler's spp is 0: it has to be at least 1")]
    NoSamples,
}

/// Which sampler.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplerKind {
    /// [`IndependentSampler`](crate::sampling::IndependentSampler).
    Independent,
    /// [`StratifiedSampler`](crate::sampling::StratifiedSampler).
    Stratified,
    /// [`SobolSampler`](crate::sampling::SobolSampler).
    #[default]
    Sobol,
    /// [`BlueNoiseSampler`](crate::sampling::BlueNoiseSampler).
    BlueNoise,
}

/// Which samples are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerSettings {
    /// Which sampler.
    pub kind: SamplerKind,
    /// Samples in each pixel, at least 1.
    pub spp: u32,
    /// Each seed gives other, independent samples.
    pub seed: u64,
    /// Into how many independent sets a correlated sampler divides the samples of a pixel. The film tells its error
    /// from how far their means differ, which one set cannot: see [`SamplerSettings::sets`].
    pub replicates: u32,
}

impl SamplerSettings {
    /// Checks the ranges of its values.
    ///
    /// # Errors
    /// If there are no samples.
    pub fn check(&self) -> Result<(), SettingsError> {
        if self.spp == 0 { Err(SettingsError::NoSamples) } else { Ok(()) }
    }

    /// The most sets that are made: more tell no more of the error.
    pub const MOST_SETS: u32 = 1024;

    /// How many independent sets of equal size the samples of a pixel are divided into: the largest
    /// divisor of `spp` that is not above `replicates`; one set if the samples are independent.
    pub fn sets(&self) -> u32 {
        if self.kind == SamplerKind::Independent {
            return 1;
        }
        let most = self.replicates.min(self.spp).clamp(1, Self::MOST_SETS);
        (1..=most).rev().find(|sets| self.spp.is_multiple_of(*sets)).unwrap_or(1)
    }
}

impl Default for SamplerSettings {
    /// 64 Sobol samples in two sets.
    fn default() -> Self {
        Self { kind: SamplerKind::Sobol, spp: 64, seed: 0, replicates: 2 }
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
    Direct {
        /// How directions to lights are drawn.
        strategy: LightStrategy,
    },
    /// Global illumination by path tracing: see [`PathIntegrator`](crate::integrator::PathIntegrator).
    Path {
        /// The most reflections and refractions that a path has. Light that takes more is missing, so that a picture
        /// of many bounces is too dark: a faceted glass ball in a white furnace shows 0.9976 of its light at 64, and
        /// 1.0000 at 8192.
        max_depth: u32,
        /// Whether Russian roulette ends paths of low throughput.
        roulette: bool,
        /// How directions to lights are drawn.
        strategy: LightStrategy,
    },
}

/// Light that a surface emits, the same in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Radiance in W / (m² sr), at least 0 in each band.
    pub radiance: Spectrum,
    /// Whether both sides emit, or the outside alone: see [`AreaLight`](crate::light::AreaLight).
    pub two_sided: bool,
}

/// How directions towards light are sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightStrategy {
    /// [`Mis`](LightStrategy::Mis) for lights that say it is worth it
    /// ([`Light::is_worth_sampling`](crate::light::Light::is_worth_sampling)), and
    /// [`Bsdf`](LightStrategy::Bsdf) for the others.
    #[default]
    Auto,
    /// From the light and from the surface's lobes, combined by the power heuristic
    /// (Veach 1997, section 9.2.4).
    Mis,
    /// From the light alone.
    Light,
    /// From the surface's lobes alone; delta lights, which no ray hits by chance, are sampled all the same.
    Bsdf,
}

impl IntegratorSettings {
    /// Direct light with the strategy that suits each light.
    pub const fn direct() -> Self {
        Self::Direct { strategy: LightStrategy::Auto }
    }

    /// Path tracing up to `max_depth` reflections, with Russian roulette and the strategy that suits each light.
    pub const fn path(max_depth: u32) -> Self {
        Self::Path { max_depth, roulette: true, strategy: LightStrategy::Auto }
    }
}

impl Default for IntegratorSettings {
    /// Paths of up to 5 reflections, as many as in PBRT.
    fn default() -> Self {
        Self::path(5)
    }
}
