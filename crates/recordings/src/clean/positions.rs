//! Positions: states off the path, jumps of the path, and gaps in it.

use laneweave_network::turn;

use super::report::Noted;
use crate::recording::State;
use crate::smooth::elapsed;

/// Gaps up to this are interpolated [s].
const SHORT_GAP: f64 = 1.0;
/// A track grows by interpolation to this many times its states at most.
const MAXIMUM_GROWTH: usize = 4;
/// Maximum error of positions [m]. Ours: half a car.
const NOISE: f64 = 2.5;
/// Maximum acceleration of a road user [m/s²]: emergency braking on dry asphalt reaches 10.
const MAXIMUM_ACCELERATION: f64 = 12.0;
/// Maximum speed [m/s].
const MAXIMUM_SPEED: f64 = 100.0;

/// The parts of a track without jumps and gaps.
pub(super) fn parts(mut states: Vec<State>, step: f64, noted: &mut Noted<'_>) -> Vec<Vec<State>> {
    leave_out_outliers(&mut states, step, noted);
    let jumps = jumps(&states, step);
    let mut room = states.len().saturating_mul(MAXIMUM_GROWTH - 1);
    let mut parts = Vec::new();
    let mut part: Vec<State> = Vec::with_capacity(states.len());
    for (at, state) in states.iter().enumerate() {
        let Some(last) = part.last().copied() else {
            part.push(*state);
            continue;
        };
        let missing = (state.frame.abs_diff(last.frame) - 1) as usize;
        let is_gap = missing > 0 && (missing as f64 * step > SHORT_GAP + 1e-9 || missing > room);
        if jumps[at - 1] || is_gap {
            noted.add(|it| if is_gap { &mut it.long_gaps } else { &mut it.jumps }, state.frame);
            parts.push(std::mem::take(&mut part));
        } else {
            room -= missing;
            for frame in last.frame + 1..state.frame {
                noted.add(|report| &mut report.interpolated, frame);
                part.push(between(&last, state, frame));
            }
        }
        part.push(*state);
    }
    parts.extend((!part.is_empty()).then_some(part));
    parts
}

/// Removes states to which, and from which, the path jumps, and such states at an end of the track.
fn leave_out_outliers(states: &mut Vec<State>, step: f64, noted: &mut Noted<'_>) {
    let jumps = jumps(states, step);
    if states.len() < 3 {
        return;
    }
    let mut at = 0;
    states.retain(|state| {
        let comes_by_jump = at == 0 || jumps[at - 1];
        let is_outlier = comes_by_jump && jumps.get(at).copied().unwrap_or(true);
        at += 1;
        if is_outlier {
            noted.add(|report| &mut report.outliers, state.frame);
        }
        !is_outlier
    });
}

/// For each step between two states whether the path jumps there. It jumps if the step agrees neither with the one
/// before nor with the one after, within the limits of noise and acceleration.
fn jumps(states: &[State], step: f64) -> Vec<bool> {
    let steps: Vec<(f64, f64, f64)> = states
        .windows(2)
        .map(|pair| (pair[1].x - pair[0].x, pair[1].y - pair[0].y, elapsed(&pair[0], &pair[1], step)))
        .collect();
    let deviates = |here: usize, other: Option<&(f64, f64, f64)>| {
        let (dx, dy, dt) = steps[here];
        other.is_none_or(|(x, y, t)| {
            let (off_x, off_y) = (dx - x / t * dt, dy - y / t * dt);
            let between = 0.5 * (dt + t);
            (off_x * off_x + off_y * off_y).sqrt() > NOISE + MAXIMUM_ACCELERATION * dt * between
        })
    };
    (0..steps.len())
        .map(|here| {
            let (dx, dy, dt) = steps[here];
            let before = here.checked_sub(1).and_then(|it| steps.get(it));
            let after = steps.get(here + 1);
            let is_alone = before.is_none() && after.is_none();
            (dx * dx + dy * dy).sqrt() > NOISE + MAXIMUM_SPEED * dt
                || (!is_alone && deviates(here, before) && deviates(here, after))
        })
        .collect()
}

/// The state in `frame` on the straight line from `a` to `b`.
fn between(a: &State, b: &State, frame: i64) -> State {
    let fraction = (frame - a.frame) as f64 / (b.frame - a.frame) as f64;
    let mix = |from: f64, to: f64| from + fraction * (to - from);
    // Headings may be so large that their difference is NaN.
    let turn = Some(turn(a.heading, b.heading)).filter(|it| it.is_finite()).unwrap_or(0.0);
    State {
        frame,
        x: mix(a.x, b.x),
        y: mix(a.y, b.y),
        speed: mix(a.speed, b.speed),
        heading: a.heading + fraction * turn,
    }
}
