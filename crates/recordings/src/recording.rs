//! Recorded traffic: who was where, and when.

/// Recorded traffic in the metric frame of its map.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Time between frames [s].
    pub step: f64,
    /// Road users, each once.
    pub tracks: Vec<Track>,
}

/// One road user through its frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its id in the recording.
    pub id: i64,
    /// What it is.
    pub class: RoadUser,
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// In order of frames, each frame at most once.
    pub states: Vec<State>,
}

/// Where a road user is in one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Number of the frame: time is frame × step.
    pub frame: i64,
    /// East of the centre [m].
    pub x: f64,
    /// North of the centre [m].
    pub y: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Counter-clockwise from east [rad].
    pub heading: f64,
}

/// What a road user is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RoadUser {
    /// A car or van.
    Car,
    /// A lorry.
    Truck,
    /// A bus.
    Bus,
    /// A motorcycle.
    Motorcycle,
    /// A bicycle.
    Bicycle,
    /// Somebody on foot.
    Pedestrian,
    /// Anything else.
    Other,
}
