//! Assignments: every vehicle is counted from its origin to its destination, on the lanes of its route.

use laneweave_generate::{Motorway, motorway};
use laneweave_network::{ChainIndex, Network};
use laneweave_sim::{Assignment, Demand, Navigator};

fn assigned(network: &Network, demand: &Demand) -> Assignment {
    Assignment::new(network, &Navigator::towards(network, &demand.destinations), demand, [0.0, 1.0])
}

fn chains(network: &Network) -> impl Iterator<Item = ChainIndex> + use<> {
    (0..network.chains.len() as u32).map(ChainIndex)
}

/// Flow over all lanes at the distance `x` to the east [veh/h].
fn flow_at(network: &Network, assignment: &Assignment, x: f64) -> f64 {
    let on = |chain: ChainIndex| {
        let it = network.chain(chain);
        let station = x - it.centre.at(0.0).x;
        if (0.0..it.length).contains(&station) { assignment.flow(chain, station)[1] } else { 0.0 }
    };
    3600.0 * chains(network).map(on).sum::<f64>()
}

#[test]
fn lanes_side_by_side_share_a_flow_evenly() {
    let network = motorway(&Motorway::default()).unwrap().build().unwrap().network;
    let assignment = assigned(&network, &Demand::even(&network, 3000.0, 0.0, Vec::new()));
    assert!((3600.0 * assignment.total - 3000.0).abs() < 1e-9);
    for chain in chains(&network) {
        for station in [0.0, 100.0, 4999.0] {
            let [bound, all] = assignment.flow(chain, station);
            assert!((3600.0 * all - 1000.0).abs() < 1e-6 && bound == 0.0, "{all} {bound}");
        }
    }
}

#[test]
fn flows_grow_by_who_comes_and_shrink_by_who_leaves() {
    let plan = Motorway {
        lanes: 2,
        length_m: 4000.0,
        on_ramp_at: vec![1000.0],
        off_ramp_at: vec![3000.0],
        ..Motorway::default()
    };
    let network = motorway(&plan).unwrap().build().unwrap().network;
    let assignment = assigned(&network, &Demand::even(&network, 3000.0, 0.0, Vec::new()));
    // A third enters over the on-ramp; half leave over the off-ramp.
    for (x, expected) in [(500.0, 2000.0), (900.0, 3000.0), (2000.0, 3000.0), (3600.0, 1500.0)] {
        let flow = flow_at(&network, &assignment, x);
        assert!((flow - expected).abs() < 1e-6, "{flow} veh/h at {x} m");
    }
}

#[test]
fn all_who_come_over_a_ramp_have_to_leave_its_lane() {
    let plan = Motorway { lanes: 2, length_m: 4000.0, on_ramp_at: vec![1000.0], ..Motorway::default() };
    let network = motorway(&plan).unwrap().build().unwrap().network;
    let assignment = assigned(&network, &Demand::even(&network, 3000.0, 0.0, Vec::new()));
    let [change] = &assignment.changes[..] else { panic!("{:?}", assignment.changes) };
    let ((ramp, [start, end]), (lane, [beside, until])) = (change.from, change.to);
    assert!((3600.0 * change.flow - 1000.0).abs() < 1e-6);
    assert!(end - start > 100.0 && (until - beside - (end - start)).abs() < 1.0, "{change:?}");
    assert!(network.chain(ramp).is_lane_drop() && !network.chain(lane).is_lane_drop());
}

#[test]
fn who_must_leave_the_lane_is_on_the_other_one_after_the_last_place() {
    let plan = Motorway { lanes: 2, length_m: 3000.0, lane_drop_at: Some(1500.0), ..Motorway::default() };
    let network = motorway(&plan).unwrap().build().unwrap().network;
    let assignment = assigned(&network, &Demand::even(&network, 1200.0, 0.0, Vec::new()));
    for x in [100.0, 1000.0, 1700.0, 2900.0] {
        let flow = flow_at(&network, &assignment, x);
        assert!((flow - 1200.0).abs() < 1e-6, "{flow} veh/h at {x} m");
    }
}
