//! How the demand of a scenario and the programs of its lights are settled: each depends on the other.

use std::sync::Arc;

use laneweave_network::Network;
use laneweave_sim::{Place, World};
use laneweave_study::units::SECONDS_PER_HOUR;

use super::Scenario;
use super::basis::{Basis, usual};
use super::made_signals::MadeLights;
use crate::capacity::{Capacity, Estimate, Queues, inner_places};
use crate::fault::Fault;

/// How the demand of a scenario, and the made programs of lights for it, are settled.
pub(super) struct Settling<'a> {
    pub(super) scenario: &'a Scenario,
    /// From when to when the run is measured [s].
    pub(super) measured: [f64; 2],
    pub(super) queues: &'a Queues,
    pub(super) made: &'a MadeLights,
}

impl Settling<'_> {
    /// The world that `build` makes on the network with the programs for its demand, and the basis of that demand. If
    /// the scenario leaves it open, it is a share of the capacity, and none beside a recording.
    pub(super) fn settle(
        &self,
        network: &Arc<Network>,
        build: impl Fn(&Arc<Network>, Option<f64>) -> Result<World, Fault>,
    ) -> Result<(World, Basis), Fault> {
        let is_open = Basis::is_open(&self.scenario.demand);
        let is_estimated = is_open && !self.scenario.replay.is_asked();
        // The estimate depends on the shares of the demand, not on its amount: the smallest demand is enough.
        let world = build(network, is_open.then_some(if is_estimated { 1.0 } else { 0.0 }))?;
        if !is_estimated && !self.made.are_on(network) {
            return Ok((world, Basis::Given));
        }
        let assignment = world.assignment(self.measured);
        let (inner_places, origins) = (inner_places(world.demand()), origins(&world, self.measured));
        drop(world);
        let programmed = |total: Option<f64>| self.made.programmed(network, &assignment, self.queues, total);
        if !is_estimated {
            let total: f64 = origins.iter().map(|it| it.1).sum();
            let network = programmed((total > 0.0).then_some(assignment.total));
            return Ok((build(&network, is_open.then_some(0.0))?, Basis::Given));
        }
        let capacity = Capacity::of(&programmed(None), &assignment, &inner_places, self.queues);
        let total = usual(&capacity);
        let network = programmed(total.map(|it| it / SECONDS_PER_HOUR));
        let basis = if total.is_some() { Basis::Estimated } else { Basis::Usual };
        Ok((build(&network, total)?, basis))
    }
}

/// Where trips start in `world`, each with its mean demand between two times [s] [veh/h].
pub(super) fn origins(world: &World, [from, until]: [f64; 2]) -> Vec<(Place, f64)> {
    world.demand().origins.iter().map(|it| (it.place.clone(), it.rate.mean(from, until))).collect()
}

/// The estimated capacity of the map of `world` for its demand between two times [s]. Lights without a program get one
/// for as much of it as they bear.
pub(super) fn estimate(world: &World, measured: [f64; 2], queues: Queues, made: MadeLights) -> Estimate {
    // The world may learn of other routes before somebody asks.
    let assignment = world.assignment(measured);
    let (network, inner_places) = (world.shared_network(), inner_places(world.demand()));
    Estimate::new(Box::new(move || {
        let network = made.programmed(&network, &assignment, &queues, None);
        Capacity::of(&network, &assignment, &inner_places, &queues)
    }))
}
