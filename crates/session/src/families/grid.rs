//! The grid of a family: the rows that stand in a document, shown and changed cell by cell.
//!
//! Each change is the text with other rows. Rows of a file are read alone: they are taken into the document first.

use super::{class_of_rows, find, literal, read_table, rows};
use crate::state::State;
use crate::view::{FamilyGrid, FamilyRow, GridColumn, Refusal, TableView};
use crate::words;
use base::Name;
use kernel::program::Allowed;
use kernel::{ClassId, ClassKind, DOCUMENT, Literal, Primitive, Term};
use lang::quoted;
use syntax::ast::{self, AstNode, Member};

/// Shows the rows of a family; `table` is the text of its file, where it has one.
///
/// # Errors
/// No such family, a table that cannot be read.
pub(crate) fn grid(state: &State, name: &str, table: Option<&str>) -> Result<FamilyGrid, Refusal> {
    let (program, family) = find(state, name)?;
    let document = &state.lowered.document;
    let read = match (table, family) {
        (None, None) => TableView::default(),
        (None, Some(family)) if family.table.is_some() => TableView::default(),
        (table, _) => rows(state, name, table)?,
    };
    let asked = document.program(program).map(|p| p.parameters.as_slice()).unwrap_or_default();
    let examples = examples(state, program);
    let column = |(asked, example): (&kernel::program::Asked, String)| GridColumn {
        name: asked.name.to_string(),
        prompt: asked.prompt.clone(),
        example,
        choices: choices(state, program, asked),
    };
    Ok(FamilyGrid {
        name: name.into(),
        program: document.classes[program].name.to_string(),
        table: family.and_then(|f| f.table.clone()),
        is_own: family.is_some_and(|f| f.table.is_none()) && node(&state.text, name).is_some(),
        columns: asked.iter().zip(examples).map(column).collect(),
        rows: read.rows,
        notes: read.notes,
    })
}

/// Returns the values of the program's own example, as they are written.
pub(super) fn examples(state: &State, program: ClassId) -> Vec<String> {
    let document = &state.lowered.document;
    let evaluator = state.evaluator(&state.values);
    let run = evaluator.run_with(program, Vec::new()).ok();
    let asked = document.program(program).map(|p| p.parameters.as_slice()).unwrap_or_default();
    let example = |name: &Name| {
        let answer = evaluator.of_part(&eval::Answer::Context(run.clone()?), name).ok()?;
        let literal = crate::check::literal_of(&answer).ok()?;
        Some(written(state, class_of(state, program, name)?, &literal))
    };
    asked.iter().map(|asked| example(&asked.name).unwrap_or_default()).collect()
}

/// Lists the values of a table of those that a parameter allows.
fn choices<'a>(
    state: &'a State,
    program: ClassId,
    asked: &'a kernel::program::Asked,
) -> Vec<String> {
    let Some(Allowed::OneOf(values)) = &asked.allowed else { return Vec::new() };
    let evaluator = state.evaluator(&state.values);
    let one = |value: &'a Term| {
        let literal = crate::check::literal_of(&evaluator.evaluate(value, DOCUMENT).ok()?).ok()?;
        Some(written(state, class_of(state, program, &asked.name)?, &literal))
    };
    values.iter().filter_map(one).collect()
}

/// Returns the class of a parameter.
pub(super) fn class_of(state: &State, program: ClassId, name: &str) -> Option<ClassId> {
    let document = &state.lowered.document;
    let field = document.layout(program).into_iter().find(|&f| *document.field_name(f) == *name)?;
    Some(document.field_class(field))
}

/// Writes a value of a class with all its digits and its unit.
pub(super) fn written(state: &State, class: ClassId, literal: &Literal) -> String {
    let document = &state.lowered.document;
    match (&document.classes[class].kind, literal) {
        (ClassKind::Primitive(Primitive::Real(dimension)), Literal::Number(x)) => {
            let class = &document.classes[document.named_class(class)].name;
            let quantity = kernel::Quantity { dimension: *dimension, class, written: "" };
            let shown = kernel::show_quantity(*x, quantity, document);
            words::with_unit(shown.exact, &shown.unit)
        }
        (ClassKind::Primitive(Primitive::Choice(of)), Literal::Number(x)) => {
            document.option_at(*of, *x).map(ToString::to_string).unwrap_or_default()
        }
        (_, Literal::Text(text)) => text.clone(),
        _ => {
            let evaluator = state.evaluator(&state.values);
            let answer = super::answer(document, class, literal);
            let text = evaluator.text_of(&answer);
            // a place is written as its numbers
            if text.starts_with('[') { text.replace('[', "(").replace(']', ")") } else { text }
        }
    }
}

/// A row to be written: its name, and what stands in its cells; nothing for the program's own example.
pub(super) struct Line {
    pub(super) name: String,
    pub(super) cells: Vec<Option<String>>,
}

impl Line {
    /// The row as it stands.
    pub(super) fn of(grid: &FamilyGrid, row: &FamilyRow) -> Self {
        let cell = |column: &GridColumn| {
            let found = row.written.iter().find(|(name, _)| *name == column.name);
            found.map(|(_, text)| text.clone())
        };
        Self { name: row.name.clone(), cells: grid.columns.iter().map(cell).collect() }
    }
}

/// Returns the text of a document with other rows in a family.
///
/// # Errors
/// The family is none of the document's own, a cell is no value of its parameter.
pub(super) fn with_rows(
    state: &State,
    grid: &FamilyGrid,
    lines: &[Line],
) -> Result<String, Refusal> {
    let (program, _) = find(state, &grid.name)?;
    let family = node(&state.text, &grid.name).ok_or_else(|| {
        words::refuse(format!("{} is no family of this document: begin one", grid.name))
    })?;
    let is_numbered = lines.iter().enumerate().all(|(i, line)| line.name == (i + 1).to_string());
    let row = |line: &Line| -> Result<String, Refusal> {
        let last = line.cells.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        let mut all: Vec<String> = Vec::new();
        if !is_numbered {
            all.push(quoted(&line.name));
        }
        let cells = line.cells[..last].iter().zip(&grid.columns);
        for (cell, column) in cells {
            let text = cell.as_deref().unwrap_or(&column.example);
            all.push(cell_text(state, (program, &column.name), text)?);
        }
        if all.is_empty() {
            // a row says at least one value
            let column = grid.columns.first();
            let none = || words::refuse(format!("{} has no parameters", grid.program));
            let column = column.ok_or_else(none)?;
            all.push(cell_text(state, (program, &column.name), &column.example)?);
        }
        Ok(format!("({})", all.join(", ")))
    };
    let rows = lines.iter().map(row).collect::<Result<Vec<_>, _>>()?;
    let written = match rows.as_slice() {
        [] => String::new(),
        rows => format!("rows:\n        {}", rows.join("\n        ")),
    };
    Ok(replaced(&state.text, &family, &written))
}

/// Writes a cell, which has to be a value of its parameter.
fn cell_text(
    state: &State,
    (program, parameter): (ClassId, &str),
    text: &str,
) -> Result<String, Refusal> {
    let document = &state.lowered.document;
    let none = || words::refuse(format!("there is no parameter {parameter}"));
    let class = class_of(state, program, parameter).ok_or_else(none)?;
    let value = literal(document, class, text);
    let value = value.map_err(|message| words::refuse(format!("{parameter}: {message}")))?;
    Ok(match &value {
        Literal::Text(said) => quoted(said),
        // `yes` is typed, and no word of the language
        Literal::Bool(truth) => truth.to_string(),
        _ => text.trim().into(),
    })
}

/// Puts the rows of a family, or its table, in the place of those that stand there.
fn replaced(text: &str, family: &ast::Family, written: &str) -> String {
    let Some(body) = family.body() else {
        let at = family.span().end as usize;
        return format!("{} {{\n    {written}\n}}{}", text[..at].trim_end(), &text[at..]);
    };
    let is_rows = |m: &Member| matches!(m, Member::Rows(_) | Member::Table(_));
    let spans: Vec<_> =
        body.members().filter(is_rows).map(|m| ast::span_without_doc(m.syntax())).collect();
    let mut out = text.to_string();
    for span in spans.iter().skip(1).rev() {
        out.replace_range(span.start as usize..span.end as usize, "");
    }
    match spans.first() {
        Some(span) => {
            let (start, end) = (span.start as usize, span.end as usize);
            let kept = out[start..end].trim_end().len();
            out.replace_range(start..start + kept, written);
        }
        None if written.is_empty() => {}
        None => {
            let at = body.span().start as usize + 1;
            let rest = out[at..].trim_start_matches([' ', '\n']);
            out = format!("{}\n    {written}\n{}{rest}", &out[..at], indent_of(rest));
        }
    }
    out
}

/// How far what follows the rows is set in: the closing brace is not.
fn indent_of(rest: &str) -> &'static str {
    if rest.starts_with('}') { "" } else { "    " }
}

/// Finds a family in a text.
pub(super) fn node(text: &str, name: &str) -> Option<ast::Family> {
    let file = syntax::parse(base::FileId(0), text).file();
    let named = |member: Member| match member {
        Member::Family(family) => {
            family.name().is_some_and(|word| word.text() == name).then_some(family)
        }
        _ => None,
    };
    { file.members() }.find_map(named)
}

/// Reads a table as rows to be written into the document.
///
/// # Errors
/// A table that cannot be read, a cell that is no value.
pub(super) fn lines_of(state: &State, grid: &FamilyGrid, csv: &str) -> Result<Vec<Line>, Refusal> {
    let (program, family) = find(state, &grid.name)?;
    let mut read = TableView::default();
    read_table(state, class_of_rows(program, family), csv, &mut read)?;
    // a row that is written out has no place for what the program does not ask for
    let beside = |(name, _): &(String, Literal)| grid.columns.iter().all(|c| c.name != *name);
    if let Some((name, _)) = read.rows.iter().find_map(|row| row.values.iter().find(|v| beside(v)))
    {
        let program = &grid.program;
        return Err(words::refuse(format!(
            "{name} is a column that {program} does not ask for: only a table can have it"
        )));
    }
    if let Some((row, fault)) = read.rows.iter().find_map(|r| Some((r, r.fault.as_ref()?))) {
        return Err(words::refuse(format!(
            "line {} of the table, {}: {fault}",
            row.line, row.name
        )));
    }
    Ok(read.rows.iter().map(|row| Line::of(grid, row)).collect())
}

/// Writes a grid as a table: a column whose values all have one unit has it in its header.
pub(crate) fn csv(grid: &FamilyGrid) -> String {
    let split = |text: &str| -> Option<(String, String)> {
        let (number, unit) = text.trim().split_once(' ').unwrap_or((text.trim(), ""));
        number.parse::<f64>().ok()?;
        Some((number.to_string(), unit.trim().to_string()))
    };
    let unit = |column: usize| -> Option<String> {
        let texts = (0..grid.rows.len()).map(|row| grid.cell(row, column));
        let mut units = texts.filter(|text| !text.is_empty()).map(split);
        let (_, first) = units.next()??;
        let is_same = units.all(|one| one.is_some_and(|(_, unit)| unit == first));
        (is_same && !first.is_empty()).then_some(first)
    };
    let units: Vec<Option<String>> = (0..grid.columns.len()).map(unit).collect();
    let mut out = csv::Writer::from_writer(Vec::new());
    let header = |(column, unit): (&GridColumn, &Option<String>)| match unit {
        Some(unit) => format!("{} [{unit}]", column.name),
        None => column.name.clone(),
    };
    let first = free_header(grid);
    let headers = std::iter::once(first).chain(grid.columns.iter().zip(&units).map(header));
    // what is written goes to memory, which takes it
    let _ = out.write_record(headers);
    for (row, named) in grid.rows.iter().enumerate() {
        let cell = |(column, unit): (usize, &Option<String>)| {
            let text = grid.cell(row, column);
            match (unit, split(text)) {
                (Some(_), Some((number, _))) => number,
                _ => text.to_string(),
            }
        };
        let cells = units.iter().enumerate().map(cell);
        let _ = out.write_record(std::iter::once(named.name.clone()).chain(cells));
    }
    out.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}

/// A header for the names of the rows that no parameter has.
fn free_header(grid: &FamilyGrid) -> String {
    let is_free = |name: &&&str| grid.columns.iter().all(|column| column.name != ***name);
    ["name", "designation", "row"].iter().find(is_free).map_or("row_name", |name| name).to_string()
}
