//! Waypoints: what a chain means on the route to a destination.

use laneweave_network::ChainIndex;
use serde::{Deserialize, Serialize};

use crate::route::disutility::Disutility;

/// What a chain means on the route to a destination.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waypoint {
    /// n: fewest lane changes from it to a lane that leads there; [`Waypoint::NO_WAY`] if no lane does.
    pub changes: u32,
    /// The chain from which the backward search reached it: the next chain, or the one to change to; itself at the
    /// destination.
    pub(super) via: ChainIndex,
    /// Last place for the next change, from the chain's start; beyond its end if on a later chain [m]; infinite if
    /// n is 0.
    pub last_place: f64,
    /// The chain to which a vehicle drives on over its end.
    pub next: Option<ChainIndex>,
    /// Travel time from its start to the destination [s].
    pub time: f64,
    /// T_alt: travel time from its start on the best other route over its end [s]; infinite if there is none.
    pub alternative: f64,
    /// Distance from its start to the destination [m].
    pub distance: f64,
    /// Where the trip ends on it [m]; infinite where the trip goes on to the chain's end.
    pub end: f64,
    /// Disutility of the route from its start.
    pub disutility: Disutility,
    /// Disutility of the alternative.
    pub alternative_disutility: Disutility,
}

impl Waypoint {
    /// The chains that it names.
    pub(crate) fn chains(&self) -> impl Iterator<Item = ChainIndex> {
        [Some(self.via), self.next].into_iter().flatten()
    }

    /// More changes than any road has lanes: there is no route.
    pub const NO_WAY: u32 = 1000;
    /// Cost of a lane change in the choice of a route [s].
    const CHANGE_COST: f64 = 20.0;

    pub(crate) const NOWHERE: Waypoint = Waypoint {
        changes: Waypoint::NO_WAY,
        via: ChainIndex(0),
        last_place: 0.0,
        next: None,
        time: f64::INFINITY,
        alternative: f64::INFINITY,
        distance: f64::INFINITY,
        end: f64::INFINITY,
        disutility: Disutility { turns: 0, lights: 0 },
        alternative_disutility: Disutility { turns: 0, lights: 0 },
    };

    /// Whether there is a route.
    #[inline]
    pub fn leads_there(&self) -> bool {
        self.changes < Waypoint::NO_WAY
    }

    /// Whether the destination can still be reached from `x` on the chain.
    #[inline]
    pub fn leads_on(&self, x: f64) -> bool {
        self.leads_there() && x <= self.last_place && x <= self.end
    }

    /// The next chain on the route, if there is one; itself at the destination.
    pub(crate) fn goes_on(&self) -> Option<ChainIndex> {
        self.leads_there().then_some(self.via)
    }

    /// The cost that the best route minimises [s].
    pub(crate) fn cost(&self) -> f64 {
        self.time + Waypoint::CHANGE_COST * f64::from(self.changes)
    }

    /// Whether both take the same route over the same chain.
    pub(crate) fn goes_like(&self, other: &Waypoint) -> bool {
        (self.changes, self.via, self.next) == (other.changes, other.via, other.next)
    }
}
