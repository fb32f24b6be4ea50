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
/// [`and_multiple`](Self::and_multiple), that comes back: a metal that reflects all light is white at every angle and roughness, within the
/// error of the [`Losses`]. Directions are drawn by bounded spherical caps.
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

/// Two directions above a rough surface.
struct Pair {
    ggx: Ggx,
    wo: Vec3,
    wi: Vec3,
    /// What one facet does not return of light from `wo`.
    lost: f32,
}

impl<'a> MicrofacetReflection<'a> {
    /// Reflection by one facet. `alpha` is the roughness along x and along y, in `[0, 1]`.
    #[inline]
    pub fn new(alpha: [f32; 2], fresnel: Fresnel) -> Self {
        Self { ggx: Ggx::or_smooth(alpha), fresnel, multiple: [0.0; 3], losses: None }
    }

    /// Adds reflection by several facets. `losses` are those [of mirrors](Losses::of_mirrors) with this roughness: a debug assertion tells
    /// others. `mean` is the [mean](Fresnel::mean) of the Fresnel reflectance F, which a material computes once.
    ///
    /// What is lost goes to all directions in proportion to their losses, and is dimmed by F̄² Ē / (1 - F̄ (1 - Ē)), with Ē the mean albedo
    /// of mirrors: light that meets at least two facets, with the mean reflectance at each (Jakob et al. 2014; Kulla and Conty 2017).
    #[inline]
    pub fn and_multiple(self, losses: &'a Losses, mean: Spectrum) -> Self {
        let Some(ggx) = self.ggx.rough() else { return self };
        debug_assert!(losses.are_of(true, &ggx), "losses of another surface");
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

    /// `None` if nothing is reflected.
    #[inline(always)]
    fn pair(&self, wo: Vec3, wi: Vec3) -> Option<Pair> {
        let [wo, wi] = above(wo, wi);
        let ggx = self.ggx.rough().filter(|_| wi.z > 0.0)?;
        Some(Pair { ggx, wo, wi, lost: self.lost(&ggx, wo) })
    }

    #[inline(always)]
    fn value(&self, &Pair { ggx, wo, wi, lost }: &Pair) -> Spectrum {
        let sum = wo + wi;
        // wo · m, from the length of the sum.
        let cos = (0.5 * sum.length()).min(1.0);
        let single =
            0.5 * ggx.distribution(sum.into()) * ggx.twice_the_visibility(wo.into(), wi.into());
        let single = self.fresnel.evaluate(cos) * single;
        match self.losses {
            Some(_) => single + Spectrum::from(self.multiple) * (lost * self.lost(&ggx, wi)),
            None => single,
        }
    }

    #[inline(always)]
    fn density(&self, &Pair { ggx, wo, wi, lost }: &Pair) -> f32 {
        let single = ggx.reflected_bounded(wo.into(), (wo + wi).into());
        if lost > 0.0 {
            (1.0 - lost) * single + lost * multiple::pdf(ggx.mean_alpha(), wi.z)
        } else {
            single
        }
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
        let Some(pair) = self.pair(wo, wi) else { return Spectrum::BLACK };
        self.value(&pair)
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
        let pair = Pair { ggx, wo: up, wi, lost };
        let pdf = if wi.z > 0.0 { self.density(&pair) } else { 0.0 };
        let wi = if wo.z < 0.0 { flipped(wi) } else { wi };
        (pdf > 0.0).then(|| BxdfSample::glossy(self.value(&pair), wi, pdf))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let Some(pair) = self.pair(wo, wi) else { return 0.0 };
        self.density(&pair)
    }

    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let Some(pair) = self.pair(wo, wi) else { return (Spectrum::BLACK, 0.0) };
        (self.value(&pair), self.density(&pair))
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
