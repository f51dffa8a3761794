//! What drivers meet on the chains of a network.

use std::collections::BTreeSet;

use super::light::{InPlan, Light, LightIndex, LightState};
use super::nearby::Nearby;
use super::on_chain::{Crossing, OnChain};
use super::plan::SignalPlan;
use super::zone::{Reach, Touch, Zone, ZoneKind};
use crate::chain::ChainIndex;

/// What drivers meet on the chains of a network.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Junctions {
    /// All conflict zones.
    pub zones: Vec<Zone>,
    /// All traffic lights.
    pub lights: Vec<Light>,
    /// The lights whose programs the map gives.
    pub programmed: BTreeSet<LightIndex>,
    /// The generated plans of lights without a program.
    pub made: Vec<SignalPlan>,
    /// The plans in which traffic extends greens.
    pub actuated: Vec<SignalPlan>,
    /// Number of comparisons of two places or two lights that it took to find them.
    pub comparisons: u64,
    /// What drivers meet on each chain.
    pub(crate) chains: Vec<OnChain>,
    /// Where turns begin, by chain [m].
    pub(crate) turns: Vec<Vec<f64>>,
    /// Which chains are part of a roundabout.
    pub(crate) in_roundabout: Vec<bool>,
    /// Where vehicles on other chains are near, by chain.
    pub(crate) nearby: Vec<Vec<Nearby>>,
}

/// A chain without junctions.
static NOTHING: OnChain = OnChain::EMPTY;

impl Junctions {
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

    /// Whether `chain` is part of a roundabout: its lane leads back to it, turns once around, and is round.
    #[inline]
    pub fn is_in_roundabout(&self, chain: ChainIndex) -> bool {
        self.in_roundabout.get(chain.at()).is_some_and(|it| *it)
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

    /// Whether a vehicle with its rear and its front at these stations of `chain` [m] stands where vehicles that cross
    /// touch it.
    pub fn is_crossed(&self, chain: ChainIndex, [rear, front]: [f64; 2], is_long: bool) -> bool {
        let crossings = &self.on(chain).crossings;
        let before = crossings.partition_point(|it| self.reach(*it).start < front);
        let is_in = |it: &Crossing| {
            let zone = &self.zones[it.zone.at()];
            zone.kind == ZoneKind::Crossing && zone.touch.concerns(is_long) && self.reach(*it).end > rear
        };
        crossings[..before].iter().rev().any(is_in)
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
}
