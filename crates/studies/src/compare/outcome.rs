//! The outcome of a run: measures in which lane-change models differ.

use std::collections::BTreeMap;

use laneweave::{Event, LaneChangeKind, Simulation, VehicleId};
use laneweave_network::Side;
use laneweave_results::output::ShortTrips;
use laneweave_study::EdieRow;
use laneweave_study::units::{KMH_PER_MPS, METRES_PER_KM};

/// A change to the opposite side within this time undoes the one before [s].
const BACK_WITHIN: f64 = 30.0;

/// The outcome of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Lane changes between lanes of equal worth for the route, and all others, per vehicle-kilometre.
    pub per_veh_km: [f64; 3],
    /// Share of the former that gain anticipated speed.
    pub gaining: Option<f64>,
    /// The share that is undone within 30 s.
    pub going_back: Option<f64>,
    /// Ratio of the probabilities of a desire to change: of a driver behind a slower one beside a free lane, and of a
    /// driver on a free road.
    pub held_up_ratio: Option<f64>,
    /// Mean speed [m/s].
    pub speed_mps: Option<f64>,
    /// Mean delay of the completed trips [s].
    pub delay_s: Option<f64>,
    /// Missed turns for each vehicle that entered.
    pub missed_turns: f64,
    /// Emergency brakings per vehicle-kilometre.
    pub emergencies: f64,
    /// Vehicles that became stuck.
    pub stuck: f64,
    /// Vehicles that completed their trips.
    pub completed: f64,
    /// Vehicles that wait to enter at the end.
    pub waiting_to_enter: f64,
    /// Vehicles that entered; those on the road at the begin of the measured time count as entered.
    pub entered: f64,
    /// Distance driven [veh km].
    pub veh_km: f64,
    /// Collisions.
    pub collisions: f64,
    /// Other times that two vehicles began to overlap.
    pub overlaps: f64,
    /// Hard brakings per vehicle-kilometre.
    pub hard_brakings: f64,
    /// Drivers without any route left to a destination.
    pub lost: f64,
}

/// A measure of every run.
#[derive(Clone, Copy)]
pub struct Measure {
    /// Its column in tables.
    pub column: &'static str,
    /// Its name, with the unit.
    pub title: &'static str,
    /// Number of significant digits.
    pub digits: usize,
    /// Its value in an outcome.
    pub of: fn(&Outcome) -> Option<f64>,
}

pub(crate) const fn measure(
    column: &'static str,
    title: &'static str,
    digits: usize,
    of: fn(&Outcome) -> Option<f64>,
) -> Measure {
    Measure { column, title, digits, of }
}

/// All measures.
pub const MEASURES: [Measure; 13] = [
    measure("discretionary_per_veh_km", "discretionary lane changes [1/veh-km]", 3, |it| {
        Some(it.per_veh_km[0])
    }),
    measure("route_per_veh_km", "route-driven lane changes [1/veh-km]", 3, |it| Some(it.per_veh_km[1])),
    measure("keeping_per_veh_km", "lane changes to keep to the slow side [1/veh-km]", 3, |it| {
        Some(it.per_veh_km[2])
    }),
    measure("gaining", "discretionary, with a gain of speed [%]", 1, |it| it.gaining.map(|it| 100.0 * it)),
    measure("going_back", "discretionary, reversed within 30 s [%]", 1, |it| {
        it.going_back.map(|it| 100.0 * it)
    }),
    measure("held_up_ratio", "desire when held up ÷ on a free road", 1, |it| it.held_up_ratio),
    measure("mean_speed_kmh", "mean speed [km/h]", 1, |it| it.speed_mps.map(|it| it * KMH_PER_MPS)),
    measure("mean_delay_s", "mean delay [s]", 1, |it| it.delay_s),
    measure("missed_turns", "missed turns [% of vehicles]", 2, |it| Some(100.0 * it.missed_turns)),
    measure("emergencies", "emergency brakings [1/100 veh-km]", 2, |it| Some(100.0 * it.emergencies)),
    measure("stuck", "stuck vehicles", 1, |it| Some(it.stuck)),
    measure("completed", "completed trips", 0, |it| Some(it.completed)),
    measure("waiting_to_enter", "vehicles waiting to enter at the end", 0, |it| Some(it.waiting_to_enter)),
];

impl Outcome {
    /// Runs `simulation` to its end; also returns the traffic in boxes, with the discretionary lane changes in them.
    pub(crate) fn of(simulation: &mut Simulation) -> (Outcome, Vec<EdieRow>) {
        let [warmup_steps, steps] = simulation.run_steps();
        (0..warmup_steps).for_each(|_| simulation.advance());
        let begin = simulation.time_s();
        let mut boxes = simulation.boxes();
        let (mut changes, mut gaining, mut going_back) = (0, 0, 0);
        let mut short_trips = ShortTrips::default();
        let mut last: BTreeMap<VehicleId, (f64, Side)> = BTreeMap::new();
        for _ in 0..steps {
            let events = simulation.step();
            simulation.show(&mut boxes);
            simulation.show(&mut short_trips);
            for event in events {
                let Event::LaneChange(change) = event else { continue };
                if !change.is_completed || change.time_s < begin {
                    continue;
                }
                let before = last.insert(change.vehicle, (change.time_s, change.side));
                if change.kind == LaneChangeKind::Discretionary {
                    changes += 1;
                    gaining += u32::from(change.speed_gain_mps > 0.0);
                    let goes_back = |(time, side)| side != change.side && change.time_s - time <= BACK_WITHIN;
                    going_back += u32::from(before.is_some_and(goes_back));
                }
            }
        }
        let (counters, counts) = (simulation.counters(), simulation.counts());
        let veh_km = counters.distance / METRES_PER_KM;
        let share = |part: u32| (changes > 0).then(|| f64::from(part) / f64::from(changes));
        let per = |count: u64, of: f64| if of > 0.0 { count as f64 / of } else { 0.0 };
        let chance = |desires: u64, all: u64| (all > 0).then(|| desires as f64 / all as f64);
        let free = chance(counters.free_desires, counters.free_considerations).filter(|it| *it > 0.0);
        let held_up = chance(counters.held_up_desires, counters.held_up_considerations);
        let dt = simulation.step_s();
        let outcome = Outcome {
            per_veh_km: [counts.discretionary_changes, counts.route_changes, counts.keeping_changes]
                .map(|it| per(it, veh_km)),
            gaining: share(gaining),
            going_back: share(going_back),
            held_up_ratio: held_up.zip(free).map(|(held_up, free)| held_up / free),
            speed_mps: (counters.updates > 0).then(|| counters.distance / (counters.updates as f64 * dt)),
            delay_s: short_trips.means_without(counts).delay,
            missed_turns: per(counters.missed_turns, counts.entered as f64),
            emergencies: per(counters.emergency_brakings, veh_km),
            stuck: counters.stuck as f64,
            completed: counts.left as f64,
            waiting_to_enter: simulation.waiting_to_enter() as f64,
            entered: counts.entered as f64,
            veh_km,
            collisions: counters.collisions as f64,
            overlaps: counters.overlaps as f64,
            hard_brakings: per(counters.hard_brakings, veh_km),
            lost: counters.lost as f64,
        };
        (outcome, boxes.with_changes(simulation.time_s(), |it| it == LaneChangeKind::Discretionary))
    }
}
