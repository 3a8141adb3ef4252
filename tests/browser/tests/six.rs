//! Six ordinary jobs from an empty document, each by the mouse and by the keyboard alone. (The quadrilateral of
//! midpoints by the mouse stands in `hand.rs`.)

use browser::Visit;
use browser::hands::{
    begin, choose_by_keys, chord, drag, draw_ring_by_keys, grip, insert_by_keys, key, keys, place,
    point, press_by_keys, state, stop_by_keys, text_of, type_over, use_library, word,
};
use fantoccini::actions::MOUSE_BUTTON_LEFT;
use serde_json::Value;

fn number(state: &Value, path: &str) -> f64 {
    let rows = state["values"].as_array().expect("values are a list");
    let row = rows.iter().find(|row| row["path"] == path);
    row.and_then(|row| row["number"].as_f64()).unwrap_or_else(|| panic!("no number {path}"))
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs().max(1.0)
}

/// Sets a value in the inspector by the keyboard alone: Tab leads from the tree to its field.
async fn set_by_keys(visit: &Visit, label: &str, value: &str) {
    chord(visit, &[key::ALT], '5').await;
    for _ in 0..80 {
        let now = visit.script("return document.activeElement.getAttribute('aria-label')").await;
        if now == label {
            break;
        }
        chord(visit, &[], key::TAB).await;
    }
    visit.until(&format!("document.activeElement.getAttribute('aria-label') === '{label}'")).await;
    chord(visit, &[key::CONTROL], 'a').await;
    keys(visit, value).await;
    chord(visit, &[], key::ENTER).await;
}

/// Says something of the selection by the strip, by the keyboard alone.
async fn say_by_keys(visit: &Visit, label: &str) {
    visit.until(&format!("document.querySelector('[data-offer=\"{label}\"]')")).await;
    chord(visit, &[key::ALT], '1').await;
    chord(visit, &[], 'k').await;
    visit.until("document.activeElement.dataset.offer").await;
    for _ in 0..20 {
        if visit.script("return document.activeElement.dataset.offer").await == label {
            break;
        }
        chord(visit, &[], key::TAB).await;
    }
    let text = serde_json::to_string(&text_of(&state(visit).await)).expect("a text");
    chord(visit, &[], key::ENTER).await;
    visit
        .until(&format!(
            "window.__thinglab.state().text !== {text} || document.getElementById('asked') \
             || document.querySelector('.asked')"
        ))
        .await;
}

/// Answers what is asked by the button that says so.
async fn choose(visit: &Visit, label: &str) {
    let buttons = "[...document.querySelectorAll('.asked button')]";
    let button = format!("{buttons}.find(b => b.innerText.includes('{label}'))");
    visit.until(&button).await;
    visit.script(&format!("{button}.click()")).await;
}

/// Answers what is asked, by the keyboard alone.
async fn choose_answer_by_keys(visit: &Visit, label: &str) {
    visit.until("document.activeElement.closest('.asked')").await;
    let button = format!("at.closest('.asked') && at.innerText.includes('{label}')");
    press_by_keys(visit, &button, key::ENTER).await;
}

/// Merges things that are chosen in the structure.
async fn merge_by_keys(visit: &Visit, paths: &[&str]) {
    choose_by_keys(visit, paths).await;
    let text = serde_json::to_string(&text_of(&state(visit).await)).expect("a text");
    chord(visit, &[], 'm').await;
    visit.until(&format!("window.__thinglab.state().text !== {text}")).await;
}

/// Has a document use a library, by the bin's field.
async fn use_by_keys(visit: &Visit, library: &str) {
    insert_by_keys(visit, library).await;
    visit.until(&format!("window.__thinglab.state().text.includes('use {library}')")).await;
}

const CONVERTER: [(f64, f64); 5] =
    [(400.0, 250.0), (400.0, 400.0), (620.0, 325.0), (620.0, 500.0), (860.0, 410.0)];

#[tokio::test]
async fn a_temperature_converter_is_built_of_calculator_parts() {
    let visit = begin().await;
    use_library(&visit, "calculator").await;
    let [celsius, factor, product, offset, fahrenheit] = CONVERTER;
    place(&visit, "Times", &[celsius, factor, product]).await;
    place(&visit, "Plus", &[product, offset, fahrenheit]).await;
    place(&visit, "Constant", &[factor, offset]).await;
    place(&visit, "Printer", &[celsius, fahrenheit]).await;
    chord(&visit, &[], key::ESCAPE).await;
    let built = state(&visit).await;
    let shown = visit.script("return document.body.innerText").await;
    assert_eq!(text_of(&built).matches("merge ").count(), 5, "{}\n{shown}", text_of(&built));
    for (path, value) in [("constant", "1.8"), ("constant2", "32"), ("printer", "100")] {
        let at = word(&state(&visit).await, path);
        type_over(&visit, at, value).await;
    }
    let hot = state(&visit).await;
    assert!(near(number(&hot, "plus.result.number"), 212.0), "{}", text_of(&hot));
    visit.picture("converter").await;
    // and back
    type_over(&visit, word(&hot, "printer2"), "32").await;
    let cold = state(&visit).await;
    assert!(near(number(&cold, "times.operand1.number"), 0.0), "{}", text_of(&cold));
    assert!(near(number(&cold, "times.operand2.number"), 1.8));
    visit.book_picture("converter").await;
}

#[tokio::test]
async fn a_temperature_converter_is_built_by_the_keyboard_alone() {
    let visit = begin().await;
    use_by_keys(&visit, "calculator").await;
    for class in ["Times", "Plus", "Constant", "Constant", "Printer", "Printer"] {
        insert_by_keys(&visit, class).await;
        // no list is in sight at first: what is new is selected all the same
        visit.until("window.__thinglab.state().selected").await;
    }
    for pair in [
        ["times.result", "plus.operand1"],
        ["times.operand2", "constant.node"],
        ["plus.operand2", "constant2.node"],
        ["times.operand1", "printer.node"],
        ["plus.result", "printer2.node"],
    ] {
        merge_by_keys(&visit, &pair).await;
    }
    for (thing, label, value) in [
        ("constant", "times.operand2.number", "1.8"),
        ("constant2", "plus.operand2.number", "32"),
        ("printer2", "plus.result.number", "212"),
    ] {
        choose_by_keys(&visit, &[thing]).await;
        set_by_keys(&visit, label, value).await;
        let done = format!(
            "window.__thinglab.state().values.some(v => v.path === '{label}' && Math.abs(v.number - {value}) < 1e-9)"
        );
        visit.until(&done).await;
    }
    let hot = state(&visit).await;
    assert!(near(number(&hot, "times.operand1.number"), 100.0), "{}", text_of(&hot));
}

#[tokio::test]
async fn a_voltage_divider_is_wired_read_dragged_and_typed() {
    let visit = begin().await;
    use_library(&visit, "circuits").await;
    let (plus, minus) = ((400.0, 250.0), (400.0, 600.0));
    let (top, middle, bottom) = ((650.0, 250.0), (650.0, 425.0), (650.0, 600.0));
    place(&visit, "Battery", &[plus, minus]).await;
    place(&visit, "Ammeter", &[plus, top]).await;
    place(&visit, "Resistor", &[top, middle, middle, bottom]).await;
    place(&visit, "Wire", &[bottom, minus]).await;
    place(&visit, "Ground", &[minus]).await;
    place(&visit, "Voltmeter", &[middle, (850.0, 425.0)]).await;
    place(&visit, "Wire", &[(850.0, 425.0), (850.0, 600.0), (850.0, 600.0), bottom]).await;
    chord(&visit, &[], key::ESCAPE).await;
    chord(&visit, &[], key::ESCAPE).await;
    let wired = state(&visit).await;
    // 1.5 V over 200 ohm, and half of it
    assert!(near(number(&wired, "ammeter.a.current"), 0.0075), "{}", text_of(&wired));
    assert!(near(number(&wired, "voltmeter.voltage"), 0.75));
    visit.picture("divider").await;

    // what shall stay is locked, then a resistance is dragged: its name in the inspector
    for path in ["battery.emf", "resistor.resistance"] {
        let lock = format!("document.querySelector('.inspector button[aria-label*=\"{path}\"]')");
        visit.until(&lock).await;
        visit.script(&format!("{lock}.click()")).await;
        visit
            .until(&format!(
                "window.__thinglab.state().values.some(v => v.path === '{path}' && v.anchored)"
            ))
            .await;
    }
    let label = "const r = [...document.querySelectorAll('.inspector tr')]
        .find(r => r.innerText.includes('resistor2')).querySelector('.label').getBoundingClientRect();
        return [r.left + 4, r.top + r.height / 2]";
    let at = visit.script(label).await;
    let at = (at[0].as_f64().expect("a place"), at[1].as_f64().expect("a place"));
    drag(&visit, at, (at.0 + 100.0, at.1)).await;
    let dragged = state(&visit).await;
    let lower = number(&dragged, "resistor2.resistance");
    assert!(lower > 110.0, "{}", text_of(&dragged));
    assert!(near(number(&dragged, "voltmeter.voltage"), 1.5 * lower / (100.0 + lower)));

    // the reading is typed where it is read: the resistance follows
    type_over(&visit, word(&dragged, "voltmeter"), "0.5 V").await;
    let typed = state(&visit).await;
    assert!(near(number(&typed, "voltmeter.voltage"), 0.5), "{}", text_of(&typed));
    assert!(near(number(&typed, "resistor2.resistance"), 50.0), "{}", text_of(&typed));
    visit.book_picture("divider").await;
}

#[tokio::test]
async fn a_voltage_divider_is_wired_by_the_keyboard_alone() {
    let visit = begin().await;
    use_by_keys(&visit, "circuits").await;
    for class in ["Battery", "Ammeter", "Resistor", "Resistor", "Ground", "Voltmeter"] {
        insert_by_keys(&visit, class).await;
    }
    for joined in [
        &["battery.a.node", "ammeter.a.node"][..],
        &["ammeter.b.node", "resistor.a.node"],
        &["resistor.b.node", "resistor2.a.node", "voltmeter.a.node"],
        &["battery.b.node", "resistor2.b.node", "ground.lead.node", "voltmeter.b.node"],
    ] {
        merge_by_keys(&visit, joined).await;
    }
    let wired = state(&visit).await;
    assert!(near(number(&wired, "ammeter.a.current"), 0.0075), "{}", text_of(&wired));
    for (thing, path) in [("battery", "battery.emf"), ("resistor", "resistor.resistance")] {
        choose_by_keys(&visit, &[&format!("{thing}.{}", path.rsplit('.').next().unwrap_or(""))])
            .await;
        chord(&visit, &[key::SHIFT], 'L').await;
        visit
            .until(&format!(
                "window.__thinglab.state().values.some(v => v.path === '{path}' && v.anchored)"
            ))
            .await;
    }
    choose_by_keys(&visit, &["voltmeter"]).await;
    set_by_keys(&visit, "voltmeter.voltage", "0.5 V").await;
    visit.until("window.__thinglab.state().values.some(v => v.path === 'resistor2.resistance' && Math.abs(v.number - 50) < 1e-6)").await;
}

#[tokio::test]
async fn a_bridge_is_built_loaded_and_dragged() {
    let visit = begin().await;
    use_library(&visit, "bridges").await;
    let (left, right) = ((350.0, 450.0), (950.0, 450.0));
    let (one, two) = ((550.0, 400.0), (750.0, 400.0));
    place(&visit, "FixedJoint", &[left, right]).await;
    place(&visit, "FreeJoint", &[one, two]).await;
    place(&visit, "Beam", &[left, one, one, two, two, right]).await;
    place(&visit, "Beam", &[left, two, one, right]).await;
    let built = state(&visit).await;
    assert_eq!(built["status"]["satisfied"], true);
    for beam in ["beam", "beam2", "beam3", "beam4", "beam5"] {
        assert!(near(number(&built, &format!("{beam}.tension")), 0.0), "{}", text_of(&built));
    }
    place(&visit, "Load", &[one]).await;
    chord(&visit, &[], key::ESCAPE).await;
    let unloaded = state(&visit).await;
    let tip = grip(&unloaded, "load.tip");
    // so far that the beams bend in sight
    drag(&visit, tip, (tip.0, tip.1 + 150.0)).await;
    let loaded = state(&visit).await;
    assert_eq!(loaded["status"]["satisfied"], true);
    let size = number(&loaded, "load.size");
    assert!(size > 0.1, "{}", text_of(&loaded));
    // what the supports bear is the load
    let ends = ["beam.a", "beam4.a", "beam3.b", "beam5.b"];
    let pull: f64 = ends.iter().map(|end| number(&loaded, &format!("{end}.pullY"))).sum();
    assert!((pull - size).abs() < 1e-6 * size, "{pull} and {size}");
    assert!(number(&loaded, "freeJoint.at.y") > number(&unloaded, "freeJoint.at.y") + 5.0);
    assert_eq!(loaded["diagnostics"].as_array().map(Vec::len), Some(0), "{}", text_of(&loaded));
    visit.picture("bridge").await;
    visit.book_picture("bridge").await;
    // a joint is dragged: the load is what brings it there
    let loaded = state(&visit).await;
    let joint = grip(&loaded, "freeJoint.at");
    drag(&visit, joint, (joint.0, joint.1 - 15.0)).await;
    let dragged = state(&visit).await;
    assert_eq!(dragged["status"]["satisfied"], true);
    assert!(number(&dragged, "freeJoint.at.y") < number(&loaded, "freeJoint.at.y") - 5.0);
    assert!((number(&dragged, "load.size") - size).abs() > 1e-3, "{}", text_of(&dragged));
}

#[tokio::test]
async fn a_bridge_is_built_by_the_keyboard_alone() {
    let visit = begin().await;
    use_by_keys(&visit, "bridges").await;
    for class in ["FixedJoint", "FixedJoint", "FreeJoint", "Beam", "Beam", "Load"] {
        insert_by_keys(&visit, class).await;
    }
    for (thing, label, value) in
        [("fixedJoint2", "fixedJoint2.at.x", "160"), ("fixedJoint2", "fixedJoint2.at.y", "0")]
    {
        choose_by_keys(&visit, &[thing]).await;
        set_by_keys(&visit, label, value).await;
        visit.until(&format!(
            "window.__thinglab.state().values.some(v => v.path === '{label}' && v.number === {value})"
        ))
        .await;
    }
    for pair in [
        ["fixedJoint", "beam.a.joint"],
        ["fixedJoint2", "beam2.b.joint"],
        ["freeJoint", "beam.b.joint"],
        ["freeJoint", "beam2.a.joint"],
        ["freeJoint", "load.end.joint"],
    ] {
        merge_by_keys(&visit, &pair).await;
    }
    choose_by_keys(&visit, &["load"]).await;
    set_by_keys(&visit, "load.size", "0.5 N").await;
    visit
        .until(
            "window.__thinglab.state().values.some(v => v.path === 'load.size' && v.number === 0.5)",
        )
        .await;
    let loaded = state(&visit).await;
    assert_eq!(loaded["status"]["satisfied"], true, "{}", text_of(&loaded));
    let pull = number(&loaded, "beam.a.pullY") + number(&loaded, "beam2.b.pullY");
    assert!((pull - 0.5).abs() < 1e-6, "{pull}: {}", text_of(&loaded));
}

/// Draws four lines in a ring.
async fn ring(visit: &Visit) {
    chord(visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    let corners = [(450.0, 300.0), (600.0, 230.0), (750.0, 300.0), (600.0, 390.0)];
    for corner in corners.iter().chain(&corners[..1]) {
        point(visit, *corner, MOUSE_BUTTON_LEFT).await;
    }
    visit.until("window.__thinglab.state().text.includes('line4')").await;
    chord(visit, &[], key::ESCAPE).await;
    chord(visit, &[], key::ESCAPE).await;
}

#[tokio::test]
async fn a_rhombus_becomes_a_class_and_all_of_it_follow() {
    let visit = begin().await;
    ring(&visit).await;
    let drawn = state(&visit).await;
    let corners = ["line.p1", "line.p2", "line2.p2", "line3.p2"].map(|path| grip(&drawn, path));
    let held = |n: usize| {
        let (a, b) = (corners[n], corners[(n + 1) % 4]);
        (a.0 + 0.4 * (b.0 - a.0), a.1 + 0.4 * (b.1 - a.1))
    };
    browser::hands::select(&visit, &[held(0), held(1), held(2), held(3)]).await;
    say_by_keys(&visit, "equal length").await;
    let equal = state(&visit).await;
    assert_eq!(equal["status"]["freedom"], 5, "{}", text_of(&equal));
    assert_eq!(equal["diagnostics"].as_array().map(Vec::len), Some(0), "{}", text_of(&equal));

    // a class of it, placed by two opposite corners that are pointed at
    chord(&visit, &[key::SHIFT], 'C').await;
    visit.until("document.activeElement.id === 'asked'").await;
    visit.until("document.querySelectorAll('.example select').length >= 11").await;
    // what it asks covers nothing of the figure that it asks of
    let beside = "const box = id => document.querySelector(id).getBoundingClientRect();
        return box('.example').left >= box('#picture').right";
    assert_eq!(visit.script(beside).await, true);
    for path in ["line.p1", "line2.p2"] {
        point(&visit, grip(&equal, path), MOUSE_BUTTON_LEFT).await;
    }
    visit.picture("class").await;
    visit.script("document.getElementById('asked').focus()").await;
    keys(&visit, "Rhombus").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('rhombus: Rhombus')").await;
    let made = text_of(&state(&visit).await);
    assert!(made.contains("attachers line.p1, line2.p2"), "{made}");

    // three more of the bin
    visit.script("document.getElementById('tab-bin').click()").await;
    let places = [(350.0, 550.0), (480.0, 620.0), (560.0, 550.0), (690.0, 620.0)];
    place(&visit, "Rhombus", &places).await;
    place(&visit, "Rhombus", &[(780.0, 550.0), (900.0, 620.0)]).await;
    chord(&visit, &[], key::ESCAPE).await;
    let four = state(&visit).await;
    assert_eq!(four["status"]["freedom"], 20, "{}", text_of(&four));

    // one is constrained: only that one
    choose_by_keys(&visit, &["rhombus2.line"]).await;
    say_by_keys(&visit, "horizontal").await;
    choose(&visit, "only rhombus2").await;
    visit.until("window.__thinglab.state().status.freedom === 19").await;

    // the class is edited: all follow
    visit.script("document.querySelector('#tab-structure').click()").await;
    choose_by_keys(&visit, &["rhombus3.line", "rhombus3.line2"]).await;
    say_by_keys(&visit, "perpendicular").await;
    choose(&visit, "every Rhombus").await;
    visit.until("window.__thinglab.state().status.freedom === 15").await;
    visit.picture("rhombus").await;

    // its prototype, in a pane of its own: a diagonal drawn there is one of every one
    chord(&visit, &[key::SHIFT], 'E').await;
    visit
        .until(
            "document.querySelector('.class-pane') && window.__thinglab.state().grips.length === 4",
        )
        .await;
    visit.until("document.activeElement.id === 'picture'").await;
    chord(&visit, &[], 'l').await;
    stop_by_keys(&visit, "joins rhombus.line.p1").await;
    stop_by_keys(&visit, "joins rhombus.line2.p2").await;
    visit.until("window.__thinglab.state().text.includes('    line5: Line')").await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.picture("prototype").await;
    visit.script("document.querySelector('.class-pane button').click()").await;
    visit.until("window.__thinglab.state().grips.length === 16").await;
    let all = state(&visit).await;
    assert_eq!(all["status"]["freedom"], 15, "{}", text_of(&all));
    assert_eq!(all["status"]["satisfied"], true);
    visit.book_picture("rhombus").await;
}

/// Corners of a ring on an empty sheet.
const CORNERS: [&str; 4] = ["100,180", "250,90", "420,170", "260,300"];

#[tokio::test]
async fn a_quadrilateral_of_midpoints_is_drawn_by_the_keyboard_alone() {
    let visit = begin().await;
    draw_ring_by_keys(&visit, CORNERS).await;
    for side in ["line", "line2", "line3", "line4"] {
        stop_by_keys(&visit, &format!("midpoint of {side}")).await;
    }
    stop_by_keys(&visit, "joins line5.p1").await;
    visit.until("window.__thinglab.state().text.includes('line8')").await;
    let drawn = state(&visit).await;
    assert_eq!(drawn["status"]["satisfied"], true);
    assert_eq!(drawn["status"]["freedom"], 8, "the inner one has none: {}", text_of(&drawn));
    // a corner is moved: the inner figure stays a parallelogram
    chord(&visit, &[], key::ESCAPE).await;
    choose_by_keys(&visit, &["line2.p2"]).await;
    chord(&visit, &[key::ALT], '1').await;
    for _ in 0..3 {
        chord(&visit, &[key::SHIFT], key::RIGHT).await;
    }
    visit
        .until("window.__thinglab.state().grips.some(g => g.path === 'line2.p2' && g.x === 450)")
        .await;
    let moved = state(&visit).await;
    let at = |path: &str| {
        let grips = moved["grips"].as_array().expect("a list");
        let grip = grips.iter().find(|g| g["path"] == path).expect("a grip");
        (grip["x"].as_f64().expect("a number"), grip["y"].as_f64().expect("a number"))
    };
    let way = |from: &str, to: &str| (at(to).0 - at(from).0, at(to).1 - at(from).1);
    let (one, other) = (way("line5.p1", "line5.p2"), way("line6.p2", "line7.p2"));
    assert!(near(one.0, -other.0) && near(one.1, -other.1), "{one:?} {other:?}");
}

#[tokio::test]
async fn a_rhombus_becomes_a_class_by_the_keyboard_alone_at_200_percent() {
    let visit = begin().await;
    // a window of 1440 pixels at 200 % is one of half the width, and half the height under the browser's own bars
    visit.client.set_window_size(720, 590).await.expect("such a window");
    visit.until("window.innerWidth === 720").await;
    draw_ring_by_keys(&visit, CORNERS).await;
    chord(&visit, &[], key::ESCAPE).await;
    choose_by_keys(&visit, &["line", "line2", "line3", "line4"]).await;
    say_by_keys(&visit, "equal length").await;
    visit.until("window.__thinglab.state().status.freedom === 5").await;
    chord(&visit, &[key::SHIFT], 'C').await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(&visit, "Rhombus").await;
    for path in ["line.p1", "line2.p2"] {
        let row =
            format!("at.type === 'checkbox' && at.closest('label').innerText.startsWith('{path}')");
        press_by_keys(&visit, &row, key::SPACE).await;
    }
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('attachers line.p1, line2.p2')").await;
    for _ in 0..3 {
        insert_by_keys(&visit, "Rhombus").await;
    }
    visit.until("window.__thinglab.state().status.freedom === 20").await;
    choose_by_keys(&visit, &["rhombus2.line"]).await;
    say_by_keys(&visit, "horizontal").await;
    choose_answer_by_keys(&visit, "only rhombus2").await;
    visit.until("window.__thinglab.state().status.freedom === 19").await;
    choose_by_keys(&visit, &["rhombus3.line", "rhombus3.line2"]).await;
    say_by_keys(&visit, "perpendicular").await;
    choose_answer_by_keys(&visit, "every Rhombus").await;
    visit.until("window.__thinglab.state().status.freedom === 15").await;
    let all = state(&visit).await;
    assert_eq!(all["status"]["satisfied"], true, "{}", text_of(&all));
}

#[tokio::test]
async fn a_conflict_is_made_explained_and_repaired_by_the_keyboard_alone() {
    let visit = begin().await;
    draw_ring_by_keys(&visit, CORNERS).await;
    chord(&visit, &[], key::ESCAPE).await;
    choose_by_keys(&visit, &["line", "line3"]).await;
    say_by_keys(&visit, "parallel").await;
    choose_by_keys(&visit, &["line"]).await;
    say_by_keys(&visit, "length").await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(&visit, "150").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('line.length = 150')").await;
    choose_by_keys(&visit, &["line.p1", "line.p2"]).await;
    say_by_keys(&visit, "distance").await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(&visit, "200").await;
    chord(&visit, &[], key::ENTER).await;
    // what to do is asked at once: a reference dimension, the other one replaced, or as a conflict
    for wanted in ["reference dimension", "instead of", "switched off"] {
        visit.until(&format!(
            "[...document.querySelectorAll('.asked button')].some(b => b.innerText.includes('{wanted}'))"
        ))
        .await;
    }
    visit.picture("asked").await;
    choose_answer_by_keys(&visit, "conflict").await;
    visit.until("!window.__thinglab.state().status.satisfied").await;
    // the keys lead to the reasons, and on to the repairs
    chord(&visit, &[key::ALT], '6').await;
    visit.until("document.querySelectorAll('.why .repair').length >= 2").await;
    visit.until("document.activeElement.closest('#why')").await;
    visit.picture("conflict").await;
    visit.book_picture("conflict").await;
    press_by_keys(&visit, "at.matches('.repair')", key::ENTER).await;
    visit.until("window.__thinglab.state().status.satisfied").await;
}
