//! Junctions: where chains conflict, which has priority, and where drivers stop.
//!
//! `contact.rs` finds exactly where vehicles would touch. From that follow the conflict zones (`zone.rs`), who has
//! priority in each (`precedence.rs`), where drivers stop (`on_chain.rs`), where they turn (`turning.rs`), and the
//! signal programs (`light.rs`, `signals.rs`). Who holds which zone is the simulator's.

mod contact;
mod kinship;
mod light;
mod nearby;
mod on_chain;
mod precedence;
mod signals;
mod turning;
mod zone;

pub use light::{InPlan, Light, LightIndex, LightState, Phase, Program};
pub use nearby::Nearby;
pub use on_chain::{Crossing, OnChain, Place, PlaceKind, Sign, Stop};
pub use signals::{Extension, LightConflict, SignalPlan, Turn};
pub use zone::{Precedence, Reach, Touch, Zone, ZoneIndex, ZoneKind};

use crate::build::Network;
use crate::chain::{ChainIndex, Position};
use crate::geometry::{Point, Polyline};
use crate::lanelet::LaneletIndex;
use kinship::Kinship;

/// The rules for traffic on the lanelets of a network, beside their links.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regulations {
    /// Lights and signs at which drivers stop.
    pub stops: Vec<StopRule>,
    /// Priorities.
    pub priorities: Vec<Priority>,
}

/// A light or sign at which the drivers on some lanelets stop.
#[derive(Clone, Debug, PartialEq)]
pub struct StopRule {
    /// Its id in the map.
    pub id: i64,
    /// What it is.
    pub kind: StopKind,
    /// The lanelets whose drivers obey it.
    pub lanelets: Vec<LaneletIndex>,
    /// Stop lines; on a lanelet that none of the lines crosses, drivers stop at its end.
    pub lines: Vec<Vec<Point>>,
}

/// What drivers stop at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopKind {
    /// A traffic light, if it shows red.
    Light,
    /// A stop sign: every driver stops, and then gives way.
    StopSign,
    /// An all-way stop: every driver stops, and then they go in the order of arrival.
    AllWayStop,
    /// A line at which they wait if they have to.
    Line,
}

/// Some lanelets have priority over others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Priority {
    /// Those with priority.
    pub first: Vec<LaneletIndex>,
    /// Those that give way.
    pub yielding: Vec<LaneletIndex>,
}

/// What drivers meet on the chains of a network.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Junctions {
    /// All conflict zones.
    pub zones: Vec<Zone>,
    /// All traffic lights.
    pub lights: Vec<Light>,
    /// The generated plans of lights without a program.
    pub made: Vec<SignalPlan>,
    /// The plans in which traffic extends greens.
    pub actuated: Vec<SignalPlan>,
    /// Number of comparisons of two places or two lights that it took to find them.
    pub comparisons: u64,
    chains: Vec<OnChain>,
    /// Where turns begin, by chain [m].
    turns: Vec<Vec<f64>>,
    /// Where vehicles on other chains are near, by chain.
    nearby: Vec<Vec<Nearby>>,
}

/// A chain without junctions.
static NOTHING: OnChain = OnChain::EMPTY;

impl Junctions {
    /// The junctions of `network` under `regulations`. Lights without a program get one (see [`Program`]).
    pub fn new(network: &Network, regulations: &Regulations) -> Junctions {
        let kinship = Kinship::of(network);
        let contacts = contact::contacts(network);
        let mut zones = zone::zones(&kinship, &contacts.of_pairs);
        precedence::settle(network, &kinship, regulations, &mut zones);
        let mut chains = vec![OnChain::EMPTY; network.chains.len()];
        for (zone, index) in zones.iter().zip(0..) {
            for (reach, side) in zone.sides.iter().zip(0..) {
                chains[reach.chain.at()].crossings.push(Crossing { zone: ZoneIndex(index), side });
            }
        }
        let start = |it: &Crossing| zones[it.zone.at()].sides[usize::from(it.side)].start;
        for chain in &mut chains {
            chain.crossings.sort_by(|a, b| start(a).total_cmp(&start(b)).then(a.zone.cmp(&b.zone)));
        }
        let comparisons = contacts.comparisons;
        let mut junctions = Junctions { zones, chains, comparisons, ..Junctions::default() };
        junctions.place_stops(network, regulations);
        junctions.note_places();
        junctions.look_beyond(network);
        junctions.turns = turning::turns(network);
        junctions.nearby = nearby::nearby(network, &contacts.of_pairs);
        let (made, comparisons) = signals::made_plans(network, &junctions);
        junctions.comparisons += comparisons;
        junctions.follow(&made);
        junctions.made = made;
        junctions
    }

    /// Gives the lights of `plans` their programs.
    pub(crate) fn follow(&mut self, plans: &[SignalPlan]) {
        for plan in plans {
            let Some(first) = plan.lights().min() else { continue };
            let in_plan = InPlan { first, offset: plan.offset, is_actuated: plan.is_actuated() };
            for light in plan.lights() {
                let Light { program, plan: of_light, .. } = &mut self.lights[light.at()];
                (*program, *of_light) = (plan.program(light), Some(in_plan));
            }
        }
        self.actuated.extend(plans.iter().filter(|it| it.is_actuated()).cloned());
    }

    pub(crate) fn light_conflicts(&self, network: &Network) -> Vec<LightConflict> {
        signals::conflicts(network, self).found
    }

    /// For each zone and each of its sides whether its drivers pass a light on `network`, to which these junctions
    /// belong.
    pub fn lit_sides(&self, network: &Network) -> Vec<[bool; 2]> {
        signals::lit_sides(network, self)
    }

    /// What the lights show at `time` [s].
    pub fn show(&self, time: f64) -> impl Iterator<Item = LightState> {
        // Lights of one junction have the same cycle length.
        let (mut cycle, mut at) = (f64::NAN, 0.0);
        self.lights.iter().map(move |Light { program, .. }| {
            if program.cycle != cycle {
                (cycle, at) = (program.cycle, program.within_cycle(time));
            }
            program.state_within(at)
        })
    }

    /// Time from `time` [s] on during which all lights with fixed programs show the same, except for rounding [s].
    pub fn steady_for(&self, time: f64) -> f64 {
        self.lights.iter().map(|it| it.program.steady_for(time)).fold(f64::INFINITY, f64::min)
    }

    /// What drivers meet on `chain`.
    #[inline]
    pub fn on(&self, chain: ChainIndex) -> &OnChain {
        self.chains.get(chain.at()).unwrap_or(&NOTHING)
    }

    /// Stations on `chain` at which its turns begin [m], in order: where its direction changes by more than 30°
    /// within 30 m. Turns around a roundabout do not count.
    pub fn turns(&self, chain: ChainIndex) -> &[f64] {
        self.turns.get(chain.at()).map_or(&[], Vec::as_slice)
    }

    /// Stations of the first and the last place on `chain` where drivers may have to stop [m]; the first is beyond
    /// the last if there is none.
    #[inline]
    pub fn places(&self, chain: ChainIndex) -> [f64; 2] {
        self.on(chain).extent
    }

    /// Distance from `x` on `chain`, which is `length` long, to the next place where drivers may have to stop, on any
    /// route [m].
    #[inline]
    pub fn free_way(&self, chain: ChainIndex, x: f64, length: f64) -> f64 {
        let &OnChain { extent: [first, last], beyond, .. } = self.on(chain);
        if x >= last { length - x + beyond } else { (first - x).max(0.0) }
    }

    /// Whether a lane is outside of junctions from its start to `station` [m].
    pub fn is_clear_until(&self, chain: ChainIndex, station: f64) -> bool {
        self.for_cars(chain).next().is_none_or(|it| self.reach(it).start >= station)
    }

    /// The zones of a chain in which cars would touch.
    pub(crate) fn for_cars(&self, chain: ChainIndex) -> impl Iterator<Item = Crossing> {
        let crossings = self.on(chain).crossings.iter().copied();
        crossings.filter(|it| self.zones[it.zone.at()].touch == Touch::Any)
    }

    /// Where vehicles on other chains may touch those on `chain`, of each two chains once.
    #[inline]
    pub fn nearby(&self, chain: ChainIndex) -> &[Nearby] {
        self.nearby.get(chain.at()).map_or(&[], Vec::as_slice)
    }

    /// The stretches of `chain` that are part of junctions: zones, and the places where drivers stop [m].
    pub(crate) fn extents(&self, chain: ChainIndex) -> Vec<[f64; 2]> {
        let on = self.on(chain);
        let zones = on.crossings.iter().map(|it| self.reach(*it)).map(|it| [it.start, it.end]);
        zones.chain(on.stops.iter().map(|it| [it.station, it.station])).collect()
    }

    /// The stretch of a side of a zone.
    #[inline]
    pub fn reach(&self, crossing: Crossing) -> &Reach {
        &self.zones[crossing.zone.at()].sides[usize::from(crossing.side)]
    }

    /// The stretch on the other side of its zone.
    pub fn other_side(&self, crossing: Crossing) -> &Reach {
        &self.zones[crossing.zone.at()].sides[usize::from(1 - crossing.side)]
    }

    /// Follows a reversal of the network's chains: every index is reversed.
    pub(crate) fn reverse_chains(&mut self, turn: impl Fn(&mut ChainIndex)) {
        self.chains.reverse();
        self.turns.reverse();
        self.nearby.reverse();
        self.nearby.iter_mut().flatten().for_each(|it| turn(&mut it.chain));
        self.zones.iter_mut().flat_map(|it| &mut it.sides).for_each(|it| turn(&mut it.chain));
    }

    fn place_stops(&mut self, network: &Network, regulations: &Regulations) {
        for (rules, number) in light::sharing(&regulations.stops).into_iter().zip(0..) {
            let id = rules.iter().map(|it| it.id).min().unwrap_or_default();
            self.lights.push(Light { id, program: Program::ALWAYS_GREEN, plan: None });
            for rule in rules {
                self.place(network, rule, Sign::Light(LightIndex(number)));
            }
        }
        for rule in &regulations.stops {
            match rule.kind {
                StopKind::Light => {}
                StopKind::StopSign | StopKind::AllWayStop => self.place(network, rule, Sign::Stop),
                StopKind::Line => self.place(network, rule, Sign::Line),
            }
        }
        for chain in &mut self.chains {
            chain.stops.sort_by(|a, b| a.station.total_cmp(&b.station));
            chain.stops.dedup_by(|b, a| a.sign == b.sign && b.station - a.station < 1.0);
        }
    }

    fn note_places(&mut self) {
        let Junctions { zones, chains, .. } = self;
        let place = |crossing: &Crossing| {
            let (zone, side) = (&zones[crossing.zone.at()], usize::from(crossing.side));
            let merge = match zone.kind {
                ZoneKind::Merging(stations) => Some(stations[side]),
                ZoneKind::Crossing => None,
            };
            let Reach { start, end, .. } = zone.sides[side];
            Place {
                station: start,
                what: PlaceKind::Zone { crossing: *crossing, touch: zone.touch, end, merge },
            }
        };
        for chain in chains {
            let stops =
                chain.stops.iter().map(|it| Place { station: it.station, what: PlaceKind::Sign(it.sign) });
            chain.places = stops.chain(chain.crossings.iter().map(place)).collect();
            chain.places.sort_by(|a, b| a.station.total_cmp(&b.station));
            if let [first, .., last] | [first @ last] = &chain.places[..] {
                chain.extent = [first.station, last.station];
            }
        }
    }

    /// Spreads the distances to the next places backwards until none becomes shorter.
    fn look_beyond(&mut self, network: &Network) {
        let chains = &mut self.chains;
        let mut open: Vec<usize> = (0..chains.len()).collect();
        while let Some(index) = open.pop() {
            let to_place = |it: &ChainIndex| {
                let OnChain { extent: [first, _], beyond, .. } = chains[it.at()];
                first.min(network.chain(*it).length + beyond)
            };
            let here = &network.chains[index];
            let beyond = here.following.iter().map(to_place).fold(f64::INFINITY, f64::min);
            if beyond < chains[index].beyond {
                chains[index].beyond = beyond;
                open.extend(here.previous.iter().map(|it| it.at()));
            }
        }
    }

    fn place(&mut self, network: &Network, rule: &StopRule, sign: Sign) {
        for lanelet in &rule.lanelets {
            let Position { chain, x: start } = network.start_of(*lanelet);
            let centre = &network.lanelets[lanelet.at()].centre;
            let along = rule.lines.iter().find_map(|line| centre.crossed_by(line));
            // A line before the lanelet belongs to a lanelet within the junction.
            let is_before = rule.lines.iter().any(|line| is_nearer_to_start(centre, line));
            let station = start + along.unwrap_or(if is_before { 0.0 } else { centre.length() });
            self.chains[chain.at()].stops.push(Stop { station, sign });
        }
    }
}

fn is_nearer_to_start(centre: &Polyline, line: &[Point]) -> bool {
    let nearest = |to: Point| line.iter().map(|it| it.distance(&to)).fold(f64::INFINITY, f64::min);
    nearest(centre.at(0.0)) < nearest(centre.at(centre.length()))
}

/// The lanelets near a chain whose rules its drivers follow: its own and those that lead to it.
fn lineage<'a>(
    network: &'a Network,
    kinship: &'a Kinship,
    chain: ChainIndex,
) -> impl Iterator<Item = LaneletIndex> + 'a {
    let before = kinship.ancestors(chain).iter().map(|it| it.0);
    std::iter::once(chain).chain(before).flat_map(|it| network.chain(it).lanelets.iter().copied())
}
