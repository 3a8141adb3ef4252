//! A case as a document: points, lines and arcs, and the library's constraints merged with them.

use crate::case::{Case, Constraint, End};
use std::fmt::Write as _;

/// Writes a case in the language.
///
/// Point 3 is called `p3`, line 3 `l3`, arc 3 `a3`, constraint 3 `c3`. Coincident points are merged.
pub fn text(case: &Case) -> String {
    let mut out = format!("/// {}\nuse geometry\n\n", case.name);
    write(&mut out, case).expect("writing to a string does not fail");
    out
}

fn write(out: &mut String, case: &Case) -> std::fmt::Result {
    for (i, [x, y]) in case.start.iter().enumerate() {
        writeln!(out, "p{i}: Point = ({x}, {y})")?;
    }
    for (i, [p, q]) in case.lines.iter().enumerate() {
        writeln!(out, "l{i}: Line  merge l{i}.p1 = p{p}  merge l{i}.p2 = p{q}")?;
    }
    for (i, [c, s, e]) in case.arcs.iter().enumerate() {
        write!(out, "a{i}: Arc  merge a{i}.center = p{c}")?;
        writeln!(out, "  merge a{i}.start = p{s}  merge a{i}.end = p{e}")?;
    }
    for (i, constraint) in case.constraints.iter().enumerate() {
        match *constraint {
            Constraint::Fix { p, x, y } => {
                writeln!(out, "c{i}: Pin {{ x = {x}  y = {y} }}  merge c{i}.point = p{p}")
            }
            Constraint::Coincident { p, q } if p == q => Ok(()),
            Constraint::Coincident { p, q } => writeln!(out, "merge c{i}: p{p} = p{q}"),
            Constraint::Horizontal { l } => {
                writeln!(out, "c{i}: HorizontalLine  merge c{i} = l{l}")
            }
            Constraint::Vertical { l } => writeln!(out, "c{i}: VerticalLine  merge c{i} = l{l}"),
            Constraint::Distance { p, q, v } => writeln!(
                out,
                "c{i}: Distance {{ value = {v} }}  merge c{i}.from = p{p}  merge c{i}.to = p{q}"
            ),
            Constraint::EqualLength { l, m } => {
                writeln!(out, "c{i}: EqualLengths  merge c{i}.a = l{l}  merge c{i}.b = l{m}")
            }
            Constraint::ArcRadius { a, v } => {
                writeln!(out, "c{i}: ArcRadius {{ value = {v} }}  merge c{i}.arc = a{a}")
            }
            Constraint::TangentArcLine { a, l, at } => {
                let class = match at {
                    End::Start => "TangentAtStart",
                    End::End => "TangentAtEnd",
                };
                writeln!(out, "c{i}: {class}  merge c{i}.arc = a{a}  merge c{i}.line = l{l}")
            }
            Constraint::Angle { l, m, v } => writeln!(
                out,
                "c{i}: AngleBetween {{ value = {v} }}  merge c{i}.from = l{l}  merge c{i}.to = l{m}"
            ),
        }?;
    }
    Ok(())
}
