//! A desk: one open document and the hands that work on it.

use session::drafting::view::NewParameter;
use session::view::{Change, DragState, Refusal, ValueRow};
use session::{Command, DocumentId, Host, Literal, Path, Session, parse_path};
use std::fs;
use std::path::PathBuf;

/// A host with the libraries of the project.
pub(crate) struct Library;

fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

impl Host for Library {
    fn read(&self, name: &str) -> Option<String> {
        fs::read_to_string(project().join("library").join(name).with_extension("thing")).ok()
    }
    fn libraries(&self) -> Vec<String> {
        vec!["calculator".into(), "geometry".into()]
    }
}

/// A text, and of each value its path, how it is shown and its bits.
pub(crate) type Moment = (String, Vec<(String, String, Option<u64>)>);

/// One open document.
pub(crate) struct Desk {
    pub(crate) session: Session,
    pub(crate) id: DocumentId,
}

/// The text of a gallery document.
pub(crate) fn gallery(name: &str) -> String {
    let path = project().join("gallery").join(name).with_extension("thing");
    fs::read_to_string(path).expect("the gallery has the document")
}

/// Reads a path that is plainly one.
pub(crate) fn at(path: &str) -> Path {
    parse_path(path).expect("the path is well formed")
}

impl Desk {
    pub(crate) fn of(text: &str) -> Self {
        let mut session = Session::new(Box::new(Library));
        let id = session.open("desk", text);
        Self { session, id }
    }
    /// A sheet in millimetres on which a program is recorded, with its parameters, each by a name and an example.
    pub(crate) fn recording(program: &str, parameters: &[(&str, &str)]) -> Self {
        let mut desk = Self::of("use contours\nunit mm\n");
        desk.session.record(desk.id, program).expect("a new program");
        for (name, example) in parameters {
            let new = NewParameter {
                name: (*name).into(),
                example: (*example).into(),
                ..NewParameter::default()
            };
            desk.session.define_parameter(desk.id, &new).expect("it is new");
        }
        desk
    }
    pub(crate) fn text(&self) -> String {
        self.session.text(self.id).source
    }
    pub(crate) fn apply(&mut self, command: &Command) -> Result<Change, Refusal> {
        self.session.apply(self.id, command)
    }
    pub(crate) fn set(&mut self, path: &str, x: f64) -> Result<Change, Refusal> {
        self.apply(&Command::Set(vec![(at(path), Literal::Number(x))]))
    }
    pub(crate) fn type_in(&mut self, path: &str, typed: &str) -> Result<Change, Refusal> {
        self.session.set_typed(self.id, path, typed)
    }
    pub(crate) fn move_to(&mut self, path: &str, x: f64, y: f64) -> Result<Change, Refusal> {
        let place = Literal::Tuple(vec![Literal::Number(x), Literal::Number(y)]);
        self.apply(&Command::Move(vec![(at(path), place)]))
    }
    /// Presses, and drags along some places, without letting go.
    pub(crate) fn hold(&mut self, path: &str, along: &[(f64, f64)]) -> DragState {
        self.session.press(self.id, &at(path)).expect("the place can be dragged");
        let mut state = DragState::default();
        for &to in along {
            state = self.session.drag(self.id, to);
        }
        state
    }
    /// Drops what is held on something: one step.
    pub(crate) fn drop_on(&mut self, target: &str) -> Result<Change, Refusal> {
        let (command, since) = self.session.release_to_join(self.id, &at(target))?;
        let joined = self.apply(&command);
        if let Some(since) = since {
            self.session.joined(self.id, since, joined.is_ok());
        }
        joined
    }
    /// Drags from press to release.
    pub(crate) fn drag(&mut self, path: &str, along: &[(f64, f64)]) -> Change {
        self.hold(path, along);
        self.session.release(self.id).expect("the drag can be kept")
    }
    pub(crate) fn undo(&mut self) {
        self.apply(&Command::Undo).expect("there is a step to undo");
    }
    pub(crate) fn redo(&mut self) {
        self.apply(&Command::Redo).expect("there is a step to redo");
    }
    pub(crate) fn type_text(&mut self, text: &str) {
        self.apply(&Command::Text(text.into())).expect("any text is taken");
    }
    pub(crate) fn row(&self, path: &str) -> ValueRow {
        let rows = self.session.values(self.id);
        rows.into_iter().find(|r| r.path == path).expect("the values view has the path")
    }
    pub(crate) fn number(&self, path: &str) -> f64 {
        self.row(path).number.expect("the value is a number")
    }
    /// Where a place lies, stored or computed.
    pub(crate) fn place(&mut self, path: &str) -> (f64, f64) {
        let from = self.session.press(self.id, &at(path)).expect("it can be dragged");
        self.session.cancel(self.id);
        from
    }
    /// Every stored value, bit for bit.
    pub(crate) fn bits(&self) -> Vec<(String, String, Option<u64>)> {
        let rows = self.session.values(self.id).into_iter().filter(|r| !r.is_virtual);
        rows.map(|r| (r.path, r.text, r.number.map(f64::to_bits))).collect()
    }
    /// The text and every value, bit for bit.
    pub(crate) fn moment(&self) -> Moment {
        (self.text(), self.bits())
    }
    pub(crate) fn undo_label(&self) -> Option<String> {
        self.session.standing(self.id).undo
    }
    /// The codes and lines of what is wrong with the text.
    pub(crate) fn wrong(&self) -> Vec<(String, u32)> {
        let diagnostics = self.session.text(self.id).diagnostics.into_iter();
        diagnostics.map(|d| (d.code, d.line)).collect()
    }
}

/// Applies a change's edits to the text that they are relative to.
pub(crate) fn edited(text: &str, change: &Change) -> String {
    let mut out = String::new();
    let mut from = 0;
    for edit in &change.edits {
        out.push_str(&text[from..edit.start as usize]);
        out.push_str(&edit.insert);
        from = edit.end as usize;
    }
    out + &text[from..]
}
