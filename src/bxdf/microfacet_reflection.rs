//! [`MicrofacetReflection`]: glossy reflection.

use glam::{Vec2, Vec3};

use super::fresnel::Fresnel;
use super::microfacet::{Ggx, Losses, Spread, above, flipped};
use super::{BxDF, BxdfFlags, BxdfSample, SpecularReflection, WideBxdf, specular_reflection};
use crate::geometry::Xyz;
use crate::simd::{Block, Float};
use crate::spectrum::{Bands, Spectrum};

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

/// [`MicrofacetReflection`] of any number, by rough surfaces of one material.
#[derive(Clone, Copy)]
pub struct FacetsModel<'a> {
    fresnel: Fresnel,
    losses: Option<&'a Losses>,
}

impl PartialEq for FacetsModel<'_> {
    fn eq(&self, other: &Self) -> bool {
        let [a, b] = [self, other].map(|facets| facets.losses.map(std::ptr::from_ref));
        self.fresnel == other.fresnel && a == b
    }
}

/// Two directions, mirrored so that the first is above the surface.
struct Pair<F: Float> {
    ggx: Ggx<F>,
    wo: Xyz<F>,
    wi: Xyz<F>,
    /// What one facet does not return of light from `wo`.
    lost: F,
    /// Whether the second is above too.
    is_reflected: F::Mask,
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

    /// What it has in common with other lobes of its material, where the surface is rough.
    #[inline(always)]
    pub(super) fn model(&self) -> FacetsModel<'a> {
        FacetsModel { fresnel: self.fresnel, losses: self.losses }
    }

    /// Of rough dielectric facets without multiple scattering: the index of refraction.
    #[inline(always)]
    pub(super) fn eta(&self) -> Option<f32> {
        match self.fresnel {
            Fresnel::Dielectric { eta } if self.losses.is_none() && !self.is_smooth() => Some(eta),
            _ => None,
        }
    }

    /// The numbers of the lobe.
    #[inline(always)]
    pub(super) fn numbers(&self) -> [f32; 7] {
        let (ggx, [r, g, b]) = (self.ggx, self.multiple);
        let [ax, ay] = ggx.alpha();
        let [alpha2, log] = match self.losses {
            Some(_) => Spread::new(ggx.mean_alpha()).numbers,
            None => [0.0; 2],
        };
        [ax, ay, r, g, b, alpha2, log]
    }

    /// Whether the surface is smooth to f32.
    #[inline]
    pub(super) fn is_smooth(&self) -> bool {
        self.ggx.rough().is_none()
    }

    /// The surface as a specular one.
    #[inline]
    fn smooth(&self) -> SpecularReflection {
        SpecularReflection::new(Spectrum::WHITE, self.fresnel)
    }
}

impl FacetsModel<'_> {
    #[inline(always)]
    fn pair<F: Block>(self, lobe: [F; 7], wo: Xyz<F>, wi: Xyz<F>) -> Pair<F> {
        let [ax, ay, ..] = lobe;
        let (ggx, [wo, wi]) = (Ggx::of([ax, ay]), above([wo, wi]));
        Pair { ggx, wo, wi, lost: self.lost(&ggx, wo), is_reflected: wi.z.gt(F::splat(0.0)) }
    }

    /// What one facet does not return of light from a direction above.
    #[inline(always)]
    fn lost<F: Block>(self, ggx: &Ggx<F>, w: Xyz<F>) -> F {
        match self.losses {
            Some(losses) => losses.at(ggx, w),
            None => F::splat(0.0),
        }
    }

    #[inline(always)]
    fn value<F: Block>(self, lobe: [F; 7], pair: &Pair<F>) -> Bands<F> {
        let &Pair { ggx, wo, wi, lost, is_reflected } = pair;
        let (half, sum) = (F::splat(0.5), wo + wi);
        // wo · m, from the length of the sum.
        let cos = (half * sum.length_squared().sqrt()).min(F::splat(1.0));
        let single = half * ggx.distribution(sum) * ggx.twice_the_visibility(wo, wi);
        let mut f = self.fresnel.above(cos) * single;
        if let Some(losses) = self.losses {
            let [_, _, r, g, b, ..] = lobe;
            f = f + Bands([r, g, b]) * (lost * losses.at(&ggx, wi));
        }
        f.only(is_reflected)
    }

    #[inline(always)]
    fn density<F: Block>(self, lobe: [F; 7], pair: &Pair<F>) -> F {
        let &Pair { ggx, wo, wi, lost, is_reflected } = pair;
        let mut pdf = ggx.reflected_bounded(wo, wo + wi);
        if self.losses.is_some() {
            let [.., alpha2, log] = lobe;
            let multiple = Spread { numbers: [alpha2, log] }.pdf(wi.z);
            pdf = (F::splat(1.0) - lost) * pdf + lost * multiple;
        }
        F::select(is_reflected, pdf, F::splat(0.0))
    }
}

impl WideBxdf<7> for FacetsModel<'_> {
    #[inline(always)]
    fn uses_uc(self) -> bool {
        self.losses.is_some()
    }

    #[inline(always)]
    fn f<F: Block>(self, lobe: [F; 7], wo: Xyz<F>, wi: Xyz<F>) -> Bands<F> {
        self.value(lobe, &self.pair(lobe, wo, wi))
    }

    #[inline(always)]
    fn pdf<F: Block>(self, lobe: [F; 7], wo: Xyz<F>, wi: Xyz<F>) -> F {
        self.density(lobe, &self.pair(lobe, wo, wi))
    }

    #[inline(always)]
    fn f_and_pdf<F: Block>(self, lobe: [F; 7], wo: Xyz<F>, wi: Xyz<F>) -> (Bands<F>, F) {
        let pair = self.pair(lobe, wo, wi);
        (self.value(lobe, &pair), self.density(lobe, &pair))
    }

    #[inline(always)]
    fn sample<F: Block>(self, lobe: [F; 7], wo: Xyz<F>, uc: F, u: [F; 2]) -> Xyz<F> {
        let [ax, ay, .., alpha2, log] = lobe;
        let (ggx, [up, _]) = (Ggx::of([ax, ay]), above([wo, wo]));
        let m = ggx.sample_bounded(up, u);
        let mut wi = m * (F::splat(2.0) * up.dot(m)) - up;
        if self.losses.is_some() {
            let multiple = Spread { numbers: [alpha2, log] }.sample(u);
            wi = Xyz::select(uc.lt(self.lost(&ggx, up)), multiple, wi);
        }
        flipped(wo.z.lt(F::splat(0.0)), wi)
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
        if self.is_smooth() {
            return Spectrum::BLACK;
        }
        self.model().f(self.numbers(), wo.into(), wi.into()).into()
    }

    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        if self.is_smooth() {
            let up = Vec3::new(wo.x, wo.y, wo.z.abs());
            let sample = self.smooth().sample_f(up, uc, u)?;
            return Some(BxdfSample { wi: specular_reflection::mirrored(wo), ..sample });
        }
        let (model, lobe, wo) = (self.model(), self.numbers(), wo.into());
        let wi = model.sample(lobe, wo, uc, u.to_array());
        let (f, pdf) = model.f_and_pdf(lobe, wo, wi);
        (pdf > 0.0).then(|| BxdfSample::glossy(f.into(), wi.into(), pdf))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if self.is_smooth() {
            return 0.0;
        }
        self.model().pdf(self.numbers(), wo.into(), wi.into())
    }

    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        if self.is_smooth() {
            return (Spectrum::BLACK, 0.0);
        }
        let (f, pdf) = self.model().f_and_pdf(self.numbers(), wo.into(), wi.into());
        (f.into(), pdf)
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
