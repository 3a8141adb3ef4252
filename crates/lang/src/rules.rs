//! Rules: everything that speaks of parts, lowered once all parts are declared.

use crate::hints::{is_a_unit, unit_before_equals};
use crate::kinds::{Kind, measured};
use crate::lower::Lowerer;
use crate::lowering::Waiting;
use crate::members::Pending;
use crate::scope::Scope;
use crate::terms::code_for;
use crate::trails::Trails;
use base::{Diagnostic, Name, Place};
use kernel::{
    BinaryOperator, ClassId, ClassKind, Constraint, Given, Merge, Method, OriginId, Path,
    Primitive, Side, SideWay, Stay, Step, Strength, Term,
};
use std::collections::BTreeSet;
use std::rc::Rc;
use syntax::ast::{
    self, AstNode, BinaryOp, Expr, Member, MethodItem, Rule, UnaryOp, span_without_doc,
};

/// Where a rule stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Standing {
    Alone,
    InBranch,
}

/// What `without` names, and where.
#[derive(Clone, Debug)]
pub(crate) struct Mask {
    pub(crate) class: ClassId,
    pub(crate) path: Path,
    pub(crate) place: Place,
}

/// What a constraint says, as it was written.
pub(crate) struct Written {
    pub(crate) rule: Rule,
    pub(crate) tolerance: Option<Expr>,
    pub(crate) methods: Option<ast::MethodList>,
}

/// What stands before a constraint's rule.
pub(crate) struct Heading {
    pub(crate) name: Option<Name>,
    pub(crate) doc: String,
    pub(crate) strength: Strength,
    pub(crate) origin: OriginId,
}

impl Lowerer<'_> {
    /// Declares what can be declared only once all members were seen.
    pub(crate) fn begin_members(&mut self) {
        self.declare_repeated();
        self.decide_loops();
        self.declare_for_counts_from_outside();
        self.continue_loops();
        self.complete_placed();
        self.prepare_modifications();
        self.define_programs();
        self.forward_programs();
    }

    /// Ends what was lowered.
    pub(crate) fn end_members(&mut self) {
        self.finish_programs();
        self.drop_broken_messages();
    }

    /// Takes away the messages whose answers are wrong.
    fn drop_broken_messages(&mut self) {
        let classes: BTreeSet<ClassId> = self.broken.iter().map(|(class, _)| *class).collect();
        for class in classes {
            let messages = &mut self.document.classes[class].messages;
            messages.retain(|m| !self.broken.contains(&(class, m.name.clone())));
            for (index, message) in messages.iter().enumerate() {
                self.messages.insert((class, message.name.clone()), index);
            }
        }
    }

    /// Lowers what a member says that waited; returns a loop, whose turns follow, from which on.
    pub(crate) fn define_one(
        &mut self,
        mut pending: Pending,
        among: &mut Waiting,
    ) -> Option<(Rc<Scope>, ast::For, u32)> {
        self.look_outwards(&mut pending);
        if self.connect(&pending) {
            return None;
        }
        match pending {
            Pending::Kept(run) => self.keep_values(run),
            Pending::KeptLoop(kept) => self.keep_loop(&kept),
            Pending::NotedLoop { member, members, words } => {
                self.note_loop((member, members), &words, among.noted);
            }
            Pending::Note(member) => among.noted = self.begin_note(member),
            Pending::Noted { member, part, givens } => {
                self.note(member, part, givens, among.noted);
            }
            Pending::Each { scope, each, from } => return Some((scope, each, from)),
            Pending::Member(scope, member) => self.define(&scope, &member, &mut among.trails),
            Pending::Value { scope, prefix, target, value } => {
                self.define_value(&scope, prefix, target.as_ref(), &value);
            }
            Pending::Absolute { scope, path, target } => {
                self.define_absolute(&scope, path, &target);
            }
            Pending::Answer { scope, index, .. } if self.keep_answer(&scope, index) => {}
            Pending::Answer { scope, index, definition } => {
                self.define_answer(&scope, index, &definition);
            }
        }
        None
    }

    pub(crate) fn define_value(
        &mut self,
        scope: &Scope,
        prefix: Vec<Step>,
        target: Option<&Expr>,
        value: &Expr,
    ) {
        if target.is_some_and(|target| self.define_switch(scope, &prefix, target, value)) {
            return;
        }
        let mut path = Path(prefix);
        let mut class = self.class_at(scope.class(), &path);
        if let Some(target) = target {
            // what is given belongs to the thing itself, not to one around it
            let of = class.filter(|_| !path.is_empty()).unwrap_or(scope.class());
            let own = scope.of_target(of, !path.is_empty());
            let before = self.diagnostics.len();
            let Some((rest, kind)) = self.path(&own, target) else {
                return self.hint_target(before, &own, target, value);
            };
            path = path.join(&rest);
            class = kind;
        }
        if self.is_said_to_be_no_count(scope, value) {
            return;
        }
        if class.is_some_and(|c| matches!(self.document.classes[c].kind, ClassKind::Set(_))) {
            return self.define_set(scope, &path, class, value);
        }
        let wanted = class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c));
        let before = self.diagnostics.len();
        let found = self.expr_wanting(scope, value, &wanted);
        if self.is_reference(scope.class(), &path) {
            self.leads_nowhere(before);
        }
        let Some((term, kind)) = found else { return self.hint_value(before, &wanted, value) };
        if let (Kind::Thing(given), Some(wanted)) = (&kind, class)
            && let Some((name, is, other)) = self.counts_apart(wanted, *given)
        {
            let message = format!("{path} has {name} = {is}, and is given a thing with {other}");
            let place = Place { file: scope.file, span: value.span() };
            let d = Diagnostic::error("not-a-count", place, message);
            let hint = self.said_where_declared(&path, wanted, &format!("{name} = {other}"));
            return self.report(d.hint(hint));
        }
        if !kind.fits(&wanted, &self.document) {
            let (is, given) = (wanted.words(&self.document), kind.words(&self.document));
            let message = format!("{path} is {is}, and is given {given}");
            let place = Place { file: scope.file, span: value.span() };
            let d = Diagnostic::error(code_for(&kind, &wanted), place, message);
            let unit = unit_before_equals(value);
            let hint = unit
                .map(|unit| is_a_unit(&unit))
                .or_else(|| self.meant_further_out(scope, value, &wanted))
                .or_else(|| self.meant_part_of_it(&path, (&kind, &wanted), value));
            let d = match hint {
                Some(hint) => d.hint(hint),
                None => self.with_value_hint(d, (&kind, &wanted), value),
            };
            return self.report_whole(d);
        }
        if class.is_some_and(|class| self.loses_elements(scope, &path, class, value)) {
            return;
        }
        self.refer_by_position(scope.file, value, &wanted);
        let term = measured(&self.document, term, &kind, &wanted);
        if self.is_given_by_itself(scope, &path, &term, (target, value))
            || self.misfits(scope, &path, class, &term, value)
            || self.other_count(scope, &path, &term, value)
        {
            return;
        }
        if let Some(name) = class.map(|class| self.document.classes[class].name.clone()) {
            self.warn_of_value(scope, &name, value);
        }
        if let Some(class) = class {
            self.warn_of_bare_degrees(scope, class, value, &|degrees| format!("`{degrees}`"));
            if !self.is_reference(scope.class(), &path) {
                self.warn_of_narrower(scope, (&path, class), (&kind, value));
            }
        }
        let origin = self.origin(scope.file, value.span());
        if let Some(unit) = crate::numbers::unit_of(value) {
            self.document.units.insert(origin, unit);
        }
        self.bind_value(scope, (&path, class), (value, &term), origin);
        self.document.classes[scope.class()].givens.push(Rc::new(Given {
            path,
            value: term,
            origin,
        }));
    }

    /// Gives a reference the path that it follows from the document: from the one whose text says it, where that
    /// has what is named, else from the one that uses it.
    fn define_absolute(&mut self, scope: &Scope, path: Path, target: &Expr) {
        let root = Scope::of(scope.file, self.document.root);
        let before = self.diagnostics.len();
        let (found, document) = match self.in_own_document(scope, target) {
            Some((found, document)) => (Some(found), document),
            None => (self.expr(&root, target), Term::Document),
        };
        self.leads_nowhere(before);
        let Some((term, kind)) = found else { return };
        let class = self.class_at(scope.class(), &path);
        let wanted = class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c));
        if !kind.fits(&wanted, &self.document) {
            return self.wrong_kind(scope, target.span(), &kind, &wanted);
        }
        let origin = self.origin(scope.file, target.span());
        let value = from_document(term, &document);
        self.document.classes[scope.class()].givens.push(Rc::new(Given { path, value, origin }));
    }

    /// Lowers what an absolute reference names among the things of its own text, where a document uses these;
    /// returns the document that it leads from, too.
    fn in_own_document(&mut self, scope: &Scope, target: &Expr) -> Option<((Term, Kind), Term)> {
        let things = self.file_things.get(&scope.file)?.clone();
        let class = self.class_at(self.document.root, &things)?;
        self.silent += 1;
        let found = self.expr(&Scope::of(scope.file, class), target);
        self.silent -= 1;
        Some((found?, Term::at(Term::Document, &things)))
    }

    /// Returns true for the path of a part that names another.
    pub(crate) fn is_reference(&self, class: ClassId, path: &Path) -> bool {
        let [Step::Part(name)] = path.0.as_slice() else { return false };
        let line = self.document.primary_line(class);
        let own = line.into_iter().find_map(|c| {
            let index = *self.parts.get(&(c, name.clone()))?;
            Some(self.document.classes[c].parts[index].class)
        });
        own.is_some_and(|c| matches!(self.document.classes[c].kind, ClassKind::Reference(_)))
    }

    /// Says of names that were found to be unknown, that a reference names nothing by them.
    fn leads_nowhere(&mut self, before: usize) {
        for d in self.diagnostics.iter_mut().skip(before) {
            if matches!(d.code, "unknown-name" | "unknown-part" | "index") {
                d.code = "unknown-reference";
            }
        }
    }

    /// Reports a fraction where a whole number is wanted, and a list of another length.
    fn misfits(
        &mut self,
        scope: &Scope,
        path: &Path,
        class: Option<ClassId>,
        term: &Term,
        value: &Expr,
    ) -> bool {
        if class.is_some_and(|class| self.is_fraction(scope, &path.to_string(), class, value)) {
            return true;
        }
        let kind = class.map(|c| &self.document.classes[c].kind);
        let message = match (kind, term) {
            (Some(ClassKind::List(element)), given)
                if *element == self.object
                    && !matches!(given, Term::List(items) if items.is_empty()) =>
            {
                let message = format!(
                    "{path} holds things without parts, and keeps nothing of what it is given"
                );
                let place = Place { file: scope.file, span: value.span() };
                let written = value.syntax().text();
                let d = Diagnostic::error("value-of-wrong-class", place, message);
                self.report(d.hint(format!("`{path} => {written}` lists what there is")));
                return true;
            }
            (Some(ClassKind::List(_)), Term::List(items)) => {
                match self.count_at(scope, path).filter(|&n| n as usize != items.len()) {
                    Some(n) => format!("{path} has {n} elements, and is given {}", items.len()),
                    None => return false,
                }
            }
            _ => return false,
        };
        self.error("value-of-wrong-class", scope.file, value.span(), message);
        true
    }

    /// Reports a fraction that is given to something of a class where that is of whole numbers.
    pub(crate) fn is_fraction(
        &mut self,
        scope: &Scope,
        what: &str,
        class: ClassId,
        value: &Expr,
    ) -> bool {
        let kind = &self.document.classes[class].kind;
        let is_whole = *kind == ClassKind::Primitive(Primitive::Integer);
        let plain = is_whole.then(|| crate::numbers::constant(&|_| None, value)).flatten();
        let Some(x) = plain.filter(|x| x.fract() != 0.0) else { return false };
        let message = format!("{what} is a whole number, and is given {x}");
        let place = Place { file: scope.file, span: value.span() };
        let hint = "a number with a fraction is a `Real`; `round(x)` is the nearest whole one";
        self.report(Diagnostic::error("value-of-wrong-class", place, message).hint(hint));
        true
    }

    fn define_side(&mut self, scope: &Scope, side: &ast::Side, origin: OriginId) {
        let (Some(target), Some(word)) = (side.target(), side.side()) else { return };
        let Some(path) = self.paths(scope, std::iter::once(target.clone())).pop() else { return };
        let class = self.class_at(scope.class(), &path);
        let is_place = class.is_some_and(|c| self.document.place_in(c).is_some());
        let is_number = class.is_some_and(|c| match &self.document.classes[c].kind {
            ClassKind::Primitive(primitive) => primitive.is_number(),
            _ => false,
        });
        let way = SideWay::ALL.into_iter().find(|way| *word.name() == *way.word());
        let fits = |way: &SideWay| way.coordinate().is_some() == is_place;
        match way.filter(fits) {
            _ if !is_place && !is_number => {
                let message = format!("{path} is neither a place nor a number");
                self.error("side-of-nothing", scope.file, target.span(), message);
            }
            Some(way) => {
                self.document.classes[scope.class()].sides.push(Side { path, way, origin });
            }
            None => {
                let ways = SideWay::ALL.into_iter().filter(fits).map(SideWay::word);
                let ways = ways.collect::<Vec<_>>().join(", ");
                let message = format!("found `{}`, wanted one of {ways}", word.name());
                self.error("unknown-side", scope.file, word.span(), message);
            }
        }
    }

    pub(crate) fn define(&mut self, scope: &Scope, member: &Member, trails: &mut Trails) {
        let origin = self.rule_origin(scope, span_without_doc(member.syntax()));
        let class = scope.class();
        match member {
            Member::Constraint(c) => self.define_constraint(scope, c, origin),
            Member::Merge(merge) if self.define_joint(scope, merge, origin) => {}
            Member::Merge(merge) => {
                let (paths, wanted) = self.paths_of_merge(scope, merge, trails);
                let Some(name) = self.rule_name(scope, merge.name()) else { return };
                let twice = (1..paths.len()).find(|&i| paths[..i].contains(&paths[i]));
                if let Some(i) = twice {
                    let message = format!("{} is merged with itself", paths[i]);
                    self.error("vacuous-merge", scope.file, merge.span(), message);
                    return;
                }
                if paths.len() == wanted && wanted > 1 {
                    let place = Place { file: scope.file, span: merge.span() };
                    self.warn_of_ends(scope, &paths, place, "merge ");
                    self.document.classes[class].merges.push(Merge { name, paths, origin });
                }
            }
            Member::Stay(stay) => {
                let strength = stay.strength().map_or(Strength::Weak, strength);
                for path in self.paths(scope, stay.paths()) {
                    let stay = Stay { path, strength: Some(strength), origin };
                    self.document.classes[class].stays.push(stay);
                }
            }
            Member::Anchor(anchor) => {
                for path in self.paths(scope, anchor.paths()) {
                    self.document.classes[class].stays.push(Stay { path, strength: None, origin });
                }
            }
            Member::Side(side) => self.define_side(scope, side, origin),
            Member::Insert(insert) => self.define_insert(scope, insert, origin),
            Member::Without(without) => {
                for e in without.paths() {
                    let place = Place { file: scope.file, span: e.span() };
                    let Some(path) = self.written_path(scope, &e) else {
                        let message = "the path of a constraint or merge is wanted: `a.level`";
                        self.report(Diagnostic::error("not-a-path", place, message));
                        continue;
                    };
                    self.masks.push(Mask { class, path, place });
                }
            }
            Member::Replace(replace) => {
                self.replacements.push((scope.clone(), replace.clone(), origin));
            }
            Member::Attachers(attachers) => {
                let paths = self.paths(scope, attachers.paths());
                self.document.classes[class].attachers.extend(paths);
            }
            Member::Handle(handle) => self.define_handle(scope, handle),
            _ => {}
        }
    }

    /// Returns the name of a constraint or merge, if it has one; nothing where it is not new.
    pub(crate) fn rule_name(
        &mut self,
        scope: &Scope,
        word: Option<ast::Word>,
    ) -> Option<Option<Name>> {
        let Some(word) = word else { return Some(None) };
        let place = Place { file: scope.file, span: word.span() };
        let key = (scope.class(), word.name());
        let is_new = !self.rule_names.contains_key(&key);
        self.rule_names.entry(key).or_insert(place);
        if is_new || !scope.constants.is_empty() || !scope.elements.is_empty() {
            return Some(Some(word.name()));
        }
        let message = format!("there is a constraint or merge {} already", word.text());
        let d = Diagnostic::error("duplicate-name", place, message);
        self.report(d.hint("give one of them another name"));
        None
    }

    fn define_constraint(&mut self, scope: &Scope, c: &ast::Constraint, origin: OriginId) {
        if self.keep_constraint(scope, c, origin) {
            return;
        }
        let Some(rule) = c.rule() else { return };
        if self.rule_sets(scope, &rule) {
            return;
        }
        let Some(name) = self.rule_name(scope, c.name()) else { return };
        if let Rule::Holds(rule) = &rule {
            self.warn_of_equals(scope, rule);
        }
        let written = Written { rule, tolerance: c.tolerance(), methods: c.methods() };
        let strength = c.strength().map_or(Strength::Required, strength);
        let doc = c.doc().unwrap_or_default();
        self.add_constraint(scope, written, Heading { name, doc, strength, origin });
    }

    /// Lowers a rule with its tolerance and methods, and adds it to the class of the scope.
    pub(crate) fn add_constraint(&mut self, scope: &Scope, written: Written, heading: Heading) {
        let Written { rule, tolerance: within, methods: written } = written;
        if let Rule::Holds(rule) = &rule
            && self.splits_its_rule(scope, rule, within.as_ref())
        {
            return;
        }
        let Some(term) = self.rule(scope, &rule, Standing::Alone) else { return };
        let tolerance = |l: &mut Self, e: &Expr| match &rule {
            Rule::Holds(rule) => l.tolerance(scope, rule, e),
            Rule::If(_) => l.expr_of(scope, e, &Kind::Number(None)),
        };
        let within = match within {
            Some(e) => match tolerance(self, &e) {
                Some(term) => Some(term),
                None => return,
            },
            None => None,
        };
        let (mut methods, mut reads, mut derived, mut whole) = (Vec::new(), Vec::new(), true, true);
        for item in written.into_iter().flat_map(|m| m.items()) {
            match item {
                MethodItem::Method(m) => {
                    if methods.is_empty() {
                        derived = false;
                    }
                    match self.method(scope, &m, &term) {
                        Some(method) => methods.push(method),
                        None => whole = false,
                    }
                }
                MethodItem::Reads(r) => reads.extend(self.paths(scope, r.paths())),
                MethodItem::Derived(_) => derived = true,
            }
        }
        if !whole {
            return;
        }
        let Heading { name, doc, strength, origin } = heading;
        self.document.classes[scope.class()].constraints.push(Constraint {
            name,
            doc: doc.into(),
            rule: Rc::new(term),
            strength,
            methods,
            derived,
            reads,
            within: within.map(Box::new),
            origin,
        });
    }

    /// Lowers a rule; in a branch of a condition a part may stand for its own constraints.
    fn rule(&mut self, scope: &Scope, rule: &Rule, standing: Standing) -> Option<Term> {
        match rule {
            Rule::Holds(rule) => {
                let (term, kind) = self.expr(scope, rule)?;
                let is_part = standing == Standing::InBranch
                    && matches!(kind, Kind::Thing(_))
                    && term.path().is_some_and(|p| !p.is_empty());
                if is_part || kind.fits(&Kind::Bool, &self.document) {
                    return Some(term);
                }
                let message =
                    format!("a rule is true or false, this is {}", kind.words(&self.document));
                let place = Place { file: scope.file, span: rule.span() };
                let d = Diagnostic::error("not-a-rule", place, message);
                self.report_whole(d.hint("write an equation, `a = b`"));
                None
            }
            Rule::If(rule) => {
                let condition = self.expr_of(scope, &rule.condition()?, &Kind::Bool);
                let then: Vec<Rule> =
                    rule.then_rules().into_iter().flat_map(|b| b.rules()).collect();
                let then = self.branch(scope, &then);
                let otherwise = self.branch(scope, &rule.else_rules());
                Some(Term::If(Box::new(condition?), Box::new(then?), Box::new(otherwise?)))
            }
        }
    }

    /// Lowers the rules of a branch to one that says all of them; no rule is always true.
    fn branch(&mut self, scope: &Scope, rules: &[Rule]) -> Option<Term> {
        let terms: Vec<Option<Term>> =
            rules.iter().map(|r| self.rule(scope, r, Standing::InBranch)).collect();
        let terms: Option<Vec<Term>> = terms.into_iter().collect();
        let both = |a, b| Term::Binary(BinaryOperator::And, Box::new(a), Box::new(b));
        Some(terms?.into_iter().reduce(both).unwrap_or(Term::Bool(true)))
    }

    /// Lowers what follows `within`: a number that measures what the sides of the rule do, or a percentage of them.
    pub(crate) fn tolerance(&mut self, scope: &Scope, rule: &Expr, e: &Expr) -> Option<Term> {
        if let Expr::Unary(negated) = e
            && negated.op() == Some(UnaryOp::Negate)
            && matches!(negated.operand(), Some(Expr::Number(_)))
        {
            let place = Place { file: scope.file, span: e.span() };
            let message = format!("{} is no tolerance, wanted 0 or more", e.syntax().text());
            let d = Diagnostic::error("negative-tolerance", place, message);
            self.report(d.hint("say how far the sides may differ, either way: `within 0.1`"));
            return None;
        }
        if matches!(e, Expr::Number(n) if n.unit().is_some_and(|unit| unit.text() == "%")) {
            return self.expr_of(scope, e, &Kind::Number(Some(expr::Dimension::NONE)));
        }
        let side = match rule {
            Expr::Binary(b) => b.left(),
            _ => None,
        };
        self.silent += 1;
        let side = side.and_then(|side| self.expr(scope, &side));
        self.silent -= 1;
        let wanted = match side {
            Some((_, Kind::Number(Some(d)))) => Kind::Number(Some(d)),
            _ => Kind::Number(None),
        };
        self.expr_of(scope, e, &wanted)
    }

    /// Says so where a tolerance stands in the midst of its rule, `a within e = b`; returns true if it does.
    pub(crate) fn splits_its_rule(
        &mut self,
        scope: &Scope,
        rule: &Expr,
        within: Option<&Expr>,
    ) -> bool {
        let Some(Expr::Binary(rest)) = within else { return false };
        let (Some(op), Some(e), Some(right)) = (rest.op_word(), rest.left(), rest.right()) else {
            return false;
        };
        if rest.op() != Some(BinaryOp::Equal) {
            return false;
        }
        let text = |e: &Expr| e.syntax().to_string().trim().to_string();
        let [rule_text, e, right] = [rule, &e, &right].map(text);
        let said = format!("{rule_text} {} {right} within {e}", op.text());
        let at = Place { file: scope.file, span: rule.span().join(rest.span()) };
        let d = Diagnostic::error("value-of-wrong-class", at, "a tolerance stands behind its rule");
        self.report(d.hint(format!("write `{said}`")).fix(format!("write {said}"), [(at, said)]));
        true
    }

    fn method(&mut self, scope: &Scope, m: &ast::Method, rule: &Term) -> Option<Method> {
        let targets: Vec<Expr> = m.targets().collect();
        let mut mentioned = Vec::new();
        mentions(rule, &mut mentioned);
        // a message speaks of everything that its receiver has
        for path in &mut mentioned {
            while !path.is_empty() && self.class_at(scope.class(), path).is_none() {
                path.0.pop();
            }
        }
        let (mut paths, mut kinds) = (Vec::new(), Vec::new());
        for target in &targets {
            let (path, class) = self.path(scope, target)?;
            let named = mentioned.iter().any(|p| p.overlaps(&path));
            if !named && !self.is_merged(scope.class(), &path) {
                let message = format!("the rule does not speak of {path}, which a method writes");
                let place = Place { file: scope.file, span: target.span() };
                let d = Diagnostic::error("method-target-not-in-rule", place, message);
                self.report(d.hint("a method writes parts of its rule, so that the rule holds"));
                return None;
            }
            kinds.push(class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c)));
            paths.push(path);
        }
        let value = m.value()?;
        let parts: Vec<Expr> = match &value {
            Expr::Tuple(tuple) if targets.len() > 1 => tuple.elements().collect(),
            _ => vec![value.clone()],
        };
        if parts.len() != paths.len() {
            let message = format!("{} targets and {} values", paths.len(), parts.len());
            self.error("wrong-arity", scope.file, value.span(), message);
            return None;
        }
        let mut values = Vec::new();
        for (part, kind) in parts.iter().zip(&kinds) {
            values.push(self.expr_of(scope, part, kind)?);
        }
        let origin = self.rule_origin(scope, m.span());
        Some(Method { targets: paths, values, origin })
    }

    /// Returns true if a merge of the class, or above it, may make the path another's as well.
    fn is_merged(&self, class: ClassId, path: &Path) -> bool {
        let lineage = self.document.lineage(class);
        let mut merges = lineage.iter().flat_map(|&c| &self.document.classes[c].merges);
        merges.any(|m| m.paths.iter().any(|p| p.overlaps(path)))
    }
}

/// Lets a path begin at a document instead of at `Me`.
fn from_document(term: Term, document: &Term) -> Term {
    match term {
        Term::Me => document.clone(),
        Term::Send { to, name, arguments, search } => {
            Term::Send { to: Box::new(from_document(*to, document)), name, arguments, search }
        }
        Term::Index(list, at) => Term::Index(Box::new(from_document(*list, document)), at),
        other => other,
    }
}

/// Returns true if a term speaks of the thing that it is read for, or of what that is a part of.
pub(crate) fn speaks_of_me(term: &Term) -> bool {
    let mut found = Vec::new();
    mentions(term, &mut found);
    !found.is_empty()
}

/// Collects the paths of parts and messages that a term speaks of.
pub(crate) fn mentions(term: &Term, found: &mut Vec<Path>) {
    if let Some(path) = term.path() {
        return found.push(path);
    }
    match term {
        Term::Send { to, arguments, .. } => {
            mentions(to, found);
            arguments.iter().for_each(|a| mentions(&a.value, found));
        }
        Term::Call { arguments, .. } | Term::Make { arguments, .. } => {
            arguments.iter().for_each(|a| mentions(&a.value, found));
        }
        Term::Tuple(items) | Term::List(items) | Term::Construct { of: items, .. } => {
            items.iter().for_each(|t| mentions(t, found));
        }
        Term::Range(a, b) | Term::Index(a, b) | Term::Binary(_, a, b) | Term::Let(_, a, b) => {
            mentions(a, found);
            mentions(b, found);
        }
        Term::Unary(_, a)
        | Term::Lambda(_, a)
        | Term::IsA(a, _)
        | Term::Copy(a)
        | Term::OfConstraint { of: a, .. } => {
            mentions(a, found);
        }
        Term::If(a, b, c) => {
            for t in [a, b, c] {
                mentions(t, found);
            }
        }
        Term::Number { .. }
        | Term::Text(_)
        | Term::Bool(_)
        | Term::Option(..)
        | Term::Me
        | Term::Owner
        | Term::Document
        | Term::Local(_)
        | Term::Step(_)
        | Term::Result
        | Term::Class(_)
        | Term::All(_) => {}
    }
}

fn strength(s: ast::Strength) -> Strength {
    match s {
        ast::Strength::Required => Strength::Required,
        ast::Strength::Strong => Strength::Strong,
        ast::Strength::Medium => Strength::Medium,
        ast::Strength::Weak => Strength::Weak,
    }
}
