//! Connections taken apart: what was one with another becomes a copy of it.

use crate::connections::is_bare_path;
use crate::lower::OWN;
use crate::uses::Text;
use base::{Place, Span};
use kernel::{Merge, Path, Step};
use std::collections::BTreeSet;
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::edit::TextEdit;

impl Text<'_> {
    /// Turns the connections of a path into copies; returns what it was connected with.
    pub(super) fn disconnect(&self, path: &Path, edits: &mut Vec<TextEdit>) -> Vec<Path> {
        let mut others = Vec::new();
        for (part, value) in self.connections() {
            let Some(of) = self.path_of(&value) else { continue };
            let other = match (part == *path, of == *path) {
                (true, _) => of,
                (_, true) => part,
                _ => continue,
            };
            let start = value.span().start;
            let copied = TextEdit { span: Span::new(start, start), insert: "copy of ".into() };
            edits.push(copied);
            others.push(other);
        }
        others
    }

    /// Returns the parts of the text that are given another by its bare path, and what they are given.
    fn connections(&self) -> Vec<(Path, Expr)> {
        let merges = self.lowered.document.classes.iter().flat_map(|(_, c)| &c.merges);
        let places: BTreeSet<Place> =
            merges.map(|m: &Merge| self.lowered.origins.place(m.origin)).collect();
        let is_merge_of = |value: &Expr| places.contains(&Place { file: OWN, span: value.span() });
        let kinds = [SyntaxKind::Assign, SyntaxKind::Part];
        let outline = self.lowered.effective_parse.outline();
        let members = outline.filter_map(|(_, span)| self.file.member_at(span));
        let nodes = members.flat_map(|m| m.syntax().descendants().collect::<Vec<_>>());
        let is_plain = |n: &syntax::SyntaxNode| {
            let apart = [SyntaxKind::For, SyntaxKind::Check, SyntaxKind::Lesson];
            kinds.contains(&n.kind()) && !n.ancestors().any(|a| apart.contains(&a.kind()))
        };
        let connected = |node: syntax::SyntaxNode| match Member::cast(node)? {
            Member::Assign(assign) => {
                let value = assign.value().and_then(ast::Value::expr)?;
                Some((self.path_of(&assign.target()?)?, value))
            }
            Member::Part(part) => {
                let value = part.value().and_then(ast::Value::expr)?;
                let (around, _) = self.things_around(part.syntax())?.into_iter().next()?;
                Some((around.then(Step::Part(part.names().next()?.name())), value))
            }
            _ => None,
        };
        let found = nodes.filter(is_plain).filter_map(connected);
        found.filter(|(_, value)| is_bare_path(value) && is_merge_of(value)).collect()
    }
}
