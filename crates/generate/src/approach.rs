//! The road on which the paper explains its route incentive: three lanes before a junction, of which one leads left,
//! one left and straight on, and one straight on. The two roads beyond it meet again.

use laneweave_maps::Drawing;
use laneweave_network::DrivingSide;

use super::canvas::Canvas;
use super::compass::Compass::{East, North, South, West};
use super::control::Control;
use super::layout::{Junction, Kind, Layout, Place, Street, draw};
use super::movement::Movement;
use super::street::{Profile, pose};

/// Length of the three lanes, up to the middle of the junction [m].
const APPROACH: f64 = 515.0;
/// Length without lane changes before the junction [m].
const SOLID: f64 = 40.0;
/// Speed limit [km/h].
const SPEED_LIMIT: f64 = 50.0;
/// Distance from the junction north to where the left road turns east [m].
const NORTH: f64 = 220.0;
/// Distance east to where the roads meet again [m].
const EAST: f64 = 300.0;
/// Length of the roads beyond the last junction [m].
const BEYOND: f64 = 150.0;

/// Draws the approach, from the west to a junction at (0, 0): its path, between lanes A and B, is y = 0.
///
/// Lane A leads left, B left and straight on, C straight on. The left road and the straight road have two lanes and an
/// exit of their own; then the left one comes back from the north, and gives way, to a common exit in the east.
pub fn approach(driving_side: DrivingSide) -> Drawing {
    let one_way = |lanes| Profile::street(0, lanes, SPEED_LIMIT);
    let (a, b, c) = (0, 1, 2);
    let straight = |lane, onto| Movement { from: West, lane, to: East, onto };
    let left = |lane, onto| Movement { from: West, lane, to: North, onto };
    let fork = vec![left(a, 0), left(b, 1), straight(b, 0), straight(c, 1)];
    let northward = |lane, to, onto| Movement { from: South, lane, to, onto };
    let bend = vec![northward(0, North, 0), northward(0, East, 0), northward(1, East, 1)];
    let back = |lane| Movement { from: North, lane, to: East, onto: lane };
    let off = Movement { from: West, lane: 1, to: South, onto: 0 };
    let meeting = vec![straight(0, 0), straight(1, 1), off, back(0), back(1)];
    let junction = |at, control, movements| Junction { at, kind: Kind::Marked(control, movements) };
    let street = |from, to, lanes| Street { from, to, profile: one_way(lanes) };
    let layout = Layout {
        // At the first two junctions no paths meet, so no rules are needed.
        junctions: vec![
            junction((0.0, 0.0), Control::RightBeforeLeft, fork),
            junction((0.0, NORTH), Control::RightBeforeLeft, bend),
            junction((EAST, 0.0), Control::Priority, meeting),
        ],
        streets: vec![
            Street {
                from: Place::Edge(pose(-APPROACH, 0.0, East.heading())),
                to: Place::Arm(0, West),
                // The straight road continues from lanes B and C.
                profile: Profile { left_of_path: 1, solid: SOLID, ..one_way(3) },
            },
            street(Place::Arm(0, North), Place::Arm(1, South), 2),
            street(Place::Arm(0, East), Place::Arm(2, West), 2),
            street(Place::Arm(1, East), Place::Arm(2, North), 2),
            street(Place::Arm(1, North), Place::Edge(pose(0.0, NORTH + BEYOND, North.heading())), 1),
            street(Place::Arm(2, South), Place::Edge(pose(EAST, -BEYOND, South.heading())), 1),
            street(Place::Arm(2, East), Place::Edge(pose(EAST + BEYOND, 0.0, East.heading())), 2),
        ],
    };
    let mut canvas = Canvas::new();
    draw(&mut canvas, &layout);
    canvas.finish(driving_side)
}
