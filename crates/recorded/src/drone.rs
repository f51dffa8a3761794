//! The virtual drone: one operator that turns traffic that is known exactly into a recording as a drone would make it.
//! What is compared with a recording, or tests how well something is recovered from one, goes through it.
//!
//! A [`Watch`](crate::Watch) notes simulated vehicles at every step. A [`Drone`] sees of them what lies in its field of
//! view, at its own frame rate, with errors of position, and it loses vehicles at times. Speeds and headings are those
//! of a tracker: a straight line is fitted by least squares to the noisy positions half a second before and after.

use laneweave_recordings::smooth::motion;
use laneweave_recordings::{Recording, State, Track, resampled};
use laneweave_sim::{Purpose, Random};

/// Positions this long before and after a moment give its speed and heading [s].
const REACH: f64 = 0.5;
/// Below this speed a motion has no direction [m/s].
const STANDSTILL: f64 = 0.5;

/// A drone above the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drone {
    /// The middle of its field of view: east and north [m].
    pub above: [f64; 2],
    /// Side of its square field of view [m]; infinite: it sees everything.
    pub view: f64,
    /// Frames per second.
    pub frames_per_second: f64,
    /// Standard deviation of positions along each axis [m]; normal, independent from frame to frame.
    pub noise: f64,
    /// How often it loses a vehicle, if it does.
    pub interruptions: Option<Interruptions>,
    /// Seed of its errors.
    pub seed: u64,
}

/// How a drone loses vehicles. When it sees one again, it gives it a new id.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interruptions {
    /// Mean time until a vehicle is lost [s]; exponential.
    pub every: f64,
    /// Time for which it is lost [s].
    pub lasting: f64,
}

impl Drone {
    /// A drone that sees everything exactly, at this frame rate.
    pub fn exact(frames_per_second: f64) -> Drone {
        Drone {
            above: [0.0; 2],
            view: f64::INFINITY,
            frames_per_second,
            noise: 0.0,
            interruptions: None,
            seed: 1,
        }
    }

    /// What it records of `traffic`.
    pub fn observe(&self, traffic: &Recording) -> Recording {
        let (step, random) = (1.0 / self.frames_per_second, Random::new(self.seed));
        let mut tracks = Vec::with_capacity(traffic.tracks.len());
        let mut lost = Vec::new();
        for track in &traffic.tracks {
            let mut states = resampled(&track.states, traffic.step, step);
            states.retain(|it| self.sees(it));
            states.iter_mut().for_each(|it| self.err(it, track.id, &random));
            let parts = self.parts(states, track.id, step, &random);
            for (part, number) in parts.into_iter().zip(0..) {
                let track = Track { states: part, ..*track };
                if number == 0 { tracks.push(track) } else { lost.push(track) }
            }
        }
        let free = traffic.free_ids();
        tracks.extend(lost.into_iter().zip(free).map(|(it, id)| Track { id, ..it }));
        tracks.retain(|it| !it.states.is_empty());
        tracks.iter_mut().for_each(|it| follow(&mut it.states, step));
        Recording { step, tracks, ..Recording::default() }
    }

    fn sees(&self, state: &State) -> bool {
        let [east, north] = self.above;
        (state.x - east).abs().max((state.y - north).abs()) <= 0.5 * self.view
    }

    /// Moves a state of the vehicle `id` by the error of its position (Box and Muller).
    fn err(&self, state: &mut State, id: i64, random: &Random) {
        let draw = |part: u32| {
            random.uniform(id as u32, Purpose::Observation, (state.frame as u32).wrapping_mul(2) + part)
        };
        let radius = self.noise * libm::sqrt(-2.0 * libm::log(draw(0)));
        let angle = std::f64::consts::TAU * draw(1);
        (state.x, state.y) = (state.x + radius * libm::cos(angle), state.y + radius * libm::sin(angle));
    }

    /// The parts of a track between interruptions.
    fn parts(&self, states: Vec<State>, id: i64, step: f64, random: &Random) -> Vec<Vec<State>> {
        let (Some(Interruptions { every, lasting }), Some(first)) = (self.interruptions, states.first())
        else {
            return vec![states];
        };
        let wait = |number: u32| -every * libm::log(random.uniform(id as u32, Purpose::Interruption, number));
        let (mut parts, mut part, mut number) = (Vec::new(), Vec::new(), 0);
        let mut ends = first.frame as f64 * step + wait(number);
        for state in states {
            let time = state.frame as f64 * step;
            while time >= ends + lasting {
                number += 1;
                ends += lasting + wait(number);
                parts.push(std::mem::take(&mut part));
            }
            if time < ends {
                part.push(state);
            }
        }
        parts.push(part);
        parts.retain(|it| !it.is_empty());
        parts
    }
}

/// Gives states the speeds and headings of a tracker.
fn follow(states: &mut [State], step: f64) {
    let motions: Vec<_> = (0..states.len()).map(|at| motion(states, at, REACH, step)).collect();
    let moving = motions.iter().find(|it| it.speed() > STANDSTILL);
    let mut heading = moving.map_or_else(|| states.first().map_or(0.0, |it| it.heading), |it| it.heading());
    for (state, motion) in states.iter_mut().zip(&motions) {
        if motion.speed() > STANDSTILL {
            heading = motion.heading();
        }
        (state.speed, state.heading) = (motion.speed(), heading);
    }
}
