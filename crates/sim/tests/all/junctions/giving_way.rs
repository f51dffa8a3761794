//! Signs, the right of way, and priority to the right.

use laneweave_models::Style;
use laneweave_models::yielding::Yielding;
use laneweave_network::{ChainIndex, Network, Reach};
use laneweave_sim::{VehicleId, World};

use crate::junctions::town::{Arm, Comer, assert_sound, empty, has_gone, lane_from, lane_to, put, run_until};
use crate::roads::{drivers, network};

/// Speed of the driver with the right of way [m/s].
const CRUISE: f64 = 25.0 / 3.6;

/// Whether the driver on the minor road goes first. It stands at its line; another driver on the major road would
/// arrive at the place where their routes cross `lag` [s] later.
fn goes_before(lag: f64, critical_gap: f64) -> bool {
    let yielding = Yielding { critical_gap, ..Yielding::default() };
    let minor = Style { yielding, ..drivers::conservative() };
    let major = Style { speed_factor: 0.5, ..drivers::conservative() };
    let mut world = empty(network("priority.osm"), vec![minor, major]);
    let ways = [Arm::South, Arm::East].map(|it| way_across(world.network(), it));
    let [of_minor, of_major] = reaches(world.network(), ways).map(|it| it.start);
    let distance = CRUISE * lag - of_major;
    let near = Comer { from: Arm::South, to: Arm::North, distance: 2.0, speed: 0.0, parameters: 0 };
    let far = Comer { from: Arm::East, to: Arm::West, distance, speed: CRUISE, parameters: 1 };
    let (near, far) = (put(&mut world, near), put(&mut world, far));
    let is_there = |world: &World, id: VehicleId, way: ChainIndex, from: f64| {
        world.vehicles().any(|it| it.id() == id && it.spot.chain == way && it.x() > from)
    };
    let mut minor_first = None;
    let over = run_until(&mut world, 60.0, |world| {
        if minor_first.is_none() && is_there(world, near, ways[0], of_minor) {
            minor_first = Some(true);
        }
        if minor_first.is_none() && is_there(world, far, ways[1], of_major) {
            minor_first = Some(false);
        }
        world.on_road() == 0
    });
    assert!(over.is_some(), "they wait for ever");
    assert_sound(&world);
    minor_first.expect("they cross")
}

/// The lane straight on across the junction from an arm.
pub(super) fn way_across(network: &Network, from: Arm) -> ChainIndex {
    let beyond = lane_to(network, from.turned(2));
    let ways = &network.chain(lane_from(network, from)).following;
    let mut across = ways.iter().filter(|it| network.chain(**it).following.contains(&beyond));
    *across.next().expect("a lane leads across")
}

/// The conflict of two lanes, on either of them.
pub(super) fn reaches(network: &Network, ways: [ChainIndex; 2]) -> [Reach; 2] {
    let on = |way: ChainIndex| network.junctions.on(way).crossings.iter();
    let crossing = on(ways[0]).find(|it| network.junctions.other_side(**it).chain == ways[1]);
    let crossing = *crossing.expect("they cross");
    [*network.junctions.reach(crossing), *network.junctions.other_side(crossing)]
}

#[test]
fn who_is_on_the_minor_road_waits_for_who_comes_within_its_critical_gap_and_goes_before_who_is_far() {
    // The driver clears the crossing after about six seconds: a shorter critical gap makes no difference.
    let gaps = [8.0, 10.0, 12.0];
    for critical_gap in gaps {
        assert!(!goes_before(2.0, critical_gap));
        assert!(!goes_before(critical_gap - 1.5, critical_gap), "{critical_gap}");
        assert!(goes_before(critical_gap + 1.5, critical_gap), "{critical_gap}");
    }
    assert!(!goes_before(4.0, 1.0));
}

#[test]
fn who_is_on_the_major_road_does_not_slow_down_for_who_waits() {
    let major = Style { speed_factor: 0.5, ..drivers::conservative() };
    let mut world = empty(network("priority.osm"), vec![drivers::conservative(), major]);
    let near = Comer { from: Arm::South, to: Arm::North, distance: 2.0, speed: 0.0, parameters: 0 };
    let far = Comer { from: Arm::East, to: Arm::West, distance: 20.0, speed: CRUISE, parameters: 1 };
    put(&mut world, near);
    let far = put(&mut world, far);
    let mut slowest = CRUISE;
    run_until(&mut world, 60.0, |world| {
        let speeds = world.vehicles().filter(|it| it.id() == far).map(|it| it.speed());
        slowest = speeds.fold(slowest, f64::min);
        world.on_road() == 0
    });
    assert!(slowest > 0.95 * CRUISE, "{slowest} m/s");
}

#[test]
fn at_an_all_way_stop_everybody_stops_and_they_go_in_the_order_of_arrival() {
    for first in 0..4 {
        let mut world = empty(network("all_way_stop.osm"), vec![drivers::conservative()]);
        let comers: Vec<(u32, ChainIndex)> = (0..4)
            .map(|place| {
                // The order is not around the circle: no driver comes from the right of the one before it.
                let from = Arm::ALL[(first + [0, 2, 1, 3][place]) % 4];
                let distance = 25.0 + 15.0 * place as f64;
                let to = from.turned(2);
                let id = put(&mut world, Comer { from, to, distance, speed: 8.0, parameters: 0 });
                (id, lane_from(world.network(), from))
            })
            .collect();
        let (mut stopped, mut gone) = (Vec::new(), Vec::new());
        let over = run_until(&mut world, 60.0, |world| {
            for (id, lane) in &comers {
                let own = world.vehicles().find(|it| it.id() == *id && it.spot.chain == *lane);
                let end = world.network().chain(*lane).length;
                if own.is_some_and(|it| it.speed() < 0.3 && it.x() > end - 5.0) && !stopped.contains(id) {
                    stopped.push(*id);
                }
                if own.is_none() && !gone.contains(id) {
                    gone.push(*id);
                }
            }
            gone.len() == 4
        });
        assert!(over.is_some());
        let all: Vec<u32> = comers.iter().map(|it| it.0).collect();
        assert_eq!(stopped, all, "{first}");
        assert_eq!(gone, all, "{first}");
        assert_sound(&world);
    }
}

/// The order in which three drivers with this `patience` [s] go. They come one after the other from the north, the
/// west and the south.
fn order_at_an_all_way_stop(patience: f64) -> Vec<Arm> {
    let yielding = Yielding { patience, ..Yielding::default() };
    let style = Style { yielding, ..drivers::conservative() };
    let mut world = empty(network("all_way_stop.osm"), vec![style]);
    let arms = [Arm::North, Arm::West, Arm::South].into_iter().zip([25.0, 26.0, 27.0]);
    let comers: Vec<(Arm, VehicleId, ChainIndex)> = arms
        .map(|(from, distance)| {
            let comer = Comer { from, to: from.turned(2), distance, speed: 8.0, parameters: 0 };
            (from, put(&mut world, comer), lane_from(world.network(), from))
        })
        .collect();
    let mut gone = Vec::new();
    run_until(&mut world, 60.0, |world| {
        for (from, id, lane) in &comers {
            if !gone.contains(from) && has_gone(world, *id, *lane) {
                gone.push(*from);
            }
        }
        gone.len() == 3
    });
    assert_sound(&world);
    gone
}

#[test]
fn those_from_opposite_sides_go_together_though_another_from_aside_came_between_but_for_its_patience() {
    assert_eq!(order_at_an_all_way_stop(45.0), [Arm::North, Arm::South, Arm::West]);
    assert_eq!(order_at_an_all_way_stop(0.1), [Arm::North, Arm::West, Arm::South]);
}

#[test]
fn four_who_come_from_four_sides_at_once_all_get_through_within_30_s() {
    for name in ["right_before_left.osm", "all_way_stop.osm", "priority.osm", "roundabout.osm"] {
        // To the right, straight on, and to the left.
        for quarters in [1, 2, 3] {
            let mut world = empty(network(name), vec![drivers::conservative()]);
            for from in Arm::ALL {
                let to = from.turned(quarters);
                put(&mut world, Comer { from, to, distance: 20.0, speed: 6.0, parameters: 0 });
            }
            let lanes = Arm::ALL.map(|it| lane_to(world.network(), it));
            let time = run_until(&mut world, 30.0, |world| {
                world.vehicles().all(|it| lanes.contains(&it.spot.chain) && it.motion.rear() > 0.0)
            });
            assert!(time.is_some(), "{name}, {quarters} quarters");
            assert_sound(&world);
        }
    }
}

#[test]
fn who_comes_from_the_right_goes_first() {
    let mut world = empty(network("right_before_left.osm"), vec![drivers::conservative()]);
    let comer = |from: Arm| Comer { from, to: from.turned(2), distance: 30.0, speed: 8.0, parameters: 0 };
    // A driver from the south has the east on its right.
    let [south, east] = [Arm::South, Arm::East].map(|it| (put(&mut world, comer(it)), it));
    let [from_south, from_east] = [south, east].map(|(id, arm)| (id, lane_from(world.network(), arm)));
    let first = run_until(&mut world, 30.0, |world| {
        has_gone(world, from_south.0, from_south.1) || has_gone(world, from_east.0, from_east.1)
    });
    assert!(first.is_some());
    assert!(has_gone(&world, from_east.0, from_east.1) && !has_gone(&world, from_south.0, from_south.1));
    assert!(run_until(&mut world, 60.0, |world| world.on_road() == 0).is_some());
    assert_sound(&world);
}
