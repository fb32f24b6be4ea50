//! Tables for masks of eight lanes.

/// For each flip below eight and each mask: bit i of the mask as bit `i ^ flip`.
pub static FLIPS: [[u8; 256]; 8] = {
    let mut flips = [[0; 256]; 8];
    let mut i = 0;
    while i < 8 * 256 * 8 {
        let (flip, mask, bit) = (i / 8 / 256, i / 8 % 256, i % 8);
        flips[flip][mask] |= ((mask >> bit & 1) << (bit ^ flip)) as u8;
        i += 1;
    }
    flips
};

/// For each mask which lanes it has, the lowest first, and 0 behind them.
pub static CHOSEN: [[u8; 8]; 256] = {
    let mut chosen = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut bit, mut len) = (0, 0);
        while bit < 8 {
            if mask >> bit & 1 == 1 {
                chosen[mask][len] = bit as u8;
                len += 1;
            }
            bit += 1;
        }
        mask += 1;
    }
    chosen
};
