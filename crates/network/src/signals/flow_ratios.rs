//! How much of the time the lights of a stage need: the flow ratio of its critical lane.
//!
//! A vehicle that turns across oncoming traffic takes a gap in it. It counts as the number of vehicles that could leave
//! in that time (the through-car equivalents of the Highway Capacity Manual; here from gap acceptance, after Siegloch,
//! 1973). Before the first gap, the oncoming queue has to pass. Two such vehicles leave in each cycle when green ends.

use std::collections::BTreeMap;

use super::conflicts::Rivals;
use super::lanes::{Lane, Way};
use super::stage::Stage;
use super::{LightTraffic, timing};
use crate::chain::{ChainIndex, Position};
use crate::junction::{Junctions, LightIndex, Precedence, ZoneIndex};

/// Critical gap and follow-up time of turns across oncoming traffic [s] (Highway Capacity Manual, from memory).
const GAP: f64 = 4.5;
const FOLLOW_UP: f64 = 2.5;
/// One of them counts as no more vehicles than this. Ours.
const MOST_EQUIVALENTS: f64 = 10.0;
/// Those who leave when green ends [veh/s]: two in a cycle of a minute.
const AT_THE_END: f64 = 2.0 / 60.0;

/// The flows of a lane before a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneFlows {
    /// Its line.
    pub line: Position,
    /// Of the lane [veh/s].
    pub flow: f64,
    /// Flow of a queue on it at green [veh/s].
    pub saturation: f64,
    /// The part of its flow that turns across oncoming traffic that is green at the same time [veh/s].
    pub across: f64,
    /// The oncoming flow [veh/s].
    pub oncoming: f64,
    /// The largest flow ratio of a lane from which it comes.
    pub oncoming_ratio: f64,
}

impl LaneFlows {
    /// The share of the time for which the lane needs green when all flows are `growth` times as large.
    pub fn ratio(&self, growth: f64) -> f64 {
        let LaneFlows { saturation, oncoming_ratio, .. } = *self;
        let [flow, across, oncoming] = [self.flow, self.across, self.oncoming].map(|it| growth * it);
        let gaps = libm::exp(-oncoming * (GAP - 0.5 * FOLLOW_UP));
        let equivalents = (saturation * FOLLOW_UP / gaps).clamp(1.0, MOST_EQUIVALENTS);
        let all = (flow + (equivalents - 1.0) * across) / saturation;
        let in_gaps = across - AT_THE_END;
        if in_gaps <= 0.0 {
            all
        } else {
            all.max(growth * oncoming_ratio + equivalents * in_gaps / saturation)
        }
    }
}

/// The flows at the lights of a network.
pub(super) struct Flows<'a> {
    pub(super) junctions: &'a Junctions,
    pub(super) traffic: &'a LightTraffic<'a>,
    pub(super) lanes: &'a [Lane],
    /// For each light the lanes before it, by number.
    pub(super) before: &'a [Vec<usize>],
}

/// The lanes that are green together.
struct Together<'a> {
    flows: &'a Flows<'a>,
    lanes: Vec<&'a Lane>,
    /// The flow over each side of each zone [veh/s], and the largest flow ratio of a lane that leads there.
    on_side: BTreeMap<(ZoneIndex, u8), (f64, f64)>,
}

impl Flows<'_> {
    /// The lanes before these lights.
    fn lanes_of<'b>(&self, lights: impl IntoIterator<Item = &'b LightIndex>) -> Vec<&'_ Lane> {
        lights.into_iter().flat_map(|it| &self.before[it.at()]).map(|it| &self.lanes[*it]).collect()
    }

    /// The stage with these lights, with what it needs.
    pub(super) fn measured(&self, lights: Vec<LightIndex>) -> Stage {
        let flow_ratio = Together::new(self, self.lanes_of(&lights)).flow_ratio();
        Stage { all_red: self.all_red(&lights), lights, flow_ratio }
    }

    /// All-red time after a stage with these lights [s].
    pub(super) fn all_red(&self, lights: &[LightIndex]) -> f64 {
        timing::all_red(self.lanes_of(lights).iter().map(|it| it.clearance).fold(0.0, f64::max))
    }

    /// The flows of each lane while its light and those that are green at the same time let go.
    pub(super) fn at_lights(&self, rivals: &Rivals) -> Vec<LaneFlows> {
        let lights = &self.junctions.lights;
        let flows = |lane: &Lane| {
            let own = &lights[lane.light.at()].program;
            let is_met = |it: &&LightIndex| own.is_green_with(&lights[it.at()].program);
            let met = rivals.any[lane.light.at()].iter().filter(is_met).chain([&lane.light]);
            Together::new(self, self.lanes_of(met)).flows(lane)
        };
        self.lanes.iter().map(flows).collect()
    }

    /// Flow at the line of a lane, and as a share of what leaves there at green.
    fn at_line(&self, lane: &Lane) -> (f64, f64) {
        let flow = (self.traffic.flow)(lane.stop);
        (flow, flow / (self.traffic.saturation)(lane.stop))
    }

    /// Flow over a side of a zone [veh/s].
    fn over(&self, (zone, side): (ZoneIndex, u8)) -> f64 {
        let reach = &self.junctions.zones[zone.at()].sides[usize::from(side)];
        (self.traffic.flow)(Position::new(reach.chain, reach.start.max(0.0)))
    }

    /// The sides of zones on the other side of which others have priority over a way.
    pub(super) fn gives_way_to(&self, way: &Way) -> impl Iterator<Item = (ZoneIndex, u8)> {
        let yields = |(zone, side): &(ZoneIndex, u8)| {
            self.junctions.zones[zone.at()].precedence == Precedence::Side(1 - side)
        };
        way.zones.iter().copied().filter(yields)
    }

    /// Whether every way from `lane` gives way to some lane `before` which it may go.
    pub(super) fn turns_across(&self, lane: &Lane, before: &[&Lane]) -> bool {
        let is_taken = |(zone, side)| before.iter().any(|it| it.zones().any(|on| on == (zone, 1 - side)));
        !lane.ways.is_empty() && lane.ways.iter().all(|it| self.gives_way_to(it).any(is_taken))
    }

    /// The flow from `lane` that turns across oncoming traffic from the lanes `before` which it may go, and the
    /// oncoming flow [veh/s].
    pub(super) fn across(&self, lane: &Lane, before: &[&Lane]) -> [f64; 2] {
        Together::new(self, before.to_vec()).across(lane)
    }

    /// Of the lanes `before` which drivers on `lane` may go, those to whose drivers they give way.
    pub(super) fn oncoming<'b>(&self, lane: &Lane, before: &[&'b Lane]) -> Vec<&'b Lane> {
        let given: Vec<(ZoneIndex, u8)> = lane.ways.iter().flat_map(|it| self.gives_way_to(it)).collect();
        let is_oncoming = |it: &&&Lane| it.zones().any(|(zone, side)| given.contains(&(zone, 1 - side)));
        before.iter().filter(is_oncoming).copied().collect()
    }
}

impl<'a> Together<'a> {
    fn new(flows: &'a Flows<'a>, lanes: Vec<&'a Lane>) -> Together<'a> {
        let mut on_side: BTreeMap<(ZoneIndex, u8), (f64, f64)> = BTreeMap::new();
        for lane in &lanes {
            let (_, ratio) = flows.at_line(lane);
            for side in lane.zones() {
                let known = on_side.entry(side).or_insert_with(|| (flows.over(side), 0.0));
                known.1 = known.1.max(ratio);
            }
        }
        Together { flows, lanes, on_side }
    }

    /// The flow ratio of the critical lane.
    fn flow_ratio(&self) -> f64 {
        self.lanes.iter().map(|it| self.flows(it).ratio(1.0)).fold(0.0, f64::max)
    }

    fn flows(&self, lane: &Lane) -> LaneFlows {
        let (flow, _) = self.flows.at_line(lane);
        let [across, oncoming] = self.across(lane);
        LaneFlows {
            line: lane.stop,
            flow,
            saturation: (self.flows.traffic.saturation)(lane.stop),
            across,
            oncoming,
            oncoming_ratio: self.oncoming_ratio(lane),
        }
    }

    /// The flow from a lane that gives way, and the flow before which it may go [veh/s].
    fn across(&self, lane: &Lane) -> [f64; 2] {
        let mut giving: BTreeMap<ChainIndex, f64> = BTreeMap::new();
        let mut oncoming: BTreeMap<ChainIndex, f64> = BTreeMap::new();
        let chain = |(zone, side): (ZoneIndex, u8)| {
            self.flows.junctions.zones[zone.at()].sides[usize::from(side)].chain
        };
        for (zone, side) in lane.ways.iter().flat_map(|it| self.flows.gives_way_to(it)) {
            let opposite = (zone, 1 - side);
            if let Some((flow, _)) = self.on_side.get(&opposite) {
                giving.insert(chain((zone, side)), self.flows.over((zone, side)));
                oncoming.insert(chain(opposite), *flow);
            }
        }
        [giving, oncoming].map(|it| it.values().sum())
    }

    /// The largest flow ratio of a lane to whose drivers some of those on `lane` give way.
    fn oncoming_ratio(&self, lane: &Lane) -> f64 {
        let given = lane.ways.iter().flat_map(|it| self.flows.gives_way_to(it));
        let ratio = |(zone, side): (ZoneIndex, u8)| self.on_side.get(&(zone, 1 - side)).map(|it| it.1);
        given.filter_map(ratio).fold(0.0, f64::max)
    }
}
