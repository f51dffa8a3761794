//! The controller of an actuated junction: the state of its signal program, and when it goes on. A *turn* is a phase of
//! the program.
//!
//! A vehicle that comes to a red light calls the first turn in which this light is green. As long as no other turn is
//! called, the present one stays green. Then its green ends when no vehicle has come to its lights for the gap time, or
//! at the maximum green, which counts from the first call. It never ends before the minimum green. Turns that are not
//! called are skipped. Gap time, minimum and maximum green are those of the usual actuated controllers (such as NEMA TS
//! 2; from memory).

use laneweave_network::{Extension, LightIndex, LightState, SignalPlan, Turn};
use serde::{Deserialize, Serialize};

use crate::state::clock::Clock;

/// The state of a signal program.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Controller {
    turns: Vec<Timed>,
    /// The turn whose lights are green, or were green last.
    turn: usize,
    stage: Stage,
    /// Step in which the stage began.
    since: u32,
    /// Last step of the green in which a vehicle came to a light that will be red in the next turn.
    seen: u32,
    /// First step of the green since which another turn has been called.
    called: Option<u32>,
}

/// What a turn shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Stage {
    Green,
    /// Before the turn with this number.
    Yellow(usize),
    /// Before the turn with this number.
    AllRed(usize),
}

/// A turn with its times in steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Timed {
    lights: Vec<LightIndex>,
    /// It needs no call, and no vehicle extends it.
    is_fixed: bool,
    least: u32,
    most: u32,
    gap: u32,
    yellow: u32,
    all_red: u32,
}

impl Timed {
    fn of(turn: &Turn, clock: Clock) -> Timed {
        let steps = |duration: f64| (duration / clock.dt).round() as u32;
        let Extension { least, gap } = turn.extension.unwrap_or(Extension { least: turn.green, gap: 0.0 });
        Timed {
            lights: turn.lights.clone(),
            is_fixed: turn.extension.is_none(),
            least: steps(least),
            most: steps(turn.green),
            gap: steps(gap),
            yellow: steps(turn.yellow),
            all_red: steps(turn.all_red),
        }
    }
}

impl Controller {
    /// The controller of `plan`; its first turn begins now.
    pub(crate) fn of(plan: &SignalPlan, clock: Clock) -> Controller {
        let turns = plan.turns.iter().map(|it| Timed::of(it, clock)).collect();
        let step = clock.step;
        Controller { turns, turn: 0, stage: Stage::Green, since: step, seen: step, called: Some(step) }
    }

    /// Whether it has the same program as `other`, in any state that is valid at `clock`.
    pub(crate) fn fits(&self, other: &Controller, clock: Clock) -> bool {
        let Controller { turns, turn, stage, since, seen, called } = self;
        let stage_fits = match stage {
            Stage::Green => true,
            Stage::Yellow(to) | Stage::AllRed(to) => *to < turns.len(),
        };
        let steps = [Some(*since), Some(*seen), *called];
        turns == &other.turns
            && *turn < turns.len()
            && stage_fits
            && steps.into_iter().flatten().all(|it| it <= clock.step)
    }

    /// Its lights. A light of several turns occurs several times.
    pub(crate) fn lights(&self) -> impl Iterator<Item = LightIndex> {
        self.turns.iter().flat_map(|it| it.lights.iter().copied())
    }

    /// What one of its lights shows.
    pub(crate) fn shows(&self, light: LightIndex) -> LightState {
        let has = |turn: usize| self.turns[turn].lights.contains(&light);
        match self.stage {
            _ if !has(self.turn) => LightState::Red,
            Stage::Green => LightState::Green,
            Stage::Yellow(to) | Stage::AllRed(to) if has(to) => LightState::Green,
            Stage::Yellow(_) => LightState::Yellow,
            Stage::AllRed(_) => LightState::Red,
        }
    }

    /// Advances to `step`. `is_awaited` tells to which lights vehicles come in this step.
    pub(crate) fn advance(&mut self, step: u32, is_awaited: impl Fn(LightIndex) -> bool) {
        let lasted = |controller: &Controller, duration: u32| step - controller.since >= duration;
        if let Stage::Yellow(to) = self.stage
            && lasted(self, self.turns[self.turn].yellow)
        {
            (self.stage, self.since) = (Stage::AllRed(to), step);
        }
        if let Stage::AllRed(to) = self.stage
            && lasted(self, self.turns[self.turn].all_red)
        {
            (self.turn, self.stage, self.since, self.seen, self.called) =
                (to, Stage::Green, step, step, None);
        }
        if self.stage != Stage::Green {
            return;
        }
        let next = self.next_called(&is_awaited);
        let Timed { lights, least, most, gap, .. } = &self.turns[self.turn];
        let turns_red = |light: &LightIndex| next.is_none_or(|to| !self.turns[to].lights.contains(light));
        if lights.iter().any(|it| turns_red(it) && is_awaited(*it)) {
            self.seen = step;
        }
        self.called = next.map(|_| self.called.unwrap_or(step));
        let (Some(to), Some(called)) = (next, self.called) else { return };
        if lasted(self, *least) && (step - self.seen >= *gap || step - called >= *most) {
            (self.stage, self.since) = (Stage::Yellow(to), step);
        }
    }

    /// The next turn that is fixed, or that a vehicle calls.
    fn next_called(&self, is_awaited: impl Fn(LightIndex) -> bool) -> Option<usize> {
        let count = self.turns.len();
        let here = &self.turns[self.turn].lights;
        let is_called = |turn: &usize| {
            let it = &self.turns[*turn];
            it.is_fixed || it.lights.iter().any(|light| !here.contains(light) && is_awaited(*light))
        };
        (1..count).map(|ahead| (self.turn + ahead) % count).find(is_called)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAIN: LightIndex = LightIndex(0);
    const SIDE: LightIndex = LightIndex(1);
    const LEFT: LightIndex = LightIndex(2);
    const CLOCK: Clock = Clock { step: 0, dt: 0.5 };

    /// A plan with a turn for each of these groups of lights: green 5 to 20 s, gap time 2 s, yellow 3 s, all-red 2 s.
    fn plan(groups: &[&[LightIndex]]) -> SignalPlan {
        let turn = |lights: &&[LightIndex]| Turn {
            lights: lights.to_vec(),
            green: 20.0,
            extension: Some(Extension { least: 5.0, gap: 2.0 }),
            yellow: 3.0,
            all_red: 2.0,
        };
        SignalPlan { offset: 0.0, turns: groups.iter().map(turn).collect() }
    }

    /// The times [s] at which a light changes, and what it shows then, within `duration` [s]. `is_awaited` tells by
    /// time [s] whether vehicles come to a light.
    fn switches(
        plan: &SignalPlan,
        light: LightIndex,
        duration: f64,
        is_awaited: impl Fn(f64, LightIndex) -> bool,
    ) -> Vec<(f64, LightState)> {
        let mut controller = Controller::of(plan, CLOCK);
        let mut last = controller.shows(light);
        let mut found = vec![(0.0, last)];
        for step in 1..=(duration / CLOCK.dt) as u32 {
            let time = f64::from(step) * CLOCK.dt;
            controller.advance(step, |it| is_awaited(time, it));
            if controller.shows(light) != last {
                last = controller.shows(light);
                found.push((time, last));
            }
        }
        found
    }

    use LightState::{Green, Red, Yellow};

    #[test]
    fn the_main_road_stays_green_as_long_as_nobody_comes_from_the_side() {
        let plan = plan(&[&[MAIN], &[SIDE]]);
        for is_busy in [true, false] {
            let found = switches(&plan, MAIN, 3600.0, |_, it| is_busy && it == MAIN);
            assert_eq!(found, [(0.0, Green)]);
        }
        assert_eq!(switches(&plan, SIDE, 3600.0, |_, it| it == MAIN), [(0.0, Red)]);
    }

    #[test]
    fn with_queues_everywhere_the_program_is_the_fixed_one_of_the_longest_greens() {
        let plan = plan(&[&[MAIN], &[LEFT], &[SIDE]]);
        for light in [MAIN, SIDE, LEFT] {
            let program = plan.program(light);
            let mut controller = Controller::of(&plan, CLOCK);
            for step in 1..1000 {
                controller.advance(step, |_| true);
                let time = f64::from(step) * CLOCK.dt;
                assert_eq!(controller.shows(light), program.state(time), "{light:?} at {time} s");
            }
        }
    }

    #[test]
    fn a_green_ends_a_gap_after_the_last_vehicle_but_not_before_its_minimum() {
        let plan = plan(&[&[MAIN], &[SIDE]]);
        // A vehicle waits at the side from 10 s on. On the main road the last vehicle passes at `last`.
        for (last, end) in [(12.0, 14.0), (21.0, 23.0), (0.0, 10.0)] {
            let found =
                switches(
                    &plan,
                    MAIN,
                    end + 5.0,
                    |time, it| {
                        if it == MAIN { time <= last } else { time >= 10.0 }
                    },
                );
            assert_eq!(found, [(0.0, Green), (end, Yellow), (end + 3.0, Red)]);
        }
        let at_once = switches(&plan, MAIN, 10.0, |_, it| it == SIDE);
        assert_eq!(at_once, [(0.0, Green), (5.0, Yellow), (8.0, Red)]);
    }

    #[test]
    fn a_busy_road_stays_green_for_its_maximum_after_somebody_came_from_the_side() {
        let plan = plan(&[&[MAIN], &[SIDE]]);
        let found = switches(&plan, MAIN, 200.0, |time, it| it == MAIN || (100.0..=125.0).contains(&time));
        // The side road gets its minimum green, and no vehicle calls it again.
        assert_eq!(found, [(0.0, Green), (120.0, Yellow), (123.0, Red), (135.0, Green)]);
    }

    #[test]
    fn a_light_of_two_turns_stays_green_from_one_to_the_other_and_extends_the_second_only() {
        let plan = plan(&[&[MAIN], &[LEFT], &[SIDE, LEFT]]);
        let found = switches(&plan, LEFT, 70.0, |_, _| true);
        assert_eq!(found, [(0.0, Red), (25.0, Green), (55.0, Yellow), (58.0, Red)]);
        assert_eq!(switches(&plan, SIDE, 50.0, |_, _| true), [(0.0, Red), (35.0, Green)]);
    }

    #[test]
    fn a_turn_that_nobody_calls_is_left_out_unless_it_is_fixed() {
        let mut plan = plan(&[&[MAIN], &[LEFT], &[SIDE]]);
        let is_awaited = |_, it: LightIndex| it != LEFT;
        assert_eq!(switches(&plan, LEFT, 300.0, is_awaited), [(0.0, Red)]);
        plan.turns[1].extension = None;
        let found = switches(&plan, LEFT, 60.0, is_awaited);
        assert_eq!(found, [(0.0, Red), (25.0, Green), (45.0, Yellow), (48.0, Red)]);
    }
}
