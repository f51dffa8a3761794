//! A recording on its map.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use laneweave::maps::Map;
use laneweave::network::Network;
use laneweave::recordings::{LaneChange, Matched, Recording, RoadUser, State, Track, clean, lane_changes};
use laneweave::scenario::{MapOptions, driven, open_map};
use laneweave::{Fault, Side, VehicleId, open_recordings};

use super::driver::DriverFacts;
use super::hands::{Hand, Hands};
use super::saved::Saved;
use super::{Abilities, Hello, Kind, Mark, MarkKind, Marks, Source, TwinFacts, Wants};
use crate::scene::{Scene, Surroundings};
use crate::snapshot::{Body, Seen, Snapshot};

/// A recorded vehicle is taken to signal this long before its centre crosses the line [s]. Ours: signals are not
/// recorded.
const SIGNALS_BEFORE: f64 = 2.0;
/// The same for the time after it [s].
const SIGNALS_AFTER: f64 = 1.0;
/// A recorded vehicle is taken to brake below this acceleration [m/s²]. Ours.
const BRAKES: f64 = -0.7;
/// Accelerations are measured over this time before and after [s].
const REACH: f64 = 0.3;

/// A recording on its map.
pub struct Recorded {
    title: String,
    network: Network,
    around: Surroundings,
    recording: Recording,
    changes: Vec<LaneChange>,
    marks: Arc<Mutex<Marks>>,
    /// The first and the last frame.
    frames: (i64, i64),
    frame: i64,
    /// Tracks in the order of their first frames, with their last ones.
    order: Vec<(i64, i64, usize)>,
}

impl Recorded {
    /// The recordings at `paths`, joined, on the map at `map`.
    ///
    /// # Errors
    /// If one of them cannot be read.
    pub fn open(
        paths: &[PathBuf],
        map: &Path,
        columns: Option<&Path>,
        options: &MapOptions,
    ) -> Result<Recorded, Fault> {
        let map = open_map(map, options)?;
        let (mut recording, _) = open_recordings(paths, columns)?;
        recording.place(map.origin);
        let title = paths
            .first()
            .and_then(|it| it.file_name())
            .map_or_else(String::new, |it| it.to_string_lossy().into_owned());
        Recorded::new(title, &map, recording)
    }

    /// A recording on a map.
    ///
    /// # Errors
    /// If it has no road users.
    pub fn new(title: String, map: &Map, recording: Recording) -> Result<Recorded, Fault> {
        let (recording, _) = clean(recording);
        let frames = recording.frames().ok_or_else(|| {
            Fault::new(&title, "the recording has no road users", "choose another recording")
        })?;
        let (network, _) = driven(map);
        let changes = lane_changes(&Matched::new(&network, &recording));
        let mut marks: Vec<Mark> = changes.iter().map(mark).collect();
        marks.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        let until_s = frames.1 as f64 * recording.step;
        let span =
            |(index, it): (usize, &Track)| Some((it.states.first()?.frame, it.states.last()?.frame, index));
        let mut order: Vec<(i64, i64, usize)> =
            recording.tracks.iter().enumerate().filter_map(span).collect();
        order.sort_unstable();
        Ok(Recorded {
            title,
            around: Surroundings::of(map),
            network,
            changes,
            marks: Arc::new(Mutex::new(Marks { until_s, marks })),
            frame: frames.0,
            frames,
            order,
            recording,
        })
    }

    /// The tracks that are there now, with their states.
    fn present(&self) -> impl Iterator<Item = (&Track, usize)> {
        let begun = self.order.partition_point(|it| it.0 <= self.frame);
        let there = self.order[..begun].iter().filter(|it| it.1 >= self.frame);
        there.filter_map(|(_, _, index)| {
            let track = &self.recording.tracks[*index];
            track.at(self.frame).map(|at| (track, at))
        })
    }

    /// Acceleration of a road user [m/s²].
    fn acceleration(&self, track: &Track, at: usize) -> f64 {
        let reach = (REACH / self.recording.step).round().max(1.0) as usize;
        let (from, to) = (at.saturating_sub(reach), (at + reach).min(track.states.len() - 1));
        let (first, last) = (&track.states[from], &track.states[to]);
        let time = (last.frame - first.frame) as f64 * self.recording.step;
        if time > 0.0 { (last.speed - first.speed) / time } else { 0.0 }
    }

    /// The side to which a road user is about to change.
    fn signals(&self, track: &Track) -> Option<Side> {
        let now = self.time_s();
        let is_near = |it: &&LaneChange| {
            it.vehicle == track.id && now >= it.time - SIGNALS_BEFORE && now <= it.time + SIGNALS_AFTER
        };
        self.changes.iter().find(is_near).map(|it| it.side)
    }

    fn seen(&self, track: &Track, at: usize) -> Seen {
        let State { x, y, speed, heading, .. } = track.states[at];
        let signals = self.signals(track);
        Seen {
            id: track.id,
            at: [x, y, self.height()],
            heading,
            speed,
            length: track.length,
            width: track.width,
            body: body(track.class),
            style: 0,
            phase: if signals.is_some() { 2 } else { 0 },
            is_braking: self.acceleration(track, at) < BRAKES,
            signals,
            is_external: false,
            is_recorded: true,
            values: [0; 4],
        }
    }

    /// The height at which road users are shown, that of the first lanelet: recordings have no heights [m].
    fn height(&self) -> f64 {
        self.network.lanelets.first().and_then(|it| it.centre.points().first()).map_or(0.0, |it| it.z)
    }

    fn facts(&self, track: &Track, at: usize) -> DriverFacts {
        let State { x, y, speed, .. } = track.states[at];
        DriverFacts {
            id: self.recording.name(track.id),
            class: track.class.name(),
            speed_kmh: speed * 3.6,
            acceleration_mps2: Some(self.acceleration(track, at)),
            x,
            y,
            length_m: track.length,
            ..DriverFacts::default()
        }
    }
}

fn body(class: RoadUser) -> Body {
    match class {
        RoadUser::Car => Body::Car,
        RoadUser::Truck => Body::Truck,
        RoadUser::Bus => Body::Bus,
        RoadUser::Motorcycle => Body::Motorcycle,
        _ => Body::Other,
    }
}

fn mark(it: &LaneChange) -> Mark {
    Mark {
        kind: MarkKind::LaneChange,
        time_s: it.time,
        x: it.x,
        y: it.y,
        vehicle: it.vehicle.to_string(),
        other: None,
        side: Some(it.side.name()),
        text: Some(it.kind.name()),
    }
}

/// What was recorded cannot be changed.
fn is_fixed<T>(what: &str) -> Result<T, Fault> {
    Err(Fault::new(what, "what was recorded cannot be changed", "simulate the map: laneweave view MAP"))
}

impl Source for Recorded {
    fn scene(&self) -> Scene {
        Scene::new(&self.title, &self.network, &self.around)
    }

    fn hello(&self) -> Hello {
        let step_s = self.step_s();
        let [begin_s, end_s] = [self.frames.0, self.frames.1].map(|it| it as f64 * step_s);
        Hello {
            version: 1,
            kind: Kind::Recording,
            title: self.title.clone(),
            step_s,
            time_s: self.time_s(),
            begin_s,
            end_s: Some(end_s),
            can: Abilities { hands: false, seek: true, explain: false, twin: false },
            styles: Vec::new(),
            demand: Vec::new(),
        }
    }

    fn step_s(&self) -> f64 {
        self.recording.step
    }

    fn time_s(&self) -> f64 {
        self.frame as f64 * self.recording.step
    }

    fn step(&mut self, marks: &mut Vec<Mark>) -> Result<(), Fault> {
        if self.has_ended() {
            return Ok(());
        }
        let before = self.time_s();
        self.frame += 1;
        let now = self.time_s();
        let happened = self.changes.iter().filter(|it| it.time > before && it.time <= now);
        marks.extend(happened.map(mark));
        Ok(())
    }

    fn has_ended(&self) -> bool {
        self.frame >= self.frames.1
    }

    fn seek(&mut self, time_s: f64) -> Result<(), Fault> {
        let frame = (time_s / self.recording.step).round() as i64;
        self.frame = frame.clamp(self.frames.0, self.frames.1);
        Ok(())
    }

    fn see(&self, wants: &Wants, snapshot: &mut Snapshot) {
        snapshot.time_s = self.time_s();
        for (track, at) in self.present() {
            snapshot.vehicles.push(self.seen(track, at));
            if wants.selected.contains(&track.id) {
                let text = serde_json::to_string(&self.facts(track, at)).ok();
                snapshot.drivers.extend(text.map(|it| (track.id, Arc::from(it))));
            }
        }
    }

    fn find(&self, id: i64) -> Option<[f64; 2]> {
        let (track, at) = self.present().find(|(track, _)| track.id == id)?;
        Some([track.states[at].x, track.states[at].y])
    }

    fn marks(&self) -> Option<Arc<Mutex<Marks>>> {
        Some(Arc::clone(&self.marks))
    }

    fn hand(&mut self, _: &Hand) -> Result<Option<VehicleId>, Fault> {
        is_fixed("by hand")
    }

    fn undo(&mut self) -> Result<(), Fault> {
        is_fixed("undo")
    }

    fn twin(&mut self, _: bool) -> Result<(), Fault> {
        is_fixed("twin")
    }

    fn twin_facts(&self) -> Option<TwinFacts> {
        None
    }

    fn hands(&self) -> Hands {
        Hands::default()
    }

    fn news_of_hands(&mut self) -> Option<Hands> {
        None
    }

    fn save(&self) -> Result<Saved, Fault> {
        is_fixed("save")
    }

    fn state_hash(&self) -> u64 {
        self.frame as u64
    }
}
