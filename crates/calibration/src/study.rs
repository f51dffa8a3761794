//! A whole fit: the weights with their errors, what the data leave open, and how well models predict.

use crate::beta::BetaProfile;
use crate::classes::{Mixture, are_two};
use crate::desire_model::{DesireModel, assumptions};
use crate::fitted::{Fitted, is_closed};
use crate::held_out::{Candidate, Difference, Folds};
use crate::observe::{Observations, PLAIN};
use crate::place_spread::PlaceSpread;
use crate::resample::resampled;
use crate::split::{Splits, Supposed, spreads};
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
    /// Those of the terms of multi-criteria decision-making; speed with the route in the proportion of the prior. Those
    /// that are not identified have the estimates of a fit in which all weights are free.
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
    /// The fit of the whole process, with weights that are not identified held at the prior.
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

impl Assumptions {
    /// The same with the weights that are not identified held at the prior.
    pub(crate) fn holding_untold(self, layout: Layout, weights: &[Fitted]) -> Assumptions {
        let untold = layout.slopes().zip(weights).filter(|it| !it.1.is_identified);
        untold.fold(self, |assumptions, (at, weight)| assumptions.holding(at, weight.prior))
    }
}

impl PriorWeights {
    /// Those of the terms of multi-criteria decision-making.
    pub fn terms(&self) -> Vec<f64> {
        [self.speed, self.comfort, self.courtesy].into_iter().chain(self.plain).collect()
    }
}

impl Study {
    /// The same, but the thresholds with which drivers drive are more `by` this, in units of the choice noise.
    pub fn with_thresholds_moved(self, by: f64) -> Study {
        Study { mean_place: self.mean_place - by, ..self }
    }

    /// Fits a style to `observations`, and compares its model with others.
    pub fn of(observations: &Observations, asked: &Asked) -> Study {
        let study = Study::alone(observations, asked);
        let compared = compared(observations, &study, asked);
        Study { compared, ..study }
    }

    /// Fits a style to `observations`, without a comparison of models. Weights that are not identified are held at the
    /// prior, and all else is what explains the drivers best beside that.
    pub fn alone(observations: &Observations, asked: &Asked) -> Study {
        let Supposed { seen: all, spread, effect, beta } = Supposed::by_all(observations, &asked.prior);
        let model = DesireModel::Mcdm { beta: beta.beta };
        let design = observations.design(&model);
        let assumptions = assumptions(&design, &asked.prior.terms(), effect, &spread);
        let resampled: Vec<Vec<f64>> =
            (0..asked.draws).map(|number| resampled(observations, asked.folds.seed, number)).collect();
        let redrawn = |assumptions: &Assumptions, fit: &WaitingFit| {
            design.redrawn(assumptions, &all, (&fit.estimates, Some(&fit.covariance)), &resampled)
        };
        let free = design.fit(&assumptions, &all);
        let draws = redrawn(&assumptions, &free);
        let mut weights =
            Drawn { design: &design, assumptions: &assumptions, fit: &free, draws: &draws }.weights();
        let assumptions = assumptions.holding_untold(free.layout, &weights);
        let fit = design.fit_from(&assumptions, &all, Some(&free));
        let draws = redrawn(&assumptions, &fit);
        let drawn = Drawn { design: &design, assumptions: &assumptions, fit: &fit, draws: &draws };
        for (weight, at) in weights.iter_mut().zip(fit.layout.slopes()).filter(|it| it.0.is_identified) {
            *weight = Fitted { is_identified: true, ..drawn.fitted(weight.name, (at, 1.0)) };
        }
        let theta = drawn.told("theta", (fit.layout.intercept(), -1.0));
        let mean_place = mean_place(&design, &fit);
        let mixture = mixture(&design, &assumptions, &fit, asked);
        let of_classes = |it: &Mixture| it.redrawn(&design, &assumptions, &fit, &resampled);
        let class_draws = mixture.as_ref().map_or(Vec::new(), of_classes);
        let compared = Vec::new();
        Study { weights, theta, beta, spread, effect, mean_place, fit, draws, compared, mixture, class_draws }
    }
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

/// A fit with its assumptions and the draws of its bootstrap.
struct Drawn<'a> {
    design: &'a Design,
    assumptions: &'a Assumptions,
    fit: &'a WaitingFit,
    draws: &'a [Vec<f64>],
}

impl Drawn<'_> {
    /// A parameter of the fit, times a sign.
    fn fitted(&self, name: &'static str, (at, sign): (usize, f64)) -> Fitted {
        let column = self.draws.iter().map(|it| sign * it[at]).collect();
        let Assumptions { prior, .. } = self.assumptions;
        let estimate = (sign * self.fit.estimates[at], self.fit.standard_error(at));
        Fitted::of(name, estimate, column, (sign * prior.means[at], 1.0 / prior.precisions[at].sqrt()))
    }

    /// The same with whether it is identified.
    fn told(&self, name: &'static str, (at, sign): (usize, f64)) -> Fitted {
        let number = self.fitted(name, (at, sign));
        let is_identified = number.is_narrowed() && is_closed(self.design, self.assumptions, self.fit, at);
        Fitted { is_identified, ..number }
    }

    /// The weights of the terms of multi-criteria decision-making, with whether they are identified.
    fn weights(&self) -> Vec<Fitted> {
        // β changes no name.
        let names = DesireModel::Mcdm { beta: 0.0 }.terms();
        names.into_iter().zip(self.fit.layout.slopes()).map(|(name, at)| self.told(name, (at, 1.0))).collect()
    }
}

/// The models beside multi-criteria decision-making, and the controls.
fn compared(observations: &Observations, study: &Study, asked: &Asked) -> Vec<Compared> {
    let folds = &asked.folds;
    let splits = Splits::of(observations, &asked.prior, Supposed::of(study, observations), folds);
    let mcdm = DesireModel::Mcdm { beta: study.beta.beta };
    let of = |model: &DesireModel| {
        let means = match model {
            DesireModel::Mcdm { .. } => asked.prior.terms(),
            _ => vec![0.0; model.terms().len()],
        };
        Candidate::of(observations, model, &means, &splits)
    };
    let others = [
        DesireModel::Constant,
        DesireModel::Places,
        mcdm,
        DesireModel::Mobil,
        DesireModel::Lmrs,
        DesireModel::Raw,
    ];
    let mut candidates: Vec<Candidate> = others.iter().map(of).collect();
    candidates.push(Candidate::shuffled(observations, &mcdm, &asked.prior.terms(), (&splits, folds.seed)));
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
        let all = vec![1.0; observations.drivers.len()];
        let (spread, effect) = spreads(observations, &asked.prior, &all);
        let design = observations.design(&DesireModel::Mcdm { beta: asked.prior.beta });
        let assumptions = assumptions(&design, &asked.prior.terms(), effect, &spread).without_spread(&design);
        let fit = design.fit(&assumptions, &vec![1.0; design.drivers.len()]);
        Drawn { design: &design, assumptions: &assumptions, fit: &fit, draws: &[] }.weights()
    }

    /// Where the parameters of the fit stand.
    pub fn layout(&self) -> Layout {
        self.fit.layout
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prior::Prior;
    use crate::waiting::{Driver, GAP_TERMS, Spell, logit};

    const NOTHING: PriorWeights = PriorWeights {
        speed: 0.0,
        route: 0.0,
        comfort: 0.0,
        courtesy: 0.0,
        plain: [0.0; PLAIN.len()],
        beta: 1.0,
        alpha: 0.0,
    };

    /// Drivers of whom every other one changes again and again, in its first or its second second, and the others
    /// never.
    fn two_kinds() -> Design {
        let mut design = Design { terms: 0, nodes: 1, strata: 0, ..Design::default() };
        for number in 0..80 {
            let first = design.gaps.len();
            let mut spell = |seconds: usize, changed_to: Option<usize>| {
                let mut row = || {
                    design.gaps.push([0.0; GAP_TERMS]);
                    design.places.push([NO_STRATUM; 2]);
                    Some(design.gaps.len() as u32 - 1)
                };
                Spell { seconds: (0..seconds).map(|_| [row(), row()]).collect(), changed_to }
            };
            let spells: Vec<Spell> = match number % 2 {
                0 => (0..6).map(|it| spell(1 + it % 2, Some(it % 2))).collect(),
                _ => vec![spell(30, None)],
            };
            let rows = first..design.gaps.len();
            design.drivers.push(Driver { chances: vec![1.0], rows, phases: vec![spells] });
        }
        design
    }

    #[test]
    fn classes_are_looked_for_only_where_drivers_differ() {
        let design = two_kinds();
        let layout = Layout::of(&design);
        let mut prior = Prior { precisions: vec![1.0; layout.count()], ..Prior::none(layout.count()) };
        prior.means[layout.intercept()] = -3.0;
        for at in [layout.background(), layout.waiting()] {
            (prior.means[at], prior.precisions[at]) = (logit(0.001), 100.0);
        }
        let is_fixed = vec![false; layout.count()];
        let without = Assumptions { prior, is_fixed, has_spread: true }.without_spread(&design);
        let with = Assumptions { has_spread: true, ..without.clone() };
        let fit = design.fit(&without, &[1.0; 80]);
        let folds = Folds { repetitions: 1, parts: 3, draws: 1, seed: 1 };
        let asked = |classes| Asked { prior: NOTHING, draws: 1, folds, classes };
        let [two, auto] = [Classes::Exactly(2), Classes::Auto].map(asked);
        // The data show two classes of forty drivers each.
        let found = mixture(&design, &without, &fit, &two).expect("two classes are asked for");
        assert!(found.shares.iter().all(|it| (it - 0.5).abs() < 0.05), "{:?}", found.shares);
        assert!(are_two(&design, &without, &fit, &found, 1));
        assert!(mixture(&design, &with, &fit, &auto).is_some());
        // But where drivers are held to have no intercepts of their own, nobody looks for them.
        assert_eq!(mixture(&design, &without, &fit, &auto), None);
    }
}
