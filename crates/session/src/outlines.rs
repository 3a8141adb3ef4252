//! Outlines by hand: a corner is rounded, a rectangle becomes its four lines.
//!
//! In: a document and what is selected. Out: what can be made of it, by its geometry; and, once that is wanted, the text
//! of a copy in which it was tried. Nothing is offered of what a pane shows, nor of a rectangle that is spoken of or that
//! says something itself.

use crate::apply;
use crate::document::Open;
use crate::host::Host;
use crate::plotting;
use crate::recognise;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Deed, Offer};
use base::Name;
use base::number::{atan2, cos, hypot, rounded as rounded_to, shortest, significant, sin};
use eval::Answer;
use kernel::{Command, DOCUMENT, Literal, Path, Step, ThingId};
use syntax::ast::{AstNode, Member, NameExpr, Part};

/// A round corner reaches at most so far along the shorter of its lines, as a part of it.
const MOST: f64 = 0.8;
/// A round corner that is offered reaches so far, as a part of it.
const REACH: f64 = 0.2;

/// Returns what can be made of the outline that is selected.
pub(crate) fn offers(open: &Open, paths: &[Path]) -> Vec<Offer> {
    if open.pane.is_some() {
        return Vec::new();
    }
    let boxed = || boxed_corner(&open.state, paths).and_then(|boxed| boxed.radius());
    let radius = corner(&open.state, paths).and_then(|corner| corner.radius()).or_else(boxed);
    let round = radius.map(|radius| Offer {
        label: "round".into(),
        members: "round corner of radius {}".into(),
        value: Some(shortest(radius)),
        deed: Deed::Round(paths.to_vec()),
        ..Offer::default()
    });
    let rectangle = match paths {
        [one] => rectangle(&open.state, one).map(|_| one),
        _ => None,
    };
    let lines = rectangle.map(|path| Offer {
        label: "four lines".into(),
        members: format!("the four lines of {path}"),
        deed: Deed::InLines(path.clone()),
        ..Offer::default()
    });
    round.into_iter().chain(lines).collect()
}

/// Returns the command that rounds a corner with the radius that is typed; nothing where that is none for it.
pub(crate) fn rounded_by(
    open: &Open,
    host: &dyn Host,
    of: &[Path],
    typed: &str,
) -> Option<Command> {
    let terms = plotting::read(&open.state, &[typed]).ok()?;
    let evaluator = open.state.evaluator(&open.state.values);
    let Ok(Answer::Number(radius, _)) = evaluator.evaluate(terms.first()?, DOCUMENT) else {
        return None;
    };
    let radius = (radius, typed);
    if let Some(corner) = corner(&open.state, of) {
        return rounded(open, host, &corner, radius).map(Command::Text);
    }
    // a rectangle has its four lines first
    let boxed = boxed_corner(&open.state, of)?;
    let (text, sides) = lines_of(open, host, &boxed.whole)?;
    let lines = Open::of(&open.name, text, host);
    let met = [sides[boxed.at].clone(), sides[(boxed.at + 3) % 4].clone()];
    let met = met.map(|name| Path(vec![Step::Part(Name::new(&name))]));
    let corner = corner(&lines.state, &met)?;
    rounded(&lines, host, &corner, radius).map(Command::Text)
}

/// A corner of a rectangle.
struct BoxedCorner {
    /// The rectangle.
    whole: Path,
    /// Which of its corners, from that with the smallest coordinates to the left around it.
    at: usize,
    /// The shorter of its sides.
    shorter: f64,
}

/// Finds the corner of a rectangle that is selected, by its point or by both its sides.
fn boxed_corner(state: &State, paths: &[Path]) -> Option<BoxedCorner> {
    const CORNERS: [&str; 4] = ["corner", "corner2", "far", "corner4"];
    const SIDES: [&str; 4] = ["side1", "side2", "side3", "side4"];
    let named = |path: &Path, names: &[&str; 4]| {
        let [whole @ Step::Part(_), Step::Part(name)] = path.0.as_slice() else { return None };
        let at = names.iter().position(|known| **known == **name)?;
        Some((Path(vec![whole.clone()]), at))
    };
    let (whole, at) = match paths {
        [point] => named(point, &CORNERS)?,
        [one, other] => {
            let ((whole, one), (of, other)) = (named(one, &SIDES)?, named(other, &SIDES)?);
            // a side begins at the corner of its number
            let at = match (one + 4 - other) % 4 {
                1 => one,
                3 => other,
                _ => return None,
            };
            (Some(whole).filter(|whole| *whole == of)?, at)
        }
        _ => return None,
    };
    rectangle(state, &whole)?;
    let size = |name: &str| {
        let slot = state.structure.slot_of(thing_at(state, &end_of(&whole, name))?)?;
        Some(state.values.numbers[slot])
    };
    let shorter = size("width")?.min(size("height")?);
    Some(BoxedCorner { whole, at, shorter })
}

impl BoxedCorner {
    /// A radius that fits.
    fn radius(&self) -> Option<f64> {
        significant(REACH * self.shorter, 1).parse().ok().filter(|radius| *radius > 0.0)
    }
}

/// What a rectangle is given that its four lines show.
const OWN: [&str; 5] = ["corner", "corner.x", "corner.y", "width", "height"];

/// One of the lines that meet at a corner.
struct Side {
    line: Path,
    /// Its end there, by name.
    end: Name,
    /// From the corner along it.
    way: (f64, f64),
    length: f64,
}

/// Where the ends of two lines are one.
struct Corner {
    at: (f64, f64),
    sides: [Side; 2],
}

/// Finds the corner that is selected, by its point or by both its lines.
fn corner(state: &State, paths: &[Path]) -> Option<Corner> {
    let structure = &state.structure;
    let point = match paths {
        [point] => thing_at(state, point)?,
        [one, other] => {
            let ends = |path: &Path| -> Vec<ThingId> {
                ["p1", "p2"].iter().filter_map(|end| thing_at(state, &end_of(path, end))).collect()
            };
            let others: Vec<ThingId> =
                ends(other).into_iter().map(|end| structure.identity(end)).collect();
            { ends(one) }.into_iter().find(|&end| others.contains(&structure.identity(end)))?
        }
        _ => return None,
    };
    let at = place(state, point)?;
    let met = structure.merged_with(point);
    let [a, b] = met[..] else { return None };
    let side = |end: ThingId| {
        let path = structure.path(&state.lowered.document, end);
        let [Step::Part(_), Step::Part(name)] = path.0.as_slice() else { return None };
        let line = Path(path.0[..1].to_vec());
        let of = structure.things[thing_at(state, &line)?].class;
        let document = &state.lowered.document;
        if !document.is_a(of, document.class_named(&Name::new("Line"))?) {
            return None;
        }
        let other = match &**name {
            "p1" => "p2",
            "p2" => "p1",
            _ => return None,
        };
        let far = place(state, thing_at(state, &end_of(&line, other))?)?;
        let length = hypot(far.0 - at.0, far.1 - at.1);
        let way = ((far.0 - at.0) / length, (far.1 - at.1) / length);
        (length > 0.0).then(|| Side { line: line.clone(), end: name.clone(), way, length })
    };
    Some(Corner { at, sides: [side(a)?, side(b)?] }).filter(|c| c.sides[0].line != c.sides[1].line)
}

impl Corner {
    /// Half of the angle between its lines.
    fn half(&self) -> f64 {
        let [a, b] = &self.sides;
        atan2(self.turn().abs(), a.way.0 * b.way.0 + a.way.1 * b.way.1) / 2.0
    }

    /// Which way the second line lies of the first: positive where it is to the left.
    fn turn(&self) -> f64 {
        let [a, b] = &self.sides;
        a.way.0 * b.way.1 - a.way.1 * b.way.0
    }

    /// The length of the shorter line.
    fn shorter(&self) -> f64 {
        self.sides[0].length.min(self.sides[1].length)
    }

    /// A radius that fits; nothing where one line lies on the other, or goes on in its direction.
    fn radius(&self) -> Option<f64> {
        let half = self.half();
        let fits = (0.05..1.5).contains(&half);
        let radius = significant(REACH * self.shorter() * sin(half) / cos(half), 1).parse();
        radius.ok().filter(|_| fits)
    }
}

/// Returns the text in which a corner is rounded: its lines end where an arc touches them.
fn rounded(
    open: &Open,
    host: &dyn Host,
    corner: &Corner,
    (radius, written): (f64, &str),
) -> Option<String> {
    let [a, b] = &corner.sides;
    let half = corner.half();
    let reach = radius * cos(half) / sin(half);
    if radius <= 0.0 || reach > MOST * corner.shorter() {
        return None;
    }
    // without the digits that only the angle's rounding has made
    let neat = |x: f64| rounded_to(x, 9).parse().unwrap_or(x);
    let along = |side: &Side| {
        (neat(corner.at.0 + reach * side.way.0), neat(corner.at.1 + reach * side.way.1))
    };
    let middle = (a.way.0 + b.way.0, a.way.1 + b.way.1);
    let far = radius / sin(half) / hypot(middle.0, middle.1);
    let center = (neat(corner.at.0 + far * middle.0), neat(corner.at.1 + far * middle.1));
    // an arc turns left from its start to its end
    let (start, end) = if corner.turn() < 0.0 { (a, b) } else { (b, a) };

    let mut trial = Open::of(&open.name, open.state.text.clone(), host);
    apply::apply(&mut trial, host, &Command::Unmerge(end_of(&b.line, &b.end))).ok()?;
    let ends = [a, b].map(|side| (end_of(&side.line, &side.end), at_place(along(side))));
    apply::apply(&mut trial, host, &Command::Move(ends.to_vec())).ok()?;
    let name = recognise::free_name(&trial.state, &Name::new("Arc"));
    let touches = |side: &Side, end: &str| {
        format!(
            "merge {} = {name}.{end}\nconstraint {}.perpendicular(to: Line({name}.center, {name}.{end}))\n",
            end_of(&side.line, &side.end),
            side.line
        )
    };
    let sized = format!("constraint {name}.radius = ");
    let members = format!(
        "{name}: Arc {{ center = ({}, {}) }}\n{}{}{sized}{}",
        shortest(center.0),
        shortest(center.1),
        touches(start, "start"),
        touches(end, "end"),
        written
    );
    apply::apply(&mut trial, host, &Command::Edit { target: Path::default(), members }).ok()?;
    let holds = trial.status.satisfied && !trial.state.has_errors();
    holds.then(|| trial.state.text.clone())
}

/// Finds a rectangle of the document that nothing speaks of, and that says no more than where it is and how large.
fn rectangle(state: &State, path: &Path) -> Option<ThingId> {
    let [Step::Part(name)] = path.0.as_slice() else { return None };
    let thing = thing_at(state, path)?;
    let class = state.lowered.document.class_named(&Name::new("Rectangle"))?;
    let is_plain = state.structure.things[thing].class == class
        && says_numbers_alone(&state.text, name)
        && apply::along(state, path).is_empty();
    is_plain.then_some(thing)
}

/// Returns true where a text gives a rectangle numbers alone: no rule, no name, no remark.
fn says_numbers_alone(text: &str, name: &Name) -> bool {
    let file = syntax::parse(base::FileId(0), text).file();
    let is_plain = |part: &Part| {
        let mut members = part.body().into_iter().flat_map(|body| body.members());
        let is_number = |member: Member| match member {
            Member::Assign(given) => {
                let target = given.target().map(|target| target.syntax().text().to_string());
                let names = given.value().map(|value| value.syntax().descendants());
                let speaks_of_no_name =
                    names.is_some_and(|mut nodes| nodes.all(|node| NameExpr::cast(node).is_none()));
                target.is_some_and(|word| OWN.contains(&word.trim())) && speaks_of_no_name
            }
            _ => false,
        };
        let has_remark = part.doc().is_some() || part.syntax().text().to_string().contains("//");
        part.value().is_none() && !has_remark && members.all(is_number)
    };
    let said = file.members().find_map(|member| match member {
        Member::Part(part) if part.names().any(|word| word.name() == *name) => Some(part),
        _ => None,
    });
    said.is_some_and(|part| part.names().count() == 1 && is_plain(&part))
}

/// Returns the command that makes a rectangle its four lines, joined at the corners; nothing where they would be another
/// figure.
pub(crate) fn in_lines(open: &Open, host: &dyn Host, path: &Path) -> Option<Command> {
    lines_of(open, host, path).map(|(text, _)| Command::Text(text))
}

/// Returns the text in which a rectangle is its four lines, and what these are called, the lower one first.
fn lines_of(open: &Open, host: &dyn Host, path: &Path) -> Option<(String, [String; 4])> {
    let state = &open.state;
    let line = state.lowered.document.class_named(&Name::new("Line"))?;
    rectangle(state, path)?;
    let of = |name: &str| thing_at(state, &end_of(path, name));
    let number = |name: &str| {
        let slot = state.structure.slot_of(of(name)?)?;
        Some(state.values.numbers[slot])
    };
    let (x, y) = place(state, of("corner")?)?;
    let (far_x, far_y) = (x + number("width")?, y + number("height")?);
    let mut trial = Open::of(&open.name, state.text.clone(), host);
    apply::apply(&mut trial, host, &Command::Delete(path.clone())).ok()?;
    let [bottom, right, top, left] =
        names(&trial.state, &state.lowered.document.classes[line].name);
    let at = |x: f64, y: f64| format!("({}, {})", shortest(x), shortest(y));
    let members = format!(
        "{bottom}: Line {{ p1 = {}  p2 = {} }}\n{right}: Line {{ p2 = {} }}\nmerge {bottom}.p2 = {right}.p1\n\
         {top}: Line {{ p2 = {} }}\nmerge {right}.p2 = {top}.p1\n{left}: Line\nmerge {top}.p2 = {left}.p1\n\
         merge {bottom}.p1 = {left}.p2\nconstraint {bottom}.p1.y = {bottom}.p2.y\n\
         constraint {right}.p1.x = {right}.p2.x\nconstraint {top}.p1.y = {top}.p2.y\n\
         constraint {left}.p1.x = {left}.p2.x",
        at(x, y),
        at(far_x, y),
        at(far_x, far_y),
        at(x, far_y)
    );
    let said = Command::Edit { target: Path::default(), members };
    apply::apply(&mut trial, host, &said).ok()?;
    let holds = trial.status.satisfied && !trial.state.has_errors();
    holds.then(|| (trial.state.text.clone(), [bottom, right, top, left]))
}

/// Four names for new things of a class.
fn names(state: &State, class: &Name) -> [String; 4] {
    let word = recognise::name_like(class);
    let is_free = |name: &String| {
        let path = Path(vec![Step::Part(Name::new(name))]);
        Name::new(name) != *class && thing_at(state, &path).is_none()
    };
    let mut free =
        std::iter::once(word.clone()).chain((2..).map(|n| format!("{word}{n}"))).filter(is_free);
    std::array::from_fn(|_| free.next().unwrap_or_default())
}

fn end_of(line: &Path, end: &str) -> Path {
    line.then(Step::Part(Name::new(end)))
}

fn at_place((x, y): (f64, f64)) -> Literal {
    Literal::Tuple(vec![Literal::Number(x), Literal::Number(y)])
}

/// Where a place is.
fn place(state: &State, thing: ThingId) -> Option<(f64, f64)> {
    let [(_, x), (_, y)] = crate::drag::coordinates(&state.structure, thing)?;
    Some((state.values.numbers[x], state.values.numbers[y]))
}
