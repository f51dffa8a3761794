//! What stands in lanes, and how much room drivers keep before it.

use laneweave_network::{ChainIndex, Network, Side};

/// Something that stands in a lane, and does not go on by itself; or that crawls, and holds up everybody behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Standing {
    /// The lane.
    pub(crate) chain: ChainIndex,
    /// Its rear and its front [m].
    pub(crate) reach: [f64; 2],
    /// What it will do.
    pub(crate) does: Does,
}

/// What something that stands in a lane will do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Does {
    /// It stays until somebody takes it away.
    Stay,
    /// It goes on by itself when its time at a stop is over.
    Rest,
    /// It goes on slowly: nobody has to stop before it.
    Crawl,
}

impl Standing {
    /// Road that drivers keep behind it, to steer out of its lane [m] (ours).
    pub(super) const ROOM: f64 = 12.0;
    /// The longest road that drivers keep before it, where one lane beside it is open [m].
    pub(crate) const ROOM_BEFORE: f64 = Standing::ROOM + Standing::ROOM_FOR_A_LANE;
    /// A lane beside it is open if nothing stands there so far before its rear and beyond its front [m] (ours). Who has
    /// passed something in that lane can still steer to it, then.
    pub(super) const ROOM_BESIDE: f64 = 30.0;
    pub(super) const ROOM_BEYOND: f64 = 25.0;
    /// Road without a junction on which drivers can pass what crawls [m] (ours).
    pub(super) const PASSING: f64 = 200.0;
    /// The least of it on which a car can steer out [m] (ours).
    pub(super) const LEAST_ROOM: f64 = 5.0;
    /// More of it for each lane that is closed beside it, too [m] (ours).
    pub(super) const ROOM_FOR_A_LANE: f64 = 40.0;
    /// Drivers leave its lane so early at the most, where they may not change lanes farther on [m] (ours).
    const FAR: f64 = 200.0;
    /// From this distance on drivers see it [m] (ours).
    pub(super) const SEEN: f64 = 500.0;

    /// The last place behind it where drivers can change to a lane beside [m]: its rear, or the end of a stretch before
    /// what stays there.
    pub(super) fn way_out(&self, network: &Network) -> f64 {
        let (chain, rear) = (network.chain(self.chain), self.reach[0]);
        let ends = Side::BOTH.into_iter().flat_map(|side| chain.stretches(side));
        let ends = ends.filter(|it| it.start <= rear).map(|it| it.end.min(rear));
        let counts = |it: &f64| self.does == Does::Stay && rear - it < Standing::FAR;
        ends.reduce(f64::max).filter(counts).unwrap_or(rear)
    }

    /// The place up to which drivers come on a lane before its `way_out` [m], if the next open one is so many lanes
    /// away [m].
    pub(super) fn kept(way_out: f64, lanes: u32) -> f64 {
        let room = Standing::ROOM + Standing::ROOM_FOR_A_LANE * f64::from(lanes.saturating_sub(1));
        (way_out - room).max(0.0)
    }
}
