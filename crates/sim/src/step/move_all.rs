//! All look, then all move.

use laneweave_network::ChainIndex;

use crate::driver::decide::decide;
use crate::driver::drive::drive;
use crate::driver::request_passage::request_passages;
use crate::junction::state::JunctionState;
use crate::record::overlap::overlaps;
use crate::route::roads::Roads;
use crate::state::moment::Moment;
use crate::state::moving::Traffic;
use crate::step::advance::{Ends, advance};
use crate::step::work::{Work, pool_for};
use crate::step::world::World;
use crate::view::scene::Scene;

impl World {
    /// Everybody perceives, decides and drives on what all see; then what was resolved is carried out.
    pub(crate) fn move_all(&mut self, is_watched: bool) {
        let World { roads, traffic, junctions, work, .. } = self;
        let Traffic { clock, lanes, busy, crowd } = traffic;
        let Work { plans, outboxes, pools } = work;
        let Roads { network, navigator, characters, random, .. } = &*roads;
        let JunctionState { passages, signals } = &*junctions;
        let chosen = busy.chosen();
        let (network, characters) = (&**network, &characters[..]);
        let moment = Moment { clock: *clock, random: *random, overtaking: network.driving_side.overtaking() };
        pools[pool_for(*crowd)].look_then_act(
            outboxes,
            lanes,
            plans,
            chosen,
            |lanes, outbox, index, plan| {
                let scene = Scene { network, navigator, lanes, characters, passages, signals };
                let chain = ChainIndex(index as u32);
                plan.clear();
                decide(&scene, moment, chain, plan, outbox);
                drive(&scene, moment.clock, chain, plan, outbox);
                request_passages(&scene, moment.clock, chain, plan, outbox);
                if is_watched {
                    overlaps(&scene, chain, moment.clock.time(), &mut outbox.incidents);
                }
            },
            |lane, outbox, index, plan| {
                let chain = ChainIndex(index as u32);
                let ends = Ends { length: network.chain(chain).length, trips: navigator.trip_ends(chain) };
                advance(lane, chain, ends, moment.clock, characters, plan, outbox);
            },
        );
    }
}
