//! Numbers as people write and read them.

use base::number::{rounded, shortest};

/// Writes a number: the shortest decimal, or rounded to so many decimals.
pub(crate) fn number_text(x: f64, digits: Option<usize>) -> String {
    match digits {
        Some(digits) => rounded(x, digits),
        None => shortest(x),
    }
}

/// Reads a decimal number, spaces around it allowed; `inf` and `nan` are none.
pub(crate) fn read_number(text: &str) -> Option<f64> {
    let text = text.trim();
    let digits = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    // People and pictures write the true minus sign too.
    let text = text.replace('\u{2212}', "-");
    if !text.chars().all(digits) {
        return None;
    }
    text.parse().ok().filter(|x: &f64| x.is_finite()).map(|x| x + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        assert_eq!(read_number(" 45.50 "), Some(45.5));
        assert_eq!(read_number("\u{2212}3e2"), Some(-300.0));
        assert_eq!(read_number("-0").map(f64::to_bits), Some(0));
        for wrong in ["", "hot", "inf", "nan", "1e999", "3 4", "0x10"] {
            assert_eq!(read_number(wrong), None, "{wrong}");
        }
    }
    #[test]
    fn numbers_are_written_short() {
        assert_eq!(number_text(2.0, None), "2");
        assert_eq!(number_text(2.0 / 3.0, Some(3)), "0.667");
    }
}
