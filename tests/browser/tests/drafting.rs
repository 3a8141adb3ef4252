//! Drawing by constructions, and a program recorded by drawing one example: with the mouse, and without a line of text.

use browser::Visit;
use browser::hands::{self, state, text_of};
use fantoccini::Locator;
use fantoccini::actions::MOUSE_BUTTON_LEFT;
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
    let at = |n: usize| at[n].as_f64().expect("a number");
    hands::point(visit, (at(0), at(1)), MOUSE_BUTTON_LEFT).await;
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
    let text = text_of(&state(&visit).await);
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
    let text = text_of(&state(&visit).await);
    assert!(text.contains("circle2 = Circle(center: circle.center, radius: outer / 2)"), "{text}");
    press(&visit, "[data-draft='stop']").await;
    press(&visit, "#tab-bin").await;
    visit.until("document.querySelector(\".tile[data-class='Washer']\")").await;
}
