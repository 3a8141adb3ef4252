//! Drawing by constructions: what is waited for, recording, and its steps.

use crate::lab::{Lab, Notice};
use crate::{js, keyboard, words};
use leptos::prelude::*;
use session::drafting::view::{
    Ends, Go, MeasureKind, NewParameter, OlderUse, ParameterRow, Prompt, StepRow, StepsView, Turn,
    Wants,
};
use session::view::{Change, DocumentId, Pointer, Refusal};
use std::time::Duration;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

pub mod calculator;
pub mod numbers;
pub mod parameter;
pub mod prompt;
pub mod recorder;
pub mod seeking;
pub mod steps;
pub mod tools;

/// Where an operand is typed.
const OPERAND: &str = "input[name='operand']";
/// After so long without a step, what may come next is made ready.
const PAUSE: Duration = Duration::from_millis(120);

/// What of drafting the panels share.
#[derive(Clone, Copy, Debug)]
pub struct Drafting {
    /// What is waited for: an operand, an answer, a condition.
    pub prompt: RwSignal<Option<Prompt>>,
    /// What is typed of it.
    pub typed: RwSignal<String>,
    /// What the pointer finds for it, or why nothing.
    pub finds: RwSignal<Option<String>>,
    /// Where the pointer of the construction was last.
    pub pointer: StoredValue<Option<Pointer>>,
    /// Whether the latest operand was typed, so that no hand is over the picture.
    pub by_keys: StoredValue<bool>,
    /// The measure that the latest pick added to what is typed.
    pub picked: StoredValue<Option<String>>,
    /// Whether the calculator is open.
    pub calculator: RwSignal<bool>,
    /// What the calculator keeps.
    pub memory: RwSignal<Option<String>>,
    /// Whether the next drag is a rubber band.
    pub banding: RwSignal<bool>,
    /// Whether the next click says until where a program is visited.
    pub seeking: RwSignal<bool>,
    /// What the keyboard has found meanwhile.
    pub sought: RwSignal<Option<String>>,
    /// The step that is lit.
    pub lit: RwSignal<Option<String>>,
    /// The parameter that is about to be defined, or said anew.
    pub parameter: RwSignal<NewParameter>,
    /// Counted up where recording begins or ends, or a block does.
    pub turned: RwSignal<u32>,
}

impl Default for Drafting {
    /// Nothing is begun.
    fn default() -> Self {
        Self {
            prompt: RwSignal::new(None),
            typed: RwSignal::new(String::new()),
            finds: RwSignal::new(None),
            pointer: StoredValue::new(None),
            by_keys: StoredValue::new(false),
            picked: StoredValue::new(None),
            calculator: RwSignal::new(false),
            memory: RwSignal::new(None),
            banding: RwSignal::new(false),
            seeking: RwSignal::new(false),
            sought: RwSignal::new(None),
            lit: RwSignal::new(None),
            parameter: RwSignal::new(NewParameter::default()),
            turned: RwSignal::new(0),
        }
    }
}

/// Gives the keyboard to what comes next in the drawer: the name of a program, or, while one is recorded, what narrows
/// the constructions.
pub fn focus_drawer() {
    let name = document().query_selector("input[name='program']").ok().flatten();
    select_all(if name.is_some() { "input[name='program']" } else { "input[name='construction']" });
}

/// Gives the keyboard to a field; what is typed takes the place of what is there.
fn select_all(field: &str) {
    let field = document().query_selector(field).ok().flatten();
    if let Some(field) = field.and_then(|f| f.dyn_into::<web_sys::HtmlInputElement>().ok()) {
        // What cannot be focused stays as it is.
        let _ = field.focus();
        field.select();
    }
}

impl Lab {
    /// Whether something waits for a pick.
    pub fn drafts(self) -> bool {
        self.drafting.prompt.with_untracked(Option::is_some)
    }

    /// Begins a construction.
    pub fn begin_construction(self, tool: &str) {
        self.flush_text();
        self.drop_tool();
        match self.tell(|session, id| session.begin(id, tool)) {
            Some(Ok(prompt)) => {
                self.notice.set(None);
                self.select(None);
                self.fits.set_value(false);
                self.drafting.pointer.set_value(None);
                self.show_prompt(Some(prompt));
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }

    fn show_prompt(self, prompt: Option<Prompt>) {
        let measure = prompt.as_ref().and_then(|p| p.insert.clone());
        let typed = measure.as_ref().map_or(String::new(), |measure| {
            let typed = self.drafting.typed.get_untracked();
            // two measures in a row are no expression: the later pick takes the place of the one before
            let before = self.drafting.picked.get_value();
            let kept = before.as_deref().and_then(|before| typed.strip_suffix(before));
            format!("{}{measure}", kept.unwrap_or(&typed))
        });
        self.show_prompt_with(prompt, typed);
        self.drafting.picked.set_value(measure);
    }

    fn show_prompt_with(self, prompt: Option<Prompt>, typed: String) {
        let is_asked = prompt
            .as_ref()
            .is_some_and(|p| p.tool.is_empty() && matches!(p.wants, Wants::Recurrence(_)));
        let is_condition = prompt.as_ref().is_some_and(|p| {
            matches!(p.wants, Wants::Condition | Wants::Ends(Ends::Until | Ends::While))
        });
        if is_condition {
            // a condition is built by pointing
            self.drafting.calculator.set(true);
        }
        self.drafting.typed.set(typed);
        self.drafting.finds.set(None);
        self.show_made(drawing::Drawing::default());
        self.drafting.prompt.set(prompt);
        if is_asked {
            // what is asked about is lit at once
            self.draft_hover(&Self::nowhere());
            self.drafting.finds.set(None);
        }
    }

    /// Another document is shown: what is asked is what that one waits for.
    pub fn renew_drafting(self) {
        let Drafting { calculator, banding, seeking, lit, parameter, pointer, .. } = self.drafting;
        [calculator, banding, seeking].iter().for_each(|asked| asked.set(false));
        lit.set(None);
        parameter.set(NewParameter::default());
        pointer.set_value(None);
        self.show_waiting();
    }

    /// Shows what is waited for, where that is something else than before.
    pub fn renew_waiting(self) {
        let asked = |prompt: Option<&Prompt>| {
            prompt.map(|p| (p.tool.clone(), p.label.clone(), p.words.clone()))
        };
        let now = self.ask_of_shown(session::Session::prompt).flatten();
        if self.drafting.prompt.with_untracked(|shown| asked(shown.as_ref()) != asked(now.as_ref()))
        {
            self.show_waiting();
        }
    }

    /// Shows what the session waits for now.
    fn show_waiting(self) {
        let prompt = self.ask_of_shown(session::Session::prompt).flatten();
        self.show_prompt(prompt);
        self.drafting.turned.update(|n| *n += 1);
        self.keep_place();
    }

    /// Shows something over the picture: what would be made, or what a step made.
    fn show_made(self, mut preview: drawing::Drawing) {
        if let Some(set) = self.ask_of_shown(session::Session::set_drawing) {
            preview.elements.extend(set.elements);
        }
        if let Some(Some(visited)) = self.ask_of_shown(session::Session::drawn_so_far) {
            preview.elements.extend(visited.elements);
        }
        self.tool_view.update(|view| view.preview = preview);
    }

    /// Shows anew what a step made, and what is visited has drawn, where the values are others.
    fn show_made_anew(self, example: &str) {
        let lit = self.drafting.lit.get_untracked();
        let visits = || self.ask_of_shown(session::Session::drawn_so_far).flatten().is_some();
        if self.drafts() || (lit.is_none() && !visits()) {
            return;
        }
        let made =
            lit.and_then(|step| self.ask_of_shown(|s, id| s.step_drawing(id, example, &step)));
        self.show_made(made.unwrap_or_default());
    }

    /// Runs the second turn of the loop that is drawn ahead, if nothing more comes for a while: as it is, or with what is
    /// under a pointer for an answer.
    fn foresee_turn(self, pointer: Option<Pointer>) {
        let Drafting { turned, pointer: latest, .. } = self.drafting;
        let before = turned.get_untracked();
        let foresee = move || {
            let is_so = pointer.is_none() || latest.try_get_value() == Some(pointer.clone());
            if is_so && turned.try_get_untracked() == Some(before) {
                self.tell(|session, id| session.foresee_turn(id, pointer.as_ref()));
            }
        };
        set_timeout(foresee, PAUSE);
    }

    /// The pointer of the construction is elsewhere.
    pub fn draft_hover(self, pointer: &Pointer) {
        let typed = self.drafting.typed.get_untracked();
        let hover = self.tell(|session, id| session.hover(id, pointer, &typed));
        let Some(hover) = hover else { return };
        self.drafting.by_keys.set_value(false);
        self.drafting.pointer.set_value((pointer.reach >= 0.0).then(|| pointer.clone()));
        if let Some(pointer) = self.drafting.pointer.get_value()
            && self.drafting.prompt.with_untracked(|p| p.as_ref().is_some_and(Prompt::asks_object))
        {
            self.foresee_turn(Some(pointer));
        }
        self.show_made(hover.ghost);
        let finds = match (hover.finds, hover.why) {
            (Some(finds), Some(why)) => Some(format!("{finds}: {why}")),
            (finds, why) => finds.or(why),
        };
        self.drafting.finds.set(finds);
    }

    /// Gives what is under the pointer.
    pub fn draft_point(self, pointer: &Pointer) {
        let is_bare = self.drafting.typed.with_untracked(String::is_empty);
        self.drafting.by_keys.set_value(false);
        let turn = self.tell(|session, id| session.point(id, pointer));
        let is_number = |prompt: &Prompt| {
            prompt.insert.as_ref().is_some_and(|measure| measure.parse::<f64>().is_ok())
        };
        let is_place = matches!(&turn, Some(Ok(Turn::Wants(prompt))) if is_number(prompt));
        self.take_turn(turn);
        // a free place says all of how high, or how far to the right
        if is_bare && is_place && !self.drafting.calculator.get_untracked() {
            self.draft_enter_by(false);
        }
    }

    /// Whether a construction has its first operand and wants another that is picked.
    pub fn wants_another_pick(self) -> bool {
        let is_begun = |prompt: &Prompt| {
            let has_first = prompt.operands.first().is_some_and(|(_, given)| given.is_some());
            has_first && !prompt.is_value && prompt.wants == Wants::Operand
        };
        self.drafting.prompt.with_untracked(|prompt| prompt.as_ref().is_some_and(is_begun))
    }

    /// Gives what is typed.
    pub fn draft_enter(self) {
        self.draft_enter_by(true);
    }

    fn draft_enter_by(self, is_by_keys: bool) {
        self.drafting.by_keys.set_value(is_by_keys);
        let typed = self.drafting.typed.get_untracked();
        let turn = self.tell(|session, id| session.enter(id, &typed));
        if matches!(turn, Some(Ok(_))) {
            self.drafting.calculator.set(false);
        }
        self.take_turn(turn);
    }

    /// Answers that it is the same.
    fn draft_same(self) {
        let turn = self.tell(session::Session::same);
        self.take_turn(turn);
    }

    /// Another solution is shown.
    fn draft_turn(self) {
        self.tell(session::Session::turn_round);
        self.hover_again();
    }

    /// Says what something older is for the program.
    fn take_older(self, to: OlderUse) {
        let turn = self.tell(|session, id| session.take_older(id, to));
        if matches!(turn, Some(Ok(Turn::Wants(_)))) {
            // the program has more in it, though the figure waits for further operands
            self.settle(Some(Ok(Change::default())));
        }
        self.take_turn(turn);
        self.drafting.turned.update(|n| *n += 1);
    }

    /// Picks of sets mean more.
    fn draft_wider(self) {
        self.tell(session::Session::pick_wider);
        self.hover_again();
    }

    /// Shows what would be done where the pointer was last, and gives the keyboard back to the field.
    fn hover_again(self) {
        match self.drafting.pointer.get_value() {
            Some(pointer) => self.draft_hover(&pointer),
            None => self.draft_typed(),
        }
        if !js::coarse() {
            keyboard::focus(OPERAND);
        }
    }

    /// Shows what would come of what is typed so far, or of what the pointer finds.
    fn draft_typed(self) {
        let is_drawn =
            self.drafting.prompt.with_untracked(|p| p.as_ref().is_some_and(|p| !p.tool.is_empty()));
        if !is_drawn {
            // what is typed of an answer or a condition is none of what the pointer finds
            self.drafting.finds.set(None);
            return;
        }
        match self.drafting.pointer.get_value() {
            Some(pointer) => self.draft_hover(&pointer),
            None if self.drafting.typed.with_untracked(|typed| typed.trim().is_empty()) => {
                self.drafting.finds.set(None);
                self.show_made(drawing::Drawing::default());
            }
            None => self.draft_hover(&Self::nowhere()),
        }
    }

    /// A pointer that finds nothing.
    fn nowhere() -> Pointer {
        Pointer { reach: -1.0, ..Pointer::default() }
    }

    /// A parameter's name is wanted where a value or a figure goes: at once where nothing is typed yet.
    fn draft_parameter(self, name: &str) {
        let is_typed = self.drafting.prompt.with_untracked(|p| {
            p.as_ref().is_some_and(|p| !matches!(p.wants, Wants::Otherwise | Wants::Older { .. }))
        });
        let is_bare = self.drafting.typed.with_untracked(String::is_empty);
        let is_condition = self.drafting.prompt.with_untracked(|p| {
            matches!(
                p.as_ref().map(|p| &p.wants),
                Some(Wants::Ends(Ends::Until | Ends::While) | Wants::Condition)
            )
        });
        if !is_typed {
            return;
        }
        self.drafting.typed.update(|typed| typed.push_str(name));
        self.draft_typed();
        if is_bare && !is_condition && !self.drafting.calculator.get_untracked() {
            self.draft_enter();
        }
    }

    /// Begins to take a measure by pointing.
    fn draft_measure(self, kind: MeasureKind) {
        let typed = self.drafting.typed.get_untracked();
        let prompt = self.tell(|session, id| session.begin_measure(id, kind));
        self.show_prompt_with(prompt.flatten(), typed);
    }

    fn take_turn(self, turn: Option<Result<Turn, Refusal>>) {
        match turn {
            Some(Ok(Turn::Wants(prompt))) => {
                self.notice.set(None);
                self.show_prompt(Some(prompt));
            }
            Some(Ok(Turn::Made { change, name, text, next })) => {
                let unit = change.unit.clone();
                self.settle(Some(Ok(*change)));
                self.drafting.calculator.set(false);
                self.drafting.pointer.set_value(None);
                self.show_prompt(next);
                self.drafting.turned.update(|n| *n += 1);
                let said = if text.is_empty() { name } else { format!("{name}: {text}") };
                let said = words::also(said, unit.as_deref());
                self.notice.set((!said.is_empty()).then_some(Notice::Said(said)));
            }
            Some(Err(refusal)) => {
                self.notice.set(Some(Notice::Refused(refusal)));
                if !self.drafting.typed.with_untracked(String::is_empty) {
                    // what was refused makes room for what is typed next
                    select_all(OPERAND);
                }
            }
            None => {}
        }
    }

    /// Takes the latest operand or answer back.
    pub fn draft_back(self) {
        self.tell(session::Session::back);
        self.show_waiting();
    }

    /// Gives up a measure that is being taken, and nothing of what was typed; returns whether one was.
    pub fn leave_measure(self) -> bool {
        let is_left = self.tell(session::Session::leave_measure) == Some(true);
        if is_left {
            let prompt = self.ask_of_shown(session::Session::prompt).flatten();
            self.show_prompt_with(prompt, self.drafting.typed.get_untracked());
        }
        is_left
    }

    /// Gives the construction up.
    pub fn draft_end(self) {
        let waited = self.drafts();
        self.tell(session::Session::give_up);
        // what was refused of it is no more; any other refusal stands
        if waited && self.notice.with_untracked(|notice| matches!(notice, Some(Notice::Refused(_))))
        {
            self.notice.set(None);
        }
        self.drafting.calculator.set(false);
        self.drafting.banding.set(false);
        self.show_waiting();
    }

    /// Gives up the construction that waits, and those that wait for its outcome.
    pub fn end_constructions(self) {
        let waits = |prompt: &Option<Prompt>| prompt.as_ref().is_some_and(|p| !p.tool.is_empty());
        while self.drafting.prompt.with_untracked(waits) {
            self.draft_end();
        }
    }

    fn draw_guides(self, are_guides: bool) {
        self.tell(|session, id| session.draw_guides(id, are_guides));
        // the field has the keyboard again
        self.drafting.prompt.update(|prompt| {
            prompt.iter_mut().for_each(|prompt| prompt.is_guide = are_guides);
        });
    }

    /// Does something about a block that is demonstrated, and shows what is waited for then.
    fn about_block(
        self,
        run: impl FnOnce(&mut session::Session, DocumentId) -> Result<Change, Refusal>,
    ) {
        self.tell(session::Session::give_up);
        if self.settle(self.tell(run)) {
            self.notice.set(None);
        }
        self.show_waiting();
        keyboard::rest_at(".blocks button");
    }

    fn end_turn(self, ends: Ends) {
        self.tell(session::Session::give_up);
        let turn = self.tell(|session, id| session.end_turn(id, ends));
        self.take_turn(turn);
        self.drafting.turned.update(|n| *n += 1);
    }

    /// Asks for something that a session waits for then.
    fn ask_prompt(
        self,
        run: impl FnOnce(&mut session::Session, DocumentId) -> Result<Option<Prompt>, Refusal>,
    ) {
        self.tell(session::Session::give_up);
        if let Some(Err(refusal)) = self.tell(run) {
            self.notice.set(Some(Notice::Refused(refusal)));
        }
        self.show_waiting();
    }

    /// Begins a loop in what is recorded.
    pub fn record_repeat(self) {
        self.about_block(|session, id| session.begin_loop(id, ""));
    }

    /// Begins an `if` in what is recorded.
    pub fn record_if(self) {
        self.ask_prompt(session::Session::begin_choice);
    }

    /// The next drag is a rubber band.
    fn begin_band(self) {
        self.draft_end();
        self.drop_tool();
        self.drafting.banding.set(true);
        self.notice.set(Some(Notice::Said(words::BAND.into())));
    }

    /// Whether the next drag is a rubber band: one was asked for, or what waits takes sets.
    pub fn takes_band(self) -> bool {
        let takes_sets =
            |p: &Option<Prompt>| p.as_ref().is_some_and(|p| p.takes_sets && !p.tool.is_empty());
        self.drafting.banding.get_untracked() || self.drafting.prompt.with_untracked(takes_sets)
    }

    /// The rubber band is drawn: what is in it is a set.
    pub fn take_band(self, from: (f64, f64), to: (f64, f64)) {
        let is_asked = self.drafting.banding.get_untracked();
        self.drafting.banding.set(false);
        let (a, b) = (self.pointer_at(from, 0.0, true).at, self.pointer_at(to, 0.0, true).at);
        if !is_asked {
            let turn = self.tell(|session, id| session.point_all(id, (a, b)));
            self.take_turn(turn);
            return;
        }
        self.about_block(|session, id| session.begin_each(id, (a, b)));
    }

    /// Leaves what is under the pointer out of the set that a loop goes over, or takes it in; returns whether there is one.
    pub fn take_of_set_at(self, pointer: &Pointer) -> bool {
        let found = self.ask_of_shown(|session, id| session.of_set_at(id, pointer)).flatten();
        let Some(figure) = found else { return false };
        self.take_of_set(&figure);
        true
    }

    fn take_of_set(self, figure: &str) {
        self.settle(self.tell(|session, id| session.take_of_set(id, figure)));
        self.show_made(drawing::Drawing::default());
        self.drafting.turned.update(|n| *n += 1);
    }

    /// Shows the rubber band.
    pub fn show_band(self, from: (f64, f64), to: (f64, f64)) {
        let (a, b) = (self.pointer_at(from, 0.0, true).at, self.pointer_at(to, 0.0, true).at);
        let corner = |x, y| drawing::Point { x, y };
        let points = vec![corner(a.0, a.1), corner(b.0, a.1), corner(b.0, b.1), corner(a.0, b.1)];
        let element = drawing::Element {
            shape: drawing::Shape::Polyline { points, closed: true },
            style: drawing::Style { line: drawing::Line::Dashed, ..drawing::Style::default() },
            layer: drawing::Layer::Lines,
            tag: drawing::Tag(0),
        };
        self.show_made(drawing::Drawing { elements: vec![element], ..drawing::Drawing::default() });
    }

    /// Begins to change a part of what a step says; records the program again where that has ended.
    fn change_operand(self, steps: &StepsView, (step, slot): (&str, &str)) {
        let selected = self.selected.get_untracked();
        if !steps.is_recorded {
            self.record(&steps.program);
        }
        let selected = selected.as_deref();
        self.ask_prompt(|session, id| session.begin_change(id, (step, slot), selected));
        let says = self.drafting.prompt.with_untracked(|p| match p.as_ref()?.wants.clone() {
            Wants::Change(says) if p.as_ref()?.is_value => Some(says),
            _ => None,
        });
        // a value is changed from what it is; what is typed first takes its place
        if let Some(says) = says {
            self.drafting.typed.set(says);
            request_animation_frame(|| select_all(OPERAND));
        }
    }

    /// Defines a parameter, or says it anew; says of which class it is, where its example told.
    fn define_parameter(self) {
        let new = self.drafting.parameter.get_untracked();
        let defined = self.tell(|session, id| session.define_parameter(id, &new));
        let unit = defined.as_ref().and_then(|defined| defined.as_ref().ok()?.unit.clone());
        if !self.settle(defined) {
            return;
        }
        self.drafting.parameter.set(NewParameter::default());
        self.drafting.turned.update(|n| *n += 1);
        let steps = self.ask_of_shown(|session, id| session.steps(id, None)).flatten();
        let rows = steps.map(|steps| steps.parameters).unwrap_or_default();
        if let Some(row) = rows.into_iter().find(|row| row.name == new.name.trim()) {
            let ParameterRow { name, class, value, example, .. } = &row;
            let defined = words::defined(name, class, value, example);
            self.notice.set(Some(Notice::Said(words::also(defined, unit.as_deref()))));
        }
        // the keyboard goes on with the next one
        request_animation_frame(|| keyboard::focus("input[name='parameter']"));
    }

    /// Begins to say a parameter anew.
    fn change_parameter(self, row: &ParameterRow) {
        let row = row.clone();
        self.drafting.parameter.set(NewParameter {
            instead_of: row.name.clone(),
            name: row.name,
            example: row.example,
            class: row.class,
            prompt: row.prompt,
            range: row.range,
        });
        request_animation_frame(|| select_all("input[name='example']"));
    }

    fn remove_parameter(self) {
        let name = self.drafting.parameter.with_untracked(|new| new.instead_of.clone());
        if self.settle(self.tell(|session, id| session.remove_parameter(id, &name))) {
            self.drafting.parameter.set(NewParameter::default());
            self.drafting.turned.update(|n| *n += 1);
        }
        keyboard::rest_at("input[name='parameter']");
    }

    /// Gives the example its own values again.
    fn own_values(self) {
        self.settle(self.tell(session::Session::own_values));
        self.drafting.turned.update(|n| *n += 1);
    }

    /// Goes somewhere in the program that is recorded; returns whether there is such a place.
    fn visit(self, go: &Go) -> bool {
        self.tell(session::Session::give_up);
        let outcome = self.tell(|session, id| session.visit(id, go));
        let is_there = matches!(outcome, Some(Ok(())));
        self.notice.set(match outcome {
            Some(Err(refusal)) => Some(Notice::Refused(refusal)),
            Some(Ok(())) | None => None,
        });
        self.drafting.lit.set(None);
        self.show_waiting();
        is_there
    }

    fn replace_step(self, step: &str) {
        self.tell(session::Session::give_up);
        match self.tell(|session, id| session.begin_replace(id, step)) {
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            Some(Ok(name)) => self.notice.set(Some(Notice::Said(words::draw_anew(&name)))),
            None => {}
        }
        self.show_waiting();
    }

    /// Returns whether it was done.
    fn make_guide(self, (program, step): (&str, &str), is_guide: bool) -> bool {
        let done = self.tell(|session, id| session.make_guide(id, (program, step), is_guide));
        let is_done = self.settle(done);
        self.drafting.turned.update(|n| *n += 1);
        is_done
    }

    fn turn_step(self, program: &str, step: &str) {
        self.settle(self.tell(|session, id| session.turn_step_round(id, (program, step))));
        self.drafting.turned.update(|n| *n += 1);
    }

    /// Hands the user the values of a thing's parameters as a file.
    fn save_parameters(self, thing: &str) {
        match self.ask_of_shown(|session, id| session.parameter_table(id, thing)) {
            Some(Ok(table)) => js::download(&format!("{thing}.csv"), &table),
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }

    /// Lets a person choose a file with values of a thing's parameters.
    fn load_parameters(self, thing: String) {
        let took = Closure::once_into_js(move |_: String, table: String| {
            self.settle(self.tell(|s, id| s.read_parameter_table(id, &thing, &table)));
            self.drafting.turned.update(|n| *n += 1);
        });
        js::choose_file(".csv,text/csv,text/plain", took.unchecked_ref());
    }

    fn delete_step(self, step: &str) {
        self.tell(session::Session::give_up);
        let turn = self.tell(|session, id| session.begin_delete(id, step));
        self.take_turn(turn);
        self.drafting.turned.update(|n| *n += 1);
    }

    fn delete_along(self) {
        let turn = self.tell(session::Session::delete_along);
        self.take_turn(turn);
    }

    fn light_step(self, steps: &StepsView, row: &StepRow) {
        let drawing =
            self.id().map(|id| self.ask(|s| s.step_drawing(id, &steps.example, &row.path)));
        self.drafting.lit.set(Some(row.path.clone()));
        self.show_made(drawing.unwrap_or_default());
    }
}

/// What follows something else, and is made only once that has been painted: lists beside a picture.
pub(crate) fn once_painted<T: Default + PartialEq + Send + Sync + 'static>(
    track: impl Fn() + 'static,
    make: impl Fn() -> T + Copy + 'static,
) -> RwSignal<T> {
    let made = RwSignal::new(T::default());
    let is_due = StoredValue::new(false);
    Effect::new(move |_| {
        track();
        if is_due.get_value() {
            return;
        }
        is_due.set_value(true);
        js::after_painting(move || {
            // it may have gone from the page
            if is_due.try_set_value(false).is_some() {
                return;
            }
            let now = make();
            if made.try_with_untracked(|before| *before != now) == Some(true) {
                made.set(now);
            }
        });
    });
    made
}

/// The drawer of drawing: recording, its parameters and steps, and every construction in scope.
#[component]
pub fn Drawing(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let track = move || {
        lab.text.track();
        lab.values.track();
        lab.drafting.turned.track();
        lab.selected.track();
    };
    let ask = move |what: fn(&session::Session, DocumentId, Option<&str>) -> Option<StepsView>| {
        let selected = lab.selected.get_untracked();
        lab.id().and_then(|id| lab.ask(|session| what(session, id, selected.as_deref())))
    };
    let steps = Memo::new(move |_| {
        track();
        ask(session::Session::program_shown)
    });
    Effect::new(move |_| {
        lab.picture.track();
        let example = steps.with_untracked(|s| s.as_ref().map(|s| s.example.clone()));
        if let Some(example) = example {
            lab.show_made_anew(&example);
        }
    });
    Effect::new(move |_| {
        lab.drafting.turned.track();
        lab.foresee_turn(None);
    });
    let rows = once_painted(track, move || ask(session::Session::steps).unwrap_or_default());
    view! {
        <section class="panel drawing" aria-label=words::DRAW>
            <div class="scroll recorded">
                <recorder::Recorder lab=lab steps=steps />
                <Show when=move || steps.with(Option::is_some)>
                    <steps::Steps lab=lab steps=steps listed=rows />
                </Show>
            </div>
            <div class="scroll">
                <tools::Constructions lab=lab />
            </div>
        </section>
    }
}
