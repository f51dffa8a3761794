//! The rules for traffic on the lanelets of a network.

use crate::id::Id;
use std::collections::BTreeMap;

use super::light::Program;
use crate::geometry::Point;
use crate::lanelet::LaneletIndex;

/// The rules for traffic on the lanelets of a network, beside their links.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regulations {
    /// Lights and signs at which drivers stop.
    pub stops: Vec<StopRule>,
    /// Priorities.
    pub priorities: Vec<Priority>,
    /// Programs of lights, by the smallest id of the rules of each.
    pub programs: BTreeMap<Id, Program>,
}

/// A light or sign at which the drivers on some lanelets stop.
#[derive(Clone, Debug, PartialEq)]
pub struct StopRule {
    /// Its id in the map.
    pub id: Id,
    /// What it is.
    pub kind: StopKind,
    /// The lanelets whose drivers obey it.
    pub lanelets: Vec<LaneletIndex>,
    /// Stop lines; on a lanelet that none of the lines crosses, drivers stop at its end.
    pub lines: Vec<Vec<Point>>,
}

/// What drivers stop at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopKind {
    /// A traffic light, if it shows red.
    Light,
    /// A stop sign: every driver stops, and then gives way.
    StopSign,
    /// An all-way stop: every driver stops, and then they go in the order of arrival.
    AllWayStop,
    /// A line at which they wait if they have to.
    Line,
}

/// Some lanelets have priority over others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Priority {
    /// Those with priority.
    pub first: Vec<LaneletIndex>,
    /// Those that give way.
    pub yielding: Vec<LaneletIndex>,
}
