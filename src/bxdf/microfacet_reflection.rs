//! [`MicrofacetReflection`]: glossy reflection.

use glam::{Vec2, Vec3};

use super::fresnel::Fresnel;
use super::microfacet::{Ggx, Losses, above, flipped, multiple};
use super::{BxDF, BxdfFlags, BxdfSample, SpecularReflection, specular_reflection};
use crate::spectrum::Spectrum;

/// Reflection by the facets of a rough surface, which have the distribution [`Ggx`] and reflect light by Fresnel's equations.
///
/// f = F(wo · m) D(m) G(wo, wi) / (4 cos θo cos θi), where m is between wo and wi (Torrance and Sparrow 1967; PBRT 3rd edition,
/// section 8.4.4). It leaves out light that meets a second facet: up to 69 % of what all facets reflect. With
/// [`and_multiple`](Self::and_multiple), that comes back: a metal that reflects all light is white at every angle and roughness within
/// 6e-4, if the losses are those of its own roughness. Directions are drawn by bounded spherical caps.
///
/// Both sides look alike. Surfaces that f32 does not tell from smooth ones, with a roughness below [`Ggx::MIN_ALPHA`], are specular.
#[doc(alias = "glossy")]
#[doc(alias = "ggx")]
#[doc(alias = "torrance-sparrow")]
#[derive(Clone, Copy, Debug)]
pub struct MicrofacetReflection<'a> {
    ggx: Ggx,
    fresnel: Fresnel,
    /// Factor of the second lobe.
    multiple: [f32; 3],
    losses: Option<&'a Losses>,
}

impl<'a> MicrofacetReflection<'a> {
    /// Reflection by one facet. `alpha` is the roughness along x and along y, in `[0, 1]`.
    #[inline]
    pub fn new(alpha: [f32; 2], fresnel: Fresnel) -> Self {
        Self { ggx: Ggx::or_smooth(alpha), fresnel, multiple: [0.0; 3], losses: None }
    }

    /// Adds reflection by several facets. `losses` are those [of mirrors](Losses::of_mirrors) with this roughness, and `mean` is the
    /// [mean](Fresnel::mean) of the Fresnel reflectance F.
    ///
    /// What is lost goes to all directions in proportion to their losses, and is dimmed by F̄² Ē / (1 - F̄ (1 - Ē)), with Ē the mean albedo
    /// of mirrors: light that meets at least two facets, with the mean reflectance at each (Jakob et al. 2014; Kulla and Conty 2017).
    #[inline]
    pub fn and_multiple(self, losses: &'a Losses, mean: Spectrum) -> Self {
        let Some(ggx) = self.ggx.rough() else { return self };
        let lost = losses.mean(&ggx);
        let factor = |f: f32| f * f * (1.0 - lost) / (1.0 - f * lost);
        let scale = if lost > 0.0 { std::f32::consts::FRAC_1_PI / lost } else { 0.0 };
        let [r, g, b] = mean.to_array();
        let multiple = [factor(r) * scale, factor(g) * scale, factor(b) * scale];
        Self { multiple, losses: Some(losses), ..self }
    }

    /// What one facet does not return of light from a direction above.
    #[inline]
    fn lost(&self, ggx: &Ggx, w: Vec3) -> f32 {
        self.losses.map_or(0.0, |losses| losses.at(ggx, w))
    }

    /// The surface as a specular one.
    #[inline]
    fn smooth(&self) -> SpecularReflection {
        SpecularReflection::new(Spectrum::WHITE, self.fresnel)
    }
}

impl BxDF for MicrofacetReflection<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        let spread = match self.ggx.rough() {
            Some(_) => BxdfFlags::GLOSSY,
            None => BxdfFlags::SPECULAR,
        };
        BxdfFlags::REFLECTION | spread
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let [up, wi] = above(wo, wi);
        let Some(ggx) = self.ggx.rough().filter(|_| wi.z > 0.0) else { return Spectrum::BLACK };
        let sum = up + wi;
        // wo · m, from the length of the sum.
        let cos = (0.5 * sum.length()).min(1.0);
        let once = 0.5 * ggx.area(sum.into()) * ggx.seen_by_both(up.into(), wi.into());
        let once = self.fresnel.evaluate(cos) * once;
        match self.losses {
            Some(_) => {
                once + Spectrum::from(self.multiple) * (self.lost(&ggx, up) * self.lost(&ggx, wi))
            }
            None => once,
        }
    }

    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        let [up, _] = above(wo, wo);
        let Some(ggx) = self.ggx.rough() else {
            let sample = self.smooth().sample_f(up, uc, u)?;
            return Some(BxdfSample { wi: specular_reflection::mirrored(wo), ..sample });
        };
        let lost = self.lost(&ggx, up);
        let wi = if uc < lost {
            multiple::sample(ggx.mean_alpha(), u)
        } else {
            let m: Vec3 = ggx.sample_bounded(up.into(), u.to_array()).into();
            2.0 * up.dot(m) * m - up
        };
        let wi = if wo.z < 0.0 { flipped(wi) } else { wi };
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0).then(|| BxdfSample::glossy(self.f(wo, wi), wi, pdf))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let [wo, wi] = above(wo, wi);
        let Some(ggx) = self.ggx.rough().filter(|_| wi.z > 0.0) else { return 0.0 };
        let once = ggx.reflected_bounded(wo.into(), (wo + wi).into());
        let lost = self.lost(&ggx, wo);
        if lost > 0.0 {
            (1.0 - lost) * once + lost * multiple::pdf(ggx.mean_alpha(), wi.z)
        } else {
            once
        }
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        self.losses.is_some()
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        self.fresnel.evaluate(wo.z.abs()).max_component()
    }
}
