//! The plan of a motorway: what fits on it, and the stations at which its rows of lanelets are cut.

use std::fmt;

use super::ramp::{self, Direction, Ramp};
use super::{Motorway, Weaving};
use crate::error::{GenerateError, check_count, check_range};

/// Maximum of lanes.
const MAXIMUM_LANES: usize = 12;
/// Minimum distance between ramps, lane drops and the ends of the road, so that no row is shorter [m].
const CLEARANCE: f64 = 10.0;
/// Minimum length of a road with ramps [m].
const SHORTEST_WITH_RAMPS: f64 = 500.0;
/// Bounds of the length of a weaving section [m]. Ours.
const WEAVING_LENGTHS: [f64; 2] = [100.0, 1000.0];
/// Maximum of lanelets.
const MAXIMUM_LANELETS: f64 = 5e6;

/// The stations at which a motorway is cut, and what lies beside it.
#[derive(Debug)]
pub(super) struct Plan {
    /// Where rows begin and end, in order [m].
    pub(super) stations: Vec<f64>,
    /// Ramps in order along the road.
    pub(super) ramps: Vec<Ramp>,
    lane_drop: Option<f64>,
}

impl Plan {
    pub(super) fn of(motorway: &Motorway) -> Result<Plan, GenerateError> {
        check_numbers(motorway)?;
        let mut features = Feature::all(motorway);
        features.sort_by(|a, b| a.extent()[0].total_cmp(&b.extent()[0]));
        check_places(&features, motorway.length_m)?;
        let ramps = features.iter().flat_map(Feature::ramps).collect();
        let plan = Plan { stations: Vec::new(), ramps, lane_drop: motorway.lane_drop_at };
        Ok(Plan { stations: plan.stations(motorway), ..plan })
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.stations.len() - 1
    }

    /// The line at the outer edge of the slow lane in `row`; line 0 is where the road begins.
    pub(super) fn slow_line(&self, row: usize) -> i32 {
        i32::from(self.lane_drop.is_some_and(|at| self.stations[row] >= at))
    }

    /// The outermost line of `row`: where an acceleration or deceleration lane runs, it lies beyond that of the slow
    /// lane.
    pub(super) fn outer_line(&self, row: usize) -> i32 {
        let middle = (self.stations[row] + self.stations[row + 1]) / 2.0;
        let has_lane = self.ramps.iter().any(|it| it.lane[0] < middle && middle < it.lane[1]);
        self.slow_line(row) - i32::from(has_lane)
    }

    /// The number of the station at `x`.
    pub(super) fn station(&self, x: f64) -> usize {
        self.stations.partition_point(|it| *it < x)
    }

    fn stations(&self, motorway: &Motorway) -> Vec<f64> {
        let mut cuts = vec![0.0, motorway.length_m];
        cuts.extend(self.lane_drop);
        cuts.extend(self.ramps.iter().flat_map(|ramp| ramp.lane));
        cuts.sort_by(f64::total_cmp);
        // Both ramps of a weaving section have the same lane.
        cuts.dedup();
        let mut stations = vec![0.0];
        for pair in cuts.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let pieces = ((to - from) / motorway.lanelet_length_m).round().max(1.0) as usize;
            stations.extend((1..pieces).map(|i| from + (to - from) * i as f64 / pieces as f64));
            stations.push(to);
        }
        stations
    }
}

/// A part of the plan that needs length on the road.
enum Feature {
    Ramp(Ramp),
    /// An on-ramp and an off-ramp with one lane between them.
    Weaving(Weaving),
    LaneDrop(f64),
}

impl Feature {
    fn all(motorway: &Motorway) -> Vec<Feature> {
        let ramp = |direction| move |at: &f64| Feature::Ramp(Ramp::usual(direction, *at));
        let on = motorway.on_ramp_at.iter().map(ramp(Direction::On));
        let off = motorway.off_ramp_at.iter().map(ramp(Direction::Off));
        let weaving = motorway.weaving.iter().map(|it| Feature::Weaving(*it));
        let lane_drop = motorway.lane_drop_at.map(Feature::LaneDrop);
        on.chain(off).chain(weaving).chain(lane_drop).collect()
    }

    fn ramps(&self) -> Vec<Ramp> {
        match *self {
            Feature::Ramp(ramp) => vec![ramp],
            Feature::Weaving(Weaving { from_m, length_m }) => {
                let lane = [from_m, from_m + length_m];
                vec![Ramp { direction: Direction::On, lane }, Ramp { direction: Direction::Off, lane }]
            }
            Feature::LaneDrop(_) => Vec::new(),
        }
    }

    /// Where it begins and ends [m].
    fn extent(&self) -> [f64; 2] {
        match *self {
            Feature::Ramp(ramp) => ramp.extent(),
            Feature::Weaving(Weaving { from_m, length_m }) => {
                [from_m - ramp::LENGTH, from_m + length_m + ramp::LENGTH]
            }
            Feature::LaneDrop(at) => [at, at],
        }
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Feature::Ramp(ramp) => ramp.fmt(f),
            Feature::Weaving(Weaving { from_m, .. }) => write!(f, "weaving section at {from_m} m"),
            Feature::LaneDrop(at) => write!(f, "lane drop at {at} m"),
        }
    }
}

/// Refuses features, in order along the road, that do not fit on it or overlap.
fn check_places(features: &[Feature], length: f64) -> Result<(), GenerateError> {
    for feature in features {
        let [from, to] = feature.extent();
        // This form also refuses NaN.
        if !(from >= CLEARANCE && to <= length - CLEARANCE) {
            return Err(GenerateError::OutsideRoad { what: feature.to_string(), from, to, length });
        }
    }
    match features.windows(2).find(|pair| pair[1].extent()[0] - pair[0].extent()[1] < CLEARANCE) {
        Some(pair) => Err(GenerateError::Overlap(pair[0].to_string(), pair[1].to_string())),
        None => Ok(()),
    }
}

fn check_numbers(motorway: &Motorway) -> Result<(), GenerateError> {
    check_count("lanes", motorway.lanes, [1, MAXIMUM_LANES])?;
    let has_ramps =
        !(motorway.on_ramp_at.is_empty() && motorway.off_ramp_at.is_empty() && motorway.weaving.is_none());
    let shortest = if has_ramps { SHORTEST_WITH_RAMPS } else { CLEARANCE };
    let ranges = [
        ("a length", motorway.length_m, "m", shortest, 4e7),
        ("a speed limit", motorway.speed_limit_kmh, "km/h", 5.0, 300.0),
        ("a lane width", motorway.lane_width_m, "m", 2.0, 10.0),
        ("a lanelet length", motorway.lanelet_length_m, "m", CLEARANCE, 1000.0),
    ];
    for (what, value, unit, from, to) in ranges {
        check_range(what, value, unit, [from, to])?;
    }
    if let Some(Weaving { length_m, .. }) = motorway.weaving {
        check_range("a weaving section", length_m, "m", WEAVING_LENGTHS)?;
    }
    let lanelets = motorway.length_m / motorway.lanelet_length_m * motorway.lanes as f64;
    if lanelets > MAXIMUM_LANELETS {
        return Err(GenerateError::TooMany(lanelets));
    }
    if motorway.lanes == 1 && motorway.lane_drop_at.is_some() {
        return Err(GenerateError::OnlyLaneEnds);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(change: impl Fn(&mut Motorway)) -> String {
        let mut motorway = Motorway::default();
        change(&mut motorway);
        Plan::of(&motorway).unwrap_err().to_string()
    }

    #[test]
    fn numbers_out_of_range_are_refused_with_the_range() {
        assert_eq!(refusal(|it| it.lanes = 0), "0 lanes; choose 1 to 12");
        assert_eq!(refusal(|it| it.lanes = 13), "13 lanes; choose 1 to 12");
        assert_eq!(refusal(|it| it.length_m = -1.0), "a length of -1 m; choose 10 to 40000000 m");
        assert_eq!(
            refusal(|it| it.speed_limit_kmh = f64::NAN),
            "a speed limit of NaN km/h; choose 5 to 300 km/h"
        );
        assert!(refusal(|it| it.lane_width_m = 0.0).starts_with("a lane width of 0 m"));
        assert!(refusal(|it| it.lanelet_length_m = f64::INFINITY).starts_with("a lanelet length of inf m"));
        assert!(refusal(|it| (it.length_m, it.lanelet_length_m) = (4e7, 10.0)).contains("12000000 lanelets"));
    }

    #[test]
    fn ramps_and_drops_must_fit_on_the_road() {
        assert_eq!(
            refusal(|it| it.on_ramp_at = vec![100.0]),
            "the on-ramp at 100 m needs the road from -100 m to 350 m, but its length is 5000 m; move it or lengthen the road"
        );
        assert!(refusal(|it| it.off_ramp_at = vec![4900.0]).starts_with("the off-ramp at 4900 m needs"));
        assert!(refusal(|it| it.on_ramp_at = vec![f64::NAN]).starts_with("the on-ramp at NaN m needs"));
        assert!(refusal(|it| it.lane_drop_at = Some(5000.0)).starts_with("the lane drop at 5000 m needs"));
        assert!(
            refusal(|it| (it.length_m, it.on_ramp_at) = (499.0, vec![240.0])).starts_with("a length of 499")
        );
        assert!(refusal(|it| (it.lanes, it.lane_drop_at) = (1, Some(900.0))).starts_with("the only lane"));
    }

    #[test]
    fn ramps_and_drops_keep_apart() {
        let both = |on, off| refusal(|it| (it.on_ramp_at, it.off_ramp_at) = (vec![on], vec![off]));
        assert_eq!(
            both(1000.0, 1400.0),
            "the on-ramp at 1000 m and the off-ramp at 1400 m overlap or nearly touch; move one of them"
        );
        assert!(refusal(|it| it.on_ramp_at = vec![1000.0, 1000.0]).contains("overlap"));
        assert!(
            refusal(|it| (it.on_ramp_at, it.lane_drop_at) = (vec![1000.0], Some(1100.0))).contains("overlap")
        );
    }

    #[test]
    fn a_weaving_section_takes_room_for_both_of_its_ramps() {
        let weaving = |from_m, length_m| {
            refusal(|it| (it.length_m, it.weaving) = (2000.0, Some(Weaving { from_m, length_m })))
        };
        assert_eq!(
            weaving(1500.0, 400.0),
            "the weaving section at 1500 m needs the road from 1300 m to 2100 m, but its length is 2000 m; move it or lengthen the road"
        );
        assert_eq!(weaving(800.0, 50.0), "a weaving section of 50 m; choose 100 to 1000 m");
        assert!(weaving(f64::NAN, 400.0).contains("needs the road"));
    }

    #[test]
    fn rows_are_cut_where_something_begins_or_ends() {
        let motorway = Motorway {
            length_m: 1000.0,
            on_ramp_at: vec![300.0],
            lane_drop_at: Some(800.0),
            lanelet_length_m: 200.0,
            ..Motorway::default()
        };
        let plan = Plan::of(&motorway).unwrap();
        assert_eq!(plan.stations, [0.0, 150.0, 300.0, 550.0, 800.0, 1000.0]);
        let outer: Vec<i32> = (0..plan.rows()).map(|row| plan.outer_line(row)).collect();
        assert_eq!(outer, [0, 0, -1, 0, 1]);
        assert_eq!(plan.station(550.0), 3);
    }
}
