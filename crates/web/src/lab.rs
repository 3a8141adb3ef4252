//! The lab: the session, which documents are open in it, and what their views show.
//!
//! In: what the panels ask for. Out: signals that the panels paint. Between press and release of a
//! drag only the picture and the values are made anew, and nothing is asked of the server.

use crate::actions::Context;
use crate::dialog::Wish;
use crate::files::{FileSet, Files};
use crate::menu::{self, Menu};
use crate::picture::covers;
use crate::server::{self, Listed, Saved, Stored};
use crate::sheet::View;
use crate::{js, route, theme, words};
use drawing::Point;
use leptos::prelude::*;
use session::view::{
    Analysis, Caught, Change, Choice, DocumentId, DragState, Explanation, FixView, Ghost, HeldView,
    MovedView, PictureView, Question, Recognised, Refusal, RowKind, Status, StructureRow, TextView,
    ToolView, ValueRow, Velocity,
};
use session::{Command, Path, Session};
use std::collections::BTreeMap;
use std::fmt;
use std::time::Duration;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

/// An open document.
#[derive(Clone, PartialEq, Debug)]
pub struct Opened {
    /// Which document of the session it is.
    pub id: DocumentId,
    /// What it is called.
    pub title: String,
    /// The version on disk that its saved text is.
    pub version: String,
    /// Whether it stands in the folder; others are built in.
    pub writable: bool,
    /// The text on disk.
    pub saved: String,
    /// Whether its text differs from that on disk.
    pub dirty: bool,
}

impl Opened {
    /// Whether it has never been saved, and no gallery has it.
    pub fn is_new(&self) -> bool {
        self.writable && self.version == ABSENT
    }
}

/// What the server calls the version of a file that is not there.
const ABSENT: &str = "absent";
/// What stands in a new document.
const NEW_TEXT: &str = "use geometry\n";
/// What a new document is called before it is saved.
const UNTITLED: &str = "untitled";

/// What the lab has to say after the last command.
#[derive(Clone, PartialEq, Debug)]
pub enum Notice {
    /// Something went well.
    Said(String),
    /// A command changed nothing, and why.
    Refused(Refusal),
    /// What has to be decided before a command is applied.
    Asked(Question),
    /// What the selection could be the parts of.
    Recognised(Vec<Recognised>),
}

/// Everything that the panels share; a handle that is copied about.
#[derive(Clone, Copy)]
pub struct Lab {
    session: StoredValue<Session, LocalStorage>,
    files: StoredValue<FileSet>,
    opened: StoredValue<BTreeMap<String, Opened>>,
    pending_text: StoredValue<Option<String>>,
    typing: StoredValue<u32>,
    /// The path of the document that is shown; none in the gallery.
    pub current: RwSignal<Option<String>>,
    /// The shown document, as of the last command.
    pub document: RwSignal<Option<Opened>>,
    /// Its structure view.
    pub structure: RwSignal<Vec<StructureRow>>,
    /// Which rows of the structure view are in the page.
    pub shown_things: StoredValue<Vec<usize>>,
    /// While something is dragged, the values of these rows.
    pub dragged_values: RwSignal<BTreeMap<usize, String>>,
    /// Its values view.
    pub values: RwSignal<Vec<ValueRow>>,
    /// Which rows of the values view are in the page, in order: those that a drag keeps up to date.
    pub shown_values: StoredValue<Vec<usize>>,
    /// Its text view.
    pub text: RwSignal<TextView>,
    /// Its status line.
    pub status: RwSignal<Status>,
    /// Its picture.
    pub picture: RwSignal<PictureView>,
    /// The path of the selected thing.
    pub selected: RwSignal<Option<String>>,
    /// The paths of what is selected besides, in the order of choosing.
    pub also: RwSignal<Vec<String>>,
    /// The path of the thing under the pointer, in whatever view.
    pub hovered: RwSignal<Option<String>>,
    /// What is selected and hovered, each as the first path of its thing.
    pub marked: Memo<Marked>,
    /// What of it has moved since the press of the drag that is going on.
    pub moved: RwSignal<MovedView>,
    /// The motion that the picture shows by arrows.
    pub motion: RwSignal<Vec<Velocity>>,
    /// Where else the selection could be, as the picture shows it.
    pub ghosts: RwSignal<Vec<drawing::Drawing>>,
    /// What there is to say.
    pub notice: RwSignal<Option<Notice>>,
    /// Where the present drag has got to, if there is one.
    pub dragging: RwSignal<Option<DragState>>,
    /// The documents that the server offers, as of the last time it was asked.
    pub listed: RwSignal<Vec<Listed>>,
    /// What stands on disk instead, after a save was refused for it.
    pub conflict: RwSignal<Option<Option<Stored>>>,
    /// Unsaved text of an earlier visit.
    pub draft: RwSignal<Option<String>>,
    /// Whether the explanation panel is open.
    pub why: RwSignal<bool>,
    /// Whether the palette of actions is open.
    pub palette: RwSignal<bool>,
    /// The class of the things that the tool in the hand makes.
    pub tool: RwSignal<Option<String>>,
    /// What that tool shows.
    pub tool_view: RwSignal<ToolView>,
    /// What was typed of a length, while a tool is held.
    pub typed: RwSignal<String>,
    /// Where the arrow keys have brought the pointer, on the canvas.
    pub cursor: RwSignal<Option<(f64, f64)>>,
    /// Whether the tool was taken out of the bin with the button held down.
    pub carried: StoredValue<bool>,
    /// What the thing that is dragged would be joined with.
    pub dropping: RwSignal<Option<(Path, Caught)>>,
    /// What the left drawer shows.
    pub drawer: RwSignal<Drawer>,
    /// The value that is typed in the picture, and where on the canvas.
    pub editing: RwSignal<Option<InPlace>>,
    /// The menu that is open.
    pub menu: RwSignal<Option<Menu>>,
    /// What a person is asked to type.
    pub wish: RwSignal<Option<Wish>>,
    /// Whether the picture has a grid.
    pub grid: RwSignal<bool>,
    /// What the picture is asked to do with its view.
    pub zoom: RwSignal<Option<Zoom>>,
    /// The part of the sheet that one sees.
    pub view: RwSignal<View>,
    /// Whether the view is one that fits, and shall fit when the panel's size changes.
    pub fits: StoredValue<bool>,
    /// The page's colours.
    pub colors: theme::Colors,
}

impl fmt::Debug for Lab {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lab").finish_non_exhaustive()
    }
}

/// What is marked in all views, each as the first path of its thing.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Marked {
    /// What is selected, in the order of choosing.
    pub selected: Vec<String>,
    /// What is under the pointer.
    pub hovered: Option<String>,
}

/// What the left drawer shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Drawer {
    /// The tree of things.
    Structure,
    /// The classes that things can be made of.
    Bin,
    /// The steps.
    History,
}

/// A value that is typed where it is seen.
#[derive(Clone, PartialEq, Debug)]
pub struct InPlace {
    /// Whose value.
    pub path: String,
    /// The value now, as a person types it.
    pub value: String,
    /// Where on the canvas.
    pub at: (f64, f64),
}

/// A change of the picture's view that comes from elsewhere than the picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Zoom {
    /// Everything in sight.
    Fit,
    /// Larger or smaller by this factor.
    By(f64),
}

impl Lab {
    /// Makes a lab without documents.
    pub fn new() -> Self {
        let (selected, hovered) = (RwSignal::new(None), RwSignal::new(None));
        let (also, structure) = (RwSignal::new(Vec::new()), RwSignal::new(Vec::new()));
        let marked = Memo::new(move |_| {
            structure.with(|rows| {
                let first = |path: String| first_path(rows, path);
                let selected = selected.get().into_iter().chain(also.get());
                Marked {
                    selected: selected.map(first).collect(),
                    hovered: hovered.get().map(first),
                }
            })
        });
        let files = StoredValue::new(FileSet::default());
        Self {
            session: StoredValue::new_local(Session::new(Box::new(Files(files)))),
            files,
            opened: StoredValue::new(BTreeMap::new()),
            pending_text: StoredValue::new(None),
            typing: StoredValue::new(0),
            current: RwSignal::new(None),
            document: RwSignal::new(None),
            structure,
            values: RwSignal::new(Vec::new()),
            shown_things: StoredValue::new(Vec::new()),
            dragged_values: RwSignal::new(BTreeMap::new()),
            shown_values: StoredValue::new(Vec::new()),
            text: RwSignal::new(no_text()),
            status: RwSignal::new(Status::default()),
            picture: RwSignal::new(PictureView::default()),
            moved: RwSignal::new(MovedView::Everything),
            selected,
            also,
            hovered,
            marked,
            motion: RwSignal::new(Vec::new()),
            ghosts: RwSignal::new(Vec::new()),
            notice: RwSignal::new(None),
            dragging: RwSignal::new(None),
            listed: RwSignal::new(Vec::new()),
            conflict: RwSignal::new(None),
            draft: RwSignal::new(None),
            why: RwSignal::new(false),
            palette: RwSignal::new(false),
            tool: RwSignal::new(None),
            tool_view: RwSignal::new(ToolView::default()),
            typed: RwSignal::new(String::new()),
            cursor: RwSignal::new(None),
            carried: StoredValue::new(false),
            dropping: RwSignal::new(None),
            drawer: RwSignal::new(Drawer::Structure),
            editing: RwSignal::new(None),
            menu: RwSignal::new(None),
            wish: RwSignal::new(None),
            grid: RwSignal::new(theme::keep(GRID_KEY).is_none_or(|kept| kept != "off")),
            zoom: RwSignal::new(None),
            view: RwSignal::new(View::default()),
            fits: StoredValue::new(true),
            colors: theme::start(),
        }
    }

    /// Fetches the library once; without it documents open with diagnostics.
    pub async fn fetch_library(self) {
        match server::library().await {
            Ok(library) => self.files.update_value(|files| {
                files.libraries = library.iter().map(|(file, _)| used_as(file)).collect();
                files
                    .texts
                    .extend(library.into_iter().map(|(file, text)| (used_as(&file), Some(text))));
            }),
            Err(message) => self.say_refused(message),
        }
    }

    /// Asks the server what documents there are.
    ///
    /// # Errors
    /// One sentence, where it does not say.
    pub async fn fetch_list(self) -> Result<Vec<Listed>, String> {
        let listed = server::documents().await?;
        self.listed.set(listed.clone());
        Ok(listed)
    }

    /// Opens a document in the session, if it is not open already, and returns it.
    ///
    /// # Errors
    /// One sentence, where the server does not give it.
    pub async fn load(self, path: &str) -> Result<Opened, String> {
        if let Some(opened) = self.opened.with_value(|all| all.get(path).cloned())
            && (opened.dirty || stands(path).await.is_ok_and(|s| s.version == opened.version))
        {
            return Ok(opened);
        }
        let stored = stands(path).await?;
        self.take_up(path, stored).await
    }

    /// Opens a text in the session under a path, with the files that it uses.
    async fn take_up(self, path: &str, stored: Stored) -> Result<Opened, String> {
        let mut id = self.open(path, &stored.text);
        while self.fetch_used(path).await {
            id = self.open(path, &stored.text);
        }
        let title = self.session.with_value(|session| session.title(id));
        let opened = Opened {
            id,
            title,
            version: stored.version,
            writable: stored.writable,
            saved: stored.text,
            dirty: false,
        };
        self.opened.update_value(|all| {
            all.insert(String::from(path), opened.clone());
        });
        Ok(opened)
    }

    fn open(self, path: &str, text: &str) -> DocumentId {
        self.order(|session| session.open(path, text))
    }

    /// Fetches the files that a document was found to use; returns whether there are new ones.
    async fn fetch_used(self, path: &str) -> bool {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let wanted = self.files.try_update_value(|f| std::mem::take(&mut f.wanted));
        let mut found = false;
        for name in wanted.unwrap_or_default() {
            let stored = server::document(&beside(folder, &name)).await.ok().flatten();
            let text = stored.map(|stored| stored.text);
            found |= text.is_some();
            self.files.update_value(|files| {
                files.texts.insert(name, text);
            });
        }
        found
    }

    /// Shows a document that is loaded.
    pub fn show(self, path: &str) {
        self.flush_text();
        let Some(opened) = self.opened.with_value(|all| all.get(path).cloned()) else { return };
        self.drop_tool();
        self.editing.set(None);
        self.select(None);
        self.hovered.set(None);
        self.motion.set(Vec::new());
        self.ghosts.set(Vec::new());
        self.notice.set(None);
        self.conflict.set(None);
        let draft = theme::keep(&draft_key(path)).filter(|draft| *draft != opened.saved);
        self.draft.set(draft.filter(|_| !opened.dirty));
        self.current.set(Some(String::from(path)));
        self.document.set(Some(opened));
        self.refresh();
        self.zoom.set(Some(Zoom::Fit));
    }

    /// Shows the gallery.
    pub fn leave(self) {
        self.flush_text();
        self.drop_tool();
        self.current.set(None);
        self.document.set(None);
    }

    /// Returns the shown document's id.
    pub fn id(self) -> Option<DocumentId> {
        self.document.with_untracked(|d| d.as_ref().map(|d| d.id))
    }

    /// Asks the session something.
    pub fn ask<T>(self, question: impl FnOnce(&Session) -> T) -> T {
        self.session.with_value(question)
    }

    /// Tells the session something about a document that is not shown.
    pub fn order<T>(self, order: impl FnOnce(&mut Session) -> T) -> T {
        self.session.try_update_value(order).expect("the lab lives as long as the page")
    }

    /// Tells the session something about the shown document.
    pub(crate) fn tell<T>(self, order: impl FnOnce(&mut Session, DocumentId) -> T) -> Option<T> {
        let id = self.id()?;
        Some(self.order(|session| order(session, id)))
    }

    /// Applies a command to the shown document, or asks first what it is meant of; what comes of it
    /// stands in the signals.
    pub fn apply(self, command: &Command) -> bool {
        self.flush_text();
        let asked = self.id().and_then(|id| self.ask(|session| session.preview(id, command).ok()));
        match asked.flatten() {
            Some(question) => {
                self.notice.set(Some(Notice::Asked(question)));
                false
            }
            None => self.apply_as_meant(command),
        }
    }

    /// Mends the text by a fix of one of its diagnostics, if it is still the text that is shown.
    pub fn fix(self, fix: &FixView) {
        self.flush_text();
        let shown = self.text.with_untracked(|text| text.source.clone());
        let present = self.id().map(|id| self.ask(|session| session.text(id).source));
        if present == Some(shown) {
            self.settle(self.tell(|session, id| session.fix(id, fix)));
        }
    }

    /// Applies a command without asking.
    pub fn apply_as_meant(self, command: &Command) -> bool {
        self.settle(self.tell(|session, id| session.apply(id, command)))
    }

    /// Sets a value as a person types it.
    ///
    /// # Errors
    /// Why not; the caller shows it beside the field.
    pub fn set_typed(self, path: &str, typed: &str) -> Result<(), Refusal> {
        self.flush_text();
        match self.tell(|session, id| session.set_typed(id, path, typed)) {
            Some(Err(refusal)) => Err(refusal),
            outcome => {
                self.settle(outcome);
                Ok(())
            }
        }
    }

    /// Begins a drag; returns where the handle of what is dragged lies on the sheet, if there is one.
    pub fn press(self, path: &str) -> Option<(f64, f64)> {
        self.flush_text();
        let path = session::parse_path(path)?;
        match self.tell(|session, id| session.press(id, &path))? {
            Ok(handle) => {
                self.notice.set(None);
                self.dragging.set(Some(DragState::default()));
                Some(handle)
            }
            Err(refusal) => {
                self.notice.set(Some(Notice::Refused(refusal)));
                None
            }
        }
    }

    /// Goes on with a drag, in the sheet's coordinates.
    pub fn drag(self, to: (f64, f64)) {
        let state = self.tell(|session, id| session.drag(id, to));
        self.repaint();
        if state != self.dragging.get_untracked() {
            self.dragging.set(state);
        }
    }

    /// Ends a drag: one step for the undo list.
    pub fn release(self) {
        self.dragging.set(None);
        self.settle(self.tell(Session::release));
    }

    /// Looks whether what is dragged, brought to a place, would be joined with one of some paths, nearest first.
    pub fn look_for_joint(self, near: &[Caught]) {
        let found = self.id().and_then(|id| {
            near.iter().find_map(|caught| {
                let path = session::parse_path(&caught.word)?;
                let joined = self.ask(|session| session.joint(id, &path))?;
                let caught = Caught { word: words::joins(&joined), ..caught.clone() };
                Some((path, caught))
            })
        });
        if self.dropping.with_untracked(|old| *old != found) {
            self.dropping.set(found);
        }
    }

    /// Ends a drag where it joins something: one step for the undo list.
    pub fn release_onto(self, target: &Path) {
        self.dragging.set(None);
        self.dropping.set(None);
        self.settle(self.tell(|session, id| session.release_onto(id, target)));
    }

    /// Merges what is selected: of each what sticks there.
    pub fn join_selection(self) {
        self.flush_text();
        let Some(id) = self.id() else { return };
        let paths: Vec<Path> =
            self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect();
        match self.ask(|session| session.join(id, &paths)) {
            Ok(command) => drop(self.apply(&command)),
            Err(refusal) => self.notice.set(Some(Notice::Refused(refusal))),
        }
    }

    /// Deletes what is selected; where more goes with it, that is told first.
    pub fn delete_selection(self) {
        self.flush_text();
        let Some(path) = self.selected.get_untracked() else { return };
        let (Some(id), Some(parsed)) = (self.id(), session::parse_path(&path)) else { return };
        let command = Command::Delete(parsed.clone());
        let asked = self.ask(|session| session.preview(id, &command).ok().flatten());
        let along = self.ask(|session| session.along_with(id, &parsed));
        if asked.is_some() || along.is_empty() {
            self.apply(&command);
            return;
        }
        let message = words::goes_along(&path, &along);
        let choices = vec![Choice { label: words::delete_all(along.len() + 1), command }];
        self.notice.set(Some(Notice::Asked(Question { message, choices })));
    }

    /// Makes copies of what is selected, a little aside, and selects the first.
    pub fn duplicate_selection(self) {
        self.flush_text();
        let Some(id) = self.id() else { return };
        let paths: Vec<Path> =
            self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect();
        match self.ask(|session| session.duplication(id, &paths)) {
            Ok((command, name)) => {
                if self.apply_as_meant(&command) {
                    self.select(Some(name));
                }
            }
            Err(refusal) => self.notice.set(Some(Notice::Refused(refusal))),
        }
    }

    /// Opens the editor of a thing's value in the picture: of the one that a word there shows, else of the
    /// outermost that the text gives.
    pub fn edit_in_place(self, path: &str, word: Option<&str>, at: (f64, f64)) {
        let found = self.values.with_untracked(|rows| {
            let is_coordinate = |path: &str| matches!(path.rsplit('.').next(), Some("x" | "y"));
            let own =
                rows.iter().filter(|row| covers(path, &row.path) && !is_coordinate(&row.path));
            let depth = |row: &ValueRow| row.path.matches('.').count();
            let is_shown = |row: &ValueRow| {
                word.is_some_and(|word| !row.text.is_empty() && word.contains(&row.text))
            };
            own.min_by_key(|row| (!is_shown(row), row.is_virtual, depth(row), !row.given)).map(
                |row| {
                    let unit =
                        if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
                    InPlace { path: row.path.clone(), value: format!("{}{unit}", row.text), at }
                },
            )
        });
        match found {
            Some(found) => self.editing.set(Some(found)),
            None => self.notice.set(Some(Notice::Said(words::no_value_to_type(path)))),
        }
    }

    /// The names of the libraries.
    pub fn libraries(self) -> Vec<String> {
        self.files.with_value(|files| files.libraries.clone())
    }

    /// Ends a drag as if it had never begun.
    pub fn cancel(self) {
        self.dragging.set(None);
        self.dropping.set(None);
        self.tell(Session::cancel);
        self.refresh();
    }

    /// The reasons for what is selected, or for everything.
    pub fn explain(self, about: Option<&Path>) -> Option<Explanation> {
        let id = self.id()?;
        Some(self.ask(|session| session.explain(id, about)))
    }

    /// What is free, superfluous and contradictory in the shown document.
    pub fn analysis(self) -> Analysis {
        self.tell(Session::analysis).unwrap_or_default()
    }

    /// Why a thing does not move; nothing where it can.
    pub fn held(self, about: &Path) -> Option<HeldView> {
        self.tell(|session, id| session.held(id, about)).flatten()
    }

    /// Where else a thing could be.
    pub fn elsewhere(self, about: &Path) -> Vec<Ghost> {
        let found = self.tell(|session, id| session.ghosts(id, about));
        found.and_then(Result::ok).unwrap_or_default()
    }

    /// Says which classes the selected things could be the parts of.
    pub fn recognise(self) {
        self.flush_text();
        let Some(id) = self.id() else { return };
        let paths: Vec<Path> =
            self.selection().iter().filter_map(|p| session::parse_path(p)).collect();
        self.notice.set(Some(match self.ask(|session| session.recognise(id, &paths)) {
            Ok(found) if found.is_empty() => Notice::Said(String::from(words::NOT_RECOGNISED)),
            Ok(found) => Notice::Recognised(found),
            Err(refusal) => Notice::Refused(refusal),
        }));
    }

    /// Takes note of what the editor holds; it becomes a command a little later, or before the next
    /// one.
    pub fn typed_text(self, text: String) {
        self.pending_text.set_value(Some(text));
        self.typing.update_value(|n| *n += 1);
        let mine = self.typing.get_value();
        set_timeout(
            move || {
                if self.typing.try_get_value() == Some(mine) {
                    self.flush_text();
                }
            },
            TYPING_PAUSE,
        );
    }

    /// Whether the editor holds words that the session has not been given yet.
    pub fn is_typing(self) -> bool {
        self.pending_text.with_value(Option::is_some)
    }

    /// Hands the session what was typed into the editor and not yet handed over.
    pub fn flush_text(self) {
        let typed = self.pending_text.try_update_value(Option::take).flatten();
        if let Some(text) = typed {
            self.settle(self.tell(|session, id| session.apply(id, &Command::Text(text))));
        }
    }

    /// Shows what came of a command.
    fn settle(self, outcome: Option<Result<Change, Refusal>>) -> bool {
        match outcome {
            Some(Ok(change)) => {
                self.refresh();
                self.renew_tool();
                if change.structure && self.fits.get_value() {
                    self.zoom.set(Some(Zoom::Fit));
                }
                self.notice.set(words::done(&change).map(Notice::Said));
                true
            }
            Some(Err(refusal)) => {
                self.refresh();
                self.notice.set(Some(Notice::Refused(refusal)));
                false
            }
            None => false,
        }
    }

    /// Shows a sentence as a refusal.
    pub fn say_refused(self, message: String) {
        self.notice.set(Some(Notice::Refused(Refusal { message, ..Refusal::default() })));
    }

    /// Makes the views that a drag changes, as far as they are in the page.
    fn repaint(self) {
        let Some(id) = self.id() else { return };
        let followed = self
            .picture
            .try_update_untracked(|view| self.ask(|session| session.follow_picture(id, view)));
        self.set_moved(followed.unwrap_or(MovedView::Everything));
        self.picture.notify();
        let dragged = self.structure.with_untracked(|rows| {
            let shown = self.shown_things.get_value();
            self.ask(|session| {
                let part = |at: &usize| rows.get(*at).filter(|row| row.kind == RowKind::Part);
                let value =
                    |row: &StructureRow| session.shown_value(id, &session::parse_path(&row.path)?);
                let of = |at: usize| Some((at, part(&at).and_then(value)?));
                shown.into_iter().filter_map(of).collect()
            })
        });
        self.dragged_values.set(dragged);
        let shown = self.shown_values.get_value();
        self.values.update(|rows| {
            let mut shown = shown.iter().peekable();
            let rows = rows.iter_mut().enumerate();
            let rows = rows.filter(|(at, _)| shown.next_if(|next| *next == at).is_some());
            self.ask(|session| session.renew_values(id, rows.map(|(_, row)| row)));
        });
    }

    fn set_moved(self, moved: MovedView) {
        if self.moved.with_untracked(|before| *before != moved) {
            self.moved.set(moved);
        }
    }

    /// Makes all views.
    fn refresh(self) {
        let Some(id) = self.id() else { return };
        let (picture, values) = self.ask(|session| (session.picture(id), session.values(id)));
        self.set_moved(MovedView::Everything);
        self.picture.set(picture);
        self.values.set(values);
        let (structure, text, status, title) = self.ask(|session| {
            (session.structure(id), session.text(id), session.status(id), session.title(id))
        });
        self.structure.set(structure);
        self.dragged_values.update(BTreeMap::clear);
        self.status.set(status);
        self.update_document(|document| {
            document.dirty = document.saved != text.source;
            document.title = title;
        });
        self.keep_draft(&text.source);
        self.text.set(text);
    }

    fn update_document(self, change: impl FnOnce(&mut Opened)) {
        let Some(path) = self.current.get_untracked() else { return };
        let Some(mut document) = self.document.get_untracked() else { return };
        change(&mut document);
        if self.document.with_untracked(|old| old.as_ref() != Some(&document)) {
            self.opened.update_value(|all| {
                all.insert(path, document.clone());
            });
            self.document.set(Some(document));
        }
    }

    /// Keeps unsaved text in the browser, outside the bundle's memory.
    fn keep_draft(self, source: &str) {
        let Some(path) = self.current.get_untracked() else { return };
        let dirty = self.document.with_untracked(|d| d.as_ref().is_some_and(|d| d.dirty));
        if dirty {
            theme::put(&draft_key(&path), Some(source));
        } else if self.draft.with_untracked(Option::is_none) {
            theme::put(&draft_key(&path), None);
        }
    }

    /// Takes up the unsaved text of an earlier visit, or forgets it.
    pub fn decide_draft(self, restore: bool) {
        let Some(draft) = self.draft.get_untracked() else { return };
        self.draft.set(None);
        if restore {
            self.apply(&Command::Text(draft));
        } else {
            let source = self.text.with_untracked(|text| text.source.clone());
            self.keep_draft(&source);
        }
    }

    /// Returns true if any open document has changes that are not on disk.
    pub fn any_unsaved(self) -> bool {
        self.pending_text.with_value(Option::is_some)
            || self.opened.with_value(|all| all.values().any(|opened| opened.dirty))
    }

    /// Begins a new document, under a name that no other has.
    pub fn begin_new(self) {
        leptos::task::spawn_local(async move {
            let path = self.free_path(UNTITLED).await;
            route::go(&route::to(&path));
        });
    }

    /// A path that no document has, here or on the server.
    async fn free_path(self, name: &str) -> String {
        // Without the list there are still the documents that are open.
        let _ = self.fetch_list().await;
        let paths = std::iter::once(format!("{name}.thing"))
            .chain((2..).map(|n| format!("{name}-{n}.thing")));
        let is_free = |path: &String| {
            !self.opened.with_value(|all| all.contains_key(path))
                && !self.listed.with_untracked(|all| all.iter().any(|one| one.path == *path))
        };
        { paths }.find(is_free).unwrap_or_default()
    }

    /// Lets a person choose a file of the machine; its text becomes a new document of that name.
    pub fn open_file(self) {
        let took = Closure::once_into_js(move |name: String, text: String| {
            leptos::task::spawn_local(async move {
                let path = self.free_path(name.strip_suffix(".thing").unwrap_or(&name)).await;
                let stored = Stored { text, version: String::from(ABSENT), writable: true };
                match self.take_up(&path, stored).await {
                    Ok(_) => route::go(&route::to(&path)),
                    Err(message) => self.say_refused(message),
                }
            });
        });
        js::choose_file(took.unchecked_ref());
    }

    /// Saves the shown document under another name, which becomes its own.
    ///
    /// # Errors
    /// One sentence: a document of that name is there, or it is no name for one.
    pub async fn save_as(self, name: &str) -> Result<(), String> {
        self.flush_text();
        let name = name.trim().trim_end_matches(".thing");
        let path = format!("{name}.thing");
        let (Some(old), Some(document)) =
            (self.current.get_untracked(), self.document.get_untracked())
        else {
            return Ok(());
        };
        let text = self.text.with_untracked(|text| text.source.clone());
        let outcome = server::save(&path, &text, ABSENT).await;
        match outcome {
            Saved::Done(version) => {
                theme::put(&draft_key(&old), None);
                self.order(|session| session.rename(document.id, &path));
                let writable = true;
                let opened = Opened { version, writable, saved: text, dirty: false, ..document };
                self.opened.update_value(|all| {
                    all.remove(&old);
                    all.insert(path.clone(), opened.clone());
                });
                self.current.set(Some(path.clone()));
                self.document.set(Some(opened));
                route::replace(&route::to(&path));
                self.refresh();
                self.notice.set(Some(Notice::Said(words::saved(&path))));
                Ok(())
            }
            Saved::Changed(_) => Err(words::name_taken(&path)),
            Saved::Failed(message) => Err(message),
        }
    }

    /// Saves the shown document; a new one is asked for its name first.
    pub fn save(self) {
        self.flush_text();
        let untitled = self.document.with_untracked(|d| d.as_ref().is_some_and(Opened::is_new))
            && self.current.with_untracked(|path| {
                path.as_ref().is_some_and(|path| path.starts_with(UNTITLED))
            });
        if untitled {
            self.wish.set(Some(Wish::SaveAs));
            return;
        }
        let Some(path) = self.current.get_untracked() else { return };
        let Some(document) = self.document.get_untracked() else { return };
        let text = self.text.with_untracked(|text| text.source.clone());
        leptos::task::spawn_local(async move {
            let outcome = server::save(&path, &text, &document.version).await;
            self.saved(&path, text, outcome);
        });
    }

    fn saved(self, path: &str, text: String, outcome: Saved) {
        if self.current.with_untracked(|current| current.as_deref() != Some(path)) {
            return;
        }
        match outcome {
            Saved::Done(version) => {
                let now = self.text.with_untracked(|text| text.source.clone());
                self.conflict.set(None);
                self.update_document(|document| {
                    document.dirty = now != text;
                    (document.version, document.saved, document.writable) = (version, text, true);
                });
                self.keep_draft(&now);
                self.notice.set(Some(Notice::Said(words::saved(path))));
            }
            Saved::Changed(theirs) => self.conflict.set(Some(theirs)),
            Saved::Failed(message) => self.say_refused(message),
        }
    }

    /// Takes what stands on disk instead: one step, which can be taken back.
    pub fn take_theirs(self) {
        if let Some(Some(theirs)) = self.conflict.get_untracked() {
            self.conflict.set(None);
            self.update_document(|document| {
                (document.version, document.saved) = (theirs.version, theirs.text.clone());
            });
            self.apply(&Command::Text(theirs.text));
        }
    }

    /// Saves over what stands on disk instead.
    pub fn overwrite(self) {
        if let Some(theirs) = self.conflict.get_untracked() {
            self.conflict.set(None);
            let version = theirs.map_or_else(|| String::from("absent"), |stored| stored.version);
            self.update_document(|document| document.version = version);
            self.save();
        }
    }

    /// Hands the user the text as a file.
    pub fn download(self) {
        self.flush_text();
        let Some(path) = self.current.get_untracked() else { return };
        let name = path.rsplit('/').next().unwrap_or(&path);
        self.text.with_untracked(|text| js::download(name, &text.source));
    }

    /// Shows or hides the grid, and remembers it.
    pub fn toggle_grid(self) {
        self.grid.update(|grid| *grid = !*grid);
        theme::put(GRID_KEY, Some(if self.grid.get_untracked() { "on" } else { "off" }));
    }

    /// Changes the part of the sheet that one sees, as a person does by hand.
    pub fn look_at(self, change: impl FnOnce(View) -> View) {
        self.fits.set_value(false);
        self.view.update(|view| *view = change(*view));
    }

    /// Selects a thing alone, or nothing.
    pub fn select(self, path: Option<String>) {
        if !self.also.with_untracked(Vec::is_empty) {
            self.also.set(Vec::new());
        }
        if self.selected.with_untracked(|old| *old != path) {
            self.selected.set(path);
        }
    }

    /// Selects a thing besides what is selected, or lets it go again.
    pub fn select_also(self, path: &str) {
        let mut selection = self.selection_untracked();
        match selection.iter().position(|p| p == path) {
            Some(at) => drop(selection.remove(at)),
            None => selection.push(String::from(path)),
        }
        let mut selection = selection.into_iter();
        self.selected.set(selection.next());
        self.also.set(selection.collect());
    }

    /// The paths of all that is selected, in the order of choosing.
    pub fn selection(self) -> Vec<String> {
        self.selected.get().into_iter().chain(self.also.get()).collect()
    }

    /// The same, for whoever does not follow it.
    pub fn selection_untracked(self) -> Vec<String> {
        untrack(|| self.selection())
    }

    /// Opens the menu of what is selected, where it is seen; without a selection that of the sheet.
    pub fn open_menu_at_selection(self) {
        let selected = self.selected.get_untracked();
        let context = if selected.is_some() { Context::Thing } else { Context::Sheet };
        let canvas = document().get_element_by_id("picture");
        let Some(rect) = canvas.map(|canvas| canvas.get_bounding_client_rect()) else { return };
        let grip = self.picture.with_untracked(|picture| {
            let is_part = |path: &str| selected.as_ref().is_some_and(|s| covers(s, path));
            picture.grips.iter().find(|grip| is_part(&grip.path)).map(|grip| (grip.x, grip.y))
        });
        let (x, y) = match grip {
            Some((x, y)) => self.view.with_untracked(|view| view.screen_from_sheet(Point { x, y })),
            None => (rect.width() / 2.0, rect.height() / 2.0),
        };
        menu::open_at(self, (rect.left() + x + 8.0, rect.top() + y + 8.0), context);
    }

    /// Marks what the pointer is over, in whatever view.
    pub fn hover(self, path: Option<String>) {
        if self.hovered.with_untracked(|old| *old != path) {
            self.hovered.set(path);
        }
    }
}

impl Default for Lab {
    fn default() -> Self {
        Self::new()
    }
}

const GRID_KEY: &str = "thinglab/grid";
const TYPING_PAUSE: Duration = Duration::from_millis(150);

/// What stands under a path: on disk, in the gallery, or the beginning of a document that is not there yet.
async fn stands(path: &str) -> Result<Stored, String> {
    let begun =
        || Stored { text: String::from(NEW_TEXT), version: String::from(ABSENT), writable: true };
    Ok(server::document(path).await?.unwrap_or_else(begun))
}

fn draft_key(path: &str) -> String {
    format!("thinglab/draft/{path}")
}

/// The path of a file that a document names in `use`: `parts.bolts` is `parts/bolts.thing` beside it.
fn beside(folder: &str, name: &str) -> String {
    let file = format!("{}.thing", name.replace('.', "/"));
    if folder.is_empty() { file } else { format!("{folder}/{file}") }
}

/// Returns the path that a path is the same thing as: the first of those merged.
pub fn first_path(rows: &[StructureRow], path: String) -> String {
    let row = rows.iter().find(|row| row.path == path && row.merged_with.is_some());
    row.and_then(|row| row.merged_with.clone()).unwrap_or(path)
}

/// What `use` calls a file: `parts/bolts.thing` is `parts.bolts`.
fn used_as(file: &str) -> String {
    file.strip_suffix(".thing").unwrap_or(file).replace('/', ".")
}

/// The text view of no document.
fn no_text() -> TextView {
    TextView { source: String::new(), tokens: Vec::new(), diagnostics: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::{beside, used_as};

    #[test]
    fn a_used_file_lies_beside_its_user() {
        assert_eq!(beside("", "bolts"), "bolts.thing");
        assert_eq!(beside("gallery", "parts.bolts"), "gallery/parts/bolts.thing");
        assert_eq!(used_as("parts/bolts.thing"), "parts.bolts");
    }
}
