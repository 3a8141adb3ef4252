//! Which functions of the page can come after a first drag: those that none of these visits calls.
//!
//! In: the command with a page that marks what is called, and the browser, named in the environment as for the tests.
//! Out: the functions' keys (`xtask/bindgen/src/split.rs`), in hexadecimal. The command `figures rest` of
//! `xtask` builds what this needs, runs it and keeps what it tells.

use browser::Visit;
use browser::hands::{carry, grip, state};
use serde_json::Value;
use std::collections::BTreeSet;
use std::io::{self, Write as _};
use std::time::Duration;

/// What is opened and dragged, each in a visit of its own.
const DRAGGED: [&str; 6] = [
    "four-bar",
    "lesson-1-first-minute",
    "quadrilateral",
    "bridge",
    "warren-truss",
    "resistor-grid",
];
/// A document of many things in a list, and of places of their own.
const LINES: &str = "use geometry\nlines: List of 4000 Line\nfor i in 0..19 { for j in 0..199 { \
                     lines[200*i+j] = Line(Point(7*j, 7*i), Point(7*j+5, 7*i+3)) } }\n\
                     p: Point = (3, 4)\nq: Point = (5, 6)\n";
/// After which nothing follows of itself.
const SETTLED: Duration = Duration::from_secs(2);
const PER_LINE: usize = 12;

#[tokio::main(flavor = "current_thread")]
async fn main() -> io::Result<()> {
    let mut called = BTreeSet::new();
    // what `lab-figures` measures by
    let bench = Visit::open_new("gallery/quadrilateral.thing&bench=drag").await;
    bench.until("window.__bench").await;
    let all = told(&bench, &mut called).await;
    for name in DRAGGED {
        let visit = Visit::open(Some(&format!("{name}.thing"))).await;
        carry_first(&visit).await;
        told(&visit, &mut called).await;
    }
    let visit = Visit::open(None).await;
    visit.put("lines.thing", LINES);
    let long = visit.address.replace("/#", "/?document=gallery/lines.thing#");
    visit.client.goto("about:blank").await.expect("an empty page");
    visit.client.goto(&long).await.expect("the page's address answers");
    carry_first(&visit).await;
    told(&visit, &mut called).await;
    let visit = Visit::open(None).await;
    let icon = visit.address.replace("/#", "/favicon.svg#");
    // a browser's first visit, then one to a document that was left unsaved
    visit.client.goto(&icon).await.expect("the page's address answers");
    visit.script("localStorage.clear()").await;
    let again = visit.address.replace("/#", "/?document=gallery/lesson-1-first-minute.thing#");
    for address in [&visit.address, &again] {
        visit.client.goto(&icon).await.expect("an empty page");
        visit.client.goto(address).await.expect("the page's address answers");
        carry_first(&visit).await;
        told(&visit, &mut called).await;
        visit.client.release_actions().await.expect("the mouse lets go");
        tokio::time::sleep(SETTLED).await;
    }
    let rest: Vec<_> = all.difference(&called).map(|key| format!("{key:08x}")).collect();
    let out = &mut io::stdout().lock();
    writeln!(
        out,
        "# Functions of the page that a first drag does not run. `cargo run -p xtask -- figures rest` writes this list."
    )?;
    for line in rest.chunks(PER_LINE) {
        writeln!(out, "{}", line.join(" "))?;
    }
    Ok(())
}

/// Takes what can be dragged first into the hand and moves it, once all that follows the opening has been done.
async fn carry_first(visit: &Visit) {
    visit.until("window.__thinglab?.state().grips.length").await;
    tokio::time::sleep(SETTLED).await;
    let state = state(visit).await;
    let path = state["grips"][0]["path"].as_str().unwrap_or_default();
    let (x, y) = grip(&state, path);
    carry(visit, (x, y), (x + 12.0, y + 9.0)).await;
}

/// Adds the keys of what a visit has called; gives those of all functions.
async fn told(visit: &Visit, called: &mut BTreeSet<u64>) -> BTreeSet<u64> {
    let script = "
         const done = arguments[0];
         (async () => {
             const page = await (await import('/web.js')).default();
             const [address, ...keys] = (await (await fetch('/web.functions')).text()).split('\\n');
             const marks = new Uint8Array(page.memory.buffer, Number(address), keys.length);
             const numbers = keys.map((key) => parseInt(key, 16));
             done([numbers, numbers.filter((_, at) => marks[at])]);
         })()";
    let told = visit.client.execute_async(script, Vec::new()).await.expect("the page tells");
    let keys = |of: usize| -> BTreeSet<u64> {
        told[of].as_array().into_iter().flatten().filter_map(Value::as_u64).collect()
    };
    called.extend(keys(1));
    keys(0)
}
