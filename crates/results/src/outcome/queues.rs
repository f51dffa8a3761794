//! The queues at the entrances, and what blocks them: a part of the summary.

use laneweave_network::{Id, Position};
use laneweave_sim::{EntryQueue, Held, World, entry_queues};
use serde::{Deserialize, Serialize};

/// Time between two observations of the queues [s].
const SAMPLING: f64 = 1.0;

/// Observes the queues at all lanes of all entrances.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Queues {
    /// In the order of the demand.
    lanes: Vec<Queue>,
}

/// The queue for one lane of an entrance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Queue {
    /// The entrance's name: the smallest id of its lanelets.
    pub entrance: Id,
    /// The lanelet on which its vehicles enter.
    pub lanelet: Id,
    /// Vehicles that wait at the end.
    pub waiting: usize,
    /// Maximum of waiting vehicles.
    pub most_waiting: usize,
    /// How long the first in the queue was blocked, and by what.
    pub held_s: HeldFor,
}

/// Times for which the first vehicle in a queue was blocked [s].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeldFor {
    /// The traffic on the lane moved, but left no gap.
    pub traffic: f64,
    /// The vehicles ahead stood, for another reason than the following ones.
    pub queue: f64,
    /// They stood because of a red light.
    pub red_light: f64,
    /// They stood because others had priority at a junction, or because of a stop sign.
    pub priority: f64,
    /// They stood because there was no storage space beyond a junction; or the space at a place inside the map was
    /// reserved for others.
    pub room: f64,
    /// Perimeter control: the whole map was full, and no trip began within it.
    pub full_map: f64,
}

impl HeldFor {
    fn of(&mut self, held: Held) -> &mut f64 {
        match held {
            Held::Traffic => &mut self.traffic,
            Held::Queue => &mut self.queue,
            Held::RedLight => &mut self.red_light,
            Held::Priority => &mut self.priority,
            Held::Space => &mut self.room,
            Held::FullMap => &mut self.full_map,
        }
    }

    /// The reasons in words with their shares of the time, the longest first.
    pub fn to_text(&self) -> String {
        let reasons = self.reasons();
        let total: f64 = reasons.iter().map(|(_, time)| time).sum();
        let shares: Vec<String> =
            reasons.iter().map(|(what, time)| format!("{what} {:.0} %", 100.0 * time / total)).collect();
        shares.join(", ")
    }

    /// The reasons in words with their times, the longest first.
    fn reasons(&self) -> Vec<(&'static str, f64)> {
        let HeldFor { traffic, queue, red_light, priority, room, full_map } = *self;
        let mut reasons = vec![
            ("no gap in the traffic", traffic),
            ("a queue ahead", queue),
            ("a red light", red_light),
            ("priority of other vehicles", priority),
            ("no storage space beyond a junction", room),
            ("perimeter control (full town)", full_map),
        ];
        reasons.retain(|(_, time)| *time > 0.0);
        reasons.sort_by(|a, b| b.1.total_cmp(&a.1));
        reasons
    }
}

impl Queues {
    /// The queues of `world`, before any vehicle was blocked.
    pub fn of(world: &World) -> Queues {
        Queues { lanes: entry_queues(world).map(|it| Queue::at(world, &it)).collect() }
    }

    /// Observes them after a step.
    pub fn observe(&mut self, world: &World) {
        let clock = world.clock();
        if !clock.step.is_multiple_of(clock.steps(SAMPLING)) {
            return;
        }
        for (lane, now) in self.lanes.iter_mut().zip(entry_queues(world)) {
            lane.most_waiting = lane.most_waiting.max(now.waiting);
            if let Some(held) = now.held {
                *lane.held_s.of(held) += f64::from(clock.steps(SAMPLING)) * clock.dt;
            }
        }
    }

    /// The queues in which vehicles wait now, the longest first.
    pub fn left(self, world: &World) -> Vec<Queue> {
        let now = self.lanes.into_iter().zip(entry_queues(world));
        let with_numbers = now.map(|(lane, now)| Queue {
            waiting: now.waiting,
            most_waiting: lane.most_waiting.max(now.waiting),
            ..lane
        });
        let mut left: Vec<Queue> = with_numbers.filter(|it| it.waiting > 0).collect();
        left.sort_by_key(|it| std::cmp::Reverse(it.waiting));
        left
    }
}

impl Queue {
    fn at(world: &World, queue: &EntryQueue) -> Queue {
        Queue {
            entrance: world.demand().origins[queue.origin].place.id(),
            lanelet: world.network().lanelet_at(Position::new(queue.chain, queue.station)).0.id,
            waiting: 0,
            most_waiting: 0,
            held_s: HeldFor::default(),
        }
    }

    /// The queue in a line of text.
    pub fn to_text(&self) -> String {
        let Queue { entrance, lanelet, waiting, held_s, .. } = self;
        let place = if entrance == lanelet {
            format!("lanelet {lanelet}")
        } else {
            format!("lanelet {lanelet} of entrance {entrance}")
        };
        format!("{waiting} at {place}; blocked by: {}", held_s.to_text())
    }
}
