//! Whether vehicles are going to touch: each moves on at its speed and along its curve, for some seconds.
//!
//! Accelerations are not taken along: in three seconds those of recordings, whose errors are large, decide alone.

use laneweave_models::change::Driver;
use laneweave_models::follow::{Ahead, FollowingModel, IdmPlus, Pace, constant_acceleration};
use laneweave_network::{Point, Pose, Rectangle, turn};
use laneweave_sim::{Vehicle, VehicleId, World};

use super::part::Chord;

/// Touches are looked for now and at so many moments, which are so far apart [s]: 3 s ahead.
const LOOKS: usize = 13;
const LOOK: f64 = 0.25;
/// Who needs so much more braking than recorded leaves its record [m/s²].
const MORE_BRAKING: f64 = 2.0;
/// Vehicles whose heights differ by more than this drive above each other [m].
const LEVEL: f64 = 2.0;
/// Half of the stretch of a lane over which its curvature is taken [m] (ours).
const CURVE: f64 = 5.0;
/// How drivers of recorded vehicles follow: as our default drivers do, with the time gap that they accept around a lane
/// change (ours).
const FOLLOWS: FollowingModel = FollowingModel::IdmPlus(IdmPlus {
    acceleration: 2.2,
    deceleration: COMFORTABLE,
    time_gap: 0.56,
    jam_gap: 2.0,
    exponent: 4.0,
});
/// Their comfortable braking [m/s²] (ours).
const COMFORTABLE: f64 = 2.0;
/// They desire so much more than their speed, so that a free road does not keep them from following [m/s] (ours).
const HELD_UP: f64 = 10.0;
/// A vehicle comes no nearer to anybody [m] (ours).
pub(super) const NEAREST: f64 = 0.5;
/// The least and the hardest braking to fall back behind a vehicle beside [m/s²], and room that is kept to others [m]
/// (ours).
const FALLING_BACK: [f64; 2] = [2.0, 5.0];
const ROOM: f64 = 1.0;

/// A vehicle, and where it is going to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moving {
    pub(super) id: VehicleId,
    /// Speed [m/s].
    pub(super) speed: f64,
    /// How it moves on.
    movement: Movement,
    /// Its way until each look [m].
    ways: [f64; LOOKS],
    /// The ground that it covers then.
    places: [Rectangle; LOOKS],
    /// A driver drives it in its lane: it does not give way to who comes from the side.
    keeps_lane: bool,
}

/// How a vehicle moves on: at its speed, along its curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Movement {
    /// Speed [m/s].
    pub(super) speed: f64,
    /// Direction in which it moves, counter-clockwise from east [rad].
    direction: f64,
    /// Curvature of its path [1/m].
    curvature: f64,
}

impl Movement {
    /// The pose after `way` [m] from this one on.
    fn after(&self, Pose { at, heading }: Pose, way: f64) -> Pose {
        let (sin, cos) = (self.direction + 0.5 * self.curvature * way).sin_cos();
        let at = Point { x: at.x + way * cos, y: at.y + way * sin, ..at };
        Pose { at, heading: heading + self.curvature * way }
    }
}

impl Moving {
    /// A vehicle that drives in lanes, along the curve of its lane.
    pub(super) fn in_lane(vehicle: &Vehicle, world: &World) -> Moving {
        let movement = Movement { curvature: curvature(vehicle, world), ..steady(vehicle) };
        Moving { keeps_lane: true, ..Moving::along(vehicle, movement) }
    }

    /// A recorded vehicle at this speed [m/s] that has come along this chord: at its angle to the lane, along the curve
    /// of the lane. In no lane it goes straight on.
    pub(super) fn as_before(vehicle: &Vehicle, speed: f64, chord: Option<Chord>, world: &World) -> Moving {
        let straight = Movement { speed, ..steady(vehicle) };
        let Some(Chord { way, direction }) = chord else { return Moving::along(vehicle, straight) };
        let curvature = curvature(vehicle, world);
        // A chord points where the path did in its middle.
        let direction = direction + 0.5 * curvature * way;
        Moving::along(vehicle, Movement { curvature, direction, ..straight })
    }

    /// A vehicle that goes straight on at its speed.
    pub(super) fn straight_on(vehicle: &Vehicle) -> Moving {
        Moving::along(vehicle, steady(vehicle))
    }

    fn along(vehicle: &Vehicle, movement: Movement) -> Moving {
        let [length, width] = vehicle.size();
        Moving::of(vehicle.id(), Rectangle { pose: vehicle.pose(), length, width }, movement)
    }

    fn of(id: VehicleId, body: Rectangle, movement: Movement) -> Moving {
        let ways = std::array::from_fn(|look| movement.speed * LOOK * look as f64);
        let places = ways.map(|way| Rectangle { pose: movement.after(body.pose, way), ..body });
        Moving { id, speed: movement.speed, movement, ways, places, keeps_lane: false }
    }

    /// The same vehicle, of whose path the next `known` [m] are known: where it is after a way along it. Beyond, it
    /// goes on in the direction in which it moves.
    pub(super) fn on_path(mut self, known: f64, pose: impl Fn(f64) -> Pose) -> Moving {
        let end = pose(known);
        for (place, way) in self.places.iter_mut().zip(self.ways) {
            let Pose { at, heading } =
                if way > known { self.movement.after(end, way - known) } else { pose(way) };
            place.pose = Pose { at: Point { z: place.pose.at.z, ..at }, heading };
        }
        self
    }

    /// The ground that it covers now.
    fn body(&self) -> &Rectangle {
        &self.places[0]
    }

    /// When it is going to touch another one to which it gives way, within the foresight [s].
    pub(super) fn touches(&self, other: &Moving) -> Option<f64> {
        let (dx, dy) = self.body().to(other.body());
        let far = self.ways[LOOKS - 1] + other.ways[LOOKS - 1] + self.body().length + other.body().length;
        let is_near = dx.abs().max(dy.abs()) <= far;
        let is_on_its_level = (self.body().pose.at.z - other.body().pose.at.z).abs() <= LEVEL;
        if !is_near || !is_on_its_level || !self.gives_way(other) {
            return None;
        }
        let mut looks = self.places.iter().zip(&other.places);
        looks.position(|(own, other)| own.depth(other) > 0.0).map(|it| LOOK * it as f64)
    }

    /// Whether it gives way to another one: of two vehicles the one whose centre is behind does, so that they never
    /// wait for each other. To a driver in its lane it gives way beside it, too.
    fn gives_way(&self, other: &Moving) -> bool {
        let ahead = self.ahead(other);
        ahead > 0.0 || ahead == 0.0 && self.id > other.id || other.keeps_lane && self.is_beside(other)
    }

    /// The braking with which it does not touch `other`, which it would touch after `time` [m/s²]. It falls back behind
    /// one that is beside it.
    pub(super) fn braking_for(&self, other: &Moving, time: f64) -> f64 {
        let along = other.speed * turn(self.body().pose.heading, other.body().pose.heading).cos();
        let closing = self.speed - along.max(0.0);
        let way = self.ways[((time / LOOK).round() as usize).min(LOOKS - 1)];
        let room = (way - along.max(0.0) * time - ROOM).max(0.5 * ROOM);
        let needed = 0.5 * closing.max(0.0) * closing / room;
        if !self.is_beside(other) {
            return needed;
        }
        let [least, most] = FALLING_BACK;
        let back = self.reach(other) - self.ahead(other);
        needed.max((2.0 * back / (time * time).max(LOOK * LOOK)).clamp(least, most))
    }

    /// How far the centre of another one is ahead of its own [m].
    fn ahead(&self, other: &Moving) -> f64 {
        let ((dx, dy), (sin, cos)) = (self.body().to(other.body()), self.body().pose.heading.sin_cos());
        dx * cos + dy * sin
    }

    /// Whether another one is beside it, and they do not touch.
    fn is_beside(&self, other: &Moving) -> bool {
        self.ahead(other).abs() < self.reach(other) && self.body().depth(other.body()) <= 0.0
    }

    /// The distance of their centres at which one is all behind the other [m].
    fn reach(&self, other: &Moving) -> f64 {
        0.5 * (self.body().length + other.body().length)
    }
}

/// A vehicle goes straight on at its speed.
fn steady(vehicle: &Vehicle) -> Movement {
    let (speed, direction) = (vehicle.speed(), vehicle.pose().heading);
    Movement { speed, direction, curvature: 0.0 }
}

/// The curvature of the lane where a vehicle is; 0 in no lane [1/m].
fn curvature(vehicle: &Vehicle, world: &World) -> f64 {
    if !vehicle.is_in_lane() {
        return 0.0;
    }
    let chain = world.network().chain(vehicle.spot.chain);
    let [behind, ahead] = [-CURVE, CURVE].map(|it| (vehicle.x() + it).clamp(0.0, chain.length));
    let [from, to] = [behind, ahead].map(|it| chain.centre.heading(it));
    turn(from, to) / (ahead - behind).max(CURVE)
}

/// The leader of a vehicle in its lane, and its id.
pub(super) fn leader(vehicle: &Vehicle, world: &World) -> Option<(VehicleId, Ahead)> {
    let scene = world.scene();
    let from = vehicle.is_in_lane().then(|| scene.viewpoint(vehicle.spot))?;
    let ahead = scene.ahead(from)?;
    Some((scene.motion(scene.leader_spot(from)?).id, ahead))
}

/// The acceleration that the driver of a recorded vehicle wants at `speed` [m/s] behind a leader [m/s²]. It follows as
/// closely as around a lane change, since a recording has all headways. Its numbers are not those of the drivers who
/// are judged: else the same gap would make it brake beside one style, and not beside another.
pub(super) fn wish(vehicle: &Vehicle, speed: f64, leader: Ahead) -> f64 {
    let driver = Driver {
        pace: Pace { speed, desired: speed + HELD_UP, headway_relaxation: 1.0 },
        acceleration: 0.0,
        follow: &FOLLOWS,
        comfortable: COMFORTABLE,
        length: vehicle.size()[0],
    };
    driver.demanded(leader)
}

/// The largest acceleration with which a vehicle at `speed` [m/s] does not touch its leader, if nobody changes his
/// [m/s²]. It keeps no gap that its record does not keep.
pub(super) fn needed(speed: f64, leader: Ahead) -> f64 {
    constant_acceleration(
        speed,
        Ahead { acceleration: leader.acceleration.min(0.0), ..leader.nearer(NEAREST) },
    )
}

/// Whether a vehicle whose record accelerates like this [m/s²] would have to brake clearly harder.
pub(super) fn brakes_more(needed: f64, recorded: f64) -> bool {
    needed < recorded.min(0.0) - MORE_BRAKING
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving(id: VehicleId, [x, y]: [f64; 2], movement: Movement) -> Moving {
        let pose = Pose { at: Point::new(x, y, 0.0), heading: movement.direction };
        Moving::of(id, Rectangle { pose, length: 4.0, width: 2.0 }, movement)
    }

    fn steady(direction: f64, speed: f64) -> Movement {
        Movement { speed, direction, curvature: 0.0 }
    }

    fn car(id: VehicleId, at: [f64; 2], heading: f64, speed: f64) -> Moving {
        moving(id, at, steady(heading, speed))
    }

    #[test]
    fn who_closes_in_touches_when_the_gap_is_gone() {
        let (behind, ahead) = (car(1, [0.0, 0.0], 0.0, 20.0), car(2, [24.0, 0.0], 0.0, 10.0));
        // 20 m at 10 m/s: 2 s, at the next look.
        assert_eq!(behind.touches(&ahead), Some(2.25));
        assert_eq!(ahead.touches(&behind), None, "the one behind has to brake");
        assert_eq!(car(1, [0.0, 3.5], 0.0, 20.0).touches(&ahead), None, "in another lane");
        // Δv²/2s with a metre of room.
        assert!((behind.braking_for(&ahead, 2.0) - 0.5 * 100.0 / 19.0).abs() < 1e-12);
    }

    #[test]
    fn paths_that_cross_touch_and_those_above_each_other_do_not() {
        let east = car(1, [-20.0, 0.0], 0.0, 10.0);
        let mut north = car(2, [0.0, -20.0], 0.5 * std::f64::consts::PI, 10.0);
        assert!(east.touches(&north).is_some());
        north.places.iter_mut().for_each(|it| it.pose.at.z = 6.0);
        assert_eq!(east.touches(&north), None, "on a bridge");
    }

    #[test]
    fn who_drives_along_a_curve_does_not_touch_who_is_straight_ahead() {
        let curve = Movement { curvature: 0.02, ..steady(0.0, 15.0) };
        let stands = car(2, [35.0, 0.0], 0.0, 0.0);
        assert!(car(1, [0.0, 0.0], 0.0, 15.0).touches(&stands).is_some());
        assert_eq!(moving(1, [0.0, 0.0], curve).touches(&stands), None);
        // A quarter of the circle with a radius of 50 m leads 50 m to the side; the chord is nearly right.
        let start = Pose { at: Point::new(0.0, 0.0, 0.0), heading: 0.0 };
        let end = curve.after(start, 0.5 * std::f64::consts::PI * 50.0);
        assert!((end.heading - 0.5 * std::f64::consts::PI).abs() < 1e-12 && (end.at.y - 55.5).abs() < 0.1);
    }

    #[test]
    fn who_comes_from_the_side_gives_way_to_a_driver_in_its_lane_even_a_little_behind() {
        let driver = |x| Moving { keeps_lane: true, ..car(1, [x, 0.0], 0.0, 15.0) };
        let comes = car(2, [1.0, 3.5], -0.1, 15.0);
        assert!(comes.touches(&driver(0.0)).is_some() && driver(0.0).touches(&comes).is_some());
        assert_eq!(comes.touches(&car(1, [0.0, 0.0], 0.0, 15.0)), None);
        assert_eq!(comes.touches(&driver(-4.0)), None, "all of it is behind");
    }

    #[test]
    fn who_follows_a_known_path_is_on_it_and_goes_on_beyond_as_its_record_does_there() {
        let turns = |way: f64| Pose { at: Point::new(way, 1.0, 0.0), heading: 0.5 * std::f64::consts::PI };
        let [.., last] = car(1, [0.0, 0.0], 0.5 * std::f64::consts::PI, 10.0).on_path(20.0, turns).places;
        assert!((last.pose.at.x - 20.0).abs() < 1e-9 && (last.pose.at.y - 11.0).abs() < 1e-9, "{last:?}");
    }
}
