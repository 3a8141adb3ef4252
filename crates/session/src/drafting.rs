//! Drafting: constructions chosen, then given their operands, one by one; and programs recorded so.
//!
//! In: a construction's name, where the pointer is, what is typed. Out: a [`view::Prompt`] for the next operand,
//! a ghost of what would be made, and at last one edit of the text. The home of what is made is the document,
//! or the program that is recorded; that is seen by its example, a thing of the document.
//!
//! Nothing is known of any construction: `catalogue` finds them in the classes in scope, `outcome` tries
//! them in a copy of the text. So a construction that a library gains is a tool at once.
//!
//! Reading order: `catalogue`, `synonyms`, `compound`, `scene`, `edges`, `typed`, `outcome`, `crossing`, `dialogue`,
//! `older`, `hands`, `recording`, `reading`, `parameters`, `becoming`, `blocks`, `operands`, `patterns`, `repeat`,
//! `choice`, `own_values`, `demonstrating`, `measure`, `steps`, `visit`, `remove`, `erase`, `changing`, `visiting`,
//! `text`.

mod becoming;
mod blocks;
mod catalogue;
mod changing;
mod choice;
pub(crate) mod compound;
mod crossing;
mod demonstrating;
mod dialogue;
mod edges;
mod erase;
mod hands;
mod measure;
mod older;
mod operands;
mod outcome;
mod own_values;
mod parameters;
mod patterns;
mod reading;
mod recording;
mod remove;
mod repeat;
pub(crate) mod scene;
mod steps;
mod synonyms;
mod text;
mod typed;
pub mod view;
mod visit;
mod visiting;

pub(crate) use blocks::settle;
pub(crate) use catalogue::serving;
pub(crate) use dialogue::Dialogue;
pub(crate) use recording::{retext, span_recorded};
pub(crate) use repeat::Tried;
pub(crate) use visit::keep_own;

use base::Name;
use kernel::Path;

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
        /// The blocks around it, from the outermost.
        way: Vec<Around>,
        /// The step of the innermost block that comes next; none at its end.
        before: Option<String>,
    },
}

/// A block around what is drawn.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Around {
    /// Its part of an address: `column`, `#0.then`.
    pub(crate) address: String,
    /// What it is called; nothing where what it makes is made where it stands.
    pub(crate) name: Option<Name>,
    /// The turn that is shown, of a loop.
    pub(crate) turn: Option<u32>,
}

impl Around {
    /// The segment of the block itself, without its branch.
    pub(crate) fn segment(&self) -> &str {
        self.address.split('.').next().unwrap_or_default()
    }
}

/// A program that is recorded.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Recording {
    /// The program.
    pub(crate) program: Name,
    /// Its example.
    pub(crate) example: Name,
    /// The blocks that are open in it, from the outermost.
    pub(crate) blocks: Vec<blocks::Block>,
    /// The step of the innermost block before which is drawn; none at its end.
    pub(crate) before: Option<String>,
    /// Whether the condition of an `if` is asked for.
    pub(crate) asks_condition: bool,
    /// The step that what is drawn next takes the place of, by its address.
    pub(crate) replaces: Option<String>,
    /// Where one was before a step was to be replaced, and is afterwards: the open blocks, the step before which is drawn.
    pub(crate) returns: Option<(Vec<blocks::Block>, Option<String>)>,
    /// The deletion whose dependents are asked about.
    pub(crate) removing: Option<remove::Removing>,
    /// What of a step is changed.
    pub(crate) changing: Option<changing::Changing>,
}

impl Home {
    /// The path from the document to where names are read.
    pub(crate) fn path(&self) -> Path {
        let Self::Program { example, way, .. } = self else { return Path::default() };
        let mut path = Path::of(&[example]);
        for around in way {
            if let Some(name) = &around.name {
                path = path.then(kernel::Step::Part(name.clone()));
            }
            if let Some(turn) = around.turn {
                path = path.then(kernel::Step::Index(turn));
            }
        }
        path
    }

    /// What is known before the innermost block around it.
    pub(crate) fn before_block(mut self) -> Self {
        if let Self::Program { way, before, .. } = &mut self
            && let Some(around) = way.pop()
        {
            *before = Some(around.address);
        }
        self
    }

    /// Where what is drawn goes while something is recorded, or nothing is.
    pub(crate) fn of(recording: Option<&Recording>) -> Self {
        match recording {
            Some(recording) => Self::Program {
                program: recording.program.clone(),
                example: recording.example.clone(),
                way: recording.blocks.iter().map(|block| block.around.clone()).collect(),
                before: recording.before.clone(),
            },
            None => Self::Document,
        }
    }
}

/// How the hand picks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Picking {
    /// How often a wider pick was asked for: the entity, its turn, the whole set.
    pub(crate) level: usize,
    /// The measure that is taken.
    pub(crate) measure: Option<measure::Measuring>,
    /// What was picked outside of the program, and is asked about.
    pub(crate) older: Option<older::Older>,
}
