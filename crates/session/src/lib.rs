//! THE API BOUNDARY: open documents, Commands in, Changes and views out.
//!
//! The lab's page and the command line see a document only through this room. A [`Command`]
//! (`kernel`) goes in; a [`Change`](view::Change) or a [`Refusal`](view::Refusal) comes back; the
//! views ([`view`]) are plain data, made anew when asked for, so that the session can live in a
//! worker. Between press and release of a drag nothing is written and nothing needs the network.
//!
//! **Invariants**: a document's state is made from its text alone; a refused command changes no bit;
//! undo and redo bring back states, bit for bit.
//!
//! Reading order: [`session`](Session), `document`, `state`, `apply`, `drag`, `write_back`,
//! `complaints`, `check`, `views`, [`view`], `host`.
mod handles;
mod host;
pub mod view;

mod advice;
mod angles;
mod annotations;
mod apply;
mod by_hand;
mod calculator;
mod check;
mod classing;
mod complaints;
mod completing;
mod difference;
mod document;
mod doubts;
pub mod drafting;
mod drag;
mod expected;
mod families;
mod fixes;
mod following;
mod foreseeing;
mod general;
mod ghosts;
mod given_twice;
mod grasp;
mod instances;
pub mod jobs;
mod joining;
mod kinds;
mod lessons;
mod limits;
mod mentioning;
mod offers;
mod opening;
mod outlines;
mod over_constants;
mod parting;
mod placing;
pub mod plain;
pub mod plotting;
mod prototype;
mod recognise;
mod rehearsal;
pub mod remote;
mod rounding;
mod rules;
mod session;
mod sheet;
mod shown;
mod state;
mod templates;
mod texts;
mod tools;
mod turning;
mod unlike;
mod views;
pub mod vocabulary;
mod ways_out;
mod words;
mod write_back;
mod yielding;

pub use families::file_names;
pub use host::{Host, used_as};
pub use kernel::{Command, Literal, Path, Step};
pub use lang::is_unit_of_sheet;
pub use lang::tables::is_name as is_table_name;
pub use opening::Opening;
pub use rounding::ROUNDING;
pub use rules::rule_in_words;
pub use session::{Session, format, misspelled, parse_path};
pub use state::{MORE, Untold};
pub use tools::copies::{Clip, Relations};
pub use view::DocumentId;
pub use views::analysis::MOST_MOTIONS;
pub use views::listing::{Listing, decimal_shift};
pub use views::picture::{readable, roomy, svg_at};
pub use views::status::GAVE_WAY;
