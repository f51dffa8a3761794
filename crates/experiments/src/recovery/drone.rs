//! Drivers who are seen by a drone: their positions, 25 times a second, with errors of 10 cm.

use laneweave::Fault;
use laneweave::calibration::observe::{Known, Observations, Options, Origin, observe};
use laneweave::calibration::waiting::{Assumptions, Design, Layout};
use laneweave::calibration::{DesireModel, PlaceSpread, assumptions};
use laneweave::models::Style;
use laneweave::models::change::{LaneChangeModel, Mcdm};
use laneweave::network::Network;
use laneweave::recordings::{Drone, Matched, Recording, Watch, clean};
use laneweave::sim::Navigator;

use super::exact::traffic;
use super::truth::Truth;

/// The weights that are fitted; the threshold has its true value.
pub(crate) const WEIGHTS: [&str; 3] = ["speed and route", "comfort", "courtesy"];

/// Frames per second.
const FRAMES: f64 = 25.0;
/// Errors of positions [m].
pub(crate) const NOISE: f64 = 0.1;

/// What a fit to one recording found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Lane changes of the recording, and of them those that are used.
    pub(crate) changes: [usize; 2],
    /// The estimates as shares of the true weights, and their standard errors.
    pub(crate) shares: [f64; WEIGHTS.len()],
    pub(crate) errors: [f64; WEIGHTS.len()],
}

impl Seen {
    /// How many standard errors the estimate of a weight is off.
    pub(crate) fn off(&self, weight: usize) -> f64 {
        (self.shares[weight] - 1.0) / self.errors[weight]
    }
}

/// What is supposed of the way from a decision to a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Process {
    /// Nothing is known: drivers wait for a gap, give up, and want changes for which nothing in the record speaks.
    Waits,
    /// A desire is carried out within its second. Some have no reason in the record.
    AtOnce,
    /// The same, and all have one: a plain logit.
    PlainLogit,
}

/// Simulated drivers with the truth about them.
pub(crate) struct Driven {
    seed: u64,
    /// The traffic, exactly.
    traffic: Recording,
    network: Network,
    style: Style,
    /// What is true of the drivers.
    pub(crate) truth: Known,
}

impl Driven {
    /// Those of one seed, its times multiplied by `length`.
    pub(crate) fn of(seed: u64, length: f64) -> Result<Driven, Fault> {
        let mut prepared = traffic().prepared(seed, length)?;
        let world = &mut prepared.world;
        (0..prepared.warmup_steps).for_each(|_| world.step());
        let (mut watch, mut truth) = (Watch::from_now(world), Truth::from_now(world));
        for _ in 0..prepared.steps {
            watch.see(world);
            truth.see(world);
            world.step();
        }
        Ok(Driven {
            seed,
            traffic: watch.into_recording(),
            network: world.network().clone(),
            style: world.driver_parameters()[0].clone(),
            truth: truth.known(),
        })
    }

    /// What a drone records of them, with errors of `noise` [m].
    pub(crate) fn recorded(&self, noise: f64) -> Recording {
        let drone = Drone { noise, seed: self.seed + 1, ..Drone::exact(FRAMES) };
        clean(drone.observe(&self.traffic)).0
    }

    /// The recording with the places of its vehicles.
    pub(crate) fn matched<'a>(&'a self, recording: &'a Recording) -> Matched<'a> {
        Matched::new(&self.network, recording)
    }

    /// What the recording shows of drivers of whom this is known. They are looked at `phases` times in a second.
    pub(crate) fn observations(
        &self,
        matched: &Matched,
        known: Known,
        phases: u32,
    ) -> Result<Observations, Fault> {
        let options = Options { known, phases, ..Options::of(self.style.clone()) };
        let seen = observe(matched, &Navigator::new(&self.network), &options, Origin::default());
        seen.map_err(|error| Fault::new("recovery", error, "report this as a bug"))
    }

    /// Fits the weights; the threshold is known.
    pub(crate) fn fit(&self, observations: &Observations, process: Process) -> Result<Seen, Fault> {
        let LaneChangeModel::Mcdm(model) = &self.style.change else {
            return Err(Fault::new("recovery", "the drivers have no weights", "report this as a bug"));
        };
        let design = observations.design(&DesireModel::Mcdm { beta: model.comfort.beta });
        let fit = design.fit(&assumed(&design, model, process), &vec![1.0; design.drivers.len()]);
        let truth = [model.speed.weight, model.comfort.weight, model.courtesy.weight];
        let at = |number: usize| fit.layout.slopes().start + number;
        let truth = truth.map(|it| it / model.sigma);
        Ok(Seen {
            changes: [observations.changes.len(), observations.used().count()],
            shares: [0, 1, 2].map(|it| fit.estimates[at(it)] / truth[it]),
            errors: [0, 1, 2].map(|it| fit.standard_error(at(it)) / truth[it]),
        })
    }
}

/// What is assumed in a fit: the threshold has its true value, and of the weights nothing is assumed.
fn assumed(design: &Design, model: &Mcdm, process: Process) -> Assumptions {
    /// A logit of a chance of 1.
    const CERTAIN: f64 = 700.0;
    let layout = Layout::of(design);
    // The road has no places that differ.
    let none = PlaceSpread { lanes: 1e-3, distances: 1e-3 };
    let mut assumed = assumptions(design, &[0.0; 4], 1e3, &none);
    let mut know = |parameter: usize, value: f64| {
        assumed.prior.means[parameter] = value;
        assumed.is_fixed[parameter] = true;
    };
    know(layout.intercept(), -model.theta / model.sigma);
    know(layout.slopes().start + WEIGHTS.len(), 0.0);
    know(layout.spread(), 0.0);
    if process != Process::Waits {
        layout.acceptance().for_each(|it| know(it, 0.0));
        know(layout.acceptance().start, CERTAIN);
        know(layout.waiting(), -CERTAIN);
        know(layout.giving_up(), 0.0);
    }
    if process == Process::PlainLogit {
        know(layout.background(), -CERTAIN);
    }
    assumed.has_spread = false;
    assumed
}
