//! Patterns: where a matrix has entries, row by row.

/// The places of a matrix's entries, by row, columns ascending.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Pattern {
    /// How many columns there are.
    pub(crate) width: usize,
    starts: Vec<u32>,
    columns: Vec<u32>,
}

impl Pattern {
    /// Makes the pattern of rows whose columns come in any order, some perhaps twice.
    pub(crate) fn of_rows(width: usize, rows: impl Iterator<Item = Vec<u32>>) -> Self {
        let mut made = Self { width, starts: vec![0], columns: Vec::new() };
        for mut row in rows {
            row.sort_unstable();
            row.dedup();
            made.columns.extend(row);
            made.starts.push(made.columns.len() as u32);
        }
        made
    }
    /// Returns the number of rows.
    pub(crate) fn height(&self) -> usize {
        self.starts.len() - 1
    }
    /// Returns the number of entries.
    pub(crate) fn len(&self) -> usize {
        self.columns.len()
    }
    /// Returns where a row's entries stand among all.
    pub(crate) fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }
    /// Returns a row's columns.
    pub(crate) fn row(&self, row: usize) -> &[u32] {
        &self.columns[self.range(row)]
    }
    /// Returns the column of an entry.
    pub(crate) fn column(&self, entry: usize) -> usize {
        self.columns[entry] as usize
    }
    /// Returns where an entry stands among all.
    pub(crate) fn find(&self, row: usize, column: u32) -> Option<usize> {
        let at = self.row(row).binary_search(&column).ok()?;
        Some(self.range(row).start + at)
    }
}
