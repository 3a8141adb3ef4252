//! Offers: what can be said of a selection, in the language, each as one edit.
//!
//! In: a state and the paths of some things. Out: the constraints that fit them, found in what their classes
//! answer: truth values of one thing or of two (`parallel(to:)`, `passes(through:)`), lengths and radii that can
//! be equal, midpoints, levels; and the classes of constraints whose parts the things could be. What is told a
//! number is told what it is now, so that nothing moves before a person types another.

use crate::apply;
use crate::by_hand::class_at;
use crate::classing;
use crate::document::{Direction, Open};
use crate::drag;
use crate::host::Host;
use crate::joining;
use crate::plotting;
use crate::recognise;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Deed, Offer};
use crate::words;
use base::Name;
use drawing::Drawing;
use eval::Answer;
use expr::Dimension;
use kernel::{
    Argument, BinaryOperator, ClassId, ClassKind, Command, DOCUMENT, Literal, Message, Path,
    SlotId, Step, Term, Thing, ThingId, UnaryOperator,
};
use std::collections::BTreeSet;
use syntax::SyntaxKind;
use syntax::ast::Member;

mod among;
pub(crate) mod between;

/// The most things that offers are made for.
const MOST: usize = 8;
/// What `-line` asks of a line.
pub(crate) const REVERSED: &str = "reversed";

/// A selected thing, or a figure that is computed.
#[derive(Clone)]
struct Selected {
    path: Path,
    /// Nothing for what is computed: it can be spoken of, and not be merged.
    thing: Option<ThingId>,
    class: ClassId,
}

/// Returns what can be said of some things, what is meant most often first.
pub(crate) fn offers(state: &State, paths: &[Path]) -> Vec<Offer> {
    let found: Option<Vec<Selected>> = paths
        .iter()
        .map(|path| {
            let (thing, class) = (thing_at(state, path), class_at(state, path)?);
            Some(Selected { path: path.clone(), thing, class })
        })
        .collect();
    let Some(things) = found.filter(|found| !found.is_empty() && found.len() <= MOST) else {
        return Vec::new();
    };
    let offerer = Offerer { state, things: &things };
    let mut offers = Vec::new();
    // points are merged more often than anything else is said of them, lines hardly ever
    let of_places = things.iter().all(|one| offerer.is_place(one.class));
    offers.extend(offerer.joint(paths).filter(|_| of_places));
    offers.extend(offerer.coincident());
    offers.extend(offerer.levels());
    offers.extend(offerer.alone(&offers));
    offers.extend(offerer.pairs());
    offers.extend(offerer.among());
    offers.extend(offerer.equals());
    offers.extend(offerer.middles());
    offers.extend(offerer.dimensions());
    offers.extend(offerer.ruling());
    offers.extend(offerer.classes(&offers));
    // three wholes that are to be one are a slip of the hand
    let are_many = paths.len() > 2 && paths.iter().all(|path| path.0.len() == 1);
    offers.extend(offerer.joint(paths).filter(|_| !of_places && !are_many));
    offers
}

struct Offerer<'s> {
    state: &'s State,
    things: &'s [Selected],
}

impl Offerer<'_> {
    fn rule(label: &str, rules: &[String]) -> Offer {
        let members: Vec<String> = rules.iter().map(|rule| format!("constraint {rule}")).collect();
        Offer { label: label.into(), members: members.join("\n"), ..Offer::default() }
    }

    /// Whether one of the things is computed: no part of anything can be merged with it.
    fn is_computed(&self) -> bool {
        self.things.iter().any(|one| one.thing.is_none())
    }

    fn is_place(&self, class: ClassId) -> bool {
        self.state.lowered.document.is_place(class)
    }

    /// The message of a class by a name, without parameters or with one.
    fn message(&self, class: ClassId, name: &str) -> Option<&Message> {
        let document = &self.state.lowered.document;
        document.find_message(class, &Name::new(name), None).map(|(_, message)| message)
    }

    /// Merging what sticks there.
    fn joint(&self, paths: &[Path]) -> Option<Offer> {
        let joined = joining::joined(self.state, paths).ok().filter(|all| all.len() > 1)?;
        let names: Vec<String> = joined.iter().map(ToString::to_string).collect();
        let members = format!("merge {}", names.join(" = "));
        Some(Offer { label: "merge".into(), members, ..Offer::default() })
    }

    /// Two places that are to be one, where one of them is computed and cannot be merged.
    fn coincident(&self) -> Option<Offer> {
        let [a, b] = self.things else { return None };
        let are_places = self.is_place(a.class) && self.is_place(b.class);
        let rule = format!("{} = {}", a.path, b.path);
        (are_places && self.is_computed()).then(|| Self::rule("coincident", &[rule]))
    }

    /// The two places that are level or upright: two that are selected, or the ends of each line.
    fn levels(&self) -> Vec<Offer> {
        let ends: Option<Vec<(Path, Path)>> = match self.things {
            [a, b] if self.is_place(a.class) && self.is_place(b.class) => {
                Some(vec![(a.path.clone(), b.path.clone())])
            }
            all => all.iter().map(|one| self.ends(one)).collect(),
        };
        let Some(ends) = ends else { return Vec::new() };
        let level = |axis: &str| -> Vec<String> {
            ends.iter().map(|(a, b)| format!("{a}.{axis} = {b}.{axis}")).collect()
        };
        vec![Self::rule("horizontal", &level("y")), Self::rule("vertical", &level("x"))]
    }

    /// The ends of a thing that is drawn between two places.
    fn ends(&self, one: &Selected) -> Option<(Path, Path)> {
        let document = &self.state.lowered.document;
        if document.classes[one.class].kind != ClassKind::Composite {
            return None;
        }
        let fields = document.layout(one.class).into_iter();
        let places: Vec<_> = fields.filter(|&f| self.is_place(document.field_class(f))).collect();
        let [a, b] = places[..] else { return None };
        let end = |field| one.path.then(Step::Part(document.field_name(field).clone()));
        let has_length = self.message(one.class, "length").is_some();
        Some((end(a), end(b))).filter(|_| has_length)
    }

    /// What may be true of one thing alone, and is not offered yet.
    fn alone(&self, offered: &[Offer]) -> Vec<Offer> {
        let [one] = self.things else { return Vec::new() };
        let said = self.truths(one.class, 0).into_iter();
        said.map(|m| Self::rule(&words_of(&m.name), &[format!("{}.{}", one.path, m.name)]))
            .filter(|offer| offered.iter().all(|other| other.label != offer.label))
            .collect()
    }

    /// What may be true of two things, as one of them says it.
    fn pairs(&self) -> Vec<Offer> {
        let [a, b] = self.things else { return Vec::new() };
        let document = &self.state.lowered.document;
        let mut offers: Vec<Offer> = Vec::new();
        for (one, other) in [(a, b), (b, a)] {
            for message in self.truths(one.class, 1) {
                let Some(parameter) = message.parameters.first() else { continue };
                let fits = parameter.class.is_some_and(|c| document.is_a(other.class, c));
                let label = match &*message.name {
                    "passes" => "on".into(),
                    _ => words_of(&message.name),
                };
                if fits && offers.iter().all(|offer| offer.label != label) {
                    let (path, name) = (&one.path, &message.name);
                    let rule = format!("{path}.{name}({}: {})", parameter.label, other.path);
                    offers.push(Self::rule(&label, &[rule]));
                }
            }
        }
        offers
    }

    /// The messages of a class, and of those above it, whose answer is a truth value.
    fn truths(&self, class: ClassId, parameters: usize) -> Vec<&Message> {
        let document = &self.state.lowered.document;
        let classes = document.lineage(class).into_iter();
        let own = classes.filter(|&c| !document.classes[c].supers.is_empty());
        own.flat_map(|c| &document.classes[c].messages)
            .filter(|m| m.parameters.len() == parameters && is_truth(&m.answer))
            .collect()
    }

    /// Lengths or radii that are to be equal.
    fn equals(&self) -> Vec<Offer> {
        if self.things.len() < 2 {
            return Vec::new();
        }
        let has = |one: &Selected, name: &str| {
            one.thing.is_some_and(|t| self.state.structure.part_named(t, name).is_some())
                || self.has_field(one.class, name)
                || self.message(one.class, name).is_some_and(|m| m.parameters.is_empty())
        };
        let equal = |name: &str| {
            let all = self.things.iter().all(|one| has(one, name) && !self.is_place(one.class));
            let pairs = self.things.windows(2);
            let rules: Vec<String> =
                pairs.map(|p| format!("{}.{name} = {}.{name}", p[0].path, p[1].path)).collect();
            all.then(|| Self::rule(&format!("equal {name}"), &rules))
        };
        ["radius", "length"].into_iter().filter_map(equal).take(1).collect()
    }

    /// Whether things of a class have a part of a name.
    fn has_field(&self, class: ClassId, name: &str) -> bool {
        let document = &self.state.lowered.document;
        document.classes[class].kind == ClassKind::Composite
            && document.layout(class).into_iter().any(|f| **document.field_name(f) == *name)
    }

    /// A place halfway along a line.
    fn middles(&self) -> Vec<Offer> {
        let [a, b] = self.things else { return Vec::new() };
        let middle = |(point, line): (&Selected, &Selected)| {
            let has = self.message(line.class, "midpoint").is_some_and(|m| m.parameters.is_empty());
            let rule = format!("{} = {}.midpoint", point.path, line.path);
            (has && self.is_place(point.class)).then(|| Self::rule("midpoint", &[rule]))
        };
        [(a, b), (b, a)].into_iter().filter_map(middle).collect()
    }

    /// Numbers that are to hold: a length, a distance, a radius, an angle.
    fn dimensions(&self) -> Vec<Offer> {
        let document = &self.state.lowered.document;
        let distance = || {
            let [a, b] = self.things else { return None };
            let (one, other, lefts) = self.apart(a, b)?;
            let now = self.number(&distance_between(&one, &other))?;
            let offer = self.dimension("distance", &lefts, self.written(now));
            let places = thing_at(self.state, &one).zip(thing_at(self.state, &other));
            Some(self.given(places.and_then(|(a, b)| self.standing(a, b)), offer))
        };
        let single = |name: &str| {
            let [one] = self.things else { return None };
            if document.classes[one.class].kind != ClassKind::Composite {
                return None;
            }
            let path = one.path.then(Step::Part(Name::new(name)));
            let now = self.number(&Term::at(Term::Document, &path))?;
            let ends = self.ends(one).filter(|_| name == "length");
            let mut lefts = vec![path.to_string()];
            lefts.extend(ends.iter().flat_map(|(a, b)| distances(a, b)));
            let ends =
                ends.map(|(a, b)| Some((thing_at(self.state, &a)?, thing_at(self.state, &b)?)));
            // a number that is only given holds nothing: it is told like any other
            let stands = ends.flatten().and_then(|(a, b)| self.standing(a, b));
            Some(self.given(stands, self.dimension(name, &lefts, self.written(now))))
        };
        let direction = || {
            let [one] = self.things else { return None };
            self.message(one.class, "direction").filter(|m| m.parameters.is_empty())?;
            let path = one.path.then(Step::Part(Name::new("direction")));
            let (radians, _) = self.number(&Term::at(Term::Document, &path))?;
            Some(self.dimension("direction", &[path.to_string()], in_degrees(radians)))
        };
        let singles =
            ["radius", "length", "side", "width", "height"].into_iter().filter_map(single);
        let angles = self.angles().into_iter().chain(direction());
        let ratio = self.ratio();
        distance().into_iter().chain(singles).chain(angles).chain(ratio).collect()
    }

    /// How many times one of two things is as long or as large as the other, as either of them says it.
    fn ratio(&self) -> Option<Offer> {
        let equal = self.equals();
        let [a, b] = self.things else { return None };
        let part = equal.first()?.label.strip_prefix("equal ")?;
        let size = |one: &Selected| one.path.then(Step::Part(Name::new(part)));
        let offer = |one: &Selected, other: &Selected| {
            let [one, other] = [size(one), size(other)];
            let number = |path: &Path| Some(self.number(&Term::at(Term::Document, path))?.0);
            let ratio = number(&one)? / number(&other)?;
            let value = ratio.is_finite().then(|| base::number::shortest(ratio))?;
            Some(self.dimension("ratio", &[format!("{one} / {other}")], value))
        };
        let stands = offer(b, a).filter(|offer| offer.stands);
        stands.or_else(|| offer(a, b))
    }

    /// A number that is to hold, with what it is now, as the first of some terms says it that a constraint of the
    /// document gives a number already: there it stands. Else as the first of all says it.
    fn dimension(&self, label: &str, lefts: &[String], value: String) -> Offer {
        let left = |member: Member| match member {
            Member::Constraint(constraint) => {
                classing::equals_number(self.state, &constraint).map(|said| said.left)
            }
            _ => None,
        };
        let constraints = self.state.members(SyntaxKind::Constraint);
        let said: Vec<String> = constraints.filter_map(left).collect();
        let stands = lefts.iter().find(|left| said.contains(left));
        let left = stands.or(lefts.first()).map_or("", String::as_str);
        let members = format!("constraint {left} = {{}}");
        let stands = stands.is_some();
        Offer { label: label.into(), members, value: Some(value), stands, ..Offer::default() }
    }

    /// The value of a dimension that stands between two places already.
    fn standing(&self, a: ThingId, b: ThingId) -> Option<ThingId> {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let class = document.class_named("Distance")?;
        let part = |thing, name: &str| structure.part_named(thing, &Name::new(name));
        let is_between = |&(id, thing): &(ThingId, &Thing)| {
            let ends = [part(id, "from"), part(id, "to")];
            let [Some(from), Some(to)] = ends.map(|end| end.map(|end| structure.merged[end]))
            else {
                return false;
            };
            let own = [structure.merged[a], structure.merged[b]];
            document.is_a(thing.class, class) && (own == [from, to] || own == [to, from])
        };
        let (id, _) = structure.things.iter().find(is_between)?;
        part(id, "value")
    }

    /// An offer of a number; where a thing is that number, and it is given, it is given anew.
    fn given(&self, number: Option<ThingId>, offer: Offer) -> Offer {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let slot = number.and_then(|thing| structure.slot_of(thing));
        match slot.filter(|&slot| structure.given(slot).is_some() && !offer.stands) {
            Some(slot) => {
                let path = structure.path(document, structure.slots[slot].thing);
                let value = Some(words::slot_exactly(self.state, slot, &self.state.values));
                Offer { value, stands: true, deed: Deed::Give(path), ..offer }
            }
            None => offer,
        }
    }

    /// A number that something is now, in base units, with what it measures.
    fn number(&self, ask: &Term) -> Option<(f64, Dimension)> {
        let evaluator = self.state.evaluator(&self.state.values);
        match evaluator.evaluate(ask, DOCUMENT) {
            Ok(Answer::Number(x, dimension)) => Some((x, dimension)),
            _ => None,
        }
    }

    /// The same as a person writes it, with all its digits: what is added moves nothing.
    fn written(&self, (x, dimension): (f64, Dimension)) -> String {
        let quantity = kernel::Quantity { dimension, ..kernel::Quantity::default() };
        let shown = kernel::show_quantity(x, quantity, &self.state.lowered.document);
        words::with_unit(shown.exact, &shown.unit)
    }

    /// Classes that say something of such things and draw nothing of their own.
    fn classes(&self, known: &[Offer]) -> Vec<Offer> {
        if self.is_computed() {
            return Vec::new();
        }
        let document = &self.state.lowered.document;
        let classes = document.classes.iter();
        let made = classes.filter(|&(id, class)| {
            recognise::is_candidate(self.state, id, class)
                && !(class.constraints.is_empty() && class.merges.is_empty())
                && document.class_named(&class.name) == Some(id)
        });
        let mut offers: Vec<Offer> = Vec::new();
        for (id, class) in made {
            let label = words_of(&class.name);
            if known.iter().chain(&offers).any(|offer| says_the_same(&label, &offer.label)) {
                continue;
            }
            let fields = document.layout(id);
            let parts = fields.iter().filter(|&&f| {
                document.classes[document.field_class(f)].kind == ClassKind::Composite
            });
            let parts: Vec<(Name, ClassId)> =
                parts.map(|&f| (document.field_name(f).clone(), document.field_class(f))).collect();
            // a number that it is told would have to be what it is now
            if parts.len() != fields.len()
                || parts.len() != self.things.len()
                || !self.is_unseen(id)
            {
                continue;
            }
            let mut order = Vec::new();
            if !self.fits(&parts, &mut order) {
                continue;
            }
            let name = recognise::free_name(self.state, &class.name);
            let merges = parts.iter().zip(&order).map(|((field, _), &i)| {
                format!("\nmerge {} = {name}.{field}", self.things[i].path)
            });
            let members = format!("{name}: {}{}", class.name, merges.collect::<String>());
            offers.push(Offer { label, members, ..Offer::default() });
        }
        offers
    }

    /// Finds an order in which the things are the parts.
    fn fits(&self, parts: &[(Name, ClassId)], order: &mut Vec<usize>) -> bool {
        let Some((_, class)) = parts.get(order.len()) else { return true };
        (0..self.things.len()).any(|i| {
            let is_new = !order.contains(&i);
            if !is_new || !self.state.lowered.document.is_a(self.things[i].class, *class) {
                return false;
            }
            order.push(i);
            let found = self.fits(parts, order);
            if !found {
                order.pop();
            }
            found
        })
    }

    /// Whether things of a class draw nothing.
    fn is_unseen(&self, class: ClassId) -> bool {
        crate::tools::bin::picture(self.state, class) == Drawing::default()
    }
}

/// Documents of more numbers than this are offered what holds already.
const MOST_TRIED: usize = 400;

/// Takes apart what is new and what holds already, because something says so: adding that would leave as much free as
/// before. Of the latter it returns what it is called.
pub(crate) fn told_apart(
    open: &Open,
    host: &dyn Host,
    mut offers: Vec<Offer>,
) -> (Vec<Offer>, Vec<String>) {
    let state = &open.state;
    let is_left_alone = state.structure.slots.len() > MOST_TRIED || open.pane.is_some();
    if offers.is_empty() || is_left_alone {
        return (offers, Vec::new());
    }
    let rules: Vec<Vec<&str>> = offers.iter().map(rules).collect();
    let terms = terms(state, &rules.concat());
    let mut rest = terms.iter();
    let is_tried = |(offer, rules): (&Offer, &Vec<&str>)| {
        let own: Vec<&Option<Term>> = rest.by_ref().take(rules.len()).collect();
        let sets = offer.value.is_some() || offer.members.starts_with("merge ");
        // a thing that says something is tried, a rule first looked at
        !sets && own.into_iter().all(|term| is_true(state, term.as_ref()))
    };
    let tried: Vec<bool> = offers.iter().zip(&rules).map(is_tried).collect();
    if !tried.contains(&true) {
        return (offers, Vec::new());
    }
    let mut trial = open.trial();
    let before = trial.counted();
    let adds = |trial: &mut Open, offer: &Offer| {
        let added = apply::apply(trial, host, &offer.command(None)).is_ok();
        let holds = added && trial.status.satisfied && is_unmoved(state, &trial.state);
        let is_as_free = holds && trial.counted() == before;
        while trial.travel(Direction::Back).is_some() {}
        match (holds, is_as_free) {
            (false, _) => Adds::Much,
            (true, true) => Adds::Nothing,
            (true, false) => Adds::Rank,
        }
    };
    let pairs = offers.iter().zip(tried);
    let adds: Vec<Adds> = pairs
        .map(|(offer, tried)| if tried { adds(&mut trial, offer) } else { Adds::Much })
        .collect();
    let doubtful = adds.iter().zip(&rules).filter(|(adds, _)| **adds == Adds::Rank);
    let doubtful: Vec<&str> = doubtful.flat_map(|(_, rules)| rules.iter().copied()).collect();
    let followed = going_on(trial, host, &doubtful);
    let is_held = |(adds, rules): (&Adds, &Vec<&str>)| match adds {
        Adds::Much => false,
        Adds::Nothing => true,
        Adds::Rank => !rules.is_empty() && rules.iter().all(|rule| followed.contains(rule)),
    };
    let held: Vec<bool> = adds.iter().zip(&rules).map(is_held).collect();
    let labels = offers.iter().zip(&held).filter(|(_, held)| **held).map(|(o, _)| o.label.clone());
    let labels = labels.collect();
    let mut of = held.iter();
    offers.retain(|_| !of.next().copied().unwrap_or_default());
    (offers, labels)
}

/// What a document has of an offer that is added to it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Adds {
    /// Something moves, or it cannot be.
    Much,
    /// Nothing moves, though less is free: it may follow all the same.
    Rank,
    /// As much is free as before.
    Nothing,
}

/// Returns the rules that an offer says; none where it is more than rules.
fn rules(offer: &Offer) -> Vec<&str> {
    let rule = |line| str::strip_prefix(line, "constraint ");
    offer.members.lines().map(rule).collect::<Option<_>>().unwrap_or_default()
}

/// Reads rules, all at once where each means something.
fn terms(state: &State, rules: &[&str]) -> Vec<Option<Term>> {
    match plotting::read(state, rules) {
        Ok(terms) => terms.into_iter().map(Some).collect(),
        Err(_) => {
            let one = |rule: &&str| plotting::read(state, &[*rule]).ok()?.into_iter().next();
            rules.iter().map(one).collect()
        }
    }
}

fn is_true(state: &State, term: Option<&Term>) -> bool {
    let evaluator = state.evaluator(&state.values);
    term.is_some_and(|t| matches!(evaluator.evaluate(t, DOCUMENT), Ok(Answer::Bool(true))))
}

/// Whether rules hold of the numbers as they are.
pub(crate) fn holds(state: &State, rules: &[&str]) -> bool {
    terms(state, rules).iter().all(|term| is_true(state, term.as_ref()))
}

/// A rule that holds, followed while places are moved.
struct Followed<'r> {
    rule: &'r str,
    /// The numbers that it reads, and what they were.
    reads: Vec<(Path, f64)>,
    holds: bool,
    has_moved: bool,
}

/// Returns which of some rules that hold go on holding wherever the places are moved to that they read: these follow
/// from what is said, though the numbers alone do not tell.
fn going_on<'r>(mut trial: Open, host: &dyn Host, rules: &[&'r str]) -> BTreeSet<&'r str> {
    /// Of what reads more places than this it is not told.
    const MOST_MOVED: usize = 16;
    /// So many ways differ.
    const WAYS: usize = 4;
    let state = trial.state.clone();
    let mut places: Vec<ThingId> = Vec::new();
    let mut all: Vec<Followed<'r>> = Vec::new();
    for (rule, term) in rules.iter().zip(terms(&state, rules)) {
        let Some(term) = term else { continue };
        let evaluator = state.evaluator(&state.values);
        let slots = evaluator.listening(|| evaluator.evaluate(&term, DOCUMENT)).1;
        let of = |slot: &SlotId| state.structure.slots[*slot].place;
        let new: BTreeSet<ThingId> =
            slots.iter().filter_map(of).filter(|place| !places.contains(place)).collect();
        if places.len() + new.len() > MOST_MOVED {
            continue;
        }
        places.extend(new);
        let numbers =
            slots.iter().filter(|slot| state.structure.slots[**slot].primitive.is_number());
        let reads = numbers.map(|&s| (state.slot_path(s), state.values.numbers[s])).collect();
        all.push(Followed { rule, reads, holds: true, has_moved: false });
    }
    for (n, place) in places.into_iter().enumerate() {
        all.retain(|followed| followed.holds);
        if all.is_empty() {
            break;
        }
        let Some([(_, x), (_, y)]) = drag::coordinates(&state.structure, place) else { continue };
        let by = (n % WAYS + 1) as f64;
        let now = |slot| state.values.numbers[slot];
        let to = [now(x) + 17.3 * by, now(y) - 11.9 * by * by].map(Literal::Number);
        let path = state.structure.path(&state.lowered.document, place);
        let step = Command::Move(vec![(path, Literal::Tuple(to.to_vec()))]);
        if apply::apply(&mut trial, host, &step).is_err() {
            continue;
        }
        let is = &trial.state;
        let has_moved = |(path, was): &(Path, f64)| {
            let slot = thing_at(is, path).and_then(|thing| is.structure.slot_of(thing));
            slot.is_some_and(|slot| !base::number::close(is.values.numbers[slot], *was))
        };
        let said: Vec<&str> = all.iter().map(|followed| followed.rule).collect();
        for (followed, term) in all.iter_mut().zip(terms(is, &said)) {
            followed.holds = is_true(is, term.as_ref());
            followed.has_moved |= followed.reads.iter().any(has_moved);
        }
    }
    let follow = all.into_iter().filter(|followed| followed.holds && followed.has_moved);
    follow.map(|followed| followed.rule).collect()
}

/// Whether every number that a state has is the same in another.
fn is_unmoved(was: &State, is: &State) -> bool {
    was.structure.slots.ids().all(|slot| {
        let then = thing_at(is, &was.slot_path(slot)).and_then(|t| is.structure.slot_of(t));
        then.is_none_or(|then| match (was.values.get(slot), is.values.get(then)) {
            (kernel::Value::Number(a), kernel::Value::Number(b)) => base::number::close(a, b),
            (a, b) => a.same_bits(&b),
        })
    })
}

/// The term of how far a thing is from a place.
fn distance_between(one: &Path, place: &Path) -> Term {
    let value = Term::at(Term::Document, place);
    Term::Send {
        to: Box::new(Term::at(Term::Document, one)),
        name: Name::new("distance"),
        arguments: vec![Argument { label: Some(Name::new("to")), value }],
        search: None,
    }
}

/// How far two places are apart, from either.
fn distances(a: &Path, b: &Path) -> [String; 2] {
    [format!("{a}.distance(to: {b})"), format!("{b}.distance(to: {a})")]
}

/// An angle as a person writes it.
pub(crate) fn in_degrees(radians: f64) -> String {
    let degrees = radians * 180.0 / std::f64::consts::PI;
    format!("{} deg", base::number::rounded(degrees, 6))
}

/// Whether an expression is a truth value, whatever it speaks of.
fn is_truth(term: &Term) -> bool {
    match term {
        Term::Bool(_) | Term::IsA(..) | Term::Unary(UnaryOperator::Not, _) => true,
        Term::Binary(operator, ..) => {
            operator.is_comparison() || matches!(operator, BinaryOperator::And | BinaryOperator::Or)
        }
        Term::Let(_, _, inner) => is_truth(inner),
        Term::If(_, one, other) => is_truth(one) && is_truth(other),
        _ => false,
    }
}

/// Whether what a class says is offered by another label: `tangent outside` is `tangent`, `equal radii` `equal radius`.
fn says_the_same(label: &str, other: &str) -> bool {
    /// So many letters at the end of a word may change with what it says: `radius`, `radii`.
    const ENDING: usize = 2;
    let stem = other.get(..other.len().saturating_sub(ENDING)).unwrap_or(other);
    label.starts_with(other) || stem.contains(' ') && label.starts_with(stem)
}

/// A name as words: `isParallelogram` is `parallelogram`, `EqualRadii` is `equal radii`, `RCFilter` is `rc filter`.
pub(crate) fn words_of(name: &str) -> String {
    let named = name.strip_prefix("is").filter(|rest| rest.starts_with(char::is_uppercase));
    let letters: Vec<char> = named.unwrap_or(name).chars().collect();
    let mut words = String::new();
    for (i, c) in letters.iter().enumerate() {
        let follows_capital = i > 0 && letters[i - 1].is_uppercase();
        let goes_on = letters.get(i + 1).is_some_and(|c| c.is_lowercase());
        // of capitals one after the other the last begins a word, where that goes on
        if i > 0 && c.is_uppercase() && (!follows_capital || goes_on) {
            words.push(' ');
        }
        words.extend(c.to_lowercase());
    }
    words
}
