//! Parsing again: a tree and an edited text in, the tree of the text out, and which members are other ones.
//!
//! Lines that both texts have keep their nodes. Where some were changed, inserted or taken away, the members
//! there are parsed alone, with two of their neighbours on either side, since a member may look at what
//! follows it. Where the neighbours behind come out as they were, every bracket, comment and text before
//! them ended there, and what follows is what it was. Anything else is parsed as a whole.

mod edits;

use crate::grammar::{self, Scope};
use crate::kind::SyntaxKind;
use crate::tree::{Parse, parse, parse_with};
use base::{Diagnostic, FileId};
use edits::{Edit, edits};
use rowan::{GreenNode, GreenNodeData, GreenToken, NodeOrToken};
use std::ops::Range;

/// How many members on either side are parsed with those between them.
const NEIGHBOURS: usize = 2;

/// A text parsed again.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Reparsed {
    /// The tree of the text.
    pub parse: Parse,
    /// Which members at the top are not those of the text before, in order. All others have the nodes that
    /// they had, and so has what stands between them.
    pub changed: Vec<Changed>,
}

/// Members at the top of a text that stand in the place of others.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Changed {
    /// The numbers of the members that were there.
    pub before: Range<usize>,
    /// The numbers of those in their place.
    pub after: Range<usize>,
    /// How many bytes what follows has moved, up to the next change.
    pub shift: i64,
}

/// Parses a document whose text was `before` when `known` was made. The tree is that which [`parse`] gives.
///
/// # Panics
/// If the text is longer than 4 GiB.
///
/// Cost: that of comparing the texts and of the members that changed.
pub fn reparse(file: FileId, known: &Parse, before: &str, text: &str) -> Reparsed {
    let green = known.green();
    let is_right = known.diagnostics().is_empty() && !before.is_empty();
    let made = is_right.then(|| pieces_parsed(file, green, before, text)).flatten();
    let (pieces, diagnostics) = made.unwrap_or_else(|| {
        let whole = parse(file, text);
        let pieces = vec![Made { children: 0..green.children().len(), now: elements(&whole) }];
        (pieces, whole.diagnostics().to_vec())
    });
    spliced(green, pieces, diagnostics)
}

/// A node or token of the file.
type Element = NodeOrToken<GreenNode, GreenToken>;

/// A piece of the file's children: their indices, and their bytes in the text before.
struct Piece {
    children: Range<usize>,
    bytes: Range<usize>,
    /// How many bytes longer it is now.
    growth: isize,
}

/// What is in the place of some of the file's children.
struct Made {
    children: Range<usize>,
    now: Vec<Element>,
}

/// Parses what edits may reach; nothing where more than that may come out as another tree.
fn pieces_parsed(
    file: FileId,
    green: &GreenNodeData,
    before: &str,
    text: &str,
) -> Option<(Vec<Made>, Vec<Diagnostic>)> {
    let (mut made, mut diagnostics) = (Vec::new(), Vec::new());
    let mut shift = 0;
    for Piece { children, bytes, growth } in
        pieces(green, &edits(before.as_bytes(), text.as_bytes()))
    {
        let start = bytes.start.checked_add_signed(shift)?;
        shift += growth;
        let part = text.get(start..bytes.end.checked_add_signed(shift)?)?;
        let parse = parse_with(file, part, |p| grammar::file(p, Scope::Thing));
        let was = green.children().take(children.end).rev().filter_map(NodeOrToken::into_node);
        let now = parse.green().children().rev().filter_map(NodeOrToken::into_node);
        let same = now.zip(was).take(NEIGHBOURS).filter(|(a, b)| a == b).count();
        // where a brace is open, how far the lines around it are indented counts
        let is_open = parse.diagnostics().iter().any(|d| d.code == "expected-brace");
        if is_open || bytes.end < before.len() && same < NEIGHBOURS {
            return None;
        }
        diagnostics.extend(parse.diagnostics().iter().map(|d| d.clone().moved(start as u32)));
        made.push(Made { children, now: elements(&parse) });
    }
    Some((made, diagnostics))
}

fn elements(parse: &Parse) -> Vec<Element> {
    parse.green().children().map(NodeOrToken::to_owned).collect()
}

/// Finds the children that edits may reach: from the beginning of a member that begins a line to the end
/// of one that ends a line, or to the end of the file.
fn pieces(green: &GreenNodeData, edits: &[Edit]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut edits = edits.iter().peekable();
    // members that begin a line, behind the last piece: index and first byte
    let mut starts: Vec<(usize, usize)> = Vec::new();
    // the piece that is open, where its last edit ends, and how many of its members stand behind that
    let mut open: Option<(Piece, usize, usize)> = None;
    let (mut at, mut is_line) = (0, true);
    for (index, child) in green.children().enumerate() {
        let end = at + usize::from(child.text_len());
        let is_node = child.as_node().is_some();
        let ends_line = child.as_token().is_some_and(|token| {
            let is_space = token.kind() == rowan::SyntaxKind::from(SyntaxKind::Whitespace);
            is_space && token.text().contains('\n')
        });
        if ends_line && let Some((piece, _, _)) = open.take_if(|o| o.2 >= NEIGHBOURS) {
            pieces.push(piece.up_to(index, at));
            starts.clear();
        }
        while let Some(edit) = edits.next_if(|e| e.before.start <= end) {
            let (mut piece, _, _) =
                open.take().unwrap_or_else(|| (begun(&mut pieces, &starts), 0, 0));
            piece.growth += edit.after.len() as isize - edit.before.len() as isize;
            open = Some((piece, edit.before.end, 0));
        }
        match &mut open {
            // strictly behind the edit: what stands before it is its own
            Some((_, edited, behind)) => *behind += usize::from(is_node && at > *edited),
            None if is_node && is_line => starts.push((index, at)),
            None => {}
        }
        is_line = ends_line;
        at = end;
    }
    pieces.extend(open.map(|(piece, _, _)| piece.up_to(green.children().len(), at)));
    pieces
}

/// Begins a piece a few members before what is next; where the last piece has ended just now, it goes on.
fn begun(pieces: &mut Vec<Piece>, starts: &[(usize, usize)]) -> Piece {
    let begins = |(index, at)| Piece { children: index..index, bytes: at..at, growth: 0 };
    match starts.len().checked_sub(NEIGHBOURS) {
        Some(first) => begins(starts[first]),
        None => pieces.pop().unwrap_or_else(|| begins((0, 0))),
    }
}

impl Piece {
    fn up_to(self, index: usize, at: usize) -> Self {
        let (children, bytes) = (self.children.start..index, self.bytes.start..at);
        Self { children, bytes, ..self }
    }
}

/// Puts what was made in its place. What comes out as it was keeps its nodes.
fn spliced(green: &GreenNodeData, made: Vec<Made>, diagnostics: Vec<Diagnostic>) -> Reparsed {
    let mut was = green.children().map(NodeOrToken::to_owned);
    let mut children: Vec<Element> = Vec::with_capacity(was.len());
    let (mut changed, mut shift, mut before, mut after) = (Vec::new(), 0, 0, 0);
    let mut seen = 0;
    for Made { children: place, now } in made {
        let kept = was.by_ref().take(place.start - seen);
        let from = children.len();
        children.extend(kept);
        let gone: Vec<Element> = was.by_ref().take(place.len()).collect();
        seen = place.end;
        let head = now.iter().zip(&gone).take_while(|(a, b)| a == b).count();
        let rest = now[head..].iter().rev().zip(gone[head..].iter().rev());
        let tail = rest.take_while(|(a, b)| a == b).count();
        let (new, old) = (&now[head..now.len() - tail], &gone[head..gone.len() - tail]);
        children.extend_from_slice(&gone[..head]);
        let same = members(&children[from..]);
        (before, after) = (before + same, after + same);
        if !(new.is_empty() && old.is_empty()) {
            shift += length(new) - length(old);
            let (before, after) = (before..before + members(old), after..after + members(new));
            changed.push(Changed { before, after, shift });
        }
        let same = members(&gone[gone.len() - tail..]);
        (before, after) = (before + members(old) + same, after + members(new) + same);
        children.extend_from_slice(new);
        children.extend_from_slice(&gone[gone.len() - tail..]);
    }
    children.extend(was);
    let parse = Parse::of(GreenNode::new(green.kind(), children), diagnostics);
    Reparsed { parse, changed }
}

fn members(elements: &[Element]) -> usize {
    elements.iter().filter(|e| e.as_node().is_some()).count()
}

fn length(elements: &[Element]) -> i64 {
    let each = elements.iter().map(|e| match e {
        NodeOrToken::Node(node) => node.text_len(),
        NodeOrToken::Token(token) => token.text_len(),
    });
    each.map(|length| i64::from(u32::from(length))).sum()
}
