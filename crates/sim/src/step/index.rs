//! Where each vehicle is, by its id. The index is made when it is first needed after a step.

use std::sync::OnceLock;

use laneweave_network::{ChainIndex, Position};

use crate::state::lane::{Lane, VehicleId};
use crate::view::scene::Spot;

/// The main entries of all vehicles, in the order of ids.
#[derive(Debug, Default)]
pub(crate) struct Index(OnceLock<Vec<(VehicleId, Position)>>);

impl Index {
    /// Forgets all: vehicles have moved, come or gone.
    #[inline]
    pub(crate) fn forget(&mut self) {
        self.0.take();
    }

    /// The main entry of a vehicle on these `lanes`, if it is on the road.
    pub(crate) fn spot(&self, lanes: &[Lane], id: VehicleId) -> Option<Spot> {
        let all = self.0.get_or_init(|| positions(lanes));
        let place = all.binary_search_by_key(&id, |it| it.0).ok()?;
        let Position { chain, x } = all[place].1;
        Some(Spot { chain, index: lanes[chain.at()].find(id, x)? })
    }
}

fn positions(lanes: &[Lane]) -> Vec<(VehicleId, Position)> {
    let mut all: Vec<(VehicleId, Position)> = Vec::new();
    for (lane, index) in lanes.iter().zip(0..) {
        let main = lane.motions().iter().zip(lane.drivers()).filter(|(_, driver)| !driver.is_shadow);
        all.extend(main.map(|(motion, _)| (motion.id, Position::new(ChainIndex(index), motion.x))));
    }
    all.sort_unstable_by_key(|it| it.0);
    all
}
