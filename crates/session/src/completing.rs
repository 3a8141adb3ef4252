//! Completion: the words that may stand where someone writes.

use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::view::CompletionView;
use crate::vocabulary;
use base::Name;
use kernel::{DOCUMENT, ThingId};

/// Returns the words that can go on at an offset of a text, which may be newer than the state.
///
/// After a dot these are the parts of what stands before it; after a number and a space the units; else the
/// document's things and classes, the functions and quantities.
pub(crate) fn completions(state: &State, text: &str, offset: u32) -> Vec<CompletionView> {
    let Some(before) = text.get(..offset as usize) else { return Vec::new() };
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '[' | ']');
    let start = before.trim_end_matches(is_word).len();
    let (left, word) = before.split_at(start);
    if let Some((owner, _)) = word.rsplit_once('.') {
        if owner.parse::<f64>().is_ok() {
            return Vec::new();
        }
        let thing = parse_path(owner).and_then(|path| thing_at(state, &path));
        let of_choice = || options(state).filter(|(choice, _)| **choice == *owner);
        return match thing {
            Some(thing) => parts(state, thing),
            None => of_choice().map(|(choice, option)| one(option, "enum", choice)).collect(),
        };
    }
    if after_number(left) {
        return units();
    }
    let mut words = parts(state, DOCUMENT);
    words.extend(classes(state));
    let mut choices: Vec<&Name> = options(state).map(|(choice, _)| choice).collect();
    choices.dedup();
    words.extend(choices.into_iter().map(|choice| one(choice, "class", "")));
    words.extend(options(state).map(|(choice, option)| one(option, "enum", choice)));
    words.extend(vocabulary::functions().into_iter().map(|f| one(f.name, "function", &f.call)));
    words
        .extend(vocabulary::quantities().into_iter().map(|(name, unit)| one(name, "class", &unit)));
    words
}

fn one(label: &str, kind: &str, detail: &str) -> CompletionView {
    CompletionView { label: label.into(), kind: kind.into(), detail: detail.into() }
}

/// Whether a text ends in a number and a space.
fn after_number(left: &str) -> bool {
    let trimmed = left.trim_end_matches(' ');
    let number = trimmed.rsplit(|c: char| !(c.is_ascii_digit() || c == '.' || c == 'e')).next();
    trimmed.len() < left.len() && number.is_some_and(|number| number.parse::<f64>().is_ok())
}

fn parts(state: &State, thing: ThingId) -> Vec<CompletionView> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let named = |part: ThingId| {
        let path = structure.path(document, part).to_string();
        let name = path.rsplit('.').next().unwrap_or(&path);
        let class = &document.classes[document.named_class(structure.things[part].class)].name;
        (!name.contains('[')).then(|| one(name, "property", class.as_str()))
    };
    structure.parts(thing).filter_map(named).collect()
}

fn classes(state: &State) -> Vec<CompletionView> {
    let document = &state.lowered.document;
    let is_candidate =
        |c: kernel::ClassId| crate::recognise::is_candidate(state, c, &document.classes[c]);
    let named = document.classes.iter().filter(|(c, _)| is_candidate(*c));
    named.map(|(_, class)| one(class.name.as_str(), "class", "")).collect()
}

/// Returns every option that a document can name, with its choice before it.
fn options(state: &State) -> impl Iterator<Item = (&Name, &Name)> {
    let classes = state.lowered.document.classes.iter();
    classes.flat_map(|(_, class)| class.options.iter().map(move |option| (&class.name, option)))
}

fn units() -> Vec<CompletionView> {
    let unit =
        |u: vocabulary::UnitWord| one(u.spelling, "unit", &format!("{}, {}", u.name, u.quantity));
    vocabulary::units().into_iter().map(unit).collect()
}
