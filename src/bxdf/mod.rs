//! Reflection models: the trait [`BxDF`], one model per file, and [`Bsdf`], their sum at a hit.
//!
//! All models use shading coordinates: the z axis is the shading normal, and `wo` and `wi` are unit
//! vectors that both point away from the surface. [`Bsdf`] converts from and to world space.

mod arena;
mod block;
mod bsdf;
mod coated;
mod coated_diffuse;
mod eon;
pub mod fresnel;
mod fresnel_microfacet;
mod fresnel_specular;
mod lambertian;
mod lambertian_transmission;
mod lobe;
mod microfacet;
mod microfacet_reflection;
mod oren_nayar;
mod retro_reflection;
mod scaled;
mod shares;
mod specular_reflection;
mod specular_transmission;
mod thin_fresnel_specular;
mod traits;
mod wide;
mod wide_lobe;

pub use arena::Arena;
pub use block::BsdfBlock;
pub(crate) use block::BsdfSamples;
pub use bsdf::Bsdf;
pub(crate) use coated::Coated;
pub use coated_diffuse::CoatedDiffuse;
pub use eon::EnergyPreservingOrenNayar;
pub use fresnel_microfacet::FresnelMicrofacet;
pub use fresnel_specular::FresnelSpecular;
pub use lambertian::LambertianReflection;
pub use lambertian_transmission::LambertianTransmission;
pub use lobe::{Lobe, MAX_LOBES};
pub use microfacet::{BoundaryLosses, Ggx, Losses, Roughnesses};
pub use microfacet_reflection::MicrofacetReflection;
pub use oren_nayar::OrenNayar;
pub use retro_reflection::RetroReflection;
pub use scaled::ScaledBxDF;
pub use specular_reflection::SpecularReflection;
pub use specular_transmission::SpecularTransmission;
pub use thin_fresnel_specular::ThinFresnelSpecular;
pub use traits::{BxDF, BxdfFlags, BxdfSample};
use wide::{WideBxdf, cosine_pdf, cosine_sample};
pub(crate) use wide_lobe::WideLobe;
