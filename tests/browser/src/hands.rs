//! What a person does with the page, and what the page tells of its state.

use crate::Visit;
use fantoccini::actions::{
    Actions, InputSource, KeyAction, KeyActions, MOUSE_BUTTON_LEFT, MouseActions, PointerAction,
    TouchActions,
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
/// Where it does not within half a minute.
pub async fn show(visit: &Visit, name: &str) -> Value {
    visit.until("document.querySelector('main') && window.__thinglab").await;
    let before = visit.script("return window.__thinglab.state().text").await;
    visit.script(&format!("location.hash = '#/gallery/{name}'")).await;
    let path = format!("gallery/{name}");
    // a document that is begun with an empty sheet has no values
    visit
        .until(&format!(
            "(s => s.path === '{path}' && (s.values.length > 0 || s.text !== {before})) \
             (window.__thinglab.state())"
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

/// Brings the pointer to a place in the window.
///
/// # Panics
/// Where the browser refuses.
pub async fn hover(visit: &Visit, (x, y): (f64, f64)) {
    let duration = Some(Duration::from_millis(40));
    let to = PointerAction::MoveTo { duration, x: x.round(), y: y.round() };
    let actions = MouseActions::new("mouse".into()).then(to);
    visit.client.perform_actions(actions).await.expect("the mouse moves");
    tokio::time::sleep(Duration::from_millis(80)).await;
}

/// Takes what lies at a place in the window and puts it elsewhere, in a few steps.
///
/// # Panics
/// Where the browser refuses.
pub async fn drag(visit: &Visit, from: (f64, f64), to: (f64, f64)) {
    let actions = carried(from, to).then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
    visit.client.perform_actions(actions).await.expect("the mouse drags");
    tokio::time::sleep(Duration::from_millis(100)).await;
}

/// As [`drag`], and joins nothing: Alt is held.
///
/// # Panics
/// Where the browser refuses.
pub async fn drag_alone(visit: &Visit, from: (f64, f64), to: (f64, f64)) {
    let alt = KeyActions::new("keys".into()).then(KeyAction::Down { value: key::ALT });
    visit.client.perform_actions(alt).await.expect("the key is held");
    drag(visit, from, to).await;
    visit.client.release_actions().await.expect("the key is let go");
}

/// As [`drag`], and keeps it in the hand.
///
/// # Panics
/// Where the browser refuses.
pub async fn carry(visit: &Visit, from: (f64, f64), to: (f64, f64)) {
    visit.client.perform_actions(carried(from, to)).await.expect("the mouse drags");
}

fn carried(from: (f64, f64), to: (f64, f64)) -> MouseActions {
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
    actions.then(PointerAction::Pause { duration: Duration::from_millis(80) })
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

/// Keys by the names that people give them, as WebDriver writes them.
pub mod key {
    /// End.
    pub const END: char = '\u{e010}';
    /// Ctrl.
    pub const CONTROL: char = '\u{e009}';
    /// Alt.
    pub const ALT: char = '\u{e00a}';
    /// Shift.
    pub const SHIFT: char = '\u{e008}';
    /// Enter.
    pub const ENTER: char = '\u{e007}';
    /// Escape.
    pub const ESCAPE: char = '\u{e00c}';
    /// Tab.
    pub const TAB: char = '\u{e004}';
    /// The arrow down.
    pub const DOWN: char = '\u{e015}';
    /// The arrow to the right.
    pub const RIGHT: char = '\u{e014}';
    /// Delete.
    pub const DELETE: char = '\u{e017}';
    /// F2.
    pub const F2: char = '\u{e032}';
    /// F12.
    pub const F12: char = '\u{e03c}';
    /// Home.
    pub const HOME: char = '\u{e011}';
    /// The space bar.
    pub const SPACE: char = ' ';
}

/// Opens the lab on a document that is begun, as from the gallery.
///
/// # Panics
/// Where it does not begin.
pub async fn begin() -> Visit {
    let visit = Visit::open_new("untitled.thing").await;
    visit.until("window.__thinglab && window.__thinglab.state().path === 'untitled.thing'").await;
    visit.until("document.getElementById('picture').width > 10").await;
    visit
}

/// Presses keys one after the other.
///
/// # Panics
/// Where the browser refuses.
pub async fn keys(visit: &Visit, all: &str) {
    let mut actions = KeyActions::new("keys".into());
    for value in all.chars() {
        actions = actions.then(KeyAction::Down { value }).then(KeyAction::Up { value });
    }
    visit.client.perform_actions(actions).await.expect("the keys are pressed");
}

/// Has a document use a library, and takes the tool of a class out of the bin, where one is named.
///
/// # Panics
/// Where the bin does not have it.
pub async fn use_library(visit: &Visit, library: &str) {
    visit.script("document.getElementById('tab-bin').click()").await;
    visit.until(&format!("document.querySelector('[data-library={library}]')")).await;
    visit.script(&format!("document.querySelector('[data-library={library}]').click()")).await;
    visit.until(&format!("window.__thinglab.state().text.includes('use {library}')")).await;
}

/// Takes the tool of a class out of the bin and clicks at places in the window.
///
/// # Panics
/// Where the bin does not have it.
pub async fn place(visit: &Visit, class: &str, places: &[(f64, f64)]) {
    let tile = format!("document.querySelector('[data-class={class}]')");
    visit.until(&tile).await;
    for kind in ["pointerdown", "pointerup"] {
        let event = format!("new PointerEvent('{kind}', {{ button: 0 }})");
        visit.script(&format!("{tile}.dispatchEvent({event})")).await;
    }
    visit.until(&format!("{tile}.getAttribute('aria-pressed') === 'true'")).await;
    // the tool is in the hand when the page has been painted with it
    let painted = "requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(() => done(true), 50)))";
    visit.script(&format!("return new Promise(done => {painted})")).await;
    for &at in places {
        point(visit, at, MOUSE_BUTTON_LEFT).await;
    }
}

/// Clicks twice at a place in the window and types over the value that is there.
///
/// # Panics
/// Where no editor opens.
pub async fn type_over(visit: &Visit, (x, y): (f64, f64), value: &str) {
    let mut actions = MouseActions::new("mouse".into()).then(PointerAction::MoveTo {
        duration: Some(Duration::from_millis(40)),
        x: x.round(),
        y: y.round(),
    });
    for _ in 0..2 {
        actions = actions
            .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT })
            .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
    }
    visit.client.perform_actions(actions).await.expect("the mouse clicks twice");
    visit.until("document.querySelector('.inplace input') === document.activeElement").await;
    chord(visit, &[key::CONTROL], 'a').await;
    keys(visit, value).await;
    chord(visit, &[], key::ENTER).await;
    visit.until("!document.querySelector('.inplace')").await;
}

/// Inserts a thing by the keyboard: the bin's field, what is typed there, Enter.
///
/// # Panics
/// Where nothing changes.
pub async fn insert_by_keys(visit: &Visit, class: &str) {
    let before = text_of(&state(visit).await);
    chord(visit, &[key::ALT], '1').await;
    chord(visit, &[], 'i').await;
    visit.until("document.activeElement.matches('.bin input')").await;
    chord(visit, &[key::CONTROL], 'a').await;
    keys(visit, class).await;
    visit.until(&format!("document.activeElement.value === '{class}'")).await;
    chord(visit, &[], key::ENTER).await;
    let before = serde_json::to_string(&before).expect("a text");
    visit.until(&format!("window.__thinglab.state().text !== {before}")).await;
}

/// Sets a place of the tool in the hand by typing it, and Enter.
///
/// # Panics
/// Where the browser refuses.
pub async fn set_place_by_keys(visit: &Visit, place: &str) {
    keys(visit, place).await;
    chord(visit, &[], key::ENTER).await;
}

/// Draws a ring of four lines by the keyboard alone: three corners typed after the first, and back to that by Tab.
///
/// # Panics
/// Where it is not drawn.
pub async fn draw_ring_by_keys(visit: &Visit, corners: [&str; 4]) {
    chord(visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    for corner in corners {
        set_place_by_keys(visit, corner).await;
    }
    stop_by_keys(visit, "joins line.p1").await;
    visit.until("window.__thinglab.state().text.includes('line4')").await;
}

/// Brings the tool in the hand by Tab to where it finds what a word says, and sets it there: forward, then back.
///
/// # Panics
/// Where Tab does not lead there.
pub async fn stop_by_keys(visit: &Visit, word: &str) {
    let heard = "document.getElementById('picture-live').textContent";
    let held = "document.activeElement.id === 'picture'";
    for back in [&[][..], &[key::SHIFT]] {
        for _ in 0..24 {
            let now = visit.script(&format!("return [{heard}, {held}]")).await;
            if now[0] == word {
                return chord(visit, &[], key::ENTER).await;
            }
            if now[1] == false {
                // past the last one the keyboard is elsewhere
                chord(visit, &[key::ALT], '1').await;
                break;
            }
            chord(visit, back, key::TAB).await;
        }
    }
    panic!("Tab does not lead to where it {word}");
}

/// Brings the keyboard by Tab to an element, as an expression of `at` tells it, and presses a key there.
///
/// # Panics
/// Where Tab does not lead there, or something lies over the element.
pub async fn press_by_keys(visit: &Visit, element: &str, pressed: char) {
    pressed_by(visit, (&[], element), pressed).await;
}

/// The same by Shift+Tab.
///
/// # Panics
/// As [`press_by_keys`].
pub async fn press_back_by_keys(visit: &Visit, element: &str, pressed: char) {
    pressed_by(visit, (&[key::SHIFT], element), pressed).await;
}

async fn pressed_by(visit: &Visit, (held, element): (&[char], &str), pressed: char) {
    let seen = "(at => { const r = at.getBoundingClientRect(); \
                return at.contains(document.elementFromPoint(r.left + r.width / 2, r.top + r.height / 2)); \
                })(document.activeElement)";
    for _ in 0..80 {
        let here = format!("return Boolean((at => {element})(document.activeElement))");
        if visit.script(&here).await == true {
            visit.until(seen).await;
            return chord(visit, &[], pressed).await;
        }
        chord(visit, held, key::TAB).await;
    }
    panic!("Tab does not lead to {element}");
}

/// Goes through the rows of the structure by the arrow keys to some paths, opens what is shut on the way, and selects
/// them together.
///
/// # Panics
/// Where the keys do not lead there.
pub async fn choose_by_keys(visit: &Visit, paths: &[&str]) {
    chord(visit, &[key::ALT], '2').await;
    visit.until("document.activeElement.getAttribute('role') === 'treeitem'").await;
    for (n, path) in paths.iter().enumerate() {
        let held: &[char] = if n == 0 { &[] } else { &[key::CONTROL] };
        if n == 0 {
            chord(visit, &[], key::HOME).await;
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
        go_to_row(visit, path, held).await;
        if n > 0 {
            chord(visit, &[key::CONTROL], key::SPACE).await;
        }
    }
    let wanted = serde_json::to_string(paths).expect("paths are texts");
    visit
        .until(&format!(
            "(s => JSON.stringify([s.selected, ...s.also]) === '{wanted}')(window.__thinglab.state())"
        ))
        .await;
}

/// Brings the tree's present row to a path, with the keys that are held.
async fn go_to_row(visit: &Visit, path: &str, held: &[char]) {
    let row = "document.activeElement.closest('[role=treeitem]')";
    // between two frames no row may have the keyboard
    let ask = format!(
        "return (r => r ? [r.dataset.path, r.id, r.getAttribute('aria-expanded')] : [])({row})"
    );
    for _ in 0..400 {
        let now = visit.script(&ask).await;
        if now[1].is_null() {
            tokio::time::sleep(Duration::from_millis(20)).await;
            continue;
        }
        let at = now[0].as_str().unwrap_or_default();
        if at == path {
            return;
        }
        let leads = at.is_empty() || path.starts_with(&format!("{at}."));
        if leads && now[2] == "false" {
            chord(visit, &[], key::RIGHT).await;
            visit.until(&format!("{row} && {row}.getAttribute('aria-expanded') !== 'false'")).await;
            continue;
        }
        chord(visit, held, key::DOWN).await;
        // the page gives the row the keyboard with its next frame
        let mut is_last = true;
        for _ in 0..10 {
            tokio::time::sleep(Duration::from_millis(20)).await;
            let next = visit.script(&ask).await;
            if !next[1].is_null() && next[1] != now[1] {
                is_last = false;
                break;
            }
        }
        if is_last {
            chord(visit, held, key::HOME).await;
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
    }
    let rows = "return [...document.querySelectorAll('[role=treeitem]')].map(r => r.dataset.path).join(' ')";
    let rows = visit.script(rows).await;
    panic!("the keys do not lead to {path}; the tree shows {rows}");
}

/// Where a word in the picture of a thing lies in the window: the first that has a figure.
///
/// # Panics
/// Where the thing shows none.
pub fn word(state: &Value, path: &str) -> (f64, f64) {
    let words = state["words"].as_array().expect("words are a list");
    let has_figure = |word: &&Value| {
        word["path"] == path
            && word["text"].as_str().is_some_and(|t| t.contains(|c: char| c.is_ascii_digit()))
    };
    let word = words.iter().find(has_figure).unwrap_or_else(|| panic!("{path} shows no number"));
    (word["px"].as_f64().expect("a number"), word["py"].as_f64().expect("a number"))
}

/// Selects what lies at some places in the window, together.
///
/// # Panics
/// Where the browser refuses.
pub async fn select(visit: &Visit, places: &[(f64, f64)]) {
    for (n, at) in places.iter().enumerate() {
        let held = KeyActions::new("keys".into()).then(KeyAction::Down { value: key::CONTROL });
        if n > 0 {
            visit.client.perform_actions(held).await.expect("Ctrl is held");
        }
        point(visit, *at, MOUSE_BUTTON_LEFT).await;
        let free = KeyActions::new("keys".into()).then(KeyAction::Up { value: key::CONTROL });
        if n > 0 {
            visit.client.perform_actions(free).await.expect("Ctrl is let go");
        }
    }
}

/// Touches places in the window with a finger, one after the other.
///
/// # Panics
/// Where the browser refuses.
pub async fn touch(visit: &Visit, places: &[(f64, f64)]) {
    for (x, y) in places {
        let to = PointerAction::MoveTo { duration: None, x: x.round(), y: y.round() };
        let actions = TouchActions::new("finger".into())
            .then(to)
            .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT })
            .then(PointerAction::Pause { duration: Duration::from_millis(30) })
            .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
        visit.client.perform_actions(actions).await.expect("the finger touches");
        tokio::time::sleep(Duration::from_millis(80)).await;
    }
}

/// Where the middle of an element lies in the window.
///
/// # Panics
/// Where there is none.
pub async fn middle(visit: &Visit, selector: &str) -> (f64, f64) {
    visit.until(&format!("document.querySelector('{selector}')")).await;
    let script = format!(
        "const r = document.querySelector('{selector}').getBoundingClientRect(); \
         return [r.left + r.width / 2, r.top + r.height / 2]"
    );
    let at = visit.script(&script).await;
    (at[0].as_f64().expect("a number"), at[1].as_f64().expect("a number"))
}

/// Touches a place in the window twice, as one opens what is there.
///
/// # Panics
/// Where the browser refuses.
pub async fn touch_twice(visit: &Visit, (x, y): (f64, f64)) {
    let to = PointerAction::MoveTo { duration: None, x: x.round(), y: y.round() };
    let mut actions = TouchActions::new("finger".into()).then(to);
    for _ in 0..2 {
        actions = actions
            .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT })
            .then(PointerAction::Pause { duration: Duration::from_millis(30) })
            .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT })
            .then(PointerAction::Pause { duration: Duration::from_millis(40) });
    }
    visit.client.perform_actions(actions).await.expect("the finger touches twice");
}

/// Pinches the sheet with two fingers that come down one after the other.
///
/// # Panics
/// Where the browser refuses.
pub async fn pinch(visit: &Visit, at: [(f64, f64); 2]) {
    let finger = |name: &str, (x, y): (f64, f64), (wait, way): (u64, f64)| {
        let to = |x: f64| PointerAction::MoveTo {
            duration: Some(Duration::from_millis(60)),
            x: x.round(),
            y: y.round(),
        };
        TouchActions::new(name.into())
            .then(to(x))
            .then(PointerAction::Pause { duration: Duration::from_millis(wait) })
            .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT })
            .then(PointerAction::Pause { duration: Duration::from_millis(60 - wait) })
            .then(to(x + 20.0 * way))
            .then(to(x + 40.0 * way))
            .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT })
    };
    let both =
        Actions::from(finger("finger", at[0], (0, -1.0))).and(finger("other", at[1], (30, 1.0)));
    visit.client.perform_actions(both).await.expect("two fingers pinch");
}

/// Drags what lies at a place in the window to another, with a finger.
///
/// # Panics
/// Where the browser refuses.
pub async fn drag_by_finger(visit: &Visit, from: (f64, f64), to: (f64, f64)) {
    let at = |k: f64| PointerAction::MoveTo {
        duration: Some(Duration::from_millis(30)),
        x: (from.0 + k * (to.0 - from.0)).round(),
        y: (from.1 + k * (to.1 - from.1)).round(),
    };
    let mut actions = TouchActions::new("finger".into())
        .then(at(0.0))
        .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT });
    for k in 1..=5 {
        actions = actions.then(at(f64::from(k) / 5.0));
    }
    let actions = actions
        .then(PointerAction::Pause { duration: Duration::from_millis(80) })
        .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
    visit.client.perform_actions(actions).await.expect("the finger drags");
    tokio::time::sleep(Duration::from_millis(100)).await;
}
