//! Drafting at the boundary: what the page asks of a session.

use super::catalogue::{Call, SlotKind, Tool};
use super::dialogue::{self, Dialogue, Goal, Operand};
use super::view::{
    Computed, ConstructionRow, Ends, Hover, MeasureKind, OlderUse, Prompt, Turn, Wants,
};
use super::{
    Home, becoming, blocks, catalogue, changing, choice, edges, measure, older, outcome, patterns,
    recording, remove, repeat, scene, steps, text, typed,
};
use crate::document::Open;
use crate::host::Host;
use crate::session::Session;
use crate::state::State;
use crate::view::{Change, DocumentId, Pointer, Refusal};
use crate::words;
use kernel::Command;

/// Where an open document's drawing goes.
pub(crate) fn home(open: &Open) -> Home {
    match &open.recording {
        None => Home::Document,
        Some(recording) => {
            let mut recording = recording.clone();
            recording.prune(&text::Source::now(&open.state));
            Home::of(Some(&recording))
        }
    }
}

/// What is waited for.
pub(super) fn prompt(open: &Open) -> Option<Prompt> {
    let removing = open.recording.as_ref().and_then(|recording| recording.removing.as_ref());
    let changing = open.recording.as_ref().and_then(|recording| recording.changing.as_ref());
    let prompt = match (removing, changing, &open.dialogue) {
        (Some(removing), _, _) => removing.prompt(),
        (None, Some(changing), _) => Some(changing.prompt()),
        (None, None, Some(dialogue)) => Some(dialogue.prompt()),
        (None, None, None) => blocks::prompt(open),
    };
    if let Some(older) = &open.picking.older {
        return Some(older.prompt(prompt.unwrap_or_default()));
    }
    match &open.picking.measure {
        Some(measuring) => Some(Prompt {
            words: measuring.words().into(),
            is_value: true,
            ..prompt.unwrap_or_default()
        }),
        None => prompt,
    }
}

/// Gives edges that were picked, once they are a contour; until then more are wanted.
fn give_edges(
    open: &mut Open,
    host: &dyn Host,
    (edges, at): (Vec<String>, Option<(f64, f64)>),
) -> Result<Turn, Refusal> {
    let none = || words::refuse("no construction waits".into());
    let (state, home) = (open.state.clone(), home(open));
    let are_places = { open.dialogue.as_ref().and_then(Dialogue::slot) }
        .is_some_and(|slot| slot.kind == SlotKind::Places);
    let text = match are_places {
        true => dialogue::listed(edges.iter().map(String::as_str)),
        false => edges::written(&state, &home, &edges),
    };
    let operand = Operand::new(text, at);
    let before = open.dialogue.clone();
    give(open, host, operand).or_else(|refused| {
        open.dialogue = before;
        let dialogue = open.dialogue.as_mut().ok_or_else(none)?;
        if dialogue.edges == edges || !edges::waits(&state, &home, &edges) {
            return Err(refused);
        }
        dialogue.edges = edges;
        Ok(Turn::Wants(dialogue.prompt()))
    })
}

/// Gives the operand that is wanted; with the last one the figure is made.
fn give(open: &mut Open, host: &dyn Host, operand: Operand) -> Result<Turn, Refusal> {
    let home = home(open);
    let Some(dialogue) = &mut open.dialogue else {
        return Err(words::refuse("no construction waits".into()));
    };
    let is_point = dialogue.slot().is_some_and(|slot| slot.kind == SlotKind::Point);
    let mut filled = dialogue.filled.clone();
    if is_point {
        dialogue.last_point = Some(operand.text.clone());
    }
    if filled.is_empty() {
        settle_first((&open.state, &home), &mut dialogue.tool, &operand.text);
    }
    filled.push(operand);
    open.picking = super::Picking::default();
    if filled.len() < dialogue.tool.slots.len() {
        dialogue.filled = filled;
        return Ok(Turn::Wants(dialogue.prompt()));
    }
    let given = (&dialogue.tool, &filled[..], dialogue.pointer, dialogue.turned);
    let chosen = outcome::choose(&open.state, &home, given)?;
    let dialogue = dialogue.clone();
    if let Some(goal) = dialogue.goal.clone() {
        return reach(open, host, (&home, dialogue, goal), chosen.text);
    }
    if let Some(step) = dialogue.replaces.clone() {
        let Home::Program { program, .. } = &home else {
            return Err(words::refuse("nothing is recorded".into()));
        };
        let change = replaced(open, host, (program, &step), &chosen.text)?;
        open.dialogue = None;
        if let Some(recording) = &mut open.recording {
            recording.replaces = None;
            if let Some((blocks, before)) = recording.returns.take() {
                (recording.blocks, recording.before) = (blocks, before);
            }
        }
        let next = prompt(open);
        let change = Box::new(change);
        return Ok(Turn::Made { change, name: text::told(&step).into(), text: chosen.text, next });
    }
    let line = recording::line(open, &home, &dialogue, (&filled, &chosen.text));
    let since = open.done.len();
    let mut names = vec![line.name.clone()];
    // all of it, or nothing
    let change = open.tried(|open| {
        let mut change = recording::write(open, host, &home, &line)?;
        for more in filled[0].also.clone() {
            filled[0].text = more;
            let (made, name) = drawn_also(open, host, (&home, &dialogue, &filled))?;
            change = made;
            names.push(name);
        }
        Ok::<_, Refusal>(change)
    })?;
    if names.len() > 1 {
        open.one_step(since);
        open.label_last(format!("draw {}", names.join(", ")));
    }
    if let Some(dialogue) = &mut open.dialogue {
        dialogue.filled.clear();
        dialogue.edges.clear();
        dialogue.pointer = None;
        dialogue.is_begun = false;
        dialogue.turned = 0;
    }
    let next = prompt(open);
    let said = typed::expression(&chosen.text).and_then(|e| steps::pattern_in_words(&e));
    let (name, mut text) = (names.join(", "), said.unwrap_or(chosen.text));
    if let Some(of) = line.stays {
        text += &format!("; {of} stays: it was drawn before this repeat or `if`");
    }
    Ok(Turn::Made { change: Box::new(change), name, text, next })
}

/// Settles whether a pattern makes the first figure: not where what it is of is drawn.
fn settle_first((state, home): (&State, &Home), tool: &mut Tool, of: &str) {
    if let Call::Pattern(_, first) = &mut tool.call {
        *first = patterns::first_of(state, home, of);
    }
}

/// Does the same for a further set; says what it is called.
fn drawn_also(
    open: &mut Open,
    host: &dyn Host,
    (home, dialogue, filled): (&Home, &Dialogue, &[Operand]),
) -> Result<(Change, String), Refusal> {
    let mut dialogue = dialogue.clone();
    settle_first((&open.state, home), &mut dialogue.tool, &filled[0].text);
    let dialogue = &dialogue;
    let given = (&dialogue.tool, filled, dialogue.pointer, dialogue.turned);
    let chosen = outcome::choose(&open.state, home, given)?;
    let line = recording::line(open, home, dialogue, (filled, &chosen.text));
    let change = recording::write(open, host, home, &line)?;
    Ok((change, line.name))
}

/// Says anew what a step does.
pub(super) fn replaced(
    open: &mut Open,
    host: &dyn Host,
    (program, step): (&str, &str),
    formula: &str,
) -> Result<Change, Refusal> {
    let text = steps::with_formula(&text::Source::now(&open.state), (program, step), formula)?;
    recording::retext(open, host, text, format!("replace {}", text::told(step)))
}

/// Gives the outcome of a construction to what waits for it: as a figure of its own where it is kept as a guide.
fn reach(
    open: &mut Open,
    host: &dyn Host,
    (home, dialogue, goal): (&Home, Dialogue, Goal),
    made: String,
) -> Result<Turn, Refusal> {
    let at = dialogue.pointer.or_else(|| dialogue.filled.iter().rev().find_map(|o| o.at));
    let text = if dialogue.is_guide {
        let line = recording::line(open, home, &dialogue, (&dialogue.filled, &made));
        recording::write(open, host, home, &line)?;
        line.name
    } else {
        made
    };
    match goal {
        Goal::Operand(goal) => {
            open.dialogue = Some(*goal);
            give(open, host, Operand::new(text, at))
        }
        Goal::Answer => {
            open.dialogue = None;
            answered(open, host, (Some(&text), at))
        }
    }
}

/// Answers what is asked of the second turn.
fn answered(
    open: &mut Open,
    host: &dyn Host,
    answer: (Option<&str>, Option<(f64, f64)>),
) -> Result<Turn, Refusal> {
    let closed = repeat::answer(open, host, answer)?;
    open.picking = super::Picking::default();
    Ok(turn_of(open, closed, String::new()))
}

/// What comes of something that may have closed a block.
pub(super) fn turn_of(open: &Open, closed: Option<Change>, text: String) -> Turn {
    match closed {
        Some(change) => {
            let name = change.label.clone();
            // `if d > 5` says all of it
            let text = if name.ends_with(&text) { String::new() } else { text };
            Turn::Made { change: Box::new(change), name, text, next: prompt(open) }
        }
        None => match prompt(open) {
            Some(prompt) => Turn::Wants(prompt),
            None => Turn::Made { change: Box::default(), name: String::new(), text, next: None },
        },
    }
}

impl Session {
    /// Returns the constructions that can be begun: what the classes in scope make of figures and numbers.
    pub fn constructions(&self, id: DocumentId) -> Vec<ConstructionRow> {
        let open = self.document(id);
        let tools = catalogue::tools(&open.state, &home(open));
        tools.iter().map(Tool::row).collect()
    }

    /// Returns what is waited for: an operand, an answer, a condition.
    pub fn prompt(&self, id: DocumentId) -> Option<Prompt> {
        prompt(self.document(id))
    }

    /// Begins a construction, which then waits for its operands one by one. Where another one waits for what this one
    /// makes, or a question does, its outcome is given there.
    ///
    /// # Errors
    /// There is none of that name in scope.
    pub fn begin(&mut self, id: DocumentId, tool: &str) -> Result<Prompt, Refusal> {
        let open = self.document_mut(id);
        blocks::settle(open);
        let home = home(open);
        let found = catalogue::tool(&open.state, &home, tool);
        let found =
            found.ok_or_else(|| words::refuse(format!("there is no construction {tool}")))?;
        if open.state.lowered.document.class_named(&found.class).is_none() {
            // a class has no word for sets of figures
            not_in_a_pane(open)?;
        }
        let is_guide = open.dialogue.as_ref().is_some_and(|d| d.is_guide && d.goal.is_none());
        let goal = match open.dialogue.take() {
            Some(waiting) if waiting.waits_for(&open.state, &found) => {
                Some(Goal::Operand(Box::new(waiting)))
            }
            Some(_) => None,
            None => match blocks::prompt(open) {
                Some(Prompt { wants: Wants::Recurrence(_), is_value: false, .. }) => {
                    Some(Goal::Answer)
                }
                _ => None,
            },
        };
        let is_guide = is_guide && goal.is_none();
        let replaces = open.recording.as_ref().and_then(|r| r.replaces.clone());
        let replaces = replaces.filter(|_| goal.is_none());
        let dialogue = Dialogue { is_guide, goal, replaces, ..Dialogue::new(found) };
        let prompt = dialogue.prompt();
        open.tool = None;
        open.picking = super::Picking::default();
        open.dialogue = Some(dialogue);
        if let Some(recording) = &mut open.recording {
            recording.changing = None;
        }
        Ok(prompt)
    }

    /// Returns what a pointer, with what is typed so far, would do for what is waited for.
    pub fn hover(&mut self, id: DocumentId, pointer: &Pointer, typed: &str) -> Hover {
        let (open, beside) = self.beside_others(id);
        let (state, home) = (open.state.clone(), home(open));
        if let Some(measuring) = &open.picking.measure {
            return found_hover(&state, &home, measuring.find(&state, &home, pointer));
        }
        let level = open.picking.level;
        match &mut open.dialogue {
            Some(dialogue) => {
                // one that reaches nothing is nowhere: what is typed is shown as it would be made
                if pointer.reach >= 0.0 {
                    dialogue.pointer = Some(pointer.at);
                }
                dialogue.hover(&state, &home, (pointer, level, typed))
            }
            None => {
                let home = changing::home(open).or_else(|| remove::home(open)).unwrap_or(home);
                let wanted = blocks::prompt(open).unwrap_or_default();
                let was = wanted.of_turn_before();
                let mut hover = match pointer.reach < 0.0 {
                    true => Hover::default(),
                    false => {
                        found_hover(&state, &home, object_at(&state, &home, was, (pointer, level)))
                    }
                };
                let asked = repeat::asked_drawing(open, &beside);
                hover.ghost.elements.extend(asked.elements);
                hover
            }
        }
    }

    /// Gives what is wanted by what lies under a pointer. Of a value it is a measure, which the prompt then offers to
    /// be inserted.
    ///
    /// # Errors
    /// Nothing that fits lies there, or there is no such figure; what waits goes on waiting.
    pub fn point(&mut self, id: DocumentId, pointer: &Pointer) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let turn = pointed(open, &beside, pointer)?;
        let turn = self.said_of_class(id, turn)?;
        Ok(self.reached(id, turn))
    }

    /// Gives a set that is wanted by all that lies in a rectangle.
    ///
    /// # Errors
    /// No set is wanted, nothing that fits lies there, or there is no such figure; what waits goes on waiting.
    pub fn point_all(
        &mut self,
        id: DocumentId,
        corners: ((f64, f64), (f64, f64)),
    ) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let home = home(open);
        let waiting = open.dialogue.as_ref().and_then(|d| Some((d, d.slot()?)));
        if waiting.is_some_and(|(_, slot)| slot.kind == SlotKind::Edges) {
            let turn = edges_within(open, &beside, &home, corners)?;
            return Ok(self.reached(id, turn));
        }
        let Some((dialogue, slot)) = waiting.filter(|(_, slot)| slot.kind == SlotKind::Set) else {
            return Err(words::refuse(
                "one thing is wanted here: pick it, instead of a rectangle around several".into(),
            ));
        };
        let makes_one = dialogue.goal.is_some() || dialogue.replaces.is_some();
        let found = scene::within(&open.state, &home, corners);
        // a copy of what is drawn for construction would be part of the result
        let fits = |found: &scene::Found| found.is_result && slot.takes(&open.state, found.class);
        let found: Vec<scene::Found> = found.into_iter().filter(fits).collect();
        let (single, sets) = match makes_one {
            true => (found.into_iter().map(|found| found.text).collect(), Vec::new()),
            false => scene::whole_sets(&open.state, &home, &found),
        };
        let single = match single.as_slice() {
            [] => None,
            [one] => Some(one.clone()),
            all => Some(format!("[{}]", all.join(", "))),
        };
        let mut all = single.into_iter().chain(sets);
        let none = || words::refuse("nothing that can be taken lies in that rectangle".into());
        let text = all.next().ok_or_else(none)?;
        let operand = Operand { text, at: None, also: all.collect() };
        let turn = give(open, &beside, operand)?;
        Ok(self.reached(id, turn))
    }

    /// Gives what is wanted by what is typed: `x,y`, `@dx,dy`, `length<angle`, any expression, a condition.
    ///
    /// # Errors
    /// It is none, or there is no such figure; what waits goes on waiting.
    pub fn enter(&mut self, id: DocumentId, typed: &str) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let turn = entered(open, &beside, typed)?;
        let turn = self.said_of_class(id, turn)?;
        Ok(self.reached(id, turn))
    }

    /// Answers that an operand is the same in every turn.
    ///
    /// # Errors
    /// Nothing is asked, or the second turn would have no outcome.
    pub fn same(&mut self, id: DocumentId) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let turn = answered(open, &beside, (None, None))?;
        Ok(self.reached(id, turn))
    }

    /// Says of a class what was drawn in a pane that shows its prototype: the pane alone has it so far.
    fn said_of_class(&mut self, id: DocumentId, turn: Turn) -> Result<Turn, Refusal> {
        if self.document(id).pane.is_none() {
            return Ok(turn);
        }
        let Turn::Made { name, text, next, .. } = turn else { return Ok(turn) };
        let text_of = |name| crate::tools::member_of(&self.document(id).state.text, name);
        let members: Vec<String> = name.split(", ").map(text_of).collect();
        let members = members.join("\n");
        let command = Command::Edit { target: kernel::Path::default(), members };
        let carried = self.apply_in_pane(id, &command);
        if carried.is_err() {
            self.renew_pane(id);
        }
        Ok(Turn::Made { change: Box::new(carried?), name, text, next })
    }

    pub(super) fn reached(&mut self, id: DocumentId, turn: Turn) -> Turn {
        match turn {
            Turn::Made { change, name, text, next } => {
                Turn::Made { change: self.with_reach(id, *change), name, text, next }
            }
            Turn::Wants(prompt) => Turn::Wants(prompt),
        }
    }

    pub(crate) fn with_reach(&mut self, id: DocumentId, mut change: Change) -> Box<Change> {
        if !change.edits.is_empty() {
            change.documents = self.reach(id);
        }
        Box::new(change)
    }

    /// Takes the latest operand or answer back; without one what waits is given up. Returns what is wanted then.
    pub fn back(&mut self, id: DocumentId) -> Option<Prompt> {
        let open = self.document_mut(id);
        let picking = std::mem::take(&mut open.picking);
        if picking.older.is_some() {
            return prompt(open);
        }
        match open.dialogue.take() {
            Some(mut dialogue) if !dialogue.edges.is_empty() => {
                dialogue.edges.pop();
                open.dialogue = Some(dialogue);
            }
            Some(mut dialogue) => {
                let had = dialogue.filled.pop();
                open.dialogue = match (had, dialogue.goal.take()) {
                    (Some(_), goal) => Some(Dialogue { goal, ..dialogue }),
                    (None, Some(Goal::Operand(waiting))) => Some(*waiting),
                    (None, Some(Goal::Answer) | None) => None,
                };
            }
            None => back_of_block(open),
        }
        prompt(open)
    }

    /// Gives the construction up, or the question that can be; returns what is wanted then.
    pub fn give_up(&mut self, id: DocumentId) -> Option<Prompt> {
        let open = self.document_mut(id);
        open.picking = super::Picking::default();
        if open.dialogue.is_none() {
            // how the other branch is drawn is asked no more
            choice::back(open);
        }
        match open.dialogue.take().and_then(|dialogue| dialogue.goal) {
            Some(Goal::Operand(waiting)) => open.dialogue = Some(*waiting),
            Some(Goal::Answer) | None => {
                if let Some(recording) = &mut open.recording {
                    recording.asks_condition = false;
                    recording.removing = None;
                    recording.changing = None;
                }
            }
        }
        prompt(open)
    }

    /// Gives up a measure that is being taken; returns whether one was.
    pub fn leave_measure(&mut self, id: DocumentId) -> bool {
        self.document_mut(id).picking.measure.take().is_some()
    }

    /// Says what something is for the program that was picked outside of it, and gives it as the operand.
    ///
    /// # Errors
    /// Nothing is asked, or it can be neither; then nothing has changed.
    pub fn take_older(&mut self, id: DocumentId, to: OlderUse) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let none = || words::refuse("nothing outside of the program was picked".into());
        let older = open.picking.older.clone().ok_or_else(none)?;
        let home = home(open);
        let done = open.tried(|open| {
            let text = older::settle(open, &beside, &home, (&older, to))?;
            if let Some(dialogue) = &mut open.dialogue {
                dialogue.pointer = None;
            }
            give(open, &beside, Operand::new(text, Some(older.at)))
        });
        match done {
            Ok(turn) => Ok(self.reached(id, turn)),
            Err(refusal) => {
                open.picking.older = Some(older);
                Err(refusal)
            }
        }
    }

    /// Asks the construction that waits for another solution than the one that is shown: the next in distance.
    ///
    /// # Errors
    /// None waits.
    pub fn turn_round(&mut self, id: DocumentId) -> Result<(), Refusal> {
        match &mut self.document_mut(id).dialogue {
            Some(dialogue) => {
                dialogue.turned += 1;
                Ok(())
            }
            None => Err(words::refuse("no construction waits: choose one first".into())),
        }
    }

    /// Lets picks of sets mean more: an entity, its turn, the whole loop, and around.
    pub fn pick_wider(&mut self, id: DocumentId) {
        self.document_mut(id).picking.level += 1;
    }

    /// Says whether what a construction makes is drawn for construction alone; of one that another waits for, whether
    /// it is kept as a guide.
    pub fn draw_guides(&mut self, id: DocumentId, are_guides: bool) {
        if let Some(dialogue) = &mut self.document_mut(id).dialogue {
            dialogue.is_guide = are_guides;
        }
    }

    /// Begins to take a measure for a calculator; picks are its own until it is complete.
    pub fn begin_measure(&mut self, id: DocumentId, kind: MeasureKind) -> Option<Prompt> {
        let open = self.document_mut(id);
        open.picking.measure = Some(measure::Measuring::new(kind));
        prompt(open)
    }

    /// Returns what an expression comes to where things are drawn now.
    pub fn compute(&self, id: DocumentId, text: &str) -> Computed {
        let open = self.document(id);
        match outcome::worth(&open.state, &home(open), text) {
            Ok(outcome::Worth::Truth(truth)) => {
                Computed { value: Some(if truth { "true" } else { "false" }.into()), why: None }
            }
            Ok(outcome::Worth::Number(number)) => Computed { value: Some(number), why: None },
            Ok(outcome::Worth::Other(kind)) => Computed { value: None, why: Some(kind) },
            Err(refusal) => Computed { value: None, why: Some(refusal.message) },
        }
    }
}

/// Gives the lines and arcs that lie in a rectangle.
fn edges_within(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    corners: ((f64, f64), (f64, f64)),
) -> Result<Turn, Refusal> {
    let mut found = scene::within(&open.state, home, corners);
    found.retain(|found| found.side.is_none() && found.curve.ends().is_some());
    let edges: Vec<String> = found.into_iter().map(|found| found.text).collect();
    if edges.is_empty() {
        return Err(words::refuse("no line and no arc lies in that rectangle".into()));
    }
    give_edges(open, host, (edges, None))
}

fn found_hover(state: &State, home: &Home, found: Result<scene::Found, Refusal>) -> Hover {
    match found {
        Ok(found) => Hover {
            ghost: scene::drawing_of(state, home, &found.text),
            finds: Some(found.text),
            why: None,
        },
        Err(refusal) => Hover { why: Some(refusal.message), ..Hover::default() },
    }
}

/// What lies under a pointer of what is drawn, or what that is in; it may take the place of something.
pub(super) fn object_at(
    state: &State,
    home: &Home,
    was: &str,
    (pointer, level): (&Pointer, usize),
) -> Result<scene::Found, Refusal> {
    let all = scene::scene(state, home);
    let found = scene::nearest_instead(all.iter(), was, pointer);
    let none = || words::refuse("nothing that can be picked lies here".into());
    found
        .map(|found| scene::Found { text: found.at_level(level, false), ..found.clone() })
        .ok_or_else(none)
}

/// Leaves what a block asks for.
fn back_of_block(open: &mut Open) {
    if open.recording.as_ref().is_some_and(|recording| recording.removing.is_some()) {
        remove::back(open);
        return;
    }
    if let Some(recording) = &mut open.recording
        && recording.changing.take().is_some()
    {
        return;
    }
    if let Some(recording) = &mut open.recording
        && recording.asks_condition
    {
        recording.asks_condition = false;
        return;
    }
    match open.recording.as_ref().and_then(|r| r.innermost()).map(|block| &block.kind) {
        Some(blocks::Kind::Loop(_)) => repeat::back(open),
        Some(blocks::Kind::Choice(_)) => choice::back(open),
        Some(blocks::Kind::Visited) | None => {}
    }
}

fn pointed(open: &mut Open, host: &dyn Host, pointer: &Pointer) -> Result<Turn, Refusal> {
    let (state, home, level) = (open.state.clone(), home(open), open.picking.level);
    if let Some(measuring) = &mut open.picking.measure {
        let found = measuring.find(&state, &home, pointer)?;
        let insert = measuring.take(&state, found);
        if insert.is_some() {
            open.picking.measure = None;
        }
        return Ok(Turn::Wants(Prompt { insert, ..prompt(open).unwrap_or_default() }));
    }
    if open.recording.as_ref().is_some_and(|recording| recording.removing.is_some()) {
        let done = remove::instead(open, host, ("", Some((pointer, level))))?;
        return Ok(turn_of(open, done, String::new()));
    }
    if let Some(changing) = open.recording.as_ref().and_then(|r| r.changing.clone()) {
        let prompt = changing.prompt();
        if !prompt.is_value {
            let change = changing::give(open, host, ("", Some((pointer, level))))?;
            return Ok(turn_of(open, Some(change), String::new()));
        }
        let found = object_at(&state, &home, "", (pointer, level))?;
        return Ok(Turn::Wants(Prompt { insert: Some(measured(&state, &found)?), ..prompt }));
    }
    if let Some(dialogue) = &mut open.dialogue {
        let operand = match dialogue.pick(&state, &home, (pointer, level)) {
            Ok(operand) => operand,
            Err(refusal) => {
                open.picking.older = older::find(&state, &home, dialogue, pointer);
                return match &open.picking.older {
                    Some(_) => Ok(Turn::Wants(prompt(open).unwrap_or_default())),
                    None => Err(refusal),
                };
            }
        };
        if dialogue.slot().is_some_and(|slot| slot.kind == SlotKind::Value) {
            let insert = Some(operand.text);
            return Ok(Turn::Wants(Prompt { insert, ..dialogue.prompt() }));
        }
        dialogue.pointer = None;
        if dialogue.slot().is_some_and(|slot| slot.kind == SlotKind::Places) {
            return Ok(Turn::Wants(dialogue.with_place(operand.text)));
        }
        if dialogue.slot().is_some_and(|slot| slot.kind == SlotKind::Edges) {
            let edges = dialogue.with_edge(&state, &home, &operand.text);
            return give_edges(open, host, (edges, operand.at));
        }
        return give(open, host, operand);
    }
    let Some(wanted) = blocks::prompt(open) else {
        return Err(words::refuse("nothing is asked now: choose what to draw first".into()));
    };
    let found = object_at(&state, &home, wanted.of_turn_before(), (pointer, level))?;
    match wanted.wants {
        Wants::Recurrence(_) if !wanted.is_value => {
            answered(open, host, (Some(&found.text), Some(pointer.at)))
        }
        Wants::Otherwise => Err(words::refuse("say how the other branch is drawn first".into())),
        Wants::Substitute { .. }
        | Wants::Older { .. }
        | Wants::Change(_)
        | Wants::Recurrence(_)
        | Wants::Ends(_)
        | Wants::Condition
        | Wants::Operand => {
            Ok(Turn::Wants(Prompt { insert: Some(measured(&state, &found)?), ..wanted }))
        }
    }
}

/// The usual measure of what was found.
fn measured(state: &State, found: &scene::Found) -> Result<String, Refusal> {
    let none =
        || words::refuse(format!("{} has no measure: take one by the calculator", found.text));
    measure::usual(state, found).ok_or_else(none)
}

fn entered(open: &mut Open, host: &dyn Host, typed: &str) -> Result<Turn, Refusal> {
    let home = home(open);
    if open.recording.as_ref().is_some_and(|recording| recording.removing.is_some()) {
        let done = remove::instead(open, host, (typed, None))?;
        return Ok(turn_of(open, done, String::new()));
    }
    if open.recording.as_ref().is_some_and(|recording| recording.changing.is_some()) {
        let change = changing::give(open, host, (typed, None))?;
        return Ok(turn_of(open, Some(change), typed.into()));
    }
    let picked = open.dialogue.as_ref().filter(|dialogue| !dialogue.edges.is_empty());
    if let Some(edges) = picked.map(|dialogue| dialogue.edges.clone())
        && typed.trim().is_empty()
    {
        return give_edges(open, host, (edges, None));
    }
    if let Some((dialogue, slot)) = open.dialogue.as_ref().and_then(|d| Some((d, d.slot()?))) {
        let (text, wanted) =
            (typed::operand(slot, typed, dialogue.last_point.as_deref())?, slot.clone());
        let text = match slot.kind {
            SlotKind::Edges => edges::joined(&dialogue.edges, &text),
            // words are typed as they are
            SlotKind::Value if *wanted.class == *"Text" => {
                let fits = outcome::fits(&open.state, &home, (&text, &wanted));
                if fits.is_ok() { text } else { lang::quoted(&text) }
            }
            _ => text,
        };
        let again = |open: &mut Open| {
            outcome::fits(&open.state, &home, (&text, &wanted))?;
            if let (SlotKind::Places, Some(dialogue)) = (wanted.kind, &mut open.dialogue) {
                return Ok(Turn::Wants(dialogue.with_place(text.clone())));
            }
            if let Some(asks) = &wanted.asks {
                asks.allows(&open.state, &home, (&wanted.name, &text))?;
            }
            give(open, host, Operand::new(text.clone(), None))
        };
        return becoming::given(open, host, (&home, &text, &wanted), &again);
    }
    match blocks::prompt(open).map(|prompt| prompt.wants) {
        Some(Wants::Recurrence(question)) => {
            let closed = repeat::answer_typed(open, host, (&home, &question), typed)?;
            open.picking = super::Picking::default();
            Ok(turn_of(open, closed, String::new()))
        }
        Some(Wants::Ends(ends)) => {
            let again = |open: &mut Open| {
                let change = repeat::close(open, host, typed)?;
                Ok(turn_of(open, Some(change), typed.into()))
            };
            let wanted = if ends == Ends::Times { "Integer" } else { "Bool" };
            again(open).or_else(|refused| {
                becoming::retried(open, host, (&home, typed, wanted), refused, &again)
            })
        }
        Some(Wants::Condition) => {
            let change = choice::begin(open, host, typed)?;
            Ok(turn_of(open, Some(change), typed.into()))
        }
        Some(
            Wants::Otherwise
            | Wants::Operand
            | Wants::Older { .. }
            | Wants::Substitute { .. }
            | Wants::Change(_),
        )
        | None => Err(words::refuse("nothing can be typed now: choose what to draw first".into())),
    }
}

/// Says that constructions and programs are drawn in a document, where a class's prototype is shown.
///
/// # Errors
/// It is shown.
pub(super) fn not_in_a_pane(open: &Open) -> Result<(), Refusal> {
    match &open.pane {
        Some(pane) => {
            let class = &pane.class;
            let message =
                format!("constructions are drawn in the document, not in the class {class}");
            Err(words::refuse(message))
        }
        None => Ok(()),
    }
}
