//! Lanes between drawn borders: where they are wide enough to drive on, and whether narrow ones conflict.

use laneweave_network::{
    ChainIndex, DrivingSide, Id, Lanelet, LaneletIndex, Network, Point, Polyline, Position, Regulations,
    Side, Touch, ZoneKind,
};

/// Speed limit of all lanes [m/s].
const LIMIT: f64 = 50.0 / 3.6;

/// A lanelet between two borders, each from its points [m].
pub(crate) fn lanelet(id: i64, left: &[(f64, f64)], right: &[(f64, f64)]) -> Lanelet {
    let line = |points: &[(f64, f64)]| {
        Polyline::new(points.iter().map(|(x, y)| Point::new(*x, *y, 0.0))).expect("the line has a length")
    };
    let (left, right) = (line(left), line(right));
    let centre = Polyline::between(&left, &right).expect("the line has a length");
    Lanelet::alone(id, [left, right, centre], LIMIT)
}

/// A straight lanelet to the east, from `x` to `to`, its right border at `y`.
pub(crate) fn eastward(id: i64, [x, to]: [f64; 2], y: f64, width: f64) -> Lanelet {
    lanelet(id, &[(x, y + width), (to, y + width)], &[(x, y), (to, y)])
}

/// The network of lanelets where traffic drives on the right and no rules hold.
pub(crate) fn network(lanelets: Vec<Lanelet>) -> Network {
    Network::new(lanelets, DrivingSide::Right).expect("the lanelets fit").regulated(&Regulations::default())
}

/// The names of the entrances.
pub(crate) fn entrances(network: &Network) -> Vec<Id> {
    network.entrances.iter().map(|it| it.id).collect()
}

/// A road of 500 m, beside its first 300 m on the right a lane that narrows from 3.30 m to nothing in its last 100 m.
fn tapering() -> Network {
    let mut road = vec![
        eastward(1, [0.0, 200.0], 3.3, 3.3),
        eastward(2, [200.0, 300.0], 3.3, 3.3),
        eastward(3, [0.0, 200.0], 0.0, 3.3),
        lanelet(4, &[(200.0, 3.3), (300.0, 3.3)], &[(200.0, 0.0), (300.0, 3.3)]),
        eastward(5, [300.0, 500.0], 3.3, 3.3),
    ];
    for (index, next) in [(0, 1), (1, 4), (2, 3)] {
        road[index].following = vec![LaneletIndex(next)];
    }
    for (left, right) in [(0, 2), (1, 3)] {
        road[left].right = Some(LaneletIndex(right as u32));
        road[right].left = Some(LaneletIndex(left as u32));
    }
    network(road)
}

#[test]
fn a_lane_that_narrows_to_nothing_ends_for_each_class_where_it_is_as_wide_as_that() {
    let network = tapering();
    let [road, drop] = &network.chains[..] else { panic!("{} chains", network.chains.len()) };
    assert!(drop.is_lane_drop() && drop.is_restricted && !road.is_restricted);
    // It is 3.30 m wide at 200 m and narrows by 3.3 cm in a metre: to 1.80 m in 45.5 m, to 2.55 m in 22.7 m.
    for (is_long, end) in [(false, 245.5), (true, 222.7)] {
        let until = drop.driven_until(is_long);
        // Widths are compared every half metre; across the lane, not across the road, they are a little smaller.
        assert!((until - end).abs() < 1.5, "{until} instead of {end}");
        assert!(drop.is_open(0.0, is_long) && drop.is_open(until, is_long), "{:?}", drop.open);
        assert!(!drop.is_open(until + 1.0, is_long), "{:?}", drop.open);
        assert_eq!(road.driven_until(is_long), road.length);
    }
    assert_eq!(network.junctions.zones, [], "nobody drives where it touches the other lane");
}

/// A road of 400 m between borders 2.6 m apart, with a lane on the right beside its first half. From 200 m on
/// vehicles can leave this lane, and it narrows at once, to nothing in `taper` [m].
fn late(taper: f64) -> Network {
    let mut road = vec![
        eastward(1, [0.0, 200.0], 2.6, 2.6),
        eastward(2, [200.0, 200.0 + taper], 2.6, 2.6),
        eastward(3, [200.0 + taper, 400.0], 2.6, 2.6),
        eastward(4, [0.0, 200.0], 0.0, 2.6),
        lanelet(5, &[(200.0, 2.6), (200.0 + taper, 2.6)], &[(200.0, 0.0), (200.0 + taper, 2.6)]),
    ];
    for (index, next) in [(0, 1), (1, 2), (3, 4)] {
        road[index].following = vec![LaneletIndex(next)];
    }
    road[1].right = Some(LaneletIndex(4));
    road[4].left = Some(LaneletIndex(1));
    network(road)
}

#[test]
fn a_lane_that_narrows_as_soon_as_it_can_be_left_ends_for_nobody_before_there_was_road_to_leave_it() {
    for taper in [30.0, 45.0, 60.0] {
        let network = late(taper);
        let drop = network.chains.iter().find(|it| it.is_lane_drop()).expect("a lane that ends");
        let [stretch] = drop.stretches(Side::Left) else { panic!("{:?}", drop.stretches(Side::Left)) };
        assert!((stretch.end - stretch.start - taper).abs() < 1.5, "no zone takes any of it: {stretch:?}");
        for is_long in [false, true] {
            let left_by = drop.driven_until(is_long) - stretch.start;
            assert!(left_by >= 5.0, "{left_by} m to leave a taper of {taper} m");
        }
        assert!(drop.driven_until(false) >= drop.driven_until(true));
    }
}

#[test]
fn lanes_side_by_side_of_2_60_m_do_not_get_in_each_others_way() {
    let mut lanes = vec![eastward(1, [0.0, 400.0], 2.6, 2.6), eastward(2, [0.0, 400.0], 0.0, 2.6)];
    lanes[0].right = Some(LaneletIndex(1));
    lanes[1].left = Some(LaneletIndex(0));
    let network = network(lanes);
    assert_eq!(network.junctions.zones, []);
    for (chain, side) in network.chains.iter().zip([Side::Right, Side::Left]) {
        assert!(!chain.is_restricted, "as wide as the widest vehicle");
        assert_eq!(chain.stretches(side).len(), 1, "one may change lanes all along");
    }
}

#[test]
fn lanes_that_are_narrow_far_from_where_one_of_them_opens_get_in_each_others_way() {
    let mut lanes = vec![
        eastward(1, [0.0, 100.0], 2.4, 3.3),
        lanelet(2, &[(0.0, 2.4), (100.0, 2.4)], &[(0.0, 2.4), (100.0, -0.9)]),
        eastward(3, [100.0, 400.0], 2.4, 2.4),
        eastward(4, [100.0, 400.0], 0.0, 2.4),
        eastward(5, [-50.0, 0.0], 2.4, 3.3),
    ];
    for (left, right) in [(0, 1), (2, 3)] {
        lanes[left].right = Some(LaneletIndex(right as u32));
        lanes[right].left = Some(LaneletIndex(left as u32));
    }
    for (index, next) in [(0, 2), (1, 3), (4, 0)] {
        lanes[index].following = vec![LaneletIndex(next)];
    }
    let network = network(lanes);
    let reaches = network.junctions.zones.iter().map(|it| (it.touch, it.sides.map(|side| side.end)));
    let reaches: Vec<_> = reaches.collect();
    assert!(
        reaches.iter().any(|(touch, ends)| *touch == Touch::BothLong && ends.iter().all(|it| *it > 390.0)),
        "{reaches:?}"
    );
}

#[test]
fn a_strip_of_0_95_m_beside_a_lane_is_closed_and_in_nobodys_way() {
    let network = network(vec![eastward(1, [0.0, 700.0], 0.0, 3.3), eastward(2, [100.0, 400.0], -1.1, 0.95)]);
    let [lane, strip] = &network.chains[..] else { panic!("{} chains", network.chains.len()) };
    for station in [0.0, 150.0, 300.0] {
        assert!([false, true].iter().all(|is_long| !strip.is_open(station, *is_long)), "{station}");
        assert!([false, true].iter().all(|is_long| lane.is_open(station, *is_long)), "{station}");
    }
    assert_eq!(entrances(&network), [1]);
    assert_eq!(network.junctions.zones, []);
}

#[test]
fn a_lane_of_2_m_from_edge_to_edge_is_driven_and_noted_as_tight_for_long_vehicles() {
    let network = network(vec![eastward(1, [0.0, 100.0], 0.0, 2.0)]);
    let [lane] = &network.chains[..] else { panic!("{} chains", network.chains.len()) };
    assert!(lane.is_tight_for_long && lane.is_open(50.0, true) && lane.is_open(50.0, false));
    assert_eq!(entrances(&network), [1]);
}

#[test]
fn a_way_that_leads_into_another_beside_a_strip_meets_that_way_alone() {
    let mut lanes = vec![
        eastward(1, [0.0, 395.0], 0.0, 3.3),
        eastward(2, [395.0, 700.0], 0.0, 3.3),
        eastward(3, [100.0, 400.0], -1.1, 0.95),
        lanelet(
            4,
            &[(335.0, 48.0), (380.0, 11.0), (395.0, 3.3)],
            &[(332.0, 45.0), (376.0, 7.5), (395.0, 0.0)],
        ),
    ];
    for from in [0, 3] {
        lanes[from].following = vec![LaneletIndex(1)];
    }
    let network = network(lanes);
    let [zone] = &network.junctions.zones[..] else { panic!("{:?}", network.junctions.zones) };
    assert!(matches!(zone.kind, ZoneKind::Merging(_)), "{zone:?}");
    let lanelets = zone.sides.map(|it| network.lanelet_at(Position::new(it.chain, it.end)).0.id);
    assert_eq!(lanelets, [1, 4]);
}

/// Points on an arc of this radius around the origin, which turns left from one angle [°] to another; beyond each angle
/// the radius grows by what `wider` says [m].
fn arc(radius: f64, [from, to]: [f64; 2], wider: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let angles = (0..=60).map(|it| from + (to - from) * f64::from(it) / 60.0);
    let point = |it: f64| {
        let (sin, cos) = it.to_radians().sin_cos();
        ((radius + wider(it)) * cos, (radius + wider(it)) * sin)
    };
    angles.map(point).collect()
}

/// A lane of 2.8 m that turns left with a radius of 60 m on its outer border. On its left, inside, lies one of 2.5 m
/// which narrows to nothing over its last third.
fn narrows_in_a_bend() -> Network {
    const RADIUS: f64 = 60.0;
    let taper = |at: f64| 2.5 * ((at - 60.0) / 60.0).clamp(0.0, 1.0);
    let none = |_: f64| 0.0;
    let lane = |id, degrees, inner: &dyn Fn(f64) -> f64, radii: [f64; 2]| {
        lanelet(id, &arc(radii[0], degrees, inner), &arc(radii[1], degrees, none))
    };
    let border = RADIUS - 2.8;
    let mut road = vec![
        lane(1, [-60.0, 120.0], &none, [border, RADIUS]),
        lane(2, [120.0, 240.0], &none, [border, RADIUS]),
        lane(3, [-60.0, 120.0], &taper, [border - 2.5, border]),
    ];
    road[0].following = vec![LaneletIndex(1)];
    road[0].left = Some(LaneletIndex(2));
    road[2].right = Some(LaneletIndex(0));
    network(road)
}

#[test]
fn a_lane_that_ends_in_a_bend_ends_for_a_car_before_a_long_vehicle_beside_it_would_touch() {
    let network = narrows_in_a_bend();
    let at = network.chains.iter().position(|it| it.is_lane_drop()).expect("a lane that ends");
    let (drop, beside) = (&network.chains[at], &network.chains[1 - at]);
    let until = drop.driven_until(false);
    let (lanelet, along) = network.lanelet_at(Position::new(ChainIndex(at as u32), until));
    let width = lanelet.clear_width(along);
    assert!(width > 1.9, "it ends where it is {width} m wide, still wider than a car");
    // The middle of a bus of 12 m is on the chord between its ends. The widths of a car and a bus are 1.80 and 2.55 m.
    let middle = |at: f64| beside.centre.at(at - 6.0).midpoint(&beside.centre.at(at + 6.0));
    let nearest = |car: f64| {
        let places = (20..360).map(|it| middle(0.5 * f64::from(it)).distance(&drop.centre.at(car)));
        places.fold(f64::INFINITY, f64::min)
    };
    assert!(nearest(until) >= 0.5 * (1.80 + 2.55), "{} m at {until} m", nearest(until));
    assert!(nearest(until + 1.5) < 0.5 * (1.80 + 2.55), "{} m beyond {until} m", nearest(until + 1.5));
}
