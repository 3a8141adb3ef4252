//! Documents built by hand.

use base::Name;
use expr::dimension::Dimension;
use kernel::{
    Class, ClassId, ClassKind, Classes, Constraint, Count, Document, Given, Merge, OriginId, Part,
    Path, Primitive, Superclass, Term, Vertical,
};
use std::rc::Rc;

pub(crate) const ORIGIN: OriginId = OriginId(0);

/// Classes under construction; the last one made is the document's.
pub(crate) struct Builder(pub(crate) Classes);

impl Builder {
    pub(crate) fn new() -> (Self, ClassId, ClassId) {
        let mut b = Self(Classes::new());
        let object = b.class("Object", ClassKind::Composite, &[]);
        let real = ClassKind::Primitive(Primitive::Real(Dimension::NONE));
        let real = b.class("Real", real, &[object]);
        (b, object, real)
    }
    pub(crate) fn class(&mut self, name: &str, kind: ClassKind, supers: &[ClassId]) -> ClassId {
        let supers = supers.iter().map(|&class| Superclass {
            class,
            name: Name::new(&self.0[class].name.to_lowercase()),
        });
        self.0.push(Class::new(name.into(), kind, supers.collect(), ORIGIN))
    }
    pub(crate) fn composite(
        &mut self,
        name: &str,
        above: ClassId,
        parts: &[(&str, ClassId)],
    ) -> ClassId {
        let id = self.class(name, ClassKind::Composite, &[above]);
        for &(name, class) in parts {
            self.part(id, name, class, None);
        }
        id
    }
    pub(crate) fn part(
        &mut self,
        owner: ClassId,
        name: &str,
        class: ClassId,
        count: Option<Count>,
    ) {
        let (name, doc) = (name.into(), String::new());
        self.0[owner].parts.push(Part {
            name,
            doc,
            class,
            count,
            range: None,
            is_layout: false,
            origin: ORIGIN,
        });
    }
    pub(crate) fn merge(&mut self, class: ClassId, paths: &[&[&str]]) {
        let paths = paths.iter().map(|p| Path::of(p)).collect();
        self.0[class].merges.push(Merge { name: None, paths, origin: ORIGIN });
    }
    pub(crate) fn given(&mut self, class: ClassId, path: &[&str], value: Term) {
        self.0[class].givens.push(Rc::new(Given { path: Path::of(path), value, origin: ORIGIN }));
    }
    pub(crate) fn constraint(&mut self, class: ClassId, name: &str) {
        let name = Some(name.into());
        let constraint = Constraint { name, ..Constraint::required(Term::Bool(true), ORIGIN) };
        self.0[class].constraints.push(constraint);
    }
    pub(crate) fn document(self, root: ClassId) -> Document {
        Document {
            classes: self.0,
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
        }
    }
}
