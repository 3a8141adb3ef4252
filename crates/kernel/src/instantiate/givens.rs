//! Given values on their way down: a value for a path in, a value for each primitive part out.

use super::body::Body;
use super::fill::has_room;
use super::grown::Shared;
use super::{FaultKind, MOST_COPIES, Maker};
use crate::class::{ClassId, ClassKind};
use crate::document::{Document, PartRef};
use crate::path::{Path, Step};
use crate::structure::{GivenId, GivenIn, GivenTerm, ThingId};
use crate::term::{Argument, Term};
use base::Name;
use std::rc::Rc;

/// A given value on its way to the thing that it is for.
#[derive(Clone, Copy)]
pub(super) struct Binding<'d> {
    /// The way that is still to go.
    pub(super) path: &'d [Step],
    pub(super) given: GivenIn,
}

/// A binding, and the part of a thing that it leads to or through.
#[derive(Clone, Copy)]
pub(super) struct ShareOf<'d> {
    pub(super) part: u32,
    pub(super) binding: Binding<'d>,
}

/// Returns what a thing's class gives its parts, superclasses first.
pub(super) fn own_bindings<'d>(
    maker: &mut Maker<'d>,
    me: ThingId,
    class: ClassId,
) -> Vec<Binding<'d>> {
    let document = maker.document;
    let mut bindings = Vec::new();
    for class in document.primary_line(class).into_iter().rev() {
        for given in &document.classes[class].givens {
            let (term, origin) = (Rc::new(given.value.clone()), given.origin);
            let of_class = !maker.own_bodies[class];
            let term = GivenTerm { term, origin, of_class, of_copy: false };
            let value = maker.givens.push(term);
            bindings.push(Binding { path: &given.path.0, given: GivenIn { value, me } });
        }
    }
    bindings
}

/// Splits bindings of a thing among its parts: part by part, and for each in the order given.
pub(super) fn shares<'d>(
    maker: &mut Maker<'d>,
    body: &Body,
    thing: ThingId,
    bindings: &[Binding<'d>],
) -> Vec<ShareOf<'d>> {
    let mut shared = Vec::with_capacity(bindings.len());
    for &b in bindings {
        each_share(maker, body, thing, b, &mut |share| shared.push(share));
    }
    shared.sort_by_key(|s| s.part);
    shared
}

/// Puts a given value over what the parts of a thing have.
pub(super) fn put<'d>(maker: &mut Maker<'d>, body: &mut Body, thing: ThingId, b: Binding<'d>) {
    if maker.copied > MOST_COPIES {
        has_room(maker, body, 0, maker.givens[b.given.value].origin);
        return;
    }
    match maker.document.classes[body.things[thing].class].kind {
        ClassKind::Primitive(_) | ClassKind::Reference(_) | ClassKind::Set(_) => {
            if b.path.is_empty() {
                Rc::make_mut(&mut body.givens)[thing] = Some(b.given);
            } else {
                let path = Path(b.path.to_vec());
                let message = format!("{path} belongs to another thing, which is only named here");
                let origin = maker.givens[b.given.value].origin;
                maker.fault(origin, FaultKind::UnknownPart, message);
            }
        }
        ClassKind::List(_) | ClassKind::Composite => {
            let mut shared = Vec::new();
            each_share(maker, body, thing, b, &mut |share| shared.push(share));
            for s in shared {
                put(maker, body, body.part(thing, s.part as usize), s.binding);
            }
        }
    }
}

/// Hands a binding on to the parts that it is for.
fn each_share<'d>(
    maker: &mut Maker<'d>,
    body: &Body,
    thing: ThingId,
    b: Binding<'d>,
    hand: &mut dyn FnMut(ShareOf<'d>),
) {
    let t = &body.things[thing];
    let class = t.class;
    let is_list = matches!(maker.document.classes[class].kind, ClassKind::List(_));
    let Some((step, rest)) = b.path.split_first() else {
        let layout = (!is_list).then(|| maker.layout(class));
        for part in 0..t.parts {
            let name =
                layout.as_ref().map(|l| maker.document.field_name(l.fields[part as usize]).clone());
            let class = body.things[body.part(thing, part as usize)].class;
            let field = layout.as_ref().map(|l| l.fields[part as usize]);
            if is_copied_reference(maker, class, b.given.value)
                || field.is_some_and(|field| is_of_body(maker, field, b.given.value))
            {
                continue;
            }
            let value = share_of_whole(maker, b.given.value, part, name.as_ref());
            if let Some(value) = value {
                let given = GivenIn { value, ..b.given };
                hand(ShareOf { part, binding: Binding { path: b.path, given } });
            }
        }
        return;
    };
    let towards = match step {
        Step::Index(i) if is_list => (*i < t.parts).then_some(Towards::Part(*i)),
        Step::Last if is_list => t.parts.checked_sub(1).map(Towards::Part),
        Step::Part(name) if !is_list => towards(maker, class, name),
        Step::Part(_) | Step::Index(_) | Step::Last | Step::Owner => None,
    };
    let further = Binding { path: rest, ..b };
    match towards {
        Some(Towards::Part(part)) => hand(ShareOf { part, binding: further }),
        Some(Towards::Within(part)) => hand(ShareOf { part, binding: b }),
        Some(Towards::Itself) => each_share(maker, body, thing, further, hand),
        None => {
            let (kind, message) = if is_list {
                let elements = match t.parts {
                    0 => "no elements".to_string(),
                    1 => "1 element, [0] alone".to_string(),
                    n => format!("{n} elements, [0] to [{}]", n - 1),
                };
                let step = Path(vec![step.clone()]);
                let message = format!("the list has {elements}: there is no {step}");
                (FaultKind::NoElement, message)
            } else {
                let path = Path(b.path.to_vec());
                let class = &maker.document.classes[class].name;
                (FaultKind::UnknownPart, format!("{class} has no part {path}"))
            };
            let origin = maker.givens[b.given.value].origin;
            maker.fault(origin, kind, message);
        }
    }
}

/// Returns true for a reference in a copy: it is read again where the copy is.
fn is_copied_reference(maker: &Maker<'_>, class: ClassId, whole: GivenId) -> bool {
    matches!(maker.document.classes[class].kind, ClassKind::Reference(_))
        && !matches!(*maker.givens[whole].term, Term::List(_) | Term::Tuple(_) | Term::Make { .. })
}

/// Returns true for what only the thing's own body declares, where the value is that of another thing, which
/// has no such part.
fn is_of_body(maker: &Maker<'_>, field: PartRef, whole: GivenId) -> bool {
    let declares = &maker.document.classes[field.class];
    declares.is_of_one
        && declares.general.is_none()
        && !matches!(*maker.givens[whole].term, Term::List(_) | Term::Tuple(_) | Term::Make { .. })
}

/// Where a bare name leads from a thing.
enum Towards {
    /// To the part of this index.
    Part(u32),
    /// Through the superclass part of this index, which has the name.
    Within(u32),
    /// To the thing itself, by the name of its primary superclass.
    Itself,
}

/// Finds the part that a bare name leads to or through.
fn towards(maker: &mut Maker<'_>, class: ClassId, name: &Name) -> Option<Towards> {
    let layout = maker.layout(class);
    if let Some(&i) = layout.index.get(name) {
        return Some(Towards::Part(i));
    }
    if layout.own_names.contains(name) {
        return Some(Towards::Itself);
    }
    let document = maker.document;
    let has = |&&i: &&u32| has_part(document, layout.classes[i as usize], name);
    layout.superclasses.iter().find(has).map(|&i| Towards::Within(i))
}

/// Returns true if a bare name leads to a part or a superclass of a class's things.
fn has_part(document: &Document, class: ClassId, name: &Name) -> bool {
    document.lineage(class).into_iter().any(|c| {
        let c = &document.classes[c];
        let names_superclass = c.supers.iter().any(|s| s.name == *name);
        names_superclass || c.parts.iter().any(|p| p.name == *name)
    })
}

/// Returns the element of a list that a term makes: of what is made of each, what is made of that one, for the list
/// would be made anew for every element.
fn element(list: &Term, i: u32) -> Term {
    match list {
        Term::List(items) if (i as usize) < items.len() => items[i as usize].clone(),
        Term::Send { to, name, arguments, search: None } if name == "map" && is_written(to) => {
            match &arguments[..] {
                [Argument { value: Term::Lambda(names, body), .. }] if names.len() == 1 => {
                    Term::Let(names[0].clone(), Box::new(element(to, i)), body.clone())
                }
                _ => element_by_index(list, i),
            }
        }
        _ => element_by_index(list, i),
    }
}

fn element_by_index(list: &Term, i: u32) -> Term {
    Term::Index(Box::new(list.clone()), Box::new(Term::number(f64::from(i))))
}

/// Returns true for a term that makes a list, whatever the things are that it stands among.
fn is_written(list: &Term) -> bool {
    match list {
        Term::List(_) | Term::Range(..) => true,
        Term::Send { to, name, .. } => name == "map" && is_written(to),
        _ => false,
    }
}

/// How many things take as much room as one level of a term.
const LEVEL: usize = 2;

/// Returns how many names follow one another in a path.
fn depth(mut term: &Term) -> usize {
    let mut levels = 0;
    while let Term::Send { to, .. } = term {
        term = to;
        levels += 1;
    }
    levels
}

/// Returns what a part gets of a value for the whole: by position, by name, or by asking for it.
///
/// Fields of a thing have a name, elements of a list have none.
fn share_of_whole(
    maker: &mut Maker<'_>,
    whole: GivenId,
    part: u32,
    name: Option<&Name>,
) -> Option<GivenId> {
    let GivenTerm { term, origin, of_class, .. } = &maker.givens[whole];
    let i = part as usize;
    let mut of_copy = false;
    let mut copied = |term: Term| {
        of_copy = true;
        term
    };
    let term = match (&**term, name) {
        (Term::List(items), None) | (Term::Tuple(items), Some(_)) => items.get(i)?.clone(),
        (Term::Make { arguments, .. }, Some(name)) => {
            let labelled = arguments.iter().find(|a| a.label.as_ref() == Some(name));
            let positional = || arguments.get(i).filter(|a| a.label.is_none());
            labelled.or_else(positional)?.value.clone()
        }
        (other, Some(name)) => copied(Term::send(other.clone(), name)),
        (other, None) => copied(element(other, part)),
    };
    let (origin, of_class) = (*origin, *of_class);
    if of_copy {
        // each level of what is copied has a term of its own
        let levels = depth(&term).saturating_sub(usize::from(name.is_none()));
        maker.copied = maker.copied.saturating_add(LEVEL * levels);
    }
    let term = Rc::new(term);
    let value = maker.givens.push(GivenTerm { term, origin, of_class, of_copy });
    maker.shared.push(Shared { value, whole, part });
    Some(value)
}
