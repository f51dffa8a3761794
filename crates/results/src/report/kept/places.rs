//! Where something happened on the map: lane changes, incidents, and vehicles that waited to enter.

use laneweave_network::{Id, Network, Point, Position};
use laneweave_sim::{Event, IncidentKind, LaneChangeKind, World, entry_queue_lengths};
use serde::{Deserialize, Serialize};

/// Time between two looks at the queues [s].
const SAMPLING: f64 = 1.0;
/// Maximum of places of a kind: beyond it, every second one is removed.
const MOST: usize = 800;

/// Number of kinds of lane changes, and of incidents.
const KINDS: usize = LaneChangeKind::ALL.len();
const INCIDENTS: usize = 2;

/// Notes where something happened.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Places {
    begin: f64,
    changes: [Sparse; KINDS],
    incidents: [Sparse; INCIDENTS],
    /// The lanes of the entrances, in the order of the demand.
    pub(crate) entrances: Vec<EntranceLane>,
}

/// A place at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Spotted {
    /// The id of the lanelet.
    pub(crate) lanelet: Id,
    /// East and north [m].
    pub(crate) at: [f64; 2],
    /// When [s].
    pub(crate) time: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct EntranceLane {
    /// The id of the lanelet.
    pub(crate) lanelet: Id,
    /// East and north [m].
    pub(crate) at: [f64; 2],
    /// Maximum of vehicles that waited there to enter.
    pub(crate) most_waiting: usize,
}

/// Places of a kind: all of them, or every second, fourth … one.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Sparse {
    /// One in so many is kept.
    pub(crate) every: u64,
    /// The number of all.
    pub(crate) total: u64,
    /// Those that are kept, in order of time.
    pub(crate) kept: Vec<Spotted>,
}

impl Default for Sparse {
    /// No places yet.
    fn default() -> Sparse {
        Sparse { every: 1, total: 0, kept: Vec::new() }
    }
}

impl Sparse {
    fn add(&mut self, it: Spotted) {
        if self.total.is_multiple_of(self.every) {
            self.kept.push(it);
        }
        self.total += 1;
        if self.kept.len() > MOST {
            self.every *= 2;
            let mut number = 0;
            self.kept.retain(|_| {
                number += 1;
                number % 2 == 1
            });
        }
    }
}

impl Places {
    /// Notes what happens from the time `begin` [s] on.
    pub(crate) fn new(world: &World, begin: f64) -> Places {
        let network = world.network();
        let entrance = |(at, _): (Position, usize)| EntranceLane {
            lanelet: network.lanelet_at(at).0.id,
            at: in_plan(&on_map(network, at)),
            most_waiting: 0,
        };
        Places {
            begin,
            changes: Default::default(),
            incidents: Default::default(),
            entrances: entry_queue_lengths(world).map(entrance).collect(),
        }
    }

    /// Whether it goes on from `new`, which has seen nothing: the same entrances.
    pub(super) fn fits(&self, new: &Places) -> bool {
        let lanes = |it| {
            let Places { entrances, .. }: &Places = it;
            entrances.iter().map(|it| (it.lanelet, it.at))
        };
        self.begin == new.begin
            && lanes(self).eq(lanes(new))
            && self.changes.iter().chain(&self.incidents).all(|it| it.every > 0 && it.kept.len() <= MOST)
    }

    /// Observes the world after a step.
    pub(crate) fn observe(&mut self, world: &World) {
        let network = world.network();
        for event in world.events() {
            match event {
                Event::LaneChange(it) if it.is_completed && it.time >= self.begin => {
                    // On the line between the lanes.
                    let at = on_map(network, it.from).midpoint(&on_map(network, it.to));
                    self.changes[number(it.kind)].add(spotted(network, it.from, at, it.time));
                }
                Event::Incident(it) if it.time >= self.begin => {
                    self.incidents[it.kind as usize].add(spotted(network, it.places[0], it.at, it.time));
                }
                _ => {}
            }
        }
        let clock = world.clock();
        if clock.step.is_multiple_of(clock.steps(SAMPLING)) {
            for (lane, (_, waiting)) in self.entrances.iter_mut().zip(entry_queue_lengths(world)) {
                lane.most_waiting = lane.most_waiting.max(waiting);
            }
        }
    }

    /// Completed lane changes of a kind.
    pub(crate) fn changes(&self, kind: LaneChangeKind) -> &Sparse {
        &self.changes[number(kind)]
    }

    /// Incidents of a kind.
    pub(crate) fn incidents(&self, kind: IncidentKind) -> &Sparse {
        &self.incidents[kind as usize]
    }
}

/// Something at a place.
fn spotted(network: &Network, on: Position, at: Point, time: f64) -> Spotted {
    Spotted { lanelet: network.lanelet_at(on).0.id, at: in_plan(&at), time }
}

/// The place of a position on the map.
fn on_map(network: &Network, at: Position) -> Point {
    network.chain(at.chain).centre.at(at.x)
}

/// A point as it is seen from above [m].
pub(crate) fn in_plan(point: &Point) -> [f64; 2] {
    [point.x, point.y]
}

/// The number of a kind.
fn number(kind: LaneChangeKind) -> usize {
    LaneChangeKind::ALL.iter().position(|it| *it == kind).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_too_many_places_every_second_one_is_kept_and_fewer_follow() {
        let mut places = Sparse::default();
        let at =
            |number: usize| Spotted { lanelet: (number as i64).into(), at: [0.0; 2], time: number as f64 };
        (0..=MOST + 3).for_each(|it| places.add(at(it)));
        let kept: Vec<Id> = places.kept.iter().map(|it| it.lanelet).collect();
        assert_eq!((places.every, places.total), (2, MOST as u64 + 4));
        let expected: Vec<i64> = (0..=MOST as i64 + 3).step_by(2).collect();
        assert_eq!(kept, expected);
    }
}
