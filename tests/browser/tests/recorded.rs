//! Standard parts recorded from an empty document: by the mouse, by the keyboard alone, and on a narrow page.

use browser::Visit;
use browser::drafting::{
    asked, calculate, construct, define, enter, fill, has, pick, press, seen, set,
};
use browser::hands::{self, key, state, text_of};

/// Begins a program with its parameters, each with its example.
pub(crate) async fn record(visit: &Visit, program: &str, parameters: &[(&str, &str)]) {
    press(visit, "#tab-draw").await;
    visit.actions.set(0);
    fill(visit, "input[name='program']", program).await;
    press(visit, "[data-draft='record']").await;
    for (name, example) in parameters {
        define(visit, name, example).await;
    }
}

/// Zooms in, which is none of the actions that draw.
async fn enlarge(visit: &Visit, times: usize) {
    let drawn = visit.actions.get();
    for _ in 0..times {
        press(visit, ".corner button:last-child").await;
    }
    visit.actions.set(drawn);
}

/// Begins an `if` whose condition the calculator says: a parameter, and keys.
async fn branch(visit: &Visit, parameter: &str, keys: &[&str]) {
    press(visit, "[data-draft='if']").await;
    press(visit, &format!("[data-parameter='{parameter}']")).await;
    calculate(visit, keys).await;
    press(visit, "[data-key='give']").await;
}

/// Draws the other branch under another value.
async fn otherwise(visit: &Visit, parameter: &str, value: &str) {
    press(visit, "[data-draft='else']").await;
    set(visit, parameter, value).await;
    press(visit, "[data-draft='others']").await;
}

async fn value(visit: &Visit, expression: &str) {
    construct(visit, "value").await;
    enter(visit, expression).await;
}

#[tokio::test]
async fn a_bolt_has_the_thread_that_its_length_asks_for() {
    let visit = hands::begin().await;
    let parameters = [("d", "10"), ("k", "6.4"), ("s", "16"), ("length", "60")];
    record(&visit, "Bolt", &parameters).await;
    enlarge(&visit, 8).await;
    construct(&visit, "Line").await;
    for typed in ["-k, -s / 2", "-k, s / 2"] {
        enter(&visit, typed).await;
    }
    for (x, y, typed) in
        [(-6.4, 8.0, "0, s / 2"), (0.0, 8.0, "0, -s / 2"), (0.0, -8.0, "-k, -s / 2")]
    {
        pick(&visit, x, y).await;
        enter(&visit, typed).await;
    }
    enter(&visit, "0, d / 2").await;
    enter(&visit, "length, d / 2").await;
    pick(&visit, 60.0, 5.0).await;
    enter(&visit, "@0, -d").await;
    has(&visit, "Point(line5.p2.x, line5.p2.y - d)").await;
    pick(&visit, 60.0, -5.0).await;
    enter(&visit, "0, -d / 2").await;
    has(&visit, "line7 = Line(line6.p2, Point(0, -d / 2))").await;
    branch(&visit, "length", &["≤", "1", "2", "5"]).await;
    value(&visit, "2 * d + 6").await;
    otherwise(&visit, "length", "140").await;
    branch(&visit, "length", &["≤", "2", "0", "0"]).await;
    value(&visit, "2 * d + 12").await;
    otherwise(&visit, "length", "220").await;
    value(&visit, "2 * d + 25").await;
    for _ in 0..2 {
        press(&visit, "[data-draft='end-if']").await;
    }
    // what the three call alike is one thing behind them
    construct(&visit, "Line.vertical(from,length)").await;
    enter(&visit, "length - value, d / 2").await;
    enter(&visit, "-d").await;
    let drawn = visit.actions.get();
    for (length, at) in [("140", "(108, 5)"), ("60", "(34, 5)"), ("220", "(175, 5)")] {
        set(&visit, "length", length).await;
        visit
            .until(&format!(
                "document.querySelector(\"[data-step='line8']\").innerText.includes('{at}')"
            ))
            .await;
    }
    visit.picture("bolt").await;
    visit.actions.set(drawn);
    press(&visit, "[data-draft='stop']").await;
    assert_eq!(visit.actions.get(), 61);
    // its steps and values stay in sight
    visit.until("document.querySelector(\"[data-step='line8']\")").await;
}

#[tokio::test]
async fn a_retaining_ring_has_the_lug_that_its_size_asks_for() {
    let visit = hands::begin().await;
    let parameters = [("d1", "20"), ("d3", "18.5"), ("a", "4"), ("d5", "2")];
    record(&visit, "Ring", &parameters).await;
    enlarge(&visit, 12).await;
    // the tools beside the picture draw steps, too
    press(&visit, "[data-action='tool-circle']").await;
    press(&visit, "input[name='guide']").await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "d3 / 2 + a / 2").await;
    has(&visit, "guide circle = Circle(center: Point(0, 0), radius: d3 / 2 + a / 2)").await;
    construct(&visit, "Axis.vertical(x)").await;
    enter(&visit, "7 * a / 10").await;
    press(&visit, "[data-draft='end']").await;
    // what is for construction alone is picked, and does not go on by itself
    construct(&visit, "Circle").await;
    construct(&visit, "Point.intersection(first,second)").await;
    pick(&visit, 2.8, 4.0).await;
    pick(&visit, 4.5, 10.3).await;
    enter(&visit, "d5 / 2").await;
    has(&visit, "    circle2 = Circle(center: Point.intersection(axis, circle), radius: d5 / 2)")
        .await;
    visit.picture("ring-guides").await;
    branch(&visit, "d1", &["<", "1", "0"]).await;
    construct(&visit, "Circle.concentric(with,radius)").await;
    pick(&visit, -11.25, 0.0).await;
    enter(&visit, "d3 / 2 + a").await;
    otherwise(&visit, "d1", "8").await;
    construct(&visit, "Circle.concentric(with,radius)").await;
    pick(&visit, 3.8, 10.9).await;
    enter(&visit, "a / 2").await;
    press(&visit, "[data-draft='end-if']").await;
    let text = text_of(&state(&visit).await);
    let wanted = "    if d1 < 10 {
        circle3 = Circle.concentric(with: circle2, radius: a / 2)
    } else {
        circle3 = Circle.concentric(with: circle, radius: d3 / 2 + a)
    }";
    assert!(text.contains(wanted), "{text}");
    press(&visit, "[data-action='tool-rectangle']").await;
    asked(&visit, "Box between two opposite corners").await;
    construct(&visit, "Circle").await;
    visit.book_picture("ring").await;
}

#[tokio::test]
async fn a_nut_is_a_flat_in_a_polar_pattern() {
    let visit = hands::begin().await;
    record(&visit, "Nut", &[("s", "16"), ("d", "10")]).await;
    enlarge(&visit, 12).await;
    construct(&visit, "Point").await;
    press(&visit, "input[name='guide']").await;
    for typed in ["0, 0", "0, s / (2 * cos(30 deg))"] {
        enter(&visit, typed).await;
    }
    construct(&visit, "Point:turned").await;
    pick(&visit, 0.0, 9.24).await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "60").await;
    has(&visit, "guide turned = point2.turned(about: point, by: 60 deg)").await;
    press(&visit, "[data-draft='end']").await;
    construct(&visit, "Line").await;
    pick(&visit, 0.0, 9.24).await;
    pick(&visit, -8.0, 4.62).await;
    has(&visit, "    line = Line(point2, turned)").await;
    construct(&visit, ":pattern(about,count)").await;
    pick(&visit, -4.0, 6.93).await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "6").await;
    construct(&visit, "Circle").await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "d / 2").await;
    has(&visit, "    circle = Circle(center: point, radius: d / 2)").await;
    press(&visit, "[data-draft='stop']").await;
    // an M16: its corners are 24 / sqrt(3) from its middle
    set(&visit, "s", "24").await;
    let row = |step: &str| format!("document.querySelector(\"[data-step='{step}']\").innerText");
    visit.until(&format!("{}.includes('(0, 13.8564)')", row("line"))).await;
    visit.until(&format!("{}.includes('5 figures')", row("pattern"))).await;
    visit.picture("nut").await;
}

#[tokio::test]
async fn a_geneva_wheel_is_drawn_where_its_guides_cross() {
    let visit = hands::begin().await;
    let parameters =
        [("radius", "50"), ("slots", "6"), ("pin", "5"), ("deep", "28"), ("bore", "12")];
    record(&visit, "Geneva", &parameters).await;
    enlarge(&visit, 8).await;
    construct(&visit, "Circle").await;
    press(&visit, "input[name='guide']").await;
    for typed in ["0,0", "radius"] {
        enter(&visit, typed).await;
    }
    construct(&visit, "Axis.horizontal(y)").await;
    for typed in ["pin / 2", "-pin / 2"] {
        enter(&visit, typed).await;
    }
    press(&visit, "[data-draft='end']").await;
    construct(&visit, "Circle").await;
    press(&visit, "input[name='guide']").await;
    construct(&visit, "Point.polar(from,distance,angle)").await;
    pick(&visit, 0.0, 0.0).await;
    for typed in ["radius / cos(180 deg / slots)", "180 deg / slots", "21 * radius / 50"] {
        enter(&visit, typed).await;
    }
    press(&visit, "[data-draft='end']").await;
    // the slot begins where two guides cross, and follows them
    construct(&visit, "Line").await;
    for (y, typed) in [(2.5, "radius - deep, pin / 2"), (-2.5, "radius - deep, -pin / 2")] {
        pick(&visit, 49.94, y).await;
        enter(&visit, typed).await;
    }
    has(&visit, "line = Line(Point.intersection(axis, circle), Point(radius - deep, pin / 2))")
        .await;
    construct(&visit, "Arc").await;
    enter(&visit, "radius - deep, 0").await;
    for y in [2.5, -2.5] {
        pick(&visit, 22.0, y).await;
    }
    let (low, high) = ((49.38, 7.88), (31.51, 38.82));
    for (x, y) in [(0.0, 0.0), (49.94, 2.5), low, (50.0, 28.87), high, low, (0.0, 0.0), high] {
        pick(&visit, x, y).await;
    }
    construct(&visit, "Point:turned").await;
    pick(&visit, 49.94, -2.5).await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "360 deg / slots").await;
    has(&visit, "arc4 = Arc(circle.center, arc3.start, line2.p1.turned(").await;
    construct(&visit, ":pattern(about,count)").await;
    visit.act();
    hands::drag(&visit, seen(&visit, 18.0, 46.0).await, seen(&visit, 62.0, -6.0).await).await;
    pick(&visit, 0.0, 0.0).await;
    press(&visit, ".prompt [data-value='slots']").await;
    has(&visit, "[line, line2, arc, arc2, arc3, arc4].turned(about: circle.center, by: nth * ")
        .await;
    construct(&visit, "Circle").await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "bore / 2").await;
    press(&visit, "[data-draft='stop']").await;
    assert_eq!(visit.actions.get(), 62);
    let row = "document.querySelector(\"[data-step='pattern']\").innerText";
    set(&visit, "slots", "5").await;
    visit.until(&format!("{row}.includes('4 figures')")).await;
    visit.picture("geneva").await;
}

/// The half of a ring with round lugs, right of its gap, drawn by guides and then by its edges.
async fn half_a_ring(visit: &Visit) {
    press(visit, "[data-action='tool-circle']").await;
    press(visit, "input[name='guide']").await;
    for (center, radius) in
        [("0, 0", "d3 / 2"), ("0, -b / 5", "d3 / 2 + 4 * b / 5"), ("0, 0", "d3 / 2 + a / 2")]
    {
        enter(visit, center).await;
        enter(visit, radius).await;
    }
    for place in ["a / 5", "7 * a / 10"] {
        construct(visit, "Axis.vertical(x)").await;
        enter(visit, place).await;
    }
    for (tool, operands) in [
        ("Point.intersection(first,second)", &["axis2", "circle3"][..]),
        ("Point.intersection(first,second)", &["axis", "circle"]),
        ("Circle", &["point", "a / 2"]),
    ] {
        construct(visit, tool).await;
        for operand in operands {
            enter(visit, operand).await;
        }
    }
    press(visit, "[data-draft='end']").await;
    for (tool, operands) in [
        ("Arc.fillet(first,second,radius)", &["-circle4", "-circle2", "a / 4"][..]),
        ("Line", &["point2", "Point(a / 5, point.y)"]),
        ("ClockwiseArc", &["point", "line.p2", "arc.start"]),
        ("ClockwiseArc", &["circle2.center", "arc.end", "Point(0, -d3 / 2 - b)"]),
        ("ClockwiseArc", &["circle.center", "point2", "Point(0, -d3 / 2)"]),
        ("Circle", &["point", "d5 / 2"]),
    ] {
        construct(visit, tool).await;
        for operand in operands {
            enter(visit, operand).await;
        }
    }
}

#[tokio::test]
async fn a_whole_retaining_ring_is_one_contour_with_its_holes() {
    let visit = hands::begin().await;
    hands::use_library(&visit, "contours").await;
    let parameters = [("d3", "5.6"), ("a", "2.7"), ("b", "1.3"), ("d5", "1.2")];
    record(&visit, "Ring", &parameters).await;
    enlarge(&visit, 14).await;
    half_a_ring(&visit).await;
    has(&visit, "circle5 = Circle(center: point, radius: d5 / 2)").await;
    // the other half is its mirror image
    construct(&visit, "Point:mirrored").await;
    enter(&visit, "[arc, line, clockwiseArc, clockwiseArc2, clockwiseArc3]").await;
    enter(&visit, "Axis.vertical(x: 0)").await;
    construct(&visit, "Point:mirrored").await;
    enter(&visit, "circle5").await;
    enter(&visit, "Axis.vertical(x: 0)").await;
    has(&visit, "mirrored2 = circle5.mirrored(").await;
    // one pick of an edge takes all of the outline
    construct(&visit, "Contour.along(edges)").await;
    press(&visit, "input[name='guide']").await;
    pick(&visit, 0.54, 3.3).await;
    has(&visit, "guide contour = Contour.along(edges: [line").await;
    for hole in ["circle5", "mirrored2"] {
        construct(&visit, "Contour.circle(of)").await;
        enter(&visit, hole).await;
    }
    construct(&visit, "Region.difference(first,second)").await;
    enter(&visit, "contour").await;
    enter(&visit, "contour2").await;
    has(&visit, "guide region = Region.difference(contour, contour2)").await;
    press(&visit, "input[name='guide']").await;
    enter(&visit, "region").await;
    enter(&visit, "contour3").await;
    has(&visit, "region2 = Region.difference(region, contour3)").await;
    let said = "document.querySelector(\"[data-step='region2']\")";
    visit.until(&format!("{said} && !{said}.querySelector('.wrong')")).await;
    press(&visit, "[data-draft='end']").await;
    visit.book_picture("retaining-ring").await;
    // it is a ring for other values, too
    for (parameter, value) in [("d3", "7.4"), ("a", "3.2"), ("b", "1.5")] {
        set(&visit, parameter, value).await;
    }
    visit.until(&format!("{said} && !{said}.querySelector('.wrong')")).await;
    visit.picture("ring-whole").await;
}

#[tokio::test]
async fn a_plate_is_rows_of_rows_of_holes() {
    let visit = hands::begin().await;
    let parameters = [("rows", "5"), ("columns", "8"), ("hole", "25"), ("pitch", "40")];
    record(&visit, "Plate", &parameters).await;
    for _ in 0..2 {
        press(&visit, "[data-draft='repeat']").await;
    }
    construct(&visit, "Circle").await;
    enter(&visit, "pitch / 2, pitch / 2").await;
    enter(&visit, "hole / 2").await;
    press(&visit, "[data-draft='times']").await;
    // the next hole of a row, then the first one of the next row
    for (asks, by, times) in [(2, "pitch, 0", "columns"), (4, "0, pitch", "rows")] {
        for n in 1..=asks {
            asked(&visit, &format!("{n} of {asks}")).await;
            let asks_place = "document.querySelector('.prompt').innerText.includes('was (')";
            if visit.script(&format!("return {asks_place}")).await == true {
                construct(&visit, ":moved(by)").await;
                pick(&visit, 20.0, 20.0).await;
                enter(&visit, by).await;
            } else {
                press(&visit, "[data-draft='same']").await;
            }
        }
        asked(&visit, "how many turns").await;
        press(&visit, &format!("[data-parameter='{times}']")).await;
        has(&visit, &format!("repeat {times} times")).await;
        if times == "columns" {
            press(&visit, "[data-draft='times']").await;
        }
    }
    let text = text_of(&state(&visit).await);
    let wanted = "    turns = repeat rows times with center2 = Point(pitch / 2, pitch / 2) {
        turns2 = repeat columns times with center = center2 {
            circle = Circle(center: center, radius: hole / 2)
            next center = circle.center.moved(by: Point(pitch, 0))
        }
        next center2 = turns2[0].center.moved(by: Point(0, pitch))
    }";
    assert!(text.contains(wanted), "{text}");
    visit.picture("plate").await;
    visit.book_picture("plate").await;
    construct(&visit, "Rectangle").await;
    for typed in ["0, 0", "columns * pitch", "rows * pitch"] {
        enter(&visit, typed).await;
    }
    has(&visit, "Rectangle(corner: Point(0, 0), width: columns * pitch, height: rows * pitch)")
        .await;
    // to stop is one more
    assert_eq!(visit.actions.get() + 1, 38);
    press(&visit, "[data-draft='end']").await;
    // where steps stand, what defines a parameter is folded away
    press(&visit, "[data-draft='unfold']").await;
    define(&visit, "edge", "10").await;
    has(&visit, "edge: Length = 10").await;
}

#[tokio::test]
async fn a_box_that_is_refused_is_not_checked() {
    let visit = hands::begin().await;
    record(&visit, "Mark", &[("d", "6")]).await;
    branch(&visit, "d", &["≤", "9"]).await;
    construct(&visit, "Circle").await;
    for typed in ["10, 0", "d / 3"] {
        enter(&visit, typed).await;
    }
    construct(&visit, ":pattern(about,count)").await;
    for typed in ["circle", "0, 0", "3"] {
        enter(&visit, typed).await;
    }
    has(&visit, "(1..3 - 1)").await;
    press(&visit, "[data-draft='end-if']").await;
    // nothing tells whether a circle is drawn that these values do not come to
    set(&visit, "d", "12").await;
    let row = "[data-step='#0.then.circle']";
    press(&visit, &format!("{row} .step")).await;
    press(&visit, &format!("{row} input[name='step-guide']")).await;
    visit.until("document.querySelector('.notice').innerText.includes('is not drawn by')").await;
    visit
        .until(&format!("!document.querySelector(\"{row} input[name='step-guide']\").checked"))
        .await;
    // nor is it forgotten that it can be checked
    set(&visit, "d", "6").await;
    press(&visit, &format!("{row} .step")).await;
    press(&visit, &format!("{row} input[name='step-guide']")).await;
    has(&visit, "guide circle = ").await;
}

#[tokio::test]
async fn a_flange_counts_its_holes_by_a_plain_number_and_is_applied_by_its_questions() {
    let visit = hands::begin().await;
    record(&visit, "Flange", &[("outer", "120"), ("round", "90"), ("holes", "6")]).await;
    enlarge(&visit, 3).await;
    construct(&visit, "Circle").await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "outer / 2").await;
    for typed in ["round / 2, 0", "6"] {
        enter(&visit, typed).await;
    }
    construct(&visit, ":pattern(about,count)").await;
    pick(&visit, 51.0, 0.0).await;
    pick(&visit, 0.0, 0.0).await;
    press(&visit, "[data-parameter='holes']").await;
    has(&visit, "holes: Integer = 6").await;
    asked(&visit, "holes is a count now").await;
    press(&visit, "[data-draft='end']").await;
    // the whole is mirrored by one rubber band
    construct(&visit, "Axis.vertical(x)").await;
    enter(&visit, "100").await;
    construct(&visit, "Point:mirrored").await;
    let (from, to) = (seen(&visit, -65.0, 65.0).await, seen(&visit, 65.0, -65.0).await);
    hands::drag(&visit, from, to).await;
    asked(&visit, "pick a line").await;
    pick(&visit, 100.0, 20.0).await;
    has(&visit, "mirrored2 = pattern.mirrored(about: axis)").await;
    press(&visit, "[data-draft='stop']").await;
    construct(&visit, "Flange").await;
    asked(&visit, "Enter takes 120").await;
    for typed in ["60", "", "4", "0, -120"] {
        enter(&visit, typed).await;
    }
    has(&visit, "round = 90").await;
    visit.picture("flange").await;
}

#[tokio::test]
async fn a_washer_is_recorded_on_a_narrow_page() {
    let visit = Visit::open_empty().await;
    visit.until("document.getElementById('picture')?.width > 10").await;
    hands::use_library(&visit, "contours").await;
    visit.leave_and_return().await;
    // what an earlier visit left is offered where it covers nothing
    let is_offered =
        |height: &str| format!("document.querySelector('.notice.draft')?.offsetHeight {height}");
    visit.until(&is_offered("> 10")).await;
    visit.client.set_window_size(500, 844).await.expect("a narrow window");
    press(&visit, ".handles button").await;
    record(&visit, "Washer", &[("inner", "84"), ("outer", "160")]).await;
    construct(&visit, "Circle").await;
    asked(&visit, "pick a point").await;
    visit.until(&is_offered("=== 0")).await;
    // what is asked hides nothing of the picture
    visit
        .until(
            "(([a, b]) => a.bottom <= b.top + 1 && b.width > 300)(['#picture', '.prompt']
                .map(s => document.querySelector(s).getBoundingClientRect()))",
        )
        .await;
    pick(&visit, 0.0, 0.0).await;
    press(&visit, ".prompt [data-value='inner']").await;
    has(&visit, "circle = Circle(center: Point(0, 0), radius: inner)").await;
    pick(&visit, 0.0, 0.0).await;
    press(&visit, ".prompt [data-value='outer']").await;
    has(&visit, "circle2 = Circle(center: circle.center, radius: outer)").await;
    visit.picture("washer-narrow").await;
    press(&visit, "[data-draft='stop']").await;
    visit.until(&is_offered("> 10")).await;
}

#[tokio::test]
async fn a_column_of_a_file_beside_the_document_says_what_is_allowed() {
    let visit = Visit::open_new("gallery/bolts.thing").await;
    visit.put("bolts.csv", "name, d [mm]\nM3, 3\nM8, 8\nM10, 10\n");
    visit
        .until("window.__thinglab && window.__thinglab.state().path === 'gallery/bolts.thing'")
        .await;
    visit.until("document.getElementById('picture').width > 10").await;
    record(&visit, "Bolt", &[]).await;
    fill(&visit, "input[name='parameter']", "d").await;
    fill(&visit, "input[name='example']", "8 mm").await;
    press(&visit, "[data-draft='further']").await;
    // on a sheet without a unit the first one is that of the sheet from now on
    visit.until("document.querySelector('[name=understood]').innerText.includes('8 mm')").await;
    // what is empty again stays in sight
    fill(&visit, "input[name='range']", "3").await;
    fill(&visit, "input[name='range']", &key::DELETE.to_string()).await;
    assert_eq!(visit.script("return document.querySelector('.define details').open").await, true);
    // a table that comes later is looked for again
    fill(&visit, "input[name='range']", "nuts.csv.d").await;
    press(&visit, "[data-draft='define']").await;
    visit.until("document.querySelector('#wrong-range').innerText.includes('no table')").await;
    visit.put("nuts.csv", "d [mm]\n8\n9\n");
    press(&visit, "[data-draft='define']").await;
    visit
        .until("document.querySelector('.define details .understood').innerText === '8 mm or 9 mm'")
        .await;
    // what is wrong is said below its field
    fill(&visit, "input[name='range']", "bolts.csv.diameter").await;
    press(&visit, "input[name='question']").await;
    visit
        .until("document.querySelector('#wrong-range').innerText.includes('it has name, d')")
        .await;
    fill(&visit, "input[name='range']", "bolts.csv.d").await;
    visit.until("document.querySelector('.define details .understood').innerText === '3 mm, 8 mm or 10 mm'").await;
    visit.picture("parameter").await;
    press(&visit, "[data-draft='define']").await;
    has(&visit, "d: Length in \"bolts.csv\".d = 8 mm").await;
    construct(&visit, "Circle").await;
    enter(&visit, "0,0").await;
    enter(&visit, "d / 2").await;
    press(&visit, "[data-draft='stop']").await;
    // what is shown of it offers the values, and another one is refused
    visit.until("[...document.querySelectorAll('select.field option')].map(o => o.value).join() === '3,8,10'").await;
    set(&visit, "d", "9 mm").await;
    visit.until("document.querySelector('.parameter .wrong')?.innerText").await;
    set(&visit, "d", "10 mm").await;
    has(&visit, "bolt: Bolt { d = 10").await;
    // where it is applied they are keys
    construct(&visit, "Bolt").await;
    press(&visit, ".prompt [data-choice='3 mm']").await;
    enter(&visit, "40, 0").await;
    has(&visit, "d = 3 mm").await;
}

#[tokio::test]
async fn boxes_are_drawn_by_one_drag_each_and_caught_by_one_for_a_loop() {
    let visit = hands::begin().await;
    record(&visit, "Plate", &[]).await;
    press(&visit, "[data-action='tool-rectangle']").await;
    visit.until("document.querySelector('.prompt')").await;
    hands::drag(&visit, (500.0, 500.0), (700.0, 380.0)).await;
    visit.until("/rectangle = Rectangle.between\\(/.test(window.__thinglab.state().text)").await;
    hands::drag(&visit, (740.0, 500.0), (800.0, 420.0)).await;
    visit.until("/rectangle2 = Rectangle.between\\(/.test(window.__thinglab.state().text)").await;
    press(&visit, "[data-draft='end']").await;
    press(&visit, "[data-draft='for-each']").await;
    hands::drag(&visit, (460.0, 540.0), (840.0, 340.0)).await;
    has(&visit, "for element in [rectangle, rectangle2] {").await;
    // one of them is left out before anything is drawn for it
    press(&visit, "[data-set='rectangle2'][aria-pressed='true']").await;
    has(&visit, "for element in [rectangle] {").await;
    press(&visit, "[data-set='rectangle2'][aria-pressed='false']").await;
    has(&visit, "for element in [rectangle, rectangle2] {").await;
}

#[tokio::test]
async fn the_step_that_failed_comes_into_sight_and_so_does_the_one_of_what_is_selected() {
    let visit = hands::begin().await;
    let circles = (1..15)
        .map(|i| format!("    c{i} = Circle(center: Point({}, 10), radius: d / 4)\n", 20 * i - 10));
    let lines = (1..14).map(|i| format!("    l{i} = Line(c{i}.center, c{}.center)\n", i + 1));
    let text = format!(
        "use geometry\nprogram Row(d: Length = 20, w: Length = 60) {{\n{}    t = \
         Circle.tangent(-c1, -c2, radius: w - 20)\n{}}}\nrow: Row\n",
        circles.collect::<String>(),
        lines.collect::<String>()
    );
    visit.put("row.thing", &text);
    visit.script("location.hash = '#/gallery/row.thing'").await;
    visit.until("window.__thinglab.state().path === 'gallery/row.thing'").await;
    press(&visit, "#tab-draw").await;
    pick(&visit, 270.0, 15.0).await;
    visit.until("document.querySelector('.steps li')").await;
    let is_in_sight = |step: &str| {
        format!(
            "(([a, b]) => b && a.top <= b.top + 1 && b.top < a.bottom)(['.steps', '.steps {step}']
                .map(s => document.querySelector(s)?.getBoundingClientRect()))"
        )
    };
    assert_eq!(visit.script(&format!("return {}", is_in_sight("[data-step=t]"))).await, false);
    set(&visit, "w", "21").await;
    visit.until(&is_in_sight("[data-step=t].failed")).await;
    set(&visit, "w", "60").await;
    visit.until("!document.querySelector('.steps .failed')").await;
    // once more there: what is within it
    pick(&visit, 150.0, 15.0).await;
    visit.until(&is_in_sight("[data-step=c8].selected")).await;
    visit.picture("steps-selected").await;
}

#[tokio::test]
async fn a_question_of_a_document_is_asked_beside_no_other() {
    let visit = hands::begin().await;
    record(&visit, "Ring", &[("d", "10")]).await;
    construct(&visit, "Circle").await;
    asked(&visit, "pick a point").await;
    let path = state(&visit).await["path"].as_str().unwrap_or_default().to_string();
    visit.put("other.thing", "use geometry\n");
    visit.script("location.hash = '#/gallery/other.thing'").await;
    visit.until("window.__thinglab.state().path === 'gallery/other.thing'").await;
    visit.until("!document.querySelector('.prompt')").await;
    visit.script(&format!("location.hash = '#/{path}'")).await;
    asked(&visit, "pick a point").await;
    pick(&visit, 0.0, 0.0).await;
    enter(&visit, "d").await;
    has(&visit, "circle = Circle(center: Point(0, 0), radius: d)").await;
}
