//! What is observed of a run.

use std::collections::BTreeMap;

use laneweave::models::follow::Ahead;
use laneweave::sim::{Counters, Counts};
use laneweave::study::Moments;
use laneweave::{Event, LaneChange, LaneChangeKind, Phase, Side, Simulation, VehicleId};

use crate::experiments::outcomes::Outcomes;

/// Length of a section in which speeds are averaged [m], and time over which they are [s].
pub(crate) const SECTION: f64 = 100.0;
pub(crate) const INTERVAL: f64 = 10.0;
/// Vehicles are looked at in this rhythm [s].
const EVERY: f64 = 1.0;
/// A change is reversed if the driver goes back within this time [s] (model.md §11 has the same).
const BACK_WITHIN: f64 = 30.0;
/// Time gaps are measured of drivers within 10 km/h of 100 km/h [m/s] who follow as fast as their leader, within
/// 1 m/s, up to this gap [s].
const FOLLOWING_SPEED: [f64; 2] = [25.0, 30.556];
const AS_FAST: f64 = 1.0;
const LONGEST_GAP: f64 = 3.0;
/// Gaps of lane changes count up to this length [m].
const FURTHEST: f64 = 200.0;

/// What is observed of a run, after its warm-up.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    /// Counts of the simulation.
    pub(crate) counters: Counters,
    pub(crate) counts: Counts,
    /// Completed discretionary changes: anticipated gains of speed [m/s], how many gain, how many are reversed.
    pub(crate) gains: Moments,
    pub(crate) gaining: u32,
    pub(crate) reversed: u32,
    /// Durations of completed changes [s]: discretionary and route-driven.
    pub(crate) durations: [Vec<f64>; 2],
    /// Gaps to the new leader and to the new follower when completed changes began [m]; none where nobody was in sight.
    pub(crate) gaps: [Vec<f64>; 2],
    /// What came of completed changes, on motorways without ramps.
    pub(crate) outcomes: Outcomes,
    /// By style: completed discretionary changes, and vehicle-kilometres.
    pub(crate) of_style: BTreeMap<String, (u32, f64)>,
    /// Samples of drivers who wait for a gap, and of drivers who make room for one.
    pub(crate) waiting: u32,
    pub(crate) making_room: u32,
    /// By lane from the slow side, on motorways: vehicle-seconds times speed, the metres driven.
    pub(crate) metres_by_lane: Vec<f64>,
    /// Time gaps of followers at about 100 km/h by style [s].
    pub(crate) time_gaps: BTreeMap<String, Moments>,
    /// Times at which vehicles completed their trips, from the end of the warm-up [s].
    pub(crate) completed: Vec<f64>,
    /// By section and by interval: sum of speeds and number of samples.
    pub(crate) speeds: Vec<Vec<(f64, u32)>>,
    last: BTreeMap<VehicleId, (f64, Side)>,
}

impl Seen {
    /// Observes the traffic after a step with these events; `time` is counted from the end of the warm-up [s].
    pub(crate) fn observe(&mut self, simulation: &Simulation, events: &[Event], time: f64) {
        for event in events {
            match event {
                Event::Completed { .. } => self.completed.push(time),
                Event::LaneChange(it) if it.is_completed => {
                    self.note_change(it);
                    self.outcomes.note(simulation, it);
                }
                _ => {}
            }
        }
        self.outcomes.look(simulation);
        if (time / EVERY).fract() < simulation.step_s() / EVERY * 0.999 {
            self.look(simulation, time);
        }
    }

    /// The end of a run.
    pub(crate) fn end(&mut self, simulation: &Simulation) {
        (self.counters, self.counts) = (simulation.counters(), *simulation.counts());
    }

    fn note_change(&mut self, change: &LaneChange) {
        let before = self.last.insert(change.vehicle, (change.time_s, change.side));
        for (gaps, gap) in self.gaps.iter_mut().zip([change.gap_ahead_m, change.gap_behind_m]) {
            gaps.extend(gap.filter(|it| *it < FURTHEST));
        }
        match change.kind {
            LaneChangeKind::Discretionary => {
                self.gains.add(change.speed_gain_mps);
                self.gaining += u32::from(change.speed_gain_mps > 0.0);
                let is_back = |(time, side)| side != change.side && change.time_s - time <= BACK_WITHIN;
                self.reversed += u32::from(before.is_some_and(is_back));
                self.durations[0].push(change.duration_s);
                self.of_style.entry(change.style.clone()).or_default().0 += 1;
            }
            LaneChangeKind::Route => self.durations[1].push(change.duration_s),
            LaneChangeKind::Keeping => {}
        }
    }

    fn look(&mut self, simulation: &Simulation, time: f64) {
        let scene = simulation.scene();
        let interval = (time / INTERVAL) as usize;
        for vehicle in simulation.views() {
            let (style, speed) = (&vehicle.style().name, vehicle.speed());
            // A name is copied once only.
            if !self.of_style.contains_key(style) {
                self.of_style.insert(style.clone(), (0, 0.0));
            }
            if let Some((_, km)) = self.of_style.get_mut(style) {
                *km += speed * EVERY / 1000.0;
            }
            self.waiting += u32::from(vehicle.driver.phase == Phase::Wants);
            self.making_room += u32::from(vehicle.lane_change.lets_in.0.is_finite());
            let lane = vehicle.spot.chain.at();
            if self.metres_by_lane.len() <= lane {
                self.metres_by_lane.resize(lane + 1, 0.0);
            }
            self.metres_by_lane[lane] += speed * EVERY;
            let section = (vehicle.pose().at.x.max(0.0) / SECTION) as usize;
            if self.speeds.len() <= section {
                self.speeds.resize(section + 1, Vec::new());
            }
            let of_section = &mut self.speeds[section];
            if of_section.len() <= interval {
                of_section.resize(interval + 1, (0.0, 0));
            }
            of_section[interval].0 += speed;
            of_section[interval].1 += 1;
            let is_fast = (FOLLOWING_SPEED[0]..FOLLOWING_SPEED[1]).contains(&speed);
            let ahead = || scene.ahead(scene.viewpoint(vehicle.spot));
            if let Some(gap) = is_fast.then(ahead).and_then(|it| time_gap(it, speed)) {
                self.time_gaps.entry(style.clone()).or_default().add(gap);
            }
        }
    }

    /// Courtesy received: how many drivers make room for a driver who waits for a gap, in the mean over time [%].
    pub(crate) fn courtesy(&self) -> Option<f64> {
        (self.waiting > 0).then(|| 100.0 * f64::from(self.making_room) / f64::from(self.waiting))
    }

    /// Vehicle-kilometres.
    pub(crate) fn veh_km(&self) -> f64 {
        self.counters.distance / 1000.0
    }
}

/// The time gap [s] of a driver at `speed` who follows.
fn time_gap(ahead: Option<Ahead>, speed: f64) -> Option<f64> {
    let ahead = ahead.filter(|it| (it.speed - speed).abs() < AS_FAST)?;
    (ahead.gap < LONGEST_GAP * speed).then(|| ahead.gap / speed)
}
