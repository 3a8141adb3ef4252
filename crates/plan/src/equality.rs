//! Equality of things: part by part, over what both have from their nearest common ancestor.

use crate::evaluate::{Opening, kind};
use crate::fault::Trouble;
use crate::meaning::Meaning;
use base::Name;
use kernel::{ClassId, ClassKind, ThingId};

/// Two meanings that are to be one, neither of them a thing.
pub(crate) type Leaf<'a> = (Meaning<'a>, Meaning<'a>);

impl<'a> Opening<'a> {
    /// Returns the pairs of numbers and texts that are equal where `a` and `b` are.
    pub(crate) fn leaves(
        &mut self,
        a: &Meaning<'a>,
        b: &Meaning<'a>,
    ) -> Result<Vec<Leaf<'a>>, Trouble> {
        let mut leaves = Vec::new();
        self.collect_leaves(a, b, &mut leaves)?;
        Ok(leaves)
    }

    fn collect_leaves(
        &mut self,
        a: &Meaning<'a>,
        b: &Meaning<'a>,
        leaves: &mut Vec<Leaf<'a>>,
    ) -> Result<(), Trouble> {
        self.count_term()?;
        match (a, b) {
            (Meaning::Lambda(_), _) | (_, Meaning::Lambda(_)) => {
                Err(Trouble::wrong("functions are not compared"))
            }
            (Meaning::Drawn(_), _) | (_, Meaning::Drawn(_)) => {
                Err(Trouble::wrong("drawings are compared by what is in them"))
            }
            (Meaning::Opaque(_), _) | (_, Meaning::Opaque(_)) => {
                leaves.push((a.clone(), b.clone()));
                Ok(())
            }
            (Meaning::Number(_), Meaning::Number(_)) => {
                leaves.push((a.clone(), b.clone()));
                Ok(())
            }
            (Meaning::Number(_), _) | (_, Meaning::Number(_)) => {
                Err(Trouble::wrong(format!("{} and {} are never equal", kind(a), kind(b))))
            }
            (Meaning::Thing(s), Meaning::Thing(t)) if self.reach.is_same(*s, *t) => Ok(()),
            (Meaning::List(_), _) | (_, Meaning::List(_)) => {
                let (a, b) = (self.by_position(a)?, self.by_position(b)?);
                self.pairs(&a, &b, leaves)
            }
            (Meaning::Thing(_) | Meaning::Made(_), Meaning::Thing(_) | Meaning::Made(_)) => {
                if let (Ok(a), Ok(b)) = (self.items(a), self.items(b)) {
                    return self.pairs(&a, &b, leaves);
                }
                let class = self.common_ancestor(a, b)?;
                for name in self.field_names(class) {
                    let a = self.send(a, &name, &[], None)?;
                    let b = self.send(b, &name, &[], None)?;
                    self.collect_leaves(&a, &b, leaves)?;
                }
                Ok(())
            }
        }
    }

    fn pairs(
        &mut self,
        a: &[Meaning<'a>],
        b: &[Meaning<'a>],
        leaves: &mut Vec<Leaf<'a>>,
    ) -> Result<(), Trouble> {
        if a.len() != b.len() {
            let message = format!("{} elements and {} are never equal", a.len(), b.len());
            return Err(Trouble::wrong(message));
        }
        a.iter().zip(b).try_for_each(|(a, b)| self.collect_leaves(a, b, leaves))
    }

    /// Returns the elements of a list, or the stored parts of a thing, in order.
    fn by_position(&mut self, meaning: &Meaning<'a>) -> Result<Vec<Meaning<'a>>, Trouble> {
        if let Ok(items) = self.items(meaning) {
            return Ok(items.to_vec());
        }
        match meaning {
            Meaning::Thing(t) => self.reach.parts(*t).into_iter().map(|t| self.part(t)).collect(),
            Meaning::Made(made) => Ok(made.fields.iter().map(|f| f.1.clone()).collect()),
            Meaning::Number(_)
            | Meaning::List(_)
            | Meaning::Opaque(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_) => Err(Trouble::wrong(format!("{} has no parts", kind(meaning)))),
        }
    }

    /// Returns the nearest class that both things are of and that has parts.
    pub(crate) fn common_ancestor(
        &self,
        a: &Meaning<'a>,
        b: &Meaning<'a>,
    ) -> Result<ClassId, Trouble> {
        let (ca, cb) = (self.class_of(a)?, self.class_of(b)?);
        let others = self.document.lineage(cb);
        let nearest = self.document.lineage(ca).into_iter().find(|c| others.contains(c));
        nearest.filter(|&c| !self.document.layout(c).is_empty()).ok_or_else(|| {
            let name = |c: ClassId| &self.document.classes[c].name;
            Trouble::wrong(format!("{} and {} have no parts in common", name(ca), name(cb)))
        })
    }

    fn class_of(&self, meaning: &Meaning<'a>) -> Result<ClassId, Trouble> {
        match meaning {
            Meaning::Thing(t) => Ok(self.structure.things[*t].class),
            Meaning::Made(made) => Ok(made.class),
            Meaning::Number(_)
            | Meaning::List(_)
            | Meaning::Opaque(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_) => Err(Trouble::wrong(format!("{} has no parts", kind(meaning)))),
        }
    }

    /// Returns the names of the fields of a class's things, in order.
    pub(crate) fn field_names(&self, class: ClassId) -> Vec<Name> {
        let layout = self.document.layout(class);
        layout.into_iter().map(|f| self.document.field_name(f).clone()).collect()
    }

    /// Hands a value to the slots of a thing: itself, by position, or part by part.
    pub(crate) fn share(
        &mut self,
        target: ThingId,
        value: &Meaning<'a>,
    ) -> Result<Vec<(kernel::SlotId, Meaning<'a>)>, Trouble> {
        if let Some(slot) = self.reach.slot(target) {
            return match value {
                Meaning::Number(_) | Meaning::Opaque(_) => Ok(vec![(slot, value.clone())]),
                other => Err(Trouble::wrong(format!("{} is no value for a number", kind(other)))),
            };
        }
        if let Meaning::Opaque(_) = value {
            let slots = self.reach.slots_under(target);
            return Ok(slots.into_iter().map(|s| (s, value.clone())).collect());
        }
        let by_name = match value {
            Meaning::Thing(_) | Meaning::Made(_) => {
                matches!(self.kind_of(target), ClassKind::Composite)
            }
            Meaning::Number(_)
            | Meaning::List(_)
            | Meaning::Opaque(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_) => false,
        };
        let mut shared = Vec::new();
        if by_name {
            let class = self.common_ancestor(&Meaning::Thing(target), value)?;
            for name in self.field_names(class) {
                let part = self.reach.part_named(target, &name);
                let part = part.ok_or_else(|| Trouble::wrong(format!("no part `{name}`")))?;
                let value = self.send(value, &name, &[], None)?;
                shared.extend(self.share(part, &value)?);
            }
        } else {
            let parts = self.reach.parts(target);
            let values = self.by_position(value)?;
            if parts.len() != values.len() {
                let message = format!("{} values for {} parts", values.len(), parts.len());
                return Err(Trouble::wrong(message));
            }
            for (part, value) in parts.into_iter().zip(values) {
                shared.extend(self.share(part, &value)?);
            }
        }
        Ok(shared)
    }

    fn kind_of(&self, thing: ThingId) -> &'a ClassKind {
        &self.document.classes[self.structure.things[thing].class].kind
    }
}
