//! The table `trajectories`: the positions of all vehicles.

use std::path::PathBuf;

use laneweave_scenario::Fault;
use laneweave_sim::{Class, Phase};
use laneweave_study::{Cells, Column, TableWriter, seconds};

use super::batch::{Batch, Writer};
use super::folder::Folder;
use super::names::Names;

/// Columns of the table.
const COLUMNS: [Column; 16] = [
    Column::real("time_s").repeating(),
    Column::integer("vehicle"),
    Column::text("class"),
    Column::text("style"),
    Column::text("lanelet"),
    Column::real("position_m"),
    Column::real("offset_m").repeating(),
    Column::real("x_m"),
    Column::real("y_m"),
    Column::real("z_m").repeating(),
    Column::real("heading_rad"),
    Column::real("speed_mps"),
    Column::real("acceleration_mps2"),
    Column::real("length_m").repeating(),
    Column::real("width_m").repeating(),
    Column::text("state"),
];

/// The names of the phases, in their order.
const STATES: [&str; 4] = ["cruises", "wants", "changes", "aborts"];

const _: () = assert!(Phase::Wants as u32 == 1 && Phase::Changes as u32 == 2 && Phase::Aborts as u32 == 3);

/// Writes a row for each vehicle at each instant.
pub(super) struct Trajectories {
    table: TableWriter,
    path: PathBuf,
    /// Buffers for the columns of numbers, and for that of integers.
    numbers: [Vec<f64>; 11],
    vehicle: Vec<i64>,
    /// Buffers for those of texts, by their indices in lists.
    places: [Vec<u32>; 4],
}

impl Trajectories {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<Trajectories, Fault> {
        let (table, path) = folder.table("trajectories", &COLUMNS)?;
        let (numbers, vehicle, places) = Default::default();
        Ok(Trajectories { table, path, numbers, vehicle, places })
    }
}

impl Writer for Trajectories {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        let Batch::Frame(frame) = batch else { return Ok(()) };
        let (seen, bodies) = (frame.seen(), frame.bodies());
        let Trajectories { table, numbers, vehicle, places, .. } = self;
        numbers.iter_mut().for_each(|it| empty(it, seen.len()));
        let [time, along, offset, x, y, z, heading, speed, acceleration, length, width] = numbers;
        for (step, here, _) in frame.instants() {
            time.resize(time.len() + here.len(), seconds(f64::from(step) * names.step_s));
        }
        along.extend(bodies.iter().map(|it| it.along));
        offset.extend(bodies.iter().map(|it| it.offset));
        x.extend(bodies.iter().map(|it| it.pose.at.x));
        y.extend(bodies.iter().map(|it| it.pose.at.y));
        z.extend(bodies.iter().map(|it| it.pose.at.z));
        heading.extend(bodies.iter().map(|it| it.pose.heading));
        speed.extend(seen.iter().map(|it| it.motion.speed));
        acceleration.extend(seen.iter().map(|it| f64::from(it.motion.acceleration)));
        length.extend(bodies.iter().map(|it| it.size[0]));
        width.extend(bodies.iter().map(|it| it.size[1]));
        empty(vehicle, seen.len());
        vehicle.extend(seen.iter().map(|it| i64::from(it.motion.id)));
        places.iter_mut().for_each(|it| empty(it, seen.len()));
        let [class, style, lanelet, state] = places;
        class.extend(seen.iter().map(|it| it.class as u32));
        style.extend(seen.iter().map(|it| it.parameters));
        lanelet.extend(bodies.iter().map(|it| it.lanelet.0));
        state.extend(seen.iter().map(|it| it.phase as u32));
        let (styles, lanelets): (Vec<&str>, Vec<&str>) = (names.styles().collect(), names.ids().collect());
        let classes = Class::ALL.map(|it| it.body().name);
        table.rows(&[
            Cells::F64(time),
            Cells::I64(vehicle),
            Cells::Text(class, &classes),
            Cells::Text(style, &styles),
            Cells::Text(lanelet, &lanelets),
            Cells::F64(along),
            Cells::F64(offset),
            Cells::F64(x),
            Cells::F64(y),
            Cells::F64(z),
            Cells::F64(heading),
            Cells::F64(speed),
            Cells::F64(acceleration),
            Cells::F64(length),
            Cells::F64(width),
            Cells::Text(state, &STATES),
        ])?;
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

/// Empties `values`, and reserves space for so many.
fn empty<T>(values: &mut Vec<T>, room: usize) {
    values.clear();
    values.reserve_exact(room);
}
