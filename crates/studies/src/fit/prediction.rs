//! How well models predict drivers who were not seen, as plain data.

use laneweave_calibration::measures::{
    brier, calibration, log_likelihood_of_share, log_score, precision_recall_area, roc_area,
};
use laneweave_calibration::observe::Observations;
use laneweave_calibration::{Candidate, Compared, Difference};
use serde::Serialize;

/// How well a model predicts drivers who were not seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldOut {
    /// The model.
    pub model: String,
    /// Its log-likelihood of held-out drivers [nats per change].
    pub log_likelihood_per_event: f64,
    /// By how much it predicts better than a constant chance [nats per change], with the 95 % interval.
    pub over_constant: f64,
    /// The 95 % interval of the value before.
    pub over_constant_interval: [f64; 2],
    /// By how much multi-criteria decision-making predicts better than it [nats per change], with the 95 % interval.
    pub mcdm_over_it: f64,
    /// The 95 % interval of the value before.
    pub mcdm_over_it_interval: [f64; 2],
    /// Multi-criteria decision-making is `better` than it, `worse`, or `not distinguishable`.
    pub mcdm_is: &'static str,
    /// The same for a site that was held out, with its intercept estimated again; none if there is one site only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elsewhere: Option<Elsewhere>,
}

/// How well a model predicts drivers of a site that was not seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Elsewhere {
    /// By how much it predicts better than a constant chance [nats per change], with the 95 % interval.
    pub over_constant: f64,
    /// The 95 % interval of the value before.
    pub over_constant_interval: [f64; 2],
    /// By how much multi-criteria decision-making predicts better than it [nats per change], with the 95 % interval.
    pub mcdm_over_it: f64,
    /// The 95 % interval of the value before.
    pub mcdm_over_it_interval: [f64; 2],
    /// Multi-criteria decision-making is `better` than it, `worse`, or `not distinguishable`.
    pub mcdm_is: &'static str,
}

impl Elsewhere {
    fn of([over, mcdm]: [Difference; 2]) -> Elsewhere {
        Elsewhere {
            over_constant: over.estimate,
            over_constant_interval: over.interval,
            mcdm_over_it: mcdm.estimate,
            mcdm_over_it_interval: mcdm.interval,
            mcdm_is: mcdm.verdict(),
        }
    }
}

/// How good the predictions of single seconds are, of drivers who were not seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Predictive {
    /// The model.
    pub model: String,
    /// Seconds, and the share of them in which a change began: what a prediction by chance has as the area of precision
    /// over recall.
    pub seconds: usize,
    /// That share.
    pub base_rate: f64,
    /// 1 less the log-likelihood over that of a constant chance (McFadden).
    pub mcfadden_r2: f64,
    /// Area under the receiver operating characteristic.
    pub roc_area: Option<f64>,
    /// Area under the curve of precision over recall.
    pub precision_recall_area: Option<f64>,
    /// Mean squared error (Brier).
    pub brier: f64,
    /// Intercept and slope of a logit of the events on the logits of the predictions: 0 and 1 if they are right.
    pub calibration: Option<[f64; 2]>,
}

impl Predictive {
    pub(super) fn of(candidate: &Candidate) -> Predictive {
        let all = &candidate.predictions;
        let events = all.iter().filter(|it| it.came).count();
        let by_share = log_likelihood_of_share(all.len().max(1), events);
        Predictive {
            model: candidate.name.clone(),
            seconds: all.len(),
            base_rate: events as f64 / all.len().max(1) as f64,
            mcfadden_r2: 1.0 - log_score(all) * all.len() as f64 / by_share,
            roc_area: roc_area(all),
            precision_recall_area: precision_recall_area(all),
            brier: brier(all),
            calibration: calibration(all),
        }
    }
}

impl HeldOut {
    pub(super) fn of(it: &Compared, observations: &Observations) -> HeldOut {
        let used = observations.used().count().max(1) as f64;
        let Difference { estimate: over_constant, interval: over_constant_interval } = it.over_constant;
        let Difference { estimate: mcdm_over_it, interval: mcdm_over_it_interval } = it.mcdm_over_it;
        HeldOut {
            model: it.candidate.name.clone(),
            log_likelihood_per_event: it.candidate.held_out.iter().sum::<f64>() / used,
            over_constant,
            over_constant_interval,
            mcdm_over_it,
            mcdm_over_it_interval,
            mcdm_is: it.mcdm_over_it.verdict(),
            elsewhere: it.elsewhere.map(Elsewhere::of),
        }
    }
}
