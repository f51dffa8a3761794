//! Recorded vehicles are handed over, go on along their paths, and come back to their records.

use laneweave_models::follow::Ahead;
use laneweave_network::{Point, Pose};
use laneweave_sim::{RecordedPose, Vehicle, VehicleId, World};

use super::Player;
use super::conflict::{Moving, brakes_more, leader, needed, wish};
use super::course::{Course, Heeded, Recorded};
use super::part::Part;
use super::playback::{HandOver, Playback, Presence};

/// The vehicles of a world, by whether they are where the recording has them.
struct Others {
    /// Those that are, in the order of their ids.
    on_record: Vec<Moving>,
    /// All others: drivers, vehicles of users, and those that are handed over.
    elsewhere: Vec<Moving>,
}

impl Others {
    fn all(&self) -> impl Iterator<Item = &Moving> {
        self.elsewhere.iter().chain(&self.on_record)
    }

    /// Whether a vehicle is where the recording has it.
    fn is_on_record(&self, id: VehicleId) -> bool {
        self.on_record.binary_search_by_key(&id, |it| it.id).is_ok()
    }
}

impl Player {
    /// All vehicles as they move now.
    fn others(&self, playback: &Playback, world: &World) -> Others {
        let mut others = Others { on_record: Vec::new(), elsewhere: Vec::new() };
        let mut played: Vec<VehicleId> = Vec::new();
        for (part, presence) in self.parts.iter().zip(&playback.parts) {
            let Some(vehicle) = on_its_path(presence, world) else { continue };
            played.push(vehicle.id());
            let moving = Player::moving(part, presence, &vehicle, world);
            let recorded = part.recorded(world.clock().step);
            match presence.course.filter(|it| it.is_behind(recorded)) {
                Some(_) => others.elsewhere.push(moving),
                None => others.on_record.push(moving),
            }
        }
        others.on_record.sort_unstable_by_key(|it| it.id);
        played.sort_unstable();
        let rest = world.vehicles().filter(|it| played.binary_search(&it.id()).is_err());
        others.elsewhere.extend(rest.map(|it| {
            if it.is_on_its_own_path() { Moving::straight_on(&it) } else { Moving::in_lane(&it, world) }
        }));
        others
    }

    /// A recorded vehicle as it moves now: as recorded, or along its path.
    fn moving(part: &Part, presence: &Presence, vehicle: &Vehicle, world: &World) -> Moving {
        let (now, dt) = (world.clock().step, world.clock().dt);
        match presence.course {
            Some(course) => Player::on_course(part, course, vehicle, world),
            None => Moving::as_before(vehicle, part.recorded(now).speed, part.motion(now, dt).chord, world),
        }
    }

    /// A vehicle that heeds somebody, or is handed over, as it moves now.
    fn on_course(part: &Part, course: Course, vehicle: &Vehicle, world: &World) -> Moving {
        let (now, dt) = (world.clock().step, world.clock().dt);
        let (Course { way, speed, .. }, recorded) = (course, part.recorded(now));
        // Where its record is, it moves on in the direction of that.
        let moving = Moving::as_before(vehicle, speed, part.motion(now, dt).chord, world);
        // So much of its path has been recorded up to now.
        moving.on_path((recorded.way - way).max(0.0), |further| {
            let RecordedPose { x, y, heading, .. } = part.along(way + further, speed);
            Pose { at: Point::new(x, y, 0.0), heading }
        })
    }

    /// The recorded vehicles in whose way somebody is who is not where the recording has him heed him from now on.
    /// Those that are back at their records, and have nobody in their way, are theirs again.
    pub(super) fn heed(&self, playback: &mut Playback, world: &World) {
        if is_as_recorded(playback, world) {
            return;
        }
        let others = self.others(playback, world);
        let now = world.clock().step;
        let Playback { parts, departures } = playback;
        for (part, presence) in self.parts.iter().zip(parts) {
            let Some(vehicle) = on_its_path(presence, world).filter(|_| part.is_vehicle) else { continue };
            let recorded = part.recorded(now);
            let in_the_way = || self.in_the_way(part, &vehicle, &others, world);
            match presence.course {
                Some(course) if part.last_step() >= now => {
                    if course.is_back(recorded) && in_the_way().is_none() {
                        presence.course = None;
                        departures.end_hand_over(vehicle.id(), now);
                    }
                }
                Some(_) => {}
                None => {
                    if let Some(because_of) = in_the_way() {
                        let Recorded { way, speed } = recorded;
                        let acceleration = part.motion(now, world.clock().dt).acceleration;
                        presence.course = Some(Course { way, speed, acceleration, heeds: Some(because_of) });
                    }
                }
            }
        }
    }

    /// A vehicle has just come, too late, since another one was in the way.
    pub(super) fn come_late(
        &self,
        number: usize,
        because_of: VehicleId,
        id: VehicleId,
        playback: &mut Playback,
        world: &World,
    ) {
        let Some(vehicle) = world.vehicle(id) else { return };
        let late = Course { way: 0.0, speed: vehicle.speed(), acceleration: 0.0, heeds: None };
        playback.parts[number].course = Some(late);
        playback.departures.hand_overs.push(begun(&self.parts[number], &vehicle, because_of, world));
    }

    /// Who would make a vehicle on its record brake clearly harder than it was recorded, or touch it.
    fn in_the_way(
        &self,
        part: &Part,
        vehicle: &Vehicle,
        others: &Others,
        world: &World,
    ) -> Option<VehicleId> {
        let (now, dt) = (world.clock().step, world.clock().dt);
        let (recorded, motion) = (part.recorded(now), part.motion(now, dt));
        let own = Moving::as_before(vehicle, recorded.speed, motion.chord, world);
        let leader = leader(vehicle, world).filter(|it| !others.is_on_record(it.0));
        let brakes = |it: &Ahead| brakes_more(needed(own.speed, *it), motion.acceleration);
        if let Some((id, _)) = leader.filter(|it| brakes(&it.1)) {
            return Some(id);
        }
        others.elsewhere.iter().find(|it| it.id != own.id && own.touches(it).is_some()).map(|it| it.id)
    }

    /// The vehicles that heed somebody, or are handed over, drive on by a step. Those that fall back behind their
    /// records are handed over.
    pub(super) fn advance_courses(&self, playback: &mut Playback, world: &World) {
        if playback.parts.iter().all(|it| it.course.is_none()) {
            return;
        }
        let others = self.others(playback, world);
        let (now, dt) = (world.clock().step, world.clock().dt);
        let Playback { parts, departures } = playback;
        for (part, presence) in self.parts.iter().zip(parts) {
            let Some(vehicle) = on_its_path(presence, world) else { continue };
            let Some(course) = &mut presence.course else { continue };
            // It brakes for whom it would touch if it did not brake.
            let own = Player::on_course(part, Course { acceleration: 0.0, ..*course }, &vehicle, world);
            let touched = others.all().filter(|it| it.id != own.id);
            let to_avoid = touched.filter_map(|it| Some(own.braking_for(it, own.touches(it)?)));
            let leader = leader(&vehicle, world);
            let strange = leader.filter(|it| !others.is_on_record(it.0));
            let heeded = Heeded {
                leader: leader.map(|it| it.1),
                wish: strange.map(|it| wish(&vehicle, own.speed, it.1)),
                to_avoid: to_avoid.reduce(f64::max),
            };
            *course = course.after(&heeded, part.recorded(now + 1), dt);
            if let Some(because_of) = course.leaves_its_record(part.recorded(now + 1)) {
                departures.hand_overs.push(begun(part, &vehicle, because_of, world));
            }
        }
    }
}

/// Whether nobody is on the road but recorded vehicles on their records.
fn is_as_recorded(playback: &Playback, world: &World) -> bool {
    let present = playback.parts.iter().filter(|it| on_its_path(it, world).is_some());
    playback.parts.iter().all(|it| it.course.is_none()) && present.count() == world.on_road()
}

/// The hand-over of a vehicle that begins now because of another one.
fn begun(part: &Part, vehicle: &Vehicle, because_of: VehicleId, world: &World) -> HandOver {
    let at = vehicle.pose().at;
    HandOver {
        recorded: part.recorded,
        vehicle: vehicle.id(),
        because_of,
        from_step: world.clock().step,
        until_step: None,
        at: [at.x, at.y],
    }
}

/// The vehicle of a part, if it is on the road and nobody drives it.
fn on_its_path<'a>(presence: &Presence, world: &'a World) -> Option<Vehicle<'a>> {
    world.vehicle(presence.vehicle?).filter(Vehicle::is_on_its_own_path)
}
