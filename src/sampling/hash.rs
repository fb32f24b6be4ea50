//! Counter-based random numbers: integer hashes of a sample's id and dimension.

use super::sampler::SampleId;

/// 64 pseudorandom bits for each (seed, pixel, set, index, dimension).
///
/// Each word is folded in by a round of [`mix`], so that no two words can cancel. The caller does
/// the round of the seed, once: `mixed_seed` is [`mix`] of the seed. Without that round, the pixels
/// of one seed would be a permutation of those of the next.
#[inline(always)]
pub fn hash(mixed_seed: u64, id: SampleId, dimension: u32) -> u64 {
    hash_in_set(hash_set(mixed_seed, id), id.index, dimension)
}

/// The part of [`hash`] that is common to a set of samples.
#[inline(always)]
pub fn hash_set(mixed_seed: u64, id: SampleId) -> u64 {
    let pixel = mix(mixed_seed ^ (u64::from(id.pixel.x) << 32 | u64::from(id.pixel.y)));
    // Set 0 saves a round: most pixels have no other.
    if id.set == 0 { pixel } else { mix(pixel ^ u64::from(id.set)) }
}

/// The part of [`hash`] that is particular to a sample and dimension. `set` comes from
/// [`hash_set`].
#[inline(always)]
pub fn hash_in_set(set: u64, index: u32, dimension: u32) -> u64 {
    mix(set.wrapping_add(u64::from(index) << 32 | u64::from(dimension)))
}

/// A 64-bit finaliser: a bijection in which each changed input bit flips each output bit with
/// probability 1/2.
///
/// SplitMix64 with its additive step and the constants of Stafford's mix 13 (Steele et al. 2014,
/// "Fast Splittable Pseudorandom Number Generators").
#[inline(always)]
pub fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

/// The upper 24 bits of `bits` as a multiple of 2⁻²⁴ in `[0, 1)`.
///
/// An f32 below 1 holds no more: with more bits, rounding would give 1.
#[inline(always)]
pub fn unit_float(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / (1 << 24) as f32)
}
