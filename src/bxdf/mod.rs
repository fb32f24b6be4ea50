//! Reflection models: the trait [`BxDF`], one model per file, and [`Bsdf`], their sum at a hit.
//!
//! All models use shading coordinates: the z axis is the shading normal, and `wo` and `wi` are unit
//! vectors that both point away from the surface. [`Bsdf`] converts from and to world space.

mod arena;
mod block;
mod bsdf;
mod lambertian;
mod lobe;
mod oren_nayar;
mod scaled;
mod traits;
mod wide;

pub use arena::Arena;
pub use block::BsdfBlock;
pub(crate) use block::BsdfSamples;
pub use bsdf::{Bsdf, MAX_LOBES};
pub use lambertian::LambertianReflection;
pub use lobe::Lobe;
pub use oren_nayar::OrenNayar;
pub use scaled::ScaledBxDF;
pub use traits::{BxDF, BxdfFlags, BxdfSample};
use wide::{WideBxdf, cosine_pdf, cosine_sample};
