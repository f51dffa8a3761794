//! Forks: near a fork, a vehicle that takes another branch may still be in the way.

use laneweave_network::{ChainIndex, ForkBranch};

use crate::route::walk::Leg;
use crate::state::lane::{Kinematics, LaneChangeState};
use crate::state::previous_lanes::PreviousLanes;
use crate::view::scene::{Scene, Spot, Viewpoint, nearest};

impl Scene<'_> {
    /// The nearest vehicle ahead of the one at `from`, on another branch of a fork from which its route has not parted
    /// yet on this `leg`; and the distance of its rear bumper from the start of the leg [m].
    #[inline]
    pub(crate) fn beside_in_fork(&self, leg: Leg, from: Viewpoint) -> Option<(Spot, f64)> {
        let branches = self.branches_beside(leg);
        nearest(branches.iter().filter_map(|branch| {
            let (spot, rear) = self.first_on(branch, leg, from)?;
            (rear < self.until(branch, from, spot)).then_some((spot, branch.start + rear))
        }))
    }

    /// The same for a vehicle that has no reservation which leads it out of the way.
    #[inline]
    pub(crate) fn waits_beside_in_fork(&self, leg: Leg, from: Viewpoint) -> Option<f64> {
        let branches = self.branches_beside(leg);
        let waiting = branches.iter().filter_map(|branch| {
            let (spot, rear) = self.first_on(branch, leg, from)?;
            let goes_on = self.reservation(spot).map_or(0.0, |it| it.left().max(0.0));
            (rear + goes_on < self.until(branch, from, spot)).then_some(branch.start + rear)
        });
        waiting.reduce(f64::min)
    }

    /// The branches from which a route has not parted on this leg.
    #[inline]
    fn branches_beside(&self, leg: Leg) -> &[ForkBranch] {
        let chain = self.network.chain(leg.chain);
        if -leg.start < chain.fork_clearance { &chain.branches } else { &[] }
    }

    /// Where the rear of the vehicle at `spot` is out of the way of the one at `from` [m].
    fn until(&self, branch: &ForkBranch, from: Viewpoint, spot: Spot) -> f64 {
        branch.until([from.class.is_long(), self.driver(spot).class.is_long()])
    }

    /// The first vehicle on a branch that came there over the fork, as the one at `from` comes to this `leg` of its
    /// route, and is further from the fork; and where its rear is [m].
    fn first_on(&self, branch: &ForkBranch, leg: Leg, from: Viewpoint) -> Option<(Spot, f64)> {
        let lane = &self.lanes[branch.chain.at()];
        let is_ahead =
            |it: &Kinematics| it.id != from.id && (branch.start + it.x, from.id) > (-leg.start, it.id);
        let came =
            |it: &LaneChangeState| it.previous_lanes.came_over(self.network, branch.chain, &branch.over);
        let mut all = lane.motions().iter().zip(lane.lane_change_states()).enumerate();
        let (index, (motion, _)) = all.find(|(_, (it, lane_change))| is_ahead(it) && came(lane_change))?;
        let comes = self.comes_over(leg, from, &branch.own_over);
        comes.then_some((Spot { chain: branch.chain, index }, motion.rear()))
    }

    /// Whether the vehicle at `from` comes to this `leg` of its route over these chains, the nearest first.
    fn comes_over(&self, leg: Leg, from: Viewpoint, over: &[ChainIndex]) -> bool {
        let passed = leg.passed.known().count();
        let (ahead, behind) = over.split_at(passed.min(over.len()));
        ahead.iter().copied().zip(leg.passed.known()).all(|(it, chain)| it == chain)
            && (behind.is_empty() || passed == PreviousLanes::KNOWN || self.came_over(from, behind))
    }

    /// Whether the vehicle at `from` came to its chain over these, the nearest first. Of a vehicle that is not there
    /// it is assumed.
    fn came_over(&self, from: Viewpoint, over: &[ChainIndex]) -> bool {
        let itself = from.ahead.checked_sub(1).filter(|it| self.motions(from.chain)[*it].id == from.id);
        itself.is_none_or(|index| {
            let previous_lanes = self.lane_change(Spot { chain: from.chain, index }).previous_lanes;
            previous_lanes.came_over(self.network, from.chain, over)
        })
    }
}
