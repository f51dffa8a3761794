//! A driver's choice of a side.

use laneweave_models::change::{Appraisal, LaneChangeModel, Situation};
use laneweave_network::Side;

use crate::driver::perceive::{Dismissed, Perception};
use crate::driver::plan::Want;
use crate::record::counters::Counters;
use crate::record::desire_situations::DesireSituation;
use crate::state::lane::{DriverState, LaneChangeKind};
use crate::state::moment::Moment;

/// A side, and the driver's appraisal of it.
pub(crate) struct Choice {
    pub(crate) side: Side,
    pub(crate) appraisal: Appraisal,
    /// Only the wish for the slow side makes it wanted.
    pub(crate) is_for_the_slow_side: bool,
    pub(crate) is_symmetric: bool,
    /// Fewer lane changes are left to make there.
    pub(crate) helps_the_route: bool,
    /// How much the driver is pressed to this side, 0…1.
    pub(crate) pressure: f64,
    /// Anticipated speed there [m/s].
    pub(crate) anticipated_speed: f64,
}

impl Choice {
    /// The driver's appraisals of both sides, the side for overtaking first.
    pub(crate) fn both(
        perception: &Perception,
        moment: Moment,
        change: &LaneChangeModel,
    ) -> [Option<Choice>; 2] {
        let of = |side| Choice::of(perception, moment, change, side);
        [of(moment.overtaking), of(moment.overtaking.opposite())]
    }

    /// The driver's appraisal of `side`, if it may change there. In the cooldown a side counts only if it helps the
    /// route.
    fn of(perception: &Perception, moment: Moment, change: &LaneChangeModel, side: Side) -> Option<Choice> {
        let from = perception.beside(side)?;
        if is_in_cooldown(perception.driver(), moment) && perception.here().route.changes == 0 {
            return None;
        }
        let situation = perception.situation(side, from);
        (!is_out_of_question(perception.driver(), moment, &situation))
            .then(|| Choice::appraised(change, side, &situation))
    }

    /// The driver's appraisal of `side`, whatever speaks against it, if it may change there.
    pub(crate) fn whatever(perception: &Perception, change: &LaneChangeModel, side: Side) -> Option<Choice> {
        let situation = perception.situation(side, perception.beside(side)?);
        Some(Choice::appraised(change, side, &situation))
    }

    fn appraised(change: &LaneChangeModel, side: Side, situation: &Situation) -> Choice {
        let appraisal = change.appraise(situation);
        Choice {
            side,
            appraisal,
            is_for_the_slow_side: change.is_for_the_slow_side(situation, &appraisal),
            is_symmetric: situation.is_symmetric(),
            helps_the_route: situation.there.route.changes < situation.here.route.changes,
            pressure: change.pressure(situation, &appraisal),
            anticipated_speed: situation.there.anticipated_speed,
        }
    }

    pub(crate) fn want(&self, prospect_here: f64) -> Want {
        Want {
            side: self.side,
            kind: match self.is_symmetric {
                true if self.is_for_the_slow_side => LaneChangeKind::Keeping,
                true => LaneChangeKind::Discretionary,
                false => LaneChangeKind::Route,
            },
            appraisal: self.appraisal,
            speed_gain: (self.anticipated_speed - prospect_here) as f32,
        }
    }
}

/// Whether the driver is in the cooldown, in which it makes no other discretionary change.
fn is_in_cooldown(driver: &DriverState, moment: Moment) -> bool {
    moment.clock.step < driver.cooldown_until
}

/// Whether the driver does not consider a side, because it is in the cooldown and the side does not help its route.
pub(crate) fn is_out_of_question(driver: &DriverState, moment: Moment, situation: &Situation) -> bool {
    is_in_cooldown(driver, moment) && situation.there.route.changes >= situation.here.route.changes
}

/// The side to which a driver who keeps its lane desires to change. `None` if the desire does not arise within
/// `epochs` epochs with the random number `draw`.
#[inline]
pub(crate) fn desire(
    perception: &Perception,
    moment: Moment,
    change: &LaneChangeModel,
    epochs: f64,
    draw: f64,
    counters: &mut Counters,
) -> Option<Choice> {
    let (desired, here) = (f64::from(perception.driver().desired), perception.here().anticipated_speed);
    if let LaneChangeModel::Mcdm(model) = change
        && moment.clock.step >= perception.driver().cooldown_until
        && let Some(Dismissed { best_anticipated_speed }) =
            perception.dismisses(model, change.reach(epochs, draw))
    {
        // It takes a full look to see whether the lane beside is free: the bound knows only its next leader, far
        // ahead.
        let situation = DesireSituation::of(desired, here, best_anticipated_speed);
        if situation != Some(DesireSituation::HeldUp) {
            counters.count_desire(situation, false);
            return None;
        }
    }
    let options = Choice::both(perception, moment, change);
    let symmetric = options.iter().flatten().filter(|it| it.is_symmetric);
    let situation =
        DesireSituation::of(desired, here, symmetric.map(|it| it.anticipated_speed).reduce(f64::max));
    let drawn =
        change.drawn([&options[0], &options[1]].map(|it| it.as_ref().map(|it| &it.appraisal)), epochs, draw);
    counters.count_desire(situation, drawn.is_some());
    drawn.and_then(|it| options.into_iter().nth(it)).flatten()
}
