//! Lanelet aggregates: sums of what vehicles do on every lanelet, if they are requested. These are the time that
//! vehicles spend there, the distance that they drive, and the number that passes the end.
//!
//! The position of a vehicle is recorded once a second, and whenever it leaves its chain. Between two such instants
//! the aggregates assume a constant speed.

use laneweave_network::{Chain, Network};
use serde::{Deserialize, Serialize};

use crate::record::trip_log::TripLog;
use crate::state::clock::Clock;
use crate::state::lane::{Kinematics, Lane};
use crate::state::standstill::STANDSTILL;

/// What vehicles did on a lanelet; the position of a vehicle is that of its front bumper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LaneletAggregate {
    /// Σt: time that they spent on it [s].
    pub time: f64,
    /// Σd: distance that they drove on it [m].
    pub way: f64,
    /// The part of this time in which vehicles stood: slower than 0.1 m/s at the instant of recording [s].
    pub standing: f64,
    /// Vehicles that passed its end.
    pub passed: u32,
}

impl LaneletAggregate {
    /// The sum of both.
    pub fn plus(self, other: LaneletAggregate) -> LaneletAggregate {
        LaneletAggregate {
            time: self.time + other.time,
            way: self.way + other.way,
            standing: self.standing + other.standing,
            passed: self.passed + other.passed,
        }
    }

    /// Edie's density on a lanelet of this `length` [m] over this `duration` [s], in vehicles per metre.
    pub fn density(&self, length: f64, duration: f64) -> f64 {
        self.time / (length * duration)
    }

    /// The same of the vehicles that stood.
    pub fn standing_density(&self, length: f64, duration: f64) -> f64 {
        self.standing / (length * duration)
    }

    /// Edie's flow on it, in vehicles per second.
    pub fn flow(&self, length: f64, duration: f64) -> f64 {
        self.way / (length * duration)
    }

    /// Edie's speed [m/s], if there were vehicles.
    pub fn speed(&self) -> Option<f64> {
        (self.time > 0.0).then(|| self.way / self.time)
    }

    /// The difference from an earlier state `before`.
    pub fn since(self, before: LaneletAggregate) -> LaneletAggregate {
        LaneletAggregate {
            time: self.time - before.time,
            way: self.way - before.way,
            standing: self.standing - before.standing,
            passed: self.passed - before.passed,
        }
    }
}

/// Where and when a vehicle was recorded last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Mark {
    /// Station on its chain [m].
    pub(crate) x: f64,
    /// Time [s].
    pub(crate) time: f64,
}

impl Mark {
    /// The mark of a vehicle at the station `x` [m] of its chain, which it passed in the last step.
    pub(crate) fn at(x: f64, motion: &Kinematics, clock: Clock) -> Mark {
        // This assumes a constant acceleration within the step.
        let driven = (motion.speed - 0.5 * f64::from(motion.acceleration) * clock.dt) * clock.dt;
        let share = if driven > 0.0 { ((motion.x - x) / driven).clamp(0.0, 1.0) } else { 0.0 };
        Mark { x, time: clock.time() - share * clock.dt }
    }
}

/// Sums for each lanelet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LaneletAggregates {
    pub(crate) stays: Vec<LaneletAggregate>,
}

impl LaneletAggregates {
    /// Empty aggregates of `network`.
    pub(crate) fn new(network: &Network) -> LaneletAggregates {
        LaneletAggregates { stays: vec![LaneletAggregate::default(); network.lanelets.len()] }
    }

    /// Records where all vehicles are.
    pub(crate) fn look(&mut self, network: &Network, lanes: &[Lane], trip_log: &mut TripLog, clock: Clock) {
        let time = clock.time();
        for (chain, lane) in network.chains.iter().zip(lanes) {
            // They are in driving order, and so are their lanelets.
            let mut place = 0;
            for (motion, driver) in lane.motions().iter().zip(lane.drivers()) {
                if driver.is_shadow {
                    continue;
                }
                while chain.starts.get(place + 1).is_some_and(|it| *it <= motion.x) {
                    place += 1;
                }
                if let Some(record) = trip_log.of_mut(motion.id) {
                    let now = Mark { x: motion.x, time };
                    let before = std::mem::replace(&mut record.mark, now);
                    self.put_down(chain, place, [before, now], motion.speed < STANDSTILL);
                }
            }
        }
    }

    /// Records what a vehicle did on `chain` between two marks.
    pub(crate) fn note(&mut self, chain: &Chain, [from, to]: [Mark; 2]) {
        let place = chain.starts.partition_point(|it| *it <= to.x).max(1) - 1;
        self.put_down(chain, place, [from, to], false);
    }

    /// Counts a vehicle that passed the end of `chain`.
    pub(crate) fn pass_end(&mut self, chain: &Chain) {
        if let Some(last) = chain.lanelets.last() {
            self.stays[last.at()].passed += 1;
        }
    }

    /// Records what a vehicle did between two marks on `chain`. The second mark is on lanelet number `place`.
    #[inline]
    fn put_down(&mut self, chain: &Chain, place: usize, marks: [Mark; 2], stands: bool) {
        let [from, to] = marks;
        if from.x < chain.starts[place] && place > 0 {
            return self.share_out(chain, place, marks);
        }
        let stay = &mut self.stays[chain.lanelets[place].at()];
        let time = to.time - from.time;
        stay.time += time;
        stay.way += to.x - from.x;
        if stands {
            stay.standing += time;
        }
    }

    /// Records the same for a vehicle that passed from one lanelet to another.
    #[cold]
    fn share_out(&mut self, chain: &Chain, mut place: usize, [from, to]: [Mark; 2]) {
        let pace = (to.time - from.time) / (to.x - from.x);
        let mut end = to.x;
        loop {
            let is_first = from.x >= chain.starts[place] || place == 0;
            let start = if is_first { from.x } else { chain.starts[place] };
            let stay = &mut self.stays[chain.lanelets[place].at()];
            stay.way += end - start;
            stay.time += (end - start) * pace;
            if is_first {
                return;
            }
            end = start;
            place -= 1;
            self.stays[chain.lanelets[place].at()].passed += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Motorway, motorway};

    use super::*;

    /// What is recorded between two marks on a road with five lanelets of 100 m: time, distance and passings of each.
    fn stays(marks: [Mark; 2]) -> Vec<(f64, f64, u32)> {
        let plan = Motorway { lanes: 1, length_m: 500.0, ..Motorway::default() };
        let network = motorway(&plan).unwrap().build().unwrap().network;
        let chain = &network.chains[0];
        let mut aggregates = LaneletAggregates::new(&network);
        let place = chain.starts.partition_point(|it| *it <= marks[1].x) - 1;
        aggregates.put_down(chain, place, marks, false);
        let rounded = |it: f64| (it * 1e6).round() / 1e6;
        let of = |it: &LaneletAggregate| (rounded(it.time), rounded(it.way), it.passed);
        chain.lanelets.iter().map(|it| of(&aggregates.stays[it.at()])).collect()
    }

    fn mark(x: f64, time: f64) -> Mark {
        Mark { x, time }
    }

    const NOTHING: (f64, f64, u32) = (0.0, 0.0, 0);

    #[test]
    fn who_stays_on_a_lanelet_spends_all_its_time_there() {
        let one = stays([mark(120.0, 7.0), mark(150.0, 8.0)]);
        assert_eq!(one, [NOTHING, (1.0, 30.0, 0), NOTHING, NOTHING, NOTHING]);
    }

    #[test]
    fn who_passes_from_one_to_another_is_shared_as_at_constant_speed() {
        let two = stays([mark(90.0, 7.0), mark(130.0, 8.0)]);
        assert_eq!(two, [(0.25, 10.0, 1), (0.75, 30.0, 0), NOTHING, NOTHING, NOTHING]);
        let all = stays([mark(50.0, 0.0), mark(450.0, 4.0)]);
        assert_eq!(all, [(0.5, 50.0, 1), (1.0, 100.0, 1), (1.0, 100.0, 1), (1.0, 100.0, 1), (0.5, 50.0, 0)]);
    }

    #[test]
    fn who_stands_on_the_line_is_on_the_lanelet_beyond_it() {
        assert_eq!(stays([mark(100.0, 1.0), mark(100.0, 2.0)])[1], (1.0, 0.0, 0));
        assert_eq!(stays([mark(90.0, 1.0), mark(100.0, 2.0)])[..2], [(1.0, 10.0, 1), NOTHING]);
    }
}
