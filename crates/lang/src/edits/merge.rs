//! Merges made and undone.

use super::Restructuring;
use super::home::{Home, Site, common_owner};
use crate::lower::OWN;
use crate::uses::{Text, refused};
use base::{Diagnostic, Name, Place};
use indexmap::{IndexMap, IndexSet};
use kernel::{ClassId, Merge, Path, Step};
use syntax::ast::{AstNode, Expr, Member, span_without_doc};
use syntax::edit::{self, Spot, TextEdit};
use syntax::{SyntaxKind, SyntaxNode};

/// The members that bodies have to say, by the paths of their things: a body is opened once.
type Sayings = IndexMap<Path, (Home, Vec<String>)>;

fn saying(said: &mut Sayings, home: Home) -> &mut Vec<String> {
    let known = said.entry(home.path.clone()).or_insert_with(|| (home, Vec::new()));
    &mut known.1
}

impl Text<'_> {
    /// Merges parts, in the body of the thing that has them all.
    pub(super) fn merge(&self, paths: &[Path]) -> Restructuring {
        let (home, member) = self.merge_at_home(paths);
        self.said_in(&home, SyntaxKind::Merge, &member)
    }

    /// Returns the body that has to say that parts are merged, and what it says.
    fn merge_at_home(&self, paths: &[Path]) -> (Home, String) {
        let home = self.home(&common_owner(paths)).unwrap_or_else(|_| Home::document(self));
        let member = merging(paths.iter().map(|p| home.within(p)));
        (home, member)
    }

    /// Takes a path out of the merges that name it; the rest of them all stay merged.
    pub(super) fn unmerge(&self, path: &Path) -> Result<Restructuring, Diagnostic> {
        let mut members = self.lists(SyntaxKind::Merge, path);
        members.retain(|m| outermost_loop(m).is_none());
        let mut done = Restructuring::default();
        // what each body says of the path in its merges; of these things one each
        let mut left: Vec<Path> = Vec::new();
        left.extend(self.disconnect(path, &mut done.edits));
        let mut members = members.into_iter().peekable();
        let is_named = members.peek().is_some() || !left.is_empty();
        while let Some(member) = members.next() {
            let mut together = vec![member];
            while let Some(next) = members.next_if(|m| m.parent() == together[0].parent()) {
                together.push(next);
            }
            left.extend(self.parted(&together, path, &mut done.edits));
        }
        if let Some((class, _)) = self.prototype(path) {
            done.class = Some(class);
        }
        let before = left.len();
        self.unmerge_repeated(path, &mut done, &mut left);
        let mut said = Sayings::new();
        self.unmerge_inherited(path, &mut done, &mut left, &mut said)?;
        if !is_named && left.len() == before {
            return Err(self.not_merged(path));
        }
        let ends: IndexSet<Path> = left.into_iter().collect();
        if ends.len() > 1 {
            let ends: Vec<Path> = ends.into_iter().collect();
            let (home, member) = self.merge_at_home(&ends);
            saying(&mut said, home).push(member);
        }
        for (home, members) in said.into_values() {
            let divider = if matches!(home.site, Site::Document(_)) { "\n" } else { "  " };
            let said = self.said_in(&home, SyntaxKind::Merge, &members.join(divider));
            done.edits.extend(said.edits);
            done.class_of_one = done.class_of_one.or(said.class_of_one);
            done.class = done.class.or(said.class);
        }
        Ok(done)
    }

    /// Takes a path out of the merges of one body, which become one; returns what is left of them.
    fn parted(
        &self,
        merges: &[SyntaxNode],
        path: &Path,
        edits: &mut Vec<TextEdit>,
    ) -> Option<Path> {
        let listed = |m: &SyntaxNode| m.children().filter_map(Expr::cast).collect::<Vec<_>>();
        let mut kept: Vec<Expr> = merges.iter().flat_map(listed).collect();
        let mut said: IndexSet<Path> = IndexSet::new();
        kept.retain(|e| {
            !self.leads_to(e, path) && self.path_of(e).is_none_or(|path| said.insert(path))
        });
        let first = kept.first().and_then(|e| self.path_of(e));
        let (one, others) = merges.split_first()?;
        edits.extend(others.iter().map(edit::delete_member));
        let all = listed(one);
        edits.push(match (all.first(), all.last()) {
            (Some(first), Some(last)) if kept.len() > 1 => {
                let kept: Vec<String> =
                    kept.iter().map(|e| e.syntax().text().to_string()).collect();
                let span = first.span().join(last.span());
                TextEdit { span, insert: kept.join(" = ") }
            }
            _ => edit::delete_member(one),
        });
        first
    }

    /// Writes out the merges that a `for` makes of a path, where it is in the body of what has them.
    fn unmerge_repeated(&self, path: &Path, done: &mut Restructuring, left: &mut Vec<Path>) {
        let document = &self.lowered.document;
        for n in (0..path.0.len()).rev() {
            let (owner, rest) = (Path(path.0[..n].to_vec()), Path(path.0[n..].to_vec()));
            let home = self.home(&owner).ok().filter(|home| home.path == owner);
            let Some((class, home)) = self.class_at(&owner).zip(home) else { continue };
            let merges = &document.classes[class].merges;
            if self.is_inherited(&home) || !merges.iter().any(|m| m.paths.contains(&rest)) {
                continue;
            }
            let members = home.members();
            let loops = members.iter().filter(|m| matches!(m, Member::For(_)));
            for each in loops.map(AstNode::syntax) {
                let written: Vec<SyntaxNode> =
                    each.descendants().filter(|n| n.kind() == SyntaxKind::Merge).collect();
                let made_by = |node: &SyntaxNode| {
                    let place = Place { file: OWN, span: span_without_doc(node) };
                    let made =
                        merges.iter().filter(|m| self.lowered.origins.place(m.origin) == place);
                    made.collect::<Vec<&Merge>>()
                };
                let (mut gone, mut said) = (Vec::new(), Vec::new());
                let mut kept: IndexSet<&Path> = IndexSet::new();
                for node in written {
                    let made = made_by(&node);
                    if !made.iter().any(|m| m.paths.contains(&rest)) {
                        continue;
                    }
                    let (of_path, others): (Vec<&Merge>, Vec<&Merge>) =
                        made.iter().partition(|m| m.paths.contains(&rest));
                    said.extend(others.iter().map(|m| merging(&m.paths)));
                    kept.extend(of_path.iter().flat_map(|m| &m.paths).filter(|p| **p != rest));
                    gone.push(node);
                }
                if gone.is_empty() {
                    continue;
                }
                if kept.len() > 1 {
                    said.push(merging(&kept));
                }
                left.extend(kept.first().map(|&p| owner.join(p)));
                done.edits.extend(written_out(each, &gone, &said));
            }
        }
    }

    /// Says why nothing can be taken out of a merge: by what it is merged, if it is.
    fn not_merged(&self, path: &Path) -> Diagnostic {
        if let Some(merge) = self.merges_of(path).next() {
            let said = self.lowered.source_of(merge.origin);
            let d = refused("not-merged", format!("`{said}` is not said of {path} alone"));
            return d.hint("give its thing a declaration of its own, then it can be taken out");
        }
        let d = refused("not-merged", format!("no merge names {path}"));
        let whole = (1..path.0.len()).rev().map(|n| Path(path.0[..n].to_vec()));
        let mut whole = whole.filter(|p| self.merges_of(p).next().is_some());
        match whole.next() {
            Some(whole) => d.hint(format!("it is a part of {whole}, which is merged as a whole")),
            None => {
                d.hint("it is not merged with anything, or only by a whole that it is a part of")
            }
        }
    }

    /// Returns the merges of the text and of classes that name exactly this path.
    fn merges_of(&self, path: &Path) -> impl Iterator<Item = &Merge> {
        (0..path.0.len()).flat_map(|n| {
            let (owner, rest) = (Path(path.0[..n].to_vec()), Path(path.0[n..].to_vec()));
            let merges = self.class_at(&owner).map(|c| self.merges_in_force(c, 0));
            merges.unwrap_or_default().into_iter().filter(move |m| m.paths.contains(&rest))
        })
    }

    /// Returns the merges that the line of a class says from its `first` class upwards and that none nearer
    /// masks.
    fn merges_in_force(&self, class: ClassId, first: usize) -> Vec<&Merge> {
        let document = &self.lowered.document;
        let line = document.primary_line(class);
        let of = |i: usize| document.classes[line[i]].merges.iter().map(move |m| (i, m));
        let all = (first..line.len()).flat_map(of);
        all.filter(|(i, m)| !document.is_masked(&line[..*i], m.name.as_ref()))
            .map(|(_, m)| m)
            .collect()
    }

    /// Masks the merges of classes that name a path, at the thing that has them; where that has no body of
    /// its own, at the one around it.
    fn unmerge_inherited(
        &self,
        path: &Path,
        done: &mut Restructuring,
        left: &mut Vec<Path>,
        said: &mut Sayings,
    ) -> Result<(), Diagnostic> {
        for n in (0..path.0.len()).rev() {
            let (owner, rest) = (Path(path.0[..n].to_vec()), Path(path.0[n..].to_vec()));
            let Some(class) = self.class_at(&owner) else { continue };
            let home = self.home(&owner)?;
            let within = home.within(&owner);
            // what its own body says is taken out of that
            let is_own = within.is_empty() && !self.is_inherited(&home);
            let all = self.merges_in_force(class, usize::from(is_own));
            let merges: Vec<&Merge> =
                all.iter().copied().filter(|m| m.paths.contains(&rest)).collect();
            if merges.is_empty() {
                continue;
            }
            let mut members = Vec::new();
            let mut kept: IndexSet<&Path> = IndexSet::new();
            for merge in &merges {
                let name = self.name_of_merge(merge, done)?;
                let mask = format!("without {}", within.then(Step::Part(name)));
                if !members.contains(&mask) {
                    members.push(mask);
                    // the other turns of a loop have the same name, and go on
                    let place = self.lowered.origins.place(merge.origin);
                    let others = all.iter().filter(|m| {
                        self.lowered.origins.place(m.origin) == place && !merges.contains(m)
                    });
                    members.extend(others.map(|m| merging(m.paths.iter().map(|p| within.join(p)))));
                }
                kept.extend(merge.paths.iter().filter(|p| **p != rest));
            }
            if kept.len() > 1 {
                members.push(merging(kept.iter().map(|p| within.join(p))));
            }
            left.extend(kept.first().map(|&p| owner.join(p)));
            saying(said, home).extend(members);
        }
        Ok(())
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

/// Takes merges out of a loop, which goes if it holds no others, and says members after it.
fn written_out(each: &SyntaxNode, gone: &[SyntaxNode], said: &[String]) -> Vec<TextEdit> {
    let mut stands = each.descendants().filter(|n| n.parent().is_some_and(|p| is_loop_body(&p)));
    let stays = stands.any(|n| n.kind() != SyntaxKind::For && !gone.contains(&n));
    let said = said.join("\n");
    match (stays, said.is_empty()) {
        (true, no_more) => {
            let after = Spot::After(each.clone());
            let more = (!no_more).then(|| edit::insert_member(&after, &said));
            gone.iter().map(edit::delete_member).chain(more).collect()
        }
        (false, true) => vec![edit::delete_member(each)],
        (false, false) => vec![edit::replace_member(each, &said)],
    }
}

fn is_loop_body(node: &SyntaxNode) -> bool {
    node.kind() == SyntaxKind::Body && node.parent().is_some_and(|p| p.kind() == SyntaxKind::For)
}

/// Returns the loop in whose body a member stands, the outermost of several.
fn outermost_loop(member: &SyntaxNode) -> Option<SyntaxNode> {
    let loops = member.ancestors().filter(|a| a.kind() == SyntaxKind::For);
    loops.last()
}

/// Writes a merge of some paths.
fn merging(paths: impl IntoIterator<Item = impl ToString>) -> String {
    let paths: Vec<String> = paths.into_iter().map(|p| p.to_string()).collect();
    format!("merge {}", paths.join(" = "))
}
