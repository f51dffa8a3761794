//! Recorded drivers: what their path shows of them, and what has to be assumed.

use std::collections::HashMap;

use laneweave_network::{ChainIndex, Position, RoadLaw, Side};
use laneweave_recordings::{Extent, LaneChange, Matched, extents, last_before};
use laneweave_sim::{Class, Destination, Navigator};

use crate::class::class_of;

/// Assumptions about a recorded driver that no recording shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumed {
    /// Its index in the table of driver parameters.
    pub parameters: u32,
    /// Its desired speed as a share of the speed that the limit and its class allow; for a simulated driver this
    /// share comes from its style.
    pub speed_factor: f64,
}

/// Minimum speed factor of a driver, also of one that only stands.
const LEAST_FACTOR: f64 = 0.1;

impl Assumed {
    /// A driver with these parameters and an estimated speed factor: the one below which it stayed for 85 % of the
    /// time that it was observed, at least 0.1 and at most 1. For a driver that was held up all the time, the
    /// estimate is too low.
    pub fn by_its_speeds(matched: &Matched<'_>, track: usize, parameters: u32) -> Assumed {
        let (track, places) = (&matched.recording.tracks[track], &matched.places[track]);
        let class = class_of(track.class);
        let mut factors: Vec<f64> = track
            .states
            .iter()
            .zip(places)
            .filter_map(|(state, place)| {
                let limit = matched.network.lanelets[place.as_ref()?.lanelet.at()].speed_limit;
                Some(state.speed / class.allowed(limit, &matched.network.law)).filter(|it| it.is_finite())
            })
            .collect();
        factors.sort_by(f64::total_cmp);
        let usual = factors.get(factors.len() * 85 / 100).copied().unwrap_or(1.0);
        Assumed { parameters, speed_factor: usual.clamp(LEAST_FACTOR, 1.0) }
    }
}

/// A track's driver.
pub(crate) struct Driver {
    pub(crate) assumed: Assumed,
    pub(crate) class: Class,
    pub(crate) destination: Destination,
    /// The chains of its route in order, each with the number of the first state there.
    pub(crate) chains: Vec<(usize, ChainIndex)>,
    /// Its lane changes.
    pub(crate) changes: Vec<Change>,
}

/// A lane change of a driver.
pub(crate) struct Change {
    pub(crate) side: Side,
    pub(crate) extent: Extent,
    /// Number of the last state that is matched to the old lane.
    pub(crate) last_before: Option<usize>,
}

impl Driver {
    /// Its desired speed under this `law` where the limit of the road is `limit` [m/s].
    pub(crate) fn desired(&self, limit: f64, law: &RoadLaw) -> f64 {
        self.class.allowed(limit, law) * self.assumed.speed_factor
    }

    /// The chain of `following` on which it continues after state number `at`. Where branches still overlap, the
    /// match may begin with another one: the last counts.
    pub(crate) fn next(&self, at: usize, following: &[ChainIndex]) -> Option<ChainIndex> {
        let later = self.chains.iter().filter(|(first, _)| *first > at).map(|(_, chain)| *chain);
        let is_following = |it: &ChainIndex| following.contains(it);
        later.skip_while(|it| !is_following(it)).take_while(is_following).last()
    }
}

/// The drivers of all tracks.
pub(crate) fn drivers(
    matched: &Matched<'_>,
    changes: &[LaneChange],
    navigator: &Navigator,
    assume: impl Fn(usize) -> Assumed,
) -> Vec<Driver> {
    let goals = goals(matched, navigator);
    let mut drivers: Vec<Driver> = Vec::with_capacity(matched.places.len());
    for (index, (track, places)) in matched.recording.tracks.iter().zip(&matched.places).enumerate() {
        let mut chains: Vec<(usize, ChainIndex)> = Vec::new();
        for (at, place) in places.iter().enumerate() {
            let chain = place.map(|it| matched.network.start_of(it.lanelet).chain);
            chains.extend(
                chain.filter(|it| chains.last().is_none_or(|(_, last)| last != it)).map(|it| (at, it)),
            );
        }
        drivers.push(Driver {
            assumed: assume(index),
            class: class_of(track.class),
            destination: goals.get(&track.id).copied().flatten(),
            chains,
            changes: Vec::new(),
        });
    }
    for (change, extent) in changes.iter().zip(extents(matched, changes)) {
        let last_before = last_before(matched, change);
        drivers[change.track].changes.push(Change { side: change.side, extent, last_before });
    }
    drivers
}

/// The place where each vehicle was last seen, with the frame.
fn last_seen(matched: &Matched<'_>) -> HashMap<i64, (i64, Position)> {
    let mut last_seen: HashMap<i64, (i64, Position)> = HashMap::new();
    for (track, places) in matched.recording.tracks.iter().zip(&matched.places) {
        let last =
            track.states.iter().zip(places).rev().find_map(|(state, it)| it.map(|it| (state.frame, it)));
        let Some((frame, place)) = last else { continue };
        let Position { chain, x: start } = matched.network.start_of(place.lanelet);
        let at = Position::new(chain, start + place.station);
        let seen = last_seen.entry(track.id).or_insert((frame, at));
        if frame > seen.0 {
            *seen = (frame, at);
        }
    }
    last_seen
}

/// The destination of each vehicle: the exit that is easiest to reach from where it was last observed. A vehicle that
/// left the map was at this exit.
fn goals(matched: &Matched<'_>, navigator: &Navigator) -> HashMap<i64, Destination> {
    last_seen(matched).into_iter().map(|(id, (_, at))| (id, easiest(navigator, at.chain, at.x))).collect()
}

/// The exit that needs the fewest lane changes from `x` on `chain`, and of several the least time.
pub(crate) fn easiest(navigator: &Navigator, chain: ChainIndex, x: f64) -> Destination {
    let changes = |destination: Destination| navigator.waypoint(destination, chain).changes;
    let reachable = navigator.reachable(chain, x);
    let easiest = reachable.min_by(|(a, time_of_a), (b, time_of_b)| {
        changes(*a).cmp(&changes(*b)).then(time_of_a.total_cmp(time_of_b))
    });
    easiest.and_then(|(destination, _)| destination)
}
