//! Emergency braking: the kinematic bound above every car-following model.
//!
//! A follower at gap s is *secure* when s ≥ v²/2b − v_l²/2b + v·dt: even if the leader brakes as hard as vehicles
//! can, the follower, one step later, still stops behind it. b is the same for all classes: with unequal braking the
//! argument would not hold. Behind a faster leader, too, s ≥ v·dt is required.

use crate::follow::Ahead;

/// b: the hardest braking of any vehicle [m/s²].
pub const HARDEST_BRAKING: f64 = 8.0;

/// Braking beyond this is hard [m/s²]: drivers avoid it (ours; usual braking is below 3 m/s²).
pub const HARD_BRAKING: f64 = 4.0;

/// Nearer than this to what is ahead, nobody comes nearer [m] (ours). Otherwise who creeps up to what stands halves the
/// gap again and again, until numbers end and it is 0.
const NEAREST: f64 = 0.01;

/// Whether a follower at `speed` [m/s] is secure behind `ahead`, with time step `dt` [s].
#[inline]
pub fn is_secure(speed: f64, ahead: Ahead, dt: f64) -> bool {
    let lead = (speed * speed - ahead.speed * ahead.speed) / (2.0 * HARDEST_BRAKING);
    ahead.gap >= lead.max(0.0) + speed * dt
}

/// The part of the gap that is left for the next step: `s + v_l²/2b − v·dt/2` [m].
#[inline]
fn room(speed: f64, ahead: Ahead, dt: f64) -> f64 {
    ahead.gap + ahead.speed * ahead.speed / (2.0 * HARDEST_BRAKING) - 0.5 * speed * dt
}

/// Whether a driver at `speed` may be at `next_speed` one step later and still be secure, whatever the leader
/// does: `v'²/2b + 3/2 v'·dt ≤ s + v_l²/2b − v·dt/2`, speeds changing linearly within the step; and `v' ≤ v_l` within a
/// centimetre.
#[inline]
pub fn stays_secure(speed: f64, next_speed: f64, ahead: Ahead, dt: f64) -> bool {
    let needed = next_speed * next_speed / (2.0 * HARDEST_BRAKING) + 1.5 * next_speed * dt;
    needed <= room(speed, ahead, dt) && (ahead.gap >= NEAREST || next_speed <= ahead.speed)
}

/// The highest speed [m/s] of the next step that satisfies [`stays_secure`]; never below the speed after braking at
/// [`HARDEST_BRAKING`].
pub fn secure_speed(speed: f64, ahead: Ahead, dt: f64) -> f64 {
    let reaction = 1.5 * dt;
    let under_root = reaction * reaction + 2.0 * room(speed, ahead, dt).max(0.0) / HARDEST_BRAKING;
    let highest = HARDEST_BRAKING * (under_root.sqrt() - reaction);
    let highest = if ahead.gap < NEAREST { highest.min(ahead.speed) } else { highest };
    highest.max(speed - HARDEST_BRAKING * dt).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn who_is_secure_stays_secure_whatever_the_leader_does(
            speed in 0.0..60.0_f64, leader in 0.0..60.0_f64, spare in 0.0..50.0_f64,
            dt in 0.02..0.5_f64, harshness in 0.0..1.0_f64,
        ) {
            let lead = ((speed * speed - leader * leader) / (2.0 * HARDEST_BRAKING)).max(0.0);
            let ahead = Ahead::steady(lead + speed * dt + spare, leader);
            prop_assert!(is_secure(speed, ahead, dt));
            let next = secure_speed(speed, ahead, dt);
            let leader_next = (leader - harshness * HARDEST_BRAKING * dt).max(0.0);
            // Both move with linearly changing speeds. A leader that stops within the step stays where it stops.
            let leader_moved = if harshness == 0.0 {
                leader * dt
            } else {
                (leader * leader - leader_next * leader_next) / (2.0 * harshness * HARDEST_BRAKING)
                    .max(1e-12)
            };
            let gap = ahead.gap + leader_moved.min(leader * dt) - 0.5 * (speed + next) * dt;
            prop_assert!(gap > -1e-9, "gap {gap}");
            let needed = (next * next - leader_next * leader_next) / (2.0 * HARDEST_BRAKING) + next * dt;
            prop_assert!(gap >= needed - 1e-6, "gap {gap} needed {needed}");
        }
    }

    proptest! {
        #[test]
        fn the_secure_speed_is_the_highest_that_leaves_the_gap_needed_behind_a_leader_who_brakes_hardest(
            speed in 0.0..60.0_f64, leader in 4.0..60.0_f64, spare in 0.0..50.0_f64, dt in 0.02..0.5_f64,
        ) {
            let lead = ((speed * speed - leader * leader) / 16.0).max(0.0);
            let ahead = Ahead::steady(lead + speed * dt + spare, leader);
            let next = secure_speed(speed, ahead, dt);
            prop_assert!(stays_secure(speed, next - 1e-6, ahead, dt));
            prop_assert!(!stays_secure(speed, next + 1e-6, ahead, dt));
            let leader_next = leader - 8.0 * dt;
            let gap = ahead.gap + 0.5 * (leader + leader_next - speed - next) * dt;
            let needed = (next * next - leader_next * leader_next) / 16.0 + next * dt;
            prop_assert!((gap - needed).abs() < 1e-9, "gap {gap} needed {needed}");
        }
    }

    proptest! {
        #[test]
        fn who_creeps_up_to_what_stands_leaves_a_gap_for_ever(
            speed in 0.0..5.0_f64, spare in 0.0..3.0_f64, dt in 0.02..0.5_f64,
        ) {
            let (mut speed, mut gap) = (speed, speed * speed / (2.0 * HARDEST_BRAKING) + speed * dt + spare + 1e-9);
            for _ in 0..2000 {
                let next = secure_speed(speed, Ahead::standing(gap), dt);
                gap -= 0.5 * (speed + next) * dt;
                speed = next;
            }
            // Positions are this exact, a few hundred metres along a lane.
            prop_assert!(speed == 0.0 && gap > 1e-10, "gap {gap}");
        }
    }

    #[test]
    fn nobody_is_asked_to_brake_harder_than_a_vehicle_can_nor_to_drive_backwards() {
        let close = Ahead::standing(1.0);
        assert!((secure_speed(20.0, close, 0.1) - 19.2).abs() < 1e-12);
        assert_eq!(secure_speed(0.5, Ahead::standing(0.0), 0.1), 0.0);
        assert_eq!(secure_speed(0.0, Ahead::standing(-1.0), 0.1), 0.0);
    }

    #[test]
    fn an_empty_road_does_not_bind() {
        assert!(stays_secure(30.0, 30.0, Ahead::steady(200.0, 30.0), 0.1));
        assert!(!stays_secure(30.0, 30.0, Ahead::standing(58.0), 0.1));
    }
}
