//! Deleting: a member, and everything that speaks of it.
//!
//! A constraint, merge, given or statement of a check that speaks of what goes, goes too; a list of
//! paths is shortened, and so are `(a, b)` and `C(a, b)` by the values that stand for it; what is
//! itself a member takes along those that speak of it. A reference stays: that it names nothing any
//! more is an error at its place.

use super::home::Home;
use super::{Restructuring, shortened};
use crate::references::{References, Symbol};
use crate::uses::{Text, refused};
use base::{Diagnostic, Span};
use kernel::{ClassId, Path, Search, Step};
use std::collections::BTreeSet;
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::edit::{self, TextEdit};
use syntax::{SyntaxKind, SyntaxNode, SyntaxToken};

/// What is deleted, as far as it is known.
pub(super) struct Deletion {
    references: References,
    /// Members whose uses are still to be found.
    waiting: Vec<Symbol>,
    pub(super) edits: Vec<TextEdit>,
    pub(super) along: Vec<String>,
    /// Members that are dealt with.
    seen: BTreeSet<Span>,
    /// Lists of paths, and the words in them that lead to what goes.
    lists: Vec<(SyntaxNode, Vec<Span>)>,
    /// Values by position, those of them that stand for what goes, and what they make.
    values: Vec<(SyntaxNode, Vec<Span>, ClassId)>,
}

impl Deletion {
    pub(super) fn new(text: &Text<'_>) -> Self {
        Self {
            references: text.lowered.references(),
            waiting: Vec::new(),
            edits: Vec::new(),
            along: Vec::new(),
            seen: BTreeSet::new(),
            lists: Vec::new(),
            values: Vec::new(),
        }
    }
}

impl Text<'_> {
    pub(super) fn delete(&self, path: &Path) -> Result<Restructuring, Diagnostic> {
        if let Some(class) = self.class(path) {
            return self.delete_class(&class);
        }
        if let Some(Step::Index(i)) = path.0.last() {
            return self.delete_element(path, *i);
        }
        match self.declaration(path) {
            Ok((home, member, word)) => Ok(self.delete_member(&home, &member, &word)),
            Err(unknown) => self.delete_rule(path, unknown),
        }
    }

    fn delete_member(&self, home: &Home, member: &Member, word: &ast::Word) -> Restructuring {
        let mut deletion = Deletion::new(self);
        deletion.waiting.push(self.symbol(home, word));
        deletion.edits.push(match edit::delete_name(&word.token) {
            Some(edit) => edit,
            None => {
                deletion.seen.insert(member.span());
                edit::delete_member(member.syntax())
            }
        });
        self.forget_uses(&mut deletion);
        let class = self.implied_by(home).class;
        Restructuring { edits: deletion.edits, along: deletion.along, class, class_of_one: None }
    }

    /// Deletes things that the document's own text declares; nothing where one is declared elsewhere, or with others
    /// that stay.
    pub(super) fn delete_together(&self, paths: &[Path]) -> Option<Restructuring> {
        let name = |path: &Path| match path.0.as_slice() {
            [Step::Part(name)] => Some(name.to_string()),
            _ => None,
        };
        let names: BTreeSet<String> = paths.iter().map(name).collect::<Option<_>>()?;
        let mut deletion = Deletion::new(self);
        let (mut nodes, mut found) = (Vec::new(), 0);
        for member in self.file.members() {
            let words: Vec<ast::Word> = match &member {
                Member::Part(part) => part.names().collect(),
                Member::Message(message) => message.name().into_iter().collect(),
                _ => continue,
            };
            let gone = words.iter().filter(|word| names.contains(word.text())).count();
            match gone {
                0 => continue,
                some if some < words.len() => return None,
                all => found += all,
            }
            let class = self.lowered.document.root;
            let symbols = words.iter().map(|word| Symbol { class, name: word.name() });
            deletion.waiting.extend(symbols);
            deletion.seen.insert(member.span());
            nodes.push(member.syntax().clone());
        }
        deletion.edits = edit::delete_members(&nodes);
        self.forget_uses(&mut deletion);
        let Deletion { edits, along, .. } = deletion;
        (found == names.len()).then(|| Restructuring { edits, along, ..Restructuring::default() })
    }

    /// Deletes what speaks of what goes, and what speaks of that.
    pub(super) fn forget_uses(&self, deletion: &mut Deletion) {
        while let Some(symbol) = deletion.waiting.pop() {
            let speaks = |(_, spoken): &&(Span, Symbol)| *spoken == symbol;
            let spans = |all: &BTreeSet<(Span, Symbol)>| -> Vec<Span> {
                all.iter().filter(speaks).map(|(span, _)| *span).collect()
            };
            for span in spans(&deletion.references.positions) {
                self.forget_value(span, symbol.class, deletion);
            }
            for span in spans(&deletion.references.words) {
                let Some(word) = self.token_at(span) else { continue };
                if !is_gone(&deletion.edits, span) && !is_label(&word) {
                    self.forget(&word, deletion);
                }
            }
        }
        for (node, gone, class) in &deletion.values {
            if !is_gone(&deletion.edits, syntax::span_of(node)) {
                deletion.edits.push(self.without_values(node, gone, *class));
            }
        }
        for (node, words) in &deletion.lists {
            let stays =
                |e: &Expr| !words.iter().any(|w| e.span().range().contains(&(w.start as usize)));
            let edits = shortened(node, &stays);
            deletion.edits.extend(edits);
        }
    }

    /// Deletes a value that stands for what goes.
    fn forget_value(&self, span: Span, class: ClassId, deletion: &mut Deletion) {
        let first = self.file.syntax().token_at_offset(span.start.into()).right_biased();
        let list = first.and_then(|t| {
            t.parent_ancestors().find(|n| {
                let around = syntax::span_of(n).start < span.start;
                around && matches!(n.kind(), SyntaxKind::TupleExpr | SyntaxKind::ArgList)
            })
        });
        let Some(list) = list else { return };
        match deletion.values.iter_mut().find(|(n, ..)| *n == list) {
            Some((_, spans, _)) => spans.push(span),
            None => deletion.values.push((list, vec![span], class)),
        }
    }

    /// Returns the edit that leaves in `(a, b)` or `C(a, b)` only the values that stay.
    fn without_values(&self, list: &SyntaxNode, gone: &[Span], class: ClassId) -> TextEdit {
        let stays = |n: &SyntaxNode| {
            let span = syntax::span_of(n);
            !gone.iter().any(|g| span.start <= g.start && g.end <= span.end)
        };
        let kept: Vec<String> =
            list.children().filter(stays).map(|n| n.text().to_string()).collect();
        // one value in brackets is that value alone
        let maker = match (list.kind(), kept.len()) {
            (SyntaxKind::TupleExpr, 0 | 1) => self.lowered.document.classes[class].name.as_str(),
            _ => "",
        };
        TextEdit { span: syntax::span_of(list), insert: format!("{maker}({})", kept.join(", ")) }
    }

    /// Deletes what stands around a word, as little as can be.
    pub(super) fn forget(&self, word: &SyntaxToken, deletion: &mut Deletion) {
        let mut members = word.parent_ancestors().filter_map(Member::cast).peekable();
        let Some(mut member) = members.next() else { return };
        while let Some(outer) = members.next_if(|m| matches!(m, Member::Try(_))) {
            member = outer;
        }
        let node = member.syntax();
        let span = member.span();
        let gone = edit::delete_member(node);
        match &member {
            Member::Merge(_)
            | Member::Stay(_)
            | Member::Anchor(_)
            | Member::Attachers(_)
            | Member::Without(_) => {
                let word = syntax::span_of_token(word);
                match deletion.lists.iter_mut().find(|(n, _)| n == node) {
                    Some((_, words)) => words.push(word),
                    None => deletion.lists.push((node.clone(), vec![word])),
                }
                if !deletion.seen.insert(span) {
                    return;
                }
                if let Member::Merge(merge) = &member {
                    self.spoken_of(
                        node,
                        merge.name().filter(|_| merge.paths().count() < 3),
                        deletion,
                    );
                }
            }
            // what it names is gone: that is said at its place
            Member::Ref(_) => return,
            Member::Part(part) if is_reference(part) => return,
            Member::Part(part) if part.definition().is_none() => {
                let value = part.value().zip(part.class());
                let Some((value, class)) = value.filter(|_| deletion.seen.insert(span)) else {
                    return;
                };
                let span = Span::new(class.span().end, value.span().end);
                deletion.edits.push(TextEdit { span, insert: String::new() });
            }
            other => {
                if !deletion.seen.insert(span) {
                    return;
                }
                deletion.edits.push(gone);
                let names: Vec<ast::Word> = match other {
                    Member::Part(part) => part.names().collect(),
                    Member::Message(message) => message.name().into_iter().collect(),
                    Member::Constraint(c) => c.name().into_iter().collect(),
                    _ => Vec::new(),
                };
                for name in names {
                    self.spoken_of(node, Some(name), deletion);
                }
            }
        }
        deletion.along.push(self.first_line(&member));
    }

    /// Notes that a member goes by whose name others may speak of it.
    fn spoken_of(&self, node: &SyntaxNode, name: Option<ast::Word>, deletion: &mut Deletion) {
        let things = self.things_around(node).unwrap_or_default();
        let class = things.first().and_then(|(path, _)| match path.is_empty() {
            true => Some(self.lowered.document.root),
            false => self.class_at(path),
        });
        let (Some(class), Some(name)) = (class, name) else { return };
        // what a class above says instead is still there to be spoken of
        let document = &self.lowered.document;
        let inherited =
            document.find_message(class, name.text(), Some(Search::Above(class))).is_some();
        if !inherited {
            deletion.waiting.push(Symbol { class, name: name.name() });
        }
    }

    /// Returns the first line of a member, and the title of the check that it is a statement of.
    fn first_line(&self, member: &Member) -> String {
        let source = self.source(ast::span_without_doc(member.syntax()));
        let line = source.lines().next().unwrap_or_default().trim().to_string();
        let check = member.syntax().ancestors().skip(1).find_map(ast::Check::cast);
        match check.and_then(|c| c.name()) {
            Some(title) => format!("{line} (in the check {})", title.text()),
            None => line,
        }
    }

    fn token_at(&self, span: Span) -> Option<SyntaxToken> {
        let at = self.file.syntax().token_at_offset(span.start.into());
        at.right_biased().filter(|t| t.kind() == SyntaxKind::Ident)
    }

    /// Deletes a constraint or merge that has no name, or that a class says: there it is masked.
    fn delete_rule(&self, path: &Path, unknown: Diagnostic) -> Result<Restructuring, Diagnostic> {
        let Ok((owner, class, constraint)) = self.constraint(path) else {
            return self.delete_merge(path, unknown);
        };
        let home = self.home(&owner)?;
        let here = home.members().into_iter().find(|m| {
            let span = ast::span_without_doc(m.syntax());
            home.path == owner
                && class == self.class_at(&owner).unwrap_or(class)
                && span == self.lowered.origins.place(constraint.origin).span
        });
        let implied = self.implied_by(&home);
        if let (Some(member), None) = (here, &implied.class_of_one) {
            return Ok(Restructuring {
                edits: vec![edit::delete_member(member.syntax())],
                ..implied
            });
        }
        let mut done = Restructuring::default();
        let name = match &constraint.name {
            Some(name) => name.clone(),
            None => self.name_given(constraint.origin, "constraint", "rule", &mut done)?,
        };
        let mask = format!("without {}", home.within(&owner).then(Step::Part(name)));
        let said = self.said_in(&home, SyntaxKind::Without, &mask);
        let edits = done.edits.into_iter().chain(said.edits).collect();
        Ok(Restructuring { edits, ..said })
    }

    /// Masks a named merge that a class says.
    fn delete_merge(&self, path: &Path, unknown: Diagnostic) -> Result<Restructuring, Diagnostic> {
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return Err(unknown) };
        let owner = Path(owner.to_vec());
        let document = &self.lowered.document;
        let lineage = self.class_at(&owner).map(|c| document.lineage(c)).unwrap_or_default();
        let mut merges = lineage.iter().flat_map(|&c| &document.classes[c].merges);
        if !merges.any(|m| m.name.as_ref() == Some(name)) {
            return Err(unknown);
        }
        let home = self.home(&owner)?;
        let mask = format!("without {}", home.within(&owner).then(Step::Part(name.clone())));
        Ok(self.said_in(&home, SyntaxKind::Without, &mask))
    }

    /// Deletes a class that nothing is made of.
    fn delete_class(&self, class: &ast::Class) -> Result<Restructuring, Diagnostic> {
        let word = class.name().expect("a class was found by its name");
        let uses = self.rename_words(word.text(), word.text(), super::rename::is_class_name);
        let elsewhere = |e: &&TextEdit| !class.span().range().contains(&(e.span.start as usize));
        if let Some(used) = uses.iter().find(elsewhere) {
            let line =
                self.token_at(used.span).and_then(|t| t.parent_ancestors().find_map(Member::cast));
            let line = line.map_or_else(String::new, |m| self.first_line(&m));
            let message = format!("there is something that is made of {}: {line}", word.text());
            return Err(refused("class-in-use", message).hint("delete that first"));
        }
        Ok(vec![edit::delete_member(class.syntax())].into())
    }
}

/// Returns true for the label of an argument, which goes with its value.
fn is_label(word: &SyntaxToken) -> bool {
    word.parent().is_some_and(|n| n.kind() == SyntaxKind::Arg)
}

/// Returns true for a part that names another.
pub(super) fn is_reference(part: &ast::Part) -> bool {
    part.class().is_some_and(|c| matches!(c.shape(), ast::TypeShape::Path(_)))
}

/// Returns true for a word that stands in what is deleted already.
pub(super) fn is_gone(edits: &[TextEdit], word: Span) -> bool {
    edits.iter().any(|e| e.span.start <= word.start && word.end <= e.span.end)
}
