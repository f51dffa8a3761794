//! Speeds and headings that contradict the positions.

use std::f64::consts::{FRAC_PI_4, PI};

use laneweave_network::turn;

use super::report::Noted;
use crate::recording::State;
use crate::smooth::{self, Motion};

/// Positions are smoothed over this time before and after [s].
const REACH: f64 = 0.4;
/// A speed contradicts the positions if it differs by more [m/s].
const SPEED_ERROR: f64 = 5.0;
/// A heading contradicts the motion if it differs by more [rad].
const HEADING_ERROR: f64 = FRAC_PI_4;
/// Below this speed a motion has no direction [m/s].
pub(super) const MOVING: f64 = 2.0;
/// Vehicles drive backwards up to this speed [m/s].
const BACKING: f64 = 5.0;

/// Replaces speeds and headings that contradict the positions.
pub(super) fn mend(states: &mut [State], step: f64, noted: &mut Noted<'_>) {
    if states.len() < 3 {
        return;
    }
    for at in 0..states.len() {
        let motion = smooth::motion(states, at, REACH, step);
        let state = &mut states[at];
        if (state.speed - motion.speed()).abs() > SPEED_ERROR {
            noted.add(|report| &mut report.speeds, state.frame);
            state.speed = motion.speed();
        }
        if contradicts(state.heading, &motion) {
            noted.add(|report| &mut report.headings, state.frame);
            state.heading = motion.heading();
        }
    }
}

fn contradicts(heading: f64, motion: &Motion) -> bool {
    if motion.speed() < MOVING {
        return false;
    }
    let off = turn(motion.heading(), heading).abs();
    let backs_up = off > PI - HEADING_ERROR && motion.speed() < BACKING;
    off > HEADING_ERROR && !backs_up
}
