//! What is waited for, over the lower edge of the picture.

use super::calculator::Calculator;
use crate::lab::Lab;
use crate::marked::marked;
use crate::{js, keyboard, words};
use leptos::html::Input;
use leptos::prelude::*;
use session::drafting::view::{OlderUse, Prompt, Wants};

/// The prompt of what waits: an operand, an answer, a condition.
#[component]
pub fn PromptLine(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let drafting = lab.drafting;
    let field = NodeRef::<Input>::new();
    // who had the keyboard before has it again
    let waits = Memo::new(move |_| drafting.prompt.with(Option::is_some));
    Effect::new(move |before: Option<Option<web_sys::Element>>| match waits.get() {
        true => before.flatten().or_else(keyboard::holder),
        false => {
            if let Some(before) = before {
                keyboard::give_back(before);
            }
            None
        }
    });
    Effect::new(move |_| {
        drafting.prompt.track();
        // a keyboard on the screen would hide what is picked
        if let Some(field) = field.get().filter(|_| !js::coarse()) {
            // The keyboard types what is wanted.
            let _ = field.focus();
        }
    });
    // where nothing is typed, the keyboard answers by the buttons
    let is_chosen = Memo::new(move |_| {
        let is = |p: &Prompt| matches!(p.wants, Wants::Otherwise | Wants::Older { .. });
        drafting.prompt.with(|p| p.as_ref().is_some_and(is))
    });
    Effect::new(move |_| {
        if is_chosen.get() && !js::coarse() {
            request_animation_frame(|| keyboard::focus(".prompt button.primary"));
        }
    });
    let of =
        move |ask: &dyn Fn(&Prompt) -> bool| drafting.prompt.with(|p| p.as_ref().is_some_and(ask));
    let is_drawn = move || of(&|p| !p.tool.is_empty());
    let is_value = move || of(&|p| p.is_value);
    let is_typed = move || of(&|p| !matches!(p.wants, Wants::Otherwise | Wants::Older { .. }));
    let goes_wider = Memo::new(move |_| of(&|p| p.goes_wider));
    let key = move |e: leptos::ev::KeyboardEvent| match e.key().as_str() {
        "Escape" => {
            e.prevent_default();
            e.stop_propagation();
            lab.draft_end();
        }
        // the keyboard goes on where nothing is under the pointer
        "Tab"
            if !e.shift_key()
                && goes_wider.get_untracked()
                && drafting.finds.with_untracked(Option::is_some) =>
        {
            e.prevent_default();
            lab.draft_wider();
        }
        _ => {}
    };
    view! {
        <Show when=move || drafting.prompt.with(Option::is_some)>
            <form class="strip prompt" aria-label=words::CONSTRUCTION
                on:submit=move |e| { e.prevent_default(); lab.draft_enter(); }>
                <Show when=move || drafting.calculator.get() && is_value()>
                    <Calculator lab=lab />
                </Show>
                <b>{move || drafting.prompt.with(|p| p.as_ref().map(|p| p.label.clone()))}</b>
                <Operands lab=lab />
                <span class="wanted" role="status">{move || drafting.prompt.with(|p| p.as_ref().map(|p| marked(&p.words)))}</span>
                <Show when=is_typed>
                    <input node_ref=field name="operand" autocomplete="off" aria-label=words::OPERAND
                        placeholder=words::OPERAND
                        prop:value=move || drafting.typed.get()
                        on:input=move |e| {
                            drafting.typed.set(event_target_value(&e));
                            lab.draft_typed();
                        }
                        on:keydown=key />
                </Show>
                <Parameters lab=lab />
                <Show when=is_value>
                    <button type="button" data-draft="calculator" aria-pressed=move || drafting.calculator.get().to_string()
                        on:click=move |_| drafting.calculator.update(|open| *open = !*open)>{words::CALCULATOR}</button>
                </Show>
                <Answers lab=lab />
                <Show when=move || goes_wider.get()>
                    <button type="button" data-draft="wider" on:click=move |_| lab.draft_wider()>
                        {move || if lab.touch.get() { words::WIDER } else { words::WIDER_BY_KEY }}</button>
                </Show>
                <Show when=is_drawn>
                    <label><input type="checkbox" name="guide" prop:checked=move || of(&|p| p.is_guide)
                        on:change=move |e| lab.draw_guides(event_target_checked(&e)) />{words::GUIDE}</label>
                </Show>
                <Show when=is_drawn>
                    <button type="button" data-draft="turn" title=words::OTHER_SOLUTION_HELP
                        on:click=move |_| lab.draft_turn()>{words::OTHER_SOLUTION}</button>
                </Show>
                <button type="button" data-draft="back" on:click=move |_| lab.draft_back()>{words::BACK}</button>
                <Show when=is_drawn>
                    <button type="button" data-draft="end" on:click=move |_| lab.draft_end()>{words::GIVE_UP}</button>
                </Show>
                <span class="finds" aria-live="polite">{move || drafting.finds.get()}</span>
            </form>
        </Show>
    }
}

/// The operands of what is drawn, the next one marked.
#[component]
fn Operands(lab: Lab) -> impl IntoView {
    move || {
        let prompt = lab.drafting.prompt.get().unwrap_or_default();
        let is_next = prompt.operands.iter().position(|(_, given)| given.is_none());
        let one = |(i, (name, given)): (usize, (String, Option<String>))| {
            view! {
                <span class="operand" class:next=is_next == Some(i)>
                    {name}{given.map(|given| view! { " "<code>{given}</code> })}
                </span>
            }
        };
        prompt.operands.into_iter().enumerate().map(one).collect_view()
    }
}

/// The values that are allowed, where they are few, and the parameters that may be the value that is wanted.
#[component]
fn Parameters(lab: Lab) -> impl IntoView {
    let parameters = Memo::new(move |_| {
        lab.drafting.turned.track();
        let is_value = lab.drafting.prompt.with(|p| p.as_ref().is_some_and(|p| p.is_value));
        let names = || lab.ask_of_shown(session::Session::value_parameters).unwrap_or_default();
        if is_value { names() } else { Vec::new() }
    });
    let choices = Memo::new(move |_| {
        lab.drafting.prompt.with(|p| p.as_ref().map_or_else(Vec::new, |p| p.choices.clone()))
    });
    let parameter = move |name: String| {
        let own = StoredValue::new(name.clone());
        let title = words::value_of_parameter(&name);
        view! {
            <button type="button" class="value" data-value=name.clone() title=title
                on:click=move |_| lab.draft_parameter(&own.get_value())><code>{name.clone()}</code></button>
        }
    };
    let choice = move |value: String| {
        let own = StoredValue::new(value.clone());
        view! {
            <button type="button" class="value" data-choice=value.clone()
                on:click=move |_| lab.draft_parameter(&own.get_value())>{value.clone()}</button>
        }
    };
    view! {
        {move || choices.get().into_iter().map(choice).collect_view()}
        {move || parameters.get().into_iter().map(parameter).collect_view()}
    }
}

/// The buttons that answer what is asked.
#[component]
fn Answers(lab: Lab) -> impl IntoView {
    let drafting = lab.drafting;
    let is_drawn = move || drafting.prompt.with(|p| p.as_ref().is_some_and(|p| !p.tool.is_empty()));
    move || {
        match drafting.prompt.with(|p| p.as_ref().map(|p| p.wants.clone())) {
        Some(Wants::Recurrence(question)) if !is_drawn() => {
            let in_turn = question.in_turn.map(|answer| {
                view! {
                    <button type="button" class="primary" data-draft="each"
                        on:click=move |_| {
                            drafting.typed.set(answer.clone());
                            lab.draft_enter();
                        }>{words::EACH_IN_TURN}</button>
                }
            });
            view! {
                {in_turn}
                <button type="button" class="primary" data-draft="same"
                    on:click=move |_| lab.draft_same()>{words::THE_SAME}</button>
            }
            .into_any()
        }
        Some(Wants::Otherwise) => view! {
            <button type="button" class="primary" data-draft="here"
                on:click=move |_| lab.about_block(|s, id| s.other_branch(id, true))>{words::SAME_VALUES}</button>
            <button type="button" data-draft="others"
                on:click=move |_| lab.about_block(|s, id| s.other_branch(id, false))>{words::OTHER_VALUES}</button>
        }
        .into_any(),
        Some(Wants::Older { .. }) => view! {
            <button type="button" class="primary" data-draft="parameter"
                on:click=move |_| lab.take_older(OlderUse::Parameter)>{words::AS_PARAMETER}</button>
            <button type="button" data-draft="take-along"
                on:click=move |_| lab.take_older(OlderUse::Along)>{words::TAKE_ALONG}</button>
        }
        .into_any(),
        Some(Wants::Substitute { .. }) => view! {
            <button type="button" class="primary" data-draft="along"
                on:click=move |_| lab.delete_along()>{words::DELETE_TOO}</button>
        }
        .into_any(),
        Some(Wants::Ends(_)) => {
            view! { <button class="primary" data-draft="close">{words::CLOSE_LOOP}</button> }.into_any()
        }
        Some(Wants::Condition) => {
            view! { <button class="primary" data-draft="close">{words::DRAW_BRANCH}</button> }.into_any()
        }
        _ => ().into_any(),
    }
    }
}
