//! Cut-ins: lane changes before a follower who is near.
//!
//! All is as it was in the first frame in the new lane: the vehicle behind there, the gap between its front and the
//! rear of the vehicle that changed, and both speeds.

use std::collections::BTreeMap;

use laneweave_network::LaneletIndex;

use crate::changes::LaneChange;
use crate::matching::{Matched, Present};
use crate::sideways::last_before;
use crate::smooth;

/// A change is a cut-in if the follower reaches the place of the rear within this time at its speed [s] (ours).
const NEAR: f64 = 4.0;
/// A slower follower has no headway [m/s].
const MOVES: f64 = 1.0;
/// A follower is searched so far behind [m].
const SEARCH: f64 = 150.0;
/// Speeds are smoothed over this time before and after [s].
const REACH: f64 = 0.5;

/// A lane change before a follower who is near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutIn {
    /// Id of the track that changed lanes.
    pub vehicle: i64,
    /// Id of the track behind it.
    pub follower: i64,
    /// When the centre crossed the line [s].
    pub time: f64,
    /// Net gap between the two [m]; above 0.
    pub gap: f64,
    /// Speed of the follower [m/s].
    pub follower_speed: f64,
    /// Speed of the vehicle that changed lanes [m/s].
    pub speed: f64,
}

impl CutIn {
    /// Time in which the follower drives the gap at its speed [s].
    pub fn headway(&self) -> f64 {
        self.gap / self.follower_speed
    }

    /// Inverse of the time to collision [1/s]; 0 where the gap does not close.
    pub fn inverse_time_to_collision(&self) -> f64 {
        (self.follower_speed - self.speed).max(0.0) / self.gap
    }

    /// Braking with which the follower comes to the speed of the other just before it reaches it [m/s²]: the
    /// deceleration rate to avoid a crash (DRAC); 0 where the gap does not close.
    pub fn needed_braking(&self) -> f64 {
        let closing = (self.follower_speed - self.speed).max(0.0);
        0.5 * closing * closing / self.gap
    }
}

/// After a cut-in its follower is watched for this time [s], and its braking is the mean over this one [s] (ours).
const WATCHED: f64 = 4.0;
const OVER: f64 = 1.0;

impl CutIn {
    /// The hardest braking of the follower within 4 s after the cut-in, over 1 s [m/s²]; 0 if it does not brake. `None`
    /// if the follower is not seen for so long.
    pub fn braking(&self, matched: &Matched<'_>) -> Option<f64> {
        let step = matched.recording.step;
        let track = matched.recording.tracks.iter().find(|it| it.id == self.follower)?;
        let frame = |time: f64| ((self.time + time) / step).round() as i64;
        let speed =
            |frame: i64| track.at(frame).map(|at| smooth::speed(&track.states, at, 0.5 * REACH, step));
        let over = (OVER / step).round().max(1.0) as i64;
        let mut hardest = 0.0_f64;
        for begin in frame(0.0)..=frame(WATCHED) - over {
            hardest = hardest.max((speed(begin)? - speed(begin + over)?) / (over as f64 * step));
        }
        Some(hardest)
    }
}

/// The cut-ins among the lane `changes` of a recording, in their order. Vehicles whose recorded bodies overlap have no
/// gap, and are left out.
pub fn cut_ins(matched: &Matched<'_>, changes: &[LaneChange]) -> Vec<CutIn> {
    let previous = previous(matched);
    changes.iter().filter_map(|it| cut_in(matched, &previous, it)).collect()
}

/// The lanelets that lead into each.
fn previous(matched: &Matched<'_>) -> Vec<Vec<LaneletIndex>> {
    let lanelets = &matched.network.lanelets;
    let mut previous = vec![Vec::new(); lanelets.len()];
    for (index, lanelet) in lanelets.iter().enumerate() {
        lanelet.following.iter().for_each(|it| previous[it.at()].push(LaneletIndex(index as u32)));
    }
    previous
}

fn cut_in(matched: &Matched<'_>, previous: &[Vec<LaneletIndex>], change: &LaneChange) -> Option<CutIn> {
    let frame = matched.recording.tracks[change.track].states[last_before(matched, change)? + 1].frame;
    let present = matched.frame(frame);
    let me = present.iter().find(|it| it.track.id == change.vehicle && it.place.lanelet == change.to)?;
    let (distance, behind) = follower(matched, previous, &present, me)?;
    let gap = distance - 0.5 * (me.track.length + behind.track.length);
    let [speed, follower_speed] = [me, behind].map(|it| {
        let at = it.track.at(frame).unwrap_or_default();
        smooth::speed(&it.track.states, at, REACH, matched.recording.step)
    });
    let found = CutIn {
        vehicle: change.vehicle,
        follower: behind.track.id,
        time: change.time,
        gap,
        follower_speed,
        speed,
    };
    (gap > 0.0 && follower_speed >= MOVES && found.headway() <= NEAR).then_some(found)
}

/// The nearest vehicle behind `me` on the lanes that lead to its place, and the distance between their centres [m].
fn follower<'p, 'a>(
    matched: &Matched<'_>,
    previous: &[Vec<LaneletIndex>],
    present: &'p [Present<'a>],
    me: &Present<'_>,
) -> Option<(f64, &'p Present<'a>)> {
    let last_on = |lanelet: LaneletIndex, before: f64| {
        let end = present.partition_point(|it| {
            (it.place.lanelet, it.place.station).partial_cmp(&(lanelet, before)).is_some_and(|it| it.is_lt())
        });
        present[..end].last().filter(|it| it.place.lanelet == lanelet)
    };
    if let Some(it) = last_on(me.place.lanelet, me.place.station) {
        return Some((me.place.station - it.place.station, it));
    }
    // Distance from the end of each lanelet upstream to `me`.
    let mut upstream = BTreeMap::from([(me.place.lanelet, me.place.station)]);
    let mut next = vec![me.place.lanelet];
    let mut nearest: Option<(f64, &Present<'_>)> = None;
    while let Some(lanelet) = next.pop() {
        let way = upstream[&lanelet];
        for &before in &previous[lanelet.at()] {
            let length = matched.network.lanelets[before.at()].centre.length();
            match last_on(before, f64::INFINITY) {
                Some(it) => {
                    let distance = way + length - it.place.station;
                    if nearest.is_none_or(|(least, _)| distance < least) {
                        nearest = Some((distance, it));
                    }
                }
                None if way + length < SEARCH && !upstream.contains_key(&before) => {
                    upstream.insert(before, way + length);
                    next.push(before);
                }
                None => {}
            }
        }
    }
    nearest.filter(|(distance, _)| *distance <= SEARCH)
}
