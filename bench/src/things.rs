//! Ten thousand things: what opening and editing them costs, stage by stage.
//!
//! The things are instances of one class with ten numbers and six constraints, once as elements of a
//! list and once as members written one by one. In: nothing. Out: a table of milliseconds, and of
//! the bytes that the process grew by for each number.

use kernel::Values;
use plan::{Model, Planner, Plans};
use session::{Command, DocumentId, Host, Literal, Session};
use std::fmt::Write as _;
use std::fs;
use std::io::Write;
use std::time::Instant;

/// How many things.
const THINGS: usize = 10_000;

/// How often everything is measured: the least counts.
const TIMES: usize = 7;

/// A class of ten numbers.
const WIDGET: &str = "class Widget {
    left: Real = 1  bottom: Real = 2  width: Real = 30  height: Real = 40
    right, top, middle, level, area, slope: Real
    constraint right = left + width
    constraint top = bottom + height
    constraint middle = (left + right) / 2
    constraint level = (bottom + top) / 2
    constraint area = width * height
    constraint slope * width = height
}
";

struct Nothing;

impl Host for Nothing {
    fn read(&self, _: &str) -> Option<String> {
        None
    }
}

/// Measures a document of widgets in a list, and one of widgets written one by one.
pub(crate) fn table(out: &mut impl Write) -> std::io::Result<()> {
    let listed = format!("{WIDGET}widgets: List of {THINGS} Widget\n");
    let mut written = WIDGET.to_string();
    for i in 0..THINGS {
        let _ = writeln!(written, "w{i}: Widget {{ left = {i}  bottom = {} }}", i % 100);
    }
    let listed = (listed, ["widgets[17]", "widgets[4711]"]);
    for (name, (text, things)) in [("listed", listed), ("written", (written, ["w17", "w4711"]))] {
        stages(out, name, &text)?;
        let (mut session, id) = edits(out, name, &text, things)?;
        hands(out, name, &mut session, id, things)?;
    }
    Ok(())
}

/// Measures what opening consists of, each stage alone.
fn stages(out: &mut impl Write, name: &str, text: &str) -> std::io::Result<()> {
    let parse = least(|| timed(|| syntax::parse(base::FileId(0), text)).0);
    let lower = least(|| timed(|| lang::lower(text, &|_| None, None)).0);
    let lowered = lang::lower(text, &|_| None, None);
    let document = &lowered.document;
    let before = resident();
    let (structure, faults) = kernel::instantiate(document);
    assert!(faults.is_empty(), "the document has no faults: {faults:?}");
    let kernel_bytes = resident() - before;
    let model = Model { document, structure: &structure };
    let mut values = Values::new(structure.slots.len());
    let (mut planner, _) = Planner::new(model, Plans::default());
    planner.open(model, &mut values, &mut Zero);
    planner.status(model, &values, &mut Zero);
    let plan_bytes = resident() - before - kernel_bytes;
    let counts = planner.plan_counts();
    let make = least(|| timed(|| kernel::instantiate(document)).0);
    let mut plans = planner.into_plans();
    let (mut rules, mut open, mut status) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..TIMES {
        let (time, (mut planner, _)) = timed(|| Planner::new(model, std::mem::take(&mut plans)));
        rules.push(time);
        open.push(timed(|| planner.open(model, &mut values, &mut Zero)).0);
        status.push(timed(|| planner.status(model, &values, &mut Zero)).0);
        plans = planner.into_plans();
    }
    let of = |times: Vec<f64>| times.into_iter().fold(f64::INFINITY, f64::min);
    let slots = structure.slots.len() as f64;
    writeln!(
        out,
        "{name:8} parse {parse:.1}  lower {lower:.1}  instantiate {make:.1}  rules {:.1}  \
         solve {:.1}  status {:.1} ms; {} planned, {} reused; \
         bytes a number: kernel {:.0}, plan and values {:.0}",
        of(rules),
        of(open),
        of(status),
        counts.planned,
        counts.reused,
        kernel_bytes / slots,
        plan_bytes / slots,
    )
}

/// Measures what a person waits for who edits the text.
fn edits(
    out: &mut impl Write,
    name: &str,
    text: &str,
    [one, other]: [&str; 2],
) -> std::io::Result<(Session, DocumentId)> {
    let merge = format!("merge {one}.left = {other}.right\n");
    // what a hand types on the way to another number, right at every key
    let typed = match text.contains("w17: Widget { left = 17 ") {
        true => text.replace("w17: Widget { left = 17 ", "w17: Widget { left = 178 "),
        false => text.replace("width: Real = 30", "width: Real = 301"),
    };
    let half = typed.replace("left = 178 ", "left =  ").replace("Real = 301", "Real = ");
    let open_it = || {
        let mut session = Session::new(Box::new(Nothing));
        let id = session.open(name, text);
        (session, id)
    };
    let open = least(|| timed(open_it).0);
    let (mut session, id) = open_it();
    assert!(session.status(id).satisfied, "the widgets are satisfied");
    let mut apply = |command: &Command| {
        let (time, change) = timed(|| session.apply(id, command));
        assert!(change.is_ok(), "the edit is accepted: {change:?}");
        time
    };
    let class = Command::Text(text.replace("width * height", "width * height / 2"));
    let merged = Command::Text(format!("{text}{merge}"));
    let was = Command::Text(text.into());
    let (typed, half) = (Command::Text(typed), Command::Text(half));
    let (mut classes, mut merges, mut unmerges) = (Vec::new(), Vec::new(), Vec::new());
    let (mut keys, mut wrong_keys) = (Vec::new(), Vec::new());
    for _ in 0..TIMES {
        classes.push(apply(&class));
        apply(&was);
        merges.push(apply(&merged));
        unmerges.push(apply(&was));
        keys.push(apply(&typed));
        wrong_keys.push(apply(&half));
        apply(&was);
    }
    let of = |times: Vec<f64>| times.into_iter().fold(f64::INFINITY, f64::min);
    writeln!(
        out,
        "{name:8} open {open:.1}  edit of the class {:.1} (goal 200)  merge {:.1}  unmerge {:.1} \
         (goal 20)  key {:.1}  wrong key {:.1}  values {:.1}  structure {:.1}  picture {:.1} ms",
        of(classes),
        of(merges),
        of(unmerges),
        of(keys),
        of(wrong_keys),
        least(|| timed(|| session.values(id)).0),
        least(|| timed(|| session.structure(id)).0),
        least(|| timed(|| session.picture(id)).0),
    )?;
    Ok((session, id))
}

/// Measures what a hand does to one number, and taking it back; to two, and parting them.
fn hands(
    out: &mut impl Write,
    name: &str,
    session: &mut Session,
    id: DocumentId,
    [thing, other]: [&str; 2],
) -> std::io::Result<()> {
    let at = |path: String| session::parse_path(&path).expect("the path is well formed");
    let (path, to) = (at(format!("{thing}.left")), at(format!("{other}.left")));
    let (merge, unmerge) = (Command::Merge(vec![path.clone(), to.clone()]), Command::Unmerge(to));
    let mut times: Vec<[f64; 8]> = Vec::new();
    for i in 0..TIMES {
        let x = 50.0 + i as f64;
        let set = Command::Set(vec![(path.clone(), Literal::Number(x))]);
        let (set, change) = timed(|| session.apply(id, &set));
        assert!(change.is_ok(), "the number can be set: {change:?}");
        let (undo, _) = timed(|| session.apply(id, &Command::Undo));
        let (press, pressed) = timed(|| session.press(id, &path));
        assert!(pressed.is_ok(), "the number can be dragged: {pressed:?}");
        session.drag(id, (x, 0.0));
        let (drag, dragged) = timed(|| session.drag(id, (x + 0.5, 0.0)));
        assert!(dragged.reached, "the number follows: {dragged:?}");
        let (release, change) = timed(|| session.release(id));
        assert!(change.is_ok(), "the drag is kept: {change:?}");
        let (again, _) = timed(|| session.apply(id, &Command::Undo));
        let [merged, parted] = merge_and_part(session, id, &merge, &unmerge);
        times.push([set, undo, press, drag, release, again, merged, parted]);
    }
    let least = |i: usize| times.iter().map(|t| t[i]).fold(f64::INFINITY, f64::min);
    parts_computed(out, name, session, id, [thing, other])?;
    writeln!(
        out,
        "{name:8} set {:.1}  undo {:.1}  press {:.2}  drag {:.4}  release {:.1}  undo {:.1}  merge {:.1}  \
         unmerge {:.1} (goal 20) ms",
        least(0),
        least(1),
        least(2),
        least(3),
        least(4),
        least(5),
        least(6),
        least(7),
    )
}

/// Measures a merge and an unmerge, in milliseconds, and takes both back.
fn merge_and_part(
    session: &mut Session,
    id: DocumentId,
    merge: &Command,
    unmerge: &Command,
) -> [f64; 2] {
    let (merged, change) = timed(|| session.apply(id, merge));
    assert!(change.is_ok(), "the numbers can be one: {change:?}");
    let (parted, change) = timed(|| session.apply(id, unmerge));
    assert!(change.is_ok(), "they can be parted: {change:?}");
    session.apply(id, &Command::Undo).expect("there is a step");
    session.apply(id, &Command::Undo).expect("there is another");
    [merged, parted]
}

/// Measures what a hand waits for that merges a given number with a computed one, which makes a given number
/// of the other thing yield, and parts them again, by either path.
fn parts_computed(
    out: &mut impl Write,
    name: &str,
    session: &mut Session,
    id: DocumentId,
    [thing, other]: [&str; 2],
) -> std::io::Result<()> {
    let at = |path: String| session::parse_path(&path).expect("the path is well formed");
    let paths = vec![at(format!("{thing}.left")), at(format!("{other}.right"))];
    let merge = Command::Merge(paths.clone());
    let mut times = [f64::INFINITY; 3];
    for _ in 0..TIMES {
        for (i, path) in paths.iter().enumerate() {
            let unmerge = Command::Unmerge(path.clone());
            let [merged, parted] = merge_and_part(session, id, &merge, &unmerge);
            times[0] = times[0].min(merged);
            times[1 + i] = times[1 + i].min(parted);
        }
    }
    let [merged, given, computed] = times;
    writeln!(
        out,
        "{name:8} given with computed: merge {merged:.1}  unmerge the given {given:.1}, the computed \
         {computed:.1} (goal 20) ms",
    )
}

/// Answers for given values: all that widgets have are numbers.
struct Zero;

impl plan::Host for Zero {
    fn given(&mut self, _: kernel::SlotId, _: &Values) -> Option<kernel::Value> {
        Some(kernel::Value::Number(1.0))
    }
    fn compute(
        &mut self,
        _: kernel::ConstraintInstance,
        _: plan::Way,
        _: &Values,
    ) -> Result<Vec<(kernel::SlotId, kernel::Value)>, String> {
        Err("widgets have no methods of the host".into())
    }
    fn number(
        &mut self,
        _: kernel::ConstraintInstance,
        _: plan::SideOf,
        _: &Values,
    ) -> Result<f64, String> {
        Err("widgets have no texts".into())
    }
    fn holds(&mut self, _: kernel::ConstraintInstance, _: &Values) -> bool {
        false
    }
}

/// Runs something once and returns how many milliseconds it took.
fn timed<T>(run: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = run();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

/// Returns the least of several times.
fn least(mut time: impl FnMut() -> f64) -> f64 {
    (0..TIMES).map(|_| time()).fold(f64::INFINITY, f64::min)
}

/// Returns how many bytes of the process are in memory; 0 where that is not told.
fn resident() -> f64 {
    let told = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = told.split(' ').nth(1).and_then(|n| n.parse::<f64>().ok());
    pages.unwrap_or(0.0) * 4096.0
}
