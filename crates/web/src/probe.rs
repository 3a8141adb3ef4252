//! `window.__thinglab.state()`: what the lab shows, for browser tests and for whoever looks.

use crate::js::{self, set_option};
use crate::lab::{Lab, Notice};
use crate::words;
use drawing::Point;
use js_sys::{Array, JSON, Object};
use leptos::prelude::*;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

/// Offers the lab's state to the page's scripts.
pub fn publish(lab: Lab) {
    let state = Closure::<dyn FnMut() -> String>::new(move || state(lab));
    js::publish(state.into_js_value().unchecked_ref());
}

fn object(fields: &[(&str, JsValue)]) -> JsValue {
    let object = Object::new();
    fields.iter().for_each(|(name, value)| set_option(&object, name, value));
    object.into()
}

fn text(words: &str) -> JsValue {
    JsValue::from(words)
}

/// The words of the picture and of what constraints say, each where a pointer hits it in the window.
fn words_seen(lab: Lab, (left, top): (f64, f64)) -> Array {
    let view = lab.view.get_untracked();
    lab.picture.with_untracked(|picture| {
        let word = |element: &drawing::Element| {
            let drawing::Shape::Text { at, text: shown, anchoring, placement, turn } =
                &element.shape
            else {
                return None;
            };
            let size = match placement {
                drawing::Placement::OnSheet(height) => height * view.scale,
                drawing::Placement::OnScreen(height) => *height,
            };
            let lie = drawing::Lie { at: *at, turn: *turn, vertical: view.vertical };
            let (right, down) = anchoring.start(shown, size, lie);
            let (x, y) = view.screen_from_sheet(*at);
            let (x, y) = (x + right, y + down);
            let path = picture.paths.get(element.tag.0 as usize)?;
            // where a pointer hits it: a little to the right of where it begins
            Some(object(&[
                ("path", text(path)),
                ("text", text(shown)),
                ("px", (left + x + 10.0).into()),
                ("py", (top + y - 4.0).into()),
            ]))
        };
        let said = |note: &presentation::annotations::Note| {
            object(&[
                ("path", text(&note.path)),
                ("text", text(&note.words)),
                ("px", (left + note.at.0).into()),
                ("py", (top + note.at.1).into()),
            ])
        };
        let drawn = picture.drawing.elements.iter().filter_map(word);
        lab.annotated.notes.with_value(|notes| drawn.chain(notes.iter().map(said)).collect())
    })
}

fn state(lab: Lab) -> String {
    lab.list();
    let document = lab.document.get_untracked();
    let values: Array = lab.values.with_untracked(|rows| {
        let row = |row: &session::view::ValueRow| {
            object(&[
                ("path", text(&row.path)),
                ("text", text(&row.text)),
                ("unit", text(&row.unit)),
                ("number", row.number.into()),
                ("given", row.given.into()),
                ("anchored", row.anchored.into()),
            ])
        };
        rows.iter().map(row).collect()
    });
    let corner = leptos::prelude::document().get_element_by_id("picture").map(|canvas| {
        let rect = canvas.get_bounding_client_rect();
        (rect.left(), rect.top())
    });
    let (left, top) = corner.unwrap_or_default();
    let view = lab.view.get_untracked();
    let grips: Array = lab.picture.with_untracked(|picture| {
        let grip = |grip: &session::view::Grip| {
            let (x, y) = view.screen_from_sheet(Point { x: grip.x, y: grip.y });
            object(&[
                ("path", text(&grip.path)),
                ("x", grip.x.into()),
                ("y", grip.y.into()),
                ("px", (left + x).into()),
                ("py", (top + y).into()),
                ("anchored", grip.anchored.into()),
            ])
        };
        picture.grips.iter().map(grip).collect()
    });
    let words = words_seen(lab, (left, top));
    let status = lab.status.get_untracked();
    let notice = match lab.notice.get_untracked() {
        Some(Notice::Said(words)) => words,
        Some(Notice::Refused(refusal)) => refusal.message,
        Some(Notice::Asked(question)) => question.message,
        Some(Notice::Recognised(found)) => words::recognised(&found),
        None => String::new(),
    };
    let diagnostics: Array = lab.text.with_untracked(|view| {
        let one = |d: &session::view::DiagnosticView| {
            object(&[("code", text(&d.code)), ("message", text(&d.message))])
        };
        view.diagnostics.iter().map(one).collect()
    });
    let state = object(&[
        ("path", lab.current.get_untracked().into()),
        ("title", document.as_ref().map(|d| d.title.clone()).into()),
        ("dirty", document.as_ref().is_some_and(|d| d.dirty).into()),
        ("values", values.into()),
        ("grips", grips.into()),
        ("words", words.into()),
        (
            "status",
            object(&[
                ("satisfied", status.satisfied.into()),
                ("freedom", status.freedom.into()),
                ("message", text(&status.message)),
                ("undo", status.undo.into()),
                ("redo", status.redo.into()),
            ]),
        ),
        (
            "sheet",
            object(&[
                ("px", (left + view.screen_from_sheet(Point { x: 0.0, y: 0.0 }).0).into()),
                ("py", (top + view.screen_from_sheet(Point { x: 0.0, y: 0.0 }).1).into()),
                ("scale", view.scale.into()),
            ]),
        ),
        ("text", lab.text.with_untracked(|view| text(&view.source))),
        ("diagnostics", diagnostics.into()),
        ("notice", text(&notice)),
        ("selected", lab.selected.get_untracked().into()),
        ("also", lab.also.get_untracked().into_iter().map(JsValue::from).collect::<Array>().into()),
        ("plotted", plotted(lab)),
        ("made", made(lab).into()),
        ("dragging", lab.dragging.with_untracked(Option::is_some).into()),
    ]);
    JSON::stringify(&state).map(String::from).unwrap_or_default()
}

/// The values of what is computed.
fn made(lab: Lab) -> Array {
    let text = |text: &str| JsValue::from_str(text);
    lab.structure.with_untracked(|rows| {
        let rows = rows.iter().filter(|row| row.kind == session::view::RowKind::Virtual);
        let valued = rows.filter_map(|row| Some((&row.path, row.value.as_ref()?)));
        valued
            .map(|(path, value)| object(&[("path", text(path)), ("value", text(value))]))
            .collect()
    })
}

/// What the plot shows, and how many samples it has.
fn plotted(lab: Lab) -> JsValue {
    lab.plotting.plot.with_untracked(|plot| {
        let curves = plot.curves.iter().map(|c| JsValue::from(&c.axis.label)).collect::<Array>();
        let loci = plot.loci.iter().map(|l| JsValue::from(&l.label)).collect::<Array>();
        let points =
            plot.curves.iter().map(|c| &c.points).chain(plot.loci.iter().map(|l| &l.points));
        let samples = points.map(Vec::len).max().unwrap_or(0) as u32;
        object(&[("curves", curves.into()), ("loci", loci.into()), ("samples", samples.into())])
    })
}
