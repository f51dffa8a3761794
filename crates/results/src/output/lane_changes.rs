//! Every lane change with its reasons: the table `lane_changes`.

use std::path::PathBuf;

use laneweave_models::change::IncentiveName;
use laneweave_network::{Point, Position};
use laneweave_scenario::Fault;
use laneweave_sim::{Event, LaneChange, World};
use laneweave_study::{Cell, Column, TableWriter, seconds};

use super::Output;
use super::batch::{Batch, BatchSender, Writer};
use super::names::Names;
use crate::outcome::Summary;

/// Columns before those of the incentives.
const BEFORE: [Column; 14] = [
    Column::real("time_s"),
    Column::real("started_s"),
    Column::real("duration_s"),
    Column::integer("vehicle"),
    Column::text("style"),
    Column::text("class"),
    Column::text("from_lanelet"),
    Column::text("to_lanelet"),
    Column::real("x_m"),
    Column::real("y_m"),
    Column::text("side"),
    Column::text("kind"),
    Column::real("speed_mps"),
    Column::real("speed_gain_mps"),
];

/// Columns after those of the incentives.
const AFTER: [Column; 7] = [
    Column::real("g"),
    Column::real("theta"),
    Column::real("gap_ahead_m"),
    Column::real("gap_behind_m"),
    Column::real("ttc_ahead_s"),
    Column::real("ttc_behind_s"),
    Column::text("outcome"),
];

/// Lane changes in a batch; those of one step more at most.
const BATCH: usize = 256;

/// Collects the lane changes that are completed or aborted.
pub(super) struct LaneChanges {
    /// Start time of counting [s].
    begin: f64,
    ended: Vec<LaneChange>,
    sender: BatchSender,
}

impl LaneChanges {
    /// Collects lane changes from the time `begin` [s] on.
    pub(super) fn new(begin: f64, sender: BatchSender) -> LaneChanges {
        LaneChanges { begin, ended: Vec::new(), sender }
    }
}

impl Output for LaneChanges {
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        self.sender.hand_over(Batch::LaneChanges(std::mem::take(&mut self.ended)))?;
        Ok(Vec::new())
    }

    fn restore(&mut self, _saved: &[u8]) -> Result<(), Fault> {
        Ok(())
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.time >= self.begin
            {
                self.ended.push(*change);
            }
        }
        if self.ended.len() < BATCH {
            return Ok(());
        }
        self.sender.hand_over(Batch::LaneChanges(std::mem::take(&mut self.ended)))
    }

    fn finish(self: Box<Self>, _world: &World, _summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        self.sender.hand_over(Batch::LaneChanges(self.ended))?;
        Ok(Vec::new())
    }
}

/// Writes a row for each lane change.
pub(super) struct LaneChangeTable {
    table: TableWriter,
    path: PathBuf,
}

impl LaneChangeTable {
    /// Begins the table in `folder`.
    pub(super) fn create(folder: &super::folder::Folder) -> Result<LaneChangeTable, Fault> {
        let incentives = IncentiveName::ALL.into_iter().flat_map(IncentiveName::columns).map(Column::real);
        let columns: Vec<Column> = BEFORE.into_iter().chain(incentives).chain(AFTER).collect();
        let (table, path) = folder.table("lane_changes", &columns)?;
        Ok(LaneChangeTable { table, path })
    }
}

impl Writer for LaneChangeTable {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        if let Batch::LaneChanges(changes) = batch {
            for change in changes {
                self.table.row(&row(names, change))?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.table.finish()?;
        Ok(self.path)
    }
}

fn row<'a>(names: &'a Names, change: &LaneChange) -> Vec<Cell<'a>> {
    let Point { x, y, .. } = place(names, change);
    let mut cells: Vec<Cell> = vec![
        seconds(change.time).into(),
        seconds(change.started).into(),
        seconds(change.duration).into(),
        change.vehicle.into(),
        names.style(change.parameters).into(),
        change.class.body().name.into(),
        names.id_at(change.from).into(),
        names.id_at(change.to).into(),
        x.into(),
        y.into(),
        change.side.name().into(),
        change.kind.name().into(),
        change.speed.into(),
        change.speed_gain.into(),
    ];
    for row in change.appraisal.rows {
        cells.extend([Cell::from(row.earning), row.weight.into()]);
    }
    cells.extend([Cell::from(change.appraisal.gain), change.appraisal.theta.into()]);
    cells.extend([change.gap_ahead, change.gap_behind, change.ttc_ahead, change.ttc_behind].map(known));
    cells.push(if change.is_completed { "completed" } else { "aborted" }.into());
    cells
}

/// Where the vehicle's centre crossed the line between the lanes.
fn place(names: &Names, change: &LaneChange) -> Point {
    let half = 0.5 * change.class.body().length;
    let on = |it: Position| names.network.chain(it.chain).centre.at(it.x - half);
    on(change.from).towards(&on(change.to), 0.5)
}

/// An infinite value, where there is no vehicle or no closing speed, is a missing one.
fn known(value: f64) -> Cell<'static> {
    if value.is_finite() { value.into() } else { Cell::Missing }
}
