//! Vehicles that come on the other side of a zone, and when they arrive.

use laneweave_models::yielding::time_to_cover;
use laneweave_network::{ChainIndex, LightState, Reach, Sign, ZoneIndex};

use crate::view::scene::{Scene, Spot};

/// How far back vehicles are searched along the road [m] (ours).
const SIGHT: f64 = 130.0;
/// Largest number of chains that are searched.
const MOST_CHAINS: usize = 24;
/// A vehicle slower than this stands [m/s]. If it waits for its turn, that turn counts; others need not wait for it to
/// start.
const STANDS: f64 = 0.5;

/// Shortest time [s] in which a vehicle without a reservation for `zone` arrives at its side `reach`; infinite if no
/// vehicle is in sight.
pub(crate) fn lag(scene: &Scene, zone: ZoneIndex, reach: &Reach) -> f64 {
    let mut open: [(ChainIndex, f64, f64); MOST_CHAINS] = [(reach.chain, reach.start, 0.0); MOST_CHAINS];
    let (mut at, mut count) = (0, 1);
    let mut least = f64::INFINITY;
    while at < count {
        // Vehicles before the station `end` of the chain are searched; `end` is `base` before the zone.
        let (chain, end, base) = open[at];
        at += 1;
        let is_before_it = at > 1;
        let red = red_before(scene, chain, end);
        let lane = &scene.lanes[chain.at()];
        let from = lane.motions().partition_point(|it| it.x < end);
        let mut is_shielded = false;
        for index in (0..from).rev() {
            let (motion, driver) = (&lane.motions()[index], &lane.drivers()[index]);
            let distance = base + end - motion.x;
            if distance > SIGHT || red.is_some_and(|red| motion.x < red) {
                is_shielded = true;
                break;
            }
            let spot = Spot { chain, index };
            if driver.is_shadow
                || holds(scene, spot, zone)
                || (is_before_it && !comes(scene, spot, &open[..at]))
            {
                continue;
            }
            is_shielded = true;
            if motion.speed >= STANDS {
                least = least.min(time_to_cover(distance, motion.speed, f64::from(driver.desired)));
            }
            break;
        }
        if is_shielded || red.is_some() || base + end > SIGHT {
            continue;
        }
        for back in &scene.network.chain(chain).previous {
            let known = open[..count].iter().any(|it| it.0 == *back);
            if count < MOST_CHAINS && !known {
                open[count] = (*back, scene.network.chain(*back).length, base + end);
                count += 1;
            }
        }
    }
    least
}

/// The last station before `end` with a red light [m].
fn red_before(scene: &Scene, chain: ChainIndex, end: f64) -> Option<f64> {
    let stops = scene.network.junctions.on(chain).stops.iter().rev();
    let is_red = |sign: Sign| matches!(sign, Sign::Light(it) if scene.light(it) == LightState::Red);
    stops.filter(|it| it.station < end && is_red(it.sign)).map(|it| it.station).next()
}

fn holds(scene: &Scene, spot: Spot, zone: ZoneIndex) -> bool {
    let reservation = scene.reservations.of(scene.lane_change(spot).reservation, scene.motion(spot).id);
    reservation.is_some_and(|it| it.holds.iter().any(|hold| hold.zone == zone))
}

/// Whether the route of a vehicle leads to the zone over the chains that were searched.
fn comes(scene: &Scene, spot: Spot, looked: &[(ChainIndex, f64, f64)]) -> bool {
    let destination = scene.driver(spot).goal.destination();
    let way = scene.navigator.walk(scene.network, destination, spot.chain, 0.0).skip(1);
    way.take(looked.len()).any(|it| it.chain == looked[0].0)
}
