//! A recorded vehicle in whose way somebody is: it goes on along its recorded path. It is handed over as soon as it is
//! behind its record.
//!
//! It never gets ahead of its record, so it only needs what was recorded already. It follows whoever is ahead, closely,
//! and catches up when it can. All numbers are ours.

use laneweave_models::braking::{HARDEST_BRAKING, secure_speed};
use laneweave_models::follow::Ahead;
use laneweave_sim::VehicleId;
use serde::{Deserialize, Serialize};

use super::conflict::{NEAREST, needed};

/// The largest acceleration to catch up, and the largest braking to do so [m/s²].
const CATCHING_UP: [f64; 2] = [2.0, 3.0];
/// It makes up for a delay so that it can come to the recorded speed again with this braking [m/s²], at most so much
/// faster than recorded [m/s].
const DELAY: (f64, f64) = (1.0, 5.0);
/// It comes to the speed that it aims at in this time [s].
const TO_SPEED: f64 = 0.3;
/// It is back at its record when it is no further behind than this [m], and no faster or slower than this [m/s].
const BACK: (f64, f64) = (0.3, 0.5);
/// Braking that is not needed for a vehicle that is where the recording has it [m/s²].
const UNFELT: f64 = 0.5;
/// It brakes so much harder than needed.
const SPARE: f64 = 1.2;

/// Where a vehicle is on its recorded path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Course {
    /// Way along the path from its first pose on [m].
    pub(super) way: f64,
    /// Speed [m/s].
    pub(super) speed: f64,
    /// Acceleration [m/s²].
    pub(super) acceleration: f64,
    /// Who is in its way, as long as it has not left its record because of him: then it is handed over.
    pub(super) heeds: Option<VehicleId>,
}

/// What a recorded vehicle does at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Recorded {
    /// Way along the path from its first pose on [m].
    pub(super) way: f64,
    /// Speed [m/s].
    pub(super) speed: f64,
}

/// What a handed-over vehicle heeds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Heeded {
    /// The leader in its lane.
    pub(super) leader: Option<Ahead>,
    /// The acceleration that its driver wants behind a leader who is not where the recording has him [m/s²].
    pub(super) wish: Option<f64>,
    /// The braking that keeps it from touching anybody else [m/s²].
    pub(super) to_avoid: Option<f64>,
}

impl Course {
    /// Where it is after a step of `dt` [s], whose record is `recorded` then.
    pub(super) fn after(self, heeded: &Heeded, recorded: Recorded, dt: f64) -> Course {
        let delay = (recorded.way - self.way).max(0.0);
        let (braking, fastest) = DELAY;
        let aim = recorded.speed + (2.0 * braking * delay).sqrt().min(fastest);
        let [faster, slower] = CATCHING_UP;
        let catching_up = ((aim - self.speed) / TO_SPEED).clamp(-slower, faster);
        let behind = heeded.wish.or_else(|| heeded.leader.map(|it| self.not_to_touch(it)));
        let avoiding = heeded.to_avoid.map_or(f64::INFINITY, |it| -it);
        let wish = catching_up.min(behind.unwrap_or(f64::INFINITY)).min(avoiding).max(-HARDEST_BRAKING);
        let secure =
            heeded.leader.map_or(f64::INFINITY, |it| secure_speed(self.speed, it.nearer(NEAREST), dt));
        let speed = (self.speed + wish * dt).min(secure).max(0.0);
        let acceleration = (speed - self.speed) / dt;
        let way = self.way + 0.5 * (self.speed + speed) * dt;
        if way < recorded.way {
            return Course { way, speed, acceleration, ..self };
        }
        // With its record it is as fast as recorded, or slower.
        let (way, speed) = (recorded.way.max(self.way), speed.min(recorded.speed));
        Course { way, speed, acceleration, ..self }
    }

    /// The acceleration behind a leader who is where the recording has him: no gap is kept that was not kept then.
    fn not_to_touch(self, leader: Ahead) -> f64 {
        let needed = needed(self.speed, Ahead::steady(leader.gap, leader.speed));
        if needed > -UNFELT { f64::INFINITY } else { SPARE * needed }
    }

    /// Whether it is not where its record is.
    pub(super) fn is_behind(self, recorded: Recorded) -> bool {
        recorded.way - self.way > BACK.0
    }

    /// Who is in its way, if it falls back behind its record now because of him.
    pub(super) fn leaves_its_record(&mut self, recorded: Recorded) -> Option<VehicleId> {
        if self.is_behind(recorded) { self.heeds.take() } else { None }
    }

    /// Whether it is where and as fast as its record.
    pub(super) fn is_back(self, recorded: Recorded) -> bool {
        !self.is_behind(recorded) && (recorded.speed - self.speed).abs() <= BACK.1
    }

    /// Whether it has come to the end of its path, which is so long [m].
    pub(super) fn is_over(self, path: f64) -> bool {
        path - self.way <= BACK.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 0.1;

    /// A vehicle at rest 20 m behind its record, which drives on at 10 m/s, with nobody ahead.
    #[test]
    fn it_catches_up_with_its_record_and_is_never_ahead_of_it() {
        let mut course = Course { way: 0.0, speed: 0.0, acceleration: 0.0, heeds: None };
        let record = |step: u32| Recorded { way: 20.0 + f64::from(step), speed: 10.0 };
        let back = (1..600).find(|step| {
            course = course.after(&Heeded::default(), record(*step), STEP);
            assert!(course.way <= record(*step).way && course.speed <= 15.0 + 1e-9);
            course.is_back(record(*step))
        });
        assert!(back.is_some_and(|it| (100..200).contains(&it)), "{back:?}");
    }

    #[test]
    fn it_stops_behind_who_stands_and_brakes_no_harder_than_vehicles_can() {
        let mut course = Course { way: 0.0, speed: 15.0, acceleration: 0.0, heeds: None };
        for step in 1..200 {
            let leader = Some(Ahead::standing(40.0 - course.way));
            let record = Recorded { way: 1.5 * f64::from(step), speed: 15.0 };
            course = course.after(&Heeded { leader, ..Heeded::default() }, record, STEP);
            assert!(course.acceleration >= -HARDEST_BRAKING - 1e-9 && course.way < 40.0, "{course:?}");
        }
        assert!(course.speed < 0.1 && course.way > 39.0, "{course:?}");
    }

    #[test]
    fn behind_a_leader_on_its_record_it_comes_as_near_as_it_was() {
        // Both drive at 10 m/s, 4 m apart as recorded.
        let mut course = Course { way: 0.0, speed: 10.0, acceleration: 0.0, heeds: None };
        for step in 1..400 {
            let record = Recorded { way: 8.0 + f64::from(step), speed: 10.0 };
            let leader = Some(Ahead::steady(record.way + 3.0 - course.way, 10.0));
            course = course.after(&Heeded { leader, ..Heeded::default() }, record, STEP);
        }
        assert!(course.is_back(Recorded { way: 8.0 + 39.9 * 10.0, speed: 10.0 }), "{course:?}");
    }
}
