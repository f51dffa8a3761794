//! When a driver gives its destination up, and which one it takes.

use laneweave_network::Position;

use crate::driver::me::Me;
use crate::route::waypoint::Waypoint;
use crate::route::ways::stretch_to;
use crate::state::goal::Destination;
use crate::view::scene::Scene;

/// A driver who stands this long [s], this near to the last place for a change [m], gives the change up.
const STANDS_IN_VAIN: f32 = 120.0;
const AT_THE_PLACE: f64 = 20.0;

/// The new destination of a driver who has stood for `standing` [s]. It needs one if it cannot reach its own by its
/// `waypoint`, if something stays in the way there, or if it has waited for the change in vain. It takes the nearest
/// destination that it can still reach, or follows the road. `None` if it keeps its own.
pub(super) fn other_goal(scene: &Scene, me: &Me, waypoint: &Waypoint, standing: f32) -> Option<Destination> {
    let (spot, goal, x) = (me.spot, me.driver.goal.destination(), me.motion.x);
    let found = if !waypoint.leads_on(x) {
        scene.navigator.nearest(scene.network, goal, spot.chain, x)
    } else {
        // Only a route that needs no lane change here helps it.
        let stays_at =
            cut_off(scene, me, waypoint).or_else(|| waits_in_vain(scene, me, waypoint, standing))?;
        Some(scene.navigator.nearest_in_lane(goal, stays_at.chain, stays_at.x)?)
    };
    // A driver with a reservation keeps the route for which it was granted. A driver who follows the road has no
    // destination to give up.
    let found = found.or_else(|| scene.navigator.seen_by(me.driver.class, None));
    let is_free = scene.navigator.number(goal).is_some() && !scene.has_reservation(spot, f64::NEG_INFINITY);
    (found != goal && is_free).then_some(found)
}

/// Where a driver is who gives up a change for which it has waited long enough.
fn waits_in_vain(scene: &Scene, me: &Me, waypoint: &Waypoint, standing: f32) -> Option<Position> {
    let waits = standing >= STANDS_IN_VAIN && waypoint.last_place - me.motion.x < AT_THE_PLACE;
    let is_in_vain = waits && scene.closure_ahead(scene.viewpoint(me.spot)).is_none();
    is_in_vain.then_some(Position::new(me.spot.chain, waypoint.last_place + AT_THE_PLACE))
}

/// Where a driver gets to if something stays on its own lane ahead, or on the one to which it has to change soon, and
/// it could not get back to its way behind it.
fn cut_off(scene: &Scene, me: &Me, waypoint: &Waypoint) -> Option<Position> {
    /// How far ahead what stays there, or the last place for the change, is [m] (ours).
    const SOON: f64 = 60.0;
    let (navigator, goal, chain) = (scene.navigator, me.driver.goal.destination(), me.spot.chain);
    if navigator.closures().is_empty() {
        return None;
    }
    let (x, class) = (me.motion.x, me.driver.class);
    navigator.cut_off(goal, chain, [x, x + SOON], class).or_else(|| {
        let wanted = waypoint.goes_on().filter(|_| waypoint.last_place - x < SOON)?;
        let beside = stretch_to(scene.network.chain(chain), wanted, waypoint.last_place)?;
        let until = navigator.waypoint(goal, wanted).end;
        navigator.cut_off(goal, wanted, [beside.across(x), until], class)?;
        Some(Position::new(chain, waypoint.last_place + AT_THE_PLACE))
    })
}
