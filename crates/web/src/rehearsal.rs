//! The rehearsal: a worker does beforehand what hands do first ([`session::jobs::Job::rehearsal`]).
//!
//! It runs the page's own code, and what is compiled for one of them is compiled for both; nobody waits for it.
//! A browser that keeps anything under [`NEVER`] has none: where pages are opened by the hundred, each for a moment.

use crate::files::Files;
use crate::js::{self, Worker};
use crate::lab::Lab;
use crate::theme;
use js_sys::Uint8Array;
use session::jobs::{Job, LongAnswer};
use session::plain::{read, written};
use std::cell::OnceCell;
use std::rc::Rc;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

/// Where a browser keeps that nothing is rehearsed in it.
pub const NEVER: &str = "thinglab/no-rehearsal";

impl Lab {
    /// Fetches what is missing of the page's code, and rehearses where there is such a part.
    pub async fn fetch_rest(self) {
        if js::fetch_rest().await.is_truthy() && theme::keep(NEVER).is_none() {
            self.rehearse();
        }
    }

    /// Starts a worker that rehearses and ends.
    fn rehearse(self) {
        let Some(job) = Job::rehearsal(&Files(self.files)) else { return };
        let worker: Rc<OnceCell<Worker>> = Rc::default();
        let told = worker.clone();
        let said = Closure::<dyn FnMut(String, JsValue)>::new(
            move |word: String, what: JsValue| match word.as_str() {
                "ready" => {
                    let bytes = Uint8Array::from(&written(&job)[..]);
                    told.get().inspect(|worker| worker.ask(&bytes));
                }
                "part" => {
                    let answer = read(&what.unchecked_ref::<Uint8Array>().to_vec());
                    if let Some(LongAnswer::Refused(why)) = answer {
                        leptos::logging::warn!("rehearsal: {why}");
                    }
                }
                _ => {
                    told.get().inspect(|worker| worker.end());
                }
            },
        );
        let started = js::start_worker(said.into_js_value().unchecked_ref());
        if !started.is_undefined() {
            // it is the only one
            let _ = worker.set(started.unchecked_into());
        }
    }
}
