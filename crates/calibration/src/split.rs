//! Drivers who are seen, and what is supposed of all drivers by them alone: β, how much places differ, and how wide
//! priors are. What is supposed in a prediction of drivers who are held out is never estimated from them.

use rayon::prelude::*;

use crate::beta::{BETAS, BetaProfile, COARSE, Counting};
use crate::desire_model::DesireModel;
use crate::held_out::Folds;
use crate::observe::Observations;
use crate::place_spread::{PlaceSpread, effect};
use crate::resample::folds;
use crate::study::{PriorWeights, Study};
use crate::waiting::Design;

/// What is supposed of all drivers, by those who are seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Supposed {
    /// 1 for each driver who is seen, 0 for those who are held out.
    pub seen: Vec<f64>,
    /// How much places differ.
    pub spread: PlaceSpread,
    /// Scale of the prior of the terms of multi-criteria decision-making.
    pub effect: f64,
    /// β of comfort.
    pub beta: BetaProfile,
}

/// The ways in which drivers are held out.
#[derive(Clone, Debug, PartialEq)]
pub struct Splits {
    /// Everybody is seen.
    pub all: Supposed,
    /// Each part of each repetition is held out once: all parts of a repetition, one after the other.
    pub by_driver: Vec<Supposed>,
    /// Number of parts.
    pub parts: usize,
    /// Each site is held out once; none if there is one site only.
    pub by_site: Vec<Supposed>,
}

/// How much places differ, and how much the terms of multi-criteria decision-making do, by the drivers with `weights`.
pub(crate) fn spreads(
    observations: &Observations,
    prior: &PriorWeights,
    weights: &[f64],
) -> (PlaceSpread, f64) {
    let [places, design] = designs(observations, prior);
    spreads_of([&places, &design], prior, weights)
}

/// The designs by which these are estimated: of places alone, and with the terms.
fn designs(observations: &Observations, prior: &PriorWeights) -> [Design; 2] {
    [DesireModel::Places, DesireModel::Mcdm { beta: prior.beta }].map(|it| observations.design(&it))
}

fn spreads_of([places, design]: [&Design; 2], prior: &PriorWeights, weights: &[f64]) -> (PlaceSpread, f64) {
    let spread = PlaceSpread::of_design(places, weights);
    (spread, effect(design, &prior.terms(), &spread, weights))
}

impl Supposed {
    /// By all drivers.
    pub fn by_all(observations: &Observations, prior: &PriorWeights) -> Supposed {
        let all = vec![1.0; observations.drivers.len()];
        Supposed::by_each(observations, prior, &BETAS, vec![all]).remove(0)
    }

    /// As a study of all drivers has it.
    pub(crate) fn of(study: &Study, observations: &Observations) -> Supposed {
        let Study { spread, effect, ref beta, .. } = *study;
        Supposed { seen: vec![1.0; observations.drivers.len()], spread, effect, beta: beta.clone() }
    }

    /// By each of several choices of drivers; these `betas` are tried.
    fn by_each(
        observations: &Observations,
        prior: &PriorWeights,
        betas: &[f64],
        choices: Vec<Vec<f64>>,
    ) -> Vec<Supposed> {
        let [places, design] = designs(observations, prior);
        let spreads: Vec<(PlaceSpread, f64)> =
            choices.par_iter().map(|it| spreads_of([&places, &design], prior, it)).collect();
        let each = choices.iter().zip(&spreads);
        let counting: Vec<Counting> =
            each.map(|(weights, &(spread, effect))| Counting { weights, spread, effect }).collect();
        let betas = BetaProfile::of_each(observations, prior, betas, &counting);
        let each = choices.into_iter().zip(spreads).zip(betas);
        each.map(|((seen, (spread, effect)), beta)| Supposed { seen, spread, effect, beta }).collect()
    }

    /// 1 for each driver who is held out.
    pub(crate) fn held_out(&self) -> Vec<f64> {
        self.seen.iter().map(|it| 1.0 - it).collect()
    }

    /// Scale of the prior of the terms of `design`, which are those of `model` with prior `means`.
    pub(crate) fn effect_of(&self, model: &DesireModel, design: &Design, means: &[f64]) -> f64 {
        match model {
            DesireModel::Mcdm { .. } => self.effect,
            _ => effect(design, means, &self.spread, &self.seen),
        }
    }

    /// `model` with this β.
    pub(crate) fn model(&self, model: &DesireModel) -> DesireModel {
        match model {
            DesireModel::Mcdm { .. } => DesireModel::Mcdm { beta: self.beta.beta },
            other => *other,
        }
    }
}

impl Splits {
    /// All ways in which `asked` holds drivers out, with what is supposed by `all`.
    pub fn of(observations: &Observations, prior: &PriorWeights, all: Supposed, asked: &Folds) -> Splits {
        let seen = by_driver(observations, asked);
        let repeated = seen.len();
        let choices = seen.into_iter().chain(by_site(observations)).collect();
        let mut supposed = Supposed::by_each(observations, prior, &COARSE, choices);
        let by_site = supposed.split_off(repeated);
        Splits { all, by_driver: supposed, parts: asked.parts, by_site }
    }

    /// The same with what is `known` of all drivers, and estimated from none.
    pub fn with_known(observations: &Observations, known: &Supposed, asked: &Folds) -> Splits {
        let of = |seen: Vec<f64>| Supposed { seen, ..known.clone() };
        Splits {
            all: of(vec![1.0; observations.drivers.len()]),
            by_driver: by_driver(observations, asked).into_iter().map(of).collect(),
            parts: asked.parts,
            by_site: by_site(observations).map(of).collect(),
        }
    }
}

/// Who is seen while each part of each repetition is held out.
pub(crate) fn by_driver(observations: &Observations, asked: &Folds) -> Vec<Vec<f64>> {
    let count = observations.drivers.len();
    let of = |repetition: u32| {
        let folds = folds(count, asked.parts, asked.seed, repetition);
        let seen = move |part: usize| folds.iter().map(|it| if *it == part { 0.0 } else { 1.0 }).collect();
        (0..asked.parts).map(seen).collect::<Vec<Vec<f64>>>()
    };
    (0..asked.repetitions).flat_map(of).collect()
}

/// Who is seen while each site is held out.
fn by_site(observations: &Observations) -> impl Iterator<Item = Vec<f64>> {
    let sites = if observations.sites < 2 { 0 } else { observations.sites };
    let seen = |site: u32| observations.drivers.iter().map(move |it| if it.site == site { 0.0 } else { 1.0 });
    (0..sites).map(move |site| seen(site).collect())
}
