//! What a person does in the lab: opens a document, drags, types, undoes, saves; and that the page
//! computes the bits that the same session computes natively.

use browser::Visit;
use browser::hands::{carry, chord, drag, grip, show, state};
use serde_json::Value;
use session::{Host, Session, parse_path};
use std::path::{Path, PathBuf};
use std::time::Duration;

fn value<'s>(state: &'s Value, path: &str) -> &'s str {
    let rows = state["values"].as_array().expect("values are a list");
    let row = rows.iter().find(|r| r["path"] == path);
    row.and_then(|r| r["text"].as_str()).unwrap_or_else(|| panic!("no value {path}"))
}

const CONTROL: char = '\u{e009}';
const SHIFT: char = '\u{e008}';
const DELETE: char = '\u{e017}';
const ENTER: char = '\u{e007}';
const TAB: char = '\u{e004}';
const END: char = '\u{e010}';
const RIGHT: char = '\u{e014}';

#[tokio::test]
async fn what_hands_do_first_is_rehearsed_by_a_worker() {
    let visit = Visit::open(Some("quadrilateral.thing")).await;
    let worker =
        "performance.getEntriesByType('resource').some(r => r.name.endsWith('/worker.js'))";
    visit.rehearse().await;
    visit.until(worker).await;
}

#[tokio::test]
async fn a_corner_is_dragged_and_taken_back() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    let before = show(&visit, "quadrilateral.thing").await;
    assert_eq!(value(&before, "q.outer.side1.p1.x"), "174");
    assert_eq!(before["status"]["satisfied"], true);
    assert_eq!(before["status"]["freedom"], 8);

    let (x, y) = grip(&before, "q.outer.side2.p2");
    drag(&visit, (x, y), (x + 40.0, y - 30.0)).await;
    visit
        .until(
            "window.__thinglab.state().status.undo != null && !window.__thinglab.state().dragging",
        )
        .await;
    let after = state(&visit).await;
    let number = |s: &Value, path: &str| value(s, path).parse::<f64>().expect("a number");
    let moved = number(&after, "q.outer.side2.p2.x") - 445.0;
    assert!(moved > 1.0, "the corner went to the right: {moved}");
    let midpoint = number(&after, "q.inner.side1.p2.x");
    assert!((midpoint - (387.0 + moved / 2.0)).abs() < 1e-9, "the midpoint went half as far");
    for still in ["q.outer.side1.p1.x", "q.outer.side1.p2.x", "q.inner.side1.p1.x"] {
        assert_eq!(value(&before, still), value(&after, still), "{still} stays");
    }
    let text = after["text"].as_str().expect("a text");
    assert!(text.contains("outer.side2.p2 = ("), "the corner is written: {text}");

    // taken back while it is still in the hand, it is this drag that is
    let (x, y) = grip(&after, "q.outer.side1.p1");
    carry(&visit, (x, y), (x + 30.0, y + 20.0)).await;
    visit.until("window.__thinglab.state().dragging").await;
    chord(&visit, &[CONTROL], 'z').await;
    visit.until("!window.__thinglab.state().dragging").await;
    visit.client.release_actions().await.expect("the button is let go");
    let held = state(&visit).await;
    assert_eq!(held["text"], after["text"]);
    assert_eq!(held["values"], after["values"]);

    chord(&visit, &[CONTROL], 'z').await;
    visit.until("window.__thinglab.state().status.redo != null").await;
    let undone = state(&visit).await;
    assert_eq!(undone["text"], before["text"]);
    assert_eq!(undone["values"], before["values"]);
}

#[tokio::test]
async fn the_picture_is_painted_where_the_view_says() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    let state = show(&visit, "voltage-divider.thing").await;
    for path in ["r1.b.node.at", "meter.a.node.at"] {
        let grips = state["grips"].as_array().expect("grips are a list");
        let same = |p: &Value| p["path"].as_str().is_some_and(|q| q == path);
        let Some(grip) = grips.iter().find(|g| same(g)) else { continue };
        let probe = format!(
            "const canvas = document.getElementById('picture');
             const box = canvas.getBoundingClientRect();
             const k = canvas.width / box.width;
             const at = (x, y) => Array.from(canvas.getContext('2d')
                 .getImageData(Math.round((x - box.left) * k), Math.round((y - box.top) * k), 1, 1).data);
             return [at({x}, {y}), at({x} + 25, {y} + 37)]",
            x = grip["px"],
            y = grip["py"],
        );
        visit.until("document.getElementById('picture').width > 10").await;
        tokio::time::sleep(Duration::from_millis(300)).await;
        let colors = visit.script(&probe).await;
        assert_ne!(colors[0], colors[1], "a point is painted at {path}");
    }
}

#[tokio::test]
async fn the_text_is_edited_and_a_wrong_line_keeps_what_was() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    let before = show(&visit, "temperature.thing").await;
    assert_eq!(value(&before, "fahrenheit.node.number"), "162.5");
    visit.script("document.getElementById('tab-text').click()").await;
    visit.until("document.querySelector('.cm-content')").await;
    let content = fantoccini::Locator::Css(".cm-content");
    visit.client.find(content).await.expect("the editor").click().await.expect("a click");
    chord(&visit, &[CONTROL], END).await;
    let editor = visit.client.find(content).await.expect("the editor");
    editor.send_keys("extra: Real = 7\n").await.expect("typing");
    visit
        .until("window.__thinglab.state().values.some(v => v.path === 'extra' && v.text === '7')")
        .await;
    editor.send_keys("broken: Real = \n").await.expect("typing");
    visit.until("window.__thinglab.state().diagnostics.length > 0").await;
    visit.until("document.querySelector('.cm-lintRange-error, .cm-lintPoint-error')").await;
    let wrong = state(&visit).await;
    assert_eq!(value(&wrong, "fahrenheit.node.number"), "162.5");
    assert_eq!(value(&wrong, "extra"), "7");
    assert!(wrong["text"].as_str().is_some_and(|t| t.contains("broken: Real =")));
}

#[tokio::test]
async fn a_save_changes_only_what_was_changed() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    let before = visit.saved("square-root.thing");
    let opened = show(&visit, "square-root.thing").await;
    let (x, y) = grip(&opened, "times.result.at");
    drag(&visit, (x, y), (x - 30.0, y + 10.0)).await;
    visit.until("window.__thinglab.state().dirty").await;
    chord(&visit, &[CONTROL], 's').await;
    visit.until("!window.__thinglab.state().dirty").await;
    let after = visit.saved("square-root.thing");
    let lines: Vec<(&str, &str)> =
        before.lines().zip(after.lines()).filter(|(a, b)| a != b).collect();
    assert_eq!(before.lines().count(), after.lines().count());
    assert_eq!(lines.len(), 1, "one line differs: {lines:?}");
    assert!(lines[0].0.contains("result.at = (382, 159)"), "{lines:?}");
}

/// Two of a class, and two lines that meet.
pub(crate) const FRAME: &str = "use geometry
class Elbow {
    one, two: Line
    merge one.p2 = two.p1
    constraint level: one.p1.y = one.p2.y
}
first: Elbow { one.p1 = (0, 0)  one.p2 = (40, 0)  two.p2 = (40, 30) }
second: Elbow { one.p1 = (0, 50)  one.p2 = (40, 50)  two.p2 = (40, 80) }
k: Line { p1 = (60, 0)  p2 = (90, 0) }
l: Line { p1 = (90, 0)  p2 = (90, 30) }
";

/// Clicks the first row of the structure whose name that is, with Ctrl where it is chosen besides.
async fn choose(visit: &Visit, name: &str, besides: bool) {
    let row = format!(
        "[...document.querySelectorAll('[role=treeitem]')]
             .find(row => row.querySelector('.name').textContent === '{name}')"
    );
    visit.until(&row).await;
    let click = format!("new MouseEvent('click', {{ bubbles: true, ctrlKey: {besides} }})");
    visit.script(&format!("{row}.dispatchEvent({click})")).await;
    visit.until("document.activeElement.getAttribute('role') === 'treeitem'").await;
}

#[tokio::test]
async fn an_edit_of_one_thing_asks_whether_all_of_its_class_are_meant() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    visit.put("frame.thing", FRAME);
    let before = show(&visit, "frame.thing").await;
    assert_eq!(before["status"]["freedom"], 18);
    choose(&visit, "level", false).await;
    chord(&visit, &[], DELETE).await;
    visit.until("document.activeElement.closest('.asked')").await;
    let asked = state(&visit).await;
    let question = "delete first.level: for first alone, or for every Elbow (2 here)?";
    assert_eq!(asked["notice"], question);
    assert_eq!(asked["text"], before["text"], "nothing is done before it is decided");

    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().status.undo != null").await;
    let only = state(&visit).await;
    assert_eq!(only["status"]["freedom"], 19);
    assert!(only["text"].as_str().is_some_and(|t| t.contains("constraint level")));
    chord(&visit, &[CONTROL], 'z').await;
    visit.until("window.__thinglab.state().status.undo == null").await;

    // the key may come before the frame in which the row that was clicked gets the keyboard
    let at_once = "const row = [...document.querySelectorAll('[role=treeitem]')]
            .find(row => row.querySelector('.name').textContent === 'level');
        document.activeElement.blur();
        row.click();
        row.dispatchEvent(new KeyboardEvent('keydown', { key: 'Delete', bubbles: true }));
        return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))";
    visit.script(at_once).await;
    visit.until("document.activeElement.closest('.asked')").await;
    chord(&visit, &[], TAB).await;
    chord(&visit, &[], ENTER).await;
    visit.until("window.__thinglab.state().status.undo != null").await;
    let every = state(&visit).await;
    assert_eq!(every["status"]["freedom"], 20);
    assert!(every["text"].as_str().is_some_and(|t| !t.contains("constraint level")));
}

#[tokio::test]
async fn things_that_are_selected_together_are_recognised_and_made_one() {
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    visit.put("frame.thing", FRAME);
    show(&visit, "frame.thing").await;
    choose(&visit, "l", false).await;
    choose(&visit, "k", true).await;
    let chosen = state(&visit).await;
    assert_eq!((&chosen["selected"], &chosen["also"]), (&"l".into(), &serde_json::json!(["k"])));
    chord(&visit, &[SHIFT], 'R').await;
    visit.until("document.querySelector('.recognised')").await;
    let found = state(&visit).await;
    assert!(found["notice"].as_str().is_some_and(|n| n.contains("Elbow")), "{}", found["notice"]);
    let elbow = "[...document.querySelectorAll('.recognised li')]
        .find(row => row.textContent.startsWith('Elbow')).querySelector('button').click()";
    visit.script(elbow).await;
    visit.until("window.__thinglab.state().status.undo != null").await;
    let made = state(&visit).await;
    // two lines that meet and one of which is level: 8 coordinates less 3
    assert_eq!(made["status"]["freedom"], 15);
    let text = made["text"].as_str().expect("a text");
    assert!(text.contains("elbow: Elbow"), "{text}");
    assert!(text.contains("merge k = elbow.one") && text.contains("merge l = elbow.two"), "{text}");

    chord(&visit, &[], 'w').await;
    visit.until("document.querySelector('.motion')").await;
    visit.script("window.before = document.getElementById('picture').toDataURL()").await;
    visit.script("document.querySelector('.motion').focus()").await;
    // the way to move is painted
    visit.until("document.getElementById('picture').toDataURL() !== window.before").await;
    visit.script("document.querySelector('.motion').blur()").await;
    visit.until("document.getElementById('picture').toDataURL() === window.before").await;
}

struct Library(PathBuf);

impl Host for Library {
    fn read(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.0.join("library").join(name).with_extension("thing")).ok()
    }
}

/// Every number that the values view shows, by its bits.
fn bits_of_page(state: &Value) -> Vec<(String, u64)> {
    let rows = state["values"].as_array().expect("values are a list");
    let bits = |r: &Value| Some((r["path"].as_str()?.to_string(), r["number"].as_f64()?.to_bits()));
    rows.iter().filter_map(bits).collect()
}

fn bits_of_session(session: &Session, id: session::DocumentId) -> Vec<(String, u64)> {
    let rows = session.values(id).into_iter();
    rows.filter_map(|r| Some((r.path, r.number?.to_bits()))).collect()
}

#[tokio::test]
async fn the_page_and_the_native_session_give_the_same_bits() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut names: Vec<String> = std::fs::read_dir(top.join("gallery"))
        .expect("there is a gallery")
        .map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".thing"))
        .collect();
    names.sort();
    assert!(names.len() >= 9);
    let visit = Visit::open_empty().await;
    visit.until("document.querySelector('main')").await;
    for name in names {
        let text = std::fs::read_to_string(top.join("gallery").join(&name)).expect("a document");
        let mut native = Session::new(Box::new(Library(top.clone())));
        let id = native.open(&name, &text);
        let opened = show(&visit, &name).await;
        // a lesson would lie over the picture
        visit.script("document.querySelector('.coach .bare')?.click()").await;
        assert_eq!(bits_of_page(&opened), bits_of_session(&native, id), "{name} as it opens");

        // Three steps to the right with the arrow key, of the first point that there is.
        let grips = native.picture(id).grips;
        let Some(grip) = grips.iter().find(|g| !g.anchored && !g.drawn) else { continue };
        visit.script("document.getElementById('picture').focus()").await;
        let at = opened["grips"]
            .as_array()
            .expect("a list")
            .iter()
            .find(|g| g["path"] == grip.path.as_str());
        if at.is_none() {
            continue;
        }
        let (x, y) = self::grip(&opened, &grip.path);
        drag(&visit, (x, y), (x, y)).await;
        visit.script("document.getElementById('picture').focus()").await;
        for _ in 0..3 {
            chord(&visit, &[], RIGHT).await;
        }
        let path = parse_path(&grip.path).expect("a path");
        for _ in 0..3 {
            let Ok((x, y)) = native.press(id, &path) else { continue };
            native.drag(id, (x + 1.0, y));
            let _ = native.release(id);
        }
        let expected = bits_of_session(&native, id);
        let mut page = bits_of_page(&state(&visit).await);
        for _ in 0..50 {
            if page == expected {
                break;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
            page = bits_of_page(&state(&visit).await);
        }
        assert_eq!(page, expected, "{name} after three steps to the right of {}", grip.path);
    }
}
