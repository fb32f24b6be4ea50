//! Integer hashing: where random numbers come from.

use super::SampleId;

/// A well-mixed 64-bit number for every (seed, pixel, set, index, dimension).
///
/// Each word is folded in by one round of [`mix`], so that no two of them can cancel. The round of the
/// seed is the caller's, who has to do it only once: `mixed_seed` is [`mix`] of a seed. Without it, the
/// pixels of one seed would be those of the next in another order.
#[inline]
pub fn hash(mixed_seed: u64, id: SampleId, dimension: u32) -> u64 {
    hash_in_set(hash_set(mixed_seed, id), id.index, dimension)
}

/// The part of [`hash`] that all samples of a set share.
#[inline]
pub fn hash_set(mixed_seed: u64, id: SampleId) -> u64 {
    let pixel = mix(mixed_seed ^ (u64::from(id.pixel.x) << 32 | u64::from(id.pixel.y)));
    // Most pixels have one set: it costs no round.
    if id.set == 0 { pixel } else { mix(pixel ^ u64::from(id.set)) }
}

/// The rest of [`hash`].
#[inline]
pub fn hash_in_set(set: u64, index: u32, dimension: u32) -> u64 {
    mix(set.wrapping_add(u64::from(index) << 32 | u64::from(dimension)))
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
/// No table, so no state: rounds of keyed add, multiply and shift permute the next power of two, and
/// an element that falls outside of the range is sent on until it lands inside (cycle walking; the
/// idea is section 3 of Kensler 2013, "Correlated Multi-Jittered Sampling"). A last rotation makes
/// every place equally likely for every element.
///
/// The number of rounds is what it takes until pairs of places are uniform too, to 0.5 %: each round
/// halves what is left of their bias on the shortest lengths, and takes more off on longer ones.
#[inline]
pub fn permute(i: u32, length: u32, key: u64) -> u32 {
    let mask = u32::MAX.checked_shr((length - 1).leading_zeros()).unwrap_or(0);
    let half = mask.count_ones().div_ceil(2).max(1);
    let rounds = if length <= 16 { 12 } else { 8 };
    let rotation = mix(key);
    let mut i = i;
    loop {
        let mut round_key = key;
        for _ in 0..rounds {
            let factor = (round_key >> 32) as u32 | 1;
            i = i.wrapping_add(round_key as u32).wrapping_mul(factor) & mask;
            i ^= i >> half;
            // A multiplicative congruential step (multiplier of Steele and Vigna 2021), with its
            // strong upper bits brought down to where short lengths look.
            round_key = round_key.wrapping_mul(0xd134_2543_de82_ef95).rotate_left(29) ^ rotation;
        }
        if i < length {
            break;
        }
    }
    ((u64::from(i) + (rotation >> 32)) % u64::from(length)) as u32
}
