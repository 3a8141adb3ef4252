//! The canonical layout: spaces and indentation are set, lines stay as the author broke them.
//!
//! In comes a tree, out goes a text of the same tokens and comments in the same order and on the same
//! lines, so it means the same; laying it out again changes nothing. What could not be understood
//! keeps its spacing.

use crate::kind::{SyntaxElement, SyntaxKind, SyntaxNode};
use crate::lexer::lex;
use crate::tree::Parse;
use rowan::{NodeOrToken, WalkEvent};

/// How far a level is indented, in spaces.
pub const INDENT: usize = 4;

/// A token or comment with what its spacing depends on.
struct Piece {
    kind: SyntaxKind,
    /// The kind of the node it stands in.
    parent: SyntaxKind,
    text: String,
    /// Line ends before it, at most two.
    newlines: usize,
    /// White space before it.
    spaced: bool,
    /// It begins a member, a statement, a method or a rule.
    starts: bool,
}

/// Lays a text out.
///
/// ```
/// let parse = syntax::parse(base::FileId(0), "class A{x:Real=1\n   y :Real}");
/// assert_eq!(syntax::format(&parse), "class A { x: Real = 1\n    y: Real }\n");
/// ```
///
/// A text with a brace that nothing closes stays as it is: how its lines are indented says where the brace ends.
/// So does a text with another error that would be read otherwise once laid out: there white space decides what is meant.
pub fn format(parse: &Parse) -> String {
    let as_it_is = || parse.text().to_string();
    if parse.diagnostics().is_empty() {
        return lay_out(parse);
    }
    if parse.diagnostics().iter().any(|d| d.code == "expected-brace") {
        return as_it_is();
    }
    let laid_out = lay_out(parse);
    let again = crate::parse(base::FileId(0), &laid_out);
    let reads_alike = pieces(&again.syntax())
        .iter()
        .map(Piece::token)
        .eq(pieces(&parse.syntax()).iter().map(Piece::token));
    if reads_alike && lay_out(&again) == laid_out { laid_out } else { as_it_is() }
}

fn lay_out(parse: &Parse) -> String {
    let pieces = pieces(&parse.syntax());
    let mut layout = Layout::default();
    for i in 0..pieces.len() {
        layout.place(&pieces, i);
    }
    layout.finish()
}

/// Lists tokens and comments in order.
fn pieces(root: &SyntaxNode) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let (mut newlines, mut spaced, mut starts) = (0, false, false);
    for event in root.preorder_with_tokens() {
        match event {
            WalkEvent::Enter(NodeOrToken::Node(node)) => {
                starts |= node.parent().is_some_and(|parent| holds_elements(parent.kind()));
            }
            WalkEvent::Leave(_) => {}
            WalkEvent::Enter(SyntaxElement::Token(token)) => {
                let kind = token.kind();
                if kind == SyntaxKind::Whitespace {
                    newlines += token.text().bytes().filter(|b| *b == b'\n').count();
                    spaced = true;
                    continue;
                }
                let parent = token.parent().map_or(SyntaxKind::File, |node| node.kind());
                let text = token.text();
                let text = if kind.is_comment() { text.trim_end() } else { text }.to_owned();
                pieces.push(Piece {
                    kind,
                    parent,
                    text,
                    newlines: newlines.min(2),
                    spaced,
                    starts,
                });
                (newlines, spaced) = (0, false);
                starts &= kind.is_trivia();
            }
        }
    }
    // A comment stands where what follows it stands.
    let mut next_starts = true;
    for piece in pieces.iter_mut().rev() {
        if piece.kind.is_trivia() {
            piece.starts |= next_starts;
        } else {
            next_starts = piece.starts || piece.kind == SyntaxKind::RBrace;
        }
    }
    pieces
}

impl Piece {
    fn token(&self) -> (SyntaxKind, &str) {
        (self.kind, &self.text)
    }
}

fn holds_elements(kind: SyntaxKind) -> bool {
    matches!(
        kind,
        SyntaxKind::File
            | SyntaxKind::Body
            | SyntaxKind::MethodList
            | SyntaxKind::RuleBlock
            | SyntaxKind::Toolbox
            | SyntaxKind::Choice
    )
}

/// A line that is being laid out: its code, and the comment at its end.
#[derive(Default)]
struct Line {
    code: String,
    comment: Option<String>,
}

#[derive(Default)]
struct Layout {
    lines: Vec<Line>,
    line: Line,
    /// The indentation of the present line.
    indent: usize,
    /// The indentation of the line on which the present member began.
    member_indent: usize,
    /// The open brackets, each with the indentation that what it holds hangs on.
    open: Vec<(SyntaxKind, usize)>,
}

impl Layout {
    fn place(&mut self, pieces: &[Piece], i: usize) {
        let piece = &pieces[i];
        let closes =
            matches!(piece.kind, SyntaxKind::RBrace | SyntaxKind::RParen | SyntaxKind::RBracket);
        if i == 0 || piece.newlines > 0 {
            if i > 0 {
                self.end_line(blank_line_before(pieces, i));
            }
            self.indent = self.indent_of(piece, closes);
            self.line.code = " ".repeat(self.indent);
        } else if piece.kind == SyntaxKind::LineComment || piece.kind == SyntaxKind::DocComment {
            self.line.comment = Some(piece.text.clone());
            return;
        } else {
            self.line.code += space(pieces, i);
        }
        if piece.starts && !piece.kind.is_trivia() {
            self.member_indent = self.indent;
        }
        self.line.code += &piece.text;
        match piece.kind {
            SyntaxKind::LBrace => self.open.push((piece.kind, self.member_indent)),
            SyntaxKind::LParen | SyntaxKind::LBracket => self.open.push((piece.kind, self.indent)),
            SyntaxKind::RBrace | SyntaxKind::RParen | SyntaxKind::RBracket => {
                self.close(piece.kind);
            }
            _ => {}
        }
    }
    /// Forgets the bracket that `kind` closes; one that closes nothing is forgotten itself.
    fn close(&mut self, kind: SyntaxKind) {
        let Some(at) = self.opener_of(kind) else { return };
        let (opener, indent) = self.open[at];
        self.open.truncate(at);
        if opener == SyntaxKind::LBrace {
            self.member_indent = indent;
        }
    }
    fn opener_of(&self, kind: SyntaxKind) -> Option<usize> {
        let opener = match kind {
            SyntaxKind::RBrace => SyntaxKind::LBrace,
            SyntaxKind::RParen => SyntaxKind::LParen,
            _ => SyntaxKind::LBracket,
        };
        let at = self.open.iter().rposition(|(open, _)| *open == opener)?;
        let walled = self.open[at..].iter().any(|(open, _)| *open == SyntaxKind::LBrace);
        (opener == SyntaxKind::LBrace || !walled).then_some(at)
    }
    fn indent_of(&self, piece: &Piece, closes: bool) -> usize {
        if closes && let Some(at) = self.opener_of(piece.kind) {
            return self.open[at].1;
        }
        match self.open.last() {
            Some((SyntaxKind::LBrace, indent)) if piece.starts => indent + INDENT,
            Some((SyntaxKind::LBrace, _)) => self.member_indent + INDENT,
            Some((_, indent)) => indent + INDENT,
            None if piece.starts => 0,
            None => self.member_indent + INDENT,
        }
    }
    fn end_line(&mut self, blank_after: bool) {
        self.lines.push(std::mem::take(&mut self.line));
        if blank_after {
            self.lines.push(Line::default());
        }
    }
    /// Sets the comments at the ends of neighbouring lines under each other.
    fn finish(mut self) -> String {
        self.end_line(false);
        let mut out = String::new();
        let mut column = 0;
        for i in 0..self.lines.len() {
            let line = &self.lines[i];
            out += &line.code;
            if let Some(comment) = &line.comment {
                if i == 0 || self.lines[i - 1].comment.is_none() {
                    let run = self.lines[i..].iter().take_while(|line| line.comment.is_some());
                    column = run.map(|line| width(&line.code)).max().unwrap_or(0) + 2;
                }
                out += &" ".repeat(column - width(&line.code));
                out += comment;
            }
            out.push('\n');
        }
        if out == "\n" { String::new() } else { out }
    }
}

/// The characters of the last line of `code`.
fn width(code: &str) -> usize {
    code.rsplit('\n').next().unwrap_or(code).chars().count()
}

/// One blank line is kept between members, none at the edges of a body.
fn blank_line_before(pieces: &[Piece], i: usize) -> bool {
    pieces[i].newlines > 1
        && pieces[i].kind != SyntaxKind::RBrace
        && pieces[i - 1].kind != SyntaxKind::LBrace
}

/// The white space between two pieces on one line.
fn space(pieces: &[Piece], i: usize) -> &'static str {
    let (left, right) = (&pieces[i - 1], &pieces[i]);
    let kept = if right.spaced { " " } else { "" };
    let broken = |p: &Piece| p.parent == SyntaxKind::Error || p.kind == SyntaxKind::Unknown;
    if broken(left) || broken(right) {
        return kept;
    }
    let divided =
        matches!(left.kind, SyntaxKind::LBrace | SyntaxKind::Semicolon | SyntaxKind::Comma);
    if right.starts && !divided {
        return if right.kind.is_trivia() || left.kind.is_trivia() { " " } else { "  " };
    }
    if arithmetic(right) {
        return if tight(pieces, i) { "" } else { " " };
    }
    if arithmetic(left) {
        return if tight(pieces, i - 1) { "" } else { " " };
    }
    // `< 9` is a range that begins nowhere, `..<` one sign
    let is_after_dots = || i > 1 && pieces[i - 2].kind == SyntaxKind::DotDot;
    if left.kind == SyntaxKind::Less && !is_after_dots() {
        return " ";
    }
    if !joins(left, right) {
        return " ";
    }
    // Joined they must read as they read apart.
    if right.spaced && !reads_apart(left, right) { " " } else { "" }
}

/// An arithmetic operator between operands: the author's choice of tight or spaced is kept.
fn arithmetic(piece: &Piece) -> bool {
    piece.parent == SyntaxKind::BinaryExpr
        && matches!(
            piece.kind,
            SyntaxKind::Plus | SyntaxKind::Minus | SyntaxKind::Star | SyntaxKind::Slash
        )
}
fn tight(pieces: &[Piece], i: usize) -> bool {
    let operand = |p: &Piece| !p.kind.is_trivia() && !arithmetic(p);
    let after = pieces.get(i + 1).is_some_and(|p| !p.spaced && !p.starts && operand(p));
    !pieces[i].spaced && after && operand(&pieces[i - 1])
}

/// Returns true if no space stands between the two.
fn joins(left: &Piece, right: &Piece) -> bool {
    let tight_left = match left.kind {
        SyntaxKind::LParen | SyntaxKind::LBracket | SyntaxKind::Dot => true,
        // a range may be open at an end
        SyntaxKind::DotDot => !matches!(right.kind, SyntaxKind::Eq | SyntaxKind::LBrace),
        SyntaxKind::TextOpen | SyntaxKind::TextMiddle => true,
        SyntaxKind::Less => left.parent == SyntaxKind::RangeExpr,
        SyntaxKind::Caret => true,
        SyntaxKind::Minus | SyntaxKind::Plus => left.parent == SyntaxKind::UnaryExpr,
        SyntaxKind::Slash => left.parent == SyntaxKind::UnitLine,
        _ => false,
    };
    let tight_right = match right.kind {
        SyntaxKind::RParen
        | SyntaxKind::RBracket
        | SyntaxKind::Comma
        | SyntaxKind::Semicolon
        | SyntaxKind::Colon
        | SyntaxKind::Dot
        | SyntaxKind::TextMiddle
        | SyntaxKind::TextClose
        | SyntaxKind::Caret => true,
        SyntaxKind::DotDot => left.kind != SyntaxKind::Keyword,
        SyntaxKind::LParen => {
            matches!(right.parent, SyntaxKind::ArgList | SyntaxKind::ParamList)
        }
        SyntaxKind::LBracket => right.parent == SyntaxKind::IndexExpr,
        SyntaxKind::Slash => right.parent == SyntaxKind::UnitLine,
        SyntaxKind::Unit => matches!(right.text.as_str(), "°" | "%"),
        _ => false,
    };
    (tight_left || tight_right) && !left.kind.is_trivia() && !right.kind.is_trivia()
}

/// Returns true if the two tokens, joined, are read as the same two tokens.
fn reads_apart(left: &Piece, right: &Piece) -> bool {
    let extends_unit = left.kind == SyntaxKind::Unit && right.kind == SyntaxKind::Caret;
    let extends_number = left.kind == SyntaxKind::Dot && right.kind == SyntaxKind::Number;
    let split = lex(&format!("{}{}", left.text, right.text)).tokens;
    !extends_unit
        && !extends_number
        && split.len() > 1
        && split[1].start as usize == left.text.len()
}
