//! Gap acceptance in a random stream: lags to followers, and lags on a road with priority.

use laneweave_models::change::{GapPair, Safety};
use laneweave_models::yielding::Yielding;
use laneweave_sim::{Purpose, Random};

/// Flow of the stream [1/s].
const FLOW: f64 = 0.25;
/// Number of samples.
const SAMPLES: u32 = 400_000;
/// t_c and t_f of the published capacities [s].
const CRITICAL_GAP: f64 = 5.0;
const FOLLOW_UP: f64 = 3.0;

/// Headway number `count` of a Poisson stream [s].
fn headway(random: &Random, count: u32) -> f64 {
    -libm::log(random.uniform(0, Purpose::Arrival, count)) / FLOW
}

#[track_caller]
fn assert_within(value: f64, expected: f64, share: f64) {
    assert!((value / expected - 1.0).abs() <= share, "{value} is not {expected} within {share}");
}

/// A driver whose critical gap does not change, and who clears the road at once.
fn patient() -> Yielding {
    Yielding { critical_gap: CRITICAL_GAP, patience: f64::INFINITY }
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

#[test]
fn v43_a_minor_road_has_the_capacity_of_harders() {
    let (random, driver) = (Random::new(43), patient());
    let (mut entered, mut time) = (0, 0.0);
    for count in 0..SAMPLES {
        let gap = headway(&random, count);
        time += gap;
        // The first waiting driver gets the whole gap, the next one the rest.
        let mut lag = gap;
        while driver.accepts(lag, 0.0, 0.0) {
            entered += 1;
            lag -= FOLLOW_UP;
        }
    }
    // q e^(−q t_c)/(1 − e^(−q t_f)); Siegloch's is 500.23 veh/h.
    assert_within(3600.0 * f64::from(entered) / time, 488.70, 0.01);
}

#[test]
fn v43_who_comes_to_a_road_with_priority_waits_as_long_as_adams_says() {
    let (random, driver) = (Random::new(44), patient());
    let mut headways = (0..).map(|count| headway(&random, count));
    let mut delay = 0.0;
    for _ in 0..SAMPLES {
        // The stream has no memory: the first lag is distributed like the others.
        let mut waited = 0.0;
        while let Some(lag) = headways.next().filter(|it| !driver.accepts(*it, 0.0, waited)) {
            waited += lag;
        }
        delay += waited;
    }
    // (e^(q t_c) − q t_c − 1)/q.
    assert_within(delay / f64::from(SAMPLES), 4.961, 0.01);
}
