use super::*;
use crate::deflate::Deflated;
use crate::direct::Direction;
use crate::pattern::{PatternId, Patterns};
use crate::peel::{Found, peel};
use crate::stated::Stated;
use crate::system::{Level, Relation, RelationBody, Slot};
use crate::{order, rest, rows, substitute};
use expr::{Arena, ExprId, Var};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// What a row of a random net says, of three slots.
fn pattern(patterns: &mut Patterns, kind: u8) -> PatternId {
    let mut arena = Arena::new();
    let [a, b, c] = [0, 1, 2].map(|i| arena.var(Var(i)));
    let two = arena.constant(2.0);
    let sides: [ExprId; 2] = match kind {
        0 => [arena.add(a, b), c],
        1 => [arena.mul(a, b), c],
        2 => {
            let twice = arena.mul(two, a);
            [arena.sub(twice, b), c]
        }
        3 => {
            let sum = arena.add(a, b);
            [arena.add(sum, c), two]
        }
        _ => {
            let (square, other) = (arena.square(a), arena.square(b));
            [arena.add(square, other), c]
        }
    };
    patterns.intern(&arena, &sides).0
}

struct Net {
    stated: Stated,
    classes: Classes,
    rows: Rows,
}

fn net(stays: &[u8], relations: &[(u8, [usize; 3], bool)]) -> Net {
    let mut patterns = Patterns::default();
    let mut system = System::default();
    for (i, stay) in (0..).zip(stays) {
        let stay = match stay {
            0 => Stay::Fixed,
            1 => Stay::Given(Giver::Document),
            2 => Stay::Given(Giver::Class),
            3 => Stay::Free,
            // two by two they are places
            _ => Stay::Kept { group: i / 2 },
        };
        system.slots.push(Slot { stay, scale: 0, is_number: true, is_discrete: false });
    }
    for &(kind, slots, soft) in relations {
        let mut slots = slots.map(|s| (s % stays.len()) as u32);
        while slots[1] == slots[0] {
            slots[1] = (slots[1] + 1) % stays.len() as u32;
        }
        while slots[2] == slots[0] || slots[2] == slots[1] {
            slots[2] = (slots[2] + 1) % stays.len() as u32;
        }
        let equations = system.add_equations([(pattern(&mut patterns, kind), slots)]);
        system.relations.push(Relation {
            level: if soft { Level::Weak } else { Level::Required },
            body: RelationBody::Equations(equations),
            methods: Default::default(),
            derived: true,
            reads: Default::default(),
            within: base::number::Tolerance::Relative,
            source: 0,
            rests: false,
        });
    }
    let stated = Stated::new(&Rc::new(system), &patterns);
    let classes = substitute::substitute(&stated);
    let rows = rows::with_columns(&stated, &classes, rows::stated_rows(&stated, &classes));
    Net { stated, classes, rows }
}

/// Eliminates with full pivoting; returns the rank.
fn rank(mut matrix: Vec<Vec<f64>>) -> usize {
    let mut rank = 0;
    while let Some((i, j)) = (rank..matrix.len())
        .flat_map(|i| (0..matrix[i].len()).map(move |j| (i, j)))
        .max_by(|&(i, j), &(k, l)| matrix[i][j].abs().total_cmp(&matrix[k][l].abs()))
        .filter(|&(i, j)| matrix[i][j].abs() > 1e-8)
    {
        matrix.swap(rank, i);
        let by = matrix[rank].clone();
        for row in &mut matrix[rank + 1..] {
            let factor = row[j] / by[j];
            row.iter_mut().zip(&by).for_each(|(x, y)| *x -= factor * y);
            row[j] = 0.0;
        }
        rank += 1;
    }
    rank
}

impl Net {
    fn slots(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.classes.representative.len() as u32)
            .filter(|&s| self.classes.representative[s as usize] == s)
    }
    fn rank(&self, of: &[usize], over: &BTreeSet<u32>) -> usize {
        let entry = |r: usize, s: u32| {
            let columns = self.rows.columns(r);
            columns.iter().find(|e| e.0 == s).map_or(0.0, |e| e.1)
        };
        rank(of.iter().map(|&r| over.iter().map(|&s| entry(r, s)).collect()).collect())
    }

    /// The definition, by trying everything: who is accepted, who contradicts whom, who may move.
    fn by_search(&self) -> (Vec<usize>, Vec<Dependent>, BTreeSet<u32>) {
        let stay = |s: u32| self.classes.stay[s as usize];
        let mut open: BTreeSet<u32> =
            self.slots().filter(|&s| matches!(stay(s), Stay::Kept { .. } | Stay::Free)).collect();
        let given = |giver| self.slots().filter(move |&s| stay(s) == Stay::Given(giver));
        let with_defaults: BTreeSet<u32> =
            open.iter().copied().chain(given(Giver::Class)).collect();
        let all: BTreeSet<u32> =
            with_defaults.iter().copied().chain(given(Giver::Document)).collect();
        let mut order: Vec<usize> = (0..self.rows.len()).collect();
        order.sort_by_key(|&r| (self.rows[r].level, r));
        let (mut accepted, mut dependent) = (Vec::new(), Vec::new());
        for r in order {
            let with = |rows: &[usize]| [rows, &[r]].concat();
            if self.rank(&with(&accepted), &all) == accepted.len() {
                let needed = |&a: &usize| {
                    let rest: Vec<usize> = accepted.iter().copied().filter(|&x| x != a).collect();
                    self.rank(&with(&rest), &all) > rest.len()
                };
                let circuit = accepted.iter().copied().filter(needed).collect();
                dependent.push(Dependent { row: r, circuit });
                continue;
            }
            accepted.push(r);
        }
        // a given number yields if what is given less firmly, or not at all, cannot do without it
        let others = self.rank(&accepted, &open);
        let helps = |looser: &BTreeSet<u32>, g: &u32| {
            let mut wider = looser.clone();
            wider.insert(*g);
            self.rank(&accepted, &wider) > self.rank(&accepted, looser)
        };
        let mut yielding: Vec<u32> = given(Giver::Class).filter(|g| helps(&open, g)).collect();
        yielding.extend(given(Giver::Document).filter(|g| helps(&with_defaults, g)));
        // but how much it yields is decided first: what is computed stays where the rest, by itself,
        // can do as much without it
        for group in 0..self.classes.representative.len() as u32 {
            let slots = &self.stated.system.slots;
            let own: Vec<u32> = (0..slots.len())
                .filter(|&s| slots[s].stay == Stay::Kept { group })
                .map(|s| self.classes.representative[s])
                .collect();
            if own.iter().any(|&s| stay(s) != Stay::Kept { group }) {
                continue;
            }
            let without: BTreeSet<u32> =
                open.iter().copied().filter(|s| !own.contains(s)).collect();
            if self.rank(&accepted, &without) == others {
                open = without;
            }
        }
        open.extend(yielding);
        (accepted, dependent, open)
    }

    fn accept(&self, resting: &Resting) -> Acceptance {
        let (system, classes, rows) = (&*self.stated.system, &self.classes, &self.rows);
        accept(Setting { system, classes, rows, resting })
    }

    /// What the tableau finds, and sparse elimination in both of its ways.
    fn by_elimination<N: Number>(
        &self,
        resting: &Resting,
        of: impl Fn(&[u32]) -> Vec<Row<N>>,
    ) -> [Acceptance; 3] {
        let (system, classes, rows) = (&*self.stated.system, &self.classes, &self.rows);
        let asked = Asked::new(system, classes, rows);
        let setting = Setting { system, classes, rows, resting };
        let decide = |piece: &mut dyn FnMut(Piece<'_>, &mut Acceptance)| {
            let mut out = undecided(classes);
            apart(classes, rows, asked.all(), &mut out, piece);
            count(system, classes, &mut out);
            out.let_rest(rows, resting);
            out
        };
        let by_tableau = decide(&mut |piece, out| {
            exact::accept(setting, &of(piece.rows), piece, None, out);
        });
        let [of_slots, by_pivots] = [true, false].map(|of_slots| {
            let mut matcher = Matcher::new(setting);
            decide(&mut |piece, out| {
                let own = of(piece.rows);
                let deflated = Deflated::new(classes, &own, piece);
                let is_held = if of_slots {
                    deflated.hold_by_elimination(out)
                } else {
                    deflated.hold(&mut matcher, out)
                };
                if is_held {
                    deflated.accept(rows, out);
                } else {
                    exact::accept(setting, &own, piece, None, out);
                }
            })
        });
        [by_tableau, of_slots, by_pivots]
    }
}

/// Returns the rows and unknowns of blocks, in any order.
fn told(blocks: &Blocks) -> BTreeSet<(Vec<usize>, Vec<u32>)> {
    blocks.iter().map(|b| (b.rows.to_vec(), b.unknowns.to_vec())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn acceptance_is_what_trying_everything_finds(
        stays in prop::collection::vec(0u8..9, 4..14),
        relations in prop::collection::vec(
            (0u8..5, prop::array::uniform3(0usize..14), prop::bool::weighted(0.2)), 1..12),
    ) {
        let net = net(&stays, &relations);
        let found = net.accept(&rest::NONE);
        let found = Acceptance { matched: None, places: Lists::default(), ..found };
        for other in net.by_elimination(&rest::NONE, |rows| net.rows.doubles(rows)) {
            prop_assert_eq!(&found, &other);
        }
        let residues = |rows: &[u32]| net.rows.residues(rows).expect("sums and products have them");
        for other in net.by_elimination(&rest::NONE, residues) {
            prop_assert_eq!(&found, &other);
        }
        let (accepted, dependent, open) = net.by_search();
        prop_assert_eq!(&found.accepted, &accepted);
        prop_assert_eq!(&found.dependent, &dependent);
        let unknown: BTreeSet<u32> =
            net.slots().filter(|&s| found.unknown[s as usize]).collect();
        prop_assert_eq!(unknown, open);
    }

    #[test]
    fn where_rows_rest_those_that_are_accepted_are_independent_over_what_moves(
        stays in prop::collection::vec(2u8..9, 4..14),
        relations in prop::collection::vec(
            (0u8..5, prop::array::uniform3(0usize..14), Just(false)), 1..12),
        rests in prop::collection::vec(prop::bool::weighted(0.8), 1..12),
    ) {
        let net = net(&stays, &relations);
        let has_value = |r: usize| {
            net.rows.columns(r).iter().all(|e| net.classes.stay[e.0 as usize] != Stay::Free)
        };
        let rests = (0..net.rows.len()).map(|r| rests[r % rests.len()] && has_value(r));
        let resting = Resting::of(rests.collect());
        let found = net.by_elimination(&resting, |rows| net.rows.doubles(rows));
        for found in found.into_iter().chain([net.accept(&resting)]) {
            let open = net.slots().filter(|&s| found.unknown[s as usize]).collect();
            prop_assert_eq!(net.rank(&found.accepted, &open), found.accepted.len(), "{:?}", found);
        }
    }

    #[test]
    fn what_is_peeled_is_what_acceptance_finds(
        known in prop::array::uniform3(0u8..3),
        rows in prop::collection::vec(
            (0u8..5, prop::array::uniform2(0usize..14), 0u8..8, prop::array::uniform2(0u8..5)), 1..12),
        again in prop::option::of(0usize..12),
    ) {
        let mut stays: Vec<u8> = known.to_vec();
        stays.extend(rows.iter().map(|_| 4));
        // one and the next may each read what the other is to determine
        let is_mutual = |i: usize| rows.get(i).is_some_and(|row| row.3[1] < 2 && i.is_multiple_of(2));
        let slots = |i: usize, reads: [usize; 2]| match i {
            _ if is_mutual(i) && i + 1 < rows.len() => [reads[0] % (3 + i), 4 + i, 3 + i],
            1.. if is_mutual(i - 1) => [reads[0] % (2 + i), 2 + i, 3 + i],
            _ => [reads[0] % (3 + i), reads[1] % (3 + i), 3 + i],
        };
        // declared in any order
        let mut order: Vec<_> = rows.iter().enumerate().collect();
        order.sort_by_key(|(_, row)| row.2);
        let stated = order.iter().map(|&(i, &(kind, reads, _, [soft, _]))| (kind, slots(i, reads), soft == 0));
        let mut relations: Vec<_> = stated.collect();
        if let Some(again) = again.and_then(|again| relations.get(again).copied()) {
            relations.push(again);
        }
        let net = net(&stays, &relations);
        let system = &net.stated.system;
        let found = net.accept(&rest::NONE);
        let stated = rows::stated_rows(&net.stated, &net.classes);
        let peeled = match peel(system, &net.classes, stated) {
            Found::All(peeled) => peeled,
            Found::Not(_) => {
                let is_large = |m: Matched| m.blocks.iter().any(|block| block.rows.len() > 2);
                prop_assert!(found.matched.is_none_or(is_large), "some are solved together");
                return Ok(());
            }
        };
        prop_assert_eq!(relations.len(), rows.len(), "two rows say of one slot what it is");
        let matched = found.matched.as_ref().expect("every row has a slot of its own");
        prop_assert_eq!(told(&peeled.blocks()), told(&matched.blocks));
        let mut is_determined = vec![false; stays.len()];
        for block in peeled.blocks().iter() {
            block.unknowns.iter().for_each(|&s| is_determined[s as usize] = true);
            let is_there = |&s: &u32| is_determined[s as usize] || stays[s as usize] < 4;
            prop_assert!(block.rows.iter().all(|&r| peeled.rows.mentions(r).iter().all(is_there)));
        }
        let made = super::peeled(system, &net.classes, &peeled.rows, &is_determined);
        prop_assert_eq!(made.yields(&net.classes), found.yields(&net.classes));
        prop_assert_eq!((made.freedom, made.unknown), (found.freedom, found.unknown));
    }
    #[test]
    fn what_is_free_is_ordered_by_the_blocks_that_acceptance_found(
        stays in prop::collection::vec(2u8..9, 6..16),
        relations in prop::collection::vec(
            (0u8..5, prop::array::uniform3(0usize..16), prop::bool::weighted(0.2)), 1..7),
    ) {
        let net = net(&stays, &relations);
        let found = net.accept(&rest::NONE);
        let Some(matched) = found.matched else { return Ok(()) };
        let Matched { slot_of_row, row_of_slot, blocks } = matched;
        let direction = Direction { slot_of_row, row_of_slot, ..Direction::default() };
        let all = order::order(&order::Incidence {
            rows: &net.rows,
            taking_part: &found.accepted,
            unknown: &found.unknown,
            direction: &direction,
            method_reads: &BTreeMap::new(),
            together: &[],
        });
        let free = order::exchangeable(&blocks, &net.rows, &found.unknown, &direction);
        let free = free.expect("no block is large");
        let beside = order::beside_free(&blocks, &net.rows, (&found.unknown, &free), &direction);
        let beside = beside.expect("every row shows what it mentions");
        prop_assert_eq!(told(&beside), told(&all));
        let mut is_there: Vec<bool> = found.unknown.iter().map(|unknown| !unknown).collect();
        for block in beside.iter() {
            block.unknowns.iter().for_each(|&s| is_there[s as usize] = true);
            let mut read = block.rows.iter().flat_map(|&r| net.rows.mentions(r));
            prop_assert!(read.all(|&s| is_there[s as usize]));
        }
    }
}
