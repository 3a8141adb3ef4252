//! A class of one gets a name of its own.

use super::must_be_name;
use crate::uses::{Text, refused};
use base::{Diagnostic, Span};
use kernel::Path;
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::edit::{self, Spot, TextEdit};

impl Text<'_> {
    pub(super) fn promote(&self, path: &Path, class: &str) -> Result<Vec<TextEdit>, Diagnostic> {
        must_be_name(class)?;
        self.must_be_new_class(class)?;
        let (_, member, word) = self.declaration(path)?;
        let parts = match &member {
            Member::Part(part) => part.class().zip(part.body()).map(|(ty, body)| (part, ty, body)),
            _ => None,
        };
        let Some((part, ty, body)) = parts else {
            let message = format!("{path} has no body that could become a class");
            return Err(refused("not-a-class-of-one", message));
        };
        let around = body.syntax().descendants().filter_map(Expr::cast).find(|e| {
            let path_of = self.path_of(e);
            path_of.is_some_and(|p| !p.0.starts_with(&path.0))
        });
        if let Some(e) = around {
            let message = format!("{path} speaks of {}, which is around it", e.syntax().text());
            let d = refused("speaks-of-its-owner", message);
            return Err(d.hint("move that member out of the body first"));
        }
        let (above, text) = (ty.syntax().text().to_string(), body.syntax().text().to_string());
        let declared = format!("class {class} is {above} {text}");
        let top = word.token.parent_ancestors().filter_map(Member::cast).last();
        let top = top.map_or_else(|| part.syntax().clone(), |m| m.syntax().clone());
        let whole = Span::new(ty.span().start, body.span().end);
        Ok(vec![
            edit::insert_member(&Spot::Before(top), &declared),
            TextEdit { span: whole, insert: self.named_instead(part, class) },
        ])
    }

    /// Returns what stands for a part's class and body once the body is a class.
    fn named_instead(&self, part: &ast::Part, class: &str) -> String {
        match (part.class(), part.value()) {
            (Some(ty), Some(value)) => {
                let between = Span::new(ty.span().end, value.span().end);
                format!("{class}{}", self.source(between))
            }
            _ => class.to_string(),
        }
    }
}
