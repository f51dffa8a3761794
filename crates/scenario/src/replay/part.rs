//! A recorded vehicle from the frame in which it comes to the one in which it is lost or leaves.

use std::collections::BTreeSet;

use laneweave_recorded::class_of;
use laneweave_recordings::{Recording, State, Track, resampled};
use laneweave_sim::{Class, Control, RecordedPose, RecordedVehicle};

/// A recorded speed that differs by more from that of the positions is replaced by it [m/s].
const TOLERATED: f64 = 5.0;

/// A recorded vehicle while it is seen without an interruption.
pub(super) struct Part {
    /// Its id in the recording.
    pub(super) recorded: i64,
    class: Class,
    /// Length and width [m].
    size: [f64; 2],
    /// The step in which it comes.
    pub(super) first_step: u32,
    /// Its poses in that step and in all that follow.
    poses: Vec<RecordedPose>,
    /// Whether it is to become a driver.
    pub(super) is_reactive: bool,
    /// Whether it is a driver already, so that this part is not needed.
    pub(super) is_driven: bool,
}

impl Part {
    /// The vehicle as it comes.
    pub(super) fn vehicle(&self) -> RecordedVehicle {
        let [length, width] = self.size;
        RecordedVehicle { class: self.class, length, width, pose: self.poses[0] }
    }

    /// Where it is in a step, if it is seen then.
    pub(super) fn pose(&self, step: u32) -> Option<RecordedPose> {
        self.poses.get(step.checked_sub(self.first_step)? as usize).copied()
    }

    /// The last step in which it is seen.
    pub(super) fn last_step(&self) -> u32 {
        self.first_step + self.poses.len() as u32 - 1
    }

    /// The subject of its random numbers.
    pub(super) fn subject(&self) -> u32 {
        subject(self.recorded)
    }
}

/// The subject of the random numbers of a vehicle with this id in the recording.
pub(super) fn subject(recorded: i64) -> u32 {
    (recorded ^ (recorded >> 32)) as u32
}

/// The vehicles of a recording in steps of `dt` [s], in the order in which they come. A vehicle that became a driver
/// goes on when it is lost: its later parts are not needed.
pub(super) fn parts(recording: &Recording, reactive: &BTreeSet<i64>, from_step: u32, dt: f64) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for track in &recording.tracks {
        let states = readable(&track.states);
        let states = resampled(&states, recording.step, dt);
        let unbroken = states.chunk_by(|a, b| b.frame == a.frame + 1);
        parts.extend(unbroken.map(|it| part(track, it, reactive.contains(&track.id), dt)));
    }
    parts.sort_by_key(|it| it.first_step);
    let mut drivers = BTreeSet::new();
    for part in &mut parts {
        part.is_driven = drivers.contains(&part.recorded);
        if part.is_reactive && part.last_step() >= from_step {
            drivers.insert(part.recorded);
        }
    }
    parts
}

/// The states that a vehicle can have, each frame once.
fn readable(states: &[State]) -> Vec<State> {
    let is_readable = |it: &&State| {
        let place = [it.x, it.y, it.heading].iter().all(|it| it.abs() <= Control::FARTHEST);
        place && it.speed.is_finite()
    };
    let mut states: Vec<State> = states.iter().filter(is_readable).copied().collect();
    states.sort_by_key(|it| it.frame);
    states.dedup_by_key(|it| it.frame);
    states
}

fn part(track: &Track, states: &[State], is_reactive: bool, dt: f64) -> Part {
    let mut poses: Vec<RecordedPose> = states
        .iter()
        .map(|it| RecordedPose {
            x: it.x,
            y: it.y,
            heading: it.heading,
            speed: it.speed.clamp(0.0, Control::FASTEST),
        })
        .collect();
    for at in 1..poses.len() {
        let (before, here) = (poses[at - 1], &mut poses[at]);
        let driven = (here.x - before.x).hypot(here.y - before.y) / dt;
        if (here.speed - driven).abs() > TOLERATED {
            here.speed = driven.min(Control::FASTEST);
        }
    }
    let (length, width) = track.class.usual_size();
    let sound = |value: f64, usual: f64, most: f64| if (0.1..=most).contains(&value) { value } else { usual };
    Part {
        recorded: track.id,
        class: class_of(track.class),
        size: [sound(track.length, length, 30.0), sound(track.width, width, 4.0)],
        first_step: states[0].frame as u32,
        poses,
        is_reactive,
        is_driven: false,
    }
}
