//! What a pointer finds for a place: a part to join, a midpoint, a line to lie on, a level to keep.

use crate::by_hand::class_at;
use crate::joining;
use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::view::{PictureView, Pointer};
use base::Name;
use base::number::{RULE_TOLERANCE, hypot, rounded};
use drawing::{Element, Point, Shape};
use kernel::{ClassId, Path, Step};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// What was found, and where.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Catch {
    /// Where the place is, on the sheet.
    pub(crate) at: (f64, f64),
    /// The part that the place becomes one with.
    pub(crate) joins: Option<Path>,
    /// What shall hold of the place, in the language.
    pub(crate) rules: Vec<String>,
    /// What comes of it, in a word.
    pub(crate) word: Option<String>,
    /// Whether the place is level with, or right above, the last one.
    pub(crate) is_level: bool,
    /// The places that it is level with, or right above, of which no rule is made.
    pub(crate) beside: Vec<(f64, f64)>,
}

impl Catch {
    /// Nothing but a place.
    pub(crate) fn at(at: (f64, f64)) -> Self {
        let (rules, beside) = (Vec::new(), Vec::new());
        Self { at, joins: None, rules, word: None, is_level: false, beside }
    }
}

/// What a pointer looks at, and for what.
pub(crate) struct Sight<'s> {
    pub(crate) state: &'s State,
    pub(crate) picture: &'s PictureView,
    /// The class of what is placed, in the document.
    pub(crate) class: Option<ClassId>,
    /// The path of what is placed.
    pub(crate) own: Path,
    /// The name of the thing that it is a part of.
    pub(crate) whole: Name,
    /// Where the place before it is, and its path, for what is drawn line by line.
    pub(crate) last: Option<((f64, f64), Path)>,
    /// Whether what is set is how far the pointer is from the last place.
    pub(crate) is_reach: bool,
    /// The classes that were asked for, by tag.
    pub(crate) classes: RefCell<BTreeMap<u32, Option<ClassId>>>,
}

impl Sight<'_> {
    /// The class of the thing, or of what the document computes, that an element pictures: asked once. What a program
    /// drew is not looked for, pointer by pointer.
    fn class_of(&self, element: &Element) -> Option<ClassId> {
        let tag = element.tag.0;
        if let Some(known) = self.classes.borrow().get(&tag) {
            return *known;
        }
        let path = self.path(element).and_then(|path| parse_path(path));
        let near = path.filter(|p| {
            p.0.len() == 1 || thing_at(self.state, p).is_some() || self.is_declared(element)
        });
        let class = near.and_then(|path| class_at(self.state, &path));
        self.classes.borrow_mut().insert(tag, class);
        class
    }

    /// Whether an element pictures a figure that the class of a thing declares, as a side of a rectangle.
    fn is_declared(&self, element: &Element) -> bool {
        let (structure, document) = (&self.state.structure, &self.state.lowered.document);
        let whole = self.picture.drawn_by.get(element.tag.0 as usize).cloned().flatten();
        let whole = whole.and_then(|whole| thing_at(self.state, &parse_path(&whole)?));
        whole.is_some_and(|thing| document.program(structure.things[thing].class).is_none())
    }

    /// The path of what an element pictures.
    fn path(&self, element: &Element) -> Option<&String> {
        self.picture.paths.get(element.tag.0 as usize)
    }

    /// Whether what an element pictures has a part that is a place.
    fn has_place(&self, element: &Element, part: &str) -> bool {
        let document = &self.state.lowered.document;
        let fields = self.class_of(element).map(|class| document.layout(class)).unwrap_or_default();
        let mut named = fields.into_iter().filter(|f| **document.field_name(*f) == *part);
        named.any(|field| document.is_place(document.field_class(field)))
    }

    /// Whether what an element pictures answers a message.
    fn answers(&self, element: &Element, message: &str) -> bool {
        let document = &self.state.lowered.document;
        let class = self.class_of(element);
        class.is_some_and(|c| document.find_message(c, &Name::new(message), None).is_some())
    }
}

/// Returns what the pointer finds: what it is nearest to, points before lines, lines before levels, levels before places
/// that are merely beside others. A place that was typed joins what stands there.
pub(crate) fn find(sight: &Sight<'_>, pointer: &Pointer) -> Catch {
    if pointer.alone {
        return Catch::at(pointer.at);
    }
    if pointer.is_typed {
        let (x, y) = pointer.at;
        let exactly = Pointer { reach: RULE_TOLERANCE * x.abs().max(y.abs()), ..pointer.clone() };
        let found = at_point(sight, &exactly).and_then(|found| Some((found.at, found.joins?)));
        let joint = |(at, joined)| Catch {
            word: Some(format!("joins {joined}")),
            joins: Some(joined),
            ..Catch::at(at)
        };
        return found.map_or_else(|| Catch::at(pointer.at), joint);
    }
    let found = at_point(sight, pointer).or_else(|| at_body(sight, pointer));
    let found = found.or_else(|| touching(sight, pointer));
    let found = found.or_else(|| at_shape(sight, pointer)).or_else(|| level(sight, pointer));
    let found = found.or_else(|| aligned(sight, pointer));
    let found = found.unwrap_or_else(|| beside(sight, pointer, Catch::at(pointer.at), [true; 2]));
    match found.joins {
        // one with what is there, to the bit
        Some(_) => found,
        None => {
            let short = |x| short(x, pointer.reach);
            Catch { at: (short(found.at.0), short(found.at.1)), ..found }
        }
    }
}

/// A coordinate without the digits that only rounding has made, where what counts is as large as `like`.
pub(super) fn short(x: f64, like: f64) -> f64 {
    let (mut digits, mut like) = (9, like.abs());
    while 0.0 < like && like < 1.0 && digits < 40 {
        (digits, like) = (digits + 1, like * 10.0);
    }
    rounded(x, digits).parse().unwrap_or(x)
}

/// A grip that what is placed can become one with; for a radius, a point that the circle passes through.
fn at_point(sight: &Sight<'_>, pointer: &Pointer) -> Option<Catch> {
    let far = |x: f64, y: f64| hypot(x - pointer.at.0, y - pointer.at.1);
    let mut near: Vec<_> = sight.picture.grips.iter().map(|g| (far(g.x, g.y), g)).collect();
    near.retain(|(distance, _)| *distance <= pointer.reach);
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    near.into_iter().find_map(|(_, grip)| {
        let path = parse_path(&grip.path)?;
        let at = Catch::at((grip.x, grip.y));
        if sight.is_reach {
            let rules = vec![format!("{}.passes(through: {path})", sight.whole)];
            return Some(Catch { rules, word: Some(format!("through {path}")), ..at });
        }
        if grip.drawn {
            // what is computed is not joined, but followed
            let is_place = sight.class.is_some_and(|c| sight.state.lowered.document.is_place(c));
            let rules = vec![format!("{} = {path}", sight.own)];
            return is_place.then(|| Catch { rules, word: Some(format!("at {path}")), ..at });
        }
        let joined = joining::partner_of(sight.state, sight.class?, &path)?;
        let (rules, aside) = exactly_level(sight, at.at).unzip();
        let word = format!("joins {joined}{}", aside.unwrap_or_default());
        Some(Catch {
            word: Some(word),
            joins: Some(joined),
            rules: rules.into_iter().collect(),
            ..at
        })
    })
}

/// What is no place becomes one with what is like it, wherever that is taken: a relation's line with any line.
fn at_body(sight: &Sight<'_>, pointer: &Pointer) -> Option<Catch> {
    let class = sight.class?;
    if sight.is_reach || sight.state.lowered.document.is_place(class) {
        return None;
    }
    let near = |element: &Element| {
        let foot = match &element.shape {
            Shape::Segment(a, b) => on_segment(pointer.at, *a, *b)?,
            Shape::Circle { center, radius } | Shape::Arc { center, radius, .. } => {
                on_circle(pointer.at, *center, *radius)?
            }
            _ => return None,
        };
        let far = hypot(foot.0 - pointer.at.0, foot.1 - pointer.at.1);
        (far <= pointer.reach).then_some((far, foot))
    };
    let elements = sight.picture.drawing.elements.iter();
    let found = elements.filter_map(|element| {
        let (far, foot) = near(element)?;
        let path = parse_path(sight.path(element)?)?;
        thing_at(sight.state, &path)?;
        Some((far, foot, joining::partner_of(sight.state, class, &path)?))
    });
    let (_, foot, joined) = found.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let word = Some(format!("joins {joined}"));
    Some(Catch { word, joins: Some(joined), ..Catch::at(foot) })
}

/// The rule that what is drawn from the last place to one that it joins is level, or upright, where it is so exactly: the
/// last side of a box; and the word for it.
fn exactly_level(sight: &Sight<'_>, at: (f64, f64)) -> Option<(String, &'static str)> {
    let (last, before) = sight.last.as_ref()?;
    let (dx, dy) = ((at.0 - last.0).abs(), (at.1 - last.1).abs());
    let (name, word) = match () {
        () if dx.max(dy) == 0.0 => return None,
        () if dy <= 1e-9 * dx => ("y", ", horizontal"),
        () if dx <= 1e-9 * dy => ("x", ", vertical"),
        () => return None,
    };
    let coordinate = |path: &Path| path.then(Step::Part(Name::new(name)));
    Some((format!("{} = {}", coordinate(before), coordinate(&sight.own)), word))
}

/// The middle of a line, the centre of a circle or arc that is computed, or a line or circle that the place lies on.
fn at_shape(sight: &Sight<'_>, pointer: &Pointer) -> Option<Catch> {
    let document = &sight.state.lowered.document;
    if sight.is_reach || !sight.class.is_some_and(|class| document.is_place(class)) {
        return None;
    }
    let (x, y) = pointer.at;
    let mut nearest: Option<(f64, Catch)> = None;
    for element in &sight.picture.drawing.elements {
        let Some(path) = sight.path(element) else { continue };
        // where it lies first: what it is may be dear to tell
        let foot = match &element.shape {
            Shape::Segment(a, b) => {
                let middle = (f64::midpoint(a.x, b.x), f64::midpoint(a.y, b.y));
                let far = hypot(middle.0 - x, middle.1 - y);
                if far <= pointer.reach && sight.answers(element, "midpoint") {
                    let rules = vec![format!("{} = {path}.midpoint", sight.own)];
                    let word = Some(format!("midpoint of {path}"));
                    return Some(Catch { rules, word, ..Catch::at(middle) });
                }
                on_segment(pointer.at, *a, *b)
            }
            Shape::Circle { center, .. } | Shape::Arc { center, .. }
                if hypot(center.x - x, center.y - y) <= pointer.reach
                    && sight.has_place(element, "center") =>
            {
                let rules = vec![format!("{} = {path}.center", sight.own)];
                let word = Some(format!("centre of {path}"));
                return Some(Catch { rules, word, ..Catch::at((center.x, center.y)) });
            }
            Shape::Circle { center, radius } => on_circle(pointer.at, *center, *radius),
            // a point that a construction makes
            Shape::Dot(p) if hypot(p.x - x, p.y - y) <= pointer.reach => {
                if !sight.class_of(element).is_some_and(|class| document.is_place(class)) {
                    continue;
                }
                let rules = vec![format!("{} = {path}", sight.own)];
                let word = Some(format!("at {path}"));
                return Some(Catch { rules, word, ..Catch::at((p.x, p.y)) });
            }
            Shape::Dot(_)
            | Shape::Polyline { .. }
            | Shape::Arc { .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_)
            | Shape::Region(_)
            | Shape::Text { .. } => None,
        };
        let Some(foot) = foot else { continue };
        let far = hypot(foot.0 - x, foot.1 - y);
        let is_nearer = nearest.as_ref().is_none_or(|(least, _)| far < *least);
        if far <= 0.6 * pointer.reach && is_nearer && sight.answers(element, "passes") {
            let rules = vec![format!("{path}.passes(through: {})", sight.own)];
            let word = Some(format!("on {path}"));
            nearest = Some((far, Catch { rules, word, ..Catch::at(foot) }));
        }
    }
    nearest.map(|(_, catch)| catch)
}

/// The foot of a place on a segment, where that lies between its ends.
fn on_segment((x, y): (f64, f64), a: Point, b: Point) -> Option<(f64, f64)> {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let square = dx * dx + dy * dy;
    let along = ((x - a.x) * dx + (y - a.y) * dy) / square;
    (0.0..=1.0).contains(&along).then_some((a.x + along * dx, a.y + along * dy))
}

/// The nearest point of a circle.
fn on_circle((x, y): (f64, f64), center: Point, radius: f64) -> Option<(f64, f64)> {
    let (dx, dy) = (x - center.x, y - center.y);
    let far = hypot(dx, dy);
    (far > 0.0).then(|| (center.x + radius / far * dx, center.y + radius / far * dy))
}

/// A place level with the last one, or right above or below it.
fn level(sight: &Sight<'_>, pointer: &Pointer) -> Option<Catch> {
    let (last, before) = sight.last.as_ref()?;
    let (dx, dy) = ((pointer.at.0 - last.0).abs(), (pointer.at.1 - last.1).abs());
    let near = 0.6 * pointer.reach;
    let coordinate = |path: &Path, name: &str| path.then(Step::Part(Name::new(name)));
    let (name, word, at, free) = match () {
        () if dy <= near && dx > pointer.reach => {
            ("y", "horizontal", (pointer.at.0, last.1), [true, false])
        }
        () if dx <= near && dy > pointer.reach => {
            ("x", "vertical", (last.0, pointer.at.1), [false, true])
        }
        () => return None,
    };
    let rules = vec![format!("{} = {}", coordinate(before, name), coordinate(&sight.own, name))];
    let level = Catch { rules, word: Some(word.into()), is_level: true, ..Catch::at(at) };
    Some(beside(sight, pointer, level, free))
}

/// What was found, with those of its coordinates that are free taken from grips that have nearly the same. It is where
/// the place is drawn, and no rule: the last but one corner of a box, right above the first.
fn beside(sight: &Sight<'_>, pointer: &Pointer, found: Catch, free: [bool; 2]) -> Catch {
    if sight.is_reach {
        return found;
    }
    let near = 0.4 * pointer.reach;
    let mut found = found;
    let coordinates = |at: (f64, f64)| [at.0, at.1];
    let mut at = coordinates(found.at);
    let mut words = Vec::new();
    for axis in [0, 1].into_iter().filter(|&axis| free[axis]) {
        let here = coordinates(pointer.at);
        let grips = sight.picture.grips.iter().filter(|g| pointer.sees((g.x, g.y)));
        let grips = grips.map(|g| (coordinates((g.x, g.y)), &g.path));
        // of those with the nearest coordinate the nearest
        let least = grips
            .map(|(grip, path)| {
                (
                    (grip[axis] - here[axis]).abs(),
                    (grip[1 - axis] - here[1 - axis]).abs(),
                    grip,
                    path,
                )
            })
            .filter(|(off, far, ..)| *off <= near && *far > pointer.reach)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        if let Some((_, _, grip, path)) = least {
            at[axis] = grip[axis];
            found.beside.push((grip[0], grip[1]));
            words.push(path);
        }
    }
    found.at = (at[0], at[1]);
    if let ([first, others @ ..], None) = (words.as_slice(), &found.word) {
        let and = others.iter().map(|path| format!(" and {path}"));
        found.word = Some(format!("in line with {first}{}", and.collect::<String>()));
    }
    found
}

/// The lines and circles of the picture by their paths, those whose class answers a message.
fn shapes<'s>(
    sight: &'s Sight<'_>,
    message: &'s str,
) -> impl Iterator<Item = (&'s Shape, &'s String)> {
    let elements = sight.picture.drawing.elements.iter();
    let drawn = elements.filter(|e| matches!(e.shape, Shape::Segment(..) | Shape::Circle { .. }));
    let answering = drawn.filter(move |element| sight.answers(element, message));
    answering.filter_map(|element| Some((&element.shape, sight.path(element)?)))
}

/// Where a line from the last place touches a circle.
fn touching(sight: &Sight<'_>, pointer: &Pointer) -> Option<Catch> {
    let (last, _) = sight.last.as_ref()?;
    let (x, y) = pointer.at;
    let near = shapes(sight, "passes").find_map(|(shape, path)| {
        let Shape::Circle { center, radius } = shape else { return None };
        let (dx, dy) = (center.x - last.0, center.y - last.1);
        let far = hypot(dx, dy);
        if far <= *radius {
            return None;
        }
        // the foot of the centre on each tangent
        let along = (far * far - radius * radius).sqrt();
        let (cos, sin) = (along / far, radius / far);
        let at = |side: f64| {
            let (ux, uy) = ((dx * cos - side * dy * sin) / far, (dy * cos + side * dx * sin) / far);
            (last.0 + along * ux, last.1 + along * uy)
        };
        let at = [at(1.0), at(-1.0)]
            .into_iter()
            .find(|at| hypot(at.0 - x, at.1 - y) <= pointer.reach)?;
        Some((at, path))
    });
    let (at, path) = near?;
    let (own, whole) = (&sight.own, &sight.whole);
    let rules = vec![
        format!("{path}.passes(through: {own})"),
        format!("{whole}.perpendicular(to: Line({path}.center, {own}))"),
    ];
    Some(Catch { rules, word: Some(format!("touches {path}")), is_level: true, ..Catch::at(at) })
}

/// At most so many lines are compared with one that is drawn.
const MOST_ALIGNED: usize = 40;

/// A place so that what is drawn from the last one is parallel or perpendicular to another line.
fn aligned(sight: &Sight<'_>, pointer: &Pointer) -> Option<Catch> {
    let (last, _) = sight.last.as_ref()?;
    let way = (pointer.at.0 - last.0, pointer.at.1 - last.1);
    let far = hypot(way.0, way.1);
    if far <= 3.0 * pointer.reach {
        return None;
    }
    let mut nearest: Option<(f64, Catch)> = None;
    for (shape, path) in shapes(sight, "parallel").take(MOST_ALIGNED) {
        let Shape::Segment(a, b) = shape else { continue };
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let length = hypot(dx, dy);
        if length <= 0.0 {
            continue;
        }
        let (dx, dy) = (dx / length, dy / length);
        for (name, (ux, uy)) in [("parallel", (dx, dy)), ("perpendicular", (-dy, dx))] {
            let along = way.0 * ux + way.1 * uy;
            let aside = (way.1 * ux - way.0 * uy).abs();
            let is_nearer = nearest.as_ref().is_none_or(|(least, _)| aside < *least);
            if aside <= 0.3 * pointer.reach && is_nearer {
                let at = (last.0 + along * ux, last.1 + along * uy);
                let rules = vec![format!("{}.{name}(to: {path})", sight.whole)];
                let word = Some(format!("{name} to {path}"));
                nearest = Some((aside, Catch { rules, word, is_level: true, ..Catch::at(at) }));
            }
        }
    }
    nearest.map(|(_, catch)| catch)
}
