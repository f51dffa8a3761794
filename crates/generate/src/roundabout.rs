//! A roundabout on its own.

use std::f64::consts::TAU;

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::canvas::Canvas;
use super::error::{GenerateError, check_count, check_range};
use super::path::Path;
use super::ring::{Ring, RingArm, ring};
use super::street::{End, Profile, pose, street};

/// Speed limit on the arms [km/h].
const ARM_SPEED_LIMIT: f64 = 50.0;
/// Length of the arms, from the middle [m].
const ARM: f64 = 200.0;
/// Bounds of the number of arms.
const ARMS: [usize; 2] = [3, 6];
/// Bounds of the number of lanes.
const LANES: [usize; 2] = [1, 2];
/// Largest radius [m].
const LARGEST: f64 = 60.0;

/// A roundabout, and its arms at equal angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Roundabout {
    /// Number of arms: 3 to 6. The first one lies in the east.
    pub arms: usize,
    /// Lanes around the circle, and on each arm in each direction: 1 or 2. On two lanes, who enters on the left lane
    /// drives on the inner one, and each lane has an exit of its own to each arm.
    pub lanes: usize,
    /// Radius of the middle of the ring [m]; `None`: as small as usual for these arms and lanes.
    pub radius_m: Option<f64>,
    /// On which side traffic drives. Left is the mirror image of right, with y negated.
    pub driving_side: DrivingSide,
}

impl Default for Roundabout {
    /// One lane, four arms.
    fn default() -> Roundabout {
        Roundabout { arms: 4, lanes: 1, radius_m: None, driving_side: DrivingSide::Right }
    }
}

/// Draws a roundabout.
///
/// # Errors
/// If a number is out of range, or arms do not fit around a circle of this radius.
pub fn roundabout(wanted: &Roundabout) -> Result<Drawing, GenerateError> {
    let Roundabout { arms, lanes, radius_m, driving_side } = *wanted;
    check_count("arms", arms, ARMS)?;
    check_count("lanes", lanes, LANES)?;
    let least = Ring::usual_radius(arms, lanes);
    let radius = radius_m.unwrap_or(least);
    check_range("a radius", radius, "m", [least, LARGEST])?;
    let middle = (0.0, 0.0);
    let wanted = Ring::usual(middle, radius, lanes);
    let profile = Profile::street(lanes, lanes, ARM_SPEED_LIMIT);
    let mut canvas = Canvas::new();
    let headings = (0..arms).map(|it| TAU * it as f64 / arms as f64);
    let arms: Vec<RingArm> = headings
        .map(|heading| {
            let from = |it: f64| pose(it * libm::cos(heading), it * libm::sin(heading), heading);
            let path = Path::straight(from(wanted.setback()), ARM - wanted.setback());
            let [mouth, _] = street(&mut canvas, &path, &profile, [End::Junction, End::Open]);
            RingArm { heading, arriving: mouth.arriving, leaving: mouth.leaving }
        })
        .collect();
    ring(&mut canvas, wanted, &arms);
    Ok(canvas.finish(driving_side))
}
