//! The page's room below the browser: what is painted of a picture and picked in it, which rows are in sight, how
//! numbers, sentences and paths are put, what is found by words and read of keys, what drafts are kept, how files become one.
//!
//! Its nouns: a [`sheet::View`] is where the sheet lies on the screen; a [`paint::DisplayList`] is what is painted;
//! [`marks::Marked`] is what is selected or under the pointer; a [`rows::Shown`] is a row that no shut row hides; a
//! [`palette::Choice`] is what words find; a [`drafts::Draft`] is an unsaved text.
//!
//! No function here asks a session for anything: each goes from views that it is given to what is shown. So all are
//! tested on this machine. The room `web` above is usually compiled for the browser alone; with `--no-browser`,
//! `--long` or Debian's compiler `cargo verify` lints it with the other rooms.
//!
//! Reading order: [`sheet`], [`paint`], [`pick`], [`band`], [`marks`]; [`rows`], [`palette`], [`shelves`]; then the
//! rest, each a page.
pub mod annotations;
pub mod archive;
pub mod band;
pub mod chart;
pub mod course;
pub mod drafts;
pub mod files;
pub mod find;
pub mod marks;
pub mod numbers;
pub mod orbit;
pub mod paint;
pub mod palette;
pub mod paths;
pub mod pick;
pub mod recent;
pub mod rows;
pub mod sentences;
pub mod sheet;
pub mod shelves;
pub mod table;
pub mod typing;
