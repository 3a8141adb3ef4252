//! Edits: commands, drags, joins, typed text, and what came of them.

use super::remote::Outcome;
use super::{InPlace, Lab, Notice, Zoom};
use crate::sheet::bounds;
use crate::{js, words};
use drawing::Bounds;
use leptos::prelude::*;
use presentation::typing::is_of_unfinished;
use session::remote::{Came, LongEdit};
use session::view::{
    Caught, Change, Choice, Deed, DiagnosticView, DragState, FixView, Offer, Pointer, Question,
    Refusal,
};
use session::{Clip, Command, DocumentId, Path, Relations, Session};
use std::time::Duration;

const TYPING_PAUSE: Duration = Duration::from_millis(150);

impl Lab {
    /// Applies a command to the shown document, or asks first what it is meant of; what comes of it stands in the
    /// signals. Returns whether it is done: of one that may take long, not yet.
    pub fn apply(self, command: &Command) -> bool {
        self.apply_among(command, &[])
    }

    /// The same of a command that is about some things without naming their paths.
    pub(crate) fn apply_among(self, command: &Command, about: &[Path]) -> bool {
        self.flush_text();
        let edit = LongEdit::Command(command.clone());
        let asked = self.ask_of_shown(|session, id| session.preview(id, command).ok().flatten());
        let asked = asked.flatten();
        if asked.is_none() && self.is_long(&edit, about) {
            self.have_executed(edit, move |outcome| {
                self.settle_edit(outcome);
            });
            return false;
        }
        let over = || self.ask_of_shown(|session, id| session.over_constrained(id, command));
        match asked.or_else(|| over().flatten()) {
            Some(question) => {
                self.notice.set(Some(Notice::Asked(question)));
                false
            }
            None => self.apply_as_meant(command),
        }
    }

    /// Takes back what goes on, a drag or an edit that the worker is at; else the last step.
    pub fn undo(self) {
        if self.dragging.with_untracked(Option::is_some) {
            self.cancel();
        } else if !self.stop_edits() {
            self.apply(&Command::Undo);
        }
    }

    /// Mends the text by a fix of one of its diagnostics, if it is still the text that is shown.
    pub fn fix(self, fix: &FixView) {
        self.flush_text();
        let shown = self.text.with_untracked(|text| text.source.clone());
        let present = self.id().map(|id| self.ask(|session| session.text(id).source));
        if present == Some(shown) {
            self.settle(self.tell(|session, id| session.fix(id, fix)));
        }
    }

    /// Applies a command that was chosen, without asking; the undo list calls one of the whole text by what it is for.
    pub fn apply_called(self, command: &Command, label: &str) -> bool {
        let done = self.apply_as_meant(command);
        if done && matches!(command, Command::Text(_)) {
            self.tell(|session, id| session.label_last(id, label));
            let status = self.ask_of_shown(Session::standing);
            self.status.set(status.unwrap_or_default());
        }
        done
    }

    /// Applies a command without asking.
    pub fn apply_as_meant(self, command: &Command) -> bool {
        let done = self.settle(self.tell(|session, id| session.apply(id, command)));
        if matches!(command, Command::Undo | Command::Redo) {
            self.renew_waiting();
        }
        done
    }

    /// Sets a value as a person types it; the caller is told what came of it, at once or later, and shows beside the
    /// field why not.
    pub fn set_typed(
        self,
        path: &str,
        typed: &str,
        then: impl FnOnce(Result<(), Refusal>) + 'static,
    ) {
        self.flush_text();
        let before = self.drawn_box();
        let edit = LongEdit::Typed { path: path.into(), typed: typed.into() };
        let path = String::from(path);
        self.edit(edit, move |outcome| then(self.typed(&path, before, outcome)));
    }

    /// The same, always at once.
    ///
    /// # Errors
    /// Why not; the caller shows it beside the field.
    pub fn set_typed_now(self, path: &str, typed: &str) -> Result<(), Refusal> {
        self.flush_text();
        let before = self.drawn_box();
        let outcome = self.tell(|session, id| session.set_typed(id, path, typed));
        self.typed(path, before, outcome.map(|done| done.map(Came::Changed)))
    }

    fn typed(self, path: &str, before: Option<Bounds>, outcome: Outcome) -> Result<(), Refusal> {
        if let Some(Err(refusal)) = outcome {
            return Err(refusal);
        }
        let size = |all: Option<Bounds>| {
            all.map(|all| (all.most.x - all.least.x, all.most.y - all.least.y))
        };
        let is_right = self.settle_edit(outcome);
        if is_right && size(self.drawn_box()) != size(before) && self.is_length(path) {
            self.look_at_size();
        }
        Ok(())
    }

    /// Returns the box around what is drawn; nothing while that is nothing.
    pub fn drawn_box(self) -> Option<Bounds> {
        self.picture.with_untracked(|picture| {
            (!picture.drawing.elements.is_empty()).then(|| bounds(&picture.drawing))
        })
    }

    /// Brings what is drawn into sight where a change has made it reach out of it, if all of it was in sight before, or
    /// where it lies outside or is too small to see, if that is asked.
    pub fn keep_in_sight(self, before: Option<Bounds>, or_lost: bool) {
        if let Some(before) = before
            && self.drawn_box() != Some(before)
            && self.zoom.with_untracked(|zoom| !matches!(zoom, Some(Zoom::Fit)))
        {
            self.zoom.set(Some(Zoom::Kept(before, or_lost)));
        }
    }

    fn is_length(self, path: &str) -> bool {
        let rows = self.ask_of_shown(Session::values).unwrap_or_default();
        let row = rows.iter().find(|row| row.path == path || row.shortest == path);
        row.is_some_and(|row| row.class == "Length")
    }

    /// Brings what is drawn into sight where a length that was typed has made it another size.
    pub fn look_at_size(self) {
        // who has looked elsewhere is shown no more than what has left the sight
        let is_asked = match self.zoom.get_untracked() {
            Some(Zoom::Fit) => true,
            Some(Zoom::Kept(..)) => self.looked.get_value(),
            Some(Zoom::Seen | Zoom::Sized | Zoom::Within | Zoom::Over(_) | Zoom::By(_)) | None => {
                false
            }
        };
        if !is_asked {
            self.zoom.set(Some(Zoom::Sized));
        }
    }

    /// Begins a drag; returns where the handle of what is dragged lies on the sheet, if there is one.
    pub fn press(self, path: &str) -> Option<(f64, f64)> {
        let paths = [String::from(path)];
        self.press_by(&paths, Session::press_all)
    }

    /// Begins a drag where a pointer is, of several things as one.
    pub fn press_at(self, paths: &[String], pointer: &Pointer) -> Option<(f64, f64)> {
        self.press_by(paths, |session, id, paths| session.press_at(id, paths, pointer))
    }

    fn press_by(
        self,
        paths: &[String],
        press: impl FnOnce(&mut Session, DocumentId, &[Path]) -> Result<(f64, f64), Refusal>,
    ) -> Option<(f64, f64)> {
        self.flush_text();
        self.finish_edits();
        let paths: Option<Vec<Path>> = paths.iter().map(|p| session::parse_path(p)).collect();
        match self.tell(|session, id| press(session, id, &paths.unwrap_or_default()))? {
            Ok(handle) => {
                self.notice.set(None);
                self.dragging.set(Some(DragState::default()));
                Some(handle)
            }
            Err(refusal) => {
                self.notice.set(Some(Notice::Refused(refusal)));
                None
            }
        }
    }

    /// Goes on with a drag, in the sheet's coordinates.
    pub fn drag(self, to: (f64, f64)) {
        let state = self.tell(|session, id| session.drag(id, to));
        self.repaint();
        self.follow_plot();
        if state != self.dragging.get_untracked() {
            self.dragging.set(state);
        }
    }

    /// Ends a drag: one step for the undo list.
    pub fn release(self) {
        self.dragging.set(None);
        self.select_held();
        self.settle(self.tell(Session::release));
    }

    /// Selects the handle that is held since another was dragged across what stays, where that one was selected.
    pub(super) fn select_held(self) {
        let instead = self.id().and_then(|id| self.ask(|session| session.held_instead(id)));
        let Some((pressed, held)) = instead else { return };
        let pressed = pressed.to_string();
        if self.selected.with_untracked(|selected| selected.as_ref() == Some(&pressed)) {
            self.select(Some(held.to_string()));
        }
    }

    /// Looks whether what is dragged, brought to a place, would be joined with one of some paths, nearest first.
    pub fn look_for_joint(self, near: &[Caught]) {
        let found = self.id().and_then(|id| {
            near.iter().find_map(|caught| {
                let path = session::parse_path(&caught.word)?;
                let joined = self.ask(|session| session.joint(id, &path))?;
                let caught = Caught { word: words::joins(&joined), ..caught.clone() };
                Some((path, caught))
            })
        });
        if self.dropping.with_untracked(|old| *old != found) {
            self.dropping.set(found);
        }
    }

    /// Merges what is selected: of each what sticks there.
    pub fn join_selection(self) {
        self.flush_text();
        let Some(id) = self.id() else { return };
        let paths: Vec<Path> =
            self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect();
        match self.ask(|session| session.join(id, &paths)) {
            Ok(command) => drop(self.apply(&command)),
            Err(refusal) => self.notice.set(Some(Notice::Refused(refusal))),
        }
    }

    /// Deletes what is selected; where more goes with it, that is told first.
    pub fn delete_selection(self) {
        self.flush_text();
        if !self.also.with_untracked(Vec::is_empty) {
            return self.delete_several();
        }
        let Some(path) = self.selected.get_untracked() else { return };
        let (Some(id), Some(parsed)) = (self.id(), session::parse_path(&path)) else { return };
        match self.ask(|session| session.drawn_deletion(id, &parsed)) {
            Ok(Some(question)) => return self.notice.set(Some(Notice::Asked(question))),
            Err(refusal) => return self.notice.set(Some(Notice::Refused(refusal))),
            Ok(None) => {}
        }
        let command = Command::Delete(parsed.clone());
        let asked = self.ask(|session| session.preview(id, &command).ok().flatten());
        if asked.is_none() && self.ask(|session| session.is_measured(id, &parsed)) {
            return self.delete_several();
        }
        let along = self.ask(|session| session.along_with(id, &parsed));
        if asked.is_some() || along.is_empty() {
            if self.apply(&command) {
                // the next constraint has its number now
                self.select(None);
            }
            return;
        }
        let message = words::goes_along(&path, &along);
        let choices = vec![Choice { label: words::delete_all(along.len() + 1), command }];
        self.notice.set(Some(Notice::Asked(Question { message, choices })));
    }

    /// Deletes all that is selected; where more goes with it, that is told first.
    fn delete_several(self) {
        let paths = self.selected_paths();
        let Some(deletion) = self.ask_of_shown(|session, id| session.deletion(id, &paths)) else {
            return;
        };
        match deletion {
            Ok((command, along)) if along.is_empty() => {
                self.apply(&command);
            }
            Ok((command, along)) => {
                let message = words::goes_along(&words::counted(paths.len()), &along);
                let label = words::delete_all(along.len() + paths.len());
                let choices = vec![Choice { label, command }];
                self.notice.set(Some(Notice::Asked(Question { message, choices })));
            }
            Err(refusal) => self.notice.set(Some(Notice::Refused(refusal))),
        }
    }

    pub(crate) fn selected_paths(self) -> Vec<Path> {
        self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect()
    }

    /// Takes copies of what is selected; returns them as a text for the clipboard, where that was possible.
    pub fn copy_selection(self) -> Option<String> {
        self.flush_text();
        let paths = self.selected_paths();
        match self.ask_of_shown(|session, id| session.copied(id, &paths, Relations::Own))? {
            Ok(clip) => {
                let written = clip.written();
                self.clip.set(Some((clip, 0)));
                self.notice.set(Some(Notice::Said(words::copied(paths.len()))));
                Some(written)
            }
            Err(refusal) => {
                self.notice.set(Some(Notice::Refused(refusal)));
                None
            }
        }
    }

    /// The same, and deletes what is selected.
    pub fn cut_selection(self) -> Option<String> {
        let written = self.copy_selection()?;
        self.delete_selection();
        Some(written)
    }

    /// Puts down what a text says that comes from the clipboard.
    pub fn paste_text(self, text: &str) {
        let is_own = self.clip.with_untracked(|clip| {
            clip.as_ref().is_some_and(|(clip, _)| clip.written().trim() == text.trim())
        });
        if !is_own {
            match self.ask_of_shown(|session, id| session.copies_in(id, text)).flatten() {
                Some(clip) => self.clip.set(Some((clip, 0))),
                None => {
                    self.notice.set(Some(Notice::Said(String::from(words::NO_THINGS_COPIED))));
                    return;
                }
            }
        }
        self.paste();
    }

    /// Puts down what the clipboard holds; where the browser does not tell, what was copied here last.
    pub fn paste_from_clipboard(self) {
        leptos::task::spawn_local(async move {
            match js::pasted().await.as_string() {
                Some(text) if !text.is_empty() => self.paste_text(&text),
                _ if self.clip.with_untracked(Option::is_none) => {
                    self.notice.set(Some(Notice::Said(String::from(words::NOTHING_COPIED))));
                }
                _ => self.paste(),
            }
        });
    }

    /// Puts down what was copied last, a little further aside each time, and selects it.
    pub fn paste(self) {
        let Some((clip, aside)) = self.clip.get_untracked() else { return };
        if self.put_down(&clip, aside + 1) {
            self.clip.set(Some((clip, aside + 1)));
        }
    }

    /// Makes copies of what is selected, a little aside, and selects them.
    pub fn duplicate_selection(self, relations: Relations) {
        self.flush_text();
        let paths = self.selected_paths();
        match self.ask_of_shown(|session, id| session.copied(id, &paths, relations)) {
            Some(Ok(clip)) => {
                self.put_down(&clip, 1);
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }

    fn put_down(self, clip: &Clip, aside: u32) -> bool {
        self.flush_text();
        match self.ask_of_shown(|session, id| session.pasting(id, clip, aside)) {
            Some(Ok((command, names))) => {
                let done = self.apply_as_meant(&command);
                if done {
                    self.select_all(&names);
                }
                done
            }
            Some(Err(refusal)) => {
                self.notice.set(Some(Notice::Refused(refusal)));
                false
            }
            None => false,
        }
    }

    /// Opens the editor of a thing's value in the picture: of the one that a word there shows, else of the
    /// outermost that the text gives.
    pub fn edit_in_place(self, path: &str, word: Option<&str>, at: (f64, f64)) {
        if let Some(offer) = self.ruling(path) {
            self.select(Some(String::from(path)));
            return self.take_offer(&offer);
        }
        let value = self
            .id()
            .zip(session::parse_path(path))
            .and_then(|(id, path)| self.ask(|session| session.value_shown(id, &path, word)));
        self.list();
        let found = self.values.with_untracked(|rows| {
            let row = rows.iter().find(|row| value.as_ref() == Some(&row.path))?;
            let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
            Some(InPlace { path: row.path.clone(), value: format!("{}{unit}", row.exact), at })
        });
        match found {
            Some(found) => self.editing.set(Some(found)),
            None => self.notice.set(Some(Notice::Said(words::no_value_to_type(path)))),
        }
    }

    /// What has a dimension that only follows say its value, where a path leads to one.
    fn ruling(self, path: &str) -> Option<Offer> {
        let path = session::parse_path(path)?;
        let offers = self.ask_of_shown(|session, id| session.offers(id, &[path]))?;
        offers.into_iter().find(|offer| matches!(offer.deed, Deed::Rule(_)))
    }

    /// Ends a drag as if it had never begun.
    pub fn cancel(self) {
        self.dragging.set(None);
        self.dropping.set(None);
        self.tell(Session::cancel);
        self.refresh();
    }

    /// Says which classes the selected things could be the parts of.
    pub fn recognise(self) {
        self.flush_text();
        let Some(id) = self.id() else { return };
        let paths: Vec<Path> =
            self.selection().iter().filter_map(|p| session::parse_path(p)).collect();
        self.notice.set(Some(match self.ask(|session| session.recognise(id, &paths)) {
            Ok(found) if found.is_empty() => Notice::Said(String::from(words::NOT_RECOGNISED)),
            Ok(found) => Notice::Recognised(found),
            Err(refusal) => Notice::Refused(refusal),
        }));
    }

    /// Takes note of what the editor holds; it becomes a command a little later, or before the next
    /// one.
    pub fn typed_text(self, text: String) {
        self.keep_draft(&text);
        self.pending_text.set_value(Some(text));
        self.typing.update_value(|n| *n += 1);
        let mine = self.typing.get_value();
        set_timeout(
            move || {
                if self.typing.try_get_value() == Some(mine) {
                    self.hand_over_text();
                }
            },
            TYPING_PAUSE,
        );
    }

    /// The text as the editor has it, which may be newer than what the session knows.
    pub fn written(self) -> String {
        let pending = self.pending_text.get_value();
        pending.unwrap_or_else(|| self.text.with_untracked(|text| text.source.clone()))
    }

    /// What is wrong with the text, but for the word that is being typed.
    pub fn told_diagnostics(self) -> Vec<DiagnosticView> {
        let typed_at = self.typed_at.get();
        let is_told = |d: &&DiagnosticView| !is_of_unfinished(d, typed_at);
        self.text.with(|text| text.diagnostics.iter().filter(is_told).cloned().collect())
    }

    /// Whether the editor holds words that the session has not been given yet.
    pub fn is_typing(self) -> bool {
        self.pending_text.with_value(Option::is_some)
    }

    /// Ends what is pending before something else is done: what is played stops, and what was typed into the editor is
    /// handed to the session.
    pub fn flush_text(self) {
        self.type_at(None);
        self.hand_over_text();
    }

    /// Takes note of the byte of the text behind which somebody types; nothing once that word is left.
    pub fn type_at(self, at: Option<u32>) {
        if self.typed_at.get_untracked() != at {
            self.typed_at.set(at);
        }
    }

    /// Hands what was typed into the editor to the session.
    fn hand_over_text(self) {
        self.stop_playing();
        let typed = self.pending_text.try_update_value(Option::take).flatten();
        if let Some(text) = typed {
            self.settle(self.tell(|session, id| session.apply(id, &Command::Text(text))));
        }
    }

    /// Shows what came of a command.
    pub(crate) fn settle(self, outcome: Option<Result<Change, Refusal>>) -> bool {
        let before = self.drawn_box();
        match outcome {
            Some(Ok(change)) => {
                self.follow_prototype();
                self.refresh();
                self.renew_tool();
                self.fetch_missing();
                self.forget_gone();
                if change.structure {
                    self.ghosts.set(Vec::new());
                    let zoom = if self.fits.get_value() { Zoom::Fit } else { Zoom::Seen };
                    self.zoom.set(Some(zoom));
                }
                // what is drawn step by step may begin small
                self.keep_in_sight(before, change.structure);
                if change.unit.is_some() {
                    self.look_at_size();
                }
                self.notice.set(words::done(&change).map(Notice::Said));
                true
            }
            Some(Err(refusal)) => {
                self.refresh();
                self.notice.set(Some(Notice::Refused(refusal)));
                false
            }
            None => false,
        }
    }

    /// Lets go of what was selected and is there no more, or is called otherwise.
    fn forget_gone(self) {
        let selection = self.selection_untracked();
        let is_there = |path: &&String| {
            let parsed = session::parse_path(path);
            let asked = parsed.and_then(|path| self.ask_of_shown(|s, id| s.is_there(id, &path)));
            asked.unwrap_or_default()
        };
        let rest: Vec<String> = selection.iter().filter(is_there).cloned().collect();
        if rest.len() < selection.len() {
            self.select_all(&rest);
        }
    }
}
