//! What a program may do with its vehicle.

use laneweave::network::{Pose, Side};
use laneweave::sim::Vehicle;
use laneweave::{Control, Lateral, Longitudinal};
use serde::{Deserialize, Serialize};

/// What an action is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// One of the [`Choice`]s, as its number.
    #[default]
    Discrete,
    /// An acceleration and a lane wish, both from −1 to 1. At −1 the vehicle brakes with 8 m/s², at 1 it accelerates
    /// with 3 m/s², whatever is ahead. Below −1/3 it changes to the right, above 1/3 to the left, otherwise it keeps
    /// its lane. Numbers beyond count as −1 and 1.
    Continuous,
    /// The displacement of its centre until the next action: forwards and to the left, in the frame of the vehicle [m],
    /// and its turn counter-clockwise [rad]. The vehicle drives there in equal parts, whatever is in its way.
    Pose,
}

/// The discrete actions. A vehicle keeps its speed, whatever is ahead, until an action changes it. It changes lanes as
/// soon as the gap there is large enough for its driver, as long as the action wishes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// It changes to the left.
    Left,
    /// It goes on as it is.
    Keep,
    /// It changes to the right.
    Right,
    /// It drives faster by 2.5 m/s, up to a fifth above the speed limit.
    Faster,
    /// It drives slower by 2.5 m/s.
    Slower,
}

impl Choice {
    /// All of them, in the order of their numbers.
    pub const ALL: [Choice; 5] = [Choice::Left, Choice::Keep, Choice::Right, Choice::Faster, Choice::Slower];
    /// Their names, in this order.
    pub const NAMES: [&'static str; 5] = ["left", "keep", "right", "faster", "slower"];
    /// By how much an action changes the speed [m/s].
    const SPEED_STEP: f64 = 2.5;
    /// No action asks for more than this share of the speed limit.
    const FASTEST: f64 = 1.2;

    /// The speed that the vehicle has from now on, which had the target `speed` where this speed limit holds [m/s].
    fn speed(self, speed: f64, limit: f64) -> f64 {
        match self {
            Choice::Faster => (speed + Choice::SPEED_STEP).min(Choice::FASTEST * limit).max(speed),
            Choice::Slower => (speed - Choice::SPEED_STEP).max(0.0),
            _ => speed,
        }
    }

    fn lateral(self) -> Lateral {
        match self {
            Choice::Left => Lateral::Change(Side::Left),
            Choice::Right => Lateral::Change(Side::Right),
            _ => Lateral::Keep,
        }
    }
}

/// A lane wish beyond this asks for a change.
const WISH: f64 = 1.0 / 3.0;
/// Acceleration and deceleration of a full action [m/s²].
const FULL: [f64; 2] = [3.0, Control::HARDEST];

impl Action {
    /// How many numbers an action has.
    #[must_use]
    pub fn numbers(self) -> usize {
        match self {
            Action::Discrete => 1,
            Action::Continuous => 2,
            Action::Pose => 3,
        }
    }

    /// Whether a number can be part of an action.
    pub(crate) fn takes(self, number: f64) -> bool {
        match self {
            Action::Discrete => number.fract() == 0.0 && (0.0..Choice::ALL.len() as f64).contains(&number),
            Action::Continuous | Action::Pose => number.is_finite(),
        }
    }

    /// What to do where it cannot.
    pub(crate) fn remedy(self) -> &'static str {
        match self {
            Action::Discrete => "choose 0 to 4: left, keep, right, faster, slower",
            Action::Continuous | Action::Pose => "give finite numbers",
        }
    }

    /// What `numbers` ask of the vehicle, whose target speed so far is `target` [m/s]. It becomes the new one.
    pub(crate) fn asked(self, numbers: &[f64], vehicle: &Vehicle, limit: f64, target: &mut f64) -> Asked {
        let driven = |longitudinal, lateral| Asked::Control(Control::Drive { longitudinal, lateral });
        match (self, numbers) {
            (Action::Discrete, [number]) => {
                let choice = Choice::ALL[*number as usize];
                *target = choice.speed(*target, limit);
                driven(Longitudinal::Speed(*target), choice.lateral())
            }
            (Action::Continuous, [acceleration, wish]) => {
                let acceleration = acceleration.clamp(-1.0, 1.0);
                let full = FULL[usize::from(acceleration < 0.0)];
                let lateral = match *wish {
                    it if it > WISH => Lateral::Change(Side::Left),
                    it if it < -WISH => Lateral::Change(Side::Right),
                    _ => Lateral::Keep,
                };
                driven(Longitudinal::Acceleration(acceleration * full), lateral)
            }
            (_, numbers) => {
                let [ahead, left, turn] = [0, 1, 2].map(|it| numbers.get(it).copied().unwrap_or(0.0));
                Asked::Path(Path { from: vehicle.pose(), ahead, left, turn })
            }
        }
    }
}

/// What an action asks of a vehicle until the next one.
pub(crate) enum Asked {
    /// The same all the time.
    Control(Control),
    /// To drive along a path.
    Path(Path),
}

/// A displacement from a pose: forwards and to the left [m], and a turn [rad].
pub(crate) struct Path {
    from: Pose,
    ahead: f64,
    left: f64,
    turn: f64,
}

impl Path {
    /// The control that leads to `share` of the path, which takes `time` [s] as a whole.
    pub(crate) fn control(&self, share: f64, time: f64) -> Control {
        let (sine, cosine) = self.from.heading.sin_cos();
        let [ahead, left] = [self.ahead, self.left].map(|it| share * it);
        Control::Pose {
            x: self.from.at.x + ahead * cosine - left * sine,
            y: self.from.at.y + ahead * sine + left * cosine,
            heading: self.from.heading + share * self.turn,
            speed: (self.ahead.hypot(self.left) / time).min(Control::FASTEST),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faster_ends_a_fifth_above_the_limit_and_slower_at_standstill() {
        let after = |choice: Choice, times: usize| (0..times).fold(25.0, |it, _| choice.speed(it, 30.0));
        assert_eq!([after(Choice::Faster, 1), after(Choice::Faster, 9)], [27.5, 36.0]);
        assert_eq!([after(Choice::Slower, 1), after(Choice::Slower, 20)], [22.5, 0.0]);
        assert_eq!(after(Choice::Left, 3), 25.0);
        // Where the limit falls nobody is made to brake.
        assert_eq!(Choice::Faster.speed(25.0, 10.0), 25.0);
    }

    #[test]
    fn a_path_is_driven_in_equal_parts() {
        let at = laneweave::network::Point::new(10.0, 5.0, 0.0);
        let path = Path {
            from: Pose { at, heading: std::f64::consts::FRAC_PI_2 },
            ahead: 8.0,
            left: 1.0,
            turn: 0.2,
        };
        let Control::Pose { x, y, heading, speed } = path.control(0.5, 1.0) else { panic!("a pose") };
        assert!((x - 9.5).abs() < 1e-12 && (y - 9.0).abs() < 1e-12);
        assert!((heading - std::f64::consts::FRAC_PI_2 - 0.1).abs() < 1e-12);
        assert!((speed - 65f64.sqrt()).abs() < 1e-12);
    }
}
