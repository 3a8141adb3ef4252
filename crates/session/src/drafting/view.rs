//! What drafting shows: plain data.

use crate::view::Change;

/// A construction that can be chosen.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ConstructionRow {
    /// What it is begun by.
    pub id: String,
    /// The class of what it makes.
    pub class: String,
    /// `circle tangent`
    pub label: String,
    /// What it waits for: `first, second, radius`.
    pub operands: String,
    /// What the library says of it.
    pub doc: String,
}

/// What a construction waits for.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Prompt {
    /// The construction.
    pub tool: String,
    /// Its name in words.
    pub label: String,
    /// What is wanted now, in one sentence.
    pub words: String,
    /// Its operands, those that are given with their text.
    pub operands: Vec<(String, Option<String>)>,
    /// Whether a value is wanted, so that what is picked is a measure.
    pub is_value: bool,
    /// What a pick adds to what is typed: `ring.radius`.
    pub insert: Option<String>,
}

/// What a pointer would do for a construction.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Hover {
    /// What it finds, and where that is.
    pub finds: Option<String>,
    /// What would be made.
    pub ghost: drawing::Drawing,
    /// Why nothing would be, where the last operand is wanted.
    pub why: Option<String>,
}

/// What comes of an operand.
#[derive(Clone, PartialEq, Debug)]
pub enum Turn {
    /// The next one is wanted.
    Wants(Prompt),
    /// It was the last one: the figure is made.
    Made {
        /// What that did to the document.
        change: Box<Change>,
        /// What it is called.
        name: String,
        /// How it is written.
        text: String,
        /// The prompt of the same construction, begun anew.
        next: Prompt,
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
    /// The loop that is open in it.
    pub open_loop: Option<LoopView>,
    /// Its parameters: name and the example's value.
    pub parameters: Vec<ParameterRow>,
    /// Its steps, in order.
    pub rows: Vec<StepRow>,
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
}

/// A step of a program.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct StepRow {
    /// Its name, with those of the blocks around it: `column.ring`.
    pub path: String,
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
}

/// A loop that is demonstrated.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LoopView {
    /// Its step.
    pub name: String,
    /// Whether its first turn is drawn.
    pub is_drawn: bool,
    /// What is asked of the second turn.
    pub question: Option<RecurrenceQuestion>,
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
}
