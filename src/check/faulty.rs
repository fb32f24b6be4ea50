//! [`faulty`]: lobes that are wrong on purpose, to check the check.

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use super::contract::Contract;
use crate::bxdf::{
    BxDF, BxdfFlags, BxdfSample, EnergyPreservingOrenNayar, FresnelSpecular, LambertianReflection,
};
use crate::sampling::uniform_hemisphere;
use crate::spectrum::Spectrum;

/// A lobe that is wrong on purpose. All promise to return all light.
pub struct Faulty {
    /// What is wrong.
    pub name: &'static str,
    /// The contracts that it breaks, all of which have to be named.
    pub expected: &'static [Contract],
    /// The lobe.
    pub lobe: Box<dyn BxDF>,
}

/// A right lobe, and what is put wrong in it.
struct Broken {
    lobe: Box<dyn BxDF>,
    fault: Break,
}

#[derive(Clone, Copy, PartialEq)]
enum Break {
    Density,
    DensityOfSample,
    Loss,
    OneSided,
    GrazingNan,
    AllFlags,
    EtaSquared,
    BelowHorizon,
    FresnelTwice,
    ValueOfSample,
    HalfSampled,
    OneWay,
    Together,
    ScaledDensity,
    Gain,
    HiddenNan,
    UsesUc,
}

/// Lobes that are wrong, each in another way.
pub fn faulty() -> Vec<Faulty> {
    let white = Spectrum::WHITE;
    let diffuse = || -> Box<dyn BxDF> { Box::new(LambertianReflection::new(white)) };
    let rough = || -> Box<dyn BxDF> { Box::new(EnergyPreservingOrenNayar::new(white, 0.7)) };
    let glass = || -> Box<dyn BxDF> { Box::new(FresnelSpecular::new(white, white, 1.5)) };
    let all: [(_, _, &[Contract], _); 17] = [
        (
            "a pdf of uniform directions for cosine-weighted samples",
            Break::Density,
            &[Contract::Distribution],
            diffuse(),
        ),
        (
            "samples with another pdf than pdf()",
            Break::DensityOfSample,
            &[Contract::Density],
            rough(),
        ),
        ("samples with another f than f()", Break::ValueOfSample, &[Contract::Value], rough()),
        ("lost energy", Break::Loss, &[Contract::Loss], rough()),
        ("a factor of one direction only", Break::OneSided, &[Contract::Reciprocity], diffuse()),
        ("NaN at grazing angles", Break::GrazingNan, &[Contract::Invalid], diffuse()),
        ("flags of the lobe instead of the event", Break::AllFlags, &[Contract::Event], glass()),
        (
            "a forgotten factor 1/eta²",
            Break::EtaSquared,
            &[Contract::Gain, Contract::Reciprocity],
            glass(),
        ),
        ("samples below the horizon", Break::BelowHorizon, &[Contract::Side], diffuse()),
        (
            "a coat that counts its Fresnel factor twice",
            Break::FresnelTwice,
            &[Contract::Loss],
            glass(),
        ),
        ("a part of f that is never sampled", Break::HalfSampled, &[Contract::Albedo], diffuse()),
        ("a specular event without a way back", Break::OneWay, &[Contract::Reciprocity], glass()),
        (
            "a density of f_and_pdf that is not that of pdf",
            Break::Together,
            &[Contract::Density],
            rough(),
        ),
        ("a pdf that is 2 % too small", Break::ScaledDensity, &[Contract::Integral], rough()),
        ("energy gained", Break::Gain, &[Contract::Gain], rough()),
        ("NaN where no sample lands", Break::HiddenNan, &[Contract::Invalid], diffuse()),
        ("uc used, and uses_uc false", Break::UsesUc, &[Contract::EventNumber], glass()),
    ];
    all.map(|(name, fault, expected, lobe)| Faulty {
        name,
        expected,
        lobe: Box::new(Broken { lobe, fault }),
    })
    .into()
}

/// Directions of which the grid of edges has none.
fn is_hidden(wi: Vec3) -> bool {
    wi.x < 0.0 && wi.y < 0.0
}

impl Broken {
    fn is(&self, fault: Break) -> bool {
        self.fault == fault
    }
}

impl BxDF for Broken {
    fn flags(&self) -> BxdfFlags {
        self.lobe.flags()
    }

    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let f = self.lobe.f(wo, wi);
        match self.fault {
            Break::Loss => f * 0.98,
            Break::Gain => f * 1.02,
            Break::HiddenNan if is_hidden(wi) => Spectrum::splat(f32::NAN),
            // Normalised, so that nothing is lost.
            Break::OneSided => f * (1.5 * wi.z.abs()),
            Break::GrazingNan if wi.z.abs() < 1e-3 => Spectrum::splat(f32::NAN),
            _ => f,
        }
    }

    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        let mut sample = self.lobe.sample_f(wo, uc, u)?;
        match self.fault {
            Break::HalfSampled if sample.wi.x < 0.0 => return None,
            Break::HiddenNan if is_hidden(sample.wi) => return None,
            Break::OneWay if wo.z < 0.0 => return None,
            Break::BelowHorizon if u.x < 0.01 => sample.wi.z = -sample.wi.z,
            Break::DensityOfSample => sample.pdf *= 1.02,
            Break::ValueOfSample => {
                sample.f = self.f(wo, sample.wi) * (1.0 + 0.1 * (sample.wi.z.abs() - 0.5));
                return Some(sample);
            }
            Break::AllFlags => sample.flags |= self.flags(),
            Break::EtaSquared => sample.f = sample.f * (sample.eta * sample.eta),
            Break::FresnelTwice if sample.flags.contains(BxdfFlags::REFLECTION) => {
                sample.f = sample.f * sample.pdf;
            }
            _ => {}
        }
        if !sample.is_specular() {
            sample.f = self.f(wo, sample.wi);
            if !self.is(Break::DensityOfSample) {
                sample.pdf = self.pdf(wo, sample.wi);
            }
        }
        (sample.pdf > 0.0).then_some(sample)
    }

    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        match self.fault {
            Break::Density => {
                if (wo.z > 0.0) == (wi.z > 0.0) {
                    uniform_hemisphere::pdf()
                } else {
                    0.0
                }
            }
            Break::BelowHorizon => wi.z.abs() * FRAC_1_PI,
            Break::HalfSampled if wi.x < 0.0 => 0.0,
            Break::HiddenNan if is_hidden(wi) => 0.0,
            Break::ScaledDensity => 0.98 * self.lobe.pdf(wo, wi),
            _ => self.lobe.pdf(wo, wi),
        }
    }

    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let pdf = self.pdf(wo, wi);
        (self.f(wo, wi), if self.is(Break::Together) { 1.02 * pdf } else { pdf })
    }

    fn uses_uc(&self) -> bool {
        self.lobe.uses_uc() && !self.is(Break::UsesUc)
    }
}
