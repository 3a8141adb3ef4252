//! Things made by constructors: fields without slots.

use crate::evaluate::{Answer, Given as Argument, Opening};
use crate::fault::{FaultKind, Trouble};
use crate::meaning::{Frame, Made, Meaning, Opaque};
use base::Name;
use kernel::{ClassId, ClassKind, Count, Given, PartRef, Step};
use std::rc::Rc;

impl<'a> Opening<'a> {
    /// Makes a thing from its fields, by name or by position; the rest is as its class says.
    pub(crate) fn make(&mut self, class: ClassId, arguments: &[Argument<'a>]) -> Answer<'a> {
        let document = self.document;
        let layout = document.layout(class);
        let mut fields = Vec::with_capacity(layout.len());
        for (i, &field) in layout.iter().enumerate() {
            let name = document.field_name(field).clone();
            let labelled = arguments.iter().find(|a| a.0.as_ref().is_some_and(|l| *l == name));
            let positional = || arguments.get(i).filter(|a| a.0.is_none());
            let meaning = match labelled.or_else(positional) {
                Some(argument) => self.as_class(&argument.1, document.field_class(field))?,
                None => self.default_field(class, &name, field, &fields)?,
            };
            fields.push((name, meaning));
        }
        Ok(Meaning::Made(Rc::new(Made { class, fields })))
    }

    /// Makes a thing of a class of values by position, `(x, y)`; anything else is as it is.
    fn as_class(&mut self, meaning: &Meaning<'a>, class: ClassId) -> Answer<'a> {
        match (meaning, &self.document.classes[class].kind) {
            (Meaning::List(items), ClassKind::Composite) => {
                let items: Vec<Argument<'a>> = items.iter().map(|m| (None, m.clone())).collect();
                self.deeper(|opening| opening.make(class, &items))
            }
            _ => Ok(meaning.clone()),
        }
    }

    /// Evaluates what a class gives to a field of its things and to the field's parts, its superclasses first;
    /// zero where it gives nothing.
    fn default_field(
        &mut self,
        class: ClassId,
        name: &Name,
        field: PartRef,
        so_far: &[(Name, Meaning<'a>)],
    ) -> Answer<'a> {
        let document = self.document;
        let me = Meaning::Made(Rc::new(Made { class, fields: so_far.to_vec() }));
        let own = |given: &&'a Rc<Given>| given.path.0.first() == Some(&Step::Part(name.clone()));
        let line = document.primary_line(class).into_iter().rev();
        let classes = line.map(|c| &document.classes[c]);
        let givens = classes.flat_map(|c| c.connections.iter().chain(&c.givens)).filter(own);
        let givens: Vec<&'a Rc<Given>> = givens.collect();
        // a value of the whole stands for all that was said before
        let from = givens.iter().rposition(|given| given.path.0.len() == 1).unwrap_or(0);
        let mut made = None;
        for given in &givens[from..] {
            let frame = Frame::new(me.clone());
            let value = self.deeper(|opening| opening.meaning(&given.value, &frame))?;
            if given.path.0.len() > 1 && made.is_none() {
                made = Some(self.blank_field(field)?);
            }
            match &mut made {
                Some(made) => put(made, &given.path.0[1..], value),
                None => made = Some(value),
            }
        }
        made.map_or_else(|| self.blank_field(field), Ok)
    }

    fn blank_field(&mut self, field: PartRef) -> Answer<'a> {
        let count = self.document.declared(field).and_then(|part| part.count);
        self.blank(self.document.field_class(field), count)
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

/// Puts a value where a path leads in a thing that was made; where it leads nowhere nothing is put.
fn put<'a>(made: &mut Meaning<'a>, path: &[Step], value: Meaning<'a>) {
    let [first, inner @ ..] = path else {
        *made = value;
        return;
    };
    match (made, first) {
        (Meaning::Made(thing), Step::Part(name)) => {
            let thing = Rc::make_mut(thing);
            if let Some((_, field)) = thing.fields.iter_mut().find(|(own, _)| own == name) {
                put(field, inner, value);
            }
        }
        (Meaning::List(items), Step::Index(_) | Step::Last) => {
            let mut own = items.to_vec();
            let at = match first {
                Step::Index(i) => *i as usize,
                Step::Last | Step::Part(_) | Step::Owner => own.len().wrapping_sub(1),
            };
            if let Some(item) = own.get_mut(at) {
                put(item, inner, value);
            }
            *items = own.into();
        }
        (
            Meaning::Number(_)
            | Meaning::Opaque(_)
            | Meaning::Thing(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_)
            | Meaning::Made(_)
            | Meaning::List(_),
            _,
        ) => {}
    }
}
