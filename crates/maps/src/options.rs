//! How to read a map.

use laneweave_network::DrivingSide;

use crate::law::Law;
use crate::size::Size;

/// How to read a map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Latitude and longitude that become (0, 0) of the local frame [°]. Without it, the place of the map's first
    /// node, rounded to 0.1°. It has no effect on maps with metric coordinates of their own.
    pub origin: Option<(f64, f64)>,
    /// The law whose speed limits apply where the map gives none.
    pub law: Law,
    /// On which side traffic drives. Without it, the map decides, or else the right.
    pub driving_side: Option<DrivingSide>,
    /// Largest size of its text, unpacked if it is compressed, up to [`Size::MAXIMUM`].
    pub largest: Size,
}
