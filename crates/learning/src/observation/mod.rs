//! What a program sees of the traffic around its vehicle: numbers of a size near 1, in the frame of the lane.

mod grid;
mod lanes;
mod own;
mod vehicles;

use laneweave::sim::Vehicle;
use laneweave::{Fault, Simulation};
use serde::{Deserialize, Serialize};

pub use grid::Grid;
pub use lanes::{LANELET_COLUMNS, LINK_COLUMNS, Lanes};
pub use own::OWN_COLUMNS;
pub use vehicles::VEHICLE_COLUMNS;

use crate::task::wrong;
use vehicles::Seen;

/// What a program sees. The first part is always the vehicle itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Observation {
    /// The nearest vehicles.
    Kinematics {
        /// How many of them.
        #[serde(default = "eight")]
        nearest: usize,
    },
    /// Which cells around the vehicle are occupied.
    Grid(Grid),
    /// The nearest vehicles, and the lanelets around with how they are linked.
    Lanes(Lanes),
}

fn eight() -> usize {
    8
}

impl Default for Observation {
    fn default() -> Observation {
        Observation::Kinematics { nearest: eight() }
    }
}

/// A part of an observation: numbers that belong together.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Part {
    /// Its name.
    pub name: &'static str,
    /// Its extent along each axis.
    pub shape: Vec<usize>,
    /// What the places along its last axis mean, where that is not one thing.
    pub columns: Vec<String>,
}

impl Part {
    fn new(name: &'static str, shape: &[usize], columns: &[&str]) -> Part {
        Part { name, shape: shape.to_vec(), columns: columns.iter().map(ToString::to_string).collect() }
    }

    /// How many numbers it has.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.shape.iter().product()
    }
}

impl Observation {
    /// The parts of an observation, which follow each other.
    #[must_use]
    pub fn parts(&self) -> Vec<Part> {
        let own = Part::new("own", &[OWN_COLUMNS.len()], &OWN_COLUMNS);
        let vehicles = |nearest| Part::new("vehicles", &[nearest, VEHICLE_COLUMNS.len()], &VEHICLE_COLUMNS);
        match self {
            Observation::Kinematics { nearest } => vec![own, vehicles(*nearest)],
            Observation::Grid(grid) => vec![own, grid.part()],
            Observation::Lanes(lanes) => {
                let [lanelets, links] = lanes.parts();
                vec![own, vehicles(lanes.nearest), lanelets, links]
            }
        }
    }

    /// How many numbers an observation has.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.parts().iter().map(Part::numbers).sum()
    }

    /// # Errors
    /// If a number is not in its range.
    pub(crate) fn check(&self) -> Result<(), Fault> {
        /// Most vehicles that are seen.
        const MOST: usize = 256;
        let nearest = match self {
            Observation::Kinematics { nearest } => *nearest,
            Observation::Grid(grid) => return grid.check(),
            Observation::Lanes(lanes) => {
                lanes.check()?;
                lanes.nearest
            }
        };
        if (1..=MOST).contains(&nearest) {
            return Ok(());
        }
        Err(wrong("observation.nearest", &format!("{nearest} vehicles"), "choose 1 to 256"))
    }

    /// Writes what the vehicle `ego` of a simulation sees into `numbers`, of which all are 0.
    pub(crate) fn write(
        &self,
        simulation: &Simulation,
        ego: &Vehicle,
        memory: &mut Memory,
        numbers: &mut [f32],
    ) {
        let (own, others) = numbers.split_at_mut(OWN_COLUMNS.len());
        own.copy_from_slice(&own::row(simulation, ego));
        let frame = vehicles::Frame::of(simulation, ego);
        match self {
            Observation::Kinematics { nearest } => {
                vehicles::write(simulation, ego, &frame, *nearest, memory, others)
            }
            Observation::Grid(grid) => grid.write(simulation, ego, &frame, others),
            Observation::Lanes(lanes) => {
                let (nearest, rest) = others.split_at_mut(lanes.nearest * VEHICLE_COLUMNS.len());
                vehicles::write(simulation, ego, &frame, lanes.nearest, memory, nearest);
                lanes.write(simulation, ego, &frame, rest);
            }
        }
    }
}

/// What is kept from one observation to the next, so that it needs no new memory.
#[derive(Default)]
pub(crate) struct Memory {
    seen: Vec<Seen>,
}

/// A number of a size near 1.
fn scaled(value: f64, scale: f64) -> f32 {
    (value / scale).clamp(-1.0, 1.0) as f32
}
