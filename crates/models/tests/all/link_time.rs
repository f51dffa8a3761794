//! Time on a section of road.

use laneweave_models::change::{bpr, link_time};
use proptest::prelude::*;

#[test]
fn v31_the_time_on_a_section_grows_with_the_fourth_power_of_its_load() {
    let times = [0.0, 0.5, 0.8, 1.0, 1.5].map(|load| bpr(36.0, load));
    for (time, expected) in times.into_iter().zip([36.0, 36.3375, 38.211840, 41.4, 63.3375]) {
        assert!((time - expected).abs() < 1e-6, "{time} is not {expected}");
    }
}

#[test]
fn v31_the_misplaced_brace_is_not_read_as_printed() {
    // The exponent is that of q/q_max alone: neither that of k_1 q/q_max, nor k_2 to that power.
    let time = bpr(36.0, 0.8);
    assert!((time - 36.0 * (1.0 + (0.15 * 0.8_f64).powi(4))).abs() > 2.0);
    assert!((time - 36.0).abs() > 2.0);
}

#[test]
fn v31_a_jam_takes_the_time_of_its_speed_though_its_flow_is_low() {
    // 500 m in 36 s when free; 900 of 1800 veh/h at 2.5 m/s.
    assert!((link_time(36.0, 0.5, 500.0, 2.5) - 200.0).abs() < 1e-12);
    assert_eq!(link_time(36.0, 0.5, 500.0, 500.0 / 36.0), bpr(36.0, 0.5));
    // Where no vehicle moves it is finite.
    assert_eq!(link_time(36.0, 0.0, 500.0, 0.0), 500.0);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn v31_more_load_and_less_speed_never_take_less_time(
        load in 0.0..2.0_f64, more in 0.0..1.0_f64, speed in 0.0..40.0_f64, less in 0.0..1.0_f64,
    ) {
        let time = link_time(36.0, load, 500.0, speed);
        prop_assert!(time >= 36.0 && time.is_finite());
        prop_assert!(link_time(36.0, load + more, 500.0, speed) >= time);
        prop_assert!(link_time(36.0, load, 500.0, speed * less) >= time);
    }
}
