//! The values view: a table in which every value can be typed, scrubbed and locked.

use crate::actions::Context;
use crate::lab::{Lab, Notice};
use crate::player::Play;
use crate::{field, js, menu, words};
use leptos::ev::{KeyboardEvent, MouseEvent, PointerEvent};
use leptos::html::Span;
use leptos::prelude::*;
use presentation::numbers::{ends_between, meant_in, step};
use presentation::paths::split;
use session::view::ValueRow;
use std::f64::consts::{PI, TAU};
use wasm_bindgen::JsCast;

/// At most so many rows are in the page at once; the filter finds the others.
const MOST_ROWS: usize = 300;
/// So many rows are made in one frame.
const ROWS_A_FRAME: usize = 16;

/// The table of the open document's values.
#[component]
pub fn Values(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let filter = RwSignal::new(String::new());
    let found = Memo::new(move |_| {
        let wanted = filter.get().to_lowercase();
        lab.value_rows.track();
        lab.values.with_untracked(|rows| {
            let fits = |row: &ValueRow| {
                // where things are drawn is listed where it is asked for
                if wanted.is_empty() {
                    return !row.is_layout;
                }
                row.path.to_lowercase().contains(&wanted)
                    || row.class.to_lowercase().contains(&wanted)
            };
            let all = rows.iter().enumerate().filter(|(_, row)| fits(row)).map(|(at, _)| at);
            all.collect::<Vec<usize>>()
        })
    });
    let room = RwSignal::new(ROWS_A_FRAME);
    Effect::new(move |_| {
        if room.get() < found.with(Vec::len).min(MOST_ROWS) {
            // the table may have gone by then
            request_animation_frame(move || _ = room.try_update(|room| *room += ROWS_A_FRAME));
        }
    });
    let shown = move || {
        let most = room.get().min(MOST_ROWS);
        let shown: Vec<usize> = found.with(|found| found.iter().copied().take(most).collect());
        lab.shown_values.set_value(shown.clone());
        shown
    };
    // the lab may have gone with the page
    on_cleanup(move || _ = lab.shown_values.try_set_value(Vec::new()));
    let more = Memo::new(move |_| found.with(|found| found.len().saturating_sub(MOST_ROWS)));
    view! {
        <section class="panel values" aria-label=words::VALUES>
            <header class="head">
                <h2>{words::TABLE}</h2>
                <input type="search" placeholder=words::FILTER aria-label=words::FILTER
                    prop:value=filter
                    on:input=move |e| {
                        room.set(ROWS_A_FRAME);
                        filter.set(event_target_value(&e));
                    } />
            </header>
            <div class="scroll" on:pointerleave=move |_| lab.hover(None)>
                <table>
                    <caption class="unseen">{words::VALUES}</caption>
                    <thead class="unseen">
                        <tr>
                            <th scope="col">{words::COLUMN_PATH}</th>
                            <th scope="col">{words::COLUMN_VALUE}</th>
                            <th scope="col">{words::COLUMN_UNIT}</th>
                            <th scope="col">{words::LOCK_NAME}</th>
                        </tr>
                    </thead>
                    <tbody>
                        <For
                            each=shown
                            key=|at| *at
                            let(at)
                        >
                            <Row lab=lab at=at place=Place::Table />
                        </For>
                    </tbody>
                </table>
                <Show when=move || found.with(Vec::is_empty)>
                    <p class="quiet">{words::NO_VALUES}</p>
                </Show>
                <Show when=move || { more.get() > 0 }>
                    <p class="quiet">{move || format!("{} {}", more.get(), words::MORE_VALUES)}</p>
                </Show>
            </div>
        </section>
    }
}

/// Where rows are shown; a value may be in both.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Place {
    /// The table of all values.
    Table,
    /// The inspector.
    Inspector,
}

/// One value: its name, which can be scrubbed, its field, its unit and its lock.
#[component]
pub fn Row(
    /// The lab.
    lab: Lab,
    /// Which of the values.
    at: usize,
    /// Where it is shown.
    place: Place,
    /// Its path within what is inspected, where that is another than its own.
    #[prop(optional)]
    within: Option<String>,
) -> impl IntoView {
    let row = Memo::new(move |_| lab.values.with(|rows| rows.get(at).cloned()));
    let of = move |read: fn(&ValueRow) -> String| {
        Memo::new(move |_| row.with(|row| row.as_ref().map(read).unwrap_or_default()))
    };
    let is = move |read: fn(&ValueRow) -> bool| {
        Memo::new(move |_| row.with(|row| row.as_ref().is_some_and(read)))
    };
    let path = of(|row| row.path.clone());
    let within = StoredValue::new(within);
    let named = move || within.get_value().unwrap_or_else(|| path.get());
    let owner = Memo::new(move |_| String::from(split(&named()).0));
    let name = Memo::new(move |_| String::from(split(&named()).1));
    let unit = of(|row| row.unit.clone());
    let class = of(|row| row.class.clone());
    let state = of(|row| row.freedom.map(words::freedom).map(String::from).unwrap_or_default());
    let given = is(|row| row.given);
    let anchored = is(|row| row.anchored);
    let lockable = is(|row| !row.is_virtual);
    let hint = Memo::new(move |_| row.with(|row| row.as_ref().map(described).unwrap_or_default()));
    let selected = Memo::new(move |_| {
        lab.marked.with(|marked| {
            path.with(|path| marked.selected.iter().any(|selected| is_or_owns(selected, path)))
        })
    });
    let hovered = Memo::new(move |_| {
        lab.marked.with(|marked| {
            path.with(|path| {
                marked.hovered.as_ref().is_some_and(|hovered| is_or_owns(hovered, path))
            })
        })
    });
    Effect::new(move |_| {
        if place == Place::Table && selected.get() {
            request_animation_frame(move || field::scroll_to(&format!("value-{at}")));
        }
    });
    view! {
        <tr
            id=(place == Place::Table).then(|| format!("value-{at}"))
            class:given=given
            class:selected=selected
            class:hovered=hovered
            title=hint
            on:pointerenter=move |_| lab.hover(Some(path.get_untracked()))
        >
            <th scope="row" on:contextmenu=move |e: MouseEvent| {
                e.prevent_default();
                lab.select(Some(path.get_untracked()));
                menu::open_at(lab, (f64::from(e.client_x()), f64::from(e.client_y())), Context::Value);
            }>
                <Scrub lab=lab row=row owner=owner name=name selects={place == Place::Table} />
            </th>
            <td><Field lab=lab row=row selects={place == Place::Table} /></td>
            <td class="unit">{move || if unit.with(String::is_empty) { String::new() } else { unit.get() }}
                <span class="unseen">{class}</span></td>
            <td class="marks">
                <span class=move || format!("state {}", state.get())><span class="unseen">{state}</span></span>
                {move || lockable.get().then(|| view! { <field::Lock lab=lab path=path anchored=anchored /> })}
            </td>
        </tr>
    }
}

/// Whether a thing is a value or the thing that it is a part of.
fn is_or_owns(thing: &str, path: &str) -> bool {
    thing == path || split(path).0.strip_suffix('.') == Some(thing)
}

fn described(row: &ValueRow) -> String {
    let origin = if row.given { words::GIVEN } else { words::COMPUTED };
    let parts = [row.doc.as_str(), &format!("{}: {}", row.path, row.class), origin];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
}

/// The number's name; dragged sideways it changes the number.
#[component]
fn Scrub(
    lab: Lab,
    row: Memo<Option<ValueRow>>,
    owner: Memo<String>,
    name: Memo<String>,
    selects: bool,
) -> impl IntoView {
    let span = NodeRef::<Span>::new();
    // Where the pointer was pressed, the number there, and whether it has become a drag.
    let start = StoredValue::new(None::<(f64, f64, bool)>);
    let latest = StoredValue::new(None::<f64>);
    // what was drawn then
    let drawn = StoredValue::new(None);
    let number = Memo::new(move |_| row.with(|row| row.as_ref().and_then(|row| row.number)));
    let path = move || row.with_untracked(|row| row.as_ref().map(|row| row.path.clone()));
    let down = move |e: PointerEvent| {
        if e.button() != 0 {
            return;
        }
        if let Some(number) = number.get_untracked() {
            e.prevent_default();
            span.get_untracked().inspect(|span| js::capture(span, e.pointer_id()));
            start.set_value(Some((f64::from(e.client_x()), number, false)));
        }
        // the inspector goes on showing what it shows
        if selects {
            lab.select(path());
        }
    };
    let frame = move || {
        let x = latest.try_update_value(Option::take).flatten();
        // the row may be gone by the frame that asks
        let start_now = start.try_get_value().flatten();
        let (Some(x), Some((from, number, dragging))) = (x, start_now) else { return };
        if !dragging {
            if (x - from).abs() < 3.0 {
                return;
            }
            drawn.set_value(lab.drawn_box());
            if path().and_then(|path| lab.press(&path)).is_none() {
                start.set_value(None);
                return;
            }
            start.set_value(Some((from, number, true)));
        }
        lab.drag((number + ((x - from) / 2.0).round() * step(number), 0.0));
    };
    let moved = move |e: PointerEvent| {
        if start.get_value().is_some() {
            let waiting = latest.get_value().is_some();
            latest.set_value(Some(f64::from(e.client_x())));
            if !waiting {
                request_animation_frame(frame);
            }
        }
    };
    let cancel = move |_: PointerEvent| {
        latest.set_value(None);
        let was = start.try_update_value(Option::take).flatten();
        if was.is_some_and(|(_, _, dragging)| dragging) {
            lab.cancel();
        }
    };
    let end = move |_: PointerEvent| {
        frame();
        let was = start.try_update_value(Option::take).flatten();
        if was.is_some_and(|(_, _, dragging)| dragging)
            && lab.dragging.with_untracked(Option::is_some)
        {
            lab.release();
            lab.keep_in_sight(drawn.get_value(), true);
        }
    };
    view! {
        <span
            node_ref=span
            class="label"
            class:scrub=move || number.get().is_some()
            title=move || number.get().map(|_| words::SCRUB)
            on:pointerdown=down
            on:pointermove=moved
            on:pointerup=end
            on:pointercancel=cancel
        >
            <span class="owner">{owner}</span>
            <span class="name">{name}</span>
        </span>
    }
}

/// How many steps a slider has.
const STEPS: f64 = 200.0;

/// Whether a value says how many parts there are.
fn is_count(lab: Lab, path: &str) -> bool {
    let asked = session::parse_path(path).zip(lab.id());
    asked.is_some_and(|(path, id)| lab.ask(|session| session.is_count(id, &path)))
}

/// The end of a range that nobody asked for, where the other one was asked for, and what is said of it: it fades.
fn open_end(range: (Option<f64>, Option<f64>)) -> Option<(&'static str, &'static str)> {
    match range {
        (Some(_), None) => Some(("above", words::OPEN_ABOVE)),
        (None, Some(_)) => Some(("below", words::OPEN_BELOW)),
        _ => None,
    }
}

/// A slider for a number; while it is moved the rest follows, and it is one step of the undo list.
#[component]
pub fn Slider(
    /// The lab.
    lab: Lab,
    /// Which of the values.
    at: usize,
) -> impl IntoView {
    let row = Memo::new(move |_| lab.values.with(|rows| rows.get(at).cloned()));
    let number = Memo::new(move |_| row.with(|row| row.as_ref().and_then(|row| row.number)));
    let path = Memo::new(move |_| {
        row.with(|row| row.as_ref().map(|r| r.path.clone()).unwrap_or_default())
    });
    let asked = Memo::new(move |_| row.with(|row| row.as_ref().and_then(|row| row.range)));
    let whole =
        Memo::new(move |_| row.with(|row| row.as_ref().is_some_and(|r| r.class == "Integer")));
    let range = Memo::new(move |old: Option<&(f64, f64)>| {
        let turn = row.with(|row| row.as_ref().and_then(whole_turn));
        ends_between(number.get().unwrap_or(0.0), asked.get().unwrap_or_default(), turn, old)
    });
    let pressed = StoredValue::new(false);
    // what was drawn then
    let drawn = StoredValue::new(None);
    let at_step = move |to: f64| {
        let (least, most) = range.get_untracked();
        let (path, id) = (path.with_untracked(|path| session::parse_path(path)), lab.id());
        let rounded = path.zip(id).and_then(|(path, id)| {
            lab.ask(|session| session.at_step(id, &path, to, (most - least) / STEPS))
        });
        rounded.filter(|x| (least..=most).contains(x)).unwrap_or(to)
    };
    // how many parts there are is said once the hand lets go: each number is another document
    let counted = StoredValue::new(None::<f64>);
    let is_count = move || path.with_untracked(|path| is_count(lab, path));
    // Escape gives up what the hand still holds
    let given_up = StoredValue::new(false);
    let moved = move |e: leptos::ev::Event| {
        if given_up.get_value() {
            let is = number.get_untracked().unwrap_or_default().to_string();
            return event_target::<web_sys::HtmlInputElement>(&e).set_value(&is);
        }
        let Ok(to) = event_target_value(&e).parse::<f64>() else { return };
        if !pressed.get_value() && is_count() {
            counted.set_value(Some(to));
            let said = path.with_untracked(|path| words::count_to_be(path, to));
            return lab.notice.set(Some(Notice::Said(said)));
        }
        if !pressed.get_value() {
            drawn.set_value(lab.drawn_box());
            pressed.set_value(path.with_untracked(|path| lab.press(path)).is_some());
        }
        if pressed.get_value() {
            lab.drag((at_step(to), 0.0));
        }
    };
    let done = move || {
        let _ = given_up.try_set_value(false);
        if pressed.try_update_value(std::mem::take) == Some(true) {
            lab.release();
            // while the hand holds it the picture stays where it is
            lab.keep_in_sight(drawn.get_value(), true);
        }
        if let Some(to) = counted.try_update_value(Option::take).flatten() {
            let say = move |said: Result<(), session::view::Refusal>| {
                lab.notice.set(said.err().map(Notice::Refused));
            };
            path.with_untracked(|path| lab.set_typed(path, &to.to_string(), say));
        }
    };
    // a hand that the browser takes away has chosen nothing
    let cancel = move || {
        if pressed.try_update_value(std::mem::take) == Some(true) {
            lab.cancel();
        }
        if counted.try_update_value(Option::take).flatten().is_some() {
            lab.notice.set(None);
        }
    };
    let key = move |e: KeyboardEvent| {
        let is_held = pressed.get_value() || counted.with_value(Option::is_some);
        if e.key() == "Escape" && is_held {
            e.prevent_default();
            e.stop_propagation();
            cancel();
            given_up.set_value(true);
        }
    };
    let step = move || {
        let (least, most) = range.get();
        if whole.get() { 1.0 } else { (most - least) / STEPS }
    };
    let open = Memo::new(move |_| asked.get().and_then(open_end));
    // made once: a slider that is made anew under the hand would let go
    let is_number = Memo::new(move |_| number.with(Option::is_some));
    move || {
        is_number.get().then(|| {
            view! {
                <div class="led" data-open=move || open.get().map(|open| open.0)
                    title=move || open.get().map(|open| open.1)>
                <Play lab=lab at=at path=path ends=range />
                <input type="range" class="slider" aria-label=move || words::slider_of(&path.get())
                    min=move || range.get().0.to_string() max=move || range.get().1.to_string()
                    step=move || step().to_string()
                    prop:value=move || number.get().unwrap_or_default().to_string()
                    on:keydown=key on:input=moved on:change=move |e| {
                        done();
                        // what was refused is as it was
                        let is = number.get_untracked().unwrap_or_default().to_string();
                        event_target::<web_sys::HtmlInputElement>(&e).set_value(&is);
                    }
                    on:pointerup=move |_| done() on:pointercancel=move |_| cancel() />
                </div>
            }
        })
    }
}

/// The ends of a whole turn in the units of a row's number, where that is an angle. One that is computed lies within
/// half a turn of zero.
pub(crate) fn whole_turn(row: &ValueRow) -> Option<(f64, f64)> {
    let is_upward = !row.is_virtual && row.number.is_some_and(|number| number >= 0.0);
    (row.class == "Angle").then_some(if is_upward { (0.0, TAU) } else { (-PI, PI) })
}

/// The field of one value: Enter sets it, Escape brings back what was there.
#[component]
fn Field(lab: Lab, row: Memo<Option<ValueRow>>, selects: bool) -> impl IntoView {
    let typed = RwSignal::new(None::<String>);
    let error = RwSignal::new(None::<String>);
    let sent = StoredValue::new(None::<String>);
    let active = RwSignal::new(false);
    let text = Memo::new(move |_| {
        row.with(|row| row.as_ref().map(|r| r.text.clone()).unwrap_or_default())
    });
    let exact = Memo::new(move |_| {
        row.with(|row| row.as_ref().map(|r| r.exact.clone()).unwrap_or_default())
    });
    let path = Memo::new(move |_| {
        row.with(|row| row.as_ref().map(|r| r.path.clone()).unwrap_or_default())
    });
    let commit = move || {
        let Some(words) = typed.get_untracked() else { return };
        // until it is known what came of it, it is not typed again
        if sent.with_value(|sent| sent.as_ref() == Some(&words)) {
            return;
        }
        sent.set_value(Some(words.clone()));
        let unit =
            row.with_untracked(|row| row.as_ref().map(|r| r.unit.clone()).unwrap_or_default());
        let meant = meant_in(&words, &unit);
        // the field may have gone, or say something else, until it is known what came of it
        lab.set_typed(&path.get_untracked(), &meant, move |outcome| {
            let _ = sent.try_set_value(None);
            match outcome {
                Ok(()) if typed.try_get_untracked().flatten().as_ref() == Some(&words) => {
                    typed.set(None);
                    error.set(None);
                }
                Ok(()) => {}
                Err(refusal) => {
                    if let Some(why) = error.try_set(Some(refusal.in_a_line())).flatten() {
                        lab.say_refused(why);
                    }
                }
            }
        });
    };
    let options = Memo::new(move |_| {
        row.with(|row| row.as_ref().map(|r| r.options.clone()).unwrap_or_default())
    });
    let key = move |e: KeyboardEvent| match e.key().as_str() {
        "Enter" => commit(),
        "Escape" => {
            typed.set(None);
            error.set(None);
        }
        "ArrowDown" if focus_beside(&e, Beside::Below) => e.prevent_default(),
        "ArrowUp" if focus_beside(&e, Beside::Above) => e.prevent_default(),
        _ => {}
    };
    // the inspector goes on showing what it shows
    let choose = move || {
        if selects {
            lab.select(Some(path.get_untracked()));
        }
    };
    let select = move || {
        let one = move |option: String| {
            let is_chosen = {
                let option = option.clone();
                move || text.with(|text| *text == option)
            };
            view! { <option selected=is_chosen value=option.clone()>{option.clone()}</option> }
        };
        view! {
            <select
                class="field"
                aria-label=path
                aria-invalid=move || error.with(Option::is_some).to_string()
                prop:value=move || { error.track(); text.get() }
                on:focus=move |_| choose()
                on:change=move |e| {
                    typed.set(Some(event_target_value(&e)));
                    commit();
                    typed.set(None);
                }
            >
                {options.get().into_iter().map(one).collect_view()}
            </select>
        }
    };
    let input = move || {
        view! {
            <input
                class="field"
                class:typing=move || typed.with(Option::is_some)
                autocomplete="off"
                spellcheck="false"
                aria-label=path
                aria-invalid=move || error.with(Option::is_some).to_string()
                prop:value=move || typed.get().unwrap_or_else(|| if active.get() { exact.get() } else { text.get() })
                on:focus=move |_| {
                    active.set(true);
                    choose();
                }
                on:input=move |e| {
                    typed.set(Some(event_target_value(&e)));
                    error.set(None);
                }
                on:keydown=key
                on:blur=move |_| {
                    // a field that is taken away loses the keyboard when nothing is known of it any more
                    let Some(is_fine) = error.try_with_untracked(Option::is_none) else { return };
                    active.set(false);
                    if is_fine {
                        commit();
                    }
                }
            />
        }
    };
    view! {
        {move || if options.with(Vec::is_empty) { input().into_any() } else { select().into_any() }}
        {move || error.get().map(|error| view! { <span class="error" role="alert">{error}</span> })}
    }
}

/// Which row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Beside {
    Above,
    Below,
}

/// Gives the keyboard to the field of the row above or below.
fn focus_beside(e: &KeyboardEvent, which: Beside) -> bool {
    let target: web_sys::Element = event_target(e);
    let row = target.closest("tr").ok().flatten();
    let beside = row.and_then(|row| match which {
        Beside::Below => row.next_element_sibling(),
        Beside::Above => row.previous_element_sibling(),
    });
    let field = beside.and_then(|row| row.query_selector(".field").ok().flatten());
    let Some(field) = field.and_then(|field| field.dyn_into::<web_sys::HtmlElement>().ok()) else {
        return false;
    };
    if let Some(field) = field.dyn_ref::<web_sys::HtmlInputElement>() {
        field.select();
    }
    field.focus().is_ok()
}
