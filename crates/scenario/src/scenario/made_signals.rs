//! The programs of lights without one, made for the demand of a scenario.

use std::collections::BTreeSet;
use std::sync::Arc;

use laneweave_network::{LightIndex, Lights, Network, SignalPlan};
use laneweave_sim::Assignment;
use laneweave_study::units::SECONDS_PER_HOUR;

use super::{MadeSignals, Scenario};
use crate::capacity::{Queues, with_traffic};

/// Programs for a demand of which only the distribution is known are made for this sum of critical flow ratios, at the
/// fullest junction. Ours: with a lost time of 10 s, its cycle is 100 s.
const FULL: f64 = 0.8;

/// The lights whose programs are made.
#[derive(Clone)]
pub(super) struct MadeLights {
    /// The lights to which the scenario or the map gives a program.
    given: BTreeSet<LightIndex>,
    kind: MadeSignals,
}

impl MadeLights {
    /// Those of `scenario`, which gives these `plans`, on its `network`.
    pub(super) fn of(scenario: &Scenario, plans: &[SignalPlan], network: &Network) -> MadeLights {
        let of_map = network.junctions.programmed.iter().copied();
        let given = plans.iter().flat_map(SignalPlan::lights).chain(of_map).collect();
        MadeLights { given, kind: scenario.made_signals }
    }

    /// Whether `network` has such lights.
    pub(super) fn are_on(&self, network: &Network) -> bool {
        !network.lights().without(&self.given).is_empty()
    }

    /// The same network with programs for `total` vehicles per second on the ways of `assignment`; `None`: for as many
    /// as the fullest junction bears.
    pub(super) fn programmed(
        &self,
        network: &Arc<Network>,
        assignment: &Assignment,
        queues: &Queues,
        total: Option<f64>,
    ) -> Arc<Network> {
        let lights = network.lights().without(&self.given);
        if lights.is_empty() || assignment.total <= 0.0 {
            return Arc::clone(network);
        }
        let growth = match total {
            Some(total) => total / assignment.total,
            None => growth(&lights, network, assignment, queues),
        };
        let made = with_traffic(network, assignment, queues, growth, |it| lights.programs(it));
        let made = match self.kind {
            MadeSignals::Fixed => made,
            MadeSignals::Actuated => made.into_iter().map(SignalPlan::actuated).collect(),
        };
        Arc::new(Network::clone(network).with_made_signals(made))
    }
}

/// The growth of all flows with which the fullest junction is full.
fn growth(lights: &Lights, network: &Network, assignment: &Assignment, queues: &Queues) -> f64 {
    const DOUBLINGS: u32 = 40;
    const HALVINGS: u32 = 8;
    let is_full =
        |growth: f64| with_traffic(network, assignment, queues, growth, |it| lights.flow_ratio(it)) > FULL;
    // From one vehicle an hour on.
    let (mut low, mut high) = (0.0, 1.0 / (SECONDS_PER_HOUR * assignment.total));
    let mut doublings = 0;
    while !is_full(high) && doublings < DOUBLINGS {
        (low, high) = (high, 2.0 * high);
        doublings += 1;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_full(middle) { high = middle } else { low = middle }
    }
    low
}
