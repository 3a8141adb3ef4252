//! The engine of the parser: tokens in, tree and diagnostics out; what it builds stands in `grammar`.
//!
//! The tree is built as it is read. Trivia waits until the next token is taken, so a node never
//! begins or ends with it, except the doc comments that a member begins with.

use crate::kind::SyntaxKind::{self, DocComment, Eof, Error, Ident, Keyword};
use crate::lexer::{Fault, Lexed, RawToken};
use crate::strange::{line_before, token_fault};
use base::{Diagnostic, FileId, Place, Span};
use rowan::{Checkpoint, GreenNode, GreenNodeBuilder};

/// How deep brackets, bodies and operators may nest.
pub const MAX_DEPTH: u32 = 200;
/// How high the tree of one expression may grow: `a + b + c` is as high as it has operators.
pub const MAX_HEIGHT: u32 = 500;

/// How many characters of a text a hint quotes.
const LONGEST_QUOTE: usize = 80;

/// A token that is not trivia.
#[derive(Clone, Copy, Debug)]
struct Token {
    kind: SyntaxKind,
    /// A line end stands before it.
    newline: bool,
    /// Its index among all tokens.
    raw: u32,
    /// The index of the bracket that closes this one; 0 where there is none.
    closer: u32,
}

/// The state of one parse.
pub(crate) struct Parser<'t> {
    text: &'t str,
    file: FileId,
    raw: Vec<RawToken>,
    tokens: Vec<Token>,
    /// The next token to take.
    pos: usize,
    /// The next token to put into the tree, trivia included.
    raw_pos: usize,
    builder: GreenNodeBuilder<'static>,
    diagnostics: Vec<Diagnostic>,
    last_error: Option<usize>,
    depth: u32,
    too_deep_said: bool,
    /// Where the present member begins: what is wrong with that token is wrong there.
    member: usize,
    /// Where the member before it begins, in the same body.
    previous: usize,
    /// The name of the class that was read last.
    class: usize,
    /// Brackets that are open and will be closed: a line end inside them ends nothing.
    pub(crate) brackets: u32,
    /// Brackets that are open and never closed: a line end inside them ends everything.
    pub(crate) unclosed: u32,
    /// Inside the bindings of a `let`, where `in` is not an operator.
    pub(crate) in_bindings: bool,
    /// Among the statements of a check.
    pub(crate) in_check: bool,
    /// How far the line is indented that opens a brace which nothing closes: what begins a line no further in stands
    /// behind it.
    pub(crate) unclosed_body: Option<usize>,
}

impl<'t> Parser<'t> {
    pub(crate) fn new(file: FileId, text: &'t str, lexed: Lexed) -> Self {
        // the same strange character again on a line, as the other quote, says nothing new
        let is_new = |&(i, (span, fault)): &(usize, &(Span, Fault))| {
            let again = i.checked_sub(1).and_then(|i| lexed.faults.get(i));
            again.is_none_or(|(before, other)| {
                let is_quote = |span: &Span| text[span.range()].starts_with('\'');
                let are_inches = *fault == Fault::UnterminatedText && is_quote(before);
                let alike = fault == other && text[before.range()] == text[span.range()];
                let are_minutes = is_quote(span) && text[before.range()].starts_with('°');
                !(alike || are_inches || are_minutes)
                    || text[before.range().start..span.range().start].contains('\n')
            })
        };
        let faults = lexed.faults.iter().enumerate().filter(is_new);
        let diagnostics =
            faults.map(|(_, &(span, fault))| token_fault(file, text, span, fault)).collect();
        let mut tokens = significant(text, &lexed.tokens);
        match_brackets(&mut tokens);
        Self {
            text,
            file,
            raw: lexed.tokens,
            tokens,
            pos: 0,
            raw_pos: 0,
            builder: GreenNodeBuilder::new(),
            diagnostics,
            last_error: None,
            depth: 0,
            too_deep_said: false,
            member: 0,
            previous: 0,
            class: 0,
            brackets: 0,
            unclosed: 0,
            in_bindings: false,
            in_check: false,
            unclosed_body: None,
        }
    }

    /// Ends the parse; every token has been taken.
    pub(crate) fn finish_parse(self) -> (GreenNode, Vec<Diagnostic>) {
        let mut diagnostics = self.diagnostics;
        diagnostics.sort_by_key(|d| d.place.span);
        (self.builder.finish(), diagnostics)
    }

    // ---- looking ahead

    pub(crate) fn pos(&self) -> usize {
        self.pos
    }
    fn token(&self, n: usize) -> Token {
        self.tokens[(self.pos + n).min(self.tokens.len() - 1)]
    }
    /// The kind of the token `n` ahead.
    pub(crate) fn nth(&self, n: usize) -> SyntaxKind {
        self.token(n).kind
    }
    pub(crate) fn current(&self) -> SyntaxKind {
        self.token(0).kind
    }
    pub(crate) fn at(&self, kind: SyntaxKind) -> bool {
        self.current() == kind
    }
    /// Returns true if the token `n` ahead begins a line.
    pub(crate) fn begins_line(&self, n: usize) -> bool {
        self.token(n).newline
    }
    /// Returns true if the token `n` ahead begins a line that ends the expression before it.
    pub(crate) fn line_ended(&self, n: usize) -> bool {
        self.token(n).newline
            && self.pos + n > self.member
            && (self.brackets == 0 || self.unclosed > 0)
    }
    /// The text of the token `n` ahead.
    pub(crate) fn word(&self, n: usize) -> &'t str {
        let raw = self.token(n).raw as usize;
        let end = self.raw.get(raw + 1).map_or(self.text.len(), |t| t.start as usize);
        &self.text[self.raw[raw].start as usize..end]
    }
    /// Returns true if the token `n` ahead is the contextual keyword `word`.
    pub(crate) fn at_word(&self, n: usize, word: &str) -> bool {
        self.nth(n) == Ident && self.word(n) == word && !self.names_itself(n + 1)
    }
    /// Returns true if what stands `n` ahead makes the word before it a name and no keyword.
    pub(crate) fn names_itself(&self, n: usize) -> bool {
        match self.nth(n) {
            SyntaxKind::Colon
            | SyntaxKind::Comma
            | SyntaxKind::Dot
            | SyntaxKind::Eq
            | SyntaxKind::ColonEq
            | SyntaxKind::FatArrow => true,
            SyntaxKind::LParen => {
                matches!(self.after_bracket(n), SyntaxKind::FatArrow | SyntaxKind::Colon)
            }
            _ => false,
        }
    }
    /// The kind of the token after the bracket that closes the one `n` ahead; Eof if none does.
    pub(crate) fn after_bracket(&self, n: usize) -> SyntaxKind {
        match self.token(n).closer as usize {
            0 => Eof,
            closer => self.tokens[closer + 1].kind,
        }
    }
    /// The kind of the token `n` before this one.
    pub(crate) fn behind(&self, n: usize) -> SyntaxKind {
        self.pos.checked_sub(n).map_or(Eof, |i| self.tokens[i].kind)
    }
    /// Returns true if nothing stands between the token `n` ahead and the one before it.
    pub(crate) fn is_adjacent(&self, n: usize) -> bool {
        let at = (self.pos + n).min(self.tokens.len() - 1);
        at > 0 && self.tokens[at].raw == self.tokens[at - 1].raw + 1
    }
    /// Where the token of this index stands.
    pub(crate) fn span_at(&self, index: usize) -> Span {
        let raw = self.tokens[index.min(self.tokens.len() - 1)].raw as usize;
        let end = self.raw.get(raw + 1).map_or(self.text.len() as u32, |t| t.start);
        Span::new(self.raw[raw].start, end)
    }
    /// The text of the tokens from one to another, the last one included.
    pub(crate) fn text_between(&self, first: usize, last: usize) -> &'t str {
        let (from, to) = (self.span_at(first).start, self.span_at(last).end);
        self.text.get(from as usize..(to as usize).max(from as usize)).unwrap_or_default()
    }
    /// The index of the last token of this line and body.
    pub(crate) fn line_end(&self) -> usize {
        let mut n = 0;
        while !matches!(self.nth(n + 1), Eof | SyntaxKind::RBrace | SyntaxKind::Semicolon)
            && !self.begins_line(n + 1)
        {
            n += 1;
        }
        self.pos + n
    }
    /// The word that says what the member before this one is: behind its strength, `weak constraint`.
    pub(crate) fn word_before(&self) -> &'t str {
        let first = self.text_between(self.previous, self.previous);
        match first {
            "required" | "strong" | "medium" | "weak" => {
                self.text_between(self.previous + 1, self.previous + 1)
            }
            word => word,
        }
    }
    /// Returns what stands on the line before the current token.
    pub(crate) fn line_before(&self) -> &'t str {
        line_before(self.text, self.span_at(self.pos))
    }
    /// Returns true if the member before this one replaces a part: `replace z: Real`.
    pub(crate) fn declared_before(&self) -> bool {
        let kind = self.tokens.get(self.previous + 2).map_or(Eof, |token| token.kind);
        kind == SyntaxKind::Colon
            && self
                .text_between(self.previous + 3, self.previous + 3)
                .starts_with(char::is_uppercase)
    }
    /// The index of the first token of the present member.
    pub(crate) fn member(&self) -> usize {
        self.member
    }
    /// The first word of the present member.
    pub(crate) fn member_word(&self) -> &'t str {
        self.text_between(self.member, self.member)
    }
    /// Returns true if the class that the present member has named last is called so.
    pub(crate) fn is_of(&self, class: &str) -> bool {
        self.class > self.member && self.text_between(self.class, self.class) == class
    }
    /// What a hint quotes of the tokens from one to another: a line at most, shortened where that is long.
    pub(crate) fn quoted(&self, first: usize, last: usize) -> String {
        let all = self.text_between(first, last);
        let line = all.lines().next().unwrap_or_default();
        let end = line.char_indices().nth(LONGEST_QUOTE).map_or(line.len(), |(at, _)| at);
        match end < all.len() {
            true => format!("{} …", line[..end].trim_end()),
            false => line.to_string(),
        }
    }
    /// What a hint quotes of the rest of a member on this line, from a token that stands on it.
    pub(crate) fn quoted_line(&self, first: usize) -> String {
        let kind = |at: usize| self.tokens.get(at).map_or(Eof, |token| token.kind);
        self.quoted_until(first, |next| {
            let declares = kind(next) == Ident && kind(next + 1) == SyntaxKind::Colon;
            declares
                || matches!(kind(next), SyntaxKind::RBrace | SyntaxKind::Semicolon)
                || self.text_between(next, next) == "constraint"
        })
    }
    /// What a hint quotes of a class whose bracket is not closed.
    pub(crate) fn quoted_class(&self, first: usize) -> String {
        self.quoted_until(first, |next| {
            let kind = self.tokens.get(next).map_or(Eof, |token| token.kind);
            matches!(kind, SyntaxKind::Eq | SyntaxKind::LBrace | SyntaxKind::RBrace)
        })
    }
    /// What a hint quotes of a line up to a token at which it ends, the first that is quoted left alone.
    fn quoted_until(&self, first: usize, ends: impl Fn(usize) -> bool) -> String {
        let is_last = |at: &usize| {
            let next = self.tokens[at + 1];
            next.newline || next.kind == Eof || ends(at + 1)
        };
        let mut within = first..(first + LONGEST_QUOTE).min(self.tokens.len() - 1);
        let last = within.find(is_last).unwrap_or(within.end);
        self.quoted(first, last)
    }
    /// How far the line of the token here is indented.
    pub(crate) fn indent(&self) -> usize {
        let start = self.span_at(self.pos).start as usize;
        let line = &self.text[self.text[..start].rfind('\n').map_or(0, |n| n + 1)..];
        line.len() - line.trim_start_matches([' ', '\t']).len()
    }
    /// How many tokens ahead the bracket here is closed; 0 where it is not.
    pub(crate) fn bracket_length(&self) -> usize {
        (self.token(0).closer as usize).saturating_sub(self.pos)
    }
    /// Returns true if the bracket here is closed somewhere.
    pub(crate) fn is_closed(&self) -> bool {
        self.token(0).closer != 0
    }

    /// Notes that the name of a class stands here.
    pub(crate) fn name_class(&mut self) {
        self.class = self.pos;
    }
    /// Notes that a member, or an element of a body, begins here, and where the one before it did.
    pub(crate) fn begin_member(&mut self, previous: usize) {
        (self.member, self.previous) = (self.pos, previous);
    }

    // ---- building

    pub(crate) fn start(&mut self, kind: SyntaxKind) {
        self.flush(self.tokens[self.pos].raw as usize);
        self.builder.start_node(kind.into());
    }
    /// Starts a node that takes the doc comments before it as its own.
    pub(crate) fn start_documented(&mut self, kind: SyntaxKind) {
        self.flush_to_doc();
        self.builder.start_node(kind.into());
    }
    pub(crate) fn start_file(&mut self, kind: SyntaxKind) {
        self.builder.start_node(kind.into());
    }
    pub(crate) fn finish_file(&mut self) {
        debug_assert!(self.at(Eof), "a file ends where its tokens end");
        self.flush(self.raw.len() - 1);
        self.builder.finish_node();
    }
    pub(crate) fn checkpoint(&mut self) -> Checkpoint {
        self.flush(self.tokens[self.pos].raw as usize);
        self.builder.checkpoint()
    }
    pub(crate) fn start_at(&mut self, checkpoint: Checkpoint, kind: SyntaxKind) {
        self.builder.start_node_at(checkpoint, kind.into());
    }
    pub(crate) fn finish(&mut self) {
        self.builder.finish_node();
    }
    pub(crate) fn bump(&mut self) {
        self.bump_as(self.current());
    }
    pub(crate) fn bump_keyword(&mut self) {
        self.bump_as(Keyword);
    }
    /// Takes the current token, as one of another kind; at the end of the text, nothing.
    pub(crate) fn bump_as(&mut self, kind: SyntaxKind) {
        let Token { kind: found, raw, .. } = self.tokens[self.pos];
        if found == Eof {
            return;
        }
        self.flush(raw as usize);
        let word = self.word(0);
        self.builder.token(kind.into(), word);
        self.pos += 1;
        self.raw_pos += 1;
    }
    pub(crate) fn eat(&mut self, kind: SyntaxKind) -> bool {
        let found = self.at(kind);
        if found {
            self.bump();
        }
        found
    }
    pub(crate) fn eat_word(&mut self, word: &str) -> bool {
        let found = self.at_word(0, word);
        if found {
            self.bump_keyword();
        }
        found
    }
    /// Puts the trivia before the token of index `raw` into the tree.
    fn flush(&mut self, raw: usize) {
        while self.raw_pos < raw {
            let token = self.raw[self.raw_pos];
            let end = self.raw[self.raw_pos + 1].start as usize;
            self.builder.token(token.kind.into(), &self.text[token.start as usize..end]);
            self.raw_pos += 1;
        }
    }
    fn flush_to_doc(&mut self) {
        let end = self.tokens[self.pos].raw as usize;
        let doc = self.raw[self.raw_pos..end].iter().position(|t| t.kind == DocComment);
        self.flush(doc.map_or(end, |n| self.raw_pos + n));
    }

    // ---- depth

    /// Goes one level deeper and runs `f`; where that is too deep, the rest of the line is skipped.
    pub(crate) fn nested<T>(&mut self, f: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.depth >= MAX_DEPTH {
            self.too_deep();
            return None;
        }
        self.depth += 1;
        let result = f(self);
        self.depth -= 1;
        Some(result)
    }
    /// Reports nesting that is too deep, once, and skips what is left of the line.
    #[cold]
    pub(crate) fn too_deep(&mut self) {
        if !self.too_deep_said {
            self.too_deep_said = true;
            let message =
                format!("nested more than {MAX_DEPTH} deep, or too many operators in a row");
            let place = self.place_here();
            self.diagnostics.push(
                Diagnostic::error("too-deep", place, message)
                    .hint("name a part of it and use the name"),
            );
        }
        self.skip_line();
        // what is missing behind what was skipped was said
        self.last_error = Some(self.pos);
    }

    // ---- errors

    /// Reports what was wanted here, unless something was reported here already.
    pub(crate) fn expected(&mut self, code: &'static str, wanted: &str) {
        self.expected_hint(code, wanted, None);
    }
    pub(crate) fn expected_hint(&mut self, code: &'static str, wanted: &str, hint: Option<String>) {
        let message = format!("found {}, wanted {wanted}", self.found());
        self.report(code, message, hint);
    }
    /// Reports a fault at the current token, unless something was reported there already.
    #[cold]
    #[inline(never)]
    pub(crate) fn report(&mut self, code: &'static str, message: String, hint: Option<String>) {
        // a text without an end was told
        let is_cut =
            self.at(SyntaxKind::Text) && (self.word(0).len() == 1 || !self.word(0).ends_with('"'));
        if self.last_error != Some(self.pos) && !self.at(SyntaxKind::Unknown) && !is_cut {
            let mut diagnostic = Diagnostic::error(code, self.place_here(), message);
            diagnostic.hint = hint;
            self.diagnostics.push(diagnostic);
        }
        self.last_error = Some(self.pos);
    }
    /// Reports a fault of the tokens from one to another, unless something was reported here already; with a correction
    /// of the text, if there is one.
    #[cold]
    #[inline(never)]
    pub(crate) fn report_mistake(
        &mut self,
        (first, last): (usize, usize),
        (code, message, hint): (&'static str, String, String),
        fix: Option<(Span, String)>,
    ) {
        if self.last_error == Some(self.pos) {
            return;
        }
        let span = self.span_at(first).join(self.span_at(last));
        let mut d = Diagnostic::error(code, Place { file: self.file, span }, message).hint(hint);
        if let Some((span, insert)) = fix {
            let title = if insert.trim().is_empty() { "take it away" } else { "write" };
            let title = format!("{title} {}", insert.trim()).trim().to_string();
            d = d.fix(title, [(Place { file: self.file, span }, insert)]);
        }
        self.diagnostics.push(d);
        self.last_error = Some(self.pos);
    }
    /// Reports a fault of what was understood: the tokens from `start` to the last one taken.
    pub(crate) fn report_since(
        &mut self,
        start: usize,
        code: &'static str,
        message: String,
        hint: &str,
    ) {
        let from = self.raw[self.tokens[start].raw as usize].start;
        let place = Place { file: self.file, span: Span::new(from, self.last_end().max(from)) };
        self.diagnostics.push(Diagnostic::error(code, place, message).hint(hint));
    }
    /// Takes `kind`, or reports that it was wanted; a name that begins the next member is left to it.
    pub(crate) fn expect(&mut self, kind: SyntaxKind, code: &'static str, wanted: &str) -> bool {
        let next_member = kind == Ident && self.line_ended(0) && self.names_itself(1);
        let found = !next_member && self.eat(kind);
        if !found {
            self.expected(code, wanted);
        }
        found
    }
    fn found(&self) -> String {
        match self.current() {
            Eof => "the end of the text".into(),
            _ if self.line_ended(0) => "the end of the line".into(),
            _ => {
                let word = self.word(0);
                let short: String = word.chars().take(24).collect();
                if short.len() < word.len() {
                    format!("`{short}…`")
                } else {
                    format!("`{short}`")
                }
            }
        }
    }
    /// The current token; where it begins a new line, the last one of the line before.
    fn place_here(&self) -> Place {
        let token = self.token(0);
        let at_end = token.kind == Eof || (token.newline && self.pos > self.member);
        let at =
            if at_end && self.pos > 0 { self.tokens[self.pos - 1].raw } else { token.raw } as usize;
        let end = self.raw.get(at + 1).map_or(self.text.len() as u32, |t| t.start);
        Place { file: self.file, span: Span::new(self.raw[at].start, end) }
    }
    /// Where the last token taken ends.
    fn last_end(&self) -> u32 {
        let last = self.tokens[self.pos.saturating_sub(1)].raw as usize;
        self.raw.get(last + 1).map_or(self.text.len() as u32, |t| t.start)
    }

    /// Makes an Error node of all up to the line's end, the body's end or a `;`: at least one token.
    ///
    /// Brackets that are closed are skipped whole.
    /// Skips what is left inside of the braces here; nothing where these are not closed.
    pub(crate) fn skip_in_braces(&mut self) {
        let mut open = 0usize;
        let mut ahead = 0;
        loop {
            match self.nth(ahead) {
                Eof => return,
                SyntaxKind::LBrace => open += 1,
                SyntaxKind::RBrace if open == 0 => break,
                SyntaxKind::RBrace => open -= 1,
                _ => {}
            }
            ahead += 1;
        }
        self.start(Error);
        (0..ahead).for_each(|_| self.bump());
        self.finish();
    }

    /// Takes what stands between this bracket and the one that closes it as one thing that was not understood.
    pub(crate) fn skip_brackets(&mut self) {
        let closer = self.token(0).closer as usize;
        if closer > self.pos {
            self.start(Error);
            while self.pos <= closer {
                self.bump();
            }
            self.finish();
        }
    }
    pub(crate) fn skip_line(&mut self) {
        if self.at(Eof) {
            return;
        }
        self.start(Error);
        let mut until = self.pos;
        loop {
            until = until.max(self.token(0).closer as usize);
            self.bump();
            let done = match self.current() {
                Eof => true,
                SyntaxKind::RBrace | SyntaxKind::Semicolon => self.pos > until,
                _ => self.begins_line(0) && self.pos > until,
            };
            if done {
                break;
            }
        }
        self.finish();
    }
}

/// Picks the tokens that are not trivia.
fn significant(text: &str, raw: &[RawToken]) -> Vec<Token> {
    let mut tokens = Vec::with_capacity(raw.len() / 2 + 1);
    let mut newline = true;
    for (i, token) in raw.iter().enumerate() {
        if token.kind.is_trivia() {
            let end = raw[i + 1].start as usize;
            newline |= text.as_bytes()[token.start as usize..end].contains(&b'\n');
        } else {
            tokens.push(Token { kind: token.kind, newline, raw: i as u32, closer: 0 });
            newline = false;
        }
    }
    tokens
}

/// Gives every bracket that is closed the index of the one that closes it.
///
/// Expressions contain no braces, so a `{` or `}` leaves the `(` and `[` before it unclosed.
fn match_brackets(tokens: &mut [Token]) {
    let (mut rounds, mut squares, mut braces) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..tokens.len() {
        let opener: Option<usize> = match tokens[i].kind {
            SyntaxKind::LParen => {
                rounds.push(i);
                None
            }
            SyntaxKind::LBracket => {
                squares.push(i);
                None
            }
            SyntaxKind::RParen => close(&mut rounds, &mut squares),
            SyntaxKind::RBracket => close(&mut squares, &mut rounds),
            SyntaxKind::LBrace => {
                rounds.clear();
                squares.clear();
                braces.push(i);
                None
            }
            SyntaxKind::RBrace => {
                rounds.clear();
                squares.clear();
                braces.pop()
            }
            _ => None,
        };
        if let Some(opener) = opener {
            tokens[opener].closer = i as u32;
        }
    }
}

/// Takes the last opener of one sort; those of the other sort opened after it stay unclosed.
fn close(own: &mut Vec<usize>, other: &mut Vec<usize>) -> Option<usize> {
    let opener = own.pop()?;
    while other.last().is_some_and(|&o| o > opener) {
        other.pop();
    }
    Some(opener)
}

impl From<SyntaxKind> for rowan::SyntaxKind {
    fn from(kind: SyntaxKind) -> Self {
        Self(kind as u16)
    }
}
