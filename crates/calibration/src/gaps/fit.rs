//! A fit of critical gaps: their distribution with its errors, and what the recordings leave open.

use laneweave_models::{Parameter, Style};

use super::offered::OfferedGaps;
use super::problem::{Before, Found, GAPS, MEDIAN_PRIOR, Parameters, Problem, SPREAD_PRIOR};
use super::score::{GapScore, Seen, score};
use super::table::{Table, normal};
use crate::desire_model::{DesireModel, assumptions};
use crate::fitted::{HALF, MOST_LEFT, SIGNIFICANT};
use crate::held_out::Folds;
use crate::maximise::ROUGH;
use crate::observe::Observations;
use crate::split::by_driver;
use crate::study::{Asked, Study};
use crate::waiting::{Assumptions, Design, WaitingFit, logistic};

/// A number of a lognormal distribution of critical gaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpreadOfGaps {
    /// The estimate.
    pub estimate: f64,
    /// Standard error: of the logarithm.
    pub log_error: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
    /// By how much the log-likelihood falls to half and to twice the estimate, with all other numbers of critical gaps
    /// fitted anew [nats].
    pub falls: [f64; 2],
    /// Whether the recordings tell it: the standard error is at most half of the prior's standard deviation, and the
    /// likelihood falls significantly on both sides.
    pub is_identified: bool,
}

/// The critical gaps of the drivers to one of the two vehicles: lognormal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalGap {
    /// Its key in a style.
    pub parameter: Parameter,
    /// The median over the drivers [m].
    pub median: SpreadOfGaps,
    /// The standard deviation of the logarithms.
    pub spread: SpreadOfGaps,
    /// The prior style's number [m].
    pub prior: f64,
}

/// Which gaps drivers accept.
#[derive(Clone, Debug, PartialEq)]
pub struct GapFit {
    /// The critical gaps to the new leader and to the new follower.
    pub gaps: [CriticalGap; 2],
    /// Chance per second that a driver who waits goes into an acceptable gap.
    pub goes: f64,
    /// The same where a gap test with the given limits refuses the gap.
    pub goes_anyway: f64,
    /// Chance per second that a driver who waits gives up.
    pub gives_up: f64,
    /// Number of drivers, and of their changes.
    pub drivers: usize,
    /// Number of changes.
    pub changes: usize,
    /// How well drivers are predicted who were not seen.
    pub score: GapScore,
    /// Whether the search ended at a maximum.
    pub is_converged: bool,
}

/// Why no critical gaps were fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GapsNotFitted {
    /// Too few changes were seen.
    FewChanges,
}

impl GapsNotFitted {
    /// Why, in words.
    pub fn reason(self) -> &'static str {
        match self {
            GapsNotFitted::FewChanges => "too few lane changes were seen",
        }
    }
}

/// Changes that a fit needs (ours).
const ENOUGH: usize = 20;

impl CriticalGap {
    /// Whether the recordings tell both of its numbers.
    pub fn is_identified(&self) -> bool {
        self.median.is_identified && self.spread.is_identified
    }

    /// P(accept | gap): the share of the drivers who accept a `gap` [m], if nothing else speaks against it.
    pub fn accepted(&self, gap: f64) -> f64 {
        normal(libm::log(gap / self.median.estimate) / self.spread.estimate)
    }
}

/// Who wants which side when, by a fit of lane changes.
pub struct Wishes<'a> {
    observations: &'a Observations,
    design: Design,
    assumptions: Assumptions,
    fit: &'a WaitingFit,
}

impl<'a> Wishes<'a> {
    /// By a `fit` of `model` under these `assumptions` to `observations`.
    pub fn of(
        observations: &'a Observations,
        model: &DesireModel,
        assumptions: &Assumptions,
        fit: &'a WaitingFit,
    ) -> Wishes<'a> {
        let design = observations.design(model);
        let assumptions = assumptions.clone().without_spread(&design);
        Wishes { observations, design, assumptions, fit }
    }

    /// By a `study` of `observations` for which this was `asked`.
    pub fn of_study(observations: &'a Observations, study: &'a Study, asked: &Asked) -> Wishes<'a> {
        let model = DesireModel::Mcdm { beta: study.beta.beta };
        let design = observations.design(&model);
        let assumptions = assumptions(&design, &asked.prior.terms(), study.effect, &study.spread)
            .holding_untold(study.layout(), &study.weights);
        Wishes::of(observations, &model, &assumptions, &study.fit)
    }

    /// What drivers of `style` were offered who want sides with the parameters `estimates`.
    fn offered(&self, style: &Style, estimates: &[f64]) -> (OfferedGaps, Before) {
        let layout = self.fit.layout;
        let safety = [style.safety, style.safety.of_follower()];
        let before = Before {
            medians: safety.map(|it| it.min_gap),
            giving_up: logistic(estimates[layout.giving_up()]),
            waiting: logistic(estimates[layout.waiting()]),
        };
        let desires = self.design.desires(estimates);
        (OfferedGaps::of(self.observations, &desires, &style.safety), before)
    }

    /// The same by the drivers who are `seen` alone.
    fn offered_by(&self, style: &Style, seen: Vec<f64>) -> Seen {
        let WaitingFit { estimates, covariance, .. } = self.fit;
        let estimates = self.design.refit(&self.assumptions, &seen, estimates, covariance);
        let (offered, before) = self.offered(style, &estimates);
        Seen { seen, offered, before }
    }
}

impl GapFit {
    /// Fits critical gaps to drivers with these `wishes`, beside those of `style`, whose other limits of the gap test
    /// hold. Drivers are held out as `folds` says, once.
    ///
    /// # Errors
    /// If too few changes were seen.
    pub fn of(wishes: &Wishes, style: &Style, folds: &Folds) -> Result<GapFit, GapsNotFitted> {
        let (offered, before) = wishes.offered(style, &wishes.fit.estimates);
        let changes = offered.changes();
        if changes < ENOUGH {
            return Err(GapsNotFitted::FewChanges);
        }
        let all = vec![1.0; offered.drivers.len()];
        let problem = Problem::new(&offered, &all, &before);
        let Found { at, is_converged } =
            problem.maximum(&problem.start(), ROUGH).ok_or(GapsNotFitted::FewChanges)?;
        let covariance = problem.covariance(&at).ok_or(GapsNotFitted::FewChanges)?;
        let errors: Parameters = std::array::from_fn(|it| covariance[(it, it)].max(0.0).sqrt());
        let tables = problem.tables(&at);
        let number = |which| number(&problem, &tables, &at, (which, errors[which]));
        let keys = [Parameter::MinGap, Parameter::MinLagGap];
        let gap = |kind: usize| CriticalGap {
            parameter: keys[kind],
            median: number(2 * kind),
            spread: number(2 * kind + 1),
            prior: before.medians[kind],
        };
        let per_second = |at: f64| 1.0 - libm::pow(1.0 - logistic(at), offered.looks);
        let parts = by_driver(wishes.observations, &Folds { repetitions: 1, ..*folds });
        Ok(GapFit {
            gaps: [0, 1].map(gap),
            goes: per_second(at[7]),
            goes_anyway: per_second(at[8]),
            gives_up: per_second(at[6]),
            drivers: offered.drivers.iter().filter(|it| !it.is_empty()).count(),
            changes,
            score: score(parts.into_iter().map(|it| wishes.offered_by(style, it)), &at, folds),
            is_converged,
        })
    }
}

/// One of the numbers at the maximum `at`.
fn number(
    problem: &Problem,
    tables: &[Option<Table>],
    at: &Parameters,
    (which, log_error): (usize, f64),
) -> SpreadOfGaps {
    // The median stands as its logarithm, and so does the spread.
    let estimate = libm::exp(at[which]);
    let best = problem.log_beside(tables, at, which);
    let falls = [-1.0, 1.0].map(|side| {
        let mut there = *at;
        there[which] += side * std::f64::consts::LN_2;
        best - problem.log_beside(tables, &problem.refitted(tables, &there, which), which)
    });
    let prior = if which % 2 == 0 { MEDIAN_PRIOR } else { SPREAD_PRIOR };
    let half = libm::exp(HALF * log_error);
    let is_closed = falls.iter().all(|it| *it > SIGNIFICANT);
    SpreadOfGaps {
        estimate,
        log_error,
        interval: [estimate / half, estimate * half],
        falls,
        is_identified: log_error <= MOST_LEFT * prior && is_closed,
    }
}

impl Problem<'_> {
    /// Likelihood and prior, but that of one parameter: that closes by itself.
    fn log_beside(&self, tables: &[Option<Table>], at: &Parameters, which: usize) -> f64 {
        let off = at[which] - self.prior.means[which];
        self.log(tables, at) + 0.5 * self.prior.precisions[which] * off * off
    }

    /// The other numbers of critical gaps where one is held: by turns, each at its maximum along a line.
    fn refitted(&self, tables: &[Option<Table>], at: &Parameters, held: usize) -> Parameters {
        /// Turns, and halvings of the first step.
        const TURNS: usize = 4;
        const HALVINGS: i32 = 6;
        let mut best = *at;
        let mut value = self.log(tables, &best);
        for _ in 0..TURNS {
            for which in (0..GAPS).filter(|it| *it != held) {
                for halving in 0..HALVINGS {
                    let step = 0.4 * f64::powi(0.5, halving);
                    for side in [step, -step] {
                        let mut there = best;
                        there[which] += side;
                        let log = self.log(tables, &there);
                        if log > value {
                            (best, value) = (there, log);
                        }
                    }
                }
            }
        }
        best
    }
}
