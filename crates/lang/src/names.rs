//! Names: what a word means where it stands, and the nearest that could have been meant.

use crate::hints::MOST_SHOWN;
use crate::kinds::Kind;
use crate::lower::{Lowered, Lowerer, OWN};
use crate::members::{FOR, FOR_AS_VALUE};
use crate::scope::{Constant, Element, Scope};
use base::{Diagnostic, FileId, Name, Place, Span};
use kernel::builtin;
use kernel::{ClassId, ClassKind, Document, PartRef, PartRole, Path, Step, Term};
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, BinaryOp, Expr};

/// Beyond so many diagnostics no nearest name is looked for: each costs a look at every name.
const MOST_GUESSES: usize = 100;

/// The longest word that a nearest one is looked for.
pub(crate) const LONGEST_WORD: usize = 100;

/// How many names a hint lists.
pub(crate) const MOST_LISTED: usize = 12;

impl Lowerer<'_> {
    /// Resolves a bare name.
    pub(crate) fn name(&mut self, scope: &Scope, word: &ast::Word) -> Option<(Term, Kind)> {
        let name = word.name();
        if let Some(kind) = scope.local(&name) {
            return Some((Term::Local(name), kind.clone()));
        }
        if let Some(element) = scope.element(&name) {
            let kind = self.kind_of_element(scope, element);
            return Some((Term::at(Term::Me, &scope.path_to(element)), kind));
        }
        match scope.constants.get(&name) {
            Some(Constant::Whole(i)) => {
                return Some((Term::number(*i as f64), Kind::Number(None)));
            }
            Some(Constant::Value(value, kind)) => return Some((value.clone(), kind.clone())),
            None => {}
        }
        if scope.is_program && self.is_step_elsewhere(scope, word) {
            return None;
        }
        for (class, me) in owners(scope).into_iter().skip(scope.passed_over(&name)) {
            if let Some(kind) = self.kind_of_part(class, &name) {
                let takes = self.find_message(class, &name, None);
                let takes = takes.map_or(0, |(_, m)| m.parameters.len());
                if takes > 0 && self.class_of_part(class, &name).is_none() {
                    let message = format!("{name} is a message that takes {}", arguments(takes));
                    self.error("wrong-arity", scope.file, word.span(), message);
                    return None;
                }
                self.refer(Place { file: scope.file, span: word.span() }, &name, class);
                return Some((Term::send(me, &name), kind));
            }
        }
        if let Some(b) = builtin::find(builtin::THING_MESSAGES, &name) {
            let kind = self.builtin_kind(b.result, &Kind::Unknown);
            return Some((Term::send(Term::Me, &name), kind));
        }
        if let Some(b) = builtin::find(builtin::FUNCTIONS, &name) {
            return self.bare_function(scope, word, b);
        }
        if let Some(found) = self.option_named(scope, word) {
            return found;
        }
        if let Some(found) = self.constant_of_text(scope, word) {
            return Some(found);
        }
        self.unknown_name(scope, word);
        None
    }

    /// Resolves the name of a constant of the text that a class stands in, or of a text that it uses.
    fn constant_of_text(&mut self, scope: &Scope, word: &ast::Word) -> Option<(Term, Kind)> {
        let name = word.name();
        let (class, things) = self.holder_of_constant(scope.file, &name)?;
        let kind = self.kind_of_part(class, &name)?;
        self.refer(Place { file: scope.file, span: word.span() }, &name, class);
        Some((Term::send(Term::at(Term::Document, &things), &name), kind))
    }

    /// Returns the class of the things at the top of a text, and where they are, if they have a constant of this name.
    pub(crate) fn holder_of_constant(&self, file: FileId, name: &Name) -> Option<(ClassId, Path)> {
        let (class, things) = self.top_of(file)?;
        let leads_there =
            || self.file_things.values().any(|p| *p == things.then(Step::Part(name.clone())));
        let is_one = self.constants.contains(&(class, name.clone())) || leads_there();
        is_one.then_some((class, things))
    }

    /// Returns the class of the things at the top of a text, and where they are in the document.
    fn top_of(&self, file: FileId) -> Option<(ClassId, Path)> {
        let things = match file {
            OWN => Path::default(),
            _ => self.file_things.get(&file)?.clone(),
        };
        Some((self.class_at(self.document.root, &things)?, things))
    }

    /// Returns the class that is declared for the part or message that a term names, if it names one.
    pub(crate) fn declared_class(&self, scope: &Scope, term: &Term) -> Option<ClassId> {
        if *term == Term::Document {
            return Some(self.document.root);
        }
        if let Some((class, _)) = owners(scope).into_iter().find(|(_, me)| me == term) {
            return Some(class);
        }
        match term {
            Term::Send { to, name, search: None, .. } => {
                let of = self.declared_class(scope, to)?;
                let part = self.class_of_part(of, name);
                part.or_else(|| self.find_message(of, name, None)?.1.class)
            }
            Term::Index(list, _) => {
                let list = self.declared_class(scope, list)?;
                class_at(&self.document, list, &Path(vec![Step::Last]))
            }
            _ => None,
        }
    }

    /// Resolves the name of a function without brackets: `pi` is what it answers, `sqrt` is an error.
    fn bare_function(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
        b: &builtin::Builtin<builtin::Function>,
    ) -> Option<(Term, Kind)> {
        let name = word.name();
        if b.parameters.is_empty() {
            let kind = self.builtin_kind(b.result, &Kind::Unknown);
            return Some((Term::Call { name, arguments: Vec::new() }, kind));
        }
        // a part of this name, which has an error of its own
        if scope.classes.iter().any(|&class| self.is_broken(class, &name)) {
            return None;
        }
        let takes: Vec<&str> = b.parameters.iter().map(|p| p.label).collect();
        let message = format!("{name} is a function: `{name}({})`", takes.join(", "));
        let place = Place { file: scope.file, span: word.span() };
        let d = Diagnostic::error("wrong-arity", place, message);
        if let Some((operands, rest)) = self.operands_behind(place) {
            // what stands behind it was told as what begins no member
            let is_it = |d: &Diagnostic| d.code == "expected-member" && d.place.span.start == rest;
            self.diagnostics.retain(|d| !(d.place.file == place.file && is_it(d)));
            self.report(d.hint(format!("write `{name}({})`", operands.join(", "))));
            return None;
        }
        self.report(match per_unit(word) {
            Some(hint) => d.hint(hint),
            None => d,
        });
        None
    }

    /// Returns the names and numbers that stand behind a word without brackets, and where they begin: `max a b`.
    fn operands_behind(&self, place: Place) -> Option<(Vec<String>, u32)> {
        let rest = self.files[place.file].text.get(place.span.end as usize..)?;
        let line = rest.lines().next()?;
        let is_operand = |word: &&str| {
            word.chars().all(|c| c.is_alphanumeric() || "_.^".contains(c))
                && !matches!(*word, "then" | "else" | "and" | "or" | "in" | "is" | "mod")
        };
        let operands: Vec<String> = line
            .split(' ')
            .filter(|w| !w.is_empty())
            .take_while(is_operand)
            .map(Into::into)
            .collect();
        let spaces = line.len() - line.trim_start_matches(' ').len();
        let start = place.span.end + u32::try_from(spaces).ok()?;
        (!operands.is_empty()).then_some((operands, start))
    }

    /// Returns the class of what a variable of `for` stands for, or of what is declared in a loop.
    pub(crate) fn class_of_variable(&self, scope: &Scope, element: &Element) -> Option<ClassId> {
        let home = scope.classes.len().checked_sub(element.depth);
        element.class.or_else(|| self.class_at(*scope.classes.get(home?)?, &element.path))
    }

    fn kind_of_element(&mut self, scope: &Scope, element: &Element) -> Kind {
        if let Some(class) = self.class_of_variable(scope, element) {
            return Kind::of_class(&self.document, class);
        }
        // a message: it answers a list, in which this turn has its place
        let home = scope.classes.len().checked_sub(element.depth);
        let home = home.and_then(|at| scope.classes.get(at).copied());
        let Some((class, Step::Part(name))) = home.zip(element.path.0.first().cloned()) else {
            return Kind::Unknown;
        };
        let mut kind = self.kind_of_part(class, &name).unwrap_or(Kind::Unknown);
        for _ in 1..element.path.0.len() {
            kind = if let Kind::List(of) = kind { *of } else { Kind::Unknown };
        }
        kind
    }

    /// Returns true for a name whose own declaration is wrong, and says so.
    fn is_broken(&self, class: ClassId, name: &Name) -> bool {
        let broken = |&c: &ClassId| self.broken.contains(&(c, name.clone()));
        !self.broken.is_empty() && self.document.lineage(class).iter().any(broken)
    }

    #[cold]
    #[inline(never)]
    pub(crate) fn unknown_name(&mut self, scope: &Scope, word: &ast::Word) {
        if scope.classes.iter().any(|&class| self.is_broken(class, &word.name())) {
            return;
        }
        let place = Place { file: scope.file, span: word.span() };
        // behind a name without its colon, or before a text, `f"…"`, it is told already
        if ["expected-colon", "expected-member"]
            .iter()
            .any(|code| self.said.contains(&(place, code)))
        {
            return;
        }
        if crate::hints::brackets::is_in_unread(word) {
            return;
        }
        if word.text() == FOR {
            let d = Diagnostic::error("for-as-value", place, "a `for` is no value");
            return self.report(d.hint(FOR_AS_VALUE));
        }
        let message = format!("there is nothing called {} here", word.text());
        let mut d = Diagnostic::error("unknown-name", place, message);
        if let Some(class) = self.visible.class(scope.file, word.text()) {
            let (name, class) = (word.text(), &self.document.classes[class]);
            d = d.hint(match class.options.first() {
                Some(option) => format!("it is a choice: `{name}.{option}` is one of its options"),
                None if self.goes_on(place, "{") => {
                    format!("it is a class: a body stands right after it, `name: {name} {{ … }}`")
                }
                None => format!("it is a class: `{name}(…)` makes a thing of it"),
            });
        } else if is_label(word) {
            d = d.hint(format!("a label is followed by a colon: `{}: …`", word.text()));
        } else if let Some(hint) = crate::hints::brackets::index_of_sum(word) {
            d = d.hint(hint);
        } else if let Some(hint) = number_of_turn(word)
            && self.near_own(scope, word.text()).is_none()
        {
            d = d.hint(hint);
        } else if let Some(unit) = self.unit_below(place, word.text()) {
            d = d.meant(&unit);
        } else if let Some(power) = raised(word.text()).or_else(|| raised_below(word)) {
            let is_unit = expr::units::unit(&power).is_some();
            let hint = match unit_above(word).filter(|_| is_unit) {
                Some(above) => format!("the unit is `{above}/{power}`"),
                None => format!("a power is `{power}`"),
            };
            d = d.hint(hint).fix(format!("write {power}"), [(place, power)]);
        } else if let Some(hint) = per_unit(word).or_else(|| remainder(word)) {
            d = d.hint(hint);
        } else if let Some((brackets, hint)) = bracketed_unit(word) {
            // all of it is one mistake
            let is_told = |known: &Diagnostic| {
                known.code == "unknown-name"
                    && known.place.file == scope.file
                    && brackets.join(known.place.span) == brackets
            };
            if self.diagnostics.iter().any(is_told) {
                return;
            }
            d = d.hint(hint);
        } else if let Some(hint) = self.known_elsewhere(scope, word) {
            d = d.hint(hint);
        } else if let Some(hint) = crate::hints::called_otherwise(word.text()) {
            // a name of its own that is written almost so is meant before a word of another language
            d = match self.near_own(scope, word.text()) {
                Some(near) => d.meant(&near),
                None => d.hint(hint),
            };
        } else if self.may_guess() {
            let functions = builtin::FUNCTIONS.iter().map(|b| b.name.to_string());
            let classes = self.visible.names(scope.file).map(ToString::to_string);
            let names = self.own_names(scope).chain(functions).chain(classes);
            let names: Vec<String> = names.collect();
            let is_unit = expr::units::unit(word.text()).is_some();
            d = match self.nearest(word.text(), names.iter().map(String::as_str)) {
                Some(near) => d.meant(near),
                None if is_unit => {
                    let unit = word.text();
                    d.hint(format!(
                        "as a unit it stands right after a number: `1 {unit}`, `1 N/{unit}`"
                    ))
                }
                None => d,
            };
        }
        self.report(d);
    }

    /// The names that are declared around a place: locals, constants, elements and parts.
    fn own_names<'s>(&'s self, scope: &'s Scope) -> impl Iterator<Item = String> + 's {
        let locals = scope.locals.iter().map(|(n, _)| n.to_string());
        let elements = scope.elements.iter().map(|e| e.name.to_string());
        let constants = scope.constants.keys().map(ToString::to_string).chain(elements);
        let parts = scope.classes.iter().flat_map(|&class| self.names_of(class));
        locals.chain(constants).chain(parts)
    }

    /// Returns the name of these that is written almost as another one.
    fn near_own(&self, scope: &Scope, word: &str) -> Option<String> {
        if !self.may_guess() {
            return None;
        }
        let names: Vec<String> = self.own_names(scope).collect();
        self.nearest(word, names.iter().map(String::as_str)).map(String::from)
    }

    /// Says where a name is known that is not known here: what is asked by it, and what has a part of that name.
    fn known_elsewhere(&self, scope: &Scope, word: &ast::Word) -> Option<String> {
        if !self.may_guess() {
            return None;
        }
        let asked = self.asked_elsewhere(scope, word).or_else(|| self.made_elsewhere(scope, word));
        if asked.is_some() {
            return asked;
        }
        let (name, text) = (word.name(), word.text());
        if let Some(things) = self.library_with(scope, &name) {
            return Some(format!("`{things}` has it: write `{things}.{text}`"));
        }
        if let Some(hint) = self.part_of_things(scope, &name) {
            return Some(hint);
        }
        let (top, _) = self.top_of(scope.file).filter(|(top, _)| !scope.classes.contains(top))?;
        let is_known = self.class_of_part(top, &name).is_some()
            || self.find_message(top, &name, None).is_some();
        is_known.then(|| {
            format!("a class sees its own parts and constants alone: `owner.{text}` asks what its things are part of")
        })
    }

    /// Says which of the things around a place have a part of this name: `belt.total`.
    fn part_of_things(&self, scope: &Scope, name: &Name) -> Option<String> {
        let fields = scope.classes.iter().flat_map(|&class| self.document.layout(class));
        let having = fields.filter_map(|field| {
            let of = self.document.field_class(field);
            let is_thing = self.document.classes[of].kind == ClassKind::Composite;
            let part = (is_thing && self.class_of_part(of, name).is_some())
                .then(|| self.document.field_name(field))?;
            Some(format!("`{part}.{name}`"))
        });
        let having: Vec<String> = having.take(MOST_SHOWN).collect();
        (!having.is_empty())
            .then(|| format!("it is a part of others here: {}", having.join(" or ")))
    }

    /// Returns true if the text goes on with a sign behind a place, on its line.
    pub(crate) fn goes_on(&self, place: Place, sign: &str) -> bool {
        let rest = self.files[place.file].text.get(place.span.end as usize..).unwrap_or_default();
        rest.trim_start_matches([' ', '\t']).starts_with(sign)
    }

    /// Returns the unit that is meant by a word below a unit: `h` in `30 km/hr`.
    fn unit_below(&self, place: Place, word: &str) -> Option<String> {
        let before = self.files[place.file].text.get(..place.span.start as usize)?;
        let above = before.strip_suffix('/')?;
        let unit = above.rsplit(|c: char| !(c.is_alphanumeric() || c == '^')).next()?;
        let number = above.strip_suffix(unit)?.trim_end_matches(' ');
        let is_unit = number.ends_with(|c: char| c.is_ascii_digit())
            && expr::units::read_quantity("1", unit).is_some();
        match expr::units::meant(word).as_slice() {
            [one] if is_unit => Some(one.clone()),
            _ => None,
        }
    }

    /// Returns where the things of a text are that is used and has a part or message of this name.
    fn library_with(&self, scope: &Scope, name: &Name) -> Option<Path> {
        let others = self.file_things.iter().filter(|(file, _)| **file != scope.file);
        let mut others = others.map(|(_, things)| things);
        let has = |things: &&Path| {
            let class = self.class_at(self.document.root, things);
            class.is_some_and(|class| {
                self.class_of_part(class, name).is_some()
                    || self.document.classes[class].messages.iter().any(|m| m.name == *name)
            })
        };
        others.find(has).cloned()
    }

    /// Returns true while errors are reported and few.
    pub(crate) fn may_guess(&self) -> bool {
        self.silent == 0 && self.diagnostics.len() < MOST_GUESSES
    }

    /// Returns the name that was perhaps meant, while errors are few.
    pub(crate) fn nearest<'n>(
        &self,
        found: &str,
        names: impl IntoIterator<Item = &'n str>,
    ) -> Option<&'n str> {
        if !self.may_guess() || found.len() > LONGEST_WORD {
            return None;
        }
        base::diagnostic::nearest(found, names.into_iter().filter(|n| n.len() <= LONGEST_WORD))
    }

    /// Returns the name of a text that is used, where a receiver is its things.
    fn library_in_words(&self, receiver: &Kind) -> Option<String> {
        let Kind::Thing(of) = receiver else { return None };
        let is_it = |things: &&Path| self.class_at(self.document.root, things) == Some(*of);
        self.file_things.values().find(is_it).map(ToString::to_string)
    }

    /// Says that a receiver has no part or message of this name, and which it has.
    pub(crate) fn unknown_part(&mut self, scope: &Scope, receiver: &Kind, word: &ast::Word) {
        if matches!(receiver, Kind::Thing(class) if self.is_broken(*class, &word.name())) {
            return;
        }
        let what = self.library_in_words(receiver).unwrap_or(receiver.words(&self.document));
        let message = format!("{what} has no part or message {}", word.text());
        let place = Place { file: scope.file, span: word.span() };
        let mut d = Diagnostic::error("unknown-part", place, message);
        let names: Vec<String> = match receiver {
            _ if !self.may_guess() => Vec::new(),
            Kind::Thing(class) => self.names_of(*class),
            Kind::Number(_) => builtin::NUMBER_MESSAGES.iter().map(|b| b.name.into()).collect(),
            Kind::Text | Kind::Color => {
                builtin::TEXT_MESSAGES.iter().map(|b| b.name.into()).collect()
            }
            Kind::List(_) | Kind::Tuple(_) => {
                builtin::LIST_MESSAGES.iter().map(|b| b.name.into()).collect()
            }
            Kind::Picture => builtin::PICTURE_MESSAGES.iter().map(|b| b.name.into()).collect(),
            Kind::Bool | Kind::Option(_) => vec!["text".into()],
            Kind::Function | Kind::Unknown => Vec::new(),
        };
        let of_each = match receiver {
            Kind::List(element) => self.is_part_of_each(element, word),
            _ => false,
        };
        let is_list = matches!(receiver, Kind::List(_));
        let made = match receiver {
            Kind::Thing(_) => self.made_elsewhere(scope, word),
            _ => None,
        };
        d = match self.nearest(word.text(), names.iter().map(String::as_str)) {
            _ if let Some(power) = raised(word.text()) => d
                .hint(format!("a power is `{power}`"))
                .fix(format!("write {power}"), [(place, power)]),
            _ if of_each => d.meant(&format!("map(each => each.{})", word.text())),
            _ if is_list && matches!(word.text(), "length" | "size" | "len") => d.meant("count"),
            _ if matches!(word.text(), "toFixed" | "toPrecision") => {
                d.hint("so many decimals are `x.decimals(2)`")
            }
            _ if matches!(word.text(), "toString" | "str") => d.meant("text"),
            _ if matches!(word.text(), "rotated" | "rotate")
                && names.iter().any(|name| name.starts_with("turned")) =>
            {
                d.hint("what is turned is another: `turned(about: p, by: 90 deg)`")
            }
            _ if matches!(word.text(), "on" | "isOn" | "liesOn" | "lies" | "incident") => {
                d.hint("a curve says what lies on it: `l.passes(through: p)`")
            }
            _ if matches!(receiver, Kind::Tuple(_)) && matches!(word.text(), "x" | "y") => {
                d.hint(format!("say of what class it is: `Point(…).{}`", word.text()))
            }
            _ if matches!(word.text(), "copy" | "clone") => d.hint("write `copy of thing`"),
            _ if is_list && matches!(word.text(), "average" | "avg") => d.meant("mean"),
            _ if is_list && matches!(word.text(), "contains" | "has" | "includes") => {
                d.hint("whether something is in a list is asked by `x in xs`")
            }
            _ if is_list && matches!(word.text(), "append" | "add" | "push" | "concat") => d.hint(
                "a list with more is another: `xs.union(other: [x])` has what either has, once",
            ),
            Some(near) => d.meant(near),
            None if let Some(made) = made => d.hint(made),
            None if let Kind::Thing(class) = receiver
                && let Some(part) = self.part_with(*class, word.text()) =>
            {
                d.hint(format!("its {part} has one: `{part}.{}`", word.text()))
            }
            None if names.is_empty() => d,
            None if names.len() > MOST_LISTED => {
                d.hint(format!("it has {}, …", names[..MOST_LISTED].join(", ")))
            }
            None => d.hint(format!("it has {}", names.join(", "))),
        };
        self.report(d);
    }

    /// Returns true if what a list has none of is a part or message of its elements.
    fn is_part_of_each(&self, element: &Kind, word: &ast::Word) -> bool {
        match element {
            Kind::Thing(class) => self.names_of(*class).iter().any(|n| n == word.text()),
            _ => false,
        }
    }

    /// Returns the names of the parts and messages of a class.
    pub(crate) fn names_of(&self, class: ClassId) -> Vec<String> {
        let document = &self.document;
        let lineage: Vec<ClassId> = document.lineage(class);
        // what every thing answers is not worth a word
        let classes =
            || lineage.iter().map(|&c| &document.classes[c]).filter(|c| !c.supers.is_empty());
        let mut names: Vec<String> = Vec::new();
        for c in classes() {
            let supers = c.supers.iter().filter(|s| !s.name.is_empty());
            names.extend(supers.map(|s| s.name.to_string()));
            names.extend(c.parts.iter().map(|p| p.name.to_string()));
        }
        let messages = classes().flat_map(|c| &c.messages).filter(|m| !m.is_of_class());
        names.extend(messages.map(|m| m.name.to_string()));
        let mut known = std::collections::BTreeSet::new();
        names.retain(|name| known.insert(name.clone()));
        names
    }

    /// Returns the class of the part of this name, seen from a class.
    pub(crate) fn class_of_part(&self, class: ClassId, name: &Name) -> Option<ClassId> {
        let own = |c: ClassId| self.parts.get(&(c, name.clone())).copied();
        find_part(&self.document, class, name, &own)
    }

    /// Returns what the part or message of this name is worth, seen from a class.
    pub(crate) fn kind_of_part(&mut self, class: ClassId, name: &Name) -> Option<Kind> {
        if let Some(part) = self.class_of_part(class, name) {
            return Some(Kind::of_class(&self.document, part));
        }
        let (definer, _) = self.find_message(class, name, None)?;
        Some(self.message_kind(definer, name))
    }

    pub(crate) fn class_at(&self, class: ClassId, path: &Path) -> Option<ClassId> {
        path.0.iter().try_fold(class, |class, step| match step {
            Step::Part(name) => self.class_of_part(class, name),
            Step::Index(_) | Step::Last | Step::Owner => {
                class_at(&self.document, class, &Path(vec![step.clone()]))
            }
        })
    }
}

/// Returns true for the name before the `=` of an argument: `Point(x = 3, y = 4)`.
fn is_label(word: &ast::Word) -> bool {
    let name = word.token.parent();
    let Some(equation) = name.as_ref().and_then(|name| ast::BinaryExpr::cast(name.parent()?))
    else {
        return false;
    };
    let is_left = equation.left().is_some_and(|left| Some(left.syntax()) == name.as_ref());
    let is_argument = equation.syntax().parent().is_some_and(|of| of.kind() == SyntaxKind::Arg);
    is_left && is_argument && equation.op() == Some(BinaryOp::Equal)
}

/// Returns the classes whose parts a bare name may mean, each with the term for its thing.
pub(crate) fn owners(scope: &Scope) -> Vec<(ClassId, Term)> {
    let mut me = Term::Me;
    let mut owners = Vec::new();
    for &class in &scope.classes {
        let outer = if me == Term::Me { Term::Owner } else { Term::send(me.clone(), "owner") };
        owners.push((class, std::mem::replace(&mut me, outer)));
    }
    owners
}

/// Returns the class of the part of this name, seen from a class.
pub(crate) fn class_of_part(document: &Document, class: ClassId, name: &str) -> Option<ClassId> {
    let own = |c: ClassId| document.classes[c].parts.iter().position(|p| *p.name == *name);
    find_part(document, class, name, &own)
}

impl Lowered {
    /// Returns the class of what a path leads to, if that is known.
    pub(crate) fn class_at(&self, class: ClassId, path: &Path) -> Option<ClassId> {
        let document = &self.document;
        path.0.iter().try_fold(class, |class, step| match step {
            Step::Part(name) => {
                let own = |c: ClassId| self.parts.get(&(c, name.clone())).copied();
                find_part(document, class, name, &own)
            }
            Step::Index(_) | Step::Last | Step::Owner => {
                class_at(document, class, &Path(vec![step.clone()]))
            }
        })
    }
}

/// Finds a part: in the primary line, then in each other superclass once, the nearest first.
///
/// `own` returns the index of the part of this name that a class declares itself.
fn find_part(
    document: &Document,
    class: ClassId,
    name: &str,
    own: &dyn Fn(ClassId) -> Option<usize>,
) -> Option<ClassId> {
    // a handful, as a rule
    let mut seen: Vec<ClassId> = Vec::with_capacity(8);
    let mut waiting = vec![referred(document, class)];
    while let Some(class) = waiting.pop() {
        let mut others = Vec::new();
        let mut next = Some(class);
        while let Some(c) = next.filter(|c| !seen.contains(c)) {
            seen.push(c);
            let supers = &document.classes[c].supers;
            if let Some(index) = own(c) {
                let field = PartRef { class: c, index, role: PartRole::Part };
                return Some(referred(document, narrowed(document, class, field)));
            }
            let above = |index: usize| match index {
                0 => supers[0].class,
                _ => {
                    let field = PartRef { class: c, index, role: PartRole::Superclass };
                    narrowed(document, class, field)
                }
            };
            if let Some(index) = supers.iter().position(|s| *s.name == *name) {
                return Some(above(index));
            }
            others.extend((1..supers.len()).map(above));
            next = supers.first().map(|s| s.class);
        }
        waiting.extend(others.into_iter().rev());
    }
    None
}

/// Returns the class of a field of a class's things, where it is refined the narrower one.
fn narrowed(document: &Document, class: ClassId, field: PartRef) -> ClassId {
    let mut at = Some(class);
    while let Some(c) = at {
        let refined = &document.classes[c].refined;
        if let Some((_, narrower)) = refined.iter().find(|(f, _)| *f == field) {
            return *narrower;
        }
        // no class above the one that declares it has heard of it
        at = document.classes[c].supers.first().map(|s| s.class).filter(|_| c != field.class);
    }
    document.field_class(field)
}

/// Returns the class of what a thing of a class names, if it does; else the class itself.
pub(crate) fn referred(document: &Document, class: ClassId) -> ClassId {
    match document.classes[class].kind {
        ClassKind::Reference(to) => referred(document, to),
        ClassKind::Primitive(_) | ClassKind::Composite | ClassKind::List(_) | ClassKind::Set(_) => {
            class
        }
    }
}

/// Returns the class of what a path leads to, if that is known.
pub(crate) fn class_at(document: &Document, class: ClassId, path: &Path) -> Option<ClassId> {
    path.0.iter().try_fold(class, |class, step| match step {
        Step::Part(name) => class_of_part(document, class, name),
        Step::Index(_) | Step::Last => match document.classes[class].kind {
            ClassKind::List(element) => {
                let elements = &document.classes[class].elements;
                let own = match step {
                    Step::Index(i) => elements.get(*i as usize),
                    Step::Last | Step::Part(_) | Step::Owner => elements.last(),
                };
                Some(referred(document, own.copied().unwrap_or(element)))
            }
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => None,
        },
        Step::Owner => None,
    })
}

/// Returns a word that ends in raised digits as a power is written: `x^2` for `x²`.
pub(crate) fn raised(word: &str) -> Option<String> {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let of = word.trim_end_matches(DIGITS);
    let digits = word[of.len()..].chars().filter_map(|c| DIGITS.iter().position(|d| *d == c));
    let exponent: String = digits.map(|digit| digit.to_string()).collect();
    (!of.is_empty() && !exponent.is_empty()).then(|| format!("{of}^{exponent}"))
}

/// Returns `m^3` for the name in `1000 kg/m3`, which stands below a unit.
fn raised_below(word: &ast::Word) -> Option<String> {
    let of = word.text().trim_end_matches(['2', '3', '4']);
    let digits = &word.text()[of.len()..];
    let power = format!("{of}^{digits}");
    let is_one = digits.len() == 1 && expr::units::unit(&power).is_some();
    (is_one && unit_above(word).is_some()).then_some(power)
}

/// Returns the unit of the number that a name divides, as in `9.81 m/s²`.
fn unit_above(word: &ast::Word) -> Option<String> {
    let quotient = ast::BinaryExpr::cast(word.token.parent()?.parent()?)?;
    match (quotient.op(), quotient.left()?) {
        (Some(BinaryOp::Divide), Expr::Number(number)) => Some(number.unit()?.text().to_string()),
        _ => None,
    }
}

/// What a name stands for in other languages, in a loop of so many turns: the number of the turn.
fn number_of_turn(word: &ast::Word) -> Option<String> {
    const COUNTS: [&str; 10] =
        ["i", "j", "k", "n", "turn", "index", "count", "iteration", "round", "step"];
    let name = word.text();
    if !COUNTS.contains(&name) {
        return None;
    }
    let turns = word.token.parent_ancestors().find_map(ast::Repeat::cast)?.times()?;
    let turns = turns.syntax().text();
    Some(format!("a `repeat` counts no turns: `for {name} in 0..<{turns} {{ … }}` does"))
}

/// Says how `5/s` is written where a number is divided by what is a unit and no name.
fn per_unit(word: &ast::Word) -> Option<String> {
    expr::units::unit(word.text())?;
    let name = word.token.parent()?;
    let mut quotient = ast::BinaryExpr::cast(name.parent()?)?;
    let mut unit = word.text().to_string();
    if let (Some(BinaryOp::Power), Expr::Number(power)) = (quotient.op(), quotient.right()?) {
        unit = format!("{unit}^{}", power.digits()?.text());
        quotient = ast::BinaryExpr::cast(quotient.syntax().parent()?)?;
    }
    let (Some(BinaryOp::Divide), Expr::Number(number)) = (quotient.op(), quotient.left()?) else {
        return None;
    };
    let digits = number.digits()?;
    let unit = match number.unit() {
        Some(above) => format!("{}/{unit}", above.text()),
        None => format!("1/{unit}"),
    };
    Some(format!("a unit stands behind its number: `{} {unit}`", digits.text()))
}

/// Says how `0.35 W/(m^2*K)` is written, of a word in its brackets; with where these are.
fn bracketed_unit(word: &ast::Word) -> Option<(Span, String)> {
    let mut around = word.token.parent()?.ancestors();
    let brackets = around.find_map(ast::ParenExpr::cast)?;
    let quotient = ast::BinaryExpr::cast(brackets.syntax().parent()?)?;
    let (Some(BinaryOp::Divide), Expr::Number(number)) = (quotient.op(), quotient.left()?) else {
        return None;
    };
    let (digits, unit) = (number.digits()?, number.unit()?);
    let inner = brackets.inner()?.syntax().text().to_string();
    let below: String = inner.split('*').map(|factor| format!("/{}", factor.trim())).collect();
    let written = format!("{}{below}", unit.text());
    expr::units::read_quantity(digits.text(), &written)?;
    let hint = format!("a unit has no brackets: `{} {written}`", digits.text());
    Some((brackets.span(), hint))
}

/// Says of a remainder that is written as a function that it stands between its numbers.
fn remainder(word: &ast::Word) -> Option<String> {
    if !matches!(word.text(), "mod" | "modulo" | "fmod" | "rem") {
        return None;
    }
    let call = word.token.parent()?.ancestors().find_map(ast::CallExpr::cast)?;
    let factor = |arg: ast::Arg| {
        let written = arg.syntax().text().to_string();
        let whole = arg.value().is_some_and(|e| !matches!(e, Expr::Binary(_)));
        if whole { written } else { format!("({written})") }
    };
    let args: Vec<String> = call.args()?.args().map(factor).collect();
    let [of, by] = args.as_slice() else { return None };
    Some(format!("the remainder is `{of} mod {by}`"))
}

/// Returns a count of arguments in words.
fn arguments(count: usize) -> String {
    if count == 1 { "one argument".into() } else { format!("{count} arguments") }
}
