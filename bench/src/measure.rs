//! Measuring: a case solved, analysed and dragged, with the times that it took.

use crate::case::{Case, Drag};
use crate::document;
use crate::residual;
use crate::sketch::{Sketch, constraints_at, wishes};
use kernel::Values;
use plan::Planner;
use std::hint::black_box;
use std::time::Duration;
use web_time::Instant;

/// A sketch counts as solved if no constraint is further off.
pub const SOLVED: f64 = 1e-8;
/// How long solving is repeated at least, and how often.
const LEAST_TIME: Duration = Duration::from_millis(400);
const LEAST_RUNS: usize = 5;
/// A solve that takes longer than this is not repeated.
const SLOW: Duration = Duration::from_secs(2);

/// What came of a case. Times are in seconds.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Figures {
    /// Reading the case and making the things of its document, what their classes say compiled.
    pub build: f64,
    /// Whole solves from the start, planning included.
    pub solve: Vec<f64>,
    /// The same with nothing of it in the processor's caches.
    pub cold: Vec<f64>,
    /// From the text of the document to its solution.
    pub whole: Vec<f64>,
    /// Solves from the start with the plan kept.
    pub numbers: Vec<f64>,
    /// Where the points are after the solve.
    pub points: Vec<[f64; 2]>,
    /// The largest error of a constraint.
    pub residual: f64,
    /// How many degrees of freedom remain.
    pub freedom: usize,
    /// How many constraints say nothing new.
    pub redundant: usize,
    /// How many constraints stand against each other, of those none can be spared.
    pub conflicting: usize,
    /// How many constraints do not hold, and whether they can was not decided.
    pub undecided: usize,
    /// Counting those three after a solve.
    pub analysis: Vec<f64>,
    /// The case's drag.
    pub drag: Option<Dragged>,
}

/// What came of a drag. Times are in seconds.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Dragged {
    /// The press.
    pub press: f64,
    /// Every step.
    pub steps: Vec<f64>,
    /// After how many steps a constraint does not hold, or the value is not the wanted one.
    pub failed: usize,
    /// Where the points are at the start and after every step.
    pub path: Vec<Vec<[f64; 2]>>,
}

impl Figures {
    /// Returns true if every constraint holds to [`SOLVED`].
    pub fn is_solved(&self) -> bool {
        self.residual <= SOLVED
    }
}

impl Dragged {
    /// Returns the largest move of a point in one step.
    pub fn largest_move(&self) -> f64 {
        let moves = self.path.windows(2).flat_map(|pair| {
            pair[0].iter().zip(&pair[1]).map(|(p, q)| {
                let (x, y) = (q[0] - p[0], q[1] - p[1]);
                (x * x + y * y).sqrt()
            })
        });
        moves.fold(0.0, f64::max)
    }
}

/// How often a measurement is repeated.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Repeat {
    /// Once: what comes out is wanted, not how long it takes.
    Once,
    /// Until the figures can be trusted.
    Enough,
}

/// Reads, solves, analyses and drags a case.
///
/// # Errors
/// Why the text is no case.
pub fn measure(text: &str, repeat: Repeat) -> Result<Figures, String> {
    let begin = Instant::now();
    let case = Case::read(text)?;
    measured(&case, begin, repeat)
}

/// Solves, analyses and drags a case.
///
/// # Errors
/// Why no document can say it.
pub fn measure_case(case: &Case, repeat: Repeat) -> Result<Figures, String> {
    measured(case, Instant::now(), repeat)
}

fn measured(case: &Case, begin: Instant, repeat: Repeat) -> Result<Figures, String> {
    let sketch = Sketch::new(case)?;
    drop(black_box(sketch.templates()));
    let build = begin.elapsed().as_secs_f64();
    let (solve, (mut planner, values)) =
        repeated_after(repeat, || sketch.templates(), |templates| sketch.solve(templates));
    let cold = match repeat {
        Repeat::Once => Vec::new(),
        Repeat::Enough => cold(|| sketch.templates(), |templates| sketch.solve(templates)),
    };
    let text = document::text(case);
    let whole = match repeat {
        Repeat::Once => Vec::new(),
        Repeat::Enough => {
            repeated(repeat, || Sketch::of(case, &text).map(|s| s.solve(s.templates()))).0
        }
    };
    let (numbers, _) = repeated(repeat, || sketch.solve_again(&mut planner));
    let points = sketch.points(&values);
    let residual = residual::largest(case, &case.constraints, &points);
    // a planner that has solved, and analysed nothing yet
    let fresh = || sketch.solve(sketch.templates());
    let analyse = |(mut planner, values): (Planner, Values)| {
        let found = sketch.analyse(&mut planner, &values);
        (found, planner)
    };
    // what is solved slowly is not solved again and again for this
    let often = if solve.len() < LEAST_RUNS { Repeat::Once } else { repeat };
    let (analysis, (found, mut analysed)) = repeated_after(often, fresh, analyse);
    let conflicting = sketch.conflicting(&mut analysed, &values, &found.conflicting);
    let drag = match &case.drag {
        Some(drag) => Some(follow(case, &sketch, &mut planner, values, drag)?),
        None => None,
    };
    Ok(Figures {
        build,
        solve,
        cold,
        whole,
        numbers,
        points,
        residual,
        freedom: found.freedom,
        redundant: found.redundant.len(),
        conflicting,
        undecided: found.undecided.len(),
        analysis,
        drag,
    })
}

fn follow(
    case: &Case,
    sketch: &Sketch,
    planner: &mut Planner,
    mut values: Values,
    drag: &Drag,
) -> Result<Dragged, String> {
    let begin = Instant::now();
    let mut press = sketch.press(planner, &values, drag)?;
    let mut dragged = Dragged { press: begin.elapsed().as_secs_f64(), ..Dragged::default() };
    dragged.path.push(sketch.points(&values));
    for (i, wanted) in wishes(drag).iter().enumerate() {
        let begin = Instant::now();
        let reached = sketch.follow(planner, &mut press, &mut values, wanted);
        dragged.steps.push(begin.elapsed().as_secs_f64());
        let points = sketch.points(&values);
        let error = residual::largest(case, &constraints_at(case, drag, i), &points);
        let is_good = error <= SOLVED && (reached || matches!(drag, Drag::Point { .. }));
        dragged.failed += usize::from(!is_good);
        dragged.path.push(points);
    }
    Ok(dragged)
}

/// Runs something until its figures can be trusted; returns the seconds of each run, and the last result.
pub fn repeated<T>(repeat: Repeat, mut run: impl FnMut() -> T) -> (Vec<f64>, T) {
    repeated_after(repeat, || (), |()| run())
}

/// Does the same where every run needs something new, which is made before the clock starts.
pub fn repeated_after<N, T>(
    repeat: Repeat,
    mut make: impl FnMut() -> N,
    mut run: impl FnMut(N) -> T,
) -> (Vec<f64>, T) {
    let mut times = Vec::new();
    let begin = Instant::now();
    loop {
        let new = make();
        // a large piece of memory makes the allocator clear up now what making left behind
        drop(black_box(Vec::<u8>::with_capacity(1 << 16)));
        let start = Instant::now();
        let result = black_box(run(new));
        let took = start.elapsed();
        times.push(took.as_secs_f64());
        let enough = times.len() >= LEAST_RUNS && begin.elapsed() >= LEAST_TIME;
        if enough || repeat == Repeat::Once || took >= SLOW {
            return (times, result);
        }
    }
}

/// How much is written to have everything else out of the caches, in bytes, and how often something is run so.
const CACHES: usize = 64 << 20;
const COLD_RUNS: usize = 5;

/// Runs something a few times, each time after the processor's caches were filled with something else; returns the
/// seconds of each run. Every run needs something new, which is made before.
pub fn cold<N, T>(mut make: impl FnMut() -> N, mut run: impl FnMut(N) -> T) -> Vec<f64> {
    let mut other = vec![0u8; CACHES];
    (0..COLD_RUNS)
        .map(|i| {
            let new = make();
            other.iter_mut().step_by(64).for_each(|b| *b = b.wrapping_add(i as u8 | 1));
            black_box(&mut other);
            let start = Instant::now();
            black_box(run(new));
            start.elapsed().as_secs_f64()
        })
        .collect()
}

/// Returns the middle one; nothing of nothing.
pub fn median(times: &[f64]) -> Option<f64> {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}
