//! Ordinary jobs with the page: a meter typed, a conflict made, explained and repaired, a link handed on, and the
//! first minute.

use browser::Visit;
use browser::hands::{chord, drag, grip, key, keys, point, show, state, text_of, use_library};
use fantoccini::actions::MOUSE_BUTTON_LEFT;

#[tokio::test]
async fn a_conflict_is_explained_and_repaired_by_a_button() {
    let visit = Visit::open_empty().await;
    visit.put("clash.thing", "a: Real = 3\nconstraint one: a = 3\nconstraint two: a = 4\n");
    show(&visit, "clash.thing").await;
    assert_eq!(state(&visit).await["status"]["satisfied"], false);
    visit.script("document.querySelector('.verdict').click()").await;
    visit.until("document.querySelectorAll('.why .repair').length >= 2").await;
    visit.script("document.querySelector('.why .repair').click()").await;
    visit.until("window.__thinglab.state().status.satisfied").await;
    visit.script("document.querySelector('[data-action=undo]').click()").await;
    visit.until("!window.__thinglab.state().status.satisfied").await;

    // what takes long goes on beside the page: a point is dragged meanwhile, and Escape ends it
    visit.put("lattice.thing", &lattice(30));
    let before = show(&visit, "lattice.thing").await;
    visit.until("document.querySelector('.status .busy')").await;
    let from = grip(&before, "apart");
    drag(&visit, from, (from.0 + 30.0, from.1 + 10.0)).await;
    visit.until("window.__thinglab.state().status.undo === 'move apart'").await;
    visit.until("document.querySelector('.status .busy')").await;
    visit.script("document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }))").await;
    visit.until("!document.querySelector('.status .busy')").await;
    visit
        .until("document.querySelector('#why').innerText.includes('not looked up to the end')")
        .await;
}

#[tokio::test]
async fn what_many_values_hang_together_with_is_computed_beside_the_page() {
    let visit = Visit::open_empty().await;
    show(&visit, "bridge.thing").await;
    let opened = text_of(&state(&visit).await);
    let tip = grip(&state(&visit).await, "bridge.load.tip");
    point(&visit, tip, MOUSE_BUTTON_LEFT).await;
    // the page has not waited: its text is as it was
    assert_eq!(type_size(&visit, "6 N").await, opened.as_str());
    visit.until("window.__thinglab.state().text.includes('load.size = 6 N')").await;
    let bent = "window.__thinglab.state().values.some(v => v.path === 'bridge.load.size' && v.number === 6)";
    visit.until(bent).await;
    // undone while it goes on, it is not done
    let six = text_of(&state(&visit).await);
    type_size(&visit, "7 N").await;
    visit.script("document.querySelector('[data-action=undo]').click()").await;
    assert_eq!(text_of(&state(&visit).await), six);
    // it is a step of its own, and a hand goes on from there
    type_size(&visit, "8 N").await;
    visit.until("window.__thinglab.state().text.includes('load.size = 8 N')").await;
    let from = grip(&state(&visit).await, "bridge.load.tip");
    drag(&visit, from, (from.0, from.1 + 12.0)).await;
    visit.until("window.__thinglab.state().status.undo?.startsWith('move bridge.load')").await;
    visit.script("document.querySelector('[data-action=undo]').click()").await;
    visit.until("window.__thinglab.state().text.includes('load.size = 8 N')").await;
    // what cannot be is refused beside the field
    type_size(&visit, "-4 W").await;
    visit.until("document.querySelector('.inspector .error')").await;
}

/// Types the size of the bridge's load beside it; the text of the document right after that.
async fn type_size(visit: &Visit, size: &str) -> serde_json::Value {
    let row = "document.querySelector('[data-path=\"bridge.load.size\"]')";
    let field = "document.querySelector('.inspector input.field[aria-label=\"bridge.load.size\"]')";
    visit.until(row).await;
    visit.script(&format!("{row}.click()")).await;
    visit.until(field).await;
    let script = format!(
        "const field = {field}; field.focus(); field.value = '{size}';
         field.dispatchEvent(new Event('input'));
         field.dispatchEvent(new KeyboardEvent('keydown', {{ key: 'Enter', bubbles: true }}));
         return window.__thinglab.state().text"
    );
    visit.script(&script).await
}

/// A lattice of so many points a side, of which one diagonal is wanted longer than it can be, and a point apart.
fn lattice(side: usize) -> String {
    let mut text = String::from("use geometry\napart: Point = (-30, -30)\n");
    for (i, j) in (0..side * side).map(|at| (at / side, at % side)) {
        text += &format!("p{i}_{j}: Point = ({}, {})\n", 10 * i, 10 * j);
        if i > 0 {
            text += &format!("constraint p{i}_{j}.x - p{}_{j}.x = 10\n", i - 1);
        }
        if j > 0 {
            text += &format!("constraint p{i}_{j}.y - p{i}_{}.y = 10\n", j - 1);
        }
        if i > 0 && j > 0 {
            let (a, b) = (format!("p{i}_{j}"), format!("p{}_{}", i - 1, j - 1));
            let square = if (i, j) == (2, 2) { 207 } else { 200 };
            text += &format!("constraint ({a}.x - {b}.x)^2 + ({a}.y - {b}.y)^2 = {square}\n");
        }
    }
    text
}

#[tokio::test]
async fn the_inspector_shows_switches_and_sliders_of_the_document() {
    let visit = Visit::open_empty().await;
    visit.put("sum.thing", "a: Real = 3\nb: Real = 4\nc: Real\nconstraint sum: c = a + b\n");
    show(&visit, "sum.thing").await;
    visit.until("document.querySelectorAll('.inspector .slider').length === 2").await;
    visit.script("document.querySelector('.inspector .switch').click()").await;
    visit.until("window.__thinglab.state().text.includes('enabled')").await;
    visit.script("document.querySelector('.inspector .switch').click()").await;
    visit.until("!window.__thinglab.state().text.includes('enabled')").await;
    let slide = "const s = document.querySelector('.inspector .slider'); s.value = '5';
        s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change'))";
    visit.script(slide).await;
    visit.until("window.__thinglab.state().values.some(v => v.path === 'c' && v.number > 8)").await;
}

#[tokio::test]
async fn a_link_carries_a_whole_document() {
    let visit = Visit::open_empty().await;
    visit.put("sum.thing", "a: Real = 3\nb: Real = 4\n");
    show(&visit, "sum.thing").await;
    let packed = visit
        .client
        .execute_async(
            "const done = arguments[0];
             import('./page.js').then(p => p.pack('sent.thing\\na: Real = 7\\n')).then(done)",
            Vec::new(),
        )
        .await
        .expect("it is packed");
    let packed = packed.as_str().expect("letters").to_string();
    visit.script(&format!("location.hash = '#share={packed}'")).await;
    visit.until("window.__thinglab.state().path === 'sent.thing'").await;
    assert_eq!(state(&visit).await["text"], "a: Real = 7\n");
}

#[tokio::test]
async fn a_program_of_the_document_beside_is_used_from_the_bin_and_followed() {
    let visit = Visit::open_empty().await;
    let program = "use geometry
program Flange(outer: Length = 30) {
    rim = Circle(center: Point(0, 0), radius: outer)
}
";
    visit.put("flange.thing", program);
    visit.put("plate.thing", "use geometry\nx: Real = 1\n");
    show(&visit, "plate.thing").await;
    use_library(&visit, "flange").await;
    visit.until("document.querySelector('[data-class=Flange]')").await;
    let press = "new KeyboardEvent('keydown', { key: 'Enter', bubbles: true })";
    visit
        .script(&format!("document.querySelector('[data-class=Flange]').dispatchEvent({press})"))
        .await;
    visit.until("window.__thinglab.state().text.includes('Placed of Flange')").await;
    // what is typed there counts here, saved or not
    show(&visit, "flange.thing").await;
    chord(&visit, &[key::ALT], '4').await;
    visit.until("document.activeElement.classList.contains('cm-content')").await;
    chord(&visit, &[key::CONTROL], key::END).await;
    keys(&visit, "class Extra { a: Real }").await;
    visit.until("document.querySelector('[data-class=Extra]')").await;
    show(&visit, "plate.thing").await;
    visit.until("document.querySelector('[data-class=Flange]')").await;
    visit.until("document.querySelector('[data-class=Extra]')").await;
    let text = text_of(&state(&visit).await);
    assert!(text.contains("use flange") && !text.contains("Extra"), "{text}");
}

#[tokio::test]
async fn the_first_minute_opens_by_itself_and_comes_once() {
    let visit = Visit::open(None).await;
    visit.until("document.querySelector('.card')").await;
    visit.script("localStorage.clear()").await;
    visit.client.goto("about:blank").await.expect("elsewhere");
    visit.client.goto(&visit.address).await.expect("the page's address answers");
    visit.until("document.querySelector('.pulse') && document.querySelector('.coach')").await;
    // by keys it comes before the panels and the picture
    let first = "return document.querySelector('main button').closest('.coach') !== null";
    assert_eq!(visit.script(first).await, true);
    visit.script("document.querySelector('.coach .bare').click()").await;
    visit.until("!document.querySelector('.coach')").await;
    visit.client.goto("about:blank").await.expect("elsewhere");
    visit.client.goto(&visit.address).await.expect("the page's address answers");
    visit.until("document.querySelector('.card')").await;
    let offered = visit.script("return document.querySelectorAll('.first').length").await;
    assert_eq!(offered, 0);
}
