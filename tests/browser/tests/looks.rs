//! What a visitor's eye stumbles over: words that are cut off, rows that never shut, red before a word is written.

use base::number;
use browser::Visit;
use browser::hands::{begin, carry, chord, drag, grip, key, keys, point, show, state};
use fantoccini::actions::MOUSE_BUTTON_LEFT;
use serde_json::json;

/// How many rows the tree of the structure has open.
const ROWS: &str = "return document.querySelector('[role=tree]').style.getPropertyValue('--rows')";

#[tokio::test]
async fn rows_that_a_selection_opened_are_shut_again_by_the_next() {
    let visit = Visit::open_empty().await;
    let opened = show(&visit, "quadrilateral.thing").await;
    visit.until("document.querySelectorAll('[role=treeitem]').length > 20").await;
    let first = visit.script(ROWS).await;
    let row =
        |path: &str| format!("document.querySelector('[role=treeitem][data-path=\"{path}\"]')");
    for (path, side) in
        [("q.outer.side2.p2", "q.outer.side2"), ("q.inner.side1.p1", "q.inner.side1")]
    {
        point(&visit, grip(&opened, path), MOUSE_BUTTON_LEFT).await;
        visit.until(&format!("{}?.matches('.selected')", row(path))).await;
        visit.until(&format!("{}.getAttribute('aria-expanded') === 'true'", row(side))).await;
    }
    assert_eq!(visit.script(&format!("return {}", row("q.outer.side2.p2"))).await, json!(null));
    // what a hand has opened stays open
    visit.script(&format!("{}.querySelector('.twist').click()", row("q.outer.side3"))).await;
    visit.until(&row("q.outer.side3.p2")).await;
    visit.script("document.getElementById('picture').focus()").await;
    keys(&visit, &key::ESCAPE.to_string()).await;
    visit.until(&format!("!{}", row("q.inner.side1.p1"))).await;
    visit.until(&row("q.outer.side3.p2")).await;
    visit.script(&format!("{}.querySelector('.twist').click()", row("q.outer.side3"))).await;
    visit.until(&format!("!{}", row("q.outer.side3.p2"))).await;
    assert_eq!(visit.script(ROWS).await, first);
    // the tree is still a stop of Tab
    visit.until("document.querySelectorAll('[role=treeitem][tabindex=\"0\"]').length === 1").await;
}

#[tokio::test]
async fn a_half_typed_word_is_not_red_before_it_is_left() {
    let visit = begin().await;
    visit.script("document.getElementById('tab-text').click()").await;
    visit.until("document.querySelector('.cm-content')").await;
    visit.script("document.querySelector('.cm-content').focus()").await;
    chord(&visit, &[key::CONTROL], key::END).await;
    keys(&visit, "a: Lin").await;
    let known = "window.__thinglab.state().diagnostics.some(d => d.code === 'unknown-class')";
    visit.until(known).await;
    let red = "return document.querySelectorAll('.cm-lintRange-error, .problems, #tab-text .count').length";
    assert_eq!(visit.script(red).await, json!(0));
    // the status says at once that the text is not what is in force
    visit.until("document.querySelector('.verdict').textContent.includes('one error')").await;
    keys(&visit, &key::HOME.to_string()).await;
    visit.until("document.querySelector('.cm-lintRange-error')").await;
    visit
        .until(
            "document.querySelector('.problems li') && document.querySelector('#tab-text .count')",
        )
        .await;
}

#[tokio::test]
async fn what_comes_after_the_first_minute_fits_its_card() {
    let visit = Visit::open_empty().await;
    show(&visit, "lesson-1-first-minute.thing").await;
    let next = "document.querySelector('.lesson .primary')";
    visit.until("document.querySelector('.lesson .place')").await;
    let opened = state(&visit).await;
    let from = grip(&opened, "q.outer.side2.p2");
    drag(&visit, from, (from.0 - 30.0, from.1 + 20.0)).await;
    visit.until("document.querySelector('.lesson .place').textContent.includes('2 of 3')").await;
    visit.script("document.querySelector('.verdict').click()").await;
    visit.until(next).await;
    visit.script(&format!("{next}.click()")).await;
    visit.until("document.querySelector('.lesson').textContent.includes('done')").await;
    visit.until(&format!("{next}?.textContent === 'Next: A figure of your own'")).await;
    let fits = format!(
        "{next}.getBoundingClientRect().right <= \
         document.querySelector('.lesson').getBoundingClientRect().right"
    );
    visit.until(&fits).await;
}

/// Whether words are wholly seen.
fn whole(element: &str) -> String {
    format!("(e => e && e.scrollWidth <= e.clientWidth)(document.querySelector('{element}'))")
}

#[tokio::test]
async fn names_values_and_the_verdict_are_not_cut_off_where_there_is_room() {
    let visit = Visit::open_empty().await;
    show(&visit, "washer.thing").await;
    let row = "[role=treeitem][data-path=\"m8.thickness\"]";
    visit.until(&format!("document.querySelector('{row}')")).await;
    for part in [".name", ".value"] {
        visit.until(&whole(&format!("{row} {part}"))).await;
    }
    visit.until(&whole("[role=treeitem][data-path=\"m8.middle\"] .value")).await;
    // at 200 %
    visit.client.set_window_size(720, 450).await.expect("a small window");
    show(&visit, "quadrilateral.thing").await;
    visit
        .until("document.querySelector('.verdict').textContent.includes('8 degrees of freedom')")
        .await;
    visit.until(&whole(".verdict span")).await;
    visit.until("document.querySelector('.said').textContent.includes('drag over')").await;
}

#[tokio::test]
async fn what_is_said_of_many_values_is_said_once() {
    let visit = Visit::open_empty().await;
    show(&visit, "warren-truss.thing").await;
    visit.until("document.querySelectorAll('.inspector .values tr input').length > 10").await;
    let said = "const all = [...document.querySelectorAll('.inspector .asked')].map(p => p.textContent); \
                return [all.includes('How hard something pulls down at it.'), new Set(all).size === all.length]";
    assert_eq!(visit.script(said).await, json!([true, true]));
}

#[tokio::test]
async fn undo_that_is_held_down_shows_the_list_of_steps() {
    let visit = Visit::open_empty().await;
    let opened = show(&visit, "quadrilateral.thing").await;
    let from = grip(&opened, "q.outer.side2.p2");
    drag(&visit, from, (from.0 - 30.0, from.1 + 20.0)).await;
    visit.until("window.__thinglab.state().status.undo").await;
    let undo = "document.querySelector('[data-action=undo]')";
    visit
        .script(&format!(
            "{undo}.dispatchEvent(new PointerEvent('pointerdown', {{ bubbles: true }}))"
        ))
        .await;
    visit.until("document.querySelectorAll('.history li').length === 2").await;
    // letting go is no click then; the next one is
    visit.script(&format!("{undo}.click()")).await;
    visit.until("window.__thinglab.state().status.undo").await;
    visit.script(&format!("{undo}.click()")).await;
    visit.until("!window.__thinglab.state().status.undo").await;
}

#[tokio::test]
async fn a_crank_that_is_guided_along_its_circle_does_not_flicker() {
    let visit = Visit::open_empty().await;
    let opened = show(&visit, "four-bar.thing").await;
    let (tip, centre) = (grip(&opened, "crank.p2"), grip(&opened, "ground.p1"));
    let radius = number::hypot(tip.0 - centre.0, tip.1 - centre.1);
    let at = |degrees: f64, r: f64| {
        let angle = degrees.to_radians();
        (centre.0 + r * number::cos(angle), centre.1 - r * number::sin(angle))
    };
    let said = "return document.querySelector('.said').textContent";
    let mut from = tip;
    for degrees in [10.0, 20.0, 35.0, 50.0, 80.0] {
        let to = at(degrees, radius);
        carry(&visit, from, to).await;
        visit.until("window.__thinglab.state().dragging").await;
        assert_eq!(visit.script(said).await, json!(""), "at {degrees} degrees");
        visit.client.release_actions().await.expect("the button is let go");
        visit.until("!window.__thinglab.state().dragging").await;
        from = grip(&state(&visit).await, "crank.p2");
    }
    carry(&visit, from, at(90.0, 1.5 * radius)).await;
    visit.until("document.querySelector('.said').textContent.includes('reach 40 of')").await;
    visit.client.release_actions().await.expect("the button is let go");
}

#[tokio::test]
async fn what_is_typed_into_an_empty_document_is_in_sight_and_parts_without_places_lie_apart() {
    let visit = begin().await;
    visit.script("document.getElementById('tab-text').click()").await;
    visit.until("document.querySelector('.cm-content')").await;
    visit.script("document.querySelector('.cm-content').focus()").await;
    let text =
        "use circuits\nr1: Resistor\nr2: Resistor\nr3: Resistor\nb: Battery\nx: Wire\ny: Wire\n";
    visit.client.active_element().await.expect("the editor").send_keys(text).await.expect("keys");
    visit.until("window.__thinglab.state().grips.length === 12").await;
    let inside = "(box => window.__thinglab.state().grips.every(g => g.px > box.left && \
                  g.px < box.right && g.py > box.top && g.py < box.bottom)) \
                  (document.getElementById('picture').getBoundingClientRect())";
    visit.until(inside).await;
    let apart = "(all => all.every((a, i) => all.slice(0, i).every(b => \
                 Math.hypot(a.px - b.px, a.py - b.py) > 20)))(window.__thinglab.state().grips)";
    visit.until(apart).await;
}

#[tokio::test]
async fn what_cannot_be_satisfied_is_named_and_a_line_called_side_has_a_row_like_others() {
    let visit = Visit::open_empty().await;
    visit.put(
        "clash.thing",
        "use geometry\nside: Line { p1 = (0, 0)  p2 = (40, 0) }\nother: Line { p1 = (0, 9)  p2 = (40, 9) }\n\
         constraint short: side.length = 40\nconstraint long: side.length = 50\nlong.enabled = false\n",
    );
    show(&visit, "clash.thing").await;
    let row = |name: &str| {
        format!(
            "[...document.querySelectorAll('[role=treeitem]')].find(r => r.querySelector('.name').textContent === '{name}')"
        )
    };
    visit.until(&row("side")).await;
    let looks = |name: &str| {
        format!(
            "return [getComputedStyle({0}).height, {0}.offsetWidth, {0}.querySelector('.detail').textContent]",
            row(name)
        )
    };
    assert_eq!(visit.script(&looks("side")).await, visit.script(&looks("other")).await);
    visit.until(&row("long")).await;
    visit.script(&format!("{}.querySelector('[role=switch]').click()", row("long"))).await;
    visit
        .until("document.querySelector('.said').textContent === 'Cannot be satisfied now: long'")
        .await;
}

#[tokio::test]
async fn on_a_phone_the_zoom_covers_nothing_of_a_picture_above_a_sheet() {
    let visit = Visit::open_empty().await;
    visit.client.set_window_size(390, 844).await.expect("a phone's window");
    show(&visit, "four-bar.thing").await;
    let zoom = "document.querySelector('.corner').getClientRects().length";
    visit.until(&format!("{zoom} > 0")).await;
    visit.script("document.querySelector('.handles button').click()").await;
    visit.until("document.querySelector('main').dataset.sheet === 'drawer'").await;
    visit.until(&format!("{zoom} === 0")).await;
    visit.script("document.querySelector('.handles button').click()").await;
    visit.until(&format!("{zoom} > 0")).await;
}

#[tokio::test]
async fn the_card_of_a_lesson_that_begins_with_an_empty_sheet_shows_what_is_to_be_drawn() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    visit.script("location.hash = '#/'").await;
    let card = "[...document.querySelectorAll('.card')].find(c => c.querySelector('h3').textContent.startsWith('A figure of your own'))";
    visit.until(&format!("{card}?.querySelector('canvas')")).await;
}

#[tokio::test]
async fn a_repair_that_reaches_out_of_the_sheet_is_brought_into_sight() {
    let visit = Visit::open_empty().await;
    visit.put(
        "apart.thing",
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\n\
         constraint short: a.length = 100\nconstraint long: a.length = 900\n",
    );
    show(&visit, "apart.thing").await;
    chord(&visit, &[], 'w').await;
    visit.until("document.querySelectorAll('.why .repair').length === 2").await;
    let scale = "window.__thinglab.state().sheet.scale";
    let fitted = state(&visit).await["sheet"]["scale"].clone();
    visit.script("document.querySelector('.why .repair').focus()").await;
    visit.until(&format!("{scale} < {fitted} / 2")).await;
    visit.script("document.querySelector('.why .repair').blur()").await;
    visit.until(&format!("{scale} === {fitted}")).await;
}
