//! Small dense matrices: of curvatures and covariances. Vectors are slices.

use std::ops::{Index, IndexMut};

/// A dense square matrix. Most are symmetric.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    size: usize,
    /// Row after row.
    values: Vec<f64>,
}

impl Matrix {
    /// Zeros in `size` rows and columns.
    pub fn zeros(size: usize) -> Matrix {
        Matrix { size, values: vec![0.0; size * size] }
    }

    /// `diagonal` on the diagonal, and zeros beside it.
    pub fn from_diagonal(diagonal: &[f64]) -> Matrix {
        let mut matrix = Matrix::zeros(diagonal.len());
        diagonal.iter().enumerate().for_each(|(at, value)| matrix[(at, at)] = *value);
        matrix
    }

    /// Number of its rows, which is that of its columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The values on its diagonal.
    pub fn diagonal(&self) -> impl Iterator<Item = f64> {
        (0..self.size).map(|at| self[(at, at)])
    }

    /// The rows and columns `chosen`, in that order.
    pub fn part(&self, chosen: &[usize]) -> Matrix {
        let values = chosen.iter().flat_map(|row| chosen.iter().map(|column| self[(*row, *column)]));
        Matrix { size: chosen.len(), values: values.collect() }
    }

    /// The product with a vector.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        (0..self.size).map(|row| dot(self.row(row), vector)).collect()
    }

    /// Adds `factor` · `left` `right`ᵀ.
    pub fn add_outer(&mut self, factor: f64, left: &[f64], right: &[f64]) {
        for (row, value) in left.iter().enumerate() {
            let scaled = factor * value;
            if scaled != 0.0 {
                add(self.row_mut(row), scaled, right);
            }
        }
    }

    /// Replaces a row and the column of the same number by `values`.
    pub fn set_row_and_column(&mut self, at: usize, values: &[f64]) {
        self.row_mut(at).copy_from_slice(values);
        values.iter().enumerate().for_each(|(row, value)| self[(row, at)] = *value);
    }

    /// Multiplies a row, and then the column of the same number, by `factor`: a covariance becomes that of parameters
    /// of which this one is `factor` times as large.
    pub fn scale_row_and_column(&mut self, at: usize, factor: f64) {
        self.row_mut(at).iter_mut().for_each(|it| *it *= factor);
        (0..self.size).for_each(|row| self[(row, at)] *= factor);
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.size..][..self.size]
    }

    fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.values[row * self.size..][..self.size]
    }
}

/// The value of a row and a column.
impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.row(row)[column]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.row_mut(row)[column]
    }
}

/// A symmetric, positive definite matrix A as L Lᵀ, with zeros above the diagonal of L (Cholesky).
pub(crate) struct Cholesky {
    lower: Matrix,
}

impl Cholesky {
    /// Factors `matrix` column by column (Golub, Van Loan 2013, algorithm 4.2.1). Values above the diagonal are not
    /// read. `None` if the matrix is not positive definite, or if one of its values is not a number.
    pub(crate) fn of(matrix: &Matrix) -> Option<Cholesky> {
        let mut lower = Matrix::zeros(matrix.size);
        let rest = |lower: &Matrix, row: usize, column: usize| {
            matrix[(row, column)] - dot(&lower.row(row)[..column], &lower.row(column)[..column])
        };
        for column in 0..matrix.size {
            let square = rest(&lower, column, column);
            if square.is_nan() || square <= 0.0 {
                return None;
            }
            let pivot = square.sqrt();
            lower[(column, column)] = pivot;
            for row in column + 1..matrix.size {
                lower[(row, column)] = rest(&lower, row, column) / pivot;
            }
        }
        Some(Cholesky { lower })
    }

    /// The x with A x = `right`: forward by rows, then back by columns (Golub, Van Loan 2013, section 3.1).
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for at in 0..x.len() {
            let row = self.lower.row(at);
            x[at] = (x[at] - dot(&row[..at], &x[..at])) / row[at];
        }
        for at in (0..x.len()).rev() {
            let row = self.lower.row(at);
            x[at] /= row[at];
            let (before, rest) = x.split_at_mut(at);
            add(before, -rest[0], &row[..at]);
        }
        x
    }

    /// The logarithm of the determinant of A.
    pub(crate) fn log_determinant(&self) -> f64 {
        2.0 * self.lower.diagonal().map(libm::log).sum::<f64>()
    }

    /// The inverse of A. It is symmetric: what solves for a column is written as a row.
    pub(crate) fn inverse(&self) -> Matrix {
        let mut inverse = Matrix::zeros(self.lower.size);
        let mut unit = vec![0.0; inverse.size];
        for at in 0..inverse.size {
            unit[at] = 1.0;
            inverse.row_mut(at).copy_from_slice(&self.solve(&unit));
            unit[at] = 0.0;
        }
        inverse
    }
}

/// The scalar product of two vectors.
pub(crate) fn dot(left: &[f64], right: &[f64]) -> f64 {
    debug_assert_eq!(left.len(), right.len());
    left.iter().zip(right).map(|(left, right)| left * right).sum()
}

/// The length of a vector.
pub(crate) fn norm(vector: &[f64]) -> f64 {
    dot(vector, vector).sqrt()
}

/// Adds `factor` · `more` to a vector.
pub(crate) fn add(vector: &mut [f64], factor: f64, more: &[f64]) {
    debug_assert_eq!(vector.len(), more.len());
    vector.iter_mut().zip(more).for_each(|(it, more)| *it += factor * more);
}

#[cfg(test)]
mod tests {
    use proptest::collection::vec;
    use proptest::prelude::*;

    use super::*;

    fn matrix(rows: &[&[f64]]) -> Matrix {
        Matrix { size: rows.len(), values: rows.concat() }
    }

    #[test]
    fn a_covariance_is_scaled_like_its_parameter() {
        let mut covariance = matrix(&[&[4.0, 1.0], &[1.0, 9.0]]);
        covariance.scale_row_and_column(1, 3.0);
        assert_eq!(covariance, matrix(&[&[4.0, 3.0], &[3.0, 81.0]]));
    }

    #[test]
    fn outer_products_and_rows_are_where_they_belong() {
        let mut sum = Matrix::from_diagonal(&[1.0, 2.0, 0.0]);
        sum.add_outer(2.0, &[1.0, 0.0, 3.0], &[1.0, 2.0, 3.0]);
        assert_eq!(sum, matrix(&[&[3.0, 4.0, 6.0], &[0.0, 2.0, 0.0], &[6.0, 12.0, 18.0]]));
        assert_eq!(sum.times(&[1.0, -1.0, 0.5]), [2.0, -2.0, 3.0]);
        assert_eq!(sum.part(&[2, 0]), matrix(&[&[18.0, 6.0], &[6.0, 3.0]]));
        sum.set_row_and_column(1, &[7.0, 8.0, 9.0]);
        assert_eq!(sum, matrix(&[&[3.0, 7.0, 6.0], &[7.0, 8.0, 9.0], &[6.0, 9.0, 18.0]]));
        assert_eq!(sum.diagonal().collect::<Vec<f64>>(), [3.0, 8.0, 18.0]);
    }

    #[test]
    fn whole_numbers_are_factored_solved_and_inverted_exactly() {
        let product = matrix(&[&[4.0, 12.0, -16.0], &[12.0, 37.0, -43.0], &[-16.0, -43.0, 98.0]]);
        let factored = Cholesky::of(&product).unwrap();
        assert_eq!(factored.lower, matrix(&[&[2.0, 0.0, 0.0], &[6.0, 1.0, 0.0], &[-8.0, 5.0, 3.0]]));
        assert_eq!(factored.solve(&[-20.0, -43.0, 192.0]), [1.0, 2.0, 3.0]);
        let halves = Cholesky::of(&matrix(&[&[4.0, 2.0], &[2.0, 17.0]])).unwrap();
        assert_eq!(halves.inverse(), matrix(&[&[0.265625, -0.03125], &[-0.03125, 0.0625]]));
    }

    #[test]
    fn what_is_not_positive_definite_is_refused() {
        let refused = |rows: &[&[f64]]| assert!(Cholesky::of(&matrix(rows)).is_none(), "{rows:?}");
        refused(&[&[0.0]]);
        refused(&[&[-1.0]]);
        refused(&[&[1.0, 1.0], &[1.0, 1.0]]);
        refused(&[&[1.0, 2.0], &[2.0, 1.0]]);
        refused(&[&[f64::NAN, 0.0], &[0.0, 1.0]]);
        refused(&[&[1.0, f64::NAN], &[f64::NAN, 1.0]]);
        refused(&[&[1.0, f64::INFINITY], &[f64::INFINITY, 1.0]]);
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn what_solves_is_a_solution_and_the_inverse_inverts(
            vectors in (1..9_usize).prop_flat_map(|size| vec(vec(-1.0..1.0_f64, size), size + 1)),
        ) {
            // The last vector is the right-hand side; the others and the identity make a matrix whose eigenvalues are
            // between 1 and 65.
            let (right, others) = vectors.split_last().unwrap();
            let mut sum = Matrix::from_diagonal(&vec![1.0; right.len()]);
            others.iter().for_each(|it| sum.add_outer(1.0, it, it));
            let factored = Cholesky::of(&sum).unwrap();
            let near = |found: &[f64], exact: &[f64]| found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-13);
            prop_assert!(near(&sum.times(&factored.solve(right)), right));
            let inverse = factored.inverse();
            for at in 0..sum.size() {
                let mut unit = vec![0.0; sum.size()];
                unit[at] = 1.0;
                prop_assert!(near(&inverse.times(&sum.times(&unit)), &unit));
            }
        }
    }
}
