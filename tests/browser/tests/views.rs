//! Views beside picture, structure and text: plots, lessons.

use browser::Visit;
use browser::hands::{begin, chord, drag, grip, key, keys, middle, point, show, state};

/// Types into a field of the page and leaves it.
async fn fill(visit: &Visit, selector: &str, text: &str) {
    let script = format!(
        "const field = document.querySelector('{selector}'); field.focus(); field.value = '{text}'; \
         field.dispatchEvent(new Event('input', {{ bubbles: true }})); \
         field.dispatchEvent(new Event('change', {{ bubbles: true }}));"
    );
    visit.script(&script).await;
}

#[tokio::test]
async fn a_value_is_plotted_over_a_sweep_and_a_point_leaves_its_locus_while_it_is_dragged() {
    let visit = Visit::open_empty().await;
    show(&visit, "voltage-divider.thing").await;
    visit.script("document.getElementById('tab-plot').click()").await;
    visit.until("document.querySelector('.plot-form')").await;
    fill(&visit, ".plot-form .add", "voltmeter.voltage").await;
    fill(&visit, ".plot-form .sweep", "r2.resistance").await;
    visit.until("document.querySelector('.chart canvas')").await;
    let named = "return document.querySelector('.chart canvas').getAttribute('aria-label')";
    assert_eq!(visit.script(named).await, "voltmeter.voltage [V] over r2.resistance [ohm]");
    fill(&visit, ".plot-form .add", "r9.voltage").await;
    visit.until("document.querySelector('.plot p').textContent.includes('r9')").await;

    let before = show(&visit, "four-bar.thing").await;
    let from = grip(&before, "crank.p2");
    fill(&visit, ".plot-form .add", "coupler.p2").await;
    drag(&visit, from, (from.0 - 12.0, from.1 - 30.0)).await;
    visit.until("window.__thinglab.state().plotted.samples > 2").await;
    let plotted = &state(&visit).await["plotted"];
    assert_eq!(plotted["loci"][0], "coupler.p2");
}

#[tokio::test]
async fn a_value_is_played_until_it_is_stopped_and_that_is_one_step_back() {
    let visit = Visit::open_empty().await;
    let before = show(&visit, "four-bar.thing").await;
    let from = grip(&before, "crank.p2");
    let button = "document.querySelector('button.play[aria-label=\"Play turn\"]')";
    visit.until(button).await;
    visit.script(&format!("{button}.click()")).await;
    visit.until("document.querySelector('.status .playing')").await;
    let has_moved = format!(
        "window.__thinglab.state().grips.some(g => g.path === 'crank.p2' && Math.hypot(g.x - {}, g.y - {}) > 3)",
        from.0, from.1
    );
    visit.until(&has_moved).await;
    visit.script("document.querySelector('.status .playing').click()").await;
    visit.until("!document.querySelector('.playing')").await;
    visit.until("window.__thinglab.state().status.undo").await;
    visit.script("document.querySelector('[data-action=undo]').click()").await;
    visit.until("!window.__thinglab.state().status.undo").await;
    assert_eq!(state(&visit).await["text"], before["text"]);
}

/// What is pointed at in the picture stands lower than the card that speaks of it.
const BELOW_THE_CARD: &str = "document.querySelector('.pulse')?.getBoundingClientRect().top > document.querySelector('.lesson').getBoundingClientRect().bottom - 18";

#[tokio::test]
async fn what_a_lesson_points_at_does_not_lie_behind_its_card() {
    let visit = Visit::open_empty().await;
    show(&visit, "lesson-3-midpoint-theorem.thing").await;
    visit.until(BELOW_THE_CARD).await;
}

#[tokio::test]
async fn a_lesson_goes_on_as_its_tasks_are_done() {
    let visit = Visit::open_empty().await;
    show(&visit, "lesson-1-first-minute.thing").await;
    visit.until("document.querySelector('.lesson .place').textContent.includes('1 of 3')").await;
    visit.until(BELOW_THE_CARD).await;
    let from = grip(&state(&visit).await, "q.outer.side2.p2");
    drag(&visit, from, (from.0 - 30.0, from.1 + 20.0)).await;
    visit.until("document.querySelector('.lesson .place').textContent.includes('2 of 3')").await;
    visit.script("document.querySelector('.why-button').click()").await;
    visit.until("document.querySelector('.lesson .place').textContent.includes('3 of 3')").await;
    // by a key, of which the keyboard is in the picture then
    visit.script("document.querySelector('.lesson .primary').focus()").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("document.querySelector('.lesson').textContent.includes('done')").await;
    visit.until("document.activeElement.id === 'picture'").await;
    visit.until("document.querySelector('.lesson .primary')").await;
    visit.script("document.querySelector('.lesson .primary').click()").await;
    visit.until("window.__thinglab.state().path === 'gallery/lesson-2-figure.thing'").await;
}

#[tokio::test]
async fn the_gallery_offers_what_was_shown_last_finds_by_words_and_begins_a_document() {
    let visit = Visit::open_empty().await;
    show(&visit, "bearing.thing").await;
    show(&visit, "koch.thing").await;
    visit.script("location.hash = '#/'").await;
    let recent = "[...document.querySelectorAll('section[aria-label=Recent] .path')].map(p => p.textContent).join()";
    visit.until(&format!("{recent} === 'gallery/koch.thing,gallery/bearing.thing'")).await;
    // words of a card's sentence, which is read by and by
    visit.script("document.querySelector('.begin input').focus()").await;
    keys(&visit, "attacks NONE").await;
    let found = "[...document.querySelectorAll('.card')].filter(c => c.checkVisibility()).map(c => c.querySelector('h3').textContent).join()";
    visit.until(&format!("{found} === 'Eight queens'")).await;
    keys(&visit, " zebra").await;
    visit.until(&format!("{found} === ''")).await;
    visit.until("document.querySelector('.gallery [role=status]').textContent.startsWith('No document')").await;
    visit.script("document.querySelector('.begin .primary').click()").await;
    visit.until("window.__thinglab.state().path === 'untitled.thing'").await;
    // what is drawn there and not saved is seen on the first shelf, also by the next visit
    chord(&visit, &[], 'r').await;
    drag(&visit, (600.0, 300.0), (800.0, 400.0)).await;
    visit.until("window.__thinglab.state().text.includes('rectangle')").await;
    visit.script("location.hash = '#/'").await;
    let drawn = "[...document.querySelectorAll('section[aria-label=Recent] li')].some(li => li.textContent.includes('untitled') && li.textContent.includes('not saved yet') && li.querySelector('canvas'))";
    visit.until(drawn).await;
    visit.leave_and_return().await;
    visit.until("window.__thinglab?.state().path === 'empty.thing'").await;
    visit.script("location.hash = '#/'").await;
    visit.until(drawn).await;
}

#[tokio::test]
async fn a_part_of_a_library_that_is_not_used_yet_is_found_and_placed() {
    let visit = begin().await;
    visit.script("document.getElementById('tab-bin').click()").await;
    visit.script("document.querySelector('.bin input').focus()").await;
    keys(&visit, "resistor").await;
    visit.until("document.querySelector('.tile[data-class=Resistor]')").await;
    let tile = middle(&visit, ".tile[data-class=Resistor]").await;
    // its first end lies where it is dropped, the other where one clicks
    drag(&visit, tile, (620.0, 400.0)).await;
    visit.until("window.__thinglab.state().text.includes('use circuits\\n')").await;
    point(&visit, (760.0, 400.0), 0).await;
    visit.until("/: Resistor/.test(window.__thinglab.state().text)").await;
}

#[tokio::test]
async fn no_page_is_wider_than_its_window() {
    let visit = Visit::open_empty().await;
    // a page at 200 % is one of half the width
    let sizes =
        [("wide", 1440, 900), ("tablet", 820, 1000), ("phone", 390, 844), ("large", 720, 450)];
    show(&visit, "rings.thing").await;
    visit.reference_picture("rings").await;
    for document in ["quadrilateral.thing", "voltage-divider.thing", "warren-truss.thing"] {
        show(&visit, document).await;
        for (n, (size, width, height)) in sizes.into_iter().enumerate() {
            visit.client.set_window_size(width, height).await.expect("such a window");
            let theme = if n % 2 == 0 { "light" } else { "dark" };
            for _ in 0..3 {
                let now = visit.script("return document.documentElement.dataset.theme").await;
                if now != theme {
                    visit.script("document.querySelector('[data-action=theme]').click()").await;
                }
            }
            visit.until(&format!("document.documentElement.dataset.theme === '{theme}'")).await;
            let fits = "document.documentElement.scrollWidth <= window.innerWidth";
            visit.until(fits).await;
            let over = "const r = document.getElementById('picture').getBoundingClientRect(); \
                        return r.right <= window.innerWidth + 1 && r.width > 200 && r.height > 100";
            assert_eq!(visit.script(over).await, true, "{document} at {width} pixels");
            let name = document.trim_end_matches(".thing");
            visit.reference_picture(&format!("{name}-{size}")).await;
        }
    }
    // a key leads into the inspector, which is folded away in a page this large
    visit.until("!document.querySelector('.inspector').getClientRects().length").await;
    chord(&visit, &[key::ALT], '5').await;
    visit.until("document.activeElement.closest('.inspector')").await;
    // in a low window, with the reasons open, the tools stand beside each other over the picture
    visit.client.set_window_size(1440, 600).await.expect("a low window");
    visit.script("document.querySelector('.why-button').click()").await;
    visit.until("document.querySelector('.centre .why')").await;
    let beside = "(tools => tools.length > 9 && tools.every(tool => { \
                   const r = tool.getBoundingClientRect(), p = tool.closest('.stage').getBoundingClientRect(); \
                   return r.bottom <= p.bottom && tool.contains( \
                   document.elementFromPoint(r.left + r.width / 2, r.top + r.height / 2)); \
                   }))([...document.querySelectorAll('.rail .tool')])";
    visit.until(beside).await;
}

#[tokio::test]
async fn what_is_printed_is_lines_as_large_as_they_are() {
    let visit = begin().await;
    visit.put(
        "plate.thing",
        "/// A plate: with a hole.\nuse geometry\nunit mm\nplate: Rectangle { width = 80  height = 50 }\n",
    );
    show(&visit, "plate.thing").await;
    let printed = "(p => [p.querySelector('h1').textContent, \
                   p.querySelector('svg')?.getAttribute('width') ?? ''])(document.querySelector('.printed'))";
    visit.script("dispatchEvent(new Event('beforeprint'))").await;
    let now = visit.script(&format!("return {printed}")).await;
    assert_eq!(now[0], "A plate (1 : 1)");
    // 80 mm of 96 / 25.4 pixels each, and a margin of 16 on both sides
    let width: f64 = now[1].as_str().and_then(|w| w.parse().ok()).expect("a width");
    assert!((width - (80.0 * 96.0 / 25.4 + 32.0)).abs() < 1.0, "{width}");
    visit.script("dispatchEvent(new Event('afterprint'))").await;
    assert_eq!(visit.script(&format!("return {printed}")).await, serde_json::json!(["", ""]));
}
