//! The road network: chains, what lies beside and beyond them, entrances and exits, junctions.

use crate::chain::{Beside, Chain, ChainIndex, Position};
use crate::class::Class;
use crate::gate::Gate;
use crate::id::Id;
use crate::junction::Junctions;
use crate::lanelet::{DrivingSide, Lanelet, LaneletIndex};
use crate::law::{LaneUse, RoadLaw};

/// A road network; it never changes after loading.
#[derive(Clone, Debug)]
pub struct Network {
    /// Lanelets that vehicles may use.
    pub lanelets: Vec<Lanelet>,
    /// Chains of lanelets.
    pub chains: Vec<Chain>,
    /// Where vehicles come onto the map.
    pub entrances: Vec<Gate>,
    /// Where they leave it.
    pub exits: Vec<Gate>,
    /// Chains that end beside a continuing one.
    pub lane_drops: Vec<ChainIndex>,
    /// On which side traffic drives.
    pub driving_side: DrivingSide,
    /// The law of the place.
    pub law: RoadLaw,
    /// Conflict zones, and where drivers stop; empty until [`Network::regulated`].
    pub junctions: Junctions,
    /// For each lanelet where it starts.
    pub(crate) starts: Vec<Position>,
    /// The lanelets in the order of their ids.
    pub(crate) by_id: Vec<LaneletIndex>,
}

impl Network {
    /// The chain at `index`.
    #[inline]
    pub fn chain(&self, index: ChainIndex) -> &Chain {
        &self.chains[index.at()]
    }

    /// Which lanes the law wants a driver at `station` of `chain` to use.
    #[inline]
    pub fn lane_use(&self, chain: &Chain, station: f64, is_long: bool) -> LaneUse {
        let is_free_to_choose = !is_long && chain.is_in_town(station);
        if is_free_to_choose { self.law.lane_use_in_town } else { self.law.lane_use }
    }

    /// First and last station of a `stretch` of `chain` at which a vehicle of `class` may change lanes, and both lanes
    /// are wide enough for it [m]; the first is beyond the last if there is none.
    pub fn window(&self, chain: &Chain, stretch: &Beside, class: Class) -> [f64; 2] {
        let there = self.chain(stretch.chain);
        if !(chain.is_restricted || there.is_restricted) {
            return [stretch.start, stretch.end];
        }
        if !there.classes.has(class) {
            return [f64::INFINITY, f64::NEG_INFINITY];
        }
        let [from, until] = there.open[usize::from(class.is_long())].map(|it| stretch.back(it));
        let [begins, ends] = chain.open[usize::from(class.is_long())];
        [stretch.start.max(from).max(begins), stretch.end.min(until).min(ends)]
    }

    /// Where a lanelet starts.
    #[inline]
    pub fn start_of(&self, lanelet: LaneletIndex) -> Position {
        self.starts[lanelet.at()]
    }

    /// The lanelet with this id; of several ones the first.
    pub fn lanelet_with(&self, id: impl Into<Id>) -> Option<LaneletIndex> {
        let id = id.into();
        let place = self.by_id.partition_point(|it| self.lanelets[it.at()].id < id);
        self.by_id.get(place).copied().filter(|it| self.lanelets[it.at()].id == id)
    }

    /// The lanelet at a place on a chain, and how far along it that is [m].
    pub fn lanelet_at(&self, at: Position) -> (&Lanelet, f64) {
        let (index, along) = self.chain(at.chain).lanelet(at.x);
        (&self.lanelets[index.at()], along)
    }

    /// The same network with its chains stored in reverse order: the result of a simulation must not change.
    pub fn with_chains_reversed(mut self) -> Network {
        let last = self.chains.len() as u32 - 1;
        let turn = |index: &mut ChainIndex| index.0 = last - index.0;
        self.chains.reverse();
        for chain in &mut self.chains {
            chain.following.iter_mut().chain(&mut chain.previous).for_each(turn);
            chain.left.iter_mut().chain(&mut chain.right).for_each(|it| turn(&mut it.chain));
            for branch in &mut chain.branches {
                turn(&mut branch.chain);
                branch.over.iter_mut().chain(&mut branch.own_over).for_each(turn);
            }
        }
        self.entrances.iter_mut().chain(&mut self.exits).flat_map(|it| &mut it.chains).for_each(turn);
        self.lane_drops.iter_mut().for_each(turn);
        self.starts.iter_mut().for_each(|it| turn(&mut it.chain));
        self.junctions.reverse_chains(turn);
        self
    }
}
