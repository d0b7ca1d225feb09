//! Letters on pictures.

use super::Panel;

/// Three by five dots a letter, the upper left dot in the highest of 15 bits.
const GLYPHS: [(char, u16); 43] = [
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
    ('A', 0b010_101_111_101_101),
    ('B', 0b110_101_110_101_110),
    ('C', 0b011_100_100_100_011),
    ('D', 0b110_101_101_101_110),
    ('E', 0b111_100_110_100_111),
    ('F', 0b111_100_110_100_100),
    ('G', 0b011_100_101_101_011),
    ('H', 0b101_101_111_101_101),
    ('I', 0b111_010_010_010_111),
    ('J', 0b001_001_001_101_010),
    ('K', 0b101_110_100_110_101),
    ('L', 0b100_100_100_100_111),
    ('M', 0b101_111_111_101_101),
    ('N', 0b110_101_101_101_101),
    ('O', 0b010_101_101_101_010),
    ('P', 0b110_101_110_100_100),
    ('Q', 0b010_101_101_110_011),
    ('R', 0b110_101_110_101_101),
    ('S', 0b011_100_010_001_110),
    ('T', 0b111_010_010_010_010),
    ('U', 0b101_101_101_101_111),
    ('V', 0b101_101_101_101_010),
    ('W', 0b101_101_111_111_101),
    ('X', 0b101_101_010_101_101),
    ('Y', 0b101_101_010_010_010),
    ('Z', 0b111_001_010_100_111),
    ('%', 0b101_001_010_100_101),
    ('+', 0b000_010_111_010_000),
    ('-', 0b000_000_111_000_000),
    ('.', 0b000_000_000_000_010),
    ('/', 0b001_001_010_100_100),
    ('|', 0b010_010_010_010_010),
    (':', 0b000_010_000_010_000),
];

/// Width of a text whose dots measure `scale` pixels.
pub(super) fn text_width(text: &str, scale: u32) -> u32 {
    4 * scale * text.chars().count() as u32
}

/// Writes `text` in white on a black outline; what is not a glyph is left blank.
pub(super) fn draw_text(panel: &mut Panel, left: u32, top: u32, scale: u32, text: &str) {
    for (colour, rim) in [([0; 3], scale.div_ceil(2)), ([255; 3], 0)] {
        for (index, letter) in text.chars().enumerate() {
            let dots = GLYPHS.iter().find(|(known, _)| *known == letter).map_or(0, |(_, dots)| *dots);
            let left = left + 4 * scale * index as u32;
            for dot in (0..15).filter(|dot| dots >> (14 - dot) & 1 == 1) {
                let [x, y] = [left + dot % 3 * scale, top + dot / 3 * scale];
                for down in 0..scale + 2 * rim {
                    for across in 0..scale + 2 * rim {
                        panel.set((x + across).saturating_sub(rim), (y + down).saturating_sub(rim), colour);
                    }
                }
            }
        }
    }
}
