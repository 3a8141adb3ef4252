//! Completion: the words that may stand where someone writes.

use crate::recognise::is_candidate;
use crate::state::State;
use crate::view::CompletionView;
use crate::vocabulary;
use base::{FileId, Name};
use kernel::{ClassId, ClassKind, Document, Primitive, Step};
use syntax::ast::{self, AstNode};
use syntax::{SyntaxKind, SyntaxNode};

/// The words that a member of the document, a class or a part can begin with.
const STATEMENTS: [&str; 21] = [
    "anchor",
    "attachers",
    "check",
    "choice",
    "class",
    "constant",
    "constraint",
    "family",
    "for",
    "handle",
    "lesson",
    "merge",
    "modify",
    "program",
    "replace",
    "stay",
    "toolbox",
    "use",
    "view",
    "when",
    "without",
];

/// Returns the words that can go on at an offset of a text, which may be newer than the state.
///
/// After a dot these are the parts and messages of what stands before it; after a colon the classes; after a number
/// and a space the units; after `use` the libraries, of these names. Else what the bodies around have, the innermost
/// first, then the document's things and classes, the functions and quantities. Nothing in a comment or a text.
pub(crate) fn completions(
    state: &State,
    text: &str,
    offset: u32,
    libraries: &[String],
) -> Vec<CompletionView> {
    let Some(before) = text.get(..offset as usize) else { return Vec::new() };
    let tree = syntax::parse(FileId(0), text).syntax();
    let left = tree.token_at_offset(offset.into()).left_biased();
    let is_prose = |kind| {
        matches!(
            kind,
            SyntaxKind::LineComment
                | SyntaxKind::BlockComment
                | SyntaxKind::DocComment
                | SyntaxKind::Text
        )
    };
    if left.as_ref().is_some_and(|token| is_prose(token.kind())) {
        return Vec::new();
    }
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '[' | ']');
    let start = before.trim_end_matches(is_word).len();
    let (left_of_word, word) = before.split_at(start);
    let bodies = bodies(state, left.and_then(|token| token.parent()).as_ref(), offset);
    if let Some((owner, _)) = word.rsplit_once('.') {
        if owner.parse::<f64>().is_ok() {
            return Vec::new();
        }
        return after_dot(state, &bodies, owner);
    }
    if after_number(left_of_word) {
        return units();
    }
    if left_of_word.trim_end_matches(' ').rsplit('\n').next().map(str::trim) == Some("use") {
        return libraries.iter().map(|library| one(library, "module", "")).collect();
    }
    let mut types = classes(state);
    let mut choices: Vec<&Name> = options(state).map(|(choice, _)| choice).collect();
    choices.dedup();
    types.extend(choices.into_iter().map(|choice| one(choice, "class", "")));
    types
        .extend(vocabulary::quantities().into_iter().map(|(name, unit)| one(name, "class", &unit)));
    if left_of_word.trim_end().ends_with(':') {
        return types;
    }
    let mut words: Vec<CompletionView> = Vec::new();
    for &body in &bodies {
        words.extend(
            members(state, body)
                .filter(|w| words.iter().all(|known| known.label != w.label))
                .collect::<Vec<_>>(),
        );
    }
    words.extend(types);
    words.extend(options(state).map(|(choice, option)| one(option, "enum", choice)));
    words.extend(vocabulary::functions().into_iter().map(|f| one(f.name, "function", &f.call)));
    if matches!(
        left_of_word.trim_end_matches([' ', '\t']).chars().next_back(),
        None | Some('\n' | '{')
    ) {
        words.extend(STATEMENTS.map(|statement| one(statement, "keyword", "")));
    }
    words
}

/// Returns the classes whose members can be named at a place, the innermost body's first, the document's last.
fn bodies(state: &State, node: Option<&SyntaxNode>, offset: u32) -> Vec<ClassId> {
    let document = &state.lowered.document;
    let within = |body: Option<ast::Body>| {
        body.is_some_and(|body| {
            let span = body.syntax().text_range();
            u32::from(span.start()) < offset && offset <= u32::from(span.end())
        })
    };
    let class_around = |node: SyntaxNode| {
        if let Some(class) = ast::Class::cast(node.clone()) {
            return within(class.body())
                .then(|| document.class_named(class.name()?.text()))
                .flatten();
        }
        let part = ast::Part::cast(node)?;
        within(part.body())
            .then(|| document.class_named(part.class()?.syntax().text().to_string().trim()))
            .flatten()
    };
    let mut bodies: Vec<ClassId> =
        node.into_iter().flat_map(SyntaxNode::ancestors).filter_map(class_around).collect();
    bodies.push(document.root);
    bodies
}

/// Returns what a path ends at has for words.
fn after_dot(state: &State, bodies: &[ClassId], owner: &str) -> Vec<CompletionView> {
    let document = &state.lowered.document;
    let path = crate::session::parse_path(owner);
    let leads = |&body: &ClassId| {
        { path.as_ref()?.0.iter() }.try_fold(body, |class, step| part_class(document, class, step))
    };
    if let Some(class) = bodies.iter().find_map(leads) {
        return members(state, class).chain(known_to_all(document, class)).collect();
    }
    let of_choice: Vec<CompletionView> = options(state)
        .filter(|(choice, _)| ***choice == *owner)
        .map(|(choice, option)| one(option, "enum", choice))
        .collect();
    match document.class_named(owner) {
        Some(class) if of_choice.is_empty() => to_class(document, class),
        Some(_) | None => of_choice,
    }
}

/// Returns the class of what a step leads to, from a thing of a class.
fn part_class(document: &Document, class: ClassId, step: &Step) -> Option<ClassId> {
    match step {
        Step::Part(name) => {
            let fields = document.layout(class);
            let field = fields.into_iter().find(|&field| document.field_name(field) == name);
            let answers = || document.find_message(class, name, None).and_then(|(_, m)| m.class);
            field.map(|field| document.field_class(field)).or_else(answers)
        }
        Step::Index(_) | Step::Last => match document.classes[class].kind {
            ClassKind::List(element) => Some(element),
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => None,
        },
        Step::Owner => None,
    }
}

/// Returns the parts of a class's things, then what these answer.
fn members(state: &State, class: ClassId) -> impl Iterator<Item = CompletionView> {
    let document = &state.lowered.document;
    let name = move |class: ClassId| document.classes[document.named_class(class)].name.as_str();
    let masters = state.lowered.masters.clone();
    let fields = document
        .layout(class)
        .into_iter()
        .filter(move |&f| Some(document.field_name(f)) != masters.as_ref());
    let parts = fields.map(move |field| {
        one(document.field_name(field), "property", name(document.field_class(field)))
    });
    let lineage =
        document.lineage(class).into_iter().flat_map(|class| &document.classes[class].messages);
    let messages = lineage.filter(|m| !m.is_of_class() && !m.is_default).map(move |m| {
        let labels: Vec<&str> = m.parameters.iter().map(|p| p.label.as_str()).collect();
        match labels.is_empty() {
            true => one(&m.name, "property", m.class.map_or("", name)),
            false => one(&m.name, "method", &format!("({})", labels.join(", "))),
        }
    });
    let mut known: Vec<String> = Vec::new();
    parts.chain(messages).filter(move |word| {
        let is_new = !word.label.is_empty() && !known.contains(&word.label);
        known.push(word.label.clone());
        is_new
    })
}

/// Returns what every text, number or list knows.
fn known_to_all(document: &Document, class: ClassId) -> Vec<CompletionView> {
    let words = match &document.classes[class].kind {
        ClassKind::Primitive(Primitive::Text) => vocabulary::messages_of_texts(),
        ClassKind::Primitive(Primitive::Real(_) | Primitive::Integer) => {
            vocabulary::messages_of_numbers()
        }
        ClassKind::List(_) | ClassKind::Set(_) => vocabulary::messages_of_lists(),
        ClassKind::Primitive(Primitive::Bool | Primitive::Choice(_) | Primitive::Color)
        | ClassKind::Composite
        | ClassKind::Reference(_) => Vec::new(),
    };
    let word = |w: vocabulary::FunctionWord| match w.call.strip_prefix(w.name) {
        Some("") | None => one(w.name, "property", w.answers),
        Some(takes) => one(w.name, "method", takes),
    };
    words.into_iter().map(word).collect()
}

/// Returns what a class itself answers.
fn to_class(document: &Document, class: ClassId) -> Vec<CompletionView> {
    let lineage =
        document.lineage(class).into_iter().flat_map(|class| &document.classes[class].messages);
    let messages = lineage.filter(|m| m.is_of_class());
    messages.map(|m| one(m.word(), "method", &m.name[m.word().len()..])).collect()
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

fn classes(state: &State) -> Vec<CompletionView> {
    let document = &state.lowered.document;
    let named = document.classes.iter().filter(|(c, class)| is_candidate(state, *c, class));
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
