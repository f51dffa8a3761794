//! What a fit is worth in the world, as numbers.

use laneweave_study::{chance_of_more, count_score, crps, middle_95, quantile, share_between};
use serde::Serialize;

pub(super) use super::measures::{Measured, measured};
use super::tally::CLASSES;

/// Fitted drivers beside recorded ones, on the part of the recordings to which they were not fitted. Fields are added,
/// never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// Recorded time to which the style was fitted [s].
    pub fitted_s: f64,
    /// Lane changes to which the style was fitted.
    pub events_used: usize,
    /// By how much θ of the fitted style was moved, so that its drivers change lanes as often as recorded in the ten
    /// minutes before, in units of the choice noise; 0 if nobody changed lanes then.
    pub theta_moved_by: f64,
    /// Rollouts of each model.
    pub rollouts: usize,
    /// The models: the fitted style first.
    pub models: Vec<JudgedModel>,
    /// The last third, driven as a whole.
    #[serde(flatten)]
    pub third: Design,
    /// Short rollouts from recorded snapshots of the last third.
    pub snapshots: Design,
}

/// A design: how the recorded demand is simulated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Design {
    /// Simulations of each rollout.
    pub simulations: usize,
    /// Time that is measured in all of them [s].
    pub simulated_s: f64,
    /// Lane changes that were recorded in that time.
    pub events: u32,
    /// Recorded mean densities of light, middle and dense traffic [veh/km of a lane].
    pub densities_veh_per_km: [f64; CLASSES],
    /// What was measured, recorded and simulated.
    pub measures: Vec<JudgedMeasure>,
}

/// The keys of the rates of lane changes by class of density.
pub(super) const BY_DENSITY: [&str; CLASSES] = ["rate_light", "rate_middle", "rate_dense"];

/// A model that was simulated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JudgedModel {
    /// Its name.
    pub model: &'static str,
    /// The number that was fitted to the rate of lane changes, by its key in a style; none for the fitted style.
    pub scale: Option<(&'static str, f64)>,
    /// Collisions per rollout.
    pub collisions: f64,
}

/// A measure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JudgedMeasure {
    /// Its key.
    pub key: String,
    /// Its name, with the unit.
    pub name: String,
    /// Recorded; none, if there was nothing to measure.
    pub recorded: Option<f64>,
    /// Simulated, by model.
    pub simulated: Vec<Predicted>,
}

/// What a model predicts of a measure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Predicted {
    /// The median of the rollouts; none, if there was nothing to measure.
    pub median: Option<f64>,
    /// The interval of 95 % of the rollouts.
    pub interval: Option<[f64; 2]>,
    /// The width of that interval.
    pub width: Option<f64>,
    /// The continuous ranked probability score, in the unit of the measure: the less, the better.
    pub crps: Option<f64>,
    /// Of counts, the negative logarithm of the likelihood of the recorded count, for a negative binomial distribution
    /// with the mean and variance of the rollouts: the less, the better.
    pub count_score: Option<f64>,
    /// Whether the recorded value lies in the interval: `inside`, `below` or `above`; `unknown` without a value.
    pub recorded_is: &'static str,
    /// Share of the variance of the rollouts that comes from the uncertain parameters; the rest is chance. None without
    /// draws of the parameters.
    pub from_parameters: Option<f64>,
    /// The chance that a rollout of this model shows more than one of the fitted style.
    pub more_than_fitted: Option<f64>,
    /// Whether the two are told apart: less than 2.5 % or more than 97.5 % show more.
    pub is_told_apart: bool,
}

/// A score of each model.
pub(super) struct Score {
    pub(super) key: String,
    pub(super) name: String,
    pub(super) values: Vec<Option<f64>>,
}

/// The scores of all models: of how often lanes are changed, as counts and by density, and of every other measure.
pub(super) fn scores(measures: &[JudgedMeasure]) -> Vec<Score> {
    let models = measures.first().map_or(0, |it| it.simulated.len());
    let column =
        |of: &dyn Fn(&Predicted) -> Option<f64>, it: &JudgedMeasure| it.simulated.iter().map(of).collect();
    let counted = measures.iter().find(|it| it.key == "rate");
    let counts = counted.map(|it| Score {
        key: "changes".into(),
        name: "lane changes [nats]".into(),
        values: column(&|it| it.count_score, it),
    });
    let classes: Vec<&JudgedMeasure> =
        measures.iter().filter(|it| BY_DENSITY.contains(&it.key.as_str())).collect();
    let mean = |model: usize| {
        let all: Option<Vec<f64>> = classes.iter().map(|it| it.simulated[model].crps).collect();
        all.filter(|it| !it.is_empty()).map(|it| it.iter().sum::<f64>() / it.len() as f64)
    };
    let by_density = Score {
        key: "rate_by_density".into(),
        name: "lane changes by density, mean [1/veh-km]".into(),
        values: (0..models).map(mean).collect(),
    };
    let each = measures.iter().map(|it| Score {
        key: it.key.clone(),
        name: it.name.clone(),
        values: column(&|it| it.crps, it),
    });
    counts.into_iter().chain([by_density]).chain(each).collect()
}

impl Predicted {
    /// Of the values of the rollouts; `same` of them that follow one another have the same parameters.
    pub(super) fn of(
        values: &[Option<f64>],
        recorded: Option<f64>,
        fitted: &[Option<f64>],
        same: usize,
    ) -> Predicted {
        let [known, of_fitted] =
            [values, fitted].map(|it| it.iter().flatten().copied().collect::<Vec<f64>>());
        let interval = middle_95(&known);
        let recorded_is = match (recorded, interval) {
            (Some(it), Some([low, _])) if it < low => "below",
            (Some(it), Some([_, high])) if it > high => "above",
            (Some(_), Some(_)) => "inside",
            _ => "unknown",
        };
        let groups: Vec<Vec<f64>> =
            values.chunks_exact(same).filter_map(|it| it.iter().copied().collect()).collect();
        let more_than_fitted = chance_of_more(&known, &of_fitted);
        Predicted {
            median: quantile(&known, 0.5),
            interval,
            width: interval.map(|[low, high]| high - low),
            crps: recorded.and_then(|it| crps(&known, it)),
            count_score: None,
            recorded_is,
            from_parameters: share_between(&groups),
            more_than_fitted,
            is_told_apart: more_than_fitted.is_some_and(|it| !(0.025..=0.975).contains(&it)),
        }
    }

    /// The same with its score for counts, where the measure is one of counts.
    pub(super) fn with_counts(self, counts: Option<Vec<u32>>, recorded: Option<u32>) -> Predicted {
        let counts = counts.map(|it| it.into_iter().map(f64::from).collect::<Vec<f64>>());
        let count_score = counts.zip(recorded).and_then(|(counts, it)| count_score(&counts, it));
        Predicted { count_score, ..self }
    }

    /// Whether the recorded value lies outside of the interval.
    pub fn is_missed(&self) -> bool {
        matches!(self.recorded_is, "below" | "above")
    }
}
