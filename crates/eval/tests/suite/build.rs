//! Small documents, built by hand from the kernel's types.

use base::Name;
use expr::dimension::Dimension;
use kernel::{
    Argument, BinaryOperator, Class, ClassId, ClassKind, Classes, Constraint, Document, Given,
    Merge, Message, Method, OriginId, Parameter, Part, Path, Primitive, Structure, Superclass,
    Term, Vertical, instantiate,
};
use std::rc::Rc;

/// A document being written.
pub(crate) struct Build {
    pub(crate) document: Document,
    pub(crate) real: ClassId,
    pub(crate) integer: ClassId,
    pub(crate) text: ClassId,
    pub(crate) bool: ClassId,
    pub(crate) length: ClassId,
    pub(crate) current: ClassId,
    pub(crate) point: ClassId,
    pub(crate) line: ClassId,
    origins: u32,
}

fn blank(name: &str, kind: ClassKind, supers: Vec<Superclass>) -> Class {
    Class::new(Name::new(name), kind, supers, OriginId(0))
}

impl Build {
    /// Begins a document with the primitive classes, `Point` and `Line`.
    pub(crate) fn new() -> Self {
        let mut classes = Classes::new();
        let object = classes.push(blank("Object", ClassKind::Composite, Vec::new()));
        let up = || vec![Superclass { class: object, name: Name::new("object") }];
        let mut primitive =
            |name: &str, p| classes.push(blank(name, ClassKind::Primitive(p), up()));
        let real = primitive("Real", Primitive::Real(Dimension::NONE));
        let integer = primitive("Integer", Primitive::Integer);
        let text = primitive("Text", Primitive::Text);
        let bool = primitive("Bool", Primitive::Bool);
        let length = primitive("Length", Primitive::Real(Dimension::LENGTH));
        let current = primitive("Current", Primitive::Real(Dimension::CURRENT));
        let root = classes.push(blank("", ClassKind::Composite, up()));
        let document = Document {
            classes,
            root,
            vertical: Vertical::Up,
            units_per_metre: 1.0,
            scale: Default::default(),
            unit: None,
            writes_lengths: false,
            usual: std::collections::BTreeMap::new(),
            customary: None,
            quotients: std::collections::BTreeMap::new(),
            units: std::collections::BTreeMap::new(),
        };
        let mut b = Self {
            document,
            real,
            integer,
            text,
            bool,
            length,
            current,
            point: root,
            line: root,
            origins: 0,
        };
        // as the language says it of every thing
        b.message(object, "picture", &[], call("picture", vec![part("parts")]));
        let general = &mut b.document.classes[object].messages[0];
        (general.is_default, general.is_combining) = (true, true);
        b.point = b.class("Point", &[]);
        b.part(b.point, "x", length);
        b.part(b.point, "y", length);
        b.message(b.point, "picture", &[], call("dot", vec![part("x"), part("y")]));
        b.line = b.class("Line", &[]);
        b.part(b.line, "p1", b.point);
        b.part(b.line, "p2", b.point);
        let square = |n: &str| {
            let d = sub(part(&format!("p2.{n}")), part(&format!("p1.{n}")));
            op(BinaryOperator::Power, d, num(2.0))
        };
        b.message(b.line, "length", &[], call("sqrt", vec![add(square("x"), square("y"))]));
        b.message(b.line, "picture", &[], call("segment", vec![part("p1"), part("p2")]));
        b
    }
    fn origin(&mut self) -> OriginId {
        self.origins += 1;
        OriginId(self.origins)
    }
    pub(crate) fn root(&self) -> ClassId {
        self.document.root
    }
    /// Adds a class; the first superclass is the primary one.
    pub(crate) fn class(&mut self, name: &str, supers: &[(&str, ClassId)]) -> ClassId {
        let mut line: Vec<Superclass> =
            supers.iter().map(|&(n, class)| Superclass { class, name: Name::new(n) }).collect();
        if line.is_empty() {
            line.push(Superclass { class: ClassId(0), name: Name::new("object") });
        }
        self.document.classes.push(blank(name, ClassKind::Composite, line))
    }
    pub(crate) fn kind(&mut self, name: &str, kind: ClassKind) -> ClassId {
        self.document.classes.push(blank(
            name,
            kind,
            vec![Superclass { class: ClassId(0), name: Name::new("object") }],
        ))
    }
    pub(crate) fn part(&mut self, class: ClassId, name: &str, of: ClassId) {
        let origin = self.origin();
        let part = Part {
            name: Name::new(name),
            doc: String::new(),
            class: of,
            count: None,
            range: None,
            is_layout: false,
            origin,
        };
        self.document.classes[class].parts.push(part);
    }
    pub(crate) fn given(&mut self, class: ClassId, at: &str, value: Term) {
        let (path, origin) = (path(at), self.origin());
        self.document.classes[class].givens.push(Rc::new(Given { path, value, origin }));
    }
    pub(crate) fn message(
        &mut self,
        class: ClassId,
        name: &str,
        parameters: &[(&str, &str)],
        answer: Term,
    ) {
        let parameter = |&(label, name): &(&str, &str)| Parameter {
            label: label.into(),
            name: name.into(),
            class: None,
        };
        let message = Message {
            name: Name::new(name),
            doc: String::new(),
            parameters: parameters.iter().map(parameter).collect(),
            class: None,
            answer: answer.into(),
            is_asked: false,
            is_default: false,
            is_combining: false,
            is_replacing: false,
            origin: self.origin(),
        };
        self.document.classes[class].messages.push(message);
    }
    pub(crate) fn constraint(&mut self, class: ClassId, name: &str, rule: Term) -> &mut Constraint {
        let name = Some(Name::new(name));
        let constraint = Constraint { name, ..Constraint::required(rule, self.origin()) };
        let constraints = &mut self.document.classes[class].constraints;
        constraints.push(constraint);
        constraints.last_mut().expect("one was just added")
    }
    pub(crate) fn merge(&mut self, class: ClassId, paths: &[&str]) {
        let paths = paths.iter().map(|p| path(p)).collect();
        let merge = Merge { name: None, paths, origin: self.origin() };
        self.document.classes[class].merges.push(merge);
    }
    /// Makes the structure of a document without faults.
    pub(crate) fn structure(&self) -> Structure {
        let (structure, faults) = instantiate(&self.document);
        assert_eq!(faults, []);
        structure
    }
}

pub(crate) fn path(dotted: &str) -> Path {
    Path::of(&dotted.split('.').collect::<Vec<_>>())
}
pub(crate) fn part(dotted: &str) -> Term {
    Term::part(&dotted.split('.').collect::<Vec<_>>())
}
pub(crate) fn num(x: f64) -> Term {
    Term::number(x)
}
pub(crate) fn text(t: &str) -> Term {
    Term::Text(t.into())
}
pub(crate) fn op(operator: BinaryOperator, a: Term, b: Term) -> Term {
    Term::Binary(operator, Box::new(a), Box::new(b))
}
pub(crate) fn add(a: Term, b: Term) -> Term {
    op(BinaryOperator::Add, a, b)
}
pub(crate) fn sub(a: Term, b: Term) -> Term {
    op(BinaryOperator::Subtract, a, b)
}
pub(crate) fn equal(a: Term, b: Term) -> Term {
    op(BinaryOperator::Equal, a, b)
}
fn arguments(values: Vec<Term>) -> Vec<Argument> {
    values.into_iter().map(|value| Argument { label: None, value }).collect()
}
pub(crate) fn call(name: &str, values: Vec<Term>) -> Term {
    Term::Call { name: name.into(), arguments: arguments(values) }
}
pub(crate) fn send(to: Term, name: &str, values: Vec<Term>) -> Term {
    Term::Send { to: Box::new(to), name: name.into(), arguments: arguments(values), search: None }
}
pub(crate) fn make(class: ClassId, values: Vec<Term>) -> Term {
    Term::Make { class, arguments: arguments(values) }
}
pub(crate) fn labelled(name: &str, value: Term) -> Argument {
    Argument { label: Some(name.into()), value }
}
pub(crate) fn tuple(x: f64, y: f64) -> Term {
    Term::Tuple(vec![num(x), num(y)])
}
pub(crate) fn local(name: &str) -> Term {
    Term::Local(name.into())
}
pub(crate) fn lambda(name: &str, body: Term) -> Term {
    Term::Lambda(vec![name.into()], Box::new(body))
}
pub(crate) fn list(items: Vec<Term>) -> Term {
    Term::List(items)
}
pub(crate) fn method(targets: &[&str], values: Vec<Term>) -> Method {
    Method { targets: targets.iter().map(|t| path(t)).collect(), values, origin: OriginId(900) }
}
