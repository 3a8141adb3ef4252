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
        let mut made = Self::with_width(width);
        rows.for_each(|row| made.push(row));
        made
    }
    /// Makes the pattern of no rows.
    pub(crate) fn with_width(width: usize) -> Self {
        Self::with_room(width, 0, 0)
    }
    /// Makes the pattern of no rows, with room for so many of so many entries in all.
    pub(crate) fn with_room(width: usize, rows: usize, entries: usize) -> Self {
        let mut starts = Vec::with_capacity(rows + 1);
        starts.push(0);
        Self { width, starts, columns: Vec::with_capacity(entries) }
    }
    /// Adds a row whose columns come in any order, some perhaps twice.
    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = u32>) {
        let start = self.columns.len();
        self.columns.extend(row);
        let own = &mut self.columns[start..];
        own.sort_unstable();
        let mut end = start;
        for at in start..self.columns.len() {
            if at == start || self.columns[at] != self.columns[end - 1] {
                self.columns[end] = self.columns[at];
                end += 1;
            }
        }
        self.columns.truncate(end);
        self.starts.push(end as u32);
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
    /// Returns the places of the symmetric matrix `[· Jᵀ; J ·]` of unknowns, then rows: the diagonal, then every
    /// entry, then what is told besides.
    pub(crate) fn bordered(
        &self,
        more: impl ExactSizeIterator<Item = (u32, u32)>,
    ) -> Vec<(u32, u32)> {
        let (n, m) = (self.width as u32, self.height() as u32);
        let mut places = Vec::with_capacity((n + m) as usize + self.len() + more.len());
        places.extend((0..n + m).map(|i| (i, i)));
        for r in 0..m {
            places.extend(self.row(r as usize).iter().map(|&c| (c, n + r)));
        }
        places.extend(more);
        places
    }
    /// Returns where an entry stands among all.
    pub(crate) fn find(&self, row: usize, column: u32) -> Option<usize> {
        let at = self.row(row).binary_search(&column).ok()?;
        Some(self.range(row).start + at)
    }
}
