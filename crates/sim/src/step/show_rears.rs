//! Where vehicles lie within each other, the rearmost one is seen. Drivers look for the next front ahead. Another
//! vehicle ahead may reach back further than that one only after a user has driven a vehicle into others.

use laneweave_network::{ChainIndex, Position};

use crate::state::lane::{Entry, Kinematics, Lane};
use crate::state::traffic::Traffic;
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
pub(super) fn show_rears(traffic: &mut Traffic) {
    let mut rears = Vec::new();
    for chain in 0..traffic.lanes().len() as u32 {
        let lane = traffic.lane(ChainIndex(chain));
        rears.extend(hidden(lane).into_iter().map(|it| (ChainIndex(chain), it)));
    }
    for (chain, entry) in rears {
        let Kinematics { id, x, .. } = entry.motion;
        traffic.externals_mut().note_rear(id, Position::new(chain, x));
        traffic.insert(chain, entry);
    }
}

/// The obstacles that show what drivers would not see.
fn hidden(lane: &Lane) -> Vec<Entry> {
    let motions = lane.motions();
    let mut found = Vec::new();
    let mut furthest = motions.len().saturating_sub(1);
    for (index, motion) in motions.iter().enumerate().rev() {
        let (x, rear) = (motion.x - BEHIND, motions[furthest].rear());
        if motion.rear() <= rear {
            furthest = index;
        } else if x > rear {
            let of = lane.entry(furthest);
            found.push(Entry {
                motion: Kinematics { x, length: (x - rear) as f32, ..of.motion },
                ..parked(&of)
            });
        }
    }
    found
}
