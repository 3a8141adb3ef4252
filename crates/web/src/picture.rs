//! The picture: the canvas, and the hand and keys that act on it.
//!
//! Pointer moves are taken at most once a frame; key presses are commands of their own, so that none
//! is lost.

use crate::annotated;
use crate::apart::apart;
use crate::drafting::numbers::StepNumbers;
use crate::field::Edit;
use crate::js::{self, Painter};
use crate::lab::{Lab, Zoom, first_path};
use crate::paint::{
    DisplayList, Part, arrows, caught, display_list, ghosts, grid, guides, loci, preview,
};
use crate::sheet::{Bounds, View, bounds, fit_box, scale_in_words, with_words};
use crate::words;
use drawing::{Drawing, Point, Vertical};
use js_sys::Array;
use leptos::ev::{KeyboardEvent, MouseEvent, PointerEvent, WheelEvent};
use leptos::html::Canvas;
use leptos::prelude::*;
use presentation::marks::{Marked, marks};
use session::view::{Caught, Grip, MovedView, PictureView};
use std::sync::Arc;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

mod hand;
pub mod thumbnail;

/// Space around a picture that fits, in pixels.
const MARGIN: f64 = 56.0;
/// So many pixels of its lower edge stay free, unless it is lower than this.
const BELOW: f64 = 64.0;
const LOW: f64 = 420.0;
/// How high the strip of what fits a selection is.
const STRIP: f64 = 48.0;
/// How much of its right side the document covers of the picture of a class, in a window wider than this.
const INSET: f64 = 212.0;
const NARROW: f64 = 900.0;

/// The picture of the open document.
#[component]
pub fn Picture(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let canvas = NodeRef::<Canvas>::new();
    let size = RwSignal::new((0.0, 0.0));
    let painter = StoredValue::new_local(None::<Painter>);
    let hand = hand::Hand::new(lab, canvas);
    let marked = lab.marked;
    let lists = lists(lab);
    Effect::new(move |_| {
        if let Some(canvas) = canvas.get() {
            painter.set_value(Some(new_painter(&canvas, size)));
        }
    });
    on_cleanup(move || painter.with_value(|p| p.as_ref().map(Painter::stop)).unwrap_or_default());
    follow_size(lab, size);
    follow_card(lab);
    annotated::follow(lab);
    let left = StoredValue::new(None);
    Effect::new(move |_| zoom_as_asked(lab, size.get(), left));
    Effect::new(move |_| {
        lab.colors.changes.track();
        painter.with_value(|p| p.as_ref().map(Painter::look));
    });
    keep_painted(lab, painter, size, lists);

    let label = Memo::new(move |_| {
        let title = lab.document.with(|d| d.as_ref().map_or_else(String::new, |d| d.title.clone()));
        words::picture_of(&title, lab.picture.with(|picture| picture.grips.len()))
    });
    let caught = Memo::new(move |_| {
        lab.tool_view.with(|tool| tool.caught.as_ref().map(|caught| caught.word.clone()))
    });
    let live = Memo::new(move |_| {
        let of_selection = || described(lab, marked.with(|m| m.selected.last().cloned()));
        let keyed = lab.keyed.get().map(words::place);
        caught.get().or(keyed).unwrap_or_else(of_selection)
    });
    view! {
        <section class="panel picture" aria-label=words::PICTURE>
            <canvas
                id="picture"
                node_ref=canvas
                tabindex="0"
                role="application"
                aria-label=label
                aria-describedby="picture-live"
                class=("gripping", move || lab.dragging.with(Option::is_some))
                class=("drawing", move || {
                    lab.tool.with(Option::is_some) || lab.drafting.prompt.with(Option::is_some)
                })
                class=("over", move || lab.hovered.with(Option::is_some))
                on:pointerdown=move |e: PointerEvent| hand.down(&e)
                on:pointermove=move |e: PointerEvent| hand.moved(&e)
                on:pointerup=move |e: PointerEvent| hand.up(&e)
                on:pointercancel=move |e: PointerEvent| hand.lost(&e)
                on:pointerleave=move |_| hand.left()
                on:dblclick=move |e: MouseEvent| hand.edit(&e)
                on:wheel=move |e: WheelEvent| wheel(lab, canvas, &e)
                on:contextmenu=move |e| hand.menu(&e)
                on:keydown=move |e: KeyboardEvent| key(lab, hand, size.get_untracked(), &e)
                on:keyup=move |e: KeyboardEvent| {
                    if e.key() == " " { hand.hold_space(hand::Space::Up); }
                }
            ></canvas>
            {move || lab.editing.get().map(|found| apart(|| {
                let path = found.path.clone();
                view! {
                    <div class="inplace" style:left=format!("{}px", found.at.0) style:top=format!("{}px", found.at.1)>
                        <Edit lab=lab path=Memo::new(move |_| path.clone()) value=found.value
                            done=move || {
                                lab.editing.set(None);
                                if let Some(canvas) = canvas.get_untracked() {
                                    // The picture stands in the page.
                                    let _ = canvas.focus();
                                }
                            } />
                    </div>
                }
            }))}
            <StepNumbers lab=lab />
            {move || lab.band.get().map(|[from, to]| {
                let (left, top) = (f64::min(from.0, to.0), f64::min(from.1, to.1));
                view! {
                    <div class="band" class=("crossing", to.0 < from.0) style:left=format!("{left}px")
                        style:top=format!("{top}px") style:width=format!("{}px", (to.0 - from.0).abs())
                        style:height=format!("{}px", (to.1 - from.1).abs())></div>
                }
            })}
            <p id="picture-live" class="unseen" aria-live="polite">{live}</p>
            <Corner lab=lab />
        </section>
    }
}

/// The display lists of the picture: what lies under what moves, where something is dragged, and the rest.
type Lists = (Memo<Option<Arc<DisplayList>>>, Memo<Arc<DisplayList>>);

fn lists(lab: Lab) -> Lists {
    let marked = lab.marked;
    // what a drag leaves as it is
    let form = Memo::new(move |_| lab.picture.with(|p| (p.made, p.paths.len(), p.grips.len())));
    let recorded = Memo::new(move |_| {
        lab.text.track();
        lab.drafting.turned.track();
        lab.ask_of_shown(|session, id| session.recorded_example(id).map(String::from)).flatten()
    });
    let marks = Memo::new(move |_| {
        form.track();
        let recorded = recorded.get();
        let marked = marked.with(|marked| Marked { recorded, ..marked.clone() });
        lab.picture.with_untracked(|picture| marks(picture, &marked))
    });
    let listed = move |picture: &PictureView, part: Part<'_>| {
        form.track();
        marks.with(|marks| display_list(picture, part, marks))
    };
    let still = Memo::new(move |_| {
        lab.moved.with(|moved| {
            let is_split = *moved != MovedView::Everything;
            let list = || lab.picture.with_untracked(|p| listed(p, Part::Still(moved)));
            is_split.then(|| Arc::new(list()))
        })
    });
    // what is drawn for construction alone is in sight while a program is recorded
    let guided = Memo::new(move |_| {
        lab.text.track();
        lab.values.track();
        lab.drafting.turned.track();
        lab.ask_of_shown(session::Session::guides).unwrap_or_default()
    });
    let list = Memo::new(move |_| {
        lab.picture.with(|picture| {
            let mut list = lab.moved.with(|moved| listed(picture, Part::Moving(moved)));
            lab.plotting.plot.with(|plot| loci(&mut list, &plot.drawn_loci()));
            lab.ghosts.with(|drawn| ghosts(&mut list, drawn));
            lab.traced.with(|drawn| ghosts(&mut list, std::slice::from_ref(drawn)));
            lab.annotate(&mut list, picture);
            guided.with(|drawn| guides(&mut list, drawn, &picture.drawing));
            lab.motion.with(|motion| arrows(&mut list, picture, motion));
            lab.tool_view.with(|tool| {
                preview(&mut list, &tool.preview, &picture.drawing);
                tool.caught.iter().for_each(|found| caught(&mut list, found));
            });
            lab.dropping.with(|d| d.iter().for_each(|(_, found)| caught(&mut list, found)));
            lab.attachers.with(|chosen| {
                for (n, path) in chosen.iter().flatten().enumerate() {
                    let grip = picture.grips.iter().find(|grip| grip.path == *path);
                    let word = (n + 1).to_string();
                    grip.inspect(|g| caught(&mut list, &Caught { at: (g.x, g.y), word }));
                }
            });
            Arc::new(list)
        })
    });
    (still, list)
}

/// Paints with the page's next frame whenever something is another, so that what is done at once is painted once. A
/// canvas of another size is blank: it is painted at once.
fn keep_painted(
    lab: Lab,
    painter: StoredValue<Option<Painter>, LocalStorage>,
    size: RwSignal<(f64, f64)>,
    lists: Lists,
) {
    let last = StoredValue::new_local(Painted::default());
    let is_due = StoredValue::new(false);
    let paint_now = move || {
        // the panel may have gone with its document
        if is_due.try_get_value().is_none() {
            return;
        }
        is_due.set_value(false);
        let begun = js::now();
        painter.with_value(|painter| {
            if let Some(painter) = painter {
                let size = size.get_untracked();
                last.update_value(|last| paint_lists(lab, painter, size, (lists, last)));
            }
        });
        lab.painted_in.set_value(js::now() - begun);
    };
    let paint_if_due = move || {
        if is_due.try_get_value() == Some(true) {
            paint_now();
        }
    };
    Effect::new(move |before: Option<(f64, f64)>| {
        lab.colors.changes.track();
        lab.grid.track();
        lab.view.track();
        lists.0.track();
        lists.1.track();
        let now = size.get();
        if before != Some(now) {
            paint_now();
        } else if !is_due.get_value() {
            is_due.set_value(true);
            request_animation_frame(paint_if_due);
        }
        now
    });
}

/// Paints the picture's lists as they are now. What is as it was in the frame before lies under the rest, as a picture.
fn paint_lists(
    lab: Lab,
    painter: &Painter,
    size: (f64, f64),
    ((still, list), last): (Lists, &mut Painted),
) {
    let (view, is_ruled) = (lab.view.get_untracked(), lab.grid.get_untracked());
    let seen = Seen { view, size, grid: is_ruled, looks: lab.colors.changes.get_untracked() };
    let grid = || if is_ruled { grid(&view, size) } else { Vec::new() };
    let list = list.get_untracked();
    let (under, rest) = match still.get_untracked() {
        Some(still) => (Some(still), None),
        None => last.common(&list, &seen).unzip(),
    };
    let lies_there = last.seen.as_ref() == Some(&seen) && last.under == under;
    let mut texts = std::mem::take(&mut last.texts);
    match &under {
        Some(under) if !lies_there => {
            painter.forget();
            texts = paint(painter, (under, &under.numbers), grid(), &view, texts);
            painter.keep();
        }
        Some(_) => {}
        None => painter.forget(),
    }
    let lines = if under.is_some() { Vec::new() } else { grid() };
    let rest = rest.as_ref().unwrap_or(&list.numbers);
    last.texts = paint(painter, (&list, rest), lines, &view, texts);
    (last.under, last.list, last.seen) = (under, Some(list), Some(seen));
}

/// What the painter has painted last.
#[derive(Default)]
struct Painted {
    texts: Texts,
    /// What lies under the rest.
    under: Option<Arc<DisplayList>>,
    list: Option<Arc<DisplayList>>,
    seen: Option<Seen>,
}

impl Painted {
    /// Returns a beginning of a list that lies there, or is worth to, and what is behind it.
    fn common(&self, now: &DisplayList, seen: &Seen) -> Option<(Arc<DisplayList>, Vec<f64>)> {
        /// Fewer numbers are painted sooner than a picture of them.
        const WORTH: usize = 400;
        if self.seen.as_ref() != Some(seen) {
            return None;
        }
        let there = { self.under.as_ref() }.and_then(|under| Some((under, now.behind(under)?)));
        if let Some((under, rest)) = &there
            && 2 * rest.len() < under.numbers.len() + WORTH
        {
            return there.map(|(under, rest)| (under.clone(), rest));
        }
        let shared = now.shared(self.list.as_ref()?);
        let most = there.as_ref().map_or(WORTH, |(under, _)| 3 * under.numbers.len() / 2);
        if shared.numbers.len() < most {
            return there.map(|(under, rest)| (under.clone(), rest));
        }
        let rest = now.behind(&shared)?;
        Some((Arc::new(shared), rest))
    }
}

/// Words and colours that the painter has.
pub(crate) type Texts = (Vec<String>, Vec<String>);

/// How a list is seen: what was painted otherwise is painted anew.
#[derive(PartialEq)]
struct Seen {
    view: View,
    size: (f64, f64),
    grid: bool,
    looks: u32,
}

pub(crate) fn new_painter(
    canvas: &web_sys::HtmlCanvasElement,
    size: RwSignal<(f64, f64)>,
) -> Painter {
    let on_size = Closure::<dyn FnMut(f64, f64)>::new(move |width, height| {
        size.try_set((width, height));
    });
    js::create_painter(canvas, on_size.into_js_value().unchecked_ref())
}

/// Paints a list, and nothing under it; returns the words and colours that the painter has now.
pub(crate) fn paint_alone(
    painter: &Painter,
    list: &DisplayList,
    view: &View,
    texts: Texts,
) -> Texts {
    paint(painter, (list, &list.numbers), Vec::new(), view, texts)
}

/// Paints numbers before numbers of a list; returns the words and colours that the painter has now.
fn paint(
    painter: &Painter,
    (list, own): (&DisplayList, &[f64]),
    mut numbers: Vec<f64>,
    view: &View,
    (words, colors): Texts,
) -> Texts {
    let array =
        |texts: &[String]| texts.iter().map(|t| JsValue::from(t.as_str())).collect::<Array>();
    if words != list.words {
        painter.set_words(&array(&list.words));
    }
    if colors != list.colors {
        painter.set_colors(&array(&list.colors));
    }
    numbers.extend_from_slice(own);
    painter.paint(&numbers, view.x, view.y, view.scale, view.scale_y());
    (list.words.clone(), list.colors.clone())
}

/// How the sheet is seen: the step of its grid, its scale, and what changes that.
#[component]
fn Corner(lab: Lab) -> impl IntoView {
    let grid_step = grid_step(lab);
    let scale = Memo::new(move |_| {
        let millimetres = lab.picture.with(|picture| picture.millimetres);
        scale_in_words(lab.view.get().scale, millimetres)
    });
    view! {
        <div class="corner" role="group" aria-label=words::TOOLS>
            {move || grid_step.get().map(|step| view! {
                <span class="step" title=words::GRID_STEP>{step}</span>
            })}
            <button title=words::ZOOM_OUT aria-label=words::ZOOM_OUT
                on:click=move |_| lab.zoom.set(Some(Zoom::By(0.8)))>"−"</button>
            <button title=words::FIT
                aria-label=move || words::fit_at(&scale.get())
                on:click=move |_| lab.zoom.set(Some(Zoom::Fit))>
                {scale}
            </button>
            <button title=words::ZOOM_IN aria-label=words::ZOOM_IN
                on:click=move |_| lab.zoom.set(Some(Zoom::By(1.25)))>"+"</button>
        </div>
    }
}

/// A view that a panel has had moved: what it was, in which size, and what it became.
#[derive(Clone, Copy)]
struct Hidden {
    size: (f64, f64),
    view: View,
    seen: View,
}

/// What was wholly in sight does not go behind a panel that opens, and is where it was once that is shut again, unless
/// somebody has looked elsewhere meanwhile.
fn follow_size(lab: Lab, size: RwSignal<(f64, f64)>) {
    let hidden = StoredValue::new(None::<Hidden>);
    Effect::new(move |before: Option<(f64, f64)>| {
        let now = size.get();
        let view = lab.view.get_untracked();
        let moved = hidden.get_value().filter(|hidden| hidden.seen == view);
        let all = || {
            let all = lab.drawn_box()?;
            (view.holds(all, before?) && !view.holds(all, now)).then_some(all)
        };
        if lab.fits.get_value() {
            hidden.set_value(None);
            lab.zoom.set(Some(Zoom::Fit));
        } else if let Some(moved) = moved.filter(|moved| moved.size == now) {
            hidden.set_value(None);
            look(lab, moved.view);
        } else if let Some(all) = all().filter(|_| now.0 > 0.0) {
            let seen = view.with_in_sight(all, now, margin(now));
            let first = Hidden { size: before.unwrap_or(now), view, seen };
            hidden.set_value(Some(Hidden { seen, ..moved.unwrap_or(first) }));
            look(lab, seen);
        }
        now
    });
}

/// What a lesson speaks of does not lie behind its card, unless somebody looked elsewhere or has begun to draw.
fn follow_card(lab: Lab) {
    Effect::new(move |before: Option<f64>| {
        let now = lab.card.get();
        let is_shown = lab.fits.get_value() || !lab.looked.get_value() && lab.drawn_box().is_none();
        if is_shown && before.is_some_and(|before| now > before) {
            lab.zoom.set(Some(Zoom::Fit));
        }
        now
    });
}

/// Shows the sheet by another view; the pointer of the keyboard stays where it was on the sheet.
fn look(lab: Lab, view: View) {
    let before = lab.view.get_untracked();
    if view != before {
        lab.view.set(view);
        lab.keep_cursor(before);
    }
}

/// How much of the right side of a picture the document covers that a shown class is of.
fn covered(lab: Lab) -> f64 {
    let width = window().inner_width().ok().and_then(|width| width.as_f64());
    let is_wide = width.is_some_and(|width| width > NARROW);
    if is_wide && lab.prototype.with_untracked(Option::is_some) { INSET } else { 0.0 }
}

/// How far what is fitted stays from the sides of a canvas of that size.
fn margin(size: (f64, f64)) -> f64 {
    MARGIN.min(0.12 * size.0.min(size.1))
}

/// How far the lines of the grid are apart, where lengths of the sheet have a unit.
fn grid_step(lab: Lab) -> Memo<Option<String>> {
    Memo::new(move |_| {
        let unit = lab.picture.with(|picture| Some(picture.unit.as_ref()?.name.clone()));
        let step = base::number::significant(lab.view.get().grid_step(), 6);
        unit.filter(|_| lab.grid.get()).map(|unit| words::grid_step(&step, &unit))
    })
}

/// Does what was asked of the view, once the canvas has a size.
fn zoom_as_asked(lab: Lab, size: (f64, f64), left: StoredValue<Option<Left>>) {
    let Some(asked) = lab.zoom.get() else { return };
    if size.0 <= 0.0 {
        return;
    }
    lab.zoom.set(None);
    let margin = margin(size);
    let room = Room::of(lab, size);
    match asked {
        Zoom::Over(all) => {
            look(lab, lab.view.get_untracked().with_in_sight(all, size, margin));
        }
        Zoom::Fit => {
            // what is drawn must not move under a hand that holds a tool
            lab.fits.set_value(lab.tool.with_untracked(Option::is_none));
            lab.looked.set_value(false);
            show_all(lab, size, (room, margin));
        }
        Zoom::Sized if !lab.looked.get_value() => {
            let view = lab.view.get_untracked();
            if lab.drawn_box().is_some_and(|drawn| !view.shows_well(drawn, (size.0, room.height))) {
                show_all(lab, size, (room, margin));
                // what is drawn next has room beside it
                look(lab, lab.view.get_untracked().zoomed(GOOD_PART, room.middle()));
            }
        }
        Zoom::Kept(before, or_lost) if keep(lab, before, size, left) || !or_lost => {}
        Zoom::Seen | Zoom::Sized | Zoom::Within | Zoom::Kept(..) => {
            let view = lab.view.get_untracked();
            let Some(drawn) = lab.drawn_box() else { return };
            if view.loses(drawn, size) {
                show_all(lab, size, (room, margin));
            } else if asked == Zoom::Within && !lab.looked.get_value() {
                look(lab, view.with_in_sight(drawn, (room.width, size.1 - BELOW), margin));
            }
        }
        Zoom::By(factor) => {
            // about the middle of what is fitted, so that this stays in sight
            lab.look_at(|view| view.zoomed(factor, room.middle()));
        }
    }
}

/// A view that was left since a change had made what was drawn reach out of it: what was drawn there, what the view was,
/// and what it became.
#[derive(Clone, Copy)]
struct Left {
    drawn: Bounds,
    view: View,
    seen: View,
}

/// Keeps in sight what was; once the change is undone, everything is where it was, unless somebody has looked elsewhere
/// meanwhile. Returns whether the view is another one now.
fn keep(lab: Lab, before: Bounds, size: (f64, f64), left: StoredValue<Option<Left>>) -> bool {
    let (view, drawn) = (lab.view.get_untracked(), lab.drawn_box());
    let Some(drawn) = drawn else { return false };
    if let Some(old) = left.get_value().filter(|old| old.seen == view && old.drawn == drawn) {
        left.set_value(None);
        look(lab, old.view);
        return true;
    }
    // what is drawn must not move under a hand that holds a tool; one that types is not there
    let drafts = lab.drafts() && !lab.drafting.by_keys.get_value();
    let is_at_rest = lab.tool.with_untracked(Option::is_none) && !drafts;
    if !is_at_rest || !view.holds(before, size) || view.holds(drawn, size) {
        return false;
    }
    let seen = view.with_in_sight(drawn, size, margin(size));
    left.set_value(Some(Left { drawn: before, view, seen }));
    look(lab, seen);
    true
}

/// So much of the picture what is drawn fills where a length that was typed gives it its size.
const GOOD_PART: f64 = 0.6;

/// The part of a canvas that nothing lies over.
#[derive(Clone, Copy)]
struct Room {
    width: f64,
    /// How far it is from the upper side.
    above: f64,
    height: f64,
}

impl Room {
    /// What waits or is offered lies over the lower edge, a lesson over the upper one.
    fn of(lab: Lab, (width, height): (f64, f64)) -> Self {
        let width = width - covered(lab);
        let card = lab.card.get_untracked();
        if height <= LOW {
            // a lesson, and what is offered of a selection, leave half of a low picture at least
            let below = if lab.selected.with_untracked(Option::is_some) { STRIP } else { 0.0 };
            let below = below.min(height / 4.0);
            let above = card.min(height / 2.0 - below);
            return Self { width, above, height: height - above - below };
        }
        let above = card.min((height - LOW).max(height / 4.0));
        Self { width, above, height: height - BELOW - above }
    }
    fn middle(self) -> (f64, f64) {
        (self.width / 2.0, self.above + self.height / 2.0)
    }
}

/// Brings all that is drawn into sight, and what is to be traced.
fn show_all(lab: Lab, size: (f64, f64), (room, margin): (Room, f64)) {
    let all = lab.traced.with_untracked(|traced| {
        let boxes = lab.picture.with_untracked(|p| {
            let drawn = [&p.drawing, traced].into_iter().filter(|d| !d.elements.is_empty());
            drawn.map(bounds).collect::<Vec<_>>()
        });
        boxes.into_iter().reduce(|a, b| a.with(b.least).with(b.most))
    });
    let vertical = lab.picture.with_untracked(|p| p.drawing.vertical);
    let mut all = all.unwrap_or_else(|| bounds(&Drawing::default()));
    if all.least == all.most
        && let Some(across) =
            lab.picture.with_untracked(|p| p.unit.as_ref().map(|unit| unit.across))
    {
        // a place alone has no size: the unit says how much of the sheet is worth looking at
        all.least.x -= across / 2.0;
        all.most.x += across / 2.0;
    }
    let fitting = fit_box(all, vertical, (room.width, room.height), margin);
    let fitting = fitting.panned(0.0, room.above);
    look(lab, lab.picture.with_untracked(|p| with_words(&p.drawing, fitting, size)));
}

fn wheel(lab: Lab, canvas: NodeRef<Canvas>, e: &WheelEvent) {
    e.prevent_default();
    let pixels = if e.delta_mode() == 0 { e.delta_y() } else { 24.0 * e.delta_y() };
    let factor = base::number::exp(-0.0018 * pixels.clamp(-240.0, 240.0));
    let at = hand::on_canvas(canvas, (f64::from(e.client_x()), f64::from(e.client_y())));
    lab.look_at(|view| view.zoomed(factor, at));
}

/// Says of the selected point where it is and how free.
fn described(lab: Lab, selected: Option<String>) -> String {
    let Some(selected) = selected else { return String::new() };
    lab.picture.with(|picture| {
        let Some(grip) = picture.grips.iter().find(|grip| grip.path == selected) else {
            return selected;
        };
        words::point_at(&grip.path, grip.x, grip.y, grip.freedom.map(words::freedom))
    })
}

fn key(lab: Lab, hand: hand::Hand, size: (f64, f64), e: &KeyboardEvent) {
    if e.ctrl_key() || e.meta_key() || e.alt_key() {
        return;
    }
    let is_taken = lab.seek_key(&e.key(), e.shift_key());
    if is_taken || lab.tool_key(&e.key(), e.shift_key(), size) {
        e.prevent_default();
        e.stop_propagation();
        return;
    }
    let far = if e.shift_key() { 10.0 } else { 1.0 };
    let done = match e.key().as_str() {
        "ArrowLeft" => nudge(lab, -far, 0.0),
        "ArrowRight" => nudge(lab, far, 0.0),
        "ArrowUp" => nudge(lab, 0.0, -far),
        "ArrowDown" => nudge(lab, 0.0, far),
        // past what a tool finds the keyboard goes on to the next panel
        "Tab" if lab.tool.with_untracked(Option::is_some) => false,
        "Tab" => next_grip(lab, if e.shift_key() { -1 } else { 1 }),
        "Enter" => match lab.selected.get_untracked() {
            Some(path) => {
                let at = selected_grip(lab).map_or((size.0 / 2.0, size.1 / 2.0), |grip| {
                    let p = Point { x: grip.x, y: grip.y };
                    lab.view.with_untracked(|view| view.screen_from_sheet(p))
                });
                lab.edit_in_place(&path, None, at);
                true
            }
            None => false,
        },
        " " => {
            hand.hold_space(hand::Space::Down);
            true
        }
        _ => false,
    };
    if done {
        e.prevent_default();
        e.stop_propagation();
    }
}

fn selected_grip(lab: Lab) -> Option<Grip> {
    let selected = lab.selected.get_untracked()?;
    let selected = lab.structure.with_untracked(|rows| first_path(rows, selected));
    lab.picture.with_untracked(|p| p.grips.iter().find(|grip| grip.path == selected).cloned())
}

/// Moves what is selected from where it is now; `dy` runs down the screen.
fn nudge(lab: Lab, dx: f64, dy: f64) -> bool {
    /// What a constraint says goes so many pixels with each key.
    const PIXELS: f64 = 4.0;
    if lab.nudge_note((PIXELS * dx, PIXELS * dy)) {
        return true;
    }
    let Some(selected) = lab.selected.get_untracked() else { return false };
    // what was said just now counts already
    lab.list();
    let selected = lab.structure.with_untracked(|rows| first_path(rows, selected));
    let Some((x, y)) = lab.press(&selected) else { return true };
    let down = match lab.view.get_untracked().vertical {
        Vertical::Up => -1.0,
        Vertical::Down => 1.0,
    };
    lab.drag((x + dx, y + down * dy));
    lab.release();
    true
}

/// Selects the next point; past the last one the key goes on to the next panel.
fn next_grip(lab: Lab, by: isize) -> bool {
    let at = selected_grip(lab);
    let next = lab.picture.with_untracked(|picture| {
        let grips = &picture.grips;
        let now = at.and_then(|grip| grips.iter().position(|g| g.path == grip.path));
        let next = match now {
            Some(now) => now.checked_add_signed(by),
            None if by > 0 => Some(0),
            None => grips.len().checked_sub(1),
        };
        next.and_then(|n| grips.get(n).map(|grip| grip.path.clone()))
    });
    let found = next.is_some();
    lab.select(next);
    found
}

/// Returns the sheet's point at a place of the screen, for the view that is shown.
fn sheet_point(lab: Lab, at: (f64, f64)) -> Point {
    lab.view.with_untracked(|view| view.sheet_from_screen(at))
}
