//! Forks: near a fork, a vehicle that takes another branch may still be in the way.

use laneweave_models::follow::Ahead;
use laneweave_network::ChainIndex;

use crate::state::lane::{Kinematics, LaneChangeState, VehicleId};
use crate::state::vehicle::LONGEST;
use crate::view::scene::{Scene, Spot, Viewpoint, nearer, nearest};

impl<'a> Scene<'a> {
    /// The nearer of the leader on the own route and a vehicle on another branch of the fork behind that is still in
    /// the way.
    #[inline(never)]
    pub(crate) fn nearest_in_fork(&self, from: Viewpoint, on_way: Option<Ahead>) -> Option<Ahead> {
        let beside = self.beside_in_fork(from);
        nearer(on_way, beside.map(|(spot, rear)| self.rear_ahead(spot, rear - from.x)))
    }

    /// The nearest vehicle ahead on another branch of the fork behind that is still in the way, and the distance of its
    /// rear bumper from the fork [m].
    pub(crate) fn beside_in_fork(&self, from: Viewpoint) -> Option<(Spot, f64)> {
        let siblings = self.siblings(from.chain);
        nearest(siblings.filter_map(|(back, it)| self.last_in_fork(back, it, from.id, from.x)))
    }

    /// The vehicle at `spot` as a leader, with its rear bumper `gap` ahead [m].
    pub(crate) fn rear_ahead(&self, spot: Spot, gap: f64) -> Ahead {
        self.motion(spot).ahead(gap)
    }

    /// The other branches of the forks that lead to `chain`, each with the chain before the fork.
    fn siblings(&self, chain: ChainIndex) -> impl Iterator<Item = (ChainIndex, ChainIndex)> + 'a {
        let network = self.network;
        network.chain(chain).previous.iter().flat_map(move |back| {
            let following = network.chain(*back).following.iter();
            following.filter(move |it| **it != chain).map(move |it| (*back, *it))
        })
    }

    /// The last vehicle beyond `x` that went from `back` to `sibling` and is still in the way of the other branches,
    /// and the distance of its rear bumper from the fork [m].
    #[inline]
    fn last_in_fork(
        &self,
        back: ChainIndex,
        sibling: ChainIndex,
        id: VehicleId,
        x: f64,
    ) -> Option<(Spot, f64)> {
        let chain = self.network.chain(sibling);
        let last = |on: ChainIndex, came_from: ChainIndex, base: f64| {
            let lane = &self.lanes[on.at()];
            let mut all = lane.motions().iter().zip(lane.lane_change_states()).enumerate();
            let is_ahead = |it: &Kinematics| it.id != id && (base + it.x, id) > (x, it.id);
            let came = |lane_change: &LaneChangeState| {
                lane_change.previous_lanes.came_from(self.network, on, came_from)
            };
            let (index, (it, _)) = all.find(|(_, (it, lane_change))| came(lane_change) && is_ahead(it))?;
            let rear = base + it.rear();
            (rear < chain.fork_clearance).then_some((Spot { chain: on, index }, rear))
        };
        let own = last(sibling, back, 0.0);
        if chain.length >= chain.fork_clearance + LONGEST {
            return own;
        }
        let hanging = chain.following.iter().filter_map(|it| last(*it, sibling, chain.length));
        nearest(own.into_iter().chain(hanging))
    }

    /// The last vehicle that went from `chain` to another branch than `next` and is still in the way, and the distance
    /// of its rear bumper from the fork [m].
    pub(crate) fn beyond_the_fork(
        &self,
        chain: ChainIndex,
        next: ChainIndex,
        id: VehicleId,
    ) -> Option<(Spot, f64)> {
        let following = &self.network.chain(chain).following[..];
        if following.len() < 2 {
            return None;
        }
        let siblings = following.iter().filter(|it| **it != next);
        nearest(siblings.filter_map(|it| self.last_in_fork(chain, *it, id, f64::NEG_INFINITY)))
    }

    /// Distance of the rear bumper from the fork of a vehicle that went from `chain` to another branch than `next`, is
    /// still in the way, and has no reservation that leads it out of the way [m].
    #[inline]
    pub(crate) fn waits_in_fork(&self, chain: ChainIndex, next: ChainIndex, id: VehicleId) -> Option<f64> {
        let siblings = self.network.chain(chain).following.iter().filter(|it| **it != next);
        siblings.filter_map(|it| self.waits_on(chain, *it, id, f64::NEG_INFINITY)).reduce(f64::min)
    }

    /// The same for a vehicle that is within the fork itself.
    #[inline]
    pub(crate) fn waits_beside_in_fork(&self, from: Viewpoint) -> Option<f64> {
        let chain = self.network.chain(from.chain);
        if from.x >= chain.fork_clearance {
            return None;
        }
        self.siblings(from.chain)
            .filter_map(|(back, it)| self.waits_on(back, it, from.id, from.x))
            .reduce(f64::min)
    }

    /// Rear bumper of the first vehicle beyond `x` that came from `back` onto `sibling` [m], if it is in the way of the
    /// other branches, and no reservation leads it out of the way.
    fn waits_on(&self, back: ChainIndex, sibling: ChainIndex, id: VehicleId, x: f64) -> Option<f64> {
        let lane = &self.lanes[sibling.at()];
        let mut came = lane.motions().iter().zip(lane.lane_change_states());
        let is_ahead = |it: &Kinematics| it.id != id && (it.x, id) > (x, it.id);
        let (other, lane_change) = came.find(|(it, lane_change)| {
            is_ahead(it) && lane_change.previous_lanes.came_from(self.network, sibling, back)
        })?;
        let goes_on =
            self.reservations.of(lane_change.reservation, other.id).map_or(0.0, |it| it.left().max(0.0));
        let stays = other.rear() + goes_on < self.network.chain(sibling).fork_clearance;
        stays.then(|| other.rear())
    }
}
