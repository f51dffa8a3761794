//! How well models predict drivers whom they have not seen: log-likelihoods held out by driver and by site.

use rayon::prelude::*;

use crate::desire_model::{DesireModel, assumptions};
use crate::measures::Prediction;
use crate::observe::Observations;
use crate::resample::{resampled_drivers, shuffled};
use crate::split::{Splits, Supposed};
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
    /// Fits `model`, with prior `means` of its terms, to all drivers and to those who are not held out. What is
    /// supposed of all drivers comes from those who are seen alone.
    pub fn of(observations: &Observations, model: &DesireModel, means: &[f64], splits: &Splits) -> Candidate {
        let designs = |it: &Supposed| {
            let design = observations.design(&it.model(model));
            [design.clone(), design]
        };
        Candidate::fitted(model.name().into(), (observations, splits), (model, means), designs)
    }

    /// The same model, fitted to changes that are shuffled over all seconds and sides, and asked to predict the real
    /// ones. A control that has to lose.
    pub fn shuffled(
        observations: &Observations,
        model: &DesireModel,
        means: &[f64],
        (splits, seed): (&Splits, u64),
    ) -> Candidate {
        let designs = |it: &Supposed| {
            let design = observations.design(&it.model(model));
            [with_shuffled_rows(&design, seed), design]
        };
        Candidate::fitted("shuffled".into(), (observations, splits), (model, means), designs)
    }

    /// Fits to the first of the two designs by each split, and predicts the second.
    fn fitted(
        name: String,
        (observations, splits): (&Observations, &Splits),
        of: (&DesireModel, &[f64]),
        designs: impl Fn(&Supposed) -> [Design; 2] + Sync,
    ) -> Candidate {
        let of_all = Task::of(&splits.all, of, designs(&splits.all));
        let fit = of_all.design.fit_roughly(&of_all.assumptions, &splits.all.seen, None);
        let scores = |(number, split): (usize, &Supposed)| {
            let task = Task::of(split, of, designs(split));
            let estimates =
                task.design.refit(&task.assumptions, &split.seen, &fit.estimates, &fit.covariance);
            let held_out = split.held_out();
            // The predictions second by second are kept once.
            let is_first = number < splits.parts;
            let predictions =
                if is_first { task.real.predictions(&estimates, &held_out) } else { Vec::new() };
            (task.real.log_likelihoods(&estimates, task.assumptions.has_spread, &held_out), predictions)
        };
        let scores: Vec<(Vec<f64>, Vec<Prediction>)> =
            splits.by_driver.par_iter().enumerate().map(scores).collect();
        let (mut held_out, mut predictions) = (vec![0.0; observations.drivers.len()], Vec::new());
        let repetitions = (splits.by_driver.len() / splits.parts.max(1)).max(1) as f64;
        for (score, predicted) in scores {
            predictions.extend(predicted);
            held_out.iter_mut().zip(score).for_each(|(it, log)| *it += log / repetitions);
        }
        let of_site = |split: &Supposed| Task::of(split, of, designs(split)).elsewhere(split, &fit);
        let by_site: Vec<Vec<f64>> = splits.by_site.par_iter().map(of_site).collect();
        // A driver counts at its own site, and is 0 elsewhere.
        let sum = |driver: usize| by_site.iter().map(|it| it[driver]).sum();
        let drivers = if by_site.is_empty() { 0 } else { observations.drivers.len() };
        Candidate { name, fit, held_out, held_out_by_site: (0..drivers).map(sum).collect(), predictions }
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

/// The same design with its rows in a random order.
fn with_shuffled_rows(design: &Design, seed: u64) -> Design {
    let order = shuffled(design.gaps.len(), seed, u32::MAX >> 1);
    let width = design.nodes * design.terms;
    Design {
        values: order
            .iter()
            .flat_map(|row| &design.values[row * width..(row + 1) * width])
            .copied()
            .collect(),
        gaps: order.iter().map(|row| design.gaps[*row]).collect(),
        places: order.iter().map(|row| design.places[*row]).collect(),
        ..design.clone()
    }
}

/// A fit to some drivers, and a prediction of others.
struct Task {
    /// What is fitted.
    design: Design,
    /// What is predicted.
    real: Design,
    assumptions: Assumptions,
}

impl Task {
    fn of(supposed: &Supposed, (model, means): (&DesireModel, &[f64]), [design, real]: [Design; 2]) -> Task {
        let effect = supposed.effect_of(model, &real, means);
        let assumptions = assumptions(&real, means, effect, &supposed.spread);
        Task { assumptions: assumptions.without_spread(&real), design, real }
    }

    /// The log-likelihoods of the drivers of a site that is held out. What a model knows of other sites is how drivers
    /// weigh things, not how often they change lanes here: the intercept is estimated again, at the site itself, for
    /// every model alike. Of its places nothing is known.
    fn elsewhere(&self, split: &Supposed, fit: &WaitingFit) -> Vec<f64> {
        let Task { design, real, assumptions } = self;
        let here = split.held_out();
        let mut intercept = assumptions.clone();
        intercept.prior.means = design.refit(assumptions, &split.seen, &fit.estimates, &fit.covariance);
        intercept.is_fixed = (0..intercept.is_fixed.len()).map(|it| it != fit.layout.intercept()).collect();
        let estimates = real.fit_roughly(&intercept, &here, None).estimates;
        real.log_likelihoods(&estimates, assumptions.has_spread, &here)
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
