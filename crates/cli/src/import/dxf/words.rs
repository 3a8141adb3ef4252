//! Words: lines of text, and paragraphs with the codes that their letters are set by.

use super::{Entity, Figure, Read, found};
use base::number::{cos, sin};
use drawing::Point;

/// How far lines of a paragraph are apart, as a part of their height.
const LEADING: f64 = 5.0 / 3.0;

/// Reads a TEXT.
pub(super) fn line(entity: &Entity<'_>, scale: f64) -> Option<Figure> {
    let (at, size) = (entity.point(10, scale)?, scale * entity.number(40)?);
    Some(Figure::Words { at, words: unescaped(entity.text(1)?), size })
}

/// Reads an MTEXT: a note for each of its lines.
pub(super) fn lines(entity: &Entity<'_>, scale: f64, read: &mut Read) {
    let (Some(at), Some(size)) = (entity.point(10, scale), entity.number(40)) else {
        read.notes.push("MTEXT without all of its numbers".into());
        return;
    };
    let size = scale * size;
    if entity.is_set(50) || entity.is_set(21) || entity.number(11).is_some_and(|x| x != 1.0) {
        read.notes.push("that an MTEXT is turned: it stands level".into());
    }
    let parts = entity.values.iter().filter(|(code, _)| matches!(code, 1 | 3));
    let coded: String = parts.map(|(_, part)| *part).collect();
    let (words, is_set) = plain(&coded);
    if is_set {
        read.notes.push("how the letters of an MTEXT are set: its words are taken over".into());
    }
    let words: Vec<&str> = words.lines().collect();
    // which of its nine corners and middles its place is: along the top first
    let place = entity.number(71).map_or(0, |place| (place as i64 - 1).clamp(0, 8));
    if place % 3 > 0 {
        read.notes.push("how an MTEXT is aligned: its lines begin at its place".into());
    }
    let rows = words.len() as f64 - 1.0;
    let first = match place / 3 {
        0 => -size,
        1 => 0.5 * (rows * LEADING - 1.0) * size,
        _ => rows * LEADING * size,
    };
    for (i, words) in words.into_iter().enumerate().filter(|(_, w)| !w.trim().is_empty()) {
        let at = Point { x: at.x, y: at.y + first - LEADING * size * i as f64 };
        read.found.push(found(Figure::Words { at, words: words.trim().to_string(), size }));
    }
}

/// Returns a paragraph's words, lines apart, and whether codes for its letters were left out.
fn plain(coded: &str) -> (String, bool) {
    let (mut words, mut is_set) = (String::new(), false);
    let mut rest = coded.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '{' | '}' => {}
            '\\' => match rest.next() {
                Some('P' | 'N' | 'X') => words.push('\n'),
                Some('~') => words.push('\u{a0}'),
                Some(c @ ('\\' | '{' | '}')) => words.push(c),
                Some('U') => words.push_str("\\U"),
                Some('S') => {
                    let stacked = rest.by_ref().take_while(|c| *c != ';');
                    words.extend(stacked.map(|c| if matches!(c, '^' | '#') { '/' } else { c }));
                }
                Some('L' | 'l' | 'O' | 'o' | 'K' | 'k') => is_set = true,
                Some(_) => {
                    is_set = true;
                    rest.by_ref().find(|c| *c == ';');
                }
                None => {}
            },
            c => words.push(c),
        }
    }
    (unescaped(&words), is_set)
}

/// Returns a text whose characters may be written by their numbers: `\U+00D8`, `%%c`.
pub(super) fn unescaped(text: &str) -> String {
    let text = text.replace("%%c", "Ø").replace("%%d", "°").replace("%%p", "±");
    let mut parts = text.split("\\U+");
    let mut units: Vec<u16> = parts.next().unwrap_or_default().encode_utf16().collect();
    for part in parts {
        let number = part.get(..4).and_then(|hex| u16::from_str_radix(hex, 16).ok());
        match number {
            Some(unit) => {
                units.push(unit);
                units.extend(part[4..].encode_utf16());
            }
            None => units.extend("\\U+".encode_utf16().chain(part.encode_utf16())),
        }
    }
    String::from_utf16_lossy(&units)
}

/// Returns a place that is turned to the left around the origin.
pub(super) fn turned(p: Point, angle: f64) -> Point {
    let (c, s) = (cos(angle), sin(angle));
    Point { x: c * p.x - s * p.y, y: s * p.x + c * p.y }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn codes_of_letters_are_left_out() {
        let coded = "{\\fArial|b1;Bore}\\PØ \\H2.5x;8 \\S+1^-2; \\U+00B0 \\{x\\}";
        assert_eq!(plain(coded), ("Bore\nØ 8 +1/-2 ° {x}".to_string(), true));
        assert_eq!(plain("a\\Pb"), ("a\nb".to_string(), false));
    }
}
