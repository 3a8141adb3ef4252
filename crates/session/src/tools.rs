//! Tools: what the hand makes in the picture, place by place.
//!
//! In: a class, and where the pointer is. Out: what would be made, as a preview, and at last the command that
//! makes it. A thing is placed in a document of its own that uses the same classes ([`Tool::trial`]): first it
//! follows the pointer as a whole, held by its first place; each further place follows the pointer while those
//! before it stay. What the trial's text says of the thing then is what the document's will say.

pub(crate) mod bin;
mod catch;
pub(crate) mod copies;
pub(crate) mod digits;
mod examples;
mod lengths;
pub(crate) mod room;
pub(crate) mod stages;
mod stops;
mod winding;

use crate::apply;
use crate::document::Open;
use crate::drag;
use crate::host::Host;
use crate::placing;
use crate::recognise;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Caught, PictureView, Pointer, Refusal, ToolView, TypedLength};
use crate::{views, words};
use base::Name;
use base::number::{cos, hypot, shortest, sin};
use catch::{Catch, Sight};
use digits::{COMPUTED, SOLVED};
use drawing::{Color, Element, Layer, Line, Point, Shape, Style, Tag};
use kernel::{Command, Literal, Path, Step};
use stages::{Stage, stages};
use std::cell::RefCell;
use syntax::ast::{AstNode, Expr, Member, Value};
use winding::Winding;

/// A tool in the hand.
pub(crate) struct Tool {
    class: Name,
    /// What the thing will be called, here and in the trial.
    name: String,
    /// The thing whose part it becomes: of a pane the prototype, else the document.
    within: Path,
    /// A document that holds the thing alone.
    trial: Box<Open>,
    stages: Vec<Stage>,
    /// What each place that is set was caught by.
    set: Vec<Catch>,
    /// From the pointer to the handle of the drag.
    offset: (f64, f64),
    /// The document's picture, in which the pointer finds things.
    picture: PictureView,
    /// Whether the next thing goes on from the end of this one.
    goes_on: bool,
    /// Where the hand decides which way round it runs.
    winding: Option<Winding>,
}

impl Tool {
    /// Takes a tool for things of a class.
    ///
    /// # Errors
    /// There is no such class, or its things have no place that could be set.
    pub(crate) fn new(open: &Open, host: &dyn Host, class: &str) -> Result<Self, Refusal> {
        let within = open.pane.as_ref().map(|pane| pane.part(&Path::default())).unwrap_or_default();
        let name = recognise::free_name_in(&open.state, &within, &Name::new(class));
        Self::with_values(open, host, (class, name, &[]))
    }

    /// Takes a tool for a thing of a class, by its name, to which some values are given. Things that a program draws
    /// are placed: each has a place beside its parameters.
    ///
    /// # Errors
    /// There is no such class, or its things have no place that could be set.
    pub(crate) fn with_values(
        open: &Open,
        host: &dyn Host,
        (class, name, values): (&str, String, &[String]),
    ) -> Result<Self, Refusal> {
        let state = &open.state;
        let document = &state.lowered.document;
        let class = Name::new(class);
        let known = document.class_named(&class);
        let Some(known) =
            known.filter(|&c| recognise::is_candidate(state, c, &document.classes[c]))
        else {
            return Err(words::refuse(format!("there is no class {class} to make things of")));
        };
        let is_placed =
            document.program(known).is_some() && !recognise::asks_for_its_place(document, known);
        let written = if is_placed { "Placed of " } else { "" };
        let examples = if is_placed { Vec::new() } else { examples::lists(document, known) };
        let values: Vec<&String> = values.iter().chain(&examples).collect();
        let body = match &values[..] {
            [] => String::new(),
            values => {
                let lines: String = values.iter().map(|value| format!("\n    {value}")).collect();
                format!(" {{{lines}\n}}")
            }
        };
        let text = trial_text(&state.text, &format!("{name}: {written}{class}{body}"));
        let winding = Winding::of(state, known, &text);
        let within = open.pane.as_ref().map(|pane| pane.part(&Path::default())).unwrap_or_default();
        let trial = Box::new(Open::of(&open.name, text, host));
        let stages = stages(&trial.state, &name);
        let goes_on = document.class_named("Line").is_some_and(|line| document.is_a(known, line));
        let picture = views::picture::picture(state, open.values(), &open.status);
        let set = Vec::new();
        let offset = (0.0, 0.0);
        let mut tool =
            Self { class, name, within, trial, stages, set, offset, picture, goes_on, winding };
        stages::spread(&mut tool.trial, &tool.stages, host);
        tool.begin()?;
        Ok(tool)
    }

    /// Returns the same tool for the next thing; nothing where it cannot be had any more.
    pub(crate) fn again(&self, open: &Open, host: &dyn Host) -> Option<Self> {
        let mut tool = Self::new(open, host, &self.class).ok()?;
        let last = self.set.last().filter(|_| self.goes_on && self.set.len() == self.stages.len());
        // a chain ends where it meets something
        if let Some(last) = last.filter(|last| last.joins.is_none()) {
            let end = self.stages.last().map(|stage| self.own(stage))?;
            let end = self.within.join(&end);
            let start = Catch { joins: Some(end), ..Catch::at(last.at) };
            tool.set_to(start, host).ok()?;
        }
        Some(tool)
    }

    /// The thing's path to what a stage sets.
    fn own(&self, stage: &Stage) -> Path {
        Path(vec![Step::Part(Name::new(&self.name))]).join(stage.part())
    }

    /// Takes hold of what the present stage sets.
    fn begin(&mut self) -> Result<(), Refusal> {
        let Some(stage) = self.stages.get(self.set.len()).cloned() else { return Ok(()) };
        let first = self.set.is_empty();
        let whole = Path(vec![Step::Part(Name::new(&self.name))]);
        let held = match (&stage, first) {
            (Stage::Place { .. }, true) => whole,
            (Stage::Place { place, .. }, false) => whole.join(place),
            (Stage::Reach { number, .. }, _) => whole.join(number),
            (Stage::Far { far, .. }, _) => whole.join(far),
        };
        let state = self.trial.state.clone();
        let aim = apply::aim(&state, &held)?;
        let planner = &mut self.trial.planner;
        let pressed = match aim {
            apply::Aim::Thing(thing) => drag::press(&state, planner, &[thing], held),
            apply::Aim::Term(term) => drag::press_computed(&state, planner, term, held),
        };
        let drag = match (pressed, &stage) {
            (Ok(drag), _) => drag,
            // what its class anchors is set instead
            (Err(plan::RefusalReason::Anchored(_)), Stage::Place { .. }) => return Ok(()),
            (Err(reason), _) => {
                return Err(words::refusal_for(&state, &reason, &plan::EditReport::default()));
            }
        };
        let handle = drag.handle();
        self.trial.drag = Some(drag);
        self.offset = match (&stage, first) {
            (Stage::Place { place, .. }, true) => match self.place_now(place) {
                Some(now) => (handle.0 - now.x, handle.1 - now.y),
                None => (0.0, 0.0),
            },
            _ => (0.0, 0.0),
        };
        Ok(())
    }

    /// Where a place of the thing is now.
    fn place_now(&self, place: &Path) -> Option<Point> {
        let state = &self.trial.state;
        let whole = Path(vec![Step::Part(Name::new(&self.name))]);
        let thing = thing_at(state, &whole.join(place))?;
        let [(_, x), (_, y)] = drag::coordinates(&state.structure, thing)?;
        let numbers = &self.trial.values().numbers;
        Some(Point { x: numbers[x], y: numbers[y] })
    }

    /// What the pointer finds for the present stage.
    fn catch(&self, state: &State, pointer: &Pointer) -> Catch {
        let Some(stage) = self.stages.get(self.set.len()) else { return Catch::at(pointer.at) };
        let last = self.set.last().map(|catch| catch.at);
        let is_typed = pointer.length.is_some() || pointer.angle.is_some();
        if let Some(last) = last.filter(|_| is_typed) {
            return self.typed(state, pointer, last);
        }
        let class = stage.class(&self.trial.state, &self.name);
        let class = class.and_then(|name| state.lowered.document.class_named(&name));
        let before = self.stages.get(self.set.len().wrapping_sub(1)).map(|s| self.own(s));
        let sight = Sight {
            state,
            picture: &self.picture,
            class,
            own: self.own(stage),
            whole: Name::new(&self.name),
            last: last.zip(before).filter(|_| self.goes_on),
            is_reach: matches!(stage, Stage::Reach { .. }),
            classes: RefCell::default(),
        };
        let found = catch::find(&sight, pointer);
        match (stage, last) {
            (Stage::Reach { .. }, Some(last)) if found.rules.is_empty() => {
                Catch { at: reached(last, found.at, pointer.at), ..found }
            }
            _ => found,
        }
    }

    /// The place that a length or an angle tells that was typed.
    fn typed(&self, state: &State, pointer: &Pointer, last: (f64, f64)) -> Catch {
        let way = (pointer.at.0 - last.0, pointer.at.1 - last.1);
        let far = hypot(way.0, way.1);
        let length = pointer.length.as_ref().map_or(far, |length| on_sheet(state, length));
        let radians = |degrees: f64| degrees * std::f64::consts::PI / 180.0;
        let (dx, dy) = match pointer.angle.map(radians) {
            Some(angle) => (cos(angle), sin(angle)),
            None if far > 0.0 => (way.0 / far, way.1 / far),
            None => (1.0, 0.0),
        };
        let mut catch = Catch::at((last.0 + length * dx, last.1 + length * dy));
        if self.goes_on {
            let name = &self.name;
            let run = match self.has_direction() {
                true => format!("{name}.direction"),
                false => format!("atan2({name}.p2.y - {name}.p1.y, {name}.p2.x - {name}.p1.x)"),
            };
            let said = [
                pointer
                    .length
                    .as_ref()
                    .map(|length| format!("{name}.length = {}", written(length))),
                pointer.angle.map(|x| format!("{run} = {} deg", shortest(within_half_turns(x)))),
            ];
            catch.rules.extend(said.into_iter().flatten());
        }
        if let Some(Stage::Reach { number }) = self.stages.get(self.set.len()) {
            let said = |length| format!("{}.{number} = {}", self.name, written(length));
            catch.rules.extend(pointer.length.as_ref().map(said));
        }
        catch
    }

    /// Whether its class says which way a thing runs.
    fn has_direction(&self) -> bool {
        let document = &self.trial.state.lowered.document;
        let class = document.class_named(&self.class);
        class.is_some_and(|class| document.find_message(class, "direction", None).is_some())
    }

    /// Has the present stage follow a place.
    fn follow(&mut self, at: (f64, f64), host: &dyn Host) {
        let to = match (self.stages.get(self.set.len()), self.set.last()) {
            (Some(Stage::Reach { .. }), Some(last)) => {
                let radius = hypot(at.0 - last.at.0, at.1 - last.at.1);
                (catch::short(radius, radius), 0.0)
            }
            _ => (at.0 + self.offset.0, at.1 + self.offset.1),
        };
        let state = self.trial.state.clone();
        if let Some(drag) = &mut self.trial.drag {
            drag.to(&state, &mut self.trial.planner, to);
        } else if let Some(Stage::Place { place, .. }) = self.stages.get(self.set.len()) {
            let path = Path(vec![Step::Part(Name::new(&self.name))]).join(place);
            // what cannot be there stays where it is, as what is dragged would
            let _ = apply::apply(&mut self.trial, host, &Command::Set(vec![at_place(path, at)]));
        }
    }

    /// Takes over what the class says of a thing that was drawn like this.
    fn take_inserted(&mut self, host: &dyn Host) {
        let state = self.trial.state.clone();
        let whole = Path(vec![Step::Part(Name::new(&self.name))]);
        let Some(thing) = thing_at(&state, &whole) else { return };
        let document = &state.lowered.document;
        let class = state.structure.things[thing].class;
        let message = document.find_message(class, &Name::new("inserted"), None);
        let Some((_, message)) = message else { return };
        let kernel::Term::Make { arguments, .. } = &*message.answer else { return };
        for argument in arguments {
            let Some(label) = &argument.label else { continue };
            let answer = state.evaluator(&state.values).evaluate(&argument.value, thing);
            let Ok(eval::Answer::Number(x, _)) = answer else { continue };
            let target = (whole.then(Step::Part(label.clone())), Literal::Number(x));
            // where constraints want it otherwise it is as the prototype has it
            let _ = apply::apply(&mut self.trial, host, &Command::Set(vec![target]));
        }
    }

    /// The pointer is elsewhere.
    pub(crate) fn moved(&mut self, state: &State, pointer: &Pointer, host: &dyn Host) -> ToolView {
        let catch = self.catch(state, pointer);
        self.wind(catch.at, host);
        self.follow(catch.at, host);
        let mut view = self.view();
        if self.is_before_a_line() {
            view.preview.elements.push(dot(catch.at));
        }
        view.preview.elements.extend(guides(&catch, self.set.last()));
        view.caught = catch.word.map(|word| Caught { at: catch.at, word });
        view
    }

    /// Sets what the present stage sets where the pointer is.
    ///
    /// # Errors
    /// Why that cannot be.
    pub(crate) fn set(
        &mut self,
        state: &State,
        pointer: &Pointer,
        host: &dyn Host,
    ) -> Result<ToolView, Refusal> {
        let catch = self.catch(state, pointer);
        if let Some(kind) = self.wanted() {
            let is_taken = |joined| self.set.iter().any(|was| was.joins.as_ref() == Some(joined));
            let what = match &catch.joins {
                None => format!("a {kind}: there is none here"),
                Some(joined) if is_taken(joined) => {
                    format!("another {kind}: {joined} is its part already")
                }
                Some(_) => String::new(),
            };
            if !what.is_empty() {
                return Err(words::refuse(format!("{} sticks to {what}", self.class)));
            }
        }
        if let Some(there) = catch.joins.as_ref().filter(|there| self.adds_nothing(state, there)) {
            let what = self.class.to_lowercase();
            let hint = format!("hold Shift for another {what}");
            return Err(words::refuse(format!("{there} is here already: {hint}")));
        }
        self.wind(catch.at, host);
        self.set_to(catch, host)?;
        let mut view = self.view();
        if self.set.len() == self.stages.len() {
            view.command = Some(self.command(host));
        }
        Ok(view)
    }

    /// Whether what is made is a place, and merged with what is there it would be nothing else than that is.
    fn adds_nothing(&self, state: &State, there: &Path) -> bool {
        let Some(Stage::Place { place, .. }) = self.stages.first() else { return false };
        let (document, structure) = (&state.lowered.document, &state.structure);
        let class = document.class_named(&self.class);
        let is_one = |class| {
            let thing = thing_at(state, there)?;
            Some(document.is_a(structure.things[thing].class, class))
        };
        place.0.is_empty() && class.and_then(is_one) == Some(true)
    }

    /// The class of what must be there, where the tool makes what nobody would see by itself: a relation of things.
    fn wanted(&self) -> Option<Name> {
        let stage = self.stages.get(self.set.len())?;
        let is_unseen = || self.view().preview.elements.is_empty();
        stage.whole().filter(|_| is_unseen())?;
        stage.class(&self.trial.state, &self.name)
    }

    fn set_to(&mut self, catch: Catch, host: &dyn Host) -> Result<(), Refusal> {
        self.follow(catch.at, host);
        let stage = self.stages.get(self.set.len()).cloned();
        if let Some(drag) = self.trial.drag.take() {
            drag.release(&mut self.trial, host)?;
        }
        self.set.push(catch);
        if let Some(Stage::Far { .. }) = stage {
            self.turn_box(host);
        }
        if let Some(Stage::Place { place, .. }) = stage {
            let path = Path(vec![Step::Part(Name::new(&self.name))]).join(&place);
            placing::say_layout(&mut self.trial, host, &path);
            let command = Command::Anchor { path, held: true };
            // what cannot be anchored is held by its stay
            let _ = apply::apply(&mut self.trial, host, &command);
        }
        if self.set.len() == self.stages.len() {
            self.take_inserted(host);
        }
        self.begin()
    }

    /// Of a box that was drawn to the left or down, the corner goes to where both sizes are positive. One whose
    /// first corner is joined to something keeps it, and its signs.
    fn turn_box(&mut self, host: &dyn Host) {
        let (Some(first), Some(last)) = (self.set.first(), self.set.last()) else { return };
        let (from, to) = (first.at, last.at);
        let is_upright = from.0 <= to.0 && from.1 <= to.1;
        let Some(Stage::Place { place, .. }) = self.stages.first() else { return };
        if is_upright || first.joins.is_some() || !first.rules.is_empty() {
            return;
        }
        let whole = Path(vec![Step::Part(Name::new(&self.name))]);
        let corner = whole.join(place);
        let size = |name: &str, size: f64| {
            (whole.join(&Path(vec![Step::Part(Name::new(name))])), Literal::Number(size))
        };
        let targets = vec![
            at_place(corner, (from.0.min(to.0), from.1.min(to.1))),
            size("width", (to.0 - from.0).abs()),
            size("height", (to.1 - from.1).abs()),
        ];
        // where the class has it otherwise, the box stays as it was drawn
        let _ = apply::apply(&mut self.trial, host, &Command::Set(targets));
    }

    /// The command that makes the thing as it is in the trial, joined to what its places were caught by.
    fn command(&self, host: &dyn Host) -> Command {
        // what a rule or a joint says of a place, the place says to the last digit; what was typed, too
        let is_free = self.set.iter().all(|catch| catch.rules.is_empty() && catch.joins.is_none())
            && !self.trial.state.structure.constraints.is_empty();
        let sorts = if is_free { &[SOLVED, COMPUTED][..] } else { &[COMPUTED] };
        let mut members = digits::without_noise(&self.trial, &self.name, sorts, host);
        let joined = self.stages.iter().zip(&self.set).filter(|(_, catch)| catch.joins.is_some());
        let wholes = joined.filter_map(|(stage, _)| stage.whole());
        members = without_sizes(&members, &wholes.map(ToString::to_string).collect::<Vec<_>>());
        for (stage, catch) in self.stages.iter().zip(&self.set) {
            if let Some(other) = &catch.joins {
                members.push_str(&format!("\nmerge {other} = {}", self.own(stage)));
            }
            for rule in &catch.rules {
                members.push_str(&format!("\nconstraint {rule}"));
            }
        }
        Command::Edit { target: Path::default(), members }
    }

    /// Whether a line is to begin: which way it goes cannot be shown yet.
    fn is_before_a_line(&self) -> bool {
        self.goes_on && self.set.is_empty()
    }

    /// What there is to see of it.
    pub(crate) fn view(&self) -> ToolView {
        let trial = &self.trial;
        let mut preview =
            views::picture::picture(&trial.state, trial.values(), &trial.status).drawing;
        if self.is_before_a_line() {
            preview.elements.clear();
        }
        let is_right = self.winding.as_ref().is_some_and(|winding| winding.is_right);
        // the hand sets what it began with first, which ever way that runs
        let stage = self.stages.get(if is_right { 1 } else { self.set.len() });
        let stage = stage.filter(|_| self.set.len() < self.stages.len());
        let hint = stage.map(|stage| {
            let kind = stage.class(&trial.state, &self.name);
            stage.hint(&self.class, kind.as_ref(), (self.set.is_empty(), self.goes_on))
        });
        let hint = hint.unwrap_or_default();
        let hint = match stage {
            Some(Stage::Reach { number }) => format!("{hint}; digits: its {number}, as 30 or 3 cm"),
            _ if self.goes_on && !self.set.is_empty() => {
                format!("{hint}; digits: its length, as 30 or 3 cm, < its angle")
            }
            _ => hint,
        };
        ToolView {
            hint,
            preview,
            caught: None,
            command: None,
            begun: !self.set.is_empty(),
            makes: self.within.then(Step::Part(Name::new(&self.name))).to_string(),
        }
    }
}

/// An angle in degrees as directions are told: more than -180, at most 180.
fn within_half_turns(degrees: f64) -> f64 {
    let turns = ((degrees - 180.0) / 360.0).ceil();
    // twelve digits are more than anybody types, and the rest is rounding
    let within = base::number::significant(degrees - 360.0 * turns, 12);
    if turns == 0.0 { degrees } else { within.parse().unwrap_or(degrees) }
}

/// The place so far from another as a pointer tells: its distance has no more decimals than the pointer's place.
fn reached(from: (f64, f64), to: (f64, f64), pointer: (f64, f64)) -> (f64, f64) {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let far = hypot(dx, dy);
    let most = digits::count_decimals(pointer.0).max(digits::count_decimals(pointer.1));
    let round = base::number::rounded(far, most).parse().unwrap_or(far);
    if far > 0.0 { (from.0 + round / far * dx, from.1 + round / far * dy) } else { to }
}

/// A typed length in the units of the sheet. One that has no unit yet takes over the unit that is typed.
fn on_sheet(state: &State, length: &TypedLength) -> f64 {
    let document = &state.lowered.document;
    let number = length.number;
    let metres =
        length.unit.as_ref().and_then(|unit| expr::units::read_quantity(&shortest(number), unit));
    match metres {
        Some((metres, _)) if document.unit.is_some() || state.lowered.measures_lengths() => {
            metres * document.units_per_metre
        }
        _ => number,
    }
}

/// A typed length as the text has it.
fn written(length: &TypedLength) -> String {
    let number = shortest(length.number);
    length.unit.as_ref().map_or(number.clone(), |unit| format!("{number} {unit}"))
}

/// The dashed lines that say what a catch was found by.
fn guides(catch: &Catch, last: Option<&Catch>) -> Vec<Element> {
    let last = last.filter(|_| catch.is_level).map(|last| last.at);
    let line = |from: (f64, f64)| {
        let point = |(x, y): (f64, f64)| Point { x, y };
        Element {
            shape: Shape::Segment(point(from), point(catch.at)),
            style: Style { color: Color::Accent, line: Line::Dashed, ..Style::default() },
            layer: Layer::Lines,
            tag: Tag(0),
        }
    };
    last.into_iter().chain(catch.beside.iter().copied()).map(line).collect()
}

/// The place where something begins.
fn dot((x, y): (f64, f64)) -> Element {
    let style = Style { color: Color::Accent, ..Style::default() };
    Element { shape: Shape::Dot(Point { x, y }), style, layer: Layer::Points, tag: Tag(0) }
}

/// A text that says what classes a document has, and one thing of one of them.
fn trial_text(text: &str, thing: &str) -> String {
    format!("{}\n{thing}\n", of_classes(text))
}

/// What a text says of classes, and not of things.
pub(crate) fn of_classes(text: &str) -> String {
    let file = syntax::parse(base::FileId(0), text).file();
    let is_of_classes = |m: &Member| {
        matches!(
            m,
            Member::Use(_)
                | Member::Class(_)
                | Member::Choice(_)
                | Member::Program(_)
                | Member::Unit(_)
                | Member::Y(_)
        )
    };
    let kept = file.members().filter(is_of_classes).map(|m| m.syntax().text().to_string());
    kept.collect::<Vec<String>>().join("\n")
}

/// What a text says of one of its things.
pub(crate) fn member_of(text: &str, name: &str) -> String {
    let file = syntax::parse(base::FileId(0), text).file();
    let is_it = |m: &Member| match m {
        Member::Part(part) => part.names().any(|word| word.text() == name),
        Member::Message(message) => message.name().is_some_and(|word| word.text() == name),
        _ => false,
    };
    let member = { file.members() }.find(is_it);
    member.map(|m| m.syntax().text().to_string().trim().to_string()).unwrap_or_default()
}

/// Takes away what a thing's text gives of parts that are joined to others, but for places, which may be these others'
/// own: the radius of a circle that is a circle of the sheet.
fn without_sizes(member: &str, parts: &[String]) -> String {
    let file = syntax::parse(base::FileId(0), member).file();
    let body = file.members().find_map(|member| match member {
        Member::Part(part) => part.body(),
        _ => None,
    });
    let is_size = |said: &Member| match said {
        Member::Assign(assign) if !matches!(assign.value(), Some(Value::Expr(Expr::Tuple(_)))) => {
            let target = assign.target().map(|target| target.syntax().text().to_string());
            let target = target.unwrap_or_default();
            let rest = parts.iter().find_map(|part| target.trim().strip_prefix(part.as_str()));
            rest.is_some_and(|rest| rest.starts_with('.'))
        }
        _ => false,
    };
    let gone = body.into_iter().flat_map(|body| body.members()).filter(is_size);
    let edits: Vec<_> = gone.map(|said| syntax::edit::delete_member(said.syntax())).collect();
    syntax::edit::apply(member, &edits)
}

/// Sets a place, as a command carries it.
fn at_place(path: Path, (x, y): (f64, f64)) -> (Path, Literal) {
    (path, Literal::Tuple(vec![Literal::Number(x), Literal::Number(y)]))
}
