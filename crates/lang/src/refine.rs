//! Refinement: masks, replaced constraints, and parts that are narrower in a class than where they
//! were declared.
//!
//! In: what `without`, `replace` and `modify` say. Out: masks on the classes themselves; and where a
//! mask or a modification concerns a part, a class of one for that part, in that class alone.

use crate::lower::Lowerer;
use crate::rules::{Heading, Mask, Written};
use crate::scope::Scope;
use base::diagnostic::nearest;
use base::{Diagnostic, Name, Place, Span};
use kernel::{
    Class, ClassId, ClassKind, Constraint, Message, Method, OriginId, PartRef, Path, Step, Term,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use syntax::ast::{self, AstNode};

/// What is said of a part: bodies that it gets, and names below it that are masked.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Refinement {
    /// The classes of the bodies of `modify`.
    bodies: Vec<ClassId>,
    /// The parts on the way, and elements of lists, and the name of the constraint or merge.
    masks: Vec<(Vec<Step>, Name)>,
}

impl Refinement {
    /// Returns what is said of a part.
    fn below(&self, part: &Step) -> Self {
        let below = |(way, mask): &(Vec<Step>, Name)| {
            let (first, rest) = way.split_first()?;
            (first == part).then(|| (rest.to_vec(), mask.clone()))
        };
        Self { bodies: self.bodies.clone(), masks: self.masks.iter().filter_map(below).collect() }
    }

    /// Returns what is said of an element of a list: what is said of it alone, and of all.
    fn of_element(&self, i: u32) -> Self {
        let of_all =
            self.masks.iter().filter(|(way, _)| !matches!(way.first(), Some(Step::Index(_))));
        let mut of_element = self.below(&Step::Index(i));
        of_element.masks.extend(of_all.cloned());
        of_element
    }

    /// Returns true if something is said of one element of a list alone.
    fn tells_elements_apart(&self) -> bool {
        self.masks.iter().any(|(way, _)| matches!(way.first(), Some(Step::Index(_))))
    }
}

/// The classes of one made so far.
pub(crate) type Made = BTreeMap<(ClassId, Refinement), ClassId>;

impl Lowerer<'_> {
    /// Declares the body that every part of a kind gets in the things of a class.
    pub(crate) fn declare_modify(&mut self, scope: &Scope, modify: &ast::Modify) {
        let Some(ty) = modify.class() else { return };
        let Some(class) = self.class_of_type(scope, &ty) else { return };
        if self.document.classes[class].kind != ClassKind::Composite {
            let what = &self.document.classes[class].name;
            let message = format!("{what} has no parts or messages to modify");
            return self.error("not-modifiable", scope.file, ty.span(), message);
        }
        let origin = self.origin(scope.file, modify.span());
        let name = self.document.classes[class].name.to_string();
        let body = self.add_unnamed_class(&name, class, origin);
        self.document.classes[body].is_of_one = true;
        self.modifications.entry(scope.class()).or_default().push(body);
        self.modified.insert(body, class);
        let members = modify.body().into_iter().flat_map(|b| b.members()).collect();
        self.declare_body(&Scope::of(scope.file, body), members);
    }

    /// Finds the parts that modifications make narrower, once all parts are declared, so that what bodies
    /// of `modify` add can be spoken of.
    pub(crate) fn prepare_modifications(&mut self) {
        if self.modifications.is_empty() {
            return;
        }
        for (class, bodies) in self.modifications.clone() {
            let above = self.document.lineage(class);
            let inherited = collect(&self.modifications, &above[1..]);
            for body in bodies {
                // what a class above says of the same parts is there already
                let of =
                    |&&b: &&ClassId| self.document.is_a(self.modified[&body], self.modified[&b]);
                if let Some(&other) = inherited.iter().rev().find(of) {
                    self.document.classes[body].supers[0].class = other;
                }
            }
        }
        let mut made = std::mem::take(&mut self.narrowed);
        for class in self.document.classes.ids().collect::<Vec<_>>() {
            let bodies = collect(&self.modifications, &self.document.lineage(class));
            if !bodies.is_empty() {
                let refinement = Refinement { bodies, masks: Vec::new() };
                let refined = self.refined_fields(class, &refinement, &mut made);
                self.refine(class, refined);
            }
        }
        self.narrowed = made;
    }

    /// Carries out masks, replacements and modifications, once everything is defined.
    pub(crate) fn refine_parts(&mut self) {
        let mut masks: BTreeMap<ClassId, Vec<(Vec<Step>, Name)>> = BTreeMap::new();
        for (scope, replace, origin) in std::mem::take(&mut self.replacements) {
            self.replace(&scope, &replace, origin);
        }
        for mask in std::mem::take(&mut self.masks) {
            let Some((way, name)) = self.masked(&mask) else { continue };
            match way.is_empty() {
                true => self.document.classes[mask.class].without.push(name),
                false => masks.entry(mask.class).or_default().push((way, name)),
            }
        }
        if masks.is_empty() && self.modifications.is_empty() {
            return;
        }
        let mut made = std::mem::take(&mut self.narrowed);
        for class in self.document.classes.ids().collect::<Vec<_>>() {
            let line = self.document.primary_line(class);
            let lineage = self.document.lineage(class);
            let refinement = Refinement {
                bodies: collect(&self.modifications, &lineage),
                masks: collect(&masks, &line),
            };
            if refinement != Refinement::default() {
                let refined = self.refined_fields(class, &refinement, &mut made);
                self.refine(class, refined);
            }
        }
        for (body, to) in std::mem::take(&mut self.copies) {
            self.add_members(body, to);
        }
    }

    /// Returns the class of a field as it was declared, or as a loop that goes on declares it anew.
    fn longest(&self, class: ClassId, field: PartRef) -> ClassId {
        if self.longer.is_empty() {
            return self.document.field_class(field);
        }
        let line = self.document.primary_line(class);
        let own = |c: &ClassId| self.longer.iter().find(|(of, f, _)| (of, *f) == (c, field));
        line.iter().find_map(own).map_or_else(|| self.document.field_class(field), |l| l.2)
    }

    /// Makes fields of a class narrower; others that were made so stay as they are.
    fn refine(&mut self, class: ClassId, mut refined: Vec<(PartRef, ClassId)>) {
        let known = std::mem::take(&mut self.document.classes[class].refined);
        let others = known.into_iter().filter(|(f, _)| !refined.iter().any(|(g, _)| f == g));
        let others: Vec<_> = others.collect();
        refined.extend(others);
        self.document.classes[class].refined = refined;
    }

    /// Returns the fields of a class that a refinement makes narrower.
    fn refined_fields(
        &mut self,
        class: ClassId,
        refinement: &Refinement,
        made: &mut Made,
    ) -> Vec<(PartRef, ClassId)> {
        let mut refined = Vec::new();
        for field in self.document.layout(class) {
            let name = self.document.field_name(field).clone();
            let of_field = refinement.below(&Step::Part(name.clone()));
            let declared = self.longest(class, field);
            let count =
                || self.count_of_part(class, &name).or_else(|| self.given_count(class, &name));
            let count = if of_field.tells_elements_apart() { count() } else { None };
            if let Some(narrower) = self.narrower(declared, count, &of_field, made) {
                refined.push((field, narrower));
            }
        }
        refined
    }

    /// Returns the class of a list with the elements, each of a class of its own, that concern a
    /// refinement narrowed.
    fn narrower_of_own(
        &mut self,
        list: ClassId,
        elements: &[ClassId],
        refinement: &Refinement,
        made: &mut Made,
    ) -> Option<ClassId> {
        let mut narrowed = elements.to_vec();
        for (i, class) in (0..).zip(&mut narrowed) {
            let of_element = refinement.of_element(i);
            let count = self.document.classes[*class].count;
            if let Some(narrower) = self.narrower(*class, count, &of_element, made) {
                *class = narrower;
            }
        }
        let own = self.document.classes[list].clone();
        let count = Some(narrowed.len() as u32);
        let is_other = narrowed != elements;
        is_other.then(|| self.document.classes.push(Class { count, elements: narrowed, ..own }))
    }

    /// Returns the class of one that a part of a class gets; none where nothing concerns it. `count` is how
    /// many elements it has, where it is a list and that is needed.
    fn narrower(
        &mut self,
        class: ClassId,
        count: Option<u32>,
        refinement: &Refinement,
        made: &mut Made,
    ) -> Option<ClassId> {
        match self.document.classes[class].kind {
            ClassKind::Primitive(_) | ClassKind::Set(_) | ClassKind::Reference(_) => return None,
            ClassKind::List(_) if !self.document.classes[class].elements.is_empty() => {
                let elements = self.document.classes[class].elements.clone();
                return self.narrower_of_own(class, &elements, refinement, made);
            }
            ClassKind::List(element) if refinement.tells_elements_apart() => {
                let count = self.document.classes[class].count.or(count)?;
                let elements = vec![element; count as usize];
                return self.narrower_of_own(class, &elements, refinement, made);
            }
            ClassKind::List(element) => {
                let within = self.document.classes[element].count;
                let element = self.narrower(element, within, refinement, made)?;
                return Some(match self.document.classes[class].count {
                    Some(count) => self.counted(element, count),
                    None => self.class_made_of("List of", ClassKind::List(element), element),
                });
            }
            ClassKind::Composite => {}
        }
        let concerns = !refinement.masks.is_empty()
            || refinement.bodies.iter().any(|&b| self.reaches(class, self.modified[&b]));
        if !concerns {
            return None;
        }
        let key = (class, refinement.clone());
        if let Some(&known) = made.get(&key) {
            return Some(known);
        }
        let (name, origin) = {
            let c = &self.document.classes[class];
            (c.name.to_string(), c.origin)
        };
        let mut one = class;
        for &body in &refinement.bodies {
            if self.document.is_a(class, self.modified[&body]) {
                one = self.add_narrower(&name, one, origin);
                self.declare_copy(body, one);
            }
        }
        if one == class || !refinement.masks.is_empty() {
            one = self.add_narrower(&name, one, origin);
        }
        made.insert(key, one);
        let own = refinement.masks.iter().filter(|(way, _)| way.is_empty());
        self.document.classes[one].without.extend(own.map(|(_, name)| name.clone()));
        self.document.classes[one].refined = self.refined_fields(class, refinement, made);
        Some(one)
    }

    pub(crate) fn add_narrower(&mut self, name: &str, class: ClassId, origin: OriginId) -> ClassId {
        let one = self.add_unnamed_class(name, class, origin);
        self.document.classes[one].is_of_one = true;
        one
    }

    /// Declares what a body of `modify` declares in a class that gets it; the rest follows once it is
    /// defined.
    fn declare_copy(&mut self, body: ClassId, to: ClassId) {
        let Class { parts, messages, .. } = self.document.classes[body].clone();
        for (index, part) in (0..).zip(parts) {
            self.parts.insert((to, part.name.clone()), index);
            self.document.classes[to].parts.push(part);
        }
        for (index, message) in (0..).zip(messages) {
            let (from, key) = ((body, message.name.clone()), (to, message.name.clone()));
            if let Some(known) = self.definitions.get(&from).cloned() {
                self.definitions.insert(key.clone(), known);
            }
            if let Some(known) = self.message_kinds.get(&from).cloned() {
                self.message_kinds.insert(key.clone(), known);
            }
            self.messages.insert(key, index);
            self.document.classes[to].messages.push(message);
        }
        let rules =
            self.constraints.range((body, Name::from(""))..).take_while(|(c, _)| *c == body);
        let rules: Vec<Name> = rules.map(|(_, name)| name.clone()).collect();
        self.constraints.extend(rules.into_iter().map(|name| (to, name)));
        self.copies.push((body, to));
    }

    /// Returns true if things of a class are things of another, or have such parts at any depth.
    fn reaches(&self, class: ClassId, wanted: ClassId) -> bool {
        let document = &self.document;
        let mut seen = BTreeSet::from([class]);
        let mut waiting = vec![class];
        while let Some(class) = waiting.pop() {
            if document.is_a(class, wanted) {
                return true;
            }
            let next = match document.classes[class].kind {
                ClassKind::Primitive(_) | ClassKind::Set(_) | ClassKind::Reference(_) => Vec::new(),
                ClassKind::List(element) => vec![element],
                ClassKind::Composite => {
                    document.layout(class).into_iter().map(|f| document.field_class(f)).collect()
                }
            };
            waiting.extend(next.into_iter().filter(|&c| seen.insert(c)));
        }
        false
    }

    /// Adds what a body of `modify` says to a class; its `super` begins above that class.
    fn add_members(&mut self, body: ClassId, to: ClassId) {
        let from = self.document.classes[body].clone();
        let term = |t: &Term| t.with_above(body, to);
        let message = |m: Message| Message { answer: Rc::new(term(&m.answer)), ..m };
        let method =
            |m: &Method| Method { values: m.values.iter().map(term).collect(), ..m.clone() };
        let constraint = |c: Constraint| Constraint {
            rule: Rc::new(term(&c.rule)),
            within: c.within.as_deref().map(term).map(Box::new),
            methods: c.methods.iter().map(method).collect(),
            ..c
        };
        let class = &mut self.document.classes[to];
        class.givens.extend(from.givens);
        class.messages = from.messages.into_iter().map(message).collect();
        class.constraints.extend(from.constraints.into_iter().map(constraint));
        class.merges.extend(from.merges);
        class.inserts.extend(from.inserts);
        class.stays.extend(from.stays);
        class.switches.extend(from.switches);
        class.without.extend(from.without);
        class.attachers.extend(from.attachers);
        class.handles.extend(from.handles);
    }

    /// Puts another rule in the place of an inherited one: its name and strength stay.
    fn replace(&mut self, scope: &Scope, replace: &ast::Replace, origin: OriginId) {
        let (Some(target), Some(rule)) = (replace.target(), replace.rule()) else { return };
        let Some(path) = self.written_path(scope, &target) else { return };
        let place = Place { file: scope.file, span: target.span() };
        let mask = Mask { class: scope.class(), path, place };
        let Some((way, name)) = self.masked(&mask) else { return };
        let Some(class) = self.class_at(mask.class, &Path(way)) else { return };
        let above = self.document.primary_line(class);
        let said = above.iter().flat_map(|&c| self.with_bodies(c)).collect::<Vec<_>>();
        let rules = said.iter().flat_map(|&c| &self.document.classes[c].constraints);
        let replaced = rules.into_iter().find(|c| c.name.as_ref() == Some(&name));
        let Some((strength, doc)) = replaced.map(|c| (c.strength, c.doc.clone())) else {
            let message = format!("{name} is a merge, which has no rule to replace");
            let d = Diagnostic::error("not-a-rule", place, message);
            return self.report(d.hint(format!("mask it, `without {name}`, and say the rule")));
        };
        self.masks.push(mask);
        let written = Written { rule, tolerance: replace.tolerance(), methods: replace.methods() };
        let heading = Heading { name: Some(name), doc: doc.to_string(), strength, origin };
        self.add_constraint(scope, written, heading);
    }

    /// Finds the constraint or merge that a mask names: the parts on the way to it, and its name.
    ///
    /// A bare name means what the primary line says or, where that says nothing of the name, the one
    /// other superclass that does.
    fn masked(&mut self, mask: &Mask) -> Option<(Vec<Step>, Name)> {
        let Mask { class, path, place } = mask;
        let (Step::Part(name), before) = path.0.split_last()? else { return None };
        let mut way = Vec::new();
        let mut at = *class;
        // how many elements what was reached has, if it is a list
        let mut count = None;
        for step in before {
            let part = match step {
                Step::Part(part) => part,
                Step::Index(_) | Step::Last => {
                    let (i, element) = self.masked_element(at, count, step, mask)?;
                    way.push(Step::Index(i));
                    count = self.document.classes[element].count;
                    at = element;
                    continue;
                }
                Step::Owner => {
                    let message = format!("{path} is no constraint of a part");
                    self.report(Diagnostic::error("unknown-name", *place, message));
                    return None;
                }
            };
            // what is said of a list's parts is said of every element
            at = self.innermost(at);
            if self.is_primary_name(at, part) {
                continue;
            }
            let Some(next) = self.class_of_part(at, part) else {
                let message = format!("no constraint or merge called {path} is inherited here");
                self.report(Diagnostic::error("unknown-name", *place, message));
                return None;
            };
            way.push(Step::Part(part.clone()));
            count = self.count_of_part(at, part).or_else(|| self.given_count(at, part));
            at = next;
        }
        let at = self.innermost(at);
        let start = place.span.end.saturating_sub(name.len() as u32);
        let word = Place { file: place.file, span: Span::new(start, place.span.end) };
        self.refer(word, name, at);
        let mut ways = self.ways_to_rule(at, name, *class);
        if ways.len() == 1 || ways.first().is_some_and(Vec::is_empty) {
            way.extend(ways.swap_remove(0).into_iter().map(Step::Part));
            return Some((way, name.clone()));
        }
        if let [first, second, ..] = &ways[..] {
            let shown = |way: &Vec<Name>| {
                let names: Vec<&str> = way.iter().map(Name::as_str).collect();
                format!("{}.{name}", names.join("."))
            };
            let message = format!("{path} may be {} or {}", shown(first), shown(second));
            let d = Diagnostic::error("ambiguous-name", *place, message);
            self.report(d.hint("say which"));
            return None;
        }
        let names = self.rule_names_above(at, *class);
        let message = format!("no constraint or merge called {path} is inherited here");
        let mut d = Diagnostic::error("unknown-name", *place, message);
        if let Some(near) = nearest(name, names.iter().map(Name::as_str)) {
            let fix = (word, near.to_string());
            d = d.hint(format!("did you mean `{near}`?")).fix(format!("write {near}"), [fix]);
        } else if !names.is_empty() {
            let names: Vec<&str> = names.iter().map(Name::as_str).collect();
            d = d.hint(format!("there are {}", names.join(", ")));
        }
        self.report(d);
        None
    }

    /// Finds the element of a list that a mask names, and its class; reports one that is not there.
    fn masked_element(
        &mut self,
        list: ClassId,
        count: Option<u32>,
        step: &Step,
        mask: &Mask,
    ) -> Option<(u32, ClassId)> {
        let i = match step {
            Step::Index(i) => Some(*i),
            Step::Last | Step::Part(_) | Step::Owner => count.and_then(|n| n.checked_sub(1)),
        };
        let found = i.filter(|i| count.is_some_and(|n| i < &n));
        let element = found.and_then(|i| Some((i, self.element_at(list, i)?)));
        if element.is_none() {
            let message = match count {
                Some(n) => format!("{} names an element of a list of {n}", mask.path),
                None => format!("{} names an element of a list of none", mask.path),
            };
            let d = Diagnostic::error("index", mask.place, message);
            self.report(d.hint("without an index it is said of every element"));
        }
        element
    }

    /// Returns the class of the elements of a list, those of lists in it; any other class is returned.
    fn innermost(&self, class: ClassId) -> ClassId {
        let elements = std::iter::successors(Some(class), |&list| self.element(list));
        elements.last().unwrap_or(class)
    }

    /// Returns true if a name is that of a primary superclass, by which a thing reaches itself.
    pub(crate) fn is_primary_name(&self, class: ClassId, name: &Name) -> bool {
        let declares = |&c: &ClassId| {
            let supers = &self.document.classes[c].supers;
            let part = self.parts.contains_key(&(c, name.clone()));
            part.then_some(false).or(supers.iter().position(|s| s.name == *name).map(|i| i == 0))
        };
        self.document.primary_line(class).iter().find_map(declares).unwrap_or(false)
    }

    /// Returns the superclass parts on the way to every rule of this name; none for the thing itself.
    fn ways_to_rule(&self, class: ClassId, name: &Name, masking: ClassId) -> Vec<Vec<Name>> {
        let document = &self.document;
        let line = document.primary_line(class);
        let says = |&&c: &&ClassId| c != masking && self.says(c, name);
        if line.iter().any(|c| says(&c)) {
            return vec![Vec::new()];
        }
        let others = line.iter().flat_map(|&c| document.classes[c].supers.iter().skip(1));
        let below = others.flat_map(|s| {
            let mut ways = self.ways_to_rule(s.class, name, masking);
            ways.iter_mut().for_each(|way| way.insert(0, s.name.clone()));
            ways
        });
        below.collect()
    }

    /// Returns true if a class itself has a constraint or merge of this name, or gets it from a body of
    /// `modify`.
    fn says(&self, class: ClassId, name: &Name) -> bool {
        self.with_bodies(class).any(|c| {
            let c = &self.document.classes[c];
            let mut names =
                c.constraints.iter().map(|c| &c.name).chain(c.merges.iter().map(|m| &m.name));
            names.any(|n| n.as_ref() == Some(name))
        })
    }

    /// Returns a class and the bodies of `modify` that it gets.
    fn with_bodies(&self, class: ClassId) -> impl Iterator<Item = ClassId> {
        let bodies = self.copies.iter().filter(move |(_, to)| *to == class).map(|(body, _)| *body);
        std::iter::once(class).chain(bodies)
    }

    fn rule_names_above(&self, class: ClassId, masking: ClassId) -> Vec<Name> {
        let lineage = self.document.lineage(class);
        let classes = lineage.into_iter().filter(|&c| c != masking);
        let names = classes.map(|c| &self.document.classes[c]).flat_map(|c| {
            let constraints = c.constraints.iter().filter_map(|c| c.name.clone());
            constraints.chain(c.merges.iter().filter_map(|m| m.name.clone())).collect::<Vec<_>>()
        });
        names.collect()
    }
}

/// Returns what is listed for some classes, in their order, each once.
fn collect<T: Clone + PartialEq>(
    by_class: &BTreeMap<ClassId, Vec<T>>,
    classes: &[ClassId],
) -> Vec<T> {
    let mut all: Vec<T> = Vec::new();
    for item in classes.iter().rev().filter_map(|c| by_class.get(c)).flatten() {
        if !all.contains(item) {
            all.push(item.clone());
        }
    }
    all
}
