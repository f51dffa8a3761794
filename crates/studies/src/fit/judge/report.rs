//! What a fit is worth in the world, as numbers.

use laneweave_study::units::KMH_PER_MPS;
use laneweave_study::{chance_of_more, middle_95, quantile, share_between};
use serde::Serialize;

use super::tally::{CLASSES, Tally, rate};

/// Fitted drivers beside recorded ones, on the part of the recordings to which they were not fitted. Fields are added,
/// never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// Recorded time to which the style was fitted [s].
    pub fitted_s: f64,
    /// Time that was simulated and measured [s].
    pub simulated_s: f64,
    /// Lane changes to which the style was fitted.
    pub events_used: usize,
    /// Lane changes that were recorded while it was simulated.
    pub events: u32,
    /// Rollouts of each model.
    pub rollouts: usize,
    /// The models: the fitted style first.
    pub models: Vec<JudgedModel>,
    /// What was measured, recorded and simulated.
    pub measures: Vec<JudgedMeasure>,
}

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
    /// Whether the recorded value lies in it: `inside`, `below` or `above`; `unknown` without a value.
    pub recorded_is: &'static str,
    /// Share of the variance of the rollouts that comes from the uncertain parameters; the rest is chance. None without
    /// draws of the parameters.
    pub from_parameters: Option<f64>,
    /// The chance that a rollout of this model shows more than one of the fitted style.
    pub more_than_fitted: Option<f64>,
    /// Whether the two are told apart: less than 2.5 % or more than 97.5 % show more.
    pub is_told_apart: bool,
}

/// A measure by its key and its name, with its value.
pub(super) type Value = (String, String, Option<f64>);

/// What is measured of traffic, with the classes of density between these bounds [veh/km], for so many lanes.
pub(super) fn values(tally: &Tally, thirds: [f64; CLASSES - 1], lanes: usize) -> Vec<Value> {
    let [metres, seconds] = tally.exposure();
    let named = |key: &str, name: &str, value| (key.to_owned(), name.to_owned(), value);
    let mut all = vec![named("rate", "lane changes [1/veh-km]", tally.rate())];
    let kinds = [
        ("rate_discretionary", "discretionary [1/veh-km]"),
        ("rate_route", "for the route [1/veh-km]"),
        ("rate_unknown", "of unknown kind [1/veh-km]"),
    ];
    all.extend(kinds.iter().zip(tally.kinds).map(|((key, name), it)| named(key, name, rate(it, metres))));
    let [low, high] = thirds;
    let classes = [
        ("rate_light", format!("below {low:.0} veh/km of lane [1/veh-km]")),
        ("rate_middle", format!("{low:.0} to {high:.0} veh/km of lane [1/veh-km]")),
        ("rate_dense", format!("from {high:.0} veh/km of lane on [1/veh-km]")),
    ];
    let rates = tally.rates_by_density(thirds);
    all.extend(classes.iter().zip(rates).map(|((key, name), rate)| named(key, name, rate)));
    for number in 0..lanes {
        let (metres, changes) = tally.lanes.get(number).copied().unwrap_or_default();
        let lane = number + 1;
        let name = format!("from lane {lane} [1/veh-km]");
        all.push((format!("rate_lane_{lane}"), name, rate(changes, metres)));
    }
    let faster = tally.gains.iter().filter(|it| **it > 0.0).count() as f64;
    let share = (!tally.gains.is_empty()).then(|| 100.0 * faster / tally.gains.len() as f64);
    let half = |values: &[f64]| quantile(values, 0.5);
    let speed = (seconds > 0.0).then(|| KMH_PER_MPS * metres / seconds);
    all.extend([
        named("faster_share_pct", "to the faster lane [%]", share),
        named("speed_gain_mps", "anticipated gain of speed, median [m/s]", half(&tally.gains)),
        named("lead_gap_m", "gap to the new leader, median [m]", half(&tally.gaps[0])),
        named("lag_gap_m", "gap to the new follower, median [m]", half(&tally.gaps[1])),
        named("duration_s", "duration of a change, median [s]", half(&tally.durations)),
        named("speed_kmh", "mean speed [km/h]", speed),
        named("pace_s_per_km", "travel time, median [s/km]", half(&tally.paces)),
        named("pace_p10_s_per_km", "travel time, a tenth take less [s/km]", quantile(&tally.paces, 0.1)),
        named("pace_p90_s_per_km", "travel time, a tenth take more [s/km]", quantile(&tally.paces, 0.9)),
    ]);
    all
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
            recorded_is,
            from_parameters: share_between(&groups),
            more_than_fitted,
            is_told_apart: more_than_fitted.is_some_and(|it| !(0.025..=0.975).contains(&it)),
        }
    }

    /// Whether the recorded value lies outside of the interval.
    pub fn is_missed(&self) -> bool {
        matches!(self.recorded_is, "below" | "above")
    }
}
