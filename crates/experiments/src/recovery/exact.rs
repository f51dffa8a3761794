//! Drivers whose decisions are observed exactly: what each saw when it considered lanes, and whether it wanted a
//! change.

use laneweave::Fault;
use laneweave::calibration::{Choices, Fit, Prior};
use laneweave::in_parallel;
use laneweave::models::Concentration;
use laneweave::models::change::{LaneChangeModel, Mcdm, Row};
use laneweave::sim::{Act, Phase, SideAccount, World, explain};

use crate::effort::Effort;
use crate::traffic::Traffic;

/// The terms that are fitted, in their order; the first is the intercept.
pub(crate) const TERMS: [&str; 4] = ["intercept", "speed and route", "comfort", "courtesy"];

/// A fit to drivers of one seed.
pub(crate) struct Exact {
    /// Number of desires among the epochs.
    pub(crate) desires: usize,
    /// The fit.
    pub(crate) fit: Fit,
    /// The true values of its parameters.
    pub(crate) truth: Vec<f64>,
}

/// Conservative drivers on 5 km of a motorway of two lanes, so long that there are about 950 changes.
pub(crate) fn traffic() -> Traffic {
    let mut traffic = Traffic::on_motorway(2, 1000.0);
    traffic.styles = vec![("conservative", 1.0)];
    traffic.times = [300.0, 850.0];
    traffic
}

/// Fits to the drivers of so many seeds, each observed for its own.
pub(crate) fn fits(effort: &Effort, count: u64) -> Result<Vec<Exact>, Fault> {
    let seeds: Vec<u64> = (1..=count).collect();
    in_parallel(&seeds, effort.threads, |seed| fit(*seed, effort.length))
}

fn fit(seed: u64, length: f64) -> Result<Exact, Fault> {
    let mut prepared = traffic().prepared(seed, length)?;
    let world = &mut prepared.world;
    (0..prepared.warmup_steps).for_each(|_| world.step());
    let mut choices = Choices::new(TERMS.len());
    let mut truth = Vec::new();
    for _ in 0..prepared.steps {
        observe(world, &mut choices, &mut truth);
        world.step();
    }
    let desires = choices.epochs.iter().filter(|it| it.chosen.is_some()).count();
    let unclear = || Fault::new("recovery", "the drivers leave a weight open", "simulate for longer");
    let fit = choices.fit(&Prior::none(TERMS.len())).ok_or_else(unclear)?;
    Ok(Exact { desires, fit, truth })
}

/// Adds the epochs of all drivers who consider lanes in the next step.
fn observe(world: &World, choices: &mut Choices, truth: &mut Vec<f64>) {
    let scene = world.scene();
    for vehicle in world.vehicles() {
        let driver = scene.driver(vehicle.spot);
        if driver.phase != Phase::Cruises || driver.due > world.clock().step {
            continue;
        }
        let account = explain(world, vehicle.spot);
        let LaneChangeModel::Mcdm(model) = &*account.change else { continue };
        if account.state != Concentration::Concentrated || account.has_last_chance {
            continue;
        }
        let chosen = match account.act {
            Act::Wants(side, _) => {
                account.sides.iter().position(|it| it.as_ref().is_some_and(|it| it.side == side))
            }
            Act::Stays => None,
            _ => continue,
        };
        let terms = account
            .sides
            .each_ref()
            .map(|it| it.as_ref().filter(|it| !it.is_out_of_question).map(|it| terms(it, model)));
        if terms.iter().all(Option::is_none) {
            continue;
        }
        choices.push(terms.each_ref().map(|it| it.as_ref().map(|it| &it[..])), chosen, 1.0);
        if truth.is_empty() {
            *truth = true_values(model);
        }
    }
}

/// The terms of a side. On a motorway the route's yield is a second one of speed: the two are one term, in which they
/// have the proportion of the true weights.
fn terms(side: &SideAccount, model: &Mcdm) -> [f64; TERMS.len()] {
    let [speed, route, comfort, courtesy, ..] = side.appraisal.rows.map(|it: Row| it.earning);
    [1.0, speed + model.route.weight / model.speed.weight * route, comfort, courtesy]
}

fn true_values(model: &Mcdm) -> Vec<f64> {
    let by_noise = [-model.theta, model.speed.weight, model.comfort.weight, model.courtesy.weight];
    by_noise.map(|it| it / model.sigma).to_vec()
}
