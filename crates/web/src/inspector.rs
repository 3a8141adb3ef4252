//! The inspector: what is selected, with its values, sliders and constraints; else what the document is given.

use crate::actions;
use crate::js;
use crate::lab::Lab;
use crate::marked::marked;
use crate::plot::ViewsOf;
use crate::values::{self, Place};
use crate::words;
use leptos::prelude::*;
use presentation::numbers::to_read;
use presentation::paths::covers;
use presentation::rows::{shown_rules, told_apart};
use presentation::sentences::formula;
use session::Command;
use session::view::{Offer, RowKind, StructureRow, ValueRow, ValueWithin};
use std::collections::BTreeSet;

/// At most so many values, and so many constraints, are shown at once; table and tree have the others.
const MOST: usize = 40;
/// So many rows are made in one go, and while a hand presses the picture one: each costs some milliseconds.
const AT_ONCE: usize = 4;

/// Which of the values a row is, and its path within what is inspected.
type Inspected = (usize, String);

/// The panel at the right.
#[component]
pub fn Inspector(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    Effect::new(move |_| {
        let path = lab.selected.get();
        let follow = move || {
            let is_so = lab.selected.with_untracked(|selected| *selected == path);
            if is_so && lab.inspected.with_untracked(|inspected| *inspected != path) {
                lab.inspected.set(path);
            }
        };
        lab.behind_hand(2, Box::new(follow));
    });
    let row = Memo::new(move |_| {
        let path = lab.inspected.get()?;
        let found = lab.structure.with(|rows| rows.iter().find(|row| row.path == path).cloned());
        found.or_else(|| computed_rows(lab, &path).into_iter().next())
    });
    let title = move || {
        let name = row
            .with(|row| row.as_ref().map(|row| lab.structure.with(|rows| told_apart(row, rows))));
        let several = lab.also.with(Vec::len) + 1;
        if several > 1 {
            return words::several(several);
        }
        let shown = lab.prototype.with(|shown| shown.as_ref().map(|shown| shown.class.clone()));
        name.or(shown).unwrap_or_else(|| {
            lab.document.with(|d| d.as_ref().map_or_else(String::new, |d| d.title.clone()))
        })
    };
    let class = move || {
        let class =
            row.with(|row| row.as_ref().filter(|r| r.kind.is_thing()).map(|r| r.detail.clone()));
        let value = lab.inspected.get().and_then(|path| value_at(lab, &path));
        let class = value.map(|value| value.class).or(class);
        let class = class.unwrap_or_else(|| {
            let is_class = lab.prototype.with(Option::is_some);
            String::from(match row.with(Option::is_none) {
                true if is_class => words::GIVEN_IN_CLASS,
                true => words::PARAMETERS,
                false => words::IS_RULE,
            })
        });
        if lab.also.with(Vec::is_empty) {
            return class;
        }
        // what is shown below is of the first of them
        let first = row.with(|row| row.as_ref().map(|row| row.path.clone())).unwrap_or_default();
        words::first_of_several(&first, &class)
    };
    let law = Memo::new(move |_| {
        row.with(|row| row.as_ref().map(|row| row.doc.clone()).unwrap_or_default())
    });
    let formula = Memo::new(move |_| {
        row.with(|row| {
            let row = row.as_ref()?;
            match row.kind {
                RowKind::Constraint | RowKind::Merge | RowKind::Side => Some(row.detail.clone()),
                RowKind::Virtual => written(lab, row),
                RowKind::Part => None,
            }
        })
    });
    view! {
        <section class="panel inspector" aria-label=words::INSPECTOR>
            <header class="head">
                <h2 class="subject">{title}</h2>
                <button class="bare why-button" on:click=move |_| actions::run(actions::named("explain"), lab)>
                    {words::WHY}</button>
            </header>
            <div class="scroll" on:pointerleave=move |_| lab.hover(None)>
                <p class="class quiet">{class}</p>
                {move || law.with(|law| (!law.is_empty()).then(|| view! { <p class="law">{marked(law)}</p> }))}
                {move || formula.get().map(|formula| view! { <p class="law"><code>{formula}</code></p> })}
                <Said lab=lab />
                <Made lab=lab />
                <Numbers lab=lab />
                <ViewsOf lab=lab path=Memo::new(move |_| lab.inspected.get().unwrap_or_default()) />
                <Rules lab=lab />
            </div>
        </section>
    }
}

/// The row of the values that a path leads to.
fn value_at(lab: Lab, path: &str) -> Option<ValueRow> {
    lab.value_rows.track();
    lab.values.with_untracked(|rows| rows.iter().find(|row| row.path == path).cloned())
}

/// How something that is computed is written in the text.
fn written(lab: Lab, row: &StructureRow) -> Option<String> {
    let (start, end) = row.span?;
    lab.text.with(|text| text.source.get(start as usize..end as usize).map(String::from))
}

/// The rows of what a thing computes, as the corner of a rectangle: the tree has none of it.
fn computed_rows(lab: Lab, path: &str) -> Vec<StructureRow> {
    // live while dragging
    lab.picture.track();
    let found = lab.id().zip(session::parse_path(path));
    found.map(|(id, path)| lab.ask(|s| s.computed_rows(id, &path))).unwrap_or_default()
}

/// The selection; of what a thing computes, that thing: its are the values and constraints.
fn subject(lab: Lab) -> Option<String> {
    let path = lab.inspected.get()?;
    lab.structure.with(|rows| {
        let is_there = |path: &str| rows.iter().any(|row| row.path == path);
        let mut whole = path.as_str();
        while !is_there(whole) {
            let Some(end) = whole.rfind(['.', '[']) else { return Some(path.clone()) };
            whole = &whole[..end];
        }
        Some(String::from(whole))
    })
}

/// The value that a selected constraint gives; it is typed anew.
#[component]
fn Said(lab: Lab) -> impl IntoView {
    let offer = Memo::new(move |_| lab.inspected.get().and_then(|path| lab.typed_by(&path)));
    let button = move |offer: Offer| {
        let says =
            format!("{} {}", offer.label, to_read(offer.value.as_deref().unwrap_or_default()));
        view! {
            <p class="law choices"><button class="said-value" title=words::TYPE_VALUE
                on:click=move |_| lab.take_offer(&offer)>{says}</button></p>
        }
    };
    move || offer.get().map(button)
}

/// The values of what is selected that is computed: it has none of its own.
#[component]
fn Made(lab: Lab) -> impl IntoView {
    let found = Memo::new(move |_| {
        let path = lab.inspected.get()?;
        // a number has its row below
        if value_at(lab, &path).is_some() {
            return None;
        }
        let value = |row: &StructureRow| {
            let name = row.path.get(path.len()..)?.trim_start_matches('.');
            let name = if name.is_empty() { words::VALUE } else { name };
            Some((String::from(name), row.value.clone()?))
        };
        let values = |rows: &[StructureRow]| rows.iter().filter_map(value).take(MOST).collect();
        let known: Option<Vec<_>> = lab.structure.with(|rows| {
            let at = rows.iter().position(|r| r.path == path)?;
            let end = (at + rows[at].descendants as usize).min(rows.len() - 1);
            let is_made = rows[at].kind == RowKind::Virtual;
            Some(if is_made { values(&rows[at..=end]) } else { Vec::new() })
        });
        Some(known.unwrap_or_else(|| values(&computed_rows(lab, &path))))
    });
    let rows = move || found.get().unwrap_or_default();
    view! {
        <Show when=move || found.with(|found| found.as_ref().is_some_and(|rows| !rows.is_empty()))>
            <h3>{words::VALUES}</h3>
            <dl class="made">
                <For each=rows key=Clone::clone let(row)><dt>{row.0}</dt><dd>{row.1}</dd></For>
            </dl>
        </Show>
    }
}

/// The values of the selection, or the given ones of the document, each with a slider where it is a number.
#[component]
fn Numbers(lab: Lab) -> impl IntoView {
    let within = Memo::new(move |_| {
        let path = subject(lab).and_then(|path| session::parse_path(&path));
        let found = lab.id().zip(path);
        found.map(|(id, path)| lab.ask(|s| s.values_within(id, &path))).unwrap_or_default()
    });
    let found = Memo::new(move |_| {
        let selected = subject(lab);
        lab.value_rows.track();
        let of = |rows: &Vec<ValueRow>| {
            within.with(|within| shown_values(rows, selected.as_deref(), within))
        };
        lab.values.with_untracked(of)
    });
    let shown = RwSignal::new(Vec::new());
    let told = Memo::new(move |_| lab.values.with(|rows| shown.with(|shown| told(rows, shown))));
    Effect::new(move |_| {
        found.track();
        show_more(lab, found, shown);
    });
    on_cleanup(move || {
        // The lab may have gone with the page.
        let _ = lab.inspected_values.try_set_value(Vec::new());
    });
    // of the thing that computes what is selected
    let heading = move || match subject(lab) {
        Some(whole) if lab.inspected.get().is_some_and(|path| path != whole) => {
            words::values_of(&whole)
        }
        _ => String::from(words::VALUES),
    };
    // before its rows are made nothing is said of a sheet
    let rows = Memo::new(move |_| lab.structure.with(|rows| rows.len().min(2)));
    view! {
        <Show when=move || !found.with(Vec::is_empty)>
            <h3>{heading}</h3>
        </Show>
        <Show when=move || found.with(Vec::is_empty) && lab.inspected.with(Option::is_none)>
            <p class="law quiet">{move || match rows.get() { 0 => "", 1 => words::EMPTY_SHEET, _ => words::NOTHING_GIVEN }}</p>
        </Show>
        <div class="values">
            <table>
                <caption class="unseen">{words::VALUES}</caption>
                <tbody>
                    <For each=move || shown.get() key=Clone::clone let(row)>
                        <values::Row lab=lab at=row.0 place=Place::Inspector within=row.1 />
                        <tr><td colspan="4">
                            {asked(lab, row.0, told)}
                            <values::Slider lab=lab at=row.0 />
                        </td></tr>
                    </For>
                </tbody>
            </table>
        </div>
    }
}

/// Shows some more of the rows that were found, besides those that are shown already; the others follow with the next
/// frames.
fn show_more(lab: Lab, found: Memo<Vec<Inspected>>, shown: RwSignal<Vec<Inspected>>) {
    let Some(mut all) = found.try_get_untracked() else { return };
    let known = shown.with_untracked(|shown| shown.iter().cloned().collect::<BTreeSet<_>>());
    let mut new = if lab.pressed.get_value() { 1 } else { AT_ONCE };
    let together = all.len();
    all.retain(|row| {
        let is_new = !known.contains(row);
        let is_shown = !is_new || new > 0;
        new -= usize::from(is_new && is_shown);
        is_shown
    });
    let is_all = all.len() == together;
    lab.inspected_values.set_value(all.iter().map(|shown| shown.0).collect());
    shown.set(all);
    if !is_all {
        js::after_painting(move || {
            // the page may be gone
            if shown.try_with_untracked(|_| ()).is_some() {
                show_more(lab, found, shown);
            }
        });
    }
}

/// What is said of a value, where something is: a program's question, a comment.
fn asked(lab: Lab, at: usize, told: Memo<BTreeSet<usize>>) -> impl Fn() -> Option<AnyView> {
    let said = Memo::new(move |_| {
        let is_told = told.with(|told| told.contains(&at));
        lab.values.with(|rows| rows.get(at).filter(|_| is_told).map(|row| row.doc.clone()))
    });
    move || said.get().map(|doc| view! { <p class="asked quiet">{marked(&doc)}</p> }.into_any())
}

/// The rows of which something is said that was not said of one above.
fn told(rows: &[ValueRow], shown: &[Inspected]) -> BTreeSet<usize> {
    let mut said = BTreeSet::from([""]);
    let is_new = |at: &usize| rows.get(*at).is_some_and(|row| said.insert(&row.doc));
    shown.iter().map(|one| one.0).filter(is_new).collect()
}

/// The constraints of the selection, each with its switch.
#[component]
fn Rules(lab: Lab) -> impl IntoView {
    let found = Memo::new(move |_| {
        let selected = subject(lab);
        lab.structure.with(|rows| shown_rules(rows, selected.as_deref()))
    });
    view! {
        <Show when=move || !found.with(Vec::is_empty)>
            <h3>{words::CONSTRAINTS}</h3>
        </Show>
        <ul class="rules">
            <For each=move || found.get() key=|row| (row.path.clone(), row.detail.clone(), row.enabled, row.freedom.map(words::freedom)) let(row)>
                <Rule lab=lab row=row />
            </For>
        </ul>
    }
}

#[component]
fn Rule(lab: Lab, row: StructureRow) -> impl IntoView {
    let label = lab.structure.with_untracked(|rows| told_apart(&row, rows));
    let (path, on) = (row.path, row.enabled);
    // what nobody has named is told by what it says
    let rule = (label == path).then(|| (row.detail.clone(), formula(&row.detail)));
    let title = if rule.is_some() { row.doc } else { row.detail };
    let (select, hover, switched) = (path.clone(), path.clone(), path.clone());
    let state = row.freedom.map(words::freedom).unwrap_or_default();
    let toggle = move |_| {
        if let Some(path) = session::parse_path(&switched) {
            lab.apply(&Command::Enable { path, on: !on });
        }
    };
    view! {
        <li class:off=!on>
            <button class="switch" role="switch" aria-checked=on.to_string()
                aria-label=words::switch_of(&label) on:click=toggle></button>
            <button class="path" title=title
                on:click=move |_| lab.select(Some(select.clone()))
                on:pointerenter=move |_| lab.hover(Some(hover.clone()))>{label}</button>
            {rule.map(|(detail, formula)| view! { <code title=detail>{formula}</code> })}
            <span class=format!("state {state}")><span class="unseen">{state}</span></span>
        </li>
    }
}

/// Which rows of the values the inspector shows, by their paths within what is selected: those of a thing and what
/// it shares with others, outermost first; of the document what is given.
fn shown_values<'a>(
    rows: &'a [ValueRow],
    selected: Option<&'a str>,
    within: &'a [ValueWithin],
) -> Vec<Inspected> {
    let depth = |name: &str| name.matches('.').count();
    let name = |row: &'a ValueRow| match selected {
        Some(path) => {
            let shared = within.iter().find(|w| w.row == row.path && !w.path.is_empty());
            let rest = [&row.path, &row.shortest].into_iter().find(|p| covers(path, p))?;
            let rest = rest.get(path.len()..).unwrap_or_default().trim_start_matches('.');
            let own = if rest.is_empty() { row.path.as_str() } else { rest };
            Some(shared.map_or(own, |w| &w.path))
        }
        None => {
            let is_given = row.given && depth(&row.shortest) <= 1;
            // what the document itself computes and has a word for
            let is_told = row.is_virtual && depth(&row.shortest) == 0 && !row.doc.is_empty();
            let is_shown = (is_given || is_told) && !row.is_layout && row.number.is_some();
            is_shown.then_some(row.path.as_str())
        }
    };
    let shared =
        |row: &ValueRow| { within.iter().find(|w| w.row == row.path) }.map(|w| w.path.as_str());
    let ranked = |(at, row): (usize, &'a ValueRow)| {
        let name = name(row).or_else(|| shared(row))?;
        Some((depth(name), at, name))
    };
    let mut found: Vec<(usize, usize, &str)> = rows.iter().enumerate().filter_map(ranked).collect();
    let is_own = |at: usize| selected.is_some_and(|path| rows[at].path == path);
    if found.iter().any(|(_, at, _)| !rows[*at].is_layout) {
        found.retain(|(_, at, _)| is_own(*at) || !rows[*at].is_layout);
    }
    // a document may give tens of thousands, of which the first are shown
    if found.len() > MOST {
        found.select_nth_unstable(MOST);
        found.truncate(MOST);
    }
    found.sort_unstable();
    found.into_iter().map(|(_, at, name)| (at, String::from(name))).collect()
}
