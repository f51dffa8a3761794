//! `lanechanges.xml`: every completed lane change, in the format of SUMO's `--lanechange-output`.

use std::path::PathBuf;

use laneweave_network::Side;
use laneweave_scenario::Fault;
use laneweave_sim::{LaneChange, LaneChangeKind};

use super::xml::XmlFile;
use crate::output::batch::{Batch, Writer};
use crate::output::folder::Folder;
use crate::output::names::Names;

/// Writes an element for each lane change that was completed.
pub(in crate::output) struct LaneChangeOutput {
    file: XmlFile,
    /// The side towards which indices of lanes grow.
    overtaking: Side,
}

impl LaneChangeOutput {
    /// Begins the file in `folder`, of traffic that overtakes on the side `overtaking`.
    pub(in crate::output) fn create(folder: &Folder, overtaking: Side) -> Result<LaneChangeOutput, Fault> {
        let file = XmlFile::create(&folder.file("lanechanges.xml"), "<lanechanges>", folder.provenance)?;
        Ok(LaneChangeOutput { file, overtaking })
    }

    fn change(&mut self, change: &LaneChange, names: &Names) -> Result<(), Fault> {
        let (from, along) = names.lanelet(change.from);
        let (to, _) = names.lanelet(change.to);
        let dir = if change.side == self.overtaking { 1 } else { -1 };
        let file = &mut self.file;
        file.raw("    <change id=\"").vehicle(names, change.vehicle);
        file.raw("\" type=\"").raw(names.type_in_xml(change.class, change.parameters));
        file.raw("\" time=\"").time(names.begin_s + change.time);
        file.raw("\" from=\"").raw(names.lanes.xml(from));
        file.raw("\" to=\"").raw(names.lanes.xml(to));
        file.raw("\" dir=\"").integer(dir);
        file.raw("\" speed=\"").number(change.speed);
        file.raw("\" pos=\"").number(along);
        file.raw("\" reason=\"").raw(reason(change.kind));
        file.raw("\" leaderGap=\"");
        known(file, change.gap_ahead);
        file.raw("\" leaderSecureGap=\"None\" leaderSpeed=\"None\" followerGap=\"");
        known(file, change.gap_behind);
        file.end(
            "\" followerSecureGap=\"None\" followerSpeed=\"None\" origLeaderGap=\"None\" \
             origLeaderSecureGap=\"None\" origLeaderSpeed=\"None\"/>\n",
        )
    }
}

/// A gap [m], if there is a vehicle.
fn known(file: &mut XmlFile, gap: f64) {
    if gap.is_finite() {
        file.number(gap)
    } else {
        file.raw("None")
    };
}

/// SUMO's name of the reason for a lane change.
fn reason(kind: LaneChangeKind) -> &'static str {
    match kind {
        LaneChangeKind::Discretionary => "speedGain",
        LaneChangeKind::Route => "strategic",
        LaneChangeKind::Keeping => "keepRight",
    }
}

impl Writer for LaneChangeOutput {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        let Batch::LaneChanges(changes) = batch else { return Ok(()) };
        changes.iter().filter(|it| it.is_completed).try_for_each(|it| self.change(it, names))
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.file.finish("</lanechanges>\n")
    }
}
