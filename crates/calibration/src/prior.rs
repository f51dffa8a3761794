//! What is assumed of parameters before data are seen: independent normal distributions.

/// Independent normal priors of the parameters, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Prior {
    /// Their means.
    pub means: Vec<f64>,
    /// One over their variances; 0: nothing is assumed.
    pub precisions: Vec<f64>,
}

impl Prior {
    /// No assumption about any of `count` parameters.
    pub fn none(count: usize) -> Prior {
        Prior { means: vec![0.0; count], precisions: vec![0.0; count] }
    }

    /// The logarithm of its density at `values`, but for a constant.
    pub fn log_density(&self, values: &[f64]) -> f64 {
        let terms = values.iter().zip(&self.means).zip(&self.precisions);
        terms.map(|((value, mean), precision)| -0.5 * precision * (value - mean) * (value - mean)).sum()
    }

    /// Adds the gradient of that at `values`.
    pub(crate) fn add_gradient(&self, values: &[f64], gradient: &mut [f64]) {
        for (at, slope) in gradient.iter_mut().enumerate() {
            *slope -= self.precisions[at] * (values[at] - self.means[at]);
        }
    }
}
