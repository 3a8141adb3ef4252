//! Random structural commands against a naive model.
//!
//! The model knows nothing of texts, slots or plans: parts with a class, merges as lists of paths, a
//! number for every path that ends at one. After every command it works out from scratch which paths
//! are one, and the session has to show the same: the same parts, merged in the same way, of the same
//! values, refused where the model refuses. Undo and redo are exact, and a document opened from the
//! text of an edited one is the same, bit for bit.
//!
//! `THINGLAB_LONG` makes it 10 000 steps. A seed that once failed is kept.

use base::Dice;
use session::view::Status;
use session::{Command, DocumentId, Host, Literal, Path, Session, parse_path};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

struct Nothing;

impl Host for Nothing {
    fn read(&self, _: &str) -> Option<String> {
        None
    }
}

/// Seeds that showed a fault once.
const KEPT: [u64; 2] = [3, 11];

const CLASSES: &str = "class Spot { x: Real = 3  y: Real = 4 }
class Bar { p: Spot  q: Spot = (5, 6) }
class Node { a: Real = 1  b: Real = 2  c: Real = 7  s: Spot }
class Frame { left: Bar  right: Bar }
";

/// What a part is.
#[derive(Clone, PartialEq, Debug)]
enum Shape {
    Number(f64),
    /// A thing of a class, by its name.
    Thing(&'static str),
}

type Names = Vec<String>;

#[derive(Clone, PartialEq, Debug)]
struct Model {
    /// The fields of every class.
    classes: BTreeMap<&'static str, Vec<(String, Shape)>>,
    /// The parts of the document, in order.
    parts: Vec<(String, &'static str)>,
    /// What the document, and the bodies in it, merge.
    merges: Vec<Vec<Names>>,
    /// What classes merge, from a thing of the class.
    class_merges: Vec<(&'static str, Vec<Names>)>,
    /// The numbers that the document itself gives.
    written: BTreeMap<Names, f64>,
    /// The number at every path.
    values: BTreeMap<Names, f64>,
    made: u32,
}

fn names(path: &str) -> Names {
    path.split('.').map(str::to_string).collect()
}

impl Model {
    fn new() -> Self {
        let number = |name: &str, x| (name.to_string(), Shape::Number(x));
        let thing = |name: &str, class| (name.to_string(), Shape::Thing(class));
        let node = vec![number("a", 1.0), number("b", 2.0), number("c", 7.0), thing("s", "Spot")];
        let classes = BTreeMap::from([
            ("Spot", vec![number("x", 3.0), number("y", 4.0)]),
            ("Bar", vec![thing("p", "Spot"), thing("q", "Spot")]),
            ("Node", node),
            ("Frame", vec![thing("left", "Bar"), thing("right", "Bar")]),
        ]);
        let (parts, merges) = (Vec::new(), Vec::new());
        let (class_merges, values) = (Vec::new(), BTreeMap::new());
        let written = BTreeMap::new();
        Self { classes, parts, merges, class_merges, written, values, made: 0 }
    }

    /// Every path below a thing, its own included, in order of declaration, with its class.
    fn below(&self, path: &Names, class: &'static str, out: &mut Vec<(Names, Shape)>) {
        out.push((path.clone(), Shape::Thing(class)));
        for (name, shape) in &self.classes[class] {
            let path: Names = path.iter().chain([name]).cloned().collect();
            match shape {
                Shape::Number(_) => out.push((path, shape.clone())),
                Shape::Thing(class) => self.below(&path, class, out),
            }
        }
    }
    fn all(&self) -> Vec<(Names, Shape)> {
        let mut out = Vec::new();
        for (name, class) in &self.parts {
            self.below(&vec![name.clone()], class, &mut out);
        }
        out
    }
    fn leaves(&self) -> Vec<Names> {
        let numbers = self.all().into_iter().filter(|(_, s)| matches!(s, Shape::Number(_)));
        numbers.map(|(path, _)| path).collect()
    }
    /// The things of a class, by their paths.
    fn things(&self, class: &str) -> Vec<Names> {
        let of = |s: &Shape| matches!(s, Shape::Thing(c) if *c == class);
        self.all().into_iter().filter(|(_, s)| of(s)).map(|(path, _)| path).collect()
    }

    /// For every leaf, the first leaf that it is one with: worked out from nothing, over and over.
    fn groups(&self) -> BTreeMap<Names, Names> {
        let leaves = self.leaves();
        let rank: BTreeMap<&Names, usize> =
            leaves.iter().enumerate().map(|(i, p)| (p, i)).collect();
        let mut first: BTreeMap<Names, Names> =
            leaves.iter().map(|p| (p.clone(), p.clone())).collect();
        let mut merges = self.merges.clone();
        for (class, paths) in &self.class_merges {
            for thing in self.things(class) {
                let at = |p: &Names| thing.iter().chain(p).cloned().collect::<Names>();
                merges.push(paths.iter().map(at).collect());
            }
        }
        let mut changed = true;
        while std::mem::take(&mut changed) {
            for merge in &merges {
                for leaf in leaves.iter().filter(|l| l.starts_with(&merge[0])) {
                    let rest = &leaf[merge[0].len()..];
                    for other in &merge[1..] {
                        let other: Names = other.iter().chain(rest).cloned().collect();
                        let Some(b) = first.get(&other).cloned() else { continue };
                        let a = first[leaf].clone();
                        if a != b {
                            let (least, most) = if rank[&a] < rank[&b] { (a, b) } else { (b, a) };
                            for f in first.values_mut().filter(|f| **f == most) {
                                *f = least.clone();
                            }
                            changed = true;
                        }
                    }
                }
            }
        }
        first
    }
    /// What a leaf is given by itself, and how deep that stands: the document's own word stands furthest out.
    fn given(&self, path: &Names, default: f64) -> (usize, f64) {
        if let Some(&x) = self.written.get(path) {
            return (0, x);
        }
        // the far end of a bar has a value of its own, which Bar says
        let far = path.len() >= 2 && path[path.len() - 2] == "q";
        match (far, path.last().map(String::as_str)) {
            (true, Some("x")) => (path.len() - 2, 5.0),
            (true, Some("y")) => (path.len() - 2, 6.0),
            _ => (path.len() - 1, default),
        }
    }
    /// For every leaf that is the first of those it is one with: the one that counts, and what it gives.
    fn counting(&self) -> BTreeMap<Names, (Names, f64)> {
        let groups = self.groups();
        let mut counting: BTreeMap<Names, (usize, Names, f64)> = BTreeMap::new();
        for (path, shape) in self.all() {
            let Shape::Number(default) = shape else { continue };
            let (depth, x) = self.given(&path, default);
            let first = &groups[&path];
            if counting.get(first).is_none_or(|(least, ..)| depth < *least) {
                counting.insert(first.clone(), (depth, path, x));
            }
        }
        counting.into_iter().map(|(first, (_, path, x))| (first, (path, x))).collect()
    }
    /// Gives every leaf the value that counts.
    fn settle(&mut self) {
        let (counting, groups) = (self.counting(), self.groups());
        self.written.retain(|path, _| groups.contains_key(path));
        let values = groups.into_iter().map(|(leaf, first)| (leaf, counting[&first].1));
        self.values = values.collect();
    }
    /// Writes what keeps the values as they are: where it is written already, else at the first path; a spot
    /// as a whole, but for one of which its class gives a number that stays as it is.
    fn hold(&mut self) {
        let (wanted, counting, groups) = (self.values.clone(), self.counting(), self.groups());
        let written = self.written.clone();
        let stays = |leaf: &Names| {
            let (counts, x) = &counting[&groups[leaf]];
            let is_far = counts.len() >= 2 && counts[counts.len() - 2] == "q";
            let is_of_class = !written.contains_key(counts) && !is_far;
            is_of_class
                && counts.split_last().map(|c| c.1) == leaf.split_last().map(|l| l.1)
                && wanted[leaf] == *x
        };
        for (first, (counts, x)) in counting.clone() {
            if wanted[&first] == x {
                continue;
            }
            // beside the other number of a spot, where that is written of another that is one with it
            let beside = || {
                let (name, owner) = first.split_last()?;
                let other = if name == "x" { "y" } else { "x" };
                let of = |owner: &[String], name: &str| -> Names {
                    owner.iter().map(String::as_str).chain([name]).map(str::to_string).collect()
                };
                let (counts, _) = counting.get(groups.get(&of(owner, other))?)?;
                let is_written =
                    ["x", "y"].contains(&name.as_str()) && written.contains_key(counts);
                is_written.then(|| of(&counts[..counts.len() - 1], name))
            };
            let at = match self.written.contains_key(&counts) {
                true => counts,
                false => beside().unwrap_or_else(|| first.clone()),
            };
            let (name, owner) = at.split_last().expect("a leaf has a name");
            let is_place = ["x", "y"].contains(&name.as_str());
            let leaf = |name: &str| -> Names {
                owner.iter().map(String::as_str).chain([name]).map(str::to_string).collect()
            };
            let is_whole = is_place && !["x", "y"].into_iter().any(|name| stays(&leaf(name)));
            for name in if is_whole { vec!["x", "y"] } else { vec![name.as_str()] } {
                self.written.insert(leaf(name), wanted[&leaf(name)]);
            }
        }
        self.settle();
    }
    /// What the values view has to show.
    fn shown(&self) -> BTreeMap<String, u64> {
        let groups = self.groups();
        let first = groups.iter().filter(|(leaf, first)| leaf == first);
        first.map(|(leaf, _)| (leaf.join("."), self.values[leaf].to_bits())).collect()
    }
}

fn path(names: &Names) -> Path {
    parse_path(&names.join(".")).expect("the model's paths are well formed")
}

/// A command, and the model after it; no model where it has to be refused.
type Picked = Option<(Command, Option<Model>)>;

/// Picks a command, and returns what the model is after it; nothing where it has to be refused.
fn pick(dice: &mut Dice, model: &Model) -> Picked {
    let mut next = model.clone();
    next.made += 1;
    let fresh = format!("n{}", model.made);
    match dice.below(12) {
        0 | 1 => {
            let class = dice.one_of(&["Spot", "Bar", "Node", "Frame"])?;
            next.parts.push((fresh.clone(), class));
            next.settle();
            let members = format!("{fresh}: {class}");
            Some((Command::Edit { target: Path::default(), members }, Some(next)))
        }
        2 | 3 => {
            let leaf = dice.one_of(&model.leaves())?;
            let x = dice.below(400) as f64 / 4.0;
            let groups = model.groups();
            let alike = groups.iter().filter(|(_, first)| **first == groups[&leaf]);
            next.values.extend(alike.map(|(path, _)| (path.clone(), x)));
            next.hold();
            Some((Command::Set(vec![(path(&leaf), Literal::Number(x))]), Some(next)))
        }
        4 | 5 => {
            let class = dice.one_of(&["Spot", "Bar", "Node"])?;
            let things = model.things(class);
            let (a, b) = (dice.one_of(&things)?, dice.one_of(&things)?);
            let merge = Command::Merge(vec![path(&a), path(&b)]);
            if a == b {
                return None;
            }
            next.merges.push(vec![a, b]);
            next.settle();
            Some((merge, Some(next)))
        }
        6 | 7 => unmerge(dice, model, next),
        8 => delete(dice, model, next),
        9 => {
            let x = dice.below(40) as f64;
            let members = format!("{fresh}: Real = {x}");
            next.classes.get_mut("Node")?.push((fresh, Shape::Number(x)));
            next.settle();
            Some((Command::Edit { target: path(&names("Node")), members }, Some(next)))
        }
        10 => change_class(dice, model, next),
        _ => rename(dice, model, next, fresh),
    }
}

/// Takes a path out of the merges that name it; the rest of them all stay merged.
fn unmerge(dice: &mut Dice, model: &Model, mut next: Model) -> Picked {
    let in_class = |p: &Names| {
        model.class_merges.iter().any(|(_, paths)| paths.iter().any(|m| p.ends_with(m)))
    };
    let listed: Vec<Names> = model.merges.concat();
    let any = model.things("Spot");
    let p = if dice.below(4) > 0 { dice.one_of(&listed)? } else { dice.one_of(&any)? };
    if in_class(&p) {
        return None;
    }
    if !listed.contains(&p) {
        return Some((Command::Unmerge(path(&p)), None));
    }
    // what was one with it in any of them stays one
    let (of_it, others): (Vec<_>, Vec<_>) = next.merges.drain(..).partition(|m| m.contains(&p));
    let mut rest: Vec<Names> = of_it.concat();
    let mut known = BTreeSet::from([p.clone()]);
    rest.retain(|q| known.insert(q.clone()));
    next.merges = others;
    if rest.len() > 1 {
        next.merges.push(rest);
    }
    next.hold();
    Some((Command::Unmerge(path(&p)), Some(next)))
}

/// Deletes a part of the document.
fn delete(dice: &mut Dice, model: &Model, mut next: Model) -> Picked {
    let (name, _) = dice.one_of(&model.parts)?;
    next.parts.retain(|(n, _)| *n != name);
    for merge in &mut next.merges {
        merge.retain(|p| p[0] != name);
    }
    next.merges.retain(|m| m.len() > 1);
    next.hold();
    Some((Command::Delete(path(&vec![name])), Some(next)))
}

/// Deletes a field of a class, or merges two in it.
fn change_class(dice: &mut Dice, model: &Model, mut next: Model) -> Picked {
    if dice.below(2) == 0 {
        let fields = model.classes["Node"].clone();
        let (name, _) = dice.one_of(&fields[4..])?;
        next.classes.get_mut("Node")?.retain(|(n, _)| *n != name);
        next.hold();
        return Some((Command::Delete(path(&names(&format!("Node.{name}")))), Some(next)));
    }
    if !model.class_merges.is_empty() {
        return None;
    }
    let paths = vec![names("left.q"), names("right.p")];
    next.class_merges.push(("Frame", paths));
    next.settle();
    let merge = vec![path(&names("Frame.left.q")), path(&names("Frame.right.p"))];
    Some((Command::Merge(merge), Some(next)))
}

/// Renames a part, sometimes to a name that is taken.
fn rename(dice: &mut Dice, model: &Model, mut next: Model, fresh: String) -> Picked {
    let (name, _) = dice.one_of(&model.parts)?;
    let other = if dice.below(5) == 0 { dice.one_of(&model.parts)?.0 } else { fresh };
    let rename = Command::Rename { from: path(&vec![name.clone()]), to: other.clone() };
    if model.parts.iter().any(|(n, _)| *n == other) {
        return Some((rename, None));
    }
    let renamed = |p: &mut Names| {
        if p[0] == name {
            p[0] = other.clone();
        }
    };
    next.parts.iter_mut().filter(|(n, _)| *n == name).for_each(|p| p.0 = other.clone());
    next.merges.iter_mut().flatten().for_each(renamed);
    next.written = std::mem::take(&mut next.written)
        .into_iter()
        .map(|(mut p, x)| {
            renamed(&mut p);
            (p, x)
        })
        .collect();
    next.settle();
    Some((rename, Some(next)))
}

type Moment = (String, BTreeMap<String, u64>);

fn shown(session: &Session, id: DocumentId) -> BTreeMap<String, u64> {
    let rows = session.values(id).into_iter().filter(|r| !r.is_virtual);
    rows.filter_map(|r| Some((r.path, r.number?.to_bits()))).collect()
}

fn moment(session: &Session, id: DocumentId) -> Moment {
    (session.text(id).source, shown(session, id))
}

/// Runs one sequence of commands; returns what differs, with the commands that led there.
fn run(seed: u64, steps: usize) -> Result<usize, String> {
    let mut dice = Dice::new(seed);
    let mut session = Session::new(Box::new(Nothing));
    let id = session.open("model", CLASSES);
    let mut model = Model::new();
    let mut done: Vec<(Moment, Model)> = Vec::new();
    let mut undone: Vec<(Moment, Model)> = Vec::new();
    let mut log = String::new();
    let mut accepted = 0;
    for _ in 0..steps {
        let before = moment(&session, id);
        let (command, expected) = match dice.below(9) {
            0 => (Command::Undo, done.last().map(|(_, m)| m.clone())),
            1 => (Command::Redo, undone.last().map(|(_, m)| m.clone())),
            _ => match pick(&mut dice, &model) {
                Some(picked) => picked,
                None => continue,
            },
        };
        let _ = writeln!(log, "{command:?}");
        let fail = |what: String| format!("seed {seed}\n{log}{what}\n{}", before.0);
        let result = session.apply(id, &command);
        let after = moment(&session, id);
        let next = match (result, expected) {
            (Ok(_), Some(next)) => next,
            (Err(_), None) if after == before => continue,
            (Err(_), None) => return Err(fail("a refused command changed something".into())),
            (Ok(_), None) => return Err(fail("the session does what the model refuses".into())),
            (Err(r), Some(_)) => return Err(fail(format!("refused: {}", r.message))),
        };
        match command {
            Command::Undo | Command::Redo => {
                let (from, to) = match command {
                    Command::Undo => (&mut done, &mut undone),
                    _ => (&mut undone, &mut done),
                };
                let wanted = from.pop().map(|(m, _)| m);
                to.push((before.clone(), std::mem::replace(&mut model, next)));
                if wanted.as_ref() != Some(&after) {
                    return Err(fail("a step is not taken back as it was".into()));
                }
            }
            _ => {
                if after != before {
                    done.push((before.clone(), model));
                    undone.clear();
                }
                model = next;
            }
        }
        let wanted = model.shown();
        if wanted != after.1 {
            let differs = |(path, x): (&String, &u64)| {
                let found = after.1.get(path).map(|x| f64::from_bits(*x));
                (found.map(f64::to_bits) != Some(*x))
                    .then(|| format!("{path} is {found:?}, in the model {}\n", f64::from_bits(*x)))
            };
            let mut what: String = wanted.iter().filter_map(differs).collect();
            let more = after.1.keys().filter(|p| !wanted.contains_key(*p));
            what.extend(more.map(|p| format!("{p} is not in the model\n")));
            return Err(fail(format!("{what}after:\n{}", after.0)));
        }
        let mut anew = Session::new(Box::new(Nothing));
        let again = anew.open("again", &after.0);
        if moment(&anew, again) != after {
            return Err(fail("opened from its text it differs".into()));
        }
        let status =
            |session: &mut Session, id| Status { undo: None, redo: None, ..session.status(id) };
        let (is, was) = (status(&mut anew, again), status(&mut session, id));
        if is != was {
            return Err(fail(format!("opened from its text its status is {is:?}, not {was:?}")));
        }
        accepted += 1;
    }
    Ok(accepted)
}

#[test]
fn the_session_agrees_with_the_model() {
    let long = std::env::var_os("THINGLAB_LONG").is_some();
    let (seeds, steps) = if long { (220, 80) } else { (12, 40) };
    let mut accepted = 0;
    for seed in KEPT.into_iter().chain(100..100 + seeds) {
        match run(seed, steps) {
            Ok(n) => accepted += n,
            Err(difference) => panic!("{difference}"),
        }
    }
    let least = if long { 10_000 } else { 200 };
    assert!(accepted >= least, "{accepted} commands were accepted, fewer than {least}");
}
