//! Places where trips start and end: gates at the edge of the map, and trip ends inside the map.

use laneweave_network::{ChainIndex, Class, Gate, Network};

/// Where trips start or end.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Lanes at the edge of the map: vehicles enter at their starts while driving, and leave the map at their ends.
    Gate(Gate),
    /// A trip end inside the map: vehicles start there from rest, and are removed when they reach it.
    Inside(InnerPlace),
}

/// A trip end inside the map: a place along a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerPlace {
    /// The id of its lanelet, which is its name.
    pub id: i64,
    /// Its chain.
    pub chain: ChainIndex,
    /// Its station on the chain [m]. The rear bumper of a vehicle that starts is here. A trip ends when the front
    /// bumper passes it.
    pub station: f64,
}

impl InnerPlace {
    /// Trips start and end only on lanelets of at least this length [m].
    pub const SHORTEST_LANELET: f64 = 20.0;
    /// Share of its lanelet that lies before a trip end inside the map. On the shortest lanelet, 12 m lie beyond it:
    /// the length of the longest vehicle. So a vehicle that starts stands on the lanelet, and a vehicle that has left
    /// the lanelet does not reach back to the trip end.
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

    /// Its lanes that cars may use.
    pub fn for_cars(&self, network: &Network) -> impl Iterator<Item = ChainIndex> {
        let chains = self.chains().iter().copied();
        chains.filter(|it| network.chain(*it).classes.has(Class::Car))
    }

    /// The number of its lanes that cars may use.
    pub fn lanes(&self, network: &Network) -> usize {
        self.for_cars(network).count()
    }

    /// Its lanes.
    pub fn chains(&self) -> &[ChainIndex] {
        match self {
            Place::Gate(gate) => &gate.chains,
            Place::Inside(inner) => std::slice::from_ref(&inner.chain),
        }
    }
}
