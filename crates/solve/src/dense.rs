//! Dense kernels: LU with partial pivoting, an orthonormal null space, symmetric eigenvectors.
//!
//! Matrices are row-major slices. Every sum runs in one written order, so the bits are the same
//! everywhere. Blocks are small: cost is cubic.

mod tridiagonal;

/// What a factorisation tells besides its factors.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Factors {
    /// Sign of the determinant; zero where a pivot vanished.
    pub(crate) sign: i8,
    /// The smallest pivot as a part of the largest; a rough measure of how singular it is.
    pub(crate) ratio: f64,
}

/// Factorises `a` (`n` by `n`) in place; `swaps[k]` is the row that was exchanged with row `k`.
pub(crate) fn factorise(a: &mut [f64], n: usize, swaps: &mut Vec<usize>) -> Factors {
    swaps.clear();
    if let (2, Some(a)) = (n, a.first_chunk_mut()) {
        return factorise_two(a, swaps);
    }
    let a = &mut a[..n * n];
    let mut sign = 1i8;
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for k in 0..n {
        let (mut best, mut size) = (k, a[k * n + k].abs());
        for (i, value) in (k + 1..n).zip(a[k * n + k..].iter().skip(n).step_by(n)) {
            if value.abs() > size {
                (best, size) = (i, value.abs());
            }
        }
        swaps.push(best);
        let (above, below) = a.split_at_mut((k + 1) * n);
        let first = &mut above[k * n..];
        if best != k {
            first.swap_with_slice(&mut below[(best - k - 1) * n..][..n]);
            sign = -sign;
        }
        let pivot = first[k];
        least = least.min(pivot.abs());
        most = most.max(pivot.abs());
        if pivot == 0.0 || !pivot.is_finite() {
            return Factors { sign: 0, ratio: 0.0 };
        }
        if pivot < 0.0 {
            sign = -sign;
        }
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / pivot;
            row[k] = factor;
            if factor != 0.0 {
                add(&mut row[k + 1..], -factor, &first[k + 1..]);
            }
        }
    }
    Factors { sign, ratio: if n == 0 { 1.0 } else { least / most } }
}

/// The same of two by two.
fn factorise_two(a: &mut [f64; 4], swaps: &mut Vec<usize>) -> Factors {
    const SINGULAR: Factors = Factors { sign: 0, ratio: 0.0 };
    let is_swapped = a[2].abs() > a[0].abs();
    if is_swapped {
        *a = [a[2], a[3], a[0], a[1]];
    }
    swaps.push(usize::from(is_swapped));
    let first = a[0];
    if first == 0.0 || !first.is_finite() {
        return SINGULAR;
    }
    let factor = a[2] / first;
    a[2] = factor;
    if factor != 0.0 {
        a[3] += -factor * a[1];
    }
    swaps.push(1);
    let second = a[3];
    if second == 0.0 || !second.is_finite() {
        return SINGULAR;
    }
    let is_negative = is_swapped ^ (first < 0.0) ^ (second < 0.0);
    let (least, most) = (first.abs().min(second.abs()), first.abs().max(second.abs()));
    Factors { sign: if is_negative { -1 } else { 1 }, ratio: least / most }
}

/// Eliminates `a` (`n` by `n`) in place in an order that was chosen for another matrix; what is not finite comes of a
/// pivot that vanishes.
pub(crate) fn eliminate(a: &mut [f64], n: usize, swaps: &[usize]) {
    for (k, &other) in swaps.iter().enumerate() {
        let (above, below) = a[..n * n].split_at_mut((k + 1) * n);
        let first = &mut above[k * n..];
        if other != k {
            first.swap_with_slice(&mut below[(other - k - 1) * n..][..n]);
        }
        for row in below.chunks_exact_mut(n) {
            let factor = row[k] / first[k];
            add(&mut row[k + 1..], -factor, &first[k + 1..]);
        }
    }
}

/// Solves with the factors; `b` becomes the solution.
pub(crate) fn substitute_back(a: &[f64], n: usize, swaps: &[usize], b: &mut [f64]) {
    // rows were exchanged as wholes, multipliers included
    for (k, &other) in swaps.iter().enumerate() {
        b.swap(k, other);
    }
    let rows = || a[..n * n].chunks_exact(n.max(1)).enumerate();
    for (i, row) in rows() {
        let (known, rest) = b.split_at_mut(i);
        take_off(&mut rest[0], &row[..i], known);
    }
    for (k, row) in rows().rev() {
        let (rest, known) = b.split_at_mut(k + 1);
        take_off(&mut rest[k], &row[k + 1..], known);
        rest[k] /= row[k];
    }
}

/// Takes products off a value, one after the other.
fn take_off(value: &mut f64, factors: &[f64], of: &[f64]) {
    for (factor, x) in factors.iter().zip(of) {
        *value -= factor * x;
    }
}

/// Orthonormal bases of the row space of a matrix and of its complement.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spaces {
    /// Basis vectors of the row space, one after the other.
    pub(crate) range: Vec<Vec<f64>>,
    /// Basis vectors of the null space.
    pub(crate) null: Vec<Vec<f64>>,
}

/// Splits the space of `n` numbers by the rows: Gram and Schmidt, twice, largest remainder first.
pub(crate) fn spaces(rows: &[Vec<f64>], n: usize) -> Spaces {
    const DEPENDENT: f64 = 1e-10;
    let mut rest: Vec<Vec<f64>> = rows.to_vec();
    let sizes: Vec<f64> = rest.iter().map(|r| norm(r)).collect();
    let mut out = Spaces::default();
    let mut left: Vec<usize> = (0..rows.len()).collect();
    while out.range.len() < n && !left.is_empty() {
        let mut best = 0;
        for i in 1..left.len() {
            if norm(&rest[left[i]]) > norm(&rest[left[best]]) {
                best = i;
            }
        }
        let row = left.remove(best);
        let mut v = std::mem::take(&mut rest[row]);
        orthogonalise(&mut v, &out.range);
        let size = norm(&v);
        if size <= DEPENDENT * sizes[row] || size == 0.0 {
            continue;
        }
        scale(&mut v, 1.0 / size);
        for &i in &left {
            let along = dot(&v, &rest[i]);
            add(&mut rest[i], -along, &v);
        }
        out.range.push(v);
    }
    complete(&mut out, n);
    out
}

/// Fills the null space with what unit vectors add, the least covered first.
fn complete(out: &mut Spaces, n: usize) {
    let mut uncovered: Vec<f64> =
        (0..n).map(|j| 1.0 - out.range.iter().map(|q| q[j] * q[j]).sum::<f64>()).collect();
    while out.range.len() + out.null.len() < n {
        let mut best = 0;
        for j in 1..n {
            if uncovered[j] > uncovered[best] {
                best = j;
            }
        }
        let mut v = vec![0.0; n];
        v[best] = 1.0;
        for _ in 0..2 {
            orthogonalise(&mut v, &out.range);
            orthogonalise(&mut v, &out.null);
        }
        let size = norm(&v);
        scale(&mut v, 1.0 / size);
        for j in 0..n {
            uncovered[j] -= v[j] * v[j];
        }
        out.null.push(v);
    }
}

fn orthogonalise(v: &mut [f64], basis: &[Vec<f64>]) {
    for q in basis {
        let along = dot(q, v);
        add(v, -along, q);
    }
}

/// Returns the scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (x, y) in a.iter().zip(b) {
        sum += x * y;
    }
    sum
}

/// Returns the Euclidean length.
pub(crate) fn norm(a: &[f64]) -> f64 {
    base::number::sqrt(dot(a, a))
}

/// Adds `factor * b` to `a`.
pub(crate) fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x += factor * y;
    }
}

fn scale(a: &mut [f64], factor: f64) {
    for x in a {
        *x *= factor;
    }
}

/// The largest symmetric matrix whose eigenvectors are found by Jacobi's rotations: these are the most exact, at ten
/// times the work where the matrix is large.
const JACOBI: usize = 16;

/// Eigenvalues and eigenvectors of a symmetric `n` by `n` matrix, in no order.
pub(crate) fn eigen(a: Vec<f64>, n: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    if n <= JACOBI { by_rotations(a, n) } else { tridiagonal::eigen(a, n) }
}

fn by_rotations(mut a: Vec<f64>, n: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut vectors: Vec<Vec<f64>> =
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    let total: f64 = dot(&a, &a);
    for _ in 0..60 {
        let mut off = 0.0;
        for p in 0..n {
            for q in p + 1..n {
                off += a[p * n + q] * a[p * n + q];
            }
        }
        if off <= 1e-30 * total {
            break;
        }
        for p in 0..n {
            for q in p + 1..n {
                rotate(&mut a, &mut vectors, n, p, q);
            }
        }
    }
    ((0..n).map(|i| a[i * n + i]).collect(), vectors)
}

fn rotate(a: &mut [f64], vectors: &mut [Vec<f64>], n: usize, p: usize, q: usize) {
    let apq = a[p * n + q];
    if apq == 0.0 {
        return;
    }
    let theta = (a[q * n + q] - a[p * n + p]) / (2.0 * apq);
    let t = theta.signum() / (theta.abs() + base::number::sqrt(theta * theta + 1.0));
    let c = 1.0 / base::number::sqrt(t * t + 1.0);
    let s = t * c;
    for k in 0..n {
        let (x, y) = (a[k * n + p], a[k * n + q]);
        a[k * n + p] = c * x - s * y;
        a[k * n + q] = s * x + c * y;
    }
    for k in 0..n {
        let (x, y) = (a[p * n + k], a[q * n + k]);
        a[p * n + k] = c * x - s * y;
        a[q * n + k] = s * x + c * y;
    }
    let (head, tail) = vectors.split_at_mut(q);
    for (x, y) in head[p].iter_mut().zip(&mut tail[0]) {
        (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_singular_matrix_is_told() {
        let mut a = vec![1.0, 2.0, 2.0, 4.0];
        assert_eq!(factorise(&mut a, 2, &mut Vec::new()).sign, 0);
    }

    #[test]
    fn factors_solve_and_tell_the_side() {
        let mut a = vec![0.0, 2.0, 3.0, 1.0];
        let mut swaps = Vec::new();
        let factors = factorise(&mut a, 2, &mut swaps);
        assert_eq!(factors.sign, -1);
        let mut b = vec![4.0, 5.0];
        substitute_back(&a, 2, &swaps, &mut b);
        assert_eq!(b, vec![1.0, 2.0]);
    }

    #[test]
    fn later_exchanges_move_earlier_multipliers() {
        let a = [1.0, 2.0, 0.0, 2.0, 1.0, 1.0, 4.0, 0.0, 1.0];
        let (mut factors, mut swaps) = (a.to_vec(), Vec::new());
        factorise(&mut factors, 3, &mut swaps);
        let mut b = vec![5.0, 7.0, 7.0];
        substitute_back(&factors, 3, &swaps, &mut b);
        for (x, wanted) in b.iter().zip([1.0, 2.0, 3.0]) {
            assert!((x - wanted).abs() < 1e-14, "{b:?}");
        }
    }

    #[test]
    fn a_repeated_row_adds_nothing_to_the_range() {
        let s = spaces(&[vec![1.0, 1.0, 0.0], vec![2.0, 2.0, 0.0]], 3);
        assert_eq!((s.range.len(), s.null.len()), (1, 2));
        for v in &s.null {
            assert!((v[0] + v[1]).abs() < 1e-15);
        }
    }

    #[test]
    fn eigenvectors_diagonalise() {
        let (values, vectors) = eigen(vec![2.0, 1.0, 1.0, 2.0], 2);
        let mut sorted = values.clone();
        sorted.sort_by(f64::total_cmp);
        assert!((sorted[0] - 1.0).abs() < 1e-15 && (sorted[1] - 3.0).abs() < 1e-15);
        for (value, v) in values.iter().zip(&vectors) {
            assert!((2.0 * v[0] + v[1] - value * v[0]).abs() < 1e-14);
        }
    }
}
