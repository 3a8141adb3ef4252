//! The page and its server together, whatever the page shows.

use browser::Visit;

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
    let visit = Visit::open(None).await;
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
async fn the_page_comes_compressed() {
    let visit = Visit::open(None).await;
    visit.until("document.querySelector('main')").await;
    let sizes = visit
        .script(
            "const all = performance.getEntriesByType('resource').filter(r => r.name.endsWith('.wasm'));
             return [all.length, all[0].encodedBodySize, all[0].decodedBodySize]",
        )
        .await;
    let size = |n: usize| sizes[n].as_f64().expect("a number");
    assert_eq!(size(0), 1.0);
    assert!(2.0 * size(1) < size(2), "{sizes}");
}
