//! Text metrics: how wide and high words are, the same numbers on every machine.
//!
//! A box that fits its text must not depend on the fonts of the page that shows it, so widths come
//! from one table: the advance widths of Helvetica. Other characters count as wide as a digit.
//! **Source:** Adobe Core 14 AFM files, Helvetica.

/// The advance widths of the printable ASCII characters, in thousandths of the text's size.
const ASCII: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278,
    278, // space to /
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, // digits
    278, 278, 584, 584, 584, 556, 1015, // : to @
    667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, // A to M
    722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, // N to Z
    278, 278, 278, 469, 556, 333, // [ to `
    556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, // a to m
    556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, // n to z
    334, 260, 334, 584, // { to ~
];

/// How wide any other character is.
const OTHER: u16 = 556;

/// From one base line to the next, in multiples of the text's size.
pub const LINE_HEIGHT: f64 = 1.2;

/// How far letters rise above the base line, in multiples of the text's size.
pub const ASCENT: f64 = 0.718;

/// How far letters reach below the base line, in multiples of the text's size.
pub const DESCENT: f64 = 0.207;

/// Returns how wide the longest line of a text is, in the units of `size`.
///
/// ```
/// assert_eq!(drawing::metrics::text_width("MM", 1000.0), 1666.0);
/// assert_eq!(drawing::metrics::text_width("", 12.0), 0.0);
/// ```
pub fn text_width(text: &str, size: f64) -> f64 {
    let thousandths = |line: &str| line.chars().map(advance).sum::<u64>();
    let longest = text.split('\n').map(thousandths).max().unwrap_or(0);
    longest as f64 * size / 1000.0
}

/// Returns how high a text's lines are together, in the units of `size`.
///
/// ```
/// assert_eq!(drawing::metrics::text_height("one\ntwo", 10.0), 24.0);
/// ```
pub fn text_height(text: &str, size: f64) -> f64 {
    text.split('\n').count() as f64 * LINE_HEIGHT * size
}

fn advance(c: char) -> u64 {
    let width = match (c as usize).checked_sub(32) {
        Some(i) => ASCII.get(i).copied().unwrap_or(OTHER),
        None => 0,
    };
    u64::from(width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_the_published_ones() {
        assert_eq!(text_width("~", 1000.0), 584.0);
        assert_eq!(text_width("W", 1000.0), 944.0);
        assert_eq!(text_width("i", 1000.0), 222.0);
        assert_eq!(text_width("0", 1000.0), 556.0);
    }
    #[test]
    fn a_strange_character_is_as_wide_as_a_digit() {
        assert_eq!(text_width("Ω", 10.0), text_width("0", 10.0));
    }
    #[test]
    fn the_longest_line_counts() {
        assert_eq!(text_width("i\nWW\ni", 1000.0), 1888.0);
        assert_eq!(text_height("", 10.0), 12.0);
    }
}
