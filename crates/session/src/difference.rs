//! The difference of two texts, as few small stretches.
//!
//! Lines that both have, in order, are kept (greedily, the fewest changes first); of the lines between
//! them only what differs is replaced.
//!
//! **Source:** Myers, "An O(ND) Difference Algorithm and Its Variations", Algorithmica 1986.

use crate::state::State;
use crate::view::TextChange;
use crate::words;
use kernel::Part;
use std::collections::BTreeSet;
use syntax::ast::AstNode;

/// Texts that differ in more lines than this are one stretch: nobody follows so many with the eye.
const MOST_LINES: usize = 200;

/// Returns the changed stretches of a text, in order; nothing if equal.
pub(crate) fn difference(before: &str, after: &str) -> Vec<TextChange> {
    let (head, tail) = common_ends(before, after);
    let [middle_a, middle_b]: [Vec<&str>; 2] =
        [before, after].map(|text| text[head..text.len() - tail].split_inclusive('\n').collect());
    let mut kept = common_lines(&middle_a, &middle_b);
    kept.push((middle_a.len(), middle_b.len()));
    let mut changes = Vec::new();
    let mut start = head;
    let (mut i, mut j) = (0, 0);
    for (next_i, next_j) in kept {
        let (old, new) = (&middle_a[i..next_i], &middle_b[j..next_j]);
        if old.len() == new.len() {
            let mut at = start;
            for (x, y) in old.iter().zip(new) {
                changes.extend(stretch(at, x, y));
                at += x.len();
            }
        } else {
            changes.extend(stretch(start, &old.concat(), &new.concat()));
        }
        start += old.iter().map(|line| line.len()).sum::<usize>();
        start += middle_a.get(next_i).map_or(0, |line| line.len());
        (i, j) = (next_i + 1, next_j + 1);
    }
    changes
}

/// Says what an edit of the text did, where all that it did is that things came or went: nothing else that the text
/// says is another.
pub(crate) fn label_of_text(before: &State, after: &State) -> String {
    /// Returns the names of things that one document has and another has not, in order.
    fn beyond(state: &State, other: &State) -> Vec<String> {
        let [own, others] = [state, other].map(|state| {
            let document = &state.lowered.document;
            &document.classes[document.root].parts
        });
        // most of them stand where they stood
        let is_same = |(a, b): &(&Part, &Part)| a.name == b.name;
        let head = own.iter().zip(others).take_while(is_same).count();
        let (own, others) = (&own[head..], &others[head..]);
        let tail = own.iter().rev().zip(others.iter().rev()).take_while(is_same).count();
        let (own, others) = (&own[..own.len() - tail], &others[..others.len() - tail]);
        let known: BTreeSet<&base::Name> = others.iter().map(|part| &part.name).collect();
        let names = own.iter().map(|part| &part.name);
        names.filter(|name| !known.contains(name)).map(ToString::to_string).collect()
    }
    let (gone, come) = (beyond(before, after), beyond(after, before));
    match (gone.as_slice(), come.as_slice()) {
        ([], [_, ..]) if says_all_of(&after.text, &before.text) => {
            format!("add {}", words::listed(&come))
        }
        ([_, ..], []) if says_all_of(&before.text, &after.text) => {
            format!("delete {}", words::listed(&gone))
        }
        _ => "edit text".into(),
    }
}

/// Returns true for a text with every member of another, in the same order. Cost: linear in their lengths.
fn says_all_of(text: &str, other: &str) -> bool {
    let members = |text: &str| -> Vec<String> {
        let file = syntax::parse(base::FileId(0), text).file();
        file.members().map(|member| member.syntax().text().to_string().trim().into()).collect()
    };
    let said = members(text);
    let mut said = said.iter();
    members(other).iter().all(|member| said.any(|one| one == member))
}

/// So many bytes are compared at once.
const BLOCK: usize = 256;

/// Returns how many bytes two texts have in common at the beginning.
fn common_beginning(a: &[u8], b: &[u8]) -> usize {
    let blocks = a.chunks_exact(BLOCK).zip(b.chunks_exact(BLOCK));
    let same = BLOCK * blocks.take_while(|(x, y)| x == y).count();
    same + a[same..].iter().zip(&b[same..]).take_while(|(x, y)| x == y).count()
}

/// Returns how many bytes two texts have in common at the end.
fn common_end(a: &[u8], b: &[u8]) -> usize {
    let blocks = a.rchunks_exact(BLOCK).zip(b.rchunks_exact(BLOCK));
    let same = BLOCK * blocks.take_while(|(x, y)| x == y).count();
    let rest = a[..a.len() - same].iter().rev().zip(b[..b.len() - same].iter().rev());
    same + rest.take_while(|(x, y)| x == y).count()
}

/// Returns how many bytes two texts have in common in whole lines, at the beginning and at the end.
fn common_ends(a: &str, b: &str) -> (usize, usize) {
    let most = a.len().min(b.len());
    let same = common_beginning(a.as_bytes(), b.as_bytes());
    let line = |bytes: &[u8]| bytes.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
    let head = if a == b { same } else { line(&a.as_bytes()[..same]) };
    let tail = common_end(
        &a.as_bytes()[a.len() - (most - head)..],
        &b.as_bytes()[b.len() - (most - head)..],
    );
    let begins_line = |text: &str| {
        let at = text.len() - tail;
        at == head || text.as_bytes()[at - 1] == b'\n'
    };
    if begins_line(a) && begins_line(b) {
        return (head, tail);
    }
    let ends = &a.as_bytes()[a.len() - tail..];
    (head, ends.iter().position(|&b| b == b'\n').map_or(0, |i| tail - i - 1))
}

/// Returns what differs between two pieces of text, the first of which begins at `start`.
fn stretch(start: usize, before: &str, after: &str) -> Option<TextChange> {
    if before == after {
        return None;
    }
    let mut head = before.bytes().zip(after.bytes()).take_while(|(a, b)| a == b).count();
    while !before.is_char_boundary(head) || !after.is_char_boundary(head) {
        head -= 1;
    }
    let most = before.len().min(after.len()) - head;
    let tail = before.bytes().rev().zip(after.bytes().rev()).take(most);
    let mut end = tail.take_while(|(a, b)| a == b).count();
    while !before.is_char_boundary(before.len() - end) || !after.is_char_boundary(after.len() - end)
    {
        end -= 1;
    }
    Some(TextChange {
        start: (start + head) as u32,
        end: (start + before.len() - end) as u32,
        insert: after[head..after.len() - end].to_string(),
    })
}

/// Returns the places of lines that two lists have in common, as many as there are, in order; none if
/// too many differ.
fn common_lines(a: &[&str], b: &[&str]) -> Vec<(usize, usize)> {
    if a.len() == b.len() {
        // what is written back changes lines and adds none
        let same: Vec<_> = (0..a.len()).filter(|&i| a[i] == b[i]).map(|i| (i, i)).collect();
        if 2 * same.len() >= a.len() {
            return same;
        }
    }
    // for every number of changes, how far along `a` each diagonal has been followed
    let most = (a.len() + b.len()).min(MOST_LINES);
    let middle = most + 1;
    let mut reach = vec![0usize; 2 * middle + 1];
    let mut rounds: Vec<Vec<usize>> = Vec::new();
    for changes in 0..=most {
        rounds.push(reach.clone());
        for k in (0..=2 * changes).step_by(2) {
            let diagonal = middle + k - changes;
            let down = k == 0 || k < 2 * changes && reach[diagonal - 1] < reach[diagonal + 1];
            let mut x = if down { reach[diagonal + 1] } else { reach[diagonal - 1] + 1 };
            let Some(mut y) = (x + middle).checked_sub(diagonal) else { continue };
            while x < a.len() && y < b.len() && a[x] == b[y] {
                (x, y) = (x + 1, y + 1);
            }
            reach[diagonal] = x;
            if x >= a.len() && y >= b.len() {
                return walked_back(a.len(), b.len(), middle, &rounds);
            }
        }
    }
    Vec::new()
}

/// Follows the fewest changes from the ends of two lists back to their beginnings.
fn walked_back(a: usize, b: usize, middle: usize, rounds: &[Vec<usize>]) -> Vec<(usize, usize)> {
    let mut common = Vec::new();
    let (mut x, mut y) = (a, b);
    for (changes, reach) in rounds.iter().enumerate().rev() {
        let diagonal = middle + x - y;
        let k = diagonal + changes - middle;
        let down = k == 0 || k < 2 * changes && reach[diagonal - 1] < reach[diagonal + 1];
        let from = if down { diagonal + 1 } else { diagonal - 1 };
        let (from_x, from_y) = match changes {
            0 => (0, 0),
            _ => (reach[from], reach[from] + middle - from),
        };
        while x > from_x && y > from_y {
            (x, y) = (x - 1, y - 1);
            common.push((x, y));
        }
        (x, y) = (from_x, from_y);
    }
    common.reverse();
    common
}

#[cfg(test)]
mod tests {
    use super::*;

    fn applied(text: &str, changes: &[TextChange]) -> String {
        let (mut out, mut from) = (String::new(), 0);
        for c in changes {
            out.push_str(&text[from..c.start as usize]);
            out.push_str(&c.insert);
            from = c.end as usize;
        }
        out + &text[from..]
    }

    #[test]
    fn the_difference_of_lines_is_one_stretch() {
        let d = difference("a = 10  // ten", "a = 12  // ten");
        assert_eq!(d, [TextChange { start: 5, end: 6, insert: "2".into() }]);
        assert_eq!(difference("same", "same"), []);
    }
    #[test]
    fn the_difference_never_splits_a_letter() {
        let d = difference("x = \"é\"", "x = \"è\"");
        assert_eq!(d, [TextChange { start: 5, end: 7, insert: "è".into() }]);
    }
    #[test]
    fn distant_lines_are_stretches_of_their_own() {
        let d = difference("a = 1\nb = 2\nc = 3\n", "a = 7\nb = 2\nc = 9\n");
        assert_eq!(
            d,
            [
                TextChange { start: 4, end: 5, insert: "7".into() },
                TextChange { start: 16, end: 17, insert: "9".into() },
            ]
        );
    }
    #[test]
    fn lines_that_come_and_go_leave_the_others_alone() {
        let (before, after) = ("a\nb\nc\nd\ne\n", "x\na\nc\nd\ny\nz\ne\n");
        let d = difference(before, after);
        assert_eq!(applied(before, &d), after);
        let replaced: u32 = d.iter().map(|c| c.end - c.start).sum();
        let inserted: usize = d.iter().map(|c| c.insert.len()).sum();
        assert_eq!((replaced, inserted), (2, 6));
    }
    #[test]
    fn one_letter_of_a_long_text_is_one_stretch_wherever_it_stands() {
        let before = "abcdefg\n".repeat(2 * BLOCK / 8 + 5);
        for at in (0..before.len()).filter(|at| at % 8 != 7) {
            let mut after = before.clone();
            after.replace_range(at..=at, "x");
            let change =
                TextChange { start: at as u32, end: at as u32 + 1, insert: String::from("x") };
            assert_eq!(difference(&before, &after), [change]);
        }
    }
    #[test]
    fn any_two_texts_differ_by_their_difference() {
        // a few letters in every order, so that lines repeat and move
        let mut seed = 7u32;
        let mut next = |n: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 16) % n
        };
        for _ in 0..2000 {
            let mut text = || {
                let n = next(9);
                (0..n).map(|_| ["a\n", "b\n", "\n", "é", "c"][next(5) as usize]).collect::<String>()
            };
            let (before, after) = (text(), text());
            assert_eq!(applied(&before, &difference(&before, &after)), after, "{before:?}");
        }
    }
}
