//! Traffic lights and their programs.

use crate::id::Id;
use serde::{Deserialize, Serialize};

/// A light's place in [`super::Junctions::lights`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct LightIndex(pub u32);

impl LightIndex {
    /// The place as an index.
    #[inline]
    pub fn at(self) -> usize {
        self.0 as usize
    }
}

/// A light, or several lights that the drivers on one lanelet obey together.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The smallest id of its regulatory elements: its name.
    pub id: Id,
    /// Its program; of an actuated light, with the maximum greens.
    pub program: Program,
    /// The plan from which it has its program, if it has one.
    pub plan: Option<InPlan>,
}

/// The plan of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InPlan {
    /// The first light of the plan. Lights with the same first light share their plan.
    pub first: LightIndex,
    /// Offset of the plan: when its first phase begins [s].
    pub offset: f64,
    /// Traffic extends greens of the plan.
    pub is_actuated: bool,
}

/// What a light shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightState {
    /// Go.
    Green,
    /// Stop if that is possible with comfort.
    Yellow,
    /// Stop.
    Red,
}

impl LightState {
    /// Its name in tables: green, yellow or red.
    pub fn name(self) -> &'static str {
        match self {
            LightState::Green => "green",
            LightState::Yellow => "yellow",
            LightState::Red => "red",
        }
    }
}

/// A program that repeats: green within `green`, yellow after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Length of a cycle [s].
    pub cycle: f64,
    /// The phases, in the order of the cycle.
    pub phases: Vec<Phase>,
}

/// A green and the yellow after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// When green begins within the cycle [s].
    pub from: f64,
    /// When it ends [s].
    pub to: f64,
    /// Length of the yellow after it [s].
    pub yellow: f64,
}

impl Program {
    /// A light that is always green.
    pub const ALWAYS_GREEN: Program = Program { cycle: 60.0, phases: Vec::new() };

    /// Mean waiting time for green of a vehicle that arrives at a random time and finds no queue [s].
    pub fn mean_wait(&self) -> f64 {
        let count = self.phases.len();
        let next = |number: usize| self.phases[(number + 1) % count].from;
        let red = |(number, it): (usize, &Phase)| {
            let until_next = (next(number) - it.to).rem_euclid(self.cycle);
            until_next * until_next
        };
        self.phases.iter().enumerate().map(red).sum::<f64>() / (2.0 * self.cycle)
    }

    /// What a light with this program shows at `time` [s].
    pub fn state(&self, time: f64) -> LightState {
        self.state_within(self.within_cycle(time))
    }

    /// What it shows at this time of its cycle [s].
    #[inline]
    pub(super) fn state_within(&self, at: f64) -> LightState {
        if self.phases.is_empty() {
            return LightState::Green;
        }
        // The yellow of a phase may reach into the next cycle.
        let shows = |phase: &Phase| {
            let since = self.within_cycle(at - phase.from);
            let green = phase.to - phase.from;
            if since < green {
                LightState::Green
            } else if since < green + phase.yellow {
                LightState::Yellow
            } else {
                LightState::Red
            }
        };
        let states = self.phases.iter().map(shows);
        states.min_by_key(|it| *it as u8).unwrap_or(LightState::Red)
    }

    /// Time from `time` [s] on during which it shows the same, except for rounding [s]; infinite if it never changes.
    pub fn steady_for(&self, time: f64) -> f64 {
        let at = self.within_cycle(time);
        let ends = self.phases.iter().flat_map(|it| [it.from, it.to, it.to + it.yellow]);
        ends.map(|it| self.within_cycle(it - at)).fold(f64::INFINITY, f64::min)
    }

    /// The time since the last beginning of a cycle [s]. The remainder takes long, and is computed only where a sum
    /// is not the same.
    #[inline]
    pub(super) fn within_cycle(&self, time: f64) -> f64 {
        match time {
            _ if (0.0..self.cycle).contains(&time) => time,
            _ if -self.cycle < time && time < 0.0 => time + self.cycle,
            _ => time.rem_euclid(self.cycle),
        }
    }

    /// Whether it is green at some time at which `other` is green, too; programs with other cycles shift against it.
    pub(crate) fn is_green_with(&self, other: &Program) -> bool {
        if self.phases.is_empty() || other.phases.is_empty() || self.cycle != other.cycle {
            return true;
        }
        let meet = |a: &Phase, b: &Phase| {
            let later = self.within_cycle(b.from - a.from);
            later < a.to - a.from || self.cycle - later < b.to - b.from
        };
        self.phases.iter().any(|a| other.phases.iter().any(|b| meet(a, b)))
    }

    /// Share of the time that it is green.
    pub fn green_share(&self) -> f64 {
        if self.phases.is_empty() {
            return 1.0;
        }
        self.phases.iter().map(|it| it.to - it.from).sum::<f64>() / self.cycle
    }
}
