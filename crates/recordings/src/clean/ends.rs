//! Vehicles that are seen only in part where they come into view or go out of it.
//!
//! Their box is that of the part that is seen, so that its centre is too far in view.

use super::motion::MOVING;
use super::report::Noted;
use crate::recording::State;
use crate::smooth::elapsed;

/// A vehicle comes into view, or goes out of it, in this time [s] (ours).
const COMING: f64 = 0.2;
/// No vehicle speeds up or brakes harder than this [m/s²] (ours).
const HARDEST: f64 = 12.0;
/// Errors of positions are smaller than this [m] (ours).
const ERROR: f64 = 0.5;

/// Puts the first and last states of a track where the motion after and before them says, if their positions are too
/// far in view.
pub(super) fn complete(states: &mut [State], step: f64, noted: &mut Noted<'_>) {
    complete_first(states, step, noted);
    states.reverse();
    complete_first(states, step, noted);
    states.reverse();
}

/// The same for one end. States before a reversal and after it are treated in the same way.
fn complete_first(states: &mut [State], step: f64, noted: &mut Noted<'_>) {
    let Some((&first, _)) = states.split_first() else { return };
    let apart = |a: &State, b: &State| elapsed(a, b, step).max(elapsed(b, a, step));
    let after = |time: f64| states.iter().position(|it| apart(&first, it) >= time * (1.0 - 1e-9));
    let (Some(near), Some(far)) = (after(COMING.max(step)), after(2.0 * COMING.max(step))) else { return };
    let [near_state, far_state] = [near, far].map(|it| states[it]);
    let between = apart(&near_state, &far_state);
    let [vx, vy] = [far_state.x - near_state.x, far_state.y - near_state.y].map(|it| it / between);
    let speed = vx.hypot(vy);
    if speed < MOVING {
        return;
    }
    for state in &mut states[..near] {
        let time = apart(state, &near_state);
        let [x, y] = [near_state.x - vx * time, near_state.y - vy * time];
        let in_view = ((state.x - x) * vx + (state.y - y) * vy) / speed;
        if in_view > ERROR.max(HARDEST * time * time) {
            noted.add(|report| &mut report.partly_seen, state.frame);
            (state.x, state.y) = (x, y);
        }
    }
}
