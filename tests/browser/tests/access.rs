//! What axe-core finds wrong with the page (`assets/axe.min.js`, MPL-2.0), light and dark, and what is cut off in a
//! narrow window.

use super::lab::FRAME;
use browser::Visit;
use browser::hands::{
    begin, chord, drag, grip, key, keys, place, point, set_place_by_keys, show, state,
};
use fantoccini::actions::MOUSE_BUTTON_LEFT;
use serde_json::json;

const AXE: &str = include_str!("../assets/axe.min.js");

/// What axe-core finds that is not minor, each with where it is.
const FINDINGS: &str = "
    const done = arguments[arguments.length - 1];
    axe.run(document, { resultTypes: ['violations'] }).then(found => done(found.violations
        .filter(v => v.impact !== 'minor')
        .map(v => `${v.id}: ${v.nodes.map(n => n.target.join(' ')).join(', ')}`)))";

async fn accessible(visit: &Visit, place: &str) {
    let found = visit.client.execute_async(FINDINGS, Vec::new()).await.expect("axe runs");
    assert_eq!(found, json!([]), "{place}");
}

#[tokio::test]
async fn gallery_document_panes_and_dialogs_have_no_serious_findings_light_and_dark() {
    let visit = Visit::open(None).await;
    visit.until("document.querySelector('.card')").await;
    visit.client.execute(AXE, Vec::new()).await.expect("axe is loaded");
    for scheme in ["light", "dark"] {
        visit.script(&format!("document.documentElement.style.colorScheme = '{scheme}'")).await;
        visit.script("location.hash = '#/'").await;
        visit.until("document.querySelector('.card')").await;
        accessible(&visit, &format!("{scheme}: the gallery")).await;
        show(&visit, "quadrilateral.thing").await;
        visit.until("document.getElementById('picture').width > 10").await;
        point(&visit, grip(&state(&visit).await, "q.outer.side2.p2"), MOUSE_BUTTON_LEFT).await;
        chord(&visit, &[key::ALT], '4').await;
        visit.until("document.querySelector('.cm-content')").await;
        accessible(&visit, &format!("{scheme}: text, a corner selected")).await;
        chord(&visit, &[key::ALT], '3').await;
        visit.until("document.querySelector('.values table')").await;
        chord(&visit, &[key::ALT], '1').await;
        accessible(&visit, &format!("{scheme}: table")).await;
        for (keys, opened) in [("w", "#why"), ("i", ".bin input")] {
            chord(&visit, &[], keys.chars().next().expect("one key")).await;
            visit.until(&format!("document.querySelector('{opened}')")).await;
            accessible(&visit, &format!("{scheme}: {opened}")).await;
            chord(&visit, &[key::ALT], '1').await;
        }
        chord(&visit, &[], 'w').await;
        chord(&visit, &[key::CONTROL], 'k').await;
        visit.until("document.querySelector('[role=combobox], [role=listbox]')").await;
        accessible(&visit, &format!("{scheme}: palette")).await;
        chord(&visit, &[], key::ESCAPE).await;
        chord(&visit, &[key::ALT], '1').await;
        chord(&visit, &[], key::F2).await;
        visit.until("document.activeElement.id === 'asked'").await;
        accessible(&visit, &format!("{scheme}: the name dialog")).await;
        chord(&visit, &[], key::ESCAPE).await;
    }
}

/// Presses the button that says something.
async fn press(visit: &Visit, words: &str) {
    let button = format!(
        "[...document.querySelectorAll('button')] \
         .find(b => b.innerText.trim() === '{words}' && b.offsetParent)"
    );
    visit.until(&button).await;
    visit.script(&format!("{button}.click()")).await;
}

#[tokio::test]
async fn questions_menus_families_plots_and_conflicts_have_no_serious_findings() {
    let visit = Visit::open_empty().await;
    // one line of two lengths is a conflict
    let text = format!("{FRAME}constraint k.length = 30\nconstraint off: k.length = 40\n");
    visit.put("frame.thing", &text);
    visit.client.execute(AXE, Vec::new()).await.expect("axe is loaded");
    for scheme in ["light", "dark"] {
        visit.script(&format!("document.documentElement.style.colorScheme = '{scheme}'")).await;
        show(&visit, "washer.thing").await;
        visit.script("document.getElementById('tab-calculator').click()").await;
        visit.until("document.querySelector('.calculator .expression')").await;
        visit.script("document.querySelector('.calculator .expression').focus()").await;
        keys(&visit, &format!("m8.outer / 2{}", key::ENTER)).await;
        visit.until("document.querySelector('.calculator').innerText.includes('8 mm')").await;
        accessible(&visit, &format!("{scheme}: calculator")).await;
        visit.script("document.getElementById('tab-family').click()").await;
        for view in ["Rows", "Pictures", "Map"] {
            press(&visit, view).await;
            visit.until(&format!("[...document.querySelectorAll('.family [aria-checked=true]')].some(b => b.innerText === '{view}')")).await;
            accessible(&visit, &format!("{scheme}: {view} of a family")).await;
        }
        visit.script("document.getElementById('tab-plot').click()").await;
        accessible(&visit, &format!("{scheme}: plot")).await;
        visit.script("document.getElementById('tab-plot').click()").await;
        visit.script("document.getElementById('tab-draw').click()").await;
        visit.until("document.querySelector('.constructions, .drawing')").await;
        accessible(&visit, &format!("{scheme}: constructions")).await;
        visit.script("document.getElementById('tab-structure').click()").await;

        show(&visit, "lesson-2-figure.thing").await;
        visit.until("document.querySelector('.coach')").await;
        accessible(&visit, &format!("{scheme}: a lesson")).await;

        show(&visit, "frame.thing").await;
        let row = |name: &str| {
            format!(
                "[...document.querySelectorAll('[role=treeitem]')].find(r => r.querySelector('.name').textContent === '{name}')"
            )
        };
        visit.until(&row("level")).await;
        visit.script(&format!("{}.click()", row("level"))).await;
        chord(&visit, &[], key::DELETE).await;
        visit.until("document.activeElement.closest('.asked')").await;
        accessible(&visit, &format!("{scheme}: a question")).await;
        chord(&visit, &[], key::ESCAPE).await;
        visit.script("document.querySelector('.verdict').click()").await;
        visit.until("document.querySelector('.why .repair')").await;
        accessible(&visit, &format!("{scheme}: a conflict")).await;
        visit.script("document.querySelector('.verdict').click()").await;
        visit.script(&format!("{}.click()", row("k"))).await;
        visit.until("window.__thinglab.state().selected === 'k'").await;
        accessible(&visit, &format!("{scheme}: a selected line")).await;
        visit.script(&format!("{}.dispatchEvent(new MouseEvent('contextmenu', {{ bubbles: true, clientX: 90, clientY: 300 }}))", row("k"))).await;
        visit.until("document.querySelector('[role=menu]')").await;
        accessible(&visit, &format!("{scheme}: a menu")).await;
        chord(&visit, &[], key::ESCAPE).await;
        visit.script(&format!("{}.click()", row("first"))).await;
        visit.until("window.__thinglab.state().selected === 'first'").await;
        chord(&visit, &[key::SHIFT], 'E').await;
        visit.until("document.querySelector('.class-inset')").await;
        accessible(&visit, &format!("{scheme}: a class that is edited")).await;
        visit.script("document.querySelector('.class-inset').click()").await;
        visit.until("!document.querySelector('.class-inset')").await;
    }
}

#[tokio::test]
async fn the_bin_is_one_stop_of_tab_and_arrows_lead_from_tile_to_tile() {
    let visit = Visit::open(None).await;
    show(&visit, "quadrilateral.thing").await;
    visit.until("document.getElementById('picture').width > 10").await;
    visit.script("document.getElementById('tab-bin').click()").await;
    visit.until("document.querySelectorAll('.bin .tile').length > 20").await;
    visit.until("document.querySelectorAll('.bin .scroll [tabindex=\"0\"]').length === 1").await;
    visit.script("document.querySelector('.bin input').focus()").await;
    let within = "return document.activeElement.closest('.bin .scroll') !== null";
    chord(&visit, &[], key::TAB).await;
    assert_eq!(visit.script(within).await, json!(true));
    chord(&visit, &[], key::TAB).await;
    assert_eq!(visit.script(within).await, json!(false));
    visit.script("document.querySelector('.bin input').focus()").await;
    chord(&visit, &[], key::DOWN).await;
    let class = "return document.activeElement.dataset.class";
    let first = visit.script(class).await;
    chord(&visit, &[], key::RIGHT).await;
    let second = visit.script(class).await;
    assert!(first.is_string() && second.is_string() && first != second, "{first} {second}");
}

#[tokio::test]
async fn a_corner_of_a_rectangle_dragged_by_hand_resizes_it_and_is_told_of() {
    let visit = begin().await;
    visit.script("document.getElementById('tab-bin').click()").await;
    place(&visit, "Rectangle", &[(600.0, 500.0), (800.0, 300.0)]).await;
    chord(&visit, &[], key::ESCAPE).await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until("window.__thinglab.state().grips.some(g => g.path === 'rectangle.far')").await;
    let before = state(&visit).await;
    let far = grip(&before, "rectangle.far");
    drag(&visit, far, (far.0 + 50.0, far.1 - 40.0)).await;
    visit
        .until("document.querySelector('.inspector .subject').textContent === 'rectangle.far'")
        .await;
    let after = state(&visit).await;
    let near = [grip(&before, "rectangle.corner"), grip(&after, "rectangle.corner")];
    assert!((near[0].0 - near[1].0).abs() < 1.0 && (near[0].1 - near[1].1).abs() < 1.0, "{near:?}");
    assert_ne!(before["text"], after["text"]);
    visit.until("document.querySelector('.inspector .made dd')").await;
    visit.until("document.querySelector('.inspector .values').textContent.includes('width')").await;
}

#[tokio::test]
async fn the_keyboard_stays_in_the_search_and_finds_the_family_by_it() {
    let visit = begin().await;
    chord(&visit, &[key::CONTROL], 'k').await;
    visit.until("document.activeElement.closest('[role=dialog]')").await;
    keys(&visit, &format!("{}{}family", key::TAB, key::TAB)).await;
    visit.until("document.activeElement.value === 'family'").await;
    keys(&visit, &key::ENTER.to_string()).await;
    visit.until("document.activeElement.id === 'tab-family'").await;
}

#[tokio::test]
async fn who_uses_keys_is_told_what_they_do_where_they_go() {
    let visit = begin().await;
    let said =
        |words: &str| format!("document.querySelector('.said').innerText.includes('{words}')");
    chord(&visit, &[], '?').await;
    visit.until("document.querySelector('.palette input') === document.activeElement").await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until(&said("L: a line")).await;
    chord(&visit, &[], 'l').await;
    visit.until(&said("Line: Enter to set its first point")).await;
    // a place that is typed is in sight, wherever it lies
    for place in ["-3000,-2000", "700,80"] {
        set_place_by_keys(&visit, place).await;
    }
    visit.until("window.__thinglab.state().text.includes('p1 = (-3000, -2000)')").await;
    visit.until(&said("Line: Enter to set its second point")).await;
    visit
        .until(
            "(r => window.__thinglab.state().grips.every(g => g.px > r.left && g.py > r.top && g.px < r.right && g.py < r.bottom))(document.getElementById('picture').getBoundingClientRect())",
        )
        .await;
    chord(&visit, &[], key::ESCAPE).await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until(&said("K: what can hold of it")).await;
    chord(&visit, &[key::ALT], '2').await;
    visit.until(&said("Ctrl+Space: another as well")).await;
    chord(&visit, &[], 'k').await;
    visit.until("document.activeElement.dataset.offer === 'horizontal'").await;
    visit.until(&said("so it shall be")).await;
    chord(&visit, &[], key::RIGHT).await;
    visit.until("document.activeElement.dataset.offer === 'vertical'").await;
    // the pointer has hints of its own
    point(&visit, (400.0, 600.0), MOUSE_BUTTON_LEFT).await;
    visit.until(&said("wheel: zoom")).await;
}

#[tokio::test]
async fn a_field_of_the_table_that_has_the_keyboard_may_go_with_the_table() {
    let visit = Visit::open(None).await;
    show(&visit, "quadrilateral.thing").await;
    chord(&visit, &[key::ALT], '3').await;
    visit.until("document.activeElement.matches('.dock .field')").await;
    chord(&visit, &[key::ALT], '4').await;
    visit.until("document.activeElement.matches('.cm-content')").await;
    // the page is alive
    chord(&visit, &[key::ALT], '3').await;
    visit.until("document.activeElement.matches('.dock .field')").await;
}
