//! The language's own functions and messages, as `kernel::builtin` lists them.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Given, Result};
use crate::fault::{Fault, FaultKind};
use crate::measure;
use crate::numerals::number_text;
use crate::operate::finite;
use crate::replay::{Binary, Unary};
use base::Name;
use base::number::{decimals, joined, shortest};
use expr::dimension::Dimension;
use kernel::builtin::{
    self, Builtin, Domain, FUNCTIONS, Function, Kind, LIST_MESSAGES, ListMessage, NUMBER_MESSAGES,
    NumberMessage, PICTURE_MESSAGES, TEXT_MESSAGES, THING_MESSAGES, ThingMessage, find,
};
use kernel::{ClassKind, Quantity, ThingId, Vertical};
use std::sync::Arc;

/// More decimals than a number has say nothing.
const MOST_DIGITS: i64 = 17;

impl<'a> Evaluator<'a> {
    /// Calls a function of the language.
    pub(crate) fn call(
        &self,
        name: &Name,
        arguments: &[Given<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let builtin = find(FUNCTIONS, name)
            .ok_or_else(|| Fault::unknown(format!("there is no function `{name}`")))?;
        let arguments = in_place(builtin, arguments)?;
        if builtin.domain != Domain::All {
            within_domain(builtin, self.value_of(self.operand(&arguments[0])?.0))?;
        }
        let plain = |operator| {
            let (x, _) = self.operand(&arguments[0])?;
            finite(self.unary_number(operator, x), Dimension::NONE)
        };
        match builtin.function {
            Function::Sqrt => self.send_number(NumberMessage::Sqrt, &arguments[0], &[]),
            Function::Abs => self.send_number(NumberMessage::Abs, &arguments[0], &[]),
            Function::Floor => self.send_number(NumberMessage::Floor, &arguments[0], &[]),
            Function::Round => self.send_number(NumberMessage::Round, &arguments[0], &[]),
            Function::Ceil => self.send_number(NumberMessage::Ceil, &arguments[0], &[]),
            Function::Sign => self.send_number(NumberMessage::Sign, &arguments[0], &[]),
            Function::Sin => plain(Unary::Sin),
            Function::Cos => plain(Unary::Cos),
            Function::Tan => plain(Unary::Tan),
            Function::Asin => plain(Unary::Asin),
            Function::Acos => plain(Unary::Acos),
            Function::Atan => plain(Unary::Atan),
            Function::Exp => plain(Unary::Exp),
            Function::Ln => plain(Unary::Ln),
            Function::Log10 => plain(Unary::Log10),
            Function::Log2 => plain(Unary::Log2),
            Function::Sinh => plain(Unary::Sinh),
            Function::Cosh => plain(Unary::Cosh),
            Function::Tanh => plain(Unary::Tanh),
            Function::Asinh => plain(Unary::Asinh),
            Function::Acosh => plain(Unary::Acosh),
            Function::Atanh => plain(Unary::Atanh),
            Function::Cbrt => plain(Unary::Cbrt),
            Function::Hypot => {
                let ((x, dx), (y, dy)) =
                    (self.operand(&arguments[0])?, self.operand(&arguments[1])?);
                finite(self.binary_number(Binary::Hypot, x, y), measure::common(dx, dy)?)
            }
            Function::Clamp => {
                let below =
                    self.least(&[arguments[0].clone(), arguments[2].clone()], Binary::Min)?;
                self.least(&[arguments[1].clone(), below], Binary::Max)
            }
            Function::Atan2 => {
                let ((y, dy), (x, dx)) =
                    (self.operand(&arguments[0])?, self.operand(&arguments[1])?);
                measure::common(dy, dx)?;
                Ok(Answer::plain(self.binary_number(Binary::Atan2, y, x)))
            }
            Function::Min => self.least(&self.several(&arguments)?, Binary::Min),
            Function::Max => self.least(&self.several(&arguments)?, Binary::Max),
            Function::Pi => Ok(Answer::plain(std::f64::consts::PI)),
            Function::Upward => Ok(Answer::plain(match self.document.vertical {
                Vertical::Up => 1.0,
                Vertical::Down => -1.0,
            })),
            Function::AllDifferent => self.all_different(&self.several(&arguments)?),
            Function::Rgb => {
                let part = |at: usize| Ok(self.number(&arguments[at])?.0);
                Ok(Answer::text(&drawing::color_of([part(0)?, part(1)?, part(2)?])))
            }
            Function::Dot
            | Function::Segment
            | Function::Polyline
            | Function::Polygon
            | Function::Circle
            | Function::Arc
            | Function::Rectangle
            | Function::Ellipse
            | Function::Spline
            | Function::Bezier
            | Function::Nurbs
            | Function::Region
            | Function::Label
            | Function::Text
            | Function::Picture => self.draw(builtin.function, &arguments, nearest),
        }
    }

    /// Sends a message that no class defines: those of numbers, texts, lists, pictures, all things.
    pub(crate) fn send_builtin(
        &self,
        to: &Answer<'a>,
        name: &Name,
        arguments: &[Given<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        match to {
            Answer::Number(..) => {
                let builtin = self.known(NUMBER_MESSAGES, to, name)?;
                within_domain(builtin, self.value_of(self.operand(to)?.0))?;
                self.send_number(builtin.function, to, &in_place(builtin, arguments)?)
            }
            Answer::Text(text) => {
                let builtin = self.known(TEXT_MESSAGES, to, name)?;
                self.send_text(builtin.function, text, &in_place(builtin, arguments)?)
            }
            Answer::Picture(elements) => {
                let builtin = self.known(PICTURE_MESSAGES, to, name)?;
                let arguments = in_place(builtin, arguments)?;
                match builtin.result {
                    Kind::Picture => self.styled(builtin.function, elements, &arguments),
                    _ => self.measured(builtin.function, elements, &arguments),
                }
            }
            Answer::List(_) => self.send_list(to, name, arguments),
            Answer::Thing(t) => match (find(THING_MESSAGES, name), self.class_kind(*t)) {
                (None, ClassKind::List(_) | ClassKind::Set(_)) => {
                    self.send_list(to, name, arguments)
                }
                _ => {
                    let builtin = self.known(THING_MESSAGES, to, name)?;
                    let arguments = in_place(builtin, arguments)?;
                    self.send_thing(builtin.function, to, &arguments, nearest)
                }
            },
            Answer::Made(_) | Answer::Context(_) => {
                let builtin = self.known(THING_MESSAGES, to, name)?;
                let arguments = in_place(builtin, arguments)?;
                self.send_thing(builtin.function, to, &arguments, nearest)
            }
            Answer::Bool(b) if name == "text" && arguments.is_empty() => {
                Ok(Answer::text(if *b { "true" } else { "false" }))
            }
            Answer::Option(..) if name == "text" && arguments.is_empty() => {
                Ok(Answer::text(&self.option_name(to)))
            }
            Answer::Bool(_) | Answer::Option(..) | Answer::Function(_) => {
                Err(self.unknown(to, name))
            }
        }
    }

    fn known<F>(
        &self,
        table: &'static [Builtin<F>],
        to: &Answer<'a>,
        name: &Name,
    ) -> Result<&'static Builtin<F>> {
        find(table, name).ok_or_else(|| self.unknown(to, name))
    }

    fn unknown(&self, to: &Answer<'a>, name: &Name) -> Fault {
        Fault::unknown(format!("{} has no part or message `{name}`", self.kind(to)))
    }

    fn send_number(
        &self,
        message: NumberMessage,
        to: &Answer<'a>,
        arguments: &[Answer<'a>],
    ) -> Result<Answer<'a>> {
        let (x, dimension) = self.operand(to)?;
        let made = |operator, dimension| finite(self.unary_number(operator, x), dimension);
        match message {
            NumberMessage::Text => {
                let (x, _) = self.number(to)?;
                let digits = arguments.first().map(|d| self.digits(d)).transpose()?;
                let x = x / self.document.scale.factor(dimension);
                Ok(Answer::text(&number_text(x, digits)))
            }
            NumberMessage::Decimals => {
                let (x, _) = self.number(to)?;
                let x = x / self.document.scale.factor(dimension);
                Ok(Answer::text(&decimals(x, self.digits(&arguments[0])?)))
            }
            NumberMessage::Shown => {
                let (x, _) = self.number(to)?;
                let text = |at: usize| match arguments.get(at) {
                    Some(Answer::Text(text)) => &**text,
                    _ => "",
                };
                let quantity = Quantity { dimension, class: text(0), written: text(1) };
                let shown = kernel::show_quantity(x, quantity, self.document);
                Ok(Answer::text(&shown.in_picture()))
            }
            NumberMessage::Sqrt => made(Unary::Sqrt, measure::power(dimension, 0.5)),
            NumberMessage::Abs => made(Unary::Abs, dimension),
            NumberMessage::Ceil => made(Unary::Ceil, dimension),
            NumberMessage::Floor => made(Unary::Floor, dimension),
            NumberMessage::Round => made(Unary::Round, dimension),
            NumberMessage::Sign => made(Unary::Sign, Dimension::NONE),
            NumberMessage::Min => self.least(&[to.clone(), arguments[0].clone()], Binary::Min),
            NumberMessage::Max => self.least(&[to.clone(), arguments[0].clone()], Binary::Max),
        }
    }

    /// Reads how many decimals a text shall have.
    pub(crate) fn digits(&self, answer: &Answer<'a>) -> Result<usize> {
        let digits = self.whole(answer)?;
        if (0..=MOST_DIGITS).contains(&digits) {
            Ok(digits as usize)
        } else {
            let message = format!("{digits} digits, where 0 to {MOST_DIGITS} are possible");
            Err(Fault::no_answer(message))
        }
    }

    fn send_list(
        &self,
        to: &Answer<'a>,
        name: &Name,
        arguments: &[Given<'a>],
    ) -> Result<Answer<'a>> {
        let builtin = self.known(LIST_MESSAGES, to, name)?;
        let arguments = in_place(builtin, arguments)?;
        let items = self.items(to)?;
        let empty = || Fault::no_answer(format!("an empty list has no `{name}`"));
        let holds = |item: &Answer<'a>| {
            let answer = self.apply(&arguments[0], std::slice::from_ref(item))?;
            self.truth_of(&answer)
        };
        match builtin.function {
            ListMessage::Sum => {
                let (terms, dimension) = self.numbers_of(&items)?;
                let add = |x, y| self.binary_number(Binary::Add, x, y);
                finite(joined(terms, add).unwrap_or(0.0), dimension)
            }
            ListMessage::Count | ListMessage::Turns => Ok(Answer::plain(items.len() as f64)),
            ListMessage::Map => {
                let each = |item| self.apply(&arguments[0], std::slice::from_ref(item));
                self.list(items.iter().map(each).collect::<Result<_>>()?)
            }
            ListMessage::Filter => {
                let mut kept = Vec::new();
                for item in items.iter() {
                    if holds(item)? {
                        kept.push(item.clone());
                    }
                }
                Ok(Answer::List(kept.into()))
            }
            ListMessage::First => items.first().cloned().ok_or_else(empty),
            ListMessage::Last => items.last().cloned().ok_or_else(empty),
            ListMessage::All => {
                for item in items.iter() {
                    if !holds(item)? {
                        return Ok(Answer::Bool(false));
                    }
                }
                Ok(Answer::Bool(true))
            }
            ListMessage::Any => {
                for item in items.iter() {
                    if holds(item)? {
                        return Ok(Answer::Bool(true));
                    }
                }
                Ok(Answer::Bool(false))
            }
            ListMessage::Mean => {
                let (numbers, dimension) = self.numbers_of(&items)?;
                self.mean(&numbers, dimension).unwrap_or_else(|| Err(empty()))
            }
            ListMessage::Median => {
                let (mut numbers, dimension) = self.numbers_of(&items)?;
                numbers.sort_by(|x, y| self.order_of(*x, *y));
                let (below, above) = (numbers.len().saturating_sub(1) / 2, numbers.len() / 2);
                let middle = numbers.get(below..=above).unwrap_or_default();
                self.mean(middle, dimension).unwrap_or_else(|| Err(empty()))
            }
            ListMessage::Product => {
                let (numbers, dimension) = self.numbers_of(&items)?;
                if dimension != Dimension::NONE {
                    let message = "a product of a list is of plain numbers";
                    return Err(Fault::new(FaultKind::WrongDimension, message));
                }
                let times = |x, y| self.binary_number(Binary::Multiply, x, y);
                finite(joined(numbers, times).unwrap_or(1.0), Dimension::NONE)
            }
            ListMessage::Sorted if let Some(texts) = sorted_texts(&items) => {
                Ok(Answer::List(texts.into_iter().map(Answer::Text).collect()))
            }
            ListMessage::Sorted => {
                let (mut numbers, dimension) = self.numbers_of(&items)?;
                numbers.sort_by(|x, y| self.order_of(*x, *y));
                let answers = numbers.into_iter().map(|x| Answer::Number(x, dimension));
                Ok(Answer::List(answers.collect()))
            }
            ListMessage::Min => self.least(&items, Binary::Min),
            ListMessage::Max => self.least(&items, Binary::Max),
            ListMessage::Zip => {
                let others = self.items(&arguments[0])?;
                self.list(pairs(&items, &others))
            }
            ListMessage::Neighbours => self.list(pairs(&items, items.get(1..).unwrap_or_default())),
            ListMessage::Union => {
                let mut all = Vec::new();
                for item in items.iter().chain(self.items(&arguments[0])?.iter()) {
                    if !self.is_among(&all, item)? {
                        all.push(item.clone());
                    }
                }
                self.list(all.into())
            }
            ListMessage::Reversed => Ok(Answer::List(items.iter().rev().cloned().collect())),
            ListMessage::Join => self.join(&items, arguments.first()),
        }
    }

    /// Reads numbers of one dimension.
    fn numbers_of(&self, items: &[Answer<'a>]) -> Result<(Vec<f64>, Dimension)> {
        let (mut numbers, mut dimension) = (Vec::new(), Dimension::NONE);
        for item in items {
            let (x, d) = self.operand(item)?;
            dimension = measure::common(dimension, d)?;
            numbers.push(x);
        }
        Ok((numbers, dimension))
    }

    /// Returns the mean of some numbers; nothing where there are none.
    fn mean(&self, numbers: &[f64], dimension: Dimension) -> Option<Result<Answer<'a>>> {
        let add = |x, y| self.binary_number(Binary::Add, x, y);
        let sum = joined(numbers.to_vec(), add)?;
        let mean = self.binary_number(Binary::Divide, sum, numbers.len() as f64);
        Some(finite(mean, dimension))
    }

    fn send_thing(
        &self,
        message: ThingMessage,
        to: &Answer<'a>,
        arguments: &[Answer<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        match (message, to) {
            (ThingMessage::Parts, _) => Ok(Answer::List(self.parts_of(to)?.into())),
            (ThingMessage::Made, _) => self.made_of(to, arguments, nearest),
            (ThingMessage::IsPlace, _) => Ok(Answer::Bool(self.is_place(to))),
            (ThingMessage::Owner, _) => self.owner(to),
            (ThingMessage::Class, _) => {
                let class = self.class_of(to).map(|c| self.document.named_class(c));
                let name = class.map(|c| &self.document.classes[c].name);
                Ok(Answer::text(name.map_or("", |n| n)))
            }
        }
    }

    /// Returns the arguments, or the elements of the one list that stands for them.
    pub(crate) fn several(&self, arguments: &[Answer<'a>]) -> Result<Vec<Answer<'a>>> {
        if let [one] = arguments
            && let Ok(items) = self.items(one)
        {
            return Ok(items.to_vec());
        }
        Ok(arguments.to_vec())
    }

    fn least(&self, items: &[Answer<'a>], of: Binary) -> Result<Answer<'a>> {
        let mut found: Option<(f64, Dimension)> = None;
        for item in items {
            let (x, d) = self.operand(item)?;
            found = Some(match found {
                Some((y, e)) => (self.binary_number(of, y, x), measure::common(e, d)?),
                None => (x, d),
            });
        }
        let (x, d) = found.ok_or_else(|| Fault::no_answer("the extreme of no numbers at all"))?;
        Ok(Answer::Number(x, d))
    }

    fn all_different(&self, items: &[Answer<'a>]) -> Result<Answer<'a>> {
        for (i, a) in items.iter().enumerate() {
            for b in &items[..i] {
                self.burn()?;
                let mut equal = true;
                self.leaves(a, b, &mut |a, b| {
                    equal = equal && self.same_leaf(a, b)?;
                    Ok(())
                })?;
                if equal {
                    return Ok(Answer::Bool(false));
                }
            }
        }
        Ok(Answer::Bool(true))
    }
}

/// Refuses a number for which a function has no answer.
fn within_domain<F>(builtin: &Builtin<F>, x: f64) -> Result<()> {
    match builtin.domain.words() {
        Some(wanted) if !builtin.domain.holds(x) => {
            let (name, x) = (builtin.name, shortest(x));
            Err(Fault::no_answer(format!("{name}({x}), which is defined where {wanted}")))
        }
        _ => Ok(()),
    }
}

/// Returns the arguments in the order of the parameters.
fn in_place<'a, F>(of: &Builtin<F>, arguments: &[Given<'a>]) -> Result<Vec<Answer<'a>>> {
    if !of.takes(arguments.len()) {
        let n = arguments.len();
        let wanted: Vec<&str> = of.parameters.iter().map(|p| p.label).collect();
        let wanted = if wanted.is_empty() { "nothing".into() } else { wanted.join(", ") };
        let message = format!("`{}` wants {wanted}, and here are {n} arguments", of.name);
        return Err(Fault::wrong(message));
    }
    let mut placed: Vec<Option<Answer<'a>>> = vec![None; arguments.len()];
    for (position, (label, answer)) in arguments.iter().enumerate() {
        let place = match label {
            Some(label) => of.parameters.iter().position(|p| *p.label == ***label),
            None => Some(position),
        };
        let place = place.filter(|place| placed.get(*place).is_none_or(Option::is_none));
        let Some(place) = place else {
            let what = label.map_or("this argument", |l| l);
            return Err(Fault::wrong(format!("`{}` does not take {what}", of.name)));
        };
        placed.resize(placed.len().max(place + 1), None);
        placed[place] = Some(answer.clone());
    }
    let given = |(at, answer): (usize, Option<Answer<'a>>)| match (answer, of.parameters.get(at)) {
        (Some(answer), _) => Ok(answer),
        // a text of which nothing is said is empty
        (None, Some(p)) if p.given == builtin::Given::Perhaps && p.kind == Kind::Text => {
            Ok(Answer::text(""))
        }
        (None, p) => {
            let what = p.map_or("an argument", |p| p.label);
            Err(Fault::wrong(format!("`{}` wants {what}", of.name)))
        }
    };
    placed.into_iter().enumerate().map(given).collect()
}

/// Returns texts in the order of their characters in Unicode; nothing of anything else.
fn sorted_texts(items: &[Answer<'_>]) -> Option<Vec<Arc<str>>> {
    let text = |item: &Answer<'_>| match item {
        Answer::Text(text) => Some(text.clone()),
        _ => None,
    };
    let mut texts: Vec<Arc<str>> = items.iter().map(text).collect::<Option<_>>()?;
    texts.sort();
    (!texts.is_empty()).then_some(texts)
}

fn pairs<'a>(a: &[Answer<'a>], b: &[Answer<'a>]) -> std::rc::Rc<[Answer<'a>]> {
    let pair = |(a, b): (&Answer<'a>, &Answer<'a>)| {
        Answer::List([a.clone(), b.clone()].into_iter().collect())
    };
    a.iter().zip(b).map(pair).collect()
}
