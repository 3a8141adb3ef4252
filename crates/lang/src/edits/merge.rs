//! Merges made and undone.

use super::home::{Home, common_owner};
use super::{Restructuring, shortened};
use crate::uses::{Text, refused};
use base::{Diagnostic, Name};
use kernel::{Merge, Path, Step};
use syntax::SyntaxKind;
use syntax::ast::Expr;

impl Text<'_> {
    /// Merges parts, in the body of the thing that has them all.
    pub(super) fn merge(&self, paths: &[Path]) -> Restructuring {
        let home = self.home(&common_owner(paths)).unwrap_or_else(|_| Home::document(self));
        let n = home.path.0.len();
        let paths: Vec<String> =
            paths.iter().map(|p| Path(p.0[n..].to_vec()).to_string()).collect();
        self.said_in(&home, SyntaxKind::Merge, &format!("merge {}", paths.join(" = ")))
    }

    /// Takes a path out of the merges that name it; the rest stay merged.
    pub(super) fn unmerge(&self, path: &Path) -> Result<Restructuring, Diagnostic> {
        let members = self.lists(SyntaxKind::Merge, path);
        let stays = |e: &Expr| !self.leads_to(e, path);
        let mut done = Restructuring::from(
            members.iter().flat_map(|m| shortened(m, &stays)).collect::<Vec<_>>(),
        );
        if let Some((class, _)) = self.prototype(path) {
            done.class = Some(class);
        }
        let inherited = self.unmerge_inherited(path, &mut done)?;
        if members.is_empty() && !inherited {
            let message = format!("no merge names {path}");
            let d = refused("not-merged", message);
            return Err(d.hint("wholes that are merged have to be unmerged as wholes"));
        }
        Ok(done)
    }

    /// Masks the merges of classes that name a path, at the thing that has them.
    fn unmerge_inherited(&self, path: &Path, done: &mut Restructuring) -> Result<bool, Diagnostic> {
        let mut found = false;
        for n in (0..path.0.len()).rev() {
            let (owner, rest) = (Path(path.0[..n].to_vec()), Path(path.0[n..].to_vec()));
            let Some(class) = self.class_at(&owner) else { continue };
            let document = &self.lowered.document;
            let own = self.home(&owner).ok().filter(|home| home.path == owner);
            let above = document.primary_line(class).into_iter();
            let above =
                above.skip(usize::from(!own.as_ref().is_some_and(|h| self.is_inherited(h))));
            let merges: Vec<Merge> = above
                .flat_map(|c| document.classes[c].merges.iter())
                .filter(|m| m.paths.contains(&rest))
                .cloned()
                .collect();
            if merges.is_empty() {
                continue;
            }
            let Some(home) = own else {
                return Err(self.of_a_class(path));
            };
            let mut members = Vec::new();
            for merge in merges {
                let name = self.name_of_merge(&merge, done)?;
                members.push(format!("without {name}"));
                let others: Vec<String> =
                    merge.paths.iter().filter(|p| **p != rest).map(ToString::to_string).collect();
                if others.len() > 1 {
                    members.push(format!("merge {}", others.join(" = ")));
                }
            }
            let said = self.said_in(&home, SyntaxKind::Merge, &members.join("  "));
            done.edits.extend(said.edits);
            done.class_of_one = said.class_of_one;
            done.class = done.class.or(said.class);
            found = true;
        }
        Ok(found)
    }

    /// Returns true for a body whose thing is plain: everything it has comes from its class.
    fn is_inherited(&self, home: &Home) -> bool {
        self.implied_by(home).class_of_one.is_some()
    }

    /// Returns the name of a merge; one without gets one where it is written, so that it can be masked.
    fn name_of_merge(&self, merge: &Merge, done: &mut Restructuring) -> Result<Name, Diagnostic> {
        if let Some(name) = &merge.name {
            return Ok(name.clone());
        }
        let last = merge.paths.iter().rev().find_map(|p| match p.0.last() {
            Some(Step::Part(name)) => Some(name.to_string()),
            Some(Step::Index(_) | Step::Last | Step::Owner) | None => None,
        });
        let base = last.unwrap_or_else(|| "joint".to_string());
        self.name_given(merge.origin, "merge", &base, done)
    }
}
