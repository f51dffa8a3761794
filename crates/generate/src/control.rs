//! The control of a junction, as rules of the map.

use laneweave_maps::RuleKind;
use laneweave_network::{Id, Point};

use super::canvas::Canvas;
use super::compass::Compass;
use super::junction::{Arm, Connector};
use super::street::LaneEnd;

/// Height of the lights above their stop line [m]. Ours.
const LIGHT: f64 = 5.0;

/// The control of a junction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Control {
    /// Lights for every lane; their program is not part of the map.
    #[default]
    Signals,
    /// The street that runs east and west has priority.
    Priority,
    /// No sign: vehicles from the right have priority, or from the left where traffic drives on the left.
    RightBeforeLeft,
    /// Every vehicle stops, and they go in the order of arrival.
    AllWayStop,
}

/// Adds the rules of a junction.
pub(super) fn regulate(canvas: &mut Canvas, control: Control, arms: &[Arm], connectors: &[Connector]) {
    match control {
        Control::Signals => signals(canvas, arms),
        Control::Priority => priority(canvas, arms, connectors),
        Control::RightBeforeLeft => {}
        Control::AllWayStop => all_way_stop(canvas, arms),
    }
}

fn signals(canvas: &mut Canvas, arms: &[Arm]) {
    arms.iter().flat_map(|it| &it.arriving).for_each(|it| light(canvas, it));
}

/// Adds a light for a lane.
pub(super) fn light(canvas: &mut Canvas, lane: &LaneEnd) {
    let line = stop_line(canvas, lane);
    let light = line.iter().map(|it| Point { z: it.z + LIGHT, ..*it }).collect();
    canvas.rule(RuleKind::TrafficLight, vec![lane.lanelet], vec![line], vec![light]);
}

/// A rule for each arm that gives way.
fn priority(canvas: &mut Canvas, arms: &[Arm], connectors: &[Connector]) {
    let is_main = |it: Compass| it.is_along_east();
    let first: Vec<Id> =
        arms.iter().filter(|it| is_main(it.towards)).flat_map(|it| it.ways(connectors)).collect();
    for arm in arms.iter().filter(|it| !is_main(it.towards) && !it.arriving.is_empty()) {
        yielding(canvas, &arm.arriving, first.clone(), arm.ways(connectors));
    }
}

/// Adds the rule that the lanelets of some lanes, and the lanelets that follow, give way to those with priority.
pub(super) fn yielding(canvas: &mut Canvas, lanes: &[LaneEnd], first: Vec<Id>, yielding: Vec<Id>) {
    let lines = lanes.iter().map(|it| stop_line(canvas, it)).collect();
    let lanelets = [first.clone(), yielding.clone()].concat();
    canvas.rule(RuleKind::RightOfWay { first, yielding }, lanelets, lines, Vec::new());
}

fn all_way_stop(canvas: &mut Canvas, arms: &[Arm]) {
    let lanes: Vec<&LaneEnd> = arms.iter().flat_map(|it| &it.arriving).collect();
    let lanelets: Vec<Id> = lanes.iter().map(|it| it.lanelet).collect();
    let lines = lanes.iter().map(|it| stop_line(canvas, it)).collect();
    canvas.rule(RuleKind::AllWayStop { lanelets: lanelets.clone() }, lanelets, lines, Vec::new());
}

/// The line across the end of a lane.
fn stop_line(canvas: &Canvas, lane: &LaneEnd) -> Vec<Point> {
    vec![canvas.at(lane.left), canvas.at(lane.right)]
}
