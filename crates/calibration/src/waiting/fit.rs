//! Fits the hidden process to all drivers.

use rayon::prelude::*;

use super::design::{Design, MOST_NODES};
use super::likelihood::{Look, Memory, Numbers};
use super::parameters::Layout;
use crate::matrix::{Cholesky, Matrix, add};
use crate::maximise::{EXACT, Maximum, ROUGH, maximise};
use crate::measures::Prediction;
use crate::prior::Prior;

/// Drivers whose gradients are added up in one place: results do not depend on the number of threads.
const CHUNK: usize = 32;
/// Step of the differences of gradients, as a share of a standard error.
const DIFFERENCE: f64 = 1e-4;

/// What is assumed in a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Assumptions {
    /// The prior of all parameters; its means are where the search begins.
    pub prior: Prior,
    /// Parameters that keep the mean of their prior.
    pub is_fixed: Vec<bool>,
    /// Whether drivers have intercepts of their own.
    pub has_spread: bool,
}

impl Assumptions {
    /// The same for drivers who have no intercepts of their own: quicker by far, and good enough for all that is
    /// compared between fits.
    pub fn without_spread(mut self, design: &Design) -> Assumptions {
        self.is_fixed[Layout::of(design).spread()] = true;
        Assumptions { has_spread: false, ..self }
    }

    /// The same with parameter `at` held at `value`.
    pub fn holding(mut self, at: usize, value: f64) -> Assumptions {
        self.prior.means[at] = value;
        self.is_fixed[at] = true;
        self
    }
}

/// A fit of the hidden process.
#[derive(Clone, Debug, PartialEq)]
pub struct WaitingFit {
    /// Where each parameter stands.
    pub layout: Layout,
    /// The estimates of all parameters.
    pub estimates: Vec<f64>,
    /// Their covariance: the inverse of the information, with that of the prior; 0 for fixed parameters.
    pub covariance: Matrix,
    /// Logarithm of the likelihood at the estimates, without the prior.
    pub log_likelihood: f64,
    /// Whether the maximum was found.
    pub is_converged: bool,
}

impl WaitingFit {
    /// The standard error of a parameter.
    pub fn standard_error(&self, parameter: usize) -> f64 {
        self.covariance[(parameter, parameter)].max(0.0).sqrt()
    }
}

impl Design {
    /// Fits the process to the drivers, each of which counts as often as `weights` says.
    pub fn fit(&self, assumptions: &Assumptions, weights: &[f64]) -> WaitingFit {
        self.fit_from(assumptions, weights, None)
    }

    /// The same; the search begins at the estimates of a similar fit, if there is one.
    pub fn fit_from(
        &self,
        assumptions: &Assumptions,
        weights: &[f64],
        similar: Option<&WaitingFit>,
    ) -> WaitingFit {
        Problem::new(self, assumptions, weights).fit(similar, EXACT, Problem::information)
    }

    /// The same to a hundredth of a standard error, with errors by the squares of the drivers' scores alone: quicker,
    /// and good enough for spreads.
    pub fn fit_roughly(
        &self,
        assumptions: &Assumptions,
        weights: &[f64],
        similar: Option<&WaitingFit>,
    ) -> WaitingFit {
        Problem::new(self, assumptions, weights).fit(similar, ROUGH, Problem::information_by_scores)
    }

    /// The estimates of a bootstrap, each by one step from the maximum `estimates` for the drivers with `weights`, on
    /// which the maximum of a draw lies but for terms of second order (Hu, Kalbfleisch 2000). `draws` has how often
    /// each driver counts in each draw. `covariance` is that of the estimates; `None`: by the squares of the drivers'
    /// scores.
    pub fn redrawn(
        &self,
        assumptions: &Assumptions,
        weights: &[f64],
        (estimates, covariance): (&[f64], Option<&Matrix>),
        draws: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let problem = Problem::new(self, assumptions, weights);
        let at = problem.reduced(estimates);
        let scores = problem.scores(&at);
        let covariance = covariance
            .map_or_else(|| inverse_of(problem.information_of(&scores)), |it| it.part(&problem.free));
        let step = |draw: &Vec<f64>| {
            let mut sum = vec![0.0; at.len()];
            for (driver, score) in scores.iter().enumerate() {
                add(&mut sum, (draw[driver] - 1.0) * weights[driver], score);
            }
            let mut there = at.clone();
            add(&mut there, 1.0, &covariance.times(&sum));
            problem.full(&there)
        };
        draws.par_iter().map(step).collect()
    }

    /// The same to a hundredth of a standard error, from other estimates on, without errors: for one of many resamples.
    /// `covariance` is that of a fit to all drivers.
    pub fn refit(
        &self,
        assumptions: &Assumptions,
        weights: &[f64],
        start: &[f64],
        covariance: &Matrix,
    ) -> Vec<f64> {
        let problem = Problem::new(self, assumptions, weights);
        let inverse = covariance.part(&problem.free);
        let found = maximise(problem.reduced(start), inverse, ROUGH, |it| problem.evaluate(it));
        problem.full(&found.at)
    }

    /// The gradient of the log-likelihood of all drivers by all parameters, without the prior.
    pub fn gradient(&self, assumptions: &Assumptions, weights: &[f64], estimates: &[f64]) -> Vec<f64> {
        Problem::new(self, assumptions, weights).likelihood(estimates).1
    }

    /// The log-likelihood of each driver that counts; 0 of those whose weight is 0.
    pub fn log_likelihoods(&self, estimates: &[f64], has_spread: bool, weights: &[f64]) -> Vec<f64> {
        let numbers = Numbers::new(Layout::of(self), estimates, has_spread);
        let of = |memory: &mut Memories, (driver, weight): (_, &f64)| {
            let look = Look { design: self, driver, numbers: &numbers };
            if *weight > 0.0 { memory.evaluate(&look, None, 1.0) } else { 0.0 }
        };
        self.drivers.par_iter().zip(weights).map_init(Memories::default, of).collect()
    }
}

/// Memory for drivers with one desired speed, and with several.
#[derive(Default)]
struct Memories {
    one: Memory<1>,
    several: Memory<MOST_NODES>,
}

impl Memories {
    fn evaluate(&mut self, look: &Look, gradient: Option<&mut [f64]>, weight: f64) -> f64 {
        match look.design.nodes {
            1 => look.evaluate(&mut self.one, gradient, weight),
            _ => look.evaluate(&mut self.several, gradient, weight),
        }
    }
}

impl Design {
    /// For each row the chance per second of a desire for its side, in the mean over the possible desired speeds of the
    /// driver, given no desire yet.
    pub fn desires(&self, estimates: &[f64]) -> Vec<f64> {
        let layout = Layout::of(self);
        let numbers = Numbers::new(layout, estimates, false);
        let of = |memory: &mut Memories, driver: &super::design::Driver| {
            let look = Look { design: self, driver, numbers: &numbers };
            match self.nodes {
                1 => look.desires(&mut memory.one),
                _ => look.desires(&mut memory.several),
            }
        };
        self.drivers.par_iter().map_init(Memories::default, of).flatten_iter().collect()
    }

    /// For each second of each driver that counts the predicted chance that a change begins, and whether one did.
    pub fn predictions(&self, estimates: &[f64], weights: &[f64]) -> Vec<Prediction> {
        let numbers = Numbers::new(Layout::of(self), estimates, false);
        let of = |memory: &mut Memories, (driver, _): (_, &f64)| {
            let look = Look { design: self, driver, numbers: &numbers };
            match self.nodes {
                1 => look.predict(&mut memory.one),
                _ => look.predict(&mut memory.several),
            }
        };
        let counting = self.drivers.par_iter().zip(weights).filter(|it| *it.1 > 0.0);
        counting.map_init(Memories::default, of).flatten_iter().collect()
    }
}

/// A fit under way.
struct Problem<'a> {
    design: &'a Design,
    assumptions: &'a Assumptions,
    weights: &'a [f64],
    layout: Layout,
    /// The parameters that are not fixed.
    free: Vec<usize>,
}

impl<'a> Problem<'a> {
    fn new(design: &'a Design, assumptions: &'a Assumptions, weights: &'a [f64]) -> Problem<'a> {
        let layout = Layout::of(design);
        let free = (0..layout.count()).filter(|it| !assumptions.is_fixed[*it]).collect();
        Problem { design, assumptions, weights, layout, free }
    }

    /// The maximum, from the estimates of a similar fit on, if there is one.
    fn solve(&self, similar: Option<&WaitingFit>, least_gain: f64) -> Maximum {
        let start = self.reduced(similar.map_or(&self.assumptions.prior.means, |it| &it.estimates));
        let inverse = match similar {
            Some(it) => it.covariance.part(&self.free),
            None => inverse_of(self.information_by_scores(&start)),
        };
        maximise(start, inverse, least_gain, |it| self.evaluate(it))
    }

    fn reduced(&self, all: &[f64]) -> Vec<f64> {
        self.free.iter().map(|it| all[*it]).collect()
    }

    fn full(&self, reduced: &[f64]) -> Vec<f64> {
        let mut all = self.assumptions.prior.means.clone();
        self.free.iter().zip(reduced).for_each(|(at, value)| all[*at] = *value);
        all
    }

    /// Log-likelihood and its gradient by all parameters, without the prior.
    fn likelihood(&self, all: &[f64]) -> (f64, Vec<f64>) {
        let numbers = Numbers::new(self.layout, all, self.assumptions.has_spread);
        let chunk = |memory: &mut Memories, number: usize| {
            let mut gradient = vec![0.0; self.layout.count()];
            let mut sum = 0.0;
            let end = ((number + 1) * CHUNK).min(self.design.drivers.len());
            for at in number * CHUNK..end {
                let (driver, weight) = (&self.design.drivers[at], self.weights[at]);
                if weight > 0.0 {
                    let look = Look { design: self.design, driver, numbers: &numbers };
                    sum += weight * memory.evaluate(&look, Some(&mut gradient), weight);
                }
            }
            (sum, gradient)
        };
        let chunks = self.design.drivers.len().div_ceil(CHUNK);
        let parts: Vec<(f64, Vec<f64>)> =
            (0..chunks).into_par_iter().map_init(Memories::default, chunk).collect();
        let mut whole = (0.0, vec![0.0; self.layout.count()]);
        for (sum, gradient) in parts {
            whole.0 += sum;
            whole.1.iter_mut().zip(gradient).for_each(|(it, more)| *it += more);
        }
        whole
    }

    /// Likelihood and prior with the gradient by the free parameters.
    fn evaluate(&self, reduced: &[f64]) -> (f64, Vec<f64>) {
        let all = self.full(reduced);
        let (value, mut gradient) = self.likelihood(&all);
        self.assumptions.prior.add_gradient(&all, &mut gradient);
        (value + self.assumptions.prior.log_density(&all), self.reduced(&gradient))
    }

    /// The gradient of each driver's log-likelihood by the free parameters.
    fn scores(&self, reduced: &[f64]) -> Vec<Vec<f64>> {
        let all = self.full(reduced);
        let numbers = Numbers::new(self.layout, &all, self.assumptions.has_spread);
        let of = |memory: &mut Memories, driver| {
            let mut gradient = vec![0.0; self.layout.count()];
            let look = Look { design: self.design, driver, numbers: &numbers };
            memory.evaluate(&look, Some(&mut gradient), 1.0);
            self.reduced(&gradient)
        };
        self.design.drivers.par_iter().map_init(Memories::default, of).collect()
    }

    /// The information by the squares of the drivers' scores (Berndt, Hall, Hall, Hausman 1974), with that of the
    /// prior.
    fn information_by_scores(&self, reduced: &[f64]) -> Matrix {
        self.information_of(&self.scores(reduced))
    }

    /// The same of known scores.
    fn information_of(&self, scores: &[Vec<f64>]) -> Matrix {
        let mut information = self.information_of_prior();
        for (score, weight) in scores.iter().zip(self.weights) {
            information.add_outer(*weight, score, score);
        }
        information
    }

    fn information_of_prior(&self) -> Matrix {
        Matrix::from_diagonal(&self.reduced(&self.assumptions.prior.precisions))
    }

    /// The negative Hessian: by differences of gradients in the rows of all parameters but the places', among which it
    /// is that by scores.
    fn information(&self, at: &[f64]) -> Matrix {
        let by_scores = self.information_by_scores(at);
        let errors: Vec<f64> =
            inverse_of(by_scores.clone()).diagonal().map(|it| it.max(0.0).sqrt()).collect();
        let mut information = by_scores.clone();
        let is_place = |it: &usize| self.layout.places().contains(it);
        for column in self.free.iter().position(is_place).map_or(0..self.free.len(), |it| 0..it) {
            let step = DIFFERENCE * errors[column].clamp(1e-3, 1e3);
            let [above, below] = [step, -step].map(|it| {
                let mut at = at.to_vec();
                at[column] += it;
                self.evaluate(&at).1
            });
            let slope = below.iter().zip(&above).map(|(below, above)| (below - above) / (2.0 * step));
            information.set_row_and_column(column, &slope.collect::<Vec<f64>>());
        }
        if Cholesky::of(&information).is_some() { information } else { by_scores }
    }

    /// The maximum, with errors by the `information` there.
    fn fit(
        &self,
        similar: Option<&WaitingFit>,
        least_gain: f64,
        information: fn(&Problem<'a>, &[f64]) -> Matrix,
    ) -> WaitingFit {
        let Maximum { at, is_converged, .. } = self.solve(similar, least_gain);
        let covariance = inverse_of(information(self, &at));
        let mut whole = Matrix::zeros(self.layout.count());
        for (row, to) in self.free.iter().enumerate() {
            for (column, from) in self.free.iter().enumerate() {
                whole[(*to, *from)] = covariance[(row, column)];
            }
        }
        let all = self.full(&at);
        let log_likelihood = self.likelihood(&all).0;
        WaitingFit { layout: self.layout, estimates: all, covariance: whole, log_likelihood, is_converged }
    }
}

/// The inverse of an information matrix. Directions of which nothing is known get a small one. Where a value is not a
/// number, no variance is one.
fn inverse_of(mut information: Matrix) -> Matrix {
    let mut ridge = 1e-10 * information.diagonal().fold(1e-6, f64::max);
    while ridge.is_finite() {
        if let Some(it) = Cholesky::of(&information) {
            return it.inverse();
        }
        (0..information.size()).for_each(|it| information[(it, it)] += ridge);
        ridge *= 10.0;
    }
    Matrix::from_diagonal(&vec![f64::NAN; information.size()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_information_without_numbers_has_an_inverse_without_numbers() {
        let mut information = Matrix::from_diagonal(&[1.0, 1.0]);
        information[(1, 0)] = f64::NAN;
        assert!(inverse_of(information).diagonal().all(f64::is_nan));
    }
}
