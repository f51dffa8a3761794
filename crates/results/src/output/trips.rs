//! Every trip from its origin to its end: the table `trips`.

use std::path::PathBuf;

use laneweave_network::Position;
use laneweave_scenario::Fault;
use laneweave_sim::{Event, World};
use laneweave_study::{Cell, Column, TableWriter, seconds};

use super::Output;
use super::batch::{Batch, BatchSender, Writer};
use super::folder::Folder;
use super::names::Names;
use super::trip::{End, Trip};
use crate::outcome::Summary;

/// Trips in a batch; those of one step more at most.
const BATCH: usize = 256;

/// Collects trips when they end.
pub(super) struct Trips {
    ended: Vec<Trip>,
    sender: BatchSender,
}

impl Trips {
    pub(super) fn new(sender: BatchSender) -> Trips {
        Trips { ended: Vec::new(), sender }
    }
}

impl Output for Trips {
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        self.sender.hand_over(Batch::Trips(std::mem::take(&mut self.ended)))?;
        Ok(Vec::new())
    }

    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        for event in world.events() {
            if let Event::Left { duration, chain, motion, trip: Some(record), .. } = event {
                // The last step may end beyond the road.
                let x = motion.x.min(world.network().chain(*chain).length);
                let (time, at) = (world.clock().time(), Position::new(*chain, x));
                let end = End { time, duration: *duration, at, speed: motion.speed };
                self.ended.push(Trip { record: *record, way: record.way(x), end: Some(end) });
            }
        }
        if self.ended.len() < BATCH {
            return Ok(());
        }
        self.sender.hand_over(Batch::Trips(std::mem::take(&mut self.ended)))
    }

    /// Vehicles on the road come last, in the order of their ids.
    fn finish(mut self: Box<Self>, world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        let on_road = world.vehicles().filter_map(|vehicle| {
            let mut record = *world.trip(vehicle.id())?;
            record.stood += f64::from(vehicle.driver.standing);
            Some(Trip { record, way: record.way(vehicle.x()), end: None })
        });
        let mut on_road: Vec<Trip> = on_road.collect();
        on_road.sort_unstable_by_key(|it| it.record.vehicle);
        self.ended.append(&mut on_road);
        self.sender.hand_over(Batch::Trips(self.ended))?;
        Ok(Vec::new())
    }
}

static COLUMNS: [Column; 21] = [
    Column::integer("vehicle"),
    Column::text("class"),
    Column::text("style"),
    Column::text("origin"),
    Column::text("destination"),
    Column::text("from_lanelet"),
    Column::text("to_lanelet"),
    Column::real("arrived_s"),
    Column::real("entered_s"),
    Column::real("completed_s"),
    Column::real("insertion_delay_s"),
    Column::real("duration_s"),
    Column::real("free_s"),
    Column::real("delay_s"),
    Column::real("length_m"),
    Column::integer("stops"),
    Column::real("standing_s"),
    Column::integer("lane_changes"),
    Column::integer("route_changes"),
    Column::integer("missed_turns"),
    Column::text("name"),
];

/// Writes a row for each trip.
pub(super) struct TripTable {
    table: TableWriter,
    path: PathBuf,
}

impl TripTable {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<TripTable, Fault> {
        let (table, path) = folder.table("trips", &COLUMNS)?;
        Ok(TripTable { table, path })
    }
}

impl Writer for TripTable {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        if let Batch::Trips(trips) = batch {
            for trip in trips {
                self.table.row(&row(trip, names))?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

fn row<'a>(trip: &Trip, names: &'a Names) -> [Cell<'a>; COLUMNS.len()] {
    let Trip { record, way, end } = trip;
    [
        record.vehicle.into(),
        record.class.body().name.into(),
        names.style(record.parameters).into(),
        names.origin(record.origin).into(),
        names.destination(record.destination).into(),
        names.id_at(record.from).into(),
        end.map(|it| names.id_at(it.at)).into(),
        seconds(record.arrived).into(),
        seconds(record.entered).into(),
        end.map(|it| seconds(it.time)).into(),
        seconds(trip.waiting()).into(),
        end.map(|it| seconds(it.duration)).into(),
        record.free_time.into(),
        trip.delay().into(),
        (*way).into(),
        record.stops.into(),
        seconds(record.stood).into(),
        record.lane_changes.into(),
        record.route_changes.into(),
        record.missed_turns.into(),
        names.vehicle(record.vehicle).into(),
    ]
}
