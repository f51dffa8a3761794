//! Car-following against exact reference values: points, equilibria, capacities, expected speeds.

use laneweave_models::follow::{Ahead, CarFollowing, FollowingModel, Fvdm, Idm, Pace, speed_after};

use crate::following::cars::LENGTH;
use crate::following::sets::{k2010, literal_fvdm, t2000, urban};
use crate::near::assert_near;

/// Seconds in an hour.
const HOUR: f64 = 3600.0;

pub(crate) fn behind(gap: f64, speed: f64) -> Option<Ahead> {
    Some(Ahead::steady(gap, speed))
}

/// Speed [m/s] and flow [veh/h] of the largest flow in equilibrium, by ternary search.
pub(crate) fn optimum(model: FollowingModel, desired: f64) -> (f64, f64) {
    let flow = |speed: f64| HOUR * speed / (model.equilibrium_gap(Pace::new(speed, desired)) + LENGTH);
    let (mut low, mut high) = (0.0, desired);
    for _ in 0..100 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if flow(left) < flow(right) { low = left } else { high = right }
    }
    (low, flow(low))
}

#[test]
fn v1_idm_keeps_the_published_equilibrium_gaps() {
    let tables: [(_, &[(f64, f64)]); 3] = [
        (
            t2000(),
            &[
                (0.0, 2.0),
                (5.0, 10.002532),
                (10.0, 18.073346),
                (15.0, 26.550057),
                (20.0, 36.443449),
                (30.0, 85.261686),
            ],
        ),
        (
            k2010(),
            &[
                (0.0, 2.0),
                (5.0, 9.502406),
                (10.0, 17.069271),
                (15.0, 25.018323),
                (20.0, 34.299717),
                (30.0, 80.145985),
            ],
        ),
        (urban(), &[(0.0, 2.0), (5.0, 7.059538), (10.0, 14.032819)]),
    ];
    for (set, table) in tables {
        for &(speed, gap) in table {
            assert_near(set.model().equilibrium_gap(Pace::new(speed, set.desired)), gap, 1e-6);
            assert_near(set.idm.acceleration(Pace::new(speed, set.desired), behind(gap, speed)), 0.0, 1e-6);
        }
    }
}

#[test]
fn v1_idm_lanes_have_the_published_capacities() {
    let book = Idm { acceleration: 1.0, deceleration: 1.5, time_gap: 1.0, jam_gap: 2.0, exponent: 4.0 };
    // Set, desired speed [km/h], capacity [veh/h], its speed [km/h] and density [veh/km].
    for (idm, desired, capacity, speed, density) in [
        (t2000().idm, 120.0, 1742.784, 66.839, 26.074),
        (k2010().idm, 120.0, 1836.410, 67.573, 27.177),
        (urban().idm, 50.0, 1898.743, 34.178, 55.555),
    ] {
        let (best_speed, flow) = optimum(FollowingModel::Idm(idm), desired / 3.6);
        assert_near(flow, capacity, 1e-3);
        assert_near(best_speed * 3.6, speed, 1e-3);
        assert_near(flow / (best_speed * 3.6), density, 1e-3);
    }
    for (desired, capacity) in [(120.0, 2519.167), (54.0, 1957.485)] {
        assert_near(optimum(FollowingModel::Idm(book), desired / 3.6).1, capacity, 1e-3);
    }
}

#[test]
fn the_capacity_of_a_style_is_the_optimum_of_its_equilibria() {
    for (model, desired) in [
        (t2000().model(), t2000().desired),
        (urban().model(), urban().desired),
        (FollowingModel::Fvdm(Fvdm::default()), 120.0 / 3.6),
    ] {
        let capacity = HOUR * model.capacity(desired, LENGTH);
        let (_, optimum) = optimum(model, desired);
        assert!(capacity <= optimum + 1e-6 && capacity > optimum * (1.0 - 1e-4), "{capacity}, {optimum}");
    }
}

#[test]
fn v1_idm_and_v19_its_cut_in_brake_as_published() {
    let set = k2010();
    // v, v_l, s and the acceleration.
    for (speed, leader, gap, acceleration) in [
        (30.0, 30.0, 20.0, -7.250040),
        (30.0, 25.0, 20.0, -29.027423),
        (20.0, 20.0, 5.0, -56.125440),
        (20.0, 20.0, 20.0, -2.365440),
        (20.0, 25.0, 10.0, 1.155681),
        (10.0, 0.0, 20.0, -6.303645),
        (30.0, 30.0, 100.0, 0.172200),
    ] {
        let pace = Pace::new(speed, set.desired);
        assert_near(set.idm.acceleration(pace, behind(gap, leader)), acceleration, 1e-6);
    }
}

#[test]
fn v1_idm_answers_small_deviations_as_published() {
    const SMALL: f64 = 1e-5;
    // The slopes in the gap, the own speed (the leader's held) and the leader's speed, at 10 m/s in equilibrium.
    for (set, slopes) in
        [(t2000(), [0.080128, -0.495425, 0.364333]), (k2010(), [0.162709, -0.737760, 0.488167])]
    {
        let gap = set.model().equilibrium_gap(Pace::new(10.0, set.desired));
        let at = |[gap_off, speed_off, leader_off]: [f64; 3]| {
            let pace = Pace::new(10.0 + speed_off, set.desired);
            set.idm.acceleration(pace, behind(gap + gap_off, 10.0 + leader_off))
        };
        for (which, slope) in slopes.into_iter().enumerate() {
            let off = |by: f64| std::array::from_fn(|i| if i == which { by } else { 0.0 });
            assert_near((at(off(SMALL)) - at(off(-SMALL))) / (2.0 * SMALL), slope, 1e-6);
        }
    }
}

#[test]
fn idm_takes_no_gap_below_a_tenth_of_a_metre() {
    let (set, pace) = (urban(), Pace::new(5.0, urban().desired));
    let at = |gap| set.idm.acceleration(pace, behind(gap, 5.0));
    for gap in [-1.0, 0.0, 0.05] {
        assert_eq!(at(gap), at(0.1));
    }
    assert!(at(0.1) < at(0.1001));
}

#[test]
fn v1_idm_prospects_of_a_town_street() {
    let set = urban();
    let pace = Pace::new(10.0, set.desired);
    assert_near(set.idm.anticipated_speed(pace, behind(20.0, 8.0)), 9.714697, 1e-6);
    assert_near(set.idm.anticipated_speed(pace, behind(35.0, 10.0)), 10.613710, 1e-6);
    assert_eq!(set.idm.anticipated_speed(pace, behind(6.0, 2.0)), 0.0);
    assert_near(10.0 + set.idm.acceleration(pace, behind(6.0, 2.0)), -44.67, 5e-3);
}

#[test]
fn an_idm_driver_does_not_brake_for_a_leader_that_pulls_away() {
    // s* stays at s₀: without the floor it would be negative here, and its square a braking of 33 m/s².
    let set = urban();
    let pulled_away = set.idm.acceleration(Pace::new(10.0, set.desired), behind(5.0, 20.0));
    assert_near(pulled_away, 1.0 - 0.72_f64.powi(4) - (2.0_f64 / 5.0).powi(2), 1e-12);
}

#[test]
fn idm_with_another_exponent_fades_as_its_power_says() {
    for exponent in [1.0, 2.0, 3.9999999, 8.0] {
        let idm = Idm { exponent, ..urban().idm };
        assert_near(idm.acceleration(Pace::new(6.0, 10.0), None), 1.0 - 0.6_f64.powf(exponent), 1e-12);
    }
    let (usual, nearly) = (urban().idm, Idm { exponent: 4.0 + 1e-12, ..urban().idm });
    let pace = Pace::new(7.0, 13.0);
    assert_near(usual.acceleration(pace, None), nearly.acceleration(pace, None), 1e-12);
}

#[test]
fn a_prospect_lies_between_standstill_and_the_desired_speed() {
    let pace = Pace::new(10.0, 12.0);
    assert_eq!(speed_after(1.5, pace), 11.5);
    assert_eq!(speed_after(2.5, pace), 12.0);
    assert_eq!(speed_after(-9.0, pace), 1.0);
    assert_eq!(speed_after(-11.0, pace), 0.0);
    assert_eq!(literal_fvdm().anticipated_speed(pace, None), 12.0);
    assert_eq!(literal_fvdm().anticipated_speed(pace, Some(Ahead::standing(0.0))), 0.0);
}
