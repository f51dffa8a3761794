//! What a driver knows when it considers one side. It is plain data, which a test can construct.

use super::headway::Flow;
use crate::comfortable::comfortably;
use crate::follow::{Ahead, CarFollowing, FollowingModel, Pace};

/// x₀: how far ahead drivers anticipate [m] (Schakel, Knoop, van Arem 2012).
pub const SIGHT: f64 = 295.0;

/// Where a lane beside lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toward {
    /// On the overtaking side.
    Offside,
    /// On the side of the kerb.
    Nearside,
}

/// Speed below which traffic is congested, so that drivers may pass on the slow side [m/s] (as v_crit of Kesting,
/// Treiber, Helbing 2007).
pub(super) const CONGESTED: f64 = 60.0 / 3.6;

/// Whether a driver at `speed` [m/s] may not pass on the slow side of `offside`, its leader in the overtaking lane, in
/// traffic that is not congested: faster than `congested` [m/s].
#[inline]
pub(super) fn may_not_pass(speed: f64, offside: Ahead, congested: f64) -> bool {
    speed > offside.speed && offside.speed > congested
}

/// What the law asks of a driver about lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LaneRule {
    /// It may use any lane, and pass on either side.
    #[default]
    Free,
    /// It has to keep to the slow side, and may pass on either side.
    SlowSide,
    /// It has to keep to the slow side, and in free traffic passes nobody there.
    NoPassingThere,
}

impl LaneRule {
    /// Whether the driver has to keep to the slow side.
    #[inline]
    pub fn keeps(self) -> bool {
        self != LaneRule::Free
    }
}

/// A driver considers changing to the lane `there`.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// Where that lane lies.
    pub toward: Toward,
    /// The driver.
    pub me: Driver<'a>,
    /// Its lane.
    pub here: LaneView<'a>,
    /// The lane it would change to.
    pub there: LaneView<'a>,
    /// Length over which the lanes' speeds differ for this driver [m]: to the end of the section, at most
    /// as far as it sees.
    pub section: f64,
    /// Gain for which the driver leaves its route [s]; infinite: it always keeps its route.
    pub band: f64,
    /// What the law asks of the driver about lanes.
    pub lane_rule: LaneRule,
    /// Vehicles that signal a change into the driver's lane and for which it would give way.
    pub merging: [Option<Merging<'a>>; 2],
}

impl Situation<'_> {
    /// The lanes lead to the same place for this driver's route.
    pub fn is_symmetric(&self) -> bool {
        self.here.route.changes == 0 && self.there.route.changes == 0
    }

    /// The driver's route needs its lane: from the other lane it would have to come back.
    pub fn is_bound(&self) -> bool {
        self.there.route.changes > self.here.route.changes
    }
}

/// A driver with its vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driver<'a> {
    /// Its motion.
    pub pace: Pace,
    /// Its acceleration, as others see it [m/s²].
    pub acceleration: f64,
    /// How it follows.
    pub follow: &'a FollowingModel,
    /// Its comfortable braking, see [`crate::comfortable`] [m/s²]; 0: it brakes as its model has it.
    pub comfortable: f64,
    /// Vehicle length [m].
    pub length: f64,
}

impl Driver<'_> {
    /// The acceleration that it needs behind a new `leader` [m/s²]: what decides whether it can be expected to follow.
    ///
    /// A driver with comfortable braking comes to a slower leader by kinematics, whatever its model has; so its model
    /// says only whether the gap is long enough behind a leader as fast as itself (ours).
    pub fn demanded(&self, leader: Ahead) -> f64 {
        let behind = |it| self.follow.acceleration(self.pace, Some(it));
        let wish = behind(leader);
        if self.comfortable == 0.0 || self.pace.speed <= leader.speed {
            return wish;
        }
        let as_fast = behind(Ahead::steady(leader.gap, self.pace.speed));
        as_fast.min(comfortably(self.follow, self.comfortable, self.pace, leader, wish))
    }
}

/// One lane as the driver sees it from its place.
#[derive(Clone, Copy, Debug)]
pub struct LaneView<'a> {
    /// The leader, or the end of the lane.
    pub ahead: Option<Ahead>,
    /// The follower.
    pub behind: Option<Behind<'a>>,
    /// Mean spacing and speed around the driver.
    pub flow: Flow,
    /// Anticipated lane speed over all leaders in sight [m/s], see [`super::anticipated_speed`].
    pub anticipated_speed: f64,
    /// What the lane means for the driver's route.
    pub route: RouteView,
}

/// The vehicle behind in a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Behind<'a> {
    /// Net gap from its front bumper to the own rear bumper [m].
    pub gap: f64,
    /// Its driver.
    pub driver: Driver<'a>,
}

impl Behind<'_> {
    /// Accelerations of the vehicle behind with `me` in its lane and without, where the leader there is `ahead` of
    /// me.
    #[inline]
    pub(crate) fn leaders(&self, me: &Driver, ahead: Option<Ahead>) -> [Option<Ahead>; 2] {
        let with = Ahead { gap: self.gap, speed: me.pace.speed, acceleration: me.acceleration };
        let without = ahead.map(|ahead| Ahead { gap: self.gap + me.length + ahead.gap, ..ahead });
        [Some(with), without]
    }
}

/// What a lane means for a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RouteView {
    /// n: fewest lane changes from it to a lane that leads on.
    pub changes: u32,
    /// S: distance to the last place where the next of them is allowed [m]; infinite for n = 0.
    pub remaining: f64,
    /// Travel time beyond the section along the route [s].
    pub onward: f64,
    /// T_alt: travel time beyond the section along the best other way from where the lane leads, if there is one [s].
    pub alternative: Option<f64>,
}

/// A vehicle that wants into the driver's lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merging<'a> {
    /// Its driver.
    pub driver: Driver<'a>,
    /// What it follows as long as the driver stays.
    pub blocked: Option<Ahead>,
    /// What it would follow if the driver left.
    pub freed: Option<Ahead>,
    /// d: its urgency, 0…1.
    pub urgency: f64,
}
