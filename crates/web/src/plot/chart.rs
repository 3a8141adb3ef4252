//! The chart: painted as pictures are; wheel and hand zoom and shift it, the pointer or the arrow keys read it.

use crate::js::Painter;
use crate::paint::{Part, display_list};
use crate::picture::{Texts, new_painter, paint_alone};
use crate::sheet::View;
use crate::{theme, words};
use drawing::{Point, Vertical};
use leptos::ev::{KeyboardEvent, PointerEvent, WheelEvent};
use leptos::html::Canvas;
use leptos::prelude::*;
use presentation::chart::beside;
use session::plotting::Plot;
use session::plotting::chart::Frame;
use session::view::PictureView;

/// How much of a frame one step of a key shifts or zooms.
const ZOOM: f64 = 1.25;

/// A plot as a chart.
#[component]
pub fn Chart(
    /// What is plotted.
    plot: RwSignal<Plot>,
    /// The page's colours.
    colors: theme::Colors,
) -> impl IntoView {
    let canvas = NodeRef::<Canvas>::new();
    let size = RwSignal::new((0.0, 0.0));
    let painter = StoredValue::new_local(None::<Painter>);
    let chosen = RwSignal::new(None::<Frame>);
    let held = RwSignal::new(None::<Point>);
    let read = RwSignal::new(None::<(usize, (f64, f64))>);
    let frame = Memo::new(move |_| {
        let size = size.get();
        match chosen.get() {
            Some(frame) => Frame { size, ..frame },
            None => plot.with(|plot| Frame::of(plot, size)),
        }
    });
    Effect::new(move |_| {
        if let Some(canvas) = canvas.get() {
            painter.set_value(Some(new_painter(&canvas, size)));
        }
    });
    on_cleanup(move || painter.with_value(|p| p.as_ref().map(Painter::stop)).unwrap_or_default());
    Effect::new(move |_| {
        colors.changes.track();
        painter.with_value(|p| p.as_ref().map(Painter::look));
    });
    Effect::new(move |last: Option<Texts>| {
        colors.changes.track();
        let frame = frame.get();
        let drawing = plot.with(|plot| plot.chart(&frame));
        let picture = PictureView { drawing, ..PictureView::default() };
        let list = display_list(&picture, Part::Whole, &[]);
        let view = View { scale: 1.0, x: 0.0, y: 0.0, vertical: Vertical::Down };
        let paint_all = |painter: &Option<Painter>| {
            let painter = painter.as_ref().filter(|_| frame.size.0 > 0.0)?;
            Some(paint_alone(painter, &list, &view, last.clone().unwrap_or_default()))
        };
        painter.with_value(paint_all).unwrap_or_default()
    });
    let at = |e: &PointerEvent| Point { x: f64::from(e.offset_x()), y: f64::from(e.offset_y()) };
    let moved = move |e: PointerEvent| {
        let at = at(&e);
        match held.get_untracked() {
            Some(from) => {
                chosen.set(Some(frame.get_untracked().shifted(from, at)));
                held.set(Some(at));
            }
            None => read.set(plot.with_untracked(|plot| plot.nearest(&frame.get_untracked(), at))),
        }
    };
    let wheel = move |e: WheelEvent| {
        e.prevent_default();
        let at = Point { x: f64::from(e.offset_x()), y: f64::from(e.offset_y()) };
        let factor = if e.delta_y() < 0.0 { 1.0 / ZOOM } else { ZOOM };
        chosen.set(Some(frame.get_untracked().zoomed(factor, at)));
    };
    let key = move |e: KeyboardEvent| {
        if e.ctrl_key() || e.meta_key() || e.alt_key() {
            return;
        }
        let (wide, high) = size.get_untracked();
        let middle = Point { x: wide / 2.0, y: high / 2.0 };
        match e.key().as_str() {
            "ArrowLeft" | "ArrowRight" | "ArrowUp" | "ArrowDown" => {
                let step = |e: &KeyboardEvent| {
                    plot.with_untracked(|p| beside(p, read.get_untracked(), &e.key()))
                };
                read.set(step(&e));
            }
            "+" | "=" => chosen.set(Some(frame.get_untracked().zoomed(1.0 / ZOOM, middle))),
            "-" => chosen.set(Some(frame.get_untracked().zoomed(ZOOM, middle))),
            "f" | "F" => chosen.set(None),
            _ => return,
        }
        e.prevent_default();
        e.stop_propagation();
    };
    let readout = move || read.get().map(|found| plot.with(|plot| plot.in_words(found)));
    let dot = move || {
        let at = read.get().map(|(_, p)| frame.get().place(p));
        at.map(|at| view! { <span class="read" style:left=format!("{}px", at.x) style:top=format!("{}px", at.y)></span> })
    };
    view! {
        <div class="chart">
            <canvas node_ref=canvas tabindex="0" role="img" aria-label=move || plot.with(words::chart_of)
                title=words::CHART_HELP
                on:pointermove=moved
                on:pointerdown=move |e: PointerEvent| held.set(Some(at(&e)))
                on:pointerup=move |_| held.set(None)
                on:pointerleave=move |_| { held.set(None); read.set(None); }
                on:dblclick=move |_| chosen.set(None)
                on:wheel=wheel
                on:keydown=key></canvas>
            {dot}
            <output class="readout" aria-live="polite">{readout}</output>
        </div>
    }
}
