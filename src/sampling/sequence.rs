//! A sequence of points in four dimensions that is a net in base 4, and in base 2 in each of its two pairs.
//!
//! Coordinates c = 0, 1, 2, 3 belong to the elements 0, 1, w, w² of the field of four elements: Faure's
//! construction of a (0, 4)-sequence (Faure 1982, for fields Niederreiter 1987) with the powers of Pascal's matrix
//! as generators. Digits of base 4 are pairs of bits. With the sum of its two bits for the first bit of each digit
//! of coordinates 1 and 3, coordinates (0, 1), which then are Sobol's first two, and (2, 3) are (0, 2)-sequences in
//! base 2: Ahmed 2024, "SZ Sequences: Binary-Constructed (0, 2^q)-Sequences", has the general case.
//!
//! A binomial coefficient is odd where the bits of one number hold those of the other (Lucas), so a power of
//! Pascal's matrix is a product of one step for each bit of the digits' numbers, and no table is needed.
//! All numbers stand in reverse: bit 0 is the first digit behind the point.

use super::owen::BLOCK;

/// The points of a half of the four coordinates: its pair at `index`, with bits in reverse.
#[inline]
pub const fn pair(index: u32, half: u32) -> [u32; 2] {
    if half == 0 {
        [index, sum_first(pascal(index, [1; 4]))]
    } else {
        [pascal(index, [2, 3, 2, 3]), sum_first(pascal(index, [3, 2, 3, 2]))]
    }
}

/// [`pair`] of the first indices, by half. It is linear: pairs of two indices without common bits combine by XOR.
pub const FIRST_PAIRS: [[[u32; 2]; BLOCK as usize]; 2] = {
    let mut pairs = [[[0; 2]; BLOCK as usize]; 2];
    let mut i = 0;
    while i < 2 * BLOCK {
        pairs[(i / BLOCK) as usize][(i % BLOCK) as usize] = pair(i % BLOCK, i / BLOCK);
        i += 1;
    }
    pairs
};

/// Pascal's matrix to the power of a field element x times the digits of `v`; `powers` are x, x², x⁴, x⁸.
#[inline]
const fn pascal(mut v: u32, powers: [u32; 4]) -> u32 {
    v ^= times(v >> 2 & 0x3333_3333, powers[0]);
    v ^= times(v >> 4 & 0x0f0f_0f0f, powers[1]);
    v ^= times(v >> 8 & 0x00ff_00ff, powers[2]);
    v ^ times(v >> 16, powers[3])
}

/// Sixteen digits times a field element: 1, 2 for w, or 3 for w² = w + 1.
#[inline]
const fn times(v: u32, x: u32) -> u32 {
    let (low, high) = (v & 0x5555_5555, v >> 1 & 0x5555_5555);
    match x {
        2 => (low ^ high) << 1 | high,
        3 => low << 1 | (low ^ high),
        _ => v,
    }
}

/// Puts the sum of both bits of each digit in the place of its first.
#[inline]
const fn sum_first(v: u32) -> u32 {
    v ^ (v >> 1 & 0x5555_5555)
}
