//! Obstacles: what is no vehicle, and stands on the road for some time, such as a lost load or a skip.
//!
//! An obstacle is shown in each lane that it touches, as a vehicle is that a user drives, and has a main entry in none.
//! So it is no vehicle of the traffic: it has no trip, and is not counted. A scenario puts it there between two steps;
//! it is no command of a user.

use laneweave_network::{Footprint, Id, Pose, Position, Rectangle};

use crate::route::standing::Standing;
use crate::state::control::Control;
use crate::state::externals::{Body, External, FIRST_OBSTACLE, Kind};
use crate::state::lane::VehicleId;
use crate::state::setup::Placement;
use crate::state::vehicle::Class;
use crate::step::command_error::{CommandError, in_range};
use crate::step::insert::{self, ahead_in_the_way, behind_in_the_way};
use crate::step::move_externals::{clear_obstacles, on_one_level, put_obstacle};
use crate::step::obstacle::Moved;
use crate::step::put_vehicle::entry;
use crate::step::world::World;

/// The least and the greatest length or width of an obstacle [m].
const SIZES: [f64; 2] = [0.1, 60.0];

impl World {
    /// The ground of an obstacle in the middle of a lane, with its far end `position_m` [m] along the lanelet with this
    /// id.
    ///
    /// # Errors
    /// If there is no such lanelet, or no such place in it, or a size is not in its range.
    pub fn obstacle_in_lane(
        &self,
        lanelet: Id,
        position_m: f64,
        [length, width]: [f64; 2],
    ) -> Result<Rectangle, CommandError> {
        let index = self.lanelet_with(lanelet)?;
        in_range("a length", length, SIZES, "m")?;
        in_range("a width", width, SIZES, "m")?;
        let network = self.roads.network();
        let long = network.lanelets[index.at()].length();
        let refused = |why: String| CommandError::Place { lanelet, position_m, why };
        if !(0.0..=long).contains(&position_m) {
            return Err(refused(format!("the lanelet is {long:.1} m long; choose 0 to {long:.1} m")));
        }
        let Position { chain, x: start } = network.start_of(index);
        let middle = start + position_m - 0.5 * length;
        if middle < 0.0 {
            return Err(refused("most of it would be before the beginning of the lane; choose more".into()));
        }
        let centre = &network.chain(chain).centre;
        Ok(Rectangle { pose: Pose { at: centre.at(middle), heading: centre.heading(middle) }, length, width })
    }

    /// Puts an obstacle with a `number` of its own on the road, and returns its id. It stands there until it is
    /// removed.
    ///
    /// # Errors
    /// If it touches no lane, or if a vehicle could not stay clear of it: the id of the vehicle.
    ///
    /// # Panics
    /// If there is an obstacle with this number.
    pub fn put_obstacle(
        &mut self,
        number: u32,
        obstacle: &Rectangle,
    ) -> Result<VehicleId, Option<VehicleId>> {
        let id = FIRST_OBSTACLE + number;
        assert!(self.traffic.externals().of(id).is_none(), "obstacle {number} stands there already");
        let mut rectangle = *obstacle;
        let footprints = on_one_level(&self.roads, &mut rectangle);
        let Some(first) = footprints.first() else { return Err(None) };
        if let Some(other) = self.near(&footprints, 0.0) {
            return Err(Some(other));
        }
        let Position { chain, x } = Position::new(first.chain, first.to);
        let placement =
            Placement { chain, x, speed: 0.0, class: Class::Car, parameters: 0, destination: None };
        let mut entry = entry(&self.roads, self.traffic.clock(), &placement, id);
        entry.driver.is_external = true;
        let Pose { at, heading } = rectangle.pose;
        let control = Control::Pose { x: at.x, y: at.y, heading, speed: 0.0 };
        let mut external = External::new(id, control, Position::new(chain, x));
        external.kind = Kind::Obstacle;
        let Rectangle { pose, length, width } = rectangle;
        external.body = Some(Body { pose, length, width, speed: 0.0, off_road: None });
        let moved = Moved { rectangle, before: None, speed: 0.0, has_known_speed: true, way: 0.0 };
        for footprint in &footprints {
            external.obstacles.push(put_obstacle(&self.roads, &mut self.traffic, &entry, &moved, footprint));
        }
        self.traffic.externals_mut().add(external);
        Ok(id)
    }

    /// Whether an obstacle would touch a lane.
    pub fn is_in_lanes(&self, obstacle: &Rectangle) -> bool {
        !on_one_level(&self.roads, &mut { *obstacle }).is_empty()
    }

    /// Whether drivers behind could stop so far behind an obstacle that they can go round it.
    pub fn has_room_behind_obstacle(&self, obstacle: &Rectangle) -> bool {
        let footprints = on_one_level(&self.roads, &mut { *obstacle });
        self.near(&footprints, Standing::ROOM_BEFORE).is_none()
    }

    /// Takes an obstacle off the road.
    pub fn remove_obstacle(&mut self, id: VehicleId) {
        let is_it = self.traffic.externals().of(id).is_some_and(|it| it.kind == Kind::Obstacle);
        if let Some(mut external) = is_it.then(|| self.traffic.externals_mut().take(id)).flatten() {
            clear_obstacles(&mut self.traffic, &mut external);
        }
    }

    /// The ids of the obstacles on the road, and the ground that they cover.
    pub fn obstacles(&self) -> impl Iterator<Item = (VehicleId, Rectangle)> + '_ {
        let all = self.traffic.externals().all().iter().filter(|it| it.kind == Kind::Obstacle);
        all.filter_map(|it| Some((it.id, it.body.as_ref()?.rectangle())))
    }

    /// A vehicle that could not stay clear of something that stands on these stretches of lanes, and `behind` them [m].
    /// Obstacles may stand beside each other, and within each other.
    fn near(&self, footprints: &[Footprint], behind: f64) -> Option<VehicleId> {
        footprints.iter().find_map(|it| {
            let length = it.to - it.from + behind;
            let (speed, destination, class) = (0.0, None, Class::Car);
            let body = insert::Body { chain: it.chain, x: it.to, length, speed, destination, class };
            let ahead = ahead_in_the_way(self, &body).filter(|it| *it < FIRST_OBSTACLE);
            ahead.or_else(|| behind_in_the_way(self, &body)).filter(|it| *it < FIRST_OBSTACLE)
        })
    }
}
