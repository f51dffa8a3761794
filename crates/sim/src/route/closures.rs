//! Closed lanes: where users closed lanelets, and where something stands in a lane, such as a vehicle that has broken
//! down, and how drivers know of it. Routes stay as they are. A driver on a lane that is closed ahead has a lane change
//! to make before. What nobody can go round closes no lane: the queue behind it waits.

use std::borrow::Cow;

use laneweave_network::{ChainIndex, Class, LaneletIndex, Network, Position, Side};

use crate::route::navigate::Navigator;
use crate::route::open_lanes::{OpenLanes, back, beside, lanes_left_by, next_lane, overlap};
use crate::route::standing::{Does, Standing};
use crate::route::waypoint::Waypoint;
use crate::state::goal::Destination;

/// The lanelets that users closed, and what stands in lanes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Closures {
    /// Sorted.
    closed: Vec<LaneletIndex>,
    standing: Vec<Standing>,
    /// Whether drivers can go round each of them.
    passable: Vec<bool>,
    /// For each chain the closed stretches, in order, and whether it leads to one soon. Empty if there is none.
    of_chain: Vec<(Vec<Stretch>, bool)>,
}

/// A closed stretch of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    /// Where it begins and ends [m].
    reach: [f64; 2],
    /// Who is on it up to here still leaves the lane before what closes it [m].
    leaves_until: f64,
    /// From this distance on drivers know of it [m].
    known_from: f64,
    /// What that does which closes it.
    does: Does,
    /// The lanes beside it that are open.
    open: OpenLanes,
}

impl Stretch {
    /// Whether a vehicle rests there shortly before `stop`, or beyond it [m]. The next one to the same stop waits.
    fn is_waited_for(&self, stop: f64) -> bool {
        /// So far behind it, somebody who has gone round it is back in its lane [m] (ours).
        const BACK: f64 = 60.0;
        self.does == Does::Rest && stop < self.reach[1] + BACK
    }
}

/// The next closed stretch ahead of a vehicle.
pub(crate) struct ClosureAhead {
    /// Distance up to which it comes along its lane [m].
    pub(crate) ahead: f64,
    /// Distance to the last place where it can be on its way out of the lane [m].
    pub(crate) way_out: f64,
    /// What closes it crawls on: nobody has to stop before it.
    pub(crate) crawls: bool,
    open: OpenLanes,
}

impl Closures {
    /// Within this distance before a closed lanelet vehicles may have to brake for it [m].
    const BRAKING: f64 = 500.0;
    /// At these distances before a closed lanelet drivers can leave its lane [m]. Ours.
    const LOOKED_AT: [f64; 5] = [1.0, 25.0, 50.0, 75.0, 100.0];
    /// The lanes beside a closed lanelet are those this far after its start [m].
    const INTO: f64 = 1.0;

    /// These lanelets of `network` are closed, and this stands in its lanes.
    pub(crate) fn of(network: &Network, mut closed: Vec<LaneletIndex>, standing: Vec<Standing>) -> Closures {
        closed.sort_unstable();
        closed.dedup();
        if closed.is_empty() && standing.is_empty() {
            return Closures::default();
        }
        let of_chain = vec![(Vec::new(), false); network.chains.len()];
        let mut closures = Closures { closed, standing, passable: Vec::new(), of_chain };
        for at in 0..closures.closed.len() {
            let lanelet = closures.closed[at];
            let Position { chain, x } = network.start_of(lanelet);
            let reach = [x, x + network.lanelets[lanelet.at()].length()];
            let known_from = Navigator::SIGNED;
            closures.add(
                network,
                chain,
                Stretch { reach, leaves_until: x, known_from, does: Does::Stay, open: [None; 2] },
            );
        }
        let lanelets = closures.clone();
        for (number, (stretches, _)) in closures.of_chain.iter_mut().enumerate() {
            for it in stretches {
                it.open = lanelets.open_lanes(network, Position::new(ChainIndex(number as u32), it.reach[0]));
            }
        }
        for at in 0..closures.standing.len() {
            let it = closures.standing[at];
            let way_out = it.way_out(network);
            let open = lanelets.lanes_round(network, &it, way_out, &closures.standing);
            closures.passable.push(open != [None; 2]);
            if let Some(lanes) = open.iter().flatten().map(|it| it.0).min() {
                let (front, known_from) = (it.reach[1], Standing::SEEN);
                let way_out = lanes_left_by(network, &it, way_out, &open, &closures.standing);
                let reach = [Standing::kept(way_out, lanes), front];
                let leaves_until = way_out - Standing::LEAST_ROOM;
                let stretch = Stretch { reach, leaves_until, known_from, does: it.does, open };
                closures.add(network, it.chain, stretch);
            }
        }
        let order = |a: &Stretch, b: &Stretch| a.reach[0].total_cmp(&b.reach[0]);
        closures.of_chain.iter_mut().for_each(|it| it.0.sort_by(order));
        closures
    }

    /// Adds a closed stretch of a chain.
    fn add(&mut self, network: &Network, chain: ChainIndex, stretch: Stretch) {
        self.of_chain[chain.at()].0.push(stretch);
        let mut open = vec![(chain, stretch.reach[0])];
        while let Some((chain, before)) = open.pop() {
            self.of_chain[chain.at()].1 = true;
            if before < Closures::BRAKING {
                let previous = network.chain(chain).previous.iter();
                open.extend(previous.map(|it| (*it, before + network.chain(*it).length)));
            }
        }
    }

    /// The open lanes beside the `way_out` before something that stands in a lane, where all this is `standing`; none
    /// where drivers cannot go round it, or would wait for a gap in a junction.
    fn lanes_round(
        &self,
        network: &Network,
        it: &Standing,
        way_out: f64,
        standing: &[Standing],
    ) -> OpenLanes {
        let (chain, [rear, front]) = (it.chain, [way_out, it.reach[1]].map(|x| x.max(0.0)));
        let is_free = |at: &Position| {
            let reach = beside(*at, front - rear);
            let stands_there = |it: &Standing| it.chain == at.chain && overlap(it.reach, reach);
            let is_closed = self.on(at.chain).iter().any(|it| overlap(it.reach, reach));
            !is_closed && !standing.iter().any(stands_there)
        };
        let (junctions, here) = (&network.junctions, network.chain(chain));
        let crawls = it.does == Does::Crawl;
        let passing = if crawls { Standing::PASSING } else { 0.0 };
        if crawls && front + passing > here.length && here.following.len() != 1 {
            return [None; 2];
        }
        let waits = [rear - Standing::ROOM_BEFORE, rear + passing];
        let mut zones = junctions.on(chain).crossings.iter().map(|it| junctions.reach(*it));
        if zones.any(|it| overlap([it.start, it.end], waits)) {
            return [None; 2];
        }
        // Where several lanes join before, the place on its own lane counts.
        let before = back(network, Position::new(chain, rear), Closures::LOOKED_AT[1])
            .unwrap_or(Position::new(chain, (rear - Closures::LOOKED_AT[1]).max(0.0)));
        Side::BOTH.map(|side| {
            network.chain(before.chain).beside(side, before.x)?;
            next_lane(network, Position::new(chain, rear), side, is_free)
        })
    }

    /// What stands in lanes.
    pub(crate) fn standing(&self) -> &[Standing] {
        &self.standing
    }

    /// The closed lanelets.
    pub(crate) fn closed(&self) -> &[LaneletIndex] {
        &self.closed
    }

    /// Whether no lanelet is closed, and nothing stands in a lane.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.of_chain.is_empty()
    }

    /// Whether vehicles on `chain` may have to brake for a closed stretch.
    #[inline]
    pub(crate) fn are_near(&self, chain: ChainIndex) -> bool {
        self.of_chain.get(chain.at()).is_some_and(|it| it.1)
    }

    /// The closed stretches of `chain`.
    fn on(&self, chain: ChainIndex) -> &[Stretch] {
        self.of_chain.get(chain.at()).map_or(&[], |it| &it.0)
    }

    /// Whether `chain` is closed at `x` [m].
    #[inline(never)]
    pub(crate) fn cover(&self, chain: ChainIndex, x: f64) -> bool {
        self.on(chain).iter().any(|it| (it.reach[0]..it.reach[1]).contains(&x))
    }

    /// Whether something stands with its front at this place, and drivers can go round it.
    pub(crate) fn can_be_passed(&self, front: Position) -> bool {
        let is_there = |it: &Standing| it.chain == front.chain && it.reach[1] == front.x;
        self.standing.iter().zip(&self.passable).any(|(it, is_passable)| is_there(it) && *is_passable)
    }

    /// The open lanes beside a closed lanelet that begins at `start`.
    fn open_lanes(&self, network: &Network, start: Position) -> OpenLanes {
        let start = Position::new(start.chain, start.x + Closures::INTO);
        Side::BOTH.map(|side| next_lane(network, start, side, |at| !self.cover(at.chain, at.x)))
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
        let has_open_lane = self.open_lanes(network, start) != [None; 2];
        (!has_open_lane || !before.iter().all(can_leave))
            .then_some("drivers could not change to an open lane before it; leave a lane beside it open")
    }
}

impl Navigator {
    /// A closed lanelet is signed this far ahead [m], ours.
    pub(crate) const SIGNED: f64 = 2000.0;
    /// Closed stretches that follow within this distance count together [m], up to so many of them (ours).
    const SOON: f64 = 200.0;
    const IN_A_ROW: u32 = 3;

    /// The closed lanelets.
    #[inline]
    pub(crate) fn closures(&self) -> &Closures {
        &self.closures
    }

    /// Replaces the closed lanelets.
    pub(crate) fn close(&mut self, closures: Closures) {
        self.closures = closures;
    }

    /// The next closed stretch on the route from `x` on `chain` to `destination`, `within` these [m]. A vehicle on
    /// closed lanelets drives off them.
    pub(crate) fn closure_ahead(
        &self,
        network: &Network,
        destination: Destination,
        chain: ChainIndex,
        x: f64,
        within: f64,
    ) -> Option<ClosureAhead> {
        /// Lanelets this near to each other are joined [m].
        const JOINED: f64 = 0.1;
        if self.closures.is_empty() {
            return None;
        }
        let mut closed_until = f64::NEG_INFINITY;
        for leg in self.walk(network, destination, chain, -x).within(within) {
            let stop = self.stop_on(destination, leg.chain);
            let is_passed = |it: &&Stretch| !stop.is_some_and(|stop| it.is_waited_for(stop));
            for Stretch { reach, leaves_until, known_from, does, open } in
                self.closures.on(leg.chain).iter().filter(is_passed)
            {
                let [begin, end] = reach.map(|it| leg.start + it);
                let last = leg.start + leaves_until;
                let ahead = if begin < 0.0 && last > 0.0 { last } else { begin };
                if ahead < 0.0 || ahead - closed_until < JOINED {
                    closed_until = if end > 0.0 { end } else { closed_until };
                } else if ahead <= within.min(*known_from) {
                    return Some(ClosureAhead {
                        ahead,
                        way_out: last.max(ahead),
                        crawls: *does == Does::Crawl,
                        open: *open,
                    });
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
        let Some(ClosureAhead { ahead, open, .. }) =
            self.closure_ahead(network, destination, chain, x, Navigator::SIGNED)
        else {
            return waypoint;
        };
        let last_place = x + ahead;
        if waypoint.last_place <= last_place || waypoint.end <= last_place {
            return waypoint;
        }
        let changes = self.changes_by(network, destination, &open, waypoint.changes, Navigator::IN_A_ROW);
        Cow::Owned(Waypoint { changes, last_place, ..waypoint.into_owned() })
    }

    /// Where drivers get to beside what stays on `chain` between these places [m], if behind it no road is left on
    /// which they could get back to their way to `destination`.
    pub(crate) fn cut_off(
        &self,
        destination: Destination,
        chain: ChainIndex,
        [from, to]: [f64; 2],
        class: Class,
    ) -> Option<Position> {
        let needed = class.body().length + Standing::ROOM;
        let stays = |it: &&Stretch| it.does == Does::Stay && it.reach[1] > from && it.reach[0] < to;
        self.closures.on(chain).iter().filter(stays).find_map(|it| {
            let way = it.reach[1] - it.leaves_until + needed;
            let mut behind = it.open.iter().flatten().map(|(_, at)| Position::new(at.chain, at.x + way));
            let leads_on = |at: Position| self.waypoint(destination, at.chain).leads_on(at.x);
            if behind.clone().any(leads_on) { None } else { behind.next() }
        })
    }

    /// The fewest changes by one of the `open` lanes beside a closed stretch, where a lane that does not lead on takes
    /// so many as the own one, `otherwise`. Up to `more` closed stretches that follow soon count, too.
    fn changes_by(
        &self,
        network: &Network,
        destination: Destination,
        open: &OpenLanes,
        otherwise: u32,
        more: u32,
    ) -> u32 {
        let by = |(lanes, at): &(u32, Position)| {
            let there = self.waypoint(destination, at.chain);
            let changes = if there.leads_there() { there.changes } else { otherwise };
            let next = (more > 0)
                .then(|| self.closure_ahead(network, destination, at.chain, at.x, Navigator::SOON))
                .flatten();
            lanes
                + next
                    .map_or(changes, |it| self.changes_by(network, destination, &it.open, changes, more - 1))
        };
        open.iter().flatten().map(by).min().unwrap_or(1)
    }
}
