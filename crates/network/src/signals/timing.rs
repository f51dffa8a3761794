//! Cycle and greens by Webster (1958, from memory): C = (1.5 L + 5 s)/(1 − Y), with L the lost time of a cycle and Y
//! the sum of the flow ratios; the greens share C − L in proportion to their flow ratios.
//!
//! The lost time of a stage is its yellow and its all-red: drivers lose about as much at the start of green as they use
//! of the yellow.

use super::stage::Stage;
use crate::junction::{LightIndex, SignalPlan, Turn};

/// Length of yellow [s] (definitions of generated programs).
const YELLOW: f64 = 3.0;
/// Speed at which vehicles clear a junction [m/s], and minimum clearance time [s].
const CLEARING_SPEED: f64 = 8.0;
const LEAST_ALL_RED: f64 = 2.0;
/// Minimum green [s]; with more stages than fit into the cycle, the cycle is longer. Ours.
const LEAST_GREEN: f64 = 5.0;
/// Bounds of the cycle [s].
const CYCLES: (f64, f64) = (40.0, 120.0);

/// Programs are written in tenths of a second.
const TENTHS: f64 = 10.0;

/// Time for the last vehicle to clear a junction over a path of this length [m] [s].
pub(super) fn all_red(clearance: f64) -> f64 {
    (TENTHS * (clearance / CLEARING_SPEED).max(LEAST_ALL_RED)).ceil() / TENTHS
}

/// Lost time in each cycle [s].
fn lost(stages: &[Stage]) -> f64 {
    stages.iter().map(|it| YELLOW + it.all_red).sum()
}

/// Webster's cycle [s], without bounds. Where no cycle is long enough, it grows with the flow ratio, so that programs
/// can be compared.
pub(super) fn webster(stages: &[Stage]) -> f64 {
    /// Beyond this sum of flow ratios the cycle grows in proportion to it.
    const FULL: f64 = 0.95;
    let flow_ratio: f64 = stages.iter().map(|it| it.flow_ratio).sum();
    let optimum = (1.5 * lost(stages) + 5.0) / (1.0 - flow_ratio.min(FULL));
    optimum * (flow_ratio / FULL).max(1.0)
}

/// Stages with their greens.
pub(super) struct Timed {
    pub(super) stages: Vec<Stage>,
    /// By stage [s].
    pub(super) greens: Vec<f64>,
    /// Start of the first stage [s].
    pub(super) offset: f64,
}

impl Timed {
    /// Stages with Webster's cycle, in whole seconds, an even number of them: half of it is whole, too.
    pub(super) fn by_webster(stages: Vec<Stage>) -> Timed {
        let cycle = 2.0 * (0.5 * webster(&stages).clamp(CYCLES.0, CYCLES.1)).ceil();
        let mut timed = Timed { greens: vec![LEAST_GREEN; stages.len()], stages, offset: 0.0 };
        timed.stretch(cycle);
        timed
    }

    /// Gives them the greens of a `cycle` [s], or of the shortest possible one.
    pub(super) fn stretch(&mut self, cycle: f64) {
        let mut left = cycle.max(self.shortest()) - lost(&self.stages);
        let ratio = |stage: usize| self.stages[stage].flow_ratio.max(f64::MIN_POSITIVE);
        let mut order: Vec<usize> = (0..self.stages.len()).collect();
        order.sort_by(|a, b| ratio(*a).total_cmp(&ratio(*b)));
        let mut ratios: f64 = order.iter().map(|it| ratio(*it)).sum();
        let mut shares = vec![0.0; order.len()];
        // Where the smallest share is too short, it is the minimum, and the others share the rest.
        for stage in order {
            shares[stage] = (left * (ratio(stage) / ratios)).max(LEAST_GREEN);
            left -= shares[stage];
            ratios -= ratio(stage);
        }
        // Each green ends at a tenth of a second.
        let mut end = 0.0;
        let ends = shares.iter().map(|it| {
            let from = f64::round(TENTHS * end);
            end += it;
            (f64::round(TENTHS * end) - from) / TENTHS
        });
        self.greens = ends.collect();
    }

    /// When the green of a light begins, and how long it is [s]: the green of its stage with the largest flow ratio,
    /// and those right before it, through which it stays green.
    pub(super) fn green(&self, light: LightIndex) -> (f64, f64) {
        let has = |stage: usize| self.stages[stage].lights.contains(&light);
        let ratio = |stage: usize| self.stages[stage].flow_ratio;
        let own = (0..self.stages.len()).filter(|it| has(*it));
        let Some(core) = own.max_by(|a, b| ratio(*a).total_cmp(&ratio(*b)).then(b.cmp(a))) else {
            return (self.offset, self.cycle());
        };
        let count = self.stages.len();
        let earlier = (1..count).take_while(|it| has((core + count - it) % count)).count();
        let before = (1..=earlier).map(|it| self.duration((core + count - it) % count)).sum::<f64>();
        (self.start(core) - before, before + self.greens[core])
    }

    /// How long a stage takes, with its yellow and all-red [s].
    fn duration(&self, stage: usize) -> f64 {
        self.greens[stage] + YELLOW + self.stages[stage].all_red
    }

    /// The shortest possible cycle [s].
    pub(super) fn shortest(&self) -> f64 {
        lost(&self.stages) + LEAST_GREEN * self.stages.len() as f64
    }

    /// Length of its cycle [s].
    pub(super) fn cycle(&self) -> f64 {
        lost(&self.stages) + self.greens.iter().sum::<f64>()
    }

    /// When the green of a stage begins [s].
    fn start(&self, stage: usize) -> f64 {
        self.offset + (0..stage).map(|it| self.duration(it)).sum::<f64>()
    }

    pub(super) fn plan(self) -> SignalPlan {
        let turn = |(stage, green): (Stage, f64)| Turn {
            lights: stage.lights,
            green,
            extension: None,
            yellow: YELLOW,
            all_red: stage.all_red,
        };
        SignalPlan {
            offset: self.offset,
            turns: self.stages.into_iter().zip(self.greens).map(turn).collect(),
        }
    }
}
