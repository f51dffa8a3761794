//! What can be seen at one time: all vehicles, and what the lights show.

use std::collections::BTreeMap;
use std::sync::Arc;

use laneweave::sim::FIRST_OBSTACLE;
use laneweave::{LightState, Side};
use serde::Deserialize;

use crate::recent::Recent;

/// The class of a road user, as a number of the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Body {
    /// A car.
    Car = 1,
    /// A truck.
    Truck = 2,
    /// A bus.
    Bus = 3,
    /// A motorcycle.
    Motorcycle = 4,
    /// Something else, such as a bicycle.
    Other = 5,
}

/// A vehicle at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Its id.
    pub id: i64,
    /// Position of its centre on the map: east, north, up [m].
    pub at: [f64; 3],
    /// Heading, counter-clockwise from east [rad].
    pub heading: f64,
    /// Speed [m/s].
    pub speed: f64,
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// Its class.
    pub body: Body,
    /// Index of the style of its driver; 0 if it has none.
    pub style: u8,
    /// Phase of its lane change: 0 cruises, 1 wants, 2 changes, 3 aborts.
    pub phase: u8,
    /// Its brake lights are on.
    pub is_braking: bool,
    /// The side to which it signals.
    pub signals: Option<Side>,
    /// A user drives it.
    pub is_external: bool,
    /// It moves as it was recorded.
    pub is_recorded: bool,
    /// What its colour may show, one of [`Colour`] each.
    pub values: [u8; 4],
}

impl Seen {
    /// Whether it is a ghost: a vehicle of the twin.
    pub fn is_ghost(&self) -> bool {
        self.is_external && self.is_recorded
    }

    /// Whether it is no vehicle, but an obstacle.
    pub fn is_obstacle(&self) -> bool {
        self.id >= i64::from(FIRST_OBSTACLE)
    }
}

/// What the colour of a vehicle may show beside what is always sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Colour {
    /// Nothing more.
    #[default]
    Style,
    /// How much more than its threshold the better side has to offer.
    Desire,
    /// Time lost on its trip.
    Delay,
    /// Time since its last lane change.
    SinceChange,
    /// How far it is from where it is in the twin.
    Difference,
}

impl Colour {
    /// The byte that a frame has for a vehicle.
    pub fn of(self, vehicle: &Seen) -> u8 {
        match self {
            Colour::Style => 0,
            Colour::Desire => vehicle.values[0],
            Colour::Delay => vehicle.values[1],
            Colour::SinceChange => vehicle.values[2],
            Colour::Difference => vehicle.values[3],
        }
    }
}

/// What can be seen at one time.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// Its number: later ones have greater numbers.
    pub number: u32,
    /// Its time [s].
    pub time_s: f64,
    /// All vehicles.
    pub vehicles: Vec<Seen>,
    /// What the lights show, in the order of the scene.
    pub lights: Vec<LightState>,
    /// What the lights of the twin show, if it is shown.
    pub twin_lights: Vec<LightState>,
    /// Vehicles that wait to enter.
    pub waiting: usize,
    /// What has happened a short while ago.
    pub recent: Recent,
    /// Whether time goes on by itself.
    pub is_playing: bool,
    /// How many times as fast as reality; none: as fast as it goes.
    pub factor: Option<f64>,
    /// What is said of the drivers that somebody has selected, by their ids.
    pub drivers: BTreeMap<i64, Arc<str>>,
    /// What is said of the lanes, if somebody wants it.
    pub lanes: Option<Arc<str>>,
}

impl Snapshot {
    /// What the lights show, a letter for each: g, y or r.
    pub fn lights_in_letters(&self) -> String {
        in_letters(&self.lights)
    }

    /// The same of the lights of the twin.
    pub fn twin_lights_in_letters(&self) -> String {
        in_letters(&self.twin_lights)
    }
}

fn in_letters(lights: &[LightState]) -> String {
    let letter = |it: &LightState| match it {
        LightState::Green => 'g',
        LightState::Yellow => 'y',
        LightState::Red => 'r',
    };
    lights.iter().map(letter).collect()
}
