//! The summary of a run in numbers: the file `summary.json`, and the table on screen.

use std::fmt::Write as _;
use std::path::PathBuf;

use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Prepared, Scenario};
use laneweave_sim::World;
use laneweave_study::seconds;
use laneweave_study::units::{KMH_PER_MPS, METRES_PER_KM};
use serde::Serialize;

use super::ending::Ending;
use super::first_incident::FirstIncident;
use super::provenance::Provenance;
use super::queues::Queue;
use crate::whole_file::json;

/// Maximum of queues that are named on the screen.
const LISTED_QUEUES: usize = 3;

/// The numbers of a run. Fields are added, never renamed; unknown values (a mean of nothing) are null.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Vehicles that entered in the measured time; those on the road at its begin count as entered.
    pub entered: u64,
    /// Vehicles that completed their trip.
    pub completed: u64,
    /// Vehicles that a user put on the road; they are among those that entered.
    pub inserted: u64,
    /// Vehicles that a user took off the road.
    pub removed: u64,
    /// Commands of the scenario that were not possible when they were due.
    pub commands_refused: u64,
    /// Completed trips that start and end on one lanelet; they are not in the means over trips.
    pub trips_of_one_lanelet: u64,
    /// Vehicles on the road at the end.
    pub on_road: u64,
    /// Vehicles that wait to enter at the end: the insertion backlog.
    pub waiting_to_enter: u64,
    /// The estimated capacity of the map [veh/h].
    pub estimated_capacity_veh_h: f64,
    /// The estimated demand from which on queues grow [veh/h].
    pub queues_from_veh_h: f64,
    /// The bottleneck: what is full first when the demand grows.
    pub bottleneck: Option<String>,
    /// Completed crossings of all three kinds.
    pub lane_changes: u64,
    /// Of them, between lanes of equal worth for the route.
    pub lane_changes_discretionary: u64,
    /// Of them, route-driven (mandatory) ones.
    pub lane_changes_route_driven: u64,
    /// Of them, those made only to keep to the slow side.
    pub lane_changes_keeping: u64,
    /// Lane changes per vehicle-kilometre.
    pub lane_changes_per_veh_km: Option<f64>,
    /// Distance driven [veh km].
    pub veh_km: f64,
    /// Times that a vehicle touched the one ahead on its path, or that two vehicles met while they came closer to
    /// each other.
    pub collisions: u64,
    /// Other times that two vehicles began to overlap.
    pub overlaps: u64,
    /// Collisions and overlaps.
    pub incidents: u64,
    /// The first of them, if there was any.
    pub first_incident: Option<FirstIncident>,
    /// Braking events that kinematics, not the model, decided.
    pub emergency_brakings: u64,
    /// Times that a vehicle began to brake with more than 4 m/s², whoever decided it.
    pub hard_brakings: u64,
    /// Vehicles that stood for 300 s.
    pub stuck: u64,
    /// Drivers who missed a turn.
    pub missed_turns: u64,
    /// Drivers without any route left to a destination.
    pub lost: u64,
    /// Drivers who took another route, including all who missed a turn.
    pub rerouted: u64,
    /// Times that a driver left its route for a better one.
    pub route_changes: u64,
    /// Times that a driver considered lanes.
    pub considerations: u64,
    /// Vehicles on the road summed over steps.
    pub updates: u64,
    /// Wall time of the process up to this summary [s].
    pub wall_s: f64,
    /// Of it, the time until measuring began: reading the inputs, and the warm-up [s].
    pub load_s: f64,
    /// Updates per second of the remaining time.
    pub updates_per_s: f64,
    /// Mean speed over all vehicles and steps [m/s].
    pub mean_speed_mps: Option<f64>,
    /// Mean time on the map of the completed trips [s].
    pub mean_trip_duration_s: Option<f64>,
    /// Mean delay of the completed trips beyond the time on a free road [s].
    pub mean_delay_s: Option<f64>,
    /// Mean number of stops of the completed trips.
    pub mean_stops: Option<f64>,
    /// The remaining queues at the entrances, the longest first.
    pub queues: Vec<Queue>,
    /// The lines of buses of the scenario.
    pub lines: Vec<LineServed>,
    /// Maximum memory of the process [MB]; 0 where the system does not report it.
    pub peak_rss_mb: f64,
    /// Hash of all vehicles' states at the end, 16 hexadecimal digits.
    pub state_hash: String,
    /// Hash of everything on which the run depended: version, scenario, styles, map.
    pub fingerprint: String,
    /// The command line.
    pub command: String,
    /// Demand over all entrances [veh/h].
    pub demand_veh_h: f64,
    /// Simulated and measured time [s].
    pub duration_s: f64,
    /// Simulated time before it [s].
    pub warmup_s: f64,
    /// Whether the run was interrupted before its end.
    pub interrupted: bool,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Number of threads.
    pub threads: usize,
    /// Version of the program.
    pub version: &'static str,
    /// The path of the map, as the scenario names it.
    pub map: String,
}

/// What the vehicles of a line of buses did.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LineServed {
    /// The name of the line.
    pub name: String,
    /// Vehicles that have departed, with the warm-up.
    pub departed: u32,
    /// Stops that they served after the warm-up.
    pub stops_served: u64,
    /// Stops that they could not get to in time.
    pub stops_missed: u64,
}

impl LineServed {
    /// Those of all lines.
    fn all(world: &World) -> Vec<LineServed> {
        let lines = world.demand().lines.iter().zip(world.lines());
        let all = lines.map(|(line, count)| LineServed {
            name: line.name.clone(),
            departed: count.departed,
            stops_served: count.served,
            stops_missed: count.missed,
        });
        all.collect()
    }

    fn to_text(&self) -> String {
        let LineServed { name, departed, stops_served, stops_missed } = self;
        format!("{name}: {departed} departed, {stops_served} stops served, {stops_missed} missed")
    }
}

/// The inputs of a summary beside the world.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// The scenario.
    pub scenario: &'a Scenario,
    /// How the run ended.
    pub ending: &'a Ending,
    /// See [`Summary::wall_s`].
    pub wall_s: f64,
    /// See [`Summary::load_s`].
    pub load_s: f64,
    /// The provenance.
    pub provenance: &'a Provenance,
}

impl Summary {
    /// The summary of `prepared` after its run.
    pub fn of(prepared: &Prepared, inputs: Inputs) -> Summary {
        let Inputs { scenario, ending, wall_s, load_s, provenance } = inputs;
        let world: &World = &prepared.world;
        let (counters, counts) = (world.counters(), world.counts());
        let trips = ending.short_trips.means_without(counts);
        let veh_km = counters.distance / METRES_PER_KM;
        let lane_changes = counts.discretionary_changes + counts.route_changes + counts.keeping_changes;
        Summary {
            entered: counts.entered,
            completed: counts.left,
            inserted: counts.inserted,
            removed: counts.removed,
            commands_refused: prepared.script.refused(),
            trips_of_one_lanelet: ending.short_trips.count,
            on_road: world.on_road() as u64,
            waiting_to_enter: world.waiting() as u64,
            estimated_capacity_veh_h: prepared.conditions.capacity.veh_h,
            queues_from_veh_h: prepared.conditions.capacity.queues_from_veh_h,
            bottleneck: prepared.conditions.capacity.bottleneck.map(|it| it.to_string()),
            lane_changes,
            lane_changes_discretionary: counts.discretionary_changes,
            lane_changes_route_driven: counts.route_changes,
            lane_changes_keeping: counts.keeping_changes,
            lane_changes_per_veh_km: ratio(lane_changes as f64, veh_km),
            veh_km,
            collisions: counters.collisions,
            overlaps: counters.overlaps,
            incidents: counters.collisions + counters.overlaps,
            first_incident: counts.first_incident.map(|it| FirstIncident::of(world.network(), &it)),
            emergency_brakings: counters.emergency_brakings,
            hard_brakings: counters.hard_brakings,
            stuck: counters.stuck,
            missed_turns: counters.missed_turns,
            lost: counters.lost,
            rerouted: counters.missed_turns,
            route_changes: counters.route_changes,
            considerations: counters.considerations,
            updates: counters.updates,
            wall_s,
            load_s,
            updates_per_s: ratio(counters.updates as f64, wall_s - load_s).unwrap_or(0.0),
            mean_speed_mps: ratio(counters.distance, counters.updates as f64 * scenario.run.step_s),
            mean_trip_duration_s: trips.duration,
            mean_delay_s: trips.delay,
            mean_stops: trips.stops,
            queues: ending.queues.clone(),
            lines: LineServed::all(world),
            peak_rss_mb: peak_rss_mb(),
            state_hash: format!("{:016x}", world.state_hash()),
            fingerprint: provenance.fingerprint.clone(),
            command: provenance.command.clone(),
            demand_veh_h: prepared.conditions.demand_veh_h,
            duration_s: seconds(ending.measured_s),
            warmup_s: seconds(ending.measured_from_s),
            interrupted: ending.is_interrupted,
            seed: scenario.run.seed,
            threads: prepared.threads,
            version: env!("CARGO_PKG_VERSION"),
            map: scenario.map.display().to_string(),
        }
    }

    /// The same summary after so much wall time of the process [s].
    #[must_use]
    pub fn after(mut self, wall_s: f64) -> Summary {
        self.wall_s = wall_s;
        self.updates_per_s = ratio(self.updates as f64, wall_s - self.load_s).unwrap_or(0.0);
        self.peak_rss_mb = peak_rss_mb();
        self
    }

    /// The summary as one JSON object, with a line break at the end.
    ///
    /// # Errors
    /// None, as long as every field can be serialized.
    pub fn to_json(&self) -> Result<String, Fault> {
        json(self)
    }

    /// The summary for the screen, with the files of the run.
    pub fn to_text(&self, styles: &[(String, f64)], files: &[PathBuf]) -> String {
        let mut text = String::new();
        let total: f64 = styles.iter().map(|(_, weight)| weight).sum();
        let mixture: Vec<String> =
            styles.iter().map(|(name, weight)| format!("{:.1} % {name}", 100.0 * weight / total)).collect();
        let mut line = |name: &str, value: String| {
            // Writing to a string never fails.
            let _ = writeln!(text, "  {name:<17}{value}");
        };
        let speed = self.mean_speed_mps.map_or("-".into(), |it| format!("{:.1} km/h", it * KMH_PER_MPS));
        let mean = |mean: Option<f64>, unit| mean.map_or("-".into(), |it| format!("{it:.0}{unit}"));
        let stops = self.mean_stops.map_or("-".into(), |it| format!("{it:.1}"));
        let early = if self.interrupted { ", interrupted" } else { "" };
        let warm = if self.warmup_s > 0.0 {
            format!(" after {} s of warm-up", self.warmup_s)
        } else {
            String::new()
        };
        line("map", self.map.clone());
        line("drivers", mixture.join(", "));
        line("simulated", format!("{} s{warm}{early}, seed {}", self.duration_s, self.seed));
        let first = self.bottleneck.as_ref().map_or(String::new(), |it| format!(" (bottleneck: {it})"));
        line(
            "demand",
            format!(
                "{:.0} veh/h; estimated capacity {:.0} veh/h{first}",
                self.demand_veh_h, self.estimated_capacity_veh_h
            ),
        );
        let removed = match self.removed {
            0 => String::new(),
            count => format!(" + {count} removed"),
        };
        line(
            "vehicles",
            format!(
                "{} entered = {} completed + {} on the road{removed}; {} waiting to enter",
                self.entered, self.completed, self.on_road, self.waiting_to_enter
            ),
        );
        // The longest queues are enough.
        for (number, queue) in self.queues.iter().take(LISTED_QUEUES).enumerate() {
            line(if number == 0 { "waiting" } else { "" }, queue.to_text());
        }
        for (number, served) in self.lines.iter().enumerate() {
            line(if number == 0 { "lines" } else { "" }, served.to_text());
        }
        line("mean speed", format!("{speed} over {:.0} veh-km", self.veh_km));
        line(
            "mean trip",
            format!(
                "{}, including {} of delay; {stops} stops",
                mean(self.mean_trip_duration_s, " s"),
                mean(self.mean_delay_s, " s")
            ),
        );
        line("lane changes", self.lane_changes_text());
        line("route changes", self.route_changes.to_string());
        line("safety", self.safety());
        self.first_incident.iter().for_each(|it| line("first incident", it.to_text()));
        line("run time", self.pace_text());
        line("state hash", self.state_hash.clone());
        for (index, file) in files.iter().enumerate() {
            line(if index == 0 { "files" } else { "" }, file.display().to_string());
        }
        text
    }

    fn lane_changes_text(&self) -> String {
        let per_km =
            |count: u64| ratio(count as f64, self.veh_km).map_or("-".into(), |it| format!("{it:.3}"));
        format!(
            "{} per veh-km: {} discretionary, {} route-driven, {} keeping to the slow side",
            per_km(self.lane_changes),
            per_km(self.lane_changes_discretionary),
            per_km(self.lane_changes_route_driven),
            per_km(self.lane_changes_keeping)
        )
    }

    fn pace_text(&self) -> String {
        format!(
            "{:.2} s, {:.0} times real time, {:.1} million updates/s, {:.0} MB",
            self.wall_s,
            (self.duration_s + self.warmup_s) / self.wall_s,
            self.updates_per_s / 1e6,
            self.peak_rss_mb
        )
    }

    /// Problems of the run, in words.
    fn safety(&self) -> String {
        let &Summary {
            collisions,
            overlaps,
            stuck,
            emergency_brakings,
            hard_brakings,
            missed_turns,
            lost,
            ..
        } = self;
        format!(
            "{collisions} collisions, {overlaps} overlaps, {stuck} stuck, {hard_brakings} hard brakings, \
             {emergency_brakings} emergency brakings, {missed_turns} missed turns, {lost} lost"
        )
    }
}

fn ratio(part: f64, whole: f64) -> Option<f64> {
    (whole > 0.0).then(|| part / whole)
}

fn peak_rss_mb() -> f64 {
    const KB_PER_MB: f64 = 1024.0;
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kb = line.and_then(|it| it.split_whitespace().next()).and_then(|it| it.parse::<f64>().ok());
    kb.map_or(0.0, |it| it / KB_PER_MB)
}
