//! The report on a recording: its road users, the corrections, and the lane changes.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use laneweave_maps::Problem;
use laneweave_network::{Id, Network};
use laneweave_recordings::{
    CleaningReport, CutIn, LaneChange, Matched, Recording, RecordingError, clean, commonroad, cut_ins,
    lane_changes,
};
use laneweave_scenario::{Fault, elsewhere, unreadable};
use laneweave_study::units::METRES_PER_KM;
use serde::Serialize;

use super::evidence::EvidenceReport;
use crate::cut_ins::{CutInsAt, cut_ins_by_speed, write_cut_ins};

/// Maximum of lane changes in the text.
const LISTED: usize = 20;

/// The report on a recording. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RecordingReport {
    /// Of several files, what was joined, what was not and why, and what is left out.
    pub windows: Vec<String>,
    /// Time between frames [s].
    pub step_s: f64,
    /// From the first frame to the last [s].
    pub duration_s: f64,
    /// Tracks by class; each part of an interrupted track counts.
    pub tracks: BTreeMap<&'static str, usize>,
    /// States of vehicles.
    pub states: usize,
    /// Of them, those far from every lanelet.
    pub unmatched: usize,
    /// Distance driven on the map [veh km].
    pub veh_km: f64,
    /// The corrections by kind, and their numbers.
    pub cleaning: BTreeMap<&'static str, usize>,
    /// Lane changes by kind.
    pub lane_changes_by_kind: BTreeMap<&'static str, usize>,
    /// Lane changes that the map permits.
    pub lane_changes_along_graph: usize,
    /// Lane changes after which the vehicle came back within 30 s.
    pub lane_changes_undone: usize,
    /// What it tells of its drivers.
    #[serde(flatten)]
    pub evidence: EvidenceReport,
    /// The cut-ins.
    #[serde(skip)]
    pub(super) cut_ins: Vec<CutIn>,
    /// The same by the speed of the follower.
    pub cut_ins_by_speed: Vec<CutInsAt>,
    /// Lane changes in the order of their times.
    pub lane_changes: Vec<ChangeRow>,
    /// By the id of a vehicle, what the file has as an id where that is no number.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub names: BTreeMap<i64, String>,
    /// Problems in reading it.
    pub problems: Vec<Problem>,
}

/// A recorded lane change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChangeRow {
    /// Id of the track.
    pub vehicle: i64,
    /// When its centre crossed the line [s].
    pub time_s: f64,
    /// The lanelet that it left.
    pub from_lanelet: Id,
    /// The lanelet that it entered.
    pub to_lanelet: Id,
    /// `left` or `right`.
    pub side: &'static str,
    /// `discretionary`, `route` or `unknown`.
    pub kind: &'static str,
    /// Position [m].
    pub x_m: f64,
    /// Position [m].
    pub y_m: f64,
    /// Speed [m/s].
    pub speed_mps: f64,
    /// Whether the map permits it.
    pub along_graph: bool,
    /// Time for which the vehicle was observed afterwards [s].
    pub seen_after_s: f64,
}

/// Reads the tracks of a CommonRoad file, if it has any.
///
/// # Errors
/// If it has some that cannot be read.
pub fn tracks(path: &Path) -> Result<Option<(Recording, Vec<Problem>)>, Fault> {
    match commonroad::read(&content(path)?) {
        Ok(recording) => Ok(Some(recording)),
        Err(RecordingError::Empty { .. }) => Ok(None),
        Err(error) => Err(unreadable(path, &error)),
    }
}

/// The content of a file, or enough of it to see that it is too large.
fn content(path: &Path) -> Result<Vec<u8>, Fault> {
    /// A little more than the limit of any reader [B].
    const MOST: u64 = 1 << 30;
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|it| it.take(MOST).read_to_end(&mut bytes));
    read.map_err(|error| Fault::refused(path, "read", &error))?;
    if bytes.is_empty() {
        let remedy = "download the recording again, or choose another file";
        return Err(Fault::new(path.display(), "the file is empty", remedy));
    }
    // Bytes that are no text are shown unchanged in the message about them.
    if bytes.contains(&0) {
        let what = "this is not a text file, so it cannot be a recording";
        return Err(Fault::new(path.display(), what, "choose another file, or decompress it first"));
    }
    Ok(bytes)
}

impl RecordingReport {
    /// The report on `recording` on a map with these roads; `problems` were found in reading it.
    pub fn of(recording: Recording, problems: &[Problem], network: &Network) -> RecordingReport {
        let (recording, cleaning) = clean(recording);
        let matched = Matched::new(network, &recording);
        let mut changes = lane_changes(&matched);
        let evidence = EvidenceReport::of(&matched, &changes);
        let cut_ins = cut_ins(&matched, &changes);
        changes.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.vehicle.cmp(&b.vehicle)));
        let mut tracks: BTreeMap<&'static str, usize> = BTreeMap::new();
        let mut kinds: BTreeMap<&'static str, usize> = BTreeMap::new();
        recording.tracks.iter().for_each(|it| *tracks.entry(it.class.name()).or_default() += 1);
        changes.iter().for_each(|it| *kinds.entry(it.kind.name()).or_default() += 1);
        let (states, unmatched) = matched.count_states();
        let elsewhere = (2 * unmatched > states).then(|| elsewhere(&recording, network));
        let span = recording.frames().map_or(0, |(first, last)| last - first);
        RecordingReport {
            windows: Vec::new(),
            step_s: recording.step,
            duration_s: span as f64 * recording.step,
            tracks,
            states,
            unmatched,
            veh_km: distance(&matched).round() / METRES_PER_KM,
            cleaning: counts(&cleaning),
            lane_changes_by_kind: kinds,
            lane_changes_along_graph: changes.iter().filter(|it| it.along_graph).count(),
            lane_changes_undone: changes.iter().filter(|it| it.returned_after.is_some()).count(),
            evidence,
            cut_ins_by_speed: cut_ins_by_speed(&cut_ins),
            cut_ins,
            lane_changes: changes.iter().map(|it| row(it, network)).collect(),
            names: recording.names.clone(),
            problems: elsewhere.into_iter().chain(problems.iter().cloned()).collect(),
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
        for it in &self.windows {
            writeln!(out, "{it}")?;
        }
        writeln!(out, "{:.1} s, a frame every {} s: {}", self.duration_s, self.step_s, tracks.join(", "))?;
        writeln!(
            out,
            "{} states of vehicles, {} of them far from every lanelet; {} veh-km",
            self.states, self.unmatched, self.veh_km
        )?;
        match self.cleaning.is_empty() {
            true => writeln!(out, "Nothing had to be corrected.")?,
            false => writeln!(out, "\nCleaned:")?,
        }
        for (what, count) in &self.cleaning {
            writeln!(out, "  {count:6} {what}")?;
        }
        let kinds: Vec<String> =
            self.lane_changes_by_kind.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        if self.lane_changes.is_empty() {
            writeln!(out, "\nNo lane changes.")?;
            return self.write_problems(out);
        }
        writeln!(out, "\n{} lane changes: {}", self.lane_changes.len(), kinds.join(", "))?;
        writeln!(
            out,
            "{} of them permitted by the map, {} reversed within 30 s",
            self.lane_changes_along_graph, self.lane_changes_undone
        )?;
        self.evidence.write_to(out)?;
        write_cut_ins(&self.cut_ins_by_speed, out)?;
        writeln!(out, "\n   time [s]    vehicle       from         to  side   kind           speed [m/s]")?;
        for it in self.lane_changes.iter().take(LISTED) {
            let vehicle = self.names.get(&it.vehicle).cloned().unwrap_or_else(|| it.vehicle.to_string());
            writeln!(
                out,
                "{:11.2} {vehicle:>10} {:10} {:10}  {:<6} {:<14} {:11.1}{}",
                it.time_s,
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
            writeln!(out, "\nProblems ({}; --json lists all):", self.problems.len())?;
        }
        self.problems.iter().take(LISTED).try_for_each(|it| writeln!(out, "  {it}"))
    }
}

fn counts(cleaning: &CleaningReport) -> BTreeMap<&'static str, usize> {
    let found = cleaning.findings().into_iter().filter(|(_, it)| it.count > 0);
    found.map(|(name, it)| (name, it.count)).collect()
}

/// Distance driven on the map by all vehicles [m].
fn distance(matched: &Matched) -> f64 {
    let tracks = matched.recording.tracks.iter().zip(&matched.places);
    let moves = tracks.flat_map(|(track, places)| track.states.windows(2).zip(places.windows(2)));
    let on_the_map = moves.filter(|(_, places)| places.iter().all(Option::is_some));
    on_the_map.map(|(it, _)| (it[1].x - it[0].x).hypot(it[1].y - it[0].y)).sum()
}

fn row(change: &LaneChange, network: &Network) -> ChangeRow {
    ChangeRow {
        vehicle: change.vehicle,
        time_s: change.time,
        from_lanelet: network.lanelets[change.from.at()].id,
        to_lanelet: network.lanelets[change.to.at()].id,
        side: change.side.name(),
        kind: change.kind.name(),
        x_m: change.x,
        y_m: change.y,
        speed_mps: change.speed,
        along_graph: change.along_graph,
        seen_after_s: change.seen_after,
    }
}
