//! [`Material`], the trait of materials.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::bxdf::{Arena, Bsdf, BsdfBlock};
use crate::interaction::{HitBlock, SurfaceInteraction};
use crate::params::{Fault, Key, Problem, Table};
use crate::texture::{TextureHandle, Textures};

/// Function that reads a kind of material from a scene file.
pub type Read = fn(&Table, &Textures, &Materials) -> Result<Arc<dyn Material>, Fault>;

/// What a material adds to the [cost](Table::cost) of a table: lobes take more stack than values of textures.
const COST: u32 = 4;

/// The materials of a scene file that stand above the one that is read, by name, with their costs.
#[derive(Clone, Default)]
pub struct Materials(BTreeMap<String, (Arc<dyn Material>, u32)>);

impl Materials {
    /// Adds a material, or replaces the one of that name.
    pub fn add(&mut self, name: impl Into<String>, material: Arc<dyn Material>) {
        self.add_costing(name, material, 0);
    }

    /// The same with the [cost](Table::cost) of the table that it was read from, which tables that name it are charged.
    pub fn add_costing(&mut self, name: impl Into<String>, material: Arc<dyn Material>, cost: u32) {
        self.0.insert(name.into(), (material, cost.saturating_add(COST)));
    }

    /// The material that the key's value names.
    ///
    /// # Errors
    /// If there is no material of that name; and those of [`Table::get`] and [`Table::charge`].
    pub fn get(&self, table: &Table, key: &Key<String>) -> Result<Arc<dyn Material>, Fault> {
        let name = table.get(key)?;
        let mark = table.mark(key);
        let (material, cost) = self.0.get(&name).ok_or_else(|| {
            let known = self.0.keys().map(String::as_str);
            Fault { mark, problem: Problem::unknown_name("earlier material", &name, known) }
        })?;
        table.charge(mark, *cost)?;
        Ok(material.clone())
    }
}

/// The reflection properties of a surface (PBRT 3rd edition, section 9.2).
///
/// A material evaluates its textures at a hit and adds the resulting lobes to a [`Bsdf`]. It has no access
/// to rays, lights or samplers.
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
    /// The lobes at a hit. A material with bump mapping replaces the shading geometry of `si` first.
    ///
    /// Lobes may borrow from the material, or from `arena`, which keeps them until all hits of a wave have been shaded. It may be
    /// called twice for a hit.
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a>;

    /// [Fills](BsdfBlock::fill) `bsdfs` once, with the lobes at a block of hits, as
    /// [`compute_scattering`](Self::compute_scattering) returns them for each. The provided method is compiled for each material, so
    /// that a block costs one call through a pointer. A material that is faster for several hits at a time overrides this, with
    /// bit-identical results:
    ///
    /// ```
    /// use lobe::Spectrum;
    /// use lobe::bxdf::{Arena, Bsdf, BsdfBlock, LambertianReflection};
    /// use lobe::interaction::{BLOCK, HitBlock, SurfaceInteraction};
    /// use lobe::material::Material;
    /// use lobe::texture::Texture;
    ///
    /// /// Asks its texture for all hits of a block together.
    /// struct Textured<T>(T);
    ///
    /// fn lambertian<'a>(si: &SurfaceInteraction, r: Spectrum) -> Bsdf<'a> {
    ///     let mut bsdf = Bsdf::isotropic(si);
    ///     bsdf.add(LambertianReflection::new(r));
    ///     bsdf
    /// }
    ///
    /// impl<T: Texture<Spectrum>> Material for Textured<T> {
    ///     fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
    ///         lambertian(si, self.0.evaluate(si))
    ///     }
    ///
    ///     fn scatter_block<'a>(
    ///         &'a self,
    ///         hits: &mut HitBlock,
    ///         _: &'a Arena,
    ///         bsdfs: &mut BsdfBlock<'a>,
    ///     ) {
    ///         let mut r = [Spectrum::BLACK; BLOCK];
    ///         self.0.evaluate_block(hits, &mut r[..hits.len()]);
    ///         bsdfs.fill(hits, |i, si| lambertian(si, r[i]));
    ///     }
    /// }
    /// ```
    /// A single lobe of one of the crate's models is the fastest, in a frame with arbitrary tangents ([`Bsdf::isotropic`]).
    ///
    /// # Panics
    /// Renders panic if the block is left without lobes.
    fn scatter_block<'a>(
        &'a self,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        bsdfs.fill(hits, |_, si| self.compute_scattering(si, arena));
    }

    /// The fraction of rays that the surface stops, if some pass: see
    /// [`DetailedMaterial::with_opacity`](super::DetailedMaterial::with_opacity). Scenes without such materials pay nothing. A material
    /// around another one has to forward this, or its surface has no holes.
    fn opacity(&self) -> Option<&TextureHandle<f32>> {
        None
    }

    /// Wraps the material for a scene, without a second `Arc` around one that is shared.
    #[doc(hidden)]
    fn into_arc(self) -> Arc<dyn Material>
    where
        Self: Sized + 'static,
    {
        Arc::new(self)
    }
}

/// A shared material is a material.
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

            fn scatter_block<'a>(
                &'a self,
                hits: &mut HitBlock,
                arena: &'a Arena,
                bsdfs: &mut BsdfBlock<'a>,
            ) {
                (**self).scatter_block(hits, arena, bsdfs);
            }

            fn opacity(&self) -> Option<&TextureHandle<f32>> {
                (**self).opacity()
            }

            fn into_arc(self) -> Arc<dyn Material> {
                self
            }
        }
    )*};
}

shared!(<> dyn Material, <M> M);
