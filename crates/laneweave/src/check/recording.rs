//! What a recording holds: who was there, what was mended, and who changed lanes.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use laneweave_maps::Problem;
use laneweave_network::{Network, Side};
use laneweave_recordings::{
    CleaningReport, Kind, LaneChange, Matched, Recording, clean, commonroad, interaction, lane_changes,
};
use serde::Serialize;

use super::report::Complaint;
use crate::fault::Fault;

const METRES_PER_KM: f64 = 1000.0;
/// Lane changes that are listed in words.
const LISTED: usize = 20;

/// What a recording holds. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RecordingReport {
    /// Time between frames [s].
    pub step_s: f64,
    /// From the first frame to the last [s].
    pub duration_s: f64,
    /// Tracks by what they are of; a track that was interrupted counts for each part.
    pub tracks: BTreeMap<&'static str, usize>,
    /// States of vehicles.
    pub states: usize,
    /// Of them, those far from every lanelet.
    pub unmatched: usize,
    /// Distance driven on the map [veh km].
    pub veh_km: f64,
    /// What was mended or cut out, and how often.
    pub cleaning: BTreeMap<&'static str, usize>,
    /// Lane changes by kind.
    pub lane_changes_by_kind: BTreeMap<&'static str, usize>,
    /// Lane changes that the map permits.
    pub lane_changes_along_graph: usize,
    /// Lane changes whose vehicle came back within 30 s.
    pub lane_changes_undone: usize,
    /// Lane changes in the order of their times.
    pub lane_changes: Vec<ChangeRow>,
    /// What could not be read as it stands.
    pub problems: Vec<Complaint>,
}

/// A lane change that was recorded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChangeRow {
    /// Id of the track.
    pub vehicle: i64,
    /// When its centre crossed the line [s].
    pub time_s: f64,
    /// The lanelet that it left.
    pub from_lanelet: i64,
    /// The lanelet that it entered.
    pub to_lanelet: i64,
    /// `left` or `right`.
    pub side: &'static str,
    /// `discretionary`, `route` or `unknown`.
    pub kind: &'static str,
    /// Where [m].
    pub x_m: f64,
    /// Where [m].
    pub y_m: f64,
    /// How fast [m/s].
    pub speed_mps: f64,
    /// The map permits it.
    pub along_graph: bool,
    /// How long the vehicle was seen afterwards [s].
    pub seen_after_s: f64,
}

/// Reads a recording: CommonRoad (.xml) or the layout of the INTERACTION dataset (.csv).
///
/// # Errors
/// If it cannot be read, or is of neither format.
pub fn open_recording(path: &Path) -> Result<(Recording, Vec<Problem>), Fault> {
    let extension = path.extension().map_or("".into(), |it| it.to_string_lossy().to_ascii_lowercase());
    let read: fn(&[u8]) -> _ = match extension.as_str() {
        "csv" => interaction::read,
        "xml" => commonroad::read,
        _ => {
            let what = format!("no format of recordings has the extension {extension:?}");
            return Err(Fault::new(path.display(), what, "known are INTERACTION (.csv), CommonRoad (.xml)"));
        }
    };
    let bytes = std::fs::read(path).map_err(|error| Fault::refused(path, "read", &error))?;
    read(&bytes).map_err(|error| {
        let message = error.to_string();
        let (what, remedy) = message.rsplit_once("; ").unwrap_or((&message, "mend the file"));
        Fault::new(path.display(), what, remedy)
    })
}

impl RecordingReport {
    /// What `recording` holds on a map with these roads; `problems` were found in reading it.
    pub fn of(recording: Recording, problems: &[Problem], network: &Network) -> RecordingReport {
        let (recording, cleaning) = clean(recording);
        let matched = Matched::new(network, &recording);
        let mut changes = lane_changes(&matched);
        changes.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.vehicle.cmp(&b.vehicle)));
        let mut tracks: BTreeMap<&'static str, usize> = BTreeMap::new();
        let mut kinds: BTreeMap<&'static str, usize> = BTreeMap::new();
        recording.tracks.iter().for_each(|it| *tracks.entry(it.class.name()).or_default() += 1);
        changes.iter().for_each(|it| *kinds.entry(kind(it.kind)).or_default() += 1);
        let places = matched.places.iter().zip(&recording.tracks).filter(|(_, it)| it.class.is_vehicle());
        let (states, unmatched) = places.fold((0, 0), |(states, unmatched), (places, _)| {
            (states + places.len(), unmatched + places.iter().filter(|it| it.is_none()).count())
        });
        let span = recording.frames().map_or(0, |(first, last)| last - first);
        RecordingReport {
            step_s: recording.step,
            duration_s: span as f64 * recording.step,
            tracks,
            states,
            unmatched,
            veh_km: (distance(&recording)).round() / METRES_PER_KM,
            cleaning: counts(&cleaning),
            lane_changes_by_kind: kinds,
            lane_changes_along_graph: changes.iter().filter(|it| it.along_graph).count(),
            lane_changes_undone: changes.iter().filter(|it| it.returned_after.is_some()).count(),
            lane_changes: changes.iter().map(|it| row(it, network)).collect(),
            problems: problems.iter().map(Complaint::from).collect(),
        }
    }

    /// The report in words.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        // Writing to a string never fails.
        let _ = self.write_to(&mut out);
        out
    }

    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        let tracks: Vec<String> =
            self.tracks.iter().map(|(class, count)| format!("{count} {class}")).collect();
        writeln!(out, "{:.1} s, a frame every {} s: {}", self.duration_s, self.step_s, tracks.join(", "))?;
        writeln!(
            out,
            "{} states of vehicles, {} of them far from every lanelet; {} veh km",
            self.states, self.unmatched, self.veh_km
        )?;
        match self.cleaning.is_empty() {
            true => writeln!(out, "Nothing had to be cleaned.")?,
            false => writeln!(out, "\nCleaned:")?,
        }
        for (what, count) in &self.cleaning {
            writeln!(out, "  {count:6} {what}")?;
        }
        let kinds: Vec<String> =
            self.lane_changes_by_kind.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        if self.lane_changes.is_empty() {
            writeln!(out, "\nNobody changed lanes.")?;
            return self.write_problems(out);
        }
        writeln!(out, "\n{} lane changes: {}", self.lane_changes.len(), kinds.join(", "))?;
        writeln!(
            out,
            "{} of them permitted by the map, {} undone within 30 s",
            self.lane_changes_along_graph, self.lane_changes_undone
        )?;
        if !self.lane_changes.is_empty() {
            writeln!(
                out,
                "\n   time [s]    vehicle       from         to  side   kind           speed [m/s]"
            )?;
        }
        for it in self.lane_changes.iter().take(LISTED) {
            writeln!(
                out,
                "{:11.2} {:10} {:10} {:10}  {:<6} {:<14} {:11.1}{}",
                it.time_s,
                it.vehicle,
                it.from_lanelet,
                it.to_lanelet,
                it.side,
                it.kind,
                it.speed_mps,
                if it.along_graph { "" } else { "  not permitted by the map" }
            )?;
        }
        if self.lane_changes.len() > LISTED {
            writeln!(out, "and {} more; --json lists them all", self.lane_changes.len() - LISTED)?;
        }
        self.write_problems(out)
    }

    fn write_problems(&self, out: &mut String) -> std::fmt::Result {
        if !self.problems.is_empty() {
            writeln!(out, "\n{} problems:", self.problems.len())?;
        }
        self.problems.iter().take(LISTED).try_for_each(|it| writeln!(out, "  {it}"))
    }
}

fn counts(cleaning: &CleaningReport) -> BTreeMap<&'static str, usize> {
    let found = cleaning.findings().into_iter().filter(|(_, it)| it.count > 0);
    found.map(|(name, it)| (name, it.count)).collect()
}

/// What vehicles drove in all [m].
fn distance(recording: &Recording) -> f64 {
    let vehicles = recording.tracks.iter().filter(|it| it.class.is_vehicle());
    vehicles.flat_map(|it| it.states.windows(2)).map(|it| (it[1].x - it[0].x).hypot(it[1].y - it[0].y)).sum()
}

fn row(change: &LaneChange, network: &Network) -> ChangeRow {
    ChangeRow {
        vehicle: change.vehicle,
        time_s: change.time,
        from_lanelet: network.lanelets[change.from.at()].id,
        to_lanelet: network.lanelets[change.to.at()].id,
        side: match change.side {
            Side::Left => "left",
            Side::Right => "right",
        },
        kind: kind(change.kind),
        x_m: change.x,
        y_m: change.y,
        speed_mps: change.speed,
        along_graph: change.along_graph,
        seen_after_s: change.seen_after,
    }
}

fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Discretionary => "discretionary",
        Kind::Route => "route",
        Kind::Unknown => "unknown",
    }
}
