//! The report on several recordings of different places, each with its own map.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use super::evidence::EvidenceReport;
use super::recording::RecordingReport;
use crate::cut_ins::{CutInsAt, cut_ins_by_speed, write_cut_ins};

/// The report on a set of recordings. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SetReport {
    /// From the first frame to the last, of all together [s].
    pub duration_s: f64,
    /// Distance driven on the maps [veh km].
    pub veh_km: f64,
    /// Lane changes by kind.
    pub lane_changes_by_kind: BTreeMap<&'static str, usize>,
    /// Lane changes that the maps permit.
    pub lane_changes_along_graph: usize,
    /// Lane changes after which the vehicle came back within 30 s.
    pub lane_changes_undone: usize,
    /// What they tell of their drivers, but for single lanelets.
    #[serde(flatten)]
    pub evidence: EvidenceReport,
    /// Their cut-ins by the speed of the follower.
    pub cut_ins_by_speed: Vec<CutInsAt>,
    /// Each of them, by the name of its file.
    pub recordings: Vec<Named>,
}

/// A recording of a set.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Named {
    /// The name of its file.
    pub file: String,
    /// The report on it.
    #[serde(flatten)]
    pub report: RecordingReport,
}

impl SetReport {
    /// The report on `recordings`.
    pub fn of(recordings: Vec<Named>) -> SetReport {
        let reports = || recordings.iter().map(|it| &it.report);
        let mut kinds: BTreeMap<&'static str, usize> = BTreeMap::new();
        for (kind, count) in reports().flat_map(|it| &it.lane_changes_by_kind) {
            *kinds.entry(kind).or_default() += count;
        }
        let thousandths = |value: f64| (value * 1000.0).round() / 1000.0;
        SetReport {
            duration_s: thousandths(reports().map(|it| it.duration_s).sum()),
            veh_km: thousandths(reports().map(|it| it.veh_km).sum()),
            lane_changes_by_kind: kinds,
            lane_changes_along_graph: reports().map(|it| it.lane_changes_along_graph).sum(),
            lane_changes_undone: reports().map(|it| it.lane_changes_undone).sum(),
            evidence: EvidenceReport::pooled(reports().map(|it| &it.evidence)),
            cut_ins_by_speed: cut_ins_by_speed(
                &reports().flat_map(|it| &it.cut_ins).copied().collect::<Vec<_>>(),
            ),
            recordings,
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
        let count: usize = self.lane_changes_by_kind.values().sum();
        writeln!(
            out,
            "{} recordings, {:.1} s, {:.1} veh-km\n",
            self.recordings.len(),
            self.duration_s,
            self.veh_km
        )?;
        for Named { file, report } in &self.recordings {
            let (changes, problems) = (report.lane_changes.len(), report.problems.len());
            writeln!(
                out,
                "  {file}: {:.1} s, {:.2} veh-km, {changes} lane changes, {problems} problems",
                report.duration_s, report.veh_km
            )?;
        }
        let kinds: Vec<String> =
            self.lane_changes_by_kind.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        writeln!(out, "\n{count} lane changes: {}", kinds.join(", "))?;
        writeln!(
            out,
            "{} of them permitted by the maps, {} reversed within 30 s",
            self.lane_changes_along_graph, self.lane_changes_undone
        )?;
        self.evidence.write_to(out)?;
        write_cut_ins(&self.cut_ins_by_speed, out)
    }
}
