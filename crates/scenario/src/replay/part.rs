//! A recorded vehicle from the frame in which it comes to the one in which it is lost or leaves: a part of a recording.
//! A vehicle that was lost and seen again has several.

use std::collections::BTreeSet;

use laneweave_network::turn;
use laneweave_recorded::class_of;
use laneweave_recordings::{Recording, State, Track, resampled};
use laneweave_sim::{Class, Control, RecordedPose, RecordedVehicle};

use super::course::Recorded;

/// A recorded speed that differs by more [m/s] from that of the positions over this time [s] is replaced by it. A
/// position alone may be wrong, such as the first in a view.
const TOLERATED: f64 = 5.0;
const DRIVEN: f64 = 0.5;
/// How a vehicle moves is taken over so much of its recorded past [s]. Before the least is known it is as if it went
/// straight on at its speed.
const PAST: f64 = 1.0;
const LEAST_PAST: f64 = 0.5;
/// The direction of a shorter way is not known [m].
const SHORT: f64 = 1.0;

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
    /// Its way to each of them [m].
    ways: Vec<f64>,
    /// Whether it is a motor vehicle.
    pub(super) is_vehicle: bool,
    /// Whether it is to become a driver.
    pub(super) is_reactive: bool,
}

/// How a vehicle has moved in the last second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Motion {
    /// Acceleration [m/s²].
    pub(super) acceleration: f64,
    /// Where it went, if it moved.
    pub(super) chord: Option<Chord>,
}

/// The straight line along which a vehicle has moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    /// Its way [m].
    pub(super) way: f64,
    /// The direction, counter-clockwise from east [rad]. Recorded headings may stay along the lane.
    pub(super) direction: f64,
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

    /// The number of its pose in a step; afterwards that of its last one.
    fn at(&self, step: u32) -> usize {
        (step.saturating_sub(self.first_step) as usize).min(self.poses.len() - 1)
    }

    /// Its way and its speed in a step; afterwards the last ones.
    pub(super) fn recorded(&self, step: u32) -> Recorded {
        let at = self.at(step);
        Recorded { way: self.ways[at], speed: self.poses[at].speed }
    }

    /// How it moved up to a step, in steps of `dt` [s].
    pub(super) fn motion(&self, step: u32, dt: f64) -> Motion {
        let (at, steps) = (self.at(step), |time: f64| (time / dt).round().max(1.0) as usize);
        if at < steps(LEAST_PAST) {
            return Motion::default();
        }
        let before = at.saturating_sub(steps(PAST));
        let [from, to] = [before, at].map(|it| self.poses[it]);
        let way = self.ways[at] - self.ways[before];
        let acceleration = (to.speed - from.speed) / ((at - before) as f64 * dt);
        let direction = (to.y - from.y).atan2(to.x - from.x);
        Motion { acceleration, chord: (way >= SHORT).then_some(Chord { way, direction }) }
    }

    /// Length of its path [m].
    pub(super) fn path(&self) -> f64 {
        self.ways[self.ways.len() - 1]
    }

    /// Where it is after `way` [m] of its path, at this `speed` [m/s].
    pub(super) fn along(&self, way: f64, speed: f64) -> RecordedPose {
        let after = self.ways.partition_point(|it| *it < way).min(self.ways.len() - 1);
        let before = after.saturating_sub(1);
        let [from, to] = [before, after].map(|it| self.poses[it]);
        let length = self.ways[after] - self.ways[before];
        let share = if length > 0.0 { ((way - self.ways[before]) / length).clamp(0.0, 1.0) } else { 1.0 };
        let between = |from: f64, to: f64| from + share * (to - from);
        RecordedPose {
            x: between(from.x, to.x),
            y: between(from.y, to.y),
            heading: from.heading + share * turn(from.heading, to.heading),
            speed,
        }
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

/// The vehicles of a recording in steps of `dt` [s], in the order in which they come.
pub(super) fn parts(recording: &Recording, reactive: &BTreeSet<i64>, dt: f64) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for track in &recording.tracks {
        let mut states = readable(&track.states);
        correct_speeds(&mut states, recording.step);
        let states = resampled(&states, recording.step, dt);
        let unbroken = states.chunk_by(|a, b| b.frame == a.frame + 1);
        parts.extend(unbroken.map(|it| part(track, it, reactive.contains(&track.id))));
    }
    parts.sort_by_key(|it| it.first_step);
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

fn part(track: &Track, states: &[State], is_reactive: bool) -> Part {
    let poses: Vec<RecordedPose> = states
        .iter()
        .map(|it| RecordedPose {
            x: it.x,
            y: it.y,
            heading: it.heading,
            speed: it.speed.clamp(0.0, Control::FASTEST),
        })
        .collect();
    let ways = poses.windows(2).scan(0.0, |way, pair| {
        *way += (pair[1].x - pair[0].x).hypot(pair[1].y - pair[0].y);
        Some(*way)
    });
    let ways = std::iter::once(0.0).chain(ways).collect();
    let (length, width) = track.class.usual_size();
    let sound = |value: f64, usual: f64, most: f64| if (0.1..=most).contains(&value) { value } else { usual };
    Part {
        recorded: track.id,
        class: class_of(track.class),
        size: [sound(track.length, length, 30.0), sound(track.width, width, 4.0)],
        first_step: states[0].frame as u32,
        poses,
        ways,
        is_vehicle: track.class.is_vehicle(),
        is_reactive,
    }
}

/// Replaces speeds that contradict the positions, with frames so far apart [s].
fn correct_speeds(states: &mut [State], step: f64) {
    let back = (DRIVEN / step).ceil().max(1.0) as usize;
    for at in back..states.len() {
        let [from, to] = [at - back, at].map(|it| states[it]);
        let driven = (to.x - from.x).hypot(to.y - from.y) / ((to.frame - from.frame) as f64 * step);
        if (to.speed - driven).abs() > TOLERATED {
            states[at].speed = driven;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn states(xs: &[f64], speed: f64) -> Vec<State> {
        let state = |(frame, x): (i64, &f64)| State { frame, x: *x, y: 0.0, heading: 0.0, speed };
        (0..).zip(xs).map(state).collect()
    }

    #[test]
    fn a_wrong_position_leaves_the_speed_and_wrong_speeds_are_those_of_the_positions() {
        // The first place is cut off at the edge of the view.
        let mut cut = states(&[1.5, 2.0, 4.0, 6.0], 10.0);
        correct_speeds(&mut cut, 0.2);
        assert!(cut.iter().all(|it| it.speed == 10.0));
        let mut unknown = states(&[0.0, 2.0, 4.0, 6.0], 0.0);
        correct_speeds(&mut unknown, 0.2);
        let speeds: Vec<f64> = unknown.iter().map(|it| it.speed.round()).collect();
        assert_eq!(speeds, [0.0, 0.0, 0.0, 10.0]);
    }

    #[test]
    fn a_part_knows_its_way_its_motion_and_its_places_between_steps() {
        let states: Vec<State> = (0..21)
            .map(|frame| {
                let time = 0.1 * frame as f64;
                State { frame, x: 10.0 * time + 0.5 * time * time, y: 0.0, heading: 0.1, speed: 10.0 + time }
            })
            .collect();
        let track =
            Track { id: 1, class: laneweave_recordings::RoadUser::Car, length: 4.0, width: 2.0, states };
        let recording = Recording { step: 0.1, tracks: vec![track], ..Recording::default() };
        let part = &parts(&recording, &BTreeSet::new(), 0.1)[0];
        assert!((part.path() - 22.0).abs() < 1e-9 && part.recorded(99) == part.recorded(20));
        let Motion { acceleration, chord } = part.motion(15, 0.1);
        let Chord { way, direction } = chord.expect("it moved");
        assert!((acceleration - 1.0).abs() < 1e-9 && (way - 11.0).abs() < 1e-9 && direction == 0.0);
        assert_eq!(part.motion(4, 0.1), Motion::default(), "too little is known");
        let RecordedPose { x, speed, .. } = part.along(part.recorded(10).way + 0.5, 3.0);
        assert!((x - 11.0).abs() < 1e-9 && speed == 3.0);
    }
}
