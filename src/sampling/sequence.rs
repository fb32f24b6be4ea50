//! A digital (0, 4)-sequence in base 4 whose coordinate pairs (0, 1) and (2, 3) are (0,
//! 2)-sequences in base 2.
//!
//! Faure's construction (Faure 1982; for prime powers Niederreiter 1987): coordinates c = 0, 1, 2,
//! 3 belong to the elements 0, 1, w, w² of the field of four elements, and their generator matrices
//! are powers of Pascal's matrix. A digit of base 4 is a pair of bits. In coordinates 1 and 3 the
//! first bit of each digit is replaced by the sum of its two bits. This makes both pairs (0,
//! 2)-sequences in base 2, the first of them Sobol's first two dimensions. Ahmed 2024, "SZ
//! Sequences: Binary-Constructed (0, 2^q)-Sequences", has the general case.
//!
//! A binomial coefficient is odd where the bits of one number contain those of the other (Lucas).
//! So a power of Pascal's matrix is a product of one step for each bit of the digits' positions,
//! and needs no table.
//!
//! All numbers are bit-reversed: bit 0 is the first binary digit after the point.

/// Coordinates (0, 1) of the point at `index` for `half` = 0, coordinates (2, 3) for 1;
/// bit-reversed.
#[inline(always)]
pub const fn pair(index: u32, half: u32) -> [u32; 2] {
    if half == 0 {
        [index, sum_first(pascal(index, [1; 4]))]
    } else {
        [pascal(index, [2, 3, 2, 3]), sum_first(pascal(index, [3, 2, 3, 2]))]
    }
}

/// The power x of Pascal's matrix times the digits of `v`, where x is a field element; `powers` are
/// x, x², x⁴, x⁸.
#[inline(always)]
const fn pascal(mut v: u32, powers: [u32; 4]) -> u32 {
    v ^= times(v >> 2 & 0x3333_3333, powers[0]);
    v ^= times(v >> 4 & 0x0f0f_0f0f, powers[1]);
    v ^= times(v >> 8 & 0x00ff_00ff, powers[2]);
    v ^ times(v >> 16, powers[3])
}

/// The product of 16 base-4 digits with a field element: 1, 2 for w, 3 for w² = w + 1.
#[inline(always)]
const fn times(v: u32, x: u32) -> u32 {
    let (low, high) = (v & 0x5555_5555, v >> 1 & 0x5555_5555);
    match x {
        2 => (low ^ high) << 1 | high,
        3 => low << 1 | (low ^ high),
        _ => v,
    }
}

/// Replaces the first bit of each digit by the sum of both.
#[inline(always)]
const fn sum_first(v: u32) -> u32 {
    v ^ (v >> 1 & 0x5555_5555)
}
