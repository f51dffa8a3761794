//! The less usual models against exact reference values.

use laneweave_models::follow::{
    Acc, Ahead, CarFollowing, FollowingModel, Fvdm, Gfm, GfmForm, Gipps, Idm, Krauss, Newell, Ovm, Pace,
};

use crate::following::cars::LENGTH;
use crate::following::points::{behind, optimum};
use crate::following::sets::{k2010, t2000, urban};
use crate::near::assert_near;

#[test]
fn v2_acc_brakes_as_published() {
    let (acc, set) = (Acc::default(), k2010());
    assert_eq!(acc.idm(), set.idm);
    // v, v_l, s and a_l; IDM's acceleration, the heuristic's and the resulting one.
    for (speed, leader, gap, leader_acceleration, by_idm, heuristic, acceleration) in [
        (30.0, 30.0, 20.0, 0.0, -7.250040, 0.0, -2.049690),
        (30.0, 25.0, 20.0, 0.0, -29.027423, -0.625, -2.889024),
        (20.0, 20.0, 5.0, 0.0, -56.125440, 0.0, -2.541254),
        (20.0, 20.0, 20.0, -3.0, -2.365440, -2.307692, -2.365424),
        (20.0, 25.0, 10.0, 0.0, 1.155681, 0.0, 1.155681),
        (10.0, 0.0, 20.0, 0.0, -6.303645, -2.5, -4.431695),
        (30.0, 30.0, 100.0, 1.0, 0.172200, 1.0, 0.215999),
    ] {
        let pace = Pace::new(speed, set.desired);
        let ahead = Ahead { gap, speed: leader, acceleration: leader_acceleration };
        assert_near(acc.idm().acceleration(pace, Some(ahead)), by_idm, 1e-6);
        assert_near(acc.heuristic(pace, ahead), heuristic, 1e-6);
        assert_near(acc.acceleration(pace, Some(ahead)), acceleration, 1e-6);
    }
}

#[test]
fn v2_acc_believes_no_leader_to_accelerate_harder_than_itself() {
    let (acc, pace) = (Acc::default(), Pace::new(30.0, k2010().desired));
    let at = |acceleration| acc.acceleration(pace, Some(Ahead { gap: 30.0, speed: 29.0, acceleration }));
    assert!(at(1.0) < at(1.4));
    assert_eq!(at(1.4), at(4.0));
}

#[test]
fn acc_on_the_free_road_or_without_coolness_is_idm() {
    let (acc, pace) = (Acc::default(), Pace::new(22.0, k2010().desired));
    assert_eq!(acc.acceleration(pace, None), acc.idm().acceleration(pace, None));
    let worried = Acc { coolness: 0.0, ..acc };
    for (gap, leader) in [(5.0, 20.0), (30.0, 10.0), (80.0, 22.0)] {
        let ahead = behind(gap, leader);
        assert_near(worried.acceleration(pace, ahead), acc.idm().acceleration(pace, ahead), 1e-12);
    }
}

#[test]
fn acc_is_not_puzzled_by_a_leader_who_stands() {
    // 0/0 in the first line of the heuristic; a vehicle that stands there has stopped a moment ago as well.
    let (acc, pace) = (Acc::default(), Pace::new(10.0, k2010().desired));
    let stopping = |acceleration| acc.heuristic(pace, Ahead { gap: 20.0, speed: 0.0, acceleration });
    for acceleration in [0.0, -1e-9, -3.0] {
        assert_near(stopping(acceleration), -2.5, 1e-9);
    }
    let standing = Pace::new(0.0, k2010().desired);
    let (both_stand, starts) = (Ahead::standing(5.0), Ahead { acceleration: 1.0, ..Ahead::standing(5.0) });
    assert_eq!(acc.heuristic(standing, both_stand), 0.0);
    assert_eq!(acc.heuristic(standing, starts), 1.0);
}

#[test]
fn v19_a_cut_in_frightens_idm_and_not_acc() {
    let (set, pace) = (k2010(), Pace::new(20.0, k2010().desired));
    assert_near(set.model().acceleration(pace, behind(5.0, 20.0)), -56.1254, 1e-4);
    assert_near(set.enhanced().acceleration(pace, behind(5.0, 20.0)), -2.5413, 1e-4);
}

#[test]
fn v4_krauss_drivers_are_as_fast_as_is_safe() {
    let krauss = Krauss { jam_gap: 0.0, ..Krauss::default() };
    let after = |speed, gap, leader| speed + krauss.acceleration(Pace::new(speed, 50.0), behind(gap, leader));
    assert_near(after(12.0, 20.0, 10.0), 12.827723, 1e-6);
    assert_near(after(10.0, 10.0, 10.0), 10.0, 1e-12);
    assert_near(after(17.0, 50.0, 0.0), 17.185248, 1e-6);
    // No harder than it can, and no faster than its desired speed.
    assert_near(after(5.0, 100.0, 10.0), 5.0 + 2.6, 1e-12);
    assert_near(49.0 + krauss.acceleration(Pace::new(49.0, 50.0), None), 50.0, 1e-12);
}

#[test]
fn v4_the_safe_speed_of_krauss_agrees_with_the_line_that_he_prints() {
    // v_l + (g − v_l τ)/((v + v_l)/2b + τ) with v = 10 is the published point; with v_safe itself for v it is v_safe.
    let printed = |speed: f64| 10.0 + (20.0 - 10.0) / ((speed + 10.0) / (2.0 * 4.5) + 1.0);
    assert_near(printed(10.0), 13.103448, 1e-6);
    let krauss = Krauss { jam_gap: 0.0, ..Krauss::default() };
    let safe = 12.0 + krauss.acceleration(Pace::new(12.0, 50.0), behind(20.0, 10.0));
    assert_near(printed(safe), safe, 1e-12);
}

#[test]
fn v4_gipps_drivers_take_the_lower_of_two_speeds() {
    let gipps = Gipps { jam_gap: 0.0, ..Gipps::default() };
    let after = |ahead| 10.0 + 2.0 / 3.0 * gipps.acceleration(Pace::new(10.0, 20.0), ahead);
    assert_near(after(None), 11.026473, 1e-6);
    assert_near(after(behind(15.0, 8.0)), 10.081253, 1e-6);
    assert_near(after(behind(100.0, 8.0)), 11.026473, 1e-6);
}

#[test]
fn v4_newell_lanes_have_triangular_fundamental_diagrams() {
    // v₀ [m/s], τ [s], d [m], capacity [veh/h] and the speed of jams [km/h].
    for (desired, time_gap, distance, capacity, jam_speed) in
        [(120.0 / 3.6, 1.0, 7.5, 2938.776, -27.0), (50.0 / 3.6, 1.2, 7.0, 2112.676, -21.0)]
    {
        let model = FollowingModel::Newell(Newell { time_gap, jam_gap: distance - LENGTH });
        assert_near(optimum(model, desired).1, capacity, 1e-3);
        // dq/dk on the congested branch, q = v/(s_e + l), k = 1/(s_e + l).
        let [slow, fast] = [2.0, 9.0].map(|speed| {
            let density = 1.0 / (model.equilibrium_gap(Pace::new(speed, desired)) + LENGTH);
            (density, speed * density)
        });
        assert_near(3.6 * (fast.1 - slow.1) / (fast.0 - slow.0), jam_speed, 1e-6);
    }
    let default = Newell::default();
    assert_near(3.6 * -(LENGTH + default.jam_gap) / default.time_gap, -16.8, 1e-12);
}

#[test]
fn v4_wiedemanns_distances() {
    // W74: AX + (BX_add + BX_mult z) √v with 2, 2 and 3; W99: CC0 + CC1 v, the gap of Krauss and Newell.
    let w74 = |speed: f64, z: f64| 2.0 + (2.0 + 3.0 * z) * speed.sqrt();
    assert_near(w74(15.0, 0.5), 15.555442, 1e-6);
    let w99 = Newell { time_gap: 0.9, jam_gap: 1.5 };
    let same = Krauss { time_gap: 0.9, jam_gap: 1.5, ..Krauss::default() };
    for model in [FollowingModel::Newell(w99), FollowingModel::Krauss(same)] {
        assert_near(model.equilibrium_gap(Pace::new(15.0, 30.0)), 15.0, 1e-6);
    }
}

fn all_with_a_jam_gap(jam_gap: f64) -> [FollowingModel; 9] {
    [
        FollowingModel::Idm(Idm { jam_gap, ..urban().idm }),
        FollowingModel::Acc(Acc { jam_gap, ..Acc::default() }),
        FollowingModel::Fvdm(Fvdm { jam_gap, ..Fvdm::default() }),
        FollowingModel::Ovm(Ovm { jam_gap, ..Ovm::default() }),
        FollowingModel::Gfm(Gfm { jam_gap, ..Gfm::default() }),
        FollowingModel::Gfm(Gfm { form: GfmForm::Jiang, jam_gap, ..Gfm::default() }),
        FollowingModel::Krauss(Krauss { jam_gap, ..Krauss::default() }),
        FollowingModel::Gipps(Gipps { jam_gap, ..Gipps::default() }),
        FollowingModel::Newell(Newell { jam_gap, ..Newell::default() }),
    ]
}

#[test]
fn who_stands_keeps_the_jam_gap_whatever_the_model() {
    for model in all_with_a_jam_gap(1.7) {
        assert_near(model.equilibrium_gap(Pace::new(0.0, 20.0)), 1.7, 1e-6);
    }
}

#[test]
fn nobody_keeps_a_gap_at_which_to_drive_as_fast_as_desired() {
    for model in all_with_a_jam_gap(2.0) {
        assert_eq!(model.equilibrium_gap(Pace::new(14.0, 14.0)), f64::INFINITY);
        assert!(model.equilibrium_gap(Pace::new(13.0, 14.0)).is_finite());
    }
}

#[test]
fn acc_keeps_the_gaps_of_idm() {
    for set in [t2000(), k2010(), urban()] {
        for speed in [0.0, 5.0, 10.0, 13.0] {
            let pace = Pace::new(speed, set.desired);
            let [cool, usual] = [set.enhanced(), set.model()].map(|it| it.equilibrium_gap(pace));
            assert_near(cool, usual, 1e-6);
        }
    }
}

#[test]
fn a_tight_driver_keeps_its_share_of_the_time_gap() {
    // IDM, ACC, GFM, Krauss and Gipps, each with 0.8 of its time gap and above half a second.
    let (relaxed, ahead) = (Pace::new(10.0, 13.0), behind(15.0, 9.0));
    let tight = Pace { headway_relaxation: 0.8, ..relaxed };
    let idm = urban().idm;
    let short = Idm { time_gap: 0.8 * idm.time_gap, ..idm };
    assert_near(idm.acceleration(tight, ahead), short.acceleration(relaxed, ahead), 1e-12);
    let acc = Acc::default();
    let short = Acc { time_gap: 0.8 * acc.time_gap, ..acc };
    assert_near(acc.acceleration(tight, ahead), short.acceleration(relaxed, ahead), 1e-12);
    let gfm = Gfm::default();
    let short = Gfm { time_gap: 0.8 * gfm.time_gap, ..gfm };
    assert_near(gfm.acceleration(tight, ahead), short.acceleration(relaxed, ahead), 1e-12);
    let newell = Newell::default();
    let short = Newell { time_gap: 0.8 * newell.time_gap, ..newell };
    assert_near(newell.acceleration(tight, ahead), short.acceleration(relaxed, ahead), 1e-12);
    // Krauss and Gipps expect a shorter reaction, but adjust their speeds as fast as ever.
    let ahead = behind(8.0, 9.0);
    let krauss = Krauss::default();
    let short = Krauss { time_gap: 0.8 * krauss.time_gap, ..krauss };
    let [tight_wish, short_wish] = [krauss.acceleration(tight, ahead), short.acceleration(relaxed, ahead)];
    assert_near(tight_wish, 0.8 * short_wish, 1e-12);
    let gipps = Gipps::default();
    let short = Gipps { reaction_time: 0.8 * gipps.reaction_time, ..gipps };
    let [tight_wish, short_wish] = [gipps.acceleration(tight, ahead), short.acceleration(relaxed, ahead)];
    assert_near(tight_wish, 0.8 * short_wish, 1e-12);
}

#[test]
fn every_model_lets_a_tight_driver_come_closer() {
    for model in all_with_a_jam_gap(2.0) {
        let relaxed = Pace::new(10.0, 14.0);
        let gaps = [1.0, 0.8]
            .map(|headway_relaxation| model.equilibrium_gap(Pace { headway_relaxation, ..relaxed }));
        assert!(gaps[1] < gaps[0] - 0.5, "{model:?}: {gaps:?}");
    }
}
