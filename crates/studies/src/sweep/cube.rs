//! Latin hypercubes: points that are spread evenly over a range of each of several numbers.

use laneweave::sim::{Purpose, Random};

/// A Latin hypercube (McKay, Beckman, Conover 1979): of `samples` equal parts of each range, each has one point.
pub(super) struct Cube {
    /// Number of points.
    pub(super) samples: u32,
    /// Seed of the random numbers.
    pub(super) seed: u64,
}

impl Cube {
    /// The points, each with a number in each of the `ranges`.
    pub(super) fn points(&self, ranges: &[[f64; 2]]) -> Vec<Vec<f64>> {
        let columns: Vec<Vec<f64>> =
            ranges.iter().zip(0..).map(|(range, dimension)| self.column(*range, dimension)).collect();
        (0..self.samples as usize).map(|point| columns.iter().map(|it| it[point]).collect()).collect()
    }

    /// The numbers of all points in one of the ranges.
    fn column(&self, [low, high]: [f64; 2], dimension: u32) -> Vec<f64> {
        let random = Random::new(self.seed);
        let drawn = |number: u32| random.uniform(number, Purpose::Resampling, dimension);
        let mut parts: Vec<u32> = (0..self.samples).collect();
        for last in (1..parts.len()).rev() {
            let other = (drawn(last as u32) * (last + 1) as f64) as usize;
            parts.swap(last, other.min(last));
        }
        let place = |(part, number): (u32, u32)| {
            let within = drawn(self.samples + number);
            low + (high - low) * (f64::from(part) + within) / f64::from(self.samples)
        };
        parts.into_iter().zip(0..).map(place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_of_each_range_has_one_point() {
        let points = Cube { samples: 50, seed: 3 }.points(&[[0.0, 1.0], [-10.0, 40.0]]);
        let parts = |dimension: usize, low: f64, length: f64| {
            let mut parts: Vec<i64> =
                points.iter().map(|it| ((it[dimension] - low) / length).floor() as i64).collect();
            parts.sort_unstable();
            parts
        };
        let all: Vec<i64> = (0..50).collect();
        assert_eq!(parts(0, 0.0, 0.02), all);
        assert_eq!(parts(1, -10.0, 1.0), all);
    }

    #[test]
    fn numbers_of_different_ranges_are_not_in_one_order() {
        let points = Cube { samples: 1000, seed: 1 }.points(&[[-1.0, 1.0], [-1.0, 1.0]]);
        let product = points.iter().map(|it| it[0] * it[1]).sum::<f64>() / 1000.0;
        // The standard deviation of the mean of 1000 products of independent numbers is 0.011.
        assert!(product.abs() < 0.04, "{product}");
        let other = Cube { samples: 1000, seed: 2 }.points(&[[-1.0, 1.0], [-1.0, 1.0]]);
        assert_ne!(points, other);
    }
}
