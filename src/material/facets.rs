//! [`Facets`]: the surface of a material that reflects by facets, smooth or rough.

use std::sync::Arc;

use super::roughness::Roughness;
use super::shared::Shared;
use crate::bxdf::fresnel::Fresnel;
use crate::bxdf::{Bsdf, Losses, MicrofacetReflection};
use crate::interaction::SurfaceInteraction;
use crate::spectrum::Spectrum;

/// Facets that lose no light between them.
#[derive(Clone)]
pub struct Facets {
    fresnel: Fresnel,
    mean: Spectrum,
    /// `None` if the surface is smooth everywhere.
    rough: Option<(Roughness, Arc<Losses>)>,
}

impl Facets {
    /// A smooth surface.
    pub fn new(fresnel: Fresnel) -> Self {
        Self { fresnel, mean: fresnel.mean(), rough: None }
    }

    pub fn with_roughness(self, roughness: Roughness) -> Self {
        static LOSSES: Shared<Losses> = Shared::new();
        let all = roughness.all();
        let losses = || LOSSES.get(1.0, all, || Losses::of_mirrors(all));
        let rough = (!roughness.is_smooth()).then(|| (roughness.clone(), losses()));
        Self { rough, ..self }
    }

    /// Whether the surface is rough anywhere.
    #[inline]
    pub fn is_rough(&self) -> bool {
        self.rough.is_some()
    }

    /// The lobe at a point, and a surface without lobes, in a frame that fits.
    #[inline]
    pub fn at<'a>(&'a self, si: &SurfaceInteraction) -> (Bsdf<'a>, MicrofacetReflection<'a>) {
        self.of(si, self.fresnel, self.mean)
    }

    /// The same with other Fresnel equations, and their mean.
    #[inline]
    pub fn of<'a>(
        &'a self,
        si: &SurfaceInteraction,
        fresnel: Fresnel,
        mean: Spectrum,
    ) -> (Bsdf<'a>, MicrofacetReflection<'a>) {
        match &self.rough {
            Some((roughness, losses)) => {
                let lobe = MicrofacetReflection::new(roughness.at(si), fresnel);
                (roughness.bsdf(si), lobe.and_multiple(losses, mean))
            }
            None => (Bsdf::isotropic(si), MicrofacetReflection::new([0.0; 2], fresnel)),
        }
    }
}
