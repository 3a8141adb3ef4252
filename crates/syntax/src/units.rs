//! Units as words: what a word after a number must be to be its unit. `expr::units` is the table.

/// Returns the length in bytes of the unit that `text` begins with, or 0 if it begins with none.
///
/// `m/s^2` is one unit; `m/width` begins with `m`; `mx` begins with none.
///
/// ```
/// assert_eq!(syntax::units::unit_length("m/s^2 + 1"), 5);
/// assert_eq!(syntax::units::unit_length("m/width"), 1);
/// assert_eq!(syntax::units::unit_length("1/s^2"), 5);
/// assert_eq!(syntax::units::unit_length("metre"), 0);
/// ```
pub fn unit_length(text: &str) -> usize {
    let above = if text.starts_with("1/") { "1/".len() } else { 0 };
    let first = power_length(&text[above..]);
    if first == 0 {
        return 0;
    }
    let mut end = above + first;
    while text[end..].starts_with(['*', '/']) {
        let next = power_length(&text[end + 1..]);
        if next == 0 {
            break;
        }
        end += 1 + next;
    }
    end
}

/// Returns true for a word that joins two operands or follows one, where it might be taken for the unit of a number.
///
/// ```
/// assert!(syntax::units::follows_operand("until"));
/// assert!(!syntax::units::follows_operand("furlong"));
/// ```
pub fn follows_operand(word: &str) -> bool {
    const WORDS: [&str; 16] = [
        "in", "is", "mod", "union", "subset", "within", "reads", "of", "until", "to", "times",
        "as", "with", "into", "only", "for",
    ];
    WORDS.contains(&word)
}

/// The length of a simple unit and its exponent: `s^2`, `m`, `s^-1`.
fn power_length(text: &str) -> usize {
    let word = word_length(text);
    if word == 0 || expr::units::unit(&text[..word]).is_none() {
        return 0;
    }
    let Some(rest) = text[word..].strip_prefix('^') else { return word };
    let sign = usize::from(rest.starts_with('-'));
    let digits = rest[sign..].bytes().take_while(u8::is_ascii_digit).count();
    if digits == 0 { word } else { word + 1 + sign + digits }
}

/// The length of the run of characters that a unit can be written with.
fn word_length(text: &str) -> usize {
    if text.starts_with('%') {
        return 1;
    }
    text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '°')).unwrap_or(text.len())
}
