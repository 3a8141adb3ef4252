//! Rows that lie outside of what a program demands: told where they stand, before anything is drawn.
//!
//! In: the rows of a family. Out: for each that is outside, why. Rules that speak of what is drawn are left to the run.

use super::{class_of_rows, ended, find, values_of, written_rows};
use crate::host::{Beside, Host};
use crate::session::Session;
use crate::state::State;
use crate::view::{DiagnosticView, DocumentId, FamilyRow, Refusal, TableView};
use base::{Diagnostic, FileId};
use lang::Family;

/// The file of the document's own text.
const OWN: FileId = FileId(0);

/// The code of the warning.
const CODE: &str = "row-outside";

/// Returns a warning for every row of the document's own families that is outside.
///
/// Cost: what the demands cost, for every row that is written out.
pub(crate) fn warnings(state: &State) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for family in &state.lowered.families {
        warn(state, family, &mut found);
    }
    found
}

/// Tells of the rows of one family.
#[cold]
#[inline(never)]
fn warn(state: &State, family: &Family, found: &mut Vec<Diagnostic>) {
    let is_own = state.lowered.place(family.origin).file == OWN;
    let mut read = TableView::default();
    // what cannot be read is told as an error of the text
    if !is_own || family.rows.is_empty() || written_rows(state, family, &mut read).is_err() {
        return;
    }
    let told = of(state, &family.name, &read.rows).unwrap_or_default();
    for (at, message) in told {
        // a wrong row is an error of the text
        if family.rows[at].fault.is_some() {
            continue;
        }
        let place = state.lowered.place(family.rows[at].origin);
        found.push(Diagnostic::warning(CODE, place, message));
    }
}

/// Returns which rows of a family, or of a program, are outside, and why, or have a cell that is no value.
///
/// # Errors
/// No such program, or values that it does not take.
fn of(state: &State, name: &str, rows: &[FamilyRow]) -> Result<Vec<(usize, String)>, Refusal> {
    let (program, family) = find(state, name)?;
    let class = class_of_rows(program, family);
    let rules = family.map_or(&[][..], |family| &family.rules);
    let evaluator = state.evaluator(&state.values);
    let mut found = Vec::new();
    for (at, row) in rows.iter().enumerate() {
        if let Some(fault) = &row.fault {
            found.push((at, format!("the row {} is unclear: {fault}", row.name)));
            continue;
        }
        let values = values_of(state, class, &row.values);
        let run = evaluator.ask_with(class, values);
        let run = run.map_err(|fault| crate::words::refuse(fault.message))?;
        let known = rules.iter().filter(|(_, rule)| evaluator.holds(rule, &run).is_ok());
        let ended = ended(&evaluator, known, &run);
        found.extend(
            ended.map(|(_, _, why)| (at, format!("the row {} is outside: {why}", row.name))),
        );
    }
    Ok(found)
}

impl Session {
    /// Returns what is wrong with the tables of a document's own families: one that is missing or cannot be read, and rows
    /// that lie outside of what is demanded. Nothing is drawn.
    ///
    /// Cost: that of reading the tables, and of the demands for every row.
    pub fn tables_outside(&self, id: DocumentId) -> Vec<DiagnosticView> {
        let state = &self.document(id).state;
        let own = |family: &&Family| state.lowered.place(family.origin).file == OWN;
        let mut found = Vec::new();
        for family in state.lowered.families.iter().filter(own) {
            let Some(table) = &family.table else { continue };
            let place = state.lowered.place(family.origin);
            let read = || {
                let text = Beside::of(&*self.host, &self.documents, id).read(table);
                let missing = || format!("there is no table {table} beside this one");
                let text = text.ok_or_else(|| ("missing-table", missing()))?;
                let unclear = |refusal: Refusal| ("unclear-table", refusal.message);
                let rows = super::rows(state, &family.name, Some(&text)).map_err(unclear)?.rows;
                let told = of(state, &family.name, &rows).map_err(unclear)?;
                Ok((rows, told))
            };
            match read() {
                Err((code, message)) => {
                    let d = Diagnostic::error(code, place, message);
                    found.extend(crate::views::text::diagnostics(state, &[d]));
                }
                Ok((rows, told)) => {
                    let row = |(at, message): (usize, String)| DiagnosticView {
                        severity: "warning".into(),
                        code: CODE.into(),
                        message,
                        file: table.clone(),
                        line: rows[at].line,
                        column: 1,
                        ..DiagnosticView::default()
                    };
                    found.extend(told.into_iter().map(row));
                }
            }
        }
        found
    }
}
