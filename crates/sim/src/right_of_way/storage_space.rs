//! The storage space for a vehicle beyond the zones.

use laneweave_network::Side;

use crate::junction::need::SPARE_SPACE;
use crate::junction::storage_section::StorageSection;
use crate::right_of_way::survey::{BEFORE_A_ZONE, ROUNDING, parts};
use crate::route::walk::Leg;
use crate::state::lane::Phase;
use crate::state::standstill::STANDSTILL;
use crate::view::scene::{Scene, Spot, Viewpoint};

/// Vehicles are searched up to this distance beyond the zones [m] (ours).
pub(crate) const SPACE_SIGHT: f64 = 120.0;
/// Expected braking of vehicles beyond the zones [m/s²] (ours).
const EXPECTED_BRAKING: f64 = 4.0;

/// Where a vehicle would stand after its reservation. Distances are from its front now [m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beyond {
    pub(crate) section: StorageSection,
    /// Where it stops without the reservation.
    pub(crate) stop: f64,
    /// End of the zones.
    pub(crate) clear: f64,
    /// The next place to stop, or the end of the route.
    pub(crate) limit: f64,
    /// Time until it has left the zones [s].
    pub(crate) arrival: f64,
}

/// Storage space from the end of the zones [m]. It reaches to the limit, to the fork where a vehicle ahead will part,
/// or to the place where the last vehicle beyond the zones will be. There is none if a vehicle ahead is still within
/// the zones and has no reservation that leads it out of them or off the route.
pub(crate) fn space(scene: &Scene, from: Viewpoint, beyond: Beyond) -> f64 {
    const NONE: f64 = f64::NEG_INFINITY;
    let Beyond { section, stop, clear, mut limit, arrival } = beyond;
    let reach = clear + SPACE_SIGHT;
    let mut first = from.ahead;
    let mut taken = scene.reservations.kept_on(section);
    let mut end = f64::INFINITY;
    for leg in scene.walk(from).within(reach) {
        let Leg { chain, start: base, .. } = leg;
        if let Some(rear) = scene.waits_beside_in_fork(leg, from) {
            if base < clear {
                return NONE;
            }
            end = end.min(base + rear);
        }
        let lane = &scene.lanes[chain.at()];
        for (motion, index) in lane.motions()[first..].iter().zip(first..) {
            let rear = base + motion.rear();
            if motion.id == from.id {
                continue;
            }
            if rear > limit || rear > reach {
                return end.min(limit.min(reach) - taken) - clear;
            }
            let spot = Spot { chain, index };
            // One that will part may have to stand behind others on its own way.
            limit = limit.min(fork(scene, from, spot, base, limit.min(reach)).max(clear));
            let reservation = scene.reservations.of(lane.lane_change_states()[index].reservation, motion.id);
            // Behind a vehicle that stops for a light at the same place, it stops before all zones.
            let after = stop + BEFORE_A_ZONE + ROUNDING - base - motion.x;
            // Whoever stands although it may go waits for somebody who may stand for long.
            let goes = reservation.filter(|_| motion.speed >= STANDSTILL);
            let gets_to = rear + goes.map_or(0.0, |it| it.left_for_certain(after).max(0.0));
            if rear >= clear {
                // A vehicle whose reservation leads beyond the storage space does not stop in it.
                if gets_to < limit {
                    let stops_at = rear + motion.speed * motion.speed / (2.0 * EXPECTED_BRAKING);
                    // It may have to stop at the limit.
                    let last = (limit - f64::from(motion.length)).max(rear);
                    let moved = (rear + motion.speed * arrival).min(last);
                    let moves_to = if moves_up(scene, from, spot) { moved } else { rear };
                    end = end.min(moves_to.max(stops_at).max(gets_to) - taken);
                    taken += f64::from(motion.length) + SPARE_SPACE;
                }
                continue;
            }
            if gets_to < clear.min(parts(scene, from, spot, base)) - ROUNDING {
                return NONE;
            }
        }
        first = 0;
    }
    end.min(limit.min(reach) - taken) - clear
}

/// Where the routes of the vehicle at `spot`, whose chain begins `base` ahead, and of the vehicle at `from` part, at
/// the end of that chain or beyond [m]; infinite if they do not within `until`.
fn fork(scene: &Scene, from: Viewpoint, spot: Spot, base: f64, until: f64) -> f64 {
    let theirs = scene.driver(spot).goal.destination();
    let (mut chain, mut end) = (spot.chain, base + scene.network.chain(spot.chain).length);
    while end < until && theirs != from.destination {
        let Some(next) = scene.next(from.destination, chain) else { break };
        if scene.next(theirs, chain).is_some_and(|it| it != next) {
            return end;
        }
        (chain, end) = (next, end + scene.network.chain(next).length);
    }
    f64::INFINITY
}

/// Whether the vehicle at `spot` moves up as the vehicles before it do. It does if it follows the same route as the
/// vehicle at `from`, changes no lanes, and has no lane beside it.
fn moves_up(scene: &Scene, from: Viewpoint, spot: Spot) -> bool {
    let (x, driver, chain) = (scene.motion(spot).x, scene.driver(spot), scene.network.chain(spot.chain));
    let is_alone = || [Side::Left, Side::Right].iter().all(|it| chain.beside(*it, x).is_none());
    let stays = !driver.is_shadow && driver.phase == Phase::Cruises && is_alone();
    stays && parts(scene, from, spot, 0.0) == f64::INFINITY
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Motorway, motorway};
    use laneweave_network::LaneletIndex;

    use super::*;
    use crate::right_of_way::survey::tests::standing;
    use crate::route::navigate::Navigator;
    use crate::state::some_style::some_style;
    use crate::view::snapshot::{Seen, Snapshot};

    /// Whether a car 60 m ahead counts as one that moves up, on a road with so many lanes.
    fn is_expected_to_move_up(lanes: usize) -> bool {
        let road = Motorway { lanes, length_m: 1000.0, ..Motorway::default() };
        let network = motorway(&road).unwrap().build().unwrap().network;
        let (navigator, styles) = (Navigator::new(&network), [some_style()]);
        let chain = network.start_of(LaneletIndex(0)).chain;
        let cars = [(1, 40.0), (2, 100.0)].map(|(id, x)| Seen { id, chain, x, ..standing() });
        let snapshot = Snapshot::new(&network, cars);
        let scene = snapshot.scene(&network, &navigator, &styles);
        let [from, ahead] = [1, 2].map(|it| snapshot.spot(it).unwrap());
        moves_up(&scene, scene.viewpoint(from), ahead)
    }

    #[test]
    fn the_vehicle_ahead_counts_as_moving_up_only_where_no_lane_lies_beside_it() {
        assert!(is_expected_to_move_up(1));
        assert!(!is_expected_to_move_up(2));
    }
}
