//! Counts: whole numbers of a class that say how many elements its lists have and how often its loops
//! run.
//!
//! A class with a count is what it is for each number: `Polygon { n = 5 }` has other parts than
//! `Polygon { n = 6 }`. The class with the numbers that it declares is made as any other; for other
//! numbers its text is read again, as a class of one that is *general*ly that class. A count is held:
//! only a new number in the text, or a `set` of it, changes it, and the things with it.

mod deciding;
mod outside;

use crate::hints::{is_a_unit, unit_before_equals};
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use deciding::{Deciding, Known, deciding};
use kernel::{ClassId, ClassKind, OriginId, Path, Stay, Step, Superclass, Term};
use std::collections::{BTreeMap, BTreeSet};
use syntax::ast::{self, AstNode, Expr, Member, TypeShape};
use syntax::{SyntaxKind, SyntaxNode, WalkEvent};

/// How many classes may be made for other counts; beyond, a thing is of the class as it is.
const MOST_MADE: usize = 10_000;

/// How many classes with counts may be asked for inside one another.
const MOST_NESTED: u32 = 64;

/// Numbers for counts, by name.
pub(crate) type Numbers = BTreeMap<Name, i64>;

/// What is known of the counts of classes.
#[derive(Default)]
pub(crate) struct Counts {
    /// The whole numbers that a class itself gives, as constants, to its own or inherited parts.
    given: BTreeMap<ClassId, Numbers>,
    /// The names that the lists and loops of a class itself speak of.
    spoken: BTreeMap<ClassId, BTreeSet<Name>>,
    /// What parts that a class declares may be, where they are no numbers.
    kinds: BTreeMap<(ClassId, Name), Deciding>,
    /// Truth values and options that a class declares and says nothing of: they are false, or the first one.
    unsaid: BTreeSet<(ClassId, Name)>,
    /// The superclasses as they are written.
    supers: BTreeMap<ClassId, Vec<Superclass>>,
    /// The classes made for other numbers.
    made: BTreeMap<(ClassId, Numbers), ClassId>,
    /// The numbers that each of these has otherwise than its text says.
    others: BTreeMap<ClassId, Numbers>,
    /// Where each of these was asked for first.
    asked: BTreeMap<ClassId, Place>,
    /// How many of these each was asked for inside of.
    depth: BTreeMap<ClassId, u32>,
    /// The document's parts to which a count is given from further out, by index.
    pub(crate) from_outside: BTreeSet<u32>,
}

impl Counts {
    fn speak(&mut self, class: ClassId, names: BTreeSet<Name>) {
        if !names.is_empty() {
            self.spoken.insert(class, names);
        }
    }
}

/// The code of a value that is to say how many parts there are and cannot.
const NOT_A_COUNT: &str = "not-a-count";

impl Lowerer<'_> {
    /// Finds out what the classes of all files say of counts; superclasses with a count become those
    /// that their subclasses ask for.
    pub(crate) fn declare_counts(&mut self) {
        for (id, _, class) in self.declared.clone() {
            let members: Vec<Member> = class.body().into_iter().flat_map(|b| b.members()).collect();
            self.note_counts(id, &members, &Numbers::new());
            self.counts.supers.insert(id, self.document.classes[id].supers.clone());
        }
        if self.counts.spoken.is_empty() {
            return;
        }
        for (id, _, _) in self.declared.clone() {
            let own = self.counts.given.get(&id).cloned().unwrap_or_default();
            let supers = self.supers_with(id, &own);
            let place = self.origins.place(self.document.classes[id].origin);
            for s in supers.iter().filter(|s| self.counts.others.contains_key(&s.class)) {
                self.counts.asked.entry(s.class).or_insert(place);
            }
            self.document.classes[id].supers = supers;
        }
    }

    /// Notes what the members of a class say of counts, some of which have other numbers.
    pub(crate) fn note_counts(&mut self, class: ClassId, members: &[Member], others: &Numbers) {
        let mut given = Numbers::new();
        for member in members {
            let (names, value) = match member {
                Member::Part(part) => {
                    let Some(kind) = deciding(&self.document, &self.choices, part) else {
                        continue;
                    };
                    let names: Vec<Name> = part.names().map(|w| w.name()).collect();
                    if kind != Deciding::Whole {
                        let each = names.iter().map(|name| ((class, name.clone()), kind));
                        self.counts.kinds.extend(each);
                        if part.value().is_none() {
                            let each = names.iter().map(|name| (class, name.clone()));
                            self.counts.unsaid.extend(each);
                        }
                    }
                    (names, part.value())
                }
                Member::Assign(assign) => (own_name(assign).into_iter().collect(), assign.value()),
                _ => (Vec::new(), None),
            };
            let value = value.and_then(ast::Value::expr);
            for name in names {
                let value = || {
                    let known = Known {
                        document: &self.document,
                        number: &|e: &Expr| match e {
                            Expr::Name(name) => given.get(&name.name()?.name()).map(|&n| n as f64),
                            _ => None,
                        },
                        kind: &|name| self.deciding_of(class, name),
                    };
                    whole(known.value(value.as_ref()?, self.deciding_of(class, &name))?)
                };
                let value = others.get(&name).copied().or_else(value);
                given.extend(value.map(|v| (name, v)));
            }
        }
        given.extend(others.iter().map(|(name, &n)| (name.clone(), n)));
        let mut spoken: BTreeSet<Name> =
            members.iter().flat_map(|m| names_of_counts(m.syntax())).collect();
        // what a count is computed from counts as well
        for member in members.iter().rev() {
            let Member::Part(part) = member else { continue };
            let value = part.value().and_then(ast::Value::expr);
            let is_deciding = deciding(&self.document, &self.choices, part).is_some();
            if is_deciding && part.names().any(|w| spoken.contains(&w.name())) {
                spoken.extend(value.iter().flat_map(names_in));
            }
        }
        let said: BTreeSet<Name> = members.iter().filter_map(assigned).collect();
        let unsaid = { &spoken }.iter().filter(|name| !said.contains(*name));
        let unsaid: Vec<Name> = unsaid.filter(|n| self.is_unsaid(class, n)).cloned().collect();
        for name in unsaid {
            given.entry(name).or_insert(0);
        }
        self.counts.given.insert(class, given);
        self.counts.speak(class, spoken);
    }

    /// Returns the number of a count of things of a class, and the class of its line that declares it.
    fn count_of_class(&self, class: ClassId, name: &Name) -> Option<i64> {
        let line = self.document.primary_line(class);
        line.iter().find_map(|c| self.counts.given.get(c)?.get(name).copied())
    }

    /// Returns the number that a name stands for where an expression of constants is wanted: a variable
    /// of `for`, or a count of the thing or of one around it. A count is held from now on.
    pub(crate) fn constant_named(&mut self, scope: &Scope, name: &Name) -> Option<i64> {
        if let Some(n) = scope.whole(name) {
            return Some(n);
        }
        for &class in &scope.classes {
            self.note_file(scope.file, class);
            if let Some(n) = self.count_of_class(class, name) {
                // what a count is computed from is held with it
                let all = self.counts_of(class).into_iter().chain([(name.clone(), n)]);
                all.for_each(|(name, n)| self.hold(class, &name, n));
                return Some(n);
            }
        }
        None
    }

    /// Returns the count of a thing that a path names, `t.n`, where lists and loops of its class speak of it.
    pub(crate) fn count_of_thing(&mut self, scope: &Scope, e: &Expr) -> Option<i64> {
        if self.counts.spoken.is_empty() {
            return None;
        }
        let path = self.silent_path(scope, e)?;
        match self.owner_at(scope, &path)? {
            (owner, Step::Part(name)) => self.counts_of(owner).get(name).copied(),
            (_, Step::Index(_) | Step::Last | Step::Owner) => None,
        }
    }

    /// Returns the number that a name stands for in any expression: a variable of `for`, or what counts
    /// parts of the thing or of one around it.
    pub(crate) fn known_number(&self, scope: &Scope, e: &Expr) -> Option<f64> {
        let held = || {
            let Expr::Name(name) = e else { return None };
            let name = name.name()?.name();
            let count = |&class: &ClassId| self.document.count(class, &name);
            scope.classes.iter().find_map(count).map(|n| n as f64)
        };
        scope.constant(e).or_else(held)
    }

    /// Notes what the things of a file say of counts, when that is first asked.
    fn note_file(&mut self, file: FileId, class: ClassId) {
        if class == self.document.root && file == OWN && !self.counts.given.contains_key(&class) {
            let members = self.files[OWN].members_of(&[SyntaxKind::Part, SyntaxKind::Assign]);
            self.note_counts(class, &members, &Numbers::new());
        }
    }

    /// Keeps a count from being changed by anything but a `set` of it.
    fn hold(&mut self, class: ClassId, name: &Name, count: i64) {
        if self.document.count(class, name) == Some(count) {
            return;
        }
        let path = Path(vec![Step::Part(name.clone())]);
        let class = &mut self.document.classes[class];
        class.counts.push((name.clone(), count));
        class.stays.push(Stay { path, strength: None, origin: class.origin });
    }

    /// Returns the counts that a class speaks of, itself or by what it inherits along its primary line,
    /// with their numbers.
    fn counts_of(&self, class: ClassId) -> Numbers {
        let mut numbers = Numbers::new();
        for c in self.document.primary_line(class) {
            for name in self.counts.spoken.get(&c).into_iter().flatten() {
                let number = self.count_of_class(class, name);
                numbers.extend(number.map(|n| (name.clone(), n)));
            }
        }
        numbers
    }

    /// Returns the superclasses of a class whose own counts have these numbers.
    fn supers_with(&mut self, class: ClassId, numbers: &Numbers) -> Vec<Superclass> {
        let supers = self.counts.supers.get(&class).cloned().unwrap_or_default();
        let with = |s: Superclass| Superclass { class: self.class_with(s.class, numbers), ..s };
        supers.into_iter().map(with).collect()
    }

    /// Returns the class that a class is with these numbers for its counts.
    pub(crate) fn class_with(&mut self, class: ClassId, numbers: &Numbers) -> ClassId {
        if let Some(known) = self.known_class_with(class, numbers) {
            return known;
        }
        let Some((general, file, text)) = self.text_of(class).cloned() else { return class };
        let key = (general, self.numbers_with(class, numbers));
        if self.counts.made.len() >= MOST_MADE {
            return class;
        }
        let others = key.1.clone();
        let (name, origin, doc, is_abstract) = {
            let c = &self.document.classes[general];
            (c.name.clone(), c.origin, c.doc.clone(), c.is_abstract)
        };
        let made = self.add_class(name.as_str(), ClassKind::Composite, &[], origin);
        self.counts.made.insert(key, made);
        let c = &mut self.document.classes[made];
        (c.doc, c.is_abstract, c.is_of_one, c.general) = (doc, is_abstract, true, Some(general));
        let members: Vec<Member> = text.body().into_iter().flat_map(|b| b.members()).collect();
        self.note_counts(made, &members, &others);
        let given = self.counts.given.get(&made).cloned().unwrap_or_default();
        self.document.classes[made].supers = self.supers_with(general, &given);
        self.counts.others.insert(made, others);
        self.declared_for_counts.push((made, file, text));
        made
    }

    /// Returns the class that a class is with these numbers for its counts, if there is one already.
    pub(crate) fn known_class_with(&self, class: ClassId, numbers: &Numbers) -> Option<ClassId> {
        let usual = self.counts_of(class);
        if numbers.iter().all(|(name, n)| usual.get(name).is_none_or(|usual| usual == n)) {
            return Some(class);
        }
        let (general, _, _) = self.text_of(class)?;
        self.counts.made.get(&(*general, self.numbers_with(class, numbers))).copied()
    }

    /// Returns what a class has otherwise than its text says, with these numbers for its counts.
    fn numbers_with(&self, class: ClassId, numbers: &Numbers) -> Numbers {
        let usual = self.counts_of(class);
        let other = numbers.iter().filter(|(name, n)| usual.get(*name).is_some_and(|u| u != *n));
        let before = self.counts.others.get(&class).into_iter().flatten();
        before.chain(other).map(|(name, &n)| (name.clone(), n)).collect()
    }

    /// Returns where a class is declared: one made for other counts, as the class that it generally is.
    pub(crate) fn text_of(&self, class: ClassId) -> Option<&(ClassId, FileId, ast::Class)> {
        let general = self.document.classes[class].general.unwrap_or(class);
        let at = self.declared.binary_search_by_key(&general, |(id, _, _)| *id).ok()?;
        Some(&self.declared[at])
    }

    /// Declares the members of the classes that were made for other counts.
    pub(crate) fn declare_for_counts(&mut self) {
        while let Some((id, file, class)) = self.declared_for_counts.pop() {
            let members = class.body().into_iter().flat_map(|b| b.members()).collect();
            self.declare_body(&Scope::of(file, id), members);
        }
    }

    /// Returns true if some of the members of a part's body give a count of its class a number.
    pub(crate) fn gives_count(&self, class: ClassId, members: &[Member]) -> bool {
        if self.counts.spoken.is_empty() {
            return false;
        }
        let counts = self.counts_of(class);
        members.iter().filter_map(assigned).any(|name| counts.contains_key(&name))
    }

    /// Returns the class that a part with a body is of: with the counts that the body gives.
    pub(crate) fn class_for_counts(
        &mut self,
        scope: &Scope,
        class: ClassId,
        members: &[Member],
    ) -> ClassId {
        if self.counts.spoken.is_empty() {
            return class;
        }
        let usual = self.counts_of(class);
        let mut numbers = Numbers::new();
        let mut asked = None;
        for member in members {
            let Member::Assign(assign) = member else { continue };
            let Some(name) = own_name(assign).filter(|name| usual.contains_key(name)) else {
                continue;
            };
            let Some(value) = assign.value().and_then(ast::Value::expr) else { continue };
            match self.constant_in_body(scope, (class, &name), &value) {
                Some(n) => {
                    numbers.extend([(name, n)]);
                    asked = asked.or(Some(Place { file: scope.file, span: assign.span() }));
                }
                None => {
                    self.not_a_count(scope, (class, &name), &value);
                }
            }
        }
        let around = scope.classes.iter().filter_map(|c| self.counts.depth.get(c)).max();
        let depth = around.map_or(0, |depth| depth + 1);
        if depth > MOST_NESTED {
            let message = "things with counts stand inside one another without end".to_string();
            let span = members.first().map_or_else(Span::default, AstNode::span);
            self.error("endless-parts", scope.file, span, message);
            return class;
        }
        let made = self.class_with(class, &numbers);
        if made != class {
            self.counts.depth.entry(made).or_insert(depth);
            asked.map(|place| self.counts.asked.entry(made).or_insert(place));
        }
        made
    }

    /// Returns the class that a part is of that is given a new thing, `q: Ring = Ring(n: 4)`: with the counts and
    /// the lists that the thing has.
    pub(crate) fn class_for_call(
        &mut self,
        scope: &Scope,
        name: &Name,
        class: ClassId,
        call: &ast::CallExpr,
        origin: OriginId,
    ) -> ClassId {
        let is_new =
            call.name().is_some_and(|w| self.visible.class(scope.file, &w.name()).is_some());
        let args: Vec<ast::Arg> = call.args().into_iter().flat_map(|a| a.args()).collect();
        if !is_new || args.is_empty() {
            return class;
        }
        let usual = self.counts_of(class);
        let (mut numbers, mut lists) = (Numbers::new(), Vec::new());
        let names = self.names_in_text(class);
        for (i, arg) in args.iter().enumerate() {
            let label = arg.label().map(|w| w.name()).or(names.get(i).cloned());
            let (Some(label), Some(value)) = (label, arg.value()) else { continue };
            match &value {
                Expr::List(list) => {
                    let count = list.elements().count() as u32;
                    match self.is_looped(class, &label) {
                        true => lists.push((label, count)),
                        false => {
                            let key = (scope.class(), name.clone(), label);
                            self.given_in_bodies.insert(key, count);
                        }
                    }
                }
                _ if usual.contains_key(&label) => {
                    let n = self.constant_in_body(scope, (class, &label), &value);
                    numbers.extend(n.map(|n| (label, n)));
                }
                _ => {}
            }
        }
        let made = self.class_with(class, &numbers);
        if made != class {
            let place = Place { file: scope.file, span: call.span() };
            self.counts.asked.entry(made).or_insert(place);
        }
        if lists.is_empty() {
            return made;
        }
        let one = self.class_of_one(scope, name, made, origin);
        self.given_counts.extend(lists.into_iter().map(|(list, count)| ((one, list), count)));
        one
    }

    /// Returns the names of what a class's things are made of as far as they are known before all parts are
    /// declared: not of a class with several superclasses.
    fn names_in_text(&self, class: ClassId) -> Vec<Name> {
        let line = self.document.primary_line(class);
        if line.iter().any(|&c| self.document.classes[c].supers.len() > 1) {
            return Vec::new();
        }
        let bodies = line.iter().rev().filter_map(|&c| self.text_of(c)?.2.body());
        let parts = bodies.flat_map(|body| body.members()).filter_map(|m| match m {
            Member::Part(part) if part.definition().is_none() => Some(part),
            _ => None,
        });
        parts.flat_map(|part| part.names().map(|w| w.name()).collect::<Vec<_>>()).collect()
    }

    /// Returns the class of the thing that a constructor makes: with the counts that it is given. Reports one
    /// that no thing has been declared with.
    pub(crate) fn class_constructed(
        &mut self,
        scope: &Scope,
        class: ClassId,
        given: &[(Name, Expr)],
    ) -> Option<ClassId> {
        let mut numbers = Numbers::new();
        let is_count = |l: &Self, name: &Name| l.document.count(class, name).is_some();
        for (name, value) in given {
            if !is_count(self, name) {
                continue;
            }
            let Some(n) = self.constant_in_body(scope, (class, name), value) else {
                self.not_a_count(scope, (class, name), value);
                return None;
            };
            numbers.extend([(name.clone(), n)]);
        }
        let known = self.known_class_with(class, &numbers);
        if known.is_none() {
            let what = self.document.classes[self.document.named_class(class)].name.clone();
            let others = numbers.iter().filter_map(|(name, n)| {
                let is = self.document.count(class, name).filter(|is| is != n)?;
                Some((name, is, n))
            });
            let others: Vec<(&Name, i64, &i64)> = others.collect();
            let is: Vec<String> =
                others.iter().map(|(name, is, _)| format!("{name} = {is}")).collect();
            let says: Vec<String> =
                others.iter().map(|(name, _, n)| format!("{name} = {n}")).collect();
            let (is, says) = (is.join(", "), says.join("  "));
            let span = given.first().map_or_else(Span::default, |(_, value)| value.span());
            let message = format!("a new {what} has {is}, and as many parts as that says");
            let d = Diagnostic::error(NOT_A_COUNT, Place { file: scope.file, span }, message);
            let hint =
                format!("declare a class that has others: `class Other is {what} {{ {says} }}`");
            self.report(d.hint(hint));
        }
        known
    }

    /// Returns the whole number that a value in the body of a part is, known as the text stands: it may speak
    /// of counts of what the part stands in, as `owner.n` or by a name that the part itself does not have.
    fn constant_in_body(
        &mut self,
        scope: &Scope,
        (class, name): (ClassId, &Name),
        value: &Expr,
    ) -> Option<i64> {
        let mut numbers: BTreeMap<Span, f64> = BTreeMap::new();
        for e in value.syntax().descendants().filter_map(Expr::cast) {
            let number = match named(&e) {
                // a count is not given itself: by its name it is given that further out
                Some((Of::Any, other))
                    if other != *name && self.count_of_class(class, &other).is_some() =>
                {
                    None
                }
                Some((_, other)) => self.constant_named(scope, &other),
                None => self.constant_count(scope, &e),
            };
            numbers.extend(number.map(|n| (e.span(), n as f64)));
        }
        let known = Known {
            document: &self.document,
            number: &|e| numbers.get(&e.span()).copied(),
            kind: &|name| self.deciding_in(scope, name),
        };
        whole(known.value(value, self.deciding_of(class, name))?)
    }

    /// Reports a value of a count that is not known as the text stands.
    fn not_a_count(&mut self, scope: &Scope, (class, name): (ClassId, &Name), value: &Expr) {
        let message = match self.deciding_of(class, name) {
            Deciding::Whole => format!(
                "{name} says how many parts there are: a whole number, known as the text stands"
            ),
            Deciding::Truth => format!(
                "{name} says which parts there are: true or false, known as the text stands"
            ),
            Deciding::Choice(choice) => {
                let options = &self.document.classes[choice].options;
                let options: Vec<&str> = options.iter().map(Name::as_str).collect();
                let options = options.join(", ");
                format!(
                    "{name} says which parts there are: one of {options}, known as the text stands"
                )
            }
        };
        let d =
            Diagnostic::error(NOT_A_COUNT, Place { file: scope.file, span: value.span() }, message);
        self.report(match unit_before_equals(value) {
            Some(unit) => d.hint(is_a_unit(&unit)),
            None => d,
        });
    }

    /// Returns true for a value of a count of which it was said that it is none.
    pub(crate) fn is_said_to_be_no_count(&self, scope: &Scope, value: &Expr) -> bool {
        let place = Place { file: scope.file, span: value.span() };
        self.said.contains(&(place, NOT_A_COUNT))
    }

    /// Returns a count that things of two classes have different numbers for, if there is one.
    pub(crate) fn counts_apart(&self, a: ClassId, b: ClassId) -> Option<(Name, i64, i64)> {
        let counts = self.document.primary_line(a).into_iter();
        let counts = counts.flat_map(|c| &self.document.classes[c].counts);
        let apart = |(name, _): &(Name, i64)| {
            let (a, b) = (self.document.count(a, name)?, self.document.count(b, name)?);
            (a != b).then(|| (name.clone(), a, b))
        };
        counts.filter_map(apart).next()
    }

    /// Says how a thing is declared that has something of its own from the beginning.
    pub(crate) fn said_where_declared(&self, thing: &Path, class: ClassId, says: &str) -> String {
        let what = &self.document.classes[self.document.named_class(class)].name;
        match thing.0.last() {
            Some(Step::Part(thing)) => {
                format!("say it where {thing} is declared: `{thing}: {what} {{ {says} }}`")
            }
            _ => format!("say it where its thing is declared: `{what} {{ {says} }}`"),
        }
    }

    /// Returns where things of a class were asked to have other counts than their class says.
    pub(crate) fn asked_at(&self, class: ClassId) -> Option<Place> {
        let line = self.document.primary_line(class);
        line.iter().find_map(|c| self.counts.asked.get(c).copied())
    }

    /// Reports a number for a count that differs from the one that the thing was made with.
    pub(crate) fn other_count(
        &mut self,
        scope: &Scope,
        path: &Path,
        term: &Term,
        value: &Expr,
    ) -> bool {
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return false };
        if owner.is_empty() {
            return false;
        }
        let Some(class) = self.class_at(scope.class(), &Path(owner.to_vec())) else { return false };
        let Some(is) = self.document.count(class, name) else { return false };
        let given = match term {
            Term::Number { value, .. } => whole(*value),
            Term::Bool(b) => Some(i64::from(*b)),
            Term::Option(_, at) => Some(i64::from(*at)),
            _ => self.constant(scope, value),
        };
        if Some(is) == given {
            return false;
        }
        let place = Place { file: scope.file, span: value.span() };
        if self.said.range((place, "")..).next().is_some_and(|(said, _)| *said == place) {
            return true;
        }
        let message = format!("{path} says how many parts there are, and is {is} here");
        let given = self.files[scope.file].text.get(value.span().range()).unwrap_or_default();
        let hint =
            self.said_where_declared(&Path(owner.to_vec()), class, &format!("{name} = {given}"));
        self.report(Diagnostic::error(NOT_A_COUNT, place, message).hint(hint));
        true
    }
}

/// Whose a name is, as far as it is written.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Of {
    /// The first thing's outwards that has it.
    Any,
    /// That of the owner.
    Owner,
}

/// Returns the name that an expression is, alone or of the owner.
fn named(e: &Expr) -> Option<(Of, Name)> {
    match e {
        Expr::Name(name) => Some((Of::Any, name.name()?.name())),
        Expr::Field(field) if matches!(field.receiver()?, Expr::Owner(_)) => {
            Some((Of::Owner, field.name()?.name()))
        }
        _ => None,
    }
}

/// Returns true if lists of a part's class have a count that is not a number.
pub(crate) fn has_named_count(part: &ast::Part) -> bool {
    part.class().is_some_and(|ty| names_of_counts(ty.syntax()).next().is_some())
}

/// Returns a whole number that is no larger than can be told apart from its neighbours.
pub(crate) fn whole(x: f64) -> Option<i64> {
    (x.fract() == 0.0 && x.abs() < 9e15).then_some(x as i64)
}

/// Returns the name of a part that an assignment speaks of, where it speaks of one of the thing itself.
fn own_name(assign: &ast::Assign) -> Option<Name> {
    match assign.target()? {
        Expr::Name(name) => Some(name.name()?.name()),
        _ => None,
    }
}

/// Returns the part of the thing itself that a member gives a value.
fn assigned(member: &Member) -> Option<Name> {
    match member {
        Member::Assign(assign) => own_name(assign),
        _ => None,
    }
}

/// Returns the names that the counts of lists and the ranges of loops speak of.
fn names_of_counts(node: &SyntaxNode) -> impl Iterator<Item = Name> {
    let mut counts = Vec::new();
    let mut walk = node.preorder();
    while let Some(event) = walk.next() {
        let WalkEvent::Enter(n) = event else { continue };
        if let Some(each) = ast::For::cast(n.clone()) {
            counts.extend(each.range().filter(|r| matches!(r, Expr::Range(_))));
        } else if let Some(choice) = ast::If::cast(n.clone()) {
            let in_program = n.ancestors().any(|above| above.kind() == SyntaxKind::Program);
            counts.extend(choice.condition().filter(|_| !in_program));
        } else if let Some(of) = ast::Type::cast(n.clone()) {
            if let TypeShape::List { count, .. } = of.shape() {
                counts.extend(count);
            }
        } else if Expr::cast(n).is_some() {
            // no list or loop is declared within an expression
            walk.skip_subtree();
        }
    }
    counts.into_iter().flat_map(|e| names_in(&e))
}

/// Returns the names that an expression speaks of.
fn names_in(e: &Expr) -> Vec<Name> {
    let names = e.syntax().descendants().filter_map(ast::NameExpr::cast);
    names.filter_map(|n| Some(n.name()?.name())).collect()
}
