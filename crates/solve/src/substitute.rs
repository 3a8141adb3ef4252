//! Substitution: slots that required relations make equal become one unknown.
//!
//! In: the system. Out: [`Classes`], each slot's representative with the stay of the whole class, and
//! which equations were used up. Only `a = b` and `a = number` between slots that the relation may
//! write are taken; a relation with written methods is never substituted.

use crate::lists::Lists;
use crate::pattern::Plain;
use crate::stated::Stated;
use crate::system::{Level, Relation, RelationBody, SlotIndex, Span, Stay, System};

/// Slots by representative.
#[derive(Clone, Debug, Default)]
pub(crate) struct Classes {
    /// For every slot, the slot that stands for it.
    pub(crate) representative: Vec<SlotIndex>,
    /// Every representative of several slots, with where those stand in `grouped`.
    members: Vec<(SlotIndex, Span)>,
    grouped: Vec<SlotIndex>,
    /// Every representative that equals a number, with that number's bits, in order.
    pub(crate) constants: Vec<(SlotIndex, u64)>,
    /// For every representative (meaningless elsewhere), the strongest stay of its class.
    pub(crate) stay: Vec<Stay>,
    /// For every equation of the system, what became of it.
    fates: Vec<Fate>,
    /// The equations that say again, or contradict, what those of their circuit say, in order.
    pub(crate) repeated: Vec<(Key, Vec<Key>)>,
}

/// An equation: its relation and its index there.
pub(crate) type Key = (u32, u32);

/// What becomes of an equation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Fate {
    /// It becomes a row.
    Row,
    /// Substitution makes it hold.
    Used,
    /// It says again what others say.
    Repeated,
}

impl Classes {
    /// Returns true if an equation, by its place in the system, becomes no row.
    pub(crate) fn is_settled(&self, equation: usize) -> bool {
        self.fates[equation] != Fate::Row
    }
    /// Returns true if no slot equals another, or a number, and no equation says what others say.
    pub(crate) fn is_plain(&self) -> bool {
        self.members.is_empty() && self.constants.is_empty() && self.repeated.is_empty()
    }
    /// Returns every class of several slots: its representative and all of them, in order.
    pub(crate) fn members(&self) -> impl Iterator<Item = (SlotIndex, &[SlotIndex])> {
        self.members.iter().map(|&(root, span)| (root, &self.grouped[span.range()]))
    }
    /// Returns the relations that substitution makes hold, by the representative of what they make equal,
    /// in order; one of several equations may come several times.
    pub(crate) fn equalities(&self, system: &System) -> Lists {
        let all = self.used(system).map(|(at, (r, _))| {
            let arguments = system.arguments(system.equations[at].arguments);
            (self.representative[arguments[0] as usize], r)
        });
        Lists::new(self.representative.len(), all)
    }
    /// Returns the equations that hold by substitution, each by its place in the system and its key.
    fn used(&self, system: &System) -> impl Iterator<Item = (usize, Key)> + Clone {
        (0..).zip(&system.relations).flat_map(|(r, relation)| {
            let span = match relation.body {
                RelationBody::Equations(span) => span,
                RelationBody::Opaque { .. } => Span::default(),
            };
            let equations = span.range().zip(0..).map(move |(at, e)| (at, (r, e)));
            equations.filter(|&(at, _)| self.fates[at] == Fate::Used)
        })
    }
}

/// The equations used, as a forest of slots, and all numbers as one more node.
#[derive(Debug)]
pub(crate) struct Forest {
    /// For every node, the one towards its root, the equation between, and how far the root is.
    up: Vec<Option<(usize, Key)>>,
    depth: Vec<u32>,
}

impl Forest {
    /// Makes it of the equations that hold by substitution.
    pub(crate) fn new(classes: &Classes, system: &System) -> Self {
        let numbers = system.slots.len();
        let nodes = numbers + 1;
        let mut at: Vec<Vec<(usize, Key)>> = vec![Vec::new(); nodes];
        for (place, equation) in classes.used(system) {
            let arguments = system.arguments(system.equations[place].arguments);
            let end = |i: usize| arguments.get(i).map_or(numbers, |&slot| slot as usize);
            let [a, b] = [0, 1].map(end);
            at[a].push((b, equation));
            at[b].push((a, equation));
        }
        let mut up = vec![None; nodes];
        let mut depth = vec![u32::MAX; nodes];
        for root in 0..nodes {
            if depth[root] != u32::MAX {
                continue;
            }
            depth[root] = 0;
            let mut stack = vec![root];
            while let Some(v) = stack.pop() {
                for &(w, equation) in &at[v] {
                    if depth[w] == u32::MAX {
                        depth[w] = depth[v] + 1;
                        up[w] = Some((v, equation));
                        stack.push(w);
                    }
                }
            }
        }
        Self { up, depth }
    }
    /// Adds the equations of the way from `a` to `b` to a circuit.
    pub(crate) fn way(&self, mut a: usize, mut b: usize, circuit: &mut Vec<Key>) {
        while a != b {
            if self.depth[a] < self.depth[b] {
                std::mem::swap(&mut a, &mut b);
            }
            let Some((next, equation)) = self.up[a] else { return };
            circuit.push(equation);
            a = next;
        }
    }
}

/// How firmly a stay holds: smaller is firmer.
fn firmness(stay: Stay) -> (u8, u32) {
    match stay {
        Stay::Fixed => (0, 0),
        Stay::Given(giver) => (1, giver as u32),
        Stay::Kept { group } => (2, group),
        Stay::Free => (3, 0),
    }
}

/// Finds the classes of equal slots.
pub(crate) fn substitute(stated: &Stated) -> Classes {
    let system = &*stated.system;
    let n = system.slots.len();
    let mut parent: Vec<SlotIndex> = (0..n as u32).collect();
    let mut stay: Vec<Stay> = system.slots.iter().map(|s| s.stay).collect();
    let mut constants: Vec<(SlotIndex, u64)> = Vec::new();
    let mut is_constant = vec![false; n];
    let mut fates = vec![Fate::Row; system.equations.len()];
    // what is said again, and between which slots the way is that says it already
    let mut again: Vec<(Key, Vec<[usize; 2]>)> = Vec::new();
    for (r, relation) in (0..).zip(&system.relations) {
        let RelationBody::Equations(span) = relation.body else { continue };
        if relation.level != Level::Required || !relation.methods.is_empty() {
            continue;
        }
        for (e, at) in (0..).zip(span.range()) {
            let Some(simple) = simple(stated, relation, at) else { continue };
            let equation = (r, e);
            let united = match simple {
                Simple::Same(a, b) => unite(system, &mut parent, &stay, a, b),
                Simple::Number(a, bits) => {
                    let root = find(&mut parent, a);
                    let is_known = stay[root as usize] == Stay::Fixed;
                    if !is_known {
                        stay[root as usize] = Stay::Fixed;
                        constants.push((root, bits));
                        is_constant[root as usize] = true;
                    }
                    if is_known { United::Known } else { United::Now }
                }
            };
            let ends = match simple {
                Simple::Same(a, b) => [a as usize, b as usize],
                Simple::Number(a, _) => [a as usize, n],
            };
            match united {
                United::Now => fates[at] = Fate::Used,
                United::Before => {
                    fates[at] = Fate::Repeated;
                    again.push((equation, vec![ends]));
                }
                United::Known => {
                    fates[at] = Fate::Repeated;
                    let ways = ends.into_iter().filter(|&end| end < n).map(|end| {
                        let root = find(&mut parent, end as u32);
                        [end, if is_constant[root as usize] { n } else { root as usize }]
                    });
                    again.push((equation, ways.collect()));
                }
                United::Unlike => {}
            }
        }
    }
    let mut classes = collect(parent, stay, constants, fates);
    if !again.is_empty() {
        classes.repeated = circuits(&Forest::new(&classes, system), again);
    }
    classes
}

/// Finds what every equation that was said again repeats.
fn circuits(forest: &Forest, again: Vec<(Key, Vec<[usize; 2]>)>) -> Vec<(Key, Vec<Key>)> {
    let circuit = |ways: Vec<[usize; 2]>| {
        let mut circuit = Vec::new();
        ways.into_iter().for_each(|[a, b]| forest.way(a, b, &mut circuit));
        circuit.sort_unstable();
        circuit.dedup();
        circuit
    };
    again.into_iter().map(|(equation, ways)| (equation, circuit(ways))).collect()
}

fn collect(
    mut parent: Vec<SlotIndex>,
    stay: Vec<Stay>,
    mut constants: Vec<(SlotIndex, u64)>,
    fates: Vec<Fate>,
) -> Classes {
    let n = parent.len() as u32;
    let is_alone = (0..).zip(&parent).all(|(i, &root)| i == root);
    if !is_alone {
        for i in 0..n {
            parent[i as usize] = find(&mut parent, i);
        }
    }
    let representative = parent;
    let (mut members, mut grouped) = (Vec::new(), Vec::new());
    if !is_alone {
        // how many a class has, then where the next of them goes
        let mut next = vec![0u32; n as usize];
        representative.iter().for_each(|&root| next[root as usize] += 1);
        let mut start = 0;
        for (root, next) in (0..).zip(&mut next) {
            let len = std::mem::replace(next, start);
            if len > 1 {
                members.push((root, Span { start, len }));
                start += len;
            } else {
                *next = u32::MAX;
            }
        }
        grouped.resize(start as usize, 0);
        for (slot, &root) in (0..).zip(&representative) {
            let next = &mut next[root as usize];
            if *next != u32::MAX {
                grouped[*next as usize] = slot;
                *next += 1;
            }
        }
    }
    constants.iter_mut().for_each(|c| c.0 = representative[c.0 as usize]);
    constants.sort_unstable();
    Classes { representative, members, grouped, constants, stay, fates, repeated: Vec::new() }
}

#[derive(Clone, Copy)]
enum Simple {
    Same(SlotIndex, SlotIndex),
    Number(SlotIndex, u64),
}

/// Finds out whether an equation only says that two slots that it may write are equal, or what one is.
fn simple(stated: &Stated, relation: &Relation, equation: usize) -> Option<Simple> {
    let says = stated.pattern_at(stated.place_of(equation)).plain()?;
    let system = &*stated.system;
    let arguments = system.arguments(system.equations[equation].arguments);
    let reads = system.reads(relation);
    let may = |s: &SlotIndex| system.slots[*s as usize].is_number && !reads.contains(s);
    if !arguments.iter().all(may) {
        return None;
    }
    Some(match says {
        Plain::Same => Simple::Same(arguments[0], arguments[1]),
        Plain::Number(bits) => Simple::Number(arguments[0], bits),
    })
}

fn find(parent: &mut [SlotIndex], slot: SlotIndex) -> SlotIndex {
    let mut root = slot;
    while parent[root as usize] != root {
        root = parent[root as usize];
    }
    let mut walk = slot;
    while parent[walk as usize] != root {
        walk = std::mem::replace(&mut parent[walk as usize], root);
    }
    root
}

/// What became of an equality.
enum United {
    /// They are one class from now on.
    Now,
    /// They were one class before.
    Before,
    /// Both are known: the equality can only be tested.
    Known,
    /// One of them may only be whole.
    Unlike,
}

fn unite(
    system: &System,
    parent: &mut [SlotIndex],
    stay: &[Stay],
    a: SlotIndex,
    b: SlotIndex,
) -> United {
    if system.slots[a as usize].is_discrete != system.slots[b as usize].is_discrete {
        return United::Unlike;
    }
    let (a, b) = (find(parent, a), find(parent, b));
    if a == b {
        return United::Before;
    }
    if stay[a as usize] == Stay::Fixed && stay[b as usize] == Stay::Fixed {
        return United::Known;
    }
    let rank = |i: SlotIndex| (firmness(stay[i as usize]), i);
    let (root, child) = if rank(a) <= rank(b) { (a, b) } else { (b, a) };
    parent[child as usize] = root;
    United::Now
}
