//! Plans of signals: phases of several lights, one after the other; and which lights conflict.

use super::light::{LightIndex, Phase, Program};
use super::zone::ZoneIndex;

/// Maximum green of actuated lights [s]; ours.
const LONGEST_GREEN: f64 = 40.0;

/// A program for several lights: phases that follow each other and repeat.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalPlan {
    /// Start of the first phase, and of every further cycle [s].
    pub offset: f64,
    /// The phases in order.
    pub turns: Vec<Turn>,
}

/// A phase: some lights are green, then yellow, and then all are red.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// The lights that are green. A light that is green in the next phase, too, stays green in between.
    pub lights: Vec<LightIndex>,
    /// Length of green, the maximum if traffic extends it [s].
    pub green: f64,
    /// How traffic extends it; `None`: it is fixed.
    pub extension: Option<Extension>,
    /// Length of the yellow after it [s].
    pub yellow: f64,
    /// Length of red for all after that [s].
    pub all_red: f64,
}

/// How traffic extends a green.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extension {
    /// Minimum green [s].
    pub least: f64,
    /// Gap time: green ends when no vehicle has come for so long [s].
    pub gap: f64,
}

impl Default for Extension {
    /// Ours.
    fn default() -> Extension {
        Extension { least: 5.0, gap: 2.0 }
    }
}

/// Two lights whose drivers conflict.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightConflict {
    /// The lights; the one that comes first in the list is first.
    pub lights: [LightIndex; 2],
    /// Where: a zone in which neither side has priority, if there is one, or else any.
    pub zone: ZoneIndex,
    /// The side of the zone for the drivers of the first light.
    pub side: u8,
    /// In every zone one of them gives way, like a turn across oncoming traffic: both may be green.
    pub is_ordered: bool,
}

impl Turn {
    /// How long it takes [s].
    pub fn duration(&self) -> f64 {
        self.green + self.yellow + self.all_red
    }
}

impl SignalPlan {
    /// Its lights; a light of several phases comes several times.
    pub fn lights(&self) -> impl Iterator<Item = LightIndex> {
        self.turns.iter().flat_map(|it| it.lights.iter().copied())
    }

    /// Length of a cycle [s].
    pub fn cycle(&self) -> f64 {
        self.turns.iter().map(Turn::duration).sum()
    }

    /// The same lights, actuated, with greens of 5 to 40 s; ours. Actuated plans have no offset.
    pub fn actuated(mut self) -> SignalPlan {
        self.offset = 0.0;
        for turn in &mut self.turns {
            (turn.green, turn.extension) = (LONGEST_GREEN, Some(Extension::default()));
        }
        self
    }

    /// Whether traffic extends some of its greens.
    pub fn is_actuated(&self) -> bool {
        self.turns.iter().any(|it| it.extension.is_some())
    }

    /// The program of one of its lights; of an actuated one with the maximum greens.
    pub fn program(&self, light: LightIndex) -> Program {
        let has_turn = |number: usize| self.turns[number].lights.contains(&light);
        let count = self.turns.len();
        if (0..count).all(has_turn) {
            return Program::ALWAYS_GREEN;
        }
        let cycle = self.cycle();
        let mut phases: Vec<Phase> = Vec::new();
        let mut from = self.offset;
        for (number, turn) in self.turns.iter().enumerate() {
            let phase = Phase { from, to: from + turn.green, yellow: turn.yellow };
            match phases.last_mut() {
                Some(last) if has_turn(number) && has_turn(number - 1) => {
                    *last = Phase { from: last.from, ..phase };
                }
                _ if has_turn(number) => phases.push(phase),
                _ => {}
            }
            from += turn.duration();
        }
        if has_turn(0) && has_turn(count - 1) {
            let first = phases.remove(0);
            if let Some(last) = phases.last_mut() {
                *last = Phase { from: last.from, to: first.to + cycle, ..first };
            }
        }
        Program { cycle, phases }
    }
}
