//! Counts set: how many parts there are, and what speaks of those that go.

use super::Restructuring;
use super::delete::Deletion;
use crate::lower::Lowered;
use crate::numbers::constant;
use crate::uses::{Text, refused};
use crate::write::{Digits, value_edits};
use base::Diagnostic;
use kernel::{ClassId, Literal, Path, Step};
use syntax::ast::{self, AstNode, Expr, TypeShape, span_without_doc};
use syntax::edit::{self, TextEdit};

/// Returns true if a path leads to a whole number that says how many parts a thing has.
pub fn is_count(lowered: &Lowered, path: &Path) -> bool {
    count_at(lowered, path).is_some()
}

fn count_at(lowered: &Lowered, path: &Path) -> Option<i64> {
    let (Step::Part(name), owner) = path.0.split_last()? else { return None };
    let class = lowered.class_at(lowered.document.root, &Path(owner.to_vec()))?;
    lowered.document.count(class, name)
}

impl Text<'_> {
    /// Gives a thing another count. What speaks of elements that its lists no longer have goes along.
    pub(super) fn set_count(
        &self,
        path: &Path,
        value: &Literal,
    ) -> Result<Restructuring, Diagnostic> {
        let number = match value {
            Literal::Number(x) if x.fract() == 0.0 && (0.0..4e9).contains(x) => *x,
            Literal::Bool(b) => f64::from(*b),
            _ => {
                let message =
                    format!("{path} says how many parts there are: a whole number, not negative");
                return Err(refused("not-a-count", message));
            }
        };
        let mut deletion = Deletion::new(self);
        for index in self.file.syntax().descendants().filter_map(ast::IndexExpr::cast) {
            let Some(at) = self.path_of(&Expr::Index(index.clone())) else { continue };
            let Some((Step::Index(i), list)) = at.0.split_last() else { continue };
            if self.count_with(list, path, number).is_some_and(|count| f64::from(*i) >= count) {
                self.forget_element(&index, &mut deletion);
            }
        }
        self.forget_uses(&mut deletion);
        Ok(self.with_count(path, value, deletion))
    }

    /// Returns the count that decides how many elements a list has, where it is that alone.
    pub(super) fn count_of_list(&self, list: &Path) -> Option<(Path, f64)> {
        let (Step::Part(_), owner) = list.0.split_last()? else { return None };
        let Expr::Name(name) = self.declared_count(list)? else { return None };
        let count = Path(owner.to_vec()).then(Step::Part(name.name()?.name()));
        let n = count_at(self.lowered, &count)?;
        Some((count, n as f64))
    }

    /// Writes a count, and deletes what goes along.
    pub(super) fn with_count(
        &self,
        path: &Path,
        value: &Literal,
        deletion: Deletion,
    ) -> Restructuring {
        let mut edits = deletion.edits;
        for new in value_edits(self.lowered, &[(path.clone(), value.clone())], Digits::All) {
            let around =
                |e: &&mut TextEdit| e.span.start <= new.span.start && new.span.end <= e.span.end;
            match edits.iter_mut().find(around) {
                None => edits.push(new),
                // it stands where what goes along stood
                Some(gone) if new.span.range().is_empty() => {
                    *gone = edit::instead(&self.lowered.effective, gone, &new);
                }
                Some(_) => {}
            }
        }
        Restructuring { edits, along: deletion.along, ..Restructuring::default() }
    }

    /// Returns how many elements a list would have, if a count of the same thing were another number.
    fn count_with(&self, list: &[Step], path: &Path, number: f64) -> Option<f64> {
        let (Step::Part(of), owner) = path.0.split_last()? else { return None };
        let (Step::Part(_), around) = list.split_last()? else { return None };
        let class = (owner == around).then(|| self.class_at(&Path(owner.to_vec())))??;
        let named = |e: &Expr| {
            let Expr::Name(name) = e else { return None };
            let name = name.name()?.name();
            let known = || self.lowered.document.count(class, &name).map(|n| n as f64);
            if name == *of { Some(number) } else { known() }
        };
        constant(&named, &self.declared_count(&Path(list.to_vec()))?)
    }

    /// Returns what is written for how many elements a list has.
    fn declared_count(&self, list: &Path) -> Option<Expr> {
        let (Step::Part(name), owner) = list.0.split_last()? else { return None };
        let document = &self.lowered.document;
        let declared = |c: ClassId| {
            let part = document.classes[c].parts.iter().find(|p| p.name == *name)?;
            Some(self.lowered.origins.place(part.origin))
        };
        let line = document.primary_line(self.class_at(&Path(owner.to_vec()))?);
        let place = line.into_iter().find_map(declared)?;
        let own = place.file == crate::lower::OWN;
        let file =
            if own { self.file.clone() } else { self.lowered.files[place.file].parse.file() };
        let word = syntax::token_from(file.syntax(), place.span.start)?;
        let parts = word.parent_ancestors().filter_map(ast::Part::cast);
        let mut at = parts.filter(|p| span_without_doc(p.syntax()) == place.span);
        match at.next()?.class()?.shape() {
            TypeShape::List { count, .. } => count,
            TypeShape::Named(_) | TypeShape::Set(_) | TypeShape::Path(_) | TypeShape::Placed(_) => {
                None
            }
        }
    }
}
