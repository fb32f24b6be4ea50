//! [`flipped`]: permutes masks by a table, where permuting vectors is not cheap.

/// `FLIPS[flip][mask]` has bit `i` of the mask as bit `i ^ flip`.
static FLIPS: [[u8; 256]; 8] = {
    let mut flips = [[0; 256]; 8];
    let mut i = 0;
    while i < 8 * 256 * 8 {
        let (flip, mask, bit) = (i / 8 / 256, i / 8 % 256, i % 8);
        flips[flip][mask] |= ((mask >> bit & 1) << (bit ^ flip)) as u8;
        i += 1;
    }
    flips
};

/// The mask of sixteen lanes with bit `i` as bit `i ^ flip`.
#[inline(always)]
pub fn flipped(mask: u32, flip: u32) -> u32 {
    let flips = &FLIPS[flip as usize % 8];
    let mask = (mask as u16).to_le_bytes().map(|bits| flips[usize::from(bits)]);
    u16::from_le_bytes(mask).rotate_left(flip & 8).into()
}
