//! The lab: the session, which documents are open in it, and what their views show.
//!
//! In: what the panels ask for. Out: signals that the panels paint. Between press and release of a
//! drag only the picture and the values are made anew, and nothing is asked of the server.

use crate::actions::Context;
use crate::annotated::Annotated;
use crate::dialog::Wish;
use crate::dock::{self, Sheet, Tab};
use crate::drafting::Drafting;
use crate::files::Files;
use crate::first;
use crate::js;
use crate::keyboard::KeysAt;
use crate::menu::{self, Menu};
use crate::player::Player;
use crate::plot::Plotting;
use crate::server::Stored;
use crate::sheet::View;
use crate::theme;
use drawing::Point;
use leptos::prelude::*;
use presentation::drafts::Journal;
use presentation::files::FileSet;
use presentation::marks::Marked;
use presentation::palette::Listed;
use presentation::paths::covers;
use session::view::{
    BinEntry, Caught, DocumentId, DragState, Explanation, HeldView, LessonView, MovedView,
    PictureView, Question, Recognised, Refusal, Status, StructureRow, TextView, ToolView, ValueRow,
    Velocity,
};
use session::{Clip, Path, Session};
use std::collections::BTreeMap;
use std::fmt;

mod documents;
mod drafts;
mod edits;
mod export;
mod jobs;
mod prototype;
mod remote;
mod views;

pub use drafts::Offered;
pub use jobs::{Jobs, Kind, Told};
pub use prototype::Shown;

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
    pub(crate) files: StoredValue<FileSet>,
    opened: StoredValue<BTreeMap<String, Opened>>,
    pending_text: StoredValue<Option<String>>,
    /// The byte of the text behind which somebody has just typed, until the cursor leaves it.
    pub typed_at: RwSignal<Option<u32>>,
    typing: StoredValue<u32>,
    /// How often tables were asked for again: only what came of the last time counts.
    renewals: StoredValue<u32>,
    listing: StoredValue<views::Rows, LocalStorage>,
    /// How many milliseconds the picture's last frame took to paint.
    pub painted_in: StoredValue<f64>,
    /// The path of the document that is shown; none in the gallery.
    pub current: RwSignal<Option<String>>,
    /// Whether the page has begun with a document that is still to come.
    pub arriving: RwSignal<bool>,
    /// How often a document that the address names was begun to be opened, and its path while it comes.
    pub coming: StoredValue<(usize, Option<String>)>,
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
    /// How often the rows of the values view have become others; a drag changes only what they say.
    pub value_rows: RwSignal<u32>,
    /// Which rows of the values view are in the page, in order: those that a drag keeps up to date.
    pub shown_values: StoredValue<Vec<usize>>,
    /// The same for the rows in the inspector.
    pub inspected_values: StoredValue<Vec<usize>>,
    /// Whether the first minute is offered.
    pub first: RwSignal<bool>,
    /// The lesson that goes on.
    pub lesson: RwSignal<Option<LessonView>>,
    /// How far its card reaches down over the picture at the most, in pixels.
    pub card: RwSignal<f64>,
    /// What the lesson has one trace.
    pub traced: Memo<drawing::Drawing>,
    /// The lesson that the shown document offers.
    pub lesson_offered: RwSignal<Option<String>>,
    /// What was copied last, and how often it was put down since.
    pub clip: RwSignal<Option<(Clip, u32)>>,
    /// The band that is drawn over what is to be selected, by its corners on the canvas: pressed, and now.
    pub band: RwSignal<Option<[(f64, f64); 2]>>,
    /// What the dock shows, where it is open.
    pub dock: RwSignal<Option<Tab>>,
    /// What a narrow page has pulled up.
    pub sheet: RwSignal<Sheet>,
    /// How often tables were found to be others.
    pub tables: RwSignal<u32>,
    /// Its text view.
    pub text: RwSignal<TextView>,
    /// Its status line.
    pub status: RwSignal<Status>,
    /// Its picture.
    pub picture: RwSignal<PictureView>,
    /// The path of the selected thing.
    pub selected: RwSignal<Option<String>>,
    /// The same for the inspector, which follows a hand once the picture has been painted.
    pub inspected: RwSignal<Option<String>>,
    /// Whether a hand presses the picture.
    pub pressed: StoredValue<bool>,
    /// The paths of what is selected besides, in the order of choosing.
    pub also: RwSignal<Vec<String>>,
    /// Whether a finger or a pen is at work, which have no keys.
    pub touch: RwSignal<bool>,
    /// Whether what is picked next is selected besides, without a key.
    pub adding: RwSignal<bool>,
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
    /// How often something else was meant to be tried before it is done: only the last is shown.
    pub foreseen: StoredValue<u32>,
    /// What was seen before what is foreseen was brought into sight.
    pub seen_before: StoredValue<Option<View>>,
    /// What there is to say.
    pub notice: RwSignal<Option<Notice>>,
    /// Where the present drag has got to, if there is one.
    pub dragging: RwSignal<Option<DragState>>,
    /// The documents that the server offers, as of the last time it was asked.
    pub listed: RwSignal<Vec<Listed>>,
    /// What stands on disk instead, after a save was refused for it.
    pub conflict: RwSignal<Option<Option<Stored>>>,
    /// Unsaved text of an earlier visit.
    pub draft: RwSignal<Option<Offered>>,
    /// Whether the browser has refused to keep the latest draft.
    is_unkept: StoredValue<bool>,
    /// Where something was recorded when the latest draft was kept.
    kept_at: StoredValue<Option<String>>,
    /// What the server is still to keep.
    journal: StoredValue<Journal>,
    /// Whether the explanation panel is open.
    pub why: RwSignal<bool>,
    /// Whether the palette of actions is open.
    pub palette: RwSignal<bool>,
    /// What libraries have, once somebody looks for something in them.
    of_libraries: RwSignal<Option<Vec<BinEntry>>>,
    /// The class of the things that the tool in the hand makes.
    pub tool: RwSignal<Option<String>>,
    /// What that tool shows.
    pub tool_view: RwSignal<ToolView>,
    /// What was typed of a length, while a tool is held.
    pub typed: RwSignal<String>,
    /// Where the arrow keys have brought the pointer, on the canvas.
    pub cursor: RwSignal<Option<(f64, f64)>>,
    /// Where on the sheet a key has brought the tool in the hand; nothing once the pointer has moved it.
    pub keyed: RwSignal<Option<(f64, f64)>>,
    /// Where keys go; nothing while a pointer was used last.
    pub keys: RwSignal<Option<KeysAt>>,
    /// Whether the tool was taken out of the bin with the button held down.
    pub carried: StoredValue<bool>,
    /// What the thing that is dragged would be joined with.
    pub dropping: RwSignal<Option<(Path, Caught)>>,
    /// What plays values.
    pub player: Player,
    /// The expressions of the calculator.
    pub sums: RwSignal<Vec<String>>,
    /// What is plotted.
    pub plotting: Plotting,
    /// The questions that take long.
    pub jobs: Jobs,
    /// What of drafting there is.
    pub drafting: Drafting,
    /// What the left drawer shows.
    pub drawer: RwSignal<Drawer>,
    /// The value that is typed in the picture, and where on the canvas.
    pub editing: RwSignal<Option<InPlace>>,
    /// The class whose tile was asked for its menu last.
    pub of_tile: RwSignal<Option<String>>,
    /// The menu that is open.
    pub menu: RwSignal<Option<Menu>>,
    /// While a class is made of the selection, the points by which its things are placed.
    pub attachers: RwSignal<Option<Vec<String>>>,
    /// How many stages of a long opening are done, with the part of the present one, while there is one.
    pub opening: RwSignal<Option<f64>>,
    /// How often long openings were given up: one goes on as long as this is what it was when it began.
    pub given_up: StoredValue<usize>,
    /// The class whose prototype is shown instead of the document.
    pub prototype: RwSignal<Option<Shown>>,
    /// What a person is asked to type.
    pub wish: RwSignal<Option<Wish>>,
    /// What constraints say, on the drawing.
    pub annotated: Annotated,
    /// Whether the picture has a grid.
    pub grid: RwSignal<bool>,
    /// What the picture is asked to do with its view.
    pub zoom: RwSignal<Option<Zoom>>,
    /// The part of the sheet that one sees.
    pub view: RwSignal<View>,
    /// Whether the view is one that fits, and shall fit when the panel's size changes.
    pub fits: StoredValue<bool>,
    /// Whether a person has zoomed or moved it since all of it was brought into sight.
    pub looked: StoredValue<bool>,
    /// The page's colours.
    pub colors: theme::Colors,
}

impl fmt::Debug for Lab {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lab").finish_non_exhaustive()
    }
}

/// What the left drawer shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Drawer {
    /// The tree of things.
    Structure,
    /// Constructions, and programs recorded.
    Draw,
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
    /// Everything in sight, if it lies outside or is too small to see.
    Seen,
    /// Everything in sight and a good part of it, after a length was typed, unless a person has looked elsewhere.
    Sized,
    /// Everything in sight, if it was before a change, as this box tells: moved no further than it must be. Else, where
    /// that is asked, as [`Zoom::Seen`].
    Kept(drawing::Bounds, bool),
    /// As [`Zoom::Seen`], and what hangs over a side is moved into sight, never larger, unless a person has looked elsewhere.
    Within,
    /// A box of the sheet in sight, unless it is: moved no further than it must be, and never larger.
    Over(drawing::Bounds),
    /// Larger or smaller by this factor.
    By(f64),
}

/// What a lesson has one trace.
fn traced_by(lesson: RwSignal<Option<LessonView>>) -> drawing::Drawing {
    lesson.with(|lesson| lesson.as_ref().map(|l| l.traced.clone()).unwrap_or_default())
}

/// What is lit in the picture: what is selected, all of it, and what the pointer is over.
fn marked(
    structure: RwSignal<Vec<StructureRow>>,
    (selected, also): (RwSignal<Option<String>>, RwSignal<Vec<String>>),
    hovered: RwSignal<Option<String>>,
) -> Marked {
    structure.with(|rows| {
        let first = |path: String| first_path(rows, path);
        let selected = selected.get().into_iter().chain(also.get());
        Marked {
            selected: selected.map(first).collect(),
            hovered: hovered.get().map(first),
            recorded: None,
        }
    })
}

impl Lab {
    /// Makes a lab without documents.
    pub fn new() -> Self {
        let (selected, hovered) = (RwSignal::new(None), RwSignal::new(None));
        let (also, structure) = (RwSignal::new(Vec::new()), RwSignal::new(Vec::new()));
        let files = StoredValue::new(FileSet::default());
        let lesson = RwSignal::new(None::<LessonView>);
        Self {
            session: StoredValue::new_local(Session::new(Box::new(Files(files)))),
            files,
            opened: StoredValue::new(BTreeMap::new()),
            pending_text: StoredValue::new(None),
            typed_at: RwSignal::new(None),
            typing: StoredValue::new(0),
            renewals: StoredValue::new(0),
            listing: StoredValue::new_local(views::Rows::default()),
            painted_in: StoredValue::new(0.0),
            current: RwSignal::new(None),
            arriving: RwSignal::new(false),
            coming: StoredValue::new((0, None)),
            document: RwSignal::new(None),
            structure,
            values: RwSignal::new(Vec::new()),
            value_rows: RwSignal::new(0),
            shown_things: StoredValue::new(Vec::new()),
            dragged_values: RwSignal::new(BTreeMap::new()),
            shown_values: StoredValue::new(Vec::new()),
            inspected_values: StoredValue::new(Vec::new()),
            first: RwSignal::new(first::is_offered()),
            lesson,
            traced: Memo::new(move |_| traced_by(lesson)),
            card: RwSignal::new(0.0),
            lesson_offered: RwSignal::new(None),
            clip: RwSignal::new(None),
            band: RwSignal::new(None),
            dock: RwSignal::new(dock::kept()),
            sheet: RwSignal::new(Sheet::Shut),
            tables: RwSignal::new(0),
            text: RwSignal::new(no_text()),
            status: RwSignal::new(Status::default()),
            picture: RwSignal::new(PictureView::default()),
            moved: RwSignal::new(MovedView::Everything),
            selected,
            inspected: RwSignal::new(None),
            pressed: StoredValue::new(false),
            also,
            touch: RwSignal::new(js::coarse()),
            adding: RwSignal::new(false),
            hovered,
            marked: Memo::new(move |_| marked(structure, (selected, also), hovered)),
            motion: RwSignal::new(Vec::new()),
            ghosts: RwSignal::new(Vec::new()),
            foreseen: StoredValue::new(0),
            seen_before: StoredValue::new(None),
            notice: RwSignal::new(None),
            dragging: RwSignal::new(None),
            listed: RwSignal::new(Vec::new()),
            conflict: RwSignal::new(None),
            draft: RwSignal::new(None),
            is_unkept: StoredValue::new(false),
            kept_at: StoredValue::new(None),
            journal: StoredValue::default(),
            why: RwSignal::new(false),
            palette: RwSignal::new(false),
            of_libraries: RwSignal::new(None),
            tool: RwSignal::new(None),
            tool_view: RwSignal::new(ToolView::default()),
            typed: RwSignal::new(String::new()),
            cursor: RwSignal::new(None),
            keyed: RwSignal::new(None),
            keys: RwSignal::new(None),
            carried: StoredValue::new(false),
            dropping: RwSignal::new(None),
            player: Player::default(),
            sums: RwSignal::new(Vec::new()),
            plotting: Plotting::default(),
            jobs: Jobs::default(),
            drafting: Drafting::default(),
            drawer: RwSignal::new(Drawer::Structure),
            editing: RwSignal::new(None),
            of_tile: RwSignal::new(None),
            menu: RwSignal::new(None),
            attachers: RwSignal::new(None),
            opening: RwSignal::new(None),
            given_up: StoredValue::new(0),
            prototype: RwSignal::new(None),
            wish: RwSignal::new(None),
            annotated: Annotated::new(),
            grid: RwSignal::new(theme::keep(GRID_KEY).is_none_or(|kept| kept != "off")),
            zoom: RwSignal::new(None),
            view: RwSignal::new(View::default()),
            fits: StoredValue::new(true),
            looked: StoredValue::new(false),
            colors: theme::start(),
        }
    }

    /// Returns the shown document's id.
    pub fn id(self) -> Option<DocumentId> {
        self.document.with_untracked(|d| d.as_ref().map(|d| d.id))
    }

    /// Asks the session something.
    pub fn ask<T>(self, question: impl FnOnce(&Session) -> T) -> T {
        self.session.with_value(question)
    }

    /// Asks the session something about the shown document.
    pub fn ask_of_shown<T>(self, question: impl FnOnce(&Session, DocumentId) -> T) -> Option<T> {
        let id = self.id()?;
        Some(self.ask(|session| question(session, id)))
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

    /// The reasons for what is selected, or for everything.
    pub fn explain(self, about: Option<&Path>) -> Option<Explanation> {
        let id = self.id()?;
        Some(self.ask(|session| session.explain(id, about)))
    }

    /// Why a thing does not move; nothing where it can.
    pub fn held(self, about: &Path) -> Option<HeldView> {
        self.tell(|session, id| session.held(id, about)).flatten()
    }

    /// Shows a sentence as a refusal.
    pub fn say_refused(self, message: String) {
        self.notice.set(Some(Notice::Refused(Refusal { message, ..Refusal::default() })));
    }

    /// Shows or hides the grid, and remembers it.
    pub fn toggle_grid(self) {
        self.grid.update(|grid| *grid = !*grid);
        theme::put(GRID_KEY, Some(if self.grid.get_untracked() { "on" } else { "off" }));
    }

    /// Changes the part of the sheet that one sees, as a person does by hand.
    pub fn look_at(self, change: impl FnOnce(View) -> View) {
        self.fits.set_value(false);
        let before = self.view.get_untracked();
        self.view.update(|view| *view = change(*view));
        if self.view.get_untracked() != before {
            self.looked.set_value(true);
        }
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

    /// Does something at once, but while a hand presses the picture once so many frames have been painted: panels follow
    /// a hand one after the other.
    pub fn behind_hand(self, frames: u32, run: Box<dyn FnOnce()>) {
        match frames.checked_sub(1).filter(|_| self.pressed.get_value()) {
            Some(left) => js::after_painting(move || self.behind_hand(left, run)),
            None => run(),
        }
    }

    /// Selects some things together, in this order.
    pub fn select_all(self, paths: &[String]) {
        let mut paths = paths.iter().cloned();
        self.selected.set(paths.next());
        self.also.set(paths.collect());
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
        // the row that has the keyboard is where one looks
        let row = document().query_selector("[role=treeitem]:focus").ok().flatten();
        if let Some(row) = row.map(|row| row.get_bounding_client_rect()) {
            return menu::open_at(self, (row.left() + 40.0, row.bottom()), context);
        }
        let canvas = document().get_element_by_id("picture");
        let Some(rect) = canvas.map(|canvas| canvas.get_bounding_client_rect()) else { return };
        let middle = (rect.left() + rect.width() / 2.0, rect.top() + rect.height() / 2.0);
        let (x, y) = self.seen_at().unwrap_or(middle);
        menu::open_at(self, (x + 8.0, y + 8.0), context);
    }

    /// Where the picture shows what is selected, in the window: a constraint by its words, a thing by its first grip.
    pub fn seen_at(self) -> Option<(f64, f64)> {
        let selected = self.selected.get_untracked()?;
        let rect = document().get_element_by_id("picture")?.get_bounding_client_rect();
        let note = self.annotated.notes.with_value(|notes| {
            notes.iter().find(|note| note.path == selected).map(|note| note.at)
        });
        let grip = || {
            let at = self.picture.with_untracked(|picture| {
                let grip = picture.grips.iter().find(|grip| covers(&selected, &grip.path));
                grip.map(|grip| Point { x: grip.x, y: grip.y })
            });
            at.map(|at| self.view.with_untracked(|view| view.screen_from_sheet(at)))
        };
        let (x, y) = note.or_else(grip)?;
        Some((rect.left() + x, rect.top() + y))
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

/// Returns the path that a path is the same thing as: the first of those merged.
pub fn first_path(rows: &[StructureRow], path: String) -> String {
    let row = rows.iter().find(|row| row.path == path && row.merged_with.is_some());
    row.and_then(|row| row.merged_with.clone()).unwrap_or(path)
}

/// The text view of no document.
fn no_text() -> TextView {
    TextView { source: String::new(), diagnostics: Vec::new() }
}
