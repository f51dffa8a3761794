//! Drivers consider lanes, wait for gaps, and call changes off.

use laneweave_models::change::deceleration_to_avoid;
use laneweave_network::ChainIndex;

use crate::driver::consider::consider;
use crate::driver::gap::{Hindrance, gap, room_to_yield};
use crate::driver::plan::{Ask, Outbox, Plan, Request};
use crate::driver::steering;
use crate::state::lane::Phase;
use crate::state::moment::Moment;
use crate::view::scene::{Scene, Spot};

/// Decides for all drivers of a lane.
pub(crate) fn decide(scene: &Scene, moment: Moment, chain: ChainIndex, plan: &mut Plan, outbox: &mut Outbox) {
    let lane = &scene.lanes[chain.at()];
    let (mut hints, mut last) = ([0; 2], 0);
    for (index, driver) in lane.drivers().iter().enumerate() {
        if !driver.has_to_decide(moment.clock.step) {
            continue;
        }
        if driver.is_shadow {
            continue;
        }
        // Between two drivers there are about as many entries in the lanes beside.
        hints = hints.map(|it| it + index - last);
        last = index;
        decide_one(scene, moment, Spot { chain, index }, &mut hints, plan, outbox);
    }
}

/// Decides for the driver at `spot`.
// As a call it takes a fiftieth more instructions on a motorway.
#[inline(always)]
pub(crate) fn decide_one(
    scene: &Scene,
    moment: Moment,
    spot: Spot,
    hints: &mut [usize; 2],
    plan: &mut Plan,
    outbox: &mut Outbox,
) {
    let driver = scene.driver(spot);
    match driver.phase {
        Phase::Changes => abort_if_it_must(scene, spot, outbox),
        Phase::Aborts => {}
        Phase::Cruises | Phase::Wants => {
            if driver.phase == Phase::Wants {
                go_or_ask(scene, moment, spot, outbox);
            }
            if driver.due <= moment.clock.step {
                consider(scene, moment, spot, hints, plan, outbox);
            }
        }
    }
}

/// A driver who wants to change goes if the gap is acceptable; if not, it asks to be let in.
pub(crate) fn go_or_ask(scene: &Scene, moment: Moment, spot: Spot, outbox: &mut Outbox) {
    let (motion, lane_change) = (scene.motion(spot), scene.lane_change(spot));
    let asks_from = scene.style(spot).change.asks_from();
    let request = |ask: Ask| Request {
        urgency: lane_change.urgency,
        id: motion.id,
        chain: spot.chain,
        x: motion.x,
        ask,
    };
    let Some(gap) = gap(scene, spot, lane_change.side) else { return };
    match gap.taken(scene, spot, moment.clock) {
        Ok(()) => outbox.requests.push(request(Ask::Change)),
        Err(Hindrance::InReservation | Hindrance::RequestedBefore | Hindrance::NotAllowed) => {}
        Err(_) if f64::from(lane_change.urgency) < asks_from => {}
        Err(hindrance) => {
            if let Some(found) = gap.who_can_let_in(scene, spot, &hindrance, moment.clock) {
                let behind = scene.motion(found.spot);
                let room = room_to_yield(scene, spot, found.spot);
                outbox.requests.push(request(Ask::LetIn {
                    follower: behind.id,
                    chain: found.spot.chain,
                    x: behind.x,
                    gap: (found.distance - f64::from(motion.length) - room) as f32,
                    speed: motion.speed as f32,
                }));
            }
        }
    }
}

/// Aborts a change before the crossing if the new leader forces much harder braking than the old one, or if the new
/// lane is closed.
pub(crate) fn abort_if_it_must(scene: &Scene, spot: Spot, outbox: &mut Outbox) {
    const MUCH_HARDER: f64 = 2.0;
    let (motion, driver, lane_change) = (scene.motion(spot), scene.driver(spot), scene.lane_change(spot));
    let Some(counterpart) = lane_change.counterpart.filter(|_| lane_change.progress < 0.5) else { return };
    // In a lane that ends here, or that is closed ahead, the driver could no longer stop before the end, or be back.
    let here = scene.network.chain(spot.chain);
    let end = here.ends_for.has(driver.class).then(|| here.driven_until(driver.class.is_long()) - motion.x);
    let closure = scene.end_of_lane_ahead(scene.viewpoint(spot)).map(|it| it.ahead);
    let style = scene.style_of(driver);
    let way_back = steering::way_back(&style.manner, motion, lane_change);
    let goes_on =
        |left: f64| left < way_back || deceleration_to_avoid(left.max(0.1), motion.speed, 0.0) > MUCH_HARDER;
    if end.into_iter().chain(closure).any(goes_on) {
        return;
    }
    let forced = |from| {
        scene.ahead(from).map_or(0.0, |it| deceleration_to_avoid(it.gap.max(0.1), motion.speed, it.speed))
    };
    let there = forced(scene.viewpoint_at(scene.viewpoint(spot), counterpart.chain, counterpart.x));
    let is_forced =
        there > style.safety.max_deceleration && there > forced(scene.viewpoint(spot)) + MUCH_HARDER;
    // That lane was closed in the meantime.
    if is_forced || scene.is_closed(counterpart.chain, counterpart.x) {
        let ask = Ask::Abort;
        outbox.requests.push(Request {
            urgency: lane_change.urgency,
            id: motion.id,
            chain: spot.chain,
            x: motion.x,
            ask,
        });
    }
}
