//! [`WideLobe`]: lobes that are evaluated for several hits at a time, and the one list of their models.

use super::coated::{CoatModel, Coated};
use super::eon::EonModel;
use super::lambertian::LambertianModel;
use super::microfacet_reflection::FacetsModel;
use super::oren_nayar::OrenNayarModel;
use super::{
    Bsdf, EnergyPreservingOrenNayar, LambertianReflection, Lobe, MicrofacetReflection, OrenNayar,
};
use crate::spectrum::Spectrum;

/// What lobes of a material have in common.
#[derive(Clone, Copy, PartialEq)]
pub enum Model<'a> {
    Lambertian(LambertianModel),
    OrenNayar(OrenNayarModel),
    Eon(EonModel),
    Facets(FacetsModel<'a>),
    Coat(CoatModel<'a>),
}

/// Runs `$call` with `$model` as the model of any type.
macro_rules! of_model {
    ($which:expr, $model:ident => $call:expr) => {
        match $which {
            $crate::bxdf::wide_lobe::Model::Lambertian($model) => $call,
            $crate::bxdf::wide_lobe::Model::OrenNayar($model) => $call,
            $crate::bxdf::wide_lobe::Model::Eon($model) => $call,
            $crate::bxdf::wide_lobe::Model::Facets($model) => $call,
            $crate::bxdf::wide_lobe::Model::Coat($model) => $call,
        }
    };
}
pub(super) use of_model;

impl Model<'_> {
    /// Whether zeros are a black lobe.
    #[inline(always)]
    pub fn has_black(self) -> bool {
        matches!(self, Self::Lambertian(_) | Self::OrenNayar(_) | Self::Eon(_))
    }
}

/// Most numbers of a lobe.
pub const MOST_NUMBERS: usize = 8;

/// A lobe as numbers, followed by zeros.
#[derive(Clone, Copy)]
pub struct WideLobe<'a> {
    pub model: Model<'a>,
    pub numbers: [f32; MOST_NUMBERS],
}

impl<'a> WideLobe<'a> {
    #[inline(always)]
    fn new<const N: usize>(model: Model<'a>, numbers: [f32; N]) -> Self {
        const { assert!(N <= MOST_NUMBERS) };
        let mut padded = [0.0; MOST_NUMBERS];
        padded[..N].copy_from_slice(&numbers);
        Self { model, numbers: padded }
    }

    /// Of one lobe or of a coat and its base; `None` of others.
    #[inline(always)]
    pub fn of(bsdf: &Bsdf<'a>) -> Option<Self> {
        let mut lobes = bsdf.lobes();
        if lobes.any(|(_, scale)| scale != Spectrum::WHITE) {
            return None;
        }
        let mut lobes = bsdf.lobes().map(|(lobe, _)| lobe);
        match (lobes.next()?, lobes.next(), lobes.next()) {
            (lobe, None, None) => lobe.try_into().ok(),
            (Lobe::MicrofacetReflection(coat), Some(Lobe::CoatedDiffuse(base)), None) => {
                Coated::new(*coat, Some(*base), base.model().losses).try_into().ok()
            }
            _ => None,
        }
    }
}

/// The lobe is none that is evaluated for several hits at a time.
pub struct IsSingle;

impl From<LambertianReflection> for WideLobe<'_> {
    #[inline(always)]
    fn from(lobe: LambertianReflection) -> Self {
        Self::new(Model::Lambertian(LambertianModel), lobe.numbers())
    }
}

impl From<OrenNayar> for WideLobe<'_> {
    #[inline(always)]
    fn from(lobe: OrenNayar) -> Self {
        Self::new(Model::OrenNayar(OrenNayarModel), lobe.numbers())
    }
}

impl From<EnergyPreservingOrenNayar> for WideLobe<'_> {
    #[inline(always)]
    fn from(lobe: EnergyPreservingOrenNayar) -> Self {
        Self::new(Model::Eon(EonModel), lobe.numbers())
    }
}

impl<'a> TryFrom<MicrofacetReflection<'a>> for WideLobe<'a> {
    type Error = IsSingle;

    #[inline(always)]
    fn try_from(lobe: MicrofacetReflection<'a>) -> Result<Self, IsSingle> {
        if lobe.is_smooth() {
            return Err(IsSingle);
        }
        Ok(Self::new(Model::Facets(lobe.model()), lobe.numbers()))
    }
}

impl<'a> TryFrom<Coated<'a>> for WideLobe<'a> {
    type Error = IsSingle;

    #[inline(always)]
    fn try_from(lobe: Coated<'a>) -> Result<Self, IsSingle> {
        let numbers = lobe.numbers().ok_or(IsSingle)?;
        Ok(Self::new(Model::Coat(lobe.model()), numbers))
    }
}

impl<'a> TryFrom<&Lobe<'a>> for WideLobe<'a> {
    type Error = IsSingle;

    #[inline(always)]
    fn try_from(lobe: &Lobe<'a>) -> Result<Self, IsSingle> {
        match *lobe {
            Lobe::LambertianReflection(lobe) => Ok(lobe.into()),
            Lobe::OrenNayar(lobe) => Ok(lobe.into()),
            Lobe::EnergyPreservingOrenNayar(lobe) => Ok(lobe.into()),
            Lobe::MicrofacetReflection(lobe) => lobe.try_into(),
            _ => Err(IsSingle),
        }
    }
}
