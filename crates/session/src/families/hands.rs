//! Families at the boundary: their rows changed and used, and the map of a program.

use super::grid::{self, Line};
use super::{find, map};
use crate::document::Open;
use crate::drafting::view::Turn;
use crate::drafting::{retext, serving};
use crate::session::{Session, parse_path};
use crate::state::State;
use crate::tools::{Tool, room};
use crate::view::{
    Change, DocumentId, FamilyAxis, FamilyGrid, FamilyMap, FamilyRow, Refusal, RowUse,
};
use crate::words;
use kernel::{Command, DOCUMENT, Literal, Path, Step};

impl Session {
    /// Shows the rows of a family as a grid; `table` is the text of its file, where it has one.
    ///
    /// # Errors
    /// No such family or program, a table that cannot be read.
    pub fn family_grid(
        &self,
        id: DocumentId,
        name: &str,
        table: Option<&str>,
    ) -> Result<FamilyGrid, Refusal> {
        grid::grid(&self.document(id).state, name, table)
    }

    /// Returns the programs of which families can be made, by their names.
    pub fn programs(&self, id: DocumentId) -> Vec<String> {
        let state = &self.document(id).state;
        let (document, served) = (&state.lowered.document, serving(state));
        let programs = document
            .classes
            .iter()
            .filter(|(id, c)| document.class_named(&c.name) == Some(*id))
            .filter(|(id, c)| c.program.is_some() && !c.is_abstract && !served.contains(id));
        programs.map(|(_, class)| class.name.to_string()).collect()
    }

    /// Returns the things of the document that a program draws, by their paths.
    pub fn drawn_by(&self, id: DocumentId, program: &str) -> Vec<String> {
        let state = &self.document(id).state;
        let (document, structure) = (&state.lowered.document, &state.structure);
        let Some(class) = document.class_named(program) else { return Vec::new() };
        let own = structure.parts(DOCUMENT).filter(|&part| {
            structure.merged[part] == part && document.is_a(structure.things[part].class, class)
        });
        own.map(|part| structure.path(document, part).to_string()).collect()
    }

    /// Gives parameters of a thing the values that are typed, as one step.
    ///
    /// # Errors
    /// There is no such thing or parameter, what is typed is no value, or a constraint forbids it.
    pub fn set_parameters(
        &mut self,
        id: DocumentId,
        thing: &str,
        typed: &[(String, String)],
    ) -> Result<Change, Refusal> {
        let state = &self.document(id).state;
        let path = parse_path(thing).ok_or_else(|| words::refuse(format!("{thing} is no path")))?;
        let value = |(name, typed): &(String, String)| {
            let path = path.then(Step::Part(name.as_str().into()));
            words::find(state, &path)?;
            let literal = words::read_typed(state, &path, typed).map_err(|refusal| Refusal {
                message: format!("{name}: {}", refusal.message),
                ..refusal
            })?;
            Ok((path, literal))
        };
        let values = typed.iter().map(value).collect::<Result<Vec<_>, Refusal>>()?;
        self.apply(id, &Command::Set(values))
    }

    /// Writes the parameters of a thing as a table, CSV, of names and values.
    ///
    /// # Errors
    /// There is no such thing, or no program draws it.
    pub fn parameter_table(&self, id: DocumentId, thing: &str) -> Result<String, Refusal> {
        let state = &self.document(id).state;
        let (path, names) = parameters_of(state, thing)?;
        let mut out = csv::Writer::from_writer(Vec::new());
        // what is written goes to memory, which takes it
        let _ = out.write_record(["name", "value"]);
        for name in names {
            let own = words::find(state, &path.then(Step::Part(name.as_str().into())))?;
            let value = words::show_thing_exactly(state, own, &state.values).unwrap_or_default();
            let _ = out.write_record([name, value]);
        }
        Ok(out.into_inner().ok().and_then(|b| String::from_utf8(b).ok()).unwrap_or_default())
    }

    /// Gives the parameters of a thing the values of a table: CSV of names, values and, where there is a third column,
    /// units; `#` begins a comment. One step.
    ///
    /// # Errors
    /// A line that names no parameter, or whose value is none of it; then nothing has changed.
    pub fn read_parameter_table(
        &mut self,
        id: DocumentId,
        thing: &str,
        table: &str,
    ) -> Result<Change, Refusal> {
        let (_, names) = parameters_of(&self.document(id).state, thing)?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .has_headers(false)
            .flexible(true)
            .from_reader(table.as_bytes());
        let mut typed = Vec::new();
        for (i, record) in reader.records().enumerate() {
            let refused = |e: csv::Error| words::refuse(format!("the table cannot be read: {e}"));
            let record = record.map_err(refused)?;
            let cell = |at: usize| record.get(at).unwrap_or_default();
            let (name, value) = (cell(0), words::with_unit(cell(1).into(), cell(2)));
            if i == 0 && !names.iter().any(|own| own == name) && cell(1) == "value" {
                continue;
            }
            let line = record.position().map_or(0, |at| lang::tables::line_of(table, at));
            if !names.iter().any(|own| own == name) {
                let names = names.join(", ");
                let message =
                    format!("line {line}: {thing} has no parameter {name}: wanted are {names}");
                return Err(words::refuse(message));
            }
            if cell(1).is_empty() {
                return Err(words::refuse(format!("line {line}: {name} has no value")));
            }
            typed.push((name.to_string(), value));
        }
        if typed.is_empty() {
            return Err(words::refuse("the table has no line with a name and a value".into()));
        }
        self.set_parameters(id, thing, &typed)
    }

    /// Begins a family of a program in the document, without rows; returns what it is called.
    ///
    /// # Errors
    /// There is no such program, or it has no parameters.
    pub fn begin_family(
        &mut self,
        id: DocumentId,
        program: &str,
    ) -> Result<(Change, String), Refusal> {
        let state = &self.document(id).state;
        let document = &state.lowered.document;
        let class = document.class_named(program).and_then(|class| document.program(class));
        let none = || words::refuse(format!("there is no program {program}"));
        if class.ok_or_else(none)?.parameters.is_empty() {
            let message = format!("{program} has no parameters that rows could say");
            return Err(words::refuse(message));
        }
        let is_free = |name: &String| {
            document.class_named(name).is_none()
                && state.lowered.families.iter().all(|family| *family.name != **name)
        };
        let names = std::iter::once(format!("{program}Sizes"))
            .chain((2..).map(|n| format!("{program}Sizes{n}")));
        let name = { names }.find(is_free).unwrap_or_default();
        let text = format!("{}\n\nfamily {name} of {program} {{\n}}\n", state.text.trim_end());
        let label = format!("begin family {name}");
        Ok((self.with_family_text(id, text, label)?, name))
    }

    /// Says anew what stands in a cell, or what a row is called, where no column is named. An empty cell is the
    /// program's own example.
    ///
    /// # Errors
    /// The rows do not stand in the document; there is no such row or column; what is typed is no value.
    pub fn set_family_cell(
        &mut self,
        id: DocumentId,
        family: &str,
        (row, column): (usize, Option<&str>),
        typed: &str,
    ) -> Result<Change, Refusal> {
        let label = format!("set {} of {family}", column.unwrap_or("a name"));
        self.with_family(id, (family, label), |_, grid, lines| {
            let none = || words::refuse(format!("{family} has no row {}", row + 1));
            let line = lines.get_mut(row).ok_or_else(none)?;
            let typed = typed.trim();
            match column {
                None if typed.is_empty() => {
                    return Err(words::refuse("a name is wanted".into()));
                }
                None => line.name = typed.into(),
                Some(column) => {
                    let at = grid.columns.iter().position(|c| c.name == column);
                    let none = || words::refuse(format!("{family} has no column {column}"));
                    line.cells[at.ok_or_else(none)?] = (!typed.is_empty()).then(|| typed.into());
                }
            }
            Ok(())
        })
    }

    /// Says anew what stands in a block of cells, as spreadsheets copy one: cells with tabs between, a row a line. `from`
    /// are its first row and its first cell, of which the name is the first. Rows that are not there yet are added.
    /// All of it is one step.
    ///
    /// # Errors
    /// The rows do not stand in the document; the block is wider than the grid, or leaves rows out; a cell is no value.
    pub fn set_family_cells(
        &mut self,
        id: DocumentId,
        family: &str,
        from: (usize, usize),
        block: &str,
    ) -> Result<Change, Refusal> {
        let rows = rows_of(block)?;
        let label = match rows.as_slice() {
            [row] if row.len() == 1 => format!("set a cell of {family}"),
            _ => format!("paste into {family}"),
        };
        self.with_family(id, (family, label), |_, grid, lines| {
            let all = 1 + grid.columns.len();
            let wide = from.1 + rows.iter().map(Vec::len).max().unwrap_or_default();
            if wide > all {
                let beyond = match wide - all {
                    1 => "1 column".into(),
                    n => format!("{n} columns"),
                };
                let message = format!("what is pasted ends {beyond} beyond the grid");
                return Err(words::refuse(message));
            }
            if from.0 > lines.len() {
                return Err(words::refuse(format!("{family} has no row {}", from.0 + 1)));
            }
            for (at, row) in (from.0..).zip(&rows) {
                if at == lines.len() {
                    let name = free_number(lines);
                    lines.push(Line { name, cells: vec![None; grid.columns.len()] });
                }
                for (column, cell) in (from.1..).zip(row) {
                    match column.checked_sub(1) {
                        None if cell.is_empty() => {}
                        None => lines[at].name.clone_from(cell),
                        Some(column) => {
                            lines[at].cells[column] = (!cell.is_empty()).then(|| cell.clone());
                        }
                    }
                }
            }
            Ok(())
        })
    }

    /// Adds a row with the values of a thing that the program draws; without one with those of the program's own
    /// example.
    ///
    /// # Errors
    /// The rows do not stand in the document; there is no such thing.
    pub fn add_family_row(
        &mut self,
        id: DocumentId,
        family: &str,
        of: Option<&str>,
    ) -> Result<Change, Refusal> {
        let label = format!("add a row to {family}");
        self.with_family(id, (family, label), |state, grid, lines| {
            let is_numbered =
                lines.iter().enumerate().all(|(i, line)| line.name == (i + 1).to_string());
            let name = match (is_numbered, of) {
                (false, Some(of)) if lines.iter().all(|line| line.name != of) => of.to_string(),
                _ => free_number(lines),
            };
            let cells = match of {
                Some(of) => {
                    let path =
                        parse_path(of).ok_or_else(|| words::refuse(format!("{of} is no path")))?;
                    let value = |column: &crate::view::GridColumn| {
                        let path = path.then(Step::Part(column.name.as_str().into()));
                        let thing = words::find(state, &path)?;
                        Ok(words::show_thing_exactly(state, thing, &state.values))
                    };
                    grid.columns.iter().map(value).collect::<Result<Vec<_>, Refusal>>()?
                }
                None => grid.columns.iter().map(|c| Some(c.example.clone())).collect(),
            };
            lines.push(Line { name, cells });
            Ok(())
        })
    }

    /// Deletes a row.
    ///
    /// # Errors
    /// The rows do not stand in the document; there is no such row.
    pub fn delete_family_row(
        &mut self,
        id: DocumentId,
        family: &str,
        row: usize,
    ) -> Result<Change, Refusal> {
        let label = format!("delete a row of {family}");
        self.with_family(id, (family, label), |_, _, lines| {
            let none = || words::refuse(format!("{family} has no row {}", row + 1));
            (row < lines.len()).then(|| lines.remove(row)).ok_or_else(none)?;
            Ok(())
        })
    }

    /// Takes a table into the document: its rows take the place of those that the family has.
    ///
    /// # Errors
    /// The family is none of the document's own; the table cannot be read, or a cell of it is no value.
    pub fn take_family_table(
        &mut self,
        id: DocumentId,
        family: &str,
        csv: &str,
    ) -> Result<Change, Refusal> {
        let state = &self.document(id).state;
        let shown = grid::grid(state, family, None)?;
        let lines = grid::lines_of(state, &shown, csv)?;
        let text = grid::with_rows(state, &shown, &lines)?;
        self.with_family_text(id, text, format!("take rows into {family}"))
    }

    /// Uses a row of a family: a thing that the program draws takes its values, or a new one has them; while another
    /// program is recorded, it calls this one by them. Returns the path of the thing.
    ///
    /// # Errors
    /// There is no such thing; the row is none of the family, or a constraint forbids it.
    pub fn use_family_row(
        &mut self,
        id: DocumentId,
        (family, row): (&str, &FamilyRow),
        to: &RowUse,
    ) -> Result<(Change, String), Refusal> {
        let state = &self.document(id).state;
        let (program, _) = find(state, family)?;
        if let Some(fault) = &row.fault {
            return Err(words::refuse(format!("{}: {fault}", row.name)));
        }
        let document = &state.lowered.document;
        match to {
            RowUse::Set(thing) => {
                let path = parse_path(thing)
                    .ok_or_else(|| words::refuse(format!("{thing} is no path")))?;
                let own = words::find(state, &path)?;
                if !document.is_a(state.structure.things[own].class, program) {
                    let program = &document.classes[program].name;
                    return Err(words::refuse(format!("{thing} is not drawn by {program}")));
                }
                let shown = grid::grid(state, &document.classes[program].name, None)?;
                let mut values = Vec::new();
                for column in &shown.columns {
                    let said = row.values.iter().find(|(name, _)| *name == column.name);
                    let value = match said {
                        Some((_, value)) => value.clone(),
                        None => example(state, program, column)?,
                    };
                    values.push((path.then(Step::Part(column.name.as_str().into())), value));
                }
                Ok((self.apply(id, &Command::Set(values))?, thing.clone()))
            }
            RowUse::Place => {
                let class = document.classes[program].name.to_string();
                let name = free_name(state, &row.name, &class);
                let value = |(name, written): &(String, String)| {
                    let value = row.values.iter().find(|(own, _)| own == name).map(|(_, v)| v);
                    let text = match value {
                        Some(Literal::Text(text)) => lang::quoted(text),
                        _ => written.clone(),
                    };
                    (name.clone(), text)
                };
                let values: Vec<(String, String)> = row.written.iter().map(value).collect();
                if self.recorded(id).is_some() {
                    return self.call_by(id, &class, &values);
                }
                let values: Vec<String> =
                    values.iter().map(|(name, text)| format!("{name} = {text}")).collect();
                let (open, beside) = self.beside_others(id);
                let new = (class.as_str(), name.clone(), &values[..]);
                let tool = Tool::with_values(open, &beside, new)?;
                let edit = room::in_room(open, tool, &beside)?;
                Ok((self.apply(id, &edit)?, name))
            }
        }
    }

    /// Draws a step of what is recorded that calls a program by some values; the others are the program's own.
    fn call_by(
        &mut self,
        id: DocumentId,
        program: &str,
        values: &[(String, String)],
    ) -> Result<(Change, String), Refusal> {
        // it would be given there as an operand
        let is_idle = self.document(id).dialogue.as_ref().is_some_and(|d| !d.is_begun);
        if let Some(waits) = self.prompt(id).filter(|_| !is_idle) {
            let label = waits.label;
            return Err(words::refuse(format!(
                "{label} waits for an answer: give it one, or give it up, before a row is placed"
            )));
        }
        let mut prompt = Some(self.begin(id, program)?);
        while let Some(waits) = prompt {
            let slot = waits.operands.iter().find(|(_, given)| given.is_none());
            let value = slot.and_then(|(slot, _)| values.iter().find(|(name, _)| name == slot));
            match self.enter(id, value.map_or("", |(_, text)| text)) {
                Ok(Turn::Wants(next)) => prompt = Some(next),
                Ok(Turn::Made { change, name, .. }) => {
                    self.give_up(id);
                    let example = self.recorded_example(id).unwrap_or_default();
                    return Ok((*change, format!("{example}.{name}")));
                }
                Err(refusal) => {
                    self.give_up(id);
                    return Err(refusal);
                }
            }
        }
        Err(words::refuse(format!("{program} asks for nothing")))
    }

    /// Returns the parameters that a map can be made over, each with a range around its value in a thing.
    ///
    /// # Errors
    /// No such program or thing.
    pub fn family_axes(
        &self,
        id: DocumentId,
        name: &str,
        of: Option<&str>,
    ) -> Result<Vec<FamilyAxis>, Refusal> {
        let open = self.document(id);
        map::axes(&open.state, name, &values_of(open, name, of)?)
    }

    /// Runs a program over a lattice of values of two parameters; the others are those of a thing, else the program's
    /// own.
    ///
    /// # Errors
    /// No such program, thing or parameter; an end that is no value.
    pub fn family_map(
        &self,
        id: DocumentId,
        (name, of): (&str, Option<&str>),
        axes: [&FamilyAxis; 2],
    ) -> Result<FamilyMap, Refusal> {
        let open = self.document(id);
        map::map(&open.state, name, &values_of(open, name, of)?, axes)
    }

    /// Changes the rows of a family.
    fn with_family(
        &mut self,
        id: DocumentId,
        (family, label): (&str, String),
        change: impl FnOnce(&State, &FamilyGrid, &mut Vec<Line>) -> Result<(), Refusal>,
    ) -> Result<Change, Refusal> {
        let state = &self.document(id).state;
        let shown = grid::grid(state, family, None)?;
        if !shown.is_own {
            return Err(words::refuse(match &shown.table {
                Some(file) => {
                    format!("the rows stand in {file}: take them into the document to change them")
                }
                None => format!("{family} is no family of this document: begin one"),
            }));
        }
        let mut lines: Vec<Line> = shown.rows.iter().map(|row| Line::of(&shown, row)).collect();
        change(state, &shown, &mut lines)?;
        let text = grid::with_rows(state, &shown, &lines)?;
        self.with_family_text(id, text, label)
    }

    fn with_family_text(
        &mut self,
        id: DocumentId,
        text: String,
        label: String,
    ) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        open.drag = None;
        let mut change = retext(open, &beside, text, label)?;
        if !change.edits.is_empty() {
            change.documents = self.reach(id);
        }
        Ok(change)
    }
}

/// The cells of a block that was copied, row by row; a cell in quotes may have tabs and line breaks in it.
///
/// # Errors
/// It cannot be read.
fn rows_of(block: &str) -> Result<Vec<Vec<String>>, Refusal> {
    let block = block.replace("\r\n", "\n");
    let block = block.trim_end_matches(['\n', '\r']);
    // what is one cell is typed: quotes in it are its own
    if !block.contains(['\t', '\n', '\r']) {
        let cell = Some(block.trim()).filter(|cell| !cell.is_empty());
        return Ok(cell.map(|cell| vec![cell.to_string()]).into_iter().collect());
    }
    let block = format!("{block}\n");
    // a quote that nothing closes is one of a cell's own
    let is_quoted = block.matches('"').count() % 2 == 0;
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(b'\t')
        .quoting(is_quoted)
        .has_headers(false)
        .flexible(true)
        .from_reader(block.as_bytes());
    let refused = |e: csv::Error| words::refuse(format!("what is pasted cannot be read: {e}"));
    let (mut rows, mut record) = (Vec::new(), csv::StringRecord::new());
    let mut line = reader.position().line();
    while reader.read_record(&mut record).map_err(refused)? {
        let next = reader.position().line();
        let breaks: usize = record.iter().map(|cell| cell.matches('\n').count()).sum();
        // the reader leaves out empty lines, which are rows without cells
        let empty = (next - line).saturating_sub(1 + breaks as u64);
        rows.extend((0..empty).map(|_| vec![String::new()]));
        rows.push(record.iter().map(|cell| cell.trim().to_string()).collect());
        line = next;
    }
    Ok(rows)
}

/// A number that no row is called by.
fn free_number(lines: &[Line]) -> String {
    let mut numbers = (lines.len() + 1..).map(|n| n.to_string());
    let is_free = |n: &String| lines.iter().all(|line| line.name != *n);
    numbers.find(is_free).unwrap_or_default()
}

/// The path of a thing that a program draws, and the names of its parameters.
fn parameters_of(state: &State, thing: &str) -> Result<(Path, Vec<String>), Refusal> {
    let path = parse_path(thing).ok_or_else(|| words::refuse(format!("{thing} is no path")))?;
    let class = state.structure.things[words::find(state, &path)?].class;
    let none = || words::refuse(format!("{thing} is not drawn by a program"));
    let program = state.lowered.document.program(class).ok_or_else(none)?;
    Ok((path, program.parameters.iter().map(|asked| asked.name.to_string()).collect()))
}

/// The value of a parameter in the program's own example.
fn example(
    state: &State,
    program: kernel::ClassId,
    column: &crate::view::GridColumn,
) -> Result<Literal, Refusal> {
    let none = || words::refuse(format!("{} has no example", column.name));
    let class = grid::class_of(state, program, &column.name).ok_or_else(none)?;
    super::literal(&state.lowered.document, class, &column.example).map_err(words::refuse)
}

/// The values of the parameters in a thing of a document; none without a thing.
fn values_of(open: &Open, name: &str, of: Option<&str>) -> Result<Vec<(String, Literal)>, Refusal> {
    let Some(of) = of else { return Ok(Vec::new()) };
    let state = &open.state;
    let (program, _) = find(state, name)?;
    let document = &state.lowered.document;
    let path = parse_path(of).ok_or_else(|| words::refuse(format!("{of} is no path")))?;
    words::find(state, &path)?;
    let evaluator = state.evaluator(open.values());
    let asked = document.program(program).map(|p| p.parameters.as_slice()).unwrap_or_default();
    let value = |asked: &kernel::program::Asked| {
        let answer = evaluator.at(&path.then(Step::Part(asked.name.clone()))).ok()?;
        Some((asked.name.to_string(), crate::check::literal_of(&answer).ok()?))
    };
    Ok(asked.iter().filter_map(value).collect())
}

/// Returns a name for a thing that has the values of a row: `b6204` for `6204`, `m10` for `M10`.
fn free_name(state: &State, row: &str, class: &str) -> String {
    let plain: String = row.chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    let mut words = plain.split_whitespace();
    let first = words.next().unwrap_or_default().to_lowercase();
    let rest: String = words.collect();
    let small: String = class.chars().take(1).flat_map(char::to_lowercase).collect();
    let starts_well = first.starts_with(char::is_alphabetic);
    let base = if starts_well { format!("{first}{rest}") } else { format!("{small}{first}{rest}") };
    let is_free = |name: &String| {
        let path = Path(vec![Step::Part(name.as_str().into())]);
        state.structure.follow(DOCUMENT, &path).is_err()
    };
    let names = std::iter::once(base.clone()).chain((2..).map(|n| format!("{base}_{n}")));
    { names }.find(is_free).unwrap_or_default()
}
