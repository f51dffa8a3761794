//! Desire counts by situation: how often the desire comes to drivers held up beside a free lane, and to drivers on a
//! free road. This separates drivers from the null-model control.

/// The situation of a driver whose desires are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DesireSituation {
    /// On a free road.
    Free,
    /// Held up beside a free lane.
    HeldUp,
}

/// Shares of the desired speed. From `FREE` on, a lane is free. Up to `HELD_UP`, a driver is held up.
const FREE: f64 = 0.95;
const HELD_UP: f64 = 0.9;

impl DesireSituation {
    /// The situation of a driver who desires the speed `desired` [m/s]. It anticipates the speed `here` in its lane,
    /// and `best_there` in the better lane beside that leads to the same place, if there is one.
    pub(crate) fn of(desired: f64, here: f64, best_there: Option<f64>) -> Option<DesireSituation> {
        let best_there = best_there?;
        if here >= FREE * desired {
            Some(DesireSituation::Free)
        } else {
            (here <= HELD_UP * desired && best_there >= FREE * desired).then_some(DesireSituation::HeldUp)
        }
    }
}
