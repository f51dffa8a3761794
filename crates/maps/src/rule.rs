//! What orders traffic beside the lanelets themselves: lights, signs, and who goes first.

use laneweave_network::Point;

/// One regulatory element of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Its id in the map.
    pub id: i64,
    /// Line of the file in which it stands.
    pub line: Option<usize>,
    /// What it orders.
    pub kind: RuleKind,
    /// Ids of the lanelets that refer to it: whose drivers obey it.
    pub lanelets: Vec<i64>,
    /// Where they stop; without any, at the end of their lanelet.
    pub stop_lines: Vec<Vec<Point>>,
    /// Where the lights or signs are that show it.
    pub signs: Vec<Vec<Point>>,
}

/// What a rule orders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RuleKind {
    /// Obey the light.
    TrafficLight,
    /// Some lanelets go first.
    RightOfWay {
        /// Ids of the lanelets that go first.
        first: Vec<i64>,
        /// Ids of the lanelets that give way.
        yielding: Vec<i64>,
    },
    /// Everybody stops, and goes in the order of arrival.
    AllWayStop {
        /// Ids of the lanelets that lead there.
        lanelets: Vec<i64>,
    },
    /// Stop, then give way.
    StopSign,
    /// Let those on a crosswalk pass.
    Crosswalk {
        /// Ids of the lanelets that cross.
        lanelets: Vec<i64>,
    },
    /// A speed limit; the lanelets have it already.
    SpeedLimit,
    /// Something else, kept by its name and without effect.
    Other(String),
}

impl RuleKind {
    /// Its name in Lanelet2 maps, or that of what it is not known as.
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
