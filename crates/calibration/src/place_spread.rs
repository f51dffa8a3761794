//! How much rates of changes differ between places: standard deviations of their intercepts, estimated from all places
//! together (empirical Bayes), so that places with few changes are drawn towards the others.

use crate::desire_model::{DesireModel, assumptions};
use crate::observe::Observations;
use crate::waiting::{Design, NO_STRATUM, WaitingFit};

/// Standard deviations of the intercepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceSpread {
    /// Of a lane and side.
    pub lanes: f64,
    /// Of a distance before the next fork, within a lane and side.
    pub distances: f64,
}

/// Where the search begins, and the least (ours).
const USUAL: PlaceSpread = PlaceSpread { lanes: 0.7, distances: 0.4 };
const LEAST: f64 = 0.05;
/// Steps of the search.
const STEPS: usize = 8;
/// The search ends where it changes by less than this.
const ENOUGH: f64 = 0.02;
/// The usual variances count as much as this number of places.
const USUAL_WEIGHT: f64 = 2.0;

impl PlaceSpread {
    /// Estimates them with a model of places alone: σ² = mean of û² and its variance, again and again (EM).
    pub fn of_places(observations: &Observations) -> PlaceSpread {
        let design = observations.design(&DesireModel::Places);
        PlaceSpread::of_design(&design, &vec![1.0; design.drivers.len()])
    }

    /// The same by the drivers of a design of places, who count as often as `weights` says.
    pub(crate) fn of_design(design: &Design, weights: &[f64]) -> PlaceSpread {
        let is_lane = is_lane(design);
        let mut spread = USUAL;
        let mut before: Option<WaitingFit> = None;
        for _ in 0..STEPS {
            let assumptions = assumptions(design, &[], 1.0, &spread).without_spread(design);
            let fit = design.fit_roughly(&assumptions, weights, before.as_ref());
            let square = |at: usize| fit.estimates[at] * fit.estimates[at] + fit.covariance[(at, at)];
            let of = |lane: bool, usual: f64| {
                let places = fit.layout.places().zip(&is_lane).filter(|(_, it)| **it == lane);
                let start = (USUAL_WEIGHT * usual * usual, USUAL_WEIGHT);
                let (sum, count) =
                    places.fold(start, |(sum, count), (at, _)| (sum + square(at), count + 1.0));
                (sum / count).sqrt().max(LEAST)
            };
            let next = PlaceSpread { lanes: of(true, USUAL.lanes), distances: of(false, USUAL.distances) };
            let moved = (next.lanes - spread.lanes).abs().max((next.distances - spread.distances).abs());
            (spread, before) = (next, Some(fit));
            if moved < ENOUGH {
                break;
            }
        }
        spread
    }

    /// The standard deviations of all places of `design`.
    pub(crate) fn of(&self, design: &Design) -> impl Iterator<Item = f64> {
        let PlaceSpread { lanes, distances } = *self;
        is_lane(design).into_iter().map(move |it| if it { lanes } else { distances })
    }
}

/// How much the terms of `design` do: the standard deviation, over the terms, of the logarithm of the odds that one
/// standard deviation of a yield brings more or less than the prior `means` have it. It is estimated in the same way,
/// so that weights of which the data know little are drawn towards the prior. Drivers count as often as `weights` says.
pub fn effect(design: &Design, means: &[f64], spread: &PlaceSpread, weights: &[f64]) -> f64 {
    /// Where the search begins, and as how many terms that counts (ours).
    const USUAL: f64 = 1.0;
    const USUAL_WEIGHT: f64 = 0.25;
    if design.terms == 0 {
        return USUAL;
    }
    let scales = design.scales();
    let mut effect = USUAL;
    let mut before: Option<WaitingFit> = None;
    for _ in 0..STEPS {
        let assumptions = assumptions(design, means, effect, spread).without_spread(design);
        let fit = design.fit_roughly(&assumptions, weights, before.as_ref());
        let (mut sum, mut count) = (USUAL_WEIGHT * USUAL * USUAL, USUAL_WEIGHT);
        for ((at, mean), scale) in fit.layout.slopes().zip(means).zip(&scales) {
            let off = fit.estimates[at] - mean;
            (sum, count) = (sum + (off * off + fit.covariance[(at, at)]) * scale * scale, count + 1.0);
        }
        let next = (sum / count).sqrt().max(LEAST);
        let is_enough = (next - effect).abs() < ENOUGH * effect;
        (effect, before) = (next, Some(fit));
        if is_enough {
            break;
        }
    }
    effect
}

/// For each place of `design` whether it is a whole lane.
fn is_lane(design: &Design) -> Vec<bool> {
    let mut is_lane = vec![false; design.strata];
    for [lane, _] in design.places.iter().filter(|it| it[0] != NO_STRATUM) {
        is_lane[*lane as usize] = true;
    }
    is_lane
}
