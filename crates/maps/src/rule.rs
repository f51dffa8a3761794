//! The rules of traffic beside the lanelets themselves: lights, signs, and priorities.

use laneweave_network::{Id, Point};

/// One regulatory element of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Its id in the map.
    pub id: Id,
    /// Line of the file in which it stands.
    pub line: Option<usize>,
    /// The kind of rule.
    pub kind: RuleKind,
    /// Ids of the lanelets that refer to it: their drivers obey it.
    pub lanelets: Vec<Id>,
    /// Stop lines; without any, drivers stop at the end of their lanelet.
    pub stop_lines: Vec<Vec<Point>>,
    /// Positions of the lights or signs that show it.
    pub signs: Vec<Vec<Point>>,
}

/// The kinds of rules.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RuleKind {
    /// Obey the light.
    TrafficLight,
    /// Some lanelets have priority.
    RightOfWay {
        /// Ids of the lanelets with priority.
        first: Vec<Id>,
        /// Ids of the lanelets that give way.
        yielding: Vec<Id>,
    },
    /// An all-way stop: every driver stops, and they go in the order of arrival.
    AllWayStop {
        /// Ids of the lanelets that lead there.
        lanelets: Vec<Id>,
    },
    /// Stop, then give way.
    StopSign,
    /// Drivers give way to people on a crosswalk.
    Crosswalk {
        /// Ids of the lanelets that cross.
        lanelets: Vec<Id>,
    },
    /// A speed limit; it is already in the lanelets.
    SpeedLimit,
    /// Another rule, stored with its name and without effect.
    Other(String),
}

impl RuleKind {
    /// Its name in Lanelet2 maps, or the name of an unknown one.
    pub fn name(&self) -> &str {
        match self {
            RuleKind::TrafficLight => "traffic_light",
            RuleKind::RightOfWay { .. } => "right_of_way",
            RuleKind::AllWayStop { .. } => "all_way_stop",
            RuleKind::StopSign => "stop_sign",
            RuleKind::Crosswalk { .. } => "crosswalk",
            RuleKind::SpeedLimit => "speed_limit",
            RuleKind::Other(name) => name,
        }
    }
}
