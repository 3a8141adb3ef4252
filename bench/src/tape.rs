//! Tapes in the table: nanoseconds an operation, wide and in a chain, beside plain Rust.

use bench::measure::{Repeat, median, repeated};
use expr::{Arena, Tape, Var};
use std::hint::black_box;
use std::io::Write;

const OPERATIONS: usize = 20_000;

/// Runs tapes of additions and products: `wide`, each of values alone; `chain`, each of the last.
pub(crate) fn table(out: &mut impl Write) -> std::io::Result<()> {
    writeln!(out, "{:12} {:>9} {:>9} {:>9} {:>7}", "ns each", "tape", "goal", "Rust", "times")?;
    let values: Vec<f64> = (0..OPERATIONS).map(|i| 1.0 + 1e-6 * i as f64).collect();
    let mut arena = Arena::new();
    let variables: Vec<_> = (0..OPERATIONS as u32).map(|i| arena.var(Var(i))).collect();
    let wide: Vec<_> = (1..OPERATIONS).map(|i| arena.mul(variables[i - 1], variables[i])).collect();
    let mut last = variables[0];
    for (i, &variable) in variables.iter().enumerate().skip(1) {
        last = if i % 2 == 0 { arena.add(last, variable) } else { arena.mul(last, variable) };
    }
    let of_wide = |values: &[f64], out: &mut [f64]| {
        for (product, pair) in out.iter_mut().zip(values.windows(2)) {
            *product = pair[0] * pair[1];
        }
    };
    let of_chain = |values: &[f64], out: &mut [f64]| {
        let mut x = values[0];
        for (i, &value) in values.iter().enumerate().skip(1) {
            x = if i % 2 == 0 { x + value } else { x * value };
        }
        out[0] = x;
    };
    row(out, "wide", "1.2", &Tape::compile(&arena, &wide), &values, of_wide)?;
    row(out, "chain", "3", &Tape::compile(&arena, &[last]), &values, of_chain)
}

fn row(
    out: &mut impl Write,
    name: &str,
    goal: &str,
    tape: &Tape,
    values: &[f64],
    plain: impl Fn(&[f64], &mut [f64]),
) -> std::io::Result<()> {
    let (mut registers, mut results) = (Vec::new(), vec![0.0; OPERATIONS - 1]);
    let count = if name == "chain" { 1 } else { results.len() };
    let (taped, _) = repeated(Repeat::Enough, || {
        tape.run(black_box(values), &mut registers, &mut results[..count]);
    });
    let (looped, _) = repeated(Repeat::Enough, || plain(black_box(values), &mut results));
    let each = |times: &[f64]| median(times).unwrap_or(f64::NAN) * 1e9 / OPERATIONS as f64;
    let (taped, looped) = (each(&taped), each(&looped));
    writeln!(out, "{name:12} {taped:9.2} {goal:>9} {looped:9.2} {:7.1}", taped / looped)
}
