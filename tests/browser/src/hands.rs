//! What a person does with the page, and what the page tells of its state.

use crate::Visit;
use fantoccini::actions::{
    InputSource, KeyAction, KeyActions, MOUSE_BUTTON_LEFT, MouseActions, PointerAction,
};
use serde_json::Value;
use std::time::Duration;

/// The page's state, as it tells it.
///
/// # Panics
/// Where the page tells none.
pub async fn state(visit: &Visit) -> Value {
    let text = visit.script("return JSON.stringify(window.__thinglab.state())").await;
    serde_json::from_str(text.as_str().expect("the state is a text")).expect("the state is JSON")
}

/// Shows a document of the gallery and waits until it stands.
///
/// # Panics
/// Where it does not within ten seconds.
pub async fn show(visit: &Visit, name: &str) -> Value {
    visit.until("document.querySelector('main') && window.__thinglab").await;
    visit.script(&format!("location.hash = '#/gallery/{name}'")).await;
    let path = format!("gallery/{name}");
    visit
        .until(&format!(
            "window.__thinglab.state().path === '{path}' \
             && window.__thinglab.state().values.length > 0"
        ))
        .await;
    state(visit).await
}

/// The text of a document, in a state.
///
/// # Panics
/// Where there is none.
pub fn text_of(state: &Value) -> String {
    state["text"].as_str().expect("a text").to_string()
}

/// Where a grip lies in the window.
///
/// # Panics
/// Where there is none of this path.
pub fn grip(state: &Value, path: &str) -> (f64, f64) {
    let grips = state["grips"].as_array().expect("grips are a list");
    let grip = grips.iter().find(|g| g["path"] == path).unwrap_or_else(|| panic!("no grip {path}"));
    (grip["px"].as_f64().expect("a number"), grip["py"].as_f64().expect("a number"))
}

/// Clicks at a place in the window.
///
/// # Panics
/// Where the browser refuses.
pub async fn point(visit: &Visit, (x, y): (f64, f64), button: u64) {
    let to = PointerAction::MoveTo {
        duration: Some(Duration::from_millis(40)),
        x: x.round(),
        y: y.round(),
    };
    let actions = MouseActions::new("mouse".into())
        .then(to)
        .then(PointerAction::Pause { duration: Duration::from_millis(60) })
        .then(PointerAction::Down { button })
        .then(PointerAction::Up { button });
    visit.client.perform_actions(actions).await.expect("the mouse clicks");
    tokio::time::sleep(Duration::from_millis(80)).await;
}

/// Takes what lies at a place in the window and puts it elsewhere, in a few steps.
///
/// # Panics
/// Where the browser refuses.
pub async fn drag(visit: &Visit, from: (f64, f64), to: (f64, f64)) {
    let at = |k: f64| PointerAction::MoveTo {
        duration: Some(Duration::from_millis(30)),
        x: (from.0 + k * (to.0 - from.0)).round(),
        y: (from.1 + k * (to.1 - from.1)).round(),
    };
    let mut actions = MouseActions::new("mouse".into())
        .then(at(0.0))
        .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT });
    for k in 1..=5 {
        actions = actions.then(at(f64::from(k) / 5.0));
    }
    actions = actions
        .then(PointerAction::Pause { duration: Duration::from_millis(80) })
        .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
    visit.client.perform_actions(actions).await.expect("the mouse drags");
    tokio::time::sleep(Duration::from_millis(100)).await;
}

/// Presses a key while others are held.
///
/// # Panics
/// Where the browser refuses.
pub async fn chord(visit: &Visit, held: &[char], key: char) {
    let mut actions = KeyActions::new("keys".into());
    for &value in held {
        actions = actions.then(KeyAction::Down { value });
    }
    actions = actions.then(KeyAction::Down { value: key }).then(KeyAction::Up { value: key });
    for &value in held.iter().rev() {
        actions = actions.then(KeyAction::Up { value });
    }
    visit.client.perform_actions(actions).await.expect("the keys are pressed");
}
