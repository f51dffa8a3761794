//! How the demand of a scenario and the programs of its lights are settled: each depends on the other.

use std::sync::Arc;

use laneweave_network::Network;
use laneweave_sim::{Assignment, Navigator, Place, Thinning, World};

use super::Scenario;
use super::basis::{Basis, FULLEST, USUAL_SHARE};
use super::demand::Amount;
use super::made_signals::MadeLights;
use crate::capacity::{Capacity, Estimate, Growth, Queues, inner_places};
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
    /// What `build` makes on the network with the programs for its demand. If the scenario leaves the demand open, it
    /// is a share of what each origin bears, and none beside a recording.
    pub(super) fn settle(
        &self,
        network: &Arc<Network>,
        build: impl Fn(&Arc<Network>, (Option<&Amount>, &[usize])) -> Result<World, Fault>,
    ) -> Result<Settled, Fault> {
        let is_open = Basis::is_open(&self.scenario.demand);
        let is_estimated = is_open && !self.scenario.replay.is_asked();
        // The estimate depends on the shares of the demand, not on its amount: the smallest demand is enough.
        let smallest = is_open.then_some(Amount::Total(if is_estimated { 1.0 } else { 0.0 }));
        let mut world = build(network, (smallest.as_ref(), &[]))?;
        let avoided = world.late_origins();
        if !avoided.is_empty() {
            world = build(network, (smallest.as_ref(), &avoided))?;
        }
        if !is_estimated && !self.made.are_on(network) {
            return Ok(Settled { world, basis: Basis::Given, capacity: None });
        }
        let usual = if is_estimated { self.usual(&world, network) } else { None };
        let is_given = || !is_estimated && origins(&world, self.measured).iter().any(|it| it.1 > 0.0);
        let (assignment, is_known) = match &usual {
            Some((rates, _)) => (world.assignment_of(rates, &Thinning::default()), true),
            None => (world.assignment(self.measured), is_given()),
        };
        drop(world);
        let total = is_known.then_some(assignment.total);
        let network = self.made.programmed(network, &assignment, self.queues, total);
        let basis = match (is_estimated, &usual) {
            (false, _) => Basis::Given,
            (true, Some(_)) => Basis::Estimated,
            (true, None) => Basis::Usual,
        };
        let (rates, capacity) = usual.unzip();
        let amount = if is_estimated { rates.map(Amount::Each) } else { smallest };
        Ok(Settled { world: build(&network, (amount.as_ref(), &avoided))?, basis, capacity })
    }

    /// The default demand of each origin of `world` on `network` [veh/h], and the estimated capacity for such a demand;
    /// `None` without an estimate. They are whole numbers, so that they are the same on every machine.
    fn usual(&self, world: &World, network: &Arc<Network>) -> Option<(Vec<f64>, Capacity)> {
        let inner_places = &inner_places(world.demand());
        let assign = &|rates: &[f64], thinning: &Thinning| world.assignment_of(rates, thinning);
        let programmed = |rates: &[f64]| {
            self.made.programmed(network, &assign(rates, &Thinning::default()), self.queues, None)
        };
        let rates = world.demand().mean_rates(network, self.measured);
        let network = &programmed(&rates);
        let borne = Growth::new(network, assign, inner_places, self.queues).fill(&rates)?;
        let network = &programmed(&borne);
        let capacity = Growth::new(network, assign, inner_places, self.queues).capacity(&borne);
        let demand = (USUAL_SHARE * capacity.veh_h).min(FULLEST * capacity.queues_from_veh_h);
        let share = demand / borne.iter().sum::<f64>();
        let whole = |it: f64| if it > 0.0 { (share * it).round().max(1.0) } else { 0.0 };
        Some((borne.into_iter().map(whole).collect(), capacity))
    }
}

/// A world with its demand.
pub(super) struct Settled {
    pub(super) world: World,
    pub(super) basis: Basis,
    /// The estimated capacity, if the demand is a share of it.
    pub(super) capacity: Option<Capacity>,
}

/// Where trips start in `world`, each with its mean demand between two times [s] [veh/h].
pub(super) fn origins(world: &World, [from, until]: [f64; 2]) -> Vec<(Place, f64)> {
    world.demand().origins.iter().map(|it| (it.place.clone(), it.rate.mean(from, until))).collect()
}

/// The estimated capacity of the map of `world` for its demand between two times [s]. Lights without a program get one
/// for as much of it as they bear.
pub(super) fn estimate(world: &World, measured: [f64; 2], queues: Queues, made: MadeLights) -> Estimate {
    let (network, demand) = (world.shared_network(), world.demand().clone());
    Estimate::new(Box::new(move || {
        // The world may know other routes by then.
        let navigator = Navigator::towards(&network, &demand.destinations);
        let assignment = Assignment::new(&network, &navigator, &demand, measured);
        let network = made.programmed(&network, &assignment, &queues, None);
        Capacity::of(&network, &navigator, (&demand, measured), &queues)
    }))
}
