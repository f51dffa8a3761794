//! What is observed of drivers on small roads, whose paths are known.

use laneweave_calibration::observe::{ByDesired, Observations, ObservedDriver, Options, Origin, observe};
use laneweave_generate::{Motorway, motorway};
use laneweave_models::Style;
use laneweave_models::change::{IncentiveName, LaneChangeModel, Mcdm};
use laneweave_models::follow::{FollowingModel, Idm};
use laneweave_network::{Network, Side};
use laneweave_recordings::{Matched, Recording, RoadUser, State, Track};
use laneweave_sim::Navigator;

/// Time between frames [s].
const STEP: f64 = 0.1;
/// Middle of the slow lane, and of the one beside it, from the road's edge [m].
const SLOW: f64 = 1.75;
const FAST: f64 = 5.25;

fn style(change: Mcdm) -> Style {
    Style {
        name: "usual".into(),
        description: String::new(),
        speed_factor: 1.0,
        follow: FollowingModel::Idm(Idm::default()),
        change: LaneChangeModel::Mcdm(change),
        safety: Default::default(),
        attention: Default::default(),
        manner: Default::default(),
        yielding: Default::default(),
        guidance: Default::default(),
    }
}

/// A car that drives to the east with 25 m/s for some seconds, `aside(time)` from the road's edge.
fn car(id: i64, x: f64, seconds: f64, aside: impl Fn(f64) -> f64) -> Track {
    let states = (0..=(seconds / STEP).round() as i64).map(|frame| {
        let time = frame as f64 * STEP;
        State { frame, x: x + 25.0 * time, y: aside(time), speed: 25.0, heading: 0.0 }
    });
    Track { id, class: RoadUser::Car, length: 4.5, width: 1.8, states: states.collect() }
}

/// What `style` observes of these cars on a road of two lanes, the slow one of which ends at `drop`, if it ends.
fn observed(style: Style, drop: Option<f64>, tracks: Vec<Track>) -> Observations {
    let road = Motorway { lanes: 2, length_m: 3000.0, lane_drop_at: drop, ..Motorway::default() };
    let network: Network = motorway(&road).expect("it fits").build().expect("it has lanes").network;
    let recording = Recording { step: STEP, tracks, ..Recording::default() };
    let matched = Matched::new(&network, &recording);
    observe(&matched, &Navigator::new(&network), &Options::of(style), Origin::default())
        .expect("they are drivers")
}

#[test]
fn a_driver_is_looked_at_twice_a_second_for_as_long_as_it_is_seen() {
    let observations = observed(style(Mcdm::default()), None, vec![car(1, 100.0, 8.0, |_| SLOW)]);
    let [ObservedDriver { spells, .. }] = &observations.drivers[..] else { panic!("one driver") };
    let [spell] = &spells[..] else { panic!("one spell") };
    let ticks: Vec<i64> = spell.sightings.iter().map(|it| it.tick).collect();
    assert_eq!(ticks, (0..16).collect::<Vec<i64>>());
    assert_eq!(observations.seconds(), 8);
}

#[test]
fn each_vehicle_is_one_driver_with_the_times_before_and_after_its_change() {
    // It changes to the left within four seconds around the fifteenth.
    let aside = |time: f64| {
        let phase = ((time - 13.0) / 4.0).clamp(0.0, 1.0);
        SLOW + (FAST - SLOW) * (0.5 - 0.5 * (std::f64::consts::PI * phase).cos())
    };
    let tracks = vec![car(7, 300.0, 40.0, aside), car(9, 100.0, 40.0, |_| SLOW)];
    let observations = observed(style(Mcdm::default()), None, tracks);
    let drivers: Vec<_> = observations.drivers.iter().map(|it| (it.vehicle, it.spells.len())).collect();
    assert_eq!(drivers, [(7, 2), (9, 1)]);
    let changes = observations.drivers[0].spells.iter().map(|it| it.change);
    assert_eq!(changes.collect::<Vec<_>>(), [Some(Side::Left), None]);
}

#[test]
fn what_a_side_yields_for_the_route_counts_as_much_over_speed_as_in_the_style() {
    // The slow lane ends 300 m ahead of where the car is first seen.
    let yields = |route: f64| -> f32 {
        let change = Mcdm::default().with_weights(|it| match it {
            IncentiveName::Speed => 2.0,
            IncentiveName::Route => route,
            _ => 1.0,
        });
        let observations = observed(style(change), Some(1300.0), vec![car(1, 1000.0, 4.0, |_| SLOW)]);
        let ByDesired { speed, .. } = observations.drivers[0].spells[0].sightings[0].sides[Side::Left.at()]
            .expect("it may change to the left")
            .by_desired[0];
        speed
    };
    let [without, half, as_much] = [0.0, 1.0, 2.0].map(yields);
    assert!(as_much - without > 0.1, "{without} {as_much}");
    assert!((half - 0.5 * (without + as_much)).abs() < 1e-5, "{without} {half} {as_much}");
}
