//! Drawing by constructions, and a program recorded by drawing one example: with the mouse, and without a line of text.

use browser::Visit;
use fantoccini::Locator;
use fantoccini::actions::{InputSource, MOUSE_BUTTON_LEFT, MouseActions, PointerAction};
use serde_json::Value;
use std::time::Duration;

async fn press(visit: &Visit, selector: &str) {
    let found = visit.client.wait().for_element(Locator::Css(selector)).await;
    let found = found.unwrap_or_else(|e| panic!("{selector}: {e}"));
    found.click().await.unwrap_or_else(|e| panic!("{selector}: {e}"));
}

async fn fill(visit: &Visit, selector: &str, text: &str) {
    let found = visit.client.find(Locator::Css(selector)).await;
    let found = found.unwrap_or_else(|e| panic!("{selector}: {e}"));
    found.send_keys(text).await.unwrap_or_else(|e| panic!("{selector}: {e}"));
}

async fn text(visit: &Visit) -> String {
    let script = "return window.__thinglab.state()";
    let state: Value = visit.script(script).await;
    state["text"].as_str().expect("a text").to_string()
}

/// Clicks where a place of the sheet is seen.
async fn point(visit: &Visit, x: f64, y: f64) {
    let script = format!(
        "const grips = window.__thinglab.state().grips;
         const grip = path => grips.find(g => g.path === path);
         const [a, b, c] = ['ground.p1', 'ground.p2', 'driver.center'].map(grip);
         return [a.px + (b.px - a.px) / (b.x - a.x) * ({x} - a.x),
             a.py + (c.py - a.py) / (c.y - a.y) * ({y} - a.y)]"
    );
    let at = visit.script(&script).await;
    let at = |n: usize| at[n].as_f64().expect("a number").round();
    let to =
        PointerAction::MoveTo { duration: Some(Duration::from_millis(40)), x: at(0), y: at(1) };
    let actions = MouseActions::new("mouse".into())
        .then(to)
        .then(PointerAction::Pause { duration: Duration::from_millis(60) })
        .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT })
        .then(PointerAction::Up { button: MOUSE_BUTTON_LEFT });
    visit.client.perform_actions(actions).await.expect("the mouse clicks");
    tokio::time::sleep(Duration::from_millis(80)).await;
}

const OPERAND: &str = "input[name='operand']";
const ENTER: &str = "\u{e007}";

async fn enter(visit: &Visit, typed: &str) {
    fill(visit, OPERAND, &format!("{typed}{ENTER}")).await;
    tokio::time::sleep(Duration::from_millis(80)).await;
}

#[tokio::test]
async fn the_circle_that_is_nearest_to_the_picks_is_drawn() {
    let visit = Visit::open(Some("belt.thing")).await;
    visit.until("document.querySelector('#tab-draw')").await;
    press(&visit, "#tab-draw").await;
    press(&visit, "[data-construction='Circle.tangent(first,second,radius)']").await;
    // the ground from above, and the larger wheel from its right: the circle lies between
    point(&visit, 60.0, -100.0).await;
    point(&visit, 58.0, -15.0).await;
    enter(&visit, "20").await;
    let text = text(&visit).await;
    assert!(text.contains("circle => Circle.tangent("), "{text}");
    assert!(text.contains("ground") && text.contains("radius: 20"), "{text}");
}

#[tokio::test]
async fn a_washer_is_recorded_by_drawing_one() {
    let visit = Visit::open(Some("belt.thing")).await;
    visit.until("document.querySelector('#tab-draw')").await;
    press(&visit, "#tab-draw").await;
    fill(&visit, "input[name='program']", "Washer").await;
    press(&visit, "[data-draft='record']").await;
    for (name, example, question) in
        [("inner", "84", "Clearance hole?"), ("outer", "160", "Outer diameter?")]
    {
        visit.client.wait().for_element(Locator::Css("input[name='parameter']")).await.expect("it");
        fill(&visit, "input[name='parameter']", name).await;
        fill(&visit, "input[name='example']", example).await;
        fill(&visit, "input[name='question']", question).await;
        press(&visit, "[data-draft='define']").await;
        visit.until(&format!("document.querySelector(\"[data-parameter='{name}']\")")).await;
    }
    press(&visit, "[data-construction='Circle']").await;
    point(&visit, 290.0, -70.0).await;
    press(&visit, "[data-parameter='inner']").await;
    enter(&visit, " / 2").await;
    point(&visit, 290.0, -70.0).await;
    press(&visit, "[data-parameter='outer']").await;
    enter(&visit, " / 2").await;
    visit.until("document.querySelectorAll('.steps li').length === 2").await;
    let text = text(&visit).await;
    assert!(text.contains("circle2 = Circle(center: circle.center, radius: outer / 2)"), "{text}");
    press(&visit, "[data-draft='stop']").await;
    press(&visit, "#tab-bin").await;
    visit.until("document.querySelector(\".tile[data-class='Washer']\")").await;
}
