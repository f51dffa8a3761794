//! The vehicles of one lane, from an entrance on: their trajectories and lane changes.

use std::collections::BTreeMap;

use laneweave_network::{ChainIndex, Gate, Id, Network, Position};
use laneweave_sim::{Event, Place, VehicleId, World};
use laneweave_study::{Mark, Sample};
use serde::{Deserialize, Serialize};

use super::road::Road;

/// Maximum length of a road in a figure [m].
const LONGEST_ROAD: f64 = 10_000.0;
/// Maximum time in a figure [s]; the end of longer runs is left out.
const LONGEST_TIME: f64 = 3600.0;
/// Minimum time between two samples [s], and maximum of samples of a vehicle: a figure is no finer.
const SAMPLING: f64 = 1.0;
const MOST_SAMPLES: f64 = 600.0;

/// Collects the vehicles of one lane.
#[derive(Debug, Serialize, Deserialize)]
pub struct Traces {
    /// The lanelet with which the lane begins.
    pub lanelet: Id,
    road: Road,
    begin: f64,
    end: f64,
    /// Time between two samples [s].
    sampling: f64,
    /// The trajectories of the vehicles that are on the lane now.
    current: BTreeMap<VehicleId, Vec<Sample>>,
    /// Those of vehicles that left it.
    past: Vec<Vec<Sample>>,
    /// The lane changes onto it and off it.
    pub changes: Vec<Mark>,
}

impl Traces {
    /// Up to `number` slow lanes from the `origins` that have no part in common, those with the largest expected
    /// distance driven first.
    pub fn most_driven(
        number: usize,
        world: &World,
        origins: &[(Place, f64)],
        begin: f64,
        duration: f64,
    ) -> Vec<Traces> {
        /// Of more origins only those with the largest demand are used.
        const LOOKED_AT: usize = 100;
        let mut origins: Vec<&(Place, f64)> = origins.iter().collect();
        origins.sort_by(|a, b| b.1.total_cmp(&a.1));
        let course = |(place, rate): &&(Place, f64)| Some((Course::from(world, place)?, *rate));
        let mut courses: Vec<(Course, f64)> = origins.iter().take(LOOKED_AT).filter_map(course).collect();
        let way = |(course, rate): &(Course, f64)| rate * course.road.length(world.network());
        courses.sort_by(|a, b| way(b).total_cmp(&way(a)));
        let mut chosen: Vec<Course> = Vec::new();
        for (course, _) in courses {
            if chosen.len() < number && chosen.iter().all(|it| !it.road.meets(&course.road)) {
                chosen.push(course);
            }
        }
        chosen.into_iter().map(|it| Traces::on(it, begin, duration)).collect()
    }

    fn on(Course { lanelet, road }: Course, begin: f64, duration: f64) -> Traces {
        let duration = duration.min(LONGEST_TIME);
        Traces {
            lanelet,
            road,
            begin,
            end: begin + duration,
            sampling: (duration / MOST_SAMPLES).ceil().max(SAMPLING),
            current: BTreeMap::new(),
            past: Vec::new(),
            changes: Vec::new(),
        }
    }

    /// Whether it goes on from `new`, which has seen nothing: the same lane at the same time.
    pub fn fits(&self, new: &Traces) -> bool {
        let times = |it: &Traces| [it.begin, it.end, it.sampling];
        (self.lanelet, &self.road, times(self)) == (new.lanelet, &new.road, times(new))
    }

    /// Observes the world after a step.
    pub fn observe(&mut self, world: &World) {
        let clock = world.clock();
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.is_completed
                && (self.begin..=self.end).contains(&change.time)
            {
                let places = [change.from, change.to].map(|it| self.road.position(it));
                let mark = |position_m| Mark { time_s: change.time, position_m };
                self.changes.extend(places.into_iter().flatten().take(1).map(mark));
            }
        }
        if clock.step.is_multiple_of(clock.steps(self.sampling)) && clock.time() <= self.end {
            self.sample(world);
        }
    }

    fn sample(&mut self, world: &World) {
        let time_s = world.clock().time();
        let scene = world.scene();
        for (chain, from, offset) in self.road.pieces() {
            let entries = scene.motions(chain).iter().zip(scene.drivers(chain));
            for (it, _) in entries.filter(|(it, car)| !car.is_shadow && it.x >= from) {
                let sample = Sample { time_s, position_m: offset + it.x, speed_mps: it.speed };
                self.current.entry(it.id).or_default().push(sample);
            }
        }
        let has_left = |samples: &Vec<Sample>| samples.last().is_none_or(|it| it.time_s < time_s);
        self.past.extend(self.current.extract_if(.., |_, it| has_left(it)).map(|(_, samples)| samples));
    }

    /// All trajectories so far, the completed ones first.
    pub fn trajectories(&self) -> impl Iterator<Item = &[Sample]> {
        self.past.iter().chain(self.current.values()).map(Vec::as_slice)
    }
}

/// A lane from an origin on.
struct Course {
    lanelet: Id,
    road: Road,
}

impl Course {
    fn from(world: &World, place: &Place) -> Option<Course> {
        let network = world.network();
        let chain = match place {
            Place::Gate(gate) => slow_lane(network, gate)?,
            Place::Inside(inner) => inner.chain,
            Place::Across(section) => section.lanes().next()?.chain,
        };
        let lanelet = network.lanelet_at(Position::new(chain, 0.0)).0.id;
        Some(Course { lanelet, road: Road::from(network, chain, LONGEST_ROAD) })
    }
}

/// The gate's lane on the slow side; if possible one that does not end.
fn slow_lane(network: &Network, gate: &Gate) -> Option<ChainIndex> {
    let slow = network.driving_side.overtaking().opposite();
    let goes_on = |chain: ChainIndex| !network.chain(chain).is_lane_drop();
    let is_slowest = |chain: ChainIndex| {
        network.chain(chain).beside(slow, 0.0).is_none_or(|beside| !goes_on(beside.chain))
    };
    let mut lanes = gate.chains.iter().copied();
    lanes.find(|it| goes_on(*it) && is_slowest(*it)).or(gate.chains.first().copied())
}
