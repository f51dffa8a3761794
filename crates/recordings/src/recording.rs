//! Recorded traffic as plain data.

use std::collections::{BTreeMap, HashSet};

use laneweave_maps::lanelet2::utm;
use serde::Deserialize;

/// Recorded traffic in the metric frame of its map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Time between frames [s].
    pub step: f64,
    /// The road users. Parts of a track that was interrupted have the same id.
    pub tracks: Vec<Track>,
    /// By the id of its track, what the file has as an id where that is no number.
    pub names: BTreeMap<i64, String>,
    /// East and north of the origin of its positions in the UTM zone of the place [m], where the file gives it.
    pub utm_origin: Option<[f64; 2]>,
}

/// One road user through its frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its id in the file, or a number in its place.
    pub id: i64,
    /// Its class.
    pub class: RoadUser,
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// In order of frames, each frame at most once.
    pub states: Vec<State>,
}

/// The state of a road user in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Number of the frame: its time is frame × step.
    pub frame: i64,
    /// Centre, east [m].
    pub x: f64,
    /// Centre, north [m].
    pub y: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Counter-clockwise from east [rad].
    pub heading: f64,
}

/// The class of a road user.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RoadUser {
    /// A passenger car or van.
    Car,
    /// A truck or lorry.
    Truck,
    /// A bus.
    Bus,
    /// A motorcycle.
    Motorcycle,
    /// A bicycle.
    Bicycle,
    /// A pedestrian.
    Pedestrian,
    /// Anything else, or unknown.
    Other,
}

impl RoadUser {
    /// Whether it drives on lanes by the rules of motor traffic.
    pub fn is_vehicle(self) -> bool {
        matches!(self, RoadUser::Car | RoadUser::Truck | RoadUser::Bus | RoadUser::Motorcycle)
    }

    /// All of them.
    pub const ALL: [RoadUser; 7] = [
        RoadUser::Car,
        RoadUser::Truck,
        RoadUser::Bus,
        RoadUser::Motorcycle,
        RoadUser::Bicycle,
        RoadUser::Pedestrian,
        RoadUser::Other,
    ];

    /// The one with this name.
    pub fn of_name(name: &str) -> Option<RoadUser> {
        RoadUser::ALL.into_iter().find(|it| it.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            RoadUser::Car => "car",
            RoadUser::Truck => "truck",
            RoadUser::Bus => "bus",
            RoadUser::Motorcycle => "motorcycle",
            RoadUser::Bicycle => "bicycle",
            RoadUser::Pedestrian => "pedestrian",
            RoadUser::Other => "other",
        }
    }

    /// Usual length and width [m], where the size is not known. Ours.
    pub fn usual_size(self) -> (f64, f64) {
        match self {
            RoadUser::Car => (4.5, 1.8),
            RoadUser::Truck => (10.0, 2.5),
            RoadUser::Bus => (12.0, 2.55),
            RoadUser::Motorcycle => (2.2, 0.8),
            RoadUser::Bicycle => (1.8, 0.6),
            RoadUser::Pedestrian | RoadUser::Other => (0.6, 0.6),
        }
    }
}

impl Recording {
    /// Moves its positions into the frame of a map with its (0, 0) at this latitude and longitude [°]. Without both
    /// origins it stays where it is.
    pub fn place(&mut self, origin: Option<(f64, f64)>) {
        let there = origin.and_then(|(latitude, longitude)| utm(latitude, longitude));
        let Some(([x, y], there)) = self.utm_origin.zip(there) else { return };
        let (east, north) = (x - there[0], y - there[1]);
        for state in self.tracks.iter_mut().flat_map(|it| &mut it.states) {
            (state.x, state.y) = (state.x + east, state.y + north);
        }
        self.utm_origin = Some(there);
    }

    /// The id of a track as the file has it.
    pub fn name(&self, id: i64) -> String {
        self.names.get(&id).cloned().unwrap_or_else(|| id.to_string())
    }

    /// Every `every`-th frame from the first one on, as far as somebody is there.
    pub fn frames_by(&self, every: i64) -> Vec<i64> {
        let Some((first, _)) = self.frames() else { return Vec::new() };
        let all = self.tracks.iter().flat_map(|it| &it.states).map(|it| it.frame);
        let mut frames: Vec<i64> = all.filter(|it| (it - first) % every == 0).collect();
        frames.sort_unstable();
        frames.dedup();
        frames
    }

    /// Ids that no track has.
    pub fn free_ids(&self) -> impl Iterator<Item = i64> + use<> {
        free_ids(self.tracks.iter().map(|it| it.id).collect())
    }

    /// First and last frame with a road user.
    pub fn frames(&self) -> Option<(i64, i64)> {
        let first = self.tracks.iter().filter_map(|it| it.states.first()).map(|it| it.frame).min()?;
        let last = self.tracks.iter().filter_map(|it| it.states.last()).map(|it| it.frame).max()?;
        Some((first, last))
    }
}

impl Track {
    /// The index in `states` of its state in `frame`.
    pub fn at(&self, frame: i64) -> Option<usize> {
        self.states.binary_search_by_key(&frame, |it| it.frame).ok()
    }
}

/// Numbers beyond all `taken` ones, or, where one of those is very large, between them.
pub(crate) fn free_ids(taken: HashSet<i64>) -> impl Iterator<Item = i64> {
    /// Larger numbers are not exact everywhere.
    const LARGE: i64 = 1 << 52;
    let last = taken.iter().max().copied().unwrap_or(0);
    let first = if last < LARGE { last.max(0) + 1 } else { 1 };
    (first..).filter(move |it| !taken.contains(it))
}
