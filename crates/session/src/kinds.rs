//! Kinds: a class that inherits from that of a thing, by the thing's example; and what one thing has of its own, said
//! of every thing of its class.
//!
//! In: a thing, or something said of it. Out: the text in which its rules and parts are a class's. What the document
//! says of that thing alone goes with it; its places stay its own.

use crate::apply::restructuring;
use crate::classing::{goes, is_class_name, known, refuse_new_errors, spoken};
use crate::document::Open;
use crate::host::Host;
use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::Span;
use kernel::{Command, Path, Step};
use plan::Plans;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Member, Part};
use syntax::edit::{TextEdit, apply, delete_member};
use syntax::{SyntaxKind, SyntaxNode};

/// Returns the command by which a thing of the document is of a class of its own kind, which inherits from its class.
///
/// # Errors
/// It is no whole thing of the document, the name is none for a class, or what would be said has an error.
pub(crate) fn kind_of(
    open: &Open,
    host: &dyn Host,
    path: &Path,
    class: &str,
) -> Result<Command, Refusal> {
    let state = &open.state;
    is_class_name(state, class)?;
    let file = state.file();
    let name = match path.0.as_slice() {
        [Step::Part(name)] => name.to_string(),
        _ => return Err(words::refuse(format!("{path} is a part: choose the whole"))),
    };
    let declares = |part: &Part| part.names().any(|word| word.text() == name);
    let part = { file.members() }.find_map(|member| match member {
        Member::Part(part) if declares(&part) => Some(part),
        _ => None,
    });
    let Some((part, above)) = part.and_then(|part| Some((part.clone(), part.class()?))) else {
        return Err(words::refuse(format!("{path} is no thing that the document declares")));
    };
    if part.names().count() > 1 {
        return Err(words::refuse(format!("{path} is declared with others: declare it alone")));
    }
    let mut members: Vec<String> = Vec::new();
    let mut own: Vec<String> = Vec::new();
    for member in part.body().into_iter().flat_map(|body| body.members()) {
        let text = member.syntax().text().to_string().trim().to_string();
        match is_place_given(state, &name, &member) {
            true => own.push(text),
            false => members.push(text),
        }
    }
    let (chosen, known) = (BTreeSet::from([name.clone()]), known(state));
    let mut edits: Vec<TextEdit> = Vec::new();
    for member in file.members() {
        let is_rule = matches!(member, Member::Constraint(_) | Member::Merge(_));
        if is_rule
            && goes(&member, &chosen, &known)?
            && let Some(said) = within(member.syntax(), &name)
        {
            members.push(said);
            edits.push(delete_member(member.syntax()));
        }
    }
    let start = u32::from(part.syntax().text_range().start());
    let declared = format!(
        "class {class} is {}{}\n\n",
        above.syntax().text(),
        body_of(&members).unwrap_or_default()
    );
    edits.push(TextEdit { span: Span::new(start, start), insert: declared });
    let end = part.body().map_or(above.span().end, |body| body.span().end);
    let thing = format!("{class}{}", body_of(&own).unwrap_or_default());
    edits.push(TextEdit { span: Span::new(above.span().start, end), insert: thing });
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let text = apply(&state.text, &edits);
    let trial = State::of(text.clone(), Some(state), host, Plans::default()).0;
    refuse_new_errors(state, &trial, "these cannot be a class")?;
    Ok(Command::Text(text))
}

/// Returns the command by which something that one thing has of its own, a rule or a part, is of every thing of its
/// class.
///
/// # Errors
/// Its class is not declared by the document, it speaks of other things too, or what would be said has an error.
pub(crate) fn of_every(open: &Open, host: &dyn Host, path: &Path) -> Result<Command, Refusal> {
    let state = &open.state;
    let done = restructuring(state, &Command::Delete(path.clone()))?;
    let file = state.file();
    let known = known(state);
    let mut owner: Option<String> = None;
    let mut members: Vec<String> = Vec::new();
    for edit in &done.edits {
        let (member, is_top) = member_within(file.syntax(), edit.span)
            .ok_or_else(|| words::refuse(format!("{path} is declared with others")))?;
        let text = member.text().to_string().trim().to_string();
        let (of, said) = if is_top {
            let spoken = spoken(&member, &known);
            let name = spoken.first().map(|(_, name)| (*name).to_string()).unwrap_or_default();
            if spoken.iter().any(|(_, other)| **other != *name) {
                let message = format!("{path} speaks of more than one thing");
                return Err(words::refuse(message));
            }
            let said = within(&member, &name);
            let said =
                said.ok_or_else(|| words::refuse(format!("{path} is of {name} as a whole")))?;
            (name, said)
        } else {
            let above = member.ancestors().filter_map(Part::cast).last();
            let name = above.and_then(|part| part.names().next().map(|w| w.text().to_string()));
            (name.unwrap_or_default(), text)
        };
        if owner.get_or_insert(of.clone()) != &of {
            return Err(words::refuse(format!("{path} speaks of more than one thing")));
        }
        members.push(said);
    }
    let owner = owner.unwrap_or_default();
    let thing = parse_path(&owner).and_then(|path| thing_at(state, &path));
    let Some(thing) = thing else {
        return Err(words::refuse(format!("{path} is not of one thing of the document")));
    };
    let class = words::class_name(state, thing);
    if !state.lowered.declares_class(&class) {
        let message = format!("{owner} is a {class}, which this document does not declare");
        let mut refusal = words::refuse(message);
        refusal.repairs.push(format!("make a kind of {owner} first: a class of its own"));
        return Err(refusal);
    }
    let without = apply(&state.text, &done.edits);
    let without = State::of(without, Some(state), host, Plans::default()).0;
    let target = parse_path(&class).unwrap_or_default();
    let said = Command::Edit { target, members: members.join("\n") };
    let mut trial = Open::of(&open.name, without.text.clone(), host);
    let done = crate::apply::apply(&mut trial, host, &said);
    if done.is_err() {
        // its text says what is wrong
        let text = apply(&without.text, &restructuring(&without, &said)?.edits);
        let wrong = State::of(text, Some(state), host, Plans::default()).0;
        refuse_new_errors(state, &wrong, "this cannot be of every one")?;
        done?;
    }
    Ok(Command::Text(trial.state.text.clone()))
}

/// Returns the member that a deletion takes away, and whether it stands at the top of the text.
fn member_within(file: &SyntaxNode, deleted: Span) -> Option<(SyntaxNode, bool)> {
    let range = |node: &SyntaxNode| {
        let range = node.text_range();
        (u32::from(range.start()), u32::from(range.end()))
    };
    let is_within = |node: &SyntaxNode| {
        let (start, end) = range(node);
        deleted.start <= start && end <= deleted.end
    };
    let member = file.descendants().find(|n| Member::cast(n.clone()).is_some() && is_within(n))?;
    let is_top = member.parent().is_some_and(|above| above.kind() == SyntaxKind::File);
    Some((member, is_top))
}

/// Returns what a member says of a thing's parts as its class says it; nothing where it speaks of the whole.
fn within(member: &SyntaxNode, name: &str) -> Option<String> {
    let start = u32::from(member.text_range().start());
    let text = member.text().to_string();
    let names = BTreeSet::from([name.to_string()]);
    let mut edits = Vec::new();
    for (at, _) in spoken(member, &names) {
        let at = at - start;
        let end = at + name.len() as u32 + 1;
        if text.get(end as usize - 1..end as usize) != Some(".") {
            return None;
        }
        edits.push(TextEdit { span: Span::new(at, end), insert: String::new() });
    }
    Some(apply(&text, &edits).trim().to_string())
}

/// Whether a member of a thing's body gives a place.
fn is_place_given(state: &State, name: &str, member: &Member) -> bool {
    let Member::Assign(assign) = member else { return false };
    let target = assign.target().map(|t| t.syntax().text().to_string()).unwrap_or_default();
    let path = parse_path(&format!("{name}.{}", target.trim()));
    let Some(thing) = path.and_then(|path| thing_at(state, &path)) else { return false };
    let slots = state.structure.slots_under(thing);
    !slots.is_empty() && slots.iter().all(|&s| state.structure.slots[s].place.is_some())
}

/// A body of some members; nothing where there are none.
fn body_of(members: &[String]) -> Option<String> {
    let indented = |member: &String| {
        member.lines().map(|line| format!("    {}", line.trim_end())).collect::<Vec<_>>().join("\n")
    };
    let members: Vec<String> = members.iter().map(indented).collect();
    (!members.is_empty()).then(|| format!(" {{\n{}\n}}", members.join("\n")))
}
