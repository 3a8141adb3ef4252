//! What the page shows and does that needs no browser: what is painted of a picture and picked in it, which rows are in
//! sight, how numbers, sentences and paths are put, what is found by words, what drafts are kept.
//!
//! All of it is functions from a session's views to what is shown, and is tested on this machine; the room `web` above
//! it is compiled for the browser alone.
//!
//! Reading order: [`sheet`], [`paint`], [`pick`], [`band`], [`marks`]; [`rows`], [`palette`], [`shelves`]; then the
//! rest, each a page.
pub mod band;
pub mod chart;
pub mod course;
pub mod drafts;
pub mod files;
pub mod marks;
pub mod numbers;
pub mod orbit;
pub mod paint;
pub mod palette;
pub mod paths;
pub mod pick;
pub mod rows;
pub mod sentences;
pub mod sheet;
pub mod shelves;
pub mod table;
