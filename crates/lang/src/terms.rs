//! Terms: expressions resolved and checked. In: the tree of an expression and its scope. Out: the
//! kernel's term and what it is worth; nothing where it is wrong, which is reported at its place.

use crate::angles::ANGLE;
use crate::functions::spelled;
use crate::hints::{ONE_KIND, unknown_unit};
use crate::kinds::{Kind, measured};
use crate::loops::decided;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place, Span};
use expr::dimension::Dimension;
use kernel::{Argument, BinaryOperator, Term, UnaryOperator};
use syntax::ast::{self, AstNode, BinaryOp, Expr, UnaryOp};

type Lowered = Option<(Term, Kind)>;

/// What a list that is written may hold.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Values of one kind.
    One,
    /// Things, and sets of things beside them: a parameter takes all of these.
    Sets,
}

impl Lowerer<'_> {
    /// Lowers an expression.
    pub(crate) fn expr(&mut self, scope: &Scope, e: &Expr) -> Lowered {
        self.expr_wanting(scope, e, &Kind::Unknown)
    }

    /// Lowers an expression where a kind is wanted: of a choice, its options are known by their names alone.
    pub(crate) fn expr_wanting(&mut self, scope: &Scope, e: &Expr, wanted: &Kind) -> Lowered {
        self.depth += 1;
        let lowered = self.expr_inside(scope, e, wanted);
        self.depth -= 1;
        lowered
    }

    fn expr_inside(&mut self, scope: &Scope, e: &Expr, wanted: &Kind) -> Lowered {
        match e {
            Expr::Number(n) => self.number(scope, n),
            Expr::Text(t) => self.text(scope, t),
            Expr::Bool(b) => Some((Term::Bool(b.value()), Kind::Bool)),
            Expr::Paren(inner) => self.expr_wanting(scope, &inner.inner()?, wanted),
            Expr::Name(n) => match self.option_wanted(scope, &n.name()?, wanted) {
                Some(option) => Some(option),
                None => self.name_wanting(scope, &n.name()?, wanted),
            },
            Expr::Owner(_) => {
                let kind = scope.classes.get(1).map_or(Kind::Unknown, |&c| Kind::Thing(c));
                Some((Term::Owner, kind))
            }
            Expr::Super(s) => {
                let message = "`super` is followed by a message: `super.picture`".to_string();
                self.error("unknown-name", scope.file, s.span(), message);
                None
            }
            Expr::Field(field) => self.field(scope, field),
            Expr::Call(call) => self.call(scope, call),
            Expr::Lambda(lambda) => {
                let (term, _) = self.lambda(scope, lambda, &Kind::Unknown)?;
                Some((term, Kind::Function))
            }
            Expr::Index(index) => self.index(scope, index),
            Expr::Unary(unary) => self.unary(scope, unary),
            Expr::Binary(binary) => {
                let op = binary.op()?;
                let (left, right) = (binary.left()?, binary.right()?);
                let (a, b) = self.both(scope, op, (&left, &right));
                let (a, b) = (a?, b?);
                self.refer_by_position(scope.file, &left, &b.1);
                self.refer_by_position(scope.file, &right, &a.1);
                self.warn_of_misreading(scope, binary);
                if let (BinaryOp::Power, Term::Number { value, .. }) = (op, &b.0) {
                    self.warn_of_uneven_root(scope, &left, (&a.1, *value));
                }
                if op == BinaryOp::Power {
                    self.warn_of_open_power(scope, binary, (&a.1, &b.0));
                }
                if operator_of(op).is_some_and(BinaryOperator::is_comparison) {
                    self.warn_of_bare_angles(scope, &[left, right]);
                }
                self.combine(scope, op, e.span(), a, b)
            }
            Expr::Chain(chain) => self.chain(scope, chain),
            Expr::Range(range) => {
                let a = self.plain(scope, &range.start()?)?;
                let end = self.plain(scope, &range.end()?)?;
                let b = if range.is_open() {
                    Term::Binary(
                        BinaryOperator::Subtract,
                        Box::new(end),
                        Box::new(Term::number(1.0)),
                    )
                } else {
                    end
                };
                let kind = Kind::List(Box::new(Kind::PLAIN));
                Some((Term::Range(Box::new(a), Box::new(b)), kind))
            }
            Expr::If(choice) => self.choice(scope, choice, wanted),
            Expr::Let(bindings) => self.bindings(scope, bindings),
            Expr::List(list) => self.list(scope, list, wanted),
            Expr::Tuple(tuple) => {
                let fields = match wanted {
                    Kind::Thing(class) => crate::kinds::fields(&self.document, *class),
                    _ => Vec::new(),
                };
                let field = |i: usize| fields.get(i).unwrap_or(&Kind::Unknown);
                let elements = tuple.elements().enumerate();
                let items: Option<Vec<(Term, Kind)>> =
                    elements.map(|(i, item)| self.expr_wanting(scope, &item, field(i))).collect();
                let (terms, kinds) = items?.into_iter().unzip();
                Some((Term::Tuple(terms), Kind::Tuple(kinds)))
            }
            Expr::Is(is) => {
                let (of, _) = self.expr(scope, &is.operand()?)?;
                let class = self.class_of_type(scope, &is.class()?)?;
                Some((Term::IsA(Box::new(of), class), Kind::Bool))
            }
            Expr::Copy(copy) => {
                let (of, kind) = self.expr(scope, &copy.operand()?)?;
                Some((Term::Copy(Box::new(of)), kind))
            }
            Expr::All(all) => {
                let class = self.class_of_type(scope, &all.class()?)?;
                let element = Kind::of_class(&self.document, class);
                Some((Term::All(class), Kind::List(Box::new(element))))
            }
        }
    }

    /// Lowers an expression that has to be of a kind; its bare numbers measure what that kind does.
    pub(crate) fn expr_of(&mut self, scope: &Scope, e: &Expr, wanted: &Kind) -> Option<Term> {
        let (term, kind) = self.expr_wanting(scope, e, wanted)?;
        if kind.fits(wanted, &self.document) {
            self.refer_by_position(scope.file, e, wanted);
            return Some(measured(&self.document, term, &kind, wanted));
        }
        self.wrong_kind(scope, e.span(), &kind, wanted);
        None
    }

    /// Lowers a text: its words, and what is said of the values in it, joined.
    fn text(&mut self, scope: &Scope, text: &ast::TextExpr) -> Lowered {
        let mut joined = Vec::new();
        for piece in text.pieces() {
            let term = match piece {
                ast::TextPiece::Words(words) if words.is_empty() => continue,
                ast::TextPiece::Words(words) => Term::Text(words),
                ast::TextPiece::Value(value) => {
                    let (term, kind) = self.expr(scope, &value)?;
                    self.said(scope, &value, (term, &kind))?
                }
            };
            joined.push(term);
        }
        Some((join_texts(joined), Kind::Text))
    }

    /// Makes the text that a value in a text is read as; reports one that is none.
    fn said(&mut self, scope: &Scope, value: &Expr, (term, kind): (Term, &Kind)) -> Option<Term> {
        match kind {
            Kind::Text | Kind::Color => Some(term),
            Kind::Number(_) => {
                let class = self.declared_class(scope, &term);
                let class = class.map(|c| self.document.named_class(c));
                let class = class.map(|c| self.document.classes[c].name.to_string());
                let unit = unit_of_literal(value);
                let is_plain = matches!(kind, Kind::Number(None)) || *kind == Kind::PLAIN;
                let is_angle = class.is_none() && is_plain && self.is_angle(scope, value);
                let class = class.or_else(|| is_angle.then(|| ANGLE.to_string()));
                let class = class.or_else(|| unit.as_ref().map(|_| String::new()));
                let known = class.into_iter().chain(unit).map(Term::Text);
                Some(Term::Send {
                    to: Box::new(term),
                    name: Name::new("shown"),
                    arguments: known.map(|value| Argument { label: None, value }).collect(),
                    search: None,
                })
            }
            Kind::Bool | Kind::Option(_) | Kind::Unknown => Some(Term::send(term, "text")),
            Kind::Thing(_) | Kind::List(_) | Kind::Tuple(_) | Kind::Picture | Kind::Function => {
                let what = kind.words(&self.document);
                let message =
                    format!("found {what} in a text, wanted a number, a text or a truth value");
                let d = Diagnostic::error(
                    "value-of-wrong-class",
                    Place { file: scope.file, span: value.span() },
                    message,
                );
                self.report(self.with_text_hint(d, kind, value));
                None
            }
        }
    }

    fn plain(&mut self, scope: &Scope, e: &Expr) -> Option<Term> {
        self.expr_of(scope, e, &Kind::PLAIN)
    }

    fn number(&mut self, scope: &Scope, n: &ast::NumberExpr) -> Lowered {
        let digits = n.digits()?;
        let (value, dimension) = match n.unit() {
            None => (n.value()?, None),
            Some(unit) => match expr::units::read_quantity(digits.text(), unit.text()) {
                Some((si, d)) => (kernel::quantity::from_si(&self.document, si, d), Some(d)),
                None => {
                    let place = Place { file: scope.file, span: unit.span() };
                    self.report(unknown_unit(place, unit.text()));
                    return None;
                }
            },
        };
        if !value.is_finite() {
            let message = format!("{} is larger than any number can be", digits.text());
            self.error("too-large", scope.file, n.span(), message);
            return None;
        }
        let bare = dimension.is_none();
        if bare {
            self.warn_of_lost_digits(scope, n, value);
        }
        let term = Term::Number { value, dimension: dimension.unwrap_or(Dimension::NONE), bare };
        Some((term, Kind::Number(dimension)))
    }

    fn index(&mut self, scope: &Scope, index: &ast::IndexExpr) -> Lowered {
        let (list, at) = (index.receiver()?, index.index()?);
        let (of, kind) = self.expr(scope, &list)?;
        let element = match kind {
            Kind::List(element) => *element,
            // a row of a list of rows
            Kind::Tuple(items) => {
                let at = self.constant(scope, &at).and_then(|at| usize::try_from(at).ok());
                at.and_then(|at| items.get(at).cloned()).unwrap_or(Kind::Unknown)
            }
            Kind::Unknown => Kind::Unknown,
            other => {
                let message = format!("{} has no elements", other.words(&self.document));
                let place = Place { file: scope.file, span: list.span() };
                let d = Diagnostic::error("value-of-wrong-class", place, message);
                let is_literal = matches!(list, Expr::Number(_));
                let written = (list.syntax().text(), at.syntax().text());
                self.report(match is_literal {
                    true => d.hint(format!(
                        "a unit stands behind its number without brackets: `{} {}`",
                        written.0, written.1
                    )),
                    false if matches!(other, Kind::Text) => {
                        let at = crate::numbers::constant(&|e| self.known_number(scope, e), &at);
                        let of_it = match at {
                            Some(-1.0) => ".last".to_string(),
                            Some(..0.0) => String::new(),
                            _ => format!("[{}]", written.1),
                        };
                        d.hint(format!(
                            "its characters are a list: `{}.characters{of_it}`",
                            written.0
                        ))
                    }
                    false => d,
                });
                return None;
            }
        };
        let mut place = self.plain(scope, &at)?;
        let known = |e: &Expr| self.known_number(scope, e);
        if let Some(i) = crate::numbers::constant(&known, &at) {
            let count = self.count_of(scope, &list);
            self.element_index(scope, i, &at, (&list, count))?;
            place = Term::number(i);
        }
        Some((Term::Index(Box::new(of), Box::new(place)), element))
    }

    /// Checks a constant index; reports one that no list, or not this one with so many elements, has.
    pub(crate) fn element_index(
        &mut self,
        scope: &Scope,
        i: f64,
        at: &Expr,
        (list, count): (&Expr, Option<u32>),
    ) -> Option<u32> {
        if i.fract() != 0.0 || !(0.0..4e9).contains(&i) {
            let place = Place { file: scope.file, span: at.span() };
            let d = Diagnostic::error("index", place, "an index is a whole number, from 0");
            let written = list.syntax().text();
            let is_last = i.total_cmp(&-1.0).is_eq();
            self.report(match is_last {
                true if let Some((turn, at)) = self.turn_of(scope, at) => d.hint(format!(
                    "it is {i} in the turn where {turn} = {at}: let the loop begin at {}",
                    at + 1
                )),
                true => d.hint(format!("the last element is `{written}.last`")),
                false => d,
            });
            return None;
        }
        if let Some(count) = count.filter(|&n| i >= f64::from(n)) {
            self.missing_element(scope, i, at, (list, count));
            return None;
        }
        Some(i as u32)
    }

    /// Reports an index that a list is too short for, and who made it so short.
    fn missing_element(&mut self, scope: &Scope, i: f64, at: &Expr, (list, count): (&Expr, u32)) {
        let name = list.syntax().text();
        let (of, elements) = (
            match count {
                0 => "none".to_string(),
                1 => "[0] alone".to_string(),
                n => format!("[0] to [{}]", n - 1),
            },
            if count == 1 { "element" } else { "elements" },
        );
        let message = format!("{name} has {count} {elements}, {of}: there is no {name}[{i}]");
        let place = Place { file: scope.file, span: at.span() };
        let mut d = Diagnostic::error("index", place, message);
        let asked = self.owner_of(scope, list).and_then(|owner| self.asked_at(owner));
        let through = match scope.turns.is_empty() {
            true => format!(
                "a `for` takes no turn for what is not there: `for i in {i}..{name}.count - 1`"
            ),
            false => format!("let the `for` go to `{name}.count - 1`, or through the list"),
        };
        d = match asked {
            Some(asked) => {
                let text = &self.files[asked.file].text;
                let says = text.get(asked.span.range()).and_then(|t| t.lines().next());
                let says = says.unwrap_or_default().trim_end_matches(['{', ' ']).to_string();
                d.label(asked, "as many as this says")
                    .hint(format!("`{says}` says how many; {through}"))
            }
            None if !scope.turns.is_empty() => d.hint(through),
            None => d,
        };
        self.report(d);
    }

    fn choice(&mut self, scope: &Scope, choice: &ast::IfExpr, wanted: &Kind) -> Lowered {
        let c = self.expr_of(scope, &choice.condition()?, &Kind::Bool)?;
        let holds = decided(&c).filter(|_| !scope.constants.is_empty());
        let a = self.one_branch(scope, &choice.then_value()?, wanted, holds != Some(false));
        let wanted = match &a {
            Some((_, kind @ Kind::Option(_))) => kind.clone(),
            _ => wanted.clone(),
        };
        if holds != Some(false) && a.is_none() {
            return None;
        }
        let b = self.one_branch(scope, &choice.else_value()?, &wanted, holds != Some(true));
        let ((a, kind), (b, other)) = match (holds, a, b) {
            // the other branch need not have a meaning in this turn: `if i = 0 then 0 else xs[i - 1]`
            (Some(true), a, None) => return a,
            (Some(false), None, b) => return b,
            (_, a, b) => (a?, b?),
        };
        if !other.fits(&kind, &self.document) {
            self.unlike_branches(scope, choice, (&kind, &other));
            return None;
        }
        let (a, b) = (
            measured(&self.document, a, &kind, &other),
            measured(&self.document, b, &other, &kind),
        );
        let kind = kind.joined(other);
        let term = match holds {
            Some(true) => a,
            Some(false) => b,
            None => Term::If(Box::new(c), Box::new(a), Box::new(b)),
        };
        Some((term, kind))
    }

    /// Lowers a branch; one that is not taken says of its mistakes those alone that every turn of a loop would make.
    fn one_branch(
        &mut self,
        scope: &Scope,
        value: &Expr,
        wanted: &Kind,
        is_taken: bool,
    ) -> Lowered {
        self.untaken += u32::from(!is_taken);
        let lowered = self.expr_wanting(scope, value, wanted);
        self.untaken -= u32::from(!is_taken);
        lowered
    }

    fn bindings(&mut self, scope: &Scope, bindings: &ast::LetExpr) -> Lowered {
        let mut inner = scope.clone();
        let mut bound = Vec::new();
        for binding in bindings.bindings() {
            let (value, kind) = self.expr(&inner, &binding.value()?)?;
            let name = binding.name()?.name();
            inner.add_local(name.clone(), kind);
            bound.push((name, value));
        }
        let (body, kind) = self.expr(&inner, &bindings.body()?)?;
        let wrap = |body, (name, value)| Term::Let(name, Box::new(value), Box::new(body));
        Some((bound.into_iter().rev().fold(body, wrap), kind))
    }

    fn list(&mut self, scope: &Scope, list: &ast::ListExpr, wanted: &Kind) -> Lowered {
        self.list_of(scope, list, wanted, Holds::One)
    }

    /// Lowers a list that is written; that of an argument may hold things and sets of things.
    pub(crate) fn list_of(
        &mut self,
        scope: &Scope,
        list: &ast::ListExpr,
        wanted: &Kind,
        holds: Holds,
    ) -> Lowered {
        let mut items: Vec<(Term, Kind)> = Vec::new();
        let (mut element, mut is_mixed) = (Kind::Unknown, false);
        let wanted = if let Kind::List(each) = wanted { &**each } else { &Kind::Unknown };
        for item in list.elements() {
            let (term, kind) = self.expr_wanting(scope, &item, wanted)?;
            element = match (kind.fits(&element, &self.document), &element, &kind) {
                (true, ..) => element.joined(kind.clone()),
                // whatever is an object, and what a loop draws beside it
                (false, known, found)
                    if *wanted == Kind::Thing(self.object)
                        && [known, found].into_iter().all(|kind| self.is_object(kind)) =>
                {
                    is_mixed = true;
                    wanted.clone()
                }
                // a contour and a circle cover something together
                (false, Kind::Thing(a), Kind::Thing(b))
                    if crate::kinds::cover_together(&self.document, *a, *b) =>
                {
                    is_mixed = true;
                    element.clone()
                }
                // a line and a circle are curves; which one each is is known when it is looked at
                (false, Kind::Thing(_), Kind::Thing(_)) => {
                    is_mixed = true;
                    self.general(element.clone(), kind.clone())
                }
                // a line and the lines of a pattern are lines, whatever else is in a set beside them
                (false, known, found) if holds == Holds::Sets => {
                    is_mixed = true;
                    match (known.inmost(), found.inmost()) {
                        // what a turn draws is known when it is looked at
                        (Kind::Thing(turn), thing) if self.draws(*turn) => thing.clone(),
                        (thing, Kind::Thing(turn)) if self.draws(*turn) => thing.clone(),
                        (known @ Kind::Thing(_), found @ Kind::Thing(_)) => {
                            self.general(known.clone(), found.clone())
                        }
                        (thing @ Kind::Thing(_), Kind::Unknown)
                        | (Kind::Unknown, thing @ Kind::Thing(_)) => thing.clone(),
                        _ => Kind::Unknown,
                    }
                }
                (false, ..) => Kind::Unknown,
            };
            if element == Kind::Unknown && kind != Kind::Unknown {
                let mut before = items.iter().map(|(_, known)| known);
                let misfit = before.find(|known| !kind.fits(known, &self.document)).cloned();
                self.unlike(scope, item.span(), &kind, misfit.unwrap_or(Kind::Unknown));
                return None;
            }
            items.push((term, kind));
        }
        let document = &self.document;
        let measure = |(term, kind): (Term, Kind)| measured(document, term, &kind, &element);
        let items = items.into_iter().map(measure).collect();
        let each = if is_mixed { Kind::Unknown } else { element };
        Some((Term::List(items), Kind::List(Box::new(each))))
    }

    /// Returns true for a thing, and for the turns of a block of a program.
    fn is_object(&self, kind: &Kind) -> bool {
        match (kind, kind.inmost()) {
            (Kind::Thing(_), _) => true,
            (_, Kind::Thing(turn)) => self.draws(*turn),
            _ => false,
        }
    }

    /// Reports an element of another kind than one before it.
    fn unlike(&mut self, scope: &Scope, span: Span, found: &Kind, other: Kind) {
        let code = code_for(found, &other);
        let list = Kind::List(Box::new(other)).words(&self.document);
        let message = format!("found {} in {list}", found.words(&self.document));
        let d = Diagnostic::error(code, Place { file: scope.file, span }, message);
        self.report(d.hint(ONE_KIND));
    }

    fn unary(&mut self, scope: &Scope, unary: &ast::UnaryExpr) -> Lowered {
        let operand = unary.operand()?;
        let op = unary.op()?;
        if op == UnaryOp::Not {
            let term = self.expr_of(scope, &operand, &Kind::Bool)?;
            return Some((Term::Unary(UnaryOperator::Not, Box::new(term)), Kind::Bool));
        }
        let (term, kind) = self.expr(scope, &operand)?;
        if let (UnaryOp::Negate, Some(made)) = (op, self.negated_by_component(&term, &kind)) {
            return Some(made);
        }
        // `-ring` is the ring turned round
        if let (UnaryOp::Negate, Kind::Thing(class)) = (op, &kind) {
            let reversed = Name::new("reversed");
            if let Some((definer, _)) = self.find_message(*class, &reversed, None) {
                let kind = self.message_kind(definer, &reversed).for_receiver(*class, self.object);
                return Some((Term::send(term, "reversed"), kind));
            }
        }
        if !kind.fits(&Kind::Number(None), &self.document) {
            self.wrong_kind(scope, operand.span(), &kind, &Kind::Number(None));
            return None;
        }
        match (op, term) {
            // negative zero is never stored
            (UnaryOp::Negate, Term::Number { value, dimension, bare }) => {
                Some((Term::Number { value: 0.0 - value, dimension, bare }, kind))
            }
            (UnaryOp::Negate, other) => {
                Some((Term::Unary(UnaryOperator::Negate, Box::new(other)), kind))
            }
            (UnaryOp::Plus | UnaryOp::Not, term) => Some((term, kind)),
        }
    }

    fn chain(&mut self, scope: &Scope, chain: &ast::ChainExpr) -> Lowered {
        let mut terms = Vec::new();
        let mut before = Kind::Unknown;
        for operand in chain.operands() {
            let found = self.expr_wanting(scope, &operand, &before)?;
            before = found.1.clone();
            terms.push((found, operand.span()));
        }
        if chain.ops().all(|(op, _)| op == BinaryOp::NotEqual) {
            self.warn_of_unequals(scope, chain);
        }
        let mut links = Vec::new();
        for ((op, _), pair) in chain.ops().zip(terms.windows(2)) {
            let [(a, from), (b, to)] = pair else { continue };
            let (link, _) = self.combine(scope, op, from.join(*to), a.clone(), b.clone())?;
            links.push(link);
        }
        let both = |a, b| Term::Binary(BinaryOperator::And, Box::new(a), Box::new(b));
        self.warn_of_bare_angles(scope, &chain.operands().collect::<Vec<_>>());
        Some((base::number::joined(links, both)?, Kind::Bool))
    }

    /// Joins two operands, what they measure checked.
    fn combine(
        &mut self,
        scope: &Scope,
        op: BinaryOp,
        span: Span,
        (a, ka): (Term, Kind),
        (b, kb): (Term, Kind),
    ) -> Lowered {
        let Some(operator) = operator_of(op) else {
            return self.combine_sets(scope, op, span, (a, ka), (b, kb));
        };
        let ka = spelled(&a, ka, &kb);
        let kb = spelled(&b, kb, &ka);
        let has_parts = |k: &Kind| matches!(k, Kind::Thing(_) | Kind::Tuple(_));
        if has_parts(&ka) || has_parts(&kb) {
            let made = self.by_component(operator, (&a, &ka), (&b, &kb));
            if made.is_some() {
                return made;
            }
        }
        if ka == Kind::Color || kb == Kind::Color {
            let made = self.of_colours((scope, span), operator, (&a, &ka), (&b, &kb));
            if let Some(made) = made {
                return made;
            }
        }
        let Some(kind) = self.combined_kind(operator, &ka, &kb, &b) else {
            self.refuse_operands(scope, operator, span, &ka, &kb);
            return None;
        };
        // only where both sides measure the same do bare numbers take the other's dimension
        let (a, b) = match operator {
            BinaryOperator::Multiply | BinaryOperator::Divide | BinaryOperator::Power => (a, b),
            _ => (measured(&self.document, a, &ka, &kb), measured(&self.document, b, &kb, &ka)),
        };
        Some((Term::Binary(operator, Box::new(a), Box::new(b)), kind))
    }

    /// Joins two lists or sets: every member of `a` is one of `b`, or the members of both.
    fn combine_sets(
        &mut self,
        scope: &Scope,
        op: BinaryOp,
        span: Span,
        (a, ka): (Term, Kind),
        (b, kb): (Term, Kind),
    ) -> Lowered {
        let set = |k: &Kind| matches!(k, Kind::List(_) | Kind::Unknown);
        if let Some(other) = [&ka, &kb].into_iter().find(|k| !set(k)) {
            let wanted = Kind::List(Box::new(Kind::Unknown));
            self.wrong_kind(scope, span, other, &wanted);
            return None;
        }
        if !ka.fits(&kb, &self.document) {
            self.mismatch(scope, span, None, (&ka, &kb));
            return None;
        }
        let send = |name: &str, value: Term| Term::Send {
            to: Box::new(a.clone()),
            name: Name::new(name),
            arguments: vec![Argument { label: None, value }],
            search: None,
        };
        if op == BinaryOp::Union {
            return Some((send("union", b), ka.joined(kb)));
        }
        // a name that no text can use
        let member = Name::new("(member)");
        let local = Box::new(Term::Local(member.clone()));
        let is_in = Term::Binary(BinaryOperator::In, local, Box::new(b));
        Some((send("all", Term::Lambda(vec![member], Box::new(is_in))), Kind::Bool))
    }

    fn refuse_operands(
        &mut self,
        scope: &Scope,
        operator: BinaryOperator,
        span: Span,
        a: &Kind,
        b: &Kind,
    ) {
        let wanted = match operator {
            BinaryOperator::And | BinaryOperator::Or => Kind::Bool,
            BinaryOperator::Multiply | BinaryOperator::Divide => Kind::Number(None),
            BinaryOperator::Power => Kind::PLAIN,
            _ => return self.mismatch(scope, span, Some(operator), (a, b)),
        };
        let misfit = if a.fits(&wanted, &self.document) { b } else { a };
        self.wrong_kind(scope, span, misfit, &wanted);
    }

    /// Returns what two joined operands are worth; nothing where they do not go together.
    pub(crate) fn combined_kind(
        &self,
        op: BinaryOperator,
        a: &Kind,
        b: &Kind,
        right: &Term,
    ) -> Option<Kind> {
        let number = |k: &Kind| matches!(k, Kind::Number(_) | Kind::Unknown);
        let numbers = number(a) && number(b);
        let text = |k: &Kind| matches!(k, Kind::Text | Kind::Unknown);
        let texts = text(a) && text(b);
        let ordered = |k: &Kind| *k == Kind::Color || text(k);
        let bool = |k: &Kind| matches!(k, Kind::Bool | Kind::Unknown);
        let fit = a.fits(b, &self.document);
        let kind = match op {
            BinaryOperator::Add => {
                (fit && (numbers || texts)).then(|| a.clone().joined(b.clone()))?
            }
            BinaryOperator::Subtract | BinaryOperator::Remainder => {
                (fit && numbers).then(|| a.clone().joined(b.clone()))?
            }
            BinaryOperator::Multiply => numbers.then(|| product(a, b, Dimension::times))?,
            BinaryOperator::Divide => numbers.then(|| product(a, b, Dimension::over))?,
            BinaryOperator::Power => {
                (numbers && b.fits(&Kind::PLAIN, &self.document)).then(|| power(a, right))?
            }
            BinaryOperator::Equal | BinaryOperator::NotEqual => fit.then_some(Kind::Bool)?,
            BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual => {
                (fit && (numbers || ordered(a) && ordered(b))).then_some(Kind::Bool)?
            }
            BinaryOperator::And | BinaryOperator::Or => {
                (bool(a) && bool(b)).then_some(Kind::Bool)?
            }
            BinaryOperator::In => match b {
                Kind::List(element) => a.fits(element, &self.document).then_some(Kind::Bool)?,
                Kind::Unknown => Kind::Bool,
                _ => return None,
            },
        };
        Some(kind)
    }
}

/// Joins texts, one after the other where they are few, else half by half: a long text is no deep term.
fn join_texts(mut texts: Vec<Term>) -> Term {
    const FEW: usize = 64;
    let join = |a, b| Term::Binary(BinaryOperator::Add, Box::new(a), Box::new(b));
    if texts.len() > FEW {
        let end = texts.split_off(texts.len() / 2);
        return join(join_texts(texts), join_texts(end));
    }
    texts.into_iter().reduce(join).unwrap_or_else(|| Term::Text(String::new()))
}

/// Returns what a written operator does in a term; nothing for those of sets, which are sent.
pub fn operator_of(op: BinaryOp) -> Option<BinaryOperator> {
    Some(match op {
        BinaryOp::Or => BinaryOperator::Or,
        BinaryOp::And => BinaryOperator::And,
        BinaryOp::Equal => BinaryOperator::Equal,
        BinaryOp::NotEqual => BinaryOperator::NotEqual,
        BinaryOp::Less => BinaryOperator::Less,
        BinaryOp::LessEqual => BinaryOperator::LessEqual,
        BinaryOp::Greater => BinaryOperator::Greater,
        BinaryOp::GreaterEqual => BinaryOperator::GreaterEqual,
        BinaryOp::In => BinaryOperator::In,
        BinaryOp::Add => BinaryOperator::Add,
        BinaryOp::Subtract => BinaryOperator::Subtract,
        BinaryOp::Multiply => BinaryOperator::Multiply,
        BinaryOp::Divide => BinaryOperator::Divide,
        BinaryOp::Remainder => BinaryOperator::Remainder,
        BinaryOp::Power => BinaryOperator::Power,
        BinaryOp::Subset | BinaryOp::Union => return None,
    })
}

/// Returns the unit of a number that is written with one.
fn unit_of_literal(value: &Expr) -> Option<String> {
    match value {
        Expr::Paren(inner) => unit_of_literal(&inner.inner()?),
        Expr::Unary(unary) => unit_of_literal(&unary.operand()?),
        Expr::Number(number) => {
            let unit = number.unit()?;
            expr::units::unit(unit.text()).map(|_| unit.text().to_string())
        }
        _ => None,
    }
}

/// Returns the code for two kinds that do not go together.
pub(crate) fn code_for(found: &Kind, wanted: &Kind) -> &'static str {
    match (found, wanted) {
        (Kind::Number(_), Kind::Number(_)) => "dimension-mismatch",
        _ => "value-of-wrong-class",
    }
}

/// A product of bare and plain numbers is a bare one: `20 * cos(a)` is a length where one is wanted.
fn product(a: &Kind, b: &Kind, join: fn(Dimension, Dimension) -> Dimension) -> Kind {
    let dimension = |k: &Kind| match k {
        Kind::Number(d) => Some(d.unwrap_or(Dimension::NONE)),
        _ => None,
    };
    let is_bare = |k: &Kind| *k == Kind::Number(None);
    let is_plain = |k: &Kind| is_bare(k) || *k == Kind::PLAIN;
    match (a, b) {
        _ if is_bare(a) && is_plain(b) || is_plain(a) && is_bare(b) => Kind::Number(None),
        _ => match (dimension(a), dimension(b)) {
            (Some(a), Some(b)) => Kind::Number(Some(join(a, b))),
            _ => Kind::Unknown,
        },
    }
}

fn power(base: &Kind, exponent: &Term) -> Kind {
    let Kind::Number(dimension) = base else { return Kind::Unknown };
    let (Some(d), Term::Number { value, .. }) = (dimension, exponent) else {
        let is_plain = dimension.is_none_or(Dimension::is_none);
        return if is_plain { base.clone() } else { Kind::Unknown };
    };
    if d.is_none() {
        return base.clone();
    }
    if value.fract() == 0.0 && value.abs() <= 20.0 {
        return Kind::Number(Some(d.power(*value as i8)));
    }
    let root = (1.0 / value).round();
    let is_root = (1.0 / root - value).abs() < 1e-12 && (2.0..=20.0).contains(&root);
    let rooted = if is_root { d.root(root as i8) } else { None };
    rooted.map_or(Kind::Unknown, |d| Kind::Number(Some(d)))
}
