//! How large things are on the screen, and corners that are computed: what a person drags, types and sees of them.

use browser::Visit;
use browser::hands::{begin, chord, drag, grip, key, keys, middle, point, select, state, word};
use fantoccini::actions::MOUSE_BUTTON_LEFT;
use serde_json::Value;

/// Where a place of the picture lies in the window, by parts of its width and height.
async fn at(visit: &Visit, x: f64, y: f64) -> (f64, f64) {
    let script = "const r = document.getElementById('picture').getBoundingClientRect();
        return [r.left, r.top, r.width, r.height]";
    let rect = visit.script(script).await;
    let number = |n: usize| rect[n].as_f64().expect("a number");
    (number(0) + x * number(2), number(1) + y * number(3))
}

async fn click(visit: &Visit, place: (f64, f64)) {
    point(visit, place, MOUSE_BUTTON_LEFT).await;
}

/// Lays the tool down that is in the hand, and what it has begun.
async fn lay_down(visit: &Visit) {
    for _ in 0..2 {
        chord(visit, &[], key::ESCAPE).await;
    }
    visit.until("document.querySelector('[data-action=select][aria-pressed=true]')").await;
}

fn scale(state: &Value) -> f64 {
    state["sheet"]["scale"].as_f64().expect("a number")
}

/// Tells something of the selection a number, by the offer of the strip.
async fn tell(visit: &Visit, offer: &str, typed: &str) {
    let button = middle(visit, &format!("[data-offer=\"{offer}\"]")).await;
    click(visit, button).await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(visit, typed).await;
    chord(visit, &[], key::ENTER).await;
    visit.until("!document.getElementById('asked')").await;
}

#[tokio::test]
async fn corners_of_a_regular_polygon_are_dragged_and_told_to_be_level() {
    let visit = begin().await;
    chord(&visit, &[], 'n').await;
    visit
        .until("document.querySelector('[data-action=tool-regularpolygon][aria-pressed=true]')")
        .await;
    click(&visit, at(&visit, 0.5, 0.5).await).await;
    click(&visit, at(&visit, 0.7, 0.5).await).await;
    visit.until("window.__thinglab.state().grips.length === 7").await;
    lay_down(&visit).await;
    let drawn = state(&visit).await;
    let path = |part: &str| {
        let grips = drawn["grips"].as_array().expect("a list").iter();
        let mut paths = grips.filter_map(|grip| grip["path"].as_str());
        paths.find(|path| path.ends_with(part)).expect("it has a grip").to_string()
    };
    let (corner, other, center) = (path("corners[2]"), path("corners[4]"), path("center"));
    let (from, before) = (grip(&drawn, &corner), grip(&drawn, &center));
    let to = (from.0 + 40.0, from.1 - 60.0);
    drag(&visit, from, to).await;
    visit.until(&format!("window.__thinglab.state().status.undo === 'move {corner}'")).await;
    let moved = state(&visit).await;
    let now = grip(&moved, &corner);
    assert!((now.0 - to.0).abs() < 2.0 && (now.1 - to.1).abs() < 2.0, "{now:?}, not {to:?}");
    assert_eq!(grip(&moved, &center), before, "it turns about its centre");
    select(&visit, &[now, grip(&moved, &other)]).await;
    visit.until("document.querySelector('[data-offer=horizontal]')").await;
    visit.script("document.querySelector('[data-offer=horizontal]').click()").await;
    visit.until("window.__thinglab.state().status.freedom === 3").await;
    let told = state(&visit).await;
    let (one, two) = (grip(&told, &corner), grip(&told, &other));
    assert!((one.1 - two.1).abs() < 1e-6, "{one:?}, {two:?}");
}

#[tokio::test]
async fn the_first_length_that_is_typed_is_a_good_part_of_the_picture_until_a_person_zooms() {
    let visit = begin().await;
    chord(&visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    let (from, to) = (at(&visit, 0.3, 0.6).await, at(&visit, 0.7, 0.4).await);
    click(&visit, from).await;
    click(&visit, to).await;
    visit.until("window.__thinglab.state().grips.length === 2").await;
    lay_down(&visit).await;
    assert_eq!(scale(&state(&visit).await), 1.0);
    click(&visit, (from.0.midpoint(to.0), from.1.midpoint(to.1))).await;
    tell(&visit, "length", "12 mm").await;
    visit.until("window.__thinglab.state().text.includes('unit mm')").await;
    visit.until("window.__thinglab.state().sheet.scale > 5").await;
    let seen = state(&visit).await;
    let (a, b) = (grip(&seen, "line.p1"), grip(&seen, "line.p2"));
    let (across, up) = (a.0 - b.0, a.1 - b.1);
    let long = (across * across + up * up).sqrt();
    assert!((long / scale(&seen) - 12.0).abs() < 1e-6 && long > 200.0, "{long} px");
    // who looks closer himself is left alone
    let nearer = middle(&visit, ".corner [aria-label=\"Zoom in\"]").await;
    click(&visit, nearer).await;
    let looked = format!("window.__thinglab.state().sheet.scale > {}", scale(&seen));
    visit.until(&looked).await;
    let before = scale(&state(&visit).await);
    chord(&visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    click(&visit, at(&visit, 0.2, 0.2).await).await;
    chord(&visit, &[key::ALT], '1').await;
    keys(&visit, "1<30").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('line2')").await;
    assert_eq!(scale(&state(&visit).await), before);
    // but what was wholly in sight is so after a length is typed anew
    chord(&visit, &[], key::ESCAPE).await;
    chord(&visit, &[], key::ESCAPE).await;
    let seen = state(&visit).await;
    let mut words = seen["words"].as_array().expect("a list").iter();
    let said = words.find(|word| word["text"] == "12 mm").expect("the length is told");
    let place = (said["px"].as_f64().expect("a place"), said["py"].as_f64().expect("a place"));
    click(&visit, place).await;
    chord(&visit, &[], 'd').await;
    visit.until("document.activeElement.id === 'asked'").await;
    answer(&visit, "90").await;
    visit
        .until(&format!(
            "(r => window.__thinglab.state().sheet.scale < {before} && \
             window.__thinglab.state().grips.every(g => g.px > r.left && g.px < r.right)) \
             (document.getElementById('picture').getBoundingClientRect())"
        ))
        .await;
    // and is where it was once that is undone
    chord(&visit, &[key::CONTROL], 'z').await;
    visit.until(&format!("window.__thinglab.state().sheet.scale === {before}")).await;
}

#[tokio::test]
async fn a_panel_that_opens_leaves_what_was_in_sight_in_sight() {
    let visit = begin().await;
    chord(&visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    click(&visit, at(&visit, 0.2, 0.9).await).await;
    click(&visit, at(&visit, 0.8, 0.1).await).await;
    visit.until("window.__thinglab.state().grips.length === 2").await;
    lay_down(&visit).await;
    visit.script("document.getElementById('tab-plot').click()").await;
    visit
        .until(
            "(r => window.__thinglab.state().sheet.scale < 1 && \
             window.__thinglab.state().grips.every(g => g.py > r.top && g.py < r.bottom)) \
             (document.getElementById('picture').getBoundingClientRect())",
        )
        .await;
}

/// Types what is asked for, and gives it.
async fn answer(visit: &Visit, typed: &str) {
    visit.until("document.activeElement.id === 'asked'").await;
    keys(visit, typed).await;
    chord(visit, &[], key::ENTER).await;
    visit.until("!document.getElementById('asked')").await;
}

#[tokio::test]
async fn dimensions_stand_on_the_drawing_and_are_typed_anew_there() {
    let visit = begin().await;
    chord(&visit, &[], 'l').await;
    visit.until("document.querySelector('[data-action=tool-line][aria-pressed=true]')").await;
    // by eye, and all the same level and upright, the last side included
    for (x, y) in [(0.3, 0.7), (0.7, 0.702), (0.698, 0.5), (0.301, 0.501), (0.3, 0.7)] {
        click(&visit, at(&visit, x, y).await).await;
    }
    lay_down(&visit).await;
    assert_eq!(state(&visit).await["status"]["freedom"], 4);
    // the tool asks for the size of what is clicked, thing after thing; before an answer, between both
    chord(&visit, &[], 'd').await;
    visit.until("document.querySelector('[data-action=dimension][aria-pressed=true]')").await;
    let drawn = state(&visit).await;
    let (side, end) = (grip(&drawn, "line.p2"), grip(&drawn, "line2.p2"));
    let (bottom, side) = (at(&visit, 0.5, 0.7).await, (side.0, f64::midpoint(side.1, end.1)));
    let asks = |what: &str| {
        let label = format!("document.querySelector('.asking label')?.textContent === '{what}'");
        format!("document.activeElement.id === 'asked' && {label}")
    };
    click(&visit, bottom).await;
    visit.until(&asks("Value of the length")).await;
    // the other one by keys
    chord(&visit, &[], key::DOWN).await;
    visit.until("document.querySelector('.asking .quiet')?.innerText.endsWith('line2')").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until(&asks("Value of the angle")).await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until("!document.getElementById('asked')").await;
    click(&visit, bottom).await;
    visit.until(&asks("Value of the length")).await;
    click(&visit, side).await;
    visit.until(&asks("Value of the angle")).await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until("!document.getElementById('asked')").await;
    // what is typed is taken by the click that goes on to the next
    click(&visit, bottom).await;
    visit.until(&asks("Value of the length")).await;
    keys(&visit, "80 mm").await;
    click(&visit, side).await;
    visit.until("window.__thinglab.state().text.includes('constraint line.length = 80 mm')").await;
    answer(&visit, "30").await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until("document.querySelector('[data-action=select][aria-pressed=true]')").await;
    visit.until("window.__thinglab.state().status.freedom === 2").await;
    let sized = state(&visit).await;
    let said = |path: &str| {
        let words = sized["words"].as_array().expect("a list").iter();
        let mut all = words.filter(|word| word["path"] == path);
        all.next().map(|word| word["text"].clone()).unwrap_or_default()
    };
    assert_eq!((said("constraint5"), said("constraint6")), ("80 mm".into(), "30 mm".into()));
    visit.book_picture("dimensions").await;
    let sized = state(&visit).await;
    // one is picked where it stands, and typed anew
    click(&visit, word(&sized, "constraint5")).await;
    visit.until("window.__thinglab.state().selected === 'constraint5'").await;
    chord(&visit, &[], 'd').await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(&visit, "60").await;
    // a click on empty paper takes it, and the hand selects again
    click(&visit, at(&visit, 0.5, 0.6).await).await;
    visit.until("window.__thinglab.state().text.includes('constraint line.length = 60')").await;
    visit.until("document.querySelector('[data-action=select][aria-pressed=true]')").await;
    let typed = state(&visit).await;
    let number = |path: &str| {
        let mut rows = typed["values"].as_array().expect("a list").iter();
        let row = rows.find(|row| row["path"] == path);
        row.and_then(|row| row["number"].as_f64()).expect("a number")
    };
    assert!((number("line.p2.x") - number("line.p1.x") - 60.0).abs() < 1e-9);
    // and is on what is printed
    let print = "window.dispatchEvent(new Event('beforeprint'));
        return [...document.querySelectorAll('.printed text')].map(t => t.textContent)";
    let printed = visit.script(print).await;
    let has = |words: &str| printed.as_array().is_some_and(|all| all.iter().any(|t| t == words));
    assert!(has("60 mm") && has("30 mm") && has("H"), "{printed}");
    // what contradicts is asked before the next thing is
    let middle = |ends: [&str; 2]| {
        let [a, b] = ends.map(|end| grip(&typed, end));
        (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1))
    };
    click(&visit, middle(["line2.p2", "line3.p2"])).await;
    visit.until("window.__thinglab.state().selected === 'line3'").await;
    chord(&visit, &[], 'd').await;
    visit.until(&asks("Value of the length")).await;
    keys(&visit, "90 mm").await;
    click(&visit, middle(["line.p2", "line2.p2"])).await;
    visit.until("window.__thinglab.state().notice && !document.getElementById('asked')").await;
    assert_eq!(state(&visit).await["text"], typed["text"]);
}
