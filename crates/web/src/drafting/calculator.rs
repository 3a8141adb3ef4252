//! The calculators, numeric and logical: expressions built by keys and by pointing at the drawing.

use crate::lab::Lab;
use crate::words;
use leptos::prelude::*;
use session::drafting::view::MeasureKind;

/// The measures that are taken by pointing.
const MEASURES: [(&str, MeasureKind); 7] = [
    ("radius", MeasureKind::Radius),
    ("length", MeasureKind::Length),
    ("distance", MeasureKind::Distance),
    ("angle", MeasureKind::Angle),
    ("x", MeasureKind::Across),
    ("y", MeasureKind::Up),
    ("area", MeasureKind::Area),
];

/// The keys, row by row: what is shown, and what is added to the expression.
const KEYS: [[(&str, &str); 7]; 4] = [
    [("7", "7"), ("8", "8"), ("9", "9"), ("÷", " / "), ("(", "("), (")", ")"), ("and", " and ")],
    [("4", "4"), ("5", "5"), ("6", "6"), ("×", " * "), ("<", " < "), ("≤", " <= "), ("or", " or ")],
    [
        ("1", "1"),
        ("2", "2"),
        ("3", "3"),
        ("−", " - "),
        (">", " > "),
        ("≥", " >= "),
        ("not", "not "),
    ],
    [
        ("0", "0"),
        (".", "."),
        ("°", " deg"),
        ("+", " + "),
        ("=", " = "),
        ("xⁿ", "^"),
        ("√", "sqrt("),
    ],
];

/// A calculator over what is typed: its value is shown after each key.
#[component]
pub fn Calculator(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let drafting = lab.drafting;
    let computed = Memo::new(move |_| {
        let typed = drafting.typed.get();
        let is_blank = typed.trim().is_empty();
        (!is_blank).then(|| lab.ask_of_shown(|session, id| session.compute(id, &typed))).flatten()
    });
    let change = move |how: &dyn Fn(&mut String)| {
        drafting.typed.update(how);
        lab.draft_typed();
    };
    let add = move |text: &str| change(&|typed| typed.push_str(text));
    let measures = MEASURES.map(|(label, kind)| {
        view! {
            <button type="button" class="measure" data-measure=label
                on:click=move |_| lab.draft_measure(kind)>{label}</button>
        }
    });
    let keys = KEYS.map(|row| {
        row.map(|(label, text)| {
            view! { <button type="button" data-key=label on:click=move |_| add(text)>{label}</button> }
        })
    });
    let take_back = move |_| {
        change(&|typed| {
            let short = typed.trim_end().char_indices().next_back().map_or(0, |(at, _)| at);
            typed.truncate(short);
        });
    };
    let keep = move |_| {
        let typed = drafting.typed.get_untracked();
        drafting.memory.set((!typed.trim().is_empty()).then_some(typed));
    };
    let recall = move |_| {
        if let Some(kept) = drafting.memory.get_untracked() {
            let is_plain = kept.chars().all(|c| c.is_alphanumeric() || "._[]".contains(c));
            add(&if is_plain { kept } else { format!("({kept})") });
        }
    };
    view! {
        <div class="calculator" role="group" aria-label=words::CALCULATOR>
            <output class="computed" aria-live="polite">
                {move || computed.get().map(|c| match c.value {
                    Some(value) => view! { <b>"= "{value}</b> }.into_any(),
                    None => view! { <span class="quiet">{c.why}</span> }.into_any(),
                })}
            </output>
            <div class="keys measures">{measures.into_iter().collect_view()}</div>
            <div class="keys">{keys.into_iter().flatten().collect_view()}</div>
            <div class="keys memory">
                <button type="button" data-key="M" title=words::KEEP on:click=keep>"M"</button>
                <button type="button" data-key="MR" title=move || drafting.memory.get().unwrap_or_default()
                    disabled=move || drafting.memory.with(Option::is_none) on:click=recall>"MR"</button>
                <button type="button" data-key="C" on:click=move |_| change(&String::clear)>"C"</button>
                <button type="button" data-key="⌫" aria-label=words::BACKSPACE on:click=take_back>"⌫"</button>
                <button class="primary" data-key="give">{words::GIVE}</button>
            </div>
        </div>
    }
}
