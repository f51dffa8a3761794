//! Drivers see what stands in a lane from afar, as they see a closed lane: a vehicle that a user drives, and that
//! stands although its driver would go.

use laneweave_network::Position;

use crate::route::closures::Standing;
use crate::route::roads::Roads;
use crate::state::control::{Control, Longitudinal};
use crate::state::externals::External;
use crate::state::traffic::Traffic;
use crate::step::change_roads::close;
use crate::step::externals::PATIENCE;

/// Lets drivers know what stands in lanes now.
pub(crate) fn see_standing(roads: &mut Roads, traffic: &mut Traffic) {
    if traffic.externals().is_empty() && roads.navigator().closures().standing().is_empty() {
        return;
    }
    let standing = standing(traffic);
    if standing != roads.navigator().closures().standing() {
        close(roads, traffic, |roads| roads.note_standing(standing));
        note_passable(roads, traffic);
    }
}

/// Notes since when drivers can go round what stands in lanes.
fn note_passable(roads: &Roads, traffic: &mut Traffic) {
    let (closures, step) = (roads.navigator().closures(), traffic.clock().step);
    let mut externals = std::mem::take(traffic.externals_mut());
    for external in externals.all_mut() {
        let Position { chain, x } = external.at;
        let is_passable = closures.close_behind(chain, x);
        external.passable_since = is_passable.then_some(external.passable_since.unwrap_or(step));
    }
    *traffic.externals_mut() = externals;
}

/// What stands in lanes. A recorded vehicle goes on as it was recorded.
pub(super) fn standing(traffic: &Traffic) -> Vec<Standing> {
    let longest = traffic.clock().steps(PATIENCE);
    let stands = |it: &&External| !it.is_recorded && it.idle >= if is_held(it) { 1 } else { longest };
    let of = |external: &External| {
        let main = external.off_road().is_none().then(|| {
            let lane = traffic.lane(external.at.chain);
            Some((external.at.chain, &lane.motions()[lane.find(external.id, external.at.x)?]))
        });
        let touched = external.obstacles.iter().filter_map(|at| {
            let lane = traffic.lane(at.chain);
            Some((at.chain, &lane.motions()[lane.find_obstacle(external.id, at.x)?]))
        });
        let all = main.flatten().into_iter().chain(touched);
        all.map(|(chain, it)| Standing { chain, reach: [it.rear(), it.x] }).collect::<Vec<_>>()
    };
    traffic.externals().all().iter().filter(stands).flat_map(of).collect()
}

/// Whether its user lets it stand, whatever is ahead.
fn is_held(external: &External) -> bool {
    matches!(external.control, Control::Drive { longitudinal: Longitudinal::Speed(0.0), .. })
}
