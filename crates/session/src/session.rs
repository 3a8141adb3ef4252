//! The session: open documents, and what is done to them.

use crate::advice;
use crate::apply;
use crate::calculator;
use crate::check;
use crate::complaints;
use crate::document::Open;
use crate::drafting;
use crate::drag;
use crate::ghosts;
use crate::host::{self, Beside, Host};
use crate::joining;
use crate::opening::Opening;
use crate::plotting;
use crate::recognise;
use crate::state::State;
use crate::texts::Texts;
use crate::tools::copies::{Clip, Relations};
use crate::tools::{self, Tool};
use crate::view::{
    Advice, Affected, Along, Analysis, BinEntry, Change, CheckReport, CompletionView,
    DiagnosticView, DocumentId, DragState, Explanation, FamilyRow, FamilyView, FixView, Ghost,
    HeldView, MovedView, PictureView, Pointer, Question, Recognised, Refusal, RowFormats,
    RowOutcome, Status, StructureRow, TableView, TextView, TokenView, ToolView, ValueRow,
};
use crate::views;
use crate::views::listing::Listing;
use crate::words;
use kernel::{Command, Path, Step, ThingId};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// A set of open documents.
///
/// ```
/// use session::{Command, Host, Literal, Path, Session};
/// struct Nothing;
/// impl Host for Nothing {
///     fn read(&self, _: &str) -> Option<String> { None }
/// }
/// let mut session = Session::new(Box::new(Nothing));
/// let id = session.open("sum", "a: Real = 1\nb: Real\nconstraint b = a + 1\n");
/// let command = Command::Set(vec![(Path::of(&["b"]), Literal::Number(5.0))]);
/// session.apply(id, &command).expect("a can give way");
/// assert_eq!(session.text(id).source, "a: Real = 4\nb: Real\nconstraint b = a + 1\n");
/// ```
pub struct Session {
    pub(crate) host: Box<dyn Host>,
    pub(crate) documents: Vec<Open>,
    /// How the tiles of the bin look.
    tiles: RefCell<tools::bin::Tiles>,
}

impl std::fmt::Debug for Session {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("documents", &self.documents.len()).finish_non_exhaustive()
    }
}

impl Session {
    /// Makes a session without documents.
    pub fn new(host: Box<dyn Host>) -> Self {
        Self { host, documents: Vec::new(), tiles: RefCell::default() }
    }
    /// Opens a document. Never fails: what is wrong with its text, [`Session::text`] says.
    pub fn open(&mut self, name: &str, text: &str) -> DocumentId {
        let id = DocumentId(self.documents.len() as u32);
        let beside = Beside::opening(&*self.host, &self.documents, name);
        let open = Open::of(name, text.into(), &beside);
        self.documents.push(open);
        id
    }
    /// Begins to open a document.
    pub fn begin_opening(&self, name: &str, text: &str) -> Opening {
        Opening::of(name, text)
    }
    /// Goes on with an opening by one stage.
    pub fn go_on_opening(&self, opening: Opening) -> Opening {
        let name = opening.name().to_string();
        opening.go_on(&Beside::opening(&*self.host, &self.documents, &name))
    }
    /// Ends an opening, with all that is left of it.
    pub fn end_opening(&mut self, opening: Opening) -> DocumentId {
        let id = DocumentId(self.documents.len() as u32);
        let name = opening.name().to_string();
        let open = opening.finished(&Beside::opening(&*self.host, &self.documents, &name));
        self.documents.push(open);
        id
    }
    /// Gives a document another name, under which it was saved.
    pub fn rename(&mut self, id: DocumentId, name: &str) {
        let home = self.home(id);
        self.document_mut(home).name = name.into();
    }
    pub(crate) fn document(&self, id: DocumentId) -> &Open {
        self.documents.get(id.0 as usize).expect("a document id comes from this session's open")
    }
    pub(crate) fn document_mut(&mut self, id: DocumentId) -> &mut Open {
        self.documents.get_mut(id.0 as usize).expect("a document id comes from this session's open")
    }
    /// Returns a document to be changed, and what stands beside it.
    pub(crate) fn beside_others(&mut self, id: DocumentId) -> (&mut Open, Beside<'_>) {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = self.documents.get_mut(id.0 as usize);
        (open.expect("a document id comes from this session's open"), beside)
    }
    /// Applies a command: one undo step with all that it implies.
    ///
    /// # Errors
    /// Why it was refused; then nothing has changed.
    pub fn apply(&mut self, id: DocumentId, command: &Command) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        open.drag = None;
        if open.pane.is_some() {
            return self.apply_in_pane(id, command);
        }
        let mut change = apply::apply(open, &beside, command)?;
        if !change.edits.is_empty() {
            change.documents = self.reach(id);
        }
        Ok(change)
    }
    /// Brings documents that use another up to date with it, and says what that did to them.
    pub(crate) fn reach(&mut self, id: DocumentId) -> Vec<Affected> {
        let name = self.document(id).name.clone();
        let mut affected = Vec::new();
        for i in 0..self.documents.len() {
            let document = DocumentId(i as u32);
            let name = host::used_as(&name, &self.documents[i].name);
            let is_used = |name: &String| self.documents[i].state.lowered.uses(name);
            if document != id && name.as_ref().is_some_and(is_used) {
                affected.extend(self.catch_up(document));
            }
        }
        affected
    }
    /// Reads again what a document uses, where that has changed or is there only now: no step of its own. Returns what
    /// came of it.
    pub fn catch_up(&mut self, document: DocumentId) -> Option<Affected> {
        let (open, beside) = self.beside_others(document);
        let unsatisfied = apply::catch_up(open, &beside)?;
        Some(Affected { document, unsatisfied })
    }
    /// Returns what has to be asked before a command is applied, if anything: whether it is meant of
    /// one thing, which becomes a class of one, or of all things of its class.
    ///
    /// # Errors
    /// Why the command would be refused. Either way nothing changes.
    pub fn preview(&self, id: DocumentId, command: &Command) -> Result<Option<Question>, Refusal> {
        let command = self.at_home(id, command)?;
        apply::preview(&self.document(self.home(id)).state, &command)
    }
    /// Returns which classes some parts, at most six, could be the parts of, one to one by class and
    /// with every constraint true; those with most constraints first.
    ///
    /// # Errors
    /// No parts, too many, one twice, or a path that leads nowhere.
    pub fn recognise(&self, id: DocumentId, paths: &[Path]) -> Result<Vec<Recognised>, Refusal> {
        recognise::recognise(&self.document(id).state, paths)
    }
    /// Mends what a diagnostic speaks of, by one of its fixes.
    ///
    /// # Errors
    /// The text is no longer the one that the fix was made for.
    pub fn fix(&mut self, id: DocumentId, fix: &FixView) -> Result<Change, Refusal> {
        let text = &self.document(self.home(id)).state.text;
        let fits =
            |e: &crate::view::TextChange| text.get(e.start as usize..e.end as usize).is_some();
        if !fix.edits.iter().all(fits) {
            return Err(words::refuse("the text has changed meanwhile".into()));
        }
        let edits: Vec<syntax::TextEdit> = fix.edits.iter().map(syntax::TextEdit::from).collect();
        let text = syntax::edit::apply(text, &edits);
        self.apply(id, &Command::Text(text))
    }
    /// Sets a value to what a person typed: `300 ohm`, `2*80`, `(3, 4)`, any words for a text.
    ///
    /// # Errors
    /// Why it was refused: the path leads nowhere, the words are no value, a constraint forbids it.
    pub fn set_typed(
        &mut self,
        id: DocumentId,
        path: &str,
        typed: &str,
    ) -> Result<Change, Refusal> {
        let path = parse_path(path).ok_or_else(|| words::refuse(format!("{path} is no path")))?;
        if let Some(change) = self.set_template(id, &path, typed) {
            return change;
        }
        if let Some(change) = self.set_with_unit(id, &path, typed) {
            return change;
        }
        let state = &self.document(id).state;
        let literal = words::read_typed(state, &path, typed)?;
        let target = crate::by_hand::anchored_whole(state, &path, &literal);
        let target = target.unwrap_or_else(|| (path.clone(), literal));
        match self.apply(id, &Command::Set(vec![target])) {
            Ok(change) => Ok(self.in_unit_typed(id, &path, typed, change)),
            Err(refusal) => self.tell_anew(id, &path, typed).unwrap_or(Err(refusal)),
        }
    }
    /// Begins a drag of a number, of a place, or of a thing with all the places that it is made of.
    ///
    /// Returns where its handle is on the sheet: what [`Session::drag`] then moves. For a thing it is
    /// the first of its places.
    ///
    /// # Errors
    /// Why the thing cannot be dragged: there is none, it has no place, or an anchor holds it.
    pub fn press(&mut self, id: DocumentId, path: &Path) -> Result<(f64, f64), Refusal> {
        self.press_all(id, std::slice::from_ref(path))
    }
    /// Begins a drag of several things, which move as one; the handle is the first place of the first.
    ///
    /// # Errors
    /// Why they cannot be dragged: there is nothing at a path, it has no place of its own, or anchors hold all of it.
    pub fn press_all(&mut self, id: DocumentId, paths: &[Path]) -> Result<(f64, f64), Refusal> {
        self.press_by(id, |open| drag::begin(open, paths))
    }
    /// Begins a drag in some way.
    pub(crate) fn press_by(
        &mut self,
        id: DocumentId,
        begin: impl FnOnce(&mut Open) -> Result<(f64, f64), Refusal>,
    ) -> Result<(f64, f64), Refusal> {
        let open = self.document_mut(id);
        let handle = begin(open)?;
        open.rest_picture();
        if let Some(mut trace) = open.trace.take() {
            // what was watched may be gone from the document: then nothing is watched
            open.trace = trace.restart(open).is_ok().then_some(trace);
        }
        Ok(handle)
    }
    /// Follows the pointer to a place on the sheet. Without a press it does nothing.
    pub fn drag(&mut self, id: DocumentId, to: (f64, f64)) -> DragState {
        let open = self.document_mut(id);
        let state = open.state.clone();
        match &mut open.drag {
            Some(drag) => {
                let came = drag.to(&state, &mut open.planner, to);
                if let Some(trace) = &mut open.trace {
                    trace.follow(&drag.values);
                }
                came
            }
            None => DragState::default(),
        }
    }
    /// Returns which numbers follow a drag of something computed, each with what it is now: `rings.radius 48 mm`.
    pub fn dragged_along(&self, id: DocumentId) -> Vec<String> {
        let open = self.document(id);
        open.drag.as_ref().map_or_else(Vec::new, |drag| drag.following(&open.state))
    }
    /// Ends a drag: soft constraints act again, and the change is written, as one undo step.
    ///
    /// # Errors
    /// Why it could not be kept; then all is as it was before the press.
    pub fn release(&mut self, id: DocumentId) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let Some(drag) = open.drag.take() else { return Ok(Change::default()) };
        let released = drag.release(open, &beside);
        if released.is_err() {
            open.back_on_course();
        }
        let mut change = released?;
        if open.pane.is_some() && !change.edits.is_empty() {
            return Ok(self.carry_drag(id, change));
        }
        if !change.edits.is_empty() {
            change.documents = self.reach(id);
        }
        Ok(change)
    }
    /// Returns the command that joins things: of each it merges what sticks there, of a resistor's end the node.
    ///
    /// # Errors
    /// A path leads nowhere, two are one already, or they are unlike.
    pub fn join(&self, id: DocumentId, paths: &[Path]) -> Result<Command, Refusal> {
        joining::joined(&self.document(id).state, paths).map(Command::Merge)
    }
    pub(crate) fn held_path(&self, id: DocumentId) -> Option<Path> {
        self.document(id).drag.as_ref().map(|drag| drag.held_path().clone())
    }
    /// Returns what was pressed and the handle that a hand holds instead of it since it was dragged across what stays;
    /// nothing where that is the same.
    pub fn held_instead(&self, id: DocumentId) -> Option<(Path, Path)> {
        let drag = self.document(id).drag.as_ref()?;
        let (pressed, held) = (drag.path.clone(), drag.held_path().clone());
        (pressed != held).then_some((pressed, held))
    }
    /// Returns what the thing that is dragged would be joined with if it were dropped on a path.
    pub fn joint(&self, id: DocumentId, target: &Path) -> Option<Path> {
        let paths = [target.clone(), self.held_path(id)?];
        joining::joined(&self.document(id).state, &paths).ok()?.into_iter().next()
    }
    /// Takes a tool into the hand that places a thing of a class, place by place.
    ///
    /// # Errors
    /// There is no such class, or its things have no place.
    pub fn take_tool(&mut self, id: DocumentId, class: &str) -> Result<ToolView, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &self.documents[id.0 as usize];
        let tool = Tool::new(open, &beside, class)?;
        let view = tool.view();
        self.document_mut(id).tool = Some(tool);
        Ok(view)
    }
    /// Takes the same tool again, after what it made was applied: a line goes on from the end of the last one.
    pub fn take_tool_again(&mut self, id: DocumentId) -> Option<ToolView> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &self.documents[id.0 as usize];
        let tool = open.tool.as_ref()?.again(open, &beside);
        let view = tool.as_ref().map(Tool::view);
        self.document_mut(id).tool = tool;
        view
    }
    /// The tool follows the pointer. Nothing of the document changes.
    pub fn tool_moved(&mut self, id: DocumentId, pointer: &Pointer) -> Option<ToolView> {
        let (open, beside) = self.beside_others(id);
        let state = open.state.clone();
        open.tool.as_mut().map(|tool| tool.moved(&state, pointer, &beside))
    }
    /// The tool sets what it is about to set, where the pointer is; with the last one the view has the command.
    ///
    /// # Errors
    /// Why that cannot be; the tool stays where it was.
    pub fn tool_set(&mut self, id: DocumentId, pointer: &Pointer) -> Result<ToolView, Refusal> {
        let (open, beside) = self.beside_others(id);
        let state = open.state.clone();
        match open.tool.as_mut() {
            Some(tool) => tool.set(&state, pointer, &beside),
            None => Ok(ToolView::default()),
        }
    }
    /// Returns where a key brings the tool: the next place that it would join, or a middle; none past the last.
    pub fn tool_stop(&self, id: DocumentId, pointer: &Pointer, along: Along) -> Option<(f64, f64)> {
        let open = self.document(id);
        open.tool.as_ref()?.stop(&open.state, pointer, along)
    }
    /// Lays the tool down.
    pub fn drop_tool(&mut self, id: DocumentId) {
        self.document_mut(id).tool = None;
    }
    /// Returns true if a document can make things of a class.
    pub fn has_class(&self, id: DocumentId, class: &str) -> bool {
        let state = &self.document(id).state;
        let document = &state.lowered.document;
        let known = document.class_named(class);
        known.is_some_and(|c| recognise::is_candidate(state, c, &document.classes[c]))
    }
    /// Returns the steps that can be taken back, the latest first, and those that can be done again, the next first.
    pub fn history(&self, id: DocumentId) -> (Vec<String>, Vec<String>) {
        let open = self.document(self.home(id));
        let labels = |steps: &[crate::document::Step]| -> Vec<String> {
            steps.iter().rev().map(|step| step.label.clone()).collect()
        };
        (labels(&open.done), labels(&open.undone))
    }
    /// Calls the latest step of a document otherwise: what replaced its text was meant as something.
    pub fn label_last(&mut self, id: DocumentId, label: &str) {
        let home = self.home(id);
        self.document_mut(home).label_last(label.into());
    }
    /// Takes copies of some things of the document, with their values and what is said of them.
    ///
    /// # Errors
    /// A path is no thing of the document itself, or it is declared with others that are not copied.
    pub fn copied(
        &self,
        id: DocumentId,
        paths: &[Path],
        relations: Relations,
    ) -> Result<Clip, Refusal> {
        tools::copies::copied(&self.document(id).state, paths, relations)
    }
    /// Returns copies of what a text says, as a clipboard may hold it; nothing where that is no text of things.
    pub fn copies_in(&self, id: DocumentId, text: &str) -> Option<Clip> {
        tools::copies::read(text, &self.document(id).state.text, &*self.host)
    }
    /// Returns the command that puts copies into a document, so many steps aside from where they were taken, and
    /// what they are called.
    ///
    /// # Errors
    /// They speak of what is not there, a class or other things.
    pub fn pasting(
        &self,
        id: DocumentId,
        clip: &Clip,
        aside: u32,
    ) -> Result<(Command, Vec<String>), Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        tools::copies::pasting(self.document(id), &beside, clip, aside)
    }
    /// Returns the command that deletes several things with all that speaks of them, and what else goes, as it is
    /// written.
    ///
    /// # Errors
    /// One of them cannot be deleted.
    pub fn deletion(
        &self,
        id: DocumentId,
        paths: &[Path],
    ) -> Result<(Command, Vec<String>), Refusal> {
        let home = self.home(id);
        let beside = Beside::of(&*self.host, &self.documents, home);
        let at_home = |path: &Path| match self.at_home(id, &Command::Delete(path.clone()))? {
            Command::Delete(path) => Ok(path),
            _ => Ok(path.clone()),
        };
        let paths = paths.iter().map(at_home).collect::<Result<Vec<Path>, Refusal>>()?;
        tools::copies::deletion(self.document(home), &beside, &paths)
    }
    /// Returns what goes when something is deleted, besides itself, as it is written.
    pub fn along_with(&self, id: DocumentId, path: &Path) -> Vec<String> {
        let Ok(Command::Delete(path)) = self.at_home(id, &Command::Delete(path.clone())) else {
            return Vec::new();
        };
        apply::along(&self.document(self.home(id)).state, &path)
    }
    /// Returns what can be inserted: the classes in use, each with the picture of its prototype.
    pub fn bin(&self, id: DocumentId) -> Vec<BinEntry> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        tools::bin::entries(&self.document(id).state, &mut self.tiles.borrow_mut(), &beside)
    }
    /// Returns the command that inserts a thing of a class where there is room.
    ///
    /// # Errors
    /// There is no such class.
    pub fn insertion(&self, id: DocumentId, class: &str) -> Result<Command, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        tools::room::insertion(self.document(id), &beside, class)
    }
    /// Reads an expression as the document's own members would.
    ///
    /// # Errors
    /// It means nothing here.
    pub fn understand(&self, id: DocumentId, written: &str) -> Result<(), Refusal> {
        plotting::read(&self.document(id).state, &[written]).map(drop)
    }
    /// Returns the values of some expressions in words, as of the drag where one goes on, or why they have none.
    pub fn calculate(&mut self, id: DocumentId, written: &[String]) -> Vec<Result<String, String>> {
        calculator::values(self.document_mut(id), written)
    }
    /// Gives a drag up: all is as it was before the press.
    pub fn cancel(&mut self, id: DocumentId) {
        let open = self.document_mut(id);
        if open.drag.take().is_some() {
            open.back_on_course();
        }
    }
    /// Finds the nearest grip within a distance on the sheet.
    pub fn pick(&self, id: DocumentId, at: (f64, f64), radius: f64) -> Option<Path> {
        let picture = self.picture(id);
        let distance = |x: f64, y: f64| base::number::hypot(x - at.0, y - at.1);
        let near = picture.grips.iter().map(|g| (distance(g.x, g.y), g));
        let nearest = near.filter(|(d, _)| *d <= radius).min_by(|a, b| a.0.total_cmp(&b.0))?;
        parse_path(&nearest.1.path)
    }
    /// Returns the picture, live while dragging.
    pub fn picture(&self, id: DocumentId) -> PictureView {
        let open = self.document(id);
        open.with_picture(|shown| shown.view(&open.status))
    }
    /// Brings a picture of the document up to date, or makes it anew where more than values are others, and says what
    /// moves. Cost: that of drawing what moved.
    pub fn follow_picture(&self, id: DocumentId, view: &mut PictureView) -> MovedView {
        let open = self.document(id);
        open.with_picture(|shown| shown.follow(view, &open.status))
    }
    /// Returns the picture as an SVG text.
    pub fn svg(&self, id: DocumentId) -> String {
        views::picture::svg(&self.picture(id))
    }
    /// Returns the picture as a DXF text, in millimetres.
    pub fn dxf(&self, id: DocumentId) -> String {
        self.dxf_of(id, &self.picture(id))
    }
    /// The same of a picture of it, to which something may have been added.
    pub fn dxf_of(&self, id: DocumentId, picture: &PictureView) -> String {
        views::picture::dxf(&self.document(id).state, picture)
    }
    /// Says why some things have no picture, which is drawn without them; nothing is praise.
    pub fn undrawn(&self, id: DocumentId) -> Vec<String> {
        let open = self.document(id);
        views::picture::undrawn(&open.state, open.values())
    }
    /// Returns the texts that a document's meaning follows from, its own first.
    pub fn sources(&self, id: DocumentId) -> Vec<String> {
        let files = self.document(id).state.lowered.files.iter();
        files.map(|(_, file)| file.text.to_string()).collect()
    }
    /// Returns the families that a document knows.
    pub fn families(&self, id: DocumentId) -> Vec<FamilyView> {
        crate::families::list(&self.document(id).state)
    }
    /// Returns the paths of the tables that a document uses, from its own folder: those of its families and of the
    /// parameters of all programs in scope, with those that are missing.
    pub fn tables(&self, id: DocumentId) -> BTreeSet<String> {
        crate::families::tables(&self.document(id).state)
    }
    /// Reads the rows of a family, or of a program with a table.
    ///
    /// # Errors
    /// No such program, a table that cannot be read, a column that is missing.
    pub fn family_rows(
        &self,
        id: DocumentId,
        name: &str,
        table: Option<&str>,
    ) -> Result<TableView, Refusal> {
        crate::families::rows(&self.document(id).state, name, table)
    }
    /// Compares the rows of a family, or of a program, with those of a second table: by their names where both have one,
    /// else by the first column that both have.
    ///
    /// # Errors
    /// No such program, a table that cannot be read, no row that both have.
    pub fn family_differences(
        &self,
        id: DocumentId,
        name: &str,
        rows: &TableView,
        other: &str,
    ) -> Result<Vec<String>, Refusal> {
        crate::families::differences(&self.document(id).state, name, rows, other)
    }
    /// Draws a row of a family, or of a program.
    ///
    /// # Errors
    /// No such program.
    pub fn draw_row(
        &self,
        id: DocumentId,
        name: &str,
        row: &FamilyRow,
        formats: RowFormats,
    ) -> Result<RowOutcome, Refusal> {
        crate::families::draw(&self.document(id).state, name, row, formats)
    }
    /// Says why runs of a program, or of a family's, are not drawn again as they were drawn before, as far as is known.
    pub fn why_interpreted(&self, id: DocumentId, name: &str) -> Option<String> {
        crate::families::why_interpreted(&self.document(id).state, name)
    }
    /// Says of which things there is nothing in the picture, as their classes have none; nothing if all are there.
    pub fn unpictured(&self, id: DocumentId) -> Option<String> {
        let paths = views::picture::unpictured(&self.document(id).state, &self.picture(id));
        let have = if paths.len() == 1 { "has" } else { "have" };
        let listed = words::listed(&paths);
        (!paths.is_empty()).then(|| format!("{listed} {have} no picture"))
    }
    /// Returns the structure: the picture's accessible twin.
    pub fn structure(&self, id: DocumentId) -> Vec<StructureRow> {
        let open = self.document(id);
        views::structure::rows(&open.state, open.values(), &open.status)
    }
    /// Returns the rows of what a thing computes at a path, live while dragging: such things are not in the structure.
    pub fn computed_rows(&self, id: DocumentId, path: &Path) -> Vec<StructureRow> {
        let open = self.document(id);
        views::structure::drawn::computed(&open.state, open.values(), &open.status, path)
    }
    /// Returns the values, live while dragging.
    pub fn values(&self, id: DocumentId) -> Vec<ValueRow> {
        let open = self.document(id);
        views::values::rows(&open.state, open.values(), &open.status)
    }
    /// Begins both views, the structure and the values, which are then made while there is time.
    pub fn begin_listing(&self, id: DocumentId) -> Listing {
        Listing::of(self.document(id))
    }
    /// Returns what was found while solving, at the lines that it comes from: what contradicts what, what has no
    /// value, what nothing holds. Beside what is wrong with the text.
    pub fn problems(&mut self, id: DocumentId) -> Vec<DiagnosticView> {
        views::problems::view(self.document_mut(id))
    }
    /// Returns the paths of the numbers that nothing decides: neither given, nor determined by what is.
    pub fn arbitrary(&mut self, id: DocumentId) -> BTreeSet<String> {
        let open = self.document_mut(id);
        let state = open.state.clone();
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let found = open.planner.arbitrary(state.model(), &state.values, &mut texts);
        found.into_iter().map(|slot| state.slot_path(slot).to_string()).collect()
    }
    /// Brings rows of the values view up to date while dragging. Cost: that of these rows alone.
    pub fn renew_values<'r>(
        &self,
        id: DocumentId,
        rows: impl IntoIterator<Item = &'r mut ValueRow>,
    ) {
        let open = self.document(id);
        views::values::renew(&open.state, open.values(), rows.into_iter());
    }
    /// Returns the value of a thing as its row of the structure view shows it; nothing where it has none.
    pub fn shown_value(&self, id: DocumentId, path: &Path) -> Option<String> {
        let open = self.document(id);
        words::show_thing(&open.state, thing_at(&open.state, path)?, open.values())
    }
    /// Returns the source and what is wrong with it.
    pub fn text(&self, id: DocumentId) -> TextView {
        let open = self.document(self.home(id));
        let mut view = views::text::view(&open.state);
        if let Some(own) = drafting::span_recorded(open) {
            // what is demonstrated is not finished, and nothing is wrong with that
            let is_open = |d: &&mut DiagnosticView| {
                let is_own = d.file.is_empty() && own.start <= d.start && d.end <= own.end;
                d.code == "open-block" && is_own
            };
            view.diagnostics
                .iter_mut()
                .filter(is_open)
                .for_each(|d| d.severity = "recording".into());
        }
        view
    }
    /// Returns what the document says of itself in the `///` lines with which it begins.
    pub fn preamble(&self, id: DocumentId) -> String {
        views::text::preamble(&self.document(id).state)
    }
    /// Returns the colours of the source.
    pub fn tokens(&self, id: DocumentId) -> Vec<TokenView> {
        views::text::tokens(&self.document(id).state)
    }
    /// Returns what the status line says, once it is counted how much is free and what is superfluous.
    pub fn status(&mut self, id: DocumentId) -> Status {
        let found = self.document_mut(id).count();
        let state = &self.document(id).state;
        let redundant = found.into_iter().filter_map(|s| words::source_name(state, s)).collect();
        Status { redundant, ..self.standing(id) }
    }
    /// Takes over how much more is free than the form says, as a document of the same text counted it. Where a member
    /// that has an error is in force as it was, that text is of another form, and says nothing of this one.
    pub fn note_more(&mut self, id: DocumentId, form: u32, more: u32) {
        let status = &mut self.document_mut(id).status;
        if status.freedom == form as usize {
            status.more = Some(more as usize);
        }
    }
    /// Returns what the status line says at once: what may take long is not counted.
    pub fn standing(&self, id: DocumentId) -> Status {
        let (undo, redo) = self.history(id);
        let [undo, redo] = [undo, redo].map(|steps| steps.into_iter().next());
        Status { undo, redo, ..views::status::view(self.document(id)) }
    }
    /// Explains the latest plan, or why one value is what it is.
    pub fn explain(&self, id: DocumentId, about: Option<&Path>) -> Explanation {
        views::explain::view(self.document(id), about)
    }
    /// Says why a thing does not move; nothing where it can.
    pub fn held(&mut self, id: DocumentId, about: &Path) -> Option<HeldView> {
        views::held::view(self.document_mut(id), about)
    }
    /// Returns where else a thing could be, at most eight states: where a constraint holds by another of its
    /// alternatives, or equations have another root. Nothing where no rule decides where it is.
    ///
    /// # Errors
    /// That the path leads nowhere.
    pub fn ghosts(&mut self, id: DocumentId, about: &Path) -> Result<Vec<Ghost>, Refusal> {
        ghosts::view(self.document_mut(id), about)
    }
    /// Says what is free, what is superfluous and what cannot hold together, with what would help.
    /// Where something does not hold this may take a few hundred solves.
    pub fn analysis(&mut self, id: DocumentId) -> Analysis {
        let mut analysis = views::analysis::view(self.document_mut(id));
        let beside = Beside::of(&*self.host, &self.documents, id);
        crate::ways_out::keep_helping(self.document(id), &beside, &mut analysis.contradictions);
        let status = &mut self.document_mut(id).status;
        status.more = (analysis.freedom as usize).checked_sub(status.freedom);
        Analysis { advice: self.advice(id), ..analysis }
    }
    /// Returns second views by which the opening of a document would go on one step after the other, where it
    /// does not. Each was tried in a copy of the document.
    pub fn advice(&self, id: DocumentId) -> Vec<Advice> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        advice::advice(self.document(id), &beside)
    }
    /// Returns the words that may stand at an offset of a text that is being written in a document.
    pub fn completions(&self, id: DocumentId, text: &str, offset: u32) -> Vec<CompletionView> {
        let libraries = self.host.libraries();
        crate::completing::completions(
            &self.document(self.home(id)).state,
            text,
            offset,
            &libraries,
        )
    }
    /// Returns what the document calls itself: the first words of its first `///`, else its name.
    pub fn title(&self, id: DocumentId) -> String {
        words::title(self.document(self.home(id)))
    }
    /// Returns what the independent checker finds wrong, in words; nothing is praise.
    ///
    /// It tests the state from the rules alone and, where the latest step was an edit of values, that
    /// it changed nothing it should not have. It shares no code with what computed the values.
    pub fn complaints(&self, id: DocumentId) -> Vec<String> {
        complaints::of(self.document(id))
    }
    /// Runs the `check` blocks, each on a fresh copy of the document as it is.
    pub fn run_checks(&self, id: DocumentId) -> Vec<CheckReport> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        check::run_all(&self.document(id).state, &beside)
    }
}

impl Open {
    /// Returns the values: those of the drag, while there is one.
    pub(crate) fn values(&self) -> &kernel::Values {
        self.drag.as_ref().map_or(&self.state.values, |d| &d.values)
    }
}

/// Reads a path as the language writes it: `q.side1.p1`, `links[0].x`, `links.last`.
pub fn parse_path(text: &str) -> Option<Path> {
    let mut steps = Vec::new();
    for word in text.split('.') {
        let (name, mut rest) = word.find('[').map_or((word, ""), |i| word.split_at(i));
        let plain = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        if !plain {
            return None;
        }
        steps.push(match name {
            "last" if !steps.is_empty() => Step::Last,
            "owner" => Step::Owner,
            _ => Step::Part(name.into()),
        });
        while !rest.is_empty() {
            let (index, after) = rest.strip_prefix('[')?.split_once(']')?;
            steps.push(Step::Index(index.parse().ok()?));
            rest = after;
        }
    }
    Some(Path(steps))
}

/// Lays a text out as the language wants it, keeping comments.
pub fn format(text: &str) -> String {
    syntax::format(&syntax::parse(base::FileId(0), text))
}

/// Says why a text cannot be laid out: where its spelling is wrong first, as line, column and message.
pub fn misspelled(text: &str) -> Option<(u32, u32, String)> {
    let parse = syntax::parse(base::FileId(0), text);
    let d = parse.diagnostics().first()?;
    let (line, column) = base::LineIndex::new(text).line_column(text, d.place.span.start);
    Some((line, column, d.message.clone()))
}

/// Finds the thing at a path, for whoever has one.
pub(crate) fn thing_at(state: &State, path: &Path) -> Option<ThingId> {
    state.structure.follow(kernel::DOCUMENT, path).ok()
}
