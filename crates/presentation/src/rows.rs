//! Rows of the structure: which are in sight, which speak of a thing, and where they are written.

use crate::paths::{covers, speaks_of};
use crate::sentences::formula;
use session::view::{RowKind, StructureRow};
use std::collections::BTreeSet;

/// At most so many constraints of a thing are shown at once; the tree has the others.
const MOST: usize = 40;

/// A row that no shut row hides.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Shown {
    /// Its number among all rows.
    pub at: usize,
    /// The how-manieth it is of its owner's rows, from 1, and how many those are.
    pub position: (u32, u32),
}

/// The rows that no shut row hides, in order.
pub fn shown(rows: &[StructureRow], is_open: impl Fn(&StructureRow) -> bool) -> Vec<Shown> {
    let mut shown: Vec<Shown> = Vec::new();
    // for every depth on the way to the present row, the places of its owner's rows so far
    let mut siblings: Vec<Vec<usize>> = Vec::new();
    let close = |siblings: Vec<usize>, shown: &mut Vec<Shown>| {
        siblings.iter().for_each(|&place| shown[place].position.1 = siblings.len() as u32);
    };
    let mut at = 0;
    while let Some(row) = rows.get(at) {
        let depth = row.depth as usize;
        siblings.drain((depth + 1).min(siblings.len())..).for_each(|s| close(s, &mut shown));
        siblings.resize_with(depth + 1, Vec::new);
        siblings[depth].push(shown.len());
        shown.push(Shown { at, position: (siblings[depth].len() as u32, 0) });
        let shut = row.descendants > 0 && !is_open(row);
        at += 1 + if shut { row.descendants as usize } else { 0 };
    }
    siblings.into_iter().for_each(|s| close(s, &mut shown));
    shown
}

/// The constraints of a thing and those that speak of it; of the document its own.
pub fn shown_rules(rows: &[StructureRow], selected: Option<&str>) -> Vec<StructureRow> {
    let rules = rows.iter().filter(|row| row.kind == RowKind::Constraint);
    // what has a part that is one with it says something of it
    let owner = |path: &str| path.rsplit_once('.').map(|(owner, _)| String::from(owner));
    let speakers: BTreeSet<String> = selected
        .map(|path| {
            let one = rows.iter().filter(|row| row.merged_with.as_deref() == Some(path));
            one.filter_map(|row| owner(&row.path)).collect()
        })
        .unwrap_or_default();
    let fits = |row: &&StructureRow| match selected {
        Some(path) => {
            covers(path, &row.path)
                || speaks_of(&row.detail, path)
                || owner(&row.path).is_some_and(|owner| speakers.contains(&owner))
        }
        None => row.depth == 1,
    };
    rules.filter(fits).take(MOST).cloned().collect()
}

/// A constraint's row without what its name says already; any other row's detail.
pub fn rule_alone(row: &StructureRow) -> &str {
    let rest = row.detail.strip_prefix("constraint ").unwrap_or(&row.detail).trim_start();
    let rest = rest
        .strip_prefix(row.name.as_str())
        .map_or(rest, |rest| rest.trim_start().strip_prefix(':').map_or(rest, str::trim_start));
    if row.kind == RowKind::Constraint { rest } else { &row.detail }
}

/// Whether a row is a constraint or a merge that nobody has named: its rule says more than `constraint3`.
pub fn is_unnamed(row: &StructureRow) -> bool {
    if row.name.is_empty() && !row.kind.has_own_path() {
        return true;
    }
    let number = row.name.strip_prefix("constraint");
    row.kind == RowKind::Constraint
        && number.is_some_and(|n| !n.is_empty() && n.chars().all(|c| c.is_ascii_digit()))
}

/// What a row is called where it stands alone: by its path, or by what it says where nobody has named it.
pub fn called(row: &StructureRow) -> String {
    match is_unnamed(row) && row.kind == RowKind::Constraint {
        true => formula(&session::rule_in_words(rule_alone(row))),
        false => row.path.clone(),
    }
}

/// The same among all rows: by its path where another says the same, as each of a loop does, or of two things of a class.
pub fn told_apart(row: &StructureRow, rows: &[StructureRow]) -> String {
    let is_same = |other: &StructureRow| {
        other.kind == row.kind && other.detail == row.detail && other.path != row.path
    };
    if rows.iter().any(is_same) { row.path.clone() } else { called(row) }
}

/// Where a thing is written, or else the nearest thing that it is a part of.
pub fn span_of(rows: &[StructureRow], path: &str) -> Option<(u32, u32)> {
    let mut path = path;
    loop {
        if path.is_empty() {
            return None;
        }
        let own = rows.iter().find(|row| row.path == path && row.span.is_some());
        if let Some(row) = own {
            return row.span;
        }
        path = path.rfind('.').map_or("", |at| &path[..at]);
    }
}

/// The smallest thing that is written around an offset.
pub fn path_at(rows: &[StructureRow], offset: u32) -> Option<String> {
    let around = rows.iter().filter_map(|row| {
        let (start, end) = row.span?;
        (start <= offset && offset <= end && !row.path.is_empty()).then_some((end - start, row))
    });
    around.min_by_key(|(length, _)| *length).map(|(_, row)| row.path.clone())
}

#[cfg(test)]
mod tests {
    use super::{Shown, path_at, shown, shown_rules, span_of};
    use session::view::{RowKind, StructureRow};

    fn row(path: &str, depth: u32, descendants: u32) -> StructureRow {
        StructureRow {
            path: String::from(path),
            depth,
            kind: RowKind::Part,
            name: String::from(path),
            detail: String::new(),
            doc: String::new(),
            value: None,
            exact: None,
            merged_with: None,
            makes_one: Vec::new(),
            freedom: None,
            anchored: false,
            enabled: true,
            descendants,
            span: None,
        }
    }

    fn written(path: &str, span: Option<(u32, u32)>) -> StructureRow {
        StructureRow { span, ..row(path, 0, 0) }
    }

    #[test]
    fn shut_rows_hide_theirs_and_siblings_are_counted() {
        let rows =
            [row("", 0, 4), row("a", 1, 1), row("a.x", 2, 0), row("b", 1, 1), row("b.x", 2, 0)];
        let found = |shut: &str| {
            let rows = shown(&rows, |row| row.path != shut);
            rows.iter().map(|Shown { at, position }| (*at, *position)).collect::<Vec<_>>()
        };
        let all = [(0, (1, 1)), (1, (1, 2)), (2, (1, 1)), (3, (2, 2)), (4, (1, 1))];
        assert_eq!(found("none"), all);
        assert_eq!(found("a"), [(0, (1, 1)), (1, (1, 2)), (3, (2, 2)), (4, (1, 1))]);
        assert_eq!(found(""), [(0, (1, 1))]);
        assert_eq!(shown(&[], |_| true), []);
    }

    #[test]
    fn a_point_shows_the_constraint_whose_point_it_is_one_with() {
        let row = |path: &str, kind, merged: Option<&str>| StructureRow {
            path: String::from(path),
            depth: 2,
            kind,
            name: String::new(),
            detail: String::from("axis.passes(through: a)"),
            doc: String::new(),
            value: None,
            exact: None,
            merged_with: merged.map(String::from),
            makes_one: Vec::new(),
            freedom: None,
            anchored: false,
            enabled: true,
            descendants: 0,
            span: None,
        };
        let rows = [
            row("line.p1", RowKind::Part, None),
            row("mirror.a", RowKind::Part, Some("line.p1")),
            row("mirror.across", RowKind::Constraint, None),
            row("other.across", RowKind::Constraint, None),
        ];
        let shown: Vec<String> =
            shown_rules(&rows, Some("line.p1")).into_iter().map(|row| row.path).collect();
        assert_eq!(shown, ["mirror.across"]);
    }

    #[test]
    fn what_is_written_nowhere_is_marked_where_its_owner_is() {
        let rows =
            [written("", Some((0, 90))), written("q", Some((10, 20))), written("q.side", None)];
        assert_eq!(span_of(&rows, "q.side.p1"), Some((10, 20)));
        assert_eq!(span_of(&rows, "other"), None);
    }

    #[test]
    fn the_cursor_selects_the_innermost_thing() {
        let rows = [
            written("", Some((0, 90))),
            written("q", Some((10, 40))),
            written("q.side", Some((20, 30))),
        ];
        assert_eq!(path_at(&rows, 25).as_deref(), Some("q.side"));
        assert_eq!(path_at(&rows, 12).as_deref(), Some("q"));
        assert_eq!(path_at(&rows, 80), None);
    }
}
