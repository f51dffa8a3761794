//! Forks behind forks: the branches of the first have not parted where the next one begins, and vehicles stand there.

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::Mouth;
use super::stretch::Pen;

/// Length of the road before the first fork [m].
const BEFORE: [f64; 2] = [40.0, 90.0];
/// Length that two branches share between one fork and the next [m].
const SHARED: [f64; 2] = [2.0, 8.0];
/// Length from the last fork to the stop line [m].
const TO_LINE: [f64; 2] = [4.0, 14.0];
/// Angle of the branches that leave [rad], and the length over which they begin to turn [m].
const STEEP: [f64; 2] = [0.9, 1.5];
const FLAT: [f64; 2] = [0.3, 0.9];
const TURNS_WITHIN: [f64; 2] = [7.0, 20.0];
/// Lengths of lanes between the forks of a row [m], the number of forks.
const LANES: [f64; 2] = [2.0, 11.0];
const FORKS: [usize; 2] = [2, 4];

/// A branch leaves, and another one a few metres behind; behind both is a light.
pub(super) fn nested_fork(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    row(pen, mouth, &[SHARED], Hazard::NestedFork)
}

/// Branches leave one behind the other, with lanes in between that are shorter than a long vehicle; behind is a light.
pub(super) fn row_of_forks(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let between = vec![LANES; pen.dice.count(FORKS[0], FORKS[1])];
    row(pen, mouth, &between, Hazard::ForkRow)
}

fn row(pen: &mut Pen, mouth: &Mouth, between: &[[f64; 2]], hazard: Hazard) -> Option<Built> {
    if mouth.is_two_way() || !mouth.is_ahead() {
        return None;
    }
    let mut road = pen.straight(&mouth.clone().at_most(50.0), BEFORE);
    let side = pen.dice.sign();
    let leg = pen.dice.between(TURNS_WITHIN[0], TURNS_WITHIN[1]);
    let mut off = vec![pen.turning_off(&road, side, STEEP, leg)];
    for length in between {
        road = pen.straight(&road, *length);
        let side = if off.len() == 1 { -side } else { pen.dice.sign() };
        let leg = pen.dice.between(TURNS_WITHIN[0], TURNS_WITHIN[1]);
        off.push(pen.turning_off(&road, side, FLAT, leg));
    }
    let line = pen.straight(&road, TO_LINE);
    let [beyond, _] = pen.light_behind(&line);
    Some(Built { mouths: [vec![beyond], off].concat(), hazard: Some(hazard) })
}
