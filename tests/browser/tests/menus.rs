//! Menus of what is no figure: a value of the inspector, a row of the structure, a class's tile; and the pane of a class.

use browser::Visit;
use browser::hands::{chord, key, keys, middle, point, show, state, text_of, word};
use fantoccini::actions::{
    InputSource, MOUSE_BUTTON_LEFT, MOUSE_BUTTON_RIGHT, MouseActions, PointerAction,
};
use std::time::Duration;

const CRANK: &str = "\
use geometry
crank: Line { p1 = (0, 0)  p2 = (60, 80) }
rod: Line { p2 = (342.8, 0) }
merge crank.p2 = rod.p1
anchor crank.p1
constraint crank.p1.y = rod.p2.y
constraint crank.length = 100
constraint rod.length = 300
";

const SLOT: &str = "\
use geometry
class Slot {
    left, right: Circle
    constraint left.radius = right.radius
    constraint left.radius = 50
    attachers left.center, right.center
}
slot: Slot { left.center = (0, 0)  right.center = (200, 0) }
";

/// Asks for the menu of what an element shows, and takes what is offered there.
async fn take(visit: &Visit, at: (f64, f64), action: &str) {
    point(visit, at, MOUSE_BUTTON_RIGHT).await;
    let item = format!("document.querySelector('[role=menu] [data-action={action}]')");
    visit.until(&item).await;
    visit.script(&format!("{item}.click()")).await;
}

/// Where the name of a value stands in the inspector.
async fn value(visit: &Visit, name: &str) -> (f64, f64) {
    let row = format!(
        "[...document.querySelectorAll('.inspector tr th')].find(th => th.textContent.trim() === '{name}')"
    );
    visit.until(&row).await;
    let script =
        format!("const r = {row}.getBoundingClientRect(); return [r.left + 12, r.top + 12]");
    let at = visit.script(&script).await;
    (at[0].as_f64().expect("a number"), at[1].as_f64().expect("a number"))
}

async fn choose(visit: &Visit, path: &str) {
    visit
        .script(&format!("document.querySelector('[role=treeitem][data-path=\"{path}\"]').click()"))
        .await;
    visit.until(&format!("window.__thinglab.state().selected === '{path}'")).await;
}

#[tokio::test]
async fn a_value_of_the_inspector_is_plotted_and_swept_without_its_path_being_typed() {
    let visit = Visit::open_empty().await;
    visit.put("crank.thing", CRANK);
    show(&visit, "crank.thing").await;
    choose(&visit, "rod").await;
    take(&visit, value(&visit, "p2.x").await, "plot").await;
    choose(&visit, "crank").await;
    take(&visit, value(&visit, "direction").await, "sweep").await;
    visit
        .until(
            "(p => p.curves.length === 1 && p.curves[0] === 'rod.p2.x' && p.samples > 100) \
             (window.__thinglab.state().plotted)",
        )
        .await;
    // an angle is told as one, and once
    let shown = "document.querySelector('.inspector').innerText";
    visit.until(&format!("{shown}.includes('Angle')")).await;
    assert_eq!(visit.script(&format!("return {shown}.includes('0.92')")).await, false);
    visit.picture("swept").await;
    // the structure has the menu of a figure, too
    take(&visit, middle(&visit, "[role=treeitem][data-path=rod]").await, "duplicate").await;
    visit.until("window.__thinglab.state().text.includes('line: Line')").await;
}

#[tokio::test]
async fn a_class_is_renamed_and_deleted_by_the_menu_of_its_tile() {
    let visit = Visit::open_empty().await;
    visit.put("slot.thing", SLOT);
    show(&visit, "slot.thing").await;
    visit.script("document.getElementById('tab-bin').click()").await;
    let tile = middle(&visit, "[data-class=Slot]").await;
    take(&visit, tile, "class-rename").await;
    visit.until("document.activeElement.id === 'asked'").await;
    chord(&visit, &[key::CONTROL], 'a').await;
    keys(&visit, "Oblong").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('slot: Oblong')").await;
    // what is in use stays, and it is said where
    let tile = middle(&visit, "[data-class=Oblong]").await;
    take(&visit, tile, "class-delete").await;
    visit.until("window.__thinglab.state().notice.includes('made of Oblong')").await;
    assert!(text_of(&state(&visit).await).contains("class Oblong"));
}

#[tokio::test]
async fn done_shows_the_document_as_it_was_before_its_class_was_edited() {
    let visit = Visit::open_empty().await;
    visit.put("slot.thing", SLOT);
    show(&visit, "slot.thing").await;
    visit.script("document.getElementById('tab-bin').click()").await;
    for _ in 0..3 {
        chord(&visit, &[], '-').await;
    }
    visit.until("window.__thinglab.state().sheet.scale < 2").await;
    let before = state(&visit).await["sheet"].clone();
    let tile = middle(&visit, "[data-class=Slot]").await;
    take(&visit, tile, "class-edit").await;
    // the pane is the class's: its name stands where that of the document stood
    visit.until("document.querySelector('.inspector .subject').innerText === 'Slot'").await;
    visit.until("window.__thinglab.state().words.some(word => word.text === 'R 50')").await;
    let radius = word_saying(&state(&visit).await, "R 50");
    point(&visit, radius, 0).await;
    chord(&visit, &[], 'd').await;
    visit.until("document.activeElement.id === 'asked'").await;
    chord(&visit, &[key::CONTROL], 'a').await;
    keys(&visit, "30").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('left.radius = 30')").await;
    visit.script("document.querySelector('.class-pane button').click()").await;
    visit.until("!document.querySelector('.class-pane')").await;
    visit.until("window.__thinglab.state().values.some(v => v.path === 'slot.left.radius' && v.number === 30)").await;
    assert_eq!(state(&visit).await["sheet"], before);
}

/// Where a word of the picture lies that says this.
fn word_saying(state: &serde_json::Value, says: &str) -> (f64, f64) {
    let words = state["words"].as_array().expect("words are a list");
    let found = words.iter().find(|word| word["text"] == says).expect("it says so");
    word(state, found["path"].as_str().expect("a path"))
}

#[tokio::test]
async fn escape_gives_up_a_slider_that_is_still_held() {
    let visit = Visit::open_empty().await;
    visit.put("crank.thing", CRANK);
    let before = text_of(&show(&visit, "crank.thing").await);
    choose(&visit, "rod.p2").await;
    let slider = middle(&visit, ".inspector input[type=range]").await;
    let to = |x: f64| PointerAction::MoveTo {
        duration: Some(Duration::from_millis(60)),
        x: slider.0 + x,
        y: slider.1,
    };
    let perform = async |actions: MouseActions| {
        visit.client.perform_actions(actions).await.expect("the mouse goes there");
    };
    let mouse = || MouseActions::new("mouse".into());
    let down = || PointerAction::Down { button: MOUSE_BUTTON_LEFT };
    perform(mouse().then(to(0.0)).then(down()).then(to(20.0))).await;
    visit.until("window.__thinglab.state().dragging").await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until("!window.__thinglab.state().dragging").await;
    perform(mouse().then(to(40.0)).then(PointerAction::Up { button: MOUSE_BUTTON_LEFT })).await;
    assert_eq!(text_of(&state(&visit).await), before);
    // the next hand has it
    perform(mouse().then(to(0.0)).then(down()).then(to(20.0))).await;
    perform(mouse().then(PointerAction::Up { button: MOUSE_BUTTON_LEFT })).await;
    visit.until("window.__thinglab.state().status.undo").await;
}
