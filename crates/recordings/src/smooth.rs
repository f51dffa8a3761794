//! Local straight-line fits: the motion around a moment, without the noise of single frames.

use crate::recording::State;

/// Maximum of states to each side in a fit, so that its time does not grow with the frame rate.
const MAXIMUM_STATES: usize = 50;

/// A smooth motion at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Position, east [m].
    pub x: f64,
    /// Position, north [m].
    pub y: f64,
    /// Velocity to the east [m/s]; zero if there is only one state.
    pub vx: f64,
    /// Velocity to the north [m/s]; zero if there is only one state.
    pub vy: f64,
}

impl Motion {
    /// Speed [m/s].
    pub fn speed(&self) -> f64 {
        (self.vx * self.vx + self.vy * self.vy).sqrt()
    }

    /// Direction, counter-clockwise from east [rad].
    pub fn heading(&self) -> f64 {
        self.vy.atan2(self.vx)
    }
}

/// Time from `a` to `b` [s].
pub(crate) fn elapsed(a: &State, b: &State, step: f64) -> f64 {
    b.frame.saturating_sub(a.frame) as f64 * step
}

/// The motion at `states[at]`, by the positions up to `reach` [s] before and after.
pub fn motion(states: &[State], at: usize, reach: f64, step: f64) -> Motion {
    let around = window(states, at, reach, step);
    let (x, vx) = line(around, &states[at], step, |it| it.x);
    let (y, vy) = line(around, &states[at], step, |it| it.y);
    Motion { x, y, vx, vy }
}

/// Speed at `states[at]` [m/s], by the speeds up to `reach` [s] before and after.
pub fn speed(states: &[State], at: usize, reach: f64, step: f64) -> f64 {
    line(window(states, at, reach, step), &states[at], step, |it| it.speed).0
}

/// Acceleration at `states[at]` [m/s²], by the speeds up to `reach` [s] before and after.
pub fn acceleration(states: &[State], at: usize, reach: f64, step: f64) -> f64 {
    line(window(states, at, reach, step), &states[at], step, |it| it.speed).1
}

fn window(states: &[State], at: usize, reach: f64, step: f64) -> &[State] {
    let is_near = |it: &&State| elapsed(&states[at], it, step).abs() <= reach * (1.0 + 1e-9);
    let before = states[..at].iter().rev().take(MAXIMUM_STATES).take_while(is_near).count();
    let after = states[at + 1..].iter().take(MAXIMUM_STATES).take_while(is_near).count();
    &states[at - before..at + 1 + after]
}

/// Value and slope at `here` of the least-squares line through `value` of `states`.
fn line(states: &[State], here: &State, step: f64, value: impl Fn(&State) -> f64) -> (f64, f64) {
    let count = states.len() as f64;
    let time = |it: &State| elapsed(here, it, step);
    let mean_time = states.iter().map(time).sum::<f64>() / count;
    let mean = states.iter().map(&value).sum::<f64>() / count;
    let (mut products, mut squares) = (0.0, 0.0);
    for state in states {
        let t = time(state) - mean_time;
        products += t * (value(state) - mean);
        squares += t * t;
    }
    let slope = if squares > 0.0 { products / squares } else { 0.0 };
    (mean - slope * mean_time, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(frame: i64, x: f64, speed: f64) -> State {
        State { frame, x, y: 0.0, speed, heading: 0.0 }
    }

    #[test]
    fn a_straight_motion_is_found_also_at_the_ends_of_a_track() {
        let states: Vec<State> = (0..9).map(|i| state(i, 3.0 * i as f64, 5.0 - 0.5 * i as f64)).collect();
        for at in 0..9 {
            let motion = motion(&states, at, 0.4, 0.2);
            assert!((motion.x - states[at].x).abs() < 1e-9 && (motion.vx - 15.0).abs() < 1e-9);
            assert!((acceleration(&states, at, 0.4, 0.2) + 2.5).abs() < 1e-9);
        }
    }

    #[test]
    fn noise_is_averaged() {
        let states: Vec<State> = (0..5).map(|i| state(i, if i % 2 == 0 { 0.3 } else { -0.3 }, 0.0)).collect();
        assert!((motion(&states, 2, 1.0, 0.5).x - 0.06).abs() < 1e-12);
    }

    #[test]
    fn a_single_state_stands() {
        let motion = motion(&[state(i64::MIN, 7.0, 3.0)], 0, 1.0, 0.1);
        assert_eq!(motion, Motion { x: 7.0, y: 0.0, vx: 0.0, vy: 0.0 });
    }
}
