//! Names changed wherever they are spoken of.

use super::home::{Home, Site};
use super::{Restructuring, must_be_name};
use crate::references::Symbol;
use crate::uses::{Text, refused};
use base::{Diagnostic, Span};
use kernel::{Path, Step};
use syntax::ast::{self, AstNode, Member};
use syntax::edit::{self, TextEdit};
use syntax::{SyntaxElement, SyntaxKind, SyntaxToken};

impl Text<'_> {
    pub(super) fn rename(&self, from: &Path, to: &str) -> Result<Restructuring, Diagnostic> {
        must_be_name(to)?;
        if let Some(class) = self.class(from) {
            self.must_be_new_class(to)?;
            let word = class.name().expect("a class was found by its name");
            return Ok(self.rename_words(word.text(), to, is_class_name).into());
        }
        let (home, member, word) = self.declaration(from)?;
        self.must_be_free(&home, to)?;
        let symbol = self.symbol(&home, &word);
        let mut edits = vec![edit::rename(&word.token, to)];
        let references = self.lowered.references();
        for (span, spoken) in &references.words {
            if *spoken == symbol && *span != word.span() {
                edits.push(TextEdit { span: *span, insert: to.to_string() });
            }
        }
        let mut edits = self.meaning_the_same(edits, (&symbol, &to.into()), &references)?;
        if let Member::Constraint(_) = member {
            edits.extend(self.expected(word.text(), to));
        }
        Ok(Restructuring { edits, class: self.implied_by(&home).class, ..Default::default() })
    }

    /// Finds where the member at a path is declared.
    ///
    /// # Errors
    /// The path leads nowhere, or to what a class declares.
    pub(super) fn declaration(&self, path: &Path) -> Result<(Home, Member, ast::Word), Diagnostic> {
        let (last, owner) = match path.0.split_last() {
            Some((last, owner)) => (last, Path(owner.to_vec())),
            None => return Err(refused("unknown-part", "the document has no name".into())),
        };
        let unknown = || self.unknown(path);
        let home = self.home(&owner).map_err(|_| unknown())?;
        if let (true, Step::Part(name)) = (home.path == owner, last)
            && let Some((member, word)) = home.member(name)
        {
            return Ok((home, member, word));
        }
        let known = self.class_at(path).is_some() || self.constraint(path).is_ok();
        Err(if known { self.of_a_class(path) } else { unknown() })
    }

    /// Returns what the references call a member that is declared in a body.
    pub(super) fn symbol(&self, home: &Home, word: &ast::Word) -> Symbol {
        let root = self.lowered.document.root;
        let class = match &home.site {
            Site::Document(_) => root,
            Site::Class(_) | Site::Part(..) => self.class_at(&home.path).unwrap_or(root),
        };
        Symbol { class, name: word.name() }
    }

    fn must_be_free(&self, home: &Home, name: &str) -> Result<(), Diagnostic> {
        let path = home.path.then(Step::Part(name.into()));
        let document = &self.lowered.document;
        let says = |class| document.find_message(class, name, None).is_some();
        let has = self.class_at(&path).is_some()
            || home.member(name).is_some()
            || self.class_at(&home.path).is_some_and(says);
        match has {
            true => Err(refused("duplicate-name", format!("there is a part {path} already"))),
            false => Ok(()),
        }
    }

    /// Renames the word by which checks expect a refusal, where one constraint alone is called so.
    fn expected(&self, from: &str, to: &str) -> Vec<TextEdit> {
        let tokens = || {
            let tokens = self.file.syntax().descendants_with_tokens();
            tokens.filter_map(SyntaxElement::into_token)
        };
        let names = |t: &SyntaxToken| {
            let parent = t.parent().map(|p| p.kind());
            t.text() == from && parent == Some(SyntaxKind::Constraint)
        };
        if tokens().filter(names).count() != 1 {
            return Vec::new();
        }
        let quoted = crate::write::quoted(from);
        let expects = |t: &SyntaxToken| {
            let parent = t.parent().map(|p| p.kind());
            t.kind() == SyntaxKind::Text && t.text() == quoted && parent == Some(SyntaxKind::Expect)
        };
        let renamed = |t: SyntaxToken| {
            let span = syntax::span_of_token(&t);
            TextEdit { span: Span::new(span.start + 1, span.end - 1), insert: to.to_string() }
        };
        tokens().filter(expects).map(renamed).collect()
    }

    pub(super) fn rename_words(
        &self,
        from: &str,
        to: &str,
        wanted: fn(&SyntaxToken) -> bool,
    ) -> Vec<TextEdit> {
        let tokens = self.file.syntax().descendants_with_tokens();
        tokens
            .filter_map(SyntaxElement::into_token)
            .filter(|t| t.kind() == SyntaxKind::Ident && t.text() == from && wanted(t))
            .map(|t| edit::rename(&t, to))
            .collect()
    }

    pub(super) fn must_be_new_class(&self, name: &str) -> Result<(), Diagnostic> {
        match self.lowered.document.class_named(name) {
            Some(_) => Err(refused("duplicate-name", format!("there is a class {name} already"))),
            None => Ok(()),
        }
    }
}

pub(crate) fn is_class_name(token: &SyntaxToken) -> bool {
    let Some(parent) = token.parent() else { return false };
    let is_use = parent.parent().is_some_and(|p| p.kind() == SyntaxKind::Use);
    match parent.kind() {
        SyntaxKind::Type | SyntaxKind::Class | SyntaxKind::CallExpr => true,
        SyntaxKind::DottedName => !is_use,
        // `Circle.tangent(…)`: what is before the dot
        SyntaxKind::NameExpr => parent.parent().is_some_and(|above| {
            above.kind() == SyntaxKind::FieldExpr && above.first_child() == Some(parent.clone())
        }),
        _ => false,
    }
}
