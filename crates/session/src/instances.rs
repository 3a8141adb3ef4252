//! Instances of programs: things that a program draws, each at a place of its own. Held in their place, a drag of what
//! they show fits the program to it; unlinked, what they drew becomes plain figures of the document.

use crate::drafting::{compound, retext};
use crate::session::{Session, parse_path};
use crate::state::State;
use crate::view::{Change, DocumentId, Refusal};
use crate::views::drawn;
use crate::{apply, words};
use base::Name;
use eval::{Answer, Evaluator};
use kernel::{Command, DOCUMENT, Document, Literal, Path, Step};
use syntax::ast::{AstNode, Member, span_without_doc};

/// Values of the parts of a figure, by their paths.
type Values = Vec<(Path, Literal)>;

/// What a program drew, as the document says it without the program.
struct Plain {
    /// Its path.
    path: String,
    /// Its class.
    class: Name,
    /// What it is of.
    says: Says,
}

enum Says {
    /// A figure by the values of its parts: it can be dragged.
    Figure(Values),
    /// What has no parts of a fixed number, by an expression: a contour, a region, a curve through places.
    Formula(String),
}

/// What places a thing of a program, beside its parameters.
const PLACE: [&str; 3] = ["at", "turn", "scale"];

impl Session {
    /// Returns the thing of the document that a path leads into, if a program draws it.
    pub fn instance_of(&self, id: DocumentId, path: &str) -> Option<String> {
        let state = &self.document(id).state;
        let thing = path.split(['.', '[']).next()?;
        let own = words::find(state, &parse_path(thing)?).ok()?;
        state.lowered.document.program(state.structure.things[own].class)?;
        Some(thing.into())
    }

    /// Returns whether a thing that a program draws is held in its place; nothing for any other thing.
    pub fn is_held_in_place(&self, id: DocumentId, thing: &str) -> Option<bool> {
        let state = &self.document(id).state;
        let path = parse_path(thing)?;
        let own = words::find(state, &path).ok()?;
        let class = state.structure.things[own].class;
        let document = &state.lowered.document;
        document.find_message(class, &Name::new(lang::PLACED), None)?;
        let slots = state.structure.slots_under(words::find(state, &path.then(part("at"))).ok()?);
        Some(slots.into_iter().all(|slot| state.structure.slots[slot].anchored))
    }

    /// Holds a placed thing of a program where it is, as it is turned and scaled, or lets it go. While it is held, a drag
    /// of what it shows moves its parameters: the program is fitted to the pointer. One step.
    ///
    /// # Errors
    /// It is no placed thing of a program.
    pub fn hold_in_place(
        &mut self,
        id: DocumentId,
        thing: &str,
        held: bool,
    ) -> Result<Change, Refusal> {
        let none = || words::refuse(format!("{thing} is no placed thing of a program"));
        self.is_held_in_place(id, thing).ok_or_else(none)?;
        let path = parse_path(thing).ok_or_else(none)?;
        let place: Vec<Path> = PLACE.into_iter().map(|name| path.then(part(name))).collect();
        let change = self.hold(id, &place, held)?;
        let label = if held { "hold" } else { "let go" };
        self.document_mut(id).label_last(format!("{label} {thing}"));
        Ok(change)
    }

    /// Makes plain figures of the document of what the program of a thing drew, where they are shown; the thing goes. One
    /// step. Contours, regions and curves through places become expressions with numbers. Returns what all are called.
    ///
    /// # Errors
    /// No program draws the thing, or it draws what is no plain figure; something else speaks of it.
    pub fn unlink(
        &mut self,
        id: DocumentId,
        thing: &str,
    ) -> Result<(Change, Vec<String>), Refusal> {
        let (open, beside) = self.beside_others(id);
        open.drag = None;
        let state = open.state.clone();
        let figures = figures(&state, thing)?;
        let mut names: Vec<String> = Vec::new();
        let mut lines = String::new();
        for Plain { path, class, says } in &figures {
            let name = free_name(&state, &names, path);
            lines.push_str(&match says {
                Says::Figure(_) => format!("{name}: {class}\n"),
                Says::Formula(formula) => format!("{name} => {formula}\n"),
            });
            names.push(name);
        }
        let none = || words::refuse(format!("{thing} does not stand at the top of the text"));
        let span = member_span(&state.text, thing).ok_or_else(none)?;
        let text = format!(
            "{}{lines}{}",
            &state.text[..span.start],
            &state.text[span.end..].trim_start_matches('\n')
        );
        let label = format!("unlink {thing}");
        let since = open.done.len();
        let mut change = retext(open, &beside, text, label.clone())?;
        let values = figures.into_iter().zip(&names).flat_map(|(plain, name)| {
            let own = Path::of(&[name]);
            let values = match plain.says {
                Says::Figure(values) => values,
                Says::Formula(_) => Values::new(),
            };
            values.into_iter().map(move |(path, value)| (own.join(&path), value))
        });
        let values: Values = values.collect();
        let set = match values.is_empty() {
            true => Ok(Change::default()),
            false => apply::apply(open, &beside, &Command::Set(values)),
        };
        match set {
            Ok(set) => change.edits.extend(set.edits),
            Err(refusal) => {
                open.travel(crate::document::Direction::Back);
                open.undone.pop();
                return Err(refusal);
            }
        }
        open.one_step(since);
        open.label_last(label);
        change.documents = self.reach(id);
        Ok((change, names))
    }
}

fn part(name: &str) -> Step {
    Step::Part(name.into())
}

/// What the program of a thing drew, without the program.
fn figures(state: &State, thing: &str) -> Result<Vec<Plain>, Refusal> {
    let document = &state.lowered.document;
    let path = parse_path(thing).ok_or_else(|| words::refuse(format!("{thing} is no path")))?;
    let own = words::find(state, &path)?;
    if document.program(state.structure.things[own].class).is_none() {
        return Err(words::refuse(format!("{thing} is not drawn by a program")));
    }
    let evaluator = state.evaluator(&state.values);
    let all = drawn::entities(state, &evaluator, own);
    if all.is_empty() {
        return Err(words::refuse(format!("{thing} draws nothing")));
    }
    let mut plain = Vec::new();
    for (path, answer) in all {
        let none = || {
            let message = format!("{path} is no plain figure: {thing} stays linked to its program");
            words::refuse(message)
        };
        let class = evaluator.class_of(&answer).ok_or_else(none)?;
        let mut values = Values::new();
        let is_figure = compound::is_drawn(document, class);
        let is_plain = is_figure && flatten(document, &answer, &Path::default(), &mut values);
        let says = match is_plain {
            true => Says::Figure(values),
            false => Says::Formula(formula(&evaluator, &answer).ok_or_else(none)?),
        };
        let class = document.classes[document.named_class(class)].name.clone();
        plain.push(Plain { path, class, says });
    }
    Ok(plain)
}

/// Writes what was made by its parts, with numbers; nothing where it is of what an expression cannot say.
fn formula<'a>(evaluator: &Evaluator<'a>, answer: &Answer<'a>) -> Option<String> {
    let document = evaluator.document;
    let all = |parts: &[Answer<'a>]| {
        let each = parts.iter().map(|part| formula(evaluator, part));
        each.collect::<Option<Vec<_>>>().map(|each| each.join(", "))
    };
    match answer {
        Answer::Made(made) => {
            let class = &document.classes[document.named_class(made.class)].name;
            Some(format!("{class}({})", all(&made.fields)?))
        }
        Answer::List(items) => Some(format!("[{}]", all(items)?)),
        Answer::Number(x, dimension) => {
            let quantity =
                kernel::Quantity { dimension: *dimension, ..kernel::Quantity::default() };
            let shown = kernel::show_quantity(*x, quantity, document);
            Some(words::with_unit(shown.exact, &shown.unit))
        }
        Answer::Text(text) => Some(lang::quoted(text)),
        Answer::Bool(_) | Answer::Option(..) => Some(evaluator.text_of(answer)),
        Answer::Thing(_) | Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => None,
    }
}

/// Collects the values of the parts of what was made; false where it has others than numbers, texts and things of these.
fn flatten(document: &Document, answer: &Answer<'_>, path: &Path, into: &mut Values) -> bool {
    match answer {
        Answer::Made(made) => {
            document.layout(made.class).into_iter().zip(&made.fields).all(|(field, answer)| {
                let name = document.field_name(field).clone();
                flatten(document, answer, &path.then(Step::Part(name)), into)
            })
        }
        Answer::Number(..) | Answer::Bool(_) | Answer::Option(..) | Answer::Text(_) => {
            let literal = crate::check::literal_of(answer).ok();
            literal.map(|literal| into.push((path.clone(), literal))).is_some()
        }
        Answer::Thing(_)
        | Answer::Context(_)
        | Answer::List(_)
        | Answer::Picture(_)
        | Answer::Function(_) => false,
    }
}

/// A name for a figure that was drawn as this: `washer_ring`, `column_2_ring`.
fn free_name(state: &State, taken: &[String], path: &str) -> String {
    let parts = path.split(['.', '[', ']']).filter(|part| !part.is_empty());
    let base = parts.collect::<Vec<_>>().join("_");
    let is_free = |name: &String| {
        let path = Path(vec![Step::Part(name.as_str().into())]);
        let class = state.structure.things[DOCUMENT].class;
        let is_computed =
            state.lowered.document.find_message(class, &Name::new(name), None).is_some();
        !taken.contains(name) && !is_computed && state.structure.follow(DOCUMENT, &path).is_err()
    };
    let names = std::iter::once(base.clone()).chain((2..).map(|n| format!("{base}_{n}")));
    { names }.find(is_free).unwrap_or_default()
}

/// Where the declaration of a thing alone stands in a text, with the end of its line.
fn member_span(text: &str, thing: &str) -> Option<std::ops::Range<usize>> {
    let file = syntax::parse(base::FileId(0), text).file();
    file.members().find_map(|member| match member {
        Member::Part(part) => {
            let mut names = part.names();
            let is_it = names.next().is_some_and(|word| word.text() == thing);
            let span = span_without_doc(part.syntax());
            (is_it && names.next().is_none()).then_some(span.start as usize..span.end as usize)
        }
        _ => None,
    })
}
