//! Answers of random documents: whatever is edited, the independent checker finds nothing to complain of,
//! and the order in which constraints were written plays no part. Edits are small: on the way of a large one
//! least change may end and be measured anew. `THINGLAB_LONG` makes them many.

use base::Dice;
use session::{Command, DocumentId, Host, Literal, Session};
use std::fmt::Write as _;

/// How far numbers of two orders may lie apart: the last bits depend on the order of sums.
const SAME: f64 = 1e-6;

struct NoFiles;

impl Host for NoFiles {
    fn read(&self, _: &str) -> Option<String> {
        None
    }
}

/// Returns a number between two, in hundredths of the way.
fn between(dice: &mut Dice, low: f64, high: f64) -> f64 {
    low + (high - low) * dice.below(101) as f64 / 100.0
}

/// A document in two parts, and what can be edited in it.
struct Random {
    parts: String,
    constraints: Vec<String>,
    places: usize,
    numbers: Vec<String>,
}

impl Random {
    fn new(dice: &mut Dice) -> Self {
        let mut random =
            Self { parts: String::new(), constraints: Vec::new(), places: 0, numbers: Vec::new() };
        random.parts.push_str("class Point { x, y: Real }\n");
        if dice.below(3) < 2 {
            random.sketch(dice);
        } else {
            random.sheet(dice);
        }
        random
    }

    /// Points with bars, levels, midpoints and walls between them; all hold as they stand.
    fn sketch(&mut self, dice: &mut Dice) {
        self.places = 3 + dice.below(5);
        let mut at: Vec<[f64; 2]> = Vec::new();
        for i in 0..self.places {
            let place = [between(dice, 0.0, 100.0), between(dice, 0.0, 100.0)];
            at.push(place);
            writeln!(self.parts, "p{i}: Point = ({}, {})", place[0], place[1]).expect("a string");
        }
        if dice.below(2) == 0 {
            self.parts.push_str("anchor p0\n");
        }
        let mut aside = Vec::new();
        for i in 0..self.places + dice.below(3) {
            let (a, b) = (dice.below(self.places), dice.below(self.places));
            if a == b || aside.contains(&(a.min(b), a.max(b))) {
                continue;
            }
            aside.push((a.min(b), a.max(b)));
            match dice.below(6) {
                0 => {
                    let c = format!("m{i}");
                    let middle = [0, 1].map(|k| (at[a][k] + at[b][k]) / 2.0);
                    writeln!(self.parts, "{c}: Point = ({}, {})", middle[0], middle[1])
                        .expect("a string");
                    self.constraints.push(format!(
                        "constraint 2 * {c}.x = p{a}.x + p{b}.x and 2 * {c}.y = p{a}.y + p{b}.y"
                    ));
                }
                1 => {
                    let wall = at[a][0] + between(dice, 0.0, 20.0);
                    self.constraints.push(format!("constraint p{a}.x <= {wall}"));
                }
                2 => {
                    let (name, rise) = (format!("rise{i}"), at[b][1] - at[a][1]);
                    writeln!(self.parts, "{name}: Real = {rise}").expect("a string");
                    self.numbers.push(name.clone());
                    self.constraints.push(format!("constraint p{b}.y - p{a}.y = {name}"));
                }
                _ => {
                    let [x, y] = [0, 1].map(|k| at[a][k] - at[b][k]);
                    let (name, size) = (format!("bar{i}"), base::number::sqrt(x * x + y * y));
                    writeln!(self.parts, "{name}: Real = {size}").expect("a string");
                    self.numbers.push(name.clone());
                    self.constraints.push(format!(
                        "constraint sqrt((p{a}.x - p{b}.x)^2 + (p{a}.y - p{b}.y)^2) = {name}"
                    ));
                }
            }
        }
    }

    /// Numbers, given or not, with sums, products and bounds between them.
    fn sheet(&mut self, dice: &mut Dice) {
        let count = 3 + dice.below(6);
        for i in 0..count {
            let x = between(dice, 1.0, 20.0);
            let given = if dice.below(2) == 0 { format!(" = {x}") } else { String::new() };
            writeln!(self.parts, "x{i}: Real{given}").expect("a string");
            self.numbers.push(format!("x{i}"));
        }
        for _ in 0..1 + dice.below(count) {
            let [a, b, c] = [0; 3].map(|_| dice.below(count));
            if a == b || b == c || a == c {
                continue;
            }
            let k = 1 + dice.below(4);
            self.constraints.push(match dice.below(5) {
                0 => format!("constraint x{a} * x{b} = x{c}"),
                1 => format!("constraint x{a} <= x{b} + {}", 30 * k),
                _ => format!("constraint x{a} + {k} * x{b} = x{c}"),
            });
        }
    }

    fn text(&self, order: &[usize]) -> String {
        let constraints: Vec<&str> = order.iter().map(|&i| self.constraints[i].as_str()).collect();
        format!("{}{}\n", self.parts, constraints.join("\n"))
    }

    fn edit(&self, dice: &mut Dice, now: &[(String, f64)]) -> Command {
        let path = |name: &str| session::parse_path(name).expect("a path");
        if !self.numbers.is_empty() && (self.places == 0 || dice.below(2) == 0) {
            let name = &self.numbers[dice.below(self.numbers.len())];
            let (_, now) = now.iter().find(|n| n.0 == *name).expect("it has a value");
            let wanted = now * between(dice, 0.95, 1.05);
            return Command::Set(vec![(path(name), Literal::Number(wanted))]);
        }
        let name = format!("p{}", dice.below(self.places));
        let place = ["x", "y"].map(|axis| {
            let of = format!("{name}.{axis}");
            let (_, now) = now.iter().find(|n| n.0 == of).expect("it has coordinates");
            Literal::Number(now + between(dice, -5.0, 5.0))
        });
        Command::Move(vec![(path(&name), Literal::Tuple(place.to_vec()))])
    }
}

fn values(session: &Session, id: DocumentId) -> Vec<(String, f64)> {
    let rows = session.values(id).into_iter();
    let mut all: Vec<(String, f64)> = rows.filter_map(|r| Some((r.path, r.number?))).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

/// Edits a random document; returns how many edits were made and tested.
///
/// # Errors
/// What is wrong.
fn run(seed: u64, edits: usize) -> Result<usize, String> {
    let mut dice = Dice::new(seed);
    let random = Random::new(&mut dice);
    let written: Vec<usize> = (0..random.constraints.len()).collect();
    let mut other = written.clone();
    dice.shuffle(&mut other);
    let texts = [&written, &other].map(|order| random.text(order));
    let mut session = Session::new(Box::new(NoFiles));
    let ids = [0, 1].map(|i| session.open(&format!("order{i}"), &texts[i]));
    let (mut log, mut count) = (String::new(), 0);
    for step in 0..edits {
        let both = ids.map(|id| values(&session, id));
        let apart = both[0]
            .iter()
            .zip(&both[1])
            .find(|(a, b)| (a.1 - b.1).abs() > SAME * a.1.abs().max(1.0));
        // where numbers differ that much in size, tolerances decide which rules hold
        if both[0].iter().any(|(_, x)| *x != 0.0 && !(1e-3..1e4).contains(&x.abs())) {
            return Ok(count);
        }
        let good = ids.map(|id| session.standing(id).satisfied);
        if good[0] != good[1] {
            let told = "all holds in one order and not in the other";
            return Err(format!("{told} before step {step}\n{log}{}\n{}", texts[0], texts[1]));
        }
        if !good[0] {
            return Ok(count);
        }
        if let Some((a, b)) = apart {
            let told = format!("{} is {} in one order and {} in the other", a.0, a.1, b.1);
            return Err(format!("{told} before step {step}\n{log}{}\n{}", texts[0], texts[1]));
        }
        let command = random.edit(&mut dice, &both[0]);
        writeln!(log, "{command:?}").expect("a string");
        let made = ids.map(|id| session.apply(id, &command).is_ok());
        if made[0] != made[1] {
            let told = format!("{command:?} is made in one order and refused in the other");
            return Err(format!("{told} at step {step}\n{log}{}\n{}", texts[0], texts[1]));
        }
        count += usize::from(made[0]);
        for id in ids {
            let complaints = session.complaints(id);
            if made[0] && session.standing(id).satisfied && !complaints.is_empty() {
                let before: Vec<String> =
                    both[0].iter().map(|(path, x)| format!("{path} = {x}")).collect();
                let before = before.join(", ");
                return Err(format!(
                    "{command:?} at step {step}: {complaints:?}\nfrom {before}\n{}",
                    session.text(id).source
                ));
            }
        }
    }
    Ok(count)
}

#[test]
fn the_checker_has_no_complaint_and_order_plays_no_part() {
    const EDITS: usize = 6;
    let long = std::env::var("THINGLAB_LONG").ok();
    // a number of one's own, or what `cargo verify --long` says, which is 1
    let own = |n: String| n.parse().ok().filter(|&n| n > 1).unwrap_or(5_000);
    let seeds: u64 = long.map_or(60, own);
    let (mut made, mut wrong, mut anew) = (0, Vec::new(), Vec::new());
    for seed in 0..seeds {
        match run(seed, EDITS) {
            Ok(count) => made += count,
            Err(told) if told.contains("more than they had to") => anew.push(seed),
            Err(told) => wrong.push(format!("seed {seed}: {told}")),
        }
    }
    let shown: Vec<&str> = wrong.iter().take(4).map(String::as_str).collect();
    assert!(wrong.is_empty(), "{} of {seeds}\n{}", wrong.len(), shown.join("\n\n"));
    // past a fold least change is measured anew, and its end is no longer the least from where the edit began
    assert!(500 * anew.len() as u64 <= seeds, "more than had to be has changed in {anew:?}");
    let wanted = seeds as usize * EDITS;
    assert!(2 * made > wanted, "{made} of {wanted} edits were made: too few are tested");
}
