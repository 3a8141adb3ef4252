//! Families: the rows of a table, each drawn by a program; what is odd about the table is told.
//!
//! In: a document with a program, and a table as text. Out: rows of plain values, and for each what came of
//! it: it is drawn, or it lies outside of what the program demands, or a step has no outcome, or it takes too
//! long. Every row is on its own.
//!
//! `grid` shows and changes rows that stand in the document, `map` runs a program over two of its parameters, `hands`
//! is what the page asks.
//! `outside` tells rows beforehand that are outside.

mod grid;
mod hands;
mod map;
pub(crate) mod outside;

pub(crate) use grid::csv;

use crate::doubts;
use crate::state::State;
use crate::view::{FamilyRow, FamilyView, Refusal, RowFormats, RowOutcome, TableView};
use crate::views::drawn::walk;
use crate::words;
use base::Name;
use drawing::{Drawing, Tag, Vertical, dxf, svg};
use eval::{Answer, Context, Evaluator, Measures, Standing, Why};
use kernel::{ClassId, ClassKind, DOCUMENT, Document, Literal, Primitive, Term};
use lang::tables::{Table, with_unit};
use lang::{Family, Wanted};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Of what was drawn at most this many measures are told.
const MOST_MEASURES: usize = 200;
/// So many pixels a millimetre has, where an inch has 96.
const PIXELS_PER_MILLIMETRE: f64 = 96.0 / 25.4;

/// Returns the families that a document knows, and its programs.
pub(crate) fn list(state: &State) -> Vec<FamilyView> {
    let document = &state.lowered.document;
    let family = |family: &Family| FamilyView {
        name: family.name.to_string(),
        program: document.classes[family.program].name.to_string(),
        table: family.table.clone(),
        doc: family.doc.clone(),
    };
    state.lowered.families.iter().map(family).collect()
}

/// Returns the paths of the tables that a document uses, with those that are missing.
pub(crate) fn tables(state: &State) -> BTreeSet<String> {
    let lowered = &state.lowered;
    let read = lowered.files.iter().map(|(_, file)| file).filter(|file| file.is_table());
    let missing = lowered.missing.iter().filter(|name| lang::tables::is_name(name));
    let of_families = lowered.families.iter().filter_map(|family| family.table.clone());
    read.map(|file| file.name.clone()).chain(missing.cloned()).chain(of_families).collect()
}

/// Returns a name of a file for each row, without its ending, none twice.
pub fn file_names(rows: &[FamilyRow]) -> Vec<String> {
    /// So many bytes leave room for a number and an ending in what file systems take.
    const LONGEST: usize = 200;
    // how often each was wanted
    let mut taken: BTreeMap<String, u32> = BTreeMap::new();
    let plain = |c: char| if c.is_alphanumeric() || ".-_".contains(c) { c } else { '-' };
    let name = |row: &FamilyRow| {
        let name: String = row.name.chars().map(plain).collect();
        let words: Vec<&str> = name.split('-').filter(|word| !word.is_empty()).collect();
        // what a file system takes for one name is one
        let name = words.join("-").to_lowercase();
        let name = match name[..name.floor_char_boundary(LONGEST)].trim_matches('.') {
            "" => "row",
            name => name,
        };
        let numbered =
            |times: u32| if times == 1 { name.into() } else { format!("{name}_{times}") };
        let mut times = taken.get(name).map_or(1, |times| times + 1);
        // a row may be called like a numbered one
        while times > 1 && taken.contains_key(&numbered(times)) {
            times += 1;
        }
        taken.insert(name.into(), times);
        taken.entry(numbered(times)).or_insert(1);
        numbered(times)
    };
    rows.iter().map(name).collect()
}

/// Finds a program by its name, or by that of a family.
fn find<'s>(state: &'s State, name: &str) -> Result<(ClassId, Option<&'s Family>), Refusal> {
    let document = &state.lowered.document;
    let family = state.lowered.families.iter().find(|f| f.name == *name);
    if let Some(family) = family {
        return Ok((family.program, Some(family)));
    }
    let program = document.class_named(name).filter(|&c| document.program(c).is_some());
    program.map(|program| (program, None)).ok_or_else(|| {
        let programs = document.classes.iter().filter(|(_, c)| c.program.is_some());
        let programs: Vec<&str> = programs.map(|(_, c)| c.name.as_str()).collect();
        let families = state.lowered.families.iter();
        let families: Vec<String> = families
            .map(|f| format!("{} of {}", f.name, document.classes[f.program].name))
            .collect();
        words::refuse(match (families.as_slice(), programs.as_slice()) {
            (_, []) => format!("there is no program {name}, and no other"),
            ([], known) => {
                format!(
                    "there is no program or family {name}; of programs there is {}",
                    known.join(", ")
                )
            }
            (families, programs) => format!(
                "there is no program or family {name}; of families there is {}, of programs {}",
                families.join(", "),
                programs.join(", ")
            ),
        })
    })
}

/// Returns the class of the rows: the program, or what has the columns of the family besides.
fn class_of_rows(program: ClassId, family: Option<&Family>) -> ClassId {
    family.map_or(program, |family| family.row)
}

/// Reads the rows of a family, or of a program with a table: CSV, `#` begins a comment, a header of names, each
/// with its unit in brackets where it has one.
///
/// # Errors
/// No such program, a table that cannot be read, a column that is missing.
pub(crate) fn rows(state: &State, name: &str, table: Option<&str>) -> Result<TableView, Refusal> {
    let (program, family) = find(state, name)?;
    let mut read = TableView::default();
    match (table, family) {
        (Some(table), _) => read_table(state, class_of_rows(program, family), table, &mut read)?,
        (None, Some(family)) => written_rows(state, family, &mut read)?,
        (None, None) => {
            return Err(words::refuse(without_table(state, program, name)));
        }
    }
    note_duplicates(&mut read);
    Ok(read)
}

/// Says where a second table has other values for the rows of a first, and which rows one of them lacks.
///
/// # Errors
/// A table that cannot be read, no row that both have.
pub(crate) fn differences(
    state: &State,
    name: &str,
    rows: &TableView,
    other: &str,
) -> Result<Vec<String>, Refusal> {
    let (program, family) = find(state, name)?;
    let class = class_of_rows(program, family);
    let document = &state.lowered.document;
    let evaluator = state.evaluator(&state.values);
    let fields = document.layout(class);
    let shown = |parameter: &str, literal: &Literal| {
        let field = fields.iter().find(|&&f| *document.field_name(f) == *parameter);
        let class = field.map_or(document.root, |&f| document.field_class(f));
        evaluator.text_of(&answer(document, class, literal))
    };
    let other = {
        let mut read = TableView::default();
        read_table(state, class, other, &mut read)?;
        read.rows
    };
    let value = |row: &'_ FamilyRow, parameter: &str| {
        row.values.iter().find(|(name, _)| name == parameter).map(|(_, v)| v.clone())
    };
    let by_name = rows.rows.iter().any(|row| other.iter().any(|o| o.name == row.name));
    let first = fields.iter().map(|&f| document.field_name(f).to_string());
    let first = first.into_iter().find(|parameter| {
        let has = |rows: &[FamilyRow]| rows.iter().any(|row| value(row, parameter).is_some());
        has(&rows.rows) && has(&other)
    });
    let is_same = |a: &FamilyRow, b: &FamilyRow| match &first {
        _ if by_name => a.name == b.name,
        Some(parameter) => {
            let (a, b) = (value(a, parameter), value(b, parameter));
            a.is_some() && a == b
        }
        None => false,
    };
    let mut said = Vec::new();
    let mut found = 0;
    for row in &rows.rows {
        let Some(second) = other.iter().find(|o| is_same(row, o)) else {
            said.push(format!("{} is not in the second table", row.name));
            continue;
        };
        found += 1;
        for (parameter, here) in &row.values {
            if let Some(there) = value(second, parameter).filter(|there| there != here) {
                let (here, there) = (shown(parameter, here), shown(parameter, &there));
                let name = &row.name;
                said.push(format!("{name}: {parameter} is {here}, in the second table {there}"));
            }
        }
    }
    for row in other.iter().filter(|o| !rows.rows.iter().any(|row| is_same(row, o))) {
        said.push(format!("{} is in the second table alone", row.name));
    }
    match found {
        0 => Err(words::refuse("the second table has no row in common with the first".into())),
        _ => Ok(said),
    }
}

/// Says that a program has no rows of its own, and where there are some.
fn without_table(state: &State, program: ClassId, name: &str) -> String {
    let own = state.lowered.families.iter().filter(|f| f.program == program);
    let own: Vec<&str> = own.map(|f| f.name.as_str()).collect();
    match own.as_slice() {
        [] => format!("{name} is a program without a family: say which table with --table"),
        [one] => {
            format!("{name} is a program: its family is {one}, or say which table with --table")
        }
        several => format!(
            "{name} is a program: its families are {}, or say which table with --table",
            several.join(", ")
        ),
    }
}

fn written_rows(state: &State, family: &Family, read: &mut TableView) -> Result<(), Refusal> {
    let document = &state.lowered.document;
    let evaluator = state.evaluator(&state.values);
    let fields = document.layout(family.program);
    for (i, row) in family.rows.iter().enumerate() {
        let mut values = Vec::new();
        let mut written = Vec::new();
        if row.fault.is_some() {
            let names = fields.iter().map(|&field| document.field_name(field).to_string());
            written.extend(names.zip(row.texts.iter().cloned()));
        }
        for ((term, text), &field) in row.values.iter().zip(&row.texts).zip(&fields) {
            let answer =
                evaluator.evaluate(term, DOCUMENT).map_err(|f| words::refuse(f.message))?;
            let name = document.field_name(field).to_string();
            let literal = crate::check::literal_of(&answer)?;
            let text = if let Literal::Text(said) = &literal { said } else { text };
            written.push((name.clone(), text.clone()));
            values.push((name, literal));
        }
        let name = row.name.clone().unwrap_or_else(|| (i + 1).to_string());
        read.rows.push(FamilyRow { name, values, written, line: 0, fault: row.fault.clone() });
    }
    Ok(())
}

fn read_table(
    state: &State,
    program: ClassId,
    table: &str,
    read: &mut TableView,
) -> Result<(), Refusal> {
    let document = &state.lowered.document;
    let table = Table::read(table)
        .map_err(|why| words::refuse(format!("the table cannot be read: {why}")))?;
    let columns = &table.columns;
    let fields = document.layout(program);
    let field = |name: &str| {
        fields.iter().find(|&&f| *document.field_name(f) == *name).map(|&f| document.field_class(f))
    };
    if !columns.iter().any(|(name, _)| field(name).is_some()) {
        let names: Vec<&str> = fields.iter().map(|&f| document.field_name(f).as_str()).collect();
        let message = format!("no column is a parameter: wanted are {}", names.join(", "));
        return Err(words::refuse(message));
    }
    let designation = columns.iter().position(|(name, _)| field(name).is_none());
    let mut numbers: Vec<Vec<(f64, String)>> = vec![Vec::new(); columns.len()];
    for (i, record) in table.rows.iter().enumerate() {
        let designated = designation.and_then(|at| record.cells.get(at));
        let designated = designated.filter(|cell| !cell.is_empty());
        let name = designated.map_or_else(|| (i + 1).to_string(), String::clone);
        let mut row = FamilyRow { name: name.clone(), line: record.line, ..FamilyRow::default() };
        if record.cells.len() > columns.len() {
            let (n, m) = (columns.len(), record.cells.len());
            row.fault = Some(format!("{m} cells, where the table has {n} columns"));
        }
        let cells = record.cells.iter().zip(columns);
        for ((cell, (column, unit)), numbers) in cells.zip(&mut numbers) {
            if let Ok(number) = cell.parse::<f64>() {
                numbers.push((number, name.clone()));
            }
            // an empty cell is the program's own example
            let Some(class) = field(column).filter(|_| !cell.is_empty()) else { continue };
            let typed = with_unit(document, class, cell, unit);
            match literal(document, class, &typed) {
                Ok(value) => {
                    let typed = match &value {
                        Literal::Bool(truth) => truth.to_string(),
                        _ => typed,
                    };
                    row.values.push((column.clone(), value));
                    row.written.push((column.clone(), typed));
                }
                Err(message) => row.fault = Some(format!("{column}: {message}")),
            }
        }
        read.rows.push(row);
    }
    for ((column, _), numbers) in columns.iter().zip(&numbers) {
        note_disorder(column, numbers, read);
    }
    Ok(())
}

/// Reads what is typed as a value of a class.
fn literal(document: &Document, class: ClassId, typed: &str) -> Result<Literal, String> {
    lang::read_literal(typed, Wanted::Class(class), document).map_err(words::with_hint)
}

/// Notes names that stand twice, and rows that say the same.
fn note_duplicates(read: &mut TableView) {
    let mut names: BTreeMap<&str, u32> = BTreeMap::new();
    let mut said: BTreeMap<String, &str> = BTreeMap::new();
    let mut notes = Vec::new();
    for row in &read.rows {
        let times = names.entry(&row.name).or_default();
        *times += 1;
        if *times == 2 {
            notes.push(format!("{} stands in the table more than once", row.name));
        }
        if row.fault.is_none()
            && let Some(before) = said.insert(format!("{:?}", row.values), &row.name)
            && before != row.name
        {
            notes.push(format!("{before} and {} have the same values", row.name));
        }
    }
    read.notes.extend(notes);
}

/// Notes where a column that grows, or shrinks, goes back.
fn note_disorder(column: &str, numbers: &[(f64, String)], read: &mut TableView) {
    /// Of so many steps that go one way, one the other way is odd.
    const MOST: usize = 4;
    let steps = || numbers.windows(2).map(|w| (w[1].0 - w[0].0, &w[0], &w[1]));
    let up = steps().filter(|s| s.0 > 0.0).count();
    let down = steps().filter(|s| s.0 < 0.0).count();
    let odd = |sign: f64| steps().filter(move |s| s.0 * sign < 0.0);
    let (way, sign) = match up >= down {
        true => ("grows", 1.0),
        false => ("shrinks", -1.0),
    };
    if up.min(down) * MOST > up.max(down) || up.min(down) == 0 {
        return;
    }
    for (_, before, after) in odd(sign) {
        read.notes.push(format!(
            "{column} {way}, but is {} at {} and {} at {}",
            before.0, before.1, after.0, after.1
        ));
    }
}

/// Draws a row.
///
/// # Errors
/// No such program.
pub(crate) fn draw(
    state: &State,
    name: &str,
    row: &FamilyRow,
    formats: RowFormats,
) -> Result<RowOutcome, Refusal> {
    let (program, family) = find(state, name)?;
    let document = &state.lowered.document;
    let evaluator = state.evaluator(&state.values);
    let mut outcome = RowOutcome { name: row.name.clone(), ..RowOutcome::default() };
    if let Some(fault) = &row.fault {
        outcome.outcome = "failed".into();
        outcome.step = "table".into();
        outcome.message = fault.clone();
        return Ok(outcome);
    }
    let class = class_of_rows(program, family);
    let rules = family.map_or(&[][..], |family| &family.rules);
    if !formats.svg && !formats.dxf {
        let values = values_of(state, class, &row.values);
        let measured = evaluator.measure_with(name, class, values, |run| {
            let is_member = ended(&evaluator, rules, run).is_none();
            // what is doubtful is told of the whole run
            let is_told = !is_member || !doubts::of_run(document, &evaluator, run).is_empty();
            (!is_told).then(|| measures(document, &Answer::Context(run.clone())))
        });
        if let Some(measures) = measured.map_err(|f| words::refuse(f.message))? {
            outcome.outcome = "drawn".into();
            outcome.measures = measures;
            return Ok(outcome);
        }
    }
    let run = run_of((state, &evaluator), class, &row.values)?;
    if let Some((ended, step, message)) = ended(&evaluator, rules, &run) {
        outcome.outcome = ended.into();
        outcome.step = step;
        outcome.message = message;
        return Ok(outcome);
    }
    outcome.outcome = "drawn".into();
    outcome.message = doubts::of_run(document, &evaluator, &run);
    let run = Answer::Context(run);
    outcome.measures = measures(document, &run);
    let vertical = match document.vertical {
        kernel::Vertical::Up => Vertical::Up,
        kernel::Vertical::Down => Vertical::Down,
    };
    let millimetres_per_unit = state.lowered.millimetres_per_unit();
    let is_metric = document.units_per_metre != 1.0 || document.writes_lengths;
    let stored = document.scale.factor(expr::Dimension::LENGTH);
    let options = svg::SvgOptions {
        pixels_per_unit: match is_metric {
            true => PIXELS_PER_MILLIMETRE * millimetres_per_unit,
            false => 1.0 / stored,
        },
        margin: 16.0,
        title: Some(&row.name),
        path: &|_| None,
    };
    let mut drawing = Drawing { elements: evaluator.elements(&run), vertical };
    if formats.svg {
        outcome.svg = svg::write(&drawing, &options);
    }
    let options = dxf::DxfOptions::of(&drawing, millimetres_per_unit);
    if formats.dxf {
        let sets = tag_sets(&evaluator, &run, &mut drawing);
        let set = |tag: Tag| sets.get(tag.0 as usize).cloned().flatten();
        outcome.dxf = dxf::write_in_blocks(&drawing, &options, &set);
    }
    Ok(outcome)
}

/// Says why runs of a program are not drawn again as they were drawn before.
pub(crate) fn why_interpreted(state: &State, name: &str) -> Option<String> {
    let (program, family) = find(state, name).ok()?;
    let evaluator = state.evaluator(&state.values);
    evaluator
        .why_interpreted(class_of_rows(program, family))
        .or_else(|| evaluator.why_interpreted(program))
}

/// Runs a program for values of its parameters; those that are not said are its own example's.
///
/// # Errors
/// Values that its parameters do not take.
fn run_of<'a>(
    (state, evaluator): (&'a State, &Evaluator<'a>),
    program: ClassId,
    values: &[(String, Literal)],
) -> Result<Rc<Context<'a>>, Refusal> {
    let values = values_of(state, program, values);
    evaluator.run_with(program, values).map_err(|f| words::refuse(f.message))
}

/// Returns the values of a row as those of a program's parameters.
fn values_of<'a>(
    state: &'a State,
    program: ClassId,
    values: &[(String, Literal)],
) -> Vec<(&'a Name, Answer<'a>)> {
    let document = &state.lowered.document;
    let fields = document.layout(program);
    let value = |(name, literal): &(String, Literal)| {
        let field = *fields.iter().find(|&&f| *document.field_name(f) == **name)?;
        Some((document.field_name(field), answer(document, document.field_class(field), literal)))
    };
    values.iter().filter_map(value).collect()
}

/// Says why a run is no member of a family with these rules: what it is called, the step or the rule, and the words.
fn ended<'a>(
    evaluator: &Evaluator<'a>,
    rules: impl IntoIterator<Item = &'a (String, Term)>,
    run: &Rc<Context<'a>>,
) -> Option<(&'static str, String, String)> {
    if let Some(ended) = &run.ended {
        let outcome = match ended.why {
            Why::Outside => "outside",
            Why::Failed => "failed",
            Why::TooLong => "too-long",
        };
        return Some((outcome, ended.step.clone(), ended.to_string()));
    }
    let broken = rules.into_iter().find(|(_, rule)| !evaluator.holds(rule, run).unwrap_or(false));
    broken.map(|(said, rule)| {
        let values = values_in(evaluator, rule, run);
        ("outside", said.clone(), format!("{said} is not met{values}"))
    })
}

/// Returns the names of the parameters, columns and steps that a rule speaks of, in order.
fn names_in(rule: &Term) -> Vec<&Name> {
    let mut names: Vec<&Name> = Vec::new();
    let mut open = vec![rule];
    while let Some(term) = open.pop() {
        match term {
            Term::Send { to, name, .. } if **to == Term::Me => {
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            other => open.extend(other.operands().into_iter().rev()),
        }
    }
    names
}

/// Says what the parameters and columns are that a rule speaks of: `; e is 3 mm, s is 4 mm`.
fn values_in<'a>(evaluator: &Evaluator<'a>, rule: &'a Term, run: &Rc<Context<'a>>) -> String {
    let value = |name: &&Name| {
        let value = evaluator.of_part(&Answer::Context(run.clone()), name).ok()?;
        let value = crate::views::answers::in_words(evaluator.document, &value)?;
        Some(format!("{name} is {value}"))
    };
    let said: Vec<String> = names_in(rule).iter().filter_map(value).collect();
    if said.is_empty() { String::new() } else { format!("; {}", said.join(", ")) }
}

/// Gives what each step of a run drew a tag of its own; returns for each tag the name of the set that it is, if any: a
/// loop, or a program that was called.
fn tag_sets<'a>(
    evaluator: &Evaluator<'a>,
    run: &Answer<'a>,
    drawing: &mut Drawing,
) -> Vec<Option<String>> {
    let Answer::Context(context) = run else { return Vec::new() };
    let mut sets = vec![None];
    drawing.elements.iter_mut().for_each(|element| element.tag = Tag(0));
    let mut own = drawing.elements.iter_mut().peekable();
    for entry in context.result() {
        let tag = Tag(sets.len() as u32);
        let is_set = matches!(entry.answer, Answer::List(_) | Answer::Context(_));
        sets.push(is_set.then(|| entry.name.to_string()));
        for drawn in evaluator.elements(&entry.answer) {
            if let Some(element) = own.next_if(|element| element.shape == drawn.shape) {
                element.tag = tag;
            }
        }
    }
    sets
}

/// Returns a literal as what an expression would be worth.
fn answer<'d>(document: &Document, class: ClassId, literal: &Literal) -> Answer<'d> {
    let kind = &document.classes[class].kind;
    match literal {
        Literal::Number(x) => match kind {
            ClassKind::Primitive(Primitive::Choice(of)) => Answer::Option(*of, *x as u32),
            ClassKind::Primitive(primitive) => Answer::Number(*x, primitive.dimension()),
            ClassKind::Composite
            | ClassKind::List(_)
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => Answer::plain(*x),
        },
        Literal::Bool(b) => Answer::Bool(*b),
        Literal::Text(text) => Answer::text(text),
        Literal::Tuple(items) => {
            let fields = document.layout(class);
            let item = |(i, item): (usize, &Literal)| {
                let of = fields.get(i).map_or(class, |&f| document.field_class(f));
                answer(document, of, item)
            };
            Answer::List(items.iter().enumerate().map(item).collect())
        }
        Literal::Path(path) => Answer::text(&path.to_string()),
    }
}

/// Collects the numbers of what was drawn, by their paths.
fn measures(document: &Document, run: &Answer<'_>) -> Measures {
    let mut found = Vec::new();
    walk(document, (run, Standing::Result), &mut String::new(), &mut |answer, _, path| {
        let is_room = found.len() < MOST_MEASURES;
        if let (Answer::Number(x, _), true) = (answer, is_room) {
            found.push((path.to_string(), *x));
        }
        is_room
    });
    found.into_iter().collect()
}
