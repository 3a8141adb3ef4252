//! A small picture of a document, which moves while one looks at it.

use super::{Texts, new_painter, paint_alone};
use crate::js::{self, Painter};
use crate::lab::Lab;
use crate::orbit;
use crate::paint::{Part, display_list, ghosts};
use crate::sheet::{fit, with_words};
use leptos::html::Canvas;
use leptos::prelude::*;
use session::view::{DocumentId, Grip};

const MARGIN: f64 = 18.0;
/// How far the grip swings, as a part of the picture's width.
const SWING: f64 = 0.09;
/// Turns for one frame.
const PACE: f64 = 0.006;

/// A document's picture, with what its lesson has people trace on an empty sheet; while `lively`, its first free point goes round in a small circle.
#[component]
pub fn Thumbnail(
    /// The lab.
    lab: Lab,
    /// Which document.
    id: DocumentId,
    /// Whether somebody looks at it.
    lively: RwSignal<bool>,
) -> impl IntoView {
    let canvas = NodeRef::<Canvas>::new();
    let size = RwSignal::new((0.0, 0.0));
    let painter = StoredValue::new_local(None::<Painter>);
    let picture = RwSignal::new(lab.ask(|session| session.picture(id)));
    let traced = StoredValue::new(lab.ask(|session| session.to_trace(id)));
    let rest = StoredValue::new(picture.with_untracked(|picture| {
        let drawn = Some(&picture.drawing).filter(|drawn| !drawn.elements.is_empty()).cloned();
        drawn.unwrap_or_else(|| traced.get_value())
    }));
    Effect::new(move |_| {
        if let Some(canvas) = canvas.get() {
            painter.set_value(Some(new_painter(&canvas, size)));
        }
    });
    on_cleanup(move || painter.with_value(|p| p.as_ref().map(Painter::stop)).unwrap_or_default());
    Effect::new(move |_| {
        lab.colors.changes.track();
        painter.with_value(|p| p.as_ref().map(Painter::look));
    });
    Effect::new(move |last: Option<Texts>| {
        lab.colors.changes.track();
        let size = size.get();
        let view = rest.with_value(|drawing| with_words(drawing, fit(drawing, size, MARGIN), size));
        let mut list = picture.with(|picture| display_list(picture, Part::Whole, &[]));
        traced.with_value(|traced| ghosts(&mut list, std::slice::from_ref(traced)));
        painter
            .with_value(|painter| {
                let painter = painter.as_ref().filter(|_| size.0 > 0.0)?;
                Some(paint_alone(painter, &list, &view, last.unwrap_or_default()))
            })
            .unwrap_or_default()
    });
    Effect::new(move |_| {
        if lively.get() && !js::calm() {
            let grip = orbit::grip(&picture.get_untracked());
            if let Some((grip, path)) =
                grip.and_then(|g| Some((g.clone(), session::parse_path(&g.path)?)))
                && lab.order(|session| session.press(id, &path)).is_ok()
            {
                let across = rest.with_value(orbit::width);
                request_animation_frame(move || {
                    swing(lab, id, grip, across * SWING, 0.0, lively, picture);
                });
            }
        }
    });
    view! { <canvas class="thumbnail" node_ref=canvas aria-hidden="true"></canvas> }
}

/// One frame of the small circle, and the next; at the end all is as it was.
fn swing(
    lab: Lab,
    id: DocumentId,
    grip: Grip,
    radius: f64,
    turn: f64,
    lively: RwSignal<bool>,
    picture: RwSignal<session::view::PictureView>,
) {
    let goes_on = lively.try_get_untracked() == Some(true);
    lab.order(|session| {
        if goes_on {
            session.drag(id, orbit::place(&grip, radius, turn));
        } else {
            session.cancel(id);
        }
    });
    let now = lab.ask(|session| session.picture(id));
    picture.try_set(now);
    if goes_on {
        request_animation_frame(move || {
            swing(lab, id, grip, radius, turn + PACE, lively, picture);
        });
    }
}
