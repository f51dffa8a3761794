//! Arrival rates that are piecewise constant in time.

use serde::{Deserialize, Serialize};

/// Number of vehicles that arrive per hour, as a function of time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// Start [s] and rate [veh/h] of each piece. The first start is 0, and the starts increase.
    pieces: Vec<(f64, f64)>,
}

impl Rate {
    /// A rate that is constant in time [veh/h].
    pub fn constant(rate: f64) -> Rate {
        Rate { pieces: vec![(0.0, rate)] }
    }

    /// A rate from the start [s] and the rate [veh/h] of each piece; 0 before the first start. `None` if the starts do
    /// not increase, or the first is negative.
    pub fn by_pieces(pieces: &[(f64, f64)]) -> Option<Rate> {
        let (first, _) = *pieces.first()?;
        let rise = pieces.windows(2).all(|it| it[0].0 < it[1].0);
        if !(rise && first >= 0.0 && pieces[pieces.len() - 1].0.is_finite()) {
            return None;
        }
        let nobody = (first > 0.0).then_some((0.0, 0.0));
        Some(Rate { pieces: nobody.into_iter().chain(pieces.iter().copied()).collect() })
    }

    /// The product of two functions of time, such as a rate and a factor.
    pub fn times(&self, factor: &Rate) -> Rate {
        let mut times: Vec<f64> = self.pieces.iter().chain(&factor.pieces).map(|(time, _)| *time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        Rate { pieces: times.into_iter().map(|time| (time, self.at(time) * factor.at(time))).collect() }
    }

    /// The rate at `time` [s], which is valid until the next change [veh/h].
    pub fn at(&self, time: f64) -> f64 {
        let after = self.pieces.partition_point(|(start, _)| *start <= time).max(1);
        self.pieces[after - 1].1
    }

    /// Time of the next change after `time` [s]; infinite if there is none.
    pub(crate) fn changes_after(&self, time: f64) -> f64 {
        let after = self.pieces.partition_point(|(start, _)| *start <= time);
        self.pieces.get(after).map_or(f64::INFINITY, |(start, _)| *start)
    }

    /// All rates that occur [veh/h].
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.pieces.iter().map(|(_, rate)| *rate)
    }

    /// The highest rate [veh/h].
    pub fn highest(&self) -> f64 {
        self.values().fold(0.0, f64::max)
    }

    /// Mean rate between two times [veh/h].
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        if let [(_, only)] = self.pieces[..] {
            return only;
        }
        let ends = self.pieces.iter().skip(1).map(|(start, _)| *start).chain([f64::INFINITY]);
        let within = |start: f64, end: f64| (end.min(to) - start.max(from)).max(0.0);
        let total: f64 =
            self.pieces.iter().zip(ends).map(|((start, rate), end)| rate * within(*start, end)).sum();
        total / (to - from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_holds_from_its_time_until_the_next() {
        let rate = Rate::by_pieces(&[(60.0, 100.0), (120.0, 300.0)]).unwrap();
        assert_eq!([0.0, 59.0, 60.0, 119.0, 1e9].map(|it| rate.at(it)), [0.0, 0.0, 100.0, 100.0, 300.0]);
        assert_eq!([0.0, 60.0, 120.0].map(|it| rate.changes_after(it)), [60.0, 120.0, f64::INFINITY]);
        assert_eq!((rate.highest(), rate.mean(0.0, 180.0)), (300.0, 400.0 / 3.0));
        assert_eq!(Rate::constant(5.0).mean(0.0, 1.0), 5.0);
    }

    #[test]
    fn a_factor_changes_a_rate_at_its_own_times() {
        let rate = Rate::by_pieces(&[(0.0, 100.0), (60.0, 200.0)]).unwrap();
        let factor = Rate::by_pieces(&[(0.0, 1.0), (30.0, 0.5)]).unwrap();
        let expected = Rate::by_pieces(&[(0.0, 100.0), (30.0, 50.0), (60.0, 100.0)]).unwrap();
        assert_eq!(rate.times(&factor), expected);
    }

    #[test]
    fn times_rise() {
        for pieces in [&[] as &[(f64, f64)], &[(-1.0, 1.0)], &[(0.0, 1.0), (0.0, 2.0)], &[(f64::NAN, 1.0)]] {
            assert_eq!(Rate::by_pieces(pieces), None);
        }
    }
}
