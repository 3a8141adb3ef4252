//! The text of a program: where its steps and parameters stand in it.

use super::Home;
use crate::view::Refusal;
use crate::words;
use base::Span;
use syntax::ast::{AstNode, Expr, Member, Value, span_without_doc};

/// Finds a program in a text.
pub(crate) fn program(text: &str, name: &str) -> Option<syntax::ast::Program> {
    let file = syntax::parse(base::FileId(0), text).file();
    let is_it = |member: Member| match member {
        Member::Program(program) => {
            let named = program.name().is_some_and(|word| word.text() == name);
            named.then_some(program)
        }
        _ => None,
    };
    { file.members() }.find_map(is_it)
}

/// Returns a text with members added at the end of a home.
///
/// # Errors
/// The program is not in the text.
pub(crate) fn with_members(text: &str, home: &Home, members: &str) -> Result<String, Refusal> {
    match home {
        Home::Document => Ok(format!("{}\n{members}\n", text.trim_end())),
        Home::Program { program: name, block: Some(step), .. } => {
            let none = || words::refuse(format!("{name} has no loop {step}"));
            let body = block(text, name, step).ok_or_else(none)?;
            Ok(with_lines(text, &body, 2, members))
        }
        Home::Program { program: name, block: None, .. } => {
            let none = || words::refuse(format!("the document has no program {name}"));
            let body = program(text, name).and_then(|p| p.body()).ok_or_else(none)?;
            Ok(with_lines(text, &body, 1, members))
        }
    }
}

/// Finds the body of a loop of a program.
pub(crate) fn block(text: &str, program_name: &str, step: &str) -> Option<syntax::ast::Body> {
    let body = program(text, program_name)?.body()?;
    match assigned(&body, step)?.value()? {
        Value::Repeat(block) => block.body(),
        _ => None,
    }
}

/// Returns the names of the steps of a loop.
pub(crate) fn steps_of_block(text: &str, program_name: &str, step: &str) -> Vec<String> {
    let Some(body) = block(text, program_name, step) else { return Vec::new() };
    let name = |member: Member| match member {
        Member::Assign(assign) => {
            assign.target().map(|target| target.syntax().text().to_string().trim().to_string())
        }
        _ => None,
    };
    body.members().filter_map(name).collect()
}

/// Where a text speaks of a name: not of a part of something else, and not by a label.
pub(crate) fn places_of(text: &str, name: &str) -> Vec<usize> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let is_name = |&(at, _): &(usize, &str)| {
        let before = text[..at].chars().next_back();
        let rest = &text[at + name.len()..];
        !before.is_some_and(|c| is_word(c) || c == '.')
            && !rest.chars().next().is_some_and(is_word)
            && !rest.trim_start().starts_with(':')
    };
    text.match_indices(name).filter(is_name).map(|(at, _)| at).collect()
}

/// Returns an expression in which a name is another.
pub(crate) fn renamed(text: &str, name: &str, to: &str) -> String {
    let mut text = text.to_string();
    for at in places_of(&text, name).into_iter().rev() {
        text.replace_range(at..at + name.len(), to);
    }
    text
}

/// Adds lines before the closing brace of a body.
pub(crate) fn with_lines(
    text: &str,
    body: &syntax::ast::Body,
    depth: usize,
    lines: &str,
) -> String {
    let span = body.span();
    let inside = &text[span.start as usize..span.end as usize];
    let close = span.start as usize + inside.rfind('}').unwrap_or(inside.len());
    let before = text[..close].trim_end();
    let (indent, outer) = ("    ".repeat(depth), "    ".repeat(depth - 1));
    let lines: Vec<String> = lines.lines().map(|line| format!("{indent}{line}")).collect();
    format!("{before}\n{}\n{outer}{}", lines.join("\n"), &text[close..])
}

/// Returns the bytes of a step, by the names of the blocks around it and its own, and those of its value.
pub(crate) fn step(text: &str, program_name: &str, path: &str) -> Option<(Span, Span)> {
    let mut body = program(text, program_name)?.body()?;
    let names: Vec<&str> = path.split('.').collect();
    let (last, around) = names.split_last()?;
    for name in around {
        body = match assigned(&body, name)?.value()? {
            Value::Repeat(block) => block.body()?,
            Value::While(block) => block.body()?,
            Value::For(block) => block.body()?,
            Value::If(choice) => choice.then_body()?,
            Value::Expr(_) => return None,
        };
    }
    let assign = assigned(&body, last)?;
    Some((span_without_doc(assign.syntax()), assign.value()?.span()))
}

fn assigned(body: &syntax::ast::Body, name: &str) -> Option<syntax::ast::Assign> {
    body.members().find_map(|member| match member {
        Member::Assign(assign) => match assign.target() {
            Some(Expr::Name(word)) if word.syntax().text().to_string().trim() == name => {
                Some(assign)
            }
            _ => None,
        },
        _ => None,
    })
}

/// Returns a text with a parameter added to a program.
///
/// # Errors
/// The program is not in the text.
pub(crate) fn with_parameter(text: &str, name: &str, parameter: &str) -> Result<String, Refusal> {
    let none = || words::refuse(format!("the document has no program {name}"));
    let program = program(text, name).ok_or_else(none)?;
    let Some(list) = program.params() else {
        let at = program.name().ok_or_else(none)?.span().end as usize;
        return Ok(format!("{}({parameter}){}", &text[..at], &text[at..]));
    };
    let span = list.span();
    let inside = &text[span.start as usize..span.end as usize];
    let close = span.start as usize + inside.rfind(')').unwrap_or(inside.len());
    let before = text[..close].trim_end();
    let has_any = list.params().next().is_some();
    let comma = if has_any && !before.ends_with(',') { "," } else { "" };
    Ok(format!("{before}{comma}\n    {parameter},\n{}", &text[close..]))
}
