//! What the vehicle knows of itself and of its way.

use std::f64::consts::PI;

use laneweave::network::{LightState, PlaceKind, Side, Sign, turn};
use laneweave::sim::Vehicle;
use laneweave::{Phase, Simulation};

use super::scaled;
use super::vehicles::{LEFT, SPEED};

/// The columns of a vehicle itself. All are between −1 and 1; the number behind a slash is what is 1.
pub const OWN_COLUMNS: [&str; 14] = [
    "speed_mps/40",
    "speed_limit_mps/40",
    "acceleration_mps2/8",
    "offset_m/10",
    "heading_rad/pi",
    "length_m/20",
    "is_left_open",
    "is_right_open",
    "lane_change",
    "necessary_changes/4",
    "last_place_m/300",
    "junction_m/300",
    "light_is_closed",
    "end_m/300",
];

/// Acceleration [m/s²], length [m] and changes that are 1.
const ACCELERATION: f64 = 8.0;
const LENGTH: f64 = 20.0;
const CHANGES: f64 = 4.0;
/// Distance ahead that is 1 [m].
const AHEAD: f64 = 300.0;

pub(super) fn row(simulation: &Simulation, ego: &Vehicle) -> [f32; OWN_COLUMNS.len()] {
    let (network, x) = (simulation.network(), ego.x());
    let chain = network.chain(ego.spot.chain);
    let [length, _] = ego.size();
    let is_open = |side: Side| {
        let beside =
            chain.beside(side, x).filter(|it| network.chain(it.chain).takes(it.across(x), ego.driver.class));
        f64::from(u8::from(beside.is_some()))
    };
    let side = ego.lane_change.side.sign();
    let lane_change = if ego.driver.phase == Phase::Cruises { 0.0 } else { side };
    let waypoint = simulation.scene().navigator.waypoint(ego.driver.goal.destination(), ego.spot.chain);
    let way = Way::of(simulation, ego);
    let heading = turn(chain.centre.heading(x), ego.pose().heading);
    [
        scaled(ego.speed(), SPEED),
        scaled(chain.limit(x), SPEED),
        scaled(f64::from(ego.motion.acceleration), ACCELERATION),
        scaled(ego.lateral_offset(), LEFT),
        scaled(heading, PI),
        scaled(length, LENGTH),
        is_open(Side::Left) as f32,
        is_open(Side::Right) as f32,
        lane_change as f32,
        scaled(f64::from(waypoint.changes), CHANGES),
        scaled(waypoint.last_place - x, AHEAD),
        scaled(way.junction, AHEAD),
        f32::from(u8::from(way.is_closed)),
        scaled(way.end, AHEAD),
    ]
}

/// What lies ahead on the way of a vehicle.
struct Way {
    /// Distance to the next line or conflict area [m]; [`AHEAD`] if there is none so near.
    junction: f64,
    /// The light there is not green.
    is_closed: bool,
    /// Distance to the end of the last lane of the way [m].
    end: f64,
}

impl Way {
    fn of(simulation: &Simulation, ego: &Vehicle) -> Way {
        let (network, scene) = (simulation.network(), simulation.scene());
        let mut way = Way { junction: AHEAD, is_closed: false, end: -ego.x() };
        let mut next = Some(ego.spot.chain);
        while let Some(chain) = next.filter(|_| way.end < AHEAD) {
            let places = &network.junctions.on(chain).places;
            if let Some(place) = places.iter().find(|it| way.end + it.station > 0.0)
                && way.end + place.station < way.junction
            {
                way.junction = way.end + place.station;
                let is_closed = |it| simulation.scene().light(it) != LightState::Green;
                way.is_closed = matches!(place.what, PlaceKind::Sign(Sign::Light(it)) if is_closed(it));
            }
            way.end += network.chain(chain).length;
            next = scene.next(ego.driver.goal.destination(), chain);
        }
        way
    }
}
