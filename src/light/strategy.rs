//! [`LightStrategy`]: whether light is looked for from the light or from the surface.

use crate::params::{Choice, Key};

/// How directions towards light are sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightStrategy {
    /// [`Mis`](LightStrategy::Mis) for lights that say it is worth it
    /// ([`Light::is_worth_sampling`](super::Light::is_worth_sampling)), and
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
