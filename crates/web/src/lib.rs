//! The page: a Leptos shell that shows the session's views and hands Commands back.
//!
//! There is no domain logic here. The [`lab`] owns the session and what is open in it, as signals;
//! the panels paint these and ask the lab for what a person does. What the browser's scripts do
//! better than Rust (the text editor, painting a frame, requests with the token) stands in
//! `assets/` and is reached through [`js`].
//!
//! **Invariants:** between press and release of a drag nothing is written and nothing is asked of
//! the server; every change is a Command and can be taken back; what is not saved is kept in the
//! browser's storage, outside the bundle's memory.
//!
//! Reading order: [`page`], [`lab`], [`actions`]; the panels [`picture`] (with [`presentation`]),
//! [`structure`], [`values`], [`text`], [`status`], [`gallery`]; then what they stand on.
pub mod actions;
pub mod annotated;
pub mod apart;
pub mod bench;
pub mod bin_panel;
pub mod by_example;
pub mod calculator;
pub mod class_pane;
pub mod dialog;
pub mod dock;
pub mod drafting;
pub mod family;
pub mod field;
pub mod files;
pub mod first;
pub mod gallery;
pub mod history;
pub mod icons;
pub mod inspector;
pub mod js;
pub mod keyboard;
pub mod lab;
pub mod lesson;
pub mod marked;
pub mod menu;
pub mod page;
pub mod palette;
pub mod picture;
pub mod player;
pub mod plot;
pub mod printed;
pub mod probe;
pub mod rail;
pub mod rehearsal;
pub mod route;
pub mod server;
pub mod splitter;
pub mod status;
pub mod strip;
pub mod structure;
pub mod text;
pub mod theme;
pub mod values;
pub mod why;
pub mod words;
pub mod worker;

use presentation::{orbit, paint, sheet};

/// Puts the page into the document's body; called once, when the bundle has loaded. In the worker there is none.
pub fn start() {
    if js::is_worker() {
        console_error_panic_hook::set_once();
        worker::start();
        return;
    }
    std::panic::set_hook(Box::new(|info| {
        console_error_panic_hook::hook(info);
        js::show_crash(words::CRASH, words::CRASH_ADVICE, words::RELOAD, &info.to_string());
    }));
    leptos::mount::mount_to_body(page::Page);
}
