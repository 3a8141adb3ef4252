//! Homes: the body of the document's own text that has to say what a command says of a thing.

use super::Restructuring;
use crate::lower::OWN;
use crate::uses::{Text, refused};
use base::{Diagnostic, Span};
use kernel::{ClassId, ClassKind, Path, Step};
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Member};
use syntax::edit::{self, Spot, TextEdit};

/// A body of the document's own text, or where there will be one.
#[derive(Clone, Debug)]
pub(super) struct Home {
    /// The thing whose body it is: a path from the document or a prototype.
    pub(super) path: Path,
    pub(super) site: Site,
}

/// Whose body it is.
#[derive(Clone, Debug)]
pub(super) enum Site {
    /// The document's.
    Document(ast::File),
    /// A class's.
    Class(ast::Class),
    /// A part's, by one of its names.
    Part(ast::Part, ast::Word),
}

impl Home {
    pub(super) fn document(text: &Text<'_>) -> Self {
        Self { path: Path::default(), site: Site::Document(text.file.clone()) }
    }
    /// Returns the path from the thing whose body it is to one below it.
    pub(super) fn within(&self, path: &Path) -> Path {
        Path(path.0[self.path.0.len()..].to_vec())
    }
    /// Returns the members that stand in the body.
    pub(super) fn members(&self) -> Vec<Member> {
        match &self.site {
            Site::Document(file) => file.members().collect(),
            Site::Class(class) => class.body().into_iter().flat_map(|b| b.members()).collect(),
            Site::Part(part, _) => part.body().into_iter().flat_map(|b| b.members()).collect(),
        }
    }
    /// Finds the member of a name: a part, a message, a constraint or a merge.
    pub(super) fn member(&self, name: &str) -> Option<(Member, ast::Word)> {
        let named = |m: Member| {
            let mut words: Vec<ast::Word> = match &m {
                Member::Part(part) => part.names().collect(),
                Member::Message(message) => message.name().into_iter().collect(),
                Member::Constraint(c) => c.name().into_iter().collect(),
                Member::Merge(merge) => merge.name().into_iter().collect(),
                _ => Vec::new(),
            };
            words.retain(|w| w.text() == name);
            words.pop().map(|word| (m, word))
        };
        self.members().into_iter().find_map(named)
    }
}

/// Returns the thing that has all these paths below it, the paths themselves left out.
pub(super) fn common_owner(paths: &[Path]) -> Path {
    let mut common: &[Step] = match paths.first() {
        Some(first) => &first.0,
        None => &[],
    };
    for path in paths {
        let most = common.len().min(path.0.len().saturating_sub(1));
        let same = common[..most].iter().zip(&path.0).take_while(|(a, b)| a == b).count();
        common = &common[..same];
    }
    Path(common.to_vec())
}

impl Text<'_> {
    /// Finds the innermost body that can speak of a thing: its own, or that of one around it.
    ///
    /// # Errors
    /// The path leads nowhere.
    pub(super) fn home(&self, path: &Path) -> Result<Home, Diagnostic> {
        if self.class_at(path).is_none() {
            return Err(self.unknown(path));
        }
        let mut home = Home::document(self);
        for step in &path.0 {
            let here = home.path.then(step.clone());
            let Step::Part(name) = step else { break };
            let site = match home.member(name) {
                Some((Member::Part(part), word)) if self.may_have_members(&part, &here) => {
                    Site::Part(part, word)
                }
                Some(_) => break,
                None => match self.class(&here) {
                    Some(class) => Site::Class(class),
                    None => break,
                },
            };
            home = Home { path: here, site };
        }
        Ok(home)
    }

    /// Says that a path leads nowhere in the document's own text, and where it does lead.
    pub(super) fn unknown(&self, path: &Path) -> Diagnostic {
        let Some(Step::Part(first)) = path.0.first() else {
            return refused("unknown-part", format!("the document has no part {path}"));
        };
        let document = &self.lowered.document;
        let class = document.class_named(first).map(|c| document.classes[c].origin);
        let place = class.map(|origin| self.lowered.origins.place(origin));
        match place.filter(|p| p.file != OWN) {
            Some(place) => {
                let library = &self.lowered.files[place.file].name;
                let message = format!("{first} is declared in {library}, not in the document");
                refused("of-a-class", message).hint(format!("open {library} to change it"))
            }
            None => refused("unknown-part", format!("the document has no part {path}")),
        }
    }

    fn may_have_members(&self, part: &ast::Part, path: &Path) -> bool {
        let class = self.class_at(path).map(|c| &self.lowered.document.classes[c].kind);
        part.definition().is_none() && matches!(class, Some(ClassKind::Composite))
    }

    /// Returns true for a thing that is like every other of its class: its body has no members yet.
    fn is_plain(&self, home: &Home) -> bool {
        let class = self.class_at(&home.path);
        matches!(home.site, Site::Part(..))
            && class.is_some_and(|c| {
                // one with other counts is a named class all the same
                let general = self.lowered.document.classes[c].general;
                general.is_some() || !self.lowered.is_class_of_one(c)
            })
    }

    /// Says a member in a body, after the last of its kind, and what that implies.
    pub(super) fn said_in(&self, home: &Home, kind: SyntaxKind, member: &str) -> Restructuring {
        let edits = match &home.site {
            Site::Document(_) if kind == SyntaxKind::Error => vec![self.at_end(home, member)],
            Site::Document(_) => vec![self.after_its_kind(home, kind, member)],
            Site::Class(class) => {
                vec![edit::insert_member(&Spot::EndOf(class.syntax().clone()), member)]
            }
            Site::Part(part, word) => self.in_body(part, word, member),
        };
        Restructuring { edits, ..self.implied_by(home) }
    }

    /// Returns what a change of a body implies.
    pub(super) fn implied_by(&self, home: &Home) -> Restructuring {
        let prototype = self.prototype(&home.path).map(|(class, _)| class);
        Restructuring {
            class_of_one: self.is_plain(home).then(|| home.path.clone()),
            class: prototype,
            ..Restructuring::default()
        }
    }

    fn at_end(&self, home: &Home, member: &str) -> TextEdit {
        let has_checks = [SyntaxKind::Check, SyntaxKind::Lesson]
            .into_iter()
            .any(|kind| self.members_of(kind).next().is_some());
        let declares_check = member.trim_start().starts_with("check");
        let is_check = |m: &Member| matches!(m, Member::Check(_) | Member::Lesson(_));
        let before = (has_checks && !declares_check)
            .then(|| home.members().into_iter().rfind(|m| !is_check(m)));
        match before.flatten() {
            Some(last) => edit::insert_member(&Spot::After(last.syntax().clone()), member),
            None => edit::insert_member(&Spot::EndOf(self.file.syntax().clone()), member),
        }
    }

    /// Adds a member after the last of its kind, or at the end before any checks.
    fn after_its_kind(&self, home: &Home, kind: SyntaxKind, member: &str) -> TextEdit {
        match self.members_of(kind).next_back() {
            Some(last) => edit::insert_member(&Spot::After(last.syntax().clone()), member),
            None => self.at_end(home, member),
        }
    }

    fn in_body(&self, part: &ast::Part, word: &ast::Word, members: &str) -> Vec<TextEdit> {
        let Some(gone) = edit::delete_name(&word.token) else {
            return vec![edit::insert_member(&Spot::EndOf(part.syntax().clone()), members)];
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
        vec![gone, edit::insert_member(&Spot::After(part.syntax().clone()), &own)]
    }

    pub(super) fn source(&self, span: Span) -> String {
        self.lowered.effective.get(span.range()).unwrap_or_default().trim_end().to_string()
    }

    /// Returns the prototype of the nearest class of the document's own text that a thing is of, and
    /// how many steps of the thing's path it stands for.
    pub(super) fn class_for(&self, thing: &Path) -> Option<(Path, usize)> {
        let document = &self.lowered.document;
        (1..=thing.0.len()).rev().find_map(|n| {
            let at = Path(thing.0[..n].to_vec());
            let class = self.class_at(&at).filter(|_| self.class(&at).is_none())?;
            let named = self.named_class(class)?;
            Some((Path(vec![Step::Part(document.classes[named].name.clone())]), n))
        })
    }

    /// Returns the first class of a line that the document's own text declares.
    fn named_class(&self, class: ClassId) -> Option<ClassId> {
        let document = &self.lowered.document;
        let first = document.named_class(class);
        self.class(&Path(vec![Step::Part(document.classes[first].name.clone())])).map(|_| first)
    }

    /// Returns the path said of the prototype of the class that the thing is of; the last `kept` steps
    /// are a member of that class.
    pub(super) fn in_class(&self, path: &Path, kept: usize) -> Option<Path> {
        let owner = Path(path.0[..path.0.len().checked_sub(kept)?].to_vec());
        if let (1, Some(declares)) = (kept, self.declaring_class(path)) {
            let name = Step::Part(self.lowered.document.classes[declares].name.clone());
            let whole = Path(vec![name, path.0.last()?.clone()]);
            return (whole != *path).then_some(whole);
        }
        let (whole, n) = self.class_for(&owner)?;
        Some(whole.join(&Path(path.0[n..].to_vec())))
    }

    /// Returns the class of the document's own text that declares the member at a path.
    fn declaring_class(&self, path: &Path) -> Option<ClassId> {
        let (last, owner) = path.0.split_last()?;
        let Step::Part(name) = last else { return None };
        let class = self.class_at(&Path(owner.to_vec()))?;
        let document = &self.lowered.document;
        document.lineage(class).into_iter().find(|&c| {
            let class = Path(vec![Step::Part(document.classes[c].name.clone())]);
            let home = self.class(&class).map(|at| Home { path: class, site: Site::Class(at) });
            home.is_some_and(|h| h.member(name).is_some())
        })
    }
}
