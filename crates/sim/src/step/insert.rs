//! A place for a vehicle that a user puts on the road.

use laneweave_models::braking::is_secure;
use laneweave_models::follow::Ahead;
use laneweave_network::{ChainIndex, Class, Position};

use crate::driver::perceive::driver_of;
use crate::route::standing::Standing;
use crate::state::command::NewVehicle;
use crate::state::control::Control;
use crate::state::goal::Destination;
use crate::state::lane::VehicleId;
use crate::state::setup::Placement;
use crate::step::command_error::{CommandError, in_range};
use crate::step::world::World;
use crate::view::scene::Viewpoint;

/// Where and how a new vehicle is placed: within one lane, outside of conflict areas, and so that neither it nor its
/// follower has to brake harder than vehicles can.
///
/// # Errors
/// If that is not so, or if something that it names does not exist.
pub(super) fn check_place(world: &World, vehicle: &NewVehicle) -> Result<Placement, CommandError> {
    let NewVehicle { lanelet, position_m, speed_mps, class, style, destination } = vehicle;
    in_range("a speed", *speed_mps, [0.0, Control::FASTEST], "m/s")?;
    let (network, navigator) = (world.roads.network(), world.roads.navigator());
    let index = world.lanelet_with(*lanelet)?;
    let refused = |why: String| CommandError::Place { lanelet: *lanelet, position_m: *position_m, why };
    let long = network.lanelets[index.at()].length();
    if !(0.0..=long).contains(position_m) {
        return Err(refused(format!("the lanelet is {long:.1} m long; choose 0 to {long:.1} m")));
    }
    let Position { chain, x: start } = network.start_of(index);
    let (x, length) = (start + position_m, class.body().length);
    if x < length {
        let why =
            format!("its rear bumper would be before the beginning of the lane; choose {length} m or more");
        return Err(refused(why));
    }
    let classes = network.chain(chain).classes;
    if !classes.has(*class) {
        let why = format!("the lane is for {} only; choose another lane, or another class", classes.names());
        return Err(refused(why));
    }
    if !network.chain(chain).takes(x, *class) {
        return Err(refused("the lane is too narrow for it there; choose another lane".into()));
    }
    if navigator.closures().closed().contains(&index) {
        return Err(refused("the lanelet is closed; choose another one, or open it".into()));
    }
    let junctions = &network.junctions;
    let mut zones = junctions.on(chain).crossings.iter().map(|it| junctions.reach(*it));
    if let Some(zone) = zones.find(|it| it.start < x && x - length < it.end) {
        let why = format!(
            "it would stand in the conflict area from {:.1} to {:.1} m; choose a place before or behind it",
            zone.start - start,
            zone.end - start
        );
        return Err(refused(why));
    }
    let parameters = world.parameters_of(style, world.arrivals.next_inserted())?;
    let destination = destination.map(|it| world.destination(it)).transpose()?;
    let destination = navigator.seen_by(*class, destination);
    if !navigator.waypoint_from(network, destination, chain, x).leads_on(x) {
        return Err(refused(
            "no route leads from there to its destination; choose another destination".into(),
        ));
    }
    let placement = Placement { chain, x, speed: *speed_mps, class: *class, parameters, destination };
    let body = Body { chain, x, length, speed: *speed_mps, destination, class: *class };
    match in_the_way(world, &body) {
        Some(other) => Err(refused(format!(
            "vehicle {other} is too near; choose another place, or a speed nearer to the traffic's"
        ))),
        None => Ok(placement),
    }
}

/// A vehicle that is not on the road yet.
pub(super) struct Body {
    pub(super) chain: ChainIndex,
    /// Place of its front bumper [m].
    pub(super) x: f64,
    /// Length [m].
    pub(super) length: f64,
    /// Speed [m/s].
    pub(super) speed: f64,
    pub(super) destination: Destination,
    pub(super) class: Class,
}

/// The vehicle that could not stay clear of `body`, or of which that one could not stay clear.
pub(super) fn in_the_way(world: &World, body: &Body) -> Option<VehicleId> {
    ahead_in_the_way(world, body).or_else(|| behind_in_the_way(world, body))
}

impl Body {
    /// What somebody would see who is in its lane.
    fn viewpoint(&self) -> Viewpoint {
        let Body { chain, x, destination, class, .. } = *self;
        Viewpoint { chain, x, ahead: 0, id: VehicleId::MAX, destination, class }
    }
}

/// The vehicle ahead of which `body` could not stay clear.
pub(super) fn ahead_in_the_way(world: &World, body: &Body) -> Option<VehicleId> {
    let Body { chain, x, length, speed, .. } = *body;
    let scene = world.scene();
    // Seen from its rear bumper, a vehicle beside it is ahead of it.
    let rear = scene.viewpoint_at(body.viewpoint(), chain, x - length);
    let ahead = scene.ahead(rear)?;
    let is_clear = is_secure(speed, Ahead { gap: ahead.gap - length, ..ahead }, world.clock().dt);
    if is_clear { None } else { scene.leader_spot(rear).map(|it| scene.motion(it).id) }
}

/// The vehicle behind that could not stay clear of `body`.
pub(super) fn behind_in_the_way(world: &World, body: &Body) -> Option<VehicleId> {
    let scene = world.scene();
    let follower = scene.follower(scene.viewpoint_at(body.viewpoint(), body.chain, body.x))?;
    let behind = driver_of(&scene, follower.spot);
    let ahead = Ahead::steady(follower.distance - body.length, body.speed);
    let is_clear = is_secure(behind.pace.speed, ahead, world.clock().dt);
    (!is_clear).then(|| scene.motion(follower.spot).id)
}

impl World {
    /// Whether a driver behind could stop so far behind `vehicle`, which stands, that it can go round it. A place that
    /// does not exist has room.
    pub fn has_room_behind(&self, vehicle: &NewVehicle) -> bool {
        let Ok(lanelet) = self.lanelet_with(vehicle.lanelet) else { return true };
        let Position { chain, x: start } = self.roads.network().start_of(lanelet);
        let length = vehicle.class.body().length + Standing::ROOM_BEFORE;
        let destination = None;
        let body = Body {
            chain,
            x: start + vehicle.position_m,
            length,
            speed: 0.0,
            destination,
            class: vehicle.class,
        };
        in_the_way(self, &body).is_none()
    }
}
