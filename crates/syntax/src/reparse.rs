//! Parsing again: a tree and an edited text in, the tree of the text out.
//!
//! The lines that both texts have at their beginning and end keep their nodes; the members between
//! them are parsed alone, with two of their neighbours on either side, since a member may look at
//! what follows it. Where the neighbours behind come out as they were, every bracket, comment and text
//! before them ended there, and what follows is what it was. Where lines far apart were changed, the first
//! is parsed first, and then the rest. Anything else is parsed as a whole.

use crate::grammar::{self, Scope};
use crate::kind::SyntaxKind;
use crate::tree::{Parse, parse, parse_with};
use base::FileId;
use rowan::NodeOrToken;

/// How many members on either side are parsed with those between them.
const NEIGHBOURS: usize = 2;

/// Parses a document whose text was `before` when `known` was made. Gives what [`parse`] gives.
///
/// # Panics
/// If the text is longer than 4 GiB.
///
/// Cost: that of comparing the texts and of the members that changed.
pub fn reparse(file: FileId, known: &Parse, before: &str, text: &str) -> Parse {
    let in_two = first_line_alone(before, text).and_then(|between| {
        let half = spliced(file, known, before, &between)?;
        spliced(file, &half, &between, text)
    });
    let made = in_two.or_else(|| spliced(file, known, before, text));
    made.unwrap_or_else(|| parse(file, text))
}

/// Where a text was changed far apart, returns it with the first line that was changed, and no other.
fn first_line_alone(before: &str, text: &str) -> Option<String> {
    /// From so many bytes between the first and the last change on.
    const FAR: usize = 4096;
    let head = common_head(before.as_bytes(), text.as_bytes());
    let tail = common_tail(&before.as_bytes()[head..], &text.as_bytes()[head..]);
    if before.len() - head - tail < FAR || text.len() - head - tail < FAR {
        return None;
    }
    let line_end = |of: &str| Some(head + of.as_bytes()[head..].iter().position(|b| *b == b'\n')?);
    Some([text.get(..line_end(text)?)?, before.get(line_end(before)?..)?].concat())
}

/// A piece of the file's children: their indices, and their bytes in the text before.
struct Piece {
    children: std::ops::Range<usize>,
    bytes: std::ops::Range<usize>,
}

fn spliced(file: FileId, known: &Parse, before: &str, text: &str) -> Option<Parse> {
    if !known.diagnostics().is_empty() {
        return None;
    }
    let head = common_head(before.as_bytes(), text.as_bytes());
    let tail = common_tail(&before.as_bytes()[head..], &text.as_bytes()[head..]);
    let piece = piece(known, head, before.len() - tail)?;
    let end = piece.bytes.end + text.len() - before.len();
    let part = text.get(piece.bytes.start..end)?;
    let made = parse_with(file, part, |p| grammar::file(p, Scope::Thing));
    let green = known.green();
    let was = green.children().take(piece.children.end).rev().filter_map(NodeOrToken::into_node);
    let now = made.green().children().rev().filter_map(NodeOrToken::into_node);
    let same = now.zip(was).take(NEIGHBOURS).filter(|(a, b)| a == b).count();
    let is_last = piece.bytes.end == before.len();
    if !is_last && same < NEIGHBOURS {
        return None;
    }
    let children = made.green().children().map(|c| match c {
        NodeOrToken::Node(node) => NodeOrToken::Node(node.to_owned()),
        NodeOrToken::Token(token) => NodeOrToken::Token(token.to_owned()),
    });
    let start = piece.bytes.start as u32;
    let diagnostics = made.diagnostics().iter().map(|d| d.clone().moved(start)).collect();
    Some(Parse::of(green.splice_children(piece.children, children), diagnostics))
}

/// How many bytes are compared at once.
const BYTES: usize = 64;

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

/// Finds the children that a change of the bytes from `from` to `to` may reach: from the beginning of
/// a member that begins a line to the end of one that ends a line, or to the end of the file.
fn piece(known: &Parse, from: usize, to: usize) -> Option<Piece> {
    let green = known.green();
    // members that begin a line before the change: index and first byte
    let mut starts: Vec<(usize, usize)> = Vec::new();
    let mut after = 0;
    let (mut at, mut is_line) = (0, true);
    let mut end = None;
    for (index, child) in green.children().enumerate() {
        let length = usize::from(child.text_len());
        let node = match &child {
            NodeOrToken::Node(_) => true,
            NodeOrToken::Token(token) => {
                let is_space = token.kind() == rowan::SyntaxKind::from(SyntaxKind::Whitespace);
                let ends_line = is_space && token.text().contains('\n');
                if ends_line && after >= NEIGHBOURS {
                    end = Some((index, at));
                    break;
                }
                is_line = ends_line;
                false
            }
        };
        if node {
            if is_line && at + length < from {
                starts.push((index, at));
            }
            is_line = false;
            // strictly behind the change: what stands before it is its own
            after += usize::from(at > to);
        }
        at += length;
    }
    let (first, start) = match starts.len().checked_sub(NEIGHBOURS) {
        Some(index) => *starts.get(index)?,
        None => (0, 0),
    };
    let (last, end) = end.unwrap_or((green.children().len(), at));
    Some(Piece { children: first..last, bytes: start..end })
}
