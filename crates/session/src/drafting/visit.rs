//! Visiting a program: going through its steps, and inserting, replacing and deleting where one is.
//!
//! A visit is a place: the blocks around it, each with the turn that is shown, and the step that comes next. What is
//! drawn there is inserted before that step.

use super::blocks::{self, Block, Kind};
use super::own_values::{self, Meanwhile};
use super::view::Go;
use super::{Around, Home, Recording, recording, scene, steps, text};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Pointer, Refusal};
use crate::words;
use base::Name;
use eval::{Answer, Evaluator, Standing};
use std::collections::BTreeSet;
use syntax::ast::Value;

/// The home in front of a step: the first turn of the loops around it.
pub(crate) fn home_of(
    source: &text::Source,
    (program, example): (&Name, &Name),
    address: &str,
    turns: &[u32],
) -> Option<Home> {
    text::step_at(source, program, address)?;
    let segments: Vec<&str> = address.split('.').collect();
    let (last, around) = segments.split_last()?;
    let mut way: Vec<Around> = Vec::new();
    let mut at = String::new();
    let mut rest = around.iter();
    let mut turns = turns.iter().copied();
    while let Some(segment) = rest.next() {
        at = text::joined(&at, segment);
        let step = text::step_at(source, program, &at)?;
        let name = step.name.as_deref().map(Name::new);
        let is_loop =
            matches!(step.value, Some(Value::Repeat(_) | Value::While(_) | Value::For(_)));
        let mut own = (*segment).to_string();
        if matches!(step.value, Some(Value::If(_))) {
            let branch = rest.next()?;
            own = text::joined(&own, branch);
            at = text::joined(&at, branch);
        }
        let turn = is_loop.then(|| turns.next().unwrap_or(0));
        way.push(Around { address: own, name, turn });
    }
    let (program, example) = (program.clone(), example.clone());
    Some(Home::Program { program, example, way, before: Some((*last).to_string()) })
}

/// The turns that are visited of the loops around a step, from the outermost, as far as they are.
pub(crate) fn turns_around(home: &Home, address: &str) -> Vec<u32> {
    let ends = address.match_indices('.').map(|(at, _)| &address[..at]);
    ends.filter_map(|around| turn_of(home, around)).collect()
}

/// The same, with its own where the step is a loop.
pub(crate) fn turns_in(home: &Home, address: &str) -> Vec<u32> {
    turns_around(home, &format!("{address}."))
}

/// The turn that is visited of a loop, by its address.
pub(crate) fn turn_of(home: &Home, address: &str) -> Option<u32> {
    let Home::Program { way, .. } = home else { return None };
    let mut at = String::new();
    let mut around = way.iter().map(|around| {
        at = text::joined(&at, &around.address);
        (at.clone(), around.turn)
    });
    around.find(|(at, _)| at == address)?.1
}

/// Goes somewhere in the program that is recorded.
///
/// # Errors
/// Nothing is recorded, a block is demonstrated; there is no such place.
pub(crate) fn go(open: &mut Open, go: &Go) -> Result<(), Refusal> {
    let recording = blocks::recorded(open)?;
    if recording.blocks.iter().any(|block| block.kind != Kind::Visited) {
        return Err(words::refuse(
            "a repeat or an `if` is still being drawn: end it first, or undo it".into(),
        ));
    }
    let (program, example) = (recording.program.clone(), recording.example.clone());
    let home = Home::of(Some(recording));
    let source = text::Source::now(&open.state);
    let body_of = |home: &Home| {
        let body = text::block(&source, &program, &text::address_of(home));
        body.map(|body| text::steps_of(&body)).unwrap_or_default()
    };
    let Home::Program { mut way, before, .. } = home.clone() else { return Ok(()) };
    let at_home = |way: Vec<Around>, before: Option<String>| Home::Program {
        program: program.clone(),
        example: example.clone(),
        way,
        before,
    };
    let after = |home: &Home, segment: &str| {
        let steps = body_of(home);
        let at = steps.iter().position(|step| step.segment == segment);
        at.and_then(|at| steps.get(at + 1)).map(|step| step.segment.clone())
    };
    let out = |mut way: Vec<Around>| {
        let around = way.pop()?;
        let outer = at_home(way.clone(), None);
        let next = after(&outer, around.segment());
        Some(at_home(way, next))
    };
    let to = match go {
        Go::Start => {
            let outer = at_home(Vec::new(), None);
            let first = body_of(&outer).first().map(|step| step.segment.clone());
            at_home(Vec::new(), first)
        }
        Go::End => at_home(Vec::new(), None),
        Go::Step => match &before {
            Some(before) => {
                let next = after(&home, before);
                at_home(way, next)
            }
            None => out(way).unwrap_or_else(|| at_home(Vec::new(), None)),
        },
        Go::Back => {
            let steps = body_of(&home);
            let at = before.as_ref().and_then(|b| steps.iter().position(|s| s.segment == *b));
            match at.unwrap_or(steps.len()).checked_sub(1).and_then(|at| steps.get(at)) {
                Some(step) => at_home(way, Some(step.segment.clone())),
                None => match way.pop() {
                    Some(around) => at_home(way, Some(around.segment().to_string())),
                    None => home.clone(),
                },
            }
        }
        Go::Out => out(way).unwrap_or_else(|| at_home(Vec::new(), None)),
        Go::In => {
            let none = || {
                words::refuse(
                    "no repeat and no `if` comes next: there is nothing to go into".into(),
                )
            };
            let segment = before.clone().ok_or_else(none)?;
            let address = text::joined(&text::address_of(&home), &segment);
            let inner = inner_of(&open.state, (&home, &program), &address).ok_or_else(none)?;
            let first =
                home_of(&source, (&program, &example), &inner, &turns_around(&home, &inner));
            first.ok_or_else(none)?
        }
        Go::To(address) => {
            let none = || words::refuse(format!("{program} has no step {address}"));
            let turns = turns_around(&home, address);
            home_of(&source, (&program, &example), address, &turns).ok_or_else(none)?
        }
        Go::UntilPicked(pointer) => until_picked(open, (&program, &example), pointer)?,
        Go::UntilDrawn(name) => {
            let none = || words::refuse(format!("{program} draws no {name}"));
            until_drawn((&program, &example), name, &source).ok_or_else(none)?
        }
    };
    enter(open, to);
    Ok(())
}

/// Says where recording goes on, so that [`return_to`] finds it in the same text: the program, the turns of the loops
/// around, and the address of the step that comes next; at the end of a block the address of the block, with a dot.
pub(crate) fn left_at(open: &Open) -> Option<String> {
    let recording = open.recording.as_ref()?;
    let visited = recording.blocks.iter().take_while(|block| block.kind == Kind::Visited);
    let way: Vec<&Around> = visited.map(|block| &block.around).collect();
    let before = match recording.blocks.get(way.len()) {
        // what is demonstrated there is found by what is open in the text
        Some(demonstrated) => demonstrated.before.as_deref(),
        None => recording.before.as_deref(),
    };
    let turns: Vec<String> = way.iter().filter_map(|a| Some(a.turn?.to_string())).collect();
    let block = way.iter().fold(String::new(), |at, around| text::joined(&at, &around.address));
    let end = if block.is_empty() { "" } else { "." };
    let at = before.map_or_else(|| format!("{block}{end}"), |before| text::joined(&block, before));
    Some(format!("{} [{}] {at}", recording.program, turns.join(" ")))
}

/// Goes on recording where [`left_at`] says that it was left; at the program's end where there is no such place.
///
/// # Errors
/// There is no such program.
pub(crate) fn return_to(open: &mut Open, host: &dyn Host, left: &str) -> Result<Change, Refusal> {
    let (program, rest) = left.split_once(" [").unwrap_or((left, ""));
    let (turns, at) = rest.split_once("] ").unwrap_or_default();
    let source = text::Source::now(&open.state);
    if text::program(&source, program).is_none() {
        return Err(words::refuse(format!("there is no program {program}")));
    }
    let change = recording::begin(open, host, program)?;
    let Some(Recording { program, example, blocks, .. }) = &open.recording else {
        return Ok(change);
    };
    // what is demonstrated at the end of the program was found already
    if !blocks.is_empty() || at.is_empty() {
        return Ok(change);
    }
    let source = text::Source::now(&open.state);
    let turns: Vec<u32> = turns.split(' ').filter_map(|turn| turn.parse().ok()).collect();
    let (block, is_end) = at.strip_suffix('.').map_or((at, false), |block| (block, true));
    let first = text::block(&source, program, block).map(|body| text::steps_of(&body));
    let first = first.and_then(|steps| Some(text::joined(block, &steps.first()?.segment)));
    let address = if is_end { first } else { Some(at.into()) };
    let home = address.and_then(|at| home_of(&source, (program, example), &at, &turns));
    let Some(Home::Program { program, example, way, before }) = home else { return Ok(change) };
    let before = before.filter(|_| !is_end);
    enter(open, Home::Program { program, example, way, before });
    blocks::resume(open);
    blocks::settle(open);
    Ok(change)
}

/// Makes a home that which is visited.
pub(crate) fn enter(open: &mut Open, to: Home) {
    let Home::Program { way, before, .. } = to else { return };
    let Some(recording) = &mut open.recording else { return };
    let source = text::Source::now(&open.state);
    let since = open.done.len();
    let mut blocks: Vec<Block> = Vec::new();
    for around in way {
        let outer: Vec<Around> = blocks.iter().map(|block| block.around.clone()).collect();
        let home = Home::Program {
            program: recording.program.clone(),
            example: recording.example.clone(),
            way: outer,
            before: None,
        };
        let body = text::block(&source, &recording.program, &text::address_of(&home));
        let steps = body.map(|body| text::steps_of(&body)).unwrap_or_default();
        let at = steps.iter().position(|step| step.segment == around.segment());
        let before = at.and_then(|at| steps.get(at + 1)).map(|step| step.segment.clone());
        blocks.push(Block { around, kind: Kind::Visited, since, before });
    }
    recording.blocks = blocks;
    recording.before = before;
    open.dialogue = None;
}

/// The address of the first step in a block; of an `if` in the branch that is taken now.
fn inner_of(state: &State, (home, program): (&Home, &Name), address: &str) -> Option<String> {
    let value = text::step_at(&text::Source::now(state), program, address)?.value?;
    let branch = match &value {
        Value::Expr(_) => return None,
        Value::Repeat(_) | Value::While(_) | Value::For(_) => "",
        Value::If(choice) => {
            use syntax::ast::AstNode;
            let condition = choice.condition()?.syntax().text().to_string();
            let truth = super::outcome::worth(state, home, condition.trim());
            match truth {
                Ok(super::outcome::Worth::Truth(false)) => "else",
                _ => "then",
            }
        }
    };
    let inner = text::inner_steps(&value);
    let (_, steps) = inner.into_iter().find(|(segment, _)| *segment == branch)?;
    let first = steps.first()?.segment.clone();
    Some(text::joined(&text::joined(address, branch), &first))
}

/// The home right after the step that drew what lies under a pointer, in the turn that drew it.
fn until_picked(
    open: &Open,
    (program, example): (&Name, &Name),
    pointer: &Pointer,
) -> Result<Home, Refusal> {
    let none = || words::refuse("nothing that the program drew lies here".into());
    let all = scene::scene(&open.state, &whole(open).ok_or_else(none)?);
    let mut found = scene::nearest(all.iter(), pointer).ok_or_else(none)?;
    // along a guide what is drawn is meant, where there is such
    if !found.is_result && !found.curve.is_point() {
        let least = found.curve.distance(pointer.at) + pointer.reach * 1e-6;
        let covers = |f: &&scene::Found| {
            f.is_result && !f.curve.is_point() && f.curve.distance(pointer.at) <= least
        };
        found = all.iter().find(covers).unwrap_or(found);
    }
    until_drawn((program, example), &found.text, &text::Source::now(&open.state)).ok_or_else(none)
}

fn until_drawn(
    (program, example): (&Name, &Name),
    drawn: &str,
    source: &text::Source,
) -> Option<Home> {
    let (address, turns) = place_of(source, program, drawn)?;
    let home = home_of(source, (program, example), &address, &turns)?;
    // what a turn began with, and a turn as a whole: that turn from its beginning
    let around = turns_around(&home, &address).len();
    let value = text::step_at(source, program, &address)?.value;
    if let Some(Value::Repeat(_) | Value::While(_) | Value::For(_)) = &value
        && turns.len() > around
        && let Some((_, inner)) = value.iter().flat_map(text::inner_steps).next()
        && let Some(first) = inner.first()
    {
        let first = text::joined(&address, &first.segment);
        return home_of(source, (program, example), &first, &turns);
    }
    Some(home)
}

/// The home of all of the program that is recorded.
fn whole(open: &Open) -> Option<Home> {
    let recording = open.recording.as_ref()?;
    let (program, example) = (recording.program.clone(), recording.example.clone());
    Some(Home::Program { program, example, way: Vec::new(), before: None })
}

/// Names what the program that is recorded draws, in order, guides among it: each of its turns by itself.
pub(crate) fn drawn(open: &Open) -> Vec<String> {
    let Some(whole) = whole(open) else { return Vec::new() };
    let all = scene::scene(&open.state, &whole).into_iter();
    let mut known = BTreeSet::new();
    let figures = all.filter(|found| !found.is_place && found.side_of.is_none());
    figures.map(|found| found.text).filter(|text| known.insert(text.clone())).collect()
}

/// Returns how one of these is drawn.
pub(crate) fn drawing(open: &Open, drawn: &str) -> drawing::Drawing {
    let drawing = whole(open).map(|whole| scene::drawing_of(&open.state, &whole, drawn));
    drawing.unwrap_or_default()
}

/// The address of the step that made what a path leads to, and the turns on the way: `column[2].ring.center`.
pub(crate) fn place_of(
    source: &text::Source,
    program: &Name,
    path: &str,
) -> Option<(String, Vec<u32>)> {
    let mut turns = Vec::new();
    let mut names: Vec<String> = Vec::new();
    for part in path.split('.') {
        let (name, index) = part.split_once('[').unwrap_or((part, ""));
        names.push(name.to_string());
        turns.extend(index.trim_end_matches(']').parse::<u32>().ok());
    }
    // the longest beginning of the path that is a step
    let all = steps::addresses(source, program);
    let is_named = |address: &String, names: &[String]| {
        let own = address.split('.').filter(|s| text::is_name(s));
        own.eq(names.iter().map(String::as_str))
    };
    let fits = |n: usize| all.iter().find(|a| is_named(a, &names[..n])).cloned();
    let address = (1..=names.len()).rev().find_map(fits)?;
    Some((address, turns))
}

/// The turns that a path leads through to what is made, of the loops around a step or the step itself: of
/// `column[2].ring.center` that is 2 for `column.axis`.
pub(crate) fn turns_on_the_way(path: &str, address: &str) -> Vec<u32> {
    let names = address.split('.').filter(|s| text::is_name(s));
    let index = |(part, own): (&str, &str)| {
        let (name, index) = part.split_once('[').unwrap_or((part, ""));
        (name == own).then(|| index.trim_end_matches(']').parse::<u32>().ok())
    };
    path.split('.').zip(names).map_while(index).flatten().collect()
}

/// The turns in which a step of a thing's program is looked at, of the loops around it, with its own where it is a loop:
/// those that are visited, else those that `selected` is made in, a path.
pub(crate) fn turns_looked_at(
    home: &Home,
    (example, step): (&str, &str),
    selected: Option<&str>,
) -> Vec<u32> {
    let is_visited = matches!(home, Home::Program { example: own, .. } if *own == *example);
    let visited = if is_visited { turns_in(home, step) } else { Vec::new() };
    let made =
        |path: &str| Some(turns_on_the_way(path.strip_prefix(example)?.strip_prefix('.')?, step));
    match visited.is_empty() {
        true => selected.and_then(made).unwrap_or_default(),
        false => visited,
    }
}

/// Keeps what the example was of its own in the state before, where the program is visited and the example has got other
/// values, by whatever hand: in the text, so that it outlives the page. It is no step of its own.
pub(crate) fn keep_own(open: &mut Open, host: &dyn Host, before: &State) {
    let now = &open.state.text;
    if !is_inside(open) || own_values(open, now).is_some() {
        return;
    }
    let of = |text: &str| super::choice::example_span(open, text);
    let (Some(was), Some(is)) = (of(&before.text), of(now)) else { return };
    let own = &before.text[was];
    if *own != now[is.clone()] {
        let kept = own_values::with(now, is.start, (Meanwhile::Visit, own));
        open.read(kept, host);
    }
}

/// What a text keeps of the example's own, while it is visited by other values.
pub(crate) fn own_values(open: &Open, text: &str) -> Option<String> {
    if !own_values::is_kept(text, Meanwhile::Visit) {
        return None;
    }
    let declared = super::choice::example_span(open, text)?;
    own_values::taken(text, declared.start, Meanwhile::Visit).1
}

/// Whether something is visited: what is drawn does not go to the end of the program.
pub(crate) fn is_inside(open: &Open) -> bool {
    open.recording.as_ref().is_some_and(|recording| {
        recording.before.is_some()
            || recording.blocks.iter().any(|block| block.kind == Kind::Visited)
    })
}

/// What the program has drawn up to where it is visited.
pub(crate) fn drawn_so_far(state: &State, home: &Home) -> drawing::Drawing {
    let evaluator = state.evaluator(&state.values);
    let mut elements = Vec::new();
    for (path, names) in levels(state, home) {
        if let Some(kernel::Step::Index(turn)) = path.0.last() {
            let around = kernel::Path(path.0[..path.0.len() - 1].to_vec());
            for before in 0..*turn {
                if let Ok(answer) = evaluator.at(&around.then(kernel::Step::Index(before))) {
                    elements.extend(scene::elements_of(&evaluator, &answer));
                }
            }
        }
        add(&evaluator, (&path, &names), |as_what| as_what != Standing::Carried, &mut elements);
    }
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

/// What is no part of the drawing, and can be picked where drawing goes on: what was drawn for construction alone, and
/// the figures among the parameters.
pub(crate) fn guides(state: &State, home: &Home) -> drawing::Drawing {
    let evaluator = state.evaluator(&state.values);
    let mut elements = Vec::new();
    if let Home::Program { example, .. } = home {
        let of = |name: &Name| kernel::Path::of(&[example]).then(kernel::Step::Part(name.clone()));
        for given in scene::parameters(state, home).filter_map(|name| evaluator.at(&of(name)).ok())
        {
            elements.extend(scene::elements_of(&evaluator, &given));
        }
    }
    for (path, names) in levels(state, home) {
        add(&evaluator, (&path, &names), |as_what| as_what == Standing::Guide, &mut elements);
    }
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

/// The blocks that are open, from the program on: the path to each, and the names that are known there.
fn levels(state: &State, home: &Home) -> Vec<(kernel::Path, Vec<String>)> {
    let Home::Program { example, way, .. } = home else { return Vec::new() };
    let mut names = text::visible(&text::Source::now(state), home).into_iter();
    let mut path = kernel::Path::of(&[example]);
    let mut levels = vec![(path.clone(), names.next().unwrap_or_default())];
    for around in way {
        let Some(name) = &around.name else { continue };
        path = path.then(kernel::Step::Part(name.clone()));
        if let Some(turn) = around.turn {
            path = path.then(kernel::Step::Index(turn));
        }
        levels.push((path.clone(), names.next().unwrap_or_default()));
    }
    levels
}

fn add<'a>(
    evaluator: &Evaluator<'a>,
    (path, names): (&kernel::Path, &[String]),
    is_wanted: impl Fn(Standing) -> bool,
    into: &mut Vec<drawing::Element>,
) {
    let context = match evaluator.at(path) {
        Ok(Answer::Context(turn)) => turn,
        Ok(Answer::Thing(thing)) => match evaluator.run(thing) {
            Ok(Some(run)) => run,
            Ok(None) | Err(_) => return,
        },
        Ok(_) | Err(_) => return,
    };
    for entry in &context.made {
        if is_wanted(entry.standing) && names.iter().any(|name| **name == *entry.name) {
            into.extend(scene::elements_of(evaluator, &entry.answer));
        }
    }
}
