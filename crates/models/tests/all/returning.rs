//! Headways and the chance of coming back in time.

use crate::near::assert_near;
use laneweave_models::Reading::{self, Literal, Repaired};
use laneweave_models::change::{Flow, Returning};
use proptest::prelude::*;

fn flow(spacing: f64, speed: f64) -> Flow {
    Flow { spacing, speed, length: 5.0 }
}

fn returning(reading: Reading) -> Returning {
    Returning { reading, ..Returning::default() }
}

#[test]
fn headways_of_both_readings() {
    for (spacing, speed, literal, repaired) in [
        (7.5, 0.1, 10.0, 0.25),
        (20.0, 10.0, 2.0, 1.3),
        (100.0, 13.0, 7.692308, 7.153846),
        (6.0, 10.0, 0.6, 0.0),
    ] {
        assert_near(flow(spacing, speed).headway(Literal), literal, 1e-6);
        assert_near(flow(spacing, speed).headway(Repaired), repaired, 1e-6);
    }
    // The literal floor of the speed, 0.5 m/s, where the cap of 10 s does not bind.
    assert_near(flow(4.0, 0.1).headway(Literal), 8.0, 1e-12);
}

/// The paper's chance at the time headway `headway` [s].
fn literal_chance(changes: u32, headway: f64, remaining: f64) -> f64 {
    returning(Literal).chance(changes, remaining, 10.0, &flow(10.0 * headway, 10.0))
}

#[test]
fn v30_the_chance_of_coming_back() {
    for (headway, remaining, chance) in
        [(2.0, 10.0, 0.686514), (2.0, 20.0, 0.901726), (2.0, 50.0, 0.996972), (0.5, 30.0, 0.581048)]
    {
        assert_near(literal_chance(1, headway, remaining), chance, 1e-6);
    }
    for reading in [Literal, Repaired] {
        for remaining in [0.0, -1e-9, -20.0] {
            assert_eq!(returning(reading).chance(1, remaining, 10.0, &flow(20.0, 10.0)), 0.0);
        }
        assert_eq!(returning(reading).chance(0, 0.0, 10.0, &flow(20.0, 10.0)), 1.0);
    }
}

#[test]
fn v30_the_chance_of_several_changes() {
    // x = 0.058 · 2 · 20 = 2.32.
    for (changes, chance) in [(0, 1.0), (1, 0.901726), (2, 0.673732), (3, 0.409258)] {
        assert_near(literal_chance(changes, 2.0, 20.0), chance, 1e-6);
    }
}

#[test]
fn v30_the_repaired_chance_of_coming_back() {
    // The mean speed v̄ and the vehicles' length give the wanted T_h and |v − v̄| at spacing d̄.
    let crawl = |speed| Flow { spacing: 8.5, speed, length: 5.0 };
    let drive = |speed, length| Flow { spacing: 30.0, speed, length };
    for (speed, traffic, headway, chance) in [
        (0.1, crawl(0.1), 0.75, 0.018316),
        (0.1, crawl(0.6), 0.75, 0.117546),
        (12.0, drive(8.0, 12.0), 2.0, 0.525847),
        (12.0, drive(12.0, 4.0), 2.0, 0.223130),
    ] {
        assert_near(traffic.headway(Repaired), headway, 1e-12);
        assert_near(returning(Repaired).chance(1, 200.0, speed, &traffic), chance, 1e-6);
    }
}

#[test]
fn v30_the_repaired_chance_in_a_dense_stream_of_new_gaps() {
    // v = 12 and v̄ = 2 m/s: the second bound on the trials, 1 + 10 t/d̄, is above t/4 s.
    let stream = |headway: f64| Flow { spacing: 2.0 * headway + 2.0 + 4.0, speed: 2.0, length: 4.0 };
    for (remaining, headway, chance) in [
        (50.0, 2.0, 0.127822),
        (100.0, 2.0, 0.329522),
        (200.0, 2.0, 0.603773),
        (400.0, 2.0, 0.861624),
        (200.0, 1.2, 0.269519),
        (200.0, 4.0, 0.904085),
    ] {
        assert_near(stream(headway).headway(Repaired), headway, 1e-12);
        assert_near(returning(Repaired).chance(1, remaining, 12.0, &stream(headway)), chance, 1e-6);
    }
    // Less than the time of a change is left.
    assert_eq!(returning(Repaired).chance(1, 23.9, 12.0, &stream(4.0)), 0.0);
}

#[test]
fn v30_returning_into_a_standing_queue_is_hopeless_where_the_paper_says_certain() {
    let jam = flow(7.0, 0.0);
    assert!(returning(Literal).chance(1, 100.0, 0.0, &jam) > 0.999);
    assert_eq!(returning(Repaired).chance(1, 100.0, 0.0, &jam), 0.0);
    // One trial of e^(−3/0.25).
    let nearly_jam = returning(Repaired).chance(1, 100.0, 0.1, &flow(7.5, 0.1));
    assert_near(nearly_jam, f64::exp(-12.0), 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn v30_failing_over_two_stretches_is_failing_on_each(
        first in 0.0..60.0_f64, second in 0.0..60.0_f64, headway in 0.1..5.0_f64,
    ) {
        let missed = |remaining| 1.0 - literal_chance(1, headway, remaining);
        prop_assert!((missed(first + second) - missed(first) * missed(second)).abs() < 1e-12);
    }

    #[test]
    fn v30_more_room_helps_and_more_changes_do_not(
        reading in prop_oneof![Just(Literal), Just(Repaired)], changes in 1_u32..6, remaining in 0.0..900.0_f64,
        more in 0.0..100.0_f64, speed in 0.0..30.0_f64, spacing in 7.5..100.0_f64, mean in 0.0..30.0_f64,
    ) {
        let chance = |changes, remaining| returning(reading).chance(changes, remaining, speed, &flow(spacing, mean));
        let it = chance(changes, remaining);
        prop_assert!((0.0..=1.0).contains(&it));
        prop_assert!(chance(changes, remaining + more) >= it - 1e-9);
        prop_assert!(chance(changes + 1, remaining) <= it + 1e-9);
    }
}
