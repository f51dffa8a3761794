//! Closed lanelets: where users closed lanes, and how drivers know of it. Routes stay as they are. A driver on a lane
//! that is closed ahead has a lane change to make before.

use std::borrow::Cow;

use laneweave_network::{ChainIndex, LaneletIndex, Network, Position, Side};

use crate::route::navigate::Navigator;
use crate::route::waypoint::Waypoint;
use crate::state::goal::Destination;

/// The lanelets that users closed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Closures {
    /// Sorted.
    closed: Vec<LaneletIndex>,
    /// For each chain the closed stretches [m], in order, and whether it leads to one soon. Empty if there is none.
    of_chain: Vec<(Vec<[f64; 2]>, bool)>,
}

impl Closures {
    /// Within this distance before a closed lanelet vehicles may have to brake for it [m].
    const BRAKING: f64 = 500.0;
    /// At these distances before a closed lanelet drivers can leave its lane [m]. Ours.
    const LOOKED_AT: [f64; 5] = [1.0, 25.0, 50.0, 75.0, 100.0];
    /// The lanes beside a closed lanelet are those this far after its start [m].
    const INTO: f64 = 1.0;

    /// These lanelets of `network` are closed.
    pub(crate) fn of(network: &Network, mut closed: Vec<LaneletIndex>) -> Closures {
        closed.sort_unstable();
        closed.dedup();
        if closed.is_empty() {
            return Closures::default();
        }
        let mut of_chain = vec![(Vec::new(), false); network.chains.len()];
        for lanelet in &closed {
            let start = network.start_of(*lanelet);
            let end = start.x + network.lanelets[lanelet.at()].length();
            of_chain[start.chain.at()].0.push([start.x, end]);
            let mut open = vec![(start.chain, start.x)];
            while let Some((chain, before)) = open.pop() {
                of_chain[chain.at()].1 = true;
                if before < Closures::BRAKING {
                    let previous = network.chain(chain).previous.iter();
                    open.extend(previous.map(|it| (*it, before + network.chain(*it).length)));
                }
            }
        }
        of_chain.iter_mut().for_each(|it| it.0.sort_by(|a, b| a[0].total_cmp(&b[0])));
        Closures { closed, of_chain }
    }

    /// The closed lanelets.
    pub(crate) fn closed(&self) -> &[LaneletIndex] {
        &self.closed
    }

    /// Whether no lanelet is closed.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.of_chain.is_empty()
    }

    /// Whether vehicles on `chain` may have to brake for a closed lanelet.
    #[inline]
    pub(crate) fn are_near(&self, chain: ChainIndex) -> bool {
        self.of_chain.get(chain.at()).is_some_and(|it| it.1)
    }

    /// The closed stretches of `chain` [m].
    fn on(&self, chain: ChainIndex) -> &[[f64; 2]] {
        self.of_chain.get(chain.at()).map_or(&[], |it| &it.0)
    }

    /// Whether `chain` is closed at `x` [m].
    #[inline(never)]
    pub(crate) fn cover(&self, chain: ChainIndex, x: f64) -> bool {
        self.on(chain).iter().any(|[from, to]| (*from..*to).contains(&x))
    }

    /// For each side the number of lanes to the next one that is open beside a closed lanelet that begins at `start`,
    /// and its chain.
    fn open_lanes<'a>(
        &'a self,
        network: &'a Network,
        start: Position,
    ) -> impl Iterator<Item = (u32, ChainIndex)> + 'a {
        let start = Position::new(start.chain, start.x + Closures::INTO);
        Side::BOTH.into_iter().filter_map(move |side| {
            let beside = |at: &Position| {
                let beside = network.chain(at.chain).beside(side, at.x)?;
                Some(Position::new(beside.chain, beside.across(at.x)))
            };
            let lanes = std::iter::successors(Some(start), beside).zip(0..);
            lanes.skip(1).find(|(at, _)| !self.cover(at.chain, at.x)).map(|(at, count)| (count, at.chain))
        })
    }

    /// Why drivers could not leave the lane of a closed `lanelet` before it, and what to do, if they could not.
    pub(crate) fn flaw(&self, network: &Network, lanelet: LaneletIndex) -> Option<&'static str> {
        let start = network.start_of(lanelet);
        let end = start.x + network.lanelets[lanelet.at()].length();
        let before: Option<Vec<Position>> =
            Closures::LOOKED_AT.iter().map(|it| back(network, start, *it)).collect();
        let Some(before) = before else {
            return Some("vehicles enter, or lanes join, shortly before it; choose a lanelet farther on");
        };
        let is_in_junction = |it: &Position| {
            let junctions = &network.junctions;
            let until = if it.chain == start.chain { end } else { network.chain(it.chain).length };
            let mut zones =
                junctions.on(it.chain).crossings.iter().map(|crossing| junctions.reach(*crossing));
            zones.any(|zone| zone.start < until && zone.end > it.x)
        };
        if before.iter().any(is_in_junction) {
            return Some("a junction is in it or shortly before it; choose a lanelet farther from junctions");
        }
        let can_leave = |it: &Position| {
            Side::BOTH.into_iter().any(|side| network.chain(it.chain).beside(side, it.x).is_some())
        };
        let has_open_lane = self.open_lanes(network, start).next().is_some();
        (!has_open_lane || !before.iter().all(can_leave))
            .then_some("drivers could not change to an open lane before it; leave a lane beside it open")
    }
}

impl Navigator {
    /// A closed lanelet is signed this far ahead [m], ours.
    pub(crate) const SIGNED: f64 = 2000.0;

    /// The closed lanelets.
    #[inline]
    pub(crate) fn closures(&self) -> &Closures {
        &self.closures
    }

    /// Replaces the closed lanelets.
    pub(crate) fn close(&mut self, closures: Closures) {
        self.closures = closures;
    }

    /// Distance to the next closed lanelet on the route from `x` on `chain` to `destination`, within `reach` [m], and
    /// where it starts. A vehicle on closed lanelets drives off them.
    pub(crate) fn closure_ahead(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
        reach: f64,
    ) -> Option<(f64, Position)> {
        /// Lanelets this near to each other are joined [m].
        const JOINED: f64 = 0.1;
        if self.closures.is_empty() {
            return None;
        }
        let mut closed_until = f64::NEG_INFINITY;
        for leg in self.walk(network, destination, chain, -x).within(reach) {
            for [from, to] in self.closures.on(leg.chain) {
                let [ahead, end] = [from, to].map(|it| leg.start + it);
                if ahead < 0.0 || ahead - closed_until < JOINED {
                    closed_until = if end > 0.0 { end } else { closed_until };
                } else {
                    return (ahead <= reach).then_some((ahead, Position::new(leg.chain, *from)));
                }
            }
        }
        None
    }

    /// The `waypoint` of `chain` from `x` on. Where its lane is closed ahead, the driver has to leave it before.
    #[inline(never)]
    pub(crate) fn around_closures<'a>(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
        waypoint: Cow<'a, Waypoint>,
    ) -> Cow<'a, Waypoint> {
        if self.closures.is_empty() {
            return waypoint;
        }
        let Some((ahead, at)) = self.closure_ahead(network, destination, chain, x, Navigator::SIGNED) else {
            return waypoint;
        };
        let last_place = x + ahead;
        if waypoint.last_place <= last_place || waypoint.end <= last_place {
            return waypoint;
        }
        let changes_from = |(lanes, chain): (u32, ChainIndex)| {
            let there = self.waypoint(destination, chain);
            lanes + if there.leads_there() { there.changes } else { waypoint.changes }
        };
        let changes = self.closures.open_lanes(network, at).map(changes_from).min().unwrap_or(1);
        Cow::Owned(Waypoint { changes, last_place, ..waypoint.into_owned() })
    }
}

/// The place `distance` [m] before `at`, on its chain or on the only one before it.
fn back(network: &Network, at: Position, distance: f64) -> Option<Position> {
    let x = at.x - distance;
    if x >= 0.0 {
        return Some(Position::new(at.chain, x));
    }
    let [before] = network.chain(at.chain).previous[..] else { return None };
    let x = network.chain(before).length + x;
    (x >= 0.0).then_some(Position::new(before, x))
}
