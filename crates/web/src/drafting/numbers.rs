//! A step's numbers on the drawing, as dimensions: of the step that is lit or visited, or that drew what is selected.
//! A double click, or Enter, types another.

use crate::lab::{Lab, Notice};
use crate::words;
use drawing::Point;
use leptos::html::Input;
use leptos::prelude::*;
use presentation::annotations::beyond;
use session::Session;
use session::drafting::view::StepOperand;

/// A step of a thing's program: the thing, and the step's address.
type Of = (String, String);

/// The numbers of a step, each where it belongs on the sheet.
#[component]
pub fn StepNumbers(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let of = Memo::new(move |_| step_shown(lab));
    let numbers = Memo::new(move |_| {
        lab.values.track();
        lab.text.track();
        // another turn may be visited
        lab.drafting.turned.track();
        let (example, step) = of.get()?;
        let selected = lab.selected.get();
        let all = lab.ask_of_shown(|session, id| {
            let selected = selected.as_deref();
            session.step_operands(id, (&example, &step), selected)
        });
        Some(all.unwrap_or_default().into_iter().filter(|o| o.at.is_some()).collect::<Vec<_>>())
    });
    let one = move |(nth, number): (usize, StepOperand)| {
        view! { <Number lab=lab of=of.get_untracked().unwrap_or_default() nth=nth number=number /> }
    };
    let lines = move || {
        let all = numbers.get().unwrap_or_default();
        let view = lab.view.get();
        let line = |number: StepOperand| {
            let [a, b] = number.along?.map(|(x, y)| view.screen_from_sheet(Point { x, y }));
            Some(
                view! { <line x1=a.0 y1=a.1 x2=b.0 y2=b.1 marker-start="url(#step-arrow)" marker-end="url(#step-arrow)" /> },
            )
        };
        all.into_iter().filter_map(line).collect_view()
    };
    // while something is dragged they would stand where they were
    let is_any = Memo::new(move |_| {
        let rests = lab.dragging.with(Option::is_none);
        rests && numbers.with(|all| all.as_ref().is_some_and(|all| !all.is_empty()))
    });
    view! {
        <Show when=move || is_any.get()>
            <svg class="step-lines" aria-hidden="true">
                <marker id="step-arrow" viewBox="0 0 10 10" refX="10" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse">
                    <path d="M0 1 L10 5 L0 9 Z" />
                </marker>
                {lines}
            </svg>
            {move || numbers.get().unwrap_or_default().into_iter().enumerate().map(one).collect_view()}
        </Show>
    }
}

/// The step whose numbers are shown.
fn step_shown(lab: Lab) -> Option<Of> {
    lab.drafting.turned.track();
    let selected = lab.selected.get();
    if let Some(lit) = lab.drafting.lit.get() {
        let shown = |session: &Session, id| session.program_shown(id, selected.as_deref());
        return Some((lab.ask_of_shown(shown).flatten()?.example, lit));
    }
    if lab.drafting.prompt.with(Option::is_some) {
        return None;
    }
    if let Some(next) = lab.ask_of_shown(Session::step_next).flatten() {
        return Some(next);
    }
    lab.ask_of_shown(|session, id| session.step_of(id, selected.as_deref()?)).flatten()
}

/// One number.
#[component]
fn Number(lab: Lab, of: Of, nth: usize, number: StepOperand) -> impl IntoView {
    let is_typed = RwSignal::new(false);
    let field = NodeRef::<Input>::new();
    let at = number.at.unwrap_or_default();
    let along = number.along;
    let place = move || {
        let view = lab.view.get();
        let on_screen = |(x, y)| view.screen_from_sheet(Point { x, y });
        along.map(|ends| ends.map(on_screen)).and_then(beyond).unwrap_or_else(|| on_screen(at))
    };
    let label = format!("{} {}", number.slot, number.value.clone().unwrap_or_default());
    let slot = number.slot.clone();
    let says = StoredValue::new(number.says.clone());
    let own = StoredValue::new((of, number.slot));
    Effect::new(move |_| {
        if let Some(field) = field.get() {
            // the keyboard types over what it says
            field.set_value(&says.get_value());
            let _ = field.focus();
            field.select();
        }
    });
    let give = move |typed: &str| {
        is_typed.set(false);
        let ((example, step), slot) = own.get_value();
        let change = lab.tell(|s, id| s.set_operand(id, (&example, &step, &slot), typed));
        match change {
            Some(Err(refusal)) => lab.notice.set(Some(Notice::Refused(refusal))),
            done => {
                lab.settle(done);
            }
        }
        lab.drafting.turned.update(|n| *n += 1);
    };
    let key = move |e: leptos::ev::KeyboardEvent| match e.key().as_str() {
        "Enter" => {
            e.prevent_default();
            e.stop_propagation();
            give(&event_target_value(&e));
        }
        "Escape" => {
            e.stop_propagation();
            is_typed.set(false);
        }
        _ => {}
    };
    // what lies below is picked while a construction waits for it
    let waits = move || lab.drafting.prompt.with(Option::is_some);
    view! {
        <div class="step-number" class:passed=waits style:left=move || format!("{}px", place().0)
            style:top=move || format!("{}px", place().1 + 24.0 * nth as f64)>
            <Show when=move || is_typed.get() fallback=move || {
                let (label, slot) = (label.clone(), slot.clone());
                view! {
                    <button data-step-number=slot title=move || words::typed_anew(&says.get_value())
                        on:dblclick=move |_| is_typed.set(true)
                        on:keydown=move |e| if e.key() == "Enter" { e.prevent_default(); is_typed.set(true); }>{label}</button>
                }
            }>
                <input node_ref=field name="step-number" autocomplete="off" aria-label=words::STEP_NUMBER
                    prop:value=says.get_value() on:keydown=key on:blur=move |_| is_typed.set(false) />
            </Show>
        </div>
    }
}
