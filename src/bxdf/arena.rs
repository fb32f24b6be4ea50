//! [`Arena`]: storage for lobes defined outside this crate, while a hit is shaded.

use bumpalo::Bump;

use super::{BxDF, Lobe};

/// Bump allocator for the lobes of one worker thread. It grows to what the most demanding hit needs and
/// is then reused, so that shading does not allocate. The crate's own lobes are stored in the
/// [`Bsdf`](super::Bsdf) and use no arena memory.
#[derive(Debug, Default)]
pub struct Arena(Bump);

impl Arena {
    /// An empty arena. Nothing is allocated yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Stores a lobe of any type until the arena is reset. The type is `Copy`, so it has no destructor that
    /// a reset would skip.
    #[inline]
    pub fn lobe<'a, B: BxDF + Copy + 'a>(&'a self, bxdf: B) -> Lobe<'a> {
        Lobe::Custom(self.0.alloc(bxdf))
    }

    /// Drops all lobes and keeps the memory.
    #[inline]
    pub fn reset(&mut self) {
        self.0.reset();
    }
}
