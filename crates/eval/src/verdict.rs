//! Verdicts: whether a rule holds, and how far its sides are apart.
//!
//! A rule holds to 1e-9 of its larger side unless `within` says otherwise; whole numbers, truth
//! values and texts exactly. Messages that answer a truth value are opened, so that the same
//! measure serves their comparisons.

use crate::answer::{Answer, Frame};
use crate::evaluator::{Evaluator, Result};
use crate::fault::Fault;
use crate::measure;
use crate::numerals::{number_text, read_number};
use crate::sway::Order;
use base::Name;
use base::number::{Tolerance, close, pow, shortest};
use expr::dimension::Dimension;
use kernel::{
    Aspect, BinaryOperator, ClassKind, ConstraintInstance, Setting, Term, ThingId, UnaryOperator,
};

/// What a test found.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Verdict {
    /// True if the rule holds.
    pub holds: bool,
    /// The left side less the right one, of several comparisons the farthest; none where the sides
    /// are not numbers. For an inequality that holds, zero.
    pub error: Option<f64>,
    /// The left side as text, for a single comparison.
    pub left: Option<String>,
    /// The right side as text, for a single comparison.
    pub right: Option<String>,
}

impl Verdict {
    fn of(holds: bool) -> Self {
        Self { holds, ..Self::default() }
    }
}

impl<'a> Evaluator<'a> {
    /// Tests the rule of a constraint.
    ///
    /// # Errors
    /// Why the rule has no value, named by the constraint's origin or an inner one.
    pub fn test(&self, constraint: ConstraintInstance) -> Result<Verdict> {
        let class = &self.document.classes[constraint.class];
        let written = &class.constraints[constraint.index as usize];
        self.begin_rule();
        if !self.is_on(constraint)? {
            return Ok(Verdict::of(true));
        }
        let frame = Frame::of(constraint.owner);
        self.judge_within(&written.rule, written.within.as_deref(), &frame)
            .map_err(|f| f.within(written.origin))
    }

    /// Returns true for a constraint that is switched on, or whose condition is true.
    ///
    /// # Errors
    /// Why the condition has no value.
    pub fn is_on(&self, constraint: ConstraintInstance) -> Result<bool> {
        let Some(&condition) = self.structure.conditions.get(&constraint) else {
            return Ok(self.structure.is_on(constraint));
        };
        let switch = condition.switch(self.document);
        match &switch.setting {
            Setting::Enabled(term) => {
                let truth = self.deeper(|| self.truth(term, &Frame::of(condition.me)));
                truth.map_err(|f| f.within(switch.origin))
            }
            Setting::Strength(_) => Ok(true),
        }
    }

    /// Tests any rule in which `Me` is the thing `me`, to `within` where that is written.
    ///
    /// # Errors
    /// Why the rule has no value.
    pub fn test_rule(
        &self,
        rule: &'a Term,
        within: Option<&'a Term>,
        me: ThingId,
    ) -> Result<Verdict> {
        self.begin();
        let frame = Frame::of(me);
        self.judge_within(rule, within, &frame)
    }

    fn judge_within(
        &self,
        rule: &'a Term,
        within: Option<&'a Term>,
        frame: &Frame<'a>,
    ) -> Result<Verdict> {
        let within = match within {
            Some(term) => {
                let (x, _) = self.number(&self.term(term, frame)?)?;
                Some(if term.is_part() { Tolerance::part(x) } else { Tolerance::within(x) })
            }
            None => None,
        };
        self.with_sway(within, || self.judge(rule, frame, within))
    }

    /// Answers what is asked of a constraint of a thing.
    #[inline(never)]
    pub(crate) fn of_constraint(
        &self,
        of: &Answer<'a>,
        name: &Name,
        aspect: Aspect,
    ) -> Result<Answer<'a>> {
        let missing = || Fault::wrong(format!("there is no constraint `{name}` here"));
        let Answer::Thing(thing) = of else { return Err(missing()) };
        if self.is_recording() {
            return Err(Fault::wrong("what a constraint says is not noted"));
        }
        let instance = self.constraint_named(*thing, name).ok_or_else(missing)?;
        let constraint =
            &self.document.classes[instance.class].constraints[instance.index as usize];
        let frame = Frame::of(instance.owner);
        let (rule, within) = (&*constraint.rule, constraint.within.as_deref());
        let verdict = || self.deeper(|| self.judge_within(rule, within, &frame));
        match aspect {
            Aspect::Error => {
                let dimension = match rule {
                    Term::Binary(_, side, _) => match self.term(side.as_ref(), &frame)? {
                        Answer::Number(_, dimension) => dimension,
                        _ => Dimension::NONE,
                    },
                    _ => Dimension::NONE,
                };
                let Verdict { error, holds, .. } = verdict()?;
                let error = error.unwrap_or(f64::from(u8::from(!holds)));
                Ok(Answer::Number(error, dimension))
            }
            Aspect::Satisfied => Ok(Answer::Bool(verdict()?.holds)),
            Aspect::Strength => {
                Ok(Answer::text(self.structure.strength(self.document, instance).word()))
            }
            Aspect::Enabled => Ok(Answer::Bool(self.is_on(instance)?)),
        }
    }

    pub(crate) fn judge(
        &self,
        rule: &'a Term,
        frame: &Frame<'a>,
        within: Option<Tolerance>,
    ) -> Result<Verdict> {
        self.burn()?;
        use BinaryOperator as B;
        match rule {
            Term::Binary(B::And, a, b) => {
                let a = self.deeper(|| self.judge(a, frame, within))?;
                let b = self.deeper(|| self.judge(b, frame, within))?;
                Ok(both(&a, &b))
            }
            Term::Binary(B::Or, a, b) => {
                let a = self.deeper(|| self.judge(a, frame, within))?;
                if a.holds { Ok(a) } else { self.deeper(|| self.judge(b, frame, within)) }
            }
            Term::Binary(B::Equal, a, b) => self.judge_equal(a, b, frame, within),
            Term::Binary(B::Less | B::LessEqual, a, b) => {
                let strict = matches!(rule, Term::Binary(B::Less, ..));
                self.judge_order(&self.term(a, frame)?, &self.term(b, frame)?, within, strict)
            }
            Term::Binary(B::Greater | B::GreaterEqual, a, b) => {
                let strict = matches!(rule, Term::Binary(B::Greater, ..));
                let (a, b) = (self.term(a, frame)?, self.term(b, frame)?);
                let verdict = self.judge_order(&b, &a, within, strict)?;
                let error = verdict.error.map(|e| 0.0 - e);
                Ok(Verdict { error, left: verdict.right, right: verdict.left, ..verdict })
            }
            Term::If(condition, then, otherwise) => {
                let is_true = self.truth(condition, frame)?;
                self.compared.borrow_mut().taken.push(is_true);
                let branch = if is_true { then } else { otherwise };
                self.deeper(|| self.judge(branch, frame, within))
            }
            Term::Let(name, bound, body) => {
                let frame = frame.bind(name, self.term(bound, frame)?);
                self.deeper(|| self.judge(body, &frame, within))
            }
            Term::Send { to, name, arguments, .. } if let Term::Class(class) = **to => {
                let Some(message) = self.class_message(class, name) else {
                    return self.truth(rule, frame).map(Verdict::of);
                };
                let arguments = self.arguments(arguments, frame)?;
                let inner = Frame::sent(Answer::Thing(frame.nearest), frame.nearest);
                let inner = self.bind(inner, message, arguments)?;
                self.deeper(|| self.judge(&message.answer, &inner, within))
                    .map_err(|f| f.within(message.origin))
            }
            Term::Send { to, name, arguments, search } => {
                let to = self.term(to, frame)?;
                let part = matches!(to, Answer::Thing(t) if self.part_named(t, name).is_some());
                match self.message(&to, name, *search) {
                    Some(message) if !part || search.is_some() => {
                        let arguments = self.arguments(arguments, frame)?;
                        let inner = Frame::sent(to.clone(), frame.nearest);
                        let inner = self.bind(inner, message, arguments)?;
                        self.deeper(|| self.judge(&message.answer, &inner, within))
                            .map_err(|f| f.within(message.origin))
                    }
                    _ => self.truth_or_thing(rule, frame).map(Verdict::of),
                }
            }
            Term::Index(..) => self.truth_or_thing(rule, frame).map(Verdict::of),
            Term::Unary(UnaryOperator::Not, inner) => {
                let verdict = self.deeper(|| self.judge(inner, frame, within))?;
                Ok(Verdict { holds: !verdict.holds, error: None, ..verdict })
            }
            Term::Binary(
                B::NotEqual
                | B::In
                | B::Add
                | B::Subtract
                | B::Multiply
                | B::Divide
                | B::Remainder
                | B::Power,
                ..,
            )
            | Term::Unary(UnaryOperator::Negate, _)
            | Term::Number { .. }
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
            | Term::Construct { .. }
            | Term::Call { .. }
            | Term::Make { .. }
            | Term::Tuple(_)
            | Term::List(_)
            | Term::Range(..)
            | Term::Lambda(..)
            | Term::IsA(..)
            | Term::All(_)
            | Term::Copy(_)
            | Term::OfConstraint { .. } => self.truth(rule, frame).map(Verdict::of),
        }
    }

    /// Reads a truth value; a thing stands for its own constraints, which are tested by themselves.
    fn truth_or_thing(&self, rule: &'a Term, frame: &Frame<'a>) -> Result<bool> {
        match self.term(rule, frame)? {
            Answer::Thing(_) => Ok(true),
            other => self.truth_of(&other),
        }
    }

    /// Names the things that stand in branches which are not taken: their constraints do not count.
    pub(crate) fn idle(&self, constraint: ConstraintInstance) -> Result<Vec<ThingId>> {
        let class = &self.document.classes[constraint.class];
        let rule = &class.constraints[constraint.index as usize].rule;
        self.begin_rule();
        let mut idle = Vec::new();
        self.collect_idle(rule, &Frame::of(constraint.owner), true, &mut idle)?;
        Ok(idle)
    }

    fn collect_idle(
        &self,
        rule: &'a Term,
        frame: &Frame<'a>,
        counts: bool,
        idle: &mut Vec<ThingId>,
    ) -> Result<()> {
        self.burn()?;
        match rule {
            Term::Binary(BinaryOperator::And, a, b) => {
                self.deeper(|| self.collect_idle(a, frame, counts, idle))?;
                self.deeper(|| self.collect_idle(b, frame, counts, idle))
            }
            Term::If(condition, then, otherwise) => {
                let truth = self.truth(condition, frame)?;
                self.deeper(|| self.collect_idle(then, frame, counts && truth, idle))?;
                self.deeper(|| self.collect_idle(otherwise, frame, counts && !truth, idle))
            }
            Term::Send { .. } | Term::Index(..) if !counts => {
                if let Answer::Thing(thing) = self.term(rule, frame)? {
                    idle.push(self.structure.merged[thing]);
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn judge_equal(
        &self,
        left: &'a Term,
        right: &'a Term,
        frame: &Frame<'a>,
        within: Option<Tolerance>,
    ) -> Result<Verdict> {
        let (a, b) = (self.term(left, frame)?, self.term(right, frame)?);
        let mut verdict = Verdict {
            holds: true,
            error: None,
            left: Some(self.text_of(&a)),
            right: Some(self.text_of(&b)),
        };
        if let (Answer::Text(s), Answer::Text(t)) = (&a, &b) {
            verdict.holds =
                s == t || self.reads_as(s, right, frame)? || self.reads_as(t, left, frame)?;
            return Ok(verdict);
        }
        self.leaves(&a, &b, &mut |a, b| {
            if let (Answer::Number(x, dx), Answer::Number(y, dy)) = (a, b) {
                measure::common(*dx, *dy)?;
                let error = x - y;
                verdict.holds &= self.agree(*x, *y, within, Order::Equal);
                if verdict.error.is_none_or(|e| e.abs() < error.abs()) {
                    verdict.error = Some(error);
                }
            } else {
                verdict.holds = verdict.holds && self.same_leaf(a, b)?;
            }
            Ok(())
        })?;
        Ok(verdict)
    }

    /// Returns true if a text reads as the number whose text a term asks for, to the digits asked for.
    fn reads_as(&self, text: &str, term: &'a Term, frame: &Frame<'a>) -> Result<bool> {
        let Term::Send { to, name, arguments, search: None } = term else { return Ok(false) };
        if !matches!(name.as_str(), "text" | "decimals") {
            return Ok(false);
        }
        let (Answer::Number(x, _), Some(read)) = (self.term(to, frame)?, read_number(text)) else {
            return Ok(false);
        };
        match arguments.first() {
            None => Ok(close(read, x)),
            Some(digits) => {
                let digits = self.digits(&self.term(&digits.value, frame)?)?;
                Ok(number_text(read, Some(digits)) == number_text(x, Some(digits)))
            }
        }
    }

    fn judge_order(
        &self,
        less: &Answer<'a>,
        more: &Answer<'a>,
        within: Option<Tolerance>,
        strict: bool,
    ) -> Result<Verdict> {
        let order = self.order(less, more)?;
        let (left, right) = (Some(self.text_of(less)), Some(self.text_of(more)));
        let (Answer::Number(x, _), Answer::Number(y, _)) = (less, more) else {
            let holds = if strict { order.is_lt() } else { order.is_le() };
            return Ok(Verdict { holds, error: None, left, right });
        };
        // What is strictly less does not become so by tolerance.
        let agree = self.agree(*x, *y, within, Order::AtMost);
        let holds = order.is_lt() || (!strict && agree);
        Ok(Verdict { holds, error: Some((x - y).max(0.0)), left, right })
    }

    /// Writes a value for people: numbers short, things by their paths.
    pub fn text_of(&self, answer: &Answer<'a>) -> String {
        match answer {
            Answer::Number(x, dimension) => self.number_text_of(*x, *dimension),
            Answer::Bool(b) => b.to_string(),
            Answer::Option(..) => self.option_name(answer),
            Answer::Text(text) => format!("\"{text}\""),
            Answer::Thing(thing) => match self.by_position(answer) {
                Ok(parts) if matches!(self.class_kind(*thing), ClassKind::List(_)) => {
                    self.listed(&parts, '[', ']')
                }
                Ok(parts) if self.is_flat(&parts) => self.listed(&parts, '(', ')'),
                _ => self.structure.path(self.document, *thing).to_string(),
            },
            Answer::Made(made) => {
                let name = &self.document.classes[made.class].name;
                format!("{name}{}", self.listed(&made.fields, '(', ')'))
            }
            Answer::Context(context) => self.document.classes[context.class].name.to_string(),
            Answer::List(items) => self.listed(items, '[', ']'),
            Answer::Picture(_) | Answer::Function(_) => answer.kind().to_string(),
        }
    }

    /// Writes a number with all its digits in the units in which the document counts.
    fn number_text_of(&self, x: f64, dimension: Dimension) -> String {
        let x = x / self.document.scale.factor(dimension);
        let is_of_the_sheet = dimension.0[1..].iter().all(|&exponent| exponent == 0);
        if is_of_the_sheet {
            return shortest(x);
        }
        let si = x / pow(self.document.units_per_metre, f64::from(dimension.0[0]));
        let preferred = expr::units::preferred(dimension);
        let shown = preferred.and_then(|p| Some((expr::units::unit(p)?.show(si)?, p)));
        shown.map_or_else(|| shortest(si), |(shown, unit)| format!("{} {unit}", shortest(shown)))
    }

    fn is_flat(&self, parts: &[Answer<'a>]) -> bool {
        (1..=3).contains(&parts.len()) && parts.iter().all(|p| matches!(p, Answer::Number(..)))
    }

    fn listed(&self, items: &[Answer<'a>], open: char, close: char) -> String {
        Self::listed_as(&|item| self.text_of(item), items, [open, close])
    }

    /// Lists values between brackets, each as `say` says it.
    pub(crate) fn listed_as(
        say: &dyn Fn(&Answer<'a>) -> String,
        items: &[Answer<'a>],
        [open, close]: [char; 2],
    ) -> String {
        /// A longer list ends in dots.
        const MOST: usize = 12;
        let mut words: Vec<String> = items.iter().take(MOST).map(say).collect();
        if items.len() > MOST {
            words.push("…".into());
        }
        format!("{open}{}{close}", words.join(", "))
    }
}

fn both(a: &Verdict, b: &Verdict) -> Verdict {
    let error = match (a.error, b.error) {
        (Some(x), Some(y)) if y.abs() > x.abs() => Some(y),
        (Some(x), _) => Some(x),
        (None, y) => y,
    };
    Verdict { holds: a.holds && b.holds, error, left: None, right: None }
}
