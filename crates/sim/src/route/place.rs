//! Places where trips start and end: gates at the edge of the map, and trip ends inside the map.

use laneweave_network::{ChainIndex, Class, Gate, Id, Network, Position};

/// Where trips start or end.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// Lanes at the edge of the map: vehicles enter at their starts while driving, and leave the map at their ends.
    Gate(Gate),
    /// A trip end inside the map: vehicles start there from rest, and are removed when they reach it.
    Inside(InnerPlace),
    /// A line across the lanes of a road inside the map.
    Across(CrossSection),
}

/// A line across lanes side by side, somewhere on the map: vehicles start there, or are removed when they reach it in
/// any of the lanes.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossSection {
    /// Its name.
    pub id: Id,
    /// Whether vehicles are driving when they start there, and not at rest.
    pub(crate) is_passed: bool,
    /// Its lanes.
    chains: Vec<ChainIndex>,
    /// Its station on each of them [m].
    stations: Vec<f64>,
    /// In order the chains over which trips lead that end there; `None`: trips lead over any roads.
    over: Option<Vec<ChainIndex>>,
}

impl CrossSection {
    /// A line across lanes, with a place on each of them. The rear bumpers of vehicles that start from rest are there.
    /// Trips end when front bumpers pass it.
    pub fn new(id: Id, lanes: &[Position]) -> CrossSection {
        let (chains, stations) = lanes.iter().map(|it| (it.chain, it.x)).unzip();
        CrossSection { id, is_passed: false, chains, stations, over: None }
    }

    /// The same, where vehicles start while they are driving.
    pub fn passed(self) -> CrossSection {
        CrossSection { is_passed: true, ..self }
    }

    /// The same, to which trips lead over these chains only, and over its own.
    pub fn reached_over(mut self, chains: impl IntoIterator<Item = ChainIndex>) -> CrossSection {
        let mut over: Vec<ChainIndex> = chains.into_iter().chain(self.chains.iter().copied()).collect();
        over.sort_unstable();
        over.dedup();
        self.over = Some(over);
        self
    }

    /// Its lanes, with its station on each.
    pub fn lanes(&self) -> impl Iterator<Item = Position> {
        self.chains.iter().zip(&self.stations).map(|(chain, x)| Position::new(*chain, *x))
    }

    /// Whether it is the same line, which trips reach over any roads.
    pub(crate) fn is_on_any_way(&self, other: &CrossSection) -> bool {
        other.over.is_none() && self.chains == other.chains && self.stations == other.stations
    }
}

/// A trip end inside the map: a place along a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerPlace {
    /// The id of its lanelet, which is its name.
    pub id: Id,
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
    pub fn id(&self) -> Id {
        match self {
            Place::Gate(gate) => gate.id,
            Place::Inside(inner) => inner.id,
            Place::Across(section) => section.id,
        }
    }

    /// Where trips end on `chain`, one of its lanes, if that is before the end of the chain [m].
    pub(crate) fn end_on(&self, chain: ChainIndex) -> Option<f64> {
        match self {
            Place::Gate(_) => None,
            Place::Inside(inner) => Some(inner.station),
            Place::Across(section) => section.lanes().find(|it| it.chain == chain).map(|it| it.x),
        }
    }

    /// Whether trips that end there may lead over `chain`.
    pub(crate) fn is_reached_over(&self, chain: ChainIndex) -> bool {
        match self {
            Place::Across(CrossSection { over: Some(over), .. }) => over.binary_search(&chain).is_ok(),
            _ => true,
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
            Place::Across(section) => &section.chains,
        }
    }
}
