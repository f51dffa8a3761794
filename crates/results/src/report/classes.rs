//! Measures of boxes of traffic, over classes of density.

use std::collections::BTreeMap;

use laneweave_study::{Estimated, Interval, Moments};

/// Width of the classes of density over which means are taken [veh/km].
pub const CLASS: f64 = 5.0;
/// Minimum number of boxes for a mean in a figure.
pub const LEAST_BOXES: usize = 3;

/// Means of the second values over classes of the first ones.
pub fn means(points: &[[f64; 2]]) -> Vec<Estimated> {
    let mut classes: BTreeMap<u64, [Moments; 2]> = BTreeMap::new();
    for point in points {
        let class = classes.entry((point[0] / CLASS) as u64).or_default();
        class.iter_mut().zip(point).for_each(|(moments, value)| moments.add(*value));
    }
    let estimates = classes.into_values().filter_map(|it| Some((it[0].estimate()?, it[1].estimate()?)));
    let enough = estimates.filter(|(_, it)| it.replications >= LEAST_BOXES);
    // Flow and speed are not negative, so no plausible value of their mean is.
    let positive = |it: Interval| Interval { lower: it.lower.max(0.0), ..it };
    enough
        .map(|(at, it)| Estimated { at: at.mean, value: it.mean, interval: positive(it.interval()) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_taken_over_classes_with_enough_boxes() {
        let points = [[1.0, 10.0], [2.0, 20.0], [3.0, 30.0], [6.0, 40.0], [7.0, 50.0]];
        let means = means(&points);
        assert_eq!(means.len(), 1);
        assert_eq!((means[0].at, means[0].value), (2.0, 20.0));
        // t₂ s/√3 = 4.302653 · 10/1.732051
        assert!((means[0].interval.upper - 44.841377).abs() < 1e-6);
        assert_eq!(means[0].interval.lower, 0.0);
    }
}
