//! Materials: they turn textures into lobes.

mod bump;
mod matte;

pub use bump::bump;
pub use matte::MatteMaterial;

use std::sync::Arc;

use crate::bxdf::{Arena, Bsdf, TransportMode};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Kind, Table};
use crate::texture::Textures;

/// How a kind of material is read.
pub type Read = fn(&Table, &Textures) -> Result<Arc<dyn Material>, Fault>;

/// All kinds of materials.
pub static MATERIALS: &[Kind<Read>] = &[matte::KIND];

/// What a surface is made of.
///
/// A material evaluates its textures at a hit and adds the lobes that follow to a [`Bsdf`]. It never
/// sees a ray, a light or a sampler (PBRT 3rd edition, section 9.2).
///
/// ```
/// use lobe::bxdf::{Arena, Bsdf, LambertianReflection, TransportMode};
/// use lobe::interaction::SurfaceInteraction;
/// use lobe::material::Material;
///
/// /// Shows the geometric normal as a colour.
/// struct NormalColors;
///
/// impl Material for NormalColors {
///     fn compute_scattering<'a>(
///         &self,
///         si: &mut SurfaceInteraction,
///         _arena: &'a Arena,
///         _mode: TransportMode,
///         _allow_multiple_lobes: bool,
///     ) -> Bsdf<'a> {
///         let mut bsdf = Bsdf::new(si.isotropic_frame(), si.n(), 1.0);
///         bsdf.add(LambertianReflection::new((si.n() * 0.5 + 0.5).into()));
///         bsdf
///     }
/// }
/// ```
pub trait Material: Send + Sync {
    /// The lobes at a hit, after the material has displaced the shading frame if it does so.
    ///
    /// `arena` keeps lobes that are not the crate's own. `mode` says what travels along the path.
    /// With `allow_multiple_lobes` the material may use one lobe that stands for several, which
    /// path tracing wants and which tells apart less.
    fn compute_scattering<'a>(
        &self,
        si: &mut SurfaceInteraction,
        arena: &'a Arena,
        mode: TransportMode,
        allow_multiple_lobes: bool,
    ) -> Bsdf<'a>;
}
