//! The optimal velocity, and the models that steer towards it, against exact reference values.

use laneweave_models::Reading;
use laneweave_models::follow::{
    Ahead, CarFollowing, FollowingModel, Fvdm, Gfm, GfmForm, OptimalVelocity, Ovm, Pace,
};

use crate::following::points::{behind, optimum};
use crate::following::sets::{literal_fvdm, literal_gfm, literal_ovm};
use crate::near::assert_near;

const LITERAL: OptimalVelocity =
    OptimalVelocity { reading: Reading::Literal, jam_gap: 0.0, length_scale: 1.0 };
const REPAIRED: OptimalVelocity =
    OptimalVelocity { reading: Reading::Repaired, jam_gap: 0.0, length_scale: 1.0 };

#[test]
fn v3_the_literal_optimal_velocity() {
    let pace = Pace::new(10.0, 50.0);
    for (gap, speed) in [(5.0, 1.008151), (10.0, 4.664728), (20.0, 12.871615)] {
        assert_near(LITERAL.expected(pace, gap), speed, 1e-6);
    }
    // V(0) = −0.503674: no driver expects to drive backwards, but a follower brakes for it.
    assert_eq!(LITERAL.expected(pace, 0.0), 0.0);
    let touching = literal_fvdm().acceleration(Pace::new(0.0, 50.0), Some(Ahead::standing(0.0)));
    assert_near(touching, 0.41 * -0.503674, 1e-6);
    assert_near(LITERAL.expected(pace, f64::INFINITY), 14.66, 1e-12);
    // V rises most steeply at the gap C₂/C₁, where it is V₁.
    assert_near(LITERAL.expected(pace, 1.57 / 0.13), 6.75, 1e-12);
}

#[test]
fn v3_the_repaired_optimal_velocity_scales_speed_and_length() {
    let motorway = Pace::new(10.0, 120.0 / 3.6);
    assert_near(REPAIRED.expected(motorway, 20.0), 8.948182, 1e-6);
    assert_near(REPAIRED.expected(motorway, 40.0), 26.639331, 1e-6);
    assert_near(REPAIRED.expected(Pace::new(10.0, 50.0 / 3.6), 20.0), 12.625809, 1e-6);
    for desired in [5.0, 50.0 / 3.6, 120.0 / 3.6] {
        let pace = Pace::new(3.0, desired);
        assert_near(REPAIRED.expected(pace, 0.0), 0.0, 1e-12);
        assert_near(REPAIRED.expected(pace, f64::INFINITY), desired, 1e-12);
    }
}

#[test]
fn v3_fvdm_accelerates_as_published() {
    let at_ten = Pace::new(10.0, 50.0);
    assert_near(literal_fvdm().acceleration(at_ten, behind(20.0, 8.0)), 0.177362, 1e-6);
    assert_near(literal_fvdm().acceleration(at_ten, behind(20.0, 12.0)), 2.177362, 1e-6);
    assert_near(literal_fvdm().acceleration(Pace::new(0.0, 50.0), None), 6.010600, 1e-6);
}

#[test]
fn v3_fvdm_ignores_relative_speed_beyond_its_range() {
    let pace = Pace::new(10.0, 50.0);
    let of_gap = |gap| {
        literal_fvdm().acceleration(pace, behind(gap, 4.0))
            - literal_fvdm().acceleration(pace, behind(gap, 10.0))
    };
    assert_near(of_gap(100.0), -3.0, 1e-12);
    assert_eq!(of_gap(100.001), 0.0);
    // The repaired range is a length and scales with the others: 100 · 29.32/14.66.
    let pace = Pace::new(10.0, 29.32);
    let fvdm = Fvdm::default();
    let of_gap = |gap| fvdm.acceleration(pace, behind(gap, 4.0)) - fvdm.acceleration(pace, behind(gap, 10.0));
    assert_near(of_gap(199.999), -3.0, 1e-12);
    assert_eq!(of_gap(200.001), 0.0);
}

#[test]
fn v3_fvdm_lanes_have_the_published_capacities() {
    let (speed, flow) = optimum(literal_fvdm(), 14.66);
    assert_near(flow, 1862.610, 1e-3);
    assert_near(speed, 12.325554, 1e-4);
    let gap = literal_fvdm().equilibrium_gap(Pace::new(speed, 14.66));
    assert_near(gap, 18.822, 1e-3);
    let (_, flow) = optimum(FollowingModel::Fvdm(Fvdm::default()), 120.0 / 3.6);
    assert_near(flow, 2132.0, 0.5);
}

#[test]
fn a_jam_gap_shifts_the_repaired_optimal_velocity() {
    let (shifted, pace) = (OptimalVelocity { jam_gap: 2.0, ..REPAIRED }, Pace::new(5.0, 20.0));
    for gap in [0.0, 2.0, 7.0, 30.0] {
        let beyond = f64::max(gap - 2.0, 0.0);
        assert_eq!(shifted.expected(pace, gap), REPAIRED.expected(pace, beyond));
    }
}

#[test]
fn fvdm_ovm_and_gfm_expect_the_speed_that_they_steer_towards() {
    let pace = Pace { headway_relaxation: 0.8, ..Pace::new(10.0, 30.0) };
    let shifted = OptimalVelocity { jam_gap: 1.5, ..REPAIRED };
    let gfm = Gfm { form: GfmForm::Jiang, jam_gap: 1.5, ..Gfm::default() };
    for model in [
        FollowingModel::Fvdm(Fvdm { jam_gap: 1.5, ..Fvdm::default() }),
        FollowingModel::Ovm(Ovm { jam_gap: 1.5, ..Ovm::default() }),
        FollowingModel::Gfm(gfm),
    ] {
        assert_eq!(model.anticipated_speed(pace, behind(22.0, 9.0)), shifted.expected(pace, 22.0));
        assert_eq!(model.anticipated_speed(pace, None), shifted.expected(pace, f64::INFINITY));
    }
}

#[test]
fn v3_ovm_accelerates_as_hard_as_nobody_can() {
    assert_near(literal_ovm().acceleration(Pace::new(0.0, 50.0), None), 12.461, 1e-12);
    // It does not see how fast the leader is.
    let at_ten = Pace::new(10.0, 50.0);
    for leader in [0.0, 10.0, 30.0] {
        assert_near(literal_ovm().acceleration(at_ten, behind(20.0, leader)), 0.85 * 2.871615, 1e-6);
    }
}

#[test]
fn v3_gfm_brakes_while_closing_in_and_then_only() {
    // Jiang, Wu, Zhu: where FVDM says 0.177362 and 2.177362.
    let at_ten = Pace::new(10.0, 50.0);
    assert_near(literal_gfm().acceleration(at_ten, behind(20.0, 8.0)), 0.177362, 1e-6);
    assert_near(literal_gfm().acceleration(at_ten, behind(20.0, 12.0)), 1.177362, 1e-6);
    let of_gap = |gap| {
        literal_gfm().acceleration(at_ten, behind(gap, 4.0))
            - literal_gfm().acceleration(at_ten, behind(gap, 10.0))
    };
    assert_near(of_gap(100.0), -3.0, 1e-12);
    assert_eq!(of_gap(100.001), 0.0);
    // Helbing, Tilch.
    let (gfm, at_ten) = (Gfm::default(), Pace::new(10.0, 16.98));
    assert_near(gfm.anticipated_speed(at_ten, behind(20.0, 10.0)), 14.698392, 1e-6);
    assert_near(gfm.acceleration(at_ten, behind(20.0, 10.0)), 1.917711, 1e-6);
    assert_near(gfm.acceleration(at_ten, behind(20.0, 8.0)), -0.400802, 1e-6);
    assert_eq!(gfm.acceleration(at_ten, behind(20.0, 15.0)), gfm.acceleration(at_ten, behind(20.0, 10.0)));
    assert_near(gfm.acceleration(at_ten, None), 6.98 / 2.45, 1e-12);
    assert_near(FollowingModel::Gfm(gfm).equilibrium_gap(at_ten), 13.749439, 1e-6);
}

#[test]
fn a_tight_driver_sees_a_larger_gap() {
    let relaxed = Pace::new(10.0, 13.0);
    let tight = Pace { headway_relaxation: 0.6, ..relaxed };
    for optimal in [LITERAL, REPAIRED] {
        assert_near(optimal.expected(tight, 12.0), optimal.expected(relaxed, 20.0), 1e-12);
    }
    // Standing still, a driver in headway relaxation keeps the same jam gap as a relaxed one.
    let shifted = OptimalVelocity { jam_gap: 2.0, ..REPAIRED };
    assert_near(shifted.expected(tight, 2.0), 0.0, 1e-12);
    assert_near(shifted.expected(tight, 2.0 + 12.0), shifted.expected(relaxed, 2.0 + 20.0), 1e-12);
}

#[test]
fn who_closes_in_by_five_metres_per_second_takes_no_liberties_with_the_gap() {
    let relaxed = Pace::new(10.0, 13.0);
    let tight = Pace { headway_relaxation: 0.6, ..relaxed };
    for model in [literal_fvdm(), literal_ovm(), literal_gfm()] {
        let gain = |leader| {
            model.acceleration(tight, behind(12.0, leader))
                - model.acceleration(relaxed, behind(12.0, leader))
        };
        assert_eq!(gain(5.0), 0.0);
        assert!(gain(7.0) > 0.0 && gain(7.0) < gain(10.0));
        assert_eq!(gain(11.0), gain(10.0));
    }
}
