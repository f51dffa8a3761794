//! Which gaps recorded drivers accept, as plain data.

use laneweave_calibration::gaps::{CriticalGap, GapFit, GapScore, GapsNotFitted, SpreadOfGaps};
use laneweave_models::Parameter;
use laneweave_study::quantile;
use serde::Serialize;

/// Which gaps recorded drivers accept. Fields are added, never renamed.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct GapReport {
    /// Why nothing was fitted, so that the prior style's numbers stay; none if something was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_fitted: Option<&'static str>,
    /// Lane changes that show critical gaps.
    pub changes: usize,
    /// The critical gaps to the new leader and to the new follower.
    pub critical: Vec<CriticalGapReport>,
    /// Chance per second that a driver who waits goes into an acceptable gap.
    pub goes_per_s: f64,
    /// The same where the limits of the gap test refuse the gap for another reason.
    pub goes_anyway_per_s: f64,
    /// Chance per second that a driver who waits gives up.
    pub gives_up_per_s: f64,
    /// How well drivers are predicted who were not seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out: Option<GapScoreReport>,
    /// How hard followers brake before whom somebody changes lanes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follower_braking: Option<BrakingReport>,
    /// Whether the search ended at a maximum.
    pub is_converged: bool,
}

/// A critical gap: lognormal over the drivers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CriticalGapReport {
    /// Its key in a style.
    pub name: Parameter,
    /// The median over the drivers [m].
    pub median_m: f64,
    /// Its 95 % interval.
    pub median_interval: [f64; 2],
    /// Standard deviation of the logarithms over the drivers.
    pub spread: f64,
    /// Its 95 % interval.
    pub spread_interval: [f64; 2],
    /// The prior style's number [m].
    pub prior_m: f64,
    /// Whether the recordings tell both of its numbers: otherwise the prior style's drive.
    pub is_identified: bool,
}

/// Log scores of what held-out drivers did, given when they want which side [nats per lane change].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GapScoreReport {
    /// By critical gaps that were fitted to other drivers.
    pub fitted: f64,
    /// By the critical gaps of the prior style.
    pub prior: f64,
    /// By how much the fitted ones are better.
    pub over_prior: f64,
    /// The 95 % interval of that.
    pub over_prior_interval: [f64; 2],
    /// The fitted ones are `better`, `worse`, or `not distinguishable`.
    pub fitted_is: &'static str,
}

/// The hardest braking of followers within 4 s after somebody crossed into their lane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BrakingReport {
    /// Number of cut-ins.
    pub cut_ins: usize,
    /// The median [m/s²].
    pub median_mps2: f64,
    /// One in twenty brakes harder [m/s²].
    pub hardest_twentieth_mps2: f64,
}

impl GapReport {
    pub(super) fn of(fit: &Result<GapFit, GapsNotFitted>, braking: &[f64]) -> GapReport {
        let follower_braking = BrakingReport::of(braking);
        let fit = match fit {
            Ok(fit) => fit,
            Err(why) => {
                let not_fitted = Some(why.reason());
                return GapReport { not_fitted, follower_braking, ..GapReport::default() };
            }
        };
        GapReport {
            not_fitted: None,
            changes: fit.changes,
            critical: fit.gaps.iter().map(CriticalGapReport::of).collect(),
            goes_per_s: fit.goes,
            goes_anyway_per_s: fit.goes_anyway,
            gives_up_per_s: fit.gives_up,
            held_out: Some(GapScoreReport::of(&fit.score)),
            follower_braking,
            is_converged: fit.is_converged,
        }
    }
}

impl CriticalGapReport {
    fn of(it: &CriticalGap) -> CriticalGapReport {
        let SpreadOfGaps { estimate: median_m, interval: median_interval, .. } = it.median;
        let SpreadOfGaps { estimate: spread, interval: spread_interval, .. } = it.spread;
        CriticalGapReport {
            name: it.parameter,
            median_m,
            median_interval,
            spread,
            spread_interval,
            prior_m: it.prior,
            is_identified: it.is_identified(),
        }
    }

    /// Mean and standard deviation of the logarithms, if the recordings tell them.
    pub(super) fn logs(&self) -> Option<[f64; 2]> {
        self.is_identified.then(|| [self.median_m.ln(), self.spread])
    }
}

impl GapScoreReport {
    fn of(it: &GapScore) -> GapScoreReport {
        GapScoreReport {
            fitted: it.fitted,
            prior: it.prior,
            over_prior: it.over_prior.estimate,
            over_prior_interval: it.over_prior.interval,
            fitted_is: it.over_prior.verdict(),
        }
    }
}

impl BrakingReport {
    fn of(braking: &[f64]) -> Option<BrakingReport> {
        Some(BrakingReport {
            cut_ins: braking.len(),
            median_mps2: quantile(braking, 0.5)?,
            hardest_twentieth_mps2: quantile(braking, 0.95)?,
        })
    }

    /// It in words.
    pub(super) fn to_text(self) -> String {
        format!(
            "Followers brake within 4 s after a cut-in with {:.2} m/s² in the median; one in twenty with more than {:.2} ({}).",
            self.median_mps2, self.hardest_twentieth_mps2, self.cut_ins
        )
    }
}
