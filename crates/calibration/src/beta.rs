//! β of comfort by its profile likelihood.

use rayon::prelude::*;

use crate::desire_model::{DesireModel, assumptions};
use crate::fitted::SIGNIFICANT;
use crate::matrix::Matrix;
use crate::observe::Observations;
use crate::place_spread::PlaceSpread;
use crate::study::PriorWeights;

/// β of comfort by its profile likelihood.
#[derive(Clone, Debug, PartialEq)]
pub struct BetaProfile {
    /// The values that were tried, and the log-likelihood at each, less the largest.
    pub profile: Vec<(f64, f64)>,
    /// The one that is used.
    pub beta: f64,
    /// The values whose likelihood is not significantly less.
    pub interval: [f64; 2],
    /// Whether the interval ends on both sides within the values that were tried.
    pub is_identified: bool,
}

/// Values of β that are tried.
pub(crate) const BETAS: [f64; 8] = [0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0];
/// Those that are tried for drivers of whom some are held out: predictions hardly depend on the exact β (ours).
pub(crate) const COARSE: [f64; 4] = [0.2, 1.0, 2.0, 5.0];

/// Drivers whose β is asked for: how often each of them counts, how much places differ, and how much terms do.
pub(crate) struct Counting<'a> {
    pub(crate) weights: &'a [f64],
    pub(crate) spread: PlaceSpread,
    pub(crate) effect: f64,
}

impl BetaProfile {
    /// Profiles the likelihood of multi-criteria decision-making over these `betas`, for each of several choices of
    /// drivers.
    pub(crate) fn of_each(
        observations: &Observations,
        prior: &PriorWeights,
        betas: &[f64],
        choices: &[Counting],
    ) -> Vec<BetaProfile> {
        let mut starts: Vec<Option<(Vec<f64>, Matrix)>> = vec![None; choices.len()];
        let mut logs = vec![Vec::with_capacity(betas.len()); choices.len()];
        for &beta in betas {
            let design = observations.design(&DesireModel::Mcdm { beta });
            let each = choices.par_iter().zip(&mut starts).zip(&mut logs);
            each.for_each(|((counting, start), logs)| {
                let Counting { weights, spread, effect } = counting;
                let assumptions =
                    assumptions(&design, &prior.terms(), *effect, spread).without_spread(&design);
                let estimates = match start {
                    Some((estimates, covariance)) => {
                        design.refit(&assumptions, weights, estimates, covariance)
                    }
                    None => {
                        let fit = design.fit_roughly(&assumptions, weights, None);
                        *start = Some((fit.estimates.clone(), fit.covariance));
                        fit.estimates
                    }
                };
                let all = design.log_likelihoods(&estimates, assumptions.has_spread, weights);
                logs.push((beta, all.iter().zip(*weights).map(|(log, weight)| log * weight).sum::<f64>()));
            });
        }
        logs.into_iter().map(|it| BetaProfile::from_logs(it, prior.beta)).collect()
    }

    fn from_logs(logs: Vec<(f64, f64)>, prior: f64) -> BetaProfile {
        let largest = logs.iter().map(|it| it.1).fold(f64::NEG_INFINITY, f64::max);
        let profile: Vec<(f64, f64)> = logs.into_iter().map(|(beta, log)| (beta, log - largest)).collect();
        let inside = |it: &&(f64, f64)| it.1 > -SIGNIFICANT;
        let lower = profile.iter().find(inside).map_or(f64::NAN, |it| it.0);
        let upper = profile.iter().rev().find(inside).map_or(f64::NAN, |it| it.0);
        let is_identified = lower > profile[0].0 && upper < profile[profile.len() - 1].0;
        let best = profile.iter().find(|it| it.1 == 0.0).map_or(prior, |it| it.0);
        let beta = if is_identified { best } else { prior };
        BetaProfile { profile, beta, interval: [lower, upper], is_identified }
    }
}
