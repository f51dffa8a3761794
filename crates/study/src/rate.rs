//! Lane-change rate as a function of density: boxes of like density are pooled.

use std::collections::BTreeMap;

use crate::edie::EdieRow;
use crate::statistics::{Interval, poisson_interval};

/// Boxes of similar density, pooled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatePoint {
    /// ρ: mean density of the boxes, weighted by their size [veh/km per lane].
    pub density_veh_per_km: f64,
    /// n: lane changes in them.
    pub changes: u64,
    /// Δx Δt: their size [km h].
    pub exposure_km_h: f64,
}

impl RatePoint {
    /// r(ρ) = n / (Δx Δt): lane-change rate [1/(km h)].
    pub fn rate_per_km_h(&self) -> f64 {
        self.changes as f64 / self.exposure_km_h
    }

    /// The exact Poisson 95 % interval of the rate [1/(km h)].
    pub fn interval_per_km_h(&self) -> Interval {
        let Interval { lower, upper } = poisson_interval(self.changes);
        Interval { lower: lower / self.exposure_km_h, upper: upper / self.exposure_km_h }
    }
}

/// One curve, of a model, a style or a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct RateSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its points in order of density.
    pub points: Vec<RatePoint>,
}

/// Pools boxes in bins of density, `bin_veh_per_km` wide; in order of density, bins without a box left out.
pub fn rate_by_density(rows: impl IntoIterator<Item = EdieRow>, bin_veh_per_km: f64) -> Vec<RatePoint> {
    let mut bins: BTreeMap<u64, RatePoint> = BTreeMap::new();
    for row in rows {
        let empty = RatePoint { density_veh_per_km: 0.0, changes: 0, exposure_km_h: 0.0 };
        let bin = bins.entry((row.density_veh_per_km / bin_veh_per_km) as u64).or_insert(empty);
        bin.changes += row.changes;
        bin.exposure_km_h += row.exposure_km_h;
        let weight = row.exposure_km_h / bin.exposure_km_h;
        bin.density_veh_per_km += weight * (row.density_veh_per_km - bin.density_veh_per_km);
    }
    bins.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edie::{EdieGrid, Window};

    #[test]
    fn boxes_of_like_density_are_pooled_by_their_size() {
        let window = Window { from_s: 0.0, interval_s: 3600.0, intervals: 1 };
        let mut grid = EdieGrid::new(vec![1000.0, 3000.0, 1000.0], window).unwrap();
        // 12, 16 and 25 veh/km.
        (0..12).for_each(|_| grid.add(0, 0.0, 3600.0, 0.0));
        (0..48).for_each(|_| grid.add(1, 0.0, 3600.0, 0.0));
        (0..25).for_each(|_| grid.add(2, 0.0, 3600.0, 0.0));
        (0..8).for_each(|_| grid.change(1, 0.0));
        let points = rate_by_density(grid.rows(), 10.0);
        let expected = [(15.0, 8, 4.0), (25.0, 0, 1.0)];
        assert_eq!(points.len(), expected.len());
        for (point, (density_veh_per_km, changes, exposure_km_h)) in points.iter().zip(expected) {
            assert_eq!(*point, RatePoint { density_veh_per_km, changes, exposure_km_h });
        }
        assert_eq!(points[0].rate_per_km_h(), 2.0);
    }

    #[test]
    fn fifty_changes_on_half_a_kilometre_in_ten_minutes_have_their_exact_interval() {
        let point = RatePoint { density_veh_per_km: 20.0, changes: 50, exposure_km_h: 0.5 / 6.0 };
        let Interval { lower, upper } = point.interval_per_km_h();
        assert_eq!((lower.round(), upper.round()), (445.0, 791.0));
    }
}
