//! Where every vehicle was: the table `trajectories`.

use std::path::{Path, PathBuf};

use laneweave_sim::{Phase, Vehicle, World};
use laneweave_study::{Cell, Column, Format, TableWriter};

use super::{Observer, table_path};
use crate::fault::Fault;

/// Columns of the table.
const COLUMNS: [Column; 16] = [
    Column::real("time_s"),
    Column::integer("vehicle"),
    Column::text("class"),
    Column::text("style"),
    Column::integer("lanelet"),
    Column::real("position_m"),
    Column::real("offset_m"),
    Column::real("x_m"),
    Column::real("y_m"),
    Column::real("z_m"),
    Column::real("heading_rad"),
    Column::real("speed_mps"),
    Column::real("acceleration_mps2"),
    Column::real("length_m"),
    Column::real("width_m"),
    Column::text("state"),
];

/// Writes all vehicles every few steps.
pub struct Trajectories {
    table: TableWriter,
    path: PathBuf,
    every: u32,
}

impl Trajectories {
    /// Begins the table in `dir`, of every `every`-th step.
    ///
    /// # Errors
    /// If the file cannot be created.
    pub fn create(dir: &Path, format: Format, every: u32) -> Result<Trajectories, Fault> {
        let path = table_path(dir, "trajectories", format);
        Ok(Trajectories { table: TableWriter::create(&path, format, &COLUMNS)?, path, every })
    }
}

impl Observer for Trajectories {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        if world.clock().step.is_multiple_of(self.every) {
            for vehicle in world.vehicles() {
                self.table.row(&row(world, &vehicle))?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>, _world: &World) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

fn row<'a>(world: &World, vehicle: &'a Vehicle<'a>) -> [Cell<'a>; COLUMNS.len()] {
    let Vehicle { motion, car, spot, .. } = vehicle;
    let (lanelet, position) = world.network().lanelet_at(spot.chain, motion.x);
    let pose = vehicle.pose();
    let body = car.class.body();
    [
        world.clock().time().into(),
        motion.id.into(),
        body.name.into(),
        vehicle.style().name.as_str().into(),
        lanelet.id.into(),
        position.into(),
        vehicle.lateral_offset().into(),
        pose.at.x.into(),
        pose.at.y.into(),
        pose.at.z.into(),
        pose.heading.into(),
        motion.speed.into(),
        f64::from(motion.acceleration).into(),
        body.length.into(),
        body.width.into(),
        state(car.phase).into(),
    ]
}

fn state(phase: Phase) -> &'static str {
    match phase {
        Phase::Cruises => "cruises",
        Phase::Wants => "wants",
        Phase::Changes => "changes",
        Phase::Aborts => "aborts",
    }
}
