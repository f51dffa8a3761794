//! Signal programs for lights without one, as a traffic engineer would draw them by hand.
//!
//! `lanes.rs` finds the lanes before each light and the ways beyond it, and `conflicts.rs` which lights conflict. The
//! lanes of a road are its approach (`approaches.rs`). Opposing approaches are green together, and turns across
//! oncoming traffic are permitted or protected (`stages.rs`), as the flows demand (`flow_ratios.rs`). Cycle and greens
//! follow Webster (1958; `timing.rs`), and the offsets of neighbours let platoons pass (`offsets.rs`).

mod approaches;
mod components;
mod conflicts;
mod flow_ratios;
mod lanes;
mod offsets;
mod stage;
mod stages;
mod timing;

use std::collections::BTreeSet;

use crate::chain::Position;
use crate::junction::{Junctions, Light, LightConflict, LightIndex, Program, SignalPlan};
use crate::network::Network;
use conflicts::{Conflicts, Rivals};
use flow_ratios::Flows;
pub use flow_ratios::LaneFlows;
use lanes::Lane;
use stage::Stage;
use timing::Timed;

/// The traffic for which programs are made.
#[derive(Clone, Copy)]
pub struct LightTraffic<'a> {
    /// Flow at a place [veh/s].
    pub flow: &'a dyn Fn(Position) -> f64,
    /// Flow of a queue on the lane at a place while its light is green [veh/s].
    pub saturation: &'a dyn Fn(Position) -> f64,
}

impl LightTraffic<'_> {
    /// Traffic of which nothing is known: the same light flow everywhere. Ours.
    const UNKNOWN: LightTraffic<'static> = LightTraffic { flow: &|_| 0.05, saturation: &|_| 0.5 };
}

/// The lights of a network, for which programs are made.
pub struct Lights<'a> {
    network: &'a Network,
    junctions: &'a Junctions,
    lanes: Vec<Lane>,
    /// For each light the lanes before it, by number.
    before: Vec<Vec<usize>>,
    conflicts: Vec<LightConflict>,
    rivals: Rivals,
    /// The lights of each junction.
    members: Vec<Vec<LightIndex>>,
    /// Number of pairs of lights that were compared.
    comparisons: u64,
}

impl<'a> Lights<'a> {
    fn new(network: &'a Network, junctions: &'a Junctions) -> Lights<'a> {
        let lanes = lanes::lanes(network, junctions);
        let mut before = vec![Vec::new(); junctions.lights.len()];
        lanes.iter().zip(0..).for_each(|(it, number)| before[it.light.at()].push(number));
        let Conflicts { found: conflicts, comparisons } = conflicts::between(junctions, &lanes);
        let rivals = conflicts::rivals(junctions.lights.len(), &conflicts);
        let mut members = conflicts::junctions(&rivals.any);
        members.retain(|it| it.len() > 1);
        Lights { network, junctions, lanes, before, conflicts, rivals, members, comparisons }
    }

    /// Only lights that conflict with none of those that are `given` a program.
    pub fn without(mut self, given: &BTreeSet<LightIndex>) -> Lights<'a> {
        self.members.retain(|it| !it.iter().any(|light| given.contains(light)));
        self
    }

    /// Whether none of them conflict.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// Programs for this `traffic`.
    pub fn programs(&self, traffic: &LightTraffic) -> Vec<SignalPlan> {
        let stages = self.stages(traffic).into_iter().filter(|it| it.len() > 1);
        offsets::coordinated(self, traffic, stages.map(Timed::by_webster).collect())
    }

    /// The largest sum of the critical flow ratios of a junction's stages, with programs made for `traffic`; 0 without
    /// any. At 1 no cycle is long enough.
    pub fn flow_ratio(&self, traffic: &LightTraffic) -> f64 {
        let sums = self.stages(traffic).into_iter().map(|it| it.iter().map(|it| it.flow_ratio).sum());
        sums.fold(0.0, f64::max)
    }

    /// The flows of each lane before a light, with the oncoming `traffic` that is green at the same time.
    pub fn lane_flows(&self, traffic: &LightTraffic) -> Vec<LaneFlows> {
        self.flows(traffic).at_lights(&self.rivals)
    }

    fn flows<'b>(&'b self, traffic: &'b LightTraffic) -> Flows<'b> {
        Flows { junctions: self.junctions, traffic, lanes: &self.lanes, before: &self.before }
    }

    /// The stages of each junction.
    fn stages(&self, traffic: &LightTraffic) -> Vec<Vec<Stage>> {
        let flows = self.flows(traffic);
        let stages = |members: &Vec<LightIndex>| {
            let numbers = members.iter().flat_map(|it| &self.before[it.at()]);
            let lanes: Vec<&Lane> = numbers.map(|it| &self.lanes[*it]).collect();
            stages::best(&flows, &self.rivals, &approaches::approaches(&lanes))
        };
        self.members.iter().map(stages).collect()
    }
}

impl Network {
    /// Its lights.
    pub fn lights(&self) -> Lights<'_> {
        Lights::new(self, &self.junctions)
    }

    /// Which traffic lights conflict with each other.
    pub fn light_conflicts(&self) -> Vec<LightConflict> {
        self.lights().conflicts
    }

    /// For each zone and each of its sides whether its drivers pass a light.
    pub fn lit_sides(&self) -> Vec<[bool; 2]> {
        let mut is_lit = vec![[false; 2]; self.junctions.zones.len()];
        for (zone, side) in lanes::lanes(self, &self.junctions).iter().flat_map(Lane::zones) {
            is_lit[zone.at()][usize::from(side)] = true;
        }
        is_lit
    }

    /// The same network with lights that follow these plans.
    pub fn with_signals(mut self, plans: &[SignalPlan]) -> Network {
        let given: BTreeSet<LightIndex> = plans.iter().flat_map(SignalPlan::lights).collect();
        self.junctions.made.retain(|it| !it.lights().any(|light| given.contains(&light)));
        self.junctions.follow(plans);
        self
    }

    /// The same network, whose lights without a program follow these plans.
    pub fn with_made_signals(mut self, made: Vec<SignalPlan>) -> Network {
        let lights: Vec<LightIndex> = self.junctions.made.iter().flat_map(SignalPlan::lights).collect();
        for light in lights {
            let Light { program, plan, .. } = &mut self.junctions.lights[light.at()];
            (*program, *plan) = (Program::ALWAYS_GREEN, None);
        }
        self.junctions.follow(&made);
        self.junctions.made = made;
        self
    }
}

/// Programs for lights without one, for traffic of which nothing is known. With them comes the number of pairs of
/// lights that were compared.
pub(crate) fn made_plans(network: &Network, junctions: &Junctions) -> (Vec<SignalPlan>, u64) {
    if junctions.programmed.len() == junctions.lights.len() {
        return (Vec::new(), 0);
    }
    let lights = Lights::new(network, junctions).without(&junctions.programmed);
    (lights.programs(&LightTraffic::UNKNOWN), lights.comparisons)
}
