//! The paper's procedure, so that it can be compared: aggressive vehicles are picked first, every vehicle is one
//! observation, there is no intercept, and two thirds of the vehicles are used.
//!
//! The paper does not say how it picks aggressive vehicles. Here they are those that changed lanes most often, of
//! several the faster ones, as many as its share of 1 to 7.4 (ours). This sorts by the outcome, and an observation
//! without an intercept has a chance of one half where nothing speaks for or against a change: both bias the weights.

use crate::choice::{Choices, Fit};
use crate::desire_model::DesireModel;
use crate::observe::{NODES, Observations, ObservedDriver, SideSeen, Sighting};
use crate::prior::Prior;
use crate::resample::folds;

/// One group of vehicles, fitted as the paper does.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperGroup {
    /// `aggressive` or `conservative`.
    pub name: &'static str,
    /// Vehicles that are used, and how many of them changed lanes.
    pub vehicles: usize,
    /// Of them, those that changed lanes.
    pub changed: usize,
    /// β with the largest likelihood; `None` if there is no fit.
    pub beta: Option<f64>,
    /// The fit of the weights of speed, comfort, courtesy and the slow side; `None` if they have no maximum.
    pub fit: Option<Fit>,
}

/// Share of aggressive drivers: 1 to 7.4 (paper).
const AGGRESSIVE: f64 = 1.0 / 8.4;
/// Values of β that are tried.
const BETAS: [f64; 9] = [0.2, 0.5, 1.0, 1.1, 1.5, 2.3, 3.0, 4.0, 5.0];
/// Least curvature: a weight without any information is left at zero.
const LEAST: f64 = 1e-9;

/// Fits both groups.
pub fn by_paper(observations: &Observations, seed: u64) -> Vec<PaperGroup> {
    let mut order: Vec<&ObservedDriver> = observations.drivers.iter().collect();
    let changes = |it: &ObservedDriver| it.spells.iter().filter(|it| it.change.is_some()).count();
    order.sort_by(|a, b| changes(b).cmp(&changes(a)).then(b.desired.mean().total_cmp(&a.desired.mean())));
    let count = (AGGRESSIVE * order.len() as f64).round() as usize;
    let (aggressive, conservative) = order.split_at(count.min(order.len()));
    vec![group("aggressive", aggressive, seed), group("conservative", conservative, seed)]
}

fn group(name: &'static str, drivers: &[&ObservedDriver], seed: u64) -> PaperGroup {
    const PARTS: usize = 3;
    let folds = folds(drivers.len(), PARTS, seed, 0);
    let used = drivers.iter().zip(folds).filter(|it| it.1 > 0).filter_map(|it| observation(it.0));
    let used: Vec<(&SideSeen, bool)> = used.collect();
    let fits = BETAS.map(|beta| (beta, fit(&used, beta)));
    let best = fits.into_iter().filter_map(|(beta, fit)| Some((beta, fit?)));
    let best = best.max_by(|a, b| a.1.log_likelihood.total_cmp(&b.1.log_likelihood));
    PaperGroup {
        name,
        vehicles: used.len(),
        changed: used.iter().filter(|it| it.1).count(),
        beta: best.as_ref().map(|it| it.0),
        fit: best.map(|it| it.1),
    }
}

/// The one observation of a vehicle: what it saw when it began its first change, or halfway through if it made none,
/// and whether it changed. Of two sides the one that it changed to, or the one with the larger yield of speed.
fn observation(driver: &ObservedDriver) -> Option<(&SideSeen, bool)> {
    let changed = driver.spells.iter().find_map(|it| Some((it.sightings.last()?, it.change?)));
    if let Some((sighting, side)) = changed {
        return Some((sighting.sides[side.at()].as_ref()?, true));
    }
    let is_open = |it: &&Sighting| it.sides.iter().any(Option::is_some);
    let sightings: Vec<&Sighting> =
        driver.spells.iter().flat_map(|it| &it.sightings).filter(is_open).collect();
    let middle = sightings.get(sightings.len() / 2)?;
    let speed = |it: &&SideSeen| it.by_desired[NODES / 2].speed;
    let better = middle.sides.iter().flatten().max_by(|a, b| speed(a).total_cmp(&speed(b)))?;
    Some((better, false))
}

fn fit(used: &[(&SideSeen, bool)], beta: f64) -> Option<Fit> {
    let changed = used.iter().filter(|it| it.1).count();
    if changed == 0 || changed == used.len() {
        return None;
    }
    let model = DesireModel::Mcdm { beta };
    let width = model.terms().len();
    let mut choices = Choices::new(width);
    for (seen, changed) in used {
        let mut terms = Vec::with_capacity(width);
        model.add_terms(seen, &seen.by_desired[NODES / 2], &mut terms);
        choices.push([Some(&terms), None], changed.then_some(0), 1.0);
    }
    let prior = Prior { means: vec![0.0; width], precisions: vec![LEAST; width] };
    choices.fit(&prior).filter(|it| it.is_converged)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observe::{ByDesired, DesiredSpeed, GapDemands, ObservedSpell, Place};
    use laneweave_network::Side;

    fn driver(vehicle: i64, courtesy: f32, change: bool) -> ObservedDriver {
        let side = SideSeen {
            place: Place::default(),
            courtesy,
            headway: 1.0 + 0.1 * (vehicle % 7) as f32,
            own: [20.0, 0.0],
            lead: [20.0, 0.0],
            lag: [20.0, 0.0],
            speed: 20.0,
            has_safe_gap: true,
            demands: GapDemands { time_to_collision: 9.0, deceleration: 0.0, is_secure: true },
            by_desired: [ByDesired { speed: 0.01 * (vehicle % 5) as f32, ..ByDesired::default() }; NODES],
        };
        let sightings = vec![Sighting { tick: 0, sides: [Some(side), None] }];
        ObservedDriver {
            vehicle,
            desired: DesiredSpeed { nodes: vec![(1.0, 1.0)], is_shown: true },
            spells: vec![ObservedSpell { sightings, until: 0.0, change: change.then_some(Side::Left) }],
            ..ObservedDriver::default()
        }
    }

    #[test]
    fn who_changes_is_aggressive_by_this_procedure_and_everybody_else_hardly_ever_changes() {
        let drivers = (0..420).map(|it| driver(it, 0.1 * (it % 11) as f32 - 0.5, it % 10 == 0)).collect();
        let observations = Observations { drivers, phases: 1, ..Observations::default() };
        let [aggressive, conservative] = &by_paper(&observations, 1)[..] else { panic!("two groups") };
        // 50 of 420 are picked, and 42 changed: all of these are among them.
        assert_eq!((aggressive.vehicles, conservative.vehicles), (33, 246));
        assert!(aggressive.changed * 4 > aggressive.vehicles * 3 && conservative.changed == 0);
        // Nobody changed: the weights have no maximum.
        assert_eq!(conservative.fit, None);
    }
}
