//! Shares of two styles whose weights are known, among drivers whom a drone sees.

use laneweave::Fault;
use laneweave::models::change::Mcdm;

use crate::in_parallel;
use laneweave_calibration::observe::Options;
use laneweave_calibration::waiting::{Assumptions, Design, Layout};
use laneweave_calibration::{DesireModel, Mixture, assumptions};

use super::drone::{Driven, NOISE};
use super::settings::Setting;
use super::weights::{NO_SPREAD, mcdm};
use crate::experiments::effort::Effort;

/// The styles; the share of the second is what is looked for.
pub(crate) const STYLES: [&str; 2] = ["conservative", "aggressive"];
/// So many drivers are looked at.
const DRIVERS: usize = 400;
/// Steps between shares and what is not known of the styles.
const STEPS: usize = 20;

/// A share, with the true one among the same drivers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Share {
    pub(crate) found: f64,
    pub(crate) truth: f64,
    /// Mean time for which a driver was seen [s].
    pub(crate) seconds: f64,
}

/// The shares in recordings of so many seeds.
pub(crate) fn shares(effort: &Effort, count: u64) -> Result<Vec<Share>, Fault> {
    let seeds: Vec<u64> = (1..=count).collect();
    in_parallel(&seeds, effort.threads, |seed| share(&Driven::of(&Setting::long(), *seed, effort.length)?))
}

fn share(driven: &Driven) -> Result<Share, Fault> {
    let recording = driven.recorded(NOISE);
    let matched = driven.matched(&recording);
    let styles = STYLES.map(|name| driven.style(name));
    let [Some(first), Some(second)] = styles else {
        return Err(Fault::bug("recovery", "a style drives nowhere"));
    };
    let mut seen = driven.all_observations(&matched, &Options::of(first.clone()))?;
    seen.drivers.truncate(DRIVERS);
    let is_second = seen.drivers.iter().filter(|it| driven.style_of(it.vehicle) == STYLES[1]).count();
    let seconds = seen.seconds() as f64 / seen.drivers.len() as f64;
    let truth = is_second as f64 / seen.drivers.len() as f64;
    let models = [mcdm(first)?, mcdm(second)?];
    let design = seen.design(&DesireModel::Mcdm { beta: models[0].comfort.beta });
    let found = found(&design, models);
    Ok(Share { found, truth, seconds })
}

/// The share of the second style. What is known of a style are its threshold and its weights; how its drivers accept
/// gaps and give up is fitted, each driver as likely of the style as its changes make it.
fn found(design: &Design, styles: [&Mcdm; 2]) -> f64 {
    let known = styles.map(|it| known(design, it));
    let all = vec![1.0; design.drivers.len()];
    let start = known.each_ref().map(|it| design.fit_roughly(it, &all, None));
    let mut parameters: Vec<Vec<f64>> = start.iter().map(|it| it.estimates.clone()).collect();
    let mut mixture = Mixture::of_known(design, &known[0], parameters.clone(), &all);
    for _ in 0..STEPS {
        let chances = mixture.chances(design, &known[0], &all);
        for class in 0..STYLES.len() {
            let weights: Vec<f64> = chances.iter().map(|it| it[class]).collect();
            parameters[class] =
                design.refit(&known[class], &weights, &parameters[class], &start[class].covariance);
        }
        mixture = Mixture::of_known(design, &known[0], parameters.clone(), &all);
    }
    mixture.shares[1]
}

/// What is assumed of the drivers of a style.
fn known(design: &Design, model: &Mcdm) -> Assumptions {
    let layout = Layout::of(design);
    let mut assumed = assumptions(design, &vec![0.0; design.terms], 1e3, &NO_SPREAD);
    let weights = [model.speed.weight, model.comfort.weight, model.courtesy.weight];
    let known = [-model.theta].into_iter().chain(weights).map(|it| it / model.sigma);
    // No other incentive has a weight.
    let known = known.chain(std::iter::repeat(0.0));
    for (at, value) in [layout.intercept()].into_iter().chain(layout.slopes()).zip(known) {
        assumed.prior.means[at] = value;
        assumed.is_fixed[at] = true;
    }
    assumed.without_spread(design)
}
