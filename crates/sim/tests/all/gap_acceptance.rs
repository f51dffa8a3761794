//! Gap acceptance in a random stream: lags to followers. Gaps on a minor road are in `junctions/minor_road.rs`.

use laneweave_models::change::{GapPair, Safety};
use laneweave_sim::{Purpose, Random};

/// Flow of the stream [1/s].
const FLOW: f64 = 0.25;
/// Number of samples.
const SAMPLES: u32 = 400_000;

/// Headway number `count` of a Poisson stream [s].
fn headway(random: &Random, count: u32) -> f64 {
    -libm::log(random.uniform(0, Purpose::Arrival, count)) / FLOW
}

#[track_caller]
fn assert_within(value: f64, expected: f64, share: f64) {
    assert!((value / expected - 1.0).abs() <= share, "{value} is not {expected} within {share}");
}

#[test]
fn v42_of_a_poisson_stream_of_followers_the_share_with_a_longer_time_to_collision_is_accepted() {
    const LENGTH: f64 = 5.0;
    let (random, safety) = (Random::new(42), Safety::default());
    let (follower, leader) = (15.0, 10.0);
    let is_accepted = |count: &u32| {
        let gap = follower * headway(&random, *count) - LENGTH;
        safety.accept(GapPair { gap, follower, leader, demanded: 0.0 }, 0.1).is_ok()
    };
    let accepted = (0..SAMPLES).filter(is_accepted).count();
    // 15 m at a closing speed of 5 m/s are 3 s. The next front is at least 20 m behind with probability
    // e^(−(20/15)/4).
    assert_within(accepted as f64 / f64::from(SAMPLES), 0.716532, 0.02);
}
