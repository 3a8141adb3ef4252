//! A state machine: random commands on documents, and what must be true after every one of them.
//!
//! - Nothing panics; a refused command changes no bit.
//! - Undo brings back the text and every value, bit for bit, and so does redo.
//! - An accepted edit of values breaks no required constraint that held, and changes nothing that is
//!   not connected to it: the independent checker says so, and the status agrees with it.
//! - A change's edits, applied to the old text, give the new one.
//! - What is shown is what a session shows that opens the text anew, to the last bit and word.
//!
//! `THINGLAB_LONG` runs it for longer.

use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use session::view::{Change, Status};
use session::{Command, DocumentId, Host, Literal, Path, Session, parse_path};
use std::collections::BTreeSet;
use std::fmt::Debug;
use std::fs;
use std::path::PathBuf;

fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn file(folder: &str, name: &str) -> Option<String> {
    fs::read_to_string(project().join(folder).join(name).with_extension("thing")).ok()
}

struct Library;

impl Host for Library {
    fn read(&self, name: &str) -> Option<String> {
        file("library", name)
    }
}

const GALLERY: [&str; 7] = [
    "quadrilateral",
    "temperature",
    "voltage-divider",
    "square-root",
    "triangles",
    "bar-chart",
    "text-box",
];

const SMALL: [&str; 4] = [
    "a: Real = 1 // one\nb: Real\nc: Real = 3\nconstraint sum: b = a + c\n",
    "use geometry\nl: Line { p1 = (0, 0)  p2 = (30, 40) }\nm: Line\nmerge l.p2 = m.p1\nh: HorizontalLine\n",
    "use geometry\narm: ConstantLengthLine { p1 = (0, 0)  p2 = (30, 40) }\nanchor arm.p1\nweak constraint arm.p2.x = 30\n",
    "class Pair { x: Real = 2  y: Real  constraint square: y = x * x }\np: Pair\nq: Pair { x = 5 }\nt: Text = \"word\"\nconstraint sum: q.y = p.y + 21\n",
];

fn documents() -> Vec<String> {
    let gallery = GALLERY.iter().map(|name| file("gallery", name).expect("the gallery has it"));
    gallery.chain(SMALL.iter().map(ToString::to_string)).collect()
}

/// What a hand does; what it does it to is picked among what is there.
#[derive(Clone, Debug)]
enum Act {
    Set(Index, f64),
    SetText(Index, &'static str),
    Move(Index, f64, f64),
    Drag(Index, Vec<(f64, f64)>),
    Cancel(Index, f64, f64),
    DeleteLine(Index),
    InsertLine(Index, &'static str),
    Anchor(Index),
    LetGo(Index),
    Merge(Index, Index),
    Unmerge(Index),
    Undo,
    Redo,
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        6 => (-40i32..400).prop_map(|n| f64::from(n) / 2.0),
        3 => -500.0..500.0f64,
        1 => select(vec![0.0, -0.0, 1e-9, 1e9, 1e15, -1e-300, f64::NAN, f64::INFINITY]),
    ]
}

fn place() -> impl Strategy<Value = (f64, f64)> {
    (-20.0..600.0f64, -20.0..400.0f64)
}

fn act() -> impl Strategy<Value = Act> {
    let lines = vec![
        "extra: Real = 7",
        "extra: Rael",
        "constraint",
        "}",
        "{",
        "// a remark",
        "",
        "constraint extra = 8",
        "merge",
        "\u{e9}\"",
    ];
    let words = vec!["12", "hot", "", "-3.5", "\"quoted\" \\ \n\té"];
    let index = any::<Index>;
    prop_oneof![
        4 => (index(), number()).prop_map(|(i, x)| Act::Set(i, x)),
        1 => (index(), select(words)).prop_map(|(i, t)| Act::SetText(i, t)),
        3 => (index(), place()).prop_map(|(i, (x, y))| Act::Move(i, x, y)),
        4 => (index(), prop::collection::vec(place(), 1..6)).prop_map(|(i, to)| Act::Drag(i, to)),
        1 => (index(), place()).prop_map(|(i, (x, y))| Act::Cancel(i, x, y)),
        1 => index().prop_map(Act::DeleteLine),
        2 => (index(), select(lines)).prop_map(|(i, line)| Act::InsertLine(i, line)),
        1 => index().prop_map(Act::Anchor),
        1 => index().prop_map(Act::LetGo),
        1 => (index(), index()).prop_map(|(i, j)| Act::Merge(i, j)),
        1 => index().prop_map(Act::Unmerge),
        3 => Just(Act::Undo),
        2 => Just(Act::Redo),
    ]
}

type Moment = (String, Vec<(String, String, Option<u64>)>);

struct Desk {
    session: Session,
    id: DocumentId,
    /// Every moment that undo can come back to, the latest last.
    done: Vec<Moment>,
    /// Every moment that redo can come back to, the next last.
    undone: Vec<Moment>,
}

impl Desk {
    fn of(text: &str) -> Self {
        let mut session = Session::new(Box::new(Library));
        let id = session.open("machine", text);
        Self { session, id, done: Vec::new(), undone: Vec::new() }
    }
    fn moment(&self) -> Moment {
        let rows = self.session.values(self.id).into_iter().filter(|r| !r.is_virtual);
        let bits = rows.map(|r| (r.path, r.text, r.number.map(f64::to_bits))).collect();
        (self.session.text(self.id).source, bits)
    }
    /// Everything that is shown, but for what can be undone.
    fn shown(&mut self) -> impl PartialEq + Debug + use<> {
        let Self { session, id, .. } = self;
        let at_once = session.standing(*id);
        let status = Status { undo: None, redo: None, ..session.status(*id) };
        assert!(!at_once.counted || at_once.message == status.message, "{at_once:?}\n{status:?}");
        (session.text(*id), session.values(*id), session.structure(*id), status)
    }
    /// The paths of what values can be given to: numbers, or texts.
    fn stored(&self, number: bool) -> Vec<Path> {
        let rows = self.session.values(self.id).into_iter();
        let stored = rows.filter(|r| !r.is_virtual && r.number.is_some() == number);
        stored.filter_map(|r| parse_path(&r.path)).collect()
    }
    /// The paths of the places that can be gripped.
    fn grips(&self) -> Vec<Path> {
        let grips = self.session.picture(self.id).grips;
        grips.iter().filter_map(|g| parse_path(&g.path)).collect()
    }
    fn text_with(&self, change: impl FnOnce(&mut Vec<&str>)) -> Command {
        let text = self.session.text(self.id).source;
        let mut lines: Vec<&str> = text.split('\n').collect();
        change(&mut lines);
        Command::Text(lines.join("\n"))
    }
}

fn picked<T: Clone>(index: &Index, of: &[T]) -> Option<T> {
    (!of.is_empty()).then(|| index.get(of).clone())
}

/// Turns an act into a command, if there is anything to do it to.
fn command(desk: &Desk, act: &Act) -> Option<Command> {
    let number = |x: &f64| Literal::Number(*x);
    Some(match act {
        Act::Set(i, x) => Command::Set(vec![(picked(i, &desk.stored(true))?, number(x))]),
        Act::SetText(i, t) => {
            Command::Set(vec![(picked(i, &desk.stored(false))?, Literal::Text((*t).into()))])
        }
        Act::Move(i, x, y) => {
            let to = Literal::Tuple(vec![number(x), number(y)]);
            Command::Move(vec![(picked(i, &desk.grips())?, to)])
        }
        Act::DeleteLine(i) => desk.text_with(|lines| {
            lines.remove(i.index(lines.len()));
        }),
        Act::InsertLine(i, line) => {
            desk.text_with(|lines| lines.insert(i.index(lines.len()), line))
        }
        Act::Anchor(i) => Command::Anchor { path: picked(i, &desk.grips())?, held: true },
        Act::LetGo(i) => Command::Anchor { path: picked(i, &desk.grips())?, held: false },
        Act::Merge(i, j) => {
            let grips = desk.grips();
            Command::Merge(vec![picked(i, &grips)?, picked(j, &grips)?])
        }
        Act::Unmerge(i) => Command::Unmerge(picked(i, &desk.grips())?),
        Act::Undo => Command::Undo,
        Act::Redo => Command::Redo,
        Act::Drag(..) | Act::Cancel(..) => return None,
    })
}

fn edited(text: &str, change: &Change) -> String {
    let mut out = String::new();
    let mut from = 0;
    for edit in &change.edits {
        out.push_str(&text[from..edit.start as usize]);
        out.push_str(&edit.insert);
        from = edit.end as usize;
    }
    out + &text[from..]
}

/// The constraints that the checker says do not hold.
fn broken(desk: &Desk) -> BTreeSet<String> {
    let unmet = desk.session.standing(desk.id).unmet.into_iter();
    unmet.filter(|u| u.strength == "required").map(|u| u.constraint).collect()
}

fn step(desk: &mut Desk, act: &Act) -> Result<(), TestCaseError> {
    let before = desk.moment();
    let held = desk.session.standing(desk.id).satisfied;
    let result = match act {
        Act::Drag(i, along) => {
            let Some(path) = picked(i, &desk.grips()) else { return Ok(()) };
            desk.session.press(desk.id, &path).and_then(|_| {
                for &to in along {
                    desk.session.drag(desk.id, to);
                }
                desk.session.release(desk.id)
            })
        }
        Act::Cancel(i, x, y) => {
            let Some(path) = picked(i, &desk.grips()) else { return Ok(()) };
            if desk.session.press(desk.id, &path).is_ok() {
                desk.session.drag(desk.id, (*x, *y));
                desk.session.cancel(desk.id);
            }
            prop_assert_eq!(desk.moment(), before);
            return Ok(());
        }
        other => match command(desk, other) {
            Some(command) => desk.session.apply(desk.id, &command),
            None => return Ok(()),
        },
    };
    let after = desk.moment();
    let Ok(change) = result else {
        prop_assert_eq!(after, before, "a refused command changes no bit");
        return Ok(());
    };
    prop_assert_eq!(&edited(&before.0, &change), &after.0, "the edits give the new text");
    match act {
        Act::Undo => {
            prop_assert_eq!(Some(&after), desk.done.last(), "undo");
            desk.undone.push(before);
            desk.done.pop();
        }
        Act::Redo => {
            prop_assert_eq!(Some(&after), desk.undone.last(), "redo");
            desk.done.push(before);
            desk.undone.pop();
        }
        _ if after != before => {
            desk.done.push(before);
            desk.undone.clear();
        }
        _ => {}
    }
    let complaints = desk.session.complaints(desk.id);
    let satisfied = desk.session.standing(desk.id).satisfied;
    if matches!(act, Act::Set(..) | Act::SetText(..) | Act::Move(..) | Act::Drag(..)) && held {
        prop_assert!(complaints.is_empty(), "{act:?}: {complaints:?}, satisfied {satisfied}");
    }
    let broken = broken(desk);
    prop_assert_eq!(satisfied, complaints.is_empty(), "{:?} and {:?}", broken, complaints);
    // where a member has an error its last good version stays in force, which the text does not tell
    if !desk.session.text(desk.id).diagnostics.iter().any(|d| d.severity == "error") {
        let mut anew = Desk::of(&after.0);
        prop_assert!(anew.shown() == desk.shown(), "{:?}\n{:?}", anew.shown(), desk.shown());
    }
    Ok(())
}

/// The same cases in every run; more of them with `THINGLAB_LONG`.
fn runner() -> TestRunner {
    let cases = if std::env::var_os("THINGLAB_LONG").is_some() { 2000 } else { 64 };
    let config =
        Config { cases, failure_persistence: None, max_shrink_iters: 2000, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

#[test]
fn random_commands_keep_every_promise() {
    let documents = documents();
    let strategy = (select(documents), prop::collection::vec(act(), 1..12));
    let result = runner().run(&strategy, |(text, acts)| {
        let mut desk = Desk::of(&text);
        acts.iter().try_for_each(|act| step(&mut desk, act))?;
        while let Some(before) = desk.done.pop() {
            desk.session.apply(desk.id, &Command::Undo).expect("there is a step to undo");
            prop_assert_eq!(desk.moment(), before);
        }
        prop_assert_eq!(desk.session.text(desk.id).source, text);
        Ok(())
    });
    if let Err(why) = result {
        panic!("{why}");
    }
}

/// The documents in which the place that is dragged decides the rest.
const DETERMINED: [(&str, &str); 3] = [
    ("quadrilateral", "q.outer.side2.p2"),
    ("quadrilateral", "q.inner.side2.p2"),
    ("bar-chart", "third.top"),
];

fn dragged(name: &str, path: &Path, along: &[(f64, f64)]) -> Vec<(String, Option<f64>)> {
    let mut desk = Desk::of(&file("gallery", name).expect("the gallery has it"));
    desk.session.press(desk.id, path).expect("the place can be dragged");
    for &to in along {
        desk.session.drag(desk.id, to);
    }
    desk.session.values(desk.id).into_iter().map(|r| (r.path, r.number)).collect()
}

#[test]
fn a_fast_drag_ends_where_a_slow_one_does() {
    let strategy = (select(DETERMINED.to_vec()), place());
    let result = runner().run(&strategy, |((name, path), (x, y))| {
        let path = parse_path(path).expect("the path is well formed");
        let text = file("gallery", name).expect("the gallery has it");
        let from = Desk::of(&text);
        let picture = from.session.picture(from.id);
        let start = picture.grips.iter().find(|g| parse_path(&g.path).as_ref() == Some(&path));
        let start = start.map(|g| (g.x, g.y)).expect("the place has a grip");
        let along = |t: f64| (start.0 + t * (x - start.0), start.1 + t * (y - start.1));
        let slow: Vec<(f64, f64)> =
            (1..20).map(|i| along(f64::from(i) / 20.0)).chain([(x, y)]).collect();
        let ends = dragged(name, &path, &[(x, y)]).into_iter().zip(dragged(name, &path, &slow));
        for ((at, fast), (_, slow)) in ends {
            if let (Some(fast), Some(slow)) = (fast, slow) {
                let off = (fast - slow).abs();
                prop_assert!(off <= 1e-9 * slow.abs().max(1.0), "{at}: {fast} and {slow}");
            }
        }
        let back = dragged(name, &path, &[(x, y), along(0.5), start]);
        let bits = |rows: Vec<(String, Option<f64>)>| -> Vec<Option<u64>> {
            rows.into_iter().map(|r| r.1.map(f64::to_bits)).collect()
        };
        let opened = from.session.values(from.id).into_iter().map(|r| (r.path, r.number));
        prop_assert_eq!(bits(back), bits(opened.collect()), "out and back");
        Ok(())
    });
    if let Err(why) = result {
        panic!("{why}");
    }
}
