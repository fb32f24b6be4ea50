//! Integer hashing: where random numbers come from.

use super::SampleId;

/// A well-mixed 64-bit number for every (seed, pixel, index, dimension).
///
/// Each word is folded in by one round of [`mix`], so that no two of them can cancel.
#[inline]
pub fn hash(seed: u64, id: SampleId, dimension: u32) -> u64 {
    let pixel = mix(seed ^ (u64::from(id.pixel.x) << 32 | u64::from(id.pixel.y)));
    mix(pixel.wrapping_add(u64::from(id.index) << 32 | u64::from(dimension)))
}

/// A bijection of 64-bit numbers that changes each output bit with probability 1/2 for every changed
/// input bit: the finaliser of Steele et al. 2014, "Fast Splittable Pseudorandom Number Generators"
/// (SplitMix64, with the constants of Stafford's mix 13), after its additive step.
#[inline]
pub fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

/// The upper 24 bits of `bits` as a multiple of 2⁻²⁴ in `[0, 1)`.
///
/// 24 bits are what a float below 1 can hold: with more, rounding would give 1.
#[inline]
pub fn unit_float(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / (1 << 24) as f32)
}

/// Element `i` of a random permutation of `0..length` that `key` chooses, for i < length.
///
/// No table, so no state: rounds of keyed multiply, add and shift permute the next power of two, and
/// an element that falls outside of the range is sent on until it lands inside (cycle walking; the
/// idea is section 3 of Kensler 2013, "Correlated Multi-Jittered Sampling"). A last rotation makes
/// every place equally likely for every element.
#[inline]
pub fn permute(i: u32, length: u32, key: u64) -> u32 {
    let mask = length.next_power_of_two().wrapping_sub(1);
    let half = (mask.count_ones() / 2).max(1);
    let mut i = i;
    loop {
        for round in 0..4 {
            let factor = (key >> (8 * round)) as u32 | 1;
            let summand = (key >> (8 * round + 24)) as u32;
            i = i.wrapping_mul(factor).wrapping_add(summand) & mask;
            i ^= i >> half;
        }
        if i < length {
            break;
        }
    }
    ((u64::from(i) + (mix(key) >> 32)) % u64::from(length)) as u32
}
