//! The programs of lights without one, made for the demand of a scenario.

use std::collections::BTreeSet;
use std::sync::Arc;

use laneweave_network::{LightIndex, Network, SignalPlan};
use laneweave_sim::Assignment;

use super::{MadeSignals, Scenario};
use crate::capacity::{Queues, with_traffic};

/// Programs for a demand of which only the distribution is known are made for this sum of critical flow ratios, at the
/// fullest junction. Ours: with a lost time of 10 s, its cycle is 100 s.
const FULL: f64 = 0.8;

/// The lights whose programs are made.
#[derive(Clone)]
pub(super) struct MadeLights {
    /// The lights to which the scenario gives a program.
    given: BTreeSet<LightIndex>,
    kind: MadeSignals,
}

impl MadeLights {
    /// Those of `scenario`, which gives these `plans`.
    pub(super) fn of(scenario: &Scenario, plans: &[SignalPlan]) -> MadeLights {
        let given = plans.iter().flat_map(SignalPlan::lights).collect();
        MadeLights { given, kind: scenario.made_signals }
    }

    /// Whether `network` has such lights.
    pub(super) fn are_on(&self, network: &Network) -> bool {
        network.junctions.made.iter().any(|it| !it.lights().any(|light| self.given.contains(&light)))
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
        if !self.are_on(network) || assignment.total <= 0.0 {
            return Arc::clone(network);
        }
        let growth = match total {
            Some(total) => total / assignment.total,
            None => self.growth(network, assignment, queues),
        };
        let made =
            with_traffic(network, assignment, queues, growth, |it| network.made_signals(it, &self.given));
        let made = match self.kind {
            MadeSignals::Fixed => made,
            MadeSignals::Actuated => made.into_iter().map(SignalPlan::actuated).collect(),
        };
        Arc::new(Network::clone(network).with_made_signals(made))
    }

    /// The growth of all flows with which the fullest junction is full. Equivalents grow with the flows, so it takes
    /// some steps.
    fn growth(&self, network: &Network, assignment: &Assignment, queues: &Queues) -> f64 {
        const STEPS: usize = 6;
        let mut growth = 1.0;
        for _ in 0..STEPS {
            let ratio =
                with_traffic(network, assignment, queues, growth, |it| network.flow_ratio(it, &self.given));
            if ratio <= 0.0 {
                return growth;
            }
            growth *= FULL / ratio;
        }
        growth
    }
}
