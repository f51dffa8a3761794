//! Recorded vehicles: a recording puts them on the road, moves them, and takes them off. Some of them become drivers
//! who react.
//!
//! Everything here happens at once, between two steps. It is no command of a user.

use laneweave_models::Style;
use laneweave_models::follow::{Ahead, CarFollowing, Pace};
use laneweave_network::{ChainIndex, Footprint, Id, Point, Pose, Position, Rectangle};

use crate::record::lanelet_aggregates::Mark;
use crate::record::trip_log::TripRecord;
use crate::route::roads::Roads;
use crate::state::control::{Control, Lateral, Longitudinal};
use crate::state::externals::{self, External, Kind};
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
        external.kind = Kind::Recorded;
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

    /// Where a driver could come onto the road in place of a recorded vehicle that is not there yet, so that neither it
    /// nor its follower would have to brake harder than vehicles can: where the vehicle is, or at most `most_behind`
    /// [m] behind that place in the middle of its lane. There is room for a vehicle in no lane.
    ///
    /// # Errors
    /// If there is no such place: the id of a vehicle that is in the way.
    pub fn room_for(
        &self,
        vehicle: &RecordedVehicle,
        most_behind: f64,
    ) -> Result<RecordedVehicle, VehicleId> {
        /// Places so far apart are tried [m].
        const APART: f64 = 1.0;
        let RecordedVehicle { class, length, width, pose } = *vehicle;
        let at = Pose { at: Point::new(pose.x, pose.y, 0.0), heading: pose.heading };
        let rectangle = Rectangle { pose: at, length, width };
        let footprints = self.roads.ground().footprints(&rectangle);
        let Some(number) = main_lane(&self.roads, &rectangle, &footprints, None) else { return Ok(*vehicle) };
        let Footprint { chain, to: x, .. } = footprints[number];
        let destination = self.roads.navigator().seen_by(class, None);
        let body = Body { chain, x, length, speed: pose.speed, destination, class };
        let Some(other) = in_the_way(self, &body) else { return Ok(*vehicle) };
        let last = most_behind.min(x - length);
        let behind = (1..).map(|it| f64::from(it) * APART).take_while(|it| *it <= last);
        let free = behind.map(|it| x - it).find(|x| in_the_way(self, &Body { x: *x, ..body }).is_none());
        let x = free.ok_or(other)?;
        let (centre, middle) = (&self.network().chain(chain).centre, x - 0.5 * length);
        let (at, heading) = (centre.at(middle), centre.heading(middle));
        Ok(RecordedVehicle { pose: RecordedPose { x: at.x, y: at.y, heading, ..pose }, ..*vehicle })
    }

    /// Moves a recorded vehicle: it is at `pose` at the end of the next step. Returns whether it could be moved: not so
    /// if its number is not in its range, if it has left the road, or if it has become a driver.
    pub fn move_recorded(&mut self, id: VehicleId, pose: RecordedPose) -> bool {
        let external = self.traffic.externals_mut().of_mut(id).filter(|it| it.body.is_some());
        let Some(external) = external.filter(|_| check_control(pose.control()).is_ok()) else { return false };
        external.control = pose.control();
        true
    }

    /// Lets a recorded vehicle that has become a driver drive no faster than this [m/s], from the next step on, and
    /// change lanes so; none: as it likes. Returns whether it can: not so if the number is not in its range, or if the
    /// vehicle has left the road.
    pub fn limit_recorded(&mut self, id: VehicleId, limit: Option<(f64, Lateral)>) -> bool {
        let control = limit.map_or(Control::DRIVER, |(speed, lateral)| Control::Drive {
            longitudinal: Longitudinal::AtMost(speed),
            lateral,
        });
        if check_control(control).is_err() || self.vehicle(id).is_none() {
            return false;
        }
        self.carrying_out().control(id, control);
        true
    }

    /// Takes a recorded vehicle off the road, whether it has become a driver or not. Its trip does not count as
    /// completed.
    pub fn remove_recorded(&mut self, id: VehicleId) {
        self.carrying_out().remove(id);
        self.index.forget();
    }

    /// Lets a recorded vehicle become a driver who reacts, in the lane in which it is and at its speed, with these
    /// driver parameters. It drives to the destination with this smallest lanelet id, if it can; otherwise it follows
    /// the road. Returns whether it has become one: not so while it is in no lane, or in a lane that leads nowhere.
    ///
    /// # Panics
    /// If there are no such driver parameters.
    pub fn release_recorded(&mut self, id: VehicleId, destination: Option<Id>, parameters: u32) -> bool {
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
        let leader = scene.ahead(scene.viewpoint(spot));
        let (roads, at) = (&self.roads, Position::new(spot.chain, x));
        let (motion, driver, _) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        driver.parameters = parameters;
        let accepted = leader.map_or(1.0, |it| accepted_headway(roads.style(parameters), motion.speed, it));
        motion.headway_relaxation = accepted as f32;
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

/// The share of its usual headway with which a driver who is found at `speed` [m/s] behind a leader drives on as it
/// does: neither faster nor slower (ours). It may be held at a shorter headway than it likes, as after a lane change,
/// or not have closed a longer one yet; both relax in time. A driver with a time gap beyond which nobody follows is
/// free.
fn accepted_headway(style: &Style, speed: f64, leader: Ahead) -> f64 {
    /// A driver who desires so much more than its speed keeps its usual gap [m/s].
    const HELD_UP: f64 = 10.0;
    /// Time gap from which on a driver does not follow [s].
    const FREE: f64 = 4.0;
    /// Share of a usual headway that nobody exceeds while it follows.
    const LONGEST: f64 = 3.0;
    /// Halvings of the range in which it is searched.
    const HALVINGS: usize = 20;
    if leader.gap > FREE * speed {
        return 1.0;
    }
    let goes_on = |headway_relaxation: f64| {
        let pace = Pace { speed, desired: speed + HELD_UP, headway_relaxation };
        style.follow.acceleration(pace, Some(leader)) >= 0.0
    };
    let (mut least, mut most) = (style.manner.headway_relaxation(1.0), LONGEST);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (least + most);
        if goes_on(middle) { least = middle } else { most = middle }
    }
    least
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
