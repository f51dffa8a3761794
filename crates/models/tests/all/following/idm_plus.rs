//! IDM+ beside IDM.

use laneweave_models::follow::{CarFollowing, FollowingModel, Idm, IdmPlus, Pace};
use proptest::prelude::*;

use crate::following::cars::LENGTH;
use crate::following::points::behind;

/// A usual driver [m/s].
const DESIRED: f64 = 30.0;

#[test]
fn drivers_keep_their_time_gap_at_any_speed_below_the_desired_one() {
    let driver = IdmPlus::default();
    let gap = |speed: f64| FollowingModel::IdmPlus(driver).equilibrium_gap(Pace::new(speed, DESIRED));
    for share in [0.0, 0.3, 0.6, 0.9, 0.99] {
        let speed = share * DESIRED;
        let kept = driver.jam_gap + speed * driver.time_gap;
        assert!((gap(speed) - kept).abs() < 1e-6, "{speed} m/s: {} m", gap(speed));
    }
    // By hand: at 27 m/s the IDM of the same numbers keeps (3 + 27 · 1.2) / √(1 − .9⁴) = 60.4 m, IDM+ 35.4 m.
    let idm = FollowingModel::Idm(driver.idm()).equilibrium_gap(Pace::new(27.0, DESIRED));
    assert!((idm - 35.4 / (1.0_f64 - 0.6561).sqrt()).abs() < 1e-6, "{idm} m");
}

#[test]
fn a_lane_carries_more_than_with_the_idm_of_the_same_numbers() {
    let driver = IdmPlus::default();
    let [idm, idm_plus] = [FollowingModel::Idm(driver.idm()), FollowingModel::IdmPlus(driver)]
        .map(|it| 3600.0 * it.capacity(DESIRED, LENGTH));
    // By hand: the largest of 3600 v / (3 + 1.2 v + length) is at the desired speed, less a 500th.
    let speed = DESIRED * 499.0 / 500.0;
    assert!((idm_plus - 3600.0 * speed / (3.0 + 1.2 * speed + LENGTH)).abs() < 1e-3, "{idm_plus} veh/h");
    assert!(idm_plus > 1.15 * idm, "{idm_plus} and {idm} veh/h");
}

proptest! {
    #[test]
    fn drivers_accelerate_as_idm_where_one_of_its_terms_is_nothing_and_never_less(
        speed in 0.0..40.0_f64, gap in 0.5..200.0_f64, leader in 0.0..40.0_f64,
    ) {
        let driver = IdmPlus::default();
        let idm: Idm = driver.idm();
        let pace = Pace::new(speed, DESIRED);
        prop_assert_eq!(driver.acceleration(pace, None), idm.acceleration(pace, None));
        let from_rest = Pace::new(0.0, DESIRED);
        let ahead = behind(gap, leader);
        prop_assert!((driver.acceleration(from_rest, ahead) - idm.acceleration(from_rest, ahead)).abs() < 1e-12);
        prop_assert!(driver.acceleration(pace, ahead) >= idm.acceleration(pace, ahead) - 1e-12);
    }
}
