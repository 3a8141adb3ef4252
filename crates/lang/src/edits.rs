//! Commands that change structure, as the smallest edits of the text.

use crate::lower::{Lowered, OWN};
use crate::paths::loose_path;
use crate::write::in_text;
use base::{Diagnostic, Place, Span};
use kernel::{Command, Path, Step, Structure};
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::edit::{self, Spot, TextEdit};
use syntax::{SyntaxKind, SyntaxNode};

/// Returns the edits of the text that a command is.
///
/// # Errors
/// Why the text cannot say it: a path that leads nowhere, something that is a class's to say.
pub fn edits_for(
    lowered: &Lowered,
    structure: &Structure,
    command: &Command,
) -> Result<Vec<TextEdit>, Diagnostic> {
    let text = Text { lowered, file: syntax::parse(OWN, &lowered.effective).file() };
    let edits = match command {
        Command::Merge(paths) => {
            for path in paths {
                text.must_lead(structure, path)?;
            }
            let paths: Vec<String> = paths.iter().map(ToString::to_string).collect();
            vec![text.add(SyntaxKind::Merge, &format!("merge {}", paths.join(" = ")))]
        }
        Command::Unmerge(path) => text.unmerge(path)?,
        Command::Delete(path) => text.delete(path)?,
        Command::Edit { target, members } => {
            vec![edit::insert_member(&Spot::EndOf(text.body_for(target)?), members)]
        }
        Command::Rename { from, to } => text.rename(from, to)?,
        Command::Promote { path, class } => text.promote(path, class)?,
        Command::Anchor { path, held: true } => {
            text.must_lead(structure, path)?;
            vec![text.add(SyntaxKind::Anchor, &format!("anchor {path}"))]
        }
        Command::Anchor { path, held: false } => text.let_go(path)?,
        Command::Enable { path, .. } => {
            let message = format!("switching {path} off and on is not supported yet");
            return Err(wrong("not-yet", message));
        }
        Command::Set(_) | Command::Move(_) | Command::Text(_) | Command::Undo | Command::Redo => {
            Vec::new()
        }
    };
    Ok(in_text(lowered, edits))
}

fn wrong(code: &'static str, message: String) -> Diagnostic {
    Diagnostic::error(code, Place { file: OWN, span: Span::default() }, message)
}

struct Text<'l> {
    lowered: &'l Lowered,
    file: ast::File,
}

impl Text<'_> {
    fn must_lead(&self, structure: &Structure, path: &Path) -> Result<(), Diagnostic> {
        let nowhere = |_| wrong("unknown-part", format!("{path} leads nowhere"));
        structure.follow(kernel::DOCUMENT, path).map(drop).map_err(nowhere)
    }

    /// Adds a member after the last of its kind, or at the end before any checks.
    fn add(&self, kind: SyntaxKind, member: &str) -> TextEdit {
        let members: Vec<Member> = self.file.members().collect();
        let last = members.iter().rfind(|m| m.syntax().kind() == kind);
        let before_checks = members.iter().rfind(|m| !matches!(m, Member::Check(_)));
        let spot = match last.or(before_checks) {
            Some(member) => Spot::After(member.syntax().clone()),
            None => Spot::EndOf(self.file.syntax().clone()),
        };
        edit::insert_member(&spot, member)
    }

    /// Takes a path out of every member of one kind that lists it.
    fn without_path(&self, kind: SyntaxKind, path: &Path, least: usize) -> Vec<TextEdit> {
        let mut edits = Vec::new();
        for member in self.file.members().filter(|m| m.syntax().kind() == kind) {
            let paths: Vec<Expr> = member.syntax().children().filter_map(Expr::cast).collect();
            let named = |e: &Expr| loose_path(e).as_ref() == Some(path);
            let Some(i) = paths.iter().position(named) else { continue };
            if paths.len() <= least {
                edits.push(edit::delete_member(member.syntax()));
                continue;
            }
            // with the sign that divides it from its neighbour
            let (from, to) = match i {
                0 => (paths[0].span().start, paths[1].span().start),
                _ => (paths[i - 1].span().end, paths[i].span().end),
            };
            edits.push(TextEdit { span: Span::new(from, to), insert: String::new() });
        }
        edits
    }

    fn unmerge(&self, path: &Path) -> Result<Vec<TextEdit>, Diagnostic> {
        let edits = self.without_path(SyntaxKind::Merge, path, 2);
        if edits.is_empty() {
            let message = format!("no merge of the document names {path}");
            return Err(wrong("not-merged", message));
        }
        Ok(edits)
    }

    fn let_go(&self, path: &Path) -> Result<Vec<TextEdit>, Diagnostic> {
        let edits = self.without_path(SyntaxKind::Anchor, path, 1);
        if edits.is_empty() {
            let message =
                format!("{path} is not anchored by the document itself, but by its class");
            return Err(wrong("not-anchored", message));
        }
        Ok(edits)
    }

    /// Finds the part of this name at the top of the document.
    fn part(&self, path: &Path) -> Result<(ast::Part, ast::Word), Diagnostic> {
        let [Step::Part(name)] = path.0.as_slice() else {
            let message = format!(
                "{path} belongs to a class: only the document's own parts can be changed so far"
            );
            return Err(wrong("not-yet", message));
        };
        for member in self.file.members() {
            let Member::Part(part) = member else { continue };
            if let Some(word) = part.names().find(|w| w.name() == *name) {
                return Ok((part, word));
            }
        }
        Err(wrong("unknown-part", format!("the document has no part {path}")))
    }

    fn class(&self, path: &Path) -> Option<ast::Class> {
        let [Step::Part(name)] = path.0.as_slice() else { return None };
        self.file.members().find_map(|m| match m {
            Member::Class(c) if c.name().is_some_and(|w| w.name() == *name) => Some(c),
            _ => None,
        })
    }

    fn body_for(&self, target: &Path) -> Result<SyntaxNode, Diagnostic> {
        if target.is_empty() {
            return Ok(self.file.syntax().clone());
        }
        match self.class(target) {
            Some(class) => Ok(class.syntax().clone()),
            None => Ok(self.part(target)?.0.syntax().clone()),
        }
    }

    /// Deletes a part, and every member of the document that speaks of it.
    fn delete(&self, path: &Path) -> Result<Vec<TextEdit>, Diagnostic> {
        let (part, word) = self.part(path)?;
        let gone = match edit::delete_name(&word.token) {
            Some(edit) => edit,
            None => edit::delete_member(part.syntax()),
        };
        let mut edits = vec![gone];
        for member in self.file.members() {
            let own = matches!(member, Member::Class(_) | Member::Check(_));
            if own || member.syntax() == part.syntax() || !speaks_of(member.syntax(), word.text()) {
                continue;
            }
            let paths: Vec<Expr> = member.syntax().children().filter_map(Expr::cast).collect();
            let stays = paths.iter().filter(|p| !speaks_of(p.syntax(), word.text())).count();
            match &member {
                Member::Merge(merge) if stays >= 2 => {
                    let text: Vec<String> = paths
                        .iter()
                        .filter(|p| !speaks_of(p.syntax(), word.text()))
                        .map(|p| p.syntax().text().to_string())
                        .collect();
                    let name = merge.name().map_or_else(String::new, |n| format!("{}: ", n.text()));
                    let text = format!("merge {name}{}", text.join(" = "));
                    edits.push(edit::replace(member.syntax(), &text));
                }
                _ => edits.push(edit::delete_member(member.syntax())),
            }
        }
        Ok(edits)
    }

    fn rename(&self, from: &Path, to: &str) -> Result<Vec<TextEdit>, Diagnostic> {
        let name = |c: char| c.is_alphanumeric() || c == '_';
        let plain = to.starts_with(|c: char| c.is_alphabetic() || c == '_') && to.chars().all(name);
        if !plain || SyntaxKind::reserved(to).is_some() {
            return Err(wrong("not-a-name", format!("`{to}` is no name")));
        }
        if let Some(class) = self.class(from) {
            let word = class.name().expect("a class was found by its name");
            return Ok(self.rename_words(word.text(), to, is_class_name));
        }
        let (_, word) = self.part(from)?;
        let taken = self.lowered.document.layout(self.lowered.document.root);
        if taken.iter().any(|&f| *self.lowered.document.field_name(f) == *to) {
            return Err(wrong("duplicate-name", format!("there is a part {to} already")));
        }
        let mut edits = self.rename_words(word.text(), to, is_root_name);
        edits.push(edit::rename(&word.token, to));
        Ok(edits)
    }

    fn rename_words(
        &self,
        from: &str,
        to: &str,
        wanted: fn(&syntax::SyntaxToken) -> bool,
    ) -> Vec<TextEdit> {
        let tokens = self.file.syntax().descendants_with_tokens();
        tokens
            .filter_map(syntax::SyntaxElement::into_token)
            .filter(|t| t.kind() == SyntaxKind::Ident && t.text() == from && wanted(t))
            .map(|t| edit::rename(&t, to))
            .collect()
    }

    /// Gives a thing's class of one a name of its own.
    fn promote(&self, path: &Path, class: &str) -> Result<Vec<TextEdit>, Diagnostic> {
        let (part, _) = self.part(path)?;
        let (Some(ty), Some(body)) = (part.class(), part.body()) else {
            let message = format!("{path} has no body that could become a class");
            return Err(wrong("not-a-class-of-one", message));
        };
        let (above, text) = (ty.syntax().text().to_string(), body.syntax().text().to_string());
        let declared = format!("class {class} is {above} {text}");
        let whole = Span::new(ty.span().start, body.span().end);
        Ok(vec![
            edit::insert_member(&Spot::Before(part.syntax().clone()), &declared),
            TextEdit { span: whole, insert: class.to_string() },
        ])
    }
}

/// Returns true if an expression in the node begins with this name.
fn speaks_of(node: &SyntaxNode, name: &str) -> bool {
    let names = node.descendants().filter(|n| n.kind() == SyntaxKind::NameExpr);
    names.into_iter().any(|n| n.text() == name)
}

fn is_class_name(token: &syntax::SyntaxToken) -> bool {
    let parent = token.parent().map(|p| p.kind());
    matches!(
        parent,
        Some(SyntaxKind::Type | SyntaxKind::Class | SyntaxKind::CallExpr | SyntaxKind::DottedName)
    )
}

/// Names at the document's own level and in its checks; those in classes are other names.
fn is_root_name(token: &syntax::SyntaxToken) -> bool {
    let in_class = token.parent_ancestors().any(|n| n.kind() == SyntaxKind::Class);
    token.parent().is_some_and(|p| p.kind() == SyntaxKind::NameExpr) && !in_class
}
