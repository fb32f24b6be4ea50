//! [`Texture`], the trait of textures, and how materials store them.

use std::sync::Arc;

use crate::interaction::{HitBlock, SurfaceInteraction};
use crate::spectrum::Spectrum;

/// A function from points on surfaces to values of type `T`: `f32` for roughness or displacement,
/// [`Spectrum`] for colours. Constants and closures are textures too.
///
/// ```
/// use lobe::MatteMaterial;
/// use lobe::Spectrum;
/// use lobe::interaction::SurfaceInteraction;
/// use lobe::material::DetailedMaterial;
/// use lobe::texture::Texture;
///
/// /// Stripes along u, each of the given width.
/// struct Stripes(f32);
///
/// impl Texture<f32> for Stripes {
///     fn evaluate(&self, si: &SurfaceInteraction) -> f32 {
///         (si.uv().x / self.0).floor().rem_euclid(2.0)
///     }
/// }
///
/// let heights = |si: &SurfaceInteraction| Spectrum::splat(si.p().y.clamp(0.0, 1.0));
/// let striped = DetailedMaterial::new(MatteMaterial::new(heights)).with_bump(Stripes(0.1));
/// ```
pub trait Texture<T>: Send + Sync {
    /// The value at a hit. The interaction computes only the quantities that this method reads.
    fn evaluate(&self, si: &SurfaceInteraction) -> T;

    /// The values at a block of hits, each of which [`evaluate`](Self::evaluate) would return, in their order. `values` is as
    /// long as there are hits, and what it holds before has no meaning: every value has to be set. The provided method is compiled for
    /// each texture, so that a block costs one call through a pointer.
    fn evaluate_block(&self, hits: &HitBlock, values: &mut [T]) {
        for (i, value) in values.iter_mut().enumerate() {
            *value = self.evaluate(&hits.get(i));
        }
    }

    /// The value, if it is the same everywhere: it is then stored in place and read without a call.
    fn constant(&self) -> Option<T> {
        None
    }

    /// Converts the texture to the form in which materials store it.
    fn into_handle(self) -> TextureHandle<T>
    where
        Self: Sized + 'static,
    {
        self.constant()
            .map_or_else(|| TextureHandle::Shared(Arc::new(self)), TextureHandle::Constant)
    }
}

/// A texture as materials store it: a constant in place, or any other texture behind a pointer.
///
/// [`Texture::into_handle`] makes one. `benches/shading.rs` measures what a constant saves.
#[derive(Clone)]
pub enum TextureHandle<T> {
    /// The same value everywhere.
    Constant(T),
    /// A texture that may be shared between materials.
    Shared(Arc<dyn Texture<T>>),
}

impl<T: Copy + Send + Sync + 'static> Texture<T> for TextureHandle<T> {
    #[inline]
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        match self {
            Self::Constant(value) => *value,
            Self::Shared(texture) => texture.evaluate(si),
        }
    }

    fn evaluate_block(&self, hits: &HitBlock, values: &mut [T]) {
        match self {
            Self::Constant(value) => values.fill(*value),
            Self::Shared(texture) => texture.evaluate_block(hits, values),
        }
    }

    fn constant(&self) -> Option<T> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::Shared(_) => None,
        }
    }

    fn into_handle(self) -> Self {
        self
    }
}

impl<T, F: Fn(&SurfaceInteraction) -> T + Send + Sync> Texture<T> for F {
    #[inline]
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        self(si)
    }
}

impl<T: 'static> Texture<T> for Arc<dyn Texture<T>> {
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        (**self).evaluate(si)
    }

    fn evaluate_block(&self, hits: &HitBlock, values: &mut [T]) {
        (**self).evaluate_block(hits, values);
    }

    fn constant(&self) -> Option<T> {
        (**self).constant()
    }

    fn into_handle(self) -> TextureHandle<T> {
        (*self).constant().map_or(TextureHandle::Shared(self), TextureHandle::Constant)
    }
}

impl<T: 'static, X: Texture<T> + 'static> Texture<T> for Arc<X> {
    fn evaluate(&self, si: &SurfaceInteraction) -> T {
        (**self).evaluate(si)
    }

    fn evaluate_block(&self, hits: &HitBlock, values: &mut [T]) {
        (**self).evaluate_block(hits, values);
    }

    fn constant(&self) -> Option<T> {
        (**self).constant()
    }

    fn into_handle(self) -> TextureHandle<T> {
        (self as Arc<dyn Texture<T>>).into_handle()
    }
}

/// Values are constant textures.
macro_rules! values {
    ($($value:ty as $t:ty),*) => {$(
        impl Texture<$t> for $value {
            #[inline]
            fn evaluate(&self, _: &SurfaceInteraction) -> $t {
                (*self).into()
            }

            fn constant(&self) -> Option<$t> {
                Some((*self).into())
            }
        }
    )*};
}

values!(f32 as f32, Spectrum as Spectrum, [f32; 3] as Spectrum);
