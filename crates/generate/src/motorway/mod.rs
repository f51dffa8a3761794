//! Motorways: straight, with ramps and a lane drop.

mod plan;
mod ramp;
mod sketch;

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::error::GenerateError;
use plan::Plan;
use sketch::Sketch;

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
    /// Approximate length of the lanelets [m].
    pub lanelet_length_m: f64,
    /// Where on-ramps meet the road [m]: a ramp of 200 m that continues as a lane of 250 m beside the slow lane.
    pub on_ramp_at: Vec<f64>,
    /// Where off-ramps leave it [m]: a lane of 250 m beside the slow lane that continues as a ramp of 200 m.
    pub off_ramp_at: Vec<f64>,
    /// A weaving section.
    pub weaving: Option<Weaving>,
    /// Where the slow lane ends beside the others [m].
    pub lane_drop_at: Option<f64>,
    /// On which side traffic drives. Left is the mirror image of right, with y negated.
    pub driving_side: DrivingSide,
}

/// An on-ramp and an off-ramp with one lane between them, beside the slow lane; traffic to and from the road weaves
/// on it. Both ramps are 200 m long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weaving {
    /// Where the on-ramp meets the road [m].
    pub from_m: f64,
    /// From there to where the off-ramp leaves it [m]: 100 to 1000.
    pub length_m: f64,
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
            weaving: None,
            lane_drop_at: None,
            driving_side: DrivingSide::Right,
        }
    }
}

impl Motorway {
    /// Two lanes with a weaving section of `length_m`, 1200 m after the beginning of the road and before its end.
    pub fn weaving(length_m: f64) -> Motorway {
        /// Length for the ramps, and for traffic to settle [m].
        const AROUND: f64 = 1200.0;
        Motorway {
            lanes: 2,
            length_m: 2.0 * AROUND + length_m,
            weaving: Some(Weaving { from_m: AROUND, length_m }),
            ..Motorway::default()
        }
    }
}

/// Draws a motorway.
///
/// Lanelets are numbered from 1 on, row by row along the road, in each row from the slow lane to the fast one; then
/// the ramps.
///
/// # Errors
/// If a number is out of range, or if ramps and the lane drop do not fit on the road side by side.
pub fn motorway(motorway: &Motorway) -> Result<Drawing, GenerateError> {
    let plan = Plan::of(motorway)?;
    let mut sketch = Sketch::new(motorway, &plan);
    for row in 0..plan.rows() {
        sketch.row(row);
    }
    for ramp in &plan.ramps {
        sketch.ramp(ramp);
    }
    Ok(sketch.finish())
}
