//! The rows of a family as a grid: each cell a field, each row with what comes of it.

use super::{Family, MOST_ROWS};
use crate::{icons, js, keyboard, words};
use leptos::ev::KeyboardEvent;
use leptos::prelude::*;
use session::view::{FamilyRow, RowUse};
use wasm_bindgen::JsCast;

/// The grid.
#[component]
pub fn Grid(
    /// What is shown.
    family: Family,
) -> impl IntoView {
    let grid = family.grid;
    let counted = move || {
        let drawn = family.outcomes.with(|all| all.iter().filter(|o| o.outcome == "drawn").count());
        let all = family.outcomes.with(Vec::len);
        (all > 0).then(|| words::rows_drawn(drawn, all))
    };
    let more = move || grid.with(|grid| grid.rows.len().saturating_sub(MOST_ROWS));
    let rows = move || {
        let shown = grid.with(|grid| grid.rows.iter().take(MOST_ROWS).cloned().collect::<Vec<_>>());
        let row = |(at, row)| view! { <Row family=family at=at row=row /> };
        shown.into_iter().enumerate().map(row).collect_view()
    };
    // once it is made, another one is begun: nothing that was typed goes over to it
    let new_row = move || {
        let begun = grid.with(|grid| {
            let at = grid.rows.len();
            let columns = grid.columns.iter().map(|c| (c.name.clone(), c.example.clone()));
            let is_begun = grid.is_own && at < MOST_ROWS;
            is_begun.then(|| (at, grid.name.clone(), columns.collect::<Vec<_>>()))
        });
        begun.into_iter()
    };
    let head = move || {
        let columns = grid.with(|grid| grid.columns.clone());
        let one = |column: session::view::GridColumn| {
            view! { <th scope="col" title=column.prompt>{column.name}</th> }
        };
        columns.into_iter().map(one).collect_view()
    };
    // an own family has the row that is not there yet
    let is_empty = move || grid.with(|grid| grid.rows.is_empty() && !grid.is_own);
    let nothing = move || match grid.with(|grid| (grid.name == grid.program, grid.table.is_some()))
    {
        (true, _) => words::NO_FAMILY,
        (false, true) => words::TABLE_COMES,
        (false, false) => words::NO_ROWS,
    };
    view! {
        <div class="scroll">
            <Show when=move || !is_empty() fallback=move || view! { <p class="quiet">{nothing}</p> }>
                <table>
                    <thead><tr>
                        <th scope="col">{words::ROW_NAME}</th>{head}
                        <th scope="col">{words::ROW_OUTCOME}</th>
                        <th scope="col"><span class="unseen">{words::ROW_SET}</span></th>
                    </tr></thead>
                    <tbody>
                        {rows}
                        <For each=new_row key=|row| row.clone() let(row)>
                            <NewRow family=family at=row.0 />
                        </For>
                    </tbody>
                </table>
            </Show>
            <p class="quiet" role="status">{counted}</p>
            {move || grid.with(|grid| grid.notes.clone()).into_iter().map(|note| view! { <p class="quiet">{note}</p> }).collect_view()}
            {move || (more() > 0).then(|| view! { <p class="quiet">{words::more_rows(more())}</p> })}
        </div>
    }
}

/// The row that is not there yet: what is typed in a cell of it makes it.
#[component]
fn NewRow(family: Family, at: usize) -> impl IntoView {
    let columns = family.grid.with_untracked(|grid| grid.columns.clone());
    // where one goes on: by the keyboard to the next cell, by the pointer to the one that is pressed
    let goes_to = StoredValue::new(None::<usize>);
    let field = move |column: usize, name: &str, placeholder: String| {
        // what was refused stays, marked, until it is said otherwise
        let kept = family.kept((at, column));
        let is_wrong = RwSignal::new(kept.is_some());
        let take = move |typed: &str, next: Option<usize>| {
            let cell = (at, column);
            let is_made =
                family.edit(|session, id, name| session.set_family_cells(id, name, cell, typed));
            family.keep(cell, typed, is_made);
            let _ = is_wrong.try_set(!is_made);
            if let (true, Some(next)) = (is_made, next) {
                go_on(at, next);
            }
        };
        let change = move |e: leptos::ev::Event| {
            let typed = event_target_value(&e);
            match typed.trim().is_empty() {
                true => {
                    family.keep((at, column), "", true);
                    is_wrong.set(false);
                }
                false => take(&typed, goes_to.get_value()),
            }
        };
        let keyed = move |e: KeyboardEvent| {
            let is_on = matches!(e.key().as_str(), "Enter" | "Tab");
            goes_to.set_value(is_on.then_some(column + 1));
            walk(&e);
        };
        let paste = move |e: web_sys::ClipboardEvent| {
            if let Some(block) = block_of(&e) {
                take(&block, Some(column));
            }
        };
        view! {
            <input class="field" autocomplete="off" spellcheck="false" aria-label=words::cell_of(name, words::NEW_ROW)
                placeholder=placeholder data-cell=format!("{at},{column}")
                aria-invalid=move || is_wrong.get().to_string() prop:value=kept.unwrap_or_default()
                on:paste=paste on:keydown=keyed on:change=change
                on:pointerdown=move |_| goes_to.set_value(Some(column)) />
        }
    };
    let cell = move |(index, column): (usize, session::view::GridColumn)| {
        view! { <td>{field(index + 1, &column.name, column.example)}</td> }
    };
    view! {
        <tr class="new">
            <th scope="row">{field(0, words::ROW_NAME, String::from(words::NEW_ROW))}</th>
            {columns.into_iter().enumerate().map(cell).collect_view()}
            <td></td><td></td>
        </tr>
    }
}

/// With the next frame, gives the keyboard to a cell of the row that was just made, or, after its last one, to the row
/// that is begun then; not where it went elsewhere meanwhile. A press beside the row goes nowhere.
fn go_on(row: usize, column: usize) {
    request_animation_frame(move || {
        let holder = keyboard::holder().filter(|holder| holder.tag_name() != "BODY");
        let is_begun = |holder: &web_sys::Element| matches!(holder.closest("tr.new"), Ok(Some(_)));
        if holder.is_none_or(|holder| is_begun(&holder)) && !focus_cell(row, column) {
            focus_cell(row + 1, 0);
        }
    });
}

/// Gives a cell the keyboard; returns whether there is such a one.
fn focus_cell(row: usize, column: usize) -> bool {
    let found = document().query_selector(&format!("[data-cell='{row},{column}']")).ok().flatten();
    let field = found.and_then(|found| found.dyn_into::<web_sys::HtmlElement>().ok());
    field.is_some_and(|field| field.focus().is_ok())
}

/// Takes a block of cells that was copied in a spreadsheet, from a cell on; what is one cell is typed as always.
fn paste(family: Family, from: (usize, usize), e: &web_sys::ClipboardEvent) {
    if let Some(block) = block_of(e) {
        family.edit(|session, id, name| session.set_family_cells(id, name, from, &block));
    }
}

/// Returns what is pasted where it is more than one cell, and keeps the field from taking it.
fn block_of(e: &web_sys::ClipboardEvent) -> Option<String> {
    let data = js::field(e.as_ref(), "clipboardData");
    let read = js::field(&data, "getData").dyn_into::<js_sys::Function>().ok()?;
    let block = read.call1(&data, &"text/plain".into()).ok().and_then(|text| text.as_string())?;
    let is_block = block.trim_end().contains(['\t', '\n']);
    if is_block {
        e.prevent_default();
    }
    is_block.then_some(block)
}

/// One row.
#[component]
fn Row(family: Family, at: usize, row: FamilyRow) -> impl IntoView {
    let Family { grid, outcomes, thing, .. } = family;
    let is_own = grid.with_untracked(|grid| grid.is_own);
    let columns = grid.with_untracked(|grid| grid.columns.clone());
    let outcome = Memo::new(move |_| outcomes.with(|all| all.get(at).cloned()).unwrap_or_default());
    let row = StoredValue::new(row);
    let row_name = row.with_value(|row| row.name.clone());
    let mark = row_name.clone();
    let name_label = words::cell_of(words::ROW_NAME, &row_name);
    let set = move |column: Option<String>, typed: &str| {
        let cell = (at, column.as_deref());
        family.edit(|session, id, name| session.set_family_cell(id, name, cell, typed))
    };
    let kept_name = family.kept((at, 0));
    let is_name_wrong = RwSignal::new(kept_name.is_some());
    let name_value = kept_name.unwrap_or_else(|| row_name.clone());
    let rename = move |e: leptos::ev::Event| {
        let typed = event_target_value(&e);
        let is_set = set(None, &typed);
        family.keep((at, 0), &typed, is_set);
        let _ = is_name_wrong.try_set(!is_set);
    };
    let cell = move |(index, column): (usize, session::view::GridColumn)| {
        let kept = family.kept((at, index + 1));
        let is_kept = kept.is_some();
        let value =
            kept.unwrap_or_else(|| grid.with_untracked(|grid| grid.cell(at, index).to_string()));
        let label = words::cell_of(&column.name, &row.with_value(|row| row.name.clone()));
        let named = column.name.clone();
        // what was refused stays, marked, until it is said otherwise
        let is_wrong = RwSignal::new(is_kept);
        let change = move |e: leptos::ev::Event| {
            let typed = event_target_value(&e);
            let is_set = set(Some(named.clone()), &typed);
            family.keep((at, index + 1), &typed, is_set);
            let _ = is_wrong.try_set(!is_set);
        };
        let options: Vec<_> = column
            .choices
            .iter()
            .map(|value| view! { <option value=value.clone()></option> })
            .collect();
        let list = format!("choices-{at}-{index}");
        let choices = (!options.is_empty())
            .then(|| (list.clone(), view! { <datalist id=list>{options}</datalist> }));
        let (list, choices) = choices.unzip();
        view! {
            <td>{choices}<input class="field" autocomplete="off" spellcheck="false" aria-label=label list=list
                placeholder=column.example readonly=!is_own data-cell=format!("{at},{}", index + 1)
                aria-invalid=move || is_wrong.get().to_string()
                prop:value=value on:change=change on:paste=move |e| paste(family, (at, index + 1), &e)
                on:keydown=move |e| walk(&e) /></td>
        }
    };
    let delete = move |_| {
        if family.edit(|session, id, name| session.delete_family_row(id, name, at)) {
            family.forget(at);
        }
    };
    // nothing is known of a row that is still to be drawn
    let is_bad = move || outcome.with(|o| !o.outcome.is_empty() && o.outcome != "drawn");
    let said = move || {
        outcome.with(|o| match o.outcome.as_str() {
            "" => String::from("…"),
            "drawn" if o.message.is_empty() => String::from(words::ROW_DRAWN),
            kind => format!("{kind}: {}", o.message),
        })
    };
    view! {
        <tr class:bad=is_bad data-row=mark>
            <th scope="row"><input class="field" autocomplete="off" spellcheck="false" readonly=!is_own
                aria-label=name_label data-cell=format!("{at},0")
                prop:value=name_value on:paste=move |e| paste(family, (at, 0), &e) on:keydown=move |e| walk(&e)
                aria-invalid=move || is_name_wrong.get().to_string()
                on:change=rename /></th>
            {columns.into_iter().enumerate().map(cell).collect_view()}
            <td class="outcome">{said}</td>
            <td class="uses">
                {move || thing.get().map(|thing| view! {
                    <button data-family="apply" title=words::applied_to(&thing)
                        on:click=move |_| row.with_value(|row| family.apply_row(row))>{words::ROW_SET}</button>
                })}
                <button data-family="place" on:click=move |_| row.with_value(|row| family.use_row(row, &RowUse::Place))>{words::ROW_PLACE}</button>
                {is_own.then(|| view! {
                    <button class="bare" data-family="delete" aria-label=words::ROW_DELETE title=words::ROW_DELETE on:click=delete>{icons::close()}</button>
                })}
            </td>
        </tr>
    }
}

/// Arrow keys and Enter go from cell to cell up and down; below the last one Enter says what is typed.
fn walk(e: &KeyboardEvent) {
    let by: isize = match e.key().as_str() {
        "ArrowUp" => -1,
        "ArrowDown" | "Enter" => 1,
        _ => return,
    };
    let field = e.target().and_then(|t| t.dyn_into::<web_sys::HtmlElement>().ok());
    let Some(field) = field else { return };
    let Some(at) = field.get_attribute("data-cell") else { return };
    let Some((row, column)) = at.split_once(',') else { return };
    let (Ok(row), Ok(column)) = (row.parse::<usize>(), column.parse::<usize>()) else { return };
    let to = row.checked_add_signed(by);
    if let Some(to) = to.filter(|to| focus_cell(*to, column)) {
        e.prevent_default();
        // a change makes the rows anew: the next field is looked for then
        request_animation_frame(move || _ = focus_cell(to, column));
    } else if e.key() == "Enter" {
        // what is typed is said when its field is left; where that makes no row, one types on
        let _ = field.blur();
        let _ = field.focus();
    }
}
