//! Every collision and overlap: the table `incidents`.

use std::path::PathBuf;

use laneweave_network::Point;
use laneweave_scenario::Fault;
use laneweave_sim::{Event, Incident, World};
use laneweave_study::{Cell, Column, TableWriter, seconds};

use super::Output;
use super::batch::{Batch, BatchSender, Writer};
use super::folder::Folder;
use super::names::Names;
use crate::outcome::Summary;

static COLUMNS: [Column; 17] = [
    Column::real("time_s"),
    Column::text("kind"),
    Column::integer("vehicle"),
    Column::integer("other_vehicle"),
    Column::text("class"),
    Column::text("other_class"),
    Column::text("style"),
    Column::text("other_style"),
    Column::text("lanelet"),
    Column::text("other_lanelet"),
    Column::real("position_m"),
    Column::real("other_position_m"),
    Column::real("x_m"),
    Column::real("y_m"),
    Column::real("speed_mps"),
    Column::real("other_speed_mps"),
    Column::real("depth_m"),
];

/// Incidents in a batch; those of one step more at most.
const BATCH: usize = 256;

/// Collects incidents.
pub(super) struct Incidents {
    /// Start time of counting [s].
    begin: f64,
    seen: Vec<Incident>,
    sender: BatchSender,
}

impl Incidents {
    /// Collects incidents from the time `begin` [s] on.
    pub(super) fn new(begin: f64, sender: BatchSender) -> Incidents {
        Incidents { begin, seen: Vec::new(), sender }
    }
}

impl Output for Incidents {
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        self.sender.hand_over(Batch::Incidents(std::mem::take(&mut self.seen)))?;
        Ok(Vec::new())
    }

    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        for event in world.events() {
            if let Event::Incident(incident) = event
                && incident.time >= self.begin
            {
                self.seen.push(*incident);
            }
        }
        if self.seen.len() < BATCH {
            return Ok(());
        }
        self.sender.hand_over(Batch::Incidents(std::mem::take(&mut self.seen)))
    }

    fn finish(self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        self.sender.hand_over(Batch::Incidents(self.seen))?;
        Ok(Vec::new())
    }
}

/// Writes a row for each incident.
pub(super) struct IncidentTable {
    table: TableWriter,
    path: PathBuf,
}

impl IncidentTable {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &Folder) -> Result<IncidentTable, Fault> {
        let (table, path) = folder.table("incidents", &COLUMNS)?;
        Ok(IncidentTable { table, path })
    }
}

impl Writer for IncidentTable {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        if let Batch::Incidents(incidents) = batch {
            for incident in incidents {
                self.table.row(&row(names, incident))?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

fn row<'a>(names: &'a Names, incident: &Incident) -> [Cell<'a>; COLUMNS.len()] {
    let &Incident { kind, time, vehicles, driver_parameters, classes, places, at, speeds, depth } = incident;
    let [[lanelet, position], [other_lanelet, other_position]] = places.map(|it| {
        let (lanelet, along) = names.lanelet(it);
        [names.id(lanelet).into(), along.into()]
    });
    let [class, other_class] = classes.map(|it| it.body().name.into());
    let [style, other_style] = driver_parameters.map(|it| names.style(it).into());
    let Point { x, y, .. } = at;
    [
        seconds(time).into(),
        kind.name().into(),
        vehicles[0].into(),
        vehicles[1].into(),
        class,
        other_class,
        style,
        other_style,
        lanelet,
        other_lanelet,
        position,
        other_position,
        x.into(),
        y.into(),
        speeds[0].into(),
        speeds[1].into(),
        depth.into(),
    ]
}
