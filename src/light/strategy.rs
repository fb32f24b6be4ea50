//! [`LightStrategy`]: whether directions are sampled from lights, from surfaces, or from both.

use crate::params::{Choice, Key};

/// How the directions of direct light are sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightStrategy {
    /// [`Mis`](LightStrategy::Mis) for lights that benefit from it
    /// ([`Light::is_worth_sampling`](super::Light::is_worth_sampling)), and
    /// [`Bsdf`](LightStrategy::Bsdf) for the others.
    #[default]
    Auto,
    /// Multiple importance sampling: from the light and from the BSDF, weighted by the power heuristic
    /// (Veach 1997, section 9.2.4).
    #[doc(alias = "multiple importance sampling")]
    Mis,
    /// From the light only.
    Light,
    /// From the BSDF only. Delta lights, which no ray can hit, are sampled anyway.
    Bsdf,
}

impl Choice for LightStrategy {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("auto", Self::Auto), ("mis", Self::Mis), ("light", Self::Light), ("bsdf", Self::Bsdf)];
}

impl LightStrategy {
    /// The scene-file key by which integrators read a strategy.
    pub const KEY: Key<Self> = Key::new(
        "strategy",
        "how directions to lights are sampled: from the light, from the surface (bsdf), from both weighted against each \
         other (mis), or by what suits each light (auto)",
    )
    .default(Self::Auto);
}
