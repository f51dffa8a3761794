//! Properties of every model: it stays finite, and under the kinematic bound no vehicle collides.

use laneweave_models::braking::{HARDEST_BRAKING, is_secure, secure_speed};
use laneweave_models::follow::{
    Acc, Ahead, CarFollowing, FollowingModel, Fvdm, Gfm, GfmForm, Gipps, IdmPlus, Krauss, Newell, Ovm, Pace,
};
use proptest::prelude::*;

use crate::following::cars::Car;
use crate::following::sets::{k2010, literal_fvdm, literal_gfm, literal_ovm, t2000, urban};

fn any_model() -> impl Strategy<Value = FollowingModel> {
    prop_oneof![
        Just(t2000().model()),
        Just(k2010().model()),
        Just(urban().model()),
        Just(literal_fvdm()),
        Just(FollowingModel::Fvdm(Fvdm::default())),
        Just(FollowingModel::Acc(Acc::default())),
        Just(literal_ovm()),
        Just(FollowingModel::Ovm(Ovm::default())),
        Just(FollowingModel::Gfm(Gfm::default())),
        Just(literal_gfm()),
        Just(FollowingModel::Gfm(Gfm { form: GfmForm::Jiang, ..Gfm::default() })),
        Just(FollowingModel::Krauss(Krauss::default())),
        Just(FollowingModel::Gipps(Gipps::default())),
        Just(FollowingModel::Newell(Newell::default())),
        Just(FollowingModel::IdmPlus(IdmPlus::default())),
    ]
}

/// One step of a driver; the kinematic bound keeps it secure, and its braking is limited to that of a vehicle.
fn bounded_step(model: FollowingModel, desired: f64, car: Car, ahead: Ahead, dt: f64) -> Car {
    let wanted = car.speed + model.acceleration(Pace::new(car.speed, desired), Some(ahead)) * dt;
    let hardest = car.speed - HARDEST_BRAKING * dt;
    let next = wanted.min(secure_speed(car.speed, ahead, dt)).max(hardest).max(0.0);
    car.moved((next - car.speed) / dt, dt)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn v17_and_v18_from_a_secure_start_nobody_collides_under_the_kinematic_bound(
        model in any_model(), desired in 5.0..50.0_f64, speed in 0.0..40.0_f64, leader_speed in 0.0..40.0_f64,
        spare in 0.0..30.0_f64, dt in 0.02..0.5_f64,
        actions in prop::collection::vec((-HARDEST_BRAKING..3.0_f64, 1_usize..40), 1..20),
    ) {
        let lead = (speed * speed - leader_speed * leader_speed) / (2.0 * HARDEST_BRAKING);
        let gap = lead.max(0.0) + speed * dt + spare + 1e-9;
        let (mut leader, mut follower) = (Car::at_gap(gap, leader_speed), Car::at(0.0, speed));
        prop_assert!(is_secure(speed, follower.behind(leader), dt));
        for (action, steps) in actions {
            for _ in 0..steps {
                let ahead = follower.behind(leader);
                let next = bounded_step(model, desired, follower, ahead, dt);
                leader = leader.moved(action, dt);
                let acceleration = (next.speed - follower.speed) / dt;
                prop_assert!(next.speed >= 0.0 && next.position >= follower.position);
                prop_assert!(acceleration >= -HARDEST_BRAKING - 1e-9);
                follower = next;
                let left = follower.behind(leader).gap;
                prop_assert!(left > -1e-9, "gap {left}");
            }
        }
    }

    #[test]
    fn v18_accelerations_are_finite_and_no_harder_than_from_rest_on_a_free_road(
        model in any_model(), exponent in -3.0..6.0_f64, speed in prop_oneof![Just(0.0), 0.0..60.0_f64],
        leader_speed in prop_oneof![Just(0.0), 0.0..60.0_f64], desired in 1.0..60.0_f64,
        headway_relaxation in 0.4..1.0_f64, leader_acceleration in prop_oneof![Just(0.0), -HARDEST_BRAKING..5.0_f64],
    ) {
        let pace = Pace { speed, desired, headway_relaxation };
        let ahead = Ahead { gap: 10.0_f64.powf(exponent), speed: leader_speed, acceleration: leader_acceleration };
        let acceleration = model.acceleration(pace, Some(ahead));
        prop_assert!(acceleration.is_finite());
        let limit = match model {
            FollowingModel::Idm(idm) => idm.acceleration,
            FollowingModel::Fvdm(fvdm) => {
                fvdm.sensitivity * (desired - speed)
                    + fvdm.relative_sensitivity * (leader_speed - speed).max(0.0)
            }
            FollowingModel::Acc(acc) => acc.acceleration,
            FollowingModel::Ovm(ovm) => ovm.sensitivity * (desired - speed),
            FollowingModel::Gfm(gfm) if gfm.form == GfmForm::Jiang => gfm.sensitivity * (desired - speed),
            FollowingModel::Gfm(gfm) => (desired - speed) / gfm.adjustment_time,
            FollowingModel::Krauss(krauss) => krauss.acceleration,
            FollowingModel::Gipps(gipps) => gipps.acceleration,
            FollowingModel::IdmPlus(idm_plus) => idm_plus.acceleration,
            FollowingModel::Newell(newell) => (desired - speed) / (newell.time_gap * headway_relaxation).max(0.5),
        };
        prop_assert!(acceleration <= limit + 1e-9, "{acceleration} above {limit}");
        let anticipated_speed = model.anticipated_speed(pace, Some(ahead));
        prop_assert!((0.0..=desired).contains(&anticipated_speed));
    }
}
