//! The text view: the source, its colours, and what is wrong with it.

use crate::session::Session;
use crate::state::{State, Untold};
use crate::view::{
    DiagnosticView, DocumentId, FixView, LabelView, TextChange, TextView, TokenView,
};
use base::{Diagnostic, FileId, LineIndex, Place, Severity};
use std::collections::BTreeMap;
use syntax::ast::AstNode;
use syntax::{SyntaxKind, SyntaxToken};

/// Returns the source with its diagnostics.
pub(crate) fn view(state: &State) -> TextView {
    TextView { source: state.text.clone(), diagnostics: diagnostics(state, &state.diagnostics) }
}

/// Returns what stands in the `///` lines with which a document begins.
pub(crate) fn preamble(state: &State) -> String {
    let lines = state.text.lines().map(str::trim).filter(|line| !line.is_empty());
    let docs = lines.map_while(|line| line.strip_prefix("///"));
    docs.map(|line| line.trim_start_matches('/').trim()).collect::<Vec<_>>().join(" ")
}

/// Returns the colours of the source.
pub(crate) fn tokens(state: &State) -> Vec<TokenView> {
    let tree = state.file().syntax().clone();
    let tokens = tree.descendants_with_tokens().filter_map(syntax::SyntaxElement::into_token);
    tokens.filter_map(|t| token(&t)).collect()
}

fn token(token: &SyntaxToken) -> Option<TokenView> {
    let kind = match token.kind() {
        SyntaxKind::Whitespace => return None,
        SyntaxKind::LineComment | SyntaxKind::BlockComment => "comment",
        SyntaxKind::DocComment => "doc",
        SyntaxKind::Number | SyntaxKind::Unit => "number",
        SyntaxKind::Text
        | SyntaxKind::TextOpen
        | SyntaxKind::TextMiddle
        | SyntaxKind::TextClose => "text",
        SyntaxKind::Keyword => "keyword",
        kind if kind.is_reserved() => "keyword",
        SyntaxKind::Ident if token.text().starts_with(char::is_uppercase) => "class",
        SyntaxKind::Ident => "name",
        SyntaxKind::Unknown => "error",
        _ => "operator",
    };
    let span = syntax::span_of_token(token);
    Some(TokenView { start: span.start, end: span.end, kind: kind.into() })
}

/// Returns a fix as an editor offers it; nothing for one of another text than the document's own.
fn fix(fix: &base::Fix) -> Option<FixView> {
    let change = |(place, insert): &(Place, String)| {
        let (start, end) = (place.span.start, place.span.end);
        let own = place.file == FileId(0);
        own.then(|| TextChange { start, end, insert: insert.clone() })
    };
    let edits: Option<Vec<TextChange>> = fix.edits.iter().map(change).collect();
    Some(FixView { title: fix.title.clone(), edits: edits? })
}

impl Session {
    /// Returns how many diagnostics of the text are not told one by one.
    pub fn untold(&self, id: DocumentId) -> Untold {
        self.document(id).state.untold
    }
}

/// Returns diagnostics as an editor shows them.
pub(crate) fn diagnostics(state: &State, all: &[Diagnostic]) -> Vec<DiagnosticView> {
    let mut lines: BTreeMap<FileId, LineIndex> = BTreeMap::new();
    let mut find = |place: Place| {
        let file = &state.lowered.files[place.file];
        let lines = lines.entry(place.file).or_insert_with(|| LineIndex::new(&file.text));
        let name = if place.file == FileId(0) { String::new() } else { file.name.clone() };
        (name, lines.line_column(&file.text, place.span.start))
    };
    all.iter().map(|d| diagnostic(d, &mut find)).collect()
}

/// Returns the name of a place's file, its line and its column.
type Find<'f> = dyn FnMut(Place) -> (String, (u32, u32)) + 'f;

fn diagnostic(d: &Diagnostic, find: &mut Find<'_>) -> DiagnosticView {
    let (file, (line, column)) = find(d.place);
    let label = |label: &base::Label| {
        let (file, (line, column)) = find(label.place);
        LabelView { file, line, column, message: label.message.clone() }
    };
    let labels = d.labels.iter().map(label).collect();
    let severity = match d.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    DiagnosticView {
        severity: severity.into(),
        code: d.code.into(),
        message: d.message.clone(),
        hint: d.hint.clone(),
        file,
        start: d.place.span.start,
        end: d.place.span.end,
        line,
        column,
        labels,
        fixes: d.fixes.iter().filter_map(fix).collect(),
    }
}
