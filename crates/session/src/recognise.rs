//! Recognition: which classes some selected parts could be the parts of.
//!
//! In: a state, and at most six of its things. Out: every class in scope whose stored parts they could
//! be, one to one by class, so that all its constraints and merges are true of them. A thing of every
//! such class is made for the test, filled with the values of the selected parts, and thrown away.
//! Numbers of the class that nobody selects are its parameters: what its rules say that they are.

use crate::prototype::Lone;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Recognised, Refusal};
use crate::words;
use base::Name;
use base::number::{close, significant};
use eval::{Answer, Evaluator};
use expr::Dimension;
use kernel::quantity::to_bare;
use kernel::{
    BinaryOperator, Class, ClassId, ClassKind, Document, PartRef, PartRole, Path, Primitive,
    SlotId, Step, Strength, Term, ThingId, Value, Values,
};

/// How many parts can be asked about: their orders are all tried.
const MOST_PARTS: usize = 6;
/// Of so many parts at most each is tried both ways round.
const MOST_TURNED: usize = 4;
/// What the name of the class of placed things begins with: nobody declares it.
pub(crate) const PLACED_OF: &str = "Placed of ";

/// Returns the classes that some parts could be the parts of, those with most constraints first.
///
/// # Errors
/// No parts, too many, one twice, or a path that leads nowhere.
pub(crate) fn recognise(state: &State, paths: &[Path]) -> Result<Vec<Recognised>, Refusal> {
    if paths.is_empty() || paths.len() > MOST_PARTS {
        let message = format!("select one to {MOST_PARTS} parts; here are {}", paths.len());
        return Err(words::refuse(message));
    }
    let mut things: Vec<ThingId> = Vec::new();
    for path in paths {
        let thing = words::find(state, path)?;
        if things.iter().any(|&t| state.structure.identity(t) == state.structure.identity(thing)) {
            return Err(words::refuse(format!("{path} is selected twice")));
        }
        things.push(thing);
    }
    let document = &state.lowered.document;
    let ends: Vec<Option<[Name; 2]>> = things.iter().map(|&thing| ends(state, thing)).collect();
    let chosen = Chosen { state, things: &things, ends: &ends };
    let classes = document.classes.iter().filter(|&(id, c)| is_candidate(state, id, c));
    let mut found: Vec<Recognised> = Vec::new();
    for (class, _) in classes {
        let (mut fields, mut told) = fields(document, class);
        let stored = fields.iter().chain(&told).all(|f| f.role == PartRole::Part);
        if !stored || fields.len() != things.len() {
            // numbers may be selected as other parts are
            let all = document.layout(class);
            let stored = all.iter().all(|f| f.role == PartRole::Part);
            if told.is_empty() || !stored || all.len() != things.len() {
                continue;
            }
            (fields, told) = (all, Vec::new());
        }
        let wanted: Vec<ClassId> = fields.iter().map(|&f| document.field_class(f)).collect();
        let fits = |field: usize, thing: ThingId| {
            document.is_a(state.structure.things[thing].class, wanted[field])
        };
        let told = told.iter().map(|&f| document.field_name(f).clone()).collect();
        let Some(trial) = Trial::new(document, class, told) else { continue };
        // a class that only says what its parameters are is true of anything
        if !trial.told.is_empty() && trial.rules as usize <= trial.told.len() {
            continue;
        }
        let ways: &[&[bool]] = match things.len() {
            0..=MOST_TURNED => &[&[false], &[false, true]],
            _ => &[&[false]],
        };
        let mut order = Vec::new();
        if ways.iter().any(|ways| trial.first_order(&chosen, (&fits, ways), &mut order)) {
            let names = fields.iter().map(|&f| document.field_name(f).to_string());
            let parts = names.zip(order.iter().map(|&(i, _)| paths[i].to_string()));
            let parts: Vec<(String, String)> = parts.collect();
            let turned = order.iter().map(|&way| chosen.turned(way).cloned());
            let turned: Vec<Option<[Name; 2]>> = turned.collect();
            let given = trial.filled(&chosen, &order).map_or_else(Vec::new, |(_, told)| told);
            let class = &document.classes[class];
            found.push(Recognised {
                class: class.name.to_string(),
                doc: class.doc.clone(),
                constraints: trial.rules,
                members: members(state, &class.name, (&parts, &turned), &given),
                parts,
            });
        }
    }
    found.sort_by(|a, b| b.constraints.cmp(&a.constraints).then(a.class.cmp(&b.class)));
    Ok(found)
}

/// What is written of things as parts of a class: each field with its part, and the ends of those that run the other way.
type Placed<'a> = (&'a [(String, String)], &'a [Option<[Name; 2]>]);

/// Writes a thing of a class whose parts are those selected; they stand first, so that they keep their
/// values. What runs the other way is joined end by end. Its parameters are given what they are.
fn members(
    state: &State,
    class: &Name,
    (parts, turned): Placed<'_>,
    given: &[(Name, f64)],
) -> String {
    let name = free_name(state, class);
    let given: Vec<String> =
        given.iter().map(|(name, x)| format!("{name} = {}", significant(*x, 12))).collect();
    let body =
        if given.is_empty() { String::new() } else { format!(" {{ {} }}", given.join("; ")) };
    let merges = parts.iter().zip(turned).map(|((field, part), turned)| match turned {
        Some([a, b]) => {
            format!(
                "merge {part}.{a} = {name}.{field}.{b}\nmerge {part}.{b} = {name}.{field}.{a}\n"
            )
        }
        None => format!("merge {part} = {name}.{field}\n"),
    });
    std::iter::once(format!("{name}: {class}{body}\n")).chain(merges).collect()
}

/// The parts of a class that things can be, and the numbers beside them, which are its parameters.
fn fields(document: &Document, class: ClassId) -> (Vec<PartRef>, Vec<PartRef>) {
    let is_number = |f: &PartRef| {
        let class = &document.classes[document.field_class(*f)];
        matches!(class.kind, ClassKind::Primitive(Primitive::Real(_)))
    };
    let all = document.layout(class);
    match all.iter().all(is_number) {
        true => (all, Vec::new()),
        false => all.into_iter().partition(|f| !is_number(f)),
    }
}

/// The things that are asked about.
struct Chosen<'a> {
    state: &'a State,
    things: &'a [ThingId],
    /// The names of the ends of each that could run the other way.
    ends: &'a [Option<[Name; 2]>],
}

impl Chosen<'_> {
    /// The ends of a thing that is turned round.
    fn turned(&self, (i, turned): (usize, bool)) -> Option<&[Name; 2]> {
        self.ends[i].as_ref().filter(|_| turned)
    }
}

/// Returns the names of the two ends of a line that is nothing but them, and so could run the other way. Of other
/// things, as of a disc by its centre and its rim, two places are not each other's.
fn ends(state: &State, thing: ThingId) -> Option<[Name; 2]> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let line = document.class_named("Line")?;
    if !document.is_a(structure.things[thing].class, line) {
        return None;
    }
    let parts: Vec<ThingId> = structure.parts(thing).collect();
    let [a, b] = parts[..] else { return None };
    let class = structure.things[a].class;
    if class != structure.things[b].class || !document.is_place(class) {
        return None;
    }
    let name = |part| structure.field_name(document, part).cloned();
    Some([name(a)?, name(b)?])
}

/// Returns a name for a new thing of a class that nothing in the document has.
pub(crate) fn free_name(state: &State, class: &Name) -> String {
    free_name_in(state, &Path::default(), class)
}

/// The same, of a new part of a thing that no part of it has either.
pub(crate) fn free_name_in(state: &State, within: &Path, class: &Name) -> String {
    let word = name_like(class);
    let names = std::iter::once(word.clone()).chain((2..).map(|i| format!("{word}{i}")));
    let is_free = |name: &String| {
        let path = Path(vec![Step::Part(Name::new(name))]);
        let is_part = thing_at(state, &within.join(&path)).is_some();
        Name::new(name) != *class && !is_taken(state, &path) && !is_part
    };
    { names }.find(is_free).unwrap_or_default()
}

/// Whether a path of the document leads to a part, or to what the document computes by that name.
pub(crate) fn is_taken(state: &State, path: &Path) -> bool {
    let document = &state.lowered.document;
    let is_computed = match path.0.as_slice() {
        [Step::Part(name)] => document.find_message(document.root, name, None).is_some(),
        _ => false,
    };
    is_computed || thing_at(state, path).is_some()
}

/// A class's name as things are called: with a small first letter.
pub(crate) fn name_like(class: &Name) -> String {
    class.chars().enumerate().map(small_first).collect()
}

fn small_first((at, letter): (usize, char)) -> char {
    if at == 0 { letter.to_ascii_lowercase() } else { letter }
}

/// Whether a class is one that people make things of.
pub(crate) fn is_candidate(state: &State, id: ClassId, class: &Class) -> bool {
    let document = &state.lowered.document;
    class.kind == ClassKind::Composite
        && !class.is_abstract
        && !class.supers.is_empty()
        && id != document.root
        && !class.name.is_empty()
        && !class.name.starts_with(PLACED_OF)
        && !state.lowered.is_class_of_one(id)
}

/// A thing of a class, made to be filled with the values of parts.
struct Trial {
    lone: Lone,
    /// How many constraints and merges the class says of its parts.
    rules: u32,
    /// What its parameters are called.
    told: Vec<Name>,
}

/// The values of a trial, and what its parameters are, as they are written without a unit.
type Filled = (Values, Vec<(Name, f64)>);

impl Trial {
    fn new(document: &Document, class: ClassId, told: Vec<Name>) -> Option<Self> {
        let lone = Lone::of(document, class)?;
        let line = document.primary_line(class);
        let merges: usize = line.iter().map(|&c| document.classes[c].merges.len()).sum();
        let own = lone.structure.constraints.iter().filter(|c| c.owner == lone.thing).count();
        Some(Self { lone, rules: (merges + own) as u32, told })
    }

    /// Finds the first order of the things in which they could be the parts, field by field.
    fn first_order(
        &self,
        chosen: &Chosen<'_>,
        (fits, ways): (&dyn Fn(usize, ThingId) -> bool, &[bool]),
        order: &mut Vec<(usize, bool)>,
    ) -> bool {
        let (field, things) = (order.len(), chosen.things);
        if field == things.len() {
            return self.holds(chosen, order);
        }
        for (i, &thing) in things.iter().enumerate() {
            if order.iter().any(|&(known, _)| known == i) || !fits(field, thing) {
                continue;
            }
            for &turned in ways {
                if turned && chosen.ends[i].is_none() {
                    continue;
                }
                order.push((i, turned));
                if self.first_order(chosen, (fits, ways), order) {
                    return true;
                }
                order.pop();
            }
        }
        false
    }

    /// Returns true if all that the class says is true of the things as its parts.
    fn holds(&self, chosen: &Chosen<'_>, order: &[(usize, bool)]) -> bool {
        let Some((values, _)) = self.filled(chosen, order) else { return false };
        let evaluator = Evaluator::new(&self.lone.document, &self.lone.structure, &values);
        self.lone.structure.constraints.iter().all(|&c| {
            let written = &self.lone.document.classes[c.class].constraints[c.index as usize];
            written.strength != Strength::Required
                || !self.lone.structure.is_on(c)
                || evaluator.test(c).is_ok_and(|verdict| verdict.holds)
        })
    }

    /// Returns the values of the trial with the things as its parts; nothing where they cannot be, or no rule says what a
    /// parameter is.
    fn filled(&self, chosen: &Chosen<'_>, order: &[(usize, bool)]) -> Option<Filled> {
        let state = chosen.state;
        let mut values = Values::new(self.lone.structure.slots.len());
        let mut filled = vec![false; self.lone.structure.slots.len()];
        let is_told = |&field: &ThingId| {
            let name = self.lone.structure.field_name(&self.lone.document, field);
            name.is_some_and(|name| self.told.contains(name))
        };
        let fields = self.lone.structure.parts(self.lone.thing).filter(|field| !is_told(field));
        for (field, &way) in fields.zip(order) {
            let thing = chosen.things[way.0];
            let is_filled = match chosen.turned(way) {
                None => self.fill(state, field, thing, &mut values, &mut filled),
                Some(names) => { names.iter().zip(names.iter().rev()) }.all(|(name, other)| {
                    let part = self.lone.structure.part_named(field, name);
                    let from = state.structure.part_named(thing, other);
                    part.zip(from).is_some_and(|(part, from)| {
                        self.fill(state, part, from, &mut values, &mut filled)
                    })
                }),
            };
            if !is_filled {
                return None;
            }
        }
        let mut unknown: Vec<(Name, SlotId)> = Vec::new();
        for name in &self.told {
            let part = self.lone.structure.part_named(self.lone.thing, name)?;
            let slot = self.lone.structure.slot_of(part)?;
            // what is one with a number of another part is known
            if !filled[slot.0 as usize] {
                unknown.push((name.clone(), slot));
            }
        }
        let mut given: Vec<(Name, f64)> = Vec::new();
        while !unknown.is_empty() {
            let told = |(n, (name, _)): (usize, &(Name, SlotId))| {
                Some((n, self.told_by_rule(name, &unknown, &values)?))
            };
            let (n, (x, dimension)) = unknown.iter().enumerate().find_map(told)?;
            let (name, slot) = unknown.remove(n);
            values.put(slot, Value::Number(x));
            given.push((name, to_bare(&self.lone.document, x, dimension)));
        }
        Some((values, given))
    }

    /// Returns the number that a rule of the class says that a parameter is, as `a.radius = radius` does; nothing where
    /// that comes of numbers that are not known yet.
    fn told_by_rule(
        &self,
        name: &Name,
        unknown: &[(Name, SlotId)],
        values: &Values,
    ) -> Option<(f64, Dimension)> {
        let (document, structure) = (&self.lone.document, &self.lone.structure);
        let evaluator = Evaluator::new(document, structure, values);
        let is_it =
            |term: &Term| term.path().is_some_and(|path| path.0 == [Step::Part(name.clone())]);
        let own = structure.constraints.iter().filter(|c| c.owner == self.lone.thing);
        own.filter(|&&c| structure.is_on(c)).find_map(|c| {
            let written = &document.classes[c.class].constraints[c.index as usize];
            let Term::Binary(BinaryOperator::Equal, a, b) = &*written.rule else { return None };
            let other = match (is_it(a), is_it(b)) {
                (false, true) => a,
                (true, false) => b,
                (true, true) | (false, false) => return None,
            };
            let (answer, read) =
                evaluator.listening(|| evaluator.evaluate(other, self.lone.thing).ok());
            let is_known = unknown.iter().all(|(_, slot)| !read.contains(slot));
            match answer? {
                Answer::Number(x, dimension)
                    if is_known && written.strength == Strength::Required =>
                {
                    Some((x, dimension))
                }
                _ => None,
            }
        })
    }

    /// Copies the values of a thing into a part of the trial; returns false where parts that the class
    /// merges have different values, or lists different lengths.
    fn fill(
        &self,
        state: &State,
        part: ThingId,
        from: ThingId,
        values: &mut Values,
        filled: &mut [bool],
    ) -> bool {
        if let (Some(slot), Some(source)) =
            (self.lone.structure.slot_of(part), state.structure.slot_of(from))
        {
            let value = state.values.get(source);
            let agrees = match (&value, values.get(slot)) {
                (Value::Number(a), Value::Number(b)) => close(*a, b),
                (a, b) => a.same_bits(&b),
            };
            if std::mem::replace(&mut filled[slot.0 as usize], true) {
                return agrees;
            }
            values.put(slot, value);
            return true;
        }
        let elements = state.structure.parts(from);
        let mut below = self.lone.structure.parts(part).enumerate();
        if let ClassKind::List(_) =
            self.lone.document.classes[self.lone.structure.things[part].class].kind
        {
            let elements: Vec<ThingId> = elements.collect();
            return elements.len() == below.len()
                && below.all(|(i, p)| self.fill(state, p, elements[i], values, filled));
        }
        below.all(|(_, p)| {
            let name = self.lone.structure.field_name(&self.lone.document, p);
            let source = name.and_then(|n| state.structure.part_named(from, n));
            source.is_some_and(|s| self.fill(state, p, s, values, filled))
        })
    }
}

/// Whether a program has a place among its parameters, by the name that what is placed has for its own: it needs no other.
pub(crate) fn asks_for_its_place(document: &Document, class: ClassId) -> bool {
    let point = document.class_named("Point");
    let is_place = |part: &kernel::Part| *part.name == *"at" && Some(part.class) == point;
    document.classes[class].parts.iter().any(is_place)
}
