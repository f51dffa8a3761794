//! Drivers leave their route for the recommended one.

use laneweave_models::change::LaneChangeModel;

use crate::driver::beliefs::Beliefs;
use crate::driver::perceive::Perception;
use crate::state::goal::Destination;
use crate::state::moment::Moment;
use crate::state::random::Purpose;
use crate::view::scene::{Scene, Spot};

/// Braking with which a driver can still stop before its new route leaves the old one [m/s²], and the distance that
/// it keeps in addition [m]; ours.
const EASY_BRAKING: f64 = 2.0;
const ROOM: f64 = 5.0;

/// A driver's change to another route.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Departure {
    /// The same destination by the other route.
    pub(crate) to: Destination,
    /// The two routes differ.
    pub(crate) is_change: bool,
}

/// The route that a driver changes to, if it does so within `epochs`. It is a better route, chosen by the same rule
/// as a lane change, or the same route, newly planned.
#[inline]
pub(crate) fn departure(
    scene: &Scene,
    moment: Moment,
    spot: Spot,
    perception: &Perception,
    change: &LaneChangeModel,
    epochs: f64,
) -> Option<Departure> {
    let own = scene.driver(spot).goal.destination();
    let new = scene.navigator.recommended(own)?;
    towards(scene, moment, spot, [own, Some(new)], perception, change, epochs)
}

/// The same for a driver who is recommended another route.
#[inline(never)]
fn towards(
    scene: &Scene,
    moment: Moment,
    spot: Spot,
    [own, new]: [Destination; 2],
    perception: &Perception,
    change: &LaneChangeModel,
    epochs: f64,
) -> Option<Departure> {
    let departure = if !scene.navigator.is_usual(own) && goes_on_alike(scene, spot, [own, new]) {
        Departure { to: new, is_change: false }
    } else {
        let Beliefs { band, .. } = perception.beliefs();
        let route = &perception.here().route;
        let appraisal = change.appraise_leaving(route.onward, route.alternative?, band)?;
        let draw = moment.random.uniform(scene.motion(spot).id, Purpose::Route, moment.clock.step);
        change.drawn([Some(&appraisal), None], epochs, draw)?;
        Departure { to: new, is_change: true }
    };
    can_go_over(scene, spot, [own, new]).then_some(departure)
}

/// Whether two routes are the same from here on, judged by their times.
fn goes_on_alike(scene: &Scene, spot: Spot, ways: [Destination; 2]) -> bool {
    let [own, new] = ways.map(|it| scene.navigator.waypoint(it, spot.chain));
    own.goes_like(new) && own.time == new.time
}

/// Whether a driver can change its route here. A driver with a reservation keeps the route for which it was granted.
/// Others have to be able to stop before the routes separate, and to be in a lane that leads on beyond its end.
fn can_go_over(scene: &Scene, spot: Spot, ways: [Destination; 2]) -> bool {
    let Scene { network, navigator, .. } = scene;
    let motion = scene.motion(spot);
    let way = motion.speed * motion.speed / (2.0 * EASY_BRAKING) + ROOM;
    let [own, new] = ways.map(|it| navigator.waypoint(it, spot.chain));
    let is_in_lane = new.last_place > network.chain(spot.chain).length || new.goes_like(own);
    is_in_lane
        && !scene.has_reservation(spot, f64::NEG_INFINITY)
        && navigator.part_beyond(network, ways, spot.chain, motion.x, way)
}
