//! Offsets of signal plans that users change. A plan comes to its new offset by taking longer: until then its time runs
//! at four fifths. So every green, yellow and all-red lasts at least as long as in the plan, and the plan is where it
//! shall be after at most five cycles. Signal controllers make such transitions by adding time, too ("add" in NTCIP
//! 1202; from memory, as is the share of a fifth).

use laneweave_network::{InPlan, LightIndex, LightState, Network, Program};
use serde::{Deserialize, Serialize};

/// So much of each second a plan waits, while it comes to its new offset.
const WAITS: f64 = 0.2;

/// The plans whose offsets were changed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Offsets {
    plans: Vec<Shift>,
}

/// How much later a plan is than without the change.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Shift {
    /// The first light of the plan.
    first: LightIndex,
    /// By how much it is later now [s].
    now: f64,
    /// By how much it shall be later [s].
    goal: f64,
    /// The offset that was asked for [s].
    offset: f64,
}

impl Shift {
    fn is_on_its_way(&self) -> bool {
        self.now < self.goal
    }

    /// The lights of its plan, with their programs.
    fn lights<'a>(&self, network: &'a Network) -> impl Iterator<Item = (usize, &'a Program)> {
        let first = self.first;
        let lights = network.junctions.lights.iter().enumerate();
        let is_of_plan = move |plan: &Option<InPlan>| plan.is_some_and(|it| it.first == first);
        lights.filter(move |(_, it)| is_of_plan(&it.plan)).map(|(at, it)| (at, &it.program))
    }
}

impl Offsets {
    /// Gives the plan of a light, with cycles of this length [s], another offset [s].
    pub(crate) fn set(&mut self, plan: InPlan, cycle: f64, offset: f64) {
        let before = self.plans.iter().position(|it| it.first == plan.first);
        let now = before.map_or(0.0, |it| self.plans.swap_remove(it).now).rem_euclid(cycle);
        let goal = now + (offset - plan.offset - now).rem_euclid(cycle);
        self.plans.push(Shift { first: plan.first, now, goal, offset });
    }

    /// The offset that a plan has, or shall have [s].
    pub(crate) fn of(&self, plan: InPlan) -> f64 {
        let changed = self.plans.iter().find(|it| it.first == plan.first);
        changed.map_or(plan.offset, |it| it.offset)
    }

    /// A step passes, which takes `dt` [s].
    pub(crate) fn advance(&mut self, dt: f64) {
        for plan in self.plans.iter_mut().filter(|it| it.is_on_its_way()) {
            plan.now = (plan.now + WAITS * dt).min(plan.goal);
        }
    }

    /// Shows the states of these plans at `time` [s], each at the place of its light.
    pub(crate) fn show(&self, network: &Network, time: f64, shown: &mut [LightState]) {
        for plan in &self.plans {
            plan.lights(network).for_each(|(at, program)| shown[at] = program.state(time - plan.now));
        }
    }

    /// Time from `time` [s] on during which these plans show the same, except for rounding [s].
    pub(crate) fn steady_for(&self, network: &Network, time: f64) -> f64 {
        let steady = |plan: &Shift| match plan.is_on_its_way() {
            true => 0.0,
            false => {
                let each = plan.lights(network).map(|(_, program)| program.steady_for(time - plan.now));
                each.fold(f64::INFINITY, f64::min)
            }
        };
        self.plans.iter().map(steady).fold(f64::INFINITY, f64::min)
    }

    /// Whether they can be those of a world with so many lights.
    pub(crate) fn fit(&self, lights: usize) -> bool {
        self.plans.iter().all(|it| it.first.at() < lights && it.now.is_finite() && it.goal.is_finite())
    }
}
