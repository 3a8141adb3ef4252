//! The page and its server together, whatever the page shows.

use browser::Visit;
use browser::hands::key::CONTROL;
use browser::hands::{chord, drag, grip, show, state, text_of};
use fantoccini::Locator;
use serde_json::json;
use std::time::Duration;

#[tokio::test]
async fn the_page_starts_and_keeps_its_token_to_itself() {
    let visit = Visit::open(None).await;
    visit.until("document.querySelector('main')").await;
    assert_eq!(visit.client.title().await.unwrap(), "ThingLab");
    let address = visit.client.current_url().await.unwrap();
    assert_eq!(address.fragment().unwrap_or_default(), "", "the token is still in the address");
    let notices =
        visit.script("return document.querySelectorAll('.notice[role=alert]').length").await;
    assert_eq!(notices, 0, "the page says that it could not start");
}

#[tokio::test]
async fn a_page_that_names_a_document_asks_once_for_what_it_needs_and_draws_no_gallery_first() {
    let visit = Visit::open(Some("quadrilateral.thing")).await;
    visit.until("document.querySelector('main.document')").await;
    let script =
        "return performance.getEntriesByType('resource').map(r => r.name.split('/api/')[1])
         .filter(name => name && !name.startsWith('draft')).sort()";
    let asked = visit.script(script).await;
    let wanted = serde_json::json!(["document?path=gallery%2Fquadrilateral.thing", "library"]);
    assert_eq!(asked, wanted);
}

#[tokio::test]
async fn the_page_runs_under_its_security_policy() {
    let visit = Visit::open(Some("quadrilateral.thing")).await;
    visit.until("document.getElementById('tab-text')").await;
    visit.script("document.getElementById('tab-text').click()").await;
    visit.until("document.querySelector('.cm-content')").await;
    // Inline scripts are refused, the page's own module and WebAssembly run.
    let ran = visit
        .script(
            "const script = document.createElement('script');
             script.textContent = 'window.ranInline = true';
             document.head.append(script);
             return Boolean(window.ranInline)",
        )
        .await;
    assert_eq!(ran, false);
    let styled =
        visit.script("return getComputedStyle(document.querySelector('.cm-editor')).display").await;
    assert_eq!(styled, "flex", "the editor's own style sheet was refused");
}

#[tokio::test]
async fn the_documents_are_not_given_without_the_token() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    let status = visit
        .client
        .execute_async(
            "const done = arguments[0];
             fetch('/api/documents').then((answer) => done(answer.status), () => done(0))",
            Vec::new(),
        )
        .await
        .unwrap();
    assert_eq!(status, 401);
}

#[tokio::test]
async fn the_page_comes_compressed_and_in_two_parts_each_once() {
    let visit = Visit::open(Some("quadrilateral.thing")).await;
    let of = "performance.getEntriesByType('resource').filter(r => r.name.endsWith('.wasm'))";
    visit.until(&format!("window.__thinglab?.state().grips.length && {of}.length > 1")).await;
    let parts = visit
        .script(&format!(
            "return {of}.map(r => [r.name.split('/').at(-1), 2 * r.encodedBodySize < r.decodedBodySize])"
        ))
        .await;
    assert_eq!(parts, json!([["web_bg.wasm", true], ["web_rest.wasm", true]]));
}

#[tokio::test]
async fn a_document_that_needs_both_parts_does_not_wait_for_the_second_when_it_was_there_before() {
    let visit = Visit::open(Some("resistor-grid.thing")).await;
    visit.until("localStorage.getItem('thinglab/rest')").await;
    visit.client.refresh().await.expect("the page's address answers");
    visit.until("window.__thinglab?.state().grips.length").await;
    let ways = "return performance.getEntriesByType('resource')
        .filter(r => r.name.endsWith('rest.wasm')).map(r => r.initiatorType)";
    assert_eq!(visit.script(ways).await, json!(["fetch"]));
}

/// The same numbers in every run, that look as if they were drawn.
fn drawn(seed: &mut u64) -> u64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *seed >> 33
}

#[tokio::test]
async fn what_was_seen_outlives_a_killed_server_and_a_closed_page() {
    const END: char = '\u{e010}';
    let mut visit = Visit::open_empty().await;
    let mut seed = 1979;
    let mut seen = text_of(&show(&visit, "quadrilateral.thing").await);
    for round in 0..2 {
        if round % 2 == 0 {
            visit.script("document.getElementById('tab-text').ariaSelected !== 'true' && document.getElementById('tab-text').click()").await;
            visit.until("document.querySelector('.cm-content')").await;
            let editor = visit.client.find(Locator::Css(".cm-content")).await.expect("the editor");
            editor.click().await.expect("a click");
            chord(&visit, &[CONTROL], END).await;
            let line = format!("seen{round}: Real = {}\n", drawn(&mut seed) % 1000);
            editor.send_keys(&line).await.expect("typing");
            seen += &line;
        } else {
            let from = grip(&state(&visit).await, "q.outer.side1.p1");
            let by = [drawn(&mut seed), drawn(&mut seed)].map(|n| (n % 60) as f64 - 30.0);
            drag(&visit, from, (from.0 + by[0], from.1 + by[1])).await;
            seen = text_of(&state(&visit).await);
        }
        tokio::time::sleep(Duration::from_millis(drawn(&mut seed) % 200)).await;
        if round == 0 || drawn(&mut seed).is_multiple_of(2) {
            visit.kill_server();
        }
        visit.leave_and_return().await;
        show(&visit, "quadrilateral.thing").await;
        visit.until("document.querySelector('.notice .primary')").await;
        visit.script("document.querySelector('.notice .primary').click()").await;
        assert_eq!(text_of(&state(&visit).await), seen, "round {round}");
    }
    visit.kill_server();
    // a page that was there before goes on with the new server, once another has come with its address
    let old = visit.client.window().await.expect("a window");
    let new = visit.client.new_window(true).await.expect("another tab");
    visit.client.switch_to_window(new.handle).await.expect("it is there");
    visit.client.goto(&visit.address).await.expect("the page's address answers");
    // what the tab that lives has not saved is its own: it is not offered here, and an edit here does not touch it
    let other = show(&visit, "quadrilateral.thing").await;
    let from = grip(&other, "q.outer.side1.p1");
    drag(&visit, from, (from.0 + 9.0, from.1 + 5.0)).await;
    visit.until("window.__thinglab.state().dirty").await;
    let offered = "return document.querySelector('.notice .primary') !== null";
    assert_eq!(visit.script(offered).await, false);
    visit.client.close_window().await.expect("the tab closes");
    visit.client.switch_to_window(old).await.expect("it is still there");
    chord(&visit, &[CONTROL], 's').await;
    visit.until("!window.__thinglab.state().dirty").await;
    assert_eq!(visit.saved("quadrilateral.thing"), seen);
}

#[tokio::test]
async fn what_the_server_was_told_outlives_a_browser_that_forgets() {
    let visit = Visit::open_empty().await;
    let from = grip(&show(&visit, "quadrilateral.thing").await, "q.outer.side1.p1");
    let told = "window.kept = 0; new PerformanceObserver(all => all.getEntries().forEach(e => {
        window.kept += e.name.endsWith('/api/draft') ? 1 : 0 })).observe({ type: 'resource' })";
    visit.script(told).await;
    drag(&visit, from, (from.0 + 20.0, from.1 + 10.0)).await;
    visit.until("window.kept > 0").await;
    let seen = text_of(&state(&visit).await);
    // as a browser that is killed before it has written anything down
    let forget = "Object.keys(localStorage).filter(k => k.startsWith('thinglab/draft/'))
        .forEach(k => localStorage.removeItem(k))";
    visit.script(forget).await;
    visit.leave_and_return().await;
    show(&visit, "quadrilateral.thing").await;
    visit.until("document.querySelector('.notice .primary')").await;
    visit.script("document.querySelector('.notice .primary').click()").await;
    assert_eq!(text_of(&state(&visit).await), seen);
}
