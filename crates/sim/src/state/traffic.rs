//! All vehicles on the road at one instant.

use laneweave_network::ChainIndex;
use serde::{Deserialize, Serialize};

use crate::state::busy_lanes::Busy;
use crate::state::clock::Clock;
use crate::state::externals::Externals;
use crate::state::goal::Destination;
use crate::state::lane::{DriverState, Entry, Lane, LaneChangeState};

/// The vehicles and the clock.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Traffic {
    clock: Clock,
    /// By chain.
    lanes: Vec<Lane>,
    busy: Busy,
    /// Vehicles in lanes.
    crowd: usize,
    /// Those that users drive.
    externals: Externals,
}

/// What is needed to move all vehicles.
pub(crate) struct Moving<'a> {
    pub(crate) clock: Clock,
    pub(crate) lanes: &'a mut [Lane],
    /// The lanes that have vehicles to move, in order.
    pub(crate) chosen: &'a [u32],
    pub(crate) externals: &'a Externals,
}

impl Traffic {
    /// Empty lanes for this many chains, with steps of length `step` [s].
    pub(crate) fn new(chains: usize, step: f64) -> Traffic {
        Traffic {
            clock: Clock { step: 0, dt: step },
            lanes: vec![Lane::default(); chains],
            busy: Busy::none_of(chains),
            crowd: 0,
            externals: Externals::default(),
        }
    }

    /// Copies `start`, into the memory that it has.
    pub(crate) fn begin_again(&mut self, start: &Traffic) {
        let Traffic { clock, lanes, busy, crowd, externals } = self;
        for (lane, start) in lanes.iter_mut().zip(&start.lanes) {
            lane.copy_from(start);
        }
        (*clock, *crowd) = (start.clock, start.crowd);
        busy.clone_from(&start.busy);
        externals.clone_from(&start.externals);
    }

    #[inline]
    pub(crate) fn clock(&self) -> Clock {
        self.clock
    }

    /// Ends a step.
    pub(crate) fn tick(&mut self) {
        self.clock.step += 1;
    }

    /// Vehicles in lanes. Those that users drive off the road are not among them.
    pub(crate) fn crowd(&self) -> usize {
        self.crowd
    }

    /// The vehicles that users drive.
    #[inline]
    pub(crate) fn externals(&self) -> &Externals {
        &self.externals
    }

    /// The same, mutable.
    pub(crate) fn externals_mut(&mut self) -> &mut Externals {
        &mut self.externals
    }

    /// All lanes, by chain.
    #[inline]
    pub(crate) fn lanes(&self) -> &[Lane] {
        &self.lanes
    }

    /// The lane of a chain.
    #[inline]
    pub(crate) fn lane(&self, chain: ChainIndex) -> &Lane {
        &self.lanes[chain.at()]
    }

    /// The same lane, mutable. Vehicles come onto it only by [`Traffic::insert`].
    #[inline]
    pub(crate) fn lane_mut(&mut self, chain: ChainIndex) -> &mut Lane {
        &mut self.lanes[chain.at()]
    }

    /// All lanes, by chain, mutable. Vehicles come onto them only by [`Traffic::insert`].
    pub(crate) fn lanes_mut(&mut self) -> &mut [Lane] {
        &mut self.lanes
    }

    /// Adds an entry to the lane of `chain`.
    pub(crate) fn insert(&mut self, chain: ChainIndex, entry: Entry) {
        self.busy.note(chain);
        self.lanes[chain.at()].insert(entry);
    }

    /// Adds a vehicle that was in no lane to the lane of `chain`.
    pub(crate) fn enter(&mut self, chain: ChainIndex, entry: Entry) {
        self.insert(chain, entry);
        self.crowd += 1;
    }

    /// Counts a vehicle that is no longer in a lane.
    pub(crate) fn leave(&mut self) {
        self.crowd -= 1;
    }

    /// Notes that `chain` had no vehicle to move.
    pub(crate) fn forget(&mut self, chain: ChainIndex) {
        self.busy.forget(chain);
    }

    /// What is needed to move all vehicles.
    pub(crate) fn moving(&mut self) -> Moving<'_> {
        let Traffic { clock, lanes, busy, crowd: _, externals } = self;
        Moving { clock: *clock, lanes, chosen: busy.chosen(), externals }
    }

    /// Whether it fits this many chains and sets of driver parameters, and names known destinations only.
    pub(crate) fn fits(
        &self,
        chains: usize,
        driver_parameters: usize,
        is_known: impl Fn(Destination) -> bool,
    ) -> bool {
        let Traffic { clock, lanes, busy, crowd, externals } = self;
        let is_chain = |it: ChainIndex| it.at() < chains;
        let car_fits = |it: &DriverState| {
            (it.parameters as usize) < driver_parameters && is_known(it.goal.destination())
        };
        let mind_fits = |it: &LaneChangeState| {
            it.counterpart.is_none_or(|it| is_chain(it.chain) && it.x.is_finite())
                && it.previous_lanes.known().all(is_chain)
                && it.entered.max(it.since) <= clock.step
        };
        let lane_fits = |it: &Lane| {
            it.is_sound()
                && it.drivers().iter().all(car_fits)
                && it.lane_change_states().iter().all(mind_fits)
        };
        let drivers = lanes.iter().flat_map(|it| it.drivers());
        lanes.len() == chains
            && busy.is_of(chains)
            && lanes.iter().all(lane_fits)
            && externals.fit(chains, |it| car_fits(&it.driver) && mind_fits(&it.lane_change))
            && drivers.filter(|it| !it.is_shadow).count() == *crowd
    }
}
