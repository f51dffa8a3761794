//! What drivers with errors see (the Human Driver Model).

use crate::near::assert_near;
use laneweave_models::Misperception;
use laneweave_models::follow::Ahead;

#[test]
fn a_usual_error_is_five_percent_of_the_gap_and_a_hundredth_of_it_in_speed() {
    let usual = Misperception::new(1.0, [1.0, 1.0]);
    let seen = usual.of_leader(Ahead { gap: 40.0, speed: 20.0, acceleration: -1.0 });
    // 40 e^.05, and .01 · 40 m/s slower.
    assert_near(seen.gap, 42.050844, 1e-6);
    assert_near(seen.speed, 19.6, 1e-12);
    assert_eq!(seen.acceleration, -1.0);
    // A follower seems faster for the same error: both gaps seem to close faster.
    let (gap, speed) = usual.of_follower(40.0, 25.0);
    assert_near(gap, 42.050844, 1e-6);
    assert_near(speed, 25.4, 1e-12);
}

#[test]
fn errors_grow_with_their_size_and_have_either_sign() {
    let seen = Misperception::new(3.0, [-2.0, -0.5]).of_leader(Ahead::steady(10.0, 15.0));
    // 10 e^(−.3), and .01 · 3 · .5 · 10 m/s faster.
    assert_near(seen.gap, 7.408182, 1e-6);
    assert_near(seen.speed, 15.15, 1e-12);
}

#[test]
fn nobody_sees_a_vehicle_that_drives_backwards_and_touching_it_has_no_error() {
    let usual = Misperception::new(1.0, [0.0, 1.0]);
    assert_eq!(usual.of_leader(Ahead::standing(50.0)), Ahead::standing(50.0));
    assert_eq!(usual.of_leader(Ahead::steady(0.0, 5.0)), Ahead::steady(0.0, 5.0));
    assert_eq!(usual.of_follower(-1.0, 5.0).1, 5.0);
}
