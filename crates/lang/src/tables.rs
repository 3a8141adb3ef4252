//! Tables beside a text: what is allowed of a parameter may come from a column of one, `d: Length in "bolts.csv".d`.
//!
//! A table is CSV: a line that begins with `#` is a comment, the first other line names the columns, each with its unit where it has one, `d [mm]`.

use crate::files::File;
use crate::kinds::Kind;
use crate::lower::{Lowered, Lowerer};
use crate::names::LONGEST_WORD;
use crate::numbers::{Wanted, read_literal};
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use indexmap::IndexMap;
use kernel::program::Allowed;
use kernel::{ClassId, ClassKind, Document, Literal, Primitive, Term};
use std::collections::BTreeSet;
use std::rc::Rc;
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

/// A table as it is read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Table {
    /// The names of its columns, each with its unit, or with nothing.
    pub columns: Vec<(String, String)>,
    /// Its rows, without the first line.
    pub rows: Vec<Row>,
    /// The first cells of its comments, `#8` of `#8,4.2`: where one is missed a row was meant.
    pub comments: BTreeSet<String>,
}

/// A table, or why a text is none.
pub type Reading = Result<Rc<Table>, String>;

/// A row of a table.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Row {
    /// The line that it begins in, from 1.
    pub line: u32,
    /// What stands in it, column by column; there may be fewer, or more, than the table has columns.
    pub cells: Vec<String>,
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// Why the text is no table.
    pub fn read(text: &str) -> Result<Self, String> {
        if text.contains(char::REPLACEMENT_CHARACTER) {
            return Err("it has U+FFFD, which stands for what is no text in UTF-8: save it as such, without that character".into());
        }
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(COMMENT))
            .trim(csv::Trim::All)
            .flexible(true)
            .from_reader(text.as_bytes());
        let unreadable = |e: csv::Error| e.to_string();
        let header = reader.headers().map_err(unreadable)?;
        if let Some(sign) = other_sign(text, header) {
            return Err(format!(
                "{sign} stand between its cells: save it with commas between them, and with decimal points"
            ));
        }
        let columns = header.iter().map(name_and_unit).collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(unreadable)?;
            let line = record.position().map_or(0, |position| line_of(text, position));
            rows.push(Row { line, cells: record.iter().map(str::to_string).collect() });
        }
        Ok(Self { columns, rows, comments: comments_of(text) })
    }

    /// Lists the names of its columns.
    pub fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// Lists what stands in a column, each with its line, as it is typed for a value of a class; nothing where there is
    /// no such column. Empty cells and what stood before are left out.
    pub fn values(
        &self,
        column: &str,
        (document, class): (&Document, ClassId),
    ) -> Option<Vec<(u32, String)>> {
        let at = self.columns.iter().position(|(name, _)| name == column)?;
        let unit = &self.columns[at].1;
        let mut all: IndexMap<String, u32> = IndexMap::new();
        for row in &self.rows {
            if let Some(cell) = row.cells.get(at).filter(|cell| !cell.is_empty()) {
                all.entry(with_unit(document, class, cell, unit)).or_insert(row.line);
            }
        }
        Some(all.into_iter().map(|(cell, line)| (line, cell)).collect())
    }
}

/// Returns what stands between the cells of a table whose header is one column, unless that column is in quotes.
fn other_sign(text: &str, header: &csv::StringRecord) -> Option<&'static str> {
    let is_record = |line: &&str| !line.is_empty() && line.as_bytes().first() != Some(&COMMENT);
    let line = text.trim_start_matches('\u{feff}').lines().find(is_record)?.trim();
    let quoted = line.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    let is_quoted = quoted.is_some_and(|column| !column.contains('"'));
    let column = header.get(0).filter(|_| header.len() == 1 && !is_quoted)?;
    match column.find([';', '\t']).map(|at| &column[at..=at])? {
        ";" => Some("`;`"),
        _ => Some("tabs"),
    }
}

/// What begins a comment.
const COMMENT: u8 = b'#';

/// Lists the first cells of the comments of a table that are as long as cells are.
fn comments_of(text: &str) -> BTreeSet<String> {
    let comments = text.lines().filter(|line| line.as_bytes().first() == Some(&COMMENT));
    let cells = comments.filter_map(|line| line.split(',').next());
    cells.filter(|cell| cell.len() <= LONGEST_WORD).map(|cell| cell.trim().to_string()).collect()
}

/// Returns the line of a record whose position is that of the comments and the empty lines before it.
pub fn line_of(text: &str, position: &csv::Position) -> u32 {
    let rest = text.get(position.byte() as usize..).unwrap_or_default();
    let is_none = |line: &&str| {
        line.as_bytes().first() == Some(&COMMENT) || line.trim_end_matches(['\r', '\n']).is_empty()
    };
    let before = rest.split_inclusive('\n').take_while(is_none).count();
    u32::try_from(position.line() + before as u64).unwrap_or(u32::MAX)
}

/// Returns the name and the unit of a header: `outer [mm]`.
fn name_and_unit(header: &str) -> (String, String) {
    match header.split_once('[') {
        Some((name, unit)) => {
            (name.trim().to_string(), unit.trim_end_matches([']', ' ']).trim().to_string())
        }
        None => (header.trim().to_string(), String::new()),
    }
}

/// Returns a cell as it is typed for a value of a class: a bare number that measures something has the unit of its column.
pub fn with_unit(document: &Document, class: ClassId, cell: &str, unit: &str) -> String {
    let is_real = matches!(document.classes[class].kind, ClassKind::Primitive(Primitive::Real(_)));
    match is_real && !unit.is_empty() && cell.parse::<f64>().is_ok() {
        true => format!("{cell} {unit}"),
        false => cell.to_string(),
    }
}

/// The end of the name of a table.
const SUFFIX: &str = ".csv";

/// Returns true for what a table beside a text may be called: `bolts.csv`, `iso.4014.csv`, `parts/M8 bolts.csv`.
pub fn is_name(name: &str) -> bool {
    let Some(stem) = name.strip_suffix(SUFFIX) else { return false };
    let (folders, last) = stem.rsplit_once('/').map_or((None, stem), |(f, last)| (Some(f), last));
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let is_folder = |part: &str| !part.is_empty() && part.chars().all(plain);
    let is_last = !last.is_empty()
        && !last.starts_with('.')
        && last.trim() == last
        && last.chars().all(|c| plain(c) || matches!(c, '.' | ' '));
    is_last && folders.is_none_or(|folders| folders.split('/').all(is_folder))
}

/// What a text calls a file beside it: from the folder of the document.
pub fn beside(user: &str, file: &str) -> String {
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

    fn read_table(&mut self, load: &dyn Fn(&str) -> Option<String>, file: FileId, column: &Column) {
        // what stands between the quotes
        let span = column.file.span();
        let span = Span::new(span.start + 1, span.end.max(span.start + 2) - 1);
        let place = Place { file, span };
        if !is_name(&column.file()) {
            let message = format!("`{}` is no name of a table", column.file());
            let d = Diagnostic::error("not-a-table", place, message);
            return self.report(d.hint("a table lies beside the text, as `bolts.csv`"));
        }
        let name = beside(&self.files[file].name, &column.file());
        // what is missing is told once
        if self.table(&name).is_some() || self.missing.contains(&name) {
            return;
        }
        let Some(text) = load(&name) else {
            let message = format!("there is no table {} beside this one", column.file());
            self.missing.insert(name);
            return self.report(Diagnostic::error("missing-table", place, message));
        };
        let known = self.before.and_then(|before| {
            let mut files = before.files.iter().map(|(_, known)| known);
            files.find(|known| known.is_table() && known.name == name && *known.text == *text)
        });
        let read = known.cloned().unwrap_or_else(|| File {
            name,
            text: text.as_str().into(),
            parse: syntax::parse(self.files.next_id(), ""),
            table: Some(Table::read(&text).map(Rc::new)),
        });
        self.files.push(read);
    }

    fn table(&self, name: &str) -> Option<&Reading> {
        let mut files = self.files.iter().map(|(_, file)| file);
        files.find(|file| file.is_table() && file.name == name)?.table.as_ref()
    }

    /// Returns the values of a column as those that are allowed of a parameter.
    pub(crate) fn allowed_by(
        &mut self,
        scope: &Scope,
        (column, span): (&Column, Span),
        parameter: &Name,
    ) -> Option<Allowed> {
        let class = self.class_of_part(scope.class(), parameter)?;
        // what is missing is told where it is read
        let table = self.table(&beside(&self.files[scope.file].name, &column.file()))?.clone();
        let place = Place { file: scope.file, span };
        let (file, named) = (column.file(), column.name());
        let table = match table {
            Ok(table) => table,
            Err(why) => {
                let d = Diagnostic::error("no-column", place, format!("{file} is no table"));
                self.report(d.hint(format!("it cannot be read: {why}")));
                return None;
            }
        };
        let Some(all) = table.values(named, (&self.document, class)) else {
            let message = format!("{file} has no column {named}");
            let d = Diagnostic::error("no-column", place, message);
            self.report(d.hint(format!("it has {}", table.names().join(", "))));
            return None;
        };
        if all.is_empty() {
            let message = format!("column {named} of {file} has no values");
            self.report(Diagnostic::error("no-column", place, message));
            return None;
        }
        let mut values = Vec::new();
        for (line, cell) in all {
            let read = read_literal(&cell, Wanted::Class(class), &self.document);
            let Some(value) = read.ok().and_then(|read| term_of(&self.document, class, read))
            else {
                let wanted = Kind::of_class(&self.document, class).words(&self.document);
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
}

impl Lowered {
    /// Returns what to do where a value is missed in a table that has it as a comment: `#8` of `#8,4.2`.
    pub fn missed_row(&self, value: &str) -> Option<String> {
        let tables = self.files.iter().filter_map(|(_, file)| file.table.as_ref()?.as_ref().ok());
        let is_one = tables.into_iter().any(|table| table.comments.contains(value));
        is_one.then(|| {
            format!("a line that begins with `#` is a comment of the table: `\"{value}\"` in quotes is a value")
        })
    }
}

/// Returns the expression that a value of a class is.
fn term_of(document: &Document, class: ClassId, value: Literal) -> Option<Term> {
    Some(match (value, &document.classes[class].kind) {
        (Literal::Number(at), ClassKind::Primitive(Primitive::Choice(of))) => {
            Term::Option(*of, at as u32)
        }
        (Literal::Number(value), _) => {
            let Kind::Number(Some(dimension)) = Kind::of_class(document, class) else {
                return None;
            };
            Term::Number { value, dimension, bare: false }
        }
        (Literal::Text(text), _) => Term::Text(text),
        (Literal::Bool(is), _) => Term::Bool(is),
        (Literal::Tuple(items), _) => {
            let fields = document.layout(class).into_iter().map(|f| document.field_class(f));
            let each = items.into_iter().zip(fields);
            Term::Tuple(each.map(|(item, of)| term_of(document, of, item)).collect::<Option<_>>()?)
        }
        (Literal::Path(_), _) => return None,
    })
}
