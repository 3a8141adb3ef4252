//! Documents made by hand, and a host that knows a few terms.

use base::Name;
use expr::dimension::Dimension;
use kernel::{
    Argument, BinaryOperator, Class, ClassId, ClassKind, Classes, Constraint, ConstraintInstance,
    Document, Given, Insert, Merge, Message, Method, OriginId, Parameter, Part, Path, Primitive,
    SlotId, Stay, Step, Strength, Structure, Superclass, Term, ThingId, Value, Values, Vertical,
    instantiate,
};
use plan::{
    EditKind, EditReport, Fault, Host, Model, Planner, Plans, SideOf, Target, Templates, Way,
};
use std::rc::Rc;
use std::sync::Arc;

pub(crate) const OBJECT: ClassId = ClassId(0);
pub(crate) const REAL: ClassId = ClassId(1);
pub(crate) const LENGTH: ClassId = ClassId(2);
pub(crate) const TEXT: ClassId = ClassId(3);
pub(crate) const POINT: ClassId = ClassId(4);
pub(crate) const SET_OF_REAL: ClassId = ClassId(5);

pub(crate) struct Builder {
    pub(crate) document: Document,
}

fn blank(name: &str, kind: ClassKind, supers: Vec<Superclass>) -> Class {
    Class::new(Name::new(name), kind, supers, OriginId(0))
}

impl Builder {
    pub(crate) fn new() -> Self {
        let object = vec![Superclass { class: OBJECT, name: Name::new("object") }];
        let primitive = |name, p| blank(name, ClassKind::Primitive(p), object.clone());
        let classes = Classes::from_iter([
            blank("Object", ClassKind::Composite, Vec::new()),
            primitive("Real", Primitive::Real(Dimension::NONE)),
            primitive("Length", Primitive::Real(Dimension::LENGTH)),
            primitive("Text", Primitive::Text),
        ]);
        let document = Document {
            classes,
            root: OBJECT,
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
        let mut builder = Self { document };
        assert_eq!(builder.class("Point", &[("x", LENGTH), ("y", LENGTH)]), POINT);
        let set = blank("Set of Real", ClassKind::Set(REAL), object);
        assert_eq!(builder.document.classes.push(set), SET_OF_REAL);
        builder
    }
    pub(crate) fn class(&mut self, name: &str, parts: &[(&str, ClassId)]) -> ClassId {
        self.subclass(name, OBJECT, parts)
    }
    pub(crate) fn subclass(
        &mut self,
        name: &str,
        above: ClassId,
        parts: &[(&str, ClassId)],
    ) -> ClassId {
        let supers = vec![Superclass { class: above, name: Name::new("above") }];
        let mut class = blank(name, ClassKind::Composite, supers);
        class.parts = parts
            .iter()
            .map(|&(name, class)| Part {
                name: Name::new(name),
                doc: String::new(),
                class,
                count: None,
                range: None,
                is_layout: false,
                origin: OriginId(0),
            })
            .collect();
        self.document.classes.push(class)
    }
    pub(crate) fn given(&mut self, class: ClassId, path: &str, value: Term) {
        let given = Given { path: to_path(path), value, origin: OriginId(0) };
        self.document.classes[class].givens.push(Rc::new(given));
    }
    pub(crate) fn constraint(&mut self, class: ClassId, rule: Term) -> &mut Constraint {
        let constraints = &mut self.document.classes[class].constraints;
        let origin = OriginId(constraints.len() as u32 + 100);
        constraints.push(Constraint::required(rule, origin));
        constraints.last_mut().expect("it was just pushed")
    }
    pub(crate) fn merge(&mut self, class: ClassId, paths: &[&str]) {
        let paths = paths.iter().map(|p| to_path(p)).collect();
        self.document.classes[class].merges.push(Merge { name: None, paths, origin: OriginId(0) });
    }
    pub(crate) fn insert(&mut self, class: ClassId, member: &str, set: &str) {
        let insert = Insert { part: to_path(member), set: to_path(set), origin: OriginId(0) };
        self.document.classes[class].inserts.push(insert);
    }
    pub(crate) fn stay(&mut self, class: ClassId, path: &str, strength: Option<Strength>) {
        let stay = Stay { path: to_path(path), strength, origin: OriginId(0) };
        self.document.classes[class].stays.push(stay);
    }
    pub(crate) fn message(&mut self, class: ClassId, name: &str, of: &[&str], answer: Term) {
        let parameters = of
            .iter()
            .map(|p| Parameter { label: Name::new(p), name: Name::new(p), class: None })
            .collect();
        self.document.classes[class].messages.push(Message {
            name: Name::new(name),
            doc: String::new(),
            parameters,
            class: None,
            answer: answer.into(),
            is_asked: false,
            is_default: false,
            is_combining: false,
            is_replacing: false,
            origin: OriginId(0),
        });
    }
    pub(crate) fn open(mut self, root: ClassId) -> Lab {
        self.document.root = root;
        let (structure, faults) = instantiate(&self.document);
        assert_eq!(faults, vec![]);
        let model = Model { document: &self.document, structure: &structure };
        let (mut planner, faults) = Planner::new(model, Plans::default());
        let mut values = Values::default();
        let mut host = Terms { document: &self.document, structure: &structure };
        let opened = planner.open(model, &mut values, &mut host);
        // what classes say may be known before: nothing comes out otherwise
        let (mut again, told) = Planner::new(model, Plans::over(Templates::of(model)));
        let mut came = Values::default();
        let reopened = again.open(model, &mut came, &mut host);
        assert_eq!((told, came, reopened), (faults.clone(), values.clone(), opened.clone()));
        Lab { document: self.document, structure, planner, values, faults, opened }
    }
}

/// An open document.
pub(crate) struct Lab {
    pub(crate) document: Document,
    pub(crate) structure: Structure,
    pub(crate) planner: Planner,
    pub(crate) values: Values,
    pub(crate) faults: Vec<Fault>,
    pub(crate) opened: EditReport,
}

impl Lab {
    pub(crate) fn thing(&self, path: &str) -> ThingId {
        self.structure.follow(ThingId(0), &to_path(path)).expect("the path leads somewhere")
    }
    pub(crate) fn slot(&self, path: &str) -> SlotId {
        self.structure.slot_of(self.thing(path)).expect("the part is primitive")
    }
    pub(crate) fn number(&self, path: &str) -> f64 {
        self.values.numbers[self.slot(path)]
    }
    pub(crate) fn text(&self, path: &str) -> String {
        self.values.texts.get(&self.slot(path)).map(ToString::to_string).unwrap_or_default()
    }
    pub(crate) fn status(&mut self) -> plan::Status {
        let model = Model { document: &self.document, structure: &self.structure };
        let mut host = Terms { document: &self.document, structure: &self.structure };
        self.planner.status(model, &self.values, &mut host)
    }
    pub(crate) fn redundancy(&mut self) -> plan::Redundancy {
        let unmet = self.status().unmet;
        let model = Model { document: &self.document, structure: &self.structure };
        let mut host = Terms { document: &self.document, structure: &self.structure };
        self.planner.redundancy(model, &self.values, &unmet, &mut host)
    }
    pub(crate) fn contradictions(&mut self) -> Vec<plan::Contradiction> {
        let unmet = self.status().unmet;
        let model = Model { document: &self.document, structure: &self.structure };
        let mut host = Terms { document: &self.document, structure: &self.structure };
        self.planner.contradictions(model, &self.values, &unmet, &mut host)
    }
    pub(crate) fn analyse(&mut self) -> plan::Analysis {
        let model = Model { document: &self.document, structure: &self.structure };
        let mut host = Terms { document: &self.document, structure: &self.structure };
        self.planner.analyse(model, &self.values, &mut host)
    }
    pub(crate) fn why(&mut self, slot: SlotId) -> plan::Why {
        let model = Model { document: &self.document, structure: &self.structure };
        self.planner.why(model, slot, &std::collections::BTreeSet::new())
    }
    pub(crate) fn why_not(&mut self, slot: SlotId) -> Vec<plan::Conflict> {
        let model = Model { document: &self.document, structure: &self.structure };
        self.planner.why_not(model, slot)
    }
    pub(crate) fn edit(&mut self, kind: EditKind, edits: &[(&str, &[f64])]) -> EditReport {
        let targets: Vec<(Target<'_>, Vec<Value>)> = edits
            .iter()
            .map(|(path, xs)| {
                let xs = xs.iter().map(|&x| Value::Number(x)).collect();
                (Target::Thing(self.thing(path)), xs)
            })
            .collect();
        self.edit_targets(kind, &targets)
    }
    pub(crate) fn edit_targets(
        &mut self,
        kind: EditKind,
        targets: &[(Target<'_>, Vec<Value>)],
    ) -> EditReport {
        let model = Model { document: &self.document, structure: &self.structure };
        let mut host = Terms { document: &self.document, structure: &self.structure };
        self.planner.edit(model, &mut self.values, kind, targets, &mut host)
    }
    pub(crate) fn set(&mut self, path: &str, xs: &[f64]) -> EditReport {
        self.edit(EditKind::Set, &[(path, xs)])
    }
    pub(crate) fn move_to(&mut self, path: &str, xs: &[f64]) -> EditReport {
        self.edit(EditKind::Move, &[(path, xs)])
    }
    /// Returns the paths of changed slots, in order.
    pub(crate) fn moved(&self, report: &EditReport) -> Vec<String> {
        let path = |s: &SlotId| self.structure.path(&self.document, self.structure.slots[*s].thing);
        report.changed.iter().map(|s| path(s).to_string()).collect()
    }
}

pub(crate) fn to_path(text: &str) -> Path {
    let step = |s: &str| match s.parse() {
        Ok(i) => Step::Index(i),
        Err(_) => Step::Part(Name::new(s)),
    };
    Path(text.split('.').filter(|s| !s.is_empty()).map(step).collect())
}

pub(crate) fn p(path: &str) -> Term {
    Term::part(&path.split('.').collect::<Vec<_>>())
}
pub(crate) fn n(x: f64) -> Term {
    Term::number(x)
}
pub(crate) fn binary(operator: BinaryOperator, a: Term, b: Term) -> Term {
    Term::Binary(operator, Box::new(a), Box::new(b))
}
pub(crate) fn equal(a: Term, b: Term) -> Term {
    binary(BinaryOperator::Equal, a, b)
}
pub(crate) fn both(a: Term, b: Term) -> Term {
    binary(BinaryOperator::And, a, b)
}
pub(crate) fn add(a: Term, b: Term) -> Term {
    binary(BinaryOperator::Add, a, b)
}
pub(crate) fn sub(a: Term, b: Term) -> Term {
    binary(BinaryOperator::Subtract, a, b)
}
pub(crate) fn mul(a: Term, b: Term) -> Term {
    binary(BinaryOperator::Multiply, a, b)
}
pub(crate) fn div(a: Term, b: Term) -> Term {
    binary(BinaryOperator::Divide, a, b)
}
pub(crate) fn pair(x: f64, y: f64) -> Term {
    Term::Tuple(vec![n(x), n(y)])
}
pub(crate) fn call(name: &str, arguments: Vec<Term>) -> Term {
    let arguments = arguments.into_iter().map(|value| Argument { label: None, value }).collect();
    Term::Call { name: Name::new(name), arguments }
}
pub(crate) fn send(to: Term, name: &str, arguments: Vec<Term>) -> Term {
    let arguments = arguments.into_iter().map(|value| Argument { label: None, value }).collect();
    Term::Send { to: Box::new(to), name: Name::new(name), arguments, search: None }
}
pub(crate) fn method(target: &str, value: Term) -> Method {
    Method { targets: vec![to_path(target)], values: vec![value], origin: OriginId(7) }
}

/// Computes constants, parts, `.text` and `.number`.
pub(crate) struct Terms<'a> {
    pub(crate) document: &'a Document,
    pub(crate) structure: &'a Structure,
}

impl Terms<'_> {
    fn term(&self, me: ThingId, term: &Term, values: &Values) -> Result<Value, String> {
        match term {
            Term::Number { value, .. } => Ok(Value::Number(*value)),
            Term::Text(text) => Ok(Value::Text(Arc::from(text.as_str()))),
            Term::Send { to, name, .. } if *name == "text" => {
                let Value::Number(x) = self.term(me, to, values)? else {
                    return Err("not a number".into());
                };
                Ok(Value::Text(Arc::from(base::number::shortest(x))))
            }
            Term::Send { to, name, .. } if *name == "number" => {
                let Value::Text(text) = self.term(me, to, values)? else {
                    return Err("not a text".into());
                };
                let read = text.parse().map_err(|_| format!("{text:?} is not a number"));
                read.map(Value::Number)
            }
            Term::Send { .. } => {
                let slot = self.structure.slot_of(self.part(me, term));
                Ok(values.get(slot.expect("the part is primitive")))
            }
            other => Err(format!("this host does not know {other:?}")),
        }
    }
    fn part(&self, me: ThingId, term: &Term) -> ThingId {
        match term {
            Term::Me => me,
            Term::Send { to, name, .. } => {
                let to = self.part(me, to);
                self.structure.part_named(to, name).expect("the part is there")
            }
            other => panic!("not a path: {other:?}"),
        }
    }
    fn rule(&self, constraint: ConstraintInstance) -> &Constraint {
        &self.document.classes[constraint.class].constraints[constraint.index as usize]
    }
    fn sides(&self, constraint: ConstraintInstance) -> (&Term, &Term) {
        match &*self.rule(constraint).rule {
            Term::Binary(BinaryOperator::Equal, a, b) => (a, b),
            other => panic!("not an equality: {other:?}"),
        }
    }
}

impl Host for Terms<'_> {
    fn given(&mut self, slot: SlotId, values: &Values) -> Option<Value> {
        let given = self.structure.slots[slot].given?;
        self.term(given.me, &self.structure.givens[given.value].term, values).ok()
    }
    fn compute(
        &mut self,
        constraint: ConstraintInstance,
        way: Way,
        values: &Values,
    ) -> Result<Vec<(SlotId, Value)>, String> {
        let me = constraint.owner;
        let (target, value) = match way {
            Way::Written(i) => {
                let method = &self.rule(constraint).methods[i as usize];
                let target = self.structure.follow(me, &method.targets[0]);
                (target.expect("the target is there"), &method.values[0])
            }
            Way::Left(_) => {
                let (left, right) = self.sides(constraint);
                (self.part(me, left), right)
            }
            Way::Right(_) => {
                let (left, right) = self.sides(constraint);
                (self.part(me, right), left)
            }
        };
        let slot = self.structure.slot_of(target).expect("the target is primitive");
        Ok(vec![(slot, self.term(me, value, values)?)])
    }
    fn number(
        &mut self,
        constraint: ConstraintInstance,
        side: SideOf,
        values: &Values,
    ) -> Result<f64, String> {
        let Term::Binary(_, left, right) = &*self.rule(constraint).rule else {
            return Err("nothing is compared".into());
        };
        let term = if side.is_right { right } else { left };
        match self.term(constraint.owner, term, values)? {
            Value::Number(x) => Ok(x),
            Value::Text(text) => Err(format!("{text} is no number")),
        }
    }
    fn holds(&mut self, constraint: ConstraintInstance, values: &Values) -> bool {
        let (left, right) = self.sides(constraint);
        let me = constraint.owner;
        self.term(me, left, values) == self.term(me, right, values)
    }
}
