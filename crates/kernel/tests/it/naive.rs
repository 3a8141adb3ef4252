//! Random documents: their structures, beside what a naive reading of the same classes comes to.
//!
//! The naive reading knows no copies, no forest and no ring. Things are paths; merged things are
//! a relation that is closed again and again; a given value is looked for from the outside in.

use crate::builder::{Builder, ORIGIN};
use base::{Dice, Name};
use kernel::{
    ClassId, ClassKind, Count, DOCUMENT, Document, Given, Insert, Merge, OriginId, Path, Step,
    Structure, Term, check, instantiate, instantiate_again,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

fn pick<T: Clone>(dice: &mut Dice, all: &[T]) -> T {
    dice.one_of(all).expect("there are some")
}

/// Makes a document of a few classes, each of parts of earlier ones.
fn random_document(dice: &mut Dice) -> Document {
    let (mut b, object, real) = Builder::new();
    let set = b.class("Set of Real", ClassKind::Set(real), &[object]);
    let mut classes = vec![real];
    let last = 3 + dice.below(3);
    for i in 0..=last {
        let composites: Vec<ClassId> =
            classes.iter().copied().filter(|&c| b.0[c].kind == ClassKind::Composite).collect();
        let mut supers = vec![object];
        if !composites.is_empty() && dice.below(2) == 0 {
            supers = vec![pick(dice, &composites)];
            if dice.below(3) == 0 {
                supers.push(pick(dice, &composites));
            }
        }
        let class = b.class(&format!("C{i}"), ClassKind::Composite, &supers);
        for (k, above) in b.0[class].supers.iter_mut().enumerate() {
            above.name = Name::new(&format!("s{i}{k}"));
        }
        for j in 0..1 + dice.below(3) {
            let part = pick(dice, &classes);
            let name = format!("p{i}{j}");
            if dice.below(5) == 0 {
                let list = b.class(&format!("List {i}{j}"), ClassKind::List(part), &[object]);
                let count = 1 + dice.below(3) as u32;
                b.part(class, &name, list, Some(Count::Fixed(count)));
            } else {
                b.part(class, &name, part, None);
            }
        }
        if dice.below(4) == 0 {
            b.part(class, &format!("all{i}"), set, None);
        }
        if dice.below(2) == 0 {
            b.constraint(class, &format!("rule{i}"));
        }
        classes.push(class);
        say_something(dice, &mut b, class);
    }
    let root = *classes.last().expect("there is a class");
    b.document(root)
}

/// Adds merges, given values and set members over paths that exist.
fn say_something(dice: &mut Dice, b: &mut Builder, class: ClassId) {
    let document = Builder(b.0.clone()).document(class);
    let (things, faults) = instantiate(&document);
    assert_eq!(faults, []);
    let paths: Vec<(Path, ClassId)> = things
        .things
        .iter()
        .skip(1)
        .map(|(t, thing)| (things.path(&document, t), thing.class))
        .collect();
    if paths.is_empty() || paths.len() > 200 {
        return;
    }
    for _ in 0..dice.below(3) {
        let (one, class_of_one) = pick(dice, &paths);
        let alike: Vec<_> = paths.iter().filter(|p| p.1 == class_of_one).cloned().collect();
        let paths = vec![one, pick(dice, &alike).0];
        b.0[class].merges.push(Merge { name: None, paths, origin: ORIGIN });
    }
    let numbers: Vec<_> = paths.iter().filter(|p| b.0[p.1].name == "Real").cloned().collect();
    let sets: Vec<_> = paths.iter().filter(|p| b.0[p.1].name == "Set of Real").cloned().collect();
    if numbers.is_empty() {
        return;
    }
    for _ in 0..dice.below(4) {
        let value = Term::number(dice.below(1000) as f64);
        b.0[class].givens.push(Rc::new(Given {
            path: pick(dice, &numbers).0,
            value,
            origin: ORIGIN,
        }));
    }
    if let (Some((set, _)), 0) = (sets.first().cloned(), dice.below(2)) {
        let part = pick(dice, &numbers).0;
        b.0[class].inserts.push(Insert { part, set, origin: ORIGIN });
    }
}

/// A document read naively.
struct Naive<'d> {
    document: &'d Document,
    /// Every thing in order of declaration, with its class.
    things: Vec<(Path, ClassId)>,
    /// Every thing, and what it is the same as: the first.
    same: BTreeMap<Path, Path>,
}

impl<'d> Naive<'d> {
    fn read(document: &'d Document) -> Self {
        let mut naive = Self { document, things: Vec::new(), same: BTreeMap::new() };
        naive.add(&Path::default(), document.root, 0);
        naive.merge();
        naive
    }
    fn add(&mut self, path: &Path, class: ClassId, count: u32) {
        self.same.insert(path.clone(), path.clone());
        self.things.push((path.clone(), class));
        if let ClassKind::List(element) = self.document.classes[class].kind {
            (0..count).for_each(|i| self.add(&path.then(Step::Index(i)), element, 0));
        }
        for field in self.document.layout(class) {
            let name = self.document.field_name(field).clone();
            let count = match self.document.declared(field).and_then(|part| part.count) {
                Some(Count::Fixed(n)) => n,
                Some(Count::Given) | None => 0,
            };
            let part = self.document.field_class(field);
            self.add(&path.then(Step::Part(name)), part, count);
        }
    }
    fn rank(&self, path: &Path) -> usize {
        self.things.iter().position(|t| t.0 == *path).expect("the path is that of a thing")
    }
    /// Makes one all that is said to be one, and what is below it, until nothing changes.
    fn merge(&mut self) {
        let mut pairs: Vec<(Path, Path)> = Vec::new();
        for (thing, class) in &self.things {
            for class in self.document.primary_line(*class) {
                for merge in &self.document.classes[class].merges {
                    pairs.push((thing.join(&merge.paths[0]), thing.join(&merge.paths[1])));
                }
            }
        }
        while let Some((a, b)) = pairs.pop() {
            let (a, b) = (self.same[&a].clone(), self.same[&b].clone());
            if a == b {
                continue;
            }
            let (first, last) =
                if self.rank(&a) < self.rank(&b) { (a.clone(), b.clone()) } else { (b, a) };
            for known in self.same.values_mut().filter(|known| **known == last) {
                *known = first.clone();
            }
            for (path, _) in &self.things {
                if path.0.len() == last.0.len() + 1 && path.0.starts_with(&last.0) {
                    let step = path.0.last().expect("a part's path has a step").clone();
                    pairs.push((first.then(step), path.clone()));
                }
            }
        }
    }
    /// Finds what a number is given: by its outermost owner that says something, the last time. Tells how
    /// deep that lies.
    fn given(&self, path: &Path) -> Option<(usize, &'d Term)> {
        for (owner, class) in &self.things {
            if !path.0.starts_with(&owner.0) {
                continue;
            }
            let rest = Path(path.0[owner.0.len()..].to_vec());
            for class in self.document.primary_line(*class) {
                let mut givens = self.document.classes[class].givens.iter().rev();
                if let Some(given) = givens.find(|g| g.path == rest) {
                    return Some((owner.0.len(), &given.value));
                }
            }
        }
        None
    }
    /// Returns the values of all numbers that are not merged with an earlier one.
    fn slots(&self) -> Vec<(Path, Option<Term>)> {
        let is_number =
            |c: ClassId| matches!(self.document.classes[c].kind, ClassKind::Primitive(_));
        let mut slots: Vec<(Path, Option<(usize, Term)>)> = Vec::new();
        for (path, _) in self.things.iter().filter(|t| is_number(t.1)) {
            let first = &self.same[path];
            let known = slots.iter().position(|s| s.0 == *first).unwrap_or_else(|| {
                slots.push((first.clone(), None));
                slots.len() - 1
            });
            let Some((depth, term)) = self.given(path) else { continue };
            // of merged ones, what is said furthest out counts, the first time
            if slots[known].1.as_ref().is_none_or(|(d, _)| depth < *d) {
                slots[known].1 = Some((depth, term.clone()));
            }
        }
        slots.into_iter().map(|(path, given)| (path, given.map(|(_, term)| term))).collect()
    }
    /// Returns which constraints there are, by the thing that they are about first of all.
    fn constraints(&self) -> BTreeSet<(Path, ClassId, u32)> {
        let mut all = BTreeSet::new();
        for (path, class) in &self.things {
            for class in self.document.primary_line(*class) {
                for index in 0..self.document.classes[class].constraints.len() as u32 {
                    all.insert((self.same[path].clone(), class, index));
                }
            }
        }
        all
    }
    fn members(&self) -> BTreeMap<Path, BTreeSet<Path>> {
        let mut sets: BTreeMap<Path, BTreeSet<Path>> = BTreeMap::new();
        for (path, class) in &self.things {
            for class in self.document.primary_line(*class) {
                for insert in &self.document.classes[class].inserts {
                    let set = self.same[&path.join(&insert.set)].clone();
                    let part = self.same[&path.join(&insert.part)].clone();
                    sets.entry(set).or_default().insert(part);
                }
            }
        }
        sets
    }
}

fn compare(document: &Document, s: &Structure) {
    let naive = Naive::read(document);
    let path = |t| s.path(document, t);
    assert_eq!(s.things.len(), naive.things.len());
    for (at, _) in &naive.things {
        let thing = s.follow(DOCUMENT, at).expect("every naive path leads somewhere");
        assert_eq!(path(s.identity(thing)), naive.same[at], "what {at} is the same as");
        let all: Vec<Path> = s.merged_with(thing).into_iter().map(path).collect();
        let same = naive.things.iter().map(|t| &t.0).filter(|p| naive.same[*p] == naive.same[at]);
        assert_eq!(all, same.cloned().collect::<Vec<_>>(), "all that {at} is the same as");
    }
    let slots: Vec<(Path, Option<Term>)> = s
        .slots
        .iter()
        .map(|(id, slot)| (path(slot.thing), s.given(id).map(|g| Term::clone(&g.term))))
        .collect();
    assert_eq!(slots, naive.slots());
    let constraints: Vec<_> =
        s.constraints.iter().map(|c| (path(s.identity(c.owner)), c.class, c.index)).collect();
    let once: BTreeSet<_> = constraints.iter().cloned().collect();
    assert_eq!(once.len(), constraints.len(), "every constraint stands there once");
    assert_eq!(once, naive.constraints());
    let members =
        s.sets.iter().map(|(&set, all)| (path(set), all.iter().map(|&t| path(t)).collect()));
    assert_eq!(members.collect::<BTreeMap<_, _>>(), naive.members());
}

#[test]
fn random_documents_are_what_a_naive_reading_says() {
    let mut dice = Dice::new(1979);
    let (mut compared, mut merged) = (0, 0);
    while compared < 400 {
        let document = random_document(&mut dice);
        let (structure, faults) = instantiate(&document);
        assert_eq!(faults, []);
        check::structure(&document, &structure).expect("the structure keeps its invariants");
        if structure.things.len() > 300 {
            continue;
        }
        compare(&document, &structure);
        compared += 1;
        merged += usize::from(structure.merged.iter().any(|(t, &first)| t != first));
    }
    assert!(merged > 100, "many of the documents merge something: {merged}");
}

/// Changes one thing that the document's own class says.
fn say_otherwise(dice: &mut Dice, document: &mut Document) {
    let mut more = Builder(document.classes.clone());
    (0..1 + dice.below(4)).for_each(|_| say_something(dice, &mut more, document.root));
    let more = more.0[document.root].clone();
    let root = &mut document.classes[document.root];
    let n = root.givens.len();
    match dice.below(6) {
        0 | 1 if n > 0 => {
            let given = Rc::make_mut(&mut root.givens[dice.below(n)]);
            given.value = Term::number(dice.below(1000) as f64);
            given.origin = OriginId(dice.below(9) as u32);
        }
        2 if n > 0 => {
            root.givens.remove(dice.below(n));
        }
        3 => {
            root.merges = more.merges;
            for given in &more.givens[n..] {
                let value = Term::number(dice.below(1000) as f64);
                let given = Given { value, ..Given::clone(given) };
                root.givens.insert(dice.below(n + 1), Rc::new(given));
            }
        }
        4 => root.inserts = more.inserts,
        5 => {
            root.merges.pop();
        }
        _ => *root = more,
    }
}

#[test]
fn what_an_edit_left_as_it_was_is_taken_over_and_all_is_as_made_anew() {
    let mut dice = Dice::new(2026);
    let (mut forms, mut things, mut more) = (0, 0, 0);
    for _ in 0..150 {
        let mut before = random_document(&mut dice);
        let (mut structure, _) = instantiate(&before);
        if structure.things.len() > 300 {
            continue;
        }
        for _ in 0..8 {
            let mut document = before.clone();
            say_otherwise(&mut dice, &mut document);
            let (anew, told) = instantiate(&document);
            let (again, told_again) = instantiate_again(&document, (&before, &structure));
            assert_eq!(told, told_again);
            assert_eq!(format!("{anew:?}"), format!("{again:?}"));
            forms += usize::from(Rc::ptr_eq(&again.form, &structure.form));
            let are_kept = Rc::ptr_eq(&again.form.things, &structure.form.things);
            things += usize::from(are_kept);
            let givens = |d: &Document| d.classes[d.root].givens.len();
            more += usize::from(are_kept && givens(&document) > givens(&before));
            (before, structure) = (document, again);
        }
    }
    assert!(forms > 100 && things > forms + 100, "{forms} forms and {things} lists of things kept");
    assert!(more > 20, "{more} lists of things kept where more was given");
}

#[test]
fn coordinates_get_of_a_changed_place_what_is_theirs() {
    let (mut b, object, real) = Builder::new();
    let point = b.composite("Point", object, &[("x", real), ("y", real)]);
    let root = b.composite("", object, &[("p", point), ("q", point)]);
    let place = |x, y| Term::Tuple(vec![Term::number(x), Term::number(y)]);
    b.given(root, &["p"], place(3.0, 4.0));
    b.given(root, &["q"], place(5.0, 6.0));
    let before = b.document(root);
    let (structure, _) = instantiate(&before);
    let mut after = before.clone();
    Rc::make_mut(&mut after.classes[root].givens[0]).value = place(3.5, 4.0);
    let (again, faults) = instantiate_again(&after, (&before, &structure));
    assert_eq!(faults, []);
    assert!(Rc::ptr_eq(&again.form, &structure.form), "constants alone changed");
    let given =
        |s: &Structure| s.slots.ids().map(|id| s.given(id).map(|g| Term::clone(&g.term))).collect();
    let numbers = |all: [f64; 4]| all.map(|x| Some(Term::number(x))).to_vec();
    let (was, is): (Vec<_>, Vec<_>) = (given(&structure), given(&again));
    assert_eq!(was, numbers([3.0, 4.0, 5.0, 6.0]));
    assert_eq!(is, numbers([3.5, 4.0, 5.0, 6.0]));
}

/// What every slot is given, and what every thing is given apart from what it is merged with.
fn all_given(s: &Structure) -> Vec<(Option<kernel::GivenTerm>, Option<kernel::GivenTerm>)> {
    let slot = |slot| (s.given(slot).cloned(), s.given_apart(s.slots[slot].thing).cloned());
    s.slots.ids().map(slot).collect()
}

#[test]
fn a_place_that_is_given_more_is_given_what_is_theirs() {
    let (mut b, object, real) = Builder::new();
    let point = b.composite("Point", object, &[("x", real), ("y", real)]);
    let line = b.composite("Line", object, &[("p", point), ("q", point)]);
    let root = b.composite("", object, &[("a", line), ("b", line)]);
    let place = |x, y| Term::Tuple(vec![Term::number(x), Term::number(y)]);
    b.given(root, &["a"], Term::Tuple(vec![place(1.0, 2.0), place(3.0, 4.0)]));
    b.given(root, &["b", "q", "x"], Term::number(9.0));
    let before = b.document(root);
    let (structure, _) = instantiate(&before);
    let path = |steps: &[&str]| Path::of(steps);
    let new = [
        (2, path(&["a", "q"]), place(5.0, 6.0), true),
        (1, path(&["b", "p"]), place(7.0, 8.0), true),
        (2, path(&["b"]), Term::Tuple(vec![place(1.0, 1.0), place(2.0, 2.0)]), true),
        // what stands behind it counts
        (0, path(&["a", "q"]), place(5.0, 6.0), false),
        (0, path(&["b", "q"]), place(5.0, 6.0), false),
        (2, path(&["a", "q"]), Term::Me, false),
    ];
    for (at, path, value, is_kept) in new {
        let mut after = before.clone();
        let given = Given { path, value, origin: OriginId(7) };
        after.classes[root].givens.insert(at, Rc::new(given));
        let (again, _) = instantiate_again(&after, (&before, &structure));
        let (anew, _) = instantiate(&after);
        assert_eq!(all_given(&again), all_given(&anew));
        assert_eq!(Rc::ptr_eq(&again.form.things, &structure.form.things), is_kept, "{after:?}");
        // what came anew is followed like any other
        let mut moved = after.clone();
        let given = Rc::make_mut(&mut moved.classes[root].givens[at]);
        if let Term::Tuple(items) = &mut given.value {
            items.reverse();
        }
        let (again, _) = instantiate_again(&moved, (&after, &again));
        assert_eq!(all_given(&again), all_given(&instantiate(&moved).0));
    }
}
