//! How long trips took, and how many vehicles were there in the course of time.

use laneweave_sim::{Event, World};
use laneweave_study::{Histogram, Moments};
use serde::{Deserialize, Serialize};

use super::driving::{names, styles_of};

/// Bins of times: their first width [s] and their number.
const BINS: (f64, usize) = (1.0, 60);
/// Time between two counts of vehicles at first [s], and the most counts that are kept: with more, every second one
/// goes.
const COUNTING: f64 = 5.0;
const MOST_COUNTS: usize = 400;

/// Collects the trips that are over.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TripTimes {
    style_of: Vec<u16>,
    /// Times on the map [s].
    pub durations: Histogram,
    /// Of the time on the map, what is beyond that on a free road [s].
    pub delays: Histogram,
    /// The times' means.
    pub duration: Moments,
    /// The delays' means.
    pub delay: Moments,
    /// The delays' means by style.
    pub of_styles: Vec<(String, Moments)>,
}

impl TripTimes {
    /// Of the styles of `world`.
    pub fn of(world: &World) -> TripTimes {
        let empty = Histogram::new(0.0, BINS.0, BINS.1);
        TripTimes {
            style_of: styles_of(world.demand()),
            durations: empty.clone(),
            delays: empty,
            duration: Moments::default(),
            delay: Moments::default(),
            of_styles: names(world).into_iter().map(|it| (it, Moments::default())).collect(),
        }
    }

    /// Looks at what happened in a step.
    pub fn observe(&mut self, world: &World) {
        for event in world.events() {
            let Event::Left { duration, trip: Some(trip), .. } = event else { continue };
            self.durations.reach(*duration);
            self.durations.add(*duration);
            self.duration.add(*duration);
            if let Some(delay) = trip.free_time.map(|it| duration - it) {
                self.delays.reach(delay);
                // Who drives faster than planned, as over a gentle limit, has no delay.
                self.delays.add(delay.max(0.0));
                self.delay.add(delay);
                self.of_styles[usize::from(self.style_of[trip.parameters as usize])].1.add(delay);
            }
        }
    }
}

/// Vehicles in the course of time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Crowd {
    every: f64,
    /// Time [s], vehicles on the road, vehicles that wait at the entrances.
    pub counts: Vec<(f64, usize, usize)>,
}

impl Default for Crowd {
    /// None counted yet.
    fn default() -> Crowd {
        Crowd { every: COUNTING, counts: Vec::new() }
    }
}

impl Crowd {
    /// Looks at the world after a step.
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
