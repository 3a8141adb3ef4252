//! Ten thousand things: what opening and editing them costs, stage by stage.
//!
//! The things are instances of one class with ten numbers and six constraints, once as elements of a
//! list and once as members written one by one. In: nothing. Out: a table of milliseconds, and of
//! the bytes that the process grew by for each number.

use kernel::{DOCUMENT, Values};
use plan::{Model, Planner, Plans};
use session::{Command, Host, Session};
use std::fmt::Write as _;
use std::fs;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

/// How many things.
const THINGS: usize = 10_000;

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
    let merge =
        ["merge widgets[17].left = widgets[4711].right\n", "merge w17.left = w4711.right\n"];
    for (name, text, merge) in [("listed", &listed, merge[0]), ("written", &written, merge[1])] {
        stages(out, name, text)?;
        edits(out, name, text, merge)?;
    }
    Ok(())
}

/// Measures what opening consists of, each stage alone.
fn stages(out: &mut impl Write, name: &str, text: &str) -> std::io::Result<()> {
    let (parse, _) = timed(|| syntax::parse(base::FileId(0), text));
    let (lower, lowered) = timed(|| lang::lower(text, &|_| None, None));
    let document = &lowered.document;
    let before = resident();
    let (make, (structure, faults)) = timed(|| kernel::instantiate(document));
    assert!(faults.is_empty(), "the document has no faults: {faults:?}");
    let model = Model { document, structure: &structure };
    let kernel_bytes = resident() - before;
    let (plan, (mut planner, _)) = timed(|| Planner::new(model, Plans::default()));
    let mut values = Values::new(structure.slots.len());
    let mut host = Zero;
    let (open, _) = timed(|| planner.open(model, &mut values, &mut host));
    let (again, _) = timed(|| planner.open(model, &mut values, &mut host));
    let plan_bytes = resident() - before - kernel_bytes;
    let counts = planner.plan_counts();
    let slots = structure.slots.len() as f64;
    black_box(structure.parts(DOCUMENT).len());
    writeln!(
        out,
        "{name:8} parse {parse:.1}  lower {lower:.1}  instantiate {make:.1}  rules {plan:.1}  \
         plan and solve {open:.1}, again {again:.1} ms; {} planned, {} reused; \
         bytes a number: kernel {:.0}, plan {:.0}",
        counts.planned,
        counts.reused,
        kernel_bytes / slots,
        plan_bytes / slots,
    )
}

/// Measures what a person waits for.
fn edits(out: &mut impl Write, name: &str, text: &str, merge: &str) -> std::io::Result<()> {
    let mut session = Session::new(Box::new(Nothing));
    let (open, id) = timed(|| session.open(name, text));
    assert!(session.status(id).satisfied, "the widgets are satisfied");
    let mut apply = |command: &Command| {
        let (time, change) = timed(|| session.apply(id, command));
        assert!(change.is_ok(), "the edit is accepted: {change:?}");
        time
    };
    let class = text.replace("area = width * height", "area = width * height / 2");
    let class = apply(&Command::Text(class));
    apply(&Command::Undo);
    let merged = apply(&Command::Text(format!("{text}{merge}")));
    let apart = apply(&Command::Text(text.into()));
    let (values, _) = timed(|| session.values(id));
    let (structure, _) = timed(|| session.structure(id));
    let (status, _) = timed(|| session.status(id));
    let (picture, _) = timed(|| session.picture(id));
    writeln!(
        out,
        "{name:8} open {open:.1}  edit the class {class:.1}  merge {merged:.1}  \
         unmerge {apart:.1}  values {values:.1}  structure {structure:.1}  status {status:.1}  \
         picture {picture:.1} ms",
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

/// Returns how many bytes of the process are in memory; 0 where that is not told.
fn resident() -> f64 {
    let told = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = told.split(' ').nth(1).and_then(|n| n.parse::<f64>().ok());
    pages.unwrap_or(0.0) * 4096.0
}
