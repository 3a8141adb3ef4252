//! Placed things: `wheel: Placed of Gear { at = (10, 20)  turn = 30 deg  scale = 2 }`.
//!
//! All placed things of a class show one thing of it, their *master*, which the document keeps among
//! its `masters`. A placed thing has a position, a turn and a scale of its own; whatever else is asked
//! of it, is asked of the master with its lengths scaled and its places turned and moved. That is an
//! expression like any other, so that it is read, constrained and dragged, and solved through.
//!
//! A stay keeps the master as it is while instances are dragged: it changes with its class.
//!
//! A placed thing of a *program* has no master: `w: Placed of Washer { at = (10, 20)  inner = 5 mm }` is a washer with
//! parameters of its own, in whose frame its steps draw; what it shows of them is moved, scaled and turned.
//!
//! **Source:** Sutherland 1963, "Sketchpad", chapter VI, instances and their attachers.

use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use expr::dimension::Dimension;
use kernel::{
    Argument, BinaryOperator, ClassId, ClassKind, Constraint, Document, Given, Message, OriginId,
    Part, Path, Primitive, Search, Stay, Step, Strength, Superclass, Term,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr};

/// The message by which a placed thing of a program shows all that it draws, where it is placed. No text can say it.
pub const PLACED: &str = "(placed)";
/// How many parts of a master are placed, those of its parts included.
const MOST_FIELDS: u32 = 10_000;

/// Placed classes, and the masters that they show.
#[derive(Default)]
pub(crate) struct PlacedClasses {
    /// Every placed class with the class of its master.
    of: BTreeMap<ClassId, ClassId>,
    /// Those that have no parts yet, with where they were spoken of first.
    waiting: Vec<(ClassId, Place)>,
    /// The class of the document's masters.
    pub(crate) masters: Option<(Name, ClassId)>,
}

impl Lowerer<'_> {
    /// Returns the class of placed things of a class.
    pub(crate) fn placed_class(
        &mut self,
        file: FileId,
        span: Span,
        master: ClassId,
    ) -> Option<ClassId> {
        if self.document.classes[master].kind != ClassKind::Composite {
            let name = &self.document.classes[master].name;
            let message = format!("{name} has no parts that could be placed");
            self.error("value-of-wrong-class", file, span, message);
            return None;
        }
        if self.document.classes[master].is_abstract {
            let name = &self.document.classes[master].name;
            let message = format!("{name} is abstract: it has no things of its own");
            self.error("abstract-part", file, span, message);
            return None;
        }
        let class = self.class_made_of("Placed of", ClassKind::Composite, master);
        if self.placed.of.insert(class, master).is_none() {
            self.placed.waiting.push((class, Place { file, span }));
            if self.draws(master) {
                let program = Superclass { class: master, name: Name::new("") };
                self.document.classes[class].supers = vec![program];
            }
        }
        Some(class)
    }

    /// Gives placed classes their parts and messages, once those of their masters are declared.
    pub(crate) fn complete_placed(&mut self) {
        let waiting = std::mem::take(&mut self.placed.waiting);
        for &(class, Place { file, span }) in &waiting {
            let master = self.placed.of[&class];
            let origin = self.document.classes[class].origin;
            let at = self.place_class(file, origin);
            let own = |name: &str| self.visible.class(OWN, name);
            let (Some(turn), Some(scale)) = (own("Angle"), own("Real")) else { return };
            if self.draws(master) {
                self.complete_placed_program(
                    (class, master),
                    [scale, turn, at],
                    Place { file, span },
                );
                continue;
            }
            let reference = self.reference_to(master);
            // what is declared last yields first: a placed thing that is dragged is moved
            for (name, part) in
                [("master", reference), ("scale", scale), ("turn", turn), ("at", at)]
            {
                self.add_hidden_part(class, Name::new(name), part, origin);
            }
            let masters = self.masters(master, origin);
            let master_path =
                Term::send(Term::send(Term::Document, &masters), &self.master_name(master));
            let given = [
                ("scale", Term::number(1.0)),
                ("turn", Term::number(0.0)),
                ("master", master_path),
            ];
            for (name, value) in given {
                let path = Path::of(&[name]);
                self.document.classes[class].givens.push(Rc::new(Given { path, value, origin }));
            }
        }
        for (class, _) in waiting {
            let master = self.placed.of[&class];
            if !self.draws(master) {
                self.forward(class, master);
            }
        }
    }

    /// Returns the class of positions: the text's `Point` where it is one, else one without a name.
    fn place_class(&mut self, file: FileId, origin: OriginId) -> ClassId {
        let point = self.visible.class(file, "Point");
        if let Some(point) = point.filter(|&c| planar(&self.document, c)) {
            return point;
        }
        let object = self.object;
        if let Some(&known) = self.made.get(&("Place in", object)) {
            return known;
        }
        let class = self.class_made_of("Place in", ClassKind::Composite, object);
        if let Some(length) = self.visible.class(OWN, "Length") {
            for name in ["x", "y"] {
                self.add_hidden_part(class, Name::new(name), length, origin);
            }
        }
        class
    }

    fn add_hidden_part(&mut self, owner: ClassId, name: Name, class: ClassId, origin: OriginId) {
        let place = Place { file: OWN, span: Span::default() };
        let part = Part {
            name,
            doc: String::new(),
            class,
            count: None,
            range: None,
            is_layout: false,
            origin,
        };
        self.add_part(place, owner, part);
    }

    fn master_name(&self, master: ClassId) -> Name {
        self.document.classes[master].name.clone()
    }

    /// Adds a master to those of the document, and returns the name by which they are reached.
    fn masters(&mut self, master: ClassId, origin: OriginId) -> Name {
        let root = self.document.root;
        let (name, class) = match self.placed.masters.clone() {
            Some(known) => known,
            None => {
                let mut name = Name::new("masters");
                while self.named_at.contains_key(&(root, name.clone())) {
                    name = Name::new(&format!("{name}'"));
                }
                let object = self.object;
                let class = self.add_unnamed_class("masters", object, origin);
                // they are seen where they are placed
                let nothing = Term::Call { name: Name::new("picture"), arguments: Vec::new() };
                self.add_hidden_message(class, "picture", nothing, Kind::Picture, origin);
                for view in ["structure", "values"] {
                    let rows = Kind::List(Box::new(Kind::Unknown));
                    self.add_hidden_message(class, view, Term::List(Vec::new()), rows, origin);
                }
                self.add_hidden_part(root, name.clone(), class, origin);
                let path = Path(vec![Step::Part(name.clone())]);
                let strength = Some(Strength::Strong);
                self.document.classes[root].stays.push(Stay { path, strength, origin });
                self.placed.masters = Some((name.clone(), class));
                (name, class)
            }
        };
        let of = self.master_name(master);
        self.add_hidden_part(class, of, master, origin);
        name
    }

    /// Gives placed things of a program a scale, a turn and a place beside their parameters.
    fn complete_placed_program(
        &mut self,
        (class, program): (ClassId, ClassId),
        classes: [ClassId; 3],
        place: Place,
    ) {
        let origin = self.document.classes[class].origin;
        for (name, part) in ["scale", "turn", "at"].into_iter().zip(classes) {
            let name = Name::new(name);
            if self.class_of_part(program, &name).is_some()
                || self.defined_message(program, &name).is_some()
            {
                let of = self.master_name(program);
                let message = format!("{of} has a {name} of its own, and what is placed has one");
                let d = Diagnostic::error("duplicate-name", place, message);
                self.report(d.hint(format!("call that of {of} otherwise")));
                continue;
            }
            self.add_hidden_part(class, name, part, origin);
        }
        for (name, value) in [("scale", 1.0), ("turn", 0.0)] {
            let (path, value) = (Path::of(&[name]), Term::number(value));
            self.document.classes[class].givens.push(Rc::new(Given { path, value, origin }));
        }
    }

    /// Lets placed things of programs show their steps where they are placed, once these are lowered.
    pub(crate) fn forward_programs(&mut self) {
        let all = self.placed.of.iter().map(|(&class, &program)| (class, program));
        let all: Vec<_> = all.filter(|&(_, program)| self.draws(program)).collect();
        for (class, program) in all {
            let origin = self.document.classes[class].origin;
            let is_step = |m: &&Message| matches!(*m.answer, Term::Step(_));
            let steps = self.document.classes[program].messages.iter().filter(is_step);
            for name in steps.map(|m| m.name.clone()).collect::<Vec<_>>() {
                let kind = self.message_kind(program, &name);
                let search = Some(Search::Above(class));
                let (to, arguments) = (Box::new(Term::Me), Vec::new());
                let own = Term::Send { to, name: name.clone(), arguments, search };
                let answer = match &kind {
                    Kind::Number(Some(dimension)) => (0..powers_of_length(*dimension))
                        .fold(own, |own, _| times(self::own("scale"), own)),
                    Kind::Thing(_) | Kind::List(_) | Kind::Unknown => somewhere_else(own),
                    Kind::Number(None)
                    | Kind::Bool
                    | Kind::Option(_)
                    | Kind::Text
                    | Kind::Color
                    | Kind::Tuple(_)
                    | Kind::Picture
                    | Kind::Function => own,
                };
                self.add_hidden_message(class, &name, answer, kind, origin);
            }
            let parts = self.document.classes[program].parts.iter();
            let given = parts
                .map(|part| Argument { label: Some(part.name.clone()), value: own(&part.name) });
            let drawn = Term::Make { class: program, arguments: given.collect() };
            let drawn = shown(drawn);
            self.add_hidden_message(class, PLACED, drawn, Kind::Thing(program), origin);
            let has_own = self.defined_message(program, &Name::new("picture"));
            if has_own.is_some_and(|m| matches!(*m.answer, Term::Call { .. })) {
                let value = shown(Term::Result);
                let arguments = vec![Argument { label: None, value }];
                let picture = Term::Call { name: Name::new("picture"), arguments };
                self.add_hidden_message(class, "picture", picture, Kind::Picture, origin);
            }
        }
    }

    /// Lets a placed class answer to whatever its master does.
    fn forward(&mut self, class: ClassId, master: ClassId) {
        let origin = self.document.classes[class].origin;
        let mut placing = Placing {
            document: &self.document,
            placed: &self.placed.of,
            way: Vec::new(),
            fields: 0,
        };
        let answer = placing.term(Term::send(Term::Me, "master"), master, 0);
        if placing.fields > MOST_FIELDS {
            let name = self.master_name(master);
            let message = format!("{name} has more than {MOST_FIELDS} parts to be placed");
            self.report(Diagnostic::error("too-many-members", self.origins.place(origin), message));
        }
        let kind = Kind::of_class(&self.document, master);
        self.add_hidden_message(class, "placed", answer, kind, origin);
        let own: BTreeSet<&str> =
            ["master", "scale", "turn", "at", "placed", "picture"].into_iter().collect();
        let names: BTreeSet<String> = self.names_of(master).into_iter().collect();
        let placed = Term::send(Term::Me, "placed");
        let picture = Term::send(placed.clone(), "picture");
        self.add_hidden_message(class, "picture", picture, Kind::Picture, origin);
        for name in names.iter().filter(|n| !own.contains(n.as_str())) {
            let name = Name::new(name);
            let kind = self.kind_of_part(master, &name).unwrap_or(Kind::Unknown);
            let parameters = match self.class_of_part(master, &name) {
                Some(_) => Vec::new(),
                None => self
                    .find_message(master, &name, None)
                    .map_or_else(Vec::new, |(_, m)| m.parameters.clone()),
            };
            let pass = |p: &kernel::Parameter| Argument {
                label: Some(p.label.clone()),
                value: Term::Local(p.name.clone()),
            };
            let arguments = parameters.iter().map(pass).collect();
            let to = Box::new(placed.clone());
            let answer = Term::Send { to, name: name.clone(), arguments, search: None };
            let index = self.add_hidden_message(class, &name, answer, kind, origin);
            self.document.classes[class].messages[index].parameters = parameters;
        }
    }

    fn add_hidden_message(
        &mut self,
        class: ClassId,
        name: &str,
        answer: Term,
        kind: Kind,
        origin: OriginId,
    ) -> usize {
        let name = Name::new(name);
        self.message_kinds.insert((class, name.clone()), Some(kind));
        let index = self.document.classes[class].messages.len();
        self.messages.insert((class, name.clone()), index);
        self.document.classes[class].messages.push(Message {
            name,
            doc: String::new(),
            parameters: Vec::new(),
            class: None,
            answer: Rc::new(answer),
            is_asked: false,
            is_default: false,
            is_combining: false,
            is_replacing: false,
            origin,
        });
        index
    }
}

impl Lowerer<'_> {
    /// Returns true if an expression leads to a part of a master, as a placed thing shows it.
    fn is_placed_part(&mut self, scope: &Scope, e: &Expr) -> bool {
        let (receiver, name) = match e {
            Expr::Paren(inner) => {
                return inner.inner().is_some_and(|e| self.is_placed_part(scope, &e));
            }
            Expr::Field(field) if field.args().is_none() => (field.receiver(), field.name()),
            Expr::Index(index) => (index.receiver(), None),
            _ => return false,
        };
        let Some(receiver) = receiver else { return false };
        self.silent += 1;
        let owner = self.path(scope, &receiver).and_then(|(_, class)| class);
        self.silent -= 1;
        match (owner.and_then(|c| Some((c, *self.placed.of.get(&c)?))), name) {
            (Some((class, master)), Some(word)) => {
                let name = word.name();
                self.class_of_part(class, &name).is_none()
                    && self.class_of_part(master, &name).is_some()
            }
            _ => owner.is_none() && self.is_placed_part(scope, &receiver),
        }
    }

    /// Lowers a merge that names parts of placed things: they stay in one place by a constraint, since
    /// what is placed is not stored. Returns false for any other merge.
    pub(crate) fn define_joint(
        &mut self,
        scope: &Scope,
        merge: &ast::Merge,
        origin: OriginId,
    ) -> bool {
        if self.placed.of.is_empty() || !merge.paths().any(|e| self.is_placed_part(scope, &e)) {
            return false;
        }
        let Some(name) = self.rule_name(scope, merge.name()) else { return true };
        let mut parts = Vec::new();
        for e in merge.paths() {
            let Some((term, kind)) = self.expr(scope, &e) else { return true };
            parts.push((term, kind, e.span()));
        }
        let Some(((first, wanted, _), others)) = parts.split_first() else { return true };
        let mut rule: Option<Term> = None;
        for (other, kind, span) in others {
            if !kind.fits(wanted, &self.document) {
                let (one, other) = (wanted.words(&self.document), kind.words(&self.document));
                let message = format!("{one} and {other} cannot be one part");
                self.error("unlike-merge", scope.file, *span, message);
                return true;
            }
            let sides = (Box::new(first.clone()), Box::new(other.clone()));
            let equal = Term::Binary(BinaryOperator::Equal, sides.0, sides.1);
            rule = Some(match rule {
                None => equal,
                Some(all) => Term::Binary(BinaryOperator::And, Box::new(all), Box::new(equal)),
            });
        }
        let Some(rule) = rule else { return true };
        let joint = Constraint { name, ..Constraint::required(rule, origin) };
        self.document.classes[scope.class()].constraints.push(joint);
        true
    }
}

/// Returns true if things of a class have coordinates `x` and `y`.
fn planar(document: &Document, class: ClassId) -> bool {
    ["x", "y"].iter().all(|name| {
        let part = crate::names::class_of_part(document, class, name);
        part.is_some_and(|c| is_length(document, c))
    })
}

fn is_length(document: &Document, class: ClassId) -> bool {
    document.classes[class].kind == ClassKind::Primitive(Primitive::Real(Dimension::LENGTH))
}

/// Makes the terms of what is placed.
struct Placing<'d> {
    document: &'d Document,
    placed: &'d BTreeMap<ClassId, ClassId>,
    /// The classes whose things are being placed, each inside the one before it.
    way: Vec<ClassId>,
    fields: u32,
}

impl Placing<'_> {
    /// Returns the term for a part of the master as the placed thing shows it. `depth` counts the
    /// lists around it.
    fn term(&mut self, of: Term, class: ClassId, depth: u32) -> Term {
        match self.document.classes[class].kind {
            ClassKind::Primitive(Primitive::Real(dimension)) => {
                (0..powers_of_length(dimension)).fold(of, |value, _| times(own("scale"), value))
            }
            ClassKind::Primitive(_) | ClassKind::Reference(_) | ClassKind::Set(_) => of,
            ClassKind::List(element) => {
                let name = Name::new(&format!("(element {depth})"));
                let each = self.term(Term::Local(name.clone()), element, depth + 1);
                let value = Term::Lambda(vec![name], Box::new(each));
                let arguments = vec![Argument { label: None, value }];
                let map = Name::new("map");
                Term::Send { to: Box::new(of), name: map, arguments, search: None }
            }
            ClassKind::Composite => self.thing(&of, class, depth),
        }
    }

    fn thing(&mut self, of: &Term, class: ClassId, depth: u32) -> Term {
        // a thing that would be a part of itself is reported where things are made
        if self.way.contains(&class) || self.fields > MOST_FIELDS {
            return of.clone();
        }
        self.way.push(class);
        let is_planar = planar(self.document, class);
        let is_placed = self.placed.contains_key(&class);
        let turned = |along: &str, x: Term, y: Term| {
            let (cos, sin) = (call("cos", own("turn")), call("sin", own("turn")));
            let (a, b, sign) = match along {
                "x" => (times(cos, x), times(sin, y), BinaryOperator::Subtract),
                _ => (times(sin, x), times(cos, y), BinaryOperator::Add),
            };
            let sum = Term::Binary(sign, Box::new(a), Box::new(b));
            plus(Term::send(own("at"), along), times(own("scale"), sum))
        };
        let mut arguments = Vec::new();
        for field in self.document.layout(class) {
            let name = self.document.field_name(field).clone();
            let part = Term::send(of.clone(), &name);
            let value = match name.as_str() {
                "x" | "y" if is_planar => {
                    turned(&name, Term::send(of.clone(), "x"), Term::send(of.clone(), "y"))
                }
                "turn" if is_placed => plus(own("turn"), part),
                "scale" if is_placed => times(own("scale"), part),
                _ => self.term(part, self.document.field_class(field), depth),
            };
            self.fields += 1;
            arguments.push(Argument { label: Some(name), value });
        }
        self.way.pop();
        Term::Make { class, arguments }
    }
}

/// Returns which power of a length a dimension is: 1, 2 or 3; 0 for any other.
fn powers_of_length(dimension: Dimension) -> i8 {
    (1..=3).find(|&n| dimension == Dimension::LENGTH.power(n)).unwrap_or(0)
}

/// What is drawn in the frame of a placed thing, where that is: moved, then scaled and turned about its place.
fn somewhere_else(of: Term) -> Term {
    let labelled =
        |label: &str, part: &str| Argument { label: Some(Name::new(label)), value: own(part) };
    let to = |of: Term, name: &str, arguments: Vec<Argument>| Term::Send {
        to: Box::new(of),
        name: Name::new(name),
        arguments,
        search: None,
    };
    let moved = to(of, "moved", vec![labelled("by", "at")]);
    let scaled = to(moved, "scaled", vec![labelled("about", "at"), labelled("by", "scale")]);
    to(scaled, "turned", vec![labelled("about", "at"), labelled("by", "turn")])
}

/// The same where it is only seen: what is neither turned nor scaled need not know how that is done.
fn shown(of: Term) -> Term {
    let is = |part: &str, number: f64| {
        let sides = (Box::new(own(part)), Box::new(Term::number(number)));
        Term::Binary(BinaryOperator::Equal, sides.0, sides.1)
    };
    let both = (Box::new(is("turn", 0.0)), Box::new(is("scale", 1.0)));
    let is_plain = Term::Binary(BinaryOperator::And, both.0, both.1);
    let arguments = vec![Argument { label: Some(Name::new("by")), value: own("at") }];
    let to = Box::new(of.clone());
    let moved = Term::Send { to, name: Name::new("moved"), arguments, search: None };
    Term::If(Box::new(is_plain), Box::new(moved), Box::new(somewhere_else(of)))
}

fn own(name: &str) -> Term {
    Term::send(Term::Me, name)
}

fn times(a: Term, b: Term) -> Term {
    Term::Binary(BinaryOperator::Multiply, Box::new(a), Box::new(b))
}

fn plus(a: Term, b: Term) -> Term {
    Term::Binary(BinaryOperator::Add, Box::new(a), Box::new(b))
}

fn call(name: &str, value: Term) -> Term {
    Term::Call { name: Name::new(name), arguments: vec![Argument { label: None, value }] }
}
