//! Stretches of equal length into which episodes are cut.

use super::episode::{Episode, Followed};
use super::predict::Moved;
use crate::observe::{FREE, Shown};

/// Lengths of stretches in looks, which are about a second apart (ours). Long ones show which gap a driver comes to,
/// and not only how it goes there: with eight seconds b comes out at half of what twenty seconds show of the same
/// recorded drivers. In a short view nobody shows long ones.
const LENGTHS: [usize; 3] = [20, 14, 8];
/// Drivers who show a stretch of a length that is used (ours): the error of the mean of their time gaps, which spread
/// by about a third, is then a twentieth.
const ENOUGH: usize = 60;
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
    pub(crate) own: Vec<Moved>,
    /// Its leader at these times; empty where there is none.
    pub(crate) leader: Vec<Lead>,
    /// What limit and class allow [m/s].
    pub(crate) allowed: f64,
    /// What its vehicle can accelerate [m/s²].
    pub(crate) strength: f64,
    /// What its speeds showed of its desired speed so far.
    pub(crate) shown: Option<Shown>,
}

/// The stretches of a driver.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stretches {
    pub(crate) all: Vec<Stretch>,
    /// What its speeds show of its desired speed in the whole recording.
    pub(crate) shown: Option<Shown>,
}

/// The longest length of stretches that enough of these drivers show; the shortest one if none is.
pub(super) fn length(drivers: &[Followed]) -> usize {
    let showing = |length: usize| {
        let shows = |it: &&Followed| it.episodes.iter().any(|it| it.seen.len() > length);
        drivers.iter().filter(shows).count()
    };
    LENGTHS.into_iter().find(|it| showing(*it) >= ENOUGH).unwrap_or(LENGTHS[LENGTHS.len() - 1])
}

/// All stretches of so many looks after the first one, driver by driver.
pub(super) fn stretches(drivers: &[Followed], length: usize) -> Vec<Stretches> {
    let of = |it: &Followed| Stretches {
        all: it.episodes.iter().flat_map(|it| cut(it, length)).collect(),
        shown: it.shown,
    };
    drivers.iter().map(of).collect()
}

/// The stretches of an episode, one after the other: one ends with the look with which the next one starts.
fn cut(episode: &Episode, length: usize) -> impl Iterator<Item = Stretch> {
    let starts = (0..episode.seen.len().saturating_sub(length)).step_by(length);
    starts.map(move |start| {
        let seen = &episode.seen[start..=start + length];
        let gone = seen[0].own.way;
        Stretch {
            period: episode.period,
            own: seen.iter().map(|it| Moved { way: it.own.way - gone, ..it.own }).collect(),
            leader: seen
                .iter()
                .filter_map(|it| it.leader)
                .map(|it| Lead { rear: it.rear - gone, ..it })
                .collect(),
            allowed: episode.allowed,
            strength: episode.strength,
            shown: seen[0].shown,
        }
    })
}

impl Stretch {
    /// Its length in looks after the first one.
    pub(crate) fn length(&self) -> usize {
        self.own.len() - 1
    }

    /// The time gap [s] beyond `jam_gap` [m] that the driver keeps at the start; `None` if it is free, or stands.
    pub(crate) fn time_gap(&self, jam_gap: f64) -> Option<f64> {
        /// No driver's own time gap is outside of this [s]; ours.
        const RANGE: [f64; 2] = [0.3, 4.0];
        let (speed, gap) = (self.own[0].speed, self.leader.first()?.rear);
        let is_following = speed > MOVES && gap < FREE * speed;
        is_following.then(|| ((gap - jam_gap) / speed).clamp(RANGE[0], RANGE[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::episode::Seen;
    use super::*;

    /// An episode of so many looks at 10 m/s behind a leader at the same speed, 14 m ahead.
    fn episode(looks: usize) -> Episode {
        let seen = |at: usize| {
            let way = 10.0 * at as f64;
            let leader = Some(Lead { rear: way + 14.0, speed: 10.0, acceleration: 0.0 });
            Seen { own: Moved { way, speed: 10.0 }, leader, shown: None }
        };
        Episode { period: 1.0, allowed: 30.0, strength: 3.0, seen: (0..looks).map(seen).collect() }
    }

    fn driver(looks: usize) -> Followed {
        Followed { episodes: vec![episode(looks)], shown: None }
    }

    #[test]
    fn an_episode_is_cut_into_stretches_that_start_where_the_one_before_ends() {
        let counts = [8, 9, 16, 17].map(|it| cut(&episode(it), 8).count());
        assert_eq!(counts, [0, 1, 1, 2]);
        let cut: Vec<Stretch> = cut(&episode(17), 8).collect();
        assert_eq!(cut[0], cut[1]);
        assert_eq!((cut[1].length(), cut[1].own[8].way, cut[1].leader[0].rear), (8, 80.0, 14.0));
    }

    #[test]
    fn stretches_are_as_long_as_enough_drivers_show() {
        let drivers = |long: usize, middle: usize, short: usize| {
            [vec![driver(21); long], vec![driver(15); middle], vec![driver(9); short]].concat()
        };
        assert_eq!(length(&drivers(ENOUGH, 0, 200)), 20);
        assert_eq!(length(&drivers(ENOUGH - 1, 0, 200)), 8);
        assert_eq!(length(&drivers(ENOUGH - 1, 1, 200)), 14);
        assert_eq!(length(&drivers(0, 0, 3)), 8);
    }

    #[test]
    fn an_own_time_gap_is_that_of_who_moves_and_follows() {
        let stretch = |speed: f64, gap: f64| {
            let own = vec![Moved { way: 0.0, speed }];
            Stretch { own, leader: vec![Lead { rear: gap, speed, acceleration: 0.0 }], ..Stretch::default() }
        };
        assert_eq!(stretch(10.0, 14.0).time_gap(2.0), Some(1.2));
        assert_eq!(stretch(1.0, 3.0).time_gap(2.0), None);
        assert_eq!(stretch(10.0, 41.0).time_gap(2.0), None);
        assert_eq!(Stretch { leader: Vec::new(), ..stretch(10.0, 14.0) }.time_gap(2.0), None);
    }
}
