//! A roundabout on its own.

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::canvas::Canvas;
use super::compass::Compass;
use super::layout::{Junction, Kind, Layout, Place, Street, draw};
use super::street::{Profile, pose};

/// Speed limit on the arms [km/h].
const ARM_SPEED_LIMIT: f64 = 50.0;
/// Length of the arms, from the middle [m].
const ARM: f64 = 200.0;

/// Draws a roundabout with four arms of a lane in each direction.
pub fn roundabout(driving_side: DrivingSide) -> Drawing {
    let street = |towards: Compass| {
        let (east, north) = towards.step();
        let edge = pose(ARM * east, ARM * north, towards.heading());
        let profile = Profile::street(1, 1, ARM_SPEED_LIMIT);
        Street { from: Place::Arm(0, towards), to: Place::Edge(edge), profile }
    };
    let layout = Layout {
        junctions: vec![Junction { at: (0.0, 0.0), kind: Kind::Roundabout }],
        streets: Compass::ALL.into_iter().map(street).collect(),
    };
    let mut canvas = Canvas::new();
    draw(&mut canvas, &layout);
    canvas.finish(driving_side)
}
