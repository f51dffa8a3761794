//! Durations of trips, and numbers of vehicles over time.

use laneweave_sim::{Event, World};
use laneweave_study::{Histogram, Moments};
use serde::{Deserialize, Serialize};

use super::driving::{names, styles_of};

/// Bins of times: their first width [s] and their number.
const BINS: (f64, usize) = (1.0, 60);
/// Initial time between two counts of vehicles [s], and the maximum of stored counts: beyond it, every second one is
/// removed.
const COUNTING: f64 = 5.0;
const MOST_COUNTS: usize = 400;

/// Collects the trips that ended.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TripTimes {
    style_of: Vec<u16>,
    /// Times on the map [s].
    pub durations: Histogram,
    /// Delays: of the time on the map, the part beyond that on a free road [s].
    pub delays: Histogram,
    /// The times' means.
    pub duration: Moments,
    /// The delays' means.
    pub delay: Moments,
    /// The delays' means by style.
    pub of_styles: Vec<(String, Moments)>,
}

impl TripTimes {
    /// The collector for the styles of `world`.
    pub fn of(world: &World) -> TripTimes {
        let empty = Histogram::new(0.0, BINS.0, BINS.1);
        TripTimes {
            style_of: styles_of(world),
            durations: empty.clone(),
            delays: empty,
            duration: Moments::default(),
            delay: Moments::default(),
            of_styles: names(world).into_iter().map(|it| (it, Moments::default())).collect(),
        }
    }

    /// Whether it goes on from `new`, which has seen nothing: the same styles and bins.
    pub(super) fn fits(&self, new: &TripTimes) -> bool {
        self.style_of == new.style_of
            && self.of_styles.iter().map(|it| &it.0).eq(new.of_styles.iter().map(|it| &it.0))
            && self.durations.fits(&new.durations)
            && self.delays.fits(&new.delays)
    }

    /// Observes the events of a step.
    pub fn observe(&mut self, world: &World) {
        for event in world.events() {
            let Event::Left { duration, trip: Some(trip), .. } = event else { continue };
            self.durations.reach(*duration);
            self.durations.add(*duration);
            self.duration.add(*duration);
            if let Some(delay) = trip.free_time.map(|it| duration - it) {
                self.delays.reach(delay);
                // A driver who is faster than the planned time, for example over a short lower limit, has no delay.
                self.delays.add(delay.max(0.0));
                self.delay.add(delay);
                self.of_styles[usize::from(self.style_of[trip.parameters as usize])].1.add(delay);
            }
        }
    }
}

/// Numbers of vehicles over time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Crowd {
    every: f64,
    /// Time [s], vehicles on the road, vehicles that wait to enter.
    pub counts: Vec<(f64, usize, usize)>,
}

impl Default for Crowd {
    /// No counts yet.
    fn default() -> Crowd {
        Crowd { every: COUNTING, counts: Vec::new() }
    }
}

impl Crowd {
    /// Whether its times between two counts are possible.
    pub(super) fn is_sound(&self) -> bool {
        self.every >= COUNTING && self.every.is_finite() && self.counts.len() <= MOST_COUNTS
    }

    /// Observes the world after a step.
    pub fn observe(&mut self, world: &World) {
        let clock = world.clock();
        if !clock.step.is_multiple_of(clock.steps(self.every)) {
            return;
        }
        self.count((clock.time(), world.on_road(), world.waiting()));
    }

    fn count(&mut self, count: (f64, usize, usize)) {
        self.counts.push(count);
        if self.counts.len() > MOST_COUNTS {
            self.every *= 2.0;
            let mut number = 0;
            self.counts.retain(|_| {
                number += 1;
                number % 2 == 0
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_too_many_counts_every_second_one_is_kept_and_fewer_follow() {
        let mut crowd = Crowd::default();
        (1..=MOST_COUNTS + 1).for_each(|it| crowd.count((COUNTING * it as f64, it, 0)));
        assert_eq!(crowd.every, 2.0 * COUNTING);
        let kept: Vec<usize> = crowd.counts.iter().map(|it| it.1).collect();
        assert_eq!((kept.len(), kept[0], kept[kept.len() - 1]), (MOST_COUNTS / 2, 2, MOST_COUNTS));
    }
}
