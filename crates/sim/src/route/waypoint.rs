//! What a chain means on the way to a destination.

use laneweave_network::ChainIndex;
use serde::{Deserialize, Serialize};

use crate::route::disutility::Disutility;

/// What a chain means on the way to a destination.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Waypoint {
    /// n: fewest lane changes from it to a lane that leads there; [`Waypoint::NO_WAY`] if none does.
    pub changes: u32,
    /// The chain from which on the way was planned: the next one, or the one to change to; itself at the destination.
    pub(super) via: ChainIndex,
    /// Last place for the next change, from the chain's start, beyond its end if on a later one [m]; infinite for
    /// n = 0.
    pub last_place: f64,
    /// The chain that it goes on with.
    pub next: Option<ChainIndex>,
    /// Travel time from its start to the destination [s].
    pub time: f64,
    /// T_alt: travel time from its start of the best way over its end that is not this one [s]; infinite if there is
    /// none.
    pub alternative: f64,
    /// Way from its start to the destination [m].
    pub distance: f64,
    /// Where on it the trip ends [m]; infinite where it goes on to the chain's end.
    pub end: f64,
    /// What the way from its start asks for.
    pub disutility: Disutility,
    /// What the alternative asks for.
    pub alternative_effort: Disutility,
}

impl Waypoint {
    /// The chains that it names.
    pub(crate) fn chains(&self) -> impl Iterator<Item = ChainIndex> {
        [Some(self.via), self.next].into_iter().flatten()
    }

    /// More changes than any road has lanes: there is no way.
    pub const NO_WAY: u32 = 1000;
    /// What a lane change counts for in the choice of a route [s].
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
        alternative_effort: Disutility { turns: 0, lights: 0 },
    };

    /// There is a way.
    #[inline]
    pub fn leads_there(&self) -> bool {
        self.changes < Waypoint::NO_WAY
    }

    /// The destination can still be reached from `x` on the chain.
    #[inline]
    pub fn leads_on(&self, x: f64) -> bool {
        self.leads_there() && x <= self.last_place && x <= self.end
    }

    /// The chain that comes next on the way, if there is one: itself at the destination.
    pub(crate) fn goes_on(&self) -> Option<ChainIndex> {
        self.leads_there().then_some(self.via)
    }

    /// What is least on the best way [s].
    pub(crate) fn cost(&self) -> f64 {
        self.time + Waypoint::CHANGE_COST * f64::from(self.changes)
    }

    /// Both lead the same way over the same chain.
    pub(crate) fn goes_like(&self, other: &Waypoint) -> bool {
        (self.changes, self.via, self.next) == (other.changes, other.via, other.next)
    }
}
