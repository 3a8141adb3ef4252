//! The lab's figures: how long documents take to open, and how a drag runs, in a real browser.
//!
//! In: the command with its page and the browser, named in the environment as for the tests. Out: a table, one row a
//! document, under the goals. `cargo bench-table lab` builds what this needs and runs it. Figures to read, not tests.

use browser::Visit;
use browser::hands::{drag, drag_alone, grip, state};
use serde_json::Value;
use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::time::Duration;

/// What is opened and dragged: documents of the gallery, then larger ones.
const GALLERY: [&str; 4] = ["quadrilateral", "bridge", "warren-truss", "resistor-grid"];

#[tokio::main(flavor = "current_thread")]
async fn main() -> io::Result<()> {
    let out = &mut io::stdout().lock();
    let head = ["opens", "task", "frames/s", "ms/frame", "task", "by hand", "joining"];
    writeln!(out, "{:16}{}", "", head.map(|name| format!("{name:>10}")).concat())?;
    let goals = ["1000 ms", "50 ms", "60", "16", "50 ms", "50 ms", "50 ms"];
    writeln!(out, "{:16}{}", "goal", goals.map(|goal| format!("{goal:>10}")).concat())?;
    let larger = [
        ("points-5000", points(5000) + &chain(70)),
        ("points-20000", points(20_000)),
        ("lines-20000", lines(20_000)),
    ];
    let gallery = GALLERY.map(|name| (name, None));
    let all = gallery.into_iter().chain(larger.into_iter().map(|(name, text)| (name, Some(text))));
    for (name, text) in all {
        writeln!(out, "{name:16}{}", row(name, text.as_deref()).await)?;
        out.flush()?;
    }
    let cold = Visit::open_new("gallery/quadrilateral.thing&bench=drag").await;
    let opened = number(&told(&cold).await["opened_ms"]);
    writeln!(out, "until the first drag, nothing kept: {opened:.0} ms; the goal is 1000")?;
    let size = |from: f64| {
        format!(
            "return performance.getEntriesByType('resource').filter(r => r.startTime < {from:e})
                 .reduce((sum, r) => sum + r.encodedBodySize, 0) / 1e6"
        )
    };
    let first = number(&cold.script(&size(opened)).await);
    cold.until("performance.getEntriesByName(new URL('web_rest.wasm', location).href).length")
        .await;
    let whole = number(&cold.script(&size(f64::MAX)).await);
    writeln!(out, "over the wire until then: {first:.2} MB, whole: {whole:.2} MB; the goal is 1")
}

fn number(told: &Value) -> f64 {
    told.as_f64().unwrap_or(f64::NAN)
}

/// What the page tells of a document that it opens and drags around a circle.
async fn benched(visit: &Visit, document: &str) -> Value {
    let (page, token) = visit.address.split_once("/#").unwrap_or((&visit.address, ""));
    let there = format!("{page}/?document=gallery/{document}&bench=drag#{token}");
    visit.client.goto("about:blank").await.expect("an empty page");
    visit.client.goto(&there).await.expect("the page's address answers");
    told(visit).await
}

async fn told(visit: &Visit) -> Value {
    for _ in 0..600 {
        let told = visit.script("return window.__bench ?? null").await;
        if !told.is_null() {
            return told;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    Value::Null
}

/// The figures of a document: until it can be dragged, in a browser that has the page, and the longest task until
/// then; of a drag around a circle frames a second, work a frame, and the longest task; the longest task of a drag by
/// a hand, with what comes of it; of another that is dropped on the
/// nearest point.
async fn row(name: &str, text: Option<&str>) -> String {
    let visit = Visit::open(None).await;
    visit.rehearse().await;
    let document = format!("{name}.thing");
    if let Some(text) = text {
        visit.put(&document, text);
    }
    let mut row = String::new();
    let mut say = |x: Option<f64>, digits: usize| {
        // a String takes all that is written
        let _ = write!(row, "{:>10.digits$}", x.unwrap_or(f64::NAN));
    };
    let told = benched(&visit, &document).await;
    let opened = told["opened_ms"].as_f64().unwrap_or(f64::MAX);
    say(told["opened_ms"].as_f64(), 0);
    say(longest(&visit, 0.0, opened).await, 0);
    say(told["fps"].as_f64(), 1);
    say(told["frame_ms"].as_f64(), 1);
    say(longest(&visit, opened + 300.0, f64::MAX).await, 0);
    let Some(path) = told["path"].as_str() else { return row };
    for joins in [false, true] {
        let now = state(&visit).await;
        let from = grip(&now, path);
        let begun = visit.script("return performance.now()").await.as_f64().unwrap_or_default();
        match joins {
            false => drag_alone(&visit, from, (from.0 + 12.0, from.1 + 9.0)).await,
            true => drag(&visit, from, beside(&now, from)).await,
        }
        tokio::time::sleep(Duration::from_millis(1500)).await;
        say(longest(&visit, begun, f64::MAX).await, 0);
    }
    row
}

/// Where the nearest of the other points lies that can be dragged.
fn beside(state: &Value, (x, y): (f64, f64)) -> (f64, f64) {
    let grips = state["grips"].as_array().into_iter().flatten();
    let places = grips.filter_map(|grip| Some((grip["px"].as_f64()?, grip["py"].as_f64()?)));
    let far = |(a, b): &(f64, f64)| (a - x) * (a - x) + (b - y) * (b - y);
    let others = places.filter(|place| far(place) > 4.0);
    others.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or((x, y))
}

/// The longest task that began between two times of the page, in milliseconds; browsers name those over 50 ms.
async fn longest(visit: &Visit, from: f64, to: f64) -> Option<f64> {
    let script = format!(
        "const done = arguments[0], seen = [];
         const watch = new PerformanceObserver(list => seen.push(...list.getEntries()));
         watch.observe({{ type: 'longtask', buffered: true }});
         setTimeout(() => done(Math.max(0, ...seen.filter(t => t.startTime >= {from} && t.startTime < {to:e})
             .map(t => t.duration))), 200)"
    );
    visit.client.execute_async(&script, Vec::new()).await.ok()?.as_f64()
}

/// So many points in rows of a hundred.
fn points(count: usize) -> String {
    let place = |i: usize| format!("p{i}: Point = ({}, {})\n", 7 * (i % 100), 7 * (i / 100));
    (0..count).map(place).fold(String::from("use geometry\n"), |text, line| text + &line)
}

/// A chain of so many bars of one length, held at one end.
fn chain(bars: usize) -> String {
    let mut text = format!(
        "class Chained is ConstantLengthLine {{ size = {} }}\nbars: List of {bars} Chained\n",
        136_f64.sqrt()
    );
    let place = |i: usize| (10 * i, if i.is_multiple_of(2) { -40 } else { -46 });
    for i in 0..bars {
        let (x, y) = place(i + 1);
        text += &format!("bars[{i}].p2 = ({x}, {y})\n");
        if i > 0 {
            text += &format!("merge bars[{i}].p1 = bars[{}].p2\n", i - 1);
        }
    }
    text + "bars[0].p1 = (0, -40)\nanchor bars[0].p1\n"
}

/// So many lines that nothing joins, in rows of two hundred.
fn lines(count: usize) -> String {
    let last = count / 200 - 1;
    format!(
        "use geometry\nlines: List of {count} Line\nfor i in 0..{last} {{ for j in 0..199 {{ \
         lines[200*i+j] = Line(Point(7*j, 7*i), Point(7*j+5, 7*i+3)) }} }}\n"
    )
}
