//! The figure `time_space.svg`: the vehicles of one lane, from the slow side of the busiest entrance on.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use laneweave_network::{ChainIndex, Gate, Network};
use laneweave_sim::{Event, Place, VehicleId, World};
use laneweave_study::{Mark, Sample, time_space};

use super::road::Road;
use super::{Observer, write_whole};
use crate::fault::Fault;

/// Longest road that is drawn [m].
const LONGEST_ROAD: f64 = 10_000.0;
/// Longest time that is drawn [s]; of longer runs the end is left out.
const LONGEST_TIME: f64 = 3600.0;
/// Time between two samples [s].
const SAMPLING: f64 = 1.0;

/// Collects the vehicles of one lane.
pub(super) struct TimeSpace {
    path: PathBuf,
    title: String,
    road: Option<Road>,
    begin: f64,
    end: f64,
    /// The trajectories of the vehicles that are on the lane now.
    current: BTreeMap<VehicleId, Vec<Sample>>,
    /// Those of vehicles that left it.
    past: Vec<Vec<Sample>>,
    changes: Vec<Mark>,
}

impl TimeSpace {
    /// For the figure in `dir`, over at most `duration` [s] from the time `begin` [s] on; `origins`, each with its
    /// demand [veh/h], tell the busiest entrance.
    pub(super) fn new(
        dir: &Path,
        world: &World,
        origins: &[(Place, f64)],
        begin: f64,
        duration: f64,
    ) -> TimeSpace {
        let network = world.network();
        let busiest = origins.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let start = busiest.and_then(|(place, _)| match place {
            Place::Gate(gate) => slow_lane(network, gate),
            Place::Kerb(kerb) => Some(kerb.chain),
        });
        let lanelet = start.map_or(0, |chain| network.lanelet_at(chain, 0.0).0.id);
        TimeSpace {
            path: dir.join("time_space.svg"),
            title: format!("The lane from lanelet {lanelet} on"),
            road: start.map(|chain| Road::from(network, chain, LONGEST_ROAD)),
            begin,
            end: begin + duration.min(LONGEST_TIME),
            current: BTreeMap::new(),
            past: Vec::new(),
            changes: Vec::new(),
        }
    }

    fn sample(&mut self, world: &World, road: &Road) {
        let time_s = world.clock().time();
        let mut before = std::mem::take(&mut self.current);
        let scene = world.scene();
        for (chain, from, offset) in road.pieces() {
            let entries = scene.motions(chain).iter().zip(scene.cars(chain));
            for (it, _) in entries.filter(|(it, car)| !car.is_shadow && it.x >= from) {
                let mut trajectory = before.remove(&it.id).unwrap_or_default();
                trajectory.push(Sample { time_s, position_m: offset + it.x, speed_mps: it.speed });
                self.current.insert(it.id, trajectory);
            }
        }
        self.past.extend(before.into_values());
    }
}

/// The gate's lane on the slow side; not one that ends, as long as there is another.
fn slow_lane(network: &Network, gate: &Gate) -> Option<ChainIndex> {
    let slow = network.driving_side.overtaking().opposite();
    let goes_on = |chain: ChainIndex| !network.chain(chain).is_lane_drop;
    let is_slowest = |chain: ChainIndex| {
        network.chain(chain).beside(slow, 0.0).is_none_or(|beside| !goes_on(beside.chain))
    };
    let mut lanes = gate.chains.iter().copied();
    lanes.find(|it| goes_on(*it) && is_slowest(*it)).or(gate.chains.first().copied())
}

impl Observer for TimeSpace {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        let Some(road) = self.road.take() else { return Ok(()) };
        let clock = world.clock();
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.is_completed
                && (self.begin..=self.end).contains(&change.time)
            {
                let places = [change.from, change.to].map(|(chain, x)| road.position(chain, x));
                let mark = |position_m| Mark { time_s: change.time, position_m };
                self.changes.extend(places.into_iter().flatten().take(1).map(mark));
            }
        }
        if clock.step.is_multiple_of(clock.steps(SAMPLING)) && clock.time() <= self.end {
            self.sample(world, &road);
        }
        self.road = Some(road);
        Ok(())
    }

    fn finish(self: Box<Self>, _world: &World) -> Result<Vec<PathBuf>, Fault> {
        let TimeSpace { path, title, current, mut past, changes, .. } = *self;
        past.extend(current.into_values());
        write_whole(&path, &time_space(&title, &past, &changes))?;
        Ok(vec![path])
    }
}
