//! Four ordinary jobs by touch alone, on a phone's page. (The quadrilateral is in `hand.rs`.)

use browser::Visit;
use browser::hands::{
    begin, drag_by_finger, grip, middle, show, state, text_of, touch, touch_twice, word,
};
use browser::hands::{chord, key, keys};
use serde_json::{Value, json};

/// A place of the picture as parts of its width and height.
struct Picture {
    corner: (f64, f64),
    size: (f64, f64),
}

impl Picture {
    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.corner.0 + x * self.size.0, self.corner.1 + y * self.size.1)
    }
}

/// Begins a document on a phone's page, and says where its picture lies.
async fn begin_on_a_phone() -> (Visit, Picture) {
    let visit = begin().await;
    visit.client.set_window_size(390, 844).await.expect("a phone's window");
    visit.until("document.getElementById('picture').clientWidth < 430").await;
    let script = "const r = document.getElementById('picture').getBoundingClientRect(); \
                  return [r.left, r.top, r.width, r.height]";
    let at = visit.script(script).await;
    let number = |n: usize| at[n].as_f64().expect("a number");
    (visit, Picture { corner: (number(0), number(1)), size: (number(2), number(3)) })
}

/// Touches an element, once it lies in sight.
async fn press(visit: &Visit, selector: &str) {
    let element = format!("document.querySelector('{selector}')");
    visit.until(&element).await;
    visit.script(&format!("{element}.scrollIntoView({{ block: 'center' }})")).await;
    let at = middle(visit, selector).await;
    touch(visit, &[at]).await;
}

/// Has the document use a library, from the bin that the rail pulls up.
async fn use_library(visit: &Visit, library: &str) {
    press(visit, "[data-action=insert]").await;
    press(visit, &format!("[data-library={library}]")).await;
    visit.until(&format!("window.__thinglab.state().text.includes('use {library}')")).await;
}

/// Takes a class from the bin and touches places with it.
async fn place(visit: &Visit, class: &str, places: &[(f64, f64)]) {
    press(visit, "[data-action=insert]").await;
    press(visit, &format!("[data-class={class}]")).await;
    // the sheet makes way for the picture
    visit.until("document.querySelector('main').dataset.sheet === 'shut'").await;
    visit.until("document.getElementById('picture').clientHeight > 500").await;
    touch(visit, places).await;
}

/// Lays the tool down, and types over the number that a thing shows.
async fn type_over(visit: &Visit, path: &str, value: &str) {
    press(visit, "[data-action=select]").await;
    let at = word(&state(visit).await, path);
    touch_twice(visit, at).await;
    visit.until("document.querySelector('.inplace input') === document.activeElement").await;
    chord(visit, &[key::CONTROL], 'a').await;
    keys(visit, value).await;
    chord(visit, &[], key::ENTER).await;
    visit.until("!document.querySelector('.inplace')").await;
}

fn number(state: &Value, path: &str) -> f64 {
    let rows = state["values"].as_array().expect("values are a list");
    let row = rows.iter().find(|row| row["path"] == path);
    row.and_then(|row| row["number"].as_f64()).unwrap_or_else(|| panic!("no number {path}"))
}

#[tokio::test]
async fn what_an_action_is_called_is_not_cut_off_by_the_reason_why_it_cannot_be_done() {
    let (visit, _) = begin_on_a_phone().await;
    visit.script("document.querySelector('.search').click()").await;
    visit.until("document.querySelectorAll('.palette li[aria-disabled=true]').length > 9").await;
    let cut = "return [...document.querySelectorAll('.palette li[aria-disabled=true] .label')] \
               .filter(l => l.scrollWidth > l.clientWidth).map(l => l.textContent)";
    assert_eq!(visit.script(cut).await, json!([]));
}

#[tokio::test]
async fn a_converter_is_built_by_touch_alone() {
    let (visit, picture) = begin_on_a_phone().await;
    use_library(&visit, "calculator").await;
    let (celsius, factor, product) =
        (picture.at(0.15, 0.2), picture.at(0.15, 0.5), picture.at(0.5, 0.35));
    let (offset, fahrenheit) = (picture.at(0.5, 0.7), picture.at(0.85, 0.5));
    place(&visit, "Times", &[celsius, factor, product]).await;
    place(&visit, "Plus", &[product, offset, fahrenheit]).await;
    place(&visit, "Constant", &[factor, offset]).await;
    place(&visit, "Printer", &[celsius, fahrenheit]).await;
    for (path, value) in [("constant", "1.8"), ("constant2", "32"), ("printer", "100")] {
        type_over(&visit, path, value).await;
    }
    let hot = state(&visit).await;
    assert!((number(&hot, "plus.result.number") - 212.0).abs() < 1e-9, "{}", text_of(&hot));
}

#[tokio::test]
async fn a_divider_is_wired_by_touch_alone() {
    let (visit, picture) = begin_on_a_phone().await;
    use_library(&visit, "circuits").await;
    let (plus, minus) = (picture.at(0.15, 0.2), picture.at(0.15, 0.8));
    let (top, tap, bottom) = (picture.at(0.5, 0.2), picture.at(0.5, 0.5), picture.at(0.5, 0.8));
    place(&visit, "Battery", &[plus, minus]).await;
    place(&visit, "Ammeter", &[plus, top]).await;
    place(&visit, "Resistor", &[top, tap, tap, bottom]).await;
    place(&visit, "Wire", &[bottom, minus]).await;
    place(&visit, "Ground", &[minus]).await;
    let (right, below) = (picture.at(0.85, 0.5), picture.at(0.85, 0.8));
    place(&visit, "Voltmeter", &[tap, right]).await;
    place(&visit, "Wire", &[right, below, below, bottom]).await;
    let wired = state(&visit).await;
    let shows = |state: &Value, text: &str| {
        state["words"].as_array().is_some_and(|all| all.iter().any(|word| word["text"] == text))
    };
    assert!(shows(&wired, "7.5 mA") && shows(&wired, "750 mV"), "{}", text_of(&wired));
    type_over(&visit, "voltmeter", "0.5 V").await;
    let typed = state(&visit).await;
    assert!((number(&typed, "voltmeter.voltage") - 0.5).abs() < 1e-9, "{}", text_of(&typed));
}

#[tokio::test]
async fn a_bridge_is_built_and_loaded_by_touch_alone() {
    let (visit, picture) = begin_on_a_phone().await;
    use_library(&visit, "bridges").await;
    let (left, right) = (picture.at(0.1, 0.4), picture.at(0.9, 0.4));
    let (one, two) = (picture.at(0.37, 0.3), picture.at(0.63, 0.3));
    place(&visit, "FixedJoint", &[left, right]).await;
    place(&visit, "FreeJoint", &[one, two]).await;
    place(&visit, "Beam", &[left, one, one, two, two, right, left, two, one, right]).await;
    place(&visit, "Load", &[one]).await;
    press(&visit, "[data-action=select]").await;
    let tip = grip(&state(&visit).await, "load.tip");
    // further down so flat a bridge snaps through
    drag_by_finger(&visit, tip, (tip.0, tip.1 + 40.0)).await;
    let loaded = state(&visit).await;
    assert_eq!(loaded["status"]["satisfied"], true);
    assert!(number(&loaded, "load.size") > 0.01, "{}", text_of(&loaded));
    // the joint comes after the finger, and is not joined with what pulls on it
    assert!(!text_of(&loaded).contains("load.tip"), "{}", text_of(&loaded));
}

#[tokio::test]
async fn a_conflict_is_made_explained_and_repaired_by_touch_alone() {
    let (visit, picture) = begin_on_a_phone().await;
    press(&visit, "[data-action=tool-line]").await;
    touch(&visit, &[picture.at(0.2, 0.4), picture.at(0.8, 0.45)]).await;
    press(&visit, "[data-action=select]").await;
    touch(&visit, &[picture.at(0.5, 0.425)]).await;
    dimension(&visit, "length", "150").await;
    visit.until("window.__thinglab.state().text.includes('line.length = 150')").await;
    touch(&visit, &[grip(&state(&visit).await, "line.p1")]).await;
    press(&visit, ".strip .adding").await;
    touch(&visit, &[grip(&state(&visit).await, "line.p2")]).await;
    dimension(&visit, "distance", "200").await;
    let last = ".asked .choices button:nth-last-child(2)";
    visit.until(&format!("document.querySelector('{last}')?.innerText.includes('conflict')")).await;
    press(&visit, last).await;
    visit.until("!window.__thinglab.state().status.satisfied").await;
    press(&visit, ".status .verdict").await;
    visit.until("document.querySelectorAll('.why .repair').length >= 2").await;
    visit.picture("conflict-touch").await;
    press(&visit, ".why .repair").await;
    // what gave way to the repair is given where it is seen
    visit
        .until(
            "(s => s.satisfied && !s.message.includes('gave way'))(window.__thinglab.state().status)",
        )
        .await;
}

/// Chooses a dimension of what is selected, and types what is asked for.
async fn dimension(visit: &Visit, label: &str, value: &str) {
    press(visit, &format!("[data-offer=\"{label}\"]")).await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(visit, value).await;
    chord(visit, &[], key::ENTER).await;
}

#[tokio::test]
async fn a_linkage_is_plotted_over_a_drag_by_touch_and_nothing_lies_over_its_crank() {
    let (visit, _) = begin_on_a_phone().await;
    let shown = show(&visit, "four-bar.thing").await;
    touch(&visit, &[grip(&shown, "coupler.p2")]).await;
    visit.until("window.__thinglab.state().selected === 'coupler.p2'").await;
    press(&visit, ".handles button:last-child").await;
    press(&visit, "#tab-plot").await;
    press(&visit, ".plot-form button").await;
    // what is offered of the selection leaves the low picture free
    visit.until("document.querySelector('.strip')").await;
    let free = "window.__thinglab.state().grips.every(g => document.elementFromPoint(g.px, g.py).id === 'picture')";
    visit.until(free).await;
    visit.picture("plot-on-a-phone").await;
    let now = state(&visit).await;
    let (center, tip) = (grip(&now, "ground.p1"), grip(&now, "crank.p2"));
    drag_by_finger(&visit, tip, (center.0, center.1 - (tip.0 - center.0))).await;
    visit.until("document.body.innerText.includes('CSV')").await;
}
