//! Conflict zones lie where vehicles would touch, and nowhere else.

use std::f64::consts::{FRAC_PI_2, PI};

use laneweave_network::{ChainIndex, Point, Regulations, Touch, Zone, ZoneKind};
use proptest::prelude::*;

use crate::junctions::drawn::{Lanes, WIDTH, arc, crossing, joined, straight};

/// Width of the largest vehicle and the space beside it [m]: within this distance of a path another vehicle is in the
/// way.
const CLOSE: f64 = 2.55 + 0.15;
/// Distance between the compared places [m]; a zone begins and ends at most this far beyond the obstruction.
const SAMPLE: f64 = 0.5;

fn only(zones: &[Zone]) -> &Zone {
    let [zone] = zones else { panic!("{} zones", zones.len()) };
    zone
}

/// Two lanes at an angle, of 100 m each, that meet in the point (0, 0).
fn meeting_at(angle: f64) -> [Vec<Point>; 2] {
    let (sin, cos) = angle.sin_cos();
    [straight((-100.0, 0.0), (0.0, 0.0)), straight((-100.0 * cos, -100.0 * sin), (0.0, 0.0))]
}

#[test]
fn lanes_that_cross_at_right_angles_are_in_the_way_for_a_vehicles_width_and_the_space_beside_it() {
    let zones = crossing(0.0).zones();
    let zone = only(&zones);
    assert_eq!(zone.kind, ZoneKind::Crossing);
    for (side, chain) in zone.sides.iter().zip(0..) {
        // 2.70 m to each side of 100 m, in whole samples, and one more.
        assert_eq!((side.chain, side.start, side.end), (ChainIndex(chain), 97.0, 103.0));
    }
}

#[test]
fn a_vehicle_is_crossed_from_where_its_front_enters_a_crossing_until_its_rear_has_left_it() {
    let junctions = crossing(0.0).junctions(&Regulations::default());
    let is_crossed = |rear, front| junctions.is_crossed(ChainIndex(0), [rear, front], false);
    assert!(!is_crossed(85.0, 97.0) && is_crossed(85.5, 97.5));
    assert!(is_crossed(102.5, 114.5) && !is_crossed(103.0, 115.0));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lanes_that_cross_at_any_angle_are_in_the_way_until_their_paths_are_apart(degrees in 25.0..155.0_f64) {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let zones = Lanes::default()
            .with(straight((-100.0, 0.0), (100.0, 0.0)), &[])
            .with(straight((-100.0 * cos, -100.0 * sin), (100.0 * cos, 100.0 * sin)), &[])
            .zones();
        let half = CLOSE / sin;
        for side in only(&zones).sides {
            prop_assert!((side.start - (100.0 - half)).abs() <= 2.0 * SAMPLE, "{side:?}, {half}");
            prop_assert!((side.end - (100.0 + half)).abs() <= 2.0 * SAMPLE, "{side:?}, {half}");
        }
    }
}

#[test]
fn a_bridge_6_m_above_a_lane_is_not_in_its_way_and_one_that_is_too_low_is() {
    assert_eq!(crossing(6.0).zones(), []);
    assert_eq!(crossing(2.6).zones(), []);
    assert_eq!(crossing(2.4).zones().len(), 1);
}

#[test]
fn lanes_that_fork_off_together_are_not_in_each_others_way() {
    let lanes = Lanes::default()
        .with(straight((-100.0, 0.0), (0.0, 0.0)), &[1, 2])
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[])
        .with(straight((0.0, 0.0), (94.0, 34.0)), &[]);
    assert_eq!(lanes.zones(), []);
}

#[test]
fn lanes_that_fork_off_together_are_in_each_others_way_where_a_lane_in_between_brings_others() {
    // The upper branch crosses the lower one after 25 m.
    let fork = || {
        Lanes::default()
            .with(straight((-100.0, 0.0), (0.0, 0.0)), &[1, 2])
            .with(straight((0.0, 0.0), (25.0, 3.0)), &[3])
            .with(straight((0.0, 0.0), (100.0, 0.0)), &[])
            .with(straight((25.0, 3.0), (55.0, -15.0)), &[])
    };
    let crosses = |it: &Zone| it.kind == ZoneKind::Crossing && it.touch == Touch::Any;
    assert!(!fork().zones().iter().any(crosses));
    let joined = fork().with(straight((-60.0, 30.0), (25.0, 3.0)), &[3]);
    assert_eq!(joined.zones().iter().filter(|it| crosses(it)).count(), 1);
}

#[test]
fn lanes_that_begin_together_at_the_edge_of_the_map_are_entered_one_behind_the_other() {
    let lanes = Lanes::default()
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[])
        .with(straight((0.0, 0.0), (94.0, 34.0)), &[]);
    let zones = lanes.zones();
    let ZoneKind::Merging(stations) = only(&zones).kind else { panic!("{zones:?}") };
    for (side, station) in only(&zones).sides.iter().zip(stations) {
        assert!(side.start == 0.0 && station == side.end + 12.0, "{side:?} {station}");
    }
}

#[test]
fn lanes_that_lead_into_one_merge_where_it_begins() {
    let [a, b] = meeting_at(20_f64.to_radians());
    let zones =
        Lanes::default().with(a, &[2]).with(b, &[2]).with(straight((0.0, 0.0), (100.0, 0.0)), &[]).zones();
    let zone = only(&zones);
    let ZoneKind::Merging(stations) = zone.kind else { panic!("{:?}", zone.kind) };
    let before = CLOSE / 20_f64.to_radians().sin();
    for (side, station) in zone.sides.iter().zip(stations) {
        assert!((station - 100.0).abs() < 1e-9);
        assert!((side.start - (100.0 - before)).abs() <= 2.0 * SAMPLE, "{side:?}");
        assert!((side.end - 100.5).abs() < 1e-9, "{side:?}");
    }
}

#[test]
fn lanes_of_different_lengths_merge_at_the_station_of_each() {
    let lanes = Lanes::default()
        .with(straight((-60.0, 0.0), (0.0, 0.0)), &[2])
        .with(straight((0.0, -40.0), (0.0, 0.0)), &[2])
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[]);
    let zones = lanes.zones();
    assert_eq!(only(&zones).kind, ZoneKind::Merging([60.0, 40.0]));
}

#[test]
fn lanes_side_by_side_are_in_each_others_way_in_tight_bends_only() {
    // Straight for 40 m, a quarter of a circle to the left, straight for 40 m.
    let bend = |inner: f64| {
        let at = |radius: f64| {
            joined(&[
                straight((-40.0, -radius), (0.0, -radius)),
                arc((0.0, 0.0), radius, -FRAC_PI_2, FRAC_PI_2),
                straight((radius, 0.0), (radius, 40.0)),
            ])
        };
        Lanes::default().with(at(inner), &[]).with(at(inner + WIDTH), &[]).zones()
    };
    // A vehicle of 12 m on 11.5 m reaches 1.5 m into the inner lane, on 43.5 m less than half a metre.
    let zones = bend(8.0);
    assert_eq!(only(&zones).touch, Touch::OneLong);
    for (side, radius) in only(&zones).sides.iter().zip([8.0, 11.5]) {
        let bend = 40.0..40.0 + 0.5 * PI * radius;
        assert!(bend.contains(&(0.5 * (side.start + side.end))), "{side:?}");
    }
    assert_eq!(bend(40.0), []);
    let straight_lanes = Lanes::default()
        .with(straight((0.0, 0.0), (100.0, 0.0)), &[])
        .with(straight((0.0, WIDTH), (100.0, WIDTH)), &[]);
    assert_eq!(straight_lanes.zones(), []);
}
