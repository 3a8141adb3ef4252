//! The dock's family: a program's rows as a grid that is changed in place, as pictures, and the map of its parameters.
//!
//! In: the document, and the file with a table where a family names one. Out: edits of the document's rows, values of
//! an example. What comes of each row is asked of the session.

use crate::lab::{Kind, Lab, Notice, Told};
use crate::{js, words};
use leptos::prelude::*;
use session::Session;
use session::jobs::{LongAnswer, LongQuestion};
use session::view::{
    Change, DocumentId, FamilyGrid, FamilyRow, FamilyView, Refusal, RowFormats, RowOutcome, RowUse,
};
use std::collections::BTreeMap;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

pub mod files;
pub mod grid;
pub mod map;
pub mod pictures;

/// At most so many rows are shown and drawn in the page.
const MOST_ROWS: usize = 200;

/// What is shown of a family.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Shown {
    Rows,
    Pictures,
    Map,
}

/// A family that is shown.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    lab: Lab,
    /// The family, or a program without one.
    name: Memo<String>,
    /// Its rows.
    grid: Memo<FamilyGrid>,
    /// What came of them.
    outcomes: RwSignal<Vec<RowOutcome>>,
    /// The thing that takes values.
    thing: Memo<Option<String>>,
    /// Why something was refused.
    refused: RwSignal<Option<String>>,
    /// What was typed into cells and refused, by the family and the cell's row and column.
    kept: StoredValue<BTreeMap<(Whose, usize, usize), String>>,
}

/// The document of a family, and its name there.
type Whose = (Option<String>, String);

impl Family {
    fn whose(self) -> Whose {
        (self.lab.current.get_untracked(), self.name.get_untracked())
    }

    /// Keeps what was typed into a cell where it was refused, so that it stands there until it is said otherwise.
    fn keep(self, (row, column): (usize, usize), typed: &str, is_taken: bool) {
        let cell = (self.whose(), row, column);
        let _ = self.kept.try_update_value(|kept| match is_taken {
            true => kept.remove(&cell),
            false => kept.insert(cell, typed.into()),
        });
    }

    /// What was typed into a cell and refused.
    fn kept(self, (row, column): (usize, usize)) -> Option<String> {
        let cell = (self.whose(), row, column);
        self.kept.with_value(|kept| kept.get(&cell).cloned())
    }

    /// Forgets what was refused of a row that goes; that of later rows goes up with them.
    fn forget(self, gone: usize) {
        let own = self.whose();
        self.kept.update_value(|kept| {
            let stays = std::mem::take(kept)
                .into_iter()
                .filter(|((name, row, _), _)| *name != own || *row != gone);
            *kept = stays
                .map(|((name, row, column), typed)| {
                    let row = if name == own && row > gone { row - 1 } else { row };
                    ((name, row, column), typed)
                })
                .collect();
        });
    }

    /// Changes the document by an edit of the family that is shown, once what is pending has ended.
    fn edit(
        self,
        change: impl FnOnce(&mut Session, DocumentId, &str) -> Result<Change, Refusal>,
    ) -> bool {
        self.lab.flush_text();
        let name = self.name.get_untracked();
        self.settle(self.lab.tell(|session, id| change(session, id, &name)))
    }

    /// Takes up what came of an edit.
    fn settle(self, outcome: Option<Result<Change, Refusal>>) -> bool {
        match outcome {
            Some(Err(refusal)) => {
                self.refused.set(Some(refusal.in_a_line()));
                false
            }
            done => {
                self.refused.set(None);
                self.lab.settle(done)
            }
        }
    }

    /// Uses a row: the thing takes its values, or a new one has them.
    fn use_row(self, row: &FamilyRow, to: &RowUse) {
        let name = self.name.get_untracked();
        self.lab.flush_text();
        let used = self.lab.tell(|session, id| session.use_family_row(id, (&name, row), to));
        let (change, thing) = match used {
            Some(Ok((change, thing))) => (Some(Ok(change)), thing),
            Some(Err(refusal)) => (Some(Err(refusal)), String::new()),
            None => return,
        };
        if self.settle(change) {
            self.lab.select(Some(thing.clone()));
            self.lab.notice.set(Some(Notice::Said(words::row_used(&row.name, &thing))));
        }
    }

    fn apply_row(self, row: &FamilyRow) {
        if let Some(thing) = self.thing.get_untracked() {
            self.use_row(row, &RowUse::Set(thing));
        }
    }
}

/// Where it is told what comes of rows.
#[derive(Clone, Copy)]
struct Drawn {
    lab: Lab,
    outcomes: RwSignal<Vec<RowOutcome>>,
    refused: RwSignal<Option<String>>,
}

/// Has rows drawn; those that have come are shown with the next frame, each in the place of what came of it before.
fn draw(family: String, rows: Vec<FamilyRow>, formats: RowFormats, drawn: Drawn) {
    let Drawn { lab, outcomes, refused } = drawn;
    let all = rows.len();
    let come = StoredValue::new((0, Vec::new()));
    let show = move || {
        let Some((from, new)) = come.try_update_value(|(from, new): &mut (usize, Vec<_>)| {
            let first = *from;
            *from += new.len();
            (first, std::mem::take(new))
        }) else {
            return;
        };
        let _ = outcomes.try_update(|outcomes| {
            outcomes.resize_with(all, RowOutcome::default);
            outcomes.iter_mut().skip(from).zip(new).for_each(|(old, new)| *old = new);
        });
    };
    lab.ask_long(
        Kind::Rows,
        LongQuestion::Rows { family, rows, formats },
        move |told| match told {
            Told::Part(LongAnswer::Row(outcome)) => {
                let is_first = come.try_update_value(|(_, new)| {
                    new.push(outcome);
                    new.len() == 1
                });
                if is_first == Some(true) {
                    request_animation_frame(show);
                }
            }
            Told::Part(_) | Told::Over => {}
            Told::Stopped => drop(refused.try_set(Some(String::from(words::ROWS_STOPPED)))),
            Told::Failed(why) => drop(refused.try_set(Some(words::job_failed(&why)))),
        },
    );
}

/// The families of the open document.
#[component]
pub fn Families(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let chosen = RwSignal::new(String::new());
    let shown = RwSignal::new(Shown::Rows);
    let refused = RwSignal::new(None::<String>);
    let chosen_thing = RwSignal::new(String::new());
    let families = Memo::new(move |_| {
        lab.text.track();
        lab.ask_of_shown(Session::families).unwrap_or_default()
    });
    let programs = Memo::new(move |_| {
        lab.text.track();
        lab.ask_of_shown(Session::programs).unwrap_or_default()
    });
    let choices = Memo::new(move |_| {
        let families = families.get();
        let has_one = |program: &String| families.iter().any(|f| f.program == *program);
        let lone = programs.get().into_iter().filter(|program| !has_one(program));
        let names = families.iter().map(|family| family.name.clone());
        names.chain(lone).collect::<Vec<_>>()
    });
    let name = Memo::new(move |_| {
        let (choices, chosen) = (choices.get(), chosen.get());
        if choices.contains(&chosen) {
            return chosen;
        }
        // until one is chosen, that of what is selected
        let selected = lab.selected.get();
        let shown = |s: &Session, id| s.program_shown(id, selected.as_deref()).map(|s| s.program);
        let program = lab.ask_of_shown(shown).flatten().unwrap_or_default();
        let family = families.with(|all| {
            all.iter().find(|family| family.program == program).map(|family| family.name.clone())
        });
        let own = family.unwrap_or(program);
        let found = choices.iter().find(|choice| **choice == own).or(choices.first());
        found.cloned().unwrap_or_default()
    });
    let file = file_of(lab, families, name);
    let read = Memo::new(move |_| {
        lab.text.track();
        let name = name.get();
        if name.is_empty() {
            return Ok(FamilyGrid::default());
        }
        let table = match file.get() {
            Some(Err(message)) => return Err(message),
            Some(Ok(text)) => Some(text),
            None => None,
        };
        let grid = lab.ask_of_shown(|s, id| s.family_grid(id, &name, table.as_deref()));
        grid.unwrap_or_else(|| Ok(FamilyGrid::default())).map_err(|r| r.in_a_line())
    });
    let grid = Memo::new(move |_| read.get().unwrap_or_default());
    let outcomes = RwSignal::new(Vec::new());
    Effect::new(move |_| {
        lab.text.track();
        let formats = RowFormats { svg: shown.get() == Shown::Pictures, dxf: false };
        let (family, rows) = grid.with(|grid| {
            (grid.name.clone(), grid.rows.iter().take(MOST_ROWS).cloned().collect::<Vec<_>>())
        });
        if rows.is_empty() || shown.get() == Shown::Map {
            outcomes.set(Vec::new());
            return lab.forget_long(Kind::Rows);
        }
        draw(family, rows, formats, Drawn { lab, outcomes, refused });
    });
    on_cleanup(move || lab.forget_long(Kind::Rows));
    let things = Memo::new(move |_| {
        lab.text.track();
        let program = grid.with(|grid| grid.program.clone());
        lab.ask_of_shown(|s, id| s.drawn_by(id, &program)).unwrap_or_default()
    });
    let thing = Memo::new(move |_| {
        let (things, chosen, selected) = (things.get(), chosen_thing.get(), lab.selected.get());
        let is_there = |path: &String| things.contains(path);
        selected.filter(is_there).or(Some(chosen).filter(is_there)).or(things.first().cloned())
    });
    let kept = StoredValue::new(BTreeMap::new());
    let family = Family { lab, name, grid, outcomes, thing, refused, kept };
    view! {
        <section class="panel family" aria-label=words::FAMILY>
            <Show when=move || choices.with(|all| !all.is_empty())
                fallback=|| view! { <p class="quiet">{words::NO_PROGRAMS}</p> }>
                <Head family=family chosen=chosen shown=shown choices=choices things=things chosen_thing=chosen_thing />
                {move || read.get().err().or(refused.get()).map(|why| view! {
                    <p class="error" role="alert">{why}</p>
                })}
                {move || match shown.get() {
                    Shown::Rows => view! { <grid::Grid family=family /> }.into_any(),
                    Shown::Pictures => view! { <pictures::Pictures family=family /> }.into_any(),
                    Shown::Map => view! { <map::Map family=family /> }.into_any(),
                }}
            </Show>
        </section>
    }
}

/// Which family is shown and how, and what is done with it.
#[component]
fn Head(
    family: Family,
    chosen: RwSignal<String>,
    shown: RwSignal<Shown>,
    choices: Memo<Vec<String>>,
    things: Memo<Vec<String>>,
    chosen_thing: RwSignal<String>,
) -> impl IntoView {
    let Family { lab, name, thing, refused, .. } = family;
    let tab = move |label: &'static str, of: Shown| {
        view! {
            <button role="radio" aria-checked=move || (shown.get() == of).to_string() data-family=label.to_lowercase()
                on:click=move |_| shown.set(of)>{label}</button>
        }
    };
    let option = move |choice: String| {
        let (value, is_it) = (choice.clone(), choice.clone());
        view! { <option value=value selected=move || name.get() == is_it>{choice}</option> }
    };
    let thing_option = move |path: String| {
        let (value, is_it) = (path.clone(), path.clone());
        view! { <option value=value selected=move || thing.get().as_ref() == Some(&is_it)>{path}</option> }
    };
    view! {
        <div class="plot-form">
            <select name="family" aria-label=words::WHICH_FAMILY
                on:change=move |e| { refused.set(None); chosen.set(event_target_value(&e)); }>
                {move || choices.get().into_iter().map(option).collect_view()}
            </select>
            <span role="radiogroup" class="choices" aria-label=words::FAMILY>
                {tab(words::FAMILY_ROWS, Shown::Rows)}
                {tab(words::FAMILY_PICTURES, Shown::Pictures)}
                {tab(words::FAMILY_MAP, Shown::Map)}
            </span>
            <Tools family=family chosen=chosen />
            <Show when=move || things.with(|things| things.len() > 1)>
                <label>{words::ROW_SET}" "{words::APPLY_TO}
                    <select name="thing" on:change=move |e| {
                        let path = event_target_value(&e);
                        chosen_thing.set(path.clone());
                        lab.select(Some(path));
                    }>
                        {move || things.get().into_iter().map(thing_option).collect_view()}
                    </select>
                </label>
            </Show>
        </div>
    }
}

/// The text of the file with the table of a family, once it is there; nothing for one that names none.
fn file_of(
    lab: Lab,
    families: Memo<Vec<FamilyView>>,
    name: Memo<String>,
) -> Memo<Option<Result<String, String>>> {
    let fetched = RwSignal::new(None::<(String, Result<String, String>)>);
    let wanted = Memo::new(move |_| {
        let name = name.get();
        let table = families.with(|all| all.iter().find(|f| f.name == name)?.table.clone())?;
        let path = lab.current.get()?;
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        Some(if folder.is_empty() { table } else { format!("{folder}/{table}") })
    });
    Effect::new(move |_| {
        lab.tables.track();
        if let Some(path) = wanted.get() {
            leptos::task::spawn_local(async move {
                let found = lab.table(&path).await;
                let text = found.and_then(|text| text.ok_or_else(|| words::no_table(&path)));
                // the dock may be shut meanwhile
                let _ = fetched.try_set(Some((path, text)));
            });
        }
    });
    Memo::new(move |_| match (wanted.get(), fetched.get()) {
        (Some(wanted), Some((path, text))) if wanted == path => Some(text),
        _ => None,
    })
}

/// What is done with a whole family.
#[component]
fn Tools(family: Family, chosen: RwSignal<String>) -> impl IntoView {
    let Family { lab, name, grid, .. } = family;
    let is_own = Memo::new(move |_| grid.with(|grid| grid.is_own));
    let is_family = Memo::new(move |_| grid.with(|grid| grid.name != grid.program));
    let csv = move || -> Option<String> {
        grid.with_untracked(|grid| {
            let written = grid.csv();
            (!grid.rows.is_empty()).then_some(written)
        })
    };
    let begin = move |_| {
        let program = grid.with_untracked(|grid| grid.program.clone());
        lab.flush_text();
        match lab.tell(|session, id| session.begin_family(id, &program)) {
            Some(Ok((change, name))) => {
                family.settle(Some(Ok(change)));
                chosen.set(name);
            }
            Some(Err(refusal)) => family.refused.set(Some(refusal.in_a_line())),
            None => {}
        }
    };
    let add = move |_| {
        let thing = family.thing.get_untracked();
        family.edit(|session, id, name| session.add_family_row(id, name, thing.as_deref()));
    };
    let take = move |csv: &str| {
        family.edit(|session, id, name| session.take_family_table(id, name, csv));
    };
    let load = move |_| {
        let took = Closure::once_into_js(move |_: String, text: String| take(&text));
        js::choose_file(".csv,text/csv,text/plain", took.unchecked_ref());
    };
    let save = move |_| {
        if let Some(csv) = csv() {
            js::download(&format!("{}.csv", name.get_untracked()), &csv);
        }
    };
    view! {
        <Show when=move || !is_family.get()>
            <button class="primary" data-family="begin" title=words::BEGIN_FAMILY_HELP on:click=begin>{words::BEGIN_FAMILY}</button>
        </Show>
        <Show when=move || is_own.get()>
            <button data-family="add" on:click=add>{words::ADD_ROW}</button>
        </Show>
        <Show when=move || is_family.get()>
            <button data-family="load" on:click=load>{words::TAKE_CSV}</button>
        </Show>
        <Show when=move || grid.with(|grid| !grid.rows.is_empty())>
            <button data-family="save" on:click=save>{words::GIVE_CSV}</button>
            <button data-family="save-svg" title=words::GIVE_DRAWINGS_HELP
                on:click=move |_| files::save(family, files::Format::Svg)>{words::GIVE_SVG}</button>
            <button data-family="save-dxf" title=words::GIVE_DRAWINGS_HELP
                on:click=move |_| files::save(family, files::Format::Dxf)>{words::GIVE_DXF}</button>
        </Show>
        {move || grid.with(|grid| grid.table.clone()).map(|file| view! {
            <span class="quiet">{words::rows_in_file(&file)}</span>
            <button data-family="take" on:click=move |_| if let Some(csv) = csv() { take(&csv) }>{words::TAKE_TABLE}</button>
        })}
    }
}
