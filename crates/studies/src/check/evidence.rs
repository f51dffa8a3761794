//! What a recording tells of its drivers, in a report.

use std::fmt::Write;

use laneweave::sim::Navigator;
use laneweave_models::Style;
use laneweave_network::{Id, LaneletIndex, Network};
use laneweave_recorded::{Assumed, Evidence, Exposure, Replay};
use laneweave_recordings::{LaneChange, Matched, extents};
use laneweave_scenario::style::Population;
use serde::Serialize;

/// What a recording tells of its drivers. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EvidenceReport {
    /// Lane changes that had begun when their vehicle was first seen.
    pub lane_changes_begun_before: usize,
    /// Lane changes that had not ended when their vehicle was last seen.
    pub lane_changes_not_ended: usize,
    /// Durations of the other lane changes, by the path that fits the lateral motion best, in order [s].
    #[serde(skip)]
    durations: Vec<f64>,
    /// Their quartiles [s].
    pub lane_change_duration_s: Option<[f64; 3]>,
    /// Lane changes after which the vehicle was seen for less than 30 s.
    pub lane_changes_seen_shortly: usize,
    /// Between these lanelets vehicles changed although the map forbids it.
    pub forbidden: Vec<Forbidden>,
    /// Time for which vehicles were on the map [veh·h].
    pub veh_h: f64,
    /// Of it, the time with a time gap above 4 s, or nobody ahead [veh·h].
    pub free_veh_h: f64,
    /// What was seen by class of density, in a lanelet and a minute.
    pub by_density: Vec<SeenAt>,
    /// What was seen by lanelet.
    pub by_lanelet: Vec<SeenOn>,
}

/// Lane changes that the map forbids.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Forbidden {
    /// The lanelet that vehicles left.
    pub from_lanelet: Id,
    /// The lanelet that they entered.
    pub to_lanelet: Id,
    /// How many did.
    pub lane_changes: usize,
}

/// What was seen at some density.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeenAt {
    /// Least density of the class [veh/km].
    pub density_from_veh_km: f64,
    /// Distance driven [veh·km].
    pub veh_km: f64,
    /// Time [veh·h].
    pub veh_h: f64,
    /// Lane changes.
    pub lane_changes: usize,
}

/// What was seen on a lanelet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeenOn {
    /// The lanelet.
    pub lanelet: Id,
    /// Distance driven [veh·km].
    pub veh_km: f64,
    /// Time [veh·h].
    pub veh_h: f64,
    /// Lane changes from it.
    pub lane_changes: usize,
}

impl EvidenceReport {
    /// The report on the recording of `matched` with all its lane `changes`, in the order in which they were found.
    pub(super) fn of(matched: &Matched, changes: &[LaneChange]) -> EvidenceReport {
        let (evidence, network) = (evidence(matched, changes), matched.network);
        EvidenceReport {
            lane_changes_begun_before: evidence.begun_before,
            lane_changes_not_ended: evidence.not_ended,
            lane_change_duration_s: quartiles(&evidence.durations),
            durations: evidence.durations,
            lane_changes_seen_shortly: evidence.seen_shortly,
            forbidden: evidence.forbidden.iter().map(|it| forbidden(it, network)).collect(),
            veh_h: rounded(evidence.veh_h),
            free_veh_h: rounded(evidence.free_veh_h),
            by_density: evidence.densities.iter().map(|it| seen_at(*it)).collect(),
            by_lanelet: evidence
                .lanes
                .iter()
                .map(|(at, it)| seen_on(network.lanelets[at.at()].id, it))
                .collect(),
        }
    }

    /// What several recordings tell together. Their lanelets are of different maps, so they are left out.
    pub(super) fn pooled<'a>(reports: impl Iterator<Item = &'a EvidenceReport> + Clone) -> EvidenceReport {
        let sum = |of: fn(&EvidenceReport) -> usize| reports.clone().map(of).sum();
        let mut durations: Vec<f64> = reports.clone().flat_map(|it| &it.durations).copied().collect();
        durations.sort_by(f64::total_cmp);
        let mut by_density: Vec<SeenAt> = Vec::new();
        for seen in reports.clone().flat_map(|it| &it.by_density) {
            match by_density.iter_mut().find(|it| it.density_from_veh_km == seen.density_from_veh_km) {
                None => by_density.push(seen.clone()),
                Some(it) => {
                    it.veh_km = rounded(it.veh_km + seen.veh_km);
                    it.veh_h = rounded(it.veh_h + seen.veh_h);
                    it.lane_changes += seen.lane_changes;
                }
            }
        }
        EvidenceReport {
            lane_changes_begun_before: sum(|it| it.lane_changes_begun_before),
            lane_changes_not_ended: sum(|it| it.lane_changes_not_ended),
            lane_change_duration_s: quartiles(&durations),
            durations,
            lane_changes_seen_shortly: sum(|it| it.lane_changes_seen_shortly),
            forbidden: Vec::new(),
            veh_h: rounded(reports.clone().map(|it| it.veh_h).sum()),
            free_veh_h: rounded(reports.clone().map(|it| it.free_veh_h).sum()),
            by_density,
            by_lanelet: Vec::new(),
        }
    }

    /// In words.
    pub(super) fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "{} had begun when their vehicle was first seen, {} had not ended when it was last seen, and after {} it was seen \
             for less than 30 s",
            self.lane_changes_begun_before, self.lane_changes_not_ended, self.lane_changes_seen_shortly
        )?;
        if let Some([first, median, third]) = self.lane_change_duration_s {
            writeln!(
                out,
                "the others took {median} s in the median ({first} to {third} s in the middle half)"
            )?;
        }
        writeln!(
            out,
            "{:.1} % of the time drivers had a time gap above 4 s, or nobody ahead",
            100.0 * self.free_veh_h / self.veh_h
        )?;
        writeln!(out, "\n  density [veh/km]     veh-km   lane changes")?;
        let ends = self.by_density.iter().skip(1).map(|it| format!("to {}", it.density_from_veh_km));
        for (it, end) in self.by_density.iter().zip(ends.chain(["and more".to_owned()])) {
            writeln!(
                out,
                "  {:>6} {end:<10} {:9.2} {:14}",
                it.density_from_veh_km, it.veh_km, it.lane_changes
            )?;
        }
        let pairs = self.forbidden.iter().take(3);
        let pairs: Vec<String> = pairs
            .map(|it| format!("{} → {} ({})", it.from_lanelet, it.to_lanelet, it.lane_changes))
            .collect();
        if !pairs.is_empty() {
            writeln!(out, "\nnot permitted by the map, most often: {}", pairs.join(", "))?;
        }
        Ok(())
    }
}

/// What the recording tells of its drivers. Who they are does not matter for that.
fn evidence(matched: &Matched, changes: &[LaneChange]) -> Evidence {
    let extents = extents(matched, changes);
    let navigator = Navigator::new(matched.network);
    let drivers: Vec<Style> = Population::usual(1).map(|it| it.driver_parameters).unwrap_or_default();
    let assume = |track| Assumed::by_its_speeds(matched, track, 0);
    match Replay::new(matched, changes, &navigator, &drivers, assume) {
        Ok(replay) => Evidence::of(matched, changes, &extents, &replay),
        Err(_) => Evidence::default(),
    }
}

fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

fn quartiles(sorted: &[f64]) -> Option<[f64; 3]> {
    let of = |quarter: usize| sorted.get(quarter * sorted.len() / 4).map(|it| (it * 100.0).round() / 100.0);
    Some([of(1)?, of(2)?, of(3)?])
}

fn forbidden(([from, to], lane_changes): &([LaneletIndex; 2], usize), network: &Network) -> Forbidden {
    let [from_lanelet, to_lanelet] = [from, to].map(|it| network.lanelets[it.at()].id);
    Forbidden { from_lanelet, to_lanelet, lane_changes: *lane_changes }
}

fn seen_at((density_from_veh_km, seen): (f64, Exposure)) -> SeenAt {
    let Exposure { veh_km, veh_h, changes: lane_changes } = seen;
    SeenAt { density_from_veh_km, veh_km: rounded(veh_km), veh_h: rounded(veh_h), lane_changes }
}

fn seen_on(lanelet: Id, seen: &Exposure) -> SeenOn {
    let Exposure { veh_km, veh_h, changes: lane_changes } = *seen;
    SeenOn { lanelet, veh_km: rounded(veh_km), veh_h: rounded(veh_h), lane_changes }
}
