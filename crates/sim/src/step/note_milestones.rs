//! Milestones of lane changes.

use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::milestone::{Milestone, Reached};
use crate::state::traffic::Traffic;
use crate::step::work::Work;
use laneweave_network::Position;

/// Notes the milestones of lane changes, in an order that depends on vehicles only.
pub(crate) fn note_milestones(roads: &Roads, traffic: &mut Traffic, log: &mut Log, work: &mut Work) {
    let milestones = &mut work.outbox().milestones;
    milestones.sort_unstable_by_key(|it| (it.id, it.what));
    for milestone in milestones.drain(..) {
        log.note_milestone(roads.network(), &milestone, traffic.clock().time());
        if milestone.what != Reached::Crossing {
            begin_cooldown(roads, traffic, &milestone);
        }
    }
}

/// Begins the cooldown after a change, or after one was given up.
fn begin_cooldown(roads: &Roads, traffic: &mut Traffic, milestone: &Milestone) {
    let (Position { chain, x }, clock) = (milestone.at, traffic.clock());
    let lane = traffic.lane_mut(chain);
    if let Some(index) = lane.find(milestone.id, x) {
        let driver = lane.entry_mut(index).1;
        driver.cooldown_until = clock.step + clock.steps(roads.style(driver.parameters).manner.calm);
    }
}
