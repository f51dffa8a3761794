//! What a recording can tell of its drivers: what calibration has to know before it begins.

use std::collections::BTreeMap;

use laneweave_network::LaneletIndex;
use laneweave_recordings::{Extent, LaneChange, Matched};

use crate::replay::Replay;

const METRES_PER_KM: f64 = 1000.0;
const SECONDS_PER_HOUR: f64 = 3600.0;
/// A driver with a longer time gap, or nobody ahead, drives freely [s].
const FREE: f64 = 4.0;
/// A vehicle that is seen for less than this after a change does not show whether it would have come back [s].
const RETURN: f64 = 30.0;
/// A change that begins or ends this near to the first or last sight of its vehicle was cut off there [s].
const EDGE: f64 = 0.2;
/// Density is averaged over this time [s].
const INTERVAL: f64 = 60.0;
/// Upper ends of the classes of density, but for the last class [veh/km].
const DENSITIES: [f64; 4] = [10.0, 20.0, 30.0, 40.0];

/// What a recording can tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    /// Lane changes that had begun when their vehicle was first seen.
    pub begun_before: usize,
    /// Lane changes that had not ended when their vehicle was last seen.
    pub not_ended: usize,
    /// Durations of the others, in order [s]: of the path that fits the lateral motion best, so of what can be seen.
    pub durations: Vec<f64>,
    /// Lane changes after which the vehicle was seen for less than 30 s.
    pub seen_shortly: usize,
    /// Pairs of lanelets between which vehicles changed although the map forbids it, and how often.
    pub forbidden: Vec<([LaneletIndex; 2], usize)>,
    /// Time for which vehicles were seen on lanelets [veh·h].
    pub veh_h: f64,
    /// Time for which they had a time gap above 4 s, or nobody ahead [veh·h].
    pub free_veh_h: f64,
    /// By lanelet, where vehicles were.
    pub lanes: BTreeMap<LaneletIndex, Exposure>,
    /// By class of density in a lanelet and a minute: its least density [veh/km], and the exposure.
    pub densities: Vec<(f64, Exposure)>,
}

/// How much was seen of drivers, and how many of them changed lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exposure {
    /// Distance that vehicles drove [veh·km].
    pub veh_km: f64,
    /// Time that they were there [veh·h].
    pub veh_h: f64,
    /// Lane changes that they began there.
    pub changes: usize,
}

impl Evidence {
    /// What the recording of `matched` tells, with all its lane `changes`, their `extents`, and what drivers see in
    /// `replay`.
    pub fn of(matched: &Matched, changes: &[LaneChange], extents: &[Extent], replay: &Replay) -> Evidence {
        let mut evidence = Evidence::default();
        evidence.note_changes(matched, changes, extents);
        evidence.note_exposure(matched, changes);
        evidence.note_free_flow(matched, replay);
        evidence
    }

    /// The median duration of a lane change [s].
    pub fn median_duration(&self) -> Option<f64> {
        self.durations.get(self.durations.len() / 2).copied()
    }

    fn note_changes(&mut self, matched: &Matched, changes: &[LaneChange], extents: &[Extent]) {
        let mut forbidden: BTreeMap<[LaneletIndex; 2], usize> = BTreeMap::new();
        for (change, extent) in changes.iter().zip(extents) {
            let states = &matched.recording.tracks[change.track].states;
            let time = |frame: i64| frame as f64 * matched.recording.step;
            let first = states.first().map_or(f64::NEG_INFINITY, |it| time(it.frame));
            let last = states.last().map_or(f64::INFINITY, |it| time(it.frame));
            let (is_late, is_early) = (extent.began < first + EDGE, extent.ended > last - EDGE);
            self.begun_before += usize::from(is_late);
            self.not_ended += usize::from(is_early);
            if !is_late && !is_early {
                self.durations.push(extent.ended - extent.began);
            }
            self.seen_shortly += usize::from(change.seen_after < RETURN);
            if !change.along_graph {
                *forbidden.entry([change.from, change.to]).or_default() += 1;
            }
        }
        self.durations.sort_by(f64::total_cmp);
        self.forbidden = forbidden.into_iter().collect();
        self.forbidden.sort_by_key(|it| std::cmp::Reverse(it.1));
    }

    fn note_exposure(&mut self, matched: &Matched, changes: &[LaneChange]) {
        let step = matched.recording.step;
        let interval = |time: f64| (time / INTERVAL).floor() as i64;
        let mut cells: BTreeMap<(LaneletIndex, i64), Exposure> = BTreeMap::new();
        for (track, places) in matched.recording.tracks.iter().zip(&matched.places) {
            for (state, place) in track.states.iter().zip(places) {
                let Some(place) = place else { continue };
                let cell = cells.entry((place.lanelet, interval(state.frame as f64 * step))).or_default();
                cell.veh_h += step / SECONDS_PER_HOUR;
                cell.veh_km += state.speed * step / METRES_PER_KM;
            }
        }
        for change in changes {
            cells.entry((change.from, interval(change.time))).or_default().changes += 1;
        }
        let Some((first, last)) = matched.recording.frames() else { return };
        let [begins, ends] = [first, last + 1].map(|it| it as f64 * step);
        let mut densities = vec![Exposure::default(); DENSITIES.len() + 1];
        for ((lanelet, number), cell) in &cells {
            let length = matched.network.lanelets[lanelet.at()].length() / METRES_PER_KM;
            let [from, to] = [*number, number + 1].map(|it| it as f64 * INTERVAL);
            // The first and the last minute are seen in part.
            let seen = to.min(ends) - from.max(begins);
            let density = cell.veh_h * SECONDS_PER_HOUR / seen / length;
            densities[DENSITIES.partition_point(|it| *it <= density)].add(cell);
            self.lanes.entry(*lanelet).or_default().add(cell);
            self.veh_h += cell.veh_h;
        }
        self.densities = [0.0].into_iter().chain(DENSITIES).zip(densities).collect();
    }

    /// Looks at all drivers once a second.
    fn note_free_flow(&mut self, matched: &Matched, replay: &Replay) {
        const EVERY: f64 = 1.0;
        let every = (EVERY / matched.recording.step).round().max(1.0) as i64;
        for number in matched.recording.frames_by(every) {
            let frame = replay.frame(number);
            let scene = frame.scene();
            for spot in frame.vehicles().filter_map(|it| frame.spot(it)) {
                let speed = scene.motion(spot).speed;
                let is_free = scene.ahead(scene.viewpoint(spot)).is_none_or(|it| it.gap > FREE * speed);
                let time = every as f64 * matched.recording.step / SECONDS_PER_HOUR;
                self.free_veh_h += if is_free { time } else { 0.0 };
            }
        }
    }
}

impl Exposure {
    fn add(&mut self, other: &Exposure) {
        let Exposure { veh_km, veh_h, changes } = other;
        (self.veh_km, self.veh_h, self.changes) =
            (self.veh_km + veh_km, self.veh_h + veh_h, self.changes + changes);
    }
}
