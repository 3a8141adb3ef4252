//! Words: how values, paths and reasons are put to people.

use crate::angles;
use crate::document::Open;
use crate::rules::told;
pub(crate) use crate::shown::show_slot;
use crate::state::State;
use crate::view::{Freedom, Refusal};
use crate::views;
use base::{Diagnostic, Place};
use expr::Dimension;
use indexmap::IndexSet;
use kernel::{
    ClassId, ClassKind, Command, ConstraintInstance, Document, Literal, Path, Primitive, Quantity,
    Shown, SlotId, Step, Structure, Term, ThingId, Values,
};
use plan::{Acting, ActingKind, Decided, EditReport, NotDecided, RefusalReason, Source};
use std::collections::BTreeSet;

/// Makes a refusal of one sentence.
#[cold]
#[inline(never)]
pub(crate) fn refuse(message: String) -> Refusal {
    Refusal { message, ..Refusal::default() }
}

/// Makes a refusal of diagnostics.
pub(crate) fn refusal_of_text(state: &State, diagnostics: &[Diagnostic]) -> Refusal {
    let message = diagnostics.first().map_or_else(String::new, |d| match &d.hint {
        Some(hint) => format!("{}: {hint}", d.message),
        None => d.message.clone(),
    });
    let diagnostics = views::text::diagnostics(state, diagnostics);
    Refusal { message, diagnostics, ..Refusal::default() }
}

/// Says why an edit was refused, and by which constraints.
pub(crate) fn refusal_for(state: &State, reason: &RefusalReason, report: &EditReport) -> Refusal {
    let (sources, are_several) = refusing(state, report);
    let mut constraints: Vec<String> =
        sources.iter().filter_map(|&source| source_name(state, source)).collect();
    let said = sources.iter().filter_map(|&source| told(state, source));
    let said = listed(&said.collect::<Vec<_>>());
    let message = match reason {
        RefusalReason::Unmet if sources.is_empty() => {
            "refused: what stands fixed does not leave room for this".to_string()
        }
        RefusalReason::Unmet if are_several => format!("refused: {said} would not all hold"),
        RefusalReason::Unmet => {
            format!("refused: {said} would not hold{}", allowed_in_words(state, &sources))
        }
        RefusalReason::NotDecided(bound) => {
            format!("not decided: {}", given_up(*bound))
        }
        RefusalReason::OutOfRange(slot) => {
            let path = state.slot_path(*slot);
            match state.structure.ranges.get(slot) {
                Some((low, high)) => format!("refused: {path} has to be one of {low}..{high}"),
                None => format!("refused: {path} cannot have this value"),
            }
        }
        RefusalReason::Anchored(slot) => {
            let held = if state.is_constant(*slot) { "constant" } else { "anchored" };
            format!("refused: {} is {held}", state.slot_path(*slot))
        }
        RefusalReason::Method(failure) => {
            let name = source_name(state, failure.source).unwrap_or_default();
            constraints.retain(|known| *known != name);
            constraints.insert(0, name.clone());
            format!("refused by {name}: {}", failure.message)
        }
        RefusalReason::Course(changes) => {
            let changes = changes.iter().map(|c| course(state, c)).collect::<Vec<_>>().join(", ");
            format!("refused: what is drawn does not settle: {changes}")
        }
        RefusalReason::Target(message) => message.clone(),
    };
    Refusal { message, constraints, ..Refusal::default() }
}

/// Says what a program does otherwise than before: `rings.column` takes 7 turns, not 6.
pub(crate) fn course(state: &State, change: &plan::CourseChange) -> String {
    let thing = state.structure.path(&state.lowered.document, change.of);
    let path = match change.path.as_str() {
        "" => thing.to_string(),
        path => format!("{thing}.{path}"),
    };
    match (change.what, change.from, change.to) {
        (Decided::Turns, Some(from), Some(1)) => format!("{path} takes 1 turn, not {from}"),
        (Decided::Turns, Some(from), Some(to)) => format!("{path} takes {to} turns, not {from}"),
        (Decided::Turns, ..) => format!("{path} takes another number of turns"),
        (Decided::Branch, ..) => format!("{path} draws another branch"),
        (Decided::Demand, ..) => format!("{path} is not met"),
        (Decided::Parameter, ..) => format!("{path} is another"),
        (Decided::Count, Some(from), Some(to)) => format!("{path} counts {to}, not {from}"),
        (Decided::Count, ..) => format!("what {path} counts is another number"),
    }
}

/// Returns the constraints for which an edit was refused: those of a conflict, since what is only downstream of it
/// has no part in it, and whether they are several; else those that would not hold.
pub(crate) fn refusing(state: &State, report: &EditReport) -> (Vec<Source>, bool) {
    let mut conflicting: Vec<Source> = Vec::new();
    for conflict in &report.conflicts {
        for &source in std::iter::once(&conflict.source).chain(&conflict.circuit) {
            if source_name(state, source).is_some() && !conflicting.contains(&source) {
                conflicting.push(source);
            }
        }
    }
    if conflicting.is_empty() {
        let required = report.unmet.iter().filter(|u| u.level == solve::Level::Required);
        return (required.map(|u| u.source).collect(), false);
    }
    let are_several = conflicting.len() > 1;
    (conflicting, are_several)
}

/// Says where a search was given up: how much was done, in round words. It counts steps of work and no time, so
/// that it is the same on every machine.
pub(crate) fn given_up(bound: NotDecided) -> String {
    match bound {
        NotDecided::Search(n) => {
            format!(
                "too hard: stopped after {} states of the search, and there were more",
                round(n)
            )
        }
        NotDecided::Round => "methods in a ring ran once round, and no other way was tried".into(),
        NotDecided::Modes(n) => {
            format!("too hard: stopped after {} combinations of conditions and bounds", round(n))
        }
        NotDecided::Whole(n) => {
            format!("too hard: stopped after {} choices of whole numbers", round(n))
        }
        NotDecided::Work(n) => {
            format!("too hard: stopped after {} steps of arithmetic", round(n))
        }
        NotDecided::Roots(n) => {
            format!("too hard: stopped after {} choices among several solutions", round(n))
        }
    }
}

/// Returns the slots that constraints read where they are tested.
pub(crate) fn read_by(state: &State, sources: &[Source]) -> BTreeSet<SlotId> {
    let evaluator = state.evaluator(&state.values);
    let constraints = sources.iter().filter_map(|source| match *source {
        Source::Constraint(index) => Some(state.structure.constraints[index as usize]),
        Source::Stay(_) | Source::Wish(_) => None,
    });
    constraints.flat_map(|c| evaluator.listening(|| evaluator.test(c)).1).collect()
}

/// Says how many values hang together with some.
pub(crate) fn solved_together(open: &mut Open, slots: &BTreeSet<SlotId>) -> String {
    let state = open.state.clone();
    let moves = |s: &SlotId| !state.structure.slots[*s].anchored;
    let count = open.planner.connected(state.model(), slots).into_iter().filter(moves).count();
    format!("{count} values are solved together")
}

/// Says a count in round words: `912 million`.
fn round(count: u64) -> String {
    let scaled = |by: u64, word: &str| {
        format!("{} {word}", base::number::significant(count as f64 / by as f64, 2))
    };
    match count {
        0..10_000 => count.to_string(),
        10_000..1_000_000 => scaled(1000, "thousand"),
        1_000_000..1_000_000_000 => scaled(1_000_000, "million"),
        _ => scaled(1_000_000_000, "billion"),
    }
}

/// Returns a number as an engineer writes the sides of a constraint's rule, in their unit.
pub(crate) fn amount(state: &State, source: Source, x: f64) -> String {
    let Shown { text, unit, .. } = match measure(state, source) {
        Some((dimension, class)) => {
            let quantity = Quantity { dimension, class, ..Quantity::default() };
            kernel::show_quantity(x, quantity, &state.lowered.document)
        }
        None => plain(base::number::significant(x, 6)),
    };
    with_unit(text, &unit)
}

/// Returns what the sides of a constraint's rule measure, where it compares two numbers, and the class of angles.
pub(crate) fn measure(state: &State, source: Source) -> Option<(Dimension, &'static str)> {
    let (instance, left, right) = sides_of(state, source)?;
    let evaluator = state.evaluator(&state.values);
    let class = angles::class_of_sides(state, &evaluator, instance.owner, [left, right]);
    match evaluator.evaluate(left, instance.owner).ok()? {
        eval::Answer::Number(_, dimension) => Some((dimension, class)),
        _ => None,
    }
}

/// Returns the two sides of a constraint's rule, where it is a comparison, and the constraint.
pub(crate) fn sides_of(state: &State, of: Source) -> Option<(ConstraintInstance, &Term, &Term)> {
    let Source::Constraint(index) = of else { return None };
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    match &*class.constraints[instance.index as usize].rule {
        Term::Binary(operator, left, right) => {
            use kernel::BinaryOperator::{Equal, Greater, GreaterEqual, Less, LessEqual};
            let compares = matches!(operator, Equal | Greater | GreaterEqual | Less | LessEqual);
            compares.then_some((instance, &**left, &**right))
        }
        _ => None,
    }
}

/// Says what the sides of a constraint's rule are with these values: `a is 3 V, b is 4 V`; nothing where it is not
/// of the form `a = b`, or a side has no value.
pub(crate) fn sides_in_words(state: &State, source: Source, values: &Values) -> Option<String> {
    let Source::Constraint(index) = source else { return None };
    let (instance, left, right) = sides_of(state, source)?;
    let rule = rule_alone(state, index);
    let [written_left, written_right] = rule.split(" = ").collect::<Vec<_>>()[..] else {
        return None;
    };
    // of a binding the part alone
    let is_name = |name: &&str| name.chars().all(|c| c.is_alphanumeric() || "._[]".contains(c));
    let part = written_left.split_once(": ").map(|(part, _)| part).filter(is_name);
    let written_left = part.unwrap_or(written_left);
    let written_right = written_right.split(" within ").next().unwrap_or(written_right);
    let evaluator = state.evaluator(values);
    let class = angles::class_of_sides(state, &evaluator, instance.owner, [left, right]);
    let said = |term, written: &str| {
        let answer = evaluator.evaluate(term, instance.owner).ok()?;
        let value = match &answer {
            eval::Answer::Text(text) => format!("\"{text}\""),
            eval::Answer::Number(x, dimension) if dimension.is_none() && rule.contains('%') => {
                views::answers::in_percent(&state.lowered.document, *x)
            }
            answer => views::answers::in_words_as(&state.lowered.document, answer, class)?,
        };
        // a number needs no saying what it is
        let number = written.trim_start_matches(['-', ' ']);
        (!number.starts_with(|c: char| c.is_ascii_digit())).then(|| format!("{written} is {value}"))
    };
    // nor does an option
    let speaks = |term: &Term| !matches!(term, Term::Text(_) | Term::Bool(_) | Term::Option(..));
    let [is_left, is_right] = [left, right].map(speaks);
    let left = said(left, written_left.trim()).filter(|_| is_left);
    let right = said(right, written_right.trim()).filter(|_| is_right);
    match (left, right) {
        (Some(left), Some(right)) => Some(format!("{left}, {right}")),
        (one, other) => one.or(other),
    }
}

/// Says why the rule of a constraint has no value; nothing where it has one.
pub(crate) fn fault(state: &State, source: Source, values: &Values) -> Option<String> {
    let Source::Constraint(index) = source else { return None };
    let instance = state.structure.constraints[index as usize];
    state.evaluator(values).test(instance).err().map(|fault| fault.message)
}

/// Returns where in the text the operation stands that leaves the rule of a constraint without a value.
pub(crate) fn place_of_fault(state: &State, source: Source, values: &Values) -> Option<Place> {
    let Source::Constraint(index) = source else { return None };
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    let member = state.lowered.place(class.constraints[instance.index as usize].origin);
    let culprit = state.evaluator(values).culprit(instance)?;
    state.lowered.operation(member, &culprit.operation, (culprit.before, culprit.all))
}

/// Says why a constraint does not hold: that a side has no value, or by how much they differ.
pub(crate) fn shortfall(state: &State, source: Source, values: &Values) -> Option<String> {
    let Source::Constraint(index) = source else { return None };
    let instance = state.structure.constraints[index as usize];
    match state.evaluator(values).test(instance) {
        Err(fault) => Some(fault.message),
        Ok(verdict) if verdict.holds => None,
        Ok(verdict) => sides_in_words(state, source, values).or_else(|| {
            let error = verdict.error.filter(|e| e.is_finite())?;
            Some(format!("it is off by {}", amount(state, source, error.abs())))
        }),
    }
}

/// Says which required constraints do not hold, as the reason why an edit was refused; nothing if all
/// do.
pub(crate) fn refusal_of_status(state: &State, status: &plan::Status) -> Option<Refusal> {
    let unmet = status.unmet.iter().filter(|u| u.level == solve::Level::Required);
    let unmet: Vec<Source> = unmet.map(|u| u.source).collect();
    let constraints: Vec<String> = unmet.iter().filter_map(|&u| source_name(state, u)).collect();
    let said: Vec<String> = unmet.iter().filter_map(|&u| told(state, u)).collect();
    let message =
        format!("refused: {} would not hold{}", listed(&said), allowed_in_words(state, &unmet));
    (!status.satisfied).then(|| Refusal { message, constraints, ..Refusal::default() })
}

/// Says which values are allowed of the parameters of programs, where constraints say that and tables hold them.
fn allowed_in_words(state: &State, sources: &[Source]) -> String {
    let document = &state.lowered.document;
    let evaluator = state.evaluator(&state.values);
    let mut said = String::new();
    for source in sources {
        let Source::Constraint(index) = *source else { continue };
        let ConstraintInstance { owner, class, index } =
            state.structure.constraints[index as usize];
        let rule = &document.classes[class].constraints[index as usize].rule;
        let Some((name, values)) = document.program(class).and_then(|_| eval::allowed_table(rule))
        else {
            continue;
        };
        let values = values.iter().map(|value| evaluator.evaluate(value, owner));
        if let Ok(values) = values.collect::<Result<Vec<_>, _>>() {
            said.push_str(&format!("; {}", evaluator.one_of_in_words(name, &values)));
        }
    }
    said
}

/// Names the required constraints that do not hold, with the rules of those that have no name.
pub(crate) fn unmet_in_words(state: &State, status: &plan::Status) -> Vec<String> {
    let unmet = status.unmet.iter().filter(|u| u.level == solve::Level::Required);
    unmet.filter_map(|u| told(state, u.source)).collect()
}

/// Lists names for a sentence: the first few, and how many more there are.
pub(crate) fn listed(names: &[String]) -> String {
    const SHOWN: usize = 4;
    match names.get(..SHOWN) {
        Some(first) if names.len() > SHOWN + 1 => {
            format!("{} and {} more", first.join(", "), names.len() - SHOWN)
        }
        _ => names.join(", "),
    }
}

/// Names slots: a place whose coordinates are all among them by its own path.
pub(crate) fn slots_listed(state: &State, slots: &[SlotId]) -> Vec<String> {
    let all: BTreeSet<SlotId> = slots.iter().copied().collect();
    let name = |&slot: &SlotId| {
        let place = state.structure.slots[slot].place;
        let whole = place
            .filter(|&place| state.structure.slots_under(place).iter().all(|s| all.contains(s)));
        match whole {
            Some(place) => state.structure.path(&state.lowered.document, place).to_string(),
            None => state.slot_path(slot).to_string(),
        }
    };
    let names: IndexSet<String> = slots.iter().map(name).collect();
    names.into_iter().collect()
}

/// Says what holds a drag that did not reach the pointer; nothing where no constraint can be named.
pub(crate) fn what_holds(state: &State, report: &EditReport, acting: &[Acting]) -> Option<String> {
    let mut names: Vec<String> = Vec::new();
    for conflict in &report.conflicts {
        let sources = std::iter::once(&conflict.source).chain(&conflict.circuit);
        for name in sources.filter_map(|s| told(state, *s)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    let bounds = acting.iter().filter(|a| a.kind == ActingKind::AtBound);
    for name in bounds.filter_map(|a| told(state, a.source)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    (!names.is_empty()).then(|| format!("held by {}", listed(&names)))
}

/// Returns the path and name of a constraint; nothing for a wish.
pub(crate) fn source_name(state: &State, source: Source) -> Option<String> {
    match source {
        Source::Constraint(c) => {
            Some(constraint_path(state, state.structure.constraints[c as usize]))
        }
        Source::Stay(s) => {
            let thing = state.structure.stays[s as usize].thing;
            Some(format!("stay {}", state.structure.path(&state.lowered.document, thing)))
        }
        Source::Wish(_) => None,
    }
}

/// Returns the path of a constraint: its owner's, and its name.
pub(crate) fn constraint_path(state: &State, instance: ConstraintInstance) -> String {
    let document = &state.lowered.document;
    let owner = state.structure.path(document, instance.owner);
    owner.then(Step::Part(constraint_name(document, instance).as_str().into())).to_string()
}

/// Returns a constraint's name; one without is called after its place among its class's.
pub(crate) fn constraint_name(document: &Document, instance: ConstraintInstance) -> String {
    let constraint = &document.classes[instance.class].constraints[instance.index as usize];
    match &constraint.name {
        Some(name) => name.to_string(),
        None => format!("constraint{}", instance.index + 1),
    }
}

/// Returns the rule of a constraint as it is written, without its methods.
pub(crate) fn rule_of(state: &State, index: u32) -> String {
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    let written = state.lowered.source_of(class.constraints[instance.index as usize].origin);
    let rule = written.strip_suffix('}').and_then(|w| w.split_once('{')).map(|(rule, _)| rule);
    rule.unwrap_or(&written).trim().to_string()
}

/// Returns the rule of a constraint as it is written, without its strength, name and methods.
pub(crate) fn rule_alone(state: &State, index: u32) -> String {
    let instance = state.structure.constraints[index as usize];
    let declared =
        &state.lowered.document.classes[instance.class].constraints[instance.index as usize];
    let written = rule_of(state, index);
    let rule = written.split_once("constraint").map_or(written.as_str(), |(_, rest)| rest.trim());
    let named =
        declared.name.as_deref().and_then(|name| rule.strip_prefix(name)?.strip_prefix(':'));
    named.unwrap_or(rule).trim().to_string()
}

/// Says how a constraint of this name acts in a mode.
pub(crate) fn acting(state: &State, name: &str, kind: ActingKind) -> String {
    match kind {
        ActingKind::Whole { slot, value } => {
            format!("{} is {} now", state.slot_path(slot), base::number::shortest(value))
        }
        ActingKind::AtBound => format!("{name} is at its bound"),
        ActingKind::Assumed(true) => format!("the condition of {name} is true"),
        ActingKind::Assumed(false) => format!("the condition of {name} is false"),
        ActingKind::Taken { way, of } => format!("{name} holds by alternative {} of {of}", way + 1),
    }
}

/// Returns what a thing is, in the words of its class where that has some.
pub(crate) fn description(state: &State, thing: ThingId, values: &Values) -> String {
    let own = crate::general::defines(state, thing, "description").then(|| {
        let evaluator = state.evaluator(values);
        evaluator.ask(thing, &base::Name::new("description")).ok()
    });
    match own.flatten() {
        Some(eval::Answer::Text(words)) => words.to_string(),
        _ => class_name(state, thing),
    }
}

/// Returns the path that a term of parts and messages spells.
pub(crate) fn term_path(term: &Term) -> String {
    match term {
        Term::Send { to, name, .. } if **to == Term::Me => name.to_string(),
        Term::Send { to, name, .. } => format!("{}.{name}", term_path(to)),
        Term::Index(of, at) => match &**at {
            Term::Number { value, .. } => format!("{}[{value}]", term_path(of)),
            _ => term_path(of),
        },
        _ => String::new(),
    }
}

/// Finds the thing at a path.
///
/// # Errors
/// That there is none, with the nearest name that there is.
pub(crate) fn find(state: &State, path: &Path) -> Result<ThingId, Refusal> {
    state.structure.follow(kernel::DOCUMENT, path).map_err(|astray| {
        let layout = state.structure.layout(state.structure.things[astray.at].class);
        let step = Path(vec![path.0[astray.step].clone()]).to_string();
        let names = layout.into_iter().flat_map(|l| l.index.keys().map(base::Name::as_str));
        let hint = base::diagnostic::nearest(&step, names)
            .map_or_else(String::new, |n| format!("; did you mean {n}?"));
        let place = match &path.0[..astray.step] {
            [] => "here".to_string(),
            whole => format!("in {}", Path(whole.to_vec())),
        };
        refuse(format!("there is no {step} {place}{hint}"))
    })
}

/// Returns what is known of the number in a slot beside its value, and what is written for it.
pub(crate) fn quantity_of<'s>(state: &'s State, slot: SlotId, written: &'s str) -> Quantity<'s> {
    let s = &state.structure.slots[slot];
    let dimension = match s.primitive {
        Primitive::Real(dimension) => dimension,
        Primitive::Integer
        | Primitive::Bool
        | Primitive::Choice(_)
        | Primitive::Text
        | Primitive::Color => Dimension::NONE,
    };
    let document = &state.lowered.document;
    let class = document.named_class(state.structure.things[s.thing].class);
    Quantity { dimension, class: &document.classes[class].name, written }
}

/// Returns the text of the value that is given to a slot, of `Beam(2 m, 10 %)` what counts for it; of a long list its
/// last elements; empty where none is.
pub(crate) fn written_for(state: &State, slot: SlotId) -> String {
    let Some(given) = state.structure.given(slot) else { return String::new() };
    // what a library gives by default is no choice of the document's
    if given.of_class && state.lowered.own_span(given.origin).is_none() {
        return String::new();
    }
    let written = state.lowered.written(given.origin);
    let own = match &*given.term {
        Term::Number { value, dimension, .. } if written.contains(',') => {
            let is_it =
                |item: &&str| is_number(&state.lowered.document, item, (*value, *dimension));
            let items = written.split([',', '(', ')', '[', ']']);
            items.map(|item| item.rsplit(':').next().unwrap_or(item).trim()).find(is_it)
        }
        _ => None,
    };
    own.unwrap_or(written).to_string()
}

/// Returns true for the text of a number with its unit, or of a bare one.
fn is_number(document: &Document, text: &str, (value, dimension): (f64, Dimension)) -> bool {
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '_' | '-' | 'e');
    let (digits, unit) = text.split_at(text.find(|c| !is_of_number(c)).unwrap_or(text.len()));
    let unit = unit.trim();
    if unit.is_empty() {
        let bare = digits.parse().ok();
        return bare.is_some_and(|x| kernel::quantity::from_bare(document, x, dimension) == value);
    }
    let read = expr::units::read_quantity(digits, unit);
    read.is_some_and(|(si, of)| {
        of == dimension && kernel::quantity::from_si(document, si, of) == value
    })
}

/// Returns a number that is near the one of a slot and has no more than so many decimals as it is written: a number
/// without a unit in the text as it is, else in the unit in which people read it.
pub(crate) fn shortened(state: &State, slot: SlotId, values: &Values, decimals: usize) -> f64 {
    let x = values.numbers[slot];
    let document = &state.lowered.document;
    let written = written_for(state, slot);
    let quantity = quantity_of(state, slot, &written);
    let is_own = state.structure.given(slot).is_some_and(|given| !given.of_class);
    let unit = match is_own && written.trim().parse::<f64>().is_ok() {
        true => String::new(),
        false => kernel::quantity::spelling_for(x, quantity, document),
    };
    let shown = kernel::in_unit(x, quantity.dimension, &unit, document);
    let text = base::number::rounded(shown, decimals);
    match expr::units::read_quantity(&text, &unit).filter(|_| !unit.is_empty()) {
        Some((si, of)) => kernel::quantity::from_si(document, si, of),
        None => text
            .parse()
            .map_or(x, |bare| kernel::quantity::from_bare(document, bare, quantity.dimension)),
    }
}

/// Returns what has no unit, as it is.
pub(crate) fn plain(text: String) -> Shown {
    Shown { exact: text.clone(), text, unit: String::new() }
}

/// Returns a value with its unit, as a person reads it.
pub(crate) fn slot_in_words(state: &State, slot: SlotId, values: &Values) -> String {
    let Shown { text, unit, .. } = show_slot(state, slot, values);
    with_unit(text, &unit)
}

/// Returns a value with its unit and all its digits.
pub(crate) fn slot_exactly(state: &State, slot: SlotId, values: &Values) -> String {
    let Shown { exact, unit, .. } = show_slot(state, slot, values);
    with_unit(exact, &unit)
}

/// So many digits are tried where six do not tell two numbers apart.
const MORE_DIGITS: [usize; 3] = [8, 10, 12];

/// Returns a value with its unit, to so many digits.
fn slot_in_digits(state: &State, slot: SlotId, values: &Values, digits: usize) -> String {
    let Shown { exact, unit, .. } = show_slot(state, slot, values);
    let x = exact.parse().map(|x| base::number::significant(x, digits));
    with_unit(x.unwrap_or(exact), &unit)
}

/// Puts a number and its unit together, where it has one.
pub(crate) fn with_unit(text: String, unit: &str) -> String {
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

/// Returns the value of a thing to six digits, if it is primitive or a place.
pub(crate) fn show_thing(state: &State, thing: ThingId, values: &Values) -> Option<String> {
    each_slot(state, thing, |slot| slot_in_words(state, slot, values))
}

/// Returns what the value of a thing was and is, if it is primitive or a place: to six digits, or to as many as tell
/// them apart.
pub(crate) fn show_both(
    state: &State,
    thing: ThingId,
    [was, is]: [&Values; 2],
) -> Option<[String; 2]> {
    let both = [show_thing(state, thing, was)?, show_thing(state, thing, is)?];
    if both[0] != both[1] {
        return Some(both);
    }
    // a few more digits often tell them apart
    let shown = |digits| {
        let in_digits = |slot, values| slot_in_digits(state, slot, values, digits);
        let show = |values| each_slot(state, thing, |slot| in_digits(slot, values));
        Some([show(was)?, show(is)?])
    };
    let some = MORE_DIGITS.into_iter().filter_map(shown).find(|both| both[0] != both[1]);
    let exactly = |values| show_thing_exactly(state, thing, values);
    some.or_else(|| Some([exactly(was)?, exactly(is)?]))
}

/// Returns the value of a thing with all its digits, if it is primitive or a place.
pub(crate) fn show_thing_exactly(state: &State, thing: ThingId, values: &Values) -> Option<String> {
    each_slot(state, thing, |slot| slot_exactly(state, slot, values))
}

fn each_slot(state: &State, thing: ThingId, show: impl Fn(SlotId) -> String) -> Option<String> {
    match state.structure.slot_of(thing) {
        Some(slot) => Some(show(slot)),
        None if state.lowered.document.is_place(state.structure.things[thing].class) => {
            let slots = state.structure.slots_under(thing);
            Some(format!("({})", slots.into_iter().map(show).collect::<Vec<_>>().join(", ")))
        }
        None => None,
    }
}

/// Returns the class of a thing; for a class of one, the class that it comes from.
pub(crate) fn class_name(state: &State, thing: ThingId) -> String {
    let document = &state.lowered.document;
    let class = state.structure.things[thing].class;
    match &document.classes[class].kind {
        ClassKind::List(element) => {
            let n = state.structure.things[thing].parts;
            format!("List of {n} {}", document.classes[*element].name)
        }
        _ => document.classes[document.named_class(class)].name.to_string(),
    }
}

/// Returns what `///` says of a thing: of its part, else of its class.
pub(crate) fn doc_of(state: &State, thing: ThingId) -> String {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let t = &structure.things[thing];
    let declared = t.owner.and_then(|owner| {
        let layout = structure.layout(structure.things[owner].class)?;
        document.declared(*layout.fields.get(t.field as usize)?)
    });
    match declared {
        Some(part) if !part.doc.is_empty() => part.doc.clone(),
        Some(_) | None => document.classes[t.class].doc.clone(),
    }
}

/// Returns the state of a thing's values.
pub(crate) fn freedom_of(
    structure: &Structure,
    status: &plan::Status,
    thing: ThingId,
) -> Option<Freedom> {
    if let Some(slot) = structure.slot_of(thing) {
        return Some(match status.slots[slot] {
            plan::SlotState::Conflicting => Freedom::Conflicting,
            plan::SlotState::Free => Freedom::Free,
            plan::SlotState::Fixed => Freedom::Fixed,
        });
    }
    let slots = structure.slots_under(thing);
    let of = |f: plan::SlotState| slots.iter().any(|&s| status.slots[s] == f);
    if slots.is_empty() {
        None
    } else if of(plan::SlotState::Conflicting) {
        Some(Freedom::Conflicting)
    } else if of(plan::SlotState::Free) {
        Some(Freedom::Free)
    } else {
        Some(Freedom::Fixed)
    }
}

/// Reads what a person typed into a value.
///
/// # Errors
/// What was found and what was wanted.
pub(crate) fn read_typed(state: &State, path: &Path, typed: &str) -> Result<Literal, Refusal> {
    let class = crate::session::thing_at(state, path).map(|t| state.structure.things[t].class);
    let is_words = |class: ClassId| {
        let kind = &state.lowered.document.classes[class].kind;
        matches!(kind, ClassKind::Primitive(Primitive::Text | Primitive::Color))
    };
    if names_another(state, path)
        && !class.is_some_and(is_words)
        && let Some(other) = crate::parse_path(typed.trim())
    {
        find(state, &other)?;
        return Ok(Literal::Path(other));
    }
    let kind = class.map_or(lang::Wanted::Anything, lang::Wanted::Class);
    lang::read_literal(typed, kind, &state.lowered.document).map_err(|d| refuse(with_hint(d)))
}

/// What a diagnostic says, and its hint.
pub(crate) fn with_hint(d: Diagnostic) -> String {
    match d.hint {
        Some(hint) => format!("{}; {hint}", d.message),
        None => d.message,
    }
}

/// Returns true for a part that names another: a `Path to C`, or an element of a list of such.
pub(crate) fn names_another(state: &State, path: &Path) -> bool {
    let Some((last, owner)) = path.0.split_last() else { return false };
    let structure = &state.structure;
    let Ok(owner) = structure.follow(kernel::DOCUMENT, &Path(owner.to_vec())) else { return false };
    let document = &state.lowered.document;
    let part = match last {
        Step::Part(name) => structure.part_named(owner, name),
        Step::Index(i) => structure.parts(owner).nth(*i as usize),
        Step::Last => structure.parts(owner).last(),
        Step::Owner => None,
    };
    let class = part.map(|p| &document.classes[structure.things[p].class].kind);
    matches!(class, Some(ClassKind::Reference(_)))
}

/// Returns what the undo list calls a command.
pub(crate) fn command_label(command: &Command) -> String {
    let paths =
        |paths: &[Path]| paths.iter().map(ToString::to_string).collect::<Vec<_>>().join(" = ");
    match command {
        Command::Set(t) | Command::Move(t) => {
            paths(&t.iter().map(|t| t.0.clone()).collect::<Vec<_>>())
        }
        Command::Merge(p) => format!("merge {}", paths(p)),
        Command::Unmerge(p) => format!("unmerge {p}"),
        Command::Delete(p) => format!("delete {p}"),
        Command::Edit { target, members } if target.is_empty() => added(members),
        Command::Edit { target, .. } => format!("edit {target}"),
        Command::Rename { from, to } => format!("rename {from} to {to}"),
        Command::Promote { path, class } => format!("promote {path} as {class}"),
        Command::Anchor { path, held: true } => format!("anchor {path}"),
        Command::Anchor { path, held: false } => format!("let go of {path}"),
        Command::Enable { path, on: true } => format!("switch {path} on"),
        Command::Enable { path, on: false } => format!("switch {path} off"),
        Command::Text(_) => "edit text".into(),
        Command::Undo => "undo".into(),
        Command::Redo => "redo".into(),
    }
}

/// Returns what adding members to a document is called: by the first of them.
fn added(members: &str) -> String {
    /// A rule is told by so many letters at most.
    const MOST: usize = 40;
    let first = members.trim().lines().next().unwrap_or_default().trim();
    let short = |text: &str| match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", text[..end].trim_end()),
        None => text.to_string(),
    };
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    match first.split_once([':', ' ']) {
        Some(("constraint", rule)) => format!("constrain {}", short(rule.trim())),
        Some((name, _)) if first.starts_with(&format!("{name}:")) && is_name(name) => {
            format!("add {name}")
        }
        _ if first.is_empty() => "add nothing".into(),
        _ => short(first),
    }
}

/// Returns a document's title: what its text says of itself up to the first colon or full stop; else its name,
/// without folder and ending.
pub(crate) fn title(open: &Open) -> String {
    let doc = &open.state.lowered.doc;
    let end = doc.find([':', '.', '\n']).unwrap_or(doc.len());
    let title = doc[..end].trim();
    if !title.is_empty() && title.chars().count() <= 40 {
        return title.into();
    }
    let name = open.name.rsplit('/').next().unwrap_or(&open.name);
    name.strip_suffix(".thing").unwrap_or(name).replace(['-', '_'], " ")
}
