//! How the demand of a scenario and the programs of its lights are settled: each depends on the other.

use std::sync::Arc;

use laneweave_network::Network;
use laneweave_sim::{Place, World};

use super::Scenario;
use super::basis::{Basis, USUAL_SHARE};
use super::demand::Amount;
use super::made_signals::MadeLights;
use crate::capacity::{Capacity, Estimate, Filling, Queues, inner_places};
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
    /// the scenario leaves it open, it is a share of what each origin bears, and none beside a recording.
    pub(super) fn settle(
        &self,
        network: &Arc<Network>,
        build: impl Fn(&Arc<Network>, Option<&Amount>) -> Result<World, Fault>,
    ) -> Result<(World, Basis), Fault> {
        let is_open = Basis::is_open(&self.scenario.demand);
        let is_estimated = is_open && !self.scenario.replay.is_asked();
        // The estimate depends on the shares of the demand, not on its amount: the smallest demand is enough.
        let smallest = is_open.then_some(Amount::Total(if is_estimated { 1.0 } else { 0.0 }));
        let world = build(network, smallest.as_ref())?;
        if !is_estimated && !self.made.are_on(network) {
            return Ok((world, Basis::Given));
        }
        let rates: Vec<f64> = origins(&world, self.measured).iter().map(|it| it.1).collect();
        let usual = if is_estimated { self.usual(&world, network, &rates) } else { None };
        let (assignment, is_known) = match &usual {
            Some(rates) => (world.assignment_of(rates), true),
            None => (world.assignment(self.measured), !is_estimated && rates.iter().any(|it| *it > 0.0)),
        };
        drop(world);
        let total = is_known.then_some(assignment.total);
        let network = self.made.programmed(network, &assignment, self.queues, total);
        let basis = match (is_estimated, &usual) {
            (false, _) => Basis::Given,
            (true, Some(_)) => Basis::Estimated,
            (true, None) => Basis::Usual,
        };
        let amount = if is_estimated { usual.map(Amount::Each) } else { smallest };
        Ok((build(&network, amount.as_ref())?, basis))
    }

    /// The default demand of each origin of `world` on `network` [veh/h], from demands in proportion to `rates` on;
    /// `None` without an estimate. They are whole numbers, so that they are the same on every machine.
    fn usual(&self, world: &World, network: &Arc<Network>, rates: &[f64]) -> Option<Vec<f64>> {
        let network = &self.made.programmed(network, &world.assignment(self.measured), self.queues, None);
        let inner_places = &inner_places(world.demand());
        let filled = Filling { world, network, inner_places, queues: self.queues }.fill(rates)?;
        Some(filled.into_iter().map(|it| (USUAL_SHARE * it).round().max(1.0)).collect())
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
