//! How well models predict drivers whom they have not seen: log-likelihoods held out by driver and by site.

use rayon::prelude::*;

use crate::desire_model::{DesireModel, assumptions};
use crate::measures::Prediction;
use crate::observe::Observations;
use crate::place_spread::{PlaceSpread, effect};
use crate::resample::{folds, resampled_drivers, shuffled};
use crate::waiting::{Assumptions, Design, WaitingFit};

/// How drivers are held out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Folds {
    /// How often all drivers are divided anew.
    pub repetitions: u32,
    /// Into how many parts, each of which is held out once.
    pub parts: usize,
    /// Draws of the bootstrap over drivers that gives the intervals.
    pub draws: u32,
    /// The seed of these divisions and draws.
    pub seed: u64,
}

/// A model with its fit to all drivers, and its predictions of those who were held out.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The name of the model.
    pub name: String,
    /// The fit to all drivers.
    pub fit: WaitingFit,
    /// For each driver its log-likelihood while it was held out, the mean over repetitions.
    pub held_out: Vec<f64>,
    /// The same while its whole site was held out; empty if there is one site only.
    pub held_out_by_site: Vec<f64>,
    /// Predictions of all seconds of drivers who were held out in the first repetition.
    pub predictions: Vec<Prediction>,
}

/// A difference with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The difference.
    pub estimate: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
}

impl Difference {
    /// `better`, `worse` or `not distinguishable`.
    pub fn verdict(&self) -> &'static str {
        match self.interval {
            [lower, _] if lower > 0.0 => "better",
            [_, upper] if upper < 0.0 => "worse",
            _ => "not distinguishable",
        }
    }
}

impl Candidate {
    /// Fits `model`, with prior `means` of its terms, to all drivers and to those who are not held out.
    pub fn of(
        observations: &Observations,
        model: &DesireModel,
        (means, spread): (&[f64], &PlaceSpread),
        folds: &Folds,
    ) -> Candidate {
        let design = observations.design(model);
        let assumptions = assumptions(&design, means, effect(&design, means, spread), spread);
        let assumptions = assumptions.without_spread(&design);
        let by_driver = Candidate::fitted(model.name().into(), [&design, &design], &assumptions, folds);
        by_driver.with_sites(observations, [&design, &design], &assumptions)
    }

    /// The same model, fitted to changes that are shuffled over all seconds and sides, and asked to predict the real
    /// ones. A control that has to lose.
    pub fn shuffled(
        observations: &Observations,
        model: &DesireModel,
        (means, spread): (&[f64], &PlaceSpread),
        folds: &Folds,
    ) -> Candidate {
        let design = observations.design(model);
        let assumptions = assumptions(&design, means, effect(&design, means, spread), spread);
        let assumptions = assumptions.without_spread(&design);
        let order = shuffled(design.gaps.len(), folds.seed, u32::MAX >> 1);
        let width = design.nodes * design.terms;
        let others = Design {
            values: order
                .iter()
                .flat_map(|row| &design.values[row * width..(row + 1) * width])
                .copied()
                .collect(),
            gaps: order.iter().map(|row| design.gaps[*row]).collect(),
            places: order.iter().map(|row| design.places[*row]).collect(),
            ..design.clone()
        };
        let by_driver = Candidate::fitted("shuffled".into(), [&others, &design], &assumptions, folds);
        by_driver.with_sites(observations, [&others, &design], &assumptions)
    }

    /// Fits to the first of two designs, and predicts the second.
    fn fitted(
        name: String,
        [design, real]: [&Design; 2],
        assumptions: &Assumptions,
        asked: &Folds,
    ) -> Candidate {
        let count = design.drivers.len();
        let fit = design.fit_roughly(assumptions, &vec![1.0; count], None);
        let jobs: Vec<(u32, usize)> = (0..asked.repetitions)
            .flat_map(|repetition| (0..asked.parts).map(move |part| (repetition, part)))
            .collect();
        let scores = |(repetition, part): &(u32, usize)| {
            // The predictions second by second are kept once.
            let is_first = *repetition == 0;
            let folds = folds(count, asked.parts, asked.seed, *repetition);
            let weights: Vec<f64> = folds.iter().map(|it| if it == part { 0.0 } else { 1.0 }).collect();
            let estimates = design.refit(assumptions, &weights, &fit.estimates, &fit.covariance);
            let held_out: Vec<f64> = weights.iter().map(|it| 1.0 - it).collect();
            let predictions = if is_first { real.predictions(&estimates, &held_out) } else { Vec::new() };
            (real.log_likelihoods(&estimates, assumptions.has_spread, &held_out), predictions)
        };
        let scores: Vec<(Vec<f64>, Vec<Prediction>)> = jobs.par_iter().map(scores).collect();
        let (mut held_out, mut predictions) = (vec![0.0; count], Vec::new());
        for (score, predicted) in scores {
            predictions.extend(predicted);
            held_out.iter_mut().zip(score).for_each(|(it, log)| *it += log / f64::from(asked.repetitions));
        }
        Candidate { name, fit, held_out, held_out_by_site: Vec::new(), predictions }
    }

    /// Holds out each site in turn, if there are several. What a model knows of other sites is how drivers weigh
    /// things, not how often they change lanes here: the intercept is estimated again, at the site itself, for every
    /// model alike. Of its places nothing is known.
    fn with_sites(
        self,
        observations: &Observations,
        [design, real]: [&Design; 2],
        assumptions: &Assumptions,
    ) -> Candidate {
        if observations.sites < 2 {
            return self;
        }
        let of = |site: u32| {
            let is_here = |here: bool| {
                let weight = move |it: bool| if it == here { 1.0 } else { 0.0 };
                observations.drivers.iter().map(|it| weight(it.site == site)).collect::<Vec<f64>>()
            };
            let (elsewhere, here) = (is_here(false), is_here(true));
            let estimates = design.refit(assumptions, &elsewhere, &self.fit.estimates, &self.fit.covariance);
            let mut intercept = assumptions.clone();
            intercept.prior.means = estimates;
            intercept.is_fixed =
                (0..intercept.is_fixed.len()).map(|it| it != self.fit.layout.intercept()).collect();
            let estimates = real.fit_roughly(&intercept, &here, None).estimates;
            real.log_likelihoods(&estimates, assumptions.has_spread, &here)
        };
        let by_site: Vec<Vec<f64>> = (0..observations.sites).into_par_iter().map(of).collect();
        // A driver counts at its own site, and is 0 elsewhere.
        let sum = |driver: usize| by_site.iter().map(|it| it[driver]).sum();
        let held_out_by_site = (0..observations.drivers.len()).map(sum).collect();
        Candidate { held_out_by_site, ..self }
    }

    /// By how much this model predicts drivers who were held out better than `other`: nats per change, with the
    /// interval of a bootstrap over drivers.
    pub fn better_than(&self, other: &Candidate, observations: &Observations, folds: &Folds) -> Difference {
        Difference::between(&self.held_out, &other.held_out, observations, folds)
    }

    /// The same for sites that were held out; `None` if there is one site only.
    pub fn better_elsewhere_than(
        &self,
        other: &Candidate,
        observations: &Observations,
        folds: &Folds,
    ) -> Option<Difference> {
        let [own, other] = [self, other].map(|it| &it.held_out_by_site);
        (!own.is_empty()).then(|| Difference::between(own, other, observations, folds))
    }
}

impl Difference {
    /// Between log-likelihoods of all drivers.
    fn between(own: &[f64], other: &[f64], observations: &Observations, folds: &Folds) -> Difference {
        let differences: Vec<f64> = own.iter().zip(other).map(|(own, other)| own - other).collect();
        let mut changes = vec![0.0; differences.len()];
        for (driver, count) in observations.drivers.iter().zip(&mut changes) {
            *count = driver.spells.iter().filter(|it| it.change.is_some()).count() as f64;
        }
        let mean = |weights: &[f64]| {
            let sum = |of: &[f64]| of.iter().zip(weights).map(|(it, weight)| it * weight).sum::<f64>();
            sum(&differences) / sum(&changes).max(1.0)
        };
        let estimate = mean(&vec![1.0; differences.len()]);
        let count = differences.len();
        let drawn: Vec<f64> =
            (0..folds.draws).map(|draw| mean(&resampled_drivers(count, folds.seed, draw))).collect();
        Difference { estimate, interval: interval(drawn) }
    }
}

/// The 95 % interval of what was drawn.
pub(crate) fn interval(mut drawn: Vec<f64>) -> [f64; 2] {
    drawn.sort_by(f64::total_cmp);
    let Some(last) = drawn.len().checked_sub(1) else { return [f64::NEG_INFINITY, f64::INFINITY] };
    let quantile = |share: f64| {
        let at = share * last as f64;
        let (below, rest) = (at.floor() as usize, at.fract());
        drawn[below] + rest * (drawn[(below + 1).min(last)] - drawn[below])
    };
    [quantile(0.025), quantile(0.975)]
}
