//! Which lanes lead where: for every destination and chain the lane changes still to make, the last place for the
//! next of them, and the way on.

use laneweave_network::{Chain, ChainIndex, Gate, Network, Side};

/// A driver's exit, as a place in [`Network::exits`]; `None`: it drives on as the road leads.
pub type Destination = Option<u16>;

/// A destination in two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Goal(u16);

impl Goal {
    const NONE: u16 = u16::MAX;

    /// The destination.
    #[inline]
    pub fn destination(self) -> Destination {
        (self.0 != Goal::NONE).then_some(self.0)
    }
}

impl From<Destination> for Goal {
    fn from(destination: Destination) -> Goal {
        Goal(destination.unwrap_or(Goal::NONE))
    }
}

/// What a chain means on the way to a destination.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// n: fewest lane changes from it to a lane that leads there; [`Waypoint::NO_WAY`] if none does.
    pub changes: u32,
    /// Last place for the next of them, from the chain's start, beyond its end if on a later one [m]; infinite for
    /// n = 0.
    pub last_place: f64,
    /// The chain that it goes on with.
    pub next: Option<ChainIndex>,
    /// Free travel time from its start to the destination [s].
    pub time: f64,
}

impl Waypoint {
    /// More changes than any road has lanes: there is no way.
    pub const NO_WAY: u32 = 1000;

    const NOWHERE: Waypoint =
        Waypoint { changes: Waypoint::NO_WAY, last_place: 0.0, next: None, time: f64::INFINITY };

    /// The destination can still be reached from `x` on the chain.
    #[inline]
    pub fn leads_on(&self, x: f64) -> bool {
        self.changes < Waypoint::NO_WAY && x <= self.last_place
    }

    fn cost(&self) -> f64 {
        self.time + Navigator::CHANGE_COST * f64::from(self.changes)
    }
}

/// The waypoints of all destinations.
#[derive(Clone, Debug)]
pub struct Navigator {
    /// For each exit the waypoints by chain; last, those of drivers without a destination.
    tables: Vec<Vec<Waypoint>>,
}

impl Navigator {
    /// What a lane change counts for in the choice of a route [s].
    const CHANGE_COST: f64 = 20.0;
    /// Road that is kept for each further change before the last place [m].
    const ROOM_FOR_A_CHANGE: f64 = 40.0;
    /// Costs closer than this are the same [s].
    const SAME: f64 = 1e-6;

    /// Plans all routes of `network`.
    pub fn new(network: &Network) -> Navigator {
        let mut tables: Vec<_> = network.exits.iter().map(|exit| plan(network, exit)).collect();
        tables.push(wander(network));
        Navigator { tables }
    }

    /// The waypoint of `chain` on the way to `destination`.
    #[inline]
    pub fn waypoint(&self, destination: Destination, chain: ChainIndex) -> &Waypoint {
        let table = destination.map_or(self.tables.len() - 1, usize::from);
        &self.tables[table][chain.at()]
    }

    /// The destinations that can be reached from `x` on `chain`, with their free travel times [s].
    pub fn reachable(&self, chain: ChainIndex, x: f64) -> impl Iterator<Item = (Destination, f64)> {
        let exits = &self.tables[..self.tables.len() - 1];
        exits.iter().zip(0u16..).filter_map(move |(table, exit)| {
            let waypoint = &table[chain.at()];
            waypoint.leads_on(x).then_some((Some(exit), waypoint.time))
        })
    }

    /// The reachable destination of least time; of none, to wander.
    pub fn nearest(&self, chain: ChainIndex, x: f64) -> Destination {
        self.reachable(chain, x).min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(destination, _)| destination)
    }
}

fn free_time(chain: &Chain) -> f64 {
    let ends = chain.limits.iter().skip(1).map(|it| it.start).chain([chain.length]);
    chain.limits.iter().zip(ends).map(|(limit, end)| (end - limit.start) / limit.speed).sum()
}

/// Best waypoints towards `exit`, spread backwards from it until none improves.
fn plan(network: &Network, exit: &Gate) -> Vec<Waypoint> {
    let chains = &network.chains;
    let mut table = vec![Waypoint::NOWHERE; chains.len()];
    let into = beside_into(network);
    let mut open: Vec<ChainIndex> = Vec::new();
    for chain in &exit.chains {
        let time = free_time(network.chain(*chain));
        table[chain.at()] = Waypoint { changes: 0, last_place: f64::INFINITY, next: None, time };
        open.push(*chain);
    }
    while let Some(index) = open.pop() {
        let here = table[index.at()];
        let mut offer = |to: ChainIndex, waypoint: Waypoint| {
            let old = &table[to.at()];
            let (new_cost, old_cost) = (waypoint.cost(), old.cost());
            let cheaper = new_cost < old_cost - Navigator::SAME;
            let later = new_cost < old_cost + Navigator::SAME && waypoint.last_place > old.last_place;
            if cheaper || later {
                table[to.at()] = waypoint;
                open.push(to);
            }
        };
        for back in &chains[index.at()].previous {
            let chain = network.chain(*back);
            let last_place = chain.length + here.last_place;
            let time = free_time(chain) + here.time;
            offer(*back, Waypoint { changes: here.changes, last_place, next: Some(index), time });
        }
        for (from, side, number) in &into[index.at()] {
            let chain = network.chain(*from);
            let stretch = &chain.stretches(*side)[*number];
            let until = here.last_place - Navigator::ROOM_FOR_A_CHANGE;
            let last_place =
                if until.is_finite() { stretch.end.min(stretch.back(until)) } else { stretch.end };
            if last_place > stretch.start {
                let time = here.time - stretch.across(0.0) / chains[index.at()].limit(0.0);
                let next = chain.following.first().copied();
                offer(*from, Waypoint { changes: here.changes + 1, last_place, next, time });
            }
        }
    }
    for index in 0..chains.len() {
        if table[index].changes > 0 {
            let best = chains[index]
                .following
                .iter()
                .min_by(|a, b| table[a.at()].cost().total_cmp(&table[b.at()].cost()));
            table[index].next = best.copied();
        }
    }
    table
}

/// For each chain the stretches from which a change leads into it: chain, side and number.
fn beside_into(network: &Network) -> Vec<Vec<(ChainIndex, Side, usize)>> {
    let mut into = vec![Vec::new(); network.chains.len()];
    for (index, chain) in network.chains.iter().enumerate() {
        for side in Side::BOTH {
            for (number, stretch) in chain.stretches(side).iter().enumerate() {
                into[stretch.chain.at()].push((ChainIndex(index as u32), side, number));
            }
        }
    }
    into
}

/// For drivers without a destination: on along the first following chain; out of lanes that end.
fn wander(network: &Network) -> Vec<Waypoint> {
    let on = |chain: &Chain| {
        let last_place = f64::INFINITY;
        Waypoint { changes: 0, last_place, next: chain.following.first().copied(), time: 0.0 }
    };
    let mut table: Vec<Waypoint> = network.chains.iter().map(on).collect();
    for index in &network.lane_drops {
        let chain = network.chain(*index);
        let ends = |side: Side| chain.stretches(side).last().map(|it| it.end);
        let last_place = Side::BOTH.into_iter().filter_map(ends).reduce(f64::max).unwrap_or(chain.length);
        table[index.at()] = Waypoint { changes: 1, last_place, next: None, time: 0.0 };
    }
    table
}
