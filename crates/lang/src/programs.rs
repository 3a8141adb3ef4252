//! Programs: their parameters are parts, their steps are messages, declared here; `steps` lowers them.
//!
//! A block of steps has a class of its own, whose things are its turns. A name that a branch of an unnamed
//! `if` makes is one of the block around it.

mod steps;
mod totals;

use crate::kinds::Kind;
use crate::lower::{ByName, Lowerer};
use crate::members::Pending;
use crate::rules::mentions;
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use kernel::program::{Block, Demand};
use kernel::{ClassId, Constraint, Message, OriginId, Part, Program, Step, Term};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr, Member, Value, span_without_doc};

/// The programs of all texts.
#[derive(Default)]
pub(crate) struct Programs {
    declared: Vec<(ClassId, FileId, ast::Program)>,
    /// Which program a class of turns belongs to; a program's own class too.
    of_class: BTreeMap<ClassId, usize>,
    /// The classes of blocks, by where the block stands.
    blocks: BTreeMap<Place, ClassId>,
    /// The class of the turns that a step makes, by the class that has the step.
    made_in: ByName<ClassId>,
    /// Those whose steps are lowered, or are being lowered.
    begun: BTreeSet<usize>,
    /// True once everything is declared.
    is_ready: bool,
    /// How many blocks there are around what is being lowered.
    depth: usize,
    /// What loops of the program that is being lowered add up, each with the loop's name.
    totals: BTreeSet<(Name, Name)>,
    /// Which names of the program that is being lowered are angles.
    angles: BTreeSet<Name>,
}

impl Programs {
    pub(crate) fn add(&mut self, class: ClassId, file: FileId, program: ast::Program) {
        self.of_class.insert(class, self.declared.len());
        self.declared.push((class, file, program));
    }
    /// Programs that are lowered, of which only their classes are known.
    pub(crate) fn known(of_class: BTreeMap<ClassId, usize>) -> Self {
        Self { of_class, ..Self::default() }
    }

    /// Returns the classes that draw: programs, and the turns of their blocks.
    pub(crate) fn classes(self) -> BTreeMap<ClassId, usize> {
        self.of_class
    }

    pub(crate) fn declared(&self) -> Vec<(ClassId, FileId, ast::Program)> {
        self.declared.clone()
    }
    /// Returns the class of the turns that a block makes.
    fn block(&self, file: FileId, body: &ast::Body) -> Option<ClassId> {
        self.blocks.get(&Place { file, span: body.span() }).copied()
    }
}

/// Where steps are declared.
struct Home {
    file: FileId,
    program: usize,
    /// The class whose messages they are.
    class: ClassId,
    /// Names that another branch of the same `if` makes: the same may be made here.
    other_branch: BTreeSet<Name>,
}

impl Lowerer<'_> {
    /// Declares parameters and steps of every program.
    pub(crate) fn declare_programs(&mut self) {
        for (index, (class, file, program)) in self.programs.declared().into_iter().enumerate() {
            let scope = Scope::of(file, class);
            for param in program.params().into_iter().flat_map(|p| p.params()) {
                self.declare_parameter(&scope, &param);
            }
            let home = Home { file, program: index, class, other_branch: BTreeSet::new() };
            self.declare_steps(&home, &members_of(program.body()));
            self.declare_picture(&scope);
        }
    }

    fn declare_parameter(&mut self, scope: &Scope, param: &ast::Param) {
        let Some(word) = param.name() else { return };
        let class = param.class().and_then(|ty| Some((self.class_of_type(scope, &ty)?, ty)));
        let Some((class, ty)) = class else {
            self.broken.insert((scope.class(), word.name()));
            return;
        };
        if !self.is_new(scope, &word) {
            return;
        }
        let count = self.declared_count(scope, &ty);
        let origin = self.origin(scope.file, span_without_doc(param.syntax()));
        let prompt = param.prompt().map(|w| w.unquoted());
        let doc = param.doc().or(prompt).unwrap_or_default();
        let name = word.name();
        let part =
            Part { name: name.clone(), doc, class, count, range: None, is_layout: false, origin };
        self.add_part(Place { file: scope.file, span: word.span() }, scope.class(), part);
        if let Some(value) = param.value() {
            let (scope, prefix) = (Rc::new(scope.clone()), vec![Step::Part(name)]);
            self.pending.push(Pending::Value { scope, prefix, target: None, value });
        }
    }

    /// Lets things of a program draw what it makes, unless it says otherwise.
    fn declare_picture(&mut self, scope: &Scope) {
        let name = Name::new("picture");
        if self.messages.contains_key(&(scope.class(), name.clone())) {
            return;
        }
        let value = kernel::Argument { label: None, value: Term::Result };
        let answer = Term::Call { name: name.clone(), arguments: vec![value] };
        self.message_kinds.insert((scope.class(), name.clone()), Some(Kind::Picture));
        self.add_step_message(scope.class(), name, answer, (scope.file, Span::default()));
    }

    fn add_step_message(
        &mut self,
        class: ClassId,
        name: Name,
        answer: Term,
        (file, span): (FileId, Span),
    ) {
        let origin = self.origin(file, span);
        let message = Message {
            name: name.clone(),
            doc: String::new(),
            parameters: Vec::new(),
            class: None,
            answer: Rc::new(answer),
            is_asked: false,
            is_default: false,
            is_combining: false,
            is_replacing: false,
            origin,
        };
        let messages = &mut self.document.classes[class].messages;
        self.messages.insert((class, name), messages.len());
        messages.push(message);
    }

    /// Declares the steps of a block; returns their names.
    fn declare_steps(&mut self, home: &Home, members: &[Member]) -> BTreeSet<Name> {
        let mut made = BTreeSet::new();
        let scope = Scope::of(home.file, home.class);
        for member in members {
            match member {
                Member::Assign(assign) => match step_name(assign) {
                    Some(word) => {
                        made.insert(word.name());
                        self.declare_step(home, &word, assign.syntax());
                        if let Some(value) = assign.value() {
                            self.declare_block(home, Some(&word.name()), &value);
                        }
                    }
                    None => {
                        let span = assign.target().map_or(assign.span(), |t| t.span());
                        let message = "a step makes something new, with a name of its own";
                        let place = Place { file: home.file, span };
                        let d = Diagnostic::error("not-a-step", place, message);
                        self.report(
                            d.hint("what was made is not changed: `moved = line.moved(…)`"),
                        );
                    }
                },
                Member::If(choice) => made.extend(self.declare_branches(home, choice)),
                Member::Repeat(block) => {
                    self.declare_block(home, None, &Value::Repeat(block.clone()));
                }
                Member::While(block) => {
                    self.declare_block(home, None, &Value::While(block.clone()));
                }
                Member::For(block) => self.declare_block(home, None, &Value::For(block.clone())),
                Member::Message(message) => self.declare_message(&scope, &[], message),
                Member::Constraint(constraint) if self.is_program(home.class) => {
                    if let Some(name) = constraint.name() {
                        self.constraints.insert((home.class, name.name()));
                    }
                    self.pending.push(Pending::Member(Rc::new(scope.clone()), member.clone()));
                }
                Member::Next(_) | Member::Erase(_) | Member::Error(_) => {}
                other => {
                    let place = Place {
                        file: home.file,
                        span: self.first_line(home.file, span_without_doc(other.syntax())),
                    };
                    let message = "a program has steps, messages and demands on its parameters";
                    let d = Diagnostic::error("not-a-step", place, message);
                    self.report(d.hint(match other {
                        Member::Program(_) | Member::Class(_) => {
                            "write it beside this one, at the top of the text: it is called by its name"
                        }
                        _ => "a step is `name = …`; a parameter stands in the brackets",
                    }));
                }
            }
        }
        made
    }

    /// Returns true for a program, and for the turns of its blocks.
    pub(crate) fn draws(&self, class: ClassId) -> bool {
        let line = self.document.primary_line(class);
        line.iter().any(|c| self.programs.of_class.contains_key(c))
    }

    pub(crate) fn is_program(&self, class: ClassId) -> bool {
        self.programs.declared.iter().any(|(id, _, _)| *id == class)
    }

    fn declare_step(&mut self, home: &Home, word: &ast::Word, node: &syntax::SyntaxNode) {
        let name = word.name();
        let key = (home.class, name.clone());
        if home.other_branch.contains(&name) {
            return;
        }
        if !self.is_new(&Scope::of(home.file, home.class), word) {
            return;
        }
        self.named_at.insert(key, Place { file: home.file, span: word.span() });
        let place = (home.file, span_without_doc(node));
        self.add_step_message(home.class, name.clone(), Term::Step(name), place);
    }

    /// Declares both branches of an `if` without a name in the block around it; returns what they make.
    fn declare_branches(&mut self, home: &Home, choice: &ast::If) -> BTreeSet<Name> {
        let mut made = BTreeSet::new();
        let mut next = Some(choice.clone());
        while let Some(choice) = next.take() {
            let mut branch = |l: &mut Self, body: Option<ast::Body>| {
                let other_branch = home.other_branch.union(&made).cloned().collect();
                let home = Home { other_branch, ..*home };
                if let Some(body) = &body {
                    let place = Place { file: home.file, span: body.span() };
                    l.programs.blocks.insert(place, home.class);
                }
                let more = l.declare_steps(&home, &members_of(body));
                made.extend(more);
            };
            branch(self, choice.then_body());
            match choice.else_branch() {
                Some(ast::Else::Body(body)) => branch(self, Some(body)),
                Some(ast::Else::If(choice)) => next = Some(choice),
                None => {}
            }
        }
        made
    }

    /// Declares the class of the turns of a block, and its steps.
    fn declare_block(&mut self, home: &Home, name: Option<&Name>, value: &Value) {
        let bodies: Vec<ast::Body> = match value {
            Value::Expr(_) => return,
            Value::Repeat(block) => block.body().into_iter().collect(),
            Value::While(block) => block.body().into_iter().collect(),
            Value::For(block) => block.body().into_iter().collect(),
            Value::If(choice) => choice.then_body().into_iter().collect(),
        };
        let around = self.document.classes[home.class].name.clone();
        let label = format!("{around}.{}", name.map_or("block", Name::as_str));
        let origin = self.origin(home.file, value.span());
        let class = self.add_unnamed_class(&label, self.object, origin);
        self.document.classes[class].is_of_one = true;
        self.programs.of_class.insert(class, home.program);
        if let Some(name) = name {
            self.programs.made_in.insert((home.class, name.clone()), class);
        }
        let inner = Home { class, other_branch: BTreeSet::new(), ..*home };
        for body in &bodies {
            let place = Place { file: home.file, span: body.span() };
            self.programs.blocks.insert(place, class);
        }
        match value {
            Value::If(choice) => _ = self.declare_branches(&inner, choice),
            _ => {
                for carried in carried_names(value) {
                    self.declare_step(&inner, &carried, &carried_node(value));
                }
                self.declare_steps(&inner, &members_of(bodies.into_iter().next()));
            }
        }
        self.declare_picture(&Scope::of(home.file, class));
    }

    /// Lowers the steps of every program.
    pub(crate) fn define_programs(&mut self) {
        self.programs.is_ready = true;
        for index in 0..self.programs.declared.len() {
            self.define_program(index);
        }
    }

    /// Lowers the steps of the program that a class belongs to, where that has not begun.
    pub(crate) fn define_program_of(&mut self, class: ClassId) {
        if let Some(&index) = self.programs.of_class.get(&class).filter(|_| self.programs.is_ready)
        {
            let silent = std::mem::take(&mut self.silent);
            self.define_program(index);
            self.silent = silent;
        }
    }

    /// Collects what the parameters of each program have to fulfil.
    pub(crate) fn finish_programs(&mut self) {
        for (class, _, _) in self.programs.declared() {
            let of = &self.document.classes[class];
            let is_step = |path: &kernel::Path| match path.0.first() {
                Some(Step::Part(name)) => of.parts.iter().all(|p| p.name != *name),
                Some(_) | None => true,
            };
            let is_binding = |i: &u32| of.bindings.iter().any(|b| b.constraint == *i);
            let demands = (0..).zip(&of.constraints).filter(|(i, _)| !is_binding(i));
            let demands = demands.map(|(_, c)| c).filter(|c| {
                let mut said = Vec::new();
                mentions(&c.rule, &mut said);
                c.strength == kernel::Strength::Required && !said.iter().any(is_step)
            });
            let said = |c: &Constraint| c.name.clone().unwrap_or_else(|| self.rule_of(c.origin));
            let demands = demands
                .map(|c| Demand { said: said(c), rule: c.rule.clone(), origin: c.origin })
                .collect();
            if let Some(program) = &mut self.document.classes[class].program {
                Rc::make_mut(program).demands = demands;
            }
        }
    }

    /// Returns the rule of a constraint as it is written, on one line.
    fn rule_of(&self, origin: OriginId) -> Name {
        let place = self.origins.place(origin);
        let written = self.files[place.file].text.get(place.span.range()).unwrap_or_default();
        let words: Vec<&str> = written.split_whitespace().collect();
        let written = words.join(" ");
        Name::new(written.strip_prefix("constraint ").unwrap_or(&written))
    }

    /// Returns true for the name of a step that is made elsewhere in the program, and says where.
    pub(crate) fn is_step_elsewhere(&mut self, scope: &Scope, word: &ast::Word) -> bool {
        let (class, name) = (scope.class(), word.name());
        if self.class_of_part(class, &name).is_some() {
            return false;
        }
        let place = Place { file: scope.file, span: word.span() };
        let not_visible = |message: String| Diagnostic::error("not-visible", place, message);
        let is_step = |m: &Message| matches!(*m.answer, Term::Step(_));
        if self.defined_message(class, &name).is_some_and(is_step) {
            let message = format!("{name} is not made yet: its step stands below");
            self.report(not_visible(message).hint("put the step that needs it below that one"));
            return true;
        }
        let Some(&program) = self.programs.of_class.get(&class) else { return false };
        let blocks = self.programs.of_class.iter().filter(|(_, p)| **p == program);
        let mut blocks = blocks.map(|(class, _)| *class).filter(|&c| c != class);
        let Some(block) = blocks.find(|&c| self.defined_message(c, &name).is_some_and(is_step))
        else {
            return false;
        };
        let label = self.document.classes[block].name.to_string();
        let step = label.rsplit('.').next().unwrap_or_default().to_string();
        let message = format!("{name} is made in the block {step}, and is not visible here");
        self.report(match step.as_str() {
            "block" => not_visible(message).hint("give the block a name: `rows = repeat …`"),
            _ => not_visible(message).hint(format!("outside of the block: `{step}.last.{name}`")),
        });
        true
    }

    /// Notes what a program does.
    fn set_program(&mut self, class: ClassId, program: Program) {
        self.document.classes[class].program = Some(Rc::new(program));
    }

    /// Begins a program, unless that was done.
    fn begins(&mut self, index: usize) -> bool {
        self.programs.begun.insert(index)
    }
}

/// Returns the name that a step gives to what it makes.
fn step_name(assign: &ast::Assign) -> Option<ast::Word> {
    match assign.target()? {
        Expr::Name(name) => name.name(),
        _ => None,
    }
}

fn members_of(body: Option<ast::Body>) -> Vec<Member> {
    body.into_iter().flat_map(|b| b.members()).collect()
}

fn with_of(value: &Value) -> Option<ast::With> {
    match value {
        Value::Repeat(block) => block.with(),
        Value::While(block) => block.with(),
        Value::For(block) => block.with(),
        Value::Expr(_) | Value::If(_) => None,
    }
}

/// Returns the names that a turn has before its steps: those of `with`, and those of the element.
fn carried_names(value: &Value) -> Vec<ast::Word> {
    let with = with_of(value).into_iter().flat_map(|w| w.bindings()).filter_map(|b| b.name());
    let of_element = match value {
        Value::For(block) => block.names().collect(),
        Value::Expr(_) | Value::Repeat(_) | Value::While(_) | Value::If(_) => Vec::new(),
    };
    of_element.into_iter().chain(with).collect()
}

fn carried_node(value: &Value) -> syntax::SyntaxNode {
    value.syntax().clone()
}

/// A block without steps.
fn nothing(class: ClassId) -> Block {
    Block::of(class)
}
