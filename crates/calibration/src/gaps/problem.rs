//! The search for the distribution of critical gaps, and for how drivers get from a wish to a change.

use rayon::prelude::*;

use super::offered::OfferedGaps;
use super::table::{GRID, Going, Table, shares};
use crate::matrix::{Cholesky, Matrix, add, dot};
use crate::prior::Prior;
use crate::waiting::{logistic, logit};

/// Number of parameters, and where they stand: mean and logarithm of the standard deviation of the logarithms of
/// critical lead and lag gaps; then what is added to the logits of supposed desires, and the logarithm of what they are
/// multiplied by; the logits of giving up, going and going anyway, per look; and the logarithm of how much drivers
/// differ in what is added.
pub(super) const PARAMETERS: usize = 10;
/// Those of the critical gaps.
pub(super) const GAPS: usize = 4;

/// The parameters.
pub(super) type Parameters = [f64; PARAMETERS];

/// Standard deviation of the prior of the mean of the logarithms of critical gaps: a factor of 2.7 (ours).
pub(super) const MEDIAN_PRIOR: f64 = 1.0;
/// That of the logarithm of their standard deviation (ours), and its mean: the spread is about .5 (Toledo 2003 has .8
/// to 1.1 with what depends on the driver; from memory).
pub(super) const SPREAD_PRIOR: f64 = 0.7;
pub(super) const USUAL_SPREAD: f64 = 0.5;
/// Share of the promised gain that a step has to bring (Armijo).
const GAIN: f64 = 1e-4;
/// Steps of the differences by which slopes are computed.
const DIFFERENCE: f64 = 1e-5;

/// Drivers with what is assumed of them.
pub(super) struct Problem<'a> {
    offered: &'a OfferedGaps,
    /// How often each driver counts.
    weights: &'a [f64],
    pub(super) prior: Prior,
    /// Chance that a driver waits when its spell begins.
    waits: f64,
    /// The parameters that are searched; the others keep the means of the prior.
    free: Vec<usize>,
}

/// What is known of the process before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Before {
    /// Medians of the critical gaps to the new leader and to the new follower, by the prior style [m].
    pub medians: [f64; 2],
    /// Chance per second that who waits gives up.
    pub giving_up: f64,
    /// Chance that a driver waits when its spell begins.
    pub waiting: f64,
}

impl<'a> Problem<'a> {
    pub(super) fn new(offered: &'a OfferedGaps, weights: &'a [f64], before: &Before) -> Problem<'a> {
        let per_look = 1.0 - libm::pow(1.0 - before.giving_up, 1.0 / offered.looks);
        let [lead, lag] = before.medians.map(libm::log);
        let spread = libm::log(USUAL_SPREAD);
        // Most drivers go at once into a gap that suits them; a gap test is no law of nature (ours).
        let means =
            [lead, spread, lag, spread, 0.0, 0.0, logit(per_look), logit(0.7), logit(0.1), libm::log(0.7)];
        let deviations =
            [MEDIAN_PRIOR, SPREAD_PRIOR, MEDIAN_PRIOR, SPREAD_PRIOR, 1.0, 0.5, 0.7, 1.5, 2.0, 0.7];
        let precisions = deviations.iter().map(|it| 1.0 / (it * it)).collect();
        Problem {
            offered,
            weights,
            prior: Prior { means: means.to_vec(), precisions },
            waits: before.waiting,
            free: (0..PARAMETERS).collect(),
        }
    }

    /// The same with some parameters held.
    pub(super) fn holding(mut self, held: &[(usize, f64)]) -> Problem<'a> {
        for (at, value) in held {
            self.prior.means[*at] = *value;
        }
        self.free.retain(|it| held.iter().all(|(at, _)| at != it));
        self
    }

    /// The means of the prior.
    pub(super) fn start(&self) -> Parameters {
        std::array::from_fn(|it| self.prior.means[it])
    }

    fn going(&self, at: &Parameters) -> Going {
        Going {
            desire: [at[4], libm::exp(at[5])],
            gives_up: logistic(at[6]),
            goes: logistic(at[7]),
            goes_anyway: logistic(at[8]),
            waits: self.waits,
            unlike: libm::exp(at[9]),
        }
    }

    /// The tables of all drivers who count; those of the others are none.
    pub(super) fn tables(&self, at: &Parameters) -> Vec<Option<Table>> {
        let going = self.going(at);
        let each = self.offered.drivers.par_iter().zip(self.weights);
        each.map(|(spells, weight)| (*weight > 0.0).then(|| Table::of(spells, &going))).collect()
    }

    /// The log-likelihood of each driver by known tables; 0 of those who do not count.
    pub(super) fn logs(tables: &[Option<Table>], at: &Parameters) -> Vec<f64> {
        let shares = distribution(at);
        tables.iter().map(|it| it.as_ref().map_or(0.0, |it| it.log(&shares))).collect()
    }

    /// Likelihood and prior by known tables.
    pub(super) fn log(&self, tables: &[Option<Table>], at: &Parameters) -> f64 {
        let logs = Problem::logs(tables, at);
        logs.iter().zip(self.weights).map(|(log, weight)| log * weight).sum::<f64>()
            + self.prior.log_density(at)
    }

    /// The slopes of each driver's log-likelihood by the free parameters, by differences. `tables` are those there.
    fn scores(&self, at: &Parameters, tables: &[Option<Table>]) -> Vec<Vec<f64>> {
        let here = Problem::logs(tables, at);
        let slope = |parameter: &usize| {
            let mut there = *at;
            there[*parameter] += DIFFERENCE;
            let logs = match *parameter < GAPS {
                true => Problem::logs(tables, &there),
                false => Problem::logs(&self.tables(&there), &there),
            };
            logs.iter().zip(&here).map(|(there, here)| (there - here) / DIFFERENCE).collect()
        };
        let columns: Vec<Vec<f64>> = self.free.iter().map(slope).collect();
        (0..self.weights.len()).map(|driver| columns.iter().map(|it| it[driver]).collect()).collect()
    }

    /// The inverse of the information by the squares of the drivers' scores, with that of the prior (Berndt, Hall,
    /// Hall, Hausman 1974), over all parameters; 0 for those that are held.
    pub(super) fn covariance(&self, at: &Parameters) -> Option<Matrix> {
        let inverse = self.inverse(&self.scores(at, &self.tables(at)))?;
        let mut whole = Matrix::zeros(PARAMETERS);
        for (row, to) in self.free.iter().enumerate() {
            for (column, from) in self.free.iter().enumerate() {
                whole[(*to, *from)] = inverse[(row, column)];
            }
        }
        Some(whole)
    }

    fn inverse(&self, scores: &[Vec<f64>]) -> Option<Matrix> {
        let precisions: Vec<f64> = self.free.iter().map(|it| self.prior.precisions[*it]).collect();
        let mut information = Matrix::from_diagonal(&precisions);
        for (score, weight) in scores.iter().zip(self.weights) {
            information.add_outer(*weight, score, score);
        }
        Cholesky::of(&information).map(|it| it.inverse())
    }

    /// The maximum of likelihood and prior, from `start` on, until a step promises less than `least_gain`: steps by the
    /// squares of the drivers' scores, each halved until it gains. `None` if there is no first step.
    pub(super) fn maximum(&self, start: &Parameters, least_gain: f64) -> Option<Found> {
        /// Most steps, and halvings of one.
        const STEPS: usize = 60;
        const HALVINGS: i32 = 12;
        let mut found = Found { at: *start, is_converged: false };
        let held = (0..PARAMETERS).filter(|it| !self.free.contains(it));
        held.for_each(|it| found.at[it] = self.prior.means[it]);
        let mut tables = self.tables(&found.at);
        for _ in 0..STEPS {
            let scores = self.scores(&found.at, &tables);
            let gradient = self.gradient(&found.at, &scores);
            let step = self.inverse(&scores)?.times(&gradient);
            let promised = dot(&step, &gradient);
            if promised < least_gain {
                found.is_converged = true;
                break;
            }
            let before = self.log(&tables, &found.at);
            let tried = |halving: i32| {
                let mut at = found.at;
                let length = f64::powi(0.5, halving);
                self.free.iter().zip(&step).for_each(|(which, it)| at[*which] += length * it);
                let tables = self.tables(&at);
                (self.log(&tables, &at) > before + GAIN * length * promised).then_some((at, tables))
            };
            let Some((at, there)) = (0..HALVINGS).find_map(tried) else { break };
            (found.at, tables) = (at, there);
        }
        Some(found)
    }

    /// The slopes of likelihood and prior by the free parameters.
    fn gradient(&self, at: &Parameters, scores: &[Vec<f64>]) -> Vec<f64> {
        let mut all = vec![0.0; PARAMETERS];
        self.prior.add_gradient(at, &mut all);
        let mut gradient: Vec<f64> = self.free.iter().map(|it| all[*it]).collect();
        for (score, weight) in scores.iter().zip(self.weights) {
            add(&mut gradient, *weight, score);
        }
        gradient
    }
}

/// Where a search ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) at: Parameters,
    pub(super) is_converged: bool,
}

/// The shares of critical lead and lag gaps on the grid.
fn distribution(at: &Parameters) -> [[f64; GRID]; 2] {
    [0, 2].map(|it| shares(at[it], libm::exp(at[it + 1])))
}
