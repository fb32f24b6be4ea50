//! [`RenderSettings`]: how a view of a scene is sampled and lit.

use std::sync::Arc;

use crate::integrator::{Integrator, PathIntegrator};
use crate::sampling::SamplerKind;

/// How a view of a scene is sampled and lit.
#[derive(Clone, Debug)]
pub struct RenderSettings {
    /// Which samples are taken.
    pub sampler: SamplerSettings,
    /// How light is computed.
    pub integrator: Arc<dyn Integrator>,
}

impl RenderSettings {
    /// These samples, and this integrator, of the crate or of the caller's own.
    pub fn new(sampler: SamplerSettings, integrator: impl Integrator + 'static) -> Self {
        Self { sampler, integrator: integrator.into_arc() }
    }
}

impl Default for RenderSettings {
    /// The defaults of both: 64 Sobol points in each pixel, and paths of up to five reflections.
    fn default() -> Self {
        Self::new(SamplerSettings::default(), PathIntegrator::default())
    }
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
    /// Each seed gives other, independent samples.
    pub seed: u64,
    /// Into how many independent sets a correlated sampler divides the samples of a pixel. The error is
    /// estimated from how far their means differ, which takes at least two: see [`SamplerSettings::sets`].
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

    /// 64 Sobol samples in four sets: docs/measurements.md has what fewer and more would cost and give.
    pub const DEFAULT: Self = Self { kind: SamplerKind::SOBOL, spp: 64, seed: 0, replicates: 4 };

    /// Maximum number of sets: more would not improve the estimate of the error.
    pub const MAX_SETS: u32 = 1024;

    /// How many independent sets the samples of a pixel are divided into, whose sizes differ by one sample at most:
    /// `replicates`, as far as there are samples; one set if the samples are independent.
    pub fn sets(&self) -> u32 {
        if self.kind.is_correlated() {
            self.replicates.min(self.spp).clamp(1, Self::MAX_SETS)
        } else {
            1
        }
    }
}

impl Default for SamplerSettings {
    /// [`SamplerSettings::DEFAULT`].
    fn default() -> Self {
        Self::DEFAULT
    }
}
