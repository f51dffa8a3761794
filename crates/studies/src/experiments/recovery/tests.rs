//! Recovery in small.

use laneweave::network::Side;
use laneweave_calibration::observe::{Known, Observations, ObservedDriver};
use laneweave_calibration::{BetaProfile, Candidate, DesireModel, Folds, PriorWeights, Splits, Supposed};
use laneweave_test_data::size;

use super::drone::{Driven, NOISE};
use super::exact;
use super::settings::Setting;
use super::variants::{EXACT, OURS, PLAIN, fits_of};
use super::weights::{NO_SPREAD, WEIGHTS};
use crate::experiments::effort::Effort;

#[test]
fn weights_observed_exactly_come_back() {
    let fits = exact::fits(&Effort { seeds: 1, length: 0.4, threads: 2 }, 4).expect("built-in styles");
    for (at, name) in exact::TERMS.iter().enumerate() {
        let off = |it: &exact::Exact| (it.fit.estimates[at] - it.truth[at]) / it.fit.standard_errors()[at];
        let off: Vec<f64> = fits.iter().map(off).collect();
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        // The mean of four has a standard deviation of one half.
        assert!(mean.abs() < 2.0 && off.iter().all(|it| it.abs() < 4.0), "{name}: {off:?}");
    }
    assert!(fits.iter().all(|it| it.desires > 100));
}

#[test]
fn what_is_known_of_drivers_whom_a_drone_sees_brings_their_weights_nearer() {
    if !size().pick(false, true) {
        return;
    }
    // One run of 0.6 h is off by chance as much as by what is not known.
    const RUNS: u64 = 4;
    let mut shares = [[0.0; WEIGHTS.len()]; 3];
    for seed in 1..=RUNS {
        let driven = Driven::of(&Setting::motorway(), seed, 0.6).expect("built-in styles");
        let fits = fits_of(&[PLAIN, EXACT, OURS], &driven).expect("three fits");
        for (sums, fit) in shares.iter_mut().zip(&fits) {
            sums.iter_mut().zip(fit.shares).for_each(|(sum, it)| *sum += it / RUNS as f64);
        }
        let [all, used] = fits[2].changes;
        assert!(used * 10 > all * 7, "{used} of {all}");
    }
    let [plain, exact, ours] = shares.map(|it| it.map(|share| (share - 1.0).abs()));
    for weight in 0..WEIGHTS.len() {
        assert!(exact[weight] < 0.5 * plain[weight], "{shares:?}");
        assert!(ours[weight] < 0.5 * plain[weight], "{shares:?}");
    }
}

#[test]
fn what_is_supposed_of_drivers_who_are_held_out_is_not_told_by_them() {
    let driven = Driven::of(&Setting::motorway(), 1, 0.2).expect("built-in styles");
    let recording = driven.recorded(NOISE);
    let mut observations =
        driven.observations(&driven.matched(&recording), Known::default(), 1).expect("what was recorded");
    let folds = Folds { repetitions: 1, parts: 2, draws: 1, seed: 1 };
    let prior = PriorWeights {
        speed: 0.5,
        route: 0.5,
        comfort: 0.1,
        courtesy: 1.7,
        plain: [0.0],
        beta: 2.3,
        alpha: 0.06,
    };
    let supposed = |observations: &Observations| {
        let all = Supposed::by_all(observations, &prior);
        Splits::of(observations, &prior, all, &folds)
    };
    let before = supposed(&observations);
    // Some of those who are held out first change lanes in the place of others.
    let [first, second] = &before.by_driver[..] else { panic!("two parts") };
    let held_out = |it: &usize| first.seen[*it] == 0.0;
    let changes = |it: &ObservedDriver| it.spells.last().is_some_and(|it| it.change.is_some());
    let (changed, stayed): (Vec<usize>, Vec<usize>) = (0..observations.drivers.len())
        .filter(held_out)
        .filter(|it| !observations.drivers[*it].spells.is_empty())
        .partition(|it| changes(&observations.drivers[*it]));
    let mut moved = 0;
    for (from, to) in changed.into_iter().zip(stayed) {
        let last = |it: usize| observations.drivers[it].spells.len() - 1;
        let (from, to) = ((from, last(from)), (to, last(to)));
        let sides = observations.drivers[to.0].spells[to.1].sightings.last().map(|it| &it.sides);
        let Some(side) = sides.and_then(|it| Side::BOTH.into_iter().find(|side| it[side.at()].is_some()))
        else {
            continue;
        };
        observations.drivers[from.0].spells[from.1].change = None;
        observations.drivers[to.0].spells[to.1].change = Some(side);
        moved += 1;
    }
    assert!(moved > 5, "{moved}");
    let after = supposed(&observations);
    assert_eq!(after.by_driver[0], before.by_driver[0]);
    assert_ne!(after.by_driver[1], *second);
    assert_ne!(after.all, before.all);
}

#[test]
fn a_site_that_was_not_seen_is_predicted_about_as_well_as_drivers_who_were_not() {
    let driven = Driven::of(&Setting::motorway(), 1, 0.4).expect("built-in styles");
    let recording = driven.recorded(NOISE);
    let mut observations =
        driven.observations(&driven.matched(&recording), Known::default(), 1).expect("what was recorded");
    // Every second driver was seen elsewhere.
    observations.sites = 2;
    (0..).zip(&mut observations.drivers).for_each(|(number, driver)| driver.site = number % 2);
    let folds = Folds { repetitions: 1, parts: 2, draws: 100, seed: 1 };
    let profile = BetaProfile { profile: Vec::new(), beta: 2.3, interval: [2.3; 2], is_identified: true };
    let known = Supposed { seen: Vec::new(), spread: NO_SPREAD, effect: 1.0, beta: profile };
    let splits = Splits::with_known(&observations, &known, &folds);
    let candidate =
        |model: DesireModel| Candidate::of(&observations, &model, &vec![0.0; model.terms().len()], &splits);
    let [mcdm, constant] = [DesireModel::Mcdm { beta: 2.3 }, DesireModel::Constant].map(candidate);
    let by_driver = mcdm.better_than(&constant, &observations, &folds);
    let by_site = mcdm.better_elsewhere_than(&constant, &observations, &folds).expect("two sites");
    assert!(by_site.interval[0] > 0.5, "{by_site:?}");
    assert!((by_site.estimate - by_driver.estimate).abs() < 0.3, "{by_driver:?} {by_site:?}");
}
