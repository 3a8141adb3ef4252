//! Operands as they are typed: `3,4`, `@10,0`, `20<45`, a number, any expression.

use super::catalogue::{Slot, SlotKind};
use crate::view::{Pointer, Refusal};
use crate::words;
use base::number::shortest;

/// Writes the place of the sheet where a pointer is: on the pointer's grid, unless it finds nothing.
pub(crate) fn place(pointer: &Pointer) -> String {
    format!("Point({}, {})", coordinate(pointer, "x"), coordinate(pointer, "y"))
}

/// Writes how far to the right a pointer is, or how far up.
pub(crate) fn coordinate(pointer: &Pointer, axis: &str) -> String {
    let x = if axis == "x" { pointer.at.0 } else { pointer.at.1 };
    let tidy = match pointer.grid > 0.0 && !pointer.alone {
        true => {
            let parts = (x / pointer.grid).round();
            // a grid of 0.1 is written by tenths
            let inverse = (1.0 / pointer.grid).round();
            if inverse > 1.0 { parts / inverse } else { parts * pointer.grid }
        }
        false => x,
    };
    shortest(if tidy == 0.0 { 0.0 } else { tidy })
}

/// Returns what is typed as the language writes it. `last` is the point that was given last.
///
/// # Errors
/// Nothing is typed; a place is said from a point, and there is none.
pub(crate) fn operand(slot: &Slot, typed: &str, last: Option<&str>) -> Result<String, Refusal> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Err(words::refuse(format!("{} is wanted", slot.name)));
    }
    let from = || {
        let none = || words::refuse(format!("{typed} goes from a point, and none was given yet"));
        last.map(String::from).ok_or_else(none)
    };
    Ok(match slot.kind {
        SlotKind::Curve | SlotKind::Set => typed.into(),
        SlotKind::Value if *slot.class == *"Angle" && is_number(typed) => format!("{typed} deg"),
        SlotKind::Value => typed.into(),
        SlotKind::Point => match (typed.strip_prefix('@'), pair(typed, '<')) {
            (Some(by), _) => {
                let wrong = || words::refuse(format!("{typed}: `@dx,dy` is wanted"));
                let (dx, dy) = pair(by, ',').ok_or_else(wrong)?;
                let from = from()?;
                let (x, y) = match coordinates(&from) {
                    Some((x, y)) => (x.into(), y.into()),
                    None => (format!("{from}.x"), format!("{from}.y")),
                };
                format!("Point({}, {})", further(&x, dx), further(&y, dy))
            }
            (None, Some((length, angle))) => {
                let angle = if is_number(angle) { format!("{angle} deg") } else { angle.into() };
                format!("Point.polar(from: {}, distance: {length}, angle: {angle})", from()?)
            }
            (None, None) => match pair(typed, ',') {
                Some((x, y)) => format!("Point({x}, {y})"),
                None => typed.into(),
            },
        },
    })
}

fn is_number(text: &str) -> bool {
    text.trim().parse::<f64>().is_ok()
}

/// The coordinates of a point that is written by them: `Point(10, d / 2)`.
fn coordinates(point: &str) -> Option<(&str, &str)> {
    let inner = point.strip_prefix("Point(")?.strip_suffix(')')?;
    // `Point(1, 2).moved(by: Point(3, 4))` is another one
    let is_one = is_within_brackets(inner) && !inner.contains(':');
    pair(inner, ',').filter(|_| is_one)
}

/// Whether no bracket is closed that was not opened.
fn is_within_brackets(text: &str) -> bool {
    let mut depth = 0;
    text.chars().all(|c| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        depth >= 0
    })
}

/// Writes a coordinate so much further on.
fn further(from: &str, by: &str) -> String {
    match by.trim() {
        "0" => from.into(),
        by if from == "0" => by.into(),
        by => match by.strip_prefix('-') {
            Some(less) if is_plain(less) => format!("{from} - {less}"),
            _ => format!("{from} + {}", grouped(by)),
        },
    }
}

/// Whether an expression is a single name or number.
fn is_plain(text: &str) -> bool {
    text.chars().all(|c| c.is_alphanumeric() || "._ ".contains(c))
}

/// Writes an expression so that it can be added.
fn grouped(text: &str) -> String {
    if is_plain(text) { text.into() } else { format!("({text})") }
}

/// Splits what is typed in two, outside of any brackets.
pub(super) fn pair(text: &str, at: char) -> Option<(&str, &str)> {
    let mut depth = 0;
    let split = text.char_indices().find(|(_, c)| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        depth == 0 && *c == at
    });
    let (i, _) = split?;
    let (a, b) = (text[..i].trim(), text[i + at.len_utf8()..].trim());
    (!a.is_empty() && !b.is_empty()).then_some((a, b))
}
