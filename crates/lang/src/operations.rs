//! Operations: where in the text an operation of a rule is written.

use crate::lower::Lowered;
use base::Place;
use syntax::ast::{self, AstNode};
use syntax::{SyntaxKind, SyntaxNode, WalkEvent, span_of};

impl Lowered {
    /// Finds where an operation of a member stands, by its sign or name: the one before which `before` others of its
    /// kind are written. Nothing where the member has not just `all` of them, as where one line says several rules.
    pub fn operation(
        &self,
        member: Place,
        operation: &str,
        (before, all): (usize, usize),
    ) -> Option<Place> {
        let within = member.span.range();
        let mut found = Vec::new();
        let root = self.files[member.file].parse.syntax();
        let mut walk = root.preorder();
        while let Some(event) = walk.next() {
            let WalkEvent::Enter(node) = event else { continue };
            let span = span_of(&node);
            if span.end <= member.span.start || member.span.end <= span.start {
                walk.skip_subtree();
                continue;
            }
            let word = word_of(&node).filter(|word| word.text() == operation);
            if let Some(word) = word.map(|word| word.span())
                && within.contains(&(word.start as usize))
            {
                found.push((word.start, span));
            }
        }
        found.sort_unstable();
        let (_, span) = *found.get(before).filter(|_| found.len() == all)?;
        Some(Place { file: member.file, span })
    }
}

/// Returns the sign or name of what a node does.
fn word_of(node: &SyntaxNode) -> Option<ast::Word> {
    match node.kind() {
        SyntaxKind::BinaryExpr => ast::BinaryExpr::cast(node.clone())?.op_word(),
        SyntaxKind::CallExpr => ast::CallExpr::cast(node.clone())?.name(),
        SyntaxKind::FieldExpr => ast::FieldExpr::cast(node.clone())?.name(),
        _ => None,
    }
}
