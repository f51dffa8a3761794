//! The report `report.html`: a run and its results on one page; and two of its figures as files of their own,
//! `lane_change_rate.svg` and `time_space.svg`.

use std::path::PathBuf;
use std::sync::Arc;

use laneweave_network::Network;
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Prepared, Scenario};
use laneweave_sim::World;

use super::Output;
use super::folder::Folder;
use crate::folder::CHECKPOINT;
use crate::outcome::{About, Provenance, Summary};
use crate::pack::{pack, unpack};
use crate::report::{Record, RunReport};
use crate::whole_file::{all_whole, write_whole};

/// Collects the data of the report of a run.
pub(super) struct Report {
    path: PathBuf,
    rate: PathBuf,
    time_space: PathBuf,
    about: About,
    provenance: Provenance,
    record: Record,
    network: Arc<Network>,
}

impl Report {
    /// The output for the report in `folder`.
    pub(super) fn new(folder: &Folder, scenario: &Scenario, prepared: &Prepared) -> Report {
        Report {
            path: folder.file("report.html"),
            rate: folder.file("lane_change_rate.svg"),
            time_space: folder.file("time_space.svg"),
            about: About::of(scenario, prepared),
            provenance: folder.provenance.clone(),
            record: Record::of(scenario, prepared),
            network: prepared.world.shared_network(),
        }
    }
}

impl Output for Report {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        self.record.observe(world);
        Ok(())
    }

    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        pack(&self.record)
    }

    fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        let record: Record = unpack(saved)?;
        if !record.fits(&self.record, &self.network) {
            let what = "what it keeps for the report is not of this run";
            return Err(Fault::new(CHECKPOINT, what, "run again from the beginning, without --resume"));
        }
        self.record = record;
        Ok(())
    }

    fn finish(self: Box<Self>, world: &World, summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        let Report { path, rate, time_space, about, provenance, record, .. } = *self;
        let end = world.clock().time();
        let (about, provenance, record, network) = (&about, &provenance, &record, world.network());
        let aggregates = &world.lanelet_aggregates();
        let report = RunReport { about, provenance, summary, record, network, aggregates, end };
        let texts = [
            (path, report.page().to_html()),
            (rate, record.rate_figure(end)),
            (time_space, record.time_space_figure()),
        ];
        all_whole(texts.into_iter().map(|(path, text)| write_whole(&path, &text).map(|()| vec![path])))
    }
}
