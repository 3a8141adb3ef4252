//! The language's own functions and messages, opened symbolically.

use crate::evaluate::{Answer, Given, Opening};
use crate::fault::{FaultKind, Trouble};
use crate::meaning::Meaning;
use base::Name;
use expr::dimension::Dimension;
use expr::{Binary, ExprId, Unary};
use kernel::builtin::{FUNCTIONS, Kind, THING_MESSAGES, find};
use kernel::{BinaryOperator, ClassId, ClassKind, Primitive, Vertical};

/// So many numbers are sorted by comparisons in the rule, for which it has about as many squared.
const MOST_SORTED: usize = 32;

impl<'a> Opening<'a> {
    /// Calls a function of the language: `sqrt(x)`, `max(a, b, c)`.
    pub(crate) fn call(&mut self, name: &Name, arguments: &[Given<'a>]) -> Answer<'a> {
        let arguments: Vec<Meaning<'a>> = arguments.iter().map(|a| a.1.clone()).collect();
        if let (Some(operator), [x]) = (unary_named(name), arguments.as_slice()) {
            return self.unary(operator, x);
        }
        match (name.as_str(), arguments.as_slice()) {
            ("pi", []) => Ok(self.number(std::f64::consts::PI)),
            ("upward", []) => Ok(self.number(match self.document.vertical {
                Vertical::Up => 1.0,
                Vertical::Down => -1.0,
            })),
            ("atan2", [y, x]) => self.fold(Binary::Atan2, &[y.clone(), x.clone()]),
            ("ceil", [x]) => self.ceil(x),
            ("hypot", [x, y]) => {
                let squares = [x, y].map(|x| self.binary(BinaryOperator::Multiply, x, x));
                let [x, y] = squares;
                let sum = self.binary(BinaryOperator::Add, &x?, &y?)?;
                self.unary(Unary::Sqrt, &sum)
            }
            ("clamp", [x, low, high]) => {
                let below = self.fold(Binary::Min, &[x.clone(), high.clone()])?;
                self.fold(Binary::Max, &[low.clone(), below])
            }
            ("min" | "max", of) => {
                let operator = if *name == *"min" { Binary::Min } else { Binary::Max };
                match of {
                    [list] if let Ok(items) = self.items(list) => self.fold(operator, &items),
                    numbers => self.fold(operator, numbers),
                }
            }
            ("rgb", of) => Ok(self.opaque(of)),
            // what is measured of a picture follows one way
            (_, of) if find(FUNCTIONS, name).is_some_and(|f| f.result == Kind::Picture) => {
                Ok(self.opaque(of))
            }
            ("allDifferent", [list]) if self.items(list).is_ok() => {
                let items = self.items(list)?;
                self.all_different(&items)
            }
            ("allDifferent", items) => self.all_different(items),
            _ => Err(Trouble::new(
                FaultKind::UnknownName,
                format!("a rule cannot use `{name}` of {} arguments", arguments.len()),
            )),
        }
    }

    /// Sends a message that no class defines: those of numbers, texts and lists.
    pub(crate) fn send_builtin(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Given<'a>],
    ) -> Answer<'a> {
        let arguments: Vec<Meaning<'a>> = arguments.iter().map(|a| a.1.clone()).collect();
        match to {
            Meaning::Number(_) => self.send_number(to, name, &arguments),
            Meaning::Opaque(_) => self.send_opaque(to, &arguments),
            Meaning::List(_) => self.send_list(to, name, &arguments),
            Meaning::Thing(_) if self.items(to).is_ok() => self.send_list(to, name, &arguments),
            Meaning::Thing(_) | Meaning::Made(_) if find(THING_MESSAGES, name).is_some() => {
                self.send_thing(to, name, &arguments)
            }
            Meaning::Thing(t) => {
                let class = self.structure.things[*t].class;
                let class = &self.document.classes[class].name;
                let message = format!("{class} has no part or message `{name}`");
                Err(Trouble::new(FaultKind::UnknownName, message))
            }
            Meaning::Made(made) => {
                let class = &self.document.classes[made.class].name;
                let message = format!("{class} has no part or message `{name}`");
                Err(Trouble::new(FaultKind::UnknownName, message))
            }
            Meaning::Lambda(_) => Err(Trouble::wrong(format!("a function has no `{name}`"))),
            Meaning::Drawn(drawn) => Err(self.missing_step(drawn, name)),
        }
    }

    /// Sends a message to what only the host can compute: the answer speaks of all that the receiver and the arguments
    /// speak of, and of what a function reads beside its elements.
    fn send_opaque(&mut self, to: &Meaning<'a>, arguments: &[Meaning<'a>]) -> Answer<'a> {
        let mut from = vec![to.clone()];
        for argument in arguments {
            from.push(match argument {
                Meaning::Lambda(function) => {
                    let each = vec![self.opaque([to]); function.parameters.len()];
                    self.apply(argument, &each)?
                }
                other => other.clone(),
            });
        }
        Ok(self.opaque(&from))
    }

    /// Sends what every thing knows.
    fn send_thing(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Meaning<'a>],
    ) -> Answer<'a> {
        if *name == *"owner" && arguments.is_empty() {
            return self.owner(to);
        }
        let unknown = || {
            let message = format!("a rule cannot use `{name}` of a thing");
            Err(Trouble::new(FaultKind::UnknownName, message))
        };
        let class = match to {
            Meaning::Thing(t) => self.structure.things[*t].class,
            Meaning::Made(made) => made.class,
            Meaning::Number(_)
            | Meaning::List(_)
            | Meaning::Opaque(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_) => {
                return unknown();
            }
        };
        let document = self.document;
        let fields: Vec<(Name, ClassId)> = document
            .layout(class)
            .into_iter()
            .map(|f| (document.field_name(f).clone(), document.field_class(f)))
            .collect();
        let refers = |c: ClassId| matches!(document.classes[c].kind, ClassKind::Reference(_));
        match (name.as_str(), arguments) {
            ("parts", []) => {
                let own = fields.iter().filter(|(_, c)| !refers(*c));
                let parts: Result<Vec<_>, _> =
                    own.map(|(name, _)| self.send(to, name, &[], None)).collect();
                Ok(Meaning::List(parts?.into()))
            }
            ("made", [parts]) => {
                let parts = self.items(parts)?;
                let mut parts = parts.iter();
                let mut given: Vec<Given<'a>> = Vec::new();
                for (name, class) in fields {
                    let said = if refers(class) { None } else { parts.next() };
                    let part = match said {
                        Some(part) => part.clone(),
                        None => self.send(to, &name, &[], None)?,
                    };
                    given.push((Some(name), part));
                }
                if parts.next().is_some() {
                    let name = &document.classes[class].name;
                    let message = format!("{name} has {} parts, and here are more", given.len());
                    return Err(Trouble::wrong(message));
                }
                self.make(class, &given)
            }
            ("isPlace", []) => {
                let is_length = |c: ClassId| {
                    let length = ClassKind::Primitive(Primitive::Real(Dimension::LENGTH));
                    document.classes[c].kind == length
                };
                let is_value = |(_, c): &(Name, ClassId)| {
                    let kind = &document.classes[*c].kind;
                    matches!(kind, ClassKind::Primitive(_) | ClassKind::Reference(_))
                };
                let is_place = match fields.as_slice() {
                    [(x, a), (y, b), rest @ ..] => {
                        let is_xy = *x == *"x" && *y == *"y" && is_length(*a) && is_length(*b);
                        is_xy && rest.iter().all(is_value)
                    }
                    _ => false,
                };
                Ok(self.number(f64::from(u8::from(is_place))))
            }
            _ => unknown(),
        }
    }

    fn send_number(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Meaning<'a>],
    ) -> Answer<'a> {
        if let (Some(operator), []) = (unary_named(name), arguments) {
            return self.unary(operator, to);
        }
        match (name.as_str(), arguments) {
            ("text" | "decimals" | "shown", _) => Ok(self.opaque(arguments.iter().chain([to]))),
            ("ceil", []) => self.ceil(to),
            ("min", [x]) => self.fold(Binary::Min, &[to.clone(), x.clone()]),
            ("max", [x]) => self.fold(Binary::Max, &[to.clone(), x.clone()]),
            _ => {
                let message = format!("a number has no message `{name}`");
                Err(Trouble::new(FaultKind::UnknownName, message))
            }
        }
    }

    /// The smallest whole number that is not smaller: by `floor`, whose pieces the solver knows.
    fn ceil(&mut self, x: &Meaning<'a>) -> Answer<'a> {
        let negated = self.unary(Unary::Neg, x)?;
        let below = self.unary(Unary::Floor, &negated)?;
        self.unary(Unary::Neg, &below)
    }

    fn send_list(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Meaning<'a>],
    ) -> Answer<'a> {
        if let ("count" | "turns" | "first" | "last", []) = (name.as_str(), arguments) {
            let count = self.count(to)?;
            return match (name.as_str(), count) {
                ("count" | "turns", _) => Ok(self.number(count as f64)),
                (_, 0) => Err(empty(name)),
                ("first", _) => self.item(to, 0),
                _ => self.item(to, count - 1),
            };
        }
        let items = self.items(to)?;
        match (name.as_str(), arguments) {
            ("sum", []) if items.is_empty() => Ok(self.number(0.0)),
            ("sum", []) => self.fold(Binary::Add, &items),
            ("sum", [f]) => {
                let mapped = self.map(&items, f)?;
                self.send_list(&Meaning::List(mapped.into()), name, &[])
            }
            ("min", []) => self.fold(Binary::Min, &items),
            ("max", []) => self.fold(Binary::Max, &items),
            ("mean" | "median" | "sorted", []) if items.is_empty() && *name != *"sorted" => {
                Err(empty(name))
            }
            ("mean", []) => self.mean(&items),
            ("product", []) if items.is_empty() => Ok(self.number(1.0)),
            ("product", []) => self.fold(Binary::Mul, &items),
            ("median" | "sorted", []) => {
                let Some(sorted) = self.sorted(&items)? else {
                    return Ok(self.opaque(items.iter()));
                };
                match name.as_str() {
                    "sorted" => Ok(Meaning::List(sorted.into())),
                    _ => self.mean(&sorted[(sorted.len() - 1) / 2..=sorted.len() / 2]),
                }
            }
            ("map", [f]) => Ok(Meaning::List(self.map(&items, f)?.into())),
            ("filter", [f]) => {
                let mut kept = Vec::new();
                for item in items.iter() {
                    let truth = self.apply(f, std::slice::from_ref(item))?;
                    match self.decided(&truth) {
                        Some(true) => kept.push(item.clone()),
                        Some(false) => {}
                        None => {
                            let message = "a filter that depends on values is not planned yet";
                            return Err(Trouble::not_yet(message));
                        }
                    }
                }
                Ok(Meaning::List(kept.into()))
            }
            ("all", [f]) => {
                let truths = self.map(&items, f)?;
                if truths.is_empty() {
                    Ok(self.number(1.0))
                } else {
                    self.fold(Binary::And, &truths)
                }
            }
            ("any", [f]) => {
                let truths = self.map(&items, f)?;
                if truths.is_empty() {
                    Ok(self.number(0.0))
                } else {
                    self.fold(Binary::Or, &truths)
                }
            }
            // a text is read one way only
            ("join", with) => Ok(self.opaque(items.iter().chain(with))),
            ("zip", [other]) => {
                let others = self.items(other)?;
                Ok(pairs(&items, &others))
            }
            ("neighbours", []) => Ok(pairs(&items, items.get(1..).unwrap_or_default())),
            ("reversed", []) => Ok(Meaning::List(items.iter().rev().cloned().collect())),
            ("union", [other]) => {
                let others = self.items(other)?;
                let mut all: Vec<Meaning<'a>> = Vec::new();
                for item in items.iter().chain(others.iter()) {
                    self.count_term()?;
                    let known = Meaning::List(all.clone().into());
                    let known = self.binary(BinaryOperator::In, item, &known)?;
                    match self.decided(&known) {
                        Some(true) => {}
                        Some(false) => all.push(item.clone()),
                        None => {
                            let message = "a union of numbers depends on what they are: \
                                           it is not planned yet";
                            return Err(Trouble::not_yet(message));
                        }
                    }
                }
                Ok(Meaning::List(all.into()))
            }
            _ => {
                let message = format!("a list has no message `{name}`");
                Err(Trouble::new(FaultKind::UnknownName, message))
            }
        }
    }

    /// Says by an expression that no two of some values are equal.
    pub(crate) fn all_different(&mut self, items: &[Meaning<'a>]) -> Answer<'a> {
        let mut truth = self.number(1.0);
        for (i, a) in items.iter().enumerate() {
            for b in &items[i + 1..] {
                let differ = self.binary(BinaryOperator::NotEqual, a, b)?;
                truth = self.binary(BinaryOperator::And, &truth, &differ)?;
            }
        }
        Ok(truth)
    }

    /// Applies a function to every element.
    pub(crate) fn map(
        &mut self,
        items: &[Meaning<'a>],
        function: &Meaning<'a>,
    ) -> Result<Vec<Meaning<'a>>, Trouble> {
        items.iter().map(|item| self.apply(function, std::slice::from_ref(item))).collect()
    }

    /// Returns the mean of some numbers, not none.
    fn mean(&mut self, items: &[Meaning<'a>]) -> Answer<'a> {
        let sum = self.fold(Binary::Add, items)?;
        let count = self.number(items.len() as f64);
        self.binary(BinaryOperator::Divide, &sum, &count)
    }

    /// Sorts numbers by size: neighbours in the wrong order change places until there are none (odd-even transposition
    /// sort). Returns nothing for many, which are sorted beside the rules.
    fn sorted(&mut self, items: &[Meaning<'a>]) -> Result<Option<Vec<Meaning<'a>>>, Trouble> {
        if items.len() > MOST_SORTED || items.iter().any(|m| matches!(m, Meaning::Opaque(_))) {
            return Ok(None);
        }
        let mut sorted = items.to_vec();
        for round in 0..sorted.len() {
            for at in (round % 2..sorted.len().saturating_sub(1)).step_by(2) {
                let pair = [sorted[at].clone(), sorted[at + 1].clone()];
                sorted[at] = self.fold(Binary::Min, &pair)?;
                sorted[at + 1] = self.fold(Binary::Max, &pair)?;
            }
        }
        Ok(Some(sorted))
    }

    /// Joins numbers from the first to the last.
    fn fold(&mut self, operator: Binary, items: &[Meaning<'a>]) -> Answer<'a> {
        if items.iter().any(|m| matches!(m, Meaning::Opaque(_))) {
            return Ok(self.opaque(items));
        }
        let ids: Result<Vec<ExprId>, _> = items.iter().map(|m| self.expression(m)).collect();
        let join = |a, b| self.arena.binary(operator, a, b);
        base::number::joined(ids?, join).map(Meaning::Number).ok_or_else(|| match operator {
            Binary::Max => empty("max"),
            _ => empty("min"),
        })
    }
}

fn pairs<'a>(a: &[Meaning<'a>], b: &[Meaning<'a>]) -> Meaning<'a> {
    let pair = |(a, b): (&Meaning<'a>, &Meaning<'a>)| Meaning::List([a.clone(), b.clone()].into());
    Meaning::List(a.iter().zip(b).map(pair).collect())
}

fn empty(name: &str) -> Trouble {
    Trouble::wrong(format!("an empty list has no `{name}`"))
}

/// Returns the operation that the language calls by this name.
fn unary_named(name: &str) -> Option<Unary> {
    Some(match name {
        "sqrt" => Unary::Sqrt,
        "abs" => Unary::Abs,
        "sin" => Unary::Sin,
        "cos" => Unary::Cos,
        "tan" => Unary::Tan,
        "asin" => Unary::Asin,
        "acos" => Unary::Acos,
        "atan" => Unary::Atan,
        "exp" => Unary::Exp,
        "ln" => Unary::Ln,
        "log10" => Unary::Log10,
        "log2" => Unary::Log2,
        "sinh" => Unary::Sinh,
        "cosh" => Unary::Cosh,
        "tanh" => Unary::Tanh,
        "asinh" => Unary::Asinh,
        "acosh" => Unary::Acosh,
        "atanh" => Unary::Atanh,
        "cbrt" => Unary::Cbrt,
        "sign" => Unary::Sign,
        "floor" => Unary::Floor,
        "round" => Unary::Round,
        _ => return None,
    })
}
