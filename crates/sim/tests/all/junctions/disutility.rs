//! Turns and lights on the route, and drivers who mind them.

use laneweave_models::{Guidance, Style};
use laneweave_network::{
    ChainIndex, DrivingSide, Id, Lanelet, LaneletIndex, Network, Point, Polyline, Position, Regulations,
    StopKind, StopRule,
};
use laneweave_sim::{Class, Disutility, Navigator, Placement};

use crate::junctions::town::{Arm, empty, exit_to, lane_from, run_until};
use crate::roads::{drivers, network};

/// The disutility of the route from arm to arm of the only junction.
fn disutility(network: &Network, from: Arm, to: Arm) -> Disutility {
    let navigator = Navigator::new(network);
    navigator.waypoint(Some(exit_to(network, to)), lane_from(network, from)).disutility
}

#[test]
fn a_junction_is_a_turn_for_all_but_those_who_go_straight_on() {
    for name in ["priority.osm", "right_before_left.osm", "all_way_stop.osm"] {
        let network = network(name);
        for from in Arm::ALL {
            let turns = [1, 2, 3].map(|quarters| disutility(&network, from, from.turned(quarters)).turns);
            assert_eq!(turns, [1, 0, 1], "{name} from {from:?}");
        }
    }
}

#[test]
fn the_way_through_a_roundabout_is_a_turn_into_it_and_one_out_of_it() {
    let network = network("roundabout.osm");
    for from in Arm::ALL {
        let turns = [1, 2, 3].map(|quarters| disutility(&network, from, from.turned(quarters)).turns);
        assert_eq!(turns, [2, 2, 2], "from {from:?}");
    }
}

/// A lane of 3.5 m along `points`.
fn lane(id: i64, points: &[(f64, f64)], following: &[u32]) -> Lanelet {
    let centre = Polyline::new(points.iter().map(|(x, y)| Point::new(*x, *y, 0.0))).expect("a line");
    let border = |offset: f64| {
        let ends = centre.points().windows(2).scan(0.0, |station, ends| {
            *station += ends[0].distance(&ends[1]);
            Some(*station)
        });
        Polyline::new([0.0].into_iter().chain(ends).map(|it| centre.beside(it, offset))).expect("a line")
    };
    let [left, right] = [1.75, -1.75].map(border);
    let mut lanelet = Lanelet::alone(id, [left, right, centre], 10.0);
    lanelet.following = following.iter().map(|it| LaneletIndex(*it)).collect();
    lanelet
}

/// A road that forks into a straight branch (2) and a detour of two turns (3), which meet again. A light stands
/// before the fork, and two lights that count as one stand on the detour.
fn fork() -> Network {
    let round = [(300.0, 0.0), (340.0, 60.0), (460.0, 60.0), (500.0, 0.0)];
    let lanelets = vec![
        lane(1, &[(0.0, 0.0), (300.0, 0.0)], &[1, 2]),
        lane(2, &[(300.0, 0.0), (500.0, 0.0)], &[3]),
        lane(3, &round, &[3]),
        lane(4, &[(500.0, 0.0), (700.0, 0.0)], &[]),
    ];
    let light = |id: i64, lanelet: u32| StopRule {
        id: id.into(),
        kind: StopKind::Light,
        lanelets: vec![LaneletIndex(lanelet)],
        lines: Vec::new(),
    };
    let stops = vec![light(10, 0), light(11, 2), light(12, 2)];
    let network = Network::new(lanelets, DrivingSide::Right).expect("a network");
    network.regulated(&Regulations { stops, ..Regulations::default() })
}

fn chain_of(network: &Network, id: i64) -> ChainIndex {
    let mut chains = (0..network.chains.len() as u32).map(ChainIndex);
    chains.find(|it| network.lanelet_at(Position::new(*it, 0.0)).0.id == id).expect("there is one")
}

#[test]
fn a_way_and_its_alternative_have_the_turns_and_lights_that_lie_on_them() {
    let network = fork();
    let navigator = Navigator::new(&network);
    let waypoint = *navigator.waypoint(Some(0), chain_of(&network, 1));
    assert_eq!(waypoint.disutility, Disutility { turns: 0, lights: 1 });
    assert_eq!(waypoint.alternative_disutility, Disutility { turns: 2, lights: 2 });
    assert_eq!(navigator.waypoint(Some(0), chain_of(&network, 4)).disutility, Disutility::default());
}

/// The road that a driver takes with guidance about slow vehicles on the straight one.
fn chosen(guidance: Guidance) -> Id {
    let network = fork();
    let [first, straight, last] = [1, 2, 4].map(|it| chain_of(&network, it));
    let me = Style { guidance, ..drivers::conservative() };
    let crawler = Style { speed_factor: 0.1, ..drivers::conservative() };
    let mut world = empty(network, vec![me, crawler]).guided(10.0).expect("one destination");
    let place = |chain, x, parameters| {
        let speed = if parameters == 0 { 10.0 } else { 1.0 };
        Placement { chain, x, speed, class: Class::Car, parameters, destination: Some(0) }
    };
    for x in [30.0, 80.0, 130.0] {
        world.place(place(straight, x, 1)).expect("it fits on the road");
    }
    let id = world.place(place(first, 20.0, 0)).expect("it fits on the road");
    let mut road = None;
    let is_through = |world: &laneweave_sim::World| {
        let me = world.vehicles().find(|it| it.id() == id).expect("it is on the road");
        let at = me.spot.chain;
        if at != first && at != last {
            road = Some(world.network().lanelet_at(Position::new(at, 0.0)).0.id);
        }
        road.is_some()
    };
    run_until(&mut world, 60.0, is_through).expect("it drives on");
    road.expect("it drives on")
}

#[test]
fn a_driver_leaves_a_jam_but_not_for_turns_and_lights_that_it_minds_more() {
    let usual = Guidance::default();
    assert_eq!(chosen(usual), 3);
    // The gain is a minute and a half.
    assert_eq!(chosen(Guidance { turn_s: 5.0, light_s: 5.0, ..usual }), 3);
    assert_eq!(chosen(Guidance { turn_s: 300.0, ..usual }), 2);
    assert_eq!(chosen(Guidance { light_s: 300.0, ..usual }), 2);
}
