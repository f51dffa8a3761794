//! Drivers who are seen by a drone: their positions, 25 times a second, with errors of 10 cm.

use laneweave::calibration::observe::{Observations, Options, Origin, observe};
use laneweave::calibration::waiting::{Layout, WaitingFit};
use laneweave::calibration::{DesireModel, PlaceSpread, assumptions};
use laneweave::models::change::{LaneChangeModel, Mcdm};
use laneweave::recordings::{Drone, Matched, Watch, clean};
use laneweave::sim::{Navigator, World};
use laneweave::{Fault, in_parallel};

use super::exact::traffic;
use crate::effort::Effort;

/// The weights that are fitted; the threshold has its true value.
pub(crate) const WEIGHTS: [&str; 3] = ["speed and route", "comfort", "courtesy"];

/// Frames per second, and errors of positions [m].
const FRAMES: f64 = 25.0;
const NOISE: f64 = 0.1;

/// What a fit to one recording found.
pub(crate) struct Seen {
    /// Lane changes of the recording, and of them those that are used.
    pub(crate) changes: [usize; 2],
    /// The estimates as shares of the true weights, and their standard errors.
    pub(crate) shares: [f64; WEIGHTS.len()],
    pub(crate) errors: [f64; WEIGHTS.len()],
}

/// Fits to the recordings of so many seeds.
pub(crate) fn fits(effort: &Effort, count: u64) -> Result<Vec<Seen>, Fault> {
    let seeds: Vec<u64> = (1..=count).collect();
    in_parallel(&seeds, effort.threads, |seed| {
        let mut prepared = traffic().prepared(*seed, effort.length)?;
        (0..prepared.warmup_steps).for_each(|_| prepared.world.step());
        let observations = observations(&mut prepared.world, prepared.steps, *seed)?;
        fit(&prepared.world, &observations)
    })
}

/// What a drone sees of the next `steps` of a world.
fn observations(world: &mut World, steps: u32, seed: u64) -> Result<Observations, Fault> {
    let mut watch = Watch::from_now(world);
    for _ in 0..steps {
        watch.see(world);
        world.step();
    }
    let drone = Drone { noise: NOISE, seed: seed + 1, ..Drone::exact(FRAMES) };
    let recording = clean(drone.observe(&watch.into_recording())).0;
    let network = world.network().clone();
    let matched = Matched::new(&network, &recording);
    let options = Options::of(world.driver_parameters()[0].clone());
    let seen = observe(&matched, &Navigator::new(&network), &options, Origin::default());
    seen.map_err(|error| Fault::new("recovery", error, "report this as a bug"))
}

/// Fits the weights; the threshold is known.
fn fit(world: &World, observations: &Observations) -> Result<Seen, Fault> {
    let LaneChangeModel::Mcdm(model) = &world.driver_parameters()[0].change else {
        return Err(Fault::new("recovery", "the drivers have no weights", "report this as a bug"));
    };
    let design = observations.design(&DesireModel::Mcdm { beta: model.comfort.beta });
    let layout = Layout::of(&design);
    // The road has no places that differ, and nothing is assumed of the weights.
    let none = PlaceSpread { lanes: 1e-3, distances: 1e-3 };
    let mut assumed = assumptions(&design, &[0.0; 4], 1e3, &none);
    let mut know = |parameter: usize, value: f64| {
        assumed.prior.means[parameter] = value;
        assumed.is_fixed[parameter] = true;
    };
    know(layout.intercept(), -model.theta / model.sigma);
    know(layout.slopes().start + WEIGHTS.len(), 0.0);
    know(layout.spread(), 0.0);
    assumed.has_spread = false;
    let fit = design.fit(&assumed, &vec![1.0; design.drivers.len()]);
    Ok(Seen::of(&fit, observations, model))
}

impl Seen {
    fn of(fit: &WaitingFit, observations: &Observations, model: &Mcdm) -> Seen {
        let truth = [model.speed.weight, model.comfort.weight, model.courtesy.weight];
        let at = |number: usize| fit.layout.slopes().start + number;
        let truth = truth.map(|it| it / model.sigma);
        Seen {
            changes: [observations.changes.len(), observations.used().count()],
            shares: [0, 1, 2].map(|it| fit.estimates[at(it)] / truth[it]),
            errors: [0, 1, 2].map(|it| fit.standard_error(at(it)) / truth[it]),
        }
    }
}
