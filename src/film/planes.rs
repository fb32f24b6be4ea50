//! Sums as [`Plane`]s, bit by bit, so that files can hold them as channels.

use super::stored::Stored;
use crate::image::Plane;

/// What a film keeps, as the beginning of a plane's name. Behind it stands the number of the word within a pixel.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Sum,
    Squares,
    Sets,
    FirstHits,
    Largest,
}

impl Kind {
    fn name(self, word: usize) -> String {
        let name = ["sum", "squares", "sets", "hits", "largest"][self as usize];
        format!("film.{name}.{word:05}")
    }

    /// How many words a pixel has among these planes.
    pub fn words(self, planes: &[Plane]) -> usize {
        (0..).take_while(|&word| self.plane(planes, word).is_some()).count()
    }

    fn plane(self, planes: &[Plane], word: usize) -> Option<&Plane> {
        let name = self.name(word);
        planes.iter().find(|plane| plane.name == name)
    }

    /// Appends planes for the values of `pixels` pixels, each of which has as many of them.
    pub fn push<T: Stored>(self, values: &[T], pixels: usize, to: &mut Vec<Plane>) {
        let per_pixel = values.len() / pixels.max(1);
        let (start, mut bytes) = (to.len(), Vec::new());
        for values in values.chunks_exact(per_pixel.max(1)) {
            bytes.clear();
            values.iter().for_each(|value| value.store(&mut bytes));
            for (word, bytes) in bytes.as_chunks().0.iter().enumerate() {
                if start + word == to.len() {
                    to.push(Plane { name: self.name(word), values: Vec::with_capacity(pixels) });
                }
                to[start + word].values.push(u32::from_le_bytes(*bytes));
            }
        }
    }

    /// Restores the values of `pixels` pixels; `None` if planes are missing or have another size.
    pub fn restore<T: Stored>(self, values: &mut [T], pixels: usize, from: &[Plane]) -> Option<()> {
        let planes: Vec<_> =
            (0..self.words(from)).filter_map(|word| self.plane(from, word)).collect();
        if planes.iter().any(|plane| plane.values.len() != pixels) {
            return None;
        }
        let per_pixel = values.len() / pixels.max(1);
        let mut bytes = Vec::new();
        for (pixel, values) in values.chunks_exact_mut(per_pixel.max(1)).enumerate() {
            bytes.clear();
            planes.iter().for_each(|plane| plane.values[pixel].store(&mut bytes));
            let mut rest = &bytes[..];
            for value in values {
                *value = T::restore(&mut rest)?;
            }
        }
        Some(())
    }
}
