//! Assignment of a demand to the roads: flows along the usual routes, as if no road were ever full.

use std::collections::BinaryHeap;

use laneweave_network::{Beside, ChainIndex, Network, Position, Side};

use crate::demand::{Demand, Origin, SECONDS_PER_HOUR};
use crate::route::navigate::Navigator;
use crate::route::place::Place;
use crate::route::waypoint::Waypoint;
use crate::route::ways::stretch_to;

/// The flows of a demand on all chains.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// By chain.
    parts: Vec<Vec<Part>>,
    /// The lane changes that vehicles have to make for their routes.
    pub changes: Vec<Change>,
    /// For each chain the numbers of the changes from it, in order.
    changes_from: Vec<Vec<usize>>,
    /// Flow from all origins together [veh/s].
    pub total: f64,
    /// Flow to all destinations together [veh/s]: less, if not all pass.
    pub arriving: f64,
}

/// Places on chains that not all vehicles pass: for each chain the stations [m] with the shares that do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Thinning(Vec<Vec<(f64, f64)>>);

impl Thinning {
    /// Of the vehicles that come to `station` [m] of `chain`, only this `share` passes, or less.
    pub fn thin(&mut self, chain: ChainIndex, station: f64, share: f64) {
        if self.0.len() <= chain.at() {
            self.0.resize(chain.at() + 1, Vec::new());
        }
        let places = &mut self.0[chain.at()];
        match places.iter_mut().find(|it| it.0 == station) {
            Some(place) => place.1 = place.1.min(share),
            None => places.push((station, share)),
        }
    }

    /// The share of the vehicles that passes a part of `chain` [m].
    fn passing(&self, chain: ChainIndex, [from, to]: [f64; 2]) -> f64 {
        let places = self.0.get(chain.at()).into_iter().flatten();
        places.filter(|(x, _)| (from..to).contains(x)).map(|it| it.1).fold(1.0, f64::min)
    }

    /// Every place of it, as it is in the middle between this and `other`.
    pub fn between(&self, other: &Thinning) -> Thinning {
        let mut middle = Thinning::default();
        for (these, those) in [(self, other), (other, self)] {
            for (chain, places) in (0..).map(ChainIndex).zip(&these.0) {
                for (station, share) in places {
                    let there = those.0.get(chain.at()).into_iter().flatten();
                    let there = there.clone().find(|it| it.0 == *station).map_or(1.0, |it| it.1);
                    middle.thin(chain, *station, 0.5 * (share + there));
                }
            }
        }
        middle
    }
}

/// A flow that has to change from one lane to the lane beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The lane, and the part of it on which this is possible and early enough [m].
    pub from: (ChainIndex, [f64; 2]),
    /// The other lane, and the same part along it [m].
    pub to: (ChainIndex, [f64; 2]),
    /// Flow [veh/s].
    pub flow: f64,
}

/// A flow on a part of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// First station [m].
    pub from: f64,
    /// Last station; infinite where the flow goes on over the end of the chain [m].
    pub to: f64,
    /// Flow over this part [veh/s].
    pub flow: f64,
    /// The route uses this lane only, and none beside it.
    pub is_bound: bool,
}

impl Assignment {
    /// The mean assignment of `demand` between two times [s]. If no vehicle arrives in that time, every lane of the
    /// origins gets the same flow.
    pub fn new(network: &Network, navigator: &Navigator, demand: &Demand, during: [f64; 2]) -> Assignment {
        let rates = demand.mean_rates(network, during);
        Assignment::of_rates(network, navigator, demand, &rates, &Thinning::default())
    }

    /// The assignment of `demand` if these `rates` come to its origins [veh/h], and not all pass everywhere. Parallel
    /// lanes that lead to a destination share its drivers evenly.
    pub fn of_rates(
        network: &Network,
        navigator: &Navigator,
        demand: &Demand,
        rates: &[f64],
        thinning: &Thinning,
    ) -> Assignment {
        let chains = network.chains.len();
        let mut assignment = Assignment {
            parts: vec![Vec::new(); chains],
            changes: Vec::new(),
            changes_from: vec![Vec::new(); chains],
            total: 0.0,
            arriving: 0.0,
        };
        let comes = demand.origins.iter().zip(rates).filter(|it| *it.1 > 0.0);
        let comes: Vec<(&Place, f64, Vec<f64>)> = comes
            .map(|(it, rate)| (&it.place, rate / SECONDS_PER_HOUR, shares(network, navigator, it)))
            .collect();
        let mut coming = vec![0.0; chains];
        for destination in 0..demand.destinations.len() {
            let starts = comes.iter().map(|(place, rate, shares)| (*place, rate * shares[destination]));
            let open = BinaryHeap::new();
            let (destination, assignment, coming) = (destination as u16, &mut assignment, &mut coming[..]);
            let mut spread = Spread { network, navigator, destination, assignment, thinning, coming, open };
            for (place, flow) in starts.filter(|it| it.1 > 0.0) {
                spread.assignment.total += flow;
                spread.begin(place, flow);
            }
            spread.drive();
        }
        assignment
    }

    /// The parts of a chain on which vehicles drive.
    pub fn on(&self, chain: ChainIndex) -> &[Part] {
        &self.parts[chain.at()]
    }

    /// The lane changes that vehicles have to make from any of these chains, in the order of all.
    pub fn changes_from(&self, chains: impl Iterator<Item = ChainIndex>) -> impl Iterator<Item = &Change> {
        let mut numbers: Vec<usize> = chains.flat_map(|it| &self.changes_from[it.at()]).copied().collect();
        numbers.sort_unstable();
        numbers.into_iter().map(|it| &self.changes[it])
    }

    /// Flow over a station of a chain [m]: of the vehicles that can use no other lane, and of all [veh/s].
    pub fn flow(&self, chain: ChainIndex, station: f64) -> [f64; 2] {
        let here = self.on(chain).iter().filter(|it| it.from <= station && station < it.to);
        here.fold([0.0, 0.0], |[bound, all], it| {
            [bound + if it.is_bound { it.flow } else { 0.0 }, all + it.flow]
        })
    }
}

/// The share of the car drivers of an origin that goes to each destination.
fn shares(network: &Network, navigator: &Navigator, origin: &Origin) -> Vec<f64> {
    let weight = |(weight, destination): (&f64, u16)| {
        if *weight > 0.0 && navigator.leads_to(network, &origin.place, destination) { *weight } else { 0.0 }
    };
    let weights: Vec<f64> = origin.weights.iter().zip(0..).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|it| if sum > 0.0 { it / sum } else { 0.0 }).collect()
}

/// A lane that drivers may use instead of another one.
struct Shared {
    lane: ChainIndex,
    /// Where a driver enters it [m].
    station: f64,
    /// Distance driven before that from the start of the other lane [m].
    after: f64,
}

/// Spreads the flow to one destination over the chains.
struct Spread<'a> {
    network: &'a Network,
    navigator: &'a Navigator,
    destination: u16,
    assignment: &'a mut Assignment,
    thinning: &'a Thinning,
    /// Flow that comes to the start of each chain [veh/s].
    coming: &'a mut [f64],
    /// Chains that have a flow at their start, by the remaining distance to the destination [mm].
    open: BinaryHeap<(u64, ChainIndex)>,
}

impl<'a> Spread<'a> {
    fn waypoint(&self, chain: ChainIndex) -> &'a Waypoint {
        self.navigator.waypoint(Some(self.destination), chain)
    }

    /// Lets `flow` begin its trips at `place`. At a gate it uses the lanes with the fewest lane changes left.
    fn begin(&mut self, place: &Place, flow: f64) {
        match place {
            Place::Gate(_) => {
                let changes = |it: &ChainIndex| self.waypoint(*it).changes;
                let mut lanes: Vec<ChainIndex> = place.for_cars(self.network).collect();
                let fewest = lanes.iter().map(changes).min();
                lanes.retain(|it| Some(changes(it)) == fewest);
                lanes.iter().for_each(|it| self.come(*it, flow / lanes.len() as f64));
            }
            Place::Inside(inner) => self.go_on(inner.chain, inner.station, flow, true),
            Place::Across(section) => {
                let lanes: Vec<Position> = section.lanes().collect();
                lanes.iter().for_each(|it| self.go_on(it.chain, it.x, flow / lanes.len() as f64, true));
            }
        }
    }

    fn come(&mut self, chain: ChainIndex, flow: f64) {
        if self.coming[chain.at()] == 0.0 {
            let millimetres = (self.waypoint(chain).distance.max(0.0) * 1e3) as u64;
            self.open.push((millimetres, chain));
        }
        self.coming[chain.at()] += flow;
    }

    /// Moves all flows to the destination, beginning with the flow that has the longest distance left.
    fn drive(mut self) {
        while let Some((_, chain)) = self.open.pop() {
            let flow = std::mem::take(&mut self.coming[chain.at()]);
            let lanes = self.lanes_to_share(chain);
            let share = flow / lanes.len() as f64;
            for Shared { lane, station, after } in &lanes {
                if *after > 0.0 {
                    self.note(chain, [0.0, *after], share, false);
                }
                self.go_on(*lane, *station, share, lanes.len() == 1);
            }
        }
    }

    /// The lanes that a driver at the start of `chain` may use without another lane change for the route.
    fn lanes_to_share(&self, chain: ChainIndex) -> Vec<Shared> {
        /// Routes whose times differ by less than this are equally good [s].
        const EQUAL: f64 = 2.0;
        let mut lanes = vec![Shared { lane: chain, station: 0.0, after: 0.0 }];
        if self.waypoint(chain).changes > 0 {
            return lanes;
        }
        let time = |lane, x| self.waypoint(lane).time - self.navigator.time_to(self.network, lane, x);
        let mut number = 0;
        while let Some(&Shared { lane, station, after }) = lanes.get(number) {
            number += 1;
            for side in Side::BOTH {
                let stretches = self.network.chain(lane).stretches(side);
                let Some(stretch) = stretches.iter().find(|it| it.end > station) else { continue };
                let (from, there) = (stretch.start.max(station), stretch.chain);
                let beside = stretch.across(from).max(0.0);
                let waypoint = self.waypoint(there);
                let is_as_good = waypoint.changes == 0
                    && waypoint.leads_on(beside)
                    && (time(there, beside) - time(lane, from)).abs() < EQUAL;
                if is_as_good && lanes.iter().all(|it| it.lane != there) {
                    lanes.push(Shared { lane: there, station: beside, after: after + from - station });
                }
            }
        }
        lanes
    }

    /// Moves `flow` from a station of a chain [m] to the start of the next chain, with the lane changes between.
    fn go_on(&mut self, mut chain: ChainIndex, mut station: f64, mut flow: f64, is_bound: bool) {
        let to = Some(self.destination);
        loop {
            let here = self.network.chain(chain);
            let way = self.navigator.waypoint_from(self.network, to, chain, station).into_owned();
            let Some(via) = way.goes_on() else {
                self.assignment.arriving += flow;
                return;
            };
            let stretch =
                stretch_to(here, via, way.last_place).filter(|_| way.changes > self.waypoint(via).changes);
            match stretch {
                Some(stretch) => {
                    let place = way.last_place.max(station);
                    self.note(chain, [station, place], flow, is_bound);
                    flow *= self.thinning.passing(chain, [station, place]);
                    self.note_change(chain, stretch, [station.max(stretch.start).min(place), place], flow);
                    (chain, station) = (via, stretch.across(place).max(0.0));
                }
                None => {
                    self.note(chain, [station, way.end], flow, is_bound);
                    // A chain may lead back to its own start.
                    let arrives = via == chain && (way.next.is_none() || way.end.is_finite());
                    flow *= self.thinning.passing(chain, [station, way.end]);
                    if arrives {
                        self.assignment.arriving += flow;
                    } else {
                        self.come(via, flow);
                    }
                    return;
                }
            }
        }
    }

    fn note(&mut self, chain: ChainIndex, [from, to]: [f64; 2], flow: f64, is_bound: bool) {
        let parts = &mut self.assignment.parts[chain.at()];
        match parts.iter_mut().find(|it| (it.from, it.to, it.is_bound) == (from, to, is_bound)) {
            Some(part) => part.flow += flow,
            None => parts.push(Part { from, to, flow, is_bound }),
        }
    }

    fn note_change(&mut self, chain: ChainIndex, stretch: &Beside, on: [f64; 2], flow: f64) {
        let (from, to) = ((chain, on), (stretch.chain, on.map(|it| stretch.across(it))));
        let Assignment { changes, changes_from, .. } = &mut *self.assignment;
        let known = &mut changes_from[chain.at()];
        match known.iter().find(|it| (changes[**it].from, changes[**it].to) == (from, to)) {
            Some(number) => changes[*number].flow += flow,
            None => {
                known.push(changes.len());
                changes.push(Change { from, to, flow });
            }
        }
    }
}
