//! Owen scrambling and shuffling by hashing.
//!
//! A nested uniform scramble (Owen 1995) flips each binary digit of a number by a random bit that
//! depends on all digits above it. It is a random permutation that keeps binary (t, s)-nets.
//!
//! In a multiplication, carries run upwards: each bit depends on those below. So the hash works on
//! bit-reversed numbers, where bit 0 is the first binary digit after the point (Burley 2020,
//! "Practical Hash-based Owen Scrambling", section 3).

use super::hash::unit_float;

/// Nested uniform scramble of a bit-reversed number; the result is bit-reversed too. Each seed,
/// which should be well mixed, gives another scramble.
///
/// The steps and constants are those of the final hash in Vegdahl 2021, "Building a Better LK
/// Hash".
#[inline(always)]
pub fn scramble(reversed: u32, seed: u32) -> u32 {
    let x = reversed ^ reversed.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_add(seed);
    let x = x.wrapping_mul(seed >> 16 | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// The number in `[0, 1)` with these bit-reversed digits.
#[inline(always)]
pub fn unit_float_reversed(bits: u32) -> f32 {
    unit_float(bits.reverse_bits())
}

/// Samples in a block, which [`shuffle_block`] moves as a whole.
pub const BLOCK: u32 = 16;

/// The first index of the block that `index`'s block is moved to, by a nested uniform scramble of
/// all indices. Such a scramble maps aligned runs of any power of two to aligned runs.
#[inline(always)]
pub fn shuffle_block(index: u32, seed: u32) -> u32 {
    let reversed = (index & !(BLOCK - 1)).reverse_bits();
    scramble(reversed, seed).reverse_bits() & !(BLOCK - 1)
}

/// The position of `index` within its shuffled block: a nested uniform scramble of its four binary
/// digits. It takes 15 random bits (`coins`): one for the first digit, two for the second,
/// depending on the first, and so on.
#[inline(always)]
pub fn shuffle_within_block(index: u32, coins: u32) -> u32 {
    let position = index & (BLOCK - 1);
    let coin = |number: u32| coins >> number & 1;
    let flips = coin(0) << 3
        | coin(1 + (position >> 3)) << 2
        | coin(3 + (position >> 2)) << 1
        | coin(7 + (position >> 1));
    position ^ flips
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Four digits have as many nested scrambles as 15 random bits have values, and each value gives another. Seen to fail
    /// with one bit for two digits.
    #[test]
    fn every_coin_gives_another_scramble() {
        let mut scrambles = BTreeSet::new();
        for coins in 0..1 << 15 {
            let scramble: [u32; BLOCK as usize] =
                std::array::from_fn(|index| shuffle_within_block(index as u32, coins));
            // Nested: positions that share upper digits still do.
            for digits in 1..4 {
                for run in scramble.chunks(1 << digits) {
                    assert!(run.iter().all(|&to| to >> digits == run[0] >> digits), "{coins:x}");
                }
            }
            assert_eq!(scramble.iter().fold(0, |all, &to| all | 1 << to), u16::MAX, "{coins:x}");
            scrambles.insert(scramble);
        }
        assert_eq!(scrambles.len(), 1 << 15);
    }
}
