//! Stretches of a few seconds in which a driver follows one leader, or nobody.

use laneweave_models::Style;
use laneweave_recorded::{Assumed, Replay, ReplayError};
use laneweave_recordings::{Extent, Matched, extents, lane_changes};
use laneweave_sim::{Navigator, VehicleId};

use super::look::{Look, looks};
use super::predict::Moved;
use crate::observe::{FREE, Shown, Speeds};

/// Length of a stretch in looks, which are about a second apart (ours). It is so long that a gap moves towards the one
/// that is kept, and that drivers who react late have reacted: five seconds make *a* half as large on real motorways.
/// It is so short that many drivers show one.
pub(crate) const SECONDS: usize = 8;
/// Before its own change a driver may fall in with the other lane, and before a cut-in it may let the other one in [s];
/// ours.
const BEFORE: f64 = 8.0;
/// After a cut-in a driver accepts a shorter gap for a while [s]; ours.
const AFTER_CUT_IN: f64 = 20.0;
/// After its own change a driver accepts a shorter time gap, which relaxes to the usual one: for so many times the
/// relaxation time of the style, until a twentieth is left (ours).
const RELAXATIONS: f64 = 3.0;
/// A driver shows the time gap that it keeps if it is faster than this [m/s] (ours).
const MOVES: f64 = 2.0;

/// The leader at one time, as seen from the start of a stretch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Lead {
    /// Its rear bumper, ahead of where the driver's front bumper was at the start [m].
    pub(crate) rear: f64,
    /// Speed [m/s].
    pub(crate) speed: f64,
    /// Acceleration [m/s²].
    pub(crate) acceleration: f64,
}

/// Some seconds of a driver who follows one leader, or nobody.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stretch {
    /// Time between two looks [s].
    pub(crate) period: f64,
    /// The driver itself, at the start and after each period.
    pub(crate) own: [Moved; SECONDS + 1],
    /// Its leader at these times; none where there is none.
    pub(crate) leader: Option<Box<[Lead; SECONDS + 1]>>,
    /// What limit and class allow [m/s].
    pub(crate) allowed: f64,
    /// What its vehicle can accelerate [m/s²].
    pub(crate) strength: f64,
    /// What its speeds showed of its desired speed so far.
    pub(crate) shown: Option<Shown>,
}

/// A driver with all its stretches.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Followed {
    pub(crate) stretches: Vec<Stretch>,
    /// What its speeds show of its desired speed in the whole recording.
    pub(crate) shown: Option<Shown>,
}

impl Stretch {
    /// The time gap [s] beyond `jam_gap` [m] that the driver keeps at the start; `None` if it is free, or stands.
    pub(crate) fn time_gap(&self, jam_gap: f64) -> Option<f64> {
        /// No driver's own time gap is outside of this [s]; ours.
        const RANGE: [f64; 2] = [0.3, 4.0];
        let (speed, gap) = (self.own[0].speed, self.leader.as_ref()?[0].rear);
        let is_following = speed > MOVES && gap < FREE * speed;
        is_following.then(|| ((gap - jam_gap) / speed).clamp(RANGE[0], RANGE[1]))
    }
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
        let stretches = stretches(matched, looks, period, is_open, shown);
        Followed { stretches, shown: speeds.shown(track, i64::MAX) }
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

/// The stretches of one driver, one after the other.
fn stretches(
    matched: &Matched,
    looks: &[Look],
    period: f64,
    is_open: impl Fn(&Look) -> bool,
    shown: impl Fn(&Look) -> Option<Shown>,
) -> Vec<Stretch> {
    let (mut stretches, mut free_from) = (Vec::new(), 0);
    for (at, look) in looks.iter().enumerate().filter(|(_, it)| is_open(it)) {
        if at < free_from {
            continue;
        }
        let Some(window) = looks.get(at..=at + SECONDS) else { break };
        if !window.iter().all(&is_open) || !is_of_one_leader(window) {
            continue;
        }
        let Some(ways) = ways(matched, window) else { continue };
        let own = std::array::from_fn(|it| Moved { way: ways[it], speed: window[it].speed });
        let lead = |it: usize| {
            let (_, ahead) = window[it].leader?;
            Some(Lead { rear: ways[it] + ahead.gap, speed: ahead.speed, acceleration: ahead.acceleration })
        };
        let leads: Vec<Lead> = (0..window.len()).filter_map(lead).collect();
        stretches.push(Stretch {
            period,
            own,
            leader: leads.try_into().ok().map(Box::new),
            allowed: look.allowed,
            strength: look.strength,
            shown: shown(look),
        });
        free_from = at + SECONDS;
    }
    stretches
}

/// Whether looks follow one another, with one leader and one limit.
fn is_of_one_leader(window: &[Look]) -> bool {
    let id = |it: &Look| -> Option<VehicleId> { Some(it.leader?.0) };
    window.windows(2).all(|it| {
        it[1].number == it[0].number + 1 && id(&it[0]) == id(&it[1]) && it[0].allowed == it[1].allowed
    })
}

/// How far a driver came from the first look on [m]; `None` if it left the road in between.
fn ways(matched: &Matched, window: &[Look]) -> Option<Vec<f64>> {
    let mut ways = vec![0.0];
    for pair in window.windows(2) {
        let [from, to] = [&pair[0], &pair[1]];
        let chain = matched.network.chain(from.chain);
        let way = match from.chain == to.chain {
            true => to.x - from.x,
            false if chain.following.contains(&to.chain) => chain.length - from.x + to.x,
            false => return None,
        };
        ways.push(ways[ways.len() - 1] + way);
    }
    Some(ways)
}

#[cfg(test)]
mod tests {
    use laneweave_models::follow::Ahead;
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
    fn looks_of_one_stretch_follow_one_another_and_have_one_leader() {
        let window = |numbers: [i64; 2], leaders: [VehicleId; 2]| {
            let of = |at: usize| look(numbers[at], Some((leaders[at], 30.0)));
            is_of_one_leader(&[of(0), of(1)])
        };
        assert!(window([3, 4], [7, 7]));
        assert!(!window([3, 5], [7, 7]) && !window([3, 4], [7, 8]));
    }

    #[test]
    fn an_own_time_gap_is_that_of_who_moves_and_follows() {
        let stretch = |speed: f64, gap: f64| {
            let own = [Moved { way: 0.0, speed }; SECONDS + 1];
            let lead = Lead { rear: gap, speed, acceleration: 0.0 };
            Stretch { own, leader: Some(Box::new([lead; SECONDS + 1])), ..Stretch::default() }
        };
        assert_eq!(stretch(10.0, 14.0).time_gap(2.0), Some(1.2));
        assert_eq!(stretch(1.0, 3.0).time_gap(2.0), None);
        assert_eq!(stretch(10.0, 41.0).time_gap(2.0), None);
        assert_eq!(Stretch { leader: None, ..stretch(10.0, 14.0) }.time_gap(2.0), None);
    }
}
