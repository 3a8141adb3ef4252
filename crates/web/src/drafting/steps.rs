//! The parameters and steps of a program.

use crate::lab::Lab;
use crate::{js, keyboard, words};
use leptos::prelude::*;
use session::drafting::view::{Go, ParameterRow, StepOperand, StepRow, StepsView};
use web_sys::Element;

/// The list of steps.
const LIST: &str = ".drawing .steps";

/// The parameters with their values, and the steps in words.
#[component]
pub fn Steps(
    /// The lab.
    lab: Lab,
    /// What is recorded, or selected.
    steps: Memo<Option<StepsView>>,
    /// The same with its steps, which come once the picture is painted.
    listed: RwSignal<StepsView>,
) -> impl IntoView {
    let view = move || steps.get().unwrap_or_default();
    let parameters = move || {
        let StepsView { example, at, is_recorded, .. } = view();
        let used = match (is_recorded, at) {
            (false, _) => Use::Tried,
            (true, None) => Use::Recorded,
            (true, Some(_)) => Use::Visited,
        };
        let one = |row| view! { <Parameter lab=lab example=example.clone() row=row used=used /> };
        view().parameters.into_iter().map(one).collect_view()
    };
    // each row with what it is of: of many only those that are others are made anew
    let rows = move || {
        let StepsView { rows, example, program, is_recorded, at, selected, .. } = listed.get();
        let one = |row: StepRow| {
            let (example, program) = (example.clone(), program.clone());
            let at = at.clone().filter(|at| *at == row.path);
            let selected = selected.clone().filter(|selected| *selected == row.path);
            let of =
                StepsView { example, program, is_recorded, at, selected, ..StepsView::default() };
            (of, row)
        };
        rows.into_iter().map(one).collect::<Vec<_>>()
    };
    Effect::new(move |seen: Option<Sight>| {
        let sight = listed.with(|s| Sight::of(s, lab.drafting.lit.get()));
        let shown = sight.since(seen.as_ref());
        if let Some(what) = shown {
            request_animation_frame(move || show(what));
        }
        let is_asked = lab.drafting.prompt.with_untracked(Option::is_some);
        if listed.with(|s| s.is_recorded) && !is_asked && !js::coarse() {
            // the rows are others now: who had the keyboard in one of them has it beside them
            keyboard::rest_at(".drawing [data-visit='step']");
        }
        sight
    });
    Effect::new(move |_| {
        listed.track();
        lab.drafting.lit.track();
        keyboard::one_stop(LIST);
    });
    let go = move |go: Go| move |_| _ = lab.visit(&go);
    let is_recorded = Memo::new(move |_| steps.with(|s| s.as_ref().is_some_and(|s| s.is_recorded)));
    let more = move |_| lab.record(&steps.get_untracked().unwrap_or_default().program);
    let visit = move || {
        match is_recorded.get() {
        true => view! {
            <div class="line visit" role="group" aria-label=words::VISIT>
                <button data-visit="start" title=words::VISIT_START on:click=go(Go::Start)>"|◀"</button>
                <button data-visit="back" title=words::VISIT_BACK on:click=go(Go::Back)>"◀"</button>
                <button data-visit="step" title=words::VISIT_STEP on:click=go(Go::Step)>"▶"</button>
                <button data-visit="in" title=words::VISIT_IN on:click=go(Go::In)>"↘"</button>
                <button data-visit="out" title=words::VISIT_OUT on:click=go(Go::Out)>"↗"</button>
                <button data-visit="end" title=words::VISIT_END on:click=go(Go::End)>"▶|"</button>
                <button data-visit="picked" title=words::VISIT_PICKED
                    aria-pressed=move || lab.drafting.seeking.get().to_string()
                    on:click=move |_| lab.seek()>{words::VISIT_UNTIL}</button>
            </div>
        }
        .into_any(),
        false => view! { <button data-draft="more" on:click=more>{words::RECORD_MORE}</button> }.into_any(),
    }
    };
    view! {
        // while one is recorded its name stands above
        <Show when=move || !is_recorded.get()>
            <h3>{move || words::steps_of(&view().program)}</h3>
        </Show>
        <div class="parameters">{parameters}</div>
        <Show when=move || !view().parameters.is_empty()>
            <div class="line values">
                <button data-draft="save-values" on:click=move |_| lab.save_parameters(&view().example)>{words::SAVE_VALUES}</button>
                <button data-draft="load-values" on:click=move |_| lab.load_parameters(view().example)>{words::LOAD_VALUES}</button>
            </div>
        </Show>
        {visit}
        <Show when=move || steps.with(|s| s.as_ref().is_some_and(|s| s.by_others))>
            <p class="line" role="status">{words::BY_OTHERS}
                <button data-visit="own" on:click=move |_| lab.own_values()>{words::OWN_VALUES}</button>
            </p>
        </Show>
        <ol class="steps" on:keydown=|e| keyboard::go_in(LIST, &e)>
            <For each=rows key=|one| format!("{one:?}") children=move |(steps, row)| view! { <Row lab=lab steps=steps row=row /> } />
        </ol>
    }
}

/// What of the steps a person looks at: where one of these changes, it comes into sight.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Sight {
    /// How many steps are recorded.
    recorded: usize,
    /// Where it is visited.
    at: Option<String>,
    /// Where the drawing ended early.
    failed: Option<String>,
    /// The step that drew what is selected.
    selected: Option<String>,
    /// The step that is lit.
    lit: Option<String>,
}

impl Sight {
    fn of(steps: &StepsView, lit: Option<String>) -> Self {
        let failed = steps.rows.iter().find(|row| row.why.is_some());
        Self {
            recorded: if steps.is_recorded { steps.rows.len() } else { 0 },
            at: steps.at.clone().filter(|_| steps.is_recorded),
            failed: failed.map(|row| row.path.clone()),
            selected: steps.selected.clone(),
            lit,
        }
    }

    /// Which rows, the first of which is shown, are of what is new in it.
    fn since(&self, seen: Option<&Self>) -> Option<&'static [&'static str]> {
        let is_new = |get: fn(&Self) -> &Option<String>| {
            get(self).is_some() && seen.is_none_or(|seen| get(seen) != get(self))
        };
        match seen {
            _ if is_new(|s| &s.failed) => Some(&[".steps li.failed"]),
            Some(seen) if (seen.recorded, &seen.at) != (self.recorded, &self.at) => {
                Some(&[".steps li.next", ".steps li:last-child"])
            }
            _ if is_new(|s| &s.selected) => Some(&[".steps li.selected"]),
            _ if is_new(|s| &s.lit) => Some(&[".steps li.lit"]),
            _ => None,
        }
    }
}

/// Brings a row into the list's frame; where it is not merely the last, into those around as well: what is recorded
/// scrolls where its parameters take much room, the drawer as a whole on narrow pages.
fn show(rows: &[&str]) {
    let found = |selector: &str| document().query_selector(selector).ok().flatten();
    let row = rows.iter().find_map(|row| Some((found(row)?, row.ends_with("last-child"))));
    if let Some((step, is_last)) = row {
        let frames = [LIST, ".drawing .recorded", ".drawer .drawing"];
        let wanted = if is_last { 1 } else { frames.len() };
        for frame in frames[..wanted].iter().filter_map(|frame| found(frame)) {
            bring_into(&frame, &step);
        }
    }
    // rows that come push down what has the keyboard
    let drawer = found(".drawer .drawing");
    let has_keyboard = document().active_element();
    if let Some((drawer, field)) = drawer.zip(has_keyboard).filter(|(d, f)| d.contains(Some(f))) {
        bring_into(&drawer, &field);
    }
}

/// Scrolls a frame so far that something in it is in sight, of what is higher than the frame its beginning.
fn bring_into(frame: &Element, what: &Element) {
    let (own, around) = (what.get_bounding_client_rect(), frame.get_bounding_client_rect());
    let above = own.top() - around.top();
    let below = (own.bottom() - around.bottom()).max(0.0);
    frame.set_scroll_top(frame.scroll_top() + below.min(above).round() as i32);
}

/// What a parameter's value is changed for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Use {
    /// The example of a program that nobody records.
    Tried,
    /// The example while more is recorded.
    Recorded,
    /// A visit.
    Visited,
}

/// A parameter: its name goes where a value is wanted, its value is typed. While the program is visited that is a value
/// of the visit.
#[component]
fn Parameter(lab: Lab, example: String, row: ParameterRow, used: Use) -> impl IntoView {
    let name = StoredValue::new(row.name.clone());
    let path = StoredValue::new(format!("{example}.{}", row.name));
    let wrong = RwSignal::new(None::<String>);
    let typed = move |e: leptos::ev::Event| {
        let typed = event_target_value(&e);
        let outcome = match used {
            Use::Tried | Use::Recorded => lab.set_typed_now(&path.get_value(), &typed),
            Use::Visited => match lab.tell(|s, id| s.visit_by(id, &[(name.get_value(), typed)])) {
                Some(Err(refusal)) => Err(refusal),
                done => {
                    lab.settle(done);
                    Ok(())
                }
            },
        };
        match outcome {
            Ok(()) => wrong.set(None),
            Err(refusal) => wrong.set(Some(refusal.in_a_line())),
        }
        lab.drafting.turned.update(|n| *n += 1);
    };
    let title = words::parameter_in_words(&row.class, &row.range, &row.prompt);
    let change = (used != Use::Tried).then(|| {
        let own = StoredValue::new(row.clone());
        let label = words::change_parameter(&row.name);
        view! {
            <button type="button" class="bare" data-parameter-change=row.name.clone() title=label.clone() aria-label=label
                on:click=move |_| own.with_value(|row| lab.change_parameter(row))>"✎"</button>
        }
    });
    // what a table allows is offered, and anything else is refused with the reason
    let choices = (!row.choices.is_empty()).then(|| {
        let list = format!("choices-{}", row.name);
        let options =
            row.choices.iter().map(|value| view! { <option value=value.clone()></option> });
        (list.clone(), view! { <datalist id=list>{options.collect_view()}</datalist> })
    });
    let (list, choices) = choices.unzip();
    view! {
        <span class="parameter">
            {choices}
            <button type="button" data-parameter=row.name.clone() title=title
                on:click=move |_| lab.draft_parameter(&name.get_value())><code>{row.name.clone()}</code></button>
            <input name=format!("value-{}", row.name) autocomplete="off" list=list aria-label=words::value_of_parameter(&row.name)
                prop:value=row.value on:change=typed
                aria-invalid=move || wrong.with(Option::is_some).to_string() />
            {change}
            {move || wrong.get().map(|why| view! { <span class="wrong" role="alert">{why}</span> })}
        </span>
    }
}

/// One step: what it does in words, and what it made.
#[component]
fn Row(lab: Lab, steps: StepsView, row: StepRow) -> impl IntoView {
    let asks = RwSignal::new(None::<Vec<String>>);
    let is_recorded = steps.is_recorded;
    let is_next = steps.at.as_deref() == Some(row.path.as_str());
    let is_selected = steps.selected.is_some();
    let is_failed = row.why.is_some();
    let own = StoredValue::new((steps, row.clone()));
    let path = row.path.clone();
    let is_lit = Memo::new(move |_| lab.drafting.lit.with(|lit| lit.as_ref() == Some(&path)));
    let light = move |_| own.with_value(|(steps, row)| lab.light_step(steps, row));
    let ask = move |_| {
        if is_recorded {
            own.with_value(|(_, row)| lab.delete_step(&row.path));
            return;
        }
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
    let replace = move |_| own.with_value(|(_, row)| lab.replace_step(&row.path));
    let turn = move |_| own.with_value(|(steps, row)| lab.turn_step(&steps.program, &row.path));
    let here = move |_| _ = own.with_value(|(_, row)| lab.visit(&Go::To(row.path.clone())));
    let can_replace = is_recorded && !row.is_block;
    let indent = format!("{}px", 14 * row.depth);
    let name = row.path.clone();
    view! {
        <li class:lit=is_lit class:guide=row.is_guide class:unmade=row.is_unmade class:next=is_next
            class:failed=is_failed class:selected=is_selected style:margin-left=indent data-step=name>
            <button class="bare step" title=row.formula aria-current=is_next.then_some("step") on:click=light>
                <b>{row.name}</b>" "{row.words}
                {row.value.map(|value| view! { <span class="quiet">{value}</span> })}
                {row.doubt.map(|doubt| view! { <span class="doubt">{doubt}</span> })}
                {row.why.map(|why| view! { <span class="why">{why}</span> })}
            </button>
            {is_recorded.then(|| view! {
                <button class="bare" data-step-visit="" title=words::VISIT_HERE aria-label=words::VISIT_HERE on:click=here>"⇥"</button>
            })}
            {can_replace.then(|| view! {
                <button class="bare" data-step-turn="" title=words::TURN_STEP aria-label=words::TURN_STEP on:click=turn>"⇄"</button>
                <button class="bare" data-step-replace="" title=words::REPLACE_STEP aria-label=words::REPLACE_STEP on:click=replace>"✎"</button>
            })}
            <button class="bare" data-step-delete="" title=words::DELETE_STEP aria-label=words::DELETE_STEP on:click=ask>"×"</button>
            {move || is_lit.get().then(|| own.with_value(|(steps, row)| view! {
                <Operands lab=lab steps=steps.clone() row=row.clone() />
            }))}
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

/// What a step says that can be changed by itself.
#[component]
fn Operands(lab: Lab, steps: StepsView, row: StepRow) -> impl IntoView {
    let program = steps.program.clone();
    let guide = (!row.is_block && !row.name.is_empty()).then(|| {
        let step = row.path.clone();
        let make = move |e: leptos::ev::Event| {
            let is_guide = event_target_checked(&e);
            if !lab.make_guide((&program, &step), is_guide) {
                // what was refused is seen as it is
                event_target::<web_sys::HtmlInputElement>(&e).set_checked(!is_guide);
            }
        };
        view! {
            <label title=words::GUIDE_HELP>
                <input type="checkbox" name="step-guide" prop:checked=row.is_guide on:change=make />{words::GUIDE}
            </label>
        }
    });
    let own = StoredValue::new((steps, row.path));
    let operands = Memo::new(move |_| {
        lab.values.track();
        // another turn may be visited
        lab.drafting.turned.track();
        // what is selected is of a turn, too
        let selected = lab.selected.get();
        let selected = selected.as_deref();
        let ask = |(steps, step): &(StepsView, String)| {
            lab.ask_of_shown(|s, id| s.step_operands(id, (&steps.example, step), selected))
        };
        own.with_value(ask).unwrap_or_default()
    });
    let one = move |operand: StepOperand| {
        let slot = operand.slot.clone();
        let change = move |_| {
            own.with_value(|(steps, step)| lab.change_operand(steps, (step, &slot)));
        };
        view! {
            <button class="bare" data-step-operand=operand.slot.clone() title=words::CHANGE_OPERAND on:click=change>
                {operand.slot.clone()}" "<code>{operand.says.clone()}</code>
                {operand.value.filter(|value| *value != operand.says).map(|value| view! { <span class="quiet">" = "{value}</span> })}
            </button>
        }
    };
    view! { <div class="operands">{move || operands.get().into_iter().map(one).collect_view()}{guide}</div> }
}
