//! Programs recorded by the keyboard alone, in a real browser.

use browser::Visit;
use browser::drafting::{asked, has};
use browser::hands::{self, key};

/// Presses keys, and says that the keyboard is somewhere then.
async fn keys(visit: &Visit, all: &str) {
    hands::keys(visit, all).await;
    tokio::time::sleep(std::time::Duration::from_millis(120)).await;
    let held = visit.script("return document.activeElement.tagName").await;
    assert_ne!(held, "BODY", "nobody has the keyboard after {all:?}");
}

/// Begins a construction by what narrows them.
async fn sought(visit: &Visit, words: &str) {
    hands::chord(visit, &[key::ALT], '7').await;
    visit.until("document.activeElement.name === 'construction'").await;
    keys(visit, words).await;
    visit.until("document.querySelector('.constructions .best')").await;
    keys(visit, &key::ENTER.to_string()).await;
}

/// Begins to record by the keyboard.
async fn recorded_by_keys(program: &str, parameters: &[(&str, &str)]) -> Visit {
    let visit = hands::begin().await;
    hands::chord(&visit, &[key::ALT], '7').await;
    visit.until("document.activeElement.name === 'program'").await;
    keys(&visit, &format!("{program}{}", key::ENTER)).await;
    for (name, example) in parameters {
        visit.until("document.activeElement.name === 'parameter'").await;
        keys(&visit, &format!("{name}{}{example}{}", key::TAB, key::ENTER)).await;
        visit.until(&format!("document.querySelector(\"[data-parameter='{name}']\")")).await;
    }
    visit
}

#[tokio::test]
async fn a_washer_is_recorded_by_the_keyboard_alone() {
    let visit = recorded_by_keys("Washer", &[("inner", "84"), ("outer", "160")]).await;
    sought(&visit, "circle").await;
    for typed in ["0,0", "inner / 2", "circle.center", "outer / 2"] {
        visit.until("document.activeElement.name === 'operand'").await;
        keys(&visit, &format!("{typed}{}", key::ENTER)).await;
    }
    has(&visit, "circle2 = Circle(center: circle.center, radius: outer / 2)").await;
    keys(&visit, &key::ESCAPE.to_string()).await;
    hands::press_by_keys(&visit, "at.dataset.draft === 'stop'", key::ENTER).await;
    visit.until("document.querySelector(\"[data-draft='more']\")").await;
    keys(&visit, &key::TAB.to_string()).await;
}

#[tokio::test]
async fn figure_7_6_is_recorded_by_the_keyboard_alone() {
    let visit = recorded_by_keys("Rings", &[("radius", "40"), ("minimum", "2")]).await;
    let enter = key::ENTER;
    for tool in ["horizontal line", "vertical line at"] {
        sought(&visit, tool).await;
        asked(&visit, "type a value").await;
        keys(&visit, &format!("0{enter}{}", key::ESCAPE)).await;
    }
    hands::press_by_keys(&visit, "at.dataset.draft === 'repeat'", enter).await;
    visit.until("document.querySelector(\"[data-draft='until']\")").await;
    keys(&visit, &key::TAB.to_string()).await;
    sought(&visit, "circle touches two curves radius").await;
    for typed in ["axis", "axis2", "radius"] {
        keys(&visit, &format!("{typed}{enter}")).await;
    }
    has(&visit, "circle = Circle.tangent(").await;
    sought(&visit, "circle around another radius").await;
    for typed in ["circle", "circle.radius / 2"] {
        keys(&visit, &format!("{typed}{enter}")).await;
    }
    has(&visit, "circle2 = Circle.concentric(").await;
    keys(&visit, &key::ESCAPE.to_string()).await;
    hands::press_by_keys(&visit, "at.dataset.draft === 'until'", enter).await;
    for (asks, answer) in
        [("was axis:", "-circle"), ("was axis2", "axis2"), ("was radius", "circle.radius / 2")]
    {
        asked(&visit, asks).await;
        keys(&visit, &format!("{answer}{enter}")).await;
    }
    asked(&visit, "after the last turn").await;
    keys(&visit, &format!("circle.radius < minimum{enter}")).await;
    let turns = "document.querySelector(\"[data-step='turns']\").innerText";
    visit.until(&format!("{turns}.includes('6 turns')")).await;
    // it is visited until something is drawn that the arrow keys go to
    hands::press_by_keys(&visit, "at.dataset.visit === 'picked'", enter).await;
    visit.until("document.activeElement.id === 'picture'").await;
    keys(&visit, &key::DOWN.to_string()).await;
    let found = "axis: Enter visits the program until it is drawn.";
    visit.until(&format!("document.body.innerText.includes({found:?})")).await;
    visit.picture("visited-by-keys").await;
    keys(&visit, &enter.to_string()).await;
    visit.until("document.querySelector('[aria-current=step]').innerText.includes('axis')").await;
    keys(&visit, &key::TAB.to_string()).await;
}

#[tokio::test]
async fn a_comb_is_recorded_by_the_keyboard_alone_and_applied_by_another_value() {
    let parameters = [("pitch", "12"), ("tooth", "20"), ("long", "60")];
    let visit = recorded_by_keys("Comb", &parameters).await;
    let enter = key::ENTER;
    hands::press_by_keys(&visit, "at.dataset.draft === 'repeat'", enter).await;
    visit.until("document.querySelector(\"[data-draft='until']\")").await;
    for (tool, from, length) in [
        ("vertical line from length", "0,0", "tooth"),
        ("horizontal line from length", "line.p2", "pitch / 2"),
        ("vertical line from length", "line2.p2", "-tooth"),
        ("horizontal line from length", "line3.p2", "pitch / 2"),
    ] {
        sought(&visit, tool).await;
        for typed in [from, length] {
            visit.until("document.activeElement.name === 'operand'").await;
            keys(&visit, &format!("{typed}{enter}")).await;
        }
        keys(&visit, &key::ESCAPE.to_string()).await;
    }
    has(&visit, "line4 = Line.horizontal(from: line3.p2, length: pitch / 2)").await;
    hands::press_by_keys(&visit, "at.dataset.draft === 'until'", enter).await;
    asked(&visit, "was (0, 0)").await;
    keys(&visit, &format!("line4.p2{enter}")).await;
    // all else is the same
    for asks in ["was tooth", "was pitch / 2", "was -tooth", "was pitch / 2"] {
        asked(&visit, asks).await;
        keys(&visit, &enter.to_string()).await;
    }
    // the condition by the keys of the calculator, which stands before the field
    asked(&visit, "after the last turn").await;
    keys(&visit, "line4.p2.x").await;
    hands::press_back_by_keys(&visit, "at.dataset.key === '≥'", enter).await;
    hands::press_by_keys(&visit, "at.dataset.value === 'long'", enter).await;
    hands::press_back_by_keys(&visit, "at.dataset.key === 'give'", enter).await;
    has(&visit, "until line4.p2.x >= long").await;
    let turns = "document.querySelector(\"[data-step='turns']\").innerText";
    visit.until(&format!("{turns}.includes('5 turns')")).await;
    hands::press_by_keys(&visit, "at.dataset.draft === 'stop'", enter).await;
    visit.until("document.querySelector(\"[data-draft='more']\")").await;
    // once more, by other values
    hands::press_by_keys(&visit, "at.name === 'construction'", 'c').await;
    keys(&visit, "omb").await;
    visit.until("document.querySelector('.constructions .best')").await;
    keys(&visit, &enter.to_string()).await;
    for (asks, typed) in [("pitch", "12"), ("tooth", "8"), ("long", "84"), ("at", "0,40")] {
        asked(&visit, asks).await;
        keys(&visit, &format!("{typed}{enter}")).await;
    }
    has(&visit, "comb2: ").await;
    visit.picture("comb-by-keys").await;
}
