//! `tripinfo.xml`: every trip that ended, in the format of SUMO's `--tripinfo-output`.

use std::path::PathBuf;

use laneweave_scenario::Fault;

use super::xml::XmlFile;
use crate::output::batch::{Batch, Writer};
use crate::output::folder::Folder;
use crate::output::names::Names;
use crate::output::trip::{End, Trip};

const ROOT: &str = "<tripinfos xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
    xsi:noNamespaceSchemaLocation=\"http://sumo.dlr.de/xsd/tripinfo_file.xsd\">";

/// Writes an element for each trip that ended.
pub(in crate::output) struct TripInfo {
    file: XmlFile,
}

impl TripInfo {
    /// Begins the file in `folder`.
    pub(in crate::output) fn create(folder: &Folder) -> Result<TripInfo, Fault> {
        Ok(TripInfo { file: XmlFile::create(&folder.file("tripinfo.xml"), ROOT, folder.provenance)? })
    }

    fn trip(&mut self, trip: &Trip, end: &End, names: &Names) -> Result<(), Fault> {
        let Trip { record, way, .. } = trip;
        let (from, from_pos) = names.lanelet(record.from);
        let (to, to_pos) = names.lanelet(end.at);
        let file = &mut self.file;
        file.raw("    <tripinfo id=\"").vehicle(names, record.vehicle);
        file.raw("\" depart=\"").time(names.begin_s + record.entered);
        file.raw("\" departLane=\"").raw(names.lanes.xml(from));
        file.raw("\" departPos=\"").number(from_pos);
        file.raw("\" departSpeed=\"").number(record.speed);
        file.raw("\" departDelay=\"").time(trip.waiting());
        file.raw("\" arrival=\"").time(names.begin_s + end.time);
        file.raw("\" arrivalLane=\"").raw(names.lanes.xml(to));
        file.raw("\" arrivalPos=\"").number(to_pos);
        file.raw("\" arrivalSpeed=\"").number(end.speed);
        file.raw("\" duration=\"").time(end.duration);
        file.raw("\" routeLength=\"").number(*way);
        file.raw("\" waitingTime=\"").time(record.stood);
        file.raw("\" waitingCount=\"").integer(record.stops);
        file.raw("\" stopTime=\"0.00");
        if let Some(delay) = trip.delay() {
            // In such a file it cannot be negative. By rounding, and for a vehicle without a leader, it can be
            // negative by fractions of a second.
            file.raw("\" timeLoss=\"").number(delay.max(0.0));
        }
        file.raw("\" rerouteNo=\"").integer(record.route_changes + record.missed_turns);
        file.raw("\" devices=\"\" vType=\"").raw(names.type_in_xml(record.class, record.parameters));
        file.raw("\" speedFactor=\"").number(names.speed_factor(record.parameters));
        file.end("\" vaporized=\"\"/>\n")
    }
}

impl Writer for TripInfo {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        let Batch::Trips(trips) = batch else { return Ok(()) };
        for trip in trips {
            if let Some(end) = &trip.end {
                self.trip(trip, end, names)?;
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.file.finish("</tripinfos>\n")
    }
}
