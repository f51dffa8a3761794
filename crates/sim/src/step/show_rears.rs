//! Where vehicles lie within each other, the rearmost one is seen. Drivers look for the next front ahead. Another
//! vehicle ahead may reach back further than that one only after a user has driven a vehicle into others.

use laneweave_network::{ChainIndex, Network, Position};

use crate::state::lane::{Entry, Kinematics, Lane};
use crate::state::traffic::Traffic;
use crate::state::vehicle::LONGEST;
use crate::step::obstacle::parked;

/// An obstacle is this far behind the front of the vehicle behind which it stands [m].
const BEHIND: f64 = 0.001;

/// Removes the obstacles of [`show_rears`].
pub(super) fn clear_rears(traffic: &mut Traffic) {
    for (id, Position { chain, x }) in traffic.externals_mut().take_rears() {
        let lane = traffic.lane_mut(chain);
        if let Some(index) = lane.find_obstacle(id, x) {
            lane.remove(index);
        }
    }
}

/// Adds an obstacle wherever a vehicle reaches back further than one whose front is behind its own.
pub(super) fn show_rears(network: &Network, traffic: &mut Traffic) {
    let hanging = hanging(network, traffic);
    let mut rears = Vec::new();
    for chain in (0..traffic.lanes().len() as u32).map(ChainIndex) {
        let first = hanging.partition_point(|it| it.0 < chain);
        let hangs_back = hanging.get(first).filter(|it| it.0 == chain).map(|it| it.1);
        rears.extend(hidden(traffic.lane(chain), hangs_back).into_iter().map(|it| (chain, it)));
    }
    for (chain, entry) in rears {
        let Kinematics { id, x, .. } = entry.motion;
        traffic.externals_mut().note_rear(id, Position::new(chain, x));
        traffic.insert(chain, entry);
    }
}

/// The vehicles that hang back onto chains before their own, with their places there, by chain, rearmost first.
fn hanging(network: &Network, traffic: &Traffic) -> Vec<(ChainIndex, Entry)> {
    let mut found = Vec::new();
    for (here, lane) in (0..).map(ChainIndex).zip(traffic.lanes()) {
        let near_start = lane.motions().iter().take_while(|it| it.x < LONGEST).enumerate();
        for (index, _) in near_start.filter(|(_, it)| it.rear() < 0.0) {
            let mut entry = lane.entry(index);
            for chain in entry.lane_change.previous_lanes.back(network, here) {
                if entry.motion.rear() >= 0.0 {
                    break;
                }
                entry.motion.x += network.chain(chain).length;
                found.push((chain, entry));
            }
        }
    }
    found
        .sort_by(|(chain, a), (other, b)| chain.cmp(other).then(a.motion.rear().total_cmp(&b.motion.rear())));
    found
}

/// The obstacles that show what drivers would not see. The vehicle that `hangs_back` has its front beyond the lane. A
/// vehicle has one at a place: several vehicles may end at the end of a lane.
fn hidden(lane: &Lane, hangs_back: Option<Entry>) -> Vec<Entry> {
    let mut found: Vec<Entry> = Vec::new();
    let mut rearmost = (hangs_back.map_or(f64::INFINITY, |it| it.motion.rear()), None);
    for (index, motion) in lane.motions().iter().enumerate().rev() {
        let (x, (rear, of)) = (motion.x - BEHIND, rearmost);
        if motion.rear() <= rear {
            rearmost = (motion.rear(), Some(index));
        } else if let Some(of) = of.map(|it| lane.entry(it)).or(hangs_back).filter(|_| x > rear) {
            let is_shown = |it: &Entry| (it.motion.id, it.motion.x) == (of.motion.id, x);
            if found.last().is_some_and(is_shown) {
                continue;
            }
            found.push(Entry {
                motion: Kinematics { x, length: (x - rear) as f32, ..of.motion },
                ..parked(&of)
            });
        }
    }
    found
}
