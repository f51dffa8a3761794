//! Where a driver considers a side: places that may have a rate of changes of their own.
//!
//! On most roads the route explains most changes, and no recording shows the route of a driver before it has taken it.
//! What is known is where a driver is: in which lane, how far before the next fork, and to which side it would change.

use laneweave_network::{Network, Side};
use laneweave_recorded::Frame;

/// A place with a side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// The site.
    pub site: u32,
    /// The lane: a run of lanelets without forks.
    pub chain: u32,
    /// 0: left, 1: right.
    pub side: u8,
    /// How far before the next fork or the end of the lane.
    pub distance: u8,
}

/// Upper ends of the classes of distance before a fork, but for the last class [m] (ours).
const DISTANCES: [f64; 3] = [50.0, 150.0, 400.0];

impl Place {
    /// Where the driver of a vehicle considers `side`.
    pub(super) fn of(network: &Network, frame: &Frame, vehicle: i64, side: Side, site: u32) -> Option<Place> {
        let spot = frame.spot(vehicle)?;
        let left = network.chain(spot.chain).length - frame.scene().motion(spot).x;
        let distance = DISTANCES.partition_point(|it| *it < left) as u8;
        Some(Place { site, chain: spot.chain.0, side: side.at() as u8, distance })
    }

    /// The same lane and side at any distance.
    pub fn lane(&self) -> Place {
        Place { distance: u8::MAX, ..*self }
    }
}
