//! Random programs with blocks in blocks, branches, calls and patterns, into which steps are inserted, in which they are
//! replaced and from which they are deleted: what is not spoken to stays what it is.

use crate::desk::Desk;
use base::Dice;
use session::drafting::view::{Go, StepRow, Turn, Wants};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// How many programs are made, and how often each is changed.
const PROGRAMS: u64 = 8;
const CHANGES: usize = 10;

const HEAD: &str = "use contours
unit mm
program Sub(u: Length = 4 mm, v: Length = 7 mm) {
    far = Point(u, v)
    rim = Circle(center: far, radius: abs(u) + 1 mm)
}
program Part(a: Length = 13 mm, b: Length = 5 mm, n: Integer in 1..6 = 3) {
";

/// What a step made can be used as.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Place,
    Length,
    Circle,
}

/// A program in the making.
struct Made {
    dice: Dice,
    text: String,
    steps: u32,
}

type Names = Vec<(String, Kind)>;

impl Made {
    fn one(&mut self, names: &Names, kind: Kind) -> Option<String> {
        let fit: Vec<&String> = names.iter().filter(|(_, k)| *k == kind).map(|(n, _)| n).collect();
        (!fit.is_empty()).then(|| fit[self.dice.below(fit.len())].clone())
    }
    fn length(&mut self, names: &Names) -> String {
        let k = 1 + self.dice.below(90);
        match (self.dice.below(3), self.one(names, Kind::Length)) {
            (0, _) | (_, None) => format!("{k} mm"),
            (1, Some(name)) => name,
            (_, Some(name)) => format!("{name} + {k} mm"),
        }
    }
    fn place(&mut self, names: &Names) -> String {
        match (self.dice.below(3), self.one(names, Kind::Place)) {
            (0, _) | (_, None) => format!("Point({}, {})", self.length(names), self.length(names)),
            (_, Some(name)) => name,
        }
    }
    fn circle(&mut self, names: &Names, depth: usize) -> String {
        let radius = self.length(names);
        if let (true, Some(with)) = (self.dice.below(2) == 0, self.one(names, Kind::Circle)) {
            return format!("Circle.concentric(with: {with}, radius: abs({radius}) + {depth} mm)");
        }
        format!("Circle(center: {}, radius: abs({radius}) + 1 mm)", self.place(names))
    }
    fn line(&mut self, depth: usize, line: &str) {
        let _ = writeln!(self.text, "{}{line}", "    ".repeat(depth));
    }
    /// Writes a step `depth` blocks deep; what it made is known from then on.
    fn step(&mut self, names: &mut Names, depth: usize) {
        self.steps += 1;
        let n = self.steps;
        match self.dice.below(if depth > 2 { 6 } else { 11 }) {
            0 => {
                let value = self.length(names);
                self.line(depth, &format!("v{n} = {value}"));
                names.push((format!("v{n}"), Kind::Length));
            }
            1 => {
                let (x, y) = (self.length(names), self.length(names));
                self.line(depth, &format!("p{n} = Point({x}, {y})"));
                names.push((format!("p{n}"), Kind::Place));
            }
            2 => {
                let (from, to) = (self.place(names), self.length(names));
                self.line(depth, &format!("l{n} = Line.horizontal(from: {from}, length: {to})"));
                names.extend([
                    (format!("l{n}.p2"), Kind::Place),
                    (format!("l{n}.length"), Kind::Length),
                ]);
            }
            3 => {
                let (u, v) = (self.length(names), self.length(names));
                self.line(depth, &format!("s{n} = Sub(u: {u}, v: {v})"));
                names.extend([
                    (format!("s{n}.far"), Kind::Place),
                    (format!("s{n}.rim"), Kind::Circle),
                ]);
            }
            4 | 5 => {
                let circle = self.circle(names, depth);
                self.line(depth, &format!("c{n} = {circle}"));
                names.extend([
                    (format!("c{n}"), Kind::Circle),
                    (format!("c{n}.center"), Kind::Place),
                    (format!("c{n}.radius"), Kind::Length),
                ]);
            }
            6 => {
                let (a, b) = (self.length(names), self.length(names));
                self.line(depth, &format!("if {a} > {b} - {n} mm {{"));
                self.branch(names, depth, n);
                self.line(depth, "} else {");
                self.branch(names, depth, n);
                self.line(depth, "}");
                names.push((format!("x{n}"), Kind::Circle));
            }
            7 => self.turns(names, depth, n, "repeat n times", ""),
            8 => self.turns(names, depth, n, "repeat", &format!(" until k{n} > 60 mm")),
            9 => self.turns(names, depth, n, &format!("while k{n} < 2000 mm"), ""),
            _ => self.each(names, depth, n),
        }
    }
    fn block(&mut self, names: &Names, depth: usize) -> Names {
        let mut inner = names.clone();
        for _ in 0..self.dice.below(3) {
            self.step(&mut inner, depth + 1);
        }
        inner
    }
    fn branch(&mut self, names: &Names, depth: usize, n: u32) {
        let inner = self.block(names, depth);
        let circle = self.circle(&inner, depth);
        self.line(depth + 1, &format!("x{n} = {circle}"));
    }
    fn turns(&mut self, names: &mut Names, depth: usize, n: u32, head: &str, end: &str) {
        let (first, at) = (self.length(names), self.place(names));
        self.line(depth, &format!("t{n} = {head} with k{n} = abs({first}) + 9 mm, q{n} = {at} {{"));
        let mut inner = names.clone();
        inner.extend([(format!("k{n}"), Kind::Length), (format!("q{n}"), Kind::Place)]);
        let mut inner = self.block(&inner, depth);
        inner.extend([(format!("k{n}"), Kind::Length), (format!("q{n}"), Kind::Place)]);
        self.line(depth + 1, &format!("y{n} = Circle(center: q{n}, radius: k{n})"));
        inner.push((format!("y{n}.center"), Kind::Place));
        let next = self.place(&inner);
        self.line(depth + 1, &format!("next k{n} = 2 * k{n}, q{n} = {next}"));
        self.line(depth, &format!("}}{end}"));
        names.extend([
            (format!("t{n}.last.y{n}"), Kind::Circle),
            (format!("t{n}[0].y{n}.center"), Kind::Place),
        ]);
    }
    fn each(&mut self, names: &mut Names, depth: usize, n: u32) {
        let Some(one) = self.one(names, Kind::Circle) else { return };
        let other = self.one(names, Kind::Circle).unwrap_or_else(|| one.clone());
        self.line(depth, &format!("f{n} = for e{n} in [{one}, {other}] {{"));
        let mut inner = names.clone();
        inner.extend([(format!("e{n}"), Kind::Circle), (format!("e{n}.center"), Kind::Place)]);
        let inner = self.block(&inner, depth);
        let circle = self.circle(&inner, depth);
        self.line(depth + 1, &format!("z{n} = {circle}"));
        self.line(depth, "}");
        names.push((format!("f{n}.last.z{n}"), Kind::Circle));
    }
}

fn document(seed: u64) -> String {
    let mut made = Made { dice: Dice::new(seed), text: HEAD.into(), steps: 0 };
    let mut names: Names = ["a", "b"].map(|name| (name.to_string(), Kind::Length)).into();
    for _ in 0..4 + made.dice.below(4) {
        made.step(&mut names, 1);
    }
    made.text + "}\npart: Part\n"
}

/// What a step says and what it made, with its address now.
struct Told {
    path: String,
    formula: String,
    value: Option<String>,
}

/// What each step says and what it made. A block without a name is told by what it says, as its number follows those
/// before it.
fn told(desk: &Desk) -> BTreeMap<String, Told> {
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let mut lasting: BTreeMap<String, String> = BTreeMap::new();
    let mut found = BTreeMap::new();
    for StepRow { path, name, formula, value, .. } in rows {
        let (around, own) = path.rsplit_once('.').unwrap_or(("", &path));
        let around = lasting.get(around).cloned().unwrap_or_default();
        let is_branch = own == "else";
        let own = if name.is_empty() && !is_branch { format!("<{formula}>") } else { own.into() };
        let key = format!("{around}/{own}");
        if name.is_empty() && !is_branch {
            lasting.insert(format!("{path}.then"), format!("{key}/then"));
        }
        lasting.insert(path.clone(), key.clone());
        if !is_branch {
            let earlier = found.insert(key, Told { path, formula, value });
            assert!(earlier.is_none(), "two steps are told alike: {}", desk.text());
        }
    }
    found
}

/// The steps that may come to something else once some are changed: what speaks of them, and what is in that.
fn reached(desk: &Desk, touched: &BTreeSet<String>) -> BTreeSet<String> {
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let mut all = touched.clone();
    let mut open: Vec<String> = touched.iter().cloned().collect();
    while let Some(step) = open.pop() {
        let users = desk.session.step_dependents(desk.id, "Part", &step);
        let within = format!("{step}.");
        let inside = rows.iter().map(|row| &row.path).filter(|path| path.starts_with(&within));
        for next in users.into_iter().chain(inside.cloned()) {
            if all.insert(next.clone()) {
                open.push(next);
            }
        }
    }
    all
}

/// Begins a construction and gives it whatever it takes of what there is; returns what was drawn.
fn draw(desk: &mut Desk, dice: &mut Dice) -> Option<String> {
    const TOOLS: [&str; 8] = [
        "Circle",
        "Circle.concentric(with,radius)",
        "Line",
        "Point.middle(first,second)",
        "value",
        "Sub",
        ":pattern(about,count)",
        "Point:mirrored",
    ];
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    desk.session.begin(desk.id, TOOLS[dice.below(TOOLS.len())]).expect("it is in scope");
    for _ in 0..60 {
        let typed = match dice.below(8) {
            0 => format!("{}", 2 + dice.below(4)),
            1 => format!("{},{}", dice.below(90), dice.below(90)),
            2 => format!("Axis.vertical(x: {} mm)", dice.below(90)),
            3 => ["a", "b", "n"][dice.below(3)].to_string(),
            _ => {
                let row = &rows[dice.below(rows.len())];
                let names = row
                    .path
                    .split('.')
                    .filter(|s| !s.starts_with('#') && *s != "then" && *s != "else");
                let names: Vec<&str> = names.skip(dice.below(2)).collect();
                let part = ["", "", ".center", ".radius", ".p2", ".far"][dice.below(6)];
                format!("{}{part}", names.join(".last."))
            }
        };
        match desk.session.enter(desk.id, &typed) {
            Ok(Turn::Made { name, .. }) => return Some(name),
            Ok(Turn::Wants(_)) | Err(_) => {}
        }
    }
    desk.session.give_up(desk.id);
    None
}

/// Deletes a step; of what speaks of it some is given another object, and the rest goes along. Returns what was asked
/// about.
fn delete(desk: &mut Desk, dice: &mut Dice, step: &str) -> BTreeSet<String> {
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let foretold = desk.session.step_dependents(desk.id, "Part", step);
    desk.session.begin_delete(desk.id, step).unwrap_or_else(|r| panic!("{step}: {}", r.message));
    let mut touched = BTreeSet::from([step.to_string()]);
    while let Some(prompt) = desk.session.prompt(desk.id) {
        let Wants::Substitute { step: user, .. } = prompt.wants else { panic!("{prompt:?}") };
        let is_told = |told: &String| user == *told || user.starts_with(&format!("{told}."));
        assert!(foretold.iter().any(is_told), "{user} was not told: {foretold:?}");
        let is_given = (0..dice.below(6)).any(|_| {
            let row = &rows[dice.below(rows.len())];
            let part = ["", "", ".center", ".radius", ".p2"][dice.below(5)];
            let typed = format!("{}{part}", row.name);
            // where the last answer leaves no program the whole is refused, and nothing is deleted
            desk.session.enter(desk.id, &typed).is_ok() || desk.session.prompt(desk.id).is_none()
        });
        if !is_given && desk.session.delete_along(desk.id).is_err() {
            assert_eq!(desk.session.prompt(desk.id), None, "it was asked");
        }
        touched.insert(user);
    }
    touched
}

/// Draws an `if` with a figure in both branches.
fn draw_branches(desk: &mut Desk, condition: &str) {
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, condition).expect("it is a condition");
    for branch in ["then", "else"] {
        desk.session.begin(desk.id, "Circle").expect("it is in scope");
        for typed in ["3,4", "b"] {
            desk.session.enter(desk.id, typed).expect("it fits");
        }
        desk.session.give_up(desk.id);
        if branch == "then" {
            desk.session.otherwise(desk.id).expect("the first branch is drawn");
            desk.session.other_branch(desk.id, true).expect("with the same values");
        }
    }
    desk.session.end_choice(desk.id).expect("it is open");
}

/// Changes a program at random; returns the steps that the change was told to touch.
fn change(desk: &mut Desk, dice: &mut Dice, round: usize) -> BTreeSet<String> {
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let rows: Vec<StepRow> = rows.into_iter().filter(|row| row.words != "otherwise").collect();
    let Some(row) = rows.get(dice.below(rows.len().max(1))) else { return BTreeSet::new() };
    let to = Go::To(row.path.clone());
    match dice.below(6) {
        0 | 1 if !row.is_block => {
            desk.session.begin_replace(desk.id, &row.path).expect("it is a step");
            draw(desk, dice).map(|_| row.path.clone()).into_iter().collect()
        }
        2 | 3 => delete(desk, dice, &row.path),
        4 => {
            desk.session.visit(desk.id, &to).expect("there is such a place");
            draw_branches(desk, &format!("a > {round} mm"));
            BTreeSet::new()
        }
        _ => {
            desk.session.visit(desk.id, &to).expect("there is such a place");
            draw(desk, dice);
            BTreeSet::new()
        }
    }
}

/// Whether a step is one of those that are told, or in one of them.
fn is_within(step: &str, told: &BTreeSet<String>) -> bool {
    told.iter().any(|t| step == t || step.starts_with(&format!("{t}.")))
}

/// How many turns a loop took, whether it says that or which of them is visited.
fn counted(value: &str) -> String {
    match value.strip_prefix("turn ").and_then(|rest| rest.split_once(" of ")) {
        Some((_, "1")) => "1 turn".into(),
        Some((_, all)) => format!("{all} turns"),
        None => value.into(),
    }
}

#[test]
fn what_a_change_is_not_told_to_touch_stays_what_it_is() {
    let (mut programs, mut changed, mut compared) = (0, 0, 0);
    for seed in 1..=PROGRAMS {
        let mut dice = Dice::new(seed);
        let mut desk = Desk::of(&document(seed));
        if !desk.wrong().is_empty() {
            continue;
        }
        programs += 1;
        desk.session.record(desk.id, "Part").expect("it goes on");
        for round in 0..CHANGES {
            let (moment, before) = (desk.moment(), told(&desk));
            let steps = desk.session.history(desk.id).0.len();
            let touched = change(&mut desk, &mut dice, round);
            desk.session.give_up(desk.id);
            let at = format!("{seed}.{round}, {touched:?}\n{}\n---\n{}", moment.0, desk.text());
            // a run may end early by what is drawn now; the text is well formed
            let wrong: Vec<_> = desk.wrong().into_iter().filter(|w| w.0 != "run-ended").collect();
            assert_eq!(wrong, [], "{at}");
            let (after, done) = (told(&desk), desk.moment());
            let undo = desk.session.history(desk.id).0.len() - steps;
            assert!(undo <= 1, "one action is one step: {at}");
            if undo == 0 {
                assert_eq!(done, moment, "{at}");
                continue;
            }
            changed += 1;
            desk.undo();
            assert_eq!(desk.moment(), moment, "undo is exact: {at}");
            let may_change = reached(&desk, &touched);
            desk.redo();
            assert_eq!(desk.moment(), done, "redo is exact: {at}");
            let is_whole = after.iter().all(|(key, now)| {
                now.value.is_some() || before.get(key).is_none_or(|was| was.value.is_none())
            });
            for (key, was) in before.iter().filter(|(_, was)| !is_within(&was.path, &touched)) {
                let now = after.get(key).unwrap_or_else(|| panic!("{key} is gone: {at}"));
                assert_eq!(now.formula, was.formula, "{key}: {at}");
                // how many figures a whole block has is told of it
                let counts = was.value.as_ref().is_some_and(|value| value.contains(" figure"));
                if is_whole && !may_change.contains(&was.path) && !counts {
                    let [now, was] = [now, was].map(|row| row.value.as_deref().map(counted));
                    assert_eq!(now, was, "{key}: {at}");
                    compared += 1;
                }
            }
        }
    }
    assert!(2 * programs > PROGRAMS, "{programs}");
    assert!(changed > 5 * programs as usize && compared > 8 * changed, "{changed} {compared}");
}
