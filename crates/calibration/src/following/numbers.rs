//! The numbers of a car-following model that are fitted.

use laneweave_models::Parameter;
use laneweave_models::follow::FollowingModel;

/// The numbers that are fitted: T, s₀, a and b.
pub(super) const NUMBERS: [Parameter; 4] =
    [Parameter::TimeGap, Parameter::JamGap, Parameter::Acceleration, Parameter::Deceleration];
/// The place of s₀ among them.
pub(super) const JAM_GAP: usize = 1;

/// Those of `model`; `None` if it is one that cannot be fitted.
pub(super) fn numbers(model: &FollowingModel) -> Option<[f64; 4]> {
    match model {
        FollowingModel::IdmPlus(it) => Some([it.time_gap, it.jam_gap, it.acceleration, it.deceleration]),
        FollowingModel::Idm(it) => Some([it.time_gap, it.jam_gap, it.acceleration, it.deceleration]),
        _ => None,
    }
}

/// `model` with other numbers; as it is if it is one that cannot be fitted.
pub(super) fn with_numbers(mut model: FollowingModel, numbers: [f64; 4]) -> FollowingModel {
    let places = match &mut model {
        FollowingModel::IdmPlus(it) => {
            [&mut it.time_gap, &mut it.jam_gap, &mut it.acceleration, &mut it.deceleration]
        }
        FollowingModel::Idm(it) => {
            [&mut it.time_gap, &mut it.jam_gap, &mut it.acceleration, &mut it.deceleration]
        }
        _ => return model,
    };
    places.into_iter().zip(numbers).for_each(|(place, it)| *place = it);
    model
}
