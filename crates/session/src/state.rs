//! A document at one moment: its text, what the text means, and the values that it comes to.
//!
//! A state is made from a text and never changed. What a member with an error meant before is taken
//! from the state before it; apart from that the text alone decides, bit for bit.

use crate::given_twice;
use crate::host::Host;
use crate::texts::Texts;
use base::{Diagnostic, FileId};
use eval::{Evaluator, Known};
use kernel::{OriginId, SlotId, Strength, Structure, ThingId, Value, Values};
use lang::Lowered;
use plan::{Model, Planner, Plans, Source, Status, Surplus, Unmet};
use solve::Level;
use std::collections::BTreeSet;
use std::rc::Rc;
use syntax::{SyntaxKind, ast};

/// The code for a reference that names nothing.
const LOST: &str = "unknown-reference";

/// So many errors of a document are told one by one, and so many warnings.
const MOST_TOLD: usize = 500;

/// How many times a document is opened for what copies begin with: so deep may copies be computed from other copies.
const MOST_COPIES: usize = 16;

/// A document at one moment.
pub(crate) struct State {
    /// The text.
    pub(crate) text: String,
    /// What the text means.
    pub(crate) lowered: Lowered,
    /// Its things.
    pub(crate) structure: Structure,
    /// What is in their slots.
    pub(crate) values: Values,
    /// What is wrong with the text, in its order.
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// How many there are besides.
    pub(crate) untold: Untold,
    /// Members that no plan keeps, because the planner does not understand them yet.
    unplanned: BTreeSet<OriginId>,
    /// Where two solutions coincide.
    pub(crate) double_roots: Vec<SlotId>,
    /// What is given, by the text itself or by a class, and could not stay, with what it is given.
    pub(crate) gave_way: Vec<(SlotId, Value)>,
    /// What evaluators looked up of its things.
    known: Known,
    /// The same in states of the same things that differ by edits of values alone: what is said of a thing there,
    /// and how it is drawn, follows from its values as it did before.
    form: Rc<()>,
}

impl State {
    /// Makes the state of a text, and the planner for it. Never fails.
    pub(crate) fn of(
        text: String,
        before: Option<&Self>,
        host: &dyn Host,
        plans: Plans,
    ) -> (Self, Planner) {
        let load = |name: &str| host.read(name);
        let lowered = lang::lower(&text, &load, before.map(|b| &b.lowered));
        Self::meant(text, lowered, before, host, plans)
    }

    /// Makes the state of a text by which a hand may have made places one, and its planner: what of them no longer
    /// counts is taken out of the text, where all begins with the same values without it.
    pub(crate) fn of_joined(
        text: String,
        before: &Self,
        host: &dyn Host,
        plans: Plans,
    ) -> (Self, Planner) {
        let load = |name: &str| host.read(name);
        let lowered = lang::lower(&text, &load, Some(&before.lowered));
        let twice = Structured::of(text, lowered, Some(before));
        let once = twice.given_once(before, &load);
        once.unwrap_or(twice).planned(plans).solved().told(host)
    }

    /// Makes the state of a text that an edit of values wrote: it counts in the units of the state before.
    pub(crate) fn written(
        text: String,
        before: &Self,
        host: &dyn Host,
        plans: Plans,
    ) -> (Self, Planner) {
        let load = |name: &str| host.read(name);
        let lowered = lang::lower_written(&text, &load, &before.lowered);
        let (mut state, planner) = Self::meant(text, lowered, Some(before), host, plans);
        state.keep_form_of(before);
        (state, planner)
    }

    /// Makes the state of a text whose values a copy of the document has found, and its planner: nothing is solved.
    ///
    /// # Errors
    /// The text has other slots; the plans come back.
    pub(crate) fn found(
        text: String,
        before: &Self,
        host: &dyn Host,
        plans: Plans,
        found: Found,
    ) -> Result<(Self, Planner), Box<Plans>> {
        let load = |name: &str| host.read(name);
        let lowered = match found.has_form {
            true => lang::lower_written(&text, &load, &before.lowered),
            false => lang::lower(&text, &load, Some(&before.lowered)),
        };
        let of = Structured::of(text, lowered, Some(before));
        if of.structure.slots.len() != found.values.numbers.len() {
            return Err(Box::new(plans));
        }
        let has_form = found.has_form;
        let (mut state, planner) = of.planned(plans).holding(found).told(host);
        if has_form {
            state.keep_form_of(before);
        }
        Ok((state, planner))
    }

    fn keep_form_of(&mut self, before: &Self) {
        let (now, was) = (&self.structure, &before.structure);
        if now.has_things_of(was) && now.constraints == was.constraints {
            self.form = before.form.clone();
        }
    }
    /// Returns the tree of its text.
    pub(crate) fn file(&self) -> ast::File {
        self.lowered.files[FileId(0)].parse.file()
    }
    /// Returns the members at the top of its text that are of one kind.
    pub(crate) fn members(&self, of: SyntaxKind) -> impl Iterator<Item = ast::Member> {
        let (file, outline) = (self.file(), self.lowered.files[FileId(0)].parse.outline());
        outline
            .filter(move |(kind, _)| *kind == of)
            .filter_map(move |(_, span)| file.member_at(span))
    }
    /// Returns true if another state differs from it by edits of values alone.
    pub(crate) fn has_form_of(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.form, &other.form)
    }

    fn meant(
        text: String,
        lowered: Lowered,
        before: Option<&Self>,
        host: &dyn Host,
        plans: Plans,
    ) -> (Self, Planner) {
        Structured::of(text, lowered, before).planned(plans).solved().told(host)
    }
    /// Returns true if what the document uses is still as it was read.
    pub(crate) fn is_up_to_date(&self, host: &dyn Host) -> bool {
        let mut used =
            self.lowered.files.iter().map(|(_, file)| file).filter(|f| !f.name.is_empty());
        used.all(|file| host.read(&file.name).is_some_and(|text| *text == *file.text))
            && self.lowered.missing.iter().all(|name| host.read(name).is_none())
    }
    /// Returns the given numbers that gave way; not those of places, which yield as a matter of course.
    pub(crate) fn yielded(&self) -> impl Iterator<Item = SlotId> {
        let slots = &self.structure.slots;
        let is_lone = |s: &SlotId| slots[*s].primitive.is_number() && slots[*s].place.is_none();
        self.gave_way.iter().map(|(slot, _)| *slot).filter(is_lone)
    }
    /// Returns how many errors the text has, those among them that are not told one by one.
    pub(crate) fn errors(&self) -> usize {
        let is_error = |d: &&Diagnostic| d.severity == base::Severity::Error && d.code != MORE;
        self.diagnostics.iter().filter(is_error).count() + self.untold.errors
    }
    /// Returns true if something is wrong with the text.
    pub(crate) fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|d| d.severity == base::Severity::Error)
    }
    /// Returns what every question to the planner is about.
    pub(crate) fn model(&self) -> Model<'_> {
        Model { document: &self.lowered.document, structure: &self.structure }
    }
    /// Returns true for a constraint of the structure that has a place in a plan.
    pub(crate) fn is_planned(&self, index: u32) -> bool {
        let instance = self.structure.constraints[index as usize];
        let class = &self.lowered.document.classes[instance.class];
        !self.unplanned.contains(&class.constraints[instance.index as usize].origin)
    }
    /// Returns what holds and what is free. A rule that no plan keeps is tested all the same.
    pub(crate) fn status(&self, planner: &mut Planner) -> Status {
        let mut texts = Texts::new(&self.lowered.document, &self.structure);
        let mut status = planner.status(self.model(), &self.values, &mut texts);
        if self.unplanned.is_empty() {
            return status;
        }
        let evaluator = self.evaluator(&self.values);
        let told: BTreeSet<Source> = status.unmet.iter().map(|unmet| unmet.source).collect();
        for (index, &instance) in (0..).zip(self.structure.constraints.iter()) {
            let required = self.structure.strength(&self.lowered.document, instance)
                == Strength::Required
                && self.structure.is_on(instance);
            let source = Source::Constraint(index);
            if self.is_planned(index) || !required || told.contains(&source) {
                continue;
            }
            let verdict = evaluator.test(instance).ok();
            if !verdict.as_ref().is_some_and(|v| v.holds) {
                let error = verdict.and_then(|v| v.error);
                status.unmet.push(Unmet { source, level: Level::Required, error });
                status.satisfied = false;
            }
        }
        status
    }
    /// Returns how many constraints are superfluous in a state that stands like this, and what is free because of it.
    pub(crate) fn surplus(&self, planner: &mut Planner, status: &Status) -> Surplus {
        let mut texts = Texts::new(&self.lowered.document, &self.structure);
        planner.surplus(self.model(), &self.values, &status.unmet, &mut texts)
    }
    /// Returns an evaluator of this state, or of other values of it.
    pub(crate) fn evaluator<'a>(&'a self, values: &'a Values) -> Evaluator<'a> {
        Evaluator::knowing(&self.lowered.document, &self.structure, values, &self.known)
    }
    /// Returns the path of the first thing of a slot, as the language writes it.
    pub(crate) fn slot_path(&self, slot: SlotId) -> kernel::Path {
        self.structure.path(&self.lowered.document, self.structure.slots[slot].thing)
    }
    /// Returns the path of the place that a slot is a coordinate of, else its own.
    pub(crate) fn place_path(&self, slot: SlotId) -> kernel::Path {
        let s = &self.structure.slots[slot];
        self.structure.path(&self.lowered.document, s.place.unwrap_or(s.thing))
    }
    /// Returns true for what its class, or the text, declares as a `constant`.
    pub(crate) fn is_constant(&self, slot: SlotId) -> bool {
        let thing = &self.structure.things[self.structure.slots[slot].thing];
        let path = self.slot_path(slot);
        let (Some(kernel::Step::Part(name)), Some(owner)) = (path.0.last(), thing.owner) else {
            return false;
        };
        self.lowered.is_constant(self.structure.things[owner].class, name)
    }
}

/// What a copy of a document found of a text that an edit led to.
pub(crate) struct Found {
    pub(crate) values: Values,
    pub(crate) double_roots: Vec<SlotId>,
    /// The edit was one of values alone.
    pub(crate) has_form: bool,
}

/// The first stage of a state: what the text means, and its things.
pub(crate) struct Structured {
    text: String,
    lowered: Lowered,
    structure: Structure,
    faults: Vec<kernel::Fault>,
}

/// The second stage: rules, components and plans.
pub(crate) struct Planned {
    of: Structured,
    planner: Planner,
    unplanned: Vec<plan::Fault>,
}

/// The third stage: the values.
pub(crate) struct Solved {
    of: Planned,
    given: Values,
    given_faults: Vec<eval::Fault>,
    values: Values,
    double_roots: Vec<SlotId>,
}

impl Structured {
    /// Makes the things of a text.
    pub(crate) fn of(text: String, lowered: Lowered, before: Option<&State>) -> Self {
        let known = before.map(|b| (&b.lowered.document, &b.structure));
        let (structure, mut faults) = match known {
            Some(before) => kernel::instantiate_again(&lowered.document, before),
            None => kernel::instantiate(&lowered.document),
        };
        let idle = lowered.own_classes().filter(|&c| structure.layout(c).is_none());
        for fault in kernel::faults_of(&lowered.document, idle) {
            if !faults.contains(&fault) {
                faults.push(fault);
            }
        }
        debug_assert_eq!(kernel::check::structure(&lowered.document, &structure), Ok(()));
        Self { text, lowered, structure, faults }
    }
    /// Returns the same without what its text gives besides what counts, since places are one that were not before;
    /// nothing where there is none of it, or all would begin otherwise.
    fn given_once(&self, before: &State, load: &dyn Fn(&str) -> Option<String>) -> Option<Self> {
        if self.lowered.diagnostics.iter().any(|d| d.severity == base::Severity::Error) {
            return None;
        }
        let edits = given_twice::forgotten(before, (&self.lowered, &self.structure));
        if edits.is_empty() {
            return None;
        }
        let text = syntax::edit::apply(&self.text, &edits);
        let lowered = lang::lower(&text, load, Some(&self.lowered));
        let once = Self::of(text, lowered, Some(before));
        let given = |of: &Self| eval::given_values(&of.lowered.document, &of.structure).0;
        let is_same = once.structure.slots.len() == self.structure.slots.len();
        (is_same && given(&once) == given(self)).then_some(once)
    }
    /// Makes their planner.
    pub(crate) fn planned(self, plans: Plans) -> Planned {
        let Self { lowered, structure, .. } = &self;
        let model = Model { document: &lowered.document, structure };
        let (planner, unplanned) = Planner::new(model, plans);
        let unplanned = unplanned.into_iter().filter(|f| !follows(&self, f)).collect();
        Planned { of: self, planner, unplanned }
    }
}

impl Planned {
    /// Computes the values.
    pub(crate) fn solved(mut self) -> Solved {
        let Structured { lowered, structure, .. } = &self.of;
        let model = Model { document: &lowered.document, structure };
        let (given, mut given_faults) = eval::given_values(&lowered.document, structure);
        let mut values = Values::new(structure.slots.len());
        let mut texts = Texts::knowing(&lowered.document, structure, &given);
        let mut double_roots = self.planner.open(model, &mut values, &mut texts).double_roots;
        // what a copy begins with is known once that is computed which it is a copy of
        for _ in 0..MOST_COPIES {
            if !texts.copy(&values) {
                break;
            }
            double_roots = self.planner.open(model, &mut values, &mut texts).double_roots;
        }
        self.planner.take_sides(model, &mut values, &mut texts);
        given_faults.extend(texts.unlike_copy(&values).map(|origin| eval::Fault {
            origin: Some(origin),
            kind: eval::FaultKind::Endless,
            message: format!(
                "what this is a copy of depends on it, or on more than {MOST_COPIES} copies in turn"
            ),
        }));
        crate::placing::place_layout(&lowered.document, structure, &self.planner, &mut values);
        self.note_course_faults();
        Solved { of: self, given, given_faults, values, double_roots }
    }

    /// Takes the values that were found elsewhere.
    fn holding(mut self, found: Found) -> Solved {
        let Structured { lowered, structure, .. } = &self.of;
        let model = Model { document: &lowered.document, structure };
        let (given, given_faults) = eval::given_values(&lowered.document, structure);
        let Found { values, double_roots, .. } = found;
        self.planner.take_course(model, &values);
        self.note_course_faults();
        Solved { of: self, given, given_faults, values, double_roots }
    }

    fn note_course_faults(&mut self) {
        let on_course = self.planner.course_faults().iter().filter(|f| !follows(&self.of, f));
        self.unplanned.extend(on_course.cloned());
    }
}

impl Solved {
    /// Says what is wrong with it.
    pub(crate) fn told(self, host: &dyn Host) -> (State, Planner) {
        let Self { of, given, given_faults, values, double_roots } = self;
        let Planned { of, planner, unplanned } = of;
        let Structured { text, lowered, structure, faults } = of;
        let gave_way = gave_way(&structure, &given, &values);
        let mut diagnostics = lowered.diagnostics.clone();
        diagnostics.extend(lowered.fault_diagnostics(&faults));
        // that a reference names nothing is said at its place, and not at all that goes through it
        let lost = diagnostics.iter().any(|d| d.code == LOST);
        // of a value that is bound part by part a fault is one
        let mut said = BTreeSet::new();
        let through = unplanned
            .iter()
            .map(|f| unplanned_diagnostic(&text, &lowered, f))
            .chain(given_diagnostics(&lowered, &given_faults))
            .filter(|d| !(lost && d.code == LOST))
            .filter(|d| said.insert((d.place, d.code, d.message.clone())));
        diagnostics.extend(through);
        diagnostics.extend(ended_diagnostics(&lowered, &structure, &values));
        let untold = tell_first(&mut diagnostics);
        crate::fixes::add_uses(&text, &mut diagnostics, host);
        let unplanned = unplanned.iter().map(|f| f.origin).collect();
        debug_assert_eq!(kernel::check::values(&structure, &values), Ok(()));
        let mut state = State {
            text,
            lowered,
            structure,
            values,
            diagnostics,
            untold,
            unplanned,
            double_roots,
            gave_way,
            known: Known::default(),
            form: Rc::default(),
        };
        let mut warnings = crate::yielding::warnings(&state, &planner);
        warnings.extend(crate::unlike::warnings(&state));
        warnings.extend(state.lowered.mixed_lengths());
        warnings.extend(state.lowered.given_twice());
        warnings.extend(state.lowered.bindings_replaced());
        warnings.extend(crate::families::outside::warnings(&state));
        if !warnings.is_empty() {
            state.untold.warnings += tell_first(&mut warnings).warnings;
            state.diagnostics.extend(warnings);
            state.diagnostics.sort_by_key(|d| (d.place.file, d.place.span.start));
        }
        (state, planner)
    }
}

/// The code of the diagnostic that stands for all that are not told one by one.
pub const MORE: &str = "more";

/// How many diagnostics of a document are not told one by one.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Untold {
    /// Errors.
    pub errors: usize,
    /// Warnings and notes.
    pub warnings: usize,
}

/// Sorts diagnostics by where they stand, keeps the first errors and the first others, and says how many more there
/// are.
fn tell_first(diagnostics: &mut Vec<Diagnostic>) -> Untold {
    diagnostics.sort_by_key(|d| (d.place.file, d.place.span.start));
    let mut untold = Untold::default();
    if diagnostics.len() <= MOST_TOLD {
        return untold;
    }
    let is_error = |d: &Diagnostic| d.severity == base::Severity::Error;
    let (mut errors, mut others): (Vec<_>, Vec<_>) = diagnostics.drain(..).partition(is_error);
    let kinds = [
        (&mut errors, "errors", &mut untold.errors),
        (&mut others, "warnings", &mut untold.warnings),
    ];
    for (all, kind, count) in kinds {
        let rest = all.split_off(all.len().min(MOST_TOLD));
        *count = rest.len();
        if let [first, ..] = &rest[..] {
            let message = format!("{} more {kind} stand from here on", rest.len());
            let severity = first.severity;
            all.push(Diagnostic { severity, ..Diagnostic::error(MORE, first.place, message) });
        }
        diagnostics.append(all);
    }
    diagnostics.sort_by_key(|d| (d.place.file, d.place.span.start));
    untold
}

/// Returns true for a fault that follows from what else is told: what is not there because its text is wrong is said of
/// that text, and not of what speaks of it; so is what was not made because it is too deep or too much, and a ring of
/// messages.
fn follows(of: &Structured, fault: &plan::Fault) -> bool {
    let lowered = &of.lowered;
    let is_missing = |f: &kernel::Fault| {
        matches!(f.kind, kernel::FaultKind::TooDeep | kernel::FaultKind::TooManyThings)
    };
    let is_wrong = |d: &Diagnostic| d.severity == base::Severity::Error;
    let is_ring = |d: &Diagnostic| d.code == plan::FaultKind::Endless.code();
    match fault.kind {
        plan::FaultKind::WrongKind => {
            lowered.diagnostics.iter().any(is_wrong) || of.faults.iter().any(is_missing)
        }
        plan::FaultKind::Endless => lowered.diagnostics.iter().any(is_ring),
        plan::FaultKind::NotYet | plan::FaultKind::UnknownName | plan::FaultKind::Reference => {
            false
        }
    }
}

/// Returns what is given and is another now, with what it is given. Where a class puts the places of a new thing
/// promises nothing: these yield as places do.
fn gave_way(structure: &Structure, given: &Values, values: &Values) -> Vec<(SlotId, Value)> {
    let is_other = |slot: SlotId| match (given.get(slot), values.get(slot)) {
        (Value::Number(was), Value::Number(is)) => !base::number::close(was, is),
        (was, is) => !was.same_bits(&is),
    };
    let is_given = |slot: SlotId| {
        structure.given(slot).is_some_and(|g| !g.of_class || structure.slots[slot].place.is_none())
    };
    let moved = values.changed(given).filter(|&slot| is_given(slot) && is_other(slot));
    moved.map(|slot| (slot, given.get(slot))).collect()
}

/// Says which programs of the document's things ended before their last step, and why.
fn ended_diagnostics(lowered: &Lowered, structure: &Structure, values: &Values) -> Vec<Diagnostic> {
    let document = &lowered.document;
    if document.classes.iter().all(|(_, class)| class.program.is_none()) {
        return Vec::new();
    }
    let evaluator = Evaluator::new(document, structure, values);
    let draws = |thing: &ThingId| {
        structure.merged[*thing] == *thing
            && document.program(structure.things[*thing].class).is_some()
    };
    let diagnostic = |thing: ThingId| {
        let run = evaluator.run(thing).ok()??;
        let ended = run.ended.as_ref()?;
        if ended.reason.ends_with(eval::programs::UNCLEAR) {
            return None;
        }
        let path = structure.path(document, thing);
        let message = format!("{path} is not drawn to its end: {ended}");
        let d = Diagnostic::warning("run-ended", lowered.place(ended.origin), message);
        let mut values = ended.operands.iter().map(|(_, value)| value.trim_matches('"'));
        Some(match values.find_map(|value| lowered.missed_row(value)) {
            Some(hint) => d.hint(hint),
            None => d,
        })
    };
    (0..structure.things.len() as u32).map(ThingId).filter(draws).filter_map(diagnostic).collect()
}

/// Says what could not be planned; of a value that a message may compute as well, how that is written.
#[cold]
fn unplanned_diagnostic(text: &str, lowered: &Lowered, fault: &plan::Fault) -> Diagnostic {
    let place = lowered.place(fault.origin);
    let d = Diagnostic::error(fault.kind.code(), place, fault.message.clone());
    let is_own = fault.kind == plan::FaultKind::NotYet && place.file == FileId(0);
    let written = text.get(place.span.range()).filter(|t| is_own && !t.contains('\n'));
    let bound = written.and_then(|t| t.split_once(" = ")).filter(|(part, _)| {
        let mut words = part.split(": ");
        let is_word = |w: &str| !w.is_empty() && w.chars().all(|c| c.is_alphanumeric() || c == '_');
        words.next().is_some_and(is_word)
            && words.next().is_some_and(is_word)
            && words.next().is_none()
    });
    match bound {
        Some((part, value)) => d.hint(format!(
            "what is computed and never solved back is a message: `{part} => {value}`"
        )),
        None => d,
    }
}

/// Says where given values have none; a class's, once for all its things.
fn given_diagnostics(lowered: &Lowered, faults: &[eval::Fault]) -> Vec<Diagnostic> {
    let mut said = BTreeSet::new();
    let diagnostic = |fault: &eval::Fault| {
        let place = lowered.place(fault.origin?);
        let is_new = said.insert((place, fault.message.clone()));
        is_new.then(|| Diagnostic::error(fault.kind.code(), place, fault.message.clone()))
    };
    faults.iter().filter_map(diagnostic).collect()
}
