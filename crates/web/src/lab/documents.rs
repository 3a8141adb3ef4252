//! Documents: loading, showing, saving, and what is kept of them in the browser.

use super::{ABSENT, Lab, Opened, Zoom};
use crate::dialog::Wish;
use crate::lab::Notice;
use crate::server::{self, Saved, Stored};
use crate::{js, route, theme, words};
use leptos::prelude::*;
use presentation::drafts::place_of;
use presentation::files::FileSet;
use presentation::palette::Listed;
use presentation::paths::usable;
use presentation::recent;
use session::view::{BinEntry, DocumentId};
use session::{Command, Session, used_as};
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

/// What a new document is called before it is saved.
const UNTITLED: &str = "untitled";

/// A document is opened for so many milliseconds before the page has its turn.
const A_WHILE: f64 = 12.0;
/// How far it is, is shown again after so many.
const BETWEEN_SIGHTS: f64 = 100.0;

/// A text with more bytes takes long to open.
const LONG: usize = 200_000;

/// Under which name the browser keeps what was shown last.
const RECENT: &str = "thinglab/recent";

/// What stands in a new document.
const NEW_TEXT: &str = "use geometry\n";

/// Tells of a document whether this browser keeps unsaved changes of it, from an earlier visit or of another tab.
fn kept_drafts() -> impl Fn(&str) -> bool {
    let begun: Vec<String> = theme::names();
    move |path| begun.iter().any(|n| place_of(n).is_some_and(|(_, of)| of == path))
}

impl Lab {
    /// Fetches the library once; returns whether it came. Without it documents open with diagnostics.
    pub async fn fetch_library(self) -> bool {
        let library = match server::library().await {
            Ok(library) => library,
            Err(message) => {
                let is_link = route::shared().is_some();
                self.say_refused(if is_link { words::then_link(&message) } else { message });
                return false;
            }
        };
        self.files.update_value(|files| {
            let named = |(file, text): (String, String)| Some((used_as(&file, "")?, text));
            files.libraries = library.into_iter().filter_map(named).collect();
        });
        true
    }

    /// Asks the server what documents there are.
    ///
    /// # Errors
    /// One sentence, where it does not say.
    pub async fn fetch_list(self) -> Result<Vec<Listed>, String> {
        let listed = server::documents().await?;
        self.listed.set(listed.clone());
        Ok(listed)
    }

    /// Opens a document in the session, if it is not open already, and returns it.
    ///
    /// # Errors
    /// One sentence, where the server does not give it or its opening was given up.
    pub async fn load(self, path: &str) -> Result<Opened, String> {
        if let Some(opened) = self.open_already(path).await {
            return Ok(opened);
        }
        let stored = stands(path).await?;
        self.take_up(path, stored).await
    }

    /// The same for a card of the gallery, as long as somebody looks at it; nothing where that takes long.
    pub async fn load_for_card(self, path: &str, is_seen: impl Fn() -> bool) -> Option<Opened> {
        if let Some(opened) = self.open_already(path).await {
            return Some(opened);
        }
        let stored = stands(path).await.ok()?;
        let is_short = stored.text.len() <= LONG;
        if is_short { self.take_up_while(path, stored, is_seen).await.ok() } else { None }
    }

    /// Opens what is kept of a document that no file has, for a card of the gallery, as long as somebody looks at it;
    /// nothing where that takes long.
    pub async fn load_kept_for_card(
        self,
        path: &str,
        is_seen: impl Fn() -> bool,
    ) -> Option<DocumentId> {
        if let Some(opened) = self.opened.with_value(|all| all.get(path).cloned()) {
            return Some(opened.id);
        }
        let text = self.latest_draft(path).await.filter(|text| text.len() <= LONG)?;
        // nothing uses it by this name, and it is no document that is open
        let name = format!("{path}?");
        let mut id = self.open(&name, &text, &is_seen).await.ok()?;
        while self.fetch_used().await {
            id = self.open(&name, &text, &is_seen).await.ok()?;
        }
        Some(id)
    }

    async fn open_already(self, path: &str) -> Option<Opened> {
        let opened = self.opened.with_value(|all| all.get(path).cloned())?;
        let is_latest =
            opened.dirty || stands(path).await.is_ok_and(|s| s.version == opened.version);
        is_latest.then_some(opened)
    }

    /// Gives up what is long to open and not open yet; the address names what is shown.
    pub fn give_openings_up(self) {
        self.given_up.update_value(|times| *times += 1);
        self.opening.set(None);
        // it may be opened again, though the task that opens it has not ended yet
        self.coming.update_value(|(_, coming)| *coming = None);
        let shown = self.current.get_untracked();
        if route::present() != shown {
            let address =
                shown.map_or_else(|| String::from(route::GALLERY), |path| route::to(&path));
            route::replace(&address);
        }
    }

    /// Opens a text in the session under a path, with the files that it uses. Of a long one the page shows how far it
    /// is, and it can be given up.
    pub(super) async fn take_up(self, path: &str, stored: Stored) -> Result<Opened, String> {
        let given_up = self.given_up.get_value();
        let is_long = stored.text.len() > LONG;
        let goes_on = move || !is_long || self.given_up.get_value() == given_up;
        let opened = self.take_up_while(path, stored, goes_on).await;
        // what was given up is shown no more: another one may be
        if is_long && goes_on() {
            self.opening.set(None);
        }
        opened
    }

    async fn take_up_while(
        self,
        path: &str,
        stored: Stored,
        goes_on: impl Fn() -> bool,
    ) -> Result<Opened, String> {
        let mut id = self.open(path, &stored.text, &goes_on).await?;
        while self.fetch_used().await {
            id = self.open(path, &stored.text, &goes_on).await?;
        }
        let title = self.session.with_value(|session| session.title(id));
        let opened = Opened {
            id,
            title,
            version: stored.version,
            writable: stored.writable,
            saved: stored.text,
            dirty: false,
        };
        self.opened.update_value(|all| {
            all.insert(String::from(path), opened.clone());
        });
        Ok(opened)
    }

    /// Opens a text stage by stage; the page has its turn between, and it may be given up there.
    async fn open(
        self,
        path: &str,
        text: &str,
        goes_on: &impl Fn() -> bool,
    ) -> Result<DocumentId, String> {
        let is_long = text.len() > LONG;
        let mut opening = self.ask(|session| session.begin_opening(path, text));
        let mut shown = f64::NEG_INFINITY;
        while !opening.is_over() {
            if is_long && js::now() - shown > BETWEEN_SIGHTS {
                self.opening.set(Some(opening.done()));
                js::painted().await;
                shown = js::now();
            }
            if !goes_on() {
                return Err(String::from(words::OPENING_GIVEN_UP));
            }
            let until = js::now() + A_WHILE;
            while !opening.is_over() && js::now() < until {
                opening = self.ask(|session| session.go_on_opening(opening));
            }
            js::pause().await;
        }
        Ok(self.order(|session| session.end_opening(opening)))
    }

    /// Fetches the files that documents were found to use; returns whether there are new ones.
    pub(super) async fn fetch_used(self) -> bool {
        let wanted = self.files.try_update_value(|f| std::mem::take(&mut f.wanted));
        let mut found = false;
        for path in wanted.unwrap_or_default() {
            if presentation::files::is_table(&path) {
                // one that cannot be read now is asked for again
                found |= self.table(&path).await.is_ok_and(|table| table.is_some());
                continue;
            }
            // a server that does not answer is asked again
            if let Ok(stored) = server::document(&path).await {
                let text = stored.map(|stored| stored.text);
                found |= text.is_some();
                self.files.update_value(|files| {
                    files.texts.insert(path, text);
                });
            }
        }
        found
    }

    /// Fetches a table as it is now; nothing where there is none.
    ///
    /// # Errors
    /// One sentence, where the server does not say.
    pub async fn table(self, path: &str) -> Result<Option<String>, String> {
        let table = server::table(path).await?;
        self.files.update_value(|files| {
            files.texts.insert(String::from(path), table.clone());
        });
        Ok(table)
    }

    /// Asks again for the tables that the shown document uses, and reads what is shown with those that have changed: a
    /// spreadsheet may have saved one meanwhile. While the server is away, what was read stays.
    pub fn renew_tables(self) {
        let Some(shown) = self.current.get_untracked() else { return };
        let folder =
            shown.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
        let names = self.ask_of_shown(Session::tables).unwrap_or_default();
        if names.is_empty() {
            return;
        }
        self.renewals.update_value(|times| *times += 1);
        let time = self.renewals.get_value();
        leptos::task::spawn_local(async move {
            self.dragged().await;
            let mut found = Vec::new();
            for path in names.iter().map(|name| format!("{folder}{name}")) {
                if let Ok(table) = server::table(&path).await {
                    found.push((path, table));
                }
            }
            // a drag goes on with what it began with
            self.dragged().await;
            // what was asked for before something else may come after it, and is older
            if self.renewals.get_value() != time {
                return;
            }
            let is_new = |(path, table): &(String, Option<String>)| {
                self.files.with_value(|files| files.texts.get(path) != Some(table))
            };
            let are_new = found.iter().any(is_new);
            self.files.update_value(|files| files.texts.extend(found));
            if self.current.with_untracked(Option::is_none) {
                return;
            }
            // whatever is shown by now may use them, and some may have come on another way
            self.flush_text();
            let is_read_again = self.tell(Session::catch_up).flatten().is_some();
            if is_read_again {
                self.refresh();
                self.fetch_missing();
            }
            // families read them besides
            if is_read_again || are_new {
                self.tables.update(|times| *times += 1);
            }
        });
    }

    /// Takes up what another tab or program has saved of the shown document, as one step, where nothing is unsaved here.
    pub fn renew_document(self) {
        let clean = move || {
            let is_dirty = self.document.with_untracked(|d| d.as_ref().is_none_or(|d| d.dirty));
            (!is_dirty && !self.is_at_work()).then(|| self.current.get_untracked()).flatten()
        };
        self.flush_text();
        let Some(path) = clean() else { return };
        let known = move || self.document.with_untracked(|d| d.as_ref().map(|d| d.version.clone()));
        let before = known();
        leptos::task::spawn_local(async move {
            let Ok(Some(theirs)) = server::document(&path).await else { return };
            self.flush_text();
            // what was saved here meanwhile is newer than what came
            let is_newer = before.as_ref() != Some(&theirs.version) && known() == before;
            if clean().as_ref() == Some(&path) && is_newer {
                self.conflict.set(Some(Some(theirs)));
                self.take_theirs();
                self.notice.set(Some(Notice::Said(words::renewed(&path))));
            }
        });
    }

    /// Whether something is in the hand or half typed, which another text would take away.
    fn is_at_work(self) -> bool {
        self.dragging.with_untracked(Option::is_some)
            || self.tool.with_untracked(Option::is_some)
            || self.editing.with_untracked(Option::is_some)
            || self.wish.with_untracked(Option::is_some)
            || self.prototype.with_untracked(Option::is_some)
            || self.attachers.with_untracked(Option::is_some)
            || self.drafts()
            // a value of the inspector or the table that is not given yet
            || document().query_selector(".field.typing").is_ok_and(|field| field.is_some())
    }

    /// Waits until nothing is dragged.
    async fn dragged(self) {
        while self.dragging.with_untracked(Option::is_some) {
            js::painted().await;
        }
    }

    /// Forgets which tables were not there: by now they may be.
    pub fn forget_missing_tables(self) {
        self.files.update_value(FileSet::forget_missing_tables);
    }

    /// Fetches a table that was just named beside the shown document, and does something once it is there.
    pub fn fetch_table(self, then: impl FnOnce() + 'static) {
        if self.files.with_value(|files| files.wanted.is_empty()) {
            return;
        }
        leptos::task::spawn_local(async move {
            if self.fetch_used().await {
                then();
            }
        });
    }

    /// Fetches what the shown document was found to use just now, and reads it with that.
    pub(super) fn fetch_missing(self) {
        let Some(path) = self.current.get_untracked() else { return };
        if self.files.with_value(|files| files.wanted.is_empty()) {
            return;
        }
        leptos::task::spawn_local(async move {
            let found = self.fetch_used().await;
            if found && self.current.get_untracked().is_some_and(|shown| shown == path) {
                self.tell(Session::catch_up);
                self.refresh();
                self.fetch_missing();
            }
        });
    }

    /// Has the shown document use another one, named as `use` names it.
    pub fn use_document(self, name: String) {
        let Some(id) = self.id() else { return };
        leptos::task::spawn_local(async move {
            // what was not there before may be there now
            self.files.update_value(|files| files.texts.retain(|_, text| text.is_some()));
            // its path is wanted once it was looked for
            self.ask(|session| session.using(id, &name));
            self.fetch_used().await;
            if self.id() == Some(id) {
                self.use_library(&name);
            }
        });
    }

    /// What lies in the folder of the shown document, named as `use` names it.
    pub fn beside(self) -> Vec<String> {
        let Some(shown) = self.current.get() else { return Vec::new() };
        let libraries = self.libraries();
        let named =
            |one: &Listed| usable(&one.path, &shown).filter(|name| !libraries.contains(name));
        self.listed.with(|all| all.iter().filter_map(named).collect())
    }

    /// Notes what a file holds now, for those that use it.
    pub(super) fn note_saved(self, path: &str, text: &str) {
        self.files.update_value(|files| {
            files.texts.insert(String::from(path), Some(String::from(text)));
        });
    }

    /// Shows a document that is loaded.
    pub fn show(self, path: &str) {
        self.flush_text();
        self.leave_class();
        let Some(opened) = self.opened.with_value(|all| all.get(path).cloned()) else { return };
        self.drop_tool();
        self.editing.set(None);
        self.select(None);
        self.hovered.set(None);
        self.motion.set(Vec::new());
        self.ghosts.set(Vec::new());
        self.seen_before.set_value(None);
        self.plotting.clear();
        self.sums.set(Vec::new());
        self.notice.set(None);
        self.conflict.set(None);
        self.order(|session| session.catch_up(opened.id));
        note_shown(path);
        self.current.set(Some(String::from(path)));
        self.document.set(Some(opened));
        self.renew_drafting();
        self.offer_draft(path);
        self.show_views();
        self.meet_lesson(path);
        self.zoom.set(Some(Zoom::Fit));
        self.renew_tables();
    }

    /// The paths of what this browser showed last, of those that a list has or that are not saved anywhere yet.
    pub fn recent(self, listed: &[Listed]) -> Vec<String> {
        let kept = theme::keep(RECENT).unwrap_or_default();
        let has_draft = kept_drafts();
        recent::offered(&kept, |path| listed.iter().any(|one| one.path == path) || has_draft(path))
    }

    /// Shows the gallery.
    pub fn leave(self) {
        self.flush_text();
        self.leave_class();
        self.drop_tool();
        self.arriving.set(false);
        self.current.set(None);
        self.document.set(None);
        self.renew_drafting();
    }

    /// The names of the libraries.
    pub fn libraries(self) -> Vec<String> {
        self.files.with_value(|files| files.libraries.keys().cloned().collect())
    }

    /// The libraries that the shown document does not use yet.
    pub fn unused_libraries(self) -> Vec<String> {
        self.without_used(self.libraries())
    }

    /// Those of the names that the text of the shown document does not use.
    pub fn without_used(self, mut names: Vec<String>) -> Vec<String> {
        self.text.track();
        let used = self.ask_of_shown(Session::used).unwrap_or_default();
        names.retain(|name| !used.contains(name));
        names
    }

    /// Begins to read what the libraries have, one after the other, so that it is found there.
    pub fn read_libraries(self) {
        let is_begun = self.of_libraries.with_untracked(Option::is_some);
        if self.id().is_none() || is_begun || self.libraries().is_empty() {
            return;
        }
        self.of_libraries.set(Some(Vec::new()));
        leptos::task::spawn_local(async move {
            for library in self.libraries() {
                js::pause().await;
                let more = self.ask(|session| session.bin_of_library(&library));
                self.of_libraries.update(|all| all.get_or_insert_default().extend(more));
            }
        });
    }

    /// What the libraries have that the shown document does not use yet, as far as that was read; without what is
    /// called like something that it has already.
    pub fn in_unused_libraries(self) -> Vec<BinEntry> {
        let unused = self.unused_libraries();
        let mut all = self.of_libraries.get().filter(|_| self.id().is_some()).unwrap_or_default();
        let known = self.ask_of_shown(Session::bin_names).unwrap_or_default();
        all.retain(|entry| unused.contains(&entry.library) && !known.contains(&entry.class));
        all
    }

    pub(super) fn update_document(self, change: impl FnOnce(&mut Opened)) {
        let Some(path) = self.current.get_untracked() else { return };
        let Some(mut document) = self.document.get_untracked() else { return };
        change(&mut document);
        if self.document.with_untracked(|old| old.as_ref() != Some(&document)) {
            self.opened.update_value(|all| {
                all.insert(path, document.clone());
            });
            self.document.set(Some(document));
        }
    }

    /// Returns true if any open document has changes that are not on disk.
    pub fn any_unsaved(self) -> bool {
        self.pending_text.with_value(Option::is_some)
            || self.opened.with_value(|all| all.values().any(|opened| opened.dirty))
    }

    /// Begins a new document, under a name that no other has.
    pub fn begin_new(self) {
        leptos::task::spawn_local(async move {
            let path = self.free_path(UNTITLED).await;
            // whose key began it, draws next
            crate::keyboard::focus("#picture");
            route::go(&route::to(&path));
        });
    }

    /// A path that no document has, here or on the server.
    pub(super) async fn free_path(self, name: &str) -> String {
        // Without the list there are still the documents that are open.
        let _ = self.fetch_list().await;
        let paths = std::iter::once(format!("{name}.thing"))
            .chain((2..).map(|n| format!("{name}-{n}.thing")));
        let has_draft = kept_drafts();
        let is_free = |path: &String| {
            !has_draft(path)
                && !self.opened.with_value(|all| all.contains_key(path))
                && !self.listed.with_untracked(|all| all.iter().any(|one| one.path == *path))
        };
        { paths }.find(is_free).unwrap_or_default()
    }

    /// Lets a person choose a file of the machine; its text becomes a new document of that name.
    pub fn open_file(self) {
        let took = Closure::once_into_js(move |name: String, text: String| {
            leptos::task::spawn_local(async move {
                let path = self.free_path(name.strip_suffix(".thing").unwrap_or(&name)).await;
                let stored = Stored { text, version: String::from(ABSENT), writable: true };
                match self.take_up(&path, stored).await {
                    Ok(_) => route::go(&route::to(&path)),
                    Err(message) => self.say_refused(message),
                }
            });
        });
        js::choose_file(".thing,text/plain", took.unchecked_ref());
    }

    /// Saves the shown document under another name, which becomes its own.
    ///
    /// # Errors
    /// One sentence: a document of that name is there, or it is no name for one.
    pub async fn save_as(self, name: &str) -> Result<(), String> {
        self.flush_text();
        let name = name.trim().trim_end_matches(".thing");
        let path = format!("{name}.thing");
        let (Some(old), Some(document)) =
            (self.current.get_untracked(), self.document.get_untracked())
        else {
            return Ok(());
        };
        let text = self.text.with_untracked(|text| text.source.clone());
        let outcome = server::save(&path, &text, ABSENT).await;
        match outcome {
            Saved::Done(version) => {
                self.forget_draft(&old);
                note_renamed(&old, &path);
                self.note_saved(&path, &text);
                self.order(|session| session.rename(document.id, &path));
                let writable = true;
                let opened = Opened { version, writable, saved: text, dirty: false, ..document };
                self.opened.update_value(|all| {
                    all.remove(&old);
                    all.insert(path.clone(), opened.clone());
                });
                self.current.set(Some(path.clone()));
                self.document.set(Some(opened));
                route::replace(&route::to(&path));
                self.refresh();
                self.notice.set(Some(Notice::Said(words::saved(&path))));
                Ok(())
            }
            Saved::Changed(_) => Err(words::name_taken(&path)),
            Saved::Failed(message) => Err(message),
        }
    }

    /// Saves the shown document; a new one is asked for its name first.
    pub fn save(self) {
        self.flush_text();
        let untitled = self.document.with_untracked(|d| d.as_ref().is_some_and(Opened::is_new))
            && self.current.with_untracked(|path| {
                path.as_ref().is_some_and(|path| path.starts_with(UNTITLED))
            });
        if untitled {
            self.wish.set(Some(Wish::SaveAs));
            return;
        }
        let Some(path) = self.current.get_untracked() else { return };
        let Some(document) = self.document.get_untracked() else { return };
        let text = self.text.with_untracked(|text| text.source.clone());
        leptos::task::spawn_local(async move {
            let outcome = server::save(&path, &text, &document.version).await;
            self.saved(&path, text, outcome);
        });
    }

    pub(super) fn saved(self, path: &str, text: String, outcome: Saved) {
        if let Saved::Done(_) = outcome {
            self.note_saved(path, &text);
        }
        if self.current.with_untracked(|current| current.as_deref() != Some(path)) {
            return;
        }
        match outcome {
            Saved::Done(version) => {
                let now = self.text.with_untracked(|text| text.source.clone());
                self.conflict.set(None);
                self.update_document(|document| {
                    document.dirty = now != text;
                    (document.version, document.saved, document.writable) = (version, text, true);
                });
                self.keep_draft(&now);
                self.notice.set(Some(Notice::Said(words::saved(path))));
            }
            Saved::Changed(theirs) => self.conflict.set(Some(theirs)),
            Saved::Failed(message) => self.say_refused(message),
        }
    }

    /// Takes what stands on disk instead: one step, which can be taken back.
    pub fn take_theirs(self) {
        if let Some(Some(theirs)) = self.conflict.get_untracked() {
            self.conflict.set(None);
            self.update_document(|document| {
                (document.version, document.saved) = (theirs.version, theirs.text.clone());
            });
            self.apply(&Command::Text(theirs.text));
        }
    }

    /// Saves over what stands on disk instead.
    pub fn overwrite(self) {
        if let Some(theirs) = self.conflict.get_untracked() {
            self.conflict.set(None);
            let version = theirs.map_or_else(|| String::from("absent"), |stored| stored.version);
            self.update_document(|document| document.version = version);
            self.save();
        }
    }

    /// Hands the user the text as a file.
    pub fn download(self) {
        self.flush_text();
        let Some(path) = self.current.get_untracked() else { return };
        let name = path.rsplit('/').next().unwrap_or(&path);
        self.text.with_untracked(|text| js::download(name, &text.source));
    }
}

/// What stands under a path: on disk, in the gallery, or the beginning of a document that is not there yet.
async fn stands(path: &str) -> Result<Stored, String> {
    let begun =
        || Stored { text: String::from(NEW_TEXT), version: String::from(ABSENT), writable: true };
    Ok(server::document(path).await?.unwrap_or_else(begun))
}

/// Keeps in mind that a document is shown. A browser that keeps nothing offers none.
fn note_shown(path: &str) {
    let kept = theme::keep(RECENT).unwrap_or_default();
    theme::put(RECENT, Some(&recent::with(&kept, path)));
}

/// Keeps in mind that a document has another name now.
fn note_renamed(old: &str, new: &str) {
    let kept = theme::keep(RECENT).unwrap_or_default();
    theme::put(RECENT, Some(&recent::renamed(&kept, old, new)));
}
