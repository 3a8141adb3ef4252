//! Prototypes: a class by the example of one of its things.
//!
//! The prototype of a class is what a thing of it is that nobody has given a value of its own. An edit
//! of the prototype's values is made on such a thing, in a copy of the document that has one more; what
//! the edit gives that thing, the class gives all its things from then on.

pub(crate) mod pane;

use crate::apply::{self, Mover};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use crate::write_back::{literal, unit_of_writing};
use kernel::{ClassId, Command, Document, Literal, Part, Path, Step, Structure, ThingId};

/// A thing of a class, alone in a document of its own.
pub(crate) struct Lone {
    /// The same classes, and a document that has this thing alone.
    pub(crate) document: Document,
    /// Its structure.
    pub(crate) structure: Structure,
    /// The thing.
    pub(crate) thing: ThingId,
}

impl Lone {
    /// Makes a thing of a class; nothing where that cannot be.
    pub(crate) fn of(document: &Document, class: ClassId) -> Option<Self> {
        let mut document = document.clone();
        let root = document.root;
        let root = &mut document.classes[root];
        root.givens.clear();
        root.messages.clear();
        root.constraints.clear();
        root.merges.clear();
        root.inserts.clear();
        root.stays.clear();
        root.switches.clear();
        let (name, doc) = (base::Name::new("lone"), String::new());
        let origin = root.origin;
        root.parts = vec![Part {
            name: name.clone(),
            doc,
            class,
            count: None,
            range: None,
            is_layout: false,
            origin,
        }];
        let (structure, faults) = kernel::instantiate(&document);
        let thing = structure.follow(kernel::DOCUMENT, &Path(vec![Step::Part(name)])).ok()?;
        faults.is_empty().then_some(Self { document, structure, thing })
    }
}

/// Returns the class whose prototype a path begins at.
pub(crate) fn class_of<'p>(state: &State, path: &'p Path) -> Option<&'p base::Name> {
    let Some(Step::Part(name)) = path.0.first() else { return None };
    let known = crate::session::thing_at(state, &Path(path.0[..1].to_vec())).is_some();
    (!known && state.lowered.declares_class(name)).then_some(name)
}

/// Sets or moves values of a class's prototype.
///
/// # Errors
/// Why it was refused; then nothing has changed.
pub(crate) fn edit(
    open: &mut Open,
    host: &dyn Host,
    (command, mover): (&Command, Mover),
    targets: &[(Path, Literal)],
    class: &base::Name,
) -> Result<Change, Refusal> {
    let before = open.state.clone();
    let first = Step::Part(class.clone());
    if targets.iter().any(|(path, _)| path.0.first() != Some(&first)) {
        return Err(words::refuse(format!("an edit of {class} is about nothing else")));
    }
    let name = free_name(&before);
    let start = before.text.len();
    let mut trial = Open::of(&open.name, format!("{}\n{name}: {class}\n", before.text), host);
    let of_trial = |(path, literal): &(Path, Literal)| {
        let steps = std::iter::once(Step::Part(name.clone())).chain(path.0[1..].iter().cloned());
        (Path(steps.collect()), literal.clone())
    };
    let targets = targets.iter().map(of_trial).collect();
    let command_of_trial = match command {
        Command::Move(_) => Command::Move(targets),
        _ => Command::Set(targets),
    };
    apply::apply_by(&mut trial, host, &command_of_trial, mover)?;
    let writes = given_since(&trial.state, start, class);
    let edits = lang::write_values(&before.lowered, &writes);
    let text = syntax::edit::apply(&before.text, &edits);
    let change = apply::take_state(open, host, text, words::command_label(command));
    Ok(Change { class: Some(class.to_string()), ..change })
}

/// Returns what the text of a document gives a prototype from some place on, as its class gives it.
fn given_since(state: &State, start: usize, class: &base::Name) -> Vec<(Path, Literal)> {
    let mut given: Vec<ThingId> = Vec::new();
    for slot in state.structure.slots.ids() {
        let origin = state.structure.given(slot).map(|g| g.origin);
        let own = origin.and_then(|o| state.lowered.own_span(o));
        // where the whole prototype is a place, the class gives its coordinates
        let unit = unit_of_writing(state, slot);
        let is_whole = state.structure.things[unit].owner == Some(kernel::DOCUMENT);
        let thing = if is_whole { state.structure.slots[slot].thing } else { unit };
        if own.is_some_and(|span| span.start as usize >= start) && !given.contains(&thing) {
            given.push(thing);
        }
    }
    let first = Step::Part(class.clone());
    let write = |&thing: &ThingId| {
        let path = state.structure.path(&state.lowered.document, thing);
        let steps = std::iter::once(first.clone()).chain(path.0[1..].iter().cloned());
        (Path(steps.collect()), literal(state, thing, &state.values))
    };
    given.iter().map(write).collect()
}

/// Returns a name that nothing in a document has.
fn free_name(state: &State) -> base::Name {
    let names =
        std::iter::once("prototype".to_string()).chain((2..).map(|i| format!("prototype{i}")));
    let mut free = names.filter(|name| !state.text.contains(name.as_str()));
    base::Name::new(&free.next().unwrap_or_default())
}
