//! Strips: steps by formula that run together.
//!
//! In: steps of a plan, in order. Out: the same in portions. Steps of one formula that do not read one
//! another run abreast, in lanes, to the same bits; where each reads what the one before writes, they
//! run in turn, with nothing looked up in between. Steps change places only within a stretch of
//! formulas, and never with one that they read.

use crate::kernel::{Kernel, Solved};
use crate::lower::{Inverse, Program};
use crate::peel::Peeled;
use crate::plan::Plan;
use crate::system::SlotIndex;
use expr::LANES;
use std::rc::Rc;

/// What runs at once.
#[derive(Debug)]
pub(crate) enum Portion {
    /// One step, by its index.
    Step(u32),
    /// Steps one after the other.
    InTurn(Strip),
    /// Steps of one formula, none of which reads another.
    Abreast(Strip),
}

/// Steps by formula.
#[derive(Debug)]
pub(crate) struct Strip {
    pub(crate) formulas: Vec<Formula>,
    pub(crate) rows: Vec<StripRow>,
    /// The arguments of every row, one row's after the other's.
    pub(crate) arguments: Vec<SlotIndex>,
}

/// One step of a strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StripRow {
    /// Its index in the plan.
    pub(crate) step: u32,
    pub(crate) target: SlotIndex,
    /// Which formula.
    pub(crate) formula: u32,
    /// Where its arguments begin.
    pub(crate) first: u32,
    /// The place of its equation in the system; none where it makes several hold.
    pub(crate) row: u32,
}

/// An equation solved for one of its arguments by the one formula that there is.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    kernel: Rc<Kernel>,
    pub(crate) argument: u32,
}

impl Formula {
    pub(crate) fn arity(&self) -> usize {
        self.kernel.arity()
    }
    pub(crate) fn solved(&self) -> &Solved {
        self.kernel.solved(self.argument).expect("a strip is made of steps that have a formula")
    }
}

/// So many steps of one formula run abreast, and fewer are no strip.
const FEWEST: usize = 4;
/// A stretch with fewer steps a level than this runs in turn.
const NARROWEST: usize = LANES;

/// How many formulas back one is looked for.
const FAR: usize = 32;

/// For every slot, the step that writes it.
#[derive(Debug)]
pub(crate) struct Writers(Vec<u32>);

impl Writers {
    pub(crate) fn of(plan: &Plan) -> Self {
        let mut writer = vec![u32::MAX; plan.slots().len()];
        for (index, step) in (0..).zip(plan.steps()) {
            step.targets.iter().for_each(|&t| writer[t as usize] = index);
        }
        Self(writer)
    }
    /// Returns true if all that a step reads is there when it runs: it is not part of a cycle.
    pub(crate) fn are_before(&self, plan: &Plan, step: u32) -> bool {
        plan.steps()[step as usize].reads.iter().all(|&r| {
            let writer = self.0[r as usize];
            writer == u32::MAX || writer < step
        })
    }
}

/// A step that may be part of a strip.
#[derive(Clone, Copy)]
struct Link<'p> {
    kernel: &'p Rc<Kernel>,
    /// Which argument is computed.
    argument: u32,
    arguments: &'p [SlotIndex],
}

impl Link<'_> {
    fn target(self) -> SlotIndex {
        self.arguments[self.argument as usize]
    }
}

/// Where steps come from.
#[derive(Clone, Copy)]
pub(crate) enum Links<'p> {
    /// From the steps of a plan.
    Steps(&'p Plan, &'p Writers),
    /// From rows that are solved one after the other.
    Peeled(&'p Plan, &'p Peeled),
}

impl<'p> Links<'p> {
    /// Returns a step that may be part of a strip.
    #[inline]
    fn get(self, index: u32) -> Option<Link<'p>> {
        match self {
            Self::Steps(plan, writers) => {
                let step = &plan.steps()[index as usize];
                let Program::Inverse(inverse) = &step.program else { return None };
                let target = &plan.slots()[step.targets[0] as usize];
                let is_plain = target.is_number && !target.is_discrete && inverse.roots() == 1;
                let Inverse { row, argument, .. } = inverse;
                (is_plain && writers.are_before(plan, index)).then_some(Link {
                    kernel: &row.kernel,
                    argument: *argument,
                    arguments: &row.arguments,
                })
            }
            Self::Peeled(_, peeled) => {
                let solved = peeled.order[index as usize];
                Some(Link {
                    kernel: peeled.kernel(solved),
                    argument: solved.argument(),
                    arguments: peeled.rows.mentions(solved.row as usize),
                })
            }
        }
    }
    fn link(self, index: u32) -> Link<'p> {
        self.get(index).expect("a stretch is made of steps that may be part of a strip")
    }
    /// Returns the place of a step's equation in the system; none where it makes several hold.
    fn row(self, index: u32) -> u32 {
        match self {
            Self::Steps(plan, _) => match plan.steps()[index as usize].rows[..] {
                [row] => row,
                _ => u32::MAX,
            },
            Self::Peeled(plan, peeled) => {
                plan.place_of_row(&peeled.rows, peeled.order[index as usize].row)
            }
        }
    }
    /// Returns true if two steps may be part of one strip.
    fn may_join(self, a: u32, b: u32) -> bool {
        match self {
            Self::Steps(..) => [a, b].iter().all(|&s| self.get(s).is_some()),
            Self::Peeled(..) => true,
        }
    }
    /// Returns from how many steps on a strip is made of them: of rows in any case, so that none becomes a step for it.
    fn fewest(self) -> usize {
        match self {
            Self::Steps(..) => FEWEST,
            Self::Peeled(..) => 1,
        }
    }
    fn slots(self) -> usize {
        match self {
            Self::Steps(plan, _) | Self::Peeled(plan, _) => plan.slots().len(),
        }
    }
}

/// Puts steps together, given by their indices in order.
pub(crate) fn portions(links: Links<'_>, steps: &[u32]) -> Vec<Portion> {
    let mut made = Vec::new();
    let mut level_of_slot = vec![0; links.slots()];
    // the highest level of the stretches before: what comes from there is on the ground
    let mut ground = 0;
    for stretch in steps.chunk_by(|&a, &b| links.may_join(a, b)) {
        match links.get(stretch[0]) {
            Some(_) if stretch.len() >= links.fewest() => {
                ground = stretch_portions(links, stretch, ground, &mut level_of_slot, &mut made);
            }
            Some(_) | None => made.extend(stretch.iter().map(|&s| Portion::Step(s))),
        }
    }
    made
}

/// Puts a stretch of formulas together; returns its highest level.
fn stretch_portions(
    links: Links<'_>,
    stretch: &[u32],
    ground: u32,
    level_of_slot: &mut [u32],
    made: &mut Vec<Portion>,
) -> u32 {
    let mut formulas: Vec<Formula> = Vec::new();
    let mut steps: Vec<Linked> = Vec::with_capacity(stretch.len());
    let mut arguments = 0;
    for &index in stretch {
        let link = links.link(index);
        // what it computes itself has none yet
        let levels = link.arguments.iter().map(|&r| level_of_slot[r as usize]);
        let level = levels.fold(ground, u32::max) + 1;
        level_of_slot[link.target() as usize] = level;
        arguments += link.arguments.len();
        let same = |f: &Formula| Rc::ptr_eq(&f.kernel, link.kernel) && f.argument == link.argument;
        let from = formulas.len().saturating_sub(FAR);
        let known = formulas[from..].iter().rposition(same).map(|i| from + i);
        let formula = known.unwrap_or(formulas.len());
        if known.is_none() {
            formulas.push(Formula { kernel: link.kernel.clone(), argument: link.argument });
        }
        steps.push(Linked { level, formula: formula as u32, index });
    }
    let highest = steps.iter().map(|s| s.level).max().unwrap_or(ground);
    if steps.len() < (highest - ground) as usize * NARROWEST {
        made.push(Portion::InTurn(Strip::new(links, formulas, &steps, arguments)));
        return highest;
    }
    steps.sort_unstable();
    let are_abreast = |a: &Linked, b: &Linked| (a.level, a.formula) == (b.level, b.formula);
    for group in steps.chunk_by_mut(are_abreast) {
        let formula = formulas[group[0].formula as usize].clone();
        let arguments = group.len() * formula.arity();
        group.iter_mut().for_each(|step| step.formula = 0);
        let strip = Strip::new(links, vec![formula], group, arguments);
        made.push(match group.len() {
            FEWEST.. => Portion::Abreast(strip),
            _ => Portion::InTurn(strip),
        });
    }
    highest
}

/// A step of a stretch.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Linked {
    /// One more than the highest of what it reads.
    level: u32,
    /// Which formula.
    formula: u32,
    /// The step, by its index.
    index: u32,
}

impl Strip {
    /// Puts steps together that have so many arguments in all.
    fn new(links: Links<'_>, formulas: Vec<Formula>, steps: &[Linked], arguments: usize) -> Self {
        let mut arguments = Vec::with_capacity(arguments);
        let row = |&Linked { formula, index, .. }: &Linked| {
            let link = links.link(index);
            let first = arguments.len() as u32;
            arguments.extend_from_slice(link.arguments);
            let (target, row) = (link.target(), links.row(index));
            StripRow { step: index, target, formula, first, row }
        };
        let rows = steps.iter().map(row).collect();
        Self { formulas, rows, arguments }
    }
}
