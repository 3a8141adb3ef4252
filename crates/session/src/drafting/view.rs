//! What drafting shows: plain data.

use crate::view::{Change, Pointer};

/// A construction that can be chosen.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ConstructionRow {
    /// What it is begun by.
    pub id: String,
    /// The class of what it makes.
    pub class: String,
    /// `Circle that touches two curves`
    pub label: String,
    /// What it waits for: `first, second, radius`.
    pub operands: String,
    /// What the library says of it.
    pub doc: String,
    /// Other words by which it is found: those of textbooks.
    pub also: &'static str,
}

/// What is waited for: an operand of a construction, an answer, a condition.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Prompt {
    /// The construction; nothing where none waits.
    pub tool: String,
    /// Its name in words.
    pub label: String,
    /// What is wanted now, in one sentence.
    pub words: String,
    /// Its operands, those that are given with their text.
    pub operands: Vec<(String, Option<String>)>,
    /// Whether a value is wanted, so that what is picked is a measure.
    pub is_value: bool,
    /// The values that are allowed, each as it is typed, where they are few: of a table, the options of a choice, yes and no.
    pub choices: Vec<String>,
    /// Whether a pick may mean the turn of what is picked, or the whole loop.
    pub takes_sets: bool,
    /// Whether there is more that a pick may mean: what it is in, or the edge that comes from it.
    pub goes_wider: bool,
    /// Whether what is made is drawn for construction alone.
    pub is_guide: bool,
    /// What kind of answer is wanted.
    pub wants: Wants,
    /// What a pick adds to what is typed: `ring.radius`.
    pub insert: Option<String>,
}

impl Prompt {
    /// Whether it asks which object of the turn before is meant.
    pub fn asks_object(&self) -> bool {
        !self.is_value && matches!(self.wants, Wants::Recurrence(_))
    }

    /// What the object that is asked about was in the first turn; nothing where none is.
    pub(crate) fn of_turn_before(&self) -> &str {
        match &self.wants {
            Wants::Recurrence(question) => &question.first,
            _ => "",
        }
    }
}

/// What kind of answer a prompt wants.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum Wants {
    /// An operand of a construction.
    #[default]
    Operand,
    /// The same, or an object of the turn before.
    Recurrence(RecurrenceQuestion),
    /// What ends a loop.
    Ends(Ends),
    /// When the branch that is drawn next is taken.
    Condition,
    /// Another object for one that is deleted, or that what speaks of it goes, too.
    Substitute {
        /// The step that speaks of it.
        step: String,
        /// What goes.
        gone: String,
    },
    /// Another object or value for what a step says, which is this.
    Change(String),
    /// That the branch which is not taken is drawn: by the same values, or by others.
    Otherwise,
    /// Whether what was picked outside of the program is a parameter, or its construction is taken along.
    Older {
        /// What was picked, by its path from the document.
        path: String,
    },
}

/// What something that stands outside of a program is for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum OlderUse {
    /// A parameter of its class, which is given it in the example.
    Parameter,
    /// Steps of the program draw it, and what it is drawn by, anew.
    Along,
}

/// How a loop ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ends {
    /// After the turn in which a condition becomes true.
    Until,
    /// Before a turn for which a condition is not true.
    While,
    /// After so many turns.
    Times,
}

/// Where a visit goes.
#[derive(Clone, PartialEq, Debug)]
pub enum Go {
    /// Before the first step.
    Start,
    /// Past the step that comes next, blocks as a whole.
    Step,
    /// Back before the step that came last.
    Back,
    /// Into the block that comes next.
    In,
    /// Past the block that is visited.
    Out,
    /// Behind the last step: recording goes on there.
    End,
    /// Before a step, by its address.
    To(String),
    /// Before the step that drew what lies under a pointer, in the turn that drew it.
    UntilPicked(Pointer),
    /// Before the step that drew what has a name, in the turn that drew it: `column[2].ring`.
    UntilDrawn(String),
}

/// A measure that is taken by pointing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum MeasureKind {
    /// Of a circle or an arc.
    Radius,
    /// Of a line or an arc.
    Length,
    /// Between two of points, lines, circles.
    Distance,
    /// From a line to another, turning left.
    Angle,
    /// How far to the right a point lies.
    Across,
    /// How far up a point lies.
    Up,
    /// What a circle, contour or surface covers.
    Area,
}

/// What an expression of a calculator comes to now.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Computed {
    /// Its value in words; nothing where it has none yet.
    pub value: Option<String>,
    /// Why it has none.
    pub why: Option<String>,
}

/// What a pointer would do for a construction.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Hover {
    /// What it finds, and where that is.
    pub finds: Option<String>,
    /// What would be made, or is found.
    pub ghost: drawing::Drawing,
    /// Why nothing would be, where the last operand is wanted.
    pub why: Option<String>,
}

/// What comes of an operand or an answer.
#[derive(Clone, PartialEq, Debug)]
pub enum Turn {
    /// The next one is wanted.
    Wants(Prompt),
    /// It was the last one: the figure is made, the block is closed. Or a parameter became what is wanted of it, and
    /// further ones are.
    Made {
        /// What that did to the document.
        change: Box<Change>,
        /// What it is called; of a parameter what it is now.
        name: String,
        /// How it is written; empty where nothing was.
        text: String,
        /// What is waited for then: the same construction, begun anew, or the next answer.
        next: Option<Prompt>,
    },
}

/// The steps of a program.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct StepsView {
    /// The program.
    pub program: String,
    /// Its example in the document.
    pub example: String,
    /// Whether it is recorded now.
    pub is_recorded: bool,
    /// The blocks that are open in it, from the outermost.
    pub open: Vec<OpenBlock>,
    /// Where it is visited: the address of the step that comes next, or of the block at whose end one is; nothing where
    /// recording goes on at the end of the program.
    pub at: Option<String>,
    /// Whether it is visited by other values of its parameters than the example's own.
    pub by_others: bool,
    /// Its parameters: name and the example's value.
    pub parameters: Vec<ParameterRow>,
    /// Whether it has any step.
    pub has_steps: bool,
    /// Its steps, in order.
    pub rows: Vec<StepRow>,
    /// The address of the step that drew what is selected, if one did.
    pub selected: Option<String>,
}

/// A parameter of a program.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ParameterRow {
    /// Its name.
    pub name: String,
    /// What is asked.
    pub prompt: String,
    /// Its value in the example.
    pub value: String,
    /// Its class.
    pub class: String,
    /// The values that are allowed; nothing for all.
    pub range: String,
    /// The values of a table of those that are allowed; none where there is no such table.
    pub choices: Vec<String>,
    /// The value that its program gives it, as it is written.
    pub example: String,
}

/// A step of a program.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct StepRow {
    /// Its address, with the blocks around it: `column.ring`, `#0.else.line`.
    pub path: String,
    /// Its name; nothing for a block that has none.
    pub name: String,
    /// How many blocks are around it.
    pub depth: usize,
    /// What it does, in words.
    pub words: String,
    /// What it does, as it is written.
    pub formula: String,
    /// What it made, in words; nothing where it did not run.
    pub value: Option<String>,
    /// Whether it is drawn for construction alone.
    pub is_guide: bool,
    /// Whether steps stand in it.
    pub is_block: bool,
    /// Whether the example does not come to it.
    pub is_unmade: bool,
    /// What it made is doubtful for, as a width that is negative.
    pub doubt: Option<String>,
    /// Why it has no outcome, of the step at which the drawing of the example ended.
    pub why: Option<String>,
}

/// A part of what a step says that can be changed by itself.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct StepOperand {
    /// What it is called: `radius`, `first`, `until`, `next first`.
    pub slot: String,
    /// How it is written.
    pub says: String,
    /// What it comes to in the example, of numbers and of a yes or no.
    pub value: Option<String>,
    /// Where on the sheet it is shown, of a figure's numbers.
    pub at: Option<(f64, f64)>,
    /// From where to where it reaches there: a radius from the centre to the rim, a length from end to end.
    pub along: Option<[(f64, f64); 2]>,
}

/// What is asked of the second turn of a loop: the same, or which object of the turn before?
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct RecurrenceQuestion {
    /// Which question it is, from 1.
    pub number: usize,
    /// Of how many.
    pub of: usize,
    /// The step whose operand is meant.
    pub step: String,
    /// The operand.
    pub operand: String,
    /// What it is in the first turn.
    pub first: String,
    /// Whether it is a number or a yes or no.
    pub is_value: bool,
    /// What it is for each of the set in turn, where the loop is one over a set: the other answer.
    pub in_turn: Option<String>,
}

/// A block that is demonstrated.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct OpenBlock {
    /// Its address in the program.
    pub address: String,
    /// What it is, and what is drawn in it now.
    pub words: String,
    /// What it is.
    pub kind: OpenKind,
    /// Of a loop over a set what was caught, and whether it is in the set, as long as that may be changed.
    pub set: Vec<(String, bool)>,
}

/// What is open, and how far its demonstration has got.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum OpenKind {
    /// The first turn of a loop is drawn.
    #[default]
    Turn,
    /// The first turn of a loop over a set is drawn.
    Each,
    /// A loop whose first turn is drawn: it asks.
    Asking,
    /// The branch that is taken is drawn.
    Then,
    /// The other branch is drawn.
    Otherwise,
    /// A block that was closed, and is visited.
    Visited,
}

/// A parameter to be defined.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct NewParameter {
    /// Its name.
    pub name: String,
    /// Its value in the example, as it is typed: `40 mm`, `6`, `true`.
    pub example: String,
    /// What is asked of who applies the program; nothing for no words.
    pub prompt: String,
    /// Its class; nothing where the example tells.
    pub class: String,
    /// The values that are allowed, `1 mm..100 mm` or `3, 4, 5 mm`; nothing for all.
    pub range: String,
    /// The parameter that is said anew by this; nothing for another one.
    pub instead_of: String,
}

/// How a parameter that is being typed is understood.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ParameterReading {
    /// The class of its example, or the one that was chosen; nothing where there is no example yet.
    pub class: String,
    /// The example with its unit: `84 mm`.
    pub value: String,
    /// The values that are allowed, in words: `1 mm to 100 mm`.
    pub allowed: Option<String>,
    /// What is wrong, and in which field.
    pub wrong: Vec<(ParameterField, String)>,
}

/// A field of a parameter that is being typed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ParameterField {
    /// Its name.
    Name,
    /// Its example.
    Example,
    /// The values that are allowed.
    Allowed,
}
