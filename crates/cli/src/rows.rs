//! Rows of values as people read them: one below the other, and lists of like things as tables.

use session::view::ValueRow;
use std::fmt::Write;

/// A list of fewer things is written row by row.
const FEWEST: usize = 3;
/// A table that is wider is written row by row.
const WIDEST: usize = 120;

/// What is written of a value: of a large document there are as many as it has numbers.
pub(crate) struct Row {
    path: Box<str>,
    /// How it comes about, as one letter.
    pub(crate) mark: char,
    /// The value in its unit.
    text: Box<str>,
    unit: Box<str>,
    is_number: bool,
}

impl Row {
    /// Takes of a value what is written, with its mark.
    pub(crate) fn of(row: ValueRow, mark: char) -> Self {
        Self {
            path: row.shortest.into(),
            mark,
            text: row.text.into(),
            unit: row.unit.into(),
            is_number: row.number.is_some(),
        }
    }
}

impl Row {
    /// Returns the number of a row in another unit, where one is a decimal multiple of the other.
    fn number_in(&self, unit: &str) -> Option<f64> {
        let x: f64 = self.text.parse().ok()?;
        format!("{x}e{}", session::decimal_shift(&self.unit, unit)?).parse().ok()
    }

    /// Returns the row in another unit, one that is computed and rounding beside the largest of its column as nothing;
    /// nothing where the number would be hard to read in it.
    fn in_unit(&self, unit: &str, largest: f64) -> Option<Self> {
        let x = self.number_in(unit)?;
        let is_rounding = self.mark == ' ' && x.abs() < session::ROUNDING * largest;
        let x = if is_rounding { 0.0 } else { x };
        let is_readable = x == 0.0 || (1e-3..1e6).contains(&x.abs());
        let text = base::number::significant(x, 6).into();
        is_readable.then(|| Self { path: self.path.clone(), text, unit: unit.into(), ..*self })
    }
}

/// What stands together.
enum Block<'r> {
    Rows(Vec<&'r Row>),
    Table(Columns),
}

/// The columns of a table: words one below the other, the head first, all of a column equally wide.
struct Columns(Vec<Vec<String>>);

/// Between two columns.
const GAP: &str = "  ";

/// A list of things: a line for each, a column for each value that they have.
struct Table<'r> {
    list: &'r str,
    columns: Vec<&'r str>,
    lines: Vec<(&'r str, Vec<Option<&'r Row>>)>,
}

/// Writes rows: path, mark, value, numbers one below the other by their decimal points.
pub(crate) fn written(rows: &[Row]) -> String {
    let blocks = blocks(&rows.iter().collect::<Vec<_>>());
    let alone =
        || blocks.iter().filter_map(|b| if let Block::Rows(rows) = b { Some(rows) } else { None });
    let width = alone().flatten().map(|r| r.path.chars().count()).max().unwrap_or(0).min(WIDEST);
    let digits = alone().flatten().map(|r| before_point(r)).max().unwrap_or(0);
    let mut words = String::new();
    for block in &blocks {
        match block {
            Block::Rows(rows) => {
                for row in rows {
                    let (path, mark) = (&row.path, row.mark);
                    let _ = writeln!(words, "{path:width$} {mark} {}", value(row, digits));
                }
            }
            Block::Table(table) => words.push_str(&table.written()),
        }
    }
    words
}

fn blocks<'r>(rows: &[&'r Row]) -> Vec<Block<'r>> {
    let mut blocks: Vec<Block<'r>> = Vec::new();
    let list = |row: &Row| element(&row.path).map(|(list, ..)| list.to_string());
    for run in rows.chunk_by(|a, b| list(a) == list(b)) {
        let columns = Table::of(run).filter(Table::is_full).map(|table| table.columns());
        match (columns.filter(|columns| columns.width() <= WIDEST), blocks.last_mut()) {
            (Some(columns), _) => blocks.push(Block::Table(columns)),
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
    fn of(rows: &[&'r Row]) -> Option<Self> {
        let (list, ..) = element(&rows.first()?.path)?;
        let mut table = Self { list, columns: Vec::new(), lines: Vec::new() };
        for &row in rows {
            let (_, name, part) = element(&row.path)?;
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
    fn is_full(&self) -> bool {
        let is_empty = |cell: &&Option<&Row>| cell.is_none();
        let empty: usize =
            self.lines.iter().map(|(_, cells)| cells.iter().filter(is_empty).count()).sum();
        let all = self.lines.len() * self.columns.len();
        self.lines.len() >= FEWEST && self.columns.len() > 1 && 4 * empty <= all
    }

    fn columns(&self) -> Columns {
        let names: Vec<String> = self.lines.iter().map(|(name, _)| (*name).to_string()).collect();
        let mut columns = vec![aligned(self.list, &names)];
        for (at, head) in self.columns.iter().enumerate() {
            let cells: Vec<Option<&Row>> = self.lines.iter().map(|(_, cells)| cells[at]).collect();
            let alike = in_one_unit(&cells);
            let cells = || alike.iter().zip(&cells).map(|(alike, cell)| alike.as_ref().or(*cell));
            let digits = cells().flatten().map(before_point).max().unwrap_or(0);
            let is_marked = cells().flatten().any(|row| row.mark != ' ');
            let cell = |row: Option<&Row>| match row {
                Some(row) if is_marked => format!("{} {}", row.mark, value(row, digits)),
                Some(row) => value(row, digits),
                None => String::new(),
            };
            columns.push(aligned(head, &cells().map(cell).collect::<Vec<_>>()));
        }
        Columns(columns)
    }
}

impl Columns {
    /// Returns how many letters the widest line may have.
    fn width(&self) -> usize {
        let head = |column: &Vec<String>| column.first().map_or(0, |cell| cell.chars().count());
        let widths: usize = self.0.iter().map(head).sum();
        widths + GAP.len() * self.0.len().saturating_sub(1)
    }

    fn written(&self) -> String {
        let mut words = String::new();
        let lines = self.0.first().map_or(0, Vec::len);
        for line in 0..lines {
            let cells: Vec<&str> = self.0.iter().map(|column| &*column[line]).collect();
            let _ = writeln!(words, "{}", cells.join(GAP).trim_end());
        }
        words
    }
}

/// Writes the cells of a column in the unit that most of them have, the first of several, where the others are decimal
/// multiples of it and all are easily read so; nothing for a cell that stays as it is.
fn in_one_unit(cells: &[Option<&Row>]) -> Vec<Option<Row>> {
    let as_it_is = || cells.iter().map(|_| None).collect();
    let rows = || cells.iter().flatten().filter(|row| row.is_number);
    let mut units: Vec<(&str, usize)> = Vec::new();
    // nothing is as easily read in any unit
    for row in rows().filter(|row| &*row.text != "0") {
        match units.iter_mut().find(|(unit, _)| *unit == &*row.unit) {
            Some((_, count)) => *count += 1,
            None => units.push((&row.unit, 1)),
        }
    }
    let most = units.iter().map(|(_, count)| *count).max().unwrap_or(0);
    let Some((unit, _)) = units.into_iter().find(|(_, count)| *count == most) else {
        return as_it_is();
    };
    let largest = rows().filter_map(|row| row.number_in(unit)).map(f64::abs).fold(0.0, f64::max);
    let converted = |cell: &Option<&Row>| match cell {
        Some(row) if row.is_number && &*row.unit != unit => row.in_unit(unit, largest).map(Some),
        _ => Some(None),
    };
    cells.iter().map(converted).collect::<Option<_>>().unwrap_or_else(as_it_is)
}

/// Returns a column of words, its head first, each as wide as the widest.
fn aligned(head: &str, cells: &[String]) -> Vec<String> {
    let column = || std::iter::once(head).chain(cells.iter().map(String::as_str));
    let width = column().map(|cell| cell.chars().count()).max().unwrap_or(0);
    column().map(|cell| format!("{cell:width$}")).collect()
}

/// Writes a value with its unit, so many letters before the decimal point of a number.
fn value(row: &Row, digits: usize) -> String {
    let pad = if row.is_number { digits.saturating_sub(before_point(row)) } else { 0 };
    let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
    format!("{:pad$}{}{unit}", "", row.text)
}

/// Returns how many letters of a number stand before its decimal point; none of what is no number.
fn before_point(row: &Row) -> usize {
    match row.text.parse::<f64>() {
        Ok(_) if row.is_number => row.text.find(['.', 'e']).unwrap_or(row.text.len()),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A list of three things with a number and a text each.
    fn rows(text: &str) -> Vec<Row> {
        let row = |path: String, text: &str| Row {
            path: path.into(),
            mark: ' ',
            text: text.into(),
            unit: "".into(),
            is_number: false,
        };
        let each = |i: usize| [row(format!("l[{i}].n"), "1"), row(format!("l[{i}].t"), text)];
        (0..3).flat_map(each).collect()
    }

    #[test]
    fn a_column_counts_in_the_unit_that_most_of_it_has() {
        let row = |i: usize, text: &str, unit: &str| Row {
            path: format!("l[{i}].n").into(),
            mark: ' ',
            text: text.into(),
            unit: unit.into(),
            is_number: true,
        };
        let column = |cells: [(&str, &str); 3]| {
            let rows: Vec<Row> = (0..).zip(cells).map(|(i, (n, u))| row(i, n, u)).collect();
            let cells: Vec<Option<&Row>> = rows.iter().map(Some).collect();
            let alike = in_one_unit(&cells);
            let shown = alike.iter().zip(&rows).map(|(alike, row)| alike.as_ref().unwrap_or(row));
            shown.map(|row| value(row, 0)).collect::<Vec<_>>().join(", ")
        };
        assert_eq!(column([("400", "mm"), ("0.8", "m"), ("1.2", "m")]), "0.4 m, 0.8 m, 1.2 m");
        assert_eq!(column([("0", "A"), ("2", "mA"), ("0.5", "mA")]), "0 mA, 2 mA, 0.5 mA");
        assert_eq!(column([("2", "fm"), ("2", "mm"), ("5", "mm")]), "0 mm, 2 mm, 5 mm");
        // hard to read, and no multiples
        assert_eq!(column([("1", "nA"), ("1", "A"), ("2", "A")]), "1 nA, 1 A, 2 A");
        assert_eq!(column([("1", "in"), ("1", "m"), ("2", "m")]), "1 in, 1 m, 2 m");
    }

    #[test]
    fn a_long_text_in_the_last_column_makes_no_wide_table() {
        let lines = written(&rows(&"x".repeat(300)));
        assert!(lines.starts_with("l[0].n"), "{lines}");
        let lines = written(&rows("x"));
        assert_eq!(lines, "l     n  t\nl[0]  1  x\nl[1]  1  x\nl[2]  1  x\n");
    }
}
