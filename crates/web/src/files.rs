//! The host of the session in the page: texts that were fetched before they are asked for.
//!
//! A session asks at once and a browser fetches later: what is asked for and not there is noted, and
//! whoever shows the document fetches it and has it read again.

use leptos::prelude::*;
use presentation::files::FileSet;
use session::Host;

/// The page's host.
#[derive(Clone, Copy, Debug)]
pub struct Files(pub StoredValue<FileSet>);

impl Host for Files {
    fn read(&self, name: &str) -> Option<String> {
        self.read_beside("", name)
    }
    fn read_beside(&self, folder: &str, name: &str) -> Option<String> {
        self.0.try_update_value(|files| files.find(folder, name)).flatten()
    }
    fn libraries(&self) -> Vec<String> {
        self.0.try_with_value(|files| files.libraries.keys().cloned().collect()).unwrap_or_default()
    }
}
