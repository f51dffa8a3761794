//! Each weight of a style moves what it should while drivers drive, between no weight and ten times the weight, over
//! ten simulated minutes with about 1,000 vehicles and five paired seeds. The weights are changed as a user changes
//! them, by commands.

use laneweave::generate::large_town;
use laneweave::network::DrivingSide;
use laneweave::{Event, IncentiveName, LaneChange, LaneChangeKind, Parameter, Simulation};
use laneweave_studies::in_parallel;

const SEEDS: u64 = 5;
const DURATION_S: f64 = 600.0;
/// Streets in each direction of the town.
const STREETS: usize = 6;
const STYLES: [&str; 2] = ["aggressive", "conservative"];

/// Where drivers drive.
#[derive(Clone, Copy)]
enum Road {
    /// A motorway with ramps.
    Motorway,
    /// A town with junctions of all kinds, where every second trip needs another lane before a turn.
    Town,
}

impl Road {
    /// A simulation with about 1,000 vehicles in ten minutes.
    fn simulation(self, seed: u64) -> Simulation {
        let builder = match self {
            Road::Motorway => {
                let map = laneweave_test_data::map("ramps.osm");
                Simulation::builder(map).vehicles_per_hour(6000.0)
            }
            Road::Town => {
                let drawing = large_town(STREETS, DrivingSide::Right).expect("a drawing");
                Simulation::builder(drawing.build().expect("a town")).vehicles_per_hour(9000.0)
            }
        };
        builder.seed(seed).threads(1).build().expect("a simulation")
    }
}

/// Lane changes per vehicle that `counts`, after a user has multiplied a weight of all styles.
fn rate(
    road: Road,
    parameter: Parameter,
    factor: f64,
    seed: u64,
    counts: impl Fn(&LaneChange) -> bool,
) -> f64 {
    let mut simulation = road.simulation(seed);
    for style in STYLES {
        let weight = simulation.parameter(style, parameter).expect("a weight");
        simulation.set_parameter(style, parameter, factor * weight).expect("a weight");
    }
    let (mut changes, mut vehicles) = (0, 0);
    while simulation.time_s() < DURATION_S {
        for event in simulation.step() {
            match event {
                Event::LaneChange(it) if it.is_completed && counts(&it) => changes += 1,
                Event::Entered(_) => vehicles += 1,
                _ => {}
            }
        }
    }
    assert!(vehicles > 800, "{vehicles} vehicles");
    f64::from(changes) / f64::from(vehicles)
}

/// The rates without the weight and with ten times the weight, for each seed.
fn pairs(road: Road, parameter: Parameter, counts: impl Fn(&LaneChange) -> bool + Sync) -> Vec<[f64; 2]> {
    let seeds: Vec<u64> = (1..=SEEDS).collect();
    let pair = |seed: &u64| Ok([0.0, 10.0].map(|factor| rate(road, parameter, factor, *seed, &counts)));
    in_parallel(&seeds, 2, pair).expect("runs")
}

fn all_rise(parameter: Parameter, counts: impl Fn(&LaneChange) -> bool + Sync) {
    let pairs = pairs(Road::Motorway, parameter, counts);
    assert!(pairs.iter().all(|[none, ten]| ten > none), "{parameter:?}: {pairs:?}");
}

fn all_fall(parameter: Parameter, counts: impl Fn(&LaneChange) -> bool + Sync) {
    let pairs = pairs(Road::Motorway, parameter, counts);
    assert!(pairs.iter().all(|[none, ten]| ten < none), "{parameter:?}: {pairs:?}");
}

#[test]
fn drivers_who_want_speed_change_more_often() {
    all_rise(Parameter::Weight(IncentiveName::Speed), |_| true);
}

/// Those who do not mind it leave the lanes of their route, and have to come back.
#[test]
fn drivers_who_mind_their_route_make_fewer_changes_for_it() {
    all_fall(Parameter::Weight(IncentiveName::Route), |it| it.kind == LaneChangeKind::Route);
}

#[test]
fn drivers_who_want_comfort_make_fewer_changes_that_nobody_needs() {
    all_fall(Parameter::Weight(IncentiveName::Comfort), |it| it.kind == LaneChangeKind::Discretionary);
}

/// Changes that only the law wants gain nothing for the driver, and hold up those who are on the slow side. All changes
/// together may even rise: the courteous make way.
#[test]
fn courteous_drivers_make_fewer_changes_for_the_slow_side_alone() {
    all_fall(Parameter::Weight(IncentiveName::Courtesy), |it| it.kind == LaneChangeKind::Keeping);
}

#[test]
fn drivers_who_keep_to_the_slow_side_make_more_changes_for_that_alone() {
    all_rise(Parameter::Weight(IncentiveName::Keeping), |it| it.kind == LaneChangeKind::Keeping);
}

/// Those who feel no urgency leave the lane of their route as they come near its last place, and have to come back.
#[test]
fn drivers_who_feel_urgency_make_fewer_changes_for_their_route_in_a_town() {
    let pairs =
        pairs(Road::Town, Parameter::Weight(IncentiveName::Urgency), |it| it.kind == LaneChangeKind::Route);
    assert!(pairs.iter().all(|[none, ten]| *ten < 0.7 * none), "{pairs:?}");
}
