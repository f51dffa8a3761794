//! Drivers whose decisions are observed exactly: what each saw when it considered lanes, and whether it wanted a
//! change.

use laneweave::models::change::{LaneChangeModel, Mcdm};
use laneweave::{Decision, Fault, Phase, SideEvaluation, Simulation};
use laneweave_calibration::{Choices, Fit, Prior};

use crate::experiments::effort::Effort;
use crate::experiments::traffic::{Change, Traffic};
use crate::in_parallel;

/// The terms that are fitted, in their order; the first is the intercept.
pub(crate) const TERMS: [&str; 4] = ["intercept", "speed and route", "comfort", "courtesy"];

/// A fit to drivers of one seed.
pub(crate) struct Exact {
    /// Number of desires among the epochs.
    pub(crate) desires: usize,
    pub(crate) fit: Fit,
    /// The true values of its parameters.
    pub(crate) truth: Vec<f64>,
}

/// Conservative drivers on 5 km of a motorway of two lanes, so long that there are about 950 changes.
pub(crate) fn traffic() -> Traffic {
    let mut traffic = Traffic::on_motorway(2, 1000.0);
    traffic.styles = vec![("conservative", 1.0)];
    traffic.times = [300.0, 850.0];
    // Their weights are to be found, not the law of the road.
    traffic.changes = vec![Change::Times("change.keeping.weight", 0.0)];
    traffic
}

/// Fits to the drivers of so many seeds, each observed for its own.
pub(crate) fn fits(effort: &Effort, count: u64) -> Result<Vec<Exact>, Fault> {
    let seeds: Vec<u64> = (1..=count).collect();
    in_parallel(&seeds, effort.threads, |seed| fit(*seed, effort.length))
}

fn fit(seed: u64, length: f64) -> Result<Exact, Fault> {
    let mut simulation = traffic().simulation(seed, length)?;
    let [warmup_steps, steps] = simulation.run_steps();
    (0..warmup_steps).for_each(|_| simulation.advance());
    let mut choices = Choices::new(TERMS.len());
    let mut truth = Vec::new();
    for _ in 0..steps {
        observe(&simulation, &mut choices, &mut truth);
        simulation.advance();
    }
    let desires = choices.epochs.iter().filter(|it| it.chosen.is_some()).count();
    let unclear = || Fault::new("recovery", "the drivers leave a weight open", "simulate for longer");
    let fit = choices.fit(&Prior::none(TERMS.len())).ok_or_else(unclear)?;
    Ok(Exact { desires, fit, truth })
}

/// Adds the epochs of all drivers who consider lanes in the next step.
fn observe(simulation: &Simulation, choices: &mut Choices, truth: &mut Vec<f64>) {
    let clock = simulation.clock();
    for vehicle in simulation.views() {
        if vehicle.driver.phase != Phase::Cruises || vehicle.driver.due > clock.step {
            continue;
        }
        let LaneChangeModel::Mcdm(model) = &vehicle.style().change else { continue };
        let Some(evaluation) = simulation.evaluate(vehicle.id()) else { continue };
        if !evaluation.is_concentrated || evaluation.has_last_chance {
            continue;
        }
        // The first side is that for overtaking.
        let of =
            |side: &SideEvaluation| usize::from(side.side != simulation.network().driving_side.overtaking());
        let chosen = match evaluation.decision {
            Decision::Wants { side, .. } => evaluation.sides.iter().find(|it| it.side == side).map(of),
            Decision::Stays => None,
            _ => continue,
        };
        let mut all = [None; 2];
        for side in evaluation.sides.iter().filter(|it| it.is_considered) {
            all[of(side)] = Some(terms(side, model));
        }
        if all.iter().all(Option::is_none) {
            continue;
        }
        choices.push(all.each_ref().map(|it| it.as_ref().map(|it| &it[..])), chosen, 1.0);
        if truth.is_empty() {
            *truth = true_values(model);
        }
    }
}

/// The terms of a side. On a motorway the route's yield is a second one of speed: the two are one term, in which they
/// have the proportion of the true weights.
fn terms(side: &SideEvaluation, model: &Mcdm) -> [f64; TERMS.len()] {
    let of = |name| side.reasons.iter().find(|it| it.incentive == name).map_or(0.0, |it| it.earning);
    let [speed, route, comfort, courtesy] = ["speed", "route", "comfort", "courtesy"].map(of);
    [1.0, speed + model.route.weight / model.speed.weight * route, comfort, courtesy]
}

fn true_values(model: &Mcdm) -> Vec<f64> {
    let by_noise = [-model.theta, model.speed.weight, model.comfort.weight, model.courtesy.weight];
    by_noise.map(|it| it / model.sigma).to_vec()
}
