//! Which side has priority in a zone: signs, then roundabouts, then vehicles that do not turn, then the side.

use std::f64::consts::FRAC_PI_2;

use laneweave_network::{
    DrivingSide, LaneletIndex, Point, Precedence, Priority, Regulations, StopKind, StopRule, ZoneKind,
};

use crate::junctions::drawn::{Lanes, arc, crossing, joined, straight};

fn lanelets(numbers: &[u32]) -> Vec<LaneletIndex> {
    numbers.iter().map(|it| LaneletIndex(*it)).collect()
}

fn stop(kind: StopKind, obeying: &[u32]) -> StopRule {
    StopRule { id: 1.into(), kind, lanelets: lanelets(obeying), lines: Vec::new() }
}

fn stops(rules: &[StopRule]) -> Regulations {
    Regulations { stops: rules.to_vec(), ..Regulations::default() }
}

fn goes_before(first: u32, yielding: u32) -> Regulations {
    let priority = Priority { first: lanelets(&[first]), yielding: lanelets(&[yielding]) };
    Regulations { priorities: vec![priority], ..Regulations::default() }
}

/// The side with priority where the lanes to the east (0) and to the north (1) cross.
fn at_the_crossing(regulations: &Regulations) -> Precedence {
    crossing(0.0).junctions(regulations).zones[0].precedence
}

/// The side with priority, on a road where traffic drives on the given side, without rules.
fn without_rules(lanes: &Lanes, side: DrivingSide) -> Vec<Precedence> {
    let junctions = lanes.network(side).regulated(&Regulations::default()).junctions;
    junctions.zones.iter().map(|it| it.precedence).collect()
}

/// One lane to the east (0), and one from there that turns left across it to the south (1).
fn left_turn() -> Lanes {
    let turning = joined(&[
        straight((100.0, 3.5), (8.0, 3.5)),
        arc((8.0, -6.5), 10.0, FRAC_PI_2, FRAC_PI_2),
        straight((-2.0, -6.5), (-2.0, -100.0)),
    ]);
    Lanes::default().with(straight((-100.0, 0.0), (100.0, 0.0)), &[]).with(turning, &[])
}

/// A circulating lane of radius 15 m, counter-clockwise from the south, in quarters 0 to 3; lane 4 leads into its
/// first quarter, lane 5 leads out of its second.
fn roundabout() -> Lanes {
    let quarter = |number: f64| arc((0.0, 0.0), 15.0, (number - 1.0) * FRAC_PI_2, FRAC_PI_2);
    Lanes::default()
        .with(quarter(0.0), &[1])
        .with(quarter(1.0), &[2, 5])
        .with(quarter(2.0), &[3])
        .with(quarter(3.0), &[0])
        .with(straight((-60.0, -50.0), (0.0, -15.0)), &[0])
        .with(straight((0.0, 15.0), (-60.0, 50.0)), &[])
}

#[test]
fn a_sign_that_orders_the_right_of_way_decides_whoever_comes_from_the_right() {
    assert_eq!(at_the_crossing(&goes_before(0, 1)), Precedence::Side(0));
    assert_eq!(at_the_crossing(&goes_before(1, 0)), Precedence::Side(1));
}

#[test]
fn a_sign_that_orders_the_right_of_way_comes_before_stop_signs() {
    let rules = Regulations { stops: vec![stop(StopKind::StopSign, &[0])], ..goes_before(0, 1) };
    assert_eq!(at_the_crossing(&rules), Precedence::Side(0));
}

#[test]
fn priorities_of_lanelets_that_lead_to_a_junction_hold_within_it() {
    let lanes = Lanes::default()
        .with(straight((-60.0, 0.0), (-10.0, 0.0)), &[1])
        .with(straight((-10.0, 0.0), (60.0, 0.0)), &[])
        .with(straight((0.0, -60.0), (0.0, -10.0)), &[3])
        .with(straight((0.0, -10.0), (0.0, 60.0)), &[]);
    assert_eq!(lanes.junctions(&goes_before(0, 2)).zones[0].precedence, Precedence::Side(0));
}

#[test]
fn who_has_a_stop_sign_gives_way_to_who_has_none() {
    assert_eq!(at_the_crossing(&stops(&[stop(StopKind::StopSign, &[1])])), Precedence::Side(0));
    assert_eq!(at_the_crossing(&stops(&[stop(StopKind::StopSign, &[0])])), Precedence::Side(1));
}

#[test]
fn where_all_have_to_stop_they_go_in_the_order_of_arrival() {
    assert_eq!(at_the_crossing(&stops(&[stop(StopKind::AllWayStop, &[0, 1])])), Precedence::Arrival);
    let two_signs = [stop(StopKind::StopSign, &[0]), stop(StopKind::StopSign, &[1])];
    assert_eq!(at_the_crossing(&stops(&two_signs)), Precedence::Arrival);
}

#[test]
fn without_signs_who_comes_from_the_right_goes_first_or_from_the_left_where_traffic_drives_there() {
    // A vehicle to the north comes from the right of a vehicle to the east.
    assert_eq!(without_rules(&crossing(0.0), DrivingSide::Right), [Precedence::FromTheRight(1)]);
    assert_eq!(without_rules(&crossing(0.0), DrivingSide::Left), [Precedence::FromTheRight(0)]);
}

#[test]
fn who_turns_across_the_oncoming_gives_way() {
    assert_eq!(without_rules(&left_turn(), DrivingSide::Right), [Precedence::Side(0)]);
}

#[test]
fn who_drives_in_a_ring_goes_before_who_comes_into_it() {
    let junctions = roundabout().junctions(&Regulations::default());
    let [zone] = junctions.zones[..] else { panic!("{:?}", junctions.zones) };
    assert!(matches!(zone.kind, ZoneKind::Merging(_)));
    let network = roundabout().network(DrivingSide::Right);
    let is_ring = |side: u8| {
        let chain = network.chain(zone.sides[usize::from(side)].chain);
        chain.lanelets.contains(&LaneletIndex(3))
    };
    let Precedence::Side(side) = zone.precedence else { panic!("{:?}", zone.precedence) };
    assert!(is_ring(side) && !is_ring(1 - side));
}

#[test]
fn a_large_circle_is_a_ring_and_a_block_of_that_length_is_none() {
    let closed = |piece: &dyn Fn(f64) -> Vec<Point>| {
        let lanes = Lanes::default().with(piece(0.0), &[1]).with(piece(1.0), &[2]);
        let lanes = lanes.with(piece(2.0), &[3]).with(piece(3.0), &[0]);
        let lanes = lanes.with(straight((-200.0, 0.0), (-60.0, 0.0)), &[3]);
        let network = lanes.network(DrivingSide::Right).regulated(&Regulations::default());
        let chain = network.start_of(LaneletIndex(1)).chain;
        network.junctions.is_in_roundabout(chain)
    };
    let quarter = |number: f64| arc((0.0, 0.0), 60.0, (number - 1.0) * FRAC_PI_2, FRAC_PI_2);
    let corners = [(-60.0, -60.0), (60.0, -60.0), (60.0, 60.0), (-60.0, 60.0), (-60.0, -60.0)];
    let side = |number: f64| straight(corners[number as usize], corners[number as usize + 1]);
    assert!(closed(&quarter) && !closed(&side));
}

#[test]
fn a_ring_run_the_wrong_way_around_is_no_roundabout() {
    let wrong_way = without_rules(&roundabout().mirrored(), DrivingSide::Right);
    assert!(matches!(wrong_way[..], [Precedence::FromTheRight(_) | Precedence::Arrival]), "{wrong_way:?}");
}

#[test]
fn in_a_mirror_where_traffic_drives_on_the_left_the_same_go_first() {
    for lanes in [crossing(0.0), left_turn(), roundabout()] {
        let original = without_rules(&lanes, DrivingSide::Right);
        assert!(!original.is_empty());
        assert_eq!(without_rules(&lanes.mirrored(), DrivingSide::Left), original);
    }
}
