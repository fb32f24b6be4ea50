//! [`Permutation`]: pseudorandom permutations of any length.

use super::hash::mix;
use super::wide::{Lanes, WIDTH};

/// A pseudorandom permutation of `0..length` for each key. It is computed without a table.
///
/// Rounds of keyed addition, multiplication and shift permute the next power of two. A result out
/// of range is permuted again until it is in range (cycle walking; Kensler 2013, "Correlated
/// Multi-Jittered Sampling", section 3). A final rotation makes the position of each element
/// uniform.
///
/// With this number of rounds, the positions of pairs of elements are uniform too, within 0.5 %.
/// Each round halves the remaining bias at the shortest lengths, and reduces it more at longer
/// ones.
#[derive(Clone, Copy, Debug)]
pub struct Permutation {
    length: u32,
    /// The next power of two, less one.
    mask: u32,
    half: u32,
    rounds: u32,
}

impl Permutation {
    /// Permutations of this length, at least 1.
    #[inline(always)]
    pub fn new(length: u32) -> Self {
        let mask = u32::MAX.checked_shr((length - 1).leading_zeros()).unwrap_or(0);
        let half = mask.count_ones().div_ceil(2).max(1);
        Self { length, mask, half, rounds: if length <= 16 { 12 } else { 8 } }
    }

    /// Element `i`, less than the length.
    #[inline(always)]
    pub fn get(self, i: u32, key: u64) -> u32 {
        let rotation = mix(key);
        self.rotated(self.walked(self.permuted(i, key, rotation), key, rotation), rotation)
    }

    /// [`get`](Self::get) of each index and key.
    #[inline(always)]
    pub fn get_all(self, i: &Lanes<u32>, keys: &Lanes<u64>) -> Lanes<u32> {
        let (mut all, mut round_keys, mut rotations) = (*i, *keys, [0; WIDTH]);
        for i in 0..WIDTH {
            rotations[i] = mix(keys[i]);
        }
        for _ in 0..self.rounds {
            for i in 0..WIDTH {
                all[i] = self.round(all[i], round_keys[i]);
                round_keys[i] = next_key(round_keys[i], rotations[i]);
            }
        }
        for i in 0..WIDTH {
            all[i] = self.walked(all[i], keys[i], rotations[i]);
        }
        for i in 0..WIDTH {
            all[i] = self.rotated(all[i], rotations[i]);
        }
        all
    }

    /// All rounds.
    #[inline(always)]
    fn permuted(self, mut i: u32, key: u64, rotation: u64) -> u32 {
        let mut round_key = key;
        for _ in 0..self.rounds {
            i = self.round(i, round_key);
            round_key = next_key(round_key, rotation);
        }
        i
    }

    #[inline(always)]
    fn round(self, i: u32, key: u64) -> u32 {
        let i = i.wrapping_add(key as u32).wrapping_mul((key >> 32) as u32 | 1) & self.mask;
        i ^ i >> self.half
    }

    /// Permuted again until it is in range.
    #[inline(always)]
    fn walked(self, mut i: u32, key: u64, rotation: u64) -> u32 {
        while i >= self.length {
            i = self.permuted(i, key, rotation);
        }
        i
    }

    /// Moved on by `rotation` places, modulo the length.
    #[inline(always)]
    fn rotated(self, i: u32, rotation: u64) -> u32 {
        let by = (rotation >> 32) as u32 % self.length;
        // The sum may exceed 32 bits.
        let left = self.length - by;
        if i < left { i + by } else { i - left }
    }
}

/// A step of a multiplicative congruential generator (multiplier of Steele and Vigna 2021). The
/// rotation moves its strong upper bits down to where short lengths read them.
#[inline(always)]
fn next_key(key: u64, rotation: u64) -> u64 {
    key.wrapping_mul(0xd134_2543_de82_ef95).rotate_left(29) ^ rotation
}
