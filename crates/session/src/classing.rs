//! A class by example: some things of the document become the parts of a new class, and one thing of it.
//!
//! What speaks of these things alone goes into the class: their constraints, merges and anchors. What speaks of
//! others too stays, and reaches them through the new thing. Values are the prototype's from then on.

use crate::document::Open;
use crate::host::Host;
use crate::recognise;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::{Name, Severity, Span};
use kernel::{Command, DOCUMENT, Path, Step};
use plan::Plans;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Member};
use syntax::edit::{TextEdit, apply, delete_member};
use syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

/// Returns the command that makes a class of some things, and what the one thing of it is called.
///
/// # Errors
/// A path is no thing of the document itself, the name is none for a class, or what would be said has an error.
pub(crate) fn class_of(
    open: &Open,
    host: &dyn Host,
    paths: &[Path],
    class: &str,
) -> Result<(Command, String), Refusal> {
    let state = &open.state;
    let named = class.starts_with(char::is_uppercase) && class.chars().all(char::is_alphanumeric);
    if !named {
        let message = format!("{class}: a class's name is one word that begins with a capital");
        return Err(words::refuse(message));
    }
    if state.lowered.document.class_named(class).is_some() {
        return Err(words::refuse(format!("there is a class {class} already")));
    }
    let mut chosen: BTreeSet<String> = BTreeSet::new();
    for path in paths {
        match path.0.as_slice() {
            [Step::Part(name)] => drop(chosen.insert(name.to_string())),
            _ => return Err(words::refuse(format!("{path} is a part: choose the whole"))),
        }
    }
    if chosen.is_empty() {
        return Err(words::refuse("nothing is selected".into()));
    }
    let document = &state.lowered.document;
    let known: BTreeSet<String> = state
        .structure
        .parts(DOCUMENT)
        .filter_map(|part| state.structure.field_name(document, part).map(ToString::to_string))
        .collect();
    let thing = recognise::free_name(state, &Name::new(class));
    let text = rewritten(&state.text, &chosen, &known, class, &thing)?;
    let trial = State::of(text.clone(), Some(state), host, Plans::default()).0;
    let errors = |s: &State| -> BTreeSet<String> {
        let wrong = s.diagnostics.iter().filter(|d| d.severity == Severity::Error);
        wrong.map(|d| d.message.clone()).collect()
    };
    if let Some(new) = errors(&trial).difference(&errors(state)).next() {
        return Err(words::refuse(format!("these cannot be the parts of a class: {new}")));
    }
    Ok((Command::Text(text), thing))
}

/// Returns the text in which the chosen things are the parts of a class.
fn rewritten(
    text: &str,
    chosen: &BTreeSet<String>,
    known: &BTreeSet<String>,
    class: &str,
    thing: &str,
) -> Result<String, Refusal> {
    let file = syntax::parse(base::FileId(0), text).file();
    let mut body: Vec<String> = Vec::new();
    let mut edits: Vec<TextEdit> = Vec::new();
    let mut at = None;
    for member in file.members() {
        let syntax = member.syntax();
        let goes = match &member {
            Member::Part(part) => {
                let names: Vec<bool> = part.names().map(|w| chosen.contains(w.text())).collect();
                if names.contains(&true) && names.contains(&false) {
                    let message = "things that are declared together are chosen together";
                    return Err(words::refuse(message.into()));
                }
                names.contains(&true)
            }
            Member::Constraint(_)
            | Member::Merge(_)
            | Member::Anchor(_)
            | Member::Stay(_)
            | Member::Side(_)
            | Member::Assign(_) => {
                let spoken: BTreeSet<&str> =
                    spoken(syntax, known).iter().map(|(_, n)| *n).collect();
                !spoken.is_empty() && spoken.iter().all(|name| chosen.contains(*name))
            }
            Member::Class(_) | Member::Use(_) => continue,
            _ => false,
        };
        if goes {
            at = at.or(Some(u32::from(syntax.text_range().start())));
            let own = syntax.text().to_string();
            let lines = own.trim().lines().map(|line| format!("    {line}"));
            body.push(lines.collect::<Vec<_>>().join("\n"));
            edits.push(delete_member(syntax));
        } else {
            let through = |(start, _): (u32, &str)| TextEdit {
                span: Span::new(start, start),
                insert: format!("{thing}."),
            };
            let spoken = spoken(syntax, chosen).into_iter();
            edits.extend(spoken.map(through));
        }
    }
    let Some(at) = at else { return Err(words::refuse("nothing is selected".into())) };
    let said = format!("class {class} {{\n{}\n}}\n\n{thing}: {class}\n", body.join("\n"));
    edits.push(TextEdit { span: Span::new(at, at), insert: said });
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    Ok(apply(text, &edits))
}

/// Returns where a member speaks of things by their own names, and these.
fn spoken<'n>(syntax: &SyntaxNode, names: &'n BTreeSet<String>) -> Vec<(u32, &'n str)> {
    let mut found = Vec::new();
    let mut after_dot = false;
    let tokens = syntax.descendants_with_tokens().filter_map(SyntaxElement::into_token);
    for token in tokens.filter(|token| !token.text().trim().is_empty()) {
        if token.kind() == SyntaxKind::Ident
            && !after_dot
            && let Some(name) = names.get(token.text())
        {
            found.push((u32::from(token.text_range().start()), name.as_str()));
        }
        after_dot = token.kind() == SyntaxKind::Dot;
    }
    found
}
