//! What the page says to hands that build.

/// Nothing is on the sheet yet.
pub const EMPTY_SHEET: &str = "The sheet is empty. Draw with a tool of the rail, take a part out of the bin, or choose a construction under Draw.";
/// What the mouse does while things are given sizes.
pub const SIZING: &str = "Dimension: click a line or a circle, type; a second click before that: between both; Enter sets it; Esc: done";
/// What the mouse does with nothing in the hand.
pub const BAND_HINT: &str =
    "drag over things to select them; Space and drag: move the sheet; wheel: zoom; ?: all keys";
/// What it does with what is selected.
pub const HAND_HINT: &str = "Ctrl+click: another as well; double-click: its value; right click: what can be done with it; ?: all keys";
/// What keys do on an empty sheet.
pub const KEYS_OF_EMPTY: &str = "L: a line; C: a circle; I: a part out of the bin; Alt+7: constructions; ?: all that can be done, with its keys";
/// What they do in the picture, with nothing selected.
pub const KEYS_IN_PICTURE: &str = "Tab: the next point; Alt+2: the structure, to select anything; ?: all that can be done, with its keys";
/// What they do with what is selected.
pub const KEYS_OF_SELECTION: &str = "K: what can hold of it; D: its size; Alt+5: its values; Alt+2: choose others in the structure; Shift+F10: menu; ?: all keys";
/// What they do in the structure.
pub const KEYS_IN_TREE: &str = "↑ ↓ → ←: choose; Ctrl+↑ or ↓, then Ctrl+Space: another as well; K: what can hold; M: merge; Alt+5: values; ?: all keys";
/// What they do in the bin.
pub const KEYS_IN_BIN: &str = "Enter: the first of these where there is room; ↓: the others; Alt+2: the structure, to join and select";
/// What they do in the strip of what fits the selection.
pub const KEYS_IN_STRIP: &str =
    "→ ←: the next, which shows what would move; Enter: so it shall be; Alt+1: back to the picture";
/// What they do where something does not hold.
pub const KEYS_OF_CONFLICT: &str =
    "Alt+6: why it does not hold, and what would repair it; Ctrl+Z: undo; ?: all keys";
/// What they do anywhere else.
pub const KEYS_ELSEWHERE: &str =
    "Alt+1: the picture; Alt+2: the structure; Ctrl+K: all that can be done, with its keys";

/// What a tool wants, said to who uses keys: the pointer's words become those of keys, and what only it can do is left out.
pub fn tool_by_keys(hint: &str) -> String {
    /// What keys do with any tool.
    const KEYS: &str = "arrows or Tab: next point, middle; 120,40: a place";
    let parts: Vec<&str> = hint.split("; ").filter(|part| !part.starts_with("Shift:")).collect();
    let (first, rest) = parts.split_first().unwrap_or((&"", &[]));
    let first = first.replace(CLICK_OR_PRESS, "Enter").replace(CLICK, "Enter");
    [&[first.as_str(), KEYS][..], rest].concat().join("; ")
}

/// What keys do while things are given sizes.
pub const SIZING_BY_KEYS: &str = "Dimension: choose a line, a circle or two points in the structure (Alt+2; Ctrl+Space: another as well), then D; Esc: done";
/// What constraints say, on the drawing.
pub const ANNOTATIONS: &str = "Show or hide dimensions and signs";
/// What is said once words have been moved on the drawing.
pub const NOTE_MOVED: &str = "Moved for as long as this page shows the document: the text does not say where dimensions stand";
/// A value that a constraint gives.
pub const TYPE_VALUE: &str = "Type another value (D)";
/// A dimension that only reads.
pub const ONLY_READ: &str = "Only read it";
/// What that does.
pub const ONLY_READ_HELP: &str =
    "A reference dimension: it shows the value in parentheses and sets nothing";
/// Says how a size is asked for between two things, by keys.
pub const SIZE_BESIDE: &str = "↓ or ↑: a size between this and another thing.";

/// Says between what a size would be asked for.
pub fn size_to(path: &str) -> String {
    format!("Enter: the size between this and {path}")
}

/// What is said of a dimension that only reads, where another value is asked for.
pub const ONLY_FOLLOWS: &str = "It only follows what it measures. With Done, or Enter, it rules: what is free there has to yield.";
/// What is touched next is selected besides.
pub const ALSO: &str = "+ also";
/// What that does.
pub const ALSO_HELP: &str = "Select further things by touching them; touch the empty sheet to end";
/// Inserts a thing of a class where there is room.
pub const CLASS_INSERT: &str = "Insert one";
/// Shows the prototype of a class of the bin.
pub const CLASS_EDIT: &str = "Edit this class";
/// Gives a class of the bin another name.
pub const CLASS_RENAME: &str = "Rename this class";
/// Takes a class of the bin out of the document.
pub const CLASS_DELETE: &str = "Delete this class";
/// Why none of these can be done.
pub const NO_TILE: &str = "ask a class of your own in the bin for its menu first";

/// What is said once a class is gone.
pub fn class_deleted(class: &str) -> String {
    format!("{class} is gone; Ctrl+Z brings it back")
}

/// Leads the selected number through a range, and plots over it.
pub const SWEEP_SELECTION: &str = "Sweep it in the plot";
/// What is given in the class whose prototype is shown.
pub const GIVEN_IN_CLASS: &str = "what is given in every one of this class";
/// The value of what is one itself.
pub const VALUE: &str = "value";
/// What the strip says of a dimension that is said already.
pub const SAID_ALREADY: &str = "said already: press to give it another value";
/// What the strip says of a check mark.
pub const HOLDS_ALREADY: &str = "it is so already: something says it, or it follows";

/// A link that carries a document was opened where the server does not answer.
pub fn then_link(message: &str) -> String {
    format!("{message}; then open the link again, which carries the document")
}

/// Another tab or program has saved the shown document.
pub fn renewed(path: &str) -> String {
    format!("{path} was changed elsewhere: it is shown as it is now")
}

/// What a tool is told to set a place by, and what a finger does instead.
pub const CLICK_OR_PRESS: &str = "click or press";
/// The same where one goes on.
pub const CLICK: &str = "click";
/// What a finger does.
pub const TOUCH: &str = "touch";

/// The palette's word for a thing of the document.
pub const SELECT_ONE: &str = "Select";
/// Where that is.
pub const PART_OF_THIS: &str = "in this document";

/// What a slider says of a count while it is moved.
pub fn count_to_be(path: &str, to: f64) -> String {
    format!("{path} = {to} once you let go")
}

/// The palette's words for the tool that places things of a class.
pub fn place_one(class: &str) -> String {
    format!("Place: {class}")
}

/// Of several selected things, the one that the inspector shows.
pub fn first_of_several(path: &str, class: &str) -> String {
    format!("the first: {path}, {class}")
}
/// The line of the status while it is counted how much is free.
pub const COUNTING: &str =
    "How much is free is being counted; until then it is as much as before. Why is it so?";
