//! Fits of the weights of drivers whom a drone sees. Their threshold and their choice noise are known.

use laneweave::Fault;
use laneweave::models::Style;
use laneweave::models::change::{LaneChangeModel, Mcdm};
use laneweave_calibration::observe::Observations;
use laneweave_calibration::waiting::{Assumptions, Design, Layout, WaitingFit};
use laneweave_calibration::{DesireModel, PlaceSpread, assumptions, resampled};

use super::drone::Driven;

/// The weights that are fitted.
pub(crate) const WEIGHTS: [&str; 3] = ["speed and route", "comfort", "courtesy"];

/// Draws of the bootstrap.
const DRAWS: u32 = 400;

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

/// A fit to what was observed.
pub(crate) struct WeightFit<'a> {
    observations: &'a Observations,
    design: Design,
    assumed: Assumptions,
    truth: [f64; WEIGHTS.len()],
    seed: u64,
}

impl<'a> WeightFit<'a> {
    /// A fit to `observations` of drivers.
    pub(crate) fn of(
        driven: &Driven,
        observations: &'a Observations,
        process: Process,
    ) -> Result<WeightFit<'a>, Fault> {
        let model = mcdm(&driven.style)?;
        let design = observations.design(&DesireModel::Mcdm { beta: model.comfort.beta });
        let spread = if driven.has_places { PlaceSpread::of_places(observations) } else { NO_SPREAD };
        let assumed = assumed(&design, model, &spread, process);
        let truth = [model.speed.weight, model.comfort.weight, model.courtesy.weight];
        let truth = truth.map(|it| it / model.sigma);
        Ok(WeightFit { observations, design, assumed, truth, seed: driven.seed })
    }

    /// The weights with the errors of a bootstrap.
    pub(crate) fn whole(&self) -> Seen {
        let all = vec![1.0; self.design.drivers.len()];
        let fit = self.design.fit(&self.assumed, &all);
        let resampled: Vec<Vec<f64>> =
            (0..DRAWS).map(|it| resampled(self.observations, self.seed, it)).collect();
        let maximum = (&fit.estimates[..], Some(&fit.covariance));
        let draws = self.design.redrawn(&self.assumed, &all, maximum, &resampled);
        let error = |at: usize| {
            let squares: f64 = draws.iter().map(|it| (it[at] - fit.estimates[at]).powi(2)).sum();
            (squares / f64::from(DRAWS)).sqrt()
        };
        self.seen(&fit, error)
    }

    /// The weights to a hundredth of a standard error, by a search from a `similar` fit on. Errors are those by the
    /// squares of the drivers' scores.
    pub(crate) fn rough(&self, similar: Option<&WaitingFit>) -> (Seen, WaitingFit) {
        let similar = similar.filter(|it| it.layout == Layout::of(&self.design));
        let fit = self.design.fit_roughly(&self.assumed, &vec![1.0; self.design.drivers.len()], similar);
        (self.seen(&fit, |at| fit.standard_error(at)), fit)
    }

    /// The fitted weights as shares of the true ones.
    fn seen(&self, fit: &WaitingFit, error: impl Fn(usize) -> f64) -> Seen {
        let at = |number: usize| fit.layout.slopes().start + number;
        let Observations { changes, .. } = self.observations;
        Seen {
            changes: [changes.len(), self.observations.used().count()],
            shares: [0, 1, 2].map(|it| fit.estimates[at(it)] / self.truth[it]),
            errors: [0, 1, 2].map(|it| error(at(it)) / self.truth[it]),
        }
    }
}

/// The spread of places that do not differ.
pub(crate) const NO_SPREAD: PlaceSpread = PlaceSpread { lanes: 1e-3, distances: 1e-3 };

/// The model of a style.
pub(crate) fn mcdm(style: &Style) -> Result<&Mcdm, Fault> {
    match &style.change {
        LaneChangeModel::Mcdm(model) => Ok(model),
        _ => Err(Fault::bug("recovery", "the drivers have no weights")),
    }
}

/// What is assumed in a fit: the threshold has its true value, and of the weights nothing is assumed.
fn assumed(design: &Design, model: &Mcdm, spread: &PlaceSpread, process: Process) -> Assumptions {
    /// A logit of a chance of 1.
    const CERTAIN: f64 = 700.0;
    let layout = Layout::of(design);
    let mut assumed = assumptions(design, &vec![0.0; design.terms], 1e3, spread);
    let mut know = |parameter: usize, value: f64| {
        assumed.prior.means[parameter] = value;
        assumed.is_fixed[parameter] = true;
    };
    know(layout.intercept(), -model.theta / model.sigma);
    layout.slopes().skip(WEIGHTS.len()).for_each(|it| know(it, 0.0));
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
