//! Lowering: a text in, a document out, with everything that is wrong.
//!
//! Classes may be used before they are declared, so it goes in rounds: files are read and their
//! classes named; superclasses are found; parts and messages are declared; at last everything that
//! speaks of parts is lowered.

use crate::alone::{Names, Reader};
use crate::checks::Check;
use crate::counts::Counts;
use crate::families::Family;
use crate::files::{File, Use, UsedParts, name_of};
use crate::hints::instead_of_abstract;
use crate::kept::Added;
use crate::kept::used::Used;
use crate::kin::Kin;
use crate::kinds::Kind;
use crate::lessons::Lesson;
use crate::loops::Repeated;
use crate::members::{Definition, Pending};
use crate::mentions::Mention;
use crate::origins::Origins;
use crate::outwards::Told;
use crate::placed::PlacedClasses;
use crate::programs::Programs;
use crate::references::References;
use crate::refine::Made;
use crate::restore::{Grain, Patch};
use crate::rewritten::rewritten;
use crate::rules::Mask;
use crate::scale::Counting;
use crate::scope::Scope;
use crate::switches::PendingSwitch;
use crate::views::{PlotOf, Toolbox};
use crate::visible::Visible;
use base::{Diagnostic, FileId, IdVec, Mixer, Name, Place, Severity, Span};
use indexmap::IndexMap;
use kernel::{
    ClassId, Classes, Document, Fault, FaultKind, OriginId, PartRef, Path, Scale, Search, Term,
    Vertical,
};
use std::collections::{BTreeMap, BTreeSet};
use std::hash::BuildHasherDefault;
use std::rc::Rc;
use syntax::ast::{self, AstNode};
use syntax::{Changed, Parse, SyntaxKind};

/// What a text means.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// The part of the document that keeps the masters of placed things, if it has any: nobody wrote it.
    pub masters: Option<Name>,
    /// The classes, and the document's own.
    pub document: Document,
    /// The `check` blocks of the document's own text.
    pub checks: Vec<Check>,
    /// The `lesson` blocks of the document's own text.
    pub lessons: Vec<Lesson>,
    /// The views that classes define.
    pub views: Vec<PlotOf>,
    /// The toolboxes of the document's own text and of those that it uses.
    pub toolboxes: Vec<Toolbox>,
    /// The families of the document's own text and of those that it uses.
    pub families: Vec<Family>,
    /// Where every member was written.
    pub origins: Origins,
    /// What is wrong, in no particular order.
    pub diagnostics: Vec<Diagnostic>,
    /// What the `///` that the text begins with says, where that is above a `use` or a line of units.
    pub doc: String,
    /// The texts; the document's own is the first.
    pub files: IdVec<FileId, File>,
    /// The names of the texts and the tables that were asked for in vain.
    pub missing: BTreeSet<String>,
    /// The text with what members with an error said before; equal to the text without errors.
    pub(crate) effective: Rc<str>,
    /// The tree of the effective text.
    pub(crate) effective_parse: Parse,
    /// What each member at the top of the effective text added, where that may be kept.
    pub(crate) added: Vec<Option<Added>>,
    /// How many values the document gives before those of each of these members, and before what follows them.
    pub(crate) given_from: Vec<u32>,
    /// What the next text may take over of the texts that are used.
    pub(crate) used: Option<Rc<Used>>,
    /// Where the effective text differs from the text.
    pub(crate) patches: Vec<Patch>,
    /// Every part that a class declares, by its name: its index among the class's parts.
    pub(crate) parts: ByName<usize>,
    /// Where the document's own text declares classes, one after the other.
    pub(crate) class_spans: Vec<Span>,
    /// What its names mean, for expressions that are read alone.
    pub(crate) names: Rc<Names>,
    /// What reads them.
    pub(crate) reader: Reader,
}

/// What members of classes are told apart by: class and name, in order of declaration.
pub(crate) type ByName<T> = IndexMap<(ClassId, Name), T, BuildHasherDefault<Mixer>>;

/// The document's own text.
pub(crate) const OWN: FileId = FileId(0);

/// Finds out what a text means. Never fails: what cannot be lowered is left out and reported.
///
/// `load` returns the text of what `use` names. `before` is what an earlier text meant: where a
/// member has an error, what it said there stays in force.
pub fn lower(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    before: Option<&Lowered>,
) -> Lowered {
    lower_in(text, load, (before, None))
}

/// The same for a text that an edit of values wrote: its scale is that of the text before.
pub fn lower_written(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    before: &Lowered,
) -> Lowered {
    rewritten(text, load, before).unwrap_or_else(|| {
        lower_in(text, load, (Some(before), Some(counting_of(&before.document))))
    })
}

/// Finds out what a text means that asks something of the document `before`, which it repeats. It counts as that does;
/// nothing with an error is read as it was before.
pub fn lower_asking(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    before: &Lowered,
) -> Lowered {
    lower_text(text, load, (Some(before), Some(counting_of(&before.document))))
}

fn lower_in(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    (before, counting): (Option<&Lowered>, Option<Counting>),
) -> Lowered {
    let first = lower_text(text, load, (before, counting));
    let counting = Some(counting_of(&first.document));
    let Some(before) = before.filter(|_| errors(&first) > 0) else { return first };
    // Members with an error are read as they were when they last had none.
    let mut best: Option<Lowered> = None;
    for grain in [Grain::Inner, Grain::Outer] {
        let (patched, patches) = crate::restore::restore(&first, &before.effective_parse, grain);
        let mut mended = lower_text(&patched, load, (Some(before), counting.clone()));
        mended.patches = patches;
        if errors(&mended) < best.as_ref().map_or(errors(&first), errors) {
            best = Some(mended);
        }
        if best.as_ref().is_some_and(|b| errors(b) == 0) {
            break;
        }
    }
    let Some(mut best) = best else { return first };
    best.files[OWN] = first.files[OWN].clone();
    best.diagnostics = first.diagnostics;
    best.missing = first.missing;
    best
}

fn counting_of(document: &Document) -> Counting {
    Counting {
        scale: document.scale,
        writes_lengths: document.writes_lengths,
        usual: document.usual.clone(),
        customary: document.customary.clone(),
        quotients: document.quotients.clone(),
    }
}

fn errors(lowered: &Lowered) -> usize {
    lowered.diagnostics.iter().filter(|d| d.severity == Severity::Error).count()
}

/// Finds what every word of a text names, of those that name something.
///
/// What has an error names what it can. Cost: that of lowering the text once.
pub fn mentions(text: &str, load: &dyn Fn(&str) -> Option<String>) -> Vec<Mention> {
    let mut l = Lowerer::new(None);
    l.references = Some(References::default());
    l.run(text, load);
    l.mentions()
}

/// Finds what of a text speaks of a member of a class.
pub(crate) fn references(text: &str, load: &dyn Fn(&str) -> Option<String>) -> References {
    let mut l = Lowerer::new(None);
    l.references = Some(References::default());
    l.run(text, load);
    l.references.unwrap_or_default()
}

pub(crate) fn lower_text(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    (before, counting): (Option<&Lowered>, Option<Counting>),
) -> Lowered {
    let mut l = Lowerer::new(before);
    l.counting = counting;
    let blocks = l.run(text, load);
    l.lowered(blocks)
}

/// What a text says beside classes and members.
pub(crate) struct Blocks {
    pub(crate) checks: Vec<Check>,
    pub(crate) lessons: Vec<Lesson>,
    pub(crate) views: Vec<PlotOf>,
    pub(crate) toolboxes: Vec<Toolbox>,
    pub(crate) families: Vec<Family>,
}

pub(crate) struct Lowerer<'l> {
    /// What an earlier text meant.
    pub(crate) before: Option<&'l Lowered>,
    /// Which members at the top of the text are others than in the earlier one.
    pub(crate) changed: Vec<Changed>,
    /// What each member at the top of the text added, where that may be kept.
    pub(crate) added: Vec<Option<Added>>,
    /// How many values the document gives before those of each of these members, and before what follows them.
    pub(crate) given_from: Vec<u32>,
    /// What the earlier text meant, where used texts say what they said in it.
    pub(crate) used: Option<(&'l Lowered, Rc<Used>)>,
    /// What the next text may take over of used texts.
    pub(crate) next_used: Option<Rc<Used>>,
    pub(crate) files: IdVec<FileId, File>,
    /// The names of the texts and the tables that were asked for in vain.
    pub(crate) missing: BTreeSet<String>,
    /// The files that are being read, each by the one before it.
    pub(crate) reading: Vec<FileId>,
    /// The files whose things are being declared, each in the one before it.
    pub(crate) using: Vec<FileId>,
    /// Where the document has the things of what it uses.
    pub(crate) file_things: BTreeMap<FileId, Path>,
    /// The parts that these are of the class of what uses them, and who uses whom.
    pub(crate) used_parts: UsedParts,
    /// Which of these uses a text speaks of: the text first.
    pub(crate) spoken: BTreeSet<(FileId, Use)>,
    /// Files after those that they use; the document last.
    pub(crate) order: Vec<FileId>,
    pub(crate) document: Document,
    pub(crate) visible: Visible,
    pub(crate) origins: Origins,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// What has been reported, so that it is said once.
    pub(crate) said: BTreeSet<(Place, &'static str)>,
    pub(crate) object: ClassId,
    /// Members whose expressions are still to be lowered.
    pub(crate) pending: Vec<Pending>,
    /// What bodies say of the names of their things, by the text and the first byte.
    pub(crate) told: BTreeMap<(FileId, u32), Rc<Told>>,
    /// Definitions of messages, by class and name, with the scope they stand in.
    pub(crate) definitions: ByName<Rc<Definition>>,
    /// What a message answers whose definition waits: one for all.
    pub(crate) unsaid: Rc<Term>,
    /// What messages are worth, once known; nothing while it is being found out.
    pub(crate) message_kinds: BTreeMap<(ClassId, Name), Option<Kind>>,
    /// Every part that a class declares, by its name: its index among the class's parts.
    pub(crate) parts: ByName<usize>,
    /// How many elements the value of a list has that is declared without a count.
    pub(crate) given_counts: BTreeMap<(ClassId, Name), u32>,
    /// The same of lists that the body of a part gives, by the class that has the part, the part and the list.
    pub(crate) given_in_bodies: BTreeMap<(ClassId, Name, Name), u32>,
    /// Lists that loops declare, in classes that take more turns than where they are declared.
    pub(crate) longer: Vec<(ClassId, PartRef, ClassId)>,
    /// Every message that a class defines, by its name: the index of the last among its messages.
    pub(crate) messages: ByName<usize>,
    /// The names by which things are reached as their primary superclasses.
    pub(crate) primary_names: BTreeSet<Name>,
    /// Parts that are constants: those at the top of a text are seen in its classes.
    pub(crate) constants: BTreeSet<(ClassId, Name)>,
    /// Parts and messages whose declaration is wrong: what speaks of them says no more.
    pub(crate) broken: BTreeSet<(ClassId, Name)>,
    /// Where parts and messages are named.
    pub(crate) named_at: ByName<Place>,
    /// Where constraints and merges are named.
    pub(crate) rule_names: BTreeMap<(ClassId, Name), Place>,
    /// What `without` names.
    pub(crate) masks: Vec<Mask>,
    /// What switches name.
    pub(crate) switches: Vec<PendingSwitch>,
    /// What `replace` says.
    pub(crate) replacements: Vec<(Scope, ast::Replace, OriginId)>,
    /// For every class with `modify`, the classes of the bodies, each below the one it modifies.
    pub(crate) modifications: BTreeMap<ClassId, Vec<ClassId>>,
    /// The class that each of these bodies is for.
    pub(crate) modified: BTreeMap<ClassId, ClassId>,
    /// The narrower classes of parts made so far.
    pub(crate) narrowed: Made,
    /// Bodies of `modify`, and classes that get what they say.
    pub(crate) copies: Vec<(ClassId, ClassId)>,
    /// What things of classes are merged with.
    pub(crate) kin: Kin,
    /// How many classes there were when the document's own members began.
    pub(crate) declared_classes: usize,
    /// What loops declare over what is not known yet.
    pub(crate) repeated: Vec<Repeated>,
    /// How many members `for` has made.
    pub(crate) unrolled: usize,
    /// Classes of lists and sets, by `List of` or `Set of` and what they hold.
    pub(crate) made: BTreeMap<(&'static str, ClassId), ClassId>,
    /// Classes of lists of so many elements.
    pub(crate) counted: BTreeMap<(ClassId, u32), ClassId>,
    pub(crate) placed: PlacedClasses,
    /// Every constraint with a name, by the class that declares it.
    pub(crate) constraints: BTreeSet<(ClassId, Name)>,
    /// How many expressions are being lowered inside one another.
    pub(crate) depth: u32,
    /// Whether what things of the document's top are merged with is known.
    pub(crate) has_merged: bool,
    /// How often something was left open that another reading may settle: a report that was not told, a message whose
    /// worth was being found out.
    pub(crate) open_readings: usize,
    /// While positive, nothing is reported.
    pub(crate) silent: u32,
    /// Products and quotients of the text's loops that may be meant otherwise: they are looked at once.
    pub(crate) read_in_turns: BTreeSet<Span>,
    /// In how many branches it is that a turn of a loop does not take: of these few mistakes are told.
    pub(crate) untaken: u32,
    pub(crate) declared: Vec<(ClassId, FileId, ast::Class)>,
    /// The choices of all files, in order of declaration.
    pub(crate) choices: Vec<ClassId>,
    pub(crate) programs: Programs,
    pub(crate) counts: Counts,
    /// Classes made for other counts, whose members are still to be declared.
    pub(crate) declared_for_counts: Vec<(ClassId, FileId, ast::Class)>,
    /// What words speak of, where that is asked for.
    pub(crate) references: Option<References>,
    /// How it counts, where the text does not decide on it.
    pub(crate) counting: Option<Counting>,
}

impl<'l> Lowerer<'l> {
    pub(crate) fn new(before: Option<&'l Lowered>) -> Self {
        let mut l = Self::empty(before);
        l.own_classes();
        l
    }

    /// Makes one that knows no class yet, not even the language's own.
    pub(crate) fn empty(before: Option<&'l Lowered>) -> Self {
        Self {
            before,
            changed: Vec::new(),
            added: Vec::new(),
            given_from: Vec::new(),
            used: None,
            next_used: None,
            files: IdVec::new(),
            missing: BTreeSet::new(),
            reading: Vec::new(),
            using: Vec::new(),
            file_things: BTreeMap::new(),
            used_parts: UsedParts::new(),
            spoken: BTreeSet::new(),
            order: Vec::new(),
            document: Document {
                classes: Classes::new(),
                root: ClassId(0),
                vertical: Vertical::Up,
                units_per_metre: 1.0,
                scale: Scale::default(),
                unit: None,
                writes_lengths: false,
                usual: BTreeMap::new(),
                customary: None,
                quotients: BTreeMap::new(),
                units: BTreeMap::new(),
            },
            visible: Visible::default(),
            origins: Origins::default(),
            diagnostics: Vec::new(),
            said: BTreeSet::new(),
            made: BTreeMap::new(),
            counted: BTreeMap::new(),
            placed: PlacedClasses::default(),
            constraints: BTreeSet::new(),
            depth: 0,
            object: ClassId(0),
            pending: Vec::new(),
            told: BTreeMap::new(),
            definitions: ByName::default(),
            unsaid: Rc::new(Term::Me),
            message_kinds: BTreeMap::new(),
            parts: ByName::default(),
            messages: ByName::default(),
            primary_names: BTreeSet::new(),
            constants: BTreeSet::new(),
            broken: BTreeSet::new(),
            named_at: ByName::default(),
            given_counts: BTreeMap::new(),
            given_in_bodies: BTreeMap::new(),
            longer: Vec::new(),
            rule_names: BTreeMap::new(),
            masks: Vec::new(),
            switches: Vec::new(),
            replacements: Vec::new(),
            modifications: BTreeMap::new(),
            modified: BTreeMap::new(),
            narrowed: Made::new(),
            copies: Vec::new(),
            kin: Kin::default(),
            declared_classes: 0,
            repeated: Vec::new(),
            unrolled: 0,
            has_merged: false,
            open_readings: 0,
            silent: 0,
            read_in_turns: BTreeSet::new(),
            untaken: 0,
            declared: Vec::new(),
            choices: Vec::new(),
            programs: Programs::default(),
            counts: Counts::default(),
            declared_for_counts: Vec::new(),
            references: None,
            counting: None,
        }
    }

    /// Returns what the text means, with what it says beside classes and members.
    pub(crate) fn lowered(self, blocks: Blocks) -> Lowered {
        let Blocks { checks, lessons, views, toolboxes, families } = blocks;
        let doc = self.first_doc();
        let own = &self.files[OWN];
        let classes = own.members_of(&[SyntaxKind::Class, SyntaxKind::Program]);
        let (effective, effective_parse) = (own.text.clone(), own.parse.clone());
        Lowered {
            masters: self.placed.masters.map(|(name, _)| name),
            document: self.document,
            checks,
            lessons,
            views,
            toolboxes,
            families,
            origins: self.origins,
            diagnostics: self.diagnostics,
            doc,
            effective,
            effective_parse,
            class_spans: classes.iter().map(|class| syntax::span_of(class.syntax())).collect(),
            patches: Vec::new(),
            files: self.files,
            missing: self.missing,
            parts: self.parts,
            added: self.added,
            given_from: self.given_from,
            used: self.next_used,
            reader: Reader::default(),
            names: Rc::new(Names {
                visible: self.visible,
                object: self.object,
                messages: self.messages,
                message_kinds: self.message_kinds,
                primary_names: self.primary_names,
                constants: self.constants,
                broken: self.broken,
                file_things: self.file_things,
                used_parts: self.used_parts,
                spoken: self.spoken,
                choices: self.choices,
                made: self.made,
                counted: self.counted,
                drawing: self.programs.classes(),
            }),
        }
    }

    /// Returns what the comment for readers above the first `use` or line of units says; one above anything
    /// else is that thing's own.
    fn first_doc(&self) -> String {
        let File { parse, .. } = &self.files[OWN];
        let of_all =
            |kind| matches!(kind, SyntaxKind::Use | SyntaxKind::UnitLine | SyntaxKind::YLine);
        let first = parse.outline().next().filter(|&(kind, _)| of_all(kind));
        first.and_then(|(_, span)| parse.file().member_at(span)?.doc()).unwrap_or_default()
    }

    pub(crate) fn origin(&mut self, file: FileId, span: Span) -> OriginId {
        self.origins.add(Place { file, span })
    }

    /// Notes where what a class says of its parts is written.
    pub(crate) fn rule_origin(&mut self, scope: &Scope, span: Span) -> OriginId {
        let place = Place { file: scope.file, span };
        match scope.class() == self.document.root {
            true => self.origins.add_rule(place),
            false => self.origins.add(place),
        }
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        // what a name means is the same in every turn of a loop
        let is_told = self.silent == 0 && (self.untaken == 0 || diagnostic.code == "unknown-name");
        // what every turn of a loop would say again is one mistake
        if is_told && self.said.insert((diagnostic.place, diagnostic.code)) {
            self.diagnostics.push(diagnostic);
        }
        self.open_readings += usize::from(!is_told);
    }
    #[cold]
    #[inline(never)]
    pub(crate) fn error(&mut self, code: &'static str, file: FileId, span: Span, message: String) {
        self.report(Diagnostic::error(code, Place { file, span }, message));
    }
    /// Reports what the language has and this version does not.
    pub(crate) fn not_yet(&mut self, file: FileId, span: Span, what: &str) {
        let d =
            Diagnostic::error("not-yet", Place { file, span }, format!("{what} not supported yet"));
        self.report(d.hint("the rest of the document works without it"));
    }

    pub(crate) fn make_root(&mut self) {
        let end = self.files[OWN].text.len() as u32;
        let origin = self.origin(OWN, Span::new(0, end));
        let object = self.object;
        self.document.root = self.document.classes.next_id();
        self.add_unnamed_class("", object, origin);
    }

    /// Declares parts and messages of all classes.
    pub(crate) fn declare_members_of_classes(&mut self) {
        for (id, file, class) in self.declared.clone() {
            let members = class.body().into_iter().flat_map(|b| b.members()).collect();
            self.declare_body(&Scope::of(file, id), members);
        }
        self.declare_programs();
        self.declare_object();
    }

    /// Returns a class's own definition of a message.
    pub(crate) fn defined_message(&self, class: ClassId, name: &Name) -> Option<&kernel::Message> {
        let index = *self.messages.get(&(class, name.clone()))?;
        self.document.classes[class].messages.get(index)
    }
    /// Finds a message by the thesis's order, as [`Document::find_message`] does.
    pub(crate) fn find_message(
        &self,
        class: ClassId,
        name: &Name,
        search: Option<Search>,
    ) -> Option<(ClassId, &kernel::Message)> {
        self.document.find_message_by(class, search, &|c| self.defined_message(c, name))
    }
}

impl Lowered {
    /// Returns how many members at the top of the text are taken over as they are when others are edited.
    pub fn keepable(&self) -> usize {
        self.added.iter().flatten().count()
    }
    /// Returns how many millimetres a unit has in which lengths are stored; a bare number is one where the text neither
    /// names a unit nor writes lengths with theirs.
    pub fn millimetres_per_unit(&self) -> f64 {
        let is_said = self.effective_parse.outline().any(|(kind, _)| kind == SyntaxKind::UnitLine);
        let document = &self.document;
        let stored = document.scale.factor(expr::Dimension::LENGTH);
        match is_said || document.writes_lengths {
            true => 1000.0 / document.units_per_metre / stored,
            false => 1.0 / stored,
        }
    }
    /// Turns faults of the structure into diagnostics at the members that they come from.
    pub fn fault_diagnostics(&self, faults: &[Fault]) -> Vec<Diagnostic> {
        let mut instead: BTreeMap<ClassId, String> = BTreeMap::new();
        let diagnostic = |f: &Fault| {
            let d = Diagnostic::error(f.kind.code(), self.place(f.origin), f.message.clone());
            let Some(class) = f.class else {
                return match f.kind {
                    FaultKind::EndlessParts => d.hint(
                        "a part that only names another thing is a path: `next: Path to Person`",
                    ),
                    FaultKind::NoElement => d.hint(
                        "how many it has is said where it is declared, `List of 3 Real`, or by a list of all: `= [1, 2, 3]`",
                    ),
                    _ => d,
                };
            };
            let hint = instead.entry(class);
            d.hint(&**hint.or_insert_with(|| instead_of_abstract(&self.document, class)))
        };
        // a ring of classes is told once, however many parts lead around it
        let mut endless: BTreeSet<String> = BTreeSet::new();
        // so is a list that is too short, whatever is asked of it there
        let mut short: BTreeSet<Place> = BTreeSet::new();
        // what goes around goes too deep
        let mut is_deep = faults.iter().any(|f| f.kind == FaultKind::EndlessParts);
        let is_new = |f: &&Fault| match f.kind {
            FaultKind::EndlessParts => endless.insert(f.message.clone()),
            FaultKind::NoElement => short.insert(self.place(f.origin)),
            FaultKind::TooDeep => !std::mem::replace(&mut is_deep, true),
            _ => true,
        };
        faults.iter().filter(is_new).map(diagnostic).collect()
    }
    /// Returns where a member stands; one that is read as it was before, where it stood.
    pub fn place(&self, origin: OriginId) -> Place {
        let place = self.origins.place(origin);
        let span = (place.file == OWN).then(|| self.in_text(place.span)).flatten();
        Place { span: span.unwrap_or(place.span), ..place }
    }
    /// Returns the bytes of the text for bytes of the effective text, unless they were patched.
    pub(crate) fn in_text(&self, span: Span) -> Option<Span> {
        let mut shift: i64 = 0;
        for patch in &self.patches {
            if patch.effective.end <= span.start {
                shift = i64::from(patch.text.end) - i64::from(patch.effective.end);
            } else if patch.effective.start < span.end {
                return None;
            }
        }
        let moved = |at: u32| u32::try_from(i64::from(at) + shift).ok();
        Some(Span::new(moved(span.start)?, moved(span.end)?))
    }
    /// Returns the bytes of a member that stands in the document's own text.
    pub fn own_span(&self, origin: OriginId) -> Option<Span> {
        let place = self.origins.place(origin);
        let own = place.file == OWN && place.span != Span::default();
        own.then(|| self.in_text(place.span)).flatten()
    }
    /// Returns what was written for a member, without its comments.
    pub fn source_of(&self, origin: OriginId) -> String {
        self.source(origin).to_string()
    }
    /// Returns what was written for a value; of a long list its last elements, where the unit of all stands as well: what
    /// each of many is shown in must not cost as much as all of them.
    pub fn written(&self, origin: OriginId) -> &str {
        const LONG_LIST: usize = 400;
        const END_OF_LIST: usize = 100;
        let written = self.source(origin);
        if written.len() <= LONG_LIST || !written.starts_with('[') {
            return written;
        }
        let ends = written.len() - END_OF_LIST..=written.len();
        let end = { ends }.find_map(|at| written.get(at..)).unwrap_or_default();
        end.split_once(',').map_or(end, |(_, rest)| rest).trim()
    }
    fn source(&self, origin: OriginId) -> &str {
        let place = self.origins.place(origin);
        let text = if place.file == OWN { &self.effective } else { &self.files[place.file].text };
        text.get(place.span.range()).unwrap_or_default().trim()
    }
    /// Returns true if a given value was written for a thing of the document, not for a class.
    pub fn is_own_given(&self, origin: OriginId) -> bool {
        let place = self.origins.place(origin);
        let before = self.class_spans.partition_point(|s| s.start <= place.span.start);
        let class = before.checked_sub(1).map(|last| self.class_spans[last]);
        place.file == OWN && class.is_none_or(|class| class.end < place.span.end)
    }
    /// Returns true for a part that its class declares as a `constant`.
    pub fn is_constant(&self, class: ClassId, part: &Name) -> bool {
        let line = self.document.primary_line(class);
        line.into_iter().any(|class| self.names.constants.contains(&(class, part.clone())))
    }
    /// Returns the names of what the document's own text uses.
    pub fn used(&self) -> Vec<String> {
        let members = self.files[OWN].members_of(&[SyntaxKind::Use]);
        let name = |member: ast::Member| match member {
            ast::Member::Use(used) => used.path().map(|path| name_of(&path)),
            _ => None,
        };
        members.into_iter().filter_map(name).collect()
    }
    /// Returns true if the document uses a text of this name, itself or by what it uses.
    pub fn uses(&self, name: &str) -> bool {
        self.files.iter().skip(1).any(|(_, file)| !file.is_table() && file.name == name)
    }
    /// Returns true if the document's own text declares a class of this name.
    pub fn declares_class(&self, name: &str) -> bool {
        self.own_class(name).is_some()
    }
    /// Finds the class of this name that the document's own text declares.
    pub(crate) fn own_class(&self, name: &str) -> Option<ClassId> {
        let class = self.document.class_named(name)?;
        self.is_declared_here(&self.document.classes[class]).then_some(class)
    }
    /// Returns the classes that the document's own text declares.
    pub fn own_classes(&self) -> impl Iterator<Item = ClassId> {
        let is_own = |(id, class): (ClassId, &kernel::Class)| {
            (self.is_declared_here(class) && !self.is_class_of_one(id)).then_some(id)
        };
        self.document.classes.iter().filter_map(is_own)
    }
    /// Returns true if the document's own text declares a class.
    fn is_declared_here(&self, class: &kernel::Class) -> bool {
        let place = self.origins.place(class.origin);
        place.file == OWN && self.class_spans.binary_search(&place.span).is_ok()
    }
    /// Returns true if a class is that of a single part.
    pub fn is_class_of_one(&self, class: ClassId) -> bool {
        self.document.classes[class].is_of_one
    }
}
