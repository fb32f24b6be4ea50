//! Reflection models: the trait [`BxDF`], one model per file, and [`Bsdf`], their sum at a hit.
//!
//! All models use shading coordinates: the z axis is the shading normal, and `wo` and `wi` are unit
//! vectors that both point away from the surface. [`Bsdf`] converts from and to world space.

mod arena;
mod block;
mod bsdf;
mod eon;
pub mod fresnel;
mod fresnel_specular;
mod lambertian;
mod lobe;
mod oren_nayar;
mod scaled;
mod specular_reflection;
mod specular_transmission;
mod traits;
mod wide;

pub use arena::Arena;
pub use block::BsdfBlock;
pub(crate) use block::BsdfSamples;
pub use bsdf::{Bsdf, MAX_LOBES};
pub use eon::EnergyPreservingOrenNayar;
pub use fresnel_specular::FresnelSpecular;
pub use lambertian::LambertianReflection;
pub use lobe::Lobe;
pub use oren_nayar::OrenNayar;
pub use scaled::ScaledBxDF;
pub use specular_reflection::SpecularReflection;
pub use specular_transmission::SpecularTransmission;
pub use traits::{BxDF, BxdfFlags, BxdfSample};
pub(crate) use wide::WideBxdf;
use wide::{cosine_pdf, cosine_sample};
