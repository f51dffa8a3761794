//! The estimated capacity of a map, in vehicles per hour.
//!
//! The demand grows, by the same factor everywhere, until the first part of the map is full: a lane, a light, a
//! junction, a place inside the map, or a town as a whole (the reserve capacity of a network: Wong and Yang, 1997).
//! From then on queues grow there, but more may still get through elsewhere: the capacity of the map is the largest
//! flow that does, as far as it can be estimated. The load of each part comes from the demand along the usual routes;
//! its capacity follows from the models of its drivers.

mod conflict;
mod delay;
mod growth;
mod lanes;
mod lights;
mod movement;
mod queues;
mod side_by_side;
mod stream;
mod tight;
mod town;
mod weaving;

use std::fmt;
use std::sync::LazyLock;

use laneweave_models::Style;
use laneweave_network::{ChainIndex, Id, Network, Position};
use laneweave_sim::{Assignment, Demand, InnerPlace, Navigator, Place, Thinning};

pub(crate) use growth::Growth;
pub(crate) use lights::with_traffic;
pub(crate) use queues::Queues;

use lights::Equivalents;

/// The estimated capacity of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Capacity {
    /// The estimated largest flow that gets through, which more demand no longer raises [veh/h].
    pub veh_h: f64,
    /// The demand from which on queues grow, because the first part is full [veh/h].
    pub queues_from_veh_h: f64,
    /// What is full first.
    pub bottleneck: Option<Bottleneck>,
}

/// The bottleneck: what is full first when the demand grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bottleneck {
    /// The lanes side by side at this lanelet.
    Lanes(Id),
    /// The light that drivers on this lanelet obey.
    Light {
        /// The light.
        light: Id,
        /// A lanelet before it.
        lanelet: Id,
    },
    /// The junction on the path of this lanelet.
    Junction(Id),
    /// The place inside the map along this lanelet.
    TripEnd(Id),
    /// The town core: all roads that form loops.
    Town,
}

/// The estimated capacity of a map, computed when somebody asks for it.
pub type Estimate = LazyLock<Capacity, Box<dyn FnOnce() -> Capacity + Send>>;

impl fmt::Display for Capacity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "estimated capacity of {:.0} veh/h", self.veh_h)?;
        self.bottleneck.map_or(Ok(()), |it| write!(f, " (bottleneck: {it})"))
    }
}

impl fmt::Display for Bottleneck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Bottleneck::Lanes(lanelet) => write!(f, "the road at lanelet {lanelet}"),
            Bottleneck::Light { light, lanelet } => write!(f, "light {light} at lanelet {lanelet}"),
            Bottleneck::Junction(lanelet) => write!(f, "the junction at lanelet {lanelet}"),
            Bottleneck::TripEnd(lanelet) => write!(f, "the trip end at lanelet {lanelet}"),
            Bottleneck::Town => write!(f, "the town as a whole"),
        }
    }
}

/// A part of the map with its load, as a share of its capacity.
#[derive(Clone, Debug, PartialEq)]
struct Load {
    share: f64,
    of: Bottleneck,
    /// Where vehicles drive that load it; empty for a town, which all load.
    at: Vec<Position>,
    /// The share of vehicles that would pass at these flows, and the number of the first places where they wait.
    passing: f64,
    waits: usize,
}

impl Load {
    /// That of a part before which all wait who load it.
    fn new(share: f64, of: Bottleneck, at: Vec<Position>) -> Load {
        Load { share, of, passing: (1.0 / share).min(1.0), waits: at.len(), at }
    }
}

/// The inputs: the roads of a map, the routes of the demand on them, and the queues of its drivers.
#[derive(Clone, Copy)]
struct Roads<'a> {
    network: &'a Network,
    assignment: &'a Assignment,
    queues: &'a Queues,
    equivalents: &'a Equivalents,
}

impl Roads<'_> {
    /// The lanelet's id at a station of a chain [m].
    fn lanelet(&self, chain: ChainIndex, station: f64) -> Id {
        self.network.lanelet_at(Position::new(chain, station)).0.id
    }

    fn chains(&self) -> impl Iterator<Item = ChainIndex> + use<> {
        (0..self.network.chains.len() as u32).map(ChainIndex)
    }
}

/// The largest curvature of a part of a chain [1/m], rounded so that there are few; 0 on a straight one.
fn curvature(network: &Network, chain: ChainIndex, [from, to]: [f64; 2]) -> f64 {
    /// Speeds at 1 m/s² are rounded to this [m/s].
    const STEP: f64 = 0.5;
    let bends = network.chain(chain).bends.iter().filter(|it| it.end > from && it.start <= to);
    let tightest = bends.map(|it| it.curvature).reduce(f64::max);
    let rounded = |it: f64| ((1.0 / it.sqrt() / STEP).round() * STEP).max(STEP);
    tightest.map_or(0.0, |it| rounded(it).powi(-2))
}

impl Capacity {
    /// The estimated capacity of `network` for a demand between two times [s], on the usual routes of `navigator`, with
    /// the mixture of `drivers`, each with its weight.
    ///
    /// The capacity of a lane is the flow from a long queue. That of lanes side by side comes from a simulation of
    /// such a road. That of a light is the part of a standing queue that passes at green; turns across oncoming traffic
    /// take gaps in it. Where paths meet without a light, drivers take turns and gaps. A town has the capacity of its
    /// perimeter control. Missing gaps for lane changes are not considered, and of queues that block others it is only
    /// known that they do.
    pub fn new(
        network: &Network,
        navigator: &Navigator,
        (demand, during): (&Demand, [f64; 2]),
        drivers: &[(Style, f64)],
    ) -> Capacity {
        let queues = Queues::new(drivers, demand.fleet, network.law);
        Capacity::of(network, navigator, (demand, during), &queues)
    }

    /// The same of drivers with these `queues`.
    pub(crate) fn of(
        network: &Network,
        navigator: &Navigator,
        (demand, during): (&Demand, [f64; 2]),
        queues: &Queues,
    ) -> Capacity {
        let assign = &|rates: &[f64], thinning: &Thinning| {
            Assignment::of_rates(network, navigator, demand, rates, thinning)
        };
        let inner_places = &inner_places(demand);
        Growth::new(network, assign, inner_places, queues).capacity(&demand.mean_rates(network, during))
    }
}

/// The places inside the map from which trips of `demand` start.
pub(crate) fn inner_places(demand: &Demand) -> Vec<InnerPlace> {
    let inner_place = |it: &Place| match it {
        Place::Inside(inner) => Some(*inner),
        Place::Gate(_) | Place::Across(_) => None,
    };
    demand.origins.iter().filter_map(|it| inner_place(&it.place)).collect()
}
