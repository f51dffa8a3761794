//! The share of a section's capacity that lane changes leave.
//!
//! Drivers who have to change lanes within a short section leave gaps that nobody fills, the more the larger their
//! share. The Highway Capacity Manual (2010, chapter 12, from memory) gives the capacity of a lane of a weaving
//! section as c = c₀ − 438.2 (1 + VR)^1.6 + 0.0765 L + 119.8 N, with c₀ = 2,400 veh/h, VR the share of vehicles that
//! change, L the length of the section [ft], and N the number of lanes from which one change is enough, here 2;
//! beyond L = 5728 (1 + VR)^1.6 − 1566 N it is no such section. We apply the same share to the flow of our drivers on
//! a plain road. Merges are treated in the same way (ours).

use laneweave_network::Position;
use laneweave_sim::{Assignment, Change};

/// c₀ [veh/h].
const PLAIN: f64 = 2400.0;
/// N.
const LANES: f64 = 2.0;
const METRES_PER_FOOT: f64 = 0.3048;
/// Stretches are distinguished down to this length [m].
const LEAST: f64 = 1.0;

/// The remaining share of the capacity of lanes side by side at the end of a section of `length` [m], each lane at a
/// station [m], with a `flow` [veh/s] on them. Vehicles with more road for their change make only a part of it in the
/// section.
pub(super) fn left(assignment: &Assignment, lanes: &[Position], flow: f64, length: f64) -> f64 {
    let changing = |it: &Change| {
        let ((chain, [start, end]), (to, [beside, _])) = (it.from, it.to);
        let at = lanes.iter().find(|it| it.chain == chain).map(|it| it.x);
        // Vehicles that change to a lane without other vehicles, such as one that leads off, find it free.
        let at = at.filter(|_| assignment.flow(to, beside.max(0.0))[1] > 0.0)?;
        let within = end.min(at) - start.max(at - length);
        Some(it.flow * (within / (end - start).max(LEAST)).clamp(0.0, 1.0))
    };
    let here = assignment.changes_from(lanes.iter().map(|it| it.chain));
    let changing: f64 = here.filter_map(changing).sum();
    if changing > 0.0 { left_by(changing / flow, length) } else { 1.0 }
}

/// The remaining share if a `share` of the vehicles changes within `length` [m].
fn left_by(share: f64, length: f64) -> f64 {
    let weaves = libm::pow(1.0 + share.min(1.0), 1.6);
    let feet = length / METRES_PER_FOOT;
    if feet > 5728.0 * weaves - 1566.0 * LANES {
        return 1.0;
    }
    let lost = 438.2 * weaves - 0.0765 * feet - 119.8 * LANES;
    1.0 - lost.max(0.0) / PLAIN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_more_change_and_the_shorter_the_section_the_less_is_left() {
        // 1.25^1.6 = 1.42903: 626.2 − 75.3 − 239.6 of 2,400.
        assert!((left_by(0.25, 300.0) - (1.0 - 311.3 / 2400.0)).abs() < 1e-4, "{}", left_by(0.25, 300.0));
        assert!(left_by(0.5, 300.0) < left_by(0.25, 300.0));
        assert!(left_by(0.25, 150.0) < left_by(0.25, 300.0));
        // 5728 · 1.42903 − 3132 ft = 1,540 m.
        assert!(left_by(0.25, 1539.0) < 1.0);
        assert_eq!(left_by(0.25, 1541.0), 1.0);
    }
}
