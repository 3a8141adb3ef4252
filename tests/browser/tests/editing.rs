//! The text pane's keys, and several things at once in the picture: chosen by a band, dragged, copied, deleted.

use browser::Visit;
use browser::hands::{begin, chord, drag, grip, key, keys, show, state, text_of};
use serde_json::json;

const STRUT: &str = "\
use geometry
/// Two ends held apart.
class Strut {
    /// Where it begins.
    foot: Point
    head: Point
    picture => segment(foot, head)
}
a: Strut { head = (0, 80) }
size: Real = 3
y: Real = 2 * siz
";

/// The line that the cursor is in.
const LINE: &str = "return document.querySelector('.cm-activeLine').textContent";

/// Goes down from the first line, and right.
async fn go_to(visit: &Visit, (line, column): (usize, usize)) {
    chord(visit, &[key::CONTROL], key::HOME).await;
    for _ in 1..line {
        chord(visit, &[], key::DOWN).await;
    }
    for _ in 1..column {
        chord(visit, &[], key::RIGHT).await;
    }
}

#[tokio::test]
async fn the_text_is_read_and_mended_by_the_keys_that_editors_have() {
    let visit = Visit::open_empty().await;
    visit.put("strut.thing", STRUT);
    show(&visit, "strut.thing").await;
    chord(&visit, &[key::ALT], '4').await;
    visit.until("document.activeElement.classList.contains('cm-content')").await;
    // F12 goes to where a name is declared, in a library too
    go_to(&visit, (7, 24)).await;
    chord(&visit, &[], key::F12).await;
    assert_eq!(visit.script(LINE).await, "    foot: Point");
    go_to(&visit, (5, 13)).await;
    chord(&visit, &[], key::F12).await;
    visit.until("document.activeElement.closest('.peek')").await;
    let shown = visit.script("return document.querySelector('.peek mark').textContent").await;
    assert_eq!(shown, "Point");
    visit.picture("definition").await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until("document.activeElement.classList.contains('cm-content')").await;
    // F2 renames it wherever it is spoken of, and gives the keyboard back
    go_to(&visit, (6, 7)).await;
    chord(&visit, &[], key::F2).await;
    visit.until("document.activeElement.id === 'asked'").await;
    keys(&visit, "top").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('a: Strut { top = (0, 80) }')").await;
    visit.until("document.activeElement.classList.contains('cm-content')").await;
    assert!(text_of(&state(&visit).await).contains("segment(foot, top)"));
    // Ctrl+. offers what mends the line
    go_to(&visit, (11, 15)).await;
    chord(&visit, &[key::CONTROL], '.').await;
    visit.until("document.querySelector('.cm-tooltip-autocomplete li')").await;
    // the list takes no key in its first moment
    tokio::time::sleep(std::time::Duration::from_millis(150)).await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().text.includes('2 * size')").await;
    // completion knows the body around
    go_to(&visit, (7, 1)).await;
    keys(&visit, "f").await;
    visit.until("document.querySelector('.cm-tooltip-autocomplete li')").await;
    let first = "return document.querySelector('.cm-tooltip-autocomplete li .cm-completionLabel').textContent";
    assert_eq!(visit.script(first).await, "foot");
}

#[tokio::test]
async fn several_things_are_chosen_by_a_band_dragged_copied_and_deleted() {
    let visit = begin().await;
    visit.put(
        "several.thing",
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p2 = (100, 60) }\nmerge a.p2 = b.p1\n\
         constraint a.p1.y = a.p2.y\nk: Circle { center = (220, 40)  radius = 30 }\n",
    );
    show(&visit, "several.thing").await;
    visit.until("document.getElementById('picture').width > 10").await;
    let now = state(&visit).await;
    let (one, other) = (grip(&now, "a.p1"), grip(&now, "b.p2"));
    let aside = |(x, y): (f64, f64), d: f64| (x + d, y + d * (other.1 - one.1).signum());
    drag(&visit, aside(one, -25.0), aside(other, 25.0)).await;
    visit.until("window.__thinglab.state().selected === 'a'").await;
    assert_eq!(state(&visit).await["also"], json!(["b"]));
    // both go with the one that is held
    drag(
        &visit,
        ((one.0 + grip(&now, "a.p2").0) / 2.0, one.1),
        ((one.0 + grip(&now, "a.p2").0) / 2.0 + 60.0, one.1),
    )
    .await;
    visit.until("window.__thinglab.state().status.undo === 'move a, b'").await;
    let moved = state(&visit).await;
    let by = grip(&moved, "b.p2").0 - other.0;
    assert!((by - 60.0).abs() < 4.0, "{by}");
    assert_eq!(grip(&moved, "k.center"), grip(&now, "k.center"));
    // a copy keeps what is said between its parts
    chord(&visit, &[key::CONTROL], 'c').await;
    chord(&visit, &[key::CONTROL], 'v').await;
    visit.until("window.__thinglab.state().text.includes('merge line.p2 = line2.p1')").await;
    assert!(text_of(&state(&visit).await).contains("constraint line.p1.y = line.p2.y"));
    assert_eq!(state(&visit).await["also"], json!(["line2"]));
    chord(&visit, &[key::CONTROL], 'z').await;
    visit.until("!window.__thinglab.state().text.includes('line2')").await;
    // the clipboard of the system has it as a text, which another document takes with what it uses
    chord(&visit, &[key::ALT], 'n').await;
    visit.until("window.__thinglab.state().path === 'untitled-2.thing'").await;
    chord(&visit, &[key::CONTROL], 'v').await;
    visit.until("window.__thinglab.state().text.includes('merge a.p2 = b.p1')").await;
    visit.script("history.back()").await;
    visit.until("window.__thinglab.state().text.includes('k: Circle')").await;
    visit.script("document.getElementById('picture').focus()").await;
    // what goes along is told before
    chord(&visit, &[key::CONTROL], 'a').await;
    visit.until("window.__thinglab.state().also.length === 2").await;
    chord(&visit, &[], key::DELETE).await;
    visit.until("document.querySelector('.asked')").await;
    visit.picture("several-deleted").await;
    visit.script("document.querySelector('.asked button').click()").await;
    visit.until("!window.__thinglab.state().text.includes(': ')").await;
    chord(&visit, &[key::CONTROL], 'z').await;
    visit.until("window.__thinglab.state().text.includes('k: Circle')").await;
}

/// GeoGebra's own recipe for the circumcircle of a triangle (<https://www.geogebra.org/m/bdwU1AKA>) takes 15 actions:
/// a tool and four corners, a tool and three sides to bisect, a tool and two bisectors to intersect, a tool, the centre
/// and a corner. With its tool for circles through three points it would be 9. Here it takes 10.
#[tokio::test]
async fn the_circumcircle_of_a_triangle_is_drawn_by_the_pointer_alone_in_ten_actions() {
    let visit = begin().await;
    let rect = visit
        .script("const r = document.getElementById('picture').getBoundingClientRect(); return [r.left, r.top, r.width, r.height]")
        .await;
    let number = |n: usize| rect[n].as_f64().expect("a number");
    let at = |x: f64, y: f64| (number(0) + x * number(2), number(1) + y * number(3));
    let corners = [at(0.3, 0.7), at(0.75, 0.65), at(0.45, 0.2)];
    let actions = std::cell::Cell::new(0);
    let click = async |place: (f64, f64)| {
        actions.set(actions.get() + 1);
        browser::hands::point(&visit, place, fantoccini::actions::MOUSE_BUTTON_LEFT).await;
    };
    let press = async |button: &str| {
        let middle = format!(
            "const b = {button}; b.scrollIntoView({{ block: 'center' }}); const r = b.getBoundingClientRect(); \
             return [r.left + r.width / 2, r.top + r.height / 2]"
        );
        let middle = visit.script(&middle).await;
        click((middle[0].as_f64().expect("a number"), middle[1].as_f64().expect("a number"))).await;
    };
    press("document.querySelector('[data-action=tool-line]')").await;
    for corner in [corners[0], corners[1], corners[2], corners[0]] {
        click(corner).await;
    }
    visit.until("window.__thinglab.state().text.includes('merge line.p1 = line3.p2')").await;
    press("document.getElementById('tab-draw')").await;
    let construction = "[...document.querySelectorAll('button')].find(b => b.innerText.includes('Circle through three points'))";
    visit.until(construction).await;
    press(construction).await;
    for corner in corners {
        click(corner).await;
    }
    visit.until("window.__thinglab.state().text.includes('circle => Circle.through(line.p1, line.p2, line2.p2)')").await;
    assert_eq!(actions.get(), 10);
    // the drag test: one corner is dragged, the others stay, the circle follows
    chord(&visit, &[], key::ESCAPE).await;
    chord(&visit, &[], 'v').await;
    let before = state(&visit).await;
    let from = grip(&before, "line.p1");
    drag(&visit, from, (from.0 - 60.0, from.1 + 20.0)).await;
    visit.until("window.__thinglab.state().status.undo === 'move line.p1'").await;
    let after = state(&visit).await;
    for corner in ["line.p2", "line2.p2"] {
        assert_eq!(grip(&after, corner), grip(&before, corner));
    }
    assert_eq!(
        (&after["status"]["satisfied"], &after["status"]["freedom"]),
        (&json!(true), &json!(6))
    );
    visit.picture("circumcircle").await;
    visit.book_picture("circumcircle").await;
}

#[tokio::test]
async fn a_tool_that_keys_move_says_where_it_is_and_shows_what_is_typed() {
    let visit = begin().await;
    // a document that is begun has the keyboard in its picture
    visit.script("document.querySelector('[data-action=theme]').focus()").await;
    chord(&visit, &[key::CONTROL], 'k').await;
    visit.until("document.activeElement.matches('[role=combobox]')").await;
    keys(&visit, "new document").await;
    chord(&visit, &[], key::ENTER).await;
    visit.until("window.__thinglab.state().path === 'untitled-2.thing'").await;
    visit.until("document.activeElement.id === 'picture'").await;
    chord(&visit, &[], 'l').await;
    keys(&visit, "0,0").await;
    chord(&visit, &[], key::ENTER).await;
    chord(&visit, &[], key::RIGHT).await;
    chord(&visit, &[], key::DOWN).await;
    let heard = "document.getElementById('picture-live').textContent";
    visit.until(&format!("{heard} === '10, -10'")).await;
    chord(&visit, &[], key::ESCAPE).await;
    chord(&visit, &[], key::ESCAPE).await;
    visit.until(&format!("{heard} === ''")).await;
}

#[tokio::test]
async fn things_of_which_nothing_else_can_be_said_are_a_class_from_the_strip() {
    let visit = begin().await;
    visit.put(
        "three.thing",
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 40)  p2 = (70, 90) }\n\
         k: Circle { center = (220, 40)  radius = 30 }\nanchor b\n",
    );
    show(&visit, "three.thing").await;
    visit.script("document.getElementById('picture').focus()").await;
    chord(&visit, &[key::CONTROL], 'a').await;
    visit.until("window.__thinglab.state().also.length === 2").await;
    // those that are not locked yet are locked in one step, and all let go in one
    let lock = "document.querySelector('.strip [data-action=lock]')";
    visit.until(&format!("{lock}?.innerText === 'lock'")).await;
    visit.script(&format!("{lock}.click()")).await;
    visit.until(&format!("{lock}.innerText === 'unlock' && window.__thinglab.state().text.match(/anchor/g).length === 3")).await;
    visit.script(&format!("{lock}.click()")).await;
    visit.until("!window.__thinglab.state().text.includes('anchor')").await;
    visit.until("document.querySelector('.strip [data-action=class-of]')").await;
    visit.script("document.querySelector('.strip [data-action=class-of]').click()").await;
    visit.until("document.activeElement.id === 'asked'").await;
}
