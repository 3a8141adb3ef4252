//! Lengths with a unit beside lengths without one, in a text that does not say what these are.
//!
//! Without `unit mm` a bare length counts in plain units of the sheet, each one metre to what has a unit: `5 cm` is
//! 0.05 of them. Few writers mean that, so it is said.

use crate::checks::StatementKind;
use crate::lower::{Lowered, OWN};
use base::{Diagnostic, Place};
use expr::dimension::Dimension;
use kernel::Term;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, NumberExpr};

/// The code of the warning.
const CODE: &str = "mixed-lengths";

/// Returns true for a unit of length that may be that of a sheet, but for the metre.
pub fn is_unit_of_sheet(unit: &str) -> bool {
    let one = expr::units::read_quantity("1", unit);
    one.is_some_and(|(metres, dimension)| dimension == Dimension::LENGTH && metres != 1.0)
}

impl Lowered {
    /// Returns true where the text, or a file that it uses, states a quantity that is made of lengths: `2 m`,
    /// `9.81 m/s^2`, `4 N`.
    ///
    /// Cost: a look at every node of them.
    pub fn measures_lengths(&self) -> bool {
        let used = self.files.iter().filter(|(id, _)| *id != OWN).map(|(_, file)| &file.parse);
        let all = std::iter::once(&self.effective_parse).chain(used);
        let stated: Vec<NumberExpr> = all.flat_map(crate::scale::stated).collect();
        let mut quantities = stated.iter().filter_map(crate::scale::quantity);
        quantities.any(|(_, Dimension([length, ..]))| length != 0)
    }

    /// Returns a warning where the text gives bare lengths, others with a unit that is not the metre, and names no
    /// unit of its sheet.
    ///
    /// Cost: a look at every node of the text, where it writes lengths.
    pub fn mixed_lengths(&self) -> Option<Diagnostic> {
        if self.document.writes_lengths { self.mixed_with_units() } else { None }
    }

    #[cold]
    #[inline(never)]
    fn mixed_with_units(&self) -> Option<Diagnostic> {
        let stated = crate::scale::stated(&self.effective_parse);
        let (si, number) =
            stated.into_iter().find_map(|number| Some((length(&number)?, number)))?;
        let bare = self.first_bare_length()?;
        let unit = number.unit()?;
        let (written, unit) = (number.syntax().text(), unit.text());
        let is = base::number::shortest(si);
        let message = format!("{written} is {is} here, where other lengths have no unit");
        let place = Place { file: OWN, span: number.span() };
        let d = Diagnostic::warning(CODE, place, message).label(bare, "this has none");
        Some(d.hint(format!(
            "say what a length without a unit is: `unit {unit}`, in a line of its own"
        )))
    }

    /// Returns where the text first gives a length without a unit, or a check sets one, if it does.
    fn first_bare_length(&self) -> Option<Place> {
        let givens = self.document.classes.iter().flat_map(|(_, class)| &class.givens);
        // a length whose unit is unknown has one
        let unknown = self.diagnostics.iter().filter(|d| d.code == "unknown-unit");
        let unknown: BTreeSet<u32> =
            unknown.filter(|d| d.place.file == OWN).map(|d| d.place.span.start).collect();
        let is_unknown = |at: Place| unknown.range(at.span.start..at.span.end).next().is_some();
        let mut bare = givens.filter(|g| {
            let place = self.place(g.origin);
            place.file == OWN && has_bare(&g.value) && !is_unknown(place)
        });
        let statements = self.checks.iter().flat_map(|check| &check.statements);
        let mut set = statements.filter(|statement| sets_bare(&statement.kind));
        let given = bare.next().map(|g| self.place(g.origin));
        given.or_else(|| set.next().map(|s| Place { file: OWN, span: s.span }))
    }
}

/// Returns how many metres a number with a unit is; nothing for what is zero, written in metres or no length.
fn length(number: &NumberExpr) -> Option<f64> {
    let (digits, unit) = (number.digits()?, number.unit()?);
    let (si, dimension) = expr::units::read_quantity(digits.text(), unit.text())?;
    let (one, _) = expr::units::read_quantity("1", unit.text())?;
    (dimension == Dimension::LENGTH && si != 0.0 && one != 1.0).then_some(si)
}

/// Returns true for a statement of a check that sets or moves something to a length without a unit.
fn sets_bare(statement: &StatementKind) -> bool {
    match statement {
        StatementKind::Set(targets) | StatementKind::Move(targets) => {
            targets.iter().any(|(_, value)| has_bare(value))
        }
        StatementKind::Try(inner) => sets_bare(inner),
        StatementKind::Note(..)
        | StatementKind::Command(_)
        | StatementKind::Expect(_)
        | StatementKind::Unclear => false,
    }
}

fn has_bare(term: &Term) -> bool {
    match term {
        Term::Number { value, dimension, bare } => {
            *bare && *value != 0.0 && *dimension == Dimension::LENGTH
        }
        Term::Tuple(items) | Term::List(items) => items.iter().any(has_bare),
        _ => false,
    }
}
