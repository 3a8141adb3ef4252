//! What the page says of families.

/// The tab with a program's rows.
pub const FAMILY: &str = "Family";
/// Which family is shown.
pub const WHICH_FAMILY: &str = "Family or program";
/// The rows as a grid.
pub const FAMILY_ROWS: &str = "Rows";
/// The rows as pictures.
pub const FAMILY_PICTURES: &str = "Pictures";
/// Where the program draws.
pub const FAMILY_MAP: &str = "Map";
/// Begins a family.
pub const BEGIN_FAMILY: &str = "Begin a family";
/// What the button says of itself.
pub const BEGIN_FAMILY_HELP: &str = "Rows of values that this program draws, kept in the document";
/// Adds a row.
pub const ADD_ROW: &str = "Add row";
/// Takes a table from a file.
pub const TAKE_CSV: &str = "Load CSV";
/// Hands out a table.
pub const GIVE_CSV: &str = "Save CSV";
/// Hands out the drawings.
pub const GIVE_SVG: &str = "Save SVG";
pub const GIVE_DXF: &str = "Save DXF";
pub const GIVE_DRAWINGS_HELP: &str = "a drawing for each row, all in one archive";
/// So many of the rows have a file in an archive.
pub fn files_given(drawn: usize, all: usize) -> String {
    match drawn == all {
        true => format!("a drawing for each of {all} rows"),
        false => format!(
            "{drawn} drawings; {} of {all} rows are not drawn: the grid says why",
            all - drawn
        ),
    }
}
/// Takes the rows of a file into the document.
pub const TAKE_TABLE: &str = "Take the rows into the document";
/// The names of the rows.
pub const ROW_NAME: &str = "name";
/// The row that is not there yet.
pub const NEW_ROW: &str = "new row";
/// What comes of the rows.
pub const ROW_OUTCOME: &str = "outcome";
/// The values of a row go to the example.
pub const ROW_SET: &str = "Apply";
/// A new thing has the values of a row.
pub const ROW_PLACE: &str = "Place";
/// Deletes a row.
pub const ROW_DELETE: &str = "Delete this row";
/// The thing that takes values.
pub const APPLY_TO: &str = "to";
/// A row is drawn.
pub const ROW_DRAWN: &str = "drawn";
/// There are no programs.
pub const NO_PROGRAMS: &str = "This document has no program. Draw one example with Record in the drawer Draw, or open one from the gallery.";
/// A program without a family.
pub const NO_FAMILY: &str = "This program has no family yet.";
/// A family without rows.
pub const NO_ROWS: &str = "No rows yet.";
/// A table is fetched.
pub const TABLE_COMES: &str = "The table is being read …";
/// The parameter to the right.
pub const MAP_ACROSS: &str = "Across";
/// The parameter upwards.
pub const MAP_UP: &str = "Up";
/// A map needs two parameters.
pub const MAP_NEEDS_TWO: &str = "A map is over two numbers: this program has fewer.";
/// How a map is used.
pub const MAP_HELP: &str =
    "Click, or arrows and Enter: the parameters take the values of the place";
/// Where something is drawn.
pub const MAP_DRAWN: &str = "is drawn";
/// Where the example is now.
pub const MAP_NOW: &str = "the example now";

/// The rows stand in a file.
pub fn rows_in_file(file: &str) -> String {
    format!("The rows stand in {file}.")
}

/// There is no such table.
pub fn no_table(path: &str) -> String {
    format!("there is no table {path}")
}

/// What a cell is.
pub fn cell_of(column: &str, row: &str) -> String {
    format!("{column} of {row}")
}

/// Rows that are not shown.
pub fn more_rows(count: usize) -> String {
    format!("{count} more rows: thinglab family draws them all.")
}

/// How many rows are drawn.
pub fn rows_drawn(drawn: usize, all: usize) -> String {
    match (drawn, all) {
        (1, 1) => String::from("1 row, drawn"),
        (drawn, all) if drawn == all => format!("{all} rows, all drawn"),
        (drawn, all) => format!("{drawn} of {all} rows drawn"),
    }
}

/// What applying a row does.
pub fn applied_to(thing: &str) -> String {
    format!("{thing} takes the values of this row")
}

/// A row is used.
pub fn row_used(row: &str, thing: &str) -> String {
    format!("{thing} is {row}")
}
