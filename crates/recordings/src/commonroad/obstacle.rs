//! One obstacle of a CommonRoad file: its shape and states, which become a track.

use laneweave_maps::Problem;
use laneweave_maps::commonroad::{ObstacleShape, Place, Value};
use laneweave_maps::xml::number;

use crate::recording::{RoadUser, State, Track};

/// Maximum speed on a road [m/s].
const MAXIMUM_SPEED: f64 = 150.0;
/// Maximum number of frames.
const MAXIMUM_FRAME: f64 = 1e8;

/// The element `dynamicObstacle`, in version 2018b `obstacle`, while it is read.
#[derive(Default)]
pub(super) struct Obstacle {
    pub(super) id: i64,
    pub(super) line: usize,
    pub(super) is_static: bool,
    /// Its type, such as `car`.
    pub(super) kind: String,
    shape: ObstacleShape,
    /// The state that is being read.
    moment: Moment,
    states: Vec<State>,
    flaws: Flaws,
    has_occupancies: bool,
}

/// States that cannot be used.
#[derive(Default)]
struct Flaws {
    number: usize,
    /// Line of the first, and why.
    first: (usize, &'static str),
}

impl Obstacle {
    pub(super) fn new(id: i64, line: usize, is_static: bool) -> Obstacle {
        Obstacle { id, line, is_static, ..Obstacle::default() }
    }

    /// Begins a state or a shape.
    pub(super) fn open(&mut self, part: &str, line: usize) {
        match part {
            "initialState" | "trajectory/state" => self.moment = Moment { line, ..Moment::default() },
            "occupancySet" => self.has_occupancies = true,
            _ => self.shape.open(part),
        }
    }

    /// Reads the text of an element inside.
    pub(super) fn close(&mut self, part: &str, text: &str) {
        match part {
            "role" => self.is_static = text == "static",
            "type" => self.kind = text.into(),
            "initialState" | "trajectory/state" => match self.moment.state() {
                Ok(state) => self.states.push(state),
                Err(flaw) => self.flaws.add(self.moment.line, flaw),
            },
            _ => {
                self.shape.take(part, number(text));
                let inside = part.strip_prefix("initialState/");
                if let Some(leaf) = inside.or_else(|| part.strip_prefix("trajectory/state/")) {
                    self.moment.take(leaf, number(text));
                }
            }
        }
    }

    /// Its track, with frames `step` apart [s].
    pub(super) fn track(mut self, step: f64, problems: &mut Vec<Problem>) -> Option<Track> {
        if self.has_occupancies {
            let what = "its occupancy set is ignored";
            problems.push(self.problem(what, "give it a trajectory if it was observed"));
        }
        if !self.shape.is_usable() {
            let what =
                "its first shape is not a rectangle or circle of the size of a road user, so it is left out";
            problems.push(self.problem(what, "give it a rectangle with length and width in m"));
            return None;
        }
        if self.shape.count > 1 {
            let what = format!("only the first of its {} shapes is used", self.shape.count);
            problems.push(self.problem(what, "give it one rectangle"));
        }
        self.states.sort_by_key(|it| it.frame);
        let given = self.states.len();
        self.states.dedup_by_key(|it| it.frame);
        for _ in self.states.len()..given {
            self.flaws.add(self.line, "another one has the same time");
        }
        for it in &mut self.states {
            ([it.x, it.y], it.heading) = self.shape.centre([it.x, it.y], it.heading);
        }
        fill_speeds(&mut self.states, step);
        let given = self.states.len();
        self.states.retain(|it| it.speed.abs() <= MAXIMUM_SPEED);
        for _ in self.states.len()..given {
            self.flaws.add(self.line, "it and its neighbours do not give a velocity up to 150 m/s");
        }
        problems.extend(self.flaws.what().map(|it| self.problem(it, "correct or delete them")));
        if self.states.is_empty() {
            problems.push(self.problem("it has no state, so it is left out", "give it a trajectory"));
            return None;
        }
        let ObstacleShape { length, width, .. } = self.shape;
        Some(Track { id: self.id, class: self.class(), length, width, states: self.states })
    }

    /// Its class, by its type.
    pub(super) fn class(&self) -> RoadUser {
        match self.kind.as_str() {
            "car" | "taxi" | "priorityVehicle" => RoadUser::Car,
            "truck" => RoadUser::Truck,
            "bus" => RoadUser::Bus,
            "motorcycle" => RoadUser::Motorcycle,
            "bicycle" => RoadUser::Bicycle,
            "pedestrian" => RoadUser::Pedestrian,
            _ => RoadUser::Other,
        }
    }

    pub(super) fn problem(&self, what: impl Into<String>, remedy: &str) -> Problem {
        Problem {
            element: format!("obstacle {}", self.id),
            line: Some(self.line),
            what: what.into(),
            remedy: remedy.into(),
        }
    }
}

/// A state while it is read.
#[derive(Default)]
struct Moment {
    line: usize,
    place: Place,
    velocity: Value,
    time: Value,
}

impl Moment {
    fn take(&mut self, leaf: &str, value: f64) {
        self.place.take(leaf, value);
        match leaf.split_once('/') {
            Some(("velocity", leaf)) => self.velocity.take(leaf, value),
            Some(("time", leaf)) => self.time.take(leaf, value),
            _ => {}
        }
    }

    /// The state, or its problem; a missing speed is NaN.
    fn state(&self) -> Result<State, &'static str> {
        let time = self.time.exact.or_else(|| self.time.middle().map(f64::round));
        let frame = time.filter(|it| (0.0..=MAXIMUM_FRAME).contains(it) && it.fract() == 0.0);
        let frame = frame.ok_or("its time is not a whole number of steps")? as i64;
        let ([x, y], heading) = self.place.known()?;
        Ok(State { frame, x, y, speed: self.velocity.middle().unwrap_or(f64::NAN), heading })
    }
}

impl Flaws {
    fn add(&mut self, line: usize, why: &'static str) {
        if self.number == 0 {
            self.first = (line, why);
        }
        self.number += 1;
    }

    fn what(&self) -> Option<String> {
        let (line, why) = self.first;
        let number = self.number;
        (number > 0).then(|| format!("{number} of its states are left out (the first, line {line}: {why})"))
    }
}

/// Fills in missing speeds from the path since the state before, or else to the next one.
fn fill_speeds(states: &mut [State], step: f64) {
    for here in 0..states.len() {
        let (from, to) = if here == 0 { (0, 1) } else { (here - 1, here) };
        if states[here].speed.is_nan() && to < states.len() {
            let (from, to) = (states[from], states[to]);
            let time = (to.frame - from.frame) as f64 * step;
            states[here].speed = (to.x - from.x).hypot(to.y - from.y) / time;
        }
    }
}
