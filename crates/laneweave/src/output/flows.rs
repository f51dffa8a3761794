//! Density, flow and speed on every lanelet in every interval: the table `flows`.
//!
//! Edie's generalised definitions (`laneweave_study::edie`), with the time and the way of every vehicle in every step; who
//! passes from one lanelet to the next is shared between them as at constant speed.

use std::path::{Path, PathBuf};

use laneweave_network::{Chain, ChainIndex, LaneletIndex, Network};
use laneweave_sim::{Clock, Event, Motion, World};
use laneweave_study::{Column, EdieGrid, Format, TableWriter, Window};

use super::{Observer, table_path};
use crate::fault::Fault;

const COLUMNS: [Column; 6] = [
    Column::real("from_s"),
    Column::real("to_s"),
    Column::integer("lanelet"),
    Column::real("flow_veh_h"),
    Column::real("density_veh_km"),
    Column::real("speed_mps"),
];

/// Writes all lanelets after every interval. Of an interval that was broken off there are no rows.
pub struct Flows {
    table: TableWriter,
    path: PathBuf,
    /// Length of an interval, in steps.
    every: u32,
    /// The step with which measuring ends.
    last: u32,
    /// The current one, as long as it is measured.
    interval: Option<Interval>,
}

impl Flows {
    /// Begins the table in `dir`, of intervals of `every` steps from the step `first` to the step `last`.
    ///
    /// # Errors
    /// If the file cannot be created.
    pub fn create(
        dir: &Path,
        format: Format,
        world: &World,
        every: u32,
        [first, last]: [u32; 2],
    ) -> Result<Flows, Fault> {
        let path = table_path(dir, "flows", format);
        let table = TableWriter::create(&path, format, &COLUMNS)?;
        let interval = Interval::new(world, [first, (first + every).min(last)]);
        Ok(Flows { table, path, every, last, interval })
    }
}

impl Observer for Flows {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        let Some(interval) = &mut self.interval else { return Ok(()) };
        interval.observe(world);
        let [_, until] = interval.steps;
        if world.clock().step == until {
            interval.write(world, &mut self.table)?;
            self.interval = Interval::new(world, [until, (until + self.every).min(self.last)]);
        }
        Ok(())
    }

    fn finish(self: Box<Self>, _world: &World) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

/// What happens on the lanelets between two steps.
struct Interval {
    steps: [u32; 2],
    grid: EdieGrid,
}

impl Interval {
    /// None without a duration.
    fn new(world: &World, steps: [u32; 2]) -> Option<Interval> {
        let lengths = world.network().lanelets.iter().map(|it| it.length()).collect();
        let [from_s, until] = steps.map(|it| f64::from(it) * world.clock().dt);
        let window = Window { from_s, interval_s: until - from_s, intervals: 1 };
        Some(Interval { steps, grid: EdieGrid::new(lengths, window).ok()? })
    }

    /// Adds what all did in the last step.
    fn observe(&mut self, world: &World) {
        let (network, clock) = (world.network(), world.clock());
        // Who has just entered has not driven yet.
        for vehicle in world.vehicles().filter(|it| it.mind.entered < clock.step) {
            let way = last_way(vehicle.motion, clock.dt);
            let add = |lanelet, part| self.add(clock, lanelet, part, way[1] - way[0]);
            along(network, vehicle.spot.chain, vehicle.mind.trail.last(), way, add);
        }
        for event in world.events() {
            if let Event::Left { chain, motion, .. } = event {
                let [from, to] = last_way(motion, clock.dt);
                let on_road = [from, to.min(network.chain(*chain).length)];
                along(network, *chain, None, on_road, |lanelet, part| {
                    self.add(clock, lanelet, part, to - from)
                });
            }
        }
    }

    /// Adds the `part` on one lanelet of the way that a vehicle drove in the last step [m].
    fn add(&mut self, clock: Clock, lanelet: LaneletIndex, part: f64, way: f64) {
        // Who stands is in one place for all of the step.
        let share = if way > 0.0 { part / way } else { 1.0 };
        self.grid.add(lanelet.at(), clock.time() - clock.dt, share * clock.dt, part);
    }

    fn write(&self, world: &World, table: &mut TableWriter) -> Result<(), Fault> {
        let [from, to] = self.steps.map(|it| f64::from(it) * world.clock().dt);
        for (row, lanelet) in self.grid.rows().zip(&world.network().lanelets) {
            let (flow, density) = (row.flow_veh_per_h, row.density_veh_per_km);
            let lanelet = lanelet.id.into();
            table.row(&[
                from.into(),
                to.into(),
                lanelet,
                flow.into(),
                density.into(),
                row.speed_mps.into(),
            ])?;
        }
        Ok(())
    }
}

/// From where to where a vehicle drove in its last step along its chain [m]; its speed changed evenly.
fn last_way(motion: &Motion, dt: f64) -> [f64; 2] {
    let driven = (motion.speed - 0.5 * f64::from(motion.acceleration) * dt) * dt;
    [motion.x - driven, motion.x]
}

/// Visits the lanelets between two stations of `chain` with the way on each [m]. What lies before its start is on the chain
/// `before`, if there is one, or else on its first lanelet.
fn along(
    network: &Network,
    chain: ChainIndex,
    before: Option<ChainIndex>,
    [from, to]: [f64; 2],
    mut visit: impl FnMut(LaneletIndex, f64),
) {
    let Chain { lanelets, starts, .. } = network.chain(chain);
    let beyond = starts.partition_point(|it| *it <= to);
    let mut end = to;
    for (lanelet, start) in lanelets[..beyond].iter().zip(&starts[..beyond]).rev() {
        let is_first = *start == 0.0 && before.is_none();
        if from >= *start || is_first {
            return visit(*lanelet, end - from);
        }
        visit(*lanelet, end - start);
        end = *start;
    }
    if let Some(before) = before {
        let length = network.chain(before).length;
        along(network, before, None, [length + from, length], visit);
    }
}

#[cfg(test)]
mod tests {
    use laneweave_maps::generate::{Motorway, motorway};

    use super::*;

    /// The ways on lanelets, by their ids, between two stations of a chain that follows on another.
    fn ways(before: Option<ChainIndex>, way: [f64; 2]) -> Vec<(i64, f64)> {
        // Each lane is one chain of five lanelets of 100 m, numbered row by row from the slow lane on.
        let plan = Motorway { lanes: 2, length_m: 500.0, ..Motorway::default() };
        let network = motorway(&plan).unwrap().build().unwrap().network;
        let mut ways = Vec::new();
        along(&network, ChainIndex(0), before, way, |lanelet, way| {
            ways.push((network.lanelets[lanelet.at()].id, (way * 1e6).round() / 1e6));
        });
        ways
    }

    #[test]
    fn a_way_is_shared_by_the_lanelets_that_it_leads_over() {
        assert_eq!(ways(None, [20.0, 50.0]), [(1, 30.0)]);
        assert_eq!(ways(None, [99.0, 101.5]), [(3, 1.5), (1, 1.0)]);
        assert_eq!(ways(None, [90.0, 310.0]), [(7, 10.0), (5, 100.0), (3, 100.0), (1, 10.0)]);
        // What reaches beyond the end is not lost.
        assert_eq!(ways(None, [499.0, 503.0]), [(9, 4.0)]);
    }

    #[test]
    fn a_way_that_begins_on_the_chain_before_is_shared_with_its_last_lanelet() {
        assert_eq!(ways(Some(ChainIndex(1)), [-2.0, 1.0]), [(1, 1.0), (10, 2.0)]);
        assert_eq!(ways(None, [-2.0, 1.0]), [(1, 3.0)]);
    }
}
