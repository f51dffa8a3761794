//! Turning shares: drivers follow the turning counts of junctions.

use laneweave_network::Id;
use std::f64::consts::FRAC_PI_6;

use laneweave::network::{Gate, Network, Sections};
use laneweave_scenario::scenario::{Origin, Prepared, Scenario, Turns, VehiclesPerHour, prepare};
use laneweave_sim::{Event, Place};
use laneweave_test_data::data;

fn scenario(map: &str, turns: &[Turns]) -> Scenario {
    let path = laneweave_test_data::map(map);
    Scenario { turns: turns.to_vec(), ..Scenario::of_map(path) }
}

fn prepared(scenario: &Scenario) -> Prepared {
    prepare(scenario, &Origin::default()).unwrap_or_else(|fault| panic!("{fault}"))
}

/// Direction of the first, or the last, lane of a gate [rad].
fn heading(network: &Network, gate: &Gate, at_end: bool) -> f64 {
    let chain = network.chain(gate.chains[0]);
    chain.centre.heading(if at_end { chain.length } else { 0.0 })
}

/// The shares of the destinations to the left, straight on and to the right of an entrance.
fn shares(prepared: &Prepared, entrance: usize) -> [f64; 3] {
    let (network, demand) = (prepared.world.network(), prepared.world.demand());
    let from = heading(network, &network.entrances[entrance], false);
    let mut shares = [0.0; 3];
    let weights = &demand.origins[entrance].weights;
    for (exit, weight) in network.exits.iter().zip(weights) {
        let turn = heading(network, exit, true) - from;
        let turn = turn.sin().atan2(turn.cos());
        let way = if turn > FRAC_PI_6 { 0 } else { 1 + usize::from(turn < -FRAC_PI_6) };
        shares[way] += weight / weights.iter().sum::<f64>();
    }
    shares
}

fn assert_near(found: [f64; 3], expected: [f64; 3]) {
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} is not {expected:?}");
}

#[test]
fn at_one_junction_the_destinations_have_the_shares_of_the_turns() {
    let from = prepared(&scenario("priority.osm", &[])).world.network().entrances[1].id;
    let turns = Turns { from, left: 30.0, straight: 50.0, right: 20.0 };
    let prepared = prepared(&scenario("priority.osm", &[turns]));
    for entrance in 0..4 {
        let third = 1.0 / 3.0;
        let expected = if entrance == 1 { [0.3, 0.5, 0.2] } else { [third; 3] };
        assert_near(shares(&prepared, entrance), expected);
    }
}

/// At every junction of a map all drivers take the movement of the least cost by its angle.
fn everywhere(map: &str, cost: impl Fn(f64) -> f64) -> Scenario {
    let network = prepared(&scenario(map, &[])).world.network().clone();
    let sections = Sections::of(&network);
    let forks = sections.all().iter().filter(|it| it.following.len() > 1);
    let turns = forks.map(|it| {
        let from = network.lanelets[it.lanelets[0].at()].id;
        let share = |is_it: bool| if is_it { 2.0 } else { 0.0 };
        let angles = it.following.iter().map(|it| it.angle);
        let angle = angles.min_by(|a, b| cost(*a).total_cmp(&cost(*b))).expect("there is a way on");
        let [left, right] = [angle > FRAC_PI_6, angle < -FRAC_PI_6].map(share);
        Turns { from, left, straight: share(angle.abs() <= FRAC_PI_6), right }
    });
    scenario(map, &turns.collect::<Vec<_>>())
}

#[test]
fn who_goes_straight_on_at_every_junction_crosses_the_town() {
    let crossing = prepared(&everywhere("grid.osm", f64::abs));
    for (entrance, origin) in crossing.world.demand().origins.iter().enumerate() {
        assert_near(shares(&crossing, entrance), [0.0, 1.0, 0.0]);
        assert_eq!(origin.weights.iter().filter(|it| **it > 0.0).count(), 1);
    }
}

#[test]
fn who_only_goes_on_round_a_roundabout_never_arrives_and_that_is_told() {
    let fault =
        prepare(&everywhere("roundabout.osm", |angle| -angle), &Origin::default()).err().expect("no exit");
    let entrance = prepared(&scenario("roundabout.osm", &[])).world.network().entrances[0].id;
    let what = format!("with these shares 100 % of the drivers from the entrance {entrance} never arrive");
    assert_eq!(
        fault.to_string(),
        format!("turns: {what}; give a share above 0 to a turn that leads out of the loop")
    );
}

#[test]
fn drivers_turn_as_was_counted() {
    let counted = [30.0, 50.0, 20.0];
    let network = prepared(&scenario("priority.osm", &[])).world.network().clone();
    let from = network.entrances[0].id;
    let [left, straight, right] = counted;
    let mut scenario = scenario("priority.osm", &[Turns { from, left, straight, right }]);
    scenario.demand.vehicles_per_hour = Some(0.0);
    scenario.demand.entrances = [(from.to_string(), VehiclesPerHour::Constant(600.0))].into();
    let mut prepared = prepared(&scenario);
    let mut left_at = vec![0.0; network.exits.len()];
    for _ in 0..36_000 {
        prepared.world.step();
        for event in prepared.world.events() {
            let Event::Left { chain, .. } = event else { continue };
            let exit = network.exits.iter().position(|it| it.chains.contains(chain)).expect("it left there");
            left_at[exit] += 1.0;
        }
    }
    let total: f64 = left_at.iter().sum();
    assert!(total > 500.0, "{total}");
    for (left, weight) in left_at.iter().zip(&prepared.world.demand().origins[0].weights) {
        // Three standard errors of a share.
        let error = 3.0 * (weight * (1.0 - weight) / total).sqrt();
        assert!((left / total - weight).abs() <= error, "{left} of {total}, not {weight}");
    }
}

#[test]
fn shares_that_cannot_be_are_refused_with_their_place_and_a_remedy() {
    let network = prepared(&scenario("priority.osm", &[])).world.network().clone();
    let (from, exit) = (network.entrances[0].id, network.exits[0].id);
    let turns = Turns { from, left: 1.0, straight: 1.0, right: 1.0 };
    for (turns, message) in [
        (
            vec![Turns { from: 4711.into(), ..turns }],
            "turns.0.from: the map has no lanelet 4711 for vehicles; give a lanelet of the road to the junction".into(),
        ),
        (
            vec![Turns { from: exit, ..turns }],
            format!("turns.0.from: the lanelet {exit} leads to no junction; leave it out"),
        ),
        (
            vec![Turns { left: -1.0, ..turns }],
            "turns.0.left: a share of -1; choose 0 or more".into(),
        ),
        (
            vec![Turns { left: 0.0, straight: 0.0, right: 0.0, ..turns }],
            format!("turns.0.from: all shares from {from} are 0; give left, straight or right a share above 0"),
        ),
        (
            vec![turns, turns],
            format!("turns.1.from: the lanelets {from} and {from} lead to the same junction; remove one of them"),
        ),
    ] {
        let fault = prepare(&scenario("priority.osm", &turns), &Origin::default()).err().expect("refused");
        assert_eq!(fault.to_string(), message);
    }
    let mut both = scenario("priority.osm", &[turns]);
    both.demand.exits = [(exit.to_string(), 2.0)].into();
    let fault = prepare(&both, &Origin::default()).err().expect("refused");
    let message = "turns: both turning shares and weights of exits; remove demand.exits or the turns: each of them defines the \
                   destinations";
    assert_eq!(fault.to_string(), message);
}

#[test]
fn a_share_of_a_way_that_is_not_there_is_refused_with_the_ways_that_are() {
    let network = prepared(&scenario("off_ramp.osm", &[])).world.network().clone();
    let from = network.entrances[0].id;
    let turns = Turns { from, left: 1.0, straight: 9.0, right: 0.0 };
    let fault = prepare(&scenario("off_ramp.osm", &[turns]), &Origin::default()).err().expect("refused");
    assert_eq!(fault.place, "turns.0.left");
    assert_eq!(fault.what, format!("no lane leads left from {from}"));
}

#[test]
fn of_a_road_whose_lanes_are_entrances_of_their_own_each_has_the_shares_of_where_it_leads() {
    // From -101121 beside it there is no route to the left: the scenario is refused unless there is another
    // destination, or no demand.
    let turns = Turns { from: Id::from(-101_122), left: 1.0, straight: 0.0, right: 0.0 };
    let Some(map) = data("lanelet2/tianjin.osm") else { return };
    let mut scenario = Scenario { turns: vec![turns], ..Scenario::of_map(map) };
    let fault = prepare(&scenario, &Origin::default()).err().expect("refused");
    let what = "no lane leads from the entrance -101121 to the destinations of these shares";
    assert_eq!((fault.place.as_str(), fault.what.as_str()), ("turns", what));
    scenario.turns[0] = Turns { straight: 2.0, right: 1.0, ..turns };
    let world = prepared(&scenario).world;
    let is_it = |it: &&laneweave_sim::Origin| matches!(&it.place, Place::Gate(gate) if gate.id == -101_122);
    let weights = world.demand().origins.iter().find(is_it).expect("the entrance").weights.clone();
    let [one, other, right] = weights.iter().copied().filter(|it| *it > 0.0).collect::<Vec<_>>()[..] else {
        panic!("two lanes straight on and one to the right: {weights:?}")
    };
    let is = |share: f64, value: f64| (share - value).abs() < 1e-9;
    assert!(is(one, 0.25) && is(other, 0.25) && is(right, 0.5), "{weights:?}");
    scenario.turns[0] = turns;
    scenario.demand.vehicles_per_hour = Some(0.0);
    assert_eq!(prepared(&scenario).conditions.demand_veh_h, 0.0);
}
