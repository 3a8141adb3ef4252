//! Hints: what to write instead, where a value, a target or a word is not what can stand there.

pub(crate) mod brackets;
pub(crate) mod lists;
mod units;

pub(crate) use units::{
    comparison_without_and, is_a_unit, product_without_sign, unit_before_equals, unknown_unit,
};

use crate::classes::small_first;
use crate::kinds::{Kind, with_article};
use crate::lower::Lowerer;
use crate::members::is_constant;
use crate::names::LONGEST_WORD;
use crate::numbers::unit_meant;
use crate::scope::Scope;
use crate::terms::code_for;
use base::{Diagnostic, Name, Place, Span};
use expr::dimension::Dimension;
use kernel::{BinaryOperator, Class, ClassId, ClassKind, Document, Message, PartRef, Path};
use syntax::ast::{self, AstNode, BinaryOp, Expr, UnaryOp};
use units::{counted, fraction_of_unit};

/// How a plain number becomes a length of the sheet.
const PLAIN_AS_LENGTH: &str =
    "what is computed of plain numbers alone is none: `1 * cos(a)` is a length where one is wanted";
/// What a list may hold.
pub(crate) const ONE_KIND: &str =
    "the elements of a list are of one kind: keep what is of another beside it";
/// How many names a hint lists.
const MOST_LISTED: usize = 12;
/// How many messages of other classes a hint shows.
pub(crate) const MOST_SHOWN: usize = 3;

impl Lowerer<'_> {
    /// Says of an unknown word that was to be a text, that texts stand in quotes.
    pub(crate) fn hint_value(&mut self, before: usize, wanted: &Kind, value: &Expr) {
        let Expr::Name(name) = value else { return };
        let (Some(word), Kind::Text | Kind::Color) = (name.name(), wanted) else { return };
        let unknown = |d: &&mut Diagnostic| d.code == "unknown-name" && d.place.span == word.span();
        if let Some(d) = self.diagnostics.iter_mut().skip(before).find(unknown) {
            let quoted = format!("\"{}\"", word.text());
            let place = d.place;
            let plain = Diagnostic::error(d.code, place, d.message.clone());
            *d = plain
                .hint(format!("a text stands in quotes: `{quoted}`"))
                .fix(format!("write {quoted}"), [(place, quoted)]);
        }
    }

    /// Says of an unknown name that is given a value, how it is declared, or which names there are.
    pub(crate) fn hint_target(
        &mut self,
        before: usize,
        scope: &Scope,
        target: &Expr,
        value: &Expr,
    ) {
        self.hint_computed(before, target, value);
        let Expr::Name(name) = target else { return };
        let Some(word) = name.name() else { return };
        let unknown = |d: &Diagnostic| d.code == "unknown-name" && d.place.span == word.span();
        let Some(at) = self.diagnostics.iter().skip(before).position(unknown) else { return };
        // it is told here, and not wherever it is used
        self.broken.insert((scope.class(), word.name()));
        // where errors are many, each is told without what was perhaps meant
        if !self.may_guess() {
            return;
        }
        let class = scope.class();
        let names = self.names_of(class);
        let near = self.nearest(word.text(), names.iter().map(String::as_str)).map(str::to_string);
        let of_one = self.document.classes[class].is_of_one || names.is_empty();
        let d = &self.diagnostics[before + at];
        let plain = Diagnostic::error(d.code, d.place, d.message.clone());
        let written = value.syntax().text().to_string();
        let written = written.lines().next().unwrap_or_default();
        // what makes the value elsewhere says how it is made here
        let maker = match value {
            Expr::Call(call) => call
                .name()
                .filter(|maker| !self.is_known(scope, maker))
                .and_then(|maker| called_otherwise(maker.text())),
            _ => None,
        };
        self.diagnostics[before + at] = match near {
            Some(near) => plain.meant(&near),
            None if let Some(hint) = maker => plain.hint(hint),
            None if let Some(part) = self.part_called_otherwise(class, word.text()) => {
                plain.hint(format!("its {} is called {part}: `{part} = {written}`", word.text()))
            }
            None if let Some(part) = self.part_with(class, word.text()) => {
                plain.hint(format!("its {part} has one: `{part}.{} = {written}`", word.text()))
            }
            None if class == self.document.root
                && matches!(value, Expr::Number(_) | Expr::Unary(_))
                && expr::units::unit(word.text())
                    .is_some_and(|u| u.dimension.named().is_some()) =>
            {
                let unit = word.text();
                plain.hint(format!(
                    "declare it with its class: `{unit}: Real = {written}`; a unit stands behind its number: `{written} {unit}`"
                ))
            }
            None if !(is_constant(value) || self.document.classes[class].is_of_one)
                || class == self.document.root
                || of_one && names.is_empty() =>
            {
                let word = word.text();
                plain.hint(match self.class_for(scope, value) {
                    Some(class) => {
                        format!("declare it with its class: `{word}: {class} = {written}`")
                    }
                    None => format!("say what it is computed by: `{word} => {written}`"),
                })
            }
            None if names.len() > MOST_LISTED => {
                plain.hint(format!("there are {}, …", names[..MOST_LISTED].join(", ")))
            }
            None => plain.hint(format!("there are {}", names.join(", "))),
        };
    }

    /// Returns the one part of a class, not of the document itself, whose class has this name: `emf` for the `voltage` of a
    /// battery.
    fn part_called_otherwise(&self, class: ClassId, name: &str) -> Option<Name> {
        let document = &self.document;
        if class == document.root {
            return None;
        }
        let is_it = |of: ClassId| small_first(&document.classes[of].name) == *name;
        let fields = document.layout(class).into_iter();
        let mut alike = fields.filter(|&field| is_it(document.field_class(field)));
        let one = alike.next()?;
        alike.next().is_none().then(|| document.field_name(one).clone())
    }

    /// Says how what is computed of plain numbers becomes a length: the first of them that the document declares is one.
    fn plain_as_length(&self, value: &Expr) -> String {
        let is_plain = |class: ClassId| *self.document.classes[class].name == *"Real";
        let as_length = |word: ast::Word| {
            let class = self.class_of_part(self.document.root, &word.name())?;
            let list = match self.document.classes[class].kind {
                ClassKind::List(element) if is_plain(element) => "List of ",
                _ if is_plain(class) => "",
                _ => return None,
            };
            Some(format!("declare `{}: {list}Length`", word.text()))
        };
        let names = value.syntax().descendants().filter_map(ast::NameExpr::cast);
        match { names }.filter_map(|name| name.name()).find_map(as_length) {
            Some(declared) => {
                format!("what is computed of plain numbers alone is none: {declared}")
            }
            None => PLAIN_AS_LENGTH.into(),
        }
    }

    /// Returns the part of a class, not of the document itself, that has a part of this name.
    pub(crate) fn part_with(&self, class: ClassId, name: &str) -> Option<Name> {
        let document = &self.document;
        let mut fields = document.layout(class).into_iter().filter(|_| class != document.root);
        let has_it = |field: &PartRef| {
            let parts = document.layout(document.field_class(*field));
            parts.into_iter().any(|part| document.field_name(part) == name)
        };
        let found = fields.find(has_it)?;
        Some(document.field_name(found).clone())
    }

    /// Returns true for a name that a class, a message of one or a part has that can be spoken of here.
    fn is_known(&self, scope: &Scope, word: &ast::Word) -> bool {
        let is_it = |m: &Message| m.word() == word.text();
        let has_it = |&class: &ClassId| {
            let line = self.document.lineage(class);
            line.iter().any(|&c| self.document.classes[c].messages.iter().any(is_it))
        };
        self.visible.class(scope.file, word.text()).is_some()
            || scope.classes.iter().any(has_it)
            || !self.messages_by(scope, word, is_it, written).is_empty()
    }

    /// Says how a message of a class is asked, and what it answers.
    pub(crate) fn as_asked(&self, definer: ClassId, name: &Name) -> Option<String> {
        let message = self.defined_message(definer, name)?;
        let word = self.as_called(definer, name)?;
        match message.doc.trim() {
            "" => Some(format!("it is asked as `{word}`")),
            says => Some(format!("`{word}`: {}", says.lines().next()?)),
        }
    }

    /// Returns how a message of a class is written with its parameters.
    pub(crate) fn as_called(&self, definer: ClassId, name: &Name) -> Option<String> {
        let message = self.defined_message(definer, name)?;
        let labelled = message.parameters.iter().map(|p| match p.label == p.name {
            true => p.name.to_string(),
            false => format!("{}: {}", p.label, p.name),
        });
        Some(match labelled.collect::<Vec<_>>() {
            none if none.is_empty() => message.word().to_string(),
            some => format!("{}({})", message.word(), some.join(", ")),
        })
    }

    /// Says of what is computed and is given a value, that it is said by a constraint.
    fn hint_computed(&mut self, before: usize, target: &Expr, value: &Expr) {
        let (file, span) = match self.diagnostics.get(before) {
            Some(d) if d.code == "virtual-part" => (d.place.file, target.span()),
            _ => return,
        };
        let [of, mut written] =
            [target, value].map(|e| e.syntax().text().to_string().trim().to_string());
        if written.contains('\n') {
            return;
        }
        let at = |at: u32| Place { file, span: Span::new(at, at) };
        let mut edits = vec![(at(span.start), "constraint ".to_string())];
        // `a = b < c` would be a chain, `a = b and c` two demands
        if is_looser_than_equation(value) {
            written = format!("({written})");
            let inside = value.span();
            edits.extend([(at(inside.start), "(".to_string()), (at(inside.end), ")".to_string())]);
        }
        let d = &self.diagnostics[before];
        let plain = Diagnostic::error(d.code, d.place, d.message.clone());
        self.diagnostics[before] = plain
            .hint(format!("what it shall be is a constraint: `constraint {of} = {written}`"))
            .fix("write constraint", edits);
    }

    /// Says how a part further out is named, where one of the thing itself has its name and is not what is wanted.
    pub(crate) fn meant_further_out(
        &mut self,
        scope: &Scope,
        value: &Expr,
        wanted: &Kind,
    ) -> Option<String> {
        let Expr::Name(name) = value else { return None };
        let name = name.name()?.name();
        for (at, &class) in scope.classes.iter().enumerate() {
            let kind = self.kind_of_part(class, &name);
            if at > 0 && kind.is_some_and(|kind| kind.fits(wanted, &self.document)) {
                return Some(further_out(&name, at));
            }
        }
        None
    }

    /// Says which part of what is given a thing can be that thing: `a.node = n` for `a = n`.
    pub(crate) fn meant_part_of_it(
        &self,
        path: &Path,
        (found, wanted): (&Kind, &Kind),
        value: &Expr,
    ) -> Option<String> {
        let (Kind::Thing(_), Kind::Thing(class)) = (found, wanted) else { return None };
        let fields = self.document.layout(*class).into_iter();
        let mut fitting = fields.filter(|&field| {
            let kind = Kind::of_class(&self.document, self.document.field_class(field));
            matches!(kind, Kind::Thing(_)) && found.fits(&kind, &self.document)
        });
        let name = self.document.field_name(fitting.next()?);
        let written = value.syntax().text().to_string();
        Some(format!("it has one: `{path}.{name} = {}`", written.trim()))
    }

    /// Returns the class that a new part with this value is likely to be of; nothing where it measures what has no name.
    fn class_for(&mut self, scope: &Scope, value: &Expr) -> Option<String> {
        self.silent += 1;
        let kind = self.expr(scope, value).map(|(_, kind)| kind);
        self.silent -= 1;
        Some(match kind {
            Some(Kind::Number(Some(dimension))) => dimension.named()?.into(),
            Some(Kind::Text) => "Text".into(),
            Some(Kind::Color) => "Color".into(),
            Some(Kind::Bool) => "Bool".into(),
            Some(Kind::Tuple(_)) => "Point".into(),
            Some(Kind::Thing(class) | Kind::Option(class)) => {
                self.document.classes[class].name.to_string()
            }
            Some(Kind::List(_) | Kind::Picture | Kind::Function) => return None,
            Some(Kind::Number(None) | Kind::Unknown) | None => "Real".into(),
        })
    }

    /// Adds what to write instead of a value of another kind, where that can be told.
    pub(crate) fn with_value_hint(
        &self,
        d: Diagnostic,
        (found, wanted): (&Kind, &Kind),
        value: &Expr,
    ) -> Diagnostic {
        let written = value.syntax().text().to_string().trim().to_string();
        let place = d.place;
        match (found, wanted, value) {
            (Kind::Number(_), Kind::Number(Some(dimension)), Expr::Binary(quotient))
                if let Some(number) = fraction_of_unit(quotient, *dimension) =>
            {
                d.hint(format!("a unit belongs to the number before it alone: write `{number}`"))
                    .fix(format!("write {number}"), [(place, number)])
            }
            (Kind::List(_), Kind::List(_), Expr::List(list))
                if let Some(Expr::Range(range)) = list.elements().next() =>
            {
                let range = range.syntax().text().to_string();
                d.hint(format!("a range is a list by itself: `{range}`"))
                    .fix(format!("write {range}"), [(place, range)])
            }
            (Kind::Number(Some(dimension)), Kind::Thing(class), Expr::Number(_)) => {
                let measures = |field: &PartRef| {
                    let of = self.document.field_class(*field);
                    Kind::of_class(&self.document, of) == Kind::Number(Some(*dimension))
                };
                let mut parts = self.document.layout(*class).into_iter().filter(measures);
                match (parts.next(), parts.next()) {
                    (Some(part), None) => {
                        let name = self.document.field_name(part);
                        d.hint(format!(
                            "its parts have their values in a body: `{{ {name} = {written} }}`"
                        ))
                    }
                    _ => d,
                }
            }
            (Kind::Number(_), Kind::Text | Kind::Color, Expr::Number(_) | Expr::Binary(_))
                if matches!(value, Expr::Number(_)) || is_date(&written) =>
            {
                let quoted = format!("\"{written}\"");
                d.hint(format!("a text stands in quotes: `{quoted}`"))
                    .fix(format!("write {quoted}"), [(place, quoted)])
            }
            (Kind::Number(_), Kind::Text, _) => {
                d.hint(format!("put the value into a text: `\"{{{written}}}\"`"))
            }
            (Kind::Text, Kind::Number(_), Expr::Text(text)) => match text.plain() {
                Some(plain) if plain.trim().parse::<f64>().is_ok() => {
                    let plain = plain.trim().to_string();
                    d.hint(format!("a number has no quotes: `{plain}`"))
                        .fix(format!("write {plain}"), [(place, plain)])
                }
                _ => d,
            },
            (Kind::Number(_), Kind::Bool, Expr::Number(_)) => {
                d.hint("a truth value is `true` or `false`")
            }
            (Kind::Text, Kind::Option(choice), Expr::Text(text)) => match text.plain() {
                Some(plain) if self.document.option_named(*choice, &plain).is_some() => d
                    .hint(format!("an option has no quotes: `{plain}`"))
                    .fix(format!("write {plain}"), [(place, plain)]),
                _ => {
                    let options = &self.document.classes[*choice].options;
                    let options: Vec<&str> = options.iter().map(Name::as_str).collect();
                    d.hint(format!("its options are {}", options.join(", ")))
                }
            },
            (Kind::List(_), Kind::Number(_), Expr::Range(_)) => d.hint(between(&written)),
            (Kind::Bool, Kind::Number(_), Expr::Binary(equation))
                if equation.op() == Some(BinaryOp::Equal) =>
            {
                d.hint(format!("one value is given at a time: `{written}` has a line of its own"))
            }
            (Kind::Bool, Kind::Number(_), Expr::Chain(_)) if !written.contains(['<', '>', '!']) => {
                d.hint("one value is given at a time, each in a line of its own")
            }
            (Kind::Number(Some(found)), Kind::Number(Some(wanted)), _)
                if wanted.is_none() && !found.is_none() =>
            {
                d.hint(counted(&self.document, *found, value, &written))
            }
            (Kind::Number(Some(found)), Kind::Number(Some(wanted)), _)
                if let Some(hint) = unit_meant(value, *found, *wanted) =>
            {
                d.hint(hint)
            }
            (Kind::Tuple(items), Kind::Thing(class), _) if self.wants_length(*class, items) => {
                d.hint(self.plain_as_length(value))
            }
            (Kind::List(_), Kind::Thing(_), Expr::List(list)) => {
                let items: Vec<String> =
                    list.elements().map(|e| e.syntax().text().to_string()).collect();
                let round = format!("({})", items.join(", "));
                d.hint(format!("the parts of a thing stand in round brackets: `{round}`"))
                    .fix(format!("write {round}"), [(place, round)])
            }
            _ => d,
        }
    }

    /// Reports a value of one kind where another is wanted.
    pub(crate) fn wrong_kind(&mut self, scope: &Scope, span: Span, found: &Kind, wanted: &Kind) {
        let (found_words, wanted_words) =
            (found.words(&self.document), wanted.words(&self.document));
        let message = format!("found {found_words}, wanted {wanted_words}");
        let place = Place { file: scope.file, span };
        let d = Diagnostic::error(code_for(found, wanted), place, message);
        let range = span.start as usize..span.end as usize;
        let written = self.files[scope.file].text.get(range).unwrap_or_default().trim();
        let is_name = |text: &str| text.chars().all(|c| c.is_alphanumeric() || "_.".contains(c));
        self.report_whole(match (found, wanted) {
            (Kind::List(_), Kind::Number(_)) if is_name(written) => d.hint(format!(
                "one of its elements is `{written}[0]`, what is made of each `{written}.map(x => 2 * x)`"
            )),
            (Kind::Bool, Kind::Number(_)) if written.contains('^') => {
                d.hint("`^` is a power; that just one of two is true is `a != b`")
            }
            (Kind::Bool, Kind::Number(_)) if written.contains('*') => {
                d.hint("that both are true is `a and b`")
            }
            (Kind::Number(Some(_)), Kind::Number(Some(_))) if self.goes_on(place, "..") => d.hint(
                format!("a range is of whole numbers; between two values lies what a rule says: `constraint {written} <= x <= …`"),
            ),
            (Kind::Number(_), Kind::Bool) => {
                d.hint("what is true or false compares, on each side of `or`, too: `x = 3 or x = 4`")
            }
            _ => d,
        });
    }

    /// Says how a plain number that is given for a length becomes one: that of a direction, or another.
    pub(crate) fn plain_for_length(&self, value: &Expr) -> String {
        let mut words =
            value.syntax().descendants_with_tokens().filter_map(syntax::NodeOrToken::into_token);
        if words.any(|token| matches!(token.text(), "cos" | "sin")) {
            return "a direction of plain numbers has no class: `r * (cos(a), sin(a))`".into();
        }
        match self.plain_as_length(value) {
            alone if alone == PLAIN_AS_LENGTH => {
                let written = value.syntax().text().to_string();
                let whole = matches!(value, Expr::Name(_) | Expr::Field(_) | Expr::Call(_));
                let factor = if whole { written } else { format!("({written})") };
                format!("`1 * {factor}` is a length where one is wanted")
            }
            declared => declared,
        }
    }

    /// Returns true if a plain number stands in a tuple where a part of a class is a length.
    fn wants_length(&self, class: ClassId, items: &[Kind]) -> bool {
        let document = &self.document;
        let mut fields = document.layout(class).into_iter().zip(items);
        fields.any(|(field, item)| {
            let wanted = Kind::of_class(document, document.field_class(field));
            *item == Kind::PLAIN && wanted == Kind::LENGTH
        })
    }

    pub(crate) fn mismatch(
        &mut self,
        scope: &Scope,
        span: Span,
        operator: Option<BinaryOperator>,
        (left, right): (&Kind, &Kind),
    ) {
        let (a, b) = (left.words(&self.document), right.words(&self.document));
        let place = Place { file: scope.file, span };
        let apart = match (left, right) {
            (Kind::Thing(left), Kind::Thing(right)) => self.counts_apart(*left, *right),
            _ => None,
        };
        let message = match apart {
            Some((name, left, right)) => {
                format!("left is {a} with {name} = {left}, right is {b} with {name} = {right}")
            }
            None => format!("left is {a}, right is {b}"),
        };
        let mut d = Diagnostic::error(code_for(left, right), place, message);
        let compares = operator.is_some_and(|o| o.is_order() || o == BinaryOperator::Equal);
        match (left, right) {
            (Kind::Text, Kind::Number(_)) | (Kind::Number(_), Kind::Text) if compares => {
                d = d.hint(
                    "the number that a text spells is `text.number`, a number as a text `x.text`",
                );
            }
            (Kind::Text, Kind::Number(_)) | (Kind::Number(_), Kind::Text) => {
                d = d.hint("put the value into the text: `\"x = {x}\"`");
            }
            (Kind::Option(of), Kind::Text) | (Kind::Text, Kind::Option(of)) => {
                let range = span.start as usize..span.end as usize;
                let written = self.files[scope.file].text.get(range).unwrap_or_default();
                let options = &self.document.classes[*of].options;
                let meant = options.iter().find(|o| written.contains(&format!("\"{o}\"")));
                let option = meant.or(options.first()).map(ToString::to_string);
                d = d.hint(format!("an option has no quotes: `{}`", option.unwrap_or_default()));
            }
            (Kind::Bool, Kind::Number(_)) | (Kind::Number(_), Kind::Bool) if !compares => {
                d = d.hint("a number for a truth value is `if b then 1 else 0`");
            }
            _ => {}
        }
        if let (Kind::Text, Kind::Color) | (Kind::Color, Kind::Text) = (left, right) {
            d = d.hint(
                "colours are mixed with colours, `c: Color = \"navy\"`; texts are joined by `\"{a}{b}\"`",
            );
        }
        if let (Kind::List(_), Kind::List(_), Some(BinaryOperator::Add)) = (left, right, operator) {
            d = d.hint("what either list has, each once, is `xs.union(other: ys)`; numbers of two lists are added by `xs.zip(other: ys).map(pair => pair[0] + pair[1])`");
        }
        if let (Kind::List(_), Kind::Number(_), Some(operator)) = (left, right, operator)
            && (operator.is_order() || operator == BinaryOperator::Equal)
        {
            d = d.hint("a rule for each element is a loop: `for x in xs { constraint x > 0 }`");
        }
        if let (Kind::Thing(class), Kind::Tuple(items)) | (Kind::Tuple(items), Kind::Thing(class)) =
            (left, right)
            && self.wants_length(*class, items)
        {
            d = d.hint(PLAIN_AS_LENGTH);
        }
        if (left, right) == (&Kind::Picture, &Kind::Picture) {
            d = d.hint("`picture(a, b)` draws both");
        }
        if let Some(hint) = self.unit_meant_within(place, (left, right)) {
            d = d.hint(hint);
        }
        let is_plain = |k: &Kind| *k == Kind::PLAIN;
        if matches!((left, right), (Kind::Number(_), Kind::Number(_)))
            && is_plain(left) != is_plain(right)
        {
            let (measures, kind) = if is_plain(left) { (b, right) } else { (a, left) };
            let quantity = measures.split(" (").next().unwrap_or_default();
            d = d.hint(match *kind == Kind::LENGTH && !self.document.writes_lengths {
                true => self.plain_side_as_length(place, is_plain(left)),
                false => format!(
                    "a product measures what its factors do: declare one as {quantity}, or give it a unit"
                ),
            });
        }
        self.report(d);
    }

    /// Says which unit was meant in a side of a comparison that measures something else: in `1/4 in`, in `m * 9.81`.
    fn unit_meant_within(&self, place: Place, kinds: (&Kind, &Kind)) -> Option<String> {
        let (Kind::Number(Some(left)), Kind::Number(Some(right))) = kinds else { return None };
        let text = self.files[place.file].text.get(place.span.range())?;
        let Expr::Binary(compared) =
            syntax::parse_expression(place.file, text).file().expression()?
        else {
            return None;
        };
        // two quantities as they are written are not compared: the second one is given to a part
        if let (Some(unit), Some(Expr::Number(_))) =
            (unit_before_equals(&Expr::Binary(compared.clone())), compared.right())
        {
            return Some(is_a_unit(&unit));
        }
        let meant = |side: Option<Expr>, found: Dimension, wanted: Dimension| match side? {
            Expr::Binary(quotient) if let Some(number) = fraction_of_unit(&quotient, wanted) => {
                Some(format!("a unit belongs to the number before it alone: write `{number}`"))
            }
            side => unit_meant(&side, found, wanted),
        };
        meant(compared.right(), *right, *left).or_else(|| meant(compared.left(), *left, *right))
    }

    /// Says how the side of a comparison, the left one or the other, that is made of plain numbers becomes a length.
    fn plain_side_as_length(&self, place: Place, is_left: bool) -> String {
        let text = self.files[place.file].text.get(place.span.range()).unwrap_or_default();
        let compared = syntax::parse_expression(place.file, text).file().expression();
        let side = match compared {
            Some(Expr::Binary(compared)) if is_left => compared.left(),
            Some(Expr::Binary(compared)) => compared.right(),
            _ => None,
        };
        side.map_or_else(|| PLAIN_AS_LENGTH.to_string(), |side| self.plain_as_length(&side))
    }

    /// Reports a part that is called like a message; an element of a list stands in square brackets.
    pub(crate) fn takes_no_arguments(&mut self, scope: &Scope, word: &ast::Word, is_list: bool) {
        let message = format!("{} is a part: it takes no arguments", word.text());
        let place = Place { file: scope.file, span: word.span() };
        let d = Diagnostic::error("wrong-arity", place, message);
        self.report(match is_list {
            true => d.hint(format!("an element stands in square brackets: `{}[0]`", word.text())),
            false => d,
        });
    }

    /// Reports a fault of what stands here, unless the rest of its line was not understood: that was the fault then.
    pub(crate) fn report_whole(&mut self, d: Diagnostic) {
        let Place { file, span } = d.place;
        let follows = |known: &Diagnostic| {
            let between = span.end..known.place.span.start;
            let text = &self.files[file].text;
            known.place.file == file
                && text
                    .get(between.start as usize..between.end as usize)
                    .is_some_and(|t| !t.contains('\n'))
        };
        if !self.diagnostics.iter().any(follows) {
            self.report(d);
        }
    }

    /// Says which things are asked by an unknown name: `angle` of a `Straight`.
    pub(crate) fn asked_elsewhere(&self, scope: &Scope, word: &ast::Word) -> Option<String> {
        let asked = |class: &str, m: &Message| {
            let receiver = small_first(class);
            format!("{}: `{}`", with_article(class), written(&receiver, m))
        };
        let of =
            self.messages_by(scope, word, |m| !m.is_of_class() && m.name == *word.text(), asked);
        (!of.is_empty()).then(|| format!("it is asked of {}", of.join(" or of ")))
    }

    /// Says which classes make what a thing does not answer: `Point.projection(of, onto)`.
    pub(crate) fn made_elsewhere(&self, scope: &Scope, word: &ast::Word) -> Option<String> {
        let made = |class: &str, m: &Message| format!("`{}`", written(class, m));
        let by = |m: &Message| m.is_of_class() && m.word() == word.text();
        let of = self.messages_by(scope, word, by, made);
        (!of.is_empty()).then(|| format!("it is asked of a class: {}", of.join(" or ")))
    }

    /// Returns how the messages that fit are written, of every class in sight, a few of them.
    fn messages_by(
        &self,
        scope: &Scope,
        word: &ast::Word,
        fits: impl Fn(&Message) -> bool,
        shown: impl Fn(&str, &Message) -> String,
    ) -> Vec<String> {
        if !self.may_guess() || word.text().len() > LONGEST_WORD {
            return Vec::new();
        }
        let classes = self.visible.names(scope.file).filter_map(|name| {
            Some((name.as_str(), self.visible.class(scope.file, name.as_str())?))
        });
        let found = classes.flat_map(|(name, class)| {
            let own = self.document.classes[class].messages.iter().filter(|m| fits(m));
            own.map(|m| shown(name, m)).collect::<Vec<_>>()
        });
        found.take(MOST_SHOWN).collect()
    }
}

/// Says which classes there are in the place of one that has no things of its own.
pub(crate) fn instead_of_abstract(document: &Document, class: ClassId) -> String {
    let is_below = |&(id, c): &(ClassId, &Class)| {
        let is_named = !c.is_of_one && !c.name.as_str().is_empty();
        is_named && !c.is_abstract && document.is_a(id, class)
    };
    let below = document.classes.iter().filter(is_below).map(|(_, c)| c.name.as_str());
    let names: Vec<&str> = below.take(MOST_LISTED + 1).collect();
    match names.as_slice() {
        [] if document.program(class).is_some() => {
            "it is for programs and messages, which call it: place one of these".into()
        }
        [] => "declare a class that `is` it, and a part of that class".into(),
        [only] => format!("there is {only}"),
        all if all.len() > MOST_LISTED => format!("there are {}, …", all[..MOST_LISTED].join(", ")),
        all => format!("there are {}", all.join(", ")),
    }
}

/// Returns what to write for a word that other languages have and this one has not.
pub(crate) fn called_otherwise(word: &str) -> Option<&'static str> {
    Some(match word {
        "log" => "write `log10(x)` for the base 10, `ln(x)` for the natural logarithm",
        "lg" => "write `log10(x)`",
        "pow" | "power" => "a power is `x^2`",
        "sqr" | "square" => "a square is `x^2`, its root `sqrt(x)`",
        "fabs" | "magnitude" => "write `abs(x)`",
        "atn" | "arctan" | "arctg" => "write `atan(x)`",
        "tg" => "write `tan(x)`",
        "degrees" | "radians" | "toRadians" => "an angle is in radians; `30 deg` says degrees",
        "even" | "odd" | "isEven" | "is_even" => "a number is even where `n mod 2 = 0`",
        "rect" | "box" => "a box is drawn by `rectangle((0, 0), (3, 2))`, from corner to corner",
        "sum" | "total" => "a sum is `a + b`, of a list `[a, b].sum`",
        "ceiling" => "write `ceil(x)`",
        "trunc" | "int" => "write `floor(x)` or `round(x)`",
        "str" | "String" | "toString" | "repr" => {
            "a number as a text is `x.text`, or stands in one: `\"{x}\"`"
        }
        "equal" | "Equal" => "equal is `=`: `constraint a.length = b.length`",
        "coincident" | "Coincident" => "two points become one by `merge a = b`",
        "integrate" | "integral" => "sum steps: `(0..<n).map(i => …).sum * h`",
        "PI" | "Pi" | "π" => "write `pi`",
        "this" | "self" | "me" => {
            "a part is named by itself: `width`; for the whole thing there is no word, one like it is made of its parts: `Point(x, y)`"
        }
        "null" | "nil" | "none" | "None" | "undefined" | "NaN" => {
            "what nothing is said of is zero, false or empty"
        }
        "True" | "TRUE" | "yes" => "write `true`",
        "False" | "FALSE" | "no" => "write `false`",
        "len" | "length" | "COUNT" | "size" => {
            "how many a list has is `list.count`, a text `text.length`"
        }
        "Σ" | "∑" => "what a list comes to is `list.sum`",
        "math" | "Math" | "np" | "numpy" => "functions stand by themselves: `sqrt(2)`",
        "unknown" | "auto" | "any" => {
            "of what nothing is said the constraints decide: leave the value out"
        }
        "random" | "rand" | "now" | "today" => {
            "a text comes to the same whenever it is read: write the value down"
        }
        "input" | "prompt" => "a value is given in the text, and set in the lab",
        "Number" | "parseFloat" | "parseInt" | "VALUE" => "the number of a text is `text.number`",
        "lambda" => "a function of one argument is `x => 2 * x`",
        "SUM" | "Sum" => "a sum is `a + b`, of a list `[a, b].sum`",
        "AVERAGE" | "average" | "avg" | "mean" | "Mean" => "the mean of a list is `[a, b].mean`",
        "IF" | "iff" | "iif" => "a value is chosen by `if c then a else b`",
        "e" | "E" | "euler" => "Euler's number is `exp(1)`, a power of it `exp(x)`",
        "range" | "Sequence" => "a range is `0..<n`, or `1..n` with its last",
        "translate" | "moved" => "a thing is moved by `c.moved(by: Point(1, 2))`",
        "rotate" => "a set of steps is turned by `steps.turned(about: p, by: 30 deg)`",
        "Midpoint" | "midpoint" => {
            "the point halfway is `a.halfway(to: b)`, that of a line `l.midpoint`"
        }
        "Intersect" | "Intersection" | "intersect" => {
            "two curves meet in `Point.intersection(a, b)`"
        }
        "Slider" => {
            "any given number can be dragged: `n: Real = 5`; its bounds are `constraint 1 <= n <= 10`"
        }
        "Segment" => "a segment is a `Line`: `s: Line = Line(a, b)`",
        "Polygon" => "a polygon is of lines, or a class: `Triangle`, `Rectangle`, `RegularPolygon`",
        _ => return None,
    })
}

/// Says how a range is told as a rule.
fn between(range: &str) -> String {
    let (first, last) = range.split_once("..").unwrap_or_default();
    let (to, last) = match last.strip_prefix('<') {
        Some(last) => ("<", last),
        None => ("<=", last),
    };
    let (first, last) = (first.trim(), last.trim());
    format!("what lies between two values is a rule: `constraint {first} <= x {to} {last}`")
}

/// Returns true for `2026-01-31` and `10/2026`: three numbers, or two with a year, and one sort of sign between them.
pub(crate) fn is_date(written: &str) -> bool {
    let is_of = |sign: char| {
        let fields: Vec<&str> = written.split(sign).collect();
        let is_dated =
            fields.len() == 3 || fields.len() == 2 && fields.iter().any(|f| f.len() == 4);
        is_dated && fields.iter().all(|f| !f.is_empty() && f.bytes().all(|b| b.is_ascii_digit()))
    };
    is_of('-') || is_of('/')
}

/// Returns a message as it is written to what is asked, its arguments by their labels.
fn written(asked: &str, message: &Message) -> String {
    let labels: Vec<&str> = message.parameters.iter().map(|p| p.label.as_str()).collect();
    match labels.is_empty() {
        true => format!("{asked}.{}", message.word()),
        false => format!("{asked}.{}({})", message.word(), labels.join(", ")),
    }
}

/// Returns true for what an equation does not hold together without brackets: comparisons, and what joins these.
fn is_looser_than_equation(value: &Expr) -> bool {
    match value {
        Expr::Chain(_) => true,
        Expr::Unary(unary) => unary.op() == Some(UnaryOp::Not),
        Expr::Binary(binary) => !matches!(
            binary.op(),
            Some(
                BinaryOp::Add
                    | BinaryOp::Subtract
                    | BinaryOp::Union
                    | BinaryOp::Multiply
                    | BinaryOp::Divide
                    | BinaryOp::Remainder
                    | BinaryOp::Power
            )
        ),
        _ => false,
    }
}

/// Says how the part of this name is written that what the thing belongs to has, so many things out.
pub(crate) fn further_out(name: &Name, depth: usize) -> String {
    let outwards = "owner.".repeat(depth);
    format!(
        "`{name}` is a part of the thing itself here: `{outwards}{name}` is that of what it belongs to"
    )
}
