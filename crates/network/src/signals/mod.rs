//! Signal programs for lights without one, as a traffic engineer would draw them by hand.
//!
//! `lanes.rs` finds the lanes before each light and the ways beyond it, and `conflicts.rs` which lights conflict. The
//! lanes of a road are its approach (`approaches.rs`). Opposing approaches are green together, and turns across
//! oncoming traffic are permitted or protected (`stages.rs`), as the flows demand (`flow_ratios.rs`). Cycle and greens
//! follow Webster (1958; `timing.rs`), and the offsets of neighbours let platoons pass (`offsets.rs`).

mod approaches;
mod conflicts;
mod flow_ratios;
mod lanes;
mod offsets;
mod stage;
mod stages;
mod timing;

use std::collections::BTreeSet;

use crate::chain::Position;
use crate::junction::{Junctions, LightConflict, LightIndex, SignalPlan};
use crate::network::Network;
use conflicts::Conflicts;
use flow_ratios::Flows;
pub use flow_ratios::LaneFlows;
use lanes::Lane;
use stage::Stage;
use timing::{Timed, webster};

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

/// The junction of lights that conflict, with the stages of its program.
struct Junction {
    stages: Vec<Stage>,
    /// Sum of the flow ratios of its stages.
    flow_ratio: f64,
}

impl Network {
    /// Which traffic lights conflict with each other.
    pub fn light_conflicts(&self) -> Vec<LightConflict> {
        conflicts::between(&self.junctions, &lanes::lanes(self, &self.junctions)).found
    }

    /// For each zone and each of its sides whether its drivers pass a light.
    pub fn lit_sides(&self) -> Vec<[bool; 2]> {
        let mut is_lit = vec![[false; 2]; self.junctions.zones.len()];
        for (zone, side) in lanes::lanes(self, &self.junctions).iter().flat_map(Lane::zones) {
            is_lit[zone.at()][usize::from(side)] = true;
        }
        is_lit
    }

    /// Programs for this `traffic`, for the lights that have a made program and are not `given` another one.
    pub fn made_signals(&self, traffic: &LightTraffic, given: &BTreeSet<LightIndex>) -> Vec<SignalPlan> {
        plans(self, &self.junctions, traffic, given).0
    }

    /// The largest sum of the critical flow ratios of a junction's stages, with these programs made for `traffic`; 0
    /// without any. At 1 no cycle is long enough.
    pub fn flow_ratio(&self, traffic: &LightTraffic, given: &BTreeSet<LightIndex>) -> f64 {
        let (junctions, _) = junctions(self, &self.junctions, traffic, given);
        junctions.iter().map(|it| it.flow_ratio).fold(0.0, f64::max)
    }

    /// The flows of each lane before a light, with the oncoming `traffic` that is green at the same time.
    pub fn lane_flows(&self, traffic: &LightTraffic) -> Vec<LaneFlows> {
        let lanes = lanes::lanes(self, &self.junctions);
        let found = conflicts::between(&self.junctions, &lanes).found;
        let flows = Flows { junctions: &self.junctions, traffic, lanes: &lanes };
        flows.at_lights(&conflicts::rivals(self.junctions.lights.len(), &found))
    }

    /// The same network with lights that follow these plans.
    pub fn with_signals(mut self, plans: &[SignalPlan]) -> Network {
        self.junctions.follow(plans);
        self
    }

    /// The same network, whose lights without a program follow these plans.
    pub fn with_made_signals(mut self, made: Vec<SignalPlan>) -> Network {
        self.junctions.follow(&made);
        self.junctions.made = made;
        self
    }
}

/// Programs for lights without one, for traffic of which nothing is known. With them comes the number of pairs of
/// lights that were compared.
pub(crate) fn made_plans(network: &Network, junctions: &Junctions) -> (Vec<SignalPlan>, u64) {
    plans(network, junctions, &LightTraffic::UNKNOWN, &BTreeSet::new())
}

fn plans(
    network: &Network,
    on: &Junctions,
    traffic: &LightTraffic,
    given: &BTreeSet<LightIndex>,
) -> (Vec<SignalPlan>, u64) {
    let (all, comparisons) = junctions(network, on, traffic, given);
    let timed: Vec<Timed> = all.into_iter().map(|it| Timed::by_webster(it.stages)).collect();
    (offsets::coordinated(network, on, traffic, timed), comparisons)
}

/// The junctions whose lights have no program, and the number of pairs of lights that were compared.
fn junctions(
    network: &Network,
    on: &Junctions,
    traffic: &LightTraffic,
    given: &BTreeSet<LightIndex>,
) -> (Vec<Junction>, u64) {
    let lanes = lanes::lanes(network, on);
    let Conflicts { found, comparisons } = conflicts::between(on, &lanes);
    let flows = Flows { junctions: on, traffic, lanes: &lanes };
    let rivals = conflicts::rivals(on.lights.len(), &found);
    let mut junctions = Vec::new();
    for members in conflicts::junctions(&rivals.any) {
        if members.iter().any(|it| given.contains(it)) {
            continue;
        }
        let approaches = approaches::approaches(&lanes, &members);
        let best = stages::choices(&flows, &rivals, &approaches)
            .into_iter()
            .map(|stages| flows.measured(stages))
            .min_by(|a, b| webster(a).total_cmp(&webster(b)));
        if let Some(mut stages) = best.filter(|it| it.len() > 1) {
            stages::extend(&rivals, &mut stages);
            let flow_ratio = stages.iter().map(|it| it.flow_ratio).sum();
            junctions.push(Junction { stages, flow_ratio });
        }
    }
    (junctions, comparisons)
}
