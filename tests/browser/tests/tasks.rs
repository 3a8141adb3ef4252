//! The tasks that others set for drawing by demonstration, each done by the mouse and what is typed for operands. The
//! actions are counted: one choice, one pick, one key of the calculator, one thing that is typed.

use browser::Visit;
use browser::{drafting, hands};
use fantoccini::actions::MOUSE_BUTTON_LEFT;
use std::time::Duration;

/// A hand that draws.
struct Hand {
    visit: Visit,
}

impl Hand {
    async fn begin() -> Self {
        let visit = hands::begin().await;
        visit.script("document.querySelector('#tab-draw').click()").await;
        Self { visit }
    }

    /// Chooses something by a click.
    async fn press(&self, selector: &str) {
        drafting::press(&self.visit, selector).await;
        tokio::time::sleep(Duration::from_millis(60)).await;
    }

    async fn draft(&self, what: &str) {
        self.press(&format!("[data-draft='{what}']")).await;
    }

    async fn construct(&self, tool: &str) {
        self.press(&format!("[data-construction='{tool}']")).await;
    }

    /// Types an operand.
    async fn enter(&self, typed: &str) {
        drafting::enter(&self.visit, typed).await;
    }

    async fn enter_all(&self, all: &[&str]) {
        for typed in all {
            self.enter(typed).await;
        }
    }

    /// Clicks where a place of the sheet is seen.
    async fn pick(&self, x: f64, y: f64) {
        drafting::pick(&self.visit, x, y).await;
        tokio::time::sleep(Duration::from_millis(80)).await;
    }

    async fn keys(&self, all: &[&str]) {
        drafting::calculate(&self.visit, all).await;
    }

    /// Begins a program with its parameters, each by a name, an example and *Define*.
    async fn record(&self, program: &str, parameters: &[(&str, &str)]) {
        drafting::fill(&self.visit, "input[name='program']", program).await;
        self.draft("record").await;
        for (name, example) in parameters {
            self.define(name, example).await;
        }
    }

    async fn define(&self, name: &str, example: &str) {
        drafting::define(&self.visit, name, example).await;
    }

    /// Gives the example another value.
    async fn set(&self, parameter: &str, value: &str) {
        drafting::set(&self.visit, parameter, value).await;
    }

    async fn has(&self, text: &str) {
        drafting::has(&self.visit, text).await;
    }

    /// Waits until a step says something of what it made.
    async fn made(&self, step: &str, says: &str) {
        let row = format!("document.querySelector(\"[data-step='{step}']\")");
        self.visit.until(&format!("{row}?.innerText.includes('{says}')")).await;
    }
}

#[tokio::test]
async fn a_table_is_a_third_of_its_floor() {
    let hand = Hand::begin().await;
    hand.record("Floor", &[("width", "90"), ("depth", "48")]).await;
    hand.construct("Rectangle.between(first,second)").await;
    hand.enter_all(&["0,0", "@width, depth"]).await;
    hand.construct("Rectangle").await;
    hand.pick(0.0, 0.0).await;
    hand.enter("width / 3").await;
    hand.press(".prompt [data-value='depth']").await;
    hand.draft("stop").await;
    hand.has("Rectangle(corner: rectangle.corner, width: width / 3, height: depth)").await;
    assert_eq!(hand.visit.actions.get(), 16);
    hand.set("width", "120").await;
    hand.made("rectangle2", "(0, 0) to (40, 48)").await;
    hand.visit.picture("floor").await;
}

#[tokio::test]
async fn an_arch_keeps_its_stones_as_thick() {
    let hand = Hand::begin().await;
    hand.record("Arch", &[("width", "130"), ("height", "120"), ("stone", "30")]).await;
    hand.construct("Rectangle.between(first,second)").await;
    hand.enter_all(&["0, height", "@width, -stone"]).await;
    hand.pick(0.0, 90.0).await;
    hand.enter("@stone, stone - height").await;
    hand.pick(130.0, 90.0).await;
    hand.enter("@-stone, stone - height").await;
    hand.draft("stop").await;
    hand.has("rectangle3 = Rectangle.between(rectangle.corner2, ").await;
    assert_eq!(hand.visit.actions.get(), 19);
    hand.set("stone", "40").await;
    hand.made("rectangle3", "80").await;
    hand.visit.picture("arch").await;
}

#[tokio::test]
async fn a_scale_leans_to_the_heavier_side() {
    let hand = Hand::begin().await;
    hand.record("Tray", &[("at", "0,0"), ("hang", "40"), ("half", "20")]).await;
    hand.construct("Line.horizontal(from,length)").await;
    hand.enter_all(&["at.x - half, at.y - hang", "2 * half"]).await;
    hand.construct("Line").await;
    for (x, y) in [(0.0, 0.0), (-20.0, -40.0), (0.0, 0.0), (20.0, -40.0)] {
        hand.pick(x, y).await;
    }
    hand.draft("stop").await;
    hand.record("Scale", &[("arm", "90"), ("left", "30"), ("right", "20")]).await;
    hand.construct("Line").await;
    hand.enter_all(&["0,-120", "0,0"]).await;
    hand.construct("value").await;
    hand.enter("atan((left - right) / (left + right))").await;
    hand.construct("Line.polar(from,length,angle)").await;
    for angle in ["200 deg + value", "-20 deg + value"] {
        hand.pick(0.0, 0.0).await;
        hand.press(".prompt [data-value='arm']").await;
        hand.enter(angle).await;
    }
    hand.construct("Tray").await;
    for (x, y) in [(-76.89, -46.77), (88.97, -13.6)] {
        hand.pick(x, y).await;
        hand.enter_all(&["", ""]).await;
    }
    hand.draft("stop").await;
    hand.has("tray2 = Tray(at: line3.p2, hang: 40, half: 20)").await;
    assert_eq!(hand.visit.actions.get(), 51);
    // as heavy on both sides it is level
    hand.set("right", "30").await;
    hand.made("line3", "(84.5723, -30.7818)").await;
    hand.visit.picture("scale").await;
}

#[tokio::test]
async fn a_sheet_is_folded_to_a_box_whose_volume_follows() {
    let hand = Hand::begin().await;
    hand.record("Box", &[("size", "100"), ("cut", "20")]).await;
    hand.construct("Rectangle.between(first,second)").await;
    hand.enter_all(&["cut, cut", "size - cut, size - cut"]).await;
    hand.pick(20.0, 20.0).await;
    hand.enter("@size - 2 * cut, -cut").await;
    // the other flaps by a pattern around the middle
    hand.construct(":pattern(about,count)").await;
    hand.pick(30.0, 0.0).await;
    hand.pick(50.0, 50.0).await;
    hand.enter("4").await;
    hand.construct("value").await;
    hand.enter("size - 2 * cut").await;
    // the box, seen from aside
    hand.construct("Rectangle").await;
    hand.enter_all(&["size + cut, 0", "value"]).await;
    hand.press(".prompt [data-value='cut']").await;
    hand.construct(":moved(by)").await;
    hand.pick(150.0, 0.0).await;
    hand.enter("value / 2, value / 3").await;
    hand.construct("Line").await;
    for (x, y) in [(120.0, 0.0), (180.0, 0.0), (180.0, 20.0), (120.0, 20.0)] {
        hand.pick(x, y).await;
        hand.pick(x + 30.0, y + 20.0).await;
    }
    hand.construct("value").await;
    hand.enter("value ^ 2 * cut").await;
    hand.draft("stop").await;
    hand.has("line4 = Line(rectangle3.corner4, shifted.corner4)").await;
    hand.has("map(nth => rectangle2.turned(about: rectangle.center, ").await;
    assert_eq!(hand.visit.actions.get(), 38);
    hand.made("value2", "72000").await;
    hand.set("cut", "30").await;
    hand.made("value2", "48000").await;
    hand.visit.picture("box").await;
}

#[tokio::test]
async fn squares_along_both_diagonals_make_an_x() {
    let hand = Hand::begin().await;
    hand.record("X", &[("w", "20"), ("n", "3")]).await;
    hand.construct("Rectangle").await;
    hand.enter("-w / 2, -w / 2").await;
    for _ in 0..2 {
        hand.press(".prompt [data-value='w']").await;
    }
    hand.construct(":pattern(by,count)").await;
    for way in ["w, w", "w, -w", "-w, w", "-w, -w"] {
        hand.pick(3.0, 10.0).await;
        hand.enter(way).await;
        hand.press(".prompt [data-value='n']").await;
    }
    hand.draft("stop").await;
    hand.has("n: Integer = 3").await;
    assert_eq!(hand.visit.actions.get(), 26);
    // the first of each pattern is there already
    hand.made("pattern4", "2 figures").await;
    hand.set("n", "5").await;
    hand.made("pattern4", "4 figures").await;
    hand.visit.picture("xs").await;
}

#[tokio::test]
async fn terminals_become_workstations_wherever_they_stand() {
    let hand = Hand::begin().await;
    hand.record("Terminal", &[("at", "0,0")]).await;
    hand.construct("Rectangle").await;
    hand.enter_all(&["at.x - 9, at.y + 4", "18", "14"]).await;
    hand.construct("Line.horizontal(from,length)").await;
    hand.enter_all(&["at.x - 12, at.y", "24"]).await;
    hand.draft("stop").await;
    hand.record("Network", &[]).await;
    hand.construct("Terminal").await;
    hand.enter_all(&["-60,-30", "0,40", "60,-30"]).await;
    hand.construct("Line").await;
    for (x, y) in [(-48.0, -30.0), (-12.0, 40.0), (12.0, 40.0), (48.0, -30.0)] {
        hand.pick(x, y).await;
    }
    hand.draft("stop").await;
    hand.has("line2 = Line(terminal2.line.p2, terminal3.line.p1)").await;
    assert_eq!(hand.visit.actions.get(), 25);
    // its screen is drawn anew, and stands on a foot
    hand.pick(9.0, 18.0).await;
    hand.draft("more").await;
    hand.press("[data-step='rectangle'] [data-step-replace]").await;
    hand.construct("Rectangle").await;
    hand.enter_all(&["at.x - 14, at.y + 10", "28", "20"]).await;
    hand.construct("Line").await;
    hand.pick(0.0, 0.0).await;
    hand.enter("@0, 10").await;
    hand.draft("stop").await;
    hand.has("rectangle = Rectangle(corner: Point(at.x - 14, at.y + 10), width: 28, height: 20)")
        .await;
    assert_eq!(hand.visit.actions.get(), 25 + 11);
    hand.visit.picture("workstations").await;
    plain_terminals(&hand).await;
}

/// Terminals that no program draws, three boxes and three lines: one of them becomes a class, the others are recognised
/// as such, and all follow what is drawn in its prototype.
async fn plain_terminals(hand: &Hand) {
    let visit = &hand.visit;
    visit.script("location.hash = '#/plain.thing'").await;
    visit.until("window.__thinglab.state().path === 'plain.thing'").await;
    hand.visit.actions.set(0);
    let places = [(450.0, 250.0), (620.0, 350.0), (790.0, 250.0)];
    let drag = async |from: (f64, f64), to: (f64, f64)| {
        hand.visit.act();
        hands::drag(visit, from, to).await;
    };
    for (x, y) in places {
        for (tool, from, to) in [
            ("rectangle", (x, y), (x + 60.0, y + 45.0)),
            ("line", (x - 10.0, y + 60.0), (x + 70.0, y + 60.0)),
        ] {
            hand.press(&format!("[data-action='tool-{tool}']")).await;
            drag(from, to).await;
            for _ in 0..2 {
                hands::chord(visit, &[], hands::key::ESCAPE).await;
            }
        }
    }
    hand.has("line3: Line").await;
    assert_eq!(hand.visit.actions.get(), 12);
    let around = async |(x, y): (f64, f64)| {
        drag((x - 25.0, y - 20.0), (x + 90.0, y + 80.0)).await;
    };
    around(places[0]).await;
    hand.visit.act();
    hands::chord(visit, &[hands::key::SHIFT], 'C').await;
    visit.until("document.activeElement.id === 'asked'").await;
    hand.visit.act();
    hands::keys(visit, "Terminal").await;
    hands::chord(visit, &[], hands::key::ENTER).await;
    hand.has("terminal: Terminal").await;
    for (place, thing) in places.iter().skip(1).zip(["terminal2", "terminal3"]) {
        around(*place).await;
        hand.visit.act();
        hands::chord(visit, &[hands::key::SHIFT], 'R').await;
        hand.press(".recognised button:not([aria-label])").await;
        hand.has(&format!("{thing}: Terminal")).await;
    }
    // its prototype: the box stands on a foot
    hand.visit.act();
    hands::point(visit, (places[0].0 + 20.0, places[0].1 + 60.0), MOUSE_BUTTON_LEFT).await;
    hand.visit.act();
    hands::chord(visit, &[hands::key::SHIFT], 'E').await;
    visit
        .until(
            "document.querySelector('.class-pane') && \
             !window.__thinglab.state().grips.some(g => g.path.startsWith('terminal2'))",
        )
        .await;
    let pane = seen_grips(visit).await;
    let of = |end: &str| pane.iter().find(|(path, _)| path.ends_with(end)).expect("a grip").1;
    let ((from, y), (to, _), (_, up)) = (of("line.p1"), of("line.p2"), of("rectangle.corner"));
    hand.press("[data-action='tool-line']").await;
    for end in [up, y] {
        hand.visit.act();
        hands::point(visit, (f64::midpoint(from, to), end), MOUSE_BUTTON_LEFT).await;
    }
    hand.has("constraint line2.p2 = line.midpoint").await;
    hand.press(".class-pane button").await;
    assert_eq!(hand.visit.actions.get(), 12 + 15);
    for thing in ["terminal", "terminal2", "terminal3"] {
        visit
            .until(&format!(
                "window.__thinglab.state().grips.some(g => g.path.startsWith('{thing}.line2'))"
            ))
            .await;
    }
    visit.picture("workstations-recognised").await;
}

/// Where the grips are seen, by their paths.
async fn seen_grips(visit: &Visit) -> Vec<(String, (f64, f64))> {
    let now = hands::state(visit).await;
    let grips = now["grips"].as_array().cloned().unwrap_or_default();
    let paths = grips.iter().filter_map(|grip| Some(grip["path"].as_str()?.to_string()));
    paths.map(|path| (path.clone(), hands::grip(&now, &path))).collect()
}

/// Draws the curve of von Koch by a program that is applied within itself.
async fn curve(hand: &Hand) {
    hand.record("Koch", &[("from", "0,0"), ("to", "90,0")]).await;
    hand.draft("further").await;
    hand.press("select[name='class'] option[value='Integer']").await;
    hand.define("depth", "0").await;
    hand.draft("if").await;
    hand.press(".prompt [data-value='depth']").await;
    hand.keys(&["=", "0", "give"]).await;
    hand.construct("Line").await;
    hand.pick(0.0, 0.0).await;
    hand.pick(90.0, 0.0).await;
    hand.draft("else").await;
    hand.set("depth", "1").await;
    hand.draft("others").await;
    hand.construct("Point.dividing(first,second,ratio)").await;
    hand.press("input[name='guide']").await;
    for ratio in ["1/3", "2/3"] {
        hand.pick(0.0, 0.0).await;
        hand.pick(90.0, 0.0).await;
        hand.enter(ratio).await;
    }
    hand.construct("Point:turned").await;
    hand.pick(60.0, 0.0).await;
    hand.pick(30.0, 0.0).await;
    hand.enter("60").await;
    hand.construct("Koch").await;
    hand.press("input[name='guide']").await;
    let ways = [(0.0, 0.0), (30.0, 0.0), (45.0, 26.0), (60.0, 0.0), (90.0, 0.0)];
    for way in ways.windows(2) {
        hand.pick(way[0].0, way[0].1).await;
        hand.pick(way[1].0, way[1].1).await;
        hand.enter("depth - 1").await;
    }
    hand.draft("end-if").await;
    hand.draft("stop").await;
    hand.has("koch4 = Koch(from: point2, to: to, depth: depth - 1)").await;
}

#[tokio::test]
async fn the_curve_of_koch_is_drawn_on_a_narrow_page() {
    let hand = Hand::begin().await;
    hand.visit.client.set_window_size(500, 844).await.expect("a narrow window");
    hand.press(".handles button").await;
    curve(&hand).await;
    hand.set("depth", "5").await;
    hand.made("#0.else.koch4", "4 figures").await;
    hand.visit.picture("koch-narrow").await;
}

#[tokio::test]
async fn the_snowflake_of_koch_is_three_curves_that_call_themselves() {
    let hand = Hand::begin().await;
    curve(&hand).await;
    assert_eq!(hand.visit.actions.get(), 52);
    hand.record("Snowflake", &[("size", "90"), ("depth", "2")]).await;
    hand.construct("Point.polar(from,distance,angle)").await;
    hand.press("input[name='guide']").await;
    hand.enter("0,0").await;
    hand.press(".prompt [data-value='size']").await;
    hand.enter("60").await;
    hand.construct("Koch").await;
    hand.press("input[name='guide']").await;
    hand.enter("0,0").await;
    hand.pick(45.0, 77.94).await;
    hand.press(".prompt [data-value='depth']").await;
    hand.pick(45.0, 77.94).await;
    hand.enter("size, 0").await;
    hand.press(".prompt [data-value='depth']").await;
    hand.enter_all(&["size, 0", "0, 0"]).await;
    hand.press(".prompt [data-value='depth']").await;
    hand.draft("stop").await;
    hand.has("koch3 = Koch(from: Point(size, 0), to: Point(0, 0), depth: depth)").await;
    hand.has("depth: Integer = 2").await;
    assert_eq!(hand.visit.actions.get(), 77);
    hand.set("depth", "3").await;
    hand.pick(-120.0, -60.0).await;
    hand.visit.book_picture("snowflake").await;
}
