//! What an edit leaves as it was is kept, and means what lowering anew says.

use base::Dice;
use lang::{Lowered, lower, lower_written};
use std::collections::BTreeMap;
use std::rc::Rc;

const CLASSES: &str = "class Widget { left: Real = 1  bottom: Real = 2  top: Real
    constraint top = left + bottom }
class Pair { a: Widget  b: Widget }
class Row { all: List of Real = [1] }
";

/// What the lines of a document may be: plain parts, and all that they are not.
const LINES: [&str; 22] = [
    "w: Widget { left = 5  bottom = 7 }",
    "v: Widget",
    "x: Real = 3",
    "y: Real",
    "w: Widget { left = 8 }",
    "p: Pair { a.left = 4 }",
    "many: List of 3 Widget",
    "few: List of 2 Real = [1, 2]",
    "z: Widget { left = x }",
    "/// said\nu: Widget { left = 2 }",
    "i, j: Real = 0",
    "q: Widget { top.enabled = false }",
    "o: Pair { merge a = b }",
    "constraint x = y",
    "merge v.left = w.left",
    "t: Text = \"word\"",
    "k: Integer in 0..9 = 4",
    "unit mm",
    "class More { a: Real }",
    "m: More",
    "some: List of Real = [1, 2, 3]",
    "for a in some { constraint a <= 9 }",
];

fn told(l: &Lowered) -> String {
    let Lowered { document, checks, origins, diagnostics, doc, .. } = l;
    format!("{document:#?}{checks:?}{origins:?}{diagnostics:#?}{doc}{}", l.keepable())
}

#[test]
fn what_is_kept_is_what_lowering_anew_gives() {
    let mut dice = Dice::new(5);
    let mut kept = 0;
    for _ in 0..220 {
        let mut lines: Vec<&str> = (0..6).map(|_| LINES[dice.below(LINES.len())]).collect();
        let mut before: Option<Lowered> = None;
        for _ in 0..12 {
            let text = format!("{CLASSES}{}\n", lines.join("\n"));
            let now = lower(&text, &|_| None, before.as_ref());
            // where something is wrong what was right before stays in force
            let anew = lower(&text, &|_| None, None);
            if anew.diagnostics.is_empty() {
                assert_eq!(told(&now), told(&anew), "{text}");
                kept += now.keepable();
            } else {
                assert_eq!(now.diagnostics, anew.diagnostics, "{text}");
            }
            before = Some(now);
            for _ in 0..1 + dice.below(3) {
                let (at, line) = (dice.below(lines.len()), LINES[dice.below(LINES.len())]);
                match dice.below(3) {
                    0 => lines[at] = line,
                    1 => lines.insert(at, line),
                    _ if lines.len() > 1 => {
                        lines.remove(at);
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(kept > 500, "{kept} parts could be kept");
}

/// What stands in a document with loops that only give values: of each row one, mostly the first.
const LOOPS: [&[&str]; 18] = [
    &["many: List of 4 Widget", "many: List of 4 Widget { left = 9 }", "many: List of 5 Widget"],
    &["", "// a word", "unit mm", "x: Real = 3"],
    &["few: List of 4 Real", "few: List of 4 Real = [1, 2, 3, 4]", "few: List of 4 Integer"],
    &["table: List of 2 List of 2 Widget", "table: List of 3 List of 2 Widget"],
    &[
        "constant n: Integer = 3",
        "constant n: Integer = 2",
        "n: Real = 3",
        "n: Integer = 3",
        "n: Integer = 2",
    ],
    &["for i in 0..3 { many[i].left = 2 * i }", "for i in 0..2 { many[i].left = 2 * i }"],
    &["", "x: Real = 3", "w: Widget"],
    &["for i in 0..<n { many[i].bottom = i }", "for i in 0..2 { many[i].bottom = n + i }"],
    &["for a in many { a.left = 3  a.bottom = 4 }", "for a in few { a = 3 }"],
    &["for i in 0..1 { for j in 0..1 { table[i][j].left = 2 * i + j } }", ""],
    &["for i in 0..1 { for a in table[i] { a.bottom = i } }", "for i in 0..9 { few[i] = 1 }"],
    &["for i in 0..3 { few[i] = i * 2 }", "for i in 0..3 { few[i] = many[i].left }"],
    &["for i in 1..3 { many[i] = copy of many[i - 1] }", ""],
    &[
        "m: Integer = 2",
        "m: Bool = true",
        "k, m: Integer = 1",
        "x: Real = 1\nm: Integer in 0..9 = 3",
        "m => 2",
        "class m { }",
    ],
    &[
        "for i in 0..m { few[i] = m }",
        "for i in 0..<m { for j in 0..i { table[0][j].left = m } }",
        "for few in 0..2 { many[few].left = few }",
    ],
    &["", "merge many[0].left = many[1].left", "constraint few[0] = few[1]"],
    &["", "p: Pair", "left: Widget", "class More { a: Real }"],
    &["", "many[1].bottom = 5", "for a in many { a.more = 3 }"],
];

#[test]
fn what_loops_give_is_kept_as_long_as_their_words_mean_the_same() {
    let mut dice = Dice::new(11);
    let mut kept = 0;
    for _ in 0..12 {
        let mut chosen = [0; LOOPS.len()];
        let mut before: Option<Lowered> = None;
        for _ in 0..24 {
            let lines: Vec<&str> = chosen.iter().zip(LOOPS).map(|(i, row)| row[*i]).collect();
            let text = format!("{CLASSES}{}\n", lines.join("\n"));
            let (now, is_right) = as_anew(&text, &|_| None, before.as_ref());
            let is_kept = before.as_ref().is_some_and(|before| gives_the_same(&now, before));
            kept += u32::from(is_right && is_kept);
            before = Some(now);
            let row = dice.below(LOOPS.len());
            chosen[row] = if chosen[row] == 0 { dice.below(LOOPS[row].len()) } else { 0 };
        }
    }
    assert!(kept > 60, "{kept} times");
}

/// Whether the last value of a loop is the very same.
fn gives_the_same(now: &Lowered, before: &Lowered) -> bool {
    let last = |l: &Lowered| {
        let givens = &l.document.classes[l.document.root].givens;
        let of_list = |g: &&Rc<kernel::Given>| g.path.to_string().starts_with("many[");
        givens.iter().rev().find(of_list).cloned()
    };
    matches!((last(now), last(before)), (Some(a), Some(b)) if Rc::ptr_eq(&a, &b))
}

/// What a document with a library may say: steps and classes that speak of its classes, and what makes these others.
const DRAWN: [&str; 26] = [
    "c => Circle(center: Point(0, 1), radius: 2)",
    "d => Circle.concentric(with: Circle(center: (1, 2), radius: 3), radius: 4)",
    "p: Point = (3, 4)",
    "l: Line { p1 = (0, 0) }",
    "constraint p.x = 3",
    "program Ring(size: Length = 4) { a = Circle(center: Point(0, 0), radius: size)  b = Circle.concentric(with: a, radius: size / 2) }",
    "program Ring(size: Length = 4) { a = Circle(center: Point(0, 0), radius: size) }",
    "program Ring(size: Length = 4) { a = Axis.horizontal(y: size)\nrepeat 2 times { b = Circle(center: Point(0, 0), radius: 1) } }",
    "ring: Ring { size = 3 }",
    "modify Line { kind => 3 }",
    "class Held is Line { without level\nconstraint level: p1.y = p2.y }",
    "h: Held",
    "all_points: List of 3 Point",
    "class Kite { sides: List of 2 Line\nmodify Point { x = 1 } }",
    "k: Kite",
    "unit mm",
    "y down",
    "use circuits",
    "use contours",
    "use drafting",
    "rounding: Rounding { radius = 2 }",
    "box => Contour.box(of: Rectangle.between(first: Point(0, 0), second: Point(6, 2)))",
    "class Circle { radius: Real = 1 }",
    "class Blob { name: Text  center: Point }",
    "blob: Blob\nround: Circle\nmerge blob = round",
    "p2: Point = (1, 2)\nmerge l.p1 = p2",
];

fn library(name: &str) -> Option<String> {
    let text = match name {
        "geometry" => include_str!("../../../../library/geometry.thing"),
        "circuits" => include_str!("../../../../library/circuits.thing"),
        "contours" => include_str!("../../../../library/contours.thing"),
        "drafting" => include_str!("../../../../library/drafting.thing"),
        _ => return None,
    };
    Some(text.into())
}

/// What a text means after another is what it means alone; returns it, and whether nothing is wrong with it.
#[track_caller]
fn as_anew(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    before: Option<&Lowered>,
) -> (Lowered, bool) {
    let (now, anew) = (lower(text, load, before), lower(text, load, None));
    assert_eq!(now.diagnostics, anew.diagnostics, "{text}");
    let is_right = anew.diagnostics.is_empty();
    if is_right {
        let (now, anew) = (told(&now), told(&anew));
        let other = now.lines().zip(anew.lines()).find(|(a, b)| a != b);
        assert!(now == anew, "{text}\n{other:?}");
    }
    (now, is_right)
}

#[test]
fn what_a_library_says_is_what_it_says_anew() {
    let mut dice = Dice::new(31);
    let mut compared = 0;
    for _ in 0..8 {
        let mut lines: Vec<&str> = (0..4).map(|_| DRAWN[dice.below(DRAWN.len())]).collect();
        let mut before: Option<Lowered> = None;
        for _ in 0..6 {
            let text = format!("use geometry\n{}\n", lines.join("\n"));
            let (now, is_right) = as_anew(&text, &library, before.as_ref());
            compared += u32::from(is_right);
            before = Some(now);
            let (at, line) = (dice.below(lines.len()), DRAWN[dice.below(DRAWN.len())]);
            match dice.below(2) {
                0 => lines[at] = line,
                _ => lines.insert(at, line),
            }
        }
    }
    assert!(compared > 8, "{compared} of them have nothing wrong");
}

#[test]
fn a_library_answers_what_it_answers_where_it_is_the_document() {
    let answers = |lowered: &Lowered| -> BTreeMap<(String, String), String> {
        let classes = lowered.document.classes.iter().filter(|(_, class)| !class.name.is_empty());
        let all = classes.flat_map(|(_, class)| {
            let answer = |m: &kernel::Message| {
                ((class.name.to_string(), m.name.to_string()), format!("{:?}", m.answer))
            };
            class.messages.iter().map(answer)
        });
        all.collect()
    };
    let mut compared = 0;
    for name in ["geometry", "contours", "circuits"] {
        let text = library(name).expect("it is there");
        let [own, used] =
            [text, format!("use {name}")].map(|text| answers(&lower(&text, &library, None)));
        for (message, answer) in &own {
            compared += u32::from(used.contains_key(message));
            assert_eq!(used.get(message), Some(answer), "{message:?} of {name}");
        }
    }
    assert!(compared > 200, "{compared} are compared");
}

const BOXES: &str = "class Held { a: Real = 1 }
class Box { held: Held  heavy => 2 * held.weight  constraint held.weight = 5 }
";
const THINGS: &str = "constant least: Real = 3
class Spot { x: Real = 4  far => 2 * least  constraint x >= least }
here: Spot
";

/// What a document says, and what it says then: what used texts say in it is another thing each time.
const OTHERWISE: [(&str, &str); 6] = [
    // a thing of a used class is merged with one that has the name, or with none, or with another
    (
        "use boxes\nb: Box\nw: Heavy\nmerge b.held = w\nclass Heavy { weight: Real = 3 }",
        "use boxes\nb: Box\nw: Heavy\nclass Heavy { weight: Real = 3 }",
    ),
    (
        "use boxes\nb: Box\nw: Heavy\nmerge b.held = w\nclass Heavy { weight: Real = 3 }",
        "use boxes\nb: Box\nw: Heavy\nmerge b.held = w\nclass Heavy { weight: Text = \"no\" }",
    ),
    // the things of a used text stand elsewhere
    ("use alone\nuse things\nk: Spot", "use alone\nk: Spot"),
    // its things are spoken of, and shown
    ("use things\nk: Spot\nconstraint k.x = things.here.x", "use things\nk: Spot"),
    // classes that it makes come sooner
    (
        "use geometry\nclass One { }\nclass Two { all: List of 2 One }\nc: Circle",
        "use geometry\nc: Circle",
    ),
    // a name that it uses is declared by the document
    ("use geometry\nclass Circle { radius: Real = 1 }\nc: Circle", "use geometry\nc: Circle"),
];

#[test]
fn what_a_used_text_says_is_read_anew_where_it_is_another_thing() {
    let load = |name: &str| match name {
        "boxes" => Some(BOXES.into()),
        "alone" => Some("use things\nclass Lone { spot: Spot }".into()),
        "things" => Some(THINGS.into()),
        _ => library(name),
    };
    for (was, is) in OTHERWISE.iter().flat_map(|(one, other)| [(*one, *other), (*other, *one)]) {
        let before = lower(was, &load, None);
        let (_, is_right) = as_anew(is, &load, Some(&before));
        assert!(is_right || before.diagnostics.is_empty(), "{was}\n{is}");
    }
}

#[test]
fn a_used_text_that_was_edited_says_what_it_says_now() {
    const USED: [&str; 4] = [
        "class Held { a: Real = 1  twice => 2 * a  constraint a >= 0 }",
        "class Held { a: Real = 1  twice => 3 * a  constraint a >= 0 }",
        "class Held { a: Real = 1  twice => 2 * a  constraint a >= 1 }",
        "class Other { }\nclass Held { a: Real = 1  twice => 2 * a  constraint a >= 0 }",
    ];
    let text = "use held\nh: Held\nconstraint h.twice = 4\n";
    for (was, is) in USED.iter().flat_map(|was| USED.map(|is| (*was, is))) {
        let before = lower(text, &|_| Some(was.into()), None);
        assert!(before.diagnostics.is_empty(), "{:?}", before.diagnostics);
        assert!(as_anew(text, &|_| Some(is.into()), Some(&before)).1, "{is}");
    }
}

/// A document with all that may stand around given numbers.
const NUMBERS: &str = r#"use some
class Widget { left: Real = 1  bottom: Real = 2  top: Real
    constraint top = left + bottom }
w: Widget { left = 5  bottom = 7 }
x: Real = 3
/// said
u: Widget { left = 2 }
wide: Length = 30 mm
p: Box { corner.left = 4  size = (3, -8) }
constraint x < 90
few: List of 2 Real = [1, 2]
z: Widget { left = x }
v: Widget
merge v.left = w.left
q: Box { size = (1, 2) }
r: Box
r.corner.left = 11
merge u.bottom = w.bottom
r.size = (4, 5)
// a word between
k: Integer in 0..9 = 4
check "it is so" {
    set x to 4
    expect w.left = 5
}
lesson "a step" {
    say "more"
    task w.left = 6
    set w.left to 6
}
"#;
/// What it uses.
const SOME: &str = "class Pair { x: Real  y: Real }
class Box { corner: Corner  size: Size }
class Corner { left: Real = 1 }
class Size is Pair { }
";

fn some(name: &str) -> Option<String> {
    (name == "some").then(|| SOME.to_string())
}

/// Whether nothing was declared anew: what a class gives is the very same.
fn takes_over(now: &Lowered, before: &Lowered) -> bool {
    let given = |l: &Lowered| {
        let class = l.document.class_named("Widget")?;
        l.document.classes[class].givens.first().cloned()
    };
    matches!((given(now), given(before)), (Some(a), Some(b)) if Rc::ptr_eq(&a, &b))
}

#[test]
fn numbers_written_anew_mean_what_lowering_the_text_gives() {
    let first = lower(NUMBERS, &some, None);
    assert_eq!(first.diagnostics, []);
    let told = |l: &Lowered| format!("{}{:#?}{:?}", told(l), l.lessons, l.files);
    let mut dice = Dice::new(7);
    let (mut text, mut before, mut taken) = (NUMBERS.to_string(), first, 0);
    for _ in 0..300 {
        // some number is another, longer or shorter
        let numbers: Vec<_> = text.match_indices(|c: char| c.is_ascii_digit()).collect();
        let (at, _) = numbers[dice.below(numbers.len())];
        let mut other = text.clone();
        other.replace_range(at..=at, ["0", "7", "12.5", "-3", "5 mm"][dice.below(5)]);
        let anew = lower(&other, &some, None);
        if !anew.diagnostics.is_empty() || anew.document.scale != before.document.scale {
            continue;
        }
        let now = lower_written(&other, &some, &before);
        if takes_over(&now, &before) {
            assert_eq!(told(&now), told(&anew), "{other}");
            taken += 1;
        }
        (text, before) = (other, now);
    }
    assert!(taken > 60, "{taken} times");
}

#[test]
fn what_is_more_than_a_number_is_lowered_anew() {
    let before = lower(NUMBERS, &some, None);
    let is_taken_over = |text: &str, load: &dyn Fn(&str) -> Option<String>| {
        takes_over(&lower_written(text, load, &before), &before)
    };
    let others = [
        ("x: Real = 3", "x: Real = 3 + u.left"),
        ("x: Real = 3", "y: Real = 3"),
        ("x: Real = 3", "x: Integer = 3"),
        ("x: Real = 3", "x: Real"),
        ("bottom = 7 }", "top = 7 }"),
        ("constraint x < 90", "constraint x < 80"),
        ("v: Widget", "v: Widget { left = 1 }"),
    ];
    for (from, to) in others {
        let text = NUMBERS.replacen(from, to, 1);
        assert!(!is_taken_over(&text, &some), "{text}");
    }
    let text = NUMBERS.replace("= 3\n", "= 4\n");
    let changed = |name: &str| some(name).map(|text| format!("{text}// more\n"));
    assert!(is_taken_over(&text, &some) && !is_taken_over(&text, &changed));
}

/// What a text means, its members told by where they are written: what is numbered later is numbered otherwise.
fn told_by_place(l: &Lowered) -> String {
    let Lowered { document, checks, lessons, diagnostics, doc, files, .. } = l;
    let mut document = document.clone();
    let units: BTreeMap<base::Place, base::Name> =
        document.units.into_iter().map(|(origin, unit)| (l.origins.place(origin), unit)).collect();
    document.units = Default::default();
    let told =
        format!("{document:#?}{units:?}{checks:?}{lessons:#?}{diagnostics:#?}{doc}{files:?}");
    let mut by_place = String::new();
    let mut rest = told.as_str();
    while let Some(at) = rest.find("origin: o").or_else(|| rest.find("    o")) {
        let at = at + rest[at..].find('o').unwrap_or_default();
        let at = if rest[at..].starts_with("origin: ") { at + "origin: ".len() } else { at };
        let (before, after) = rest.split_at(at);
        let digits = after[1..].find(|c: char| !c.is_ascii_digit()).unwrap_or_default();
        by_place += before;
        match after[1..=digits].parse() {
            Ok(number) => by_place += &format!("{:?}", l.origins.place(kernel::OriginId(number))),
            Err(_) => by_place += &after[..=digits],
        }
        rest = &after[1 + digits..];
    }
    by_place + rest
}

/// A document whose parts are given what they are beside their declarations, by loops and by lines.
const BESIDE: &str = "use some
all: List of 6 Box
box: Box
wide: Length = 30 mm
for i in 0..3 { all[i].size = (i, 2) }
all[4].size = (8, 9)
merge all[4].corner = all[5].corner
all[5].size = (1, 1)
constraint box.size.x > -90
box.corner.left = 4
check \"it is so\" {
    expect box.corner.left = 4
}
";

#[test]
fn values_that_come_anew_mean_what_lowering_the_text_gives() {
    const NEW: [&str; 5] = [
        "all[1].size = (3, -4)\n",
        "all[2].corner.left = 7\n",
        "box.size = (5, 6)\n",
        "box.size.x = 7\n",
        "wide = 4 mm\n",
    ];
    let given = |l: &Lowered| {
        let class = l.document.class_named("Corner")?;
        l.document.classes[class].givens.first().cloned()
    };
    let is_taken = |now: &Lowered, before: &Lowered| matches!((given(now), given(before)), (Some(a), Some(b)) if Rc::ptr_eq(&a, &b));
    let mut dice = Dice::new(11);
    let (mut taken, mut more) = (0, 0);
    for _ in 0..40 {
        let mut text = BESIDE.to_string();
        let mut before = lower(&text, &some, None);
        assert_eq!(before.diagnostics, []);
        for _ in 0..6 {
            let lines: Vec<_> = text.match_indices('\n').map(|(at, _)| at + 1).collect();
            let mut other = text.clone();
            match dice.below(3) {
                0 => {
                    let numbers: Vec<_> =
                        text.match_indices(|c: char| c.is_ascii_digit()).collect();
                    let (at, _) = numbers[dice.below(numbers.len())];
                    other.replace_range(at..=at, ["1", "3", "12.5"][dice.below(3)]);
                }
                _ => other.insert_str(lines[dice.below(lines.len())], NEW[dice.below(NEW.len())]),
            }
            let anew = lower(&other, &some, None);
            if !anew.diagnostics.is_empty() || anew.document.scale != before.document.scale {
                continue;
            }
            let now = lower_written(&other, &some, &before);
            if is_taken(&now, &before) {
                let (now, anew) = (told_by_place(&now), told_by_place(&anew));
                let differs = now.lines().zip(anew.lines()).find(|(a, b)| a != b);
                assert!(now == anew, "{other}\n{differs:?}");
                taken += 1;
                more += usize::from(other.matches('\n').count() > text.matches('\n').count());
            }
            (text, before) = (other, now);
        }
    }
    assert!(taken > 60 && more > 40, "{taken} times, {more} with a value more");
}

#[test]
fn a_value_that_says_how_many_there_are_is_lowered_anew() {
    const COUNTED: &str = "class Held { a: Real = 1 }
class Row { n: Integer = 2  all: List of n Held }
row: Row
x: Real = 3
row.n = 3
";
    let before = lower(COUNTED, &some, None);
    for text in [COUNTED.replace("row.n = 3", "row.n = 4"), format!("{COUNTED}row.n = 5\n")] {
        let (now, anew) = (lower_written(&text, &some, &before), lower(&text, &some, None));
        let (now, anew) = (told(&now), told(&anew));
        let differs = now.lines().zip(anew.lines()).find(|(a, b)| a != b);
        assert!(now == anew, "{text}\n{differs:?}");
    }
}
