//! Values by position, written by name, where a class gets one part more.

use crate::lower::OWN;
use crate::uses::Text;
use base::Span;
use kernel::ClassId;
use syntax::ast::{self, AstNode, Member};
use syntax::edit::TextEdit;

/// Returns true if members declare parts that things have values for.
pub(super) fn declares_parts(members: &str) -> bool {
    let mut members = syntax::parse(OWN, members).file().members();
    members.any(|m| matches!(m, Member::Part(part) if part.definition().is_none()))
}

impl Text<'_> {
    /// Returns the edits that give by name what `(a, b)` gives by position to things of a class, so that they
    /// may have more parts: `s: Spot = (1, 2)` is `s: Spot { x = 1  y = 2 }`.
    pub(super) fn given_by_name(&self, class: ClassId) -> Vec<TextEdit> {
        let document = &self.lowered.document;
        let things = self.lowered.references().things;
        let of_class = things.iter().filter(|(_, c)| document.lineage(*c).contains(&class));
        of_class.filter_map(|(span, class)| self.by_name(*span, *class)).collect()
    }

    fn by_name(&self, span: Span, class: ClassId) -> Option<TextEdit> {
        let document = &self.lowered.document;
        let first = self.file.syntax().token_at_offset(span.start.into()).right_biased()?;
        let mut tuples = first.parent_ancestors().filter_map(ast::TupleExpr::cast);
        let tuple = tuples.find(|t| t.span() == span)?;
        let names = document.layout(class).into_iter().map(|field| document.field_name(field));
        let values = tuple.elements().map(|e| self.source(e.span()));
        let given = names.zip(values);
        let part = first.parent_ancestors().find_map(ast::Part::cast);
        let part = part.filter(|p| p.names().count() == 1 && p.body().is_none());
        match part.filter(|p| p.value().is_some_and(|v| v.span() == span)) {
            Some(part) => {
                let given: Vec<String> = given.map(|(n, v)| format!("{n} = {v}")).collect();
                let span = Span::new(part.class()?.span().end, span.end);
                let body = crate::write::joined(&given);
                Some(TextEdit { span, insert: format!(" {{ {body} }}") })
            }
            None => {
                let given: Vec<String> = given.map(|(n, v)| format!("{n}: {v}")).collect();
                let maker = &document.classes[document.named_class(class)].name;
                Some(TextEdit { span, insert: format!("{maker}({})", given.join(", ")) })
            }
        }
    }
}
