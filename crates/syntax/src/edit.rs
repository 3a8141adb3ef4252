//! Small edits of a text, found on its tree: all else is kept byte for byte.
//!
//! An edit is a list of [`TextEdit`]s in terms of the text that the tree was made of; [`apply`] makes
//! the new text. Members come with their doc comments; a body keeps its layout, in one line or many.

use crate::ast::{AstNode, Body, Class, Part};
use crate::format::INDENT;
use crate::kind::{SyntaxKind, SyntaxNode, SyntaxToken};
use crate::lexer::lex;
use crate::tree::{span_of, span_of_token};
use crate::units::unit_length;
use base::Span;
use rowan::Direction;

/// A replacement of some bytes of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TextEdit {
    /// The bytes that go.
    pub span: Span,
    /// What comes in their place.
    pub insert: String,
}

impl TextEdit {
    fn new(start: u32, end: u32, insert: impl Into<String>) -> Self {
        Self { span: Span::new(start, end), insert: insert.into() }
    }
}

/// Where a new member goes.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Spot {
    /// Before a member.
    Before(SyntaxNode),
    /// After a member.
    After(SyntaxNode),
    /// At the end of a file or a body, or of the body of a part, class or program, which is opened
    /// where there is none.
    EndOf(SyntaxNode),
}

/// Makes the text that edits turn `text` into. Insertions at one place come in the order of the list;
/// edits that overlap are [`joined`].
///
/// # Panics
/// If an edit lies outside the text or inside a character.
pub fn apply(text: &str, edits: &[TextEdit]) -> String {
    let mut sorted = edits.to_vec();
    sorted.sort_by_key(|edit| edit.span);
    if sorted.windows(2).any(|two| two[1].span.start < two[0].span.end) {
        sorted = joined(text, sorted);
    }
    let mut out = String::with_capacity(text.len() + 64);
    let mut at = 0;
    for edit in &sorted {
        let range = edit.span.range();
        out += &text[at..range.start];
        out += &edit.insert;
        at = range.end;
    }
    out + &text[at..]
}

/// Joins edits that overlap, so that none of them does any more: deletions of neighbours on one line are
/// one, and what is said where something else goes is said in its place. The edits come in the order of the text.
pub fn joined(text: &str, mut edits: Vec<TextEdit>) -> Vec<TextEdit> {
    edits.sort_by_key(|e| (e.span.start, std::cmp::Reverse(e.span.end)));
    let mut joined: Vec<TextEdit> = Vec::new();
    for edit in edits {
        let overlaps = |last: &&mut TextEdit| edit.span.start < last.span.end;
        let Some(last) = joined.last_mut().filter(overlaps) else {
            joined.push(edit);
            continue;
        };
        let says = |e: &TextEdit| !e.insert.trim().is_empty();
        match (says(last), says(&edit)) {
            // what is said where something else goes is divided from its neighbours as that was
            (false, true) => {
                let between =
                    |from: u32, to: u32| text.get(from as usize..to as usize).unwrap_or_default();
                let behind = between(edit.span.end, last.span.end);
                let divides = behind.chars().all(|c| c == ';' || c.is_whitespace());
                let begins = between(0, last.span.start).chars().last();
                last.insert = match begins.is_none_or(char::is_whitespace) {
                    true => edit.insert.trim_start().to_string(),
                    false => edit.insert,
                };
                last.insert.push_str(if divides { behind } else { "" });
            }
            (true, true) if *last == edit => {}
            (true, true) => last.insert.push_str(&edit.insert),
            (false, false) if edit.span.end > last.span.end => {
                let before = text.get(..last.span.start as usize);
                let divided = before.is_some_and(|b| b.ends_with(char::is_whitespace));
                last.insert = if divided { String::new() } else { edit.insert };
            }
            (_, false) => {}
        }
        last.span = last.span.join(edit.span);
    }
    joined
}

/// Replaces a node, doc comments included, by a text.
pub fn replace(node: &SyntaxNode, text: &str) -> TextEdit {
    let span = span_of(node);
    let next = node.last_token().and_then(|t| next_on_line(&t));
    let divider = if next.is_some_and(|t| reads_as_unit(text, &t)) { ";" } else { "" };
    TextEdit::new(span.start, span.end, format!("{text}{divider}"))
}

/// Replaces a member by others, one a line, which begin where it began.
pub fn replace_member(node: &SyntaxNode, members: &str) -> TextEdit {
    let first = node.first_token();
    let indent = first.map_or_else(String::new, |t| indent_of(&line_start(&t)));
    replace(node, &indented(members, &indent))
}

/// Replaces a token: a name by another.
pub fn rename(token: &SyntaxToken, name: &str) -> TextEdit {
    let span = span_of_token(token);
    TextEdit::new(span.start, span.end, name)
}

/// Gives a part a value after `=`, in place of the one it has.
pub fn give_value(part: &Part, text: &str) -> Option<TextEdit> {
    if let Some(value) = part.value() {
        return Some(replace(value.syntax(), text));
    }
    let class = part.class()?;
    let domain = part.domain();
    let last = domain.as_ref().map_or(class.syntax(), AstNode::syntax).last_token()?;
    let divider =
        if next_on_line(&last).is_some_and(|t| reads_as_unit(text, &t)) { ";" } else { "" };
    let end = span_of_token(&last).end;
    Some(TextEdit::new(end, end, format!(" = {text}{divider}")))
}

/// Puts a new member, without indentation, where `spot` says.
pub fn insert_member(spot: &Spot, member: &str) -> TextEdit {
    match spot {
        Spot::Before(node) => insert_before(node, member),
        Spot::After(node) => insert_after(node, member),
        Spot::EndOf(node) if node.kind() == SyntaxKind::File => insert_in_file(node, member),
        Spot::EndOf(node) if node.kind() == SyntaxKind::Body => insert_in_body(node, member),
        Spot::EndOf(node) => match node.children().find_map(Body::cast) {
            Some(body) => insert_in_body(body.syntax(), member),
            None => {
                let end = span_of(node).end;
                TextEdit::new(end, end, format!(" {{ {member} }}"))
            }
        },
    }
}

fn insert_before(node: &SyntaxNode, member: &str) -> TextEdit {
    let start = span_of(node).start;
    let Some(first) = node.first_token() else { return TextEdit::new(start, start, member) };
    if begins_line(&first) {
        let indent = indent_of(&first);
        let lines = indented(member, &indent);
        return TextEdit::new(start, start, format!("{lines}\n{indent}"));
    }
    let divider = if reads_as_unit(member, &first) { "; " } else { "  " };
    TextEdit::new(start, start, format!("{member}{divider}"))
}

fn insert_after(node: &SyntaxNode, member: &str) -> TextEdit {
    let (Some(first), Some(last)) = (node.first_token(), node.last_token()) else {
        let end = span_of(node).end;
        return TextEdit::new(end, end, member);
    };
    let next = next_on_line(&last).filter(|t| t.kind() != SyntaxKind::RBrace);
    let ends_line = next
        .as_ref()
        .is_none_or(|t| t.kind() == SyntaxKind::Semicolon && next_on_line(t).is_none());
    if begins_line(&first) && ends_line {
        let at = span_of_token(&line_end(&last)).end;
        let indent = indent_of(&first);
        return TextEdit::new(at, at, format!("\n{indent}{}", indented(member, &indent)));
    }
    let at = span_of(node).end;
    let before = if reads_as_unit_text(&last, member) { "; " } else { "  " };
    let after = if next.is_some_and(|t| reads_as_unit(member, &t)) { ";" } else { "" };
    TextEdit::new(at, at, format!("{before}{member}{after}"))
}

fn insert_in_file(file: &SyntaxNode, member: &str) -> TextEdit {
    let end = span_of(file).end;
    match file.last_token().and_then(|t| solid(Some(t), Direction::Prev)) {
        None => TextEdit::new(end, end, format!("{member}\n")),
        Some(last) => {
            let at = span_of_token(&last).end;
            let close = if at == end { "\n" } else { "" };
            TextEdit::new(at, at, format!("\n{member}{close}"))
        }
    }
}

fn insert_in_body(body: &SyntaxNode, member: &str) -> TextEdit {
    let open = body.first_token();
    let closing = body.last_token().filter(|t| t.kind() == SyntaxKind::RBrace);
    let last = match &closing {
        Some(brace) => solid(brace.prev_token(), Direction::Prev),
        None => solid(body.last_token(), Direction::Prev),
    };
    let (Some(open), Some(last)) = (open, last) else {
        let end = span_of(body).end;
        return TextEdit::new(end, end, member);
    };
    let at = span_of_token(&last).end;
    let own_line = closing.as_ref().is_some_and(begins_line);
    let last_begins_line =
        body.children().last().and_then(|n| n.first_token()).is_some_and(|t| begins_line(&t));
    if own_line || last_begins_line {
        let hanging = body.children().filter_map(|n| n.first_token()).filter(begins_line).last();
        let indent = hanging.map_or_else(
            || format!("{}{}", indent_of(&line_start(&open)), " ".repeat(INDENT)),
            |first| indent_of(&first),
        );
        return TextEdit::new(at, at, format!("\n{indent}{}", indented(member, &indent)));
    }
    if last == open {
        let end = closing.map_or(at, |brace| span_of_token(&brace).start);
        return TextEdit::new(at, end, format!(" {member} "));
    }
    let divider = if reads_as_unit_text(&last, member) { "; " } else { "  " };
    TextEdit::new(at, at, format!("{divider}{member}"))
}

/// Takes a member away: with its lines, its doc comment and the comment at its end, where it has
/// lines of its own; else with the space or `;` that divides it from its neighbours.
pub fn delete_member(node: &SyntaxNode) -> TextEdit {
    let span = span_of(node);
    let (Some(first), Some(last)) = (node.first_token(), node.last_token()) else {
        return TextEdit::new(span.start, span.end, "");
    };
    let next = next_on_line(&last);
    if begins_line(&first) && next.is_none() {
        let start = span.start - indent_of(&first).len() as u32;
        let end = line_end(&last);
        let after = end.next_token().map_or(span_of_token(&end).end, |space| {
            let text = space.text();
            let line = text.find('\n').map_or(text.len(), |n| n + 1);
            span_of_token(&space).start + line as u32
        });
        return TextEdit::new(start, after, "");
    }
    let previous = solid(first.prev_token(), Direction::Prev);
    let next = match next {
        Some(t) if t.kind() == SyntaxKind::Semicolon => next_on_line(&t).or(Some(t)),
        other => other,
    };
    match (previous, next) {
        (_, Some(next)) if next.kind() == SyntaxKind::Semicolon => {
            TextEdit::new(span.start, span_of_token(&next).end, "")
        }
        (Some(previous), Some(next)) if next.kind() == SyntaxKind::RBrace => {
            TextEdit::new(span_of_token(&previous).end, span_of_token(&next).start, " ")
        }
        (Some(previous), Some(next)) if reads_as_unit(previous.text(), &next) => {
            TextEdit::new(span_of_token(&previous).end, span_of_token(&next).start, "; ")
        }
        (_, Some(next)) => TextEdit::new(span.start, span_of_token(&next).start, ""),
        (Some(previous), None) => TextEdit::new(span_of_token(&previous).end, span.end, ""),
        (None, None) => TextEdit::new(span.start, span.end, ""),
    }
}

/// Takes several members away, in the order of the text. Neighbours go as one.
pub fn delete_members(nodes: &[SyntaxNode]) -> Vec<TextEdit> {
    let mut edits: Vec<TextEdit> = Vec::new();
    // where what stands before the neighbours ends
    let mut begin = 0;
    for (n, node) in nodes.iter().enumerate() {
        let edit = delete_member(node);
        let neighbour = n.checked_sub(1).map(|n| &nodes[n]);
        let follows = neighbour.is_some() && node.prev_sibling().as_ref() == neighbour;
        match edits.last_mut().filter(|last| follows && edit.span.start <= last.span.end) {
            Some(last) => {
                let takes_space_before = edit.span.start < last.span.end;
                let start = if takes_space_before { begin } else { last.span.start };
                *last = TextEdit::new(start.min(last.span.start), edit.span.end, &edit.insert);
            }
            None => {
                let before =
                    node.first_token().and_then(|t| solid(t.prev_token(), Direction::Prev));
                begin = before.map_or(edit.span.start, |t| span_of_token(&t).end);
                edits.push(edit);
            }
        }
    }
    edits
}

/// Returns the edit that says something new in the place of what another takes away.
///
/// The layout around stays; `;` stands where something else follows on the line.
pub fn instead(text: &str, gone: &TextEdit, new: &TextEdit) -> TextEdit {
    let was = &text[gone.span.range()];
    let (before, after) = (was.len() - was.trim_start().len(), was.trim_end().len());
    let (before, after) = (&was[..before], &was[after..]);
    let rest = &text[gone.span.end as usize..];
    let is_last = after.contains('\n') || rest.is_empty() || rest.starts_with(['\n', '}']);
    let after = if is_last { after } else { "; " };
    TextEdit { span: gone.span, insert: [before, new.insert.trim(), after].concat() }
}

/// Takes one of several names away from the part or class list that declares it: `x, y: Real`.
///
/// Returns `None` where it is the only one: then the member goes as a whole.
pub fn delete_name(name: &SyntaxToken) -> Option<TextEdit> {
    let comma = |t: &SyntaxToken| t.kind() == SyntaxKind::Comma && t.parent() == name.parent();
    let next = solid(name.next_token(), Direction::Next);
    if let Some(next) = next.filter(comma) {
        let after = solid(next.next_token(), Direction::Next)?;
        return Some(TextEdit::new(span_of_token(name).start, span_of_token(&after).start, ""));
    }
    let previous = solid(name.prev_token(), Direction::Prev).filter(comma)?;
    Some(TextEdit::new(span_of_token(&previous).start, span_of_token(name).end, ""))
}

/// Returns the node that holds the members of `node`: itself, its body, or nothing yet.
pub fn body_of(node: &SyntaxNode) -> Option<SyntaxNode> {
    match node.kind() {
        SyntaxKind::File | SyntaxKind::Body => Some(node.clone()),
        SyntaxKind::Part => Part::cast(node.clone())?.body().map(|b| b.syntax().clone()),
        SyntaxKind::Class => Class::cast(node.clone())?.body().map(|b| b.syntax().clone()),
        _ => node.children().find_map(Body::cast).map(|b| b.syntax().clone()),
    }
}

// ---- lines

/// The first token that is no white space, from `token` on.
fn solid(token: Option<SyntaxToken>, direction: Direction) -> Option<SyntaxToken> {
    let mut at = token;
    while let Some(token) = &at {
        if token.kind() != SyntaxKind::Whitespace {
            break;
        }
        at = match direction {
            Direction::Next => token.next_token(),
            Direction::Prev => token.prev_token(),
        };
    }
    at
}

/// Returns true if only blanks stand before a token on its line.
fn begins_line(token: &SyntaxToken) -> bool {
    match token.prev_token() {
        None => true,
        Some(space) if space.kind() == SyntaxKind::Whitespace => {
            space.text().contains('\n') || space.prev_token().is_none()
        }
        Some(_) => false,
    }
}

/// The blanks before a token that begins its line.
fn indent_of(token: &SyntaxToken) -> String {
    let space = token.prev_token().filter(|t| t.kind() == SyntaxKind::Whitespace);
    space.map_or_else(String::new, |t| t.text().rsplit('\n').next().unwrap_or("").to_owned())
}

/// The token that begins the line of `token`.
fn line_start(token: &SyntaxToken) -> SyntaxToken {
    let mut at = token.clone();
    while !begins_line(&at) {
        match solid(at.prev_token(), Direction::Prev) {
            Some(previous) => at = previous,
            None => break,
        }
    }
    at
}

/// The next token that is no trivia, if it stands on the same line.
fn next_on_line(token: &SyntaxToken) -> Option<SyntaxToken> {
    let mut at = token.next_token();
    while let Some(token) = at {
        if token.text().contains('\n') {
            return None;
        }
        if !token.kind().is_trivia() {
            return Some(token);
        }
        at = token.next_token();
    }
    None
}

/// The last token or comment on the line of `token`, a closing brace after it left out.
fn line_end(token: &SyntaxToken) -> SyntaxToken {
    let mut end = token.clone();
    let mut at = token.next_token();
    while let Some(token) = at {
        if token.text().contains('\n') || token.kind() == SyntaxKind::RBrace {
            break;
        }
        if token.kind() != SyntaxKind::Whitespace {
            end = token.clone();
        }
        at = token.next_token();
    }
    end
}

/// Gives every line of `member` but the first the indentation of the body.
fn indented(member: &str, indent: &str) -> String {
    member.replace('\n', &format!("\n{indent}"))
}

/// Returns true if `next`, after `text` on a line, would be read as the unit of its last number.
fn reads_as_unit(text: &str, next: &SyntaxToken) -> bool {
    let named = solid(next.next_token(), Direction::Next)
        .is_some_and(|t| matches!(t.kind(), SyntaxKind::Colon | SyntaxKind::ColonEq));
    ends_in_number(text) && unit_length(next.text()) > 0 && !named
}

/// Returns true if what `member` begins with, after `last` on a line, would be read as its unit.
fn reads_as_unit_text(last: &SyntaxToken, member: &str) -> bool {
    let unit = unit_length(member);
    last.kind() == SyntaxKind::Number && unit > 0 && !member[unit..].trim_start().starts_with(':')
}

fn ends_in_number(text: &str) -> bool {
    let tokens = lex(text).tokens;
    tokens.iter().rev().nth(1).is_some_and(|t| t.kind == SyntaxKind::Number)
}
