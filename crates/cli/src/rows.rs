//! Rows of values as people read them: one below the other, and lists of like things as tables.

use session::view::ValueRow;
use std::fmt::Write;

/// A list of fewer things is written row by row.
const FEWEST: usize = 3;
/// A table that is wider is written row by row.
const WIDEST: usize = 120;

/// How a value comes about, as one letter.
type Mark<'m> = &'m dyn Fn(&ValueRow) -> char;

/// What stands together.
enum Block<'r> {
    Rows(Vec<&'r ValueRow>),
    Table(Table<'r>),
}

/// A list of things: a line for each, a column for each value that they have.
struct Table<'r> {
    list: &'r str,
    columns: Vec<&'r str>,
    lines: Vec<(&'r str, Vec<Option<&'r ValueRow>>)>,
}

/// Writes rows: path, mark, value, numbers one below the other by their decimal points.
pub(crate) fn written(rows: &[&ValueRow], mark: Mark<'_>) -> String {
    let blocks = blocks(rows, mark);
    let alone =
        || blocks.iter().filter_map(|b| if let Block::Rows(rows) = b { Some(rows) } else { None });
    let width = alone().flatten().map(|r| r.shortest.chars().count()).max().unwrap_or(0);
    let digits = alone().flatten().map(|r| before_point(r)).max().unwrap_or(0);
    let mut words = String::new();
    for block in &blocks {
        match block {
            Block::Rows(rows) => {
                for row in rows {
                    let (path, mark) = (&row.shortest, mark(row));
                    let _ = writeln!(words, "{path:width$} {mark} {}", value(row, digits));
                }
            }
            Block::Table(table) => words.push_str(&table.written(mark)),
        }
    }
    words
}

fn blocks<'r>(rows: &[&'r ValueRow], mark: Mark<'_>) -> Vec<Block<'r>> {
    let mut blocks: Vec<Block<'r>> = Vec::new();
    let list = |row: &ValueRow| element(&row.shortest).map(|(list, ..)| list.to_string());
    for run in rows.chunk_by(|a, b| list(a) == list(b)) {
        match (Table::of(run).filter(|table| table.reads_well(mark)), blocks.last_mut()) {
            (Some(table), _) => blocks.push(Block::Table(table)),
            (None, Some(Block::Rows(rows))) => rows.extend(run),
            (None, _) => blocks.push(Block::Rows(run.to_vec())),
        }
    }
    blocks
}

/// Takes `posts[2].at.x` apart: the list, its element, what the element has.
fn element(path: &str) -> Option<(&str, &str, &str)> {
    let end = path.find("].")? + 1;
    let list = &path[..path[..end].rfind('[')?];
    Some((list, &path[..end], &path[end + 1..]))
}

impl<'r> Table<'r> {
    /// Makes a table of rows of one list.
    fn of(rows: &[&'r ValueRow]) -> Option<Self> {
        let (list, ..) = element(&rows.first()?.shortest)?;
        let mut table = Self { list, columns: Vec::new(), lines: Vec::new() };
        for &row in rows {
            let (_, name, part) = element(&row.shortest)?;
            let at = table.columns.iter().position(|c| *c == part).unwrap_or_else(|| {
                table.columns.push(part);
                table.columns.len() - 1
            });
            if at >= WIDEST {
                return None;
            }
            if table.lines.last().is_none_or(|line| line.0 != name) {
                table.lines.push((name, Vec::new()));
            }
            let (_, cells) = table.lines.last_mut()?;
            cells.resize(cells.len().max(at + 1), None);
            cells[at] = Some(row);
        }
        let count = table.columns.len();
        table.lines.iter_mut().for_each(|(_, cells)| cells.resize(count, None));
        Some(table)
    }

    /// Returns true where a table says more at a glance than its rows would.
    fn reads_well(&self, mark: Mark<'_>) -> bool {
        let is_empty = |cell: &&Option<&ValueRow>| cell.is_none();
        let empty: usize =
            self.lines.iter().map(|(_, cells)| cells.iter().filter(is_empty).count()).sum();
        let all = self.lines.len() * self.columns.len();
        self.lines.len() >= FEWEST
            && self.columns.len() > 1
            && 4 * empty <= all
            && self.written(mark).lines().next().is_some_and(|head| head.chars().count() <= WIDEST)
    }

    fn written(&self, mark: Mark<'_>) -> String {
        let mut columns = Vec::new();
        for (at, head) in self.columns.iter().enumerate() {
            let cells = || self.lines.iter().map(move |(_, cells)| cells[at]);
            let digits = cells().flatten().map(before_point).max().unwrap_or(0);
            let is_marked = cells().flatten().any(|row| mark(row) != ' ');
            let cell = |row: Option<&ValueRow>| match row {
                Some(row) if is_marked => format!("{} {}", mark(row), value(row, digits)),
                Some(row) => value(row, digits),
                None => String::new(),
            };
            columns.push(aligned(head, &cells().map(cell).collect::<Vec<_>>()));
        }
        let names: Vec<String> = self.lines.iter().map(|(name, _)| (*name).to_string()).collect();
        columns.insert(0, aligned(self.list, &names));
        let mut words = String::new();
        for line in 0..=self.lines.len() {
            let cells: Vec<&str> = columns.iter().map(|column| &*column[line]).collect();
            let _ = writeln!(words, "{}", cells.join("  ").trim_end());
        }
        words
    }
}

/// Returns a column of words, its head first, each as wide as the widest.
fn aligned(head: &str, cells: &[String]) -> Vec<String> {
    let column = || std::iter::once(head).chain(cells.iter().map(String::as_str));
    let width = column().map(|cell| cell.chars().count()).max().unwrap_or(0);
    column().map(|cell| format!("{cell:width$}")).collect()
}

/// Writes a value with its unit, so many letters before the decimal point of a number.
fn value(row: &ValueRow, digits: usize) -> String {
    let pad = if row.number.is_some() { digits.saturating_sub(before_point(row)) } else { 0 };
    let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
    format!("{:pad$}{}{unit}", "", row.text)
}

/// Returns how many letters of a number stand before its decimal point; none of what is no number.
fn before_point(row: &ValueRow) -> usize {
    match row.text.parse::<f64>() {
        Ok(_) if row.number.is_some() => row.text.find(['.', 'e']).unwrap_or(row.text.len()),
        _ => 0,
    }
}
