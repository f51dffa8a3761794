//! How well the drivers of a replay match what was recorded of them.

use std::collections::BTreeMap;

use laneweave_scenario::Player;
use laneweave_scenario::scenario::Scenario;
use laneweave_scenario::style::Model;
use laneweave_study::{Estimate, mean};
use serde::Serialize;

use super::collisions::Collisions;
use super::parting::Parting;
use super::score::{KINDS, all_scores};
use super::trace::Trace;
use super::{Traces, Watched};

/// How well the drivers of a replay match what was recorded of them. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReplayReport {
    /// From the first frame to the last [s].
    pub duration_s: f64,
    /// Length of a step [s].
    pub step_s: f64,
    /// Recorded vehicles that came; a vehicle that was lost and seen again counts twice.
    pub recorded: usize,
    /// Of them, those that became drivers.
    pub reactive: usize,
    /// Those that were chosen, but never became drivers: they were in no lane from which a route leads on.
    pub never_in_a_lane: usize,
    /// The drivers of the scenario, and those with other lane-change models.
    pub models: Vec<Matched>,
    /// The drivers of the first rollout, whose tables are written.
    pub drivers: Vec<Driver>,
    /// The ids that recorded vehicles have in its tables.
    pub vehicles: Vec<Named>,
}

/// How well the drivers with one lane-change model match the recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Matched {
    /// The model; `own`: those of the drivers' styles.
    pub model: &'static str,
    /// Rollouts, each with other random numbers.
    pub rollouts: usize,
    /// How far drivers part from their records.
    pub parting: Parting,
    /// Collisions, a mean over the rollouts.
    pub collisions: CollisionMeans,
    /// How likely the records are: means over the drivers [nats].
    pub score: Score,
    /// The difference of the whole score from that of the first model, paired by driver; none for the first.
    pub difference: Option<Difference>,
}

/// Pairs of vehicles that collided in a rollout, in the mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CollisionMeans {
    /// A reactive driver was at fault.
    pub by_reactive: f64,
    /// A recorded vehicle was at fault, which does not react.
    pub by_recorded: f64,
    /// Between two reactive drivers.
    pub between_reactive: f64,
    /// Between two recorded vehicles.
    pub between_recorded: f64,
}

/// Mean logarithms of the densities of what was recorded, under the rollouts [nats]. Higher is better.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Score {
    /// Drivers that were scored.
    pub drivers: usize,
    /// Of a speed.
    pub speed: f64,
    /// Of an acceleration.
    pub acceleration: f64,
    /// Of a gap.
    pub gap: f64,
    /// Of the time of the first lane change, or of none.
    pub lane_change: f64,
    /// The sum of the four.
    pub whole: f64,
}

/// A difference of mean scores with its 95 % interval [nats].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The difference.
    pub mean: f64,
    /// Half of the interval.
    pub half_width: f64,
}

/// The id of a recorded vehicle in the tables; a vehicle that was lost and seen again has several.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Named {
    /// Its id in the recording.
    pub recorded: i64,
    /// Its id in the tables.
    pub vehicle: u32,
}

/// A reactive driver of the first rollout.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Driver {
    /// Its id in the recording.
    pub recorded: i64,
    /// When it became a driver [s].
    pub from_s: f64,
    /// Until when it was recorded [s].
    pub recorded_until_s: f64,
    /// When it first changed lanes [s].
    pub changed_s: Option<f64>,
    /// When it did so in the recording [s].
    pub recorded_change_s: Option<f64>,
}

impl ReplayReport {
    /// The report on `rollouts`, by model; `recorded` is the recording in which nobody reacts.
    pub(super) fn of(
        scenario: &Scenario,
        player: &Player,
        recorded: &Watched,
        rollouts: Vec<(Option<Model>, Vec<Watched>)>,
    ) -> ReplayReport {
        let dt = scenario.run.step_s;
        let record = &recorded.tracer.traces;
        let first = rollouts.first().and_then(|it| it.1.first());
        let never_in_a_lane = first.map_or(0, |it| it.chosen.len().saturating_sub(it.tracer.traces.len()));
        let vehicles = first.map_or(Vec::new(), |it| it.vehicles.clone());
        let drivers = first.map_or(Vec::new(), |first| {
            first.tracer.traces.iter().map(|(id, trace)| driver(*id, trace, record.get(id), dt)).collect()
        });
        let mut models: Vec<Matched> = Vec::new();
        let mut reference: Option<BTreeMap<i64, [f64; KINDS]>> = None;
        for (model, watched) in rollouts {
            let collisions: Vec<Collisions> = watched.iter().map(|it| it.collisions.collisions).collect();
            let traces: Vec<Traces> = watched.into_iter().map(|it| it.tracer.traces).collect();
            let scores = all_scores(record, &traces, dt);
            models.push(Matched {
                model: model.map_or("own", Model::name),
                rollouts: traces.len(),
                parting: Parting::of(record, &traces, dt),
                collisions: means(&collisions),
                score: Score::of(&scores),
                difference: reference.as_ref().and_then(|it| difference(&scores, it)),
            });
            reference.get_or_insert(scores);
        }
        ReplayReport {
            duration_s: player.duration_s(),
            step_s: dt,
            recorded: recorded.vehicles.len(),
            reactive: drivers.len(),
            never_in_a_lane,
            models,
            drivers,
            vehicles,
        }
    }

    /// In words.
    pub fn to_text(&self) -> String {
        let mut text = format!(
            "{:.1} s of the recording in steps of {} s: {} recorded vehicles, {} of them became drivers\n",
            self.duration_s, self.step_s, self.recorded, self.reactive
        );
        if self.never_in_a_lane > 0 {
            text += &format!(
                "{} more were chosen, but were in no lane from which a route leads on: they drive as they were recorded\n",
                self.never_in_a_lane
            );
        }
        if self.reactive == 0 {
            return text + "Nobody reacts: all vehicles drive as they were recorded.\n";
        }
        text += "\nmodel                 parted     collisions by       nats: speed  acceleration     gap  lane change   whole\n";
        text += "                        in 5 s  reactive  recorded\n";
        for it in &self.models {
            let Score { speed, acceleration, gap, lane_change, whole, .. } = it.score;
            text += &format!(
                "{:20} {:7.1} % {:9.1} {:9.1} {:17.3} {:13.3} {:7.3} {:12.3} {:7.3}",
                it.model,
                100.0 * it.parting.parted_share,
                it.collisions.by_reactive,
                it.collisions.by_recorded,
                speed,
                acceleration,
                gap,
                lane_change,
                whole
            );
            if let Some(Difference { mean, half_width }) = it.difference {
                text += &format!(" ({mean:+.3} ± {half_width:.3})");
            }
            text += "\n";
        }
        text
    }
}

impl Score {
    fn of(scores: &BTreeMap<i64, [f64; KINDS]>) -> Score {
        let drivers = scores.len();
        let mean = |kind: usize| scores.values().map(|it| it[kind]).sum::<f64>() / drivers.max(1) as f64;
        let [speed, acceleration, gap, lane_change] = std::array::from_fn(mean);
        Score {
            drivers,
            speed,
            acceleration,
            gap,
            lane_change,
            whole: speed + acceleration + gap + lane_change,
        }
    }
}

/// The mean difference of whole scores, over the drivers that both have.
fn difference(
    scores: &BTreeMap<i64, [f64; KINDS]>,
    reference: &BTreeMap<i64, [f64; KINDS]>,
) -> Option<Difference> {
    let whole = |it: &[f64; KINDS]| it.iter().sum::<f64>();
    let pairs = scores.iter().filter_map(|(id, it)| Some(whole(it) - whole(reference.get(id)?)));
    let Estimate { mean, half_width, .. } = mean(&pairs.collect::<Vec<f64>>())?;
    Some(Difference { mean, half_width })
}

fn driver(id: i64, trace: &Trace, record: Option<&Trace>, dt: f64) -> Driver {
    let seconds = |step: u32| f64::from(step) * dt;
    Driver {
        recorded: id,
        from_s: seconds(trace.from),
        recorded_until_s: seconds(record.map_or(trace.from, |it| it.until)),
        changed_s: trace.changed.map(seconds),
        recorded_change_s: record.and_then(|it| it.changed).map(seconds),
    }
}

fn means(all: &[Collisions]) -> CollisionMeans {
    let mean =
        |of: fn(&Collisions) -> usize| all.iter().map(of).sum::<usize>() as f64 / all.len().max(1) as f64;
    CollisionMeans {
        by_reactive: mean(|it| it.by_reactive),
        by_recorded: mean(|it| it.by_recorded),
        between_reactive: mean(|it| it.between_reactive),
        between_recorded: mean(|it| it.between_recorded),
    }
}
