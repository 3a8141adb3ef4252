//! Operands as they are typed: `3,4`, `@10,0`, `20<45`, a number, any expression.

use super::catalogue::{Slot, SlotKind};
use crate::view::{Pointer, Refusal};
use crate::words;
use base::number::shortest;
use syntax::ast::{BinaryOp, Expr, UnaryOp};

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
/// Nothing is typed; no `dx,dy` or `length<angle` follows `@`.
pub(crate) fn operand(slot: &Slot, typed: &str, last: Option<&str>) -> Result<String, Refusal> {
    let typed = typed.trim();
    if typed.is_empty() {
        if let Some(usual) = slot.asks.as_ref().and_then(|asks| asks.usual.clone()) {
            return match slot.kind {
                SlotKind::Point => at(&usual, ""),
                _ => Ok(usual),
            };
        }
        return Err(words::refuse(format!("{} is wanted", slot.name)));
    }
    if slot.is_list {
        return Ok(if typed.starts_with('[') { typed.into() } else { format!("[{typed}]") });
    }
    if matches!(said(typed), Said::Pair(..))
        && let Some(wanted) = instead_of_a_place(slot)
    {
        return Err(words::refuse(format!("{typed} is a place, but {} is {wanted}", slot.name)));
    }
    Ok(match slot.kind {
        SlotKind::Curve | SlotKind::Set => typed.into(),
        SlotKind::Edges if typed.starts_with('[') => typed.into(),
        SlotKind::Edges => format!("[{typed}]"),
        SlotKind::Value if *slot.class == *"Bool" => truth(typed).into(),
        SlotKind::Value if *slot.class == *"Angle" && is_number(typed) => format!("{typed} deg"),
        SlotKind::Value => typed.into(),
        // before any point was given, one goes from where the axes cross
        SlotKind::Point | SlotKind::Places => at(typed, last.unwrap_or("Point(0, 0)"))?,
    })
}

/// What is wanted where a place is not.
fn instead_of_a_place(slot: &Slot) -> Option<&'static str> {
    match slot.kind {
        SlotKind::Curve | SlotKind::Set | SlotKind::Edges => {
            Some("a figure: pick it, or type its name")
        }
        SlotKind::Value if *slot.class == *"Text" => None,
        SlotKind::Value => Some("a value, whose tenths stand after a point: 3.4"),
        SlotKind::Point | SlotKind::Places => None,
    }
}

/// Writes a place that is typed: `3,4`, from another point `@10,0` and `20<45`, or any expression.
///
/// # Errors
/// Something else follows `@`.
pub(crate) fn at(typed: &str, from: &str) -> Result<String, Refusal> {
    let typed = typed.trim();
    let by = typed.strip_prefix('@');
    Ok(match (by, said(by.unwrap_or(typed))) {
        (Some(by), Said::Whole) => {
            let wanted = if by.starts_with('@') { "one `@`" } else { "`@dx,dy`" };
            return Err(words::refuse(format!("{typed}: {wanted} is wanted")));
        }
        (Some(_), Said::Pair(dx, dy)) => {
            let (x, y) = match coordinates(from) {
                Some((x, y)) => (x.into(), y.into()),
                None => {
                    let from = grouped(from);
                    (format!("{from}.x"), format!("{from}.y"))
                }
            };
            format!("Point({}, {})", further(&x, dx), further(&y, dy))
        }
        // `@20<45` is what other programs want
        (_, Said::Polar(length, angle)) => {
            let angle = if is_number(angle) { format!("{angle} deg") } else { angle.into() };
            format!("Point.polar(from: {from}, distance: {length}, angle: {angle})")
        }
        (None, Said::Pair(x, y)) => format!("Point({x}, {y})"),
        // a program may say it so, and so do its steps
        (None, Said::Whole) => match in_brackets(typed) {
            Some((x, y)) => format!("Point({x}, {y})"),
            None => typed.into(),
        },
    })
}

/// The two numbers of `(3, 4)`.
fn in_brackets(typed: &str) -> Option<(&str, &str)> {
    let is_tuple = matches!(expression(typed), Some(Expr::Tuple(_)));
    pair(typed.strip_prefix('(')?.strip_suffix(')')?, ',').filter(|_| is_tuple)
}

/// How a place is typed.
enum Said<'a> {
    /// As any expression, or as nothing that can be read.
    Whole,
    /// `x,y`
    Pair(&'a str, &'a str),
    /// `length<angle`
    Polar(&'a str, &'a str),
}

/// Tells how a place is typed. What is an expression by itself is taken apart only where it is a bare `a < b`:
/// `if d < 5 then p else q` is one place.
fn said(typed: &str) -> Said<'_> {
    let is_less = |e: &Expr| matches!(e, Expr::Binary(b) if b.op() == Some(BinaryOp::Less));
    let polar = || pair(typed, '<').map(|(length, angle)| Said::Polar(length, angle));
    let found = match expression(typed) {
        Some(whole) if is_less(&whole) => polar(),
        Some(_) => None,
        None if typed.starts_with('@') => None,
        None => pair(typed, ',').map(|(x, y)| Said::Pair(x, y)).or_else(polar),
    };
    found.unwrap_or(Said::Whole)
}

/// Whether what is typed goes on from a point.
pub(crate) fn goes_from(typed: &str) -> bool {
    let typed = typed.trim();
    typed.starts_with('@') || matches!(said(typed), Said::Polar(..))
}

/// A yes or no as the language writes it.
pub(super) fn truth(typed: &str) -> &str {
    match typed.to_lowercase().as_str() {
        "yes" => "true",
        "no" => "false",
        _ => typed,
    }
}

pub(super) fn is_number(text: &str) -> bool {
    text.trim().parse::<f64>().is_ok()
}

/// The coordinates of a point that is written by them: `Point(10, d / 2)`.
pub(super) fn coordinates(point: &str) -> Option<(&str, &str)> {
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
    let to = if is_sum(expression(from).as_ref()) { from.into() } else { format!("({from})") };
    match by.trim() {
        "0" => from.into(),
        by if from == "0" => by.into(),
        by => match by.strip_prefix('-') {
            Some(less) if is_operand(less) => format!("{to} - {}", less.trim()),
            _ => format!("{to} + {}", grouped(by)),
        },
    }
}

/// Reads an expression; nothing where the text is none.
pub(super) fn expression(text: &str) -> Option<Expr> {
    let parse = syntax::parse_expression(base::FileId(0), text);
    parse.file().expression().filter(|_| parse.diagnostics().is_empty())
}

/// Whether something can be added to an expression as it stands: it is of operands and arithmetic, without `if` and
/// `let`, which would take in what follows.
fn is_sum(expression: Option<&Expr>) -> bool {
    match expression {
        Some(Expr::Unary(unary)) => {
            unary.op() != Some(UnaryOp::Not) && is_sum(unary.operand().as_ref())
        }
        Some(Expr::Binary(binary)) => {
            let is_arithmetic = matches!(
                binary.op(),
                Some(
                    BinaryOp::Add
                        | BinaryOp::Subtract
                        | BinaryOp::Multiply
                        | BinaryOp::Divide
                        | BinaryOp::Remainder
                        | BinaryOp::Power
                )
            );
            is_arithmetic && is_sum(binary.left().as_ref()) && is_sum(binary.right().as_ref())
        }
        Some(expression) => is_single(expression),
        None => false,
    }
}

/// Whether an expression is a single operand: a number, a name, a part, a call, something in brackets.
fn is_operand(text: &str) -> bool {
    expression(text).is_some_and(|expression| is_single(&expression))
}

fn is_single(expression: &Expr) -> bool {
    matches!(
        expression,
        Expr::Number(_)
            | Expr::Name(_)
            | Expr::Owner(_)
            | Expr::Field(_)
            | Expr::Call(_)
            | Expr::Index(_)
            | Expr::Paren(_)
    )
}

/// Writes an expression as an operand.
fn grouped(text: &str) -> String {
    if is_operand(text) { text.into() } else { format!("({text})") }
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

#[cfg(test)]
mod tests {
    use super::further;

    #[test]
    fn a_step_from_a_choice_is_not_taken_into_its_last_branch() {
        assert_eq!(further("if d > 5 then 1 else 2", "3"), "(if d > 5 then 1 else 2) + 3");
        assert_eq!(further("if d then 1 else 2", "-3"), "(if d then 1 else 2) - 3");
        assert_eq!(further("2 * if d then 1 else 2", "3"), "(2 * if d then 1 else 2) + 3");
        assert_eq!(further("let a = d in a", "3"), "(let a = d in a) + 3");
        assert_eq!(further("1", "if d then 1 else 2"), "1 + (if d then 1 else 2)");
        // a choice that goes no further needs no brackets
        assert_eq!(further("if d then 1 else 2", "0"), "if d then 1 else 2");
    }

    #[test]
    fn steps_in_a_row_make_one_sum() {
        assert_eq!(further("10 + 5", "-3"), "10 + 5 - 3");
        assert_eq!(further("-d / 2", "2 * d"), "-d / 2 + (2 * d)");
        assert_eq!(further("a.b(c)", "d.x"), "a.b(c) + d.x");
    }
}
