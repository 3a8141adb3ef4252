//! A pane: the prototype of a class as a document of its own, in which it is drawn, constrained and dragged.
//!
//! In: commands as hands make them there. Out: the same said of the class, in the document that declares it, and the
//! pane made anew from that. A pane has no text and no steps of its own: those of the document are its.

use crate::apply;
use crate::document::Open;
use crate::host::Beside;
use crate::recognise;
use crate::session::Session;
use crate::state::State;
use crate::tools::of_classes;
use crate::view::{Affected, Change, DocumentId, Refusal};
use crate::words;
use base::{Name, Span};
use kernel::{Command, Literal, Path, Step};
use std::collections::{BTreeMap, BTreeSet};
use syntax::ast::{AstNode, Member};
use syntax::edit::TextEdit;
use syntax::{SyntaxElement, SyntaxKind};

/// Whose prototype a document shows.
#[derive(Clone)]
pub(crate) struct Pane {
    /// The document that declares the class.
    pub(crate) of: DocumentId,
    /// The class.
    pub(crate) class: Name,
    /// What the prototype is called in the pane.
    pub(crate) name: Name,
}

impl Pane {
    /// The path of a thing that a pane names, without the prototype that it is a part of, is one from the class.
    fn of_class(&self, path: &Path) -> Path {
        match path.0.split_first() {
            Some((Step::Part(first), rest)) if *first == self.name => {
                Path(std::iter::once(Step::Part(self.class.clone())).chain(rest.to_vec()).collect())
            }
            _ => path.clone(),
        }
    }

    /// The path in the pane of a part of the prototype.
    pub(crate) fn part(&self, path: &Path) -> Path {
        Path(vec![Step::Part(self.name.clone())]).join(path)
    }

    /// The text of the pane, made of that of the document.
    fn text(&self, text: &str) -> String {
        format!("{}\n{}: {}\n", of_classes(text), self.name, self.class)
    }

    /// Returns what a command of the pane is in the document.
    fn carried(&self, home: &State, command: &Command) -> Result<Command, Refusal> {
        let of = |path: &Path| self.of_class(path);
        let targets = |targets: &[(Path, Literal)]| {
            let literal = |literal: &Literal| match literal {
                Literal::Path(path) => Literal::Path(of(path)),
                _ => literal.clone(),
            };
            targets.iter().map(|(path, value)| (of(path), literal(value))).collect()
        };
        let is_whole = |path: &Path| path.0.as_slice() == [Step::Part(self.name.clone())];
        let class = &self.class;
        Ok(match command {
            Command::Set(all) => Command::Set(targets(all)),
            Command::Move(all) => Command::Move(targets(all)),
            Command::Merge(paths) => Command::Merge(paths.iter().map(of).collect()),
            Command::Unmerge(path) => Command::Unmerge(of(path)),
            Command::Delete(path) if is_whole(path) => {
                let message = format!("this is what every {class} is like: delete parts of it");
                return Err(words::refuse(message));
            }
            Command::Delete(path) => Command::Delete(of(path)),
            Command::Edit { target, members } if target.is_empty() && is_header(members) => {
                command.clone()
            }
            Command::Edit { target, members } if target.is_empty() => {
                let target = Path(vec![Step::Part(class.clone())]);
                Command::Edit { target, members: self.said(home, members)? }
            }
            Command::Edit { target, members } => {
                Command::Edit { target: of(target), members: members.clone() }
            }
            Command::Rename { from, to } => Command::Rename { from: of(from), to: to.clone() },
            Command::Promote { path, class } => {
                Command::Promote { path: of(path), class: class.clone() }
            }
            Command::Anchor { path, held } => Command::Anchor { path: of(path), held: *held },
            Command::Enable { path, on } => Command::Enable { path: of(path), on: *on },
            Command::Text(_) | Command::Undo | Command::Redo => command.clone(),
        })
    }

    /// Returns members of the pane as the class says them: parts of the prototype by their own names, new parts by
    /// names that the class has not.
    fn said(&self, home: &State, members: &str) -> Result<String, Refusal> {
        let document = &home.lowered.document;
        let fields = document.class_named(&self.class).map(|c| document.layout(c));
        let fields = fields.into_iter().flatten();
        let mut taken: BTreeSet<String> =
            fields.map(|field| document.field_name(field).to_string()).collect();
        let file = syntax::parse(base::FileId(0), members).file();
        let mut others: BTreeMap<String, String> = BTreeMap::new();
        for member in file.members() {
            let Member::Part(part) = member else { continue };
            for word in part.names() {
                let name = word.text().to_string();
                let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
                let mut names =
                    std::iter::once(name.clone()).chain((2..).map(|n| format!("{stem}{n}")));
                let free = names.find(|name| !taken.contains(name)).unwrap_or_default();
                taken.insert(free.clone());
                others.insert(name, free);
            }
        }
        let tokens = file.syntax().descendants_with_tokens().filter_map(SyntaxElement::into_token);
        let tokens: Vec<_> = tokens.filter(|token| !token.text().trim().is_empty()).collect();
        let mut edits: Vec<TextEdit> = Vec::new();
        for (n, token) in tokens.iter().enumerate() {
            let is_dot = |n: usize| tokens.get(n).is_some_and(|t| t.kind() == SyntaxKind::Dot);
            if token.kind() != SyntaxKind::Ident || (n > 0 && is_dot(n - 1)) {
                continue;
            }
            let range = token.text_range();
            let (start, end) = (u32::from(range.start()), u32::from(range.end()));
            if token.text() == &*self.name {
                if !is_dot(n + 1) {
                    let message = format!(
                        "this would be said of a {} as a whole, which has no name in its class",
                        self.class
                    );
                    return Err(words::refuse(message));
                }
                edits.push(TextEdit { span: Span::new(start, end + 1), insert: String::new() });
            } else if let Some(free) = others.get(token.text()) {
                edits.push(TextEdit { span: Span::new(start, end), insert: free.clone() });
            }
        }
        Ok(syntax::edit::apply(members, &edits))
    }
}

/// Whether members say what a text uses, and nothing of things.
fn is_header(members: &str) -> bool {
    let file = syntax::parse(base::FileId(0), members).file();
    let is_header =
        |m: Member| matches!(m, Member::Use(_) | Member::Class(_) | Member::Unit(_) | Member::Y(_));
    file.members().all(is_header)
}

impl Session {
    /// Opens the prototype of a class that a document declares, as a document of its own: what is done there is done
    /// to the class, as a step of the document that declares it.
    ///
    /// # Errors
    /// The document declares no such class, or nothing can be made of it alone.
    pub fn open_prototype(&mut self, id: DocumentId, class: &str) -> Result<DocumentId, Refusal> {
        let of = self.home(id);
        let state = &self.document(of).state;
        let document = &state.lowered.document;
        let class = Name::new(class);
        let known = document.class_named(&class).filter(|_| state.lowered.declares_class(&class));
        let Some(known) = known else {
            return Err(words::refuse(format!("the document declares no class {class}")));
        };
        if !recognise::is_candidate(state, known, &document.classes[known]) {
            return Err(words::refuse(format!("there is no {class} by itself to be shown")));
        }
        let is_it = |open: &Open| {
            open.pane.as_ref().is_some_and(|pane| pane.of == of && pane.class == class)
        };
        if let Some(n) = self.documents.iter().position(is_it) {
            let pane = DocumentId(n as u32);
            self.renew_pane(pane);
            return Ok(pane);
        }
        let name = Name::new(&recognise::name_like(&class));
        let pane = Pane { of, class, name };
        let text = pane.text(&state.text);
        let called = format!("{} of {}", pane.class, self.document(of).name);
        let shown = self.open(&called, &text);
        self.document_mut(shown).pane = Some(pane);
        Ok(shown)
    }

    /// Returns the class whose prototype a document shows, while that class is there.
    pub fn prototype_shown(&self, id: DocumentId) -> Option<String> {
        let pane = self.document(id).pane.as_ref()?;
        let is_there = self.document(pane.of).state.lowered.declares_class(&pane.class);
        is_there.then(|| pane.class.to_string())
    }

    /// Returns the nearest class around a path that the document declares, if any: the one that a person means who
    /// points there.
    pub fn class_around(&self, id: DocumentId, path: &Path) -> Option<String> {
        let state = &self.document(id).state;
        let inside_pane = usize::from(self.document(id).pane.is_some());
        let classes = (1 + inside_pane..=path.0.len()).rev().filter_map(|n| {
            let thing = crate::session::thing_at(state, &Path(path.0[..n].to_vec()))?;
            Some(words::class_name(state, thing))
        });
        { classes }.find(|class| state.lowered.declares_class(class))
    }

    /// Returns the document that a document's text and steps are those of: itself, unless it is a pane.
    pub fn home(&self, id: DocumentId) -> DocumentId {
        self.document(id).pane.as_ref().map_or(id, |pane| pane.of)
    }

    /// Returns what a command of a document is in its home.
    pub(crate) fn at_home(&self, id: DocumentId, command: &Command) -> Result<Command, Refusal> {
        match &self.document(id).pane {
            Some(pane) => pane.carried(&self.document(pane.of).state, command),
            None => Ok(command.clone()),
        }
    }

    /// Applies a command of a pane.
    ///
    /// # Errors
    /// Why it was refused; then nothing has changed.
    pub(crate) fn apply_in_pane(
        &mut self,
        id: DocumentId,
        command: &Command,
    ) -> Result<Change, Refusal> {
        let home = self.home(id);
        let carried = self.at_home(id, command)?;
        let mut change = self.apply(home, &carried)?;
        if let (Command::Rename { from, to }, Some(pane)) =
            (&carried, &mut self.document_mut(id).pane)
            && from.0.as_slice() == [Step::Part(pane.class.clone())]
        {
            pane.class = Name::new(to);
        }
        self.renew_pane(id);
        change.documents.push(Affected { document: home, unsatisfied: Vec::new() });
        Ok(change)
    }

    /// Gives a class what its prototype was given by a drag in a pane.
    pub(crate) fn carry_drag(&mut self, id: DocumentId, change: Change) -> Change {
        let Some(pane) = self.document(id).pane.clone() else { return change };
        let state = self.document(id).state.clone();
        let writes = super::given_since(&state, start_of(&state.text, &pane.name), &pane.class);
        let label = change.label.replace(&format!("{}.", pane.name), &format!("{}.", pane.class));
        let (open, beside) = self.beside_others(pane.of);
        let edits = lang::write_values(&open.state.lowered, &writes);
        let text = syntax::edit::apply(&open.state.text, &edits);
        let mut change =
            Change { modes: change.modes, ..apply::take_state(open, &beside, text, label) };
        change.documents = self.reach(pane.of);
        change.documents.push(Affected { document: pane.of, unsatisfied: Vec::new() });
        self.renew_pane(id);
        change
    }

    /// Makes a pane anew from what its document is now.
    pub(crate) fn renew_pane(&mut self, id: DocumentId) {
        let Some(pane) = self.document(id).pane.clone() else { return };
        let text = pane.text(&self.document(pane.of).state.text);
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &mut self.documents[id.0 as usize];
        open.read(text, &beside);
        open.done.clear();
        open.undone.clear();
    }
}

/// Where the declaration of a thing begins in a text.
fn start_of(text: &str, name: &str) -> usize {
    let file = syntax::parse(base::FileId(0), text).file();
    let is_it = |m: &Member| match m {
        Member::Part(part) => part.names().any(|word| word.text() == name),
        _ => false,
    };
    let member = { file.members() }.find(is_it);
    member.map_or(text.len(), |m| usize::from(m.syntax().text_range().start()))
}
