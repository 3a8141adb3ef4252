//! The worker: answers long jobs on a copy of the document, while the page goes on.
//!
//! In: jobs as bytes (`session::plain`). Out: their answers, part by part. It has no page, no server and no storage.

use crate::js;
use js_sys::{Function, Uint8Array};
use session::jobs::{Desk, Job};
use session::plain::{read, written};
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

/// Answers jobs from now on.
pub fn start() {
    js::load_rest();
    let mut desk = Desk::default();
    let answer = Closure::<dyn FnMut(Uint8Array, Function)>::new(move |job: Uint8Array, tell| {
        // the page is of the same build: its bytes are those of a job
        if let Some(job) = read::<Job>(&job.to_vec()) {
            desk.take(job);
            let mut part = 0;
            while let Some(answer) = desk.answer(part) {
                say(&tell, &Uint8Array::from(&written(&answer)[..]));
                part += 1;
            }
        }
        say(&tell, &JsValue::UNDEFINED);
    });
    js::serve(answer.into_js_value().unchecked_ref());
}

fn say(tell: &Function, what: &JsValue) {
    // a page that has gone hears nothing
    let _ = tell.call1(&JsValue::UNDEFINED, what);
}
