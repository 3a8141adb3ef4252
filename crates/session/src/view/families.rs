//! Views of families: rows as a grid, and where in two parameters a program draws.

use super::FamilyRow;

/// The rows of a family as a grid.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FamilyGrid {
    /// The family; of a program without one, the program.
    pub name: String,
    /// The program.
    pub program: String,
    /// The file where the rows stand; nothing where they stand in the document.
    pub table: Option<String>,
    /// Whether the rows stand in this document, so that they can be changed here.
    pub is_own: bool,
    /// The parameters.
    pub columns: Vec<GridColumn>,
    /// The rows, in order; the cells are what is written of each.
    pub rows: Vec<FamilyRow>,
    /// What is odd about them.
    pub notes: Vec<String>,
}

impl FamilyGrid {
    /// Writes the rows as a table, CSV: a column whose values all have one unit has it in its header.
    pub fn csv(&self) -> String {
        crate::families::csv(self)
    }
    /// What is written in a cell; empty where the program's own example counts.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        let (Some(row), Some(column)) = (self.rows.get(row), self.columns.get(column)) else {
            return "";
        };
        let found = row.written.iter().find(|(name, _)| *name == column.name);
        found.map_or("", |(_, text)| text.as_str())
    }
}

/// A parameter of a grid.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct GridColumn {
    /// The parameter.
    pub name: String,
    /// What is asked, in words.
    pub prompt: String,
    /// Its value in the program's own example.
    pub example: String,
    /// The values of a table of those that are allowed; none where there is no such table.
    pub choices: Vec<String>,
}

/// What a row is used for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum RowUse {
    /// A thing of the document that the program draws takes the values.
    Set(String),
    /// A new thing of the document has them.
    Place,
}

/// A parameter that a map can be made over, and the range that suggests itself.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct FamilyAxis {
    /// The parameter.
    pub parameter: String,
    /// Where it begins, as it is typed.
    pub from: String,
    /// Where it ends.
    pub to: String,
}

/// Where in two parameters a program draws: a lattice of values, row by row from the lowest.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FamilyMap {
    /// To the right.
    pub across: MapAxis,
    /// Upwards.
    pub up: MapAxis,
    /// Of each place which reason there is against it, by its number; nothing where it is drawn.
    pub places: Vec<Option<usize>>,
    /// The reasons, in the order in which they are met.
    pub reasons: Vec<MapReason>,
    /// What the two parameters are in the example now: a place of the map from 0 to 1, right and up.
    pub now: Option<(f64, f64)>,
}

impl FamilyMap {
    /// What the parameters are at a place, as they are typed, and what comes of it.
    pub fn place(&self, across: usize, up: usize) -> Option<MapPlace> {
        let reason = *self.places.get(up * self.across.values.len() + across)?;
        let value = |axis: &MapAxis, at: usize| {
            let number = base::number::significant(*axis.values.get(at)?, 6);
            Some(crate::words::with_unit(number, &axis.unit))
        };
        Some(MapPlace {
            across: value(&self.across, across)?,
            up: value(&self.up, up)?,
            why: reason.and_then(|r| self.reasons.get(r)).map(|r| r.message.clone()),
        })
    }
}

/// A parameter along a side of a map.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct MapAxis {
    /// The parameter.
    pub parameter: String,
    /// Its values, in `unit`.
    pub values: Vec<f64>,
    /// The unit; empty for plain numbers.
    pub unit: String,
}

/// Why a program does not draw at some places of a map.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct MapReason {
    /// `outside`, `failed` or `too-long`.
    pub outcome: String,
    /// The demand or the step.
    pub step: String,
    /// What was found and wanted at the first of them.
    pub message: String,
}

/// A place of a map.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct MapPlace {
    /// The value to the right.
    pub across: String,
    /// The value upwards.
    pub up: String,
    /// Why nothing is drawn there; nothing where it is drawn.
    pub why: Option<String>,
}
