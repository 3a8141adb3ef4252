//! What hands ask of a document that they work on: which values a thing shows, which of them a word in the picture
//! is, and what a library wants of the sheet.

use crate::annotations;
use crate::apply;
use crate::classing;
use crate::document::Open;
use crate::host::{Beside, Host as _};
use crate::kinds;
use crate::offers;
use crate::outlines;
use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::turning;
use crate::view::{
    Affected, Annotation, BinEntry, Change, ClassItem, ClassPlan, Deed, DocumentId, Offer,
    Question, Refusal, ValueRow, ValueWithin,
};
use crate::ways_out;
use crate::{Session, tools, views, words};
use eval::{Evaluator, FaultKind};
use kernel::{ClassId, Command, Literal, Path, SlotId, Step, ThingId};
use lang::Wanted;

/// At most so many values of one thing are looked for.
const MOST: usize = 200;

impl Session {
    /// Returns the values of a thing and its parts, also those that it shares with what it is merged with: each by
    /// its path within the thing, and by the path of its row of the values view.
    pub fn values_within(&self, id: DocumentId, path: &Path) -> Vec<ValueWithin> {
        let state = &self.document(id).state;
        let mut found = Vec::new();
        if let Some(thing) = thing_at(state, path) {
            collect(state, thing, &mut Vec::new(), &mut Vec::new(), &mut found);
        }
        found
    }

    /// Returns what of a thing is meant to be locked: of one that is only drawn where its places of layout are, as a
    /// resistor between its nodes, what it is given besides; else all of it.
    pub fn to_lock(&self, id: DocumentId, path: &Path) -> Vec<Path> {
        let state = &self.document(id).state;
        let structure = &state.structure;
        let Some(thing) = thing_at(state, path) else { return vec![path.clone()] };
        let slots = structure.slots_under(thing);
        let is_drawn_by_layout = slots.iter().any(|&slot| structure.slots[slot].is_layout);
        let own = structure.path(&state.lowered.document, thing);
        let is_given = |slot: &&SlotId| {
            let s = &structure.slots[**slot];
            let lies_within = state.slot_path(**slot).0.starts_with(&own.0);
            !s.is_layout && s.given.is_some() && lies_within
        };
        let given: Vec<Path> =
            slots.iter().filter(is_given).map(|&slot| state.slot_path(slot)).collect();
        match is_drawn_by_layout && !given.is_empty() {
            true => given,
            false => vec![path.clone()],
        }
    }

    /// Locks parts at the values that they have, or lets them go. One step.
    ///
    /// # Errors
    /// Why one of them cannot be; then nothing has changed.
    pub fn hold(&mut self, id: DocumentId, paths: &[Path], held: bool) -> Result<Change, Refusal> {
        let home = self.home(id);
        let command = |path: &Path| self.at_home(id, &Command::Anchor { path: path.clone(), held });
        let commands: Vec<Command> = paths.iter().map(command).collect::<Result<_, _>>()?;
        self.document_mut(id).drag = None;
        let (open, beside) = self.beside_others(home);
        open.drag = None;
        let since = open.done.len();
        let mut change = open.tried(|open| {
            let mut all = Change::default();
            for command in &commands {
                let change = apply::apply(open, &beside, command)?;
                all.structure |= change.structure;
                all.edits.extend(change.edits);
            }
            Ok::<_, Refusal>(all)
        })?;
        open.one_step(since);
        let names: Vec<String> = paths.iter().map(Path::to_string).collect();
        change.label =
            format!("{} {}", if held { "lock" } else { "unlock" }, words::listed(&names));
        open.label_last(change.label.clone());
        change.documents = self.reach(home);
        if home != id {
            self.renew_pane(id);
            change.documents.push(Affected { document: home, unsatisfied: Vec::new() });
        }
        Ok(change)
    }

    /// Returns the path of the value that a word in the picture of a thing shows, or without a word of the one that
    /// is meant most likely: what is stored before what is computed, the outermost first. Nothing where a thing has
    /// no value but its place.
    pub fn value_shown(&self, id: DocumentId, path: &Path, word: Option<&str>) -> Option<String> {
        let open = self.document(id);
        let within = self.values_within(id, path);
        let own = format!("{path}.");
        let rows = views::values::rows(&open.state, open.values(), &open.status);
        let depth = |row: &ValueRow| {
            let shared = within.iter().find(|w| w.row == row.path).map(|w| w.path.as_str());
            let name = shared.or_else(|| row.path.strip_prefix(&own)).unwrap_or_default();
            name.matches('.').count()
        };
        let is_own = |row: &&ValueRow| {
            row.path.starts_with(&own)
                || row.path == path.to_string()
                || within.iter().any(|w| w.row == row.path)
        };
        let is_coordinate = |row: &ValueRow| {
            matches!(row.path.rsplit('.').next(), Some("x" | "y")) && row.path != path.to_string()
        };
        let rank = |row: &&ValueRow| {
            let shows = word.map_or(Shows::Nothing, |word| shows(open, row, word));
            // what a word shows lies near, what is typed without one is stored
            let near = if shows == Shows::Nothing { 0 } else { depth(row) };
            (shows, row.is_layout, near, row.is_virtual, depth(row), !row.given)
        };
        let rows = rows.iter().filter(is_own).filter(|row| !is_coordinate(row));
        rows.min_by_key(rank).map(|row| row.path.clone())
    }

    /// Returns what has to be asked before something is said by hand that contradicts what holds: the ways out, each
    /// tried. Nothing where it would hold, or where no more would be broken than is.
    pub fn over_constrained(&self, id: DocumentId, command: &Command) -> Option<Question> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = self.document(id);
        match open.pane {
            // here all is said of the class
            Some(_) => ways_out::of_prototype(open, &beside, command),
            None => ways_out::question(open, &beside, command),
        }
    }

    /// Returns true where a dimension measures what is to be deleted: then it goes as well.
    pub fn is_measured(&self, id: DocumentId, path: &Path) -> bool {
        let home = self.home(id);
        let beside = Beside::of(&*self.host, &self.documents, home);
        match self.at_home(id, &Command::Delete(path.clone())) {
            Ok(Command::Delete(path)) => {
                tools::copies::is_measured(self.document(home), &beside, &path)
            }
            Ok(_) | Err(_) => false,
        }
    }

    /// Returns true if a path leads to something: a thing, a figure that is computed, or would be with other values, a
    /// constraint.
    pub fn is_there(&self, id: DocumentId, path: &Path) -> bool {
        let state = &self.document(id).state;
        let is_constraint = || {
            let Some((Step::Part(name), whole)) = path.0.split_last() else { return false };
            let owner = match whole {
                [] => Some(kernel::DOCUMENT),
                _ => thing_at(state, &Path(whole.to_vec())),
            };
            let found = owner.and_then(|owner| {
                state.structure.constraint_named(&state.lowered.document, owner, name)
            });
            found.is_some()
        };
        thing_at(state, path).is_some()
            || is_constraint()
            || is_computed(&state.evaluator(&state.values), path)
    }

    /// Returns what can be said of some things, and is not said yet: the constraints that fit them, and merging them;
    /// what can be made of an outline.
    pub fn offers(&self, id: DocumentId, paths: &[Path]) -> Vec<Offer> {
        self.offers_and_held(id, paths).0
    }

    /// The same, and in words what is true of them already, because something says so or it follows.
    pub fn offers_and_held(&self, id: DocumentId, paths: &[Path]) -> (Vec<Offer>, Vec<String>) {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = self.document(id);
        let found = offers::offers(&open.state, paths);
        let (mut offers, held) = offers::told_apart(open, &beside, found);
        offers::between::keep_alongside(&mut offers);
        offers.extend(outlines::offers(open, paths));
        (offers, held)
    }

    /// Returns what the document's own constraints say, as it stands on a drawing.
    pub fn annotations(&self, id: DocumentId) -> Vec<Annotation> {
        annotations::annotations(self.document(id))
    }

    /// Types another number where a constraint of the document's own says which one a value is; nothing where none does,
    /// or where the other would contradict something.
    pub(crate) fn tell_anew(
        &mut self,
        id: DocumentId,
        path: &Path,
        typed: &str,
    ) -> Option<Result<Change, Refusal>> {
        let offer = annotations::telling(self.document(id), path)?;
        let command = self.said(id, &offer, Some(typed)).ok()?;
        let is_free = self.over_constrained(id, &command).is_none();
        is_free.then(|| self.apply(id, &command))
    }

    /// Returns the command that says what is offered, with a value where one goes there.
    ///
    /// # Errors
    /// It cannot be made so: a radius does not fit a corner.
    pub fn said(
        &self,
        id: DocumentId,
        offer: &Offer,
        value: Option<&str>,
    ) -> Result<Command, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = self.document(id);
        if matches!(offer.deed, Deed::Add | Deed::Rule(_))
            && let Some(refusal) =
                value.and_then(|value| offers::between::beyond(open, offer, value))
        {
            return Err(refusal);
        }
        let turns = value.is_some() && turning::is_angle(&offer.label);
        let turned = |command: Command| {
            let is_asked = !turns || open.pane.is_some() || ways_out::is_for_every(open, &command);
            let turned = if is_asked {
                None
            } else {
                turning::turned(open, &beside, &offer.members, &command)
            };
            turned.unwrap_or(command)
        };
        match &offer.deed {
            Deed::Add => {
                let command = offer.command(value);
                let is_dimension = offer.value.is_some();
                // who types anew what stands on the drawing sees the expression that goes
                let read = if offer.stands { classing::equation } else { classing::equals_number };
                let anew = is_dimension.then(|| match &open.pane {
                    None => ways_out::said_anew(open, &beside, read, &command),
                    Some(pane) => {
                        let beside = Beside::of(&*self.host, &self.documents, pane.of);
                        let (home, of) = (self.document(pane.of), (&pane.class, &pane.name));
                        ways_out::said_anew_of_class(home, &beside, of, read, &command)
                    }
                });
                Ok(turned(anew.flatten().unwrap_or(command)))
            }
            Deed::Rule(reference) => {
                let command = offer.command(value);
                let instead = ways_out::instead_of(open, &beside, reference, &command);
                Ok(turned(instead.unwrap_or(command)))
            }
            Deed::Give(path) => {
                let value = value.or(offer.value.as_deref()).unwrap_or_default();
                let literal = words::read_typed(&open.state, path, value)?;
                Ok(Command::Set(vec![(path.clone(), literal)]))
            }
            Deed::Round(of) => {
                let radius = value.or(offer.value.as_deref()).unwrap_or_default();
                outlines::rounded_by(open, &beside, of, radius).ok_or_else(|| {
                    words::refuse(format!("{radius} is no radius that fits this corner"))
                })
            }
            Deed::InLines(path) => outlines::in_lines(open, &beside, path).ok_or_else(|| {
                words::refuse(format!("{path} says more than four lines would say"))
            }),
        }
    }

    /// Returns the command for a dimension that only reads what an offered one would set; nothing where there is
    /// none.
    pub fn only_read(&self, id: DocumentId, offer: &Offer) -> Option<Command> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        ways_out::only_read(self.document(id), &beside, &offer.members)
    }

    /// Returns the right side that an equation over some picked things begins with: numbers as they are, of things
    /// what they have in common.
    pub fn equation_begun(&self, id: DocumentId, paths: &[Path]) -> String {
        let state = &self.document(id).state;
        let number = |path: &Path| {
            let term = kernel::Term::at(kernel::Term::Me, path);
            let answer = state.evaluator(&state.values).evaluate(&term, kernel::DOCUMENT);
            matches!(answer, Ok(eval::Answer::Number(..)))
        };
        let told = |path: &Path| {
            let of = |name: &str| path.then(Step::Part(name.into()));
            let named = ["radius", "length", "x"].map(of).into_iter().find(number);
            if number(path) { Some(path.clone()) } else { named }
        };
        let all: Vec<String> = paths.iter().filter_map(told).map(|p| p.to_string()).collect();
        match all.as_slice() {
            [] => String::new(),
            [one] => format!("{one} = "),
            [first, others @ ..] => format!("{first} = {}", others.join(" + ")),
        }
    }

    /// Whether a number says how many parts there are: it is no number to drag, the document is another with each.
    pub fn is_count(&self, id: DocumentId, path: &Path) -> bool {
        lang::is_count(&self.document(id).state.lowered, path)
    }

    /// Returns the number in base units that a value comes to on a slider: in its unit the shortest that is as near as a
    /// step. Nothing where the path leads to no number.
    pub fn at_step(&self, id: DocumentId, path: &Path, x: f64, step: f64) -> Option<f64> {
        let state = &self.document(id).state;
        let slot = state.structure.slot_of(thing_at(state, path)?)?;
        let document = &state.lowered.document;
        let quantity = words::quantity_of(state, slot, "");
        let unit = kernel::show_quantity(x, quantity, document).unit;
        let shown = |x| kernel::in_unit(x, quantity.dimension, &unit, document);
        let way = (shown(x + step) - shown(x)).abs();
        let (mut size, mut decimals) = (1.0, 0);
        while size > 1.000_001 * way && decimals < 17 {
            size /= 10.0;
            decimals += 1;
        }
        let typed = base::number::rounded(shown(x), decimals);
        let class = document.class_named(quantity.class);
        let wanted = class.map_or(Wanted::Anything, Wanted::Class);
        match lang::read_literal(&words::with_unit(typed, &unit), wanted, document) {
            Ok(Literal::Number(x)) => Some(x),
            _ => None,
        }
    }

    /// Returns the command that gives a document a number of its own, as it is typed: `a = 30 deg`, or `30 deg` alone,
    /// which is called by the first free letter; and what it is called.
    ///
    /// # Errors
    /// The name is none, or taken; what is typed is no number.
    pub fn number_typed(&self, id: DocumentId, typed: &str) -> Result<(Command, String), Refusal> {
        let open = self.document(id);
        let state = &open.state;
        let is_free = |name: &str| {
            let path = Path(vec![Step::Part(name.into())]);
            thing_at(state, &path).is_none() && state.lowered.document.class_named(name).is_none()
        };
        let (name, value) = match typed.split_once('=') {
            Some((name, value)) => (name.trim().to_string(), value.trim()),
            None => {
                let mut letters = ('a'..='z').map(String::from);
                let free = letters.find(|name| is_free(name)).unwrap_or_default();
                (free, typed.trim())
            }
        };
        let is_name = parse_path(&name).is_some_and(|path| path.0.len() == 1)
            && name.starts_with(char::is_lowercase);
        if !is_name {
            let message = format!("{name}: a number's name is one word with a small first letter");
            return Err(words::refuse(message));
        }
        if !is_free(&name) {
            return Err(words::refuse(format!("there is a {name} already")));
        }
        let terms = crate::plotting::read(state, &[value])?;
        let evaluator = state.evaluator(&state.values);
        let answer = terms.first().map(|term| evaluator.evaluate(term, kernel::DOCUMENT));
        let Some(Ok(eval::Answer::Number(_, dimension))) = answer else {
            return Err(words::refuse(format!("{value} is no number")));
        };
        let is_angle = ["deg", "rad", "°", "turn"].iter().any(|unit| value.ends_with(unit));
        let class = if is_angle { "Angle" } else { dimension.named().unwrap_or("Real") };
        let members = format!("{name}: {class} = {value}");
        Ok((Command::Edit { target: Path::default(), members }, name))
    }

    /// Returns the names of the classes in the bin, in its order.
    pub fn bin_names(&self, id: DocumentId) -> Vec<String> {
        tools::bin::names(&self.document(id).state)
    }

    /// Returns the names of the libraries and documents that a document's own text uses.
    pub fn used(&self, id: DocumentId) -> Vec<String> {
        self.document(id).state.lowered.used()
    }

    /// Returns what a library has that things can be made of, for a document that does not use it yet.
    pub fn bin_of_library(&self, library: &str) -> Vec<BinEntry> {
        let beside = Beside::opening(&*self.host, &self.documents, "");
        let open = Open::of("", begun_with(library, &beside), &beside);
        let mut tiles = tools::bin::Tiles::default();
        let mut entries = tools::bin::entries(&open.state, &mut tiles, &beside);
        entries.retain(|entry| entry.library == library);
        entries
    }

    /// Returns what has to be decided of some things that are to be the parts of a class.
    pub fn class_items(&self, id: DocumentId, paths: &[Path]) -> Vec<ClassItem> {
        classing::items(self.document(id), paths)
    }

    /// Returns the command that makes a class of some things of the document, whose one thing they then are, and
    /// what that is called.
    ///
    /// # Errors
    /// A path is no thing of the document itself, or the name is none for a new class.
    pub fn class_of(
        &self,
        id: DocumentId,
        paths: &[Path],
        plan: &ClassPlan,
    ) -> Result<(Command, String), Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        classing::class_of(self.in_document(id)?, &beside, paths, plan)
    }

    /// Returns the command by which a thing is of a class of its own, which inherits from its class and says what was
    /// said of that thing alone.
    ///
    /// # Errors
    /// It is no whole thing of the document, or the name is none for a new class.
    pub fn kind_of(&self, id: DocumentId, path: &Path, class: &str) -> Result<Command, Refusal> {
        let open = self.in_document(id)?;
        kinds::kind_of(open, &Beside::of(&*self.host, &self.documents, id), path, class)
    }

    /// Returns the command by which a rule or a part that one thing has of its own is of every thing of its class.
    ///
    /// # Errors
    /// Its class is not one that the document declares, or it speaks of other things too.
    pub fn of_every(&self, id: DocumentId, path: &Path) -> Result<Command, Refusal> {
        let open = self.in_document(id)?;
        kinds::of_every(open, &Beside::of(&*self.host, &self.documents, id), path)
    }

    /// The document, for what cannot be done in a pane that shows a class's prototype.
    fn in_document(&self, id: DocumentId) -> Result<&Open, Refusal> {
        let open = self.document(id);
        match open.pane {
            Some(_) => {
                let message = "classes are made of things of the document: go back to it first";
                Err(words::refuse(message.into()))
            }
            None => Ok(open),
        }
    }

    /// Returns the command by which a document uses a library; an empty one takes over which way the library's
    /// pictures count `y`.
    pub fn using(&self, id: DocumentId, library: &str) -> Command {
        let state = &self.document(id).state;
        let is_empty = state.structure.parts(kernel::DOCUMENT).next().is_none();
        let is_told = counts_down(&state.text).is_some();
        let beside = Beside::of(&*self.host, &self.documents, id);
        // what is not there yet is asked for
        let begun = begun_with(library, &beside);
        let members = if is_empty && !is_told { begun } else { format!("use {library}") };
        Command::Edit { target: Path::default(), members }
    }
}

/// Returns the class of what a path leads to: a thing, or a figure that is computed.
pub(crate) fn class_at(state: &State, path: &Path) -> Option<ClassId> {
    if let Some(thing) = thing_at(state, path) {
        return Some(state.structure.things[thing].class);
    }
    match state.evaluator(&state.values).at(path) {
        Ok(eval::Answer::Made(made)) => Some(made.class),
        Ok(_) | Err(_) => None,
    }
}

/// Returns what a coordinate of an anchored place means that is typed: the place as a whole, which alone may be set.
pub(crate) fn anchored_whole(
    state: &State,
    path: &Path,
    literal: &Literal,
) -> Option<(Path, Literal)> {
    let structure = &state.structure;
    let slot = structure.slot_of(thing_at(state, path)?)?;
    let place = structure.slots[slot].place.filter(|_| structure.slots[slot].anchored)?;
    let (_, whole) = path.0.split_last()?;
    let coordinates = structure.slots_under(place);
    let is_anchored = coordinates.iter().all(|&s| structure.slots[s].anchored);
    let now = |s: &SlotId| match *s == slot {
        true => literal.clone(),
        false => Literal::Number(state.values.numbers[*s]),
    };
    let all = coordinates.iter().map(now).collect();
    is_anchored.then(|| (Path(whole.to_vec()), Literal::Tuple(all)))
}

/// How a word and a value go together, best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Shows {
    /// The word has this number, in a unit of what it measures.
    Number,
    /// The word has this text.
    Text,
    /// Neither.
    Nothing,
}

/// Says how a word shows a value.
fn shows(open: &Open, row: &ValueRow, word: &str) -> Shows {
    let is_text = !row.text.is_empty() && word.contains(&row.text);
    match row.number {
        Some(number) if shows_number(&open.state, row, number, word) => Shows::Number,
        None if is_text && !row.is_virtual => Shows::Text,
        _ => Shows::Nothing,
    }
}

/// Whether the number in a word is that of a row, as far as its digits go.
fn shows_number(state: &State, row: &ValueRow, number: f64, word: &str) -> bool {
    let start = word.find(|c: char| c.is_ascii_digit());
    let Some(start) = start else { return false };
    let sign = word[..start].chars().next_back();
    let is_minus = matches!(sign, Some('-' | '−'));
    let rest = word[start..].replace('Ω', "ohm").replace('°', " deg");
    let digits: String =
        rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.' || *c == 'e').collect();
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let Ok(shown) = digits.parse::<f64>() else { return false };
    let document = &state.lowered.document;
    let wanted = document.class_named(&row.class).map_or(Wanted::Anything, Wanted::Class);
    let typed = format!("{}{}", if is_minus { "-" } else { "" }, rest.trim());
    let Ok(Literal::Number(read)) = lang::read_literal(&typed, wanted, document) else {
        return false;
    };
    let unit = if shown == 0.0 { 1.0 } else { (read / shown).abs() };
    let decimal = (0..decimals).fold(0.5, |half, _| half / 10.0);
    (read - number).abs() <= unit * decimal + 1e-6 * number.abs()
}

/// Adds the values under a thing, by their ways from it.
fn collect(
    state: &State,
    thing: ThingId,
    way: &mut Vec<Step>,
    open: &mut Vec<ThingId>,
    found: &mut Vec<ValueWithin>,
) {
    let structure = &state.structure;
    let thing = structure.merged[thing];
    if found.len() >= MOST || open.contains(&thing) {
        return;
    }
    if structure.slot_of(thing).is_some() {
        let row = structure.path(&state.lowered.document, thing).to_string();
        let path = Path(way.clone()).to_string();
        let steps = |path: &str| path.matches(['.', '[']).count();
        match found.iter_mut().find(|known| known.row == row) {
            Some(known) if steps(&known.path) <= steps(&path) => {}
            Some(known) => known.path = path,
            None => found.push(ValueWithin { path, row }),
        }
        return;
    }
    open.push(thing);
    for part in structure.parts(thing) {
        let step = match structure.field_name(&state.lowered.document, part) {
            Some(name) => Step::Part(name.clone()),
            None => Step::Index(structure.things[part].field),
        };
        way.push(step);
        collect(state, part, way, open, found);
        way.pop();
    }
    open.pop();
}

/// Which way a text says that `y` counts: down, up, or nothing of it.
fn counts_down(text: &str) -> Option<bool> {
    let file = syntax::parse(base::FileId(0), text).file();
    file.members().find_map(|member| match member {
        syntax::ast::Member::Y(y) => Some(y.is_down()),
        _ => None,
    })
}

/// What an empty document says to use a library, and to count `y` as its pictures do.
fn begun_with(library: &str, beside: &Beside<'_>) -> String {
    let is_down = beside.read(library).and_then(|text| counts_down(&text)) == Some(true);
    format!("use {library}{}", if is_down { "\ny down" } else { "" })
}

/// Whether a path leads to what is computed, or would be: with these values it may have no answer.
fn is_computed(evaluator: &Evaluator<'_>, path: &Path) -> bool {
    let fault = |n: &usize| Some((*n, evaluator.at(&Path(path.0[..*n].to_vec())).err()?));
    match (1..=path.0.len()).filter_map(|n| fault(&n)).next() {
        // there may be fewer elements
        Some((n, fault)) => {
            let is_named = matches!(path.0[n - 1], Step::Part(_));
            is_named && matches!(fault.kind, FaultKind::NoAnswer | FaultKind::Run(_))
        }
        None => true,
    }
}
