//! [`Eight`]: what tests against the boxes of a node ask of vectors.

use glam::Vec4;

use super::float::{Block, LaneMask, Mask};
use super::twice::Twice;

/// Number of lanes of an [`Eight`]: children per node.
pub const ARITY: usize = 8;

/// A vector of eight f32, one for each child of a node.
pub trait Eight: Block {
    /// `self` · `factor` + `summand`: rounded once where the processor can, else twice.
    fn mul_add(self, factor: Self, summand: Self) -> Self;

    /// The lanes of a mask next to each other. Those that follow are unspecified.
    fn compress(self, mask: Mask) -> Self;

    /// The lanes of a mask next to each other, those with the largest key first: of `ids`, and of `keys`; and in which lane of `ids`
    /// the last of them was, which is known sooner. What follows is unspecified, and so is the order of keys that differ by less
    /// than 2⁻²⁰ of themselves, and of ∞ and the largest number. In lanes of the mask, of which there must be one at least, keys are above -∞, not NaN.
    fn largest_first(mask: Self::Mask, ids: Self, keys: Self) -> ([Self; 2], usize);
}

/// Without instructions for it.
impl Eight for Twice<Vec4> {
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }
    #[inline(always)]
    fn compress(self, mask: Mask) -> Self {
        let x = array(self);
        let (mut compressed, mut len) = ([0.0; ARITY], 0);
        for (lane, x) in x.into_iter().enumerate() {
            compressed[len % ARITY] = x;
            len += (mask >> lane & 1) as usize;
        }
        Self::load(&compressed)
    }
    #[inline(always)]
    fn largest_first(mask: Self::Mask, ids: Self, keys: Self) -> ([Self; 2], usize) {
        let (from_ids, from_keys) = (array(ids), array(keys));
        let (mut ids, mut keys) = ([0.0; ARITY], [f32::NEG_INFINITY; ARITY]);
        let (mut lanes, mut last) = (mask.bits(), 0);
        for len in 0..lanes.count_ones() as usize % (ARITY + 1) {
            let lane = lanes.trailing_zeros() as usize % ARITY;
            lanes &= lanes - 1;
            let (id, key) = (from_ids[lane], from_keys[lane]);
            let mut place = len;
            while place > 0 && keys[place - 1] < key {
                (ids[place], keys[place]) = (ids[place - 1], keys[place - 1]);
                place -= 1;
            }
            (ids[place], keys[place]) = (id, key);
            if place == len {
                last = lane;
            }
        }
        ([Self::load(&ids), Self::load(&keys)], last)
    }
}

#[inline(always)]
fn array(x: Twice<Vec4>) -> [f32; ARITY] {
    let mut array = [0.0; ARITY];
    x.store(&mut array);
    array
}
