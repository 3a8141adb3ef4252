//! Eigenvectors of large symmetric matrices: reflections to a tridiagonal matrix, then QL steps with implicit shifts.
//!
//! In: a full symmetric matrix. Out: its eigenvalues and orthonormal eigenvectors, each exact to rounding of the
//! matrix's largest. After Bowdler, Martin, Reinsch and Wilkinson, "The QR and QL algorithms for symmetric matrices",
//! 1968.

use super::{add, dot, scale};
use base::number::sqrt;

/// Steps that one eigenvalue takes at most; two or three are usual.
const STEPS: usize = 60;

pub(super) fn eigen(a: Vec<f64>, n: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (mut diagonal, mut beside, mut vectors) = reflect(a, n);
    let sizes = diagonal.iter().zip(&beside).map(|(d, e)| d.abs() + e.abs());
    let nothing = sizes.fold(0.0, f64::max) * f64::EPSILON / 2.0;
    for first in 0..n {
        for _ in 0..STEPS {
            let joined = beside[first..n - 1].iter().take_while(|e| e.abs() > nothing).count();
            if joined == 0 {
                break;
            }
            let run = first..first + joined + 1;
            chase(&mut diagonal[run.clone()], &mut beside[run.clone()], &mut vectors[run]);
        }
    }
    (diagonal, vectors)
}

/// Returns the diagonal, what is beside it (one entry less, then nothing), and the vectors in which the matrix is so.
fn reflect(mut a: Vec<f64>, n: usize) -> (Vec<f64>, Vec<f64>, Vec<Vec<f64>>) {
    let mut beside = vec![0.0; n];
    let mut mirrors: Vec<(usize, Vec<f64>)> = Vec::new();
    for k in 0..n.saturating_sub(1) {
        let from = k + 1;
        let mut v = a[k * n + from..(k + 1) * n].to_vec();
        if v[1..].iter().all(|x| *x == 0.0) {
            beside[k] = v[0];
            continue;
        }
        let length = sqrt(dot(&v, &v)).copysign(v[0]);
        beside[k] = -length;
        v[0] += length;
        let by = 1.0 / sqrt(dot(&v, &v));
        scale(&mut v, by);
        // A - 2 v w' - 2 w v', where w is A v less its half along v
        let mut w: Vec<f64> = (from..n).map(|i| dot(&a[i * n + from..(i + 1) * n], &v)).collect();
        let along = dot(&v, &w);
        add(&mut w, -along, &v);
        for (i, (x, y)) in v.iter().zip(&w).enumerate() {
            let row = &mut a[(from + i) * n + from..(from + i + 1) * n];
            add(row, -2.0 * x, &w);
            add(row, -2.0 * y, &v);
        }
        mirrors.push((from, v));
    }
    let mut vectors: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for (from, v) in mirrors.iter().rev() {
        for row in &mut vectors[*from..] {
            let along = dot(&row[*from..], v);
            add(&mut row[*from..], -2.0 * along, v);
        }
    }
    ((0..n).map(|i| a[i * n + i]).collect(), beside, vectors)
}

/// One QL step on a part in which nothing beside the diagonal is nothing.
fn chase(diagonal: &mut [f64], beside: &mut [f64], vectors: &mut [Vec<f64>]) {
    let last = diagonal.len() - 1;
    // the shift is the eigenvalue of the first two that is nearer to the first
    let half = (diagonal[1] - diagonal[0]) / (2.0 * beside[0]);
    let root = sqrt(half * half + 1.0).copysign(half);
    let mut g = diagonal[last] - diagonal[0] + beside[0] / (half + root);
    let (mut sine, mut cosine, mut carried) = (1.0, 1.0, 0.0);
    for i in (0..last).rev() {
        let (f, b) = (sine * beside[i], cosine * beside[i]);
        let size = sqrt(f * f + g * g);
        beside[i + 1] = size;
        if size == 0.0 {
            // it falls into two parts here
            diagonal[i + 1] -= carried;
            beside[last] = 0.0;
            return;
        }
        (sine, cosine) = (f / size, g / size);
        let d = diagonal[i + 1] - carried;
        let r = (diagonal[i] - d) * sine + 2.0 * cosine * b;
        carried = sine * r;
        diagonal[i + 1] = d + carried;
        g = cosine * r - b;
        let (head, tail) = vectors.split_at_mut(i + 1);
        for (x, y) in head[i].iter_mut().zip(&mut tail[0]) {
            (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
        }
    }
    diagonal[0] -= carried;
    beside[0] = g;
    beside[last] = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks `A v = value v` for each, and that the vectors are orthonormal.
    fn check(a: &[f64], n: usize) -> Vec<f64> {
        let (mut values, vectors) = eigen(a.to_vec(), n);
        for (i, (value, v)) in values.iter().zip(&vectors).enumerate() {
            for row in 0..n {
                let residual = dot(&a[row * n..][..n], v) - value * v[row];
                assert!(residual.abs() < 1e-12, "{value}: {residual}");
            }
            for (j, other) in vectors.iter().enumerate() {
                let wanted = f64::from(u8::from(i == j));
                assert!((dot(v, other) - wanted).abs() < 1e-13, "{i} {j}");
            }
        }
        values.sort_by(f64::total_cmp);
        values
    }

    /// The second differences of a chain have the eigenvalues 2 - 2 cos(k pi / (n + 1)).
    #[test]
    fn a_chain_has_its_known_eigenvalues() {
        let n = 40;
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        };
        let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        for (k, value) in (1u8..).zip(check(&a, n)) {
            let wanted = 2.0 - 2.0 * base::number::cos(f64::from(k) * std::f64::consts::PI / 41.0);
            assert!((value - wanted).abs() < 1e-13, "{value} {wanted}");
        }
    }

    #[test]
    fn few_directions_leave_many_free() {
        // u u' + w w' with u = 1, w = (0, 1, ..., n - 1) less its mean: two eigenvalues, u u and w w
        let n = 30;
        let w: Vec<f64> = (0u8..30).map(|i| f64::from(i) / 10.0 - 1.45).collect();
        let a: Vec<f64> = (0..n * n).map(|k| 1.0 + w[k / n] * w[k % n]).collect();
        let values = check(&a, n);
        assert!(values[..n - 2].iter().all(|v| v.abs() < 1e-13), "{values:?}");
        // 30 (30^2 - 1) / 12 / 100
        assert!((values[n - 2] - 22.475).abs() < 1e-12 && (values[n - 1] - 30.0).abs() < 1e-12);
    }

    #[test]
    fn a_diagonal_matrix_keeps_its_axes() {
        let n = 20;
        let a: Vec<f64> = (0..n * n).map(|k| if k / n == k % n { 3.0 } else { 0.0 }).collect();
        let (values, vectors) = eigen(a, n);
        for i in 0..n {
            assert_eq!((values[i], vectors[i][i]), (3.0, 1.0));
        }
    }
}
