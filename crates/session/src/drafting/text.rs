//! The text of a program: where its steps, blocks and parameters stand in it.
//!
//! An *address* names a step by the blocks around it: `column.ring`. A block without a name is `#0`, `#1`, … by its
//! place among those of its body; the branches of an `if` are `then` and `else`: `#0.else.line`. `else if` counts as
//! an `else` whose only member is an `if`.

use super::Home;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::Span;
use std::collections::BTreeSet;
use syntax::ast::{self, AstNode, Else, Expr, Member, Value, span_without_doc};
use syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

/// Where a walk along an address has got to.
enum Inside {
    /// The members of a body.
    Body(ast::Body),
    /// What stands after `else`: an `if` alone.
    If(ast::If),
}

/// A member of a body that a run does something for.
pub(crate) struct StepNode {
    /// Its segment of an address: its name, or `#0`.
    pub(crate) segment: String,
    /// Its name, where it has one.
    pub(crate) name: Option<String>,
    /// Its bytes, without its doc comment.
    pub(crate) span: Span,
    /// What it is; nothing for `erase`.
    pub(crate) value: Option<Value>,
    /// Whether it is drawn for construction alone.
    pub(crate) is_guide: bool,
}

/// A text with its tree.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    text: String,
    file: ast::File,
}

impl Source {
    /// Parses a text.
    pub(crate) fn of(text: String) -> Self {
        let file = syntax::parse(base::FileId(0), &text).file();
        Self { text, file }
    }

    /// The text of a state: its tree is there already.
    pub(crate) fn now(state: &State) -> Self {
        match state.lowered.files.iter().next() {
            Some((_, own)) => Self::of_file(own),
            None => Self::of(state.text.clone()),
        }
    }

    /// A text that was read with its tree.
    pub(crate) fn of_file(file: &lang::File) -> Self {
        Self { text: file.text.to_string(), file: file.parse.file() }
    }
}

impl std::ops::Deref for Source {
    type Target = str;
    fn deref(&self) -> &str {
        &self.text
    }
}

/// Finds a program in a text.
pub(crate) fn program(text: &Source, name: &str) -> Option<ast::Program> {
    let file = &text.file;
    let is_it = |member: Member| match member {
        Member::Program(program) => {
            let named = program.name().is_some_and(|word| word.text() == name);
            named.then_some(program)
        }
        _ => None,
    };
    { file.members() }.find_map(is_it)
}

/// Lists the steps of a body in order, messages and demands apart.
pub(crate) fn steps_of(body: &ast::Body) -> Vec<StepNode> {
    let mut unnamed = 0;
    let steps = body.members().filter_map(|member| {
        let word = word_of(&member)?;
        let segment = segment_of(word.as_ref(), &mut unnamed);
        step_of(member, word, segment)
    });
    steps.collect()
}

/// Finds a step of a body by its segment; the others are passed over by their names alone.
fn step_in(body: &ast::Body, segment: &str) -> Option<StepNode> {
    let mut unnamed = 0;
    for member in body.members() {
        let Some(word) = word_of(&member) else { continue };
        let is_it = match &word {
            Some(word) => word.text() == segment,
            None => segment_of(None, &mut unnamed) == segment,
        };
        if is_it {
            return step_of(member, word, segment.into());
        }
    }
    None
}

/// The name of what a member draws, or that it has none; nothing where it is no step.
#[expect(clippy::option_option, reason = "a step without a name is one")]
fn word_of(member: &Member) -> Option<Option<ast::Word>> {
    match member {
        Member::Assign(assign) => match assign.target() {
            Some(Expr::Name(name)) => name.name().map(Some),
            _ => None,
        },
        Member::If(_)
        | Member::Repeat(_)
        | Member::While(_)
        | Member::For(_)
        | Member::Erase(_) => Some(None),
        _ => None,
    }
}

fn segment_of(word: Option<&ast::Word>, unnamed: &mut usize) -> String {
    match word {
        Some(word) => word.text().to_string(),
        None => {
            *unnamed += 1;
            format!("#{}", *unnamed - 1)
        }
    }
}

fn step_of(member: Member, word: Option<ast::Word>, segment: String) -> Option<StepNode> {
    let span = span_without_doc(member.syntax());
    let (value, is_guide) = match member {
        Member::Assign(assign) => (assign.value(), assign.is_guide()),
        Member::If(choice) => (Some(Value::If(choice)), false),
        Member::Repeat(block) => (Some(Value::Repeat(block)), false),
        Member::While(block) => (Some(Value::While(block)), false),
        Member::For(block) => (Some(Value::For(block)), false),
        Member::Erase(_) => (None, false),
        _ => return None,
    };
    let name = word.map(|word| word.text().to_string());
    Some(StepNode { segment, name, span, value, is_guide })
}

fn only_if(choice: &ast::If) -> StepNode {
    StepNode {
        segment: "#0".into(),
        name: None,
        span: choice.span(),
        value: Some(Value::If(choice.clone())),
        is_guide: false,
    }
}

fn branch(choice: &ast::If, segment: &str) -> Option<Inside> {
    match (segment, choice.else_branch()) {
        ("then", _) => choice.then_body().map(Inside::Body),
        ("else", Some(Else::Body(body))) => Some(Inside::Body(body)),
        ("else", Some(Else::If(choice))) => Some(Inside::If(choice)),
        _ => None,
    }
}

fn inside_of(value: &Value, rest: &mut std::slice::Iter<'_, &str>) -> Option<Inside> {
    match value {
        Value::Repeat(block) => block.body().map(Inside::Body),
        Value::While(block) => block.body().map(Inside::Body),
        Value::For(block) => block.body().map(Inside::Body),
        Value::If(choice) => branch(choice, rest.next()?),
        Value::Expr(_) => None,
    }
}

impl Inside {
    fn steps(&self) -> Vec<StepNode> {
        match self {
            Self::Body(body) => steps_of(body),
            Self::If(choice) => vec![only_if(choice)],
        }
    }

    fn step(&self, segment: &str) -> Option<StepNode> {
        match self {
            Self::Body(body) => step_in(body, segment),
            Self::If(choice) => Some(only_if(choice)).filter(|step| step.segment == segment),
        }
    }
}

fn walk(text: &Source, program_name: &str, address: &str) -> Option<Inside> {
    let mut at = Inside::Body(program(text, program_name)?.body()?);
    let segments: Vec<&str> = address.split('.').filter(|s| !s.is_empty()).collect();
    let mut rest = segments.iter();
    while let Some(segment) = rest.next() {
        let step = at.step(segment)?;
        at = inside_of(&step.value?, &mut rest)?;
    }
    Some(at)
}

/// Finds a step by its address.
pub(crate) fn step_at(text: &Source, program_name: &str, address: &str) -> Option<StepNode> {
    let (around, last) = address.rsplit_once('.').unwrap_or(("", address));
    let inside = walk(text, program_name, around)?;
    inside.step(last)
}

/// Finds the body of a block by its address: a loop's, `#0.then`, the program's own for nothing.
pub(crate) fn block(text: &Source, program_name: &str, address: &str) -> Option<ast::Body> {
    match walk(text, program_name, address)? {
        Inside::Body(body) => Some(body),
        Inside::If(_) => None,
    }
}

/// Returns the bytes of a step and those of its value.
pub(crate) fn step(text: &Source, program_name: &str, address: &str) -> Option<(Span, Span)> {
    let step = step_at(text, program_name, address)?;
    Some((step.span, step.value?.span()))
}

/// Returns the names that the steps of a body make where it stands: those of blocks without a name, too.
pub(crate) fn names_made(steps: &[StepNode]) -> Vec<String> {
    let mut all = Vec::new();
    for step in steps {
        match (&step.name, &step.value) {
            (Some(name), _) => all.push(name.clone()),
            (None, Some(Value::If(choice))) => {
                for segment in ["then", "else"] {
                    if let Some(inside) = branch(choice, segment) {
                        all.extend(names_made(&inside.steps()));
                    }
                }
            }
            (None, _) => {}
        }
    }
    all
}

/// Lists the steps in a block, by branch where it is an `if`.
pub(crate) fn inner_steps(value: &Value) -> Vec<(&'static str, Vec<StepNode>)> {
    let of_body = |body: Option<ast::Body>| body.map(|body| ("", steps_of(&body)));
    match value {
        Value::Repeat(block) => of_body(block.body()).into_iter().collect(),
        Value::While(block) => of_body(block.body()).into_iter().collect(),
        Value::For(block) => of_body(block.body()).into_iter().collect(),
        Value::If(choice) => {
            let one = |segment| Some((segment, branch(choice, segment)?.steps()));
            ["then", "else"].into_iter().filter_map(one).collect()
        }
        Value::Expr(_) => Vec::new(),
    }
}

/// Returns the names that a turn of a block begins with.
pub(crate) fn carried_names(value: &Value) -> Vec<String> {
    let (with, of_element) = match value {
        Value::Repeat(block) => (block.with(), Vec::new()),
        Value::While(block) => (block.with(), Vec::new()),
        Value::For(block) => (block.with(), block.names().map(|w| w.text().to_string()).collect()),
        Value::Expr(_) | Value::If(_) => (None, Vec::<String>::new()),
    };
    let with = with.into_iter().flat_map(|with| with.bindings()).filter_map(|b| b.name());
    of_element.into_iter().chain(with.map(|w| w.text().to_string())).collect()
}

/// What a home sees of each block around it, from the program inwards: the names of the level.
pub(crate) fn visible(text: &Source, home: &Home) -> Vec<Vec<String>> {
    let Home::Program { program: name, way, before, .. } = home else { return Vec::new() };
    let mut levels = vec![Vec::new()];
    let mut address = String::new();
    for (i, around) in way.iter().enumerate() {
        let Some(inside) = walk(text, name, &address) else { return levels };
        let until = way.get(i).map(|around| around.segment().to_string());
        let steps = inside.steps();
        let seen = steps.iter().position(|s| Some(&s.segment) == until.as_ref());
        let seen = &steps[..seen.unwrap_or(steps.len())];
        let made = names_made(seen);
        levels.last_mut().into_iter().for_each(|level| level.extend(made.clone()));
        if around.name.is_some() {
            let own = step_at(text, name, &joined(&address, around.segment()));
            let carried = own.and_then(|s| s.value).map_or(Vec::new(), |v| carried_names(&v));
            levels.push(carried);
        }
        address = joined(&address, &around.address);
    }
    if let Some(inside) = walk(text, name, &address) {
        let steps = inside.steps();
        let seen = before.as_ref().and_then(|b| steps.iter().position(|s| s.segment == *b));
        let made = names_made(&steps[..seen.unwrap_or(steps.len())]);
        levels.last_mut().into_iter().for_each(|level| level.extend(made.clone()));
    }
    levels
}

/// A value that a thing at the top of a text gives to a part.
pub(crate) struct Given {
    /// The value with its part, as it is written: `g.m = 4`.
    pub(crate) says: String,
    /// What goes with it: its doc comment, and the braces where nothing else is in them.
    pub(crate) span: Span,
}

/// Finds where a thing at the top of a text is given a value, by the place of the part's name.
pub(crate) fn given_at(text: &Source, name: Span) -> Option<Given> {
    let of = |span: Span| &text[span.start as usize..span.end as usize];
    let is_it = |member: &Member| match member {
        Member::Assign(assign) => assign.target().is_some_and(|target| target.span() == name),
        _ => false,
    };
    let of_part = |member: Member| {
        let Member::Part(part) = member else { return None };
        let body = part.body()?;
        let own = { body.members() }.find(is_it)?;
        let thing = of(span_without_doc(part.syntax()));
        let thing = thing.split(':').next().unwrap_or_default().trim();
        let says = format!("{thing}.{}", of(span_without_doc(own.syntax())).trim());
        let (around, own) = (body.span(), own.span());
        let before = &text[around.start as usize..own.start as usize];
        let after = &text[own.end as usize..around.end as usize];
        let is_alone = before.trim() == "{" && after.trim() == "}";
        let span = match is_alone {
            true => {
                let before = text[..around.start as usize].trim_end().len() as u32;
                Span::new(before, around.end)
            }
            false => with_lines_of(text, own),
        };
        Some(Given { says, span })
    };
    { text.file.members() }.find_map(of_part)
}

/// What goes where a span does: the comma after it, and the lines that nothing else is on.
pub(crate) fn with_lines_of(text: &str, span: Span) -> Span {
    let (mut start, mut end) = (span.start as usize, span.end as usize);
    start += text[start..end].len() - text[start..end].trim_start().len();
    end = start + text[start..end].trim_end().len();
    let rest = &text[end..];
    if let Some(after) = rest.trim_start_matches([' ', '\t']).strip_prefix(',') {
        end = text.len() - after.len();
    }
    let gap = |text: &str| text.len() - text.trim_start_matches([' ', '\t', '\r']).len();
    let line = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let is_first = text[line..start].trim().is_empty();
    let after = end + gap(&text[end..]);
    match (is_first, text[after..].starts_with('\n')) {
        (true, true) => Span::new(line as u32, after as u32 + 1),
        (true, false) => Span::new(start as u32, after as u32),
        (false, false) if text[..start].ends_with('(') => Span::new(start as u32, after as u32),
        (false, _) => {
            let before = text[..start].trim_end_matches([' ', '\t']).len();
            Span::new(before as u32, end as u32)
        }
    }
}

/// Joins two parts of an address.
pub(crate) fn joined(around: &str, inner: &str) -> String {
    match (around, inner) {
        ("", inner) => inner.into(),
        (around, "") => around.into(),
        (around, inner) => format!("{around}.{inner}"),
    }
}

/// Returns the address of the block that a home is.
pub(crate) fn address_of(home: &Home) -> String {
    match home {
        Home::Document => String::new(),
        Home::Program { way, .. } => {
            way.iter().fold(String::new(), |at, around| joined(&at, &around.address))
        }
    }
}

/// Returns a text with members added to a home: at its end, or before the step that it says.
///
/// # Errors
/// The program, or the block of it, is not in the text.
pub(crate) fn with_members(text: &Source, home: &Home, members: &str) -> Result<String, Refusal> {
    let Home::Program { program: name, way, before, .. } = home else {
        return Ok(format!("{}\n{members}\n", text.trim_end()));
    };
    if program(text, name).is_none() {
        return Err(words::refuse(format!("the document has no program {name}")));
    }
    let address = address_of(home);
    let gone = || words::refuse(format!("{name} has no block {address}"));
    let body = block(text, name, &address).ok_or_else(gone)?;
    let depth = way.len() + 1;
    let next = before.as_ref().and_then(|b| steps_of(&body).into_iter().find(|s| s.segment == *b));
    match next {
        Some(next) => Ok(with_lines_before(text, next.span.start as usize, depth, members)),
        None => Ok(with_lines(text, &body, depth, members)),
    }
}

fn with_lines_before(text: &str, at: usize, depth: usize, lines: &str) -> String {
    let indent = "    ".repeat(depth);
    // what is said of the step stands above it
    let mut start = text[..at].rfind('\n').map_or(0, |i| i + 1);
    while let Some(above) = text[..start.saturating_sub(1)].rfind('\n').map(|i| i + 1) {
        if !text[above..start].trim_start().starts_with("//") {
            break;
        }
        start = above;
    }
    let lines: Vec<String> = lines.lines().map(|line| format!("{indent}{line}\n")).collect();
    format!("{}{}{}", &text[..start], lines.concat(), &text[start..])
}

/// Whether a character can be part of a path: `column[0].ring`.
pub(crate) fn is_of_path(c: char) -> bool {
    c.is_alphanumeric() || "_.[]".contains(c)
}

/// Whether a segment of an address is a name: not a block without one, not a branch.
pub(crate) fn is_name(segment: &str) -> bool {
    !segment.starts_with('#') && !matches!(segment, "then" | "else")
}

/// Returns what a step is called, by its address: by its name alone, whatever is around it.
pub(crate) fn told(address: &str) -> &str {
    match address.rsplit('.').find(|s| !matches!(*s, "then" | "else")) {
        Some(name) if is_name(name) => name.split('[').next().unwrap_or_default(),
        Some(_) | None => "the `if`",
    }
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
pub(crate) fn with_lines(text: &str, body: &ast::Body, depth: usize, lines: &str) -> String {
    let span = body.span();
    let inside = &text[span.start as usize..span.end as usize];
    let close = span.start as usize + inside.rfind('}').unwrap_or(inside.len());
    let before = text[..close].trim_end();
    let (indent, outer) = ("    ".repeat(depth), "    ".repeat(depth - 1));
    let lines: Vec<String> = lines.lines().map(|line| format!("{indent}{line}")).collect();
    format!("{before}\n{}\n{outer}{}", lines.join("\n"), &text[close..])
}

/// Returns the words that a program uses as names, labels apart.
pub(crate) fn words_in(text: &Source, program_name: &str) -> BTreeSet<String> {
    let Some(program) = program(text, program_name) else { return BTreeSet::new() };
    let mut all = String::new();
    without_words(text, program.syntax(), &mut all);
    let parameters = parameters_in(&all);
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = BTreeSet::new();
    let mut at = 0;
    while let Some(start) = all[at..].find(is_word).map(|i| at + i) {
        let end = all[start..].find(|c| !is_word(c)).map_or(all.len(), |i| start + i);
        let is_label = all[end..].trim_start().starts_with(':');
        let word = &all[start..end];
        if (!is_label || parameters.contains(&start)) && !found.contains(word) {
            found.insert(word.to_string());
        }
        at = end;
    }
    found
}

/// Adds the text of a node, without what is asked or noted in words, which is no name.
fn without_words(text: &Source, node: &SyntaxNode, all: &mut String) {
    let span = syntax::span_of(node);
    let own = &text[span.start as usize..span.end as usize];
    // most of a long program holds none, and is not looked through token by token
    if !["\"", "//", "/*"].iter().any(|mark| own.contains(mark)) {
        all.push_str(own);
        return;
    }
    for inside in node.children_with_tokens() {
        match inside {
            SyntaxElement::Node(node) => without_words(text, &node, all),
            SyntaxElement::Token(token) => all.push_str(match token.kind() {
                SyntaxKind::LineComment
                | SyntaxKind::DocComment
                | SyntaxKind::BlockComment
                | SyntaxKind::Text
                | SyntaxKind::TextOpen
                | SyntaxKind::TextMiddle
                | SyntaxKind::TextClose => " ",
                _ => token.text(),
            }),
        }
    }
}

/// Where the parameters of a program stand: the first bracket of its text.
fn parameters_in(program: &str) -> std::ops::Range<usize> {
    let open = program.find('(').unwrap_or(program.len());
    open..program.find('{').unwrap_or(program.len())
}

/// Returns a text with a parameter added to a program.
///
/// # Errors
/// The program is not in the text.
pub(crate) fn with_parameter(
    text: &Source,
    name: &str,
    parameter: &str,
) -> Result<String, Refusal> {
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
