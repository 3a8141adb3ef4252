//! Views: what there is to see of a document, as plain data.
//!
//! Paths are written as in the language (`q.outer.side1.p1`). Offsets are bytes in the text.
//! A `number` counts in base units: angles in radians, lengths in the document's units. A number's
//! `text` is what a person reads and may type back: six digits in its `unit`, angles in degrees.

mod families;
mod reasons;
mod tools;

pub use families::{
    FamilyAxis, FamilyGrid, FamilyMap, GridColumn, MapAxis, MapPlace, MapReason, RowUse,
};
pub use reasons::{
    Advice, Analysis, ContradictionView, ExplainedStep, Explanation, HeldView, MotionView,
    RedundantView, Velocity,
};
use serde::{Deserialize, Serialize};
pub use tools::{
    Along, Annotation, Caught, ClassItem, ClassPlan, Deed, ItemKind, Offer, Pointer, Scope, Shows,
    ToolView, TypedLength, ValueWithin,
};

/// Which open document.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
pub struct DocumentId(pub u32);

/// What an applied command did.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Change {
    /// What the undo list calls it: "move q.outer.side1.p1".
    pub label: String,
    /// The edits of the text, each relative to the text before any of them, in order.
    pub edits: Vec<TextChange>,
    /// The paths of the things whose values changed, in order of declaration.
    pub moved: Vec<String>,
    /// Whether classes, parts, constraints or merges changed, and not values alone.
    pub structure: bool,
    /// The path of the thing that became a class of one.
    pub class_of_one: Option<String>,
    /// The class that changed, and with it all its things.
    pub class: Option<String>,
    /// The members that went along or were shortened, as they were written.
    pub along: Vec<String>,
    /// The constraints that cannot hold, and could before: their paths, and the rules of those without a name.
    pub unsatisfied: Vec<String>,
    /// The other open documents that use this one, and so have changed as well.
    pub documents: Vec<Affected>,
    /// What acts otherwise than before: inequalities, conditions, alternatives.
    pub modes: Vec<ModeView>,
    /// The unit of lengths without one, where the sheet took it over from what was typed: `mm`.
    pub unit: Option<String>,
}

/// A constraint that acts otherwise than before an edit, or than at the press of a drag.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct ModeView {
    /// Its path and name; empty of given values that moved for others.
    pub constraint: String,
    /// One sentence: "wall is at its bound: p.x <= 100".
    pub message: String,
    /// Where it is written, if in the document's own text.
    pub span: Option<(u32, u32)>,
}

/// Where an edit or a drag has to stop.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Limit {
    /// What was set or dragged.
    pub path: String,
    /// The last value on the way, rounded towards its beginning, as a person may type it:
    /// `130.5 deg`, `(70, 0)`.
    pub value: String,
}

/// A document that changed because one that it uses did.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Affected {
    /// Which it is.
    pub document: DocumentId,
    /// Its constraints that cannot hold, and could before.
    pub unsatisfied: Vec<String>,
}

/// What has to be asked before a command is applied.
#[derive(Clone, PartialEq, Debug)]
pub struct Question {
    /// What the command would do.
    pub message: String,
    /// What can be done; none of it is done yet.
    pub choices: Vec<Choice>,
}

/// One way to apply a command.
#[derive(Clone, PartialEq, Debug)]
pub struct Choice {
    /// What a button says: "only beam", "every Strut".
    pub label: String,
    /// What is to be applied.
    pub command: kernel::Command,
}

/// A class that some parts could be the parts of.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Recognised {
    /// The class.
    pub class: String,
    /// What `///` says of it.
    pub doc: String,
    /// How many constraints and merges it has, all of them true.
    pub constraints: u32,
    /// For every part of the class, which of the selected parts it would be.
    pub parts: Vec<(String, String)>,
    /// The members of the document that would make a thing of the class whose parts they are.
    pub members: String,
}

/// A replaced stretch of the text.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct TextChange {
    /// The first byte replaced.
    pub start: u32,
    /// The byte after the last replaced.
    pub end: u32,
    /// What stands there instead.
    pub insert: String,
}

impl From<&TextChange> for syntax::TextEdit {
    fn from(change: &TextChange) -> Self {
        let span = base::Span::new(change.start, change.end);
        Self { span, insert: change.insert.clone() }
    }
}

/// Why a command changed nothing.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Refusal {
    /// One sentence for the status line.
    pub message: String,
    /// The constraints that stand in the way, by path and name.
    pub constraints: Vec<String>,
    /// What is wrong with the text, where the text is what is wrong.
    pub diagnostics: Vec<DiagnosticView>,
    /// What would work.
    pub repairs: Vec<String>,
    /// How far one could have gone, where values were to change.
    pub limit: Option<Box<Limit>>,
}

impl Refusal {
    /// Returns it in one line: its sentence, then what is wrong with the text and was not said yet.
    pub fn in_a_line(&self) -> String {
        // what the refusal says already is not said again
        let is_said = |said: &String| self.message.contains(said.as_str());
        let new = self
            .diagnostics
            .iter()
            .filter(|d| !is_said(&d.message) || d.hint.as_ref().is_some_and(|hint| !is_said(hint)));
        let wrong = new.map(|d| match &d.hint {
            Some(hint) => format!("{}; {hint}", d.message),
            None => d.message.clone(),
        });
        let parts = [self.message.clone()].into_iter().chain(wrong).filter(|part| !part.is_empty());
        parts.collect::<Vec<_>>().join(". ")
    }
}

/// A diagnostic as an editor shows it.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
pub struct DiagnosticView {
    /// `error`, `warning`, `note`; `recording` of what is not finished yet.
    pub severity: String,
    /// The kebab-case code.
    pub code: String,
    /// What was found and what was wanted.
    pub message: String,
    /// What to do.
    pub hint: Option<String>,
    /// The file; empty for the document itself.
    pub file: String,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
    /// Further places that it speaks of.
    pub labels: Vec<LabelView>,
    /// Edits of the document's text that would mend it, one of which can be chosen.
    pub fixes: Vec<FixView>,
}

/// A further place that a diagnostic speaks of.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct LabelView {
    /// The file; empty for the document itself.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
    /// What is there.
    pub message: String,
}

/// An edit of the text that would mend what a diagnostic speaks of.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct FixView {
    /// What it does, as a button says it.
    pub title: String,
    /// The stretches to replace, each relative to the text as it is.
    pub edits: Vec<TextChange>,
}

/// The state of a thing, as colour and word.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Freedom {
    /// It can still move.
    Free,
    /// Constraints, anchors or given numbers determine it.
    Fixed,
    /// A constraint on it does not hold.
    Conflicting,
    /// A constraint on it says nothing new.
    Redundant,
}

/// The picture: a drawing, and what its tags mean.
#[derive(Clone, Debug, Default)]
pub struct PictureView {
    /// What to paint.
    pub drawing: drawing::Drawing,
    /// For every tag, the path of the thing that it pictures; of what a program drew, that of the entity; of a figure
    /// that a class declares, that of it; of what the document computes, its name.
    pub paths: Vec<String>,
    /// For every tag, the path of the thing whose program drew it, or whose class declares it, where one did.
    pub drawn_by: Vec<Option<String>>,
    /// For every tag, its thing's freedom.
    pub freedom: Vec<Option<Freedom>>,
    /// What a pointer can grip, in the order of picking: points first.
    pub grips: Vec<Grip>,
    /// What the sheet counts in; nothing where its lengths have no unit.
    pub unit: Option<SheetUnit>,
    /// How many millimetres a unit of the drawing is; nothing where its lengths are units of the sheet alone.
    pub millimetres: Option<f64>,
    /// How often it was made since the document was opened.
    pub made: u32,
    /// How often it was brought up to date since then.
    pub times: u32,
}

/// What a sheet counts in.
#[derive(Clone, PartialEq, Debug)]
pub struct SheetUnit {
    /// How it is spelled: `mm`.
    pub name: String,
    /// How wide a piece of the sheet is looked at while nothing is drawn, in this unit.
    pub across: f64,
}

/// What of a picture moves with a drag: all that has moved since the press, and what is counted with that.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum MovedView {
    /// Other elements are drawn than before: it was made anew.
    Everything,
    /// These, by their places in the drawing and among the grips, in order.
    These {
        /// Elements.
        elements: Vec<u32>,
        /// Grips.
        grips: Vec<u32>,
    },
}

/// Another state that the rules allow.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Ghost {
    /// What is otherwise in it, and where that leads: "c on the other side of a and b: c = (5, -4)".
    pub label: String,
    /// What is elsewhere in it.
    pub moves: Vec<GhostMove>,
    /// The elements of the picture that look otherwise in it.
    #[serde(skip)]
    pub picture: drawing::Drawing,
    /// What picks it: one step, that sets what is elsewhere.
    #[serde(skip)]
    pub command: kernel::Command,
}

/// What a command would come to.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Foreseen {
    /// The elements of the picture that would look otherwise, as they would look.
    pub picture: drawing::Drawing,
    /// The paths of what would move.
    pub moved: Vec<String>,
}

/// A number or a place of a ghost.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct GhostMove {
    /// Its path.
    pub path: String,
    /// Its value in the ghost, as a person may type it.
    pub value: String,
}

/// Something that a pointer can grip and drag.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Grip {
    /// The thing's path.
    pub path: String,
    /// Where it is, on the sheet.
    pub x: f64,
    /// Where it is, on the sheet.
    pub y: f64,
    /// Whether an anchor holds it.
    pub anchored: bool,
    /// Whether a program draws it, or a class computes it: then it shows only under the pointer.
    pub drawn: bool,
    /// Its thing's freedom.
    pub freedom: Option<Freedom>,
}

/// A class that things can be made of.
#[derive(Clone, PartialEq, Debug)]
pub struct BinEntry {
    /// Its name.
    pub class: String,
    /// What `///` says of it.
    pub doc: String,
    /// The library or file that it comes from; empty for the document's own.
    pub library: String,
    /// The toolbox that it lies in, where there is one.
    pub toolbox: Option<String>,
    /// What a new one looks like.
    pub picture: drawing::Drawing,
}

/// One row of the structure view, in pre-order: the accessible twin of the picture.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct StructureRow {
    /// The path; empty for the document.
    pub path: String,
    /// How deep it lies, 0 for the document.
    pub depth: u32,
    /// What kind of row it is.
    pub kind: RowKind,
    /// Its name.
    pub name: String,
    /// Its class, its rule or its paths, in the language.
    pub detail: String,
    /// What `///` says of it.
    pub doc: String,
    /// The value as text, for things that have one (a number, a text, a place).
    pub value: Option<String>,
    /// The same with all its digits: what an editor begins with.
    pub exact: Option<String>,
    /// The path of the first thing that it is merged with, where it is not the first itself.
    pub merged_with: Option<String>,
    /// Of a merge, the paths that it makes one.
    pub makes_one: Vec<String>,
    /// Its state.
    pub freedom: Option<Freedom>,
    /// Whether it is anchored.
    pub anchored: bool,
    /// False for a constraint that is switched off.
    pub enabled: bool,
    /// How many rows below belong to it.
    pub descendants: u32,
    /// Where it is written, if it is in the document's own text.
    pub span: Option<(u32, u32)>,
}

/// What a row of the structure view stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RowKind {
    /// The document or a part.
    Part,
    /// What a program drew, or the document computes.
    Virtual,
    /// A constraint.
    Constraint,
    /// A merge.
    Merge,
    /// Which way something goes from where two branches meet.
    Side,
}

impl RowKind {
    /// Returns true for what is stored or drawn, and for its parts.
    pub fn is_thing(self) -> bool {
        matches!(self, Self::Part | Self::Virtual)
    }
    /// Returns true if the row's path leads to what it stands for; else it leads to the thing that says it.
    pub fn has_own_path(self) -> bool {
        match self {
            Self::Part | Self::Virtual | Self::Constraint => true,
            Self::Merge | Self::Side => false,
        }
    }
}

/// One row of the values view.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ValueRow {
    /// The path; of merged parts that of the first.
    pub path: String,
    /// The shortest of its paths: `r1.current`, though `r1.a.current` is declared first.
    pub shortest: String,
    /// The class: `Length`, `Voltage`, `Text`, ….
    pub class: String,
    /// The value in its unit, to six digits, as a person reads it and may type it back.
    pub text: String,
    /// The unit, or nothing.
    pub unit: String,
    /// The value in the same unit with all its digits: what an editor begins with.
    pub exact: String,
    /// The value in base units, for numbers.
    pub number: Option<f64>,
    /// What there is to choose, for choices and truth values.
    pub options: Vec<String>,
    /// Whether the text gives it (others are what the constraints make them).
    pub given: bool,
    /// Whether it is a virtual part.
    pub is_virtual: bool,
    /// Whether an anchor holds it.
    pub anchored: bool,
    /// Whether it is listed only where that is asked for: a part of layout, what is computed for a picture, a constant
    /// of a library.
    pub is_layout: bool,
    /// Its state.
    pub freedom: Option<Freedom>,
    /// What `///` says of it, or what a program asks for it in words.
    pub doc: String,
    /// The least and the largest value that a program allows for it, in the units of `number`; nothing for an end that
    /// is open.
    pub range: Option<(Option<f64>, Option<f64>)>,
}

/// The source and what is known of it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct TextView {
    /// The text.
    pub source: String,
    /// What is wrong with it.
    pub diagnostics: Vec<DiagnosticView>,
}

/// A coloured stretch of the source.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct TokenView {
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
    /// `keyword`, `class`, `name`, `number`, `text`, `comment`, `doc`, `operator` or `error`.
    pub kind: String,
}

/// A word that may stand where someone writes.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct CompletionView {
    /// The word.
    pub label: String,
    /// `property`, `method`, `class`, `function`, `unit`, `keyword`, `module` for a library, or `enum` for an option of
    /// a choice.
    pub kind: String,
    /// A part's class, how a function is called, what a unit measures, which choice has an option.
    pub detail: String,
}

/// What a word of the text names.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct WordView {
    /// The first byte of the word.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
    /// How it was declared, in a line: `p1: Point`, `class Line`, `atan2(y, x)`.
    pub says: String,
    /// What is said of it in a sentence or more; empty for nothing.
    pub doc: String,
    /// Its value now, where it is a thing of the document that has one.
    pub value: Option<String>,
    /// What a command calls it, from the document or a class of it; empty for what has no name to change.
    pub path: String,
    /// Where it is declared, where that is written somewhere.
    pub declared: Option<DeclaredView>,
    /// Where else the document's own text names it, as first byte and byte after the last; the word itself too.
    pub uses: Vec<(u32, u32)>,
}

/// Where something is declared.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct DeclaredView {
    /// The file as `use` names it; empty for the document.
    pub file: String,
    /// The file's text, where it is another than the document's own.
    pub text: String,
    /// The first byte of the name there.
    pub start: u32,
    /// The byte after its last.
    pub end: u32,
}

/// What the status line says.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Status {
    /// Whether every required constraint holds.
    pub satisfied: bool,
    /// The degrees of freedom: in how many ways the things can still move.
    pub freedom: u32,
    /// Whether these are counted; until then there may be more.
    pub counted: bool,
    /// The constraints that do not hold, by path and name, with their errors.
    pub unmet: Vec<Unmet>,
    /// Constraints that say nothing new, once they are looked for.
    pub redundant: Vec<String>,
    /// What else is worth knowing of the solution: a double root, given numbers that gave way.
    pub notes: Vec<String>,
    /// One sentence: "all constraints hold; 8 degrees of freedom".
    pub message: String,
    /// Whether there is something to take back, and what.
    pub undo: Option<String>,
    /// Whether there is something to do again, and what.
    pub redo: Option<String>,
}

/// A constraint that does not hold.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Unmet {
    /// Its path and name.
    pub constraint: String,
    /// Its rule, in the language.
    pub rule: String,
    /// The difference of its sides, where it has one.
    pub error: Option<f64>,
    /// Its strength.
    pub strength: String,
    /// Where it is written, if in the document's own text.
    pub span: Option<(u32, u32)>,
}

/// Where a drag has got to.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct DragState {
    /// Whether the grip is where the pointer is.
    pub reached: bool,
    /// Why not, in one sentence.
    pub message: Option<String>,
    /// Where it stopped, if it did; nothing where it was left on a long way, which the next wish goes on.
    pub limit: Option<Limit>,
    /// How far from the pointer a place has stopped, in units of the sheet.
    pub short: Option<f64>,
    /// What acts otherwise than at the press.
    pub modes: Vec<ModeView>,
}

/// A view that a thing's class defines: a plot of some of its numbers.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct PlotEntry {
    /// What it is called.
    pub title: String,
    /// What `///` says of it.
    pub doc: String,
    /// What makes the plot.
    #[serde(skip)]
    pub request: crate::plotting::Request,
}

/// A lesson that a document has.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct LessonEntry {
    /// What it is called.
    pub title: String,
    /// What `///` says of it.
    pub doc: String,
    /// How many steps it has.
    pub steps: u32,
}

/// Where someone is in a lesson.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct LessonView {
    /// What it is called.
    pub title: String,
    /// How many steps it has.
    pub steps: u32,
    /// Which step this is, from 0; as many as there are at its end.
    pub at: u32,
    /// What the step says.
    pub say: Vec<String>,
    /// What is to be done, each in words; nothing where there is only something to read.
    pub task: Vec<String>,
    /// What of it is missing, each in words.
    pub missing: Vec<String>,
    /// What helps.
    pub hints: Vec<String>,
    /// The paths of what is to be moved.
    pub points_at: Vec<String>,
    /// Whether the lesson can show how it is done.
    pub can_show: bool,
    /// What is to be traced, on a sheet that was empty.
    #[serde(skip)]
    pub traced: drawing::Drawing,
    /// The class of what is drawn first, while nothing is drawn yet.
    pub tool: Option<String>,
}

/// How a `check` block, or a lesson, came out.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct CheckReport {
    /// Its title.
    pub title: String,
    /// The line it stands on, from 1.
    pub line: u32,
    /// Whether everything expected was found.
    pub passed: bool,
    /// What fell short.
    pub shortfalls: Vec<Shortfall>,
}

/// A statement of a check that fell short.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Shortfall {
    /// The line, from 1.
    pub line: u32,
    /// The statement, as written.
    pub statement: String,
    /// What was found and what was wanted, with the values.
    pub message: String,
}

/// A family: a program, and a table of its parameters.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct FamilyView {
    /// Its name.
    pub name: String,
    /// The program.
    pub program: String,
    /// The file with the table, where the text names one.
    pub table: Option<String>,
    /// What `///` says of it.
    pub doc: String,
}

/// The rows of a family, and what is odd about them.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct TableView {
    /// The rows, in order.
    pub rows: Vec<FamilyRow>,
    /// Names that stand twice, rows alike, columns that go back where they grow.
    pub notes: Vec<String>,
}

/// A row: a name, and values of parameters. What is not said is the program's own example.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FamilyRow {
    /// Its name: the designation, or its number.
    pub name: String,
    /// Parameters and values.
    pub values: Vec<(String, kernel::Literal)>,
    /// The same as they are written, with their units.
    pub written: Vec<(String, String)>,
    /// The line of the table, from 1; 0 for a row of the document.
    pub line: u32,
    /// Why a cell is no value, where one is none.
    pub fault: Option<String>,
}

/// What a row is written as.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct RowFormats {
    /// SVG at scale.
    pub svg: bool,
    /// DXF in millimetres.
    pub dxf: bool,
}

/// What came of a row.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct RowOutcome {
    /// The row's name.
    pub name: String,
    /// `drawn`, `outside`, `failed` or `too-long`.
    pub outcome: String,
    /// The demand that is not met, or the step without an outcome; `table` for a cell that is no value.
    pub step: String,
    /// What was found and what was wanted; of what was drawn as a picture or a file what it is doubtful for.
    pub message: String,
    /// The numbers of what was drawn, by their paths.
    #[serde(serialize_with = "pairs")]
    pub measures: eval::Measures,
    /// The drawing at scale, as SVG, where that was asked for.
    pub svg: String,
    /// The drawing in millimetres, as DXF, where that was asked for.
    pub dxf: String,
}

fn pairs<S: serde::Serializer>(measures: &eval::Measures, to: S) -> Result<S::Ok, S::Error> {
    to.collect_seq(measures.iter())
}
