//! A little dense algebra, plain enough to be believed.

/// What counts as nothing, as a part of a vector's length.
const NOTHING: f64 = 1e-7;
/// How much of a vector has to point into a new direction.
pub(crate) const NEARLY: f64 = 1e-4;

/// The space that some vectors span, by an orthonormal basis.
#[derive(Debug, Default)]
pub(crate) struct Span {
    basis: Vec<Vec<f64>>,
}

impl Span {
    pub(crate) fn of(vectors: impl IntoIterator<Item = Vec<f64>>) -> Self {
        let mut span = Self::default();
        for vector in vectors {
            let size = length(&vector);
            let rest = span.rest(&vector);
            let left = length(&rest);
            if left > NEARLY * size {
                span.basis.push(rest.into_iter().map(|x| x / left).collect());
            }
        }
        span
    }
    /// Returns how many directions there are.
    pub(crate) fn rank(&self) -> usize {
        self.basis.len()
    }
    /// Returns what of a vector is in no direction of the space.
    pub(crate) fn rest(&self, vector: &[f64]) -> Vec<f64> {
        let mut rest = vector.to_vec();
        // twice, so that rounding of the first time is taken out too
        for direction in self.basis.iter().chain(&self.basis) {
            let along = dot(&rest, direction);
            rest.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
        }
        rest
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(crate) fn length(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Returns how much of a vector is left where it is made of these with no factor below zero.
///
/// Every choice among them is tried: they have to be few.
pub(crate) fn rest_of_cone(vector: &[f64], of: &[Vec<f64>]) -> f64 {
    let choices = (0_u32..1 << of.len()).map(|choice| {
        let chosen: Vec<&Vec<f64>> =
            (0..of.len()).filter(|i| choice >> i & 1 == 1).map(|i| &of[i]).collect();
        let Some(factors) = least_squares(&chosen, vector) else { return f64::INFINITY };
        if factors.iter().any(|f| *f < -NOTHING * length(vector)) {
            return f64::INFINITY;
        }
        let mut rest = vector.to_vec();
        for (factor, row) in factors.iter().zip(&chosen) {
            rest.iter_mut().zip(*row).for_each(|(x, r)| *x -= factor * r);
        }
        length(&rest)
    });
    choices.fold(f64::INFINITY, f64::min)
}

/// Returns the factors with which vectors come nearest to another; nothing where they depend on one
/// another.
fn least_squares(of: &[&Vec<f64>], vector: &[f64]) -> Option<Vec<f64>> {
    let n = of.len();
    let mut system: Vec<Vec<f64>> =
        of.iter().map(|a| of.iter().map(|b| dot(a, b)).chain([dot(a, vector)]).collect()).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| system[a][k].abs().total_cmp(&system[b][k].abs()))?;
        system.swap(pivot, k);
        if system[k][k].abs() < NOTHING * NOTHING * dot(of[0], of[0]) {
            return None;
        }
        let row = system[k].clone();
        for (_, other) in system.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k] / row[k];
            other.iter_mut().zip(&row).for_each(|(x, p)| *x -= factor * p);
        }
    }
    Some((0..n).map(|k| system[k][n] / system[k][k]).collect())
}

/// Returns the sign of a determinant; nothing where it is nearly nothing.
pub(crate) fn sign_of_determinant(mut rows: Vec<Vec<f64>>) -> Option<i8> {
    let n = rows.len();
    let mut sign = 1;
    for row in &mut rows {
        let size = length(row);
        if size == 0.0 {
            return None;
        }
        row.iter_mut().for_each(|x| *x /= size);
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()))?;
        if rows[pivot][k].abs() < NEARLY {
            return None;
        }
        if pivot != k {
            rows.swap(pivot, k);
            sign = -sign;
        }
        if rows[k][k] < 0.0 {
            sign = -sign;
        }
        let (above, below) = rows.split_at_mut(k + 1);
        let row = &above[k];
        for other in below {
            let factor = other[k] / row[k];
            other.iter_mut().zip(row).for_each(|(x, p)| *x -= factor * p);
        }
    }
    Some(sign)
}
