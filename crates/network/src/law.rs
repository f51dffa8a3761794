//! What the traffic law asks of drivers beside the limits of single lanelets.

/// The rules of the law of the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadLaw {
    /// Which lanes it wants drivers to use.
    pub lane_use: LaneUse,
    /// The same of cars and motorcycles in towns.
    pub lane_use_in_town: LaneUse,
    /// Speed limit of long vehicles on any road [m/s].
    pub limit_of_long: f64,
}

impl RoadLaw {
    /// No rule about lanes, and a limit of 80 km/h for long vehicles.
    pub const FREE: RoadLaw =
        RoadLaw { lane_use: LaneUse::Free, lane_use_in_town: LaneUse::Free, limit_of_long: 80.0 / 3.6 };
}

impl Default for RoadLaw {
    fn default() -> RoadLaw {
        RoadLaw::FREE
    }
}

/// Which of several lanes the law wants drivers to use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LaneUse {
    /// Any; drivers may pass on either side.
    #[default]
    Free,
    /// The slow side, unless they overtake; in free traffic nobody passes on the slow side.
    SlowSide,
    /// The slow side for drivers who are slower than the limit; all may pass on either side.
    SlowSideIfSlower,
}
