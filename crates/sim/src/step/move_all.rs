//! The parallel part of a step: all drivers look, then all vehicles move.

use laneweave_network::ChainIndex;

use crate::driver::decide::decide;
use crate::driver::drive::drive;
use crate::driver::obey::{Before, obey};
use crate::driver::request_reservation::request_reservations;
use crate::junction::state::JunctionState;
use crate::record::overlap::overlaps;
use crate::route::roads::Roads;
use crate::state::moment::Moment;
use crate::state::traffic::{Moving, Traffic};
use crate::step::advance::{Ends, advance};
use crate::step::work::{Work, pool_for};
use crate::view::scene::Scene;

/// All drivers perceive, decide and drive on the same snapshot; then their plans are carried out.
pub(crate) fn move_all(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &JunctionState,
    work: &mut Work,
    is_watched: bool,
) {
    let Work { plans, outboxes, pools } = work;
    let pool = &mut pools[pool_for(traffic.crowd())];
    let Moving { clock, lanes, chosen, externals } = traffic.moving();
    let (network, navigator, driver_parameters) =
        (roads.network(), roads.navigator(), roads.driver_parameters());
    let (reservations, signals) = (junctions.reservations(), junctions.signals());
    let moment = Moment { clock, random: roads.random(), overtaking: network.driving_side.overtaking() };
    let errors = roads.errors();
    pool.look_then_act(
        outboxes,
        lanes,
        plans,
        chosen,
        |lanes, outbox, index, plan| {
            let scene = Scene {
                network,
                navigator,
                lanes,
                driver_parameters,
                dt: clock.dt,
                reservations,
                signals,
                externals,
                errors,
            };
            let chain = ChainIndex(index as u32);
            plan.clear();
            let before = Before::of(outbox);
            decide(&scene, moment, chain, plan, outbox);
            drive(&scene, clock, chain, plan, outbox);
            if !plan.controls.is_empty() {
                obey(&scene, moment, chain, before, plan, outbox);
            }
            request_reservations(&scene, clock, chain, plan, outbox);
            if is_watched {
                overlaps(&scene, chain, clock.time(), &mut outbox.incidents);
            }
        },
        |lane, outbox, index, plan| {
            let chain = ChainIndex(index as u32);
            let ends = Ends { length: network.chain(chain).length, trips: navigator.trip_ends(chain) };
            advance(lane, chain, ends, clock, driver_parameters, plan, outbox);
        },
    );
}
