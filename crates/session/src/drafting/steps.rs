//! The steps of a program in words, with what each made in its example; and steps deleted and said anew.

use super::catalogue::{self, Pattern};
use super::scene::{Curve, elements_of};
use super::text::StepNode;
use super::view::{ParameterRow, StepRow, StepsView};
use super::{Home, blocks, compound, parameters, text, visit};
use crate::document::Open;
use crate::doubts;
use crate::offers::words_of;
use crate::state::State;
use crate::view::Refusal;
use crate::views::answers;
use crate::words;
use eval::{Answer, Evaluator};
use kernel::program::Program;
use kernel::{DOCUMENT, Path, Values};
use syntax::ast::{AstNode, Expr, Member, Value};

/// Returns the steps of what is recorded, or of the program of a thing.
pub(crate) fn view(open: &Open, home: &Home, thing: Option<&str>) -> Option<StepsView> {
    let found = Found::of(open, home, thing)?;
    let evaluator = open.state.evaluator(open.values());
    let blocks = open.recording.as_ref().map_or(&[][..], |recording| &recording.blocks);
    let visited = blocks.iter().take_while(|block| block.kind == blocks::Kind::Visited);
    // what is demonstrated there is no turn that one looks at
    let mut around = home.clone();
    if let Home::Program { way, .. } = &mut around {
        way.truncate(visited.count());
    }
    let selected = thing.and_then(|thing| thing.strip_prefix(&found.example)?.strip_prefix('.'));
    let rows = found.rows(&open.state, (&around, selected), &evaluator);
    let selected = thing.and_then(|thing| row_of(&rows, &found.path, thing));
    Some(StepsView { rows, selected, ..found.head(open, home, &evaluator) })
}

/// Finds the step that drew something, by its path through the thing that shows the program: of two branches that make
/// it, the one that did.
fn row_of(rows: &[StepRow], shown: &Path, drawn: &str) -> Option<String> {
    let path = crate::session::parse_path(drawn)?;
    let names: Vec<&str> = { path.0.strip_prefix(&shown.0[..])?.iter() }
        .filter_map(|step| match step {
            kernel::Step::Part(name) => Some(name.as_str()),
            kernel::Step::Index(_) | kernel::Step::Last | kernel::Step::Owner => None,
        })
        .collect();
    let found = rows.iter().filter_map(|row| {
        let made: Vec<&str> = row.path.split('.').filter(|s| text::is_name(s)).collect();
        let is_of = !row.name.is_empty() && names.starts_with(&made);
        is_of.then_some(((made.len(), !row.is_unmade), row))
    });
    found.max_by_key(|(rank, _)| *rank).map(|(_, row)| row.path.clone())
}

/// Returns the same without the steps.
pub(crate) fn head(open: &Open, home: &Home, thing: Option<&str>) -> Option<StepsView> {
    let found = Found::of(open, home, thing)?;
    Some(found.head(open, home, &open.state.evaluator(open.values())))
}

/// A program whose steps are shown, and where it is written.
struct Found<'s> {
    program: &'s Program,
    name: base::Name,
    example: String,
    path: Path,
    /// Its text, its body, and the file that they stand in; nothing where it is of no text.
    written: Option<(text::Source, syntax::ast::Body, String)>,
}

impl<'s> Found<'s> {
    fn of(open: &'s Open, home: &Home, thing: Option<&str>) -> Option<Self> {
        let state = &open.state;
        let example = match (home, thing) {
            (Home::Program { example, .. }, _) => example.to_string(),
            (Home::Document, Some(thing)) => thing.to_string(),
            (Home::Document, None) => return None,
        };
        let (path, program, name) = drawn_by(state, &example)?;
        let example = path.to_string();
        // a program of a library is shown as well
        let own = text::Source::now(state);
        let others =
            state.lowered.files.iter().skip(1).map(|(_, file)| text::Source::of_file(file));
        let names = state.lowered.files.iter().map(|(_, file)| file.name.as_str());
        let written = std::iter::once(own).chain(others).zip(names).find_map(|(source, user)| {
            let body = text::program(&source, &name)?.body()?;
            Some((source, body, user.to_string()))
        });
        Some(Self { program, name, example, path, written })
    }

    fn rows<'a>(
        &self,
        state: &'a State,
        (home, selected): (&Home, Option<&str>),
        evaluator: &Evaluator<'a>,
    ) -> Vec<StepRow> {
        let Some((source, body, _)) = &self.written else { return Vec::new() };
        let (program, example) = (self.name.clone(), self.example.as_str().into());
        let drawn = Drawn { source, program, example };
        let thing = state.structure.follow(DOCUMENT, &self.path).ok();
        let run = thing.and_then(|thing| evaluator.run(thing).ok()?);
        let ended = run.and_then(|run| run.ended.clone());
        let looked_at = (home, selected);
        let mut rows = Rows { state, evaluator, drawn, looked_at, ended, rows: Vec::new() };
        rows.block(&text::steps_of(body), ("", true), (&self.path, &[]), 0);
        rows.rows
    }

    fn head<'a>(&self, open: &'a Open, home: &Home, evaluator: &Evaluator<'a>) -> StepsView {
        let state = &open.state;
        let declared = self.written.as_ref();
        let declared = declared.map(|(source, ..)| parameters::declared(source, &self.name));
        let declared = declared.unwrap_or_default();
        let user = self.written.as_ref().map_or("", |(.., user)| user.as_str());
        let parameter = |asked: &kernel::program::Asked| {
            let said = declared.iter().find(|said| *said.name == *asked.name);
            let of = |get: fn(&parameters::Declared) -> &String| {
                said.map_or_else(String::new, |said| get(said).clone())
            };
            let value = evaluator.at(&self.path.then(kernel::Step::Part(asked.name.clone())));
            ParameterRow {
                class: of(|said| &said.class),
                range: of(|said| &said.range),
                choices: said
                    .map_or_else(Vec::new, |said| parameters::table_of(state, (user, said))),
                example: of(|said| &said.example),
                name: asked.name.to_string(),
                prompt: asked.prompt.clone(),
                value: value.map_or_else(
                    |fault| fault.message,
                    |value| value_words(state, evaluator, &value),
                ),
            }
        };
        let recording = open.recording.as_ref().filter(|_| *home != Home::Document);
        let source = text::Source::now(state);
        StepsView {
            program: self.name.to_string(),
            is_recorded: recording.is_some(),
            parameters: self.program.parameters.iter().map(parameter).collect(),
            has_steps: { self.written.as_ref() }
                .is_some_and(|(_, body, _)| !text::steps_of(body).is_empty()),
            rows: Vec::new(),
            selected: None,
            open: recording.map(|it| blocks::view(&source, it)).unwrap_or_default(),
            at: recording.filter(|_| visit::is_inside(open)).map(|recording| {
                let before = recording.before.clone().unwrap_or_default();
                text::joined(&text::address_of(home), &before)
            }),
            by_others: recording.is_some() && {
                let own = visit::own_values(open, &state.text);
                own.is_some() && own != super::choice::example_text(open)
            },
            example: self.example.clone(),
        }
    }
}

/// Returns the name of the program that draws a thing of a document.
pub(crate) fn program_of(state: &State, thing: &str) -> Option<base::Name> {
    program_at(state, &crate::session::parse_path(thing)?).map(|(_, name)| name)
}

/// Returns the program of the thing that a path leads to, with its name.
fn program_at<'s>(state: &'s State, path: &Path) -> Option<(&'s Program, base::Name)> {
    let document = &state.lowered.document;
    let thing = state.structure.follow(DOCUMENT, path).ok()?;
    let line = document.primary_line(state.structure.things[thing].class);
    let class = line.into_iter().find(|&c| document.classes[c].program.is_some())?;
    Some((document.program(class)?, document.classes[class].name.clone()))
}

/// Returns the innermost thing on the way to something that a program draws, with the program and its name.
fn drawn_by<'s>(state: &'s State, drawn: &str) -> Option<(Path, &'s Program, base::Name)> {
    let way = crate::session::parse_path(drawn)?.0;
    let ways = (1..=way.len()).rev().map(|n| Path(way[..n].to_vec()));
    ways.filter_map(|path| program_at(state, &path).map(|(p, name)| (path, p, name))).next()
}

/// A program and the thing that shows what it draws.
struct Drawn<'s> {
    source: &'s text::Source,
    program: base::Name,
    example: base::Name,
}

impl Drawn<'_> {
    /// Whether a branch is the one that is taken, by its address, in some turns of the loops around it.
    fn is_taken(&self, state: &State, branch: &str, turns: &[u32]) -> bool {
        let Some((choice, side)) = branch.rsplit_once('.') else { return true };
        let step = text::step_at(self.source, &self.program, choice).and_then(|step| step.value);
        let Some(Value::If(written)) = step else { return true };
        let home = visit::home_of(self.source, (&self.program, &self.example), choice, turns);
        let Some((home, condition)) = home.zip(written.condition()) else { return true };
        match super::outcome::worth(state, &home, condition.syntax().text().to_string().trim()) {
            Ok(super::outcome::Worth::Truth(truth)) => truth == (side == "then"),
            Ok(_) | Err(_) => true,
        }
    }

    /// Whether a step is come to, by its address, in some turns of the loops around it.
    fn is_come_to(&self, state: &State, address: &str, turns: &[u32]) -> bool {
        let ends = address.match_indices('.').map(|(at, _)| &address[..at]);
        let mut branches = ends.filter(|way| way.ends_with(".then") || way.ends_with(".else"));
        branches.all(|branch| self.is_taken(state, branch, turns))
    }
}

/// Says which turn of a loop its rows tell of.
fn turn_in_words(turn: u32, of: usize) -> String {
    match (turn as usize) < of {
        true => format!("turn {} of {of}", turn + 1),
        false => format!("turn {} is not come to: there are {of}", turn + 1),
    }
}

struct Rows<'e, 'a> {
    state: &'a State,
    evaluator: &'e Evaluator<'a>,
    drawn: Drawn<'e>,
    /// Where the program is visited, if it is, and the path to what is selected of what it made.
    looked_at: (&'e Home, Option<&'e str>),
    /// Where and why the drawing of the example ended early, if it did.
    ended: Option<eval::Ended>,
    rows: Vec<StepRow>,
}

impl<'a> Rows<'_, 'a> {
    /// Why the step of an address has no outcome, if the drawing ended there.
    fn why(&self, address: &str) -> Option<String> {
        let ended = self.ended.as_ref().filter(|ended| ended.why != eval::Why::Outside)?;
        let plain = |segment: &str| segment.split('[').next().unwrap_or_default().to_string();
        let step = ended.step.split('.').map(plain);
        step.eq(address.split('.').filter(|s| text::is_name(s)).map(String::from))
            .then(|| ended.to_string())
    }

    /// The turn that is looked at of a loop with so many loops around it, by its address.
    fn turn_of(&self, (address, around): (&str, usize)) -> Option<u32> {
        let (home, selected) = self.looked_at;
        let made = || visit::turns_on_the_way(selected?, address).get(around).copied();
        visit::turn_of(home, address).or_else(made)
    }

    /// Lists the steps of a block: its address, and whether it is come to. `made` leads to what it made in the example,
    /// in such turns of the loops around it: those that are visited, else those that made what is selected, else the first.
    fn block(
        &mut self,
        steps: &[StepNode],
        (way, is_come_to): (&str, bool),
        (made, turns): (&Path, &[u32]),
        depth: usize,
    ) {
        for step in steps {
            let address = text::joined(way, &step.segment);
            let made = match &step.name {
                Some(name) => made.then(kernel::Step::Part(name.as_str().into())),
                None => made.clone(),
            };
            // the other branch may have made something of that name
            let is_made = is_come_to && step.name.is_some();
            let answer = is_made.then(|| self.evaluator.at(&made).ok()).flatten();
            let is_failed = step.name.is_some() && answer.is_none();
            let turn = self.turn_of((&address, turns.len()));
            let formula = self.formula(step);
            self.rows.push(StepRow {
                path: address.clone(),
                name: step.name.clone().unwrap_or_default(),
                depth,
                words: match &step.value {
                    Some(Value::Expr(value)) => pattern_in_words(value),
                    _ => None,
                }
                .unwrap_or_else(|| in_words(step, &formula)),
                formula,
                doubt: answer.as_ref().and_then(|answer| {
                    doubts::of(&self.state.lowered.document, self.evaluator, answer)
                }),
                value: answer.map(|answer| match (&answer, turn) {
                    (Answer::List(turns), Some(turn)) => turn_in_words(turn, turns.len()),
                    // an empty list does not tell what it is of
                    (Answer::List(items), None)
                        if items.is_empty() && matches!(step.value, Some(Value::Expr(_))) =>
                    {
                        counted(0, "figure")
                    }
                    _ => value_words(self.state, self.evaluator, &answer),
                }),
                is_guide: step.is_guide,
                is_block: !matches!(step.value, Some(Value::Expr(_)) | None),
                is_unmade: is_failed,
                why: self.why(&address),
            });
            let Some(value) = &step.value else { continue };
            let is_loop = matches!(value, Value::Repeat(_) | Value::While(_) | Value::For(_));
            let turn = is_loop.then(|| turn.unwrap_or(0));
            let made = turn.map_or(made.clone(), |turn| made.then(kernel::Step::Index(turn)));
            let turns: Vec<u32> = turns.iter().copied().chain(turn).collect();
            for (segment, steps) in text::inner_steps(value) {
                if segment == "else" {
                    self.rows.push(StepRow {
                        path: text::joined(&address, "else"),
                        depth,
                        words: "otherwise".into(),
                        is_block: true,
                        ..StepRow::default()
                    });
                }
                let inner = text::joined(&address, segment);
                let is_branch = matches!(value, Value::If(_));
                let is_come_to =
                    is_come_to && (!is_branch || self.drawn.is_taken(self.state, &inner, &turns));
                self.block(&steps, (&inner, is_come_to), (&made, &turns), depth + 1);
            }
        }
    }

    /// What the text says of a step, in one line: of a block what stands before and after its steps.
    fn formula(&self, step: &StepNode) -> String {
        let source: &str = self.drawn.source;
        let of = |span: base::Span| &source[span.start as usize..span.end as usize];
        let Some(value) = &step.value else { return of(step.span).trim().into() };
        let whole = of(value.span());
        match value {
            Value::Expr(_) => whole.split_whitespace().collect::<Vec<_>>().join(" "),
            Value::If(choice) => {
                choice.condition().map_or(String::new(), |c| format!("if {}", of(c.span()).trim()))
            }
            Value::Repeat(_) | Value::While(_) | Value::For(_) => {
                let head = whole.split('{').next().unwrap_or_default().trim();
                let tail = whole.rsplit('}').next().unwrap_or_default().trim();
                format!("{head} {tail}").trim().to_string()
            }
        }
    }
}

/// Says a pattern as a draughtsman does: `polar pattern: hole, about rim.center, count 6`.
pub(super) fn pattern_in_words(formula: &Expr) -> Option<String> {
    let catalogue::Written { pattern, parts, .. } = catalogue::pattern_of(formula)?;
    let of = |slot: &str| {
        let part = parts.iter().find(|(name, _)| *name == slot);
        let said = part?.1.syntax().text().to_string().trim().to_string();
        Some(as_typed(&said, "").unwrap_or(said))
    };
    let (what, count) = (of("what")?, of("count")?);
    Some(match pattern {
        Pattern::Polar => format!("polar pattern: {what}, about {}, count {count}", of("about")?),
        Pattern::Row => format!("pattern in a row: {what}, by {}, count {count}", of("by")?),
    })
}

/// Says a formula as a draughtsman does: `circle tangent: -under, axis, radius r`; one that is no construction as it is
/// written.
fn in_words(step: &StepNode, formula: &str) -> String {
    let Some(Value::Expr(value)) = &step.value else { return formula.into() };
    let said = |node: &syntax::SyntaxNode| {
        node.text().to_string().split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let is_class = |text: &str| text.starts_with(char::is_uppercase);
    let (head, list) = match value {
        Expr::Call(call) => {
            let name = call.name().map(|word| word.text().to_string()).filter(|n| is_class(n));
            (name.map(|name| words_of(&name)), call.args())
        }
        Expr::Field(field) => {
            let head = || {
                let (of, word) = (said(field.receiver()?.syntax()), field.name()?);
                let word = word.text();
                Some(match field.receiver()? {
                    Expr::Name(_) if is_class(&of) => format!("{} {word}", words_of(&of)),
                    Expr::List(_) => format!("{word} of {}", of[1..of.len() - 1].trim()),
                    Expr::Name(_) | Expr::Field(_) | Expr::Index(_) => format!("{word} of {of}"),
                    _ => return None,
                })
            };
            (head(), field.args())
        }
        _ => (None, None),
    };
    let (Some(head), Some(list)) = (head, list) else { return formula.into() };
    let mut before = String::new();
    let argument = |argument: syntax::ast::Arg| {
        let value = argument.value()?;
        let mut word = |value: &Expr| {
            let value = said(value.syntax());
            let typed = as_typed(&value, &before).unwrap_or_else(|| value.clone());
            before = value;
            typed
        };
        let typed = match &value {
            Expr::List(list) => list.elements().map(|e| word(&e)).collect::<Vec<_>>().join(", "),
            one => word(one),
        };
        Some(match argument.label() {
            Some(label) => format!("{} {typed}", label.text()),
            None => typed,
        })
    };
    let arguments: Vec<String> = list.args().filter_map(argument).collect();
    format!("{head}: {}", arguments.join(", "))
}

/// Says a place as it is typed: `(3, 4)`, and from another one `corner @(w, h)`; from the operand before it `@(w, h)`.
pub(super) fn as_typed(place: &str, before: &str) -> Option<String> {
    let (x, y) = super::typed::coordinates(place)?;
    let way = |at: &str, axis: &str| -> Option<(String, String)> {
        let (from, rest) = at.split_once(axis)?;
        let step = match rest.split_at_checked(3) {
            None if rest.is_empty() => "0".into(),
            Some((" + ", step)) => catalogue::unbracketed(step),
            Some((" - ", step)) => format!("-{step}"),
            _ => return None,
        };
        from.chars().all(text::is_of_path).then(|| (from.to_string(), step))
    };
    match (way(x, ".x"), way(y, ".y")) {
        (Some((from, right)), Some((base, up))) if from == base => {
            let from = if from == before { String::new() } else { format!("{from} ") };
            Some(format!("{from}@({right}, {up})"))
        }
        _ => Some(format!("({x}, {y})")),
    }
}

/// So many of something, in words.
fn counted(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn value_words<'a>(state: &'a State, evaluator: &Evaluator<'a>, answer: &Answer<'a>) -> String {
    let at =
        |place: &str| Some(Curve::of(evaluator, &evaluator.of_part(answer, place).ok()?)?.words());
    let is_box = |class| compound::of(&state.lowered.document, class).is_some_and(|c| c.has("far"));
    if evaluator.class_of(answer).is_some_and(is_box)
        && let Some((corner, far)) = at("corner").zip(at("far"))
    {
        return format!("{corner} to {far}");
    }
    if let Some(curve) = Curve::of(evaluator, answer) {
        return curve.words();
    }
    if let Some(places) = places_of(state, evaluator, answer) {
        return counted(places, "place");
    }
    let document = &state.lowered.document;
    let area = || {
        let area = evaluator.of_part(answer, "area").ok();
        area.and_then(|area| answers::in_words(document, &area)).unwrap_or_default()
    };
    let outlined = document.class_named("Outlined").zip(evaluator.class_of(answer));
    let is_outlined = outlined.is_some_and(|(outlined, class)| document.is_a(class, outlined));
    match answer {
        Answer::Number(..) => answers::in_words(document, answer).unwrap_or_default(),
        Answer::List(items) => match items.iter().all(|item| matches!(item, Answer::Context(_))) {
            true => counted(items.len(), "turn"),
            false => counted(items.len(), "figure"),
        },
        Answer::Context(context) => counted(context.result().count(), "figure"),
        other => match evaluator.outline_of(other).map_or(0, |edges| edges.len()) {
            0 if is_outlined => format!("area {}", area()),
            0 => evaluator.in_words(other),
            edges => format!("{}, area {}", counted(edges, "edge"), area()),
        },
    }
}

/// Through how many places something is drawn, where it is.
fn places_of<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    answer: &Answer<'a>,
) -> Option<usize> {
    let document = &state.lowered.document;
    let class = evaluator.class_of(answer).filter(|&c| compound::is_of_places(document, c))?;
    let part = document.field_name(*document.layout(class).first()?);
    match evaluator.of_part(answer, part).ok()? {
        Answer::List(places) => Some(places.len()),
        _ => None,
    }
}

/// Returns what a path leads to, in words.
pub(crate) fn comes_to(state: &State, values: &Values, path: &str) -> Option<String> {
    let evaluator = state.evaluator(values);
    let answer = evaluator.at(&crate::session::parse_path(path)?).ok()?;
    Some(value_words(state, &evaluator, &answer))
}

/// Returns what a step drew; of a block all of its turns.
pub(crate) fn drawing(
    state: &State,
    values: &Values,
    example: &str,
    step: &str,
) -> drawing::Drawing {
    let evaluator = state.evaluator(values);
    let source = text::Source::now(state);
    let program = program_of(state, example).unwrap_or_else(|| "".into());
    let drawn = Drawn { source: &source, program, example: example.into() };
    let mut elements = Vec::new();
    let names: Vec<&str> = step.split('.').filter(|s| text::is_name(s)).collect();
    let start = crate::session::parse_path(example).unwrap_or_default();
    let is_come_to = |turns: &[u32]| drawn.is_come_to(state, step, turns);
    collect(&evaluator, (&start, &names), &is_come_to, &mut Vec::new(), &mut elements);
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

fn collect(
    evaluator: &Evaluator<'_>,
    (at, names): (&Path, &[&str]),
    is_come_to: &dyn Fn(&[u32]) -> bool,
    turns: &mut Vec<u32>,
    into: &mut Vec<drawing::Element>,
) {
    let Some((name, rest)) = names.split_first() else {
        if let Ok(answer) = evaluator.at(at)
            && is_come_to(turns)
        {
            into.extend(elements_of(evaluator, &answer));
        }
        return;
    };
    let next = at.then(kernel::Step::Part((*name).into()));
    match evaluator.at(&next) {
        Ok(Answer::List(items)) if !rest.is_empty() => {
            for turn in 0..items.len() as u32 {
                turns.push(turn);
                let one = next.then(kernel::Step::Index(turn));
                collect(evaluator, (&one, rest), is_come_to, turns, into);
                turns.pop();
            }
        }
        Ok(_) => collect(evaluator, (&next, rest), is_come_to, turns, into),
        Err(_) => {}
    }
}

/// Returns the steps that speak of one, or of one that does, in order: what goes when it is deleted.
pub(crate) fn dependents(source: &text::Source, program: &str, address: &str) -> Vec<String> {
    let mut gone = vec![address.to_string()];
    let mut found: Vec<String> = Vec::new();
    let mut at = 0;
    while let Some(next) = gone.get(at).cloned() {
        at += 1;
        for user in users(source, program, &next) {
            let is_inside = gone.iter().any(|g| user.starts_with(&format!("{g}.")) || *g == user);
            if !is_inside {
                gone.push(user.clone());
                found.push(user);
            }
        }
    }
    let order = addresses(source, program);
    found.sort_by_key(|user| order.iter().position(|a| a == user));
    found
}

/// Lists the addresses of all steps of a program, in the order of its text.
pub(crate) fn addresses(source: &text::Source, program: &str) -> Vec<String> {
    fn list(steps: &[StepNode], way: &str, into: &mut Vec<String>) {
        for step in steps {
            let address = text::joined(way, &step.segment);
            into.push(address.clone());
            for (segment, steps) in step.value.iter().flat_map(text::inner_steps) {
                list(&steps, &text::joined(&address, segment), into);
            }
        }
    }
    let mut all = Vec::new();
    if let Some(body) = text::block(source, program, "") {
        list(&text::steps_of(&body), "", &mut all);
    }
    all
}

/// Returns the steps that speak of what another makes, itself and what is in it apart.
pub(crate) fn users(source: &text::Source, program: &str, address: &str) -> Vec<String> {
    let Some(step) = text::step_at(source, program, address) else { return Vec::new() };
    let Some(body) = text::block(source, program, "") else { return Vec::new() };
    let names = text::names_made(std::slice::from_ref(&step));
    // the named blocks around it, by which it is reached from outside
    let mut reached: Vec<Vec<String>> = names.iter().map(|name| vec![name.clone()]).collect();
    let around: Vec<&str> = address.split('.').collect();
    let named = around[..around.len() - 1].iter().rev();
    let named = named.filter(|s| text::is_name(s));
    for outer in named {
        let longer: Vec<Vec<String>> = reached
            .iter()
            .map(|way| std::iter::once((*outer).to_string()).chain(way.clone()).collect())
            .collect();
        reached.extend(longer);
    }
    let mut found = Vec::new();
    let search = Search { source, own: address, reached: &reached };
    search.steps(&text::steps_of(&body), "", &mut found);
    found
}

struct Search<'s> {
    source: &'s str,
    own: &'s str,
    /// The ways to what is looked for: its name, or those of named blocks around it and its own.
    reached: &'s [Vec<String>],
}

impl Search<'_> {
    fn steps(&self, steps: &[StepNode], way: &str, into: &mut Vec<String>) {
        for step in steps {
            let address = text::joined(way, &step.segment);
            if address == self.own {
                continue;
            }
            let Some(value) = &step.value else {
                let span = step.span;
                let says = &self.source[span.start as usize..span.end as usize];
                if self.is_spoken_of(says) {
                    into.push(address);
                }
                continue;
            };
            let says = self.outside_of_steps(value);
            if says.iter().any(|says| self.is_spoken_of(says)) {
                into.push(address.clone());
            }
            for (segment, steps) in text::inner_steps(value) {
                self.steps(&steps, &text::joined(&address, segment), into);
            }
        }
    }

    /// What a step says besides the steps in it.
    fn outside_of_steps(&self, value: &Value) -> Vec<String> {
        let of = |span: base::Span| self.source[span.start as usize..span.end as usize].to_string();
        let whole = value.span();
        let bodies: Vec<base::Span> = match value {
            Value::Expr(_) => Vec::new(),
            Value::Repeat(it) => it.body().iter().map(AstNode::span).collect(),
            Value::While(it) => it.body().iter().map(AstNode::span).collect(),
            Value::For(it) => it.body().iter().map(AstNode::span).collect(),
            Value::If(it) => return it.condition().iter().map(|c| of(c.span())).collect(),
        };
        let Some(body) = bodies.first() else { return vec![of(whole)] };
        let before = base::Span { start: whole.start, end: body.start };
        let after = base::Span { start: body.end, end: whole.end };
        let mut all = vec![of(before), of(after)];
        let members = match value {
            Value::Repeat(it) => it.body(),
            Value::While(it) => it.body(),
            Value::For(it) => it.body(),
            Value::Expr(_) | Value::If(_) => None,
        };
        for member in members.into_iter().flat_map(|body| body.members()) {
            if let Member::Next(next) = member {
                all.push(next.syntax().text().to_string());
            }
        }
        all
    }

    fn is_spoken_of(&self, says: &str) -> bool {
        self.reached.iter().any(|way| {
            let Some((first, rest)) = way.split_first() else { return false };
            text::places_of(says, first).iter().any(|&at| {
                let chain = &says[at..];
                let chain = &chain[..chain.find(|c| !text::is_of_path(c)).unwrap_or(chain.len())];
                let mut parts = chain.split(['.', '[', ']']).skip(1);
                rest.iter().all(|wanted| parts.any(|part| part == wanted))
            })
        })
    }
}

/// Returns a text without some steps of a program.
///
/// # Errors
/// There is no such step.
pub(crate) fn without(
    source: &text::Source,
    program: &str,
    addresses: &[String],
) -> Result<String, Refusal> {
    let mut spans = Vec::new();
    for address in addresses {
        let none = || words::refuse(format!("{program} has no step {address}"));
        spans.push(text::step_at(source, program, address).ok_or_else(none)?.span);
    }
    spans.sort_by_key(|span| std::cmp::Reverse(span.start));
    let mut edited = source.to_string();
    // from the last, so that what is before keeps its place; what is in one that goes, goes with it
    let mut last: Option<usize> = None;
    for span in spans.iter().filter(|s| {
        !spans
            .iter()
            .any(|o| o.start <= s.start && s.end <= o.end && (o.start, o.end) != (s.start, s.end))
    }) {
        let (mut start, mut end) = (span.start as usize, span.end as usize);
        if last == Some(start) {
            continue;
        }
        last = Some(start);
        start = source[..start].rfind('\n').map_or(start, |i| i + 1);
        end += source[end..].find('\n').map_or(0, |i| i + 1);
        edited.replace_range(start..end, "");
    }
    Ok(edited)
}

/// Returns a text in which a step is drawn for construction alone, or is part of the result.
///
/// # Errors
/// There is no such step, or it has no name.
pub(crate) fn with_guide(
    source: &text::Source,
    (program, address): (&str, &str),
    is_guide: bool,
) -> Result<String, Refusal> {
    let none = || words::refuse(format!("{program} has no step {address} of its own name"));
    let step = text::step_at(source, program, address).filter(|step| step.name.is_some());
    let step = step.ok_or_else(none)?;
    let (before, rest) = source.split_at(step.span.start as usize);
    let plain = match rest.strip_prefix("guide") {
        Some(plain) if step.is_guide => plain.trim_start(),
        _ => rest,
    };
    Ok(format!("{before}{}{plain}", if is_guide { "guide " } else { "" }))
}

/// Returns a text in which a step says something else.
///
/// # Errors
/// There is no such step, or nothing is said.
pub(crate) fn with_formula(
    source: &text::Source,
    (program, address): (&str, &str),
    formula: &str,
) -> Result<String, Refusal> {
    let none = || words::refuse(format!("{program} has no step {address}"));
    let (_, span) = text::step(source, program, address).ok_or_else(none)?;
    let formula = formula.trim();
    if formula.is_empty() {
        return Err(words::refuse(format!("type what {address} shall do")));
    }
    let (start, end) = (span.start as usize, span.end as usize);
    Ok(format!("{}{formula}{}", &source[..start], &source[end..]))
}
