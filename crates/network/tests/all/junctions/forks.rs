//! Up to where the branches of forks are in each other's way.

use laneweave_network::{ChainIndex, DrivingSide, ForkBranch, Network, Regulations};

use crate::junctions::drawn::{Lanes, straight};

fn regulated(lanes: &Lanes) -> Network {
    lanes.network(DrivingSide::Right).regulated(&Regulations::default())
}

fn chains<const N: usize>(numbers: [u32; N]) -> Vec<ChainIndex> {
    numbers.map(ChainIndex).to_vec()
}

#[test]
fn branches_part_where_cars_have_room_and_later_where_long_vehicles_have() {
    let lanes = Lanes::default()
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[1, 2])
        .with(straight((100.0, 0.0), (300.0, 0.0)), &[])
        .with(straight((100.0, 0.0), (300.0, 20.0)), &[]);
    let network = regulated(&lanes);
    // Two cars need 2.0 m, a car and a long vehicle 2.35 m, and two long ones 2.7 m. They part by 1 m in 10 m.
    let [before, straight, turning] = &network.chains[..] else { panic!("not three chains") };
    assert_eq!((before.fork_clearance, &before.branches[..]), (0.0, &[][..]));
    let [ForkBranch { chain, start, until, over, own_over }] = &straight.branches[..] else {
        panic!("{:?}", straight.branches)
    };
    assert_eq!((*chain, *start, over, own_over), (ChainIndex(2), 0.0, &chains([0]), &chains([0])));
    for (until, room) in until.iter().zip([2.0, 2.35, 2.7]) {
        assert!((until - 10.0 * room).abs() < 1.5, "{until} for {room} m");
    }
    assert_eq!(straight.fork_clearance, turning.branches[0].until[2]);
}

#[test]
fn a_branch_that_forks_again_before_it_has_parted_is_in_the_way_with_all_that_follows() {
    // The lane of 4 m forks, too.
    let lanes = Lanes::default()
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[1, 2])
        .with(straight((100.0, 0.0), (104.0, 0.0)), &[3, 4])
        .with(straight((100.0, 0.0), (300.0, 20.0)), &[])
        .with(straight((104.0, 0.0), (300.0, 0.0)), &[])
        .with(straight((104.0, 0.0), (300.0, -20.0)), &[]);
    let network = regulated(&lanes);
    assert!(network.junctions.zones.is_empty(), "{:?}", network.junctions.zones);
    let branches = |chain: u32| &network.chain(ChainIndex(chain)).branches;
    let seen = |from: u32, to: u32| branches(from).iter().find(|it| it.chain == ChainIndex(to)).unwrap();
    let straight_on = seen(2, 3);
    assert_eq!((straight_on.start, &straight_on.over), (4.0, &chains([1, 0])));
    assert!((straight_on.until([true; 2]) - 23.0).abs() < 1.5, "{straight_on:?}");
    let turning = seen(3, 2);
    assert_eq!((turning.start, &turning.over, &turning.own_over), (-4.0, &chains([0]), &chains([1, 0])));
    assert!((turning.until([true; 2]) - 27.0).abs() < 1.5, "{turning:?}");
    // Fronts are beyond the lane of 4 m while rears are still on it.
    assert!(seen(2, 4).until([true; 2]) > 0.0);
    assert!(network.chains.iter().all(|it| it.fork_clearance <= it.length));
}

#[test]
fn branches_that_have_parted_and_come_close_again_get_a_zone() {
    let bulging = [(100.0, 0.0), (110.0, 4.0), (120.0, 4.0), (130.0, 2.2), (160.0, 2.2)];
    let bulging: Vec<_> = bulging.windows(2).flat_map(|it| straight(it[0], it[1])).collect();
    let lanes = Lanes::default()
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[1, 2])
        .with(straight((100.0, 0.0), (160.0, 0.0)), &[])
        .with(bulging, &[]);
    let network = regulated(&lanes);
    let clearance = network.chain(ChainIndex(1)).fork_clearance;
    assert!((5.0..12.0).contains(&clearance), "{clearance}");
    let [zone, ..] = &network.junctions.zones[..] else { panic!("no zone") };
    assert!((120.0..132.0).contains(&(zone.sides[0].start + 100.0)), "{zone:?}");
}

#[test]
fn lanes_that_part_behind_a_lane_that_joins_both_get_a_zone_for_those_who_join() {
    // Lanes 0 and 1 both lead to 2 and 3.
    let lanes = Lanes::default()
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[2, 3])
        .with(straight((20.0, -60.0), (100.0, 0.0)), &[2, 3])
        .with(straight((100.0, 0.0), (200.0, 0.0)), &[])
        .with(straight((100.0, 0.0), (200.0, 20.0)), &[]);
    let network = regulated(&lanes);
    let branches = &network.chain(ChainIndex(2)).branches;
    let forks: Vec<_> = branches.iter().map(|it| it.over.clone()).collect();
    assert_eq!(forks, [chains([0]), chains([1])]);
    let is_between = |a: u32, b: u32| {
        network.junctions.zones.iter().any(|it| it.sides.map(|it| it.chain) == [a, b].map(ChainIndex))
    };
    assert!(is_between(0, 1) && is_between(2, 3), "{:?}", network.junctions.zones);
}
