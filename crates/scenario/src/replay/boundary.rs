//! The road beyond the view: where lanes come into view and leave it, and how fast vehicles left.
//!
//! A queue beyond the view slows those who come to its end. So a driver comes to the end of the view no faster than
//! vehicles were there at that time, and drives so for a while beyond it, so that whoever follows it sees it.
//!
//! Recordings lose vehicles and find them again under another number. A driver drives on when its record ends, so the
//! same vehicle would be there twice. Hence vehicles come where lanes come into view, and nowhere else.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_4;

use laneweave_network::{ChainIndex, Position};
use laneweave_recordings::Matched;
use laneweave_sim::{Lateral, RecordedPose, Vehicle, World};
use serde::{Deserialize, Serialize};

/// The view ends where nobody was recorded so far behind or ahead [m] (ours).
const EDGE: f64 = 40.0;
/// Behind and ahead, a road turns by up to about this angle [rad] (ours).
const BEND: f64 = 0.3;
/// What is recorded within so far of a place shows that the place is in view [m] (ours).
const CELL: f64 = 5.0;
/// Speeds count that were recorded so near to the end of the view [m] (ours).
const NEAR: f64 = 30.0;
/// Time for which they count [s], and the share of them that is not exceeded (ours).
const MINUTE: f64 = 60.0;
const SHARE: f64 = 0.85;
/// Drivers see the end of the view from so far [m], and slow down for what is there with this braking [m/s²] (ours).
const FAR: f64 = 300.0;
const SLOWING: f64 = 1.5;
/// A driver goes on so far beyond the view [m] (ours).
const BEYOND: f64 = 60.0;
/// A driver is taken off so long before it comes to the end of a lane beyond the view [s] (ours).
const BEFORE_END: f64 = 2.0;

/// Where the view begins and ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Boundary {
    view: View,
    /// Its end in each chain that has been driven on; none, if the lane or the road goes on in view.
    exits: BTreeMap<ChainIndex, Option<Exit>>,
}

/// The end of the view in a chain.
#[derive(Clone, Debug, PartialEq)]
struct Exit {
    /// The last place where the centre of a vehicle was recorded [m].
    x: f64,
    /// For each minute in which vehicles were there, the mean of the times [s], and the speed that 85 % of them did not
    /// exceed [m/s]: it does not slow traffic that is free.
    speeds: Vec<[f64; 2]>,
}

/// A driver near the end of the view, or beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Leaving {
    /// The chain in which it leaves the view.
    exit: ChainIndex,
    /// How far its centre is beyond the end of the view [m].
    beyond: f64,
    /// Whether it has been too fast for what is beyond.
    is_slowed: bool,
}

/// How a driver goes on near the end of the view, or beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GoesOn {
    /// As it likes, as before.
    Freely,
    /// As it likes: it has changed to a lane that goes on in view, and was slowed before.
    FreelyAgain,
    /// No faster than this [m/s], on lanes of its choice in view, and in its lane beyond.
    AtMost(f64, Lateral),
    /// Not in sight.
    OutOfSight,
}

impl Boundary {
    /// That of a recording.
    pub(super) fn of(matched: &Matched) -> Boundary {
        let (network, step) = (matched.network, matched.recording.step);
        let (mut seen, mut view): (BTreeMap<_, Vec<[f64; 3]>>, _) = (BTreeMap::new(), View::default());
        for (track, places) in matched.recording.tracks.iter().zip(&matched.places) {
            for (state, place) in track.states.iter().zip(places) {
                let Some(place) = place.filter(|_| track.class.is_vehicle()) else { continue };
                let Position { chain, x } = network.start_of(place.lanelet);
                let all = seen.entry(chain).or_default();
                all.push([x + place.station, state.frame as f64 * step, state.speed]);
                view.add([state.x, state.y], state.heading);
            }
        }
        let exit = |(chain, all): (&ChainIndex, &Vec<[f64; 3]>)| {
            let lane = network.chain(*chain);
            let exit = Exit::of(all);
            let (at, heading) = (lane.centre.at(exit.x), lane.centre.heading(exit.x));
            let goes_on = lane.following.iter().any(|it| seen.contains_key(it));
            (*chain, Some(exit).filter(|_| !goes_on && !view.holds([at.x, at.y], heading, EDGE)))
        };
        Boundary { exits: seen.iter().map(exit).collect(), view }
    }

    /// The same for a simulation that begins `from_s` [s] after the first frame.
    pub(super) fn beginning_at(mut self, from_s: f64) -> Boundary {
        let speeds = self.exits.values_mut().flatten().flat_map(|it| &mut it.speeds);
        speeds.for_each(|[time, _]| *time -= from_s);
        self
    }

    /// Whether a vehicle that is first seen at this place comes into view there.
    pub(super) fn is_entry(&self, pose: RecordedPose) -> bool {
        !self.view.holds([pose.x, pose.y], pose.heading, -EDGE)
    }

    /// How a driver goes on that was `leaving` the view in the last step, if it was. Notes where it is now.
    pub(super) fn goes_on(&self, leaving: &mut Option<Leaving>, vehicle: &Vehicle, world: &World) -> GoesOn {
        let was_slowed = leaving.is_some_and(|it| it.is_slowed);
        *leaving = self.leaving(*leaving, vehicle, world);
        let Some(leaving) = leaving else {
            return if was_slowed { GoesOn::FreelyAgain } else { GoesOn::Freely };
        };
        let Some(exit) = self.exits.get(&leaving.exit).and_then(Option::as_ref) else {
            return GoesOn::OutOfSight;
        };
        let (speed, recorded) = (vehicle.speed(), exit.speed(world.clock().time()));
        if leaving.beyond > 0.0 {
            let chain = world.network().chain(vehicle.spot.chain);
            let ends = chain.following.is_empty() && chain.length - vehicle.x() < speed * BEFORE_END;
            let is_there = !ends && leaving.beyond < BEYOND;
            return if is_there { GoesOn::AtMost(recorded, Lateral::Keep) } else { GoesOn::OutOfSight };
        }
        let most = (recorded * recorded - 2.0 * SLOWING * leaving.beyond).sqrt();
        leaving.is_slowed |= speed > most;
        if leaving.is_slowed { GoesOn::AtMost(most, Lateral::Driver) } else { GoesOn::Freely }
    }

    /// Where a driver that was `before` in the last step leaves the view, if it is near its end or beyond it.
    fn leaving(&self, before: Option<Leaving>, vehicle: &Vehicle, world: &World) -> Option<Leaving> {
        if let Some(before) = before.filter(|it| it.beyond > 0.0) {
            let beyond = before.beyond + vehicle.speed() * world.clock().dt;
            return Some(Leaving { beyond, ..before });
        }
        let [length, _] = vehicle.size();
        let (exit, centre) = (vehicle.spot.chain, vehicle.x() - 0.5 * length);
        if centre < 0.0 && !world.network().chain(exit).previous.is_empty() {
            return None;
        }
        let beyond = match self.exits.get(&exit) {
            Some(it) => centre - it.as_ref()?.x,
            // Nobody was ever recorded there.
            None => BEYOND,
        };
        let is_slowed = before.is_some_and(|it| it.is_slowed);
        (is_slowed || beyond > -FAR).then_some(Leaving { exit, beyond, is_slowed })
    }
}

/// Where vehicles were recorded, and in which directions.
#[derive(Clone, Debug, Default, PartialEq)]
struct View(BTreeMap<[i32; 2], u8>);

impl View {
    fn add(&mut self, at: [f64; 2], heading: f64) {
        *self.0.entry(View::cell(at)).or_default() |= 1 << View::octant(heading);
    }

    /// Whether somebody was recorded about so far [m] ahead, in about this direction.
    fn holds(&self, [x, y]: [f64; 2], heading: f64, ahead: f64) -> bool {
        let octant = View::octant(heading);
        let similar = [octant + 7, octant, octant + 1].iter().fold(0_u8, |all, it| all | 1 << (it % 8));
        let is_seen = |cell: [i32; 2]| self.0.get(&cell).is_some_and(|it| it & similar != 0);
        // Roads bend, and headings have errors.
        [-BEND, 0.0, BEND].iter().any(|turned| {
            let (sin, cos) = libm::sincos(heading + turned);
            let [x, y] = View::cell([x + ahead * cos, y + ahead * sin]);
            (-1..=1).any(|dx| (-1..=1).any(|dy| is_seen([x + dx, y + dy])))
        })
    }

    fn cell(at: [f64; 2]) -> [i32; 2] {
        at.map(|it| (it / CELL).floor() as i32)
    }

    /// An eighth of the circle, from 0 to 7.
    fn octant(heading: f64) -> u32 {
        (heading / FRAC_PI_4).floor().rem_euclid(8.0) as u32 % 8
    }
}

impl Exit {
    /// That of the places [m], times [s] and speeds [m/s] that were recorded in a chain.
    fn of(recorded: &[[f64; 3]]) -> Exit {
        let x = recorded.iter().map(|it| it[0]).fold(f64::NEG_INFINITY, f64::max);
        let mut minutes: BTreeMap<i64, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
        for [_, time, speed] in recorded.iter().filter(|it| it[0] > x - NEAR) {
            let (times, speeds) = minutes.entry((time / MINUTE).floor() as i64).or_default();
            times.push(*time);
            speeds.push(*speed);
        }
        let speeds = minutes.into_values().map(|(times, mut speeds)| {
            let time = times.iter().sum::<f64>() / times.len() as f64;
            speeds.sort_by(f64::total_cmp);
            [time, speeds[(SHARE * (speeds.len() - 1) as f64).round() as usize]]
        });
        Exit { x, speeds: speeds.collect() }
    }

    /// The recorded speed at a time [s]: between the minutes in a straight line [m/s].
    fn speed(&self, time: f64) -> f64 {
        let next = self.speeds.partition_point(|it| it[0] <= time);
        let [from, slow] = self.speeds[next.saturating_sub(1)];
        match self.speeds.get(next) {
            Some([to, fast]) if next > 0 => slow + (fast - slow) * (time - from) / (to - from),
            _ => slow,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_view_ends_where_nobody_was_recorded_in_the_same_direction() {
        let mut view = View::default();
        (0..100).for_each(|x| view.add([f64::from(x), 0.0], 0.0));
        assert!(!view.holds([10.0, 0.0], 0.01, -EDGE) && view.holds([60.0, 3.0], -0.01, -EDGE));
        assert!(view.holds([40.0, 0.0], 0.0, EDGE) && !view.holds([70.0, 0.0], 0.0, EDGE));
        assert!(!view.holds([60.0, 0.0], 3.0, EDGE), "the road is not driven on in this direction");
    }

    #[test]
    fn the_end_of_the_view_is_the_furthest_place_and_its_speed_is_that_of_the_minute() {
        // Somebody fast is far from the end, somebody slow leaves in the first minute, and faster ones in the second.
        let exit =
            Exit::of(&[[50.0, 20.0, 30.0], [380.0, 30.0, 5.0], [400.0, 80.0, 15.0], [390.0, 100.0, 25.0]]);
        assert_eq!(exit.x, 400.0);
        assert_eq!(exit.speeds, [[30.0, 5.0], [90.0, 25.0]]);
        let speeds = [0.0, 30.0, 60.0, 90.0, 200.0].map(|it| exit.speed(it));
        assert_eq!(speeds, [5.0, 5.0, 15.0, 25.0, 25.0]);
    }
}
