//! Edits: what is different between two texts, line by line.

use std::ops::Range;

/// Bytes of a text that stand in the place of others.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Edit {
    pub(super) before: Range<usize>,
    pub(super) after: Range<usize>,
}

/// How many bytes are compared at once.
const BYTES: usize = 64;

/// From so many edits on, all that follows is one.
const MANY: usize = 64;

/// How many lines may be taken away and inserted in one place, so that what follows is found again.
const LINES: usize = 12;

/// How many bytes have to be alike for what follows to be found.
const ALIKE: usize = 192;

/// Returns what has to be replaced in a text to make another of it, in order.
pub(super) fn edits(before: &[u8], after: &[u8]) -> Vec<Edit> {
    let mut edits = Vec::new();
    let (mut a, mut b) = (0, 0);
    loop {
        let same = common_head(&before[a..], &after[b..]);
        if a + same == before.len() && b + same == after.len() {
            return edits;
        }
        // whole lines: what follows a line may be the same as what follows another
        let line = before[a..a + same].iter().rposition(|&byte| byte == b'\n').map_or(0, |i| i + 1);
        (a, b) = (a + line, b + line);
        let (ours, others) = (&before[a..], &after[b..]);
        let met = (edits.len() < MANY).then(|| meets_again(ours, others)).flatten();
        let (gone, new) = met.unwrap_or_else(|| {
            let tail = common_tail(ours, others);
            (ours.len() - tail, others.len() - tail)
        });
        edits.push(Edit { before: a..a + gone, after: b..b + new });
        (a, b) = (a + gone, b + new);
    }
}

/// Returns how many bytes of two texts stand before what they have in common again, from the beginning of a
/// line on, where that is near.
fn meets_again(before: &[u8], after: &[u8]) -> Option<(usize, usize)> {
    let lines = |text: &[u8]| -> Vec<usize> {
        let ends = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        std::iter::once(0).chain(ends.map(|(i, _)| i + 1)).take(LINES).collect()
    };
    let (gone, new) = (lines(before), lines(after));
    let near = (1..gone.len() + new.len()).flat_map(|both| (0..=both).map(move |i| (i, both - i)));
    let mut starts = near.filter_map(|(i, j)| Some((*gone.get(i)?, *new.get(j)?)));
    let head = |text: &[u8]| text.len().min(ALIKE);
    starts.find(|&(i, j)| {
        let (a, b) = (&before[i..], &after[j..]);
        a[..head(a)] == b[..head(b)]
    })
}

fn common_head(a: &[u8], b: &[u8]) -> usize {
    let same = a.chunks(BYTES).zip(b.chunks(BYTES)).take_while(|(a, b)| a == b).count() * BYTES;
    let same = same.min(a.len()).min(b.len());
    same + a[same..].iter().zip(&b[same..]).take_while(|(a, b)| a == b).count()
}

fn common_tail(a: &[u8], b: &[u8]) -> usize {
    let same = a.rchunks(BYTES).zip(b.rchunks(BYTES)).take_while(|(a, b)| a == b).count() * BYTES;
    let same = same.min(a.len()).min(b.len());
    let (a, b) = (&a[..a.len() - same], &b[..b.len() - same]);
    same + a.iter().rev().zip(b.iter().rev()).take_while(|(a, b)| a == b).count()
}
