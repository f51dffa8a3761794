//! States at other times than those that are known.

use std::f64::consts::PI;

use crate::recording::State;

/// The states at the frames of `to` [s] between those of `from` [s], by the cubic through positions and velocities
/// (Hermite). Nothing is known within an interruption.
pub fn resampled(states: &[State], from: f64, to: f64) -> Vec<State> {
    states.chunk_by(|a, b| b.frame == a.frame + 1).flat_map(|it| unbroken(it, from, to)).collect()
}

/// The same of states without an interruption.
fn unbroken(states: &[State], from: f64, to: f64) -> Vec<State> {
    /// Frames at the same time have numbers that agree but for rounding.
    const ROUNDING: f64 = 1e-6;
    let (first, last) = (&states[0], &states[states.len() - 1]);
    let time = |it: &State| it.frame as f64 * from;
    let frames = (time(first) / to - ROUNDING).ceil() as i64..=(time(last) / to + ROUNDING).floor() as i64;
    let state = |frame: i64| {
        let moment = frame as f64 * to / from;
        let at =
            ((moment + ROUNDING).floor() as i64 - first.frame).clamp(0, states.len() as i64 - 1) as usize;
        let (before, after) = (&states[at], states.get(at + 1));
        let share = (moment - before.frame as f64).max(0.0);
        match after.filter(|_| share > ROUNDING) {
            Some(after) => between(before, after, share, from, frame),
            None => State { frame, ..*before },
        }
    };
    frames.map(state).collect()
}

/// The state at a `share` of the time `step` [s] between two frames.
fn between(before: &State, after: &State, share: f64, step: f64, frame: i64) -> State {
    let (s2, s3) = (share * share, share * share * share);
    let cubic = |of: fn(&State) -> f64, slope: fn(&State) -> f64| {
        (2.0 * s3 - 3.0 * s2 + 1.0) * of(before)
            + (s3 - 2.0 * s2 + share) * step * slope(before)
            + (3.0 * s2 - 2.0 * s3) * of(after)
            + (s3 - s2) * step * slope(after)
    };
    let turn = (after.heading - before.heading + PI).rem_euclid(2.0 * PI) - PI;
    State {
        frame,
        x: cubic(|it| it.x, |it| it.speed * it.heading.cos()),
        y: cubic(|it| it.y, |it| it.speed * it.heading.sin()),
        speed: before.speed + share * (after.speed - before.speed),
        heading: before.heading + share * turn,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(step: f64, frames: std::ops::Range<i64>) -> Vec<State> {
        let state = |frame: i64| {
            let angle = 0.2 * frame as f64 * step;
            let (x, y) = (100.0 * angle.cos(), 100.0 * angle.sin());
            State { frame, x, y, speed: 20.0, heading: angle + 0.5 * PI }
        };
        frames.map(state).collect()
    }

    #[test]
    fn positions_between_frames_are_those_of_the_path_to_a_millimetre() {
        let (coarse, fine) = (circle(0.1, 0..101), circle(0.04, 0..251));
        let found = resampled(&coarse, 0.1, 0.04);
        assert_eq!(found.len(), fine.len());
        for (a, b) in found.iter().zip(&fine) {
            assert_eq!(a.frame, b.frame);
            assert!(
                (a.x - b.x).hypot(a.y - b.y) < 1e-3 && (a.heading - b.heading).abs() < 1e-9,
                "{a:?} {b:?}"
            );
        }
    }

    #[test]
    fn the_same_frames_stay_as_they_are_and_gaps_stay_open() {
        let mut states = circle(0.1, 5..30);
        states.remove(10);
        let found = resampled(&states, 0.1, 0.1);
        let frames: Vec<i64> = found.iter().map(|it| it.frame).collect();
        let expected: Vec<i64> = (5..30).filter(|it| *it != 15).collect();
        assert_eq!(frames, expected);
        assert!(found.iter().zip(&states).all(|(a, b)| (a.x - b.x).abs() < 1e-9));
        assert!(resampled(&[], 0.1, 0.04).is_empty());
        assert_eq!(resampled(&states[..1], 0.1, 0.5).len(), 1);
    }
}
