//! Lane-change rate against density, with exact Poisson intervals.

use super::axes::Axis;
use super::drawing::{Anchor, Drawing, RIGHT, TOP, across, down, text_width};
use crate::rate::RatePoint;
use crate::statistics::Interval;

/// Colours of the series in turn (Okabe and Ito: told apart by colour-blind eyes too).
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
/// Radius of a marker, half the cap of an error bar, and line pitch of the legend [px].
const RADIUS: f64 = 4.5;
const CAP: f64 = 4.0;
const LEGEND_PITCH: f64 = 24.0;
/// Series stand this far apart at the same density, so that their bars do not hide each other [px].
const STAGGER: f64 = 3.0;

/// One curve: a model, a style, a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct RateSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its points in order of density.
    pub points: Vec<RatePoint>,
}

/// Draws the lane-change rate [1/(km h)] against the density [veh/km per lane], each point with the exact Poisson
/// 95 % interval of its count. Points that are not finite are left out; several series are staggered by a few pixels.
pub fn rate_density(title: &str, series: &[RateSeries]) -> String {
    let finite: Vec<Vec<RatePoint>> = series.iter().map(|it| finite_points(&it.points)).collect();
    let all = || finite.iter().flatten();
    let densest = all().map(|it| it.density_veh_per_km).fold(0.0, f64::max);
    let highest = all().map(|it| it.interval_per_km_h().upper).fold(0.0, f64::max);
    let x = Axis::from_zero("density [veh/km per lane]", densest);
    let y = Axis::from_zero("lane-change rate [1/(km h)]", highest);

    let longest = series.iter().map(|it| text_width(&it.name)).fold(0.0, f64::max);
    let mut drawing = Drawing::new(title, longest + 60.0);
    drawing.axes(&x, &y);
    drawing.frame();
    for (index, points) in finite.iter().enumerate() {
        let shift = STAGGER * (index as f64 - 0.5 * (series.len() - 1) as f64);
        let place = |density: f64| across(&x, density) + shift;
        drawing.add(&curve(points, index, place, |rate| down(&y, rate)));
    }
    for (index, it) in series.iter().enumerate() {
        let y = TOP + LEGEND_PITCH * (index as f64 + 0.5);
        drawing.add(&legend_key(RIGHT + 24.0, y, index));
        drawing.text(RIGHT + 42.0, y, Anchor::Start, &it.name);
    }
    drawing.finish()
}

fn finite_points(points: &[RatePoint]) -> Vec<RatePoint> {
    let is_finite =
        |it: &RatePoint| it.density_veh_per_km.is_finite() && it.interval_per_km_h().upper.is_finite();
    points.iter().copied().filter(is_finite).collect()
}

/// Line, error bars and markers of one series.
fn curve(
    points: &[RatePoint],
    index: usize,
    across: impl Fn(f64) -> f64,
    down: impl Fn(f64) -> f64,
) -> String {
    let (mut line, mut bars, mut markers) = (String::new(), String::new(), String::new());
    for point in points {
        let Interval { lower, upper } = point.interval_per_km_h();
        let centre = across(point.density_veh_per_km);
        let [middle, low, high] = [point.rate_per_km_h(), lower, upper].map(&down);
        let (west, cap) = (centre - CAP, 2.0 * CAP);
        line += &format!("{}{centre:.1} {middle:.1}", if line.is_empty() { 'M' } else { 'L' });
        bars +=
            &format!("M{centre:.1} {low:.1}V{high:.1}M{west:.1} {low:.1}h{cap}M{west:.1} {high:.1}h{cap}");
        markers += &marker(centre, middle, index);
    }
    let colour = COLOURS[index % COLOURS.len()];
    format!(
        "<g fill=\"none\" stroke=\"{colour}\"><path d=\"{line}\" stroke-opacity=\"0.4\"/>\
         <path d=\"{bars}\" stroke-width=\"1.3\"/><path d=\"{markers}\" fill=\"{colour}\" stroke=\"white\"/></g>"
    )
}

fn legend_key(x: f64, y: f64, index: usize) -> String {
    let colour = COLOURS[index % COLOURS.len()];
    format!("<path d=\"{}\" fill=\"{colour}\"/>", marker(x, y, index))
}

/// Circle, square, diamond or triangle, in turn.
fn marker(x: f64, y: f64, index: usize) -> String {
    let r = RADIUS;
    match index % 4 {
        0 => format!("M{:.1} {y:.1}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", x - r, d = 2.0 * r),
        1 => format!("M{:.1} {:.1}h{s}v{s}h-{s}z", x - 4.0, y - 4.0, s = 8),
        2 => format!("M{x:.1} {:.1}l{h} {h}l-{h} {h}l-{h} -{h}z", y - 5.5, h = 5.5),
        _ => format!("M{x:.1} {:.1}l{r} 8h-{d}z", y - 5.0, d = 2.0 * r),
    }
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
        let svg = rate_density("", &[series()]);
        assert!(svg.contains("<path d=\"M444.0 338.9L804.0 181.7\""), "{svg}");
        assert!(svg.contains("d=\"M444.0 379.4V288.8M"), "{svg}");
    }

    #[test]
    fn both_axes_name_their_unit_and_the_legend_its_series() {
        let svg = rate_density("title", &[series()]);
        for text in ["title", "density [veh/km per lane]", "lane-change rate [1/(km h)]", "A &amp; B"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }

    #[test]
    fn a_point_without_exposure_is_left_out() {
        let mut with_gap = series();
        with_gap.points.push(RatePoint { density_veh_per_km: 30.0, changes: 3, exposure_km_h: 0.0 });
        assert_eq!(rate_density("", &[with_gap]), rate_density("", &[series()]));
    }
}
