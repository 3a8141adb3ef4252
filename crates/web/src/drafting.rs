//! Drawing by constructions: the prompt under the picture, the list of constructions, recording and its steps.

use crate::lab::{Lab, Notice};
use crate::words;
use leptos::html::Input;
use leptos::prelude::*;
use session::drafting::view::{
    ConstructionRow, LoopView, NewParameter, Prompt, RecurrenceQuestion, StepRow, StepsView, Turn,
};
use session::view::Pointer;

/// What of drafting the panels share.
#[derive(Clone, Copy, Debug)]
pub struct Drafting {
    /// What the construction that was begun waits for.
    pub prompt: RwSignal<Option<Prompt>>,
    /// What is typed of it.
    pub typed: RwSignal<String>,
    /// What the pointer finds for it, or why nothing.
    pub finds: RwSignal<Option<String>>,
    /// Whether what is drawn is for construction alone.
    pub guides: RwSignal<bool>,
    /// What is asked of the second turn of a loop.
    pub asks: RwSignal<Option<RecurrenceQuestion>>,
    /// The step that is lit.
    pub lit: RwSignal<Option<String>>,
    /// Counted up where recording begins or ends.
    pub turned: RwSignal<u32>,
}

impl Default for Drafting {
    /// Nothing is begun.
    fn default() -> Self {
        Self {
            prompt: RwSignal::new(None),
            typed: RwSignal::new(String::new()),
            finds: RwSignal::new(None),
            guides: RwSignal::new(false),
            asks: RwSignal::new(None),
            lit: RwSignal::new(None),
            turned: RwSignal::new(0),
        }
    }
}

impl Lab {
    /// Whether a construction waits for an operand, or a loop for an answer.
    pub fn drafts(self) -> bool {
        self.drafting.prompt.with_untracked(Option::is_some)
            || self.drafting.asks.with_untracked(Option::is_some)
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
                self.draw_guides(self.drafting.guides.get_untracked());
                self.show_prompt(Some(prompt));
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }

    fn show_prompt(self, prompt: Option<Prompt>) {
        let typed = match prompt.as_ref().and_then(|p| p.insert.clone()) {
            Some(measure) => self.drafting.typed.get_untracked() + &measure,
            None => String::new(),
        };
        self.drafting.typed.set(typed);
        self.drafting.finds.set(None);
        self.show_made(drawing::Drawing::default());
        self.drafting.prompt.set(prompt);
    }

    /// Shows something over the picture: what would be made, or what a step made.
    fn show_made(self, preview: drawing::Drawing) {
        self.tool_view.update(|view| view.preview = preview);
    }

    /// The pointer of the construction is elsewhere.
    pub fn draft_hover(self, pointer: &Pointer) {
        if self.drafting.asks.with_untracked(Option::is_some) {
            let found = self.tell(|session, id| session.object_at(id, pointer)).flatten();
            self.drafting.finds.set(found);
            return;
        }
        let typed = self.drafting.typed.get_untracked();
        let hover = self.tell(|session, id| session.hover(id, pointer, &typed));
        let Some(hover) = hover else { return };
        self.show_made(hover.ghost);
        let finds = match (hover.finds, hover.why) {
            (Some(finds), Some(why)) => Some(format!("{finds}: {why}")),
            (finds, _) => finds,
        };
        self.drafting.finds.set(finds);
    }

    /// Gives the operand under the pointer.
    pub fn draft_point(self, pointer: &Pointer) {
        if self.drafting.asks.with_untracked(Option::is_some) {
            if let Some(found) = self.tell(|session, id| session.object_at(id, pointer)).flatten() {
                self.answer(Some(&found), Some(pointer.at));
            }
            return;
        }
        let turn = self.tell(|session, id| session.point(id, pointer));
        self.take_turn(turn);
    }

    /// Gives what is typed.
    pub fn draft_enter(self) {
        let typed = self.drafting.typed.get_untracked();
        let turn = self.tell(|session, id| session.enter(id, &typed));
        self.take_turn(turn);
    }

    fn take_turn(self, turn: Option<Result<Turn, session::view::Refusal>>) {
        match turn {
            Some(Ok(Turn::Wants(prompt))) => {
                self.notice.set(None);
                self.show_prompt(Some(prompt));
            }
            Some(Ok(Turn::Made { change, name, text, next })) => {
                self.settle(Some(Ok(*change)));
                self.show_prompt(Some(next));
                self.notice.set(Some(Notice::Said(format!("{name}: {text}"))));
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }

    /// Takes the latest operand back.
    pub fn draft_back(self) {
        let prompt = self.tell(session::Session::back);
        self.show_prompt(prompt.flatten());
    }

    /// Gives the construction up.
    pub fn draft_end(self) {
        self.tell(session::Session::give_up);
        self.show_prompt(None);
    }

    fn draw_guides(self, are_guides: bool) {
        self.drafting.guides.set(are_guides);
        self.tell(|session, id| session.draw_guides(id, are_guides));
    }

    fn record(self, name: &str) {
        self.flush_text();
        self.draft_end();
        if self.settle(self.tell(|session, id| session.record(id, name))) {
            self.drafting.turned.update(|n| *n += 1);
        }
    }

    fn stop_recording(self) {
        self.draft_end();
        self.tell(session::Session::stop_recording);
        self.drafting.asks.set(None);
        self.drafting.lit.set(None);
        self.show_made(drawing::Drawing::default());
        self.drafting.turned.update(|n| *n += 1);
    }

    fn begin_loop(self, name: &str) {
        self.draft_end();
        self.settle(self.tell(|session, id| session.begin_loop(id, name)));
        self.drafting.turned.update(|n| *n += 1);
    }

    fn end_turn(self) {
        self.draft_end();
        let asked = self.tell(session::Session::end_turn);
        self.ask_next(asked);
    }

    fn answer(self, answer: Option<&str>, at: Option<(f64, f64)>) {
        let asked = self.tell(|session, id| session.answer_recurrence(id, answer, at));
        self.ask_next(asked);
    }

    fn ask_next(self, asked: Option<Result<Option<RecurrenceQuestion>, session::view::Refusal>>) {
        match asked {
            Some(Ok(question)) => {
                self.notice.set(None);
                self.drafting.finds.set(None);
                self.drafting.asks.set(question);
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
        self.drafting.turned.update(|n| *n += 1);
    }

    fn close_loop(self, ends: &str) {
        self.settle(self.tell(|session, id| session.close_loop(id, ends)));
        self.drafting.turned.update(|n| *n += 1);
    }

    fn light_step(self, steps: &StepsView, row: &StepRow) {
        let drawing =
            self.id().map(|id| self.ask(|s| s.step_drawing(id, &steps.example, &row.path)));
        self.drafting.lit.set(Some(row.path.clone()));
        self.show_made(drawing.unwrap_or_default());
    }
}

/// The prompt of the construction that waits, over the lower edge of the picture.
#[component]
pub fn PromptLine(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let drafting = lab.drafting;
    let field = NodeRef::<Input>::new();
    Effect::new(move |_| {
        drafting.prompt.track();
        if let Some(field) = field.get() {
            // The keyboard types the operand that is wanted.
            let _ = field.focus();
        }
    });
    let operands = move || {
        let prompt = drafting.prompt.get().unwrap_or_default();
        let is_next = prompt.operands.iter().position(|(_, given)| given.is_none());
        let one = |(i, (name, given)): (usize, (String, Option<String>))| {
            view! {
                <span class="operand" class:next=is_next == Some(i)>
                    {name}{given.map(|given| view! { " "<code>{given}</code> })}
                </span>
            }
        };
        prompt.operands.into_iter().enumerate().map(one).collect_view()
    };
    view! {
        <Show when=move || drafting.prompt.with(Option::is_some)>
            <form class="strip prompt" aria-label=words::CONSTRUCTION
                on:submit=move |e| { e.prevent_default(); lab.draft_enter(); }>
                <b>{move || drafting.prompt.with(|p| p.as_ref().map(|p| p.label.clone()))}</b>
                {operands}
                <input node_ref=field name="operand" autocomplete="off" aria-label=words::OPERAND
                    placeholder=words::OPERAND
                    prop:value=move || drafting.typed.get()
                    on:input=move |e| drafting.typed.set(event_target_value(&e))
                    on:keydown=move |e| {
                        if e.key() == "Escape" {
                            e.prevent_default();
                            e.stop_propagation();
                            lab.draft_end();
                        }
                    } />
                <label><input type="checkbox" name="guide" prop:checked=move || drafting.guides.get()
                    on:change=move |e| lab.draw_guides(event_target_checked(&e)) />{words::GUIDE}</label>
                <button type="button" data-draft="back" on:click=move |_| lab.draft_back()>{words::BACK}</button>
                <button type="button" data-draft="end" on:click=move |_| lab.draft_end()>{words::GIVE_UP}</button>
                <span class="finds" aria-live="polite">{move || drafting.finds.get()}</span>
            </form>
        </Show>
    }
}

/// The drawer of drawing: recording, its parameters and steps, and every construction in scope.
#[component]
pub fn Drawing(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let steps = Memo::new(move |_| {
        lab.text.track();
        lab.values.track();
        lab.drafting.turned.track();
        let selected = lab.selected.get();
        lab.id().and_then(|id| lab.ask(|session| session.steps(id, selected.as_deref())))
    });
    view! {
        <section class="panel drawing" aria-label=words::DRAW>
            <div class="scroll">
                <Recorder lab=lab steps=steps />
                <Show when=move || steps.with(Option::is_some)>
                    <Steps lab=lab steps=steps />
                </Show>
                <Constructions lab=lab />
            </div>
        </section>
    }
}

/// Begins and ends recording, and defines parameters.
#[component]
fn Recorder(lab: Lab, steps: Memo<Option<StepsView>>) -> impl IntoView {
    let name = RwSignal::new(String::new());
    let recorded = Memo::new(move |_| {
        steps.with(|s| s.as_ref().filter(|s| s.is_recorded).map(|s| s.program.clone()))
    });
    let begin = move |e: leptos::ev::SubmitEvent| {
        e.prevent_default();
        lab.record(&name.get_untracked());
    };
    view! {
        {move || match recorded.get() {
            Some(program) => view! {
                <p class="recording" role="status">
                    <span class="lamp" aria-hidden="true"></span>{words::recording(&program)}
                    <button data-draft="stop" on:click=move |_| lab.stop_recording()>{words::STOP}</button>
                </p>
                <Define lab=lab />
                <Repeat lab=lab steps=steps />
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

/// A loop by demonstration: begun, its turn drawn, the second turn asked for, closed.
#[component]
fn Repeat(lab: Lab, steps: Memo<Option<StepsView>>) -> impl IntoView {
    let typed = RwSignal::new(String::new());
    let open = Memo::new(move |_| steps.with(|s| s.as_ref().and_then(|s| s.open_loop.clone())));
    let field = move |label: &'static str| {
        view! {
            <input name="loop" autocomplete="off" placeholder=label aria-label=label
                on:input=move |e| typed.set(event_target_value(&e)) />
        }
    };
    let go = move |e: &leptos::ev::SubmitEvent, run: &dyn Fn(&str)| {
        e.prevent_default();
        run(&typed.get_untracked());
        typed.set(String::new());
    };
    move || {
        match open.get() {
        None => view! {
            <form class="line" aria-label=words::REPEAT
                on:submit=move |e| go(&e, &|name| lab.begin_loop(name))>
                {field(words::LOOP_NAME)}
                <button data-draft="repeat">{words::REPEAT}</button>
            </form>
        }
        .into_any(),
        Some(LoopView { name, is_drawn: false, .. }) => view! {
            <p class="line asked">
                {words::first_turn(&name)}
                <button class="primary" data-draft="turn" on:click=move |_| lab.end_turn()>{words::END_TURN}</button>
            </p>
        }
        .into_any(),
        Some(LoopView { question: Some(question), .. }) => view! {
            <form class="line asked" aria-label=words::SECOND_TURN
                on:submit=move |e| go(&e, &|answer| lab.answer(Some(answer), None))>
                <p role="status">{words::recurrence(&question)}</p>
                <button type="button" class="primary" data-draft="same" on:click=move |_| lab.answer(None, None)>{words::THE_SAME}</button>
                {field(words::OTHER)}
                <button data-draft="other">{words::ANSWER}</button>
                <p class="quiet" aria-live="polite">{move || lab.drafting.finds.get()}</p>
            </form>
        }
        .into_any(),
        Some(LoopView { name, .. }) => view! {
            <form class="line asked" aria-label=words::ENDS
                on:submit=move |e| go(&e, &|ends| lab.close_loop(ends))>
                <p role="status">{words::loop_ends(&name)}</p>
                {field(words::ENDS)}
                <button class="primary" data-draft="close">{words::CLOSE_LOOP}</button>
            </form>
        }
        .into_any(),
    }
    }
}

/// Defines a parameter by its example.
#[component]
fn Define(lab: Lab) -> impl IntoView {
    let new = RwSignal::new(NewParameter::default());
    let define = move |e: leptos::ev::SubmitEvent| {
        e.prevent_default();
        let parameter = new.get_untracked();
        if lab.settle(lab.tell(|session, id| session.define_parameter(id, &parameter))) {
            new.set(NewParameter::default());
        }
    };
    view! {
        <form class="line" aria-label=words::DEFINE on:submit=define>
            <input name="parameter" autocomplete="off" placeholder=words::PARAMETER_NAME
                aria-label=words::PARAMETER_NAME prop:value=move || new.with(|n| n.name.clone())
                on:input=move |e| new.update(|n| n.name = event_target_value(&e)) />
            <input name="example" autocomplete="off" placeholder=words::EXAMPLE aria-label=words::EXAMPLE
                prop:value=move || new.with(|n| n.example.clone())
                on:input=move |e| new.update(|n| n.example = event_target_value(&e)) />
            <input name="question" autocomplete="off" placeholder=words::QUESTION aria-label=words::QUESTION
                prop:value=move || new.with(|n| n.prompt.clone())
                on:input=move |e| new.update(|n| n.prompt = event_target_value(&e)) />
            <button data-draft="define">{words::DEFINE}</button>
        </form>
    }
}

/// The parameters and steps of a program.
#[component]
fn Steps(lab: Lab, steps: Memo<Option<StepsView>>) -> impl IntoView {
    let view = move || steps.get().unwrap_or_default();
    let parameters = move || {
        let one = |row: session::drafting::view::ParameterRow| {
            let (name, label) = (row.name.clone(), row.name.clone());
            let take = move |_| {
                if lab.drafts() {
                    lab.drafting.typed.update(|typed| typed.push_str(&name));
                }
            };
            view! {
                <button class="parameter" data-parameter=label title=row.prompt on:click=take>
                    <code>{row.name}</code>" "<span class="quiet">{row.value}</span>
                </button>
            }
        };
        view().parameters.into_iter().map(one).collect_view()
    };
    let rows = move || {
        let all = view();
        let one = |row: StepRow| view! { <Row lab=lab steps=all.clone() row=row /> };
        all.rows.clone().into_iter().map(one).collect_view()
    };
    view! {
        <h3>{move || words::steps_of(&view().program)}</h3>
        <p class="parameters">{parameters}</p>
        <ol class="steps">{rows}</ol>
    }
}

/// One step: what it does in words, and what it made.
#[component]
fn Row(lab: Lab, steps: StepsView, row: StepRow) -> impl IntoView {
    let asks = RwSignal::new(None::<Vec<String>>);
    let own = StoredValue::new((steps, row.clone()));
    let path = row.path.clone();
    let is_lit = Memo::new(move |_| lab.drafting.lit.with(|lit| lit.as_ref() == Some(&path)));
    let light = move |_| own.with_value(|(steps, row)| lab.light_step(steps, row));
    let ask = move |_| {
        let found = own.with_value(|(steps, row)| {
            lab.id().map(|id| lab.ask(|s| s.step_dependents(id, &steps.program, &row.path)))
        });
        asks.set(found);
    };
    let delete = move |_| {
        asks.set(None);
        own.with_value(|(steps, row)| {
            lab.show_made(drawing::Drawing::default());
            lab.settle(lab.tell(|s, id| s.delete_step(id, &steps.program, &row.path)));
        });
    };
    let indent = format!("{}px", 14 * row.depth);
    let is_inner = row.depth > 0;
    let name = row.path.clone();
    let last = row.path.rsplit('.').next().unwrap_or_default().to_string();
    view! {
        <li class:lit=is_lit class:guide=row.is_guide style:margin-left=indent data-step=name>
            <button class="bare step" title=row.formula on:click=light>
                <b>{last}</b>" "{row.words}
                {row.value.map(|value| view! { <span class="quiet">{value}</span> })}
            </button>
            {(!is_inner).then(|| view! {
                <button class="bare" title=words::DELETE_STEP aria-label=words::DELETE_STEP on:click=ask>"×"</button>
            })}
            {move || asks.get().map(|along| view! {
                <p class="along" role="alertdialog">
                    {words::deleted_along(&along)}
                    <button data-draft="delete" on:click=delete>{words::DELETE_STEP}</button>
                    <button class="bare" on:click=move |_| asks.set(None)>{words::CANCEL}</button>
                </p>
            })}
        </li>
    }
}

/// Every construction in scope, by the class of what it makes.
#[component]
fn Constructions(lab: Lab) -> impl IntoView {
    let wanted = RwSignal::new(String::new());
    let all = Memo::new(move |_| {
        lab.text.track();
        lab.drafting.turned.track();
        lab.id().map(|id| lab.ask(|session| session.constructions(id))).unwrap_or_default()
    });
    let shelves = move || {
        let wanted = wanted.get().to_lowercase();
        let mut shelves: Vec<(String, Vec<ConstructionRow>)> = Vec::new();
        for row in all.get() {
            let text = format!("{} {} {}", row.label, row.operands, row.doc).to_lowercase();
            if !wanted.split_whitespace().all(|word| text.contains(word)) {
                continue;
            }
            match shelves.iter_mut().find(|(class, _)| *class == row.class) {
                Some((_, shelf)) => shelf.push(row),
                None => shelves.push((row.class.clone(), vec![row])),
            }
        }
        let shelf = |(class, rows): (String, Vec<ConstructionRow>)| {
            view! {
                <h3>{class}</h3>
                <ul class="constructions">
                    {rows.into_iter().map(|row| view! { <Construction lab=lab row=row /> }).collect_view()}
                </ul>
            }
        };
        shelves.into_iter().map(shelf).collect_view()
    };
    view! {
        <input type="search" placeholder=words::FILTER aria-label=words::FILTER_CONSTRUCTIONS
            on:input=move |e| wanted.set(event_target_value(&e)) />
        {shelves}
    }
}

#[component]
fn Construction(lab: Lab, row: ConstructionRow) -> impl IntoView {
    let id = StoredValue::new(row.id.clone());
    let held = Memo::new(move |_| {
        lab.drafting.prompt.with(|p| p.as_ref().is_some_and(|p| p.tool == id.get_value()))
    });
    view! {
        <li>
            <button data-construction=row.id title=row.doc aria-pressed=move || held.get().to_string()
                on:click=move |_| lab.begin_construction(&id.get_value())>
                {row.label}" "<span class="quiet">{row.operands}</span>
            </button>
        </li>
    }
}
