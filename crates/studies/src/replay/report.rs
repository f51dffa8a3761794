//! How well the drivers of a replay match what was recorded of them.

use std::collections::BTreeMap;

use laneweave_scenario::Player;
use laneweave_scenario::scenario::Scenario;
use laneweave_scenario::style::Model;
use laneweave_study::{Estimate, mean};
use serde::Serialize;

use super::collisions::Collisions;
use super::departed::{Example, HandedOver, LateStart};
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
    /// Those of them who began later than their records, or behind them.
    pub late: Vec<LateStart>,
    /// The hand-overs of the first rollout.
    pub handed_over: Vec<HandedOver>,
    /// The driver that is compared for the longest time, in the rollouts of the first model.
    pub example: Option<Example>,
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
    /// Collisions for each driver, but those between recorded vehicles on their records.
    pub contacts_per_driver: Option<Mean>,
    /// How much of the replay is as recorded.
    pub hand_overs: HandOvers,
    /// How likely the records are: means over the drivers [nats].
    pub score: Score,
    /// The difference of the whole score from that of the first model, paired by driver; none for the first.
    pub difference: Option<Difference>,
}

/// A mean over the rollouts with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Half of the interval; none with one rollout.
    pub half_width: Option<f64>,
}

/// How much of a replay is as recorded, in the mean of the rollouts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct HandOvers {
    /// Hand-overs per vehicle-kilometre of recorded vehicles.
    pub per_veh_km: Option<Mean>,
    /// Share of the time of recorded vehicles in which they are handed over.
    pub share: Option<Mean>,
    /// Share of the time of drivers in which they are compared with their records: until a recorded vehicle is first
    /// handed over because of them.
    pub compared_share: Option<Mean>,
    /// Drivers who were taken off the road when their records ended.
    pub taken_off: f64,
    /// Drivers who began later than their records, or behind them.
    pub late: f64,
    /// Vehicles, drivers or not, for which there was no room before their records ended.
    pub never_came: f64,
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
    /// Of a vehicle that was handed over, with anybody.
    pub of_handed_over: f64,
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
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Named {
    /// Its id in the recording.
    pub recorded: i64,
    /// What the recording's file has as its id, where that is no number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
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
        let reactive = first.map_or(0, |it| it.exposure.drivers());
        let late = first.map_or(Vec::new(), |it| {
            it.exposure.departures.starts.iter().map(|it| LateStart::of(it, dt)).collect()
        });
        let handed_over = first.map_or(Vec::new(), |it| {
            it.exposure.departures.hand_overs.iter().map(|it| HandedOver::of(it, dt)).collect()
        });
        let example = rollouts.first().and_then(|it| Example::of(record, &it.1));
        let never_in_a_lane = first.map_or(0, |it| it.chosen.len().saturating_sub(reactive));
        let vehicles = first.map_or(Vec::new(), |it| it.vehicles.clone());
        let drivers = first.map_or(Vec::new(), |first| {
            first.tracer.traces.iter().map(|(id, trace)| driver(*id, trace, record.get(id), dt)).collect()
        });
        let mut models: Vec<Matched> = Vec::new();
        let mut reference: Option<BTreeMap<i64, [f64; KINDS]>> = None;
        for (model, watched) in rollouts {
            let hand_overs = HandOvers::of(&watched);
            let contacts_per_driver = over(&watched, |it| {
                let drivers = it.exposure.drivers();
                (drivers > 0).then(|| it.collisions.collisions.contacts() as f64 / drivers as f64)
            });
            let collisions: Vec<Collisions> = watched.iter().map(|it| it.collisions.collisions).collect();
            let traces: Vec<Traces> = watched.into_iter().map(|it| it.tracer.traces).collect();
            let scores = all_scores(record, &traces, dt);
            models.push(Matched {
                model: model.map_or("own", Model::name),
                rollouts: traces.len(),
                parting: Parting::of(record, &traces, dt),
                collisions: means(&collisions),
                contacts_per_driver,
                hand_overs,
                score: Score::of(&scores),
                difference: reference.as_ref().and_then(|it| difference(&scores, it)),
            });
            reference.get_or_insert(scores);
        }
        ReplayReport {
            duration_s: player.duration_s(),
            step_s: dt,
            recorded: recorded.vehicles.len(),
            reactive,
            never_in_a_lane,
            models,
            drivers,
            late,
            handed_over,
            example,
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
        text += "\n                      contacts   handed over   compared   metres from the record after   nats: whole\n";
        text += "model                 a driver        in time    in time              3 s         5 s\n";
        for it in &self.models {
            let HandOvers { share, compared_share, .. } = it.hand_overs;
            let percent =
                |it: Option<Mean>| it.map_or("–".into(), |it| format!("{:.1} %", 100.0 * it.mean));
            let contacts = it.contacts_per_driver.map_or("–".into(), |it| format!("{:.2}", it.mean));
            let metres = |time: f64| {
                let after = it.parting.after.iter().find(|it| it.time_s == time);
                after.map_or("–".into(), |it| format!("{:.2}", it.distance_m))
            };
            let [three, five] = [3.0, 5.0].map(metres);
            text += &format!(
                "{:20} {contacts:>9} {:>13} {:>10} {three:>16} {five:>11} {:>13.3}",
                it.model,
                percent(share),
                percent(compared_share),
                it.score.whole
            );
            if let Some(Difference { mean, half_width }) = it.difference {
                text += &format!(" ({mean:+.3} ± {half_width:.3})");
            }
            text += "\n";
        }
        text += &self.constant_speed();
        text
    }
}

impl ReplayReport {
    /// How far the drivers of the first model would be from their records at constant speed, in words.
    fn constant_speed(&self) -> String {
        let Some(first) = self.models.first() else { return String::new() };
        let metres = |time: f64| {
            let after = first.parting.after.iter().find(|it| it.time_s == time);
            after.map_or("–".into(), |it| format!("{:.2}", it.constant_speed_m))
        };
        let [three, five] = [3.0, 5.0].map(metres);
        format!("{:20} {:>9} {:>13} {:>10} {three:>16} {five:>11}\n", "constant speed", "", "", "")
    }
}

impl HandOvers {
    fn of(rollouts: &[Watched]) -> HandOvers {
        let count = |of: fn(&Watched) -> usize| {
            rollouts.iter().map(of).sum::<usize>() as f64 / rollouts.len().max(1) as f64
        };
        HandOvers {
            per_veh_km: over(rollouts, |it| it.exposure.hand_overs_per_km()),
            share: over(rollouts, |it| it.exposure.handed_over()),
            compared_share: over(rollouts, |it| it.exposure.compared()),
            taken_off: count(|it| it.exposure.departures.taken_off.len()),
            late: count(|it| it.exposure.departures.starts.len()),
            never_came: count(|it| it.exposure.departures.never_came.len()),
        }
    }
}

/// The mean over rollouts of what `of` tells of them.
fn over(rollouts: &[Watched], of: impl Fn(&Watched) -> Option<f64>) -> Option<Mean> {
    let all: Vec<f64> = rollouts.iter().filter_map(of).collect();
    let Estimate { mean, half_width, .. } = mean(&all)?;
    Some(Mean { mean, half_width: half_width.is_finite().then_some(half_width) })
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
        of_handed_over: mean(|it| it.of_handed_over),
        between_recorded: mean(|it| it.between_recorded),
    }
}
