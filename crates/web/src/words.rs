//! Every word that the page itself says, in one place for translation.
//!
//! What a document says (its names, its comments, the session's messages) comes from the session.
#![expect(missing_docs, reason = "a word says itself what it says")]

mod drafting;
mod family;
mod hand;
mod jobs;
mod lessons;
pub use drafting::*;
pub use family::*;
pub use hand::*;
pub use jobs::*;
pub use lessons::*;

pub const LAB: &str = "ThingLab";
pub const GALLERY: &str = "Gallery";
pub const GALLERY_LEAD: &str = "Documents whose constraints stay true while you drag. Open one, take hold of a point, and look.";
pub const FIND_DOCUMENT: &str = "Find a document";
pub const NONE_FOUND: &str = "No document has these words.";
pub const RECENT: &str = "Recent";
pub const BLANK_CARD: &str = "nothing drawn yet";
pub const KEPT_HERE: &str = "not saved yet, kept in this browser";
pub const YOUR_DOCUMENTS: &str = "In this folder";
pub const DOCUMENTS_BELOW: &str = "In folders below it";
pub const NO_DOCUMENTS: &str = "There are no documents here yet.";
pub const LOADING: &str = "Loading";
pub const OPENING: &str = "Opening the document";
pub const OPENING_GIVEN_UP: &str = "opening it was cancelled";
pub const EDITOR_COMES: &str = "The editor is being fetched";
pub const EDITOR_FAILED: &str =
    "The editor could not be fetched: start the server again, then open the text once more";
pub const SKIP: &str = "Skip to the picture";
pub const NO_SERVER: &str = "the server does not answer; what you change is kept in this browser";
pub const NOT_SAVED: &str = "not saved yet";
pub const READ_ONLY: &str = "built in; saving makes a copy in your folder";

pub const PICTURE: &str = "Picture";
pub const STRUCTURE: &str = "Structure";
pub const FIRST_LEAD: &str = "New here? One minute with a figure that keeps its promises.";
pub const FIRST_BEGIN: &str = "Drag a corner";
pub const FIRST_SKIP: &str = "Skip";
pub const INSPECTOR: &str = "Inspector";
pub const PARAMETERS: &str = "what is given in this document";
pub const NOTHING_GIVEN: &str =
    "Only places are given. Select something to see its values and constraints.";
pub const IS_RULE: &str = "a constraint";
pub const CONSTRAINTS: &str = "Constraints";
pub const TABLE: &str = "Table";
pub const CALCULATOR: &str = "Calculator";
pub const CALCULATOR_LEAD: &str = "Type an expression of the document's values, such as pi() * 3 or a path: its value follows every change.";
pub const EXPRESSION: &str = "Expression";
pub const KEEP_EXPRESSION: &str = "Add to the document";
pub const VIEWS_OF: &str = "Views";
pub const PLOT: &str = "Plot";
pub const PLOT_SHOW: &str = "Show";
pub const PLOT_SHOWN: &str = "What is plotted";
pub const PLOT_ANY: &str = "a path or an expression";
pub const PLOT_SELECTION: &str = "Plot it";
pub const PLOT_SWEEP: &str = "Sweep";
pub const PLOT_THE_DRAG: &str = "nothing: follow drags";
pub const PLOT_FROM: &str = "From";
pub const PLOT_TO: &str = "To";
pub const PLOT_OVER: &str = "Over";
pub const PLOT_OVER_SWEPT: &str = "what is swept";
pub const PLOT_OVER_EVENT: &str = "the course of the drag";
pub const PLOT_NOTHING: &str = "Name what is to be plotted: a number makes a curve, a point its locus in the picture. Or select it, and press the button.";
pub const PLOT_DRAG: &str =
    "Drag something in the picture: every move is a point of the plot. Or name a value to sweep.";
pub const NOTHING_PLOTTED: &str = "select a value or a point to plot";
pub const CHART_HELP: &str =
    "wheel: zoom; drag: shift; double click or F: all of it; arrow keys: read along the curve";
pub const PARTS: &str = "Parts";
pub const DOCK: &str = "Text, tables";
pub const SHEET: &str = "Panels";
pub const EXPORT_SVG: &str = "Export the picture as SVG";
pub const EXPORT_PNG: &str = "Export the picture as PNG";
pub const EXPORT_DXF: &str = "Export the picture as DXF";
pub const EXPORT_CSV: &str = "Export the values as CSV";
pub const PRINT: &str = "Print the picture";
pub const SHARE: &str = "Copy a link that carries the document";
pub const LINK_COPIED: &str = "the link is copied; it carries the whole document";
pub const LINK_IN_BAR: &str = "the link stands in the address bar; it carries the whole document";
pub const LINK_BROKEN: &str = "this link carries no document, or only a piece of one";
pub const FREE_PARTS: &str = "Free:";
pub const SELECT_FREE: &str = "Select them all";
pub const VALUES: &str = "Values";
pub const TEXT: &str = "Text";
pub const WHY: &str = "Why";
pub const TOOLS: &str = "Tools";
pub const STATUS: &str = "Status";
pub const RESIZE: &str = "Resize";
pub const PICTURE_HELP: &str = "Tab chooses a point, the arrow keys move it, F fits the picture.";

pub const OPEN_GALLERY: &str = "Gallery";
pub const SAVE: &str = "Save";
pub const SAVE_AS: &str = "Save under another name";
pub const NEW: &str = "New document";
pub const OPEN_FILE: &str = "Open a file of this machine";
pub const FILE: &str = "File";
pub const RENAME: &str = "Rename";
/// Where a name is looked for and there is none.
pub const NAMES_NOTHING: &str = "Nothing is named here.";
/// Of a text that belongs to a library.
pub const OF_A_LIBRARY: &str = "read only";
pub const MENU: &str = "Menu of the selection";
pub const VIEWS: &str = "Structure, bin and history";
pub const BIN: &str = "Bin";
pub const FILTER_BIN: &str = "Filter the bin";
pub const OWN_CLASSES: &str = "this document";
pub const NOT_USED_YET: &str = "In libraries that are not used yet";
pub const MORE_LIBRARIES: &str = "More libraries";
pub const DOCUMENTS_BESIDE: &str = "Documents beside this one";
pub const SELECT: &str = "Select and drag";
pub const INSERT: &str = "Insert from the bin";
pub const NO_CLASS: &str = "no library in use has this; the bin offers more";
pub const TOOL_POINT: &str = "Point";
pub const TOOL_LINE: &str = "Line";
pub const TOOL_CIRCLE: &str = "Circle";
pub const TOOL_ARC: &str = "Arc";
pub const TOOL_RECTANGLE: &str = "Rectangle";
pub const CONSTRAIN: &str = "What holds of the selection";
pub const DIMENSION: &str = "Dimension: a length, a distance, an angle, a radius";
pub const NO_DIMENSION: &str =
    "choose two points, a line, a circle or two lines: then D gives them a value";
pub const NOTHING_TO_SAY: &str = "nothing can be said of this selection";
pub const HISTORY: &str = "History";
pub const AS_OPENED: &str = "as it was opened";
pub const DUPLICATE: &str = "Duplicate";
pub const DUPLICATE_JOINED: &str = "Duplicate, joined to the same";
pub const COPY: &str = "Copy";
pub const CUT: &str = "Cut";
pub const PASTE: &str = "Paste";
pub const SELECT_ALL: &str = "Select everything";
pub const NOTHING_COPIED: &str = "nothing was copied";
pub const NO_THINGS_COPIED: &str = "the clipboard holds no text that says something of things";
pub const NOTHING_THERE: &str = "the document has no things";
pub const CLASS_OF: &str = "Make a class of it";
pub const NUMBER: &str = "Number with a slider";
pub const ASK_NUMBER: &str = "A number with its name, such as turn = 30 deg";
pub const EDIT_CLASS: &str = "Edit its class";
pub const LEAVE_CLASS: &str = "Back to the document";
pub const BACK_TO_DOCUMENT: &str = "Done";

pub fn leave_class(document: &str) -> String {
    format!("{LEAVE_CLASS}: {document}")
}
pub const EVERY_ONE_FOLLOWS: &str = "every one is like this, and follows";
pub const NO_OWN_CLASS: &str = "its class is a library's; make a class or a kind of your own first";
pub const NO_CLASS_SHOWN: &str = "no class is edited";
pub const KIND_OF: &str = "Make a kind of it";
pub const NOT_A_WHOLE: &str = "select a whole thing of the document";
pub const OF_EVERY: &str = "Say it of every one of its class";
pub const NOT_OF_ONE: &str = "select a constraint or a part of one thing";
/// What is asked of a class that inherits.
pub fn name_of_kind(path: &str) -> String {
    format!("Name of the kind that {path} is, such as LevelRhombus")
}
/// What is shown while a class is edited.
pub fn class_shown(class: &str) -> String {
    format!("The class {class}")
}
/// What the button on a tile does.
pub fn edit_class(class: &str) -> String {
    format!("Edit the class {class}")
}
pub const NAME_OF_CLASS: &str = "Name of the class that the selection becomes the parts of";
/// What a class's name looks like.
pub const CLASS_NAME_LIKE: &str = "Rhombus";
/// Over what has to be decided of a class by example.
pub const OF_WHAT: &str = "What every one of them has";
/// That something is of the class.
pub const OF_CLASS: &str = "every one";
/// That something is of the one thing only.
pub const OF_THIS_ONE: &str = "this one only";
/// Over the points by which a thing is placed.
pub const STICKS_AT: &str = "Where it sticks to others";
/// How such points are said.
pub const STICKS_AT_HINT: &str =
    "Click points in the picture, or choose them here, in the order in which they are placed.";
/// The button that makes the class.
pub const MAKE_CLASS: &str = "Make the class";
pub const NAME: &str = "Name";
pub const NAME_OF_DOCUMENT: &str = "Save under the name";
pub const DOWNLOAD: &str = "Download the text";
pub const UNDO: &str = "Undo";
pub const REDO: &str = "Redo";
pub const HOLD_FOR_LIST: &str = "hold: the list of steps";
pub const FIT: &str = "Fit the picture";
pub const ZOOM_IN: &str = "Zoom in";
pub const ZOOM_OUT: &str = "Zoom out";
/// What the step of the grid is beside the zoom.
pub const GRID_STEP: &str = "From one line of the grid to the next";
pub const GRID: &str = "Show or hide the grid";
pub const PLAY: &str = "Play the selected number, or stop";
pub const NO_NUMBER: &str = "select a number that can change";
pub const LOCK: &str = "Lock or unlock";
pub const LOCK_IT: &str = "lock";
pub const UNLOCK_IT: &str = "unlock";
pub const ENABLE: &str = "Switch the constraint on";
pub const DISABLE: &str = "Switch the constraint off";
pub const DELETE: &str = "Delete";
pub const MERGE: &str = "Merge: make them one";
pub const RECOGNISE: &str = "What could it be parts of?";
pub const UNMERGE: &str = "Unmerge: take it apart";
pub const EXPLAIN: &str = "Why is it so?";
pub const DESELECT: &str = "Select nothing";
pub const GO_PICTURE: &str = "Go to the picture";
pub const GO_STRUCTURE: &str = "Go to the structure";
pub const GO_VALUES: &str = "Go to the values";
pub const GO_TEXT: &str = "Go to the text";
pub const GO_PLOT: &str = "Go to the plot";
pub const GO_FAMILY: &str = "Go to the family of a program";
pub const THEME: &str = "Light, dark or as the system says";
pub const SEARCH: &str = "Search";
pub const BUILT_IN: &str = "built in";
pub const PALETTE: &str = "Search actions and documents";
pub const OPEN: &str = "Open";

pub const NOTHING_TO_UNDO: &str = "nothing has been changed yet";
pub const NOTHING_TO_REDO: &str = "nothing was taken back";
pub const NOTHING_TO_SAVE: &str = "everything is saved";
pub const NO_DOCUMENT: &str = "no document is open";
pub const NOTHING_SELECTED: &str = "nothing is selected";
pub const NOT_A_CONSTRAINT: &str = "the selection is not a constraint";
pub const IS_A_CONSTRAINT: &str = "a constraint has no value to lock";
pub const ONE_SELECTED: &str = "only one thing is selected; Ctrl+click, or in the structure Ctrl+arrows and Ctrl+Space, choose another";
pub const NOT_MERGED: &str = "the selection is not merged with anything";
pub const NO_PATH: &str = "this has no name of its own: take it out of the text";
pub const NO_SUCH_ACTION: &str = "No action has this name.";

pub const LOCK_NAME: &str = "Lock";
pub const LOCKED: &str = "Locked: only typing a value changes it. Press to unlock.";
pub const UNLOCKED: &str = "Free to follow the others. Press to lock.";
pub const COMPUTED: &str = "what the constraints make it";
pub const GIVEN: &str = "given in the text";
pub const SCRUB: &str = "Drag sideways to change it";
pub const FILTER: &str = "Filter";
pub const NO_VALUES: &str = "No value has this name.";
pub const MERGED_WITH: &str = "one with";
pub const MORE_VALUES: &str = "more; the filter finds them";

pub const COLUMN_PATH: &str = "Name";
pub const COLUMN_VALUE: &str = "Value";
pub const COLUMN_UNIT: &str = "Unit";
pub const OFF_BY: &str = "off by";
pub const CLOSE: &str = "Close";
pub const SWEEP_STOPPED: &str = "the sweep was stopped; the plot shows how far it had come";
pub const RESTORE: &str = "Restore";
pub const DISCARD: &str = "Discard";
pub const DRAFT_NOT_KEPT: &str = "The browser has no room for what is unsaved: save it soon";
pub const DRAFT_FOUND: &str = "There are unsaved changes of yours from an earlier visit.";
pub const CONFLICT: &str = "The file has changed on disk since it was opened.";
pub const CONFLICT_GONE: &str = "The file has been removed from disk since it was opened.";
pub const TAKE_THEIRS: &str = "Take what is on disk";
pub const OVERWRITE: &str = "Overwrite with this";
pub const NOT_DRAGGED: &str = "cannot be dragged";
pub const REPAIRS: &str = "What would work:";
pub const IN_THE_WAY: &str = "In the way:";

pub const NOT_RECOGNISED: &str =
    "No class of this document has such parts with all its rules true.";
pub const RECOGNISED: &str = "These could be the parts of";
pub const MAKE_ONE: &str = "Make it one";
pub const ADVICE: &str = "Would be lighter";
pub const ADD_IT: &str = "Add it";
pub const ELSEWHERE: &str = "Could also be";
pub const PICK: &str = "Put it there";
pub const HELD: &str = "Does not move";
pub const CONTRADICTION: &str = "Cannot hold together";
pub const FREE: &str = "Can still move";
pub const UNMET: &str = "Do not hold";
pub const REDUNDANT: &str = "Say nothing new";
pub const STEPS: &str = "How the values come about";
pub const WHOLE_DOCUMENT: &str = "the whole document";
pub const PROBLEMS: &str = "Problems";

pub const CRASH: &str = "The lab has stopped";
pub const CRASH_ADVICE: &str = "This is a fault of ours. What you changed is kept in this browser and offered after reloading.";
pub const RELOAD: &str = "Reload";

pub const IS_OFF: &str = "it is off already";
pub const IS_ON: &str = "it is on already";
pub const ENABLED: &str = "switched on";
pub const DONE: &str = "Done";
pub const CANCEL: &str = "Cancel";

/// What the status line says while a value is swept.
pub fn sweeping(of: &str, done: u32, all: u32) -> String {
    format!("sweeping {of}: {done} of {all}; Esc stops")
}

pub fn calculator_without(written: &str) -> String {
    format!("Remove {written}")
}
pub fn expression_kept(name: &str) -> String {
    format!("the document answers {name} now")
}

/// Says what a chart shows, to those who do not see it.
pub fn chart_of(plot: &session::plotting::Plot) -> String {
    let curves = plot.curves.iter().map(|curve| curve.axis.in_words());
    let loci = plot.loci.iter().map(|locus| format!("the locus of {}", locus.label));
    let shown = curves.chain(loci).collect::<Vec<_>>().join(", ");
    if plot.curves.is_empty() { shown } else { format!("{shown} over {}", plot.over.in_words()) }
}
pub fn plot_ends(notes: &str) -> String {
    format!("The sweep ends early: {notes}.")
}
pub fn plot_without(path: &str) -> String {
    format!("Plot without {path}")
}
/// A number as a person types it, with its unit where it has one.
pub fn with_unit(number: &str, unit: &str) -> String {
    if unit.is_empty() { String::from(number) } else { format!("{number} {unit}") }
}

/// What a change did besides what it was meant to do; nothing if that is all.
pub fn done(change: &session::view::Change) -> Option<String> {
    const SHOWN: usize = 3;
    let listed = |items: &[String]| {
        let first = items[..items.len().min(SHOWN)].join(", ");
        match items.len().saturating_sub(SHOWN) {
            0 => first,
            more => format!("{first} and {more} more"),
        }
    };
    if !change.unsatisfied.is_empty() {
        return Some(format!("Cannot be satisfied now: {}", listed(&change.unsatisfied)));
    }
    if let Some(unit) = &change.unit {
        return Some(in_unit(unit));
    }
    if !change.along.is_empty() {
        return Some(format!("Gone along: {}", listed(&change.along)));
    }
    let modes: Vec<String> = change.modes.iter().map(|mode| mode.message.clone()).collect();
    (!modes.is_empty()).then(|| listed(&modes))
}

/// What a sheet that took over a unit counts in.
pub fn in_unit(unit: &str) -> String {
    format!("Lengths without a unit are in {unit} from now on")
}

/// What was said, and the unit that the sheet took over with it.
pub fn also(said: String, unit: Option<&str>) -> String {
    match unit {
        Some(unit) => format!("{said}. {}", in_unit(unit)),
        None => said,
    }
}

/// What the selection could be the parts of, in one sentence.
pub fn recognised(found: &[session::view::Recognised]) -> String {
    let classes: Vec<&str> = found.iter().map(|r| r.class.as_str()).collect();
    format!("{RECOGNISED}: {}", classes.join(", "))
}

/// How many rules of a class are true of the selection.
pub fn rules_hold(rules: u32) -> String {
    match rules {
        0 => String::from("it has no rules"),
        1 => String::from("its one rule holds"),
        n => format!("its {n} rules hold"),
    }
}

/// In how many ways things can move.
pub fn ways(freedom: u32) -> String {
    match freedom {
        1 => String::from("in one way"),
        n => format!("in {n} ways"),
    }
}

/// The freedom of a thing as a word.
pub fn freedom(freedom: session::view::Freedom) -> &'static str {
    match freedom {
        session::view::Freedom::Free => "free",
        session::view::Freedom::Fixed => "fixed",
        session::view::Freedom::Conflicting => "conflicting",
        session::view::Freedom::Redundant => "redundant",
    }
}

/// What a step of the undo list is called on its button.
pub fn undo_step(label: &str) -> String {
    format!("{UNDO}: {label}")
}

/// The same for a step that was taken back.
pub fn redo_step(label: &str) -> String {
    format!("{REDO}: {label}")
}

/// What a screen reader hears of a point.
pub fn point_at(path: &str, x: f64, y: f64, state: Option<&str>) -> String {
    let (x, y) = (short(x), short(y));
    match state {
        Some(state) => format!("{path} at ({x}, {y}), {state}"),
        None => format!("{path} at ({x}, {y})"),
    }
}

/// What a screen reader hears of a picture.
pub fn picture_of(title: &str, grips: usize) -> String {
    match grips {
        0 => format!("{title}: nothing to drag. {PICTURE_HELP}"),
        1 => format!("{title}: one point to drag. {PICTURE_HELP}"),
        n => format!("{title}: {n} points to drag. {PICTURE_HELP}"),
    }
}

/// A number for reading aloud: at most three decimals.
pub fn short(number: f64) -> String {
    let rounded = (number * 1000.0).round() / 1000.0;
    if rounded == 0.0 { String::from("0") } else { rounded.to_string() }
}

/// Where a diagnostic is.
pub fn line_column(line: u32, column: u32) -> String {
    format!("line {line}, column {column}")
}

/// That another document has a name.
pub fn name_taken(path: &str) -> String {
    format!("there is a document {path} already; choose another name")
}

/// What is asked of a thing that gets another name.
pub fn new_name_of(path: &str) -> String {
    format!("New name of {path}")
}

/// How far the lines of the grid are apart.
pub fn grid_step(step: &str, unit: &str) -> String {
    format!("grid {step} {unit}")
}

/// What the button that fits the picture says: its scale, which it shows, and what it does.
pub fn fit_at(scale: &str) -> String {
    format!("{scale}: {FIT}")
}

/// The title of what is printed as large as it is.
pub fn true_size(title: &str) -> String {
    format!("{title} (1 : 1)")
}

/// A place of the sheet, as it is heard and typed.
pub fn place((x, y): (f64, f64)) -> String {
    format!("{}, {}", base::number::significant(x, 6), base::number::significant(y, 6))
}

/// What something that is dropped is joined with.
pub fn joins(path: &session::Path) -> String {
    format!("joins {path}")
}

/// What was typed of a length while a tool is held.
pub fn typed_for_tool(typed: &str) -> String {
    let what = if typed.contains(',') { "place" } else { "length" };
    format!("{what} {typed}: Enter sets it, Backspace takes a digit back")
}

/// What was typed for a tool and is nothing that it takes.
pub fn no_length(typed: &str) -> String {
    format!("`{typed}` is no length; type 30, 3 cm, 30<45 or a place, 120,40")
}

/// What is asked of a dimension.
pub fn value_of(label: &str) -> String {
    format!("Value of the {label}")
}

/// What goes with something that is to be deleted.
pub fn goes_along(path: &str, along: &[String]) -> String {
    let rule = |said: &String| said.strip_prefix("constraint ").map(session::rule_in_words);
    let told: Vec<String> = along.iter().map(|said| rule(said).unwrap_or(said.clone())).collect();
    format!("With {path} goes what speaks of it: {}", told.join("; "))
}

/// Several things, by their number.
pub fn counted(things: usize) -> String {
    format!("the {things} things")
}

/// A button that deletes so many members.
pub fn delete_all(members: usize) -> String {
    format!("Delete all {members}")
}

/// That a thing has no value of its own to type.
pub fn no_value_to_type(path: &str) -> String {
    format!("{path} has no value but its place")
}

/// What a screen reader hears of a constraint's switch.
pub fn switch_of(path: &str) -> String {
    format!("{path} holds")
}

/// What begins to play a value.
pub fn plays(path: &str) -> String {
    format!("Play {path}")
}

/// What ends it.
pub fn stops(path: &str) -> String {
    format!("Stop {path}")
}

/// A slider's range has no upper end.
pub const OPEN_ABOVE: &str = "open above: larger values can be typed";
/// A slider's range has no lower end.
pub const OPEN_BELOW: &str = "open below: smaller values can be typed";

/// What a screen reader hears of a value's slider.
pub fn slider_of(path: &str) -> String {
    format!("{path}, slider")
}

/// Why a document is not shared by a link.
pub fn link_too_long(letters: usize, most: usize) -> String {
    format!(
        "the link would have {letters} letters, more than {most}: save or download the document instead"
    )
}

/// How many are not listed.
pub fn and_more(more: usize) -> String {
    format!("and {more} more")
}

/// What was saved.
pub fn saved(path: &str) -> String {
    format!("saved {path}")
}

/// What a scheme of colours is called.
pub fn theme(theme: crate::theme::Theme) -> &'static str {
    match theme {
        crate::theme::Theme::System => "Colours as the system says",
        crate::theme::Theme::Light => "Light",
        crate::theme::Theme::Dark => "Dark",
    }
}

/// The drawer of constructions and recording.
pub const DRAW: &str = "Draw";
/// The prompt of a construction.
pub const CONSTRUCTION: &str = "Construction";
/// The field of an operand.
pub const OPERAND: &str = "type it, or pick it";
/// What is drawn is for construction alone.
pub const GUIDE: &str = "guide";
/// Takes the latest operand back.
pub const BACK: &str = "Back";
/// Ends a construction.
pub const GIVE_UP: &str = "Done";
/// Begins to record.
pub const RECORD: &str = "Record";
/// Ends a recording.
pub const STOP: &str = "Stop";
/// Deletes a step.
pub const DELETE_STEP: &str = "Delete step";
/// The field that finds constructions.
pub const FILTER_CONSTRUCTIONS: &str = "Find a construction";

/// What is recorded.
pub fn recording(program: &str) -> String {
    format!("Recording {program}")
}

/// What Enter does in the field that narrows the constructions.
pub const FILTER_HELP: &str = "Enter begins the one that is marked";

/// Why a tool draws nothing while a program is recorded.
pub fn no_step(class: &str, program: &str) -> String {
    format!("a {class} is no step of {program}: draw it by lines and arcs, or stop recording first")
}

/// Whose steps are listed.
pub fn steps_of(program: &str) -> String {
    format!("{program}, step by step")
}

/// What goes with a step.
pub fn deleted_along(along: &[String]) -> String {
    match along {
        [] => String::from("Nothing else speaks of it."),
        all => format!("Goes along: {}.", all.join(", ")),
    }
}

/// Begins a loop.
pub const REPEAT: &str = "Repeat";
/// Begins an `if`.
pub const IF: &str = "If";
/// Begins a loop over a set.
pub const FOR_EACH: &str = "For each";
/// Ends the first turn of a loop that ends by a condition after a turn.
pub const UNTIL: &str = "Until";
/// Ends the first turn of a loop that goes on by a condition before a turn.
pub const WHILE: &str = "While";
/// Ends the first turn of a loop of so many turns.
pub const TIMES: &str = "Times";
/// Ends what is done for the first of a set.
pub const DONE_FOR_EACH: &str = "Do so for each";
/// Ends the first branch.
pub const ELSE: &str = "Otherwise";
/// Ends an `if`.
pub const END_IF: &str = "End if";
/// The answer that an operand stays.
pub const THE_SAME: &str = "The same";
/// The answer that an operand runs through a set.
pub const EACH_IN_TURN: &str = "Each in turn";
/// The other branch is drawn by the same values.
pub const SAME_VALUES: &str = "With the same values";
/// The other branch is drawn by the values that were set meanwhile.
pub const OTHER_VALUES: &str = "With the values as they are set now";
/// Closes a loop.
pub const CLOSE_LOOP: &str = "Run the rest";
/// Begins a branch.
pub const DRAW_BRANCH: &str = "Draw it";
/// Goes through a program.
pub const VISIT: &str = "Visit";
/// Goes to the start.
pub const VISIT_START: &str = "Before the first step";
/// Goes back.
pub const VISIT_BACK: &str = "One step back";
/// Goes on.
pub const VISIT_STEP: &str = "One step on";
/// Goes into a block.
pub const VISIT_IN: &str = "Into the block that comes next";
/// Goes out of a block.
pub const VISIT_OUT: &str = "Out of this block";
/// Goes to the end.
pub const VISIT_END: &str = "To the end: recording goes on there";
/// The button that goes on until something is drawn.
pub const VISIT_UNTIL: &str = "until …";
/// Goes on until something is drawn.
pub const VISIT_PICKED: &str = "Until what you pick in the picture is drawn";
/// Goes to a step.
pub const VISIT_HERE: &str = "Go to this step: what is drawn then is inserted before it";
/// Draws a step anew.
pub const REPLACE_STEP: &str = "Replace this step by what you draw next";
/// Changes a part of what a step says.
pub const CHANGE_OPERAND: &str = "Change it: pick or type another";
/// The field of a step's number on the drawing.
pub const STEP_NUMBER: &str = "number of the step";
/// That a program is visited by other values than its example's own.
pub const BY_OTHERS: &str = "Visited by other values. ";
/// Gives the example its own values again.
pub const OWN_VALUES: &str = "Own values";

/// How a number of a step is changed.
pub fn typed_anew(says: &str) -> String {
    format!("{says}: double click, or Enter, to type another")
}

/// Goes on recording.
pub const RECORD_MORE: &str = "Record more of it";
/// What speaks of a step that is deleted goes too.
pub const DELETE_TOO: &str = "Delete it too";

/// What is to be done to replace a step.
pub fn draw_anew(step: &str) -> String {
    format!("choose a construction: what you draw next takes the place of {step}")
}

/// Keeps the expression.
pub const KEEP: &str = "keep this expression";
/// Takes the last letter back.
pub const BACKSPACE: &str = "take the last letter back";
/// Gives the expression.
pub const GIVE: &str = "Enter";
/// Lets a pick of a set mean more.
pub const WIDER: &str = "Wider";
/// That, with the key that does it.
pub const WIDER_BY_KEY: &str = "Wider (Tab)";
/// How a set is caught.
pub const BAND: &str = "Draw a rectangle around the figures; each is taken by its name.";

/// The field of a parameter's value.
pub fn value_of_parameter(name: &str) -> String {
    format!("value of {name}")
}

/// What is asked of a part, a value, a constraint or a merge of a class by example.
pub fn scope_of(says: &str) -> String {
    format!("{says}: of what")
}

/// That a number becomes a parameter.
pub fn parameter(name: &str) -> String {
    format!("parameter {name}")
}

/// The tool that draws regular polygons.
pub const TOOL_POLYGON: &str = "Polygon";
/// The tool that places words.
pub const TOOL_TEXT: &str = "Text";
/// The action that says an equation over what is selected.
pub const EQUATION: &str = "Equation";
/// What is asked of an equation.
pub const ASK_EQUATION: &str = "An equation that shall hold, such as a.length = 2 * b.length";

/// What an edit would move.
pub fn would_move(moved: &[String]) -> String {
    const MOST: usize = 4;
    match moved {
        [] => String::from("it moves nothing"),
        all if all.len() <= MOST => format!("it moves {}", all.join(", ")),
        all => format!("it moves {} and {} more", all[..MOST].join(", "), all.len() - MOST),
    }
}

/// The button of the strip that makes a class of the selection.
pub const CLASS: &str = "class…";
/// The action that holds a placed thing of a program, or lets it go.
pub const HOLD_PLACE: &str = "Fit by dragging: hold its place, or let it go";
/// The action that makes plain figures of what a program drew.
pub const UNLINK: &str = "Unlink from its program";
/// Why an action about programs cannot be done.
pub const NOT_DRAWN: &str = "no program draws what is selected";
/// Why a thing cannot be held in its place.
pub const NOT_PLACED: &str =
    "what is selected has no place of its own: place it from the bin or a row";

/// That a thing is held in its place.
pub fn held_in_place(thing: &str) -> String {
    format!("{thing} is held in its place: a drag of what it shows fits its parameters")
}

/// That a thing is let go.
pub fn let_go(thing: &str) -> String {
    format!("{thing} is let go: a drag of what it shows moves it")
}

/// What an unlinked thing became.
pub fn unlinked(thing: &str, figures: &[String]) -> String {
    format!("{thing} became {}", figures.join(", "))
}

/// The action that gives the keyboard to constructions and recording.
pub const GO_DRAW: &str = "Go to drawing and recording";
/// The action that gives the keyboard to what is wrong, and what would mend it.
pub const GO_WHY: &str = "Go to the reasons and repairs";
/// The action that gives the keyboard to the inspector.
pub const GO_INSPECTOR: &str = "Go to the inspector";

/// What the inspector is about where several things are selected.
pub fn several(number: usize) -> String {
    format!("{number} things")
}

/// That no class and no library has a name.
pub fn nothing_called(typed: &str) -> String {
    format!("nothing in the bin is called {typed}, and no library")
}

/// That a class was made.
/// What the undo list calls it.
pub fn make_class(name: &str) -> String {
    format!("make the class {name}")
}
pub fn class_made(name: &str) -> String {
    format!("{name} is a class now; the bin has it")
}

/// Names the text in which a name is declared.
pub fn declared_in(file: &str) -> String {
    format!("Declared in {file}")
}

/// Says of a word of the language that nobody declares it.
pub fn of_the_language(says: &str) -> String {
    format!("{says}: a word of the language itself.")
}

/// Says of what a library declares that it cannot be renamed here.
pub fn keeps_its_name(says: &str, file: &str) -> String {
    format!("{says} is declared in {file}: it keeps its name here.")
}

/// Says how many copies wait to be put down.
pub fn copied(count: usize) -> String {
    match count {
        1 => String::from("copied; Ctrl+V puts it down"),
        _ => format!("{count} things copied; Ctrl+V puts them down"),
    }
}

/// The values of a thing, where something that it computes is selected.
pub fn values_of(whole: &str) -> String {
    format!("{VALUES} of {whole}")
}
