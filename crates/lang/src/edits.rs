//! Commands that change structure, as the smallest edits of the text.
//!
//! In: what the text means, its structure, a command. Out: [`Restructuring`]: the edits, and what they
//! imply. Every command has a *home* (`home`): the body that has to say it. That of a class changes
//! all its things; that of a thing makes the thing a class of one.

mod carry;
mod caught;
mod connect;
mod counts;
mod delete;
mod elements;
mod home;
mod merge;
mod named;
mod promote;
mod rename;
mod sides;
mod switch;

use crate::lower::Lowered;
use crate::uses::{Text, refused};
use base::{Diagnostic, Span};
pub use counts::is_count;
use home::{Home, Site};
use kernel::{ClassId, Command, Literal, Path, Step, Structure};
pub(crate) use rename::is_class_name;
pub use sides::write_sides;
pub use switch::of_constraint;
use syntax::ast::Expr;
use syntax::edit::{self, TextEdit};
use syntax::{SyntaxKind, SyntaxNode};

/// What a command does to the text, and what that implies.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Restructuring {
    /// The edits of the text.
    pub edits: Vec<TextEdit>,
    /// The thing that becomes a class of one.
    pub class_of_one: Option<Path>,
    /// The class that changes, and with it all its things.
    pub class: Option<ClassId>,
    /// The members that go along, or are shortened, as they were written.
    pub along: Vec<String>,
}

impl From<Vec<TextEdit>> for Restructuring {
    fn from(edits: Vec<TextEdit>) -> Self {
        Self { edits, ..Self::default() }
    }
}

/// Returns the edits of the text that a command is, and what they imply.
///
/// Values that are set are no structure, apart from what is set of a constraint and from counts.
///
/// # Errors
/// Why the text cannot say it: a path that leads nowhere, something that is a class's to say, a
/// name that is taken.
pub fn edits_for(
    lowered: &Lowered,
    structure: &Structure,
    command: &Command,
) -> Result<Restructuring, Diagnostic> {
    let text = Text::of(lowered);
    let mut done: Restructuring = match command {
        Command::Merge(paths) => {
            for path in paths {
                must_lead(&text, structure, path)?;
            }
            text.merge(paths)
        }
        Command::Unmerge(path) => text.unmerge(path)?,
        Command::Delete(path) => text.delete(path)?,
        Command::Edit { target, members } => text.insert(target, members)?,
        Command::Rename { from, to } => text.rename(from, to)?,
        Command::Promote { path, class } => text.promote(path, class)?.into(),
        Command::Anchor { path, held: true } => {
            must_lead(&text, structure, path)?;
            text.anchor(path)?
        }
        Command::Anchor { path, held: false } => text.let_go(path)?.into(),
        Command::Enable { path, on } => text.switch(path, *on)?,
        Command::Set(targets) => match targets.as_slice() {
            [(path, value)] if is_count(lowered, path) => text.set_count(path, value)?,
            all if all.iter().all(|(_, v)| matches!(v, Literal::Path(_))) => {
                crate::write::value_edits(lowered, targets, crate::write::Digits::All).into()
            }
            [(path, value)] => text.set_of_constraint(path, value)?,
            _ => {
                let message =
                    "what is set of a constraint, how many parts there are, and what a part names are edits of their own"
                        .to_string();
                return Err(refused("not-settable", message));
            }
        },
        Command::Move(_) | Command::Text(_) | Command::Undo | Command::Redo => {
            Restructuring::default()
        }
    };
    done.edits = carried(lowered, done.edits)?;
    Ok(done)
}

/// Returns the edits that delete several things of the document in one go, with what speaks of them, and what goes along.
/// Nothing where that takes one step for each: one of them is declared elsewhere, or with others that stay.
pub fn edits_to_delete(lowered: &Lowered, paths: &[Path]) -> Option<Restructuring> {
    let mut done = Text::of(lowered).delete_together(paths)?;
    done.edits = carried(lowered, done.edits).ok()?;
    Some(done)
}

/// Carries edits of the effective text over to the text.
///
/// # Errors
/// One of them is in a line with an error.
fn carried(lowered: &Lowered, edits: Vec<TextEdit>) -> Result<Vec<TextEdit>, Diagnostic> {
    let carry = |e: TextEdit| Some(TextEdit { span: lowered.in_text(e.span)?, insert: e.insert });
    let edits = edit::joined(&lowered.effective, edits);
    let carried: Option<Vec<TextEdit>> = edits.into_iter().map(carry).collect();
    carried.ok_or_else(|| {
        let message = "a line that has an error would have to be changed".to_string();
        refused("wrong-line", message).hint("mend the line first")
    })
}

/// Returns the same command said of every thing of the class, where it is about one thing of a class
/// that the document's own text declares.
pub fn for_every(lowered: &Lowered, command: &Command) -> Option<Command> {
    let text = Text::of(lowered);
    let one = |path: &Path| text.in_class(path, 1);
    let several = |paths: &[Path]| -> Option<Vec<Path>> {
        let owner = home::common_owner(paths);
        let (whole, n) = text.class_for(&owner)?;
        Some(paths.iter().map(|p| whole.join(&Path(p.0[n..].to_vec()))).collect())
    };
    Some(match command {
        Command::Merge(paths) => Command::Merge(several(paths)?),
        Command::Unmerge(path) => Command::Unmerge(one(path)?),
        Command::Delete(path) => Command::Delete(one(path)?),
        Command::Edit { target, members } => {
            Command::Edit { target: text.in_class(target, 0)?, members: members.clone() }
        }
        Command::Rename { from, to } => Command::Rename { from: one(from)?, to: to.clone() },
        Command::Enable { path, on } => Command::Enable { path: one(path)?, on: *on },
        Command::Anchor { path, held } => Command::Anchor { path: one(path)?, held: *held },
        Command::Set(_)
        | Command::Move(_)
        | Command::Promote { .. }
        | Command::Text(_)
        | Command::Undo
        | Command::Redo => return None,
    })
}

fn must_lead(text: &Text<'_>, structure: &Structure, path: &Path) -> Result<(), Diagnostic> {
    // parts of placed things are joined by their own word; of any other virtual part the text says why not
    let is_message = || {
        let (Step::Part(name), owner) = path.0.split_last()? else { return None };
        let class = text.class_at(&Path(owner.to_vec()))?;
        text.lowered.document.find_message(class, name, None)
    };
    let known = structure.follow(kernel::DOCUMENT, path).is_ok()
        || text.prototype(path).is_some() && text.class_at(path).is_some()
        || is_message().is_some();
    match known {
        true => Ok(()),
        false => Err(refused("unknown-part", format!("{path} leads nowhere"))),
    }
}

impl Text<'_> {
    /// Adds members to the document, to a class, or to the body of a thing.
    fn insert(&self, target: &Path, members: &str) -> Result<Restructuring, Diagnostic> {
        let home = self.home(target)?;
        if home.path == *target {
            let mut done = self.said_in(&home, SyntaxKind::Error, members);
            let class = done.class.filter(|_| matches!(home.site, Site::Class(_)));
            if let Some(class) = class.filter(|_| named::declares_parts(members)) {
                done.edits.extend(self.given_by_name(class));
            }
            return Ok(done);
        }
        let rest = home.within(target);
        let Some(class) = self.class_at(target) else {
            return Err(self.unknown(target));
        };
        match self.carried(members, (target, &rest), class) {
            Some(carried) => Ok(self.said_in(&home, SyntaxKind::Error, &carried)),
            None => Err(self.of_a_class(target)),
        }
    }

    /// Holds a part: by the document, or for every thing of a class.
    fn anchor(&self, path: &Path) -> Result<Restructuring, Diagnostic> {
        if !self.lists(SyntaxKind::Anchor, path).is_empty() {
            return Err(refused("already-anchored", format!("{path} is anchored already")));
        }
        let home = match self.prototype(path) {
            Some(_) => self.home(&Path(path.0[..1].to_vec()))?,
            None => Home::document(self),
        };
        let rest = home.within(path);
        Ok(self.said_in(&home, SyntaxKind::Anchor, &format!("anchor {rest}")))
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

    /// Returns the members of one kind that list a path, those of checks left out.
    fn lists(&self, kind: SyntaxKind, path: &Path) -> Vec<SyntaxNode> {
        use syntax::ast::AstNode;
        let holding = self.lowered.effective_parse.holding(kind);
        let holding = holding.filter_map(|span| self.file.member_at(span));
        let within = holding.flat_map(|m| m.syntax().descendants().collect::<Vec<_>>());
        let members = within.filter(|n| n.kind() == kind);
        let names = |n: &SyntaxNode| {
            let mut paths = n.children().filter_map(Expr::cast);
            let in_check = n.ancestors().any(|a| is_apart(a.kind()));
            !in_check && paths.any(|e| self.leads_to(&e, path))
        };
        members.filter(names).collect()
    }

    /// Says that something is a class's to say, and which class's.
    fn of_a_class(&self, path: &Path) -> Diagnostic {
        let owner = Path(path.0[..path.0.len().saturating_sub(1)].to_vec());
        let document = &self.lowered.document;
        let declares = self.class_at(&owner).zip(path.0.last()).and_then(|(class, step)| {
            let Step::Part(name) = step else { return None };
            let lineage = document.lineage(class);
            lineage.into_iter().find(|&c| document.classes[c].parts.iter().any(|p| p.name == *name))
        });
        let by = declares.map(|class| &document.classes[class]).filter(|c| !c.name.is_empty());
        let (Some(by), Some(last)) = (by, path.0.last()) else {
            let message = format!("{path} is not the document's own to change");
            return refused("of-a-class", message).hint("edit the class, or the thing as a whole");
        };
        let class = &by.name;
        let message = format!("{path} is declared by {class}, not by the document");
        let file = &self.lowered.files[self.lowered.origins.place(by.origin).file].name;
        let hint = match (by.is_of_one, file.is_empty()) {
            (true, _) => format!("change it in {class}"),
            (false, true) => {
                format!("say it of {class}.{}, for every {class}", Path(vec![last.clone()]))
            }
            (false, false) => format!("change it in {file}, for every {class}"),
        };
        refused("of-a-class", message).hint(format!("{hint}; or change the thing as a whole"))
    }
}

/// Returns the edits that leave in a member's list of paths only those that stay.
fn shortened(member: &SyntaxNode, stays: &dyn Fn(&Expr) -> bool) -> Vec<TextEdit> {
    use syntax::ast::AstNode;
    let paths: Vec<Expr> = member.children().filter_map(Expr::cast).collect();
    let kept: Vec<bool> = paths.iter().map(stays).collect();
    let least = if member.kind() == SyntaxKind::Merge { 2 } else { 1 };
    if kept.iter().filter(|k| **k).count() < least {
        return vec![edit::delete_member(member)];
    }
    let mut edits = Vec::new();
    let mut before: Option<&Expr> = None;
    for (i, path) in paths.iter().enumerate() {
        // with what divides it from the one before or, at the beginning, from the next
        let span = match (before, paths.get(i + 1)) {
            (Some(before), _) => Span::new(before.span().end, path.span().end),
            (None, Some(next)) => Span::new(path.span().start, next.span().start),
            (None, None) => path.span(),
        };
        match kept[i] {
            true => before = Some(path),
            false => edits.push(TextEdit { span, insert: String::new() }),
        }
    }
    edits
}

fn must_be_name(name: &str) -> Result<(), Diagnostic> {
    let inner = |c: char| c.is_alphanumeric() || c == '_';
    let plain =
        name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.chars().all(inner);
    match plain && SyntaxKind::reserved(name).is_none() {
        true => Ok(()),
        false => Err(refused("not-a-name", format!("`{name}` is no name"))
            .hint("a name is one word: a letter, then letters, digits and _")),
    }
}

/// Returns true for blocks whose statements say nothing of the document itself.
fn is_apart(kind: SyntaxKind) -> bool {
    matches!(kind, SyntaxKind::Check | SyntaxKind::Lesson)
}
