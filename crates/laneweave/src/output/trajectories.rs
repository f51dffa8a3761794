//! Where every vehicle was: the table `trajectories`.

use std::path::PathBuf;

use laneweave_sim::Phase;
use laneweave_study::{Cell, Column, TableWriter};

use super::Folder;
use super::frame::{Body, Seen};
use super::names::Names;
use super::scribe::{Page, Writer};
use crate::fault::Fault;

/// Columns of the table.
const COLUMNS: [Column; 16] = [
    Column::real("time_s").repeating(),
    Column::integer("vehicle"),
    Column::text("class"),
    Column::text("style"),
    Column::integer("lanelet"),
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

/// Writes a row for each vehicle at each instant.
pub(super) struct Trajectories {
    table: TableWriter,
    path: PathBuf,
}

impl Trajectories {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<Trajectories, Fault> {
        let (table, path) = folder.table("trajectories", &COLUMNS)?;
        Ok(Trajectories { table, path })
    }
}

impl Writer for Trajectories {
    fn write(&mut self, page: &Page, names: &Names) -> Result<(), Fault> {
        let Page::Frame(frame) = page else { return Ok(()) };
        for (step, seen, bodies) in frame.instants() {
            let time = f64::from(step) * names.step_s;
            for (seen, body) in seen.iter().zip(bodies) {
                self.table.row(&row(time, seen, body, names))?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

fn row<'a>(time: f64, seen: &Seen, body: &Body, names: &'a Names) -> [Cell<'a>; COLUMNS.len()] {
    let Seen { motion, class, .. } = seen;
    let Body { lanelet, along, offset, pose, .. } = body;
    let class = class.body();
    [
        time.into(),
        motion.id.into(),
        class.name.into(),
        names.style(seen.character).into(),
        names.network.lanelets[lanelet.at()].id.into(),
        (*along).into(),
        (*offset).into(),
        pose.at.x.into(),
        pose.at.y.into(),
        pose.at.z.into(),
        pose.heading.into(),
        motion.speed.into(),
        f64::from(motion.acceleration).into(),
        class.length.into(),
        class.width.into(),
        state(seen.phase).into(),
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
