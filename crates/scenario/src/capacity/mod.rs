//! The estimated capacity of a map, in vehicles per hour.
//!
//! The demand grows, by the same factor everywhere, until the first part of the map is full: a lane, a light, a
//! junction, a place inside the map, or a town as a whole (the reserve capacity of a network: Wong and Yang, 1997).
//! Where a scenario gives no demand, each origin grows until a part that its drivers pass is full.
//! The load of each part comes from the demand along the usual routes; its capacity follows from the models of its
//! drivers.

mod conflict;
mod delay;
mod filling;
mod lanes;
mod lights;
mod movement;
mod queues;
mod side_by_side;
mod stream;
mod town;
mod weaving;

use std::fmt;
use std::sync::LazyLock;

use laneweave_models::Style;
use laneweave_network::{ChainIndex, Network, Position};
use laneweave_sim::{Assignment, Demand, InnerPlace, Place};
use laneweave_study::units::SECONDS_PER_HOUR;

pub(crate) use filling::Filling;
pub(crate) use lights::with_traffic;
pub(crate) use queues::Queues;

use lights::Equivalents;

/// The estimated capacity of a map: the demand at which its first part is full.
#[derive(Clone, Debug, PartialEq)]
pub struct Capacity {
    /// Of all origins together [veh/h].
    pub veh_h: f64,
    /// What is full at this demand.
    pub bottleneck: Option<Bottleneck>,
}

/// The bottleneck: what is full first when the demand grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bottleneck {
    /// The lanes side by side at this lanelet.
    Lanes(i64),
    /// The light that drivers on this lanelet obey.
    Light {
        /// The light.
        light: i64,
        /// A lanelet before it.
        lanelet: i64,
    },
    /// The junction on the path of this lanelet.
    Junction(i64),
    /// The place inside the map along this lanelet.
    TripEnd(i64),
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
    fn lanelet(&self, chain: ChainIndex, station: f64) -> i64 {
        self.network.lanelet_at(Position::new(chain, station)).0.id
    }

    /// The largest curvature of a part of a chain [1/m], rounded so that there are few; 0 on a straight one.
    fn curvature(&self, chain: ChainIndex, [from, to]: [f64; 2]) -> f64 {
        /// Speeds at 1 m/s² are rounded to this [m/s].
        const STEP: f64 = 0.5;
        let bends = self.network.chain(chain).bends.iter().filter(|it| it.end > from && it.start <= to);
        let tightest = bends.map(|it| it.curvature).reduce(f64::max);
        let rounded = |it: f64| ((1.0 / it.sqrt() / STEP).round() * STEP).max(STEP);
        tightest.map_or(0.0, |it| rounded(it).powi(-2))
    }

    fn chains(&self) -> impl Iterator<Item = ChainIndex> + use<> {
        (0..self.network.chains.len() as u32).map(ChainIndex)
    }
}

impl Capacity {
    /// The estimated capacity of `network` for the demand of `assignment`, from the origins of `demand`, with the
    /// mixture of `drivers`, each with its weight.
    ///
    /// The capacity of a lane is the flow from a long queue. That of lanes side by side comes from a simulation of
    /// such a road. That of a light is the part of a standing queue that passes at green; turns across oncoming traffic
    /// take gaps in it. Where paths meet without a light, drivers take turns and gaps. A town has the capacity of its
    /// perimeter control. Effects that are not considered can only lower the capacity: missing gaps for lane changes,
    /// queues that block each other.
    pub fn new(
        network: &Network,
        assignment: &Assignment,
        demand: &Demand,
        drivers: &[(Style, f64)],
    ) -> Capacity {
        let queues = Queues::new(drivers, demand.fleet, network.law);
        Capacity::of(network, assignment, &inner_places(demand), &queues)
    }

    /// The same of drivers with these `queues` who start at `inner_places`, too.
    pub(crate) fn of(
        network: &Network,
        assignment: &Assignment,
        inner_places: &[InnerPlace],
        queues: &Queues,
    ) -> Capacity {
        match fullest(network, assignment, inner_places, queues) {
            Some(Load { share, of, .. }) => {
                Capacity { veh_h: assignment.total / share * SECONDS_PER_HOUR, bottleneck: Some(of) }
            }
            None => Capacity { veh_h: 0.0, bottleneck: None },
        }
    }
}

/// The part of the map that is full first when the flows of `assignment` grow, if anybody drives.
fn fullest(
    network: &Network,
    assignment: &Assignment,
    inner_places: &[InnerPlace],
    queues: &Queues,
) -> Option<Load> {
    let equivalents = lights::equivalents(network, assignment, queues);
    let roads = Roads { network, assignment, queues, equivalents: &equivalents };
    let movements = movement::movements(&roads);
    let parts = lanes::loads(&roads)
        .into_iter()
        .chain(conflict::loads(&roads, &movements))
        .chain(town::inner_place_loads(&roads, inner_places));
    // Of parts with equal loads the first counts, however their numbers are rounded.
    let is_fuller = |it: &Load, than: &Load| it.share > than.share * (1.0 + 1e-9);
    let fullest = parts.reduce(|fullest, it| if is_fuller(&it, &fullest) { it } else { fullest });
    let part = fullest.filter(|it| it.share > 0.0)?;
    Some(town::load(&roads, &movements, 1.0 / part.share).unwrap_or(part))
}

/// The places inside the map from which trips of `demand` start.
pub(crate) fn inner_places(demand: &Demand) -> Vec<InnerPlace> {
    let inner_place = |it: &Place| match it {
        Place::Inside(inner) => Some(*inner),
        Place::Gate(_) => None,
    };
    demand.origins.iter().filter_map(|it| inner_place(&it.place)).collect()
}
