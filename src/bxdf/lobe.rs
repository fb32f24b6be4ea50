//! [`Lobe`]: an element of a [`Bsdf`](super::Bsdf), and the one list of this crate's reflection models.

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// The most lobes that one [`Bsdf`](super::Bsdf) holds (PBRT's `MaxBxDFs`).
pub const MAX_LOBES: usize = 8;

/// Defines [`Lobe`] from the lists of this crate's models: others, and those that borrow from their material.
macro_rules! lobes {
    ([$($model:ident),*], [$($borrowing:ident),*]) => {
        /// One lobe: a model of this crate, stored in place, or a reference to any other [`BxDF`].
        ///
        /// Models of this crate are dispatched by an inlined branch, others by a virtual call.
        /// `benches/shading.rs` measures both.
        #[derive(Clone, Copy)]
        #[non_exhaustive]
        pub enum Lobe<'a> {
            $(
                #[doc = concat!("See [`", stringify!($model), "`](super::", stringify!($model), ").")]
                $model(super::$model),
            )*
            $(
                #[doc = concat!("See [`", stringify!($borrowing), "`](super::", stringify!($borrowing), ").")]
                $borrowing(super::$borrowing<'a>),
            )*
            /// A model defined elsewhere, held by its material or by an [`Arena`](super::Arena::lobe).
            Custom(&'a dyn BxDF),
        }

        impl Lobe<'_> {
            /// The name of its type, or "custom" for a model defined elsewhere.
            pub const fn name(&self) -> &'static str {
                match self {
                    $(Self::$model(_) => stringify!($model),)*
                    $(Self::$borrowing(_) => stringify!($borrowing),)*
                    Self::Custom(_) => "custom",
                }
            }
        }

        $(
            impl From<super::$model> for Lobe<'_> {
                #[inline]
                fn from(bxdf: super::$model) -> Self {
                    Self::$model(bxdf)
                }
            }
        )*

        $(
            impl<'a> From<super::$borrowing<'a>> for Lobe<'a> {
                #[inline]
                fn from(bxdf: super::$borrowing<'a>) -> Self {
                    Self::$borrowing(bxdf)
                }
            }
        )*

        /// Calls the same method on whichever model the lobe holds.
        macro_rules! each {
            ($lobe:expr, $bxdf:ident => $call:expr) => {
                match $lobe {
                    $(Lobe::$model($bxdf) => $call,)*
                    $(Lobe::$borrowing($bxdf) => $call,)*
                    Lobe::Custom($bxdf) => $call,
                }
            };
        }
    };
}

lobes!(
    [
        LambertianReflection,
        OrenNayar,
        EnergyPreservingOrenNayar,
        LambertianTransmission,
        SpecularReflection,
        SpecularTransmission,
        FresnelSpecular,
        ThinFresnelSpecular
    ],
    [MicrofacetReflection, FresnelMicrofacet, CoatedDiffuse, RetroReflection]
);

// A Bsdf has room for several lobes, and moves all of it.
const _: () = assert!(size_of::<Lobe>() <= 64);

impl<'a> From<&'a dyn BxDF> for Lobe<'a> {
    #[inline]
    fn from(bxdf: &'a dyn BxDF) -> Self {
        Self::Custom(bxdf)
    }
}

impl BxDF for Lobe<'_> {
    #[inline]
    fn flags(&self) -> BxdfFlags {
        each!(self, bxdf => bxdf.flags())
    }

    #[inline]
    fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        each!(self, bxdf => bxdf.f(wo, wi))
    }

    #[inline]
    fn sample_f(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BxdfSample> {
        each!(self, bxdf => bxdf.sample_f(wo, uc, u))
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        each!(self, bxdf => bxdf.pdf(wo, wi))
    }

    #[inline]
    fn f_and_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        each!(self, bxdf => bxdf.f_and_pdf(wo, wi))
    }

    #[inline]
    fn uses_uc(&self) -> bool {
        each!(self, bxdf => bxdf.uses_uc())
    }

    #[inline]
    fn albedo_estimate(&self, wo: Vec3) -> f32 {
        each!(self, bxdf => bxdf.albedo_estimate(wo))
    }

    fn rho_hd(&self, wo: Vec3, uc: &[f32], u: &[Vec2]) -> Spectrum {
        each!(self, bxdf => bxdf.rho_hd(wo, uc, u))
    }

    fn rho_hh(&self, u1: &[Vec2], uc: &[f32], u2: &[Vec2]) -> Spectrum {
        each!(self, bxdf => bxdf.rho_hh(u1, uc, u2))
    }
}
