//! Things made by constructors: fields without slots.

use crate::evaluate::{Answer, Given, Opening};
use crate::fault::{FaultKind, Trouble};
use crate::meaning::{Frame, Made, Meaning, Opaque};
use base::Name;
use kernel::{ClassId, ClassKind, Count, PartRef};
use std::rc::Rc;

impl<'a> Opening<'a> {
    /// Makes a thing from its fields, by name or by position; the rest is as its class says.
    pub(crate) fn make(&mut self, class: ClassId, arguments: &[Given<'a>]) -> Answer<'a> {
        let document = self.document;
        let layout = document.layout(class);
        let mut fields = Vec::with_capacity(layout.len());
        for (i, &field) in layout.iter().enumerate() {
            let name = document.field_name(field).clone();
            let labelled = arguments.iter().find(|a| a.0.as_ref().is_some_and(|l| *l == name));
            let positional = || arguments.get(i).filter(|a| a.0.is_none());
            let meaning = match labelled.or_else(positional) {
                Some(argument) => argument.1.clone(),
                None => self.default_field(class, &name, field, &fields)?,
            };
            fields.push((name, meaning));
        }
        Ok(Meaning::Made(Rc::new(Made { class, fields })))
    }

    /// Evaluates the value that a class gives to a field of its things; zero where it gives none.
    fn default_field(
        &mut self,
        class: ClassId,
        name: &Name,
        field: PartRef,
        so_far: &[(Name, Meaning<'a>)],
    ) -> Answer<'a> {
        let document = self.document;
        let path = kernel::Path::of(&[name]);
        let given = document
            .primary_line(class)
            .into_iter()
            .find_map(|c| document.classes[c].givens.iter().rev().find(|g| g.path == path));
        if let Some(given) = given {
            let me = Meaning::Made(Rc::new(Made { class, fields: so_far.to_vec() }));
            return self.deeper(|opening| opening.meaning(&given.value, &Frame::new(me)));
        }
        let count = document.declared(field).and_then(|part| part.count);
        self.blank(document.field_class(field), count)
    }

    /// Makes a value of a class of which nothing is said.
    fn blank(&mut self, class: ClassId, count: Option<Count>) -> Answer<'a> {
        let own = &self.document.classes[class];
        match own.kind {
            ClassKind::Primitive(p) if p.is_number() => Ok(self.number(0.0)),
            ClassKind::Primitive(_) => Ok(Meaning::Opaque(Opaque::default())),
            ClassKind::Composite => self.deeper(|opening| opening.make(class, &[])),
            ClassKind::List(element) => {
                let n = match own.count.map(Count::Fixed).or(count) {
                    Some(Count::Fixed(n)) => n,
                    Some(Count::Given) | None => 0,
                };
                let elements = (0..n).map(|_| self.blank(element, None));
                Ok(Meaning::List(elements.collect::<Result<_, _>>()?))
            }
            ClassKind::Set(_) => Ok(Meaning::List(Rc::from([]))),
            ClassKind::Reference(_) => {
                Err(Trouble::new(FaultKind::Reference, "a reference that names nothing"))
            }
        }
    }
}
