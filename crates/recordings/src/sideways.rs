//! The begin and end of a lane change: the quintic that fits the lateral motion best.
//!
//! y(t) = A + (B − A) (10 τ³ − 15 τ⁴ + 6 τ⁵), τ = (t − t₀)/(t₁ − t₀), least squares over t₀, t₁, A and B.
//!
//! It begins and ends without lateral speed and acceleration, so no single position shows the times. All positions
//! together show them, to less than a tenth of a second under 10 cm of noise. For a slow vehicle the distance counts,
//! not the time: below the speed at which the usual change takes its minimum distance, t runs slower.

use laneweave_models::lateral::{Crossing, moved_share};
use laneweave_network::{LaneletIndex, Point};

use crate::changes::LaneChange;
use crate::lanes;
use crate::matching::{Matched, Place};
use crate::smooth;

/// The times between which a vehicle moves from one lane to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// When it begins [s].
    pub began: f64,
    /// When it ends [s].
    pub ended: f64,
}

impl Extent {
    /// Share of its time that has passed at `time` [s]; `None` before and after.
    pub fn progress(&self, time: f64) -> Option<f64> {
        let share = (time - self.began) / (self.ended - self.began);
        (0.0..=1.0).contains(&share).then_some(share)
    }
}

/// A change is analysed over this time before and after the crossing [s]. Ours: most take 3 to 10 s.
const REACH: f64 = 10.0;
/// Minimum duration of a change [s].
const SHORTEST: f64 = 1.0;
/// Usual duration of a change [s], as in the simulation.
const USUAL: f64 = 4.0;
/// Weight, in states, of the assumption that drivers keep near the middle of their lanes: the error of positions is
/// 0.1 m, that of drivers 0.3 m.
const KEEPING: f64 = 0.1;
/// Speeds are smoothed over this time before and after [s].
const SPEED_REACH: f64 = 0.25;
/// First and last step of the search [s].
const STEPS: (f64, f64) = (1.0, 0.005);

/// The begin and end of each of `changes`, which are all those of their tracks in order of time.
pub fn extents(matched: &Matched<'_>, changes: &[LaneChange]) -> Vec<Extent> {
    let halfway = |one: &LaneChange, other: Option<&LaneChange>| {
        other.filter(|it| it.track == one.track).map(|it| 0.5 * (one.time + it.time))
    };
    (0..changes.len())
        .map(|at| {
            let change = &changes[at];
            let before = halfway(change, at.checked_sub(1).and_then(|it| changes.get(it)));
            let after = halfway(change, changes.get(at + 1));
            let from = before.unwrap_or(f64::NEG_INFINITY).max(change.time - REACH);
            let until = after.unwrap_or(f64::INFINITY).min(change.time + REACH);
            Way::of(matched, change, from, until).extent()
        })
        .collect()
}

/// Number of the last state that is matched to the old lane of `change`; it may be a little before or after the
/// crossing.
pub fn last_before(matched: &Matched<'_>, change: &LaneChange) -> Option<usize> {
    let (states, places) = (&matched.recording.tracks[change.track].states, &matched.places[change.track]);
    let is_in = |place: &Option<Place>, lanelet| place.is_some_and(|it| it.lanelet == lanelet);
    let pairs = places.windows(2).enumerate();
    let goes_over = pairs.filter(|(_, pair)| is_in(&pair[0], change.from) && is_in(&pair[1], change.to));
    let off = |at: usize| (states[at].frame as f64 * matched.recording.step - change.time).abs();
    goes_over.map(|(at, _)| at).min_by(|a, b| off(*a).total_cmp(&off(*b)))
}

/// The observed lateral motion.
struct Way {
    /// Time of the crossing [s].
    crossing: f64,
    /// In order of time.
    seen: Vec<Sight>,
    /// Distance between the middles of the lanes [m].
    width: f64,
}

/// The lateral position of a vehicle.
struct Sight {
    /// Time [s].
    time: f64,
    /// Scaled time since the crossing: that of a fast vehicle [s].
    paced: f64,
    /// Distance from the middle of the old lane towards the new one [m].
    aside: f64,
}

impl Way {
    /// The observations of `change` between two times [s].
    fn of(matched: &Matched<'_>, change: &LaneChange, from: f64, until: f64) -> Way {
        let (track, places) = (&matched.recording.tracks[change.track], &matched.places[change.track]);
        let step = matched.recording.step;
        let towards = change.side.sign();
        let width = width(matched, change);
        let last = last_before(matched, change);
        let mut seen: Vec<Sight> = Vec::new();
        for (at, (state, place)) in track.states.iter().zip(places).enumerate() {
            let time = state.frame as f64 * step;
            let Some(place) = place.filter(|_| (from..=until).contains(&time)) else { continue };
            let speed = smooth::speed(&track.states, at, SPEED_REACH, step);
            let pace = Crossing { speed, length: track.length, duration: USUAL }.pace();
            let paced = seen.last().map_or(0.0, |it| it.paced + pace * (time - it.time));
            let crossed = if Some(at) <= last { 0.0 } else { width };
            seen.push(Sight { time, paced, aside: crossed + towards * place.offset });
        }
        let mut way = Way { crossing: change.time, seen, width };
        let at_crossing = way.paced(change.time);
        way.seen.iter_mut().for_each(|it| it.paced -= at_crossing);
        way
    }

    /// Scaled time at a time [s].
    fn paced(&self, time: f64) -> f64 {
        let after = self.seen.partition_point(|it| it.time < time);
        match (after.checked_sub(1).and_then(|it| self.seen.get(it)), self.seen.get(after)) {
            (Some(one), Some(other)) => {
                let share = (time - one.time) / (other.time - one.time);
                one.paced + share * (other.paced - one.paced)
            }
            (Some(it), None) | (None, Some(it)) => it.paced + (time - it.time),
            (None, None) => time - self.crossing,
        }
    }

    /// Time [s] at a scaled time.
    fn time(&self, paced: f64) -> f64 {
        let after = self.seen.partition_point(|it| it.paced < paced);
        match (after.checked_sub(1).and_then(|it| self.seen.get(it)), self.seen.get(after)) {
            (Some(one), Some(other)) => {
                let share = (paced - one.paced) / (other.paced - one.paced);
                one.time + share * (other.time - one.time)
            }
            (Some(it), None) | (None, Some(it)) => it.time + (paced - it.paced),
            (None, None) => self.crossing + paced,
        }
    }

    /// The begin and end with the best fit.
    fn extent(&self) -> Extent {
        let mut best = [-0.5 * USUAL, 0.5 * USUAL];
        let mut least = self.misfit(best);
        let mut step = STEPS.0;
        while step > STEPS.1 {
            let moves = [(-step, 0.0), (step, 0.0), (0.0, -step), (0.0, step), (-step, step), (step, -step)];
            let tried = moves.map(|(began, ended)| [best[0] + began, best[1] + ended]);
            let possible = tried
                .iter()
                .filter(|[began, ended]| *began >= -REACH && *ended <= REACH && ended - began >= SHORTEST);
            let nearest = possible.map(|it| (self.misfit(*it), it)).min_by(|a, b| a.0.total_cmp(&b.0));
            match nearest {
                Some((misfit, extent)) if misfit < least => (least, best) = (misfit, *extent),
                _ => step *= 0.5,
            }
        }
        Extent { began: self.time(best[0]), ended: self.time(best[1]) }
    }

    /// Sum of the squared distances [m²] from the best path between two scaled times.
    fn misfit(&self, [began, ended]: [f64; 2]) -> f64 {
        // Normal equations of A and B, whose expected values are 0 and the lanes' distance.
        let (mut aa, mut ab, mut bb) = (KEEPING, 0.0, KEEPING);
        let (mut ay, mut by, mut yy) = (0.0, KEEPING * self.width, KEEPING * self.width * self.width);
        for Sight { paced, aside: y, .. } in &self.seen {
            let share = moved_share((paced - began) / (ended - began));
            let rest = 1.0 - share;
            aa += rest * rest;
            ab += rest * share;
            bb += share * share;
            ay += rest * y;
            by += share * y;
            yy += y * y;
        }
        let determinant = aa * bb - ab * ab;
        let (a, b) = ((ay * bb - by * ab) / determinant, (by * aa - ay * ab) / determinant);
        yy - a * ay - b * by
    }
}

/// Distance between the middles of the two lanes at the crossing [m].
fn width(matched: &Matched<'_>, change: &LaneChange) -> f64 {
    let lanelets = &matched.network.lanelets;
    let crossing = Point::new(change.x, change.y, 0.0);
    let offset = |lanelet: LaneletIndex| lanes::foot(&lanelets[lanelet.at()], &crossing).map(|it| it.offset);
    match (offset(change.from), offset(change.to)) {
        (Some(from), Some(to)) => change.side.sign() * (from - to),
        _ => lanelets[change.from.at()].width(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaled_time_runs_evenly_from_sight_to_sight_and_like_time_before_and_after() {
        let sight = |time, paced| Sight { time, paced, aside: 0.0 };
        // Half as fast in the second second.
        let seen = vec![sight(0.0, 0.0), sight(1.0, 1.0), sight(2.0, 1.5)];
        let way = Way { crossing: 0.0, seen, width: 3.5 };
        for (time, paced) in [(-0.5, -0.5), (0.25, 0.25), (1.0, 1.0), (1.5, 1.25), (2.0, 1.5), (3.0, 2.5)] {
            assert_eq!((way.paced(time), way.time(paced)), (paced, time));
        }
    }
}
