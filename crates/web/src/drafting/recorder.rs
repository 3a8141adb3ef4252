//! Begins and ends recording, defines parameters, and demonstrates blocks.

use super::parameter;
use crate::keyboard::{self, focus};
use crate::lab::{Drawer, Lab, Notice};
use crate::words;
use leptos::prelude::*;
use session::drafting::view::{Ends, NewParameter, OpenBlock, OpenKind, StepsView};

/// Recording, from its name to its end.
#[component]
pub fn Recorder(
    /// The lab.
    lab: Lab,
    /// What is recorded, or selected.
    steps: Memo<Option<StepsView>>,
) -> impl IntoView {
    let name = RwSignal::new(String::new());
    let recorded = Memo::new(move |_| {
        steps.with(|s| s.as_ref().filter(|s| s.is_recorded).map(|s| s.program.clone()))
    });
    let begin = move |e: leptos::ev::SubmitEvent| {
        e.prevent_default();
        lab.record(&name.get_untracked());
        request_animation_frame(|| focus("input[name='parameter']"));
    };
    let open =
        Memo::new(move |_| steps.with(|s| s.as_ref().map(|s| s.open.clone())).unwrap_or_default());
    view! {
        {move || match recorded.get() {
            Some(program) => view! {
                <p class="recording" role="status">
                    <span class="lamp" aria-hidden="true"></span>{words::recording(&program)}
                    <button data-draft="stop" on:click=move |_| lab.stop_recording()>{words::STOP}</button>
                </p>
                <parameter::Define lab=lab steps=steps />
                {move || view! { <Blocks lab=lab open=open.get() /> }}
            }.into_any(),
            None => view! {
                <form class="line" aria-label=words::RECORD on:submit=begin>
                    <input name="program" autocomplete="off" placeholder=words::PROGRAM_NAME
                        aria-label=words::PROGRAM_NAME
                        on:input=move |e| name.set(event_target_value(&e)) />
                    <button class="primary" data-draft="record">{words::RECORD}</button>
                </form>
            }.into_any(),
        }}
    }
}

/// The blocks that are demonstrated, and what can be begun.
#[component]
fn Blocks(lab: Lab, open: Vec<OpenBlock>) -> impl IntoView {
    let innermost = open.last().map(|block| block.kind);
    let set = open.last().map(|block| block.set.clone()).unwrap_or_default();
    let lines =
        open.into_iter().map(|block| view! { <p class="asked" role="status">{block.words}</p> });
    let button = |label: &'static str, mark: &'static str, run: Box<dyn Fn() + Send>| {
        let title = match mark {
            "repeat" | "if" => {
                crate::actions::named(&format!("record-{mark}")).keys.first().copied()
            }
            _ => None,
        };
        view! { <button data-draft=mark title=title on:click=move |_| run()>{label}</button> }
    };
    let turn = |label, mark, ends| button(label, mark, Box::new(move || lab.end_turn(ends)));
    let ends = match innermost {
        Some(OpenKind::Turn) => view! {
            {turn(words::UNTIL, "until", Ends::Until)}
            {turn(words::WHILE, "while", Ends::While)}
            {turn(words::TIMES, "times", Ends::Times)}
        }
        .into_any(),
        Some(OpenKind::Each) => turn(words::DONE_FOR_EACH, "until", Ends::Until).into_any(),
        Some(OpenKind::Then) => view! {
            {button(words::ELSE, "else", Box::new(move || lab.ask_prompt(session::Session::otherwise)))}
            {button(words::END_IF, "end-if", Box::new(move || lab.about_block(session::Session::end_choice)))}
        }
        .into_any(),
        Some(OpenKind::Otherwise) => {
            button(words::END_IF, "end-if", Box::new(move || lab.about_block(session::Session::end_choice)))
                .into_any()
        }
        Some(OpenKind::Asking | OpenKind::Visited) | None => ().into_any(),
    };
    let begins = (innermost != Some(OpenKind::Asking)).then(|| {
        view! {
            {button(words::REPEAT, "repeat", Box::new(move || lab.record_repeat()))}
            {button(words::IF, "if", Box::new(move || lab.record_if()))}
            {button(words::FOR_EACH, "for-each", Box::new(move || lab.begin_band()))}
        }
    });
    let member = |(name, is_in): (String, bool)| {
        let own = name.clone();
        view! {
            <button data-set=name.clone() aria-pressed=is_in.to_string() title=words::of_set(&name, is_in)
                on:click=move |_| lab.take_of_set(&own)>{name.clone()}</button>
        }
    };
    let set = (!set.is_empty()).then(|| view! {
        <div class="line set" role="group" aria-label=words::SET title=words::SET_HELP>{set.into_iter().map(member).collect_view()}</div>
    });
    view! {
        {lines.collect_view()}
        {set}
        <div class="line blocks">{ends}{begins}</div>
    }
}

impl Lab {
    pub(super) fn record(self, name: &str) {
        self.flush_text();
        self.draft_end();
        self.fits.set_value(false);
        if self.settle(self.tell(|session, id| session.record(id, name))) {
            self.show_waiting();
        }
    }

    /// Goes on recording where that was left, once its text is there again.
    pub fn return_to(self, left: &str) {
        let done = self.tell(|session, id| session.return_to(id, left));
        // in a text that was changed meanwhile there may be no such program: nothing is recorded then
        if let Some(Ok(_)) = &done {
            self.settle(done);
            self.open_drawer(Drawer::Draw);
            self.show_waiting();
        }
    }

    fn stop_recording(self) {
        self.draft_end();
        let steps = self.ask_of_shown(|session, id| session.steps(id, None)).flatten();
        match self.tell(session::Session::stop_recording) {
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            stopped => {
                self.settle(stopped);
                self.drafting.parameter.set(NewParameter::default());
                // its steps stay in sight, and its values to be tried
                self.select(steps.map(|steps| steps.example));
                self.drafting.lit.set(None);
                self.show_made(drawing::Drawing::default());
            }
        }
        self.drafting.turned.update(|n| *n += 1);
        self.keep_place();
        keyboard::rest_at("[data-draft='more'], input[name='program']");
    }
}
