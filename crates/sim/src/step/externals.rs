//! External vehicles: before a step their users' controls are handed to the plans of their lanes; after it the world
//! notes where they are.

use laneweave_network::{ChainIndex, Network, Position};

use crate::driver::plan::{Controlled, Told};
use crate::state::control::{Control, Lateral};
use crate::state::externals::External;
use crate::state::lane::{Counterpart, Lane, Phase, VehicleId};
use crate::state::traffic::Traffic;
use crate::step::work::Work;
use crate::view::scene::Spot;

/// An external vehicle that stands this long although its driver would go lets others go first, until it moves [s]
/// (ours).
pub(super) const PATIENCE: f64 = 2.0;

/// Hands the controls of external vehicles to the plans of their lanes.
pub(crate) fn hand_out_controls(traffic: &Traffic, work: &mut Work) {
    let externals = traffic.externals();
    let touched = externals.all().iter().flat_map(|it| it.obstacles.iter().map(|at| (it.id, *at)));
    for (id, Position { chain, x }) in touched.chain(externals.rears().iter().copied()) {
        if let Some(index) = traffic.lane(chain).find_obstacle(id, x) {
            let index = index as u32;
            let stays = Controlled { index, told: Told::Stay, gives_way: false };
            work.plans[chain.at()].controls.push(stays);
        }
    }
    for external in externals.all() {
        let External { id, control, at, .. } = external;
        let gives_way = external.idle >= traffic.clock().steps(PATIENCE);
        let mut tell = |chain: ChainIndex, index: usize, told| {
            work.plans[chain.at()].controls.push(Controlled { index: index as u32, told, gives_way });
        };
        if external.off_road().is_some() || !control.is_external() {
            continue;
        }
        let lane = traffic.lane(at.chain);
        let Some(index) = lane.find(*id, at.x) else { continue };
        let Control::Drive { longitudinal, lateral } = *control else {
            tell(at.chain, index, Told::Stay);
            continue;
        };
        tell(at.chain, index, Told::Drive(longitudinal, lateral));
        let Some(Counterpart { chain, x, .. }) = lane.lane_change_states()[index].counterpart else {
            continue;
        };
        if let Some(index) = traffic.lane(chain).find(*id, x) {
            tell(chain, index, Told::Drive(longitudinal, Lateral::Driver));
        }
    }
}

/// Notes where external vehicles are now. Those that have left the map are forgotten. A vehicle that has completed the
/// change that its user asked for keeps its lane from now on.
pub(crate) fn follow_externals(network: &Network, traffic: &mut Traffic, work: &mut Work) {
    let idle = &mut work.outbox().idle;
    idle.sort_unstable();
    let longest = traffic.clock().steps(PATIENCE);
    let mut externals = std::mem::take(traffic.externals_mut());
    externals.retain(|external| {
        let is_idle = idle.binary_search(&external.id).is_ok();
        if let Some(body) = &external.body {
            external.count_idle(is_idle, body.speed > 0.0, longest);
            return true;
        }
        let Some(Spot { chain, index }) = find(network, traffic, external) else { return false };
        let lane = traffic.lane(chain);
        external.count_idle(is_idle, lane.motions()[index].speed > 0.0, longest);
        let phase = lane.drivers()[index].phase;
        let has_changed = external.phase == Phase::Changes && phase == Phase::Cruises;
        if let Control::Drive { lateral, .. } = &mut external.control
            && has_changed
            && matches!(lateral, Lateral::Change(_))
        {
            *lateral = Lateral::Keep;
        }
        (external.at, external.phase) = (Position::new(chain, lane.motions()[index].x), phase);
        true
    });
    idle.clear();
    *traffic.externals_mut() = externals;
}

/// The main entry of an external vehicle that has moved by a step.
pub(super) fn find(network: &Network, traffic: &Traffic, external: &External) -> Option<Spot> {
    let External { id, at, .. } = *external;
    let here = network.chain(at.chain);
    let beyond = here.following.iter().map(|it| Position::new(*it, (at.x - here.length).min(0.0)));
    let near = std::iter::once(at).chain(beyond);
    near.filter_map(|it| main_entry(traffic, id, it)).next().or_else(|| anywhere(traffic, id))
}

/// The main entry of a vehicle that has an entry at this position, or at most one step beyond it.
fn main_entry(traffic: &Traffic, id: VehicleId, at: Position) -> Option<Spot> {
    let lane = traffic.lane(at.chain);
    let index = lane.find(id, at.x)?;
    if !lane.drivers()[index].is_shadow {
        return Some(Spot { chain: at.chain, index });
    }
    let Counterpart { chain, x, .. } = lane.lane_change_states()[index].counterpart?;
    Some(Spot { chain, index: traffic.lane(chain).find(id, x)? })
}

/// The main entry of a vehicle, searched in all lanes.
fn anywhere(traffic: &Traffic, id: VehicleId) -> Option<Spot> {
    let is_main = |lane: &Lane| {
        let mut entries = lane.motions().iter().zip(lane.drivers());
        entries.position(|(motion, driver)| motion.id == id && !driver.is_shadow)
    };
    let lanes = traffic.lanes().iter().zip(0..);
    lanes.filter_map(|(lane, chain)| Some(Spot { chain: ChainIndex(chain), index: is_main(lane)? })).next()
}
