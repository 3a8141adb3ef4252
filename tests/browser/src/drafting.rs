//! What a draughtsman does in the drawer *Draw*: constructions and their operands, a program and its parameters. Each
//! is counted: one choice, one pick, one key of the calculator, one thing that is typed.

use crate::Visit;
use crate::hands::{self, key, state};
use fantoccini::Locator;
use fantoccini::actions::MOUSE_BUTTON_LEFT;
use std::time::Duration;

/// Chooses something by a click, once it is there.
///
/// # Panics
/// Where it does not come, or nothing can click it.
pub async fn press(visit: &Visit, selector: &str) {
    visit.act();
    let found = visit.client.wait().for_element(Locator::Css(selector)).await;
    let found = found.unwrap_or_else(|e| panic!("{selector}: {e}"));
    if let Err(e) = found.click().await {
        let stopped = "return document.querySelector('.crash')?.innerText";
        panic!("{selector}: {e}; {}", visit.script(stopped).await);
    }
}

/// Types into a field in place of what is there.
///
/// # Panics
/// Where there is no such field.
pub async fn fill(visit: &Visit, selector: &str, text: &str) {
    visit.act();
    let found = visit.client.wait().for_element(Locator::Css(selector)).await;
    let found = found.unwrap_or_else(|e| panic!("{selector}: {e}"));
    visit.script(&format!("document.querySelector(\"{selector}\").select()")).await;
    found.send_keys(text).await.unwrap_or_else(|e| panic!("{selector}: {e}"));
}

/// Types into a field and presses Enter.
///
/// # Panics
/// Where there is no such field.
pub async fn submit(visit: &Visit, selector: &str, text: &str) {
    fill(visit, selector, &format!("{text}{}", key::ENTER)).await;
    tokio::time::sleep(Duration::from_millis(80)).await;
}

/// Begins a construction.
///
/// # Panics
/// Where there is none of that name.
pub async fn construct(visit: &Visit, id: &str) {
    press(visit, &format!("[data-construction='{id}']")).await;
}

/// Types an operand.
///
/// # Panics
/// Where none is wanted.
pub async fn enter(visit: &Visit, typed: &str) {
    submit(visit, "input[name='operand']", typed).await;
}

/// Where a place of a sheet whose `y` runs up is seen in the window.
///
/// # Panics
/// Where the page does not say how its sheet lies.
pub async fn seen(visit: &Visit, x: f64, y: f64) -> (f64, f64) {
    let sheet = state(visit).await["sheet"].clone();
    let of = |name: &str| sheet[name].as_f64().expect("a number");
    (of("px") + x * of("scale"), of("py") - y * of("scale"))
}

/// Clicks where a place of the sheet is seen.
///
/// # Panics
/// Where the browser refuses.
pub async fn pick(visit: &Visit, x: f64, y: f64) {
    visit.act();
    hands::point(visit, seen(visit, x, y).await, MOUSE_BUTTON_LEFT).await;
}

/// Presses keys of the calculator.
///
/// # Panics
/// Where it is not open, or has no such key.
pub async fn calculate(visit: &Visit, keys: &[&str]) {
    for label in keys {
        press(visit, &format!("[data-key='{label}']")).await;
    }
}

/// Defines a parameter of what is recorded: its name and its example, and what was filled in besides.
///
/// # Panics
/// Where it is not taken.
pub async fn define(visit: &Visit, name: &str, example: &str) {
    fill(visit, "input[name='parameter']", name).await;
    fill(visit, "input[name='example']", example).await;
    press(visit, "[data-draft='define']").await;
    visit.until(&format!("document.querySelector(\"[data-parameter='{name}']\")")).await;
}

/// Gives a parameter of the example another value.
///
/// # Panics
/// Where there is none of that name.
pub async fn set(visit: &Visit, parameter: &str, value: &str) {
    submit(visit, &format!("input[name='value-{parameter}']"), value).await;
}

/// Waits until the text of the document has something.
///
/// # Panics
/// Where it does not come.
pub async fn has(visit: &Visit, text: &str) {
    visit.until(&format!("window.__thinglab.state().text.includes('{text}')")).await;
}

/// Waits until the prompt says something.
///
/// # Panics
/// Where it does not.
pub async fn asked(visit: &Visit, words: &str) {
    visit.until(&format!("document.querySelector('.prompt')?.innerText.includes('{words}')")).await;
}
