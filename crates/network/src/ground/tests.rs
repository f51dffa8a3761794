use super::*;
use crate::geometry::{Polyline, Pose};
use crate::lanelet::{DrivingSide, Lanelet, LaneletIndex};

/// Two lanes of 3.5 m to the east, with centre lines at y = 0 and y = 3.5; the first one bends to the north at its
/// end.
fn roads() -> Ground {
    let lanelet = |id, points: &[(f64, f64)]| {
        let line =
            |left: f64| Polyline::new(points.iter().map(|(x, y)| Point::new(*x, y + left, 0.0))).unwrap();
        Lanelet::alone(id, [line(1.75), line(-1.75), line(0.0)], 20.0)
    };
    let mut straight = lanelet(1, &[(0.0, 0.0), (40.0, 0.0), (80.0, 0.0)]);
    straight.following = vec![LaneletIndex(2)];
    let mut beside = lanelet(2, &[(0.0, 3.5), (80.0, 3.5)]);
    // Where lanes merge a chain ends.
    beside.following = vec![LaneletIndex(2)];
    let mut bend = lanelet(3, &[(80.0, 0.0), (90.0, 10.0)]);
    bend.left_border = Polyline::new([Point::new(78.5, 1.5, 0.0), Point::new(88.5, 11.5, 0.0)]).unwrap();
    bend.right_border = Polyline::new([Point::new(81.5, -1.5, 0.0), Point::new(91.5, 8.5, 0.0)]).unwrap();
    Ground::new(&Network::new(vec![straight, beside, bend], DrivingSide::Right).unwrap())
}

fn car(x: f64, y: f64, heading: f64) -> Rectangle {
    Rectangle { pose: Pose { at: Point::new(x, y, 0.0), heading }, length: 4.5, width: 1.8 }
}

fn touched(rectangle: &Rectangle) -> Vec<(u32, f64, f64)> {
    let rounded = |it: f64| (it * 1000.0).round() / 1000.0;
    let all = roads().footprints(rectangle);
    all.iter().map(|it| (it.chain.0, rounded(it.from), rounded(it.to))).collect()
}

#[test]
fn a_car_in_its_lane_touches_this_lane_alone_from_bumper_to_bumper() {
    assert_eq!(touched(&car(41.0, 0.0, 0.0)), [(0, 38.75, 43.25)]);
    assert_eq!(touched(&car(41.0, 1.0, 0.0)), [(0, 38.75, 43.25)]);
}

#[test]
fn a_car_between_two_lanes_touches_both_and_one_beside_the_road_none() {
    assert_eq!(touched(&car(20.0, 1.75, 0.0)), [(0, 17.75, 22.25), (1, 17.75, 22.25)]);
    assert_eq!(touched(&car(20.0, -2.5, 0.0)), []);
}

#[test]
fn a_car_across_the_road_takes_its_width_of_each_lane() {
    let across = car(20.0, 1.75, 0.5 * std::f64::consts::PI);
    assert_eq!(touched(&across), [(0, 19.1, 20.9), (1, 19.1, 20.9)]);
}

#[test]
fn at_an_angle_only_what_lies_on_the_path_counts() {
    let [(chain, from, to)] = touched(&car(20.0, -1.5, 0.5))[..] else { panic!("one lane") };
    assert!(chain == 0 && from > 17.6 && to < 22.6, "{from} {to}");
}

#[test]
fn at_the_end_of_a_chain_a_car_is_on_both_chains() {
    let all = touched(&car(80.0, 0.0, 0.3));
    assert_eq!(all.iter().map(|it| it.0).collect::<Vec<_>>(), [0, 2]);
    assert!(all[0].2 == 80.0 && all[1].1 == 0.0, "{all:?}");
}
