//! THE API BOUNDARY: open documents, Commands in, Changes and views out.
//!
//! The lab's page and the command line see a document only through this room. A [`Command`]
//! (`kernel`) goes in; a [`Change`](view::Change) or a [`Refusal`](view::Refusal) comes back; the
//! views ([`view`]) are plain data, made anew when asked for, so that the session can live in a
//! worker. Between press and release of a drag nothing is written and nothing needs the network.
pub mod host;
pub mod view;

pub use host::Host;
pub use kernel::{Command, Literal, Path, Step};
