//! What written methods and given values put into slots.

use crate::answer::{Answer, Frame};
use crate::evaluator::{Evaluator, Given, Result};
use crate::fault::Fault;
use crate::measure;
use base::Name;
use expr::units;
use kernel::{
    BinaryOperator, ClassKind, ConstraintInstance, GivenIn, Primitive, SlotId, Term, ThingId,
    UnaryOperator, Value,
};

/// What asks for a unit.
const UNIT: &str = "unit";
/// Percentages are looked for so deep in an expression.
const DEEPEST_UNIT: u32 = 16;

/// A side of an equation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

impl<'a> Evaluator<'a> {
    /// Computes what a written method of a constraint puts into its targets, things part by part.
    ///
    /// All values are computed from the state before; nothing is written here.
    ///
    /// # Errors
    /// Why a target has no value, named by the method.
    pub fn method(
        &self,
        constraint: ConstraintInstance,
        index: usize,
    ) -> Result<Vec<(SlotId, Value)>> {
        let class = &self.document.classes[constraint.class];
        let method = &class.constraints[constraint.index as usize].methods[index];
        self.begin();
        let frame = Frame::of(constraint.owner);
        let mut written = Vec::new();
        let mut write = || {
            for (path, term) in method.targets.iter().zip(&method.values) {
                let target = self.structure.follow(constraint.owner, path);
                let target = target
                    .map_err(|_| Fault::unknown(format!("the target {path} leads nowhere")))?;
                let value = self.term(term, &frame)?;
                self.share(target, &value, &mut written)?;
            }
            Ok(())
        };
        write().map_err(|f: Fault| f.within(method.origin))?;
        Ok(written)
    }

    /// Computes what makes the sides of an `=` in a constraint's rule alike: one takes the other's value.
    ///
    /// To the `=` lead `turns`: at every `and` to its second part, at every `if` to what holds where the condition
    /// is false, where the turn is true. Messages are opened. Nothing is written here.
    ///
    /// # Errors
    /// A rule without `=`, a side that is no stored part, a value that does not fit; named by the
    /// constraint.
    pub fn copy_side(
        &self,
        constraint: ConstraintInstance,
        turns: impl Iterator<Item = bool>,
        taker: Side,
    ) -> Result<Vec<(SlotId, Value)>> {
        let class = &self.document.classes[constraint.class];
        let written = &class.constraints[constraint.index as usize];
        self.begin();
        let mut written_by = Vec::new();
        let mut copy = |rule: &'a Term, frame: &Frame<'a>| {
            let Term::Binary(BinaryOperator::Equal, left, right) = rule else {
                return Err(Fault::wrong("a rule that is no equation"));
            };
            let (target, source) = match taker {
                Side::Left => (left, right),
                Side::Right => (right, left),
            };
            let target = self.target(target, frame)?;
            self.share(target, &self.term(source, frame)?, &mut written_by)
        };
        let frame = Frame::of(constraint.owner);
        self.part_of_rule(&written.rule, &frame, &mut turns.fuse(), &mut copy)
            .map_err(|f| f.within(written.origin))?;
        Ok(written_by)
    }

    /// Computes a side of a comparison or of an `or` in a constraint's rule, to which `turns` lead as for
    /// [`Self::copy_side`], or the condition of an `if`. A truth value is 1 or 0.
    ///
    /// # Errors
    /// A rule that is none of these, a side that is neither a number nor true or false; named by the constraint.
    pub fn side(
        &self,
        constraint: ConstraintInstance,
        turns: impl Iterator<Item = bool>,
        side: Side,
    ) -> Result<f64> {
        let class = &self.document.classes[constraint.class];
        let written = &class.constraints[constraint.index as usize];
        self.begin();
        let mut number = 0.0;
        let mut compute = |rule: &'a Term, frame: &Frame<'a>| {
            let term = match (rule, side) {
                (Term::Binary(_, left, _), Side::Left) => left,
                (Term::Binary(_, _, right), Side::Right) => right,
                (Term::If(condition, ..), _) => condition,
                _ => return Err(Fault::wrong("a rule that compares nothing")),
            };
            number = match self.term(term, frame)? {
                Answer::Bool(truth) => f64::from(truth),
                Answer::Option(_, at) => f64::from(at),
                other => self.number(&other)?.0,
            };
            Ok(())
        };
        let frame = Frame::of(constraint.owner);
        self.part_of_rule(&written.rule, &frame, &mut turns.fuse(), &mut compute)
            .map_err(|f| f.within(written.origin))?;
        Ok(number)
    }

    /// Does something with the part of a rule to which turns lead.
    fn part_of_rule(
        &self,
        rule: &'a Term,
        frame: &Frame<'a>,
        turns: &mut dyn Iterator<Item = bool>,
        with: &mut dyn FnMut(&'a Term, &Frame<'a>) -> Result<()>,
    ) -> Result<()> {
        if let Term::Binary(BinaryOperator::And | BinaryOperator::Or, first, second)
        | Term::If(_, first, second) = rule
            && let Some(is_second) = turns.next()
        {
            let part = if is_second { second } else { first };
            return self.deeper(|| self.part_of_rule(part, frame, turns, with));
        }
        if let Term::Let(name, bound, body) = rule {
            let inner = frame.bind(name, self.term(bound, frame)?);
            return self.deeper(|| self.part_of_rule(body, &inner, turns, with));
        }
        if let Term::Send { to, name, arguments, search } = rule {
            let to = self.term(to, frame)?;
            if let Some(message) = self.message(&to, name, *search) {
                let arguments = self.arguments(arguments, frame)?;
                let inner = self.bind(Frame::sent(to, frame.nearest), message, arguments)?;
                return self.deeper(|| self.part_of_rule(&message.answer, &inner, turns, with));
            }
        }
        with(rule, frame)
    }

    /// Lets a number that is shown in a text be shown in the unit in which it is given, where it is a part that is and no
    /// other unit is asked for.
    #[inline(never)]
    pub(crate) fn say_unit(&self, of: &'a Term, frame: &Frame<'a>, arguments: &mut Vec<Given<'a>>) {
        if arguments.len() > 1 || arguments.iter().any(|(l, _)| l.is_some_and(|l| *l == *UNIT)) {
            return;
        }
        let Some(unit) = self.unit_written(of, frame, DEEPEST_UNIT) else { return };
        if arguments.is_empty() {
            arguments.push((None, Answer::text("")));
        }
        arguments.push((None, Answer::text(unit)));
    }

    /// Returns the unit that a number was written in: that of a part; that of a percentage, too, where it is so many
    /// times a percentage, or percentages are added. A hundred times one is its number made by hand.
    fn unit_written(&self, of: &'a Term, frame: &Frame<'a>, depth: u32) -> Option<&'a Name> {
        let depth = depth.checked_sub(1)?;
        let part_of = |of: &'a Term| {
            let unit = self.unit_written(of, frame, depth)?;
            units::unit(unit).filter(|u| u.dimension.is_none()).map(|_| unit)
        };
        let times = |of: &'a Term, factor: &Term, by_hand: f64| {
            let Term::Number { value, bare: true, .. } = factor else { return None };
            part_of(of).filter(|unit| **unit != *"%" || *value != by_hand)
        };
        match of {
            Term::Send { .. } | Term::Index(..) => {
                let part = self.target(of, frame).ok()?;
                let given = self.structure.given(self.structure.slot_of(part)?)?;
                self.document.units.get(&given.origin)
            }
            Term::Unary(UnaryOperator::Negate, of) => part_of(of),
            Term::Binary(BinaryOperator::Multiply, a, b) => {
                times(b, a, 100.0).or_else(|| times(a, b, 100.0))
            }
            Term::Binary(BinaryOperator::Divide, a, b) => times(a, b, 0.01),
            Term::Binary(BinaryOperator::Add | BinaryOperator::Subtract, a, b) => {
                match (part_of(a), part_of(b)) {
                    (Some(a), Some(b)) => (a == b).then_some(a),
                    (Some(unit), None) => b.is_part().then_some(unit),
                    (None, Some(unit)) => a.is_part().then_some(unit),
                    (None, None) => None,
                }
            }
            _ => None,
        }
    }

    /// Finds the part that a term names, stored and not computed.
    fn target(&self, term: &'a Term, frame: &Frame<'a>) -> Result<ThingId> {
        let found = match term {
            Term::Send { to, name, arguments, search: None } if arguments.is_empty() => {
                self.term(to, frame)?.thing().and_then(|owner| self.part_named(owner, name))
            }
            Term::Index(list, index) => {
                let list = self.term(list, frame)?.thing();
                let index = usize::try_from(self.whole(&self.term(index, frame)?)?).ok();
                list.zip(index).and_then(|(list, i)| self.structure.parts(list).nth(i))
            }
            other => self.term(other, frame)?.thing(),
        };
        found.ok_or_else(|| Fault::wrong("a side that is no stored part takes no value"))
    }

    /// Computes the given value of a slot; none where nothing is given.
    ///
    /// # Errors
    /// Why it has no value, or one that the slot cannot hold; named by the given value.
    pub fn given(&self, slot: SlotId) -> Result<Option<Value>> {
        let Some(GivenIn { value, me }) = self.structure.slots[slot].given else {
            return Ok(None);
        };
        let given = &self.structure.givens[value];
        self.begin();
        let value = || {
            let mut answer = self.term(&given.term, &Frame::of(me))?;
            if let Answer::Thing(_) | Answer::Made(_) | Answer::List(_) = answer {
                let field = self.structure.things[self.structure.slots[slot].thing].field;
                let parts = self.by_position(&answer)?;
                answer = parts.get(field as usize).cloned().ok_or_else(|| {
                    Fault::wrong(format!("{} where more parts are wanted", self.kind(&answer)))
                })?;
            }
            self.value_for(slot, &answer)
        };
        value().map(Some).map_err(|f: Fault| f.within(given.origin))
    }

    /// Hands a value to the slots of a thing: itself, by position, or part by part.
    pub(crate) fn share(
        &self,
        target: ThingId,
        value: &Answer<'a>,
        written: &mut Vec<(SlotId, Value)>,
    ) -> Result<()> {
        self.burn()?;
        if let Some(slot) = self.structure.slot_of(target) {
            written.push((slot, self.value_for(slot, value)?));
            return Ok(());
        }
        let by_name = matches!(value, Answer::Thing(_) | Answer::Made(_))
            && matches!(self.class_kind(target), ClassKind::Composite);
        if by_name {
            let class = self.common_ancestor(&Answer::Thing(target), value)?;
            let layout = self.layout(class);
            return self.deeper(|| {
                layout.fields.iter().try_for_each(|&field| {
                    let name = self.document.field_name(field);
                    let part = self.part_named(target, name);
                    let part = part.ok_or_else(|| Fault::unknown(format!("no part `{name}`")))?;
                    let value = self.send(value, name, Vec::new(), None, target)?;
                    self.share(part, &value, written)
                })
            });
        }
        let parts = self.structure.parts(target);
        let values = self.by_position(value)?;
        if parts.len() != values.len() {
            let message = format!("{} values for {} parts", values.len(), parts.len());
            return Err(Fault::wrong(message));
        }
        self.deeper(|| parts.zip(&values).try_for_each(|(p, v)| self.share(p, v, written)))
    }

    /// Returns a value as a slot holds it.
    fn value_for(&self, slot: SlotId, answer: &Answer<'a>) -> Result<Value> {
        let wrong = |wanted: &str| {
            Err(Fault::wrong(format!("{} where {wanted} is wanted", self.kind(answer))))
        };
        match (self.structure.slots[slot].primitive, answer) {
            (Primitive::Real(wanted), Answer::Number(x, found)) => {
                measure::common(wanted, *found)?;
                Ok(Value::Number(x + 0.0))
            }
            (Primitive::Integer, Answer::Number(x, _)) if x.fract() == 0.0 => {
                Ok(Value::Number(x + 0.0))
            }
            (Primitive::Integer, Answer::Number(x, _)) => {
                let x = base::number::shortest(*x);
                Err(Fault::wrong(format!("{x} where a whole number is wanted")))
            }
            (Primitive::Bool, Answer::Bool(b)) => Ok(Value::Number(f64::from(u8::from(*b)))),
            (Primitive::Choice(wanted), Answer::Option(of, at)) if wanted == *of => {
                Ok(Value::Number(f64::from(*at)))
            }
            (Primitive::Text | Primitive::Color, Answer::Text(text)) => {
                Ok(Value::Text(text.clone()))
            }
            (Primitive::Real(_) | Primitive::Integer, _) => wrong("a number"),
            (Primitive::Bool, _) => wrong("a truth value"),
            (Primitive::Choice(of), _) => {
                wrong(&format!("an option of {}", self.document.classes[of].name))
            }
            (Primitive::Text, _) => wrong("a text"),
            (Primitive::Color, _) => wrong("a colour"),
        }
    }
}
