//! Substitution: slots that required relations make equal become one unknown.
//!
//! In: the system. Out: [`Classes`], each slot's representative with the stay of the whole class, and
//! which equations were used up. Only `a = b` and `a = number` between slots that the relation may
//! write are taken; a relation with written methods is never substituted.

use crate::stated::Stated;
use crate::system::{Equation, Level, Relation, SlotIndex, Stay, System};
use expr::{ExprId, Node};
use std::collections::BTreeMap;

/// Slots by representative.
#[derive(Clone, Debug, Default)]
pub(crate) struct Classes {
    /// For every slot, the slot that stands for it.
    pub(crate) representative: Vec<SlotIndex>,
    /// For every representative of several slots, all of them, in order.
    pub(crate) members: BTreeMap<SlotIndex, Vec<SlotIndex>>,
    /// For every representative that equals a number, that number's bits.
    pub(crate) constants: BTreeMap<SlotIndex, u64>,
    /// For every representative (meaningless elsewhere), the strongest stay of its class.
    pub(crate) stay: Vec<Stay>,
    /// The equations that substitution makes hold: relation and index.
    pub(crate) used: BTreeMap<(u32, u32), SlotIndex>,
    /// The equations that say again, or contradict, what those of their circuit say.
    pub(crate) repeated: BTreeMap<(u32, u32), Vec<(u32, u32)>>,
}

/// An equation: its relation and its index.
type Key = (u32, u32);

/// The way to a slot: from where, by which equation.
type Step = Option<(usize, Key)>;

/// The equations used so far, as edges between slots; the node after the last slot is all numbers.
struct Edges {
    at: Vec<Vec<(usize, Key)>>,
}

impl Edges {
    fn add(&mut self, a: usize, b: usize, equation: Key) {
        self.at[a].push((b, equation));
        self.at[b].push((a, equation));
    }
    /// Adds the equations of the shortest way from `a` to `b` to a circuit.
    fn way(&self, a: usize, b: usize, circuit: &mut Vec<Key>) {
        // from where, and by which equation, each slot was reached; the start by none
        let mut from: BTreeMap<usize, Step> = BTreeMap::from([(a, None)]);
        let mut queue = std::collections::VecDeque::from([a]);
        while let Some(v) = queue.pop_front() {
            if v == b {
                break;
            }
            for &(w, equation) in &self.at[v] {
                if let std::collections::btree_map::Entry::Vacant(entry) = from.entry(w) {
                    entry.insert(Some((v, equation)));
                    queue.push_back(w);
                }
            }
        }
        let mut at = b;
        while let Some(&Some((before, equation))) = from.get(&at) {
            circuit.push(equation);
            at = before;
        }
        circuit.sort_unstable();
        circuit.dedup();
    }
}

/// How firmly a stay holds: smaller is firmer.
fn firmness(stay: Stay) -> (u8, u32) {
    match stay {
        Stay::Fixed => (0, 0),
        Stay::Given => (1, 0),
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
    let mut constants = BTreeMap::new();
    let mut used = BTreeMap::new();
    let mut repeated: BTreeMap<(u32, u32), Vec<(u32, u32)>> = BTreeMap::new();
    let mut edges = Edges { at: vec![Vec::new(); n + 1] };
    for (r, relation) in system.relations.iter().enumerate() {
        if relation.level != Level::Required || !relation.methods.is_empty() {
            continue;
        }
        for (e, equation) in system.equations_of(relation).iter().enumerate() {
            let Some(simple) = simple(stated, relation, *equation) else { continue };
            let key = (r as u32, e as u32);
            let root = match simple {
                Simple::Same(a, b) => unite(system, &mut parent, &stay, a, b),
                Simple::Number(a, bits) => {
                    let root = find(&mut parent, a);
                    let is_known = stay[root as usize] == Stay::Fixed;
                    if !is_known {
                        stay[root as usize] = Stay::Fixed;
                        constants.insert(root, bits);
                    }
                    if is_known { United::Known } else { United::Now(root) }
                }
            };
            let ends = match simple {
                Simple::Same(a, b) => [a as usize, b as usize],
                Simple::Number(a, _) => [a as usize, n],
            };
            match root {
                United::Now(root) => {
                    used.insert(key, root);
                    edges.add(ends[0], ends[1], key);
                }
                United::Before => {
                    edges.way(ends[0], ends[1], repeated.entry(key).or_default());
                }
                United::Known => {
                    let circuit = repeated.entry(key).or_default();
                    for end in ends.into_iter().filter(|&end| end < n) {
                        let root = find(&mut parent, end as u32);
                        let known = if constants.contains_key(&root) { n } else { root as usize };
                        edges.way(end, known, circuit);
                    }
                }
                United::Unlike => {}
            }
        }
    }
    Classes { repeated, ..collect(parent, stay, &constants, used) }
}

fn collect(
    mut parent: Vec<SlotIndex>,
    stay: Vec<Stay>,
    constants: &BTreeMap<SlotIndex, u64>,
    used: BTreeMap<(u32, u32), SlotIndex>,
) -> Classes {
    let n = parent.len() as u32;
    let representative: Vec<SlotIndex> = (0..n).map(|i| find(&mut parent, i)).collect();
    let mut members: BTreeMap<SlotIndex, Vec<SlotIndex>> = BTreeMap::new();
    for (i, &root) in representative.iter().enumerate() {
        members.entry(root).or_default().push(i as u32);
    }
    members.retain(|_, m| m.len() > 1);
    let constants = constants.iter().map(|(&r, &b)| (representative[r as usize], b)).collect();
    let used = used.into_iter().map(|(k, r)| (k, representative[r as usize])).collect();
    Classes { representative, members, constants, stay, used, repeated: BTreeMap::new() }
}

#[derive(Clone, Copy)]
enum Simple {
    Same(SlotIndex, SlotIndex),
    Number(SlotIndex, u64),
}

fn simple(stated: &Stated, relation: &Relation, equation: Equation) -> Option<Simple> {
    let system = &*stated.system;
    let pattern = stated.pattern(equation.pattern);
    let arguments = system.arguments(equation.arguments);
    let slot = |id: ExprId| match pattern.arena().node(id) {
        Node::Var(v) => {
            let s = arguments[v.0 as usize];
            let is_number = system.slots[s as usize].is_number;
            (is_number && !relation.reads.contains(&s)).then_some(s)
        }
        _ => None,
    };
    let number = |id: ExprId| match pattern.arena().node(id) {
        Node::Constant(bits) => f64::from_bits(bits).is_finite().then_some(bits),
        _ => None,
    };
    let &[left, right] = pattern.roots() else { return None };
    match (slot(left), slot(right)) {
        (Some(a), Some(b)) => Some(Simple::Same(a, b)),
        (Some(a), None) => number(right).map(|bits| Simple::Number(a, bits)),
        (None, Some(b)) => number(left).map(|bits| Simple::Number(b, bits)),
        (None, None) => None,
    }
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
    /// The two are one class from now on, with this root.
    Now(SlotIndex),
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
    United::Now(root)
}
