//! Annotations: what the constraints of a document say, as a draughtsman writes it on the drawing.
//!
//! In: an open document. Out: for each constraint that the document itself says of things, or a thing of it that draws
//! nothing, a dimension (`30 mm`, `R 5 mm`, `45 deg`) or a sign (`∥`, `⟂`, `H`), with the paths of what it is of. Where
//! these lie only the picture knows; so nothing here is made anew while something is dragged.

mod relations;

use crate::by_hand::class_at;
use crate::classing::{self, EqualsNumber, ReadValue};
use crate::document::Open;
use crate::offers::{REVERSED, words_of};
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Annotation, Offer, Shows};
use crate::words;
use base::Name;
use eval::{Answer, Evaluator};
use kernel::{Argument, BinaryOperator, ConstraintInstance, DOCUMENT, Path, Step, Term, ThingId};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use syntax::SyntaxKind;
use syntax::ast::{AstNode, Member};

/// Of a document with more constraints of its own nothing stands on the drawing: nobody could read it.
const MOST: usize = 1000;
/// So many digits of an angle are shown, as of other numbers.
const DIGITS: usize = 6;

/// Returns what the document's own constraints say that can stand on a drawing, after those of its relations; in the
/// pane of a class those of its prototype.
pub(crate) fn annotations(open: &Open) -> Vec<Annotation> {
    let state = &open.state;
    let evaluator = state.evaluator(open.values());
    let prototype = open.pane.as_ref();
    let prototype = prototype.and_then(|pane| thing_at(state, &pane.part(&Path::default())));
    let owner = prototype.unwrap_or(DOCUMENT);
    let is_part = |of: ThingId| state.structure.things[of].owner == Some(owner);
    let on = on(state, &evaluator, |of| of == owner || is_part(of));
    if on.len() > MOST {
        return Vec::new();
    }
    let pane = open.pane.as_ref().filter(|_| prototype.is_some());
    let numbers = match pane {
        None => by_end(state, state.members(SyntaxKind::Constraint), classing::equation),
        // what is typed in a pane is of the class, and said of the prototype
        Some(pane) => {
            let said =
                by_end(state, classing::constraints_of(state, &pane.class), classing::equation);
            let of_pane = |said: EqualsNumber| EqualsNumber {
                left: format!("{}.{}", pane.name, said.left),
                ..said
            };
            said.into_iter().map(|(end, said)| (end, of_pane(said))).collect()
        }
    };
    let (own, of_parts): (Vec<_>, Vec<_>) = on.into_iter().partition(|(_, of)| of.owner == owner);
    let said = |one| annotation(state, &evaluator, (owner, &numbers), one);
    let told = relations::signs(state, &evaluator, is_part);
    let is_told: BTreeSet<ThingId> = told.iter().map(|(thing, _)| *thing).collect();
    let others: Vec<_> =
        of_parts.into_iter().filter(|(_, of)| !is_told.contains(&of.owner)).collect();
    let in_document = |typed: &Offer| (prototype.is_none()).then(|| typed.clone());
    let relations = told.iter().map(|(_, sign)| Annotation {
        typed: sign.typed.as_ref().and_then(in_document),
        ..sign.clone()
    });
    relations.chain(others.into_iter().chain(own).filter_map(said)).collect()
}

/// The constraints of some things that are switched on, each with its index.
fn on<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    is_owner: impl Fn(ThingId) -> bool,
) -> Vec<(u32, ConstraintInstance)> {
    let all = (0u32..).zip(state.structure.constraints.iter().copied());
    all.filter(|(_, instance)| is_owner(instance.owner))
        .filter(|(_, instance)| evaluator.is_on(*instance).unwrap_or(false))
        .collect()
}

/// The constraints of the text that give something a number, by where they end.
fn numbers(state: &State) -> BTreeMap<u32, EqualsNumber> {
    by_end(state, state.members(SyntaxKind::Constraint), classing::equals_number)
}

/// Those of some constraints that give something a value, by where they end.
fn by_end(
    state: &State,
    members: impl Iterator<Item = Member>,
    read: ReadValue,
) -> BTreeMap<u32, EqualsNumber> {
    let said = members.filter_map(|member| match member {
        Member::Constraint(constraint) => {
            let end = u32::from(constraint.syntax().text_range().end());
            Some((end, read(state, &constraint)?))
        }
        _ => None,
    });
    said.collect()
}

/// Returns what gives a value another number that a constraint of the document's own says: `c.radius = 9`.
pub(crate) fn telling(open: &Open, path: &Path) -> Option<Offer> {
    if open.pane.is_some() {
        return None;
    }
    let state = &open.state;
    let document = &state.lowered.document;
    let (numbers, left) = (numbers(state), path.to_string());
    let on = on(state, &state.evaluator(open.values()), |of| of == DOCUMENT);
    let said = on.into_iter().find_map(|(_, instance)| {
        let written = &document.classes[instance.class].constraints[instance.index as usize];
        let said = numbers.get(&state.lowered.own_span(written.origin)?.end)?;
        (said.left == left).then_some(said)
    })?;
    let members = format!("constraint {left} = {{}}");
    Some(Offer { members, value: Some(said.value.clone()), ..Offer::default() })
}

/// What a rule comes to on a drawing.
struct Reading {
    shows: Shows,
    words: String,
    /// What it is of, by path as it is written.
    of: Vec<Path>,
    /// What a dimension is called, as `length`, and its number.
    measure: Option<(String, f64)>,
}

fn annotation<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    (owner, numbers): (ThingId, &BTreeMap<u32, EqualsNumber>),
    (index, instance): (u32, ConstraintInstance),
) -> Option<Annotation> {
    let document = &state.lowered.document;
    let written = &document.classes[instance.class].constraints[instance.index as usize];
    let reader = Reader { state, evaluator, owner: instance.owner };
    let reading = reader.read(&written.rule)?;
    if instance.owner != owner && !reader.is_unseen() {
        return None;
    }
    let of = reading.of.iter().map(|path| pictured(state, path)).collect::<Option<_>>()?;
    let (measure, number) = reading.measure.unzip();
    let typed = measure.clone().and_then(|label| {
        let said = numbers.get(&state.lowered.own_span(written.origin)?.end)?;
        // of an expression the left is what is measured, else that is the value
        let is_measured = said.is_number || said.left.contains(&format!(".{label}"));
        let said = is_measured.then_some(said)?;
        let (members, value) =
            (format!("constraint {} = {{}}", said.left), Some(said.value.clone()));
        Some(Offer { label, members, value, stands: true, ..Offer::default() })
    });
    let path = match instance.owner == owner {
        true => words::constraint_path(state, instance),
        false => state.structure.path(document, instance.owner).to_string(),
    };
    Some(Annotation {
        path,
        says: words::rule_alone(state, index),
        words: reading.words,
        shows: reading.shows,
        of,
        holds: evaluator.test(instance).is_ok_and(|verdict| verdict.holds),
        measure,
        number,
        typed,
    })
}

/// The path that the picture has of what is at a path: the first one of a thing that is merged.
fn pictured(state: &State, path: &Path) -> Option<String> {
    let structure = &state.structure;
    Some(match thing_at(state, path) {
        Some(thing) => structure.path(&state.lowered.document, structure.merged[thing]).to_string(),
        None => class_at(state, path).map(|_| path.to_string())?,
    })
}

/// Reads what a thing's rules say.
struct Reader<'a, 'e> {
    state: &'a State,
    evaluator: &'e Evaluator<'a>,
    owner: ThingId,
}

impl<'a> Reader<'a, '_> {
    /// Reads a rule as a draughtsman would write it.
    fn read(&self, rule: &'a Term) -> Option<Reading> {
        match rule {
            Term::Binary(BinaryOperator::Equal, left, right) => match (left.path(), right.path()) {
                (Some(a), Some(b)) => self.equality(&a, &b),
                _ => None,
            }
            // a number of the document gives a size as a written one does
            .or_else(|| self.dimension(left, right))
            .or_else(|| self.dimension(right, left)),
            Term::Send { to, name, arguments, search: None } => {
                if let Some(circle) = touched(name, arguments) {
                    return Some(Reading::relation(
                        "T",
                        vec![self.at(to)?, self.absolute(&circle)],
                    ));
                }
                let to = std::iter::once(&**to);
                let all = to.chain(arguments.iter().map(|argument| &argument.value));
                let of = all.map(|term| self.at(term)).collect::<Option<_>>()?;
                Some(Reading::relation(&sign(name), of))
            }
            _ => None,
        }
    }

    /// Whether the thing whose rules are read draws nothing: a relation of others, which is seen by its sign.
    fn is_unseen(&self) -> bool {
        let drawn = self.evaluator.ask(self.owner, &Name::new("picture"));
        matches!(drawn, Ok(Answer::Picture(elements)) if elements.is_empty())
    }

    /// The path from the document of what a term reads.
    fn at(&self, term: &Term) -> Option<Path> {
        term.path().map(|path| self.absolute(&path))
    }

    fn absolute(&self, path: &Path) -> Path {
        self.state.structure.path(&self.state.lowered.document, self.owner).join(path)
    }

    /// The sign of an equation of two paths, and what it is of.
    fn equality(&self, a: &Path, b: &Path) -> Option<Reading> {
        let state = self.state;
        let is_place = |path: &Path| {
            class_at(state, path).is_some_and(|class| state.lowered.document.is_place(class))
        };
        let (a, b) = (self.absolute(a), self.absolute(b));
        let ((one, left), (other, right)) = (parted(&a)?, parted(&b)?);
        // a number of the document is no thing's, whatever it is called
        let of_things = !one.is_empty() && !other.is_empty();
        let places = is_place(&one) && is_place(&other);
        let (words, of) = match (left, right) {
            ("x", "x") if places => ("V", vec![one, other]),
            ("y", "y") if places => ("H", vec![one, other]),
            ("length", "length") | ("radius", "radius") if of_things => ("=", vec![one, other]),
            (_, "midpoint") if is_place(&a) => ("M", vec![a.clone(), other]),
            ("midpoint", _) if is_place(&b) => ("M", vec![b.clone(), one]),
            ("center", "center") if of_things => ("◎", vec![one, other]),
            _ => return None,
        };
        Some(Reading::relation(words, of))
    }

    /// A rule that gives a length, a distance, a radius or an angle a value.
    fn dimension(&self, measured: &'a Term, value: &'a Term) -> Option<Reading> {
        let Term::Send { to, name, arguments, search: None } = measured else { return None };
        let (to, is_turned) = turned(to);
        // what the document itself says is no thing's
        let mut of = vec![self.at(to).filter(|path| !path.is_empty())?];
        let (shows, before) = match (&**name, arguments.as_slice()) {
            ("length" | "width" | "height" | "side", []) => (Shows::Length, ""),
            ("radius", []) => (Shows::Radius, "R "),
            ("diameter", []) => (Shows::Radius, "Ø "),
            ("direction", []) => (Shows::Relation, "∠ "),
            ("distance", [to]) => {
                of.push(self.at(&to.value)?);
                (Shows::Length, "")
            }
            ("angle", [to]) => {
                let (to, is_other_turned) = turned(&to.value);
                of.push(self.at(to)?);
                (Shows::Angle([is_turned, is_other_turned]), "")
            }
            _ => return None,
        };
        let Ok(Answer::Number(x, dimension)) = self.evaluator.evaluate(value, self.owner) else {
            return None;
        };
        let is_angle = matches!(shows, Shows::Angle(_)) || &**name == "direction";
        let shown = if is_angle { in_degrees(x) } else { in_words(self.state, x, dimension) };
        let measure = Some((name.to_string(), x));
        Some(Reading { shows, words: format!("{before}{shown}"), of, measure })
    }
}

impl Reading {
    fn relation(words: &str, of: Vec<Path>) -> Self {
        Self { shows: Shows::Relation, words: words.into(), of, measure: None }
    }
}

/// An angle as it stands on a drawing.
fn in_degrees(radians: f64) -> String {
    format!("{}°", base::number::significant(radians * 180.0 / PI, DIGITS))
}

/// Another number as it stands on a drawing, with its unit.
fn in_words(state: &State, x: f64, dimension: expr::Dimension) -> String {
    let quantity = kernel::Quantity { dimension, ..kernel::Quantity::default() };
    let shown = kernel::show_quantity(x, quantity, &state.lowered.document);
    words::with_unit(shown.text, &shown.unit)
}

/// What a term is of, and whether it is turned round: `-line` runs the other way.
fn turned(term: &Term) -> (&Term, bool) {
    match term {
        Term::Send { to, name, arguments, search: None }
            if **name == *REVERSED && arguments.is_empty() =>
        {
            (to, true)
        }
        _ => (term, false),
    }
}

/// The circle that a line touches where it ends, by the rule that drawing writes: that it is square to the radius
/// there, `line.perpendicular(to: Line(circle.center, line.p2))`.
fn touched(name: &str, arguments: &[Argument]) -> Option<Path> {
    let [Argument { value: Term::Make { arguments: ends, .. }, .. }] = arguments else {
        return None;
    };
    let center = ends.first().filter(|_| name == "perpendicular")?.value.path()?;
    parted(&center).filter(|(_, part)| *part == "center").map(|(circle, _)| circle)
}

/// The end of a path, and what is before it.
fn parted(path: &Path) -> Option<(Path, &str)> {
    match path.0.split_last()? {
        (Step::Part(name), whole) => Some((Path(whole.to_vec()), name)),
        _ => None,
    }
}

/// The sign of a relation by the name of the message or the class that says it; where there is none, its words.
fn sign(name: &str) -> String {
    let words = words_of(name);
    let begins = |(with, _): &&(&str, &str)| {
        words.strip_prefix(with).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
    };
    SIGNS.iter().find(begins).map_or(words.clone(), |(_, sign)| (*sign).into())
}

/// The signs of relations by the words that their names begin with.
const SIGNS: [(&str, &str); 10] = [
    ("parallel", "∥"),
    ("perpendicular", "⟂"),
    ("passes", "on"),
    ("point on", "on"),
    ("concentric", "◎"),
    ("horizontal", "H"),
    ("vertical", "V"),
    ("tangent", "T"),
    ("equal", "="),
    ("symmetric", "sym"),
];
