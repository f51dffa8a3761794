//! Values counted in bins.

use serde::{Deserialize, Serialize};

/// Counts of values in bins of equal width, from a first value on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    from: f64,
    width: f64,
    bins: Vec<u64>,
    /// Values below the first bin, and values from the end of the last one on.
    outside: [u64; 2],
}

impl Histogram {
    /// Empty, with `bins` bins of `width` from `from` on.
    pub fn new(from: f64, width: f64, bins: usize) -> Histogram {
        Histogram { from, width, bins: vec![0; bins.max(1)], outside: [0; 2] }
    }

    /// Whether it may be `new` with values: the same bins, or wider ones.
    pub fn fits(&self, new: &Histogram) -> bool {
        let is_wider = self.width >= new.width && self.width.is_finite();
        self.from == new.from && self.bins.len() == new.bins.len() && is_wider
    }

    /// Counts a value. An infinite one lies beyond the bins; NaN is not counted.
    #[inline]
    pub fn add(&mut self, value: f64) {
        let place = (value - self.from) / self.width;
        if place < 0.0 {
            self.outside[0] += 1;
        } else if let Some(bin) = self.bins.get_mut(place as usize).filter(|_| !place.is_nan()) {
            *bin += 1;
        } else if !place.is_nan() {
            self.outside[1] += 1;
        }
    }

    /// Doubles the width of the bins until `value`, if it is finite, lies before the end of the last one.
    pub fn reach(&mut self, value: f64) {
        while value.is_finite() && value >= self.range()[1] && self.outside[1] == 0 {
            self.width *= 2.0;
            let bins = self.bins.len();
            for bin in 0..bins {
                let both = self.bins[(2 * bin).min(bins)..(2 * bin + 2).min(bins)].iter().sum();
                self.bins[bin] = both;
            }
        }
    }

    /// Number of all values, including those outside the bins.
    pub fn total(&self) -> u64 {
        self.bins.iter().sum::<u64>() + self.outside[0] + self.outside[1]
    }

    /// Values beyond the last bin.
    pub fn beyond(&self) -> u64 {
        self.outside[1]
    }

    /// Values below the last edge of a bin that is not above `edge`.
    pub fn below(&self, edge: f64) -> u64 {
        let bins = (((edge - self.from) / self.width + 1e-9) as usize).min(self.bins.len());
        self.outside[0] + self.bins[..bins].iter().sum::<u64>()
    }

    /// Begin of the first bin and end of the last one.
    pub fn range(&self) -> [f64; 2] {
        [self.from, self.from + self.width * self.bins.len() as f64]
    }

    /// Width of a bin.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Share of all values in each bin.
    pub fn shares(&self) -> impl Iterator<Item = f64> + '_ {
        let total = self.total().max(1) as f64;
        self.bins.iter().map(move |it| *it as f64 / total)
    }

    /// The histogram without its empty bins at either end, if `others` have none there either and no value lies
    /// beyond; if the first bin is at zero, it stays. All histograms have the same bins.
    pub fn trimmed(&self, others: &[&Histogram]) -> Histogram {
        let all = || others.iter().copied().chain([self]);
        let is_used = |bin: &usize| all().any(|it| it.bins.get(*bin).is_some_and(|count| *count > 0));
        let bins = 0..self.bins.len();
        let first = bins.clone().find(is_used).filter(|_| self.from != 0.0).unwrap_or(0);
        let last = bins.clone().rev().find(is_used).unwrap_or(first);
        let [first, last] = [
            if all().any(|it| it.outside[0] > 0) { 0 } else { first },
            if all().any(|it| it.outside[1] > 0) { bins.end - 1 } else { last },
        ];
        let from = self.from + first as f64 * self.width;
        Histogram { from, bins: self.bins[first..=last].to_vec(), ..*self }
    }

    /// The value below which a `share` of all values lies; within a bin, values count as evenly spread. `None`
    /// without any value, or outside the bins.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let mut left = share * self.total() as f64 - self.outside[0] as f64;
        if left < 0.0 || self.total() == 0 {
            return None;
        }
        for (number, count) in self.bins.iter().enumerate().filter(|(_, count)| **count > 0) {
            let count = *count as f64;
            if left <= count {
                return Some(self.from + self.width * (number as f64 + left / count));
            }
            left -= count;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn of(values: &[f64]) -> Histogram {
        let mut histogram = Histogram::new(0.0, 1.0, 4);
        values.iter().for_each(|it| histogram.add(*it));
        histogram
    }

    #[test]
    fn what_lies_outside_counts_for_the_whole() {
        let histogram = of(&[-1.0, 0.0, 1.5, 1.7, 4.0, f64::INFINITY, f64::NAN]);
        assert_eq!((histogram.total(), histogram.beyond()), (6, 2));
        assert_eq!(histogram.shares().collect::<Vec<_>>(), [1.0 / 6.0, 2.0 / 6.0, 0.0, 0.0]);
        assert_eq!([-3.0, 1.0, 1.9, 9.0].map(|it| histogram.below(it)), [1, 2, 2, 4]);
    }

    #[test]
    fn the_median_of_evenly_spread_values_is_in_their_middle() {
        let histogram = of(&[0.5, 1.5, 2.5, 3.5]);
        assert_eq!([0.25, 0.5, 1.0].map(|it| histogram.quantile(it)), [Some(1.0), Some(2.0), Some(4.0)]);
        assert_eq!(of(&[]).quantile(0.5), None);
        assert_eq!(of(&[0.5, 9.0, 9.0]).quantile(0.5), None);
    }

    #[test]
    fn bins_grow_to_reach_a_value() {
        let mut histogram = of(&[0.5, 1.5, 3.5]);
        histogram.reach(9.0);
        histogram.add(9.0);
        assert_eq!((histogram.width(), histogram.range()), (4.0, [0.0, 16.0]));
        assert_eq!(histogram.shares().collect::<Vec<_>>(), [0.75, 0.0, 0.25, 0.0]);
        assert_eq!(histogram.trimmed(&[]).range(), [0.0, 12.0]);
    }

    #[test]
    fn bins_that_are_empty_everywhere_are_left_out() {
        let [mut a, mut b] = [(); 2].map(|()| Histogram::new(-4.0, 1.0, 8));
        a.add(-1.5);
        b.add(0.5);
        assert_eq!(a.trimmed(&[]).range(), [-2.0, -1.0]);
        assert_eq!(a.trimmed(&[&b]).range(), [-2.0, 1.0]);
        b.add(9.0);
        assert_eq!(a.trimmed(&[&b]).range(), [-2.0, 4.0]);
    }

    proptest! {
        #[test]
        fn no_value_is_lost_when_bins_grow(values in prop::collection::vec(0.0..1e4, 1..50)) {
            let mut histogram = Histogram::new(0.0, 1.0, 7);
            for value in &values {
                histogram.reach(*value);
                histogram.add(*value);
            }
            prop_assert_eq!((histogram.total(), histogram.beyond()), (values.len() as u64, 0));
            prop_assert!((histogram.shares().sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }
}
