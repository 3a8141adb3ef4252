//! Characters and texts that are no tokens: what each is, and what is written for it.

use crate::lexer::Fault;
use base::{Diagnostic, FileId, Place, Span};

/// Says what is wrong with a token, and what is written for it.
pub(crate) fn token_fault(file: FileId, text: &str, span: Span, fault: Fault) -> Diagnostic {
    let place = Place { file, span };
    match fault {
        Fault::UnterminatedText => {
            let is_inch = line_before(text, span).ends_with(|c: char| c.is_ascii_digit());
            Diagnostic::error("unterminated-text", place, "found the end of the line in a text")
                .hint(match is_inch {
                    true => "inches are `3 inch`; a text ends on its line with a second `\"`",
                    false => "a text ends on its line: close it with `\"`",
                })
        }
        Fault::UnterminatedValue => {
            let place = Place { file, span: Span::new(span.start, span.start + 1) };
            let d =
                Diagnostic::error("unterminated-value", place, "found `{` without `}` in a text");
            let rest = text.get(span.start as usize..).unwrap_or_default();
            let line = rest.lines().next().unwrap_or_default();
            // the text has ended at a quote, and the brace is closed behind it
            let is_quoted = line.find('}').is_some_and(|end| line[..end].contains('"'));
            d.hint(match is_quoted {
                true => "no text stands in a value of a text: give it a name, `zero => \"0\"`, and say that",
                false => {
                    "a value in a text stands in braces, `\"R = {r.resistance}\"`; a brace itself is doubled: `{{`"
                }
            })
        }
        Fault::UnterminatedComment => {
            let place = Place { file, span: Span::new(span.start, span.start + 2) };
            Diagnostic::error(
                "unterminated-comment",
                place,
                "found the end of the text in a comment",
            )
            .hint("close the comment with `*/`")
        }
        Fault::UnknownCharacter => {
            let all = &text[span.range()];
            let first: String = all.chars().take(8).collect();
            let more = if first.len() < all.len() { "…" } else { "" };
            let message = match all.chars().next().filter(|&c| is_unseen(c)) {
                Some(c) => format!("found U+{:04X}, which cannot be seen", u32::from(c)),
                None => format!("found `{first}{more}`, which begins nothing"),
            };
            let d = Diagnostic::error("unknown-character", place, message);
            match meant_by(text, span) {
                Some(hint) => d.hint(hint),
                None => d,
            }
        }
    }
}

/// Says what is written for a character that begins nothing.
fn meant_by(text: &str, span: Span) -> Option<&'static str> {
    Some(match text[span.range()].chars().next() {
        Some('⌀') => "a diameter is a rule: `constraint 2 * c.radius = 12 mm`",
        Some('`') => {
            "a text stands between straight double quotes, a value in it in braces: `\"x = {x}\"`"
        }
        Some('$') if text[span.range().end..].starts_with('{') => {
            "a value in a text stands in braces alone: `\"x = {x}\"`"
        }
        Some('\\') => latex(&text[span.range().end..]),
        Some('&') if line_before(text, span).trim_end().ends_with('"') => {
            "texts are joined by `+`, or have the values in them: `\"{a}{b}\"`"
        }
        Some('\'') if line_before(text, span).ends_with(|c: char| c.is_ascii_digit()) => {
            match text[span.range().end..].starts_with(|c: char| c.is_ascii_digit()) {
                true if text[span.range().end..]
                    .trim_start_matches(|c: char| c.is_ascii_digit())
                    .starts_with(['"', '\'', '″']) =>
                {
                    "feet and inches are a sum: `5 ft + 3 inch`"
                }
                true => "the digits of a number stand together: `10000`",
                false => "feet and inches are a sum: `5 ft + 3 inch`",
            }
        }
        Some('\'' | '“' | '”' | '„' | '«' | '»' | '‘' | '’') => {
            "a text stands between straight double quotes: `\"hello\"`"
        }
        Some(c) if is_unseen(c) => "delete it, and type the line anew",
        Some('&') => "write `and`",
        Some('|') if line_before(text, span).trim_start().starts_with("choice ") => {
            "options are names with commas between them: `choice Fit { loose, close }`"
        }
        Some('|') if line_before(text, span).trim_end().ends_with('(') => {
            "a function of one argument is `x => 2 * x`"
        }
        Some('|') => "write `or`; a size is `abs(x)`, a relation `l.parallel(to: m)`",
        Some('∥' | '⊥') => {
            "a relation is asked of a thing: `l.parallel(to: m)`, `l.perpendicular(to: m)`"
        }
        Some('!')
            if line_before(text, span).ends_with(|c: char| c.is_alphanumeric() || c == ')') =>
        {
            "a factorial is a product: `(1..5).product`"
        }
        Some('!') => "write `not`",
        Some('%') if line_before(text, span).trim().is_empty() => "a comment begins with `//`",
        Some('%') if line_before(text, span).trim_end().ends_with('"') => {
            "a text has its values in braces: `\"x = {x}\"`"
        }
        Some('%') => "the remainder is `x mod 3`; right after a number `%` is percent",
        Some('#') if is_colour(text, span) => "a colour is a text: `\"#ff8000\"`",
        Some('#') => "a comment begins with `//`",
        Some('×' | '·' | '∙') => "write `*`",
        Some('÷') => "write `/`",
        Some('−' | '–') => "write `-`",
        Some('≤') => "write `<=`",
        Some('≥') => "write `>=`",
        Some('≠') => "write `!=`",
        Some('≈' | '≃' | '≅' | '±' | '~') => "what is nearly equal is `a = b within 0.1`",
        Some('∈') => "write `in`",
        Some('½') => "write `0.5`",
        Some('¼') => "write `0.25`",
        Some('¾') => "write `0.75`",
        Some('?') if text[span.range().start + 1..].lines().next().is_none_or(str::is_empty) => {
            "every part has a value, at first zero, false or empty: leave `?` out"
        }
        Some('?') => "a value is chosen by `if c then a else b`",
        Some('√') => "write `sqrt(x)`",
        Some('°') if follows(text, span, "°C") => {
            "temperatures are in kelvin: 20 °C is `293.15 K`, and a step of 1 °C is `1 K`"
        }
        Some('°') if follows(text, span, "°F") => {
            "temperatures are in kelvin: 68 °F is `293.15 K`, and a step of 9 °F is `5 K`"
        }
        Some('°') if text[span.range().end..].starts_with(|c: char| c.is_ascii_digit()) => {
            "degrees and minutes are a sum: `45 deg + 30 arcmin`"
        }
        Some('²') => "write `^2`",
        Some('³') => "write `^3`",
        Some('€' | '£' | '¥') => MONEY,
        Some('∞') => "a number is finite: leave out the bound that is none",
        Some('$') if dollars(text, span) => MONEY,
        Some('$' | '@') => "names are made of letters, digits and `_`",
        _ => return None,
    })
}

/// Says what is written for a command of LaTeX, whose word stands here.
fn latex(rest: &str) -> &'static str {
    let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
    match &rest[..end] {
        "frac" | "dfrac" | "tfrac" => "a quotient is `a / b`",
        "sqrt" => "write `sqrt(x)`",
        "cdot" | "times" => "write `*`",
        "leq" | "le" => "write `<=`",
        "geq" | "ge" => "write `>=`",
        "neq" | "ne" => "write `!=`",
        "pi" => "write `pi`",
        "sum" => "a sum is `(1..n).map(i => …).sum`",
        "left" | "right" => "brackets stand by themselves: `(`, `)`",
        _ => "words stand by themselves: leave `\\` out",
    }
}

/// What is said of signs of currencies.
const MONEY: &str = "money is a plain number without its sign: `price: Real = 3.50`";

/// Returns what stands on the line before a span.
pub(crate) fn line_before(text: &str, span: Span) -> &str {
    let before = text.get(..span.range().start).unwrap_or_default();
    before.rsplit('\n').next().unwrap_or_default()
}

/// Returns true for a character that no letter shows: a control, or a space of no width.
fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// Returns true for `#ff8000`, `#f80`: a sign before three or six hexadecimal digits. Where a line begins with it that
/// is a comment of other languages, `#add more`, unless a value is wanted there.
fn is_colour(text: &str, span: Span) -> bool {
    let rest = text.get(span.range().start + 1..).unwrap_or_default();
    let length = rest.bytes().take_while(u8::is_ascii_alphanumeric).count();
    let digits = &rest[..length];
    let is_first = line_before(text, span).trim().is_empty();
    let before = text.get(..span.range().start).unwrap_or_default();
    let is_wanted = before.trim_end().ends_with(['=', '[', '(', ',']);
    digits.bytes().all(|digit| digit.is_ascii_hexdigit())
        && matches!(length, 3 | 6)
        && (!is_first || is_wanted)
}

/// Returns true for a dollar sign before a number.
fn dollars(text: &str, span: Span) -> bool {
    let rest = text.get(span.range().start + 1..);
    rest.is_some_and(|rest| rest.trim_start().starts_with(|c: char| c.is_ascii_digit()))
}

/// Returns true if the text goes on with these words where a span begins.
fn follows(text: &str, span: Span, words: &str) -> bool {
    text.get(span.range().start..).is_some_and(|rest| rest.starts_with(words))
}
