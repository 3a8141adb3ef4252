//! A construction that waits for its operands, and what a pointer finds for the one that is wanted.

use super::catalogue::{Call, Slot, SlotKind, Tool};
use super::scene::{self, Found};
use super::view::{Hover, Prompt, Wants};
use super::{Home, becoming, crossing, edges, measure, older, outcome, text, typed};
use crate::state::State;
use crate::view::{Pointer, Refusal};
use crate::words;
use lang::with_article;
use std::collections::{BTreeMap, BTreeSet};

/// An operand as it is given.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Operand {
    /// How it is written.
    pub(crate) text: String,
    /// Where it was picked.
    pub(crate) at: Option<(f64, f64)>,
    /// Further sets for which the same is done, each in a step of its own.
    pub(crate) also: Vec<String>,
}

impl Operand {
    /// An operand by its text, and where it was picked.
    pub(crate) fn new(text: String, at: Option<(f64, f64)>) -> Self {
        Self { text, at, also: Vec::new() }
    }
}

/// A construction that waits for operands.
#[derive(Clone, Debug)]
pub(crate) struct Dialogue {
    pub(crate) tool: Tool,
    /// Those that are given.
    pub(crate) filled: Vec<Operand>,
    /// Whether what is made is drawn for construction alone.
    pub(crate) is_guide: bool,
    /// Where the pointer was last.
    pub(crate) pointer: Option<(f64, f64)>,
    /// The point that was given last, to which `@dx,dy` and `length<angle` go.
    pub(crate) last_point: Option<String>,
    /// Whether it was chosen since it made something last.
    pub(crate) is_begun: bool,
    /// What waits for the outcome of this one as its operand.
    pub(crate) goal: Option<Goal>,
    /// The step that is done anew by this one.
    pub(crate) replaces: Option<String>,
    /// How often another solution was asked for than the nearest.
    pub(crate) turned: usize,
    /// The edges or places that were picked so far, where such are wanted.
    pub(crate) edges: Vec<String>,
}

/// What waits for the outcome of another construction.
#[derive(Clone, Debug)]
pub(crate) enum Goal {
    /// A construction.
    Operand(Box<Dialogue>),
    /// A question of the second turn of a loop.
    Answer,
}

impl Dialogue {
    pub(crate) fn new(tool: Tool) -> Self {
        Self {
            tool,
            filled: Vec::new(),
            is_guide: false,
            pointer: None,
            last_point: None,
            is_begun: true,
            goal: None,
            replaces: None,
            turned: 0,
            edges: Vec::new(),
        }
    }

    /// The slot that waits.
    pub(crate) fn slot(&self) -> Option<&Slot> {
        self.tool.slots.get(self.filled.len())
    }

    /// Whether it waits for what a construction makes. Where nothing is given yet, one that has made something waits for
    /// nothing, and a copy is meant for itself.
    pub(crate) fn waits_for(&self, state: &State, tool: &Tool) -> bool {
        let Some(slot) = self.slot() else { return false };
        let is_given = !self.filled.is_empty();
        if matches!(tool.call, Call::Message(_)) && tool.class.is_empty() {
            // a copy is of the class of what it is of
            return is_given && matches!(slot.kind, SlotKind::Point | SlotKind::Curve);
        }
        let made = state.lowered.document.class_named(&tool.class);
        let fits = made.is_some_and(|made| slot.takes(state, made));
        fits && slot.kind != SlotKind::Value && (self.is_begun || is_given)
    }

    /// What it says.
    pub(crate) fn prompt(&self) -> Prompt {
        let slot = self.slot();
        let words = slot.map_or_else(String::new, |slot| {
            let wanted = match slot.kind {
                SlotKind::Point => {
                    "pick a point, or type `x,y`, `@dx,dy`, `length<angle`".to_string()
                }
                SlotKind::Curve => format!("pick {}", with_article(&slot.in_words())),
                SlotKind::Set => {
                    "pick a figure, or drag over several; Tab takes its turn, or the whole loop"
                        .to_string()
                }
                SlotKind::Edges => match self.edges.len() {
                    0 => "pick a line, an arc or a curve, or drag over all; what goes on from it is taken \
                          along"
                        .to_string(),
                    1 => "1 edge; pick the next, Enter ends it".to_string(),
                    n => format!("{n} edges; pick the next, Enter ends it"),
                },
                SlotKind::Places => match self.edges.len() {
                    0 => "pick places one after the other, or type `x,y`, `@dx,dy`".to_string(),
                    1 => "1 place; pick or type the next, Enter ends it".to_string(),
                    n => format!("{n} places; pick or type the next, Enter ends it"),
                },
                SlotKind::Value if slot.is_list => {
                    "type a value for each, as `1, 2, 1`".to_string()
                }
                SlotKind::Value if *slot.class == *"Bool" => "type `yes` or `no`".to_string(),
                SlotKind::Value if *slot.class == *"Text" => "type the words".to_string(),
                SlotKind::Value if !slot.options.is_empty() => {
                    format!("take one of {}", slot.options.join(", "))
                }
                SlotKind::Value => "type a value, pick a parameter or what has it".to_string(),
            };
            let Some(asks) = &slot.asks else { return format!("{}: {wanted}", slot.name) };
            let question = match asks.prompt.as_str() {
                "" => format!("{}:", slot.name),
                prompt => format!("{prompt} ({})", slot.name),
            };
            let range =
                asks.range.as_ref().map_or(String::new(), |r| format!(", {}", r.in_words()));
            let usual = asks.usual.as_ref().map_or(String::new(), |u| format!("; Enter takes {u}"));
            format!("{question} {wanted}{range}{usual}")
        });
        let given = |i: usize| self.filled.get(i).map(|operand| operand.text.clone());
        let operands = self.tool.slots.iter().enumerate();
        let label = match (&self.goal, &self.replaces) {
            (Some(Goal::Operand(goal)), _) => {
                let of = goal.slot().map_or("", |slot| slot.name.as_str());
                format!("{}, as {of} of {}", self.tool.label, goal.tool.label)
            }
            (Some(Goal::Answer), _) => format!("{}, as the answer", self.tool.label),
            (None, Some(step)) => format!("{} anew: {}", text::told(step), self.tool.label),
            (None, None) => self.tool.label.clone(),
        };
        Prompt {
            tool: self.tool.id.clone(),
            label,
            words,
            operands: operands.map(|(i, slot)| (slot.name.clone(), given(i))).collect(),
            is_value: slot.is_some_and(|slot| slot.kind == SlotKind::Value),
            choices: slot.map_or_else(Vec::new, Slot::choices),
            takes_sets: slot
                .is_some_and(|slot| matches!(slot.kind, SlotKind::Set | SlotKind::Edges)),
            goes_wider: slot.is_some_and(|slot| {
                matches!(slot.kind, SlotKind::Set | SlotKind::Curve | SlotKind::Point)
            }),
            is_guide: self.is_guide,
            wants: Wants::Operand,
            insert: None,
        }
    }

    /// What a pointer finds for the slot that waits.
    ///
    /// # Errors
    /// Nothing that fits; what lies there and cannot be picked is named.
    pub(crate) fn pick(
        &self,
        state: &State,
        home: &Home,
        (pointer, level): (&Pointer, usize),
    ) -> Result<Operand, Refusal> {
        let Some(slot) = self.slot() else {
            return Err(words::refuse("nothing more is asked: choose what to draw next".into()));
        };
        let mut all = scene::scene(state, home);
        if *slot.class == *"Planar" {
            // nothing comes of a surface and itself
            all.retain(|found| self.filled.iter().all(|given| given.text != found.text));
        }
        let found =
            self.whole(state, &all, pointer).or_else(|| nearest(state, slot, &all, pointer));
        let found = found.or_else(|| surface_at(state, home, (slot, &all), pointer));
        // Tab goes on from a figure to the edge that comes from it
        if found.is_none() || level % 2 == 1 {
            match edges::by_origin(state, slot, &all, pointer) {
                Some(Ok(text)) => return Ok(Operand::new(text, Some(pointer.at))),
                Some(Err(why)) if found.is_none() && slot.kind == SlotKind::Curve => {
                    return Err(why);
                }
                Some(Err(_)) | None => {}
            }
        }
        if let Some(found) = found {
            let text = match slot.kind {
                SlotKind::Value => measure::usual(state, found)
                    .ok_or_else(|| words::refuse(format!("{} has no measure", found.text)))?,
                SlotKind::Set => {
                    let whole_first = found.side_of.is_some_and(|c| slot.takes(state, c));
                    // the outline that was made of it is meant first, and what it was made of after that
                    match outline_over(state, slot, (found, &all), pointer) {
                        Some(outline) if level == 0 => outline.text.clone(),
                        Some(_) => found.at_level(level - 1, whole_first),
                        None => found.at_level(level, whole_first),
                    }
                }
                // what several cover together is what each of them covers
                SlotKind::Curve if *slot.class == *"Planar" => found.at_level(level, false),
                // where a rectangle is wanted, any side of it is meant as all of it
                SlotKind::Curve if !slot.takes(state, found.class) => found.at_level(0, true),
                SlotKind::Point | SlotKind::Curve | SlotKind::Places if level % 2 == 1 => {
                    of_last(&all, &found.text).unwrap_or_else(|| found.text.clone())
                }
                SlotKind::Point | SlotKind::Curve | SlotKind::Edges | SlotKind::Places => {
                    found.text.clone()
                }
            };
            return Ok(Operand::new(text, Some(pointer.at)));
        }
        let wants_place = matches!(slot.kind, SlotKind::Point | SlotKind::Places);
        if wants_place
            && matches!(home, Home::Program { .. })
            && let Some(crossing) = crossing::at(state, home, &all, pointer)
        {
            return Ok(Operand::new(crossing.text, Some(pointer.at)));
        }
        if let Some(older) = older::find(state, home, self, pointer) {
            return Err(words::refuse(format!(
                "{} is outside of the program that is recorded",
                older.path
            )));
        }
        match (slot.kind, slot.name.as_str()) {
            (SlotKind::Point | SlotKind::Places, _) => {
                Ok(Operand::new(typed::place(pointer), Some(pointer.at)))
            }
            (SlotKind::Value, "x" | "y") => {
                Ok(Operand::new(typed::coordinate(pointer, &slot.name), Some(pointer.at)))
            }
            (SlotKind::Curve | SlotKind::Set | SlotKind::Edges | SlotKind::Value, _) => {
                Err(words::refuse(format!("there is no {} here", slot.in_words())))
            }
        }
    }

    /// The figure that is meant where a copy is made, not its centre that is near, too; nothing where a place is meant:
    /// what goes on from the copy may want one.
    fn whole<'f>(&self, state: &State, all: &'f [Found], pointer: &Pointer) -> Option<&'f Found> {
        let slot = self.slot().filter(|slot| slot.kind == SlotKind::Set)?;
        if let Some(Goal::Operand(goal)) = &self.goal
            && goal.slot().is_some_and(|slot| slot.kind == SlotKind::Point)
        {
            return None;
        }
        let of = |is_place: bool| {
            let some: Vec<&Found> = all.iter().filter(|f| f.is_place == is_place).collect();
            nearest(state, slot, some, pointer)
        };
        let figure = of(false)?;
        let away = |found: &Found| found.curve.distance(pointer.at);
        let is_nearer = |place: &Found| away(place) < away(figure);
        (self.goal.is_none() || !of(true).is_some_and(is_nearer)).then_some(figure)
    }

    /// What a pointer, with what is typed so far, would do.
    pub(crate) fn hover(
        &self,
        state: &State,
        home: &Home,
        (pointer, level, typed): (&Pointer, usize, &str),
    ) -> Hover {
        let Some(slot) = self.slot() else { return Hover::default() };
        let operand = match typed.trim().is_empty() {
            true => self.pick(state, home, (pointer, level)),
            false => typed::operand(slot, typed, self.last_point.as_deref())
                .map(|text| Operand::new(text, None)),
        };
        let operand = match operand {
            Ok(operand) => operand,
            // a value is mostly typed: what is wrong with one here is said of a click
            Err(_) if slot.kind == SlotKind::Value && typed.trim().is_empty() => {
                return Hover::default();
            }
            Err(refusal) => return Hover { why: Some(refusal.message), ..Hover::default() },
        };
        if slot.kind == SlotKind::Edges && typed.trim().is_empty() {
            return self.hover_edges(state, home, &operand.text);
        }
        let finds = Some(match (slot.kind, typed.trim().is_empty()) {
            (SlotKind::Value, false) => with_worth(state, home, typed.trim()),
            _ => operand.text.clone(),
        });
        let lit = match (slot.kind, typed.trim().is_empty()) {
            (SlotKind::Curve | SlotKind::Set | SlotKind::Point | SlotKind::Places, true) => {
                let mut lit = scene::drawing_of(state, home, &operand.text);
                let found = scene::scene(state, home);
                let found = found.iter().find(|found| found.text == operand.text);
                lit.elements.extend(found.and_then(|found| found.curve.arrow(pointer)));
                // a place of the sheet is where the pointer is; one of two curves has no name
                if lit.elements.is_empty() && operand.text != typed::place(pointer) {
                    lit = outcome::drawing_of(state, home, &operand.text);
                }
                lit
            }
            _ => drawing::Drawing::default(),
        };
        if self.filled.len() + 1 < self.tool.slots.len() {
            return Hover { finds, ghost: lit, why: None };
        }
        let mut operands = self.filled.clone();
        operands.push(match slot.kind {
            // one place is not yet a curve
            SlotKind::Places if self.edges.is_empty() => {
                return Hover { finds, ghost: lit, why: None };
            }
            SlotKind::Places => {
                let all = self.edges.iter().chain([&operand.text]);
                Operand::new(listed(all.map(String::as_str)), None)
            }
            _ => operand,
        });
        let given = (&self.tool, &operands[..], self.pointer, self.turned);
        match outcome::choose(state, home, given) {
            Ok(chosen) => {
                let mut ghost = chosen.drawing;
                ghost.elements.extend(chosen.curve.and_then(|curve| curve.arrow(pointer)));
                Hover { finds, ghost, why: None }
            }
            // the pointer is still where it has picked the operand before
            Err(_) if typed.trim().is_empty() && slot.kind == SlotKind::Value => {
                Hover { finds, ..Hover::default() }
            }
            Err(_)
                if typed.trim().is_empty()
                    && self.filled.last().map(|last| &last.text) == finds.as_ref() =>
            {
                Hover::default()
            }
            Err(refusal) => {
                let typed = (typed.trim(), slot.class.as_str());
                let why = becoming::may_become(state, home, typed).unwrap_or(refusal.message);
                Hover { finds, why: Some(why), ..Hover::default() }
            }
        }
    }
}

/// Writes texts as one list.
pub(crate) fn listed<'t>(texts: impl Iterator<Item = &'t str>) -> String {
    format!("[{}]", texts.collect::<Vec<_>>().join(", "))
}

impl Dialogue {
    /// Takes one more place; says what is wanted then.
    pub(crate) fn with_place(&mut self, place: String) -> Prompt {
        self.last_point = Some(place.clone());
        self.edges.push(place);
        self.prompt()
    }

    /// The edges that are picked with one more, and what goes on from them.
    pub(crate) fn with_edge(&self, state: &State, home: &Home, edge: &str) -> Vec<String> {
        let mut picked = self.edges.clone();
        if !picked.iter().any(|other| other == edge) {
            picked.push(edge.into());
        }
        edges::followed(state, home, &picked)
    }

    /// What one more edge would do: all of them are lit.
    fn hover_edges(&self, state: &State, home: &Home, edge: &str) -> Hover {
        let all = self.with_edge(state, home, edge);
        let ghost = scene::drawing_of_all(state, home, &all);
        Hover { finds: Some(all.join(", ")), ghost, why: None }
    }
}

/// A value that is typed, with what it comes to where that says more.
fn with_worth(state: &State, home: &Home, typed: &str) -> String {
    match outcome::worth(state, home, typed) {
        Ok(outcome::Worth::Number(number)) if !typed::is_number(typed) => {
            format!("{typed} = {number}")
        }
        _ => typed.into(),
    }
}

/// Says of what is in the last of many that it is in the last, however many there are: `turns.last.circle` for
/// `turns[3].circle`. Nothing where it is in no last one.
fn of_last(all: &[Found], text: &str) -> Option<String> {
    let (mut said, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once('[') {
        let (index, behind) = after.split_once(']')?;
        let set = &text[..text.len() - after.len()];
        let number = |text: &str| text.split(']').next()?.parse::<usize>().ok();
        let numbers = all.iter().filter_map(|f| number(f.text.strip_prefix(set)?));
        let is_last = numbers.max().is_some_and(|most| most > 0 && number(after) == Some(most));
        said += before;
        said += &if is_last { ".last".into() } else { format!("[{index}]") };
        rest = behind;
    }
    Some(said + rest).filter(|said| said != text)
}

/// Returns the outline that was drawn last over a figure, along its edge.
fn outline_over<'f>(
    state: &State,
    slot: &Slot,
    (figure, all): (&Found, &'f [Found]),
    pointer: &Pointer,
) -> Option<&'f Found> {
    let least = figure.curve.distance(pointer.at) + pointer.reach * 1e-6;
    let over = all.iter().rev().take_while(|found| !std::ptr::eq(*found, figure));
    let is_it = |f: &&Found| f.side.is_some() && f.curve.distance(pointer.at) <= least;
    over.filter(is_it).find(|f| f.text != figure.text && slot.takes(state, f.class))
}

/// Returns the surface that was drawn last of those that are filled under a pointer, where a surface is wanted.
fn surface_at<'f>(
    state: &State,
    home: &Home,
    (slot, all): (&Slot, &'f [Found]),
    pointer: &Pointer,
) -> Option<&'f Found> {
    let at = drawing::Point { x: pointer.at.0, y: pointer.at.1 };
    let is_filled = |element: &drawing::Element| match &element.shape {
        drawing::Shape::Region(rings) => {
            element.style.fill.is_some() && drawing::curve::covers(rings, at)
        }
        _ => false,
    };
    if !matches!(slot.class.as_str(), "Planar" | "Outlined") {
        return None;
    }
    // what an edge lies below, above, to the left and to the right of may surround it
    let mut boxes: BTreeMap<&str, [[f64; 2]; 2]> = BTreeMap::new();
    for f in all.iter().filter(|f| f.side.is_some() && slot.takes(state, f.class)) {
        if let Some([low, high]) = f.curve.room() {
            let around = boxes.entry(&f.text).or_insert([low, high]);
            let wider = |k: usize| (around[0][k].min(low[k]), around[1][k].max(high[k]));
            let (x, y) = (wider(0), wider(1));
            *around = [[x.0, y.0], [x.1, y.1]];
        }
    }
    let is_around = |f: &&Found| {
        boxes.get(f.text.as_str()).is_some_and(|[low, high]| {
            low[0] <= at.x && at.x <= high[0] && low[1] <= at.y && at.y <= high[1]
        })
    };
    let mut known = BTreeSet::new();
    let mut surfaces = { all.iter().rev() }.filter(is_around).filter(|f| known.insert(&f.text));
    surfaces.find(|f| scene::drawing_of(state, home, &f.text).elements.iter().any(is_filled))
}

/// Returns the nearest figure that fits a slot, a point before what runs through it.
pub(crate) fn nearest<'f>(
    state: &State,
    slot: &Slot,
    all: impl IntoIterator<Item = &'f Found>,
    pointer: &Pointer,
) -> Option<&'f Found> {
    let fits = |f: &&Found| match slot.kind {
        SlotKind::Value => measure::usual(state, f).is_some(),
        SlotKind::Edges => f.side.is_none() && f.curve.ends().is_some(),
        // a copy is one of all of it, never of a place in it
        SlotKind::Set if f.is_place && f.side_of.is_some() => false,
        SlotKind::Curve => {
            slot.takes(state, f.class) || f.side_of.is_some_and(|c| slot.takes(state, c))
        }
        SlotKind::Point | SlotKind::Places | SlotKind::Set => slot.takes(state, f.class),
    };
    let fitting: Vec<&Found> = all.into_iter().filter(fits).collect();
    let near = scene::nearest(fitting.iter().copied(), pointer)?;
    if *slot.class != *"Planar" {
        return Some(near);
    }
    // an outline and what is made of it have edges in common: the newest is meant
    let away = |found: &Found| found.curve.distance(pointer.at);
    let least = away(near) + pointer.reach * 1e-6;
    fitting.into_iter().rev().find(|found| away(found) <= least)
}
