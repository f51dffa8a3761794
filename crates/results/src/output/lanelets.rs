//! The tables `lanelets`, with aggregates of every lanelet over the whole run, and `flows`, with those of each
//! interval.

use std::path::PathBuf;

use laneweave_network::LaneletIndex;
use laneweave_scenario::Fault;
use laneweave_sim::{Clock, LaneletAggregate, World};
use laneweave_study::{Column, TableWriter, seconds};

use super::Output;
use super::batch::{Batch, BatchSender, Writer};
use super::folder::Folder;
use super::names::Names;
use super::traffic::Traffic;
use crate::folder::CHECKPOINT;
use crate::outcome::Summary;
use crate::pack::{pack, unpack};

/// Measures the traffic on the lanelets.
pub(super) struct Lanelets {
    /// Start time for counting lane changes [s].
    begin: f64,
    /// Length of an interval of the flows, in steps, if they are wanted.
    every: Option<u32>,
    /// The steps at which the present interval and the run end.
    until: [u32; 2],
    /// The completed intervals.
    past: Traffic,
    interval: Traffic,
    /// The traffic on the lanelets before the present interval.
    before: Vec<LaneletAggregate>,
    sender: BatchSender,
}

impl Lanelets {
    /// Measures from the step `first` to the step `last`, and in intervals of `every` steps, if they are wanted.
    pub(super) fn new(
        world: &World,
        every: Option<u32>,
        [first, last]: [u32; 2],
        sender: BatchSender,
    ) -> Lanelets {
        let begin = f64::from(first) * world.clock().dt;
        let interval = Traffic::of(world.network(), begin);
        let before = vec![LaneletAggregate::default(); world.network().lanelets.len()];
        let end = every.map_or(last, |it| (first + it).min(last));
        Lanelets { begin, every, until: [end, last], past: interval.clone(), interval, before, sender }
    }
}

impl Output for Lanelets {
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        pack(&(&self.until, &self.past, &self.interval, &self.before))
    }

    fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        let lanelets = self.before.len();
        (self.until, self.past, self.interval, self.before) = unpack(saved)?;
        let counted = [self.past.counts.len(), self.interval.counts.len(), self.before.len()];
        if counted.iter().any(|it| *it != lanelets) {
            let what = format!("it counts {counted:?} lanelets, but there are {lanelets}");
            return Err(Fault::new(CHECKPOINT, what, "run again from the beginning, without --resume"));
        }
        Ok(())
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        let Lanelets { begin, every, until: [end, last], past, interval, before, sender } = self;
        interval.observe(world, |change| change.time >= *begin);
        let Clock { step, .. } = world.clock();
        if let Some(every) = *every
            && step == *end
        {
            interval.close(world, before);
            past.add(interval);
            let next = Traffic::of(world.network(), world.clock().time());
            sender.hand_over(Batch::Flows(std::mem::replace(interval, next)))?;
            *end = (step + every).min(*last);
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>, world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        self.interval.close(world, &mut self.before);
        self.past.add(&self.interval);
        self.sender.hand_over(Batch::Lanelets(self.past))?;
        Ok(Vec::new())
    }
}

const FLOWS: [Column; 6] = [
    Column::real("from_s").repeating(),
    Column::real("to_s").repeating(),
    Column::text("lanelet"),
    Column::real("flow_veh_h"),
    Column::real("density_veh_km"),
    Column::real("speed_mps"),
];

/// Writes all lanelets after every interval. An incomplete interval has no rows.
pub(super) struct FlowTable {
    table: TableWriter,
    path: PathBuf,
}

impl FlowTable {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<FlowTable, Fault> {
        let (table, path) = folder.table("flows", &FLOWS)?;
        Ok(FlowTable { table, path })
    }
}

impl Writer for FlowTable {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        let Batch::Flows(traffic) = batch else { return Ok(()) };
        let [from, to] = traffic.during;
        for (place, [density, flow], speed) in traffic.measures(&names.network) {
            let id = names.id(LaneletIndex(place as u32));
            self.table.row(&[
                seconds(from).into(),
                seconds(to).into(),
                id.into(),
                flow.into(),
                density.into(),
                speed.into(),
            ])?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

const LANELETS: [Column; 14] = [
    Column::text("lanelet"),
    Column::text("sumo_lane"),
    Column::real("length_m"),
    Column::integer("vehicles"),
    Column::real("flow_veh_h"),
    Column::real("density_veh_km"),
    Column::real("speed_mps"),
    Column::real("standing_s"),
    Column::integer("entered"),
    Column::integer("completed"),
    Column::integer("changes_to_left"),
    Column::integer("changes_to_right"),
    Column::integer("changes_from_left"),
    Column::integer("changes_from_right"),
];

/// Writes all lanelets at the end of the run.
pub(super) struct LaneletTable {
    table: TableWriter,
    path: PathBuf,
}

impl LaneletTable {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<LaneletTable, Fault> {
        let (table, path) = folder.table("lanelets", &LANELETS)?;
        Ok(LaneletTable { table, path })
    }
}

impl Writer for LaneletTable {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        let Batch::Lanelets(traffic) = batch else { return Ok(()) };
        for (place, [density, flow], speed) in traffic.measures(&names.network) {
            let (lanelet, counts) = (LaneletIndex(place as u32), &traffic.counts[place]);
            // A vehicle that changes to the left comes from the right.
            let ([to_left, to_right], [from_right, from_left]) = (counts.away, counts.onto);
            self.table.row(&[
                names.id(lanelet).into(),
                names.lanes.name(lanelet).into(),
                names.network.lanelets[place].length().into(),
                counts.stay.passed.into(),
                flow.into(),
                density.into(),
                speed.into(),
                seconds(counts.stay.standing).into(),
                counts.begun.into(),
                counts.ended.into(),
                to_left.into(),
                to_right.into(),
                from_left.into(),
                from_right.into(),
            ])?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}
