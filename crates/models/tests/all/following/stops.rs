//! Emergencies: the leader brakes as hard as vehicles can, or stands.

use laneweave_models::braking::HARDEST_BRAKING;
use laneweave_models::follow::{FollowingModel, Gfm, Gipps, Krauss, Newell, Pace};

use crate::following::cars::Car;
use crate::following::sets::{k2010, literal_fvdm, literal_gfm, literal_ovm, t2000};
use crate::near::assert_near;

/// The result for a follower whose leader brakes until it stands.
pub(crate) struct Stop {
    pub(crate) shortest_gap: f64,
    pub(crate) final_gap: f64,
    pub(crate) hardest_braking: f64,
    /// Speed at which the follower hit the leader [m/s]; 0 if it did not.
    pub(crate) impact: f64,
}

/// A follower at `speed` [m/s] whose leader brakes at `leader_braking` [m/s²].
pub(crate) fn emergency(
    model: FollowingModel,
    desired: f64,
    speed: f64,
    leader: Car,
    leader_braking: f64,
    dt: f64,
) -> Stop {
    const LONG: f64 = 60.0;
    let (mut leader, mut follower) = (leader, Car::at(0.0, speed));
    leader.acceleration = -leader_braking;
    let mut stop = Stop { shortest_gap: f64::INFINITY, final_gap: 0.0, hardest_braking: 0.0, impact: 0.0 };
    for _ in 0..(LONG / dt) as usize {
        let acceleration = follower.wish(&model, desired, Some(leader));
        follower = follower.moved(acceleration, dt);
        let braking = if leader.speed > 0.0 { leader_braking } else { 0.0 };
        leader = leader.moved(-braking, dt);
        stop.final_gap = follower.behind(leader).gap;
        if stop.final_gap < 0.0 && stop.shortest_gap >= 0.0 {
            stop.impact = follower.speed - leader.speed;
        }
        stop.shortest_gap = stop.shortest_gap.min(stop.final_gap);
        if follower.speed > 0.0 {
            stop.hardest_braking = stop.hardest_braking.max(-acceleration);
        }
    }
    stop
}

/// A follower in equilibrium at `speed` [m/s] whose leader brakes as hard as possible.
fn from_equilibrium(model: FollowingModel, desired: f64, speed: f64, dt: f64) -> Stop {
    let gap = model.equilibrium_gap(Pace::new(speed, desired));
    emergency(model, desired, speed, Car::at_gap(gap, speed), HARDEST_BRAKING, dt)
}

/// Steps [s] up to the longest that the catalogue requires.
const STEPS: [f64; 5] = [0.01, 0.05, 0.1, 0.2, 0.25];

#[test]
fn v17_idm_and_acc_drivers_survive_a_leader_who_brakes_as_hard_as_possible() {
    for set in [t2000(), k2010()] {
        for model in [set.model(), set.enhanced()] {
            for dt in STEPS {
                let stop = from_equilibrium(model, set.desired, 20.0, dt);
                assert!(stop.shortest_gap > 0.0, "dt {dt}: gap {}", stop.shortest_gap);
            }
        }
    }
    let set = k2010();
    for (model, final_gap, braking) in [(set.model(), 1.997, 6.204), (set.enhanced(), 1.996, 5.311)] {
        let stop = from_equilibrium(model, set.desired, 20.0, 0.01);
        assert_near(stop.final_gap, final_gap, 0.02);
        assert_near(stop.hardest_braking, braking, 0.02 * braking);
    }
}

/// The shortest gap [m] of a literal FVDM follower at `speed` [m/s] that does not end in a collision.
fn shortest_safe_gap(speed: f64, leader_speed: f64) -> f64 {
    let collides = |gap: f64| {
        emergency(literal_fvdm(), 50.0, speed, Car::at_gap(gap, leader_speed), HARDEST_BRAKING, 0.002)
            .shortest_gap
            < 0.0
    };
    let (mut short, mut long) = (1.0, 60.0);
    while long - short > 1e-3 {
        let middle = 0.5 * (short + long);
        if collides(middle) { short = middle } else { long = middle }
    }
    long
}

#[test]
fn v17_fvdm_alone_collides_below_the_published_gaps() {
    for (speed, behind_braking, behind_standing) in
        [(10.0, 9.792, 11.992), (13.0, 14.637, 17.097), (14.0, 16.673, 18.914)]
    {
        assert_near(shortest_safe_gap(speed, speed), behind_braking, 0.05);
        assert_near(shortest_safe_gap(speed, 0.0), behind_standing, 0.05);
    }
}

#[test]
fn v17_fvdm_survives_from_its_own_equilibrium() {
    for (speed, gap, left, braking) in
        [(10.0, 15.436, 1.363, 4.42), (13.0, 20.322, 1.009, 5.13), (14.0, 24.131, 1.334, 4.89)]
    {
        let equilibrium = literal_fvdm().equilibrium_gap(Pace::new(speed, 50.0));
        assert_near(equilibrium, gap, 1e-3);
        let stop =
            emergency(literal_fvdm(), 50.0, speed, Car::at_gap(equilibrium, speed), HARDEST_BRAKING, 0.01);
        assert_near(stop.shortest_gap, left, 0.02);
        assert_near(stop.hardest_braking, braking, 0.02);
    }
}

#[test]
#[expect(clippy::approx_constant, reason = "a speed")]
fn v17_ovm_crashes_even_from_its_own_equilibrium() {
    for (speed, impact) in [(10.0, 1.469), (13.0, 3.142)] {
        let stop = from_equilibrium(literal_ovm(), 50.0, speed, 0.01);
        assert!(stop.shortest_gap < 0.0);
        assert_near(stop.impact, impact, 1e-3);
        for dt in STEPS {
            assert!(from_equilibrium(literal_ovm(), 50.0, speed, dt).impact > 1.0);
        }
    }
}

#[test]
fn v17_gfm_in_the_form_of_jiang_brakes_as_fvdm_does() {
    for speed in [10.0, 13.0, 14.0] {
        let [gfm, fvdm] = [literal_gfm(), literal_fvdm()].map(|it| from_equilibrium(it, 50.0, speed, 0.01));
        assert_eq!(gfm.final_gap, fvdm.final_gap);
        assert_eq!(gfm.hardest_braking, fvdm.hardest_braking);
    }
}

#[test]
fn v17_gfm_gipps_and_newell_survive_from_their_equilibria() {
    // The gap left at the end, if the model itself keeps one.
    for (model, left) in [
        (FollowingModel::Gfm(Gfm::default()), Some(Gfm::default().jam_gap)),
        (FollowingModel::Gipps(Gipps::default()), None),
        (FollowingModel::Newell(Newell::default()), None),
    ] {
        for speed in [5.0, 10.0, 20.0, 30.0] {
            for dt in STEPS {
                let stop = from_equilibrium(model, 120.0 / 3.6, speed, dt);
                assert!(stop.shortest_gap > 0.0, "{model:?} at {speed} m/s: {}", stop.shortest_gap);
                assert!(stop.hardest_braking < 1.05 * HARDEST_BRAKING);
                left.iter().for_each(|left| assert_near(stop.final_gap, *left, 1e-3));
            }
        }
    }
}

#[test]
fn v17_krauss_as_an_acceleration_is_late_and_touches_its_leader() {
    // In steps of τ and behind a leader who brakes as it assumes, the driver stops where it wants to: with s₀ left.
    // Speeds are those at the end of a step, as in the paper.
    let krauss = Krauss::default();
    let model = FollowingModel::Krauss(krauss);
    for speed in [9.0, 18.0, 27.0] {
        let gap = model.equilibrium_gap(Pace::new(speed, 120.0 / 3.6));
        let (mut leader, mut follower) = (Car::at_gap(gap, speed), Car::at(0.0, speed));
        for _ in 0..60 {
            let after = follower.speed + krauss.time_gap * follower.wish(&model, 120.0 / 3.6, Some(leader));
            leader.speed = (leader.speed - krauss.deceleration * krauss.time_gap).max(0.0);
            leader.position += leader.speed * krauss.time_gap;
            follower = Car::at(follower.position + after * krauss.time_gap, after);
            assert!(follower.behind(leader).gap >= krauss.jam_gap - 1e-9);
        }
        assert_near(follower.behind(leader).gap, krauss.jam_gap, 1e-3);
    }
    // In short steps the speeds lag τ behind, and use up the jam gap; behind hard braking it is not enough.
    for (speed, impact) in [(5.0, 0.0), (10.0, 1.237), (20.0, 2.987), (30.0, 3.842)] {
        assert_near(from_equilibrium(model, 120.0 / 3.6, speed, 0.01).impact, impact, 0.01);
    }
}
