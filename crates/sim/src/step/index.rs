//! Where each vehicle is, by its id. Few lookups after a step search all lanes; with more of them an index pays, and is
//! made.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use laneweave_network::{ChainIndex, Position};

use crate::state::lane::{Lane, VehicleId};
use crate::view::scene::Spot;

/// So many lookups search all lanes before the index is made, which takes the time of some thirty of them (measured).
const SEARCHES: u32 = 10;

/// The main entries of all vehicles.
#[derive(Debug, Default)]
pub(crate) struct Index {
    /// In the order of ids, if that was made.
    all: OnceLock<Vec<(VehicleId, Position)>>,
    /// The lookups since vehicles have moved.
    lookups: AtomicU32,
}

impl Index {
    /// Forgets all: vehicles have moved, come or gone.
    #[inline]
    pub(crate) fn forget(&mut self) {
        *self.lookups.get_mut() = 0;
        self.all.take();
    }

    /// The main entry of a vehicle on these `lanes`, if it is on the road.
    pub(crate) fn spot(&self, lanes: &[Lane], id: VehicleId) -> Option<Spot> {
        if self.lookups.fetch_add(1, Ordering::Relaxed) < SEARCHES {
            return search(lanes, id);
        }
        let all = self.all.get_or_init(|| positions(lanes));
        let place = all.binary_search_by_key(&id, |it| it.0).ok()?;
        let Position { chain, x } = all[place].1;
        Some(Spot { chain, index: lanes[chain.at()].find(id, x)? })
    }
}

/// Searches all lanes for a vehicle.
fn search(lanes: &[Lane], id: VehicleId) -> Option<Spot> {
    lanes.iter().zip(0..).find_map(|(lane, chain)| {
        let index = lane
            .motions()
            .iter()
            .zip(lane.drivers())
            .position(|(it, driver)| it.id == id && !driver.is_shadow)?;
        Some(Spot { chain: ChainIndex(chain), index })
    })
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
