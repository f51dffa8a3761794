//! Critical gaps of made drivers.

use super::offered::{GapSpell, Offered, OfferedGaps};
use super::problem::{Before, Found, Problem};
use super::table::{GRID, Going, Table, node, shares};
use crate::maximise::ROUGH;
use crate::waiting::logit;

const GOING: Going =
    Going { desire: [0.0, 1.0], gives_up: 0.1, goes: 0.8, goes_anyway: 0.0, waits: 0.0, unlike: 0.0 };

fn offered(lead: f64, lag: f64) -> Offered {
    Offered { desire: logit(0.2), lead: lead.ln(), lag: lag.ln(), is_possible: true }
}

/// A driver who may change left, with these gaps, and does so at the last look.
fn changes(gaps: &[[f64; 2]]) -> GapSpell {
    let looks = gaps.iter().map(|[lead, lag]| [Some(offered(*lead, *lag)), None]).collect();
    GapSpell { looks, changed_to: Some(0) }
}

/// The place on the grid of the critical gap next to `gap` [m].
fn at(gap: f64) -> usize {
    (0..GRID).min_by(|a, b| (node(*a) - gap.ln()).abs().total_cmp(&(node(*b) - gap.ln()).abs())).unwrap()
}

#[test]
fn the_likelihood_of_a_driver_who_waits_is_that_of_all_ways_to_its_change() {
    // At the first look the lead gap is far too short for a critical gap of 30 m, at the second all suits.
    let table = Table::of(&[changes(&[[3.0, 1e6], [1e6, 1e6]])], &GOING);
    let log = |lead: f64| table.log + table.likelihoods[at(lead)][at(1.0)].ln();
    // Wanted at the first look, and did not give up, since that follows a wish that is a look old; or at the second.
    let waited = 0.2 * 0.8 + 0.8 * 0.2 * 0.8;
    assert!((log(30.0) - f64::ln(waited)).abs() < 1e-6, "{} {}", log(30.0), f64::ln(waited));
    // A driver with a critical gap of 1 m would have gone at the first look with .8.
    let went = 0.2 * (1.0 - 0.8) * 0.8 + 0.8 * 0.2 * 0.8;
    let small = table.log + table.likelihoods[0][at(1.0)].ln();
    assert!((small - f64::ln(went)).abs() < 1e-3, "{small} {}", f64::ln(went));
}

#[test]
fn a_gap_that_the_test_refuses_for_another_reason_says_nothing_of_critical_gaps() {
    let mut spell = changes(&[[3.0, 1e6], [1e6, 1e6]]);
    spell.looks[0][0].as_mut().unwrap().is_possible = false;
    let table = Table::of(&[spell], &GOING);
    let all: Vec<f64> = (0..at(20.0)).map(|it| table.likelihoods[it][0]).collect();
    assert!(all.iter().all(|it| (it - all[0]).abs() < 1e-9), "{all:?}");
}

#[test]
fn shares_are_those_of_a_normal_distribution() {
    let shares = shares(10.0_f64.ln(), 0.5);
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    let mean: f64 = shares.iter().enumerate().map(|(at, share)| share * node(at)).sum();
    assert!((mean - 10.0_f64.ln()).abs() < 0.01, "{mean}");
}

/// Uniform random numbers (Lehmer's generator with the numbers of Park, Miller 1988).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0 * 48_271 % 2_147_483_647;
        self.0 as f64 / 2_147_483_647.0
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }
}

/// Drivers whose critical gaps have these medians [m] and spreads, beside gaps that grow and shrink.
fn simulated(medians: [f64; 2], spreads: [f64; 2], drivers: usize) -> OfferedGaps {
    let mut random = Random(7);
    let mut driver = || {
        let critical = [0, 1].map(|it| medians[it].ln() + spreads[it] * random.normal());
        let (mut wants, mut spell) = (false, GapSpell::default());
        let mut gaps = [0, 1].map(|_| 2.3 + 0.8 * random.normal());
        for _ in 0..60 {
            gaps = gaps.map(|it| 2.3 + 0.9 * (it - 2.3) + 0.35 * random.normal());
            let offered = Offered { desire: logit(0.05), lead: gaps[0], lag: gaps[1], is_possible: true };
            spell.looks.push([Some(offered), None]);
            wants |= random.next() < 0.05;
            if wants {
                if gaps[0] >= critical[0] && gaps[1] >= critical[1] && random.next() < 0.9 {
                    spell.changed_to = Some(0);
                    break;
                }
                wants = random.next() > 0.03;
            }
        }
        vec![spell]
    };
    OfferedGaps { drivers: (0..drivers).map(|_| driver()).collect(), looks: 2.0 }
}

#[test]
fn critical_gaps_of_drivers_come_back() {
    let (medians, spreads) = ([8.0, 12.0], [0.4, 0.5]);
    let offered = simulated(medians, spreads, 400);
    let weights = vec![1.0; 400];
    let before = Before { medians: [2.0, 2.0], giving_up: 0.07, waiting: 0.02 };
    let problem = Problem::new(&offered, &weights, &before);
    let Found { at, is_converged } = problem.maximum(&problem.start(), ROUGH).unwrap();
    assert!(is_converged);
    let covariance = problem.covariance(&at).unwrap();
    let truth = [medians[0].ln(), spreads[0].ln(), medians[1].ln(), spreads[1].ln()];
    for (which, truth) in truth.into_iter().enumerate() {
        let error = covariance[(which, which)].sqrt();
        assert!((at[which] - truth).abs() < 3.0 * error, "{which}: {} ± {error}, not {truth}", at[which]);
        assert!(error < 0.25, "{which}: {error}");
    }
}
