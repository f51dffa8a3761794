//! Explanations agree with the actions of drivers, with an independent computation, and with the run of the changed
//! situation.

mod law;
mod twin;

use laneweave::explain::{Flip, Knob, flips};
use laneweave::models::Style;
use laneweave::models::change::{IncentiveName, LaneChangeModel};
use laneweave::network::Side;
use laneweave_scenario::scenario::{Origin, Scenario, prepare};
use laneweave_sim::{Account, Act, Event, Hindrance, Phase, Purpose, Random, Spot, World};
use twin::{Otherwise, Twin};

/// Length of a step [s].
const DT: f64 = 0.1;
/// Number of refusals that are computed independently.
const REFUSALS: usize = 1000;
/// Largest change of a yield by rounding.
const ROUNDING: f64 = 1e-9;

/// A busy straight motorway of three lanes with the usual drivers.
fn motorway() -> World {
    let map = laneweave_test_data::map("motorway_3_lanes.osm");
    let mut scenario = Scenario::of_map(map);
    scenario.demand.vehicles_per_hour = Some(4500.0);
    scenario.guidance.interval_s = 0.0;
    prepare(&scenario, &Origin::default()).expect("the map is sound").world
}

fn phase(world: &World, id: u32) -> Option<Phase> {
    world.vehicles().find(|it| it.id() == id).map(|it| it.driver.phase)
}

/// The drivers who consider lanes or wait for a gap in the next step.
fn deciding(world: &World) -> Vec<Spot> {
    let step = world.clock().step;
    let decides = |phase, due| match phase {
        Phase::Cruises => due <= step,
        Phase::Wants => true,
        Phase::Changes | Phase::Aborts => false,
    };
    world.vehicles().filter(|it| decides(it.driver.phase, it.driver.due)).map(|it| it.spot).collect()
}

/// The account of a driver, and its action.
struct Said {
    id: u32,
    act: Act,
}

#[track_caller]
fn assert_near(value: f64, expected: f64) {
    assert!((value - expected).abs() <= ROUNDING * expected.abs().max(1.0), "{value} is not {expected}");
}

/// The account of a driver who considers lanes agrees with the independent computation.
fn assert_weighed_as_by_hand(twin: &Twin, account: &Account) {
    let by_hand = twin.weigh(account.vehicle, Otherwise::default());
    assert_eq!(account.sides.iter().flatten().count(), by_hand.len());
    for side in account.sides.iter().flatten() {
        let expected = by_hand.iter().find(|it| it.side == side.side).expect("there is a lane");
        for (name, expected) in expected.yields {
            assert_near(side.appraisal.row(name).earning, expected);
        }
        assert_near(side.appraisal.gain, expected.gain);
    }
    let draw = Random::new(1).uniform(account.vehicle, Purpose::Desire, (account.time / DT).round() as u32);
    assert_eq!(account.draw, draw);
    if account.cooldown_left == 0.0 && matches!(account.act, Act::Stays | Act::Wants(..)) {
        let wanted = match account.act {
            Act::Wants(side, _) => Some(side),
            _ => None,
        };
        assert_eq!(wanted, twin.desired(account.vehicle, Otherwise::default(), draw));
    }
}

/// The reason of a driver who waits agrees, too.
fn assert_refused_as_by_hand(twin: &Twin, account: &Account) {
    let Act::Waits(side, hindrance) = account.act else { return };
    let by_hand = twin.refusal(account.vehicle, side, Otherwise::default(), DT);
    match hindrance {
        Hindrance::Ahead(refusal, _) => assert_eq!(by_hand, Some((0, refusal))),
        Hindrance::Behind(refusal, _) => assert_eq!(by_hand, Some((1, refusal))),
        Hindrance::TooLittleRoad => {
            let (left, needed) = (twin.road_left(account.vehicle), twin.road_to_cross(account.vehicle));
            assert!(left < needed, "{left} m of {needed} m")
        }
        Hindrance::Junction => assert!(twin.road_left(account.vehicle) < 200.0, "nowhere else"),
        other => panic!("{other:?} on a straight road"),
    }
}

#[test]
fn every_change_and_a_thousand_refusals_are_explained_as_by_hand() {
    let mut world = motorway();
    let random = Random::new(7);
    let (mut wants, mut changes, mut stays, mut waits) = (0, 0, 0, 0);
    let mut desires = std::collections::BTreeMap::new();
    for step in 0..6000_u32 {
        let mut said = Vec::new();
        let mut twin = None;
        for spot in deciding(&world) {
            let account = laneweave_sim::explain(&world, spot);
            said.push(Said { id: account.vehicle, act: account.act });
            let is_chosen = random.uniform(account.vehicle, Purpose::Parameter, step) < 0.02;
            let is_change = matches!(account.act, Act::Wants(..));
            let is_refusal = matches!(account.act, Act::Stays | Act::Waits(..));
            if is_change || (is_chosen && is_refusal && stays + waits < REFUSALS) {
                let twin = twin.get_or_insert_with(|| Twin::of(&world));
                assert_weighed_as_by_hand(twin, &account);
                assert_refused_as_by_hand(twin, &account);
                wants += usize::from(is_change);
                stays += usize::from(account.act == Act::Stays);
                waits += usize::from(matches!(account.act, Act::Waits(..)));
            }
            if let Act::Wants(side, _) = account.act {
                let wanted = account.sides.iter().flatten().find(|it| it.side == side);
                desires.insert(account.vehicle, wanted.expect("it wants there").appraisal);
            }
        }
        world.step();
        for Said { id, act } in said {
            let Some(phase) = phase(&world, id) else { continue };
            match act {
                Act::Wants(..) | Act::Waits(..) => assert_eq!(phase, Phase::Wants, "{id} at {step}: {act:?}"),
                // Another vehicle may have taken the gap.
                Act::Goes(_) => assert!(matches!(phase, Phase::Changes | Phase::Wants), "{id} at {step}"),
                Act::Stays | Act::GivesUp(_) => assert_eq!(phase, Phase::Cruises, "{id} at {step}: {act:?}"),
                other => panic!("{other:?} on a straight road"),
            }
        }
        for event in world.events() {
            if let Event::LaneChange(change) = event {
                changes += 1;
                assert_eq!(Some(&change.appraisal), desires.get(&change.vehicle));
            }
        }
    }
    assert!(changes > 300 && wants >= changes, "{changes} changes, {wants} desires");
    assert_eq!(stays + waits, REFUSALS);
    assert!(waits > 20, "{waits}");
}

/// The style with another weight of the incentive of row `row`.
fn with_weight(style: &Style, row: usize, weight: f64) -> Style {
    let model = twin::mcdm(&style.change);
    let of = |it| if it == IncentiveName::ALL[row] { weight } else { model.weight(it) };
    Style { change: LaneChangeModel::Mcdm(model.clone().with_weights(of)), ..style.clone() }
}

/// The side to which the driver of `id` turns, who considers lanes in the next step of `saved`, with another weight
/// of the incentive of `row`: the step is simulated.
fn driven(
    stage: &mut World,
    saved: &[u8],
    original: &[Style],
    id: u32,
    row: usize,
    weight: f64,
) -> Option<Side> {
    stage.restore(saved).expect("the same world");
    let parameters =
        stage.vehicles().find(|it| it.id() == id).expect("it is there").driver.parameters as usize;
    let mut driver_parameters = original.to_vec();
    driver_parameters[parameters] = with_weight(&driver_parameters[parameters], row, weight);
    stage.change_driver_parameters(driver_parameters).expect("as many");
    stage.step();
    let vehicle = stage.vehicles().find(|it| it.id() == id).expect("it is there");
    (vehicle.driver.phase == Phase::Wants).then_some(vehicle.lane_change.side)
}

fn at(side: Side) -> usize {
    usize::from(side == Side::Right)
}

/// The change of the situation by the share `share` of a flip of speeds or gaps.
fn otherwise(flip: &Flip, share: f64) -> Otherwise {
    let by = share * flip.by;
    let mut it = Otherwise::default();
    match flip.knob {
        Knob::SpeedHere => it.here = by,
        Knob::SpeedThere(side) => it.there[at(side)] = by,
        Knob::GapAhead => it.gaps[0] = by,
        Knob::GapBehind => it.gaps[1] = by,
        Knob::OwnSpeed => it.speeds[0] = by,
        Knob::LeaderSpeed => it.speeds[1] = by,
        Knob::FollowerSpeed => it.speeds[2] = by,
        Knob::Weight(_) => panic!("a weight is driven"),
    }
    it
}

/// If a driver who waits would go at one of the tested speeds, a flip of its speed says so; returns whether there is
/// one.
fn assert_window_is_found(twin: &Twin, account: &Account, side: Side) -> bool {
    /// Distance between the tested speeds [m/s].
    const APART: f64 = 0.1;
    let (id, own) = (account.vehicle, twin.speed(account.vehicle));
    // At the end of the road a higher speed needs more of it than is left.
    if twin.road_left(id) < 500.0 {
        return false;
    }
    let goes = |by: f64| {
        let otherwise = Otherwise { speeds: [by, 0.0, 0.0], ..Otherwise::default() };
        twin.refusal(id, side, otherwise, DT).is_none()
    };
    let tried = (1..400).flat_map(|it| [APART * f64::from(it), -APART * f64::from(it)]);
    let Some(nearest) = tried.filter(|by| own + by >= 0.0).find(|by| goes(*by)) else { return false };
    let flips = flips(account, DT);
    let found = flips.iter().find(|it| it.knob == Knob::OwnSpeed);
    let by = found.unwrap_or_else(|| panic!("{id} would go at {nearest:+} m/s: {account:?}")).by;
    assert!((by - nearest).abs() <= APART && by * nearest > 0.0, "{by} is not {nearest}");
    true
}

#[test]
fn every_flip_flips_when_applied_and_half_of_it_does_not() {
    /// A flip is exact to the last bit of the program's own sums; the independent ones may differ in it.
    const BEYOND: f64 = 1.0 + 1e-6;
    let (mut world, mut stage) = (motorway(), motorway());
    let original = world.driver_parameters().to_vec();
    let random = Random::new(11);
    let (mut weights, mut speeds, mut gaps, mut windows) = (0, 0, 0, 0);
    for step in 0..4000_u32 {
        let mut saved = None;
        for spot in deciding(&world) {
            let account = laneweave_sim::explain(&world, spot);
            let share = match account.act {
                Act::Wants(..) => 0.3,
                Act::Waits(..) | Act::Goes(_) => 0.1,
                _ => 0.002,
            };
            if step < 600 || random.uniform(account.vehicle, Purpose::Parameter, step) > share {
                continue;
            }
            let (id, twin) = (account.vehicle, Twin::of(&world));
            // A vehicle that leaves the road in this step shows no more what its driver wanted.
            if twin.road_left(id) < 5.0 {
                continue;
            }
            if let Act::Waits(side, Hindrance::Ahead(..) | Hindrance::Behind(..)) = account.act {
                windows += usize::from(assert_window_is_found(&twin, &account, side));
            }
            for flip in flips(&account, DT) {
                match (flip.knob, account.act) {
                    (Knob::Weight(row), _) => {
                        let saved = saved.get_or_insert_with(|| world.save().expect("it can be saved"));
                        let now = match account.act {
                            Act::Wants(side, _) => Some(side),
                            _ => None,
                        };
                        let mut turn = |share: f64| {
                            let weight = flip.value + share * flip.by;
                            driven(&mut stage, saved, &original, id, row, weight)
                        };
                        assert_eq!(turn(1.0), flip.to, "{id} at {step}: {flip:?}");
                        assert_ne!(flip.to, now);
                        assert_eq!(turn(0.5), now, "{id} at {step}: half of {flip:?}");
                        weights += 1;
                    }
                    (_, Act::Waits(side, _) | Act::Goes(side)) => {
                        let goes = |share| twin.refusal(id, side, otherwise(&flip, share), DT).is_none();
                        assert_eq!(goes(BEYOND), flip.to.is_some(), "{id} at {step}: {flip:?}");
                        assert_eq!(goes(0.5), flip.to.is_none(), "{id} at {step}: half of {flip:?}");
                        gaps += 1;
                    }
                    _ => {
                        // As one side's chance falls, the random number may select the other side, and then none.
                        let wanted = |share| twin.desired(id, otherwise(&flip, share), account.draw);
                        let now = wanted(0.0);
                        assert_ne!(wanted(BEYOND), now, "{id} at {step}: {flip:?}");
                        assert_eq!(wanted(0.5), now, "{id} at {step}: half of {flip:?}");
                        speeds += 1;
                    }
                }
            }
        }
        world.step();
    }
    assert!(weights > 100 && speeds > 200 && gaps > 200, "{weights} weights, {speeds} speeds, {gaps} gaps");
    assert!(windows > 20, "{windows}");
}
