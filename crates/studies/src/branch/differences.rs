//! The differences between twins: which vehicles differ, since when, and with what effect.

use std::collections::BTreeMap;
use std::fmt::Write;

use laneweave::{Event, Phase, Simulation, VehicleId};
use laneweave_results::numbers::signed;
use laneweave_study::units::KMH_PER_MPS;

/// Twins are compared after every step, and the result is stored at this interval [s].
const EVERY: f64 = 1.0;

/// The twins at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Time [s].
    pub time_s: f64,
    /// Vehicles on the road in either.
    pub on_road: u32,
    /// Of these, those with another place, speed or desire, and those on the road in only one of the runs.
    pub differ: u32,
    /// Lane changes since the branch time, in the base and in the branch.
    pub lane_changes: [u64; 2],
    /// Mean speeds over all vehicles [m/s].
    pub mean_speed_mps: [f64; 2],
}

/// A vehicle that differs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vehicle {
    /// Its style.
    pub style: String,
    /// Its class.
    pub class: &'static str,
    /// Since when [s].
    pub since_s: f64,
    /// Lane changes since the branch time, in the base and in the branch.
    pub lane_changes: [u32; 2],
    /// Time at which it completed its trip, in the base and in the branch [s].
    pub completed_s: [Option<f64>; 2],
}

/// What differs between the twins, vehicle by vehicle and second by second.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    /// The branch time [s].
    pub since_s: f64,
    /// Second by second, and the last instant.
    pub instants: Vec<Instant>,
    /// Vehicles that differ, by id.
    pub vehicles: BTreeMap<VehicleId, Vehicle>,
    /// Vehicles that completed their trips in both, but at different times.
    changes: [u64; 2],
    by_vehicle: BTreeMap<VehicleId, [u32; 2]>,
    completed: BTreeMap<VehicleId, [Option<f64>; 2]>,
}

/// The state of a vehicle that is compared: its name, lane, place, speed and state.
type State = (VehicleId, u32, u64, u64, Phase);

impl Differences {
    /// No differences yet, between `base` and its twin.
    pub(super) fn between(base: &Simulation) -> Differences {
        Differences {
            since_s: base.time_s(),
            instants: Vec::new(),
            vehicles: BTreeMap::new(),
            changes: [0; 2],
            by_vehicle: BTreeMap::new(),
            completed: BTreeMap::new(),
        }
    }

    /// Compares both after a step.
    pub(super) fn observe(&mut self, base: &Simulation, branch: &Simulation) {
        for (which, simulation) in [base, branch].into_iter().enumerate() {
            for event in simulation.events() {
                match event {
                    Event::LaneChange(change) if change.is_completed => {
                        self.changes[which] += 1;
                        self.by_vehicle.entry(change.vehicle).or_default()[which] += 1;
                    }
                    Event::Completed { occurrence, .. } => {
                        self.completed.entry(occurrence.vehicle).or_default()[which] =
                            Some(simulation.time_s());
                    }
                    _ => {}
                }
            }
        }
        let counts = self.compare(base, branch);
        if base.clock().step.is_multiple_of(base.clock().steps(EVERY)) {
            self.keep(base, branch, counts);
        }
    }

    /// Records the ends of the vehicles that differ, after the end of the twins.
    pub(super) fn complete(&mut self, base: &Simulation, branch: &Simulation) {
        if self.instants.last().is_none_or(|it| it.time_s < base.time_s()) {
            let counts = self.compare(base, branch);
            self.keep(base, branch, counts);
        }
        for (id, vehicle) in &mut self.vehicles {
            vehicle.lane_changes = self.by_vehicle.get(id).copied().unwrap_or_default();
            vehicle.completed_s = self.completed.get(id).copied().unwrap_or_default();
        }
    }

    /// Numbers of vehicles on the road in either, and of those that differ; a first difference is recorded.
    fn compare(&mut self, base: &Simulation, branch: &Simulation) -> [u32; 2] {
        let time_s = base.time_s();
        if base.views().map(state).eq(branch.views().map(state)) {
            return [base.views().count() as u32, 0];
        }
        let states = [base, branch].map(states);
        let (mut on_road, mut differ, [mut a, mut b]) = (0, 0, [0, 0]);
        while a < states[0].len() || b < states[1].len() {
            let [one, other] = [states[0].get(a), states[1].get(b)];
            let id = one.map_or(VehicleId::MAX, |it| it.0).min(other.map_or(VehicleId::MAX, |it| it.0));
            let here = one.filter(|it| it.0 == id);
            let there = other.filter(|it| it.0 == id);
            on_road += 1;
            if here != there {
                differ += 1;
                let side = if here.is_some() { base } else { branch };
                self.vehicles.entry(id).or_insert_with(|| found(side, id, time_s));
            }
            a += usize::from(here.is_some());
            b += usize::from(there.is_some());
        }
        [on_road, differ]
    }

    /// Stores this instant.
    fn keep(&mut self, base: &Simulation, branch: &Simulation, [on_road, differ]: [u32; 2]) {
        let (time_s, mean_speed_mps) = (base.time_s(), [base, branch].map(mean_speed));
        self.instants.push(Instant { time_s, on_road, differ, lane_changes: self.changes, mean_speed_mps });
    }

    /// Whether there are no differences.
    pub fn are_none(&self) -> bool {
        self.vehicles.is_empty()
    }

    /// The differences for the screen, with changed `settings`.
    pub fn to_text(&self, settings: &str) -> String {
        let mut text = String::new();
        for (name, value) in self.facts(settings) {
            // Writing to a string never fails.
            let _ = writeln!(text, "  {name:<17}{value}");
        }
        text
    }

    /// The differences in words, with changed `settings`: names and their values.
    pub(super) fn facts(&self, settings: &str) -> Vec<(&'static str, String)> {
        let mut facts = vec![("branch", format!("from {:.1} s on, with {settings}", self.since_s))];
        let first =
            self.vehicles.iter().min_by(|a, b| a.1.since_s.total_cmp(&b.1.since_s).then(a.0.cmp(b.0)));
        let Some((id, vehicle)) = first else {
            facts.push(("differences", "none: both runs are the same to the last bit".into()));
            return facts;
        };
        facts.push(("first", format!("vehicle {id} ({}) at {:.1} s", vehicle.style, vehicle.since_s)));
        let Some(last) = self.instants.last() else { return facts };
        let share = 100.0 * f64::from(last.differ) / f64::from(last.on_road.max(1));
        let met = self.vehicles.len();
        facts.push(("differ", format!("{met} vehicles; at the end {share:.0} % of those on the road")));
        let both = |of: [f64; 2], unit: &str, digits: usize| {
            format!("{:.digits$} → {:.digits$}{unit} ({})", of[0], of[1], signed(of[1] - of[0], digits))
        };
        facts.push(("lane changes", both(self.changes.map(|it| it as f64), "", 0)));
        let speeds = [0, 1].map(|which| {
            let all: f64 = self.instants.iter().map(|it| it.mean_speed_mps[which]).sum();
            KMH_PER_MPS * all / self.instants.len() as f64
        });
        facts.push(("mean speed", both(speeds, " km/h", 1)));
        let left =
            [0, 1].map(|which| self.completed.values().filter(|it| it[which].is_some()).count() as f64);
        facts.push(("completed trips", both(left, "", 0)));
        let later: Vec<f64> = self.later().collect();
        if !later.is_empty() {
            let mean = later.iter().sum::<f64>() / later.len() as f64;
            facts.push((
                "trips in both",
                format!("{} vehicles, on average {:.2} s {}", later.len(), mean.abs(), when(mean)),
            ));
        }
        facts
    }

    /// The delays in the branch relative to the base, of the vehicles that completed their trips in both [s].
    pub(super) fn later(&self) -> impl Iterator<Item = f64> {
        self.completed.values().filter_map(|[base, branch]| Some(branch.as_ref()? - base.as_ref()?))
    }
}

/// Whether so many seconds are later or earlier.
fn when(seconds: f64) -> &'static str {
    if seconds < 0.0 { "earlier" } else { "later" }
}

fn state(it: laneweave::sim::Vehicle) -> State {
    (it.id(), it.spot.chain.0, it.x().to_bits(), it.speed().to_bits(), it.driver.phase)
}

/// All vehicles in the order of their ids.
fn states(simulation: &Simulation) -> Vec<State> {
    let mut states: Vec<State> = simulation.views().map(state).collect();
    states.sort_unstable_by_key(|it| it.0);
    states
}

fn mean_speed(simulation: &Simulation) -> f64 {
    let (sum, count) = simulation.views().fold((0.0, 0), |(sum, count), it| (sum + it.speed(), count + 1));
    if count == 0 { 0.0 } else { sum / f64::from(count) }
}

fn found(simulation: &Simulation, id: VehicleId, since_s: f64) -> Vehicle {
    let vehicle = simulation.view(id);
    let style = vehicle.map_or(String::new(), |it| it.style().name.clone());
    let class = vehicle.map_or("", |it| it.driver.class.body().name);
    Vehicle { style, class, since_s, lane_changes: [0; 2], completed_s: [None; 2] }
}
