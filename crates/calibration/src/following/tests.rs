//! Fits to drivers whose numbers are known.

use laneweave_models::change::{LaneChangeModel, Mobil};
use laneweave_models::follow::{FollowingModel, IdmPlus, Krauss};
use laneweave_models::{Manner, Style};

use super::episode::{Episode, Followed, Seen};
use super::fit::{NotFitted, fit};
use super::predict::{Follower, Moved};
use super::stretch::{Lead, Stretch};
use crate::held_out::Folds;

const FOLDS: Folds = Folds { repetitions: 1, parts: 3, draws: 50, seed: 1 };
const TRUE: IdmPlus =
    IdmPlus { acceleration: 1.5, deceleration: 1.6, time_gap: 1.0, jam_gap: 2.5, exponent: 4.0 };

/// The prior style: IDM+ with its usual numbers.
pub(super) fn style() -> Style {
    Style {
        name: "prior".into(),
        description: String::new(),
        speed_factor: 1.0,
        follow: FollowingModel::IdmPlus(IdmPlus::default()),
        change: LaneChangeModel::Mobil(Mobil::default()),
        safety: Default::default(),
        attention: Default::default(),
        manner: Manner { comfortable_deceleration: 2.0, ..Manner::default() },
        yielding: Default::default(),
        guidance: Default::default(),
    }
}

/// Leaders whose speed goes up and down by a `share` of its mean, the faster the less they do it.
fn leader(driver: usize, share: f64, time: f64) -> Lead {
    let (mean, phase) = (4.0 + (driver % 8) as f64 * 2.0, driver as f64);
    let frequency = 0.2 + 0.02 * (driver % 5) as f64;
    let angle = frequency * time + phase;
    Lead {
        rear: mean * (time - share / frequency * (angle.cos() - phase.cos())),
        speed: mean * (1.0 + share * angle.sin()),
        acceleration: mean * share * frequency * angle.cos(),
    }
}

/// So long are drivers seen [s].
const SECONDS: usize = 96;

/// What is seen of drivers who follow such leaders, with T as `time_gap` says of each.
fn followed(share: f64, time_gap: impl Fn(usize) -> f64) -> Vec<Followed> {
    let of = |driver: usize| {
        let model = IdmPlus { time_gap: time_gap(driver), ..TRUE };
        let follower = Follower {
            model: FollowingModel::IdmPlus(model),
            comfortable: 2.0,
            desired: 30.0,
            strength: 3.0,
        };
        let first = leader(driver, share, 0.0);
        let gap = model.jam_gap + model.time_gap * first.speed;
        let start = Moved { way: 0.0, speed: first.speed };
        let behind = |second: usize| {
            let lead = leader(driver, share, second as f64);
            Lead { rear: lead.rear - first.rear + gap, ..lead }
        };
        let leader: Vec<Lead> = (0..=SECONDS).map(behind).collect();
        let own = vec![start; leader.len()];
        let whole = Stretch { period: 1.0, own, leader: leader.clone(), strength: 3.0, ..Stretch::default() };
        let own = std::iter::once(start).chain(follower.predicted(&whole));
        let seen = own.zip(leader).map(|(own, lead)| Seen { own, leader: Some(lead), shown: None }).collect();
        let episodes = vec![Episode { period: 1.0, allowed: 30.0, strength: 3.0, seen }];
        Followed { episodes, shown: None }
    };
    (0..40).map(of).collect()
}

#[test]
fn the_numbers_of_drivers_who_are_seen_exactly_come_back() {
    let fit = fit(&style(), &followed(0.6, |_| TRUE.time_gap), &FOLDS, 5).unwrap();
    assert!(fit.is_converged);
    for (number, exact) in
        fit.numbers.iter().zip([TRUE.time_gap, TRUE.jam_gap, TRUE.acceleration, TRUE.deceleration])
    {
        assert!(number.is_identified && (number.estimate / exact - 1.0).abs() < 5e-3, "{number:?}");
    }
    assert!(fit.own.abs() < 0.01 && fit.time_gap_spread < 0.01, "{} {}", fit.own, fit.time_gap_spread);
    assert_eq!((fit.drivers, fit.stretches, fit.length), (40, 480, 8.0));
    assert_eq!(fit.draws.len(), 5);
    // Who knows the numbers is off by less than a centimetre; whoever takes the speed as constant by much more.
    let last = &fit.scores[2];
    assert!(last.fitted.distance < 0.05 && last.constant.distance > 2.0, "{last:?}");
    assert!(last.prior.distance > 0.5 && last.over_constant.verdict() == "better", "{last:?}");
}

#[test]
fn drivers_behind_steady_leaders_tell_neither_how_they_accelerate_nor_how_they_brake() {
    let fit = fit(&style(), &followed(0.0, |_| TRUE.time_gap), &FOLDS, 0).unwrap();
    let [time_gap, _, acceleration, deceleration] = &fit.numbers[..] else { panic!("four numbers") };
    assert!(!acceleration.is_identified && !deceleration.is_identified, "{:?}", fit.numbers);
    assert_eq!([acceleration.value, deceleration.value], [acceleration.prior, deceleration.prior]);
    // All that is known is the prior, whose logarithms have the standard deviation .5.
    for number in [acceleration, deceleration] {
        assert!((number.log_error - 0.5).abs() < 0.02, "{number:?}");
    }
    assert!((time_gap.estimate - TRUE.time_gap).abs() < 0.1, "{time_gap:?}");
}

#[test]
fn drivers_who_each_keep_their_own_time_gap_are_not_drawn_to_one() {
    let own = |driver: usize| [0.7, 0.9, 1.1, 1.4, 1.8][driver % 5];
    let fit = fit(&style(), &followed(0.3, own), &FOLDS, 0).unwrap();
    assert!(fit.own > 0.6 && fit.own_interval[0] > 0.4, "{} {:?}", fit.own, fit.own_interval);
    // The standard deviation of their logarithms is .33.
    assert!((0.2..0.45).contains(&fit.time_gap_spread), "{}", fit.time_gap_spread);
}

#[test]
fn what_cannot_be_fitted_says_so() {
    let krauss = Style { follow: FollowingModel::Krauss(Krauss::default()), ..style() };
    let drivers = followed(0.6, |_| TRUE.time_gap);
    assert_eq!(fit(&krauss, &drivers, &FOLDS, 0).err(), Some(NotFitted::OtherModel));
    assert_eq!(fit(&style(), &drivers[..5], &FOLDS, 0).err(), Some(NotFitted::FewDrivers));
    assert_eq!(fit(&style(), &[], &FOLDS, 0).err(), Some(NotFitted::FewDrivers));
}
