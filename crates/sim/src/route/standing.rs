//! What stands in lanes, and how much room drivers keep before it.

use laneweave_network::ChainIndex;

/// Something that stands in a lane, and does not go on by itself; or that crawls, and holds up everybody behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Standing {
    /// The lane.
    pub(crate) chain: ChainIndex,
    /// Its rear and its front [m].
    pub(crate) reach: [f64; 2],
    /// It crawls.
    pub(crate) crawls: bool,
}

impl Standing {
    /// Road that drivers keep behind it, to steer out of its lane [m] (ours).
    pub(super) const ROOM: f64 = 12.0;
    /// A lane beside it is open if nothing stands there so far before its rear and beyond its front [m] (ours).
    pub(crate) const ROOM_BEFORE: f64 = Standing::ROOM + Standing::ROOM_FOR_A_LANE;
    pub(super) const ROOM_BEYOND: f64 = 25.0;
    /// Road without a junction on which drivers can pass what crawls [m] (ours).
    pub(super) const PASSING: f64 = 200.0;
    /// The least of it on which a car can steer out [m] (ours).
    pub(super) const LEAST_ROOM: f64 = 5.0;
    /// More of it for each lane that is closed beside it, too [m] (ours).
    pub(super) const ROOM_FOR_A_LANE: f64 = 40.0;
    /// From this distance on drivers see it [m] (ours).
    pub(super) const SEEN: f64 = 500.0;

    /// The place up to which drivers come on its lane, if the next open one is so many lanes away [m].
    pub(super) fn kept(&self, lanes: u32) -> f64 {
        let room = Standing::ROOM + Standing::ROOM_FOR_A_LANE * f64::from(lanes.saturating_sub(1));
        (self.reach[0] - room).max(0.0)
    }
}
