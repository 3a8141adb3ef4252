//! Counts given from outside: `frame: Frame { hexagon.n = 4 }`.
//!
//! In: the values that bodies give, once all parts are declared. Out: where one is a count of a thing further
//! in, the part on the way to it is of a narrower class in that body's things, down to the one whose count it
//! is. What stands further out says it last.

use super::Numbers;
use crate::lower::Lowerer;
use crate::members::Pending;
use crate::paths::loose_path;
use crate::scope::Scope;
use base::{Name, Place};
use kernel::{ClassId, ClassKind, PartRef, PartRole, Path, Step};
use syntax::ast::{AstNode, Expr};

/// A count that a body gives a thing further in.
struct Given {
    scope: Scope,
    /// From the body's thing to the one whose count it is.
    path: Vec<Step>,
    name: Name,
    value: Expr,
}

impl Lowerer<'_> {
    /// Makes the parts narrower to which bodies further out give other counts, and declares what is made.
    pub(crate) fn declare_for_counts_from_outside(&mut self) {
        self.declare_for_counts();
        let mut looked = 0;
        while !self.counts.spoken.is_empty() && looked < self.pending.len() {
            let mut given: Vec<Given> =
                self.pending[looked..].iter().filter_map(|p| self.count_from_outside(p)).collect();
            looked = self.pending.len();
            // a class before those below it
            given.sort_by_key(|g| self.document.primary_line(g.scope.class()).len());
            for each in given {
                self.give_count(each);
            }
            self.declare_for_counts();
        }
    }

    /// Returns what a value gives, if it is a count of a thing that the body's thing has.
    fn count_from_outside(&self, pending: &Pending) -> Option<Given> {
        let Pending::Value { scope, prefix, target: Some(target), value } = pending else {
            return None;
        };
        let target = loose_path(target)?;
        let (Step::Part(name), owner) = target.0.split_last()? else { return None };
        let path: Vec<Step> = prefix.iter().chain(owner).cloned().collect();
        let class = self.class_at(scope.class(), &Path(path.clone()))?;
        let is_count = !path.is_empty() && self.counts_of(class).contains_key(name);
        let (scope, name, value) = ((**scope).clone(), name.clone(), value.clone());
        is_count.then_some(Given { scope, path, name, value })
    }

    fn give_count(&mut self, Given { scope, path, name, value }: Given) {
        let class = scope.class();
        let Some(of) = self.class_at(class, &Path(path.clone())) else { return };
        let Some(number) = self.constant_in_body(&scope, (of, &name), &value) else { return };
        let Some((Step::Part(first), rest)) = path.split_first() else { return };
        let Some((field, was)) = self.field_at(class, first) else { return };
        let count = self.count_of_part(class, first);
        let numbers = Numbers::from([(name, number)]);
        let narrower = self.with_count_below(was, count, rest, &numbers);
        if let Some(made) = self.class_at(narrower, &Path(rest.to_vec())) {
            let place = Place { file: scope.file, span: value.span() };
            self.counts.asked.entry(made).or_insert(place);
        }
        if narrower == was {
            return;
        }
        if field.class == class {
            self.document.classes[class].parts[field.index].class = narrower;
            if class == self.document.root {
                self.counts.from_outside.insert(field.index as u32);
            }
            return;
        }
        let refined = &mut self.document.classes[class].refined;
        refined.retain(|(f, _)| *f != field);
        refined.push((field, narrower));
        self.longer.retain(|(of, f, _)| (*of, *f) != (class, field));
        self.longer.push((class, field, narrower));
    }

    /// Returns the class that a class is where a thing below its things has these counts; the class itself
    /// where that cannot be said. `count` is how many elements it has, if it is a list.
    fn with_count_below(
        &mut self,
        class: ClassId,
        count: Option<u32>,
        path: &[Step],
        numbers: &Numbers,
    ) -> ClassId {
        let Some((step, rest)) = path.split_first() else { return self.class_with(class, numbers) };
        match (step, &self.document.classes[class].kind) {
            (Step::Part(name), ClassKind::Composite) => {
                let Some((field, was)) = self.field_at(class, name) else { return class };
                let count = self.count_of_part(class, name);
                let narrower = self.with_count_below(was, count, rest, numbers);
                if narrower == was {
                    return class;
                }
                let (name, origin) = {
                    let c = &self.document.classes[class];
                    (c.name.to_string(), c.origin)
                };
                let one = self.add_narrower(&name, class, origin);
                self.document.classes[one].refined.push((field, narrower));
                self.longer.push((one, field, narrower));
                one
            }
            (Step::Index(_) | Step::Last, &ClassKind::List(element)) => {
                let list = &self.document.classes[class];
                let Some(count) = list.count.or(count) else { return class };
                let mut elements = list.elements.clone();
                elements.resize(count as usize, element);
                let at = match step {
                    Step::Index(i) => *i as usize,
                    Step::Last | Step::Part(_) | Step::Owner => elements.len().wrapping_sub(1),
                };
                let Some(&was) = elements.get(at) else { return class };
                let within = self.document.classes[was].count;
                let narrower = self.with_count_below(was, within, rest, numbers);
                if narrower == was {
                    return class;
                }
                elements[at] = narrower;
                self.list_of_own(element, elements)
            }
            _ => class,
        }
    }

    /// Returns the declared part of this name that things of a class have, and its class there.
    fn field_at(&self, class: ClassId, name: &Name) -> Option<(PartRef, ClassId)> {
        let line = self.document.primary_line(class);
        let own = |c: ClassId| Some((c, *self.parts.get(&(c, name.clone()))?));
        let (declares, index) = line.into_iter().find_map(own)?;
        let field = PartRef { class: declares, index, role: PartRole::Part };
        Some((field, self.document.refined_class(class, field)))
    }
}
