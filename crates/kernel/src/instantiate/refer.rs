//! References: a path that was given in, the thing that it leads to out.
//!
//! The path is read in the thing whose class or body gives it: one that begins at an owner leads
//! elsewhere from a copy, one that begins at the document does not. It may lead through other
//! references.

use super::{FaultKind, Maker};
use crate::class::{ClassId, ClassKind};
use crate::document::Document;
use crate::path::{Path, Step};
use crate::structure::{DOCUMENT, Form, GivenIn, Givens, ThingId};
use crate::term::Term;
use std::collections::BTreeMap;

/// How many references one path may lead through.
const DEEPEST: u32 = 100;

/// Finds what every reference names. One that names nothing is reported, and stays without.
pub(super) fn refer(
    maker: &mut Maker<'_>,
    structure: &mut Form,
    givens: &Givens,
    given: &BTreeMap<ThingId, GivenIn>,
) {
    let document = maker.document;
    for (&reference, &value) in given {
        let ClassKind::Reference(class) = document.classes[structure.things[reference].class].kind
        else {
            continue;
        };
        let search = Search { document, structure, givens, given };
        let found = search.target(value, 0).and_then(|t| search.of_class(t, class));
        match found {
            Ok(target) => {
                let all = structure.merged_with(reference);
                structure.references.extend(all.into_iter().map(|r| (r, target)));
            }
            Err(message) => {
                let origin = givens[value.value].origin;
                maker.fault(origin, FaultKind::Reference, message);
            }
        }
    }
}

/// Things as they are searched for the target of a reference.
struct Search<'s> {
    document: &'s Document,
    structure: &'s Form,
    givens: &'s Givens,
    given: &'s BTreeMap<ThingId, GivenIn>,
}

impl Search<'_> {
    fn target(&self, value: GivenIn, depth: u32) -> Result<ThingId, String> {
        if depth > DEEPEST {
            return Err(format!("a reference through more than {DEEPEST} others"));
        }
        self.follow(&self.givens[value.value].term, value.me, depth)
    }

    fn follow(&self, term: &Term, me: ThingId, depth: u32) -> Result<ThingId, String> {
        let s = self.structure;
        let step = |from: ThingId, step: Step| {
            let lost = || self.lost(from, &step);
            let next = s.follow(from, &Path(vec![step.clone()])).map_err(|_| lost())?;
            self.through(next, depth)
        };
        match term {
            Term::Me => Ok(me),
            Term::Document => Ok(DOCUMENT),
            Term::Owner => step(me, Step::Owner),
            Term::Send { to, name, arguments, search: None } if arguments.is_empty() => {
                let from = self.follow(to, me, depth)?;
                let is_list =
                    matches!(self.document.classes[s.things[from].class].kind, ClassKind::List(_));
                match name.as_str() {
                    "owner" => step(from, Step::Owner),
                    "last" if is_list => step(from, Step::Last),
                    "first" if is_list => step(from, Step::Index(0)),
                    _ => step(from, Step::Part(name.clone())),
                }
            }
            Term::Index(list, at) => match at.as_ref() {
                Term::Number { value, .. } if value.fract() == 0.0 && *value >= 0.0 => {
                    step(self.follow(list, me, depth)?, Step::Index(*value as u32))
                }
                _ => Err("an index in a reference is a whole number, from 0".into()),
            },
            _ => Err("a reference names a part by its path, `a.b.c`".into()),
        }
    }

    /// Goes on to what a reference names.
    fn through(&self, thing: ThingId, depth: u32) -> Result<ThingId, String> {
        let s = self.structure;
        match self.document.classes[s.things[thing].class].kind {
            ClassKind::Reference(_) => match s.references.get(&thing) {
                Some(&target) => Ok(target),
                None => {
                    let first = s.identity(thing);
                    let value = self.given.get(&thing).or_else(|| self.given.get(&first));
                    let value = value
                        .ok_or_else(|| format!("{} names nothing", s.path(self.document, thing)))?;
                    self.target(*value, depth + 1)
                }
            },
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::List(_)
            | ClassKind::Set(_) => Ok(thing),
        }
    }

    fn of_class(&self, thing: ThingId, wanted: ClassId) -> Result<ThingId, String> {
        let s = self.structure;
        let is = |t: ThingId| self.document.is_a(s.things[t].class, wanted);
        if s.merged_with(thing).into_iter().any(is) {
            return Ok(thing);
        }
        let name = |class| &self.document.classes[self.document.named_class(class)].name;
        let (path, wanted) = (s.path(self.document, thing), name(wanted));
        Err(match path.is_empty() {
            true => format!("this leads to the document, wanted one of {wanted}"),
            false => {
                format!("{path} is of {}, wanted one of {wanted}", name(s.things[thing].class))
            }
        })
    }

    fn lost(&self, from: ThingId, step: &Step) -> String {
        let path = self.structure.path(self.document, from);
        match step {
            Step::Owner => "the document is a part of nothing".into(),
            Step::Part(name) if path.is_empty() => format!("the document has no part {name}"),
            Step::Part(name) => format!("{path} has no part {name}"),
            Step::Index(i) => format!("{path} has no element {i}"),
            Step::Last => format!("{path} has no elements"),
        }
    }
}
