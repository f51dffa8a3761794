//! Maps of our own, made from a few numbers.

mod own;
mod plan;
mod ramp;
mod sketch;

use laneweave_network::DrivingSide;
use thiserror::Error;

use crate::drawing::Drawing;
use plan::Plan;
use sketch::Sketch;

pub use own::own_maps;

/// A straight motorway to the east, cut into rows of lanelets at the same stations in all lanes.
///
/// Markings between lanes are dashed, the outer ones solid. The outer edge of the slow lane lies at y = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Motorway {
    /// Number of lanes: 1 to 12.
    pub lanes: usize,
    /// Length [m].
    pub length_m: f64,
    /// Speed limit [km/h]; on ramps 80 km/h at most.
    pub speed_limit_kmh: f64,
    /// Width of a lane [m].
    pub lane_width_m: f64,
    /// About how long the lanelets are [m].
    pub lanelet_length_m: f64,
    /// Where on-ramps meet the road [m]: a ramp of 200 m that becomes a lane of 250 m beside the slow one.
    pub on_ramp_at: Vec<f64>,
    /// Where off-ramps leave it [m]: a lane of 250 m beside the slow one that becomes a ramp of 200 m.
    pub off_ramp_at: Vec<f64>,
    /// Where the slow lane ends beside the others [m].
    pub lane_drop_at: Option<f64>,
    /// On which side traffic drives. Left is the mirror image of right, with y negated.
    pub driving_side: DrivingSide,
}

impl Default for Motorway {
    /// Three lanes of 5 km with 120 km/h, without ramps.
    fn default() -> Motorway {
        Motorway {
            lanes: 3,
            length_m: 5000.0,
            speed_limit_kmh: 120.0,
            lane_width_m: 3.5,
            lanelet_length_m: 100.0,
            on_ramp_at: Vec::new(),
            off_ramp_at: Vec::new(),
            lane_drop_at: None,
            driving_side: DrivingSide::Right,
        }
    }
}

/// Why a motorway cannot be built.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GenerateError {
    /// Too few or too many lanes.
    #[error("a motorway of {0} lanes; choose 1 to {max}", max = plan::MAXIMUM_LANES)]
    Lanes(usize),
    /// A number out of range, or none.
    #[error("{what} of {value} {unit}; choose {from} to {to} {unit}")]
    OutOfRange {
        /// What the number means.
        what: &'static str,
        /// The number.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// The least that is possible.
        from: f64,
        /// The most that is possible.
        to: f64,
    },
    /// More lanelets than make sense.
    #[error("about {0:.0} lanelets; choose fewer lanes, a shorter road or longer lanelets")]
    TooMany(f64),
    /// The only lane ends.
    #[error("the only lane cannot end; choose two lanes or no lane drop")]
    OnlyLaneEnds,
    /// A ramp or lane drop does not fit on the road.
    #[error("the {what} takes the road from {from} m to {to} m, of {length} m; move it or lengthen the road")]
    OutsideRoad {
        /// Which one.
        what: String,
        /// Where it begins [m].
        from: f64,
        /// Where it ends [m].
        to: f64,
        /// Length of the road [m].
        length: f64,
    },
    /// Two of them get in each other's way.
    #[error("the {0} and the {1} overlap or nearly touch; move one of them")]
    Overlap(String, String),
}

/// Draws a motorway.
///
/// Lanelets are numbered from 1 on, row by row along the road, in each from the slow lane to the fast one;
/// then ramps.
///
/// # Errors
/// If a number is out of range, or ramps and the lane drop do not fit on the road beside each other.
pub fn motorway(motorway: &Motorway) -> Result<Drawing, GenerateError> {
    let plan = Plan::of(motorway)?;
    let mut sketch = Sketch::new(motorway, &plan);
    for row in 0..plan.rows() {
        sketch.row(row);
    }
    for ramp in &plan.ramps {
        sketch.ramp(ramp);
    }
    Ok(sketch.drawing)
}
