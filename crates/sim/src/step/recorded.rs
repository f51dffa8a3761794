//! Recorded vehicles: a recording puts them on the road, moves them, and takes them off. Some of them become drivers
//! who react.
//!
//! Everything here happens at once, between two steps. It is no command of a user.

use laneweave_models::Style;
use laneweave_models::follow::Pace;
use laneweave_network::{ChainIndex, Footprint, Point, Pose, Position, Rectangle};

use crate::record::lanelet_aggregates::Mark;
use crate::record::trip_log::TripRecord;
use crate::route::roads::Roads;
use crate::state::control::Control;
use crate::state::externals::{self, External};
use crate::state::lane::{Entry, VehicleId};
use crate::state::setup::Placement;
use crate::state::vehicle::Class;
use crate::step::carry_out::CarryingOut;
use crate::step::change_roads::desire_speed;
use crate::step::command::check_control;
use crate::step::command_error::{CommandError, in_range};
use crate::step::insert::{Body, in_the_way};
use crate::step::move_externals::{limit_speeds, main_lane, on_one_level, settle};
use crate::step::names;
use crate::step::obstacle::Moved;
use crate::step::put_vehicle::entry;
use crate::step::relocate::Relocating;
use crate::step::world::World;

/// The least and the greatest length or width of a recorded vehicle [m].
const SIZES: [f64; 2] = [0.1, 60.0];

/// A recorded vehicle as it comes onto the road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedVehicle {
    /// Its class. It decides how a driver would drive it.
    pub class: Class,
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// Where it is.
    pub pose: RecordedPose,
}

/// Where a recorded vehicle is at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordedPose {
    /// Centre, to the east [m].
    pub x: f64,
    /// Centre, to the north [m].
    pub y: f64,
    /// Heading, counter-clockwise from east [rad].
    pub heading: f64,
    /// Speed along the heading [m/s].
    pub speed: f64,
}

impl RecordedPose {
    fn control(self) -> Control {
        let RecordedPose { x, y, heading, speed } = self;
        Control::Pose { x, y, heading, speed }
    }
}

impl World {
    /// Puts a recorded vehicle where it is now, in a lane or off the road, and returns its id. It stays there until it
    /// is moved. A driver is drawn for it from the population of the demand: other drivers expect it to drive like
    /// that.
    ///
    /// # Errors
    /// If a number is not in its range.
    pub fn put_recorded(&mut self, vehicle: &RecordedVehicle) -> Result<VehicleId, CommandError> {
        let RecordedVehicle { class, length, width, pose } = *vehicle;
        check_control(pose.control())?;
        in_range("a length", length, SIZES, "m")?;
        in_range("a width", width, SIZES, "m")?;
        let World { roads, traffic, junctions, arrivals, log, index, work, .. } = self;
        let heading = pose.heading;
        let mut rectangle =
            Rectangle { pose: Pose { at: Point::new(pose.x, pose.y, 0.0), heading }, length, width };
        let (footprints, at) = footprints(roads, &mut rectangle);
        let (id, clock) = (arrivals.new_inserted(), traffic.clock());
        let placement = Placement {
            chain: at.chain,
            x: at.x,
            speed: pose.speed,
            class,
            parameters: arrivals.draw_driver(&roads.random(), id),
            destination: roads.navigator().seen_by(class, None),
        };
        log.begin_trip(id, None, || TripRecord {
            arrived: clock.time(),
            entered: clock.time(),
            from: at,
            speed: pose.speed,
            mark: Mark { x: at.x, time: clock.time() },
            ..TripRecord::of(id, class, placement.parameters)
        });
        log.note_inserted(id);
        let mut entry: Entry = entry(roads, clock, &placement, id);
        entry.driver.is_external = true;
        let mut external = External::new(id, pose.control(), at);
        external.is_recorded = true;
        let Rectangle { pose: centre, .. } = rectangle;
        external.body =
            Some(externals::Body { pose: centre, length, width, speed: pose.speed, off_road: Some(entry) });
        let (speed, has_known_speed) = (pose.speed, true);
        let moved = Moved { rectangle, before: None, speed, has_known_speed, way: 0.0 };
        let mut relocating = Relocating { roads, traffic, junctions, log, work };
        settle(&mut relocating, &mut external, &mut entry, &moved, &footprints);
        limit_speeds(traffic, &external);
        traffic.externals_mut().add(external);
        index.forget();
        Ok(id)
    }

    /// Whether a driver could come onto the road in place of a recorded vehicle that is not there yet: neither it nor
    /// its follower would have to brake harder than vehicles can. There is room for a vehicle in no lane.
    pub fn has_room(&self, vehicle: &RecordedVehicle) -> bool {
        let RecordedVehicle { class, length, width, pose } = *vehicle;
        let at = Pose { at: Point::new(pose.x, pose.y, 0.0), heading: pose.heading };
        let rectangle = Rectangle { pose: at, length, width };
        let footprints = self.roads.ground().footprints(&rectangle);
        let Some(number) = main_lane(&self.roads, &rectangle, &footprints, None) else { return true };
        let Footprint { chain, to: x, .. } = footprints[number];
        let destination = self.roads.navigator().seen_by(class, None);
        let body = Body { chain, x, length, speed: pose.speed, destination, is_long: class.is_long() };
        in_the_way(self, &body).is_none()
    }

    /// Moves a recorded vehicle: it is at `pose` at the end of the next step. Returns whether it could be moved: not so
    /// if its number is not in its range, if it has left the road, or if it has become a driver.
    pub fn move_recorded(&mut self, id: VehicleId, pose: RecordedPose) -> bool {
        let external = self.traffic.externals_mut().of_mut(id).filter(|it| it.body.is_some());
        let Some(external) = external.filter(|_| check_control(pose.control()).is_ok()) else { return false };
        external.control = pose.control();
        true
    }

    /// Takes a recorded vehicle off the road. Its trip does not count as completed.
    pub fn remove_recorded(&mut self, id: VehicleId) {
        if self.traffic.externals().of(id).is_some() {
            self.carrying_out().remove(id);
            self.index.forget();
        }
    }

    /// Lets a recorded vehicle become a driver who reacts, in the lane in which it is and at its speed, with these
    /// driver parameters. It drives to the destination with this smallest lanelet id, if it can; otherwise it follows
    /// the road. Returns whether it has become one: not so while it is in no lane, or in a lane that leads nowhere.
    ///
    /// # Panics
    /// If there are no such driver parameters.
    pub fn release_recorded(&mut self, id: VehicleId, destination: Option<i64>, parameters: u32) -> bool {
        let is_recorded = self.traffic.externals().body(id).is_some_and(|it| it.off_road.is_none());
        let Some(spot) = self.index.spot(self.traffic.lanes(), id).filter(|_| is_recorded) else {
            return false;
        };
        let number = destination.and_then(|it| names::destination(self.demand(), it));
        let (navigator, network) = (self.roads.navigator(), self.roads.network());
        let x = self.traffic.lane(spot.chain).motions()[spot.index].x;
        let class = self.traffic.lane(spot.chain).drivers()[spot.index].class;
        let seen = navigator.seen_by(class, number);
        let leads_on = navigator.waypoint_from(network, seen, spot.chain, x).leads_on(x);
        let onward = navigator.waypoint_from(network, navigator.seen_by(class, None), spot.chain, x);
        if !leads_on && !onward.leads_on(x) {
            return false;
        }
        assert!(
            (parameters as usize) < self.driver_parameters().len(),
            "there are no such driver parameters"
        );
        self.carrying_out().control(id, Control::DRIVER);
        self.carrying_out().set_destination(id, number.filter(|_| leads_on));
        let scene = self.scene();
        let gap = scene.ahead(scene.viewpoint(spot)).map_or(f64::INFINITY, |it| it.gap);
        let (roads, at) = (&self.roads, Position::new(spot.chain, x));
        let (motion, driver, _) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        driver.parameters = parameters;
        motion.headway_relaxation = accepted_headway(roads.style(parameters), motion.speed, gap) as f32;
        driver.desired = motion.speed as f32;
        desire_speed(driver, roads.outlook(driver).fitting_speed(at, 0.0) as f32);
        self.index.forget();
        true
    }

    fn carrying_out(&mut self) -> CarryingOut<'_> {
        let World { roads, traffic, junctions, arrivals, log, index, .. } = self;
        CarryingOut { roads, traffic, junctions, arrivals, log, index }
    }
}

/// The share of its usual headway that a driver accepts who is found at this `gap` [m], as if it had just changed
/// lanes.
fn accepted_headway(style: &Style, speed: f64, gap: f64) -> f64 {
    /// A driver who desires so much more than its speed keeps its usual gap [m/s].
    const HELD_UP: f64 = 10.0;
    let usual = style.follow.equilibrium_gap(Pace::new(speed, speed + HELD_UP));
    (gap / usual).clamp(style.manner.headway_relaxation(1.0), 1.0)
}

/// The stretches of lanes that a new vehicle touches, on the level of the lane along which it drives, and its place
/// there; in no lane, any place.
fn footprints(roads: &Roads, rectangle: &mut Rectangle) -> (Vec<Footprint>, Position) {
    let all = roads.ground().footprints(rectangle);
    let best = main_lane(roads, rectangle, &all, None).map(|it| &all[it]);
    rectangle.pose.at.z = best.or(all.first()).map_or(0.0, |it| it.height);
    let at = best.map_or(Position::new(ChainIndex(0), 0.0), |it| Position::new(it.chain, it.to));
    (on_one_level(roads, rectangle), at)
}
