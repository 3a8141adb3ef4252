//! From text to tokens: every byte lands in exactly one token, in order.
//!
//! Quantities are decided here, since a unit is a unit only right after its number.

use crate::kind::SyntaxKind;
use crate::units::unit_length;
use base::Span;

/// A token: it ends where the next one starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RawToken {
    pub(crate) kind: SyntaxKind,
    pub(crate) start: u32,
}

/// What is wrong with a single token.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Fault {
    UnterminatedText,
    UnterminatedValue,
    UnterminatedComment,
    UnknownCharacter,
}

/// The tokens of a text, the last one [`SyntaxKind::Eof`], and what is wrong with some of them.
#[derive(Debug)]
pub(crate) struct Lexed {
    pub(crate) tokens: Vec<RawToken>,
    pub(crate) faults: Vec<(Span, Fault)>,
}

/// Splits a text into tokens.
///
/// # Panics
/// If the text is longer than 4 GiB, where spans end.
pub(crate) fn lex(text: &str) -> Lexed {
    assert!(u32::try_from(text.len()).is_ok(), "a text is shorter than 4 GiB");
    let mut lexed = Lexed { tokens: Vec::with_capacity(text.len() / 3 + 2), faults: Vec::new() };
    add_tokens(text, 0, &mut lexed);
    lexed.tokens.push(RawToken { kind: SyntaxKind::Eof, start: text.len() as u32 });
    lexed
}

/// Adds the tokens of a text from a place on.
fn add_tokens(text: &str, from: usize, lexed: &mut Lexed) {
    let mut at = from;
    let mut count = Count::None;
    // how many `let`s of this line wait for their `in`
    let mut waiting = 0usize;
    // up to where no text with texts in its values ends
    let mut plain = from;
    while at < text.len() {
        let (kind, length) = token(&text[at..]);
        let end = at + length;
        if kind == SyntaxKind::Text && at >= plain && opens_value(&text[at..end]) {
            match end_around_texts(&text[at..]) {
                Ok(length) => {
                    let brace = at + text[at..end].rfind('{').unwrap_or_default();
                    let span = Span::new(brace as u32, (at + length) as u32);
                    lexed.faults.push((span, Fault::UnterminatedValue));
                    lexed.tokens.push(RawToken { kind, start: at as u32 });
                    (at, count) = (at + length, Count::None);
                    continue;
                }
                Err(length) => plain = at + length,
            }
        }
        if kind == SyntaxKind::Text && closed(&text[at..end]) && add_pieces(&text[..end], at, lexed)
        {
            (at, count) = (end, Count::None);
            continue;
        }
        lexed.tokens.push(RawToken { kind, start: at as u32 });
        if let Some(fault) = fault(kind, &text[at..end]) {
            lexed.faults.push((Span::new(at as u32, end as u32), fault));
        }
        let start = at;
        at = end;
        if kind == SyntaxKind::Number
            && !matches!(count, Count::One | Count::First | Count::Operand)
        {
            at = unit(text, end, waiting > 0, &mut lexed.tokens);
        }
        waiting = match kind {
            SyntaxKind::LetKw => waiting + 1,
            SyntaxKind::Ident if &text[start..end] == "in" => waiting.saturating_sub(1),
            _ if kind.is_trivia() && text[start..end].contains('\n') => 0,
            _ => waiting,
        };
        count = count.after(kind, &text[start..end]);
    }
}

/// How far the count of a list is read, `List of n + 1 C`: its numbers have no units, for a class follows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Count {
    /// No count.
    None,
    /// After `List`.
    List,
    /// After `of`, which need not be that of a list.
    One,
    /// After `List of`.
    First,
    /// After a name or number of a sum.
    Operator,
    /// After an operator of a sum.
    Operand,
}

impl Count {
    /// Returns how far it is read after a token.
    fn after(self, kind: SyntaxKind, text: &str) -> Self {
        match (self, kind) {
            (Self::First | Self::Operator | Self::Operand, _)
                if kind == SyntaxKind::Whitespace && text.contains('\n') =>
            {
                Self::None
            }
            _ if kind.is_trivia() => self,
            (Self::List, SyntaxKind::Ident) if text == "of" => Self::First,
            (_, SyntaxKind::Ident) if text == "of" => Self::One,
            (_, SyntaxKind::Ident) if text == "List" => Self::List,
            (Self::First | Self::Operand, SyntaxKind::Number) => Self::Operator,
            (Self::First | Self::Operand, SyntaxKind::Ident)
                if text.starts_with(char::is_lowercase) =>
            {
                Self::Operator
            }
            (
                Self::Operator,
                SyntaxKind::Plus | SyntaxKind::Minus | SyntaxKind::Star | SyntaxKind::Slash,
            ) => Self::Operand,
            _ => Self::None,
        }
    }
}

/// Returns true for a text that ends at a quote within a value of it: `"no. {"` of `"no. {"0"}"`.
fn opens_value(text: &str) -> bool {
    if !text.contains('{') || !closed(text) {
        return false;
    }
    let doubled = text.replace("{{", "");
    doubled.rfind('{').is_some_and(|open| !doubled[open..].contains('}'))
}

/// Returns where a text ends that has texts in its values; as an error, where its line ends and it does not.
///
/// There are no such texts, but what is written so is one mistake.
fn end_around_texts(text: &str) -> Result<usize, usize> {
    let bytes = text.as_bytes();
    // of what is open, innermost last, whether it is a text
    let mut open: Vec<bool> = vec![true];
    let mut at = 1;
    while let Some(&byte) = bytes.get(at).filter(|b| **b != b'\n') {
        let is_text = open.last() == Some(&true);
        match byte {
            b'\\' if is_text && bytes.get(at + 1) != Some(&b'\n') => at += 1,
            b'{' if is_text && bytes.get(at + 1) == Some(&b'{') => at += 1,
            b'{' => open.push(false),
            b'}' if !is_text => drop(open.pop()),
            b'"' if is_text => drop(open.pop()),
            b'"' => open.push(true),
            _ => {}
        }
        at += 1;
        if open.is_empty() {
            return Ok(at);
        }
    }
    Err(at.min(text.len()))
}

/// Adds the tokens of the quoted text that begins at `start` and ends `text`, if there are values in it: `"R = {r} ohm"`.
///
/// Returns false where there are none. Braces that are no values are doubled.
fn add_pieces(text: &str, start: usize, lexed: &mut Lexed) -> bool {
    let bytes = text.as_bytes();
    let mut piece = (SyntaxKind::TextOpen, start);
    let mut at = start + 1;
    while at + 1 < text.len() {
        match bytes[at] {
            b'\\' => at += 2,
            b'{' if bytes[at + 1] == b'{' => at += 2,
            b'{' => {
                let Some(length) = text[at..].find('}') else {
                    let span = Span::new(at as u32, text.len() as u32);
                    lexed.faults.push((span, Fault::UnterminatedValue));
                    break;
                };
                lexed.tokens.push(RawToken { kind: piece.0, start: piece.1 as u32 });
                add_tokens(&text[..at + length], at + 1, lexed);
                at += length;
                piece = (SyntaxKind::TextMiddle, at);
                at += 1;
            }
            _ => at += 1,
        }
    }
    if piece.0 == SyntaxKind::TextOpen {
        return false;
    }
    lexed.tokens.push(RawToken { kind: SyntaxKind::TextClose, start: piece.1 as u32 });
    true
}

/// Adds the unit of the number that ends at `end`, if it has one; returns where to go on.
///
/// Where a `let` waits for its `in`, this is no inch.
fn unit(text: &str, end: usize, waits: bool, tokens: &mut Vec<RawToken>) -> usize {
    let start = end + blanks(&text[end..]);
    let length = unit_length(&text[start..]);
    let after = start + length;
    let rest = &text[after + blanks(&text[after..])..];
    if length == 0 || rest.starts_with(':') {
        return end;
    }
    if &text[start..after] == "in" && (waits || is_keyword_in(rest)) {
        return end;
    }
    if start > end {
        tokens.push(RawToken { kind: SyntaxKind::Whitespace, start: end as u32 });
    }
    tokens.push(RawToken { kind: SyntaxKind::Unit, start: start as u32 });
    after
}

/// Returns true if the `in` between a number and `rest` is the word of the language and no inch: an operand follows that
/// does not begin the next member.
fn is_keyword_in(rest: &str) -> bool {
    let name = ident_length(rest);
    if name == 0 || rest.starts_with(|c: char| c.is_ascii_digit()) {
        return rest.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '(' | '[' | '"'));
    }
    let operator = ["and", "or", "mod", "within", "until", "then", "else", "to", "times", "union"];
    let is_operator = |rest: &str| operator.contains(&&rest[..ident_length(rest)]);
    let path = path_length(rest);
    let next = &rest[path + blanks(&rest[path..])..];
    let begins_member = match next.chars().next() {
        Some('=') => true,
        Some(c) if path == name => {
            c.is_alphabetic() && !is_operator(next) || matches!(c, ':' | '{')
        }
        _ => false,
    };
    !is_operator(rest) && !begins_member
}

/// The length of the path that a text begins with, `wheel.spokes`, `ends[0].x`.
fn path_length(text: &str) -> usize {
    let mut length = ident_length(text);
    loop {
        let rest = &text[length..];
        length += match rest.as_bytes() {
            [b'.', ..] if ident_length(&rest[1..]) > 0 => 1 + ident_length(&rest[1..]),
            [b'[', ..] => match rest[1..].find(['[', ']', '\n']).map(|n| n + 1) {
                Some(end) if rest.as_bytes()[end] == b']' => end + 1,
                _ => return length,
            },
            _ => return length,
        };
    }
}

fn blanks(text: &str) -> usize {
    text.bytes().take_while(|b| matches!(b, b' ' | b'\t')).count()
}

/// The kind and length of the token that a text, not empty, begins with.
fn token(text: &str) -> (SyntaxKind, usize) {
    let bytes = text.as_bytes();
    let next = |n: usize| bytes.get(n).copied().unwrap_or(0);
    match bytes[0] {
        b' ' | b'\t' | b'\n' | b'\r' => (SyntaxKind::Whitespace, space_length(text)),
        b'/' if next(1) == b'/' => {
            let doc = next(2) == b'/' && next(3) != b'/';
            let line = text.find('\n').unwrap_or(text.len());
            let length = text[..line].trim_end_matches('\r').len();
            (if doc { SyntaxKind::DocComment } else { SyntaxKind::LineComment }, length)
        }
        b'/' if next(1) == b'*' => {
            let length = text[2..].find("*/").map_or(text.len(), |n| n + 4);
            (SyntaxKind::BlockComment, length)
        }
        b'0'..=b'9' => (SyntaxKind::Number, number_length(bytes)),
        b'"' => (SyntaxKind::Text, text_length(bytes)),
        b'a'..=b'z' | b'A'..=b'Z' | b'_' => {
            let length = ident_length(text);
            (SyntaxKind::reserved(&text[..length]).unwrap_or(SyntaxKind::Ident), length)
        }
        0..=127 => match punctuation(next(0), next(1), next(2)) {
            (SyntaxKind::Unknown, _) => (SyntaxKind::Unknown, unknown_length(text)),
            known => known,
        },
        _ => {
            let first = text.chars().next().expect("the text is not empty");
            if first.is_alphabetic() {
                (SyntaxKind::Ident, ident_length(text))
            } else if first.is_whitespace() || first == '\u{feff}' {
                (SyntaxKind::Whitespace, space_length(text))
            } else {
                (SyntaxKind::Unknown, unknown_length(text))
            }
        }
    }
}

/// The length of what begins nothing: a character, and those after it that no keyboard has.
fn unknown_length(text: &str) -> usize {
    let mut rest = text.chars();
    rest.next();
    let is_strange = |c: char| {
        let begins = c.is_alphabetic() || c.is_whitespace() || c == '\u{feff}';
        !begins && (c.is_control() || !c.is_ascii())
    };
    let rest = rest.as_str();
    text.len() - rest.trim_start_matches(is_strange).len()
}

fn punctuation(first: u8, second: u8, third: u8) -> (SyntaxKind, usize) {
    match (first, second, third) {
        (b'.', b'.', b'.') => (SyntaxKind::Ellipsis, 3),
        (b'.', b'.', _) => (SyntaxKind::DotDot, 2),
        (b':', b'=', _) => (SyntaxKind::ColonEq, 2),
        (b'=', b'>', _) => (SyntaxKind::FatArrow, 2),
        (b'=', b'=', _) => (SyntaxKind::EqEq, 2),
        (b'-', b'>', _) => (SyntaxKind::Arrow, 2),
        (b'!', b'=', _) => (SyntaxKind::NotEq, 2),
        (b'<', b'=', _) => (SyntaxKind::LessEq, 2),
        (b'>', b'=', _) => (SyntaxKind::GreaterEq, 2),
        (b'(', ..) => (SyntaxKind::LParen, 1),
        (b')', ..) => (SyntaxKind::RParen, 1),
        (b'[', ..) => (SyntaxKind::LBracket, 1),
        (b']', ..) => (SyntaxKind::RBracket, 1),
        (b'{', ..) => (SyntaxKind::LBrace, 1),
        (b'}', ..) => (SyntaxKind::RBrace, 1),
        (b',', ..) => (SyntaxKind::Comma, 1),
        (b';', ..) => (SyntaxKind::Semicolon, 1),
        (b':', ..) => (SyntaxKind::Colon, 1),
        (b'=', ..) => (SyntaxKind::Eq, 1),
        (b'<', ..) => (SyntaxKind::Less, 1),
        (b'>', ..) => (SyntaxKind::Greater, 1),
        (b'+', ..) => (SyntaxKind::Plus, 1),
        (b'-', ..) => (SyntaxKind::Minus, 1),
        (b'*', ..) => (SyntaxKind::Star, 1),
        (b'/', ..) => (SyntaxKind::Slash, 1),
        (b'^', ..) => (SyntaxKind::Caret, 1),
        (b'.', ..) => (SyntaxKind::Dot, 1),
        _ => (SyntaxKind::Unknown, 1),
    }
}

fn space_length(text: &str) -> usize {
    let ascii = text.bytes().take_while(|b| matches!(b, b' ' | b'\t' | b'\n' | b'\r')).count();
    if text.as_bytes().get(ascii).is_none_or(u8::is_ascii) && ascii > 0 {
        return ascii;
    }
    text.find(|c: char| !(c.is_whitespace() || c == '\u{feff}')).unwrap_or(text.len())
}

fn ident_length(text: &str) -> usize {
    let ascii = text.bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count();
    if text.as_bytes().get(ascii).is_none_or(u8::is_ascii) {
        return ascii;
    }
    text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
}

/// `12`, `4.7`, `1e-9`; a dot or an `e` belongs to the number only where digits follow.
fn number_length(bytes: &[u8]) -> usize {
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let at = |n: usize| bytes.get(n).copied().unwrap_or(0);
    let mut end = digits(0);
    if at(end) == b'.' && at(end + 1).is_ascii_digit() {
        end += 1 + digits(end + 1);
    }
    if matches!(at(end), b'e' | b'E') {
        let sign = usize::from(matches!(at(end + 1), b'+' | b'-'));
        if at(end + 1 + sign).is_ascii_digit() {
            end += 1 + sign + digits(end + 1 + sign);
        }
    }
    end
}

/// A text with its quotes; without the closing one it ends on its line.
fn text_length(bytes: &[u8]) -> usize {
    let mut end = 1;
    while end < bytes.len() {
        match bytes[end] {
            b'"' => return end + 1,
            b'\n' => return end - usize::from(bytes[end - 1] == b'\r' && end > 1),
            b'\\'
                if end + 1 < bytes.len() && bytes[end + 1] != b'\n' && bytes[end + 1] != b'\r' =>
            {
                end += 2;
            }
            _ => end += 1,
        }
    }
    // An escape may have stepped over the first byte of a longer character, never past the end.
    end.min(bytes.len())
}

fn fault(kind: SyntaxKind, text: &str) -> Option<Fault> {
    match kind {
        SyntaxKind::Unknown => Some(Fault::UnknownCharacter),
        SyntaxKind::BlockComment if text.len() < 4 || !text.ends_with("*/") => {
            Some(Fault::UnterminatedComment)
        }
        SyntaxKind::Text if !closed(text) => Some(Fault::UnterminatedText),
        _ => None,
    }
}

/// Returns true if a text token has its closing quote.
fn closed(text: &str) -> bool {
    let escapes = text.bytes().rev().skip(1).take_while(|b| *b == b'\\').count();
    text.len() >= 2 && text.ends_with('"') && escapes % 2 == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &str) {
        let lexed = lex(text);
        let shown: Vec<String> = lexed
            .tokens
            .windows(2)
            .filter(|w| w[0].kind != SyntaxKind::Whitespace)
            .map(|w| format!("{:?} {}", w[0].kind, &text[w[0].start as usize..w[1].start as usize]))
            .collect();
        assert_eq!(shown.join(" | "), expected);
    }

    #[test]
    fn a_unit_follows_its_number_on_the_same_line() {
        check("9.81 m/s^2", "Number 9.81 | Unit m/s^2");
        check("30deg", "Number 30 | Unit deg");
        check("5\nm", "Number 5 | Ident m");
        check("x m", "Ident x | Ident m");
        check("5 1/s^2", "Number 5 | Unit 1/s^2");
        check("1/2", "Number 1 | Slash / | Number 2");
    }
    #[test]
    fn an_inch_is_told_from_the_word() {
        check("3 in", "Number 3 | Unit in");
        check("3 in * 2", "Number 3 | Unit in | Star * | Number 2");
        check(
            "w = 3 in h = 4 in^2",
            "Ident w | Eq = | Number 3 | Unit in | Ident h | Eq = | Number 4 | Unit in^2",
        );
        check(
            "w = 3 in ends[0].x = 4",
            "Ident w | Eq = | Number 3 | Unit in | Ident ends | LBracket [ | Number 0 | RBracket ] | Dot . | Ident x \
             | Eq = | Number 4",
        );
        check("3 in xs", "Number 3 | Ident in | Ident xs");
        check("3 in a.xs", "Number 3 | Ident in | Ident a | Dot . | Ident xs");
        check("3 in xs and x", "Number 3 | Ident in | Ident xs | AndKw and | Ident x");
        check("3 in (xs)", "Number 3 | Ident in | LParen ( | Ident xs | RParen )");
        check(
            "let a = 3 in -a",
            "LetKw let | Ident a | Eq = | Number 3 | Ident in | Minus - | Ident a",
        );
        check("3 in and x", "Number 3 | Unit in | AndKw and | Ident x");
    }
    #[test]
    fn a_name_before_a_colon_is_no_unit() {
        check("1 m: C", "Number 1 | Ident m | Colon : | Ident C");
        check("1 s := 2", "Number 1 | Ident s | ColonEq := | Number 2");
    }
    #[test]
    fn a_count_has_no_unit() {
        check("List of 12 C", "Ident List | Ident of | Number 12 | Ident C");
        check("List of n + 1 C", "Ident List | Ident of | Ident n | Plus + | Number 1 | Ident C");
        check(
            "List of n C = 2 * 1 C",
            "Ident List | Ident of | Ident n | Ident C | Eq = | Number 2 | Star * | Number 1 | Unit C",
        );
    }
    #[test]
    fn dots_after_numbers() {
        check("0..7", "Number 0 | DotDot .. | Number 7");
        check("1.5.text", "Number 1.5 | Dot . | Ident text");
        check("1 mm..2 mm", "Number 1 | Unit mm | DotDot .. | Number 2 | Unit mm");
        check("2e3 2e", "Number 2e3 | Number 2 | Ident e");
    }
    #[test]
    fn a_text_ends_on_its_line() {
        check("\"a\\\"b\" c", "Text \"a\\\"b\" | Ident c");
        check("\"a\nb", "Text \"a | Ident b");
        assert_eq!(lex("\"a\\\"").faults.len(), 1);
        assert_eq!(lex("\"a\\\\\"").faults.len(), 0);
    }
    #[test]
    fn a_text_has_values_in_it() {
        check(
            r#""R = {r.x} ohm, {2 mm}" x"#,
            r#"TextOpen "R = { | Ident r | Dot . | Ident x | TextMiddle } ohm, { | Number 2 | Unit mm | TextClose }" | Ident x"#,
        );
        let nested = r#""no. {"{x}" + "0"} of" y"#;
        check(nested, r#"Text "no. {"{x}" + "0"} of" | Ident y"#);
        let faults = lex(nested).faults;
        assert_eq!(faults, [(Span::new(5, 22), Fault::UnterminatedValue)], "one mistake");
        check(r#""a {" b"#, r#"Text "a {" | Ident b"#);
        check(r#""{{a}} \\{b""#, r#"Text "{{a}} \\{b""#);
        assert_eq!(lex(r#""a {b""#).faults.len(), 1);
    }
    #[test]
    fn comments() {
        check(
            "//// a\n/// b\n/*c*/ /*d",
            "LineComment //// a | DocComment /// b | BlockComment /*c*/ | BlockComment /*d",
        );
    }
}
