//! How drivers follow: what a fit finds of simulated drivers whose numbers are known, and of recorded ones.

use std::path::Path;

use laneweave::Simulation;
use laneweave::models::{Parameter, Style};
use laneweave::scenario::Origin as Files;
use laneweave::sim::Navigator;
use laneweave_calibration::Folds;
use laneweave_calibration::following::{Followers, FollowingFit};
use laneweave_recorded::Drone;
use laneweave_recordings::{Matched, Recording, clean};
use laneweave_scenario::open_recording;
use laneweave_scenario::scenario::{MapOptions, open_map};
use laneweave_scenario::style::{StyleTemplate, find};
use laneweave_test_data::size;

use crate::replayed::set_up::{mona, of_style};

const FOLDS: Folds = Folds { repetitions: 1, parts: 3, draws: 200, seed: 1 };

/// Conservative drivers on a map, as a drone sees them: 25 frames a second with errors of 10 cm.
fn seen(map: &str, demand: f64, seconds: f64, seed: u64) -> (Simulation, Recording) {
    let mut scenario = of_style(map, "conservative", demand, seconds);
    scenario.run.seed = seed;
    let mut simulation =
        Simulation::from_scenario(&scenario, &Files::default()).expect("the scenario is sound");
    (0..simulation.run_steps()[0]).for_each(|_| simulation.advance());
    let mut watch = simulation.drone_watch();
    for _ in 0..simulation.run_steps()[1] {
        simulation.advance();
        simulation.show(&mut watch);
    }
    let drone = Drone { noise: 0.1, seed, ..Drone::exact(25.0) };
    let recording = clean(drone.observe(&watch.into_recording())).0;
    (simulation, recording)
}

/// A fit to a free motorway and a queue before a lane drop, with the estimates as shares of what is true: T, s₀, a, b
/// and the median desired speed.
fn fitted(seconds: f64, seed: u64) -> (FollowingFit, [f64; 5]) {
    let (mut followers, mut style, mut logs) = (Followers::default(), None, Vec::new());
    for (map, demand) in [("motorway_2_lanes.osm", 1500.0), ("lane_drop.osm", 4500.0)] {
        let (simulation, recording) = seen(map, demand, seconds, seed);
        let network = simulation.network();
        let navigator = Navigator::new(network);
        let drivers: Style = simulation.driver_parameters()[0].clone();
        followers.add(&Matched::new(network, &recording), &navigator, &drivers).expect("a sound style");
        logs.extend(simulation.views().map(|it| it.style().speed_factor.ln()));
        style = Some(drivers);
    }
    let style = style.expect("two recordings");
    let fit = followers.fit(&style, &FOLDS, 0).expect("many drivers follow");
    // The prior's numbers are the true ones.
    let mut shares = [0.0; 5];
    for (share, it) in shares.iter_mut().zip(&fit.numbers) {
        *share = it.estimate / it.prior;
    }
    shares[4] = fit.speed_factor.estimate / (logs.iter().sum::<f64>() / logs.len() as f64).exp();
    (fit, shares)
}

#[test]
fn the_numbers_of_simulated_drivers_whom_a_drone_sees_come_back() {
    let (seeds, seconds) = size().pick((1, 120.0), (20, 300.0));
    for seed in 1..=seeds {
        let (fit, shares) = fitted(seconds, seed);
        assert!(fit.is_converged && fit.numbers.iter().all(|it| it.is_identified), "{:?}", fit.numbers);
        assert!(shares[..4].iter().all(|it| (it - 1.0).abs() < 0.1), "{shares:?}");
        assert!((shares[4] - 1.0).abs() < 0.05, "{shares:?}");
        // All seek the same time gap.
        assert!(fit.own.abs() < 0.1 && fit.time_gap_spread < 0.05, "{} {}", fit.own, fit.time_gap_spread);
        for it in &fit.scores {
            assert_eq!(it.over_constant.verdict(), "better", "{it:?}");
        }
    }
}

#[test]
fn recorded_drivers_who_were_not_seen_are_predicted_better_than_by_a_constant_speed() {
    let Some([recording, map]) = mona() else { return };
    let network = open_map(&map, &MapOptions::default()).expect("it can be read").network;
    let network = network.clone().joined().unwrap_or(network);
    let recording = clean(open_recording(&recording, None).expect("it can be read").0).0;
    let source = find("conservative", Path::new("."), String::new).expect("it is built in");
    let style = StyleTemplate::parse(&source).expect("it is sound").typical().clone();
    let mut followers = Followers::default();
    let navigator = Navigator::new(&network);
    followers.add(&Matched::new(&network, &recording), &navigator, &style).expect("a sound style");
    let fit = followers.fit(&style, &FOLDS, 0).expect("many drivers follow");
    assert!(fit.is_converged);
    for it in &fit.scores {
        // Within a second a driver comes as far as at its speed, whatever it does: errors of places decide.
        match it.after < 2.0 {
            true => assert!(it.over_constant.estimate.abs() < 0.05, "{it:?}"),
            false => {
                assert_eq!(it.over_constant.verdict(), "better", "{it:?}");
                assert!(it.fitted.speed < it.constant.speed, "{it:?}");
            }
        }
        assert!(it.fitted.distance < it.prior.distance && it.fitted.speed < it.prior.speed, "{it:?}");
    }
    let number = |parameter| fit.numbers.iter().find(|it| it.parameter == parameter).expect("it is fitted");
    assert!((1.0..2.0).contains(&number(Parameter::TimeGap).estimate));
    assert!((1.0..5.0).contains(&number(Parameter::JamGap).estimate));
    // Even after twenty seconds recorded drivers still have much of the time gap that they had.
    assert_eq!(fit.length, 20.0);
    assert!(fit.own_interval[0] > 0.2, "{:?}", fit.own_interval);
}
