//! How drivers brake for a place ahead: gently, so that they stop there or pass it slowly.

use crate::state::standstill::ROOM_AT_A_STOP;

/// Drivers brake for the end of a lane, or the last place for a change, when they need this to stop there [m/s²].
pub(super) const COMFORTABLE_BRAKING: f64 = 2.0;

/// Acceleration that keeps to the speed from which comfortable braking stops `room` metres ahead.
pub(super) fn to_stop_at(speed: f64, room: f64, dt: f64) -> f64 {
    let next = stopping_speed(room - speed * dt);
    ((next - speed) / dt).max(-2.0 * COMFORTABLE_BRAKING)
}

/// Speed from which comfortable braking stops within `room` [m/s].
fn stopping_speed(room: f64) -> f64 {
    (2.0 * COMFORTABLE_BRAKING * room.max(0.0)).sqrt()
}

/// Distance in which a driver at `speed` [m/s] stops comfortably, with a margin [m].
#[inline]
pub(crate) fn stopping_way(speed: f64) -> f64 {
    /// Margin in time [s] and in distance [m].
    const MOMENT: f64 = 1.0;
    const ROOM: f64 = 5.0;
    speed * speed / (2.0 * COMFORTABLE_BRAKING) + MOMENT * speed + ROOM
}

/// Entry speed of a driver who may have to stop `distance` ahead [m/s].
pub(crate) fn speed_before_a_stop(distance: f64) -> f64 {
    stopping_speed(distance - ROOM_AT_A_STOP)
}

/// Braking to pass a place `room` metres ahead at `passing` [m/s]. It begins when gentle braking is no longer enough.
pub(super) fn approach(speed: f64, room: f64, passing: f64) -> f64 {
    if speed <= passing {
        return f64::INFINITY;
    }
    let needed = (speed * speed - passing * passing) / (2.0 * room.max(0.1));
    if needed > COMFORTABLE_BRAKING { -needed.min(2.0 * COMFORTABLE_BRAKING) } else { f64::INFINITY }
}
