//! What is to be explained: all stretches of some drivers, by numbers that all have and one that they have each.

use laneweave_models::Style;
use rayon::prelude::*;

use super::errors::{Errors, Off, errors, kind};
use super::numbers::{JAM_GAP, numbers, with_numbers};
use super::predict::{Follower, Moved};
use super::stretch::{Stretch, Stretches};
use crate::observe::{Shown, distribution, moments};

/// The parameters: logarithms of T, s₀, a and b, and how much of its own time gap a driver keeps.
pub(super) const PARAMETERS: usize = 5;
pub(super) type Parameters = [f64; PARAMETERS];
/// The place of the last of them.
pub(super) const OWN: usize = 4;
/// Standard deviation of the prior of each (ours): a number is within a factor of 2.7 of the prior style's.
pub(super) const PRIOR: f64 = 0.5;

/// A stretch of a driver with its desired speed.
pub(super) struct Case<'a> {
    pub(super) driver: usize,
    pub(super) stretch: &'a Stretch,
    /// Its desired speed [m/s].
    pub(super) desired: f64,
}

/// What is to be explained.
pub(super) struct Problem<'a> {
    pub(super) style: &'a Style,
    pub(super) cases: Vec<Case<'a>>,
    /// The number of drivers.
    pub(super) drivers: usize,
    /// The prior means.
    pub(super) prior: Parameters,
    /// The mean logarithm of the time gaps with which stretches start.
    pub(super) usual: f64,
    /// Mean and standard deviation of the logarithms of desired speeds as factors.
    pub(super) desired: (f64, f64),
}

/// The desired speed of a driver of whom this was `shown`, as a factor; logarithms of the factors of all drivers have
/// this `distribution`.
pub(super) fn factor(shown: Option<&Shown>, distribution: (f64, f64)) -> f64 {
    libm::exp(shown.map_or(distribution.0, |it| moments(it, distribution).0))
}

impl<'a> Problem<'a> {
    /// All stretches of the drivers who count, beside the numbers of `style`; `None` if its model cannot be fitted.
    /// Desired speeds come from the whole recording.
    pub(super) fn of(
        style: &'a Style,
        drivers: &'a [Stretches],
        counts: impl Fn(usize) -> bool,
    ) -> Option<Problem<'a>> {
        let prior = numbers(&style.follow)?;
        let counting = || drivers.iter().enumerate().filter(|it| counts(it.0));
        let shown: Vec<&Shown> = counting().filter_map(|it| it.1.shown.as_ref()).collect();
        let desired = distribution(&shown);
        let cases: Vec<Case> = counting()
            .flat_map(|(driver, stretches)| {
                let factor = factor(stretches.shown.as_ref(), desired);
                let case =
                    move |stretch: &'a Stretch| Case { driver, stretch, desired: factor * stretch.allowed };
                stretches.all.iter().map(case)
            })
            .collect();
        let own = cases.iter().filter_map(|it| it.stretch.time_gap(prior[JAM_GAP]));
        let (sum, count) = own.fold((0.0, 0.0), |(sum, count), it| (sum + libm::log(it), count + 1.0));
        let usual = if count > 0.0 { sum / count } else { 0.0 };
        let [time_gap, jam_gap, acceleration, deceleration] = prior.map(libm::log);
        let prior = [time_gap, jam_gap, acceleration, deceleration, 0.0];
        Some(Problem { style, cases, drivers: drivers.len(), prior, usual, desired })
    }

    /// The driver of `case`.
    pub(super) fn follower(&self, case: &Case, parameters: &Parameters) -> Follower {
        let [time_gap, jam_gap, acceleration, deceleration, own] = *parameters;
        let jam_gap = libm::exp(jam_gap);
        let kept = case.stretch.time_gap(jam_gap).map_or(0.0, |it| libm::log(it) - self.usual);
        let numbers =
            [libm::exp(time_gap + own * kept), jam_gap, libm::exp(acceleration), libm::exp(deceleration)];
        Follower {
            model: with_numbers(self.style.follow, numbers),
            comfortable: self.style.manner.comfortable_deceleration,
            desired: case.desired,
            strength: case.stretch.strength,
        }
    }

    pub(super) fn predicted(&self, case: &Case, parameters: &Parameters) -> Vec<Moved> {
        self.follower(case, parameters).predicted(case.stretch)
    }

    pub(super) fn errors(&self, case: &Case, parameters: &Parameters) -> Vec<f64> {
        errors(&self.predicted(case, parameters), case.stretch)
    }

    /// The distribution of errors at `parameters`, a step better than `before`.
    pub(super) fn distribution(&self, parameters: &Parameters, before: Option<&Errors>) -> Option<Errors> {
        let off = |it: &Case| Off { kind: kind(it.stretch), errors: self.errors(it, parameters) };
        Errors::of(&self.cases.par_iter().map(off).collect::<Vec<Off>>(), before)
    }

    /// The log-likelihood, penalised by the prior.
    pub(super) fn log(&self, errors: &Errors, parameters: &Parameters) -> f64 {
        let of = |it: &Case| errors.weighed(kind(it.stretch), &self.errors(it, parameters)).log;
        // Added up in order, so that the number of threads changes nothing.
        let logs: Vec<f64> = self.cases.par_iter().map(of).collect();
        logs.iter().sum::<f64>() - (0..PARAMETERS).map(|it| self.penalty(parameters, it)).sum::<f64>()
    }

    /// By how much the prior penalises one of the parameters.
    pub(super) fn penalty(&self, parameters: &Parameters, at: usize) -> f64 {
        let off = (parameters[at] - self.prior[at]) / PRIOR;
        0.5 * off * off
    }
}
