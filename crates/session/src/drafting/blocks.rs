//! Blocks that are open in what is recorded: loops and branches that are demonstrated, and blocks that are visited.

use super::choice::Choice;
use super::repeat::Loop;
use super::view::{OpenBlock, OpenKind, Prompt, Wants};
use super::{Around, Home, Recording, choice, own_values, recording, text};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::Name;
use eval::Answer;
use syntax::ast::Value;

/// A block that is open.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Block {
    /// Where it stands in the block around it.
    pub(crate) around: Around,
    /// What is demonstrated by it.
    pub(crate) kind: Kind,
    /// How many steps could be taken back when it was begun.
    pub(crate) since: usize,
    /// The step before which it stands in the block around it; none where it is the last.
    pub(crate) before: Option<String>,
}

/// What is demonstrated.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Kind {
    /// A loop.
    Loop(Loop),
    /// An `if`.
    Choice(Choice),
    /// Nothing: a block that is there is visited.
    Visited,
}

impl Recording {
    /// Leaves the blocks that the text no longer has.
    pub(crate) fn prune(&mut self, source: &text::Source) {
        let mut address = String::new();
        let kept = self.blocks.iter().take_while(|block| {
            address = text::joined(&address, &block.around.address);
            text::block(source, &self.program, &address).is_some()
        });
        let kept = kept.count();
        let mut address = String::new();
        for block in &mut self.blocks[..kept] {
            address = text::joined(&address, &block.around.address);
            if let Kind::Loop(it) = &mut block.kind
                && let Some((set, _)) = super::repeat::set_of(source, &self.program, &address)
            {
                it.agree(&set);
            }
        }
        if kept < self.blocks.len() {
            self.before = self.blocks.get(kept).and_then(|block| block.before.clone());
            self.blocks.truncate(kept);
        }
        let Some(before) = self.before.take() else { return };
        let home = Home::of(Some(self));
        let body = text::block(source, &self.program, &text::address_of(&home));
        let steps = body.map(|body| text::steps_of(&body)).unwrap_or_default();
        self.before = steps.iter().any(|step| step.segment == before).then_some(before);
    }

    /// Goes on where it was once steps go, by their addresses: before the next one that stays, and in blocks that are
    /// called otherwise then.
    pub(crate) fn leave_out(&mut self, source: &text::Source, gone: &[String]) {
        let mut address = String::new();
        for at in 0..=self.blocks.len() {
            let body = text::block(source, &self.program, &address);
            let steps = body.map(|body| text::steps_of(&body)).unwrap_or_default();
            let goes =
                |step: &text::StepNode| gone.contains(&text::joined(&address, &step.segment));
            let after = |segment: &str| {
                let from = steps.iter().position(|step| step.segment == segment)?;
                let stays = from + steps[from..].iter().position(|step| !goes(step))?;
                let unnamed =
                    steps[..stays].iter().filter(|s| s.name.is_none() && !goes(s)).count();
                let Some(name) = &steps[stays].name else {
                    return Some((stays > from, format!("#{unnamed}")));
                };
                Some((stays > from, name.clone()))
            };
            let Some(block) = self.blocks.get_mut(at) else {
                self.before = self.before.as_deref().and_then(after).map(|(_, next)| next);
                return;
            };
            block.before = block.before.as_deref().and_then(after).map(|(_, next)| next);
            let own = block.around.address.clone();
            let segment = block.around.segment();
            match after(segment) {
                Some((false, now)) => {
                    block.around.address = format!("{now}{}", &own[segment.len()..]);
                }
                // the block goes, too
                Some((true, _)) | None => {
                    self.before = block.before.take();
                    self.blocks.truncate(at);
                    return;
                }
            }
            address = text::joined(&address, &own);
        }
    }

    /// The steps that are demonstrated, by their addresses, each with whether that waits for an answer.
    pub(crate) fn demonstrated(&self) -> Vec<(String, bool)> {
        let mut around = String::new();
        let one = |block: &Block| {
            let step = text::joined(&around, block.around.segment());
            around = text::joined(&around, &block.around.address);
            match &block.kind {
                Kind::Loop(it) => Some((step, it.is_drawn())),
                Kind::Choice(choice) => Some((step, choice.prompt().is_some())),
                Kind::Visited => None,
            }
        };
        self.blocks.iter().filter_map(one).collect()
    }

    /// Leaves turns that are no longer come to for the last that is.
    fn keep_turns(&mut self, state: &State) {
        for at in 0..self.blocks.len() {
            let Block { around, kind: Kind::Visited, .. } = &self.blocks[at] else { continue };
            let (Some(turn), Some(name)) = (around.turn, around.name.clone()) else { continue };
            let way = self.blocks[..at].iter().map(|block| block.around.clone()).collect();
            let (program, example) = (self.program.clone(), self.example.clone());
            let outside = Home::Program { program, example, way, before: None };
            let path = outside.path().then(kernel::Step::Part(name));
            if let Ok(Answer::List(turns)) = state.evaluator(&state.values).at(&path) {
                let last = turns.len().saturating_sub(1) as u32;
                self.blocks[at].around.turn = Some(turn.min(last));
            }
        }
    }

    /// Leaves second branches of an `if` whose values are no longer those that take them for the first.
    fn keep_branches(&mut self, state: &State) {
        let source = text::Source::now(state);
        for at in 0..self.blocks.len() {
            let Block { around, kind: Kind::Choice(_), .. } = &self.blocks[at] else { continue };
            let segment = around.segment().to_string();
            let way = self.blocks[..at].iter().map(|block| block.around.clone()).collect();
            let (program, example) = (self.program.clone(), self.example.clone());
            let outside = Home::Program { program, example, way, before: None };
            let address = text::joined(&text::address_of(&outside), &segment);
            let found = text::step_at(&source, &self.program, &address).and_then(|s| s.value);
            if let (Some(Value::If(it)), Kind::Choice(choice)) = (found, &mut self.blocks[at].kind)
            {
                choice.agree(state, &outside, &it);
                self.blocks[at].around.address = format!("{segment}.{}", choice.branch());
            }
        }
    }

    /// The block that is demonstrated now.
    pub(crate) fn innermost(&self) -> Option<&Block> {
        self.blocks.last()
    }
}

/// Makes what is recorded agree with the text and the values, which undo may have changed.
pub(crate) fn settle(open: &mut Open) {
    let state = open.state.clone();
    if let Some(recording) = &mut open.recording {
        match text::program(&text::Source::now(&state), &recording.program) {
            Some(_) => {
                recording.prune(&text::Source::now(&state));
                recording.keep_turns(&state);
                recording.keep_branches(&state);
            }
            None => open.recording = None,
        }
    }
}

/// Returns what is recorded, agreeing with the text.
///
/// # Errors
/// Nothing is recorded.
pub(crate) fn recorded(open: &mut Open) -> Result<&mut Recording, Refusal> {
    settle(open);
    let none = || words::refuse("nothing is recorded: record a program first".into());
    open.recording.as_mut().ok_or_else(none)
}

/// Returns what is recorded where what a step says may be changed, or it may go. While a block is demonstrated, that holds
/// of the steps before it and in it.
///
/// # Errors
/// Nothing is recorded; the step is demonstrated, or it is asked how one goes on.
pub(crate) fn changeable<'o>(open: &'o mut Open, step: &str) -> Result<&'o mut Recording, Refusal> {
    let recording = recorded(open)?;
    for (demonstrated, is_asked) in recording.demonstrated() {
        let told = text::told(&demonstrated);
        if is_asked {
            return Err(words::refuse(format!(
                "{told} waits for an answer: give it first, or undo it"
            )));
        }
        if demonstrated == step {
            return Err(words::refuse(format!(
                "{told} is still being drawn: end it first, or undo it"
            )));
        }
    }
    Ok(recording)
}

/// Begins a block: writes it where drawing goes on, and enters it.
///
/// # Errors
/// Nothing is recorded; the text is none.
pub(crate) fn begin(
    open: &mut Open,
    host: &dyn Host,
    (lines, label): (&str, String),
    (around, kind): (Around, Kind),
) -> Result<Change, Refusal> {
    let home = Home::of(Some(recorded(open)?));
    let text = text::with_members(&text::Source::now(&open.state), &home, lines)?;
    let since = open.done.len();
    let change = recording::retext(open, host, text, label)?;
    if let Some(recording) = &mut open.recording {
        let mut before = recording.before.take();
        if around.name.is_none() {
            before = before.map(|segment| shifted(&segment));
        }
        recording.blocks.push(Block { around, kind, since, before });
    }
    open.dialogue = None;
    Ok(change)
}

/// Enters the loops and branches that are open in the text of what is recorded, from where it goes on now: a recording
/// that was broken off goes on in them.
pub(crate) fn resume(open: &mut Open) {
    let (state, since) = (open.state.clone(), open.done.len());
    let kept = choice::example_span(open, &state.text);
    let kept = kept.map(|span| own_values::before(&state.text, span.start)).unwrap_or_default();
    let of_cases = |kept: &own_values::Kept| kept.meanwhile == own_values::Meanwhile::OtherCase;
    let mut kept = kept.into_iter().filter(of_cases).map(|kept| kept.own);
    let Some(recording) = &mut open.recording else { return };
    let source = text::Source::now(&state);
    let mut address = text::address_of(&Home::of(Some(recording)));
    while let Some(body) = text::block(&source, &recording.program, &address) {
        let steps = text::steps_of(&body);
        let home = Home::of(Some(recording));
        let mut opened = |step: &text::StepNode| broken_off(&state, &home, (step, &mut kept));
        let found = steps.iter().enumerate().find_map(|(at, step)| Some((at, opened(step)?)));
        let Some((at, (around, kind))) = found else { return };
        address = text::joined(&address, &around.address);
        let before = steps.get(at + 1).map(|step| step.segment.clone());
        recording.blocks.push(Block { around, kind, since, before });
    }
}

/// What is demonstrated by a step that is open in the text; nothing where it is whole.
fn broken_off(
    state: &State,
    home: &Home,
    (step, kept): (&text::StepNode, &mut dyn Iterator<Item = String>),
) -> Option<(Around, Kind)> {
    let segment = &step.segment;
    match &step.value {
        Some(Value::Repeat(it)) => {
            let name = Name::new(step.name.as_ref()?);
            let is_open = it.times().is_none() && it.until().is_none();
            let around = Around { address: segment.clone(), name: Some(name), turn: Some(0) };
            is_open.then(|| (around, Kind::Loop(Loop::default())))
        }
        Some(Value::If(it)) => {
            let choice = Choice::broken_off(state, home, (it, kept))?;
            let address = format!("{segment}.{}", choice.branch());
            Some((Around { address, name: None, turn: None }, Kind::Choice(choice)))
        }
        Some(Value::While(_) | Value::For(_) | Value::Expr(_)) | None => None,
    }
}

/// The segment of a step without a name behind which another one came.
fn shifted(segment: &str) -> String {
    match segment.strip_prefix('#').and_then(|n| n.parse::<usize>().ok()) {
        Some(n) => format!("#{}", n + 1),
        None => segment.into(),
    }
}

/// Leaves the innermost block; what was done since it was begun is one step to undo.
pub(crate) fn leave(open: &mut Open) {
    let Some(recording) = &mut open.recording else { return };
    let Some(block) = recording.blocks.pop() else { return };
    recording.before = block.before;
    if !matches!(block.kind, Kind::Visited) {
        open.one_step(block.since);
    }
    open.dialogue = None;
}

/// The segment that a block without a name gets where drawing goes on.
pub(crate) fn next_segment(source: &text::Source, home: &Home) -> String {
    let Home::Program { program, before, .. } = home else { return "#0".into() };
    let body = text::block(source, program, &text::address_of(home));
    let steps = body.map(|body| text::steps_of(&body)).unwrap_or_default();
    let until = before.as_ref().and_then(|b| steps.iter().position(|step| step.segment == *b));
    let unnamed = steps[..until.unwrap_or(steps.len())].iter().filter(|s| s.name.is_none());
    format!("#{}", unnamed.count())
}

/// Returns a name for a block, or whatever else, that its program does not use; `wanted` where that is free.
///
/// # Errors
/// What is wanted is no name, or taken.
pub(crate) fn name_for(
    source: &text::Source,
    program: &Name,
    (wanted, usual): (&str, &str),
) -> Result<Name, Refusal> {
    let taken = text::words_in(source, program);
    let wanted = wanted.trim();
    if wanted.is_empty() {
        let names = std::iter::once(usual.to_string()).chain((2..).map(|i| format!("{usual}{i}")));
        return Ok(Name::new(&{ names }.find(|n| !taken.contains(n)).unwrap_or_default()));
    }
    let starts_well = wanted.chars().next().is_some_and(char::is_alphabetic);
    if !starts_well || !wanted.chars().all(|c| c.is_alphanumeric() || c == '_') {
        return Err(words::refuse(format!("`{wanted}` is no name: a word without spaces is")));
    }
    if taken.contains(wanted) {
        return Err(words::refuse(format!("{wanted} stands for something else in {program}")));
    }
    Ok(Name::new(wanted))
}

/// Lists the blocks that are open.
pub(crate) fn view(source: &text::Source, recording: &Recording) -> Vec<OpenBlock> {
    let mut address = String::new();
    let one = |block: &Block| {
        address = text::joined(&address, &block.around.address);
        let name = block.around.name.as_ref().map_or("", Name::as_str);
        let set = super::repeat::set_of(source, &recording.program, &address);
        let set = set.map(|(set, _)| set).unwrap_or_default();
        let (kind, words) = match &block.kind {
            Kind::Loop(it) if it.is_drawn() => {
                (OpenKind::Asking, format!("{name}: what the second turn does"))
            }
            Kind::Loop(it) if it.element().is_some() => {
                let first = set.first().map_or("the first", String::as_str);
                let words = format!("{name}: draw what is done for {first}, the first of the set");
                (OpenKind::Each, words)
            }
            Kind::Loop(_) => (OpenKind::Turn, format!("{name}: draw its first turn")),
            Kind::Choice(choice) => choice.view(),
            Kind::Visited => (OpenKind::Visited, format!("visiting {}", text::told(&address))),
        };
        let caught = match &block.kind {
            Kind::Loop(it) => it.caught(),
            Kind::Choice(_) | Kind::Visited => &[],
        };
        let set = caught.iter().map(|name| (name.clone(), set.contains(name))).collect();
        OpenBlock { address: address.clone(), words, kind, set }
    };
    let replaced = recording.replaces.as_ref().map(|step| OpenBlock {
        address: step.clone(),
        words: format!("what you draw next takes the place of {}", text::told(step)),
        kind: OpenKind::Visited,
        set: Vec::new(),
    });
    recording.blocks.iter().map(one).chain(replaced).collect()
}

/// What was caught for the set that the open loop goes over, as long as that may be changed; nothing else.
pub(crate) fn caught(open: &Open) -> &[String] {
    match open.recording.as_ref().and_then(Recording::innermost).map(|block| &block.kind) {
        Some(Kind::Loop(it)) => it.caught(),
        Some(Kind::Choice(_) | Kind::Visited) | None => &[],
    }
}

/// What of it is in the set.
pub(crate) fn taken(open: &Open) -> Vec<String> {
    let source = text::Source::now(&open.state);
    let blocks = open.recording.as_ref().map(|recording| view(&source, recording));
    let innermost = blocks.and_then(|mut blocks| blocks.pop());
    let set = innermost.map(|block| block.set).unwrap_or_default();
    set.into_iter().filter(|(_, is_in)| *is_in).map(|(name, _)| name).collect()
}

/// What is waited for, where no construction is.
pub(crate) fn prompt(open: &Open) -> Option<Prompt> {
    let recording = open.recording.as_ref()?;
    if recording.asks_condition {
        return Some(Prompt {
            label: "If".into(),
            words: "when is the branch taken that you draw next? Type it, or use the calculator"
                .into(),
            is_value: true,
            wants: Wants::Condition,
            ..Prompt::default()
        });
    }
    match &recording.innermost()?.kind {
        Kind::Loop(it) => it.prompt(),
        Kind::Choice(choice) => choice.prompt(),
        Kind::Visited => None,
    }
}
