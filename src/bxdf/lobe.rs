//! [`Lobe`]: what a [`Bsdf`](super::Bsdf) holds, and the one list of the crate's own models.

use glam::{Vec2, Vec3};

use super::{BxDF, BxdfFlags, BxdfSample};
use crate::spectrum::Spectrum;

/// Makes [`Lobe`] from the names of the crate's own models.
macro_rules! lobes {
    ($($model:ident),* $(,)?) => {
        /// A lobe in place: one of this crate's models, or a reference to anyone's.
        ///
        /// The crate's own are told apart by a branch that inlines; others cost a virtual call.
        /// `benches/shading.rs` has the figures that this choice was made on.
        #[derive(Clone, Copy)]
        pub enum Lobe<'a> {
            $(
                #[doc = concat!("See [`", stringify!($model), "`](super::", stringify!($model), ").")]
                $model(super::$model),
            )*
            /// A model from elsewhere: one that its material holds, or that stands in an
            /// [`Arena`](super::Arena::lobe).
            Custom(&'a dyn BxDF),
        }

        $(
            impl From<super::$model> for Lobe<'_> {
                #[inline]
                fn from(bxdf: super::$model) -> Self {
                    Self::$model(bxdf)
                }
            }
        )*

        /// Passes a call on to whichever model the lobe is.
        macro_rules! each {
            ($lobe:expr, $bxdf:ident => $call:expr) => {
                match $lobe {
                    $(Lobe::$model($bxdf) => $call,)*
                    Lobe::Custom($bxdf) => $call,
                }
            };
        }
    };
}

lobes!(LambertianReflection, OrenNayar);

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
