//! Owen scrambling by hashing: random permutations that keep binary nets.
//!
//! A nested uniform scramble (Owen 1995) flips each binary digit of a number by a coin that depends on the digits
//! above it. Where a multiplication carries upwards, all bits depend on those below, so the hash works on numbers
//! whose bits stand in reverse: bit 0 is the first digit behind the point (Burley 2020, "Practical Hash-based Owen
//! Scrambling", section 3).

use super::hash::unit_float;

/// Scrambles a number whose bits stand in reverse; every seed gives another scramble. What comes out stands in
/// reverse too.
///
/// The upper half of each word counts for nothing and holds nothing of use: where two words of 64 bits go through
/// together, the oldest of vector units can multiply them. The seed's lower half should be well mixed.
///
/// The steps and constants are those of Vegdahl 2021, "Building a Better LK Hash", final hash.
#[inline]
pub fn scramble(reversed: u64, seed: u64) -> u64 {
    let times = |a: u64, b: u64| u64::from(a as u32) * u64::from(b as u32);
    let x = reversed ^ times(reversed, 0x3d20_adea);
    let x = x.wrapping_add(seed);
    let x = times(x, u64::from(seed as u32 >> 16 | 1));
    let x = x ^ times(x, 0x0552_6c56);
    x ^ times(x, 0x53a2_2864)
}

/// The number in `[0, 1)` whose bits stand in reverse.
#[inline]
pub fn unit_float_reversed(bits: u32) -> f32 {
    unit_float(bits.reverse_bits())
}

/// How many samples share what [`shuffle_block`] has to compute.
pub const BLOCK: u32 = 16;

/// Where the aligned block of [`BLOCK`] indices with `index` begins after a nested uniform scramble of all indices,
/// which keeps aligned blocks of any power of two together.
#[inline]
pub fn shuffle_block(index: u32, seed: u32) -> u32 {
    let reversed = (index & !(BLOCK - 1)).reverse_bits();
    (scramble(reversed.into(), seed.into()) as u32).reverse_bits() & !(BLOCK - 1)
}

/// The place that `index` has within its block, by 15 coins: one for the first of the four digits, two for the
/// second, by the first, and so on.
#[inline]
pub fn shuffle_within_block(index: u32, coins: u32) -> usize {
    let place = index & (BLOCK - 1);
    let coin = |number: u32| coins >> number & 1;
    let flips = coin(0) << 3
        | coin(1 + (place >> 3)) << 2
        | coin(3 + (place >> 2)) << 1
        | coin(7 + (place >> 1));
    (place ^ flips) as usize
}
