//! The digits that a thing is written with: those that only rounding has made are left out.

use super::member_of;
use crate::document::Open;
use crate::host::Host;
use base::number::rounded;

/// A longer decimal has digits that somebody may mean.
const LONGEST: usize = 9;

/// Returns what a text says of one of its things, without digits that only rounding has made; as it stands where that
/// would change what it is.
pub(super) fn without_noise(trial: &Open, name: &str, host: &dyn Host) -> String {
    let member = member_of(&trial.state.text, name);
    let short = shortened(&member);
    if short == member || member.is_empty() {
        return member;
    }
    let again = Open::of(&trial.name, trial.state.text.replacen(&member, &short, 1), host);
    let is_same = again.status.satisfied && again.state.gave_way.is_empty();
    if is_same { short } else { member }
}

/// Returns a text with numbers to twelve digits of its largest, where they are much shorter so.
fn shortened(text: &str) -> String {
    let numbers = numbers(text);
    let largest = numbers.iter().map(|&(_, _, x)| x.abs()).fold(1e-3, f64::max);
    let (mut size, mut decimals) = (largest, 12);
    while size >= 10.0 && decimals > 0 {
        size /= 10.0;
        decimals -= 1;
    }
    let mut made = String::new();
    let mut from = 0;
    for (start, end, x) in numbers {
        let short = rounded(x, decimals);
        if short.len() > LONGEST || short.len() >= end - start {
            continue;
        }
        let before = &text[from..start];
        made.push_str(if short == "0" {
            before.strip_suffix('-').unwrap_or(before)
        } else {
            before
        });
        made.push_str(&short);
        from = end;
    }
    made + &text[from..]
}

/// Returns the numbers of a text that stand by themselves: where each begins and ends, and its value.
fn numbers(text: &str) -> Vec<(usize, usize, f64)> {
    let bytes = text.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let is_word = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'.' || b >= 128;
        if !is_word(bytes[at]) {
            at += 1;
            continue;
        }
        let start = at;
        while at < bytes.len() && (is_word(bytes[at]) || is_exponent(&bytes[start..=at])) {
            at += 1;
        }
        let word = &text[start..at];
        if word.starts_with(|c: char| c.is_ascii_digit())
            && let Ok(x) = word.parse()
        {
            found.push((start, at, x));
        }
    }
    found
}

/// Whether the last letter is the sign of a number's exponent.
fn is_exponent(word: &[u8]) -> bool {
    matches!(word, [b'0'..=b'9', .., b'e' | b'E', b'+' | b'-'])
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn digits_that_only_rounding_made_are_left_out() {
        let text = "line2: Line { p1 = (-110.70000000000002, 2.842170943040401e-14)  p2 = (46.0554002110016, 1) }";
        let short = "line2: Line { p1 = (-110.7, 0)  p2 = (46.0554002110016, 1) }";
        assert_eq!(shortened(text), short);
        assert_eq!(shortened("a = (-1e-15, 300.00000000000006)"), "a = (0, 300)");
    }
}
