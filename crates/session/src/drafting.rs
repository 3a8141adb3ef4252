//! Drafting: constructions chosen, then given their operands, one by one; and programs recorded so.
//!
//! In: a construction's name, where the pointer is, what is typed. Out: a [`view::Prompt`] for the next operand,
//! a ghost of what would be made, and at last one edit of the text. The home of what is made is the document,
//! or the program that is recorded; that is seen by its example, a thing of the document.
//!
//! Nothing is known of any construction: `catalogue` finds them in the classes in scope, `outcome` tries
//! them in a copy of the text. So a construction that a library gains is a tool at once.
//!
//! Reading order: `catalogue`, `scene`, `typed`, `outcome`, `hands`, `recording`, `repeat`, `steps`, `text`.
mod catalogue;
mod hands;
mod outcome;
mod recording;
mod repeat;
mod scene;
mod steps;
mod text;
mod typed;
pub mod view;

use crate::host::Host;
use crate::state::State;
use crate::view::{Pointer, Refusal};
use crate::words;
use base::Name;
use catalogue::{Slot, SlotKind, Tool};
use kernel::Path;
use scene::Found;
use view::{Hover, Prompt};

/// Where what is drawn is written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Home {
    /// In the document.
    Document,
    /// As a step of a program, seen by an example of it.
    Program {
        /// The program.
        program: Name,
        /// The thing of the document that shows it.
        example: Name,
        /// The loop whose first turn is drawn, if any.
        block: Option<Name>,
    },
}

/// A program that is recorded.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Recording {
    /// The program.
    pub(crate) program: Name,
    /// Its example.
    pub(crate) example: Name,
    /// The loop that is open in it.
    pub(crate) block: Option<repeat::Loop>,
}

impl Home {
    /// The path from the document to where names are read.
    fn path(&self) -> Path {
        match self {
            Self::Document => Path::default(),
            Self::Program { example, block: None, .. } => Path::of(&[example]),
            Self::Program { example, block: Some(block), .. } => {
                Path::of(&[example, block]).then(kernel::Step::Index(0))
            }
        }
    }

    /// Where what is drawn goes while something is recorded, or nothing is.
    pub(crate) fn of(recording: Option<&Recording>) -> Self {
        match recording {
            Some(recording) => Self::Program {
                program: recording.program.clone(),
                example: recording.example.clone(),
                block: recording.block.as_ref().map(|block| block.name.clone()),
            },
            None => Self::Document,
        }
    }
}

/// An operand as it is given.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Operand {
    /// How it is written.
    pub(crate) text: String,
    /// Where it was picked.
    pub(crate) at: Option<(f64, f64)>,
}

/// A construction that waits for operands.
#[derive(Clone, Debug)]
pub(crate) struct Dialogue {
    pub(crate) tool: Tool,
    /// Those that are given.
    pub(crate) filled: Vec<Operand>,
    /// Whether what is made is drawn for construction alone.
    pub(crate) is_guide: bool,
    /// Where the pointer was last.
    pub(crate) pointer: Option<(f64, f64)>,
    /// The point that was given last, to which `@dx,dy` and `length<angle` go.
    pub(crate) last_point: Option<String>,
}

impl Dialogue {
    pub(crate) fn new(tool: Tool) -> Self {
        Self { tool, filled: Vec::new(), is_guide: false, pointer: None, last_point: None }
    }

    /// The slot that waits.
    pub(crate) fn slot(&self) -> Option<&Slot> {
        self.tool.slots.get(self.filled.len())
    }

    /// What it says.
    pub(crate) fn prompt(&self) -> Prompt {
        let slot = self.slot();
        let words = slot.map_or_else(String::new, |slot| {
            let wanted = match slot.kind {
                SlotKind::Point => {
                    "pick a point, or type `x,y`, `@dx,dy`, `length<angle`".to_string()
                }
                SlotKind::Curve => format!("pick a {}", slot.class.to_lowercase()),
                SlotKind::Value => "type a value, or pick what has it".to_string(),
            };
            format!("{}, {}: {wanted}", self.tool.label, slot.name)
        });
        let given = |i: usize| self.filled.get(i).map(|operand| operand.text.clone());
        let operands = self.tool.slots.iter().enumerate();
        Prompt {
            tool: self.tool.id.clone(),
            label: self.tool.label.clone(),
            words,
            operands: operands.map(|(i, slot)| (slot.name.clone(), given(i))).collect(),
            is_value: slot.is_some_and(|slot| slot.kind == SlotKind::Value),
            insert: None,
        }
    }

    /// What a pointer finds for the slot that waits.
    ///
    /// # Errors
    /// Nothing that fits; what lies there and cannot be picked is named.
    pub(crate) fn pick(
        &self,
        state: &State,
        home: &Home,
        pointer: &Pointer,
    ) -> Result<Operand, Refusal> {
        let Some(slot) = self.slot() else {
            return Err(words::refuse("no operand is wanted".into()));
        };
        let found = scene::scene(state, home);
        if let Some(found) = nearest(state, slot, &found, pointer) {
            let text = match slot.kind {
                SlotKind::Value => measure(state, found)
                    .ok_or_else(|| words::refuse(format!("{} has no measure", found.text)))?,
                SlotKind::Point | SlotKind::Curve => found.text.clone(),
            };
            return Ok(Operand { text, at: Some(pointer.at) });
        }
        if slot.kind == SlotKind::Point {
            return Ok(Operand { text: typed::place(pointer.at), at: Some(pointer.at) });
        }
        let outside = match home {
            Home::Document => None,
            Home::Program { example, .. } => {
                let all = scene::scene(state, &Home::Document);
                let is_outside = |f: &Found| !f.text.starts_with(example.as_str());
                let all: Vec<Found> = all.into_iter().filter(is_outside).collect();
                nearest(state, slot, &all, pointer).map(|f| f.text.clone())
            }
        };
        Err(words::refuse(match outside {
            Some(text) => format!("{text} is outside of the program that is recorded"),
            None => format!("there is no {} here", slot.class.to_lowercase()),
        }))
    }

    /// What a pointer, with what is typed so far, would do.
    pub(crate) fn hover(
        &self,
        state: &State,
        host: &dyn Host,
        home: &Home,
        (pointer, typed): (&Pointer, &str),
    ) -> Hover {
        let Some(slot) = self.slot() else { return Hover::default() };
        let operand = match typed.trim().is_empty() {
            true => self.pick(state, home, pointer),
            false => typed::operand(slot, typed, self.last_point.as_deref())
                .map(|text| Operand { text, at: None }),
        };
        let operand = match operand {
            Ok(operand) => operand,
            Err(refusal) => return Hover { why: Some(refusal.message), ..Hover::default() },
        };
        let finds = Some(operand.text.clone());
        if self.filled.len() + 1 < self.tool.slots.len() {
            return Hover { finds, ..Hover::default() };
        }
        let mut operands = self.filled.clone();
        operands.push(operand);
        match outcome::choose(state, host, home, (&self.tool, &operands, Some(pointer.at))) {
            Ok(chosen) => Hover { finds, ghost: chosen.drawing, why: None },
            Err(refusal) => Hover { finds, why: Some(refusal.message), ..Hover::default() },
        }
    }
}

/// Returns the nearest figure that fits a slot, a point before what runs through it.
fn nearest<'f>(
    state: &State,
    slot: &Slot,
    all: &'f [Found],
    pointer: &Pointer,
) -> Option<&'f Found> {
    let document = &state.lowered.document;
    let wanted = document.class_named(&slot.class);
    let fits = |f: &&Found| match slot.kind {
        SlotKind::Value => measure(state, f).is_some(),
        SlotKind::Point | SlotKind::Curve => wanted.is_some_and(|w| document.is_a(f.class, w)),
    };
    let near = all.iter().filter(fits).map(|f| (f.curve.distance(pointer.at), f));
    let near = near.filter(|(far, _)| *far <= pointer.reach);
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, f)| f)
}

/// Returns the name of the nearest curve under a pointer.
pub(crate) fn object_at(state: &State, home: &Home, pointer: &Pointer) -> Option<String> {
    let found = scene::scene(state, home);
    let near = found.iter().filter(|f| !f.curve.is_point());
    let near = near.map(|f| (f.curve.distance(pointer.at), f)).filter(|(d, _)| *d <= pointer.reach);
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, f)| f.text.clone())
}

/// Returns the measure that a figure has: a circle's radius, a line's length.
fn measure(state: &State, found: &Found) -> Option<String> {
    let document = &state.lowered.document;
    let is_of = |name: &str| {
        document.class_named(name).is_some_and(|class| document.is_a(found.class, class))
    };
    match () {
        () if is_of("Circle") || is_of("Arc") => Some(format!("{}.radius", found.text)),
        () if is_of("Line") => Some(format!("{}.length", found.text)),
        () => None,
    }
}
