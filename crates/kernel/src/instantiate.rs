//! Instantiation: a document in, its structure out.
//!
//! What a thing of a class has below it is made once, as a *body*, and copied for every thing of the
//! class: its parts, the merges among them, its constraints and stays. Given values from outside are
//! put over the copy. A path that leads out of a body, or through a merge that is only made outside,
//! is tried again one body further out. At the end slots are given to the primitive things. What
//! cannot be done becomes a [`Fault`], and the rest goes on without it.

use crate::class::ClassId;
use crate::document::Document;
use crate::structure::{Givens, Layout, Layouts, Structure};
use crate::term::OriginId;
use base::IdVec;
use std::collections::BTreeMap;
use std::rc::Rc;

mod bind;
mod body;
mod copies;
mod counting;
mod fill;
mod finish;
mod givens;
mod grown;
mod merge;
mod refer;
mod rules;
mod switches;

use body::Body;
pub(crate) use grown::Grown;
use grown::Shared;
use merge::Kinship;

/// Something in a document that cannot be made as written.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    /// The member at fault.
    pub origin: OriginId,
    /// What kind of fault it is.
    pub kind: FaultKind,
    /// What was found and what was wanted.
    pub message: String,
    /// The class that it is the fault of, where it is that of one.
    pub class: Option<ClassId>,
}

/// The kinds of faults of a structure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum FaultKind {
    /// A thing that would have to be a part of itself.
    EndlessParts,
    /// More things than a document may have.
    TooManyThings,
    /// Parts of parts of parts, deeper than a document may have them.
    TooDeep,
    /// A path that leads nowhere.
    UnknownPart,
    /// An element that a list is too short for.
    NoElement,
    /// A merge of things that have no parts in common.
    VacuousMerge,
    /// A merge of primitive things of different kinds, or of lists of different lengths.
    UnlikeMerge,
    /// A class that cannot have things of its own.
    AbstractPart,
    /// A reference that names nothing, or something of another class.
    Reference,
}

impl FaultKind {
    /// Returns the kebab-case code of its diagnostic.
    pub fn code(self) -> &'static str {
        match self {
            Self::EndlessParts => "endless-parts",
            Self::TooManyThings => "too-many-things",
            Self::TooDeep => "too-deep",
            Self::UnknownPart => "unknown-part",
            Self::NoElement => "index",
            Self::VacuousMerge => "vacuous-merge",
            Self::UnlikeMerge => "unlike-merge",
            Self::AbstractPart => "abstract-part",
            Self::Reference => "unknown-reference",
        }
    }
}

/// How many things a document may have; of one with more, none is made.
///
/// A thing costs some fifty bytes; the bound keeps a mistyped count from filling the memory. A grid of 300 by 300 nodes
/// with its resistors has 4.13 million.
pub const MOST_THINGS: usize = 4_500_000;

/// How many things may be made and copied on the way to a document, the elements of lists counted twice: what doubles
/// from class to class is all in memory when it is found to be too much.
const MOST_COPIES: usize = MOST_THINGS + MOST_THINGS / 8;

/// Makes the structure of a document, and says what could not be made.
///
/// Cost: what the classes say, once for each class; a copy for every thing; the merges between
/// things, each times the parts that become one.
pub fn instantiate(document: &Document) -> (Structure, Vec<Fault>) {
    let classes = document.classes.len();
    let mut maker = Maker::new(document, IdVec::filled(None, classes));
    let mut body = Body::new(document.root);
    let has_grown = fill::grow(&mut maker, &mut body, body::ROOT, &[]).is_some() && !maker.is_full;
    if maker.is_full {
        body = Body::new(document.root);
    }
    let givens = Rc::new(std::mem::take(&mut maker.givens));
    let grown = (has_grown && maker.faults.is_empty()).then(|| {
        let layouts = maker.layouts.clone();
        Rc::new(Grown { body: body.clone(), layouts, shared: std::mem::take(&mut maker.shared) })
    });
    if has_grown {
        rules::apply(&mut maker, &mut body, body::ROOT, 0);
    }
    finished(maker, body, givens, grown)
}

/// Makes the structure of a document whose text was edited. Gives what [`instantiate`] gives.
///
/// What the document's own class says of its parts is read again where the parts are as they were, and
/// nothing is where constants alone are others. Cost: that of comparing the documents, and linear in
/// things where anything but constants has changed.
pub fn instantiate_again(
    document: &Document,
    before: (&Document, &Structure),
) -> (Structure, Vec<Fault>) {
    let Some((grown, givens)) = grown::kept(document, before) else { return instantiate(document) };
    let (was, structure) = before;
    let are_parts_kept = structure.grown.as_ref().is_some_and(|was| Rc::ptr_eq(was, &grown));
    if are_parts_kept
        && structure.is_faultless
        && grown::is_form_kept(document, was, structure, &givens)
    {
        return (Structure { form: structure.form.clone(), givens }, Vec::new());
    }
    let mut maker = Maker::new(document, grown.layouts.clone());
    let mut body = grown.body.clone();
    rules::apply(&mut maker, &mut body, body::ROOT, 0);
    finished(maker, body, givens, Some(grown))
}

/// Makes the structure of the document's body, of which its classes have spoken.
fn finished(
    mut maker: Maker<'_>,
    mut body: Body,
    givens: Rc<Givens>,
    grown: Option<Rc<Grown>>,
) -> (Structure, Vec<Fault>) {
    rules::settle(&mut body);
    rules::give_up(&mut maker, &mut body);
    let mut form = finish::finish(&mut maker, body, &givens);
    switches::switch(maker.document, &mut form);
    maker.faults.dedup();
    form.grown = grown;
    form.is_faultless = maker.faults.is_empty();
    (Structure { form: Rc::new(form), givens }, maker.faults)
}

/// Says what could not be made of the things of some classes, were there any.
///
/// What leads out of such a thing is not looked at: that depends on where it is.
pub fn faults_of(document: &Document, classes: impl IntoIterator<Item = ClassId>) -> Vec<Fault> {
    let mut maker = Maker::new(document, IdVec::filled(None, document.classes.len()));
    for class in classes {
        let origin = document.classes[class].origin;
        fill::body_of(&mut maker, class, origin);
    }
    maker.faults.dedup();
    maker.faults
}

/// What is known of the document's classes while its things are made.
struct Maker<'d> {
    document: &'d Document,
    layouts: Layouts,
    /// The body of every class that was asked for.
    bodies: IdVec<ClassId, Option<Rc<Body>>>,
    /// Every given value, and what parts get of them.
    givens: Givens,
    /// The classes whose givens are the document's own.
    own_bodies: IdVec<ClassId, bool>,
    /// Which given values are what parts get of others.
    shared: Vec<Shared>,
    /// What classes whose things were merged have in common.
    kinships: BTreeMap<(ClassId, ClassId), Option<Kinship>>,
    /// The classes whose things are being filled, each inside the one before it.
    on_the_way: Vec<ClassId>,
    /// How many levels of parts lie above what is being filled.
    depth: usize,
    /// How many things were made so far, those that were only copied from included.
    copied: usize,
    /// True once there were too many.
    is_full: bool,
    faults: Vec<Fault>,
}

impl<'d> Maker<'d> {
    fn new(document: &'d Document, layouts: Layouts) -> Self {
        Self {
            document,
            layouts,
            bodies: IdVec::filled(None, document.classes.len()),
            givens: IdVec::new(),
            own_bodies: document.own_bodies(),
            shared: Vec::new(),
            kinships: BTreeMap::new(),
            on_the_way: Vec::new(),
            depth: 0,
            copied: 0,
            is_full: false,
            faults: Vec::new(),
        }
    }
    fn layout(&mut self, class: ClassId) -> Rc<Layout> {
        let document = self.document;
        let layout = &mut self.layouts[class];
        layout.get_or_insert_with(|| Rc::new(Layout::new(document, class))).clone()
    }
    #[cold]
    #[inline(never)]
    fn fault(&mut self, origin: OriginId, kind: FaultKind, message: String) {
        self.faults.push(Fault { origin, kind, message, class: None });
    }
}
