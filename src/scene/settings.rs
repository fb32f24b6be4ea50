//! Settings of film, sampler and integrator, as plain values.

use glam::UVec2;

use crate::film::Filter;
use crate::image::{Display, Window};
use crate::params::{Choice, Key};
use crate::sampling::SamplerKind;
use crate::spectrum::Spectrum;

/// The film's size and look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSettings {
    /// Columns and rows of the image.
    pub resolution: UVec2,
    /// The part of it to render; all of it if there is none.
    pub crop: Option<Window>,
    /// The curve from radiance to the codes of a PNG.
    pub display: Display,
    /// How much the light around a pixel counts for it.
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

impl FilmSettings {
    /// 500 × 500 pixels, as in the chapter, shown by the sRGB curve.
    pub const DEFAULT: Self = Self {
        resolution: UVec2::splat(500),
        crop: None,
        display: Display::Srgb,
        filter: Filter::Box,
    };
}

impl Default for FilmSettings {
    /// [`FilmSettings::DEFAULT`].
    fn default() -> Self {
        Self::DEFAULT
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

/// Which samples are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerSettings {
    /// Which sampler.
    pub kind: SamplerKind,
    /// Samples in each pixel, at least 1.
    pub spp: u32,
    /// Each seed gives another set of samples.
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

    /// How many independent sets the samples of a pixel are divided into, all of the same size: the largest
    /// divisor of `spp` that is not above `replicates`; one set if the samples are independent.
    pub fn sets(&self) -> u32 {
        if !self.kind.is_correlated() {
            return 1;
        }
        let most = self.replicates.min(self.spp).clamp(1, Self::MOST_SETS);
        (1..=most).rev().find(|sets| self.spp.is_multiple_of(*sets)).unwrap_or(1)
    }
}

impl SamplerSettings {
    /// 64 Sobol samples in two sets.
    pub const DEFAULT: Self = Self { kind: SamplerKind::SOBOL, spp: 64, seed: 0, replicates: 2 };
}

impl Default for SamplerSettings {
    /// [`SamplerSettings::DEFAULT`].
    fn default() -> Self {
        Self::DEFAULT
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
    /// Light of any number of reflections: see [`PathIntegrator`](crate::integrator::PathIntegrator).
    Path {
        /// The most reflections and refractions that a path has. Light that takes more is missing, so that a picture
        /// of many bounces is too dark: a faceted glass ball in a white furnace shows 0.9976 of its light at 64, and
        /// 1.0000 at 8192.
        max_depth: u32,
        /// Whether paths that carry little end at random.
        roulette: bool,
        /// How directions to lights are drawn.
        strategy: LightStrategy,
    },
}

/// Light that a surface sends out, the same in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Radiance in W / (m² sr), at least 0 in each band.
    pub radiance: Spectrum,
    /// Whether it leaves on both sides, or only outside: see [`AreaLight`](crate::light::AreaLight).
    pub two_sided: bool,
}

/// How the directions that light comes from are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightStrategy {
    /// [`Mis`](LightStrategy::Mis) for lights that say it is worth it
    /// ([`Light::is_worth_sampling`](crate::light::Light::is_worth_sampling)), and
    /// [`Bsdf`](LightStrategy::Bsdf) for the others.
    #[default]
    Auto,
    /// From the light and from the surface, weighed against each other by the power heuristic
    /// (Veach 1997, section 9.2.4).
    Mis,
    /// From the light alone.
    Light,
    /// From the surface alone. Lights without extent, which no ray hits by chance, are drawn from all the same.
    Bsdf,
}

impl Choice for LightStrategy {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("auto", Self::Auto), ("mis", Self::Mis), ("light", Self::Light), ("bsdf", Self::Bsdf)];
}

impl LightStrategy {
    /// The key by which integrators take one.
    pub const KEY: Key<Self> = Key::new(
        "strategy",
        "how directions to lights are drawn: from the light, from the surface (bsdf), from both weighed against each \
         other (mis), or by what suits each light (auto)",
    )
    .default(Self::Auto);
}

impl IntegratorSettings {
    /// Direct light with the strategy that suits each light.
    pub const fn direct() -> Self {
        Self::Direct { strategy: LightStrategy::Auto }
    }

    /// Paths of up to `max_depth` reflections, with roulette and the strategy that suits each light.
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
