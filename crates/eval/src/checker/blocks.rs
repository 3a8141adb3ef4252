//! The blocks of as many rows as unknowns: each is found from what the blocks before it came to.
//!
//! In: which unknowns every row speaks of. Out: the smallest sets of rows that have as many unknowns of their own.

/// As many rows as unknowns, by index.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Block {
    pub(crate) rows: Vec<usize>,
    pub(crate) columns: Vec<usize>,
}

/// Returns the blocks of a square pattern; nothing where not every row can have an unknown of its own.
pub(crate) fn blocks(speaks: &[Vec<bool>]) -> Option<Vec<Block>> {
    let n = speaks.len();
    let mut row_of: Vec<Option<usize>> = vec![None; n];
    for row in 0..n {
        if !assign(speaks, row, &mut vec![false; n], &mut row_of) {
            return None;
        }
    }
    let row_of: Vec<usize> = row_of.into_iter().collect::<Option<_>>()?;
    let reached: Vec<Vec<bool>> = (0..n).map(|column| reached(speaks, &row_of, column)).collect();
    let together = |a: usize, b: usize| reached[a][b] && reached[b][a];
    let firsts = (0..n).filter(|&column| (0..column).all(|other| !together(column, other)));
    let block = |first: usize| {
        let columns: Vec<usize> = (first..n).filter(|&other| together(first, other)).collect();
        Block { rows: columns.iter().map(|&column| row_of[column]).collect(), columns }
    };
    Some(firsts.map(block).collect())
}

/// Gives a row an unknown of its own, others of theirs another where that has to be.
fn assign(
    speaks: &[Vec<bool>],
    row: usize,
    seen: &mut [bool],
    row_of: &mut [Option<usize>],
) -> bool {
    for column in (0..speaks.len()).filter(|&column| speaks[row][column]) {
        if std::mem::replace(&mut seen[column], true) {
            continue;
        }
        let is_free = row_of[column].is_none_or(|other| assign(speaks, other, seen, row_of));
        if is_free {
            row_of[column] = Some(row);
            return true;
        }
    }
    false
}

/// Returns the unknowns that an unknown is found from, itself included.
fn reached(speaks: &[Vec<bool>], row_of: &[usize], from: usize) -> Vec<bool> {
    let mut reached = vec![false; row_of.len()];
    let mut stack = vec![from];
    while let Some(column) = stack.pop() {
        if !std::mem::replace(&mut reached[column], true) {
            stack.extend((0..row_of.len()).filter(|&other| speaks[row_of[column]][other]));
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_needs_one_another_is_one_block() {
        // x + y, x - y, z + x
        let speaks = [[true, true, false], [true, true, false], [true, false, true]];
        let speaks = speaks.map(Vec::from);
        let found = blocks(&speaks).unwrap();
        let columns: Vec<&[usize]> = found.iter().map(|b| b.columns.as_slice()).collect();
        assert_eq!(columns, [&[0, 1][..], &[2]]);
        assert_eq!(found[1].rows, [2]);
    }

    #[test]
    fn two_rows_of_one_unknown_have_no_blocks() {
        assert_eq!(blocks(&[vec![true, false], vec![true, false]]), None);
    }
}
