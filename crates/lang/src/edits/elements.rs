//! Elements of lists deleted: those behind move up.

use super::Restructuring;
use super::delete::{Deletion, is_gone, is_reference};
use crate::numbers::constant;
use crate::uses::{Text, refused};
use base::{Diagnostic, Name, Span};
use kernel::{ClassId, Literal, Path, Step};
use syntax::ast::{self, AstNode, Expr, Member, TypeShape};
use syntax::edit::{self, TextEdit};

impl Text<'_> {
    /// Deletes an element of a list that the document's own text declares.
    pub(super) fn delete_element(&self, path: &Path, i: u32) -> Result<Restructuring, Diagnostic> {
        let list = Path(path.0[..path.0.len() - 1].to_vec());
        if let Some((count, n)) = self.count_of_list(&list) {
            if f64::from(i) >= n {
                return Err(refused("index", format!("there is no {path}")));
            }
            let mut deletion = Deletion::new(self);
            let moved = self.move_up(&|of| *of == list, i, &mut deletion);
            deletion.edits.extend(moved);
            return Ok(self.with_count(&count, &Literal::Number(n - 1.0), deletion));
        }
        let (home, member, _) = self.declaration(&list)?;
        let Member::Part(part) = &member else { return Err(self.of_a_class(path)) };
        let count = part.class().and_then(|ty| match ty.shape() {
            TypeShape::List { count, .. } => count,
            TypeShape::Named(_) | TypeShape::Set(_) | TypeShape::Path(_) | TypeShape::Placed(_) => {
                None
            }
        });
        let mut edits = Vec::new();
        if let Some(count) = &count {
            let n = constant(&|_: &Expr| None, count).filter(|n| f64::from(i) < *n);
            let n = n.ok_or_else(|| refused("index", format!("there is no {path}")))?;
            edits.push(edit::replace(count.syntax(), &format!("{}", n - 1.0)));
        }
        if let Some(Expr::List(items)) = part.value().and_then(ast::Value::expr) {
            let items: Vec<Expr> = items.elements().collect();
            let kept = items.iter().enumerate().filter(|(k, _)| *k != i as usize);
            let kept: Vec<String> = kept.map(|(_, e)| e.syntax().text().to_string()).collect();
            let gone = items.get(i as usize).zip(items.first().zip(items.last()));
            let Some((_, (first, last))) = gone else {
                return Err(refused("index", format!("there is no {path}")));
            };
            let span = first.span().join(last.span());
            edits.push(TextEdit { span, insert: kept.join(", ") });
        }
        if edits.is_empty() {
            return Err(self.of_a_class(path));
        }
        let whose = self.declared_in(&list);
        let is_same = |of: &Path| whose.is_some() && self.declared_in(of) == whose;
        let mut deletion = Deletion::new(self);
        let moved = self.move_up(&is_same, i, &mut deletion);
        edits.extend(deletion.edits.into_iter().chain(moved));
        Ok(Restructuring { edits, along: deletion.along, ..self.implied_by(&home) })
    }

    /// Returns the class that declares what a path leads to, and its name there.
    fn declared_in(&self, path: &Path) -> Option<(ClassId, Name)> {
        let (Step::Part(name), owner) = path.0.split_last()? else { return None };
        let document = &self.lowered.document;
        let class = match owner {
            [] => document.root,
            owner => self.class_at(&Path(owner.to_vec()))?,
        };
        let declares = |c: &ClassId| document.classes[*c].parts.iter().any(|p| p.name == *name);
        Some((document.lineage(class).into_iter().find(declares)?, name.clone()))
    }

    /// Deletes what speaks of an element of the lists that are meant, and returns the edits by which
    /// those behind it are counted one less. A reference to it stays, and names nothing.
    fn move_up(
        &self,
        is_meant: &dyn Fn(&Path) -> bool,
        i: u32,
        deletion: &mut Deletion,
    ) -> Vec<TextEdit> {
        let mut moved = Vec::new();
        for index in self.file.syntax().descendants().filter_map(ast::IndexExpr::cast) {
            let of = index.receiver().and_then(|r| self.path_of(&r)).filter(is_meant);
            let at = self.path_of(&Expr::Index(index.clone()));
            let (Some(_), Some(at), Some(e)) = (of, at, index.index()) else { continue };
            match at.0.last() {
                Some(Step::Index(n)) if *n == i => self.forget_element(&index, deletion),
                Some(Step::Index(n)) if *n > i => {
                    moved.push(edit::replace(e.syntax(), &(n - 1).to_string()));
                }
                _ => {}
            }
        }
        self.forget_uses(deletion);
        moved.retain(|e| !is_gone(&deletion.edits, e.span));
        moved
    }

    /// Deletes what speaks of an element by an index.
    pub(super) fn forget_element(&self, index: &ast::IndexExpr, deletion: &mut Deletion) {
        let around = index.syntax().ancestors().find_map(Member::cast);
        let word = index.index().and_then(|e| e.syntax().first_token());
        let (Some(member), Some(word)) = (around, word) else { return };
        match target(&member) {
            Some(span) => deletion.edits.push(TextEdit { span, insert: String::new() }),
            None => self.forget(&word, deletion),
        }
    }
}

/// Returns what a reference says of what it names, if a member is one.
fn target(member: &Member) -> Option<Span> {
    match member {
        Member::Ref(reference) => {
            Some(Span::new(reference.class()?.span().end, reference.target()?.span().end))
        }
        Member::Part(part) if is_reference(part) => {
            Some(Span::new(part.class()?.span().end, part.value()?.span().end))
        }
        _ => None,
    }
}
