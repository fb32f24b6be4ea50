//! The contract of materials.

use std::sync::Arc;

use crate::bxdf::{Arena, Bsdf, LambertianReflection};
use crate::interaction::SurfaceInteraction;
use crate::params::{Fault, Table};
use crate::texture::Textures;

/// How a kind of material is read.
pub type Read = fn(&Table, &Textures) -> Result<Arc<dyn Material>, Fault>;

/// What a surface is made of.
///
/// A material evaluates its textures at a hit and adds the lobes that follow to a [`Bsdf`]. It never
/// sees a ray, a light or a sampler (PBRT 3rd edition, section 9.2).
///
/// ```
/// use lobe::bxdf::{Arena, Bsdf, LambertianReflection};
/// use lobe::interaction::SurfaceInteraction;
/// use lobe::material::Material;
///
/// /// Shows the geometric normal as a colour.
/// struct NormalColors;
///
/// impl Material for NormalColors {
///     fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
///         let mut bsdf = Bsdf::isotropic(si);
///         bsdf.add(LambertianReflection::new((si.n() * 0.5 + 0.5).into()));
///         bsdf
///     }
/// }
/// ```
pub trait Material: Send + Sync {
    /// The lobes at a hit, after the material has displaced the shading frame if it does so.
    ///
    /// Lobes may borrow from the material, or stand in `arena` until the hit has been shaded.
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a>;

    /// The one lobe that the material has at every hit and in the frame of any shading normal, if that is
    /// so. Such surfaces are shaded faster, and `compute_scattering` need not be called.
    fn constant_lambertian(&self) -> Option<LambertianReflection> {
        None
    }

    /// The material as a scene holds it.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Material>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// A material that is held elsewhere too.
macro_rules! shared {
    ($(<$($m:ident)?> $material:ty),*) => {$(
        impl$(<$m: Material + 'static>)? Material for Arc<$material> {
            #[inline]
            fn compute_scattering<'a>(
                &'a self,
                si: &mut SurfaceInteraction,
                arena: &'a Arena,
            ) -> Bsdf<'a> {
                (**self).compute_scattering(si, arena)
            }

            fn constant_lambertian(&self) -> Option<LambertianReflection> {
                (**self).constant_lambertian()
            }

            fn into_arc(self) -> Arc<dyn Material> {
                self
            }
        }
    )*};
}

shared!(<> dyn Material, <M> M);
