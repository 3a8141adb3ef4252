//! Tables beside a text: what is allowed of a parameter may come from a column of one, `d: Length in "bolts.csv".d`.
//!
//! A table is CSV: `#` begins a comment, the first line names the columns, each with its unit where it has one, `d [mm]`.

use crate::files::File;
use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, FileId, Place, Span};
use kernel::Term;
use kernel::program::Allowed;
use std::fmt;
use syntax::SyntaxKind;
use syntax::ast::{AstNode, Expr, Member, TextExpr, Word};

/// A column that a domain names.
#[derive(Clone, Debug)]
pub struct Column {
    /// The file, as it is written.
    file: TextExpr,
    /// The column.
    name: Word,
}

/// Reads `"bolts.csv".d`; nothing else.
pub fn column_of(domain: &Expr) -> Option<Column> {
    let Expr::Field(field) = domain else { return None };
    let (Expr::Text(file), None) = (field.receiver()?, field.args()) else { return None };
    file.plain()?;
    Some(Column { file, name: field.name()? })
}

impl Column {
    /// The name of the file.
    pub fn file(&self) -> String {
        self.file.plain().unwrap_or_default()
    }
    /// The name of the column.
    pub fn name(&self) -> &str {
        self.name.text()
    }
}

/// Why a column gives no values.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NoColumn {
    /// The text is no table.
    Unreadable(String),
    /// It has other columns.
    Missing(Vec<String>),
}

impl fmt::Display for NoColumn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(why) => write!(f, "it cannot be read: {why}"),
            Self::Missing(names) => write!(f, "it has {}", names.join(", ")),
        }
    }
}

/// Returns the name and the unit of a header: `outer [mm]`.
pub fn name_and_unit(header: &str) -> (String, String) {
    match header.split_once('[') {
        Some((name, unit)) => {
            (name.trim().to_string(), unit.trim_end_matches([']', ' ']).trim().to_string())
        }
        None => (header.trim().to_string(), String::new()),
    }
}

/// Lists the cells of a column of a table, each with its line, its number with the unit of the column; empty cells and
/// what stood before are left out.
///
/// # Errors
/// The text is no table, or has no such column.
pub fn cells(table: &str, column: &str) -> Result<Vec<(u64, String)>, NoColumn> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(table.as_bytes());
    let unreadable = |e: csv::Error| NoColumn::Unreadable(e.to_string());
    let columns: Vec<_> = reader.headers().map_err(unreadable)?.iter().map(name_and_unit).collect();
    let at = columns.iter().position(|(name, _)| name == column);
    let names = || columns.iter().map(|(name, _)| name.clone()).collect();
    let at = at.ok_or_else(|| NoColumn::Missing(names()))?;
    let unit = &columns[at].1;
    let mut all: Vec<(u64, String)> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(unreadable)?;
        let cell = record.get(at).unwrap_or_default();
        let cell = match !unit.is_empty() && cell.parse::<f64>().is_ok() {
            true => format!("{cell} {unit}"),
            false => cell.to_string(),
        };
        if !cell.is_empty() && !all.iter().any(|(_, known)| *known == cell) {
            all.push((record.position().map_or(0, csv::Position::line), cell));
        }
    }
    Ok(all)
}

/// What a text calls a file beside it: from the folder of the document.
fn beside(user: &str, file: &str) -> String {
    match user.rsplit_once('.') {
        Some((folder, _)) => format!("{}/{file}", folder.replace('.', "/")),
        None => file.into(),
    }
}

impl Lowerer<'_> {
    /// Reads the tables that the parameters of a text's programs name; `load` returns their texts.
    pub(crate) fn read_tables(&mut self, load: &dyn Fn(&str) -> Option<String>, file: FileId) {
        for member in self.files[file].members_of(&[SyntaxKind::Program]) {
            let Member::Program(program) = member else { continue };
            let params = program.params().into_iter().flat_map(|list| list.params());
            for column in params.filter_map(|param| column_of(&param.domain()?)) {
                self.read_table(load, file, &column);
            }
        }
    }

    fn read_table(
        &mut self,
        load: &dyn Fn(&str) -> Option<String>,
        file: FileId,
        column: &Column,
    ) {
        let name = beside(&self.files[file].name, &column.file());
        if self.files.iter().any(|(_, known)| known.name == name) {
            return;
        }
        match load(&name) {
            Some(text) => {
                let parse = syntax::parse(self.files.next_id(), "");
                self.files.push(File { name, text: text.as_str().into(), parse });
            }
            None => {
                // what stands between the quotes
                let span = column.file.span();
                let span = Span::new(span.start + 1, span.end.max(span.start + 2) - 1);
                let message = format!("there is no table {} beside this one", column.file());
                self.error("missing-table", file, span, message);
            }
        }
    }

    /// Returns the values of a column as those that are allowed.
    pub(crate) fn allowed_by(
        &mut self,
        scope: &Scope,
        (column, span): (&Column, Span),
        kind: &Kind,
    ) -> Option<Allowed> {
        let name = beside(&self.files[scope.file].name, &column.file());
        // what is missing is told where it is read
        let table = self.files.iter().find(|(_, known)| known.name == name)?.1.text.clone();
        let place = Place { file: scope.file, span };
        let (file, named) = (column.file(), column.name());
        let all = match cells(&table, named) {
            Ok(all) if all.is_empty() => {
                let message = format!("column {named} of {file} has no values");
                self.report(Diagnostic::error("no-column", place, message));
                return None;
            }
            Ok(all) => all,
            Err(why) => {
                let message = match &why {
                    NoColumn::Missing(_) => format!("{file} has no column {named}"),
                    NoColumn::Unreadable(_) => format!("{file} is no table"),
                };
                let d = Diagnostic::error("no-column", place, message);
                self.report(d.hint(why.to_string()));
                return None;
            }
        };
        let mut values = Vec::new();
        for (line, cell) in all {
            let Some(value) = self.cell(scope, &cell, kind) else {
                let wanted = kind.words(&self.document);
                let message = format!(
                    "found `{cell}` in line {line} of {file}, column {named}, wanted {wanted}"
                );
                self.report(Diagnostic::error("wrong-cell", place, message));
                return None;
            };
            values.push(value);
        }
        Some(Allowed::OneOf(values))
    }

    /// Reads a cell as a value.
    fn cell(&mut self, scope: &Scope, cell: &str, kind: &Kind) -> Option<Term> {
        let written = match kind {
            Kind::Text => crate::quoted(cell),
            _ => cell.to_string(),
        };
        let parse = syntax::parse_expression(scope.file, &written);
        let value = parse.file().expression().filter(|_| parse.diagnostics().is_empty())?;
        self.silent += 1;
        let term = self.expr_of(scope, &value, kind);
        self.silent -= 1;
        term
    }
}
