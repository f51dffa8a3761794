//! One world, in which a program drives one vehicle from episode to episode.

use laneweave::{Control, Event, Fault, LaneChange, Simulation, VehicleId};

use crate::action::Asked;
use crate::batch::Plan;
use crate::observation::Memory;
use crate::reward::Rewards;
use crate::start::StartNumber;

/// Drivers so near are around the ego [m].
pub const AROUND: f64 = 100.0;

/// One world.
pub(crate) struct LearningWorld {
    pub(crate) simulation: Simulation,
    pub(crate) ego: VehicleId,
    pub(crate) start: StartNumber,
    seed: u64,
    episode: u32,
    /// Steps of the episode so far.
    steps: u32,
    /// The speed that discrete actions ask for [m/s].
    target: f64,
    /// Whether it is between two lanes.
    is_changing: bool,
    /// What the last action led to.
    pub(crate) outcome: Outcome,
    /// The lane changes of the ego and of the drivers around in the steps of the last action, if they are wanted.
    pub(crate) changes: Vec<LaneChange>,
    memory: Memory,
}

/// What an action led to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub(crate) terms: Rewards,
    /// The vehicle collided, or left the road.
    pub(crate) is_terminated: bool,
    /// The time of the episode is over.
    pub(crate) is_truncated: bool,
}

impl Outcome {
    pub(crate) const NOTHING: Outcome =
        Outcome { terms: Rewards::NOTHING, is_terminated: false, is_truncated: false };

    /// Whether the episode is over.
    pub(crate) fn is_over(&self) -> bool {
        self.is_terminated || self.is_truncated
    }
}

impl LearningWorld {
    /// A world at the beginning of an episode of `seed`.
    ///
    /// # Errors
    /// If no ego comes.
    pub(crate) fn new(plan: &Plan, seed: u64, episode: u32) -> Result<LearningWorld, Fault> {
        let (number, goes_on) = plan.starts.drawn(seed, episode);
        let start = plan.starts.at(number)?;
        let simulation = start.template.spawn(goes_on)?;
        let target = simulation.view(start.ego).map_or(0.0, |it| it.speed().min(Control::FASTEST));
        Ok(LearningWorld {
            simulation,
            ego: start.ego,
            start: number,
            seed,
            episode,
            steps: 0,
            target,
            is_changing: false,
            outcome: Outcome::NOTHING,
            changes: Vec::new(),
            memory: Memory::default(),
        })
    }

    /// Begins the next episode; the first one of `seed`, if it is given.
    ///
    /// # Errors
    /// If no ego comes. Nothing changes then.
    pub(crate) fn reset(&mut self, plan: &Plan, seed: Option<u64>) -> Result<(), Fault> {
        let next = seed.map_or_else(
            || LearningWorld::new(plan, self.seed, self.episode + 1),
            |seed| LearningWorld::new(plan, seed, 0),
        )?;
        *self = LearningWorld { memory: std::mem::take(&mut self.memory), ..next };
        Ok(())
    }

    /// A simulation that goes on from where this world is.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub(crate) fn copy(&self, plan: &Plan) -> Result<Simulation, Fault> {
        let seed = self.simulation.scenario().run.seed;
        let mut copy = plan.starts.at(self.start)?.template.spawn(seed)?;
        copy.take_state_of(&self.simulation)?;
        Ok(copy)
    }

    /// Acts, and simulates until the next action is due or the episode is over.
    ///
    /// # Errors
    /// If the action cannot be carried out.
    pub(crate) fn act(&mut self, plan: &Plan, numbers: &[f64]) -> Result<(), Fault> {
        self.outcome = Outcome::NOTHING;
        self.changes.clear();
        let share = 1.0 / f64::from(plan.decision);
        let Some(asked) = self.asked(plan, numbers) else { return Ok(()) };
        if let Asked::Control(control) = asked {
            self.simulation.control(self.ego, control)?;
        }
        for step in 1..=plan.decision {
            if let Asked::Path(path) = &asked {
                let control = path.control(f64::from(step) * share, plan.task.decision_s);
                self.simulation.control(self.ego, control)?;
            }
            self.simulation.advance();
            self.steps += 1;
            self.note(plan, share);
            if self.outcome.is_over() {
                break;
            }
        }
        Ok(())
    }

    /// What the action asks of the ego.
    fn asked(&mut self, plan: &Plan, numbers: &[f64]) -> Option<Asked> {
        let vehicle = self.simulation.view(self.ego)?;
        let limit = self.simulation.network().chain(vehicle.spot.chain).limit(vehicle.x());
        let mut target = self.target;
        let asked = plan.task.action.asked(numbers, &vehicle, limit, &mut target);
        self.target = target;
        Some(asked)
    }

    /// Notes what the last step meant for the ego.
    fn note(&mut self, plan: &Plan, share: f64) {
        let Outcome { terms, is_terminated, is_truncated } = &mut self.outcome;
        let events = self.simulation.events();
        for event in &events {
            match event {
                Event::Incident(it) if it.vehicles.contains(&self.ego) => {
                    (terms.collision, *is_terminated) = (1.0, true);
                }
                Event::MissedTurn(it) if it.vehicle == self.ego => terms.missed_turn += 1.0,
                _ => {}
            }
        }
        match self.simulation.view(self.ego) {
            Some(vehicle) => {
                terms.add(&self.simulation, &vehicle, share);
                let is_changing = vehicle.driver.phase.is_between_lanes();
                terms.lane_change += f64::from(u8::from(is_changing && !self.is_changing));
                self.is_changing = is_changing;
            }
            None => *is_terminated = true,
        }
        *is_truncated = !*is_terminated && self.steps >= plan.limit;
        if plan.keeps_changes {
            self.keep_changes(events);
        }
    }

    /// Keeps the lane changes around the ego among these events.
    fn keep_changes(&mut self, events: Vec<Event>) {
        let Some(ego) = self.simulation.view(self.ego) else { return };
        let here = ego.pose().at;
        for event in events {
            let Event::LaneChange(change) = event else { continue };
            let there = self.simulation.view(change.vehicle).map(|it| it.pose().at);
            if there.is_some_and(|it| (it.x - here.x).hypot(it.y - here.y) <= AROUND) {
                self.changes.push(change);
            }
        }
    }

    /// Writes what the ego sees into `numbers`: all 0 if it has left the road.
    pub(crate) fn observe(&mut self, plan: &Plan, numbers: &mut [f32]) {
        numbers.fill(0.0);
        if let Some(vehicle) = self.simulation.view(self.ego) {
            plan.task.observation.write(&self.simulation, &vehicle, &mut self.memory, numbers);
        }
    }
}
