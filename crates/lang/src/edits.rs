//! Commands that change structure, as the smallest edits of the text.

use crate::lower::Lowered;
use crate::uses::{Text, refused};
use base::{Diagnostic, Span};
use kernel::{Command, Path, Step, Structure};
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::edit::{self, Spot, TextEdit};
use syntax::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};

/// Returns the edits of the text that a command is.
///
/// # Errors
/// Why the text cannot say it: a path that leads nowhere, something that is a class's to say, a
/// name that is taken.
pub fn edits_for(
    lowered: &Lowered,
    structure: &Structure,
    command: &Command,
) -> Result<Vec<TextEdit>, Diagnostic> {
    let text = Text::of(lowered);
    let edits = match command {
        Command::Merge(paths) => {
            for path in paths {
                must_lead(structure, path)?;
            }
            let paths: Vec<String> = paths.iter().map(ToString::to_string).collect();
            vec![text.add(SyntaxKind::Merge, &format!("merge {}", paths.join(" = ")))]
        }
        Command::Unmerge(path) => text.unmerge(path)?,
        Command::Delete(path) => text.delete(path)?,
        Command::Edit { target, members } => text.insert(target, members)?,
        Command::Rename { from, to } => text.rename(from, to)?,
        Command::Promote { path, class } => text.promote(path, class)?,
        Command::Anchor { path, held: true } => {
            must_lead(structure, path)?;
            if !text.lists(SyntaxKind::Anchor, path).is_empty() {
                return Err(refused("already-anchored", format!("{path} is anchored already")));
            }
            vec![text.add(SyntaxKind::Anchor, &format!("anchor {path}"))]
        }
        Command::Anchor { path, held: false } => text.let_go(path)?,
        Command::Enable { path, .. } => {
            let message = format!("switching {path} off and on is not supported yet");
            return Err(refused("not-yet", message));
        }
        Command::Set(_) | Command::Move(_) | Command::Text(_) | Command::Undo | Command::Redo => {
            Vec::new()
        }
    };
    let carry = |e: TextEdit| Some(TextEdit { span: lowered.in_text(e.span)?, insert: e.insert });
    let carried: Option<Vec<TextEdit>> = edits.into_iter().map(carry).collect();
    carried.ok_or_else(|| {
        let message = "a line that has an error would have to be changed".to_string();
        refused("wrong-line", message).hint("mend the line first")
    })
}

fn must_lead(structure: &Structure, path: &Path) -> Result<(), Diagnostic> {
    let nowhere = |_| refused("unknown-part", format!("{path} leads nowhere"));
    structure.follow(kernel::DOCUMENT, path).map(drop).map_err(nowhere)
}

impl Text<'_> {
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

    /// Adds members to the document, to a class, or to the body of a thing.
    fn insert(&self, target: &Path, members: &str) -> Result<Vec<TextEdit>, Diagnostic> {
        if target.is_empty() {
            return Ok(vec![edit::insert_member(
                &Spot::EndOf(self.file.syntax().clone()),
                members,
            )]);
        }
        if let Some(class) = self.class(target) {
            return Ok(vec![edit::insert_member(&Spot::EndOf(class.syntax().clone()), members)]);
        }
        let (part, word) = self.declaration(target)?;
        let Some(gone) = edit::delete_name(&word.token) else {
            return Ok(vec![edit::insert_member(&Spot::EndOf(part.syntax().clone()), members)]);
        };
        // one of several names: it gets a declaration of its own
        let shared = part.class().map_or(part.span(), |class| class.span());
        let shared = Span::new(shared.start, part.span().end);
        let shared = self.source(shared);
        let (before, body) = match part.body() {
            Some(body) => {
                let body = body.syntax().text().to_string();
                let before = shared.strip_suffix(&body).unwrap_or(&shared).trim_end().to_string();
                (before, body.trim_end_matches('}').trim_end().to_string())
            }
            None => (shared, "{".to_string()),
        };
        let own = format!("{}: {before} {body} {members} }}", word.text());
        Ok(vec![gone, edit::insert_member(&Spot::After(part.syntax().clone()), &own)])
    }

    fn source(&self, span: Span) -> String {
        self.lowered.effective.get(span.range()).unwrap_or_default().trim_end().to_string()
    }

    /// Returns the members of one kind, in the document and in bodies, that list a path.
    fn lists(&self, kind: SyntaxKind, path: &Path) -> Vec<SyntaxNode> {
        let members = self.file.syntax().descendants().filter(|n| n.kind() == kind);
        let names = |n: &SyntaxNode| {
            let mut paths = n.children().filter_map(Expr::cast);
            let in_check = n.ancestors().any(|a| a.kind() == SyntaxKind::Check);
            !in_check && paths.any(|e| self.leads_to(&e, path))
        };
        members.filter(names).collect()
    }

    fn unmerge(&self, path: &Path) -> Result<Vec<TextEdit>, Diagnostic> {
        let members = self.lists(SyntaxKind::Merge, path);
        if members.is_empty() {
            let message = format!("no merge of the document names {path}");
            let d = refused("not-merged", message);
            return Err(d.hint("what a class merges is masked by `without NAME` in a body"));
        }
        let stays = |e: &Expr| !self.leads_to(e, path);
        Ok(members.iter().flat_map(|m| shortened(m, &stays)).collect())
    }

    fn let_go(&self, path: &Path) -> Result<Vec<TextEdit>, Diagnostic> {
        let members = self.lists(SyntaxKind::Anchor, path);
        if members.is_empty() {
            let message =
                format!("{path} is not anchored by the document itself, but by its class");
            return Err(refused("not-anchored", message));
        }
        let stays = |e: &Expr| !self.leads_to(e, path);
        Ok(members.iter().flat_map(|m| shortened(m, &stays)).collect())
    }

    /// Deletes a part, and every member that speaks of it.
    fn delete(&self, path: &Path) -> Result<Vec<TextEdit>, Diagnostic> {
        let (part, word) = self.declaration(path)?;
        let gone = match edit::delete_name(&word.token) {
            Some(edit) => edit,
            None => edit::delete_member(part.syntax()),
        };
        let mut edits = vec![gone];
        let whole = edits[0].insert.is_empty() && part.names().count() == 1;
        self.forget(self.file.members(), path, whole.then(|| part.syntax()), &mut edits);
        Ok(self.joined(edits))
    }

    /// Joins deletions that overlap, as those of neighbours on one line do.
    fn joined(&self, mut edits: Vec<TextEdit>) -> Vec<TextEdit> {
        edits.sort_by_key(|e| e.span);
        let mut joined: Vec<TextEdit> = Vec::new();
        for edit in edits {
            match joined.last_mut().filter(|last| edit.span.start < last.span.end) {
                Some(last) => {
                    last.span = last.span.join(edit.span);
                    let before = self.lowered.effective.get(..last.span.start as usize);
                    let divided = before.is_some_and(|b| b.ends_with(char::is_whitespace));
                    last.insert = if divided { String::new() } else { edit.insert };
                }
                None => joined.push(edit),
            }
        }
        joined
    }

    /// Takes what speaks of a thing out of members; `gone` is deleted already.
    fn forget(
        &self,
        members: impl Iterator<Item = Member>,
        path: &Path,
        gone: Option<&SyntaxNode>,
        edits: &mut Vec<TextEdit>,
    ) {
        for member in members {
            let node = member.syntax();
            if gone == Some(node) || self.uses(node, path).is_empty() {
                continue;
            }
            match &member {
                Member::Part(part) => {
                    let value = part.value().filter(|v| !self.uses(v.syntax(), path).is_empty());
                    if let (Some(value), Some(class)) = (value, part.class()) {
                        let span = Span::new(class.span().end, value.span().end);
                        edits.push(TextEdit { span, insert: String::new() });
                    }
                    let inner = part.body().into_iter().flat_map(|b| b.members());
                    let inner: Vec<Member> = inner.collect();
                    self.forget(inner.into_iter(), path, gone, edits);
                }
                Member::For(each) => {
                    let inner: Vec<Member> =
                        each.body().into_iter().flat_map(|b| b.members()).collect();
                    self.forget(inner.into_iter(), path, gone, edits);
                }
                Member::Merge(_) | Member::Stay(_) | Member::Anchor(_) | Member::Attachers(_) => {
                    let stays = |e: &Expr| self.uses(e.syntax(), path).is_empty();
                    edits.extend(shortened(node, &stays));
                }
                Member::Constraint(_) | Member::Assign(_) | Member::Insert(_) => {
                    edits.push(edit::delete_member(node));
                }
                // what a message or a check says of it is an error then, and refuses the deletion
                _ => {}
            }
        }
    }

    fn rename(&self, from: &Path, to: &str) -> Result<Vec<TextEdit>, Diagnostic> {
        must_be_name(to)?;
        if let Some(class) = self.class(from) {
            self.must_be_new_class(to)?;
            let word = class.name().expect("a class was found by its name");
            return Ok(self.rename_words(word.text(), to, is_class_name));
        }
        let (owner, last) = match from.0.split_last() {
            Some((last, owner)) => (Path(owner.to_vec()), last.clone()),
            None => return Err(refused("unknown-part", "the document has no name".into())),
        };
        let document = &self.lowered.document;
        let taken = owner.then(Step::Part(to.into()));
        if crate::names::class_at(document, document.root, &taken).is_some() {
            return Err(refused("duplicate-name", format!("there is a part {taken} already")));
        }
        if let Some(rule) = self.rule(&owner, &last) {
            return Ok(vec![edit::rename(&rule.token, to)]);
        }
        let (_, word) = self.declaration(from)?;
        let mut edits = vec![edit::rename(&word.token, to)];
        for e in self.uses(self.file.syntax(), from) {
            let named = match &e {
                Expr::Name(name) => name.name(),
                Expr::Field(field) => field.name(),
                _ => None,
            };
            edits.extend(named.map(|word| edit::rename(&word.token, to)));
        }
        Ok(edits)
    }

    /// Finds the name of a constraint or merge of the document or of a body.
    fn rule(&self, owner: &Path, last: &Step) -> Option<ast::Word> {
        let Step::Part(name) = last else { return None };
        let members: Vec<Member> = match self.declaration(owner) {
            Ok((part, _)) => part.body().into_iter().flat_map(|b| b.members()).collect(),
            Err(_) if owner.is_empty() => self.file.members().collect(),
            Err(_) => return None,
        };
        let word = |m: &Member| match m {
            Member::Constraint(c) => c.name(),
            Member::Merge(m) => m.name(),
            _ => None,
        };
        members.iter().filter_map(word).find(|w| w.name() == *name)
    }

    fn rename_words(
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

    fn must_be_new_class(&self, name: &str) -> Result<(), Diagnostic> {
        match self.lowered.document.class_named(name) {
            Some(_) => Err(refused("duplicate-name", format!("there is a class {name} already"))),
            None => Ok(()),
        }
    }

    /// Gives a thing's class of one a name of its own.
    fn promote(&self, path: &Path, class: &str) -> Result<Vec<TextEdit>, Diagnostic> {
        must_be_name(class)?;
        self.must_be_new_class(class)?;
        let (part, word) = self.declaration(path)?;
        let (Some(ty), Some(body)) = (part.class(), part.body()) else {
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
            TextEdit { span: whole, insert: self.named_instead(&part, class) },
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

/// Returns the edits that leave in a member's list of paths only those that stay.
fn shortened(member: &SyntaxNode, stays: &dyn Fn(&Expr) -> bool) -> Vec<TextEdit> {
    let paths: Vec<Expr> = member.children().filter_map(Expr::cast).collect();
    let kept: Vec<String> =
        paths.iter().filter(|e| stays(e)).map(|e| e.syntax().text().to_string()).collect();
    let (least, between) = if member.kind() == SyntaxKind::Merge { (2, " = ") } else { (1, ", ") };
    match (paths.first(), paths.last()) {
        (Some(first), Some(last)) if kept.len() >= least => {
            let span = first.span().join(last.span());
            vec![TextEdit { span, insert: kept.join(between) }]
        }
        _ => vec![edit::delete_member(member)],
    }
}

fn must_be_name(name: &str) -> Result<(), Diagnostic> {
    let inner = |c: char| c.is_alphanumeric() || c == '_';
    let plain =
        name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.chars().all(inner);
    match plain && SyntaxKind::reserved(name).is_none() {
        true => Ok(()),
        false => Err(refused("not-a-name", format!("`{name}` is no name"))),
    }
}

fn is_class_name(token: &SyntaxToken) -> bool {
    let Some(parent) = token.parent() else { return false };
    let is_use = parent.parent().is_some_and(|p| p.kind() == SyntaxKind::Use);
    match parent.kind() {
        SyntaxKind::Type | SyntaxKind::Class | SyntaxKind::CallExpr => true,
        SyntaxKind::DottedName => !is_use,
        _ => false,
    }
}
