//! Lane-change rate against density, with exact Poisson intervals.

use super::drawn::Drawn;
use super::estimates::estimates;
use super::series::Estimated;
use super::sheet::Sheet;
use crate::rate::{RatePoint, RateSeries};

/// Draws the lane-change rate [1/(km h)] against the density [veh/km per lane], each point with the exact Poisson
/// 95 % interval of its count.
pub fn rate_density(sheet: Sheet, title: &str, series: &[RateSeries]) -> Drawn {
    let estimated = |it: &RatePoint| Estimated {
        at: it.density_veh_per_km,
        value: it.rate_per_km_h(),
        interval: it.interval_per_km_h(),
    };
    let points = |it: &RateSeries| (it.name.clone(), it.points.iter().map(estimated).collect());
    let series: Vec<(String, Vec<Estimated>)> = series.iter().map(points).collect();
    estimates(sheet, title, ["Density [veh/km per lane]", "Lane-change rate [1/(km h)]"], &series)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series() -> RateSeries {
        let points = [(10.0, 50), (20.0, 100)];
        let point =
            |(density_veh_per_km, changes)| RatePoint { density_veh_per_km, changes, exposure_km_h: 1.0 };
        RateSeries { name: "A & B".into(), points: points.map(point).to_vec() }
    }

    #[test]
    fn a_point_stands_at_its_density_and_rate_with_its_interval() {
        // 0 … 20 veh/km across 84 … 804 px; 0 … 140 per km and hour (121.6 rounded up) from 496 up to 56 px.
        let svg = rate_density(Sheet::Page, "", &[series()]).svg;
        assert!(svg.contains("<path d=\"M444.0 338.9L804.0 181.7\""), "{svg}");
        assert!(svg.contains("d=\"M444.0 379.4V288.8M"), "{svg}");
    }

    #[test]
    fn both_axes_name_their_unit_and_the_legend_its_series() {
        let svg = rate_density(Sheet::Page, "title", &[series()]).svg;
        for text in ["title", "Density [veh/km per lane]", "Lane-change rate [1/(km h)]", "A &amp; B"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }

    #[test]
    fn in_a_column_there_is_no_title_and_the_legend_stands_above_the_plot() {
        // The plot from (62, 27.5) to (466, 257.5) px; at most six steps up to 121.6: 0 … 150 per km and hour.
        let svg = rate_density(Sheet::Column, "title", &[series()]).svg;
        assert!(!svg.contains("title") && svg.contains("<text x=\"89.0\" y=\"18.1\""), "{svg}");
        assert!(svg.contains("<path d=\"M264.0 180.8L466.0 104.2\""), "{svg}");
    }

    #[test]
    fn a_point_without_exposure_is_left_out() {
        let mut with_gap = series();
        with_gap.points.push(RatePoint { density_veh_per_km: 30.0, changes: 3, exposure_km_h: 0.0 });
        assert_eq!(
            rate_density(Sheet::Page, "", &[with_gap]).svg,
            rate_density(Sheet::Page, "", &[series()]).svg
        );
    }
}
