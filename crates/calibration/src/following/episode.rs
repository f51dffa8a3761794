//! Episodes in which a driver follows one leader, or nobody.

use laneweave_models::Style;
use laneweave_models::follow::Ahead;
use laneweave_recorded::{Assumed, Replay, ReplayError};
use laneweave_recordings::{Extent, Matched, extents, lane_changes};
use laneweave_sim::{Navigator, VehicleId};

use super::look::{Look, looks};
use super::predict::Moved;
use super::stretch::Lead;
use crate::observe::{FREE, Shown, Speeds};

/// Before its own change a driver may fall in with the other lane, and before a cut-in it may let the other one in [s];
/// ours.
const BEFORE: f64 = 8.0;
/// After a cut-in a driver accepts a shorter gap for a while [s]; ours.
const AFTER_CUT_IN: f64 = 20.0;
/// After its own change a driver accepts a shorter time gap, which relaxes to the usual one: for so many times the
/// relaxation time of the style, until a twentieth is left (ours).
const RELAXATIONS: f64 = 3.0;

/// What is seen of a driver at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Seen {
    /// How far it came since the start of the episode, and how fast it is.
    pub(crate) own: Moved,
    /// Its leader, as seen from the start of the episode.
    pub(crate) leader: Option<Lead>,
    /// What its speeds showed of its desired speed so far.
    pub(crate) shown: Option<Shown>,
}

/// A time in which a driver follows one leader, or nobody, and reacts to nothing else.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Episode {
    /// Time between two looks [s].
    pub(crate) period: f64,
    /// What limit and class allow [m/s].
    pub(crate) allowed: f64,
    /// What its vehicle can accelerate [m/s²].
    pub(crate) strength: f64,
    /// At each look.
    pub(crate) seen: Vec<Seen>,
}

/// A driver with all its episodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Followed {
    pub(crate) episodes: Vec<Episode>,
    /// What its speeds show of its desired speed in the whole recording.
    pub(crate) shown: Option<Shown>,
}

/// All drivers of the recording of `matched`, as seen by drivers of `style`.
///
/// # Errors
/// If the style's numbers make no sense for a driver.
pub(crate) fn followed(
    matched: &Matched<'_>,
    navigator: &Navigator,
    style: &Style,
) -> Result<Vec<Followed>, ReplayError> {
    let changes = lane_changes(matched);
    let styles = [style.clone()];
    let by_speeds = |track| Assumed::by_its_speeds(matched, track, 0);
    let replay = Replay::new(matched, &changes, navigator, &styles, by_speeds)?.without_destinations();
    let (tracks, period) = looks(matched, &replay);
    let speeds = Speeds::of(matched, &replay);
    let first = matched.recording.frames().map_or(0, |it| it.0) as f64 * matched.recording.step;
    let mut own: Vec<Vec<Extent>> = vec![Vec::new(); tracks.len()];
    changes.iter().zip(extents(matched, &changes)).for_each(|(it, extent)| own[it.track].push(extent));
    let after = RELAXATIONS * style.manner.relaxation;
    let of = |(track, looks): (usize, &Vec<Look>)| {
        let mut blocked: Vec<[f64; 2]> =
            own[track].iter().map(|it| [it.began - BEFORE, it.ended + after]).collect();
        let time = |look: &Look| first + look.number as f64 * period;
        blocked.extend(cut_ins(looks).map(|it| [time(it) - BEFORE, time(it) + AFTER_CUT_IN]));
        let is_open =
            |it: &Look| it.is_plain && !blocked.iter().any(|[from, to]| (*from..=*to).contains(&time(it)));
        let frame = |look: &Look| (time(look) / matched.recording.step).round() as i64;
        let shown = |look: &Look| speeds.shown(track, frame(look));
        let episodes = episodes(matched, looks, is_open);
        let episodes = episodes.iter().map(|it| episode(matched, it, period, shown)).collect();
        Followed { episodes, shown: speeds.shown(track, i64::MAX) }
    };
    Ok(tracks.iter().enumerate().map(of).collect())
}

/// The looks at which a driver has another, nearer leader than before.
fn cut_ins(looks: &[Look]) -> impl Iterator<Item = &Look> {
    looks.windows(2).filter_map(|pair| {
        let (leader, ahead) = pair[1].leader?;
        let is_nearer = match pair[0].leader {
            Some((before, _)) if before == leader => false,
            Some((_, before)) => ahead.gap < before.gap,
            None => true,
        };
        (is_nearer && ahead.gap < FREE * pair[1].speed).then_some(&pair[1])
    })
}

/// The looks of each episode of one driver.
fn episodes<'a>(matched: &Matched, looks: &'a [Look], is_open: impl Fn(&Look) -> bool) -> Vec<&'a [Look]> {
    let goes_on = |from: &Look, to: &Look| {
        is_open(from) && is_open(to) && is_of_one_leader(from, to) && way(matched, from, to).is_some()
    };
    looks.chunk_by(goes_on).filter(|it| it.len() > 1).collect()
}

/// The episode of these looks.
fn episode(
    matched: &Matched,
    looks: &[Look],
    period: f64,
    shown: impl Fn(&Look) -> Option<Shown>,
) -> Episode {
    let mut before: Option<(&Look, f64)> = None;
    let seen = looks.iter().map(|look| {
        let way = before.map_or(0.0, |(last, gone)| gone + way(matched, last, look).unwrap_or_default());
        before = Some((look, way));
        let lead = |ahead: &Ahead| Lead {
            rear: way + ahead.gap,
            speed: ahead.speed,
            acceleration: ahead.acceleration,
        };
        let leader = look.leader.as_ref().map(|(_, ahead)| lead(ahead));
        Seen { own: Moved { way, speed: look.speed }, leader, shown: shown(look) }
    });
    Episode { period, allowed: looks[0].allowed, strength: looks[0].strength, seen: seen.collect() }
}

/// Whether a look follows another one, with the same leader and the same limit.
fn is_of_one_leader(from: &Look, to: &Look) -> bool {
    let id = |it: &Look| -> Option<VehicleId> { Some(it.leader?.0) };
    to.number == from.number + 1 && id(from) == id(to) && from.allowed == to.allowed
}

/// How far a driver came between two looks [m]; `None` if it left the road in between.
fn way(matched: &Matched, from: &Look, to: &Look) -> Option<f64> {
    let chain = matched.network.chain(from.chain);
    match from.chain == to.chain {
        true => Some(to.x - from.x),
        false if chain.following.contains(&to.chain) => Some(chain.length - from.x + to.x),
        false => None,
    }
}

#[cfg(test)]
mod tests {
    use laneweave_network::ChainIndex;

    use super::*;

    /// A look at 20 m/s behind this leader at this gap [m].
    fn look(number: i64, leader: Option<(VehicleId, f64)>) -> Look {
        Look {
            number,
            chain: ChainIndex(0),
            x: 20.0 * number as f64,
            speed: 20.0,
            allowed: 30.0,
            strength: 3.0,
            leader: leader.map(|(id, gap)| (id, Ahead::steady(gap, 20.0))),
            is_plain: true,
        }
    }

    #[test]
    fn a_new_leader_is_a_cut_in_if_it_is_nearer_than_the_one_before() {
        let seen =
            [Some((1, 40.0)), Some((1, 39.0)), Some((2, 15.0)), Some((2, 16.0)), Some((3, 50.0)), None];
        let looks: Vec<Look> = (0..).zip(seen).map(|(number, it)| look(number, it)).collect();
        let numbers: Vec<i64> = cut_ins(&looks).map(|it| it.number).collect();
        assert_eq!(numbers, [2]);
        // Whoever comes up to a leader from afar is cut off by nobody.
        let looks = [look(0, None), look(1, Some((1, 200.0)))];
        assert_eq!(cut_ins(&looks).count(), 0);
        let looks = [look(0, None), look(1, Some((1, 60.0)))];
        assert_eq!(cut_ins(&looks).count(), 1);
    }

    #[test]
    fn looks_of_one_episode_follow_one_another_and_have_one_leader() {
        let pair = |numbers: [i64; 2], leaders: [VehicleId; 2]| {
            let of = |at: usize| look(numbers[at], Some((leaders[at], 30.0)));
            is_of_one_leader(&of(0), &of(1))
        };
        assert!(pair([3, 4], [7, 7]));
        assert!(!pair([3, 5], [7, 7]) && !pair([3, 4], [7, 8]));
    }
}
