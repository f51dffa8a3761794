//! A whole fit: the weights with their errors, what the data leave open, and how well models predict.

use crate::classes::{Mixture, are_two};
use crate::desire_model::{DesireModel, assumptions};
use crate::held_out::{Candidate, Difference, Folds, interval};
use crate::matrix::Matrix;
use crate::observe::{Observations, PLAIN};
use crate::place_spread::{PlaceSpread, effect};
use crate::prior::Prior;
use crate::resample::resampled;
use crate::waiting::{Assumptions, Design, Layout, NO_STRATUM, WaitingFit};

/// What is known of the weights before a recording is seen, in units of the choice noise σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PriorWeights {
    /// μ₁ of speed.
    pub speed: f64,
    /// μ₂ of the route.
    pub route: f64,
    /// μ₃ of comfort.
    pub comfort: f64,
    /// μ₄ of courtesy.
    pub courtesy: f64,
    /// The weights of the [`PLAIN`] incentives.
    pub plain: [f64; PLAIN.len()],
    /// β of comfort.
    pub beta: f64,
    /// α of coming back [1/(s·m)].
    pub alpha: f64,
}

/// What is asked of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Asked {
    /// What is expected of the weights before any data.
    pub prior: PriorWeights,
    /// Draws of the bootstrap over drivers.
    pub draws: u32,
    /// How drivers are held out.
    pub folds: Folds,
    /// Number of classes.
    pub classes: Classes,
}

/// A fitted number.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Its name.
    pub name: &'static str,
    /// The estimate.
    pub estimate: f64,
    /// Its standard error by the information matrix.
    pub standard_error: f64,
    /// Its 95 % interval: by the bootstrap, or by the standard error if there are no draws.
    pub interval: [f64; 2],
    /// What was assumed before.
    pub prior: f64,
    /// Whether the recording tells it.
    pub is_identified: bool,
}

/// β of comfort by its profile likelihood.
#[derive(Clone, Debug, PartialEq)]
pub struct BetaProfile {
    /// The values that were tried, and the log-likelihood at each, less the largest.
    pub profile: Vec<(f64, f64)>,
    /// The one that is used.
    pub beta: f64,
    /// The values whose likelihood is not significantly less.
    pub interval: [f64; 2],
    /// Whether the interval ends on both sides within the values that were tried.
    pub is_identified: bool,
}

/// A model beside multi-criteria decision-making.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The model with its fit.
    pub candidate: Candidate,
    /// By how much it predicts better than a constant chance [nats per change].
    pub over_constant: Difference,
    /// By how much multi-criteria decision-making predicts better than it [nats per change].
    pub mcdm_over_it: Difference,
    /// Both at sites that were held out; `None` if there is one site only.
    pub elsewhere: Option<[Difference; 2]>,
}

/// A fit of a style to observations.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Those of the terms of multi-criteria decision-making; speed with the route in the proportion of the prior.
    pub weights: Vec<Fitted>,
    /// θ, in units of the choice noise.
    pub theta: Fitted,
    /// β.
    pub beta: BetaProfile,
    /// How much places differ.
    pub spread: PlaceSpread,
    /// Scale of the prior: change of the log-odds for a standard deviation of a yield.
    pub effect: f64,
    /// The logarithm of the mean odds of all places, over those of a place of the mean intercept: a driver who knows no
    /// places has a threshold that is less by this.
    pub mean_place: f64,
    /// The fit of the whole process.
    pub fit: WaitingFit,
    /// All parameters of each draw of the bootstrap.
    pub draws: Vec<Vec<f64>>,
    /// The models that were compared; none if that was not asked.
    pub compared: Vec<Compared>,
    /// The classes of drivers, if there are several.
    pub mixture: Option<Mixture>,
    /// For each class all parameters of each draw of the bootstrap.
    pub class_draws: Vec<Vec<Vec<f64>>>,
}

/// How many classes of drivers there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Classes {
    /// Two if the data support it, otherwise one.
    Auto,
    /// So many.
    Exactly(usize),
}

/// Values of β that are tried.
const BETAS: [f64; 8] = [0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0];
/// Half of the 95 % point of χ² with one degree of freedom.
const SIGNIFICANT: f64 = 1.920_729;

impl PriorWeights {
    /// Those of the terms of multi-criteria decision-making.
    pub fn terms(&self) -> Vec<f64> {
        [self.speed, self.comfort, self.courtesy].into_iter().chain(self.plain).collect()
    }
}

impl Study {
    /// Fits a style to `observations`, and compares its model with others.
    pub fn of(observations: &Observations, asked: &Asked) -> Study {
        let study = Study::alone(observations, asked);
        let model = DesireModel::Mcdm { beta: study.beta.beta };
        let compared = compared(observations, &model, &study.spread, asked);
        Study { compared, ..study }
    }

    /// Fits a style to `observations`, without a comparison of models.
    pub fn alone(observations: &Observations, asked: &Asked) -> Study {
        let (spread, effect) = spreads(observations, &asked.prior);
        let beta = BetaProfile::of(observations, &asked.prior, effect, &spread);
        let model = DesireModel::Mcdm { beta: beta.beta };
        let design = observations.design(&model);
        let assumptions = assumptions(&design, &asked.prior.terms(), effect, &spread);
        let fit = design.fit(&assumptions, &vec![1.0; design.drivers.len()]);
        let resampled: Vec<Vec<f64>> =
            (0..asked.draws).map(|number| resampled(observations, asked.folds.seed, number)).collect();
        let all = vec![1.0; design.drivers.len()];
        let maximum = (&fit.estimates[..], Some(&fit.covariance));
        let draws = design.redrawn(&assumptions, &all, maximum, &resampled);
        let layout = fit.layout;
        let weights = weights(&fit, &draws, &asked.prior, &assumptions.prior);
        let prior_theta = -assumptions.prior.means[layout.intercept()];
        let theta = Fitted::of_parameter("theta", (layout.intercept(), -1.0), &fit, &draws, prior_theta);
        let mean_place = mean_place(&design, &fit);
        let mixture = mixture(&design, &assumptions, &fit, asked);
        let redrawn = |it: &Mixture| it.redrawn(&design, &assumptions, &fit, &resampled);
        let class_draws = mixture.as_ref().map_or(Vec::new(), redrawn);
        let compared = Vec::new();
        Study { weights, theta, beta, spread, effect, mean_place, fit, draws, compared, mixture, class_draws }
    }
}

/// How much places differ, and how much the terms of multi-criteria decision-making do.
fn spreads(observations: &Observations, prior: &PriorWeights) -> (PlaceSpread, f64) {
    let spread = PlaceSpread::of_places(observations);
    let design = observations.design(&DesireModel::Mcdm { beta: prior.beta });
    (spread, effect(&design, &prior.terms(), &spread))
}

/// The logarithm of the mean odds of places, over all seconds and sides.
fn mean_place(design: &Design, fit: &WaitingFit) -> f64 {
    let first = fit.layout.places().start;
    let of = |places: &[u32; 2]| {
        let known = places.iter().filter(|it| **it != NO_STRATUM);
        libm::exp(known.map(|it| fit.estimates[first + *it as usize]).sum())
    };
    let sum: f64 = design.places.iter().map(of).sum();
    libm::log(sum / design.places.len().max(1) as f64)
}

/// The classes, as far as they are asked for and the data tell them.
fn mixture(design: &Design, assumptions: &Assumptions, fit: &WaitingFit, asked: &Asked) -> Option<Mixture> {
    let weights = vec![1.0; design.drivers.len()];
    let of = |count| Mixture::fit(design, assumptions, fit, count, &weights);
    match asked.classes {
        Classes::Exactly(count) => (count > 1).then(|| of(count)),
        // Drivers who changed once say nothing of how drivers differ.
        Classes::Auto if !assumptions.has_spread => None,
        Classes::Auto => Some(of(2)).filter(|it| are_two(design, assumptions, fit, it, asked.folds.seed)),
    }
}

/// The weights of a fit with the terms of multi-criteria decision-making.
fn weights(fit: &WaitingFit, draws: &[Vec<f64>], values: &PriorWeights, prior: &Prior) -> Vec<Fitted> {
    let names = DesireModel::Mcdm { beta: values.beta }.terms();
    let each = names.into_iter().zip(values.terms()).zip(fit.layout.slopes());
    let of = |((name, value), at): ((&'static str, f64), usize)| {
        let mut fitted = Fitted::of_parameter(name, (at, 1.0), fit, draws, value);
        fitted.is_identified &= !is_the_prior(fit, prior, at);
        fitted
    };
    each.map(of).collect()
}

/// Whether the data add little to what was assumed of a parameter: its variance is hardly less than that of the prior.
fn is_the_prior(fit: &WaitingFit, prior: &Prior, at: usize) -> bool {
    /// Share of the prior's variance that is left.
    const LEFT: f64 = 0.8;
    fit.covariance[(at, at)] * prior.precisions[at] > LEFT
}

/// One parameter of all draws.
fn column(draws: &[Vec<f64>], at: usize, sign: f64) -> Vec<f64> {
    draws.iter().map(|it| sign * it[at]).collect()
}

impl Fitted {
    /// A parameter of a fit, times a sign.
    fn of_parameter(
        name: &'static str,
        (at, sign): (usize, f64),
        fit: &WaitingFit,
        draws: &[Vec<f64>],
        prior: f64,
    ) -> Fitted {
        let draws = column(draws, at, sign);
        Fitted::of(name, sign * fit.estimates[at], fit.standard_error(at), draws, prior)
    }

    /// A number with its standard error and its `draws`.
    ///
    /// The recording does not tell it if its variance is more than four times the square of what matters: the prior
    /// value, or what its interval leaves between it and 0, if that is more.
    fn of(name: &'static str, estimate: f64, standard_error: f64, draws: Vec<f64>, prior: f64) -> Fitted {
        /// Half the width of a 95 % interval in standard errors.
        const HALF: f64 = 1.959_964;
        /// Most standard errors that a number may be uncertain by, in units of what matters.
        const MOST: f64 = 2.0;
        let half = HALF * standard_error;
        let interval = match draws.len() {
            0 => [estimate - half, estimate + half],
            _ => interval(draws),
        };
        let matters = prior.abs().max(estimate.abs() - half);
        let width = (interval[1] - interval[0]) / (2.0 * HALF);
        let is_identified = standard_error.max(width) <= MOST * matters;
        Fitted { name, estimate, standard_error, interval, prior, is_identified }
    }
}

impl BetaProfile {
    /// Profiles the likelihood of multi-criteria decision-making over β.
    fn of(
        observations: &Observations,
        prior: &PriorWeights,
        effect: f64,
        spread: &PlaceSpread,
    ) -> BetaProfile {
        let mut start: Option<(Vec<f64>, Matrix)> = None;
        let mut logs = Vec::with_capacity(BETAS.len());
        for beta in BETAS {
            let design = observations.design(&DesireModel::Mcdm { beta });
            let assumptions = assumptions(&design, &prior.terms(), effect, spread).without_spread(&design);
            let weights = vec![1.0; design.drivers.len()];
            let estimates = match &start {
                Some((estimates, covariance)) => design.refit(&assumptions, &weights, estimates, covariance),
                None => {
                    let fit = design.fit_roughly(&assumptions, &weights, None);
                    start = Some((fit.estimates.clone(), fit.covariance));
                    fit.estimates
                }
            };
            let all: Vec<f64> = design.log_likelihoods(&estimates, assumptions.has_spread, &weights);
            logs.push((beta, all.iter().sum::<f64>()));
        }
        BetaProfile::from_logs(logs, prior.beta)
    }

    fn from_logs(logs: Vec<(f64, f64)>, prior: f64) -> BetaProfile {
        let largest = logs.iter().map(|it| it.1).fold(f64::NEG_INFINITY, f64::max);
        let profile: Vec<(f64, f64)> = logs.into_iter().map(|(beta, log)| (beta, log - largest)).collect();
        let inside = |it: &&(f64, f64)| it.1 > -SIGNIFICANT;
        let lower = profile.iter().find(inside).map_or(f64::NAN, |it| it.0);
        let upper = profile.iter().rev().find(inside).map_or(f64::NAN, |it| it.0);
        let is_identified = lower > BETAS[0] && upper < BETAS[BETAS.len() - 1];
        let best = profile.iter().find(|it| it.1 == 0.0).map_or(prior, |it| it.0);
        let beta = if is_identified { best } else { prior };
        BetaProfile { profile, beta, interval: [lower, upper], is_identified }
    }
}

/// The models beside multi-criteria decision-making, and the controls.
fn compared(
    observations: &Observations,
    model: &DesireModel,
    spread: &PlaceSpread,
    asked: &Asked,
) -> Vec<Compared> {
    let folds = &asked.folds;
    let of = |model: &DesireModel| {
        let means = match model {
            DesireModel::Mcdm { .. } => asked.prior.terms(),
            _ => vec![0.0; model.terms().len()],
        };
        Candidate::of(observations, model, (&means, spread), folds)
    };
    let others = [
        DesireModel::Constant,
        DesireModel::Places,
        *model,
        DesireModel::Mobil,
        DesireModel::Lmrs,
        DesireModel::Raw,
    ];
    let mut candidates: Vec<Candidate> = others.iter().map(of).collect();
    candidates.push(Candidate::shuffled(observations, model, (&asked.prior.terms(), spread), folds));
    let (constant, mcdm) = (candidates[0].clone(), candidates[2].clone());
    let compare = |candidate: Candidate| Compared {
        over_constant: candidate.better_than(&constant, observations, folds),
        mcdm_over_it: mcdm.better_than(&candidate, observations, folds),
        elsewhere: candidate
            .better_elsewhere_than(&constant, observations, folds)
            .zip(mcdm.better_elsewhere_than(&candidate, observations, folds))
            .map(|(over_constant, mcdm_over_it)| [over_constant, mcdm_over_it]),
        candidate,
    };
    candidates.into_iter().map(compare).collect()
}

impl Study {
    /// The weights alone, with β of the prior and errors by the information matrix.
    pub fn weights_of(observations: &Observations, asked: &Asked) -> Vec<Fitted> {
        let (spread, effect) = spreads(observations, &asked.prior);
        let design = observations.design(&DesireModel::Mcdm { beta: asked.prior.beta });
        let assumptions = assumptions(&design, &asked.prior.terms(), effect, &spread).without_spread(&design);
        let fit = design.fit(&assumptions, &vec![1.0; design.drivers.len()]);
        weights(&fit, &[], &asked.prior, &assumptions.prior)
    }

    /// Where the parameters of the fit stand.
    pub fn layout(&self) -> Layout {
        self.fit.layout
    }
}
