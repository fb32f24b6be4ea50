//! [`Arena`]: where lobes from other crates are kept while a hit is shaded.

use bumpalo::Bump;

use super::{BxDF, Lobe};

/// Memory for the lobes of one worker. It grows to what the worst hit needs and is then used again
/// and again, so that shading does not allocate. The crate's own lobes live in the [`Bsdf`](super::Bsdf)
/// and take nothing from it.
#[derive(Debug, Default)]
pub struct Arena(Bump);

impl Arena {
    /// An empty arena, which has not allocated yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Keeps a lobe of any type until the arena is reset. The type is `Copy`, so nothing is lost
    /// when its memory is used again.
    #[inline]
    pub fn lobe<'a, B: BxDF + Copy + 'a>(&'a self, bxdf: B) -> Lobe<'a> {
        Lobe::Custom(self.0.alloc(bxdf))
    }

    /// Forgets all lobes and keeps the memory.
    #[inline]
    pub fn reset(&mut self) {
        self.0.reset();
    }
}
