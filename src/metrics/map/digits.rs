//! A bitmap font for the numbers of a legend.

use glam::UVec2;

/// The glyphs: three pixels wide and five high, row by row from the top, the left pixel in the highest bit.
const GLYPHS: [(char, u16); 14] = [
    ('0', 0b111_101_101_101_111),
    ('1', 0b010_110_010_010_111),
    ('2', 0b111_001_111_100_111),
    ('3', 0b111_001_111_001_111),
    ('4', 0b101_101_111_001_001),
    ('5', 0b111_100_111_001_111),
    ('6', 0b111_100_111_101_111),
    ('7', 0b111_001_010_010_010),
    ('8', 0b111_101_111_101_111),
    ('9', 0b111_101_111_001_111),
    ('.', 0b000_000_000_000_010),
    ('-', 0b000_000_111_000_000),
    ('+', 0b000_010_111_010_000),
    ('e', 0b000_111_111_100_111),
];

/// Side of the square that each of a glyph's pixels is drawn as.
const SQUARE: u32 = 2;
pub const HEIGHT: u32 = 5 * SQUARE;
const STEP: u32 = 4 * SQUARE;

/// Width of a text in pixels.
pub fn width(text: &str) -> u32 {
    (text.chars().count() as u32 * STEP).saturating_sub(SQUARE)
}

/// Draws a number in black into a page of RGB codes, with its upper left corner at `at`. It has to fit into the page.
pub fn draw(page: &mut [u8], size: UVec2, at: UVec2, text: &str) {
    for (index, letter) in text.chars().enumerate() {
        let Some((_, glyph)) = GLYPHS.iter().find(|(known, _)| *known == letter) else { continue };
        for (bit, square) in (0..15).rev().zip(0..) {
            if glyph >> bit & 1 == 0 {
                continue;
            }
            let corner = at
                + UVec2::new(index as u32 * STEP, 0)
                + SQUARE * UVec2::new(square % 3, square / 3);
            for y in corner.y..corner.y + SQUARE {
                let start = 3 * (y as usize * size.x as usize + corner.x as usize);
                page[start..start + 3 * SQUARE as usize].fill(0);
            }
        }
    }
}
