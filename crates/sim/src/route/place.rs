//! Places at which trips start and end: gates at the edge of the map, and places along its lanes.

use laneweave_network::{ChainIndex, Gate};

/// Where trips start or end.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Lanes at the edge of the map: vehicles come driving at their starts, and leave at their ends.
    Gate(Gate),
    /// A place along a lane: vehicles start there from rest, and are gone when they reach it.
    Inside(InnerPlace),
}

/// A place along a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerPlace {
    /// Its lanelet's id: its name.
    pub id: i64,
    /// Its chain.
    pub chain: ChainIndex,
    /// Where on it the rear bumper of a vehicle that starts is, and where a trip ends: when the front bumper passes
    /// [m].
    pub station: f64,
}

impl InnerPlace {
    /// Trips start and end on lanelets of this length or more [m].
    pub const SHORTEST_LANELET: f64 = 20.0;
    /// Share of its lanelet that lies before a place inside the map. Of the shortest lanelet 12 m, the longest vehicle,
    /// lie behind it: who starts stands on the lanelet, and who has driven off the lanelet does not reach back to the
    /// place inside the map.
    pub(crate) const SHARE_BEFORE: f64 = 0.4;
}

impl Place {
    /// Its name in input and output: the smallest id of its lanelets.
    pub fn id(&self) -> i64 {
        match self {
            Place::Gate(gate) => gate.id,
            Place::Inside(inner) => inner.id,
        }
    }

    /// Its lanes.
    pub fn chains(&self) -> &[ChainIndex] {
        match self {
            Place::Gate(gate) => &gate.chains,
            Place::Inside(inner) => std::slice::from_ref(&inner.chain),
        }
    }
}
