//! The map of a program: where in two of its parameters it draws. A click gives the example the values of a place.

use super::Family;
use crate::lab::{Kind, Told};
use crate::words;
use leptos::ev::{KeyboardEvent, PointerEvent};
use leptos::prelude::*;
use leptos::svg::Svg;
use session::jobs::{LongAnswer, LongQuestion};
use session::view::{FamilyAxis, FamilyMap};

/// So many reasons have a look of their own; further ones share the last.
const LOOKS: usize = 5;

/// The map.
#[component]
pub fn Map(
    /// What is shown.
    family: Family,
) -> impl IntoView {
    let Family { lab, name, thing, .. } = family;
    let offered = Memo::new(move |_| {
        lab.text.track();
        let (name, thing) = (name.get(), thing.get());
        let axes = lab.ask_of_shown(|s, id| s.family_axes(id, &name, thing.as_deref()));
        axes.and_then(Result::ok).unwrap_or_default()
    });
    // what is shown goes on being shown while values change: only another family begins anew
    let axes = RwSignal::new(None::<[FamilyAxis; 2]>);
    Effect::new(move |last: Option<String>| {
        let name = name.get();
        if last.as_ref() != Some(&name) {
            axes.set(
                offered.with_untracked(|all| Some([all.first()?.clone(), all.get(1)?.clone()])),
            );
        }
        name
    });
    let made = RwSignal::new(None::<Result<FamilyMap, String>>);
    Effect::new(move |_| {
        lab.text.track();
        let Some(axes) = axes.get() else { return };
        let question = LongQuestion::Map { family: name.get(), thing: thing.get(), axes };
        lab.ask_long(Kind::Map, question, move |told| {
            let map = match told {
                Told::Part(LongAnswer::Map(map)) => map,
                Told::Part(_) | Told::Over => return,
                Told::Stopped => Err(String::from(words::MAP_STOPPED)),
                Told::Failed(why) => Err(words::job_failed(&why)),
            };
            made.try_set(Some(map));
        });
    });
    on_cleanup(move || lab.forget_long(Kind::Map));
    let axis = move |at: usize, label: &'static str| {
        view! { <Axis axes=axes offered=offered at=at label=label /> }
    };
    view! {
        <Show when=move || axes.with(Option::is_some) fallback=|| view! { <p class="quiet">{words::MAP_NEEDS_TWO}</p> }>
            <div class="plot-form">{axis(0, words::MAP_ACROSS)}{axis(1, words::MAP_UP)}</div>
            {move || match made.get() {
                Some(Ok(map)) => view! { <Chart family=family map=map /> }.into_any(),
                Some(Err(why)) => view! { <p class="error" role="alert">{why}</p> }.into_any(),
                None => ().into_any(),
            }}
        </Show>
    }
}

/// A parameter and its range.
#[component]
fn Axis(
    axes: RwSignal<Option<[FamilyAxis; 2]>>,
    offered: Memo<Vec<FamilyAxis>>,
    at: usize,
    label: &'static str,
) -> impl IntoView {
    let of = move |read: fn(&FamilyAxis) -> &String| {
        axes.with(|axes| axes.as_ref().map(|axes| read(&axes[at]).clone())).unwrap_or_default()
    };
    let change = move |change: &dyn Fn(&mut FamilyAxis)| {
        axes.update(|axes| {
            if let Some(axes) = axes {
                change(&mut axes[at]);
            }
        });
    };
    let choose = move |e: leptos::ev::Event| {
        let chosen = event_target_value(&e);
        let found =
            offered.with_untracked(|all| all.iter().find(|a| a.parameter == chosen).cloned());
        if let Some(found) = found {
            change(&|axis| axis.clone_from(&found));
        }
    };
    let option = move |axis: FamilyAxis| {
        let (value, is_it) = (axis.parameter.clone(), axis.parameter.clone());
        let selected = move || of(|a| &a.parameter) == is_it;
        view! { <option value=value selected=selected>{axis.parameter}</option> }
    };
    view! {
        <label>{label}
            <select on:change=choose data-axis=at.to_string()>{move || offered.get().into_iter().map(option).collect_view()}</select>
        </label>
        <label>{words::PLOT_FROM}
            <input class="end" autocomplete="off" prop:value=move || of(|a| &a.from)
                on:change=move |e| { let typed = event_target_value(&e); change(&|axis| axis.from.clone_from(&typed)); } />
        </label>
        <label>{words::PLOT_TO}
            <input class="end" autocomplete="off" prop:value=move || of(|a| &a.to)
                on:change=move |e| { let typed = event_target_value(&e); change(&|axis| axis.to.clone_from(&typed)); } />
        </label>
    }
}

/// The map as a picture, and what its looks mean.
#[component]
fn Chart(family: Family, map: FamilyMap) -> impl IntoView {
    let (wide, high) = (map.across.values.len(), map.up.values.len());
    let read = RwSignal::new(None::<(usize, usize)>);
    let svg = NodeRef::<Svg>::new();
    // neighbours with one reason are one rectangle
    let mut bars: Vec<(usize, usize, usize, usize)> = Vec::new();
    for (at, reason) in map.places.iter().enumerate() {
        let (x, y) = (at % wide, at / wide);
        let look = reason.map_or(0, |reason| reason.min(LOOKS - 1) + 1);
        match bars.last_mut() {
            Some(bar) if x > 0 && bar.1 == y && bar.3 == look => bar.2 += 1,
            _ => bars.push((x, y, 1, look)),
        }
    }
    let bar = |(x, y, width, look): (usize, usize, usize, usize)| {
        let y = high - 1 - y;
        view! { <rect class=format!("look-{look}") x=x.to_string() y=y.to_string() width=width.to_string() height="1" /> }
    };
    let now = map.now.map(|(x, y)| {
        let x = x * (wide - 1) as f64 + 0.5;
        let y = high as f64 - 0.5 - y * (high - 1) as f64;
        // a stroke is as wide as it is high, whatever the looks of the cells
        let spot = format!("M {x} {y} h 0");
        view! { <path class="now" d=spot.clone() /><path class="now inner" d=spot /> }
    });
    let legend = std::iter::once((0, String::from(words::MAP_DRAWN)))
        .chain(map.reasons.iter().enumerate().map(|(i, reason)| {
            (i.min(LOOKS - 1) + 1, format!("{}: {}", reason.outcome, reason.step))
        }))
        .map(|(look, said)| view! { <li><i class=format!("look-{look}")></i>{said}</li> })
        .collect_view();
    let has_now = map.now.is_some();
    let (across, up) = (map.across.clone(), map.up.clone());
    let map = StoredValue::new(map);
    let at = move |e: &PointerEvent| {
        let frame = svg.get_untracked()?.get_bounding_client_rect();
        let part = |at: f64, from: f64, size: f64| ((at - from) / size).clamp(0.0, 0.999_999);
        let x = part(f64::from(e.client_x()), frame.left(), frame.width()) * wide as f64;
        let y = part(f64::from(e.client_y()), frame.top(), frame.height()) * high as f64;
        Some((x as usize, high - 1 - y as usize))
    };
    let take = move |(x, y): (usize, usize)| {
        let Some(thing) = family.thing.get_untracked() else { return };
        let Some(place) = map.with_value(|map| map.place(x, y)) else { return };
        let typed = map.with_value(|map| {
            vec![(map.across.parameter.clone(), place.across), (map.up.parameter.clone(), place.up)]
        });
        family.edit(|session, id, _| session.set_parameters(id, &thing, &typed));
    };
    let key = move |e: KeyboardEvent| {
        let (x, y) = read.get_untracked().unwrap_or((wide / 2, high / 2));
        let to = match e.key().as_str() {
            "ArrowLeft" => (x.saturating_sub(1), y),
            "ArrowRight" => ((x + 1).min(wide - 1), y),
            "ArrowUp" => (x, (y + 1).min(high - 1)),
            "ArrowDown" => (x, y.saturating_sub(1)),
            "Enter" | " " => {
                take((x, y));
                (x, y)
            }
            _ => return,
        };
        e.prevent_default();
        e.stop_propagation();
        read.set(Some(to));
    };
    let said = move || {
        let (x, y) = read.get()?;
        map.with_value(|map| {
            let place = map.place(x, y)?;
            let why = place.why.unwrap_or_else(|| String::from(words::MAP_DRAWN));
            let (across, up) = (&map.across.parameter, &map.up.parameter);
            Some(format!("{across} {}, {up} {}: {why}", place.across, place.up))
        })
    };
    let cursor = move || {
        read.get().map(|(x, y)| {
            let y = high - 1 - y;
            view! { <rect class="cursor" x=x.to_string() y=y.to_string() width="1" height="1" /> }
        })
    };
    let ends = |axis: &session::view::MapAxis| {
        let end = |x: Option<&f64>| base::number::significant(x.copied().unwrap_or_default(), 4);
        let unit = if axis.unit.is_empty() { String::new() } else { format!(" {}", axis.unit) };
        let (first, last) = (end(axis.values.first()), end(axis.values.last()));
        format!("{} {first} … {last}{unit}", axis.parameter)
    };
    view! {
        <div class="map scroll">
            <figure>
                <figcaption class="up">{ends(&up)}</figcaption>
                <svg node_ref=svg viewBox=format!("0 0 {wide} {high}") preserveAspectRatio="none" tabindex="0" role="img"
                    aria-label=words::FAMILY_MAP
                    on:pointermove=move |e: PointerEvent| read.set(at(&e))
                    on:pointerdown=move |e: PointerEvent| if let Some(at) = at(&e) { read.set(Some(at)); take(at) }
                    on:keydown=key>
                    <title>{words::MAP_HELP}</title>
                    {bars.into_iter().map(bar).collect_view()}{now}{cursor}
                </svg>
                <figcaption>{ends(&across)}</figcaption>
            </figure>
            <div>
                <ul class="legend">{legend}
                    {has_now.then(|| view! { <li><i class="now"></i>{words::MAP_NOW}</li> })}
                </ul>
                <output aria-live="polite">{said}</output>
                <p class="quiet">{words::MAP_HELP}</p>
            </div>
        </div>
    }
}
