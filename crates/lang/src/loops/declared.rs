//! What is declared in loops: a part, reference or message in a `for` is a list with an element for
//! every turn, a list of lists in a `for` inside of another.

use super::{MOST_MEMBERS, members_of, turn_of};
use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::members::values_alone;
use crate::scope::Scope;
use base::{Name, Place, Span};
use kernel::{ClassId, ClassKind, Count, Part, PartRef, PartRole, Term};
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr, Member, span_without_doc};

/// A declaration in loops.
#[derive(Clone)]
pub(crate) struct Repeated {
    scope: Scope,
    /// The class that says the loop; others go on with it.
    declared_by: ClassId,
    /// The loops around it, the outermost first.
    loops: Vec<ast::For>,
    member: Member,
}

/// The turns of loops inside one another.
#[derive(Clone, PartialEq)]
enum Shape {
    /// So many turns of the innermost loop.
    Turns(u32),
    /// Those of the loops inside, for every turn.
    Each(Vec<Shape>),
}

/// The classes of what is declared, one for every turn of the innermost loop.
enum Leaves<'f, 'l> {
    Alike(ClassId),
    /// A class of one for every turn; the class that it refines.
    Own(ClassId, &'f mut dyn FnMut(&mut Lowerer<'l>, &Scope) -> ClassId),
}

impl<'l> Lowerer<'l> {
    /// Declares what a loop declares, and the loops in it; what goes through lists waits until these
    /// are declared.
    pub(super) fn declare_loop(&mut self, scope: &Scope, each: &ast::For) {
        for (loops, member) in declarations(each) {
            let declared_by = scope.class();
            let repeated = Repeated { scope: scope.clone(), declared_by, loops, member };
            let over_ranges = |each: &ast::For| matches!(each.range(), Some(Expr::Range(_)));
            let shape = if repeated.loops.iter().all(over_ranges) {
                self.shape(scope, &repeated.loops)
            } else {
                None
            };
            match shape {
                Some(shape) => self.declare_turns(&repeated, &shape),
                None => self.repeated.push(repeated),
            }
        }
    }

    /// Declares what loops over lists declare, once the lists are declared.
    pub(crate) fn declare_repeated(&mut self) {
        for repeated in std::mem::take(&mut self.repeated) {
            match self.shape(&repeated.scope, &repeated.loops) {
                Some(shape) => self.declare_turns(&repeated, &shape),
                // why is said where the loop is gone through
                None => {
                    let names = names_of(&repeated.member);
                    let class = repeated.scope.class();
                    self.broken.extend(names.into_iter().map(|w| (class, w.name())));
                }
            }
        }
    }

    /// Finds how many turns loops inside one another take; nothing where that is not known.
    fn shape(&mut self, scope: &Scope, loops: &[ast::For]) -> Option<Shape> {
        let (each, inner) = loops.split_first()?;
        self.silent += 1;
        let turns = self.turns(scope, each);
        self.silent -= 1;
        let turns = turns?;
        if inner.is_empty() {
            // that there are too many is said of the loop
            let fits = turns.count as usize <= MOST_MEMBERS;
            return Some(Shape::Turns(if fits { turns.count } else { 0 }));
        }
        let range = each.range()?;
        if !self.may_unroll(scope, &range, turns.count as usize) {
            return None;
        }
        let shapes = (0..turns.count).map(|turn| {
            let here = turn_of(scope, &turns, turn);
            self.shape(&here, inner)
        });
        Some(Shape::Each(shapes.collect::<Option<_>>()?))
    }

    fn declare_turns(&mut self, repeated: &Repeated, shape: &Shape) {
        let Repeated { scope, loops, member, .. } = repeated;
        let span = span_without_doc(member.syntax());
        match member {
            Member::Part(part) => match (part.class(), part.definition()) {
                (Some(ty), Some(answer)) => {
                    self.declare_virtual(scope, loops, part, &ty, &answer);
                }
                (Some(_), None) => self.declare_list(repeated, part, shape),
                (None, _) => {}
            },
            Member::Message(message) => self.declare_message(scope, loops, message),
            Member::Ref(reference) => {
                let (Some(word), Some(ty)) = (reference.name(), reference.class()) else { return };
                let Some(to) = self.class_of_type(scope, &ty) else {
                    self.broken.insert((scope.class(), word.name()));
                    return;
                };
                let element = self.reference_to(to);
                let doc = reference.doc().unwrap_or_default();
                let class = self.lists_of(scope, loops, shape, &mut Leaves::Alike(element));
                self.add_list(repeated, &word, class, shape.len(), (doc, None, false, span));
            }
            _ => {}
        }
    }

    fn declare_list(&mut self, repeated: &Repeated, part: &ast::Part, shape: &Shape) {
        let Repeated { scope, loops, .. } = repeated;
        let Some(ty) = part.class() else { return };
        let Some(element) = self.class_of_element(scope, &ty) else {
            return self.broken.extend(part.names().map(|w| (scope.class(), w.name())));
        };
        let range = part.domain().and_then(|d| self.domain(scope, &d, element));
        let span = span_without_doc(part.syntax());
        for word in part.names() {
            let is_of_turns = |b: &ast::Body| loops.iter().any(|l| self.is_of_turns(element, l, b));
            let body = part.body().filter(|b| !is_of_turns(b));
            let origin = self.origin(scope.file, span);
            let name = word.name();
            let class = match body {
                // what speaks of what the loops go through is a class of one for every turn
                Some(body) if loops.iter().any(|each| varies(each, &body)) => {
                    let mut own = |l: &mut Self, turn: &Scope| {
                        l.class_for_body(turn, &name, element, Some(body.clone()), origin)
                    };
                    self.lists_of(scope, loops, shape, &mut Leaves::Own(element, &mut own))
                }
                body => {
                    let element = self.class_for_body(scope, &name, element, body, origin);
                    self.lists_of(scope, loops, shape, &mut Leaves::Alike(element))
                }
            };
            let doc = part.doc().unwrap_or_default();
            self.add_list(
                repeated,
                &word,
                class,
                shape.len(),
                (doc, range, part.is_layout(), span),
            );
        }
    }

    fn add_list(
        &mut self,
        Repeated { scope, declared_by, .. }: &Repeated,
        word: &ast::Word,
        class: ClassId,
        turns: u32,
        (doc, range, is_layout, span): (String, Option<(i64, i64)>, bool, Span),
    ) {
        if !self.is_new(scope, word) {
            return;
        }
        if scope.class() != *declared_by {
            let Some(&index) = self.parts.get(&(*declared_by, word.name())) else { return };
            let field = PartRef { class: *declared_by, index, role: PartRole::Part };
            let list = self.with_count(class, turns);
            self.longer.push((scope.class(), field, list));
            return self.document.classes[scope.class()].refined.push((field, list));
        }
        let origin = self.origin(scope.file, span);
        let count = Some(Count::Fixed(turns));
        let part = Part { name: word.name(), doc, class, count, range, is_layout, origin };
        self.add_part(Place { file: scope.file, span: word.span() }, scope.class(), part);
    }
}

impl<'l> Lowerer<'l> {
    /// Declares the lists of a loop that goes on in a class which gives what it goes through more elements.
    pub(super) fn redeclare_loop(&mut self, declared_by: ClassId, scope: &Scope, each: &ast::For) {
        for (loops, member) in declarations(each) {
            if let Some(shape) = self.shape(scope, &loops) {
                let scope = scope.clone();
                self.declare_turns(&Repeated { scope, declared_by, loops, member }, &shape);
            }
        }
    }

    /// Returns true for a body of values that every turn says for itself; not where one is a count, which
    /// decides of what class the element is.
    pub(super) fn is_of_turns(&self, element: ClassId, each: &ast::For, body: &ast::Body) -> bool {
        let members: Vec<Member> = body.members().collect();
        let values = members.iter().all(|m| matches!(m, Member::Assign(_)));
        values
            && (varies(each, body) || values_alone(&members).is_some())
            && !self.gives_count(element, &members)
    }

    /// Returns the class of a list, of so many elements.
    fn with_count(&mut self, list: ClassId, count: u32) -> ClassId {
        match self.document.classes[list].kind {
            ClassKind::List(element) if self.document.classes[list].elements.is_empty() => {
                self.counted(element, count)
            }
            _ => list,
        }
    }

    /// Returns the class of a list with an element for every turn.
    fn lists_of(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        shape: &Shape,
        leaves: &mut Leaves<'_, 'l>,
    ) -> ClassId {
        let (element, elements) = self.elements_of(scope, loops, shape, leaves);
        if elements.is_empty() {
            return self.class_made_of("List of", ClassKind::List(element), element);
        }
        self.list_of_own(element, elements)
    }

    /// Returns the class of a list's elements, and that of each where they are not alike.
    fn elements_of(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        shape: &Shape,
        leaves: &mut Leaves<'_, 'l>,
    ) -> (ClassId, Vec<ClassId>) {
        let (Leaves::Alike(plain) | Leaves::Own(plain, _)) = leaves;
        let plain = *plain;
        let inner = loops.get(1..).unwrap_or_default();
        let turns = match (&*leaves, shape) {
            (Leaves::Alike(_), Shape::Turns(_)) => return (plain, Vec::new()),
            (Leaves::Alike(_), Shape::Each(_)) | (Leaves::Own(..), _) => {
                loops.first().and_then(|each| self.turns(scope, each))
            }
        };
        let Some(turns) = turns else { return (plain, Vec::new()) };
        let mut classes = Vec::new();
        for turn in 0..shape.len() {
            let here = turn_of(scope, &turns, turn);
            classes.push(match (&mut *leaves, shape) {
                (Leaves::Alike(class), Shape::Turns(_)) => *class,
                (Leaves::Own(_, of_turn), Shape::Turns(_)) => of_turn(self, &here),
                (leaves, Shape::Each(shapes)) => {
                    let within = &shapes[turn as usize];
                    let (element, own) = self.elements_of(&here, inner, within, leaves);
                    match own.is_empty() {
                        true => self.counted(element, within.len()),
                        false => self.list_of_own(element, own),
                    }
                }
            });
        }
        let Some(&first) = classes.first() else {
            let element = match shape {
                Shape::Turns(_) => plain,
                Shape::Each(_) => self.class_made_of("List of", ClassKind::List(plain), plain),
            };
            return (element, Vec::new());
        };
        if classes.iter().all(|&c| c == first) {
            return (first, Vec::new());
        }
        // of lists that are not equally long each knows how long it is
        let element = match self.document.classes[first].kind {
            ClassKind::List(of) => self.class_made_of("List of", ClassKind::List(of), of),
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => first,
        };
        (element, classes)
    }

    pub(crate) fn list_of_own(&mut self, element: ClassId, elements: Vec<ClassId>) -> ClassId {
        let name = format!("List of {}", self.document.classes[element].name);
        let object = self.object;
        let origin = self.document.classes[object].origin;
        let class = self.add_class(&name, ClassKind::List(element), &[object], origin);
        self.document.classes[class].count = Some(elements.len() as u32);
        self.document.classes[class].elements = elements;
        class
    }

    /// Lowers the answer of a message: in loops a list with an answer for every turn.
    pub(crate) fn answer_of(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        answer: &Expr,
        wanted: &Kind,
    ) -> Option<Term> {
        let Some((each, inner)) = loops.split_first() else {
            return self.expr_of(scope, answer, wanted);
        };
        let element = if let Kind::List(element) = wanted { element } else { &Kind::Unknown };
        let (turns, range) = (self.turns(scope, each)?, each.range()?);
        if !self.may_unroll(scope, &range, turns.count as usize) {
            return None;
        }
        let mut answers = Vec::new();
        for turn in 0..turns.count {
            let here = turn_of(scope, &turns, turn);
            answers.push(self.answer_of(&here, inner, answer, element)?);
        }
        Some(Term::List(answers))
    }

    /// Finds out what an answer is worth: that of the first turn of loops stands for all.
    pub(crate) fn kind_of_answer(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        answer: &Expr,
    ) -> Option<Kind> {
        let Some((each, inner)) = loops.split_first() else {
            return self.expr(scope, answer).map(|(_, kind)| kind);
        };
        let turns = self.turns(scope, each)?;
        let element = match turns.count {
            0 => Kind::Unknown,
            _ => self.kind_of_answer(&turn_of(scope, &turns, 0), inner, answer)?,
        };
        Some(Kind::List(Box::new(element)))
    }
}

impl Shape {
    /// Returns how many turns the outermost loop takes.
    fn len(&self) -> u32 {
        match self {
            Self::Turns(turns) => *turns,
            Self::Each(shapes) => shapes.len() as u32,
        }
    }
}

/// Returns what is declared in a loop and in the loops in it, each with the loops around it.
fn declarations(each: &ast::For) -> Vec<(Vec<ast::For>, Member)> {
    let mut found = Vec::new();
    for member in members_of(each) {
        if let Member::For(inner) = &member {
            found.extend(declarations(inner).into_iter().map(|(mut loops, member)| {
                loops.insert(0, each.clone());
                (loops, member)
            }));
        } else if is_declaration(&member) {
            found.push((vec![each.clone()], member));
        }
    }
    found
}

/// Returns the names of what is declared in a loop and in the loops in it.
pub(super) fn declared_names(each: &ast::For) -> Vec<Name> {
    let of = |member: &Member| match member {
        Member::For(inner) => declared_names(inner),
        member => names_of(member).iter().map(ast::Word::name).collect(),
    };
    members_of(each).iter().flat_map(of).collect()
}

fn names_of(member: &Member) -> Vec<ast::Word> {
    match member {
        Member::Part(part) => part.names().collect(),
        Member::Message(message) => message.name().into_iter().collect(),
        Member::Ref(reference) => reference.name().into_iter().collect(),
        _ => Vec::new(),
    }
}

pub(super) fn is_declaration(member: &Member) -> bool {
    matches!(member, Member::Part(_) | Member::Message(_) | Member::Ref(_))
}

/// Returns true for a body that speaks of what a loop goes through, or of what else is declared in it.
fn varies(each: &ast::For, body: &ast::Body) -> bool {
    let mut names = declared_names(each);
    names.extend(each.names().map(|w| w.name()));
    let is_variable = |node: syntax::SyntaxNode| {
        let text = node.text().to_string();
        node.kind() == SyntaxKind::NameExpr && names.iter().any(|n| *n.as_str() == *text.trim())
    };
    body.syntax().descendants().any(is_variable)
}
