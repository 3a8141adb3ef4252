//! Copies: things of the document again, a little aside, with the same values and what is said between them.
//!
//! A copy is the text that says it. What the things are called changes when they are put down, and nothing else; then
//! they are moved together in a document of their own, so that where they lie is written as any move would be.

use super::lengths::{self, Measure};
use super::{digits, member_of, of_classes};
use crate::apply;
use crate::by_hand::class_at;
use crate::document::Open;
use crate::drag;
use crate::host::Host;
use crate::recognise;
use crate::session::thing_at;
use crate::state::State;
use crate::view::Refusal;
use crate::views::picture::across;
use crate::words;
use base::{Name, Span};
use kernel::{ClassKind, Command, DOCUMENT, Literal, Path, Step};
use lang::{Meant, Mention};
use std::collections::{BTreeMap, BTreeSet};
use syntax::SyntaxNode;
use syntax::ast::{AstNode, Expr, Member, Value};
use syntax::edit::TextEdit;

/// A copy lies aside by what is looked at of an empty sheet over so many.
const ASIDE: f64 = 10.0;
/// Of more places than this copies are moved as one.
const MOST_PLACES: usize = 200;

/// Which relations of what is copied are copied too.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relations {
    /// Those between the copied things alone.
    Own,
    /// Those with other things as well: a copy of a line is joined to what the line is joined to.
    All,
}

/// Copies of things, to be put into a document.
#[derive(Clone, PartialEq, Debug)]
pub struct Clip {
    /// What is copied, by name, each with its class.
    things: Vec<(Name, Name)>,
    relations: Relations,
    pub(super) members: Vec<Copied>,
    /// Where their places were, also those that the text gives to what they are merged with.
    places: Vec<(Path, (f64, f64))>,
    /// What the text that they come from uses and declares: it goes with them where they mean nothing without.
    pub(super) header: Vec<String>,
    /// What a length without a unit is where they come from.
    pub(super) measure: Option<Measure>,
}

impl Clip {
    /// The copies as a document of their own, for a clipboard.
    pub fn written(&self) -> String {
        let members = self.members.iter().map(|copied| copied.text.trim());
        let header = self.header.iter().map(String::as_str);
        header.chain(members).map(|member| format!("{member}\n")).collect()
    }
}

/// Returns copies of all things of a text, which stands alone or uses what another text does that it is a piece of;
/// nothing where it says nothing of things without an error.
pub(crate) fn read(text: &str, whole: &str, host: &dyn Host) -> Option<Clip> {
    read_alone(text, host).or_else(|| {
        let with_header = header(whole).into_iter().chain([text.to_string()]).collect::<Vec<_>>();
        read_alone(&with_header.join("\n"), host)
    })
}

fn read_alone(text: &str, host: &dyn Host) -> Option<Clip> {
    let open = Open::of("", text.into(), host);
    let state = &open.state;
    let parts = state.structure.parts(DOCUMENT);
    let name = |part| state.structure.field_name(&state.lowered.document, part).cloned();
    let paths: Vec<Path> =
        parts.filter_map(name).map(|name| Path(vec![Step::Part(name)])).collect();
    let clip = copied(state, &paths, Relations::Own).ok()?;
    (!state.has_errors()).then_some(clip)
}

/// A member of a text that says something of what is copied.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Copied {
    pub(super) text: String,
    /// Where it names what is copied.
    names: Vec<(Span, Name)>,
    is_thing: bool,
}

/// Takes copies of things of the document.
///
/// # Errors
/// A path is no thing of the document itself, or it is declared with others that are not copied.
pub(crate) fn copied(state: &State, paths: &[Path], relations: Relations) -> Result<Clip, Refusal> {
    let document = &state.lowered.document;
    let figures = state.evaluator(&state.values).computed_figures(DOCUMENT);
    let mut things: Vec<(Name, Name)> = Vec::new();
    for path in paths {
        let class = class_at(state, path).map(|class| document.named_class(class));
        let class = class.map(|class| document.classes[class].name.clone());
        match (path.0.as_slice(), class) {
            ([Step::Part(name)], Some(class)) => things.push((name.clone(), class)),
            // a list, or what cannot be made now, has no class
            ([Step::Part(name)], None) if figures.contains(name) => {
                things.push((name.clone(), name.clone()));
            }
            _ => {
                let message = format!("{path} is a part: copy the whole that it is a part of");
                return Err(words::refuse(message));
            }
        }
    }
    if things.is_empty() {
        return Err(words::refuse("nothing is selected".into()));
    }
    let named: BTreeSet<&str> = things.iter().map(|(copied, _)| copied.as_str()).collect();
    let is_copied = |name: &str| named.contains(name);
    let said = heads(&state.text, state);
    let mut members: Vec<Copied> = Vec::new();
    for member in state.file().members() {
        let range = member.syntax().text_range();
        let span = Span::new(range.start().into(), range.end().into());
        let within = said.range(Span::new(span.start, span.start)..Span::new(span.end, span.end));
        let within: Vec<(Span, Name)> = within.map(|(s, n)| (*s, n.clone())).collect();
        let is_own = |(_, name): &(Span, Name)| is_copied(name);
        let (is_thing, is_wanted) = match &member {
            Member::Part(part) => {
                let names: Vec<String> = part.names().map(|word| word.text().to_string()).collect();
                let count = names.iter().filter(|name| is_copied(name)).count();
                if count > 0 && count < names.len() {
                    let message = format!(
                        "{} are declared together: copy all of them, or none",
                        words::listed(&names)
                    );
                    return Err(words::refuse(message));
                }
                (true, count > 0)
            }
            // what is computed goes with what it is computed from; with all relations, where that is not copied, it
            // speaks of the same as before
            Member::Message(message) => {
                let name = message.name().map(|word| word.text().to_string());
                (false, name.is_some_and(|name| is_copied(&name)))
            }
            Member::Constraint(_) | Member::Merge(_) | Member::Anchor(_) | Member::Stay(_) => {
                let is_wanted = match relations {
                    Relations::Own => !within.is_empty() && within.iter().all(is_own),
                    Relations::All => within.iter().any(is_own),
                };
                (false, is_wanted)
            }
            _ => (false, false),
        };
        if is_wanted {
            let text = member.syntax().text().to_string();
            let own = within.into_iter().filter(is_own);
            let names =
                own.map(|(at, name)| (Span::new(at.start - span.start, at.end - span.start), name));
            members.push(Copied { text, names: names.collect(), is_thing });
        }
    }
    let header = header(&state.text);
    let places = paths.iter().flat_map(|path| places(state, path)).collect();
    let measure = Measure::of(document);
    Ok(Clip { things, relations, members, places, header, measure })
}

/// Returns where the places of a thing are, by their paths.
fn places(state: &State, path: &Path) -> Vec<(Path, (f64, f64))> {
    let (structure, document) = (&state.structure, &state.lowered.document);
    let mut found = Vec::new();
    let mut open: Vec<_> = thing_at(state, path).map(|t| (t, path.clone())).into_iter().collect();
    while let Some((thing, path)) = open.pop() {
        if found.len() >= MOST_PLACES {
            return Vec::new();
        }
        match drag::coordinates(structure, structure.merged[thing]) {
            Some([(_, x), (_, y)]) => {
                found.push((path, (state.values.numbers[x], state.values.numbers[y])));
            }
            None => open.extend(structure.parts(structure.merged[thing]).filter_map(|part| {
                let name = structure.field_name(document, part)?;
                Some((part, path.then(Step::Part(name.clone()))))
            })),
        }
    }
    found
}

/// What a text uses, and the classes and units that it declares.
fn header(text: &str) -> Vec<String> {
    let file = syntax::parse(base::FileId(0), text).file();
    let is_of_it = |m: &Member| matches!(m, Member::Use(_) | Member::Class(_) | Member::Unit(_));
    let said = |m: Member| m.syntax().text().to_string().trim().to_string();
    file.members().filter(is_of_it).map(said).collect()
}

/// Returns where a text names things of the document itself.
fn heads(text: &str, state: &State) -> BTreeMap<Span, Name> {
    let load = |name: &str| {
        let file = state.lowered.files.iter().find(|(_, file)| file.name == name);
        file.map(|(_, file)| file.text.to_string())
    };
    let head = |mention: Mention| match (mention.meant, mention.path.0.as_slice()) {
        (Meant::Part | Meant::Message, [Step::Part(name)]) => Some((mention.span, name.clone())),
        _ => None,
    };
    lang::mentions(text, &load).into_iter().filter_map(head).collect()
}

/// Returns the command that puts copies into a document, and what they are called.
///
/// # Errors
/// They speak of what is not there.
pub(crate) fn pasting(
    open: &Open,
    host: &dyn Host,
    clip: &Clip,
    aside: u32,
) -> Result<(Command, Vec<String>), Refusal> {
    let measured = lengths::measured(clip, &open.state.lowered.document, host)?;
    let names = free_names(&open.state, &clip.things);
    let called = |name: &Name| names.get(name).cloned().unwrap_or_else(|| name.to_string());
    let written = |(copied, units): (&Copied, &Vec<TextEdit>)| {
        let names = { copied.names.iter() }
            .map(|(span, name)| TextEdit { span: *span, insert: called(name) });
        let edits: Vec<TextEdit> = names.chain(units.iter().cloned()).collect();
        syntax::edit::apply(&copied.text, &edits).trim().to_string()
    };
    let members: Vec<String> = clip.members.iter().zip(&measured.edits).map(written).collect();
    let own = match clip.relations {
        Relations::Own => of_classes(&open.state.text),
        Relations::All => open.state.text.clone(),
    };
    let with_members = |base: &str, members: &[String]| {
        Open::of(&open.name, format!("{base}\n{}\n", members.join("\n")), host)
    };
    let with = |base: &str| with_members(base, &members);
    let before = Open::of(&open.name, format!("{own}\n"), host);
    let (mut base, mut trial) = (own.clone(), with(&own));
    let mut brought: Vec<String> = Vec::new();
    let errors = |open: &Open| {
        let errors =
            { open.state.diagnostics.iter() }.filter(|d| d.severity == base::Severity::Error);
        errors.map(|d| d.message.clone()).collect::<Vec<String>>()
    };
    if errors(&trial).len() > errors(&before).len() {
        // what the copies mean comes along, where it is not there
        let known = header(&own);
        let has_unit = open.state.lowered.document.unit.is_some();
        let is_known =
            |said: &&String| known.contains(said) || has_unit && said.starts_with("unit ");
        brought = clip.header.iter().filter(|said| !is_known(said)).cloned().collect();
        base = format!("{}\n{own}", brought.join("\n"));
        trial = with(&base);
    }
    let unit = clip.header.iter().find(|said| said.starts_with("unit "));
    let lowered = &open.state.lowered;
    if let Some(unit) = unit.filter(|unit| !brought.contains(unit))
        && lowered.document.unit.is_none()
        && !lowered.measures_lengths()
    {
        // the copies' bare lengths stay what they are, and those of the sheet are of no unit yet
        brought.insert(0, unit.clone());
        base = format!("{}\n{own}", brought.join("\n"));
        trial = with(&base);
    }
    if errors(&trial).len() > errors(&before).len() {
        let first = errors(&trial).pop().unwrap_or_default();
        let message = match clip.relations {
            Relations::Own => format!(
                "the copy speaks of what is not copied: {first}; copy it with its relations, or with what it speaks of"
            ),
            Relations::All => format!("the copy cannot stand here: {first}"),
        };
        return Err(words::refuse(message));
    }
    // what is locked is put aside with the rest, and locked there
    let is_lock = |member: &&String| member.starts_with("anchor ");
    if members.iter().any(|member| is_lock(&member)) {
        let movable: Vec<String> = members.iter().filter(|m| !is_lock(m)).cloned().collect();
        trial = with_members(&base, &movable);
    }
    let copies: Vec<String> = clip.things.iter().map(|(name, _)| called(name)).collect();
    let far = f64::from(aside) * across(&trial.state.lowered.document) / ASIDE;
    let is_placed = clip.relations == Relations::Own
        && put_aside(&mut trial, host, (clip, measured.scale), &called, far);
    let moved = is_placed || move_aside(&mut trial, host, &copies, far);
    let is_kept = |text: &str| text.starts_with(base.trim_end());
    let moved = moved && (clip.relations == Relations::Own || is_kept(&trial.state.text));
    let written = Written::of(&trial.state.text);
    let said = |(copied, member): (&Copied, &String)| {
        let name = copied.names.first().filter(|_| copied.is_thing && moved);
        let now = name.and_then(|(_, name)| written.member(&called(name)));
        now.unwrap_or_else(|| member.clone())
    };
    let long: Vec<String> = clip.members.iter().zip(&members).map(said).collect();
    let short = |(was, now): (&String, &String)| digits::as_short_as(was, now, far);
    let short: Vec<String> = members.iter().zip(&long).map(short).collect();
    let is_short = short == long || digits::is_like(&with_members(&base, &short), &trial);
    let members = if is_short { short } else { long };
    let members: Vec<String> = brought.into_iter().chain(members).collect();
    Ok((Command::Edit { target: Path::default(), members: members.join("\n") }, copies))
}

/// Returns what copies are called in a document: as they were, where nothing is called so yet.
fn free_names(state: &State, things: &[(Name, Name)]) -> BTreeMap<Name, String> {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    let mut names = BTreeMap::new();
    // up to which number the names of a stem are taken
    let mut counted: BTreeMap<String, usize> = BTreeMap::new();
    let is_free = |name: &str, taken: &BTreeSet<String>| {
        let path = Path(vec![Step::Part(Name::new(name))]);
        !taken.contains(name) && !recognise::is_taken(state, &path)
    };
    for (name, class) in things {
        let first = recognise::free_name(state, class);
        let stem = first.trim_end_matches(|c: char| c.is_ascii_digit()).to_string();
        let found = [name.to_string(), first].into_iter().find(|name| is_free(name, &taken));
        let found = found.or_else(|| {
            let next = counted.entry(stem.clone()).or_insert(2);
            *next = (*next..).find(|i| is_free(&format!("{stem}{i}"), &taken))?;
            Some(format!("{stem}{next}"))
        });
        let found = found.unwrap_or_default();
        taken.insert(found.clone());
        names.insert(name.clone(), found);
    }
    names
}

/// Puts every place of the copies as far aside of where it was; where that cannot be they stay,
/// and false is returned.
fn put_aside(
    trial: &mut Open,
    host: &dyn Host,
    (clip, scale): (&Clip, f64),
    called: &dyn Fn(&Name) -> String,
    far: f64,
) -> bool {
    let target = |(path, (x, y)): &(Path, (f64, f64))| {
        let (Step::Part(name), rest) = path.0.split_first()? else { return None };
        let first = Step::Part(Name::new(&called(name)));
        let path = Path(std::iter::once(first).chain(rest.iter().cloned()).collect());
        let place = [x, y].map(|x| Literal::Number(scale * x + far)).to_vec();
        Some((path, Literal::Tuple(place)))
    };
    let Some(targets) = clip.places.iter().map(target).collect::<Option<Vec<_>>>() else {
        return false;
    };
    !targets.is_empty() && apply::apply(trial, host, &Command::Move(targets)).is_ok()
}

/// Moves things together; where that cannot be kept they stay, and false is returned.
fn move_aside(trial: &mut Open, host: &dyn Host, names: &[String], far: f64) -> bool {
    let paths = names.iter().map(|name| Path(vec![Step::Part(Name::new(name))]));
    let has_place = |path: &Path| {
        let thing = thing_at(&trial.state, path);
        thing.is_some_and(|thing| drag::has_place(&trial.state.structure, thing))
    };
    let paths: Vec<Path> = paths.filter(has_place).collect();
    if paths.is_empty() || drag::begin(trial, &paths).is_err() {
        return false;
    }
    let state = trial.state.clone();
    let Some(mut drag) = trial.drag.take() else { return false };
    let (x, y) = drag.handle();
    drag.to(&state, &mut trial.planner, (x + far, y + far));
    drag.release(trial, host).is_ok()
}

/// Returns the command that deletes several things with all that speaks of them, and what else goes.
///
/// # Errors
/// One of them cannot be deleted.
pub(crate) fn deletion(
    open: &Open,
    host: &dyn Host,
    paths: &[Path],
) -> Result<(Command, Vec<String>), Refusal> {
    let written = Written::of(&open.state.text);
    let own: BTreeSet<String> =
        paths.iter().filter_map(|path| written.member(&path.to_string())).collect();
    let (mut trial, mut along) = match deleted_together(open, host, paths) {
        Some(done) => done,
        None => deleted_one_by_one(open, host, paths)?,
    };
    for name in loosened(&open.state, &trial.state) {
        let path = Path(vec![Step::Part(name.clone())]);
        along.push(written.member(&name).unwrap_or_default());
        apply::apply(&mut trial, host, &Command::Delete(path))?;
    }
    along.retain(|said| !own.contains(said.trim()));
    along.dedup();
    match paths {
        // as it is deleted by itself: the step has its name
        [only] if along.is_empty() => Ok((Command::Delete(only.clone()), along)),
        _ => Ok((Command::Text(trial.state.text.clone()), along)),
    }
}

/// Deletes several things in one step, in a copy of the document, and returns what went along; nothing where that takes
/// one step for each.
fn deleted_together(open: &Open, host: &dyn Host, paths: &[Path]) -> Option<(Open, Vec<String>)> {
    let (first, _) = paths.split_first().filter(|(_, others)| !others.is_empty())?;
    let done = lang::edits_to_delete(&open.state.lowered, paths)?;
    let mut trial = open.trial();
    let change = apply::restructured_by(&mut trial, host, &Command::Delete(first.clone()), done);
    Some((trial, change.ok()?.along))
}

/// Deletes things one after the other.
///
/// # Errors
/// One of them cannot be deleted.
fn deleted_one_by_one(
    open: &Open,
    host: &dyn Host,
    paths: &[Path],
) -> Result<(Open, Vec<String>), Refusal> {
    let mut trial = open.trial();
    let mut along: Vec<String> = Vec::new();
    let is_there = |state: &State, path: &Path| {
        thing_at(state, path).is_some()
            || crate::prototype::class_of(state, path).is_some()
            || !member_of(&state.text, &path.to_string()).is_empty()
    };
    // what is said goes before what it is said of, the last first: those before it keep their numbers
    let (parts, mut said): (Vec<&Path>, Vec<&Path>) =
        paths.iter().partition(|path| is_there(&open.state, path));
    said.sort_by_key(|path| {
        let name = path.to_string();
        std::cmp::Reverse((name.len(), name))
    });
    for path in said.iter().chain(&parts) {
        // what goes with another is gone already
        if parts.contains(path) && !is_there(&trial.state, path) {
            continue;
        }
        along.extend(apply::along(&trial.state, path));
        apply::apply(&mut trial, host, &Command::Delete((*path).clone()))?;
    }
    Ok((trial, along))
}

/// The members of a text that declare things or say what is computed, by name.
struct Written(BTreeMap<String, SyntaxNode>);

impl Written {
    fn of(text: &str) -> Self {
        let mut all = BTreeMap::new();
        for member in syntax::parse(base::FileId(0), text).file().members() {
            let names: Vec<_> = match &member {
                Member::Part(part) => part.names().collect(),
                Member::Message(message) => message.name().into_iter().collect(),
                _ => continue,
            };
            for name in names {
                all.entry(name.text().to_string()).or_insert_with(|| member.syntax().clone());
            }
        }
        Self(all)
    }

    /// The member that declares a name, as it is written.
    fn member(&self, name: &str) -> Option<String> {
        self.0.get(name).map(|node| node.text().to_string().trim().to_string())
    }
}

/// Returns the dimensions of a document that measured more before than they do after something is gone.
fn loosened(before: &State, after: &State) -> Vec<Name> {
    let has_less = |name: &Name| {
        let (was, is) = (measured(before, name), measured(after, name));
        was.zip(is).is_some_and(|(was, is)| is < was)
    };
    dimensions(before).into_iter().filter(has_less).collect()
}

/// Returns what the dimensions of a document are called.
fn dimensions(state: &State) -> Vec<Name> {
    let document = &state.lowered.document;
    let Some(class) = document.class_named(&Name::new("Dimension")) else { return Vec::new() };
    let parts = state.structure.parts(DOCUMENT);
    let dimensions = parts.filter(|&t| document.is_a(state.structure.things[t].class, class));
    dimensions.filter_map(|t| state.structure.field_name(document, t).cloned()).collect()
}

/// Counts the things that a dimension measures: its parts that are things, and are shared with others or given.
fn measured(state: &State, name: &Name) -> Option<usize> {
    let thing = thing_at(state, &Path(vec![Step::Part(name.clone())]))?;
    let (document, structure) = (&state.lowered.document, &state.structure);
    let given = given_in(&state.text, name);
    let fields = document.layout(structure.things[thing].class).into_iter();
    let is_measured = |field: &kernel::PartRef| {
        let name = document.field_name(*field);
        let class = &document.classes[document.field_class(*field)];
        let shared = || {
            let part = structure.part_named(thing, name)?;
            Some(structure.is_merged(part))
        };
        class.kind == ClassKind::Composite && (given.contains(name) || shared().unwrap_or(false))
    };
    Some(fields.filter(is_measured).count())
}

/// Returns the parts that the body of a member gives a thing: `from` of `d: Distance { from = a }`. A place in numbers
/// is none.
fn given_in(text: &str, name: &str) -> BTreeSet<Name> {
    let file = syntax::parse(base::FileId(0), text).file();
    let body = file.members().find_map(|member| match member {
        Member::Part(part) if part.names().any(|word| word.text() == name) => part.body(),
        _ => None,
    });
    let members = body.into_iter().flat_map(|body| body.members());
    let given = members.filter_map(|member| match member {
        Member::Assign(assign) if !matches!(assign.value(), Some(Value::Expr(Expr::Tuple(_)))) => {
            Some(assign.target()?.syntax().text().to_string())
        }
        _ => None,
    });
    given.map(|target| Name::new(target.trim())).collect()
}

/// Returns true where a dimension measures what is deleted, and goes with it.
pub(crate) fn is_measured(open: &Open, host: &dyn Host, path: &Path) -> bool {
    if dimensions(&open.state).is_empty() {
        return false;
    }
    let mut trial = Open::of(&open.name, open.state.text.clone(), host);
    let gone = apply::apply(&mut trial, host, &Command::Delete(path.clone()));
    gone.is_ok() && !loosened(&open.state, &trial.state).is_empty()
}
