//! The lab by hand: documents begun, drawn, joined, constrained and saved without a line of text, by mouse and
//! by keyboard alone; and what strangers stumbled over.

use browser::Visit;
use browser::hands::{
    begin, chord, drag, grip, hover, key, keys, middle, pinch, point, select, show, state, text_of,
    touch,
};
use fantoccini::actions::{
    InputSource, KeyAction, KeyActions, MOUSE_BUTTON_LEFT, MOUSE_BUTTON_RIGHT,
};
use serde_json::json;
use std::time::Duration;

const CONTROL: char = '\u{e009}';
const SHIFT: char = '\u{e008}';
const ENTER: char = '\u{e007}';
const ESCAPE: char = '\u{e00c}';
const DOWN: char = '\u{e015}';
const RIGHT: char = '\u{e014}';
const F2: char = '\u{e032}';
const F10: char = '\u{e03a}';
const BACKSPACE: char = '\u{e003}';

/// Where the picture's corner lies in the window, and its size.
async fn canvas(visit: &Visit) -> (f64, f64, f64, f64) {
    let script = "const r = document.getElementById('picture').getBoundingClientRect();
        return [r.left, r.top, r.width, r.height]";
    let rect = visit.script(script).await;
    let number = |n: usize| rect[n].as_f64().expect("a number");
    (number(0), number(1), number(2), number(3))
}

async fn click(visit: &Visit, at: (f64, f64)) {
    point(visit, at, MOUSE_BUTTON_LEFT).await;
}

/// Takes an offer of the strip by its label.
async fn say(visit: &Visit, label: &str) {
    visit.until(&format!("document.querySelector('[data-offer=\"{label}\"]')")).await;
    visit.script(&format!("document.querySelector('[data-offer=\"{label}\"]').click()")).await;
}

fn between(a: (f64, f64), b: (f64, f64), t: f64) -> (f64, f64) {
    (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1))
}

#[tokio::test]
async fn a_quadrilateral_and_its_midpoints_are_drawn_from_nothing_and_saved() {
    let visit = begin().await;
    let (left, top, width, height) = canvas(&visit).await;
    let at = |x: f64, y: f64| (left + x * width, top + y * height);
    let corners = [at(0.2, 0.3), at(0.5, 0.15), at(0.85, 0.4), at(0.6, 0.8)];
    chord(&visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    for corner in corners.iter().chain(&corners[..1]) {
        click(&visit, *corner).await;
    }
    visit.until("window.__thinglab.state().text.includes('line4')").await;
    let ring = state(&visit).await;
    assert_eq!(ring["status"]["freedom"], 8, "four corners: {}", text_of(&ring));

    // the inner one from middle to middle; what was drawn may have been fitted anew
    let corners = ["line.p1", "line2.p1", "line3.p1", "line4.p1"];
    let sides: Vec<(f64, f64)> = (0..4)
        .map(|n| {
            let end = |n: usize| {
                let grips = ring["grips"].as_array().expect("a list");
                let known = |path: &str| grips.iter().any(|g| g["path"] == path);
                let path = corners[n % 4];
                let other = ["line4.p2", "line.p2", "line2.p2", "line3.p2"][n % 4];
                grip(&ring, if known(path) { path } else { other })
            };
            between(end(n), end(n + 1), 0.5)
        })
        .collect();
    for (n, middle) in sides.iter().chain(&sides[..1]).enumerate() {
        if n == 2 {
            hover(&visit, *middle).await;
            visit.reference_picture("drawing").await;
        }
        click(&visit, *middle).await;
    }
    visit.until("window.__thinglab.state().text.includes('line8')").await;
    chord(&visit, &[], ESCAPE).await;
    chord(&visit, &[], ESCAPE).await;
    let drawn = state(&visit).await;
    assert_eq!(drawn["status"]["satisfied"], true);
    assert_eq!(drawn["status"]["freedom"], 8, "the inner one has none: {}", text_of(&drawn));
    assert!(text_of(&drawn).contains(".midpoint"), "{}", text_of(&drawn));

    // a corner is dragged: the inner figure stays a parallelogram
    let corner = grip(&drawn, "line2.p2");
    drag(&visit, corner, (corner.0 + 30.0, corner.1 + 25.0)).await;
    let dragged = state(&visit).await;
    assert_eq!(dragged["status"]["satisfied"], true);
    let way = |from: &str, to: &str| {
        let (a, b) = (grip(&dragged, from), grip(&dragged, to));
        (b.0 - a.0, b.1 - a.1)
    };
    let (one, other) = (way("line5.p1", "line5.p2"), way("line6.p2", "line7.p2"));
    assert!((one.0 + other.0).abs() < 0.01 && (one.1 + other.1).abs() < 0.01, "{one:?} {other:?}");

    chord(&visit, &[CONTROL], 's').await;
    visit
        .until("document.activeElement.id === 'asked' && document.activeElement.selectionEnd > 0")
        .await;
    keys(&visit, "middles").await;
    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().path === 'middles.thing'").await;
    visit.until("!window.__thinglab.state().dirty").await;
    assert_eq!(visit.saved("../middles.thing"), text_of(&dragged));
    // the way back is still there
    assert!(state(&visit).await["status"]["undo"].is_string());
    visit.book_picture("quadrilateral").await;
}

#[tokio::test]
async fn a_line_is_drawn_named_and_given_a_length_by_the_keyboard_alone() {
    let visit = begin().await;
    chord(&visit, &[], 'l').await;
    visit.until("document.activeElement.id === 'picture'").await;
    chord(&visit, &[], ENTER).await;
    chord(&visit, &[], RIGHT).await;
    keys(&visit, "129").await;
    chord(&visit, &[], BACKSPACE).await;
    chord(&visit, &[], '0').await;
    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().text.includes('line.length = 120')").await;
    chord(&visit, &[], ESCAPE).await;
    chord(&visit, &[], ESCAPE).await;
    chord(&visit, &[], F2).await;
    visit
        .until("document.activeElement.id === 'asked' && document.activeElement.selectionEnd > 0")
        .await;
    keys(&visit, "base").await;
    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().text.includes('base.length = 120')").await;
    let named = state(&visit).await;
    assert_eq!(named["selected"], "base");
    assert_eq!(named["status"]["satisfied"], true);
    // a name that is taken back is selected no longer
    chord(&visit, &[CONTROL], 'z').await;
    visit.until("window.__thinglab.state().text.includes('line.length = 120')").await;
    assert_ne!(state(&visit).await["selected"], "base");
    chord(&visit, &[CONTROL, SHIFT], 'z').await;
    visit.until("window.__thinglab.state().text.includes('base.length = 120')").await;
    visit.script("document.getElementById('tab-structure').click()").await;
    visit.script("document.querySelector('[role=treeitem][data-path=base]').click()").await;
    visit.until("window.__thinglab.state().selected === 'base'").await;

    // K goes to what can be said of it
    chord(&visit, &[], 'k').await;
    visit.until("document.activeElement.dataset.offer === 'horizontal'").await;
    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().text.includes('base.p1.y = base.p2.y')").await;

    // Shift+F10 opens the menu of the selection
    visit.script("document.getElementById('picture').focus()").await;
    chord(&visit, &[SHIFT], F10).await;
    visit.until("document.activeElement.getAttribute('role') === 'menuitem'").await;
    let first = visit.script("return document.activeElement.dataset.action").await;
    chord(&visit, &[], DOWN).await;
    let second = visit.script("return document.activeElement.dataset.action").await;
    assert_ne!(first, second);
    chord(&visit, &[], ESCAPE).await;
    visit.until("!document.querySelector('.menu')").await;
}

#[tokio::test]
async fn a_circuit_is_wired_from_the_bin_and_its_meter_read() {
    let visit = begin().await;
    visit.script("document.getElementById('tab-bin').click()").await;
    visit.until("document.querySelector('[data-library=circuits]')").await;
    visit.script("document.querySelector('[data-library=circuits]').click()").await;
    visit.until("document.querySelector('[data-class=Battery]')").await;
    let (left, top, width, height) = canvas(&visit).await;
    let at = |x: f64, y: f64| (left + x * width, top + y * height);
    let (a, b, c, d) = (at(0.2, 0.2), at(0.7, 0.2), at(0.7, 0.75), at(0.2, 0.75));
    let parts = [
        ("Battery", a, Some(d)),
        ("Ammeter", a, Some(b)),
        ("Resistor", b, Some(c)),
        ("Wire", c, Some(d)),
        ("Ground", d, None),
    ];
    let mut made: Vec<(f64, f64)> = Vec::new();
    for (class, from, to) in parts {
        let tile = format!("document.querySelector('[data-class={class}]')");
        visit
            .script(&format!(
                "{tile}.dispatchEvent(new PointerEvent('pointerdown', {{ button: 0 }}))"
            ))
            .await;
        visit
            .script(&format!(
                "{tile}.dispatchEvent(new PointerEvent('pointerup', {{ button: 0 }}))"
            ))
            .await;
        visit.until(&format!("{tile}.getAttribute('aria-pressed') === 'true'")).await;
        // the picture does not move under the hand
        click(&visit, from).await;
        if let Some(to) = to {
            click(&visit, to).await;
        }
        visit.until(&format!("window.__thinglab.state().text.includes(': {class}')")).await;
        made.push(from);
    }
    chord(&visit, &[], ESCAPE).await;
    let wired = state(&visit).await;
    assert_eq!(wired["status"]["satisfied"], true, "{}", text_of(&wired));
    let rows = wired["values"].as_array().expect("a list");
    let current =
        rows.iter().find(|r| r["path"] == "ammeter.a.current" || r["path"] == "ammeter.current");
    let current = current.and_then(|r| r["number"].as_f64()).expect("the meter has a current");
    // 1.5 V over 100 ohm
    assert!((current.abs() - 0.015).abs() < 1e-12, "{current}: {}", text_of(&wired));
}

#[tokio::test]
async fn terminals_joined_in_the_picture_carry_a_current() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    visit.put(
        "loose.thing",
        "use circuits\ny down\nbattery: Battery { a.node.at = (0, 0)  b.node.at = (0, 100) }\n\
         r: Resistor { a.node.at = (90, 0)  b.node.at = (90, 100) }\nground: Ground\n\
         merge battery.b.node = ground.lead.node\n",
    );
    visit.script("location.hash = '#/gallery/loose.thing'").await;
    visit.until("window.__thinglab.state().path === 'gallery/loose.thing' && window.__thinglab.state().grips.length > 3").await;
    visit.until("document.getElementById('picture').width > 10").await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    for end in ["a", "b"] {
        let now = state(&visit).await;
        let (from, onto) = (format!("battery.{end}.node.at"), format!("r.{end}.node.at"));
        select(&visit, &[grip(&now, &from), grip(&now, &onto)]).await;
        chord(&visit, &[], 'm').await;
        visit
            .until(&format!(
                "window.__thinglab.state().text.includes('battery.{end}.node = r.{end}.node')"
            ))
            .await;
    }
    let joined = state(&visit).await;
    let rows = joined["values"].as_array().expect("a list");
    let current =
        rows.iter().find(|r| r["path"] == "r.a.current").and_then(|r| r["number"].as_f64());
    assert_eq!(current, Some(0.015));
}

#[tokio::test]
async fn a_corner_dropped_on_another_is_joined_in_one_step_and_alt_leaves_it() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    visit.put(
        "two.thing",
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 80)  p2 = (100, 120) }\n",
    );
    visit.script("location.hash = '#/gallery/two.thing'").await;
    visit.until("window.__thinglab.state().path === 'gallery/two.thing' && window.__thinglab.state().grips.length === 4").await;
    visit.until("document.getElementById('picture').width > 10").await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    let before = state(&visit).await;
    drag(&visit, grip(&before, "b.p1"), grip(&before, "a.p2")).await;
    visit.until("window.__thinglab.state().grips.length === 3").await;
    let joined = state(&visit).await;
    assert_eq!(joined["status"]["freedom"], 6);
    assert!(text_of(&joined).contains("merge a.p2 = b.p1"), "{}", text_of(&joined));
    chord(&visit, &[CONTROL], 'z').await;
    visit.until("window.__thinglab.state().grips.length === 4").await;
    assert_eq!(text_of(&state(&visit).await), text_of(&before));
    // with Alt it is only moved there
    let alt = |action| KeyActions::new("keys".into()).then(action);
    let held = alt(KeyAction::Down { value: key::ALT });
    visit.client.perform_actions(held).await.expect("Alt is held");
    drag(&visit, grip(&before, "b.p1"), grip(&before, "a.p2")).await;
    let free = alt(KeyAction::Up { value: key::ALT });
    visit.client.perform_actions(free).await.expect("Alt is let go");
    visit.until("window.__thinglab.state().status.undo === 'move b.p1'").await;
    let moved = state(&visit).await;
    assert!(!text_of(&moved).contains("merge"), "{}", text_of(&moved));
    let (one, other) = (grip(&moved, "b.p1"), grip(&moved, "a.p2"));
    assert!((one.0 - other.0).abs() < 2.0 && (one.1 - other.1).abs() < 2.0, "{one:?} {other:?}");
}

#[tokio::test]
async fn the_right_button_opens_a_menu_and_lines_are_made_parallel() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    visit.put(
        "two.thing",
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 80)  p2 = (100, 120) }\n",
    );
    visit.script("location.hash = '#/gallery/two.thing'").await;
    visit.until("window.__thinglab.state().path === 'gallery/two.thing' && window.__thinglab.state().grips.length === 4").await;
    visit.until("document.getElementById('picture').width > 10").await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    let now = state(&visit).await;
    let body = |line: &str| {
        between(grip(&now, &format!("{line}.p1")), grip(&now, &format!("{line}.p2")), 0.4)
    };
    select(&visit, &[body("a"), body("b")]).await;
    visit.until("window.__thinglab.state().also.length === 1").await;
    point(&visit, body("b"), MOUSE_BUTTON_RIGHT).await;
    visit.until("document.querySelector('.menu [data-action=delete]')").await;
    chord(&visit, &[], ESCAPE).await;
    visit.until("!document.querySelector('.menu')").await;
    say(&visit, "parallel").await;
    visit.until("window.__thinglab.state().text.includes('a.parallel(to: b)')").await;
    let parallel = state(&visit).await;
    assert_eq!(parallel["status"]["satisfied"], true);
    assert_eq!(parallel["status"]["freedom"], 7);
}

#[tokio::test]
async fn selecting_a_corner_on_a_phone_leaves_the_picture_where_it_is() {
    let visit = Visit::open_empty().await;
    visit.client.set_window_size(500, 844).await.expect("a narrow window");
    visit.until("document.querySelector('main')").await;
    visit.script("location.hash = '#/gallery/quadrilateral.thing'").await;
    visit.until("window.__thinglab && window.__thinglab.state().grips.length > 0").await;
    visit.until("document.getElementById('picture').width > 10").await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    let (_, top, ..) = canvas(&visit).await;
    let now = state(&visit).await;
    click(&visit, grip(&now, "q.outer.side2.p2")).await;
    visit.until("window.__thinglab.state().selected != null").await;
    tokio::time::sleep(Duration::from_millis(300)).await;
    assert_eq!(canvas(&visit).await.1, top);
    let scrolled = visit.script("return document.querySelector('.document').scrollTop").await;
    assert_eq!(scrolled, 0);
}

#[tokio::test]
async fn rows_of_the_tree_say_how_deep_they_lie() {
    let visit = Visit::open(Some("quadrilateral.thing")).await;
    visit.until("document.querySelectorAll('[role=treeitem]').length > 3").await;
    let levels = visit
        .script("return [...document.querySelectorAll('[role=treeitem]')].slice(0, 3).map(r => r.getAttribute('aria-level'))")
        .await;
    assert_eq!(levels, json!(["1", "2", "3"]));
    let literal =
        visit.script("return document.querySelectorAll('[attr\\\\:aria-level]').length").await;
    assert_eq!(literal, 0);
    // what is merged at the end is in other rows, which open above: the keyboard stays where it is
    show(&visit, "voltage-divider.thing").await;
    visit.until("document.querySelector('[role=treeitem][data-path=r1]')").await;
    visit.script("document.querySelector('[role=treeitem]').focus()").await;
    chord(&visit, &[], key::END).await;
    visit.until("window.__thinglab.state().selected").await;
    visit.until("document.activeElement.matches('[role=treeitem].merge')").await;
    chord(&visit, &[], key::HOME).await;
    visit.until("document.activeElement.id === 'row-0'").await;
}

#[tokio::test]
async fn a_card_opened_in_a_tab_of_its_own_is_not_refused() {
    let visit = Visit::open(None).await;
    visit.until("document.querySelector('.card')").await;
    let link = visit.script("return document.querySelector('.card').href").await;
    let link = link.as_str().expect("a link").to_string();
    let tab = visit.client.new_window(true).await.expect("a new tab");
    visit.client.switch_to_window(tab.handle).await.expect("it is there");
    visit.client.goto(&link).await.expect("the page answers");
    visit.until("window.__thinglab && window.__thinglab.state().path").await;
    visit.until("window.__thinglab.state().text.length > 0").await;
}

#[tokio::test]
async fn a_document_that_does_not_exist_yet_is_begun() {
    // from the gallery, by its keys
    let visit = Visit::open(None).await;
    visit.until("document.querySelector('.card')").await;
    visit.script("document.querySelector('.file').focus()").await;
    chord(&visit, &[], ENTER).await;
    visit.until("document.activeElement.dataset.action === 'new'").await;
    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().path === 'untitled.thing'").await;
    visit.until("document.getElementById('picture').width > 10").await;
    // by its address
    visit.script("location.hash = '#/fresh.thing'").await;
    visit.until("window.__thinglab.state().path === 'fresh.thing'").await;
    chord(&visit, &[CONTROL], 's').await;
    visit.until("window.__thinglab.state().notice.includes('saved')").await;
    assert_eq!(visit.saved("../fresh.thing"), "use geometry\n");
}

#[tokio::test]
async fn a_slider_follows_the_pointer_to_where_it_lets_go() {
    let visit = Visit::open_empty().await;
    let before = show(&visit, "voltage-divider.thing").await;
    let slider = "input[aria-label=\"r2.resistance, slider\"]";
    let value = format!("Number(document.querySelector('{slider}').value)");
    let from = middle(&visit, slider).await;
    let first = visit.script(&format!("return {value}")).await.as_f64().expect("a number");
    drag(&visit, from, (from.0 + 60.0, from.1)).await;
    let then = visit.script(&format!("return {value}")).await.as_f64().expect("a number");
    // a quarter of the slider, in several steps of the pointer
    assert!(then > 1.4 * first, "from {first} to {then}");
    visit.until("window.__thinglab.state().status.undo").await;
    chord(&visit, &[CONTROL], 'z').await;
    let wanted = serde_json::to_string(&text_of(&before)).expect("a text");
    visit.until(&format!("window.__thinglab.state().text === {wanted}")).await;
}

/// Begins a construction by words that find it, and picks its operands.
async fn construct(visit: &Visit, words: &str, picks: &[(f64, f64)]) {
    visit.script("document.getElementById('tab-draw').click()").await;
    visit.until("document.querySelector('[name=construction]')").await;
    visit.script("document.querySelector('[name=construction]').focus()").await;
    chord(visit, &[CONTROL], 'a').await;
    keys(visit, words).await;
    visit.until("document.querySelector('.constructions .best')").await;
    chord(visit, &[], ENTER).await;
    visit.until("document.querySelector('.prompt')").await;
    for at in picks {
        click(visit, *at).await;
    }
    chord(visit, &[], ESCAPE).await;
}

#[tokio::test]
async fn the_nine_points_of_a_triangle_are_constructed_and_lie_on_one_circle() {
    let visit = begin().await;
    let (left, top, width, height) = canvas(&visit).await;
    let at = |x: f64, y: f64| (left + x * width, top + y * height);
    let corners = [at(0.25, 0.78), at(0.8, 0.7), at(0.4, 0.2)];
    chord(&visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    for corner in corners.iter().chain(&corners[..1]) {
        click(&visit, *corner).await;
    }
    visit.until("window.__thinglab.state().text.includes('line3')").await;
    chord(&visit, &[], ESCAPE).await;
    let [a, b, c] = corners;
    // what a point nearest to a line is called in textbooks
    construct(
        &visit,
        "foot",
        &[c, between(a, b, 0.9), a, between(b, c, 0.9), b, between(c, a, 0.1)],
    )
    .await;
    construct(&visit, "midpoint", &[a, b, b, c, c, a]).await;
    construct(&visit, "nine-point", &[a, b, c]).await;
    let built = state(&visit).await;
    assert!(text_of(&built).contains("circle => Circle.ninePoint("), "{}", text_of(&built));
    for move_to in [(0.0, 0.0), (60.0, 50.0)] {
        let corner = grip(&state(&visit).await, "line2.p2");
        if move_to != (0.0, 0.0) {
            drag(&visit, corner, (corner.0 + move_to.0, corner.1 + move_to.1)).await;
        }
        visit
            .until("window.__thinglab.state().made.some(row => row.path === 'circle.radius')")
            .await;
        let far = visit
            .script(
                "const rows = window.__thinglab.state().made; \
                 const place = path => rows.find(r => r.path === path).value.match(/-?[0-9.]+/g).map(Number); \
                 const [x, y] = place('circle.center'); \
                 const radius = Number(rows.find(r => r.path === 'circle.radius').value); \
                 return ['point', 'point2', 'point3', 'point4', 'point5', 'point6'].map(p => { const [u, v] = place(p); \
                     return Math.abs(Math.hypot(u - x, v - y) - Math.abs(radius)); })",
            )
            .await;
        for far in far.as_array().expect("six points") {
            assert!(far.as_f64().expect("a number") < 1e-2, "{far}: {}", text_of(&built));
        }
    }
    // what is constructed is picked, and told that it lies there already
    visit.script("document.getElementById('tab-structure').click()").await;
    visit.script("document.querySelector('[role=treeitem][data-path=point]').click()").await;
    visit.until("window.__thinglab.state().selected === 'point'").await;
    visit
        .script(
            "document.querySelector('[role=treeitem][data-path=circle]').dispatchEvent(\
             new MouseEvent('click', { bubbles: true, ctrlKey: true }))",
        )
        .await;
    visit.until("document.querySelector('.strip .held')?.innerText.includes('on')").await;
}

#[tokio::test]
async fn a_rhombus_is_made_by_touch_alone() {
    let visit = begin().await;
    visit.client.set_window_size(420, 844).await.expect("a phone's window");
    visit.until("document.getElementById('picture').clientWidth < 430").await;
    let (left, top, width, height) = canvas(&visit).await;
    let at = |x: f64, y: f64| (left + x * width, top + y * height);
    let corners = [at(0.2, 0.3), at(0.7, 0.2), at(0.85, 0.55), at(0.25, 0.65)];
    let line = middle(&visit, "[data-action=tool-line]").await;
    touch(&visit, &[line]).await;
    // a pinch draws nothing, with a tool in the hand as well
    let before = state(&visit).await;
    pinch(&visit, [at(0.4, 0.4), at(0.6, 0.45)]).await;
    let after = state(&visit).await;
    let scale = |state: &serde_json::Value| state["sheet"]["scale"].as_f64();
    assert!(scale(&after) > scale(&before), "{after}");
    assert_eq!(text_of(&after), text_of(&before));
    touch(&visit, &corners).await;
    touch(&visit, &corners[..1]).await;
    visit.until("window.__thinglab.state().text.includes('line4')").await;
    let hand = middle(&visit, "[data-action=select]").await;
    touch(&visit, &[hand]).await;
    let side = |n: usize| between(corners[n], corners[(n + 1) % 4], 0.5);
    touch(&visit, &[side(0)]).await;
    let also = middle(&visit, ".strip .adding").await;
    touch(&visit, &[also, side(1), side(2), side(3)]).await;
    visit.until("window.__thinglab.state().also.length === 3").await;
    let equal = middle(&visit, "[data-offer=\"equal length\"]").await;
    touch(&visit, &[equal]).await;
    visit.until("window.__thinglab.state().status.freedom === 5").await;
    // the empty sheet ends it
    touch(&visit, &[at(0.5, 0.06)]).await;
    visit.until("!document.querySelector('.strip .adding[aria-pressed=true]')").await;
    let corner = grip(&state(&visit).await, "line2.p2");
    touch(&visit, &[corner]).await;
    visit.until("window.__thinglab.state().also.length === 0").await;
    visit.picture("touch").await;
}
