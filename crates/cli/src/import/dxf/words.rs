//! Words: lines of text, and paragraphs with the codes that their letters are set by.

use super::{Entity, Figure, Read, found};
use base::number::{atan2, cos, sin};
use drawing::{Point, metrics};

/// How far lines of a paragraph are apart, as a part of their height.
const LEADING: f64 = 5.0 / 3.0;

/// Reads a TEXT, or what is like one; `upright` is the code that says how it is aligned upright.
pub(super) fn line(
    entity: &Entity<'_>,
    upright: i32,
    scale: f64,
    notes: &mut Vec<String>,
) -> Option<Figure> {
    let (start, size) = (entity.point(10, scale)?, scale * entity.number(40)?);
    let words = unescaped(entity.text(1)?);
    let turn = entity.number(50).unwrap_or(0.0).to_radians();
    let aligned = |code| entity.number(code).map_or(0, |n| n as i64);
    let (across, upright) = (aligned(72), aligned(upright));
    if matches!(across, 3 | 5) {
        notes
            .push("how wide a TEXT is between two points: its letters are as wide as usual".into());
    }
    let at = match (across, upright) {
        (0, 0) | (3 | 5, _) => start,
        _ => {
            let ahead = match across {
                1 | 4 => -0.5 * metrics::text_width(&words, size),
                2 => -metrics::text_width(&words, size),
                _ => 0.0,
            };
            let up = match (across, upright) {
                (4, _) | (_, 2) => -0.5 * metrics::ASCENT * size,
                (_, 1) => metrics::DESCENT * size,
                (_, 3) => -metrics::ASCENT * size,
                _ => 0.0,
            };
            beside(entity.point(11, scale)?, Point { x: ahead, y: up }, turn)
        }
    };
    Some(Figure::Words { at, words, size, turn })
}

/// Reads an ATTRIB, the words that an INSERT gives its block; those that are not seen are left out.
pub(super) fn given(entity: &Entity<'_>, scale: f64, read: &mut Read) {
    if entity.number(70).is_some_and(|flags| flags as i64 & 1 == 1) {
        read.notes.push("ATTRIB that is not seen".into());
        return;
    }
    match line(entity, 74, scale, &mut read.notes) {
        Some(figure) => read.found.push(found(figure)),
        None => read.notes.push("ATTRIB without all of its numbers".into()),
    }
}

/// Returns the place that lies so far from another along words that are turned.
fn beside(from: Point, way: Point, turn: f64) -> Point {
    let way = turned(way, turn);
    Point { x: from.x + way.x, y: from.y + way.y }
}

/// Reads an MTEXT: a note for each of its lines.
pub(super) fn lines(entity: &Entity<'_>, scale: f64, read: &mut Read) {
    let (Some(at), Some(size)) = (entity.point(10, scale), entity.number(40)) else {
        read.notes.push("MTEXT without all of its numbers".into());
        return;
    };
    let size = scale * size;
    // by the way of its lines, else by an angle
    let turn = match (entity.number(11), entity.number(21)) {
        (Some(x), Some(y)) => atan2(y, x),
        _ => entity.number(50).unwrap_or(0.0).to_radians(),
    };
    let parts = entity.values.iter().filter(|(code, _)| matches!(code, 1 | 3));
    let coded: String = parts.map(|(_, part)| *part).collect();
    let (words, is_set) = plain(&coded);
    if is_set {
        read.notes.push("how the letters of an MTEXT are set: its words are taken over".into());
    }
    let words: Vec<&str> = words.lines().collect();
    // which of its nine corners and middles its place is: along the top first
    let place = entity.number(71).map_or(0, |place| (place as i64 - 1).clamp(0, 8));
    let rows = words.len() as f64 - 1.0;
    let first = match place / 3 {
        0 => -size,
        1 => 0.5 * (rows * LEADING - 1.0) * size,
        _ => rows * LEADING * size,
    };
    for (i, words) in words.into_iter().enumerate().filter(|(_, w)| !w.trim().is_empty()) {
        let words = words.trim().to_string();
        let ahead = -0.5 * (place % 3) as f64 * metrics::text_width(&words, size);
        let way = Point { x: ahead, y: first - LEADING * size * i as f64 };
        read.found.push(found(Figure::Words { at: beside(at, way, turn), words, size, turn }));
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
